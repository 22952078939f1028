/* SPDX-License-Identifier: MIT */
/* The parts of an edge in which something is too near for a margin, and the parts between them. */
#ifndef LRCSI_EDGE_GAPS_H
#define LRCSI_EDGE_GAPS_H

#include "visibility/proximity/edge_rectangle.h"

#define LRCSI_EDGE_GAPS 8

/* Disjoint, and in order along the edge; all within 0 .. 1. */
typedef struct lrcsi_edge_gaps {
    lrcsi_segment_part gap[LRCSI_EDGE_GAPS];
    int count;
} lrcsi_edge_gaps;

/* Adds a part, of which what lies beyond the edge does not count. It is merged with the gaps that
   it meets; if there are too many, the two that are nearest to each other become one with what is
   between them. */
void lrcsi_edge_gaps_add(lrcsi_edge_gaps *gaps, lrcsi_segment_part part);

/* Adds what is not in a part. */
void lrcsi_edge_gaps_add_outside(lrcsi_edge_gaps *gaps, lrcsi_segment_part part);

/* Do they leave nothing of the edge? */
static inline int lrcsi_edge_gaps_are_all(const lrcsi_edge_gaps *gaps)
{
    return gaps->count == 1 && gaps->gap[0].from <= 0 && gaps->gap[0].to >= 1;
}

/* What is free before gap i, or behind the last one if i is their number; it may be empty. */
static inline lrcsi_segment_part lrcsi_edge_gaps_before(const lrcsi_edge_gaps *gaps, int i)
{
    const lrcsi_segment_part free = {i > 0 ? gaps->gap[i - 1].to : 0,
                                     i < gaps->count ? gaps->gap[i].from : 1};
    return free;
}

#endif
