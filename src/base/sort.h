/* SPDX-License-Identifier: MIT */
/* Sorting without recursion. */
#ifndef LRCSI_SORT_H
#define LRCSI_SORT_H

#include <stddef.h>
#include <stdint.h>

/* Sorts `count` pairs by key, ascending; pairs of equal keys keep their order. The spare arrays
   are scratch memory of the same length. Radix sort with at most eight passes. */
void lrcsi_sort_pairs(uint64_t *key, uint32_t *value, uint64_t *key_spare, uint32_t *value_spare,
                      uint32_t count);

/* Sorts numbers in place, ascending, without further memory. The time grows somewhat faster than
   count log(count). */
void lrcsi_sort_ascending(double *x, uint32_t count);

/* Two numbers to be sorted by `key`, among equal keys by `value`. */
typedef struct lrcsi_sort_item {
    uint32_t key, value;
} lrcsi_sort_item;

/* Sorts items in place, ascending, without further memory, in at most about count log(count). */
void lrcsi_sort_items(lrcsi_sort_item *item, size_t count);

#endif
