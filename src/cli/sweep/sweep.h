/* SPDX-License-Identifier: MIT */
/* Shared by the files of a sweep: its plan, its files, and what is shown of its rows. */
#ifndef LRCS_CLI_SWEEP_H
#define LRCS_CLI_SWEEP_H

#include "cli/shares.h"

#include <lrcs/distribution.h>
#include <lrcs/sweep.h>
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
int cli_head_make(const cli_args *args, const lrcs_host_plan *plan, const lrcs_run_options *options,
                  const lrcs_host_scene *scene, int coarse, lrcs_host_rows_head *head);

/* -o and --json: where rows go; 0, CLI_FAILED or CLI_USAGE. The caller frees the output in any
   case. */
int cli_rows_output_read(const cli_args *args, lrcs_host_sweep_output *output);

/* ---- plots ---- */

/* One of the quantities that vary. */
typedef struct plot_axis {
    uint32_t column; /* column of the plan; the one after its axes is the time of a track */
    uint64_t count;
    const char *name;
} plot_axis;

/* What is drawn of a sweep: curves along x, one for each value of y, or a map. */
typedef struct sweep_plot {
    const char *option; /* the option that names the files: "plot", "o" */
    int asked, dbsm, polar, map, mollweide;
    int open; /* 1 if materials are illustrative or assumed: no bound includes their error */
    const char *accept;              /* as --accept, or NULL */
    const char *title;               /* the scene's, or the name of its file */
    const lrcs_host_rows_head *head; /* what it was made from; NULL: not stated */
    const char *name;                /* in the legend, of all curves, or NULL */
    plot_axis x, y;                  /* y: a single value if only one quantity varies */
    int swapped;                     /* 1 if x is the faster of two axes */
    const lrcs_host_plan *plan;
    double (*row)[2];  /* sigma and bound, m2 */
    double (*band)[2]; /* the interval of its material uncertainty, m2; NULL if none */
} sweep_plot;

#define PLOT_CURVES 7u /* more values than this along both axes make a map */

/* Reads --plot (or -o of lrcs plot), --dbsm, --polar and --projection, and checks that no plot
   replaces a file; 0 or CLI_USAGE. Then draws one sweep, or the curves of several along the same
   axis; 0 or CLI_FAILED. Also one drawing as SVG. The caller sets title and row. */
int cli_plot_read(const cli_args *args, const lrcs_host_plan *plan, sweep_plot *plot);
uint32_t
cli_plot_choose(sweep_plot *plot); /* x and y, by plan, polar and mollweide; how many vary */
int cli_plot_write(const cli_args *args, const sweep_plot *plot, uint32_t count);
int cli_plot_svg(FILE *out, const sweep_plot *plot);

/* The material uncertainty of a sweep that has bands: the median and the largest half width of its
   band relative to sigma, over the rows with sigma > 0 (0 if there is none). 0 or CLI_FAILED. */
int cli_plot_uncertainty(const sweep_plot *plot, double part[2]);

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
