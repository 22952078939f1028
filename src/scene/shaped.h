/* SPDX-License-Identifier: MIT */
/* What holds of a placed shape by construction. */
#ifndef LRCSI_SHAPED_H
#define LRCSI_SHAPED_H

#include "scene/place.h"

/* 1 where optics/closed.h knows what such a shape reflects, but for the inside of an open one, that
   a two-sided material shows. */
int lrcsi_shaped_closed_form(const lrcs_shape *shape, int two_sided);

/* The largest coordinate of a mesh. */
double lrcsi_shaped_extent(const lrcs_mesh *mesh);

/* What needs no placed facet: `extent` is that of the shape's mesh, `curvature` what its mesh came
   with. */
void lrcsi_shaped_describe(const lrcs_shape *shape, const lrcs_divisions *divisions,
                           const lrcs_curvature *curvature, const lrcsi_placer *placer,
                           double extent, lrcs_part *part);

/* Then, with the part's facets in the scene, how far rounding in placing may tilt them. */
void lrcsi_shaped_tilt(const lrcsi_placer *placer, const lrcs_scene *scene, double extent,
                       lrcs_part *part);

#endif
