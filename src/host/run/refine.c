/* SPDX-License-Identifier: MIT */
/* Curved shapes among other parts, divided as finely as a pose needs. A scene is built and prepared
   with few facets. If the tessellation makes a bound miss the tolerance, the parts that cause most
   of it are divided more finely, each by a number of halvings, and the pose is run again. Poses
   that need the same halvings share the scene built for them, a level. Every pose begins with the
   scene's own division: its result does not depend on what other poses needed.

   How far the error due to a part falls is forecast by a factor for each halving, one for straight
   walls and one for round bodies. Most poses take two runs, the second of which meets the
   tolerance, or three if the tolerance is far below the error of the first; if the last does not
   meet it, the next forecast starts from its errors. */
#include "host/run/refine.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/shape/revolution.h"

/* Heuristics: the error due to a part falls by these factors with every halving (choices_start). If
   it falls less, the part is halved again; if it falls more, there are more facets than needed. */
#define ROUND_FACTOR    0.27
#define STRAIGHT_FACTOR 0.48
/* Of a straight wall that has been halved before: measured as 0.50 to 0.55. */
#define STRAIGHT_FACTOR_LATER 0.50
/* Divisions are chosen for this fraction of what the tolerance leaves for all parts together. */
#define TOLERANCE_FRACTION 0.8
/* If the error exceeds what is allowed by more than this factor, it is reduced in two runs, the
   first of which is aimed at the geometric mean of the two: it takes a tenth of the time of the
   second, and the forecast from its errors is more accurate. */
#define ONE_RUN_FACTOR 1e4
/* If the error of a level that is divided already exceeds what is allowed by more than LARGE_STEP,
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
/* The number of levels kept, and of their facets, besides those in use. */
#define KEPT_LEVELS_MAX 32u
#define KEPT_FACETS_MAX (UINT32_C(1) << 19)
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

struct lrcsi_host_levels {
    pthread_mutex_t lock;
    pthread_cond_t built;
    lrcs_build_options build;
    unsigned char *own; /* the halvings of the scene itself */
    uint32_t parts;
    lrcsi_host_level *first; /* a list */
    uint64_t clock;
    uint32_t notices; /* those of the scene that no division changes */
};

struct lrcsi_host_levels *lrcsi_host_levels_make(const lrcs_host_scene *scene,
                                                 const lrcs_build_options *build)
{
    int curved = 0;
    for (uint32_t i = 0; i < scene->scene.part_count; i++) {
        curved |= scene->scene.part[i].bounds.reach > 0.0;
    }
    if (!curved || !(build->division > 0.0)) {
        return NULL;
    }
    struct lrcsi_host_levels *levels = calloc(1, sizeof *levels);
    unsigned char *own = calloc(scene->scene.part_count, 1);
    if (!levels || !own) {
        free(levels);
        free(own);
        return NULL;
    }
    levels->build = *build;
    levels->own = own;
    levels->parts = scene->scene.part_count;
    levels->notices = scene->notices.count;
    if (build->halvings) {
        memcpy(own, build->halvings, levels->parts);
    }
    pthread_mutex_init(&levels->lock, NULL);
    pthread_cond_init(&levels->built, NULL);
    return levels;
}

static void level_free(lrcsi_host_level *level)
{
    if (level->scene) {
        lrcs_host_scene_free(level->scene);
    }
    free(level->scene);
    free(level->halvings);
    free(level);
}

void lrcsi_host_levels_free(struct lrcsi_host_levels *levels)
{
    if (!levels) {
        return;
    }
    while (levels->first) {
        lrcsi_host_level *level = levels->first;
        levels->first = level->next;
        level_free(level);
    }
    pthread_cond_destroy(&levels->built);
    pthread_mutex_destroy(&levels->lock);
    free(levels->own);
    free(levels);
}

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
   examples/satellites) and from 60 at 1e-6 (demo), as the factor of a halving: round bodies 0.37 to
   0.38 in the median, 80 % between 0.17 and 0.48; straight walls 0.43 to 0.50 in the median, 80 %
   between 0.32 and 0.54. The factor used for round bodies is below their median on purpose: parts
   are halved less often and runs take less time, although a few poses need a further run. With a
   still smaller factor so many do that no time is saved. */
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
static int part_can_be_halved(const struct lrcsi_host_levels *levels, double tolerance,
                              const part_choice *choice, unsigned char halvings)
{
    double division = ldexp(levels->build.division, -(int)halvings - 1);
    return !choice->fixed && halvings < PART_HALVINGS_MAX &&
           division >= tolerance / DIVISION_FACTOR_MAX &&
           choice->facets * choice->growth <= choice->excess * levels->build.max_facets;
}

/* Halves one part, unless it would be too fine; then it is fixed. */
static void choice_halve(const struct lrcsi_host_levels *levels, double tolerance,
                         part_choice *choice, unsigned char *halvings)
{
    if (!part_can_be_halved(levels, tolerance, choice, *halvings)) {
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
static double choices_halve(const struct lrcsi_host_levels *levels, double tolerance,
                            double allowed, const alike_rule *alike, part_choice *choice,
                            unsigned char *halvings)
{
    for (;;) {
        double error = 0.0;
        double fixed = 0.0;
        double facets = 0.0;
        for (uint32_t i = 0; i < levels->parts; i++) {
            error += choice[i].error;
            fixed += choice[i].fixed ? choice[i].error : 0.0;
            facets += choice[i].facets;
        }
        uint32_t best = choice_best(choice, levels->parts);
        if (!(error > fmax(allowed, (1.0 + FIXED_FRACTION) * fixed)) || best == levels->parts) {
            return facets;
        }
        for (uint32_t i = 0; i < levels->parts; i++) {
            const double price = (choice[i].growth - 1.0) * choice[i].facets;
            if (i == best ||
                (error > alike->excess * allowed && choice[i].error >= alike->error * error &&
                 price <= alike->facets * facets)) {
                choice_halve(levels, tolerance, &choice[i], &halvings[i]);
            }
        }
    }
}

/* Chooses the halvings with which the tolerance is likely to be met, or all that are allowed. Only
   the parts that cause the error are halved; but all parts alike, if that takes about as few
   facets, because more poses can then share the division. The array has room for twice the number
   of parts. Returns 0 if the halvings are those of `from`, or if a single part that cannot be
   halved has more error than the tolerance leaves: it is then out of reach. */
static int halvings_choose(const struct lrcsi_host_levels *levels, const lrcs_scene *scene,
                           const lrcs_run_options *options, const lrcs_result *result,
                           const double *part_error_m2, const unsigned char *from,
                           unsigned char *halvings)
{
    double left = error_left(options, result);
    double allowed = TOLERANCE_FRACTION * left;
    if (result->budget.tessellation_m2 > ONE_RUN_FACTOR * allowed) {
        allowed = sqrt(allowed * result->budget.tessellation_m2);
    }
    part_choice *choice = calloc(levels->parts, sizeof *choice);
    unsigned char *alike = halvings + levels->parts;
    static const alike_rule all = {0.0, HUGE_VAL, 0.0};
    alike_rule rule = {HUGE_VAL, 0.0, 0.0}; /* only the best part */
    int reachable = 1;
    memcpy(halvings, from, levels->parts);
    memcpy(alike, from, levels->parts);
    if (choice && allowed > 0.0) {
        choices_start(scene, result, part_error_m2, from, choice);
        for (uint32_t i = 0; i < levels->parts; i++) {
            reachable &= choice[i].error <= left ||
                         part_can_be_halved(levels, options->tolerance, &choice[i], from[i]);
            if (from[i] > 0 && result->budget.tessellation_m2 > LARGE_STEP * allowed) {
                rule = (alike_rule){ALIKE_FRACTION, ALIKE_FACETS, ALIKE_EXCESS};
            }
        }
        double facets = choices_halve(levels, options->tolerance, allowed, &rule, choice, halvings);
        choices_start(scene, result, part_error_m2, from, choice);
        if (choices_halve(levels, options->tolerance, allowed, &all, choice, alike) <
            SHARED_MAX * facets) {
            memcpy(halvings, alike, levels->parts);
        }
    }
    free(choice);
    return reachable && memcmp(halvings, from, levels->parts) != 0;
}

/* --- levels ----------------------------------------------------------------------------------- */

/* Builds and prepares a scene; NULL if that fails. */
static lrcs_host_scene *level_build(const lrcs_host_scene *base,
                                    const struct lrcsi_host_levels *levels,
                                    const unsigned char *halvings)
{
    lrcs_host_error error;
    lrcs_build_options build = levels->build;
    lrcs_host_scene *scene = calloc(1, sizeof *scene);
    build.halvings = halvings;
    if (!scene) {
        return NULL;
    }
    if (lrcs_host_scene_vary(base, &base->recipe, &build, scene, &error) != LRCS_OK) {
        free(scene);
        return NULL;
    }
    if (lrcs_host_scene_prepare(scene, &error) != LRCS_OK) {
        lrcs_host_scene_free(scene);
        free(scene);
        return NULL;
    }
    return scene;
}

/* Frees levels, the least recently used first, until few enough are left. */
static void levels_limit(struct lrcsi_host_levels *levels)
{
    for (;;) {
        uint64_t facets = 0;
        uint32_t idle = 0;
        lrcsi_host_level **oldest = NULL; /* the pointer to it */
        for (lrcsi_host_level **at = &levels->first; *at; at = &(*at)->next) {
            if ((*at)->users == 0 && (*at)->scene) {
                oldest = !oldest || (*at)->used < (*oldest)->used ? at : oldest;
                facets += (*at)->scene->scene.facet_count;
                idle++;
            }
        }
        if (!oldest || (idle <= KEPT_LEVELS_MAX && facets <= KEPT_FACETS_MAX)) {
            return;
        }
        lrcsi_host_level *level = *oldest;
        *oldest = level->next;
        level_free(level);
    }
}

/* A new level, which is being built; NULL if there is no memory. */
static lrcsi_host_level *level_add(struct lrcsi_host_levels *levels, const unsigned char *halvings)
{
    lrcsi_host_level *level = calloc(1, sizeof *level);
    unsigned char *own = malloc(levels->parts);
    if (!level || !own) {
        free(level);
        free(own);
        return NULL;
    }
    memcpy(own, halvings, levels->parts);
    level->halvings = own;
    level->users = 1;
    level->next = levels->first;
    levels->first = level;
    return level;
}

/* The level with these halvings: one that is kept, or a new one, built while other threads go on.
   NULL if that fails. The lock is held, but not while a level is built. */
static lrcsi_host_level *level_get(const lrcs_host_scene *base, struct lrcsi_host_levels *levels,
                                   const unsigned char *halvings)
{
    lrcsi_host_level *level = levels->first;
    while (level && memcmp(level->halvings, halvings, levels->parts) != 0) {
        level = level->next;
    }
    if (level) {
        level->users++;
        while (!level->scene && !level->failed) {
            pthread_cond_wait(&levels->built, &levels->lock);
        }
    } else {
        level = level_add(levels, halvings);
        if (!level) {
            return NULL;
        }
        pthread_mutex_unlock(&levels->lock);
        lrcs_host_scene *scene = level_build(base, levels, halvings);
        pthread_mutex_lock(&levels->lock);
        level->scene = scene;
        level->failed = !scene;
        pthread_cond_broadcast(&levels->built);
    }
    level->used = ++levels->clock;
    if (level->failed) {
        level->users--;
        return NULL;
    }
    return level;
}

lrcsi_host_level *lrcsi_host_finer(const lrcs_host_scene *scene, const lrcs_run_options *options,
                                   const lrcs_result *result, const double *part_error_m2,
                                   lrcsi_host_level *from)
{
    struct lrcsi_host_levels *levels = scene->levels;
    lrcsi_host_level *level = NULL;
    if (!levels) {
        return NULL;
    }
    unsigned char *halvings = malloc(2 * (size_t)levels->parts);
    if (halvings) {
        const unsigned char *now = from ? from->halvings : levels->own;
        int finer = halvings_choose(levels, from ? &from->scene->scene : &scene->scene, options,
                                    result, part_error_m2, now, halvings);
        pthread_mutex_lock(&levels->lock);
        while (finer && !(level = level_get(scene, levels, halvings))) {
            finer = 0; /* too many facets, or too little memory: half as many more */
            for (uint32_t i = 0; i < levels->parts; i++) {
                halvings[i] = (unsigned char)(now[i] + (halvings[i] - now[i]) / 2);
                finer |= halvings[i] > now[i];
            }
        }
        pthread_mutex_unlock(&levels->lock);
    }
    free(halvings);
    lrcsi_host_level_release(scene, from);
    return level;
}

void lrcsi_host_level_release(const lrcs_host_scene *scene, lrcsi_host_level *level)
{
    if (level) {
        pthread_mutex_lock(&scene->levels->lock);
        level->users--;
        levels_limit(scene->levels);
        pthread_mutex_unlock(&scene->levels->lock);
    }
}

uint32_t lrcsi_host_level_adopt(lrcs_host_scene *scene, const lrcsi_host_level *level,
                                const unsigned char **halvings)
{
    struct lrcsi_host_levels *levels = scene->levels;
    const lrcs_host_scene *finer = level->scene;
    memcpy(levels->own, level->halvings, levels->parts);
    scene->scene = finer->scene;
    scene->prepared = finer->prepared;
    scene->seconds_load += finer->seconds_load;
    scene->seconds_prepare = finer->seconds_prepare;
    memcpy(scene->seconds_stage, finer->seconds_stage, sizeof scene->seconds_stage);
    *halvings = levels->own;
    return levels->notices;
}
