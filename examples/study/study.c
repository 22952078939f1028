/* SPDX-License-Identifier: MIT */
/* What sigma of simple bodies depends on, as tables, plots, and laws that the numbers of this run
   support or not: a program on the public headers. make study builds it and writes results/. */
#include "study.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* The slopes for which the laws of a glint's mean and order are meant, and exponents that the
   study's own lists surround. */
#define STUDY_SLOPE_LEAST 0.02
#define STUDY_SLOPE_MOST  0.5
#define STUDY_M_MOST      100.0

enum { STUDY_DONE = 0, STUDY_FAILED = 1, STUDY_USAGE = 2 };

static const char study_help[] =
    "usage: study [-o DIR] [--material A,B,s,m]\n"
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
    "  study\n"
    "  study -o results --material 2,0.1,0.1,1\n";

static int study_usage(const char *text, const char *found)
{
    fprintf(stderr, "study: %s'%s'; study --help shows the options\n", text, found);
    return STUDY_USAGE;
}

/* A material of the library, or A,B,s,m. */
static int material_read(const char *text, lrcs_brdf *brdf)
{
    const lrcs_brdf_entry *entry = lrcs_brdf_find(text);
    double v[4];
    const char *at = text;
    int count = 0;
    for (; !entry && count < 4; count++) {
        size_t size = strcspn(at, ",");
        if (lrcs_host_number_read(at, size, &v[count]) != LRCS_OK ||
            (at[size] == '\0') != (count == 3)) {
            return study_usage("--material: expected A,B,s,m or a library material, found ", text);
        }
        at += size + 1;
    }
    *brdf = entry ? entry->brdf : (lrcs_brdf){v[0], v[1], v[2], v[3]};
    if (lrcs_brdf_check(brdf) < 0 ||
        !(brdf->A > 0.0 && brdf->B > 0.0 && brdf->s >= STUDY_SLOPE_LEAST &&
          brdf->s <= STUDY_SLOPE_MOST && brdf->m <= STUDY_M_MOST)) {
        fprintf(stderr,
                "study: --material: expected A > 0, B > 0, s from %g to %g and m up to %g, found "
                "A = %g, B = %g, s = %g, m = %g\n",
                STUDY_SLOPE_LEAST, STUDY_SLOPE_MOST, STUDY_M_MOST, brdf->A, brdf->B, brdf->s,
                brdf->m);
        return STUDY_USAGE;
    }
    return STUDY_DONE;
}

/* A folder that is there already serves. */
static int folder_make(const char *folder)
{
    struct stat about;
    if (mkdir(folder, 0777) == 0 || (stat(folder, &about) == 0 && S_ISDIR(about.st_mode))) {
        return STUDY_DONE;
    }
    fprintf(stderr, "study: -o %s: cannot make the folder: %s\n", folder, strerror(errno));
    return STUDY_FAILED;
}

static int options_read(int argc, char **argv, study_job *job, const char **folder)
{
    int code = STUDY_DONE;
    for (int i = 1; i < argc && code == STUDY_DONE; i += 2) {
        int is_folder = strcmp(argv[i], "-o") == 0;
        if (!is_folder && strcmp(argv[i], "--material") != 0) {
            code = study_usage("expected -o or --material, found ", argv[i]);
        } else if (i + 1 == argc) {
            code = study_usage("expected a value after ", argv[i]);
        } else if (is_folder && strcmp(argv[i + 1], "-") == 0) {
            code = study_usage("-o: expected a folder, found ", "-");
        } else if (is_folder) {
            *folder = argv[i + 1];
        } else {
            code = material_read(argv[i + 1], &job->brdf);
        }
    }
    return code;
}

/* The steps: options; tables of sigma; laws judged from them; files; the summary. */
static int study_run(int argc, char **argv, study_job *job)
{
    const char *folder = NULL;
    job->brdf = lrcs_brdf_default();
    int code = options_read(argc, argv, job, &folder);
    if (code == STUDY_DONE && folder) {
        code = folder_make(folder);
    }
    if (code != STUDY_DONE) {
        return code;
    }
    study_attitude_tables(job);
    study_surface_tables(job);
    study_body_tables(job);
    study_surface_laws(job);
    study_shape_laws(job);
    study_engine_laws(job);
    if (job->status == LRCS_OK && folder) {
        job->status = study_write(job, folder, &job->error);
    }
    if (job->status != LRCS_OK) {
        fprintf(stderr, "study: %s\n", job->error.text);
        return STUDY_FAILED;
    }
    study_print(job);
    return study_held(job) == job->laws ? STUDY_DONE : STUDY_FAILED;
}

int main(int argc, char **argv)
{
    if (argc == 2 && strcmp(argv[1], "--help") == 0) {
        fputs(study_help, stdout);
        return STUDY_DONE;
    }
    study_job *job = calloc(1, sizeof *job);
    if (!job) {
        fputs("study: out of memory\n", stderr);
        return STUDY_FAILED;
    }
    int code = study_run(argc, argv, job);
    free(job);
    return fflush(stdout) == 0 ? code : STUDY_FAILED;
}
