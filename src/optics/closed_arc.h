/* SPDX-License-Identifier: MIT */
/* Integrals over an arc that have no closed form, by one quadrature: the description of an
   integrand, and the rule. */
#ifndef LRCSI_CLOSED_ARC_H
#define LRCSI_CLOSED_ARC_H

#include "optics/closed.h"

/* The nodes (one of each pair +-x) and weights of the 24-point Gauss-Legendre rule on [-1, 1]:
   roots of P_24 and 2 / ((1 - x^2) P_24'(x)^2), rounded from 60 digits. */
#define LRCSI_GAUSS_PAIRS 12
extern const double lrcsi_gauss_rule[LRCSI_GAUSS_PAIRS][2];

/* F along an arc, relative to F at the reference angle theta_r, the angle from the laser at the
   nearest point of the arc: with q = cos(theta)/cos(theta_r) and y = 1 - q (each without
   cancellation) the glint is q^-4 exp(-y (2 - y) gain / q^2), gain = 1/(cos(theta_r) s)^2, and the
   diffuse term q^nu. */
typedef struct lrcsi_arc_integrand {
    int term; /* lrcsi_term */
    double gain, nu;
} lrcsi_arc_integrand;

/* A point of an arc: y, q, and the weight of F there; 0 if q is not positive. */
typedef struct lrcsi_arc_point {
    double y, q, weight;
} lrcsi_arc_point;

lrcsi_arc_integrand lrcsi_arc_integrand_make(const lrcs_brdf *brdf, int term, double cos_reference);

/* A circle of normals, at azimuths phi = 0 .. phi_1: q = 1 - k sin^2(phi/2), and q_pi = q(pi) is
   1 - k. If q_pi is not negative, the circle is entirely lit and phi_1 = pi; else q(phi_1) = 0, and
   psi_1 is pi - phi_1. */
typedef struct lrcsi_normal_circle {
    double k, q_pi, psi_1;
} lrcsi_normal_circle;

/* An interval of angles theta from the laser; the weight of each theta is its integral over the
   azimuth about the laser (closed_cap.c). */
typedef struct lrcsi_cap {
    int full_circle;  /* 1: the whole circle lies in the cap of normals; 0: an arc of it */
    int laser_inside; /* the laser is inside the cap of normals (alpha < tau) */
    int horizon;      /* 1: theta ends at pi/2; 0: theta ends where the circle leaves the cap */
    int paraboloid;   /* weighted with (n_0 / n_z)^4; else with 1 */
    double sin_start, cos_start, start; /* theta_d = |tau - alpha| */
    double sin_end, cos_end, end;       /* of the end of theta */
    double gap, supplement;             /* if horizon: tau + alpha - pi/2, and pi - gap */
    double sin_alpha, cos_alpha, sin_tau, n_0;
} lrcsi_cap;

typedef struct lrcsi_arc {
    lrcsi_arc_integrand integrand[LRCSI_TERMS];
    int requested[LRCSI_TERMS]; /* 0: that term is not integrated */
    double length;
    int is_cap;
    lrcsi_normal_circle circle;
    lrcsi_cap cap;
    /* Within this distance of an end the integrand without F is smooth; 0: it has an algebraic zero
       or a root at the end itself. */
    double left_smooth, right_smooth;
    int left_root;       /* 1: smooth except for a square root at the left end itself */
    double weight_scale; /* beyond this distance of an end the integrand without F may vary by a
                            power */
} lrcsi_arc;

/* The point at distance d from the left or the right end, 0 <= d <= length/2 up to rounding. */
lrcsi_arc_point lrcsi_circle_point(const lrcsi_arc *arc, int right, double d);
lrcsi_arc_point lrcsi_cap_point(const lrcsi_arc *arc, int right, double d);

/* The integrals of the requested terms over the arc, 0 for the others. Relative error at most
   LRCSI_ARC_UNITS of 2^-53. */
#define LRCSI_ARC_UNITS 64.0
void lrcsi_arc_integral(const lrcsi_arc *arc, double integral[LRCSI_TERMS]);

#endif
