/* SPDX-License-Identifier: MIT */
/* Keeps finer divisions of scenes whose curved shapes are among other parts. A scene is built and
   prepared with few facets; for a pose whose bound misses the tolerance, the parts that cause its
   error are divided more finely (lrcs/refine.h), and it is run again. Poses that need the same
   halvings share the scene built for them, a level. Every pose begins with the scene's own
   division: its result does not depend on what other poses needed. */
#include "host/run/levels.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "integrate/refine.h"

/* The number of levels kept, and of their facets, besides those in use. */
#define KEPT_LEVELS_MAX 32u
#define KEPT_FACETS_MAX (UINT32_C(1) << 19)

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
    const size_t need = lrcs_refine_need(levels->parts);
    unsigned char *halvings = malloc(levels->parts + need);
    if (halvings) {
        const unsigned char *now = from ? from->halvings : levels->own;
        lrcs_work work = lrcs_work_make(halvings + levels->parts, need);
        memcpy(halvings, now, levels->parts);
        int finer = lrcs_refine_halvings(from ? &from->scene->scene : &scene->scene, &levels->build,
                                         options, result, part_error_m2, &work, halvings);
        pthread_mutex_lock(&levels->lock);
        while (finer && !(level = level_get(scene, levels, halvings))) {
            finer = lrcsi_refine_less(now, levels->parts, halvings); /* too many facets, or too
                                                                        little memory */
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
