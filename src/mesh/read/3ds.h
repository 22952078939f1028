/* SPDX-License-Identifier: MIT */
/* The 3DS reader's parts: chunks and the walk over them, materials, meshes. A file is a tree of
   chunks, each an id (2 bytes), a length that includes this header of 6 (4 bytes), and its content,
   little-endian. The same pass serves counting and reading: while it counts, it stores nothing but
   checks everything. Source for the ids: Autodesk, 3D Studio File Toolkit (1996). */
#ifndef LRCSI_3DS_H
#define LRCSI_3DS_H

#include <lrcs/mesh.h>

#include "base/bytes.h"
#include "base/index.h"
#include "mesh/store.h"

enum lrcsi_tds_id {
    LRCSI_TDS_VERSION = 0x0002,
    LRCSI_TDS_COLOUR_FLOAT = 0x0010,
    LRCSI_TDS_COLOUR_24 = 0x0011,
    LRCSI_TDS_COLOUR_24_LINEAR = 0x0012,
    LRCSI_TDS_COLOUR_FLOAT_LINEAR = 0x0013,
    LRCSI_TDS_PERCENT_INT = 0x0030,
    LRCSI_TDS_PERCENT_FLOAT = 0x0031,
    LRCSI_TDS_EDITOR = 0x3d3d,
    LRCSI_TDS_OBJECT = 0x4000,
    LRCSI_TDS_TRIMESH = 0x4100,
    LRCSI_TDS_VERTICES = 0x4110,
    LRCSI_TDS_FACES = 0x4120,
    LRCSI_TDS_GROUP = 0x4130,
    LRCSI_TDS_SMOOTHING = 0x4150,
    LRCSI_TDS_MATRIX = 0x4160,
    LRCSI_TDS_ROOT = 0x4d4d,
    LRCSI_TDS_MATERIAL_NAME = 0xa000,
    LRCSI_TDS_DIFFUSE = 0xa020,
    LRCSI_TDS_TRANSPARENCY = 0xa050,
    LRCSI_TDS_TWO_SIDED = 0xa081,
    LRCSI_TDS_MATERIAL = 0xafff,
    LRCSI_TDS_KEYFRAMER = 0xb000,
    LRCSI_TDS_FIRST_NODE =
        0xb001, /* ambient light, object, camera, target, light, target, spotlight */
    LRCSI_TDS_LAST_NODE = 0xb007
};

/* The part of a chunk that is not yet read. */
typedef struct lrcsi_tds_chunk {
    unsigned id;
    size_t at, end;
} lrcsi_tds_chunk;

typedef struct lrcsi_tds_walk {
    const unsigned char *bytes;
    size_t size;
    int truncated; /* the length of the root chunk exceeds the file */
    lrcs_where *where;
    lrcs_mesh_counts counts;
    uint32_t notices;
    /* NULL while counting: */
    lrcs_mesh *mesh;
    char *text;        /* where the next name goes */
    lrcsi_index names; /* materials by the bytes of their names in the file; of equal names the
                          first */
    unsigned char *undefined; /* facet: 1 if the last of its groups names a material that the file
                                 does not define */
} lrcsi_tds_walk;

/* Records where the reader stopped; returns `status`. */
int lrcsi_tds_fail(const lrcsi_tds_walk *walk, int status, size_t at, const char *item,
                   const char *expected, uint64_t found);

/* Reads the next chunk inside `parent`, which is advanced past it. Returns 1, or 0 at the end, or a
   status. Bytes at the end of a chunk that are too few for a header are skipped, with a notice. */
int lrcsi_tds_next(lrcsi_tds_walk *walk, lrcsi_tds_chunk *parent, lrcsi_tds_chunk *chunk);

/* LRCS_OK if `count` items of `size` bytes are left in the chunk, else a status. */
int lrcsi_tds_check(const lrcsi_tds_walk *walk, const lrcsi_tds_chunk *chunk, size_t count,
                    size_t size, const char *item);

/* Reads a name up to its terminator, which must be inside the chunk; the chunk is advanced past
   it. */
int lrcsi_tds_name(const lrcsi_tds_walk *walk, lrcsi_tds_chunk *chunk, lrcsi_span *name,
                   const char *item);

/* Adds a name to the mesh's text, or to its count; NULL while counting. */
const char *lrcsi_tds_store_name(lrcsi_tds_walk *walk, lrcsi_span name);

/* Adds to one of the counts; LRCS_E_LIMIT if it exceeds the range of indices. */
int lrcsi_tds_add(const lrcsi_tds_walk *walk, uint32_t *sum, uint32_t count, size_t at,
                  const char *item);

/* Reads one material, the content of a chunk 0xAFFF. */
int lrcsi_tds_read_material(lrcsi_tds_walk *walk, lrcsi_tds_chunk material);

/* Reads one mesh, the content of a chunk 0x4100; `name` is the name of its part, NULL while
   counting. */
int lrcsi_tds_read_trimesh(lrcsi_tds_walk *walk, lrcsi_tds_chunk chunk, const char *name);

#endif
