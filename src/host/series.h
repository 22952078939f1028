/* SPDX-License-Identifier: MIT */
/* Common parts of all kinds of charts: paper, appearance of series, titles and legends. */
#ifndef LRCSI_HOST_SERIES_H
#define LRCSI_HOST_SERIES_H

#include "host/axis.h"
#include "host/plotter.h"

/* Paper, in units of which a PNG has two pixels each. */
#define LRCSI_CHART_WIDTH  LRCS_HOST_CHART_WIDTH
#define LRCSI_CHART_HEIGHT LRCS_HOST_CHART_HEIGHT
#define LRCSI_CHART_PIXELS 2.0
#define LRCSI_CHART_LEFT   82.0
#define LRCSI_CHART_TOP    60.0
#define LRCSI_CHART_BOTTOM (LRCSI_CHART_HEIGHT - 58.0)
#define LRCSI_CHART_MARGIN 16.0

#define LRCSI_CHART_SMALL  12.0 /* type: ticks and legend */
#define LRCSI_CHART_NAMES  13.0 /* of axes */
#define LRCSI_CHART_DROP   0.36 /* of the size: from a text's middle to its base line */
#define LRCSI_CHART_MARK   3.8  /* half a marker's width; outlines stand about full ones */
#define LRCSI_CHART_RING   5.8
#define LRCSI_CHART_LINE   19.0 /* from one line of a legend to the next */
#define LRCSI_CHART_SAMPLE 30.0

#define LRCSI_COLOUR_TEXT  0x222222u
#define LRCSI_COLOUR_FAINT 0x666666u
#define LRCSI_COLOUR_GRID  0xd9d9d9u
#define LRCSI_COLOUR_MINOR 0xefefefu
#define LRCSI_COLOUR_FLOOR 0xf4f1e8u
#define LRCSI_COLOUR_PAPER 0xffffffu

lrcsi_ink lrcsi_series_ink(const lrcs_host_series *series);
void lrcsi_series_marker(lrcsi_plotter *plotter, const lrcs_host_series *series,
                         lrcsi_plot_point at);

/* A piece of a series' band, from its first to its second point: low, high, high, low. */
void lrcsi_series_band(lrcsi_plotter *plotter, const lrcs_host_series *series,
                       const lrcsi_plot_point corner[4]);

void lrcsi_chart_stroke(lrcsi_plotter *plotter, double x0, double y0, double x1, double y1,
                        uint32_t colour, double width);

/* A mark at a point of an axis, with its number below or, on an upright axis, to the left. */
void lrcsi_chart_tick(lrcsi_plotter *plotter, const lrcsi_tick *tick, lrcsi_plot_point at,
                      int upright);

/* The frame of what is drawn between left and right. */
void lrcsi_chart_box(lrcsi_plotter *plotter, double left, double right);

/* A line of text, in a smaller size if it would not fit. */
void lrcsi_chart_words(lrcsi_plotter *plotter, lrcsi_words words, double room);

/* The two lines above a chart. */
void lrcsi_chart_title(lrcsi_plotter *plotter, const char *title, const char *note);

/* The names of axes: below the middle x, and upwards about the middle y. */
void lrcsi_chart_names(lrcsi_plotter *plotter, const char *below, double x, double wide,
                       const char *beside, double y, double high);

/* Series that have a name are listed beside a chart: how wide that is, 0 for none; and the list
   from a corner on, which gives where it ends. */
double lrcsi_chart_legend_width(const lrcs_host_chart *chart);
double lrcsi_chart_legend(lrcsi_plotter *plotter, const lrcs_host_chart *chart, double x, double y);

/* A chart about a pole: x is an angle, deg, counter-clockwise from the right; y a distance from
   the pole, which is where the axis begins. */
void lrcsi_polar_draw(const lrcs_host_chart *chart, lrcsi_plotter *plotter);

#endif
