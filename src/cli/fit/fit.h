/* SPDX-License-Identifier: MIT */
/* Shared by the files of lrcs fit: the materials and their fits. */
#ifndef LRCS_CLI_FIT_H
#define LRCS_CLI_FIT_H

#include "cli/cli.h"

/* One material: its readings, the fit, and the value of the fit for each reading. */
typedef struct fit_material {
    const char *name;
    lrcs_fit_reading *reading;
    uint32_t *line; /* line of each reading in the file */
    lrcs_fit_point *point;
    uint32_t count;
    int noise; /* lrcs_fit_noise */
    lrcs_fit fit;
} fit_material;

typedef struct fit_job {
    const cli_args *args;
    lrcs_fit_options options;
    int noise_asked; /* 1 if given; else the kind that suits the readings is chosen */
    double panel;    /* reflectance of the reference panel; 0 if readings are f_r itself */
    lrcs_host_readings readings;
    fit_material *material;
    uint32_t materials;
} fit_job;

/* The number of parameters, of four, that are not determined. */
int cli_fit_undetermined(const lrcs_fit *fit);

/* The reports: the table or JSON on stdout, CSV, and charts of the fit or of its residuals, which
   are written to a file: 0 or CLI_FAILED with the message printed. */
void cli_fit_table(const fit_job *job);
void cli_fit_json(const fit_job *job);
cli_text_writer cli_fit_csv; /* its context is the job */
int cli_fit_chart(const fit_job *job, int residuals, const char *path);

#endif
