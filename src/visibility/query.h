/* SPDX-License-Identifier: MIT */
/* One exact sample on a facet: is the facet hidden there? */
#ifndef LRCSI_QUERY_H
#define LRCSI_QUERY_H

#include "visibility/classify.h"

enum lrcsi_query_answer {
    LRCSI_QUERY_HIDDEN = 0,
    LRCSI_QUERY_VISIBLE = 1,
    LRCSI_QUERY_UNDECIDED = 2 /* no point inside the facet was found, the depths are too close,
                                 or the meter is spent */
};

/* All of these take their steps from a meter; NULL: no limit. */

/* A query at the facet's centroid, or at another interior point if rounding moves the centroid
   outside. */
int lrcsi_query_facet(const lrcsi_grid *facets, uint32_t facet, lrcsi_meter *meter);

/* A query at a given point of the facet, rounded; undecided if the facet does not cover it. */
int lrcsi_query_point(const lrcsi_grid *facets, uint32_t facet, const double point[3],
                      lrcsi_meter *meter);

/* Makes a grid of facets for queries of undecided facets, and makes one query for each region of
   uniform facets: answer[facet] is a lrcsi_query_answer.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. */
int lrcsi_query_uniform(const lrcsi_classification *classification, lrcsi_meter *meter,
                        lrcs_work *work, lrcsi_grid *facets, unsigned char *answer);

/* 1 if an undecided facet is proved to be hidden, entirely behind one component; otherwise 0, also
   when the meter is spent. It may make classification find the facet's crossings
   (visibility/classify.h). */
int lrcsi_query_screened(lrcsi_classification *classification, const lrcsi_grid *facets,
                         uint32_t facet, lrcsi_meter *meter);

#endif
