/* SPDX-License-Identifier: MIT */
/* Boxes in the view of the facets that can hide something. One box for each meshlet
   (scene/meshlets.h) is made at first; the boxes of its facets only when they are needed, since the
   meshlet's box usually suffices. They are stored in the order in which meshlets are opened, so
   that memory is written only for those. */
#ifndef LRCSI_BOXES_H
#define LRCSI_BOXES_H

#include "view/box.h"

enum lrcsi_boxes_state {
    LRCSI_BOXES_NONE,    /* no facet of the meshlet can hide anything */
    LRCSI_BOXES_MESHLET, /* the meshlet's box is made */
    LRCSI_BOXES_FACETS   /* so are those of its facets that can hide something */
};

typedef struct lrcsi_boxes {
    const lrcsi_view *view;
    lrcsi_view_box *meshlet;
    unsigned char *state; /* meshlet: a lrcsi_boxes_state */
    uint32_t *start; /* meshlet, if opened: the index in facet[] of the box of its first facet */
    lrcsi_view_box *facet;
    uint32_t facet_count; /* boxes in facet[]: those of all facets of opened meshlets */
} lrcsi_boxes;

/* The box of a facet that can hide something, whose meshlet is opened. */
static inline const lrcsi_view_box *lrcsi_boxes_facet(const lrcsi_boxes *boxes, uint32_t facet)
{
    return &boxes->facet[boxes->start[facet / LRCSI_MESHLET_FACETS] + facet % LRCSI_MESHLET_FACETS];
}

/* Bytes at most. */
size_t lrcsi_boxes_need(const lrcs_prepared *prepared);

/* Makes the boxes of meshlets. Status: LRCS_OK; LRCS_E_MEMORY. They stay in the work area. */
int lrcsi_boxes_make(const lrcsi_view *view, lrcs_work *work, lrcsi_boxes *boxes);

/* Bounds of the view coordinates of all facets of a meshlet. */
void lrcsi_boxes_meshlet_bounds(const lrcsi_view *view, const lrcsi_meshlet *meshlet, double low[3],
                                double high[3]);

/* Makes the boxes of a meshlet's facets, unless they exist or none can hide anything. */
void lrcsi_boxes_open(lrcsi_boxes *boxes, uint32_t meshlet);

#endif
