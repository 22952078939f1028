/* SPDX-License-Identifier: MIT */
/* The flat faces that parts show the laser, behind the outlines of true curved shapes and of their
   facets: how much more of it the true shapes leave visible than their facets do, in the margins
   along event edges over it. The proximity band bounds the difference elsewhere on the face
   (visibility/proximity/event_band.c, 6). */
#ifndef LRCSI_FACE_MARGIN_H
#define LRCSI_FACE_MARGIN_H

#include "visibility/proximity/face_frame.h"
#include "visibility/uniform/classify.h"

/* Of a face. */
typedef struct lrcsi_face_margin {
    int known;             /* 0: there is no such face, or nothing is known; the others are not
                              set. A face of a curved part is known even without margins */
    double area;           /* in projection, scaled: what the true shapes leave visible of the face
                              in these margins, less what their facets leave */
    double error;          /* bound on its error */
    lrcsi_part_set causes; /* the parts whose outlines the margins belong to */
    lrcsi_part_set cut;    /* parts that pierce the face, but for the last one of the set: the
                              margins contain all that their true shapes and facets hide of it
                              differently */
} lrcsi_face_margin;

/* The faces that include the margin of an event edge, beside one another or one behind the
   other; LRCS_NONE: no further face. */
#define LRCSI_EDGE_FACES 4
typedef struct lrcsi_edge_faces {
    uint32_t face[LRCSI_EDGE_FACES];
} lrcsi_edge_faces;

static inline int lrcsi_edge_faces_hold(const lrcsi_edge_faces *faces, uint32_t face)
{
    return faces->face[0] == face || faces->face[1] == face || faces->face[2] == face ||
           faces->face[3] == face;
}

/* Fills face[LRCSI_FACES_OF_PART * part_count]: the areas along all event edges over each face.
   Where the margin of an edge, or of a part of one, lies on the face alone, its area is known with
   its sign; elsewhere it is between the loss and the gain of visibility/proximity/outline_area.h.
   Also returned: faces[event]. Where steps or memory run out, fewer margins are known. Scratch
   memory is released. */
void lrcsi_face_margins_make(lrcsi_event_bands *bands, const lrcsi_classification *classification,
                             lrcs_work *work, lrcsi_face_margin *face, lrcsi_edge_faces *faces);

/* Scratch memory for it. */
size_t lrcsi_face_margins_need(const lrcs_prepared *prepared);

#endif
