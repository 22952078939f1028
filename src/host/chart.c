/* SPDX-License-Identifier: MIT */
/* A chart from its description: where everything stands and in which order it is drawn. Numbers
   become ticks in axis.c, strokes become SVG or pixels behind the pen. */
#include "host/axis.h"
#include "host/canvas.h"
#include "host/label.h"
#include "host/letters.h"
#include "host/palette.h"
#include "host/svg.h"

#include <math.h>

/* Paper, in units of which a PNG has two pixels each. */
#define CHART_WIDTH  860.0
#define CHART_HEIGHT 520.0
#define CHART_PIXELS 2.0

#define CHART_LEFT    82.0
#define CHART_TOP     60.0
#define CHART_BOTTOM  (CHART_HEIGHT - 58.0)
#define CHART_MARGIN  16.0
#define CHART_SMALL   12.0 /* type: ticks and legend */
#define TEXT_DROP     0.36 /* of the size: from a text's middle to its base line */
#define CHART_MARK    3.8  /* half a marker's width; outlines stand about full ones */
#define CHART_OUTLINE 5.8
#define GRID_MOST     60u /* ticks */
#define LEGEND_SAMPLE 30.0
#define LEGEND_LINE   19.0

#define COLOUR_TEXT  0x222222u
#define COLOUR_FAINT 0x666666u
#define COLOUR_GRID  0xd9d9d9u
#define COLOUR_MINOR 0xefefefu
#define COLOUR_FLOOR 0xf4f1e8u
#define COLOUR_PAPER 0xffffffu

typedef struct chart_plan {
    const lrcs_host_chart *chart;
    lrcsi_pen *pen;
    lrcsi_axis x, y;
    double right; /* of the plot; the legend stands beyond */
    lrcsi_board *board;
} chart_plan;

/* ---- where things are ---- */

static double chart_x(const chart_plan *plan, double value)
{
    return CHART_LEFT + lrcsi_axis_at(&plan->x, value) * (plan->right - CHART_LEFT);
}

static double chart_y(const chart_plan *plan, double value)
{
    return CHART_BOTTOM - lrcsi_axis_at(&plan->y, value) * (CHART_BOTTOM - CHART_TOP);
}

/* A value as the axis will show it; 0 where it cannot. */
static int chart_shows(int log, double floor, double *value)
{
    if (log && floor > 0.0 && *value <= floor) {
        *value = floor;
    }
    return fabs(*value) <= 0.1 * LRCSI_AXIS_MOST && (!log || *value >= 10.0 * LRCSI_AXIS_LEAST);
}

static int chart_point(const chart_plan *plan, const lrcs_host_series *series, uint32_t i,
                       lrcsi_spot *spot)
{
    const lrcs_host_chart *chart = plan->chart;
    double x = series->x[i];
    double y = series->y[i];
    if (!chart_shows(chart->x_log, 0.0, &x) || !chart_shows(chart->y_log, chart->floor, &y)) {
        return 0;
    }
    *spot = (lrcsi_spot){chart_x(plan, x), chart_y(plan, y)};
    return 1;
}

/* The least and the most that an axis has to show, a little room about it. */
static void chart_range(const lrcs_host_chart *chart, int vertical, double range[2])
{
    int log = vertical ? chart->y_log : chart->x_log;
    double floor = vertical && log ? chart->floor : 0.0;
    range[0] = HUGE_VAL;
    range[1] = -HUGE_VAL;
    for (uint32_t i = 0; i < chart->series_count; i++) {
        const lrcs_host_series *series = &chart->series[i];
        for (uint32_t k = 0; k < series->count; k++) {
            double value = vertical ? series->y[k] : series->x[k];
            if (chart_shows(log, floor, &value)) {
                range[0] = fmin(range[0], value);
                range[1] = fmax(range[1], value);
            }
        }
    }
    if (floor > 0.0) { /* room for the arrows; less than three decades would exaggerate */
        range[0] = floor / 5.0;
        range[1] = fmax(range[1], 1000.0 * range[0]);
    }
    if (log) {
        range[0] /= 1.2;
        range[1] *= vertical ? 4.0 : 1.2; /* labels stand above */
    }
}

static double legend_width(const lrcs_host_chart *chart)
{
    double widest = chart->floor_name ? lrcsi_letters_width(chart->floor_name) : 0.0;
    for (uint32_t i = 0; i < chart->series_count; i++) {
        widest = fmax(widest, lrcsi_letters_width(chart->series[i].name));
    }
    return LEGEND_SAMPLE + 10.0 + CHART_SMALL * widest;
}

/* ---- the frame ---- */

static void chart_stroke(const chart_plan *plan, double x0, double y0, double x1, double y1,
                         uint32_t colour, double width)
{
    const lrcsi_spot spot[2] = {{x0, y0}, {x1, y1}};
    const lrcsi_ink ink = {colour, width, {0.0, 0.0}};
    plan->pen->line(plan->pen, spot, 2, &ink);
}

/* What lies below the floor is not to be told apart. */
static void chart_floor(const chart_plan *plan)
{
    double y = chart_y(plan, plan->chart->floor);
    const lrcsi_spot corner[4] = {
        {CHART_LEFT, y}, {plan->right, y}, {plan->right, CHART_BOTTOM}, {CHART_LEFT, CHART_BOTTOM}};
    plan->pen->area(plan->pen, corner, 4, COLOUR_FLOOR);
}

/* Lines at the major ticks, or the minor ones where they are not a hatching. */
static void chart_grid(const chart_plan *plan, int major)
{
    uint32_t colour = major ? COLOUR_GRID : COLOUR_MINOR;
    double width = major ? 0.9 : 0.7;
    for (uint32_t i = 0; i < plan->x.count; i++) {
        double x = chart_x(plan, plan->x.tick[i].value);
        if (plan->x.tick[i].major == major && (major || plan->x.count <= GRID_MOST)) {
            chart_stroke(plan, x, CHART_TOP, x, CHART_BOTTOM, colour, width);
        }
    }
    for (uint32_t i = 0; i < plan->y.count; i++) {
        double y = chart_y(plan, plan->y.tick[i].value);
        if (plan->y.tick[i].major == major && (major || plan->y.count <= GRID_MOST)) {
            chart_stroke(plan, CHART_LEFT, y, plan->right, y, colour, width);
        }
    }
}

static void tick_draw(const chart_plan *plan, const lrcsi_tick *tick, int vertical)
{
    double length = tick->major ? 5.0 : 3.0;
    double x = vertical ? CHART_LEFT : chart_x(plan, tick->value);
    double y = vertical ? chart_y(plan, tick->value) : CHART_BOTTOM;
    lrcsi_words words = {.text = tick->text,
                         .raised = tick->raised[0] ? tick->raised : NULL,
                         .at = {x, y + 19.0},
                         .size = CHART_SMALL,
                         .anchor = LRCSI_ANCHOR_MIDDLE,
                         .colour = COLOUR_TEXT};
    if (vertical) {
        words.at = (lrcsi_spot){x - 9.0, y + TEXT_DROP * CHART_SMALL};
        words.anchor = LRCSI_ANCHOR_RIGHT;
    }
    chart_stroke(plan, x - (vertical ? length : 0.0), y, x, y + (vertical ? 0.0 : length),
                 COLOUR_TEXT, 0.9);
    if (tick->major) {
        plan->pen->text(plan->pen, &words);
    }
}

static void chart_ticks(const chart_plan *plan)
{
    for (uint32_t i = 0; i < plan->x.count; i++) {
        tick_draw(plan, &plan->x.tick[i], 0);
    }
    for (uint32_t i = 0; i < plan->y.count; i++) {
        tick_draw(plan, &plan->y.tick[i], 1);
    }
}

/* A line of text, smaller where it would leave the paper. */
static void chart_words(const chart_plan *plan, lrcsi_words words, double room)
{
    double width = words.size * lrcsi_letters_width(words.text);
    words.size *= width > room ? room / width : 1.0;
    plan->pen->text(plan->pen, &words);
}

static void chart_names(const chart_plan *plan)
{
    const lrcs_host_chart *chart = plan->chart;
    double room = CHART_WIDTH - CHART_LEFT - CHART_MARGIN;
    const lrcsi_words title = {.text = chart->title,
                               .at = {CHART_LEFT, 26.0},
                               .size = 16.0,
                               .bold = 1,
                               .colour = COLOUR_TEXT};
    const lrcsi_words note = {.text = chart->note ? chart->note : "",
                              .at = {CHART_LEFT, 46.0},
                              .size = CHART_SMALL,
                              .colour = COLOUR_FAINT};
    const lrcsi_words below = {.text = chart->x_name,
                               .at = {0.5 * (CHART_LEFT + plan->right), CHART_HEIGHT - 14.0},
                               .size = 13.0,
                               .anchor = LRCSI_ANCHOR_MIDDLE,
                               .colour = COLOUR_TEXT};
    const lrcsi_words beside = {.text = chart->y_name,
                                .at = {22.0, 0.5 * (CHART_TOP + CHART_BOTTOM)},
                                .size = 13.0,
                                .anchor = LRCSI_ANCHOR_MIDDLE,
                                .upwards = 1,
                                .colour = COLOUR_TEXT};
    chart_words(plan, title, room);
    chart_words(plan, note, room);
    chart_words(plan, below, plan->right - CHART_LEFT);
    chart_words(plan, beside, CHART_BOTTOM - CHART_TOP);
}

static void chart_frame(const chart_plan *plan)
{
    const lrcsi_spot corner[5] = {{CHART_LEFT, CHART_TOP},
                                  {plan->right, CHART_TOP},
                                  {plan->right, CHART_BOTTOM},
                                  {CHART_LEFT, CHART_BOTTOM},
                                  {CHART_LEFT, CHART_TOP}};
    const lrcsi_ink ink = {COLOUR_TEXT, 0.9, {0.0, 0.0}};
    plan->pen->line(plan->pen, corner, 5, &ink);
}

/* ---- the data ---- */

static lrcsi_ink series_ink(const lrcs_host_series *series)
{
    static const double dash[3][2] = {{0.0, 0.0}, {7.0, 5.0}, {0.1, 4.5}};
    lrcsi_ink ink = {lrcsi_palette_named(series->colour), 1.7, {0.0, 0.0}};
    int kind =
        series->dash == LRCS_HOST_DASHED || series->dash == LRCS_HOST_DOTTED ? series->dash : 0;
    ink.dash[0] = dash[kind][0];
    ink.dash[1] = dash[kind][1];
    ink.width = kind == LRCS_HOST_DOTTED ? 2.2 : 1.7;
    return ink;
}

/* The corners of a marker about the origin, half a width of 1; their number. */
static uint32_t marker_corners(int marker, lrcsi_spot corner[24])
{
    static const lrcsi_spot square[4] = {{-0.9, -0.9}, {0.9, -0.9}, {0.9, 0.9}, {-0.9, 0.9}};
    static const lrcsi_spot triangle[3] = {{0.0, -1.25}, {1.15, 0.8}, {-1.15, 0.8}};
    static const lrcsi_spot diamond[4] = {{0.0, -1.3}, {1.3, 0.0}, {0.0, 1.3}, {-1.3, 0.0}};
    const lrcsi_spot *from = marker == LRCS_HOST_SQUARE     ? square
                             : marker == LRCS_HOST_TRIANGLE ? triangle
                             : marker == LRCS_HOST_DIAMOND  ? diamond
                                                            : NULL;
    uint32_t count = !from ? 24 : from == triangle ? 3 : 4;
    for (uint32_t i = 0; i < count; i++) {
        double turn = 2.0 * 3.14159265358979323846 * i / 24.0;
        corner[i] = from ? from[i] : (lrcsi_spot){cos(turn), sin(turn)};
    }
    return count;
}

static void marker_draw(const chart_plan *plan, const lrcs_host_series *series, lrcsi_spot at)
{
    lrcsi_spot corner[25];
    uint32_t colour = lrcsi_palette_named(series->colour);
    const lrcsi_ink ink = {colour, 1.4, {0.0, 0.0}};
    if (series->marker == LRCS_HOST_NO_MARKER) {
        return;
    }
    if (series->marker == LRCS_HOST_CROSS) {
        chart_stroke(plan, at.x - CHART_MARK, at.y - CHART_MARK, at.x + CHART_MARK,
                     at.y + CHART_MARK, colour, 1.7);
        chart_stroke(plan, at.x - CHART_MARK, at.y + CHART_MARK, at.x + CHART_MARK,
                     at.y - CHART_MARK, colour, 1.7);
        return;
    }
    uint32_t count = marker_corners(series->marker, corner);
    double half = series->hollow ? CHART_OUTLINE : CHART_MARK;
    for (uint32_t i = 0; i < count; i++) {
        corner[i].x = at.x + half * corner[i].x;
        corner[i].y = at.y + half * corner[i].y;
    }
    corner[count] = corner[0];
    plan->pen->area(plan->pen, corner, count, series->hollow ? COLOUR_PAPER : colour);
    plan->pen->line(plan->pen, corner, count + 1, &ink);
}

static void run_draw(const chart_plan *plan, const lrcs_host_series *series, const lrcsi_spot *spot,
                     uint32_t count)
{
    const lrcsi_ink ink = series_ink(series);
    int joined = series->dash != LRCS_HOST_NO_LINE;
    if (count > 1 && joined) {
        plan->pen->line(plan->pen, spot, count, &ink);
    }
    for (uint32_t i = 0; i < count; i++) {
        lrcsi_board_spot(plan->board, spot[i], CHART_OUTLINE);
        lrcsi_board_line(plan->board, spot[i > 0 && joined ? i - 1 : i], spot[i]);
    }
}

/* A series' line, in runs of some length; its dashes begin anew with each. */
static void series_line(const chart_plan *plan, const lrcs_host_series *series)
{
    lrcsi_spot run[256];
    uint32_t count = 0;
    for (uint32_t i = 0; i < series->count; i++) {
        if (!chart_point(plan, series, i, &run[count])) {
            continue;
        }
        if (++count == sizeof run / sizeof run[0]) {
            run_draw(plan, series, run, count);
            run[0] = run[count - 1];
            count = 1;
        }
    }
    run_draw(plan, series, run, count);
}

/* Below a point that lies under the floor. */
static void arrow_draw(const chart_plan *plan, uint32_t colour, lrcsi_spot at)
{
    const lrcsi_spot head[3] = {
        {at.x - 3.2, at.y + 9.5}, {at.x + 3.2, at.y + 9.5}, {at.x, at.y + 14.5}};
    chart_stroke(plan, at.x, at.y + CHART_MARK, at.x, at.y + 10.0, colour, 1.4);
    plan->pen->area(plan->pen, head, 3, colour);
    lrcsi_board_line(plan->board, at, head[2]);
}

static void series_marks(const chart_plan *plan, const lrcs_host_series *series)
{
    for (uint32_t i = 0; i < series->count; i++) {
        lrcsi_spot at;
        if (!chart_point(plan, series, i, &at)) {
            continue;
        }
        if (plan->chart->y_log && series->y[i] < plan->chart->floor &&
            series->marker != LRCS_HOST_NO_MARKER) {
            arrow_draw(plan, lrcsi_palette_named(series->colour), at);
        }
        marker_draw(plan, series, at);
    }
}

static void series_labels(const chart_plan *plan, const lrcs_host_series *series)
{
    for (uint32_t i = 0; series->label && i < series->count; i++) {
        lrcsi_spot at;
        lrcsi_words words = {
            .text = series->label[i], .size = 10.5, .colour = lrcsi_palette_named(series->colour)};
        if (words.text && chart_point(plan, series, i, &at) &&
            lrcsi_board_text(plan->board, at, 8.0, words.text, words.size, &words.at)) {
            plan->pen->text(plan->pen, &words);
        }
    }
}

static void chart_legend(const chart_plan *plan)
{
    const lrcs_host_chart *chart = plan->chart;
    double x = plan->right + CHART_MARGIN;
    double y = CHART_TOP + 8.0;
    lrcsi_words words = {.size = CHART_SMALL, .colour = COLOUR_TEXT};
    for (uint32_t i = 0; i < chart->series_count; i++, y += LEGEND_LINE) {
        const lrcs_host_series *series = &chart->series[i];
        const lrcsi_ink ink = series_ink(series);
        const lrcsi_spot sample[2] = {{x, y}, {x + LEGEND_SAMPLE, y}};
        if (series->dash != LRCS_HOST_NO_LINE) {
            plan->pen->line(plan->pen, sample, 2, &ink);
        }
        marker_draw(plan, series, (lrcsi_spot){x + 0.5 * LEGEND_SAMPLE, y});
        words.text = series->name;
        words.at = (lrcsi_spot){x + LEGEND_SAMPLE + 8.0, y + TEXT_DROP * CHART_SMALL};
        plan->pen->text(plan->pen, &words);
    }
    if (chart->y_log && chart->floor > 0.0 && chart->floor_name) {
        const lrcsi_spot corner[4] = {
            {x, y - 5.0}, {x + LEGEND_SAMPLE, y - 5.0}, {x + LEGEND_SAMPLE, y + 6.0}, {x, y + 6.0}};
        plan->pen->area(plan->pen, corner, 4, COLOUR_FLOOR);
        chart_stroke(plan, x, y - 5.0, x + LEGEND_SAMPLE, y - 5.0, COLOUR_FAINT, 1.2);
        arrow_draw(plan, COLOUR_FAINT, (lrcsi_spot){x + 0.5 * LEGEND_SAMPLE, y - 8.5});
        words.text = chart->floor_name;
        words.at = (lrcsi_spot){x + LEGEND_SAMPLE + 8.0, y + TEXT_DROP * CHART_SMALL};
        plan->pen->text(plan->pen, &words);
    }
}

/* The paper that the data are drawn on. */
static void chart_ground(const chart_plan *plan)
{
    int floor = plan->chart->y_log && plan->chart->floor > 0.0;
    if (floor) {
        chart_floor(plan);
    }
    chart_grid(plan, 0);
    chart_grid(plan, 1);
    if (floor) {
        double y = chart_y(plan, plan->chart->floor);
        chart_stroke(plan, CHART_LEFT, y, plan->right, y, COLOUR_FAINT, 1.2);
    }
}

/* All lines first: none crosses out a marker. */
static void chart_data(const chart_plan *plan)
{
    const lrcs_host_chart *chart = plan->chart;
    for (uint32_t i = 0; i < chart->series_count; i++) {
        series_line(plan, &chart->series[i]);
    }
    for (uint32_t i = 0; i < chart->series_count; i++) {
        series_marks(plan, &chart->series[i]);
    }
    for (uint32_t i = 0; i < chart->series_count; i++) {
        series_labels(plan, &chart->series[i]);
    }
}

static void chart_draw(const lrcs_host_chart *chart, lrcsi_pen *pen)
{
    double right = CHART_WIDTH - 2.0 * CHART_MARGIN - legend_width(chart);
    right = fmax(right, 0.5 * CHART_WIDTH); /* a longer legend is cut */
    lrcsi_board board = {
        .frame = {(float)CHART_LEFT, (float)CHART_TOP, (float)right, (float)CHART_BOTTOM}};
    chart_plan plan = {.chart = chart, .pen = pen, .right = right, .board = &board};
    double range[2];
    chart_range(chart, 0, range);
    plan.x = lrcsi_axis_make(chart->x_log, range[0], range[1], (right - CHART_LEFT) / 55.0);
    chart_range(chart, 1, range);
    plan.y = lrcsi_axis_make(chart->y_log, range[0], range[1], (CHART_BOTTOM - CHART_TOP) / 26.0);
    chart_ground(&plan);
    chart_data(&plan);
    chart_frame(&plan);
    chart_ticks(&plan);
    chart_names(&plan);
    chart_legend(&plan);
}

/* ---- in public ---- */

void lrcs_host_chart_svg(FILE *out, const lrcs_host_chart *chart)
{
    lrcsi_svg svg = lrcsi_svg_begin(out, CHART_WIDTH, CHART_HEIGHT, chart->title);
    chart_draw(chart, &svg.pen);
    lrcsi_svg_end(&svg);
}

int lrcs_host_chart_png(FILE *out, const lrcs_host_chart *chart, lrcs_host_error *error)
{
    lrcsi_canvas canvas;
    int status = lrcsi_canvas_make(CHART_WIDTH, CHART_HEIGHT, CHART_PIXELS, &canvas, error);
    if (status == LRCS_OK) {
        chart_draw(chart, &canvas.pen);
        status = lrcs_host_png_write(out, canvas.rgb, canvas.width, canvas.height, 3, error);
        lrcsi_canvas_free(&canvas);
    }
    return status;
}
