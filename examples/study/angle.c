/* SPDX-License-Identifier: MIT */
/* Angles at which sigma has fallen to half or to another sigma: between two aspects that are proved
   to enclose such an angle, because sigma is continuous. */
#include "study.h"

#include <math.h>

typedef struct angle_search {
    const lrcs_shape *shape;
    const lrcs_brdf *falling, *other; /* other: NULL where the level is fixed */
    study_number level;
    double from_deg, side;
} angle_search;

/* 1: certainly above the level, -1: certainly below, 0: the bounds do not decide. */
static int level_side(study_job *job, const angle_search *search, double angle)
{
    double aspect = search->from_deg + search->side * angle;
    study_number sigma = study_sigma(job, search->shape, search->falling, aspect);
    study_number level =
        search->other ? study_sigma(job, search->shape, search->other, aspect) : search->level;
    return sigma.value - sigma.bound > level.value + level.bound   ? 1
           : sigma.value + sigma.bound < level.value - level.bound ? -1
                                                                   : 0;
}

/* The farthest angle that bisection proves to be on one side. */
static double level_edge(study_job *job, const angle_search *search, double sure, double unsure,
                         int side)
{
    for (int i = 0; i < 50; i++) {
        double middle = 0.5 * (sure + unsure);
        if (level_side(job, search, middle) == side) {
            sure = middle;
        } else {
            unsure = middle;
        }
    }
    return sure;
}

/* Sigma is continuous: it equals the level between an angle at which it is certainly above and a
   larger one at which it is certainly below. The sum of an aspect and an angle, below 256 deg, is
   rounded by 2^-46 deg at most. */
static study_number level_angle(study_job *job, const angle_search *search, double most)
{
    double above = level_edge(job, search, 0.0, most, 1);
    double below = level_edge(job, search, most, 0.0, -1);
    if (level_side(job, search, above) != 1 || level_side(job, search, below) != -1 ||
        above > below) {
        return (study_number){(double)NAN, HUGE_VAL};
    }
    return (study_number){0.5 * (above + below), 0.5 * (below - above) + 0x1p-45};
}

study_number study_half_power(study_job *job, const lrcs_shape *shape, const lrcs_brdf *brdf,
                              double aspect_deg, double side)
{
    study_number peak = study_sigma(job, shape, brdf, aspect_deg);
    const angle_search search = {.shape = shape,
                                 .falling = brdf,
                                 .level = {0.5 * peak.value, 0.5 * peak.bound},
                                 .from_deg = aspect_deg,
                                 .side = side};
    double room = side > 0.0 ? 180.0 - aspect_deg : aspect_deg;
    return level_angle(job, &search, fmin(room, 90.0));
}

study_number study_crossing(study_job *job, const lrcs_shape *shape, const lrcs_brdf *falling,
                            const lrcs_brdf *other)
{
    const angle_search search = {.shape = shape, .falling = falling, .other = other, .side = 1.0};
    return level_angle(job, &search, 60.0);
}

/* The solid angle of a zone of aspects a .. b is 2 pi (cos a - cos b); cosines change by no more
   than their angles, and are rounded. */
study_number study_share(study_job *job, int kind, double half_angle_deg, const lrcs_brdf *brdf)
{
    const lrcs_shape wall = study_wall(kind, half_angle_deg);
    double normal = study_normal(kind, half_angle_deg);
    const double radian = LRCS_PI / 180.0;
    study_number up = study_half_power(job, &wall, brdf, normal, 1.0);
    study_number down = {0.0, 0.0};
    if (kind != STUDY_DISC) {
        down = study_half_power(job, &wall, brdf, normal, -1.0);
    }
    double first = cos((normal - down.value) * radian);
    double last = cos((normal + up.value) * radian);
    return (study_number){0.5 * (first - last), 0.5 * radian * (up.bound + down.bound) + 0x1p-50};
}
