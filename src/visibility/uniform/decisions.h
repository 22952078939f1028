/* SPDX-License-Identifier: MIT */
/* What exact queries decide about facets before samples are taken: which uniform facets are
   visible, which undecided facets are hidden, and which event edges cross the others. */
#ifndef LRCSI_DECISIONS_H
#define LRCSI_DECISIONS_H

#include "visibility/uniform/classify.h"

/* Items first .. first + count - 1 of lrcsi_decisions.crossing. */
typedef struct lrcsi_decisions_list {
    uint32_t first, count;
} lrcsi_decisions_list;

typedef struct lrcsi_decisions {
    lrcsi_classification *classification;
    lrcsi_grid facets;
    unsigned char *answer; /* facet: a lrcsi_query_answer; hidden if it casts no shadow; undecided
                              if samples have to decide */
    uint32_t listed;       /* facets below this have lists */
    /* Facet, if its answer is undecided: the event edges that cross it. */
    lrcsi_decisions_list *list;
    uint32_t *crossing;     /* the items of these lists: topology edges */
    lrcsi_crossings search; /* room to search for the crossings of a facet without a list */
} lrcsi_decisions;

/* Bytes at most. */
size_t lrcsi_decisions_need(const lrcs_prepared *prepared);

/* Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. The result stays in the work area. */
int lrcsi_decisions_make(lrcsi_classification *classification, lrcs_work *work,
                         lrcsi_decisions *decisions);

/* The event edges that cross an undecided facet: listed, or searched for in *search, which has room
   for them. */
lrcsi_crossings lrcsi_decisions_crossings(lrcsi_decisions *decisions, uint32_t facet,
                                          lrcsi_crossings *search);

#endif
