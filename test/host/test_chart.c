/* SPDX-License-Identifier: MIT */
/* Charts: labels that cover nothing, and drawings of data of every kind. */
#include "host/chart/canvas.h"
#include "host/chart/label.h"
#include "host/chart/letters.h"

#include <stdlib.h>
#include <string.h>

#include "check.h"

/* What a file holds, as a string the caller frees. */
static char *drawn(FILE *file, size_t *size)
{
    *size = (size_t)ftell(file);
    char *text = calloc(*size + 1, 1);
    rewind(file);
    assert_int_equal(fread(text, 1, *size, file), *size);
    fclose(file);
    return text;
}

static char *svg_of(const lrcs_host_chart *chart)
{
    size_t size;
    FILE *file = tmpfile();
    lrcs_host_chart_svg(file, chart);
    return drawn(file, &size);
}

static unsigned occurrences(const char *text, const char *what)
{
    unsigned count = 0;
    for (; (text = strstr(text, what)) != NULL; text++) {
        count++;
    }
    return count;
}

static lrcs_host_chart chart_of(const lrcs_host_series *series, uint32_t count)
{
    return (lrcs_host_chart){.title = "title",
                             .x_name = "x (ms)",
                             .y_name = "y (1)",
                             .x_log = 1,
                             .y_log = 1,
                             .series = series,
                             .series_count = count};
}

static void labels_cover_nothing(void **state)
{
    (void)state;
    static lrcsi_label_area labels;
    labels = (lrcsi_label_area){.frame = {0.0F, 0.0F, 300.0F, 200.0F}};
    uint32_t seed = 1;
    unsigned placed = 0;
    for (int i = 0; i < 200; i++) {
        seed = seed * 1664525u + 1013904223u;
        lrcsi_plot_point at = {(seed >> 8) % 300, (seed >> 18) % 200};
        lrcsi_label_avoid_point(&labels, at, 4.0);
        if (i % 3 == 0) {
            lrcsi_label_avoid_line(&labels, at, (lrcsi_plot_point){at.x + 20.0, at.y + 9.0});
        }
        uint32_t before = labels.count;
        lrcsi_plot_point left;
        if (!lrcsi_label_place(&labels, at, 6.0, "4096", 10.0, &left)) {
            assert_int_equal(labels.count, before);
            continue;
        }
        placed++;
        const lrcsi_label_box *own = &labels.box[labels.count - 1];
        assert_true(own->x0 >= 0.0F && own->y0 >= 0.0F && own->x1 <= 300.0F && own->y1 <= 200.0F);
        assert_true(left.x > own->x0 && left.y < own->y1);
        for (uint32_t k = 0; k + 1 < labels.count; k++) {
            const lrcsi_label_box *other = &labels.box[k];
            assert_true(own->x0 >= other->x1 || own->x1 <= other->x0 || own->y0 >= other->y1 ||
                        own->y1 <= other->y0);
        }
    }
    assert_true(placed > 10 && placed < 190);
}

static void a_full_board_forgets_and_goes_on(void **state)
{
    (void)state;
    static lrcsi_label_area labels;
    labels = (lrcsi_label_area){.frame = {0.0F, 0.0F, 9.0F, 9.0F}};
    for (uint32_t i = 0; i < LRCSI_LABEL_BOXES + 10; i++) {
        lrcsi_label_avoid_point(&labels, (lrcsi_plot_point){5.0, 5.0}, 1.0);
    }
    assert_int_equal(labels.count, LRCSI_LABEL_BOXES);
}

static void every_letter_has_a_width_and_ends(void **state)
{
    (void)state;
    for (int c = 32; c < 127; c++) {
        const char text[2] = {(char)c, '\0'};
        lrcsi_letters letters = {text, NULL, 0.0};
        lrcsi_plot_point at;
        unsigned spots = 0;
        double width = lrcsi_letters_width(text);
        assert_true(width > 0.2 && width < 1.1);
        while (lrcsi_letters_next(&letters, &at) != LRCSI_LETTERS_END) {
            assert_true(at.x > -0.1 && at.x < width + 0.1 && at.y > -0.5 && at.y < 1.0);
            spots++;
        }
        assert_true(c == ' ' ? spots == 0 : spots > 1);
        check_same(letters.x, width);
    }
}

static void a_letter_the_font_lacks_is_one_question_mark(void **state)
{
    (void)state;
    check_same(lrcsi_letters_width("\xc3\xa9"), lrcsi_letters_width("?"));
    check_same(lrcsi_letters_width("\xe2\x82\xac\n"), lrcsi_letters_width("??"));
}

static void points_an_axis_cannot_show_are_left_out(void **state)
{
    (void)state;
    const double x[] = {1.0, 2.0, 3.0, 4.0, 5.0};
    const double y[] = {1.0, 0.0, (double)NAN, HUGE_VAL, 0.1};
    const lrcs_host_series series = {.name = "s", .count = 5, .x = x, .y = y};
    const lrcs_host_chart chart = chart_of(&series, 1);
    char *svg = svg_of(&chart);
    assert_int_equal(occurrences(svg, "<polygon"), 3); /* two points, one in the legend */
    assert_int_equal(occurrences(svg, "nan") + occurrences(svg, "inf"), 0);
    free(svg);
}

static void what_lies_below_the_floor_has_an_arrow(void **state)
{
    (void)state;
    const double x[] = {1.0, 2.0, 3.0};
    const double y[] = {1.0, 0.0, 1e-9};
    const lrcs_host_series series = {.name = "s", .count = 3, .x = x, .y = y};
    lrcs_host_chart chart = chart_of(&series, 1);
    chart.floor = 1e-6;
    chart.floor_name = "floor";
    char *svg = svg_of(&chart);
    /* band, three points, two arrows; in the legend the point, the band, the arrow */
    assert_int_equal(occurrences(svg, "<polygon"), 1 + 3 + 2 + 3);
    free(svg);
}

/* The coordinates of the i-th polygon of a colour; their number. */
static unsigned polygon_of(const char *svg, const char *colour, unsigned i, double at[16])
{
    char begin[64];
    snprintf(begin, sizeof begin, "<polygon fill=\"%s\" points=\"", colour);
    const char *from = strstr(svg, begin);
    for (; from && i > 0; i--) {
        from = strstr(from + 1, begin);
    }
    if (!from) {
        return 0;
    }
    char *rest = (char *)(uintptr_t)from + strlen(begin);
    unsigned count = 0;
    while (*rest != '"' && count < 16) {
        at[count++] = strtod(rest, &rest);
        rest += *rest == ',' || *rest == ' ';
    }
    return count;
}

static void a_polar_band_lies_between_its_ends(void **state)
{
    (void)state;
    const double x[] = {0.0, 90.0, 180.0};
    const double y[] = {5.0, 5.0, 5.0};
    const double low[] = {4.0, -HUGE_VAL, 4.0};
    const double high[] = {6.0, 8.0, 10.0};
    const lrcs_host_series series = {.name = "s",
                                     .count = 3,
                                     .x = x,
                                     .y = y,
                                     .low = low,
                                     .high = high,
                                     .marker = LRCS_HOST_NO_MARKER};
    lrcs_host_chart chart = chart_of(&series, 1);
    chart.x_log = chart.y_log = 0;
    chart.polar = chart.y_from_0 = 1;
    char *svg = svg_of(&chart);
    double first[16];
    double second[16];
    assert_int_equal(polygon_of(svg, "#bfbfbf", 2, second), 0);
    assert_int_equal(polygon_of(svg, "#bfbfbf", 0, first), 8);
    assert_int_equal(polygon_of(svg, "#bfbfbf", 1, second), 8);
    /* An end that is not finite is at the pole; distances are in proportion, the largest value is
       within the outer ring. */
    const double pole[2] = {first[6], first[7]};
    const double unit = 0.25 * (first[0] - pole[0]);
    const double found[] = {first[1], first[2] - pole[0],  pole[1] - first[5],
                            first[4], pole[0] - second[4], pole[0] - second[6]};
    const double want[] = {pole[1], 6.0 * unit, 8.0 * unit, pole[0], 10.0 * unit, 4.0 * unit};
    for (int i = 0; i < 6; i++) {
        check_abs(found[i], want[i], 0.05);
    }
    assert_true(10.0 * unit < 0.5 * LRCS_HOST_CHART_POLAR_SIDE);
    assert_int_equal(occurrences(svg, "nan") + occurrences(svg, "inf"), 0);
    free(svg);
}

static void points_may_lack_their_line_or_their_markers(void **state)
{
    (void)state;
    const double x[] = {1.0, 2.0, 3.0};
    const double y[] = {1.0, 0.0, 0.1};
    lrcs_host_series series = {.name = "s", .count = 3, .x = x, .y = y};
    lrcs_host_chart chart = chart_of(&series, 1);
    chart.floor = 1e-3;
    char *svg = svg_of(&chart);
    unsigned lines = occurrences(svg, "<polyline");
    unsigned areas = occurrences(svg, "<polygon");
    free(svg);
    series.dash = LRCS_HOST_NO_LINE;
    svg = svg_of(&chart);
    assert_int_equal(occurrences(svg, "<polyline"), lines - 2); /* and the legend's */
    assert_int_equal(occurrences(svg, "<polygon"), areas);
    free(svg);
    series.dash = LRCS_HOST_SOLID;
    series.marker = LRCS_HOST_NO_MARKER;
    svg = svg_of(&chart);
    assert_int_equal(occurrences(svg, "<polygon"), areas - 5); /* three, an arrow, the legend's */
    free(svg);
}

static void words_are_escaped(void **state)
{
    (void)state;
    lrcs_host_chart chart = chart_of(NULL, 0);
    chart.title = "a<b>&c\x01\xc3\xa9";
    chart.note = "broken \xff utf8";
    char *svg = svg_of(&chart);
    assert_non_null(strstr(svg, "<title>a&lt;b&gt;&amp;c?\xc3\xa9</title>"));
    assert_non_null(strstr(svg, ">broken ? utf8</text>"));
    free(svg);
}

static void linear_axes_have_plain_numbers(void **state)
{
    (void)state;
    const double x[] = {1.0, 1234.5};
    const double y[] = {-3.25, 7.5};
    const lrcs_host_series series = {.name = "s", .count = 2, .x = x, .y = y};
    lrcs_host_chart chart = chart_of(&series, 1);
    chart.x_log = chart.y_log = 0;
    char *svg = svg_of(&chart);
    assert_non_null(strstr(svg, ">-2</text>"));
    assert_non_null(strstr(svg, ">1000</text>"));
    free(svg);
}

static void long_series_keep_every_point(void **state)
{
    (void)state;
    static double x[1000];
    for (int i = 0; i < 1000; i++) {
        x[i] = i + 1.0;
    }
    const lrcs_host_series series = {.name = "s", .count = 1000, .x = x, .y = x};
    const lrcs_host_chart chart = chart_of(&series, 1);
    char *svg = svg_of(&chart);
    assert_int_equal(occurrences(svg, "<polygon"), 1001);
    free(svg);
}

static void a_stroke_colours_its_pixels_and_no_others(void **state)
{
    (void)state;
    lrcsi_canvas canvas;
    const lrcsi_plot_point line[2] = {{4.0, 10.0}, {16.0, 10.0}};
    const lrcsi_line_style ink = {0x0072b2u, 2.0, {0.0, 0.0}};
    assert_int_equal(lrcsi_canvas_make(20.0, 20.0, 1.0, &canvas, NULL), LRCS_OK);
    canvas.plotter.line(&canvas.plotter, line, 2, &ink);
    for (int y = 0; y < 20; y++) {
        for (int x = 0; x < 20; x++) {
            const unsigned char *pixel = canvas.rgb + 3 * (20 * y + x);
            int on = x >= 4 && x < 16 && (y == 9 || y == 10);
            int off = x < 2 || x > 17 || y < 8 || y > 11;
            assert_true(!on || (pixel[0] == 0x00 && pixel[1] == 0x72 && pixel[2] == 0xb2));
            assert_true(!off || (pixel[0] == 0xff && pixel[1] == 0xff && pixel[2] == 0xff));
        }
    }
    lrcsi_canvas_free(&canvas);
}

static void an_area_covers_parts_of_pixels(void **state)
{
    (void)state;
    lrcsi_canvas canvas;
    const lrcsi_plot_point corner[4] = {{2.5, 3.25}, {8.0, 3.25}, {8.0, 6.0}, {2.5, 6.0}};
    assert_int_equal(lrcsi_canvas_make(10.0, 10.0, 1.0, &canvas, NULL), LRCS_OK);
    canvas.plotter.area(&canvas.plotter, corner, 4, 0x000000u);
    assert_int_equal(canvas.rgb[3 * (10 * 4 + 4)], 0);   /* inside */
    assert_int_equal(canvas.rgb[3 * (10 * 4 + 2)], 128); /* half */
    assert_int_equal(canvas.rgb[3 * (10 * 3 + 4)], 64);  /* three quarters */
    assert_int_equal(canvas.rgb[3 * (10 * 4 + 1)], 255);
    assert_int_equal(canvas.rgb[3 * (10 * 6 + 4)], 255);
    lrcsi_canvas_free(&canvas);
}

static void nothing_outside_the_canvas_is_touched(void **state)
{
    (void)state;
    lrcsi_canvas canvas;
    const lrcsi_plot_point line[3] = {{-50.0, -50.0}, {60.0, 70.0}, {-1e9, 5.0}};
    const lrcsi_line_style ink = {0u, 3.0, {40.0, 30.0}};
    const lrcsi_plot_text words = {.text = "out of it", .at = {5.0, -2.0}, .size = 30.0};
    assert_int_equal(lrcsi_canvas_make(10.0, 10.0, 1.0, &canvas, NULL), LRCS_OK);
    canvas.plotter.line(&canvas.plotter, line, 2, &ink);
    canvas.plotter.area(&canvas.plotter, line, 3, 0x123456u);
    canvas.plotter.text(&canvas.plotter, &words);
    lrcsi_canvas_free(&canvas);
}

static void the_png_of_an_empty_chart_is_a_png(void **state)
{
    (void)state;
    size_t size;
    lrcs_host_error error;
    const lrcs_host_chart chart = chart_of(NULL, 0);
    FILE *file = tmpfile();
    assert_int_equal(lrcs_host_chart_png(file, &chart, &error), LRCS_OK);
    char *bytes = drawn(file, &size);
    assert_true(size > 1000 && memcmp(bytes, "\x89PNG", 4) == 0);
    free(bytes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(labels_cover_nothing),
        cmocka_unit_test(a_full_board_forgets_and_goes_on),
        cmocka_unit_test(every_letter_has_a_width_and_ends),
        cmocka_unit_test(a_letter_the_font_lacks_is_one_question_mark),
        cmocka_unit_test(points_an_axis_cannot_show_are_left_out),
        cmocka_unit_test(what_lies_below_the_floor_has_an_arrow),
        cmocka_unit_test(a_polar_band_lies_between_its_ends),
        cmocka_unit_test(points_may_lack_their_line_or_their_markers),
        cmocka_unit_test(words_are_escaped),
        cmocka_unit_test(linear_axes_have_plain_numbers),
        cmocka_unit_test(long_series_keep_every_point),
        cmocka_unit_test(a_stroke_colours_its_pixels_and_no_others),
        cmocka_unit_test(an_area_covers_parts_of_pixels),
        cmocka_unit_test(nothing_outside_the_canvas_is_touched),
        cmocka_unit_test(the_png_of_an_empty_chart_is_a_png),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
