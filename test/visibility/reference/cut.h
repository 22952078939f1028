/* SPDX-License-Identifier: MIT */
/* What may divide an undecided facet (visibility/classify.h): the event edges that cross it and the
   contacts with its inside, as segments of its frame. Where none comes near, all is visible or
   none. */
#ifndef REF_CUT_H
#define REF_CUT_H

#include "visibility/classify.h"
#include "visibility/contact.h"
#include "visibility/reference/clip.h"
#include "visibility/target.h"

/* Surface components that a cut is told apart by; one with more counts as of all. */
#define REF_CUT_SHEETS 2

typedef struct ref_cut {
    lrcsi_clip_line line; /* its direction never 0 */
    double low[2], high[2];
    double width; /* by which the segment may be off, or told to be on a wrong side */
    uint32_t component[REF_CUT_SHEETS]; /* whose surface ends, or passes through the facet, there */
    uint32_t components;                /* how many there are, or more: all */
    uint32_t other;                     /* the facet of a contact, or LRCS_NONE */
    int kind;                           /* of the contact, a lrcsi_contact_kind */
} ref_cut;

/* Those of one facet. */
typedef struct ref_cuts {
    const lrcsi_target *target;
    ref_cut *cut;
    uint32_t *list; /* numbers of cuts, in an order that changes */
    uint32_t count;
} ref_cuts;

/* Bytes at most for those of one facet. */
size_t ref_cuts_need(const lrcs_prepared *prepared);

/* Finds those of an undecided facet, not all of them where the view's meter is spent. They stay in
   the work area. Status: LRCS_OK; LRCS_E_MEMORY. */
int ref_cuts_make(lrcsi_classification *classification, const lrcsi_target *target, lrcs_work *work,
                  lrcsi_crossings *crossings, ref_cuts *cuts);

/* Puts those of list[0 .. count) that may come near the shape first. Returns how many. */
uint32_t ref_cuts_keep(ref_cuts *cuts, const lrcsi_clip_polygon *shape, uint32_t count);

/* Does a component end at a cut, or may it? */
int ref_cut_ends(const ref_cut *cut, uint32_t component);

/* Of list[0 .. count), how many a component ends at, or may. */
uint32_t ref_cuts_of(const ref_cuts *cuts, uint32_t count, uint32_t component);

#endif
