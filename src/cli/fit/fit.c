/* SPDX-License-Identifier: MIT */
/* lrcs fit: fits a material to measured BRDF against angle. */
#include "cli/fit/fit.h"

#include <stdlib.h>
#include <string.h>

static const char fit_help[] =
    "usage: lrcs fit DATA.csv [options]\n"
    "\n"
    "Fits A, B, s, m of the four-parameter BRDF\n"
    "  f_r(theta) = A / cos^6(theta) exp(-tan^2(theta) / s^2) + B cos^m(theta)      1/sr\n"
    "(Steinvall 2000; Han et al. 2014, Eq. 1) to readings in monostatic geometry: laser and\n"
    "detector both at the angle theta from the normal. The fit is robust: outliers are\n"
    "excluded and listed.\n"
    "\n"
    "DATA.csv has one reading on each line, separated by commas, semicolons, tabs or blanks;\n"
    "'#' begins a comment. The first line names the columns, in any order: angle_deg (-90 ..\n"
    "90; the sign has no effect), brdf (or reading, or value), and optionally sigma (standard\n"
    "error, in the unit of brdf), weight (proportional to 1/sigma^2) and material (or sample;\n"
    "each is fitted by itself). Without names: angle, brdf and optionally sigma.\n"
    "\n"
    "options\n"
    "  --panel RHO           brdf is relative to a Lambert panel of reflectance RHO, read at\n"
    "                        the same angle: f_r = value RHO / pi (without: brdf is f_r, 1/sr)\n"
    "  --cosine              the readings are f_r cos(theta): they fall with the projected area\n"
    "                        too\n"
    "  --noise KIND          if there is no sigma: errors are absolute (the same for all),\n"
    "                        relative (in proportion to what is measured), or auto (default):\n"
    "                        whichever the residuals make likelier\n"
    "  --name NAME           of several materials the one to fit; of one, its name (default:\n"
    "                        that of the file)\n"
    "  --plot FILE           a chart of readings and fit, FILE.svg or FILE.png; repeatable\n"
    "  --residuals FILE      a chart of residuals against angle, FILE.svg or FILE.png;\n"
    "                        repeatable\n"
    "  --csv FILE.csv        every reading with fit and residual ('-': on standard output,\n"
    "                        instead of the table); FILE.csv.json states what it was made from\n"
    "  --json                the table as JSON\n"
    "\n"
    "The limits are 95 % confidence limits: beyond them, even the best fit of the other three\n"
    "parameters is significantly worse. A glint or a diffuse term that may be due to noise\n"
    "alone is left out: its A or B is then 0, with an upper limit. What the readings do not\n"
    "determine is stated in words.\n"
    "Exit: 0 all four parameters are determined, 3 some are not.\n"
    "\n"
    "examples\n"
    "  lrcs fit gold.csv --plot gold.svg --residuals gold-residuals.svg\n"
    "  lrcs fit panels.csv --panel 0.99 --noise absolute --name white --json\n";

static const cli_option fit_options[] = {{"panel", 1, 0},        {"cosine", 0, 0},
                                         {"noise", 1, 0},        {"name", 1, 0},
                                         {"plot", CLI_CHART, 1}, {"residuals", CLI_CHART, 1},
                                         {"csv", CLI_FILE, 0},   {"json", 0, 0},
                                         {"help", 0, 0},         {NULL, 0, 0}};

/* ---- options ---- */

static int is_chart(const cli_given *given)
{
    return strcmp(given->name, "plot") == 0 || strcmp(given->name, "residuals") == 0;
}

static int fit_read(fit_job *job)
{
    const cli_args *args = job->args;
    int noise = LRCS_FIT_RELATIVE + 1;
    job->options = lrcs_fit_options_default();
    job->options.cosine = cli_value(args, "cosine") != NULL;
    int code = cli_choice(args, "noise", "absolute, relative or auto", &noise);
    if (noise <= LRCS_FIT_RELATIVE) {
        job->noise_asked = 1;
        job->options.noise = noise;
    }
    code = code ? code : cli_number(args, "panel", &job->panel);
    if (code == 0 && cli_value(args, "panel")) {
        if (!(job->panel > 0.0 && job->panel <= 1.5)) {
            return cli_expected(args, "panel", "a reflectance 0 < RHO <= 1.5");
        }
        job->options.unit = job->panel / LRCS_PI;
    }
    return code ? code : cli_outputs_spare_input(args, args->operand, "the readings");
}

/* ---- materials ---- */

/* Gives readings without a material the name asked for, or that of the file without its folders and
   extension. */
static int material_name(fit_job *job)
{
    lrcs_host_readings *readings = &job->readings;
    const char *asked = cli_value(job->args, "name");
    const char *name = asked ? asked : cli_base_name(job->args->operand);
    const char *dot = asked ? NULL : strrchr(name, '.');
    if (readings->name_count != 1 || readings->name[0][0] != '\0') {
        return 0;
    }
    char *own = strndup(name, dot && dot != name ? (size_t)(dot - name) : strlen(name));
    if (!own) {
        return cli_out_of_memory();
    }
    free(readings->name[0]);
    readings->name[0] = own;
    return 0;
}

/* Fits with the errors that are known or asked for, else with the likelier ones. */
static int material_fit(const fit_job *job, fit_material *material)
{
    size_t size = lrcs_fit_need(material->count);
    void *bytes = malloc(size);
    if (!bytes) {
        return cli_out_of_memory();
    }
    lrcs_work work = lrcs_work_make(bytes, size);
    material->noise = job->options.noise;
    int status = job->noise_asked ? lrcs_fit_run(material->reading, material->count, &job->options,
                                                 &work, &material->fit, material->point)
                                  : lrcs_fit_run_likelier(material->reading, material->count,
                                                          &job->options, &work, &material->noise,
                                                          &material->fit, material->point);
    free(bytes);
    if (status == LRCS_E_EMPTY && material->count < LRCS_FIT_READINGS) {
        return cli_fail("%s: %s: found %lu readings, expected %u or more", job->args->operand,
                        material->name, (unsigned long)material->count, LRCS_FIT_READINGS);
    }
    if (status != LRCS_OK) {
        return cli_fail("%s: %s: %s", job->args->operand, material->name,
                        status == LRCS_E_EMPTY ? "no reading is above 0"
                                               : lrcs_status_text(status));
    }
    return 0;
}

/* The materials asked for, each with its readings and its fit. */
static int materials_make(fit_job *job)
{
    const lrcs_host_readings *readings = &job->readings;
    const char *asked = cli_value(job->args, "name");
    const char *best = NULL;
    int code = material_name(job);
    job->material = calloc(readings->name_count, sizeof *job->material);
    if (code == 0 && !job->material) {
        return cli_out_of_memory();
    }
    for (uint32_t i = 0; i < readings->name_count && code == 0; i++) {
        best = asked ? lrcs_host_name_nearer(asked, best, readings->name[i]) : NULL;
        if (!asked || strcmp(asked, readings->name[i]) == 0) {
            fit_material *material = &job->material[job->materials++];
            material->name = readings->name[i];
            material->reading = malloc(readings->count * sizeof *material->reading);
            material->line = malloc(readings->count * sizeof *material->line);
            material->point = malloc(readings->count * sizeof *material->point);
            if (!material->reading || !material->line || !material->point) {
                return cli_out_of_memory();
            }
            for (uint32_t k = 0; k < readings->count; k++) {
                if (readings->reading[k].material == i) {
                    material->reading[material->count] = readings->reading[k].fit;
                    material->line[material->count++] = readings->reading[k].line;
                }
            }
            cli_watch_stage(material->name[0] ? material->name : "fit", NULL);
            code = material_fit(job, material);
        }
    }
    if (code == 0 && job->materials == 0) {
        char list[200] = "";
        for (uint32_t i = 0; i < readings->name_count; i++) {
            lrcs_host_append(list, sizeof list, "%s'%s'", i > 0 ? ", " : "", readings->name[i]);
        }
        int near = best && lrcs_host_name_is_near(asked, best);
        return cli_usage(job->args->command, "--name: no reading is of '%s'; %s%s%s", asked,
                         near ? "the nearest is '" : "there are readings of ", near ? best : list,
                         near ? "'" : "");
    }
    return code;
}

/* Checks the content of the file against the options. */
static int readings_check(fit_job *job)
{
    const cli_args *args = job->args;
    int given = job->readings.noise != LRCS_FIT_ABSOLUTE;
    if (given && cli_value(args, "noise")) {
        return cli_usage(args->command, "--noise: the readings have errors of their own");
    }
    if (given) {
        job->options.noise = job->readings.noise;
        job->noise_asked = 1;
    }
    for (int i = 0; i < args->given_count; i++) {
        if (is_chart(&args->given[i]) && job->readings.name_count > 1 && !cli_value(args, "name")) {
            return cli_usage(args->command,
                             "--%s: the readings are of %lu materials; choose one with --name",
                             args->given[i].name, (unsigned long)job->readings.name_count);
        }
    }
    return 0;
}

/* ---- the command ---- */

static int fit_report(const fit_job *job)
{
    cli_watch_end();
    const cli_args *args = job->args;
    const char *csv = cli_value(args, "csv");
    int code = CLI_DONE;
    int failed = csv ? cli_text_write(csv, cli_fit_csv, job) : 0;
    for (int i = 0; i < args->given_count && !failed; i++) {
        const cli_given *given = &args->given[i];
        if (is_chart(given)) {
            failed = cli_fit_chart(job, strcmp(given->name, "residuals") == 0, given->value);
        }
    }
    if (failed == 0 && csv) {
        failed = cli_provenance_beside(args, csv, NULL, NULL, NULL);
    }
    if (failed) {
        return failed;
    }
    cli_notices_print(stderr, &job->readings.notices);
    for (uint32_t i = 0; i < job->materials; i++) {
        cli_brdf_warnings_print(job->material[i].name, &job->material[i].fit.brdf);
        int open = cli_fit_undetermined(&job->material[i].fit);
        code = open > 0 ? cli_degraded("%s: the readings leave %d of four parameters undetermined",
                                       job->material[i].name, open)
                        : code;
    }
    if (cli_value(args, "json")) {
        cli_fit_json(job);
    } else if (!csv || strcmp(csv, "-") != 0) {
        cli_fit_table(job);
    }
    return code;
}

static int fit_command(const cli_args *args)
{
    lrcs_host_error error;
    fit_job job;
    memset(&job, 0, sizeof job);
    job.args = args;
    int code = fit_read(&job);
    if (code == 0 && lrcs_host_readings_read(args->operand, &job.readings, &error) != LRCS_OK) {
        code = cli_failed(&error);
    }
    code = code ? code : readings_check(&job);
    code = code ? code : materials_make(&job);
    code = code ? code : fit_report(&job);
    for (uint32_t i = 0; i < job.materials; i++) {
        free(job.material[i].reading);
        free(job.material[i].line);
        free(job.material[i].point);
    }
    free(job.material);
    lrcs_host_readings_free(&job.readings);
    return code;
}

const cli_command cli_fit_command = {
    "fit",    "DATA.csv",  "give a table of angles (deg) and BRDF readings",
    fit_help, fit_options, fit_command,
    NULL};
