/* SPDX-License-Identifier: MIT */
/* A map from its description: which points share a cell, the colour of each cell, the contours and
   the layout. */
#include "base/constant.h"
#include "host/chart/axis.h"
#include "host/chart/canvas.h"
#include "host/chart/letters.h"
#include "host/chart/palette.h"
#include "host/chart/series.h"
#include "host/chart/svg.h"

#include <math.h>

#define MAP_COLUMNS        360u /* the largest number of cells that can be distinguished */
#define MAP_ROWS           240u
#define MAP_RIGHT          (LRCSI_CHART_WIDTH - 130.0)
#define MAP_BAR            16.0 /* width of the scale of colours */
#define MAP_STEPS          128
#define MAP_OVERLAP        1.0 /* cells overlap the next by this much: no gaps are visible */
#define MAP_COLOUR_MISSING 0xbdbdbdu
#define MAP_LABELS         9.0

/* Mollweide's ellipse, twice as wide as high: its centre and its semi-axes. */
#define ELLIPSE_X     (0.5 * (LRCSI_CHART_LEFT + MAP_RIGHT))
#define ELLIPSE_Y     (0.5 * (LRCSI_CHART_TOP + LRCSI_CHART_BOTTOM))
#define ELLIPSE_A     (0.5 * (MAP_RIGHT - LRCSI_CHART_LEFT))
#define ELLIPSE_B     (0.5 * ELLIPSE_A)
#define ELLIPSE_STEP  3.0 /* deg of latitude over which a meridian is drawn straight */
#define ELLIPSE_EMPTY 0xf0f0f0u

typedef struct map_layout {
    const lrcs_host_map *map;
    lrcsi_plotter *plotter;
    lrcsi_chart_axes axes;  /* of a map in a rectangle */
    lrcsi_axis z;           /* the scale of colours */
    uint32_t columns, rows; /* cells */
    uint32_t wide, high;    /* points of a cell, each way */
} map_layout;

/* ---- cells ---- */

/* The position of a cell's middle among the points, and its value there; the last cell may be
   smaller. The value is the mean of the finite values, NAN if there are none. */
static double cell_place(const double *place, uint32_t cell, uint32_t each, uint32_t count)
{
    uint32_t first = cell * each;
    uint32_t last = first + each - 1 < count ? first + each - 1 : count - 1;
    return 0.5 * (place[first] + place[last]);
}

static double cell_value(const map_layout *layout, uint32_t column, uint32_t row)
{
    const lrcs_host_map *map = layout->map;
    double sum = 0.0;
    uint32_t count = 0;
    for (uint32_t i = row * layout->high; i < (row + 1) * layout->high && i < map->rows; i++) {
        for (uint32_t k = column * layout->wide;
             k < (column + 1) * layout->wide && k < map->columns; k++) {
            double z = map->z[(size_t)i * map->columns + k];
            sum += isfinite(z) ? z : 0.0;
            count += isfinite(z) != 0;
        }
    }
    return count > 0 ? sum / count : (double)NAN;
}

/* The beginning of a column or row of cells: halfway from the one before; the first begins at its
   point. */
static double cell_begin(const double *place, uint32_t cell, uint32_t each, uint32_t count)
{
    uint32_t first = cell * each;
    return first == 0       ? place[0]
           : first >= count ? place[count - 1]
                            : 0.5 * (place[first - 1] + place[first]);
}

/* ---- Mollweide's projection ---- */

/* The height of a latitude, -1 .. 1: sin(t) where 2 t + sin(2 t) = pi sin(latitude), by Newton's
   method, whose derivative 2 + 2 cos(2 t) vanishes only at the poles; 1e-9 is far below a pixel.
   Source: J. P. Snyder, Map Projections: A Working Manual, USGS PP 1395 (1987) 251. */
static double ellipse_height(double degrees)
{
    double target = LRCS_PI * sin(degrees * LRCS_PI / 180.0);
    double t = degrees * LRCS_PI / 180.0;
    if (fabs(degrees) >= 90.0) {
        return degrees > 0.0 ? 1.0 : -1.0;
    }
    for (int i = 0; i < 60; i++) {
        double step = (2.0 * t + sin(2.0 * t) - target) / (2.0 + 2.0 * cos(2.0 * t));
        t -= step;
        if (fabs(step) < 1e-9) {
            break;
        }
    }
    return fmax(-1.0, fmin(1.0, sin(t)));
}

/* Of a longitude in -180 .. 180 at a height. */
static lrcsi_plot_point ellipse_point(double longitude, double height)
{
    double narrow = sqrt(fmax(1.0 - height * height, 0.0));
    return (lrcsi_plot_point){ELLIPSE_X + ELLIPSE_A * narrow * longitude / 180.0,
                              ELLIPSE_Y - ELLIPSE_B * height};
}

/* The multiple of 360 that reduces a longitude to -180 .. 180 when added to it. */
static double longitude_shift(double longitude)
{
    return -360.0 * floor((longitude + 180.0) / 360.0);
}

/* A quadrilateral of a row of cells. Each overlaps the next one to the right and above, which is
   drawn later. */
static void ellipse_quad(const map_layout *layout, double west, double east, const double height[2],
                         uint32_t colour)
{
    double low = height[0];
    double high = fmin(height[1] + MAP_OVERLAP / ELLIPSE_B, 1.0);
    double overlap = 180.0 * MAP_OVERLAP / ELLIPSE_A;
    east = fmin(east + overlap, 180.0);
    const lrcsi_plot_point corner[4] = {ellipse_point(west, low), ellipse_point(east, low),
                                        ellipse_point(east, high), ellipse_point(west, high)};
    layout->plotter->area(layout->plotter, corner, 4, colour);
}

/* Cells of one colour between two longitudes and two latitudes: cut at 180 degrees, where the map
   ends, and divided into steps of latitude with straight sides. */
static void ellipse_cells(const map_layout *layout, double west, double east,
                          const double latitude[2], uint32_t colour)
{
    int steps = (int)ceil((latitude[1] - latitude[0]) / ELLIPSE_STEP);
    double shift = longitude_shift(west);
    west += shift;
    east += shift;
    for (int i = 0; i < steps; i++) {
        double each = (latitude[1] - latitude[0]) / steps;
        const double height[2] = {ellipse_height(latitude[0] + i * each),
                                  ellipse_height(latitude[0] + (i + 1) * each)};
        ellipse_quad(layout, west, fmin(east, 180.0), height, colour);
        if (east > 180.0) {
            ellipse_quad(layout, -180.0, east - 360.0, height, colour);
        }
    }
}

static void ellipse_line(const map_layout *layout, double longitude, uint32_t colour, double width)
{
    lrcsi_plot_point point[61];
    const lrcsi_line_style style = {colour, width, {0.0, 0.0}};
    for (int i = 0; i <= 60; i++) {
        point[i] = ellipse_point(longitude, sin(LRCS_PI * (i - 30) / 60.0));
    }
    layout->plotter->line(layout->plotter, point, 61, &style);
}

/* The background below the cells, for what they do not cover. */
static void ellipse_background(const map_layout *layout)
{
    lrcsi_plot_point point[120];
    for (int i = 0; i < 120; i++) {
        double t = LRCS_PI * i / 60.0;
        point[i] =
            (lrcsi_plot_point){ELLIPSE_X + ELLIPSE_A * cos(t), ELLIPSE_Y - ELLIPSE_B * sin(t)};
    }
    layout->plotter->area(layout->plotter, point, 120, ELLIPSE_EMPTY);
}

/* Meridians and parallels every 30 degrees, with numbers along the equator and on the left. */
static void ellipse_graticule(const map_layout *layout)
{
    char text[16];
    for (int degrees = -150; degrees <= 150; degrees += 30) {
        ellipse_line(layout, degrees, 0x777777u, 0.5);
    }
    for (int degrees = -60; degrees <= 60; degrees += 30) {
        double height = ellipse_height(degrees);
        lrcsi_plot_point left = ellipse_point(-180.0, height);
        lrcsi_plot_point right = ellipse_point(180.0, height);
        lrcsi_plot_line(layout->plotter, left.x, left.y, right.x, right.y, 0x777777u, 0.5);
        left.x -= 8.0;
        snprintf(text, sizeof text, "%d", degrees);
        lrcsi_chart_number(layout->plotter, text, left, LRCSI_CHART_SMALL, LRCSI_ANCHOR_RIGHT);
    }
    for (int degrees = -120; degrees <= 120; degrees += 60) {
        snprintf(text, sizeof text, "%d", degrees);
        lrcsi_chart_number_over(layout->plotter, text, ellipse_point(degrees, 0.0),
                                LRCSI_CHART_SMALL);
    }
    ellipse_line(layout, -180.0, LRCSI_COLOUR_TEXT, 0.9);
    ellipse_line(layout, 180.0, LRCSI_COLOUR_TEXT, 0.9);
}

/* ---- rows of cells ---- */

/* Colours in steps, so that neighbours of equal colour are merged. */
static uint32_t cell_colour_of(const map_layout *layout, uint32_t column, uint32_t row)
{
    double value = cell_value(layout, column, row);
    if (!isfinite(value)) {
        return MAP_COLOUR_MISSING;
    }
    double fraction = fmin(fmax(lrcsi_axis_at(&layout->z, value), 0.0), 1.0);
    return lrcsi_palette_viridis(floor(fraction * MAP_STEPS + 0.5) / MAP_STEPS);
}

static void row_draw(const map_layout *layout, uint32_t row)
{
    const lrcs_host_map *map = layout->map;
    const double side[2] = {cell_begin(map->y, row, layout->high, map->rows),
                            cell_begin(map->y, row + 1, layout->high, map->rows)};
    double low = lrcsi_chart_y(&layout->axes, side[0]);
    double high = lrcsi_chart_y(&layout->axes, side[1]);
    double top = fmax(high - MAP_OVERLAP, lrcsi_chart_y(&layout->axes, map->y[map->rows - 1]));
    double end = lrcsi_chart_x(&layout->axes, map->x[map->columns - 1]);
    for (uint32_t column = 0; column < layout->columns;) {
        uint32_t colour = cell_colour_of(layout, column, row);
        double from = cell_begin(map->x, column, layout->wide, map->columns);
        do {
            column++;
        } while (column < layout->columns && cell_colour_of(layout, column, row) == colour);
        double to = cell_begin(map->x, column, layout->wide, map->columns);
        if (map->mollweide) {
            ellipse_cells(layout, from, to, side, colour);
        } else {
            lrcsi_plot_rectangle(layout->plotter, lrcsi_chart_x(&layout->axes, from), top,
                                 fmin(lrcsi_chart_x(&layout->axes, to) + MAP_OVERLAP, end), low,
                                 colour);
        }
    }
}

/* ---- contours ---- */

/* Draws the contours between the middles of four cells, by marching squares. At a saddle a level is
   crossed on all four sides, and there are two contours; the mean of the four values decides
   which corners they separate. */
static void contours_between(const map_layout *layout, uint32_t column, uint32_t row)
{
    static const uint32_t step[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const lrcs_host_map *map = layout->map;
    lrcsi_plot_point corner[4];
    double z[4];
    double shift = longitude_shift(cell_place(map->x, column, layout->wide, map->columns));
    for (int k = 0; k < 4; k++) {
        uint32_t c = column + step[k][0];
        uint32_t r = row + step[k][1];
        double x = cell_place(map->x, c, layout->wide, map->columns);
        double y = cell_place(map->y, r, layout->high, map->rows);
        z[k] = cell_value(layout, c, r);
        corner[k] = map->mollweide ? ellipse_point(x + shift, ellipse_height(y))
                                   : (lrcsi_plot_point){lrcsi_chart_x(&layout->axes, x),
                                                        lrcsi_chart_y(&layout->axes, y)};
        if (!isfinite(z[k]) || (map->mollweide && x + shift > 180.0)) {
            return; /* nothing there, or on both sides of the map */
        }
    }
    for (uint32_t i = 0; i < layout->z.count; i++) {
        double level = layout->z.tick[i].value;
        double fraction = lrcsi_axis_at(&layout->z, level);
        const lrcsi_line_style style = {fraction < 0.6 ? 0xffffffu : 0x333333u, 0.7, {0.0, 0.0}};
        lrcsi_plot_point point[4]; /* where the level is crossed, side by side */
        int count = 0;
        for (int k = 0; k < 4 && layout->z.tick[i].major && fraction > 0.0 && fraction < 1.0; k++) {
            const lrcsi_plot_point *a = &corner[k];
            const lrcsi_plot_point *b = &corner[(k + 1) % 4];
            double to = z[(k + 1) % 4];
            if ((z[k] >= level) != (to >= level)) {
                double t = (level - z[k]) / (to - z[k]);
                point[count++] =
                    (lrcsi_plot_point){a->x + t * (b->x - a->x), a->y + t * (b->y - a->y)};
            }
        }
        if (count == 2) {
            layout->plotter->line(layout->plotter, point, 2, &style);
        } else if (count == 4) {
            int middle = 0.25 * (z[0] + z[1] + z[2] + z[3]) >= level;
            int separate =
                middle ==
                (z[0] >=
                 level); /* 1: contours separate corners 1 and 3 from the rest, else 0 and 2 */
            const lrcsi_plot_point pair[4] = {point[separate ? 0 : 3], point[separate ? 1 : 0],
                                              point[separate ? 2 : 1], point[separate ? 3 : 2]};
            layout->plotter->line(layout->plotter, pair, 2, &style);
            layout->plotter->line(layout->plotter, pair + 2, 2, &style);
        }
    }
}

/* ---- scale, frame and titles ---- */

/* The scale of colours, with the levels of the contours. */
static void map_scale(const map_layout *layout)
{
    double left = MAP_RIGHT + 24.0;
    double high = LRCSI_CHART_BOTTOM - LRCSI_CHART_TOP;
    for (int i = MAP_STEPS; i-- > 0;) { /* each begins at the bottom, so that there are no gaps */
        lrcsi_plot_rectangle(layout->plotter, left, LRCSI_CHART_BOTTOM - high * (i + 1) / MAP_STEPS,
                             left + MAP_BAR, LRCSI_CHART_BOTTOM,
                             lrcsi_palette_viridis((i + 0.5) / MAP_STEPS));
    }
    lrcsi_chart_box(layout->plotter, left, left + MAP_BAR);
    for (uint32_t i = 0; i < layout->z.count; i++) {
        const lrcsi_tick *tick = &layout->z.tick[i];
        double y = LRCSI_CHART_BOTTOM - high * lrcsi_axis_at(&layout->z, tick->value);
        double x = left + MAP_BAR;
        if (tick->major) {
            lrcsi_plot_line(layout->plotter, x, y, x + 5.0, y, LRCSI_COLOUR_TEXT, 0.9);
            lrcsi_chart_number(layout->plotter, tick->text, (lrcsi_plot_point){x + 8.0, y},
                               LRCSI_CHART_SMALL, LRCSI_ANCHOR_LEFT);
        }
    }
    const lrcsi_plot_text name = {
        .text = layout->map->z_name,
        .at = {LRCSI_CHART_WIDTH - 14.0, 0.5 * (LRCSI_CHART_TOP + LRCSI_CHART_BOTTOM)},
        .size = LRCSI_CHART_NAMES,
        .anchor = LRCSI_ANCHOR_MIDDLE,
        .upwards = 1,
        .colour = LRCSI_COLOUR_TEXT};
    lrcsi_letters_fit(layout->plotter, name, high);
}

static map_layout map_place(const lrcs_host_map *map, lrcsi_plotter *plotter)
{
    map_layout layout = {.map = map, .plotter = plotter};
    double range[2] = {HUGE_VAL, -HUGE_VAL};
    layout.wide = (map->columns + MAP_COLUMNS - 1) / MAP_COLUMNS;
    layout.high = (map->rows + MAP_ROWS - 1) / MAP_ROWS;
    layout.columns = (map->columns + layout.wide - 1) / layout.wide;
    layout.rows = (map->rows + layout.high - 1) / layout.high;
    for (size_t i = 0; i < (size_t)map->columns * map->rows; i++) {
        if (isfinite(map->z[i])) {
            range[0] = fmin(range[0], map->z[i]);
            range[1] = fmax(range[1], map->z[i]);
        }
    }
    if (map->deep > 0.0) {
        range[0] = fmax(range[0], range[1] - map->deep);
    }
    layout.axes.right = MAP_RIGHT;
    layout.axes.x =
        lrcsi_axis_make(map->x_deg ? LRCSI_AXIS_DEG : 0, map->x[0], map->x[map->columns - 1],
                        (MAP_RIGHT - LRCSI_CHART_LEFT) / 50.0);
    layout.axes.y =
        lrcsi_axis_make(map->y_deg ? LRCSI_AXIS_DEG : 0, map->y[0], map->y[map->rows - 1],
                        (LRCSI_CHART_BOTTOM - LRCSI_CHART_TOP) / 30.0);
    layout.z = lrcsi_axis_make(0, range[0], range[1], MAP_LABELS);
    return layout;
}

static void map_draw(const lrcs_host_map *map, lrcsi_plotter *plotter)
{
    map_layout layout = map_place(map, plotter);
    if (map->mollweide) {
        ellipse_background(&layout);
    }
    for (uint32_t row = 0; row < layout.rows; row++) {
        row_draw(&layout, row);
    }
    for (uint32_t row = 0; row + 1 < layout.rows && !map->cells; row++) {
        for (uint32_t column = 0; column + 1 < layout.columns; column++) {
            contours_between(&layout, column, row);
        }
    }
    if (map->mollweide) {
        ellipse_graticule(&layout);
    } else {
        lrcsi_chart_frame(plotter, &layout.axes);
    }
    lrcsi_chart_title(plotter, map->title, map->note);
    lrcsi_chart_names(plotter, MAP_RIGHT, map->x_name, map->y_name);
    map_scale(&layout);
}

/* ---- in public ---- */

void lrcs_host_map_svg(FILE *out, const lrcs_host_map *map)
{
    lrcsi_svg svg =
        lrcsi_svg_begin(out, LRCSI_CHART_WIDTH, LRCSI_CHART_HEIGHT, map->title, map->about);
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
        status = lrcsi_canvas_end(&canvas, out, map->about, error);
    }
    return status;
}
