/* SPDX-License-Identifier: MIT */
/* The charts of lrcs fit: readings with the fit, and residuals. This file decides which series
   there are and when an axis is logarithmic; the host draws them. */
#include "cli/fit/fit.h"

#include <math.h>
#include <stdlib.h>

#define CHART_CURVE 400u /* number of points of a fitted curve */
#define CHART_RANGE 20.0 /* a fit with a larger ratio of values is drawn on a logarithmic axis */
/* share of the least fitted value: readings below it are drawn on the floor */
#define CHART_FLOOR 0.2
#define CHART_DEPTH 1e-6 /* share of the largest value: the floor is not below it */
#define CHART_EDGE  6.0  /* standard errors: larger residuals are drawn there with their number */

typedef struct chart_points {
    double *x, *y;
    uint32_t count;
} chart_points;

/* The label of a residual that is drawn on the edge, "" for the others. */
typedef struct chart_label {
    char text[16];
} chart_label;

static double end_angle(const fit_material *material, int most)
{
    double angle = material->reading[0].angle_deg;
    for (uint32_t i = 0; i < material->count; i++) {
        double other = material->reading[i].angle_deg;
        angle = most ? fmax(angle, other) : fmin(angle, other);
    }
    return angle;
}

/* The readings, or their residuals, that are kept or that are excluded. */
static void fit_points_make(const fit_job *job, int residuals, int outlier, chart_points *points)
{
    const fit_material *material = &job->material[0];
    points->count = 0;
    for (uint32_t i = 0; i < material->count; i++) {
        const lrcs_fit_point *point = &material->point[i];
        if (point->outlier == outlier) {
            points->x[points->count] = material->reading[i].angle_deg;
            points->y[points->count++] =
                residuals ? point->standard : job->options.unit * material->reading[i].value;
        }
    }
}

/* The fit over all angles, or one of its two parts, glint or diffuse. */
static void fit_curve_make(const fit_job *job, int parts, chart_points *points)
{
    const fit_material *material = &job->material[0];
    lrcs_brdf brdf = material->fit.brdf;
    double first = end_angle(material, 0);
    double last = end_angle(material, 1);
    if (parts != 3 && (brdf.A == 0.0 || brdf.B == 0.0)) {
        points->count = 0; /* the part equals the fit, or is 0 */
        return;
    }
    brdf.A = parts & 1 ? brdf.A : 0.0;
    brdf.B = parts & 2 ? brdf.B : 0.0;
    points->count = CHART_CURVE;
    for (uint32_t i = 0; i < CHART_CURVE; i++) {
        double deg = first + (last - first) * i / (CHART_CURVE - 1);
        double cosine = cos(deg * LRCS_PI / 180.0);
        points->x[i] = deg;
        points->y[i] = lrcs_brdf_eval(&brdf, cosine) * (job->options.cosine ? cosine : 1.0);
    }
}

static void level_line_make(const fit_material *material, double y, chart_points *points)
{
    points->count = 2;
    points->x[0] = end_angle(material, 0);
    points->x[1] = end_angle(material, 1);
    points->y[0] = points->y[1] = y;
}

enum { CHART_KEPT, CHART_OUTLIERS, CHART_FIT, CHART_GLINT, CHART_DIFFUSE, CHART_SERIES };

/* The third to fifth series of the two charts; the first two are readings, kept or set aside. */
static const struct {
    const char *name;
    int colour, dash;
} chart_lines[2][3] = {{{"fit", LRCS_HOST_BLACK, LRCS_HOST_SOLID},
                        {"glint", LRCS_HOST_ORANGE, LRCS_HOST_DASHED},
                        {"diffuse", LRCS_HOST_GREEN, LRCS_HOST_DASHED}},
                       {{"fit", LRCS_HOST_BLACK, LRCS_HOST_SOLID},
                        {"+2 errors", LRCS_HOST_BLACK, LRCS_HOST_DOTTED},
                        {"-2 errors", LRCS_HOST_BLACK, LRCS_HOST_DOTTED}}};

/* A fit that spans decades has a logarithmic axis, with a floor if readings need one; curves end
   where they fall below it. */
static void axis_choose(chart_points points[CHART_SERIES], lrcs_host_chart *chart)
{
    const chart_points *fit = &points[CHART_FIT];
    double least = fit->y[0];
    double most = fit->y[0];
    for (uint32_t i = 0; i < fit->count; i++) {
        least = fmin(least, fit->y[i]);
        most = fmax(most, fit->y[i]);
    }
    if (!(most > CHART_RANGE * least)) {
        return;
    }
    double floor = CHART_FLOOR * fmax(least, CHART_DEPTH * most);
    chart->y_log = 1;
    for (int k = 0; k < CHART_SERIES; k++) {
        for (uint32_t i = 0; i < points[k].count; i++) {
            int below = points[k].y[i] < floor;
            if (below && k <= CHART_OUTLIERS) {
                chart->floor = floor;
                chart->floor_name = "below";
            } else if (below) {
                points[k].y[i] = (double)NAN; /* not drawn */
            }
        }
    }
}

static int fit_chart_draw(const fit_job *job, int residuals, const char *path,
                          lrcs_host_series series[CHART_SERIES], chart_points points[CHART_SERIES])
{
    const fit_material *material = &job->material[0];
    const lrcs_brdf *brdf = &material->fit.brdf;
    char title[256];
    char note[256];
    snprintf(title, sizeof title, "%s of %s", residuals ? "Residuals" : "BRDF", material->name);
    snprintf(note, sizeof note, "A = %.5g /sr, B = %.5g /sr, s = %.5g, m = %.5g; rms %.3g /sr",
             brdf->A, brdf->B, brdf->s, brdf->m, material->fit.rms);
    lrcs_host_chart chart = {.title = title,
                             .note = note,
                             .x_name = "angle from the normal (deg)",
                             .y_name = residuals             ? "residual (standard errors)"
                                       : job->options.cosine ? "f_r cos(theta) (1/sr)"
                                                             : "f_r (1/sr)",
                             .series = series};
    if (!residuals) {
        axis_choose(points, &chart);
    }
    for (int i = 0; i < CHART_SERIES; i++) { /* only series that have points */
        const int kept = i == CHART_KEPT;
        lrcs_host_series one = {.name = kept ? residuals ? "residuals" : "readings" : "set aside",
                                .colour = kept ? LRCS_HOST_BLUE : LRCS_HOST_VERMILION,
                                .marker = kept ? LRCS_HOST_DISC : LRCS_HOST_CROSS,
                                .dash = LRCS_HOST_NO_LINE};
        if (i >= CHART_FIT) {
            one.name = chart_lines[residuals][i - CHART_FIT].name;
            one.colour = chart_lines[residuals][i - CHART_FIT].colour;
            one.dash = chart_lines[residuals][i - CHART_FIT].dash;
            one.marker = LRCS_HOST_NO_MARKER;
        }
        one.x = points[i].x;
        one.y = points[i].y;
        one.count = points[i].count;
        one.label = i <= CHART_OUTLIERS ? series[i].label : NULL;
        series[chart.series_count] = one;
        chart.series_count += one.count > 0;
    }
    char *about = cli_provenance_text(job->args, NULL);
    chart.about = about;
    int code = cli_chart_write(path, cli_chart_put, &chart);
    free(about);
    return code;
}

int cli_fit_chart(const fit_job *job, int residuals, const char *path)
{
    uint32_t count = job->material[0].count;
    size_t room = count > CHART_CURVE ? count : CHART_CURVE;
    double *number = malloc(2 * (size_t)CHART_SERIES * room * sizeof *number);
    chart_label *label = malloc(2 * room * sizeof *label);
    const char **text = malloc(2 * room * sizeof *text);
    int code = 0;
    if (!number || !label || !text) {
        code = cli_out_of_memory();
    } else {
        chart_points points[CHART_SERIES];
        lrcs_host_series series[CHART_SERIES] = {{.name = NULL}};
        for (size_t i = 0; i < CHART_SERIES; i++) {
            points[i] = (chart_points){number + 2 * i * room, number + (2 * i + 1) * room, 0};
        }
        fit_points_make(job, residuals, 0, &points[CHART_KEPT]);
        fit_points_make(job, residuals, 1, &points[CHART_OUTLIERS]);
        for (int k = CHART_FIT; k < CHART_SERIES; k++) {
            static const double line[] = {0.0, 2.0, -2.0};
            static const int parts[] = {3, 1, 2};
            if (residuals) {
                level_line_make(&job->material[0], line[k - CHART_FIT], &points[k]);
            } else {
                fit_curve_make(job, parts[k - CHART_FIT], &points[k]);
            }
        }
        for (size_t i = 0; residuals && i <= CHART_OUTLIERS; i++) {
            series[i].label = text + i * room;
            for (uint32_t k = 0; k < points[i].count;
                 k++) { /* those beyond the edge move onto it */
                double *y = &points[i].y[k];
                chart_label *own = &label[i * room + k];
                text[i * room + k] = NULL;
                if (fabs(*y) > CHART_EDGE) {
                    snprintf(own->text, sizeof own->text, "%.3g", *y);
                    text[i * room + k] = own->text;
                    *y = copysign(CHART_EDGE, *y);
                }
            }
        }
        code = fit_chart_draw(job, residuals, path, series, points);
    }
    free(number);
    free(label);
    free(text);
    return code;
}
