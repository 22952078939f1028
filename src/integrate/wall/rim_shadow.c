/* SPDX-License-Identifier: MIT */
/* Evaluates what the header states. It does not decide where nothing else is in front of the
   inside (integrate/wall/clear_sectors.c).

   Rounding. In the shape's frame d has an error of at most e = LRCSI_PATCH_NORMAL_ERR, and no
   component of it exceeds 1 by more. Each coefficient of E then has an error of at most 4 e times
   the sum of its factors, below 4 e (y^2 + 2); sines, cosines and sums add a few units. */
#include "integrate/wall/rim_shadow.h"

#include <math.h>

#include "base/constant.h"
#include "base/length.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/sort.h"
#include "base/vec3.h"
#include "mesh/shape/revolution.h"

/* Where the scale of the placement differs between axes, the transpose of the map of normals takes
   d to a multiple of the direction in the shape's frame. */
lrcsi_rim_shadow lrcsi_rim_shadow_make(const lrcs_part *part, const double unit[3])
{
    const lrcsi_revolution body = lrcsi_revolution_make(&part->shape, &part->divisions);
    double d[3];
    for (int k = 0; k < 3; k++) {
        d[k] = lrcsi_vec3_dot(part->rigid ? part->axis[k] : part->normal_axis[k], unit);
    }
    lrcsi_rim_shadow s = {.round = lrcsi_shape_is_round(part->kind),
                          .lit = d[2] < 0,
                          .azimuth = atan2(d[1], d[0]),
                          .across = lrcsi_length_flat(d[0], d[1]),
                          .up = d[2],
                          .nu = 1};
    const double square = s.across * s.across;
    const double up2 = s.up * s.up;
    double slope2 = 0;
    if (part->kind == LRCS_SHAPE_PARABOLOID) {
        slope2 = body.slope * body.slope;
        s.nu = 2;
        s.p = s.up * s.across;
        s.k = up2 - 0.25 * square * (slope2 + 1);
        s.c = up2 - 0.25 * square * (slope2 - 1);
    } else if (s.round) {
        s.p = 2 * s.up * s.across;
        s.k = up2 - square;
    } else {
        s.kappa = (body.base - body.top) / body.height;
        s.height = body.height;
        s.a = (s.across - s.kappa * s.up) * (s.across + s.kappa * s.up);
        s.r0 = s.up < 0 ? body.base : body.top;
        s.r1 = s.up < 0 ? body.top : body.base;
        s.lit = s.up != 0;
    }
    s.err = 16 * LRCSI_PATCH_NORMAL_ERR * (2 + slope2);
    return s;
}

lrcsi_rim_value lrcsi_rim_shadow_at(const lrcsi_rim_shadow *s, double alpha, double phi)
{
    const double sine = sin(s->nu * alpha);
    const double cosine = cos(s->nu * alpha);
    const double x = cos(phi - s->azimuth);
    const double y = sin(phi - s->azimuth);
    return (lrcsi_rim_value){s->p * sine * x + s->k * cosine + s->c,
                             {s->nu * (s->p * cosine * x - s->k * sine), -s->p * sine * y}};
}

double lrcsi_rim_shadow_second(const lrcsi_rim_shadow *s, double x, double y)
{
    const double p = fabs(s->p);
    const double sum = s->nu * s->nu * (p + fabs(s->k)) * x * x + 2 * s->nu * p * x * y + p * y * y;
    return 0.5 * sum * exp(s->nu * x + y) * LRCSI_OUTWARD_NANO;
}

double lrcsi_rim_shadow_slope_change(const lrcsi_rim_shadow *s, int variable, double x, double y)
{
    const double p = fabs(s->p);
    const double change =
        variable == 0 ? s->nu * (s->nu * (p + fabs(s->k)) * x + p * y) : p * (s->nu * x + y);
    return change * LRCSI_OUTWARD_NANO + s->nu * s->err;
}

/* y at a value of cos(phi - phi_d), without the limit h, with the error that those of d, c and W
   leave. */
typedef struct rim_height {
    double value, err;
} rim_height;

static rim_height height_at(const lrcsi_rim_shadow *s, double cosine)
{
    const double c = -(s->across * cosine + s->kappa * s->up);
    const double sine2 = (1 - cosine) * (1 + cosine);
    const double w = c * c + s->across * s->across * sine2;
    const double size = 1 + fabs(s->kappa);
    const double e = 4 * LRCSI_PATCH_NORMAL_ERR * size;
    const double y = 2 * s->r0 * c * fabs(s->up) / w;
    if (!(s->a > 0) || !(c > 0)) {
        return (rim_height){s->a > 0 ? 0 : HUGE_VAL, 0};
    }
    if (!(16 * e * size < w)) { /* W is not known */
        return (rim_height){y, HUGE_VAL};
    }
    return (rim_height){y, 2 * s->r0 * (2 * e) / w + fabs(y) * (4 * e * size / w)};
}

lrcsi_rim_fraction lrcsi_rim_shadow_fraction(const lrcsi_rim_shadow *s, double phi)
{
    const rim_height y = height_at(s, cos(phi - s->azimuth));
    const double h = s->height;
    if (s->lit && y.err == HUGE_VAL) {
        return (lrcsi_rim_fraction){1, 1};
    }
    if (!s->lit || !(y.value < h)) {
        return (lrcsi_rim_fraction){s->lit, 0};
    }
    const double sum = s->r0 + s->r1;
    const double sigma = (s->r1 - s->r0) / h;
    return (lrcsi_rim_fraction){y.value * (2 * s->r0 + sigma * y.value) / (h * sum),
                                lrcsi_min(1, 2 * y.err / h + 8 * LRCSI_U)};
}

double lrcsi_rim_shadow_fraction_bound(const lrcsi_rim_shadow *s, double phi, double exp_b)
{
    const double cosine = cos(phi - s->azimuth);
    const double cosh_b = 0.5 * (exp_b + 1 / exp_b);
    const double sinh_b = exp_b - cosh_b;
    const double change =
        s->across * (fabs(cosine) * (cosh_b - 1) + fabs(sin(phi - s->azimuth)) * sinh_b + 1e-12);
    const double c = fabs(s->across * cosine + s->kappa * s->up) + change;
    const double w = s->a + 2 * s->kappa * s->up * (s->across * cosine + s->kappa * s->up) -
                     2 * fabs(s->kappa * s->up) * change;
    const double y = 2 * s->r0 * c * fabs(s->up) / w;
    const double sum = s->r0 + s->r1;
    if (!(w > 0)) {
        return HUGE_VAL;
    }
    return y * (2 * s->r0 + fabs(s->r1 - s->r0) / s->height * y) / (s->height * sum) *
           LRCSI_OUTWARD_MICRO;
}

/* y = h where 2 r0 |d_z| c = h W: with x = cos(phi - phi_d), where
   2 d_rho |d_z| r1 x = -2 r0 |d_z| kappa d_z - h (d_rho^2 + kappa^2 d_z^2). */
int lrcsi_rim_shadow_kinks(const lrcsi_rim_shadow *s, double from, double to, double kink[2])
{
    const double up = fabs(s->up);
    const double tilt = s->kappa * s->up;
    const double x = -(2 * s->r0 * up * tilt + s->height * (s->across * s->across + tilt * tilt)) /
                     (2 * s->across * up * s->r1);
    int count = 0;
    if (s->round || !s->lit || !(s->a > 0) || !(x > -1 && x < 1)) {
        return 0;
    }
    const double angle = atan2(sqrt((1 - x) * (1 + x)), x);
    const double middle = 0.5 * (from + to);
    for (int sign = -1; sign <= 1; sign += 2) {
        const double at = s->azimuth + sign * angle;
        const double phi = at - 2 * LRCS_PI * round((at - middle) / (2 * LRCS_PI));
        if (phi > from && phi < to) {
            kink[count++] = phi;
        }
    }
    lrcsi_sort_ascending(kink, (uint32_t)count);
    return count;
}
