/* SPDX-License-Identifier: MIT */
/* A model of the time that methods take: the sum of several counts, each multiplied by the time of
   one item. These times were measured on one machine (make bench; 3 GHz); only their ratios matter.
   All constants are heuristics: no bound depends on the model. */
#include "integrate/plan/cost.h"

#include <math.h>

#include "base/constant.h"
#include "base/elementary.h"
#include "base/length.h"
#include "base/range.h"

/* Counts are made over all facets if there are no more than this, else over about as many, chosen
   at random. */
#define COST_SAMPLE 4096u

/* Times of drawing, ns: for each facet, for each pixel on the border of a facet, for each pixel,
   and for each pixel that a facet covers. Times of clipping: for each facet, for each facet that
   casts shadows (to classify and sum it), for each undecided facet, and for each crossing of two
   borders. */
#define DRAW_FACET     250.0
#define DRAW_BORDER    40.0
#define DRAW_PIXEL     2.5
#define DRAW_COVERED   3.0
#define CLIP_FACET     15.0
#define CLIP_CASTING   120.0
#define CLIP_UNDECIDED 6500.0
#define CLIP_CROSSING  900.0
/* The shortest time of a step of clipping, ns. */
#define CLIP_STEP 25.0

/* The mean number of facets that are undecided because of an event edge, and because of a facet
   with a contact (none if the other facet is behind it). */
#define UNDECIDED_PER_EVENT   1.3
#define UNDECIDED_PER_CONTACT 0.7

/* The size of the coarsest raster. */
#define RASTER_MIN 256u
/* Sizes of rasters are multiples of this. */
#define SIZE_STEP 64u
/* A finer raster, which is more likely to be accepted, may take longer by this fraction. */
#define RASTER_EXTRA 0.15
/* The first raster takes at most this many times as long as the coarsest: its estimated error shows
   how fine the next one must be. */
#define FIRST_FACTOR 4.0
/* The ratio of the error estimate of visibility/raster/preview.c to the random error of this model.
   */
#define ESTIMATE_SAFETY 4.0

/* Adds the sides of a facet that are event edges, each counted `weight` times. Where back sides
   cast shadows too, a contour edge is a side of two casting facets, so it counts half for each.
   Irregular edges count as event edges. */
static void count_events(const lrcsi_view *view, uint32_t facet, double weight, lrcsi_cost *cost)
{
    const lrcs_prepared *p = view->prepared;
    const uint32_t *neighbour = p->neighbours.facet[facet].corner;
    const uint32_t *corner = p->scene->facet[facet].corner;
    for (int k = 0; k < 3; k++) {
        double events = 0;
        if (neighbour[k] == p->scene->facet_count || !lrcsi_view_casts(view, neighbour[k])) {
            events = weight;
        } else if (neighbour[k] == facet || view->facing[neighbour[k]] != view->facing[facet]) {
            events = 0.5 * weight;
        }
        if (events > 0) {
            const double *a = view->point[corner[k]].x;
            const double *b = view->point[corner[k < 2 ? k + 1 : 0]].x;
            cost->events += events;
            cost->borders += events * lrcsi_length_flat(b[0] - a[0], b[1] - a[1]);
        }
    }
}

/* From each group of `stride` consecutive facets one is chosen at random: a fixed choice could miss
   parts of the regular patterns that meshes have. */
lrcsi_cost lrcsi_cost_count(const lrcsi_view *view)
{
    const lrcs_prepared *p = view->prepared;
    uint32_t count = p->scene->facet_count;
    uint32_t stride = count / COST_SAMPLE + 1;
    lrcsi_cost cost = {.facets = count};
    uint32_t random = 1;
    for (uint32_t first = 0; first < count; first += stride) {
        random = random * 1664525u + 1013904223u;
        uint32_t left = count - first < stride ? count - first : stride;
        uint32_t f = first + (random >> 8) % left;
        if (lrcsi_view_casts(view, f)) {
            cost.casting += left;
            cost.contacts += lrcsi_intersection_of(&p->intersections, f) != 0 ? left : 0;
            count_events(view, f, left, &cost);
            const uint32_t *corner = p->scene->facet[f].corner;
            const double *a = view->point[corner[0]].x;
            const double *b = view->point[corner[1]].x;
            const double *c = view->point[corner[2]].x;
            double twice = fabs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
            cost.overdraw += left * twice; /* twice the area, until the end */
        }
        if (count - first <= stride) {
            break;
        }
    }
    if (view->side > 0) {
        cost.overdraw /= 2 * view->side * view->side;
        cost.borders /= view->side;
    }
    return cost;
}

/* The length of a facet's border is about the square root of its area. For facets of equal size the
   sum of these lengths is the square root of their number times the sum of their areas. */
double lrcsi_cost_draw(const lrcsi_cost *cost, uint32_t size)
{
    double outlines = sqrt(cost->casting * cost->overdraw);
    double pixels = (double)size * size;
    return DRAW_FACET * cost->casting + DRAW_BORDER * outlines * size +
           (DRAW_PIXEL + DRAW_COVERED * cost->overdraw) * pixels;
}

double lrcsi_cost_undecided(const lrcsi_cost *cost)
{
    return lrcsi_min(cost->casting,
                     UNDECIDED_PER_EVENT * cost->events + UNDECIDED_PER_CONTACT * cost->contacts);
}

/* The fraction of the window that facets cover. If they lie in it at random, and the sum of their
   areas is D windows, it is 1 - exp(-D). lrcsi_exp gives the same bits, and so the same choices, on
   every machine. */
static double covered_fraction(const lrcsi_cost *cost)
{
    double d = cost->overdraw;
    return d < 1e-4 ? d : 1 - lrcsi_exp(-lrcsi_min(d, 100));
}

/* The mean number of facets over a covered point. Where so many lie one behind the other, about one
   in that number of their event edges is visible. */
static double mean_overdraw(const lrcsi_cost *cost)
{
    return cost->overdraw > 0 ? cost->overdraw / covered_fraction(cost) : 1;
}

/* Random segments of total length L in a square of side 1 cross in L^2 / pi points (Crofton). */
double lrcsi_cost_clip(const lrcsi_cost *cost, double undecided)
{
    double crossings = cost->borders * cost->borders / LRCS_PI / mean_overdraw(cost);
    return CLIP_FACET * cost->facets + CLIP_CASTING * cost->casting + CLIP_UNDECIDED * undecided +
           CLIP_CROSSING * crossings;
}

uint64_t lrcsi_cost_steps(double ns)
{
    return (uint64_t)lrcsi_min(ns / CLIP_STEP, 0x1p62);
}

/* Visible borders of length L, in sides of the window, pass through L N pixels of area 1 / N^2.
   Each of these pixels has a random error of half its area, and together they have one of
   sqrt(L N) / (2 N^2), which is compared with the covered area. The model does not apply if borders
   would pass through more pixels than there are; then the coarsest raster is chosen, and its own
   error estimate decides. */
uint32_t lrcsi_cost_size(const lrcsi_cost *cost, double tolerance, uint32_t largest)
{
    double borders = cost->borders / mean_overdraw(cost);
    double error = 0.5 * ESTIMATE_SAFETY * sqrt(borders) / covered_fraction(cost) / tolerance;
    uint32_t n = RASTER_MIN;
    while (n + SIZE_STEP <= largest && (double)n * n * n < error * error) {
        n += SIZE_STEP;
    }
    n = borders > n && n < largest ? RASTER_MIN : n;
    if (n == largest) {
        return largest;
    }
    double allowed = (1 + RASTER_EXTRA) * lrcsi_cost_draw(cost, n);
    while (n + SIZE_STEP <= largest && lrcsi_cost_draw(cost, n + SIZE_STEP) <= allowed) {
        n += SIZE_STEP;
    }
    return n;
}

uint32_t lrcsi_cost_first(const lrcsi_cost *cost, uint32_t size)
{
    double allowed = FIRST_FACTOR * lrcsi_cost_draw(cost, RASTER_MIN);
    while (size >= RASTER_MIN + SIZE_STEP && lrcsi_cost_draw(cost, size) > allowed) {
        size -= SIZE_STEP;
    }
    return size;
}
