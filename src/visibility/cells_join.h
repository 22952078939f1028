/* SPDX-License-Identifier: MIT */
/* Who continues a facet across its sides (visibility/cells.c). */
#ifndef LRCSI_CELLS_JOIN_H
#define LRCSI_CELLS_JOIN_H

#include "view/view.h"

enum {
    LRCSI_CELLS_APART = 1, /* the facet goes on nowhere: it meets others in its plane */
    LRCSI_CELLS_VAGUE = 2, /* a contact of it is not known */
    LRCSI_CELLS_LINKED = 4 /* who continues it is known */
};

/* Whether a facet goes on nowhere: it meets others in its plane. */
int lrcsi_cells_apart(const lrcsi_view *view, uint32_t facet);

/* Who continues a facet across a side of its own numbering, events of the view being the only edges
   where nobody does (visibility/event.h); LRCS_NONE if nobody does. */
uint32_t lrcsi_cells_joined(const lrcsi_view *view, uint32_t facet, int k);

/* Who continues it for all that is done in cells, with the kinds of facets. */
uint32_t lrcsi_cells_next(const lrcsi_view *view, const unsigned char *kind, uint32_t facet, int k);

/* The facet's own number of the side that runs from corner k of its record. */
int lrcsi_cells_side_number(const lrcsi_view *view, uint32_t facet, int k);

#endif
