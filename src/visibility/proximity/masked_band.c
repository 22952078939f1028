/* SPDX-License-Identifier: MIT */
/* What other parts hide of curved shapes in truth, where their facets are hidden: whole regions,
   and groups of facets that meet the same bands (visibility/proximity/proximity_band.c, 4). Areas
   are not computed here, and bands are not changed. */
#include "visibility/proximity/masked_band.h"

#include <string.h>

#include "base/work.h"

/* A candidate for a query: at most this fraction of the facet may be visible. */
#define CANDIDATE_FRACTION 0x1p-20

/* Other parts hide a region entirely or not at all: entirely if at most half of one of its front
   facets is visible. Regions are marked anew, since other areas may tell less. */
static void find_hidden_regions(lrcsi_masked_band *band, const lrcsi_visible_area *visible)
{
    const lrcsi_proximity_band *whole = band->whole;
    const lrcsi_view *view = whole->classification->view;
    const lrcs_prepared *p = view->prepared;
    memset(band->region_hidden, 0, p->scene->facet_count);
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        if (view->facing[f] > 0 && p->proximity.reach[p->scene->facet_part[f]] > 0 &&
            whole->mismatch[f] == 0 && visible[f].high <= 0.5 * lrcsi_view_projected(view, f)) {
            band->region_hidden[whole->region[f]] = 1;
        }
    }
}

/* Marks facets that are hidden and meet bands, but not those of all parts, and that are not masked
   yet. Returns their number. */
static uint32_t mark_candidates(const lrcsi_masked_band *band, const lrcsi_visible_area *visible,
                                unsigned char *candidate)
{
    const lrcsi_view *view = band->whole->classification->view;
    uint32_t count = 0;
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        candidate[f] = lrcsi_masked_mismatch(band, f) > 0 &&
                       band->whole->parts[f] != LRCSI_PART_SET_ALL && lrcsi_view_casts(view, f) &&
                       visible[f].high <= CANDIDATE_FRACTION * lrcsi_view_projected(view, f);
        count += candidate[f];
    }
    return count;
}

/* A part whose bands a group does not meet hides all of the group or nothing of it. The group's own
   part is left out of the query: it hides no front, and the bands at its rims decide about its
   inside. The query is made at the first facet of a group, which names it and is reached before the
   others. */
static void find_hidden_groups(lrcsi_masked_band *band, const unsigned char *candidate,
                               const uint32_t *group, const lrcsi_grid *facets, lrcsi_meter *meter)
{
    const lrcs_scene *scene = band->whole->classification->view->prepared->scene;
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        lrcsi_part_set others = band->whole->parts[f] | lrcsi_part_set_of(scene->facet_part[f]);
        if (candidate[f]) {
            band->facet_hidden[f] =
                group[f] == f
                    ? (unsigned char)lrcsi_query_hidden_by_others(facets, f, others, meter)
                    : band->facet_hidden[group[f]];
        }
    }
}

size_t lrcsi_masked_band_need(const lrcs_prepared *p)
{
    size_t facets = p->scene->facet_count;
    size_t need =
        lrcsi_work_add(lrcsi_work_blocks(3, facets, 1), lrcsi_work_bytes(facets, sizeof(uint32_t)));
    return p->proximity.reach ? need : 0;
}

int lrcsi_masked_band_make(const lrcsi_proximity_band *whole, lrcs_work *work,
                           lrcsi_masked_band *band)
{
    const uint32_t facets = whole->classification->view->prepared->scene->facet_count;
    const size_t mark = work->used;
    lrcsi_masked_band m = {.whole = whole};
    m.region_hidden = lrcsi_work_take_zero(work, facets, 1);
    m.facet_hidden = lrcsi_work_take_zero(work, facets, 1);
    if (!m.region_hidden || !m.facet_hidden) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    *band = m;
    return LRCS_OK;
}

void lrcsi_masked_band_find(lrcsi_masked_band *band, const lrcsi_visible_area *visible,
                            lrcsi_meter *meter, lrcs_work *work)
{
    const lrcsi_classification *c = band->whole->classification;
    size_t mark = work->used;
    uint32_t count = c->view->prepared->scene->facet_count;
    unsigned char *candidate = lrcsi_work_take(work, count, 1);
    uint32_t *group = lrcsi_work_take(work, count, sizeof *group);
    if (candidate && group && c->facets && mark_candidates(band, visible, candidate) > 0) {
        lrcsi_proximity_band_join(band->whole, candidate, 1, group);
        find_hidden_groups(band, candidate, group, c->facets, meter);
    }
    work->used = mark;
    find_hidden_regions(band, visible);
}
