/* SPDX-License-Identifier: MIT */
/* The laws of the surface, A, B, s and m, each with its comparisons of sigma, which this run
   computes. */
#include "study.h"

#include <math.h>

#define COUNT_OF(a) (sizeof(a) / sizeof((a)[0]))
#define LAW_TINY    1e-250 /* m2: ratios of less are not asked for */

static const double surface_aspects[] = {0.0, 20.0, 37.0, 60.0, 90.0, 123.0, 180.0};
static const double slopes[] = {0.05, 0.1, 0.2, 0.4};

/* ---- A and B ---- */

static void linear_checks(study_job *job, study_law *law, const lrcs_shape *shape, double aspect)
{
    const lrcs_brdf glint = study_finish(job, STUDY_GLINT);
    const lrcs_brdf diffuse = study_finish(job, STUDY_DIFFUSE);
    const lrcs_brdf twice[] = {study_with(glint, 'A', 2.0 * glint.A),
                               study_with(diffuse, 'B', 2.0 * diffuse.B)};
    study_number g = study_sigma(job, shape, &glint, aspect);
    study_number d = study_sigma(job, shape, &diffuse, aspect);
    study_number both = study_sigma(job, shape, &job->brdf, aspect);
    if (g.value > LAW_TINY) {
        study_number more = study_sigma(job, shape, &twice[0], aspect);
        study_equal(law, study_exact(more.value / g.value), 2.0);
    }
    if (d.value > LAW_TINY) {
        study_number more = study_sigma(job, shape, &twice[1], aspect);
        study_equal(law, study_exact(more.value / d.value), 2.0);
    }
    if (both.value > LAW_TINY) {
        study_equal(law, study_scaled(study_ratio(study_sum(g, d), both), 2.0), 2.0);
    }
}

static void linear_law(study_job *job)
{
    study_law *law = study_law_add(
        job, "linear in A and B",
        "sigma after doubling A or B over sigma before, and twice (glint + diffuse) / mixed");
    for (int kind = 0; kind < STUDY_KINDS; kind++) {
        const lrcs_shape shape = study_body(kind);
        for (size_t i = 0; i < COUNT_OF(surface_aspects); i++) {
            linear_checks(job, law, &shape, surface_aspects[i]);
        }
    }
    snprintf(
        law->text, sizeof law->text,
        "sigma = A g + B d, with g and d functions of shape, attitude, s and m alone: a mixed "
        "surface returns the sum of its specular and diffuse parts; twice A doubles the glint "
        "and leaves the rest, twice B doubles the rest. Doubling is exact to the last bit, the "
        "sum holds within the bounds.");
    snprintf(law->range, sizeof law->range, "All bodies and attitudes: an identity of the model.");
}

/* ---- a flat face ---- */

static void flat_law(study_job *job)
{
    static const double m[] = {0.0, 1.0, 5.0, 20.0};
    study_law *law = study_law_add(job, "flat face at its normal",
                                   "sigma / (4 pi (A + B) S), and disc / square");
    const lrcs_shape plate = {.kind = LRCS_SHAPE_PLATE, .size = {1.0, 1.0}};
    const lrcs_shape disc = study_wall(STUDY_DISC, 0.0);
    study_number expected = {LRCS_FOUR_PI * (job->brdf.A + job->brdf.B), 0.0};
    expected.bound = 0x1p-50 * expected.value; /* three roundings, and pi's */
    for (size_t i = 0; i < COUNT_OF(slopes); i++) {
        const lrcs_brdf brdf = study_with(study_with(job->brdf, 's', slopes[i]), 'm', m[i]);
        study_number peak = study_sigma(job, &plate, &brdf, 0.0);
        study_equal(law, study_ratio(peak, expected), 1.0);
    }
    for (double aspect = 0.0; aspect < 90.0; aspect += 5.0) {
        study_number square = study_sigma(job, &plate, &job->brdf, aspect);
        study_number round = study_sigma(job, &disc, &job->brdf, aspect);
        round = study_meant(round);
        study_equal(law, study_ratio(round, square), 1.0);
    }
    snprintf(
        law->text, sizeof law->text,
        "A flat face at normal incidence returns 4 pi (A + B) S = %.6g m² for 1 m², whatever s "
        "and m; its outline does not matter at any angle, only its area (square and disc agree).",
        expected.value);
    snprintf(
        law->range, sizeof law->range,
        "Incoherent scattering, spot larger than the target: no diffraction lobe of the outline.");
}

/* ---- s: width ---- */

/* (angle / (s sqrt(ln 2)) - 1) / s^2, which is to lie between 0 and 1. */
static void width_check(study_law *law, study_number half_deg, double s)
{
    study_number first = {s * sqrt(log(2.0)) * 180.0 / LRCS_PI, 0.0};
    first.bound = 0x1p-49 * first.value; /* of some ten roundings */
    study_number more = study_sum(study_ratio(half_deg, first), study_exact(-1.0));
    study_number square = {s * s, 0x1p-52 * s * s};
    study_within(law, study_ratio(more, square), 0.0, 1.0);
}

static void width_law(study_job *job)
{
    study_law *law =
        study_law_add(job, "glint width", "(half-power angle / (s sqrt(ln 2)) - 1) / s²");
    const lrcs_shape disc = study_wall(STUDY_DISC, 0.0);
    const lrcs_shape cylinder = study_wall(STUDY_CYLINDER, 0.0);
    double deg[COUNT_OF(slopes)];
    for (size_t i = 0; i < COUNT_OF(slopes); i++) {
        const lrcs_brdf brdf = study_with(study_finish(job, STUDY_GLINT), 's', slopes[i]);
        study_number flat = study_half_power(job, &disc, &brdf, 0.0, 1.0);
        study_number band = study_half_power(job, &cylinder, &brdf, 90.0, -1.0);
        width_check(law, flat, slopes[i]);
        width_check(law, band, slopes[i]);
        deg[i] = flat.value;
    }
    snprintf(
        law->text, sizeof law->text,
        "The glint of a flat face, and the band of a cylinder, falls to half at s sqrt(ln 2) = "
        "0.8326 s rad from its middle, to first order in s; the true angle is larger by a factor "
        "of 1 to 1 + s². A flat face: %.3g, %.3g, %.3g, %.3g deg at s = 0.05, 0.1, 0.2, 0.4.",
        deg[0], deg[1], deg[2], deg[3]);
    snprintf(
        law->range, sizeof law->range,
        "s from 0.05 to 0.4. The width follows s only while s is small: at 0.2 it is %.1f %%, at "
        "0.4 %.1f %% above the first order.",
        100.0 * (deg[2] * LRCS_PI / 180.0 / (0.2 * sqrt(log(2.0))) - 1.0),
        100.0 * (deg[3] * LRCS_PI / 180.0 / (0.4 * sqrt(log(2.0))) - 1.0));
}

/* ---- s: height ---- */

/* log2 has a slope of 1 / (x ln 2), largest at the lower end of the interval. */
static study_number number_log2(study_number x)
{
    double value = log2(x.value);
    double bound = x.bound / ((x.value - x.bound) * 0.69);
    return (study_number){value, bound + 0x1p-51 * fabs(value) + 0x1p-1074};
}

/* What a doubling of s from slopes[i] does to a glint's height, as a power. */
static study_number height_power(study_job *job, int kind, size_t i)
{
    const lrcs_brdf glint = study_finish(job, STUDY_GLINT);
    const lrcs_brdf narrow = study_with(glint, 's', slopes[i]);
    const lrcs_brdf wide = study_with(glint, 's', slopes[i + 1]);
    return number_log2(study_ratio(study_wall_sigma(job, kind, STUDY_HALF, &wide),
                                   study_wall_sigma(job, kind, STUDY_HALF, &narrow)));
}

/* The powers are 0, 1 or 2 to first order. */
static void height_law(study_job *job)
{
    static const struct {
        int kind;
        double power;
    } wall[] = {{STUDY_DISC, 0.0}, {STUDY_CONE, 1.0}, {STUDY_CYLINDER, 1.0}, {STUDY_SPHERE, 2.0}};
    study_law *law =
        study_law_add(job, "glint height", "log2 of what a doubling of s does to the height");
    double power[COUNT_OF(wall)];
    for (size_t k = 0; k < COUNT_OF(wall); k++) {
        power[k] = height_power(job, wall[k].kind, 0).value;
        for (size_t i = 0; i < 3; i++) {
            study_number of = height_power(job, wall[k].kind, i);
            double room = 3.0 * slopes[i + 1] * slopes[i + 1];
            study_within(law, of, wall[k].power - room, wall[k].power + room);
        }
    }
    snprintf(law->text, sizeof law->text,
             "Each direction in which a wall curves costs its glint a factor of the order of s: at "
             "the same surface the height goes with s^0 on a flat face, s^1 on a cylinder or cone, "
             "s^2 on a sphere (powers between s = 0.05 and 0.1: %.3f, %.3f, %.3f, %.3f).",
             power[0], power[2], power[1], power[3]);
    snprintf(
        law->range, sizeof law->range,
        "Doublings of s from 0.05 to 0.4; the powers hold to 3 s², s being the larger one. Walls "
        "that close round: an arc that turns by no more than a few s loses glint at its edges.");
}

/* ---- a cone's band ---- */

/* The middle of a cone's band: higher than s^2 rad to either side, and 1/cos(half-angle) times that
   of a cylinder. Returns that gain. */
static double band_checks(study_job *job, study_law *law, double half_angle, double s)
{
    const lrcs_shape cone = study_wall(STUDY_CONE, half_angle);
    const lrcs_brdf brdf = study_with(study_finish(job, STUDY_GLINT), 's', s);
    double middle = study_normal(STUDY_CONE, half_angle);
    double off = 180.0 / LRCS_PI * s * s;
    study_number peak = study_sigma(job, &cone, &brdf, middle);
    study_order(law, peak, study_sigma(job, &cone, &brdf, middle + off));
    study_order(law, peak, study_sigma(job, &cone, &brdf, middle - off));
    study_number cylinder = study_wall_sigma(job, STUDY_CYLINDER, 0.0, &brdf);
    study_number gain = study_ratio(study_meant(peak), cylinder);
    study_number secant = {1.0 / cos(half_angle * LRCS_PI / 180.0), 0.0};
    secant.bound = 0x1p-48 * secant.value; /* of an angle of 60 deg at most */
    study_within(law, study_ratio(gain, secant), 1.0 - 2.0 * s * s, 1.0 + 2.0 * s * s);
    return gain.value;
}

static void band_law(study_job *job)
{
    static const double angle[] = {15.0, 30.0, 45.0, 60.0};
    study_law *law = study_law_add(
        job, "cone's glint band",
        "sigma s² rad off / sigma in the middle, and the gain over the cylinder times "
        "cos(half-angle)");
    double at30 = 0.0;
    for (size_t i = 0; i < COUNT_OF(angle); i++) {
        for (size_t k = 0; k < 3; k++) {
            double gain = band_checks(job, law, angle[i], slopes[k]);
            at30 = i == 1 && k == 1 ? gain : at30;
        }
    }
    snprintf(
        law->text, sizeof law->text,
        "A cone's wall glints in a band about the aspect 90 deg - half-angle, a cylinder's in a "
        "band about broadside. The cone's peak lies there to within s² rad, and at the same "
        "surface is 1/cos(half-angle) times the cylinder's, to first order in s: %.5g at 30 deg "
        "and s = 0.1 (1/cos is 1.1547).",
        at30);
    snprintf(
        law->range, sizeof law->range,
        "Half-angles of 15 to 60 deg, s from 0.05 to 0.2: sigma is larger in the middle than at "
        "s² rad to either side, so that a peak lies between; the height, to 2 s².");
}

/* ---- m ---- */

/* Walls of 1 m2 against the disc, all at normal incidence: 1, 1/(2 (m + 3)) and, within a
   hundredth, 1/sqrt(2 pi (m + 5/2)). */
static void m_checks(study_job *job, study_law *law, double m)
{
    const lrcs_brdf flat = study_finish(job, STUDY_DIFFUSE);
    const lrcs_brdf brdf = study_with(flat, 'm', m);
    study_number unit = study_wall_sigma(job, STUDY_DISC, 0.0, &flat);
    study_number disc = study_wall_sigma(job, STUDY_DISC, 0.0, &brdf);
    study_number sphere = study_wall_sigma(job, STUDY_SPHERE, 0.0, &brdf);
    study_number cylinder = study_wall_sigma(job, STUDY_CYLINDER, 0.0, &brdf);
    study_number root = {sqrt(2.0 * LRCS_PI * (m + 2.5)), 0.0};
    root.bound = 0x1p-50 * root.value;
    cylinder = study_ratio(cylinder, unit);
    cylinder = study_ratio(cylinder, study_ratio(study_exact(1.0), root));
    sphere = study_ratio(study_scaled(sphere, 2.0 * (m + 3.0)), unit);
    study_equal(law, study_ratio(disc, unit), 1.0);
    study_equal(law, sphere, 1.0);
    study_within(law, cylinder, 0.99, 1.0);
}

/* cos(theta)^(m + 2) = 1/2 of a flat face. */
static double lobe_check(study_job *job, study_law *law, double m)
{
    const lrcs_brdf brdf = study_with(study_finish(job, STUDY_DIFFUSE), 'm', m);
    const lrcs_shape disc = study_wall(STUDY_DISC, 0.0);
    study_number half = study_half_power(job, &disc, &brdf, 0.0, 1.0);
    study_number expected = {acos(exp2(-1.0 / (m + 2.0))) * 180.0 / LRCS_PI, 0.0};
    expected.bound = 0x1p-46 * expected.value; /* acos enlarges what exp2 rounds 16-fold */
    study_equal(law, study_ratio(half, expected), 1.0);
    return half.value;
}

static void m_law(study_job *job)
{
    static const double m[] = {0.0, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0};
    study_law *law =
        study_law_add(job, "diffusivity m", "height or half-power angle / stated value");
    double half[COUNT_OF(m)];
    for (size_t i = 0; i < COUNT_OF(m); i++) {
        m_checks(job, law, m[i]);
        half[i] = lobe_check(job, law, m[i]);
    }
    snprintf(
        law->text, sizeof law->text,
        "m narrows the diffuse lobe: of a flat face it falls to half at acos(2^(-1/(m+2))), "
        "%.3g deg at m = 0, %.3g at 1, %.3g at 5, %.3g at 20. The height stays on a flat face, "
        "falls as (m + 5/2)^(-1/2) on a cylinder (to 1 %%) and as 1/(m + 3) on a sphere.",
        half[0], half[2], half[4], half[6]);
    snprintf(law->range, sizeof law->range,
             "m from 0 to 20, B held: f_r at normal incidence is what stays the same, not what is "
             "reflected in all.");
}

/* ---- where the glint ends ---- */

static void crossing_law(study_job *job)
{
    study_law *law = study_law_add(job, "where diffuse takes over",
                                   "(tan(theta) / (s sqrt(ln(A/B))) - 1) / ((3 + m/2) s²)");
    const lrcs_shape disc = study_wall(STUDY_DISC, 0.0);
    double power = 3.0 + 0.5 * job->brdf.m;
    double first = sqrt(log(job->brdf.A / job->brdf.B));
    double deg[3];
    for (size_t i = 0; i < 3; i++) {
        const lrcs_brdf glint = study_with(study_finish(job, STUDY_GLINT), 's', slopes[i]);
        const lrcs_brdf diffuse = study_with(study_finish(job, STUDY_DIFFUSE), 's', slopes[i]);
        study_number angle = study_crossing(job, &disc, &glint, &diffuse);
        /* twice the effect of the angle's bound, which includes the rounding of the tangent */
        study_number tangent = {tan(angle.value * LRCS_PI / 180.0), 0.0};
        tangent.bound = (1.0 + tangent.value * tangent.value) * angle.bound * LRCS_PI / 90.0;
        study_number expected = {slopes[i] * first, 0x1p-50 * slopes[i] * first};
        study_number more = study_sum(study_ratio(tangent, expected), study_exact(-1.0));
        study_number limit = {power * slopes[i] * slopes[i], 0x1p-50};
        study_within(law, study_ratio(more, limit), 0.0, 1.0);
        deg[i] = angle.value;
    }
    snprintf(law->text, sizeof law->text,
             "A flat face's glint exceeds its diffuse part up to tan(theta) = s sqrt(ln(A/B)), to "
             "first order in s: to %.3g, %.3g, %.3g deg at s = 0.05, 0.1, 0.2. Beyond, the surface "
             "returns as a diffuse one.",
             deg[0], deg[1], deg[2]);
    snprintf(law->range, sizeof law->range,
             "A > B and s from 0.05 to 0.2; the tangent is larger by a factor of at most 1 + (3 + "
             "m/2) s².");
}

void study_surface_laws(study_job *job)
{
    linear_law(job);
    flat_law(job);
    width_law(job);
    height_law(job);
    band_law(job);
    m_law(job);
    crossing_law(job);
}
