/* SPDX-License-Identifier: MIT */
/* A facet mesh as a file or a shape gives it, before it is placed in a scene. */
#ifndef LRCS_MESH_H
#define LRCS_MESH_H

#include <lrcs/status.h>
#include <lrcs/work.h>

/* A point or vector, and a triangle's corners as indices into a list of points. */
typedef struct lrcs_point {
    double x[3];
} lrcs_point;

typedef struct lrcs_facet {
    uint32_t corner[3];
} lrcs_facet;

/* A material as the file names it. It has no reflection parameters: bindings assign them. */
typedef struct lrcs_surface {
    const char *name;     /* UTF-8, never NULL; bytes that are not UTF-8 were read as Latin-1 */
    unsigned char rgb[3]; /* diffuse colour, 0..255 */
    unsigned char has_colour;
    unsigned char two_sided;
    unsigned char defined; /* 1: its definition was read: of a 3DS file always, of an OBJ file by
                              lrcs_mtl_read */
    double transparency;   /* 0 opaque .. 1 invisible */
} lrcs_surface;

/* What the reader found and the user should know: bits of lrcs_mesh.notices. */
enum lrcs_mesh_notice {
    LRCS_MESH_KEYFRAMER = 1 << 0,          /* animation nodes present, ignored */
    LRCS_MESH_LOCAL_MATRIX = 1 << 1,       /* mesh matrices other than the identity, ignored */
    LRCS_MESH_UNDEFINED_MATERIAL = 1 << 2, /* facets name a material that is not defined */
    LRCS_MESH_TRAILING_BYTES = 1 << 3,     /* bytes after the end, or a length that disagrees */
    LRCS_MESH_OVERLAPPING_GROUPS = 1 << 4, /* a facet in two material groups: the last won */
    LRCS_MESH_LATIN1_NAMES = 1 << 5,       /* names that were not UTF-8 */
    LRCS_MESH_NORMALS_DISAGREE = 1 << 6    /* STL: stored normals opposite to the winding */
};

/* Counts of stored items. STL vertices are welded on reading, so their count is an upper bound. */
typedef struct lrcs_mesh_counts {
    uint32_t vertices, facets, materials, parts;
    size_t text_bytes; /* names, with their terminators */
    uint32_t normals;  /* vertex normals */
} lrcs_mesh_counts;

/* Facets are triangles, counter-clockwise seen from outside. Coordinates are in file units and
   finite, at most 1e100 in magnitude; indices are in range. */
typedef struct lrcs_mesh {
    uint32_t vertex_count, facet_count, material_count, part_count;
    lrcs_point *vertex;
    lrcs_facet *facet;
    uint32_t *facet_material; /* index into material, or LRCS_NONE */
    uint32_t *facet_part;     /* index into part */
    uint32_t *facet_smooth;   /* smoothing groups as a mask; 0 is hard */
    lrcs_surface *material;
    const char **part;         /* names, UTF-8 */
    uint32_t notices;          /* lrcs_mesh_notice bits */
    const char *material_file; /* OBJ: the file named by mtllib, or NULL */
    /* Vertex normals as the file gives them, of any length, 0 included; both NULL without any. */
    uint32_t normal_count;
    lrcs_point *normal;
    lrcs_facet *facet_normal; /* at each corner an index into normal, or LRCS_NONE */
} lrcs_mesh;

/* Defects and properties of a mesh. Edges match by bitwise equal positions (-0 equals 0).
   Degenerate facets (zero area in exact arithmetic) are excluded from all other counts. */
typedef struct lrcs_mesh_report {
    uint32_t vertices;             /* distinct positions that facets use */
    uint32_t edges;                /* distinct edges between them */
    uint32_t degenerate;           /* facets of exactly zero area */
    uint32_t duplicate;            /* facets with the same three points as an earlier one */
    uint32_t opposite_pairs;       /* duplicates with the opposite winding */
    uint32_t boundary_edges;       /* used by one facet */
    uint32_t nonmanifold_edges;    /* used by three or more */
    uint32_t misoriented_edges;    /* used by two facets in the same direction */
    int closed;                    /* every edge is used equally often in both directions */
    int convex;                    /* closed, connected, and exactly convex: no self-shadowing */
    double box_min[3], box_max[3]; /* of the vertices that facets use */
    double area;                   /* in the square of the coordinates' unit */
    double volume; /* in its cube; signed, about the box centre; meaningful only if closed */
} lrcs_mesh_report;

/* Bytes of work area that lrcs_mesh_check takes for a mesh of these counts (upper bound). */
size_t lrcs_mesh_check_need(uint32_t vertex_count, uint32_t facet_count);

/* Examines a triangle soup.
   Given: vertex, facet (indices in range, coordinates finite and at most 1e100).
   Returned: report. Nothing stays in the work area.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT (more than 1.4e9 facets).
   Work: O(n); lrcs_mesh_check_need bytes.
   Notes: 1. A mesh without facets gives zeros, an empty box at the origin, not closed.
   2. The box includes degenerate facets.
   3. Decisions are exact (degenerate, convex) if coordinates are zero or exceed 2^-300 in
   magnitude; below that, underflow may make a facet count as degenerate or a mesh as not convex.
   4. Errors, per facet: a few ulp relative for the area, 1e-30 of the box's volume for
   the volume. */
int lrcs_mesh_check(const lrcs_point *vertex, uint32_t vertex_count, const lrcs_facet *facet,
                    uint32_t facet_count, lrcs_work *work, lrcs_mesh_report *report);

#endif
