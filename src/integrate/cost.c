/* SPDX-License-Identifier: MIT */
/* A model of the time that methods take: a sum of counts, each times the time of one item. Times
   were measured on one machine (make bench; 3 GHz); only their ratios matter. No bound depends on
   it. */
#include "integrate/cost.h"

#include <math.h>

#include "base/constant.h"
#include "base/elementary.h"
#include "base/length.h"
#include "base/range.h"

/* Counts are made over all facets if there are no more than this, else over about as many, chosen
   at random. */
#define COST_SAMPLE 4096u

/* Times in ns. Drawing: per facet, per pixel on the border of one, per pixel, per pixel and facet
   that covers it. Clipping: per facet, per facet that casts shadows (it is classified and summed),
   per undecided facet, per crossing of two borders. */
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

/* The mean number of facets that an event edge makes undecided, and that a facet with a contact
   does: none if the other facet is behind it. */
#define UNDECIDED_PER_EVENT   1.3
#define UNDECIDED_PER_CONTACT 0.7

/* The coarsest raster; and the fraction by which a finer one may take longer, to be more likely to
   be accepted. */
#define RASTER_MIN   256u
#define RASTER_EXTRA 0.15
/* The first raster takes at most this many times as long as the coarsest: its estimate shows how
   fine the next one must be. */
#define FIRST_TIMES 4.0
/* The ratio of the estimate of sampling_error.h, which is on the safe side, to the random error. */
#define ESTIMATE_SAFETY 4.0

/* Adds the sides of a facet that are event edges, `times` over. Where back sides cast shadows too,
   a contour edge is a side of two facets, and counts by half for each; irregular edges count as
   event edges. */
static void count_events(const lrcsi_view *view, uint32_t facet, double times, lrcsi_cost *cost)
{
    const lrcs_prepared *p = view->prepared;
    const uint32_t *across = p->neighbours.facet[facet].corner;
    const uint32_t *corner = p->scene->facet[facet].corner;
    for (int k = 0; k < 3; k++) {
        double events = 0;
        if (across[k] == p->scene->facet_count || !lrcsi_view_casts(view, across[k])) {
            events = times;
        } else if (across[k] == facet || view->facing[across[k]] != view->facing[facet]) {
            events = 0.5 * times;
        }
        if (events > 0) {
            const double *a = view->point[corner[k]].x;
            const double *b = view->point[corner[k < 2 ? k + 1 : 0]].x;
            cost->events += events;
            cost->borders += events * lrcsi_length_flat(b[0] - a[0], b[1] - a[1]);
        }
    }
}

/* One facet is chosen at random from each run of `stride` facets: meshes have regular patterns,
   which a fixed stride could miss. */
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
            cost.overdraw += left * twice; /* the area */
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

/* The length of a facet's border is about the square root of its area. The sum over all facets, in
   sides of the window, is the square root of their number times the area that they cover. */
double lrcsi_cost_draw(const lrcsi_cost *cost, uint32_t size)
{
    double borders = sqrt(cost->casting * cost->overdraw);
    double pixels = (double)size * size;
    return DRAW_FACET * cost->casting + DRAW_BORDER * borders * size +
           (DRAW_PIXEL + DRAW_COVERED * cost->overdraw) * pixels;
}

double lrcsi_cost_undecided(const lrcsi_cost *cost)
{
    return lrcsi_min(cost->casting,
                     UNDECIDED_PER_EVENT * cost->events + UNDECIDED_PER_CONTACT * cost->contacts);
}

/* The fraction of the window that is covered, if facets whose areas sum to D windows lie
   in it at random: 1 - exp(-D). The exponential of base/elementary.h makes choices the same on
   every machine. */
static double covered_fraction(const lrcsi_cost *cost)
{
    double d = cost->overdraw;
    return d < 1e-4 ? d : 1 - lrcsi_exp(-lrcsi_min(d, 100));
}

/* The mean number of facets that cover a point of that fraction: one border in this many is
   visible. */
static double mean_overdraw(const lrcsi_cost *cost)
{
    return cost->overdraw > 0 ? cost->overdraw / covered_fraction(cost) : 1;
}

/* Random segments of total length L in a square of side 1 cross at L^2 / pi points (Crofton). */
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
   Each of these has a random error of half its area: sqrt(L N) / (2 N^2) in all, of a visible area
   A. If borders would pass through more pixels than there are, this model does not apply, and a
   coarse raster is chosen, whose estimate does. */
uint32_t lrcsi_cost_size(const lrcsi_cost *cost, double tolerance, uint32_t largest)
{
    double borders = cost->borders / mean_overdraw(cost);
    double error = 0.5 * ESTIMATE_SAFETY * sqrt(borders) / covered_fraction(cost) / tolerance;
    uint32_t n = RASTER_MIN;
    while (n + 64 <= largest && (double)n * n * n < error * error) {
        n += 64;
    }
    n = borders > n && n < largest ? RASTER_MIN : n;
    if (n == largest) {
        return largest;
    }
    double allowed = (1 + RASTER_EXTRA) * lrcsi_cost_draw(cost, n);
    while (n + 64 <= largest && lrcsi_cost_draw(cost, n + 64) <= allowed) {
        n += 64;
    }
    return n;
}

uint32_t lrcsi_cost_first(const lrcsi_cost *cost, uint32_t size)
{
    double allowed = FIRST_TIMES * lrcsi_cost_draw(cost, RASTER_MIN);
    while (size >= RASTER_MIN + 64 && lrcsi_cost_draw(cost, size) > allowed) {
        size -= 64;
    }
    return size;
}
