/* SPDX-License-Identifier: MIT */
/* Cuts: what may divide an undecided facet (visibility/uniform/classify.h) into parts of different
   visibility. They are the event edges that cross it and the contacts with its interior, as
   segments in its frame. A part of the facet that no cut comes near is entirely visible or entirely
   hidden. */
#ifndef REF_CUT_H
#define REF_CUT_H

#include "visibility/cells/contact.h"
#include "visibility/cells/target.h"
#include "visibility/reference/clip.h"
#include "visibility/uniform/classify.h"

/* The number of surface components that a cut records; a cut with more counts as one of all
   components. */
#define REF_CUT_COMPONENTS 2

typedef struct ref_cut {
    lrcsi_clip_line line; /* its direction is never 0 */
    double low[2], high[2];
    double width; /* bound of the segment's position error, and of the distance from its line within
                     which the computed side of a point may be wrong */
    uint32_t component[REF_CUT_COMPONENTS]; /* the components that end at the cut, or pass through
                                               the facet there */
    uint32_t components;                    /* their number; above REF_CUT_COMPONENTS: all */
    uint32_t other;                         /* the facet of a contact, or LRCS_NONE */
    int kind;                               /* of the contact, a lrcsi_contact_kind */
} ref_cut;

/* The cuts of one facet. */
typedef struct ref_cuts {
    const lrcsi_target *target;
    ref_cut *cut;
    uint32_t *list; /* indices of cuts, in an order that changes */
    uint32_t count;
} ref_cuts;

/* Bytes at most for the cuts of one facet. */
size_t ref_cuts_need(const lrcs_prepared *prepared);

/* Finds the cuts of an undecided facet; not all of them if the view's meter is spent. They stay in
   the work area. Status: LRCS_OK; LRCS_E_MEMORY. */
int ref_cuts_make(lrcsi_classification *classification, const lrcsi_target *target, lrcs_work *work,
                  lrcsi_crossings *crossings, ref_cuts *cuts);

/* Moves those of list[0 .. count) that may come near the shape to the front of the list. Returns
   their number. */
uint32_t ref_cuts_keep(ref_cuts *cuts, const lrcsi_clip_polygon *shape, uint32_t count);

/* Does a component end at a cut, or can it end there? */
int ref_cut_ends(const ref_cut *cut, uint32_t component);

/* The number of cuts in list[0 .. count) at which a component ends, or can end. */
uint32_t ref_cuts_of(const ref_cuts *cuts, uint32_t count, uint32_t component);

#endif
