/* SPDX-License-Identifier: MIT */
/* One exact sample on a facet: is the facet hidden there? */
#ifndef LRCSI_QUERY_H
#define LRCSI_QUERY_H

#include "scene/part_set.h"
#include "visibility/base/visible_area.h"
#include "visibility/uniform/classify.h"

enum lrcsi_query_answer {
    LRCSI_QUERY_HIDDEN = 0,
    LRCSI_QUERY_VISIBLE = 1,
    LRCSI_QUERY_NO_ANSWER = 2 /* no point inside the facet was found, the depths are too close,
                                 or the meter is spent */
};

/* All queries take their steps from a meter; NULL: no limit. */

/* A query at the facet's centroid, or at another interior point if rounding moves the centroid
   outside the facet. */
int lrcsi_query_facet(const lrcsi_grid *facets, uint32_t facet, lrcsi_meter *meter);

/* A query at a given point of the facet, rounded; undecided if the facet does not cover it. The
   lists of the grid must be complete about the facet: it is one of its readers
   (visibility/index/grid.h). */
int lrcsi_query_point(const lrcsi_grid *facets, uint32_t facet, const double point[3],
                      lrcsi_meter *meter);

/* 1 if at a point as in lrcsi_query_facet a facet of a part outside the set hides the facet. */
int lrcsi_query_hidden_by_others(const lrcsi_grid *facets, uint32_t facet, lrcsi_part_set parts,
                                 lrcsi_meter *meter);

/* Bytes for lrcsi_query_uniform, at most. */
size_t lrcsi_query_need(const lrcs_prepared *prepared);

/* Makes a grid of facets for queries of undecided facets, and makes one query for each region of
   uniform facets. Returned: answer[facet], a lrcsi_query_answer: that of a uniform facet; NO_ANSWER
   for undecided facets; HIDDEN for those that cannot be visible.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. The grid stays in the work area.
   Boxes of the classification that are needed are made. */
int lrcsi_query_uniform(lrcsi_classification *classification, lrcsi_meter *meter, lrcs_work *work,
                        lrcsi_grid *facets, unsigned char *answer);

/* Sets visible[facet] to all of the facet or nothing, by its lrcsi_query_answer; does not change it
   if there is no answer. */
void lrcsi_query_areas(const lrcsi_view *view, const unsigned char *answer,
                       lrcsi_visible_area *visible);

/* Tries to prove that one surface component hides an undecided facet entirely. Returns 1 if that is
   proved; 0 if not, or if the meter is spent. If it needs the crossings of the facet, they are
   returned. */
int lrcsi_query_hidden_by_component(lrcsi_classification *classification, const lrcsi_grid *facets,
                                    uint32_t facet, lrcsi_meter *meter, lrcsi_crossings *crossings);

#endif
