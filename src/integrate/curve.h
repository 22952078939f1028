/* SPDX-License-Identifier: MIT */
/* Eq. 2 over facets with curved normals: 4 pi times the integral of f_r cos(theta) over what is
   visible of each, with what visibility, rounding and steps that ran out leave open as bounds, and
   what the cubature leaves as an estimate. */
#ifndef LRCSI_CURVE_H
#define LRCSI_CURVE_H

#include "integrate/cubature.h"
#include "integrate/plan.h"
#include "visibility/occlude.h"
#include "visibility/visible.h"

/* One facet's part of sigma, in scaled units of area. */
typedef struct lrcsi_curved {
    double glint, diffuse;
    double visibility, rounding; /* bounds; where steps ran out, what they left is in the first */
    double likely;               /* likely error of a sampled share; 0: none */
    double most;                 /* bound on what all of the facet could add, were it seen */
    double estimate;             /* of the cubature's error */
    /* where moments are wanted: the glint's integral with tan^2 in it, the diffuse part's with
       log(1 + tan^2) */
    double glint_u, diffuse_log;
} lrcsi_curved;

/* How to integrate: what the plan leaves of the BRDF, the relative error asked for, and room for
   parts of facets. */
typedef struct lrcsi_curving {
    const lrcsi_plan *plan;
    double tolerance;
    lrcsi_cubature_cell *waiting;
    int moments; /* 1: wanted */
} lrcsi_curving;

/* All facets to integrate over. The sum so far tells how small a contribution is still worth work:
   a dark sliver gets no more than it can add. Each facet may err by its share of the sum, by area
   and by count: all together by twice the aim. */
typedef struct lrcsi_curve_all {
    const lrcsi_view *view;
    const lrcsi_curving *how;
    double negligible; /* f_r cos below this is negligible beside the brightest facet */
    double projected;  /* area of all */
    double count;
    double done; /* integral of f_r cos over the visible parts of the facets done so far */
} lrcsi_curve_all;

/* A facet at work. */
typedef struct lrcsi_curve_facet {
    const lrcsi_view *view;
    uint32_t facet;
    lrcsi_incidence incidence;
    lrcs_brdf brdf;
    double normal[3][3]; /* at its corners, view axes, on the side that is seen */
    lrcsi_cubature sum;  /* empty, with its tolerance and limits set */
} lrcsi_curve_facet;

/* Does the facet have curved normals, and is it on its reflecting side? */
int lrcsi_curve_wanted(const lrcsi_view *view, uint32_t facet);

/* For callers that integrate over regions of their own: all facets that are wanted; one of them;
   what it has added to sigma (scaled), for those that follow; the most that f_r cos reaches on it;
   and how far normals may be off at points of its visible pieces, rad, for sum.position_err, which
   is set for points of the whole facet. sum.brdf points into the job, which must not be copied. */
lrcsi_curve_all lrcsi_curve_all_make(const lrcsi_view *view, const lrcsi_curving *how);
void lrcsi_curve_start(const lrcsi_curve_all *all, uint32_t facet, lrcsi_curve_facet *job);
void lrcsi_curve_have(lrcsi_curve_all *all, double sigma);
double lrcsi_curve_most(const lrcsi_curve_facet *job);
double lrcsi_curve_position_err(const lrcsi_curve_facet *job, const lrcsi_target *target);

/* Facets of which an area is all that is known: the integral over the whole facet, times the share
   of it that is visible.
   Given: visible. Returned: curved[facet_count] of the facets wanted. */
void lrcsi_curve_shares(const lrcsi_view *view, const lrcsi_curving *how,
                        const lrcsi_visible *visible, lrcsi_curved *curved);

/* Every facet by clipping, as lrcsi_occlude_all, and those wanted integrated over the pieces that
   are visible. Where visible is given, sampled, only those that are wanted and seen in part:
   samples tell how much of a facet is seen, but not where on it. Status: as lrcsi_occlude_all. */
int lrcsi_curve_pieces(lrcsi_classification *classification, const lrcsi_curving *how, int sampled,
                       lrcs_work *work, lrcsi_visible *visible, lrcsi_curved *curved);

#endif
