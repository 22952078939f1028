/* SPDX-License-Identifier: MIT */
/* Convex pieces split and measured: areas by hand, in numbers that doubles hold. */
#include "visibility/clip.h"

#include "check.h"

static lrcsi_clip_polygon triangle(double x, double y)
{
    const double corner[3][2] = {{0, 0}, {x, 0}, {0, y}};
    lrcsi_clip_polygon p;
    lrcsi_clip_triangle(corner, &p);
    check_same(lrcsi_clip_area(&p), x * y / 2);
    return p;
}

static void check_split(double at_x, double at_y, double to_x, double to_y, double left_area,
                        double right_area)
{
    const lrcsi_clip_line line = {{at_x, at_y}, {to_x, to_y}};
    lrcsi_clip_polygon p = triangle(8, 8);
    lrcsi_clip_polygon left;
    lrcsi_clip_polygon right;
    assert_true(lrcsi_clip_split(&p, &line, &left, &right));
    check_same(left.count < 3 ? 0 : lrcsi_clip_area(&left), left_area);
    check_same(right.count < 3 ? 0 : lrcsi_clip_area(&right), right_area);
}

static void a_line_splits_what_it_crosses(void **state)
{
    (void)state;
    check_split(0, 4, 1, 0, 8, 24); /* level, at half the height */
    check_split(4, 9, 0, -1, 8, 24);
    check_split(0, 0, 3, 3, 16, 16); /* through a corner */
    check_split(0, 0, 0, 2, 0, 32);  /* along a side: all of it lies right */
    check_split(9, 0, 0, 1, 32, 0);  /* beyond */
    check_split(8, 0, -1, 1, 32, 0); /* along the hypotenuse */
}

static void halves_share_the_area(void **state)
{
    (void)state;
    lrcsi_clip_polygon p = triangle(8, 4);
    lrcsi_clip_polygon left;
    lrcsi_clip_polygon right;
    lrcsi_clip_line line = lrcsi_clip_halving(&p);
    assert_true(lrcsi_clip_split(&p, &line, &left, &right));
    double a = lrcsi_clip_area(&left);
    double b = lrcsi_clip_area(&right);
    check_same(fmin(a, b), 4); /* beyond x = 4: half of 4 times 2 */
    check_same(fmax(a, b), 12);
}

/* A square whose corners are cut off again and again, by ever less. */
static void a_piece_of_too_many_corners_is_not_split(void **state)
{
    (void)state;
    lrcsi_clip_polygon round = {.count = LRCSI_CLIP_SIDES};
    lrcsi_clip_polygon left;
    lrcsi_clip_polygon right;
    for (uint32_t i = 0; i < LRCSI_CLIP_SIDES; i++) {
        round.corner[i][0] = cos(6.283185307179586 * (i + 0.5) / LRCSI_CLIP_SIDES);
        round.corner[i][1] = sin(6.283185307179586 * (i + 0.5) / LRCSI_CLIP_SIDES);
    }
    const lrcsi_clip_line tip = {{0.9999, 0}, {0, 1}}; /* within the rightmost side's corners */
    round.corner[0][0] = 1.001;
    assert_true(lrcsi_clip_split(&round, &tip, &left, &right) == 0);
    const lrcsi_clip_line middle = {{0, 0}, {0, 1}};
    assert_true(lrcsi_clip_split(&round, &middle, &left, &right));
    assert_true(left.count + right.count == LRCSI_CLIP_SIDES + 4);
}

static int meets(double x0, double y0, double x1, double y1, double width)
{
    lrcsi_clip_polygon p = triangle(8, 8);
    const lrcsi_clip_line segment = {{x0, y0}, {x1 - x0, y1 - y0}};
    return lrcsi_clip_meets(&p, &segment, width);
}

static void a_segment_beside_a_piece_or_short_of_it_does_not_meet_it(void **state)
{
    (void)state;
    assert_true(meets(1, 1, 2, 2, 0));
    assert_true(meets(-1, 4, 9, 4, 0));
    assert_false(meets(-1, -1, 9, 0, 0));
    assert_false(meets(9, 0, 0, 9, 0.25));
    assert_true(meets(9, 0, 0, 9, 0.75)); /* the distance is 1 / sqrt(2) */
    assert_false(meets(-3, 2, -1, 2, 0.5));
    assert_true(meets(-3, 2, -1, 2, 1));
    assert_false(meets(5, 9, 5, 12, 0.5));
}

static void the_middle_knows_how_far_inside_it_lies(void **state)
{
    (void)state;
    double middle[2];
    lrcsi_clip_polygon p = triangle(9, 9);
    lrcsi_clip_middle(&p, middle);
    double clear = lrcsi_clip_clear(&p, middle);
    check_rel(middle[0], 3.0, 1e-15);
    check_rel(middle[1], 3.0, 1e-15);
    assert_true(clear > 1.4 && clear <= 3 / sqrt(2)); /* nearest is the hypotenuse */
    p = triangle(9, 0x1p-40);
    lrcsi_clip_middle(&p, middle);
    assert_true(lrcsi_clip_clear(&p, middle) < 0x1p-40 / 3);
    assert_true(lrcsi_clip_clear(&p, (const double[2]){1, 1}) < 0);
}

/* Two corners that are one but for rounding: the side between them points away from all. */
static void a_side_made_by_rounding_does_not_count(void **state)
{
    (void)state;
    double middle[2];
    lrcsi_clip_polygon p = {.count = 4,
                            .corner = {{0, 0}, {8, 0}, {8 - 0x1p-50, -0x1p-50}, {0, 8}}};
    lrcsi_clip_middle(&p, middle);
    assert_true(lrcsi_clip_clear(&p, middle) > 0.5);
}

static void a_box_shows_its_part_of_a_triangle(void **state)
{
    (void)state;
    const double corner[3][2] = {{0, 0}, {4, 0}, {0, 4}};
    check_same(lrcsi_clip_box_area(corner, (const double[2]){0, 0}), 1);
    check_same(lrcsi_clip_box_area(corner, (const double[2]){1.5, 1.5}), 0.5);
    check_same(lrcsi_clip_box_area(corner, (const double[2]){3, 3}), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_line_splits_what_it_crosses),
        cmocka_unit_test(halves_share_the_area),
        cmocka_unit_test(a_piece_of_too_many_corners_is_not_split),
        cmocka_unit_test(a_segment_beside_a_piece_or_short_of_it_does_not_meet_it),
        cmocka_unit_test(the_middle_knows_how_far_inside_it_lies),
        cmocka_unit_test(a_side_made_by_rounding_does_not_count),
        cmocka_unit_test(a_box_shows_its_part_of_a_triangle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
