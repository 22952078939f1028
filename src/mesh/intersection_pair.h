/* SPDX-License-Identifier: MIT */
/* How two facets meet in space. */
#ifndef LRCSI_INTERSECTION_PAIR_H
#define LRCSI_INTERSECTION_PAIR_H

#include "mesh/intersection.h"

/* A facet's corners: two facets have a corner in common where the pointers are the same. Then its
   plane, which lrcsi_touch_plane adds. */
typedef struct lrcsi_touch_facet {
    const double *x[3];
    double normal[3], weight[3]; /* computed, and what bounds the error */
    int axis;                    /* along which it is seen most broadly */
    int turn;                    /* how it turns there, exactly; 0 where it is degenerate */
} lrcsi_touch_facet;

/* How each of a pair meets the inside of the other (a lrcsi_touch_kind), and whether it does or
   meets the other's rim other than in corners of the other or along a side that both have: first
   what T does to F, then what F does to T. */
typedef struct lrcsi_touch_result {
    int kind[2];
    int rim[2];
} lrcsi_touch_result;

void lrcsi_touch_plane(lrcsi_touch_facet *f);

/* F has its plane; that of T is added where it is needed. Neither may be degenerate. Returns 0
   where they meet in nothing but corners and sides of both: *result then is that. */
int lrcsi_touch_meet(const lrcsi_touch_facet *f, lrcsi_touch_facet *t, lrcsi_touch_result *result);

/* Does a corner of either lie inside a side of the other? */
int lrcsi_touch_on_side(const lrcsi_touch_facet *f, const lrcsi_touch_facet *t);

#endif
