/* SPDX-License-Identifier: MIT */
/* Readers for 3DS, OBJ with MTL, and STL, from bytes in memory.
   Each format has two calls: `count` walks the bytes once and fills the counts, `read` fills a
   mesh in the work area (lrcs_mesh_need bytes). Both look at nothing beyond bytes[0..size-1]
   and report where they stopped. Formats: see src/mesh/README in src/README.md. */
#ifndef LRCS_READ_H
#define LRCS_READ_H

#include <lrcs/mesh.h>

enum lrcs_format {
    LRCS_FORMAT_UNKNOWN = 0,
    LRCS_FORMAT_3DS,
    LRCS_FORMAT_OBJ,
    LRCS_FORMAT_STL /* binary or ASCII, told apart by content */
};

/* The format of a file, told by its content first and its name's ending second (either may be
   missing: name NULL, size 0). */
int lrcs_format_check(const void *bytes, size_t size, const char *name);

/* Bytes of work area a read takes, an upper bound, including what it needs while it reads. */
size_t lrcs_mesh_need(const lrcs_mesh_counts *counts);

/* 3D Studio: stored vertices are the geometry; mesh matrices and the keyframer are ignored, with
   a notice. Parts are the triangle meshes, in file order.
   Status: LRCS_OK, _SYNTAX, _TRUNCATED, _INDEX, _NUMBER, _LIMIT, _EMPTY (no bytes); read also
   _MEMORY. A file without facets is read; the mesh is empty. */
int lrcs_3ds_count(const void *bytes, size_t size, lrcs_mesh_counts *counts, lrcs_where *where);
int lrcs_3ds_read(const void *bytes, size_t size, lrcs_work *work, lrcs_mesh *mesh,
                  lrcs_where *where);

/* Wavefront OBJ: polygons are fanned from their first vertex; parts are `o` and `g` names;
   materials are the `usemtl` names in order of first use, without colours until lrcs_mtl_read
   gives them. Status as for 3DS. */
int lrcs_obj_count(const void *bytes, size_t size, lrcs_mesh_counts *counts, lrcs_where *where);
int lrcs_obj_read(const void *bytes, size_t size, lrcs_work *work, lrcs_mesh *mesh,
                  lrcs_where *where);

/* The material library of an OBJ file: sets colour and transparency (Kd, d, Tr) of the mesh's
   materials by name; names that the mesh does not use are passed over. Takes no work area. */
int lrcs_mtl_read(const void *bytes, size_t size, lrcs_mesh *mesh, lrcs_where *where);

/* STL, one part, no materials; equal positions are welded (bitwise, -0 equals 0), in order of
   first use. Attribute words and stored normals are ignored (a notice where they disagree). The
   part is named as the first solid of an ASCII file, "" for a binary one.
   Status as for 3DS.
   Notes: 1. Counting does not weld: counts->vertices is three per facet, an upper bound;
   mesh->vertex_count is exact. */
int lrcs_stl_count(const void *bytes, size_t size, lrcs_mesh_counts *counts, lrcs_where *where);
int lrcs_stl_read(const void *bytes, size_t size, lrcs_work *work, lrcs_mesh *mesh,
                  lrcs_where *where);

#endif
