/* SPDX-License-Identifier: MIT */
/* What the errors of materials leave uncertain of sigma: by first order, and from a seeded sample.
   How sigma depends on s and m is given at nodes; how it depends on A and B is linear. */
#ifndef LRCSI_UNCERTAINTY_H
#define LRCSI_UNCERTAINTY_H

#include "integrate/sensitivity.h"

/* The nodes of each material's s and m, of which the middle one is its own. */
#define LRCSI_NODES        17u
#define LRCSI_NODES_CURVED 9u /* where each is a pose of its own */

/* The responses at a node, m2 per unit of amplitude, and their slopes. */
typedef struct lrcsi_node {
    double glint, diffuse, glint_s, diffuse_m;
} lrcsi_node;

/* Does some material have errors: of any number, or of s or m? */
int lrcsi_uncertainty_stated(const lrcs_scene *scene);
int lrcsi_uncertainty_bends(const lrcs_scene *scene);

/* s and m of a material at node `k` of `count`. */
lrcs_brdf lrcsi_uncertainty_node(const lrcs_material *material, uint32_t k, uint32_t count);

/* Bytes for lrcsi_uncertainty_make. */
size_t lrcsi_uncertainty_need(const lrcs_scene *scene, const lrcs_uncertainty_options *how);

/* Given: sigma, about which the interval lies; node[count][material_count], or count 1 if
   nothing bends: the materials' own. What the plan leaves out is 0 there. Status: LRCS_OK;
   LRCS_E_MEMORY. */
int lrcsi_uncertainty_make(const lrcs_scene *scene, double sigma, const lrcsi_node *node,
                           uint32_t count, const lrcs_uncertainty_options *how, lrcs_work *work,
                           lrcs_uncertainty *uncertainty);

#endif
