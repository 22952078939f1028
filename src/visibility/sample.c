/* SPDX-License-Identifier: MIT */
/* Exact decisions along one line of sight. It knows nothing of pixels or of which facets are
   candidates. */
#include "visibility/sample.h"

#include <math.h>

#include "base/dd.h"
#include "base/exact.h"

#define U 0x1p-53

/* The axis along which the direction is largest: the other two span the view plane with it. */
static int sample_axis(const double *d)
{
    int axis = fabs(d[1]) > fabs(d[0]) ? 1 : 0;
    return fabs(d[2]) > fabs(d[axis]) ? 2 : axis;
}

/* The side of edge p -> q on which the line stands: 1 left, -1 right, never 0 unless the edge is
   parallel to the direction. On the edge itself the first axis, then the second, decides: the
   sign of det(q - p, e, d), taken exactly with e as p moved by 2 along that axis (coordinates are
   below 1, so the move is a positive multiple of the axis, exactly). */
static int sample_edge_side(const double *p, const double *q, const double *point, const double *d)
{
    int side = lrcsi_exact_turn(p, q, point, d);
    int axis = sample_axis(d);
    for (int k = 1; k <= 2 && side == 0; k++) {
        double moved[3] = {p[0], p[1], p[2]};
        moved[(axis + k) % 3] += 2;
        side = lrcsi_exact_turn(p, q, moved, d);
    }
    return side;
}

int lrcsi_sample_covers(const lrcsi_view *view, uint32_t facet, const double point[3])
{
    for (int k = 0; k < 3; k++) {
        const double *p = lrcsi_prepared_corner(view->prepared, facet, k);
        const double *q = lrcsi_prepared_corner(view->prepared, facet, (k + 1) % 3);
        if (sample_edge_side(p, q, point, view->direction) != view->facing[facet]) {
            return 0;
        }
    }
    return 1;
}

int lrcsi_sample_beats(const lrcsi_view *view, uint32_t winner, uint32_t loser)
{
    if (view->facing[winner] != view->facing[loser]) {
        return view->facing[winner] > view->facing[loser];
    }
    if (view->facing[winner] < 0) {
        int reflects = lrcsi_prepared_material(view->prepared, winner)->two_sided != 0;
        int other = lrcsi_prepared_material(view->prepared, loser)->two_sided != 0;
        if (reflects != other) {
            return reflects;
        }
    }
    return winner < loser;
}

/* On which side of facet i's plane facet j lies, seen from the laser: exact. */
enum sample_place { SAMPLE_ABOVE, SAMPLE_BELOW, SAMPLE_WITHIN, SAMPLE_ACROSS };

static enum sample_place sample_place_of(const lrcsi_view *view, uint32_t i, uint32_t j)
{
    const double *a = lrcsi_prepared_corner(view->prepared, i, 0);
    const double *b = lrcsi_prepared_corner(view->prepared, i, 1);
    const double *c = lrcsi_prepared_corner(view->prepared, i, 2);
    int above = 0;
    int below = 0;
    for (int k = 0; k < 3; k++) {
        int side = view->facing[i] *
                   lrcsi_exact_side(a, b, c, lrcsi_prepared_corner(view->prepared, j, k));
        above |= side > 0;
        below |= side < 0;
    }
    return above && below ? SAMPLE_ACROSS
           : above        ? SAMPLE_ABOVE
           : below        ? SAMPLE_BELOW
                          : SAMPLE_WITHIN;
}

/* Does the inside of `facet` touch `other`? */
static int sample_touches(const lrcsi_view *view, uint32_t facet, uint32_t other)
{
    const lrcsi_touches *t = &view->prepared->touches;
    for (uint32_t i = t->first[facet]; i < t->first[facet + 1]; i++) {
        if (t->touch[i].other == other) {
            return 1;
        }
    }
    return 0;
}

/* Height of the facet's plane over `point` along the direction, as a fraction: numerator
   N . (a - point), denominator N . d, both times the facing so that the denominator is positive. */
typedef struct sample_height {
    lrcsi_dd top, bottom;
    double top_off, bottom_off; /* bounds on their errors */
} sample_height;

/* Each term: the difference is exact, its product with N is off by 7 u^2, each sum by 3 u^2; with
   N's own error: 16 u^2 |N| |a - point| sqrt(3) + error |a - point|. */
static sample_height sample_height_of(const lrcsi_view *view, uint32_t facet, const double *point)
{
    const lrcsi_normal *n = &view->prepared->normal[facet];
    const double *a = lrcsi_prepared_corner(view->prepared, facet, 0);
    sample_height h = {{0, 0}, {0, 0}, 0, 0};
    double square = 0;
    for (int k = 0; k < 3; k++) {
        lrcsi_dd normal = {n->high[k] * view->facing[facet], n->low[k] * view->facing[facet]};
        lrcsi_dd gap = lrcsi_dd_two_sum(a[k], -point[k]);
        h.top = lrcsi_dd_add(h.top, lrcsi_dd_mul(normal, gap));
        h.bottom = lrcsi_dd_add(h.bottom, lrcsi_dd_scale(normal, view->direction[k]));
        square += gap.hi * gap.hi;
    }
    double off = 32 * U * U * n->length + n->error;
    h.top_off = off * sqrt(square);
    h.bottom_off = off * view->length;
    return h;
}

/* Two planes that meet on the line, where two facets pierce each other: which is nearer just beside
   it, on the side to which the line counts as moved. Heights fall by N_k / (N . d) there. */
static int sample_steeper(const lrcsi_view *view, uint32_t first, uint32_t second,
                          lrcsi_dd first_bottom, lrcsi_dd second_bottom)
{
    const lrcsi_normal *f = &view->prepared->normal[first];
    const lrcsi_normal *s = &view->prepared->normal[second];
    int axis = sample_axis(view->direction);
    for (int k = 1; k <= 2; k++) {
        int e = (axis + k) % 3;
        lrcsi_dd left = lrcsi_dd_mul((lrcsi_dd){f->high[e], f->low[e]}, second_bottom);
        lrcsi_dd right = lrcsi_dd_mul((lrcsi_dd){s->high[e], s->low[e]}, first_bottom);
        double fall = view->facing[first] * lrcsi_dd_value(left) -
                      view->facing[second] * lrcsi_dd_value(right);
        if (fall != 0) {
            return fall < 0 ? 1 : -1;
        }
    }
    return 0;
}

/* The planes meet on the line, or nearly so. The line, as it counts as moved, meets the open inside
   of both facets; so where no corner of one lies below the other's plane and some lie above, it is
   the nearer, exactly: on a contour, and however close two skins may be. Facets that reach across
   each other's planes without touching stay undecided; where they pierce each other, a wrong answer
   within the arithmetic's error of the line where they meet does no harm, for visibility changes
   there. */
static int sample_closely(const lrcsi_view *view, uint32_t first, uint32_t second,
                          lrcsi_dd first_bottom, lrcsi_dd second_bottom)
{
    enum sample_place place = sample_place_of(view, first, second);
    if (place == SAMPLE_WITHIN) {
        return lrcsi_sample_beats(view, first, second) ? 1 : -1;
    }
    if (place != SAMPLE_ACROSS) {
        return place == SAMPLE_BELOW ? 1 : -1;
    }
    place = sample_place_of(view, second, first);
    if (place != SAMPLE_ACROSS) {
        return place == SAMPLE_ABOVE ? 1 : -1;
    }
    if (!sample_touches(view, first, second) || !sample_touches(view, second, first)) {
        return 0;
    }
    return sample_steeper(view, first, second, first_bottom, second_bottom);
}

int lrcsi_sample_nearer(const lrcsi_view *view, uint32_t first, uint32_t second,
                        const double point[3])
{
    sample_height f = sample_height_of(view, first, point);
    sample_height s = sample_height_of(view, second, point);
    lrcsi_dd left = lrcsi_dd_mul(f.top, s.bottom);
    lrcsi_dd right = lrcsi_dd_mul(s.top, f.bottom);
    double difference = lrcsi_dd_value(lrcsi_dd_sub(left, right));
    double off = f.top_off * fabs(s.bottom.hi) + s.bottom_off * fabs(f.top.hi) +
                 s.top_off * fabs(f.bottom.hi) + f.bottom_off * fabs(s.top.hi) +
                 f.top_off * s.bottom_off + s.top_off * f.bottom_off +
                 16 * U * U * (fabs(left.hi) + fabs(right.hi));
    if (fabs(difference) > 1.01 * off) {
        return difference > 0 ? 1 : -1;
    }
    return sample_closely(view, first, second, f.bottom, s.bottom);
}
