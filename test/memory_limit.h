/* SPDX-License-Identifier: MIT */
/* Memory limits: a function that takes its memory from a work area, called with every size of it
   from nothing to what its _need says. */
#ifndef TEST_MEMORY_LIMIT_H
#define TEST_MEMORY_LIMIT_H

#include <stdlib.h>

#include "check.h"

#define MEMORY_CANARY 64

typedef struct memory_case {
    const char *name;
    size_t need;
    int (*call)(lrcs_work *work);
    void *output;
    size_t output_size;
    int stays; /* 1: what it made stays in the work area */
    /* NULL: a call that is served wants no more than it was given. Else: is what it wanted right?
     */
    int (*wanted)(size_t wanted, size_t size);
} memory_case;

#define MEMORY_CASE(name, need, call, output, stays)                                               \
    (&(const memory_case){name, need, call, &(output), sizeof(output), stays, NULL})

/* One call with so many bytes, and a canary behind them. */
static int memory_limit_at(const memory_case *s, unsigned char *memory, size_t size)
{
    unsigned char *before = malloc(s->output_size);
    assert_non_null(before);
    memset(s->output, 0x5a, s->output_size);
    memcpy(before, s->output, s->output_size);
    memset(memory + size, 0xc3, MEMORY_CANARY);
    lrcs_work work = lrcs_work_make(memory, size);
    int status = s->call(&work);
    for (int i = 0; i < MEMORY_CANARY; i++) {
        assert_int_equal(memory[size + (size_t)i], 0xc3);
    }
    if (status == LRCS_OK) {
        assert_true(s->wanted ? s->wanted(work.peak, size) : work.peak <= size);
        assert_true(s->stays ? work.used > 0 : work.used == 0);
    } else {
        assert_int_equal(status, LRCS_E_MEMORY);
        assert_int_equal(work.used, 0);
        assert_true(work.peak > size);
        assert_memory_equal(before, s->output, s->output_size);
    }
    free(before);
    return status;
}

/* One call; once a size suffices, every larger one does, and `need`. Returns 1 if it suffices. */
static int memory_limit_serves(const memory_case *s, unsigned char *memory, size_t size, int served)
{
    int status = memory_limit_at(s, memory, size);
    if (status != LRCS_OK && (served || size == s->need)) {
        fprintf(stderr, "%s: not served by %zu of %zu bytes\n", s->name, size, s->need);
        fail();
    }
    return status == LRCS_OK;
}

/* Tries every size; of those that need much, the first 1024 sizes, the last 128, every 127th
   between or, if these are more than 500, so many of them; and of those between which one
   suffices first, all, or every 17th if they are more than 127. */
static void check_memory_limit(const memory_case *s)
{
    unsigned char *memory = malloc(s->need + MEMORY_CANARY);
    assert_non_null(memory);
    const size_t stride = s->need / 500 > 127 ? s->need / 500 : 127;
    int served = 0;
    size_t step = 1;
    for (size_t size = 0; size <= s->need; size += step) {
        int serves = memory_limit_serves(s, memory, size, served);
        if (serves && !served) {
            const size_t by = step > 127 ? 17 : 1;
            for (size_t less = size + 1 - step; less < size; less += by) {
                served = memory_limit_serves(s, memory, less, served);
            }
        }
        served = serves;
        step = size < 1024 || size + 128 > s->need ? 1 : stride;
    }
    assert_true(served);
    free(memory);
}

#endif
