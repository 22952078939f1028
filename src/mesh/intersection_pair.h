/* SPDX-License-Identifier: MIT */
/* How two facets meet in space. */
#ifndef LRCSI_INTERSECTION_PAIR_H
#define LRCSI_INTERSECTION_PAIR_H

#include <lrcs/mesh.h>

enum lrcsi_intersection_kind {
    LRCSI_INTERSECTION_NONE = -1,   /* no contact */
    LRCSI_INTERSECTION_CROSS = 0,   /* not in one plane: `other` meets the open inside of `facet` */
    LRCSI_INTERSECTION_COPLANAR = 1 /* exactly in one plane, and their open insides overlap */
};

/* A facet's corners: two facets have a corner in common where the pointers are the same. Then its
   plane, which lrcsi_pair_plane adds. */
typedef struct lrcsi_pair_facet {
    const double *x[3];
    double normal[3], weight[3]; /* computed, and what bounds the error */
    int axis;                    /* along which it is seen most broadly */
    int turn;                    /* how it turns there, exactly; 0 if it is degenerate */
} lrcsi_pair_facet;

/* How each of a pair meets the inside of the other (a lrcsi_intersection_kind), and whether it does
   or meets the other's rim other than in corners of the other or along a side that both have: first
   what T does to F, then what F does to T. */
typedef struct lrcsi_pair_result {
    int kind[2];
    int rim[2];
} lrcsi_pair_result;

void lrcsi_pair_plane(lrcsi_pair_facet *f);

/* F has its plane; that of T is added where it is needed. Neither may be degenerate. Returns 0 if
 * they meet in nothing but corners and sides of both: *result then is that. */
int lrcsi_pair_meet(const lrcsi_pair_facet *f, lrcsi_pair_facet *t, lrcsi_pair_result *result);

/* Does a corner of either lie inside a side of the other? */
int lrcsi_pair_on_side(const lrcsi_pair_facet *f, const lrcsi_pair_facet *t);

/* How `other` (closed) meets the relative interior of `facet`: a lrcsi_intersection_kind. Neither
   may be degenerate. */
int lrcsi_intersection_pair(const lrcs_point *vertex, lrcs_facet facet, lrcs_facet other);

#endif
