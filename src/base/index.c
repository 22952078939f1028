/* SPDX-License-Identifier: MIT */
/* The index from names to numbers. Decides the slot of a name; its number has a meaning only for
   the caller. */
#include "base/index.h"

#include <string.h>

#include "base/fnv.h"
#include "base/hash.h"
#include "base/work.h"

size_t lrcsi_index_need(size_t count)
{
    return lrcsi_work_add(lrcsi_work_bytes(count, sizeof(lrcsi_index_entry)),
                          lrcsi_work_bytes(lrcsi_hash_slots(count), sizeof(uint32_t)));
}

int lrcsi_index_make(lrcs_work *work, uint32_t count, lrcsi_index *names)
{
    size_t slots = lrcsi_hash_slots(count);
    lrcsi_index_entry *name = lrcsi_work_take(work, count, sizeof *name);
    uint32_t *slot = lrcsi_work_take_zero(work, slots, sizeof *slot);
    if (!name || !slot) {
        return LRCS_E_MEMORY;
    }
    *names = (lrcsi_index){name, slot, slots - 1, 0};
    return LRCS_OK;
}

/* The slot of a name, or the empty slot for it. */
static size_t slot_of(const lrcsi_index *names, uint32_t tag, const void *bytes, size_t size)
{
    uint64_t hash = lrcsi_fnv_bits(LRCSI_FNV_START, tag, 4);
    for (size_t i = 0; i < size; i++) {
        hash = lrcsi_fnv_byte(hash, ((const unsigned char *)bytes)[i]);
    }
    size_t at = (size_t)(hash ^ hash >> 32) & names->mask;
    while (names->slot[at] != 0) {
        const lrcsi_index_entry *name = &names->name[names->slot[at] - 1];
        if (name->tag == tag && name->size == size && memcmp(name->bytes, bytes, size) == 0) {
            break;
        }
        at = (at + 1) & names->mask;
    }
    return at;
}

uint32_t lrcsi_index_find(const lrcsi_index *names, uint32_t tag, const void *bytes, size_t size)
{
    uint32_t slot = names->slot[slot_of(names, tag, bytes, size)];
    return slot != 0 ? names->name[slot - 1].value : LRCS_NONE;
}

void lrcsi_index_put(lrcsi_index *names, uint32_t tag, const void *bytes, size_t size,
                     uint32_t value)
{
    uint32_t *slot = &names->slot[slot_of(names, tag, bytes, size)];
    if (*slot == 0) {
        names->name[names->count] = (lrcsi_index_entry){bytes, size, tag, value};
        *slot = ++names->count;
    }
    names->name[*slot - 1].value = value;
}
