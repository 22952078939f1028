/* SPDX-License-Identifier: MIT */
/* sigma of a shape alone. It decides which faces each shape has (plane faces, caps, one curved
   wall) and checks the arguments; the curved walls are in closed_cone.c and closed_cap.c. The
   bodies are convex: every point that faces the laser is lit. */
#include <math.h>

#include "base/constant.h"
#include "base/degrees.h"
#include "optics/closed.h"

/* For slopes in this range s^2 and s^4 are normal doubles, and so are products of lengths of at
   least CLOSED_LENGTH_MIN. */
#define CLOSED_SLOPE_MIN  0x1p-333
#define CLOSED_SLOPE_MAX  0x1p333
#define CLOSED_LENGTH_MIN 1e-150

static int laser_by_degrees(double deg, lrcsi_laser_direction *laser)
{
    if (!isfinite(deg)) {
        return LRCS_E_NUMBER;
    }
    if (deg < 0.0 || deg > 180.0) {
        return LRCS_E_ARGUMENT;
    }
    lrcsi_degrees_sincos_dd(deg, 0.0, &laser->aspect.sine, &laser->aspect.cosine);
    laser->s_hat[0] = laser->aspect.sine;
    laser->s_hat[1] = (lrcsi_dd){0.0, 0.0};
    laser->s_hat[2] = laser->aspect.cosine;
    laser->deg = deg;
    return LRCS_OK;
}

/* The length is taken of components scaled to about 1; one that is 2^-500 of the largest or less
   counts as 0 in squares. */
static int laser_by_direction(const lrcsi_dd direction[3], lrcsi_laser_direction *laser)
{
    double largest = 0.0;
    for (int i = 0; i < 3; i++) {
        if (!isfinite(direction[i].hi)) {
            return LRCS_E_NUMBER;
        }
        largest = fmax(largest, fabs(direction[i].hi));
    }
    if (!(largest > 0.0)) {
        return LRCS_E_ARGUMENT;
    }
    int shift = -ilogb(largest);
    lrcsi_dd d[3];
    for (int i = 0; i < 3; i++) {
        d[i] = (lrcsi_dd){scalbn(direction[i].hi, shift), scalbn(direction[i].lo, shift)};
    }
    lrcsi_dd side = lrcsi_closed_hypot(d[0], d[1]);
    lrcsi_dd length = lrcsi_closed_hypot(side, d[2]);
    for (int i = 0; i < 3; i++) {
        laser->s_hat[i] = lrcsi_dd_div(d[i], length);
    }
    laser->aspect.sine = lrcsi_dd_div(side, length);
    laser->aspect.cosine = laser->s_hat[2];
    laser->deg = -1.0;
    return LRCS_OK;
}

/* A plane face whose normal is +axis or -axis. */
static void closed_add_face(const lrcs_brdf *brdf, const lrcsi_laser_direction *laser, int axis,
                            int sign, double area, lrcsi_term_integrals *sum)
{
    lrcsi_angle theta = {
        lrcsi_closed_hypot(laser->s_hat[(axis + 1) % 3], laser->s_hat[(axis + 2) % 3]),
        laser->s_hat[axis]};
    if (sign < 0) {
        theta.cosine = lrcsi_dd_negate(theta.cosine);
    }
    if (axis == 2) { /* the aspect's sine is not rounded by a square and a root */
        theta.sine = laser->aspect.sine;
    }
    lrcsi_term_integrals face = lrcsi_closed_reflect(brdf, theta);
    lrcsi_closed_scale(&face, area, 4.0);
    lrcsi_closed_add(sum, &face);
}

static void closed_add_disc(const lrcs_brdf *brdf, const lrcsi_laser_direction *laser, int sign,
                            double radius, lrcsi_term_integrals *sum)
{
    closed_add_face(brdf, laser, 2, sign, LRCS_PI * radius * radius, sum);
}

/* Bodies with plane faces only, and the end discs of the others. */
static void closed_add_planes(const lrcs_shape *shape, const lrcs_brdf *brdf,
                              const lrcsi_laser_direction *laser, lrcsi_term_integrals *sum)
{
    int ends = shape->parts == LRCS_SHAPE_ALL;
    switch (shape->kind) {
    case LRCS_SHAPE_PLATE:
        closed_add_face(brdf, laser, 2, 1, shape->size[0] * shape->size[1], sum);
        break;
    case LRCS_SHAPE_DISC:
        closed_add_disc(brdf, laser, 1, shape->radius, sum);
        break;
    case LRCS_SHAPE_BOX:
        for (int axis = 0; axis < 3; axis++) {
            int sign = laser->s_hat[axis].hi < 0.0 ? -1 : 1;
            double area = shape->size[(axis + 1) % 3] * shape->size[(axis + 2) % 3];
            closed_add_face(brdf, laser, axis, sign, area, sum);
        }
        break;
    case LRCS_SHAPE_CYLINDER:
        closed_add_disc(brdf, laser, 1, ends ? shape->radius : 0.0, sum);
        closed_add_disc(brdf, laser, -1, ends ? shape->radius : 0.0, sum);
        break;
    case LRCS_SHAPE_FRUSTUM:
        closed_add_disc(brdf, laser, 1, ends ? shape->radius : 0.0, sum);
        closed_add_disc(brdf, laser, -1, ends ? shape->radius2 : 0.0, sum);
        break;
    case LRCS_SHAPE_DOME:
    case LRCS_SHAPE_CONE:
    case LRCS_SHAPE_PARABOLOID:
        closed_add_disc(brdf, laser, -1, ends ? shape->radius : 0.0, sum);
        break;
    default:
        break;
    }
}

static void closed_add_wall(const lrcs_shape *shape, const lrcs_brdf *brdf,
                            const lrcsi_laser_direction *laser, lrcsi_term_integrals *sum)
{
    lrcsi_term_integrals wall = {{0.0, 0.0}, {0.0, 0.0}};
    switch (shape->kind) {
    case LRCS_SHAPE_SPHERE:
        wall = lrcsi_closed_sphere(shape, brdf);
        break;
    case LRCS_SHAPE_DOME:
        wall = lrcsi_closed_dome(shape, brdf, laser);
        break;
    case LRCS_SHAPE_CYLINDER:
        wall = lrcsi_closed_cylinder(shape, brdf, laser);
        break;
    case LRCS_SHAPE_CONE:
    case LRCS_SHAPE_FRUSTUM:
        wall = lrcsi_closed_cone(shape, brdf, laser);
        break;
    case LRCS_SHAPE_PARABOLOID:
        wall = lrcsi_closed_paraboloid(shape, brdf, laser);
        break;
    default:
        break;
    }
    lrcsi_closed_add(sum, &wall);
}

int lrcsi_closed_check(const lrcs_shape *shape, const lrcs_brdf *brdf)
{
    const double length[] = {shape->size[0], shape->size[1], shape->size[2],
                             shape->radius,  shape->radius2, shape->length};
    int status = lrcs_shape_check(shape, NULL);
    if (status != LRCS_OK) {
        return status;
    }
    for (int i = 0; i < 6; i++) {
        if (length[i] > 0.0 && length[i] < CLOSED_LENGTH_MIN) {
            return LRCS_E_NUMBER;
        }
    }
    status = lrcs_brdf_check(brdf);
    if (status < 0) {
        return status;
    }
    int slope_fits = brdf->s >= CLOSED_SLOPE_MIN && brdf->s <= CLOSED_SLOPE_MAX;
    return brdf->A > 0.0 && !slope_fits ? LRCS_E_NUMBER : LRCS_OK;
}

/* The integral of F over all that is lit. */
static lrcsi_term_integrals closed_sum(const lrcs_shape *shape, const lrcs_brdf *brdf,
                                       const lrcsi_laser_direction *laser)
{
    lrcsi_term_integrals sum = {{0.0, 0.0}, {0.0, 0.0}};
    closed_add_planes(shape, brdf, laser, &sum);
    closed_add_wall(shape, brdf, laser, &sum);
    return sum;
}

int lrcsi_closed_shape(const lrcs_shape *shape, const lrcs_brdf *brdf, const lrcsi_dd direction[3],
                       lrcsi_term_integrals *sum, double *silhouette)
{
    lrcsi_laser_direction laser;
    int status = laser_by_direction(direction, &laser);
    if (status == LRCS_OK) {
        *sum = closed_sum(shape, brdf, &laser);
        *silhouette = lrcsi_closed_silhouette(shape, laser.aspect.sine.hi, laser.aspect.cosine.hi);
    }
    return status;
}

int lrcs_closed_eval(const lrcs_shape *shape, const lrcs_brdf *brdf, const lrcs_aspect *aspect,
                     lrcs_closed_form *closed)
{
    int status = lrcsi_closed_check(shape, brdf);
    if (status != LRCS_OK) {
        return status;
    }
    lrcsi_laser_direction laser;
    lrcsi_dd direction[3];
    for (int i = 0; i < 3; i++) {
        direction[i] = (lrcsi_dd){aspect->direction[i], 0.0};
    }
    status = aspect->by_direction ? laser_by_direction(direction, &laser)
                                  : laser_by_degrees(aspect->deg, &laser);
    if (status != LRCS_OK) {
        return status;
    }
    lrcsi_term_integrals sum = closed_sum(shape, brdf, &laser);
    lrcsi_closed_scale(&sum, 4.0 * LRCS_PI, 1.0);
    lrcs_closed_form out = {0.0, sum.value[LRCSI_GLINT], sum.value[LRCSI_DIFFUSE], 0.0};
    out.sigma_m2 = out.sigma_glint_m2 + out.sigma_diffuse_m2;
    out.bound_m2 = sum.error[LRCSI_GLINT] + sum.error[LRCSI_DIFFUSE];
    /* the sums themselves, and products that are subnormal: 2^-1074 each */
    out.bound_m2 += out.bound_m2 > 0.0 ? 2.0 * LRCSI_U * out.sigma_m2 + 0x1p-1070 : 0.0;
    if (!isfinite(out.sigma_m2 + out.bound_m2)) {
        return LRCS_E_NUMBER;
    }
    *closed = out;
    return LRCS_OK;
}
