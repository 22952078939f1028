/* SPDX-License-Identifier: MIT */
/* The sweeps of a report: three cuts and a map. Each is specified as a command line of lrcs sweep,
   so that the page can state the command that reproduces it; the available time decides their
   resolution. */
#include "cli/report/report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SWEEP_PART  0.65 /* share of the time for sweeps */
#define TRIAL_MOST  4096u
#define TRIAL_POSES "4096"

/* ---- how fine ---- */

static const struct {
    uint32_t cut, map; /* deg */
} sweep_steps[] = {{1, 1},  {1, 2},  {1, 3},   {1, 5},   {2, 10}, {3, 15},
                   {5, 15}, {5, 18}, {10, 18}, {15, 30}, {30, 30}};

#define SWEEP_STEPS (sizeof sweep_steps / sizeof sweep_steps[0])

/* The number of different directions. */
static double map_poses(uint32_t map)
{
    return (360.0 / map) * (180.0 / map - 1.0) + 2.0;
}

static double steps_poses(uint32_t cut, uint32_t map)
{
    return 3.0 * (360.0 / cut) + map_poses(map);
}

/* A trial of some directions, whose results are not kept: consecutive ones are far apart. */
static int trial_pose(void *context, uint64_t index, lrcs_pose *pose)
{
    return lrcs_host_plan_pose(context, index * 7919 % TRIAL_MOST, pose);
}

static int trial_take(void *context, uint64_t index, const lrcs_pose *pose,
                      const lrcs_result *result, const lrcs_uncertainty *uncertainty,
                      const lrcs_host_glint_sum *glint, lrcs_host_error *error)
{
    (void)context, (void)index, (void)pose, (void)result, (void)uncertainty, (void)glint,
        (void)error;
    return LRCS_OK;
}

/* The approximate number of poses that can be computed in a time: from the time that trials of 4,
   8, 16, .. poses take, in as many threads as the sweeps, until one takes 5 % of it. The first ones
   also divide shapes more finely, which later ones find done. */
static int poses_count(const report_job *job, const lrcs_host_scene *scene, double time,
                       double *poses)
{
    const lrcs_uncertainty_options how = lrcs_uncertainty_options_default();
    const lrcs_host_plan_text all = {"sphere", TRIAL_POSES};
    lrcs_host_error error;
    lrcs_host_plan plan;
    double seconds = 0.0, spent = 0.0;
    int status = lrcs_host_plan_make(&all, 1, NULL, &plan, &error);
    for (uint64_t count = 4; status == LRCS_OK && seconds < 0.05 * time && count <= TRIAL_MOST;
         count *= 2) {
        const lrcs_host_sweep sweep = {.uncertainty =
                                           cli_errors_stated(&scene->scene) ? &how : NULL,
                                       .count = count,
                                       .threads = job->threads,
                                       .pose = trial_pose,
                                       .take = trial_take,
                                       .refine = 1,
                                       .context = &plan};
        double begun = cli_seconds();
        status = lrcs_host_sweep_run(scene, &job->sweep_options, &sweep, NULL, &error);
        seconds = cli_seconds() - begun;
        spent += seconds;
        *poses = fmax(time - spent, 0.0) * (double)count / fmax(seconds, 1e-6);
    }
    return status == LRCS_OK ? 0 : cli_failed(&error);
}

static int steps_choose(report_job *job, const lrcs_host_scene *scene)
{
    double poses = 0.0;
    size_t i = 0;
    if (job->cut_step > 0 && job->map_step > 0) {
        return 0;
    }
    int code = poses_count(job, scene, SWEEP_PART * job->seconds, &poses);
    while (i + 1 < SWEEP_STEPS && steps_poses(sweep_steps[i].cut, sweep_steps[i].map) > poses) {
        i++;
    }
    job->cut_step = job->cut_step > 0 ? job->cut_step : sweep_steps[i].cut;
    job->map_step = job->map_step > 0 ? job->map_step : sweep_steps[i].map;
    return code;
}

/* ---- one sweep ---- */

/* Makes the plan of a sweep from what varies, which a command line repeats. */
static int sweep_plan_make(const report_job *job, int kind, report_sweep *sweep)
{
    unsigned long step = kind == REPORT_MAP ? job->map_step : job->cut_step;
    int turns_az = kind == REPORT_MAP || kind == REPORT_CUT_XY;
    snprintf(sweep->az, sizeof sweep->az, kind == REPORT_CUT_YZ ? "90" : "0");
    snprintf(sweep->el, sizeof sweep->el, "0");
    if (turns_az) {
        snprintf(sweep->az, sizeof sweep->az, "0:360:%lu", step);
    }
    if (kind != REPORT_CUT_XY) {
        snprintf(sweep->el, sizeof sweep->el, kind == REPORT_MAP ? "-90:90:%lu" : "0:360:%lu",
                 step);
    }
    lrcs_host_error error;
    const lrcs_host_plan_text given[] = {{"az", sweep->az}, {"el", sweep->el}};
    int status = lrcs_host_plan_make(given, 2, NULL, &sweep->plan, &error);
    sweep->plot =
        (lrcs_host_sweep_chart){.dbsm = 1, .polar = kind != REPORT_MAP, .plan = &sweep->plan};
    lrcs_host_sweep_chart_choose(&sweep->plot);
    sweep->plot.title = cli_scene_name(job->args, &job->run.scene);
    sweep->plot.materials_assumed = cli_materials_assumed(&job->run.scene.scene);
    sweep->plot.map = kind == REPORT_MAP; /* even if it has few rows */
    return status == LRCS_OK ? 0 : cli_failed(&error);
}

typedef struct sweep_walk {
    report_sweep *sweep;
    uint64_t *list; /* rows to be run: one for each direction */
    uint64_t listed;
    cli_progress *progress;
    uint64_t before; /* number of rows of the sweeps before */
} sweep_walk;

/* The first row of the same direction: a full turn ends where it began, and at a pole all azimuths
   are the same direction. */
static uint64_t row_first(const lrcs_host_plan *plan, uint64_t row)
{
    uint64_t els = plan->axis[1].range.count;
    uint64_t az = row / els;
    uint64_t el = row % els;
    int turns = plan->axis[0].range.count > 1;
    int pole = turns && els > 1 && (el == 0 || el == els - 1);
    az = pole || az == plan->axis[0].range.count - 1 ? 0 : az;
    el = !turns && el == els - 1 ? 0 : el;
    return az * els + el;
}

static int walk_pose(void *context, uint64_t index, lrcs_pose *pose)
{
    const sweep_walk *walk = context;
    return lrcs_host_plan_pose(&walk->sweep->plan, walk->list[index], pose);
}

static int walk_take(void *context, uint64_t index, const lrcs_pose *pose,
                     const lrcs_result *result, const lrcs_uncertainty *uncertainty,
                     const lrcs_host_glint_sum *glint, lrcs_host_error *error)
{
    sweep_walk *walk = context;
    (void)pose;
    (void)glint;
    (void)error;
    double *row = walk->sweep->row[walk->list[index]];
    row[0] = result->sigma_m2;
    row[1] = result->bound_m2;
    if (uncertainty) {
        double *band = walk->sweep->band[walk->list[index]];
        band[0] = uncertainty->low_m2;
        band[1] = uncertainty->high_m2;
    }
    cli_progress_show(walk->progress, walk->before + index + 1);
    return LRCS_OK;
}

/* Runs each direction once, and gives its result to all its rows. */
static int sweep_run(report_job *job, const lrcs_host_scene *scene, sweep_walk *walk)
{
    const lrcs_host_plan *plan = &walk->sweep->plan;
    const lrcs_uncertainty_options how = lrcs_uncertainty_options_default();
    lrcs_host_error error;
    double(*row)[2] = calloc(plan->rows, sizeof *row);
    int stated = cli_errors_stated(&scene->scene);
    double(*band)[2] = stated ? calloc(plan->rows, sizeof *band) : NULL;
    uint64_t *list = calloc(plan->rows, sizeof *list);
    walk->sweep->row = row;
    walk->sweep->band = band;
    walk->list = list;
    walk->listed = 0;
    if (!row || !list || (stated && !band)) {
        free(list);
        return cli_out_of_memory();
    }
    for (uint64_t i = 0; i < plan->rows; i++) {
        if (row_first(plan, i) == i) {
            list[walk->listed++] = i;
        }
    }
    const lrcs_host_sweep sweep = {.uncertainty = stated ? &how : NULL,
                                   .count = walk->listed,
                                   .threads = job->threads,
                                   .pose = walk_pose,
                                   .take = walk_take,
                                   .refine = 1,
                                   .context = walk};
    if (lrcs_host_sweep_run(scene, &job->sweep_options, &sweep, NULL, &error) != LRCS_OK) {
        cli_progress_clear(walk->progress);
        free(list);
        return cli_failed(&error);
    }
    walk->before += walk->listed;
    for (uint64_t i = 0; i < plan->rows; i++) {
        uint64_t first = row_first(plan, i);
        memcpy(row[i], row[first], sizeof row[i]);
        if (band) {
            memcpy(band[i], band[first], sizeof band[i]);
        }
    }
    free(list);
    return 0;
}

/* Draws a sweep, unless sigma is 0 everywhere. */
static int sweep_draw(report_sweep *sweep)
{
    int dark = 1;
    for (uint64_t i = 0; i < sweep->plan.rows; i++) {
        dark &= !(sweep->row[i][0] > 0.0);
    }
    if (dark) {
        return 0;
    }
    sweep->plot.row = sweep->row;
    sweep->plot.band = sweep->band;
    lrcs_host_error error;
    int status =
        sweep->band ? lrcs_host_sweep_chart_band(&sweep->plot, sweep->part, &error) : LRCS_OK;
    FILE *out = status == LRCS_OK ? cli_report_bytes_begin(&sweep->svg) : NULL;
    if (!out) {
        return status == LRCS_OK ? CLI_FAILED : cli_failed(&error);
    }
    status = lrcs_host_sweep_chart_write(out, &sweep->plot, 1, 0, &error);
    int ended = cli_report_bytes_end(out);
    return status == LRCS_OK ? ended : cli_failed(&error);
}

/* ---- all of them ---- */

/* The scene as lrcs sweep reads it: that of the run, unless its shapes are divided otherwise. */
static int scene_choose(report_job *job, lrcs_host_scene **scene)
{
    const lrcs_build_options *run = &job->run.load.build;
    const lrcs_build_options *build = &job->sweep_load.build;
    int same =
        run->tolerance == build->tolerance && run->division == build->division && !run->halvings;
    *scene = &job->run.scene;
    if (same || !lrcs_host_scene_tessellated(&job->run.scene.scene)) {
        return 0;
    }
    *scene = &job->sweep_scene;
    int code = cli_scene_read(job->args, &job->sweep_load, &job->sweep_scene);
    return code ? code : cli_scene_prepare(&job->sweep_scene);
}

int cli_report_map(report_job *job)
{
    static const uint32_t steps[] = {1, 2, 3, 5, 6, 9, 10, 15, 18, 30};
    lrcs_host_scene *scene = NULL;
    double poses = 0.0;
    int code = scene_choose(job, &scene);
    if (code == 0 && job->map_step == 0) {
        size_t i = 0;
        code = poses_count(job, scene, job->seconds, &poses);
        while (i + 1 < sizeof steps / sizeof steps[0] && map_poses(steps[i]) > poses) {
            i++;
        }
        job->map_step = steps[i];
    }
    cli_progress progress = cli_progress_make(0, code ? 0 : (uint64_t)map_poses(job->map_step));
    sweep_walk walk = {.progress = &progress, .sweep = &job->sweep[REPORT_MAP]};
    code = code ? code : sweep_plan_make(job, REPORT_MAP, walk.sweep);
    code = code ? code : sweep_run(job, scene, &walk);
    cli_progress_clear(&progress);
    return code;
}

int cli_report_sweeps(report_job *job)
{
    lrcs_host_scene *scene = NULL;
    cli_watch_stage("scene of the sweeps", NULL);
    int code = scene_choose(job, &scene);
    code = code ? code : steps_choose(job, scene);
    double poses = code ? 0.0 : steps_poses(job->cut_step, job->map_step);
    cli_progress progress = cli_progress_make(0, (uint64_t)poses);
    sweep_walk walk = {.progress = &progress};
    for (int kind = 0; kind < REPORT_SWEEPS && code == 0; kind++) {
        walk.sweep = &job->sweep[kind];
        code = sweep_plan_make(job, kind, walk.sweep);
        code = code ? code : sweep_run(job, scene, &walk);
        code = code ? code : sweep_draw(walk.sweep);
    }
    cli_progress_clear(&progress);
    cli_watch_stage("peaks", NULL);
    const report_sweep *map = &job->sweep[REPORT_MAP];
    job->peaks = code ? 0
                      : lrcs_host_plan_peaks(&map->plan, (const double(*)[2])map->row, REPORT_PEAKS,
                                             job->peak);
    for (uint32_t i = 0; i < job->peaks && code == 0; i++) {
        code = cli_row_shares(&map->plan, job->peak[i], scene, &job->sweep_options,
                              &job->sweep_load.build, &job->peak_shares[i]);
    }
    return code;
}
