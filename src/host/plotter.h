/* SPDX-License-Identifier: MIT */
/* The drawing interface of charts: lines, areas and words, on paper whose unit is about a pixel, x
   to the right, y down. A plotter writes SVG or colours pixels; the chart does not know which. */
#ifndef LRCSI_PLOTTER_H
#define LRCSI_PLOTTER_H

#include <lrcs/host.h>

typedef struct lrcsi_plot_point {
    double x, y;
} lrcsi_plot_point;

/* Colours are 0xRRGGBB. */
typedef struct lrcsi_ink {
    uint32_t colour;
    double width;
    double dash[2]; /* drawn, left out; 0: all drawn */
} lrcsi_ink;

enum lrcsi_anchor { LRCSI_ANCHOR_LEFT, LRCSI_ANCHOR_MIDDLE, LRCSI_ANCHOR_RIGHT };

typedef struct lrcsi_words {
    const char *text;
    const char *raised;  /* an exponent after it, or NULL */
    lrcsi_plot_point at; /* on the base line */
    double size;         /* em */
    int anchor;          /* lrcsi_anchor */
    int upwards;         /* read from below */
    int bold;
    uint32_t colour;
} lrcsi_words;

typedef struct lrcsi_plotter lrcsi_plotter;
struct lrcsi_plotter {
    void (*line)(lrcsi_plotter *plotter, const lrcsi_plot_point *point, uint32_t count,
                 const lrcsi_ink *ink);
    /* A convex polygon, filled. */
    void (*area)(lrcsi_plotter *plotter, const lrcsi_plot_point *point, uint32_t count,
                 uint32_t colour);
    void (*text)(lrcsi_plotter *plotter, const lrcsi_words *words);
};

#endif
