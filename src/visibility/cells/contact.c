/* SPDX-License-Identifier: MIT */
/* A facet and the plane of another: on which side its corners lie (exact), and where it intersects
   the plane (in doubles, with error bounds). Which facets have contact is known from
   mesh/contact/intersection.h. */
#include "visibility/cells/contact.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/dd.h"
#include "base/exact.h"
#include "base/length.h"
#include "base/range.h"
#include "visibility/base/clip.h"
#include "visibility/base/sample.h"

/* Intersections are accurate to a double if heights exceed their errors by this factor. */
#define HEIGHT_SUFFICES 0x1p53

/* The heights of a facet's corners above the target's plane. */
typedef struct contact_heights {
    double height[3]; /* along the plane's normal, times a positive constant */
    lrcsi_dd fine[3]; /* the same in double-double */
    double err[3];    /* bounds on their errors */
    int above[3];     /* exact signs */
} contact_heights;

/* N . (x - a) for the target's plane, positive on its visible side, in double-double. The error is
   32 u^2 |N| |x - a|, plus that of N. */
static lrcsi_dd height_dd(const lrcsi_target *t, const double *x, double *err)
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
    *err = (32 * LRCSI_U * LRCSI_U * n->length + n->error) * sqrt(square);
    return t->view->facing[t->facet] > 0 ? sum : lrcsi_dd_negate(sum);
}

/* The heights in double-double if that suffices, otherwise from the exact determinant. For a needle
   always the latter, because other facets may be 2^88 times as long as the needle is wide. */
static contact_heights heights_of(const lrcsi_target *t, const double *const corner[3])
{
    const lrcs_prepared *p = t->view->prepared;
    contact_heights h;
    for (int k = 0; k < 3; k++) {
        const double *x = corner[k];
        int accurate = 0;
        if (!t->needle) {
            h.fine[k] = height_dd(t, x, &h.err[k]);
            accurate = fabs(h.fine[k].hi) > HEIGHT_SUFFICES * h.err[k];
        }
        if (!accurate) {
            lrcsi_dd up = lrcsi_exact_height(lrcsi_prepared_corner(p, t->facet, 0),
                                             lrcsi_prepared_corner(p, t->facet, 1),
                                             lrcsi_prepared_corner(p, t->facet, 2), x);
            h.fine[k] = t->view->facing[t->facet] > 0 ? up : lrcsi_dd_negate(up);
            h.err[k] = 128 * LRCSI_U * LRCSI_U * fabs(up.hi);
        }
        h.above[k] = (h.fine[k].hi > 0) - (h.fine[k].hi < 0);
        h.height[k] = lrcsi_dd_value(h.fine[k]);
    }
    return h;
}

/* Where the boundary of the facet, traversed counter-clockwise, crosses the target's plane:
   crossing[0] on the way down, crossing[1] on the way up. A corner on the plane is given by its
   index, a side that intersects it by SIDE plus its index. */
#define SIDE 3
static void contact_crossings(const contact_heights *h, int crossing[2])
{
    crossing[0] = crossing[1] = 0;
    for (int k = 0; k < 3; k++) {
        int before = h->above[(k + 2) % 3];
        int at = h->above[k];
        int next = h->above[(k + 1) % 3];
        if (at * next < 0) {
            crossing[at < 0] = SIDE + k;
        }
        if (at == 0 && (before > 0 || next < 0)) {
            crossing[0] = k;
        }
        if (at == 0 && (before < 0 || next > 0)) {
            crossing[1] = k;
        }
    }
}

/* Is the position error larger than about the width of the facet?
   Given: area, that of the facet. */
static int position_err_exceeds_width(const lrcsi_contact *c, double area)
{
    lrcsi_clip_polygon triangle;
    lrcsi_clip_triangle((const double(*)[2])c->corner, &triangle);
    return c->position_err > 0 && !(c->position_err * lrcsi_clip_box_perimeter(&triangle) < area);
}

/* --- in the frame along the view's axes ------------------------------------------------------- */

/* The point at which side k of the facet, whose ends lie on different sides of the target's plane,
   intersects that plane; returns its position error. It lies at parameter t = h / (h + h') of the
   side, counted from the nearer end. An error of h moves t by (1 - t) / (h + h') times it, an error
   of h' by t / (h + h') times it. The ends have errors of 10 u of their distances; the point then
   has 10 u of the distance interpolated at t, and its rounding error is less than 6 u of that. */
static double side_cut(const contact_heights *h, const lrcsi_contact *c, int k, double at[2],
                       double *reach)
{
    int next = (k + 1) % 3;
    int near = c->distance[k] <= c->distance[next] ? k : next;
    int far = near == k ? next : k;
    double span = fabs(h->height[k]) + fabs(h->height[next]);
    double t = lrcsi_min(1, fabs(h->height[near]) / span);
    for (int i = 0; i < 2; i++) {
        at[i] = c->corner[near][i] + t * (c->corner[far][i] - c->corner[near][i]);
    }
    *reach = (1 - t) * c->distance[near] + t * c->distance[far];
    double err = (1 - t) * h->err[near] + t * h->err[far];
    return 2 * (c->distance[k] + c->distance[next]) * (err / span);
}

/* The segment's part near the target, and its kind. The segment's ends, and the single corner that
   the plane separates from the other two, have errors of at most e: 16 u of their distances, and
   the position error.
   If that corner lies at least 4 e beyond the segment's line, the true line crosses the same two
   sides of the facet, within e of the ends, and divides the facet as the segment does: LINE.
   Otherwise the part of the facet that is cut off lies near the segment's line or, if the segment
   is so short that the direction of its line is uncertain, near the line from the segment to the
   corner. That distance is added to the position error, and the kind says where the rest of the
   facet lies: FRONT or BEHIND. The part cut off extends along the line as far as the corner, which
   may be far beyond the segment. Within 4 diameters of the target, the corner's error displaces it
   by no more than if the corner were at that distance. */
static int find_segment(const lrcsi_target *t, const contact_heights *h, lrcsi_contact *c,
                        int above)
{
    int crossing[2];
    double reach[2];
    contact_crossings(h, crossing);
    for (int i = 0; i < 2; i++) {
        if (crossing[i] >= SIDE) {
            double position_err = side_cut(h, c, crossing[i] - SIDE, c->end[i], &reach[i]);
            c->position_err = lrcsi_max(c->position_err, position_err);
        } else {
            memcpy(c->end[i], c->corner[crossing[i]], sizeof c->end[i]);
            reach[i] = c->distance[crossing[i]];
        }
    }
    c->reach = lrcsi_target_segment(t, c->end, reach);

    int single = above == 1 ? 1 : -1; /* the sign of the height of the single corner */
    int corner = h->above[0] == single ? 0 : h->above[1] == single ? 1 : 2;
    const double *p = c->corner[corner];
    double err = 16 * LRCSI_U * lrcsi_max(c->distance[corner], c->reach) + c->position_err;
    const double along[2] = {c->end[1][0] - c->end[0][0], c->end[1][1] - c->end[0][1]};
    double length = lrcsi_length_flat(along[0], along[1]);
    double twice = along[0] * (p[1] - c->end[0][1]) - along[1] * (p[0] - c->end[0][0]);
    double beyond = length > 0 ? single * twice / length : 0;
    lrcsi_clip_polygon triangle;
    lrcsi_clip_triangle((const double(*)[2])c->corner, &triangle);
    if (position_err_exceeds_width(c, lrcsi_clip_area(&triangle))) {
        return LRCSI_CONTACT_UNKNOWN;
    }
    if (beyond > 4 * err) {
        return LRCSI_CONTACT_LINE;
    }
    if (length > 4 * err) {
        double distance = lrcsi_min(c->distance[corner], c->reach + 4 * t->diameter);
        c->position_err += fabs(beyond) + 16 * LRCSI_U * distance;
    } else {
        c->position_err += length;
        memcpy(c->end[1], p, sizeof c->end[1]);
        c->reach = lrcsi_max(c->reach, c->distance[corner]);
    }
    return single > 0 ? LRCSI_CONTACT_BEHIND : LRCSI_CONTACT_FRONT;
}

/* --- in a needle ------------------------------------------------------------------------------ */

/* A facet in a needle's frame: its corners, and the segment's ends. */
typedef struct contact_dd {
    lrcsi_dd corner[3][2];
    lrcsi_dd end[2][2];
} contact_dd;

/* As side_cut, with the parameter in double-double (errors: visibility/cells/target.c). */
static double side_cut_dd(const contact_heights *h, const contact_dd *f, int k, lrcsi_dd at[2])
{
    int next = (k + 1) % 3;
    double span = fabs(h->height[k]) + fabs(h->height[next]);
    double err = h->err[k] + h->err[next];
    double length = 0;
    lrcsi_dd t = lrcsi_dd_div(h->fine[k], lrcsi_dd_sub(h->fine[k], h->fine[next]));
    for (int i = 0; i < 2; i++) {
        lrcsi_dd along = lrcsi_dd_sub(f->corner[next][i], f->corner[k][i]);
        at[i] = lrcsi_dd_add(f->corner[k][i], lrcsi_dd_mul(t, along));
        length += fabs(along.hi);
    }
    return 2 * length * (err / span);
}

/* Twice the signed area of the triangle with these two sides. */
static double cross_dd(const lrcsi_dd a[2], const lrcsi_dd b[2])
{
    return lrcsi_dd_value(lrcsi_dd_sub(lrcsi_dd_mul(a[0], b[1]), lrcsi_dd_mul(a[1], b[0])));
}

/* The ends of the whole segment. If it is so short that clipping will not shorten it, they are
   rounded, and 1 is returned. The rounded segment then divides the facet: rounding may change the
   direction of its line. */
static int ends_dd(const contact_heights *h, contact_dd *f, lrcsi_contact *c)
{
    int crossing[2];
    int is_short = 1;
    contact_crossings(h, crossing);
    for (int i = 0; i < 2; i++) {
        if (crossing[i] >= SIDE) {
            double position_err = side_cut_dd(h, f, crossing[i] - SIDE, f->end[i]);
            c->position_err = lrcsi_max(c->position_err, position_err);
        } else {
            memcpy(f->end[i], f->corner[crossing[i]], sizeof f->end[i]);
        }
    }
    for (int i = 0; i < 2; i++) {
        is_short &= fabs(f->end[1][i].hi - f->end[0][i].hi) < 0.5;
    }
    for (int i = 0; i < 4 && is_short; i++) {
        f->end[i / 2][i % 2] = (lrcsi_dd){lrcsi_dd_value(f->end[i / 2][i % 2]), 0};
    }
    return is_short;
}

/* As find_segment. The segment is clipped only afterwards: with errors e of its ends and of the
   corner, its direction has an error of 2 e over its length, and the corner's distance from its
   line an error of 2 e plus that angle times the distance to the corner. `direction_err` is this
   second term. The facet's area is computed in double-double, because it may be a needle too. */
static int find_segment_dd(const contact_heights *h, contact_dd *f, lrcsi_contact *c, int above)
{
    int is_short = ends_dd(h, f, c);
    int single = above == 1 ? 1 : -1;
    const lrcsi_dd *p = f->corner[h->above[0] == single ? 0 : h->above[1] == single ? 1 : 2];
    lrcsi_dd along[2];
    lrcsi_dd to_corner[2];
    lrcsi_dd side[2][2];
    for (int i = 0; i < 2; i++) {
        along[i] = lrcsi_dd_sub(f->end[1][i], f->end[0][i]);
        to_corner[i] = lrcsi_dd_sub(p[i], f->end[0][i]);
        side[0][i] = lrcsi_dd_sub(f->corner[1][i], f->corner[0][i]);
        side[1][i] = lrcsi_dd_sub(f->corner[2][i], f->corner[0][i]);
    }
    double err = c->corner_err + 16 * LRCSI_U + c->position_err;
    double length = lrcsi_length_flat(along[0].hi, along[1].hi);
    double beyond = length > 0 ? single * cross_dd(along, to_corner) / length : 0;
    double far = lrcsi_length_flat(to_corner[0].hi, to_corner[1].hi);
    double direction_err = is_short ? 0 : 4 * far / length * (c->corner_err + c->position_err);
    int kind = LRCSI_CONTACT_LINE;
    if (!(beyond > 4 * err + direction_err)) {
        kind = single > 0 ? LRCSI_CONTACT_BEHIND : LRCSI_CONTACT_FRONT;
        if (length > 4 * err) {
            c->position_err += fabs(beyond) + direction_err;
        } else {
            c->position_err += length;
            memcpy(f->end[1], p, sizeof f->end[1]);
        }
    }
    lrcsi_dd interval[2];
    lrcsi_needle_clip((const lrcsi_dd *)f->end[0], (const lrcsi_dd *)f->end[1], c->end, interval);
    return position_err_exceeds_width(c, 0.5 * cross_dd(side[0], side[1])) ? LRCSI_CONTACT_UNKNOWN
                                                                           : kind;
}

/* --- either ----------------------------------------------------------------------------------- */

int lrcsi_contact_find(const lrcsi_target *t, uint32_t other, lrcsi_contact *c)
{
    const double *const corner[3] = {lrcsi_target_frame_corner(t->view, other, 0),
                                     lrcsi_target_frame_corner(t->view, other, 1),
                                     lrcsi_target_frame_corner(t->view, other, 2)};
    contact_heights h = heights_of(t, corner);
    contact_dd f = {0};
    int above = 0;
    int below = 0;
    *c = (lrcsi_contact){.position_err = 0};
    for (int k = 0; k < 3; k++) {
        const double *x = corner[k];
        above += h.above[k] > 0;
        below += h.above[k] < 0;
        if (!t->needle) {
            c->distance[k] = lrcsi_target_coordinates(t, x, c->corner[k]);
            continue;
        }
        double corner_err = lrcsi_needle_coordinates(t->needle, x, f.corner[k]);
        c->corner_err = lrcsi_max(c->corner_err, corner_err);
        c->corner[k][0] = lrcsi_dd_value(f.corner[k][0]);
        c->corner[k][1] = lrcsi_dd_value(f.corner[k][1]);
    }
    int on = 3 - above - below;
    if (on == 3) {
        return LRCSI_CONTACT_FLAT;
    }
    if (on < 2 && (above == 0 || below == 0)) {
        return LRCSI_CONTACT_POINT;
    }
    return t->needle ? find_segment_dd(&h, &f, c, above) : find_segment(t, &h, c, above);
}
