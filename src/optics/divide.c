/* SPDX-License-Identifier: MIT */
/* How many facets a curved body needs for its material: lrcs_shape_count. The count is estimated
   before any mesh exists. The proved error, from lrcs_patch_bounds and lrcsi_reflect_deviation, is
   evaluated for each pose on the mesh and does not depend on this estimate.

   The proved error of a body is 4 pi sum a_i deviation_i. Over fine facets the sum is an integral
   over the normals, which a fixed midpoint rule estimates:
   - round bodies (sphere, dome, paraboloid): over all normals about s_hat, with weight sin(theta),
     relative to the same integral of F, in which the whole glint is visible and which is also the
     body's mean over attitudes;
   - straight walls (cylinder, cone, frustum): over normals on a circle of constant elevation, at a
     set of aspects, relative to the wall's own sigma there or its mean over attitudes, whichever is
     larger.
   That ratio falls as 1 / around^2, and the smallest `around` that brings it to the tolerance is
   found by guesses for that law and by bisection.
   The constants of the rule and of the sample are choices: they decide how many facets there are,
   and no bound depends on them. */
#include <lrcs/shape.h>

#include <math.h>

#include "base/constant.h"
#include "mesh/shape/tessellate.h"
#include "optics/reflect.h"

#define AROUND_MIN   8u
#define DIVIDE_NODES 48  /* of the midpoint rule */
#define GLINT_WIDTHS 4.0 /* the glint is taken to extend over so many of its widths */
#define STEP_MAX     0.2 /* rad, the largest step between aspects near the glint or the rim */
/* The fraction of the tolerance that is used: errors between the sampled aspects may be larger. */
#define DIVIDE_AIM    0.8
#define DIVIDE_SAMPLE 1e-2 /* the tolerance at which dome and paraboloid are sampled */
#define DIVIDE_GUESS  16.0 /* first guess of around / 4 */
#define DIVIDE_TRIES  8    /* largest number of guesses */
#define FACETS_MIN    64u

/* A curved wall: its material, and how coarse its facets are. */
typedef struct divided_wall {
    const lrcs_brdf *brdf;
    lrcs_patch_bounds bounds;
} divided_wall;

/* For one direction: F and its deviation bound. */
typedef struct wall_value {
    double sigma, deviation;
} wall_value;

static wall_value wall_at(const divided_wall *wall, double cosine, double tan2)
{
    wall_value value = {0.0, lrcsi_reflect_deviation(wall->brdf, cosine, tan2, &wall->bounds)};
    if (cosine > 0.0) {
        lrcsi_reflection f = lrcsi_reflect(wall->brdf, tan2, 0.0);
        value.sigma = f.glint + f.diffuse;
    }
    return value;
}

/* Node k of a midpoint rule on [0, end] with half its nodes on [0, near]; its weight in *weight. */
static double midpoint_node(int k, double near, double end, double *weight)
{
    int half = DIVIDE_NODES / 2;
    double from = k < half ? 0.0 : near;
    double to = k < half ? near : end;
    *weight = (to - from) / half;
    return from + ((k % half) + 0.5) * *weight;
}

/* The extent of the glint: GLINT_WIDTHS times its width, or the facets' turn if that is wider. */
static double glint_extent(const divided_wall *wall, double end)
{
    double width = wall->brdf->A > 0.0 ? wall->brdf->s : 1.0;
    return fmin(GLINT_WIDTHS * fmax(width, wall->bounds.turn), 0.5 * end);
}

/* Mean over all normals of a sphere. */
static wall_value mean_over_sphere(const divided_wall *wall)
{
    wall_value sum = {0.0, 0.0};
    double end = fmin(0.5 * LRCS_PI + wall->bounds.turn, LRCS_PI);
    double narrow =
        fmin(GLINT_WIDTHS * (wall->brdf->A > 0.0 ? wall->brdf->s : 1.0), 0.25 * LRCS_PI);
    for (int k = 0; k < DIVIDE_NODES; k++) {
        double weight = 0.0;
        double theta = midpoint_node(k, glint_extent(wall, end), end, &weight);
        double slope = tan(theta);
        sum.deviation +=
            0.5 * sin(theta) * weight * wall_at(wall, cos(theta), slope * slope).deviation;
        theta = midpoint_node(k, narrow, 0.5 * LRCS_PI, &weight);
        slope = tan(theta);
        sum.sigma += 0.5 * sin(theta) * weight * wall_at(wall, cos(theta), slope * slope).sigma;
    }
    return sum;
}

/* Mean over the normals of elevation psi, the laser at angle alpha from the axis. */
static wall_value mean_over_circle(const divided_wall *wall, double psi, double alpha)
{
    wall_value sum = {0.0, 0.0};
    double near = glint_extent(wall, LRCS_PI);
    const double up[2] = {cos(psi), sin(psi)};
    const double laser[2] = {cos(alpha), sin(alpha)};
    for (int k = 0; k < DIVIDE_NODES; k++) {
        double weight = 0.0;
        double phi = midpoint_node(k, near, LRCS_PI, &weight);
        double cosine = up[1] * laser[0] + up[0] * laser[1] * cos(phi);
        double x = up[0] * sin(phi);
        double y = up[1] * laser[1] - up[0] * cos(phi) * laser[0];
        double tan2 = cosine == 0.0 ? HUGE_VAL : (x * x + y * y) / (cosine * cosine);
        wall_value value = wall_at(wall, cosine, tan2);
        sum.sigma += weight / LRCS_PI * value.sigma;
        sum.deviation += weight / LRCS_PI * value.deviation;
    }
    return sum;
}

/* The largest ratio over a set of aspects of a straight wall: 13 at every 15 deg, and 8 in half
   steps about the glint. */
static double straight_wall_error(const divided_wall *wall, const lrcs_shape *shape)
{
    double psi = shape->kind == LRCS_SHAPE_CYLINDER ? 0.0 /* elevation of the wall's normal */
                 : shape->kind == LRCS_SHAPE_FRUSTUM
                     ? atan2(shape->radius2 - shape->radius, shape->length)
                 : shape->half_angle_deg > 0.0 ? shape->half_angle_deg * LRCS_RADIANS_PER_DEGREE
                                               : atan2(shape->radius, shape->length);
    double mean = mean_over_sphere(wall).sigma;
    double glint = 0.5 * LRCS_PI - psi;
    double step = fmin(wall->brdf->s, STEP_MAX);
    double worst = 0.0;
    for (int k = 0; k < 21; k++) {
        double alpha = k < 13 ? k * LRCS_PI / 12.0 : glint + (k - 16) * 0.5 * step;
        if (alpha >= 0.0 && alpha <= LRCS_PI) {
            wall_value value = mean_over_circle(wall, psi, alpha);
            double base = fmax(value.sigma, mean);
            worst = fmax(worst, base > 0.0 ? value.deviation / base : 0.0);
        }
    }
    return worst;
}

/* Polar angle of the normal at the rim. */
static double rim_angle(const lrcs_shape *shape)
{
    return shape->kind == LRCS_SHAPE_PARABOLOID ? atan2(2.0 * shape->length, shape->radius)
                                                : 0.5 * LRCS_PI;
}

/* The largest ratio of a cap of normals over aspects: 4 up to the rim, and 4 in steps about it. At
   each aspect
   alpha the error and sigma are integrals over the cap, with nodes that are denser near alpha, on
   both sides of it; `size` is the area of the cap. */
static double cap_error(const divided_wall *wall, const lrcs_shape *shape)
{
    double mean = mean_over_sphere(wall).sigma;
    double rim = rim_angle(shape);
    double step = fmin(wall->brdf->s, STEP_MAX);
    double worst = 0.0;
    for (int i = 0; i < 8; i++) {
        double alpha = fmax(0.0, i < 4 ? 0.25 * i * rim : rim + (i - 6) * step);
        double middle = fmin(alpha, rim);
        double size = 0.0;
        wall_value sum = {0.0, 0.0};
        for (int k = 0; k < 2 * DIVIDE_NODES; k++) {
            double end = k < DIVIDE_NODES ? middle : rim - middle;
            double weight = 0.0;
            double offset = midpoint_node(k % DIVIDE_NODES, glint_extent(wall, end), end, &weight);
            double theta = k < DIVIDE_NODES ? middle - offset : middle + offset;
            double c = cos(theta);
            double area_per_angle = /* a paraboloid's area per solid angle of normals */
                shape->kind == LRCS_SHAPE_PARABOLOID ? 1.0 / (c * c * c * c) : 1.0;
            weight *= sin(theta) * area_per_angle;
            wall_value value = mean_over_circle(wall, 0.5 * LRCS_PI - theta, alpha);
            sum.sigma += weight * value.sigma;
            sum.deviation += weight * value.deviation;
            size += weight;
        }
        double base = fmax(sum.sigma, size * mean);
        worst = fmax(worst, base > 0.0 ? sum.deviation / base : 0.0);
    }
    return worst;
}

/* Zones as wide as the sectors are at the widest. */
static lrcs_divisions divisions_for(const lrcs_shape *shape, uint32_t around)
{
    lrcs_divisions divisions = {around, 1, 0};
    if (shape->kind == LRCS_SHAPE_PARABOLOID) {
        divisions.along = (uint32_t)fmax(1.0, ceil(rim_angle(shape) / (2.0 * LRCS_PI) * around));
    } else if (lrcsi_shape_is_round(shape->kind)) {
        divisions.along = around / 4;
    }
    return divisions;
}

static divided_wall divided_wall_make(const lrcs_shape *shape, const lrcs_brdf *brdf,
                                      uint32_t around)
{
    lrcs_divisions divisions = divisions_for(shape, around);
    return (divided_wall){brdf, lrcsi_tessellate_patch_bounds(shape, &divisions)};
}

/* The estimated relative error of a shape with that many facets around. */
static double shape_error(const lrcs_shape *shape, const lrcs_brdf *brdf, uint32_t around)
{
    divided_wall wall = divided_wall_make(shape, brdf, around);
    if (!lrcsi_shape_is_round(shape->kind)) {
        return straight_wall_error(&wall, shape);
    }
    wall_value value = mean_over_sphere(&wall);
    return value.sigma > 0.0 ? value.deviation / value.sigma : 0.0;
}

/* The largest `around` that max_facets allow, by bisection. */
static uint32_t most_around(const lrcs_shape *shape, uint32_t max_facets)
{
    uint32_t good = AROUND_MIN / 4;
    uint32_t bad = LRCSI_AROUND_MAX / 4 + 1;
    while (bad - good > 1) {
        uint32_t middle = good + (bad - good) / 2;
        lrcs_divisions divisions = divisions_for(shape, 4 * middle);
        if (lrcsi_tessellate_fits(shape, &divisions) &&
            lrcsi_tessellate_counts(shape, &divisions).facets <= max_facets) {
            good = middle;
        } else {
            bad = middle;
        }
    }
    return 4 * good;
}

/* The least `around` up to `around_max` that meets the tolerance, or `around_max`: guessed for an
   error that falls as 1 / around^2, or by bisection if the guesses do not converge. */
static uint32_t least_around(const lrcs_shape *shape, const lrcs_brdf *brdf, double tolerance,
                             uint32_t around_max)
{
    uint32_t bad = AROUND_MIN / 4 - 1;
    uint32_t good = around_max / 4;
    double guess = DIVIDE_GUESS;
    for (int tries = 0; good - bad > 1; tries++) {
        uint32_t halfway = bad + (good - bad) / 2;
        uint32_t at = tries > DIVIDE_TRIES || !(guess < good) ? halfway : (uint32_t)ceil(guess);
        at = at <= bad ? bad + 1 : at >= good ? good - 1 : at;
        double error = shape_error(shape, brdf, 4 * at);
        if (error <= tolerance) {
            good = at;
        } else {
            bad = at;
        }
        guess = at * sqrt(error / tolerance);
    }
    return 4 * good;
}

/* A disc's polygon has the disc's area for any number of corners. Between the two outlines lies the
   fraction 4 h^2 / (9 sqrt 3) = 0.2566 h^2 of it, h = pi/N, the mean of |2 (r/R - 1)| with
   r = R (1 - h^2/6 + phi^2/2), |phi| <= h: the tolerance bounds that. */
static uint32_t disc_around(double tolerance, uint32_t around_max)
{
    double corners = LRCS_PI * sqrt(0.2566 / tolerance); /* 4 / (9 sqrt 3), rounded */
    if (!(corners < around_max)) {
        return around_max;
    }
    uint32_t around = 4 * (uint32_t)ceil(corners / 4.0);
    return around < AROUND_MIN ? AROUND_MIN : around > around_max ? around_max : around;
}

/* The least number for a tolerance, of a shape with a curved wall. If even `around_max` leaves an
   error as large as sigma itself, more facets do not help: the glint is ignored, and the diffuse
   term (or a matt surface, if there is none) determines the count. */
static uint32_t curved_around(const lrcs_shape *shape, const lrcs_fineness *fineness,
                              uint32_t around_max)
{
    lrcs_brdf brdf = fineness->brdf;
    if (around_max == AROUND_MIN) { /* no choice is left */
        return around_max;
    }
    if (brdf.A > 0.0 && !(shape_error(shape, &brdf, around_max) < 1.0)) {
        brdf.A = 0.0;
    }
    if (!(brdf.A > 0.0) && !(brdf.B > 0.0)) {
        brdf = (lrcs_brdf){0.0, 1.0, 1.0, 0.0};
    }
    double factor = 1.0; /* by which the error exceeds that of a sphere of the same fineness */
    if (shape->kind == LRCS_SHAPE_DOME || shape->kind == LRCS_SHAPE_PARABOLOID) {
        uint32_t around = least_around(shape, &brdf, DIVIDE_SAMPLE, around_max);
        divided_wall wall = divided_wall_make(shape, &brdf, around);
        double sphere = shape_error(shape, &brdf, around);
        double ratio = sphere > 0.0 ? cap_error(&wall, shape) / sphere : 1.0;
        factor = isfinite(ratio) ? fmax(1.0, ratio) : 1.0;
    }
    return least_around(shape, &brdf, DIVIDE_AIM * fineness->tolerance / factor, around_max);
}

lrcs_fineness lrcs_fineness_default(void)
{
    return (lrcs_fineness){1e-4, lrcs_brdf_default(), 1u << 21};
}

int lrcs_shape_count(const lrcs_shape *shape, const lrcs_fineness *fineness,
                     lrcs_divisions *divisions, lrcs_mesh_counts *counts)
{
    int status = lrcs_shape_check(shape, NULL);
    int warnings = lrcs_brdf_check(&fineness->brdf);
    if (status != LRCS_OK || warnings < 0) {
        return status != LRCS_OK ? status : warnings;
    }
    if (!isfinite(fineness->tolerance)) {
        return LRCS_E_NUMBER;
    }
    if (!(fineness->tolerance > 0.0) || fineness->max_facets < FACETS_MIN) {
        return LRCS_E_ARGUMENT;
    }
    lrcs_divisions chosen = {4, 1, 0};
    if (!lrcsi_shape_is_plane_faced(shape->kind)) {
        uint32_t around_max = most_around(shape, fineness->max_facets);
        uint32_t around = shape->kind == LRCS_SHAPE_DISC
                              ? disc_around(fineness->tolerance, around_max)
                              : curved_around(shape, fineness, around_max);
        chosen = divisions_for(shape, around);
    }
    *divisions = chosen;
    *counts = lrcsi_tessellate_counts(shape, &chosen);
    return LRCS_OK;
}
