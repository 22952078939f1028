/* SPDX-License-Identifier: MIT */
/* Stages, one by one: those of preparing are timed as they are run, those of a pose end where they
   are told to. */
#include <lrcs/host.h>

#include "check.h"

static lrcs_host_scene scene;
static lrcs_host_error error;

static void stages_of_preparing_are_timed_and_part_of_it(void **state)
{
    (void)state;
    lrcs_host_options options = lrcs_host_options_default();
    assert_int_equal(lrcs_host_scene_read("demo", &options, &scene, &error), LRCS_OK);
    assert_int_equal(lrcs_host_scene_prepare(&scene, &error), LRCS_OK);
    double all = 0;
    for (int i = 0; i < LRCS_HOST_PREPARE_STAGES; i++) {
        assert_true(scene.seconds_stage[i] >= 0);
        all += scene.seconds_stage[i];
    }
    assert_true(all > 0 && all <= scene.seconds_prepare);
}

static void a_pose_runs_until_every_stage_by_every_method(void **state)
{
    (void)state;
    lrcs_pose pose;
    assert_int_equal(lrcs_pose_from_direction((const double[3]){1, 2, 3}, &pose), LRCS_OK);
    for (int method = LRCS_METHOD_FACET; method <= LRCS_METHOD_EXACT; method++) {
        for (int stage = 0; stage < LRCS_HOST_POSE_STAGES; stage++) {
            lrcs_run_options options = lrcs_run_options_default();
            options.method = method;
            options.resolution = method == LRCS_METHOD_ZBUFFER ? 64 : 0;
            assert_int_equal(lrcs_host_scene_run_until(&scene, &pose, &options, stage, &error),
                             LRCS_OK);
        }
    }
}

static void auto_has_no_stages_and_others_are_none(void **state)
{
    (void)state;
    lrcs_pose pose;
    lrcs_run_options options = lrcs_run_options_default();
    assert_int_equal(lrcs_pose_from_direction((const double[3]){1, 2, 3}, &pose), LRCS_OK);
    assert_int_equal(lrcs_host_scene_run_until(&scene, &pose, &options, 0, &error),
                     LRCS_E_ARGUMENT);
    options.method = LRCS_METHOD_EXACT;
    assert_int_equal(
        lrcs_host_scene_run_until(&scene, &pose, &options, LRCS_HOST_POSE_STAGES, &error),
        LRCS_E_ARGUMENT);
    assert_int_equal(lrcs_host_scene_run_until(&scene, &pose, &options, -1, &error),
                     LRCS_E_ARGUMENT);
    options.tolerance = 0;
    assert_int_equal(lrcs_host_scene_run_until(&scene, &pose, &options, 0, &error),
                     LRCS_E_ARGUMENT);
}

static void forecasts_grow_with_the_work(void **state)
{
    (void)state;
    enum { FACET, COARSE, FINE, DEFAULT, PROVED, EXACT, AUTO, COUNT };
    lrcs_pose pose;
    lrcs_run_options options[COUNT];
    double seconds[COUNT];
    assert_int_equal(lrcs_pose_from_direction((const double[3]){1, 2, 3}, &pose), LRCS_OK);
    for (int i = 0; i < COUNT; i++) {
        options[i] = lrcs_run_options_default();
        options[i].method = i == FACET  ? LRCS_METHOD_FACET
                            : i < EXACT ? LRCS_METHOD_ZBUFFER
                                        : LRCS_METHOD_EXACT;
        options[i].resolution = i == FINE ? 1024 : i == DEFAULT ? 0 : 256;
        options[i].accept = i == PROVED ? LRCS_ACCEPT_BOUND : LRCS_ACCEPT_ESTIMATE;
    }
    options[AUTO].method = LRCS_METHOD_AUTO;
    options[AUTO].resolution = 0;
    options[AUTO].accept = LRCS_ACCEPT_BOUND;
    assert_int_equal(lrcs_host_scene_forecast(&scene, &pose, options, COUNT, seconds, &error),
                     LRCS_OK);
    assert_true(0 < seconds[FACET] && seconds[FACET] < seconds[COARSE]);
    assert_true(seconds[COARSE] < seconds[FINE]);
    assert_true(seconds[COARSE] == seconds[PROVED]); /* of so few facets it is the same raster */
    assert_true(seconds[DEFAULT] == seconds[COARSE]);
    assert_true(seconds[AUTO] == seconds[EXACT] && seconds[EXACT] > seconds[FACET]);
}

static void what_no_run_would_accept_has_no_forecast(void **state)
{
    (void)state;
    lrcs_pose pose;
    lrcs_run_options options[2] = {lrcs_run_options_default(), lrcs_run_options_default()};
    double seconds[2] = {-1, -1};
    assert_int_equal(lrcs_pose_from_direction((const double[3]){1, 2, 3}, &pose), LRCS_OK);
    options[1].tolerance = 0;
    assert_int_equal(lrcs_host_scene_forecast(&scene, &pose, options, 2, seconds, &error),
                     LRCS_E_ARGUMENT);
    pose.R[0][0] = NAN;
    assert_int_equal(lrcs_host_scene_forecast(&scene, &pose, options, 1, seconds, &error),
                     LRCS_E_NUMBER);
    assert_true(seconds[0] == -1 && seconds[1] == -1);
    lrcs_host_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stages_of_preparing_are_timed_and_part_of_it),
        cmocka_unit_test(a_pose_runs_until_every_stage_by_every_method),
        cmocka_unit_test(auto_has_no_stages_and_others_are_none),
        cmocka_unit_test(forecasts_grow_with_the_work),
        cmocka_unit_test(what_no_run_would_accept_has_no_forecast),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
