/* SPDX-License-Identifier: MIT */
/* The annotations of a picture: title, pose, axes. */
#ifndef LRCSI_HOST_ANNOTATE_H
#define LRCSI_HOST_ANNOTATE_H

#include "host/chart/plotter.h"
#include "host/picture/colouring.h"

#define LRCSI_ANNOTATE_TITLE 34.0 /* the height of title and pose, units of the drawing */

/* Draws the title and the pose at the top of a drawing of the given width, and the body's axes from
   `corner`, at most `length` long. */
void lrcsi_annotate(const lrcsi_colouring *colouring, lrcsi_plotter *plotter, double width,
                    lrcsi_plot_point corner, double length);

#endif
