/* SPDX-License-Identifier: MIT */
/* The boxes in the view of facets that can hide something, made run by run (scene/runs.h) where
   somebody asks: most runs are told by one box around all of their facets. */
#ifndef LRCSI_BOXES_H
#define LRCSI_BOXES_H

#include "view/box.h"

enum lrcsi_boxes_state {
    LRCSI_BOXES_NONE,  /* no facet of the run can hide anything */
    LRCSI_BOXES_RUN,   /* the run's box is made, */
    LRCSI_BOXES_FACETS /* and those of its facets that can hide something */
};

typedef struct lrcsi_boxes {
    const lrcsi_view *view;
    lrcsi_view_box *facet;
    lrcsi_view_box *run;
    unsigned char *state; /* run: a lrcsi_boxes_state */
} lrcsi_boxes;

/* Can a facet hide anything, and be seen? Not where it is redundant in this view. */
static inline int lrcsi_grid_casts(const lrcsi_view *view, uint32_t facet)
{
    int facing = view->facing[facet];
    int redundant = view->prepared->redundant[facet];
    return (facing > 0 && redundant < LRCSI_REDUNDANT) ||
           (facing < 0 && redundant < LRCSI_REDUNDANT_FROM_BEHIND && view->backs_cast);
}

/* Bytes at most. */
size_t lrcsi_boxes_need(const lrcs_prepared *prepared);

/* Makes the boxes of runs. Given cast[facet]: not 0 if it can hide something. Status: LRCS_OK;
   LRCS_E_MEMORY. They stay in the work area. */
int lrcsi_boxes_make(const lrcsi_view *view, const signed char *cast, lrcs_work *work,
                     lrcsi_boxes *boxes);

/* Makes those of a run's facets, if there are any and they are not made yet. */
void lrcsi_boxes_open(const lrcsi_boxes *boxes, uint32_t run);

#endif
