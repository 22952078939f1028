/* SPDX-License-Identifier: MIT */
/* A cell of the cubature: a convex part of a triangle, with the normals at its corners. */
#ifndef LRCSI_CUBATURE_CELL_H
#define LRCSI_CUBATURE_CELL_H

#include <stdint.h>

#include "base/constant.h"

/* Limit on the corners of a cell: a cell with as many is halved along a diagonal, which leaves
   fewer. */
#define LRCSI_CUBATURE_CORNERS 8

/* The value of the quadrature rule on a cell. */
typedef struct lrcsi_cubature_value {
    double glint, diffuse, rounding;
    double glint_u, diffuse_log; /* if derivatives are asked for */
    double weighted;             /* f_r cos times the caller's linear function; 0 without one */
} lrcsi_cubature_value;

/* A convex polygon. Positions are relative to the first corner, so that their errors stay below a
   few u of the cell's size, however small it is. */
typedef struct lrcsi_cubature_cell {
    double normal[LRCSI_CUBATURE_CORNERS][3], at[LRCSI_CUBATURE_CORNERS][2];
    double weight[LRCSI_CUBATURE_CORNERS]; /* the caller's linear function */
    int count;
    double unit;     /* the area of a unit square of positions */
    double theta;    /* the angle between the mean of its corners' normals and the laser */
    double skipped;  /* bound on the terms, per area, that the rule is allowed to miss */
    uint32_t depth;  /* halvings that made it from the triangle */
    int trusted;     /* 1: the rule is trusted, and `value` is its value */
    double rule_err; /* estimated relative error of an uncompared rule, else 1 */
    lrcsi_cubature_value value;
} lrcsi_cubature_cell;

/* Twice the area of the triangle of corners 0, i and i + 1, in units of the cell's. */
static inline double lrcsi_cubature_fan_cross(const lrcsi_cubature_cell *cell, int i)
{
    const double *u = cell->at[i];
    const double *v = cell->at[i + 1];
    return u[0] * v[1] - u[1] * v[0];
}

/* A bound on the rounding error of half of it. Each halving adds an error of 2 u of the cell's size
   to positions, which is that times the size in the area; the area itself adds 4 u. */
static inline double lrcsi_cubature_fan_err(const lrcsi_cubature_cell *cell, int i)
{
    const double *u = cell->at[i];
    const double *v = cell->at[i + 1];
    return 8 * LRCSI_U * (1 + cell->depth) *
           (u[0] * u[0] + u[1] * u[1] + v[0] * v[0] + v[1] * v[1]);
}

/* Makes a cell from a triangle. Given: the normals at its corners; the values of the caller's
   linear function there (NULL: 0); its area. theta is left to lrcsi_cubature_cell_finish. */
lrcsi_cubature_cell lrcsi_cubature_cell_of(const double normal[3][3], const double weight[3],
                                           double area);

/* The part of a cell where sign * level >= 0 is added to `part`, a cell without corners. `level` is
   a linear function of position, given by its values at the corners. */
void lrcsi_cubature_cell_cut(const lrcsi_cubature_cell *cell,
                             const double level[LRCSI_CUBATURE_CORNERS], int sign,
                             lrcsi_cubature_cell *part);

/* Makes the positions of a cell's corners relative to the first one, and finds theta. */
void lrcsi_cubature_cell_finish(lrcsi_cubature_cell *cell);

/* Halves a cell across the direction in which its normals turn most. The normals of half[1] are
   closer to the direction to the laser; half[0] is the whole cell and half[1] empty if no line
   divides it. The halves inherit `skipped` and `trusted`. */
void lrcsi_cubature_cell_halve(const lrcsi_cubature_cell *cell, lrcsi_cubature_cell half[2]);

/* The area; the largest angle between the mean normal and any other, rad, rounded up; the length of
   the shortest normal at a corner. */
double lrcsi_cubature_cell_area(const lrcsi_cubature_cell *cell);
double lrcsi_cubature_cell_turn(const lrcsi_cubature_cell *cell);
double lrcsi_cubature_cell_shortest(const lrcsi_cubature_cell *cell);

#endif
