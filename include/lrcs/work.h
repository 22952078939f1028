/* SPDX-License-Identifier: MIT */
/* The work area: memory provided by the caller, from which the library allocates in order. The
   library has no heap of its own. A function releases its scratch memory before it returns; what it
   leaves in the work area (a mesh, a scene) is valid until the caller sets `used` back to an
   earlier value. A function that fails leaves nothing. */
#ifndef LRCS_WORK_H
#define LRCS_WORK_H

#include <stddef.h>

/* Every allocated block starts at a multiple of this many bytes. */
#define LRCS_WORK_ALIGN 16u

typedef struct lrcs_work {
    unsigned char *bytes; /* start of the area, any alignment */
    size_t size;          /* bytes in it */
    size_t used;          /* bytes taken so far, padding included */
    size_t peak;          /* the maximum of `used`; if a block was refused, it includes the bytes
                             needed up to and including that block */
} lrcs_work;

/* A work area over `size` bytes at `bytes` (which may be NULL when size is 0). */
lrcs_work lrcs_work_make(void *bytes, size_t size);

#endif
