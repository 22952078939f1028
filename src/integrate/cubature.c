/* SPDX-License-Identifier: MIT */
/* Adaptive cubature of f_r cos(theta) over a triangle of interpolated normals. This file decides
   where cells are divided and when to stop; the caller decides over which triangles the integral is
   taken, and what their areas are.

   Normals are linear in position, so that the part with n . s_hat > 0 is the triangle less a
   half-plane, which is cut off first. Inside it the integrand is analytic, but may have a peak in a
   small fraction of the triangle, or outside of it. A cell (a convex polygon) is halved by a line
   across the direction in which its normals turn most. The half nearer to the laser is done first,
   so that a peak is in the sum before what surrounds it.
   - A rule is trusted only where the normals turn by less than the widths of the peaks (of the
   glint s cos^2 theta, of the diffuse term 1 / sqrt(m + 1)), and by less than the angle in which
   their flanks fall by a few powers of e: then no peak can be missed by the rule, nor a flank by
   the comparison below. Elsewhere a cell is halved without evaluating a rule, unless the upper
   bound of the integrand on it (proved) is negligible compared with the sum and its estimate, or
   with a lower bound of the sum to come.
   - A trusted rule, of degree 5 on 7 points (Radon 1948), is compared with itself on four quarters,
     the halves of both halves: between them, every direction in which the normals turn much is
     halved, which one halving does not achieve. The difference is the estimate; being the error of
     the coarser value, it is some ten to sixty times the error of the finer one, which is kept.
   - Where the normals turn by less than a small fraction p of those widths, and of the angle to the
     edge where n . s_hat = 0, the rule alone suffices: its error is of the order of p^6, which then
     is the estimate; p^5 if a linear function of the caller's is integrated as well.
   Where halvings run out, the upper bound on the cell is the estimate. Where cells run out,
   the triangle is done again with a larger tolerance: all of it slightly less accurate is better
   than a part not done. Where steps run out, cells that should be divided are left as they are, and
   what this may cost is a bound and not an estimate. */
#include "integrate/cubature.h"

#include <math.h>

#include "base/constant.h"
#include "base/elementary.h"
#include "base/range.h"
#include "base/vec3.h"
#include "base/work.h"

/* Limit on the halvings of a cell, and cells on the stack. Quartering leaves three more cells on
   the stack, and takes two halvings. */
#define HALVINGS_MAX 64u
#define STACK_CELLS  (3 * HALVINGS_MAX / 2 + 4)
/* Corners of a cell: one that has all of them is halved along a diagonal, which leaves fewer. */
#define CORNERS 8
/* Limit on the cells of one sum, apart from those that each triangle is granted. */
#define SPLITS_MAX (1u << 15)
/* The factor by which the tolerance grows where cells run out, and its limit. */
#define COARSER    100
#define COARSE_MAX 1e-2
/* Steps that a cell takes: quarters, the rule on each, bounds. */
#define CELL_STEPS 256
/* A rule is trusted only if the normals of the cell turn by no more than this, rad. */
#define TURN_MAX 0.5
/* Values below this, times the tolerance, are negligible compared with what a peak of the upper
   bound's height and of the BRDF's own width adds over a radian. They are part of the estimate. */
#define NEGLIGIBLE 0x1p-20
/* Relative to A and B: terms smaller than this are lost in the bounds on underflow
   (optics/deviation.c). */
#define TERM_MIN 0x1p-1008
/* At a tan^2 above this the laser is in the plane as far as doubles can show. */
#define TAN2_MAX 1e300

/* The value of the rule on a cell. */
typedef struct cube_value {
    double glint, diffuse, rounding;
    double glint_u, diffuse_log; /* moments, if sum.moments */
    double weighted;             /* times the caller's linear function, 0 without one */
} cube_value;

/* A convex polygon. Positions are relative to the first corner, so that their errors stay below a
   few u of the cell's size, however small it is. */
struct lrcsi_cubature_cell {
    double normal[CORNERS][3], at[CORNERS][2], weight[CORNERS];
    int count;
    double unit;    /* area of the square of positions */
    double theta;   /* angle between the mean of its corners' normals and the laser */
    double skipped; /* bound on the terms, per area, that the rule is allowed to miss */
    uint32_t depth;
    int trusted;     /* the rule is: `value` is its value */
    double rule_err; /* estimated relative error of the rule if that can be relied on, else 1 */
    cube_value value;
};
typedef struct lrcsi_cubature_cell cube_cell;

/* --- the rule --------------------------------------------------------------------------------- */

/* A bound on the error of f_r cos at a node of the rule where the normal has an error of d, rad.
   The logarithms of the two terms fall with theta by at most t (5 + 2 (1 + t^2)/s^2) and (m + 1) t
   per radian, t = tan(theta), both of which grow with t; and tan(theta + d) <= t + 2 d (1 + t^2)
   for d t <= 1/2; e^x - 1 <= 2 x for x <= 1/4. If the change may be larger, the error is at most
   the upper bound of the term in the neighbourhood. */
static double node_position_err(const lrcsi_cubature *sum, double u, double d, const cube_value *at)
{
    const lrcs_brdf *brdf = sum->brdf;
    double t = sqrt(u) + 2 * d * (1 + u);
    double glint_change = brdf->A > 0 ? d * t * (5 + 2 * ((1 + t * t) / brdf->s) / brdf->s) : 0;
    double diffuse_change = d * t * (brdf->m + 1);
    if (glint_change <= 0.25 && diffuse_change <= 0.25) {
        return 2 * (at->glint * glint_change + at->diffuse * diffuse_change);
    }
    lrcsi_reflection bound = lrcsi_reflect_bound(brdf, atan(sqrt(u)), 2 * d);
    return (glint_change <= 0.25 ? 2 * at->glint * glint_change : bound.glint) +
           (diffuse_change <= 0.25 ? 2 * at->diffuse * diffuse_change : bound.diffuse);
}

/* f_r cos at one normal. Rounding: lrcsi_reflect's own, and a square root and a product; tan^2 has
   a relative error of 6 u, which is at most 2 u in theta and part of the position error. */
static cube_value node_value(const lrcsi_cubature *sum, const double n[3])
{
    cube_value at = {0, 0, 0, 0, 0, 0};
    if (!(n[2] > 0)) {
        return at;
    }
    double u = lrcsi_min(TAN2_MAX, (n[0] * n[0] + n[1] * n[1]) / n[2] / n[2]);
    lrcsi_reflection reflection = lrcsi_reflect(sum->brdf, u, 0);
    double secant = sqrt(1 + u);
    at.glint = reflection.glint * secant;
    at.diffuse = reflection.diffuse * secant;
    if (sum->moments) {
        at.glint_u = at.glint > 0 ? at.glint * u : 0;
        at.diffuse_log = at.diffuse > 0 ? at.diffuse * lrcsi_log1p(u).hi : 0;
    }
    at.rounding = reflection.error * secant + 4 * LRCSI_U * (at.glint + at.diffuse) +
                  node_position_err(sum, u, sum->position_err / (n[2] * secant), &at);
    return at;
}

static void value_add(cube_value *sum, double weight, const cube_value *value)
{
    sum->glint += weight * value->glint;
    sum->diffuse += weight * value->diffuse;
    sum->rounding += weight * value->rounding;
    sum->glint_u += weight * value->glint_u;
    sum->diffuse_log += weight * value->diffuse_log;
    sum->weighted += weight * value->weighted;
}

/* A bound on the rounding error of the area of the triangle of corners 0, i and i + 1, in units of
   the cell's. Each halving adds an error of 2 u of the cell's size to positions, which is that
   times the size in the area; the area itself adds 4 u. */
static double fan_area_err(const cube_cell *cell, int i)
{
    const double *u = cell->at[i];
    const double *v = cell->at[i + 1];
    return 8 * LRCSI_U * (1 + cell->depth) *
           (u[0] * u[0] + u[1] * u[1] + v[0] * v[0] + v[1] * v[1]);
}

/* The rule on the triangle of corners 0, i and i + 1: the centroid with weight 9/40; the points
   (a, a, 1 - 2 a) and their rotations, a = (6 -+ sqrt 15)/21, with weights (155 -+ sqrt 15)/1200.
   Weights and sums have relative errors below 16 u. */
static void rule_add(const lrcsi_cubature *sum, const cube_cell *cell, int i, cube_value *value)
{
    static const double rule[3][3] = {
        {1.0 / 3, 1.0 / 3, 0.225},
        {0.10128650732345633880, 0.79742698535308732240, 0.12593918054482715260},
        {0.47014206410511508977, 0.05971587178976982046, 0.13239415278850618074}};
    const double *u = cell->at[i];
    const double *v = cell->at[i + 1];
    double area = 0.5 * (u[0] * v[1] - u[1] * v[0]);
    double area_err = fan_area_err(cell, i);
    cube_value mean = {0, 0, 0, 0, 0, 0};
    for (int k = 0; k < 7 && area > 0; k++) {
        const double *node = rule[(k + 2) / 3]; /* the centroid once, the others three times */
        int odd = (k + 2) % 3;
        double n[3];
        for (int c = 0; c < 3; c++) {
            n[c] = node[odd == 0] * cell->normal[0][c] + node[odd == 1] * cell->normal[i][c] +
                   node[odd == 2] * cell->normal[i + 1][c];
        }
        cube_value at = node_value(sum, n);
        at.weighted = (at.glint + at.diffuse) *
                      (node[odd == 0] * cell->weight[0] + node[odd == 1] * cell->weight[i] +
                       node[odd == 2] * cell->weight[i + 1]);
        value_add(&mean, node[2], &at);
    }
    mean.rounding += 16 * LRCSI_U * (mean.glint + mean.diffuse);
    value_add(value, cell->unit * area, &mean);
    value->rounding += cell->unit * area_err * (mean.glint + mean.diffuse);
}

static cube_value rule_value(const lrcsi_cubature *sum, const cube_cell *cell)
{
    cube_value value = {0, 0, 0, 0, 0, 0};
    for (int i = 1; i + 1 < cell->count; i++) {
        rule_add(sum, cell, i, &value);
    }
    return value;
}

static double cube_area(const cube_cell *cell)
{
    double area = 0;
    for (int i = 1; i + 1 < cell->count; i++) {
        const double *u = cell->at[i];
        const double *v = cell->at[i + 1];
        area += 0.5 * (u[0] * v[1] - u[1] * v[0]);
    }
    return lrcsi_max(0, cell->unit * area);
}

/* --- cells ------------------------------------------------------------------------------------ */

static void cube_mean(const cube_cell *cell, double n[3])
{
    for (int k = 0; k < 3; k++) {
        n[k] = 0;
        for (int i = 0; i < cell->count; i++) {
            n[k] += cell->normal[i][k] / cell->count;
        }
    }
}

static void cube_measure(cube_cell *cell)
{
    double n[3];
    cube_mean(cell, n);
    cell->theta = atan2(sqrt(n[0] * n[0] + n[1] * n[1]), n[2]);
}

/* The largest angle between the mean normal and any normal of the cell. It is attained at a corner
   if it is less than a right angle, since a spherical cap smaller than a hemisphere that contains
   the corners contains everything between them. */
static double cube_turn(const cube_cell *cell)
{
    double n[3];
    double tangent = 0;
    cube_mean(cell, n);
    for (int i = 0; i < cell->count; i++) {
        const double *m = cell->normal[i];
        double dot = lrcsi_vec3_dot(n, m);
        double cross[3];
        lrcsi_vec3_cross(n, m, cross);
        tangent = lrcsi_max(tangent, dot > 0 ? sqrt(lrcsi_vec3_dot(cross, cross)) / dot : HUGE_VAL);
    }
    return isfinite(tangent) ? atan(tangent) * (1 + 4 * LRCSI_U) + 16 * LRCSI_U : LRCS_PI;
}

/* Errors of f_r cos below this are accepted. */
static double negligible_below(const lrcsi_cubature *sum)
{
    return lrcsi_max(sum->negligible, sum->tolerance * sum->reference);
}

/* Decides whether the rule is trusted on the cell, and evaluates it if so:
   1. whether the normals turn little enough for the glint and for the diffuse term;
   2. if not, whether the terms are negligible on the cell, by their proved upper bound;
   3. the estimated error of the rule, from the turn relative to the widths of the terms. */
static void cube_trust(const lrcsi_cubature *sum, cube_cell *cell)
{
    const lrcs_brdf *brdf = sum->brdf;
    double turn = cube_turn(cell);
    double cosine = cos(cell->theta);
    double t = fabs(tan(cell->theta));
    double width = brdf->s * cosine * cosine * lrcsi_min(1, 2 * brdf->s / t); /* of the glint */
    double steepness = (brdf->m + 1) * lrcsi_min(1, t); /* of the diffuse term */
    int glint_resolved = !(brdf->A > 0) || turn <= width;
    int diffuse_resolved =
        !(brdf->B > 0) || (turn * turn * (brdf->m + 1) <= 1 && turn * steepness <= 4);
    int is_trusted = glint_resolved && diffuse_resolved;
    cell->skipped = 0;
    if (turn <= TURN_MAX && !is_trusted) {
        lrcsi_reflection bound = lrcsi_reflect_bound(brdf, cell->theta, turn);
        cell->skipped = (glint_resolved ? 0 : bound.glint) + (diffuse_resolved ? 0 : bound.diffuse);
        double sum_so_far =
            lrcsi_sum_value(&sum->glint) + lrcsi_sum_value(&sum->diffuse) + sum->estimate;
        double scale = lrcsi_max(sum_so_far, sum->diffuse_min * sum->area);
        is_trusted = cell->skipped <= negligible_below(sum) ||
                     cell->skipped * sum->area <= sum->tolerance * scale;
    }
    cell->trusted = turn <= TURN_MAX && is_trusted;
    double p = lrcsi_max(turn * sqrt(brdf->m + 1), 0.25 * turn * (brdf->m + 1) * t);
    p = lrcsi_max(p, brdf->A > 0 && glint_resolved ? turn / width : 0);
    double fifth = p * p * p * p * p;
    cell->rule_err = p < 1 ? fifth * (sum->weight ? 1 : p) : 1;
    if (cell->trusted) {
        cell->value = rule_value(sum, cell);
    }
}

/* The two corners *from and *to whose unit normals are farthest apart, and the chord between these:
   the direction in which normals turn most. */
static void cube_chord(const cube_cell *cell, int *from, int *to, double chord[3])
{
    double unit[CORNERS][3];
    double longest = -1;
    for (int i = 0; i < cell->count; i++) {
        double length = sqrt(lrcsi_vec3_dot(cell->normal[i], cell->normal[i]));
        for (int k = 0; k < 3; k++) {
            unit[i][k] = length > 0 ? cell->normal[i][k] / length : 0;
        }
        for (int j = 0; j < i; j++) {
            double apart[3] = {unit[i][0] - unit[j][0], unit[i][1] - unit[j][1],
                               unit[i][2] - unit[j][2]};
            if (lrcsi_vec3_dot(apart, apart) > longest) {
                longest = lrcsi_vec3_dot(apart, apart);
                *from = j;
                *to = i;
                for (int k = 0; k < 3; k++) {
                    chord[k] = apart[k];
                }
            }
        }
    }
}

/* Adds a corner. A convex cell never has too many; one that is not quite convex, by rounding, may
   lose a sliver. */
static void corner_add(cube_cell *cell, const double normal[3], const double at[2], double weight)
{
    if (cell->count == CORNERS) {
        return;
    }
    for (int k = 0; k < 3; k++) {
        cell->normal[cell->count][k] = normal[k];
    }
    for (int k = 0; k < 2; k++) {
        cell->at[cell->count][k] = at[k];
    }
    cell->weight[cell->count++] = weight;
}

/* The part of a cell where sign * level >= 0. level is linear in position, and given at corners. */
static void cube_cut(const cube_cell *cell, const double level[CORNERS], int sign, cube_cell *part)
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
static void cube_finish(cube_cell *cell)
{
    for (int i = cell->count - 1; i >= 0; i--) {
        cell->at[i][0] -= cell->at[0][0];
        cell->at[i][1] -= cell->at[0][1];
    }
    cube_measure(cell);
}

/* The levels at corners whose zero line halves a cell; returns 0 if no level is negative, as where
   all normals are the same. They are linear in position, so that areas add up whatever rounding
   does to normals. The line is midway across the direction in which normals turn most or, if the
   cell has all the corners it may have, a diagonal. That direction is the gradient g, over
   positions and up to a positive factor, of the component of the normals along their longest chord:
   in the largest triangle of the fan. */
static int cube_levels(const cube_cell *cell, double level[CORNERS])
{
    int from = 0;
    int to = 0;
    int below = 0;
    double chord[3] = {0, 0, 0};
    double g[2] = {0, 0};
    double largest = 0;
    cube_chord(cell, &from, &to, chord);
    for (int i = 1; i + 1 < cell->count; i++) {
        const double *u = cell->at[i];
        const double *v = cell->at[i + 1];
        double gu = 0;
        double gv = 0;
        for (int k = 0; k < 3; k++) {
            gu += chord[k] * (cell->normal[i][k] - cell->normal[0][k]);
            gv += chord[k] * (cell->normal[i + 1][k] - cell->normal[0][k]);
        }
        if (u[0] * v[1] - u[1] * v[0] > largest) {
            largest = u[0] * v[1] - u[1] * v[0];
            g[0] = gu * v[1] - gv * u[1];
            g[1] = gv * u[0] - gu * v[0];
        }
    }
    const double *p = cell->at[CORNERS / 2];
    for (int i = 0; i < cell->count; i++) {
        const double *at = cell->at[i];
        level[i] = cell->count == CORNERS
                       ? p[0] * at[1] - p[1] * at[0]
                       : g[0] * (at[0] - 0.5 * (cell->at[from][0] + cell->at[to][0])) +
                             g[1] * (at[1] - 0.5 * (cell->at[from][1] + cell->at[to][1]));
        below |= level[i] < 0;
    }
    return below;
}

/* Both halves; the second one is nearer to the laser. */
static void cube_halve(const cube_cell *cell, cube_cell half[2])
{
    double level[CORNERS];
    int parts = cube_levels(cell, level);
    for (int h = 0; h < 2; h++) {
        half[h] =
            (cube_cell){.unit = cell->unit, .skipped = cell->skipped, .depth = cell->depth + 1};
        half[h].trusted = cell->trusted;
        half[h].rule_err = 1;
        if (h == 0 || parts) {
            cube_cut(cell, level, h == 0 ? 1 : -1, &half[h]);
        }
        cube_finish(&half[h]);
    }
    if (half[0].theta < half[1].theta) {
        cube_cell other = half[0];
        half[0] = half[1];
        half[1] = other;
    }
}

/* The halves of both halves, with the values of the rule. */
static void cube_quarter(const lrcsi_cubature *sum, const cube_cell *cell, cube_cell quarter[4])
{
    cube_cell half[2];
    cube_halve(cell, half);
    cube_halve(&half[0], &quarter[0]);
    cube_halve(&half[1], &quarter[2]);
    for (int i = 0; i < 4; i++) {
        quarter[i].value = rule_value(sum, &quarter[i]);
    }
}

/* Adds the value of a cell to the sum. */
static void sum_keep(lrcsi_cubature *sum, const cube_cell *cell)
{
    lrcsi_sum_add(&sum->glint, cell->value.glint);
    lrcsi_sum_add(&sum->diffuse, cell->value.diffuse);
    sum->rounding += cell->value.rounding;
    lrcsi_sum_add(&sum->glint_u, cell->value.glint_u);
    lrcsi_sum_add(&sum->diffuse_log, cell->value.diffuse_log);
    lrcsi_sum_add(&sum->weighted, cell->value.weighted);
}

/* The length of the shortest normal at a corner. */
static double cube_shortest(const cube_cell *cell)
{
    double shortest = HUGE_VAL;
    for (int i = 0; i < cell->count; i++) {
        shortest = lrcsi_min(shortest, sqrt(lrcsi_vec3_dot(cell->normal[i], cell->normal[i])));
    }
    return shortest;
}

/* An upper bound of f_r cos in the cone of the corners' normals, each with an error of at most
   position_err. */
static double cube_upper_bound(const lrcsi_cubature *sum, const cube_cell *cell)
{
    double err = 2 * sum->position_err / cube_shortest(cell);
    double turn = err <= 1 ? cube_turn(cell) + err : LRCS_PI;
    lrcsi_reflection bound = lrcsi_reflect_bound(sum->brdf, cell->theta, turn);
    return bound.glint + bound.diffuse;
}

/* An upper bound of the integral over a cell, and of the value of the rule on it. */
static double cube_integral_bound(const lrcsi_cubature *sum, const cube_cell *cell)
{
    double area_err = 0;
    for (int i = 1; i + 1 < cell->count; i++) {
        area_err += fan_area_err(cell, i);
    }
    return (cube_area(cell) + cell->unit * area_err) * cube_upper_bound(sum, cell);
}

/* Adds the error of a cell that is not accurate enough and is not divided further: its estimate, or
   the bound if it is not divided because no steps are left. */
static void sum_add_error(lrcsi_cubature *sum, double bound, double estimate)
{
    if (lrcsi_meter_spent(sum->meter)) {
        sum->unresolved += bound;
    } else {
        sum->estimate += estimate;
    }
}

/* Adds four quarters if their sum agrees with the value on the whole cell, or if they must be
   added. Returns 0 if they are not added. */
static int quarters_keep(lrcsi_cubature *sum, const cube_cell *cell, const cube_cell quarter[4],
                         int must)
{
    cube_value all = {0, 0, 0, 0, 0, 0};
    for (int i = 0; i < 4; i++) {
        value_add(&all, 1, &quarter[i].value);
    }
    double area = cube_area(cell);
    double difference =
        fabs(all.glint - cell->value.glint) + fabs(all.diffuse - cell->value.diffuse);
    if (sum->weight) { /* also of the weighted integral, relative to the largest weight */
        const double *w = sum->weight;
        double largest = lrcsi_max(fabs(w[0]), lrcsi_max(fabs(w[1]), fabs(w[2])));
        double weighted = fabs(all.weighted - cell->value.weighted);
        difference = largest > 0 ? lrcsi_max(difference, weighted / largest) : difference;
    }
    double sum_so_far = lrcsi_sum_value(&sum->glint) + lrcsi_sum_value(&sum->diffuse);
    double allowed = sum->tolerance * (all.glint + all.diffuse + sum_so_far * (area / sum->area));
    int agree = difference <= allowed + negligible_below(sum) * area;
    if (!must && !agree) {
        return 0;
    }
    double estimate = difference + cell->skipped * area;
    if (agree) {
        sum->estimate += estimate;
    } else {
        sum_add_error(sum, cube_integral_bound(sum, cell), estimate);
    }
    for (int i = 0; i < 4; i++) {
        sum_keep(sum, &quarter[i]);
    }
    return 1;
}

/* One cell: it is added to the sum, or divided into `part`. Returns how many parts there are. */
static uint32_t cube_step(lrcsi_cubature *sum, cube_cell *cell, int may_divide, cube_cell part[4])
{
    if (!cell->trusted) {
        cube_trust(sum, cell);
    }
    double area = cube_area(cell);
    double value = cell->value.glint + cell->value.diffuse;
    if (cell->trusted &&
        cell->rule_err * value <= sum->tolerance * value + negligible_below(sum) * area) {
        sum_keep(sum, cell);
        sum->estimate += cell->rule_err * value + cell->skipped * area;
        return 0;
    }
    if (cell->trusted) {
        cube_quarter(sum, cell, part);
        return quarters_keep(sum, cell, part, !may_divide) ? 0 : 4;
    }
    if (may_divide) {
        cube_halve(cell, part);
        return 2;
    }
    double bound = cube_integral_bound(sum, cell);
    cell->value = rule_value(sum, cell);
    sum_keep(sum, cell);
    sum_add_error(sum, bound, bound);
    return 0;
}

/* Adds a cell and all cells into which it is divided. The first one may always be divided; once the
   meter is spent, no other is. */
static void cells_add(lrcsi_cubature *sum, cube_cell first)
{
    cube_cell part[4];
    uint32_t top = 0;
    cube_finish(&first);
    sum->stack[top++] = first;
    while (top > 0) {
        cube_cell cell = sum->stack[--top];
        int left = lrcsi_meter_take(sum->meter, CELL_STEPS);
        int may_divide =
            cell.depth == 0 || (left && cell.depth + 2 <= HALVINGS_MAX && sum->splits < SPLITS_MAX);
        uint32_t parts = cube_step(sum, &cell, may_divide, part);
        sum->splits += parts;
        for (uint32_t i = 0; i < parts; i++) {
            if (part[i].count >= 3 && cube_area(&part[i]) > 0) {
                sum->stack[top++] = part[i];
            }
        }
    }
}

/* --- triangles -------------------------------------------------------------------------------- */

/* A triangle as a cell. Given: its normals; the values of the caller's linear function at its
   corners (NULL: 0); its area. */
static cube_cell cube_of(const double normal[3][3], const double weight[3], double area)
{
    static const double at[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    cube_cell cell = {.unit = 2 * area};
    for (int i = 0; i < 3; i++) {
        corner_add(&cell, normal[i], at[i], weight ? weight[i] : 0);
    }
    return cell;
}

size_t lrcsi_cubature_need(void)
{
    return lrcsi_work_bytes(STACK_CELLS, sizeof(cube_cell));
}

lrcsi_cubature_cell *lrcsi_cubature_stack(lrcs_work *work)
{
    return lrcsi_work_take(work, STACK_CELLS, sizeof(cube_cell));
}

lrcsi_cubature lrcsi_cubature_make(const lrcs_brdf *brdf, const double normal[3][3],
                                   double tolerance, lrcsi_cubature_cell *stack)
{
    lrcsi_cubature sum = {.brdf = brdf, .tolerance = tolerance, .stack = stack};
    cube_cell cell = cube_of(normal, NULL, 0);
    cube_measure(&cell);
    sum.upper_bound = lrcsi_reflect_bound(brdf, cell.theta, cube_turn(&cell) + 0x1p-40);
    double farthest = cell.theta + cube_turn(&cell);
    sum.diffuse_min =
        farthest < LRCS_PI / 2 ? brdf->B * lrcsi_power(lrcsi_log(cos(farthest)), brdf->m + 1) : 0;
    sum.negligible = NEGLIGIBLE * tolerance *
                     (sum.upper_bound.glint * lrcsi_min(1, brdf->s * brdf->s) +
                      sum.upper_bound.diffuse / (brdf->m + 1));
    sum.negligible = lrcsi_max(sum.negligible, TERM_MIN * (brdf->A + brdf->B));
    return sum;
}

/* A bound, per area, on what is missed where a normal faces the laser and its computed value, with
   an error of position_err, does not. The angle of such a normal to the plane n . s_hat = 0 is at
   highest position_err over its length, which is at lowest that of the shortest corner normal times
   the cosine of the turn. */
static double unlit_position_err(const lrcsi_cubature *sum, const cube_cell *whole)
{
    double lowest = HUGE_VAL;
    double highest = -HUGE_VAL;
    for (int i = 0; i < 3; i++) {
        lowest = lrcsi_min(lowest, whole->normal[i][2]);
        highest = lrcsi_max(highest, whole->normal[i][2]);
    }
    if (lowest > sum->position_err || highest < -sum->position_err) {
        return 0;
    }
    double turn = cube_turn(whole);
    double length = turn < LRCS_PI / 2 ? cube_shortest(whole) * cos(turn) : 0;
    double err = 2 * sum->position_err / length;
    lrcsi_reflection seen = lrcsi_reflect_bound(sum->brdf, LRCS_PI / 2, err <= 1 ? err : LRCS_PI);
    return seen.glint + seen.diffuse;
}

void lrcsi_cubature_add(lrcsi_cubature *sum, const double normal[3][3], double area)
{
    double level[CORNERS] = {0};
    cube_cell whole = cube_of(normal, sum->weight, area);
    cube_cell lit = {.unit = whole.unit};
    if (!(area > 0)) {
        return;
    }
    for (int i = 0; i < 3; i++) {
        level[i] = normal[i][2];
    }
    cube_cut(&whole, level, 1, &lit);
    sum->rounding += area * unlit_position_err(sum, &whole);
    if (lit.count < 3) {
        return;
    }
    lrcsi_cubature start = *sum;
    cells_add(sum, lit);
    while (sum->splits >= SPLITS_MAX && start.tolerance < COARSE_MAX) {
        start.tolerance *= COARSER;
        *sum = start;
        cells_add(sum, lit);
    }
}
