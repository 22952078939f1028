/* SPDX-License-Identifier: MIT */
/* Finds a place for a small text beside a point so that it covers nothing. */
#ifndef LRCSI_HOST_LABEL_H
#define LRCSI_HOST_LABEL_H

#include "host/chart/plotter.h"

#define LRCSI_LABEL_BOXES 4096u /* beyond that, labels may cover what is drawn */

typedef struct lrcsi_label_box {
    float x0, y0, x1, y1;
} lrcsi_label_box;

/* The occupied places within a frame. */
typedef struct lrcsi_label_area {
    lrcsi_label_box frame;
    uint32_t count;
    lrcsi_label_box box[LRCSI_LABEL_BOXES]; /* further places are not kept free */
} lrcsi_label_area;

/* Marks as occupied a square about a point, and squares along a line. */
void lrcsi_label_avoid_point(lrcsi_label_area *area, lrcsi_plot_point point, double half);
void lrcsi_label_avoid_line(lrcsi_label_area *area, lrcsi_plot_point a, lrcsi_plot_point b);

/* Finds a place for a text of the given size beside a point, at least `clear` away, and marks it as
   occupied. Returned: its left end on the base line. Returns 0 if there is no free place. */
int lrcsi_label_place(lrcsi_label_area *area, lrcsi_plot_point point, double clear,
                      const char *text, double size, lrcsi_plot_point *at);

#endif
