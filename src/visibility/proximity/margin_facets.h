/* SPDX-License-Identifier: MIT */
/* The facets of a straight wall that the margin of an event edge meets: for which parts of the edge
   they can be used, and what the margin of a facet depends on. */
#ifndef LRCSI_MARGIN_FACETS_H
#define LRCSI_MARGIN_FACETS_H

#include "base/sort.h"
#include "mesh/shape/tessellate.h"
#include "visibility/index/marks.h"
#include "visibility/proximity/edge_margin.h"

/* Of a facet: the fraction for which its order with some of these parts is not proved
   (part_order.h). */
typedef struct lrcsi_margin_unproved {
    double fraction;
    lrcsi_part_set parts;
} lrcsi_margin_unproved;

/* A plane, in view coordinates, below which points are behind all of a part. */
typedef struct lrcsi_margin_plane {
    double up[3], level; /* unit vector; its product with the plane's points */
    double err;          /* bound on the error of `level` and of products with view coordinates */
} lrcsi_margin_plane;

enum { LRCSI_MARGIN_PLANES = 6 };

/* A facet that the margin of an edge meets. */
typedef struct lrcsi_margin_facet {
    uint32_t facet;
    int usable; /* 0: the other fields are not set */
    lrcsi_wall_patch patch;
    double lateral;  /* delta of the facet */
    double farthest; /* the largest delta of it and of the facets on which its part of the margins
                        may be */
    double near[2];  /* t of the facet's points near the edge, in projection */
    lrcsi_segment_part in, outer; /* the part of the edge in the facet; the same, enlarged by
                                     errors */
    double length_err;            /* the fraction of the edge that may belong to it or not */
    double cos_ratio_err;         /* bound on |cos / cos' - 1|, where its part of the margin may be
                                     on another facet: cos of its own incidence angle, cos' of that
                                     facet's */
    double neighbour_length;      /* along the edge, where the margin may be on such facets */
    double neighbour_err;         /* a bound on the sum of cos_ratio_err over such facets, times the
                                     length along the edge where the margin may be on them */
    uint32_t sectors;             /* how far these are from it */
} lrcsi_margin_facet;

/* The facets of one edge after the other, and what is kept of all facets. */
typedef struct lrcsi_margin_facets {
    lrcsi_event_bands *bands;
    uint32_t *first_pair, *next_pair; /* facet: the first of its pairs (scene/prepared.h); pair: the
                                         next one of the same facet; LRCS_NONE: no further one */
    unsigned char *pairs;             /* facet: what is left of them */
    lrcsi_margin_unproved *unproved;  /* facet */
    lrcsi_margin_facet *facet;        /* those of the edge under examination */
    uint32_t count;                   /* so many of them */
    lrcsi_sort_item *order;           /* the same, by where they begin to be near the edge */
    double *end_max;                  /* the largest t to which these or those before are near it */
    lrcsi_margin_plane plane[LRCSI_MARGIN_PLANES]; /* below the part of this edge */
    int plane_count;     /* so many of them are made: the others when they are needed */
    lrcsi_marks reached; /* facets: those of the edge under examination */
} lrcsi_margin_facets;

/* Scratch memory for it. It stays in the work area. Status: LRCS_OK; LRCS_E_MEMORY. */
size_t lrcsi_margin_facets_need(const lrcs_prepared *prepared);
int lrcsi_margin_facets_make(lrcsi_event_bands *bands, lrcs_work *work,
                             lrcsi_margin_facets *facets);

/* May a facet have margins? It is on a straight wall, and not seen edge-on to within rounding. */
int lrcsi_margin_facet_applies(const lrcsi_view *view, uint32_t facet);

/* What of the edge is so near to a facet that visibility there may differ between true shapes and
   facets. */
lrcsi_segment_part lrcsi_margin_facet_near(const lrcsi_view *view, const lrcsi_edge_margin *margin,
                                           uint32_t facet);

/* Finds all facets of a wall that the margin of an edge meets, from one of them on, and adds the
   parts of the edge whose margins cannot be used. */
void lrcsi_margin_facets_find(lrcsi_margin_facets *facets, const lrcsi_edge_margin *margin,
                              uint32_t facet, lrcsi_edge_gaps *gaps);

#endif
