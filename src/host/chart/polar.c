/* SPDX-License-Identifier: MIT */
/* A chart about a pole: its rings and spokes, and the positions of data. */
#include "base/constant.h"
#include "host/chart/axis.h"
#include "host/chart/letters.h"
#include "host/chart/series.h"

#include <math.h>
#include <string.h>

#define POLAR_DEPTH 40.0 /* values that far below the largest are drawn at the pole */
#define POLAR_RINGS 5.0
#define POLAR_SPOKE 30   /* deg */
#define POLAR_ROOM  26.0 /* for the spokes' names */

typedef struct polar_layout {
    const lrcs_host_chart *chart;
    lrcsi_plotter *plotter;
    lrcsi_axis axis;
    lrcsi_plot_point pole;
    double radius;
} polar_layout;

static lrcsi_plot_point polar_point(const polar_layout *layout, double deg, double fraction)
{
    double away = layout->radius * fraction;
    return (lrcsi_plot_point){layout->pole.x + away * cos(deg * LRCS_RADIANS_PER_DEGREE),
                              layout->pole.y - away * sin(deg * LRCS_RADIANS_PER_DEGREE)};
}

/* The range of distances to be shown; unless it begins at 0, at most POLAR_DEPTH. */
static void polar_range(const lrcs_host_chart *chart, double range[2])
{
    range[0] = HUGE_VAL;
    range[1] = -HUGE_VAL;
    for (uint32_t i = 0; i < chart->series_count; i++) {
        for (uint32_t k = 0; k < chart->series[i].count; k++) {
            double y = chart->series[i].y[k];
            if (isfinite(y)) {
                range[0] = fmin(range[0], y);
                range[1] = fmax(range[1], y);
            }
            double high = chart->series[i].high ? chart->series[i].high[k] : y;
            if (isfinite(high)) { /* low ends may lie far below */
                range[1] = fmax(range[1], high);
            }
        }
    }
    range[0] = chart->y_from_0 ? 0.0 : fmax(range[0], range[1] - POLAR_DEPTH);
}

/* Spokes with their angles, and a ring at each labelled distance. */
static void polar_background(const polar_layout *layout)
{
    for (int deg = 0; deg < 360; deg += POLAR_SPOKE) {
        char text[16];
        lrcsi_plot_point end = polar_point(layout, deg, 1.0);
        snprintf(text, sizeof text, "%d", deg);
        lrcsi_plot_line(layout->plotter, layout->pole.x, layout->pole.y, end.x, end.y,
                        LRCSI_COLOUR_GRID, 0.9);
        lrcsi_chart_number(layout->plotter, text,
                           polar_point(layout, deg, 1.0 + 15.0 / layout->radius), LRCSI_CHART_SMALL,
                           LRCSI_ANCHOR_MIDDLE);
    }
    for (uint32_t i = 0; i < layout->axis.count; i++) {
        const lrcsi_tick *tick = &layout->axis.tick[i];
        double fraction = lrcsi_axis_at(&layout->axis, tick->value);
        if (!tick->major || !(fraction > 0.0)) {
            continue;
        }
        int last = i + 1 == layout->axis.count;
        const lrcsi_line_style style = {
            last ? LRCSI_COLOUR_TEXT : LRCSI_COLOUR_GRID, 0.9, {0.0, 0.0}};
        lrcsi_plot_point ring[181];
        for (int k = 0; k <= 180; k++) {
            ring[k] = polar_point(layout, 2.0 * k, fraction);
        }
        layout->plotter->line(layout->plotter, ring, 181, &style);
    }
}

/* A point at an angle and a distance; distances that lie below the pole are drawn at it. */
static lrcsi_plot_point polar_place(const polar_layout *layout, double deg, double value)
{
    double fraction = isfinite(value) ? fmax(lrcsi_axis_at(&layout->axis, value), 0.0) : 0.0;
    return polar_point(layout, deg, fraction);
}

/* A series' band, from point to point. */
static void polar_band(const polar_layout *layout, const lrcs_host_series *series)
{
    for (uint32_t i = 1; series->low && series->high && i < series->count; i++) {
        const double *x = &series->x[i - 1];
        if (isfinite(x[0]) && isfinite(x[1])) {
            const lrcsi_plot_point corner[4] = {polar_place(layout, x[0], series->low[i - 1]),
                                                polar_place(layout, x[0], series->high[i - 1]),
                                                polar_place(layout, x[1], series->high[i]),
                                                polar_place(layout, x[1], series->low[i])};
            lrcsi_series_band(layout->plotter, series, corner);
        }
    }
}

/* A line as long as its points can be shown; points below the pole are drawn at it. */
static void polar_line(const polar_layout *layout, const lrcs_host_series *series)
{
    const lrcsi_line_style style = lrcsi_series_ink(series);
    lrcsi_plot_point point[256];
    uint32_t count = 0;
    for (uint32_t i = 0; i < series->count; i++) {
        int shown = isfinite(series->x[i]) && isfinite(series->y[i]);
        if (shown) {
            point[count++] = polar_place(layout, series->x[i], series->y[i]);
        }
        if (shown && count < sizeof point / sizeof point[0] && i + 1 < series->count) {
            continue;
        }
        if (count > 1) {
            layout->plotter->line(layout->plotter, point, count, &style);
        }
        if (shown) { /* the line goes on from here */
            point[0] = point[count - 1];
        }
        count = shown ? 1 : 0;
    }
}

/* The numbers of the pole and the rings, along a ray between two spokes, on a background that
   covers the lines; the title; and the meaning of the distance and of the angle, as text beside the
   chart. */
static void polar_labels(const polar_layout *layout, double left)
{
    for (uint32_t i = 0; i < layout->axis.count; i++) {
        const lrcsi_tick *tick = &layout->axis.tick[i];
        double fraction = lrcsi_axis_at(&layout->axis, tick->value);
        if (tick->major && fraction >= 0.0) {
            lrcsi_chart_number_over(layout->plotter, tick->text,
                                    polar_point(layout, 75.0, fraction), LRCSI_CHART_SMALL - 1.0);
        }
    }
    lrcsi_chart_title(layout->plotter, layout->chart->title, layout->chart->note);
    char text[256];
    lrcsi_plot_text label = {.text = text,
                             .at = {left, LRCSI_CHART_TOP + 24.0},
                             .size = LRCSI_CHART_NAMES,
                             .colour = LRCSI_COLOUR_TEXT};
    double room = LRCSI_CHART_WIDTH - left - LRCSI_CHART_MARGIN;
    const char *unit = strchr(layout->chart->y_name, '(');
    snprintf(text, sizeof text, "radius: %.100s; centre: %s %.*s", layout->chart->y_name,
             layout->axis.tick[0].text, unit ? (int)strcspn(unit + 1, ")") : 0,
             unit ? unit + 1 : "");
    lrcsi_letters_fit(layout->plotter, label, room);
    label.at.y += 19.0;
    snprintf(text, sizeof text, "angle: %.200s", layout->chart->x_name);
    lrcsi_letters_fit(layout->plotter, label, room);
}

void lrcsi_polar_draw(const lrcs_host_chart *chart, lrcsi_plotter *plotter)
{
    double range[2];
    polar_range(chart, range);
    double high = LRCSI_CHART_HEIGHT - LRCSI_CHART_TOP - LRCSI_CHART_MARGIN;
    polar_layout layout = {.chart = chart,
                           .plotter = plotter,
                           .axis = lrcsi_axis_make(0, range[0], range[1], POLAR_RINGS),
                           .radius = 0.5 * high - POLAR_ROOM};
    layout.pole.x = LRCSI_CHART_LEFT + 0.5 * high;
    layout.pole.y = LRCSI_CHART_TOP + 0.5 * high;
    double right = layout.pole.x + 0.5 * high + LRCSI_CHART_MARGIN;
    polar_background(&layout);
    for (uint32_t i = 0; i < chart->series_count; i++) {
        polar_band(&layout, &chart->series[i]);
    }
    for (uint32_t i = 0; i < chart->series_count; i++) {
        polar_line(&layout, &chart->series[i]);
    }
    polar_labels(&layout, right);
    lrcsi_chart_legend(plotter, chart, right, LRCSI_CHART_TOP + 72.0);
}
