/* SPDX-License-Identifier: MIT */
/* Adaptive cubature of f_r cos(theta) over a triangle of interpolated normals. It decides where to
   look closer and when to stop; over which triangles the integral goes, and which area they have,
   the caller says.

   Normals are linear in position, so the part with n . s_hat > 0 is the triangle less a half-plane,
   cut off first; inside it the integrand is analytic, but may peak in a small fraction of the
   triangle, or outside of it. A cell (a triangle of normals) is halved across the side over which
   its normals turn most, the half nearer to the laser done first, so that the peak, if there is
   one, is in the sum before what surrounds it.
   - A rule is trusted only where the normals turn by less than the peaks are wide (of the glint
     s cos^2 theta, of the diffuse part 1 / sqrt(m + 1)): no peak can then hide from its centroid,
     nor a flank from the comparison below. Elsewhere a cell is halved unheard, unless the most that
     the glint reaches in it (a proved bound) is nothing to what the sum and its estimate have.
   - There the rule of degree 5 on 7 points (Radon 1948) is compared with itself on four quarters,
   the halves of both halves: between them every direction in which the normals turn much is halved,
     which one halving does not do. The difference is the estimate; being the error of the coarser,
     it is some ten to sixty times that of what is kept.
   Where halvings run out, the bound on the cell stands as the estimate. */
#include "integrate/cubature.h"

#include <math.h>

#include "base/range.h"

#define U 0x1p-53

/* Halvings of a cell, and cells of one sum but for those that each triangle is granted. A
   quartering leaves three cells more on the stack, for two halvings. */
#define MOST_HALVINGS 64u
#define STACK_SIZE    (3 * MOST_HALVINGS / 2 + 4)
#define MOST_SPLITS   (1u << 17)
/* No cell's normals turn by more than this (rad) where a rule is trusted. */
#define MOST_TURN 0.5
#define HALF_TURN 3.14159265358979323846
/* A glint below this is nothing, whatever else there is. */
#define NO_GLINT 0x1p-900
/* Beyond this tan^2 the laser is as good as in the plane. */
#define MOST_TAN2 1e300

/* A rule's sum over a cell. */
typedef struct cube_value {
    double glint, diffuse, rounding;
} cube_value;

typedef struct cube_cell {
    double normal[3][3];
    double area;
    double theta;   /* from its centroid's normal to the laser */
    double unheard; /* bound on a glint that no rule need find, per area */
    uint32_t depth;
    int trusted; /* the rule may be: `value` is its sum */
    cube_value value;
} cube_cell;

/* --- the rule --------------------------------------------------------------------------------- */

/* By how much the parts may move where the normal is off by d. Their logarithms fall with theta by
   at most t (5 + 2 (1 + t^2)/s^2) and (m + 1) t, t = tan(theta), both growing with t; tan(theta +
   d)
   <= t + 2 d (1 + t^2) for d t <= 1/2; e^x - 1 <= 2 x for x <= 1/4. Where a part may move by more,
   all that is known is the most that it reaches near by. */
static double node_slip(const lrcsi_cubature *sum, double u, double d, const cube_value *at)
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
   good to 6 u, which is at most 2 u in theta and part of the slip. */
static cube_value node_value(const lrcsi_cubature *sum, const double n[3])
{
    cube_value at = {0, 0, 0};
    if (!(n[2] > 0)) {
        return at;
    }
    double u = lrcsi_least(MOST_TAN2, (n[0] * n[0] + n[1] * n[1]) / n[2] / n[2]);
    lrcsi_reflection reflection = lrcsi_reflect(sum->brdf, u, 0);
    double secant = sqrt(1 + u);
    at.glint = reflection.glint * secant;
    at.diffuse = reflection.diffuse * secant;
    at.rounding = reflection.error * secant + 4 * U * (at.glint + at.diffuse) +
                  node_slip(sum, u, sum->slip / (n[2] * secant), &at);
    return at;
}

static void value_add(cube_value *sum, double weight, const cube_value *value)
{
    sum->glint += weight * value->glint;
    sum->diffuse += weight * value->diffuse;
    sum->rounding += weight * value->rounding;
}

/* The rule over a cell: centroid 9/40; points (a, a, 1 - 2 a) and turned, a = (6 -+ sqrt 15)/21,
   (155 -+ sqrt 15)/1200. Weights and sums are good to 16 u. */
static cube_value rule_value(const lrcsi_cubature *sum, const cube_cell *cell)
{
    static const double rule[3][3] = {
        {1.0 / 3, 1.0 / 3, 0.225},
        {0.10128650732345633880, 0.79742698535308732240, 0.12593918054482715260},
        {0.47014206410511508977, 0.05971587178976982046, 0.13239415278850618074}};
    cube_value value = {0, 0, 0};
    for (int i = 0; i < 7; i++) {
        const double *node = rule[(i + 2) / 3]; /* the centroid once, the others three times */
        int odd = (i + 2) % 3;
        double n[3];
        for (int k = 0; k < 3; k++) {
            n[k] = node[odd == 0] * cell->normal[0][k] + node[odd == 1] * cell->normal[1][k] +
                   node[odd == 2] * cell->normal[2][k];
        }
        cube_value at = node_value(sum, n);
        value_add(&value, node[2] * cell->area, &at);
    }
    value.rounding += 16 * U * (value.glint + value.diffuse);
    return value;
}

/* --- cells ------------------------------------------------------------------------------------ */

static double square_of(const double v[3])
{
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
}

static void cell_centroid(const cube_cell *cell, double n[3])
{
    for (int k = 0; k < 3; k++) {
        n[k] = (cell->normal[0][k] + cell->normal[1][k] + cell->normal[2][k]) / 3;
    }
}

static void cell_measure(cube_cell *cell)
{
    double n[3];
    cell_centroid(cell, n);
    cell->theta = atan2(sqrt(n[0] * n[0] + n[1] * n[1]), n[2]);
}

/* The largest angle from the centroid's normal to one of the cell's: to a corner's where that is
   less than a right angle, since such a circle that holds the corners holds their triangle. */
static double cell_turn(const cube_cell *cell)
{
    double n[3];
    double most = 0;
    cell_centroid(cell, n);
    for (int i = 0; i < 3; i++) {
        const double *m = cell->normal[i];
        double dot = n[0] * m[0] + n[1] * m[1] + n[2] * m[2];
        double cross[3] = {n[1] * m[2] - n[2] * m[1], n[2] * m[0] - n[0] * m[2],
                           n[0] * m[1] - n[1] * m[0]};
        most = lrcsi_most(most, dot > 0 ? sqrt(square_of(cross)) / dot : HUGE_VAL);
    }
    return isfinite(most) ? atan(most) * (1 + 4 * U) + 16 * U : HALF_TURN;
}

/* Decides whether a rule may be trusted with the cell, or never hear of its glint. */
static void cell_trust(const lrcsi_cubature *sum, cube_cell *cell)
{
    const lrcs_brdf *brdf = sum->brdf;
    double turn = cell_turn(cell);
    double cosine = cos(cell->theta);
    int diffuse = turn <= MOST_TURN && (!(brdf->B > 0) || turn * turn * (brdf->m + 1) <= 1);
    int glint = !(brdf->A > 0) || turn <= brdf->s * cosine * cosine;
    if (diffuse && !glint) {
        double most = lrcsi_reflect_most(brdf, cell->theta, turn).glint;
        double had = lrcsi_sum_value(&sum->glint) + lrcsi_sum_value(&sum->diffuse) + sum->estimate;
        glint = most <= NO_GLINT || most * sum->whole <= sum->tolerance * had;
        cell->unheard = glint ? most : 0;
    }
    cell->trusted = diffuse && glint;
    if (cell->trusted) {
        cell->value = rule_value(sum, cell);
    }
}

/* The side over which normals turn most: from corner k to corner (k + 1) % 3. */
static int cell_side(const cube_cell *cell)
{
    double length[3];
    double most = -1;
    int side = 0;
    for (int i = 0; i < 3; i++) {
        length[i] = sqrt(square_of(cell->normal[i]));
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3;
        double chord[3];
        for (int k = 0; k < 3; k++) {
            chord[k] = cell->normal[i][k] * length[j] - cell->normal[j][k] * length[i];
        }
        double turn = square_of(chord) / (length[i] * length[j]) / (length[i] * length[j]);
        if (turn > most) {
            most = turn;
            side = i;
        }
    }
    return side;
}

/* Both halves, the one nearer to the laser second. */
static void cell_halve(const cube_cell *cell, cube_cell half[2])
{
    int from = cell_side(cell);
    int to = (from + 1) % 3;
    for (int h = 0; h < 2; h++) {
        half[h] = *cell;
        half[h].area = 0.5 * cell->area;
        half[h].depth = cell->depth + 1;
        for (int k = 0; k < 3; k++) {
            half[h].normal[h == 0 ? from : to][k] =
                0.5 * (cell->normal[from][k] + cell->normal[to][k]);
        }
        cell_measure(&half[h]);
    }
    if (half[0].theta < half[1].theta) {
        cube_cell other = half[0];
        half[0] = half[1];
        half[1] = other;
    }
}

/* The halves of both halves, with the rule's sums. */
static void cell_quarter(const lrcsi_cubature *sum, const cube_cell *cell, cube_cell quarter[4])
{
    cube_cell half[2];
    cell_halve(cell, half);
    cell_halve(&half[0], &quarter[0]);
    cell_halve(&half[1], &quarter[2]);
    for (int i = 0; i < 4; i++) {
        quarter[i].value = rule_value(sum, &quarter[i]);
    }
}

static void sum_keep(lrcsi_cubature *sum, const cube_cell *cell, double estimate)
{
    lrcsi_sum_add(&sum->glint, cell->value.glint);
    lrcsi_sum_add(&sum->diffuse, cell->value.diffuse);
    sum->rounding += cell->value.rounding;
    sum->estimate += estimate;
}

/* No halvings are left for a cell that no rule is good for: the most that it may hold is its
   estimate. */
static void cell_give_up(lrcsi_cubature *sum, cube_cell *cell)
{
    lrcsi_reflection most = lrcsi_reflect_most(sum->brdf, cell->theta, cell_turn(cell));
    cell->value = rule_value(sum, cell);
    sum_keep(sum, cell, cell->area * (most.glint + most.diffuse));
}

/* Keeps the quarters where they agree with the whole, or must. 0: they are not kept. */
static int quarters_keep(lrcsi_cubature *sum, const cube_cell *cell, const cube_cell quarter[4],
                         int must)
{
    cube_value all = {0, 0, 0};
    for (int i = 0; i < 4; i++) {
        value_add(&all, 1, &quarter[i].value);
    }
    double off = fabs(all.glint - cell->value.glint) + fabs(all.diffuse - cell->value.diffuse);
    double had = lrcsi_sum_value(&sum->glint) + lrcsi_sum_value(&sum->diffuse);
    if (!must &&
        !(off <= sum->tolerance * (all.glint + all.diffuse + had * (cell->area / sum->whole)))) {
        return 0;
    }
    for (int i = 0; i < 4; i++) {
        sum_keep(sum, &quarter[i], i == 0 ? off + cell->unheard * cell->area : 0);
    }
    return 1;
}

/* One cell: kept, or parted into `part`. Returns into how many. */
static uint32_t cell_step(lrcsi_cubature *sum, cube_cell *cell, int may_part, cube_cell part[4])
{
    if (!cell->trusted) {
        cell_trust(sum, cell);
    }
    if (cell->trusted) {
        cell_quarter(sum, cell, part);
        return quarters_keep(sum, cell, part, !may_part) ? 0 : 4;
    }
    if (may_part) {
        cell_halve(cell, part);
        return 2;
    }
    cell_give_up(sum, cell);
    return 0;
}

/* A triangle may always be parted once. */
static void cells_add(lrcsi_cubature *sum, cube_cell first)
{
    cube_cell stack[STACK_SIZE];
    cube_cell part[4];
    uint32_t top = 0;
    cell_measure(&first);
    stack[top++] = first;
    while (top > 0) {
        cube_cell cell = stack[--top];
        int may_part =
            cell.depth == 0 || (cell.depth + 2 <= MOST_HALVINGS && sum->splits < MOST_SPLITS);
        uint32_t parts = cell_step(sum, &cell, may_part, part);
        sum->splits += parts;
        for (uint32_t i = 0; i < parts; i++) {
            stack[top++] = part[i];
        }
    }
}

/* --- the lit part ----------------------------------------------------------------------------- */

/* The point on the side from a corner with z > 0 to one with z <= 0 where z = 0; its share of it.
 */
static double lit_end(const double from[3], const double to[3], double at[3])
{
    double share = from[2] / (from[2] - to[2]);
    for (int k = 0; k < 2; k++) {
        at[k] = from[k] + share * (to[k] - from[k]);
    }
    at[2] = 0;
    return share;
}

static cube_cell cell_of(const double a[3], const double b[3], const double c[3], double area)
{
    cube_cell cell = {.area = area};
    for (int k = 0; k < 3; k++) {
        cell.normal[0][k] = a[k];
        cell.normal[1][k] = b[k];
        cell.normal[2][k] = c[k];
    }
    return cell;
}

lrcsi_cubature lrcsi_cubature_make(const lrcs_brdf *brdf, const double normal[3][3],
                                   double tolerance)
{
    lrcsi_cubature sum = {.brdf = brdf, .tolerance = tolerance};
    cube_cell cell = cell_of(normal[0], normal[1], normal[2], 0);
    cell_measure(&cell);
    sum.most = lrcsi_reflect_most(brdf, cell.theta, cell_turn(&cell) + 0x1p-40);
    return sum;
}

double lrcsi_cubature_at(const lrcsi_cubature *sum, const double normal[3])
{
    cube_value at = node_value(sum, normal);
    return at.glint + at.diffuse;
}

void lrcsi_cubature_add(lrcsi_cubature *sum, const double normal[3][3], double area)
{
    const double *lit[3];
    const double *dark[3];
    int count = 0;
    double p[3];
    double q[3];
    for (int i = 0; i < 3; i++) {
        if (normal[i][2] > 0) {
            lit[count++] = normal[i];
        } else {
            dark[i - count] = normal[i];
        }
    }
    if (!(area > 0) || count == 0) {
        return;
    }
    if (count == 3) {
        cells_add(sum, cell_of(lit[0], lit[1], lit[2], area));
    } else if (count == 1) {
        double share = lit_end(lit[0], dark[0], p) * lit_end(lit[0], dark[1], q);
        cells_add(sum, cell_of(lit[0], p, q, area * share));
    } else {
        double along_p = lit_end(lit[0], dark[0], p);
        double along_q = lit_end(lit[1], dark[0], q);
        cells_add(sum, cell_of(lit[0], lit[1], q, area * along_q));
        cells_add(sum, cell_of(lit[0], q, p, area * (1 - along_q) * along_p));
    }
}
