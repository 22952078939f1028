/* SPDX-License-Identifier: MIT */
/* Builds 3DS files in memory, chunk by chunk, for tests. */
#ifndef TEST_BUILD3DS_H
#define TEST_BUILD3DS_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "check.h"

typedef struct build3ds {
    unsigned char bytes[1 << 20];
    size_t size;
    size_t open[16]; /* starts of the chunks not closed yet */
    int depth;
} build3ds;

static inline void build3ds_u8(build3ds *b, unsigned value)
{
    assert_true(b->size < sizeof b->bytes);
    b->bytes[b->size++] = (unsigned char)value;
}

static inline void build3ds_u16(build3ds *b, unsigned value)
{
    build3ds_u8(b, value & 0xff);
    build3ds_u8(b, value >> 8);
}

static inline void build3ds_u32(build3ds *b, uint32_t value)
{
    build3ds_u16(b, value & 0xffff);
    build3ds_u16(b, value >> 16);
}

static inline void build3ds_float(build3ds *b, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    build3ds_u32(b, bits);
}

/* A name and its terminator. */
static inline void build3ds_name(build3ds *b, const char *name)
{
    for (size_t i = 0; i <= strlen(name); i++) {
        build3ds_u8(b, (unsigned char)name[i]);
    }
}

/* Overwrites four bytes. */
static inline void build3ds_put(build3ds *b, size_t at, uint32_t value)
{
    for (size_t i = 0; i < 4; i++) {
        b->bytes[at + i] = (unsigned char)(value >> 8 * i);
    }
}

static inline void build3ds_open(build3ds *b, unsigned id)
{
    b->open[b->depth++] = b->size;
    build3ds_u16(b, id);
    build3ds_u32(b, 0);
}

static inline void build3ds_close(build3ds *b)
{
    size_t start = b->open[--b->depth];
    build3ds_put(b, start + 2, (uint32_t)(b->size - start));
}

/* The root and the editor section; build3ds_end closes what is open. */
static inline void build3ds_begin(build3ds *b)
{
    b->size = 0;
    b->depth = 0;
    build3ds_open(b, 0x4d4d);
    build3ds_open(b, 0x3d3d);
}

static inline void build3ds_end(build3ds *b)
{
    while (b->depth > 0) {
        build3ds_close(b);
    }
}

/* An object with a mesh in it, both left open. */
static inline void build3ds_mesh(build3ds *b, const char *name)
{
    build3ds_open(b, 0x4000);
    build3ds_name(b, name);
    build3ds_open(b, 0x4100);
}

static inline void build3ds_mesh_end(build3ds *b)
{
    build3ds_close(b);
    build3ds_close(b);
}

/* Four corners of the unit square, at a height. */
static inline void build3ds_square(build3ds *b, float z)
{
    build3ds_open(b, 0x4110);
    build3ds_u16(b, 4);
    for (unsigned i = 0; i < 4; i++) {
        build3ds_float(b, i == 1 || i == 2 ? 1.0f : 0.0f);
        build3ds_float(b, i >= 2 ? 1.0f : 0.0f);
        build3ds_float(b, z);
    }
    build3ds_close(b);
}

/* The square's two faces; the list is left open. */
static inline void build3ds_faces(build3ds *b)
{
    static const unsigned corner[2][3] = {{0, 1, 2}, {0, 2, 3}};
    build3ds_open(b, 0x4120);
    build3ds_u16(b, 2);
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 3; k++) {
            build3ds_u16(b, corner[i][k]);
        }
        build3ds_u16(b, 7); /* edge flags */
    }
}

/* A material group of `count` faces from `first`. */
static inline void build3ds_group(build3ds *b, const char *name, unsigned first, unsigned count)
{
    build3ds_open(b, 0x4130);
    build3ds_name(b, name);
    build3ds_u16(b, count);
    for (unsigned i = 0; i < count; i++) {
        build3ds_u16(b, first + i);
    }
    build3ds_close(b);
}

/* A smoothing mask for each of two faces. */
static inline void build3ds_smooth(build3ds *b, uint32_t mask0, uint32_t mask1)
{
    build3ds_open(b, 0x4150);
    build3ds_u32(b, mask0);
    build3ds_u32(b, mask1);
    build3ds_close(b);
}

/* A mesh matrix: `scale` times the identity. */
static inline void build3ds_matrix(build3ds *b, float scale)
{
    build3ds_open(b, 0x4160);
    for (int i = 0; i < 12; i++) {
        build3ds_float(b, i < 9 && i % 4 == 0 ? scale : 0.0f);
    }
    build3ds_close(b);
}

static inline void build3ds_colour24(build3ds *b, unsigned id, unsigned red, unsigned green,
                                     unsigned blue)
{
    build3ds_open(b, id);
    build3ds_u8(b, red);
    build3ds_u8(b, green);
    build3ds_u8(b, blue);
    build3ds_close(b);
}

static inline void build3ds_colour_float(build3ds *b, unsigned id, float red, float green,
                                         float blue)
{
    build3ds_open(b, id);
    build3ds_float(b, red);
    build3ds_float(b, green);
    build3ds_float(b, blue);
    build3ds_close(b);
}

/* A material of one 24-bit colour. */
static inline void build3ds_material(build3ds *b, const char *name, unsigned red, unsigned green,
                                     unsigned blue)
{
    build3ds_open(b, 0xafff);
    build3ds_open(b, 0xa000);
    build3ds_name(b, name);
    build3ds_close(b);
    build3ds_open(b, 0xa020);
    build3ds_colour24(b, 0x0011, red, green, blue);
    build3ds_close(b);
    build3ds_close(b);
}

/* A square of one material: a whole object. */
static inline void build3ds_panel(build3ds *b, const char *name, float z, const char *material)
{
    build3ds_mesh(b, name);
    build3ds_square(b, z);
    build3ds_faces(b);
    build3ds_group(b, material, 0, 2);
    build3ds_smooth(b, 1, 0x80000000u);
    build3ds_close(b);
    build3ds_mesh_end(b);
}

#endif
