/* SPDX-License-Identifier: MIT */
/* Which rows of a sweep are peaks: brighter than all their neighbours; of equal rows the earlier
   one counts. This file decides what a neighbour is. Along an axis it is one step away, diagonals
   included, and a range of a full turn is closed; at a pole of azimuth and elevation all azimuths
   are one attitude. With --sphere the neighbours are the next points around, with --poses the
   previous and the next row. */
#include "cli/sweep/sweep.h"

#include <math.h>
#include <string.h>

#define FULL_TURN 360.0
#define SPREAD    2.0 /* neighbours on a sphere are at most this many spacings apart */

/* The rows as a grid of complete axes; within each of its points the poses of a sphere or track. */
typedef struct peaks_grid {
    const sweep_plan *plan;
    const double (*row)[2];
    uint64_t inner;
    uint64_t stride[SWEEP_AXES], period[SWEEP_AXES]; /* period 0: the axis is not closed */
    uint32_t az, el;                                 /* indices of axes; SWEEP_AXES for none */
} peaks_grid;

/* The number of steps after which an axis is back at its start; 0 for never. */
static uint64_t axis_period(const sweep_axis *axis)
{
    size_t size = strlen(axis->name);
    uint64_t last = axis->range.count - 1;
    int angle = size > 4 && strcmp(axis->name + size - 4, "_deg") == 0;
    if (!angle || last < 2) {
        return 0;
    }
    double first = cli_range_at(&axis->range, 0);
    double whole = cli_range_at(&axis->range, last) - first;
    double step = cli_range_at(&axis->range, 1) - first;
    return fabs(whole) == FULL_TURN ? last : fabs(whole + step) == FULL_TURN ? last + 1 : 0;
}

static peaks_grid grid_make(const sweep_plan *plan, const double (*row)[2])
{
    peaks_grid grid = {.plan = plan, .row = row, .az = SWEEP_AXES, .el = SWEEP_AXES};
    int listed = plan->kind == SWEEP_SPHERE || plan->kind == SWEEP_TRACK;
    grid.inner = listed ? plan->poses : 1;
    uint64_t stride = grid.inner;
    for (uint32_t i = plan->axes; i-- > 0;) {
        grid.stride[i] = stride;
        grid.period[i] = axis_period(&plan->axis[i]);
        stride *= plan->axis[i].range.count;
        if (plan->kind == SWEEP_AZEL && i >= plan->scene_axes) {
            *(plan->axis[i].option[0] == 'a' ? &grid.az : &grid.el) = i;
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

/* 1 if an earlier row has the same attitude. */
static int row_repeats(const peaks_grid *grid, const uint64_t *place)
{
    for (uint32_t i = 0; i < grid->plan->axes; i++) {
        if (grid->period[i] > 0 && place[i] >= grid->period[i]) {
            return 1;
        }
    }
    return at_pole(grid, place) && place[grid->az] > 0;
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

static int track_outshines(const peaks_grid *grid, uint64_t first, uint64_t at, uint64_t row)
{
    return row_outshines(grid, first + at, row) ||
           (at > 0 && row_outshines(grid, first + at - 1, row)) ||
           (at + 1 < grid->inner && row_outshines(grid, first + at + 1, row));
}

/* ---- neighbours ---- */

/* The row of places that may lie one step outside of their axes; 0 if there is no such row. */
static int row_of_places(const peaks_grid *grid, const int64_t *place, uint64_t *row)
{
    *row = 0;
    for (uint32_t i = 0; i < grid->plan->axes; i++) {
        int64_t period = (int64_t)grid->period[i];
        int64_t at = period > 0 ? (place[i] + period) % period : place[i];
        if (at < 0 || at >= (int64_t)grid->plan->axis[i].range.count) {
            return 0;
        }
        *row += (uint64_t)at * grid->stride[i];
    }
    return 1;
}

/* 1 if any row at these places, or of the neighbouring poses, is brighter. */
static int places_outshine(const peaks_grid *grid, const int64_t *place, uint64_t row)
{
    uint64_t first;
    uint64_t at = row % grid->inner;
    if (!row_of_places(grid, place, &first)) {
        return 0;
    }
    return grid->plan->kind == SWEEP_SPHERE  ? sphere_outshines(grid, first, at, row)
           : grid->plan->kind == SWEEP_TRACK ? track_outshines(grid, first, at, row)
                                             : row_outshines(grid, first, row);
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
    if (row_repeats(grid, place)) {
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
