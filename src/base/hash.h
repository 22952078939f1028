/* SPDX-License-Identifier: MIT */
/* What tables with open addressing share: their sizes, and the mixing of keys. */
#ifndef LRCSI_HASH_H
#define LRCSI_HASH_H

#include <stddef.h>
#include <stdint.h>

/* The number of slots of a table for `count` entries: a power of two, at least 2 and 2 count, so
   that probes stay short and always meet an empty slot; SIZE_MAX if there is none. */
static inline size_t lrcsi_hash_slots(size_t count)
{
    size_t slots = 2;
    while (slots / 2 < count) {
        if (slots > SIZE_MAX / 2) {
            return SIZE_MAX;
        }
        slots *= 2;
    }
    return slots;
}

/* Spreads 64 bits over all of them: an entry's first slot is lrcsi_hash_mix(key) & (slots - 1).
   The finaliser of SplitMix64 (Stafford 2011, variant 13). */
static inline uint64_t lrcsi_hash_mix(uint64_t key)
{
    key = (key ^ key >> 30) * 0xbf58476d1ce4e5b9u;
    key = (key ^ key >> 27) * 0x94d049bb133111ebu;
    return key ^ key >> 31;
}

#endif
