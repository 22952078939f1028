/* SPDX-License-Identifier: MIT */
/* Sizes and curvature of a shape's mesh before it is made. */
#ifndef LRCSI_TESSELLATE_H
#define LRCSI_TESSELLATE_H

#include <lrcs/shape.h>

/* 1 if the divisions are valid for the shape and its mesh has at most 2^32 - 2 vertices and
   facets. */
int lrcsi_tessellate_fits(const lrcs_shape *shape, const lrcs_divisions *divisions);

/* The counts of the mesh, for valid divisions. */
lrcs_mesh_counts lrcsi_tessellate_counts(const lrcs_shape *shape, const lrcs_divisions *divisions);

/* The curvature that lrcs_shape_mesh will report. O(along). */
lrcs_curvature lrcsi_tessellate_curvature(const lrcs_shape *shape, const lrcs_divisions *divisions);

/* The distance of lrcsi_profile_reach; 0 for plate and box. O(along). */
double lrcsi_tessellate_reach(const lrcs_shape *shape, const lrcs_divisions *divisions);

#endif
