/* SPDX-License-Identifier: MIT */
/* Decides which curved shapes of a scene are divided more finely for a pose, and runs it with finer
   and finer divisions. If the tessellation makes a bound miss the tolerance, the parts that cause
   most of it are divided more finely, each by a number of halvings, and the pose is run again.

   How far the error due to a part falls is forecast by a factor for each halving, one for straight
   walls and one for round bodies. Most poses take two runs, the second of which meets the
   tolerance, or three if the tolerance is far below the error of the first; if the last does not
   meet it, the next forecast starts from its errors. */
#include "integrate/refine.h"

#include <math.h>
#include <string.h>

#include "base/work.h"
#include "mesh/shape/revolution.h"

/* Heuristics: the error due to a part falls by these factors with every halving (choices_start). If
   it falls less, the part is halved again; if it falls more, there are more facets than needed. */
#define ROUND_FACTOR    0.27
#define STRAIGHT_FACTOR 0.46
/* Of a straight wall that has been halved before. */
#define STRAIGHT_FACTOR_LATER 0.50
/* Divisions are chosen for this fraction of what the tolerance leaves for all parts together. */
#define TOLERANCE_FRACTION 0.8
/* If the error exceeds what is allowed by more than this factor, it is reduced in two runs, the
   first of which is aimed at the geometric mean of the two: it takes a tenth of the time of the
   second, and the forecast from its errors is more accurate. */
#define ONE_RUN_FACTOR 1e4
/* If parts were halved before and the error still exceeds what is allowed by more than LARGE_STEP,
   all parts with at least ALIKE_FRACTION of it are halved together, because an error where two
   parts meet is attributed to either of them only roughly; but no part for which that takes more
   than ALIKE_FACETS of all facets, and only until their error exceeds what is allowed by no more
   than ALIKE_EXCESS. The rest is done by the parts where it takes the fewest facets. */
#define LARGE_STEP     16.0
#define ALIKE_FRACTION 0x1p-6
#define ALIKE_FACETS   0x1p-3
#define ALIKE_EXCESS   3.0
/* Shapes are divided for no smaller tolerance: rounding alone may exceed it. */
#define TOLERANCE_MIN 1e-12
/* Some poses are so dark that their tolerance cannot be met, or only at a high cost: no division is
   smaller than the tolerance divided by this factor. */
#define DIVISION_FACTOR_MAX 64.0
/* No part is halved more often. */
#define PART_HALVINGS_MAX 64
/* All parts are divided alike if that takes at most this many times the facets. */
#define SHARED_MAX 1.1
/* If the parts that cannot be divided any further have more error than is allowed, that of the
   others is reduced to this fraction of it. */
#define FIXED_FRACTION 0.1
/* A round body may be halved even if the forecast of its facets exceeds their limit by this factor:
   its division is then the finest within the limit (scene/build/fineness.c). A heuristic. */
#define ROUND_EXCESS 1.25
/* The cost of a halving is at least that of so many facets. */
#define COST_MIN 16.0

/* --- which parts to divide -------------------------------------------------------------------- */

/* What the tolerance leaves for the tessellation of a pose; 0: dividing shapes does not help, or is
   not needed. */
static double error_left(const lrcs_run_options *options, const lrcs_result *result)
{
    double visibility = options->accept == LRCS_ACCEPT_BOUND || result->estimate_m2 < 0.0
                            ? result->budget.visibility_m2
                            : fmin(result->estimate_m2, result->budget.visibility_m2);
    double left = fmax(options->tolerance, TOLERANCE_MIN) * result->sigma_m2 - visibility -
                  result->budget.rounding_m2;
    return (result->flags & LRCS_FLAG_TOLERANCE_NOT_MET) && left > 0.0 &&
                   result->budget.tessellation_m2 > TOLERANCE_FRACTION * left
               ? left
               : 0.0;
}

/* A part while its halvings are chosen: the error due to it, and its facets. */
typedef struct part_choice {
    double error, facets;
    double factor, growth; /* of the error and of the facets at each halving */
    double excess;         /* the largest ratio of forecast facets to their limit */
    int fixed;             /* it is not divided any finer */
} part_choice;

/* The errors of the parts, in total that of the tessellation; where these are not known, all curved
   parts have the same.

   A halving halves the distance between a part and its facets, and with it the displacement of
   event edges. On a straight wall, whose facets become narrower but not shorter, the error falls
   about in proportion. The facets of a round body become smaller in both directions, by sqrt(1/2)
   each, and the error falls about as the distance to the power 1.5. Measured for three halvings and
   more, from 20 directions at a tolerance of 1e-5 (spinner, lander and station of
   examples/satellites) and from 60 at 1e-6 (demo), as the factor of a halving of round bodies: 0.37
   to 0.38 in the median, 80 % between 0.17 and 0.48. The factor used for them is below the median
   on purpose: parts are halved less often and runs take less time, although a few poses need a
   further run. With a still smaller factor so many do that no time is saved. Of straight walls,
   after six to eight halvings forecast with 0.48 for the first ones and 0.50 for later ones, the
   errors were 0.31 to 0.49 of the forecasts after the first ones, 0.67 to 0.74 after later ones, in
   the medians of each scene and tolerance; 90 % were below 1.43. */
static void choices_start(const lrcs_scene *scene, const lrcs_result *result,
                          const double *part_error_m2, const unsigned char *from,
                          part_choice *choice)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < scene->part_count; i++) {
        const lrcs_part *part = &scene->part[i];
        double error = part_error_m2 ? part_error_m2[i] : 1.0;
        int is_round = lrcsi_shape_is_round(part->kind);
        double straight = from[i] > 0 ? STRAIGHT_FACTOR_LATER : STRAIGHT_FACTOR;
        choice[i] = (part_choice){.error = part->bounds.reach > 0.0 ? error : 0.0,
                                  .facets = part->facet_count,
                                  .factor = is_round ? ROUND_FACTOR : straight,
                                  .growth = is_round ? 2.0 : sqrt(2.0),
                                  .excess = is_round ? ROUND_EXCESS : 1.0,
                                  .fixed = !(part->bounds.reach > 0.0)};
        sum += choice[i].error;
    }
    for (uint32_t i = 0; i < scene->part_count; i++) {
        choice[i].error *= sum > 0.0 ? result->budget.tessellation_m2 / sum : 0.0;
    }
}

/* The part whose next halving gains most for its price; parts if there is none. */
static uint32_t choice_best(const part_choice *choice, uint32_t parts)
{
    uint32_t best = parts;
    double most = 0.0;
    for (uint32_t i = 0; i < parts; i++) {
        double gain = (1.0 - choice[i].factor) * choice[i].error;
        double price = (choice[i].growth - 1.0) * choice[i].facets + COST_MIN;
        if (!choice[i].fixed && gain / price > most) {
            most = gain / price;
            best = i;
        }
    }
    return best;
}

/* May a part be halved again, or would it be too fine? */
static int part_can_be_halved(const lrcs_build_options *build, double tolerance,
                              const part_choice *choice, unsigned char halvings)
{
    double division = ldexp(build->division, -(int)halvings - 1);
    return !choice->fixed && halvings < PART_HALVINGS_MAX &&
           division >= tolerance / DIVISION_FACTOR_MAX &&
           choice->facets * choice->growth <= choice->excess * build->max_facets;
}

/* Halves one part, unless it would be too fine; then it is fixed. */
static void choice_halve(const lrcs_build_options *build, double tolerance, part_choice *choice,
                         unsigned char *halvings)
{
    if (!part_can_be_halved(build, tolerance, choice, *halvings)) {
        choice->fixed = 1;
        return;
    }
    ++*halvings;
    choice->facets *= choice->growth;
    choice->error *= choice->factor;
}

/* Which parts are halved together with the best one: those with at least the fraction `error` of
   the error, for which that takes at most the fraction `facets` of all facets, while the error
   exceeds what is allowed by more than the factor `excess`. */
typedef struct alike_rule {
    double error, facets, excess;
} alike_rule;

/* Halves parts, each time the best one and those that a rule adds, until their total error is
   allowed, or no part can be halved any further. If the parts that cannot be halved have more error
   than is allowed, the error of the others is reduced to FIXED_FRACTION of that. Returns the number
   of facets. */
static double choices_halve(const lrcs_build_options *build, uint32_t parts, double tolerance,
                            double allowed, const alike_rule *alike, part_choice *choice,
                            unsigned char *halvings)
{
    for (;;) {
        double error = 0.0;
        double fixed = 0.0;
        double facets = 0.0;
        for (uint32_t i = 0; i < parts; i++) {
            error += choice[i].error;
            fixed += choice[i].fixed ? choice[i].error : 0.0;
            facets += choice[i].facets;
        }
        uint32_t best = choice_best(choice, parts);
        if (!(error > fmax(allowed, (1.0 + FIXED_FRACTION) * fixed)) || best == parts) {
            return facets;
        }
        for (uint32_t i = 0; i < parts; i++) {
            const double price = (choice[i].growth - 1.0) * choice[i].facets;
            if (i == best ||
                (error > alike->excess * allowed && choice[i].error >= alike->error * error &&
                 price <= alike->facets * facets)) {
                choice_halve(build, tolerance, &choice[i], &halvings[i]);
            }
        }
    }
}

size_t lrcs_refine_need(uint32_t part_count)
{
    return lrcsi_work_add(lrcsi_work_bytes(part_count, sizeof(part_choice)),
                          lrcsi_work_blocks(2, part_count, 1));
}

/* How parts are halved together with the best one depends on how far the error must fall. If a
   single part that cannot be halved has more error than the tolerance leaves, this is out of reach.
   Of the two choices, for the parts that cause the error and for all alike, the second one is used
   if it takes about as few facets. */
static int halvings_choose(const lrcs_scene *scene, const lrcs_build_options *build,
                           const lrcs_run_options *options, const lrcs_result *result,
                           const double *part_error_m2, lrcs_work *work, unsigned char *halvings)
{
    static const alike_rule all = {0.0, HUGE_VAL, 0.0};
    const uint32_t parts = scene->part_count;
    const double left = error_left(options, result);
    double allowed = TOLERANCE_FRACTION * left;
    alike_rule rule = {HUGE_VAL, 0.0, 0.0}; /* only the best part */
    part_choice *choice = lrcsi_work_take(work, parts, sizeof *choice);
    unsigned char *from = lrcsi_work_take(work, parts, 1);
    unsigned char *alike = lrcsi_work_take(work, parts, 1);
    if (!choice || !from || !alike || !(allowed > 0.0) || !(build->division > 0.0)) {
        return 0;
    }
    if (result->budget.tessellation_m2 > ONE_RUN_FACTOR * allowed) {
        allowed = sqrt(allowed * result->budget.tessellation_m2);
    }
    memcpy(from, halvings, parts);
    memcpy(alike, halvings, parts);
    choices_start(scene, result, part_error_m2, from, choice);
    for (uint32_t i = 0; i < parts; i++) {
        if (!(choice[i].error <= left) &&
            !part_can_be_halved(build, options->tolerance, &choice[i], from[i])) {
            return 0;
        }
        if (from[i] > 0 && result->budget.tessellation_m2 > LARGE_STEP * allowed) {
            rule = (alike_rule){ALIKE_FRACTION, ALIKE_FACETS, ALIKE_EXCESS};
        }
    }
    const double facets =
        choices_halve(build, parts, options->tolerance, allowed, &rule, choice, halvings);
    choices_start(scene, result, part_error_m2, from, choice);
    if (choices_halve(build, parts, options->tolerance, allowed, &all, choice, alike) <
        SHARED_MAX * facets) {
        memcpy(halvings, alike, parts);
    }
    return memcmp(halvings, from, parts) != 0;
}

int lrcs_refine_halvings(const lrcs_scene *scene, const lrcs_build_options *build,
                         const lrcs_run_options *options, const lrcs_result *result,
                         const double *part_error_m2, lrcs_work *work, unsigned char *halvings)
{
    const size_t mark = work->used;
    const int finer = halvings_choose(scene, build, options, result, part_error_m2, work, halvings);
    work->used = mark;
    return finer;
}

int lrcsi_refine_less(const unsigned char *before, uint32_t parts, unsigned char *halvings)
{
    int more = 0;
    for (uint32_t i = 0; i < parts; i++) {
        halvings[i] = (unsigned char)(before[i] + (halvings[i] - before[i]) / 2);
        more |= halvings[i] > before[i];
    }
    return more;
}

/* --- in one work area ------------------------------------------------------------------------- */

/* In the work area, since it would take much of the stack. */
typedef struct refine_job {
    const lrcs_recipe *recipe;
    const lrcs_mesh *models;
    const lrcs_pose *pose;
    lrcs_build_options build;
    lrcs_run_options options;
    lrcs_scene scene;
    lrcs_result result;
} refine_job;

/* Builds, prepares and runs one division. The scene remains in the work area. */
static int division_run(refine_job *job, lrcs_work *work)
{
    const lrcs_prepared *prepared;
    int status = lrcs_scene_build(job->recipe, job->models, &job->build, work, &job->scene, NULL);
    status = status == LRCS_OK ? lrcs_prepare_run(&job->scene, work, &prepared) : status;
    return status == LRCS_OK
               ? lrcs_sigma_run(prepared, job->pose, &job->options, work, &job->result, NULL, NULL)
               : status;
}

/* Runs finer divisions, each in the memory of the one before, until none is needed, none fits, or
   the bound is no smaller: if memory is short, a raster may replace clipping. Given: the result of
   the first one, whose scene is in the work area above `mark`; room for the halvings to try. */
static void finer_divisions_run(refine_job *job, size_t mark, lrcs_work *work, lrcs_result *result,
                                unsigned char *halvings, unsigned char *tried)
{
    const uint32_t parts = job->recipe->part_count;
    job->build.halvings = tried;
    while (lrcs_refine_halvings(&job->scene, &job->build, &job->options, result,
                                job->options.part_error_m2, work, tried)) {
        int status;
        do {
            work->used = mark;
            status = division_run(job, work);
        } while (status != LRCS_OK && lrcsi_refine_less(halvings, parts, tried));
        const int is_met = !(job->result.flags & LRCS_FLAG_TOLERANCE_NOT_MET);
        if (status != LRCS_OK || !(is_met || job->result.bound_m2 < result->bound_m2)) {
            return;
        }
        *result = job->result;
        memcpy(halvings, tried, parts);
    }
}

int lrcs_refine_run(const lrcs_recipe *recipe, const lrcs_mesh *models,
                    const lrcs_build_options *build, const lrcs_pose *pose,
                    const lrcs_run_options *options, lrcs_work *work, lrcs_result *result,
                    unsigned char *halvings)
{
    const size_t mark = work->used;
    const uint32_t parts = recipe->part_count;
    int status = LRCS_E_MEMORY;
    refine_job *job = lrcsi_work_take(work, 1, sizeof *job);
    double *part_error = lrcsi_work_take(work, parts, sizeof *part_error);
    unsigned char *tried = lrcsi_work_take(work, parts, 1);
    if (job && part_error && tried) {
        const size_t kept = work->used;
        job->recipe = recipe;
        job->models = models;
        job->pose = pose;
        job->build = *build;
        job->build.halvings = halvings;
        job->options = *options;
        job->options.part_error_m2 = part_error;
        status = division_run(job, work);
        if (status == LRCS_OK) {
            *result = job->result;
            memcpy(tried, halvings, parts);
            finer_divisions_run(job, kept, work, result, halvings, tried);
        }
    }
    work->used = mark;
    return status;
}
