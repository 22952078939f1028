/* SPDX-License-Identifier: MIT */
/* Attacks on readers: cut, flipped and inflated bytes, and too little memory. Each input lies in a
   block of exactly its size, so that the address sanitiser sees any access beyond it. A reader must
   return either an error with the place of the fault, or a valid mesh. */
#ifndef TEST_HOSTILE_H
#define TEST_HOSTILE_H

#include <lrcs/read.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "random.h"

typedef struct hostile_reader {
    int (*count)(const void *bytes, size_t size, lrcs_mesh_counts *counts, lrcs_where *where);
    int (*read)(const void *bytes, size_t size, lrcs_work *work, lrcs_mesh *mesh,
                lrcs_where *where);
} hostile_reader;

static inline void check_where(const lrcs_where *where, size_t size)
{
    assert_non_null(where->item);
    assert_non_null(where->expected);
    assert_true(where->offset <= size);
    assert_non_null(memchr(where->found, 0, sizeof where->found));
}

/* What mesh.h promises. */
static inline void check_mesh(const lrcs_mesh *mesh)
{
    for (size_t i = 0; i < 3 * (size_t)mesh->vertex_count; i++) {
        assert_true(fabs(mesh->vertex[i / 3].x[i % 3]) <= 1e100);
    }
    for (size_t i = 0; i < mesh->facet_count; i++) {
        for (int k = 0; k < 3; k++) {
            assert_true(mesh->facet[i].corner[k] < mesh->vertex_count);
            assert_true(!mesh->facet_normal || mesh->facet_normal[i].corner[k] == LRCS_NONE ||
                        mesh->facet_normal[i].corner[k] < mesh->normal_count);
        }
        assert_true(mesh->facet_part[i] < mesh->part_count);
        assert_true(mesh->facet_material[i] == LRCS_NONE ||
                    mesh->facet_material[i] < mesh->material_count);
    }
    for (size_t i = 0; i < mesh->material_count; i++) {
        assert_non_null(mesh->material[i].name);
        assert_true(mesh->material[i].transparency >= 0.0 && mesh->material[i].transparency <= 1.0);
    }
    for (size_t i = 0; i < mesh->part_count; i++) {
        assert_non_null(mesh->part[i]);
    }
}

/* Counts and reads a copy of its own; the status on which both agree. */
static inline int check_read(const hostile_reader *reader, const void *bytes, size_t size)
{
    unsigned char *copy = malloc(size > 0 ? size : 1);
    assert_non_null(copy);
    memcpy(copy, bytes, size);
    lrcs_mesh_counts counts;
    lrcs_where where;
    int status = reader->count(copy, size, &counts, &where);
    size_t need = status == LRCS_OK ? lrcs_mesh_need(&counts) : 64;
    void *area = malloc(need);
    assert_non_null(area);
    lrcs_work work = lrcs_work_make(area, need);
    lrcs_mesh mesh;
    assert_int_equal(reader->read(copy, size, &work, &mesh, &where), status);
    if (status == LRCS_OK) {
        check_mesh(&mesh);
        assert_int_equal(mesh.facet_count, counts.facets);
        assert_int_equal(mesh.material_count, counts.materials);
        assert_int_equal(mesh.part_count, counts.parts);
        assert_true(mesh.vertex_count <= counts.vertices);
    } else {
        check_where(&where, size);
        assert_int_equal(work.used, 0);
    }
    assert_int_equal(reader->count(copy, size, &counts, NULL), status); /* `where` may be NULL */
    free(area);
    free(copy);
    return status;
}

/* The same attacks everywhere. */
static inline uint32_t hostile_random(uint64_t *state)
{
    return (uint32_t)(random_xorshift(state) >> 32);
}

/* Every prefix. */
static inline void attack_by_cutting(const hostile_reader *reader, const void *bytes, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        check_read(reader, bytes, i);
    }
}

/* Every single bit. */
static inline void attack_by_bits(const hostile_reader *reader, const void *bytes, size_t size)
{
    unsigned char *copy = malloc(size);
    assert_non_null(copy);
    memcpy(copy, bytes, size);
    for (size_t i = 0; i < 8 * size; i++) {
        copy[i / 8] ^= (unsigned char)(1u << i % 8);
        check_read(reader, copy, size);
        copy[i / 8] ^= (unsigned char)(1u << i % 8);
    }
    free(copy);
}

/* Replaces one to eight bytes at a time: one in four by a boundary case of lengths and counts, the
   others by random values. */
static inline void attack_by_bytes(const hostile_reader *reader, const void *bytes, size_t size,
                                   int times)
{
    static const unsigned char boundary[] = {0x00, 0x01, 0x05, 0x06, 0x07, 0x7f, 0x80, 0xff};
    uint64_t state = 88172645463325252u;
    unsigned char *copy = malloc(size);
    assert_non_null(copy);
    for (int i = 0; i < times; i++) {
        memcpy(copy, bytes, size);
        uint32_t count = 1 + hostile_random(&state) % 8;
        for (uint32_t k = 0; k < count; k++) {
            uint32_t value = hostile_random(&state);
            size_t at = hostile_random(&state) % size;
            copy[at] = value % 4 == 0 ? boundary[value / 4 % 8] : (unsigned char)(value >> 8);
        }
        check_read(reader, copy, size);
    }
    free(copy);
}

/* Two and four bytes of ones, of the sign bit alone, and of zero, at every place: counts and
   lengths inflated beyond everything. */
static inline void attack_by_inflation(const hostile_reader *reader, const void *bytes, size_t size)
{
    static const unsigned char pattern[][4] = {
        {0xff, 0xff, 0xff, 0xff}, {0, 0, 0, 0x80}, {0xff, 0xff, 0xff, 0x7f}, {0, 0, 0, 0}};
    unsigned char *copy = malloc(size);
    assert_non_null(copy);
    for (size_t i = 0; i + 4 <= size; i++) {
        for (size_t k = 0; k < 8; k++) {
            memcpy(copy, bytes, size);
            memcpy(copy + i, pattern[k / 2], k % 2 ? 4 : 2);
            check_read(reader, copy, size);
        }
    }
    free(copy);
}

/* The work area grows byte by byte until the read succeeds, at the latest at what is needed;
   until then nothing is taken and nothing is touched. */
static inline void attack_by_too_little_memory(const hostile_reader *reader, const void *bytes,
                                               size_t size)
{
    lrcs_mesh_counts counts;
    lrcs_where where;
    assert_int_equal(reader->count(bytes, size, &counts, &where), LRCS_OK);
    size_t need = lrcs_mesh_need(&counts);
    int status = LRCS_E_MEMORY;
    size_t have = 0;
    for (; status != LRCS_OK; have++) {
        assert_true(have <= need);
        unsigned char *area = malloc(have > 0 ? have : 1);
        assert_non_null(area);
        lrcs_work work = lrcs_work_make(area, have);
        lrcs_mesh mesh, before;
        memset(&before, 0x5a, sizeof before);
        memcpy(&mesh, &before, sizeof mesh);
        status = reader->read(bytes, size, &work, &mesh, &where);
        if (status != LRCS_OK) {
            assert_int_equal(status, LRCS_E_MEMORY);
            assert_memory_equal(&mesh, &before, sizeof mesh);
            assert_int_equal(work.used, 0);
            assert_true(work.peak > have);
            check_where(&where, size);
        } else {
            check_mesh(&mesh);
        }
        free(area);
    }
}

#endif
