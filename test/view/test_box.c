/* SPDX-License-Identifier: MIT */
/* Boxes in floats: those of points that coincide never lie apart, whatever is rounded; and those of
   points that differ by more than floats round do. */
#include "view/box.h"

#include "scenes.h"

static test_scene scene;

/* A view of a ball and of a vertex that far away. */
static lrcsi_view view_with(double far)
{
    lrcs_work work;
    lrcs_pose pose;
    lrcsi_view view;
    scene_start(&scene);
    scene_sphere(&scene, (const double[3]){0.5, -0.25, 7}, 3, 12);
    scene_triangle(&scene, (const double[3]){1, 1, 1}, (const double[3]){1, 2, 1},
                   (const double[3]){far, far, 0.5 * far});
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction((const double[3]){0.3, -0.8, 0.55}, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    return view;
}

static void points_lie_in_the_boxes_of_what_holds_them(void **state)
{
    (void)state;
    for (double far = 10; far < 1e80; far *= 1e7) {
        lrcsi_view view = view_with(far);
        for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
            const uint32_t *corner = scene.facet[f].corner;
            lrcsi_view_box box = lrcsi_view_box_of(&view, corner, 3);
            for (int k = 0; k < 3; k++) {
                const double *x = view.point[corner[k]].x;
                lrcsi_view_box at = lrcsi_view_box_about(&view, x, 0);
                assert_false(lrcsi_view_box_beside(&at, &box));
                assert_false(lrcsi_view_box_beside(&box, &at));
                assert_false(lrcsi_view_box_behind(&at, &box));
                assert_false(lrcsi_view_box_behind(&box, &at));
            }
        }
    }
}

/* Also where others are farther away than floats reach. */
static void points_apart_have_boxes_apart(void **state)
{
    (void)state;
    for (double far = 10; far < 1e80; far *= 1e7) {
        lrcsi_view view = view_with(far);
        double metre = ldexp(1, -view.prepared->exponent);
        for (int k = 0; k < 3; k++) {
            for (double gap = 1e-5; gap < 1; gap *= 10) {
                const double x[3] = {0.3 * metre, -0.7 * metre, 0.1 * metre};
                double y[3] = {x[0], x[1], x[2]};
                y[k] += gap * metre;
                lrcsi_view_box a = lrcsi_view_box_about(&view, x, lrcsi_view_point_err(x));
                lrcsi_view_box b = lrcsi_view_box_about(&view, y, lrcsi_view_point_err(y));
                assert_int_equal(lrcsi_view_box_beside(&a, &b), k < 2);
                assert_int_equal(lrcsi_view_box_beside(&b, &a), k < 2);
                assert_int_equal(lrcsi_view_box_behind(&a, &b), k == 2);
                assert_false(lrcsi_view_box_behind(&b, &a));
            }
        }
    }
}

/* Beyond what a float holds all count as equally far: never apart from what is there too. */
static void what_floats_do_not_hold_is_kept_at_their_limit(void **state)
{
    (void)state;
    assert_true(lrcsi_view_box_float(1e300) == FLT_MAX);
    assert_true(lrcsi_view_box_float(-1e300) == -FLT_MAX);
    assert_true(lrcsi_view_box_float(-0x1p-160) == 0);
    for (double x = 1e-50; x < 1e300; x *= 1.7) {
        double more = x * (1 + 1e-9);
        assert_true(lrcsi_view_box_float(x) <= lrcsi_view_box_float(more));
        assert_true(lrcsi_view_box_float(-more) <= lrcsi_view_box_float(-x));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_lie_in_the_boxes_of_what_holds_them),
        cmocka_unit_test(points_apart_have_boxes_apart),
        cmocka_unit_test(what_floats_do_not_hold_is_kept_at_their_limit)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
