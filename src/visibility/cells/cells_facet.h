/* SPDX-License-Identifier: MIT */
/* Facets and segments in view coordinates from the middle of a block of the view plane: their
   lines, planes, heights and errors, and which of two facets is nearer
   (visibility/cells/cells.c). */
#ifndef LRCSI_CELLS_FACET_H
#define LRCSI_CELLS_FACET_H

#include "base/dd.h"
#include "view/view.h"
#include "visibility/base/clip.h"
#include "visibility/index/marks.h"

/* The record of a facet that can hide others (lrcsi_view_casts), in view coordinates. */
typedef struct lrcsi_cells_facet {
    double low[2], high[2]; /* its box */
    double err;             /* error of its vertices, and of their distances from a line */
    double z_low, z_high;   /* bounds of z of all of it */
    double line_err;        /* error of its sides within the block, in addition to 16 u b */
    double x[3], y[3];      /* corners, counter-clockwise */
    double side[3][3];      /* distance from the line of side k: a x + b y + c, positive inside */
    double length[3];       /* of the sides, upper bounds */
    double z[3];            /* the plane: a x + b y + c */
    double plane_err[2];    /* the error of z at a point within w of the facet is [0] + [1] w */
    double z_err;           /* error of z of its vertices */
    uint32_t neighbour[3];  /* the record of the facet that continues it across each side; 0: that
                               facet is not in the block; LRCS_NONE: there is none */
    uint32_t facet;         /* its number in the scene */
    int degenerate;         /* 1: too narrow in the view for its sides to be known; they are those
                               of a band that contains it */
    int unknown_contact;    /* one of its contacts could not be computed */
} lrcsi_cells_facet;

/* An event edge or a contact. */
typedef struct lrcsi_cells_segment {
    double end[2][3];
    double line[3]; /* distance from its line: a x + b y + c */
    double length;
    double err;        /* error of its ends, and of their distances from a line */
    double line_err;   /* error of its line within the block, in addition to 16 u b */
    double z_err;      /* error of z of its ends */
    uint32_t owner[2]; /* facets whose edge or contact it is: in a block the numbers of their
                          records, 0 for those that are not in it; for a single facet their numbers
                          in the scene (lrcsi_division_owner). The second may be LRCS_NONE */
    uint32_t edge;     /* if it is an edge of more than two facets; else LRCS_NONE */
    int contact;       /* the lrcsi_contact_kind of a contact; 0: an edge */
} lrcsi_cells_segment;

/* A vertex: in the view, and relative to the middle of a block. */
typedef struct lrcsi_cells_point {
    lrcsi_dd x[2], local[2];
    double z;
    double err;      /* error of `local`, rounded, and of its distance from a line */
    double line_err; /* error of lines through it within the block, in addition to 16 u b */
    double z_err;
    uint32_t block; /* of `local` */
} lrcsi_cells_point;

/* The axes of the view, and its vertices, computed when they are first needed. */
typedef struct lrcsi_cells_frame {
    const lrcsi_view *view;
    double axis_low[2][3];
    unsigned char *made;      /* vertex: 1 if its point is computed */
    lrcsi_cells_point *point; /* vertex */
    double middle[2];         /* of the current block */
    uint32_t block;           /* its number, from 1 */
} lrcsi_cells_frame;

void lrcsi_cells_frame_make(lrcsi_cells_frame *c);

/* A vertex relative to the middle of the current block. */
const lrcsi_cells_point *lrcsi_cells_vertex(lrcsi_cells_frame *c, uint32_t vertex);

/* The line through two vertices. Returns their distance, with a relative error of 4 u. */
double lrcsi_cells_line(const lrcsi_cells_point *p, const lrcsi_cells_point *q, double line[3]);

/* Makes the record of a facet for the current block, without its neighbours. */
void lrcsi_cells_facet_make(lrcsi_cells_frame *c, uint32_t facet, lrcsi_cells_facet *f);

/* Bounds of a facet's z at a point that it may cover. */
void lrcsi_cells_facet_z(const lrcsi_cells_facet *f, const double at[2], double tolerance,
                         double range[2]);

/* A lower bound (sign -1) or an upper bound (1) of a facet's z in the box of the cell. */
double lrcsi_cells_facet_z_bound(const lrcsi_cells_facet *f, const lrcsi_clip_sides *s, int sign);

/* Which of two facets that certainly cover a point is nearer there, exactly: 1 the second, -1 the
   first, 0 it cannot be decided. */
int lrcsi_cells_facet_order(const lrcsi_view *view, uint32_t first, uint32_t second);

/* Does a facet overlap another in its plane? */
int lrcsi_cells_has_coplanar(const lrcsi_view *view, uint32_t facet);

/* The facet that continues a facet across side k, sides numbered as in the scene; LRCS_NONE if the
   edge is an event of the view (visibility/index/event.h). */
uint32_t lrcsi_cells_neighbour(const lrcsi_view *view, uint32_t facet, int k);

/* The same for cells: all edges of facets that overlap others in their plane, and edges along which
   others meet one of the two facets, count as events too, so that no component continues across
   them. Given: lrcsi_cells_has_coplanar of each facet. */
uint32_t lrcsi_cells_connected(const lrcsi_view *view, const unsigned char *coplanar,
                               uint32_t facet, int k);

/* The number in the scene of the side that runs from corner k of a facet's record. */
int lrcsi_cells_side_number(const lrcsi_view *view, uint32_t facet, int k);

#endif
