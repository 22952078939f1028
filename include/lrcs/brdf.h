/* SPDX-License-Identifier: MIT */
/* The four-parameter monostatic BRDF, and a library of typical satellite materials.
   f_r(theta) = A / cos^6(theta) exp(-tan^2(theta) / s^2) + B cos^m(theta), 1/sr.
   Source: O. Steinvall, Appl. Opt. 39 (2000) 4381; Y. Han et al., Opt. Laser Technol. 56 (2014)
   151-157, Eq. 1. */
#ifndef LRCS_BRDF_H
#define LRCS_BRDF_H

#include <lrcs/status.h>

typedef struct lrcs_brdf {
    double A; /* glint amplitude, 1/sr, >= 0 */
    double B; /* diffuse amplitude, 1/sr, >= 0 */
    double s; /* rms surface slope, > 0 (0 only with A = 0) */
    double m; /* diffusivity coefficient, >= 0 */
} lrcs_brdf;

/* The uncertainty of the four numbers: one standard deviation of each, in its own unit, and their
   correlations. All zero: the numbers are exact. */
typedef struct lrcs_brdf_error {
    double A, B, s, m;     /* >= 0 */
    double correlation[6]; /* of A and B, A and s, A and m, B and s, B and m, s and m: [-1, 1] */
} lrcs_brdf_error;

/* The material of facets to which no binding applies: A=1, B=0.25, s=0.2, m=0.5. */
lrcs_brdf lrcs_brdf_default(void);

/* Values that the formula accepts but that lie outside the physical meaning of the model: bits
   returned by lrcs_brdf_check. */
enum lrcs_brdf_warning {
    LRCS_BRDF_SLOPE_LARGE = 1 << 0,  /* s > 0.7: a plate's glint does not peak at its normal */
    LRCS_BRDF_DIFFUSE_GAIN = 1 << 1, /* pi B > 1: reflects more than it receives when m = 0 */
    LRCS_BRDF_GLINT_GAIN = 1 << 2,   /* 4 pi A s^2 > 1: the glint reflects more than it receives
                                        (A = R / (4 pi s^2) on a Beckmann surface) */
    LRCS_BRDF_DARK = 1 << 3          /* A = 0 and B = 0 */
};

/* Checks the four numbers: LRCS_E_NUMBER if they are not finite or outside the domain
   (A, B, m < 0; s < 0; s = 0 with A > 0), else warning bits, 0 for none. */
int lrcs_brdf_check(const lrcs_brdf *brdf);

/* Checks the errors of a brdf: LRCS_E_NUMBER if a number is not finite, a deviation is negative,
   a correlation lies outside [-1, 1] or the six are not correlations of four quantities (their
   matrix has an eigenvalue below 0 by more than rounding); LRCS_E_ARGUMENT if A or s has an error
   and s is 0: without a slope there is no glint that could be uncertain. Else LRCS_OK. */
int lrcs_brdf_error_check(const lrcs_brdf *brdf, const lrcs_brdf_error *error);

/* One sentence for one warning bit. Never NULL. */
const char *lrcs_brdf_warning_text(int bit);

/* f_r at an incidence angle.
   Given: brdf in its domain; cos_theta in [-1, 1].
   Returned: f_r, 1/sr; 0 if cos_theta <= 0. The cosine alone determines tan^2 only to a
   relative 2^-52 / theta^2; the engine itself therefore works from tan^2.
   Notes: 1. May overflow to infinity only where f_r itself exceeds the largest double. */
double lrcs_brdf_eval(const lrcs_brdf *brdf, double cos_theta);

/* A material of the library. Without a source the values are ILLUSTRATIVE: no published table of A,
   B, s, m for satellite materials was accessible; they are chosen for typical behaviour only. With
   a source, B comes from a published reflectance of that surface, averaged over the spectrum of the
   sun, and Lambert's law is assumed: A = 0, m = 0. */
typedef struct lrcs_brdf_entry {
    const char *name; /* "solar-cell", "mli-gold", ... lower case with hyphens */
    const char *text; /* what it represents */
    lrcs_brdf brdf;
    lrcs_brdf_error error; /* all zero without a source */
    const char *source;    /* author, year, table; NULL: the values are illustrative */
} lrcs_brdf_entry;

/* The library: entry i, or NULL beyond the last. */
const lrcs_brdf_entry *lrcs_brdf_library(uint32_t i);

/* The library entry of that name, or NULL. */
const lrcs_brdf_entry *lrcs_brdf_find(const char *name);

#endif
