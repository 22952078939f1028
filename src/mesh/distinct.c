/* SPDX-License-Identifier: MIT */
/* Numbering distinct names: an open hash table, at most half full, over a list and text that its
   caller keeps. Two names are one where their UTF-8 texts are. */
#include "mesh/distinct.h"

#include "base/text.h"
#include "base/work.h"
#include "mesh/store.h"

#include <string.h>

int lrcsi_distinct_make(const char **name, uint32_t most, lrcs_work *work, lrcsi_distinct *distinct)
{
    size_t slots = lrcsi_store_slots(most);
    uint32_t *slot = lrcsi_work_take(work, slots, sizeof *slot);
    if (!slot) {
        return LRCS_E_MEMORY;
    }
    memset(slot, 0xff, slots * sizeof *slot); /* LRCS_NONE */
    *distinct = (lrcsi_distinct){name, 0, slot, slots};
    return LRCS_OK;
}

uint32_t lrcsi_distinct_add(lrcsi_distinct *distinct, const char *bytes, size_t size, char **text)
{
    size_t written = lrcsi_text_utf8(bytes, size, *text);
    size_t at = (size_t)lrcsi_store_mix(lrcsi_store_key(*text, written)) & (distinct->slots - 1);
    while (distinct->slot[at] != LRCS_NONE &&
           strcmp(distinct->name[distinct->slot[at]], *text) != 0) {
        at = (at + 1) & (distinct->slots - 1);
    }
    if (distinct->slot[at] == LRCS_NONE) {
        distinct->slot[at] = distinct->count;
        distinct->name[distinct->count++] = *text;
        *text += written;
    }
    return distinct->slot[at];
}
