/* SPDX-License-Identifier: MIT */
/* Cutting convex regions out of convex pieces: areas by hand, in numbers that doubles hold. */
#include "visibility/clip.h"

#include "check.h"

static unsigned char memory[1u << 20];
static lrcsi_clip clip;

static void start_triangle(double size)
{
    const double corner[3][2] = {{0, 0}, {size, 0}, {0, size}};
    lrcsi_clip_polygon polygon;
    lrcs_work work = lrcs_work_make(memory, sizeof memory);
    size_t need = lrcsi_clip_need();
    assert_int_equal(lrcsi_clip_make(&work, &clip), 0);
    assert_true(work.used <= need);
    lrcsi_clip_triangle(corner, &polygon);
    check_same(lrcsi_clip_polygon_area(&polygon), size * size / 2);
    lrcsi_clip_start(&clip, &polygon);
}

/* The rectangle x0 .. x1, y0 .. y1. */
static lrcsi_clip_region rectangle(double x0, double x1, double y0, double y1)
{
    const double corner[5][2] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}};
    lrcsi_clip_region r = {.lines = 4, .low = {x0, y0}, .high = {x1, y1}};
    for (int k = 0; k < 4; k++) {
        for (int i = 0; i < 2; i++) {
            r.line[k].at[i] = corner[k][i];
            r.line[k].to[i] = corner[k + 1][i] - corner[k][i];
        }
    }
    return r;
}

static void take(double x0, double x1, double y0, double y1)
{
    lrcsi_clip_region r = rectangle(x0, x1, y0, y1);
    assert_true(lrcsi_clip_subtract(&clip, &r));
}

static void window_in_the_middle_is_cut_out(void **state)
{
    (void)state;
    start_triangle(8);
    take(1, 3, 1, 2);
    check_same(lrcsi_clip_area(&clip), 30);
    take(1, 3, 1, 2); /* again: nothing left there */
    check_same(lrcsi_clip_area(&clip), 30);
    take(2, 4, 1.5, 3); /* overlaps the first by 1/2 */
    check_same(lrcsi_clip_area(&clip), 27.5);
    take(3, 8, 4, 8); /* crosses the hypotenuse: the triangle (3,4) (4,4) (3,5) */
    check_same(lrcsi_clip_area(&clip), 27);
}

static void regions_that_only_touch_take_nothing(void **state)
{
    (void)state;
    start_triangle(8);
    take(-4, 0, 0, 8); /* along a side */
    take(4, 8, 4, 8);  /* at a point of the hypotenuse */
    take(-1, 9, -2, 0);
    take(8, 9, -1, 1); /* at a corner */
    check_same(lrcsi_clip_area(&clip), 32);
    assert_int_equal(clip.list.pieces, 1);
}

static void region_around_all_leaves_nothing(void **state)
{
    (void)state;
    start_triangle(8);
    take(1, 2, 1, 2);
    take(0, 8, 0, 8);
    check_same(lrcsi_clip_area(&clip), 0);
    assert_int_equal(clip.list.pieces, 0);
    take(0, 1, 0, 1);
    assert_int_equal(clip.list.pieces, 0);
}

static void overlap_tells_apart_and_covered(void **state)
{
    (void)state;
    const double corner[3][2] = {{0, 0}, {8, 0}, {0, 8}};
    lrcsi_clip_polygon p;
    lrcsi_clip_triangle(corner, &p);
    lrcsi_clip_region r = rectangle(0, 8, 0, 8);
    assert_int_equal(lrcsi_clip_overlap(&p, &r), LRCSI_CLIP_COVERED);
    r = rectangle(0, 8, 0, 7.75);
    assert_int_equal(lrcsi_clip_overlap(&p, &r), LRCSI_CLIP_SOME);
    r = rectangle(8, 9, -1, 1);
    assert_int_equal(lrcsi_clip_overlap(&p, &r), LRCSI_CLIP_NONE);
    r = rectangle(-1, 0, -1, 9);
    assert_int_equal(lrcsi_clip_overlap(&p, &r), LRCSI_CLIP_NONE);
    r = rectangle(5, 8, 5, 8); /* beyond the hypotenuse: no line of the region tells */
    assert_true(lrcsi_clip_overlap(&p, &r) != LRCSI_CLIP_COVERED);
}

static void halves_share_the_area(void **state)
{
    (void)state;
    const double corner[3][2] = {{0, 0}, {8, 0}, {0, 4}};
    lrcsi_clip_polygon p;
    lrcsi_clip_polygon left;
    lrcsi_clip_polygon right;
    lrcsi_clip_triangle(corner, &p);
    lrcsi_clip_halve(&p, &left, &right);
    double a = lrcsi_clip_polygon_area(&left);
    double b = lrcsi_clip_polygon_area(&right);
    check_same(fmin(a, b), 4); /* beyond x = 4: half of 4 times 2 */
    check_same(fmax(a, b), 12);
}

/* Windows in a row cut the triangle into ever more pieces; when the lists are full nothing is taken
   any more, and what was stays. */
static void full_lists_refuse_and_keep_what_they_hold(void **state)
{
    (void)state;
    start_triangle(8192);
    int fits = 1;
    double taken = 0;
    uint32_t windows = 0;
    for (; fits && windows < 4000; windows++) {
        double x = 1 + (windows % 60) * 64;
        double y = 1 + (windows / 60) * 64;
        lrcsi_clip_region r = rectangle(x, x + 32, y, y + 32);
        double before = lrcsi_clip_area(&clip);
        fits = lrcsi_clip_subtract(&clip, &r);
        taken += fits ? 1024 : 0;
        check_same(lrcsi_clip_area(&clip), fits ? before - 1024 : before);
    }
    assert_false(fits);
    assert_true(windows > 50);
    check_same(lrcsi_clip_area(&clip), 8192.0 * 4096 - taken);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(window_in_the_middle_is_cut_out),
        cmocka_unit_test(regions_that_only_touch_take_nothing),
        cmocka_unit_test(region_around_all_leaves_nothing),
        cmocka_unit_test(overlap_tells_apart_and_covered),
        cmocka_unit_test(halves_share_the_area),
        cmocka_unit_test(full_lists_refuse_and_keep_what_they_hold),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
