/* SPDX-License-Identifier: MIT */
/* What is known of a placed shape by construction, without looking at its facets. */
#ifndef LRCSI_PLACED_SHAPE_H
#define LRCSI_PLACED_SHAPE_H

#include "scene/build/place.h"

/* 1 if optics/closed.h has the closed form of such a shape. The closed form of an open shape does
   not include its inside, which a two-sided material makes visible; then the result is 0. */
int lrcsi_placed_shape_closed_form(const lrcs_shape *shape, int two_sided);

/* The largest magnitude of a coordinate of a mesh. */
double lrcsi_placed_shape_extent(const lrcs_mesh *mesh);

/* First step, before the facets are placed: fills `part`, except normal_err. Given: the `extent`
   and the bounds of the mesh's patches. */
void lrcsi_placed_shape_describe(const lrcs_shape *shape, const lrcs_divisions *divisions,
                                 const lrcs_patch_bounds *bounds, const lrcsi_placer *placer,
                                 double extent, lrcs_part *part);

/* Second step, when the part's facets are in the scene: sets part->normal_err, how far rounding in
   placing may have rotated their normals, and includes it in the bounds. */
void lrcsi_placed_shape_normal_err(const lrcsi_placer *placer, const lrcs_scene *scene,
                                   double extent, lrcs_part *part);

#endif
