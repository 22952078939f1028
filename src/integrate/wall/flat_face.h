/* SPDX-License-Identifier: MIT */
/* The flat faces of parts behind true curved shapes: for which of them the margins of
   visibility/proximity/face_margin.h are used, and what they add to sigma. */
#ifndef LRCSI_FLAT_FACE_H
#define LRCSI_FLAT_FACE_H

#include "visibility/base/visible_area.h"
#include "visibility/proximity/masked_band.h"

/* Of a face (visibility/proximity/face_frame.h). Areas are in projection, scaled. */
typedef struct lrcsi_flat_face {
    uint32_t facet; /* the one that represents the face in the sum; LRCS_NONE: margins are not
                              used */
    double area;    /* of the margins: to be added to what is visible of the facet; may be < 0 */
    double error;   /* bound on the error of that area */
    lrcsi_part_set causes; /* the parts whose outlines the margins belong to */
} lrcsi_flat_face;

/* The face of a facet, if its margins are used; NULL if it is on none, or they are not. Given: all
   faces, or NULL. */
static inline const lrcsi_flat_face *lrcsi_flat_face_of(const lrcsi_flat_face *face,
                                                        const lrcsi_view *view, uint32_t facet)
{
    const uint32_t number = face ? lrcsi_face_of(view, facet) : LRCS_NONE;
    return number != LRCS_NONE && face[number].facet != LRCS_NONE ? &face[number] : NULL;
}

/* May what the true face has in place of a facet on it lie beside the facet? */
static inline int lrcsi_flat_face_exceeds(const lrcsi_view *view, uint32_t facet)
{
    const lrcs_scene *scene = view->prepared->scene;
    return scene->part[scene->facet_part[facet]].bounds.reach > 0 &&
           lrcsi_face_border_sides(view, facet) != 0;
}

/* What is to be added to the visible area of a facet: 0 for all but one of a face. */
static inline double lrcsi_flat_face_area(const lrcsi_flat_face *face, const lrcsi_view *view,
                                          uint32_t facet)
{
    const lrcsi_flat_face *own = lrcsi_flat_face_of(face, view, facet);
    return own && own->facet == facet ? own->area : 0;
}

/* Fills face[LRCSI_FACES_OF_PART * part_count]. Given: the visible areas of all facets. */
void lrcsi_flat_faces_make(const lrcsi_masked_band *band, const lrcsi_visible_area *visible,
                           lrcsi_flat_face *face);

#endif
