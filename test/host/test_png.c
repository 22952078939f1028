/* SPDX-License-Identifier: MIT */
/* PNG: what is written is inflated here by a decoder of its own, small and strict, for the one
   block kind that the writer uses; test_png.sh asks Python's zlib the same. */
#include <lrcs/host.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"

typedef struct reader {
    const unsigned char *bytes;
    size_t size, bit;
} reader;

static unsigned take(reader *in, unsigned count)
{
    unsigned value = 0;
    for (unsigned i = 0; i < count; i++, in->bit++) {
        assert_true(in->bit / 8 < in->size);
        value |= (unsigned)(in->bytes[in->bit / 8] >> (in->bit % 8) & 1) << i;
    }
    return value;
}

/* The fixed literal and length code, bit by bit (RFC 1951, 3.2.6). */
static unsigned symbol_take(reader *in)
{
    unsigned code = 0;
    for (unsigned length = 1; length <= 9; length++) {
        code = code << 1 | take(in, 1);
        if (length == 7 && code <= 0x17) {
            return 256 + code;
        }
        if (length == 8 && code >= 0x30 && code <= 0xbf) {
            return code - 0x30;
        }
        if (length == 8 && code >= 0xc0 && code <= 0xc7) {
            return 280 + code - 0xc0;
        }
        if (length == 9 && code >= 0x190) {
            return 144 + code - 0x190;
        }
    }
    fail_msg("no such code");
    return 0;
}

static size_t inflate_fixed(reader *in, unsigned char *out, size_t room)
{
    static const unsigned length_base[] = {3,  4,  5,  6,   7,   8,   9,   10,  11, 13,
                                           15, 17, 19, 23,  27,  31,  35,  43,  51, 59,
                                           67, 83, 99, 115, 131, 163, 195, 227, 258};
    static const unsigned length_bits[] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                           2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
    static const unsigned distance_base[] = {
        1,   2,   3,   4,   5,   7,    9,    13,   17,   25,   33,   49,   65,    97,    129,
        193, 257, 385, 513, 769, 1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
    size_t used = 0;
    assert_int_equal(take(in, 1), 1);
    assert_int_equal(take(in, 2), 1);
    for (unsigned symbol = symbol_take(in); symbol != 256; symbol = symbol_take(in)) {
        if (symbol < 256) {
            assert_true(used < room);
            out[used++] = (unsigned char)symbol;
            continue;
        }
        assert_true(symbol <= 285);
        size_t length = length_base[symbol - 257] + take(in, length_bits[symbol - 257]);
        unsigned code = 0;
        for (int i = 0; i < 5; i++) {
            code = code << 1 | take(in, 1);
        }
        assert_true(code < 30);
        size_t distance = distance_base[code] + take(in, code < 4 ? 0 : code / 2 - 1);
        assert_true(distance <= used && used + length <= room);
        for (; length > 0; length--, used++) {
            out[used] = out[used - distance];
        }
    }
    return used;
}

static unsigned big_read(const unsigned char *bytes)
{
    return (unsigned)bytes[0] << 24 | (unsigned)bytes[1] << 16 | (unsigned)bytes[2] << 8 | bytes[3];
}

/* CRC-32 a bit at a time, as the standard defines it. */
static unsigned crc_slow(const unsigned char *bytes, size_t size)
{
    unsigned crc = 0xffffffffu;
    for (size_t i = 0; i < size * 8; i++) {
        unsigned low = (crc ^ (unsigned)(bytes[i / 8] >> (i % 8))) & 1u;
        crc = crc >> 1 ^ (low ? 0xedb88320u : 0);
    }
    return crc ^ 0xffffffffu;
}

/* Writes, reads back and compares; the size of the file. */
static size_t round_trip(const unsigned char *pixels, unsigned width, unsigned height,
                         unsigned channels)
{
    FILE *file = tmpfile();
    assert_non_null(file);
    assert_int_equal(lrcs_host_png_write(file, pixels, width, height, channels, NULL, NULL),
                     LRCS_OK);
    size_t size = (size_t)ftell(file);
    unsigned char *bytes = malloc(size);
    rewind(file);
    assert_int_equal(fread(bytes, 1, size, file), size);
    fclose(file);
    assert_memory_equal(bytes, "\x89PNG\r\n\x1a\n", 8);
    assert_int_equal(big_read(bytes + 16), width);
    assert_int_equal(big_read(bytes + 20), height);
    size_t at = 8;
    while (at < size) {
        unsigned length = big_read(bytes + at);
        assert_true(at + 12 + length <= size);
        assert_int_equal(crc_slow(bytes + at + 4, length + 4), big_read(bytes + at + 8 + length));
        if (memcmp(bytes + at + 4, "IDAT", 4) == 0) {
            size_t row = (size_t)width * channels;
            size_t room = (row + 1) * height;
            unsigned char *raw = malloc(room);
            reader in = {bytes + at + 10, length - 6, 0};
            assert_int_equal((bytes[at + 8] * 256 + bytes[at + 9]) % 31, 0);
            assert_int_equal(inflate_fixed(&in, raw, room), room);
            for (unsigned y = 0; y < height; y++) {
                assert_int_equal(raw[y * (row + 1)], 0);
                assert_memory_equal(raw + y * (row + 1) + 1, pixels + y * row, row);
            }
            free(raw);
        }
        at += 12 + length;
    }
    assert_int_equal(at, size);
    free(bytes);
    return size;
}

static void noise_of_every_kind_comes_back(void **state)
{
    (void)state;
    unsigned char pixels[61 * 37 * 4];
    unsigned seed = 1;
    for (size_t i = 0; i < sizeof pixels; i++) {
        seed = seed * 1103515245u + 12345u;
        pixels[i] = (unsigned char)(seed >> 16);
    }
    for (unsigned channels = 1; channels <= 4; channels++) {
        round_trip(pixels, 61, 37, channels);
    }
}

static void runs_of_every_length_come_back(void **state)
{
    (void)state;
    static unsigned char pixels[300 * 301];
    for (size_t y = 0; y < 301; y++) {
        for (size_t x = 0; x < 300; x++) {
            pixels[y * 300 + x] = (unsigned char)(x < y ? 7 : (x * 31 + y * 17) % 251);
        }
    }
    round_trip(pixels, 300, 301, 1);
    round_trip(pixels, 1, 300, 1);
    round_trip(pixels, 300, 1, 1);
    round_trip(pixels, 1, 1, 3);
}

static void a_wide_row_beyond_the_window_comes_back(void **state)
{
    (void)state;
    unsigned char *pixels = calloc(40000, 3);
    for (size_t i = 0; i < 120000; i += 97) {
        pixels[i] = (unsigned char)i;
    }
    round_trip(pixels, 20000, 2, 3);
    free(pixels);
}

static void a_flat_picture_is_small(void **state)
{
    (void)state;
    unsigned char *pixels = malloc(512 * 512 * 3);
    memset(pixels, 40, 512 * 512 * 3);
    assert_true(round_trip(pixels, 512, 512, 3) < 12000);
    free(pixels);
}

static void a_picture_of_no_size_is_refused(void **state)
{
    (void)state;
    unsigned char pixel[4] = {0};
    lrcs_host_error error;
    assert_int_equal(lrcs_host_png_write(stdout, pixel, 0, 1, 3, NULL, &error), LRCS_E_ARGUMENT);
    assert_int_equal(lrcs_host_png_write(stdout, pixel, 1, 1, 5, NULL, &error), LRCS_E_ARGUMENT);
    assert_int_equal(lrcs_host_png_write(stdout, pixel, UINT32_MAX, UINT32_MAX, 4, NULL, &error),
                     LRCS_E_LIMIT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(noise_of_every_kind_comes_back),
        cmocka_unit_test(runs_of_every_length_come_back),
        cmocka_unit_test(a_wide_row_beyond_the_window_comes_back),
        cmocka_unit_test(a_flat_picture_is_small),
        cmocka_unit_test(a_picture_of_no_size_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
