/* SPDX-License-Identifier: MIT */
/* The sum of Eq. 2: from visible areas to sigma and its parts, with the contribution of each source
   of error to the bound. */
#ifndef LRCSI_TOTAL_H
#define LRCSI_TOTAL_H

#include "integrate/curve.h"
#include "integrate/patch.h"
#include "integrate/shapes.h"
#include "visibility/proximity_band.h"

/* All in square metres. */
typedef struct lrcsi_total {
    double glint, diffuse;
    double visibility, tessellation, rounding; /* bounds; tessellation negative: not known */
    double error_estimate;                     /* estimated error of the sampled areas */
    double curvature;                          /* estimated error of facets with curved normals */
    double projected, back_side;
    uint32_t back_sides, hidden, partial; /* facets */
    uint32_t seen; /* the bits GLINT and DIFFUSE, if some facet that may be visible has that term */
} lrcsi_total;

/* What one facet with a flat normal adds to sigma, scaled, with the factor 4 pi. */
typedef struct lrcsi_facet_terms {
    double glint, diffuse;
    double rounding; /* bound on the rounding error of glint + diffuse, for any visible area up to
                        visible->high */
    double per_area; /* glint + diffuse per unit of visible area */
} lrcsi_facet_terms;

/* Computes these terms. Given: a facet that reflects towards the laser, its incidence, its visible
   area; the patch of the last facet (integrate/patch.h), or one with side = 0. */
lrcsi_facet_terms lrcsi_facet_terms_make(const lrcsi_view *view, const lrcsi_plan *plan,
                                         uint32_t facet, const lrcsi_incidence *incidence,
                                         const lrcsi_visible *visible, lrcsi_patch *patch);

/* Converts a scaled bound on areas or on sigma to square metres, rounded outward where it
   underflows. */
double lrcsi_bound_area(const lrcs_prepared *p, double scaled);

/* A bound on the underflow error of a facet's terms, scaled: some 30 operations lose at most
   2^-1075 each, and no later operation enlarges a loss relative to its term. */
#define LRCSI_FACET_UNDERFLOW 0x1p-1070

/* The visible areas of facets. answer[facet] is LRCSI_QUERY_VISIBLE or LRCSI_QUERY_HIDDEN if all or
   nothing of the facet is visible; visible[] has the areas of the other facets, and of all facets
   if answer is NULL. */
typedef struct lrcsi_areas {
    const lrcsi_visible *visible; /* NULL: method facet, where the plan implies all areas */
    const unsigned char *answer;
    const lrcsi_moment *moment; /* of the visible regions of all facets; NULL: not known */
    unsigned char *corrected;   /* returned, with moments: facet: 1 if its terms were corrected by
                                   them   (integrate/linear.h) */
} lrcsi_areas;

/* Given: the view and its plan; the visible areas (answer NULL if shapes are curved); the results
   of facets with curved normals, curved[facet_count] (NULL: all are flat); the proximity band
   (NULL: none was made); the shapes that are evaluated by their closed forms instead of their
   facets (NULL: none). Returned: the total. The order of the sum is: materials in their order, the
   facets of each in theirs; then clear shapes in theirs. Unless NULL, also records[facet_count]:
   the sigma of a clear shape is divided among its facets in proportion to what they would reflect
   or, if none of them would reflect, to their projected areas. If only a sliver of a shape faces
   the laser, and none of its facets does, its sigma is in no record. Unless NULL, also
   part_error[part_count], as in lrcs_run_options; with moments, areas->corrected[facet_count]. */
lrcsi_total lrcsi_total_make(const lrcsi_view *view, const lrcsi_plan *plan,
                             const lrcsi_areas *areas, const lrcsi_curved *curved,
                             const lrcsi_proximity_band *band, const lrcsi_clear *clear,
                             lrcs_facet_record *records, double *part_error);

#endif
