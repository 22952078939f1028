/* SPDX-License-Identifier: MIT */
/* Finds the sides of sectors, and integrates over their margins: by Gauss-Legendre rules along the
   side and across it, of which the remainders are proved (integrate/wall/mean_rule.h). */
#include "integrate/wall/round_sector.h"

#include <math.h>

#include "base/elementary.h"
#include "base/length.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/vec3.h"
#include "integrate/wall/mean_rule.h"
#include "integrate/wall/patch.h"
#include "scene/neighbours.h"

/* A margin is divided into at most so many pieces. Its remainder should be this small, compared
   with a bound on its integral; with that many pieces a larger one is accepted: an error of a
   margin is small compared with that of leaving its sector out. */
#define MARGIN_PIECES_MAX    32
#define MARGIN_TARGET        1e-6
#define MARGIN_REMAINDER_MAX 0x1p-6
/* The rules along a piece of a margin and across it. */
#define MARGIN_RULE_ALONG  (LRCSI_MEAN_RULES - 2)
#define MARGIN_RULE_ACROSS 1
/* The least cosine of the incidence angle in the middle of a piece. */
#define MIN_COSINE 0.0211

const lrcsi_round_range lrcsi_round_whole_side = {-1, 1};
const double lrcsi_round_ratios[LRCSI_ROUND_RATIOS] = {1.5, 2.5, 4.0, 7.0, 12.0, 24.0};

lrcsi_round_wall lrcsi_round_wall_make(const lrcsi_view *view, const lrcsi_plan *plan,
                                       uint32_t part, int side)
{
    const lrcs_prepared *p = view->prepared;
    const lrcs_part *placed = &p->scene->part[part];
    return (lrcsi_round_wall){
        .view = view,
        .part = part,
        .surface = lrcsi_round_surface_make(view, part, side),
        .body = lrcsi_revolution_make(&placed->shape, &placed->divisions),
        .unit = ldexp(placed->unit, -p->exponent),
        .brdf = lrcsi_plan_brdf(plan, lrcsi_prepared_material(p, placed->first_facet))};
}

void lrcsi_round_sum_add(const lrcsi_round_wall *wall, double area, const lrcsi_round_value *value,
                         lrcsi_round_sum *sum)
{
    sum->glint += area * value->glint;
    sum->diffuse += area * value->diffuse;
    sum->rounding += fabs(area) * (value->error + 32 * LRCSI_U * (value->glint + value->diffuse)) +
                     LRCSI_U * (fabs(sum->glint) + fabs(sum->diffuse)); /* of the additions */
    if (wall->derivatives) {
        sum->glint_u += area * value->glint * value->u;
        sum->diffuse_log += area * value->diffuse * lrcsi_log1p(value->u).hi;
    }
}

void lrcsi_round_sum_append(const lrcsi_round_sum *sum, double sign, lrcsi_round_sum *to)
{
    to->glint += sign * sum->glint;
    to->diffuse += sign * sum->diffuse;
    to->glint_u += sign * sum->glint_u;
    to->diffuse_log += sign * sum->diffuse_log;
    to->rounding += sum->rounding + LRCSI_U * (fabs(to->glint) + fabs(to->diffuse));
    to->remainder += sum->remainder;
}

/* --- margins ---------------------------------------------------------------------------------- */

/* A point of the arc, and its derivative with respect to t. On the meridian of a sphere or dome the
   polar angle is linear in t, on that of a paraboloid the radius. */
static void side_arc(const lrcsi_round_wall *wall, const lrcsi_round_side *side, double t,
                     double x[2], double dx[2])
{
    const lrcsi_round_surface *s = &wall->surface;
    double rho = side->rho;
    double z = side->z;
    double phi = side->azimuth;
    double d_rho = 0;
    double dz = 0;
    double d_phi = 0;
    if (side->is_row) {
        phi += t * side->half;
        d_phi = side->half;
    } else if (s->alpha == 0) {
        rho += t * side->half;
        d_rho = side->half;
        z = -(rho * rho + s->gamma) / (2 * s->beta);
        dz = -rho * d_rho / s->beta;
    } else {
        double radius = sqrt(-s->gamma);
        double polar = side->polar + t * side->half;
        rho = radius * sin(polar);
        z = radius * cos(polar);
        d_rho = z * side->half;
        dz = -rho * side->half;
    }
    const double X[3] = {rho * cos(phi), rho * sin(phi), z};
    const double dX[3] = {d_rho * cos(phi) - rho * sin(phi) * d_phi,
                          d_rho * sin(phi) + rho * cos(phi) * d_phi, dz};
    for (int k = 0; k < 2; k++) {
        x[k] = s->view[k] + lrcsi_vec3_dot(X, s->axis[k]);
        dx[k] = lrcsi_vec3_dot(dX, s->axis[k]);
    }
}

/* Bounds, for complex |t - middle| <= r, on how far the arc and its derivative are from their
   linear functions about the middle. On a circle these are radius (e^x - 1 - x) and radius h (e^x -
   1) with x = h r, at most x^2 / 2 e^x and x e^x; on the parabola the second derivative is
   constant. */
static double side_bend(const lrcsi_round_wall *wall, const lrcsi_round_side *side, double r,
                        double *slope)
{
    const lrcsi_round_surface *s = &wall->surface;
    double h = fabs(side->half);
    if (!side->is_row && s->alpha == 0) {
        double second = h * h / s->beta;
        *slope = second * r * LRCSI_OUTWARD_NANO;
        return 0.5 * second * r * r * LRCSI_OUTWARD_NANO;
    }
    double radius = side->is_row ? side->rho : sqrt(-s->gamma);
    double grown = radius * lrcsi_exp(h * r) * LRCSI_OUTWARD_NANO;
    *slope = h * h * r * grown;
    return 0.5 * (h * r) * (h * r) * grown;
}

/* A piece of a margin, for t in middle - half .. middle + half: its chord c + t' step, t' in -1 ..
   1, how far the arc is from it and the difference of their derivatives in the middle. */
typedef struct margin_piece {
    double middle, half;
    double chord[2], step[2];
    double apart, turned, length; /* the last is |step| */
    lrcsi_round_point centre;
} margin_piece;

/* Makes a piece, except for its centre. */
static margin_piece margin_piece_make(const lrcsi_round_wall *wall, const lrcsi_round_side *side,
                                      double middle, double half)
{
    const double turn = side->sign * half;
    double a[2];
    double da[2];
    margin_piece piece = {.middle = middle, .half = half};
    for (int k = 0; k < 2; k++) {
        piece.chord[k] = side->chord[k] + middle * side->step[k];
        piece.step[k] = half * side->step[k];
    }
    side_arc(wall, side, side->sign * middle, a, da);
    piece.apart = lrcsi_length_flat(a[0] - piece.chord[0], a[1] - piece.chord[1]);
    piece.turned = lrcsi_length_flat(turn * da[0] - piece.step[0], turn * da[1] - piece.step[1]);
    piece.length = lrcsi_length_flat(piece.step[0], piece.step[1]);
    return piece;
}

/* Bounds on the distance between arc and chord, and on the difference of their derivatives, for
   parameters up to r times as far from the middle. */
static void margin_bend(const lrcsi_round_wall *wall, const lrcsi_round_side *side,
                        const margin_piece *piece, double r, double *width, double *slope)
{
    double bend = side_bend(wall, side, r * piece->half, slope);
    *width =
        (piece->apart + piece->turned * r + bend) * LRCSI_OUTWARD_NANO + wall->surface.position_err;
    *slope = (piece->turned + *slope * piece->half) * LRCSI_OUTWARD_NANO;
}

/* G_max for such parameters, and up to `out` times as far from the chord as the arc; and the
   extent. */
static double margin_bound(const lrcsi_round_wall *wall, const lrcsi_round_side *side,
                           const margin_piece *piece, double r, double out, double *width,
                           double *slope)
{
    margin_bend(wall, side, piece, r, width, slope);
    return lrcsi_round_bound(&wall->surface, &wall->brdf, &piece->centre,
                             r * piece->length + out * *width);
}

/* The remainder of the rules along and across a piece of a margin. */
static double margin_remainder(const lrcsi_round_wall *wall, const lrcsi_round_side *side,
                               const margin_piece *piece)
{
    double along[LRCSI_MEAN_RULES]; /* complex t, real s */
    double across[LRCSI_MEAN_RULES];
    double width;
    double slope;
    for (int n = 0; n < LRCSI_MEAN_RULES; n++) {
        along[n] = across[n] = HUGE_VAL;
    }
    for (int i = 0; i < LRCSI_ROUND_RATIOS; i++) {
        const double r = lrcsi_round_ratios[i];
        double m = margin_bound(wall, side, piece, r, 1, &width, &slope);
        lrcsi_mean_rule_bound(2 * m * (piece->length + slope) * width, r, along);
        m = margin_bound(wall, side, piece, 1, 1 + r, &width, &slope);
        lrcsi_mean_rule_bound(2 * m * (piece->length + (1 + r) * slope) * width, r, across);
    }
    return (along[MARGIN_RULE_ALONG] + across[MARGIN_RULE_ACROSS]) * LRCSI_OUTWARD_NANO;
}

/* Adds the integral over a piece of a margin. */
static void margin_add(const lrcsi_round_wall *wall, const lrcsi_round_side *side,
                       const margin_piece *piece, const lrcsi_mean_rule *along,
                       const lrcsi_mean_rule *across, lrcsi_round_sum *sum)
{
    double t[LRCSI_MEAN_RULE_POINTS];
    double s[LRCSI_MEAN_RULE_POINTS];
    double t_weight[LRCSI_MEAN_RULE_POINTS];
    double s_weight[LRCSI_MEAN_RULE_POINTS];
    int count = lrcsi_mean_rule_points(along, t, t_weight);
    int rows = lrcsi_mean_rule_points(across, s, s_weight);
    for (int i = 0; i < count; i++) {
        double a[2];
        double da[2];
        side_arc(wall, side, side->sign * (piece->middle + t[i] * piece->half), a, da);
        const double chord[2] = {piece->chord[0] + t[i] * piece->step[0],
                                 piece->chord[1] + t[i] * piece->step[1]};
        const double out[2] = {a[0] - chord[0], a[1] - chord[1]};
        for (int k = 0; k < rows; k++) {
            double at = 0.5 * (1 + s[k]);
            const double v[2] = {chord[0] + at * out[0] - piece->centre.x[0],
                                 chord[1] + at * out[1] - piece->centre.x[1]};
            const double turn = at * side->sign * piece->half;
            const double tangent[2] = {(1 - at) * piece->step[0] + turn * da[0],
                                       (1 - at) * piece->step[1] + turn * da[1]};
            double area =
                2 * t_weight[i] * s_weight[k] * (out[0] * tangent[1] - out[1] * tangent[0]);
            lrcsi_round_value value =
                lrcsi_round_value_make(&wall->surface, &wall->brdf, &piece->centre, v);
            lrcsi_round_sum_add(wall, area, &value, sum);
        }
    }
}

/* The length times which the area of a margin has an error of position. The ends of the chord have
   errors of vertex_err together, points of the arc less than position_err (which exceeds the errors
   of their sines, cosines and products). So both borders are displaced by at most these, which
   changes the area, and the size of the area elements, each by at most the length times twice their
   sum; 8 is twice as much as these together. */
static double margin_position_err(const lrcsi_round_wall *wall, const lrcsi_round_side *side)
{
    return 8 * (wall->surface.position_err +
                lrcsi_view_point_err(wall->view->point[side->vertex[0]].x) +
                lrcsi_view_point_err(wall->view->point[side->vertex[1]].x));
}

void lrcsi_round_margin_extent(const lrcsi_round_wall *wall, const lrcsi_round_side *side,
                               lrcsi_round_range range, lrcsi_round_margin *margin)
{
    const margin_piece all =
        margin_piece_make(wall, side, 0.5 * (range.from + range.to), 0.5 * (range.to - range.from));
    double slope;
    *margin = (lrcsi_round_margin){.largest = 0};
    margin_bend(wall, side, &all, 1, &margin->width, &slope);
    margin->area = (all.length + slope) * LRCSI_OUTWARD_NANO *
                   (2 * margin->width + margin_position_err(wall, side));
}

/* A piece of a margin that is divided evenly, with its centre. Returns 0 if that is not known, or
   steep. */
static int margin_piece_place(const lrcsi_round_wall *wall, const lrcsi_round_side *side,
                              lrcsi_round_range range, int index, int pieces, margin_piece *piece)
{
    const double half = 0.5 * (range.to - range.from) / pieces;
    *piece = margin_piece_make(wall, side, range.from + (2.0 * index + 1) * half, half);
    return lrcsi_round_point_make(&wall->surface, piece->chord, &piece->centre) &&
           piece->centre.s >= MIN_COSINE * piece->centre.length;
}

/* The margin is divided until the remainder is small compared with its size.

   Inclination. Where G_max is finite over a piece, w = 1 / cos^2 is there at most 1.5 times its
   value at the centre (integrate/wall/round_surface.h): with a cosine of 0.0211 or more
   there, w < 3370 and tan < 58.1. */
int lrcsi_round_margin_bounds(const lrcsi_round_wall *wall, const lrcsi_round_side *side,
                              lrcsi_round_range range, lrcsi_round_margin *margin)
{
    const double position_err = margin_position_err(wall, side);
    for (int n = 1; n <= MARGIN_PIECES_MAX; n *= 2) {
        lrcsi_round_sum *sum = &margin->sum;
        lrcsi_round_margin_extent(wall, side, range, margin);
        margin->pieces = n;
        for (int i = 0; i < n && sum->remainder < HUGE_VAL; i++) {
            double width = 0;
            double slope = 0;
            margin_piece piece;
            if (!margin_piece_place(wall, side, range, i, n, &piece)) {
                margin->largest = HUGE_VAL;
                return 0;
            }
            double bound = margin_bound(wall, side, &piece, 1, 1, &width, &slope);
            double size = bound * (piece.length + slope) * LRCSI_OUTWARD_NANO;
            margin->largest += 2 * size * width;
            sum->remainder += margin_remainder(wall, side, &piece);
            sum->rounding += size * position_err; /* of the positions of both borders */
        }
        const double most = n < MARGIN_PIECES_MAX ? MARGIN_TARGET : MARGIN_REMAINDER_MAX;
        if (sum->remainder <= most * margin->largest && isfinite(sum->rounding + margin->largest)) {
            return 1;
        }
    }
    margin->largest = HUGE_VAL;
    return 0;
}

int lrcsi_round_margin_make(const lrcsi_round_wall *wall, const lrcsi_round_side *side,
                            lrcsi_round_range range, lrcsi_round_margin *margin)
{
    const int known = lrcsi_round_margin_bounds(wall, side, range, margin);
    for (int i = 0; i < margin->pieces && known; i++) {
        margin_piece piece;
        (void)margin_piece_place(wall, side, range, i, margin->pieces, &piece); /* as above */
        margin_add(wall, side, &piece, &lrcsi_mean_rules[MARGIN_RULE_ALONG],
                   &lrcsi_mean_rules[MARGIN_RULE_ACROSS], &margin->sum);
    }
    return known && isfinite(margin->sum.rounding + margin->sum.glint + margin->sum.diffuse);
}

/* --- sectors ---------------------------------------------------------------------------------- */

/* The vertex of the sector's facets that stands for a corner of its patch. */
static uint32_t corner_vertex(const lrcsi_round_wall *wall, const lrcsi_round_sector *sector,
                              double rho, double z, double azimuth)
{
    const lrcsi_round_surface *s = &wall->surface;
    const lrcs_scene *scene = wall->view->prepared->scene;
    const double X[3] = {rho * cos(azimuth), rho * sin(azimuth), z};
    uint32_t nearest = LRCS_NONE;
    double least = HUGE_VAL;
    for (int i = 0; i < 3 * sector->facets; i++) {
        uint32_t vertex = scene->facet[sector->facet[i / 3]].corner[i % 3];
        double distance = 0;
        for (int k = 0; k < 3; k++) {
            double at = (k == 2 ? s->side : 1) * wall->view->point[vertex].x[k];
            double x = s->view[k] + lrcsi_vec3_dot(X, s->axis[k]) - at;
            distance += x * x;
        }
        if (distance < least) {
            least = distance;
            nearest = vertex;
        }
    }
    return nearest;
}

/* Finds which facet of the sector has a side, and the facet across it. Returns 0 if there is no
   such side. */
static int side_find(const lrcsi_round_wall *wall, const lrcsi_round_sector *sector,
                     lrcsi_round_side *side)
{
    const lrcs_prepared *p = wall->view->prepared;
    const uint32_t *vertex = side->vertex;
    for (int i = 0; i < 3 * sector->facets; i++) {
        uint32_t f = sector->facet[i / 3];
        uint32_t a = p->scene->facet[f].corner[i % 3];
        uint32_t b = p->scene->facet[f].corner[(i + 1) % 3];
        if ((a == vertex[0] && b == vertex[1]) || (a == vertex[1] && b == vertex[0])) {
            side->neighbour = lrcsi_neighbour_in_part(p, f, i % 3);
            side->facet = f;
            side->corner = i % 3;
            return 1;
        }
    }
    return 0;
}

/* The corners of a sector's patch in the order of its border: the row above, and the azimuth after,
   the first one of the sector. */
static const int corner_row[4] = {0, 0, 1, 1};
static const int corner_azimuth[4] = {0, 1, 1, 0};

/* The side of a sector from one of these corners to the next. `at`: the sector's position. */
static lrcsi_round_side side_make(const lrcsi_round_wall *wall, const lrcsi_wall_patch *at,
                                  int number)
{
    const lrcsi_revolution *body = &wall->body;
    const double unit = wall->unit;
    const int is_row = number % 2 == 0;
    const uint32_t row = at->row + (uint32_t)(number == 2);
    const double below = lrcsi_revolution_radius(body, at->row) * unit;
    const double above = lrcsi_revolution_radius(body, at->row + 1) * unit;
    const double polar[2] = {lrcsi_revolution_polar(body, at->row),
                             lrcsi_revolution_polar(body, at->row + 1)};
    lrcsi_round_side side = {.is_row = is_row, .sign = number < 2 ? 1 : -1};
    if (is_row) {
        side.rho = lrcsi_revolution_radius(body, row) * unit;
        side.z = (at->mirrored ? -1 : 1) * lrcsi_revolution_height(body, row) * unit;
        side.azimuth = (2.0 * at->sector + 1.0) * body->half;
        side.half = body->half;
    } else {
        side.rho = 0.5 * (below + above);
        side.azimuth = 2.0 * ((double)at->sector + (number == 1)) * body->half;
        side.polar = 0.5 * (polar[0] + polar[1]);
        side.half = 0.5 * (wall->surface.alpha == 0 ? above - below : polar[1] - polar[0]);
        if (at->mirrored) { /* the other half of a sphere */
            side.polar = LRCS_PI - side.polar;
            side.half = -side.half;
        }
    }
    return side;
}

int lrcsi_round_sector_make(const lrcsi_round_wall *wall, uint32_t facet,
                            lrcsi_round_sector *sector)
{
    const lrcs_prepared *p = wall->view->prepared;
    const lrcs_part *part = wall->surface.part;
    lrcsi_wall_patch at;
    uint32_t vertex[4];
    double turning = 0; /* positive if the corners run counter-clockwise in the view */
    if (!lrcsi_tessellate_patch(&part->shape, &part->divisions, facet - part->first_facet, &at)) {
        return 0;
    }
    sector->facets = (int)at.facets;
    sector->facet[0] = at.facets == 2 ? lrcsi_patch_sector(p, facet) : facet;
    sector->facet[1] = at.facets == 2 ? sector->facet[0] + 1 : facet;
    for (int i = 0; i < 4; i++) {
        uint32_t row = at.row + (uint32_t)corner_row[i];
        double z = (at.mirrored ? -1 : 1) * lrcsi_revolution_height(&wall->body, row) * wall->unit;
        double azimuth = 2.0 * ((double)at.sector + corner_azimuth[i]) * wall->body.half;
        vertex[i] = corner_vertex(
            wall, sector, lrcsi_revolution_radius(&wall->body, row) * wall->unit, z, azimuth);
    }
    if (vertex[0] == vertex[1] || vertex[0] == vertex[2] || vertex[0] == vertex[3] ||
        vertex[1] == vertex[2] || vertex[1] == vertex[3] ||
        (vertex[2] == vertex[3]) != (at.facets == 1)) {
        return 0;
    }
    for (int i = 0; i < 4; i++) {
        turning += lrcsi_vec2_cross(wall->view->point[vertex[i]].x,
                                    wall->view->point[vertex[(i + 1) % 4]].x);
    }
    sector->sides = 0;
    for (int i = 0; i < 4; i++) {
        if (i == 2 && at.facets == 1) { /* the apex */
            continue;
        }
        lrcsi_round_side side = side_make(wall, &at, i);
        side.vertex[0] = vertex[turning > 0 ? i : (i + 1) % 4];
        side.vertex[1] = vertex[turning > 0 ? (i + 1) % 4 : i];
        side.sign = turning > 0 ? side.sign : -side.sign;
        for (int k = 0; k < 2; k++) {
            const double a = wall->view->point[side.vertex[0]].x[k];
            const double b = wall->view->point[side.vertex[1]].x[k];
            side.chord[k] = 0.5 * (a + b);
            side.step[k] = 0.5 * (b - a);
        }
        if (!side_find(wall, sector, &side)) {
            return 0;
        }
        sector->side[sector->sides++] = side;
    }
    return 1;
}
