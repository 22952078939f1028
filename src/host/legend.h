/* SPDX-License-Identifier: MIT */
/* The legend of a picture: its colour scale and its scale bar. */
#ifndef LRCSI_HOST_LEGEND_H
#define LRCSI_HOST_LEGEND_H

#include "host/colouring.h"
#include "host/plotter.h"

/* The height of a legend on paper of the given width, at most `most`. */
double lrcsi_legend_height(const lrcsi_colouring *colouring, double width, double most);

/* Draws it with its top at `top`, all across the paper.
   Given: scale, units of the paper a metre; ink, the colour of words. */
void lrcsi_legend_draw(const lrcsi_colouring *colouring, lrcsi_plotter *plotter, double top,
                       double width, double most, double scale, uint32_t ink);

#endif
