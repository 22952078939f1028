/* SPDX-License-Identifier: MIT */
/* Common parts of all kinds of charts: layout, appearance of series, titles and legends. */
#ifndef LRCSI_HOST_SERIES_H
#define LRCSI_HOST_SERIES_H

#include "host/chart/axis.h"
#include "host/chart/plotter.h"

/* The layout, in units of which a PNG has two pixels each. */
#define LRCSI_CHART_WIDTH  LRCS_HOST_CHART_WIDTH
#define LRCSI_CHART_HEIGHT LRCS_HOST_CHART_HEIGHT
#define LRCSI_CHART_PIXELS 2.0
#define LRCSI_CHART_LEFT   82.0
#define LRCSI_CHART_TOP    60.0
#define LRCSI_CHART_BOTTOM (LRCSI_CHART_HEIGHT - 58.0)
#define LRCSI_CHART_MARGIN 16.0

#define LRCSI_CHART_SMALL 12.0 /* type: ticks and legend */
#define LRCSI_CHART_NAMES 13.0 /* of axes */
#define LRCSI_CHART_DROP  0.36 /* of the size: from a text's middle to its base line */
#define LRCSI_CHART_MARK                                                                           \
    3.8 /* half a marker's width; hollow markers are larger, so that they show around full ones */
#define LRCSI_CHART_RING   5.8
#define LRCSI_CHART_LINE   19.0 /* from one line of a legend to the next */
#define LRCSI_CHART_SAMPLE 30.0

#define LRCSI_COLOUR_TEXT       0x222222u
#define LRCSI_COLOUR_FAINT      0x666666u
#define LRCSI_COLOUR_GRID       0xd9d9d9u
#define LRCSI_COLOUR_MINOR      0xefefefu
#define LRCSI_COLOUR_FLOOR      0xf4f1e8u
#define LRCSI_COLOUR_BACKGROUND 0xffffffu

lrcsi_line_style lrcsi_series_ink(const lrcs_host_series *series);
void lrcsi_series_marker(lrcsi_plotter *plotter, const lrcs_host_series *series,
                         lrcsi_plot_point at);

/* A quadrilateral of a series' band, from its first to its second point: low, high, high, low. */
void lrcsi_series_band(lrcsi_plotter *plotter, const lrcs_host_series *series,
                       const lrcsi_plot_point corner[4]);

/* A chart in a rectangle that extends from LRCSI_CHART_LEFT to `right`: its axes, and where a value
   is on them. */
typedef struct lrcsi_chart_axes {
    lrcsi_axis x, y;
    double right;
} lrcsi_chart_axes;

double lrcsi_chart_x(const lrcsi_chart_axes *axes, double value);
double lrcsi_chart_y(const lrcsi_chart_axes *axes, double value);

/* Draws the frame of the rectangle, and the marks and numbers of both axes. */
void lrcsi_chart_frame(lrcsi_plotter *plotter, const lrcsi_chart_axes *axes);

/* The frame of what is drawn between left and right. */
void lrcsi_chart_box(lrcsi_plotter *plotter, double left, double right);

/* A number at a point, which is its middle, its left end or its right end (lrcsi_anchor). */
void lrcsi_chart_number(lrcsi_plotter *plotter, const char *text, lrcsi_plot_point at, double size,
                        int anchor);

/* The same, by its middle, on a background that covers what is below it. */
void lrcsi_chart_number_over(lrcsi_plotter *plotter, const char *text, lrcsi_plot_point at,
                             double size);

/* The two lines above a chart. */
void lrcsi_chart_title(lrcsi_plotter *plotter, const char *title, const char *note);

/* The names of the axes of a chart that extends from LRCSI_CHART_LEFT to `right`. */
void lrcsi_chart_names(lrcsi_plotter *plotter, double right, const char *x_name,
                       const char *y_name);

/* The list of named series beside a chart: its width, 0 if no series has a name; and drawing it
   from its upper left corner, which returns the y of its end. */
double lrcsi_chart_legend_width(const lrcs_host_chart *chart);
double lrcsi_chart_legend(lrcsi_plotter *plotter, const lrcs_host_chart *chart, double x, double y);

/* A chart about a pole: x is an angle, deg, counter-clockwise from the right; y is the distance
   from the pole, at which the axis begins. */
void lrcsi_polar_draw(const lrcs_host_chart *chart, lrcsi_plotter *plotter);

#endif
