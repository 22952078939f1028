/* SPDX-License-Identifier: MIT */
/* Spans against whole numbers: triangles whose corners are eighths of a pixel, so that every edge
   function over a pixel is a multiple of 1 / 128, and 128 times it an integer. */
#include "visibility/raster/span.h"

#include <stdlib.h>

#include "scenes.h"

enum { N = 64 };

/* The edges of a triangle with corners in eighths of a pixel, counter-clockwise. */
static lrcsi_edge_functions edges_of(const int corner[3][2])
{
    lrcsi_edge_functions e = {.value_err = 0x1p-40};
    for (int k = 0; k < 3; k++) {
        const int *a = corner[k];
        const int *b = corner[(k + 1) % 3];
        e.dx[k] = -(b[1] - a[1]) / 8.0;
        e.dy[k] = (b[0] - a[0]) / 8.0;
        e.c[k] = -(e.dx[k] * a[0] + e.dy[k] * a[1]) / 8;
    }
    lrcsi_span_prepare(&e);
    return e;
}

/* 128 times the least over the edges of their values at a pixel's centre, plus `sign` times how
   much each changes over half of the square. */
static long least_of(const int corner[3][2], int whole, int sign, int x, int y)
{
    long least = 1L << 30;
    for (int k = 0; k < 3; k++) {
        const int *a = corner[k];
        const int *b = corner[(k + 1) % 3];
        long dx = b[0] - a[0];
        long dy = b[1] - a[1];
        long value = dx * (8L * y + 4 - a[1]) - dy * (8L * x + 4 - a[0]);
        long bend = whole ? 4 * (labs(dx) + labs(dy)) : 0;
        value = 2 * (value + sign * bend);
        least = value < least ? value : least;
    }
    return least;
}

/* Triangles of all kinds: large ones, and slivers whose corners lie in a row but for an eighth. */
static void triangle_of(uint64_t *seed, int sliver, int corner[3][2])
{
    long turn = 0;
    while (turn == 0) {
        for (int k = 0; k < 3; k++) {
            corner[k][0] = (int)random_below(seed, 8 * N + 1);
            corner[k][1] = (int)random_below(seed, 8 * N + 1);
        }
        if (sliver) {
            corner[2][0] = (corner[0][0] + corner[1][0]) / 2 + (int)random_below(seed, 2);
            corner[2][1] = (corner[0][1] + corner[1][1]) / 2 + (int)random_below(seed, 2);
        }
        turn = (long)(corner[1][0] - corner[0][0]) * (corner[2][1] - corner[0][1]) -
               (long)(corner[1][1] - corner[0][1]) * (corner[2][0] - corner[0][0]);
    }
    for (int i = 0; i < 2 && turn < 0; i++) {
        int swap = corner[1][i];
        corner[1][i] = corner[2][i];
        corner[2][i] = swap;
    }
}

/* A row of pixels; what is covered is looked for from x0 to x1, what is touched a pixel farther.
   Returns how many are touched. */
static unsigned check_row(const int corner[3][2], int y, int x0, int x1)
{
    lrcsi_edge_functions e = edges_of(corner);
    e.x0 = (uint32_t)x0;
    e.x1 = (uint32_t)x1;
    e.left = (uint32_t)(x0 > 0 ? x0 - 1 : 0);
    e.right = (uint32_t)(x1 < N ? x1 + 1 : N);
    lrcsi_pixel_span touched = lrcsi_span_touched(&e, (uint32_t)y);
    lrcsi_sample_spans samples = lrcsi_span_samples(&e, (uint32_t)y);
    lrcsi_pixel_span full = lrcsi_span_full(&e, (uint32_t)y, samples.certain);
    for (uint32_t x = 0; x < N; x++) {
        int among = x >= e.x0 && x < e.x1;
        int about = x >= e.left && x < e.right;
        assert_int_equal(lrcsi_span_has(touched, x),
                         about && least_of(corner, 1, 1, (int)x, y) >= 0);
        assert_int_equal(lrcsi_span_has(samples.possible, x),
                         among && least_of(corner, 0, 1, (int)x, y) >= 0);
        assert_int_equal(lrcsi_span_has(samples.certain, x),
                         among && least_of(corner, 0, -1, (int)x, y) > 0);
        assert_int_equal(lrcsi_span_has(full, x), among && least_of(corner, 1, -1, (int)x, y) > 0);
    }
    assert_true(samples.possible.x0 <= samples.certain.x0 &&
                samples.certain.x1 <= samples.possible.x1);
    return touched.x1 - touched.x0;
}

/* It may be wider than they need, since sides may meet between the rows; often it is not. */
static void a_range_for_several_rows_holds_what_each_of_them_touches(void **state)
{
    (void)state;
    uint64_t seed = 11;
    unsigned tight = 0;
    for (int i = 0; i < 2000; i++) {
        int corner[3][2];
        triangle_of(&seed, i % 2, corner);
        if (i % 5 == 0) { /* a side along the rows */
            corner[1][1] = corner[0][1];
        }
        lrcsi_edge_functions e = edges_of((const int(*)[2])corner);
        e.right = N;
        uint32_t y0 = random_below(&seed, N);
        uint32_t y1 = y0 + random_below(&seed, N - y0);
        lrcsi_pixel_span all = lrcsi_span_touched_rows(&e, y0, y1);
        uint32_t low = N;
        uint32_t high = 0;
        for (uint32_t y = y0; y <= y1; y++) {
            lrcsi_pixel_span row = lrcsi_span_touched(&e, y);
            if (row.x0 < row.x1) {
                assert_true(row.x0 >= all.x0 && row.x1 <= all.x1);
                low = row.x0 < low ? row.x0 : low;
                high = row.x1 > high ? row.x1 : high;
            }
        }
        tight += low < high && low == all.x0 && high == all.x1;
    }
    assert_true(tight > 500);
}

static void spans_are_those_of_whole_numbers(void **state)
{
    (void)state;
    uint64_t seed = 5;
    unsigned found = 0;
    for (int i = 0; i < 400; i++) {
        int corner[3][2];
        triangle_of(&seed, i % 2, corner);
        for (int y = 0; y < N; y++) {
            int x0 = (int)random_below(&seed, 4) == 0 ? (int)random_below(&seed, N) : 0;
            int x1 = x0 + (int)random_below(&seed, (uint32_t)(N - x0 + 1));
            found += check_row((const int(*)[2])corner, y, x0, x1);
        }
    }
    assert_true(found > 10000);
}

static void sides_along_the_rows_are_decided_for_the_whole_row(void **state)
{
    (void)state;
    static const int flat[3][2] = {{0, 80}, {512, 80}, {256, 400}};
    static const int through[3][2] = {{0, 84}, {512, 84}, {256, 404}}; /* a side through centres */
    static const int upright[3][2] = {{80, 0}, {400, 256}, {80, 512}};
    for (int y = 0; y < N; y++) {
        check_row(flat, y, 0, N);
        check_row(through, y, 0, N);
        check_row(upright, y, 0, N);
    }
}

/* What an error leaves open is possible and not certain. */
static void what_is_within_the_error_is_not_sure(void **state)
{
    (void)state;
    static const int corner[3][2] = {{84, 0}, {500, 256}, {84, 512}}; /* a side through centres */
    lrcsi_edge_functions e = edges_of(corner);
    e.x1 = e.right = N;
    for (uint32_t y = 10; y < 50; y++) {
        lrcsi_sample_spans samples = lrcsi_span_samples(&e, y);
        assert_int_equal(samples.possible.x0, 10);
        assert_int_equal(samples.certain.x0, 11);
        assert_int_equal(lrcsi_span_touched(&e, y).x0, 10);
        assert_int_equal(lrcsi_span_full(&e, y, samples.certain).x0, 11);
    }
}

/* Does a segment with ends in eighths of a pixel meet a pixel, the sides of which belong to it? The
   line meets it where its corners do not all lie on one side. */
static int meets(const int a[2], const int b[2], int x, int y)
{
    const int low[2] = {8 * x, 8 * y};
    int left = 0;
    int right = 0;
    for (int k = 0; k < 2; k++) {
        if ((a[k] < low[k] && b[k] < low[k]) || (a[k] > low[k] + 8 && b[k] > low[k] + 8)) {
            return 0;
        }
    }
    for (int k = 0; k < 4; k++) {
        long turn = (long)(b[0] - a[0]) * (low[1] + 8 * (k / 2) - a[1]) -
                    (long)(b[1] - a[1]) * (low[0] + 8 * (k % 2) - a[0]);
        left |= turn >= 0;
        right |= turn <= 0;
    }
    return left && right;
}

/* In all rows, of segments that may leave the window; level, upright and short
   ones are among them. Returns how many pixels are met. */
static unsigned check_segment(const int a[2], const int b[2])
{
    const double from[2] = {a[0] / 8.0, a[1] / 8.0};
    const double to[2] = {b[0] / 8.0, b[1] / 8.0};
    lrcsi_pixel_segment s = lrcsi_span_segment(from, to, 0x1p-40);
    unsigned met = 0;
    int bottom = a[1] < b[1] ? a[1] : b[1];
    int top = a[1] > b[1] ? a[1] : b[1];
    for (int y = 0; y < N; y++) {
        if (8 * y + 8 < bottom || 8 * y > top) {
            continue; /* the rows are the caller's to choose */
        }
        uint32_t x0 = 3;
        uint32_t x1 = N - 2;
        lrcsi_span_follow(&s, (uint32_t)y, &x0, &x1);
        for (int x = 3; x < N - 2; x++) {
            int inside = (uint32_t)x >= x0 && (uint32_t)x < x1;
            assert_int_equal(inside, meets(a, b, x, y));
            met += (unsigned)inside;
        }
    }
    return met;
}

static void segments_are_followed_through_the_pixels_they_meet(void **state)
{
    (void)state;
    uint64_t seed = 9;
    unsigned met = 0;
    for (int i = 0; i < 4000; i++) {
        int a[2];
        int b[2];
        for (int k = 0; k < 2; k++) {
            a[k] = (int)random_below(&seed, 8 * N + 64) - 32;
            b[k] = i % 4 == 0 ? a[k] + (int)random_below(&seed, 17) - 8
                              : (int)random_below(&seed, 8 * N + 64) - 32;
        }
        b[1] = i % 4 == 1 ? a[1] : b[1];
        b[0] = i % 4 == 2 ? a[0] : b[0];
        met += check_segment(a, b);
    }
    assert_true(met > 50000);
}

/* A segment clipped to a triangle keeps all points inside it, and hardly more; at a distance of err
   it keeps those as near. */
static void clipped_segments_keep_what_lies_in_the_triangle(void **state)
{
    (void)state;
    uint64_t seed = 21;
    unsigned inside = 0;
    unsigned nothing = 0;
    for (int i = 0; i < 4000; i++) {
        int corner[3][2];
        double a[2];
        double b[2];
        double t[2];
        triangle_of(&seed, i % 2, corner);
        for (int k = 0; k < 2; k++) {
            a[k] = (int)random_below(&seed, 16 * N) / 8.0 - N / 2.0;
            b[k] = (int)random_below(&seed, 16 * N) / 8.0 - N / 2.0;
        }
        const double err = i % 4 < 2 ? 0 : 0.125;
        const lrcsi_edge_functions e = edges_of((const int(*)[2])corner);
        int remains = lrcsi_span_clip(&e, a, b, err, t);
        nothing += remains == 0;
        for (int n = 0; n <= 64; n++) {
            double part = n / 64.0;
            double least = HUGE_VAL; /* the least value, plus what `err` allows */
            for (int k = 0; k < 3; k++) {
                double value = e.c[k] + e.dx[k] * (a[0] + part * (b[0] - a[0])) +
                               e.dy[k] * (a[1] + part * (b[1] - a[1])) +
                               err * (fabs(e.dx[k]) + fabs(e.dy[k]));
                least = value < least ? value : least;
            }
            int kept = remains && part >= t[0] - 1e-12 && part <= t[1] + 1e-12;
            assert_true(kept || least < 1e-9);
            assert_true(!kept || least > -1e-9);
            inside += kept ? 1 : 0;
        }
    }
    assert_true(inside > 4000 && nothing > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spans_are_those_of_whole_numbers),
        cmocka_unit_test(a_range_for_several_rows_holds_what_each_of_them_touches),
        cmocka_unit_test(sides_along_the_rows_are_decided_for_the_whole_row),
        cmocka_unit_test(what_is_within_the_error_is_not_sure),
        cmocka_unit_test(segments_are_followed_through_the_pixels_they_meet),
        cmocka_unit_test(clipped_segments_keep_what_lies_in_the_triangle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
