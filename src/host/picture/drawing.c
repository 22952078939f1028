/* SPDX-License-Identifier: MIT */
/* Visible polygons as vector graphics: one path per facet, in metres, under one transform to the
   drawing. colouring.c decides colours, legend.c the strip below. */
#include "host/chart/svg.h"
#include "host/picture/legend.h"
#include "host/picture/palette.h"

#include <math.h>

#define DRAWING_WIDTH  720.0
#define DRAWING_HEIGHT 900.0 /* at most */
#define DRAWING_MARGIN 24.0
#define DRAWING_LEGEND 300.0 /* at most */
#define DRAWING_SEAM   0.7   /* the width of outlines, which cover the gaps between facets */

/* The layout: x = left + metre (u - low[0]), y = top - metre (v - high[1]). */
typedef struct drawing_plan {
    double low[2], high[2];  /* m */
    double left, top, metre; /* units of the drawing; units per metre */
    double legend, height;
} drawing_plan;

static drawing_plan drawing_place(const lrcsi_colouring *colouring, const lrcs_polygons *polygons)
{
    drawing_plan plan = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}, 0, DRAWING_MARGIN, 1, 0, 0};
    const double room[2] = {DRAWING_WIDTH - 2.0 * DRAWING_MARGIN, DRAWING_HEIGHT};
    for (uint32_t i = 0; i < polygons->points; i++) {
        for (int k = 0; k < 2; k++) {
            plan.low[k] = fmin(plan.low[k], polygons->point[i].view[k]);
            plan.high[k] = fmax(plan.high[k], polygons->point[i].view[k]);
        }
    }
    for (int k = 0; k < 2 && polygons->points == 0; k++) {
        plan.low[k] = plan.high[k] = 0.0;
    }
    double metre = HUGE_VAL;
    for (int k = 0; k < 2; k++) {
        double side = plan.high[k] - plan.low[k];
        metre = side > 0.0 ? fmin(metre, room[k] / side) : metre;
    }
    plan.metre = isfinite(metre) ? metre : 0.0;
    double width = plan.metre * (plan.high[0] - plan.low[0]);
    plan.left = 0.5 * (DRAWING_WIDTH - width);
    plan.legend = lrcsi_legend_height(colouring, DRAWING_WIDTH, DRAWING_LEGEND);
    plan.height = 2.0 * DRAWING_MARGIN + plan.metre * (plan.high[1] - plan.low[1]) + plan.legend;
    return plan;
}

static void drawing_number(FILE *out, const char *before, double value)
{
    char text[LRCS_HOST_NUMBER_SIZE];
    lrcs_host_number_text(value, text);
    fputs(before, out);
    fputs(text, out);
}

/* The scale's colours from knot to knot, which slopes borrow. */
static void scale_stops(FILE *out)
{
    fputs("<linearGradient id=\"scale\">", out);
    for (int i = 0; i < LRCSI_PALETTE_KNOTS; i++) {
        double place = (double)i / (LRCSI_PALETTE_KNOTS - 1);
        drawing_number(out, "<stop offset=\"", place);
        fprintf(out, "\" stop-color=\"#%06lx\"/>", (unsigned long)lrcsi_palette_viridis(place));
    }
    fputs("</linearGradient>\n", out);
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
    drawing_number(out, " gradientUnits=\"userSpaceOnUse\" x1=\"", from * at[1]);
    drawing_number(out, "\" y1=\"", from * at[2]);
    drawing_number(out, "\" x2=\"", to * at[1]);
    drawing_number(out, "\" y2=\"", to * at[2]);
    fputs("\"/>\n", out);
}

static void ring_write(FILE *out, const lrcs_polygons *polygons, const lrcs_ring *ring)
{
    for (uint32_t i = 0; i < ring->count; i++) {
        const lrcs_ring_point *point = &polygons->point[ring->first + i];
        drawing_number(out, i == 0 ? "M" : "L", point->view[0]);
        drawing_number(out, " ", point->view[1]);
    }
    putc('Z', out);
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
        ring_write(out, polygons, &polygons->ring[r]);
    }
    fputs("\"/>\n", out);
    return r;
}

static void facets_draw(FILE *out, const lrcsi_colouring *colouring, const lrcs_polygons *polygons,
                        const drawing_plan *plan)
{
    double x = plan->left - plan->metre * plan->low[0];
    double y = plan->top + plan->metre * plan->high[1];
    drawing_number(out, "<g transform=\"matrix(", plan->metre);
    drawing_number(out, " 0 0 ", -plan->metre);
    drawing_number(out, " ", x);
    drawing_number(out, " ", y);
    drawing_number(out, ")\" stroke-width=\"",
                   plan->metre > 0.0 ? DRAWING_SEAM / plan->metre : 0.0);
    fputs("\">\n", out);
    if (colouring->picture->colouring == LRCS_HOST_BY_RANGE) {
        scale_stops(out);
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
    drawing_plan plan = drawing_place(&colouring, polygons);
    lrcsi_svg svg =
        lrcsi_svg_begin(out, DRAWING_WIDTH, plan.height, picture->title, picture->about);
    if (!picture->white) {
        const lrcsi_plot_point corner[4] = {
            {0.0, 0.0}, {DRAWING_WIDTH, 0.0}, {DRAWING_WIDTH, plan.height}, {0.0, plan.height}};
        svg.plotter.area(&svg.plotter, corner, 4, lrcsi_colouring_background(&colouring));
    }
    facets_draw(out, &colouring, polygons, &plan);
    lrcsi_legend_draw(&colouring, &svg.plotter, plan.height - plan.legend, DRAWING_WIDTH,
                      DRAWING_LEGEND, plan.metre, lrcsi_colouring_text_colour(&colouring));
    lrcsi_svg_end(&svg);
}
