/* SPDX-License-Identifier: MIT */
/* How sigma depends on its materials: its derivatives, and the uncertainty that the errors of A, B,
   s and m cause. This is separate from lrcs_result.bound_m2, which never includes it: the bound
   refers to the materials as given. */
#ifndef LRCS_UNCERTAINTY_H
#define LRCS_UNCERTAINTY_H

#include <lrcs/run.h>

/* The derivatives of sigma in the four numbers of one material, the visible areas being held fixed
   (they do not depend on materials). sigma is linear in A and B: what facets of the material add to
   sigma_glint_m2 is A dA, and to sigma_diffuse_m2 B dB. */
typedef struct lrcs_sensitivity {
    double dA; /* m2 sr */
    double dB; /* m2 sr */
    double ds; /* m2: per unit of slope */
    double dm; /* m2 */
} lrcs_sensitivity;

/* The material uncertainty of sigma: a statistical estimate, not a bound. */
typedef struct lrcs_uncertainty {
    int stated;             /* 1: some material has errors. 0: none has; deviations are 0, low and
                               high equal sigma, sample_m2 is -1 */
    double deviation_m2;    /* one standard deviation of sigma: by first order, or sampled */
    double low_m2, high_m2; /* 68.27 % interval: sigma -+ deviation, or the sample's quantiles */
    int sampled;            /* 1: the three above are the sample's: note 3 */
    double first_order_m2;  /* one standard deviation by first order */
    double sample_m2;       /* the sample's standard deviation; negative: not sampled */
    double sample_mean_m2;
    uint32_t draws;
} lrcs_uncertainty;

typedef struct lrcs_uncertainty_options {
    uint32_t draws; /* of the sample, 0: none, else 2 to 2^20 (4096) */
    uint64_t seed;  /* of the generator (1) */
} lrcs_uncertainty_options;

lrcs_uncertainty_options lrcs_uncertainty_options_default(void);

/* Bytes of work area that lrcs_uncertainty_run takes at most, for any pose. */
size_t lrcs_uncertainty_need(const lrcs_prepared *prepared, const lrcs_run_options *options,
                             const lrcs_uncertainty_options *how);

/* sigma for a pose, its derivatives by material, and its material uncertainty.
   Given: prepared, pose and options as for lrcs_sigma_run; how; work.
   Returned: result, the same as lrcs_sigma_run gives; sensitivity[material_count] in the scene's
   order; uncertainty.
   Status: as lrcs_sigma_run; LRCS_E_ARGUMENT (draws); LRCS_E_NUMBER (a material's errors fail
   lrcs_brdf_error_check, a derivative beyond double range).
   Work: that of the pose, and a sum over the facets for each of at most 17 sets of parameters;
   with curved normals 9 more poses instead, the cubature being made anew for each. Nothing stays
   in the work area.
   Notes: 1. Derivatives of flat facets are analytic, and as accurate as sigma itself: their areas
   are those of sigma, and rounding adds less than 1e-12 of the sum of their terms without signs. So
   are those of curved normals, up to the error of the cubature (curvature_estimate_m2). Those of
   shapes by their closed forms (LRCS_METHOD_CLOSED) in s and m are differences of order 8 of the
   closed form, with errors of about 1e-9 of themselves and 1e-11 of the term. Those of curved
   walls come from the integrals and means that sigma consists of, so that A dA and B dB are its
   parts to rounding (with curved normals, up to the error of the cubature); how far ds and dm are
   from those of the true surface is not bounded. A term of amplitude 0 is no part of sigma: its
   dA or dB on partly visible walls comes from means over patches, and may be off by percents on
   coarse meshes (2.6 % for the glint of a partly hidden sphere of 500 facets). An effect left out
   (lrcs_run_options.without) has derivative 0. ds is 0 if A is 0, and dm if B is 0; at s = 0 dA and
   ds are 0, the limit from above.
   2. First order: the square root of the sum of g' C g over sources (lrcs_material.source), with g
   the derivatives and C the covariance: materials of one source have the same errors, those of
   different sources have independent ones.
   3. The sample draws each source's four numbers from the normal distribution with its covariance.
   Draws outside the domain are moved to its edge: A, B and m to 0, s to a sixteenth of its value;
   and draws further than 4 standard deviations in s or m to 4. It is reported, in place of the
   first order, where the two standard deviations differ by more than 5 % of the sample's, or its
   mean differs from sigma by more than a tenth of that (and both by more than three standard errors
   of the sample): sigma is then not linear in the parameters over their errors. The same seed gives
   the same sample on every machine. sigma at drawn s and m is interpolated between 17 nodes (9 with
   curved normals) by cubics in its logarithm, with the slopes there. At the materials' own s and m
   these are sigma and its derivatives. At the other nodes partly visible spheres, domes and
   paraboloids are computed from means over patches; a factor makes value and slope of each
   material's term right at its own s and m. */
int lrcs_uncertainty_run(const lrcs_prepared *prepared, const lrcs_pose *pose,
                         const lrcs_run_options *options, const lrcs_uncertainty_options *how,
                         lrcs_work *work, lrcs_result *result, lrcs_sensitivity *sensitivity,
                         lrcs_uncertainty *uncertainty);

/* The derivatives of sigma in attitude, per degree of rotation of the body about the observation
   frame's x and y axes (right-handed; rotation about z, the line of sight, changes nothing). */
typedef struct lrcs_attitude_slope {
    double per_deg_m2[2];
    double bound_m2[2];    /* proved, for the difference quotient: from the bounds of its two
                              poses */
    double estimate_m2[2]; /* estimate of how far the quotient is from the derivative: its
                              difference from that of twice the step. Large at a kink of sigma */
} lrcs_attitude_slope;

/* Central differences of proved poses, 0.01 degrees either way, all by the same options.
   Status, work and work area: as lrcs_sigma_run, eight poses. */
int lrcs_attitude_slope_run(const lrcs_prepared *prepared, const lrcs_pose *pose,
                            const lrcs_run_options *options, lrcs_work *work,
                            lrcs_attitude_slope *slope);

#endif
