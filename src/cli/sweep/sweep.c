/* SPDX-License-Identifier: MIT */
/* lrcs sweep: sigma over attitudes and over the quantities of a scene that can vary. */
#include "cli/sweep/sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const char sweep_help[] =
    "usage: lrcs sweep SCENE WHAT [options]\n"
    "\n"
    "Computes sigma (m2) and its bound for all combinations of what varies, the last axis\n"
    "fastest. The output has the same bytes for any number of threads.\n"
    "\n"
    "what varies: RANGE is A:B:STEP, from A by STEP up to B, with B if STEP leads\n"
    "to it, or one number\n"
    "  --az RANGE, --el RANGE  azimuth and elevation of the laser in the body frame, deg;\n"
    "                        elevations beyond 90 deg go on over the pole, so that\n"
    "                        --el 0:360:1 is a full circle\n"
    "  --euler SEQ:a,b,c     Euler angles, deg, each a RANGE; XYZ: R = Rx(a) Ry(b) Rz(c)\n"
    "  --rotate AXIS:RANGE   rotation about the body's x, y, z or u,v,w, deg; from the pose of\n"
    "                        --direction, --azel, .. (default: laser on the +z axis)\n"
    "  --sphere N            N nearly uniform directions, and their mean with its standard\n"
    "                        error\n"
    "  --poses FILE.csv      rows time,w,x,y,z (quaternion, body to observation frame) or\n"
    "                        time,x,y,z (direction to the laser, body frame). Times are\n"
    "                        seconds, or dates such as 2026-11-22T20:15:30.5Z; columns\n"
    "                        joint:PART are angles of joints, deg\n"
    "  --joint PART:RANGE    angle of a joint, deg; several, NAME,NAME or '*', turn together\n"
    "  --vary MATERIAL.KEY:RANGE  A, B, s or m of a material\n"
    "  --vary PART.KEY:RANGE  of a shape: size_x, size_y, size_z, radius, radius2, length (m),\n"
    "                        half_angle_deg\n"
    "\n"
    "output\n"
    "  -o FILE               FILE.csv, FILE.jsonl or FILE.npy (NumPy: sigma and bound; with\n"
    "                        FILE.npy.head); without it CSV on standard output. A FILE that\n"
    "                        exists is replaced, with a notice. Rows that its disk cannot hold\n"
    "                        are refused; no more than 17.1 GB (16 GiB) can be read back\n"
    "  --json                JSON lines on standard output\n"
    "  --resume              continues FILE.partial, whose rows are checked; never replaces a\n"
    "                        complete FILE\n"
    "  --shard K/N           only the K-th of N parts of the rows; lrcs merge joins the files\n"
    "  --jobs N              number of threads (default: one for each processor, or fewer)\n"
    "  --plot FILE           a chart, FILE.svg or FILE.png: up to 7 curves, or a map (lrcs\n"
    "                        plot); repeatable\n"
    "  --dbsm                the chart shows sigma in dBsm (default: m2); where sigma is 0,\n"
    "                        curves have a gap, and maps are grey\n"
    "  --polar               curves about a pole, the angle counter-clockwise\n"
    "  --projection KIND     of a map: flat (default), or mollweide, which preserves areas\n"
    "  --stats               mean by solid angle, percentiles, minimum, maximum, histogram;\n"
    "                        with bands if materials state errors\n"
    "  --stats-file FILE     the same as FILE.json, .csv, .svg or .png; repeatable\n"
    "  --brightest N         with -o FILE: prints the N brightest peaks (rows brighter than all\n"
    "                        those one step away) and what contributes to each, with a mark if\n"
    "                        it is the normal of a facet that is too coarse for its glint\n"
    "\n"
    "options\n" CLI_ACCURACY_HELP;

static const char sweep_help_more[] = CLI_SCENE_HELP
    "\n"
    "Columns: index, what varies, sigma_m2, sigma_dbsm, bound_m2, sigma_glint_m2,\n"
    "sigma_diffuse_m2, flags; the last line is a checksum. JSON lines without an index are\n"
    "not rows. Exit 3 if rows miss the tolerance. With --accept, .npy has a third number: 1\n"
    "accepted by estimate, 2 by any, 0 by bound, -1 missed. Before the flags, in CSV and JSON\n"
    "lines:\n"
    "  material_deviation_m2, material_low_m2, material_high_m2, material_sampled\n"
    "                        if materials state errors: the material uncertainty\n"
    "  glint_error_estimate_m2, one_facet_dominates\n"
    "                        if parts of a model are too coarse for their glint (lrcs info), or\n"
    "                        may become so by --vary: the estimated error, which is not in the\n"
    "                        bound, and 1 if one flat face of a curved part makes most of sigma\n"
    "\n"
    "examples\n"
    "  lrcs sweep demo --az 0:360:1 --el -30:30:30 -o cuts.csv --plot cuts.svg --polar --dbsm\n"
    "  lrcs sweep demo --az 0:360:2 --el -90:90:2 -o map.npy --brightest 10 --stats\n"
    "  lrcs sweep demo --poses track.csv -o t.jsonl --resume\n"
    "  lrcs sweep demo --sphere 1e6 --shard 3/16 -o map.3.csv\n";

static const cli_option sweep_options[] = {CLI_POSE_OPTIONS,     CLI_ACCURACY_OPTIONS,
                                           CLI_SCENE_OPTIONS,    {"az", 1, 0},
                                           {"el", 1, 0},         {"joint", 1, 1},
                                           {"vary", 1, 1},       {"rotate", 1, 0},
                                           {"sphere", 1, 0},     {"poses", 1, 0},
                                           {"o", CLI_FILE, 0},   {"json", 0, 0},
                                           {"resume", 0, 0},     {"shard", 1, 0},
                                           {"jobs", 1, 0},       {"plot", CLI_CHART, 1},
                                           {"dbsm", 0, 0},       {"polar", 0, 0},
                                           {"brightest", 1, 0},  {"stats", 0, 0},
                                           {"projection", 1, 0}, {"stats-file", CLI_FILE, 1},
                                           {"help", 0, 0},       {NULL, 0, 0}};

typedef struct sweep_job {
    const cli_args *args;
    lrcs_host_plan plan;
    lrcs_host_rows_head head;
    lrcs_host_sweep_output file;
    cli_progress progress;
    cli_pace pace;
    lrcs_host_sweep_chart plot;
    uint32_t brightest;
    int stats;
    double (*row)[2]; /* sigma and bound of every row, for the two outputs above */
    double (*band)[2];
    lrcs_run_options options;
    lrcs_host_options load;
    lrcs_host_scene scene;
    uint32_t threads;
    uint32_t notices;        /* of all results, as bits */
    lrcs_host_glint *coarse; /* curved parts whose facets are too coarse for their glint */
    uint32_t coarse_count;
} sweep_job;

/* Set by a signal: the sweep ends after the poses that are being computed. */
static volatile sig_atomic_t sweep_stop;

/* The first Ctrl-C, or the warning of a batch system, ends the sweep in order; another one that
   comes seconds later ends it at once. (A signal may arrive twice, sent to a process and to its
   group.) */
static void stop_signal(int number)
{
    static volatile time_t since;
    time_t now = time(NULL);
    if (sweep_stop && now - since > 1) {
        signal(number, SIG_DFL);
        raise(number);
    }
    since = sweep_stop ? since : now;
    sweep_stop = 1;
}

/* A signal that the shell has set to be ignored stays ignored. */
static void signals_watch(void)
{
    static const int number[] = {SIGINT, SIGTERM};
    struct sigaction action;
    struct sigaction before;
    memset(&action, 0, sizeof action);
    action.sa_handler = stop_signal;
    action.sa_flags = SA_RESTART;
    sigaddset(&action.sa_mask, SIGINT);
    sigaddset(&action.sa_mask, SIGTERM);
    for (size_t i = 0; i < sizeof number / sizeof number[0]; i++) {
        if (sigaction(number[i], NULL, &before) == 0 && before.sa_handler != SIG_IGN) {
            sigaction(number[i], &action, NULL);
        }
    }
}

/* ---- options ---- */

static int sweep_options_read(sweep_job *job)
{
    const cli_args *args = job->args;
    int code = cli_rows_output_read(args, &job->file);
    code = code ? code : cli_whole(args, "jobs", 1.0, CLI_JOBS_MOST, &job->threads);
    code = code ? code : cli_accuracy_read(args, &job->options);
    code = code ? code : cli_scene_options_read(args, &job->load);
    code = code ? code : cli_normals_read(args, &job->load);
    code = code ? code : cli_plan_read(args, &job->plan);
    code = code ? code : cli_shard_read(args, &job->plan, &job->file.first, &job->file.end);
    code = code ? code : cli_plot_read(args, &job->plan, &job->plot);
    code = code ? code : cli_brightest_read(args, &job->plan, &job->file, &job->brightest);
    code = code ? code : cli_stats_read(args, &job->stats);
    if (code == 0 && job->stats && cli_value(args, "shard")) {
        return cli_usage(args->command, "--stats needs the whole sweep: leave out --shard");
    }
    cli_division_set(&job->options, &job->load);
    if (code == 0 && job->file.npy && cli_value(args, "shard")) {
        return cli_usage(args->command,
                         "--shard writes .csv or .jsonl; lrcs merge makes the .npy of them");
    }
    int kept = cli_value(args, "plot") || job->brightest > 0 || job->stats;
    return code ? code : cli_size_check(args, &job->plan, &job->file, kept);
}

/* Checks that no output replaces a file that is read. */
static int sweep_files_check(const sweep_job *job)
{
    const cli_args *args = job->args;
    lrcs_host_error error;
    const char *poses = cli_value(args, "poses");
    if (job->file.path &&
        lrcs_host_output_check(job->file.partial, &job->scene, &error) != LRCS_OK) {
        return cli_usage(args->command, "-o %s", error.text);
    }
    int code = poses ? cli_outputs_spare_input(args, poses, "the poses") : 0;
    return code ? code : cli_outputs_spare(args, &job->scene);
}

/* ---- the rows ---- */

static int row_pose(void *context, uint64_t index, lrcs_pose *pose)
{
    const sweep_job *job = context;
    return lrcs_host_plan_pose(&job->plan, index, pose);
}

static int row_take(void *context, uint64_t index, const lrcs_pose *pose, const lrcs_result *result,
                    const lrcs_uncertainty *uncertainty, const lrcs_host_glint_sum *glint,
                    lrcs_host_error *error)
{
    sweep_job *job = context;
    (void)pose;
    lrcs_host_row row = {.index = index,
                         .field[LRCS_HOST_ROW_SIGMA] = result->sigma_m2,
                         .field[LRCS_HOST_ROW_DBSM] =
                             result->sigma_m2 > 0.0 ? cli_dbsm(result->sigma_m2) : (double)NAN,
                         .field[LRCS_HOST_ROW_BOUND] = result->bound_m2,
                         .field[LRCS_HOST_ROW_GLINT] = result->sigma_glint_m2,
                         .field[LRCS_HOST_ROW_DIFFUSE] = result->sigma_diffuse_m2,
                         .flags = cli_flags_in_force(job->args, &job->options, result->flags)};
    lrcs_host_plan_values(&job->plan, index, row.value);
    if (uncertainty) {
        row.field[LRCS_HOST_ROW_DEVIATION] = uncertainty->deviation_m2;
        row.field[LRCS_HOST_ROW_LOW] = uncertainty->low_m2;
        row.field[LRCS_HOST_ROW_HIGH] = uncertainty->high_m2;
        row.field[LRCS_HOST_ROW_SAMPLED] = uncertainty->sampled;
    }
    if (glint) {
        row.field[LRCS_HOST_ROW_GLINT_ERROR] = glint->error_m2;
        row.field[LRCS_HOST_ROW_DOMINATED] = lrcs_host_glint_dominates(glint, result->sigma_m2);
    }
    job->notices |= result->notices;
    int status = lrcs_host_sweep_output_put(&job->file, &row, error);
    status =
        status == LRCS_OK ? cli_pace_take(&job->pace, &job->file, &job->progress, error) : status;
    cli_progress_show(&job->progress, job->file.next - job->file.first);
    return status;
}

static int row_scene(void *context, uint64_t index, lrcs_host_scene *scene, lrcs_host_error *error)
{
    const sweep_job *job = context;
    return lrcs_host_plan_scene(&job->plan, index, &job->scene, &job->load.build, scene, error);
}

/* Computes the rows up to `end`: all of one scene, or, if it is NULL, each of its own scene. */
static int rows_run(sweep_job *job, const lrcs_host_scene *scene, uint64_t end)
{
    lrcs_host_error error;
    const lrcs_uncertainty_options how = lrcs_uncertainty_options_default();
    lrcs_host_sweep sweep = {.first = job->file.next,
                             .count = end - job->file.next,
                             .threads = job->threads,
                             .pose = row_pose,
                             .scene = scene ? NULL : row_scene,
                             .take = row_take,
                             .refine = 1,
                             .uncertainty = job->head.fields.materials ? &how : NULL,
                             .glint = job->head.fields.glint ? job->coarse : NULL,
                             .glint_count = job->coarse_count,
                             .context = job,
                             .cancel = &sweep_stop};
    if (lrcs_host_sweep_run(scene, &job->options, &sweep, NULL, &error) == LRCS_OK) {
        return 0;
    }
    cli_progress_clear(&job->progress);
    return cli_failed(&error);
}

static int rows_compute(sweep_job *job)
{
    lrcs_host_error error;
    lrcs_host_scene scene;
    int code = 0;
    const uint64_t done = job->file.next - job->file.first;
    const uint64_t all = job->file.end - job->file.first;
    if (lrcs_host_plan_varies_scene(&job->plan)) {
        job->progress = cli_progress_make(done, all);
        int apart = job->plan.poses == 1 || job->plan.track.joints > 0; /* each row has a scene */
        code = apart ? rows_run(job, NULL, job->file.end) : 0;
        while (!apart && code == 0 && job->file.next < job->file.end) {
            uint64_t end = (job->file.next / job->plan.poses + 1) * job->plan.poses;
            memset(&scene, 0, sizeof scene);
            if (row_scene(job, job->file.next, &scene, &error) != LRCS_OK) {
                return cli_failed(&error);
            }
            code = rows_run(job, &scene, end < job->file.end ? end : job->file.end);
            lrcs_host_scene_free(&scene);
        }
    } else if (job->file.next < job->file.end) {
        cli_watch_stage("preparing", &job->scene);
        code = cli_scene_prepare(&job->scene);
        job->progress = cli_progress_make(done, all);
        code = code ? code : rows_run(job, &job->scene, job->file.end);
    }
    cli_progress_clear(&job->progress);
    return code;
}

/* ---- the command ---- */

/* Prints a summary for people; the rows contain all of it too. */
static void sweep_summary_print(const sweep_job *job)
{
    const lrcs_host_tally *tally = &job->file.tally;
    for (uint32_t bits = job->notices; bits != 0; bits &= bits - 1) {
        fprintf(stderr, "notice: %s\n", lrcs_notice_text(CLI_LOWEST(bits)));
    }
    if (lrcs_host_plan_is_sphere(&job->plan) && tally->rows == job->plan.rows) {
        char spread[40] = "not known from one direction";
        if (tally->rows > 1) {
            snprintf(spread, sizeof spread, "%.3g m2", lrcs_host_tally_error(tally));
        }
        fprintf(stderr, "notice: mean of sigma %.10g m2, standard error %s, mean bound %.3g m2\n",
                lrcs_host_tally_mean(tally), spread, lrcs_host_tally_bound(tally));
    }
    char missed[60];
    char estimated[80];
    snprintf(missed, sizeof missed, "miss the tolerance %g", job->options.tolerance);
    snprintf(estimated, sizeof estimated, "are accepted by estimate, not proved to %g",
             job->options.tolerance);
    const struct {
        int count;
        const char *begin, *what;
    } said[] = {
        {LRCS_HOST_TALLY_MISSED, "lrcs: ", missed},
        {LRCS_HOST_TALLY_ESTIMATED, "notice: ", estimated},
        {LRCS_HOST_TALLY_UNJUDGED, "notice: ", "are accepted whatever their error"},
        {LRCS_HOST_TALLY_DOMINATED, "notice: in ",
         "the glint of one flat face of a curved part makes most of sigma: its normal is the "
         "mesh's, not the surface's"},
        {LRCS_HOST_TALLY_STARVED, "lrcs: ", "were short of memory"}};
    for (size_t i = 0; i < sizeof said / sizeof said[0]; i++) {
        if (tally->count[said[i].count] > 0) {
            fprintf(stderr, "%s%llu of %llu rows %s\n", said[i].begin,
                    (unsigned long long)tally->count[said[i].count],
                    (unsigned long long)tally->rows, said[i].what);
        }
    }
}

/* Prints where the error of the glint may exceed the bound. */
static void coarse_print(const sweep_job *job)
{
    uint32_t coarse = 0;
    double worst = 0.0;
    for (uint32_t i = 0; i < job->coarse_count; i++) {
        coarse += job->coarse[i].error > LRCS_HOST_GLINT_COARSE;
        worst = job->coarse[i].error > worst ? job->coarse[i].error : worst;
    }
    if (coarse > 0) {
        fprintf(
            stderr,
            "notice: glint: %lu curved part%s too coarse for the slope of their material: near the "
            "normals of facets sigma may be off by %.3g %% of its glint, an estimate (--normals "
            "auto)\n",
            (unsigned long)coarse, coarse == 1 ? " is" : "s are", 100.0 * worst);
    }
}

/* Computes the rows, and writes them and what is made of them.
   1. The first lines of the rows; signals are caught before the rows of an existing file are read,
      which may take seconds.
   2. Memory for what depends on all rows: plots, statistics, peaks.
   3. The rows: those of an existing file, then those that are computed.
   4. Plots, statistics, peaks, the summary. */
static int sweep_rows_write(sweep_job *job)
{
    const lrcs_host_tally *tally = &job->file.tally;
    const cli_args *args = job->args;
    lrcs_host_error error;
    job->file.plan = &job->plan;
    job->file.head = &job->head;
    job->plot.head = &job->head;
    job->plot.materials_assumed = cli_materials_assumed(&job->scene.scene);
    job->plot.title = cli_base_name(cli_scene_title(args, &job->scene));
    int code = cli_rows_head_make(args, &job->plan, &job->options, &job->scene,
                                  job->coarse_count > 0, &job->head); /* 1 */
    if (code != 0) {
        return code;
    }
    signals_watch();
    cli_watch_stage("existing rows", NULL);
    int plotted = cli_value(args, "plot") != NULL;
    if (plotted || job->brightest > 0 || job->stats) { /* 2 */
        int has_intervals = (plotted || job->stats) && job->head.fields.materials;
        job->file.row = job->plot.row = job->row = calloc(job->plan.rows, sizeof *job->row);
        job->band = has_intervals ? calloc(job->plan.rows, sizeof *job->band) : NULL;
        job->file.band = job->plot.band = job->band;
        if (!job->row || (has_intervals && !job->band)) {
            return cli_out_of_memory();
        }
    }
    int resume = cli_value(args, "resume") != NULL; /* 3 */
    if (lrcs_host_sweep_output_open(&job->file, resume, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    const int complete = resume && job->file.descriptor < 0;
    if (complete) {
        fprintf(stderr, "notice: %s is complete: no row is computed\n", cli_value(args, "o"));
    } else if (job->file.path && !resume) {
        cli_replaced_print(args, &job->file);
    }
    job->pace = (cli_pace){cli_seconds(), job->file.next, 0, 0};
    code = rows_compute(job);
    int closed = lrcs_host_sweep_output_close(&job->file, code == 0, &error);
    /* cli_finish checks standard output */
    closed = closed == LRCS_OK || !job->file.path ? 0 : cli_failed(&error);
    if (code != 0 && job->file.next > job->file.first && job->file.path && closed == 0 &&
        !job->pace.too_large) {
        fprintf(stderr, "lrcs: %s holds %llu of %llu rows; --resume continues with them\n",
                job->file.partial, (unsigned long long)(job->file.next - job->file.first),
                (unsigned long long)(job->file.end - job->file.first));
    }
    code = code ? code : closed;
    const double(*row)[2] = (const double(*)[2])job->row; /* 4 */
    code = code == 0 && plotted ? cli_plot_write(args, &job->plot, 1) : code;
    if (code == 0 && job->stats) { /* stdout is for the rows if no file is given */
        code = cli_stats_write(args, job->file.path ? stdout : stderr, &job->plan, &job->head, row,
                               (const double(*)[2])job->band);
    }
    if (code == 0 && job->brightest > 0) {
        code = cli_brightest_print(&job->plan, row, job->brightest, &job->scene, &job->options,
                                   &job->load.build, job->coarse, job->coarse_count);
    }
    if (code != 0) {
        return code;
    }
    sweep_summary_print(job);
    cli_outputs_print(args, complete ? "o" : NULL);
    return tally->count[LRCS_HOST_TALLY_MISSED] > 0 || tally->count[LRCS_HOST_TALLY_STARVED] > 0
               ? CLI_DEGRADED
               : CLI_DONE;
}

static int sweep_command(const cli_args *args)
{
    sweep_job *job = calloc(1, sizeof *job);
    if (!job) {
        return cli_out_of_memory();
    }
    job->args = args;
    int code = sweep_options_read(job);
    cli_watch_stage("loading", NULL);
    code = code ? code : cli_scene_read(args, &job->load, &job->scene);
    code = code ? code : cli_plan_check(args, &job->plan, &job->scene);
    code = code ? code : sweep_files_check(job);
    if (code == 0) {
        cli_notices_print(stderr, &job->scene.notices);
        /* if a slope is varied, parts that are fine now may be too coarse in some rows */
        lrcs_host_error error;
        if (lrcs_host_glint_coarse(&job->scene, &job->load.build, cli_value(args, "vary") != NULL,
                                   &job->coarse, &job->coarse_count, &error) != LRCS_OK) {
            code = cli_failed(&error);
        }
        coarse_print(job);
    }
    code = code ? code : sweep_rows_write(job);
    free(job->row);
    free(job->band);
    free(job->coarse);
    lrcs_host_sweep_output_free(&job->file);
    lrcs_host_plan_free(&job->plan);
    lrcs_host_scene_free(&job->scene);
    cli_scene_options_free(&job->load);
    free(job);
    return code;
}

const cli_command cli_sweep_command = {
    "sweep",        "SCENE",       "give a .3ds, .obj or .stl model, a scene file, or demo",
    sweep_help,     sweep_options, sweep_command,
    sweep_help_more};
