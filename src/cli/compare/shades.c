/* SPDX-License-Identifier: MIT */
/* Mistakes in the shading of a facet: f_r cos theta with a mistake. mistakes.c lists the
   mistakes. */
#include "cli/compare/mistakes.h"

#include <math.h>

#define DEGREES_PER_RADIAN 57.295779513082320877

double cli_mistake_right(const mistake_point *spot, double at)
{
    (void)at;
    return lrcs_brdf_eval(spot->brdf, spot->c) * spot->c;
}

/* Another power of the cosine instead of the first. */
double cli_shade_cosine(const mistake_point *spot, double at)
{
    return lrcs_brdf_eval(spot->brdf, spot->c) * pow(spot->c, at);
}

/* f_r at the cosine of theta in degrees taken for radians; at 1: the magnitude of that cosine. */
double cli_shade_degrees(const mistake_point *spot, double at)
{
    double c = cos(acos(spot->c) * DEGREES_PER_RADIAN);
    c = at > 0.0 ? fabs(c) : c;
    return c > 0.0 ? lrcs_brdf_eval(spot->brdf, c) * spot->c : 0.0;
}

/* Both terms from their formulas, for mistakes in the glint term. */
static double shade_terms(const mistake_point *spot, double power, double exponent)
{
    const lrcs_brdf *b = spot->brdf;
    double glint = b->A > 0.0 ? b->A * pow(spot->c, -power) * exp(-exponent) : 0.0;
    return (glint + b->B * pow(spot->c, b->m)) * spot->c;
}

static double point_tan2(const mistake_point *spot)
{
    return 1.0 / (spot->c * spot->c) - 1.0;
}

/* 1 / cos^at instead of 1 / cos^6. */
double cli_shade_power(const mistake_point *spot, double at)
{
    return shade_terms(spot, at, point_tan2(spot) / (spot->brdf->s * spot->brdf->s));
}

/* tan^2 at / s^2 instead of tan^2 / s^2; at 0: tan^2 / s. */
double cli_shade_slope(const mistake_point *spot, double at)
{
    double s = spot->brdf->s;
    return shade_terms(spot, 6.0, point_tan2(spot) * (at > 0.0 ? at / (s * s) : 1.0 / s));
}

double cli_shade_sine(const mistake_point *spot, double at)
{
    double s = spot->brdf->s;
    (void)at;
    return shade_terms(spot, 6.0, (1.0 - spot->c * spot->c) / (s * s));
}

double cli_shade_small_angle(const mistake_point *spot, double at)
{
    double theta = acos(spot->c) / spot->brdf->s;
    (void)at;
    return shade_terms(spot, 6.0, theta * theta);
}

/* The tangent of theta in degrees, taken for radians; the cosines are right. */
double cli_shade_tan_degrees(const mistake_point *spot, double at)
{
    double t = tan(acos(spot->c) * DEGREES_PER_RADIAN) / spot->brdf->s;
    (void)at;
    return shade_terms(spot, 6.0, t * t);
}

double cli_shade_lambert(const mistake_point *spot, double at)
{
    lrcs_brdf brdf = *spot->brdf;
    brdf.m = at;
    return lrcs_brdf_eval(&brdf, spot->c) * spot->c;
}

/* At 0 without the glint term, at 1 without the diffuse term. */
double cli_shade_one_term(const mistake_point *spot, double at)
{
    lrcs_brdf brdf = *spot->brdf;
    brdf.A *= at;
    brdf.B *= 1.0 - at;
    return lrcs_brdf_eval(&brdf, spot->c) * spot->c;
}

static double brdf_at(const mistake_point *spot, double theta_deg)
{
    return lrcs_brdf_eval(spot->brdf, cos(theta_deg / DEGREES_PER_RADIAN));
}

/* f_r from a table in steps of `at` deg, interpolated linearly. */
double cli_shade_lines(const mistake_point *spot, double at)
{
    double theta = acos(spot->c) * DEGREES_PER_RADIAN;
    double low = at * floor(theta / at);
    double from = brdf_at(spot, low);
    return (from + (theta - low) / at * (brdf_at(spot, low + at) - from)) * spot->c;
}

/* theta rounded to multiples of `at` deg. */
double cli_shade_steps(const mistake_point *spot, double at)
{
    double theta = acos(spot->c) * DEGREES_PER_RADIAN;
    return brdf_at(spot, at * floor(theta / at + 0.5)) * spot->c;
}

/* A channel of 8 bits whose largest value stands for `at`; 0: for the brightest facet of the
   case. */
double cli_shade_bits(const mistake_point *spot, double at)
{
    double white = at > 0.0 ? at : spot->peak;
    double value = white > 0.0 ? fmin(cli_mistake_right(spot, at) / white, 1.0) : 0.0;
    return white * floor(255.0 * value + 0.5) / 255.0;
}

double cli_shade_clamped(const mistake_point *spot, double at)
{
    return fmin(cli_mistake_right(spot, at), at);
}
