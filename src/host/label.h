/* SPDX-License-Identifier: MIT */
/* Where a small text beside a point goes so that it covers nothing. */
#ifndef LRCSI_HOST_LABEL_H
#define LRCSI_HOST_LABEL_H

#include "host/plotter.h"

#define LRCSI_LABEL_ROOMS 4096u

typedef struct lrcsi_room {
    float x0, y0, x1, y1;
} lrcsi_room;

/* What is taken, within a frame. */
typedef struct lrcsi_board {
    lrcsi_room frame;
    uint32_t count;
    lrcsi_room room[LRCSI_LABEL_ROOMS]; /* what comes after that many is not kept clear */
} lrcsi_board;

/* Takes a square about a spot, and all along a line. */
void lrcsi_board_spot(lrcsi_board *board, lrcsi_spot spot, double half);
void lrcsi_board_line(lrcsi_board *board, lrcsi_spot a, lrcsi_spot b);

/* Finds room for a text of a size beside a spot, at least `clear` away, and takes it.
   Returned: its left end on the base line. 0 where there is no room. */
int lrcsi_board_text(lrcsi_board *board, lrcsi_spot spot, double clear, const char *text,
                     double size, lrcsi_spot *at);

#endif
