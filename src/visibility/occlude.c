/* SPDX-License-Identifier: MIT */
/* Analytic visibility. Which facets can hide one, and on which side of its plane their corners
   lie, is decided exactly; only the areas are computed in doubles.

   Error. Work in the facet's frame: corners relative to its first one, rotated into the view, each
   off by at most e = 8 u r, r the largest distance of the corners at hand from that corner (R's
   rows are orthonormal to 4 u; a rounded difference, three products and two sums). The region that
   an occluder hides is cut by exactly the lines through its own computed corners, so it differs
   from the true one by a rim no wider than e, of length at most the facet's own perimeter, p, on
   each of at most four sides: 4 e p. The cut by the facet's plane has its ends on the occluder's
   sides, at a share t = h / (h - h') of opposite heights, each known to 128 u relatively: their
   place is off by less than 2 e more. A split of a piece puts one corner on a line to within
   8 u d, d the facet's diameter, and both parts share it: 8 u d p. All is added up per facet. */
#include "visibility/occlude.h"

#include <math.h>

#include "base/dd.h"
#include "base/exact.h"
#include "base/work.h"
#include "visibility/query.h"
#include "visibility/sample.h"

#define U 0x1p-53

/* The facet being asked for, in its own frame. */
typedef struct occlude_target {
    const lrcsi_view *view;
    uint32_t facet;
    double corner[3][2]; /* counter-clockwise in the view */
    double diameter;
    double low[2], high[2];
    double error; /* bound on the area's error so far */
    double doubt; /* area that could not be decided */
} occlude_target;

/* An occluder, in the target's frame. */
typedef struct occlude_caster {
    double corner[3][2];
    double height[3]; /* above the target's plane, along its normal, times a positive constant */
    int above[3];     /* exact signs of those */
    double reach;     /* largest distance of a corner from the target's first */
} occlude_caster;

/* --- coordinates ------------------------------------------------------------------------------ */

/* A scene point relative to the target's first corner, in the view plane; returns its distance. */
static double frame_point(const lrcsi_view *view, const double *origin, const double *x,
                          double out[2])
{
    double p[3];
    double square = 0;
    for (int k = 0; k < 3; k++) {
        p[k] = x[k] - origin[k];
        square += p[k] * p[k];
    }
    for (int k = 0; k < 2; k++) {
        out[k] = view->R[k][0] * p[0] + view->R[k][1] * p[1] + view->R[k][2] * p[2];
    }
    return sqrt(square);
}

/* Corners of a facet in the target's frame, counter-clockwise; returns the farthest distance. */
static double frame_facet(const lrcsi_view *view, uint32_t target, uint32_t facet,
                          double corner[3][2])
{
    const double *origin = lrcsi_prepared_corner(view->prepared, target, 0);
    double reach = 0;
    for (int k = 0; k < 3; k++) {
        int from = view->facing[facet] > 0 ? k : (3 - k) % 3;
        const double *x = lrcsi_prepared_corner(view->prepared, facet, from);
        reach = fmax(reach, frame_point(view, origin, x, corner[k]));
    }
    return reach;
}

static void target_start(const lrcsi_view *view, uint32_t facet, occlude_target *t)
{
    *t = (occlude_target){.view = view, .facet = facet};
    double reach = frame_facet(view, facet, facet, t->corner);
    t->diameter = 2 * reach;
    for (int k = 0; k < 2; k++) {
        t->low[k] = fmin(t->corner[0][k], fmin(t->corner[1][k], t->corner[2][k]));
        t->high[k] = fmax(t->corner[0][k], fmax(t->corner[1][k], t->corner[2][k]));
    }
    t->error = 32 * U * t->diameter * t->diameter;
}

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
            inside = view->facing[facet] * lrcsi_exact_turn(a, b, lrcsi_prepared_corner(p, other, i),
                                                            view->direction) > 0;
        }
        if (!inside) {
            return 1;
        }
    }
    return 0;
}

/* N . (x - a) for the target's plane, in double-double: off by 32 u^2 |N| |x - a| and N's own
   error. Only its size matters: its sign is asked exactly where that could be wrong. */
static double plane_height(const lrcsi_view *view, uint32_t facet, const double *x, double *off)
{
    const lrcsi_normal *n = &view->prepared->normal[facet];
    const double *a = lrcsi_prepared_corner(view->prepared, facet, 0);
    lrcsi_dd sum = {0, 0};
    double square = 0;
    for (int k = 0; k < 3; k++) {
        lrcsi_dd gap = lrcsi_dd_two_sum(x[k], -a[k]);
        sum = lrcsi_dd_add(sum, lrcsi_dd_mul((lrcsi_dd){n->high[k], n->low[k]}, gap));
        square += gap.hi * gap.hi;
    }
    *off = (32 * U * U * n->length + n->error) * sqrt(square);
    return view->facing[facet] * lrcsi_dd_value(sum);
}

/* Reads an occluder's heights above the target. 1 where it can hide some of it; heights too small
   to be known to a hundred roundings make the whole overlap doubtful. */
static int caster_heights(occlude_target *t, uint32_t other, occlude_caster *caster)
{
    const lrcsi_view *view = t->view;
    const lrcs_prepared *p = view->prepared;
    int any = 0;
    int flat = 1;
    int vague = 0;
    for (int k = 0; k < 3; k++) {
        int from = view->facing[other] > 0 ? k : (3 - k) % 3;
        const double *x = lrcsi_prepared_corner(p, other, from);
        double off = 0;
        double height = plane_height(view, t->facet, x, &off);
        int sure = fabs(height) > 0x1p46 * off;
        caster->height[k] = height;
        caster->above[k] = height > 0 ? 1 : -1;
        if (!sure) {
            caster->above[k] = view->facing[t->facet] *
                               lrcsi_exact_side(lrcsi_prepared_corner(p, t->facet, 0),
                                                lrcsi_prepared_corner(p, t->facet, 1),
                                                lrcsi_prepared_corner(p, t->facet, 2), x);
            vague |= caster->above[k] != 0;
        }
        any |= caster->above[k] > 0;
        flat &= caster->above[k] == 0;
    }
    if (flat) { /* coincident planes: the rules of precedence decide, and nothing needs cutting */
        caster->above[0] = caster->above[1] = caster->above[2] = 1;
        return lrcsi_sample_beats(view, other, t->facet);
    }
    int cut = caster->above[0] < 0 || caster->above[1] < 0 || caster->above[2] < 0;
    if (any && cut && vague) {
        t->doubt = INFINITY;
    }
    return any;
}

/* --- regions ---------------------------------------------------------------------------------- */

static void region_line(lrcsi_clip_region *region, const double *from, const double *to)
{
    lrcsi_clip_line *line = &region->line[region->lines++];
    for (int k = 0; k < 2; k++) {
        line->at[k] = from[k];
        line->to[k] = to[k] - from[k];
    }
}

static void region_grow(lrcsi_clip_region *region, const double *p)
{
    for (int k = 0; k < 2; k++) {
        region->low[k] = fmin(region->low[k], p[k]);
        region->high[k] = fmax(region->high[k], p[k]);
    }
}

/* The occluder's triangle, cut where its plane passes behind the target's. Walking its sides, the
   cut leaves one side downwards and enters another upwards; its line runs from the one point to
   the other. Ends closer than their own error make no line: either what they cut off is no wider,
   or all that is left, and then there is no region: 0. */
static int region_make(const occlude_caster *c, lrcsi_clip_region *region)
{
    double leave[2] = {0, 0};
    double enter[2] = {0, 0};
    int cut = 0;
    *region = (lrcsi_clip_region){.low = {INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY}};
    for (int k = 0; k < 3; k++) {
        int next = (k + 1) % 3;
        const double *p = c->corner[k];
        const double *q = c->corner[next];
        if (c->above[k] >= 0) {
            region_grow(region, p);
        }
        if (c->above[k] > 0 || c->above[next] > 0 || (c->above[k] == 0 && c->above[next] == 0)) {
            region_line(region, p, q);
        }
        double t = c->height[k] / (c->height[k] - c->height[next]);
        double at[2] = {p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])};
        if (c->above[k] > 0 && c->above[next] < 0) {
            leave[0] = at[0];
            leave[1] = at[1];
            cut = 1;
            region_grow(region, at);
        } else if (c->above[k] < 0 && c->above[next] > 0) {
            enter[0] = at[0];
            enter[1] = at[1];
            cut = 1;
            region_grow(region, at);
        } else if (c->above[k] == 0 && c->above[next] < 0) {
            leave[0] = p[0];
            leave[1] = p[1];
        } else if (c->above[k] < 0 && c->above[next] == 0) {
            enter[0] = q[0];
            enter[1] = q[1];
        }
    }
    double length = hypot(enter[0] - leave[0], enter[1] - leave[1]);
    if (!cut) {
        return 1;
    }
    if (length <= 64 * U * c->reach) {
        return region->lines == 3;
    }
    region_line(region, leave, enter);
    return 1;
}

/* --- one facet -------------------------------------------------------------------------------- */

static int box_misses_target(const occlude_target *t, const occlude_caster *c)
{
    double off = 16 * U * (c->reach + t->diameter);
    for (int k = 0; k < 2; k++) {
        double low = fmin(c->corner[0][k], fmin(c->corner[1][k], c->corner[2][k]));
        double high = fmax(c->corner[0][k], fmax(c->corner[1][k], c->corner[2][k]));
        if (low > t->high[k] + off || high < t->low[k] - off) {
            return 1;
        }
    }
    return 0;
}

/* Takes away what one facet hides. 0 where the pieces outgrew their lists. */
static int occlude_by(occlude_target *t, uint32_t other, lrcsi_clip *clip)
{
    const lrcsi_view *view = t->view;
    occlude_caster caster = {.reach = 0};
    caster.reach = frame_facet(view, t->facet, other, caster.corner);
    if (box_misses_target(t, &caster) || !caster_heights(t, other, &caster) ||
        sides_part(view, t->facet, other) || sides_part(view, other, t->facet)) {
        return 1;
    }
    lrcsi_clip_region region;
    uint32_t splits = clip->splits;
    int fits = !region_make(&caster, &region) || lrcsi_clip_subtract(clip, &region);
    double perimeter = 3 * t->diameter;
    t->error += (4 * 10 * U * (caster.reach + t->diameter) +
                 (clip->splits - splits) * 8 * U * t->diameter) * perimeter;
    return fits;
}

/* Asks every facet listed near the target, each once, while something is left of it. */
static int occlude_target_by_all(occlude_target *t, const lrcsi_grid *facets, uint32_t *asked,
                                 lrcsi_clip *clip)
{
    double low[2];
    double high[2];
    lrcsi_grid_box(t->view, t->view->prepared->scene->facet[t->facet].corner, 3, low, high);
    lrcsi_cells cells = lrcsi_grid_cells(facets, low, high);
    for (uint32_t y = cells.y0; y < cells.y1; y++) {
        uint32_t i = facets->first[(size_t)y * facets->size + cells.x0];
        uint32_t end = facets->first[(size_t)y * facets->size + cells.x1];
        for (; i < end && clip->list.pieces != 0; i++) {
            uint32_t other = facets->item[i];
            if (other == t->facet || asked[other] == t->facet + 1) {
                continue;
            }
            asked[other] = t->facet + 1;
            if (!occlude_by(t, other, clip)) {
                return 0;
            }
        }
    }
    return 1;
}

static lrcsi_visible occlude_contested(const lrcsi_view *view, uint32_t facet,
                                       const lrcsi_grid *facets, uint32_t *asked, lrcsi_clip *clip)
{
    double whole = lrcsi_view_tilt(view, facet).projected;
    occlude_target t;
    target_start(view, facet, &t);
    lrcsi_clip_start(clip, (const double(*)[2])t.corner);
    int complete = occlude_target_by_all(&t, facets, asked, clip);
    double left = fmin(whole, lrcsi_clip_area(clip));
    double error = t.error + t.doubt;
    lrcsi_visible v = {left, fmax(0, left - error), fmin(whole, left + error), 0};
    if (!complete) {
        v.low = 0;
    }
    if (!(error <= whole)) {
        v.low = 0;
        v.high = whole;
    }
    return v;
}

static lrcsi_visible occlude_uniform(const lrcsi_view *view, uint32_t facet,
                                     const lrcsi_grid *facets)
{
    double whole = lrcsi_view_tilt(view, facet).projected;
    switch (lrcsi_query_facet(facets, facet)) {
    case LRCSI_QUERY_HIDDEN:
        return (lrcsi_visible){0, 0, 0, 0};
    case LRCSI_QUERY_VISIBLE:
        return (lrcsi_visible){whole, whole, whole, 0};
    default:
        return (lrcsi_visible){0.5 * whole, 0, whole, 0};
    }
}

/* --- all facets ------------------------------------------------------------------------------- */

size_t lrcsi_occlude_need(const lrcs_prepared *prepared)
{
    size_t facets = prepared->scene->facet_count;
    size_t need = lrcsi_work_add(lrcsi_clip_need(), lrcsi_work_bytes(facets, sizeof(uint32_t)));
    return lrcsi_work_add(need, lrcsi_grid_facets_need(prepared));
}

int lrcsi_occlude_all(const lrcsi_contest *contest, lrcs_work *work, lrcsi_visible *visible)
{
    const lrcsi_view *view = contest->view;
    uint32_t count = view->prepared->scene->facet_count;
    size_t mark = work->used;
    lrcsi_grid facets;
    lrcsi_clip clip;
    uint32_t *asked = lrcsi_work_take_zero(work, count, sizeof *asked);
    int status = asked ? lrcsi_clip_make(work, &clip) : LRCS_E_MEMORY;
    if (status == LRCS_OK) {
        status = lrcsi_grid_facets(view, work, &facets);
    }
    for (uint32_t f = 0; f < count && status == LRCS_OK; f++) {
        visible[f] = (lrcsi_visible){0, 0, 0, 0};
        if (lrcsi_grid_casts(view, f)) {
            visible[f] = contest->contested[f] ? occlude_contested(view, f, &facets, asked, &clip)
                                               : occlude_uniform(view, f, &facets);
        }
    }
    work->used = mark;
    return status;
}
