/* SPDX-License-Identifier: MIT */
/* The flat face that a part shows the laser, behind the outlines of true curved shapes and of their
   facets: how much more of it the true shapes leave visible than their facets do, in the margins
   along event edges where nothing else happens. Elsewhere the proximity band bounds the difference
   (visibility/proximity/event_band.c, 6). */
#ifndef LRCSI_FACE_MARGIN_H
#define LRCSI_FACE_MARGIN_H

#include "visibility/proximity/event_band.h"
#include "visibility/uniform/classify.h"

/* Of a part: a disc, or a solid with one or two flat ends, of which the laser sees at most one. */
typedef struct lrcsi_face_margin {
    int known;    /* 0: the part has no such face, or nothing is known; the others are not set */
    double area;  /* in projection, scaled: what the true shapes leave visible of the face in these
                     margins, less what their facets leave */
    double error; /* bound on its error */
} lrcsi_face_margin;

/* May a facet be one of such a face, seen by the laser? */
int lrcsi_face_margin_holds(const lrcsi_view *view, uint32_t facet);

/* Which sides of such a facet are sides of the face: bit k stands for the side from corner k to
   k + 1. */
unsigned lrcsi_face_margin_sides(const lrcsi_view *view, uint32_t facet);

/* Fills face[part]. Also returned: on[event], the part over whose face alone the margin of an event
   edge lies, which is part of its area, or LRCS_NONE. Where steps or memory run out, fewer margins
   are known. Scratch memory is released. */
void lrcsi_face_margins_make(lrcsi_event_bands *bands, lrcsi_classification *classification,
                             lrcs_work *work, lrcsi_face_margin *face, uint32_t *on);

/* Scratch memory for it. */
size_t lrcsi_face_margins_need(const lrcs_prepared *prepared);

#endif
