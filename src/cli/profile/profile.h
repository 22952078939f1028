/* SPDX-License-Identifier: MIT */
/* Shared by the files of lrcs profile: the profile and its outputs. */
#ifndef LRCS_CLI_PROFILE_H
#define LRCS_CLI_PROFILE_H

#include "cli/cli.h"

/* A row of the tables: a bin, or the response of a pulse beyond all bins. */
typedef struct profile_row {
    double near_m, far_m; /* the bin's edges */
    lrcs_profile_bin bin;
    double pulse_m, pulse_bound_m; /* response at the bin's centre, m^2/m */
    double pulse_estimate_m;       /* estimated error of curved normals, in no bound */
} profile_row;

typedef struct profile_job {
    const cli_args *args;
    lrcs_pose pose;
    lrcs_host_options load;
    double bin_m, fwhm_m; /* fwhm_m is 0 if there is no pulse */
    double asked;         /* tolerance; 0 for none */
    int met;
    const char *csv;
    const char *about;     /* in the chart: what it was made from */
    const char *title;     /* the scene's, or the name of its file */
    int materials_assumed; /* 1 if some are illustrative or assumed: bounds exclude their error */
    lrcs_host_scene scene;
    lrcs_host_profile profile;
    profile_row *row;
    uint32_t rows;
} profile_job;

/* The sum of both terms of the BRDF. */
double cli_profile_sigma(const lrcs_profile_bin *bin);

/* The tables on stdout, and CSV and chart as files. */
void cli_profile_table(const profile_job *job);
void cli_profile_json(const profile_job *job);
cli_text_writer cli_profile_csv; /* its context is the job */

/* What it was made from: the first line of the table without "# ". The context is the job. */
cli_text_writer cli_profile_about;

/* The chart, from the title, about, rows, sigma of the list, bin_m and fwhm_m. The
   context is the job. */
cli_chart_writer cli_profile_chart;

#endif
