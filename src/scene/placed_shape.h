/* SPDX-License-Identifier: MIT */
/* Properties of a placed shape by construction. */
#ifndef LRCSI_PLACED_SHAPE_H
#define LRCSI_PLACED_SHAPE_H

#include "scene/place.h"

/* 1 if optics/closed.h has the closed form of such a shape; it excludes the inside of an open one,
   which a two-sided material makes visible. */
int lrcsi_placed_shape_closed_form(const lrcs_shape *shape, int two_sided);

/* The largest coordinate of a mesh. */
double lrcsi_placed_shape_extent(const lrcs_mesh *mesh);

/* First step, without placed facets: `extent` and `curvature` are those of the shape's mesh. */
void lrcsi_placed_shape_describe(const lrcs_shape *shape, const lrcs_divisions *divisions,
                                 const lrcs_curvature *curvature, const lrcsi_placer *placer,
                                 double extent, lrcs_part *part);

/* Second step, with the part's facets in the scene: how far rounding in placing may tilt them. */
void lrcsi_placed_shape_tilt(const lrcsi_placer *placer, const lrcs_scene *scene, double extent,
                             lrcs_part *part);

#endif
