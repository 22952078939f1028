/* SPDX-License-Identifier: MIT */
/* Sizes of a shape's mesh before it is made. */
#ifndef LRCSI_TESSELLATE_H
#define LRCSI_TESSELLATE_H

#include "mesh/shape/revolution_reach.h"

/* The largest numbers of sectors and of zones (lrcs_divisions). */
#define LRCSI_AROUND_MAX (1u << 24)
#define LRCSI_ALONG_MAX  (1u << 24)

/* 1 if the divisions are valid for the shape and its mesh has at most 2^32 - 2 vertices and
   facets. */
int lrcsi_tessellate_fits(const lrcs_shape *shape, const lrcs_divisions *divisions);

/* The counts of the mesh, for valid divisions. */
lrcs_mesh_counts lrcsi_tessellate_counts(const lrcs_shape *shape, const lrcs_divisions *divisions);

/* The bounds that lrcs_shape_mesh will report. O(along). */
lrcs_patch_bounds lrcsi_tessellate_patch_bounds(const lrcs_shape *shape,
                                                const lrcs_divisions *divisions);

/* The distances of lrcsi_revolution_reach; 0 for plate and box. O(along). */
lrcsi_reach lrcsi_tessellate_reach(const lrcs_shape *shape, const lrcs_divisions *divisions);

/* The part of the true surface that a facet of a wall represents: all of it between two rows and
   two half-planes through the axis. */
typedef struct lrcsi_wall_patch {
    uint32_t row;    /* the lower one, as in lrcsi_revolution */
    uint32_t sector; /* between the azimuths of corners `sector` and `sector` + 1 of the rows */
    uint32_t facets; /* that share it: 2, numbers 2 k and 2 k + 1 of the mesh; or 1 */
    int mirrored;    /* a sphere's lower half: z is negated */
} lrcsi_wall_patch;

/* Returns 0 for a facet that is no part of a curved wall. O(log around). */
int lrcsi_tessellate_patch(const lrcs_shape *shape, const lrcs_divisions *divisions, uint32_t facet,
                           lrcsi_wall_patch *patch);

#endif
