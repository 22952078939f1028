/* SPDX-License-Identifier: MIT */
/* What rounding and linear maps do to bounds of patches, whatever the shape that they describe. The
   numbers of a shape's own facets are revolution.c's. */
#include "mesh/shape/patch_bounds.h"

#include <math.h>

#include "base/constant.h"

/* Covers the rounding errors of some 30 operations and functions. */
#define BOUNDS_SLACK (64.0 * LRCSI_U)

/* Facets that rounding changes by more than this fraction of themselves get UNBOUNDED numbers.
   These are finite, because they may be multiplied by a facet area of zero. */
#define ROUNDING_MAX 0x1p-6
#define UNBOUNDED    1e300

/* The turn vector changes by at most gamma / sin gamma < 2 times the rotation. A facet that
   rounding moves by a large fraction of its own size has no meaningful numbers. */
lrcs_patch_bounds lrcsi_patch_bounds_rounded(const lrcs_patch_bounds *c, double rounding)
{
    if (!(rounding <= ROUNDING_MAX)) {
        return (lrcs_patch_bounds){
            .turn = LRCS_PI, .area_err = UNBOUNDED, .bias = UNBOUNDED, .rms_turn = sqrt(UNBOUNDED)};
    }
    return (lrcs_patch_bounds){.turn = fmin(c->turn + rounding, LRCS_PI),
                               .area_err = c->area_err + 2.0 * rounding,
                               .bias = c->bias + 2.0 * rounding,
                               .rms_turn = c->rms_turn + 2.0 * rounding};
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
lrcs_patch_bounds lrcsi_patch_bounds_mapped(const lrcs_patch_bounds *c, double ratio,
                                            double *stretch_err)
{
    double k = fmax(1.0, ratio);
    double g = 0.5 * (k - 1.0 / k);
    double h = 0.5 * (k - 1.0) * (k + 1.0);
    double G = g + h * c->turn;
    double square = c->rms_turn * c->rms_turn;
    double turn = fmin(k * c->turn, LRCS_PI);
    double outward = 1.0 + BOUNDS_SLACK;
    if (!(G * c->turn <= 1.0)) {
        double area = (1.0 + c->area_err) * k * outward;
        *stretch_err = k - 1.0;
        return (lrcs_patch_bounds){
            .turn = turn, .area_err = area, .bias = turn * area, .rms_turn = turn * sqrt(area)};
    }
    double E = exp(G * c->turn);
    *stretch_err = (E - 1.0) * outward;
    return (lrcs_patch_bounds){
        .turn = turn * outward,
        .area_err = (c->area_err + g * c->bias + (h + 0.5 * G * G * E) * square) * outward,
        .bias = (k * c->bias + k * (g + G * E) * square) * outward,
        .rms_turn = k * c->rms_turn * sqrt(E) * outward};
}
