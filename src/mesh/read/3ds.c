/* SPDX-License-Identifier: MIT */
/* Reads 3D Studio files: the root, the editor section, the objects in it. It decides the order in
   which items are read (materials first, wherever they are in the file) and ignores animation. Each
   level of the tree has one function; there is no recursion for any input. */
#include <lrcs/read.h>

#include "base/bytes.h"
#include "base/where.h"
#include "base/work.h"
#include "mesh/read/3ds.h"

/* A named object: meshes are read, lights and cameras are skipped. The name is stored once even if
   the object has several meshes, so that a long name is not stored once per mesh. */
static int tds_read_object(lrcsi_tds_walk *walk, lrcsi_tds_chunk object)
{
    lrcsi_span name;
    int next = lrcsi_tds_name(walk, &object, &name, "object name");
    if (next != LRCS_OK) {
        return next;
    }
    const char *text = NULL;
    int stored = 0;
    lrcsi_tds_chunk chunk;
    while ((next = lrcsi_tds_next(walk, &object, &chunk)) > 0) {
        if (chunk.id != LRCSI_TDS_TRIMESH) {
            continue;
        }
        text = stored ? text : lrcsi_tds_store_name(walk, name);
        stored = 1;
        int status = lrcsi_tds_read_trimesh(walk, chunk, text);
        if (status != LRCS_OK) {
            return status;
        }
    }
    return next;
}

/* Materials may follow the objects that use them, so the editor section is read twice. */
static int tds_read_editor(lrcsi_tds_walk *walk, lrcsi_tds_chunk editor, unsigned id)
{
    lrcsi_tds_chunk chunk;
    int next;
    while ((next = lrcsi_tds_next(walk, &editor, &chunk)) > 0) {
        int status = LRCS_OK;
        if (chunk.id == id) {
            status = id == LRCSI_TDS_OBJECT ? tds_read_object(walk, chunk)
                                            : lrcsi_tds_read_material(walk, chunk);
        }
        if (status != LRCS_OK) {
            return status;
        }
    }
    return next;
}

static int tds_read_keyframer(lrcsi_tds_walk *walk, lrcsi_tds_chunk keyframer)
{
    lrcsi_tds_chunk chunk;
    int next;
    while ((next = lrcsi_tds_next(walk, &keyframer, &chunk)) > 0) {
        if (chunk.id >= LRCSI_TDS_FIRST_NODE && chunk.id <= LRCSI_TDS_LAST_NODE) {
            walk->notices |= LRCS_MESH_KEYFRAMER;
        }
    }
    return next;
}

/* All chunks of one kind (LRCSI_TDS_MATERIAL or LRCSI_TDS_OBJECT) in the file. */
static int tds_read_all(lrcsi_tds_walk *walk, lrcsi_tds_chunk root, unsigned id)
{
    lrcsi_tds_chunk chunk;
    int next;
    while ((next = lrcsi_tds_next(walk, &root, &chunk)) > 0) {
        int status = LRCS_OK;
        if (chunk.id == LRCSI_TDS_EDITOR) {
            status = tds_read_editor(walk, chunk, id);
        } else if (chunk.id == LRCSI_TDS_KEYFRAMER) {
            status = tds_read_keyframer(walk, chunk);
        }
        if (status != LRCS_OK) {
            return status;
        }
    }
    return next;
}

/* The root. A length that exceeds the file, and bytes after the root, are reported as notices. */
static int tds_find_root(lrcsi_tds_walk *walk, lrcsi_tds_chunk *root)
{
    if (walk->size == 0) {
        return lrcsi_where_text(walk->where, LRCS_E_EMPTY, 0, 0, "file", "a 3DS file", "0 bytes",
                                7);
    }
    if (walk->size < 6) {
        return lrcsi_tds_fail(walk, LRCS_E_TRUNCATED, 0, "chunk header", "6 bytes", walk->size);
    }
    if (lrcsi_bytes_u16(walk->bytes) != LRCSI_TDS_ROOT) {
        return lrcsi_where_text(walk->where, LRCS_E_SYNTAX, 0, 0, "file", "chunk 0x4D4D (\"MM\")",
                                (const char *)walk->bytes, 2);
    }
    uint32_t length = lrcsi_bytes_u32(walk->bytes + 2);
    if (length < 6) {
        return lrcsi_tds_fail(walk, LRCS_E_SYNTAX, 2, "length of the root chunk", "at least 6",
                              length);
    }
    walk->truncated = length > walk->size;
    if (length != walk->size) {
        walk->notices |= LRCS_MESH_TRAILING_BYTES;
    }
    *root = (lrcsi_tds_chunk){LRCSI_TDS_ROOT, 6, walk->truncated ? walk->size : length};
    return LRCS_OK;
}

static int tds_count_all(lrcsi_tds_walk *walk, lrcsi_tds_chunk *root)
{
    int status = tds_find_root(walk, root);
    if (status == LRCS_OK) {
        status = tds_read_all(walk, *root, LRCSI_TDS_MATERIAL);
    }
    return status == LRCS_OK ? tds_read_all(walk, *root, LRCSI_TDS_OBJECT) : status;
}

int lrcs_3ds_count(const void *bytes, size_t size, lrcs_mesh_counts *counts, lrcs_where *where)
{
    lrcsi_tds_walk walk = {.bytes = bytes, .size = size, .where = where};
    lrcsi_tds_chunk root;
    int status = tds_count_all(&walk, &root);
    if (status == LRCS_OK) {
        *counts = walk.counts;
    }
    return status;
}

/* The second pass: fills the blocks whose sizes the first pass has counted. The scratch is
   released. */
static int tds_fill(lrcsi_tds_walk *walk, lrcsi_tds_chunk root, lrcs_work *work)
{
    size_t mark = work->used;
    uint32_t materials = walk->mesh->material_count;
    int status = lrcsi_index_make(work, materials, &walk->names);
    if (status == LRCS_OK) {
        uint32_t facets = walk->mesh->facet_count;
        walk->undefined = lrcsi_work_take_zero(work, facets, sizeof *walk->undefined);
        status = walk->undefined ? LRCS_OK : LRCS_E_MEMORY;
    }
    if (status == LRCS_OK) {
        status = tds_read_all(walk, root, LRCSI_TDS_MATERIAL);
    }
    if (status == LRCS_OK) {
        status = tds_read_all(walk, root, LRCSI_TDS_OBJECT);
    }
    work->used = mark;
    return status;
}

int lrcs_3ds_read(const void *bytes, size_t size, lrcs_work *work, lrcs_mesh *mesh,
                  lrcs_where *where)
{
    lrcsi_tds_walk count = {.bytes = bytes, .size = size, .where = where};
    lrcsi_tds_chunk root;
    int status = tds_count_all(&count, &root);
    if (status != LRCS_OK) {
        return status;
    }
    size_t mark = work->used;
    lrcs_mesh made;
    lrcsi_tds_walk walk = {
        .bytes = bytes, .size = size, .truncated = count.truncated, .where = where};
    walk.notices = count.notices;
    status = lrcsi_store_take(&count.counts, work, &made, &walk.text);
    if (status == LRCS_OK) {
        walk.mesh = &made;
        status = tds_fill(&walk, root, work);
    }
    if (status != LRCS_OK) {
        work->used = mark;
        return lrcsi_where_text(where, status, 0, 0, "work area", "lrcs_mesh_need bytes", "", 0);
    }
    made.notices = walk.notices;
    *mesh = made;
    return LRCS_OK;
}
