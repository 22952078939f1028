/* SPDX-License-Identifier: MIT */
/* What the fuzz targets share: the entry that libFuzzer and replay.c call, the check of a property
   (require), heap blocks of exact size (so that AddressSanitizer sees an access one byte beyond
   them), and small choices made from the input's bytes. */
#ifndef TEST_FUZZ_H
#define TEST_FUZZ_H

#include <lrcs/lrcs.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const unsigned char *data, size_t size);

#define require(holds) ((holds) ? (void)0 : fuzz_broken(#holds, __FILE__, __LINE__))

static inline void fuzz_broken(const char *what, const char *file, int line)
{
    fprintf(stderr, "%s:%d: broken: %s\n", file, line, what);
    abort();
}

static inline lrcs_work fuzz_area(size_t size)
{
    void *bytes = malloc(size > 0 ? size : 1);
    require(bytes != NULL);
    return lrcs_work_make(bytes, size);
}

static inline void require_where(const lrcs_where *where, size_t size)
{
    require(where->item != NULL && where->expected != NULL);
    require(where->offset <= size && memchr(where->found, '\0', sizeof where->found) != NULL);
}

/* Checks that memory that was filled with a pattern is unchanged. */
#define FUZZ_PATTERN 0x5a
static inline int fuzz_untouched(const void *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        if (((const unsigned char *)bytes)[i] != FUZZ_PATTERN) {
            return 0;
        }
    }
    return 1;
}

/* The input, read byte by byte; zeros beyond its end. */
typedef struct fuzz_input {
    const unsigned char *at, *end;
} fuzz_input;

static inline unsigned fuzz_byte(fuzz_input *in)
{
    return in->at < in->end ? *in->at++ : 0;
}

#endif
