/* SPDX-License-Identifier: MIT */
/* How finely a shape is divided into facets, depending on the other parts of its scene. */
#ifndef LRCSI_FINENESS_H
#define LRCSI_FINENESS_H

#include <lrcs/scene.h>

/* Round bodies are not divided for a smaller tolerance than this unless a division is requested. */
#define LRCSI_FINENESS_ROUND 1e-4

typedef struct lrcsi_fineness {
    double tolerance;
    double round_min; /* round bodies are not divided for a smaller tolerance than this */
    uint32_t max_facets, parts;
    double area;     /* of all parts, by lrcsi_fineness_area */
    int facets_only; /* lrcs_build_options.facets_only */
    int halvings;    /* of the part, lrcs_build_options.halvings */
} lrcsi_fineness;

/* The approximate surface area of a part, used as a weight; for a model, the area of its facets. */
double lrcsi_fineness_area(const lrcs_recipe_part *part, const lrcs_mesh *mesh);

/* Chooses the divisions of a shape, and counts its mesh. Status: LRCS_OK; as lrcs_shape_count. */
int lrcsi_fineness_divide(const lrcsi_fineness *fineness, const lrcs_recipe_part *part,
                          const lrcs_material *material, lrcs_divisions *divisions,
                          lrcs_mesh_counts *counts);

#endif
