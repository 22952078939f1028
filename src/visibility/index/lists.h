/* SPDX-License-Identifier: MIT */
/* Lists of items, all in one array, made in two passes over the items. `first` begins as lists + 1
   zeros.
   1. lrcsi_lists_put with item NULL counts: list i in first[i + 1].
   2. lrcsi_lists_room allocates the items. Status: LRCS_OK; LRCS_E_LIMIT, more than `most`;
      LRCS_E_MEMORY.
   3. lrcsi_lists_put with the items fills the lists; lrcsi_lists_finish makes first[i] the start of
      list i again. */
#ifndef LRCSI_LISTS_H
#define LRCSI_LISTS_H

#include "base/work.h"

int lrcsi_lists_room(uint32_t *first, size_t lists, uint64_t most, lrcs_work *work,
                     uint32_t **item);
void lrcsi_lists_finish(uint32_t *first, size_t lists);

/* Counts or adds a value in each of the lists from <= i < to. */
static inline void lrcsi_lists_put(uint32_t *first, uint32_t *item, size_t from, size_t to,
                                   uint32_t value)
{
    for (size_t i = from; i < to; i++) {
        if (item) {
            item[first[i]++] = value;
        } else {
            first[i + 1]++;
        }
    }
}

#endif
