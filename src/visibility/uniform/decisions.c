/* SPDX-License-Identifier: MIT */
/* Queries of uniform facets, proofs that undecided facets are hidden, and the event edges that
   cross the rest, as far as there is room for lists of them. The visible areas of the rest are
   found in visibility/raster/visible.c. */
#include "visibility/uniform/decisions.h"

#include <string.h>

#include "base/work.h"
#include "visibility/index/marks.h"
#include "visibility/uniform/query.h"

/* Room for crossings: more than ordinary scenes have. The crossings of facets beyond it are
   searched for whenever they are needed. */
static size_t crossings_room(const lrcs_prepared *prepared)
{
    return 4 * (size_t)prepared->scene->facet_count;
}

size_t lrcsi_decisions_need(const lrcs_prepared *prepared)
{
    size_t facets = prepared->scene->facet_count;
    size_t need = lrcsi_work_bytes(facets, 1);
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_decisions_list)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(crossings_room(prepared), sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_crossings_need(prepared));
    return lrcsi_work_add(need, lrcsi_query_need(prepared));
}

/* Queries of uniform facets come first. For each of the others, one search for the event edges that
   cross it serves two purposes: to prove that it is hidden, and as a list for rasters. */
int lrcsi_decisions_make(lrcsi_classification *classification, lrcs_work *work,
                         lrcsi_decisions *decisions)
{
    size_t mark = work->used;
    const lrcs_prepared *p = classification->view->prepared;
    uint32_t count = p->scene->facet_count;
    lrcsi_decisions d = {.classification = classification};
    d.answer = lrcsi_work_take(work, count, 1);
    d.list = lrcsi_work_take(work, count, sizeof *d.list);
    d.crossing = lrcsi_work_take(work, crossings_room(p), sizeof *d.crossing);
    int status = d.answer && d.list && d.crossing
                     ? lrcsi_crossings_make(&classification->search, work, &d.search)
                     : LRCS_E_MEMORY;
    status = status == LRCS_OK
                 ? lrcsi_query_uniform(classification, NULL, work, &d.facets, d.answer)
                 : status;
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    const unsigned char *undecided = classification->undecided;
    uint32_t used = 0; /* of crossing[] */
    d.listed = count;
    for (uint32_t f = 0; (f = lrcsi_marks_next(undecided, f, count, 1)) < count; f++) {
        if (lrcsi_query_hidden_by_component(classification, &d.facets, f, NULL, &d.search)) {
            d.answer[f] = LRCSI_QUERY_HIDDEN;
            continue;
        }
        if (f > d.listed) {
            continue;
        }
        lrcsi_crossings_find(&classification->search, f, NULL, &d.search);
        if (d.search.count > crossings_room(p) - used) {
            d.listed = f;
        } else {
            memcpy(d.crossing + used, d.search.edge, d.search.count * sizeof *d.crossing);
            d.list[f] = (lrcsi_decisions_list){used, d.search.count};
            used += d.search.count;
        }
    }
    *decisions = d;
    return LRCS_OK;
}

lrcsi_crossings lrcsi_decisions_crossings(lrcsi_decisions *d, uint32_t facet,
                                          lrcsi_crossings *search)
{
    if (facet < d->listed) {
        return (lrcsi_crossings){facet, d->list[facet].count, d->crossing + d->list[facet].first};
    }
    lrcsi_crossings_find(&d->classification->search, facet, NULL, search);
    return *search;
}
