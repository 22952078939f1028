/* SPDX-License-Identifier: MIT */
/* Many poses in threads: the same bits as a plain loop over lrcs_sigma_run, in order, whatever the
   number of threads; failures and cancels that say the same whatever it is. */
#include <lrcs/sweep.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"

/* More than the results that seven threads may keep waiting (host/run/workers.c). */
#define POSES 128u

static const uint32_t threads_tried[] = {1, 2, 3, 7};
#define THREADS_TRIED (sizeof threads_tried / sizeof threads_tried[0])

static lrcs_host_scene demo;

static int demo_make(void **state)
{
    (void)state;
    lrcs_host_options options = lrcs_host_options_default();
    options.build.tolerance = 1e-2;
    return lrcs_host_scene_read("demo", &options, &demo, NULL) == LRCS_OK &&
                   lrcs_host_scene_prepare(&demo, NULL) == LRCS_OK
               ? 0
               : -1;
}

static int demo_free(void **state)
{
    (void)state;
    lrcs_host_scene_free(&demo);
    return 0;
}

/* The request of a sweep, and its results. */
typedef struct sweep_seen {
    uint64_t fails_at;     /* this pose has no direction; UINT64_MAX: none */
    uint64_t refuses_at;   /* this result is not taken */
    uint64_t cancels_at;   /* the flag is set as this result is taken */
    uint64_t first, taken; /* where it began, how many came */
    int in_order;
    volatile sig_atomic_t cancel;
    lrcs_result result[POSES];
} sweep_seen;

static int pose_at(void *context, uint64_t index, lrcs_pose *pose)
{
    const sweep_seen *seen = context;
    const double nowhere[3] = {0, 0, 0};
    return index == seen->fails_at
               ? lrcs_pose_from_direction(nowhere, pose)
               : lrcs_pose_from_azel(7.0 * (double)index, 3.5 * (double)index - 90.0, pose);
}

static int result_take(void *context, uint64_t index, const lrcs_pose *pose,
                       const lrcs_result *result, const lrcs_uncertainty *uncertainty,
                       const lrcs_host_glint_sum *glint, lrcs_host_error *error)
{
    sweep_seen *seen = context;
    assert_null(uncertainty);
    assert_null(glint);
    lrcs_pose asked;
    assert_int_equal(pose_at(seen, index, &asked), LRCS_OK);
    seen->in_order &= index == seen->first + seen->taken &&
                      memcmp(asked.direction, pose->direction, sizeof asked.direction) == 0;
    if (index == seen->refuses_at) {
        strcpy(error->text, "no more");
        return LRCS_E_LIMIT;
    }
    seen->cancel = index == seen->cancels_at ? 1 : seen->cancel;
    seen->result[seen->taken++] = *result;
    return LRCS_OK;
}

static sweep_seen *seen_make(void)
{
    sweep_seen *seen = calloc(1, sizeof *seen);
    assert_non_null(seen);
    seen->fails_at = seen->refuses_at = seen->cancels_at = UINT64_MAX;
    seen->in_order = 1;
    return seen;
}

static lrcs_host_sweep sweep_of(sweep_seen *seen, uint32_t threads)
{
    return (lrcs_host_sweep){.first = 0,
                             .count = POSES,
                             .threads = threads,
                             .pose = pose_at,
                             .take = result_take,
                             .context = seen,
                             .cancel = &seen->cancel};
}

/* Every number of a result; its texts are the same constants. */
static void same_results(const lrcs_result *a, const lrcs_result *b)
{
    const double x[] = {a->sigma_m2,           a->sigma_glint_m2,       a->sigma_diffuse_m2,
                        a->bound_m2,           a->budget.visibility_m2, a->budget.tessellation_m2,
                        a->budget.rounding_m2, a->estimate_m2,          a->curvature_estimate_m2,
                        a->projected_area_m2,  a->back_side_area_m2};
    const double y[] = {b->sigma_m2,           b->sigma_glint_m2,       b->sigma_diffuse_m2,
                        b->bound_m2,           b->budget.visibility_m2, b->budget.tessellation_m2,
                        b->budget.rounding_m2, b->estimate_m2,          b->curvature_estimate_m2,
                        b->projected_area_m2,  b->back_side_area_m2};
    assert_memory_equal(x, y, sizeof x);
    assert_int_equal(a->method, b->method);
    assert_int_equal(a->resolution, b->resolution);
    assert_int_equal(a->flags, b->flags);
    assert_int_equal(a->notices, b->notices);
    assert_int_equal(a->facets_front, b->facets_front);
    assert_int_equal(a->facets_hidden, b->facets_hidden);
    assert_int_equal(a->facets_partial, b->facets_partial);
}

/* The single-threaded library in memory of the caller's: nothing of the host layer. */
static void plain_loop(const lrcs_run_options *options, lrcs_result *result)
{
    size_t need = lrcs_sigma_need(demo.prepared, options);
    void *bytes = malloc(need);
    assert_non_null(bytes);
    sweep_seen *seen = seen_make();
    for (uint32_t i = 0; i < POSES; i++) {
        lrcs_pose pose;
        lrcs_work work = lrcs_work_make(bytes, need);
        assert_int_equal(pose_at(seen, i, &pose), LRCS_OK);
        assert_int_equal(
            lrcs_sigma_run(demo.prepared, &pose, options, &work, &result[i], NULL, NULL), LRCS_OK);
    }
    free(seen);
    free(bytes);
}

static void any_number_of_threads_gives(const lrcs_run_options *options)
{
    lrcs_result *plain = calloc(POSES, sizeof *plain);
    assert_non_null(plain);
    plain_loop(options, plain);
    assert_true(plain[1].sigma_m2 > 0.0 && plain[1].sigma_m2 != plain[2].sigma_m2);
    for (size_t t = 0; t < THREADS_TRIED; t++) {
        sweep_seen *seen = seen_make();
        lrcs_host_sweep sweep = sweep_of(seen, threads_tried[t]);
        uint64_t done = 0;
        assert_int_equal(lrcs_host_sweep_run(&demo, options, &sweep, &done, NULL), LRCS_OK);
        assert_int_equal(done, POSES);
        assert_int_equal(seen->taken, POSES);
        assert_true(seen->in_order);
        for (uint32_t i = 0; i < POSES; i++) {
            same_results(&seen->result[i], &plain[i]);
        }
        free(seen);
    }
    free(plain);
}

static void any_number_of_threads_gives_the_bits_of_a_plain_loop(void **state)
{
    (void)state;
    lrcs_run_options options = lrcs_run_options_default();
    any_number_of_threads_gives(&options);
}

static void and_so_it_does_by_raster(void **state)
{
    (void)state;
    lrcs_run_options options = lrcs_run_options_default();
    options.method = LRCS_METHOD_ZBUFFER;
    options.resolution = 64;
    any_number_of_threads_gives(&options);
}

static void a_sweep_may_begin_anywhere(void **state)
{
    (void)state;
    lrcs_run_options options = lrcs_run_options_default();
    sweep_seen *whole = seen_make();
    sweep_seen *part = seen_make();
    lrcs_host_sweep sweep = sweep_of(whole, 2);
    assert_int_equal(lrcs_host_sweep_run(&demo, &options, &sweep, NULL, NULL), LRCS_OK);
    sweep = sweep_of(part, 3);
    sweep.first = part->first = 17;
    sweep.count = 20;
    assert_int_equal(lrcs_host_sweep_run(&demo, &options, &sweep, NULL, NULL), LRCS_OK);
    assert_true(part->in_order);
    assert_int_equal(part->taken, 20);
    for (uint32_t i = 0; i < 20; i++) {
        same_results(&part->result[i], &whole->result[17 + i]);
    }
    sweep.count = 0;
    part->taken = 0;
    assert_int_equal(lrcs_host_sweep_run(&demo, &options, &sweep, NULL, NULL), LRCS_OK);
    assert_int_equal(part->taken, 0);
    free(part);
    free(whole);
}

static void the_first_pose_that_fails_is_named_and_all_before_it_are_taken(void **state)
{
    (void)state;
    lrcs_run_options options = lrcs_run_options_default();
    for (size_t t = 0; t < THREADS_TRIED; t++) {
        sweep_seen *seen = seen_make();
        lrcs_host_sweep sweep = sweep_of(seen, threads_tried[t]);
        lrcs_host_error error = {""};
        uint64_t done = 0;
        seen->fails_at = 41;
        assert_int_equal(lrcs_host_sweep_run(&demo, &options, &sweep, &done, &error),
                         LRCS_E_ARGUMENT);
        assert_int_equal(done, 41);
        assert_int_equal(seen->taken, 41);
        assert_non_null(strstr(error.text, "pose 41: "));
        free(seen);
    }
}

static void options_that_no_run_accepts_fail_the_first_pose(void **state)
{
    (void)state;
    lrcs_run_options options = lrcs_run_options_default();
    sweep_seen *seen = seen_make();
    lrcs_host_sweep sweep = sweep_of(seen, 2);
    lrcs_host_error error = {""};
    options.tolerance = -1.0;
    assert_int_equal(lrcs_host_sweep_run(&demo, &options, &sweep, NULL, &error), LRCS_E_ARGUMENT);
    assert_non_null(strstr(error.text, "pose 0: sigma"));
    assert_int_equal(seen->taken, 0);
    free(seen);
}

static void a_result_that_is_refused_ends_the_sweep(void **state)
{
    (void)state;
    lrcs_run_options options = lrcs_run_options_default();
    for (size_t t = 0; t < THREADS_TRIED; t++) {
        sweep_seen *seen = seen_make();
        lrcs_host_sweep sweep = sweep_of(seen, threads_tried[t]);
        lrcs_host_error error = {""};
        uint64_t done = 0;
        seen->refuses_at = 5;
        assert_int_equal(lrcs_host_sweep_run(&demo, &options, &sweep, &done, &error), LRCS_E_LIMIT);
        assert_string_equal(error.text, "no more");
        assert_int_equal(done, 5);
        free(seen);
    }
}

static void a_cancel_takes_what_is_done_and_stops(void **state)
{
    (void)state;
    lrcs_run_options options = lrcs_run_options_default();
    for (size_t t = 0; t < THREADS_TRIED; t++) {
        sweep_seen *seen = seen_make();
        lrcs_host_sweep sweep = sweep_of(seen, threads_tried[t]);
        lrcs_host_error error = {""};
        uint64_t done = 0;
        sweep.count = UINT64_MAX / 2; /* never comes to an end by itself */
        seen->cancels_at = 3;
        seen->refuses_at = POSES; /* nor beyond what can be kept */
        assert_int_equal(lrcs_host_sweep_run(&demo, &options, &sweep, &done, &error),
                         LRCS_E_CANCELLED);
        assert_true(done >= 4 && done < POSES);
        assert_int_equal(done, seen->taken);
        assert_true(seen->in_order);
        assert_non_null(strstr(error.text, "stopped after "));
        free(seen);
    }
}

static void a_cancel_before_the_start_runs_nothing(void **state)
{
    (void)state;
    lrcs_run_options options = lrcs_run_options_default();
    sweep_seen *seen = seen_make();
    lrcs_host_sweep sweep = sweep_of(seen, 1);
    uint64_t done = 1;
    seen->cancel = 1;
    assert_int_equal(lrcs_host_sweep_run(&demo, &options, &sweep, &done, NULL), LRCS_E_CANCELLED);
    assert_int_equal(done, 0);
    free(seen);
}

static void a_scene_that_is_not_prepared_is_refused(void **state)
{
    (void)state;
    lrcs_run_options options = lrcs_run_options_default();
    sweep_seen *seen = seen_make();
    lrcs_host_sweep sweep = sweep_of(seen, 2);
    lrcs_host_scene bare;
    memset(&bare, 0, sizeof bare);
    assert_int_equal(lrcs_host_sweep_run(&bare, &options, &sweep, NULL, NULL), LRCS_E_ARGUMENT);
    sweep.threads = 1025;
    assert_int_equal(lrcs_host_sweep_run(&demo, &options, &sweep, NULL, NULL), LRCS_E_ARGUMENT);
    free(seen);
}

/* The demo with its joints turned by the pose's number of degrees; the 20th cannot be built. */
static int scene_at(void *context, uint64_t index, lrcs_host_scene *scene, lrcs_host_error *error)
{
    const sweep_seen *seen = context;
    lrcs_build_options build = lrcs_build_options_default();
    lrcs_recipe recipe = demo.recipe;
    recipe.part = calloc(recipe.part_count, sizeof *recipe.part);
    if (!recipe.part) {
        return LRCS_E_SYSTEM;
    }
    for (uint32_t i = 0; i < recipe.part_count; i++) {
        recipe.part[i] = demo.recipe.part[i];
        recipe.part[i].joint.angle_deg = (double)index;
    }
    build.tolerance = index == seen->refuses_at ? -1.0 : 1e-2;
    int status = lrcs_host_scene_vary(&demo, &recipe, &build, scene, error);
    free(recipe.part);
    return status == LRCS_OK ? lrcs_host_scene_prepare(scene, error) : status;
}

static void every_pose_may_have_a_scene_of_its_own(void **state)
{
    (void)state;
    lrcs_run_options options = lrcs_run_options_default();
    for (size_t t = 0; t < THREADS_TRIED; t++) {
        sweep_seen *seen = seen_make();
        lrcs_host_sweep sweep = sweep_of(seen, threads_tried[t]);
        lrcs_host_error error = {""};
        sweep.scene = scene_at;
        sweep.count = 30;
        seen->refuses_at = 20;
        assert_int_equal(lrcs_host_sweep_run(NULL, &options, &sweep, NULL, &error),
                         LRCS_E_ARGUMENT);
        assert_non_null(strstr(error.text, "pose 20: "));
        assert_int_equal(seen->taken, 20);
        for (uint64_t i = 0; i < 20; i++) {
            lrcs_host_scene scene;
            lrcs_pose pose;
            lrcs_result plain;
            assert_int_equal(pose_at(seen, i, &pose), LRCS_OK);
            assert_int_equal(scene_at(seen, i, &scene, NULL), LRCS_OK);
            assert_int_equal(
                lrcs_host_scene_run(&scene, &pose, &options, &plain, NULL, NULL, NULL, NULL),
                LRCS_OK);
            same_results(&seen->result[i], &plain);
            lrcs_host_scene_free(&scene);
        }
        assert_true(seen->result[1].sigma_m2 != seen->result[2].sigma_m2);
        free(seen);
    }
}

/* v_obs = R_pose R(x, 90) v_body. With the laser on +z a body turned by 90 deg about x shows its
   +y side: R(x, 90) takes +y to +z. */
static void a_quarter_turn_about_x_shows_the_side_of_y(void **state)
{
    (void)state;
    const double x[3] = {2, 0, 0};
    lrcs_pose pose = lrcs_pose_default();
    assert_int_equal(lrcs_host_pose_turn(&pose, x, 90.0, &pose), LRCS_OK);
    check_same(pose.direction[0], 0.0);
    check_same(pose.direction[1], 1.0);
    check_same(pose.direction[2], 0.0);
    check_same(pose.R[2][1], 1.0);
    check_same(pose.R[1][2], -1.0);
}

/* Rx(20) Ry(30) as Euler angles say it, and as a turn about y of a body turned about x. */
static void a_turn_composes_as_euler_angles_do(void **state)
{
    (void)state;
    const double angles[3] = {20, 30, 0};
    const double first[3] = {20, 0, 0};
    const double y[3] = {0, 1, 0};
    const double zero[3] = {0, 0, 0};
    lrcs_pose whole;
    lrcs_pose turned;
    assert_int_equal(lrcs_pose_from_euler("XYZ", angles, &whole), LRCS_OK);
    assert_int_equal(lrcs_pose_from_euler("XYZ", first, &turned), LRCS_OK);
    assert_int_equal(lrcs_host_pose_turn(&turned, y, 30.0, &turned), LRCS_OK);
    for (int k = 0; k < 3; k++) {
        check_abs(turned.direction[k], whole.direction[k], 1e-15);
        for (int i = 0; i < 3; i++) {
            check_abs(turned.R[i][k], whole.R[i][k], 1e-15);
        }
    }
    assert_int_equal(lrcs_host_pose_turn(&turned, zero, 1.0, &turned), LRCS_E_ARGUMENT);
    assert_int_equal(lrcs_host_pose_turn(&turned, y, (double)NAN, &turned), LRCS_E_NUMBER);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_number_of_threads_gives_the_bits_of_a_plain_loop),
        cmocka_unit_test(and_so_it_does_by_raster),
        cmocka_unit_test(a_sweep_may_begin_anywhere),
        cmocka_unit_test(the_first_pose_that_fails_is_named_and_all_before_it_are_taken),
        cmocka_unit_test(options_that_no_run_accepts_fail_the_first_pose),
        cmocka_unit_test(a_result_that_is_refused_ends_the_sweep),
        cmocka_unit_test(a_cancel_takes_what_is_done_and_stops),
        cmocka_unit_test(a_cancel_before_the_start_runs_nothing),
        cmocka_unit_test(a_scene_that_is_not_prepared_is_refused),
        cmocka_unit_test(every_pose_may_have_a_scene_of_its_own),
        cmocka_unit_test(a_quarter_turn_about_x_shows_the_side_of_y),
        cmocka_unit_test(a_turn_composes_as_euler_angles_do),
    };
    return cmocka_run_group_tests(tests, demo_make, demo_free);
}
