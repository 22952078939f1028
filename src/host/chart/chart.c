/* SPDX-License-Identifier: MIT */
/* A chart from its description: the layout and the order of drawing. axis.c chooses ticks; the
   plotter writes SVG or pixels. */
#include "host/chart/axis.h"
#include "host/chart/canvas.h"
#include "host/chart/label.h"
#include "host/chart/letters.h"
#include "host/chart/palette.h"
#include "host/chart/series.h"
#include "host/chart/svg.h"

#include <math.h>

#define GRID_TICKS_MAX 60u /* ticks */

typedef struct chart_layout {
    const lrcs_host_chart *chart;
    lrcsi_plotter *plotter;
    lrcsi_chart_axes axes; /* the legend is to the right of them */
    lrcsi_label_area *labels;
} chart_layout;

/* ---- positions ---- */

/* A value as the axis shows it; returns 0 if it cannot. */
static int chart_shows(int log, double floor, double *value)
{
    if (log && floor > 0.0 && *value <= floor) {
        *value = floor;
    }
    return fabs(*value) <= 0.1 * LRCSI_AXIS_MAX && (!log || *value >= 10.0 * LRCSI_AXIS_MIN);
}

static int chart_point(const chart_layout *layout, const lrcs_host_series *series, uint32_t i,
                       lrcsi_plot_point *point)
{
    const lrcs_host_chart *chart = layout->chart;
    double x = series->x[i];
    double y = series->y[i];
    if (!chart_shows(chart->x_log, 0.0, &x) || !chart_shows(chart->y_log, chart->floor, &y)) {
        return 0;
    }
    *point = (lrcsi_plot_point){lrcsi_chart_x(&layout->axes, x), lrcsi_chart_y(&layout->axes, y)};
    return 1;
}

/* The range of values that an axis has to show, with a small margin. */
static void chart_range(const lrcs_host_chart *chart, int vertical, double range[2])
{
    int log = vertical ? chart->y_log : chart->x_log;
    double floor = vertical && log ? chart->floor : 0.0;
    range[0] = HUGE_VAL;
    range[1] = -HUGE_VAL;
    for (uint32_t i = 0; i < chart->series_count; i++) {
        const lrcs_host_series *series = &chart->series[i];
        for (uint32_t k = 0; k < series->count; k++) {
            double value = vertical ? series->y[k] : series->x[k];
            if (chart_shows(log, floor, &value)) {
                range[0] = fmin(range[0], value);
                range[1] = fmax(range[1], value);
            }
            double high = vertical && series->high ? series->high[k] : HUGE_VAL;
            if (chart_shows(log, floor, &high)) { /* low ends may lie far below */
                range[1] = fmax(range[1], high);
            }
        }
    }
    if (vertical && chart->y_from_0 && !log) {
        range[0] = fmin(range[0], 0.0);
    }
    if (floor > 0.0) { /* room for the arrows; an axis of less than three decades would exaggerate
                          differences */
        range[0] = floor / 5.0;
        range[1] = fmax(range[1], 1000.0 * range[0]);
    }
    if (log) {
        range[0] /= 1.2;
        range[1] *= vertical ? 4.0 : 1.2; /* room for labels above */
    }
}

/* ---- the frame ---- */

/* Lines at the major ticks, or at the minor ones if these are not too dense. */
static void chart_grid(const chart_layout *layout, int major)
{
    uint32_t colour = major ? LRCSI_COLOUR_GRID : LRCSI_COLOUR_MINOR;
    double width = major ? 0.9 : 0.7;
    for (uint32_t i = 0; i < layout->axes.x.count; i++) {
        double x = lrcsi_chart_x(&layout->axes, layout->axes.x.tick[i].value);
        if (layout->axes.x.tick[i].major == major &&
            (major || layout->axes.x.count <= GRID_TICKS_MAX)) {
            lrcsi_plot_line(layout->plotter, x, LRCSI_CHART_TOP, x, LRCSI_CHART_BOTTOM, colour,
                            width);
        }
    }
    for (uint32_t i = 0; i < layout->axes.y.count; i++) {
        double y = lrcsi_chart_y(&layout->axes, layout->axes.y.tick[i].value);
        if (layout->axes.y.tick[i].major == major &&
            (major || layout->axes.y.count <= GRID_TICKS_MAX)) {
            lrcsi_plot_line(layout->plotter, LRCSI_CHART_LEFT, y, layout->axes.right, y, colour,
                            width);
        }
    }
}

/* ---- the data ---- */

static void polyline_draw(const chart_layout *layout, const lrcs_host_series *series,
                          const lrcsi_plot_point *point, uint32_t count)
{
    const lrcsi_line_style style = lrcsi_series_ink(series);
    int joined = series->dash != LRCS_HOST_NO_LINE;
    if (count > 1 && joined) {
        layout->plotter->line(layout->plotter, point, count, &style);
    }
    for (uint32_t i = 0; i < count; i++) {
        lrcsi_label_avoid_point(layout->labels, point[i], LRCSI_CHART_RING);
        lrcsi_label_avoid_line(layout->labels, point[i > 0 && joined ? i - 1 : i], point[i]);
    }
}

/* A series' line, in polylines of at most 256 points; dashes restart with each. Values that cannot
   be shown leave a gap. */
static void series_line(const chart_layout *layout, const lrcs_host_series *series)
{
    lrcsi_plot_point point[256];
    uint32_t count = 0;
    for (uint32_t i = 0; i < series->count; i++) {
        if (!chart_point(layout, series, i, &point[count])) {
            polyline_draw(layout, series, point, count);
            count = 0;
        } else if (++count == sizeof point / sizeof point[0]) {
            polyline_draw(layout, series, point, count);
            point[0] = point[count - 1];
            count = 1;
        }
    }
    polyline_draw(layout, series, point, count);
}

/* The mark for a point that lies below the floor. */
static void arrow_draw(const chart_layout *layout, uint32_t colour, lrcsi_plot_point at)
{
    const lrcsi_plot_point head[3] = {
        {at.x - 3.2, at.y + 9.5}, {at.x + 3.2, at.y + 9.5}, {at.x, at.y + 14.5}};
    lrcsi_plot_line(layout->plotter, at.x, at.y + LRCSI_CHART_MARK, at.x, at.y + 10.0, colour, 1.4);
    layout->plotter->area(layout->plotter, head, 3, colour);
    lrcsi_label_avoid_line(layout->labels, at, head[2]);
}

static void series_marks(const chart_layout *layout, const lrcs_host_series *series)
{
    for (uint32_t i = 0; i < series->count; i++) {
        lrcsi_plot_point at;
        if (!chart_point(layout, series, i, &at)) {
            continue;
        }
        if (layout->chart->y_log && series->y[i] < layout->chart->floor &&
            series->marker != LRCS_HOST_NO_MARKER) {
            arrow_draw(layout, lrcsi_palette_named(series->colour), at);
        }
        lrcsi_series_marker(layout->plotter, series, at);
    }
}

static void series_labels(const chart_layout *layout, const lrcs_host_series *series)
{
    for (uint32_t i = 0; series->label && i < series->count; i++) {
        lrcsi_plot_point at;
        lrcsi_plot_text label = {
            .text = series->label[i], .size = 10.5, .colour = lrcsi_palette_named(series->colour)};
        if (label.text && chart_point(layout, series, i, &at) &&
            lrcsi_label_place(layout->labels, at, 8.0, label.text, label.size, &label.at)) {
            layout->plotter->text(layout->plotter, &label);
        }
    }
}

/* The position of an end of a band, clamped to the frame. */
static double band_y(const chart_layout *layout, double value)
{
    int shown = chart_shows(layout->chart->y_log, layout->chart->floor, &value);
    double y = shown         ? lrcsi_chart_y(&layout->axes, value)
               : value > 0.0 ? LRCSI_CHART_TOP
                             : LRCSI_CHART_BOTTOM;
    return fmin(LRCSI_CHART_BOTTOM, fmax(LRCSI_CHART_TOP, y));
}

/* A series' band, from point to point. */
static void series_band(const chart_layout *layout, const lrcs_host_series *series)
{
    for (uint32_t i = 1; series->low && series->high && i < series->count; i++) {
        double x[2] = {series->x[i - 1], series->x[i]};
        if (!chart_shows(layout->chart->x_log, 0.0, &x[0]) ||
            !chart_shows(layout->chart->x_log, 0.0, &x[1])) {
            continue;
        }
        const lrcsi_plot_point corner[4] = {
            {lrcsi_chart_x(&layout->axes, x[0]), band_y(layout, series->low[i - 1])},
            {lrcsi_chart_x(&layout->axes, x[0]), band_y(layout, series->high[i - 1])},
            {lrcsi_chart_x(&layout->axes, x[1]), band_y(layout, series->high[i])},
            {lrcsi_chart_x(&layout->axes, x[1]), band_y(layout, series->low[i])}};
        lrcsi_series_band(layout->plotter, series, corner);
    }
}

/* Draws a chart:
   1. the layout: the width of the legend, the ranges of the axes;
   2. the background: the region below the floor, where values are indistinguishable, and the grid;
   3. the data: all bands first, then all lines, then markers, so that nothing covers a marker, and
      labels where they find room;
   4. the frame with the axes, titles and names;
   5. the legend, with the meaning of the floor below the list of series. */
static void chart_draw(const lrcs_host_chart *chart, lrcsi_plotter *plotter)
{
    double legend = lrcsi_chart_legend_width(chart); /* 1 */
    double right =
        LRCSI_CHART_WIDTH - LRCSI_CHART_MARGIN - (legend > 0.0 ? legend + LRCSI_CHART_MARGIN : 8.0);
    right = fmax(right, 0.5 * LRCSI_CHART_WIDTH); /* a longer legend is cut */
    lrcsi_label_area labels = {.frame = {(float)LRCSI_CHART_LEFT, (float)LRCSI_CHART_TOP,
                                         (float)right, (float)LRCSI_CHART_BOTTOM}};
    chart_layout layout = {
        .chart = chart, .plotter = plotter, .axes = {.right = right}, .labels = &labels};
    double range[2];
    int kind = chart->x_log ? LRCSI_AXIS_LOG : chart->x_deg ? LRCSI_AXIS_DEG : LRCSI_AXIS_LINEAR;
    chart_range(chart, 0, range);
    layout.axes.x = lrcsi_axis_make(kind, range[0], range[1], (right - LRCSI_CHART_LEFT) / 55.0);
    chart_range(chart, 1, range);
    layout.axes.y = lrcsi_axis_make(chart->y_log, range[0], range[1],
                                    (LRCSI_CHART_BOTTOM - LRCSI_CHART_TOP) / 26.0);
    int floor = chart->y_log && chart->floor > 0.0; /* 2 */
    double floor_y = floor ? lrcsi_chart_y(&layout.axes, chart->floor) : LRCSI_CHART_BOTTOM;
    if (floor) {
        lrcsi_plot_rectangle(plotter, LRCSI_CHART_LEFT, floor_y, right, LRCSI_CHART_BOTTOM,
                             LRCSI_COLOUR_FLOOR);
    }
    chart_grid(&layout, 0);
    chart_grid(&layout, 1);
    if (floor) {
        lrcsi_plot_line(plotter, LRCSI_CHART_LEFT, floor_y, right, floor_y, LRCSI_COLOUR_FAINT,
                        1.2);
    }
    for (uint32_t i = 0; i < chart->series_count; i++) { /* 3 */
        series_band(&layout, &chart->series[i]);
    }
    for (uint32_t i = 0; i < chart->series_count; i++) {
        series_line(&layout, &chart->series[i]);
    }
    for (uint32_t i = 0; i < chart->series_count; i++) {
        series_marks(&layout, &chart->series[i]);
    }
    for (uint32_t i = 0; i < chart->series_count; i++) {
        series_labels(&layout, &chart->series[i]);
    }
    lrcsi_chart_frame(plotter, &layout.axes); /* 4 */
    lrcsi_chart_title(plotter, chart->title, chart->note);
    lrcsi_chart_names(plotter, right, chart->x_name, chart->y_name);
    double x = right + LRCSI_CHART_MARGIN; /* 5 */
    double y = lrcsi_chart_legend(plotter, chart, x, LRCSI_CHART_TOP + 8.0);
    if (floor && chart->floor_name) {
        lrcsi_plot_rectangle(plotter, x, y - 5.0, x + LRCSI_CHART_SAMPLE, y + 6.0,
                             LRCSI_COLOUR_FLOOR);
        lrcsi_plot_line(plotter, x, y - 5.0, x + LRCSI_CHART_SAMPLE, y - 5.0, LRCSI_COLOUR_FAINT,
                        1.2);
        arrow_draw(&layout, LRCSI_COLOUR_FAINT,
                   (lrcsi_plot_point){x + 0.5 * LRCSI_CHART_SAMPLE, y - 8.5});
        lrcsi_chart_number(plotter, chart->floor_name,
                           (lrcsi_plot_point){x + LRCSI_CHART_SAMPLE + 8.0, y}, LRCSI_CHART_SMALL,
                           LRCSI_ANCHOR_LEFT);
    }
}

/* A chart of either kind. */
static void chart_or_polar_draw(const lrcs_host_chart *chart, lrcsi_plotter *plotter)
{
    if (chart->polar) {
        lrcsi_polar_draw(chart, plotter);
    } else {
        chart_draw(chart, plotter);
    }
}

/* ---- in public ---- */

void lrcs_host_chart_svg(FILE *out, const lrcs_host_chart *chart)
{
    lrcsi_svg svg =
        lrcsi_svg_begin(out, LRCSI_CHART_WIDTH, LRCSI_CHART_HEIGHT, chart->title, chart->about);
    chart_or_polar_draw(chart, &svg.plotter);
    lrcsi_svg_end(&svg);
}

int lrcs_host_chart_png(FILE *out, const lrcs_host_chart *chart, lrcs_host_error *error)
{
    lrcsi_canvas canvas;
    int status = lrcsi_canvas_make(LRCSI_CHART_WIDTH, LRCSI_CHART_HEIGHT, LRCSI_CHART_PIXELS,
                                   &canvas, error);
    if (status == LRCS_OK) {
        chart_or_polar_draw(chart, &canvas.plotter);
        status = lrcsi_canvas_end(&canvas, out, chart->about, error);
    }
    return status;
}
