/* SPDX-License-Identifier: MIT */
/* The peaks of a sweep: rows that are brighter than all their neighbours; of equal rows the earlier
   one counts. This file decides what a neighbour is. Along an axis it is one step away, diagonals
   included, and a range of a full turn is closed; at a pole of azimuth and elevation all azimuths
   are one direction. Of a sphere the neighbours are the next points around, of a track the previous
   and the next row. */
#include <lrcs/plan.h>

#include <math.h>
#include <string.h>

#include "base/constant.h"

#define FULL_TURN 360.0
#define SPREAD    2.0 /* neighbours on a sphere are at most this many spacings apart */

/* The rows as a grid of complete axes; within each of its points the poses of a sphere or track. */
typedef struct peaks_grid {
    const lrcs_host_plan *plan;
    const double (*row)[2];
    uint64_t inner;
    uint64_t stride[LRCS_HOST_PLAN_AXES],
        period[LRCS_HOST_PLAN_AXES]; /* period 0: the axis is not closed */
    uint32_t az, el;                 /* indices of axes; LRCS_HOST_PLAN_AXES for none */
} peaks_grid;

/* An axis is closed if it is an angle and its values are a full turn. */
static peaks_grid peaks_grid_make(const lrcs_host_plan *plan, const double (*row)[2])
{
    peaks_grid grid = {
        .plan = plan, .row = row, .az = LRCS_HOST_PLAN_AXES, .el = LRCS_HOST_PLAN_AXES};
    int listed = plan->kind == LRCS_HOST_PLAN_SPHERE || plan->kind == LRCS_HOST_PLAN_TRACK;
    grid.inner = listed ? plan->poses : 1;
    uint64_t stride = grid.inner;
    for (uint32_t i = plan->axes; i-- > 0;) {
        const lrcs_host_plan_axis *axis = &plan->axis[i];
        size_t size = strlen(axis->name);
        uint64_t last = axis->range.count - 1;
        grid.stride[i] = stride;
        stride *= axis->range.count;
        if (size > 4 && strcmp(axis->name + size - 4, "_deg") == 0 && last >= 2) {
            double first = lrcs_host_range_at(&axis->range, 0);
            double whole = lrcs_host_range_at(&axis->range, last) - first;
            double step = lrcs_host_range_at(&axis->range, 1) - first;
            grid.period[i] = fabs(whole) == FULL_TURN          ? last
                             : fabs(whole + step) == FULL_TURN ? last + 1
                                                               : 0;
        }
        if (plan->kind == LRCS_HOST_PLAN_AZEL && i >= plan->scene_axes) {
            *(axis->key[0] == 'a' ? &grid.az : &grid.el) = i;
        }
    }
    return grid;
}

static int row_is_brighter(const peaks_grid *grid, uint64_t other, uint64_t row)
{
    double a = grid->row[other][0];
    double b = grid->row[row][0];
    return a > b || (a == b && other < row);
}

static int at_pole(const peaks_grid *grid, const uint64_t *place)
{
    return grid->el < LRCS_HOST_PLAN_AXES &&
           fabs(lrcs_host_range_at(&grid->plan->axis[grid->el].range, place[grid->el])) == 90.0;
}

/* ---- poses that stand on no axis ---- */

/* 1 if two points of a Fibonacci lattice are neighbours: their indices differ by a Fibonacci number
   (R. Swinbank, R. J. Purser, Q. J. R. Meteorol. Soc. 132 (2006) 1769), and they are near each
   other: a point has 4 pi / N of the sphere. */
static int points_are_next(const peaks_grid *grid, uint64_t a, uint64_t b)
{
    const double near = SPREAD * SPREAD * LRCS_FOUR_PI / (double)grid->inner;
    lrcs_pose pose[2];
    double square = 0.0;
    if (lrcs_host_plan_pose(grid->plan, a, &pose[0]) != LRCS_OK ||
        lrcs_host_plan_pose(grid->plan, b, &pose[1]) != LRCS_OK) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        double off = pose[0].R[2][k] - pose[1].R[2][k];
        square += off * off;
    }
    return square <= near;
}

static int lattice_neighbour_is_brighter(const peaks_grid *grid, uint64_t first, uint64_t at,
                                         uint64_t row)
{
    uint64_t next = 2;
    for (uint64_t step = 1; step < grid->inner;) {
        for (int side = 0; side < 2; side++) {
            uint64_t other = side == 0
                                 ? at + step
                                 : at - step; /* wraps round below 0 and is then out of range */
            if (other < grid->inner && row_is_brighter(grid, first + other, row) &&
                points_are_next(grid, first + other, first + at)) {
                return 1;
            }
        }
        uint64_t sum = step + next;
        step = next;
        next = sum;
    }
    return row_is_brighter(grid, first + at, row);
}

/* ---- neighbours ---- */

/* 1 if any row at these places, or of the neighbouring poses, is brighter. Places may lie one step
   outside of their axes: then there is no such row. */
static int neighbour_is_brighter(const peaks_grid *grid, const int64_t *place, uint64_t row)
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
    if (grid->plan->kind == LRCS_HOST_PLAN_SPHERE) {
        return lattice_neighbour_is_brighter(grid, first, own, row);
    }
    if (grid->plan->kind != LRCS_HOST_PLAN_TRACK) {
        return row_is_brighter(grid, first, row);
    }
    return row_is_brighter(grid, first + own, row) ||
           (own > 0 && row_is_brighter(grid, first + own - 1, row)) ||
           (own + 1 < grid->inner && row_is_brighter(grid, first + own + 1, row));
}

/* Visits all neighbouring places, like an odometer. */
static int row_is_peak(const peaks_grid *grid, uint64_t row)
{
    uint64_t place[LRCS_HOST_PLAN_AXES] = {0};
    int64_t low[LRCS_HOST_PLAN_AXES], high[LRCS_HOST_PLAN_AXES], at[LRCS_HOST_PLAN_AXES];
    uint32_t axes = grid->plan->axes;
    for (uint32_t i = 0; i < axes; i++) {
        place[i] = lrcs_host_plan_place(grid->plan, row, i);
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
        if (neighbour_is_brighter(grid, at, row)) {
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

uint32_t lrcs_host_plan_peaks(const lrcs_host_plan *plan, const double (*row)[2], uint32_t most,
                              uint64_t *peak)
{
    const peaks_grid grid = peaks_grid_make(plan, row);
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
