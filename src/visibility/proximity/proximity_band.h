/* SPDX-License-Identifier: MIT */
/* For curved shapes among other parts: on which fraction of each facet the visibility of the true
   shapes may differ from that of their facets.

   proximity_band.c defines the terms and proves what a band contains; event_band.c proves what
   event edges change, which changes are gains and which are losses, and what follows where points
   are aligned; part_order.c proves what need not be considered where the depth order of parts is
   known. */
#ifndef LRCSI_PROXIMITY_BAND_H
#define LRCSI_PROXIMITY_BAND_H

#include "visibility/proximity/event_band.h"
#include "visibility/proximity/face_margin.h"
#include "visibility/proximity/wall_margin.h"
#include "visibility/uniform/classify.h"
#include "visibility/uniform/query.h"

typedef struct lrcsi_proximity_band {
    lrcsi_classification *classification;
    double *mismatch; /* facet: fraction of its area where visibility may differ, 0 .. 1 */
    double *gain;     /* facet: fraction that the facets hide and the true shapes may not */
    double *loss;     /* facet: fraction that the true shapes may hide and the facets do not */
    double *rows;     /* facet: fraction of its rows (scene/proximity.h) that meet such a band */
    lrcsi_row_range *row_range; /* facet: around these rows, but for: */
    double *rows_open;          /* facet: the fraction of them that may be anywhere */
    double *gain_aligned;    /* facet: the gain where points of facet and true surface correspond if
                             their projections are equal (event_band.c, 5); negative: not known */
    double *loss_aligned;    /* facet: the loss then, if the gain is known */
    lrcsi_near_sides *sides; /* facet: what of its sides may be near event edges, if the gain is
                                  known (event_band.c, 5) */
    lrcsi_segment_part *rim; /* facet: of its side on a rim, if the laser sees an inside of its
                                    part through that, what may be near event edges of other parts
                                    that matter to that inside */
    lrcsi_face_margin *face; /* part: of the flat face that the laser sees of it. The facets of a
                                  known face have a gain and a loss of aligned points, which do not
                                  contain its margins (event_band.c, 6) */
    lrcsi_wall_margin *margin; /* facet: the margins of other parts' event edges on it */
    lrcsi_part_set *parts;     /* facet: the parts whose bands it meets */
    uint32_t *region;          /* facet of a curved part: its region, named by one of its facets */
} lrcsi_proximity_band;

/* Is a side of a facet, from corner k to k + 1, free? */
static inline int lrcsi_band_side_is_free(const lrcsi_proximity_band *band, uint32_t facet, int k)
{
    return lrcsi_segment_part_is_empty(band->sides[facet].side[k]);
}

/* Upper bound of bytes; 0 if prepared->proximity.reach is NULL. */
size_t lrcsi_proximity_band_need(const lrcs_prepared *prepared);

/* For a scene with prepared->proximity.reach. The band is not changed afterwards;
   visibility/proximity/masked_band.h masks the facets that are known to be hidden. Facets that
   neither reflect nor belong to a curved part are left out: mismatch 0. Status: LRCS_OK;
   LRCS_E_MEMORY; LRCS_E_LIMIT. The fractions stay in the work area; scratch memory is released. */
int lrcsi_proximity_band_make(lrcsi_classification *classification, lrcsi_meter *meter,
                              lrcs_work *work, lrcsi_proximity_band *band);

/* Joins facets of one part across edges into groups, each named by its first facet: facets of
   curved parts without bands or, if `candidate` is given, facets that it marks and, if `alike` is
   1, that meet bands of the same parts. */
void lrcsi_proximity_band_join(const lrcsi_proximity_band *band, const unsigned char *candidate,
                               int alike, uint32_t *group);

#endif
