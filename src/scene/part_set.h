/* SPDX-License-Identifier: MIT */
/* A set of parts: bit i is part i; the last bit is all parts from there on. */
#ifndef LRCSI_PART_SET_H
#define LRCSI_PART_SET_H

#include <stdint.h>

typedef uint64_t lrcsi_part_set;
#define LRCSI_PART_SET_ALL UINT64_MAX
static inline lrcsi_part_set lrcsi_part_set_of(uint32_t part)
{
    return (lrcsi_part_set)1 << (part < 63 ? part : 63);
}

#endif
