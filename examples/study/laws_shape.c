/* SPDX-License-Identifier: MIT */
/* The laws of size and shape, each with its comparisons of sigma, which this run computes. The
   sentences are completed with numbers of the run. */
#include "study.h"

#include <math.h>

#define COUNT_OF(a) (sizeof(a) / sizeof((a)[0]))
#define LAW_TINY    1e-250 /* m2: ratios of less are not asked for */

static const double law_aspects[] = {0.0, 20.0, 37.0, 60.0, 90.0, 123.0, 180.0};

/* ---- size ---- */

/* By powers of two to the bit, by other factors to within the bounds. */
static void size_checks(study_job *job, study_law *law, int kind, int finish, double factor)
{
    const lrcs_shape shape = study_body(kind);
    const lrcs_shape larger = study_scaled_body(shape, factor);
    const lrcs_brdf brdf = study_finish(job, finish);
    int exponent;
    int exact = frexp(factor, &exponent) == 0.5;
    for (size_t i = 0; i < COUNT_OF(law_aspects); i++) {
        study_number one = study_sigma(job, &shape, &brdf, law_aspects[i]);
        study_number other = study_sigma(job, &larger, &brdf, law_aspects[i]);
        if (one.value < LAW_TINY) {
            continue;
        }
        if (exact) {
            double ratio = other.value / one.value / (factor * factor);
            study_equal(law, study_exact(ratio), 1.0);
        } else {
            study_number ratio =
                study_ratio(study_meant(other), study_scaled(one, factor * factor));
            study_equal(law, ratio, 1.0);
        }
    }
}

static void size_law(study_job *job)
{
    static const double factor[] = {0.125, 0.5, 2.0, 8.0, 3.0, 10.0};
    study_law *law = study_law_add(job, "size", "sigma of the scaled body / (factor² sigma)");
    for (int kind = 0; kind < STUDY_KINDS; kind++) {
        for (int finish = 0; finish < STUDY_FINISHES; finish++) {
            for (size_t i = 0; i < COUNT_OF(factor); i++) {
                size_checks(job, law, kind, finish, factor[i]);
            }
        }
    }
    snprintf(
        law->text, sizeof law->text,
        "At the same shape, attitude and surface, sigma grows with the square of the size: "
        "twice as long is 6.02 dB more. For factors that are powers of two the computed values "
        "agree to the last bit, for 3 and 10 to within their bounds.");
    snprintf(law->range, sizeof law->range,
             "All bodies, kinds of surface and attitudes: the model has no length of its own.");
}

/* ---- attitude ---- */

/* The smallest sigma over the largest, of every whole degree. */
static study_number swing_of(study_job *job, int kind, int finish)
{
    const lrcs_shape shape = study_body(kind);
    const lrcs_brdf brdf = study_finish(job, finish);
    study_number least = {HUGE_VAL, 0.0};
    study_number most = {0.0, 0.0};
    for (int aspect = 0; aspect <= 180; aspect++) {
        study_number sigma = study_sigma(job, &shape, &brdf, aspect);
        least = sigma.value < least.value ? sigma : least;
        most = sigma.value > most.value ? sigma : most;
    }
    return study_ratio(least, most);
}

static void swing_law(study_job *job)
{
    study_law *law = study_law_add(
        job, "glints make the swing",
        "0.1 / (least / largest sigma) diffuse, (least / largest sigma) / 1e-4 specular");
    double db[STUDY_KINDS][2];
    for (int kind = STUDY_CUBE; kind <= STUDY_CONE; kind++) {
        study_number diffuse = swing_of(job, kind, STUDY_DIFFUSE);
        study_number glint = swing_of(job, kind, STUDY_GLINT);
        study_order(law, diffuse, study_exact(0.1));
        study_order(law, study_exact(1e-4), glint);
        db[kind][STUDY_DIFFUSE] = -study_dbsm(diffuse.value);
        db[kind][STUDY_GLINT] = -study_dbsm(glint.value);
    }
    snprintf(
        law->text, sizeof law->text,
        "Attitude matters little to diffuse bodies and decides everything for specular ones: "
        "turned about a transverse axis, sigma of cube, cylinder and cone swings by %.1f, %.1f, "
        "%.1f dB where purely diffuse (10 dB at most) and by %.0f, %.0f, %.0f dB where purely "
        "specular (40 dB at least).",
        db[STUDY_CUBE][0], db[STUDY_CYLINDER][0], db[STUDY_CONE][0], db[STUDY_CUBE][1],
        db[STUDY_CYLINDER][1], db[STUDY_CONE][1]);
    snprintf(
        law->range, sizeof law->range,
        "These proportions, the surface's s and m, every whole degree. Between glints any diffuse "
        "part, however small, sets the floor.");
}

/* ---- order at the same surface ---- */

static study_number axis_sigma(study_job *job, int kind, int finish)
{
    const lrcs_shape shape = study_body(kind);
    const lrcs_brdf brdf = study_finish(job, finish);
    return study_sigma(job, &shape, &brdf, 0.0);
}

/* The largest whole half-angle of a diffuse cone of the surface that still returns less along its
   axis than the cylinder. */
static int axis_largest_cone(study_job *job)
{
    const lrcs_brdf brdf = study_finish(job, STUDY_DIFFUSE);
    study_number cylinder = axis_sigma(job, STUDY_CYLINDER, STUDY_DIFFUSE);
    int deg = 1;
    for (; deg < 89; deg++) {
        double sine = sin((deg + 1) * LRCS_PI / 180.0);
        const lrcs_shape cone = {.kind = LRCS_SHAPE_CONE,
                                 .radius = sqrt(STUDY_SURFACE / (LRCS_PI * (1.0 + 1.0 / sine))),
                                 .half_angle_deg = deg + 1};
        study_number sigma = study_sigma(job, &cone, &brdf, 0.0);
        if (!(sigma.value + sigma.bound < cylinder.value - cylinder.bound)) {
            break;
        }
    }
    return deg;
}

static void axis_law(study_job *job)
{
    double ratio[STUDY_FINISHES][2];
    study_law *law = study_law_add(job, "order along the axis",
                                   "sigma of the later / sigma of the earlier in the order");
    for (int finish = 0; finish < STUDY_FINISHES; finish++) {
        study_number disc = axis_sigma(job, STUDY_DISC, finish);
        study_number cylinder = axis_sigma(job, STUDY_CYLINDER, finish);
        study_number cone = axis_sigma(job, STUDY_CONE, finish);
        study_order(law, disc, cylinder);
        study_order(law, cylinder, cone);
        ratio[finish][0] = disc.value / cylinder.value;
        ratio[finish][1] = cylinder.value / cone.value;
    }
    snprintf(law->text, sizeof law->text,
             "Seen along the axis at the same total surface, disc > cylinder > cone, whatever the "
             "surface: disc : cylinder = %.4g, cylinder : cone = %.4g diffuse, %.3g specular, "
             "%.4g mixed.",
             ratio[STUDY_MIXED][0], ratio[STUDY_DIFFUSE][1], ratio[STUDY_GLINT][1],
             ratio[STUDY_MIXED][1]);
    snprintf(
        law->range, sizeof law->range,
        "Cylinder as long as wide, cone of half-angle %g deg seen nose-on. The diffuse order of "
        "cylinder and cone holds up to a half-angle of %d deg (in whole degrees); a flatter "
        "cone nears the disc.",
        STUDY_HALF, axis_largest_cone(job));
}

/* ---- order of walls ---- */

static const int wall_order[] = {STUDY_DISC, STUDY_CONE, STUDY_CYLINDER, STUDY_SPHERE};

static void wall_checks(study_job *job, study_law *law, double half_angle, const lrcs_brdf *brdf)
{
    study_number before = study_wall_sigma(job, wall_order[0], half_angle, brdf);
    for (size_t k = 1; k < COUNT_OF(wall_order); k++) {
        study_number sigma = study_wall_sigma(job, wall_order[k], half_angle, brdf);
        study_order(law, before, sigma);
        before = sigma;
    }
}

static void wall_law(study_job *job)
{
    static const double angle[] = {15.0, 30.0, 45.0, 60.0, 75.0};
    const lrcs_brdf glint = study_finish(job, STUDY_GLINT);
    study_law *law = study_law_add(job, "order of curved walls",
                                   "sigma of the later / sigma of the earlier in the order");
    double height[COUNT_OF(wall_order)];
    for (int finish = 0; finish < STUDY_FINISHES; finish++) {
        const lrcs_brdf brdf = study_finish(job, finish);
        for (size_t i = 0; i < COUNT_OF(angle); i++) {
            wall_checks(job, law, angle[i], &brdf);
        }
    }
    for (size_t k = 0; k < COUNT_OF(wall_order); k++) {
        height[k] = study_wall_sigma(job, wall_order[k], STUDY_HALF, &glint).value;
    }
    snprintf(
        law->text, sizeof law->text,
        "At the same reflecting surface and normal incidence, disc > cone wall > cylinder wall "
        "> sphere, whatever the surface: the less a wall curves away from its normal, the more "
        "it returns. Glints of 1 m²: %.4g, %.4g, %.4g, %.4g m².",
        height[0], height[1], height[2], height[3]);
    snprintf(
        law->range, sizeof law->range,
        "Cones of half-angle 15 to 75 deg, at the aspect 90 deg - half-angle. It follows wherever "
        "f_r cos² falls with the angle (s below 0.7): of equal parts of the surface none of a "
        "wall earlier in the order is tilted more than its like of a later one.");
}

/* ---- largest flat face ---- */

static const double face_area[] = {0.5, 1.0 / 6.0, 1.0 / 6.0, 1.0 / 3.0}; /* of the surface */

static void face_law(study_job *job)
{
    study_law *law = study_law_add(job, "largest flat face",
                                   "peak / (4 pi (A + B) S), and sigma elsewhere / peak");
    double flat = LRCS_FOUR_PI * (job->brdf.A + job->brdf.B);
    double peak_dbsm[STUDY_SPHERE + 1];
    for (int kind = STUDY_DISC; kind <= STUDY_CONE; kind++) {
        const lrcs_shape shape = study_body(kind);
        study_number expected = {face_area[kind] * STUDY_SURFACE * flat, 0.0};
        expected.bound = 0x1p-49 * expected.value; /* of some ten roundings */
        study_number peak =
            study_meant(study_sigma(job, &shape, &job->brdf, kind == STUDY_CONE ? 180.0 : 0.0));
        study_equal(law, study_ratio(peak, expected), 1.0);
        for (double aspect = 1.0; aspect < 180.0; aspect += 1.0) {
            if (kind != STUDY_CUBE || fmod(aspect, 90.0) != 0.0) {
                study_number sigma = study_sigma(job, &shape, &job->brdf, aspect);
                study_order(law, peak, sigma);
            }
        }
        peak_dbsm[kind] = study_dbsm(peak.value);
    }
    snprintf(
        law->text, sizeof law->text,
        "Disc, cube, cylinder and cone are brightest where their largest flat face is seen along "
        "its normal: 4 pi (A + B) times its area. At 6 m² of surface: disc %.2f, cone (base) %.2f, "
        "cylinder (end) and cube %.2f dBsm.",
        peak_dbsm[STUDY_DISC], peak_dbsm[STUDY_CONE], peak_dbsm[STUDY_CUBE]);
    snprintf(law->range, sizeof law->range,
             "These bodies and this material, at every whole degree. A long cylinder's broadside "
             "glint exceeds its ends' where R < L s / sqrt(pi), to first order in s.");
}

/* ---- the same silhouette ---- */

static study_number silhouette_sigma(study_job *job, int kind, int finish)
{
    const lrcs_shape shape = study_silhouette(kind);
    const lrcs_brdf brdf = study_finish(job, finish);
    return study_meant(study_sigma(job, &shape, &brdf, 90.0));
}

static void silhouette_law(study_job *job)
{
    study_law *law = study_law_add(job, "equal projected area", "smaller / larger sigma");
    study_number sigma[STUDY_FINISHES][STUDY_KINDS];
    for (int finish = 0; finish < STUDY_FINISHES; finish++) {
        for (int kind = STUDY_CUBE; kind < STUDY_KINDS; kind++) {
            sigma[finish][kind] = silhouette_sigma(job, kind, finish);
        }
        study_order(law, sigma[finish][STUDY_CUBE], sigma[finish][STUDY_CYLINDER]);
        study_order(law, sigma[finish][STUDY_CYLINDER], sigma[finish][STUDY_CONE]);
        study_order(law, sigma[finish][STUDY_CYLINDER], sigma[finish][STUDY_SPHERE]);
    }
    const study_number *d = sigma[STUDY_DIFFUSE];
    const study_number *g = sigma[STUDY_GLINT];
    study_order(law, g[STUDY_SPHERE], g[STUDY_CONE]);
    snprintf(
        law->text, sizeof law->text,
        "The projected area alone does not tell sigma: at the same one a cube's face returns "
        "more than a cylinder, which returns more than a cone or a sphere, whatever the surface. "
        "For 1 m², diffuse: %.4g, %.4g, %.4g, %.4g m²; specular: %.4g, %.4g, %.3g, %.4g m², of "
        "which the sphere's is larger than the cone's.",
        d[STUDY_CUBE].value, d[STUDY_CYLINDER].value, d[STUDY_CONE].value, d[STUDY_SPHERE].value,
        g[STUDY_CUBE].value, g[STUDY_CYLINDER].value, g[STUDY_CONE].value, g[STUDY_SPHERE].value);
    snprintf(
        law->range, sizeof law->range,
        "Seen at 90 deg from the axis, cone of half-angle %g deg: its wall is nowhere seen closer "
        "to its normal than that, and one of a half-angle below s or so would glint. Of the "
        "diffuse cone and sphere, this cone returns more for m below 1, the sphere above.",
        STUDY_HALF);
}

/* ---- a tilted wall ---- */

/* The sine's relative error, 6 * 2^-53 with that of its argument, enters m + 1 times; pow adds 4.
 */
static void tilt_law(study_job *job)
{
    static const double angle[] = {10.0, 20.0, 30.0, 45.0, 60.0, 75.0};
    study_law *law =
        study_law_add(job, "diffuse tilt", "sigma of cone / (sigma of disc sin(half-angle)^(m+1))");
    const lrcs_brdf brdf = study_finish(job, STUDY_DIFFUSE);
    const lrcs_shape disc = {.kind = LRCS_SHAPE_DISC, .radius = 1.0};
    study_number flat = study_sigma(job, &disc, &brdf, 0.0);
    for (size_t i = 0; i < COUNT_OF(angle); i++) {
        const lrcs_shape cone = {.kind = LRCS_SHAPE_CONE,
                                 .parts = LRCS_SHAPE_WALL,
                                 .radius = 1.0,
                                 .half_angle_deg = angle[i]};
        study_number expected = {pow(sin(angle[i] * LRCS_PI / 180.0), brdf.m + 1.0), 0.0};
        expected.bound = (12.0 + 6.0 * brdf.m) * 0x1p-53 * expected.value;
        study_number ratio = study_ratio(study_sigma(job, &cone, &brdf, 0.0), flat);
        study_equal(law, study_ratio(ratio, expected), 1.0);
    }
    snprintf(
        law->text, sizeof law->text,
        "For each unit of projected area a diffuse wall tilted by theta returns cos(theta)^(m+1)"
        " of what it returns face-on: a cone seen nose-on is the disc of its base times "
        "sin(half-angle)^(m+1) = %.4g at %g deg.",
        pow(sin(STUDY_HALF * LRCS_PI / 180.0), brdf.m + 1.0), STUDY_HALF);
    snprintf(law->range, sizeof law->range, "Diffuse part, any m: an identity of the model.");
}

/* ---- means ---- */

/* The sphere of the same surface is the mean of any convex body, S (pi A E + 2 pi B / (m + 3)). */
static void mean_law(study_job *job)
{
    study_law *law = study_law_add(job, "attitude mean", "mean / sigma of the sphere");
    const lrcs_shape sphere = study_body(STUDY_SPHERE);
    double worst = 0.0;
    double of[STUDY_FINISHES];
    law->estimate = 1;
    for (int finish = 0; finish < STUDY_FINISHES; finish++) {
        const lrcs_brdf brdf = study_finish(job, finish);
        study_number expected = study_meant(study_sigma(job, &sphere, &brdf, 0.0));
        for (int kind = 0; kind < STUDY_SPHERE; kind++) {
            const lrcs_shape shape = study_body(kind);
            study_number ratio = study_ratio(study_mean(job, &shape, &brdf), expected);
            study_within(law, ratio, 1.0 - 1e-7, 1.0 + 1e-7);
            worst = fmax(worst, fabs(ratio.value - 1.0));
        }
        of[finish] = expected.value;
    }
    snprintf(
        law->text, sizeof law->text,
        "Over all attitudes shape does not matter: the mean of any convex body of one material is "
        "sigma of the sphere of the same surface, S [pi A E + 2 pi B / (m + 3)] with E = s² + "
        "(sqrt(pi)/2) s³ erfcx(1/s). At 6 m²: %.6g diffuse + %.6g specular = %.6g m²; disc, cube, "
        "cylinder and cone differ from it by at most %.1e of it.",
        of[STUDY_DIFFUSE], of[STUDY_GLINT], of[STUDY_MIXED], 1.1 * worst);
    snprintf(
        law->range, sizeof law->range,
        "Convex bodies: nothing is hidden, and every element of the surface is seen at all angles "
        "alike. Means by quadrature, held to 1e-7. The mean hides how unevenly glints are "
        "spread over attitudes.");
}

/* ---- how rare a glint is ---- */

static void share_law(study_job *job)
{
    study_law *law = study_law_add(job, "higher glints are rarer",
                                   "share of the higher / share of the lower glint");
    const lrcs_brdf brdf = study_finish(job, STUDY_GLINT);
    study_number share[3];
    for (int k = 0; k < 3; k++) {
        share[k] = study_share(job, wall_order[k], STUDY_HALF, &brdf);
    }
    study_order(law, share[1], share[0]);
    study_order(law, share[2], share[1]);
    study_order(law, study_exact(1.0), share[2]);
    snprintf(
        law->text, sizeof law->text,
        "What a wall gains in the height of its glint it loses in how often it is seen. Within "
        "half power of normal incidence lie %.3g %% of all attitudes for a flat face (a spike: s² "
        "ln 2 / 4 to first order), %.3g %% for a cone and %.3g %% for a cylinder (bands: s sqrt(ln "
        "2) for the cylinder); a sphere shows its glint always.",
        100.0 * share[0].value, 100.0 * share[1].value, 100.0 * share[2].value);
    snprintf(law->range, sizeof law->range,
             "One-sided flat face, cone of half-angle %g deg, s of this material.", STUDY_HALF);
}

void study_shape_laws(study_job *job)
{
    size_law(job);
    swing_law(job);
    axis_law(job);
    wall_law(job);
    face_law(job);
    silhouette_law(job);
    tilt_law(job);
    share_law(job);
    mean_law(job);
}
