/* SPDX-License-Identifier: MIT */
/* Bodies of revolution as facets: the positions of the rows of vertices, and proofs about the
   facets between them. It makes no mesh (tessellate.c does).

   Sectors. Every row is a regular N-gon. With h = pi/N its vertices are at mu = sqrt(2 h / sin 2h)
   times the true radius rho, and the middles of its sides at kappa = mu cos h times rho. The N-gon
   then has exactly the area pi rho^2 of its circle, so that discs, caps and bases are exact.

   Rings. Two neighbouring rows are joined by planar trapezoids, one for each sector, each cut into
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
   up to more than the height of the true surface, most of it near the apex. With level rings dz' is
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
   Each is evaluated to a few units of rounding; SLACK covers those. `rounding` then adds what
   rounding the vertices does to a facet's plane and area.

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
   With b a bound on rho^2 - r^2 (strip_excess), rho - r <= min(sqrt(b), b / (2 rho1), rho0 - rho1).
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
   on a paraboloid, where the meridian is at most H x^2 / 4 above its chord in a strip of width x R,
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
#include "mesh/profile.h"

#include <math.h>

#include "base/constant.h"

/* D is 1 minus a quotient of sums of positive products, computed with 20 roundings or functions
   accurate to 2 units; A/A' - 1 likewise. */
#define SLACK (64.0 * LRCSI_U)
/* A paraboloid's slope is clamped to these limits. It exceeds them only if the radius or the length
   is below 1e-300 of the other: a flatter one is flat, and a narrower one is indistinguishable from
   a line. */
#define PROFILE_SLOPE_MIN 1e-300
#define PROFILE_SLOPE_MAX 1e300
/* An upper bound of the absolute error of a subnormal coordinate. */
#define SUBNORMAL_ERR 1e-322
/* Facets that rounding changes by more than this fraction of themselves get UNBOUNDED numbers.
   These are finite, because they may be multiplied by a facet area of zero. */
#define ROUNDING_MAX 0x1p-6
#define UNBOUNDED    1e300
/* Covers the relative rounding error of a reach: its terms are positive and accurate to 1e-9, even
   if 2^24 rings make the differences between neighbours small. */
#define REACH_MARGIN (1.0 + 1e-6)

/* A strip's patch and facet: areas and vector areas, all in the same unit, which is arbitrary. */
typedef struct profile_strip {
    double area, across, up; /* A, X, V */
    double gain;             /* X' / X */
    double low, high;        /* elevation of the true normal on the lower and the upper circle */
} profile_strip;

/* For a profile that has strips. */
static int profile_straight(const lrcsi_profile *profile)
{
    return profile->kind == LRCS_SHAPE_CYLINDER || profile->kind == LRCS_SHAPE_CONE ||
           profile->kind == LRCS_SHAPE_FRUSTUM;
}

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

/* Angle on the meridian from the top to row i. */
static double profile_polar(const lrcsi_profile *profile, uint32_t i)
{
    return (double)(profile->strips - i) * profile->step;
}

/* Paraboloid: slope of the surface at row i, and its radius as a fraction of the base's. */
static double profile_tangent(const lrcsi_profile *profile, uint32_t i)
{
    return i == 0 ? profile->slope : i == profile->strips ? 0.0 : tan(profile_polar(profile, i));
}

static double profile_fraction(const lrcsi_profile *profile, uint32_t i)
{
    if (profile->slope > 0.0) {
        return profile_tangent(profile, i) / profile->slope;
    }
    return (double)(profile->strips - i) / (double)profile->strips;
}

static profile_strip strip_straight(const lrcsi_profile *profile)
{
    double fall = profile->base - profile->top;
    double slant = hypot(fall, profile->height);
    double unit = slant > 0.0 ? slant : 1.0;
    double elevation = atan2(fall, profile->height);
    double sinc = sin(profile->half) / profile->half;
    return (profile_strip){slant / unit, sinc * profile->height / unit,
                           fall / unit,  profile->vertex_ratio,
                           elevation,    elevation};
}

/* In units of the strip's area: with theta its middle and d its width on the meridian,
   A = 2 sin theta sin(d/2), V = A cos theta cos(d/2),
   Int rho dz = ((d - sin d) + 2 sin^2 theta sin d) / 2. */
static profile_strip strip_round(const lrcsi_profile *profile, uint32_t i)
{
    double d = profile->step;
    double theta = profile_polar(profile, i) - 0.5 * d;
    double sinc = sin(profile->half) / profile->half;
    double outward =
        angle_minus_sine(d) / (4.0 * sin(theta) * sin(0.5 * d)) + sin(theta) * cos(0.5 * d);
    return (profile_strip){1.0,
                           sinc * outward,
                           cos(theta) * cos(0.5 * d),
                           1.0,
                           0.5 * LRCS_PI - profile_polar(profile, i),
                           0.5 * LRCS_PI - profile_polar(profile, i + 1)};
}

/* y = tan of the angle from the top = slope rho/R, y1 below, y0 = t y1 above. In units of
   2 h R^2 y1 (y1 - y0) / slope^2:
   A from Int y sqrt(1 + y^2) dy = (q^3 - p^3)/3 with q, p = sqrt(1 + y^2), r = p/q and
       q - p = (y1^2 - y0^2)/(q + p);
   X = sinc y1 (1 + t + t^2) / 3; V = (1 + t) / 2. */
static profile_strip strip_paraboloid(const lrcsi_profile *profile, uint32_t i)
{
    double y1 = profile_tangent(profile, i);
    double y0 = profile_tangent(profile, i + 1);
    double t = profile_fraction(profile, i + 1) / profile_fraction(profile, i);
    double q = hypot(1.0, y1);
    double r = hypot(1.0, y0) / q;
    double sinc = sin(profile->half) / profile->half;
    return (profile_strip){(1.0 + t) * q * (1.0 + r + r * r) / (3.0 * (1.0 + r)),
                           sinc * y1 * (1.0 + t + t * t) / 3.0,
                           0.5 * (1.0 + t),
                           1.0,
                           atan2(1.0, y1),
                           atan2(1.0, y0)};
}

/* The rise between the true circles of rows i and i + 1 of a curved wall. */
static double level_rise(const lrcsi_profile *profile, uint32_t i)
{
    if (profile->kind == LRCS_SHAPE_PARABOLOID) {
        double x1 = profile_fraction(profile, i);
        double x0 = profile_fraction(profile, i + 1);
        return profile->height * (x1 - x0) * (x1 + x0);
    }
    double theta = profile_polar(profile, i) - 0.5 * profile->step;
    return profile->height * (2.0 * sin(theta) * sin(0.5 * profile->step));
}

/* The rise for which the facets' normal is the mean normal of the patch. */
static double mean_rise(const lrcsi_profile *profile, uint32_t i)
{
    if (profile->kind == LRCS_SHAPE_PARABOLOID) {
        double x1 = profile_fraction(profile, i);
        double x0 = profile_fraction(profile, i + 1);
        double t = x0 / x1;
        double cubes = x1 * (1.0 + t + t * t) / (1.0 + t);
        return profile->height * (4.0 / 3.0) * (x1 - x0) * cubes / profile->vertex_ratio;
    }
    double d = profile->step;
    double theta = profile_polar(profile, i) - 0.5 * d;
    double twice = angle_minus_sine(d) + 2.0 * sin(theta) * sin(theta) * sin(d);
    return profile->height * twice / (2.0 * sin(theta) * cos(0.5 * d)) / profile->vertex_ratio;
}

static profile_strip strip_make(const lrcsi_profile *profile, uint32_t i)
{
    if (profile_straight(profile)) {
        return strip_straight(profile);
    }
    profile_strip strip = profile->kind == LRCS_SHAPE_PARABOLOID ? strip_paraboloid(profile, i)
                                                                 : strip_round(profile, i);
    if (profile->level_rings) {
        double rise = mean_rise(profile, i);
        strip.gain = rise > 0.0 ? level_rise(profile, i) / rise : 1.0;
    }
    return strip;
}

/* A corner displaced by e rotates its facet by at most e divided by the altitude through that
   corner, and changes its area by at most that fraction. Coordinates have a relative error of at
   most e (straight walls have exact z); all corners of a row have the same z. Let l be the slant
   height. Two corners of a facet lie on a row of radius r, with altitudes of at least w l / (w +
   l), w >= 2 r sin h (r divided by that is at most 1/(2 sin h) + r/l); the altitude of the third is
   l. Rows of equal radius have the same x and y, so that only the error along the row remains. */
double lrcsi_profile_rounding(const lrcsi_profile *profile, uint32_t i)
{
    double below = lrcsi_profile_radius(profile, i);
    double above = lrcsi_profile_radius(profile, i + 1);
    double kappa = profile->vertex_ratio * cos(profile->half);
    double slant = hypot(kappa * (below - above), lrcsi_profile_rise(profile, i));
    double e = (16.0 + (double)profile->strips) * LRCSI_U;
    double along = 1.0 / sin(profile->half);
    double narrow = above > 0.0 ? fmin(below, above) : below;
    double rounding = e * along;
    if (below > 0.0 || above > 0.0) {
        rounding += SUBNORMAL_ERR / (narrow > 0.0 ? narrow : above) * along;
    }
    if (slant > 0.0 && below != above) {
        rounding += 3.0 * (e * fmax(below, above) + SUBNORMAL_ERR) / slant;
    }
    if (slant > 0.0 && !profile_straight(profile)) {
        rounding += 2.0 * (e * profile->height + SUBNORMAL_ERR) / slant;
    }
    return rounding;
}

static lrcs_curvature strip_curvature(const lrcsi_profile *profile, uint32_t i)
{
    profile_strip s = strip_make(profile, i);
    double across = s.gain * s.across; /* X' */
    double facet = hypot(across, s.up);
    lrcs_curvature c = {0.0, 0.0, 0.0, 0.0};
    if (!(facet > 0.0)) { /* no area: no error */
        return c;
    }
    double nu = atan2(s.up, across);
    double elevation = fmax(fabs(s.low - nu), fabs(s.high - nu)) + SLACK; /* largest difference */
    double nearest = fmax(0.0, fmin(fabs(s.low), fabs(s.high)) - SLACK);
    double level = s.low * s.high <= 0.0 ? 1.0 : cos(nearest);
    double a = sin(0.5 * elevation);
    double b = sin(0.5 * profile->half);
    c.turn = 2.0 * asin(fmin(1.0, sqrt(a * a + level * cos(nu) * b * b))) + SLACK;
    double x = 0.5 * c.turn;
    double q = x / sin(x) * (x / sin(x));
    double ratio = s.area / facet;
    double part = (s.across / s.area) * (across / facet) + (s.up / s.area) * (s.up / facet);
    c.rms_turn = sqrt(ratio * 2.0 * q * (fmax(0.0, 1.0 - part) + SLACK));
    double shift = (s.gain - 1.0) * (s.across / facet) * (fabs(s.up) / facet);
    c.bias = fabs(shift) + c.turn * c.rms_turn * c.rms_turn / 6.0;
    c.area_err = fabs(ratio - 1.0);
    return lrcsi_profile_rounded(&c,
                                 lrcsi_profile_rounding(profile, i) * (1.0 + c.area_err) + SLACK);
}

lrcsi_profile lrcsi_profile_make(const lrcs_shape *shape, const lrcs_divisions *divisions)
{
    double h = LRCS_PI / (double)divisions->around;
    lrcsi_profile profile = {.kind = shape->kind,
                             .base = shape->radius,
                             .around = divisions->around,
                             .strips = divisions->along,
                             .level_rings = divisions->level_rings,
                             .half = h,
                             .vertex_ratio = sqrt(2.0 * h / sin(2.0 * h))};
    double rings = (double)divisions->along;
    if (shape->kind == LRCS_SHAPE_DISC) {
        profile.strips = 0;
    } else if (shape->kind == LRCS_SHAPE_CYLINDER) {
        profile.top = shape->radius;
        profile.height = shape->length;
    } else if (shape->kind == LRCS_SHAPE_FRUSTUM) {
        profile.base = shape->radius2;
        profile.top = shape->radius;
        profile.height = shape->length;
    } else if (shape->kind == LRCS_SHAPE_CONE) {
        profile.height = shape->half_angle_deg > 0.0
                             ? shape->radius / tan(shape->half_angle_deg * (LRCS_PI / 180.0))
                             : shape->length;
    } else if (shape->kind == LRCS_SHAPE_PARABOLOID) {
        profile.height = shape->length;
        double slope = shape->radius > 0.0 ? 2.0 * (shape->length / shape->radius) : 0.0;
        profile.slope = slope < PROFILE_SLOPE_MIN ? 0.0 : fmin(slope, PROFILE_SLOPE_MAX);
        profile.step = atan(profile.slope) / rings;
    } else {
        profile.height = shape->radius;
        profile.step = 0.5 * LRCS_PI / rings;
    }
    return profile;
}

double lrcsi_profile_radius(const lrcsi_profile *profile, uint32_t i)
{
    if (i == 0) {
        return profile->base;
    }
    if (i == profile->strips) {
        return profile->top;
    }
    if (profile->kind == LRCS_SHAPE_PARABOLOID) {
        return profile->base * profile_fraction(profile, i);
    }
    return profile->base * sin(profile_polar(profile, i));
}

double lrcsi_profile_rise(const lrcsi_profile *profile, uint32_t i)
{
    if (profile_straight(profile)) {
        return profile->height;
    }
    return profile->level_rings ? level_rise(profile, i) : mean_rise(profile, i);
}

lrcs_curvature lrcsi_profile_curvature(const lrcsi_profile *profile)
{
    lrcs_curvature bound = {0.0, 0.0, 0.0, 0.0};
    for (uint32_t i = 0; i < profile->strips; i++) {
        lrcs_curvature c = strip_curvature(profile, i);
        bound.turn = fmax(bound.turn, c.turn);
        bound.area_err = fmax(bound.area_err, c.area_err);
        bound.bias = fmax(bound.bias, c.bias);
        bound.rms_turn = fmax(bound.rms_turn, c.rms_turn);
    }
    return bound;
}

/* The turn vector changes by at most gamma / sin gamma < 2 times the rotation. A facet that
   rounding moves by a large fraction of its own size has no meaningful numbers. */
lrcs_curvature lrcsi_profile_rounded(const lrcs_curvature *c, double rounding)
{
    if (!(rounding <= ROUNDING_MAX)) {
        return (lrcs_curvature){LRCS_PI, UNBOUNDED, UNBOUNDED, sqrt(UNBOUNDED)};
    }
    return (lrcs_curvature){fmin(c->turn + rounding, LRCS_PI), c->area_err + 2.0 * rounding,
                            c->bias + 2.0 * rounding, c->rms_turn + 2.0 * rounding};
}

/* A linear map takes normals n to N n / |N n|, N being its inverse transpose, and areas dA to
   |N n| dA times a constant; with facet normal f and k the ratio of N's singular values, as of the
   map's. Along the great circle from f to n, turned by t, N n = w(t) = u cos t + v sin t moves on
   an ellipse in one plane: the image is a great circle too. With C = |u x v| = |w x w'|:
     its angle psi has psi' = C / |w|^2 in 1/k .. k, and psi'' = -2 psi' (w.w')/|w|^2;
     (log|w|)' = (w.w')/|w|^2, at most g = (k - 1/k)/2 in size, so |psi''| <= 2 k g;
     (log|w|)'' = psi'^2 - 1 - ((w.w')/|w|^2)^2, at most 2 h = k^2 - 1 in size.
   So the turn vector tau, of length t, becomes D tau + r, |D| <= k, |r| <= k g t^2; and |N n| / |N
   f| = exp(x), |x - q.tau| <= h t^2, |q| <= g, |x| <= G t with G = g + h turn: with E = exp(G
   turn), |exp(x) - 1 - q.tau| <= (h + G^2 E / 2) t^2 and |exp(x) - 1| <= G E t. Integrated over the
   patch, per unit of facet, tau gives `bias` and t^2 rms_turn^2. If G turn exceeds 1, |N n| / |N f|
   within 1/k .. k is used instead. */
lrcs_curvature lrcsi_profile_stretched(const lrcs_curvature *c, double ratio, double *uneven)
{
    double k = fmax(1.0, ratio);
    double g = 0.5 * (k - 1.0 / k);
    double h = 0.5 * (k - 1.0) * (k + 1.0);
    double G = g + h * c->turn;
    double square = c->rms_turn * c->rms_turn;
    double turn = fmin(k * c->turn, LRCS_PI);
    double outward = 1.0 + SLACK;
    if (!(G * c->turn <= 1.0)) {
        double area = (1.0 + c->area_err) * k * outward;
        *uneven = k - 1.0;
        return (lrcs_curvature){turn, area, turn * area, turn * sqrt(area)};
    }
    double E = exp(G * c->turn);
    *uneven = (E - 1.0) * outward;
    return (lrcs_curvature){
        turn * outward, (c->area_err + g * c->bias + (h + 0.5 * G * G * E) * square) * outward,
        (k * c->bias + k * (g + G * E) * square) * outward, k * c->rms_turn * sqrt(E) * outward};
}

/* How far the polygon's vertices are outside the unit circle, and the middles of its sides inside.
 */
static double outward_ratio(const lrcsi_profile *profile)
{
    return profile->vertex_ratio - 1.0 + SLACK;
}

static double inward_ratio(const lrcsi_profile *profile)
{
    return fmax(0.0, 1.0 - profile->vertex_ratio * cos(profile->half)) + SLACK;
}

/* How far points of the unit disc move when their sector is mapped to a triangle of the N-gon. */
static lrcsi_reach sector_reach(const lrcsi_profile *profile)
{
    double h = profile->half;
    double kappa = profile->vertex_ratio * cos(h);
    double inward = fmax(1.0 - kappa, kappa - cos(h)) + SLACK;
    double tangential = fmax(h * h * h / 6.0, (profile->vertex_ratio - 1.0) * sin(h)) + SLACK;
    return (lrcsi_reach){
        .all = hypot(inward, tangential), .radial = inward, .tangential = tangential};
}

/* True height of row i. */
static double profile_height(const lrcsi_profile *profile, uint32_t i)
{
    if (i == 0 || i == profile->strips) {
        return i == 0 ? 0.0 : profile->height;
    }
    if (profile->kind == LRCS_SHAPE_PARABOLOID) {
        double x = profile_fraction(profile, i);
        return profile->height * ((1.0 - x) * (1.0 + x));
    }
    return profile->height * cos(profile_polar(profile, i));
}

/* An upper bound of rho^2 - r^2 within strip i. */
static double strip_excess(const lrcsi_profile *profile, uint32_t i)
{
    double below = lrcsi_profile_radius(profile, i);
    double above = lrcsi_profile_radius(profile, i + 1);
    double whole = (below - above) * (below + above);
    if (profile_straight(profile)) {
        return 0.0;
    }
    if (profile->kind != LRCS_SHAPE_PARABOLOID) {
        double d = profile->step;
        double fall = 2.0 * sin(profile_polar(profile, i) - 0.5 * d) * sin(0.5 * d);
        return fmin(whole, 0.25 * profile->height * fall * profile->height * fall);
    }
    double y1 = profile_tangent(profile, i);
    double y0 = profile_tangent(profile, i + 1);
    double q = hypot(1.0, y1);
    double p = hypot(1.0, y0);
    double longer = (y1 - y0) * ((y1 + y0) / (q + p)); /* q - p */
    double apart = longer * (2.0 * q + p) / (3.0 * (q + p));
    double unit = profile->slope > 0.0 ? profile->base / profile->slope : 0.0;
    double rise = unit * apart;
    return fmin(whole, rise * rise * (apart + 3.0 * p) / (3.0 * (apart + p))); /* ignores a NaN */
}

/* The largest distance between the meridian of strip i and its chord. */
static double strip_sagitta(const lrcsi_profile *profile, uint32_t i)
{
    if (profile_straight(profile)) {
        return 0.0;
    }
    if (profile->kind != LRCS_SHAPE_PARABOLOID) {
        double quarter = sin(0.25 * profile->step);
        return 2.0 * profile->height * quarter * quarter;
    }
    double wide = profile_fraction(profile, i) - profile_fraction(profile, i + 1);
    double rise = level_rise(profile, i);
    double slant = hypot(wide * profile->base, rise);
    double above = 0.25 * profile->height * wide * wide;
    return slant > 0.0 ? above * (wide * profile->base / slant) : above;
}

/* An upper bound of rho - r within strip i. */
static double strip_out(const lrcsi_profile *profile, uint32_t i)
{
    double below = lrcsi_profile_radius(profile, i);
    double above = lrcsi_profile_radius(profile, i + 1);
    double excess = strip_excess(profile, i);
    if (!(excess > 0.0)) {
        return 0.0;
    }
    double out = fmin(sqrt(excess), below - above);
    return above > 0.0 ? fmin(out, 0.5 * excess / above) : out;
}

/* How far points of strip i move, if its rows differ from their true heights by at most
   height_err. */
static lrcsi_reach strip_reach(const lrcsi_profile *profile, uint32_t i, double height_err)
{
    double below = lrcsi_profile_radius(profile, i);
    double above = lrcsi_profile_radius(profile, i + 1);
    double excess = strip_excess(profile, i);
    lrcsi_reach sector = sector_reach(profile);
    double out = strip_out(profile, i);
    double fraction = 0.0; /* the largest difference of fractions of the height */
    if (!profile_straight(profile) && below > above) {
        fraction = 0.25 * (below - above) / (below + above);
        if (profile->kind == LRCS_SHAPE_PARABOLOID) {
            fraction = fmax(fraction, excess / (below - above) / (below + above));
        }
    }
    double rise = profile_height(profile, i + 1) - profile_height(profile, i);
    double wide = fmax(below, above);
    double sagitta = strip_sagitta(profile, i);
    lrcsi_reach reach = {.radial = wide * sector.radial + out,
                         .axial = height_err + fmin(1.0, fraction) * rise,
                         .tangential = wide * sector.tangential + out * sin(profile->half)};
    reach.all = hypot(wide * sector.all + out, reach.axial);
    reach.solid = fmax(hypot(wide * outward_ratio(profile), height_err),
                       sagitta + hypot(wide * inward_ratio(profile), height_err));
    reach.surface =
        sagitta + hypot(wide * fmax(outward_ratio(profile), inward_ratio(profile)), height_err);
    return reach;
}

lrcsi_reach lrcsi_profile_reach(const lrcsi_profile *profile)
{
    double wide = fmax(profile->base, profile->top);
    lrcsi_reach bound = {.all = wide * sector_reach(profile).all,
                         .solid = wide * fmax(outward_ratio(profile), inward_ratio(profile))};
    double z = 0.0;
    double height_err = 0.0;
    for (uint32_t i = 0; i < profile->strips; i++) {
        double before = height_err;
        z += lrcsi_profile_rise(profile, i);
        height_err = fabs(z - profile_height(profile, i + 1));
        lrcsi_reach strip = strip_reach(profile, i, fmax(before, height_err));
        bound.all = fmax(bound.all, strip.all);
        bound.radial = fmax(bound.radial, strip.radial);
        bound.axial = fmax(bound.axial, strip.axial);
        bound.tangential = fmax(bound.tangential, strip.tangential);
        bound.solid = fmax(bound.solid, strip.solid);
        bound.surface = fmax(bound.surface, strip.surface);
    }
    bound.surface = fmax(bound.surface, bound.solid);
    double rounding = (32.0 + 2.0 * (double)profile->strips) * LRCSI_U * (wide + profile->height);
    return (lrcsi_reach){.all = bound.all * REACH_MARGIN + rounding,
                         .radial = bound.radial * REACH_MARGIN + rounding,
                         .axial = bound.axial * REACH_MARGIN + rounding,
                         .tangential = bound.tangential * REACH_MARGIN + rounding,
                         .solid = bound.solid * REACH_MARGIN + rounding,
                         .surface = bound.surface * REACH_MARGIN + rounding};
}

/* --- normals ---------------------------------------------------------------------------------- */

/* Let the patch have its normals at polar angles alpha and at azimuths phi = v h from the middle of
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
   the rows, the first term is S |1 - r/r'| |sin vh|, at most S D |sin vh| with D = |rho0 - rho1| /
   (rho0 + rho1). The mean of |1 - r/r'| over the patch, where r has a density in proportion to r,
   is D/2.

   Along, half the range of the difference of both sides.
   - Straight wall: along = 0; sin(alpha - nu) is constant.
   - Sphere: N is the position on the unit sphere, so with along = 1/R the difference is that of
     patch and facets along e_y,
         (rho cos vh - kappa r) cos nu - (z - z') sin nu.
     There rho - r is between 0 and strip_out, and (1 - kappa) r varies by |1 - kappa| (rho0 -
   rho1). With a and beta the fractions of the height, z - z' is a constant and (beta - a) dz + beta
   (dz'
     - dz), dz and dz' the rises of patch and facets; beta - a is between 0 and (rho0 - rho1) / (4
     (rho0 + rho1)).
   - Paraboloid: f = sin(alpha - nu) as a function of y = tan alpha has
         |f''| = |sin(alpha - nu) + 2 y cos(alpha - nu)| cos^4 alpha,
     so that it differs from its chord between both rows by at most (y1 - y0)^2 / 8 times the
     supremum of that. On the facets y_rim r/R is linear in the position along e_y, and takes the
     place of y, from which it differs by 0 .. y_rim strip_out / R. */

/* What depends on the shape: `across`, `along` and their errors, without the second term of N .
   e_y. Given: the rest. Returns the largest sin alpha. */
static double normals_straight(const lrcsi_profile *profile, uint32_t i, lrcsi_profile_normals *n)
{
    double below = lrcsi_profile_radius(profile, i);
    double above = lrcsi_profile_radius(profile, i + 1);
    double mean = 0.5 * (below + above);
    double h = profile->half;
    double sine = cos(strip_make(profile, i).low);
    double uneven = sine * fabs(below - above) / (below + above);
    double bent = sine * fmax(below, above) / mean * (h * h * h / 15.0);
    n->across = sine / (profile->vertex_ratio * mean);
    n->across_mean = 0.25 * h * uneven + bent;
    n->across_err = uneven * sin(h) + bent;
    return sine;
}

static double normals_paraboloid(const lrcsi_profile *profile, uint32_t i, lrcsi_profile_normals *n)
{
    double h = profile->half;
    double y1 = profile_tangent(profile, i);
    double y0 = profile_tangent(profile, i + 1);
    double low = 1.0 / hypot(1.0, y1); /* cos alpha */
    double high = 1.0 / hypot(1.0, y0);
    double shift = profile->slope * (strip_out(profile, i) / profile->base);
    profile_strip strip = strip_make(profile, i);
    double nu = atan2(n->cosine, n->sine);
    double elevation = fmax(fabs(strip.low - nu), fabs(strip.high - nu));
    double fall = sin(nu - strip.low) - sin(nu - strip.high);
    double second = (elevation + 2.0 * y1) * (high * high) * (high * high);
    double uneven = y1 * (0.5 * (high - low)) + high * shift;
    double bent = y1 * high * (h * h * h / 15.0);
    n->across = profile->slope / profile->base * (0.5 * (low + high)) / profile->vertex_ratio;
    n->along = fall / n->length;
    n->across_mean = 0.5 * h * uneven + bent;
    n->across_err = uneven * sin(h) + bent;
    n->along_err = 0.125 * (y1 - y0) * (y1 - y0) * second + 0.5 * shift * fabs(fall / (y1 - y0));
    return y1 * low;
}

static double normals_round(const lrcsi_profile *profile, uint32_t i, lrcsi_profile_normals *n)
{
    double below = lrcsi_profile_radius(profile, i);
    double above = lrcsi_profile_radius(profile, i + 1);
    double h = profile->half;
    double kappa = profile->vertex_ratio * cos(h);
    double unit = 1.0 / profile->base;
    double rise = level_rise(profile, i); /* of the patch */
    double out = strip_out(profile, i);
    double lag = 0.25 * (below - above) / (below + above) * rise +
                 fabs(lrcsi_profile_rise(profile, i) - rise);
    double sine = below * unit;
    double bent = sine * (h * h * h / 15.0);
    n->across = unit / profile->vertex_ratio;
    n->along = unit;
    n->across_mean = 0.5 * h * (out * unit) + bent;
    n->across_err = out * unit * sin(h) + bent;
    n->along_err =
        0.5 * unit *
        ((out + fabs(1.0 - kappa) * (below - above)) * fabs(n->cosine) + lag * fabs(n->sine));
    return sine;
}

lrcsi_profile_normals lrcsi_profile_normals_make(const lrcsi_profile *profile, uint32_t i)
{
    double h = profile->half;
    double below = lrcsi_profile_radius(profile, i);
    double above = lrcsi_profile_radius(profile, i + 1);
    profile_strip strip = strip_make(profile, i);
    double facet = hypot(strip.gain * strip.across, strip.up);
    lrcsi_profile_normals n = {.sine = strip.gain * strip.across / facet,
                               .cosine = strip.up / facet,
                               .width = profile->vertex_ratio * sin(h) * fmax(below, above),
                               .length = hypot(profile->vertex_ratio * cos(h) * (below - above),
                                               lrcsi_profile_rise(profile, i))};
    double sine = profile_straight(profile)                ? normals_straight(profile, i, &n)
                  : profile->kind == LRCS_SHAPE_PARABOLOID ? normals_paraboloid(profile, i, &n)
                                                           : normals_round(profile, i, &n);
    n.along_err += 0.5 * sine * fabs(n.cosine) * (2.0 * sin(0.5 * h) * sin(0.5 * h));
    double rounding = (64.0 + 4.0 * (double)profile->strips) * LRCSI_U;
    n.across_err = n.across_err * REACH_MARGIN + rounding;
    n.across_mean = n.across_mean * REACH_MARGIN + rounding;
    n.along_err = n.along_err * REACH_MARGIN + rounding;
    n.width *= REACH_MARGIN;
    n.length *= REACH_MARGIN;
    return n;
}
