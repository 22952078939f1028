/* SPDX-License-Identifier: MIT */
/* Ranges of bytes, and little-endian items from bytes, on any host and at any alignment. */
#ifndef LRCSI_BYTES_H
#define LRCSI_BYTES_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* A range of bytes in an input, for instance those of a name. */
typedef struct lrcsi_span {
    size_t at, size;
} lrcsi_span;

static inline unsigned lrcsi_bytes_u16(const unsigned char *byte)
{
    return byte[0] | (unsigned)byte[1] << 8;
}

static inline uint32_t lrcsi_bytes_u32(const unsigned char *byte)
{
    return lrcsi_bytes_u16(byte) | (uint32_t)lrcsi_bytes_u16(byte + 2) << 16;
}

/* An IEEE 754 binary32, as a double (exact). */
static inline double lrcsi_bytes_float(const unsigned char *byte)
{
    uint32_t bits = lrcsi_bytes_u32(byte);
    float value;
    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

#endif
