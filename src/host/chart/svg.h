/* SPDX-License-Identifier: MIT */
/* A plotter that writes SVG 1.1. */
#ifndef LRCSI_HOST_SVG_H
#define LRCSI_HOST_SVG_H

#include "host/chart/plotter.h"

typedef struct lrcsi_svg {
    lrcsi_plotter plotter; /* first: a plotter is an svg */
    FILE *out;
} lrcsi_svg;

/* Begins a drawing of a given size on a white background, and ends it. */
lrcsi_svg lrcsi_svg_begin(FILE *out, double width, double height, const char *title,
                          const char *about);
void lrcsi_svg_end(lrcsi_svg *svg);

#endif
