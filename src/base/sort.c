/* SPDX-License-Identifier: MIT */
/* Radix sort from the lowest byte up (Knuth TAOCP 3, 5.2.5). All eight histograms come from one
   pass; a byte that is the same in every key costs no pass of its own. */
#include "base/sort.h"

#include <string.h>

enum { RADIX_BYTES = 8, RADIX_SIZE = 256 };

static uint32_t radix_digit(uint64_t key, int byte)
{
    return (uint32_t)(key >> (8 * byte)) & (RADIX_SIZE - 1);
}

/* Turns counts into first places. */
static void radix_places(uint32_t *place)
{
    uint32_t sum = 0;
    for (int d = 0; d < RADIX_SIZE; d++) {
        uint32_t n = place[d];
        place[d] = sum;
        sum += n;
    }
}

void lrcsi_sort_pairs(uint64_t *key, uint32_t *value, uint64_t *key_spare, uint32_t *value_spare,
                      uint32_t count)
{
    uint32_t place[RADIX_BYTES][RADIX_SIZE];
    memset(place, 0, sizeof place);
    for (uint32_t i = 0; i < count; i++) {
        for (int byte = 0; byte < RADIX_BYTES; byte++) {
            place[byte][radix_digit(key[i], byte)]++;
        }
    }
    for (int byte = 0; byte < RADIX_BYTES && count > 0; byte++) {
        if (place[byte][radix_digit(key[0], byte)] == count) {
            continue;
        }
        radix_places(place[byte]);
        for (uint32_t i = 0; i < count; i++) {
            uint32_t to = place[byte][radix_digit(key[i], byte)]++;
            key_spare[to] = key[i];
            value_spare[to] = value[i];
        }
        memcpy(key, key_spare, count * sizeof *key);
        memcpy(value, value_spare, count * sizeof *value);
    }
}
