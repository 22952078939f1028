/* SPDX-License-Identifier: MIT */
/* What stands beside a picture: how its colours are read, and how long a metre is. */
#ifndef LRCSI_HOST_LEGEND_H
#define LRCSI_HOST_LEGEND_H

#include "host/colouring.h"
#include "host/plotter.h"

/* How high a legend is on paper of a width, no higher than `most`. */
double lrcsi_legend_height(const lrcsi_colouring *colouring, double width, double most);

/* Draws it with its top at `top`, all across the paper.
   Given: scale, units of the paper a metre; ink, the colour of words. */
void lrcsi_legend_draw(const lrcsi_colouring *colouring, lrcsi_plotter *plotter, double top,
                       double width, double most, double scale, uint32_t ink);

#endif
