/* SPDX-License-Identifier: MIT */
/* Evaluates what the header states. The shape is placed without distortion, so that the axes of the
   view are perpendicular unit vectors in the shape's frame too.

   Rounding. Coordinates in the shape's frame have errors of at most position_err: a few products
   and sums of numbers below the distances that it is made of, and the error of the part's position.
   An error of the view coordinates x, y moves the point by at most 1 / cos(theta) times as much
   along d. So the relative error of g is at most position_err (1 + 1 / cos(theta)) / |g|, beyond
   that of its products. */
#include "integrate/wall/round_surface.h"

#include <math.h>

#include "base/elementary.h"
#include "base/length.h"
#include "base/outward.h"
#include "base/vec3.h"
#include "integrate/wall/patch.h"
#include "optics/closed.h"
#include "optics/reflect.h"

/* The largest delta, as a fraction of S^2. */
#define DELTA_MAX 0.9

/* D v. */
static void by_diagonal(const lrcsi_round_surface *surface, const double v[3], double out[3])
{
    out[0] = v[0];
    out[1] = v[1];
    out[2] = surface->alpha * v[2];
}

lrcsi_round_surface lrcsi_round_surface_make(const lrcsi_view *view, uint32_t index, int side)
{
    const lrcs_prepared *p = view->prepared;
    const lrcs_part *part = &p->scene->part[index];
    const double unit = ldexp(part->unit, -p->exponent);
    const double radius = part->shape.radius * unit;
    const double height = lrcsi_closed_length(&part->shape) * unit;
    lrcsi_round_surface s = {.part = part, .alpha = 1, .gamma = -radius * radius, .side = side};
    if (part->kind == LRCS_SHAPE_PARABOLOID) {
        s.alpha = 0;
        s.beta = 0.5 * radius * (radius / height);
    }
    double from[3];
    double distance = 0;
    for (int k = 0; k < 3; k++) {
        double origin = ldexp(part->origin[k], -p->exponent);
        from[k] = p->origin[k] - origin;
        distance += fabs(origin) + fabs(p->origin[k]);
    }
    for (int i = 0; i < 3; i++) {
        s.origin[i] = lrcsi_vec3_dot(part->axis[i], from);
        const double sign = i == 2 ? s.side : 1;
        s.view[i] = -sign * lrcsi_vec3_dot(view->R[i], from);
        for (int k = 0; k < 3; k++) {
            s.axis[k][i] = (k == 2 ? s.side : 1) * lrcsi_vec3_dot(part->axis[i], view->R[k]);
        }
    }
    double d[3];
    by_diagonal(&s, s.axis[2], d);
    s.a = lrcsi_vec3_dot(s.axis[2], d);
    s.in_plane = lrcsi_length_flat(lrcsi_vec3_dot(s.axis[0], d), lrcsi_vec3_dot(s.axis[1], d));
    s.position_err = 64 * LRCSI_U * (distance + 2 * (radius + height)) +
                     2 * ldexp(part->bounds.position_err, -p->exponent);
    return s;
}

int lrcsi_round_point_make(const lrcsi_round_surface *surface, const double x[2],
                           lrcsi_round_point *point)
{
    const double *d = surface->axis[2];
    double X[3];
    double product[3];
    for (int k = 0; k < 3; k++) {
        X[k] = surface->origin[k] + x[0] * surface->axis[0][k] + x[1] * surface->axis[1][k];
    }
    by_diagonal(surface, X, product);
    double b = lrcsi_vec3_dot(d, product) + surface->beta * d[2];
    double c = lrcsi_vec3_dot(X, product) + 2 * surface->beta * X[2] + surface->gamma;
    double root = sqrt(b * b - surface->a * c);
    if (!(root > 0)) {
        return 0;
    }
    double t = b > 0 ? -c / (b + root) : (root - b) / surface->a;
    for (int k = 0; k < 3; k++) {
        point->X[k] = X[k] + t * d[k];
    }
    by_diagonal(surface, point->X, point->g);
    point->g[2] += surface->beta;
    point->x[0] = x[0];
    point->x[1] = x[1];
    point->s = lrcsi_vec3_dot(point->g, d);
    point->length = sqrt(lrcsi_vec3_dot(point->g, point->g));
    return point->s > 0 && isfinite(point->length);
}

double lrcsi_round_height(const lrcsi_round_surface *surface, const lrcsi_round_point *point)
{
    return surface->view[2] + lrcsi_vec3_dot(point->X, surface->axis[2]);
}

/* The relative error of g. */
static double gradient_err(const lrcsi_round_surface *surface, double length, double s)
{
    return 2 * LRCSI_PATCH_NORMAL_ERR + surface->position_err / length * (1 + length / s);
}

lrcsi_round_value lrcsi_round_value_make(const lrcsi_round_surface *surface, const lrcs_brdf *brdf,
                                         const lrcsi_round_point *point, const double v[2])
{
    const lrcsi_round_value unknown = {HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL};
    const double *d = surface->axis[2];
    double move[3];
    double product[3];
    for (int k = 0; k < 3; k++) {
        move[k] = v[0] * surface->axis[0][k] + v[1] * surface->axis[1][k];
    }
    by_diagonal(surface, move, product);
    double b = point->s + lrcsi_vec3_dot(d, product);
    double c = 2 * lrcsi_vec3_dot(point->g, move) + lrcsi_vec3_dot(move, product);
    double root = sqrt(b * b - surface->a * c);
    double t = -c / (b + root);
    double g[3];
    for (int k = 0; k < 3; k++) {
        move[k] += t * d[k];
    }
    by_diagonal(surface, move, g);
    for (int k = 0; k < 3; k++) {
        g[k] += point->g[k];
    }
    double x = lrcsi_vec3_dot(g, surface->axis[0]);
    double y = lrcsi_vec3_dot(g, surface->axis[1]);
    double square = x * x + y * y;
    double u = square / (root * root);
    double length = sqrt(square + root * root);
    double secant = length / root;
    double g_err = gradient_err(surface, length, root);
    double secant_err = 2 * g_err * secant;
    if (!(root > 0) || !isfinite(u) || !(secant_err < 0x1p-10)) {
        return unknown;
    }
    const lrcsi_term_errors err =
        lrcsi_patch_term_errors(brdf, g_err, u, 1 / secant, sqrt(square) / length);
    const double glint_err = err.glint + secant_err;
    const double diffuse_err = err.diffuse + secant_err;
    lrcsi_reflection at = lrcsi_reflect(brdf, u, 0);
    if (!(glint_err <= 0.5 && diffuse_err <= 0.5)) {
        return unknown;
    }
    return (lrcsi_round_value){
        .glint = secant * at.glint,
        .diffuse = secant * at.diffuse,
        .error = 2 * secant * (at.error + at.glint * glint_err + at.diffuse * diffuse_err),
        .u = u};
}

double lrcsi_round_bound(const lrcsi_round_surface *surface, const lrcs_brdf *brdf,
                         const lrcsi_round_point *point, double e)
{
    const double s = point->s;
    const double across = lrcsi_length_flat(surface->axis[0][2], surface->axis[1][2]);
    const double steepest = lrcsi_length_flat(lrcsi_vec3_dot(point->g, surface->axis[0]),
                                              lrcsi_vec3_dot(point->g, surface->axis[1]));
    const double rounding =
        4 * gradient_err(surface, point->length, s) * point->length * point->length;
    e = e * LRCSI_OUTWARD_MICRO + surface->position_err;
    double db = e * surface->in_plane; /* bound on |b - S| */
    double c = 2 * e * steepest + e * e;
    double delta = (2 * s * db + db * db + surface->a * c) * LRCSI_OUTWARD_MICRO + rounding;
    if (!(delta < DELTA_MAX * s * s)) {
        return HUGE_VAL;
    }
    double least = s - db + sqrt(s * s - delta); /* bound on |b + S'|, from below */
    if (!(least > 0)) {
        return HUGE_VAL;
    }
    double dz = e * across + c / least * fabs(surface->axis[2][2]);
    double eta = 2 * surface->beta * dz * LRCSI_OUTWARD_MICRO + rounding;
    double w = point->length / s * (point->length / s);
    double u = steepest / s * (steepest / s);
    double omega = (eta + w * delta) / (s * s - delta) * LRCSI_OUTWARD_MICRO;
    if (!(omega <= 0.5 * w)) {
        return HUGE_VAL;
    }
    double bound = 0;
    if (brdf->A > 0) {
        double most = w + omega;
        double change = (omega - u) / (brdf->s * brdf->s);
        bound += brdf->A * most * most * sqrt(most) * lrcsi_exp(change + 1e-12 * fabs(change));
    }
    if (brdf->B > 0) {
        double power = 0.5 * (brdf->m + 1);
        bound += brdf->B * lrcsi_exp(-power * lrcsi_log(w - omega).hi + 1e-12 * power);
    }
    return bound * LRCSI_OUTWARD_MICRO;
}
