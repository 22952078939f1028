/* SPDX-License-Identifier: MIT */
/* The four parameters of a material: which are allowed, which deserve a warning, f_r from a cosine,
   and the library of typical materials. f_r cos^2, what the engine integrates, is reflect.c. */
#include <lrcs/brdf.h>

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/elementary.h"
#include "optics/reflect.h"

/* P. Fortescue, G. Swinerd and J. Stark (eds), Spacecraft Systems Engineering, 4th ed., Wiley 2011,
   Table 11.3: solar absorptance a of white silicone paint 0.26, after 1000 hours of ultraviolet
   0.29; of white silicate paint 0.12, then 0.14; of black epoxy paint 0.95. An opaque surface
   reflects 1 - a, and B = (1 - a) / pi if it does so by Lambert's law. The error is what 1000 hours
   change; of the black paint, one step of the table's last digit. The variation over the
   sun's spectrum and the deviation from Lambert's law are in neither. */
#define BRDF_FORTESCUE "Fortescue, Swinerd and Stark (eds) 2011, Table 11.3"
#define BRDF_LAMBERT(absorptance)                                                                  \
    {                                                                                              \
        0.0, (1.0 - (absorptance)) / LRCS_PI, 0.0, 0.0                                             \
    }
#define BRDF_LAMBERT_ERROR(change)                                                                 \
    {                                                                                              \
        0.0, (change) / LRCS_PI, 0.0, 0.0,                                                         \
        {                                                                                          \
            0, 0, 0, 0, 0, 0                                                                       \
        }                                                                                          \
    }
#define BRDF_EXACT                                                                                 \
    {                                                                                              \
        0.0, 0.0, 0.0, 0.0,                                                                        \
        {                                                                                          \
            0, 0, 0, 0, 0, 0                                                                       \
        }                                                                                          \
    }

/* The literature was searched for published A, B, s, m and for monostatic BRDFs measured at 1.06
   and 0.532 um, of solar cells, multilayer insulation, paints and aluminium. Known measurements
   that are not used, because the accessible text gives no monostatic values with an uncertainty:
   Neu and Dummer, AIAA Journal 7(3), 1969; Hubbs et al., Applied Optics 21, 3323, 1982 (10.6 and
   118 um); Fletcher et al., NASA TP-3649, 1997 (visible light); Bowers et al., AMOS 2011 (350 to
   2500 nm); Fankhauser, Tyson and Askari, Astronomical Journal 166, 59, 2023 (fits to measured
   chassis and solar array, bistatic, without an uncertainty). A paper of 2022 tabulates A, B, s, m
   of satellite materials after Acta Optica Sinica 39, 1024001, 2019; neither text was accessible.

   Entries without a source are chosen, not measured. A Beckmann microfacet surface of mirror
   reflectance R has A = R / (4 pi s^2) in the monostatic geometry, and a Lambert surface of
   reflectance rho has B = rho / pi. Each entry states its R and rho; R + rho <= 1. */
static const lrcs_brdf_entry brdf_library[] = {
    {"solar-cell",
     "cover glass over dark cells (R 0.08, rho 0.05)",
     {0.6, 0.016, 0.1, 0.5},
     BRDF_EXACT,
     NULL},
    {"mli-gold", "wrinkled gold foil (R 0.70, rho 0.16)", {0.62, 0.05, 0.3, 0.3}, BRDF_EXACT, NULL},
    {"mli-silver",
     "wrinkled silver foil (R 0.65, rho 0.19)",
     {0.83, 0.06, 0.25, 0.3},
     BRDF_EXACT,
     NULL},
    {"paint-white",
     "white thermal paint (R 0.04, rho 0.79)",
     {0.02, 0.25, 0.4, 0.2},
     BRDF_EXACT,
     NULL},
    {"paint-black",
     "black thermal paint (R 0.04, rho 0.04)",
     {0.02, 0.012, 0.4, 0.3},
     BRDF_EXACT,
     NULL},
    {"aluminium-bare",
     "milled aluminium (R 0.59, rho 0.19)",
     {2.1, 0.06, 0.15, 0.5},
     BRDF_EXACT,
     NULL},
    {"aluminium-anodised",
     "anodised aluminium (R 0.20, rho 0.38)",
     {0.18, 0.12, 0.3, 0.3},
     BRDF_EXACT,
     NULL},
    {"paint-white-silicone", "white silicone paint, Lambert (rho 0.74)", BRDF_LAMBERT(0.26),
     BRDF_LAMBERT_ERROR(0.03), BRDF_FORTESCUE},
    {"paint-white-silicate", "white silicate paint, Lambert (rho 0.88)", BRDF_LAMBERT(0.12),
     BRDF_LAMBERT_ERROR(0.02), BRDF_FORTESCUE},
    {"paint-black-epoxy", "black epoxy paint, Lambert (rho 0.05)", BRDF_LAMBERT(0.95),
     BRDF_LAMBERT_ERROR(0.01), BRDF_FORTESCUE},
    {"ideal-diffuse",
     "Lambert surface of reflectance 1",
     {0.0, 0.3183098861837907, 0.0, 0.0},
     BRDF_EXACT,
     NULL},
    {"ideal-glint",
     "mirror facets of slope 0.1 (R 0.999)",
     {7.95, 0.0, 0.1, 0.0},
     BRDF_EXACT,
     NULL},
};

#define BRDF_LIBRARY_COUNT (sizeof brdf_library / sizeof brdf_library[0])

lrcs_brdf lrcs_brdf_default(void)
{
    return (lrcs_brdf){1.0, 0.25, 0.2, 0.5};
}

int lrcs_brdf_check(const lrcs_brdf *brdf)
{
    if (!isfinite(brdf->A) || !isfinite(brdf->B) || !isfinite(brdf->s) || !isfinite(brdf->m)) {
        return LRCS_E_NUMBER;
    }
    if (brdf->A < 0.0 || brdf->B < 0.0 || brdf->s < 0.0 || brdf->m < 0.0) {
        return LRCS_E_NUMBER;
    }
    if (brdf->s == 0.0 && brdf->A > 0.0) {
        return LRCS_E_NUMBER;
    }
    int bits = 0;
    if (brdf->A > 0.0 && brdf->s > 0.7) {
        bits |= LRCS_BRDF_SLOPE_LARGE;
    }
    if (LRCS_PI * brdf->B > 1.0) {
        bits |= LRCS_BRDF_DIFFUSE_GAIN;
    }
    if (4.0 * LRCS_PI * brdf->A * brdf->s * brdf->s > 1.0) {
        bits |= LRCS_BRDF_GLINT_GAIN;
    }
    if (brdf->A == 0.0 && brdf->B == 0.0) {
        bits |= LRCS_BRDF_DARK;
    }
    return bits;
}

/* Pivots and the rest of their rows below these count as 0 (correlation_fits). */
#define CORRELATION_PIVOT 1e-7
#define CORRELATION_REST  1e-3

/* The matrix of correlations is positive semidefinite if and only if elimination meets no negative
   pivot; a pivot of 0 is accepted if the rest of its row is 0. Rounded correlations of nearly
   dependent parameters give such pivots to 1e-7, and rows to the root of that. */
static int correlation_fits(const double correlation[6])
{
    const double *c = correlation;
    double a[4][4] = {
        {1, c[0], c[1], c[2]}, {c[0], 1, c[3], c[4]}, {c[1], c[3], 1, c[5]}, {c[2], c[4], c[5], 1}};
    for (int k = 0; k < 4; k++) {
        if (a[k][k] < -CORRELATION_PIVOT) {
            return 0;
        }
        for (int i = k + 1; i < 4; i++) {
            double factor = a[k][k] > CORRELATION_PIVOT ? a[i][k] / a[k][k] : 0.0;
            if (!(a[k][k] > CORRELATION_PIVOT) && fabs(a[i][k]) > CORRELATION_REST) {
                return 0;
            }
            for (int j = k + 1; j < 4; j++) {
                a[i][j] -= factor * a[k][j];
            }
        }
    }
    return 1;
}

int lrcs_brdf_error_check(const lrcs_brdf *brdf, const lrcs_brdf_error *error)
{
    const double deviation[4] = {error->A, error->B, error->s, error->m};
    for (int i = 0; i < 4; i++) {
        if (!(deviation[i] >= 0.0) || !isfinite(deviation[i])) {
            return LRCS_E_NUMBER;
        }
    }
    for (int i = 0; i < 6; i++) {
        if (!(fabs(error->correlation[i]) <= 1.0)) {
            return LRCS_E_NUMBER;
        }
    }
    if (!correlation_fits(error->correlation)) {
        return LRCS_E_NUMBER;
    }
    return brdf->s == 0.0 && (error->A > 0.0 || error->s > 0.0) ? LRCS_E_ARGUMENT : LRCS_OK;
}

const char *lrcs_brdf_warning_text(int bit)
{
    switch (bit) {
    case LRCS_BRDF_SLOPE_LARGE:
        return "s is above 0.7: the glint of a plate peaks away from its normal";
    case LRCS_BRDF_DIFFUSE_GAIN:
        return "pi B is above 1: the diffuse term reflects more light than it receives";
    case LRCS_BRDF_GLINT_GAIN:
        return "4 pi A s^2 is above 1: the glint reflects more light than it receives";
    case LRCS_BRDF_DARK:
        return "A and B are both 0: nothing is reflected";
    default:
        return "unknown warning";
    }
}

double lrcs_brdf_eval(const lrcs_brdf *brdf, double cos_theta)
{
    if (!(cos_theta > 0.0)) {
        return 0.0;
    }
    double sum = brdf->B > 0.0 ? brdf->B * lrcsi_power(lrcsi_log(cos_theta), brdf->m) : 0.0;
    if (brdf->A > 0.0) {
        /* 1 - cos is exact from cos = 1/2 up; sin^2 first, so that 1/cos^2 cannot overflow alone */
        double tan2 = (1.0 - cos_theta) * (1.0 + cos_theta) / cos_theta / cos_theta;
        lrcs_brdf glint = {brdf->A, 0.0, brdf->s, 0.0};
        double f_cos2 = lrcsi_reflect(&glint, fmax(tan2, 0.0), 0.0).glint;
        sum += f_cos2 > 0.0 ? f_cos2 / cos_theta / cos_theta : 0.0;
    }
    return sum;
}

const lrcs_brdf_entry *lrcs_brdf_library(uint32_t i)
{
    return i < BRDF_LIBRARY_COUNT ? &brdf_library[i] : NULL;
}

const lrcs_brdf_entry *lrcs_brdf_find(const char *name)
{
    for (size_t i = 0; i < BRDF_LIBRARY_COUNT; i++) {
        if (strcmp(brdf_library[i].name, name) == 0) {
            return &brdf_library[i];
        }
    }
    return NULL;
}
