/* SPDX-License-Identifier: MIT */
/* Facing to the last bit, incidence against long double, and the window. */
#include "view/view.h"

#include "scenes.h"

static test_scene scene;
static lrcs_work work;

/* A facet, a direction, and what both make exactly. */
typedef struct tilt_row {
    double corner[3][3], direction[3];
    double tan2, cosine, projected;
} tilt_row;

#include "../vectors/tilt.inc"
#define TILT_ROWS (sizeof tilt_rows / sizeof tilt_rows[0])

static lrcsi_view view_along(const double d[3])
{
    lrcs_pose pose;
    lrcsi_view view;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    return view;
}

/* The facet (0,0,0) (3,1,2) (1,4,-1) has the normal (-9, 5, 11); u, v span its plane. */
static void facing_is_exact_at_edge_on_and_one_ulp_off(void **state)
{
    (void)state;
    static const double in_plane[][3] = {{3, 1, 2}, {1, 4, -1}, {4, 5, 1}, {5, 9, 0}, {-2, 3, -3}};
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){3, 1, 2},
                   (const double[3]){1, 4, -1});
    for (int i = 0; i < 5; i++) {
        lrcsi_view view = view_along(in_plane[i]);
        assert_int_equal(view.facing[0], 0);
        lrcsi_incidence incidence = lrcsi_view_incidence(&view, 0);
        check_same(incidence.projected, 0);
        check_same(incidence.cos_theta, 0);
        for (int k = 0; k < 3; k++) {
            static const int sign[3] = {-1, 1, 1};
            for (int side = -1; side <= 1; side += 2) {
                double d[3] = {in_plane[i][0], in_plane[i][1], in_plane[i][2]};
                d[k] = d[k] == 0 ? side * 0x1p-290 : nextafter(d[k], side * HUGE_VAL);
                view = view_along(d);
                assert_int_equal(view.facing[0], side * sign[k]);
                incidence = lrcsi_view_incidence(&view, 0);
                assert_true(incidence.cos_theta * side * sign[k] > 0);
                assert_true(incidence.projected > 0);
            }
        }
    }
}

static void facing_holds_where_doubles_cancel(void **state)
{
    (void)state;
    /* N = (0, 0, 1) lifted by one ulp over a span of one: (-2^-52, 0, 1) and the like */
    const double ulp = 0x1p-52;
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){0, 0, 1}, (const double[3]){1, 0, 1 + ulp},
                   (const double[3]){0, 1, 1});
    static const double steep[][4] = {{1, 0, 0x1p-52, 0},
                                      {1, 0, 0x1.0000000000001p-52, 1},
                                      {1, 0, 0x1.fffffffffffffp-53, -1},
                                      {0, 1, 0, 0},
                                      {0, 1, 0x1p-300, 1},
                                      {0, -1, -0x1p-300, -1}};
    for (size_t i = 0; i < sizeof steep / sizeof *steep; i++) {
        lrcsi_view view = view_along(steep[i]);
        assert_int_equal(view.facing[0], (int)steep[i][3]);
    }
}

/* tan^2 within its own claim of long double, for directions not normalised. */
static void tilt_agrees_from_normal_to_grazing(void **state)
{
    (void)state;
    need_wide_long_double();
    static const double tangent[] = {1e-300, 1e-150, 1e-15, 1e-9, 1e-3, 0.3,
                                     1,      1e3,    1e9,   1e12, 1e20, 1e60};
    static const double length[] = {1, 3e-7, 1e200};
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){2, 0, 0},
                   (const double[3]){0, 3, 0});
    for (int i = 0; i < 12; i++) {
        for (int j = 0; j < 3; j++) {
            double t = tangent[i];
            double d[3] = {0.6 * t * length[j], 0.8 * t * length[j], length[j]};
            long double want2 =
                ((long double)d[0] * d[0] / d[2] / d[2] + (long double)d[1] * d[1] / d[2] / d[2]);
            lrcsi_view view = view_along(d);
            lrcsi_incidence incidence = lrcsi_view_incidence(&view, 0);
            if (incidence.tan2_err < 1) {
                check_rel(incidence.tan2, (double)want2, incidence.tan2_err);
                assert_true(incidence.tan2_err < 1e-14);
            } else if (isfinite(incidence.tan2_err)) { /* it lies in 0 .. tan2 */
                check_most((double)want2, incidence.tan2);
                check_most(incidence.tan2, 1e-50);
            }
            long double cosine = 1 / sqrtl(1 + want2);
            check_rel(incidence.cos_theta, (double)cosine, 1e-15);
            check_abs(lrcsi_prepared_area(view.prepared, incidence.projected), (double)(3 * cosine),
                      incidence.error * 3 * (double)cosine);
            assert_true(incidence.error < 4e-15);
        }
    }
}

/* The reference is rounded once itself. */
static void tilt_agrees_with_exact_arithmetic(void **state)
{
    (void)state;
    for (size_t i = 0; i < TILT_ROWS; i++) {
        const tilt_row *row = &tilt_rows[i];
        scene_start(&scene);
        scene_triangle(&scene, row->corner[0], row->corner[1], row->corner[2]);
        lrcsi_view view = view_along(row->direction);
        lrcsi_incidence incidence = lrcsi_view_incidence(&view, 0);
        check_rel(incidence.tan2, row->tan2, incidence.tan2_err + 0x1p-53);
        check_most(incidence.tan2_err, 1e-14);
        check_rel(incidence.cos_theta, row->cosine, 12 * 0x1p-53);
        check_rel(lrcsi_prepared_area(view.prepared, incidence.projected), row->projected,
                  incidence.error + 0x1p-53);
        check_most(incidence.error, 9 * 0x1p-53);
    }
}

static void check_same_tilt(lrcsi_incidence got, lrcsi_incidence want)
{
    check_same(got.cos_theta, want.cos_theta);
    check_same(got.tan2, want.tan2);
    check_same(got.tan2_err, want.tan2_err);
    check_same(got.projected, want.projected);
    check_same(got.error, want.error);
}

/* From one facet to as many as are taken at a time, edge-on, grazing and facing the laser. */
static void many_tilts_are_those_of_one_facet_each(void **state)
{
    (void)state;
    static const double along[][3] = {{1, 0, 0}, {0, 0, 1}, {0.3, -0.8, 0.55}, {1, 1e-12, 0}};
    scene_start(&scene);
    scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
    scene_sphere(&scene, (const double[3]){3, 0, 0}, 1, 12);
    for (int i = 0; i < 4; i++) {
        lrcsi_view view = view_along(along[i]);
        for (uint32_t count = 1; count <= LRCSI_INCIDENCES; count++) {
            uint32_t facet[LRCSI_INCIDENCES];
            lrcsi_incidence incidence[LRCSI_INCIDENCES];
            for (uint32_t k = 0; k < count; k++) {
                facet[k] = (7 * k + 3 * count) % scene.scene.facet_count;
            }
            lrcsi_view_incidences(&view, facet, count, incidence);
            for (uint32_t k = 0; k < count; k++) {
                check_same_tilt(incidence[k], lrcsi_view_incidence(&view, facet[k]));
            }
        }
    }
}

/* N = (0, -2^-250, 1) against (1, -2^-299, 0): cos = 2^-549, whose tan^2 no double holds. */
static void nearest_to_edge_on_tan2_is_a_lower_bound(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                   (const double[3]){0, 1, 0x1p-250});
    lrcsi_view view = view_along((const double[3]){1, -0x1p-299, 0});
    lrcsi_incidence incidence = lrcsi_view_incidence(&view, 0);
    assert_int_equal(view.facing[0], 1);
    assert_true(isinf(incidence.tan2_err) && isfinite(incidence.tan2));
    check_most(0x1p990, incidence.tan2);
    assert_true(incidence.cos_theta >= 0x1p-549 && incidence.cos_theta <= 0x1p-499);
    lrcs_result r = scene_run(&scene, (const double[3]){1, -0x1p-299, 0}, LRCS_METHOD_EXACT, 0);
    check_most(r.sigma_m2, r.bound_m2); /* the truth is below 1e-400 */
    check_most(r.bound_m2, 0x1p-995);   /* 2^-1000 of each part is for underflow (reflect.c) */
}

static void normal_incidence_is_exact(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){1, 2, 3}, (const double[3]){2, 4, 3},
                   (const double[3]){1, 5, 1}); /* (1,2,0) x (0,3,-2) = (-4, 2, 3) */
    for (int sign = -1; sign <= 1; sign += 2) {
        lrcsi_view view = view_along((const double[3]){-4 * sign, 2 * sign, 3 * sign});
        lrcsi_incidence incidence = lrcsi_view_incidence(&view, 0);
        assert_int_equal(view.facing[0], sign);
        check_rel(incidence.cos_theta, (double)sign, 4e-16);
        check_most(incidence.tan2, 1e-60);
        check_rel(lrcsi_prepared_area(view.prepared, incidence.projected), 0.5 * sqrt(29), 1e-15);
    }
}

static void window_is_the_square_around_the_projection(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_box(&scene, (const double[3]){1, 2, 3}, (const double[3]){2, 6, 5});
    scene_vertex(&scene, 100, 100, 100); /* no facet uses it */
    lrcsi_view view = view_along((const double[3]){0, 0, 1});
    double unit = ldexp(1, -view.prepared->exponent);
    check_same(view.side, 4 * unit);
    check_same(view.low[0], -2 * unit); /* about the box's centre (1.5, 4, 4) */
    check_same(view.low[1], -2 * unit);
    for (uint32_t v = 0; v < 8; v++) {
        check_same(view.point[v].x[0], (scene.vertex[v].x[0] - 1.5) * unit);
        check_same(view.point[v].x[1], (scene.vertex[v].x[1] - 4) * unit);
        check_same(view.point[v].x[2], (scene.vertex[v].x[2] - 4) * unit);
    }
    assert_int_equal(view.front, 2);
    assert_int_equal(view.back, 2);
}

/* View coordinates against long double with the rows of R, which may themselves be off by 4 u. */
static void check_points(const lrcsi_view *view)
{
    const lrcs_prepared *p = view->prepared;
    for (uint32_t v = 0; v < p->scene->vertex_count; v++) {
        long double square = 0;
        for (int k = 0; k < 3; k++) {
            long double want = 0;
            for (int i = 0; i < 3; i++) {
                want += view->R[k][i] * ((long double)p->vertex[v].x[i] - p->origin[i]);
            }
            check_abs(view->point[v].x[k], (double)want,
                      lrcsi_view_point_err(view->point[v].x) * (4 / 8.1));
            square += want * want;
        }
        check_most(lrcsi_view_point_err(view->point[v].x), 2e-15 * sqrt((double)square));
    }
}

static void points_lie_within_their_error(void **state)
{
    (void)state;
    need_wide_long_double();
    scene_start(&scene);
    scene_sphere(&scene, (const double[3]){1000, -300, 7}, 3, 12);
    lrcsi_view view = view_along((const double[3]){0.3, -0.8, 0.55});
    check_points(&view);
    check_same(view.prepared->origin[0], view.prepared->centre[0]);
}

/* The error of a far vertex does not enlarge those of the others. */
static void a_far_vertex_leaves_the_others_their_errors(void **state)
{
    (void)state;
    need_wide_long_double();
    for (double far = 1e4; far <= 1e60; far *= 1e7) {
        scene_start(&scene);
        scene_sphere(&scene, (const double[3]){0.5, -0.25, 7}, 3, 12);
        scene_triangle(&scene, (const double[3]){1, 1, 1}, (const double[3]){1, 2, 1},
                       (const double[3]){-far, far, 0.5 * far});
        lrcsi_view view = view_along((const double[3]){0.3, -0.8, 0.55});
        const lrcs_prepared *p = view.prepared;
        check_points(&view);
        double metre = ldexp(1, -p->exponent);
        for (uint32_t v = 0; v < scene.scene.vertex_count - 1; v++) {
            check_most(lrcsi_view_point_err(view.point[v].x), 3e-14 * metre);
        }
        for (int k = 0; k < 3; k++) {
            check_most(p->bulk[k], 8 * metre);
        }
        check_most(view.scale * metre, 0.5);
        check_most(1e-2, view.scale * metre);
    }
}

/* A lifted point and the line of sight through it, which meets the view plane at (x, y). */
static void lifted_points_lie_within_their_error(void **state)
{
    (void)state;
    need_wide_long_double();
    scene_start(&scene);
    scene_sphere(&scene, (const double[3]){1000, -300, 7}, 3, 12);
    lrcsi_view view = view_along((const double[3]){0.3, -0.8, 0.55});
    for (int i = 0; i < 100; i++) {
        double at[2] = {1e-3 * sin(i), 1e-3 * cos(3 * i)};
        double point[3];
        lrcsi_view_unproject(&view, at[0], at[1], point);
        for (int k = 0; k < 2; k++) {
            long double got = 0;
            for (int j = 0; j < 3; j++) {
                got += view.R[k][j] * ((long double)point[j] - view.prepared->origin[j]);
            }
            check_abs((double)got, at[k], lrcsi_view_unproject_err(&view, at[0], at[1]));
        }
    }
    check_most(lrcsi_view_unproject_err(&view, 0, 0), 3e-16);
}

/* Both against long double: the unit vector's two parts, and n . d of every facet. */
static void dot_products_stay_within_their_error(void **state)
{
    (void)state;
    need_wide_long_double();
    for (size_t i = 0; i < TILT_ROWS; i++) {
        const tilt_row *row = &tilt_rows[i];
        scene_start(&scene);
        scene_triangle(&scene, row->corner[0], row->corner[1], row->corner[2]);
        lrcsi_view view = view_along(row->direction);
        const double *d = view.direction;
        long double length =
            sqrtl((long double)d[0] * d[0] + (long double)d[1] * d[1] + (long double)d[2] * d[2]);
        for (int k = 0; k < 3; k++) {
            check_abs((double)(d[k] / length - view.unit[k] - view.unit_low[k]), 0, 0x1p-62);
            check_most(fabs(view.unit_low[k]), 0x1p-53 * fabs(view.unit[k]));
        }
        double *const *n = view.prepared->batches.normal;
        double dot = lrcsi_view_dot(n[0][0], n[1][0], n[2][0], view.unit);
        check_abs(dot, row->cosine, LRCSI_DOT_ERROR);
        check_same(n[0][1], 0); /* beyond the last place */
    }
}

/* A surface whose normals turn by at most so much from the facet's may face a laser that far behind
   the facet's plane, and no farther. */
static void a_turned_surface_may_face_the_laser_from_behind_its_facet(void **state)
{
    (void)state;
    static const double turn[] = {0, 1e-6, 0.1, 0.5};
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                   (const double[3]){0, 1, 0});
    for (int i = 0; i < 4; i++) {
        const double sine[] = {-1, -turn[i] - 1e-8, -0.99 * turn[i] + 1e-10, 1};
        for (int k = 0; k < 4; k++) {
            const double d[3] = {0.6 * sqrt(1 - sine[k] * sine[k]),
                                 0.8 * sqrt(1 - sine[k] * sine[k]), sine[k]};
            lrcsi_view view = view_along(d);
            assert_int_equal(lrcsi_view_may_face(&view, 0, turn[i]), k >= 2);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(facing_is_exact_at_edge_on_and_one_ulp_off),
        cmocka_unit_test(facing_holds_where_doubles_cancel),
        cmocka_unit_test(tilt_agrees_from_normal_to_grazing),
        cmocka_unit_test(tilt_agrees_with_exact_arithmetic),
        cmocka_unit_test(many_tilts_are_those_of_one_facet_each),
        cmocka_unit_test(nearest_to_edge_on_tan2_is_a_lower_bound),
        cmocka_unit_test(normal_incidence_is_exact),
        cmocka_unit_test(dot_products_stay_within_their_error),
        cmocka_unit_test(a_turned_surface_may_face_the_laser_from_behind_its_facet),
        cmocka_unit_test(window_is_the_square_around_the_projection),
        cmocka_unit_test(points_lie_within_their_error),
        cmocka_unit_test(a_far_vertex_leaves_the_others_their_errors),
        cmocka_unit_test(lifted_points_lie_within_their_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
