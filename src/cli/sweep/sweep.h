/* SPDX-License-Identifier: MIT */
/* Shared by the files of a sweep: its plan, its files, and what is shown of its rows. */
#ifndef LRCS_CLI_SWEEP_H
#define LRCS_CLI_SWEEP_H

#include "cli/shares.h"

#include <lrcs/distribution.h>
#include <lrcs/sweep.h>
#include <lrcs/sweep_chart.h>
#include <lrcs/sweep_file.h>

/* ---- the plan ---- */

/* The plan that options specify. 0, CLI_FAILED or CLI_USAGE with the message printed. The caller
   frees the plan in any case. */
int cli_plan_read(const cli_args *args, lrcs_host_plan *plan);

/* Checks that parts, materials and values fit the scene. 0 or CLI_USAGE. */
int cli_plan_check(const cli_args *args, const lrcs_host_plan *plan, const lrcs_host_scene *base);

/* Prints the message about a plan that failed with a status: CLI_FAILED or CLI_USAGE. */
int cli_plan_failed(const cli_command *command, int status, const lrcs_host_error *error);

/* --shard: the rows of this part, first .. end - 1; all without it. 0 or CLI_USAGE. */
int cli_shard_read(const cli_args *args, const lrcs_host_plan *plan, uint64_t *first,
                   uint64_t *end);

/* The first lines of the rows: the options that they depend on. 0 or CLI_USAGE. */
int cli_rows_head_make(const cli_args *args, const lrcs_host_plan *plan,
                       const lrcs_run_options *options, const lrcs_host_scene *scene, int coarse,
                       lrcs_host_rows_head *head);

/* -o and --json: where rows go; 0, CLI_FAILED or CLI_USAGE. The caller frees the output in any
   case. */
int cli_rows_output_read(const cli_args *args, lrcs_host_sweep_output *output);

/* ---- how large it is ---- */

/* Refuses a sweep whose rows cannot fit: on the disk of its file; or in memory, if plots,
   statistics or peaks need all of them (kept). 0 or CLI_FAILED. */
int cli_size_check(const cli_args *args, const lrcs_host_plan *plan,
                   const lrcs_host_sweep_output *file, int kept);

/* Prints a notice if a sweep that is not resumed will replace a file. */
void cli_replaced_print(const cli_args *args, const lrcs_host_sweep_output *file);

/* The pace of a sweep since a time and a row. */
typedef struct cli_pace {
    double begun; /* s */
    uint64_t first;
    int said, too_large;
} cli_pace;

/* Call after each row. Once, after two seconds, prints a notice if the sweep will take more than
   ten minutes or its file will be too large to be read back. Status: LRCS_OK; LRCS_E_LIMIT: it is
   to become a map, and will be too large for that. */
int cli_pace_take(cli_pace *pace, const lrcs_host_sweep_output *file, const cli_progress *progress,
                  lrcs_host_error *error);

/* ---- plots ---- */

/* Reads --dbsm, --polar and --projection and checks them, if plots are asked for (by --plot, or -o
   of lrcs plot), against the plan: 0 or CLI_USAGE; the caller sets the other members of the chart.
   Then draws one sweep, or the curves of several: 0 or CLI_FAILED. */
int cli_plot_read(const cli_args *args, const lrcs_host_plan *plan, lrcs_host_sweep_chart *plot);
int cli_plot_write(const cli_args *args, const lrcs_host_sweep_chart *plot, uint32_t count);

/* ---- peaks ---- */

/* The contributions to sigma of a row, which is run once more. `base` was read, and is prepared if
   necessary; the caller frees the shares in any case. 0 or CLI_FAILED. */
int cli_row_shares(const lrcs_host_plan *plan, uint64_t row, lrcs_host_scene *base,
                   const lrcs_run_options *options, const lrcs_build_options *build,
                   cli_shares *shares);

/* --brightest: reads the number of peaks, 0 if it was not given; 0 or CLI_USAGE. Then prints their
   table on stdout; 0 or CLI_FAILED. Peaks that are the normal of a facet of a coarse curved part
   are marked: flat facets glint there although the curved body need not. */
int cli_brightest_read(const cli_args *args, const lrcs_host_plan *plan,
                       const lrcs_host_sweep_output *file, uint32_t *most);
int cli_brightest_print(const lrcs_host_plan *plan, const double (*row)[2], uint32_t most,
                        lrcs_host_scene *base, const lrcs_run_options *options,
                        const lrcs_build_options *build, const lrcs_host_glint *coarse,
                        uint32_t coarse_count);

/* ---- statistics ---- */

/* --stats and --stats-file: whether statistics are asked for; checks the files' names. 0 or
   CLI_USAGE. */
int cli_stats_read(const cli_args *args, int *asked);

/* Computes the statistics from sigma and bound of every row, and the ends of its material band
   (NULL: none). Writes the table for people to `out`, if --stats is given, and every --stats-file.
   0 or CLI_FAILED. */
int cli_stats_write(const cli_args *args, FILE *out, const lrcs_host_plan *plan,
                    const lrcs_host_rows_head *head, const double (*row)[2],
                    const double (*band)[2]);

#endif
