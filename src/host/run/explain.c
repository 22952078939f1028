/* SPDX-License-Identifier: MIT */
/* The time and the change of sigma that each effect causes, measured by leaving it out, or by
   simulating it if the planner does not. The planner decides which effects are on, and why; timings
   are those of this machine. The stages of the pose are timed by runs that end after each of
   them. */
#include <lrcs/explain.h>

#include <math.h>
#include <time.h>

#include "host/run/median.h"

/* Rounds of measurements: at least one, and more as long as this time allows. */
#define ROUNDS_MOST  101u
#define ROUNDS_SPENT 2.0 /* seconds */

/* Seconds of every round: as planned, with each effect flipped, as planned again, and up to each
   stage. */
typedef struct explain_times {
    double first[ROUNDS_MOST], last[ROUNDS_MOST];
    double flipped[LRCS_EFFECTS][ROUNDS_MOST];
    double until[LRCS_HOST_POSE_STAGES][ROUNDS_MOST];
} explain_times;

/* What is measured. */
typedef struct explain_job {
    const lrcs_host_scene *scene;
    const lrcs_pose *pose;
    const lrcs_run_options *options;
    const lrcs_result *result;
    void (*show)(uint32_t done, uint32_t count);
    lrcs_host_explained *out;
} explain_job;

static double processor_seconds(void)
{
    struct timespec now = {0, 0};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Runs the pose once more. Measures the processor's time, which does not include waiting for other
   processes. */
static int explain_pose(const explain_job *job, const lrcs_run_options *options,
                        lrcs_result *result, double *seconds, lrcs_host_error *error)
{
    double start = processor_seconds();
    int status =
        lrcs_host_scene_run(job->scene, job->pose, options, result, NULL, NULL, NULL, error);
    *seconds = processor_seconds() - start;
    return status;
}

/* One round: its runs follow each other closely, so that a slower machine affects them all. The
   stages are those of the method and raster that gave the answer. Adds its time to *spent. */
static int explain_round(const explain_job *job, explain_times *times, uint32_t round,
                         double *spent, lrcs_host_error *error)
{
    lrcs_result result = {0};
    int status = explain_pose(job, job->options, &result, &times->first[round], error);
    for (uint32_t i = 0; i < LRCS_EFFECTS && status == LRCS_OK; i++) {
        if (job->show) {
            job->show(i, LRCS_EFFECTS);
        }
        lrcs_run_options options = *job->options;
        if (!(1u << i & LRCS_EFFECTS_SWITCHED)) {
            continue;
        }
        *(job->result->effect[i].on ? &options.without : &options.with) = 1u << i;
        status = explain_pose(job, &options, &result, &times->flipped[i][round], error);
        *spent += times->flipped[i][round];
        job->out->effect[i].sigma_m2 = result.sigma_m2;
    }
    if (status == LRCS_OK) {
        status = explain_pose(job, job->options, &result, &times->last[round], error);
        *spent += times->first[round] + times->last[round];
    }
    lrcs_run_options staged = *job->options;
    staged.method = job->result->method;
    staged.resolution = job->result->resolution;
    for (int i = 0; i < LRCS_HOST_POSE_STAGES && status == LRCS_OK; i++) {
        double start = processor_seconds();
        status = lrcs_host_scene_run_until(job->scene, job->pose, &staged, i, error);
        times->until[i][round] = processor_seconds() - start;
        *spent += times->until[i][round];
    }
    return status;
}

/* The time of an effect: the median over rounds of the difference between runs with and without it.
   The scatter is its standard error, as for normal errors of n rounds: 1.86 times the median
   deviation over sqrt(n); with few rounds, 1.09 times the difference between equal runs of a
   round. */
static void explain_effect(const explain_job *job, const explain_times *times, uint32_t rounds,
                           int effect, lrcs_host_explained_effect *out)
{
    double difference[ROUNDS_MOST];
    double away[ROUNDS_MOST];
    double equal[ROUNDS_MOST];
    double sign = job->result->effect[effect].on ? 1.0 : -1.0;
    for (uint32_t r = 0; r < rounds; r++) {
        double planned = 0.5 * (times->first[r] + times->last[r]);
        difference[r] = away[r] = sign * (planned - times->flipped[effect][r]);
        equal[r] = fabs(times->first[r] - times->last[r]);
    }
    out->seconds = lrcsi_host_median(difference, rounds);
    for (uint32_t r = 0; r < rounds; r++) {
        away[r] = fabs(away[r] - out->seconds);
    }
    out->scatter =
        fmax(1.86 * lrcsi_host_median(away, rounds), 1.09 * lrcsi_host_median(equal, rounds)) /
        sqrt(rounds);
}

/* The time of each stage: the median over rounds of the difference between runs up to it and up to
   the one before, at least 0. The scatter is that of an effect, reduced in proportion for runs that
   are shorter than the pose. */
static void explain_stages(const explain_times *times, uint32_t rounds, lrcs_host_explained *out)
{
    double difference[ROUNDS_MOST];
    double run[ROUNDS_MOST];
    double equal[ROUNDS_MOST];
    for (int i = 0; i < LRCS_HOST_POSE_STAGES; i++) {
        for (uint32_t r = 0; r < rounds; r++) {
            difference[r] = times->until[i][r] - (i > 0 ? times->until[i - 1][r] : 0.0);
            run[r] = times->until[i][r];
            equal[r] = fabs(times->first[r] - times->last[r]) / times->first[r];
        }
        out->stage[i] = fmax(0.0, lrcsi_host_median(difference, rounds));
        for (uint32_t r = 0; r < rounds; r++) {
            difference[r] = fabs(difference[r] - out->stage[i]);
        }
        double single = 1.09 * lrcsi_host_median(equal, rounds) * lrcsi_host_median(run, rounds);
        out->stage_scatter[i] =
            fmax(1.86 * lrcsi_host_median(difference, rounds), single) / sqrt(rounds);
    }
}

int lrcs_host_explain(const lrcs_host_scene *scene, const lrcs_pose *pose,
                      const lrcs_run_options *options, const lrcs_result *result,
                      void (*show)(uint32_t done, uint32_t count), lrcs_host_explained *explained,
                      lrcs_host_error *error)
{
    const explain_job job = {scene, pose, options, result, show, explained};
    explain_times times;
    double spent = 0.0;
    uint32_t rounds = 0;
    int status = LRCS_OK;
    *explained = (lrcs_host_explained){.rounds = 0};
    while (status == LRCS_OK && rounds < ROUNDS_MOST &&
           (rounds == 0 || spent * (rounds + 1) / rounds < ROUNDS_SPENT)) {
        status = explain_round(&job, &times, rounds++, &spent, error);
    }
    if (status != LRCS_OK) {
        return status;
    }
    for (int i = 0; i < LRCS_EFFECTS; i++) {
        if (1u << i & LRCS_EFFECTS_SWITCHED) {
            explain_effect(&job, &times, rounds, i, &explained->effect[i]);
        }
    }
    explain_stages(&times, rounds, explained);
    explained->rounds = rounds;
    explained->pose = lrcsi_host_median(times.first, rounds);
    return LRCS_OK;
}
