/* SPDX-License-Identifier: MIT */
/* Wavefront OBJ. The same pass over the statements serves both calls: it counts, and if it is given
   a mesh to fill, it also stores. lrcs_obj_read counts first, so any failure occurs before memory
   is allocated. It decides what facets, parts and materials a file holds; the material library is
   another file, read by mtl.c. */
#include "base/constant.h"
#include "base/text.h"
#include "base/where.h"
#include "base/work.h"
#include "mesh/read/lines.h"
#include "mesh/read/name_list.h"
#include "mesh/store.h"

#include <lrcs/read.h>

#include <math.h>
#include <string.h>

#define OBJ_COUNT_MAX (UINT32_MAX - 1)
#define NO_INDEX      INT64_MAX

/* A name that later facets belong to; it counts once a facet does. */
typedef struct obj_name {
    const char *bytes;
    size_t size;
    uint32_t index;
    int pending; /* 1: no facet yet since the statement */
} obj_name;

typedef struct obj_walk {
    lrcsi_lines lines;
    lrcs_where *where;
    lrcs_mesh_counts counts;
    uint32_t vertex_limit, normal_limit; /* positive indices are at most this */
    uint32_t vertex_max, normal_max;     /* the largest positive index so far */
    uint32_t notices;
    uint32_t smooth;
    obj_name part, material, library;
    /* Only if a mesh is filled. */
    lrcs_mesh *mesh;
    lrcsi_name_list parts, materials;
    char *text;
} obj_walk;

static int obj_fail(obj_walk *w, int status, const char *item, const char *expected)
{
    return lrcsi_lines_fail(&w->lines, status, item, expected, w->where);
}

/* Reads the name that an `o`, `g` or `usemtl` statement gives to later facets. */
static void set_name(obj_walk *w, obj_name *name)
{
    name->size = lrcsi_lines_name(&w->lines, &name->bytes);
    name->pending = 1;
}

/* The bytes of text that a name takes; adds a notice if it is not UTF-8. */
static size_t name_text(obj_walk *w, const obj_name *name)
{
    if (!lrcsi_text_is_utf8(name->bytes, name->size)) {
        w->notices |= LRCS_MESH_LATIN1_NAMES;
    }
    return lrcsi_text_utf8(name->bytes, name->size, NULL);
}

/* The first facet after an `o` or `g` statement, or of the file. */
static void enter_part(obj_walk *w)
{
    w->part.pending = 0;
    w->counts.parts++;
    w->counts.text_bytes += name_text(w, &w->part);
    if (w->mesh) {
        w->part.index = lrcsi_name_list_add(&w->parts, w->part.bytes, w->part.size, &w->text);
    }
}

/* The first facet after a `usemtl` statement. */
static void enter_material(obj_walk *w)
{
    w->material.pending = 0;
    w->material.index = LRCS_NONE;
    if (w->material.size == 0) {
        return;
    }
    w->counts.materials++;
    w->counts.text_bytes += name_text(w, &w->material);
    if (w->mesh) {
        w->material.index =
            lrcsi_name_list_add(&w->materials, w->material.bytes, w->material.size, &w->text);
    }
}

static int add_facet(obj_walk *w, const lrcs_facet *corner, const lrcs_facet *normal)
{
    if (w->counts.facets == OBJ_COUNT_MAX) {
        return obj_fail(w, LRCS_E_LIMIT, "facets", "fewer than 2^32 - 1");
    }
    if (w->part.pending) {
        enter_part(w);
    }
    if (w->material.pending) {
        enter_material(w);
    }
    if (w->mesh) {
        uint32_t i = w->counts.facets;
        w->mesh->facet[i] = *corner;
        if (w->mesh->facet_normal) {
            w->mesh->facet_normal[i] = *normal;
        }
        w->mesh->facet_material[i] = w->material.index;
        w->mesh->facet_part[i] = w->part.index;
        w->mesh->facet_smooth[i] = w->smooth;
    }
    w->counts.facets++;
    return LRCS_OK;
}

/* Three coordinates and, unused, a weight or a colour, added as one more of `count` points. */
static int read_point(obj_walk *w, const char *item, lrcs_point *points, uint32_t *count)
{
    lrcs_point point;
    for (int k = 0; k < 3; k++) {
        lrcsi_lines from = w->lines;
        int status = lrcsi_lines_number(&w->lines, item, &point.x[k], w->where);
        if (status != LRCS_OK) {
            return status;
        }
        if (fabs(point.x[k]) > LRCSI_COORDINATE_MAX) {
            w->lines = from;
            return obj_fail(w, LRCS_E_NUMBER, item, "a magnitude of at most 1e100");
        }
    }
    while (!lrcsi_lines_done(&w->lines)) {
        double ignored = 0.0;
        int status = lrcsi_lines_number(&w->lines, item, &ignored, w->where);
        if (status != LRCS_OK) {
            return status;
        }
    }
    if (*count == OBJ_COUNT_MAX) {
        return obj_fail(w, LRCS_E_LIMIT, item, "fewer than 2^32 - 1");
    }
    if (points) {
        points[*count] = point;
    }
    (*count)++;
    return LRCS_OK;
}

/* An integer at `at`, saturated far beyond any index. Returns the end of it, or NULL if there is
   none. */
static const char *read_integer(const char *at, const char *end, int64_t *value)
{
    int negative = at < end && *at == '-';
    at += at < end && (*at == '-' || *at == '+');
    if (at == end || *at < '0' || *at > '9') {
        return NULL;
    }
    int64_t magnitude = 0;
    for (; at < end && *at >= '0' && *at <= '9'; at++) {
        magnitude = magnitude < INT64_C(1) << 40 ? magnitude * 10 + (*at - '0') : magnitude;
    }
    *value = negative ? -magnitude : magnitude;
    return at;
}

/* The indices of "v", "v/t", "v//n" or "v/t/n", those that are missing are not changed. Returns 0
   if the word has none of these forms. */
static int parse_corner(const char *word, size_t size, int64_t index[3])
{
    const char *end = word + size;
    const char *at = read_integer(word, end, &index[0]);
    for (int k = 1; at && at < end && *at == '/' && k < 3; k++) {
        const char *after = read_integer(at + 1, end, &index[k]);
        at = after ? after : at + 1;
    }
    return at == end;
}

/* Converts an index in the file to one in a list that has `count` items so far. Returns 0 if there
   is no such item. */
static int resolve_index(int64_t index, uint32_t count, uint32_t limit, uint32_t *index_max,
                         uint32_t *place)
{
    if (index == 0 || index > limit || -index > (int64_t)count) {
        return 0;
    }
    *place = (uint32_t)(index > 0 ? index - 1 : (int64_t)count + index);
    *index_max = *place >= *index_max ? *place + 1 : *index_max;
    return 1;
}

/* Reports an index of an item that does not exist, and how many there are: so far for an index that
   counts back, else in the file once that is known. */
static int refuse_index(obj_walk *w, const lrcsi_lines *from, int64_t index, uint32_t count,
                        uint32_t limit, const char *item)
{
    w->lines = *from;
    int status = obj_fail(w, LRCS_E_INDEX, item,
                          index < 0 ? "at most as far back as there are of its kind above"
                                    : "an index from 1 to the number of its kind");
    if (index < 0 || (index > 0 && limit < OBJ_COUNT_MAX)) {
        lrcsi_where_add(w->where, " with ");
        lrcsi_where_add_number(w->where, index < 0 ? count : limit);
        lrcsi_where_add(w->where, index < 0 ? " above" : " in the file");
    }
    return status;
}

/* A corner of a face: the indices of its vertex and, if it has one, its normal. */
static int read_corner(obj_walk *w, uint32_t *corner, uint32_t *normal)
{
    lrcsi_lines from = w->lines;
    const char *word = NULL;
    size_t size = lrcsi_lines_word(&w->lines, &word);
    int64_t index[3] = {0, 0, NO_INDEX};
    if (!parse_corner(word, size, index)) {
        w->lines = from;
        return obj_fail(w, LRCS_E_SYNTAX, "face corner", "v, v/t, v//n or v/t/n");
    }
    if (!resolve_index(index[0], w->counts.vertices, w->vertex_limit, &w->vertex_max, corner)) {
        return refuse_index(w, &from, index[0], w->counts.vertices, w->vertex_limit, "face corner");
    }
    *normal = LRCS_NONE;
    if (index[2] != NO_INDEX &&
        !resolve_index(index[2], w->counts.normals, w->normal_limit, &w->normal_max, normal)) {
        return refuse_index(w, &from, index[2], w->counts.normals, w->normal_limit,
                            "normal of a face corner");
    }
    return LRCS_OK;
}

/* Reads a polygon as a fan of facets around its first vertex. */
static int read_face(obj_walk *w)
{
    lrcs_facet corner = {{0, 0, 0}};
    lrcs_facet normal = {{LRCS_NONE, LRCS_NONE, LRCS_NONE}};
    int count = 0; /* stays at 3 */
    while (!lrcsi_lines_done(&w->lines)) {
        int k = count < 2 ? count : 2;
        int status = read_corner(w, &corner.corner[k], &normal.corner[k]);
        if (status == LRCS_OK && k == 2) {
            status = add_facet(w, &corner, &normal);
            corner.corner[1] = corner.corner[2];
            normal.corner[1] = normal.corner[2];
        }
        if (status != LRCS_OK) {
            return status;
        }
        count = k + 1;
    }
    return count == 3 ? LRCS_OK : obj_fail(w, LRCS_E_SYNTAX, "face", "at least three vertices");
}

/* Group N is bit N - 1; beyond 32 groups the bits are used again. */
static int read_smooth(obj_walk *w)
{
    lrcsi_lines from = w->lines;
    const char *word = NULL;
    size_t size = lrcsi_lines_word(&w->lines, &word);
    int64_t group = 0;
    if (size == 0 || lrcsi_lines_is(word, size, "off")) {
        group = 0;
    } else if (lrcsi_lines_is(word, size, "on")) {
        group = 1;
    } else if (read_integer(word, word + size, &group) != word + size || group < 0) {
        w->lines = from;
        return obj_fail(w, LRCS_E_SYNTAX, "smoothing group", "off or a number from 0");
    }
    w->smooth = group > 0 ? UINT32_C(1) << ((group - 1) % 32) : 0;
    return LRCS_OK;
}

/* The first file that `mtllib` names. The name ends at ".mtl", so that it may contain blanks and
   the line may hold several names; without ".mtl" it ends with the line. */
static void read_library(obj_walk *w)
{
    if (w->library.size > 0) {
        return;
    }
    obj_name *name = &w->library;
    name->size = lrcsi_lines_name(&w->lines, &name->bytes);
    for (size_t i = 4; i < name->size; i++) {
        const char *c = name->bytes + i - 4;
        if (c[0] == '.' && (c[1] | 0x20) == 'm' && (c[2] | 0x20) == 't' && (c[3] | 0x20) == 'l' &&
            (c[4] == ' ' || c[4] == '\t')) {
            name->size = i;
        }
    }
    if (name->size > 0) {
        w->counts.text_bytes += name_text(w, name);
    }
}

static int read_statement(obj_walk *w)
{
    const char *word = NULL;
    size_t size = lrcsi_lines_word(&w->lines, &word);
    if (lrcsi_lines_is(word, size, "v")) {
        return read_point(w, "vertex coordinate", w->mesh ? w->mesh->vertex : NULL,
                          &w->counts.vertices);
    }
    if (lrcsi_lines_is(word, size, "vn")) {
        return read_point(w, "vertex normal", w->mesh ? w->mesh->normal : NULL, &w->counts.normals);
    }
    if (lrcsi_lines_is(word, size, "f")) {
        return read_face(w);
    }
    if (lrcsi_lines_is(word, size, "s")) {
        return read_smooth(w);
    }
    if (lrcsi_lines_is(word, size, "o") || lrcsi_lines_is(word, size, "g")) {
        set_name(w, &w->part);
    } else if (lrcsi_lines_is(word, size, "usemtl")) {
        set_name(w, &w->material);
    } else if (lrcsi_lines_is(word, size, "mtllib")) {
        read_library(w);
    }
    return LRCS_OK;
}

static int walk_statements(obj_walk *w)
{
    int status = LRCS_OK;
    do {
        status = read_statement(w);
    } while (status == LRCS_OK && lrcsi_lines_next(&w->lines));
    return status;
}

static obj_walk obj_walk_make(const void *bytes, size_t size, lrcs_where *where)
{
    obj_walk w;
    memset(&w, 0, sizeof w);
    w.lines = lrcsi_lines_make(bytes, size);
    w.where = where;
    w.vertex_limit = OBJ_COUNT_MAX;
    w.normal_limit = OBJ_COUNT_MAX;
    w.part.bytes = "";
    w.part.pending = 1;
    w.material.index = LRCS_NONE;
    w.mesh = NULL;
    return w;
}

int lrcs_obj_count(const void *bytes, size_t size, lrcs_mesh_counts *counts, lrcs_where *where)
{
    if (size == 0) {
        return lrcsi_where_text(where, LRCS_E_EMPTY, 0, 1, "file", "OBJ statements", "0 bytes", 7);
    }
    obj_walk w = obj_walk_make(bytes, size, where);
    int status = walk_statements(&w);
    if (status == LRCS_OK &&
        (w.vertex_max > w.counts.vertices || w.normal_max > w.counts.normals)) {
        lrcs_mesh_counts limit = w.counts;
        w = obj_walk_make(bytes, size, where); /* once more, to stop at the first such index */
        w.vertex_limit = limit.vertices;
        w.normal_limit = limit.normals;
        status = walk_statements(&w);
    }
    if (status == LRCS_OK) {
        *counts = w.counts;
    }
    return status;
}

/* The mesh's blocks and, only while it is read, the tables of names. */
static int obj_take(obj_walk *w, const lrcs_mesh_counts *counts, lrcs_work *work, lrcs_mesh *mesh,
                    size_t *kept)
{
    int status = lrcsi_store_take(counts, work, mesh, &w->text);
    if (status != LRCS_OK) {
        return status;
    }
    *kept = work->used;
    const char **name = lrcsi_work_take(work, counts->materials, sizeof *name);
    status =
        name ? lrcsi_name_list_make(name, counts->materials, work, &w->materials) : LRCS_E_MEMORY;
    if (status == LRCS_OK) {
        status = lrcsi_name_list_make(mesh->part, counts->parts, work, &w->parts);
    }
    w->mesh = mesh;
    return status;
}

/* Completes the mesh: names, and the numbers of distinct materials and parts. */
static void obj_finish(obj_walk *w)
{
    lrcs_mesh *mesh = w->mesh;
    for (uint32_t i = 0; i < w->materials.index.count; i++) {
        mesh->material[i].name = w->materials.name[i];
    }
    mesh->material_count = w->materials.index.count;
    mesh->part_count = w->parts.index.count;
    mesh->notices = w->notices;
    if (w->library.size > 0) {
        mesh->material_file = w->text;
        lrcsi_text_utf8(w->library.bytes, w->library.size, w->text);
    }
}

int lrcs_obj_read(const void *bytes, size_t size, lrcs_work *work, lrcs_mesh *mesh,
                  lrcs_where *where)
{
    lrcs_mesh_counts counts = {0};
    int status = lrcs_obj_count(bytes, size, &counts, where);
    if (status != LRCS_OK) {
        return status;
    }
    size_t mark = work->used;
    size_t kept = mark;
    lrcs_mesh made;
    obj_walk w = obj_walk_make(bytes, size, where);
    status = obj_take(&w, &counts, work, &made, &kept);
    if (status != LRCS_OK) {
        work->used = mark;
        return lrcsi_where_number(where, status, 0, 0, "work area", "lrcs_mesh_need bytes",
                                  work->size - mark);
    }
    walk_statements(&w); /* succeeds, as it did when it counted */
    obj_finish(&w);
    work->used = kept;
    *mesh = made;
    return LRCS_OK;
}
