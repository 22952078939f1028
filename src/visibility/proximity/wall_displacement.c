/* SPDX-License-Identifier: MIT */
/* Integrates the displacement of a straight wall's points over a segment. What follows for visible
   areas is decided in visibility/proximity/wall_margin.c.

   With the symbols of event_band.c, 7, the map takes y = rho kappa (1, v tan h), -1 <= v <= 1, in
   the directions radial and around, to x = rho (cos vh, sin vh), at the same height. So the
   displacement is rho (c, s) with
       c(v) = cos vh - kappa = (1 - kappa) - (vh)^2 / 2 + (vh)^4 / 24,
       s(v) = sin vh - v kappa tan h = v (h - kappa tan h) - (vh)^3 / 6,
   but for at most h^6 / 720 and h^5 / 120. The polygon has the circle's area, so that kappa =
   1 - h^2 / 6 + O(h^4), and the mean of c over -1 <= v <= 1 is O(h^4).

   Over a segment of a facet's plane, rho and rho v are linear functions of the position. Let rho be
   rho0 and rho1 at its ends, v be v0 and v1. A linear function in place of v differs from v by at
   most |v1 - v0| |rho1 - rho0| / (4 min(rho0, rho1)): v is the mean of v0 and v1 with the weights
   t rho1 and (1 - t) rho0 in place of t and 1 - t. Then the integrand is a polynomial of degree 5,
   for which the rule of three points is exact.

   Size. With the mean of rho in place of rho, and without s and the last term of c, the integrand
   is a quadratic function, of which the integral of the magnitude has a close bound. What is left
   out is at most g |rho1 - rho0| / 2 (g as below), rho h^3 along the edge's component around and
   rho h^4 / 24.

   Derivatives. |c'| <= h^2. kappa tan h = mu sin h, where the vertex ratio mu is between 1 and
   1 / cos h; so s' = h cos vh - mu sin h is between h cos h - tan h and h - sin h, both at most h^3
   in size for h <= 1/2. Hence |c| <= 1 - cos h <= h^2 / 2, |s| <= h^3, and both displacement and
   derivative are at most g = h^2 (1 + h), times rho. A step of length 1 in projection is one of at
   most 1 / cos(theta) in the facet's plane; so rho kappa changes by at most that, and v by at most
   (1 + tan h) / (rho kappa tan h cos(theta)). The displacement changes by at most
       g (1 + (1 + tan h) / tan h) / (kappa cos(theta)). */
#include "visibility/proximity/wall_displacement.h"

#include <math.h>

#include "base/outward.h"
#include "base/parabola.h"
#include "base/range.h"
#include "base/vec3.h"
#include "mesh/shape/revolution.h"

/* Larger angles h are not used. */
#define HALF_MAX 0.5
/* Rounding may move points out of the sector, where |v| is larger than 1 by this: bounds are
   increased by LARGER. */
#define BEYOND_SECTOR 1e-4
#define LARGER        1.001
/* The error of unit vectors. */
#define UNIT_ERR 1e-12

/* The rule of three points on 0 .. 1 (Gauss, 1814): exact up to degree 5. */
static const double rule_at[3] = {0.11270166537925831, 0.5, 0.88729833462074169};
static const double rule_weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};

/* rho kappa and rho kappa v tan h at the corners of a facet. */
typedef struct facet_frame {
    const double *corner[3]; /* in the view */
    double radial[3], around[3];
    double twice; /* twice its area in projection, with the sign of its corners' order */
} facet_frame;

static facet_frame facet_frame_make(const lrcsi_view *view, uint32_t facet,
                                    const lrcsi_band_sector *sector)
{
    facet_frame f;
    double side[2][2];
    for (int k = 0; k < 3; k++) {
        double from[3];
        f.corner[k] = view->point[view->prepared->scene->facet[facet].corner[k]].x;
        lrcsi_vec3_between(sector->origin, f.corner[k], from);
        f.radial[k] = lrcsi_vec3_dot(from, sector->radial);
        f.around[k] = lrcsi_vec3_dot(from, sector->around);
    }
    for (int k = 0; k < 2; k++) {
        side[k][0] = f.corner[k + 1][0] - f.corner[0][0];
        side[k][1] = f.corner[k + 1][1] - f.corner[0][1];
    }
    f.twice = lrcsi_vec2_cross(side[0], side[1]);
    return f;
}

/* rho and v above a point of the view plane. */
static void facet_frame_at(const facet_frame *f, const lrcsi_band_sector *sector, const double x[2],
                           double *rho, double *v)
{
    double radial = 0;
    double around = 0;
    for (int k = 0; k < 3; k++) {
        const double *p = f->corner[(k + 1) % 3];
        const double *q = f->corner[(k + 2) % 3];
        const double side[2] = {q[0] - p[0], q[1] - p[1]};
        const double to[2] = {x[0] - p[0], x[1] - p[1]};
        const double weight = lrcsi_vec2_cross(side, to) / f->twice;
        radial += weight * f->radial[k];
        around += weight * f->around[k];
    }
    *rho = radial / sector->kappa;
    *v = around / (radial * sector->tangent);
}

static double dot_flat(const double a[2], const double *b)
{
    return a[0] * b[0] + a[1] * b[1];
}

/* Errors of positions, and rounding, move the points at which D is evaluated: the errors of their
   heights above the facet's sides, relative to its own heights, times its longest side. */
int lrcsi_wall_displacement_make(const lrcsi_event_bands *bands, uint32_t facet, const double a[2],
                                 const double b[2], double position_err, const double along[2],
                                 lrcsi_wall_displacement *found)
{
    const lrcsi_view *view = bands->view;
    const lrcsi_band_sector sector = lrcsi_band_facet_make(bands, facet, NULL).sector;
    const double h = sector.half;
    const double cosine = lrcsi_view_incidence(view, facet).cos_theta - LRCSI_VIEW_COS_ERR;
    double rho[2];
    double v[2];
    *found = (lrcsi_wall_displacement){.area = 0};
    if (!sector.known || !(h <= HALF_MAX) || !(cosine > 0)) {
        return 0;
    }
    const facet_frame frame = facet_frame_make(view, facet, &sector);
    facet_frame_at(&frame, &sector, a, &rho[0], &v[0]);
    facet_frame_at(&frame, &sector, b, &rho[1], &v[1]);
    if (!(lrcsi_max(fabs(v[0]), fabs(v[1])) <= 1 + BEYOND_SECTOR) ||
        !(lrcsi_min(rho[0], rho[1]) > 0)) {
        return 0;
    }
    const double out = dot_flat(along, sector.radial);
    const double side = dot_flat(along, sector.around);
    double mean = 0;
    for (int i = 0; i < 3; i++) {
        const double t = rule_at[i];
        const double angle = h * ((1 - t) * v[0] + t * v[1]);
        const double square = angle * angle;
        const double c = (1 - sector.kappa) - square / 2 + square * square / 24;
        const double s = angle * (1 - sector.kappa * sector.tangent / h - square / 6);
        mean += rule_weight[i] * ((1 - t) * rho[0] + t * rho[1]) * (out * c + side * s);
    }
    const double ab[2] = {b[0] - a[0], b[1] - a[1]};
    const double length = sqrt(dot_flat(ab, ab));
    const double most = lrcsi_max(rho[0], rho[1]);
    const double g = LARGER * h * h * (1 + h);
    const double bent = fabs(v[1] - v[0]) * fabs(rho[1] - rho[0]) / (4 * lrcsi_min(rho[0], rho[1]));
    const double series = LARGER * (h * h * h * h * h / 120 * (1 + h)) + LRCSI_REVOLUTION_SLACK;
    const double middle = 0.5 * (rho[0] + rho[1]);
    const double uneven = 0.5 * fabs(rho[1] - rho[0]);
    double value[3]; /* out c, rho being the mean */
    for (int i = 0; i < 3; i++) {
        const double angle = h * (v[0] + 0.5 * i * (v[1] - v[0]));
        value[i] = middle * out * ((1 - sector.kappa) - angle * angle / 2);
    }
    const double longest = lrcsi_proximity_longest(view->prepared, facet);
    const double moved = 8 * position_err * longest * longest / fabs(frame.twice);
    found->slope = g * (1 + (1 + sector.tangent) / sector.tangent) / (sector.kappa * cosine) *
                   LRCSI_OUTWARD_NANO;
    found->area = mean * length;
    found->error = length *
                   (most * (g * (bent + UNIT_ERR) + series) + found->slope * moved +
                    2 * sector.rounding + LRCSI_PROXIMITY_ERR) *
                   LRCSI_OUTWARD_NANO;
    found->size =
        (length * (lrcsi_parabola_positive(value, 1, 0) + lrcsi_parabola_positive(value, -1, 0) +
                   g * uneven + LARGER * most * (h * h * h * h / 24 + fabs(side) * h * h * h)) +
         found->error) *
        LRCSI_OUTWARD_NANO;
    return isfinite(found->area + found->error + found->slope + found->size);
}
