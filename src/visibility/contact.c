/* SPDX-License-Identifier: MIT */
/* A facet against the plane of another: on which side its corners lie, exactly, and where it passes
   through, in doubles, with how far that may be off. Which facets touch is known
   (mesh/intersection.h). */
#include "visibility/contact.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/dd.h"
#include "base/exact.h"
#include "base/length.h"
#include "base/range.h"
#include "visibility/clip.h"
#include "visibility/sample.h"

/* How many times its error a height must be, so that where it is 0 is told to a double. */
#define TOLD 0x1p53

/* The corners of a facet above the target's plane. */
typedef struct contact_heights {
    double height[3]; /* along the plane's normal, times a positive constant */
    lrcsi_dd fine[3]; /* the same to double-double */
    double off[3];    /* bounds on their errors */
    int above[3];     /* exact signs */
} contact_heights;

/* N . (x - a) for the target's plane, up where it is seen, in double-double: off by 32 u^2 |N|
   |x - a| and N's own error. */
static lrcsi_dd height_finely(const lrcsi_target *t, const double *x, double *off)
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
    *off = (32 * LRCSI_U * LRCSI_U * n->length + n->error) * sqrt(square);
    return t->view->facing[t->facet] > 0 ? sum : lrcsi_dd_negate(sum);
}

/* 1 all corners of `other` lie in front of the facet's plane or on it, -1 behind, 0 neither or all
   on it. */
static int contact_side(const lrcsi_view *view, uint32_t facet, uint32_t other)
{
    int front = 0;
    int behind = 0;
    for (int k = 0; k < 3 && !(front && behind); k++) {
        int sign = lrcsi_sample_above(view, facet, lrcsi_prepared_corner(view->prepared, other, k));
        front |= sign > 0;
        behind |= sign < 0;
    }
    return front - behind;
}

int lrcsi_contact_side(const lrcsi_view *view, uint32_t facet, uint32_t other)
{
    int side = contact_side(view, facet, other);
    return side != 0 ? side : -contact_side(view, other, facet);
}

/* Where, in projection, side p q of one facet and side r s of another cross: 1 the latter is nearer
   there, -1 farther; 0 if they do not cross, or meet. */
static int sides_order(const lrcsi_view *view, const double *p, const double *q, const double *r,
                       const double *s)
{
    const double *d = view->direction;
    int left = lrcsi_exact_turn(p, q, s, d);
    if (left * lrcsi_exact_turn(p, q, r, d) >= 0 ||
        lrcsi_exact_turn(r, s, p, d) * lrcsi_exact_turn(r, s, q, d) >= 0) {
        return 0;
    }
    return -left * lrcsi_exact_side(p, q, r, s);
}

int lrcsi_contact_order(const lrcsi_view *view, uint32_t facet, uint32_t other)
{
    const lrcs_prepared *prepared = view->prepared;
    int order = 0;
    for (int n = 0; n < 9 && order == 0; n++) {
        order = sides_order(view, lrcsi_prepared_corner(prepared, facet, n / 3),
                            lrcsi_prepared_corner(prepared, facet, (n / 3 + 1) % 3),
                            lrcsi_prepared_corner(prepared, other, n % 3),
                            lrcsi_prepared_corner(prepared, other, (n + 1) % 3));
    }
    return order;
}

/* Does a facet cover a point in projection, its sides included? */
static int covers_closed(const lrcsi_view *view, uint32_t facet, const double point[3])
{
    int covers = 1;
    for (int k = 0; k < 3 && covers; k++) {
        const double *p = lrcsi_prepared_corner(view->prepared, facet, k);
        const double *q = lrcsi_prepared_corner(view->prepared, facet, (k + 1) % 3);
        covers = view->facing[facet] * lrcsi_exact_turn(p, q, point, view->direction) >= 0;
    }
    return covers;
}

/* A corner on the other's plane tells nothing: they meet there. */
int lrcsi_contact_within(const lrcsi_view *view, uint32_t facet, uint32_t other)
{
    int order = 0;
    for (int n = 0; n < 6 && order == 0; n++) {
        const double *its = lrcsi_prepared_corner(view->prepared, facet, n % 3);
        const double *others = lrcsi_prepared_corner(view->prepared, other, n % 3);
        if (n < 3 && covers_closed(view, other, its)) {
            order = -lrcsi_sample_above(view, other, its);
        }
        if (n >= 3 && covers_closed(view, facet, others)) {
            order = lrcsi_sample_above(view, facet, others);
        }
    }
    return order;
}

/* In double-double where that tells it to TOLD, else exactly; in a needle, of which others may be
   2^88 times as long as it is wide, always. Returns its sign. */
static int height_find(const lrcsi_target *t, const double *x, lrcsi_dd *height, double *off)
{
    const lrcs_prepared *p = t->view->prepared;
    int told = 0;
    if (!t->needle) {
        *height = height_finely(t, x, off);
        told = fabs(height->hi) > TOLD * *off;
    }
    if (!told) {
        lrcsi_dd up = lrcsi_exact_height(lrcsi_prepared_corner(p, t->facet, 0),
                                         lrcsi_prepared_corner(p, t->facet, 1),
                                         lrcsi_prepared_corner(p, t->facet, 2), x);
        *height = t->view->facing[t->facet] > 0 ? up : lrcsi_dd_negate(up);
        *off = 128 * LRCSI_U * LRCSI_U * fabs(up.hi);
    }
    return (height->hi > 0) - (height->hi < 0);
}

static contact_heights heights_of(const lrcsi_target *t, uint32_t other)
{
    contact_heights h;
    for (int k = 0; k < 3; k++) {
        const double *x = lrcsi_target_own(t->view, other, k);
        h.above[k] = height_find(t, x, &h.fine[k], &h.off[k]);
        h.height[k] = lrcsi_dd_value(h.fine[k]);
    }
    return h;
}

/* Where side k of the facet passes through the target's plane, its ends on both sides of it, and
   how far that may be off. It lies at a share t = h / (h + h') of the side, from its nearer end,
   which moves by (1 - t) / (h + h') of what h is off, and t / (h + h') of what h' is. Ends are off
   by 10 u of their distance, so the point by as much of its own (that at t of the side counts as
   at t between theirs), and its rounding is below 6 u of that. */
static double side_cut(const contact_heights *h, const lrcsi_contact *c, int k, double at[2],
                       double *reach)
{
    int next = (k + 1) % 3;
    int near = c->away[k] <= c->away[next] ? k : next;
    int far = near == k ? next : k;
    double span = fabs(h->height[k]) + fabs(h->height[next]);
    double t = lrcsi_least(1, fabs(h->height[near]) / span);
    for (int i = 0; i < 2; i++) {
        at[i] = c->corner[near][i] + t * (c->corner[far][i] - c->corner[near][i]);
    }
    *reach = (1 - t) * c->away[near] + t * c->away[far];
    double off = (1 - t) * h->off[near] + t * h->off[far];
    return 2 * (c->away[k] + c->away[next]) * (off / span);
}

/* May the segment be off by more than the facet, of the area told, is wide, about? */
static int position_err_wide(const lrcsi_contact *c, double area)
{
    lrcsi_clip_polygon triangle;
    lrcsi_clip_triangle((const double(*)[2])c->corner, &triangle);
    return c->position_err > 0 && !(c->position_err * lrcsi_clip_perimeter(&triangle) < area);
}

/* Of the facet. Its corners are counted from a near one, so that this is no difference of far ones.
 */
static double contact_area(const lrcsi_contact *c)
{
    lrcsi_clip_polygon triangle;
    lrcsi_clip_triangle((const double(*)[2])c->corner, &triangle);
    return lrcsi_clip_area(&triangle);
}

/* Walked counter-clockwise, the facet leaves its part above the plane in one place and enters it in
   another: corners on the plane, or sides that pass through it (SIDE and their number). */
#define SIDE 3
static void contact_leaves(const contact_heights *h, int leaves[2])
{
    leaves[0] = leaves[1] = 0;
    for (int k = 0; k < 3; k++) {
        int before = h->above[(k + 2) % 3];
        int at = h->above[k];
        int next = h->above[(k + 1) % 3];
        if (at * next < 0) {
            leaves[at < 0] = SIDE + k;
        }
        if (at == 0 && (before > 0 || next < 0)) {
            leaves[0] = k;
        }
        if (at == 0 && (before < 0 || next > 0)) {
            leaves[1] = k;
        }
    }
}

/* Of what the segment has near the target. */
static void contact_ends(const lrcsi_target *t, const contact_heights *h, lrcsi_contact *c)
{
    int leaves[2];
    double reach[2];
    contact_leaves(h, leaves);
    for (int i = 0; i < 2; i++) {
        if (leaves[i] >= SIDE) {
            double position_err = side_cut(h, c, leaves[i] - SIDE, c->end[i], &reach[i]);
            c->position_err = lrcsi_most(c->position_err, position_err);
        } else {
            memcpy(c->end[i], c->corner[leaves[i]], sizeof c->end[i]);
            reach[i] = c->away[leaves[i]];
        }
    }
    c->reach = lrcsi_target_segment(t, c->end, reach);
}

/* The segment's ends, and the corner that it parts from the others, are off by 16 u of how far away
   they are and the position error, e at most. Where that corner lies 4 e beyond its line, that
   crosses both sides of the facet within a quarter of this beyond the ends, and parts the facet as
   the segment does. Else all that it cuts off is as near to the line, or, where the segment is so
   short that its line may turn anywhere, to the line from it to the corner: that is taken in then,
   and what the rest does is all there is to tell. What is cut off lies along the line as far as the
   corner, which may be far beyond the segment; of what it has within 4 diameters of the target, the
   corner's own error moves no more than if it were there. */
static int segment_kind(const lrcsi_target *t, const contact_heights *h, lrcsi_contact *c,
                        int above)
{
    int lone = above == 1 ? 1 : -1; /* the sign of its height */
    int corner = h->above[0] == lone ? 0 : h->above[1] == lone ? 1 : 2;
    const double *p = c->corner[corner];
    double off = 16 * LRCSI_U * lrcsi_most(c->away[corner], c->reach) + c->position_err;
    const lrcsi_clip_line line = {{c->end[0][0], c->end[0][1]},
                                  {c->end[1][0] - c->end[0][0], c->end[1][1] - c->end[0][1]}};
    double length = lrcsi_length_flat(line.to[0], line.to[1]);
    double beyond = length > 0 ? lone * lrcsi_clip_side(&line, p) / length : 0;
    if (position_err_wide(c, contact_area(c))) {
        return LRCSI_CONTACT_UNKNOWN;
    }
    if (beyond > 4 * off) {
        return LRCSI_CONTACT_LINE;
    }
    if (length > 4 * off) {
        double away = lrcsi_least(c->away[corner], c->reach + 4 * t->diameter);
        c->position_err += fabs(beyond) + 16 * LRCSI_U * away;
    } else {
        c->position_err += length;
        memcpy(c->end[1], p, sizeof c->end[1]);
        c->reach = lrcsi_most(c->reach, c->away[corner]);
    }
    return lone > 0 ? LRCSI_CONTACT_BEHIND : LRCSI_CONTACT_FRONT;
}

/* --- in a needle ------------------------------------------------------------------------------ */

/* A facet in a needle's frame: its corners there, and the segment's ends. */
typedef struct contact_finely {
    lrcsi_dd corner[3][2];
    lrcsi_dd end[2][2];
} contact_finely;

static void corners_finely(const lrcsi_target *t, uint32_t other, contact_finely *f,
                           lrcsi_contact *c)
{
    for (int k = 0; k < 3; k++) {
        const double *x = lrcsi_target_own(t->view, other, k);
        c->off = lrcsi_most(c->off, lrcsi_needle_place(t->needle, x, f->corner[k]));
        for (int i = 0; i < 2; i++) {
            c->corner[k][i] = lrcsi_dd_value(f->corner[k][i]);
        }
    }
}

/* As side_cut, the share rounded to double-double (visibility/needle.c). */
static double side_cut_finely(const contact_heights *h, contact_finely *f, int k, lrcsi_dd at[2])
{
    int next = (k + 1) % 3;
    double span = fabs(h->height[k]) + fabs(h->height[next]);
    double off = h->off[k] + h->off[next];
    double length = 0;
    lrcsi_dd t = lrcsi_needle_quotient(h->fine[k], lrcsi_dd_sub(h->fine[k], h->fine[next]));
    for (int i = 0; i < 2; i++) {
        lrcsi_dd along = lrcsi_dd_sub(f->corner[next][i], f->corner[k][i]);
        at[i] = lrcsi_dd_add(f->corner[k][i], lrcsi_dd_mul(t, along));
        length += fabs(along.hi);
    }
    return 2 * length * (off / span);
}

static void ends_finely(const contact_heights *h, contact_finely *f, lrcsi_contact *c)
{
    int leaves[2];
    contact_leaves(h, leaves);
    for (int i = 0; i < 2; i++) {
        if (leaves[i] >= SIDE) {
            double position_err = side_cut_finely(h, f, leaves[i] - SIDE, f->end[i]);
            c->position_err = lrcsi_most(c->position_err, position_err);
        } else {
            memcpy(f->end[i], f->corner[leaves[i]], sizeof f->end[i]);
        }
    }
}

/* Rounds the ends of a segment that no clipping will shorten, since it meets the facet. That may
   turn its line anywhere: it is the rounded one that parts. 1 if it is so short. */
static int ends_round(contact_finely *f)
{
    int brief = 1;
    for (int i = 0; i < 2; i++) {
        brief &= fabs(f->end[1][i].hi - f->end[0][i].hi) < 0.5;
    }
    for (int i = 0; i < 4 && brief; i++) {
        f->end[i / 2][i % 2] = (lrcsi_dd){lrcsi_dd_value(f->end[i / 2][i % 2]), 0};
    }
    return brief;
}

/* Of the facet, which may be a needle too: as long as others are, and as narrow as this one. */
static double area_finely(const contact_finely *f)
{
    lrcsi_dd side[2][2];
    for (int i = 0; i < 4; i++) {
        side[i / 2][i % 2] = lrcsi_dd_sub(f->corner[1 + i / 2][i % 2], f->corner[0][i % 2]);
    }
    return 0.5 * lrcsi_dd_value(lrcsi_dd_sub(lrcsi_dd_mul(side[0][0], side[1][1]),
                                             lrcsi_dd_mul(side[0][1], side[1][0])));
}

/* As segment_kind, of a short segment; a long one is not clipped yet. Of that, ends and corner are
   off by e: the line turns by 2 e over its length, and what the corner is beyond it is off by as
   much of the way there, and 2 e. Where that is long, it counts: `turned`. */
static int kind_finely(const contact_heights *h, contact_finely *f, lrcsi_contact *c, int above)
{
    int lone = above == 1 ? 1 : -1;
    const lrcsi_dd *p = f->corner[h->above[0] == lone ? 0 : h->above[1] == lone ? 1 : 2];
    lrcsi_dd to[2];
    lrcsi_dd way[2];
    int brief = ends_round(f);
    for (int i = 0; i < 2; i++) {
        to[i] = lrcsi_dd_sub(f->end[1][i], f->end[0][i]);
        way[i] = lrcsi_dd_sub(p[i], f->end[0][i]);
    }
    double off = c->off + 16 * LRCSI_U + c->position_err;
    double length = lrcsi_length_flat(to[0].hi, to[1].hi);
    double side =
        lrcsi_dd_value(lrcsi_dd_sub(lrcsi_dd_mul(to[0], way[1]), lrcsi_dd_mul(to[1], way[0])));
    double beyond = length > 0 ? lone * side / length : 0;
    double far = lrcsi_length_flat(way[0].hi, way[1].hi);
    double turned = brief ? 0 : 4 * far / length * (c->off + c->position_err);
    int kind = LRCSI_CONTACT_LINE;
    if (!(beyond > 4 * off + turned)) {
        kind = lone > 0 ? LRCSI_CONTACT_BEHIND : LRCSI_CONTACT_FRONT;
        if (length > 4 * off) {
            c->position_err += fabs(beyond) + turned;
        } else {
            c->position_err += length;
            memcpy(f->end[1], p, sizeof f->end[1]);
        }
    }
    return position_err_wide(c, area_finely(f)) ? LRCSI_CONTACT_UNKNOWN : kind;
}

static int segment_finely(const contact_heights *h, contact_finely *f, lrcsi_contact *c, int above)
{
    ends_finely(h, f, c);
    int kind = kind_finely(h, f, c, above);
    lrcsi_dd part[2];
    lrcsi_needle_clip((const lrcsi_dd *)f->end[0], (const lrcsi_dd *)f->end[1], c->end, part);
    return kind;
}

/* --- either ----------------------------------------------------------------------------------- */

int lrcsi_contact_find(const lrcsi_target *t, uint32_t other, lrcsi_contact *c)
{
    contact_heights h = heights_of(t, other);
    contact_finely f = {0};
    *c = (lrcsi_contact){.position_err = 0};
    if (t->needle) {
        corners_finely(t, other, &f, c);
    }
    for (int k = 0; k < 3 && !t->needle; k++) {
        c->away[k] = lrcsi_target_place(t, lrcsi_target_own(t->view, other, k), c->corner[k]);
    }
    int above = 0;
    int below = 0;
    for (int k = 0; k < 3; k++) {
        above += h.above[k] > 0;
        below += h.above[k] < 0;
    }
    int on = 3 - above - below;
    if (on == 3) {
        return LRCSI_CONTACT_FLAT;
    }
    if (on < 2 && (above == 0 || below == 0)) {
        return LRCSI_CONTACT_POINT;
    }
    if (t->needle) {
        return segment_finely(&h, &f, c, above);
    }
    contact_ends(t, &h, c);
    return segment_kind(t, &h, c, above);
}
