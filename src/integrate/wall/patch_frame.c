/* SPDX-License-Identifier: MIT */
/* Evaluates what the header states. It does not decide how a patch is divided
   (integrate/wall/patch.c).
   Called: lrcsi_revolution_make, lrcsi_reflect. */
#include "integrate/wall/patch_frame.h"

#include <math.h>

#include "base/constant.h"
#include "base/elementary.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/vec3.h"
#include "mesh/shape/revolution.h"
#include "optics/reflect.h"

const double lrcsi_patch_radii[LRCSI_PATCH_RADII] = {1.2, 1.5, 2.2, 3.5, 6.0, 11.0};

/* M is not computed for a larger kappa, as a fraction of c: it would be of no use for the glint. */
#define SHIFT_MAX 0.98

const lrcs_part *lrcsi_patch_part(const lrcs_prepared *p, uint32_t facet)
{
    return &p->scene->part[p->scene->facet_part[facet]];
}

uint32_t lrcsi_patch_sector(const lrcs_prepared *p, uint32_t facet)
{
    uint32_t begin = lrcsi_patch_part(p, facet)->first_facet;
    return begin + ((facet - begin) & ~UINT32_C(1));
}

uint32_t lrcsi_patch_partner(const lrcs_prepared *p, uint32_t facet)
{
    uint32_t begin = lrcsi_patch_part(p, facet)->first_facet;
    return begin + ((facet - begin) ^ 1);
}

int lrcsi_patch_exists(const lrcs_prepared *p, uint32_t facet)
{
    const lrcs_part *part = lrcsi_patch_part(p, facet);
    return p->scene->facet_smooth[facet] != 0 && part->bounds.patch.turn > 0 &&
           part->normals_known && part->bounds.known;
}

/* u = tan^2 theta of a normal, given sine and cosine of its angle from the axis, and those of its
   azimuth; c, p and nu. */
static double patch_tan2(const lrcsi_patch_frame *f, double sine, double cosine,
                         const double azimuth[2], double *c, double *p, double *nu)
{
    const double given[3] = {sine * azimuth[1], sine * azimuth[0], cosine};
    double n[3] = {given[0], given[1], given[2]};
    const double *g = f->g;
    *nu = 1;
    if (f->axis) {
        for (int k = 0; k < 3; k++) {
            n[k] = given[0] * f->axis[0][k] + given[1] * f->axis[1][k] + given[2] * f->axis[2][k];
        }
        *nu = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    }
    double x = g[1] * n[2] - g[2] * n[1];
    double y = g[2] * n[0] - g[0] * n[2];
    double z = g[0] * n[1] - g[1] * n[0];
    double square = x * x + y * y + z * z;
    *c = g[0] * n[0] + g[1] * n[1] + g[2] * n[2];
    *p = sqrt(square);
    return square / (*c * *c);
}

/* The length of the image of a vector under H. */
static double image_length(const lrcsi_patch_frame *f, double x, double y, double z)
{
    double square = 0;
    for (int k = 0; k < 3; k++) {
        double image = x * f->axis[0][k] + y * f->axis[1][k] + z * f->axis[2][k];
        square += image * image;
    }
    return sqrt(square);
}

static void frame_middle(lrcsi_patch_frame *f)
{
    const double azimuth[2] = {sin(f->phi), cos(f->phi)};
    if (f->axis) {
        f->along_image = image_length(f, f->cosine * azimuth[1], f->cosine * azimuth[0], -f->sine);
        f->radial_image = image_length(f, azimuth[1], azimuth[0], 0);
        f->around_image = image_length(f, -azimuth[0], azimuth[1], 0);
    }
    f->u = patch_tan2(f, f->sine, f->cosine, azimuth, &f->c, &f->p, &f->nu);
}

void lrcsi_patch_direction(const lrcsi_patch_frame *f, double g[3])
{
    for (int k = 0; k < 3; k++) {
        g[k] = f->axis ? lrcsi_vec3_dot(f->axis[k], f->g) : f->g[k];
    }
}

/* The cosine of incidence at the normal N that is closest to the laser, of a wall whose normals are
   at one angle from the axis, or at all angles up to that at its rim. With distortion it is close
   to the largest one. */
static double largest_cosine(const lrcsi_patch_frame *f, const lrcsi_revolution *body)
{
    double g[3];
    double p;
    double c;
    double nu;
    lrcsi_patch_direction(f, g);
    const double azimuth = atan2(g[1], g[0]);
    const double turn[2] = {sin(azimuth), cos(azimuth)};
    double angle = atan2(hypot(g[0], g[1]), g[2]);
    if (!(f->step > 0)) {
        angle = atan2(f->sine, f->cosine);
    } else if (f->cosine > 0) { /* not a sphere's lower half */
        angle = lrcsi_min(angle, f->fourth ? atan(body->slope) : 0.5 * LRCS_PI);
    }
    (void)patch_tan2(f, sin(angle), cos(angle), turn, &c, &p, &nu);
    return c / nu;
}

int lrcsi_patch_frame_make(const lrcsi_view *view, uint32_t facet, lrcsi_patch_frame *f,
                           lrcsi_patch *patch)
{
    const lrcs_prepared *prepared = view->prepared;
    const lrcs_part *part = &prepared->scene->part[patch->part];
    const lrcsi_wall_patch *at = &patch->at;
    lrcsi_revolution body = lrcsi_revolution_make(&part->shape, &part->divisions);
    double unit = ldexp(part->unit, -prepared->exponent);
    double facets = 0.5 * prepared->normal[facet].length;
    if (at->facets == 2) {
        uint32_t other = lrcsi_patch_partner(prepared, facet);
        facets += prepared->skip[other] ? 0 : 0.5 * prepared->normal[other].length;
    }
    *f = (lrcsi_patch_frame){.shadow = NULL};
    f->axis = part->rigid ? NULL : (const double(*)[3])part->normal_axis;
    for (int k = 0; k < 3; k++) {
        const double *axis = part->axis[k];
        double along = axis[0] * view->unit[0] + axis[1] * view->unit[1] + axis[2] * view->unit[2];
        f->g[k] = patch->side * (part->rigid ? along : view->unit[k]);
    }
    f->half = body.half;
    f->phi = (2.0 * at->sector + 1.0) * body.half;
    f->fourth = part->kind == LRCS_SHAPE_PARABOLOID;
    f->step = 0.5 * body.step;
    f->alpha = (2.0 * (double)(body.zones - at->row) - 1.0) * f->step;
    if (body.step > 0) {
        double radius = (f->fourth ? body.base / body.slope : body.base) * unit;
        f->sine = sin(f->alpha);
        f->cosine = cos(f->alpha);
        f->area = 4 * f->step * f->half * radius * radius;
    } else {
        double fall = body.base - body.top;
        double slant = hypot(fall, body.height);
        f->sine = body.height / slant;
        f->cosine = fall / slant;
        f->area = f->half * ((body.base + body.top) * unit) * (slant * unit);
    }
    f->cosine = at->mirrored ? -f->cosine : f->cosine;
    f->area *= (part->rigid ? 1 : part->normal_area) / facets;
    f->most = largest_cosine(f, &body);
    patch->facet_area = facets;
    frame_middle(f);
    patch->area_err = 2 * (lrcsi_revolution_rounding(&body, at->row) + part->bounds.normal_err);
    return isfinite(f->area) && (!f->fourth || body.step > 0);
}

lrcsi_patch_frame lrcsi_patch_frame_part(const lrcsi_patch_frame *whole, double alpha, double step,
                                         double phi, double half)
{
    lrcsi_patch_frame f = *whole;
    f.phi = phi;
    f.half = half;
    if (f.step > 0) {
        f.alpha = alpha;
        f.step = step;
        f.sine = sin(f.alpha);
        f.cosine = copysign(cos(f.alpha), whole->cosine);
    }
    frame_middle(&f);
    return f;
}

/* --- the remainder ---------------------------------------------------------------------------- */

double lrcsi_patch_normal_shift(const lrcsi_patch_frame *f, double a, double exp_a, double exp_b)
{
    if (f->axis) {
        double sinh_a = 0.5 * (exp_a - 1 / exp_a);
        double sinh_b = 0.5 * (exp_b - 1 / exp_b);
        double s_max = f->sine * (exp_a - sinh_a) + fabs(f->cosine) * sinh_a;
        return (exp_a - sinh_a - 1) * f->nu + sinh_a * f->along_image +
               s_max * ((exp_b - sinh_b - 1) * f->radial_image + sinh_b * f->around_image) +
               LRCSI_PATCH_NORMAL_ERR;
    }
    return (exp_b - 1) * (f->sine + a) * exp_a + (exp_a - 1) + LRCSI_PATCH_NORMAL_ERR;
}

/* With x = (c + kappa) / nu_min, x^(m+2) <= x^2 exp(m (x - 1)), or x^2 if x <= 1. */
lrcsi_patch_bound lrcsi_patch_bound_make(const lrcsi_patch_frame *f, const lrcs_brdf *brdf,
                                         double a, double exp_a, double exp_b)
{
    double kappa = lrcsi_patch_normal_shift(f, a, exp_a, exp_b);
    double c_min = f->c - kappa;
    double square = f->nu * f->nu - kappa * (2 * f->nu + kappa);
    double nu_max = f->axis ? f->nu + kappa : 1; /* bounds of |n . n|^(1/2) */
    double nu_min = f->axis ? sqrt(lrcsi_max(0, square)) : 1;
    double x = (f->c + kappa) / nu_min;
    double weight = LRCSI_OUTWARD_MICRO * nu_max;
    lrcsi_patch_bound bound = {0, 0};
    if (!(kappa <= SHIFT_MAX * f->c) || !(nu_min > 0)) {
        return (lrcsi_patch_bound){HUGE_VAL, HUGE_VAL};
    }
    if (f->step > 0) {
        double low = f->fourth ? fabs(f->cosine) - (exp_a - 1) : 1;
        weight *= low > 0 ? (f->sine + a) * exp_a / (low * low * low * low) : HUGE_VAL;
    } else if (f->shadow && lrcsi_rim_shadow_fraction(f->shadow, f->phi).value < 1) {
        weight *= lrcsi_rim_shadow_fraction_bound(f->shadow, f->phi, exp_b);
    }
    if (brdf->A > 0) {
        double decrease = (2 * f->p * kappa + kappa * kappa + f->u * kappa * (2 * f->c + kappa)) /
                          (c_min * c_min);
        double exponent =
            (decrease - f->u + 16 * LRCSI_U * (decrease + f->u)) / (brdf->s * brdf->s);
        double w = nu_max / c_min * (nu_max / c_min);
        bound.glint = weight * (brdf->A * lrcsi_exp(exponent) * (w * w));
    }
    if (brdf->B > 0) {
        bound.diffuse = weight * (brdf->B * x * x * (x > 1 ? lrcsi_exp(brdf->m * (x - 1)) : 1));
    }
    return bound;
}

double lrcsi_patch_largest(const lrcsi_patch_frame *f, const lrcs_brdf *brdf)
{
    const lrcsi_patch_bound most =
        lrcsi_patch_bound_make(f, brdf, f->step, lrcsi_exp(f->step), lrcsi_exp(f->half));
    return most.glint + most.diffuse;
}

double lrcsi_patch_integrand(const lrcsi_patch_frame *f, const lrcs_brdf *brdf, double u)
{
    const lrcsi_reflection at = lrcsi_reflect(brdf, u, 0);
    const double cosine2 = f->cosine * f->cosine;
    const double weight = f->step > 0 ? f->sine / (f->fourth ? cosine2 * cosine2 : 1) : 1;
    return weight * f->nu * (at.glint + at.diffuse);
}

/* Where the other variable leaves its interval by at most `bend`, the interval to which a mean over
   it refers is longer by at most that factor. */
const lrcsi_mean_rule *lrcsi_patch_rule_choose(const lrcsi_patch_frame *f, const lrcs_brdf *brdf,
                                               int along, const double bend[LRCSI_PATCH_RADII],
                                               double target, double *error)
{
    double glint[LRCSI_MEAN_RULES]; /* the errors of all rules, of both terms */
    double diffuse[LRCSI_MEAN_RULES];
    const double own = along ? f->step : f->half;
    const double other = along ? f->half : f->step;
    double shift = other;
    double exp_other = lrcsi_exp(other);
    for (int n = 0; n < LRCSI_MEAN_RULES; n++) {
        glint[n] = diffuse[n] = HUGE_VAL;
    }
    for (int i = LRCSI_PATCH_RADII - 1; i >= 0 && !(glint[0] + diffuse[0] <= target); i--) {
        double r = lrcsi_patch_radii[i];
        if (bend && !(bend[i] < 1)) {
            continue;
        }
        if (bend) {
            shift = other + bend[i];
            exp_other = lrcsi_exp(shift);
        }
        const double longer = bend ? 1 + 0.5 * bend[i] / other : 1;
        double exp_own = lrcsi_exp(r * own);
        const lrcsi_patch_bound bound =
            along ? lrcsi_patch_bound_make(f, brdf, r * own, exp_own, exp_other)
                  : lrcsi_patch_bound_make(f, brdf, shift, exp_other, exp_own);
        lrcsi_mean_rule_bound(bound.glint * longer, r, glint);
        lrcsi_mean_rule_bound(bound.diffuse * longer, r, diffuse);
    }
    for (int n = 0; n < LRCSI_MEAN_RULES; n++) {
        glint[n] += diffuse[n];
    }
    const int n = lrcsi_mean_rule_choose(glint, target);
    *error = LRCSI_OUTWARD_MICRO * glint[n];
    return &lrcsi_mean_rules[n];
}

double lrcsi_patch_rules(const lrcsi_patch_frame *f, const lrcs_brdf *brdf, double target,
                         const lrcsi_mean_rule *rule[2])
{
    double along_error = 0;
    double around_error;
    rule[1] = lrcsi_patch_rule_choose(f, brdf, 0, NULL, target, &around_error);
    rule[0] = f->step > 0 ? lrcsi_patch_rule_choose(f, brdf, 1, NULL, target, &along_error)
                          : &lrcsi_mean_rules[0];
    return along_error + around_error;
}

lrcsi_term_errors lrcsi_patch_term_errors(const lrcs_brdf *brdf, double e, double u, double c,
                                          double p)
{
    double du = 1.01 * (2 * p * e + e * e + 2 * u * c * e) / (c * c);
    return (lrcsi_term_errors){brdf->A > 0 ? du * (2 + 1 / (brdf->s * brdf->s)) : 0,
                               du * (0.5 * brdf->m + 1)};
}

/* --- values ----------------------------------------------------------------------------------- */

/* Adds F at one normal, given sines and cosines as patch_tan2, and an error of the weight. Returns
   0 if its rounding error is too large. */
static int patch_add_normal(const lrcsi_patch_frame *f, const lrcs_brdf *brdf, double sine,
                            double cosine, const double azimuth[2], double weight,
                            double weight_err, lrcsi_patch *patch)
{
    double c;
    double p;
    double nu;
    double u = patch_tan2(f, sine, cosine, azimuth, &c, &p, &nu);
    const lrcsi_term_errors err = lrcsi_patch_term_errors(brdf, LRCSI_PATCH_NORMAL_ERR, u, c, p);
    double nu_err = f->axis ? LRCSI_PATCH_NORMAL_ERR / nu : 0;
    if (!(err.glint <= 1 && err.diffuse <= 1 && nu_err <= 1)) {
        return 0;
    }
    lrcsi_reflection at = lrcsi_reflect(brdf, u, 0);
    weight *= nu;
    patch->glint += weight * at.glint;
    patch->diffuse += weight * at.diffuse;
    if (f->derivatives) {
        patch->glint_u += weight * at.glint * u;
        patch->diffuse_log += weight * at.diffuse * lrcsi_log1p(u).hi;
    }
    patch->rounding += weight * (1 + nu_err) *
                           (at.error + at.glint * (err.glint + err.glint * err.glint + nu_err) +
                            at.diffuse * (err.diffuse + err.diffuse * err.diffuse + nu_err)) +
                       2 * weight_err * nu * (at.glint + at.diffuse) +
                       LRCSI_U * (patch->glint + patch->diffuse); /* of the additions */
    return 1;
}

/* Sine and cosine of alpha, and the weight there. */
typedef struct patch_row {
    double sine, cosine, weight;
} patch_row;

static patch_row row_make(const lrcsi_patch_frame *f, double alpha)
{
    patch_row row = {f->sine, f->cosine, 1};
    if (f->step > 0) {
        row.sine = sin(alpha);
        row.cosine = copysign(fabs(cos(alpha)), f->cosine);
        row.weight =
            f->fourth ? row.sine / (row.cosine * row.cosine * row.cosine * row.cosine) : row.sine;
    }
    return row;
}

int lrcsi_patch_add_point(const lrcsi_patch_frame *f, const lrcs_brdf *brdf, double alpha,
                          double phi, double weight, lrcsi_patch *patch)
{
    const patch_row row = row_make(f, alpha);
    const double azimuth[2] = {sin(phi), cos(phi)};
    return patch_add_normal(f, brdf, row.sine, row.cosine, azimuth, weight * row.weight, 0, patch);
}

/* Sines and cosines are computed once for each row and column. */
int lrcsi_patch_add_points(const lrcsi_patch_frame *f, const lrcs_brdf *brdf,
                           const lrcsi_mean_rule *const rule[2], double fraction,
                           lrcsi_patch *patch)
{
    double x[LRCSI_MEAN_RULE_POINTS] = {0};
    double weight[LRCSI_MEAN_RULE_POINTS] = {0};
    double azimuth[LRCSI_MEAN_RULE_POINTS][2] = {{0}};
    double column_weight[LRCSI_MEAN_RULE_POINTS] = {0};
    double column_err[LRCSI_MEAN_RULE_POINTS] = {0};
    int columns = lrcsi_mean_rule_points(rule[1], x, column_weight);
    for (int k = 0; k < columns; k++) {
        double phi = f->phi + x[k] * f->half;
        azimuth[k][0] = sin(phi);
        azimuth[k][1] = cos(phi);
        if (f->shadow && !f->shadow->round) {
            const lrcsi_rim_fraction visible = lrcsi_rim_shadow_fraction(f->shadow, phi);
            column_err[k] = column_weight[k] * visible.err;
            column_weight[k] *= visible.value;
        }
    }
    int known = 1;
    int rows = f->step > 0 ? lrcsi_mean_rule_points(rule[0], x, weight) : 1;
    for (int i = 0; i < rows && known; i++) {
        const patch_row row = row_make(f, f->alpha + x[i] * f->step);
        const double of_row = fraction * (f->step > 0 ? weight[i] : 1) * row.weight;
        for (int k = 0; k < columns && known; k++) {
            known = patch_add_normal(f, brdf, row.sine, row.cosine, azimuth[k],
                                     of_row * column_weight[k], of_row * column_err[k], patch);
        }
    }
    return known;
}
