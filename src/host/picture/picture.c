/* SPDX-License-Identifier: MIT */
/* The picture of a run as pixels: the position of the drawing, and the averaging of cells of the
   run's image. colouring.c decides colours, legend.c the legend below. */
#include "host/chart/canvas.h"
#include "host/chart/palette.h"
#include "host/picture/annotate.h"
#include "host/picture/legend.h"

#include <math.h>

#define OVERSAMPLE      2u    /* raster cells per pixel in x and in y: smooth outlines */
#define LEGEND_FROM     160u  /* smaller pictures have no legend */
#define ANNOTATED_FROM  320u  /* smaller pictures have no title, pose and axes */
#define LEGEND_FRACTION 0.4   /* the largest fraction of the height that it takes */
#define PICTURE_UNITS   640.0 /* larger pictures have larger text */
#define OUTLINE_LIGHT   0.55  /* brightness of an outline relative to its surroundings */

/* The layout, in pixels. */
typedef struct picture_layout {
    uint32_t left, top, side; /* the drawing */
    double unit;              /* pixels per unit of the drawing */
    double legend;            /* its height, units; 0: none */
    double title;             /* likewise, above the drawing */
} picture_layout;

static picture_layout picture_place(const lrcs_host_picture *picture, uint32_t size)
{
    picture_layout at = {.unit = fmax(1.0, size / PICTURE_UNITS)};
    uint32_t margin = size / 32;
    uint32_t above_and_below = 0;
    if (size >= LEGEND_FROM) {
        const lrcs_host_picture plain = {
            .scene = picture->scene, .pose = picture->pose, .colouring = picture->colouring};
        lrcsi_colouring colouring = lrcsi_colouring_make(&plain);
        double side = size / at.unit;
        at.legend = lrcsi_legend_height(&colouring, side, LEGEND_FRACTION * side);
        at.title = picture->annotated && size >= ANNOTATED_FROM ? LRCSI_ANNOTATE_TITLE : 0.0;
        above_and_below = (uint32_t)lround((at.legend + at.title) * at.unit);
    }
    at.side = size - 2 * margin - above_and_below;
    at.left = (size - at.side) / 2;
    at.top = margin + (uint32_t)lround(at.title * at.unit);
    return at;
}

uint32_t lrcs_host_picture_need(const lrcs_host_picture *picture, uint32_t size)
{
    return picture_place(picture, size).side * OVERSAMPLE;
}

static uint32_t cell_colour(const lrcsi_colouring *colouring, const lrcs_image *image, size_t x,
                            size_t y)
{
    size_t side = image->size;
    const uint32_t *cell = image->facet + y * side + x;
    if (*cell >= colouring->picture->scene->facet_count) {
        return lrcsi_colouring_background(colouring);
    }
    double step = image->side_m / (double)side;
    const double view[2] = {image->left_m + ((double)x + 0.5) * step,
                            image->top_m - ((double)y + 0.5) * step};
    uint32_t colour = lrcsi_colouring_colour(colouring, *cell, view);
    int edge = (x + 1 < side && lrcsi_colouring_outline(colouring, *cell, cell[1])) ||
               (y + 1 < side && lrcsi_colouring_outline(colouring, *cell, cell[side]));
    return edge ? lrcsi_palette_shade(colour, OUTLINE_LIGHT) : colour;
}

static void picture_draw(const lrcsi_colouring *colouring, const lrcs_image *image,
                         const picture_layout *at, lrcsi_canvas *canvas)
{
    const uint32_t cells = OVERSAMPLE * OVERSAMPLE; /* of a pixel */
    uint32_t size = canvas->width;
    uint32_t background = lrcsi_colouring_background(colouring);
    for (size_t i = 0; i < 3 * (size_t)size * size; i++) {
        canvas->rgb[i] = (unsigned char)(background >> (16 - 8 * (i % 3)) & 255u);
    }
    for (uint32_t y = 0; y < at->side; y++) {
        for (uint32_t x = 0; x < at->side; x++) {
            uint32_t sum[3] = {0, 0, 0}; /* a pixel is the mean of its cells */
            for (uint32_t i = 0; i < cells; i++) {
                uint32_t colour =
                    cell_colour(colouring, image, (size_t)x * OVERSAMPLE + i % OVERSAMPLE,
                                (size_t)y * OVERSAMPLE + i / OVERSAMPLE);
                for (int k = 0; k < 3; k++) {
                    sum[k] += colour >> (16 - 8 * k) & 255u;
                }
            }
            size_t pixel = (size_t)(at->top + y) * size + at->left + x;
            for (size_t k = 0; k < 3; k++) {
                canvas->rgb[3 * pixel + k] = (unsigned char)((sum[k] + cells / 2) / cells);
            }
        }
    }
    if (at->title > 0.0) {
        const lrcsi_plot_point corner = {(at->left + 0.09 * at->side) / at->unit,
                                         (at->top + 0.91 * at->side) / at->unit};
        lrcsi_annotate(colouring, &canvas->plotter, size / at->unit, corner,
                       0.06 * at->side / at->unit);
    }
    if (at->legend > 0.0) {
        double side = size / at->unit;
        double metre = at->side / at->unit / image->side_m;
        lrcsi_legend_draw(colouring, &canvas->plotter, side - at->legend, side,
                          LEGEND_FRACTION * side, metre, lrcsi_colouring_text_colour(colouring));
    }
}

int lrcs_host_picture_png(FILE *out, const lrcs_host_picture *picture, const lrcs_image *image,
                          uint32_t size, lrcs_host_error *error)
{
    lrcsi_canvas canvas;
    picture_layout at = picture_place(picture, size);
    double side = size / at.unit;
    int status = lrcsi_canvas_make(side, side, at.unit, &canvas, error);
    if (status == LRCS_OK) {
        lrcsi_colouring colouring = lrcsi_colouring_make(picture);
        picture_draw(&colouring, image, &at, &canvas);
        status = lrcsi_canvas_end(&canvas, out, picture->about, error);
    }
    return status;
}
