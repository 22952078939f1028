/* SPDX-License-Identifier: MIT */
/* lrcs report: everything about a scene from one pose, as a self-contained page. This file decides
   what is computed and in which order. */
#include "cli/report/report.h"

#include <stdlib.h>
#include <string.h>

static const char report_help[] =
    "usage: lrcs report SCENE [pose] -o FILE.html [options]\n"
    "\n"
    "Writes one page about SCENE, a .3ds, .obj or .stl model, a scene file, or 'demo': what\n"
    "it holds, what the laser sees, sigma (m2) with its certificate, what contributes to it,\n"
    "what was simulated and why, cuts through three planes and a map of all directions\n"
    "(dBsm), the peaks and what contributes to them, what accuracy costs in time, and the\n"
    "commands that reproduce all of it. The page is one file for any browser, with its\n"
    "pictures inside and no scripts.\n"
    "\n" CLI_POSE_HELP "\n"
    "output\n"
    "  -o FILE.html          the page ('-': standard output)\n"
    "\n"
    "options\n"
    "  --explore             writes an interactive page instead: the body can be rotated,\n"
    "                        beside a map of sigma. It holds its script, and loads nothing. A\n"
    "                        body of more than 20000 facets is drawn simplified\n"
    "  --seconds S           approximate time, by the clock, for cuts, map and comparison\n"
    "                        (default 40): it decides their steps, and is exceeded if a pose\n"
    "                        takes seconds\n"
    "  --cut-step DEG        step of the cuts, a divisor of 90 (default: as the time allows)\n"
    "  --map-step DEG        step of the map, likewise\n"
    "  --jobs N              number of threads for cuts and map (default: one for each\n"
    "                        processor)\n"
    "\n"
    "run and scene\n" CLI_ACCURACY_HELP CLI_SCENE_HELP "\n"
    "Cuts and map are computed to a tolerance of 0.01, or REL if that is larger, for which\n"
    "their shapes are tessellated. Exit 3 if the run at the pose misses its own tolerance.\n"
    "\n"
    "examples\n"
    "  lrcs report demo --azel 50,40 -o demo.html\n"
    "  lrcs report aura.3ds --unit in --azel 30,20 --material solar=solar-cell -o aura.html\n"
    "  lrcs report examples/satellites/lander.toml --tolerance 0.003 -o lander.html\n";

static const cli_option report_options[] = {
    CLI_POSE_OPTIONS,  CLI_ACCURACY_OPTIONS, CLI_SCENE_OPTIONS,  {"o", CLI_FILE, 0},
    {"seconds", 1, 0}, {"cut-step", 1, 0},   {"map-step", 1, 0}, {"jobs", 1, 0},
    {"explore", 0, 0}, {"help", 0, 0},       {NULL, 0, 0}};

#define REPORT_SECONDS   40.0 /* if no time is given */
#define REPORT_COMPARE   0.25 /* share of the time for the comparison */
#define REPORT_TOLERANCE 1e-2 /* tolerance of cuts and map */

/* ---- options ---- */

/* Reads a step that divides 90 deg, so that 0, 90, 180 and 270 deg are included. */
static int step_read(const cli_args *args, const char *name, uint32_t *step)
{
    int code = cli_whole(args, name, 1.0, 90.0, step);
    return code == 0 && *step > 0 && 90 % *step != 0 ? cli_expected(args, name, "a divisor of 90")
                                                     : code;
}

static int report_read(report_job *job)
{
    const cli_args *args = job->args;
    job->path = cli_value(args, "o");
    job->seconds = REPORT_SECONDS;
    if (!job->path) {
        return cli_usage(args->command, "give -o FILE.html");
    }
    if (strcmp(job->path, "-") != 0 && !cli_extension(job->path, ".html") &&
        !cli_extension(job->path, ".htm")) {
        return cli_expected(args, "o", "FILE.html");
    }
    int code = cli_pose_read(args, &job->run.pose);
    code = code ? code : cli_accuracy_read(args, &job->run.options);
    code = code ? code : cli_positive(args, "seconds", "a time > 0", &job->seconds);
    if (code == 0 && cli_value(args, "explore") && cli_value(args, "cut-step")) {
        return cli_usage(args->command, "--cut-step: there are no cuts with --explore");
    }
    code = code ? code : step_read(args, "cut-step", &job->cut_step);
    code = code ? code : step_read(args, "map-step", &job->map_step);
    code = code ? code : cli_whole(args, "jobs", 1.0, CLI_JOBS_MOST, &job->threads);
    code = code ? code : cli_scene_options_read(args, &job->run.load);
    code = code ? code : cli_normals_read(args, &job->run.load);
    cli_division_set(&job->run.options, &job->run.load);
    job->run.sampling = lrcs_uncertainty_options_default();
    job->run.shares_asked = 1;
    job->sweep_options = job->run.options;
    job->sweep_load = job->run.load;
    if (job->run.options.tolerance < REPORT_TOLERANCE) {
        job->sweep_options.tolerance = job->sweep_load.build.tolerance = REPORT_TOLERANCE;
    }
    return code;
}

/* ---- the comparison ---- */

/* Compares accuracy and cost. Meshes of shapes are compared up to the run's own tolerance; a
   setting whose first run would take most of the time is left out. */
static int report_compare(report_job *job)
{
    converge_job *compare = &job->converge;
    double least = 1.0;
    *compare = (converge_job){.args = job->args,
                              .title = cli_scene_name(job->args, &job->run.scene),
                              .all = {.pose = job->run.pose,
                                      .load = job->run.load,
                                      .digits = 1,
                                      .seconds = REPORT_COMPARE * job->seconds}};
    lrcs_host_convergence *all = &compare->all;
    all->load.build = lrcs_build_options_default(); /* as in lrcs converge */
    while (all->digits < LRCS_HOST_CONVERGENCE_MESHES && least > 1.5 * job->run.options.tolerance &&
           (least > 1e-3 || 3.0 * job->run.seconds < all->seconds)) {
        least /= 10.0;
        all->digits += least < 0.05;
    }
    int code = cli_converge_read(compare);
    code = code ? code : cli_converge_measure(compare);
    if (code == 0) {
        lrcs_host_error error;
        FILE *out = cli_report_bytes_begin(&job->chart);
        if (!out) {
            return CLI_FAILED;
        }
        cli_converge_chart(out, compare, 0, &error);
        code = cli_report_bytes_end(out);
    }
    return code;
}

/* ---- the command ---- */

/* The scene as lrcs info reads it. */
static int report_info(report_job *job)
{
    lrcs_host_error error;
    lrcs_build_options build = lrcs_build_options_default();
    build.normals = LRCS_NORMALS_SMOOTH;
    return lrcs_host_scene_vary(&job->run.scene, &job->run.scene.recipe, &build, &job->info_scene,
                                &error) == LRCS_OK
               ? cli_inventory_make(job->args, &job->run.scene, &job->info_scene.scene, &job->info)
               : cli_failed(&error);
}

/* Computes all that the page shows; of an interactive page, the map alone, and the body as it is
   drawn. */
static int report_measure(report_job *job, int explore)
{
    if (explore) {
        job->run.load.build.division = 0.0;
        job->run.load.build.max_facets = lrcs_build_options_default().max_facets;
        int code = cli_scene_read(job->args, &job->run.load, &job->run.scene);
        code = code ? code : cli_outputs_spare(job->args, &job->run.scene);
        cli_watch_stage("preparing", &job->run.scene);
        code = code ? code : cli_scene_prepare(&job->run.scene);
        return code ? code : cli_report_map(job);
    }
    int code = cli_report_run(job);
    code = code ? code : cli_report_summary_make(job);
    code = code ? code : report_info(job);
    code = code ? code : cli_report_sweeps(job);
    cli_watch_stage("comparing accuracy", NULL);
    return code ? code : report_compare(job);
}

static void report_free(report_job *job)
{
    for (int i = 0; i < REPORT_SWEEPS; i++) {
        free(job->sweep[i].row);
        free(job->sweep[i].band);
        free(job->sweep[i].svg.bytes);
    }
    for (uint32_t i = 0; i < REPORT_PEAKS; i++) {
        lrcs_host_shares_free(&job->peak_shares[i]);
    }
    for (int i = 0; i < REPORT_PICTURES; i++) {
        free(job->picture[i][0].bytes);
        free(job->picture[i][1].bytes);
    }
    lrcs_host_convergence_free(&job->converge.all);
    free(job->chart.bytes);
    free(job->summary.bytes);
    lrcs_host_inventory_free(&job->info);
    lrcs_host_scene_free(&job->info_scene);
    lrcs_host_scene_free(&job->sweep_scene);
    cli_run_free(&job->run);
}

static int report_command(const cli_args *args)
{
    report_job *job = calloc(1, sizeof *job);
    if (!job) {
        return cli_out_of_memory();
    }
    job->args = job->run.args = args;
    int code = report_read(job);
    int explore = cli_value(args, "explore") != NULL;
    code = code ? code : report_measure(job, explore);
    code = code ? code
                : cli_output_write(job->path, explore ? cli_report_explore_page : cli_report_page,
                                   job);
    if (code == 0) {
        cli_watch_end();
        cli_notices_print(stderr, &job->run.scene.notices);
        cli_outputs_print(args, NULL);
        code = cli_accuracy_code(args, &job->run.options, job->run.result.flags);
    }
    report_free(job);
    free(job);
    return code;
}

const cli_command cli_report_command = {
    "report",    "SCENE",        "give a .3ds, .obj or .stl model, a scene file, or demo",
    report_help, report_options, report_command,
    NULL};
