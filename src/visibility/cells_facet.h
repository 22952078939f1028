/* SPDX-License-Identifier: MIT */
/* Facets and segments in view coordinates from the middle of a block of the view plane: their
   lines, planes, heights and errors, and which of two facets is nearer (visibility/cells.c). */
#ifndef LRCSI_CELLS_FACET_H
#define LRCSI_CELLS_FACET_H

#include "base/dd.h"
#include "view/view.h"
#include "visibility/cells_shape.h"

/* What is known of a facet in all cells, bits. */
enum {
    LRCSI_CELLS_APART = 1, /* no facet continues it: it meets others in its plane */
    LRCSI_CELLS_VAGUE = 2, /* one of its contacts could not be computed */
    LRCSI_CELLS_LINKED = 4 /* the facets that continue it have been found */
};

/* A facet that casts, in view coordinates. */
typedef struct lrcsi_cells_facet {
    double x[3], y[3];      /* corners, counter-clockwise */
    double side[3][3];      /* distance from the line of side k: a x + b y + c, positive inside */
    double length[3];       /* of the sides, upper bounds */
    double z[3];            /* the plane: a x + b y + c */
    double z_off[2];        /* that of a place on the facet is off by [0] + [1] w */
    double z_low, z_high;   /* that of all of it */
    double low[2], high[2]; /* its box */
    double off;             /* of its vertices, and of how far they are from a line */
    double line_off;        /* of its sides within the block, but for 16 u b */
    double z_err;           /* of their z */
    uint32_t next[3];       /* who continues it across each side (lrcsi_cells_next) */
    uint32_t number;        /* the scene's */
    int thin;               /* its sides are those of a band */
} lrcsi_cells_facet;

/* An event edge or a contact. */
typedef struct lrcsi_cells_segment {
    double end[2][3];
    double line[3]; /* distance from its line: a x + b y + c */
    double length;
    double off;        /* of its ends, and of how far they are from a line */
    double line_off;   /* of its line within the block, but for 16 u b */
    double z_err;      /* of their z */
    uint32_t owner[2]; /* facets whose edge or contact it is, the second perhaps LRCS_NONE */
    uint32_t edge;     /* of more facets; else LRCS_NONE */
    int contact;       /* of a contact, of which kind: lrcsi_contact_kind; else 0 */
} lrcsi_cells_segment;

/* A vertex, once it is made: in the view, and from the middle of a block. */
typedef struct lrcsi_cells_point {
    lrcsi_dd x[2], local[2];
    double z;
    double off;      /* of `local`, rounded, and of how far that is from a line */
    double line_off; /* of lines through it within the block, but for 16 u b */
    double z_err;
    uint32_t made, block; /* not 0 if made; the block */
} lrcsi_cells_point;

/* The axes of the view, and its vertices as they are made: zeros at first. */
typedef struct lrcsi_cells_frame {
    const lrcsi_view *view;
    double axis_low[2][3];
    lrcsi_cells_point *point; /* vertex */
    double middle[2];         /* of the block at hand, */
    uint32_t block;           /* and its number, from 1 */
} lrcsi_cells_frame;

/* Makes the axes. */
void lrcsi_cells_frame_make(lrcsi_cells_frame *c);

/* A vertex from the middle of the block at hand. */
const lrcsi_cells_point *lrcsi_cells_vertex(lrcsi_cells_frame *c, uint32_t vertex);

/* The line through two of them. Returns their distance, with a relative error of 4 u. */
double lrcsi_cells_line(const lrcsi_cells_point *p, const lrcsi_cells_point *q, double line[3]);

/* Makes the record of a facet for the block at hand. */
void lrcsi_cells_facet_make(lrcsi_cells_frame *c, uint32_t facet, lrcsi_cells_facet *f);

/* May the facet come near a cell in a box? */
int lrcsi_cells_facet_near(const lrcsi_cells_facet *f, const lrcsi_clip_polygon *shape,
                           const double low[2], const double high[2], double g);

/* Bounds of a facet's z at a place that it may cover. */
void lrcsi_cells_facet_height(const lrcsi_cells_facet *f, const double at[2], double g,
                              double range[2]);

/* A lower bound (sign -1) or an upper bound (1) of a facet's z in the box of the cell. */
double lrcsi_cells_facet_limit(const lrcsi_cells_facet *f, const lrcsi_cells_sides *s, int sign);

/* Which of two facets that surely cover a place is nearer there, exactly: 1 the second, -1 the
   first, 0 it cannot be decided. */
int lrcsi_cells_facet_order(const lrcsi_view *view, uint32_t first, uint32_t second);

/* 1 if a facet meets others in its plane: all its edges then count as events. */
int lrcsi_cells_apart(const lrcsi_view *view, uint32_t facet);

/* The facet that continues a facet across side k, sides numbered as in the scene; LRCS_NONE if the
   edge is an event of the view (visibility/event.h). */
uint32_t lrcsi_cells_joined(const lrcsi_view *view, uint32_t facet, int k);

/* The same for cells: all edges of facets that are `apart`, and edges along which others meet one
   of the two facets, count as events too, so that no component goes on across them. */
uint32_t lrcsi_cells_next(const lrcsi_view *view, const unsigned char *kind, uint32_t facet, int k);

/* The number in the scene of the side that runs from corner k of a facet's record. */
int lrcsi_cells_side_number(const lrcsi_view *view, uint32_t facet, int k);

#endif
