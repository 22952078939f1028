/* SPDX-License-Identifier: MIT */
/* Room for lists that were counted, and lists that were filled. What they list is decided by the
   caller. */
#include "visibility/index/lists.h"

#include <string.h>

#include <lrcs/status.h>

int lrcsi_lists_room(uint32_t *first, size_t lists, uint64_t most, lrcs_work *work, uint32_t **item)
{
    uint64_t total = 0;
    for (size_t i = 0; i <= lists; i++) {
        total += first[i];
        first[i] = (uint32_t)total;
    }
    if (total > most) {
        return LRCS_E_LIMIT;
    }
    *item = lrcsi_work_take(work, (size_t)total, sizeof **item);
    return *item ? LRCS_OK : LRCS_E_MEMORY;
}

void lrcsi_lists_finish(uint32_t *first, size_t lists)
{
    memmove(first + 1, first, lists * sizeof *first);
    first[0] = 0;
}
