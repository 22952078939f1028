/* SPDX-License-Identifier: MIT */
/* lrcs sweep --brightest: the peaks of a sweep, and what contributes to each. peaks.c decides which
   rows are peaks; here they are run once more, with the contribution of each facet, and printed. */
#include "cli/sweep/sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BRIGHTEST_MOST 1000.0
#define BRIGHTEST_ROWS ((uint64_t)1 << 28)
#define NAMED_MOST     3u   /* number of parts, materials or facets named in a line */
#define NAMED_ENOUGH   0.95 /* naming stops when the named ones make this share of sigma */
#define VALUE_WIDTH    12

int cli_brightest_read(const cli_args *args, const sweep_plan *plan, const sweep_file *file,
                       uint32_t *most)
{
    int code = cli_whole(args, "brightest", 1.0, BRIGHTEST_MOST, most);
    if (code != 0 || *most == 0) {
        return code;
    }
    if (!file->path) {
        return cli_usage(args->command,
                         "--brightest needs -o FILE: standard output is for its table");
    }
    if (cli_value(args, "shard")) {
        return cli_usage(args->command, "--brightest is of whole sweeps: not with --shard");
    }
    if (plan->rows > BRIGHTEST_ROWS) {
        return cli_usage(args->command, "--brightest: at most 2^28 rows, found %llu",
                         (unsigned long long)plan->rows);
    }
    return 0;
}

/* ---- one row once more ---- */

static int scene_shares(const lrcs_host_scene *base, const lrcs_host_scene *own,
                        const lrcs_pose *pose, const lrcs_run_options *options, cli_shares *shares)
{
    lrcs_host_error error;
    lrcs_result result;
    lrcs_facet_record *records = calloc((size_t)own->scene.facet_count + 1, sizeof *records);
    if (!records) {
        return cli_out_of_memory();
    }
    int status = lrcs_host_scene_run(own, pose, options, &result, records, NULL, NULL, &error);
    int code = status == LRCS_OK
                   ? cli_shares_make(base, &own->scene, records, result.sigma_m2, shares)
                   : cli_failed(&error);
    free(records);
    return code;
}

int cli_row_shares(const sweep_plan *plan, uint64_t row, lrcs_host_scene *base,
                   const lrcs_run_options *options, const lrcs_build_options *build,
                   cli_shares *shares)
{
    lrcs_host_error error;
    lrcs_host_scene own;
    lrcs_pose pose;
    memset(shares, 0, sizeof *shares);
    memset(&own, 0, sizeof own);
    int varied = plan->scene_axes > 0 || plan->track.joints > 0;
    int status = cli_plan_pose(plan, row, &pose);
    if (status != LRCS_OK) {
        snprintf(error.text, sizeof error.text, "%s", lrcs_status_text(status));
    } else if (varied) {
        status = cli_scene_of_row(plan, row, base, build, &own, &error);
    } else if (!base->prepared) {
        status = lrcs_host_scene_prepare(base, &error);
    }
    if (status != LRCS_OK) {
        return cli_failed(&error);
    }
    int code = scene_shares(base, varied ? &own : base, &pose, options, shares);
    if (varied) {
        lrcs_host_scene_free(&own);
    }
    return code;
}

/* ---- the table ---- */

static int column_width(const sweep_plan *plan, uint32_t column)
{
    int size = (int)strlen(plan->column[column]);
    return size > VALUE_WIDTH ? size : VALUE_WIDTH;
}

static void head_print(const sweep_plan *plan)
{
    printf("brightest attitudes: rows that outshine all their neighbours\n%4s %10s", "#", "index");
    for (uint32_t i = 0; i < plan->columns; i++) {
        printf(" ");
        int pad = column_width(plan, i) - (int)strlen(plan->column[i]);
        printf("%*s", pad, "");
        cli_column(plan->column[i], 0);
    }
    printf(" %12s %9s %9s %8s\n", "sigma m2", "dBsm", "bound m2", "glint");
}

static void numbers_print(const sweep_plan *plan, uint32_t rank, uint64_t row,
                          const double sigma[2], const cli_shares *shares)
{
    double value[SWEEP_COLUMNS];
    char bound[CLI_BOUND_SIZE];
    double glint = 0.0;
    cli_plan_values(plan, row, value);
    for (uint32_t i = 0; i < shares->parts; i++) {
        glint += shares->part[i].glint_m2;
    }
    printf("%4lu %10llu", (unsigned long)rank + 1, (unsigned long long)row);
    for (uint32_t i = 0; i < plan->columns; i++) {
        printf(" %*.9g", column_width(plan, i), value[i]);
    }
    cli_bound_text(sigma[1], 2, bound);
    printf(" %12.6g %9.3f %9s %6.1f %%\n", sigma[0], cli_dbsm(sigma[0]), bound,
           100.0 * cli_share_of(shares, glint));
}

/* The number of rows of a list that are named: until their share suffices, at most NAMED_MOST. */
static uint32_t rows_named(const cli_shares *shares, const shares_row *row, uint32_t count)
{
    double named_share = 0.0;
    uint32_t named = 0;
    while (named < count && named < NAMED_MOST && named_share < NAMED_ENOUGH &&
           row[named].sigma_m2 > 0.0) {
        named_share += cli_share_of(shares, row[named++].sigma_m2);
    }
    return named;
}

static void rows_print(const cli_shares *shares, const char *what, const shares_row *row,
                       uint32_t count, const char *nameless)
{
    uint32_t named = rows_named(shares, row, count);
    shares_row others = cli_shares_others(row, named, count);
    printf("     %-10s", what);
    for (uint32_t i = 0; i < named; i++) {
        printf("%s", i == 0 ? "" : ", ");
        cli_column(row[i].name[0] ? row[i].name : nameless, 0);
        printf(" %.1f %%", 100.0 * cli_share_of(shares, row[i].sigma_m2));
    }
    if (others.sigma_m2 > 0.0) {
        printf(", %lu other%s %.1f %%", (unsigned long)(count - named),
               count - named > 1 ? "s" : "", 100.0 * cli_share_of(shares, others.sigma_m2));
    }
    putchar('\n');
}

/* 1 if a facet of a coarse curved part glints along its own normal and makes most of sigma. */
static int is_facet_normal(const cli_shares *shares, const lrcs_host_glint *coarse, uint32_t count)
{
    const shares_facet *facet = &shares->facet[0];
    for (uint32_t i = 0; i < count && shares->facets > 0; i++) {
        if (facet->scene_part == coarse[i].part && facet->scene_material == coarse[i].material &&
            tan(facet->theta_deg / CLI_DEGREES) < coarse[i].s &&
            2.0 * facet->glint_m2 > facet->sigma_m2) {
            return 1;
        }
    }
    return 0;
}

static void facets_print(const cli_shares *shares)
{
    printf("     %-10s", "facets");
    for (uint32_t i = 0; i < shares->facets && i < NAMED_MOST; i++) {
        const shares_facet *facet = &shares->facet[i];
        printf("%s%lu of ", i == 0 ? "" : ", ", (unsigned long)facet->facet);
        cli_column(facet->part, 0);
        printf(" at %.2f deg %.1f %%", facet->theta_deg,
               100.0 * cli_share_of(shares, facet->sigma_m2));
    }
    putchar('\n');
}

int cli_brightest_print(const sweep_plan *plan, const double (*row)[2], uint32_t most,
                        lrcs_host_scene *base, const lrcs_run_options *options,
                        const lrcs_build_options *build, const lrcs_host_glint *coarse,
                        uint32_t coarse_count)
{
    uint64_t *peak = calloc(most, sizeof *peak);
    if (!peak) {
        return cli_out_of_memory();
    }
    uint32_t count = cli_peaks_find(plan, row, most, peak);
    int code = 0;
    head_print(plan);
    for (uint32_t i = 0; i < count && code == 0; i++) {
        cli_shares shares;
        code = cli_row_shares(plan, peak[i], base, options, build, &shares);
        if (code == 0) {
            numbers_print(plan, i, peak[i], row[peak[i]], &shares);
            rows_print(&shares, "parts", shares.part, shares.parts, "(no name)");
            rows_print(&shares, "materials", shares.material, shares.materials, "(default)");
            facets_print(&shares);
            if (is_facet_normal(&shares, coarse, coarse_count)) {
                printf("     note      the normal of a facet of a curved part: flat facets glint "
                       "here, "
                       "the body may not\n");
            }
        }
        cli_shares_free(&shares);
    }
    free(peak);
    return code;
}
