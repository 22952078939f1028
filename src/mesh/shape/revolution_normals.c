/* SPDX-License-Identifier: MIT */
/* The true normals over the facets of a body of revolution, as linear functions of position with
   bounds. The geometry and its symbols are those of revolution.c and revolution_reach.c.

   Let the patch have its normals at polar angles alpha and at azimuths phi = v h from the middle of
   the sector, v in -1 .. 1, and let nu be the polar angle of the facets' normal. Then
       N . e_x = sin alpha sin vh,
       N . e_y = sin(alpha - nu) - sin alpha cos nu (1 - cos vh),
   and the second term of N . e_y varies by at most sin alpha |cos nu| (1 - cos h), half of which is
   an error if the constant is chosen well. The image has x = v mu r sin h (see "Reach"). For v in
   0 .. 1, q = sin vh - v sin h is 0 at both ends, and q'' >= -h^3 v: so 0 <= q <= h^3 (v - v^3)/6,
   which is below h^3/15.

   Across. On a sphere sin alpha = rho/R. With across = 1/(mu R) the error is at most
   (rho - r)/R |sin vh| + r/R q, and the mean of |sin vh| is below h/2. On a paraboloid rho/R is
   y / y_rim, sin alpha = y cos alpha, and across = y_rim C / (mu R), where C is the mean of cos
   alpha at both rows: the first term is then [y |cos alpha - C| + C y_rim (rho - r)/R] |sin vh|. On
   a straight wall sin alpha = S is constant. With across = S / (mu r'), r' the mean of the radii of
   the rows, the first term is S |1 - r/r'| |sin vh|, at most S D |sin vh| with
   D = |rho0 - rho1| / (rho0 + rho1). The mean of |1 - r/r'| over the patch, where r has a density
   in proportion to r, is D/2. Between two heights rho0 and rho1 are the radii there. The first term
   changes its sign with v: so of its integral over any region between these heights half of the
   bound, the mean of |1 - r/r'| being at most D, is left, which is the same.

   Along, half the range of the difference of both sides.
   - Straight wall: along = 0; sin(alpha - nu) is constant.
   - Sphere: N is the position on the unit sphere, so with along = 1/R the difference is that of
     patch and facets along e_y,
         (rho cos vh - kappa r) cos nu - (z - z') sin nu.
     There rho - r is between 0 and lrcsi_zone_outside, and (1 - kappa) r varies by
     |1 - kappa| (rho0 - rho1). With a and beta the fractions of the height, z - z' is a constant
     and (beta - a) dz + beta (dz' - dz), dz and dz' the rises of patch and facets; beta - a is
     between 0 and (rho0 - rho1) / (4 (rho0 + rho1)).
   - Paraboloid: f = sin(alpha - nu) as a function of y = tan alpha has
         |f''| = |sin(alpha - nu) + 2 y cos(alpha - nu)| cos^4 alpha,
     so that it differs from its chord between both rows by at most (y1 - y0)^2 / 8 times the
     supremum of that. On the facets y_rim r/R is linear in the position along e_y, and takes the
     place of y, from which it differs by 0 .. y_rim lrcsi_zone_outside / R. */
#include "mesh/shape/revolution_normals.h"

#include <math.h>

#include "base/constant.h"

/* What depends on the shape: `across`, `along` and their errors, without the second term of N .
   e_y. Given: the rest. Returns the largest sin alpha. */
static double normals_straight(const lrcsi_revolution *body, double below, double above,
                               lrcsi_revolution_normals *n)
{
    double mean = 0.5 * (below + above);
    double h = body->half;
    double sine = cos(lrcsi_zone_make(body, 0).low);
    double uneven = sine * fabs(below - above) / (below + above);
    double bent = sine * fmax(below, above) / mean * (h * h * h / 15.0);
    n->across = sine / (body->vertex_ratio * mean);
    n->across_mean = 0.25 * h * uneven + bent;
    n->across_err = uneven * sin(h) + bent;
    return sine;
}

static double normals_paraboloid(const lrcsi_revolution *body, uint32_t i,
                                 lrcsi_revolution_normals *n)
{
    double h = body->half;
    double y1 = lrcsi_revolution_tangent(body, i);
    double y0 = lrcsi_revolution_tangent(body, i + 1);
    double low = 1.0 / hypot(1.0, y1); /* cos alpha */
    double high = 1.0 / hypot(1.0, y0);
    double shift = body->slope * (lrcsi_zone_outside(body, i) / body->base);
    lrcsi_zone zone = lrcsi_zone_make(body, i);
    double nu = atan2(n->cosine, n->sine);
    double elevation = fmax(fabs(zone.low - nu), fabs(zone.high - nu));
    double fall = sin(nu - zone.low) - sin(nu - zone.high);
    double second = (elevation + 2.0 * y1) * (high * high) * (high * high);
    double uneven = y1 * (0.5 * (high - low)) + high * shift;
    double bent = y1 * high * (h * h * h / 15.0);
    n->across = body->slope / body->base * (0.5 * (low + high)) / body->vertex_ratio;
    n->along = fall / n->length;
    n->across_mean = 0.5 * h * uneven + bent;
    n->across_err = uneven * sin(h) + bent;
    n->along_err = 0.125 * (y1 - y0) * (y1 - y0) * second + 0.5 * shift * fabs(fall / (y1 - y0));
    return y1 * low;
}

static double normals_round(const lrcsi_revolution *body, uint32_t i, lrcsi_revolution_normals *n)
{
    double below = lrcsi_revolution_radius(body, i);
    double above = lrcsi_revolution_radius(body, i + 1);
    double h = body->half;
    double kappa = body->vertex_ratio * cos(h);
    double unit = 1.0 / body->base;
    double rise = lrcsi_revolution_level_rise(body, i); /* of the patch */
    double out = lrcsi_zone_outside(body, i);
    double lag = 0.25 * (below - above) / (below + above) * rise +
                 fabs(lrcsi_revolution_rise(body, i) - rise);
    double sine = below * unit;
    double bent = sine * (h * h * h / 15.0);
    n->across = unit / body->vertex_ratio;
    n->along = unit;
    n->across_mean = 0.5 * h * (out * unit) + bent;
    n->across_err = out * unit * sin(h) + bent;
    n->along_err =
        0.5 * unit *
        ((out + fabs(1.0 - kappa) * (below - above)) * fabs(n->cosine) + lag * fabs(n->sine));
    return sine;
}

/* For a zone; on a straight wall between the heights at which it has these radii. */
static lrcsi_revolution_normals normals_make(const lrcsi_revolution *body, uint32_t i,
                                             const double radius[2])
{
    double h = body->half;
    double below = lrcsi_revolution_radius(body, i);
    double above = lrcsi_revolution_radius(body, i + 1);
    lrcsi_zone zone = lrcsi_zone_make(body, i);
    double facet = hypot(zone.gain * zone.across, zone.up);
    lrcsi_revolution_normals n = {.sine = zone.gain * zone.across / facet,
                                  .cosine = zone.up / facet,
                                  .width = body->vertex_ratio * sin(h) * fmax(below, above),
                                  .length = hypot(body->vertex_ratio * cos(h) * (below - above),
                                                  lrcsi_revolution_rise(body, i))};
    double sine = lrcsi_revolution_is_straight(body)
                      ? normals_straight(body, radius[0], radius[1], &n)
                  : body->kind == LRCS_SHAPE_PARABOLOID ? normals_paraboloid(body, i, &n)
                                                        : normals_round(body, i, &n);
    n.along_err += 0.5 * sine * fabs(n.cosine) * (2.0 * sin(0.5 * h) * sin(0.5 * h));
    double rounding = (64.0 + 4.0 * (double)body->zones) * LRCSI_U;
    n.across_err = n.across_err * LRCSI_REACH_MARGIN + rounding;
    n.across_mean = n.across_mean * LRCSI_REACH_MARGIN + rounding;
    n.along_err = n.along_err * LRCSI_REACH_MARGIN + rounding;
    n.width *= LRCSI_REACH_MARGIN;
    n.length *= LRCSI_REACH_MARGIN;
    return n;
}

lrcsi_revolution_normals lrcsi_revolution_normals_make(const lrcsi_revolution *body, uint32_t i)
{
    const double radius[2] = {lrcsi_revolution_radius(body, i),
                              lrcsi_revolution_radius(body, i + 1)};
    return normals_make(body, i, radius);
}

lrcsi_revolution_normals lrcsi_revolution_normals_between(const lrcsi_revolution *body, double low,
                                                          double high)
{
    const double radius[2] = {body->base + low * (body->top - body->base),
                              body->base + high * (body->top - body->base)};
    return normals_make(body, 0, radius);
}
