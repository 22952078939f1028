/* SPDX-License-Identifier: MIT */
/* Letters as strokes, for words on a canvas of pixels. */
#ifndef LRCSI_HOST_LETTERS_H
#define LRCSI_HOST_LETTERS_H

#include "host/plotter.h"

/* Width of a text in em: close enough to that of a common sans serif to lay out SVG too. */
double lrcsi_letters_width(const char *text);

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
