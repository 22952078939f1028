/* SPDX-License-Identifier: MIT */
/* The region of the view plane in which one facet hides another. Which facets can do so, and on
   which side of the other's plane their corners lie, is decided exactly; only places are computed
   in doubles, and visibility/occlude.c accounts for that. */
#include "visibility/occluder.h"

#include <math.h>
#include <string.h>

#include "base/dd.h"
#include "base/exact.h"
#include "base/range.h"
#include "visibility/sample.h"

#define U 0x1p-53

/* An occluder, in the target's frame. */
typedef struct occlude_caster {
    double corner[3][2];
    double height[3]; /* above the target's plane, along its normal, times a positive constant */
    int above[3];     /* exact signs of those */
    double off[3];    /* bounds on the errors of the heights */
    double reach;     /* largest distance of a corner from the target's first */
} occlude_caster;

/* --- candidates ------------------------------------------------------------------------------- */

/* Do all corners of `other` lie on or outside the line of one of `facet`'s sides? Exact. */
static int sides_part(const lrcsi_view *view, uint32_t facet, uint32_t other)
{
    const lrcs_prepared *p = view->prepared;
    for (int k = 0; k < 3; k++) {
        const double *a = lrcsi_prepared_corner(p, facet, k);
        const double *b = lrcsi_prepared_corner(p, facet, (k + 1) % 3);
        int inside = 0;
        for (int i = 0; i < 3 && !inside; i++) {
            inside =
                view->facing[facet] *
                    lrcsi_exact_turn(a, b, lrcsi_prepared_corner(p, other, i), view->direction) >
                0;
        }
        if (!inside) {
            return 1;
        }
    }
    return 0;
}

/* Every corner behind the target's farthest, or beside its box, beyond the view's error: the cheap
   test that most candidates fail. */
static int surely_behind(const lrcsi_target *t, uint32_t other)
{
    const lrcsi_view *view = t->view;
    const uint32_t *own = view->prepared->scene->facet[t->facet].corner;
    const uint32_t *its = view->prepared->scene->facet[other].corner;
    double off = 4 * view->off;
    for (int k = 0; k < 3; k++) {
        double own_low = HUGE_VAL;
        double own_high = -HUGE_VAL;
        double its_low = HUGE_VAL;
        double its_high = -HUGE_VAL;
        for (int i = 0; i < 3; i++) {
            own_low = lrcsi_least(own_low, view->point[own[i]].x[k]);
            own_high = lrcsi_most(own_high, view->point[own[i]].x[k]);
            its_low = lrcsi_least(its_low, view->point[its[i]].x[k]);
            its_high = lrcsi_most(its_high, view->point[its[i]].x[k]);
        }
        if (its_high < own_low - off || (k < 2 && its_low > own_high + off)) {
            return 1;
        }
    }
    return 0;
}

/* N . (x - a) for the target's plane, in doubles: off by 8 u |N| |x - a| and N's own error. */
static double height_roughly(const lrcsi_target *t, const double *x, double *off)
{
    const lrcsi_normal *n = &t->view->prepared->normal[t->facet];
    const double *a = lrcsi_prepared_corner(t->view->prepared, t->facet, 0);
    double sum = 0;
    double square = 0;
    for (int k = 0; k < 3; k++) {
        double gap = x[k] - a[k];
        sum += n->high[k] * gap;
        square += gap * gap;
    }
    *off = (8 * U * n->length + n->error) * sqrt(square);
    return t->view->facing[t->facet] * sum;
}

/* The same in double-double: off by 32 u^2 |N| |x - a| and N's own error. */
static double height_finely(const lrcsi_target *t, const double *x, double *off)
{
    const lrcsi_normal *n = &t->view->prepared->normal[t->facet];
    const double *a = lrcsi_prepared_corner(t->view->prepared, t->facet, 0);
    lrcsi_dd sum = {0, 0};
    double square = 0;
    for (int k = 0; k < 3; k++) {
        lrcsi_dd gap = lrcsi_dd_two_sum(x[k], -a[k]);
        sum = lrcsi_dd_add(sum, lrcsi_dd_mul((lrcsi_dd){n->high[k], n->low[k]}, gap));
        square += gap.hi * gap.hi;
    }
    *off = (32 * U * U * n->length + n->error) * sqrt(square);
    return t->view->facing[t->facet] * lrcsi_dd_value(sum);
}

/* 1 all corners surely in front of the target's plane, -1 all behind, 0 neither or not sure. */
static int caster_in_front(const lrcsi_target *t, uint32_t other)
{
    int front = 0;
    int behind = 0;
    for (int k = 0; k < 3; k++) {
        double off = 0;
        double height = height_roughly(t, lrcsi_target_corner(t->view, other, k), &off);
        front += height > off;
        behind += height < -off;
    }
    return front == 3 ? 1 : behind == 3 ? -1 : 0;
}

/* Reads an occluder's heights above the target, their signs exactly. 1 where it can hide some of
   it. In one plane the rules of precedence decide, and nothing needs cutting. */
static int caster_heights(const lrcsi_target *t, uint32_t other, occlude_caster *caster)
{
    const lrcs_prepared *p = t->view->prepared;
    int any = 0;
    int flat = 1;
    for (int k = 0; k < 3; k++) {
        const double *x = lrcsi_target_corner(t->view, other, k);
        double height = height_finely(t, x, &caster->off[k]);
        caster->height[k] = height;
        caster->above[k] = height > 0 ? 1 : -1;
        if (!(fabs(height) > caster->off[k])) {
            caster->above[k] = t->view->facing[t->facet] *
                               lrcsi_exact_side(lrcsi_prepared_corner(p, t->facet, 0),
                                                lrcsi_prepared_corner(p, t->facet, 1),
                                                lrcsi_prepared_corner(p, t->facet, 2), x);
        }
        any |= caster->above[k] > 0;
        flat &= caster->above[k] == 0;
    }
    if (flat) {
        caster->above[0] = caster->above[1] = caster->above[2] = 1;
        return lrcsi_sample_beats(t->view, other, t->facet);
    }
    return any;
}

/* --- regions ---------------------------------------------------------------------------------- */

/* How far a corner may be off, and a line, and more: beyond this a point is surely to one side. */
#define CORNER_OFF (10 * U)
#define CUT_MARGIN (32 * U)
#define SURE_WIDTH (48 * U)

static void region_line(lrcsi_clip_region *region, const double *from, const double *to,
                        double width)
{
    lrcsi_clip_line *line = &region->line[region->lines++];
    line->width = width;
    for (int k = 0; k < 2; k++) {
        line->at[k] = from[k];
        line->to[k] = to[k] - from[k];
    }
}

static void region_grow(lrcsi_clip_region *region, const double *p)
{
    for (int k = 0; k < 2; k++) {
        region->low[k] = lrcsi_least(region->low[k], p[k]);
        region->high[k] = lrcsi_most(region->high[k], p[k]);
    }
}

/* Where the side k of the occluder passes through the target's plane, and how far that may be off:
   the share t = h / (h - h') moves by at most the heights' errors over |h| + |h'|. */
static double side_cut(const occlude_caster *c, int k, double at[2])
{
    int next = (k + 1) % 3;
    double span = fabs(c->height[k]) + fabs(c->height[next]);
    double off = c->off[k] + c->off[next];
    double t = span > 0 ? lrcsi_least(1, fabs(c->height[k]) / span) : 0.5;
    for (int i = 0; i < 2; i++) {
        at[i] = c->corner[k][i] + t * (c->corner[next][i] - c->corner[k][i]);
    }
    return span > 2 * off ? 4 * c->reach * (off / span) : HUGE_VAL;
}

/* The points where the cut by the target's plane enters and leaves the occluder. */
typedef struct region_cut {
    double leave[2], enter[2];
    int real;    /* some side passes through the plane, not only a corner */
    double slip; /* how far the points may be off */
} region_cut;

/* Side k of the occluder, walked counter-clockwise: its part in the cut. */
static void region_side(const occlude_caster *c, int k, region_cut *cut)
{
    int from = c->above[k];
    int to = c->above[(k + 1) % 3];
    if (from * to < 0) {
        cut->slip += side_cut(c, k, from > 0 ? cut->leave : cut->enter);
        cut->real = 1;
    } else if (from == 0 && to < 0) {
        memcpy(cut->leave, c->corner[k], sizeof cut->leave);
    } else if (from < 0 && to == 0) {
        memcpy(cut->enter, c->corner[(k + 1) % 3], sizeof cut->enter);
    }
}

/* How far the corner that the cut parts from the other two lies beyond it. */
static double cut_height(const occlude_caster *c, const region_cut *cut)
{
    int up = (c->above[0] > 0) + (c->above[1] > 0) + (c->above[2] > 0);
    int lone = up == 1 ? 1 : -1; /* the sign of its height */
    const double *p = c->corner[c->above[0] == lone ? 0 : c->above[1] == lone ? 1 : 2];
    double x = cut->enter[0] - cut->leave[0];
    double y = cut->enter[1] - cut->leave[1];
    double side = x * (p[1] - cut->leave[1]) - y * (p[0] - cut->leave[0]);
    return lone * side / hypot(x, y);
}

/* The sides of the occluder that bound its region, and the corners of that, in their order. */
static void region_sides(const occlude_caster *c, double width, lrcsi_clip_region *region,
                         region_cut *cut, lrcsi_clip_polygon *hull)
{
    for (int k = 0; k < 3; k++) {
        int next = (k + 1) % 3;
        if (c->above[k] >= 0) {
            region_grow(region, c->corner[k]);
            memcpy(hull->corner[hull->count++], c->corner[k], sizeof c->corner[k]);
        }
        if (c->above[k] > 0 || c->above[next] > 0 || (c->above[k] == 0 && c->above[next] == 0)) {
            region_line(region, c->corner[k], c->corner[next], width);
        }
        region_side(c, k, cut);
        if (c->above[k] * c->above[next] < 0) {
            memcpy(hull->corner[hull->count++], c->above[k] > 0 ? cut->leave : cut->enter,
                   sizeof cut->leave);
        }
    }
}

/* The rim's length. Where corners are off by e, two hulls differ by 2 e L + 13 e^2: 4 e more of
   length serve for that. A convex region holds a disc of the radius area / L; where that exceeds w,
   lines that are off by w reach no farther than the region grown by twice in all directions, by at
   most 3 w L. */
static double hull_outline(const lrcsi_clip_polygon *hull, double reach, double diameter,
                           double slip)
{
    double length = lrcsi_clip_polygon_perimeter(hull);
    double area = lrcsi_clip_polygon_area(hull);
    int wide = area > 64 * U * (reach + diameter) * length;
    return wide ? length + 4 * (CORNER_OFF * reach + slip) : HUGE_VAL;
}

/* The occluder's triangle, cut where its plane passes behind the target's. The cut leaves one side
   downwards and enters another upwards; its line runs from the one point to the other. It parts one
   corner from the other two. Where that one lies within CUT_MARGIN of it (the points are off by
   less than 6 u reach, the corner by 10 u reach), the line's direction means nothing; then either
   what it cuts off is no wider, and it is left out, or what is left is, and there is no region: 0.
   Elsewhere it crosses both sides within a quarter of the corner's distance beyond the points. A
   triangle that rounding has turned over, or flattened, hides no more than its corners' error; the
   two sides of one that is cut would open backwards without end.

   The true region lies within the corners' error, 10 u reach and the slip, of the hull of its
   computed corners; so a point beyond one of the lines by SURE_WIDTH, the cut's by the slip more,
   is not in it. One so far within all of them is: it lies in the true triangle, and not in the part
   that the cut takes away, which is as near to the hull of its own computed corners. Where the cut
   was left out, what it cuts off lies within CUT_MARGIN and the slip of the sides. */
static int region_make(const occlude_caster *c, double diameter, lrcsi_occluder *o)
{
    double sure = SURE_WIDTH * (c->reach + diameter);
    region_cut cut = {{0, 0}, {0, 0}, 0, 0};
    lrcsi_clip_region *region = &o->region;
    lrcsi_clip_polygon hull;
    hull.count = 0;
    o->error = 4 * 14 * U * (c->reach + diameter);
    if (!(lrcsi_clip_corners_area((const double(*)[2])c->corner, 3) > 0)) {
        return 0;
    }
    *region = (lrcsi_clip_region){.low = {HUGE_VAL, HUGE_VAL}, .high = {-HUGE_VAL, -HUGE_VAL}};
    region_sides(c, sure, region, &cut, &hull);
    region->width = sure + cut.slip;
    o->error += 4 * cut.slip;
    if (cut.real) {
        region_grow(region, cut.leave);
        region_grow(region, cut.enter);
        if (!(cut_height(c, &cut) > CUT_MARGIN * c->reach)) {
            for (int k = 0; k < region->lines; k++) {
                region->line[k].width += cut.slip;
            }
            return region->lines == 3;
        }
        region_line(region, cut.leave, cut.enter, sure + cut.slip);
    }
    o->outline = hull_outline(&hull, c->reach, diameter, cut.slip);
    return 1;
}

/* --- contacts --------------------------------------------------------------------------------- */

double lrcsi_occluder_contact(const lrcsi_target *t, uint32_t other, double low[2], double high[2])
{
    occlude_caster c = {.above = {1, 1, 1}};
    lrcsi_clip_region box = {.low = {HUGE_VAL, HUGE_VAL}, .high = {-HUGE_VAL, -HUGE_VAL}};
    lrcsi_clip_region all = box;
    double slip = 0;
    c.reach = lrcsi_target_frame(t->view, t->facet, other, c.corner);
    caster_heights(t, other, &c);
    for (int k = 0; k < 3; k++) {
        double at[2];
        region_grow(&all, c.corner[k]);
        if (c.above[k] == 0) {
            region_grow(&box, c.corner[k]);
        } else if (c.above[k] * c.above[(k + 1) % 3] < 0) {
            slip = lrcsi_most(slip, side_cut(&c, k, at));
            region_grow(&box, at);
        }
    }
    int told = box.low[0] <= box.high[0] && isfinite(slip);
    for (int k = 0; k < 2; k++) {
        low[k] = told ? box.low[k] - slip : all.low[k];
        high[k] = told ? box.high[k] + slip : all.high[k];
    }
    return c.reach;
}

/* --- one occluder ----------------------------------------------------------------------------- */

int lrcsi_occluder_make(const lrcsi_target *t, uint32_t other, lrcsi_occluder *occluder)
{
    const lrcsi_view *view = t->view;
    occlude_caster caster = {.above = {1, 1, 1}};
    occluder->error = occluder->charged = 0;
    occluder->outline = HUGE_VAL;
    if (surely_behind(t, other)) {
        return 0;
    }
    int front = caster_in_front(t, other);
    if (front < 0 || (front == 0 && !caster_heights(t, other, &caster)) ||
        sides_part(view, t->facet, other) || sides_part(view, other, t->facet)) {
        return 0;
    }
    caster.reach = lrcsi_target_frame(view, t->facet, other, caster.corner);
    return region_make(&caster, t->diameter, occluder);
}
