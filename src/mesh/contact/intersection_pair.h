/* SPDX-License-Identifier: MIT */
/* How two facets meet in space. */
#ifndef LRCSI_INTERSECTION_PAIR_H
#define LRCSI_INTERSECTION_PAIR_H

#include <lrcs/mesh.h>

enum lrcsi_intersection_kind {
    LRCSI_INTERSECTION_NONE = -1,   /* no contact */
    LRCSI_INTERSECTION_CROSS = 0,   /* not in one plane: `other` meets the interior of `facet` */
    LRCSI_INTERSECTION_COPLANAR = 1 /* exactly in one plane, and their interiors overlap */
};

/* A facet's corners (two facets have a corner in common if the pointers are equal), and its plane,
   which lrcsi_pair_plane computes. */
typedef struct lrcsi_pair_facet {
    const double *x[3];
    double normal[3], weight[3]; /* computed; scale of its error */
    int axis;                    /* of the largest component of the normal */
    int orientation;             /* exact orientation seen along that axis; 0 if degenerate */
} lrcsi_pair_facet;

/* How the facets F and T meet: index 0 is about F, which T meets, index 1 about T, which F meets.
   kind: a lrcsi_intersection_kind. met: 1 if the facet is met elsewhere than in its corners and
   along sides that both have. */
typedef struct lrcsi_pair_result {
    int kind[2];
    int met[2];
} lrcsi_pair_result;

void lrcsi_pair_plane(lrcsi_pair_facet *f);

/* Given: F with its plane; that of T is computed if it is needed. Neither may be degenerate.
   Returns 0 if they meet at most in common corners and sides; *result then says so. */
int lrcsi_pair_meet(const lrcsi_pair_facet *f, lrcsi_pair_facet *t, lrcsi_pair_result *result);

/* Does a corner of either lie inside a side of the other? */
int lrcsi_pair_on_side(const lrcsi_pair_facet *f, const lrcsi_pair_facet *t);

/* How `other` (closed) meets the relative interior of `facet`: a lrcsi_intersection_kind. Neither
   may be degenerate. */
int lrcsi_intersection_pair(const lrcs_point *vertex, lrcs_facet facet, lrcs_facet other);

#endif
