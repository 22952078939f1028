/* SPDX-License-Identifier: MIT */
/* One exact sample: which surface component hides a point of an undecided facet, and whether the
   answer holds for the whole cell around the point. */
#ifndef REF_COVER_H
#define REF_COVER_H

#include "visibility/reference/cut.h"
#include "visibility/uniform/query.h"

enum ref_cover_answer {
    REF_COVER_NONE,   /* nothing hides the point */
    REF_COVER_ALL,    /* the component that hides it ends nowhere in the cell and hides all of it */
    REF_COVER_SOME,   /* it is hidden, but only by components that may end in the cell */
    REF_COVER_UNKNOWN /* undecided, or the view's meter is spent */
};

/* A candidate: a facet that may hide a part of the target. */
typedef struct ref_cover_facet {
    lrcsi_view_box box;
    uint32_t facet;
    uint32_t order; /* depth order relative to the target: a cover_order, or the index of a cut */
} ref_cover_facet;

/* The sides of a candidate in the target's frame, cached for later lines. */
typedef struct ref_cover_sides {
    uint32_t facet, search; /* the candidate, and the search that listed it */
    lrcsi_clip_line side[3];
    double clear[3]; /* error bound of lrcsi_clip_side for each side */
} ref_cover_sides;

/* The number of cached candidates; the entry of a facet is its index modulo this number. */
#define REF_COVER_KEPT 1024u

typedef struct ref_cover {
    lrcsi_classification *classification;
    lrcsi_grid facets;
    uint32_t *listed;  /* facet: the last search that met it */
    uint32_t searches; /* searches so far */
    ref_cover_facet *candidate;
    uint32_t count;
    ref_cover_sides *sides;
} ref_cover;

/* Bytes at most, including those of the grid. */
size_t ref_cover_need(const lrcs_prepared *prepared);

/* Allocates what all facets of a view share, except for the grid of facets, which the caller makes.
   It stays in the work area. Status: LRCS_OK; LRCS_E_MEMORY. */
int ref_cover_make(lrcsi_classification *classification, lrcs_work *work, ref_cover *cover);

/* Lists the candidates of a facet that casts. The list is incomplete if the meter is spent. */
void ref_cover_start(ref_cover *cover, const lrcsi_target *target);

/* The position of a sample in the target's frame. */
typedef struct ref_cover_place {
    double at[2];
    double clear; /* the sample may be taken at any point within this distance */
    int guess;    /* returned: 1 if the answer may be wrong, or is that of a point farther away */
} ref_cover_place;

/* Takes a sample in a cell that only the cuts list[0 .. count) can divide. Returns a
   ref_cover_answer. If it is SOME, *component is the component that ends at the fewest of these
   cuts, of those that hide the point. */
int ref_cover_sample(ref_cover *cover, const ref_cuts *cuts, uint32_t count, ref_cover_place *place,
                     uint32_t *component);

#endif
