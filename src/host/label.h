/* SPDX-License-Identifier: MIT */
/* Finds a place for a small text beside a point so that it covers nothing. */
#ifndef LRCSI_HOST_LABEL_H
#define LRCSI_HOST_LABEL_H

#include "host/plotter.h"

#define LRCSI_LABEL_ROOMS 4096u

typedef struct lrcsi_room {
    float x0, y0, x1, y1;
} lrcsi_room;

/* The occupied places within a frame. */
typedef struct lrcsi_board {
    lrcsi_room frame;
    uint32_t count;
    lrcsi_room room[LRCSI_LABEL_ROOMS]; /* places after this many are not kept clear */
} lrcsi_board;

/* Marks as occupied a square about a point, and squares along a line. */
void lrcsi_board_point(lrcsi_board *board, lrcsi_plot_point point, double half);
void lrcsi_board_line(lrcsi_board *board, lrcsi_plot_point a, lrcsi_plot_point b);

/* Finds a place for a text of the given size beside a point, at least `clear` away, and marks it as
   occupied. Returned: its left end on the base line. Returns 0 if there is no free place. */
int lrcsi_board_text(lrcsi_board *board, lrcsi_plot_point point, double clear, const char *text,
                     double size, lrcsi_plot_point *at);

#endif
