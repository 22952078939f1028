/* SPDX-License-Identifier: MIT */
/* What each effect does: sigma with it flipped is that of a run of its own. No test depends on a
   time. */
#include <lrcs/explain.h>

#include <string.h>

#include "check.h"

static uint32_t shown;
static lrcs_host_error error;

static void count_effect(uint32_t done, uint32_t count)
{
    shown += done < count;
}

static void every_effect_is_flipped_by_a_run_of_its_own(void **state)
{
    (void)state;
    const lrcs_host_options load = lrcs_host_options_default();
    lrcs_run_options options = lrcs_run_options_default();
    lrcs_host_scene scene;
    lrcs_host_explained explained;
    lrcs_pose pose;
    lrcs_result result;
    memset(&scene, 0, sizeof scene);
    options.tolerance = 1e-2;
    assert_int_equal(lrcs_host_scene_read("demo", &load, &scene, &error), LRCS_OK);
    assert_int_equal(lrcs_host_scene_prepare(&scene, &error), LRCS_OK);
    assert_int_equal(lrcs_pose_from_azel(50.0, 40.0, &pose), LRCS_OK);
    assert_int_equal(
        lrcs_host_scene_run(&scene, &pose, &options, &result, NULL, NULL, NULL, &error), LRCS_OK);
    assert_int_equal(
        lrcs_host_explain(&scene, &pose, &options, &result, count_effect, &explained, &error),
        LRCS_OK);
    assert_true(explained.rounds >= 1);
    assert_int_equal(shown, explained.rounds * LRCS_EFFECTS);
    for (int i = 0; i < LRCS_EFFECTS; i++) {
        lrcs_run_options flipped = options;
        lrcs_result other;
        if (!(1u << i & LRCS_EFFECTS_SWITCHED)) {
            assert_true(explained.effect[i].sigma_m2 == 0.0 && explained.effect[i].seconds == 0.0);
            continue;
        }
        *(result.effect[i].on ? &flipped.without : &flipped.with) = 1u << i;
        assert_int_equal(
            lrcs_host_scene_run(&scene, &pose, &flipped, &other, NULL, NULL, NULL, &error),
            LRCS_OK);
        assert_true(explained.effect[i].sigma_m2 == other.sigma_m2);
        assert_true(isfinite(explained.effect[i].seconds) && explained.effect[i].scatter >= 0.0);
    }
    for (int i = 0; i < LRCS_HOST_POSE_STAGES; i++) {
        assert_true(explained.stage[i] >= 0.0 && explained.stage_scatter[i] >= 0.0);
    }
    lrcs_host_scene_free(&scene);
}

static void a_pose_that_cannot_be_run_is_told(void **state)
{
    (void)state;
    const lrcs_host_options load = lrcs_host_options_default();
    lrcs_run_options options = lrcs_run_options_default();
    lrcs_host_scene scene;
    lrcs_host_explained explained;
    const lrcs_pose pose = lrcs_pose_default();
    lrcs_result result = {0};
    memset(&scene, 0, sizeof scene);
    assert_int_equal(lrcs_host_scene_read("demo", &load, &scene, &error), LRCS_OK);
    assert_int_equal(lrcs_host_scene_prepare(&scene, &error), LRCS_OK);
    options.tolerance = -1.0;
    assert_int_equal(lrcs_host_explain(&scene, &pose, &options, &result, NULL, &explained, &error),
                     LRCS_E_ARGUMENT);
    lrcs_host_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_effect_is_flipped_by_a_run_of_its_own),
        cmocka_unit_test(a_pose_that_cannot_be_run_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
