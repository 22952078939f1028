/* SPDX-License-Identifier: MIT */
/* The legend of a picture: its colour scale and its scale bar. */
#ifndef LRCSI_HOST_LEGEND_H
#define LRCSI_HOST_LEGEND_H

#include "host/chart/plotter.h"
#include "host/picture/colouring.h"

/* The height of a legend of the given width, at most height_max. */
double lrcsi_legend_height(const lrcsi_colouring *colouring, double width, double height_max);

/* Draws it with its top at `top`.
   Given: scale, units of the drawing per metre; colour, of text and lines. */
void lrcsi_legend_draw(const lrcsi_colouring *colouring, lrcsi_plotter *plotter, double top,
                       double width, double height_max, double scale, uint32_t colour);

#endif
