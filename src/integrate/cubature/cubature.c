/* SPDX-License-Identifier: MIT */
/* Adaptive cubature of f_r cos(theta) over a triangle of interpolated normals. This file decides
   where cells are divided and when to stop; the caller decides over which triangles the integral is
   taken, and what their areas are.

   Normals are linear in position, so that the part with n . s_hat > 0 is the triangle less a
   half-plane, which is cut off first. In this part the integrand is analytic, but it may have a
   narrow peak in a small fraction of the triangle, or outside of it. The triangle is divided into
   cells, which are convex polygons. A cell is halved by a line across the direction in which its
   normals turn most. The half whose normals are closer to the direction to the laser is integrated
   first, so that a peak is in the sum before its surroundings are compared with that sum.
   - A quadrature rule is trusted only on cells whose normals turn by less than the widths of the
     peaks (of the glint s cos^2 theta, of the diffuse term 1 / sqrt(m + 1)), and by less than the
     angle in which their flanks fall by a few powers of e: then the rule cannot miss a peak, nor
     the comparison below a flank. All other cells are halved without evaluating the rule, unless
     the upper bound of the integrand on the cell (proved) is negligible compared with the sum so
     far and its estimated error, or with a lower bound of the final sum.
   - The value of a trusted rule, of degree 5 on 7 points (Radon 1948), is compared with its value
     on four quarters, the halves of both halves: quarters halve every direction in which the
     normals turn much, as one halving does not. The difference is the error estimate. It is the
     error of the coarser value, some ten to sixty times that of the finer value, which is added to
     the sum.
   - Where the normals turn by less than a small fraction p of those widths, and of the angle to the
     edge where n . s_hat = 0, the rule is not compared: its error is of the order of p^6, which is
     the estimate; p^5 if the caller's linear function is integrated as well.
   Where the limit on halvings is reached, the upper bound on the cell is the estimate. Where the
   limit on cells is reached, the triangle is integrated again with a larger tolerance, because a
   slightly less accurate integral is better than one that is inaccurate in the last part of the
   triangle. Where the limit on steps is reached, cells are not divided although they should be, and
   the possible error is counted as a bound instead of an estimate. */
#include "integrate/cubature/cubature.h"

#include <math.h>

#include "base/constant.h"
#include "base/elementary.h"
#include "base/range.h"
#include "base/work.h"

/* Limit on the halvings of a cell, and the size of the stack: quartering takes two halvings, and
   leaves three more cells on the stack. */
#define HALVINGS_MAX 64u
#define STACK_CELLS  (3 * HALVINGS_MAX / 2 + 4)
/* Limit on the cells of one sum, apart from those into which a triangle may always be divided; and
   where it is reached, the factor by which the tolerance is increased, up to a maximum. Heuristics,
   which affect only work and estimate. */
#define SPLITS_MAX       (1u << 15)
#define TOLERANCE_FACTOR 100
#define TOLERANCE_MAX    1e-2
/* Steps (base/meter.h) that a cell takes: quarters, the rule on each, bounds. */
#define CELL_STEPS 256
/* A rule is trusted only if the normals of the cell turn by no more than this, rad: a heuristic, as
   are all conditions of trust (cell_trust). */
#define TURN_MAX 0.5
/* A value of f_r cos is negligible if it is below this times the tolerance times the integral, over
   a radian, of a peak as high as the upper bound and as wide as the BRDF's. A heuristic: such
   values are part of the estimate. */
#define NEGLIGIBLE 0x1p-20
/* Terms smaller than this times A + B are within the bounds on underflow (optics/deviation.c). */
#define TERM_MIN 0x1p-1008
/* tan^2 is limited to this, so that it stays finite for normals perpendicular to the direction to
   the laser. */
#define TAN2_MAX 1e300

/* --- the rule --------------------------------------------------------------------------------- */

/* A bound on the error of f_r cos at a node of the rule where the normal has an error of d, rad.
   The logarithms of the two terms fall with theta by at most t (5 + 2 (1 + t^2)/s^2) and (m + 1) t
   per radian, t = tan(theta), both of which grow with t; and tan(theta + d) <= t + 2 d (1 + t^2)
   for d t <= 1/2; e^x - 1 <= 2 x for x <= 1/4. If the change may be larger, the error is at most
   the upper bound of the term in the neighbourhood. */
static double node_position_err(const lrcsi_cubature *sum, double u, double d,
                                const lrcsi_cubature_value *at)
{
    const lrcs_brdf *brdf = sum->surface.brdf;
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
static lrcsi_cubature_value node_value(const lrcsi_cubature *sum, const double n[3])
{
    lrcsi_cubature_value at = {0, 0, 0, 0, 0, 0};
    if (!(n[2] > 0)) {
        return at;
    }
    double u = lrcsi_min(TAN2_MAX, (n[0] * n[0] + n[1] * n[1]) / n[2] / n[2]);
    lrcsi_reflection reflection = lrcsi_reflect(sum->surface.brdf, u, 0);
    double secant = sqrt(1 + u);
    at.glint = reflection.glint * secant;
    at.diffuse = reflection.diffuse * secant;
    if (sum->surface.derivatives) {
        at.glint_u = at.glint > 0 ? at.glint * u : 0;
        at.diffuse_log = at.diffuse > 0 ? at.diffuse * lrcsi_log1p(u).hi : 0;
    }
    at.rounding = reflection.error * secant + 4 * LRCSI_U * (at.glint + at.diffuse) +
                  node_position_err(sum, u, sum->surface.position_err / (n[2] * secant), &at);
    return at;
}

static void value_add(lrcsi_cubature_value *sum, double weight, const lrcsi_cubature_value *value)
{
    sum->glint += weight * value->glint;
    sum->diffuse += weight * value->diffuse;
    sum->rounding += weight * value->rounding;
    sum->glint_u += weight * value->glint_u;
    sum->diffuse_log += weight * value->diffuse_log;
    sum->weighted += weight * value->weighted;
}

/* The value of the rule on a cell: the sum over the triangles of corners 0, i and i + 1. The nodes
   of a triangle are its centroid, with weight 9/40, and the points (a, a, 1 - 2 a) and their
   permutations, a = (6 -+ sqrt 15)/21, with weights (155 -+ sqrt 15)/1200. Weights and sums have
   relative errors below 16 u. */
static lrcsi_cubature_value rule_value(const lrcsi_cubature *sum, const lrcsi_cubature_cell *cell)
{
    static const double rule[3][3] = {
        {1.0 / 3, 1.0 / 3, 0.225},
        {0.10128650732345633880, 0.79742698535308732240, 0.12593918054482715260},
        {0.47014206410511508977, 0.05971587178976982046, 0.13239415278850618074}};
    lrcsi_cubature_value value = {0, 0, 0, 0, 0, 0};
    for (int i = 1; i + 1 < cell->count; i++) {
        double area = 0.5 * lrcsi_cubature_fan_cross(cell, i);
        lrcsi_cubature_value mean = {0, 0, 0, 0, 0, 0};
        for (int k = 0; k < 7 && area > 0; k++) {
            const double *node = rule[(k + 2) / 3]; /* the centroid once, the others three times */
            int odd = (k + 2) % 3;
            double n[3];
            for (int c = 0; c < 3; c++) {
                n[c] = node[odd == 0] * cell->normal[0][c] + node[odd == 1] * cell->normal[i][c] +
                       node[odd == 2] * cell->normal[i + 1][c];
            }
            lrcsi_cubature_value at = node_value(sum, n);
            at.weighted = (at.glint + at.diffuse) *
                          (node[odd == 0] * cell->weight[0] + node[odd == 1] * cell->weight[i] +
                           node[odd == 2] * cell->weight[i + 1]);
            value_add(&mean, node[2], &at);
        }
        mean.rounding += 16 * LRCSI_U * (mean.glint + mean.diffuse);
        value_add(&value, cell->unit * area, &mean);
        value.rounding +=
            cell->unit * lrcsi_cubature_fan_err(cell, i) * (mean.glint + mean.diffuse);
    }
    return value;
}

/* --- cells ------------------------------------------------------------------------------------ */

/* Errors of f_r cos below this are accepted. */
static double accepted_error(const lrcsi_cubature *sum)
{
    return lrcsi_max(sum->surface.negligible, sum->tolerance * sum->surface.reference);
}

/* Decides whether the rule is trusted on the cell, and evaluates it if so:
   1. whether the normals turn little enough for the glint and for the diffuse term;
   2. if not, whether the terms are negligible on the cell, by their proved upper bound;
   3. the estimated error of the rule, from the turn relative to the widths of the terms.
   The limits and p are choices, on which only work and estimate depend.
   weight_max: the largest magnitude of the caller's linear function; negative: there is none. */
static void cell_trust(const lrcsi_cubature *sum, double weight_max, lrcsi_cubature_cell *cell)
{
    const lrcs_brdf *brdf = sum->surface.brdf;
    double turn = lrcsi_cubature_cell_turn(cell);
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
        double scale = lrcsi_max(sum_so_far, sum->surface.diffuse_min * sum->surface.area);
        is_trusted = cell->skipped <= accepted_error(sum) ||
                     cell->skipped * sum->surface.area <= sum->tolerance * scale;
    }
    cell->trusted = turn <= TURN_MAX && is_trusted;
    double p = lrcsi_max(turn * sqrt(brdf->m + 1), 0.25 * turn * (brdf->m + 1) * t);
    p = lrcsi_max(p, brdf->A > 0 && glint_resolved ? turn / width : 0);
    double fifth = p * p * p * p * p;
    cell->rule_err = p < 1 ? fifth * (weight_max >= 0 ? 1 : p) : 1;
    if (cell->trusted) {
        cell->value = rule_value(sum, cell);
    }
}

/* Adds the value of a cell to the sum. */
static void sum_add_value(lrcsi_cubature *sum, const lrcsi_cubature_cell *cell)
{
    lrcsi_sum_add(&sum->glint, cell->value.glint);
    lrcsi_sum_add(&sum->diffuse, cell->value.diffuse);
    sum->rounding += cell->value.rounding;
    lrcsi_sum_add(&sum->glint_u, cell->value.glint_u);
    lrcsi_sum_add(&sum->diffuse_log, cell->value.diffuse_log);
    lrcsi_sum_add(&sum->weighted, cell->value.weighted);
}

/* An upper bound both of the integral over a cell and of the value of the rule on it. Its normals
   lie in a cone about their mean, and have errors of at most position_err. */
static double cell_integral_bound(const lrcsi_cubature *sum, const lrcsi_cubature_cell *cell)
{
    double err = 2 * sum->surface.position_err / lrcsi_cubature_cell_shortest(cell);
    double turn = err <= 1 ? lrcsi_cubature_cell_turn(cell) + err : LRCS_PI;
    lrcsi_reflection bound = lrcsi_reflect_bound(sum->surface.brdf, cell->theta, turn);
    double area_err = 0;
    for (int i = 1; i + 1 < cell->count; i++) {
        area_err += lrcsi_cubature_fan_err(cell, i);
    }
    return (lrcsi_cubature_cell_area(cell) + cell->unit * area_err) * (bound.glint + bound.diffuse);
}

/* Adds the error of a cell that is not divided further although it is not accurate enough: its
   bound if no steps are left, else its estimate. */
static void sum_add_error(lrcsi_cubature *sum, double bound, double estimate)
{
    if (lrcsi_meter_spent(sum->surface.meter)) {
        sum->unresolved += bound;
    } else {
        sum->estimate += estimate;
    }
}

/* Adds a cell to the sum, or divides it into `part`. Returns the number of parts.
   1. A cell on which the rule is not trusted is halved. If it may not be divided, the value of the
      rule is added, with the upper bound as its error.
   2. A cell on which the estimated error of the rule is accepted is added without a comparison.
   3. Any other cell is compared with its quarters, the halves of both halves. They are added if
      their values agree with that of the cell, or if it may not be divided; otherwise the quarters
      are the parts. */
static uint32_t cell_step(lrcsi_cubature *sum, double weight_max, lrcsi_cubature_cell *cell,
                          int may_divide, lrcsi_cubature_cell part[4])
{
    if (!cell->trusted) {
        cell_trust(sum, weight_max, cell);
    }
    if (!cell->trusted) { /* 1 */
        if (may_divide) {
            lrcsi_cubature_cell_halve(cell, part);
            return 2;
        }
        double bound = cell_integral_bound(sum, cell);
        cell->value = rule_value(sum, cell);
        sum_add_value(sum, cell);
        sum_add_error(sum, bound, bound);
        return 0;
    }
    double area = lrcsi_cubature_cell_area(cell);
    double value = cell->value.glint + cell->value.diffuse;
    if (cell->rule_err * value <= sum->tolerance * value + accepted_error(sum) * area) { /* 2 */
        sum_add_value(sum, cell);
        sum->estimate += cell->rule_err * value + cell->skipped * area;
        return 0;
    }
    lrcsi_cubature_cell half[2]; /* 3 */
    lrcsi_cubature_value all = {0, 0, 0, 0, 0, 0};
    lrcsi_cubature_cell_halve(cell, half);
    lrcsi_cubature_cell_halve(&half[0], &part[0]);
    lrcsi_cubature_cell_halve(&half[1], &part[2]);
    for (int i = 0; i < 4; i++) {
        part[i].value = rule_value(sum, &part[i]);
        value_add(&all, 1, &part[i].value);
    }
    double difference =
        fabs(all.glint - cell->value.glint) + fabs(all.diffuse - cell->value.diffuse);
    if (weight_max > 0) { /* the weighted integral must agree too, relative to the largest weight */
        double weighted = fabs(all.weighted - cell->value.weighted);
        difference = lrcsi_max(difference, weighted / weight_max);
    }
    double sum_so_far = lrcsi_sum_value(&sum->glint) + lrcsi_sum_value(&sum->diffuse);
    double allowed =
        sum->tolerance * (all.glint + all.diffuse + sum_so_far * (area / sum->surface.area));
    int agree = difference <= allowed + accepted_error(sum) * area;
    if (may_divide && !agree) {
        return 4;
    }
    double estimate = difference + cell->skipped * area;
    if (agree) {
        sum->estimate += estimate;
    } else {
        sum_add_error(sum, cell_integral_bound(sum, cell), estimate);
    }
    for (int i = 0; i < 4; i++) {
        sum_add_value(sum, &part[i]);
    }
    return 0;
}

/* Adds a cell, dividing it as far as necessary. The first cell may always be divided, the others
   only while the meter is not spent. */
static void cells_add(lrcsi_cubature *sum, double weight_max, lrcsi_cubature_cell first)
{
    lrcsi_cubature_cell part[4];
    uint32_t top = 0;
    lrcsi_cubature_cell_finish(&first);
    sum->surface.stack[top++] = first;
    while (top > 0) {
        lrcsi_cubature_cell cell = sum->surface.stack[--top];
        int left = lrcsi_meter_take(sum->surface.meter, CELL_STEPS);
        int may_divide =
            cell.depth == 0 || (left && cell.depth + 2 <= HALVINGS_MAX && sum->splits < SPLITS_MAX);
        uint32_t parts = cell_step(sum, weight_max, &cell, may_divide, part);
        sum->splits += parts;
        for (uint32_t i = 0; i < parts; i++) {
            if (part[i].count >= 3 && lrcsi_cubature_cell_area(&part[i]) > 0) {
                sum->surface.stack[top++] = part[i];
            }
        }
    }
}

/* --- triangles -------------------------------------------------------------------------------- */

size_t lrcsi_cubature_need(void)
{
    return lrcsi_work_bytes(STACK_CELLS, sizeof(lrcsi_cubature_cell));
}

lrcsi_cubature_cell *lrcsi_cubature_stack(lrcs_work *work)
{
    return lrcsi_work_take(work, STACK_CELLS, sizeof(lrcsi_cubature_cell));
}

lrcsi_cubature_surface lrcsi_cubature_surface_make(const lrcs_brdf *brdf, const double normal[3][3],
                                                   double tolerance, lrcsi_cubature_cell *stack)
{
    lrcsi_cubature_surface surface = {.brdf = brdf, .tolerance = tolerance, .stack = stack};
    lrcsi_cubature_cell cell = lrcsi_cubature_cell_of(normal, NULL, 0);
    lrcsi_cubature_cell_finish(&cell);
    double turn = lrcsi_cubature_cell_turn(&cell);
    surface.upper_bound = lrcsi_reflect_bound(brdf, cell.theta, turn + 0x1p-40);
    double farthest = cell.theta + turn;
    surface.diffuse_min =
        farthest < LRCS_PI / 2 ? brdf->B * lrcsi_power(lrcsi_log(cos(farthest)), brdf->m + 1) : 0;
    surface.negligible = NEGLIGIBLE * tolerance *
                         (surface.upper_bound.glint * lrcsi_min(1, brdf->s * brdf->s) +
                          surface.upper_bound.diffuse / (brdf->m + 1));
    surface.negligible = lrcsi_max(surface.negligible, TERM_MIN * (brdf->A + brdf->B));
    return surface;
}

lrcsi_cubature lrcsi_cubature_start(const lrcsi_cubature_surface *surface)
{
    return (lrcsi_cubature){.surface = *surface, .tolerance = surface->tolerance};
}

/* A bound, per area, on what is missed where a normal faces the laser and its computed value, which
   has an error of position_err, does not. The angle between such a normal and the plane n . s_hat =
   0 is at most position_err over the length of the normal, which is at least that of the shortest
   normal at a corner times the cosine of the turn. */
static double unlit_position_err(const lrcsi_cubature *sum, const lrcsi_cubature_cell *whole)
{
    double lowest = HUGE_VAL;
    double highest = -HUGE_VAL;
    for (int i = 0; i < 3; i++) {
        lowest = lrcsi_min(lowest, whole->normal[i][2]);
        highest = lrcsi_max(highest, whole->normal[i][2]);
    }
    if (lowest > sum->surface.position_err || highest < -sum->surface.position_err) {
        return 0;
    }
    double turn = lrcsi_cubature_cell_turn(whole);
    double length = turn < LRCS_PI / 2 ? lrcsi_cubature_cell_shortest(whole) * cos(turn) : 0;
    double err = 2 * sum->surface.position_err / length;
    lrcsi_reflection seen =
        lrcsi_reflect_bound(sum->surface.brdf, LRCS_PI / 2, err <= 1 ? err : LRCS_PI);
    return seen.glint + seen.diffuse;
}

void lrcsi_cubature_add(lrcsi_cubature *sum, const double normal[3][3], const double weight[3],
                        double area)
{
    double level[LRCSI_CUBATURE_CORNERS] = {0};
    lrcsi_cubature_cell whole = lrcsi_cubature_cell_of(normal, weight, area);
    lrcsi_cubature_cell lit = {.unit = whole.unit};
    double weight_max = -1;
    for (int i = 0; i < 3 && weight; i++) {
        weight_max = lrcsi_max(weight_max, fabs(weight[i]));
    }
    if (!(area > 0)) {
        return;
    }
    for (int i = 0; i < 3; i++) {
        level[i] = normal[i][2];
    }
    lrcsi_cubature_cell_cut(&whole, level, 1, &lit);
    sum->rounding += area * unlit_position_err(sum, &whole);
    if (lit.count < 3) {
        return;
    }
    lrcsi_cubature start = *sum;
    cells_add(sum, weight_max, lit);
    while (sum->splits >= SPLITS_MAX && start.tolerance < TOLERANCE_MAX) {
        start.tolerance *= TOLERANCE_FACTOR;
        *sum = start;
        cells_add(sum, weight_max, lit);
    }
}
