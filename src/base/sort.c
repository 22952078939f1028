/* SPDX-License-Identifier: MIT */
/* Radix sort from the lowest digit up (Knuth TAOCP 3, 5.2.5), in digits of 11 bits; a digit that is
   the same in every key costs nothing. Where there is no memory for that, Shell's sort for numbers,
   and heap sort (TAOCP 3, 5.2.3) for the short lists of items. */
#include "base/sort.h"

#include <string.h>

enum { RADIX_BITS = 11, RADIX_SIZE = 1 << RADIX_BITS };

static uint32_t radix_digit(uint64_t key, int shift)
{
    return (uint32_t)(key >> shift) & (RADIX_SIZE - 1);
}

void lrcsi_sort_pairs(uint64_t *key, uint32_t *value, uint64_t *key_spare, uint32_t *value_spare,
                      uint32_t count)
{
    uint32_t place[RADIX_SIZE];
    uint64_t *from = key;
    uint64_t *to = key_spare;
    uint32_t *value_from = value;
    uint32_t *value_to = value_spare;
    uint64_t differ = 0; /* bits in which some keys do */
    for (uint32_t i = 1; i < count; i++) {
        differ |= key[i] ^ key[0];
    }
    for (int shift = 0; shift < 64; shift += RADIX_BITS) {
        if (radix_digit(differ, shift) == 0) {
            continue;
        }
        /* 1. Counts the keys of each digit; then computes the index of the first one. */
        memset(place, 0, sizeof place);
        for (uint32_t i = 0; i < count; i++) {
            place[radix_digit(from[i], shift)]++;
        }
        uint32_t sum = 0;
        for (int d = 0; d < RADIX_SIZE; d++) {
            uint32_t n = place[d];
            place[d] = sum;
            sum += n;
        }
        /* 2. Moves all there, in their present order, which is the input of the next digit. */
        for (uint32_t i = 0; i < count; i++) {
            uint32_t at = place[radix_digit(from[i], shift)]++;
            to[at] = from[i];
            value_to[at] = value_from[i];
        }
        uint64_t *keys = from;
        uint32_t *values = value_from;
        from = to;
        value_from = value_to;
        to = keys;
        value_to = values;
    }
    if (from != key) {
        memcpy(key, from, count * sizeof *key);
        memcpy(value, value_from, count * sizeof *value);
    }
}

/* Shell's sort with the gaps of Ciura (2001), continued by a factor of 9/4. */
void lrcsi_sort_ascending(double *x, uint32_t count)
{
    static const uint32_t gap[] = {1,    4,    10,   23,    57,    132,    301,    701,
                                   1750, 3937, 8858, 19930, 44842, 100894, 227011, 510774};
    for (size_t g = sizeof gap / sizeof gap[0]; g-- > 0;) {
        for (uint32_t i = gap[g]; i < count; i++) {
            double moved = x[i];
            uint32_t at = i;
            for (; at >= gap[g] && x[at - gap[g]] > moved; at -= gap[g]) {
                x[at] = x[at - gap[g]];
            }
            x[at] = moved;
        }
    }
}

static int item_before(lrcsi_sort_item a, lrcsi_sort_item b)
{
    return a.key < b.key || (a.key == b.key && a.value < b.value);
}

/* Sinks item i of a heap of n, the last in order on top. */
static void sink_item(lrcsi_sort_item *item, size_t i, size_t n)
{
    lrcsi_sort_item moved = item[i];
    for (size_t child = 2 * i + 1; child < n; child = 2 * i + 1) {
        child += child + 1 < n && item_before(item[child], item[child + 1]);
        if (!item_before(moved, item[child])) {
            break;
        }
        item[i] = item[child];
        i = child;
    }
    item[i] = moved;
}

/* Insertion sort if there are few items, as in most lists; otherwise heap sort. */
void lrcsi_sort_items(lrcsi_sort_item *item, size_t count)
{
    if (count > 32) {
        for (size_t i = count / 2; i > 0; i--) {
            sink_item(item, i - 1, count);
        }
        for (size_t last = count; last-- > 1;) {
            lrcsi_sort_item top = item[0];
            item[0] = item[last];
            item[last] = top;
            sink_item(item, 0, last);
        }
        return;
    }
    for (size_t i = 1; i < count; i++) {
        lrcsi_sort_item next = item[i];
        size_t at = i;
        for (; at > 0 && item_before(next, item[at - 1]); at--) {
            item[at] = item[at - 1];
        }
        item[at] = next;
    }
}
