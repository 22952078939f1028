/* SPDX-License-Identifier: MIT */
/* Places texts one after another, each at the first free one of eight places around its point. A
   text without a free place is omitted. */
#include "host/label.h"

#include "host/letters.h"

#include <math.h>

#define LABEL_STEP 4.0 /* between the points that stand for a line */

static void board_take(lrcsi_board *board, lrcsi_room room)
{
    if (board->count < LRCSI_LABEL_ROOMS) {
        board->room[board->count++] = room;
    }
}

static lrcsi_room box_about(double x, double y, double half_x, double half_y)
{
    return (lrcsi_room){(float)(x - half_x), (float)(y - half_y), (float)(x + half_x),
                        (float)(y + half_y)};
}

void lrcsi_board_point(lrcsi_board *board, lrcsi_plot_point point, double half)
{
    board_take(board, box_about(point.x, point.y, half, half));
}

void lrcsi_board_line(lrcsi_board *board, lrcsi_plot_point a, lrcsi_plot_point b)
{
    int steps = 1 + (int)(hypot(b.x - a.x, b.y - a.y) / LABEL_STEP);
    for (int i = 0; i <= steps; i++) {
        double part = (double)i / steps;
        lrcsi_plot_point at = {a.x + part * (b.x - a.x), a.y + part * (b.y - a.y)};
        lrcsi_board_point(board, at, 1.0);
    }
}

static int board_free(const lrcsi_board *board, const lrcsi_room *want)
{
    const lrcsi_room *frame = &board->frame;
    if (want->x0 < frame->x0 || want->y0 < frame->y0 || want->x1 > frame->x1 ||
        want->y1 > frame->y1) {
        return 0;
    }
    for (uint32_t i = 0; i < board->count; i++) {
        const lrcsi_room *box = &board->room[i];
        if (want->x0 < box->x1 && box->x0 < want->x1 && want->y0 < box->y1 && box->y0 < want->y1) {
            return 0;
        }
    }
    return 1;
}

int lrcsi_board_text(lrcsi_board *board, lrcsi_plot_point point, double clear, const char *text,
                     double size, lrcsi_plot_point *at)
{
    static const double place[8][2] = {{0, -1}, {1, -1}, {1, 0},  {-1, -1},
                                       {0, 1},  {1, 1},  {-1, 0}, {-1, 1}};
    double half_x = 0.5 * size * lrcsi_letters_width(text);
    double half_y = 0.38 * size;
    for (int i = 0; i < 8; i++) {
        double x = point.x + place[i][0] * (half_x + clear);
        double y = point.y + place[i][1] * (half_y + clear);
        lrcsi_room want = box_about(x, y, half_x + 1.0, half_y + 1.0);
        if (board_free(board, &want)) {
            board_take(board, want);
            *at = (lrcsi_plot_point){x - half_x, y + half_y};
            return 1;
        }
    }
    return 0;
}
