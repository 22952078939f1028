/* SPDX-License-Identifier: MIT */
/* PNG (ISO/IEC 15948) with a small deflate of its own (RFC 1951): fixed Huffman codes, and
   matches at two distances only, the pixel before and the row above. Pictures of flat colours
   shrink to a few percent; photographs do not shrink, and none are written here. */
#include "host/fail.h"

#include <stdlib.h>
#include <string.h>

/* Of the deflate format: lengths of a repetition, and how far back it may begin (RFC 1951). */
#define MATCH_MIN 3u
#define MATCH_MAX 258u
#define WINDOW    32768u

/* Bits, least significant first, into bytes that are known to suffice. */
typedef struct bit_writer {
    unsigned char *bytes;
    size_t used;
    uint32_t held;
    unsigned count;
} bit_writer;

static void put_bits(bit_writer *out, uint32_t value, unsigned count)
{
    out->held |= value << out->count;
    out->count += count;
    while (out->count >= 8) {
        out->bytes[out->used++] = (unsigned char)(out->held & 255u);
        out->held >>= 8;
        out->count -= 8;
    }
}

/* Huffman codes go most significant bit first. */
static void put_code(bit_writer *out, uint32_t code, unsigned count)
{
    uint32_t reversed = 0;
    for (unsigned i = 0; i < count; i++) {
        reversed |= ((code >> i) & 1u) << (count - 1 - i);
    }
    put_bits(out, reversed, count);
}

/* A literal, the end or a length symbol in the fixed code (RFC 1951, 3.2.6). */
static void put_symbol(bit_writer *out, uint32_t symbol)
{
    if (symbol < 144) {
        put_code(out, 0x30 + symbol, 8);
    } else if (symbol < 256) {
        put_code(out, 0x190 + symbol - 144, 9);
    } else if (symbol < 280) {
        put_code(out, symbol - 256, 7);
    } else {
        put_code(out, 0xc0 + symbol - 280, 8);
    }
}

/* A match (3.2.5): groups of four lengths, two distances, whose extra bits grow by one. */
static void put_match(bit_writer *out, size_t length, size_t distance)
{
    uint32_t rest = (uint32_t)length - MATCH_MIN;
    if (length == MATCH_MAX) {
        put_symbol(out, 285);
    } else {
        unsigned extra = 0;
        while (rest >> extra >= 8) {
            extra++;
        }
        put_symbol(out, 257 + 4 * extra + (rest >> extra));
        put_bits(out, rest & ((1u << extra) - 1), extra);
    }
    rest = (uint32_t)distance - 1;
    unsigned extra = 0;
    while (rest >> extra >= 4) {
        extra++;
    }
    put_code(out, 2 * extra + (rest >> extra), 5);
    put_bits(out, rest & ((1u << extra) - 1), extra);
}

/* The number of bytes from `at` on that equal those `distance` before them. */
static size_t match_length(const unsigned char *bytes, size_t at, size_t size, size_t distance)
{
    size_t length = 0;
    size_t limit = size - at;
    if (distance > at || distance > WINDOW) {
        return 0;
    }
    if (limit > MATCH_MAX) {
        limit = MATCH_MAX;
    }
    while (length < limit && bytes[at + length] == bytes[at + length - distance]) {
        length++;
    }
    return length;
}

/* One block with the fixed code, over all bytes. */
static void deflate_bytes(bit_writer *out, const unsigned char *bytes, size_t size, size_t pixel,
                          size_t row)
{
    put_bits(out, 1, 1);
    put_bits(out, 1, 2);
    for (size_t at = 0; at < size;) {
        size_t left = match_length(bytes, at, size, pixel);
        size_t up = match_length(bytes, at, size, row);
        size_t length = left > up ? left : up;
        if (length >= MATCH_MIN) {
            put_match(out, length, left > up ? pixel : row);
            at += length;
        } else {
            put_symbol(out, bytes[at++]);
        }
    }
    put_symbol(out, 256);
    put_bits(out, 0, 7);
}

static uint32_t adler32(const unsigned char *bytes, size_t size)
{
    uint32_t a = 1;
    uint32_t b = 0;
    for (size_t i = 0; i < size; i++) {
        a = (a + bytes[i]) % 65521u;
        b = (b + a) % 65521u;
    }
    return b << 16 | a;
}

/* CRC-32 of PNG annex D, four bits at a time. */
static uint32_t crc32_add(uint32_t crc, const unsigned char *bytes, size_t size)
{
    uint32_t table[16];
    for (uint32_t i = 0; i < 16; i++) {
        table[i] = i;
        for (int k = 0; k < 4; k++) {
            table[i] = table[i] >> 1 ^ (table[i] & 1u ? 0xedb88320u : 0u);
        }
    }
    for (size_t i = 0; i < size; i++) {
        crc ^= bytes[i];
        crc = crc >> 4 ^ table[crc & 15u];
        crc = crc >> 4 ^ table[crc & 15u];
    }
    return crc;
}

static void big_endian(uint32_t value, unsigned char bytes[4])
{
    for (int i = 0; i < 4; i++) {
        bytes[i] = (unsigned char)(value >> (24 - 8 * i) & 255u);
    }
}

static void chunk_write(FILE *out, const char *name, const unsigned char *bytes, size_t size)
{
    unsigned char head[8];
    unsigned char tail[4];
    big_endian((uint32_t)size, head);
    memcpy(head + 4, name, 4);
    uint32_t crc = crc32_add(0xffffffffu, head + 4, 4);
    big_endian(crc32_add(crc, bytes, size) ^ 0xffffffffu, tail);
    fwrite(head, 1, sizeof head, out);
    fwrite(bytes, 1, size, out);
    fwrite(tail, 1, sizeof tail, out);
}

/* Rows with their filter byte, 0 (none), before each. */
static void rows_copy(unsigned char *raw, const unsigned char *pixels, size_t height, size_t row)
{
    for (size_t y = 0; y < height; y++) {
        raw[y * (row + 1)] = 0;
        memcpy(raw + y * (row + 1) + 1, pixels + y * row, row);
    }
}

/* A tEXt chunk: a keyword, a zero, and text in Latin-1. Longer text is cut. */
static void comment_write(FILE *out, const char *about)
{
    static const char keyword[] = "Comment";
    unsigned char bytes[4096];
    size_t used = sizeof keyword;
    memcpy(bytes, keyword, sizeof keyword);
    for (; *about && used < sizeof bytes; about++) {
        int plain = *about >= 0x20 && *about < 0x7f;
        bytes[used++] = plain ? (unsigned char)*about : '?';
    }
    chunk_write(out, "tEXt", bytes, used);
}

int lrcs_host_png_write(FILE *out, const unsigned char *pixels, uint32_t width, uint32_t height,
                        uint32_t channels, const char *about, lrcs_host_error *error)
{
    static const unsigned char signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    static const unsigned char colour[5] = {0, 0, 4, 2, 6};
    if (width == 0 || height == 0 || channels == 0 || channels > 4) {
        return lrcsi_host_fail(error, LRCS_E_ARGUMENT,
                               "expected a picture of at least one pixel and of 1 .. 4 channels, "
                               "found %lu x %lu, %lu channels",
                               (unsigned long)width, (unsigned long)height,
                               (unsigned long)channels);
    }
    uint64_t row = (uint64_t)width * channels;
    if (row >= INT32_MAX || (row + 1) > (uint64_t)(INT32_MAX / 2) / height) {
        return lrcsi_host_fail(error, LRCS_E_LIMIT, "a picture of %lu x %lu pixels is too large",
                               (unsigned long)width, (unsigned long)height);
    }
    size_t size = (size_t)((row + 1) * height);
    size_t room = size + size / 8 + 64; /* no symbol of one byte is longer than nine bits */
    unsigned char *raw = malloc(size + room);
    if (!raw) {
        return lrcsi_host_fail_memory(error, size + room);
    }
    rows_copy(raw, pixels, height, (size_t)row);
    bit_writer bits = {raw + size, 0, 0, 0};
    put_bits(&bits, 0x0178, 16); /* zlib: deflate, 32 KiB window, no dictionary (RFC 1950) */
    deflate_bytes(&bits, raw, size, channels, (size_t)row + 1);
    big_endian(adler32(raw, size), bits.bytes + bits.used);
    unsigned char head[13] = {0};
    big_endian(width, head);
    big_endian(height, head + 4);
    head[8] = 8;
    head[9] = colour[channels];
    fwrite(signature, 1, sizeof signature, out);
    chunk_write(out, "IHDR", head, sizeof head);
    if (about) {
        comment_write(out, about);
    }
    chunk_write(out, "IDAT", bits.bytes, bits.used + 4);
    chunk_write(out, "IEND", head, 0);
    free(raw);
    return LRCS_OK;
}
