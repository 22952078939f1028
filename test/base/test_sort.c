/* SPDX-License-Identifier: MIT */
/* The radix sort: order, stability, and keys that differ in any byte. */
#include "base/sort.h"

#include "check.h"
#include "random.h"

enum { MANY = 5000 };

/* Sorts random keys under a mask and checks order, stability, and that pairs stay together. */
static void check_mask(uint64_t mask, uint32_t count)
{
    static uint64_t key[MANY], spare[MANY], before[MANY];
    static uint32_t value[MANY], value_spare[MANY];
    uint64_t seed = 88172645463325252u;
    for (uint32_t i = 0; i < count; i++) {
        key[i] = before[i] = random_xorshift(&seed) & mask;
        value[i] = i;
    }
    lrcsi_sort_pairs(key, value, spare, value_spare, count);
    for (uint32_t i = 0; i < count; i++) {
        assert_true(value[i] < count && key[i] == before[value[i]]);
        if (i > 0) {
            assert_true(key[i - 1] < key[i] || (key[i - 1] == key[i] && value[i - 1] < value[i]));
        }
    }
}

static void pairs_come_out_in_order_and_stable(void **state)
{
    (void)state;
    check_mask(UINT64_MAX, MANY);
    check_mask(3, MANY);
    check_mask(0xff00ff, MANY);
}

static void each_byte_counts(void **state)
{
    (void)state;
    for (int byte = 0; byte < 8; byte++) {
        check_mask((uint64_t)0x81 << (8 * byte), 300);
    }
}

static void empty_and_single_lists_are_sorted(void **state)
{
    (void)state;
    check_mask(UINT64_MAX, 0);
    check_mask(UINT64_MAX, 1);
    check_mask(0, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_come_out_in_order_and_stable),
        cmocka_unit_test(each_byte_counts),
        cmocka_unit_test(empty_and_single_lists_are_sorted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
