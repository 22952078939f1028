/* SPDX-License-Identifier: MIT */
/* Bodies of revolution as facets: the positions of the rows of vertices, and the bounds of patches
   of the facets between them. It makes no mesh (tessellate.c does), and does not say how far facets
   are from the true surface (revolution_reach.c), nor how its normals vary over them
   (revolution_normals.c).

   Sectors. Every row is a regular N-gon. With h = pi/N its vertices are at mu = sqrt(2 h / sin 2h)
   times the true radius rho, and the middles of its sides at kappa = mu cos h times rho. The N-gon
   then has exactly the area pi rho^2 of its circle, so that discs, caps and bases are exact.

   Zones. Two neighbouring rows are joined by planar trapezoids, one for each sector, each cut into
   two facets. Its patch is the true surface between the two true circles and the two half-planes of
   the sector; its two facets are coplanar and share that patch in proportion to their areas. Vector
   areas (integral of the normal, in the sector's middle plane) of patch and trapezoid:
       outward   patch X = 2 sin h  Int rho dz      trapezoid tan h kappa (rho0 + rho1) dz'
       upward    patch V = h (rho0^2 - rho1^2)      trapezoid the same, by the choice of kappa
   Straight walls (cylinder, cone, frustum) keep their height: the trapezoid's outward part is
   kappa tan h / sin h = mu times the patch's. Curved walls (sphere, dome, paraboloid) take the rise
   dz' = 2 / (mu (rho0 + rho1)) Int rho dz, for which it is the same too: then the facet's normal is
   the mean normal of its patch and the first-order error vanishes. Rows of such a body lie on a
   convex curve, because the mean normals of successive patches turn in one direction. The rises add
   up to more than the height of the true surface, most of it near the apex. With level zones dz' is
   the true rise, the outward part is that over the other rise times the patch's, and rows lie on
   the meridian stretched by mu across the axis: facets are closer to the true surface, but their
   normals are not those means.

   Numbers. A = patch area, A' = facet area = |(X', V)|, n' = (X', V)/A', gamma = turn:
       mean of 1 - cos gamma = D = 1 - (X X' + V V) / (A A');
       |mean of sin gamma, as a vector| = |V (X' - X)| / (A A') = T;
       sin^2(gamma/2) = sin^2((psi - nu)/2) + cos psi cos nu sin^2(phi/2), psi and nu the elevations
       of true and facet normal, phi the azimuth from the sector's middle: bounds gamma by `turn`;
       gamma^2 <= q 4 sin^2(gamma/2) = 2 q (1 - cos gamma), q = (turn/2)^2 / sin^2(turn/2), as
       x / sin x grows: rms_turn^2 = (A/A') 2 q D;
       gamma - sin gamma <= gamma^3/6: bias = (A/A') T + turn rms_turn^2 / 6.
   Each is evaluated to a few units of rounding; LRCSI_REVOLUTION_SLACK covers those. `rounding`
   then adds what rounding the vertices does to a facet's plane and area. */
#include "mesh/shape/revolution.h"

#include <math.h>

#include "base/constant.h"
#include "mesh/shape/patch_bounds.h"

/* A paraboloid's slope is clamped to these limits. It exceeds them only if the radius or the length
   is below 1e-300 of the other: a flatter one is flat, and a narrower one is indistinguishable from
   a line. */
#define PARABOLOID_SLOPE_MIN 1e-300
#define PARABOLOID_SLOPE_MAX 1e300
/* An upper bound of the absolute error of a subnormal coordinate. */
#define SUBNORMAL_ERR 1e-322

/* x - sin x for 0 <= x <= pi/2, to 4 units: the alternating series, 12 terms (pi/2^27 / 27! is
   below 2^-70 of x^3/6). */
static double angle_minus_sine(double x)
{
    double square = x * x;
    double sum = 0.0;
    for (int k = 26; k >= 4; k -= 2) {
        sum = square / (k * (k + 1)) * (1.0 - sum);
    }
    return x * square / 6.0 * (1.0 - sum);
}

int lrcsi_revolution_is_straight(const lrcsi_revolution *body)
{
    return body->kind == LRCS_SHAPE_CYLINDER || body->kind == LRCS_SHAPE_CONE ||
           body->kind == LRCS_SHAPE_FRUSTUM;
}

double lrcsi_revolution_polar(const lrcsi_revolution *body, uint32_t i)
{
    return (double)(body->zones - i) * body->step;
}

double lrcsi_revolution_tangent(const lrcsi_revolution *body, uint32_t i)
{
    return i == 0 ? body->slope : i == body->zones ? 0.0 : tan(lrcsi_revolution_polar(body, i));
}

double lrcsi_revolution_fraction(const lrcsi_revolution *body, uint32_t i)
{
    if (body->slope > 0.0) {
        return lrcsi_revolution_tangent(body, i) / body->slope;
    }
    return (double)(body->zones - i) / (double)body->zones;
}

double lrcsi_revolution_height(const lrcsi_revolution *body, uint32_t i)
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

static lrcsi_zone zone_straight(const lrcsi_revolution *body)
{
    double fall = body->base - body->top;
    double slant = hypot(fall, body->height);
    double unit = slant > 0.0 ? slant : 1.0;
    double elevation = atan2(fall, body->height);
    double sinc = sin(body->half) / body->half;
    return (lrcsi_zone){.area = slant / unit,
                        .across = sinc * body->height / unit,
                        .up = fall / unit,
                        .gain = body->vertex_ratio,
                        .low = elevation,
                        .high = elevation};
}

/* In units of the zone's area: with theta its middle and d its width on the meridian,
   A = 2 sin theta sin(d/2), V = A cos theta cos(d/2),
   Int rho dz = ((d - sin d) + 2 sin^2 theta sin d) / 2. */
static lrcsi_zone zone_round(const lrcsi_revolution *body, uint32_t i)
{
    double d = body->step;
    double theta = lrcsi_revolution_polar(body, i) - 0.5 * d;
    double sinc = sin(body->half) / body->half;
    double outward =
        angle_minus_sine(d) / (4.0 * sin(theta) * sin(0.5 * d)) + sin(theta) * cos(0.5 * d);
    return (lrcsi_zone){.area = 1.0,
                        .across = sinc * outward,
                        .up = cos(theta) * cos(0.5 * d),
                        .gain = 1.0,
                        .low = 0.5 * LRCS_PI - lrcsi_revolution_polar(body, i),
                        .high = 0.5 * LRCS_PI - lrcsi_revolution_polar(body, i + 1)};
}

/* y = tan of the angle from the top = slope rho/R, y1 below, y0 = t y1 above. In units of
   2 h R^2 y1 (y1 - y0) / slope^2:
   A from Int y sqrt(1 + y^2) dy = (q^3 - p^3)/3 with q, p = sqrt(1 + y^2), r = p/q and
       q - p = (y1^2 - y0^2)/(q + p);
   X = sinc y1 (1 + t + t^2) / 3; V = (1 + t) / 2. */
static lrcsi_zone zone_paraboloid(const lrcsi_revolution *body, uint32_t i)
{
    double y1 = lrcsi_revolution_tangent(body, i);
    double y0 = lrcsi_revolution_tangent(body, i + 1);
    double t = lrcsi_revolution_fraction(body, i + 1) / lrcsi_revolution_fraction(body, i);
    double q = hypot(1.0, y1);
    double r = hypot(1.0, y0) / q;
    double sinc = sin(body->half) / body->half;
    return (lrcsi_zone){.area = (1.0 + t) * q * (1.0 + r + r * r) / (3.0 * (1.0 + r)),
                        .across = sinc * y1 * (1.0 + t + t * t) / 3.0,
                        .up = 0.5 * (1.0 + t),
                        .gain = 1.0,
                        .low = atan2(1.0, y1),
                        .high = atan2(1.0, y0)};
}

double lrcsi_revolution_level_rise(const lrcsi_revolution *body, uint32_t i)
{
    if (body->kind == LRCS_SHAPE_PARABOLOID) {
        double x1 = lrcsi_revolution_fraction(body, i);
        double x0 = lrcsi_revolution_fraction(body, i + 1);
        return body->height * (x1 - x0) * (x1 + x0);
    }
    double theta = lrcsi_revolution_polar(body, i) - 0.5 * body->step;
    return body->height * (2.0 * sin(theta) * sin(0.5 * body->step));
}

/* The rise for which the facets' normal is the mean normal of the patch. */
static double mean_rise(const lrcsi_revolution *body, uint32_t i)
{
    if (body->kind == LRCS_SHAPE_PARABOLOID) {
        double x1 = lrcsi_revolution_fraction(body, i);
        double x0 = lrcsi_revolution_fraction(body, i + 1);
        double t = x0 / x1;
        double cubes = x1 * (1.0 + t + t * t) / (1.0 + t);
        return body->height * (4.0 / 3.0) * (x1 - x0) * cubes / body->vertex_ratio;
    }
    double d = body->step;
    double theta = lrcsi_revolution_polar(body, i) - 0.5 * d;
    double twice = angle_minus_sine(d) + 2.0 * sin(theta) * sin(theta) * sin(d);
    return body->height * twice / (2.0 * sin(theta) * cos(0.5 * d)) / body->vertex_ratio;
}

lrcsi_zone lrcsi_zone_make(const lrcsi_revolution *body, uint32_t i)
{
    if (lrcsi_revolution_is_straight(body)) {
        return zone_straight(body);
    }
    lrcsi_zone zone =
        body->kind == LRCS_SHAPE_PARABOLOID ? zone_paraboloid(body, i) : zone_round(body, i);
    if (body->level_zones) {
        double rise = mean_rise(body, i);
        zone.gain = rise > 0.0 ? lrcsi_revolution_level_rise(body, i) / rise : 1.0;
    }
    return zone;
}

/* A corner displaced by e rotates its facet by at most e divided by the altitude through that
   corner, and changes its area by at most that fraction. Coordinates have a relative error of at
   most e (straight walls have exact z); all corners of a row have the same z. Let l be the slant
   height. Two corners of a facet lie on a row of radius r, with altitudes of at least w l / (w +
   l), w >= 2 r sin h (r divided by that is at most 1/(2 sin h) + r/l); the altitude of the third is
   l. Rows of equal radius have the same x and y, so that only the error along the row remains. */
double lrcsi_revolution_rounding(const lrcsi_revolution *body, uint32_t i)
{
    double below = lrcsi_revolution_radius(body, i);
    double above = lrcsi_revolution_radius(body, i + 1);
    double kappa = body->vertex_ratio * cos(body->half);
    double slant = hypot(kappa * (below - above), lrcsi_revolution_rise(body, i));
    double e = (16.0 + (double)body->zones) * LRCSI_U;
    double along = 1.0 / sin(body->half);
    double narrow = above > 0.0 ? fmin(below, above) : below;
    double rounding = e * along;
    if (below > 0.0 || above > 0.0) {
        rounding += SUBNORMAL_ERR / (narrow > 0.0 ? narrow : above) * along;
    }
    if (slant > 0.0 && below != above) {
        rounding += 3.0 * (e * fmax(below, above) + SUBNORMAL_ERR) / slant;
    }
    if (slant > 0.0 && !lrcsi_revolution_is_straight(body)) {
        rounding += 2.0 * (e * body->height + SUBNORMAL_ERR) / slant;
    }
    return rounding;
}

static lrcs_patch_bounds zone_patch_bounds(const lrcsi_revolution *body, uint32_t i)
{
    lrcsi_zone s = lrcsi_zone_make(body, i);
    double across = s.gain * s.across; /* X' */
    double facet = hypot(across, s.up);
    lrcs_patch_bounds c = {0.0, 0.0, 0.0, 0.0};
    if (!(facet > 0.0)) { /* no area: no error */
        return c;
    }
    double nu = atan2(s.up, across);
    double elevation =
        fmax(fabs(s.low - nu), fabs(s.high - nu)) + LRCSI_REVOLUTION_SLACK; /* largest difference */
    double nearest = fmax(0.0, fmin(fabs(s.low), fabs(s.high)) - LRCSI_REVOLUTION_SLACK);
    double level = s.low * s.high <= 0.0 ? 1.0 : cos(nearest);
    double a = sin(0.5 * elevation);
    double b = sin(0.5 * body->half);
    c.turn = 2.0 * asin(fmin(1.0, sqrt(a * a + level * cos(nu) * b * b))) + LRCSI_REVOLUTION_SLACK;
    double x = 0.5 * c.turn;
    double q = x / sin(x) * (x / sin(x));
    double ratio = s.area / facet;
    double mean_cosine = (s.across / s.area) * (across / facet) + (s.up / s.area) * (s.up / facet);
    c.rms_turn = sqrt(ratio * 2.0 * q * (fmax(0.0, 1.0 - mean_cosine) + LRCSI_REVOLUTION_SLACK));
    double shift = (s.gain - 1.0) * (s.across / facet) * (fabs(s.up) / facet);
    c.bias = fabs(shift) + c.turn * c.rms_turn * c.rms_turn / 6.0;
    c.area_err = fabs(ratio - 1.0);
    return lrcsi_patch_bounds_rounded(&c, lrcsi_revolution_rounding(body, i) * (1.0 + c.area_err) +
                                              LRCSI_REVOLUTION_SLACK);
}

lrcsi_revolution lrcsi_revolution_make(const lrcs_shape *shape, const lrcs_divisions *divisions)
{
    double h = LRCS_PI / (double)divisions->around;
    lrcsi_revolution body = {.kind = shape->kind,
                             .base = shape->radius,
                             .around = divisions->around,
                             .zones = divisions->along,
                             .level_zones = divisions->level_zones,
                             .half = h,
                             .vertex_ratio = sqrt(2.0 * h / sin(2.0 * h))};
    double zones = (double)divisions->along;
    if (shape->kind == LRCS_SHAPE_DISC) {
        body.zones = 0;
    } else if (shape->kind == LRCS_SHAPE_CYLINDER) {
        body.top = shape->radius;
        body.height = shape->length;
    } else if (shape->kind == LRCS_SHAPE_FRUSTUM) {
        body.base = shape->radius2;
        body.top = shape->radius;
        body.height = shape->length;
    } else if (shape->kind == LRCS_SHAPE_CONE) {
        body.height = shape->half_angle_deg > 0.0
                          ? shape->radius / tan(shape->half_angle_deg * LRCS_RADIANS_PER_DEGREE)
                          : shape->length;
    } else if (shape->kind == LRCS_SHAPE_PARABOLOID) {
        body.height = shape->length;
        double slope = shape->radius > 0.0 ? 2.0 * (shape->length / shape->radius) : 0.0;
        body.slope = slope < PARABOLOID_SLOPE_MIN ? 0.0 : fmin(slope, PARABOLOID_SLOPE_MAX);
        body.step = atan(body.slope) / zones;
    } else {
        body.height = shape->radius;
        body.step = 0.5 * LRCS_PI / zones;
    }
    return body;
}

double lrcsi_revolution_radius(const lrcsi_revolution *body, uint32_t i)
{
    if (i == 0) {
        return body->base;
    }
    if (i == body->zones) {
        return body->top;
    }
    if (body->kind == LRCS_SHAPE_PARABOLOID) {
        return body->base * lrcsi_revolution_fraction(body, i);
    }
    return body->base * sin(lrcsi_revolution_polar(body, i));
}

double lrcsi_revolution_rise(const lrcsi_revolution *body, uint32_t i)
{
    if (lrcsi_revolution_is_straight(body)) {
        return body->height;
    }
    return body->level_zones ? lrcsi_revolution_level_rise(body, i) : mean_rise(body, i);
}

lrcs_patch_bounds lrcsi_revolution_patch_bounds(const lrcsi_revolution *body)
{
    lrcs_patch_bounds bound = {0.0, 0.0, 0.0, 0.0};
    for (uint32_t i = 0; i < body->zones; i++) {
        lrcs_patch_bounds c = zone_patch_bounds(body, i);
        bound.turn = fmax(bound.turn, c.turn);
        bound.area_err = fmax(bound.area_err, c.area_err);
        bound.bias = fmax(bound.bias, c.bias);
        bound.rms_turn = fmax(bound.rms_turn, c.rms_turn);
    }
    return bound;
}
