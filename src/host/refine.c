/* SPDX-License-Identifier: MIT */
/* Curved shapes among other parts, divided as finely as a pose needs. A scene is built and prepared
   with few facets; where the tessellation's part of a bound makes it miss the tolerance, the pose
   is run again at the division for which that part is likely to be small enough. Divisions differ
   by factors of two, so that all poses share them, and each is built when a pose needs it for the
   first time. Every pose begins with the scene's own division: its result does not depend on what
   other poses needed. */
#include "host/refine.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

/* The tessellation's part of a bound is about proportional to the division. A division is chosen
   for this fraction of what the tolerance leaves for that part. */
#define TOLERANCE_FRACTION 0.8
/* Some poses are so dark that their tolerance cannot be met, or only at a high cost: no division is
   smaller than the tolerance divided by this factor. */
#define DIVISION_FACTOR_MAX 64.0
/* The number of divisions: level k has the scene's own over 2^k. */
#define DIVISIONS 32u

struct lrcsi_host_levels {
    pthread_mutex_t lock;
    lrcs_build_options build;
    lrcs_host_scene *scene[DIVISIONS]; /* NULL: not built yet */
    uint32_t own;                      /* the scene's own level */
    uint32_t finest;                   /* levels beyond this have failed */
    uint32_t notices;                  /* those of the scene that no division changes */
};

struct lrcsi_host_levels *lrcsi_host_levels_make(const lrcs_host_scene *scene,
                                                 const lrcs_build_options *build)
{
    struct lrcsi_host_levels *levels = NULL;
    int curved = 0;
    for (uint32_t i = 0; i < scene->scene.part_count; i++) {
        curved |= scene->scene.part[i].reach > 0.0;
    }
    if (curved && build->division > 0.0) {
        levels = calloc(1, sizeof *levels);
    }
    if (levels) {
        levels->build = *build;
        levels->finest = DIVISIONS - 1;
        levels->notices = scene->notices.count;
        if (pthread_mutex_init(&levels->lock, NULL) != 0) {
            free(levels);
            return NULL;
        }
    }
    return levels;
}

void lrcsi_host_levels_free(struct lrcsi_host_levels *levels)
{
    if (!levels) {
        return;
    }
    for (uint32_t i = 0; i < DIVISIONS; i++) {
        if (levels->scene[i]) {
            lrcs_host_scene_free(levels->scene[i]);
            free(levels->scene[i]);
        }
    }
    pthread_mutex_destroy(&levels->lock);
    free(levels);
}

static double level_division(const struct lrcsi_host_levels *levels, uint32_t level)
{
    return ldexp(levels->build.division, -(int)level);
}

/* How many times the division must be halved; 0: that does not help, or is not needed. */
static uint32_t halvings(const lrcs_run_options *options, const lrcs_result *result)
{
    double allowed = options->tolerance * result->sigma_m2;
    double tessellation = result->budget.tessellation_m2;
    double visibility = options->accept == LRCS_ACCEPT_BOUND || result->estimate_m2 < 0.0
                            ? result->budget.visibility_m2
                            : fmin(result->estimate_m2, result->budget.visibility_m2);
    double left = TOLERANCE_FRACTION * (allowed - visibility - result->budget.rounding_m2);
    uint32_t count = 0;
    if (!(result->flags & LRCS_FLAG_TOLERANCE_NOT_MET) || !(left > 0.0)) {
        return 0;
    }
    for (; tessellation > left && count < DIVISIONS; count++) {
        tessellation /= 2.0;
    }
    return count;
}

/* Builds and prepares a level; the lock is held. NULL if that fails. */
static lrcs_host_scene *level_build(const lrcs_host_scene *base, struct lrcsi_host_levels *levels,
                                    uint32_t level)
{
    lrcs_host_error error;
    lrcs_build_options build = levels->build;
    lrcs_host_scene *scene = calloc(1, sizeof *scene);
    build.division = level_division(levels, level);
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

const lrcs_host_scene *lrcsi_host_finer(const lrcs_host_scene *scene,
                                        const lrcs_run_options *options, const lrcs_result *result,
                                        uint32_t *level)
{
    struct lrcsi_host_levels *levels = scene->levels;
    uint32_t more = levels ? halvings(options, result) : 0;
    const lrcs_host_scene *found = NULL;
    if (more == 0) {
        return NULL;
    }
    pthread_mutex_lock(&levels->lock);
    uint32_t from = levels->own + *level;
    uint32_t wanted = from + more < levels->finest ? from + more : levels->finest;
    while (level_division(levels, wanted) < options->tolerance / DIVISION_FACTOR_MAX &&
           wanted > 0) {
        wanted--;
    }
    while (!found && wanted > from) {
        if (!levels->scene[wanted]) {
            levels->scene[wanted] = level_build(scene, levels, wanted);
        }
        found = levels->scene[wanted];
        if (!found) { /* too many facets, or too little memory */
            levels->finest = --wanted;
        }
    }
    pthread_mutex_unlock(&levels->lock);
    *level = found ? wanted - levels->own : *level;
    return found;
}

uint32_t lrcsi_host_level_adopt(lrcs_host_scene *scene, uint32_t level, double *division)
{
    struct lrcsi_host_levels *levels = scene->levels;
    levels->own += level;
    const lrcs_host_scene *finer = levels->scene[levels->own];
    scene->scene = finer->scene;
    scene->prepared = finer->prepared;
    scene->seconds_load += finer->seconds_load;
    scene->seconds_prepare = finer->seconds_prepare;
    memcpy(scene->seconds_stage, finer->seconds_stage, sizeof scene->seconds_stage);
    *division = level_division(levels, levels->own);
    return levels->notices;
}
