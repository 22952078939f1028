/* SPDX-License-Identifier: MIT */
/* Whether a mesh is fine enough for the glint of its materials: estimates. */
#ifndef LRCS_GLINT_H
#define LRCS_GLINT_H

#include <lrcs/load.h>

/* Whether the mesh of a curved body is fine enough for the glint of its material. An ESTIMATE. The
   turn is the median angle between neighbouring facets that share a smoothing group; in a scene
   built with curved normals, for facets in no group, between the normals at their corners; for
   engine shapes, twice the proved turn. The error is that of a cylinder of such facets at
   broadside: (dphi/2)^2 / 6 for the chords and 2 exp(-(pi s / dphi)^2) for the ripple of
   the sum over discrete normals. */
typedef struct lrcs_host_glint {
    uint32_t part, material; /* of the scene */
    double s;                /* the material's slope */
    double turn;             /* dphi, rad */
    double error;            /* relative, at the worst aspect, an estimate */
    double around_1_percent; /* facets per full turn needed for an error of 1 % and of 0.1 % */
    double around_01_percent;
} lrcs_host_glint;

/* A part with a larger error is too coarse for the glint of its material. */
#define LRCS_HOST_GLINT_COARSE 1e-2

/* Lists them, ordered by part and material, in an array that the caller frees.
   Status: LRCS_OK; LRCS_E_SYSTEM (memory). */
int lrcs_host_glint_check(const lrcs_scene *scene, lrcs_host_glint **list, uint32_t *count,
                          lrcs_host_error *error);

/* Of a scene built with flat normals, the curved parts of models whose facets are too coarse for
   their glint, or with `all` every curved part of models: those that lrcs_host_glint_check finds
   with the normals in its files. None of a scene with curved normals.
   Given: base, which was read; build, with which it was built.
   Returned: list, an array that the caller frees.
   Status: LRCS_OK; LRCS_E_SYSTEM; as lrcs_host_scene_vary. */
int lrcs_host_glint_coarse(const lrcs_host_scene *base, const lrcs_build_options *build, int all,
                           lrcs_host_glint **list, uint32_t *count, lrcs_host_error *error);

/* The glint of one pose that comes from facets too coarse for it. */
typedef struct lrcs_host_glint_sum {
    double glint_m2; /* of all these facets together */
    double error_m2; /* ESTIMATE of its error: of each part the relative error, at most 1, times
                        its glint */
    double most_m2;  /* of the flat face that contributes most: its brightest facet, and the facets
                        of the same part and material that turn from that by less than 1e-3 rad */
    uint32_t facet;  /* its brightest facet; LRCS_NONE if none contributes */
} lrcs_host_glint_sum;

/* From the records of a run of `scene`, and a list of lrcs_host_glint_check of this scene or of the
   one that it was varied from: the relative errors are those of the slopes in `scene`. */
void lrcs_host_glint_sum_make(const lrcs_scene *scene, const lrcs_facet_record *records,
                              const lrcs_host_glint *list, uint32_t count,
                              lrcs_host_glint_sum *sum);

/* 1 if the glint of that flat face makes more than half of sigma: its normal is the mesh's, not the
   surface's. */
int lrcs_host_glint_dominates(const lrcs_host_glint_sum *sum, double sigma_m2);

#endif
