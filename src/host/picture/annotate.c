/* SPDX-License-Identifier: MIT */
/* The annotations of a picture, so that it can be read by itself: the title, the direction to the
   laser, and the body's axes in the view. */
#include "host/picture/annotate.h"

#include <math.h>
#include <stdio.h>

#include "base/constant.h"
#include "host/chart/letters.h"
#include "host/chart/palette.h"

#define ANNOTATE_MARGIN 16.0
#define ANNOTATE_TYPE   14.0

/* Seen from the laser, an axis of the body is a column of R; the farthest axis is drawn first. */
static void axes_draw(const lrcsi_colouring *colouring, lrcsi_plotter *plotter,
                      lrcsi_plot_point corner, double length)
{
    static const char *const name[3] = {"x", "y", "z"};
    static const int hue[2][3] = {{1, 4, 2}, {6, 3, 5}}; /* on dark and on white */
    const double(*R)[3] = (const double(*)[3])colouring->picture->pose->R;
    int order[3] = {0, 1, 2};
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 2 - i; k++) {
            if (R[2][order[k]] > R[2][order[k + 1]]) {
                int swap = order[k];
                order[k] = order[k + 1];
                order[k + 1] = swap;
            }
        }
    }
    for (int i = 0; i < 3; i++) {
        int axis = order[i];
        uint32_t colour = lrcsi_palette_named(hue[colouring->picture->white != 0][axis]);
        const lrcsi_plot_point line[2] = {
            corner, {corner.x + length * R[0][axis], corner.y - length * R[1][axis]}};
        const lrcsi_line_style style = {colour, 1.8, {0.0, 0.0}};
        const lrcsi_plot_text label = {.text = name[axis],
                                       .at = {corner.x + 1.28 * length * R[0][axis],
                                              corner.y - 1.28 * length * R[1][axis] + 4.0},
                                       .size = ANNOTATE_TYPE,
                                       .anchor = LRCSI_ANCHOR_MIDDLE,
                                       .colour = colour};
        plotter->line(plotter, line, 2, &style);
        plotter->text(plotter, &label);
    }
}

void lrcsi_annotate(const lrcsi_colouring *colouring, lrcsi_plotter *plotter, double width,
                    lrcsi_plot_point corner, double length)
{
    const double *d = colouring->picture->pose->direction;
    char pose[80];
    /* + 0.0 turns a negative zero into zero */
    double az = atan2(d[1], d[0]) * LRCS_DEGREES_PER_RADIAN + 0.0;
    double el = atan2(d[2], hypot(d[0], d[1])) * LRCS_DEGREES_PER_RADIAN + 0.0;
    snprintf(pose, sizeof pose, "azimuth %.4g deg, elevation %.4g deg", az, el);
    const lrcsi_plot_text title = {.text =
                                       colouring->picture->title ? colouring->picture->title : "",
                                   .at = {ANNOTATE_MARGIN, 21.0},
                                   .size = ANNOTATE_TYPE,
                                   .bold = 1,
                                   .colour = lrcsi_colouring_text_colour(colouring)};
    const lrcsi_plot_text place = {.text = pose,
                                   .at = {ANNOTATE_MARGIN, 39.0},
                                   .size = 12.0,
                                   .colour = lrcsi_colouring_text_colour(colouring)};
    lrcsi_letters_fit(plotter, title, width - 2.0 * ANNOTATE_MARGIN);
    lrcsi_letters_fit(plotter, place, width - 2.0 * ANNOTATE_MARGIN);
    axes_draw(colouring, plotter, corner, length);
}
