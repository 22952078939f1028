/* SPDX-License-Identifier: MIT */
/* Eq. 2 summed: from visible areas to sigma, its parts, and what each cause adds to its bound. */
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
    double likely;                             /* likely error of the sampled areas */
    double curvature;                          /* estimate of the error of curved facets */
    double projected, back_side;
    uint32_t back_sides, hidden, partial;
    uint32_t seen; /* effects that some facet calls for which may be seen: GLINT, DIFFUSE bits */
} lrcsi_total;

/* What one flat facet adds, scaled, with the 4 pi. */
typedef struct lrcsi_facet_terms {
    double glint, diffuse;
    double rounding; /* a bound: of glint + diffuse, for areas up to visible->high */
    double per_area; /* glint + diffuse for each unit of visible area */
} lrcsi_facet_terms;

/* Given: a facet that reflects towards the laser, its incidence, what is visible of it; the patch
   of the last facet (integrate/patch.h), or one with side = 0. */
lrcsi_facet_terms lrcsi_facet_terms_make(const lrcsi_view *view, const lrcsi_plan *plan,
                                         uint32_t facet, const lrcsi_incidence *incidence,
                                         const lrcsi_visible *visible, lrcsi_patch *patch);

/* A scaled bound on areas or on sigma in square metres, rounded outward where it underflows. */
double lrcsi_bound_area(const lrcs_prepared *p, double scaled);

/* What a facet's terms may lose to underflow, scaled: some 30 operations, of 2^-1075 each, and
   nothing that comes after makes any of them larger than its term. */
#define LRCSI_FACET_UNDERFLOW 0x1p-1070

/* The visible areas of facets: all, or nothing, of those whose answer[] is LRCSI_QUERY_VISIBLE or
   LRCSI_QUERY_HIDDEN; visible[] has those of the others, and of all where answer is NULL. */
typedef struct lrcsi_areas {
    const lrcsi_visible *visible; /* NULL: by method facet, whose plan tells them */
    const unsigned char *answer;
} lrcsi_areas;

/* Given: the view, its plan, and the visible areas (answer NULL if shapes are curved); where the
   plan does not know every front facet to be wholly visible, on the true shapes as on their meshes,
   the proximity band about the true shapes (NULL: none was made).
   Facets with curved normals come with their own sums in curved[facet_count]; NULL: all are flat.
   Shapes that are clear (NULL: none is looked for) count by their closed forms in place of their
   facets.
   Returned: the total, summed material by material, each in facet order, then clear shapes in the
   scene's order; records[facet_count] unless NULL: a clear shape's sigma is shared out among its
   facets as these would reflect, or where none of them would, by their projected areas; of a shape
   of which a sliver is lit but no facet faces the laser, no record has it. */
lrcsi_total lrcsi_total_make(const lrcsi_view *view, const lrcsi_plan *plan,
                             const lrcsi_areas *areas, const lrcsi_curved *curved,
                             const lrcsi_proximity_band *margin, const lrcsi_clear *clear,
                             lrcs_facet_record *records);

#endif
