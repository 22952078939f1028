/* SPDX-License-Identifier: MIT */
/* The index from names to numbers, and the sizes of hash tables. */
#include "base/index.h"

#include <stdio.h>
#include <string.h>

#include "base/hash.h"
#include "check.h"

static void a_table_is_a_power_of_two_and_at_most_half_full(void **state)
{
    (void)state;
    for (size_t count = 0; count < 3000; count++) {
        size_t slots = lrcsi_hash_slots(count);
        assert_int_equal(slots & (slots - 1), 0);
        assert_true(slots / 2 >= count && slots > count);
        assert_true(slots <= 4 * count || slots == 2);
    }
    assert_int_equal(lrcsi_hash_slots(SIZE_MAX), SIZE_MAX);
    assert_int_equal(lrcsi_hash_slots(SIZE_MAX / 2), SIZE_MAX);
}

static void names_differ_by_bytes_and_tag(void **state)
{
    (void)state;
    unsigned char area[1024];
    lrcs_work work = lrcs_work_make(area, sizeof area);
    lrcsi_index names;
    assert_int_equal(lrcsi_index_make(&work, 4, &names), LRCS_OK);
    lrcsi_index_put(&names, 0, "gold", 4, 10);
    lrcsi_index_put(&names, 0, "gold ", 5, 11);
    lrcsi_index_put(&names, 1, "gold", 4, 12);
    lrcsi_index_put(&names, 0, "", 0, 13);
    assert_int_equal(lrcsi_index_find(&names, 0, "gold", 4), 10);
    assert_int_equal(lrcsi_index_find(&names, 0, "gold ", 5), 11);
    assert_int_equal(lrcsi_index_find(&names, 1, "gold", 4), 12);
    assert_int_equal(lrcsi_index_find(&names, 0, "", 0), 13);
    assert_int_equal(lrcsi_index_find(&names, 0, "gol", 3), LRCS_NONE);
    assert_int_equal(lrcsi_index_find(&names, 0, "Gold", 4), LRCS_NONE);
    assert_int_equal(lrcsi_index_find(&names, 2, "gold", 4), LRCS_NONE);
}

static void a_second_put_replaces_the_value(void **state)
{
    (void)state;
    unsigned char area[256];
    lrcs_work work = lrcs_work_make(area, sizeof area);
    lrcsi_index names;
    assert_int_equal(lrcsi_index_make(&work, 1, &names), LRCS_OK);
    lrcsi_index_put(&names, 0, "a", 1, 1);
    lrcsi_index_put(&names, 0, "a", 1, 2);
    assert_int_equal(lrcsi_index_find(&names, 0, "a", 1), 2);
    assert_int_equal(names.count, 1);
}

static void an_index_of_nothing_finds_nothing(void **state)
{
    (void)state;
    unsigned char area[128];
    lrcs_work work = lrcs_work_make(area, sizeof area);
    lrcsi_index names;
    assert_int_equal(lrcsi_index_make(&work, 0, &names), LRCS_OK);
    assert_int_equal(lrcsi_index_find(&names, 0, "x", 1), LRCS_NONE);
}

/* With as many names as it was made for, every name is found, and the memory stated was enough. */
static void a_full_index_finds_every_name(void **state)
{
    (void)state;
    enum { COUNT = 1000 };
    static char text[COUNT][8];
    static unsigned char area[65536];
    assert_true(lrcsi_index_need(COUNT) <= sizeof area);
    lrcs_work work = lrcs_work_make(area, lrcsi_index_need(COUNT));
    lrcsi_index names;
    assert_int_equal(lrcsi_index_make(&work, COUNT, &names), LRCS_OK);
    for (uint32_t i = 0; i < COUNT; i++) {
        snprintf(text[i], sizeof text[i], "n%u", i);
        lrcsi_index_put(&names, i % 3, text[i], strlen(text[i]), i);
    }
    for (uint32_t i = 0; i < COUNT; i++) {
        assert_int_equal(lrcsi_index_find(&names, i % 3, text[i], strlen(text[i])), i);
        assert_int_equal(lrcsi_index_find(&names, (i + 1) % 3, text[i], strlen(text[i])),
                         LRCS_NONE);
    }
}

static void more_names_than_memory_can_hold_need_all_of_it(void **state)
{
    (void)state;
    assert_true(lrcsi_index_need(SIZE_MAX) == SIZE_MAX);
    assert_true(lrcsi_index_need(SIZE_MAX / 2) == SIZE_MAX);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_table_is_a_power_of_two_and_at_most_half_full),
        cmocka_unit_test(names_differ_by_bytes_and_tag),
        cmocka_unit_test(a_second_put_replaces_the_value),
        cmocka_unit_test(an_index_of_nothing_finds_nothing),
        cmocka_unit_test(a_full_index_finds_every_name),
        cmocka_unit_test(more_names_than_memory_can_hold_need_all_of_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
