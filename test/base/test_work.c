/* SPDX-License-Identifier: MIT */
/* The bump arena: alignment, checked sizes, and a peak that says how much was missing. */
#include "base/work.h"

#include <string.h>

#include "check.h"

static void blocks_are_aligned_and_apart(void **state)
{
    (void)state;
    unsigned char bytes[256];
    lrcs_work work = lrcs_work_make(bytes + 1, sizeof bytes - 1);
    unsigned char *a = lrcsi_work_take(&work, 3, 1);
    unsigned char *b = lrcsi_work_take(&work, 1, 8);
    assert_non_null(a);
    assert_non_null(b);
    assert_int_equal((uintptr_t)a % LRCS_WORK_ALIGN, 0);
    assert_int_equal((uintptr_t)b % LRCS_WORK_ALIGN, 0);
    assert_true(b >= a + 3);
}

static void refusal_takes_nothing_and_tells_the_need(void **state)
{
    (void)state;
    unsigned char bytes[64];
    lrcs_work work = lrcs_work_make(bytes, sizeof bytes);
    assert_null(lrcsi_work_take(&work, 1000, 8));
    assert_int_equal(work.used, 0);
    assert_true(work.peak >= 8000);
}

static void overflowing_sizes_are_refused(void **state)
{
    (void)state;
    unsigned char bytes[64];
    lrcs_work work = lrcs_work_make(bytes, sizeof bytes);
    assert_null(lrcsi_work_take(&work, SIZE_MAX / 2, 16));
    assert_null(lrcsi_work_take(&work, SIZE_MAX, 1));
    assert_int_equal(lrcsi_work_bytes(SIZE_MAX, 2), SIZE_MAX);
    assert_int_equal(lrcsi_work_blocks(3, SIZE_MAX, 2), SIZE_MAX);
    assert_int_equal(lrcsi_work_blocks(3, SIZE_MAX / 2, 1), SIZE_MAX);
    assert_int_equal(lrcsi_work_blocks(3, 8, 4), 3 * lrcsi_work_bytes(8, 4));
    assert_int_equal(lrcsi_work_blocks(0, 8, 4), 0);
}

static void blocks_asked_cleared_are_zero(void **state)
{
    (void)state;
    unsigned char bytes[64];
    memset(bytes, 0xff, sizeof bytes);
    lrcs_work work = lrcs_work_make(bytes, sizeof bytes);
    const unsigned char *a = lrcsi_work_take_zero(&work, 20, 1);
    assert_non_null(a);
    for (int i = 0; i < 20; i++) {
        assert_int_equal(a[i], 0);
    }
}

/* It has an address of its own, and nothing is cleared. */
static void a_block_of_no_bytes_is_a_block(void **state)
{
    (void)state;
    unsigned char bytes[128];
    memset(bytes, 0xff, sizeof bytes);
    lrcs_work work = lrcs_work_make(bytes, sizeof bytes);
    const unsigned char *a = lrcsi_work_take_zero(&work, 0, 8);
    const unsigned char *b = lrcsi_work_take_zero(&work, 8, 0);
    const unsigned char *c = lrcsi_work_take(&work, 1, 1);
    assert_non_null(a);
    assert_true(a < b && b < c);
    assert_int_equal(a[0], 0xff);
    assert_int_equal(lrcsi_work_bytes(8, 0), lrcsi_work_bytes(0, 8));
}

static void an_empty_area_serves_nothing(void **state)
{
    (void)state;
    lrcs_work work = lrcs_work_make(NULL, 0);
    assert_null(lrcsi_work_take(&work, 1, 1));
    assert_true(work.peak > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_are_aligned_and_apart),
        cmocka_unit_test(refusal_takes_nothing_and_tells_the_need),
        cmocka_unit_test(overflowing_sizes_are_refused),
        cmocka_unit_test(blocks_asked_cleared_are_zero),
        cmocka_unit_test(a_block_of_no_bytes_is_a_block),
        cmocka_unit_test(an_empty_area_serves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
