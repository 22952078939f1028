/* SPDX-License-Identifier: MIT */
/* The task. Its memory is fixed at link time; the scene is read and prepared once, and each cycle
   uses the rest of the memory and releases it. A cycle that fails keeps the last good answer, and
   reports its age and the cause; no input can do more harm. */
#include "task.h"

#include <lrcs/lrcs.h>

#include <math.h>

#ifndef FLIGHT_MEMORY
#define FLIGHT_MEMORY (512u << 10)
#endif

/* The scene is in read-only memory; shapes are divided once, by flight_start. */
static const char scene_text[] =
    "[[part]]\nname = 'bus'\nshape = 'box'\nsize = [1.2, 1.2, 1.8]\n"
    "material = 'mli-gold'\n"
    "[[part]]\nname = 'wing'\nshape = 'plate'\nsize = [2.4, 1.1]\n"
    "translate = [1.9, 0, 0.2]\nmaterial = 'solar-cell'\n"
    "[[part]]\nname = 'antenna'\nshape = 'cone'\nradius = 0.3\n"
    "length = 0.5\ntranslate = [0, 0, 0.9]\nmaterial = 'paint-white'\n";

static unsigned char arena[FLIGHT_MEMORY];
static lrcs_work work;
static lrcs_scene scene;
static const lrcs_prepared *prepared;
static lrcs_run_options options;
static flight_telemetry last = {.bound_m2 = HUGE_VAL};

int32_t flight_start(void)
{
    lrcs_recipe recipe;
    lrcs_build_options build = lrcs_build_options_default();
    build.tolerance = 1e-2;
    build.max_facets = 512;
    options = lrcs_run_options_default();
    options.method = LRCS_METHOD_EXACT;
    options.tolerance = 0.05;
    options.steps = FLIGHT_STEPS;
    last = (flight_telemetry){.status = LRCS_E_EMPTY, .bound_m2 = HUGE_VAL};
    prepared = NULL;
    work = lrcs_work_make(arena, sizeof arena);
    int status = lrcs_recipe_read(scene_text, sizeof scene_text - 1, &work, &recipe, NULL);
    if (status == LRCS_OK) {
        status = lrcs_scene_build(&recipe, NULL, &build, &work, &scene, NULL);
    }
    if (status == LRCS_OK) {
        status = lrcs_prepare_run(&scene, &work, &prepared);
    }
    /* Fail here rather than in a later cycle: after this no attitude lacks memory. */
    if (status == LRCS_OK && lrcs_sigma_need(prepared, &options) > work.size - work.used) {
        status = LRCS_E_MEMORY;
        prepared = NULL;
    }
    last.memory_used = (uint32_t)work.used;
    last.memory_peak = (uint32_t)work.peak;
    return status;
}

void flight_cycle(const double attitude[4], flight_telemetry *telemetry)
{
    lrcs_pose pose;
    lrcs_result result;
    int status = prepared ? lrcs_pose_from_quaternion(attitude, &pose) : LRCS_E_EMPTY;
    if (status == LRCS_OK) {
        status = lrcs_sigma_run(prepared, &pose, &options, &work, &result, NULL, NULL);
    }
    last.cycle++;
    last.status = status;
    last.memory_peak = (uint32_t)work.peak;
    if (status == LRCS_OK) {
        last.stale = 0;
        last.flags = result.flags;
        last.notices = result.notices;
        last.steps = (uint32_t)result.steps;
        last.sigma_m2 = result.sigma_m2;
        last.bound_m2 = result.bound_m2;
    } else {
        last.stale++;
        last.failures++;
    }
    *telemetry = last;
}
