/* SPDX-License-Identifier: MIT */
/* A stroke font, for text on a canvas of pixels, and the width of text in any drawing. */
#ifndef LRCSI_HOST_LETTERS_H
#define LRCSI_HOST_LETTERS_H

#include "host/chart/plotter.h"

/* Width of a text in em: close enough to that of a common sans serif to lay out SVG too. */
double lrcsi_letters_width(const char *text);

/* Draws a text, in a smaller size if it is wider than `room`. */
void lrcsi_letters_fit(lrcsi_plotter *plotter, lrcsi_plot_text label, double room);

/* The next point of a text's strokes in em, x to the right from the text's beginning, y up from the
   base line. */
typedef struct lrcsi_letters {
    const char *text; /* the current letter */
    const char *at;   /* in its strokes; NULL before the first */
    double x;         /* where it begins */
} lrcsi_letters;

enum lrcsi_letters_move { LRCSI_LETTERS_END, LRCSI_LETTERS_JUMP, LRCSI_LETTERS_DRAW };

/* Returns END, or how to move to *point. */
int lrcsi_letters_next(lrcsi_letters *letters, lrcsi_plot_point *point);

#endif
