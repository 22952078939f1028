/* SPDX-License-Identifier: MIT */
/* Lines, convex areas and text as pixels. It decides how much of each pixel a stroke covers. The
   coverage of a whole stroke is accumulated before it is coloured, so that it does not become
   darker where it overlaps itself. */
#include "host/chart/canvas.h"

#include "host/chart/letters.h"
#include "host/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define CANVAS_SLICES     4   /* of a pixel's height, in areas */
#define STROKE_POINTS_MAX 64  /* points of a stroke: the font's longest has 44 */
#define STROKE_SEGMENTS   5   /* straight segments from point to point */
#define STROKE_CORNER     0.6 /* cosine: strokes that turn more have a corner there */

static uint32_t canvas_clamp(double value, uint32_t high)
{
    return value <= 0.0 ? 0 : value >= high ? high : (uint32_t)value;
}

/* Extends the box of the stroke by `bounds`: x0, y0, x1, y1 in pixels. Returned: the part of these
   bounds that is on the canvas. */
static void canvas_extend(lrcsi_canvas *canvas, const double bounds[4], uint32_t range[4])
{
    uint32_t *box = canvas->box;
    range[0] = canvas_clamp(floor(bounds[0]), canvas->width);
    range[1] = canvas_clamp(floor(bounds[1]), canvas->height);
    range[2] = canvas_clamp(ceil(bounds[2]), canvas->width);
    range[3] = canvas_clamp(ceil(bounds[3]), canvas->height);
    for (int k = 0; k < 2; k++) {
        box[k] = range[k] < box[k] ? range[k] : box[k];
        box[k + 2] = range[k + 2] > box[k + 2] ? range[k + 2] : box[k + 2];
    }
}

/* Blends the colour into the pixels that the stroke covers, and clears the coverage. */
static void canvas_composite(lrcsi_canvas *canvas, uint32_t colour)
{
    const double rgb[3] = {(double)(colour >> 16 & 255u), (double)(colour >> 8 & 255u),
                           (double)(colour & 255u)};
    uint32_t *box = canvas->box;
    for (uint32_t y = box[1]; y < box[3]; y++) {
        for (uint32_t x = box[0]; x < box[2]; x++) {
            size_t at = (size_t)y * canvas->width + x;
            double cover = fmin((double)canvas->cover[at], 1.0);
            unsigned char *pixel = canvas->rgb + 3 * at;
            for (int k = 0; cover > 0.0 && k < 3; k++) {
                pixel[k] = (unsigned char)(pixel[k] + cover * (rgb[k] - pixel[k]) + 0.5);
            }
            canvas->cover[at] = 0.0f;
        }
    }
    box[0] = canvas->width;
    box[1] = canvas->height;
    box[2] = box[3] = 0;
}

/* A segment of a line, in pixels, with round ends. The coverage of a pixel follows from the
   distance of its centre. */
static void canvas_segment(lrcsi_canvas *canvas, lrcsi_plot_point a, lrcsi_plot_point b,
                           double half)
{
    const double bounds[4] = {fmin(a.x, b.x) - half - 1.0, fmin(a.y, b.y) - half - 1.0,
                              fmax(a.x, b.x) + half + 1.0, fmax(a.y, b.y) + half + 1.0};
    double dx = b.x - a.x;
    double dy = b.y - a.y;
    double square = dx * dx + dy * dy;
    uint32_t range[4];
    canvas_extend(canvas, bounds, range);
    for (uint32_t y = range[1]; y < range[3]; y++) {
        for (uint32_t x = range[0]; x < range[2]; x++) {
            double px = x + 0.5 - a.x;
            double py = y + 0.5 - a.y;
            double along = square > 0.0 ? (px * dx + py * dy) / square : 0.0;
            along = fmin(fmax(along, 0.0), 1.0);
            double away = hypot(px - along * dx, py - along * dy);
            float *cover = &canvas->cover[(size_t)y * canvas->width + x];
            *cover = fmaxf(*cover, (float)fmin(fmax(half + 0.5 - away, 0.0), 2.0 * half));
        }
    }
}

/* A segment of a line, dashed: `offset` is the length of the line before it. */
static void canvas_dashes(lrcsi_canvas *canvas, lrcsi_plot_point a, lrcsi_plot_point b,
                          const lrcsi_line_style *style, double offset)
{
    double half = 0.5 * style->width * canvas->scale;
    double length = hypot(b.x - a.x, b.y - a.y);
    double on = style->dash[0] * canvas->scale;
    double period = on + style->dash[1] * canvas->scale;
    if (!(on > 0.0) || !(length > 0.0)) {
        canvas_segment(canvas, a, b, half);
        return;
    }
    for (double from = -fmod(offset, period); from < length; from += period) {
        double begin = fmax(from, 0.0) / length;
        double end = fmin(from + on, length) / length;
        if (end > begin) {
            canvas_segment(
                canvas, (lrcsi_plot_point){a.x + begin * (b.x - a.x), a.y + begin * (b.y - a.y)},
                (lrcsi_plot_point){a.x + end * (b.x - a.x), a.y + end * (b.y - a.y)}, half);
        }
    }
}

static void canvas_line(lrcsi_plotter *plotter, const lrcsi_plot_point *point, uint32_t count,
                        const lrcsi_line_style *style)
{
    lrcsi_canvas *canvas = (lrcsi_canvas *)plotter;
    double offset = 0.0;
    for (uint32_t i = 0; i + 1 < count; i++) {
        lrcsi_plot_point a = {point[i].x * canvas->scale, point[i].y * canvas->scale};
        lrcsi_plot_point b = {point[i + 1].x * canvas->scale, point[i + 1].y * canvas->scale};
        canvas_dashes(canvas, a, b, style, offset);
        offset += hypot(b.x - a.x, b.y - a.y);
    }
    canvas_composite(canvas, style->colour);
}

/* The part of the horizontal line at y, in pixels, inside a convex polygon: span[0] to span[1]. */
static void area_span(const lrcsi_plot_point *point, uint32_t count, double scale, double y,
                      double span[2])
{
    span[0] = HUGE_VAL;
    span[1] = -HUGE_VAL;
    for (uint32_t i = 0; i < count; i++) {
        const lrcsi_plot_point *a = &point[i];
        const lrcsi_plot_point *b = &point[(i + 1) % count];
        double ay = a->y * scale - y;
        double by = b->y * scale - y;
        if ((ay < 0.0) != (by < 0.0)) {
            double x = scale * (a->x + (b->x - a->x) * ay / (ay - by));
            span[0] = fmin(span[0], x);
            span[1] = fmax(span[1], x);
        }
    }
}

static void canvas_area(lrcsi_plotter *plotter, const lrcsi_plot_point *point, uint32_t count,
                        uint32_t colour)
{
    lrcsi_canvas *canvas = (lrcsi_canvas *)plotter;
    double bounds[4] = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    uint32_t range[4];
    for (uint32_t i = 0; i < count; i++) {
        bounds[0] = fmin(bounds[0], point[i].x * canvas->scale);
        bounds[1] = fmin(bounds[1], point[i].y * canvas->scale);
        bounds[2] = fmax(bounds[2], point[i].x * canvas->scale);
        bounds[3] = fmax(bounds[3], point[i].y * canvas->scale);
    }
    canvas_extend(canvas, bounds, range);
    for (uint32_t i = range[1] * CANVAS_SLICES; i < range[3] * CANVAS_SLICES; i++) {
        double span[2];
        float *row = canvas->cover + (size_t)(i / CANVAS_SLICES) * canvas->width;
        area_span(point, count, canvas->scale, (i + 0.5) / CANVAS_SLICES, span);
        for (uint32_t x = range[0]; x < range[2]; x++) {
            double in = fmin(span[1], x + 1.0) - fmax(span[0], x);
            row[x] += (float)(fmax(in, 0.0) / CANVAS_SLICES);
        }
    }
    canvas_composite(canvas, colour);
}

/* The direction in which a curve through three points passes the middle one, times a length; zero
   if they form a corner. */
static lrcsi_plot_point stroke_tangent(lrcsi_plot_point a, lrcsi_plot_point b, lrcsi_plot_point c)
{
    double in = hypot(b.x - a.x, b.y - a.y);
    double out = hypot(c.x - b.x, c.y - b.y);
    double cosine = ((b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y)) / (in * out);
    if (!(cosine > STROKE_CORNER)) {
        return (lrcsi_plot_point){0.0, 0.0};
    }
    /* of the parabola through them, over lengths of chords */
    return (lrcsi_plot_point){((b.x - a.x) * out / in + (c.x - b.x) * in / out) / (in + out),
                              ((b.y - a.y) * out / in + (c.y - b.y) * in / out) / (in + out)};
}

/* A stroke of a letter: the font gives points on a curve, which cubics join where they turn little,
   and corners, which stay corners. A straight segment between two corners stays straight. */
static void canvas_stroke(lrcsi_canvas *canvas, const lrcsi_plot_point *point, uint32_t count,
                          double half)
{
    int closed = count > 3 && point[0].x == point[count - 1].x && point[0].y == point[count - 1].y;
    for (uint32_t i = 0; i + 1 < count; i++) {
        lrcsi_plot_point a = point[i];
        lrcsi_plot_point b = point[i + 1];
        lrcsi_plot_point before = i > 0 ? point[i - 1] : closed ? point[count - 2] : a;
        lrcsi_plot_point after = i + 2 < count ? point[i + 2] : closed ? point[1] : b;
        double chord = hypot(b.x - a.x, b.y - a.y);
        lrcsi_plot_point ta = stroke_tangent(before, a, b);
        lrcsi_plot_point tb = stroke_tangent(a, b, after);
        /* if only one end is on a curve, the curvature at the other end is zero */
        if (ta.x == 0.0 && ta.y == 0.0) {
            ta = (lrcsi_plot_point){1.5 * (b.x - a.x) / chord - 0.5 * tb.x,
                                    1.5 * (b.y - a.y) / chord - 0.5 * tb.y};
        }
        if (tb.x == 0.0 && tb.y == 0.0) {
            tb = (lrcsi_plot_point){1.5 * (b.x - a.x) / chord - 0.5 * ta.x,
                                    1.5 * (b.y - a.y) / chord - 0.5 * ta.y};
        }
        lrcsi_plot_point last = a;
        for (int k = 1; k <= STROKE_SEGMENTS && chord > 0.0; k++) {
            double t = (double)k / STROKE_SEGMENTS;
            double fa = t * (1.0 - t) * (1.0 - t) * chord; /* Hermite's cubics */
            double fb = t * t * (t - 1.0) * chord;
            double to = t * t * (3.0 - 2.0 * t);
            lrcsi_plot_point next = {a.x + to * (b.x - a.x) + fa * ta.x + fb * tb.x,
                                     a.y + to * (b.y - a.y) + fa * ta.y + fb * tb.y};
            canvas_segment(canvas, last, next, half);
            last = next;
        }
    }
}

/* Draws a text from a point on the base line, in pixels. */
static void canvas_letters(lrcsi_canvas *canvas, const char *text, lrcsi_plot_point from,
                           double size, int upwards, double half)
{
    lrcsi_letters letters = {text, NULL, 0.0};
    lrcsi_plot_point stroke[STROKE_POINTS_MAX];
    lrcsi_plot_point at;
    uint32_t count = 0;
    for (int move; (move = lrcsi_letters_next(&letters, &at)) != LRCSI_LETTERS_END;) {
        if (move == LRCSI_LETTERS_JUMP || count == STROKE_POINTS_MAX) {
            canvas_stroke(canvas, stroke, count, half);
            stroke[0] = count == STROKE_POINTS_MAX ? stroke[count - 1] : stroke[0];
            count = count == STROKE_POINTS_MAX && move == LRCSI_LETTERS_DRAW ? 1 : 0;
        }
        stroke[count++] = (lrcsi_plot_point){from.x + size * (upwards ? -at.y : at.x),
                                             from.y - size * (upwards ? at.x : at.y)};
    }
    canvas_stroke(canvas, stroke, count, half);
}

static void canvas_text(lrcsi_plotter *plotter, const lrcsi_plot_text *label)
{
    lrcsi_canvas *canvas = (lrcsi_canvas *)plotter;
    double size = label->size * canvas->scale;
    double half = size * (label->bold ? 0.062 : 0.041);
    double width = size * lrcsi_letters_width(label->text);
    double raised = label->raised ? 0.75 * size * lrcsi_letters_width(label->raised) : 0.0;
    double back = 0.5 * label->anchor * (width + raised);
    lrcsi_plot_point from = {label->at.x * canvas->scale, label->at.y * canvas->scale};
    from.x -= label->upwards ? 0.0 : back;
    from.y += label->upwards ? back : 0.0;
    canvas_letters(canvas, label->text, from, size, label->upwards, half);
    if (label->raised) {
        from.x += label->upwards ? -0.4 * size : width;
        from.y -= label->upwards ? width : 0.4 * size;
        canvas_letters(canvas, label->raised, from, 0.75 * size, label->upwards, half);
    }
    canvas_composite(canvas, label->colour);
}

int lrcsi_canvas_make(double width, double height, double scale, lrcsi_canvas *canvas,
                      lrcs_host_error *error)
{
    lrcsi_canvas made = {.plotter = {canvas_line, canvas_area, canvas_text}, .scale = scale};
    made.width = (uint32_t)lround(width * scale);
    made.height = (uint32_t)lround(height * scale);
    made.box[0] = made.width;
    made.box[1] = made.height;
    size_t pixels = (size_t)made.width * made.height;
    made.rgb = malloc(3 * pixels);
    made.cover = calloc(pixels, sizeof *made.cover);
    if (!made.rgb || !made.cover) {
        lrcsi_canvas_free(&made);
        return lrcsi_host_fail_memory(error, 7 * pixels);
    }
    memset(made.rgb, 0xff, 3 * pixels);
    *canvas = made;
    return LRCS_OK;
}

void lrcsi_canvas_free(lrcsi_canvas *canvas)
{
    free(canvas->rgb);
    free(canvas->cover);
    canvas->rgb = NULL;
    canvas->cover = NULL;
}

int lrcsi_canvas_end(lrcsi_canvas *canvas, FILE *out, const char *about, lrcs_host_error *error)
{
    int status =
        lrcs_host_png_write(out, canvas->rgb, canvas->width, canvas->height, 3, about, error);
    lrcsi_canvas_free(canvas);
    return status;
}
