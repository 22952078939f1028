/* SPDX-License-Identifier: MIT */
/* Visible polygons as vector graphics: one path per facet, in metres, under one transform to the
   drawing. colouring.c decides colours, legend.c the legend below. */
#include "host/chart/palette.h"
#include "host/chart/svg.h"
#include "host/picture/annotate.h"
#include "host/picture/legend.h"

#include <math.h>

#define DRAWING_WIDTH  720.0
#define DRAWING_HEIGHT 900.0 /* at most */
#define DRAWING_MARGIN 24.0
#define DRAWING_LEGEND 300.0 /* at most */
#define DRAWING_AXES   20.0  /* the length of the body's axes, in the upper right corner */
#define DRAWING_TITLE  64.0  /* the height of title, pose and axes */
#define DRAWING_SEAM   0.7   /* the width of outlines, which cover the gaps between facets */

/* The layout: x = left + metre (u - low[0]), y = top - metre (v - high[1]). */
typedef struct drawing_layout {
    double low[2], high[2];  /* m */
    double left, top, metre; /* units of the drawing; units per metre */
    double legend, height;
} drawing_layout;

static drawing_layout drawing_place(const lrcsi_colouring *colouring, const lrcs_polygons *polygons)
{
    drawing_layout layout = {
        {HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}, 0, DRAWING_MARGIN, 1, 0, 0};
    const double room[2] = {DRAWING_WIDTH - 2.0 * DRAWING_MARGIN, DRAWING_HEIGHT};
    for (uint32_t i = 0; i < polygons->points; i++) {
        for (int k = 0; k < 2; k++) {
            layout.low[k] = fmin(layout.low[k], polygons->point[i].view[k]);
            layout.high[k] = fmax(layout.high[k], polygons->point[i].view[k]);
        }
    }
    for (int k = 0; k < 2 && polygons->points == 0; k++) {
        layout.low[k] = layout.high[k] = 0.0;
    }
    double metre = HUGE_VAL;
    for (int k = 0; k < 2; k++) {
        double side = layout.high[k] - layout.low[k];
        metre = side > 0.0 ? fmin(metre, room[k] / side) : metre;
    }
    layout.metre = isfinite(metre) ? metre : 0.0;
    double width = layout.metre * (layout.high[0] - layout.low[0]);
    layout.left = 0.5 * (DRAWING_WIDTH - width);
    layout.top += colouring->picture->annotated ? DRAWING_TITLE - DRAWING_MARGIN : 0.0;
    layout.legend = lrcsi_legend_height(colouring, DRAWING_WIDTH, DRAWING_LEGEND);
    layout.height = layout.top + DRAWING_MARGIN + layout.metre * (layout.high[1] - layout.low[1]) +
                    layout.legend;
    return layout;
}

/* A gradient along the steepest ascent of the facet's plane, from one end of the scale to the
   other. */
static void slope_write(FILE *out, const lrcsi_colouring *colouring, uint32_t facet,
                        const double at[3])
{
    double steep = at[1] * at[1] + at[2] * at[2];
    double from = (colouring->scale.low - at[0]) / steep;
    double to = (colouring->scale.high - at[0]) / steep;
    fprintf(out, "<linearGradient id=\"g%lu\" xlink:href=\"#scale\"", (unsigned long)facet);
    lrcs_host_number_put(out, " gradientUnits=\"userSpaceOnUse\" x1=\"", from * at[1]);
    lrcs_host_number_put(out, "\" y1=\"", from * at[2]);
    lrcs_host_number_put(out, "\" x2=\"", to * at[1]);
    lrcs_host_number_put(out, "\" y2=\"", to * at[2]);
    fputs("\"/>\n", out);
}

/* Draws the rings from `first` on that lie on one facet. Returns the index after them. */
static uint32_t facet_write(FILE *out, const lrcsi_colouring *colouring,
                            const lrcs_polygons *polygons, uint32_t first)
{
    uint32_t facet = polygons->ring[first].facet;
    unsigned long number = facet;
    double at[3];
    if (lrcsi_colouring_slope(colouring, facet, at)) {
        slope_write(out, colouring, facet, at);
        fprintf(out, "<path id=\"f%lu\" fill=\"url(#g%lu)\" stroke=\"url(#g%lu)\" d=\"", number,
                number, number);
    } else {
        const lrcs_ring_point *corner = &polygons->point[polygons->ring[first].first];
        unsigned long colour = lrcsi_colouring_colour(colouring, facet, corner->view);
        fprintf(out, "<path id=\"f%lu\" fill=\"#%06lx\" stroke=\"#%06lx\" d=\"", number, colour,
                colour);
    }
    uint32_t r = first;
    for (; r < polygons->rings && polygons->ring[r].facet == facet; r++) {
        const lrcs_ring *ring = &polygons->ring[r];
        for (uint32_t i = 0; i < ring->count; i++) {
            const lrcs_ring_point *point = &polygons->point[ring->first + i];
            lrcs_host_number_put(out, i == 0 ? "M" : "L", point->view[0]);
            lrcs_host_number_put(out, " ", point->view[1]);
        }
        putc('Z', out);
    }
    fputs("\"/>\n", out);
    return r;
}

static void facets_draw(FILE *out, const lrcsi_colouring *colouring, const lrcs_polygons *polygons,
                        const drawing_layout *layout)
{
    double x = layout->left - layout->metre * layout->low[0];
    double y = layout->top + layout->metre * layout->high[1];
    lrcs_host_number_put(out, "<g transform=\"matrix(", layout->metre);
    lrcs_host_number_put(out, " 0 0 ", -layout->metre);
    lrcs_host_number_put(out, " ", x);
    lrcs_host_number_put(out, " ", y);
    lrcs_host_number_put(out, ")\" stroke-width=\"",
                         layout->metre > 0.0 ? DRAWING_SEAM / layout->metre : 0.0);
    fputs("\">\n", out);
    if (colouring->picture->colouring == LRCS_HOST_BY_RANGE) {
        /* the scale's colours from knot to knot, which gradients refer to */
        fputs("<linearGradient id=\"scale\">", out);
        for (int i = 0; i < LRCSI_PALETTE_KNOTS; i++) {
            double place = (double)i / (LRCSI_PALETTE_KNOTS - 1);
            lrcs_host_number_put(out, "<stop offset=\"", place);
            fprintf(out, "\" stop-color=\"#%06lx\"/>", (unsigned long)lrcsi_palette_viridis(place));
        }
        fputs("</linearGradient>\n", out);
    }
    for (uint32_t r = 0; r < polygons->rings;) {
        r = facet_write(out, colouring, polygons, r);
    }
    fputs("</g>\n", out);
}

void lrcs_host_picture_svg(FILE *out, const lrcs_host_picture *picture,
                           const lrcs_polygons *polygons)
{
    lrcsi_colouring colouring = lrcsi_colouring_make(picture);
    drawing_layout layout = drawing_place(&colouring, polygons);
    lrcsi_svg svg =
        lrcsi_svg_begin(out, DRAWING_WIDTH, layout.height, picture->title, picture->about);
    if (!picture->white) {
        const lrcsi_plot_point corner[4] = {
            {0.0, 0.0}, {DRAWING_WIDTH, 0.0}, {DRAWING_WIDTH, layout.height}, {0.0, layout.height}};
        svg.plotter.area(&svg.plotter, corner, 4, lrcsi_colouring_background(&colouring));
    }
    if (picture->annotated) {
        const lrcsi_plot_point corner = {DRAWING_WIDTH - 0.6 * DRAWING_TITLE, 0.5 * DRAWING_TITLE};
        lrcsi_annotate(&colouring, &svg.plotter, DRAWING_WIDTH - DRAWING_TITLE, corner,
                       DRAWING_AXES);
    }
    facets_draw(out, &colouring, polygons, &layout);
    lrcsi_legend_draw(&colouring, &svg.plotter, layout.height - layout.legend, DRAWING_WIDTH,
                      DRAWING_LEGEND, layout.metre, lrcsi_colouring_text_colour(&colouring));
    lrcsi_svg_end(&svg);
}
