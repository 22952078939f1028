/* SPDX-License-Identifier: MIT */
/* How far the facets of a body of revolution are from its true surface: by a map of one onto the
   other, and by Hausdorff distances. The geometry and its symbols are those of revolution.c.

   Reach. The patch of a trapezoid is mapped onto it so that a fraction of the azimuth becomes the
   same fraction of its width, and a fraction a of the area, counted from the top, the same fraction
   of its area: area is then stretched by A'/A everywhere. Let r be the radius of the true circle
   for which the middle of a side is at kappa r. On the trapezoid r^2 is linear in a, from rho1^2 at
   the top row to rho0^2. On the patch
     straight walls: rho^2 is linear in a, so that rho = r and heights agree;
     sphere: cos theta is linear in a, and rho^2 - r^2 = R^2 a (1 - a) (cos theta1 - cos theta0)^2;
     paraboloid: w^3 is linear in a, where w^2 = 1 + y^2. As a function of w^3, w^2 exceeds its
       chord most at w = v = 2 (w0^2 + w0 w1 + w1^2) / (3 (w0 + w1)), by
       (v - w1)^2 (v + 2 w1) / (3 v), where v - w1 = (w0 - w1) (2 w0 + w1) / (3 (w0 + w1)).
   With b a bound on rho^2 - r^2 (zone_excess), rho - r <= min(sqrt(b), b / (2 rho1), rho0 - rho1).
   Heights are compared as fractions from the top. The trapezoid's point is at
   beta = (r - rho1)/(rho0 - rho1), which exceeds a by at most (rho0 - rho1) / (4 (rho0 + rho1)).
   The sphere's point is at a, the paraboloid's between a and a + b/(rho0^2 - rho1^2). To the
   difference, those between the heights of the rows and of the true circles are added. Within a
   row, with v in -1 .. 1, (cos vh, sin vh) is mapped to kappa (1, v tan h): at a distance of at
   most max(1 - kappa, kappa - cos h) radially and max(h^3/6, (mu - 1) sin h) tangentially, times r.
   For a disc only the latter map applies. It preserves areas everywhere, so that it holds for any
   division of the polygon into facets.

   Hausdorff distances. Let z_i be the height of the true circle i, z_i' that of row i, and sigma
   the largest distance between the meridian of a patch and its chord: R (1 - cos(d/2)) on a sphere;
   on a paraboloid, where the meridian is at most H x^2 / 4 above its chord in a zone of width x R,
   that times the cosine of the chord's inclination; 0 on straight walls. Meridian and chord are
   within sigma of each other, since all tangents are inclined by less than 90 deg to the chord.
   - Every cross-section of the facets' solid between two rows is a regular N-gon that contains the
     circle interpolated between those of radius kappa rho_i at z_i' and kappa rho_(i+1) at
     z_(i+1)'. So a point of a true patch is within sigma of a point of the chord, which is within
     max over its two ends of |((1 - kappa) rho_i, z_i - z_i')| of the facets' solid. True circles
     are within the same distance of their polygons, and so are caps.
   - A vertex is at |((mu - 1) rho_i, z_i - z_i')| from the true circle. The distance from a convex
     body is a convex function, so all points of the facets' solid are that close to the true one.
   - A point of a facet is between kappa and mu times as far from the axis as the point of the chord
     at the same fraction of the height: both are within
     max over the two ends of |(max(1 - kappa, mu - 1) rho_i, z_i - z_i')|, and the chord is within
     sigma of the true wall. The same holds in the other direction. */
#include "mesh/shape/revolution_reach.h"

#include <math.h>

#include "base/constant.h"

/* How far the polygon's vertices are outside the unit circle, and the middles of its sides inside.
 */
static double outward_ratio(const lrcsi_revolution *body)
{
    return body->vertex_ratio - 1.0 + LRCSI_REVOLUTION_SLACK;
}

static double inward_ratio(const lrcsi_revolution *body)
{
    return fmax(0.0, 1.0 - body->vertex_ratio * cos(body->half)) + LRCSI_REVOLUTION_SLACK;
}

/* How far points of the unit disc move when their sector is mapped to a triangle of the N-gon. */
static lrcsi_reach sector_reach(const lrcsi_revolution *body)
{
    double h = body->half;
    double kappa = body->vertex_ratio * cos(h);
    double inward = fmax(1.0 - kappa, kappa - cos(h)) + LRCSI_REVOLUTION_SLACK;
    double tangential =
        fmax(h * h * h / 6.0, (body->vertex_ratio - 1.0) * sin(h)) + LRCSI_REVOLUTION_SLACK;
    return (lrcsi_reach){
        .all = hypot(inward, tangential), .radial = inward, .tangential = tangential};
}

/* True height of row i. */
static double true_height(const lrcsi_revolution *body, uint32_t i)
{
    if (i == 0 || i == body->zones) {
        return i == 0 ? 0.0 : body->height;
    }
    if (body->kind == LRCS_SHAPE_PARABOLOID) {
        double x = lrcsi_revolution_fraction(body, i);
        return body->height * ((1.0 - x) * (1.0 + x));
    }
    return body->height * cos(lrcsi_revolution_polar(body, i));
}

/* An upper bound of rho^2 - r^2 within zone i. */
static double zone_excess(const lrcsi_revolution *body, uint32_t i)
{
    double below = lrcsi_revolution_radius(body, i);
    double above = lrcsi_revolution_radius(body, i + 1);
    double whole = (below - above) * (below + above);
    if (lrcsi_revolution_is_straight(body)) {
        return 0.0;
    }
    if (body->kind != LRCS_SHAPE_PARABOLOID) {
        double d = body->step;
        double fall = 2.0 * sin(lrcsi_revolution_polar(body, i) - 0.5 * d) * sin(0.5 * d);
        return fmin(whole, 0.25 * body->height * fall * body->height * fall);
    }
    double y1 = lrcsi_revolution_tangent(body, i);
    double y0 = lrcsi_revolution_tangent(body, i + 1);
    double q = hypot(1.0, y1);
    double p = hypot(1.0, y0);
    double longer = (y1 - y0) * ((y1 + y0) / (q + p)); /* q - p */
    double apart = longer * (2.0 * q + p) / (3.0 * (q + p));
    double unit = body->slope > 0.0 ? body->base / body->slope : 0.0;
    double rise = unit * apart;
    return fmin(whole, rise * rise * (apart + 3.0 * p) / (3.0 * (apart + p))); /* ignores a NaN */
}

/* The largest distance between the meridian of zone i and its chord. */
static double zone_sagitta(const lrcsi_revolution *body, uint32_t i)
{
    if (lrcsi_revolution_is_straight(body)) {
        return 0.0;
    }
    if (body->kind != LRCS_SHAPE_PARABOLOID) {
        double quarter = sin(0.25 * body->step);
        return 2.0 * body->height * quarter * quarter;
    }
    double wide = lrcsi_revolution_fraction(body, i) - lrcsi_revolution_fraction(body, i + 1);
    double rise = lrcsi_revolution_level_rise(body, i);
    double slant = hypot(wide * body->base, rise);
    double above = 0.25 * body->height * wide * wide;
    return slant > 0.0 ? above * (wide * body->base / slant) : above;
}

double lrcsi_zone_outside(const lrcsi_revolution *body, uint32_t i)
{
    double below = lrcsi_revolution_radius(body, i);
    double above = lrcsi_revolution_radius(body, i + 1);
    double excess = zone_excess(body, i);
    if (!(excess > 0.0)) {
        return 0.0;
    }
    double out = fmin(sqrt(excess), below - above);
    return above > 0.0 ? fmin(out, 0.5 * excess / above) : out;
}

/* How far points of zone i move, if its rows differ from their true heights by at most
   height_err. */
static lrcsi_reach zone_reach(const lrcsi_revolution *body, uint32_t i, double height_err)
{
    double below = lrcsi_revolution_radius(body, i);
    double above = lrcsi_revolution_radius(body, i + 1);
    double excess = zone_excess(body, i);
    lrcsi_reach sector = sector_reach(body);
    double out = lrcsi_zone_outside(body, i);
    double fraction = 0.0; /* the largest difference of fractions of the height */
    if (!lrcsi_revolution_is_straight(body) && below > above) {
        fraction = 0.25 * (below - above) / (below + above);
        if (body->kind == LRCS_SHAPE_PARABOLOID) {
            fraction = fmax(fraction, excess / (below - above) / (below + above));
        }
    }
    double rise = true_height(body, i + 1) - true_height(body, i);
    double wide = fmax(below, above);
    double sagitta = zone_sagitta(body, i);
    lrcsi_reach reach = {.radial = wide * sector.radial + out,
                         .axial = height_err + fmin(1.0, fraction) * rise,
                         .tangential = wide * sector.tangential + out * sin(body->half)};
    reach.all = hypot(wide * sector.all + out, reach.axial);
    reach.solid = fmax(hypot(wide * outward_ratio(body), height_err),
                       sagitta + hypot(wide * inward_ratio(body), height_err));
    reach.surface =
        sagitta + hypot(wide * fmax(outward_ratio(body), inward_ratio(body)), height_err);
    return reach;
}

lrcsi_reach lrcsi_revolution_reach(const lrcsi_revolution *body)
{
    double wide = fmax(body->base, body->top);
    lrcsi_reach bound = {.all = wide * sector_reach(body).all,
                         .solid = wide * fmax(outward_ratio(body), inward_ratio(body))};
    double z = 0.0;
    double height_err = 0.0;
    for (uint32_t i = 0; i < body->zones; i++) {
        double before = height_err;
        z += lrcsi_revolution_rise(body, i);
        height_err = fabs(z - true_height(body, i + 1));
        lrcsi_reach zone = zone_reach(body, i, fmax(before, height_err));
        bound.all = fmax(bound.all, zone.all);
        bound.radial = fmax(bound.radial, zone.radial);
        bound.axial = fmax(bound.axial, zone.axial);
        bound.tangential = fmax(bound.tangential, zone.tangential);
        bound.solid = fmax(bound.solid, zone.solid);
        bound.surface = fmax(bound.surface, zone.surface);
    }
    bound.surface = fmax(bound.surface, bound.solid);
    double rounding = (32.0 + 2.0 * (double)body->zones) * LRCSI_U * (wide + body->height);
    return (lrcsi_reach){.all = bound.all * LRCSI_REACH_MARGIN + rounding,
                         .radial = bound.radial * LRCSI_REACH_MARGIN + rounding,
                         .axial = bound.axial * LRCSI_REACH_MARGIN + rounding,
                         .tangential = bound.tangential * LRCSI_REACH_MARGIN + rounding,
                         .solid = bound.solid * LRCSI_REACH_MARGIN + rounding,
                         .surface = bound.surface * LRCSI_REACH_MARGIN + rounding};
}
