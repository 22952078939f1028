/* SPDX-License-Identifier: MIT */
/* What is known of the visible areas of facets: the area with its bounds, and what exact queries
   decide before any sample is taken. */
#ifndef LRCSI_VISIBLE_AREA_H
#define LRCSI_VISIBLE_AREA_H

#include "visibility/classify.h"

/* Projected areas in scaled units; 0 <= low <= area <= high <= the facet's projected area, but for
   rounding. The truth lies between low and high. */
typedef struct lrcsi_visible {
    double area, low, high;
    double likely; /* of a sampled area: its likely error; else 0 */
    double bias;   /* the part of it that has a sign, too much being positive */
} lrcsi_visible;

/* What exact queries tell of facets before any sample is taken. */
typedef struct lrcsi_known {
    lrcsi_classification *classification;
    lrcsi_grid facets;
    unsigned char *answer; /* facet: a lrcsi_query_answer; hidden where it casts nothing; undecided
                              where samples are to tell */
    uint32_t listed;       /* the event edges that cross facet f < listed are
                              crossing[first[f] .. first[f + 1]), of undecided ones that samples are
                              to tell of */
    uint32_t *first, *crossing;
} lrcsi_known;

#endif
