/* SPDX-License-Identifier: MIT */
/* Many poses over one prepared scene, or each over its own. It decides what each thread keeps (a
   work area of its own), how many threads there are if memory is short, and how a pose that fails
   is reported. The workers (host/run/workers) decide the order of poses. */
#include <lrcs/sweep.h>

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "host/run/levels.h"
#include "host/run/run.h"
#include "host/run/workers.h"

#define SWEEP_THREADS 1024u /* more than processors, on most machines */

typedef struct sweep_slot {
    lrcs_pose pose;
    lrcs_result result;
    lrcs_uncertainty uncertainty;
    lrcs_host_glint_sum glint;
    int status;
    int memory_short; /* memory did not suffice beside other threads: to be repeated with fewer */
    lrcs_host_error error; /* where the status says so */
} sweep_slot;

typedef struct sweep_run {
    const lrcs_host_scene *scene;
    const lrcs_run_options *options;
    const lrcs_host_sweep *sweep;
    lrcsi_host_area *area; /* one for each thread */
    uint32_t threads;
    int memory_short; /* the sweep ended at a pose that may succeed with fewer threads */
    lrcs_host_error *error;
} sweep_run;

/* One pose of a scene, with the glint of coarse facets if requested. */
static int pose_sigma(const sweep_run *run, uint32_t worker, const lrcs_host_scene *scene,
                      const lrcs_run_options *options, int glint, sweep_slot *one)
{
    const lrcs_host_sweep *sweep = run->sweep;
    lrcs_facet_record *records = NULL;
    size_t size = ((size_t)scene->scene.facet_count + 1) * sizeof *records;
    if (glint) {
        records = malloc(size);
        if (!records) {
            return lrcsi_host_fail_memory(&one->error, size);
        }
    }
    int status = lrcsi_host_sigma(scene, &one->pose, options, &run->area[worker], &one->result,
                                  records, NULL, &one->error);
    if (status == LRCS_OK && records) {
        lrcs_host_glint_sum_make(&scene->scene, records, sweep->glint, sweep->glint_count,
                                 &one->glint);
    }
    free(records);
    return status;
}

/* One pose of a scene with its material uncertainty. */
static int pose_uncertainty(const sweep_run *run, uint32_t worker, const lrcs_host_scene *scene,
                            const lrcs_run_options *options, sweep_slot *one)
{
    size_t size = ((size_t)scene->scene.material_count + 1) * sizeof(lrcs_sensitivity);
    lrcs_sensitivity *sensitivity = malloc(size);
    if (!sensitivity) {
        return lrcsi_host_fail_memory(&one->error, size);
    }
    int status = lrcsi_host_uncertainty(scene, &one->pose, options, run->sweep->uncertainty,
                                        &run->area[worker], &one->result, sensitivity,
                                        &one->uncertainty, &one->error);
    free(sensitivity);
    return status;
}

/* One pose: at the scene's own division of curved shapes, then at finer ones while these are needed
   to meet the tolerance. */
static int sweep_pose(const sweep_run *run, uint32_t worker, const lrcs_host_scene *scene,
                      sweep_slot *one)
{
    const lrcs_host_sweep *sweep = run->sweep;
    const lrcs_host_scene *at = scene;
    lrcsi_host_level *level = NULL;
    lrcs_run_options options = *run->options;
    int status = LRCS_OK;
    double *part_error = NULL;
    if (sweep->refine && scene->levels) {
        size_t size = scene->scene.part_count * sizeof *part_error;
        options.part_error_m2 = part_error = malloc(size);
        status = part_error ? LRCS_OK : lrcsi_host_fail_memory(&one->error, size);
    }
    while (at && status == LRCS_OK) {
        int glint = sweep->glint && at == scene;
        if (glint || !sweep->uncertainty) {
            status = pose_sigma(run, worker, at, &options, glint, one);
        }
        if (status == LRCS_OK && sweep->uncertainty) {
            status = pose_uncertainty(run, worker, at, &options, one);
        }
        if (status == LRCS_OK && sweep->refine) {
            level = lrcsi_host_finer(scene, &options, &one->result, part_error, level);
            at = level ? level->scene : NULL;
        } else {
            lrcsi_host_level_release(scene, level);
            at = NULL;
        }
    }
    free(part_error);
    return status;
}

/* A worker's task: the pose, in the sweep's scene or in its own. one->status is that of the first
   step that fails, with its sentence. */
static void sweep_work(void *context, uint32_t worker, uint64_t index, void *slot)
{
    const sweep_run *run = context;
    const lrcs_host_sweep *sweep = run->sweep;
    sweep_slot *one = slot;
    lrcs_host_scene own;
    one->status = sweep->pose(sweep->context, index, &one->pose);
    if (one->status != LRCS_OK) {
        lrcsi_host_fail(&one->error, one->status, "%s", lrcs_status_text(one->status));
    } else if (!sweep->scene) {
        one->status = sweep_pose(run, worker, run->scene, one);
    } else {
        memset(&own, 0, sizeof own);
        one->status = sweep->scene(sweep->context, index, &own, &one->error);
        if (one->status == LRCS_OK) {
            one->status = sweep_pose(run, worker, &own, one);
            lrcs_host_scene_free(&own);
        }
    }
    one->memory_short =
        run->threads > 1 &&
        (one->status == LRCS_E_SYSTEM || one->status == LRCS_E_MEMORY ||
         (one->status == LRCS_OK && (one->result.flags & LRCS_FLAG_MEMORY_FALLBACK)));
}

static int sweep_take(void *context, uint64_t index, const void *slot)
{
    sweep_run *run = context;
    const sweep_slot *one = slot;
    if (one->memory_short) {
        run->memory_short = 1;
        return LRCS_E_SYSTEM;
    }
    if (one->status != LRCS_OK) {
        return lrcsi_host_fail(run->error, one->status, "pose %llu: %.1000s",
                               (unsigned long long)index, one->error.text);
    }
    return run->sweep->take(run->sweep->context, index, &one->pose, &one->result,
                            run->sweep->uncertainty ? &one->uncertainty : NULL,
                            run->sweep->glint ? &one->glint : NULL, run->error);
}

/* No more threads than poses. */
static uint32_t sweep_threads(const lrcs_host_sweep *sweep)
{
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    uint64_t threads = sweep->threads != 0 ? sweep->threads
                       : processors > 0    ? (uint64_t)processors
                                           : 1;
    threads = threads < SWEEP_THREADS ? threads : SWEEP_THREADS;
    threads = threads < sweep->count ? threads : sweep->count;
    return threads > 0 ? (uint32_t)threads : 1;
}

/* The poses from `taken` on, which it moves, by run->threads threads. */
static int sweep_threads_run(sweep_run *run, uint64_t *taken)
{
    const lrcs_host_sweep *sweep = run->sweep;
    uint64_t done = 0;
    lrcsi_workers workers = {.first = sweep->first + *taken,
                             .count = sweep->count - *taken,
                             .threads = run->threads,
                             .slot_size = sizeof(sweep_slot),
                             .context = run,
                             .work = sweep_work,
                             .take = sweep_take,
                             .cancel = sweep->cancel};
    run->memory_short = 0;
    run->area = calloc(run->threads, sizeof *run->area);
    int status = run->area ? lrcsi_workers_run(&workers, &done, run->error)
                           : lrcsi_host_fail_memory(run->error, run->threads * sizeof *run->area);
    for (uint32_t i = 0; run->area && i < run->threads; i++) {
        lrcsi_host_area_free(&run->area[i]);
    }
    free(run->area);
    *taken += done;
    return status;
}

int lrcs_host_sweep_run(const lrcs_host_scene *scene, const lrcs_run_options *options,
                        const lrcs_host_sweep *sweep, uint64_t *done, lrcs_host_error *error)
{
    uint64_t taken = 0;
    sweep_run run = {.scene = scene,
                     .options = options,
                     .sweep = sweep,
                     .threads = sweep_threads(sweep),
                     .error = error};
    int status;
    if ((!sweep->scene && !scene->prepared) || sweep->threads > SWEEP_THREADS ||
        sweep->count > UINT64_MAX - sweep->first) {
        status =
            lrcsi_host_fail(error, LRCS_E_ARGUMENT, "sweep: %s", lrcs_status_text(LRCS_E_ARGUMENT));
    } else {
        status = sweep_threads_run(&run, &taken);
        /* with one thread no pose is memory_short, so that the loop ends */
        while (run.memory_short) {
            run.threads = (run.threads + 1) / 2;
            status = sweep_threads_run(&run, &taken);
        }
    }
    if (status == LRCS_E_CANCELLED) {
        lrcsi_host_fail(error, status, "stopped after %llu of %llu poses",
                        (unsigned long long)taken, (unsigned long long)sweep->count);
    }
    if (done) {
        *done = taken;
    }
    return status;
}
