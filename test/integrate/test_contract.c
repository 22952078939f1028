/* SPDX-License-Identifier: MIT */
/* What lrcs/run.h states of lrcs_sigma_run: statuses, outputs left alone on failure, flags and
   notices, pictures. */
#include "scenes.h"

#include <fenv.h>
#include <lrcs/polygon.h>

static test_scene scene;
static lrcs_work work;
static const double oblique[3] = {1, 2, 3};

static void unit_cube(void)
{
    scene_start(&scene);
    scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
}

static int status_of(const lrcs_run_options *options, lrcs_image *image, lrcs_result *result)
{
    lrcs_pose pose;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction(oblique, &pose), LRCS_OK);
    return lrcs_sigma_run(prepared, &pose, options, &work, result, scene.record, image);
}

/* A failing run with that status leaves result and records as they were. */
static void fails_and_touches_nothing(const lrcs_run_options *options, lrcs_image *image,
                                      int status)
{
    lrcs_result result;
    lrcs_result same;
    memset(&result, 0x55, sizeof result);
    memset(&same, 0x55, sizeof same);
    memset(scene.record, 0x55, sizeof scene.record);
    lrcs_facet_record record = scene.record[SCENE_FACETS - 1];
    assert_int_equal(status_of(options, image, &result), status);
    assert_memory_equal(&result, &same, sizeof same);
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        assert_memory_equal(&scene.record[f], &record, sizeof record);
    }
}

static void bad_options_are_refused(void **state)
{
    (void)state;
    static const lrcs_run_options bad[] = {
        {.tolerance = 0},
        {.tolerance = -1e-4},
        {.tolerance = NAN},
        {.tolerance = 1e-4, .method = 99},
        {.tolerance = 1e-4, .method = -1},
        {.tolerance = 1e-4, .method = 4},
        {.tolerance = 1e-4, .accept = LRCS_ACCEPT_ANY + 1},
        {.tolerance = 1e-4, .accept = -1},
        {.tolerance = 1e-4, .method = LRCS_METHOD_ZBUFFER, .resolution = 16385},
        {.tolerance = 1e-4, .resolution = UINT32_MAX},
        {.tolerance = 1e-4, .without = 1u << LRCS_EFFECTS},
        {.tolerance = 1e-4, .with = 1u << LRCS_EFFECT_ARTICULATION},
        {.tolerance = 1e-4, .without = 1u << LRCS_EFFECT_CURVED_NORMALS},
        {.tolerance = 1e-4, .without = 1u << LRCS_EFFECT_GLINT, .with = LRCS_EFFECTS_SWITCHED}};
    unit_cube();
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        fails_and_touches_nothing(&bad[i], NULL, LRCS_E_ARGUMENT);
    }
}

static void sigma_beyond_doubles_is_refused(void **state)
{
    (void)state;
    unit_cube();
    scene_move(&scene, 1e100, (const double[3]){0, 0, 0});
    scene.material[0].brdf.A = 1e200;
    scene.material[0].brdf.s = 10;
    for (int method = LRCS_METHOD_AUTO; method <= LRCS_METHOD_EXACT; method++) {
        lrcs_run_options options = {.tolerance = 1e-4,
                                    .method = method,
                                    .resolution = method == LRCS_METHOD_ZBUFFER ? 16 : 0};
        fails_and_touches_nothing(&options, NULL, LRCS_E_NUMBER);
    }
}

static void picture_too_large_for_the_work_area_is_refused(void **state)
{
    (void)state;
    uint32_t pixel = 7;
    lrcs_image image = {.size = 16384, .facet = &pixel};
    unit_cube();
    lrcs_run_options options = lrcs_run_options_default();
    fails_and_touches_nothing(&options, &image, LRCS_E_MEMORY);
    assert_int_equal(pixel, 7);
}

static void picture_of_more_pixels_than_any_raster_is_refused(void **state)
{
    (void)state;
    static const uint32_t size[] = {16385, 65536, 100000, 524288, UINT32_MAX};
    uint32_t pixel = 7;
    unit_cube();
    for (size_t i = 0; i < sizeof size / sizeof *size; i++) {
        lrcs_image image = {.size = size[i], .facet = &pixel};
        lrcs_run_options options = lrcs_run_options_default();
        fails_and_touches_nothing(&options, &image, LRCS_E_ARGUMENT);
        assert_int_equal(pixel, 7);
    }
}

/* A pose with one invalid number: 0 to 2 of the direction, from 3 on of R. */
static void pose_is_refused(int number, double value, int status)
{
    lrcs_pose pose;
    lrcs_result result;
    lrcs_result same;
    memset(&result, 0x55, sizeof result);
    memset(&same, 0x55, sizeof same);
    assert_int_equal(lrcs_pose_from_direction(oblique, &pose), LRCS_OK);
    double *at = number < 3 ? &pose.direction[number] : &pose.R[number / 3 - 1][number % 3];
    *at = value;
    unit_cube();
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    for (int method = LRCS_METHOD_AUTO; method <= LRCS_METHOD_EXACT; method++) {
        lrcs_run_options options = {.tolerance = 1e-4, .method = method};
        assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &result, NULL, NULL),
                         status);
        assert_memory_equal(&result, &same, sizeof same);
    }
    lrcs_polygons polygons;
    assert_int_equal(lrcs_polygon_run(prepared, &pose, &work, &polygons), status);
}

static void pose_that_is_none_is_refused(void **state)
{
    (void)state;
    static const double none[] = {NAN, HUGE_VAL, -HUGE_VAL};
    static const double wrong[] = {1.5, 1e160, 1e308, -0.25};
    for (int number = 0; number < 12; number++) {
        for (int i = 0; i < 3; i++) {
            pose_is_refused(number, none[i], LRCS_E_NUMBER);
        }
        for (int i = 0; i < 4; i++) {
            pose_is_refused(number, wrong[i], LRCS_E_ARGUMENT);
        }
    }
}

static void pose_of_another_attitude_or_hand_is_refused(void **state)
{
    (void)state;
    lrcs_result r;
    lrcs_run_options options = lrcs_run_options_default();
    unit_cube();
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    lrcs_pose pose = lrcs_pose_default();
    pose.direction[0] = 0.5;
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &r, NULL, NULL),
                     LRCS_E_ARGUMENT);
    pose = lrcs_pose_default();
    pose.R[0][0] = -1; /* mirrored */
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &r, NULL, NULL),
                     LRCS_E_ARGUMENT);
    pose = (lrcs_pose){.direction = {0, 0, 0}};
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &r, NULL, NULL),
                     LRCS_E_ARGUMENT);
    pose = lrcs_pose_default();
    memset(pose.R, 0, sizeof pose.R);
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &r, NULL, NULL),
                     LRCS_E_ARGUMENT);
}

/* R in single precision: a roll that is good enough, and the very sigma. */
static void pose_whose_matrix_is_rounded_to_floats_does_no_harm(void **state)
{
    (void)state;
    lrcs_result r[2];
    lrcs_pose pose;
    lrcs_run_options options = lrcs_run_options_default();
    unit_cube();
    scene_box(&scene, (const double[3]){0.25, 0.5, 2}, (const double[3]){3, 1, 3});
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction(oblique, &pose), LRCS_OK);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &r[i], NULL, NULL),
                         LRCS_OK);
        for (int k = 0; k < 9; k++) {
            pose.R[k / 3][k % 3] = (float)pose.R[k / 3][k % 3];
        }
    }
    assert_true(fabs(r[0].sigma_m2 - r[1].sigma_m2) <= r[0].bound_m2 + r[1].bound_m2);
    assert_true(r[1].bound_m2 < 1e-11 * r[1].sigma_m2);
}

static void a_thread_that_rounds_upward_is_refused(void **state)
{
    (void)state;
    const lrcs_prepared *prepared = NULL;
    unit_cube();
    lrcs_work room = work;
    lrcs_result result;
    lrcs_pose pose = lrcs_pose_default();
    lrcs_run_options options = lrcs_run_options_default();
    const lrcs_prepared *good = scene_prepare(&scene, &room);
    if (fesetround(FE_UPWARD) != 0) {
        skip();
    }
    int run = lrcs_sigma_run(good, &pose, &options, &room, &result, NULL, NULL);
    int status = lrcs_prepare_run(&scene.scene, &room, &prepared);
    fesetround(FE_TONEAREST);
    assert_int_equal(run, LRCS_E_UNSUPPORTED);
    assert_int_equal(status, LRCS_E_UNSUPPORTED);
    assert_null(prepared);
}

static void tolerance_not_met_is_a_flag_not_a_failure(void **state)
{
    (void)state;
    lrcs_result r;
    unit_cube();
    scene_box(&scene, (const double[3]){0.25, 0.5, 2}, (const double[3]){3, 1, 3});
    lrcs_run_options options = {
        .tolerance = 1e-15, .method = LRCS_METHOD_ZBUFFER, .resolution = 16};
    assert_int_equal(status_of(&options, NULL, &r), LRCS_OK);
    assert_true(r.flags & LRCS_FLAG_TOLERANCE_NOT_MET);
    options.tolerance = 10;
    assert_int_equal(status_of(&options, NULL, &r), LRCS_OK);
    assert_int_equal(r.flags, 0);
    assert_int_equal(r.resolution, 16);
    assert_true(r.estimate_m2 >= 0);
    options = (lrcs_run_options){.tolerance = 1e-10, .method = LRCS_METHOD_EXACT};
    assert_int_equal(status_of(&options, NULL, &r), LRCS_OK);
    assert_int_equal(r.flags, 0);
    assert_int_equal(r.resolution, 0);
    check_same(r.estimate_m2, -1);
}

/* The budget's parts make the bound, and the two terms sigma, to their rounding. */
static void parts_add_up(void **state)
{
    (void)state;
    unit_cube();
    scene_box(&scene, (const double[3]){0.25, 0.5, 2}, (const double[3]){3, 1, 3});
    for (int method = LRCS_METHOD_AUTO; method <= LRCS_METHOD_EXACT; method++) {
        lrcs_result r = scene_run(&scene, oblique, method, 50);
        check_rel(r.sigma_glint_m2 + r.sigma_diffuse_m2, r.sigma_m2, 1e-16);
        check_rel(r.budget.visibility_m2 + r.budget.rounding_m2, r.bound_m2, 1e-15);
        check_same(r.budget.tessellation_m2, 0);
        double sum = 0;
        double glint = 0;
        for (uint32_t f = 0; f < 24; f++) {
            sum += scene.record[f].sigma_m2;
            glint += scene.record[f].sigma_glint_m2;
        }
        check_rel(sum, r.sigma_m2, 1e-14);
        check_rel(glint, r.sigma_glint_m2, 1e-14);
        check_rel(scene_seen(&scene, 0, 24), r.projected_area_m2, 1e-14);
        assert_int_equal(r.facets_front, 12);
    }
}

/* The cube from (0, 0, 1) fills its window: x to the right, y up, row 0 on top. Facets 10 and 11
   are its top: below and above the diagonal from the lower left. */
static void picture_shows_what_is_where(void **state)
{
    (void)state;
    enum { N = 8 };
    uint32_t pixel[N * N];
    lrcs_image image = {.size = N, .facet = pixel};
    lrcs_pose pose = lrcs_pose_default();
    lrcs_run_options options = lrcs_run_options_default();
    lrcs_result r;
    unit_cube();
    scene_move(&scene, 2.0, (const double[3]){3, -4, 5});
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &r, NULL, &image), LRCS_OK);
    assert_int_equal(r.method, LRCS_METHOD_FACET); /* convex: the picture changes nothing */
    assert_int_equal(r.resolution, 0);
    for (int row = 0; row < N; row++) {
        for (int x = 0; x < N; x++) {
            int y = N - 1 - row;
            uint32_t facet = pixel[row * N + x];
            assert_true(facet == 10 || facet == 11);
            if (x != y) {
                assert_int_equal(facet, x > y ? 10 : 11);
            }
        }
    }
    check_abs(image.left_m, 3.0, 1e-15);
    check_abs(image.top_m, -2.0, 1e-15);
    check_abs(image.side_m, 2.0, 1e-15);
}

static void every_code_has_its_text(void **state)
{
    (void)state;
    for (int method = 0; method <= LRCS_METHOD_EXACT; method++) {
        assert_int_equal(lrcs_method_find(lrcs_method_text(method)), method);
    }
    assert_null(lrcs_method_text(-1));
    assert_null(lrcs_method_text(5));
    assert_int_equal(lrcs_method_find("Exact"), LRCS_E_NAME);
    for (int effect = 0; effect < LRCS_EFFECTS; effect++) {
        assert_non_null(lrcs_effect_text(effect));
    }
    assert_null(lrcs_effect_text(LRCS_EFFECTS));
    assert_null(lrcs_effect_text(-1));
    for (int bit = 0; bit < 32; bit++) {
        assert_non_null(lrcs_flag_text((int)(1u << bit)));
        assert_non_null(lrcs_notice_text((int)(1u << bit)));
    }
    assert_string_equal(lrcs_flag_text(LRCS_FLAG_DEPTH_UNDECIDED), "depth_undecided");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bad_options_are_refused),
        cmocka_unit_test(sigma_beyond_doubles_is_refused),
        cmocka_unit_test(picture_too_large_for_the_work_area_is_refused),
        cmocka_unit_test(picture_of_more_pixels_than_any_raster_is_refused),
        cmocka_unit_test(pose_that_is_none_is_refused),
        cmocka_unit_test(pose_of_another_attitude_or_hand_is_refused),
        cmocka_unit_test(pose_whose_matrix_is_rounded_to_floats_does_no_harm),
        cmocka_unit_test(a_thread_that_rounds_upward_is_refused),
        cmocka_unit_test(tolerance_not_met_is_a_flag_not_a_failure),
        cmocka_unit_test(parts_add_up),
        cmocka_unit_test(picture_shows_what_is_where),
        cmocka_unit_test(every_code_has_its_text),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
