/* SPDX-License-Identifier: MIT */
/* Radix sort from the lowest digit up (Knuth TAOCP 3, 5.2.5), in digits of 11 bits. A digit that is
   the same in every key costs nothing. */
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
