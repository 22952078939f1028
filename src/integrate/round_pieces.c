/* SPDX-License-Identifier: MIT */
/* Integrates over visible pieces, and over margins at the borders of sets of sectors. Used are the
   sectors of which a facet is partly visible, if the surface above their facets faces the laser
   everywhere, and G is smooth enough for the rules there. */
#include "integrate/round_pieces.h"

#include <math.h>

#include "base/elementary.h"
#include "base/length.h"
#include "base/range.h"
#include "base/vec3.h"
#include "base/work.h"
#include "integrate/gauss.h"
#include "integrate/patch.h"
#include "integrate/patch_visibility.h"
#include "integrate/round_surface.h"
#include "mesh/shape/revolution.h"
#include "optics/reflect.h"

/* The remainder that a rule should have, relative to G: this times the tolerance, but within these
   limits. */
#define TOLERANCE_FRACTION 0x1p-7
#define REMAINDER_LOW      0x1p-40
#define REMAINDER_HIGH     0x1p-12
/* A sector is not used if the remainder is larger than this, relative to G. */
#define REMAINDER_MAX 0x1p-10
/* A triangle is divided into at most the square of this number. */
#define DIVISIONS_MAX 8
/* A margin is divided into at most so many parts. Its remainder should be this small, compared with
   a bound on its integral. */
#define MARGIN_PARTS_MAX 8
#define MARGIN_TARGET    1e-6
/* The largest distance of a facet from the true surface along d, as a multiple of its part's reach;
   the least cosine of a facet, and the largest turn of normals over a patch. The surface is then
   inclined by at most arccos(0.25) + 0.12 rad, with a tangent below 8: above a margin, which is at
   most 2 reaches wide, it is within 12 + 2 (1 + 8) = 30 reaches of the facet
   (visibility/proximity_band.h, 11). */
#define MAX_REACHES 12.0
#define MIN_COSINE  0.25
#define MAX_TURN    0.12
/* Covers the roundings of sums of positive terms. */
#define ROUNDED_UP (1 + 1e-9)

/* Ratios of e to the largest |v| (integrate/round_surface.h) for which M is computed. */
static const double ratios[] = {1.5, 2.5, 4.0, 7.0, 12.0, 24.0};
#define RATIOS ((int)(sizeof ratios / sizeof *ratios))

typedef struct pieces_job {
    const lrcsi_view *view;
    const lrcsi_plan *plan;
    const lrcsi_proximity_band *band;
    const lrcsi_visible *visible;
    lrcsi_round_surface surface; /* of the current part */
    lrcsi_revolution body;
    double unit; /* scaled length of a unit of the shape */
    lrcs_brdf brdf;
    double target; /* the relative remainder that rules should have */
} pieces_job;

/* A sum of integrals of G. */
typedef struct pieces_sum {
    double glint, diffuse, rounding, remainder;
} pieces_sum;

/* --- triangles -------------------------------------------------------------------------------- */

/* The rule over triangles: coordinates r, s in 0 .. 1 of a Gauss-Legendre rule of n points each;
   the point c + r ((a - c) + s (b - a)) has the weight r. Exact up to degree 2 n - 2. */
typedef struct triangle_rule {
    const lrcsi_gauss_rule *rule;
    double remainder; /* of G, per unit of area */
} triangle_rule;

/* The rule with the fewest points whose remainder is at most `target`, or else the best one. Given:
   the triangle's centre, and the largest distance of its points from there. */
static triangle_rule triangle_rule_choose(const pieces_job *job, const lrcsi_round_point *centre,
                                          double radius, double target)
{
    double best[LRCSI_GAUSS_RULES];
    for (int n = 0; n < LRCSI_GAUSS_RULES; n++) {
        best[n] = HUGE_VAL;
    }
    for (int i = 0; i < RATIOS; i++) {
        double bound = lrcsi_round_bound(&job->surface, &job->brdf, centre, ratios[i] * radius);
        double q = 1 / ratios[i];
        if (!(bound < HUGE_VAL)) {
            break;
        }
        bound *= 2 * q / (1 - q);
        for (int n = 0, degree = 0; n < LRCSI_GAUSS_RULES; n++) {
            for (; degree < 2 * lrcsi_gauss_rules[n].points - 2; degree++) {
                bound *= q;
            }
            best[n] = lrcsi_min(best[n], bound);
        }
    }
    int n = 0;
    while (n + 1 < LRCSI_GAUSS_RULES && !(best[n] <= target)) {
        n++;
    }
    return (triangle_rule){&lrcsi_gauss_rules[n], best[n] * ROUNDED_UP};
}

/* Adds the integral of G over the triangle `corner`, of the given area, to a sum. */
static void triangle_add(const pieces_job *job, const lrcsi_round_point *centre,
                         const double corner[3][2], double area, const lrcsi_gauss_rule *rule,
                         pieces_sum *sum)
{
    double x[LRCSI_GAUSS_POINTS_MAX];
    double weight[LRCSI_GAUSS_POINTS_MAX];
    int count = lrcsi_gauss_points(rule, x, weight);
    for (int i = 0; i < count; i++) {
        double r = 0.5 * (1 + x[i]);
        for (int j = 0; j < count; j++) {
            double s = 0.5 * (1 + x[j]);
            double v[2];
            for (int k = 0; k < 2; k++) {
                v[k] = corner[0][k] - centre->x[k] +
                       r * ((corner[1][k] - corner[0][k]) + s * (corner[2][k] - corner[1][k]));
            }
            lrcsi_round_value at = lrcsi_round_value_make(&job->surface, &job->brdf, centre, v);
            double part = area * (2 * r * weight[i] * weight[j]);
            sum->glint += part * at.glint;
            sum->diffuse += part * at.diffuse;
            sum->rounding += part * (at.error + 32 * LRCSI_U * (at.glint + at.diffuse));
        }
    }
}

/* The wall's point above the centre of a triangle, and the largest distance of the triangle's
   points from there. Returns 0 if there is none. */
static int triangle_centre(const pieces_job *job, const double corner[3][2],
                           lrcsi_round_point *centre, double *radius)
{
    double at[2];
    for (int k = 0; k < 2; k++) {
        at[k] = corner[0][k] + ((corner[1][k] - corner[0][k]) + (corner[2][k] - corner[0][k])) / 3;
    }
    *radius = 0;
    for (int i = 0; i < 3; i++) {
        *radius = lrcsi_max(*radius, lrcsi_length_flat(corner[i][0] - at[0], corner[i][1] - at[1]));
    }
    *radius *= ROUNDED_UP;
    return lrcsi_round_point_make(&job->surface, at, centre);
}

/* Corner of sub-triangle number i of n x n. */
static void triangle_part(const double corner[3][2], int n, int i, double part[3][2])
{
    int row = 0;
    while ((row + 1) * (row + 1) <= i) {
        row++;
    }
    int at = i - row * row; /* 0 .. 2 row: even ones have the same orientation */
    int a = at / 2;
    int odd = at % 2;
    const int node[2][3][2] = {{{row, a}, {row + 1, a}, {row + 1, a + 1}},
                               {{row, a}, {row + 1, a + 1}, {row, a + 1}}};
    for (int k = 0; k < 3; k++) {
        double r = (double)node[odd][k][0] / n;
        double s = (double)node[odd][k][1] / n;
        for (int j = 0; j < 2; j++) {
            part[k][j] = corner[0][j] + r * (corner[1][j] - corner[0][j]) +
                         s * (corner[2][j] - corner[1][j]);
        }
    }
}

/* Adds the integral over a triangle with a counter-clockwise area, divided if that is necessary for
   a small remainder. Returns 0 if the remainder is too large, or the surface not known. */
static int triangle_integrate(const pieces_job *job, const double corner[3][2], double area,
                              pieces_sum *sum)
{
    for (int n = 1; n <= DIVISIONS_MAX; n *= 2) {
        pieces_sum all = {0, 0, 0, 0};
        int fine = 1;
        for (int i = 0; i < n * n && fine; i++) {
            double part[3][2];
            lrcsi_round_point point;
            double radius;
            triangle_part(corner, n, i, part);
            if (!triangle_centre(job, (const double(*)[2])part, &point, &radius)) {
                return 0;
            }
            const double here[2] = {0, 0};
            lrcsi_round_value at = lrcsi_round_value_make(&job->surface, &job->brdf, &point, here);
            double scale = at.glint + at.diffuse;
            triangle_rule rule = triangle_rule_choose(job, &point, radius, job->target * scale);
            fine = rule.remainder <= (n < DIVISIONS_MAX ? 4 * job->target : REMAINDER_MAX) * scale;
            if (fine) {
                triangle_add(job, &point, (const double(*)[2])part, area / (n * n), rule.rule,
                             &all);
                all.remainder += area / (n * n) * rule.remainder;
            }
        }
        if (fine && isfinite(all.glint + all.diffuse + all.rounding + all.remainder)) {
            sum->glint += all.glint;
            sum->diffuse += all.diffuse;
            sum->rounding += all.rounding;
            sum->remainder += all.remainder;
            return 1;
        }
    }
    return 0;
}

/* --- facets ----------------------------------------------------------------------------------- */

/* The largest distance of a facet from the true surface along d is MAX_REACHES times its part's
   reach (visibility/proximity_band.h, 11). */
#define MAX_REACHES 12.0
#define MIN_COSINE  0.25
#define MAX_TURN    0.12

/* A bound on G above a facet; infinite if the surface is not known, or too far away. Because the
   wall is convex, its height along d is a concave function on the view plane: it lies between its
   linear interpolation over the corners, and its tangent plane at the centre. So its distance from
   the facet is at most the largest distance of either from the facet's corners. The normals above a
   facet turn from its own by at most `turn` on its own patch, and by no more than twice that on
   those next to it. */
static double facet_bound(const pieces_job *job, uint32_t facet)
{
    const lrcs_prepared *p = job->view->prepared;
    const lrcsi_round_surface *surface = &job->surface;
    const uint32_t *corner = p->scene->facet[facet].corner;
    double at[3][2];
    double apart = 0;
    const lrcsi_incidence incidence = lrcsi_view_incidence(job->view, facet);
    double radius;
    lrcsi_round_point centre;
    for (int i = 0; i < 3; i++) {
        at[i][0] = job->view->point[corner[i]].x[0];
        at[i][1] = job->view->point[corner[i]].x[1];
    }
    if (!triangle_centre(job, (const double(*)[2])at, &centre, &radius)) {
        return HUGE_VAL;
    }
    for (int i = 0; i < 3; i++) {
        const double z = job->view->point[corner[i]].x[2];
        lrcsi_round_point point;
        if (!lrcsi_round_point_make(surface, at[i], &point)) {
            return HUGE_VAL;
        }
        double slope = lrcsi_vec3_dot(centre.g, surface->axis[0]) * (at[i][0] - centre.x[0]) +
                       lrcsi_vec3_dot(centre.g, surface->axis[1]) * (at[i][1] - centre.x[1]);
        apart = lrcsi_max(apart, fabs(lrcsi_round_height(surface, &point) - z));
        apart = lrcsi_max(apart, fabs(lrcsi_round_height(surface, &centre) - slope / centre.s - z));
    }
    lrcsi_reflection bound = lrcsi_reflect_bound(&job->brdf, atan(sqrt(incidence.tan2)),
                                                 2 * surface->part->curvature.turn);
    return incidence.cos_theta >= MIN_COSINE && surface->part->curvature.turn <= MAX_TURN &&
                   apart < MAX_REACHES * p->proximity.reach[p->scene->facet_part[facet]]
               ? (bound.glint + bound.diffuse) * ROUNDED_UP
               : HUGE_VAL;
}

/* Integrates over the visible pieces of a facet. Returns 0 if that is not possible. */
static int facet_integrate(const pieces_job *job, lrcsi_occlusion *o, uint32_t facet,
                           lrcsi_round_piece *piece)
{
    const lrcsi_view *view = job->view;
    const lrcsi_target *target = &o->single.target;
    double projected = lrcsi_view_projected(view, facet);
    double bound = facet_bound(job, facet);
    pieces_sum sum = {0, 0, 0, 0};
    double area_err = 0;
    int known = bound < HUGE_VAL;
    lrcsi_occlude_open(o, facet);
    while (lrcsi_occlude_next(o)) {
        const lrcsi_clip_polygon *polygon = &o->single.piece;
        double origin[3];
        lrcsi_view_coordinates(view, target->origin, origin);
        for (uint32_t i = 2; i < polygon->count && known; i++) {
            double area = lrcsi_clip_fan_area(polygon->corner[0], polygon->corner[i - 1],
                                              polygon->corner[i], &area_err);
            double corner[3][2];
            for (int k = 0; k < 2; k++) {
                corner[0][k] = origin[k] + polygon->corner[0][k];
                corner[1][k] = origin[k] + polygon->corner[i - 1][k];
                corner[2][k] = origin[k] + polygon->corner[i][k];
            }
            known =
                !target->needle &&
                (!(area > 0) || triangle_integrate(job, (const double(*)[2])corner, area, &sum));
        }
        area_err += 20 * LRCSI_U * target->reach * target->perimeter;
    }
    area_err += o->undecided ? o->single.piece_err : 0;
    lrcsi_visible area = lrcsi_occlude_close(o);
    double gain = lrcsi_min(job->band->gain_above[facet] * projected, projected - area.low);
    double loss = lrcsi_min(job->band->loss_above[facet] * projected, area.high);
    *piece =
        (lrcsi_round_piece){.known = 1,
                            .glint = sum.glint,
                            .diffuse = sum.diffuse,
                            .rounding = sum.rounding,
                            .visibility = bound * (area.high - area.low + area_err) * ROUNDED_UP,
                            .above = bound * lrcsi_max(0, gain) * ROUNDED_UP,
                            .below = bound * lrcsi_max(0, loss) * ROUNDED_UP,
                            .own = sum.remainder};
    return known;
}

/* --- margins -----------------------------------------------------------------------------------
 */

/* A side of a sector: the arc of its patch and the chord of its facets, with one parameter t in
   -1 .. 1. The arc is a part of a row's circle or of a meridian, with its own parameter, sign t. */
typedef struct sector_side {
    int is_row;
    double sign;
    double rho, z, azimuth, polar; /* of the middle, scaled; z of rows, polar of meridians */
    double half;                   /* half the difference between the ends: of azimuths of a row; of
                                      polar angles on the meridian of a sphere or dome, of radii on
                                      that of a paraboloid */
    double chord[2], step[2];      /* the middle of the chord, half of it */
    uint32_t vertex[2];
} sector_side;

/* A point of the arc, and its derivative with respect to t. On the meridian of a sphere or dome the
   polar angle is linear in t, on that of a paraboloid the radius. */
static void side_arc(const pieces_job *job, const sector_side *side, double t, double x[2],
                     double dx[2])
{
    const lrcsi_round_surface *s = &job->surface;
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
static double side_bend(const pieces_job *job, const sector_side *side, double r, double *slope)
{
    const lrcsi_round_surface *s = &job->surface;
    double h = fabs(side->half);
    if (!side->is_row && s->alpha == 0) {
        double second = h * h / s->beta;
        *slope = second * r * ROUNDED_UP;
        return 0.5 * second * r * r * ROUNDED_UP;
    }
    double radius = side->is_row ? side->rho : sqrt(-s->gamma);
    double grown = radius * lrcsi_exp(h * r) * ROUNDED_UP;
    *slope = h * h * r * grown;
    return 0.5 * (h * r) * (h * r) * grown;
}

/* A part of a margin, for t in middle - half .. middle + half: its chord c + t' step, t' in -1 ..
   1, how far the arc is from it and the difference of their derivatives in the middle. */
typedef struct margin_part {
    double middle, half;
    double chord[2], step[2];
    double apart, turned, length; /* the last is |step| */
    lrcsi_round_point centre;
} margin_part;

/* M for parameters up to r times as far from the middle, and up to `out` times as far from the
   chord as the arc. *width, *slope: bounds on the distance between arc and chord, and on the
   difference of their derivatives. */
static double margin_bound(const pieces_job *job, const sector_side *side, const margin_part *part,
                           double r, double out, double *width, double *slope)
{
    double bend = side_bend(job, side, r * part->half, slope);
    *width = (part->apart + part->turned * r + bend) * ROUNDED_UP + job->surface.position_err;
    *slope = (part->turned + *slope * part->half) * ROUNDED_UP;
    return lrcsi_round_bound(&job->surface, &job->brdf, &part->centre,
                             r * part->length + out * *width);
}

/* The remainder of the rules along and across a part of a margin. */
static double margin_remainder(const pieces_job *job, const sector_side *side,
                               const margin_part *part, int along, int across)
{
    double error_along = HUGE_VAL; /* complex t, real s */
    double error_across = HUGE_VAL;
    double width;
    double slope;
    for (int i = 0; i < RATIOS; i++) {
        double q = 1 / (ratios[i] * ratios[i]);
        double m = margin_bound(job, side, part, ratios[i], 1, &width, &slope);
        m *= (part->length + slope) * width;
        for (int k = 0; k < along; k++) {
            m *= q;
        }
        error_along = lrcsi_min(error_along, 2 * m / ((2 * along + 1) * (1 - q)));
        m = margin_bound(job, side, part, 1, 1 + ratios[i], &width, &slope);
        m *= (part->length + (1 + ratios[i]) * slope) * width;
        for (int k = 0; k < across; k++) {
            m *= q;
        }
        error_across = lrcsi_min(error_across, 2 * m / ((2 * across + 1) * (1 - q)));
    }
    return (error_along + error_across) * ROUNDED_UP;
}

/* Adds the integral over a part of a margin. */
static void margin_add(const pieces_job *job, const sector_side *side, const margin_part *part,
                       const lrcsi_gauss_rule *along, const lrcsi_gauss_rule *across,
                       pieces_sum *sum)
{
    double t[LRCSI_GAUSS_POINTS_MAX];
    double s[LRCSI_GAUSS_POINTS_MAX];
    double t_weight[LRCSI_GAUSS_POINTS_MAX];
    double s_weight[LRCSI_GAUSS_POINTS_MAX];
    int count = lrcsi_gauss_points(along, t, t_weight);
    int rows = lrcsi_gauss_points(across, s, s_weight);
    for (int i = 0; i < count; i++) {
        double a[2];
        double da[2];
        side_arc(job, side, side->sign * (part->middle + t[i] * part->half), a, da);
        const double chord[2] = {part->chord[0] + t[i] * part->step[0],
                                 part->chord[1] + t[i] * part->step[1]};
        const double out[2] = {a[0] - chord[0], a[1] - chord[1]};
        for (int k = 0; k < rows; k++) {
            double at = 0.5 * (1 + s[k]);
            const double v[2] = {chord[0] + at * out[0] - part->centre.x[0],
                                 chord[1] + at * out[1] - part->centre.x[1]};
            const double turn = at * side->sign * part->half;
            const double tangent[2] = {(1 - at) * part->step[0] + turn * da[0],
                                       (1 - at) * part->step[1] + turn * da[1]};
            double area =
                2 * t_weight[i] * s_weight[k] * (out[0] * tangent[1] - out[1] * tangent[0]);
            lrcsi_round_value value =
                lrcsi_round_value_make(&job->surface, &job->brdf, &part->centre, v);
            sum->glint += area * value.glint;
            sum->diffuse += area * value.diffuse;
            sum->rounding += fabs(area) * value.error;
        }
    }
}

/* The integral over a margin, positive where the arc is outside a counter-clockwise sector, and its
   errors; a bound on its size, whatever is visible of it; and a bound on its width. The margin is
   divided until the remainder is small compared with its size. Returns 0 if it is not known. */
static int margin_integrate(const pieces_job *job, const sector_side *side, pieces_sum *sum,
                            double *largest, double *widest)
{
    const lrcsi_gauss_rule *along = &lrcsi_gauss_rules[LRCSI_GAUSS_RULES - 2];
    const lrcsi_gauss_rule *across = &lrcsi_gauss_rules[1];
    const double vertex_err = lrcsi_view_point_err(job->view->point[side->vertex[0]].x) +
                              lrcsi_view_point_err(job->view->point[side->vertex[1]].x);
    for (int n = 1; n <= MARGIN_PARTS_MAX; n *= 2) {
        pieces_sum all = {0, 0, 0, 0};
        *largest = *widest = 0;
        for (int i = 0; i < n && all.remainder < HUGE_VAL; i++) {
            double a[2];
            double da[2];
            double width;
            double slope;
            margin_part part = {.middle = (2.0 * i + 1 - n) / n, .half = 1.0 / n};
            for (int k = 0; k < 2; k++) {
                part.chord[k] = side->chord[k] + part.middle * side->step[k];
                part.step[k] = part.half * side->step[k];
            }
            side_arc(job, side, side->sign * part.middle, a, da);
            double turn = side->sign * part.half;
            part.apart = lrcsi_length_flat(a[0] - part.chord[0], a[1] - part.chord[1]);
            part.turned =
                lrcsi_length_flat(turn * da[0] - part.step[0], turn * da[1] - part.step[1]);
            part.length = lrcsi_length_flat(part.step[0], part.step[1]);
            if (!lrcsi_round_point_make(&job->surface, part.chord, &part.centre)) {
                return 0;
            }
            double bound = margin_bound(job, side, &part, 1, 1, &width, &slope);
            double size = bound * (part.length + slope) * ROUNDED_UP;
            *largest += 2 * size * width;
            *widest = lrcsi_max(*widest, width);
            all.remainder += margin_remainder(job, side, &part, along->points, across->points);
            /* the positions of both borders */
            all.rounding += 8 * size * (job->surface.position_err + vertex_err);
            if (all.remainder < HUGE_VAL) {
                margin_add(job, side, &part, along, across, &all);
            }
        }
        if (all.remainder <= MARGIN_TARGET * *largest &&
            isfinite(all.rounding + all.glint + all.diffuse + *largest)) {
            sum->glint += all.glint;
            sum->diffuse += all.diffuse;
            sum->rounding += all.rounding;
            sum->remainder += all.remainder;
            return 1;
        }
    }
    return 0;
}

/* --- sectors ---------------------------------------------------------------------------------- */

/* A sector and its sides, counter-clockwise in the view. */
typedef struct round_sector {
    uint32_t facet[2];
    int facets, sides;
    sector_side side[4];
    uint32_t neighbour[4]; /* LRCS_NONE: not known */
    uint32_t owner[4]; /* the facet that has the side, and the number of its first corner there */
    int corner[4];
} round_sector;

/* The vertex of the sector's facets that stands for a corner of its patch. */
static uint32_t corner_vertex(const pieces_job *job, const round_sector *sector, double rho,
                              double z, double azimuth)
{
    const lrcsi_round_surface *s = &job->surface;
    const lrcs_scene *scene = job->view->prepared->scene;
    const double X[3] = {rho * cos(azimuth), rho * sin(azimuth), z};
    uint32_t nearest = LRCS_NONE;
    double least = HUGE_VAL;
    for (int i = 0; i < 3 * sector->facets; i++) {
        uint32_t vertex = scene->facet[sector->facet[i / 3]].corner[i % 3];
        double distance = 0;
        for (int k = 0; k < 3; k++) {
            double x = s->view[k] + lrcsi_vec3_dot(X, s->axis[k]) - job->view->point[vertex].x[k];
            distance += x * x;
        }
        if (distance < least) {
            least = distance;
            nearest = vertex;
        }
    }
    return nearest;
}

/* Finds which facet has a side, and the facet across it. Returns 0 if there is no such side. */
static int side_find(const pieces_job *job, int number, round_sector *sector)
{
    const lrcs_prepared *p = job->view->prepared;
    const uint32_t *vertex = sector->side[number].vertex;
    for (int i = 0; i < 3 * sector->facets; i++) {
        uint32_t f = sector->facet[i / 3];
        uint32_t a = p->scene->facet[f].corner[i % 3];
        uint32_t b = p->scene->facet[f].corner[(i + 1) % 3];
        if ((a == vertex[0] && b == vertex[1]) || (a == vertex[1] && b == vertex[0])) {
            uint32_t other = p->neighbours.facet[f].corner[i % 3];
            sector->neighbour[number] =
                other < p->scene->facet_count && other != f ? other : LRCS_NONE;
            sector->owner[number] = f;
            sector->corner[number] = i % 3;
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
static sector_side side_make(const pieces_job *job, const lrcsi_wall_patch *at, int number)
{
    const lrcsi_revolution *body = &job->body;
    const double unit = job->unit;
    const int is_row = number % 2 == 0;
    const uint32_t row = at->row + (uint32_t)(number == 2);
    const double below = lrcsi_revolution_radius(body, at->row) * unit;
    const double above = lrcsi_revolution_radius(body, at->row + 1) * unit;
    const double polar[2] = {lrcsi_revolution_polar(body, at->row),
                             lrcsi_revolution_polar(body, at->row + 1)};
    sector_side side = {.is_row = is_row, .sign = number < 2 ? 1 : -1};
    if (is_row) {
        side.rho = lrcsi_revolution_radius(body, row) * unit;
        side.z = (at->mirrored ? -1 : 1) * lrcsi_revolution_height(body, row) * unit;
        side.azimuth = (2.0 * at->sector + 1.0) * body->half;
        side.half = body->half;
    } else {
        side.rho = 0.5 * (below + above);
        side.azimuth = 2.0 * ((double)at->sector + (number == 1)) * body->half;
        side.polar = 0.5 * (polar[0] + polar[1]);
        side.half = 0.5 * (job->surface.alpha == 0 ? above - below : polar[1] - polar[0]);
        if (at->mirrored) { /* the other half of a sphere */
            side.polar = LRCS_PI - side.polar;
            side.half = -side.half;
        }
    }
    return side;
}

/* Makes the sector of a facet. Returns 0 if its corners are not known. */
static int sector_make(const pieces_job *job, uint32_t facet, round_sector *sector)
{
    const lrcs_prepared *p = job->view->prepared;
    const lrcs_part *part = job->surface.part;
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
        double z = (at.mirrored ? -1 : 1) * lrcsi_revolution_height(&job->body, row) * job->unit;
        double azimuth = 2.0 * ((double)at.sector + corner_azimuth[i]) * job->body.half;
        vertex[i] = corner_vertex(job, sector, lrcsi_revolution_radius(&job->body, row) * job->unit,
                                  z, azimuth);
    }
    if (vertex[0] == vertex[1] || vertex[0] == vertex[2] || vertex[0] == vertex[3] ||
        vertex[1] == vertex[2] || vertex[1] == vertex[3] ||
        (vertex[2] == vertex[3]) != (at.facets == 1)) {
        return 0;
    }
    for (int i = 0; i < 4; i++) {
        turning += lrcsi_vec2_cross(job->view->point[vertex[i]].x,
                                    job->view->point[vertex[(i + 1) % 4]].x);
    }
    sector->sides = 0;
    for (int i = 0; i < 4; i++) {
        if (i == 2 && at.facets == 1) { /* the apex */
            continue;
        }
        sector_side side = side_make(job, &at, i);
        side.vertex[0] = vertex[turning > 0 ? i : (i + 1) % 4];
        side.vertex[1] = vertex[turning > 0 ? (i + 1) % 4 : i];
        side.sign = turning > 0 ? side.sign : -side.sign;
        for (int k = 0; k < 2; k++) {
            const double a = job->view->point[side.vertex[0]].x[k];
            const double b = job->view->point[side.vertex[1]].x[k];
            side.chord[k] = 0.5 * (a + b);
            side.step[k] = 0.5 * (b - a);
        }
        sector->side[sector->sides] = side;
        if (!side_find(job, sector->sides, sector)) {
            return 0;
        }
        sector->sides++;
    }
    return 1;
}

/* Is it uncertain what is visible of a facet or of its patch? */
static int facet_is_uncertain(const pieces_job *job, uint32_t facet)
{
    const lrcsi_proximity_band *band = job->band;
    int state = lrcsi_patch_state_of(job->view, facet, job->visible, band);
    return state == LRCSI_PATCH_PARTIAL ||
           (state == LRCSI_PATCH_HIDDEN && band->mismatch[facet] > 0 &&
            !band->hidden[band->region[facet]]);
}

/* Is a facet on a round wall that may be used, apart from its visibility? */
static int facet_is_eligible(const pieces_job *job, uint32_t facet)
{
    const lrcs_prepared *p = job->view->prepared;
    const lrcs_part *part = lrcsi_patch_part(p, facet);
    return !p->skip[facet] && job->view->facing[facet] > 0 && job->band->gain_above[facet] >= 0 &&
           lrcsi_shape_is_round(part->kind) && part->rigid && lrcsi_patch_exists(p, facet);
}

/* May a sector be used, apart from what the integrals need? */
static int sector_is_candidate(const pieces_job *job, const round_sector *sector)
{
    int uncertain = 0;
    for (int i = 0; i < sector->facets; i++) {
        if (!facet_is_eligible(job, sector->facet[i])) {
            return 0;
        }
        uncertain |= facet_is_uncertain(job, sector->facet[i]);
    }
    return uncertain;
}

/* What is visible beside a side of a sector: 1 everything, 0 nothing, -1 not known. A query at a
   point of the facet decides, so close to the middle of the side that what holds for the side holds
   for it. */
static int side_state(const pieces_job *job, const lrcsi_grid *facets, const round_sector *sector,
                      int number, lrcsi_meter *meter)
{
    const lrcs_prepared *p = job->view->prepared;
    uint32_t f = sector->owner[number];
    int k = sector->corner[number];
    const double *a = lrcsi_prepared_corner(p, f, k);
    const double *b = lrcsi_prepared_corner(p, f, (k + 1) % 3);
    const double *c = lrcsi_prepared_corner(p, f, (k + 2) % 3);
    double from = lrcsi_min(0.25, p->proximity.reach[p->scene->facet_part[f]] /
                                      lrcsi_length_longest_side(a, b, c));
    double point[3];
    if (!((job->band->free_sides[f] >> k) & 1)) {
        return -1;
    }
    for (int i = 0; i < 3; i++) {
        double middle = 0.5 * (a[i] + b[i]);
        point[i] = middle + from * (c[i] - middle);
    }
    int answer = lrcsi_query_point(facets, f, point, meter);
    return answer == LRCSI_QUERY_VISIBLE ? 1 : answer == LRCSI_QUERY_HIDDEN ? 0 : -1;
}

/* Adds the margins at the border of the set to a facet of a sector: one of which something is
   visible, because the sum leaves out hidden ones. If there is none, margins are errors. */
static void sector_add_margins(const pieces_job *job, const lrcsi_grid *facets,
                               const round_sector *sector, lrcsi_meter *meter,
                               lrcsi_round_piece *piece)
{
    const lrcs_prepared *p = job->view->prepared;
    const double reach = p->proximity.reach[p->scene->facet_part[sector->facet[0]]];
    const uint32_t to =
        job->visible[sector->facet[0]].high > 0 ? sector->facet[0] : sector->facet[1];
    for (int i = 0; i < sector->sides; i++) {
        uint32_t neighbour = sector->neighbour[i];
        pieces_sum sum = {0, 0, 0, 0};
        double largest = 0;
        double width = 0;
        if (neighbour != LRCS_NONE && piece[neighbour].known) {
            continue;
        }
        int state = side_state(job, facets, sector, i, meter);
        if (state == 0) {
            continue;
        }
        (void)margin_integrate(job, &sector->side[i], &sum, &largest, &width);
        if (state > 0 && width <= 2 * reach && job->visible[to].high > 0) {
            piece[to].glint += sum.glint;
            piece[to].diffuse += sum.diffuse;
            piece[to].rounding += sum.rounding;
            piece[to].own += sum.remainder;
        } else {
            piece[to].own += largest;
        }
    }
}

/* Are all margins of a sector known? */
static int sector_has_margins(const pieces_job *job, const round_sector *sector)
{
    int known = 1;
    for (int i = 0; i < sector->sides && known; i++) {
        pieces_sum sum = {0, 0, 0, 0};
        double largest;
        double width;
        known = margin_integrate(job, &sector->side[i], &sum, &largest, &width);
    }
    return known;
}

/* Prepares for the part of a facet, unless it is the current one. */
static void job_part(pieces_job *job, uint32_t facet, uint32_t *current)
{
    const lrcs_prepared *p = job->view->prepared;
    uint32_t index = p->scene->facet_part[facet];
    if (index != *current) {
        const lrcs_part *part = &p->scene->part[index];
        *current = index;
        job->surface = lrcsi_round_surface_make(job->view, index);
        job->body = lrcsi_revolution_make(&part->shape, &part->divisions);
        job->unit = ldexp(part->unit, -p->exponent);
        job->brdf = lrcsi_plan_brdf(job->plan, lrcsi_prepared_material(p, facet));
    }
}

/* 1. Which sectors: all of whose integrals and margins are known; the integrals over their pieces.
   2. The margins at the border of the set. */
void lrcsi_round_pieces_make(lrcsi_classification *classification, const lrcsi_plan *plan,
                             const lrcsi_proximity_band *band, const lrcsi_visible *visible,
                             lrcsi_meter *meter, lrcs_work *work, lrcsi_round_piece *piece)
{
    const lrcsi_view *view = classification->view;
    const uint32_t count = view->prepared->scene->facet_count;
    const size_t mark = work->used;
    pieces_job job = {.view = view, .plan = plan, .band = band, .visible = visible};
    lrcsi_occlusion o;
    round_sector sector;
    uint32_t current = LRCS_NONE; /* part */
    int begun = 0;
    job.target =
        lrcsi_min(REMAINDER_HIGH, lrcsi_max(REMAINDER_LOW, TOLERANCE_FRACTION * plan->tolerance));
    for (uint32_t f = 0; f < count; f++) {
        piece[f].known = 0;
    }
    for (uint32_t f = 0; f < count && plan->patches; f++) { /* 1 */
        if (piece[f].known || !facet_is_eligible(&job, f) || !facet_is_uncertain(&job, f)) {
            continue;
        }
        job_part(&job, f, &current);
        if ((job.brdf.A > 0 && !(job.brdf.s >= LRCSI_PATCH_SLOPE_MIN)) ||
            !sector_make(&job, f, &sector) || !sector_is_candidate(&job, &sector) ||
            !sector_has_margins(&job, &sector)) {
            continue;
        }
        if (!begun && lrcsi_occlude_make(classification, meter, work, &o) != LRCS_OK) {
            return;
        }
        begun = 1;
        int known = 1;
        for (int i = 0; i < sector.facets && known; i++) {
            known = facet_integrate(&job, &o, sector.facet[i], &piece[sector.facet[i]]);
        }
        for (int i = 0; i < sector.facets; i++) {
            piece[sector.facet[i]].known = known;
        }
    }
    current = LRCS_NONE;
    for (uint32_t f = 0; f < count && begun; f++) { /* 2 */
        if (piece[f].known) {
            job_part(&job, f, &current);
            if (sector_make(&job, f, &sector) && sector.facet[0] == f) {
                sector_add_margins(&job, &o.facets, &sector, meter, piece);
            }
        }
    }
    work->used = mark;
    for (uint32_t f = 0; f < count && meter->spent; f++) {
        piece[f].known = 0;
    }
}
