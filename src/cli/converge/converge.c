/* SPDX-License-Identifier: MIT */
/* lrcs converge: the cost of accuracy in time, for one scene from one pose. */
#include "cli/converge/converge.h"

#include <stdlib.h>
#include <string.h>

static const char converge_help[] =
    "usage: lrcs converge SCENE [pose] [options]\n"
    "\n"
    "Runs SCENE from one pose with every method and resolution, and its shapes with every\n"
    "fineness of tessellation, and compares error, proved bound and time. It also measures\n"
    "the time in which a tolerance is met by an estimate (run --accept estimate). The truth\n"
    "is the closed form if the scene is a single shape that is not rotated or scaled;\n"
    "otherwise method exact on the finest mesh.\n"
    "\n" CLI_POSE_HELP "\n"
    "options\n"
    "  --csv FILE.csv        one row for each setting ('-': on standard output, instead of the\n"
    "                        table); FILE.csv.json states what they were made from\n"
    "  --plot FILE           a chart of error against time, FILE.svg or FILE.png; repeatable\n"
    "  --seconds S           approximate time for the runs (default 20), in addition to loading\n"
    "                        and preparing\n"
    "  --unit U              unit of a model: mm, cm, m (default), in, ft or metres per unit\n"
    "  --material [WHAT=]BRDF  repeatable, as in lrcs run\n"
    "  --keep-transparent    keeps facets that the file declares fully transparent\n"
    "  --json                the table as JSON, notices included\n"
    "\n"
    "Columns: prepare is needed once for each mesh, pose once for each direction (median over\n"
    "the runs); error is |sigma - truth|; '-' means not known, or none. Exit 1 if an error\n"
    "exceeds its bound.\n"
    "\n"
    "examples\n"
    "  lrcs converge demo --azel 50,40 --plot demo.svg --csv demo.csv\n"
    "  lrcs converge examples/cylinder.toml --azel 0,30 --plot cylinder.png\n";

static const cli_option converge_options[] = {
    CLI_POSE_OPTIONS,           {"csv", CLI_FILE, 0}, {"plot", CLI_CHART, 1}, {"unit", 1, 0},
    {"material", 1, 1},         {"json", 0, 0},       {"seconds", 1, 0},      {"help", 0, 0},
    {"keep-transparent", 0, 0}, {NULL, 0, 0}};

/* ---- the measurement ---- */

static void stage_begin(const char *name, uint32_t done, uint32_t count)
{
    cli_watch_stage(name, NULL);
    if (count > 0) {
        cli_watch_count(done, count);
    } else {
        cli_watch_run();
    }
}

int cli_converge_read(converge_job *job)
{
    lrcs_host_error error;
    job->all.path = job->args->operand;
    job->all.stage = stage_begin;
    int status = lrcs_host_convergence_read(&job->all, &error);
    return cli_scene_code(job->args, &job->all.load, status, &error, &job->all.mesh[0].scene);
}

int cli_converge_measure(converge_job *job)
{
    lrcs_host_error error;
    job->all.progress = cli_watch_run();
    return lrcs_host_convergence_measure(&job->all, &error) == LRCS_OK ? 0 : cli_failed(&error);
}

/* ---- the command ---- */

/* Checks the errors against their bounds: an error above its bound is a fault of the engine. */
static int settings_check(const lrcs_host_convergence *all)
{
    int code = CLI_DONE;
    for (uint32_t i = 0; i < all->settings; i++) {
        const lrcs_host_convergence_setting *one = &all->setting[i];
        if (one->bound_m2 >= 0.0 && one->error_m2 > one->bound_m2 + all->truth.bound_m2) {
            return cli_fail("%s: the error, %.3g m2, exceeds its bound, %.3g m2", one->name,
                            one->error_m2, one->bound_m2);
        }
        if (one->flags & LRCS_FLAG_MEMORY_FALLBACK) {
            code = cli_degraded("%s: memory was short: it is coarser than its name", one->name);
        }
    }
    return code;
}

static int converge_report(const converge_job *job)
{
    const cli_args *args = job->args;
    int code = job->csv ? cli_text_write(job->csv, cli_converge_csv, job) : 0;
    if (code == 0 && job->csv) {
        code =
            cli_provenance_beside(args, job->csv, &lrcs_host_convergence_finest(&job->all)->scene,
                                  &job->all.pose, job->about);
    }
    code = code ? code : cli_charts_write(args, "plot", cli_converge_chart, job);
    cli_watch_end();
    if (code != 0) {
        return code;
    }
    if (cli_value(args, "json")) {
        cli_converge_json(job);
        return settings_check(&job->all);
    }
    cli_notices_print(stderr, &lrcs_host_convergence_finest(&job->all)->scene.notices);
    if (job->all.left_out[0]) {
        fprintf(stderr, "notice: %s\n", job->all.left_out);
    }
    if (job->all.busy[0]) {
        fprintf(stderr, "notice: %s\n", job->all.busy);
    }
    if (!job->csv || strcmp(job->csv, "-") != 0) {
        cli_converge_table(job);
    }
    return settings_check(&job->all);
}

static int converge_command(const cli_args *args)
{
    converge_job job;
    memset(&job, 0, sizeof job);
    job.args = args;
    job.title = args->operand;
    job.all.seconds = 20.0;
    job.csv = cli_value(args, "csv");
    int code = cli_pose_read(args, &job.all.pose);
    code = code ? code : cli_positive(args, "seconds", "a time > 0", &job.all.seconds);
    code = code ? code : cli_scene_options_read(args, &job.all.load);
    code = code ? code : cli_converge_read(&job);
    code = code ? code : cli_outputs_spare(args, &job.all.mesh[0].scene);
    code = code ? code : cli_converge_measure(&job);
    char *about = code == 0 ? cli_text_of(cli_converge_about, &job) : NULL;
    job.about = about;
    code = code ? code : converge_report(&job);
    free(about);
    lrcs_host_convergence_free(&job.all);
    cli_scene_options_free(&job.all.load);
    return code;
}

const cli_command cli_converge_command = {
    "converge",    "SCENE",          "give a .3ds, .obj or .stl model, a scene file, or demo",
    converge_help, converge_options, converge_command,
    NULL};
