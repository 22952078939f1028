/* SPDX-License-Identifier: MIT */
/* Parts of a contested facet that nothing divides: where no event edge that crosses the facet, and
   no facet that touches its inside, comes near, all is visible or none, and one exact sample tells
   which. It saves cutting out, one by one, the many facets of a surface in front. */
#ifndef LRCSI_CALM_H
#define LRCSI_CALM_H

#include "visibility/clip.h"
#include "visibility/query.h"
#include "visibility/target.h"

/* Something that may divide the facet: a segment of the facet's frame, or what is in a box. */
typedef struct lrcsi_calm_edge {
    lrcsi_clip_line line; /* of no length: the box alone */
    double low[2], high[2];
} lrcsi_calm_edge;

typedef struct lrcsi_calm {
    const lrcsi_target *target; /* the facet at hand */
    lrcsi_calm_edge *edge;
    uint32_t edges, room;
    uint32_t *list; /* edges by cell, one cell's behind another's; the first cell's are all */
    double width;   /* by which places may be off */
} lrcsi_calm;

size_t lrcsi_calm_need(const lrcs_prepared *prepared);

/* Room for any facet; it stays in the work area. Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_calm_make(const lrcs_prepared *prepared, lrcs_work *work, lrcsi_calm *calm);

/* Lists what may divide a contested facet: their count, or LRCS_NONE where they are too many. */
uint32_t lrcsi_calm_start(lrcsi_calm *calm, lrcsi_contest *contest, const lrcsi_target *target);

/* Files those of list[first .. first + count) that may divide the shape behind them. Returns how
   many; LRCS_NONE where the list is full. */
uint32_t lrcsi_calm_keep(lrcsi_calm *calm, const lrcsi_clip_polygon *shape, uint32_t first,
                         uint32_t count);

/* What an undivided shape shows, a lrcsi_query_answer. */
int lrcsi_calm_answer(const lrcsi_calm *calm, const lrcsi_grid *facets,
                      const lrcsi_clip_polygon *shape);

#endif
