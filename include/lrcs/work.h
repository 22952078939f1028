/* SPDX-License-Identifier: MIT */
/* The work area: the caller's memory, from which the library takes in order and never frees.
   The library holds no heap of its own. What a function leaves in the work area (a mesh, a
   scene) lives as long as those bytes do. */
#ifndef LRCS_WORK_H
#define LRCS_WORK_H

#include <stddef.h>

/* Every block taken starts on a multiple of this many bytes. */
#define LRCS_WORK_ALIGN 16u

typedef struct lrcs_work {
    unsigned char *bytes; /* start of the area, any alignment */
    size_t size;          /* bytes in it */
    size_t used;          /* bytes taken so far, padding included */
    size_t peak;          /* the largest `used` ever was, also when a block was refused:
                             then what would have been needed up to that block */
} lrcs_work;

/* A work area over `size` bytes at `bytes` (which may be NULL when size is 0). */
lrcs_work lrcs_work_make(void *bytes, size_t size);

#endif
