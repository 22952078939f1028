/* SPDX-License-Identifier: MIT */
/* Adaptive cubature of f_r cos(theta) over a triangle of interpolated normals. It decides where to
   look closer and when to stop; over which triangles the integral goes, and which area they have,
   the caller says.

   Normals are linear in position, so the part with n . s_hat > 0 is the triangle less a half-plane,
   cut off first; inside it the integrand is analytic, but may peak in a small fraction of the
   triangle, or outside of it. A cell (a convex polygon) is halved by a line across the direction in
   which its normals turn most, the half nearer to the laser done first, so that the peak, if there
   is one, is in the sum before what surrounds it.
   - A rule is trusted only where the normals turn by less than the peaks are wide (of the glint
     s cos^2 theta, of the diffuse part 1 / sqrt(m + 1)) and than their flanks take for a few powers
     of e: no peak can then hide from the rule, nor a flank from the comparison below. Elsewhere a
     cell is halved unheard, unless the most that such a part reaches in it (a proved bound) is
     nothing to what the sum and its estimate have, or are sure to get.
   - There the rule of degree 5 on 7 points (Radon 1948) is compared with itself on four quarters,
   the halves of both halves: between them every direction in which the normals turn much is halved,
     which one halving does not do. The difference is the estimate; being the error of the coarser,
     it is some ten to sixty times that of what is kept.
   - Where the normals turn by less than a small part p of those widths, and of the way to the dark
     edge, the rule alone serves: its error is of the order of p^6, which then is the estimate; p^5
     where a linear function of the caller's is integrated too.
   Where halvings run out, the bound on the cell stands as the estimate. Where cells run out, the
   triangle is done again to a coarser tolerance: all of it a little coarse beats a part untouched.
   Where steps run out, cells that should be divided are left as they are, and what that may cost is
   a bound and no estimate. */
#include "integrate/cubature.h"

#include <math.h>

#include "base/constant.h"
#include "base/elementary.h"
#include "base/range.h"
#include "base/vec3.h"
#include "base/work.h"

/* Halvings of a cell, and cells of one sum but for those that each triangle is granted. A
   quartering leaves three cells more waiting, for two halvings. */
#define MOST_HALVINGS 64u
#define PARTS_WAITING (3 * MOST_HALVINGS / 2 + 4)
/* Corners of a cell: one with so many is halved along a diagonal, which leaves fewer. */
#define CORNERS     8
#define MOST_SPLITS (1u << 15)
/* By how much the tolerance grows where cells run out, and until when. */
#define COARSER     100
#define MOST_COARSE 1e-2
/* Steps that a part takes: quarters, the rule on each, bounds. */
#define PART_STEPS 256
/* No cell's normals turn by more than this (rad) where a rule is trusted. */
#define MOST_TURN 0.5
/* Of the tolerance: what stays below this, relative to what a peak of the most and of the BRDF's
   own width would add over a radian, is nothing. It goes to the estimate all the same. */
#define NOTHING 0x1p-20
/* Of A and B: bounds on what underflows end here (optics/deviation.c), and nothing less can be
 * told. */
#define LEAST_TOLD 0x1p-1008
/* Beyond this tan^2 the laser is as good as in the plane. */
#define MOST_TAN2 1e300

/* A rule's sum over a cell. */
typedef struct cube_value {
    double glint, diffuse, rounding;
    double glint_u, diffuse_log; /* moments, where wanted */
    double weighted;             /* times the caller's linear function, 0 without one */
} cube_value;

/* A convex polygon. Positions are relative to the first corner, so that they stay good to a few u
   of the cell's size however small it is. */
struct lrcsi_cubature_cell {
    double normal[CORNERS][3], at[CORNERS][2], weight[CORNERS];
    int count;
    double unit;    /* area of the square of positions */
    double theta;   /* from the mean of its corners' normals to the laser */
    double unheard; /* bound on a glint that no rule need find, per area */
    uint32_t depth;
    int trusted;  /* the rule may be: `value` is its sum */
    double rough; /* relative error of that where it is small enough to go by, else 1 */
    cube_value value;
};
typedef struct lrcsi_cubature_cell cube_cell;

/* --- the rule --------------------------------------------------------------------------------- */

/* By how much the parts may move where the normal is off by d. Their logarithms fall with theta by
   at most t (5 + 2 (1 + t^2)/s^2) and (m + 1) t, t = tan(theta), both growing with t; tan(theta +
   d)
   <= t + 2 d (1 + t^2) for d t <= 1/2; e^x - 1 <= 2 x for x <= 1/4. Where a part may move by more,
   all that is known is the most that it reaches near by. */
static double node_position_err(const lrcsi_cubature *sum, double u, double d, const cube_value *at)
{
    const lrcs_brdf *brdf = sum->brdf;
    double t = sqrt(u) + 2 * d * (1 + u);
    double steep = brdf->A > 0 ? d * t * (5 + 2 * ((1 + t * t) / brdf->s) / brdf->s) : 0;
    double flat = d * t * (brdf->m + 1);
    if (steep <= 0.25 && flat <= 0.25) {
        return 2 * (at->glint * steep + at->diffuse * flat);
    }
    lrcsi_reflection most = lrcsi_reflect_most(brdf, atan(sqrt(u)), 2 * d);
    return (steep <= 0.25 ? 2 * at->glint * steep : most.glint) +
           (flat <= 0.25 ? 2 * at->diffuse * flat : most.diffuse);
}

/* f_r cos at one normal. Rounding: lrcsi_reflect's own, and a square root and a product; tan^2 is
   good to 6 u, which is at most 2 u in theta and part of the position error. */
static cube_value node_value(const lrcsi_cubature *sum, const double n[3])
{
    cube_value at = {0, 0, 0, 0, 0, 0};
    if (!(n[2] > 0)) {
        return at;
    }
    double u = lrcsi_least(MOST_TAN2, (n[0] * n[0] + n[1] * n[1]) / n[2] / n[2]);
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

/* What rounding may add to the area of the triangle of corners 0, i and i + 1, in units of the
   cell's: positions lose 2 u of the cell's size at every halving, the area that times the size, and
   4 u itself. */
static double fan_slack(const cube_cell *cell, int i)
{
    const double *u = cell->at[i];
    const double *v = cell->at[i + 1];
    return 8 * LRCSI_U * (1 + cell->depth) *
           (u[0] * u[0] + u[1] * u[1] + v[0] * v[0] + v[1] * v[1]);
}

/* The rule over the triangle of corners 0, i and i + 1: centroid 9/40; points (a, a, 1 - 2 a) and
   turned, a = (6 -+ sqrt 15)/21, (155 -+ sqrt 15)/1200. Weights and sums are good to 16 u. */
static void rule_add(const lrcsi_cubature *sum, const cube_cell *cell, int i, cube_value *value)
{
    static const double rule[3][3] = {
        {1.0 / 3, 1.0 / 3, 0.225},
        {0.10128650732345633880, 0.79742698535308732240, 0.12593918054482715260},
        {0.47014206410511508977, 0.05971587178976982046, 0.13239415278850618074}};
    const double *u = cell->at[i];
    const double *v = cell->at[i + 1];
    double area = 0.5 * (u[0] * v[1] - u[1] * v[0]);
    double slack = fan_slack(cell, i);
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
    value->rounding += cell->unit * slack * (mean.glint + mean.diffuse);
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
    return lrcsi_most(0, cell->unit * area);
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

/* The largest angle from the mean normal to one of the cell's: to a corner's where that is
   less than a right angle, since such a circle that holds the corners holds their triangle. */
static double cube_turn(const cube_cell *cell)
{
    double n[3];
    double most = 0;
    cube_mean(cell, n);
    for (int i = 0; i < cell->count; i++) {
        const double *m = cell->normal[i];
        double dot = lrcsi_vec3_dot(n, m);
        double cross[3];
        lrcsi_vec3_cross(n, m, cross);
        most = lrcsi_most(most, dot > 0 ? sqrt(lrcsi_vec3_dot(cross, cross)) / dot : HUGE_VAL);
    }
    return isfinite(most) ? atan(most) * (1 + 4 * LRCSI_U) + 16 * LRCSI_U : LRCSI_PI;
}

/* An error of f_r cos that nobody looks for. */
static double negligible_below(const lrcsi_cubature *sum)
{
    return lrcsi_most(sum->negligible, sum->tolerance * sum->had);
}

/* Decides whether a rule may be trusted with the cell, or never hear of its glint. */
static void cube_trust(const lrcsi_cubature *sum, cube_cell *cell)
{
    const lrcs_brdf *brdf = sum->brdf;
    double turn = cube_turn(cell);
    double cosine = cos(cell->theta);
    double t = fabs(tan(cell->theta));
    double wide = brdf->s * cosine * cosine * lrcsi_least(1, 2 * brdf->s / t);
    double steep = (brdf->m + 1) * lrcsi_least(1, t);
    int glint = !(brdf->A > 0) || turn <= wide;
    int glint_near = glint;
    int diffuse = !(brdf->B > 0) || (turn * turn * (brdf->m + 1) <= 1 && turn * steep <= 4);
    cell->unheard = 0;
    if (turn <= MOST_TURN && !(glint && diffuse)) {
        lrcsi_reflection most = lrcsi_reflect_most(brdf, cell->theta, turn);
        cell->unheard = (glint ? 0 : most.glint) + (diffuse ? 0 : most.diffuse);
        double had = lrcsi_sum_value(&sum->glint) + lrcsi_sum_value(&sum->diffuse) + sum->estimate;
        double scale = lrcsi_most(had, sum->least * sum->whole);
        glint = diffuse = cell->unheard <= negligible_below(sum) ||
                          cell->unheard * sum->whole <= sum->tolerance * scale;
    }
    cell->trusted = turn <= MOST_TURN && diffuse && glint;
    double part = lrcsi_most(turn * sqrt(brdf->m + 1), 0.25 * turn * (brdf->m + 1) * t);
    part = lrcsi_most(part, brdf->A > 0 && glint_near ? turn / wide : 0);
    double fifth = part * part * part * part * part;
    cell->rough = part < 1 ? fifth * (sum->weight ? 1 : part) : 1;
    if (cell->trusted) {
        cell->value = rule_value(sum, cell);
    }
}

/* The direction in which normals turn most: from corner *from to corner *to, the chord between
   their normals of length 1. */
static void cube_chord(const cube_cell *cell, int *from, int *to, double chord[3])
{
    double unit[CORNERS][3];
    double most = -1;
    for (int i = 0; i < cell->count; i++) {
        double length = sqrt(lrcsi_vec3_dot(cell->normal[i], cell->normal[i]));
        for (int k = 0; k < 3; k++) {
            unit[i][k] = length > 0 ? cell->normal[i][k] / length : 0;
        }
        for (int j = 0; j < i; j++) {
            double apart[3] = {unit[i][0] - unit[j][0], unit[i][1] - unit[j][1],
                               unit[i][2] - unit[j][2]};
            if (lrcsi_vec3_dot(apart, apart) > most) {
                most = lrcsi_vec3_dot(apart, apart);
                *from = j;
                *to = i;
                for (int k = 0; k < 3; k++) {
                    chord[k] = apart[k];
                }
            }
        }
    }
}

/* A convex cell never has too many; one that rounding has dented loses a sliver of its rim. */
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

/* The part of a cell with level >= 0, `sign` 1, or <= 0, -1; the level is linear in position. */
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
            double share = here / (here - there);
            double normal[3];
            double at[2];
            for (int k = 0; k < 3; k++) {
                normal[k] = cell->normal[i][k] + share * (cell->normal[j][k] - cell->normal[i][k]);
            }
            for (int k = 0; k < 2; k++) {
                at[k] = cell->at[i][k] + share * (cell->at[j][k] - cell->at[i][k]);
            }
            corner_add(part, normal, at,
                       cell->weight[i] + share * (cell->weight[j] - cell->weight[i]));
        }
    }
}

/* Positions relative to the first corner, and the angle to the laser. */
static void cube_settle(cube_cell *cell)
{
    for (int i = cell->count - 1; i >= 0; i--) {
        cell->at[i][0] -= cell->at[0][0];
        cell->at[i][1] -= cell->at[0][1];
    }
    cube_measure(cell);
}

/* The direction in position along which the component of the normals along `chord` grows, from the
   largest triangle of the fan; of any length. */
static void cube_gradient(const cube_cell *cell, const double chord[3], double gradient[2])
{
    double most = 0;
    gradient[0] = gradient[1] = 0;
    for (int i = 1; i + 1 < cell->count; i++) {
        const double *u = cell->at[i];
        const double *v = cell->at[i + 1];
        double gu = 0;
        double gv = 0;
        for (int k = 0; k < 3; k++) {
            gu += chord[k] * (cell->normal[i][k] - cell->normal[0][k]);
            gv += chord[k] * (cell->normal[i + 1][k] - cell->normal[0][k]);
        }
        if (u[0] * v[1] - u[1] * v[0] > most) {
            most = u[0] * v[1] - u[1] * v[0];
            gradient[0] = gu * v[1] - gv * u[1];
            gradient[1] = gv * u[0] - gu * v[0];
        }
    }
}

/* Levels whose zero halves a cell; 0 if none of it is below, as where no normal turns. They are
   linear in position, so that areas add up whatever rounding does to normals: across the largest
   turn, midway, or where the cell has corners enough, along a diagonal. */
static int cube_levels(const cube_cell *cell, double level[CORNERS])
{
    int from = 0;
    int to = 0;
    int below = 0;
    double chord[3] = {0, 0, 0};
    double g[2];
    cube_chord(cell, &from, &to, chord);
    cube_gradient(cell, chord, g);
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

/* Both halves, the one nearer to the laser second. */
static void cube_halve(const cube_cell *cell, cube_cell half[2])
{
    double level[CORNERS];
    int parts = cube_levels(cell, level);
    for (int h = 0; h < 2; h++) {
        half[h] =
            (cube_cell){.unit = cell->unit, .unheard = cell->unheard, .depth = cell->depth + 1};
        half[h].trusted = cell->trusted;
        half[h].rough = 1;
        if (h == 0 || parts) {
            cube_cut(cell, level, h == 0 ? 1 : -1, &half[h]);
        }
        cube_settle(&half[h]);
    }
    if (half[0].theta < half[1].theta) {
        cube_cell other = half[0];
        half[0] = half[1];
        half[1] = other;
    }
}

/* The halves of both halves, with the rule's sums. */
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

static void sum_keep(lrcsi_cubature *sum, const cube_cell *cell)
{
    lrcsi_sum_add(&sum->glint, cell->value.glint);
    lrcsi_sum_add(&sum->diffuse, cell->value.diffuse);
    sum->rounding += cell->value.rounding;
    lrcsi_sum_add(&sum->glint_u, cell->value.glint_u);
    lrcsi_sum_add(&sum->diffuse_log, cell->value.diffuse_log);
    lrcsi_sum_add(&sum->weighted, cell->value.weighted);
}

static double cube_shortest(const cube_cell *cell)
{
    double shortest = HUGE_VAL;
    for (int i = 0; i < cell->count; i++) {
        shortest = lrcsi_least(shortest, sqrt(lrcsi_vec3_dot(cell->normal[i], cell->normal[i])));
    }
    return shortest;
}

/* The most that f_r cos reaches in the cone of the corners' normals, each off by the position
 * error. */
static double cube_peak(const lrcsi_cubature *sum, const cube_cell *cell)
{
    double off = 2 * sum->position_err / cube_shortest(cell);
    double turn = off <= 1 ? cube_turn(cell) + off : LRCSI_PI;
    lrcsi_reflection most = lrcsi_reflect_most(sum->brdf, cell->theta, turn);
    return most.glint + most.diffuse;
}

/* The most that a cell may hold, and that the rule may find there. */
static double cube_most(const lrcsi_cubature *sum, const cube_cell *cell)
{
    double slack = 0;
    for (int i = 1; i + 1 < cell->count; i++) {
        slack += fan_slack(cell, i);
    }
    return (cube_area(cell) + cell->unit * slack) * cube_peak(sum, cell);
}

/* What a cell that should be divided and is not may be off by: a guess or, where it is for want of
   steps, the most. */
static void sum_leave(lrcsi_cubature *sum, double most, double guess)
{
    if (lrcsi_meter_spent(sum->meter)) {
        sum->left += most;
    } else {
        sum->estimate += guess;
    }
}

/* A cell that no rule is good for, and that is not divided further. */
static void cube_give_up(lrcsi_cubature *sum, cube_cell *cell)
{
    double most = cube_most(sum, cell);
    cell->value = rule_value(sum, cell);
    sum_keep(sum, cell);
    sum_leave(sum, most, most);
}

/* Keeps the quarters where they agree with the whole, or must. 0: they are not kept. */
static int quarters_keep(lrcsi_cubature *sum, const cube_cell *cell, const cube_cell quarter[4],
                         int must)
{
    cube_value all = {0, 0, 0, 0, 0, 0};
    for (int i = 0; i < 4; i++) {
        value_add(&all, 1, &quarter[i].value);
    }
    double area = cube_area(cell);
    double off = fabs(all.glint - cell->value.glint) + fabs(all.diffuse - cell->value.diffuse);
    if (sum->weight) { /* the integral with the weight, relative to its largest value */
        const double *w = sum->weight;
        double largest = lrcsi_most(fabs(w[0]), lrcsi_most(fabs(w[1]), fabs(w[2])));
        double moved = fabs(all.weighted - cell->value.weighted);
        off = largest > 0 ? lrcsi_most(off, moved / largest) : off;
    }
    double had = lrcsi_sum_value(&sum->glint) + lrcsi_sum_value(&sum->diffuse);
    double most = sum->tolerance * (all.glint + all.diffuse + had * (area / sum->whole));
    int agree = off <= most + negligible_below(sum) * area;
    if (!must && !agree) {
        return 0;
    }
    double guess = off + cell->unheard * area;
    if (agree) {
        sum->estimate += guess;
    } else {
        sum_leave(sum, cube_most(sum, cell), guess);
    }
    for (int i = 0; i < 4; i++) {
        sum_keep(sum, &quarter[i]);
    }
    return 1;
}

/* One cell: kept, or parted into `part`. Returns into how many. */
static uint32_t cube_step(lrcsi_cubature *sum, cube_cell *cell, int may_part, cube_cell part[4])
{
    if (!cell->trusted) {
        cube_trust(sum, cell);
    }
    double area = cube_area(cell);
    double value = cell->value.glint + cell->value.diffuse;
    if (cell->trusted &&
        cell->rough * value <= sum->tolerance * value + negligible_below(sum) * area) {
        sum_keep(sum, cell);
        sum->estimate += cell->rough * value + cell->unheard * area;
        return 0;
    }
    if (cell->trusted) {
        cube_quarter(sum, cell, part);
        return quarters_keep(sum, cell, part, !may_part) ? 0 : 4;
    }
    if (may_part) {
        cube_halve(cell, part);
        return 2;
    }
    cube_give_up(sum, cell);
    return 0;
}

/* A triangle may always be parted once; what is left when the meter is spent, no more. */
static void cells_add(lrcsi_cubature *sum, cube_cell first)
{
    cube_cell part[4];
    uint32_t top = 0;
    cube_settle(&first);
    sum->waiting[top++] = first;
    while (top > 0) {
        cube_cell cell = sum->waiting[--top];
        int left = lrcsi_meter_take(sum->meter, PART_STEPS);
        int may_part = cell.depth == 0 ||
                       (left && cell.depth + 2 <= MOST_HALVINGS && sum->splits < MOST_SPLITS);
        uint32_t parts = cube_step(sum, &cell, may_part, part);
        sum->splits += parts;
        for (uint32_t i = 0; i < parts; i++) {
            if (part[i].count >= 3 && cube_area(&part[i]) > 0) {
                sum->waiting[top++] = part[i];
            }
        }
    }
}

/* --- triangles -------------------------------------------------------------------------------- */

/* A triangle of that area, with the values of a linear function at its corners (NULL: 0). */
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
    return lrcsi_work_bytes(PARTS_WAITING, sizeof(cube_cell));
}

lrcsi_cubature_cell *lrcsi_cubature_cells(lrcs_work *work)
{
    return lrcsi_work_take(work, PARTS_WAITING, sizeof(cube_cell));
}

lrcsi_cubature lrcsi_cubature_make(const lrcs_brdf *brdf, const double normal[3][3],
                                   double tolerance, lrcsi_cubature_cell *waiting)
{
    lrcsi_cubature sum = {.brdf = brdf, .tolerance = tolerance, .waiting = waiting};
    cube_cell cell = cube_of(normal, NULL, 0);
    cube_measure(&cell);
    sum.most = lrcsi_reflect_most(brdf, cell.theta, cube_turn(&cell) + 0x1p-40);
    double far = cell.theta + cube_turn(&cell);
    sum.least = far < LRCSI_PI / 2 ? brdf->B * lrcsi_power(lrcsi_log(cos(far)), brdf->m + 1) : 0;
    sum.negligible =
        NOTHING * tolerance *
        (sum.most.glint * lrcsi_least(1, brdf->s * brdf->s) + sum.most.diffuse / (brdf->m + 1));
    sum.negligible = lrcsi_most(sum.negligible, LEAST_TOLD * (brdf->A + brdf->B));
    return sum;
}

/* What may be missed, per area, where normals that are off by the position error face the laser and
   do not seem to: those are off the plane by no more than the position error over their length,
   which is at least the shortest corner's times the cosine of the turn. */
static double dark_position_err(const lrcsi_cubature *sum, const cube_cell *whole)
{
    double least = HUGE_VAL;
    double most = -HUGE_VAL;
    for (int i = 0; i < 3; i++) {
        least = lrcsi_least(least, whole->normal[i][2]);
        most = lrcsi_most(most, whole->normal[i][2]);
    }
    if (least > sum->position_err || most < -sum->position_err) {
        return 0;
    }
    double turn = cube_turn(whole);
    double length = turn < LRCSI_PI / 2 ? cube_shortest(whole) * cos(turn) : 0;
    double off = 2 * sum->position_err / length;
    lrcsi_reflection seen = lrcsi_reflect_most(sum->brdf, LRCSI_PI / 2, off <= 1 ? off : LRCSI_PI);
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
    sum->rounding += area * dark_position_err(sum, &whole);
    if (lit.count < 3) {
        return;
    }
    lrcsi_cubature start = *sum;
    cells_add(sum, lit);
    while (sum->splits >= MOST_SPLITS && start.tolerance < MOST_COARSE) {
        start.tolerance *= COARSER;
        *sum = start;
        cells_add(sum, lit);
    }
}
