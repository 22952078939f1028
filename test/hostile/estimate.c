/* SPDX-License-Identifier: MIT */
/* What the likely error of a raster is worth on real models, beside method exact from the same
   directions: for each size the median of estimate / error, how often it is below the error, and
   the median of error / sigma; first of the raster with a proved bound, then of what serves where
   an estimate is accepted (samples alone, where facets are many).
   usage: estimate DIRECTIONS SEED MODEL .. */
#include <lrcs/host.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIZES = 7, KINDS = 2, MOST = 20000 };

static const int accept[KINDS] = {LRCS_ACCEPT_BOUND, LRCS_ACCEPT_ESTIMATE};
static double ratio[KINDS][SIZES][MOST], relative[KINDS][SIZES][MOST];
static int count[KINDS][SIZES], low[KINDS][SIZES];

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

static lrcs_result run(lrcs_host_scene *scene, const double direction[3], int method, int kind,
                       uint32_t size)
{
    lrcs_run_options options = lrcs_run_options_default();
    lrcs_pose pose;
    lrcs_result result;
    options.method = method;
    options.resolution = size;
    options.accept = accept[kind];
    if (lrcs_pose_from_direction(direction, &pose) != LRCS_OK ||
        lrcs_host_scene_run(scene, &pose, &options, &result, NULL, NULL, NULL, NULL) != LRCS_OK) {
        exit(1);
    }
    return result;
}

static void measure(lrcs_host_scene *scene)
{
    double direction[3];
    for (int k = 0; k < 3; k++) {
        direction[k] = rand() / (RAND_MAX / 2.0) - 1;
    }
    lrcs_result truth = run(scene, direction, LRCS_METHOD_EXACT, 0, 0);
    for (int n = 0; n < KINDS * SIZES; n++) {
        int kind = n / SIZES;
        int i = n % SIZES;
        lrcs_result r = run(scene, direction, LRCS_METHOD_ZBUFFER, kind, 16u << i);
        double error = fabs(r.sigma_m2 - truth.sigma_m2);
        if (error > truth.bound_m2 + r.budget.rounding_m2 && count[kind][i] < MOST) {
            low[kind][i] += r.estimate_m2 < error;
            relative[kind][i][count[kind][i]] = error / truth.sigma_m2;
            ratio[kind][i][count[kind][i]++] = r.estimate_m2 / error;
        }
    }
}

int main(int arguments, char **argument)
{
    int directions = arguments > 3 ? atoi(argument[1]) : 0;
    srand(directions > 0 ? (unsigned)atoi(argument[2]) : 0);
    for (int a = 3; a < arguments; a++) {
        lrcs_host_options options = lrcs_host_options_default();
        lrcs_host_scene scene = {0};
        lrcs_host_error error;
        if (lrcs_host_scene_read(argument[a], &options, &scene, &error) != LRCS_OK ||
            lrcs_host_scene_prepare(&scene, &error) != LRCS_OK) {
            fprintf(stderr, "estimate: %s\n", error.text);
            return 1;
        }
        for (int d = 0; d < directions; d++) {
            measure(&scene);
        }
        lrcs_host_scene_free(&scene);
    }
    for (int n = 0; n < KINDS * SIZES; n++) {
        int kind = n / SIZES;
        int i = n % SIZES;
        int runs = count[kind][i];
        if (runs > 0) {
            qsort(ratio[kind][i], (size_t)runs, sizeof ***ratio, ascending);
            qsort(relative[kind][i], (size_t)runs, sizeof ***relative, ascending);
            printf("%-9s N %4u: %5d runs, estimate / error %5.2f, below in %5.2f %%, "
                   "error / sigma %.2e\n",
                   kind == 0 ? "proved" : "estimated", 16u << i, runs, ratio[kind][i][runs / 2],
                   100.0 * low[kind][i] / runs, relative[kind][i][runs / 2]);
        }
    }
    return directions <= 0;
}
