/* SPDX-License-Identifier: MIT */
/* The bodies of the study: which dimensions give them the same surface, the same reflecting wall
   or the same silhouette, and their sigma from closed forms. */
#include "study.h"

#include <math.h>

static const struct {
    const char *name;
    int colour;
} study_looks[STUDY_KINDS] = {[STUDY_DISC] = {"disc", LRCS_HOST_BLACK},
                              [STUDY_CUBE] = {"cube", LRCS_HOST_BLUE},
                              [STUDY_CYLINDER] = {"cylinder", LRCS_HOST_VERMILION},
                              [STUDY_CONE] = {"cone", LRCS_HOST_GREEN},
                              [STUDY_SPHERE] = {"sphere", LRCS_HOST_PURPLE}};

const char *study_name(int kind)
{
    return study_looks[kind].name;
}

int study_colour(int kind)
{
    return study_looks[kind].colour;
}

static double radian_of(double deg)
{
    return deg * (LRCS_PI / 180.0);
}

/* Disc 2 pi R^2 (a cylinder of no length); cylinder of L = 2R 6 pi R^2; cone of half-angle 30 deg
   3 pi R^2; sphere 4 pi R^2. */
lrcs_shape study_body(int kind)
{
    switch (kind) {
    case STUDY_CUBE: {
        double side = sqrt(STUDY_SURFACE / 6.0);
        return (lrcs_shape){.kind = LRCS_SHAPE_BOX, .size = {side, side, side}};
    }
    case STUDY_CYLINDER: {
        double radius = sqrt(STUDY_SURFACE / (6.0 * LRCS_PI));
        return (lrcs_shape){.kind = LRCS_SHAPE_CYLINDER, .radius = radius, .length = 2.0 * radius};
    }
    case STUDY_CONE:
        return (lrcs_shape){.kind = LRCS_SHAPE_CONE,
                            .radius = sqrt(STUDY_SURFACE / (3.0 * LRCS_PI)),
                            .half_angle_deg = STUDY_HALF};
    case STUDY_SPHERE:
        return (lrcs_shape){.kind = LRCS_SHAPE_SPHERE,
                            .radius = sqrt(STUDY_SURFACE / LRCS_FOUR_PI)};
    default:
        return (lrcs_shape){.kind = LRCS_SHAPE_CYLINDER,
                            .radius = sqrt(STUDY_SURFACE / (2.0 * LRCS_PI))};
    }
}

/* Disc pi R^2; cylinder 2 pi R L; cone pi R^2 / sin(half-angle); sphere 4 pi R^2. */
lrcs_shape study_wall(int kind, double half_angle_deg)
{
    switch (kind) {
    case STUDY_CYLINDER: {
        double radius = sqrt(1.0 / LRCS_FOUR_PI);
        return (lrcs_shape){.kind = LRCS_SHAPE_CYLINDER,
                            .parts = LRCS_SHAPE_WALL,
                            .radius = radius,
                            .length = 2.0 * radius};
    }
    case STUDY_CONE:
        return (lrcs_shape){.kind = LRCS_SHAPE_CONE,
                            .parts = LRCS_SHAPE_WALL,
                            .radius = sqrt(sin(radian_of(half_angle_deg)) / LRCS_PI),
                            .half_angle_deg = half_angle_deg};
    case STUDY_SPHERE:
        return (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = sqrt(1.0 / LRCS_FOUR_PI)};
    default:
        return (lrcs_shape){.kind = LRCS_SHAPE_DISC, .radius = sqrt(1.0 / LRCS_PI)};
    }
}

/* Cube a^2; cylinder of L = 2R 4 R^2; cone R^2 / tan(half-angle); sphere pi R^2. */
lrcs_shape study_silhouette(int kind)
{
    switch (kind) {
    case STUDY_CUBE:
        return (lrcs_shape){.kind = LRCS_SHAPE_BOX, .size = {1.0, 1.0, 1.0}};
    case STUDY_CYLINDER:
        return (lrcs_shape){.kind = LRCS_SHAPE_CYLINDER, .radius = 0.5, .length = 1.0};
    case STUDY_CONE:
        return (lrcs_shape){.kind = LRCS_SHAPE_CONE,
                            .radius = sqrt(tan(radian_of(STUDY_HALF))),
                            .half_angle_deg = STUDY_HALF};
    default:
        return (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = sqrt(1.0 / LRCS_PI)};
    }
}

lrcs_shape study_scaled_body(lrcs_shape shape, double factor)
{
    for (int i = 0; i < 3; i++) {
        shape.size[i] *= factor;
    }
    shape.radius *= factor;
    shape.length *= factor;
    return shape;
}

double study_normal(int kind, double half_angle_deg)
{
    return kind == STUDY_CYLINDER ? 90.0 : kind == STUDY_CONE ? 90.0 - half_angle_deg : 0.0;
}

lrcs_brdf study_finish(const study_job *job, int finish)
{
    lrcs_brdf brdf = job->brdf;
    brdf.A = finish == STUDY_DIFFUSE ? 0.0 : brdf.A;
    brdf.B = finish == STUDY_GLINT ? 0.0 : brdf.B;
    return brdf;
}

lrcs_brdf study_with(lrcs_brdf brdf, char parameter, double value)
{
    double *at = parameter == 'A'   ? &brdf.A
                 : parameter == 'B' ? &brdf.B
                 : parameter == 's' ? &brdf.s
                                    : &brdf.m;
    *at = value;
    return brdf;
}

study_number study_sigma_at(study_job *job, const lrcs_shape *shape, const lrcs_brdf *brdf,
                            const lrcs_aspect *aspect)
{
    lrcs_closed_form closed;
    int status = lrcs_closed_eval(shape, brdf, aspect, &closed);
    if (status == LRCS_OK) {
        return (study_number){closed.sigma_m2, closed.bound_m2};
    }
    if (job->status == LRCS_OK) {
        job->status = status;
        snprintf(job->error.text, sizeof job->error.text, "closed form of a %s: %s",
                 lrcs_shape_text(shape->kind), lrcs_status_text(status));
    }
    return (study_number){(double)NAN, HUGE_VAL};
}

study_number study_sigma(study_job *job, const lrcs_shape *shape, const lrcs_brdf *brdf,
                         double aspect_deg)
{
    const lrcs_aspect aspect = {.deg = aspect_deg};
    return study_sigma_at(job, shape, brdf, &aspect);
}

/* Lengths are square roots of quotients with pi, and in one case with a sine. The relative error of
   each is at most 5 * 2^-53 if libm's sine is within 2 ulp; sigma is proportional to products of
   two. */
study_number study_meant(study_number sigma)
{
    sigma.bound += 16.0 * 0x1p-53 * fabs(sigma.value);
    return sigma;
}

study_number study_wall_sigma(study_job *job, int kind, double half_angle_deg,
                              const lrcs_brdf *brdf)
{
    const lrcs_shape shape = study_wall(kind, half_angle_deg);
    double normal = study_normal(kind, half_angle_deg);
    return study_meant(study_sigma(job, &shape, brdf, normal));
}
