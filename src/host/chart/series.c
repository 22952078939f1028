/* SPDX-License-Identifier: MIT */
/* The appearance of series, titles and legends, the same in every chart. Each kind of chart decides
   the positions of its data. */
#include "host/chart/series.h"

#include "base/constant.h"
#include "host/chart/letters.h"
#include "host/chart/palette.h"

#include <math.h>

#define BAND_TINT 0.25 /* the fraction of a colour in the tint of a band */

/* ---- axes ---- */

double lrcsi_chart_x(const lrcsi_chart_axes *axes, double value)
{
    return LRCSI_CHART_LEFT + lrcsi_axis_at(&axes->x, value) * (axes->right - LRCSI_CHART_LEFT);
}

double lrcsi_chart_y(const lrcsi_chart_axes *axes, double value)
{
    return LRCSI_CHART_BOTTOM -
           lrcsi_axis_at(&axes->y, value) * (LRCSI_CHART_BOTTOM - LRCSI_CHART_TOP);
}

void lrcsi_chart_number(lrcsi_plotter *plotter, const char *text, lrcsi_plot_point at, double size,
                        int anchor)
{
    const lrcsi_plot_text label = {.text = text,
                                   .at = {at.x, at.y + LRCSI_CHART_DROP * size},
                                   .size = size,
                                   .anchor = anchor,
                                   .colour = LRCSI_COLOUR_TEXT};
    plotter->text(plotter, &label);
}

void lrcsi_chart_number_over(lrcsi_plotter *plotter, const char *text, lrcsi_plot_point at,
                             double size)
{
    double half = 0.5 * size * lrcsi_letters_width(text) + 2.0;
    lrcsi_plot_rectangle(plotter, at.x - half, at.y - 7.0, at.x + half, at.y + 7.0,
                         LRCSI_COLOUR_BACKGROUND);
    lrcsi_chart_number(plotter, text, at, size, LRCSI_ANCHOR_MIDDLE);
}

/* A mark at a point of an axis, with its number below or, on an upright axis, to the left. */
static void tick_draw(lrcsi_plotter *plotter, const lrcsi_tick *tick, lrcsi_plot_point at,
                      int upright)
{
    double length = tick->major ? 5.0 : 3.0;
    lrcsi_plot_point end = {at.x - (upright ? length : 0.0), at.y + (upright ? 0.0 : length)};
    lrcsi_plot_text label = {.text = tick->text,
                             .raised = tick->raised[0] ? tick->raised : NULL,
                             .at = {at.x, at.y + 19.0},
                             .size = LRCSI_CHART_SMALL,
                             .anchor = LRCSI_ANCHOR_MIDDLE,
                             .colour = LRCSI_COLOUR_TEXT};
    if (upright) {
        label.at = (lrcsi_plot_point){at.x - 9.0, at.y + LRCSI_CHART_DROP * LRCSI_CHART_SMALL};
        label.anchor = LRCSI_ANCHOR_RIGHT;
    }
    lrcsi_plot_line(plotter, at.x, at.y, end.x, end.y, LRCSI_COLOUR_TEXT, 0.9);
    if (tick->major) {
        plotter->text(plotter, &label);
    }
}

void lrcsi_chart_box(lrcsi_plotter *plotter, double left, double right)
{
    const lrcsi_plot_point corner[5] = {{left, LRCSI_CHART_TOP},
                                        {right, LRCSI_CHART_TOP},
                                        {right, LRCSI_CHART_BOTTOM},
                                        {left, LRCSI_CHART_BOTTOM},
                                        {left, LRCSI_CHART_TOP}};
    const lrcsi_line_style style = {LRCSI_COLOUR_TEXT, 0.9, {0.0, 0.0}};
    plotter->line(plotter, corner, 5, &style);
}

void lrcsi_chart_frame(lrcsi_plotter *plotter, const lrcsi_chart_axes *axes)
{
    lrcsi_chart_box(plotter, LRCSI_CHART_LEFT, axes->right);
    for (uint32_t i = 0; i < axes->x.count; i++) {
        const lrcsi_tick *tick = &axes->x.tick[i];
        const lrcsi_plot_point at = {lrcsi_chart_x(axes, tick->value), LRCSI_CHART_BOTTOM};
        tick_draw(plotter, tick, at, 0);
    }
    for (uint32_t i = 0; i < axes->y.count; i++) {
        const lrcsi_tick *tick = &axes->y.tick[i];
        const lrcsi_plot_point at = {LRCSI_CHART_LEFT, lrcsi_chart_y(axes, tick->value)};
        tick_draw(plotter, tick, at, 1);
    }
}

/* ---- series ---- */

lrcsi_line_style lrcsi_series_ink(const lrcs_host_series *series)
{
    static const double dash[3][2] = {{0.0, 0.0}, {7.0, 5.0}, {0.1, 4.5}};
    lrcsi_line_style style = {lrcsi_palette_named(series->colour), 1.7, {0.0, 0.0}};
    int kind =
        series->dash == LRCS_HOST_DASHED || series->dash == LRCS_HOST_DOTTED ? series->dash : 0;
    style.dash[0] = dash[kind][0];
    style.dash[1] = dash[kind][1];
    style.width = kind == LRCS_HOST_DOTTED ? 2.2 : 1.7;
    return style;
}

/* The corners of a marker about the origin, half a width of 1; their number. */
static uint32_t marker_corners(int marker, lrcsi_plot_point corner[24])
{
    static const lrcsi_plot_point square[4] = {{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.9}, {-0.9, 0.9}};
    static const lrcsi_plot_point triangle[3] = {{0.0, -1.25}, {1.15, 0.8}, {-1.15, 0.8}};
    static const lrcsi_plot_point diamond[4] = {{0.0, -1.3}, {1.3, 0.0}, {0.0, 1.3}, {-1.3, 0.0}};
    const lrcsi_plot_point *from = marker == LRCS_HOST_SQUARE     ? square
                                   : marker == LRCS_HOST_TRIANGLE ? triangle
                                   : marker == LRCS_HOST_DIAMOND  ? diamond
                                                                  : NULL;
    uint32_t count = !from ? 24 : from == triangle ? 3 : 4;
    for (uint32_t i = 0; i < count; i++) {
        double angle = 2.0 * LRCS_PI * i / 24.0;
        corner[i] = from ? from[i] : (lrcsi_plot_point){cos(angle), sin(angle)};
    }
    return count;
}

void lrcsi_series_marker(lrcsi_plotter *plotter, const lrcs_host_series *series,
                         lrcsi_plot_point at)
{
    lrcsi_plot_point corner[25];
    uint32_t colour = lrcsi_palette_named(series->colour);
    const lrcsi_line_style style = {colour, 1.4, {0.0, 0.0}};
    if (series->marker == LRCS_HOST_NO_MARKER) {
        return;
    }
    if (series->marker == LRCS_HOST_CROSS) {
        lrcsi_plot_line(plotter, at.x - LRCSI_CHART_MARK, at.y - LRCSI_CHART_MARK,
                        at.x + LRCSI_CHART_MARK, at.y + LRCSI_CHART_MARK, colour, 1.7);
        lrcsi_plot_line(plotter, at.x - LRCSI_CHART_MARK, at.y + LRCSI_CHART_MARK,
                        at.x + LRCSI_CHART_MARK, at.y - LRCSI_CHART_MARK, colour, 1.7);
        return;
    }
    uint32_t count = marker_corners(series->marker, corner);
    double half = series->hollow ? LRCSI_CHART_RING : LRCSI_CHART_MARK;
    for (uint32_t i = 0; i < count; i++) {
        corner[i].x = at.x + half * corner[i].x;
        corner[i].y = at.y + half * corner[i].y;
    }
    corner[count] = corner[0];
    plotter->area(plotter, corner, count, series->hollow ? LRCSI_COLOUR_BACKGROUND : colour);
    plotter->line(plotter, corner, count + 1, &style);
}

/* In a light tint. A line is drawn along the last side, which the next quadrilateral shares:
   without it the background would be visible in pixels that each of the two covers in part. */
void lrcsi_series_band(lrcsi_plotter *plotter, const lrcs_host_series *series,
                       const lrcsi_plot_point corner[4])
{
    uint32_t tint = lrcsi_palette_tint(lrcsi_palette_named(series->colour), BAND_TINT);
    plotter->area(plotter, corner, 4, tint);
    lrcsi_plot_line(plotter, corner[2].x, corner[2].y, corner[3].x, corner[3].y, tint, 0.7);
}

/* ---- titles and legends ---- */

void lrcsi_chart_title(lrcsi_plotter *plotter, const char *title, const char *note)
{
    double room = LRCSI_CHART_WIDTH - LRCSI_CHART_LEFT - LRCSI_CHART_MARGIN;
    const lrcsi_plot_text first = {.text = title,
                                   .at = {LRCSI_CHART_LEFT, 26.0},
                                   .size = 16.0,
                                   .bold = 1,
                                   .colour = LRCSI_COLOUR_TEXT};
    const lrcsi_plot_text second = {.text = note ? note : "",
                                    .at = {LRCSI_CHART_LEFT, 46.0},
                                    .size = LRCSI_CHART_SMALL,
                                    .colour = LRCSI_COLOUR_FAINT};
    lrcsi_letters_fit(plotter, first, room);
    lrcsi_letters_fit(plotter, second, room);
}

void lrcsi_chart_names(lrcsi_plotter *plotter, double right, const char *x_name, const char *y_name)
{
    const lrcsi_plot_text below = {
        .text = x_name,
        .at = {0.5 * (LRCSI_CHART_LEFT + right), LRCSI_CHART_HEIGHT - 14.0},
        .size = LRCSI_CHART_NAMES,
        .anchor = LRCSI_ANCHOR_MIDDLE,
        .colour = LRCSI_COLOUR_TEXT};
    const lrcsi_plot_text beside = {.text = y_name,
                                    .at = {22.0, 0.5 * (LRCSI_CHART_TOP + LRCSI_CHART_BOTTOM)},
                                    .size = LRCSI_CHART_NAMES,
                                    .anchor = LRCSI_ANCHOR_MIDDLE,
                                    .upwards = 1,
                                    .colour = LRCSI_COLOUR_TEXT};
    lrcsi_letters_fit(plotter, below, right - LRCSI_CHART_LEFT);
    lrcsi_letters_fit(plotter, beside, LRCSI_CHART_BOTTOM - LRCSI_CHART_TOP);
}

double lrcsi_chart_legend_width(const lrcs_host_chart *chart)
{
    double widest = chart->floor_name ? lrcsi_letters_width(chart->floor_name) : 0.0;
    for (uint32_t i = 0; i < chart->series_count; i++) {
        const char *name = chart->series[i].name;
        widest = fmax(widest, name ? lrcsi_letters_width(name) : 0.0);
    }
    return widest > 0.0 ? LRCSI_CHART_SAMPLE + 10.0 + LRCSI_CHART_SMALL * widest : 0.0;
}

double lrcsi_chart_legend(lrcsi_plotter *plotter, const lrcs_host_chart *chart, double x, double y)
{
    for (uint32_t i = 0; i < chart->series_count; i++) {
        const lrcs_host_series *series = &chart->series[i];
        const lrcsi_line_style style = lrcsi_series_ink(series);
        const lrcsi_plot_point sample[2] = {{x, y}, {x + LRCSI_CHART_SAMPLE, y}};
        if (!series->name) {
            continue;
        }
        if (series->dash != LRCS_HOST_NO_LINE) {
            plotter->line(plotter, sample, 2, &style);
        }
        lrcsi_series_marker(plotter, series, (lrcsi_plot_point){x + 0.5 * LRCSI_CHART_SAMPLE, y});
        lrcsi_chart_number(plotter, series->name,
                           (lrcsi_plot_point){x + LRCSI_CHART_SAMPLE + 8.0, y}, LRCSI_CHART_SMALL,
                           LRCSI_ANCHOR_LEFT);
        y += LRCSI_CHART_LINE;
    }
    return y;
}
