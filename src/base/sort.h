/* SPDX-License-Identifier: MIT */
/* Sorting without recursion. */
#ifndef LRCSI_SORT_H
#define LRCSI_SORT_H

#include <stdint.h>

/* Sorts `count` pairs by key, ascending; pairs of equal keys keep their order. The spare arrays
   are scratch memory of the same length. Radix sort with at most eight passes. */
void lrcsi_sort_pairs(uint64_t *key, uint32_t *value, uint64_t *key_spare, uint32_t *value_spare,
                      uint32_t count);

/* Sorts numbers in place, ascending, without further memory. The time grows somewhat faster than
   count log(count). */
void lrcsi_sort_ascending(double *x, uint32_t count);

#endif
