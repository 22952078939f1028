/* SPDX-License-Identifier: MIT */
/* The drawing interface of charts: lines, areas and text on a drawing whose unit is about a pixel,
   x to the right, y down. A plotter writes SVG or colours pixels; the chart does not know which. */
#ifndef LRCSI_PLOTTER_H
#define LRCSI_PLOTTER_H

#include <lrcs/host.h>

typedef struct lrcsi_plot_point {
    double x, y;
} lrcsi_plot_point;

/* Colours are 0xRRGGBB. */
typedef struct lrcsi_line_style {
    uint32_t colour;
    double width;
    double dash[2]; /* lengths drawn and left out; 0: a solid line */
} lrcsi_line_style;

enum lrcsi_anchor { LRCSI_ANCHOR_LEFT, LRCSI_ANCHOR_MIDDLE, LRCSI_ANCHOR_RIGHT };

typedef struct lrcsi_plot_text {
    const char *text;
    const char *raised;  /* an exponent after it, or NULL */
    lrcsi_plot_point at; /* on the base line */
    double size;         /* em */
    int anchor;          /* lrcsi_anchor */
    int upwards;         /* read from below */
    int bold;
    uint32_t colour;
} lrcsi_plot_text;

typedef struct lrcsi_plotter lrcsi_plotter;
struct lrcsi_plotter {
    void (*line)(lrcsi_plotter *plotter, const lrcsi_plot_point *point, uint32_t count,
                 const lrcsi_line_style *style);
    /* A convex polygon, filled. */
    void (*area)(lrcsi_plotter *plotter, const lrcsi_plot_point *point, uint32_t count,
                 uint32_t colour);
    void (*text)(lrcsi_plotter *plotter, const lrcsi_plot_text *label);
};

/* A solid line from (x0, y0) to (x1, y1). */
static inline void lrcsi_plot_line(lrcsi_plotter *plotter, double x0, double y0, double x1,
                                   double y1, uint32_t colour, double width)
{
    const lrcsi_plot_point point[2] = {{x0, y0}, {x1, y1}};
    const lrcsi_line_style style = {colour, width, {0.0, 0.0}};
    plotter->line(plotter, point, 2, &style);
}

/* A filled rectangle. */
static inline void lrcsi_plot_rectangle(lrcsi_plotter *plotter, double x0, double y0, double x1,
                                        double y1, uint32_t colour)
{
    const lrcsi_plot_point corner[4] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    plotter->area(plotter, corner, 4, colour);
}

#endif
