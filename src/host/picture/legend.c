/* SPDX-License-Identifier: MIT */
/* The legend below a picture: a scale bar on the left; the colour scale beside it, or names of
   materials above it; the grey of what returns nothing. It decides its layout, not what colours
   mean. */
#include "host/picture/legend.h"

#include "host/chart/letters.h"
#include "host/chart/palette.h"

#include <math.h>

#define LEGEND_MARGIN 16.0
#define LEGEND_TYPE   12.0
#define LEGEND_BARS   48.0 /* height of the row of bars */
#define LEGEND_ROW    18.0 /* of names */
#define LEGEND_SWATCH 12.0
#define LEGEND_STEPS  128 /* of the colour bar */
#define LEGEND_BAR    11.0
#define LEGEND_LINE   1.2
#define LEGEND_GREY   110.0 /* room that "returns nothing" needs beside its swatch */
#define LEGEND_LENGTH 0.2   /* fraction of the width: the largest length of the scale bar */

/* ---- the scale bar ---- */

/* The scale bar with its ends and its name, at height y: the largest of 1, 2, 5 x 10^n metres that
   is not longer than LEGEND_LENGTH of the width. `scale`: units of the drawing per metre. */
static void length_draw(lrcsi_plotter *plotter, double y, double width, double scale,
                        uint32_t colour)
{
    char name[32];
    double limit = (LEGEND_LENGTH * width) / scale;
    if (!(scale > 0.0) || !isfinite(limit) || !(limit > 0.0)) {
        return; /* nothing is visible */
    }
    int decade = (int)floor(log10(limit) + 1e-9);
    double mantissa = limit / pow(10.0, decade);
    int digit = mantissa >= 5.0 ? 5 : mantissa >= 2.0 ? 2 : 1;
    if (decade < -6 || decade > 6) {
        snprintf(name, sizeof name, "%de%d m", digit, decade);
    } else if (decade >= 3) {
        snprintf(name, sizeof name, "%d%.*s km", digit, decade - 3, "000");
    } else if (decade >= -1) {
        snprintf(name, sizeof name, decade < 0 ? "0.%d%.*s m" : "%d%.*s m", digit,
                 decade > 0 ? decade : 0, "000");
    } else if (decade >= -3) {
        snprintf(name, sizeof name, "%d%.*s mm", digit, decade + 3, "000");
    } else {
        snprintf(name, sizeof name, "%d%.*s um", digit, decade + 6, "000");
    }
    double length = scale * (digit * pow(10.0, decade));
    double x = LEGEND_MARGIN;
    lrcsi_plot_line(plotter, x, y, x + length, y, colour, LEGEND_LINE);
    lrcsi_plot_line(plotter, x, y - 4.0, x, y + 4.0, colour, LEGEND_LINE);
    lrcsi_plot_line(plotter, x + length, y - 4.0, x + length, y + 4.0, colour, LEGEND_LINE);
    const lrcsi_plot_text label = {.text = name,
                                   .at = {x + 0.5 * length, y + 17.0},
                                   .size = LEGEND_TYPE,
                                   .anchor = LRCSI_ANCHOR_MIDDLE,
                                   .colour = colour};
    plotter->text(plotter, &label);
}

/* ---- the colour scale ---- */

/* Draws the colour scale:
   1. its title and the bar of colours;
   2. the number of ticks from one labelled tick to the next, so that all labels fit;
   3. the labels, among them 0 if it is on the scale. */
static void scale_draw(const lrcsi_colouring *colouring, lrcsi_plotter *plotter, double top,
                       double width, uint32_t colour)
{
    const lrcsi_axis *scale = &colouring->scale;
    double left = LEGEND_MARGIN + (LEGEND_LENGTH + 0.06) * width;
    double bar = width - LEGEND_MARGIN - 8.0 - left;
    double y = top + 16.0;
    const lrcsi_plot_text title = {.text = lrcsi_colouring_name(colouring), /* 1 */
                                   .at = {left + 0.5 * bar, top + 10.0},
                                   .size = LEGEND_TYPE,
                                   .anchor = LRCSI_ANCHOR_MIDDLE,
                                   .colour = colour};
    lrcsi_letters_fit(plotter, title, bar);
    for (int i = 0; i < LEGEND_STEPS; i++) { /* each extends to the end, so that there are no
                                                gaps */
        lrcsi_plot_rectangle(plotter, left + bar * i / LEGEND_STEPS, y, left + bar, y + LEGEND_BAR,
                             lrcsi_palette_viridis((i + 0.5) / LEGEND_STEPS));
    }
    double widest = 0.0; /* 2 */
    uint32_t majors = 0;
    uint32_t negative = 0; /* major ticks below 0 */
    for (uint32_t i = 0; i < scale->count; i++) {
        widest = fmax(widest, lrcsi_letters_width(scale->tick[i].text));
        majors += scale->tick[i].major != 0;
        negative += scale->tick[i].major && scale->tick[i].value < 0.0;
    }
    double apart = bar / fmax(majors - 1.0, 1.0);
    uint32_t step = (uint32_t)ceil((LEGEND_TYPE * widest + 6.0) / apart);
    uint32_t first = scale->high < 0.0 ? 0 : negative % step; /* the first labelled major tick */
    y += LEGEND_BAR;
    for (uint32_t i = 0, major = 0; i < scale->count; i++) { /* 3 */
        const lrcsi_tick *tick = &scale->tick[i];
        double x = left + bar * lrcsi_axis_at(scale, tick->value);
        if (tick->major && major++ % step == first) {
            const lrcsi_plot_text label = {.text = tick->text,
                                           .at = {x, y + 15.0},
                                           .size = LEGEND_TYPE,
                                           .anchor = LRCSI_ANCHOR_MIDDLE,
                                           .colour = colour};
            lrcsi_plot_line(plotter, x, y, x, y + 3.0, colour, LEGEND_LINE);
            plotter->text(plotter, &label);
        }
    }
}

/* ---- materials ---- */

typedef struct legend_grid {
    uint32_t columns, rows,
        shown; /* shown: materials that are listed; a number stands for the others */
    double column;
} legend_grid;

static legend_grid grid_make(const lrcsi_colouring *colouring, double width, double height_max)
{
    legend_grid grid = {.columns = 1, .column = width - 2.0 * LEGEND_MARGIN};
    double widest = colouring->more > 0 ? lrcsi_letters_width("and 100 more") : 0.0;
    for (uint32_t i = 0; i < colouring->materials; i++) {
        widest = fmax(widest, lrcsi_letters_width(lrcsi_colouring_material_name(
                                  colouring, colouring->material[i])));
    }
    double wanted = LEGEND_TYPE * widest + LEGEND_SWATCH + 18.0;
    uint32_t room = (uint32_t)fmax((height_max - LEGEND_BARS) / LEGEND_ROW, 0.0);
    uint32_t items = colouring->materials + (colouring->more != 0);
    grid.columns = (uint32_t)fmin(fmax(floor(grid.column / wanted), 1.0), fmax(items, 1.0));
    grid.column /= grid.columns;
    grid.rows = (items + grid.columns - 1) / grid.columns;
    grid.shown = colouring->materials;
    if (grid.rows > room) {
        grid.rows = room;
        grid.shown = room > 0 ? room * grid.columns - 1 : 0;
    }
    return grid;
}

static void materials_draw(const lrcsi_colouring *colouring, lrcsi_plotter *plotter,
                           const legend_grid *grid, double top, uint32_t colour)
{
    uint32_t more = colouring->more + colouring->materials - grid->shown;
    char others[32];
    snprintf(others, sizeof others, grid->shown > 0 ? "and %lu more" : "%lu materials",
             (unsigned long)more);
    for (uint32_t i = 0; grid->rows > 0 && i < grid->shown + (more > 0); i++) {
        double x = LEGEND_MARGIN + grid->column * (i % grid->columns);
        uint32_t row = i / grid->columns;
        double y = top + LEGEND_ROW * row;
        lrcsi_plot_text label = {.text = others,
                                 .at = {x + LEGEND_SWATCH + 7.0, y + 10.5},
                                 .size = LEGEND_TYPE,
                                 .colour = colour};
        if (i < grid->shown) {
            label.text = lrcsi_colouring_material_name(colouring, colouring->material[i]);
            lrcsi_plot_rectangle(plotter, x - 1.0, y - 1.0, x + LEGEND_SWATCH + 1.0,
                                 y + LEGEND_SWATCH + 1.0, colour);
            lrcsi_plot_rectangle(plotter, x, y, x + LEGEND_SWATCH, y + LEGEND_SWATCH,
                                 lrcsi_colouring_material(colouring, colouring->material[i]));
        }
        lrcsi_letters_fit(plotter, label, grid->column - LEGEND_SWATCH - 12.0);
    }
}

/* ---- the whole legend ---- */

double lrcsi_legend_height(const lrcsi_colouring *colouring, double width, double height_max)
{
    double rows = 0.0;
    if (colouring->materials > 0) {
        legend_grid grid = grid_make(colouring, width, height_max);
        rows = LEGEND_ROW * grid.rows;
    }
    return rows + LEGEND_BARS;
}

void lrcsi_legend_draw(const lrcsi_colouring *colouring, lrcsi_plotter *plotter, double top,
                       double width, double height_max, double scale, uint32_t colour)
{
    if (colouring->materials > 0) {
        legend_grid grid = grid_make(colouring, width, height_max);
        materials_draw(colouring, plotter, &grid, top, colour);
        top += LEGEND_ROW * grid.rows;
    }
    if (colouring->scaled) {
        scale_draw(colouring, plotter, top, width, colour);
    }
    if (colouring->greys && (LEGEND_LENGTH + 0.06) * width >= LEGEND_GREY) {
        /* the swatch of what returns nothing, above the scale bar, where there is room */
        const lrcsi_plot_text label = {.text = "returns nothing",
                                       .at = {LEGEND_MARGIN + LEGEND_SWATCH + 6.0, top + 10.0},
                                       .size = LEGEND_TYPE,
                                       .colour = colour};
        lrcsi_plot_rectangle(plotter, LEGEND_MARGIN, top - 0.5, LEGEND_MARGIN + LEGEND_SWATCH,
                             top - 0.5 + LEGEND_SWATCH, LRCSI_COLOURING_GREY);
        plotter->text(plotter, &label);
    }
    length_draw(plotter, top + 16.0 + 0.5 * LEGEND_BAR, width, scale, colour);
}
