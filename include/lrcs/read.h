/* SPDX-License-Identifier: MIT */
/* Readers for 3DS, OBJ with MTL, and STL, from bytes in memory.
   Each format has two calls: `count` walks the bytes once and fills the counts, `read` fills a
   mesh in the work area (lrcs_mesh_need bytes). Both look at nothing beyond bytes[0..size-1]
   and report where they stopped. */
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
   _MEMORY. A file without facets is read; the mesh is empty.
   Notes: 1. Materials are all that the file defines, in its order; a group binds to the first of
   its name. A facet in two groups belongs to the last; in none, or one of a material that is not
   defined, to LRCS_NONE. Groups and smoothing count inside the face list and beside it.
   2. Colour is the diffuse one: chunk 0x0011 before 0x0012 before floats, which are clamped to 0..1
   and rounded to 0..255. Transparency is in percent in both its forms.
   3. A chunk longer than its parent is an error; a root that disagrees with the size of the file,
   or up to 5 bytes too many at the end of a chunk, is a notice. */
int lrcs_3ds_count(const void *bytes, size_t size, lrcs_mesh_counts *counts, lrcs_where *where);
int lrcs_3ds_read(const void *bytes, size_t size, lrcs_work *work, lrcs_mesh *mesh,
                  lrcs_where *where);

/* Wavefront OBJ: polygons of any size, concave ones too, are fanned from their first vertex. Parts
   are the names that `o` and `g` give, materials those that `usemtl` gives, each in order of its
   first facet; a name that comes back continues what it named; names without facets are left out.
   Facets before any `o` or `g` are in a part named "", facets before any `usemtl` (or after one
   without a name) have no material. Colours come from lrcs_mtl_read.
   Status: as lrcs_3ds_count and lrcs_3ds_read.
   Notes: 1. `count` has no memory for names: its materials, parts and text_bytes are upper bounds,
   in which a name that comes back counts again. Vertices and facets are exact.
   2. Negative indices count back from the vertices above them; positive ones may also point
   forward; the same holds of normals. Texture indices are not looked up.
   3. Smoothing group N sets bit (N - 1) mod 32; `s off`, `s 0` and `s` are hard, `s on` is group 1.
   4. A name is the rest of its line, blanks inside included. Of several `mtllib` the first counts,
   up to its first ".mtl" that a blank follows.
   5. Weights and colours after the coordinates of a vertex, `l`, `p`, `vt`, `vp`, free-form
   geometry and unknown statements are passed over. */
int lrcs_obj_count(const void *bytes, size_t size, lrcs_mesh_counts *counts, lrcs_where *where);
int lrcs_obj_read(const void *bytes, size_t size, lrcs_work *work, lrcs_mesh *mesh,
                  lrcs_where *where);

/* The material library of an OBJ file: sets colour and transparency of the mesh's materials by
   name; names that the mesh does not use are passed over, materials that it does not define are
   left as they are, with a notice (LRCS_MESH_UNDEFINED_MATERIAL).
   Status: LRCS_OK, _SYNTAX, _TRUNCATED, _NUMBER, _EMPTY. On failure the mesh is untouched.
   Work: no work area; O(size), times the number of materials where the orders of both differ.
   Notes: 1. Kd is clamped to 0..1 and rounded to 0..255; transparency is 1 - d, or Tr where a
   material has no d, clamped to 0..1. 2. A material defined twice takes the last of each value. */
int lrcs_mtl_read(const void *bytes, size_t size, lrcs_mesh *mesh, lrcs_where *where);

/* STL, one part, no materials; equal positions are welded (bitwise, -0 equals 0), in order of
   first use. Attribute words and stored normals are ignored (a notice where they disagree). The
   part is named as the first solid of an ASCII file, "" for a binary one.
   Status: as lrcs_3ds_count and lrcs_3ds_read, whose index errors it has not.
   Notes: 1. Counting does not weld: counts->vertices is three per facet, an upper bound;
   mesh->vertex_count is exact. */
int lrcs_stl_count(const void *bytes, size_t size, lrcs_mesh_counts *counts, lrcs_where *where);
int lrcs_stl_read(const void *bytes, size_t size, lrcs_work *work, lrcs_mesh *mesh,
                  lrcs_where *where);

#endif
