/* SPDX-License-Identifier: MIT */
/* Where facets meet each other's planes, and which is nearer, by hand. */
#include "visibility/cells/contact.h"

#include "visibility/base/sample.h"
#include "visibility/plate_and.h"

static test_scene scene;
static lrcs_work work;
static lrcsi_view view;
static lrcsi_target target;

/* The target: (0,0,0) (4,0,0) (0,4,0), front up, seen from above; facet 1 as given. */
static void make_view(const double a[3], const double b[3], const double c[3])
{
    plate_and(&scene, a, b, c, &work, &view);
    lrcsi_target_make(&view, 0, &target);
}

static int kind(double at_a, double at_b, double at_c, lrcsi_contact *c)
{
    make_view((const double[3]){1, 1, at_a}, (const double[3]){2, 1, at_b},
              (const double[3]){1, 2, at_c});
    return lrcsi_contact_find(&target, 1, c);
}

static void a_contact_is_as_the_heights_say(void **state)
{
    (void)state;
    lrcsi_contact c;
    assert_int_equal(kind(0, 0, 0, &c), LRCSI_CONTACT_FLAT);
    assert_int_equal(kind(0, 1, 2, &c), LRCSI_CONTACT_POINT);
    assert_int_equal(kind(0, -1, -2, &c), LRCSI_CONTACT_POINT);
    assert_int_equal(kind(1, 1, -1, &c), LRCSI_CONTACT_LINE);
    assert_int_equal(kind(0, 1, -1, &c), LRCSI_CONTACT_LINE);
    check_same(c.position_err < 1e-28, 1);
    /* A tip as small as rounding passes through: the rest is all there is to tell. */
    assert_int_equal(kind(0x1p-60, -1, -1, &c), LRCSI_CONTACT_BEHIND);
    assert_int_equal(kind(-0x1p-60, 1, 1, &c), LRCSI_CONTACT_FRONT);
}

static void what_is_in_front_lies_left_of_a_contact(void **state)
{
    (void)state;
    static const double height[][3] = {{1, 1, -1}, {-1, -1, 1}, {1, -1, -1},
                                       {0, 1, -1}, {0, -1, 1},  {-2, 1, 3}};
    for (size_t n = 0; n < sizeof height / sizeof *height; n++) {
        lrcsi_contact c;
        assert_int_equal(kind(height[n][0], height[n][1], height[n][2], &c), LRCSI_CONTACT_LINE);
        for (int k = 0; k < 3; k++) {
            double side = (c.end[1][0] - c.end[0][0]) * (c.corner[k][1] - c.end[0][1]) -
                          (c.end[1][1] - c.end[0][1]) * (c.corner[k][0] - c.end[0][0]);
            double h = height[n][k]; /* its corners run counter-clockwise already */
            assert_true(h > 0 ? side > 0 : h < 0 ? side < 0 : fabs(side) < 1e-16);
        }
    }
}

static void order_follows_from_either_plane_or_from_crossing_sides(void **state)
{
    (void)state;
    make_view((const double[3]){1, 1, 1}, (const double[3]){2, 1, 1}, (const double[3]){1, 2, 0});
    assert_int_equal(lrcsi_sample_side(&view, 1, 0), 1);
    assert_int_equal(lrcsi_sample_side(&view, 0, 1), -1);
    /* Each has corners on both sides of the other's plane, yet they do not meet: in z = y - 1,
       where it is above the target. */
    make_view((const double[3]){-1, 3, 2}, (const double[3]){-1, 0.5, -0.5},
              (const double[3]){1, 3, 2});
    assert_int_equal(lrcsi_sample_side(&view, 1, 0), 0);
    assert_int_equal(lrcsi_sample_overlap_order(&view, 1, 0), 1);
    assert_int_equal(lrcsi_sample_overlap_order(&view, 0, 1), -1);
    make_view((const double[3]){-1, 3, -2}, (const double[3]){-1, 0.5, 0.5},
              (const double[3]){1, 3, -2});
    assert_int_equal(lrcsi_sample_side(&view, 1, 0), 0);
    assert_int_equal(lrcsi_sample_overlap_order(&view, 1, 0), -1);
}

/* The corner (-1,1,1) of facet 0 lies on a side of facet 1, which is above it elsewhere: over its
   corner at the origin, and over a side. No sides cross in the view. All that, turned four times.
 */
static void order_follows_from_a_corner_on_a_side(void **state)
{
    (void)state;
    static const double corner[6][3] = {{0, 0, 0},   {0, 8, 0}, {-1, 1, 1},
                                        {-11, 1, 1}, {0, 0, 8}, {0, 1, 1}};
    for (int turns = 0; turns < 4; turns++) {
        lrcs_pose pose;
        scene_start(&scene);
        for (int i = 0; i < 6; i++) {
            double x = turns % 2 == 0 ? corner[i][0] : -corner[i][1];
            double y = turns % 2 == 0 ? corner[i][1] : corner[i][0];
            scene_vertex(&scene, turns < 2 ? x : -x, turns < 2 ? y : -y, corner[i][2]);
        }
        scene_facet(&scene, 0, 1, 2);
        scene_facet(&scene, 3, 4, 5);
        const lrcs_prepared *prepared = scene_prepare(&scene, &work);
        assert_int_equal(lrcs_pose_from_direction((const double[3]){0, 0, 1}, &pose), LRCS_OK);
        assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
        assert_int_equal(lrcsi_sample_side(&view, 1, 0), 0);
        assert_int_equal(lrcsi_sample_overlap_order(&view, 1, 0), 1);
        assert_int_equal(lrcsi_sample_overlap_order(&view, 0, 1), -1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_contact_is_as_the_heights_say),
        cmocka_unit_test(what_is_in_front_lies_left_of_a_contact),
        cmocka_unit_test(order_follows_from_either_plane_or_from_crossing_sides),
        cmocka_unit_test(order_follows_from_a_corner_on_a_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
