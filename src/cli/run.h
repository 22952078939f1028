/* SPDX-License-Identifier: MIT */
/* A run between its command and its report. */
#ifndef LRCS_CLI_RUN_H
#define LRCS_CLI_RUN_H

#include "cli/cli.h"

/* All that a run is made of, and all that it makes. */
typedef struct run_job {
    const cli_args *args;
    lrcs_pose pose;
    lrcs_run_options options;
    lrcs_host_options load;
    const char *facets, *image_path;
    uint32_t image_size;
    lrcs_host_scene scene;
    lrcs_result result;
    lrcs_facet_record *records;
    lrcs_image image;
    double seconds;
    int met;
} run_job;

/* The options of output files, as 0 or CLI_USAGE; once the scene is read, that none of them would
   replace a file that it was read from, likewise; and their writing, as 0 or CLI_FAILED. */
int cli_run_outputs_read(run_job *job);
int cli_run_outputs_check(const run_job *job);
int cli_run_outputs_write(const run_job *job);

/* The result on stdout: as JSON with the contract's keys in the contract's order, or as a table
   for people. */
void cli_run_json(const run_job *job);
void cli_run_table(const run_job *job);

/* The notices on stderr, which go with the table. */
void cli_run_notices(const run_job *job);

#endif
