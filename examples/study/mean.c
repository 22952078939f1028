/* SPDX-License-Identifier: MIT */
/* The mean of sigma over all attitudes, by a quadrature whose error is estimated. */
#include "study.h"

#include <math.h>

#define MEAN_NODES 12  /* of a Gauss-Legendre rule on each panel */
#define MEAN_SLOPE 0.2 /* the narrowest glint that the smallest number of panels suffices for */

typedef struct mean_rule {
    double node[MEAN_NODES], weight[MEAN_NODES]; /* on -1 .. 1 */
} mean_rule;

/* P_n(x) and its derivative by the three-term recurrence. */
static double legendre_step(double x, double *slope)
{
    double before = 1.0;
    double now = x;
    for (int n = 2; n <= MEAN_NODES; n++) {
        double next = ((2 * n - 1) * x * now - (n - 1) * before) / n;
        before = now;
        now = next;
    }
    *slope = MEAN_NODES * (x * now - before) / (x * x - 1.0);
    return now / *slope;
}

/* Newton's method from Tricomi's first guess. */
static mean_rule rule_make(void)
{
    mean_rule rule;
    for (int i = 0; i < MEAN_NODES; i++) {
        double x = cos(LRCS_PI * (i + 0.75) / (MEAN_NODES + 0.5));
        double slope = 1.0;
        for (int step = 0; step < 8; step++) {
            x -= legendre_step(x, &slope);
        }
        legendre_step(x, &slope);
        rule.node[i] = x;
        rule.weight[i] = 2.0 / ((1.0 - x * x) * slope * slope);
    }
    return rule;
}

/* The position of a node in a chain of panels, in halves of a panel. */
static double rule_place(const mean_rule *rule, int node)
{
    int panel = node / MEAN_NODES;
    return 2 * panel + 1 + rule->node[node % MEAN_NODES];
}

/* A body of revolution: half the integral of sigma sin(aspect) over the aspect. */
static study_number mean_turned(study_job *job, const lrcs_shape *shape, const lrcs_brdf *brdf,
                                int panels)
{
    const mean_rule rule = rule_make();
    study_number mean = {0.0, 0.0};
    double half = 90.0 / panels; /* deg, of a panel */
    for (int i = 0; i < panels * MEAN_NODES; i++) {
        double aspect = half * rule_place(&rule, i);
        double weight = 0.5 * rule.weight[i % MEAN_NODES] * half * (LRCS_PI / 180.0) *
                        sin(aspect * (LRCS_PI / 180.0));
        study_number sigma = study_sigma(job, shape, brdf, aspect);
        mean = study_sum(mean, study_scaled(sigma, weight));
    }
    return mean;
}

/* The mean over an eighth of all directions, which is that over the other seven too: over azimuth
   and polar angle, weighted by the sine of the polar angle. */
static study_number mean_octant(study_job *job, study_look *look, const void *what, int panels)
{
    const mean_rule rule = rule_make();
    study_number mean = {0.0, 0.0};
    int count = panels * MEAN_NODES;
    double half = 0.25 * LRCS_PI / panels; /* rad, of a panel */
    for (int i = 0; i < count * count; i++) {
        int row = i / count;
        int column = i % count;
        double polar = half * rule_place(&rule, row);
        double azimuth = half * rule_place(&rule, column);
        const double direction[3] = {sin(polar) * cos(azimuth), sin(polar) * sin(azimuth),
                                     cos(polar)};
        double weight = half * half * rule.weight[row % MEAN_NODES] *
                        rule.weight[column % MEAN_NODES] * sin(polar) * (2.0 / LRCS_PI);
        mean = study_sum(mean, study_scaled(look(job, what, direction), weight));
    }
    return mean;
}

/* The estimated error: the change that twice as many panels make, and some roundings of the rule
   itself. */
static study_number mean_refined(study_number coarse, study_number fine)
{
    fine.bound += fabs(fine.value - coarse.value) + 0x1p-46 * fine.value;
    return fine;
}

study_number study_octant(study_job *job, study_look *look, const void *what, int panels)
{
    study_number coarse = mean_octant(job, look, what, panels / 2);
    return mean_refined(coarse, mean_octant(job, look, what, panels));
}

typedef struct mean_box {
    const lrcs_shape *shape;
    const lrcs_brdf *brdf;
} mean_box;

static study_number box_look(study_job *job, const void *what, const double direction[3])
{
    const mean_box *box = what;
    const lrcs_aspect aspect = {.by_direction = 1,
                                .direction = {direction[0], direction[1], direction[2]}};
    return study_sigma_at(job, box->shape, box->brdf, &aspect);
}

study_number study_mean(study_job *job, const lrcs_shape *shape, const lrcs_brdf *brdf)
{
    int finer = brdf->A > 0.0 ? (int)fmax(ceil(MEAN_SLOPE / brdf->s), 1.0) : 1;
    if (shape->kind == LRCS_SHAPE_BOX) {
        const mean_box box = {shape, brdf};
        return study_octant(job, box_look, &box, 4 * finer);
    }
    study_number coarse = mean_turned(job, shape, brdf, 12 * finer);
    return mean_refined(coarse, mean_turned(job, shape, brdf, 24 * finer));
}
