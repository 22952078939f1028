/* SPDX-License-Identifier: MIT */
/* Curved normals: normals at the corners of placed facets, from the normals and smoothing groups of
   a model file. */
#ifndef LRCSI_SMOOTH_H
#define LRCSI_SMOOTH_H

#include "scene/build/place.h"

/* Does the mesh have a smoothing group or a vertex normal? */
int lrcsi_smooth_given(const lrcs_mesh *mesh);

/* Bytes of work area that lrcsi_smooth_run takes while it runs. */
size_t lrcsi_smooth_need(const lrcs_mesh *mesh);

/* Fills scene->corner_normal for the facets of `mesh`. Given: these are the last facets of the
   scene, with their vertices and materials, placed by `placer`. The normals are unit vectors, each
   in front of its facet. A facet without curvature, or one that AUTO leaves flat for this
   tolerance, has three zero vectors. Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_INDEX (the index of a
   normal that does not exist); LRCS_E_LIMIT (more than 1.4e9 facets). */
int lrcsi_smooth_run(const lrcs_mesh *mesh, const lrcsi_placer *placer,
                     const lrcs_build_options *options, lrcs_work *work, lrcs_scene *scene);

#endif
