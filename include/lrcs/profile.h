/* SPDX-License-Identifier: MIT */
/* The range profile of a pose: how much of sigma comes from each interval of range along the line
   of sight, each with a proved bound, and what a Gaussian laser pulse makes of it. */
#ifndef LRCS_PROFILE_H
#define LRCS_PROFILE_H

#include <lrcs/pose.h>
#include <lrcs/prepare.h>

/* Range is measured along the line of sight, in metres: it is 0 at the origin of the body frame
   and grows away from the laser, -s_hat . x for a point x. */

/* The largest count of bins of a profile, and the largest number k of a bin. */
#define LRCS_PROFILE_BINS  1048576u
#define LRCS_PROFILE_INDEX 1099511627776.0

/* What comes from one bin. */
typedef struct lrcs_profile_bin {
    double sigma_glint_m2, sigma_diffuse_m2;
    double bound_m2;     /* proved: of their sum */
    double variation_m2; /* proved: of the error of sigma weighted by any function of range, of
                            absolute value 1 at most, within the bin; at least bound_m2 */
    double curvature_estimate_m2; /* ESTIMATE, not proved: the error of the integral over curved
                                     normals, which no bound includes; 0 without such */
    double moment_m3; /* integral over the bin of range - (k + 0.5) bin_m, times d(sigma) */
} lrcs_profile_bin;

typedef struct lrcs_profile {
    double bin_m;
    int64_t first; /* bin[i] is bin k = first + i: it holds k bin_m <= range < (k + 1) bin_m, with
                      the products rounded to doubles */
    uint32_t count;
    lrcs_profile_bin *bin;
    double sigma_glint_m2, sigma_diffuse_m2; /* of all bins together */
    double bound_m2; /* proved, of that sum: less than the sum of the bins' bounds, which also
                        hold what may lie on the other side of a bin's edge */
    double curvature_estimate_m2; /* ESTIMATE: of that sum; -1 if all normals are flat, as in
                                     lrcs_result */
    int tessellation_known; /* 0: the bounds refer to the facets, not to the curved shapes that they
                               replace: lrcs_result.budget */
    double range_err_m;     /* proved: bound on the error of the range of a point within its bin */
} lrcs_profile;

/* Bytes of work area, an upper bound for ordinary scenes; 0 if bin_m is not > 0. Where it does not
   suffice, lrcs_profile_run returns LRCS_E_MEMORY, and work->peak is what it needed up to that
   point. */
size_t lrcs_profile_need(const lrcs_prepared *prepared, double bin_m);

/* The range profile of a pose, by exact visibility.
   Given: prepared; pose; bin_m, the width of a bin, m, > 0; work.
   Returned: profile, from the first bin to the last that may hold anything, in the work area;
   count is 0 if nothing that reflects faces the laser.
   Status: LRCS_OK; LRCS_E_ARGUMENT (the width, or the pose); LRCS_E_NUMBER (the pose, or sigma
   beyond double range); LRCS_E_MEMORY; LRCS_E_LIMIT (the scene's depth takes more than
   LRCS_PROFILE_BINS bins, its distance from the origin numbers beyond LRCS_PROFILE_INDEX, or a grid
   has more than 2^32 - 2 candidates); LRCS_E_UNSUPPORTED (this thread's arithmetic, as
   lrcs_prepare_run).
   Notes: 1. The truth that bounds refer to is that of lrcs_sigma_run: Eq. 2 over the visible parts
   of the placed facets, and of the true curved shapes where tessellation_known is 1. A bin's bound
   falls with the first power of the facets' angles, that of the sum with the second.
   2. On a flat facet d(sigma) is spread evenly over its visible projected area, so that the density
   over range is piecewise linear; a bin's sigma is its integral, in closed form. On a facet with
   curved normals it is integrated by cubature over the visible parts in each bin, whose error is in
   curvature_estimate_m2. Range is that of the flat facets.
   3. A facet normal to the line of sight has one range, and counts entirely in one bin: at the edge
   of two bins, in the farther one. If it is too close to an edge for its side to be decided, the
   bounds of both bins include all of it. For a line of sight along an axis of the body frame every
   side is decided exactly; otherwise not within 2^-94 of the scene's size. */
int lrcs_profile_run(const lrcs_prepared *prepared, const lrcs_pose *pose, double bin_m,
                     lrcs_work *work, lrcs_profile *profile);

/* The response to a Gaussian pulse: the density of sigma over range, convolved with a Gaussian of
   integral 1 whose full width at half maximum in range is fwhm_m.
   Given: profile; fwhm_m, m, > 0; range_m.
   Returned: density_m, m^2 per m; bound_m, proved; estimate_m, an ESTIMATE of what the integral
   over curved normals adds to that error, 0 without such. Status: LRCS_OK; LRCS_E_ARGUMENT (the
   width); LRCS_E_NUMBER (not finite). Work: O(bins).
   Notes: 1. Of each bin, sigma and its moment are used; the bound includes the effect of all higher
   moments: about (bin_m / fwhm_m)^2 of the density, which is 1e-4 of it for bins
   of fwhm_m / 100. */
int lrcs_profile_pulse(const lrcs_profile *profile, double fwhm_m, double range_m,
                       double *density_m, double *bound_m, double *estimate_m);

#endif
