/* SPDX-License-Identifier: MIT */
/* lrcs sweep --stats: how sigma is spread over the rows. It decides what a row weighs: in a grid of
   azimuth and elevation the solid angle it stands for, the ends of a full turn by half; elsewhere
   all alike. */
#include "cli/sweep/sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct stats_row {
    double sigma, weight;
    uint64_t index;
} stats_row;

static int by_sigma(const void *a, const void *b)
{
    const stats_row *x = a;
    const stats_row *y = b;
    int order = (x->sigma > y->sigma) - (x->sigma < y->sigma);
    return order ? order : (x->index > y->index) - (x->index < y->index);
}

/* Of a row, along one axis of azimuth or elevation. */
static double axis_weight(const sweep_plan *plan, uint64_t row, uint32_t axis)
{
    const sweep_axis *along = &plan->axis[axis];
    uint64_t place = cli_plan_place(plan, row, axis);
    uint64_t last = along->range.count - 1;
    if (last == 0) {
        return 1.0;
    }
    double first = cli_range_at(&along->range, 0);
    double here = cli_range_at(&along->range, place);
    double half = 0.5 * fabs(cli_range_at(&along->range, 1) - first);
    if (along->option[0] == 'a') {
        int turn = fabs(cli_range_at(&along->range, last) - first) == 360.0;
        return turn && (place == 0 || place == last) ? 0.5 : 1.0;
    }
    return sin(fmin(here + half, 90.0) / CLI_DEGREES) - sin(fmax(here - half, -90.0) / CLI_DEGREES);
}

static double row_weight(const sweep_plan *plan, uint64_t row)
{
    double weight = 1.0;
    for (uint32_t i = plan->scene_axes; plan->kind == SWEEP_AZEL && i < plan->axes; i++) {
        weight *= fmax(axis_weight(plan, row, i), 0.0);
    }
    return weight;
}

static void sigma_print(FILE *out, const char *label, double sigma)
{
    fprintf(out, "  %-10s %.9g m2", label, sigma);
    if (sigma > 0.0) {
        fprintf(out, "   %.4f dBsm", cli_dbsm(sigma));
    }
}

static void place_print(FILE *out, const char *label, const sweep_plan *plan, const stats_row *row)
{
    double value[SWEEP_COLUMNS];
    cli_plan_values(plan, row->index, value);
    sigma_print(out, label, row->sigma);
    for (uint32_t i = 0; i < plan->columns; i++) {
        fprintf(out, "%s%s = %.9g", i == 0 ? " at " : ", ", plan->column[i], value[i]);
    }
    fputc('\n', out);
}

int cli_stats_print(FILE *out, const sweep_plan *plan, const double (*row)[2])
{
    static const int percent[] = {1, 5, 10, 25, 50, 75, 90, 95, 99};
    stats_row *all = calloc(plan->rows, sizeof *all);
    cli_sum mean = {0.0, 0.0};
    cli_sum total = {0.0, 0.0};
    cli_sum bound = {0.0, 0.0};
    if (!all) {
        return cli_out_of_memory();
    }
    for (uint64_t i = 0; i < plan->rows; i++) {
        all[i] = (stats_row){row[i][0], row_weight(plan, i), i};
        cli_sum_add(&mean, all[i].weight * row[i][0]);
        cli_sum_add(&bound, all[i].weight * row[i][1]);
        cli_sum_add(&total, all[i].weight);
    }
    qsort(all, plan->rows, sizeof *all, by_sigma);
    double whole = cli_sum_value(&total);
    fprintf(out, "statistics   %llu rows, %s\n", (unsigned long long)plan->rows,
            plan->kind == SWEEP_AZEL ? "each by the solid angle that it stands for" : "all alike");
    sigma_print(out, "mean", cli_sum_value(&mean) / whole);
    fprintf(out, ", known to %.2g m2 for these rows\n", cli_sum_value(&bound) / whole);
    place_print(out, "least", plan, &all[0]);
    double below = 0.0;
    uint64_t at = 0;
    for (size_t k = 0; k < sizeof percent / sizeof percent[0]; k++) {
        char label[16];
        snprintf(label, sizeof label, "%d %%", percent[k]);
        while (at + 1 < plan->rows && below + all[at].weight < 0.01 * percent[k] * whole) {
            below += all[at++].weight;
        }
        sigma_print(out, label, all[at].sigma);
        fprintf(out, "%s\n", percent[k] == 50 ? "   median" : "");
    }
    place_print(out, "most", plan, &all[plan->rows - 1]);
    free(all);
    return 0;
}
