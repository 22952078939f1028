/* SPDX-License-Identifier: MIT */
/* The visible area of a facet with its bounds, and what exact queries decide before samples are
   taken. */
#ifndef LRCSI_VISIBLE_AREA_H
#define LRCSI_VISIBLE_AREA_H

#include "visibility/classify.h"

/* Projected areas in scaled units. Except for rounding, 0 <= low <= area <= high <= the facet's
   projected area. The true area is between low and high. */
typedef struct lrcsi_visible {
    double area, low, high;
    double error_estimate; /* estimated error of an area from samples; else 0 */
    double bias; /* the part of that error that has a sign: positive if the area is too large */
} lrcsi_visible;

/* An area without uncertainty: that of a facet known to be entirely visible; or 0, if it is hidden.
 */
static inline lrcsi_visible lrcsi_visible_exactly(double area)
{
    return (lrcsi_visible){.area = area, .low = area, .high = area};
}

/* The first moment of a facet's visible region: the integral of x - c over its projection, c the
   facet's centroid in the view plane. 0 for a facet that is entirely visible or hidden. */
typedef struct lrcsi_moment {
    double first[2];
    double error; /* bound on the error of either component; HUGE_VAL: the moment is not known */
    double reach; /* scratch of its computation: the largest distance from c of what is visible */
} lrcsi_moment;

/* Items first .. first + count - 1 of a list. */
typedef struct lrcsi_known_list {
    uint32_t first, count;
} lrcsi_known_list;

/* What exact queries decide about facets before samples are taken. */
typedef struct lrcsi_known {
    lrcsi_classification *classification;
    lrcsi_grid facets;
    unsigned char *answer;  /* facet: a lrcsi_query_answer; hidden if it casts no shadow; undecided
                               if samples have to decide */
    uint32_t listed;        /* facets below this have lists */
    lrcsi_known_list *list; /* facet, if its answer is undecided: the event edges that cross it */
    uint32_t *crossing;     /* the items of these lists: topology edges */
    lrcsi_crossings search; /* room to search for the crossings of a facet without a list */
} lrcsi_known;

#endif
