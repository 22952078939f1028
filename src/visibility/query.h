/* SPDX-License-Identifier: MIT */
/* One exact sample on a facet: is the facet hidden there? */
#ifndef LRCSI_QUERY_H
#define LRCSI_QUERY_H

#include "visibility/classify.h"

enum lrcsi_query_answer {
    LRCSI_QUERY_HIDDEN = 0,
    LRCSI_QUERY_VISIBLE = 1,
    LRCSI_QUERY_UNDECIDED = 2 /* no point inside the facet was found, depths too close, or the
                                 meter spent */
};

/* All of these reserve their steps from a meter; NULL: there is no limit. */

/* Asks at the facet's centroid, or at another interior point where that one rounds outside. */
int lrcsi_query_facet(const lrcsi_grid *facets, uint32_t facet, lrcsi_meter *meter);

/* Asks at a point of the facet, rounded; undecided where the facet does not cover it. */
int lrcsi_query_point(const lrcsi_grid *facets, uint32_t facet, const double point[3],
                      lrcsi_meter *meter);

/* Makes a grid of facets that serves every undecided facet, and asks for every uniform facet, once
   a region: answer[facet], a lrcsi_query_answer. Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. */
int lrcsi_query_uniform(const lrcsi_classification *classification, lrcsi_meter *meter,
                        lrcs_work *work, lrcsi_grid *facets, unsigned char *answer);

/* 1 if an undecided facet is proved to be hidden, all of it behind one component; else 0, as
   where the meter is spent. It may ask classification for the facet's crossings, which are
   then at hand (visibility/classify.h). */
int lrcsi_query_screened(lrcsi_classification *classification, const lrcsi_grid *facets,
                         uint32_t facet, lrcsi_meter *meter);

#endif
