/* SPDX-License-Identifier: MIT */
/* What contributes to sigma: parts, materials and single facets. */
#ifndef LRCS_SHARES_H
#define LRCS_SHARES_H

#include <lrcs/host.h>

#define LRCS_HOST_SHARES_FACETS 10u /* the number of brightest facets that are kept */

/* A part or a material. A part is a shape, a model, or each object of a model that has several.
   Materials with the same name and the same numbers are one. */
typedef struct lrcs_host_share {
    char *name;      /* "name #3" for the third of several objects that share a name */
    uint32_t facets; /* number of facets */
    double sigma_m2, glint_m2, diffuse_m2;
} lrcs_host_share;

typedef struct lrcs_host_share_facet {
    uint32_t facet;
    uint32_t scene_part, scene_material; /* indices in the scene */
    const char *part, *material;
    double theta_deg; /* between the laser and the normal of the visible side */
    double visible_area_m2, sigma_m2, glint_m2;
} lrcs_host_share_facet;

/* Each list is in the order of sigma, the largest first. */
typedef struct lrcs_host_shares {
    double sigma_m2;                  /* of the run */
    lrcs_host_share *part, *material; /* only those that have facets */
    uint32_t parts, materials;
    lrcs_host_share_facet facet[LRCS_HOST_SHARES_FACETS]; /* only facets that contribute */
    uint32_t facets;
} lrcs_host_shares;

/* Adds up the records of a run.
   Given: scene, records and sigma of the run; base, which was read and has the names: the scene
   itself, or the one that it was varied from.
   Returned: shares, whose names and lists lrcs_host_shares_free frees; empty on failure.
   Status: LRCS_OK; LRCS_E_SYSTEM (memory).
   Work: O(facets + objects log objects). */
int lrcs_host_shares_make(const lrcs_host_scene *base, const lrcs_scene *scene,
                          const lrcs_facet_record *records, double sigma_m2,
                          lrcs_host_shares *shares, lrcs_host_error *error);
void lrcs_host_shares_free(lrcs_host_shares *shares);

/* The sum of rows from .. count - 1 of a list, without a name. */
lrcs_host_share lrcs_host_shares_sum(const lrcs_host_share *row, uint32_t from, uint32_t count);

#endif
