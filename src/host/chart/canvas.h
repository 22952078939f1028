/* SPDX-License-Identifier: MIT */
/* A plotter that colours pixels, with smooth edges. */
#ifndef LRCSI_HOST_CANVAS_H
#define LRCSI_HOST_CANVAS_H

#include "host/chart/plotter.h"

typedef struct lrcsi_canvas {
    lrcsi_plotter plotter; /* first: a plotter is a canvas */
    uint32_t width, height;
    double scale;       /* pixels per unit of the drawing */
    unsigned char *rgb; /* width x height */
    float *cover;       /* of the current stroke; all zero between strokes */
    uint32_t box[4];    /* its pixels: x and y from, x and y to (exclusive) */
} lrcsi_canvas;

/* A white canvas of width x height units. Status: LRCS_OK; LRCS_E_SYSTEM (memory). */
int lrcsi_canvas_make(double width, double height, double scale, lrcsi_canvas *canvas,
                      lrcs_host_error *error);
void lrcsi_canvas_free(lrcsi_canvas *canvas);

/* Writes what was drawn as PNG and frees it. Status: as lrcs_host_png_write. */
int lrcsi_canvas_end(lrcsi_canvas *canvas, FILE *out, const char *about, lrcs_host_error *error);

#endif
