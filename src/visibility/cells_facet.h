/* SPDX-License-Identifier: MIT */
/* Facets and segments in view coordinates from the middle of a block of the view plane: their
   lines, planes, heights and errors, and which of two facets is nearer (visibility/cells.c). */
#ifndef LRCSI_CELLS_FACET_H
#define LRCSI_CELLS_FACET_H

#include "view/view.h"
#include "visibility/cells_shape.h"

/* A facet that casts, in view coordinates. */
typedef struct lrcsi_cells_facet {
    double x[3], y[3];      /* corners, counter-clockwise */
    double side[3][3];      /* distance from the line of side k: a x + b y + c, positive inside */
    double length[3];       /* of the sides, upper bounds */
    double z[3];            /* the plane: a x + b y + c */
    double z_off[2];        /* that of a place on the facet is off by [0] + [1] w */
    double z_low, z_high;   /* that of all of it */
    double low[2], high[2]; /* its box */
    double off;             /* of its vertices */
    double z_err;           /* of their z */
    int thin;               /* its sides are those of a band */
} lrcsi_cells_facet;

/* An event edge or a contact. */
typedef struct lrcsi_cells_segment {
    double end[2][3];
    double line[3]; /* distance from its line: a x + b y + c */
    double length;
    double off;        /* of its ends */
    double z_err;      /* of their z */
    uint32_t owner[2]; /* facets whose edge or contact it is, the second perhaps LRCS_NONE */
    uint32_t edge;     /* of more facets; else LRCS_NONE */
    int contact;
} lrcsi_cells_segment;

/* A vertex in the view, made in the frame of that number. */
typedef struct lrcsi_cells_point {
    double x[3];
    uint32_t frame;
} lrcsi_cells_point;

/* The axes of the view, and its vertices as they are made: zeros at first. */
typedef struct lrcsi_cells_frame {
    const lrcsi_view *view;
    double axis_low[2][3];
    const double *origin;     /* a scene point */
    uint32_t number;          /* of frames so far */
    lrcsi_cells_point *point; /* vertex */
    double middle[2];         /* of the block at hand */
} lrcsi_cells_frame;

/* Makes the axes; the origin is that of the view. */
void lrcsi_cells_frame_make(lrcsi_cells_frame *c);

/* Puts the origin elsewhere, and the middle there. */
void lrcsi_cells_frame_move(lrcsi_cells_frame *c, const double *origin);

/* A vertex from the middle of the block at hand; *off grows to how far that may be off, and lines
   through it, *z_err to the error of z. */
void lrcsi_cells_vertex(lrcsi_cells_frame *c, uint32_t vertex, double out[3], double *off,
                        double *z_err);

/* Makes the record of a facet for the block at hand. */
void lrcsi_cells_facet_make(lrcsi_cells_frame *c, uint32_t facet, lrcsi_cells_facet *f);

/* The line and the length of a segment whose ends are told. */
void lrcsi_cells_segment_line(lrcsi_cells_segment *e);

/* May the facet come near a cell in a box? */
int lrcsi_cells_facet_near(const lrcsi_cells_facet *f, const lrcsi_clip_polygon *shape,
                           const double low[2], const double high[2], double g);

/* What is known of z of a facet at a place that it may cover. */
void lrcsi_cells_facet_height(const lrcsi_cells_facet *f, const double at[2], double g,
                              double range[2]);

/* What a plane's z is at least (sign -1), or at most (1), at places of the facet in the box of the
   cell. */
double lrcsi_cells_facet_limit(const lrcsi_cells_facet *f, const lrcsi_cells_sides *s, int sign);

/* Which of two facets that surely cover a place is nearer there, exactly: 1 the second, -1 the
   first, 0 it cannot be told. */
int lrcsi_cells_facet_order(const lrcsi_view *view, uint32_t first, uint32_t second);

#endif
