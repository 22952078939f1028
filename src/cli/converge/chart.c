/* SPDX-License-Identifier: MIT */
/* The chart of lrcs converge --plot and of lrcs plot: for each kind of setting its cost and its
   error, on logarithmic axes. This file decides which curves there are and how they look; the host
   draws them. */
#include "cli/converge/converge.h"

#include <float.h>
#include <math.h>

#define CHART_SERIES   (3 * LRCS_HOST_CONVERGENCE_KINDS)
#define CHART_ROUNDOFF (0.5 * DBL_EPSILON)

/* The quantities of a setting, each a curve. */
enum chart_quantity { CHART_ERROR, CHART_BOUND, CHART_ESTIMATE };

typedef struct chart_curve {
    char name[48];
    double x[LRCS_HOST_CONVERGENCE_SETTINGS], y[LRCS_HOST_CONVERGENCE_SETTINGS];
    const char *label[LRCS_HOST_CONVERGENCE_SETTINGS];
} chart_curve;

typedef struct chart_curves {
    chart_curve curve[CHART_SERIES];
    lrcs_host_series series[CHART_SERIES];
    uint32_t count;
    char short_name[LRCS_HOST_CONVERGENCE_SETTINGS][16];
} chart_curves;

static const struct {
    int colour, marker;
} chart_kinds[LRCS_HOST_CONVERGENCE_KINDS] = {
    [LRCS_HOST_CONVERGENCE_KIND_MESH] = {LRCS_HOST_GREEN, LRCS_HOST_TRIANGLE},
    [LRCS_HOST_CONVERGENCE_KIND_PREVIEW] = {LRCS_HOST_ORANGE, LRCS_HOST_SQUARE},
    [LRCS_HOST_CONVERGENCE_KIND_FACET] = {LRCS_HOST_PURPLE, LRCS_HOST_SQUARE},
    [LRCS_HOST_CONVERGENCE_KIND_EXACT] = {LRCS_HOST_VERMILION, LRCS_HOST_DIAMOND},
    [LRCS_HOST_CONVERGENCE_KIND_CLOSED] = {LRCS_HOST_BLACK, LRCS_HOST_CROSS},
    [LRCS_HOST_CONVERGENCE_KIND_ZBUFFER] = {LRCS_HOST_BLUE, LRCS_HOST_DISC}};

static double setting_quantity(const lrcs_host_convergence_setting *setting, int quantity)
{
    return quantity == CHART_ERROR   ? setting->error_m2
           : quantity == CHART_BOUND ? setting->bound_m2
                                     : setting->estimate_m2;
}

/* 1 if a kind of setting has a curve: some value is known. An estimate that is 0 everywhere only
   means that nothing was sampled. */
static int curve_known(const lrcs_host_convergence *job, int kind, int quantity)
{
    for (uint32_t i = 0; i < job->settings; i++) {
        double value = setting_quantity(&job->setting[i], quantity);
        if (job->setting[i].kind == kind &&
            (value > 0.0 || (value == 0.0 && quantity != CHART_ESTIMATE))) {
            return 1;
        }
    }
    return 0;
}

static void curve_add(const lrcs_host_convergence *job, chart_curves *all, int kind, int quantity,
                      int named)
{
    static const char *const what[] = {"error", "bound", "estimate"};
    static const int dash[] = {LRCS_HOST_SOLID, LRCS_HOST_DASHED, LRCS_HOST_DOTTED};
    chart_curve *curve = &all->curve[all->count];
    lrcs_host_series *series = &all->series[all->count++];
    *series = (lrcs_host_series){.name = curve->name,
                                 .x = curve->x,
                                 .y = curve->y,
                                 .label = curve->label,
                                 .colour = chart_kinds[kind].colour,
                                 .marker = quantity == CHART_ESTIMATE ? LRCS_HOST_CROSS
                                                                      : chart_kinds[kind].marker,
                                 .dash = dash[quantity],
                                 .hollow = quantity == CHART_BOUND};
    int method = 0;
    for (uint32_t i = 0; i < job->settings; i++) {
        double value = setting_quantity(&job->setting[i], quantity);
        method = job->setting[i].kind == kind ? job->setting[i].method : method;
        if (job->setting[i].kind == kind && value >= 0.0) {
            int has_name = named && all->short_name[i][0];
            curve->x[series->count] = 1e3 * job->setting[i].pose_s;
            curve->y[series->count] = lrcs_host_convergence_relative(job, value);
            curve->label[series->count++] = has_name ? all->short_name[i] : NULL;
        }
    }
    /* "zbuffer N: bound", "exact, mesh 1e-k: error" */
    const char *position = kind == LRCS_HOST_CONVERGENCE_KIND_MESH      ? ", mesh 1e-k"
                           : kind == LRCS_HOST_CONVERGENCE_KIND_ZBUFFER ? " N"
                                                                        : "";
    snprintf(curve->name, sizeof curve->name, "%s%s: %s",
             kind == LRCS_HOST_CONVERGENCE_KIND_PREVIEW ? "accepted by estimate"
                                                        : lrcs_method_text(method),
             position, what[quantity]);
}

/* "256" for a raster, "1e-3" for a mesh. */
static void short_names(const lrcs_host_convergence *job, chart_curves *all)
{
    for (uint32_t i = 0; i < job->settings; i++) {
        const lrcs_host_convergence_setting *one = &job->setting[i];
        char *name = all->short_name[i];
        name[0] = '\0';
        if (one->kind == LRCS_HOST_CONVERGENCE_KIND_ZBUFFER) {
            snprintf(name, 16, "%lu", (unsigned long)one->resolution);
        } else if (one->kind == LRCS_HOST_CONVERGENCE_KIND_MESH) {
            snprintf(name, 16, "1e-%d", job->mesh[one->mesh].digits);
        } else if (one->kind == LRCS_HOST_CONVERGENCE_KIND_PREVIEW) {
            snprintf(name, 16, "1e-%d", one->digits);
        }
    }
}

int cli_converge_chart(FILE *out, const void *context, int png, lrcs_host_error *error)
{
    const converge_job *from = context;
    const lrcs_host_convergence *job = &from->all;
    chart_curves all = {.count = 0};
    double s_hat[3];
    cli_pose_unit(&job->pose, s_hat);
    char title[256];
    char note[256];
    snprintf(title, sizeof title, "What accuracy costs in time: %s", cli_base_name(from->title));
    snprintf(note, sizeof note, "truth: %s; sigma = %.9g m2; laser at (%.3g, %.3g, %.3g)",
             job->truth.text, job->truth.sigma_m2, s_hat[0], s_hat[1], s_hat[2]);
    /* the smallest value of the axis: the uncertainty of the truth, or the roundoff of a double;
       never 0, which a logarithmic axis cannot show */
    double floor = lrcs_host_convergence_relative(job, job->truth.bound_m2);
    floor = job->truth.sigma_m2 > 0.0 ? fmax(floor, CHART_ROUNDOFF) : floor > 0.0 ? floor : 1e-16;
    short_names(job, &all);
    for (int kind = 0; kind < LRCS_HOST_CONVERGENCE_KINDS; kind++) {
        /* the upper curve has the settings' names; a preview has the bound of its raster, which is
           no reason to choose it */
        int preview = kind == LRCS_HOST_CONVERGENCE_KIND_PREVIEW;
        int bounds = !preview && curve_known(job, kind, CHART_BOUND);
        if (bounds) {
            curve_add(job, &all, kind, CHART_BOUND, 1);
        }
        if (curve_known(job, kind, CHART_ESTIMATE)) {
            curve_add(job, &all, kind, CHART_ESTIMATE, preview);
        }
        if (curve_known(job, kind, CHART_ERROR)) {
            curve_add(job, &all, kind, CHART_ERROR, !bounds && !preview);
        }
    }
    const lrcs_host_chart chart = {
        .title = title,
        .about = from->about,
        .note = note,
        .x_name = "time of one pose, median (ms)",
        .y_name = job->truth.sigma_m2 > 0.0 ? "error of sigma (relative to the truth)"
                                            : "error of sigma (m2)",
        .x_log = 1,
        .y_log = 1,
        .floor = floor,
        .floor_name = job->truth.true_shapes ? "truth's own bound" : "truth's bound (facets)",
        .series = all.series,
        .series_count = all.count};
    return cli_chart_put(out, &chart, png, error);
}
