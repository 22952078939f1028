/* SPDX-License-Identifier: MIT */
/* lrcs study: what sigma of simple bodies depends on, as tables, plots, and laws that the numbers
   of this run support or not. */
#include "cli/study.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* The slopes for which the laws of a glint's mean and order are meant, and exponents that the
   study's own lists surround. */
#define STUDY_SLOPE_LEAST 0.02
#define STUDY_SLOPE_MOST  0.5
#define STUDY_M_MOST      100.0

static const char study_help[] =
    "usage: lrcs study [-o DIR] [--material A,B,s,m]\n"
    "\n"
    "What sigma of simple bodies depends on, after Han et al., Opt. Laser Technol. 56 (2014) "
    "151-157:\n"
    "cube, cylinder and cone (disc and sphere beside them), purely diffuse, purely specular and "
    "mixed;\n"
    "attitude, shape at equal surface and at equal projected area, size, and A, B, s, m. Prints "
    "general\n"
    "laws, each with the comparison that came closest to its limits and the bound on it: a law "
    "that\n"
    "the numbers of this run do not support says so.\n"
    "\n"
    "options\n"
    "  -o DIR              writes DIR/study.md (text, tables, plots, laws) with a table\n"
    "                      (STEM.csv) and a plot (STEM.svg) for each figure; makes DIR. The last\n"
    "                      column of a table is the largest bound of its row.\n"
    "  --material A,B,s,m  of the mixed surface, or a library material (1,0.25,0.2,0.5); A, B > "
    "0,\n"
    "                      s 0.02 .. 0.5, m <= 100. Some laws hold for a range of materials only.\n"
    "\n"
    "Units: sigma in m2 or dBsm, lengths in m, angles in deg, A and B in 1/sr.\n"
    "Exit: 0 all laws hold, 1 some do not, or a file could not be written.\n"
    "\n"
    "examples\n"
    "  lrcs study\n"
    "  lrcs study -o study --material 2,0.1,0.1,1\n";

static const cli_option study_options[] = {
    {"o", 1, 0}, {"material", 1, 0}, {"help", 0, 0}, {NULL, 0, 0}};

static int material_read(const cli_args *args, lrcs_brdf *brdf)
{
    const char *text = cli_value(args, "material");
    *brdf = lrcs_brdf_default();
    if (!text) {
        return 0;
    }
    int code = cli_brdf_read(args->command, text, "--material", brdf);
    if (code == 0 && !(brdf->A > 0.0 && brdf->B > 0.0 && brdf->s >= STUDY_SLOPE_LEAST &&
                       brdf->s <= STUDY_SLOPE_MOST && brdf->m <= STUDY_M_MOST)) {
        return cli_usage(args->command,
                         "--material: expected A > 0, B > 0, s from %g to %g and m up to %g, found "
                         "A = %g, B = %g, s = %g, m = %g",
                         STUDY_SLOPE_LEAST, STUDY_SLOPE_MOST, STUDY_M_MOST, brdf->A, brdf->B,
                         brdf->s, brdf->m);
    }
    return code;
}

/* A folder that is there already serves. */
static int folder_make(const char *folder)
{
    struct stat about;
    if (mkdir(folder, 0777) == 0 || (stat(folder, &about) == 0 && S_ISDIR(about.st_mode))) {
        return 0;
    }
    fprintf(stderr, "lrcs: -o %s: cannot make the folder: %s\n", folder, strerror(errno));
    return CLI_FAILED;
}

static int study_run(const cli_args *args, study_job *job)
{
    const char *folder = cli_value(args, "o");
    int code = material_read(args, &job->brdf);
    if (code == 0 && folder && strcmp(folder, "-") == 0) {
        code = cli_usage(args->command, "-o: expected a folder, found '-'");
    }
    if (code == 0 && folder) {
        code = folder_make(folder);
    }
    if (code != 0) {
        return code;
    }
    cli_study_attitude_tables(job);
    cli_study_surface_tables(job);
    cli_study_body_tables(job);
    cli_study_surface_laws(job);
    cli_study_shape_laws(job);
    cli_study_engine_laws(job);
    if (job->status != LRCS_OK) {
        return cli_failed(&job->error);
    }
    code = folder ? cli_study_write(job, folder) : 0;
    if (code == 0) {
        cli_study_print(job);
        code = cli_study_held(job) == job->laws ? CLI_DONE : CLI_FAILED;
    }
    return code;
}

static int study_command(const cli_args *args)
{
    study_job *job = calloc(1, sizeof *job);
    if (!job) {
        return cli_out_of_memory();
    }
    int code = study_run(args, job);
    free(job);
    return code;
}

const cli_command cli_study_command = {"study",    NULL,          NULL,
                                       study_help, study_options, study_command};
