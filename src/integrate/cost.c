/* SPDX-License-Identifier: MIT */
/* A model of what methods cost: a sum of what is counted, each item at a price. Prices are those of
   one machine (make bench; 3 GHz); only their ratios matter. It decides nothing that is proved. */
#include "integrate/cost.h"

#include <math.h>

#include "base/constant.h"
#include "base/elementary.h"
#include "base/length.h"
#include "base/range.h"
#include "visibility/grid.h"

/* Facets that are looked at to count: all of so many, else about as many, spread at random. */
#define COST_SAMPLE 4096u

/* Prices in ns. Drawing: of a facet, of a pixel on the rim of one, of a pixel, of one covered once.
   Clipping: of a facet, of one that casts (it is classified and summed), of an undecided one, of a
   place where two borders cross. */
#define DRAW_FACET     250.0
#define DRAW_RIM       40.0
#define DRAW_PIXEL     2.5
#define DRAW_COVERED   3.0
#define CLIP_FACET     15.0
#define CLIP_CASTING   120.0
#define CLIP_UNDECIDED 6500.0
#define CLIP_CROSSING  900.0
/* A step of clipping, at least. */
#define CLIP_STEP 25.0

/* An event edge leaves so many facets undecided, and a facet with a contact is undecided unless the
   other one is behind it. */
#define EVENT_CROSSES 1.3
#define TOUCH_HIDES   0.7

/* The coarsest raster; and the part of what one costs that a finer one may cost more, for safety.
 */
#define RASTER_LEAST  256u
#define RASTER_MARGIN 0.15
/* No first raster costs more than so many of the coarsest, which tells of finer ones. */
#define FIRST_TIMES 4.0
/* What an estimate is above the error that borders cause by chance: it errs on the safe side. */
#define ESTIMATE_SAFETY 4.0

/* Twice the projected area of a facet, from view coordinates. */
static double area_twice(const lrcsi_view *view, const uint32_t *corner)
{
    const double *a = view->point[corner[0]].x;
    const double *b = view->point[corner[1]].x;
    const double *c = view->point[corner[2]].x;
    return fabs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

/* Adds the sides of a facet that are event edges. Where back sides cast too, a contour is a side of
   two facets; irregular edges count as events. */
static void count_events(const lrcsi_view *view, uint32_t facet, double times, lrcsi_cost *cost)
{
    const lrcs_prepared *p = view->prepared;
    const uint32_t *across = p->across.facet[facet].corner;
    const uint32_t *corner = p->scene->facet[facet].corner;
    for (int k = 0; k < 3; k++) {
        double events = 0;
        if (across[k] == p->scene->facet_count || !lrcsi_grid_casts(view, across[k])) {
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

/* Of so many facets that follow each other one is looked at, by chance: meshes repeat themselves.
 */
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
        if (lrcsi_grid_casts(view, f)) {
            cost.casting += left;
            cost.contacts += lrcsi_intersection_of(&p->intersections, f) != 0 ? left : 0;
            count_events(view, f, left, &cost);
            cost.overdraw += left * area_twice(view, p->scene->facet[f].corner);
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

/* The rims of facets are about as long as the roots of their areas: together, over the window's
   side, the root of their number and of the area that they cover in it. */
double lrcsi_cost_draw(const lrcsi_cost *cost, uint32_t size)
{
    double rims = sqrt(cost->casting * cost->overdraw);
    double pixels = (double)size * size;
    return DRAW_FACET * cost->casting + DRAW_RIM * rims * size +
           (DRAW_PIXEL + DRAW_COVERED * cost->overdraw) * pixels;
}

double lrcsi_cost_undecided(const lrcsi_cost *cost)
{
    return lrcsi_least(cost->casting, EVENT_CROSSES * cost->events + TOUCH_HIDES * cost->contacts);
}

/* Of facets thrown at random, whose areas are D in all, this part of the window is covered,
   1 - exp(-D): by functions that are the same everywhere, so that choices are; */
static double covered(const lrcsi_cost *cost)
{
    double d = cost->overdraw;
    return d < 1e-4 ? d : 1 - lrcsi_exp(-lrcsi_least(d, 100));
}

/* by so many on average: one of so many borders is seen. */
static double layers(const lrcsi_cost *cost)
{
    return cost->overdraw > 0 ? cost->overdraw / covered(cost) : 1;
}

/* Segments thrown at random, of length L together, cross in L^2 / pi places of a square of side 1
   (Crofton). */
double lrcsi_cost_clip(const lrcsi_cost *cost, double undecided)
{
    double crossings = cost->borders * cost->borders / LRCSI_PI / layers(cost);
    return CLIP_FACET * cost->facets + CLIP_CASTING * cost->casting + CLIP_UNDECIDED * undecided +
           CLIP_CROSSING * crossings;
}

uint64_t lrcsi_cost_steps(double ns)
{
    return (uint64_t)lrcsi_least(ns / CLIP_STEP, 0x1p62);
}

/* Borders of length L that are seen, in sides of the window, pass L N pixels of area 1 / N^2, each
   of which errs by half of itself and by chance: sqrt(L N) / 2 N^2 in all, of an area A that is
   seen. Where they pass more pixels than there are this tells nothing: a coarse raster will. */
uint32_t lrcsi_cost_size(const lrcsi_cost *cost, double tolerance, uint32_t most)
{
    double borders = cost->borders / layers(cost);
    double error = 0.5 * ESTIMATE_SAFETY * sqrt(borders) / covered(cost) / tolerance;
    uint32_t n = RASTER_LEAST;
    while (n + 64 <= most && (double)n * n * n < error * error) {
        n += 64;
    }
    n = borders > n && n < most ? RASTER_LEAST : n;
    if (n == most) {
        return most;
    }
    double dear = (1 + RASTER_MARGIN) * lrcsi_cost_draw(cost, n);
    while (n + 64 <= most && lrcsi_cost_draw(cost, n + 64) <= dear) {
        n += 64;
    }
    return n;
}

uint32_t lrcsi_cost_first(const lrcsi_cost *cost, uint32_t size)
{
    double most = FIRST_TIMES * lrcsi_cost_draw(cost, RASTER_LEAST);
    while (size >= RASTER_LEAST + 64 && lrcsi_cost_draw(cost, size) > most) {
        size -= 64;
    }
    return size;
}
