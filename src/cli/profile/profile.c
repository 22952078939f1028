/* SPDX-License-Identifier: MIT */
/* lrcs profile: the distribution of sigma over range. This file reads the options, runs the profile
   and the pulse, and lists the rows; the core assigns sigma to bins. */
#include "cli/profile/profile.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Bins per pulse width from which its response is computed: the error is 1e-5 of the response. */
#define PULSE_BINS 256.0

/* A response is listed up to this many widths beyond the bins: there it is 3e-8 of its peak. */
#define PULSE_WIDTHS 2.5

static const char profile_help[] =
    "usage: lrcs profile SCENE [pose] --bin W [options]\n"
    "\n"
    "Computes the range profile of SCENE, a .3ds, .obj or .stl model, a scene file, or\n"
    "'demo': how much of sigma (m2) comes from which range, in bins along the line of sight,\n"
    "by exact visibility; each bin has its proved bound. The bins add up to sigma.\n"
    "Range (m) is 0 at the origin of the body frame and grows away from the laser. Bin k\n"
    "holds k W <= range < (k + 1) W. A face normal to the line of sight is in one bin; if it\n"
    "lies on an edge between bins, in the farther one.\n"
    "\n" CLI_POSE_HELP "\n"
    "options\n"
    "  --bin W               width of the bins, m\n"
    "  --pulse-fwhm W        adds the response to a Gaussian laser pulse: the density of sigma\n"
    "                        over range (m2/m) convolved with the pulse, at the centre of each\n"
    "                        bin, and its bound. W is the full width at half maximum in range,\n"
    "                        m; the light path is twice as long: a pulse of 1 ns is 0.15 m\n"
    "  --json                everything as JSON, one line for each bin\n"
    "  --csv FILE.csv        one row for each bin ('-': on standard output, instead of the\n"
    "                        table)\n"
    "  --plot FILE           a chart, FILE.svg or FILE.png: density over range, and the\n"
    "                        response to the pulse; repeatable\n"
    "  --tolerance REL       relative error for which shapes are tessellated (default 1e-4). If\n"
    "                        it is given: exit 3 if the bound of all bins together, or the\n"
    "                        estimated error of curved normals, exceeds it\n"
    "  --normals N           flat (default); smooth: curved normals, from smoothing groups and\n"
    "                        vertex normals; auto: curved only where flat facets are too coarse\n"
    "                        for their glint. Ranges are those of the facets in any "
    "case\n" CLI_SCENE_HELP "\n"
    "examples\n"
    "  lrcs profile demo --azel 50,40 --bin 0.1\n"
    "  lrcs profile demo --azel 50,40 --bin 0.05 --pulse-fwhm 0.3 --plot profile.svg\n"
    "  lrcs profile aura.3ds --unit in --azel 30,20 --bin 0.02 --csv profile.csv\n";

static const cli_option profile_options[] = {
    CLI_POSE_OPTIONS,       CLI_SCENE_OPTIONS,   {"bin", 1, 0},
    {"pulse-fwhm", 1, 0},   {"json", 0, 0},      {"csv", CLI_FILE, 0},
    {"plot", CLI_CHART, 1}, {"tolerance", 1, 0}, {"normals", 1, 0},
    {"help", 0, 0},         {NULL, 0, 0}};

double cli_profile_sigma(const lrcs_profile_bin *bin)
{
    return bin->sigma_glint_m2 + bin->sigma_diffuse_m2;
}

/* ---- options ---- */

static int profile_options_read(profile_job *job)
{
    const cli_args *args = job->args;
    lrcs_run_options options = lrcs_run_options_default();
    job->csv = cli_value(args, "csv");
    int code = cli_pose_read(args, &job->pose);
    code = code ? code : cli_positive(args, "bin", "a length in m without unit, > 0", &job->bin_m);
    if (code == 0 && !(job->bin_m > 0.0)) {
        return cli_usage(args->command, "give the width of the bins: --bin W, m");
    }
    code = code ? code
                : cli_positive(args, "pulse-fwhm", "a length in m without unit, > 0", &job->fwhm_m);
    code = code ? code : cli_accuracy_read(args, &options);
    code = code ? code : cli_scene_options_read(args, &job->load);
    code = code ? code : cli_normals_read(args, &job->load);
    job->load.build.tolerance = options.tolerance;
    job->load.build.facets_only = LRCS_FACETS_LOCAL;
    job->asked = cli_value(args, "tolerance") ? options.tolerance : 0.0;
    return code;
}

/* ---- the run ---- */

/* Computes the responses at the centres of all rows, from a profile with finer bins. */
static int pulse_run(profile_job *job)
{
    const lrcs_profile *coarse = &job->profile.list;
    lrcs_host_error error = {""};
    lrcs_host_profile own = {{0}, NULL};
    const lrcs_profile *fine = coarse;
    double parts = ceil(job->bin_m * PULSE_BINS / job->fwhm_m);
    double most = floor(LRCS_PROFILE_BINS / (2.0 * coarse->count + 4.0));
    parts = fmin(parts, fmax(most, 1.0));
    int status = LRCS_OK;
    if (parts > 1.0) {
        status = lrcs_host_profile_make(&job->scene, &job->pose, job->bin_m / parts, &own, &error);
        fine = &own.list;
    }
    for (uint32_t i = 0; i < job->rows && status == LRCS_OK; i++) {
        profile_row *row = &job->row[i];
        status = lrcs_profile_pulse(fine, job->fwhm_m, 0.5 * row->near_m + 0.5 * row->far_m,
                                    &row->pulse_m, &row->pulse_bound_m, &row->pulse_estimate_m);
    }
    if (status != LRCS_OK && error.text[0] == '\0') {
        snprintf(error.text, sizeof error.text, "pulse of %g m: %s", job->fwhm_m,
                 lrcs_status_text(status));
    }
    lrcs_host_profile_free(&own);
    return status == LRCS_OK ? 0 : cli_failed(&error);
}

/* Lists the bins, and the rows beyond them that a pulse reaches. */
static int rows_list(profile_job *job)
{
    const lrcs_profile *p = &job->profile.list;
    double more = ceil(PULSE_WIDTHS * job->fwhm_m / job->bin_m);
    if (p->count + 2.0 * more > LRCS_PROFILE_BINS) {
        return cli_fail(
            "a pulse of %g m reaches over more bins of %g m than the %lu that a profile "
            "may have",
            job->fwhm_m, job->bin_m, (unsigned long)LRCS_PROFILE_BINS);
    }
    uint32_t beyond = p->count > 0 ? (uint32_t)more : 0;
    job->rows = p->count + 2 * beyond;
    job->row = calloc((size_t)job->rows + 1, sizeof *job->row);
    if (!job->row) {
        return cli_out_of_memory();
    }
    for (uint32_t i = 0; i < job->rows; i++) {
        profile_row *row = &job->row[i];
        double k = (double)(p->first - beyond + i);
        row->near_m = k * job->bin_m;
        row->far_m = (k + 1.0) * job->bin_m;
        if (i >= beyond && i - beyond < p->count) {
            row->bin = p->bin[i - beyond];
        }
    }
    return job->fwhm_m > 0.0 ? pulse_run(job) : 0;
}

/* ---- the command ---- */

static int profile_command(const cli_args *args)
{
    lrcs_host_error error;
    profile_job job;
    memset(&job, 0, sizeof job);
    job.args = args;
    int code = profile_options_read(&job);
    cli_watch_stage("loading", NULL);
    code = code ? code : cli_scene_read(args, &job.load, &job.scene);
    code = code ? code : cli_outputs_spare(args, &job.scene);
    if (code == 0) {
        job.title = cli_scene_title(args, &job.scene);
        job.materials_assumed = cli_materials_assumed(&job.scene.scene);
    }
    cli_watch_stage("preparing", &job.scene);
    code = code ? code : cli_scene_prepare(&job.scene);
    cli_watch_stage("range profile", NULL);
    if (code == 0 &&
        lrcs_host_profile_make(&job.scene, &job.pose, job.bin_m, &job.profile, &error) != LRCS_OK) {
        code = cli_failed(&error);
    }
    const lrcs_profile *p = &job.profile.list;
    job.met = fmax(p->bound_m2, p->curvature_estimate_m2) <=
              job.asked * (p->sigma_glint_m2 + p->sigma_diffuse_m2);
    code = code ? code : rows_list(&job);
    cli_watch_end();
    char *about = code == 0 ? cli_text_of(cli_profile_about, &job) : NULL;
    job.about = about;
    code = code == 0 && job.csv ? cli_text_write(job.csv, cli_profile_csv, &job) : code;
    code = code ? code : cli_charts_write(args, "plot", cli_profile_chart, &job);
    if (code == 0 && cli_value(args, "json")) {
        cli_profile_json(&job);
    } else if (code == 0) {
        cli_notices_print(stderr, &job.scene.notices);
        if (!job.csv || strcmp(job.csv, "-") != 0) {
            cli_profile_table(&job);
        }
    }
    if (code == 0 && job.asked > 0.0 && !job.met) {
        code = cli_degraded("the tolerance %g is missed", job.asked);
    }
    free(about);
    free(job.row);
    lrcs_host_profile_free(&job.profile);
    lrcs_host_scene_free(&job.scene);
    cli_scene_options_free(&job.load);
    return code;
}

const cli_command cli_profile_command = {
    "profile",    "SCENE",         "give a .3ds, .obj or .stl model, a scene file, or demo",
    profile_help, profile_options, profile_command,
    NULL};
