/* SPDX-License-Identifier: MIT */
/* lrcs fit as charts: readings beside the fit, and what is left of them. It decides which series
   there are and when an axis is logarithmic; the host draws them. */
#include "cli/fit.h"

#include <math.h>
#include <stdlib.h>

#define CHART_CURVE 400u /* points of a fitted curve */
#define CHART_RANGE 20.0 /* a fit that spans more is drawn on a logarithmic axis */
#define CHART_FLOOR 0.1  /* of the least fitted value: what lies below it stands on the floor */
#define CHART_PI    3.14159265358979323846

typedef struct chart_points {
    double *x, *y;
    uint32_t count;
} chart_points;

static double kept_angle(const fit_material *material, int most)
{
    double angle = material->reading[0].angle_deg;
    for (uint32_t i = 0; i < material->count; i++) {
        double other = material->reading[i].angle_deg;
        angle = most ? fmax(angle, other) : fmin(angle, other);
    }
    return angle;
}

/* The readings, or their residuals, that are kept or that are not. */
static void points_take(const fit_job *job, int residuals, int outlier, chart_points *points)
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

/* The fit over all angles; its part without the glint or without the rest. */
static void curve_take(const fit_job *job, int parts, chart_points *points)
{
    const fit_material *material = &job->material[0];
    lrcs_brdf brdf = material->fit.brdf;
    double first = kept_angle(material, 0);
    double last = kept_angle(material, 1);
    brdf.A = parts & 1 ? brdf.A : 0.0;
    brdf.B = parts & 2 ? brdf.B : 0.0;
    points->count = CHART_CURVE;
    for (uint32_t i = 0; i < CHART_CURVE; i++) {
        double deg = first + (last - first) * i / (CHART_CURVE - 1);
        double cosine = cos(deg * CHART_PI / 180.0);
        points->x[i] = deg;
        points->y[i] = lrcs_brdf_eval(&brdf, cosine) * (job->options.cosine ? cosine : 1.0);
    }
}

static void line_take(const fit_material *material, double y, chart_points *points)
{
    points->count = 2;
    points->x[0] = kept_angle(material, 0);
    points->x[1] = kept_angle(material, 1);
    points->y[0] = points->y[1] = y;
}

enum { CHART_KEPT, CHART_OUTLIERS, CHART_FIT, CHART_GLINT, CHART_DIFFUSE, CHART_SERIES };

static const lrcs_host_series chart_looks[2][CHART_SERIES] = {
    {{.name = "readings", .colour = LRCS_HOST_BLUE, .dash = LRCS_HOST_NO_LINE, .hollow = 1},
     {.name = "set aside",
      .colour = LRCS_HOST_VERMILION,
      .dash = LRCS_HOST_NO_LINE,
      .marker = LRCS_HOST_CROSS},
     {.name = "fit", .colour = LRCS_HOST_BLACK, .marker = LRCS_HOST_NO_MARKER},
     {.name = "glint",
      .colour = LRCS_HOST_ORANGE,
      .marker = LRCS_HOST_NO_MARKER,
      .dash = LRCS_HOST_DASHED},
     {.name = "diffuse",
      .colour = LRCS_HOST_GREEN,
      .marker = LRCS_HOST_NO_MARKER,
      .dash = LRCS_HOST_DASHED}},
    {{.name = "residuals", .colour = LRCS_HOST_BLUE, .dash = LRCS_HOST_NO_LINE, .hollow = 1},
     {.name = "set aside",
      .colour = LRCS_HOST_VERMILION,
      .dash = LRCS_HOST_NO_LINE,
      .marker = LRCS_HOST_CROSS},
     {.name = "fit", .colour = LRCS_HOST_BLACK, .marker = LRCS_HOST_NO_MARKER},
     {.name = "+2 errors",
      .colour = LRCS_HOST_BLACK,
      .marker = LRCS_HOST_NO_MARKER,
      .dash = LRCS_HOST_DOTTED},
     {.name = "-2 errors",
      .colour = LRCS_HOST_BLACK,
      .marker = LRCS_HOST_NO_MARKER,
      .dash = LRCS_HOST_DOTTED}}};

/* Fills all series of a chart. */
static void series_take(const fit_job *job, int residuals, chart_points points[CHART_SERIES])
{
    points_take(job, residuals, 0, &points[CHART_KEPT]);
    points_take(job, residuals, 1, &points[CHART_OUTLIERS]);
    if (residuals) {
        line_take(&job->material[0], 0.0, &points[CHART_FIT]);
        line_take(&job->material[0], 2.0, &points[CHART_GLINT]);
        line_take(&job->material[0], -2.0, &points[CHART_DIFFUSE]);
    } else {
        curve_take(job, 3, &points[CHART_FIT]);
        curve_take(job, 1, &points[CHART_GLINT]);
        curve_take(job, 2, &points[CHART_DIFFUSE]);
    }
}

/* A fit that spans decades has a logarithmic axis down to a floor that holds all of it. */
static void axis_choose(const chart_points *curve, lrcs_host_chart *chart)
{
    double least = curve->y[0];
    double most = curve->y[0];
    for (uint32_t i = 0; i < curve->count; i++) {
        least = fmin(least, curve->y[i]);
        most = fmax(most, curve->y[i]);
    }
    if (most > CHART_RANGE * least) {
        chart->y_log = 1;
        chart->floor = CHART_FLOOR * fmax(least, 1e-6 * most);
        chart->floor_name = "below";
    }
}

static int chart_draw(const fit_job *job, int residuals, int png, FILE *out,
                      chart_points points[CHART_SERIES], lrcs_host_error *error)
{
    const fit_material *material = &job->material[0];
    const lrcs_brdf *brdf = &material->fit.brdf;
    lrcs_host_series series[CHART_SERIES];
    char title[256];
    char note[256];
    uint32_t count = 0;
    series_take(job, residuals, points);
    for (int i = 0; i < CHART_SERIES; i++) {
        series[count] = chart_looks[residuals][i];
        series[count].x = points[i].x;
        series[count].y = points[i].y;
        series[count].count = points[i].count;
        count += points[i].count > 0;
    }
    snprintf(title, sizeof title, "%s of %s", residuals ? "Residuals" : "BRDF", material->name);
    snprintf(note, sizeof note, "A = %.5g /sr, B = %.5g /sr, s = %.5g, m = %.5g; rms %.3g /sr",
             brdf->A, brdf->B, brdf->s, brdf->m, material->fit.rms);
    lrcs_host_chart chart = {.title = title,
                             .note = note,
                             .x_name = "angle from the normal (deg)",
                             .y_name = residuals             ? "residual (standard errors)"
                                       : job->options.cosine ? "f_r cos(theta) (1/sr)"
                                                             : "f_r (1/sr)",
                             .series = series,
                             .series_count = count};
    if (!residuals) {
        axis_choose(&points[CHART_FIT], &chart);
    }
    if (png) {
        return lrcs_host_chart_png(out, &chart, error);
    }
    lrcs_host_chart_svg(out, &chart);
    return LRCS_OK;
}

int cli_fit_chart(const fit_job *job, int residuals, int png, FILE *out, lrcs_host_error *error)
{
    uint32_t count = job->material[0].count;
    size_t room = count > CHART_CURVE ? count : CHART_CURVE;
    double *number = malloc(2 * CHART_SERIES * room * sizeof *number);
    chart_points points[CHART_SERIES];
    if (!number) {
        snprintf(error->text, sizeof error->text, "out of memory");
        return LRCS_E_SYSTEM;
    }
    for (int i = 0; i < CHART_SERIES; i++) {
        points[i] =
            (chart_points){number + 2 * (size_t)i * room, number + (2 * (size_t)i + 1) * room, 0};
    }
    int status = chart_draw(job, residuals, png, out, points, error);
    free(number);
    return status;
}
