/* SPDX-License-Identifier: MIT */
/* A map from its description: which points share a cell, which colour each has, where contours run
   and where everything stands. */
#include "host/axis.h"
#include "host/canvas.h"
#include "host/letters.h"
#include "host/palette.h"
#include "host/series.h"
#include "host/svg.h"

#include <math.h>

#define MAP_COLUMNS 360u /* cells that can be told apart */
#define MAP_ROWS    240u
#define MAP_RIGHT   (LRCSI_CHART_WIDTH - 130.0)
#define MAP_BAR     16.0 /* width of the scale of colours */
#define MAP_STEPS   128
#define MAP_LAP     1.0 /* cells reach that far under the next: no gaps shine through */
#define MAP_NOTHING 0xbdbdbdu
#define MAP_TEXTS   9.0

typedef struct map_plan {
    const lrcs_host_map *map;
    lrcsi_plotter *plotter;
    lrcsi_axis x, y, z;
    uint32_t columns, rows; /* cells */
    uint32_t wide, high;    /* points of a cell, each way */
} map_plan;

/* ---- cells ---- */

/* The place of a cell's middle among the points, and its value there; the last cell may be smaller.
   Means of what is finite, of nothing NAN. */
static double cell_place(const double *place, uint32_t cell, uint32_t each, uint32_t count)
{
    uint32_t first = cell * each;
    uint32_t last = first + each - 1 < count ? first + each - 1 : count - 1;
    return 0.5 * (place[first] + place[last]);
}

static double cell_value(const map_plan *plan, uint32_t column, uint32_t row)
{
    const lrcs_host_map *map = plan->map;
    double sum = 0.0;
    uint32_t count = 0;
    for (uint32_t i = row * plan->high; i < (row + 1) * plan->high && i < map->rows; i++) {
        for (uint32_t k = column * plan->wide; k < (column + 1) * plan->wide && k < map->columns;
             k++) {
            double z = map->z[(size_t)i * map->columns + k];
            sum += isfinite(z) ? z : 0.0;
            count += isfinite(z) != 0;
        }
    }
    return count > 0 ? sum / count : (double)NAN;
}

static double map_x(const map_plan *plan, double value)
{
    return LRCSI_CHART_LEFT + lrcsi_axis_at(&plan->x, value) * (MAP_RIGHT - LRCSI_CHART_LEFT);
}

static double map_y(const map_plan *plan, double value)
{
    return LRCSI_CHART_BOTTOM -
           lrcsi_axis_at(&plan->y, value) * (LRCSI_CHART_BOTTOM - LRCSI_CHART_TOP);
}

/* Where a column or row of cells begins: halfway from the one before, and the first at its point.
 */
static double cell_begin(const double *place, uint32_t cell, uint32_t each, uint32_t count)
{
    uint32_t first = cell * each;
    return first == 0       ? place[0]
           : first >= count ? place[count - 1]
                            : 0.5 * (place[first - 1] + place[first]);
}

static void box_fill(lrcsi_plotter *plotter, double x0, double y0, double x1, double y1,
                     uint32_t colour)
{
    const lrcsi_spot corner[4] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    plotter->area(plotter, corner, 4, colour);
}

/* In steps, so that neighbours that look alike are one. */
static uint32_t cell_colour_of(const map_plan *plan, uint32_t column, uint32_t row)
{
    double value = cell_value(plan, column, row);
    if (!isfinite(value)) {
        return MAP_NOTHING;
    }
    double part = fmin(fmax(lrcsi_axis_at(&plan->z, value), 0.0), 1.0);
    return lrcsi_palette_even(floor(part * MAP_STEPS + 0.5) / MAP_STEPS);
}

static void row_draw(const map_plan *plan, uint32_t row)
{
    const lrcs_host_map *map = plan->map;
    double low = map_y(plan, cell_begin(map->y, row, plan->high, map->rows));
    double high = map_y(plan, cell_begin(map->y, row + 1, plan->high, map->rows));
    double top = fmax(high - MAP_LAP, map_y(plan, map->y[map->rows - 1]));
    double end = map_x(plan, map->x[map->columns - 1]);
    for (uint32_t column = 0; column < plan->columns;) {
        uint32_t colour = cell_colour_of(plan, column, row);
        double x = map_x(plan, cell_begin(map->x, column, plan->wide, map->columns));
        do {
            column++;
        } while (column < plan->columns && cell_colour_of(plan, column, row) == colour);
        double to = map_x(plan, cell_begin(map->x, column, plan->wide, map->columns));
        box_fill(plan->plotter, x, top, fmin(to + MAP_LAP, end), low, colour);
    }
}

/* ---- contours ---- */

/* Where a level is crossed on the way from corner to corner. */
static lrcsi_spot contour_cross(const lrcsi_spot corner[4], const double z[4], int side,
                                double level)
{
    const lrcsi_spot *a = &corner[side];
    const lrcsi_spot *b = &corner[(side + 1) % 4];
    double part = (level - z[side]) / (z[(side + 1) % 4] - z[side]);
    return (lrcsi_spot){a->x + part * (b->x - a->x), a->y + part * (b->y - a->y)};
}

/* The pieces of a contour between four points, two of them where it is a saddle: then the mean says
   which corners belong together. */
static void contour_square(const map_plan *plan, const lrcsi_spot corner[4], const double z[4],
                           double level, const lrcsi_ink *ink)
{
    lrcsi_spot spot[4];
    int count = 0;
    for (int side = 0; side < 4; side++) {
        if ((z[side] >= level) != (z[(side + 1) % 4] >= level)) {
            spot[count++] = contour_cross(corner, z, side, level);
        }
    }
    if (count == 2) {
        plan->plotter->line(plan->plotter, spot, 2, ink);
    } else if (count == 4) {
        int middle = 0.25 * (z[0] + z[1] + z[2] + z[3]) >= level;
        int round = middle == (z[0] >= level); /* corners 1 and 3 are cut off, not 0 and 2 */
        const lrcsi_spot pair[4] = {spot[round ? 0 : 3], spot[round ? 1 : 0], spot[round ? 2 : 1],
                                    spot[round ? 3 : 2]};
        plan->plotter->line(plan->plotter, pair, 2, ink);
        plan->plotter->line(plan->plotter, pair + 2, 2, ink);
    }
}

static void contours_between(const map_plan *plan, uint32_t column, uint32_t row)
{
    static const uint32_t step[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const lrcs_host_map *map = plan->map;
    lrcsi_spot corner[4];
    double z[4];
    for (int k = 0; k < 4; k++) {
        uint32_t c = column + step[k][0];
        uint32_t r = row + step[k][1];
        z[k] = cell_value(plan, c, r);
        corner[k].x = map_x(plan, cell_place(map->x, c, plan->wide, map->columns));
        corner[k].y = map_y(plan, cell_place(map->y, r, plan->high, map->rows));
        if (!isfinite(z[k])) {
            return;
        }
    }
    for (uint32_t i = 0; i < plan->z.count; i++) {
        double part = lrcsi_axis_at(&plan->z, plan->z.tick[i].value);
        const lrcsi_ink ink = {part < 0.6 ? 0xffffffu : 0x333333u, 0.7, {0.0, 0.0}};
        if (plan->z.tick[i].major && part > 0.0 && part < 1.0) {
            contour_square(plan, corner, z, plan->z.tick[i].value, &ink);
        }
    }
}

/* ---- the rest of the paper ---- */

/* The scale of colours, with the levels of the contours. */
static void map_scale(const map_plan *plan)
{
    double left = MAP_RIGHT + 24.0;
    double high = LRCSI_CHART_BOTTOM - LRCSI_CHART_TOP;
    for (int i = MAP_STEPS; i-- > 0;) { /* each from the bottom: no gaps between them */
        box_fill(plan->plotter, left, LRCSI_CHART_BOTTOM - high * (i + 1) / MAP_STEPS,
                 left + MAP_BAR, LRCSI_CHART_BOTTOM, lrcsi_palette_even((i + 0.5) / MAP_STEPS));
    }
    lrcsi_chart_box(plan->plotter, left, left + MAP_BAR);
    for (uint32_t i = 0; i < plan->z.count; i++) {
        const lrcsi_tick *tick = &plan->z.tick[i];
        double y = LRCSI_CHART_BOTTOM - high * lrcsi_axis_at(&plan->z, tick->value);
        double x = left + MAP_BAR;
        const lrcsi_words words = {.text = tick->text,
                                   .at = {x + 8.0, y + LRCSI_CHART_DROP * LRCSI_CHART_SMALL},
                                   .size = LRCSI_CHART_SMALL,
                                   .colour = LRCSI_COLOUR_TEXT};
        if (tick->major) {
            lrcsi_chart_stroke(plan->plotter, x, y, x + 5.0, y, LRCSI_COLOUR_TEXT, 0.9);
            plan->plotter->text(plan->plotter, &words);
        }
    }
    const lrcsi_words name = {
        .text = plan->map->z_name,
        .at = {LRCSI_CHART_WIDTH - 14.0, 0.5 * (LRCSI_CHART_TOP + LRCSI_CHART_BOTTOM)},
        .size = LRCSI_CHART_NAMES,
        .anchor = LRCSI_ANCHOR_MIDDLE,
        .upwards = 1,
        .colour = LRCSI_COLOUR_TEXT};
    lrcsi_chart_words(plan->plotter, name, high);
}

static void map_say(const map_plan *plan)
{
    const lrcs_host_map *map = plan->map;
    lrcsi_chart_box(plan->plotter, LRCSI_CHART_LEFT, MAP_RIGHT);
    for (uint32_t i = 0; i < plan->x.count; i++) {
        const lrcsi_tick *tick = &plan->x.tick[i];
        const lrcsi_spot at = {map_x(plan, tick->value), LRCSI_CHART_BOTTOM};
        lrcsi_chart_tick(plan->plotter, tick, at, 0);
    }
    for (uint32_t i = 0; i < plan->y.count; i++) {
        const lrcsi_tick *tick = &plan->y.tick[i];
        const lrcsi_spot at = {LRCSI_CHART_LEFT, map_y(plan, tick->value)};
        lrcsi_chart_tick(plan->plotter, tick, at, 1);
    }
    lrcsi_chart_title(plan->plotter, map->title, map->note);
    lrcsi_chart_names(plan->plotter, map->x_name, 0.5 * (LRCSI_CHART_LEFT + MAP_RIGHT),
                      MAP_RIGHT - LRCSI_CHART_LEFT, map->y_name,
                      0.5 * (LRCSI_CHART_TOP + LRCSI_CHART_BOTTOM),
                      LRCSI_CHART_BOTTOM - LRCSI_CHART_TOP);
    map_scale(plan);
}

static map_plan map_place(const lrcs_host_map *map, lrcsi_plotter *plotter)
{
    map_plan plan = {.map = map, .plotter = plotter};
    double range[2] = {HUGE_VAL, -HUGE_VAL};
    plan.wide = (map->columns + MAP_COLUMNS - 1) / MAP_COLUMNS;
    plan.high = (map->rows + MAP_ROWS - 1) / MAP_ROWS;
    plan.columns = (map->columns + plan.wide - 1) / plan.wide;
    plan.rows = (map->rows + plan.high - 1) / plan.high;
    for (size_t i = 0; i < (size_t)map->columns * map->rows; i++) {
        if (isfinite(map->z[i])) {
            range[0] = fmin(range[0], map->z[i]);
            range[1] = fmax(range[1], map->z[i]);
        }
    }
    if (map->deep > 0.0) {
        range[0] = fmax(range[0], range[1] - map->deep);
    }
    plan.x = lrcsi_axis_make(map->x_deg ? LRCSI_AXIS_DEG : 0, map->x[0], map->x[map->columns - 1],
                             (MAP_RIGHT - LRCSI_CHART_LEFT) / 50.0);
    plan.y = lrcsi_axis_make(map->y_deg ? LRCSI_AXIS_DEG : 0, map->y[0], map->y[map->rows - 1],
                             (LRCSI_CHART_BOTTOM - LRCSI_CHART_TOP) / 30.0);
    plan.z = lrcsi_axis_make(0, range[0], range[1], MAP_TEXTS);
    return plan;
}

static void map_draw(const lrcs_host_map *map, lrcsi_plotter *plotter)
{
    map_plan plan = map_place(map, plotter);
    for (uint32_t row = 0; row < plan.rows; row++) {
        row_draw(&plan, row);
    }
    for (uint32_t row = 0; row + 1 < plan.rows; row++) {
        for (uint32_t column = 0; column + 1 < plan.columns; column++) {
            contours_between(&plan, column, row);
        }
    }
    map_say(&plan);
}

/* ---- in public ---- */

void lrcs_host_map_svg(FILE *out, const lrcs_host_map *map)
{
    lrcsi_svg svg = lrcsi_svg_begin(out, LRCSI_CHART_WIDTH, LRCSI_CHART_HEIGHT, map->title);
    map_draw(map, &svg.plotter);
    lrcsi_svg_end(&svg);
}

int lrcs_host_map_png(FILE *out, const lrcs_host_map *map, lrcs_host_error *error)
{
    lrcsi_canvas canvas;
    int status = lrcsi_canvas_make(LRCSI_CHART_WIDTH, LRCSI_CHART_HEIGHT, LRCSI_CHART_PIXELS,
                                   &canvas, error);
    if (status == LRCS_OK) {
        map_draw(map, &canvas.plotter);
        status = lrcsi_canvas_end(&canvas, out, error);
    }
    return status;
}
