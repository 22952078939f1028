/* SPDX-License-Identifier: MIT */
/* Places texts one after another, each at the first free one of eight places around its point. A
   text without a free place is omitted. */
#include "host/chart/label.h"

#include "host/chart/letters.h"

#include <math.h>

#define LABEL_STEP 4.0 /* between the points that stand for a line */

static void label_occupy(lrcsi_label_area *area, lrcsi_label_box box)
{
    if (area->count < LRCSI_LABEL_BOXES) {
        area->box[area->count++] = box;
    }
}

static lrcsi_label_box label_box(double x, double y, double half_x, double half_y)
{
    return (lrcsi_label_box){(float)(x - half_x), (float)(y - half_y), (float)(x + half_x),
                             (float)(y + half_y)};
}

void lrcsi_label_avoid_point(lrcsi_label_area *area, lrcsi_plot_point point, double half)
{
    label_occupy(area, label_box(point.x, point.y, half, half));
}

void lrcsi_label_avoid_line(lrcsi_label_area *area, lrcsi_plot_point a, lrcsi_plot_point b)
{
    int steps = 1 + (int)(hypot(b.x - a.x, b.y - a.y) / LABEL_STEP);
    for (int i = 0; i <= steps; i++) {
        double fraction = (double)i / steps;
        lrcsi_plot_point at = {a.x + fraction * (b.x - a.x), a.y + fraction * (b.y - a.y)};
        lrcsi_label_avoid_point(area, at, 1.0);
    }
}

static int label_is_free(const lrcsi_label_area *area, const lrcsi_label_box *wanted)
{
    const lrcsi_label_box *frame = &area->frame;
    if (wanted->x0 < frame->x0 || wanted->y0 < frame->y0 || wanted->x1 > frame->x1 ||
        wanted->y1 > frame->y1) {
        return 0;
    }
    for (uint32_t i = 0; i < area->count; i++) {
        const lrcsi_label_box *box = &area->box[i];
        if (wanted->x0 < box->x1 && box->x0 < wanted->x1 && wanted->y0 < box->y1 &&
            box->y0 < wanted->y1) {
            return 0;
        }
    }
    return 1;
}

int lrcsi_label_place(lrcsi_label_area *area, lrcsi_plot_point point, double clear,
                      const char *text, double size, lrcsi_plot_point *at)
{
    static const double place[8][2] = {{0, -1}, {1, -1}, {1, 0},  {-1, -1},
                                       {0, 1},  {1, 1},  {-1, 0}, {-1, 1}};
    double half_x = 0.5 * size * lrcsi_letters_width(text);
    double half_y = 0.38 * size;
    for (int i = 0; i < 8; i++) {
        double x = point.x + place[i][0] * (half_x + clear);
        double y = point.y + place[i][1] * (half_y + clear);
        lrcsi_label_box wanted = label_box(x, y, half_x + 1.0, half_y + 1.0);
        if (label_is_free(area, &wanted)) {
            label_occupy(area, wanted);
            *at = (lrcsi_plot_point){x - half_x, y + half_y};
            return 1;
        }
    }
    return 0;
}
