/* SPDX-License-Identifier: MIT */
/* Readers for 3DS, OBJ with MTL, and STL, from bytes in memory.
   Each format has two calls: `count` walks the bytes once and fills the counts, `read` fills a
   mesh in the work area (lrcs_mesh_need bytes). Both read only bytes[0..size-1]. On failure `where`
   states the place, and what the format requires there.
   A status written _SYNTAX is LRCS_E_SYNTAX, and so on; its cause is that of lrcs/status.h. */
#ifndef LRCS_READ_H
#define LRCS_READ_H

#include <lrcs/mesh.h>

enum lrcs_format {
    LRCS_FORMAT_UNKNOWN = 0,
    LRCS_FORMAT_3DS,
    LRCS_FORMAT_OBJ,
    LRCS_FORMAT_STL /* binary or ASCII, distinguished by content */
};

/* The format of a file (lrcs_format), determined from its content first and the extension of its
   name second (either may be missing: name NULL, size 0). */
int lrcs_format_check(const void *bytes, size_t size, const char *name);

/* Bytes of work area a read takes, an upper bound, including what it needs while it reads. */
size_t lrcs_mesh_need(const lrcs_mesh_counts *counts);

/* 3D Studio: stored vertices are the geometry; mesh matrices and the keyframer are ignored, with
   a notice. Parts are the triangle meshes, in file order.
   Status: LRCS_OK, _SYNTAX, _TRUNCATED, _INDEX, _NUMBER, _LIMIT, _EMPTY (no bytes); read also
   _MEMORY. A file without facets is read; the mesh is empty.
   Notes: 1. The mesh has all materials that the file defines, in its order; a material group refers
   to the first material of its name. The last group that contains a facet determines its material;
   a facet in no group, or in a group of an undefined material, gets LRCS_NONE. Groups and smoothing
   are read both inside the face list and beside it.
   2. The colour is the diffuse colour: chunk 0x0011 takes precedence over 0x0012, and that over
   floats, which are clamped to 0..1 and rounded to 0..255. Transparency is in percent in both its
   forms.
   3. A chunk longer than its parent is an error. A root chunk whose length disagrees with the size
   of the file, or up to 5 extra bytes at the end of a chunk, cause a notice. */
int lrcs_3ds_count(const void *bytes, size_t size, lrcs_mesh_counts *counts, lrcs_where *where);
int lrcs_3ds_read(const void *bytes, size_t size, lrcs_work *work, lrcs_mesh *mesh,
                  lrcs_where *where);

/* Wavefront OBJ: polygons of any size, including concave ones, are triangulated as fans from their
   first vertex. Parts are the names that `o` and `g` give, materials those that `usemtl` gives,
   each in the order of its first facet; a repeated name continues the earlier part or material;
   names without facets are left out.
   Facets before any `o` or `g` are in a part named "", facets before any `usemtl` (or after one
   without a name) have no material. Colours come from lrcs_mtl_read.
   Status: as lrcs_3ds_count and lrcs_3ds_read.
   Notes: 1. `count` does not remember names: its materials, parts and text_bytes are upper bounds
   in which a repeated name counts again. Vertices and facets are exact.
   2. Negative indices count back from the last vertex so far; positive ones may also refer to later
   vertices; the same holds for normals. Texture indices are ignored.
   3. Smoothing group N sets bit (N - 1) mod 32; `s off`, `s 0` and `s` mean no smoothing, `s on`
   is group 1.
   4. A name is the rest of its line, including blanks inside it. Of several `mtllib` statements the
   first is used, up to the first ".mtl" that a blank follows.
   5. Weights and colours after the coordinates of a vertex, `l`, `p`, `vt`, `vp`, free-form
   geometry and unknown statements are ignored. */
int lrcs_obj_count(const void *bytes, size_t size, lrcs_mesh_counts *counts, lrcs_where *where);
int lrcs_obj_read(const void *bytes, size_t size, lrcs_work *work, lrcs_mesh *mesh,
                  lrcs_where *where);

/* Reads the material library of an OBJ file: sets colour and transparency of the mesh's materials
   by name. Names that the mesh does not use are ignored. Materials of the mesh that the library
   does not define stay unchanged, with a notice (LRCS_MESH_UNDEFINED_MATERIAL).
   Status: LRCS_OK, _SYNTAX, _TRUNCATED, _NUMBER, _EMPTY. On failure the mesh is untouched.
   Work: no work area; O(size), times the number of materials if the two orders differ.
   Notes: 1. Kd is clamped to 0..1 and rounded to 0..255; transparency is 1 - d, or Tr where a
   material has no d, clamped to 0..1. 2. A material defined twice takes the last of each value. */
int lrcs_mtl_read(const void *bytes, size_t size, lrcs_mesh *mesh, lrcs_where *where);

/* STL: one part, no materials; equal positions are welded (bitwise, -0 equals 0), in order of
   first use. Attribute words and stored normals are ignored (with a notice if the normals disagree
   with the winding). The part has the name of the first solid of an ASCII file, "" for a binary
   one. Status: as lrcs_3ds_count and lrcs_3ds_read, except for index errors, which cannot occur.
   Notes: 1. Counting does not weld: counts->vertices is three per facet, an upper bound;
   mesh->vertex_count is exact. */
int lrcs_stl_count(const void *bytes, size_t size, lrcs_mesh_counts *counts, lrcs_where *where);
int lrcs_stl_read(const void *bytes, size_t size, lrcs_work *work, lrcs_mesh *mesh,
                  lrcs_where *where);

#endif
