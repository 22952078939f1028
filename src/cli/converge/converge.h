/* SPDX-License-Identifier: MIT */
/* Shared by the files of lrcs converge, and those of lrcs report and lrcs plot that show the same.
 */
#ifndef LRCS_CLI_CONVERGE_H
#define LRCS_CLI_CONVERGE_H

#include "cli/cli.h"

#include <lrcs/convergence.h>

typedef struct converge_job {
    const cli_args *args;
    const char *title; /* the name of the scene's file */
    const char *about; /* in the chart: what it was made from */
    const char *csv;
    lrcs_host_convergence all;
} converge_job;

/* Reads the scene with every mesh, and measures, by lrcs/convergence.h: 0, or an exit code with the
   message printed. */
int cli_converge_read(converge_job *job);
int cli_converge_measure(converge_job *job);

/* The sentence that summarizes the comparison. */
typedef struct converge_sentence {
    char text[960];
} converge_sentence;
converge_sentence cli_converge_sentence(const lrcs_host_convergence *all);

/* The reports: the table or JSON on stdout, both with the summary sentence; CSV; a chart. */
void cli_converge_table(const converge_job *job);
void cli_converge_json(const converge_job *job);
cli_text_writer cli_converge_csv; /* its context is the job */

/* What it was made from: the first line of the table without "# ". The context is the job. */
cli_text_writer cli_converge_about;

/* The chart, from the title, about, the pose's direction, the truth, the settings and the digits of
   their meshes. The context is the job. */
cli_chart_writer cli_converge_chart;

#endif
