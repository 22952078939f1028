/* SPDX-License-Identifier: MIT */
/* Reads STL: decides whether a file is binary or text, reads the binary kind (a header of 80 bytes,
   a count, then 50 bytes per facet: normal, three corners, a word without meaning; little-endian
   floats), and welds corners at equal positions into vertices. It trusts the winding; stored
   normals are only compared with it. Source of the format: 3D Systems, StereoLithography Interface
   Specification (1989). */
#include <lrcs/read.h>

#include "mesh/read/stl.h"

#include <math.h>
#include <string.h>

#include "base/bits.h"
#include "base/bytes.h"
#include "base/constant.h"
#include "base/hash.h"
#include "base/text.h"
#include "base/where.h"
#include "base/work.h"
#include "mesh/store.h"

#define STL_COUNT_AT 80u /* in the header */
#define STL_FACET    50u

int lrcsi_stl_is_binary(const unsigned char *bytes, size_t size)
{
    return size >= LRCSI_STL_HEADER && (size - LRCSI_STL_HEADER) % STL_FACET == 0 &&
           (size - LRCSI_STL_HEADER) / STL_FACET == lrcsi_bytes_u32(bytes + STL_COUNT_AT);
}

/* 1 if the stored normal is proved to oppose the corners' winding: n . (e x f) < 0. Each product
   n_i e_j f_k carries at most 7 roundings (two differences, two products, three sums), so the error
   of the sum is at most 8 u times the sum of their magnitudes, u = 2^-53, unless coordinates are so
   small that products underflow. Zero and non-finite normals are ignored. */
static int stl_opposed(double corner[3][3], const double normal[3])
{
    double sum = 0.0;
    double size = 0.0;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        int k = (i + 2) % 3;
        double ej = corner[1][j] - corner[0][j];
        double ek = corner[1][k] - corner[0][k];
        double fj = corner[2][j] - corner[0][j];
        double fk = corner[2][k] - corner[0][k];
        sum += normal[i] * (ej * fk - ek * fj);
        size += fabs(normal[i]) * (fabs(ej * fk) + fabs(ek * fj));
    }
    return sum < -8.0 * LRCSI_U * size;
}

/* The vertex at a position, added if it is new. -0 becomes 0, so that equal positions have equal
   bits. */
static uint32_t stl_weld(lrcsi_stl_walk *walk, const double x[3])
{
    lrcs_mesh *mesh = walk->mesh;
    lrcs_point point;
    uint64_t key = 0;
    for (int k = 0; k < 3; k++) {
        point.x[k] = x[k] + 0.0;
        key = lrcsi_hash_mix(key + lrcsi_bits_of(point.x[k]));
    }
    size_t slot = (size_t)key & (walk->slots - 1);
    while (walk->slot[slot] != LRCS_NONE) {
        uint32_t there = walk->slot[slot];
        const double *y = mesh->vertex[there].x;
        if (y[0] == point.x[0] && y[1] == point.x[1] && y[2] == point.x[2]) {
            return there;
        }
        slot = (slot + 1) & (walk->slots - 1);
    }
    walk->slot[slot] = mesh->vertex_count;
    mesh->vertex[mesh->vertex_count] = point;
    return mesh->vertex_count++;
}

int lrcsi_stl_add(lrcsi_stl_walk *walk, double corner[3][3], const double normal[3])
{
    if (walk->facets >= (LRCS_NONE - 1) / 3) {
        return LRCS_E_LIMIT;
    }
    if (walk->mesh) {
        for (int k = 0; k < 3; k++) {
            walk->mesh->facet[walk->facets].corner[k] = stl_weld(walk, corner[k]);
        }
        if (stl_opposed(corner, normal)) {
            walk->notices |= LRCS_MESH_NORMALS_DISAGREE;
        }
    }
    walk->facets++;
    return LRCS_OK;
}

static int stl_read_facet(lrcsi_stl_walk *walk, size_t at)
{
    const unsigned char *byte = walk->bytes + at;
    double normal[3];
    double corner[3][3];
    for (size_t k = 0; k < 3; k++) {
        normal[k] = lrcsi_bytes_float(byte + 4 * k);
    }
    for (size_t i = 0; i < 9; i++) {
        double value = lrcsi_bytes_float(byte + 12 + 4 * i);
        if (!isfinite(value)) {
            return lrcsi_where_number(walk->where, LRCS_E_NUMBER, at + 12 + 4 * i, 0,
                                      "vertex coordinate", "a finite number (found: its bits)",
                                      lrcsi_bytes_u32(byte + 12 + 4 * i));
        }
        corner[i / 3][i % 3] = value;
    }
    int status = lrcsi_stl_add(walk, corner, normal);
    return status == LRCS_OK ? status
                             : lrcsi_where_number(walk->where, status, at, 0, "facet",
                                                  "fewer than 2^32 / 3 facets", walk->facets);
}

static int stl_read_binary(lrcsi_stl_walk *walk)
{
    if (walk->size < LRCSI_STL_HEADER) {
        lrcsi_where_number(walk->where, LRCS_E_TRUNCATED, 0, 0, "file",
                           "an STL file: text, or a header and a count, 84 bytes", walk->size);
        lrcsi_where_add(walk->where, " bytes");
        return LRCS_E_TRUNCATED;
    }
    uint32_t count = lrcsi_bytes_u32(walk->bytes + STL_COUNT_AT);
    size_t held = (walk->size - LRCSI_STL_HEADER) / STL_FACET;
    if (held < count) {
        lrcsi_where_number(walk->where, LRCS_E_TRUNCATED, STL_COUNT_AT, 0, "facet count",
                           "at most as many facets as the file has bytes for", count);
        lrcsi_where_add(walk->where, " with bytes for ");
        lrcsi_where_add_number(walk->where, held);
        return LRCS_E_TRUNCATED;
    }
    if (!lrcsi_stl_is_binary(walk->bytes, walk->size)) {
        walk->notices |= LRCS_MESH_TRAILING_BYTES;
    }
    int status = LRCS_OK;
    for (size_t i = 0; status == LRCS_OK && i < count; i++) {
        status = stl_read_facet(walk, LRCSI_STL_HEADER + STL_FACET * i);
    }
    return status;
}

static int stl_read_any(lrcsi_stl_walk *walk)
{
    if (walk->size == 0) {
        return lrcsi_where_text(walk->where, LRCS_E_EMPTY, 0, 0, "file", "an STL file", "0 bytes",
                                7);
    }
    if (!lrcsi_stl_is_binary(walk->bytes, walk->size) &&
        lrcsi_stl_is_text(walk->bytes, walk->size)) {
        return lrcsi_stl_read_text(walk);
    }
    return stl_read_binary(walk);
}

static int stl_count_any(lrcsi_stl_walk *walk, lrcs_mesh_counts *counts)
{
    int status = stl_read_any(walk);
    if (status == LRCS_OK) {
        size_t text =
            lrcsi_text_utf8((const char *)walk->bytes + walk->name.at, walk->name.size, NULL);
        *counts = (lrcs_mesh_counts){3 * walk->facets, walk->facets, 0, 1, text, 0};
    }
    return status;
}

int lrcs_stl_count(const void *bytes, size_t size, lrcs_mesh_counts *counts, lrcs_where *where)
{
    lrcsi_stl_walk walk = {.bytes = bytes, .size = size, .where = where};
    return stl_count_any(&walk, counts);
}

static void stl_name_part(lrcsi_stl_walk *walk, lrcs_mesh *mesh, char *text)
{
    const char *name = (const char *)walk->bytes + walk->name.at;
    lrcsi_text_utf8(name, walk->name.size, text);
    mesh->part[0] = text;
    if (!lrcsi_text_is_utf8(name, walk->name.size)) {
        walk->notices |= LRCS_MESH_LATIN1_NAMES;
    }
}

/* Fills the blocks, then releases the table and the unused vertices. */
static int stl_fill(lrcsi_stl_walk *walk, lrcs_mesh *mesh, lrcs_work *work)
{
    walk->slots = lrcsi_hash_slots(mesh->vertex_count);
    walk->slot = lrcsi_work_take(work, walk->slots, sizeof *walk->slot);
    if (!walk->slot) {
        return LRCS_E_MEMORY;
    }
    memset(walk->slot, 0xff, walk->slots * sizeof *walk->slot); /* LRCS_NONE */
    walk->mesh = mesh;
    mesh->vertex_count = 0;
    int status = stl_read_any(walk);
    work->used = (size_t)((unsigned char *)(mesh->vertex + mesh->vertex_count) - work->bytes);
    return status;
}

int lrcs_stl_read(const void *bytes, size_t size, lrcs_work *work, lrcs_mesh *mesh,
                  lrcs_where *where)
{
    lrcsi_stl_walk walk = {.bytes = bytes, .size = size, .where = where};
    lrcs_mesh_counts counts;
    int status = stl_count_any(&walk, &counts);
    if (status != LRCS_OK) {
        return status;
    }
    size_t mark = work->used;
    lrcs_mesh made;
    char *text;
    walk = (lrcsi_stl_walk){.bytes = bytes, .size = size, .where = where, .name = walk.name};
    status = lrcsi_store_take(&counts, work, &made, &text);
    if (status == LRCS_OK) {
        stl_name_part(&walk, &made, text);
        status = stl_fill(&walk, &made, work);
    }
    if (status != LRCS_OK) {
        work->used = mark;
        return lrcsi_where_text(where, status, 0, 0, "work area", "lrcs_mesh_need bytes", "", 0);
    }
    made.notices = walk.notices;
    *mesh = made;
    return LRCS_OK;
}
