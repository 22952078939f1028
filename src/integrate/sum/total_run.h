/* SPDX-License-Identifier: MIT */
/* What the sum of Eq. 2 gives, its state while it is computed, and the functions by which its three
   files share the work: total.c drives it and adds curved shapes, total_packet.c adds facets in
   packets, total_facet.c adds single facets. */
#ifndef LRCSI_TOTAL_RUN_H
#define LRCSI_TOTAL_RUN_H

#include "base/sum.h"
#include "integrate/cubature/curve.h"
#include "integrate/sum/areas.h"
#include "integrate/wall/patch.h"
#include "integrate/wall/shapes.h"
#include "visibility/proximity/masked_band.h"

/* All in square metres. */
typedef struct lrcsi_total {
    double glint, diffuse;
    double visibility, tessellation, rounding; /* bounds; tessellation negative: not known */
    double error_estimate;                     /* estimated error of the sampled areas */
    double cubature_estimate; /* estimated error of the cubature over curved normals */
    double projected, back_side;
    uint32_t back_sides, hidden, partial; /* facets */
    uint32_t seen; /* the bits GLINT and DIFFUSE, if some facet that may be visible has that term */
} lrcsi_total;

/* What the sum gives in detail, by facet and by part; each may be NULL. */
typedef struct lrcsi_total_details {
    lrcs_facet_record *records; /* [facet_count]. The sigma of a clear shape is divided among its
                                   facets in proportion to what they would reflect or, if none of
                                   them would reflect, to their projected areas. If only a sliver of
                                   a shape faces the laser, and none of its facets does, its sigma
                                   is in no record */
    double *part_error;         /* [part_count]: as in lrcs_run_options */
    double *corrected;          /* [facet_count], not NULL with moments: not 0 if the facet's terms
                                   were corrected by them (integrate/wall/linear.h), by gradients
                                   of this scale */
} lrcsi_total_details;

/* Running sums, scaled. */
typedef struct lrcsi_total_sums {
    lrcsi_sum glint, diffuse, projected, back_side;
    double visibility, rounding, cubature_estimate;
    double above, below;   /* bounds on how far the true sigma is above, and below, the sum */
    double error_estimate; /* estimated random error: root of the sum of squares */
    double bias;           /* estimated systematic error: sum */
    uint32_t seen;         /* lrcsi_total.seen */
} lrcsi_total_sums;

/* What is given to lrcsi_total_make, and the sums so far. */
typedef struct lrcsi_total_run {
    const lrcsi_view *view;
    const lrcsi_plan *plan;
    const lrcsi_areas *areas;
    const lrcsi_curve_terms *curve_terms; /* NULL: all normals are flat */
    const lrcsi_masked_band *band;        /* NULL: none was made */
    const lrcsi_clear_shapes *clear;      /* the shapes that are evaluated by their closed forms */
    lrcsi_total_details details;
    int bounds_tessellation; /* 1: facets replace curved shapes, and that error can be bounded */
    lrcsi_patches patches;
    double shared_reach, shared_error; /* of the parts that share a bit of part sets: the sum of
                                          their reaches; the errors that they cause together */
    lrcsi_total total;                 /* its counts of facets; the sums are converted at the end */
    lrcsi_total_sums sums;
} lrcsi_total_run;

/* Is what a facet reflects part of a closed form? */
static inline int lrcsi_total_in_clear_shape(const lrcsi_total_run *run, uint32_t facet)
{
    return lrcsi_is_clear_shape(run->clear, run->view->prepared->scene->facet_part[facet]);
}

/* --- total_facet.c ---------------------------------------------------------------------------- */

/* Adds a facet that reflects towards the laser and may be visible. */
void lrcsi_total_add_reflecting(lrcsi_total_run *run, uint32_t facet);

/* Adds a facet of a clear shape: only what is counted, since its sigma is part of the closed form.
 */
void lrcsi_total_add_clear(lrcsi_total_run *run, uint32_t facet);

/* Adds a facet of any kind, by its exact facing. */
void lrcsi_total_add_facet(lrcsi_total_run *run, uint32_t facet);

/* Adds the tessellation error of a facet, and the correction that goes with it. */
void lrcsi_total_add_tessellation(lrcsi_total_run *run, uint32_t facet,
                                  const lrcsi_incidence *incidence);

/* Adds the errors due to an uncertain visible area. Given: sigma per unit of visible area. */
void lrcsi_total_add_area_error(lrcsi_total_sums *sums, double per_area,
                                const lrcsi_visible_area *visible);

/* Counts a facet that is hidden or partly visible. */
void lrcsi_total_count(lrcsi_total *total, double projected, const lrcsi_visible_area *visible);

/* Notes the terms of a material of which some facet may be visible. */
void lrcsi_total_note_terms(lrcsi_total_sums *sums, const lrcs_brdf *brdf);

/* Records the sigma of a facet, if records are asked for. */
void lrcsi_total_record(lrcsi_total_run *run, uint32_t facet, double glint, double diffuse);

/* --- total_packet.c --------------------------------------------------------------------------- */

/* Adds all facets of a material, in their order, in packets wherever that is possible. */
void lrcsi_total_add_material(lrcsi_total_run *run, uint32_t material);

#endif
