/* SPDX-License-Identifier: MIT */
/* The radix sort: order, stability, and keys that differ in any byte. The sort of numbers: order,
   and that the numbers stay the same, against the number of smaller ones. */
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

/* Numbers with many ties, and their order by counting the smaller ones. */
static void numbers_come_out_in_order(void **state)
{
    static double x[MANY], before[MANY];
    (void)state;
    for (uint32_t count = 0; count < 1500; count += count < 20 ? 1 : 367) {
        uint64_t seed = 88172645463325252u + count;
        for (uint32_t i = 0; i < count; i++) {
            x[i] = before[i] = (double)(random_xorshift(&seed) % 1000) - 500;
        }
        lrcsi_sort_ascending(x, count);
        for (uint32_t i = 0; i < count; i++) {
            uint32_t below = 0;
            uint32_t ties = 0;
            for (uint32_t k = 0; k < count; k++) {
                below += before[k] < before[i];
                ties += before[k] == before[i];
            }
            for (uint32_t k = 0; k < ties; k++) {
                assert_true(x[below + k] == before[i]);
            }
        }
    }
}

/* Items with many ties in their keys: each is in order with the next, and their sums are kept. */
static void items_come_out_by_key_then_by_value(void **state)
{
    static lrcsi_sort_item item[MANY];
    (void)state;
    for (uint32_t count = 0; count < 1500; count += count < 40 ? 1 : 367) {
        uint64_t seed = 88172645463325252u + count;
        uint64_t sum[2] = {0, 0};
        for (uint32_t i = 0; i < count; i++) {
            item[i].key = (uint32_t)(random_xorshift(&seed) % (count / 3 + 1));
            item[i].value = (uint32_t)(random_xorshift(&seed) % 5);
            sum[0] += item[i].key * UINT64_C(1000003) + item[i].value;
        }
        lrcsi_sort_items(item, count);
        for (uint32_t i = 0; i < count; i++) {
            sum[1] += item[i].key * UINT64_C(1000003) + item[i].value;
            assert_true(i == 0 || item[i - 1].key < item[i].key ||
                        (item[i - 1].key == item[i].key && item[i - 1].value <= item[i].value));
        }
        assert_true(sum[0] == sum[1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_come_out_in_order_and_stable),
        cmocka_unit_test(each_byte_counts),
        cmocka_unit_test(empty_and_single_lists_are_sorted),
        cmocka_unit_test(numbers_come_out_in_order),
        cmocka_unit_test(items_come_out_by_key_then_by_value),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
