/* SPDX-License-Identifier: MIT */
/* lrcs sweep --brightest: the peaks of a sweep (lrcs_host_plan_peaks), which are run once more,
   with the contribution of each facet, and printed. */
#include "cli/sweep/sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BRIGHTEST_MOST 1000.0              /* lines of a table for people */
#define BRIGHTEST_ROWS ((uint64_t)1 << 28) /* sigma and bound of these take 4 GiB */
#define NAMED_MOST     3u                  /* facets named in a line */
#define VALUE_WIDTH    12

/* ---- options ---- */

int cli_brightest_read(const cli_args *args, const lrcs_host_plan *plan,
                       const lrcs_host_sweep_output *file, uint32_t *most)
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
        return cli_usage(args->command, "--brightest needs the whole sweep: leave out --shard");
    }
    if (plan->rows > BRIGHTEST_ROWS) {
        return cli_usage(args->command, "--brightest: at most 2^28 rows, found %llu",
                         (unsigned long long)plan->rows);
    }
    return 0;
}

/* ---- one row once more ---- */

int cli_row_shares(const lrcs_host_plan *plan, uint64_t row, lrcs_host_scene *base,
                   const lrcs_run_options *options, const lrcs_build_options *build,
                   cli_shares *shares)
{
    lrcs_host_error error;
    lrcs_host_scene own;
    lrcs_pose pose;
    lrcs_result result;
    memset(shares, 0, sizeof *shares);
    memset(&own, 0, sizeof own);
    int varied = lrcs_host_plan_varies_scene(plan);
    int status = lrcs_host_plan_pose(plan, row, &pose);
    if (status != LRCS_OK) {
        snprintf(error.text, sizeof error.text, "%s", lrcs_status_text(status));
    } else if (varied) {
        status = lrcs_host_plan_scene(plan, row, base, build, &own, &error);
    } else if (!base->prepared) {
        status = lrcs_host_scene_prepare(base, &error);
    }
    if (status != LRCS_OK) {
        return cli_failed(&error);
    }
    const lrcs_host_scene *scene = varied ? &own : base;
    lrcs_facet_record *records = calloc((size_t)scene->scene.facet_count + 1, sizeof *records);
    int code = records ? 0 : cli_out_of_memory();
    if (code == 0) {
        code = cli_scene_run(scene, &pose, options, &result, records, NULL, NULL);
        code = code ? code : cli_shares_make(base, &scene->scene, records, result.sigma_m2, shares);
    }
    free(records);
    if (varied) {
        lrcs_host_scene_free(&own);
    }
    return code;
}

/* ---- the table ---- */

static int column_width(const lrcs_host_plan *plan, uint32_t column)
{
    int size = (int)strlen(plan->column[column]);
    return size > VALUE_WIDTH ? size : VALUE_WIDTH;
}

static void peak_numbers_print(const lrcs_host_plan *plan, uint32_t rank, uint64_t row,
                               const double sigma[2], const cli_shares *shares)
{
    double value[LRCS_HOST_PLAN_COLUMNS];
    char bound[LRCS_HOST_BOUND_SIZE];
    lrcs_host_plan_values(plan, row, value);
    printf("%4lu %10llu", (unsigned long)rank + 1, (unsigned long long)row);
    for (uint32_t i = 0; i < plan->columns; i++) {
        printf(" %*.9g", column_width(plan, i), value[i]);
    }
    lrcs_host_bound_text(sigma[1], 2, bound);
    printf(" %12.6g %9.3f %9s %6.1f %%\n", sigma[0], cli_dbsm(sigma[0]), bound,
           100.0 * cli_share_of(shares, cli_shares_glint(shares)));
}

/* Names the first rows of a list, until their share suffices, and sums up the others. */
static void peak_rows_print(const cli_shares *shares, const char *what, const shares_row *row,
                            uint32_t count, const char *nameless)
{
    uint32_t named = cli_shares_named(shares, row, count);
    printf("     %-10s", what);
    for (uint32_t i = 0; i < count && i < named; i++) {
        fputs(i == 0 ? "" : ", ", stdout);
        cli_column(row[i].name[0] ? row[i].name : nameless, 0);
        printf(" %.1f %%", 100.0 * cli_share_of(shares, row[i].sigma_m2));
    }
    shares_row others = lrcs_host_shares_sum(row, named, count);
    if (others.sigma_m2 > 0.0) {
        printf(", %lu other%s %.1f %%", (unsigned long)(count - named),
               count - named > 1 ? "s" : "", 100.0 * cli_share_of(shares, others.sigma_m2));
    }
    putchar('\n');
}

/* Also says if a facet of a coarse curved part glints along its own normal and makes most of
   sigma. */
static void peak_facets_print(const cli_shares *shares, const lrcs_host_glint *coarse,
                              uint32_t count)
{
    const shares_facet *facet = &shares->facet[0];
    int normal = 0;
    printf("     %-10s", "facets");
    for (uint32_t i = 0; i < shares->facets && i < NAMED_MOST; i++) {
        printf("%s%lu of ", i == 0 ? "" : ", ", (unsigned long)facet[i].facet);
        cli_column(facet[i].part, 0);
        printf(" at %.2f deg %.1f %%", facet[i].theta_deg,
               100.0 * cli_share_of(shares, facet[i].sigma_m2));
    }
    putchar('\n');
    for (uint32_t i = 0; i < count && shares->facets > 0; i++) {
        normal |= facet->scene_part == coarse[i].part &&
                  facet->scene_material == coarse[i].material &&
                  tan(facet->theta_deg / LRCS_DEGREES_PER_RADIAN) < coarse[i].s &&
                  2.0 * facet->glint_m2 > facet->sigma_m2;
    }
    if (normal) {
        puts("     note      the normal of a facet of a curved part: flat facets glint here, the "
             "body may not");
    }
}

int cli_brightest_print(const lrcs_host_plan *plan, const double (*row)[2], uint32_t most,
                        lrcs_host_scene *base, const lrcs_run_options *options,
                        const lrcs_build_options *build, const lrcs_host_glint *coarse,
                        uint32_t coarse_count)
{
    uint64_t *peak = calloc(most, sizeof *peak);
    if (!peak) {
        return cli_out_of_memory();
    }
    uint32_t count = lrcs_host_plan_peaks(plan, row, most, peak);
    int code = 0;
    printf("brightest attitudes: rows brighter than all their neighbours\n%4s %10s", "#", "index");
    for (uint32_t i = 0; i < plan->columns; i++) {
        printf(" %*s", column_width(plan, i) - (int)strlen(plan->column[i]), "");
        cli_column(plan->column[i], 0);
    }
    printf(" %12s %9s %9s %8s\n", "sigma m2", "dBsm", "bound m2", "glint");
    for (uint32_t i = 0; i < count && code == 0; i++) {
        cli_shares shares;
        code = cli_row_shares(plan, peak[i], base, options, build, &shares);
        if (code == 0) {
            peak_numbers_print(plan, i, peak[i], row[peak[i]], &shares);
            peak_rows_print(&shares, "parts", shares.part, shares.parts, "(no name)");
            peak_rows_print(&shares, "materials", shares.material, shares.materials, "(default)");
            peak_facets_print(&shares, coarse, coarse_count);
        }
        lrcs_host_shares_free(&shares);
    }
    free(peak);
    return code;
}
