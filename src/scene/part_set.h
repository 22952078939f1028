/* SPDX-License-Identifier: MIT */
/* A set of parts: bit i is part i; the last bit is all parts from LRCSI_PART_SET_SINGLE on. */
#ifndef LRCSI_PART_SET_H
#define LRCSI_PART_SET_H

#include <stdint.h>

typedef uint64_t lrcsi_part_set;
#define LRCSI_PART_SET_ALL    UINT64_MAX
#define LRCSI_PART_SET_SINGLE 63u

static inline lrcsi_part_set lrcsi_part_set_of(uint32_t part)
{
    return (lrcsi_part_set)1 << (part < LRCSI_PART_SET_SINGLE ? part : LRCSI_PART_SET_SINGLE);
}

/* The set without a part. The last bit stays: it may be another part. */
static inline lrcsi_part_set lrcsi_part_set_without(lrcsi_part_set set, uint32_t part)
{
    return part < LRCSI_PART_SET_SINGLE ? set & ~lrcsi_part_set_of(part) : set;
}

/* Adds a part. Returns 0 if it was in the set before; 1 if it was not, or if that is not known. */
static inline int lrcsi_part_set_add(lrcsi_part_set *set, uint32_t part)
{
    const lrcsi_part_set one = lrcsi_part_set_of(part);
    const int had = part < LRCSI_PART_SET_SINGLE && (*set & one) != 0;
    *set |= one;
    return !had;
}

#endif
