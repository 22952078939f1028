/* SPDX-License-Identifier: MIT */
/* Eq. 2 over facets with curved normals: 4 pi times the integral of f_r cos(theta) over the visible
   part of each. The errors from visibility, rounding and spent steps are bounded; that of the
   cubature is estimated. */
#ifndef LRCSI_CURVE_H
#define LRCSI_CURVE_H

#include "integrate/cubature/cubature.h"
#include "integrate/plan/plan.h"
#include "visibility/base/visible_area.h"
#include "visibility/occlude.h"

/* What one facet adds to sigma, in scaled units of area. */
typedef struct lrcsi_curve_terms {
    double glint, diffuse;
    double visibility, rounding; /* bounds; the first includes the error of spent steps */
    double error_estimate;       /* the estimated error due to a sampled area; 0: none */
    double upper_bound;          /* of what the facet would add if all of it were visible */
    double estimate;             /* of the cubature's error */
    /* For derivatives only: the integral of the glint times tan^2, and that of the diffuse term
       times log(1 + tan^2). */
    double glint_u, diffuse_log;
} lrcsi_curve_terms;

typedef struct lrcsi_curve_options {
    const lrcsi_plan *plan; /* which terms of the BRDF are evaluated */
    double tolerance;       /* relative */
    lrcsi_meter *meter;     /* limit on steps; NULL: none */
    lrcs_progress
        *progress; /* where the integrals report how many facets are done; NULL: nowhere */
    lrcsi_cubature_cell *stack;
    int derivatives; /* 1: compute what derivatives need */
} lrcsi_curve_options;

/* The state that the integrals over all facets share. The sum so far decides how accurate the next
   integral must be, so that facets that can add little take little work. The allowed error of a
   facet is the tolerance times the sum so far, times the facet's fraction of the area plus one over
   the number of facets: for all facets together at most twice the tolerance. */
typedef struct lrcsi_curve_context {
    const lrcsi_view *view;
    const lrcsi_curve_options *options;
    double negligible; /* f_r cos below this is negligible compared with the brightest facet */
    double projected;  /* the projected area of all facets with curved normals */
    double count;      /* of these facets */
    double sum;        /* the integral of f_r cos over the visible parts of the facets so far */
} lrcsi_curve_context;

/* What the integral over one facet is taken over. surface.brdf points into it, so that it must not
   be copied. */
typedef struct lrcsi_curve_integral {
    const lrcsi_view *view;
    uint32_t facet;
    lrcsi_incidence incidence;
    lrcs_brdf brdf;
    double normal[3][3];            /* at its corners, view axes, on the side towards the laser */
    lrcsi_cubature_surface surface; /* position_err: for points of the whole facet */
} lrcsi_curve_integral;

/* 1 if a facet has curved normals and its side towards the laser reflects; else 0. */
int lrcsi_curve_applies(const lrcsi_view *view, uint32_t facet);

/* Makes the context of all facets to which lrcsi_curve_applies. */
lrcsi_curve_context lrcsi_curve_context_make(const lrcsi_view *view,
                                             const lrcsi_curve_options *options);

/* Adds the contribution of a facet to sigma, scaled, to the sum so far. */
void lrcsi_curve_context_add(lrcsi_curve_context *context, double sigma);

/* Prepares the integral over one such facet, or over regions of it that the caller chooses. */
void lrcsi_curve_integral_make(const lrcsi_curve_context *context, uint32_t facet,
                               lrcsi_curve_integral *integral);

/* An upper bound of f_r cos on the facet. */
double lrcsi_curve_upper_bound(const lrcsi_curve_integral *integral);

/* A bound on the error of normals at points of the facet's visible pieces, rad:
   surface.position_err of a sum over such pieces. */
double lrcsi_curve_position_err(const lrcsi_curve_integral *integral, const lrcsi_target *target);

/* For facets of which only the visible area is known: the integral over the whole facet, times the
   fraction that is visible.
   Given: visible[facet_count]. Returned: curve_terms[facet_count], 0 where lrcsi_curve_applies is
   0. */
void lrcsi_curve_from_areas(const lrcsi_view *view, const lrcsi_curve_options *options,
                            const lrcsi_visible_area *visible, lrcsi_curve_terms *curve_terms);

/* Clips every facet, as lrcsi_occlude_all, and integrates over the visible pieces of those to which
   lrcsi_curve_applies. Returned: visible[facet_count], curve_terms[facet_count]. Status: as
   lrcsi_occlude_all. */
int lrcsi_curve_from_pieces(lrcsi_classification *classification,
                            const lrcsi_curve_options *options, lrcs_work *work,
                            lrcsi_visible_area *visible, lrcsi_curve_terms *curve_terms);

/* The same with areas from samples, which give the area but not the region that is visible: only
   facets with curved normals that are partly visible are clipped. Given: visible[facet_count], of
   which the areas of clipped facets are replaced. */
int lrcsi_curve_from_samples(lrcsi_classification *classification,
                             const lrcsi_curve_options *options, lrcs_work *work,
                             lrcsi_visible_area *visible, lrcsi_curve_terms *curve_terms);

#endif
