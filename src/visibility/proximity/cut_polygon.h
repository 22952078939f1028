/* SPDX-License-Identifier: MIT */
/* The image in a view of what the facets of a closed convex part enclose in front of a plane: a
   convex polygon (K' of the cut solid in visibility/proximity/outline.c). */
#ifndef LRCSI_CUT_POLYGON_H
#define LRCSI_CUT_POLYGON_H

#include "visibility/proximity/edge_margin.h"

typedef struct lrcsi_cut_polygon {
    double (*corner)[3]; /* counter-clockwise, in view coordinates */
    uint32_t count;
} lrcsi_cut_polygon;

/* The polygon of a part, in front of the plane of a face, in the work area. Returns 0 if the part
   meets the plane within `distance` of the border of a round face or outside it, or its facets are
   not all live; or if there is too little memory, or the limit of steps is reached. */
int lrcsi_cut_polygon_make(const lrcsi_event_bands *bands, uint32_t part,
                           const lrcsi_face_frame *face, double distance, lrcs_work *work,
                           lrcsi_cut_polygon *polygon);

/* Bytes for it, at most. */
size_t lrcsi_cut_polygon_need(const lrcs_prepared *prepared);

/* Adds the parts of the polygon's side from corner i, given as an edge, that are too near other
   sides: (d) of face_margin.c, with the sides in the place of event edges. Returned: the turns at
   both ends. */
void lrcsi_cut_polygon_find_gaps(const lrcsi_cut_polygon *polygon, uint32_t i,
                                 const lrcsi_edge_margin *side, lrcsi_edge_gaps *gaps,
                                 double turn[2]);

#endif
