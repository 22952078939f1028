/* SPDX-License-Identifier: MIT */
/* Poses divided as finely as they need, in one work area: the tolerance is met, the halvings say
   how, and less memory or fewer steps leave a wider bound that holds. */
#include <lrcs/lrcs.h>

#include <math.h>
#include <string.h>

#include "check.h"

enum { PARTS = 3, AREA = 3 << 26, DIRECTIONS = 3 };

static unsigned char area[AREA];
static lrcs_recipe_part part[PARTS];
static lrcs_recipe_material material;
static const double direction[DIRECTIONS][3] = {{0.3, 0.2, 1}, {0.5, 0.1, 0.9}, {0.1, 0.45, 1}};

/* A ball above a drum, on which its shadow falls, over a plate. */
static lrcs_recipe scene_of_three(void)
{
    material = (lrcs_recipe_material){.name = "skin", .brdf = {1, 0.25, 0.3, 0.5}};
    for (int i = 0; i < PARTS; i++) {
        part[i] = (lrcs_recipe_part){
            .name = "", .place = lrcs_place_default(), .material = "skin", .material_index = 0};
    }
    part[0].shape = (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 0.5};
    part[0].place.translate[2] = 1.25;
    part[1].shape = (lrcs_shape){.kind = LRCS_SHAPE_CYLINDER, .radius = 0.25, .length = 0.5};
    part[1].place.translate[0] = -0.375;
    part[1].place.translate[1] = -0.25;
    part[1].place.translate[2] = 0.25;
    part[2].shape = (lrcs_shape){.kind = LRCS_SHAPE_PLATE, .size = {3, 3}};
    return (lrcs_recipe){
        .part = part, .part_count = PARTS, .material = &material, .material_count = 1};
}

static lrcs_build_options divided(void)
{
    lrcs_build_options build = lrcs_build_options_default();
    build.division = 1e-2;
    return build;
}

/* Runs in so many bytes. Whatever happens, all of them are given back. */
static int run_in(size_t bytes, const lrcs_build_options *build, const double d[3],
                  const lrcs_run_options *options, lrcs_result *result,
                  unsigned char halvings[PARTS])
{
    const lrcs_recipe recipe = scene_of_three();
    lrcs_work work = lrcs_work_make(area, bytes);
    lrcs_pose pose;
    memset(halvings, 0, PARTS);
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    int status = lrcs_refine_run(&recipe, NULL, build, &pose, options, &work, result, halvings);
    assert_true(work.used == 0);
    return status;
}

/* The answer of one build with given halvings. */
static lrcs_result run_once(const unsigned char *halvings, const double d[3],
                            const lrcs_run_options *options)
{
    const lrcs_recipe recipe = scene_of_three();
    lrcs_build_options build = divided();
    lrcs_work work = lrcs_work_make(area, AREA);
    const lrcs_prepared *prepared;
    lrcs_scene scene;
    lrcs_pose pose;
    lrcs_result result;
    build.halvings = halvings;
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &build, &work, &scene, NULL), LRCS_OK);
    assert_int_equal(lrcs_prepare_run(&scene, &work, &prepared), LRCS_OK);
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    assert_int_equal(lrcs_sigma_run(prepared, &pose, options, &work, &result, NULL, NULL), LRCS_OK);
    return result;
}

static void a_pose_is_divided_until_it_meets_the_tolerance(void **state)
{
    (void)state;
    for (int i = 0; i < DIRECTIONS; i++) {
        static const unsigned char fine[PARTS] = {4, 6, 0};
        lrcs_run_options options = lrcs_run_options_default();
        const lrcs_result truth = run_once(fine, direction[i], &options);
        uint32_t facets = 0;
        for (double tolerance = 1e-3; tolerance > 1e-8; tolerance *= 0.1) {
            unsigned char halvings[PARTS];
            lrcs_build_options build = divided();
            lrcs_result result;
            options.tolerance = tolerance;
            assert_int_equal(run_in(AREA, &build, direction[i], &options, &result, halvings),
                             LRCS_OK);
            check_most(result.bound_m2, tolerance * result.sigma_m2);
            check_abs(result.sigma_m2, truth.sigma_m2, result.bound_m2 + truth.bound_m2);
            assert_int_equal(result.flags & LRCS_FLAG_TOLERANCE_NOT_MET, 0);
            assert_true(result.facets_total >= facets);
            facets = result.facets_total;
            assert_int_equal(halvings[2], 0); /* a plate is exact */
            const lrcs_result again = run_once(halvings, direction[i], &options);
            check_same(again.sigma_m2, result.sigma_m2);
            check_same(again.bound_m2, result.bound_m2);
        }
        assert_true(facets > 4000); /* far more than the first 1,200 or so */
    }
}

static void without_a_division_nothing_is_divided_again(void **state)
{
    (void)state;
    lrcs_build_options build = lrcs_build_options_default();
    lrcs_run_options options = lrcs_run_options_default();
    unsigned char halvings[PARTS];
    lrcs_result result;
    build.tolerance = 1e-2;
    options.tolerance = 1e-9;
    assert_int_equal(run_in(AREA, &build, direction[0], &options, &result, halvings), LRCS_OK);
    assert_true(result.flags & LRCS_FLAG_TOLERANCE_NOT_MET);
    for (int i = 0; i < PARTS; i++) {
        assert_int_equal(halvings[i], 0);
    }
}

/* In less and less memory: an answer with a wider bound, and its flag, until the first division
   does not fit. */
static void less_memory_widens_the_bound(void **state)
{
    (void)state;
    const lrcs_build_options build = divided();
    lrcs_run_options options = lrcs_run_options_default();
    unsigned char halvings[PARTS];
    lrcs_result best;
    int wider = 0;
    int refused = 0;
    options.tolerance = 1e-7;
    assert_int_equal(run_in(AREA, &build, direction[1], &options, &best, halvings), LRCS_OK);
    for (size_t bytes = AREA / 2; bytes > 1000; bytes -= bytes / 4) {
        lrcs_result result;
        memset(&result, 0x5a, sizeof result);
        int status = run_in(bytes, &build, direction[1], &options, &result, halvings);
        if (status != LRCS_OK) {
            assert_int_equal(status, LRCS_E_MEMORY);
            refused++;
            continue;
        }
        assert_int_equal(refused, 0); /* what fits in less fits in more */
        check_abs(result.sigma_m2, best.sigma_m2, result.bound_m2 + best.bound_m2);
        const int missed = result.bound_m2 > options.tolerance * result.sigma_m2;
        assert_int_equal((result.flags & LRCS_FLAG_TOLERANCE_NOT_MET) != 0, missed);
        wider += missed;
    }
    assert_true(wider > 3 && refused > 3);
}

static void a_limit_of_steps_widens_the_bound(void **state)
{
    (void)state;
    const lrcs_build_options build = divided();
    lrcs_run_options options = lrcs_run_options_default();
    unsigned char halvings[PARTS];
    lrcs_result best;
    options.tolerance = 1e-5;
    assert_int_equal(run_in(AREA, &build, direction[2], &options, &best, halvings), LRCS_OK);
    for (uint64_t steps = 1; steps < 2 * best.steps; steps *= 3) {
        lrcs_result result;
        options.steps = steps;
        assert_int_equal(run_in(AREA, &build, direction[2], &options, &result, halvings), LRCS_OK);
        assert_true(result.steps <= steps);
        check_abs(result.sigma_m2, best.sigma_m2, result.bound_m2 + best.bound_m2);
        assert_true(isfinite(result.bound_m2));
    }
}

static void errors_of_the_first_division_are_returned(void **state)
{
    (void)state;
    lrcs_build_options build = divided();
    lrcs_run_options options = lrcs_run_options_default();
    unsigned char halvings[PARTS];
    lrcs_result result;
    options.tolerance = -1;
    assert_int_equal(run_in(AREA, &build, direction[0], &options, &result, halvings),
                     LRCS_E_ARGUMENT);
    options.tolerance = 1e-4;
    build.max_facets = 1;
    assert_int_equal(run_in(AREA, &build, direction[0], &options, &result, halvings),
                     LRCS_E_ARGUMENT);
}

/* Without the errors of parts all curved ones have the same; without memory nothing is chosen. */
static void halvings_are_chosen_for_a_result(void **state)
{
    (void)state;
    static unsigned char room[1024];
    const lrcs_recipe recipe = scene_of_three();
    const lrcs_build_options build = divided();
    lrcs_run_options options = lrcs_run_options_default();
    lrcs_work work = lrcs_work_make(area, AREA);
    unsigned char halvings[PARTS] = {0, 0, 0};
    lrcs_scene scene;
    lrcs_result result;
    options.tolerance = 1e-7;
    result = run_once(halvings, direction[0], &options);
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &build, &work, &scene, NULL), LRCS_OK);
    assert_true(lrcs_refine_need(PARTS) <= sizeof room);
    for (size_t bytes = 0; bytes < lrcs_refine_need(PARTS); bytes += 16) {
        lrcs_work little = lrcs_work_make(room, bytes);
        int finer =
            lrcs_refine_halvings(&scene, &build, &options, &result, NULL, &little, halvings);
        assert_true(little.used == 0);
        assert_int_equal(finer, halvings[0] > 0);
        memset(halvings, 0, sizeof halvings);
    }
    lrcs_work enough = lrcs_work_make(room, lrcs_refine_need(PARTS));
    assert_int_equal(
        lrcs_refine_halvings(&scene, &build, &options, &result, NULL, &enough, halvings), 1);
    assert_true(halvings[0] > 0 && halvings[1] > 0 && halvings[2] == 0);
    result.flags &= ~(uint32_t)LRCS_FLAG_TOLERANCE_NOT_MET;
    memset(halvings, 0, sizeof halvings);
    assert_int_equal(
        lrcs_refine_halvings(&scene, &build, &options, &result, NULL, &enough, halvings), 0);
    assert_int_equal(halvings[0], 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pose_is_divided_until_it_meets_the_tolerance),
        cmocka_unit_test(without_a_division_nothing_is_divided_again),
        cmocka_unit_test(less_memory_widens_the_bound),
        cmocka_unit_test(a_limit_of_steps_widens_the_bound),
        cmocka_unit_test(errors_of_the_first_division_are_returned),
        cmocka_unit_test(halvings_are_chosen_for_a_result),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
