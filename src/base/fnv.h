/* SPDX-License-Identifier: MIT */
/* FNV-1a, 64 bit (Fowler, Noll, Vo; draft-eastlake-fnv): a fingerprint, not a
   cryptographic hash. */
#ifndef LRCSI_FNV_H
#define LRCSI_FNV_H

#include <stddef.h>
#include <stdint.h>

#define LRCSI_FNV_START UINT64_C(0xcbf29ce484222325)

static inline uint64_t lrcsi_fnv_byte(uint64_t hash, unsigned char byte)
{
    return (hash ^ byte) * UINT64_C(0x100000001b3);
}

/* Adds the `count` low bytes of a number, lowest first, independent of the machine's byte order. */
static inline uint64_t lrcsi_fnv_bits(uint64_t hash, uint64_t bits, int count)
{
    for (int i = 0; i < count; i++) {
        hash = lrcsi_fnv_byte(hash, (unsigned char)(bits >> 8 * i & 0xff));
    }
    return hash;
}

#endif
