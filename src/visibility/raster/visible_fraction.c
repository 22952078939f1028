/* SPDX-License-Identifier: MIT */
/* The visible area of an undecided facet, from its samples. The bounds of the area are given, and
   the error is estimated elsewhere (visibility/raster/sampling_error.h).

   With many samples, the visible fraction is the fraction of its samples that the facet owns. The
   facet's own sides, which cause errors in both counts, then cancel.

   With few samples, this would be biased: in a row of facets that are thinner than a pixel or two,
   and that one edge crosses in the same way, all fractions have errors of the same sign. The
   samples of such a facet are pooled with those of its neighbours. Its visible area is that of the
   samples that it owns, plus the visible fraction of the pooled samples times the rest of its area.
   If the bounds of the facet reduce this area, the difference goes to other facets of its
   component, so that the facets together have the area of their samples.

   Small facets need no pooling: their error is smaller than a pixel. The results do not depend on
   the order of facets. */
#include "visibility/raster/visible_fraction.h"

#include <math.h>
#include <string.h>

#include "base/fnv.h"
#include "base/range.h"
#include "base/work.h"
#include "visibility/base/clip.h"
#include "visibility/index/marks.h"
#include "visibility/uniform/query.h"

/* Fewer samples than this are few; for a long facet, fewer than four for each pixel of its length.
   Heuristic, as the next: they decide about estimates within the bounds. */
#define FEW 16.0

/* A facet whose longest side is shorter, in pixels, is small. */
#define SMALL_SIDE 4.0

size_t lrcsi_visible_fraction_need(const lrcs_prepared *prepared)
{
    return lrcsi_work_bytes(prepared->scene->facet_count, sizeof(lrcsi_component_sum));
}

int lrcsi_visible_fraction_make(const lrcsi_decisions *decisions, const lrcsi_raster *raster,
                                lrcs_work *work, lrcsi_sample_pool *pool)
{
    const lrcsi_classification *classification = decisions->classification;
    uint32_t facets = raster->view->prepared->scene->facet_count;
    *pool = (lrcsi_sample_pool){decisions, raster, NULL};
    pool->sum = lrcsi_work_take(work, facets, sizeof *pool->sum);
    if (!pool->sum) {
        return LRCS_E_MEMORY;
    }
    const unsigned char *undecided = classification->undecided; /* they are few */
    for (uint32_t f = 0; (f = lrcsi_marks_next(undecided, f, facets, 1)) < facets; f++) {
        pool->sum[classification->component[f]] = (lrcsi_component_sum){0, 0, 0, 0, 0, 0};
    }
    return LRCS_OK;
}

/* Adds the samples of a facet's neighbours in its component; if a query has decided the visibility
   of a neighbour, its area in pixels instead. Returns the number of neighbours. */
static uint32_t samples_add_neighbours(const lrcsi_sample_pool *pool, uint32_t facet, double *owned,
                                       double *covered)
{
    const lrcsi_raster *raster = pool->raster;
    const lrcsi_topology *topology = &raster->view->prepared->topology;
    const uint32_t *component = pool->decisions->classification->component;
    uint32_t count = 0;
    for (int k = 0; k < 3; k++) {
        const lrcsi_edge *edge = &topology->edge[topology->facet_edge[facet].corner[k]];
        for (uint32_t i = 0; i < edge->uses; i++) {
            uint32_t other = topology->use[edge->first_use + i].facet;
            int answer = pool->decisions->answer[other];
            if (other == facet || component[other] != component[facet]) {
                continue;
            }
            count++;
            if (answer == LRCSI_QUERY_NO_ANSWER) {
                *owned += raster->owned[other];
                *covered += raster->covered[other];
            } else {
                double area = lrcsi_view_projected(raster->view, other);
                double pixels = area / (raster->pixel * raster->pixel);
                *owned += answer == LRCSI_QUERY_VISIBLE ? pixels : 0;
                *covered += pixels;
            }
        }
    }
    return count;
}

/* The longest side of a facet, in pixels. */
static double longest_in_pixels(const lrcsi_raster *raster, uint32_t facet)
{
    const uint32_t *corner = raster->view->prepared->scene->facet[facet].corner;
    double p[3][2];
    double square;
    for (int k = 0; k < 3; k++) {
        lrcsi_raster_point(raster, corner[k], p[k]);
    }
    (void)lrcsi_clip_longest_side((const double(*)[2])p, &square);
    return sqrt(square);
}

/* Finds the samples that determine the visible fraction of a facet: *owned of *covered. Returns 1
   if they are pooled with those of its neighbours, 0 if they are its own. */
static int pooled_samples(const lrcsi_sample_pool *pool, uint32_t facet, double longest,
                          double *owned, double *covered)
{
    *owned = pool->raster->owned[facet];
    *covered = pool->raster->covered[facet];
    if (longest < SMALL_SIDE || *covered >= lrcsi_max(FEW, 4 * longest)) {
        return 0;
    }
    double all_owned = *owned;
    double all_covered = *covered;
    if (samples_add_neighbours(pool, facet, &all_owned, &all_covered) < 2) {
        return 0; /* two facets are too few */
    }
    *owned = all_owned;
    *covered = all_covered;
    return 1;
}

/* A pseudo-random point of the facet, determined by the coordinates of its first corner. */
static void random_point(const lrcsi_raster *raster, uint32_t facet, double point[3])
{
    const lrcs_prepared *p = raster->view->prepared;
    double at[2];
    uint64_t bits[2];
    lrcsi_raster_point(raster, p->scene->facet[facet].corner[0], at);
    memcpy(bits, at, sizeof bits);
    uint64_t hash = lrcsi_fnv_bits(lrcsi_fnv_bits(LRCSI_FNV_START, bits[0], 8), bits[1], 8);
    double along = (double)(hash >> 32) * 0x1p-32;
    double up = (double)(hash & 0xffffffff) * 0x1p-32;
    int beyond = along + up > 1;
    for (int k = 0; k < 3; k++) {
        double corner = lrcsi_prepared_corner(p, facet, 0)[k];
        point[k] = corner +
                   (beyond ? 1 - along : along) * (lrcsi_prepared_corner(p, facet, 1)[k] - corner) +
                   (beyond ? 1 - up : up) * (lrcsi_prepared_corner(p, facet, 2)[k] - corner);
    }
}

/* The visible fraction of a facet without samples: 1 or 0, as one of its points is visible or
   hidden. The point is not the centroid: in a regular pattern, such as the cells of a panel, the
   errors of many facets would then be equal. */
static double fraction_of_point(const lrcsi_sample_pool *pool, uint32_t facet)
{
    double point[3];
    random_point(pool->raster, facet, point);
    int answer = lrcsi_query_point(&pool->decisions->facets, facet, point, NULL);
    if (answer == LRCSI_QUERY_NO_ANSWER) {
        answer = lrcsi_query_facet(&pool->decisions->facets, facet, NULL);
    }
    return answer == LRCSI_QUERY_VISIBLE ? 1 : answer == LRCSI_QUERY_HIDDEN ? 0 : 0.5;
}

lrcsi_visible_fraction lrcsi_visible_fraction_facet(const lrcsi_sample_pool *pool, uint32_t facet)
{
    double owned;
    double covered;
    lrcsi_visible_fraction found;
    found.longest = longest_in_pixels(pool->raster, facet);
    found.pooled = pooled_samples(pool, facet, found.longest, &owned, &covered);
    found.fraction = covered > 0 ? owned / covered : fraction_of_point(pool, facet);
    return found;
}

void lrcsi_visible_fraction_apply(lrcsi_sample_pool *pool, uint32_t facet, double area,
                                  const lrcsi_visible_fraction *found, lrcsi_visible_area *visible)
{
    double pixel = pool->raster->pixel * pool->raster->pixel;
    double target = area * found->fraction;
    if (found->pooled) {
        target +=
            (pool->raster->owned[facet] - found->fraction * pool->raster->covered[facet]) * pixel;
    }
    visible->area = lrcsi_min(visible->high, lrcsi_max(visible->low, target));
    if (found->pooled) {
        lrcsi_component_sum *component =
            &pool->sum[pool->decisions->classification->component[facet]];
        component->owned += pool->raster->owned[facet];
        component->covered += pool->raster->covered[facet];
        component->area += area;
        component->applied += visible->area;
        component->low += visible->low;
        component->high += visible->high;
    }
}

/* The area of a facet after the difference between the samples of its component and the areas so
   far has been distributed, in proportion to the distance of each area from its bound. */
static double area_corrected(const lrcsi_component_sum *component, const lrcsi_visible_area *v)
{
    double missing = component->area * component->owned / component->covered - component->applied;
    double room =
        missing > 0 ? component->high - component->applied : component->applied - component->low;
    double part = fabs(missing) < room ? fabs(missing) / room : 1;
    return v->area + part * ((missing > 0 ? v->high : v->low) - v->area);
}

void lrcsi_visible_fraction_correct(const lrcsi_sample_pool *pool, lrcsi_visible_area *visible)
{
    const lrcsi_classification *classification = pool->decisions->classification;
    const unsigned char *undecided = classification->undecided;
    const uint32_t facets = classification->view->prepared->scene->facet_count;
    for (uint32_t f = 0; (f = lrcsi_marks_next(undecided, f, facets, 1)) < facets; f++) {
        const lrcsi_component_sum *component = &pool->sum[classification->component[f]];
        lrcsi_visible_area *v = &visible[f];
        double samples[2];
        if (component->covered > 0 && v->high > v->low &&
            pooled_samples(pool, f, longest_in_pixels(pool->raster, f), &samples[0], &samples[1])) {
            v->area = lrcsi_min(v->high, lrcsi_max(v->low, area_corrected(component, v)));
        }
    }
}
