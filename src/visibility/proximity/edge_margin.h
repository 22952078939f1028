/* SPDX-License-Identifier: MIT */
/* Event edges of a curved part over the surface of another one behind it: whether nothing else is
   near enough to such an edge to change what is visible beside it. Then the area between the
   outlines along the edge is known with its sign (visibility/proximity/face_margin.c). */
#ifndef LRCSI_EDGE_MARGIN_H
#define LRCSI_EDGE_MARGIN_H

#include "visibility/proximity/edge_gaps.h"
#include "visibility/proximity/face_frame.h"

/* An event edge, or a part of one: its ends, the distance w; the shape's part with its outline. */
typedef struct lrcsi_edge_margin {
    uint32_t event, part;   /* event: LRCS_NONE for a side of a polygon (cut_polygon.h) */
    const lrcsi_edge *edge; /* likewise NULL */
    int side;               /* of the part's facets, as of events */
    uint32_t end[2];        /* the vertices at a and b; of a side, what the caller sets: corners */
    const lrcsi_outline *outline;
    double a[3], b[3];
    double length, along[2], outward[2]; /* outward: away from the part's facets */
    double order_err;  /* the distance in projection within which it is not known what is in front
                         (lrcsi_outline_in_front) */
    double err, width; /* e; w */
    double direction_err; /* rad, in projection */
} lrcsi_edge_margin;

/* The surface behind it. */
typedef struct lrcsi_margin_receiver {
    uint32_t part, facet;         /* P, and one of its facets under the edge */
    const lrcsi_face_frame *face; /* its flat face; NULL: a wall */
    double order_err;             /* on a face: the largest of any part */
} lrcsi_margin_receiver;

/* Makes the data of an event edge, given its part's outline, of which k may be larger than that of
   the part; its order_err. Returns 0 if it is not a contour edge of a part other than P that has an
   outline. */
int lrcsi_edge_margin_make(const lrcsi_event_bands *bands, const lrcsi_outline *outline,
                           uint32_t event, uint32_t receiver, double order_err,
                           lrcsi_edge_margin *margin);

/* The same for a side of a polygon, counter-clockwise. Returns 0 if it is too short. */
int lrcsi_edge_margin_make_side(const lrcsi_outline *outline, uint32_t part, const double a[3],
                                const double b[3], double order_err, lrcsi_edge_margin *margin);

/* An upper bound of the angle between an edge and the direction of another one, which leads away
   from an end of it; negative if it may be larger than 0.5 rad. */
double lrcsi_edge_margin_turn(const lrcsi_edge_margin *margin, const double away[2]);

/* At an end of the edge, given the turn there: an upper bound of the area of the points that are
   attributed to another edge than by the perpendicular, if points that true shapes and facets hide
   differently are no deeper than `depth` (face_margin.c). They are also within 2 k of the contour,
   and so no deeper than 2.28 k: the area is below 4.4 k^2 times the turn. */
double lrcsi_edge_margin_end(const lrcsi_edge_margin *margin, double depth, double turn);

/* Adds the parts of an edge near which (c) or (d) of face_margin.c, or on a wall of wall_margin.c,
   does not hold. Returned: A and B, the turns at both ends, for parts that begin or end there. Of
   the side of a polygon, (d) is not tested, and no turns are returned. */
void lrcsi_edge_margin_find_gaps(lrcsi_event_bands *bands, const lrcsi_edge_margin *margin,
                                 const lrcsi_margin_receiver *receiver, lrcsi_edge_gaps *gaps,
                                 double turn[2]);

/* Adds what is within w of the end a (0) or b (1). */
void lrcsi_edge_margin_add_end_gap(const lrcsi_edge_margin *margin, int end, lrcsi_edge_gaps *gaps);

/* A part of an edge near which nothing else is: as an edge of its own. The rest of the edge follows
   it, without a turn. */
typedef struct lrcsi_edge_part {
    lrcsi_segment_part of; /* the edge */
    lrcsi_edge_margin margin;
    double turn[2];
} lrcsi_edge_part;

/* The part before gap i, or behind the last one if i is their number, given the turns at the ends
   of the edge. It begins at an end of the edge, or at least w from it; likewise it ends. Returns 0
   if it is too short to be of use. */
int lrcsi_edge_margin_part(const lrcsi_edge_margin *edge, const lrcsi_edge_gaps *gaps, int i,
                           const double turn[2], lrcsi_edge_part *part);

#endif
