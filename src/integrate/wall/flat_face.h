/* SPDX-License-Identifier: MIT */
/* The flat faces of parts behind true curved shapes: for which of them the margins of
   visibility/proximity/face_margin.h are used, and what they add to sigma. */
#ifndef LRCSI_FLAT_FACE_H
#define LRCSI_FLAT_FACE_H

#include "visibility/base/visible_area.h"
#include "visibility/proximity/masked_band.h"

/* Of a part. Areas are in projection, scaled. */
typedef struct lrcsi_flat_face {
    uint32_t facet; /* the one that represents the face in the sum; LRCS_NONE: margins are not
                              used */
    double area;    /* of the margins: to be added to what is visible of the facet; may be < 0 */
    double error;   /* bound on the error of that area */
    lrcsi_part_set causes; /* the parts whose outlines the margins belong to */
} lrcsi_flat_face;

/* Is a facet one of a face whose margins are used? Given: face[part], or NULL. */
static inline int lrcsi_flat_face_uses(const lrcsi_flat_face *face, const lrcsi_view *view,
                                       uint32_t facet)
{
    return face && face[view->prepared->scene->facet_part[facet]].facet != LRCS_NONE &&
           lrcsi_face_has_facet(view, facet);
}

/* What is to be added to the visible area of a facet: 0 for all but one of a face. */
static inline double lrcsi_flat_face_area(const lrcsi_flat_face *face, const lrcsi_view *view,
                                          uint32_t facet)
{
    const lrcsi_flat_face *own = face ? &face[view->prepared->scene->facet_part[facet]] : NULL;
    return own && own->facet == facet ? own->area : 0;
}

/* Fills face[part]. Given: the visible areas of all facets. */
void lrcsi_flat_faces_make(const lrcsi_masked_band *band, const lrcsi_visible_area *visible,
                           lrcsi_flat_face *face);

#endif
