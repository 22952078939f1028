/* SPDX-License-Identifier: MIT */
/* The cells of the cubature: convex polygons with a normal at each corner. This file decides along
   which line a cell is halved, and measures cells; cubature.c decides which cells are halved, and
   integrates over them. */
#include "integrate/cubature/cubature_cell.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/vec3.h"

static void cell_mean(const lrcsi_cubature_cell *cell, double n[3])
{
    for (int k = 0; k < 3; k++) {
        n[k] = 0;
        for (int i = 0; i < cell->count; i++) {
            n[k] += cell->normal[i][k] / cell->count;
        }
    }
}

double lrcsi_cubature_cell_area(const lrcsi_cubature_cell *cell)
{
    double area = 0;
    for (int i = 1; i + 1 < cell->count; i++) {
        area += 0.5 * lrcsi_cubature_fan_cross(cell, i);
    }
    return lrcsi_max(0, cell->unit * area);
}

/* The turn of a cell: the largest angle between the mean normal and any other normal. If it is less
   than a right angle, it is attained at a corner, because a spherical cap smaller than a hemisphere
   that contains the normals at the corners contains all normals between them. */
double lrcsi_cubature_cell_turn(const lrcsi_cubature_cell *cell)
{
    double n[3];
    double tangent = 0;
    cell_mean(cell, n);
    for (int i = 0; i < cell->count; i++) {
        const double *m = cell->normal[i];
        double dot = lrcsi_vec3_dot(n, m);
        double cross[3];
        lrcsi_vec3_cross(n, m, cross);
        tangent = lrcsi_max(tangent, dot > 0 ? sqrt(lrcsi_vec3_dot(cross, cross)) / dot : HUGE_VAL);
    }
    return isfinite(tangent) ? atan(tangent) * LRCSI_OUTWARD(4) + 16 * LRCSI_U : LRCS_PI;
}

/* The length of the shortest normal at a corner. */
double lrcsi_cubature_cell_shortest(const lrcsi_cubature_cell *cell)
{
    double shortest = HUGE_VAL;
    for (int i = 0; i < cell->count; i++) {
        shortest = lrcsi_min(shortest, sqrt(lrcsi_vec3_dot(cell->normal[i], cell->normal[i])));
    }
    return shortest;
}

/* Adds a corner, unless there is no room for it. That does not happen with convex cells; a cell
   that rounding has left not quite convex may lose a sliver. */
static void corner_add(lrcsi_cubature_cell *cell, const double normal[3], const double at[2],
                       double weight)
{
    if (cell->count == LRCSI_CUBATURE_CORNERS) {
        return;
    }
    memcpy(cell->normal[cell->count], normal, sizeof cell->normal[0]);
    memcpy(cell->at[cell->count], at, sizeof cell->at[0]);
    cell->weight[cell->count++] = weight;
}

/* The part of a cell where sign * level >= 0. `level` is a linear function of position, given by
   its values at the corners. */
void lrcsi_cubature_cell_cut(const lrcsi_cubature_cell *cell,
                             const double level[LRCSI_CUBATURE_CORNERS], int sign,
                             lrcsi_cubature_cell *part)
{
    for (int i = 0; i < cell->count; i++) {
        int j = (i + 1) % cell->count;
        double here = sign * level[i];
        double there = sign * level[j];
        if (here >= 0) {
            corner_add(part, cell->normal[i], cell->at[i], cell->weight[i]);
        }
        if ((here > 0 && there < 0) || (here < 0 && there > 0)) {
            double t = here / (here - there); /* where the level is 0 */
            double normal[3];
            double at[2];
            for (int k = 0; k < 3; k++) {
                normal[k] = cell->normal[i][k] + t * (cell->normal[j][k] - cell->normal[i][k]);
            }
            for (int k = 0; k < 2; k++) {
                at[k] = cell->at[i][k] + t * (cell->at[j][k] - cell->at[i][k]);
            }
            corner_add(part, normal, at, cell->weight[i] + t * (cell->weight[j] - cell->weight[i]));
        }
    }
}

/* Makes positions relative to the first corner, and finds the angle to the laser. */
void lrcsi_cubature_cell_finish(lrcsi_cubature_cell *cell)
{
    for (int i = cell->count - 1; i >= 0; i--) {
        cell->at[i][0] -= cell->at[0][0];
        cell->at[i][1] -= cell->at[0][1];
    }
    double n[3];
    cell_mean(cell, n);
    cell->theta = atan2(sqrt(n[0] * n[0] + n[1] * n[1]), n[2]);
}

/* The chord between the two unit normals at corners that are farthest apart, which is the direction
   in which normals turn most; and these corners. */
static void cell_chord(const lrcsi_cubature_cell *cell, int *from, int *to, double chord[3])
{
    double unit[LRCSI_CUBATURE_CORNERS][3];
    double longest = -1;
    for (int i = 0; i < cell->count; i++) {
        double length = sqrt(lrcsi_vec3_dot(cell->normal[i], cell->normal[i]));
        for (int k = 0; k < 3; k++) {
            unit[i][k] = length > 0 ? cell->normal[i][k] / length : 0;
        }
        for (int j = 0; j < i; j++) {
            double apart[3];
            lrcsi_vec3_between(unit[j], unit[i], apart);
            double square = lrcsi_vec3_dot(apart, apart);
            if (square > longest) {
                longest = square;
                *from = j;
                *to = i;
                memcpy(chord, apart, sizeof apart);
            }
        }
    }
}

/* Halves a cell by a line, which is the zero line of a linear function `level` of position, given
   by its values at the corners. Because levels depend on positions only, the areas of the halves
   add up to that of the cell whatever the errors of normals are.
   1. The gradient g, up to a positive factor, of the component of the normals along their longest
      chord, in the largest triangle of the fan.
   2. The line perpendicular to g, midway between the ends of the chord; a diagonal if the cell has
      LRCSI_CUBATURE_CORNERS corners. If no level is negative, for instance because all normals are
      the same, the first half is the whole cell, and the second one is empty.
   3. The halves. The normals of half[1] are closer to the direction to the laser. */
void lrcsi_cubature_cell_halve(const lrcsi_cubature_cell *cell, lrcsi_cubature_cell half[2])
{
    double chord[3] = {0, 0, 0};
    int from = 0;
    int to = 0;
    cell_chord(cell, &from, &to, chord);
    double g[2] = {0, 0};
    double largest = 0;
    for (int i = 1; i + 1 < cell->count; i++) { /* 1 */
        const double *u = cell->at[i];
        const double *v = cell->at[i + 1];
        double gu = 0;
        double gv = 0;
        for (int k = 0; k < 3; k++) {
            gu += chord[k] * (cell->normal[i][k] - cell->normal[0][k]);
            gv += chord[k] * (cell->normal[i + 1][k] - cell->normal[0][k]);
        }
        if (lrcsi_cubature_fan_cross(cell, i) > largest) {
            largest = lrcsi_cubature_fan_cross(cell, i);
            g[0] = gu * v[1] - gv * u[1];
            g[1] = gv * u[0] - gu * v[0];
        }
    }
    double level[LRCSI_CUBATURE_CORNERS] = {0};
    int below = 0;
    const double *p = cell->at[LRCSI_CUBATURE_CORNERS / 2];
    for (int i = 0; i < cell->count; i++) { /* 2 */
        const double *at = cell->at[i];
        level[i] = cell->count == LRCSI_CUBATURE_CORNERS
                       ? p[0] * at[1] - p[1] * at[0]
                       : g[0] * (at[0] - 0.5 * (cell->at[from][0] + cell->at[to][0])) +
                             g[1] * (at[1] - 0.5 * (cell->at[from][1] + cell->at[to][1]));
        below |= level[i] < 0;
    }
    for (int h = 0; h < 2; h++) { /* 3 */
        half[h] = (lrcsi_cubature_cell){.unit = cell->unit,
                                        .skipped = cell->skipped,
                                        .depth = cell->depth + 1,
                                        .trusted = cell->trusted,
                                        .rule_err = 1};
        if (h == 0 || below) {
            lrcsi_cubature_cell_cut(cell, level, h == 0 ? 1 : -1, &half[h]);
        }
        lrcsi_cubature_cell_finish(&half[h]);
    }
    if (half[0].theta < half[1].theta) {
        lrcsi_cubature_cell other = half[0];
        half[0] = half[1];
        half[1] = other;
    }
}

lrcsi_cubature_cell lrcsi_cubature_cell_of(const double normal[3][3], const double weight[3],
                                           double area)
{
    static const double at[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    lrcsi_cubature_cell cell = {.unit = 2 * area};
    for (int i = 0; i < 3; i++) {
        corner_add(&cell, normal[i], at[i], weight ? weight[i] : 0);
    }
    return cell;
}
