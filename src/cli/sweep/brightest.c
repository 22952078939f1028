/* SPDX-License-Identifier: MIT */
/* lrcs sweep --brightest: the peaks of a sweep, which are run once more, with the contribution of
   each facet, and printed. Peaks are rows that are brighter than all their neighbours; of equal
   rows the earlier one counts. This file decides what a neighbour is. Along an axis it is one step
   away, diagonals included, and a range of a full turn is closed; at a pole of azimuth and
   elevation all azimuths are one attitude. With --sphere the neighbours are the next points around,
   with --poses the previous and the next row. */
#include "cli/sweep/sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define BRIGHTEST_MOST 1000.0
#define BRIGHTEST_ROWS ((uint64_t)1 << 28)
#define NAMED_MOST     3u   /* number of parts, materials or facets named in a line */
#define NAMED_ENOUGH   0.95 /* naming stops when the named ones make this share of sigma */
#define VALUE_WIDTH    12
#define FULL_TURN      360.0
#define SPREAD         2.0 /* neighbours on a sphere are at most this many spacings apart */

/* ---- peaks ---- */

/* The rows as a grid of complete axes; within each of its points the poses of a sphere or track. */
typedef struct peaks_grid {
    const sweep_plan *plan;
    const double (*row)[2];
    uint64_t inner;
    uint64_t stride[SWEEP_AXES], period[SWEEP_AXES]; /* period 0: the axis is not closed */
    uint32_t az, el;                                 /* indices of axes; SWEEP_AXES for none */
} peaks_grid;

/* An axis is closed if it is an angle and its values are a full turn. */
static peaks_grid grid_make(const sweep_plan *plan, const double (*row)[2])
{
    peaks_grid grid = {.plan = plan, .row = row, .az = SWEEP_AXES, .el = SWEEP_AXES};
    int listed = plan->kind == SWEEP_SPHERE || plan->kind == SWEEP_TRACK;
    grid.inner = listed ? plan->poses : 1;
    uint64_t stride = grid.inner;
    for (uint32_t i = plan->axes; i-- > 0;) {
        const sweep_axis *axis = &plan->axis[i];
        size_t size = strlen(axis->name);
        uint64_t last = axis->range.count - 1;
        grid.stride[i] = stride;
        stride *= axis->range.count;
        if (size > 4 && strcmp(axis->name + size - 4, "_deg") == 0 && last >= 2) {
            double first = cli_range_at(&axis->range, 0);
            double whole = cli_range_at(&axis->range, last) - first;
            double step = cli_range_at(&axis->range, 1) - first;
            grid.period[i] = fabs(whole) == FULL_TURN          ? last
                             : fabs(whole + step) == FULL_TURN ? last + 1
                                                               : 0;
        }
        if (plan->kind == SWEEP_AZEL && i >= plan->scene_axes) {
            *(axis->option[0] == 'a' ? &grid.az : &grid.el) = i;
        }
    }
    return grid;
}

static int row_outshines(const peaks_grid *grid, uint64_t other, uint64_t row)
{
    double a = grid->row[other][0];
    double b = grid->row[row][0];
    return a > b || (a == b && other < row);
}

static int at_pole(const peaks_grid *grid, const uint64_t *place)
{
    return grid->el < SWEEP_AXES &&
           fabs(cli_range_at(&grid->plan->axis[grid->el].range, place[grid->el])) == 90.0;
}

/* ---- poses that stand on no axis ---- */

/* 1 if two points of a Fibonacci lattice are neighbours: their indices differ by a Fibonacci number
   (R. Swinbank, R. J. Purser, Q. J. R. Meteorol. Soc. 132 (2006) 1769), and they are near each
   other: a point has 4 pi / N of the sphere. */
static int points_are_next(const peaks_grid *grid, uint64_t a, uint64_t b)
{
    const double near = SPREAD * SPREAD * 12.566370614359172954 / (double)grid->inner;
    lrcs_pose pose[2];
    double square = 0.0;
    if (cli_plan_pose(grid->plan, a, &pose[0]) != LRCS_OK ||
        cli_plan_pose(grid->plan, b, &pose[1]) != LRCS_OK) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        double off = pose[0].R[2][k] - pose[1].R[2][k];
        square += off * off;
    }
    return square <= near;
}

static int sphere_outshines(const peaks_grid *grid, uint64_t first, uint64_t at, uint64_t row)
{
    uint64_t next = 2;
    for (uint64_t step = 1; step < grid->inner;) {
        for (int side = 0; side < 2; side++) {
            uint64_t other = side == 0
                                 ? at + step
                                 : at - step; /* wraps round below 0 and is then out of range */
            if (other < grid->inner && row_outshines(grid, first + other, row) &&
                points_are_next(grid, first + other, first + at)) {
                return 1;
            }
        }
        uint64_t sum = step + next;
        step = next;
        next = sum;
    }
    return row_outshines(grid, first + at, row);
}

/* ---- neighbours ---- */

/* 1 if any row at these places, or of the neighbouring poses, is brighter. Places may lie one step
   outside of their axes: then there is no such row. */
static int places_outshine(const peaks_grid *grid, const int64_t *place, uint64_t row)
{
    uint64_t first = 0;
    uint64_t own = row % grid->inner;
    for (uint32_t i = 0; i < grid->plan->axes; i++) {
        int64_t period = (int64_t)grid->period[i];
        int64_t at = period > 0 ? (place[i] + period) % period : place[i];
        if (at < 0 || at >= (int64_t)grid->plan->axis[i].range.count) {
            return 0;
        }
        first += (uint64_t)at * grid->stride[i];
    }
    if (grid->plan->kind == SWEEP_SPHERE) {
        return sphere_outshines(grid, first, own, row);
    }
    if (grid->plan->kind != SWEEP_TRACK) {
        return row_outshines(grid, first, row);
    }
    return row_outshines(grid, first + own, row) ||
           (own > 0 && row_outshines(grid, first + own - 1, row)) ||
           (own + 1 < grid->inner && row_outshines(grid, first + own + 1, row));
}

/* Visits all neighbouring places, like an odometer. */
static int row_is_peak(const peaks_grid *grid, uint64_t row)
{
    uint64_t place[SWEEP_AXES] = {0};
    int64_t low[SWEEP_AXES], high[SWEEP_AXES], at[SWEEP_AXES];
    uint32_t axes = grid->plan->axes;
    for (uint32_t i = 0; i < axes; i++) {
        place[i] = cli_plan_place(grid->plan, row, i);
        at[i] = low[i] = (int64_t)place[i] - 1;
        high[i] = (int64_t)place[i] + 1;
    }
    /* an earlier row may have the same attitude */
    int repeats = at_pole(grid, place) && place[grid->az] > 0;
    for (uint32_t i = 0; i < axes; i++) {
        repeats |= grid->period[i] > 0 && place[i] >= grid->period[i];
    }
    if (repeats) {
        return 0;
    }
    if (at_pole(grid, place)) {
        at[grid->az] = low[grid->az] = 0;
        high[grid->az] = (int64_t)grid->plan->axis[grid->az].range.count - 1;
    }
    for (;;) {
        if (places_outshine(grid, at, row)) {
            return 0;
        }
        uint32_t i = axes;
        while (i > 0 && at[i - 1] == high[i - 1]) {
            i--;
            at[i] = low[i];
        }
        if (i == 0) {
            return 1;
        }
        at[i - 1]++;
    }
}

uint32_t cli_peaks_find(const sweep_plan *plan, const double (*row)[2], uint32_t most,
                        uint64_t *peak)
{
    const peaks_grid grid = grid_make(plan, row);
    uint32_t count = 0;
    for (uint64_t i = 0; i < plan->rows; i++) {
        int wanted = row[i][0] > 0.0 && (count < most || row[i][0] > row[peak[count - 1]][0]);
        if (!wanted || !row_is_peak(&grid, i)) {
            continue;
        }
        uint32_t at = count < most ? count++ : most - 1;
        for (; at > 0 && row[peak[at - 1]][0] < row[i][0]; at--) {
            peak[at] = peak[at - 1];
        }
        peak[at] = i;
    }
    return count;
}

/* ---- options ---- */

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

int cli_row_shares(const sweep_plan *plan, uint64_t row, lrcs_host_scene *base,
                   const lrcs_run_options *options, const lrcs_build_options *build,
                   cli_shares *shares)
{
    lrcs_host_error error;
    lrcs_host_scene own;
    lrcs_pose pose;
    lrcs_result result;
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

static int column_width(const sweep_plan *plan, uint32_t column)
{
    int size = (int)strlen(plan->column[column]);
    return size > VALUE_WIDTH ? size : VALUE_WIDTH;
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

/* Names the first rows of a list, until their share suffices, and sums up the others. */
static void rows_print(const cli_shares *shares, const char *what, const shares_row *row,
                       uint32_t count, const char *nameless)
{
    double share = 0.0;
    uint32_t named = 0;
    printf("     %-10s", what);
    while (named < count && named < NAMED_MOST && share < NAMED_ENOUGH &&
           row[named].sigma_m2 > 0.0) {
        const shares_row *one = &row[named];
        share += cli_share_of(shares, one->sigma_m2);
        fputs(named++ == 0 ? "" : ", ", stdout);
        cli_column(one->name[0] ? one->name : nameless, 0);
        printf(" %.1f %%", 100.0 * cli_share_of(shares, one->sigma_m2));
    }
    shares_row others = cli_shares_others(row, named, count);
    if (others.sigma_m2 > 0.0) {
        printf(", %lu other%s %.1f %%", (unsigned long)(count - named),
               count - named > 1 ? "s" : "", 100.0 * cli_share_of(shares, others.sigma_m2));
    }
    putchar('\n');
}

/* Also says if a facet of a coarse curved part glints along its own normal and makes most of
   sigma. */
static void facets_print(const cli_shares *shares, const lrcs_host_glint *coarse, uint32_t count)
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
                  tan(facet->theta_deg / CLI_DEGREES) < coarse[i].s &&
                  2.0 * facet->glint_m2 > facet->sigma_m2;
    }
    if (normal) {
        puts("     note      the normal of a facet of a curved part: flat facets glint here, the "
             "body may not");
    }
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
    printf("brightest attitudes: rows that outshine all their neighbours\n%4s %10s", "#", "index");
    for (uint32_t i = 0; i < plan->columns; i++) {
        printf(" %*s", column_width(plan, i) - (int)strlen(plan->column[i]), "");
        cli_column(plan->column[i], 0);
    }
    printf(" %12s %9s %9s %8s\n", "sigma m2", "dBsm", "bound m2", "glint");
    for (uint32_t i = 0; i < count && code == 0; i++) {
        cli_shares shares;
        code = cli_row_shares(plan, peak[i], base, options, build, &shares);
        if (code == 0) {
            numbers_print(plan, i, peak[i], row[peak[i]], &shares);
            rows_print(&shares, "parts", shares.part, shares.parts, "(no name)");
            rows_print(&shares, "materials", shares.material, shares.materials, "(default)");
            facets_print(&shares, coarse, coarse_count);
        }
        lrcs_host_shares_free(&shares);
    }
    free(peak);
    return code;
}
