/* SPDX-License-Identifier: MIT */
/* From samples to the area of an undecided facet. Many samples give it the share of them that it
   owns, so that its own sides, which miscount owned and covered samples alike, do not matter. Of
   few, in a row of facets thinner than a pixel or two that an edge cuts all alike, those shares
   would err one way. There a facet takes the samples that it owns, as they are, and only of the
   rest of its area the share of its samples and its neighbours' together; what its bounds cut off
   is passed on within its component, so that the row together shows what its samples show. Small
   facets need none of this: their shares, or a query somewhere in each, err less than pixels do.
   Nothing here depends on the order of facets. The bounds are not its business, nor how far
   the areas may be off. */
#include "visibility/visible_fraction.h"

#include <math.h>
#include <string.h>

#include "base/fnv.h"
#include "base/range.h"
#include "base/work.h"
#include "visibility/query.h"

/* Fewer samples than this are few, and of a long facet fewer than four for each pixel along it. */
#define FEW 16.0

/* A facet whose longest side is shorter, in pixels, is small. */
#define SMALL_SIDE 4.0

size_t lrcsi_visible_fraction_need(const lrcs_prepared *prepared)
{
    return lrcsi_work_bytes(prepared->scene->facet_count, sizeof(lrcsi_fraction_remainder));
}

int lrcsi_visible_fraction_make(const lrcsi_known *known, const lrcsi_raster *raster,
                                lrcs_work *work, lrcsi_sharing *sharing)
{
    const lrcsi_classification *classification = known->classification;
    uint32_t facets = raster->view->prepared->scene->facet_count;
    *sharing = (lrcsi_sharing){known, raster, NULL};
    sharing->rest = lrcsi_work_take(work, facets, sizeof *sharing->rest);
    if (!sharing->rest) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t f = 0; f < facets; f++) { /* only those that are asked for: they are few */
        if (classification->undecided[f]) {
            sharing->rest[classification->component[f]] =
                (lrcsi_fraction_remainder){0, 0, 0, 0, 0, 0};
        }
    }
    return LRCS_OK;
}

/* Adds the samples of one facet, or its area where it is known what it shows. */
static void share_add(const lrcsi_sharing *s, uint32_t facet, double *owned, double *covered)
{
    if (s->known->answer[facet] == LRCSI_QUERY_UNDECIDED) {
        *owned += s->raster->owned[facet];
        *covered += s->raster->covered[facet];
        return;
    }
    double area = lrcsi_view_projected(s->raster->view, facet);
    double pixels = area / (s->raster->pixel * s->raster->pixel);
    *owned += s->known->answer[facet] == LRCSI_QUERY_VISIBLE ? pixels : 0;
    *covered += pixels;
}

/* Adds what a facet's neighbours in its component show. Returns how many neighbours. */
static uint32_t share_neighbours(const lrcsi_sharing *s, uint32_t facet, double *owned,
                                 double *covered)
{
    const lrcsi_topology *topology = &s->raster->view->prepared->topology;
    const uint32_t *component = s->known->classification->component;
    uint32_t count = 0;
    for (int k = 0; k < 3; k++) {
        const lrcsi_edge *edge = &topology->edge[topology->facet_edge[facet].corner[k]];
        for (uint32_t i = 0; i < edge->uses; i++) {
            uint32_t other = topology->use[edge->first_use + i].facet;
            if (other != facet && component[other] == component[facet]) {
                share_add(s, other, owned, covered);
                count++;
            }
        }
    }
    return count;
}

/* The longest side of a facet, in pixels. */
static double share_longest(const lrcsi_raster *raster, uint32_t facet)
{
    lrcsi_edges e = lrcsi_raster_edges(raster, facet);
    double square = 0;
    for (int k = 0; k < 3; k++) {
        square = lrcsi_most(square, e.along[k] * e.along[k] + e.up[k] * e.up[k]);
    }
    return sqrt(square);
}

/* Does the facet share its samples? The samples that decide its share, its own or with its
   neighbours' together, go to *owned and *covered. */
static int share_row(const lrcsi_sharing *s, uint32_t facet, double longest, double *owned,
                     double *covered)
{
    *owned = s->raster->owned[facet];
    *covered = s->raster->covered[facet];
    if (longest < SMALL_SIDE || *covered >= lrcsi_most(FEW, 4 * longest)) {
        return 0;
    }
    double all_owned = *owned;
    double all_covered = *covered;
    if (share_neighbours(s, facet, &all_owned, &all_covered) < 2) {
        return 0; /* two facets are no row */
    }
    *owned = all_owned;
    *covered = all_covered;
    return 1;
}

/* A point of the facet, anywhere: where depends on its first corner, as if by chance. */
static void share_point(const lrcsi_raster *raster, uint32_t facet, double point[3])
{
    const lrcs_prepared *p = raster->view->prepared;
    double at[2];
    uint64_t bits[2];
    lrcsi_raster_point(raster, p->scene->facet[facet].corner[0], at);
    memcpy(bits, at, sizeof bits);
    uint64_t chance = lrcsi_fnv_bits(lrcsi_fnv_bits(LRCSI_FNV_START, bits[0], 8), bits[1], 8);
    double along = (double)(chance >> 32) * 0x1p-32;
    double up = (double)(chance & 0xffffffff) * 0x1p-32;
    int beyond = along + up > 1;
    for (int k = 0; k < 3; k++) {
        double corner = lrcsi_prepared_corner(p, facet, 0)[k];
        point[k] = corner +
                   (beyond ? 1 - along : along) * (lrcsi_prepared_corner(p, facet, 1)[k] - corner) +
                   (beyond ? 1 - up : up) * (lrcsi_prepared_corner(p, facet, 2)[k] - corner);
    }
}

/* What is visible of a facet that lies between samples, alone: all or nothing, as one point of it
   is. In the middle of each, many facets hidden alike, as cells of a panel are, would err alike. */
static double share_asked(const lrcsi_sharing *s, uint32_t facet)
{
    static const double share[] = {0, 1, 0.5}; /* by lrcsi_query_answer */
    double point[3];
    share_point(s->raster, facet, point);
    int answer = lrcsi_query_point(&s->known->facets, facet, point, NULL);
    return share[answer != LRCSI_QUERY_UNDECIDED
                     ? answer
                     : lrcsi_query_facet(&s->known->facets, facet, NULL)];
}

lrcsi_visible_fraction lrcsi_visible_fraction_facet(const lrcsi_sharing *s, uint32_t facet)
{
    double owned;
    double covered;
    lrcsi_visible_fraction share;
    share.longest = share_longest(s->raster, facet);
    share.row = share_row(s, facet, share.longest, &owned, &covered);
    share.share = covered > 0 ? owned / covered : share_asked(s, facet);
    return share;
}

void lrcsi_visible_fraction_keep(const lrcsi_sharing *s, uint32_t facet, double area,
                                 const lrcsi_visible_fraction *share, lrcsi_visible *visible)
{
    double pixel = s->raster->pixel * s->raster->pixel;
    double wanted = area * share->share;
    if (share->row) {
        wanted += (s->raster->owned[facet] - share->share * s->raster->covered[facet]) * pixel;
    }
    visible->area = lrcsi_least(visible->high, lrcsi_most(visible->low, wanted));
    if (share->row) {
        lrcsi_fraction_remainder *component = &s->rest[s->known->classification->component[facet]];
        component->owned += s->raster->owned[facet];
        component->covered += s->raster->covered[facet];
        component->area += area;
        component->kept += visible->area;
        component->low += visible->low;
        component->high += visible->high;
    }
}

/* A facet's area once its component shows what its samples show: what is missing or too much is
   taken up in proportion to the room that each has. */
static double share_settled(const lrcsi_fraction_remainder *component, const lrcsi_visible *v)
{
    double rest = component->area * component->owned / component->covered - component->kept;
    double room = rest > 0 ? component->high - component->kept : component->kept - component->low;
    double part = fabs(rest) < room ? fabs(rest) / room : 1;
    return v->area + part * ((rest > 0 ? v->high : v->low) - v->area);
}

void lrcsi_visible_fraction_settle(const lrcsi_sharing *s, lrcsi_visible *visible)
{
    const lrcsi_classification *classification = s->known->classification;
    for (uint32_t f = 0; f < classification->view->prepared->scene->facet_count; f++) {
        if (!classification->undecided[f]) {
            continue;
        }
        const lrcsi_fraction_remainder *component = &s->rest[classification->component[f]];
        lrcsi_visible *v = &visible[f];
        double samples[2];
        if (component->covered > 0 && v->high > v->low &&
            share_row(s, f, share_longest(s->raster, f), &samples[0], &samples[1])) {
            v->area = lrcsi_least(v->high, lrcsi_most(v->low, share_settled(component, v)));
        }
    }
}
