/* SPDX-License-Identifier: MIT */
/* Convex pieces split and measured: areas by hand, in numbers that doubles hold. */
#include "visibility/base/clip.h"

#include <math.h>

#include "scenes.h"

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
    const double from[2] = {at_x, at_y};
    const double to[2] = {at_x + to_x, at_y + to_y};
    double line[3];
    lrcsi_clip_polygon p = triangle(8, 8);
    lrcsi_clip_polygon left;
    lrcsi_clip_polygon right;
    lrcsi_line_through(from, to, line);
    lrcsi_clip_divide(&p, line, &left, &right);
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

static void both_parts_have_the_corners_of_the_cut(void **state)
{
    (void)state;
    enum { SIDES = LRCSI_CLIP_MAX_SIDES - 2 };
    lrcsi_clip_polygon round = {.count = SIDES};
    lrcsi_clip_polygon left;
    lrcsi_clip_polygon right;
    for (uint32_t i = 0; i < SIDES; i++) {
        round.corner[i][0] = cos(6.283185307179586 * (i + 0.5) / SIDES);
        round.corner[i][1] = sin(6.283185307179586 * (i + 0.5) / SIDES);
    }
    const double middle[3] = {1, 0, -0.01};
    lrcsi_clip_divide(&round, middle, &left, &right);
    assert_true(left.count + right.count == SIDES + 4);
}

/* Of n corners on one side of a line that side has n, which there must be room for. */
static void a_polygon_with_too_many_corners_is_refused_on_either_side(void **state)
{
    (void)state;
    lrcsi_clip_polygon left;
    lrcsi_clip_polygon right;
    for (uint32_t sides = LRCSI_CLIP_MAX_SIDES - 1; sides <= LRCSI_CLIP_MAX_SIDES; sides++) {
        lrcsi_clip_polygon round = {.count = sides};
        for (uint32_t i = 0; i < sides; i++) {
            round.corner[i][0] = cos(6.283185307179586 * i / sides);
            round.corner[i][1] = sin(6.283185307179586 * i / sides);
        }
        for (int sign = -1; sign < 2; sign += 2) {
            const double beside[3] = {0, 0, 2 * sign};
            double err = lrcsi_clip_divide(&round, beside, &left, &right);
            check_same(err, sides < LRCSI_CLIP_MAX_SIDES ? 0 : -1);
            assert_int_equal(sides < LRCSI_CLIP_MAX_SIDES ? (sign > 0 ? left : right).count : sides,
                             sides);
        }
    }
}

static void a_box_shows_its_part_of_a_triangle(void **state)
{
    (void)state;
    const double corner[3][2] = {{0, 0}, {4, 0}, {0, 4}};
    check_same(lrcsi_clip_box_area(corner, (const double[2]){0, 0}), 1);
    check_same(lrcsi_clip_box_area(corner, (const double[2]){1.5, 1.5}), 0.5);
    check_same(lrcsi_clip_box_area(corner, (const double[2]){3, 3}), 0);
}

/* The same, by cutting along the sides of the square. */
static double area_cut(const double corner[3][2], const double low[2])
{
    const double side[4][3] = {
        {0, 1, -low[1]}, {-1, 0, low[0] + 1}, {0, -1, low[1] + 1}, {1, 0, -low[0]}};
    lrcsi_clip_polygon inside;
    lrcsi_clip_polygon left;
    lrcsi_clip_polygon right;
    lrcsi_clip_triangle(corner, &inside);
    for (int k = 0; k < 4; k++) {
        lrcsi_clip_divide(&inside, side[k], &left, &right);
        if (left.count < 3) {
            return 0;
        }
        inside = left;
    }
    return lrcsi_clip_area(&inside);
}

/* Triangles of all shapes over 16 x 16 pixels: corners anywhere, on the lattice, and slivers, level
   and upright ones among them. What is allowed is what clip.h states, twice. */
static void parts_are_those_of_cutting_and_add_up(void **state)
{
    (void)state;
    uint64_t seed = 5;
    unsigned shown = 0;
    for (int i = 0; i < 3000; i++) {
        double corner[3][2];
        for (int k = 0; k < 6; k++) {
            double x = (double)random_below(&seed, 16 << 20) / (1 << 20);
            corner[k / 2][k % 2] = i % 3 == 1 ? floor(x) : x;
        }
        if (i % 3 == 2) { /* all but on one line, which may be level or upright */
            corner[1][i / 3 % 2] = corner[0][i / 3 % 2] + (i % 5 == 0 ? 0x1p-30 : 0);
            corner[2][0] = 0.5 * (corner[0][0] + corner[1][0]) + 0x1p-20;
            corner[2][1] = 0.5 * (corner[0][1] + corner[1][1]) - 0x1p-20;
        }
        lrcsi_clip_polygon all;
        lrcsi_clip_triangle((const double(*)[2])corner, &all);
        double area = lrcsi_clip_area(&all);
        if (area < 0) {
            for (int k = 0; k < 2; k++) {
                double x = corner[1][k];
                corner[1][k] = corner[2][k];
                corner[2][k] = x;
            }
        }
        double sum = 0;
        for (int k = 0; k < 256; k++) {
            const double low[2] = {k % 16, k / 16};
            double part = lrcsi_clip_box_area((const double(*)[2])corner, low);
            check_abs(part, area_cut((const double(*)[2])corner, low), 600 * 0x1p-53);
            sum += part;
            shown += part > 0 && part < 1;
        }
        check_abs(sum, fabs(area), 256 * 300 * 0x1p-53);
    }
    assert_true(shown > 50000);
}

/* Corners that alternate about a line by rounding would give more sides than there is room for: the
   shape is refused, and nothing is written beyond it. */
static void a_shape_with_too_many_crossings_is_refused(void **state)
{
    (void)state;
    static struct {
        lrcsi_clip_polygon shape, left, right;
        double guard[2];
    } s;
    const double line[3] = {0, 1, 0};
    for (uint32_t count = 3; count <= LRCSI_CLIP_MAX_SIDES; count++) {
        s.shape.count = count;
        s.guard[0] = s.guard[1] = 7;
        for (uint32_t i = 0; i < count; i++) {
            s.shape.corner[i][0] = i;
            s.shape.corner[i][1] = i % 2 ? 0x1p-60 : -0x1p-60;
        }
        lrcsi_clip_polygon kept = s.shape;
        int whole = lrcsi_clip_divide(&s.shape, line, &s.left, &s.right) >= 0;
        int left = lrcsi_clip_keep_left(&kept, line);
        assert_true(count > 20 || (whole && left)); /* at most 3/2 of the corners */
        assert_true(count < 24 || (!whole && !left));
        assert_true(s.guard[0] == 7 && s.guard[1] == 7);
        assert_true(left || kept.count == count);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_shape_with_too_many_crossings_is_refused),
        cmocka_unit_test(a_line_splits_what_it_crosses),
        cmocka_unit_test(both_parts_have_the_corners_of_the_cut),
        cmocka_unit_test(a_polygon_with_too_many_corners_is_refused_on_either_side),
        cmocka_unit_test(a_box_shows_its_part_of_a_triangle),
        cmocka_unit_test(parts_are_those_of_cutting_and_add_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
