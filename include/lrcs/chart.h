/* SPDX-License-Identifier: MIT */
/* Charts and maps, as SVG and as PNG. */
#ifndef LRCS_CHART_H
#define LRCS_CHART_H

#include <lrcs/file.h>

/* The layout of charts and maps: the size of the drawing, the height of title and note, and the
   square that a polar chart occupies with its numbers. A page that has its own title and text can
   crop a chart to its plot by these. */
#define LRCS_HOST_CHART_WIDTH      860.0
#define LRCS_HOST_CHART_HEIGHT     520.0
#define LRCS_HOST_CHART_TITLE      50.0
#define LRCS_HOST_CHART_POLAR_LEFT 72.0
#define LRCS_HOST_CHART_POLAR_SIDE 464.0

/* Colours that remain distinguishable with colour vision deficiency (M. Okabe and K. Ito, 2008). */
enum lrcs_host_colour {
    LRCS_HOST_BLACK,
    LRCS_HOST_ORANGE,
    LRCS_HOST_SKY_BLUE,
    LRCS_HOST_GREEN,
    LRCS_HOST_YELLOW,
    LRCS_HOST_BLUE,
    LRCS_HOST_VERMILION,
    LRCS_HOST_PURPLE
};
enum lrcs_host_marker {
    LRCS_HOST_DISC,
    LRCS_HOST_SQUARE,
    LRCS_HOST_TRIANGLE,
    LRCS_HOST_DIAMOND,
    LRCS_HOST_CROSS,
    LRCS_HOST_NO_MARKER
};
enum lrcs_host_dash { LRCS_HOST_SOLID, LRCS_HOST_DASHED, LRCS_HOST_DOTTED, LRCS_HOST_NO_LINE };

/* Points, joined in their order unless dash is LRCS_HOST_NO_LINE. Points that an axis cannot show
   (not finite, beyond 1e288; log: not above 1e-288) are omitted, and leave a gap in the line. */
typedef struct lrcs_host_series {
    const char *name; /* in the legend, or NULL: not listed */
    uint32_t count;
    const double *x, *y;
    const char *const *label; /* one per point, drawn where there is room; NULL: no labels, or no
                                 label for that point */
    int colour, marker, dash; /* lrcs_host_colour, ... */
    int hollow;               /* markers are outlines */
    const double *low, *high; /* the ends of a band at each point, shaded below all lines; an end
                                 that the axis cannot show lies at its edge. NULL: none */
} lrcs_host_series;

typedef struct lrcs_host_chart {
    const char *title, *note; /* note: a smaller line below the title, or NULL */
    const char *x_name, *y_name;
    int x_log, y_log;
    int x_deg;    /* x is an angle, deg: ticks every 30, 45, .. */
    int y_from_0; /* the y axis begins at 0 regardless of the data; not with y_log */
    int polar;    /* polar chart: x is an angle, deg, counter-clockwise from the right; y is the
                     distance from the pole. The pole is 0 with y_from_0; otherwise it is 40 below
                     the largest y, and smaller values are drawn there */
    double floor; /* log y: smaller values, including 0, are drawn at this value with a downward
                     arrow; 0: none */
    const char *floor_name; /* in the legend */
    const lrcs_host_series *series;
    uint32_t series_count;
    const char *about; /* what it was made from, as in lrcs_host_png_write; SVG: metadata */
} lrcs_host_chart;

/* The same chart as SVG 1.1, and as PNG with twice the pixels. Status: LRCS_OK; LRCS_E_SYSTEM. */
void lrcs_host_chart_svg(FILE *out, const lrcs_host_chart *chart);
int lrcs_host_chart_png(FILE *out, const lrcs_host_chart *chart, lrcs_host_error *error);

/* A quantity as a function of two others, as colours with contours, interpolated between points. */
typedef struct lrcs_host_map {
    const char *title, *note;             /* as a chart's */
    const char *x_name, *y_name, *z_name; /* z: beside the scale of colours */
    uint32_t columns, rows;               /* at least 2 of each */
    const double *x, *y;                  /* ascending: columns of x, rows of y */
    const double *z;                      /* z[row * columns + column]; not finite: grey */
    double deep;       /* the colour scale covers at most this range below the largest; 0: all */
    int x_deg, y_deg;  /* these are angles, deg */
    int mollweide;     /* drawn in Mollweide's equal-area projection, 0 deg in the middle: x is the
                          azimuth or longitude, deg, over at most 360; y is -90 .. 90 */
    int cells;         /* without contours */
    const char *about; /* as of a chart */
} lrcs_host_map;

/* As for charts. If there are more points than can be resolved, several are averaged.
   Status: LRCS_OK; LRCS_E_SYSTEM. */
void lrcs_host_map_svg(FILE *out, const lrcs_host_map *map);
int lrcs_host_map_png(FILE *out, const lrcs_host_map *map, lrcs_host_error *error);

#endif
