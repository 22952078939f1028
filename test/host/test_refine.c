/* SPDX-License-Identifier: MIT */
/* Curved shapes divided as finely as each pose needs: every pose meets its tolerance, the answers
   of all tolerances agree within their bounds, and neither the order of the poses nor the number of
   threads changes a bit. */
#include <lrcs/sweep.h>

#include "check.h"

#define POSES 12u

static lrcs_host_error error;

static void scene_make(lrcs_host_scene *scene, const char *path, double division,
                       const unsigned char *halvings)
{
    lrcs_host_options options = lrcs_host_options_default();
    options.build.division = division;
    options.build.halvings = halvings;
    assert_int_equal(lrcs_host_scene_read(path, &options, scene, &error), LRCS_OK);
    assert_int_equal(lrcs_host_scene_prepare(scene, &error), LRCS_OK);
}

/* The same at the host's division, with a limit for the facets of one shape. */
static void scene_make_limited(lrcs_host_scene *scene, const char *path, uint32_t max_facets)
{
    lrcs_host_options options = lrcs_host_options_default();
    options.build.division = LRCS_HOST_DIVISION;
    options.build.max_facets = max_facets;
    assert_int_equal(lrcs_host_scene_read(path, &options, scene, &error), LRCS_OK);
    assert_int_equal(lrcs_host_scene_prepare(scene, &error), LRCS_OK);
}

static int pose_at(void *context, uint64_t index, lrcs_pose *pose)
{
    (void)context;
    return lrcs_pose_from_azel(31.0 * (double)index, 14.0 * (double)index - 80.0, pose);
}

static int result_take(void *context, uint64_t index, const lrcs_pose *pose,
                       const lrcs_result *result, const lrcs_uncertainty *uncertainty,
                       const lrcs_host_glint_sum *glint, lrcs_host_error *failed)
{
    lrcs_result *results = context;
    (void)pose;
    (void)uncertainty;
    (void)glint;
    (void)failed;
    results[index] = *result;
    return LRCS_OK;
}

static void sweep_run(const lrcs_host_scene *scene, double tolerance, uint64_t first,
                      uint64_t count, uint32_t threads, lrcs_result results[POSES])
{
    lrcs_run_options options = lrcs_run_options_default();
    options.tolerance = tolerance;
    lrcs_host_sweep sweep = {.first = first,
                             .count = count,
                             .threads = threads,
                             .pose = pose_at,
                             .take = result_take,
                             .refine = 1,
                             .context = results};
    assert_int_equal(lrcs_host_sweep_run(scene, &options, &sweep, NULL, &error), LRCS_OK);
}

/* Two answers are the same in every bit, on as many facets. */
static void check_same_answer(const lrcs_result *a, const lrcs_result *b)
{
    assert_memory_equal(&a->sigma_m2, &b->sigma_m2, sizeof(double));
    assert_memory_equal(&a->bound_m2, &b->bound_m2, sizeof(double));
    assert_int_equal(a->facets_total, b->facets_total);
}

static void every_pose_meets_its_tolerance_and_all_of_them_agree(void **state)
{
    (void)state;
    static const double tolerance[] = {1e-1, 1e-3, 1e-4, 1e-5, 1e-7};
    lrcs_result results[5][POSES];
    lrcs_host_scene scene;
    scene_make(&scene, "demo", LRCS_HOST_DIVISION, NULL);
    for (int t = 0; t < 5; t++) {
        sweep_run(&scene, tolerance[t], 0, POSES, 1, results[t]);
        for (int i = 0; i < (int)POSES; i++) {
            const lrcs_result *r = &results[t][i];
            const lrcs_result *finest = &results[4][i];
            assert_false(r->flags & LRCS_FLAG_TOLERANCE_NOT_MET);
            check_most(r->bound_m2, tolerance[t] * r->sigma_m2);
            if (t == 4) {
                for (int k = 0; k < 4; k++) {
                    check_abs(results[k][i].sigma_m2, finest->sigma_m2,
                              results[k][i].bound_m2 + finest->bound_m2);
                }
            }
        }
    }
    assert_true(results[0][0].facets_total < results[4][0].facets_total);
    lrcs_host_scene_free(&scene);
}

static void order_and_threads_change_nothing(void **state)
{
    (void)state;
    lrcs_result all[POSES];
    lrcs_result other[POSES];
    for (int way = 0; way < 3; way++) {
        lrcs_host_scene scene;
        scene_make(&scene, "demo", LRCS_HOST_DIVISION, NULL);
        if (way == 1) { /* the last ones first */
            sweep_run(&scene, 1e-5, POSES / 2, POSES / 2, 1, other);
            sweep_run(&scene, 1e-5, 0, POSES / 2, 1, other);
        } else {
            sweep_run(&scene, 1e-5, 0, POSES, way == 0 ? 1 : 3, way == 0 ? all : other);
        }
        for (int i = 0; way > 0 && i < (int)POSES; i++) {
            check_same_answer(&all[i], &other[i]);
        }
        lrcs_host_scene_free(&scene);
    }
}

/* A pose after others has the division that it has alone, in a scene of its own. */
static void a_pose_does_not_depend_on_poses_before_it(void **state)
{
    (void)state;
    lrcs_result all[POSES];
    lrcs_result alone[POSES];
    lrcs_host_scene scene;
    scene_make(&scene, "demo", LRCS_HOST_DIVISION, NULL);
    sweep_run(&scene, 1e-6, 0, POSES, 1, all);
    lrcs_host_scene_free(&scene);
    for (uint32_t i = 0; i < POSES; i++) {
        scene_make(&scene, "demo", LRCS_HOST_DIVISION, NULL);
        sweep_run(&scene, 1e-6, i, 1, 1, alone);
        lrcs_host_scene_free(&scene);
        check_same_answer(&all[i], &alone[i]);
    }
}

/* More levels than are kept; those that were freed are built again, the same. */
static void levels_come_and_go_without_a_trace(void **state)
{
    (void)state;
    enum { TOLERANCES = 20 };
    static lrcs_result first[TOLERANCES][POSES];
    lrcs_result again[POSES];
    uint32_t total[TOLERANCES * POSES];
    uint32_t levels = 0;
    lrcs_host_scene scene;
    scene_make(&scene, "demo", LRCS_HOST_DIVISION, NULL);
    for (int t = 0; t < TOLERANCES; t++) {
        sweep_run(&scene, 1e-3 * pow(0.55, t), 0, POSES, 1, first[t]);
        for (uint32_t i = 0; i < POSES; i++) {
            uint32_t k = 0;
            total[levels] = first[t][i].facets_total;
            while (total[k] != total[levels]) {
                k++;
            }
            levels += k == levels; /* other numbers of facets: other levels */
        }
    }
    assert_true(levels > 1 + 32); /* the scene's own, and those that are kept */
    for (int t = 0; t < TOLERANCES; t += 5) {
        sweep_run(&scene, 1e-3 * pow(0.55, t), 0, POSES, 1, again);
        for (uint32_t i = 0; i < POSES; i++) {
            check_same(again[i].sigma_m2, first[t][i].sigma_m2);
            check_same(again[i].bound_m2, first[t][i].bound_m2);
            assert_int_equal(again[i].facets_total, first[t][i].facets_total);
        }
    }
    lrcs_host_scene_free(&scene);
}

static void run(const lrcs_host_scene *scene, const lrcs_pose *pose,
                const lrcs_run_options *options, lrcs_result *result)
{
    assert_int_equal(lrcs_host_scene_run(scene, pose, options, result, NULL, NULL, NULL, &error),
                     LRCS_OK);
}

/* Runs a pose and refines the scene as long as that helps; returns how often it did. With
   `by_part`, only the parts to which the error is due. */
static int refine(lrcs_host_scene *scene, const lrcs_pose *pose, const lrcs_run_options *given,
                  int by_part, lrcs_result *result, lrcs_build_options *build)
{
    double part_error[64];
    lrcs_run_options options = *given;
    int times = 0;
    assert_true(scene->scene.part_count <= 64);
    options.part_error_m2 = by_part ? part_error : NULL;
    run(scene, pose, &options, result);
    while (lrcs_host_scene_refine(scene, &options, result, options.part_error_m2, build)) {
        run(scene, pose, &options, result);
        times++;
    }
    return times;
}

/* The sum of the parts' halvings. */
static int halvings_sum(const lrcs_host_scene *scene, const lrcs_build_options *build)
{
    int sum = 0;
    for (uint32_t i = 0; build->halvings && i < scene->scene.part_count; i++) {
        sum += build->halvings[i];
    }
    return sum;
}

/* The scene becomes the one of the halvings that it needs, in all that is made of it, notices too,
   which count the facets without a material. */
static void check_becomes(const char *path, int by_part)
{
    lrcs_host_scene scene;
    lrcs_host_scene fine;
    lrcs_pose pose;
    lrcs_result result;
    lrcs_result again;
    lrcs_build_options build = lrcs_build_options_default();
    lrcs_run_options options = lrcs_run_options_default();
    options.tolerance = 1e-7;
    assert_int_equal(lrcs_pose_from_azel(30, 20, &pose), LRCS_OK);
    scene_make(&scene, path, LRCS_HOST_DIVISION, NULL);
    uint32_t coarse = scene.scene.facet_count;
    assert_true(refine(&scene, &pose, &options, by_part, &result, &build) > 0);
    int halvings = halvings_sum(&scene, &build);
    assert_true(halvings > 0);
    assert_false(result.flags & LRCS_FLAG_TOLERANCE_NOT_MET);
    assert_true(scene.scene.facet_count > coarse && result.facets_total > coarse);
    scene_make(&fine, path, LRCS_HOST_DIVISION, build.halvings);
    run(&fine, &pose, &options, &again);
    assert_true(result.sigma_m2 == again.sigma_m2 && result.bound_m2 == again.bound_m2);
    assert_true(lrcs_scene_hash(&scene.scene) == lrcs_scene_hash(&fine.scene));
    assert_int_equal(scene.notices.count, fine.notices.count);
    for (uint32_t i = 0; i < fine.notices.count; i++) {
        assert_string_equal(scene.notices.text[i], fine.notices.text[i]);
    }
    options.tolerance = 1e-9; /* from there on */
    assert_true(refine(&scene, &pose, &options, by_part, &result, &build) > 0);
    assert_true(halvings_sum(&scene, &build) > halvings);
    assert_false(result.flags & LRCS_FLAG_TOLERANCE_NOT_MET);
    assert_true(scene.scene.facet_count > fine.scene.facet_count);
    lrcs_host_scene_free(&fine);
    lrcs_host_scene_free(&scene);
}

static void a_scene_becomes_the_one_that_meets_the_tolerance(void **state)
{
    (void)state;
    check_becomes("demo", 1);
    check_becomes("demo", 0);
    check_becomes("test/host/refine_unbound.toml", 1);
}

/* Refines a scene for a tolerance from one direction. max_facets: of one shape, or 0. Returned: how
   often. */
static int refine_from(const char *path, double az, double el, double tolerance,
                       uint32_t max_facets, lrcs_host_scene *scene, lrcs_result *result,
                       lrcs_build_options *build)
{
    lrcs_pose pose;
    lrcs_run_options options = lrcs_run_options_default();
    options.tolerance = tolerance;
    *build = lrcs_build_options_default();
    assert_int_equal(lrcs_pose_from_azel(az, el, &pose), LRCS_OK);
    scene_make_limited(scene, path, max_facets ? max_facets : build->max_facets);
    return refine(scene, &pose, &options, 1, result, build);
}

/* The scene of three parts (a cylinder, its mast, a dome) for a tolerance of 1e-6. */
static int refine_parts(double az, double el, uint32_t max_facets, lrcs_host_scene *scene,
                        lrcs_result *result, lrcs_build_options *build)
{
    return refine_from("test/host/refine_parts.toml", az, el, 1e-6, max_facets, scene, result,
                       build);
}

/* A platform on a drum, seen from slightly below: the rim of the drum hides the lower end of the
   platform's wall, and the two touch there. What rounding leaves open where they do is a fraction of
   the wall that does not grow with the number of its facets: else no division meets 1e-9. */
static void parts_that_touch_meet_a_small_tolerance(void **state)
{
    (void)state;
    lrcs_host_scene scene;
    lrcs_result result;
    lrcs_build_options build;
    assert_true(refine_from("test/host/stacked.toml", 20, -1, 1e-9, 0, &scene, &result, &build) >
                0);
    assert_false(result.flags & LRCS_FLAG_TOLERANCE_NOT_MET);
    assert_true(scene.scene.facet_count < 200000);
    lrcs_host_scene_free(&scene);
}

/* Parts whose facets add nothing to the bound keep their facets. A mast hides some of a cylinder; a
   dome far away from both is seen as a whole. */
static void only_the_parts_that_the_error_is_due_to_are_divided(void **state)
{
    (void)state;
    lrcs_host_scene scene;
    lrcs_result result;
    lrcs_build_options build;
    assert_true(refine_parts(0, 20, 0, &scene, &result, &build) > 0);
    assert_false(result.flags & LRCS_FLAG_TOLERANCE_NOT_MET);
    assert_true(build.halvings[0] > 0); /* the cylinder */
    assert_int_equal(build.halvings[1], 0);
    assert_int_equal(build.halvings[2], 0);
    lrcs_host_scene_free(&scene);
}

/* The forecast of a part's error fits its kind: one refinement suffices, and the bound that it gives
   is not much smaller than the tolerance. From the first direction the error is due to the
   cylinder, behind the mast; from the second one to the dome, behind the cylinder. With one factor
   of 0.45 for both kinds the dome is halved once more, into twice the facets, or more often. */
static void one_refinement_meets_the_tolerance_without_excess(void **state)
{
    (void)state;
    static const double azel[2][2] = {{5.0, 20.0}, {-80.0, 10.0}};
    for (int i = 0; i < 2; i++) {
        lrcs_host_scene scene;
        lrcs_result result;
        lrcs_build_options build;
        assert_int_equal(refine_parts(azel[i][0], azel[i][1], 0, &scene, &result, &build), 1);
        assert_false(result.flags & LRCS_FLAG_TOLERANCE_NOT_MET);
        assert_true(build.halvings[i == 0 ? 0 : 2] > 0);
        check_most(0.25 * 1e-6 * result.sigma_m2, result.bound_m2);
        lrcs_host_scene_free(&scene);
    }
}

/* A round body that needs a few more facets than one shape may have is divided as finely as the
   limit permits. Here twice its facets are 1.2 times the limit. */
static void a_round_body_is_divided_up_to_the_limit_of_facets(void **state)
{
    (void)state;
    lrcs_host_scene scene;
    lrcs_result result;
    lrcs_build_options build;
    scene_make(&scene, "test/host/refine_parts.toml", LRCS_HOST_DIVISION, NULL);
    uint32_t coarse = scene.scene.part[2].facet_count; /* the dome */
    lrcs_host_scene_free(&scene);
    uint32_t most = 5 * coarse / 3;
    scene_make_limited(&scene, "test/host/refine_parts.toml", most);
    assert_int_equal(scene.scene.part[2].facet_count, coarse);
    lrcs_host_scene_free(&scene);
    assert_true(refine_parts(-90, 10, most, &scene, &result, &build) > 0);
    assert_int_equal(build.halvings[2], 1);
    assert_true(scene.scene.part[2].facet_count > 4 * coarse / 3);
    assert_true(scene.scene.part[2].facet_count <= most);
    lrcs_host_scene_free(&scene);
}

/* Where facets are not what a bound comes from, dividing them further is no use. */
static void a_limit_of_steps_or_no_division_leaves_the_scene_as_it_is(void **state)
{
    (void)state;
    lrcs_host_scene scene;
    lrcs_pose pose;
    lrcs_result result;
    lrcs_build_options build = lrcs_build_options_default();
    lrcs_run_options options = lrcs_run_options_default();
    options.tolerance = 1e-9;
    options.steps = 10;
    assert_int_equal(lrcs_pose_from_azel(30, 20, &pose), LRCS_OK);
    for (int divided = 0; divided < 2; divided++) {
        scene_make(&scene, "demo", divided ? LRCS_HOST_DIVISION : 0, NULL);
        uint32_t facets = scene.scene.facet_count;
        assert_true((scene.levels != NULL) == divided);
        assert_int_equal(refine(&scene, &pose, &options, divided, &result, &build), 0);
        assert_true(!build.halvings && scene.scene.facet_count == facets);
        lrcs_host_scene_free(&scene);
    }
}

/* Where rounding alone exceeds the tolerance, shapes are divided until their error is no larger: a
   stricter tolerance never gives a wider bound. */
static void a_tolerance_below_rounding_still_divides(void **state)
{
    (void)state;
    lrcs_host_scene scene;
    lrcs_pose pose;
    lrcs_result strict;
    lrcs_result loose;
    lrcs_build_options build = lrcs_build_options_default();
    lrcs_run_options options = lrcs_run_options_default();
    assert_int_equal(lrcs_pose_from_azel(30, 20, &pose), LRCS_OK);
    for (int strictly = 0; strictly < 2; strictly++) {
        options.tolerance = strictly ? 1e-20 : 1e-6;
        scene_make_limited(&scene, "demo", 4096);
        refine(&scene, &pose, &options, 1, strictly ? &strict : &loose, &build);
        lrcs_host_scene_free(&scene);
    }
    check_most(strict.bound_m2, loose.bound_m2);
}

/* A tolerance that even the finest divisions miss: the parts are divided as finely as they may be,
   once or twice, and not again and again for the little that other parts would still gain. */
static void a_tolerance_out_of_reach_is_given_up_soon(void **state)
{
    (void)state;
    lrcs_host_scene scene;
    lrcs_pose pose;
    lrcs_result result;
    lrcs_build_options build = lrcs_build_options_default();
    lrcs_run_options options = lrcs_run_options_default();
    options.tolerance = 1e-7;
    assert_int_equal(lrcs_pose_from_azel(30, 20, &pose), LRCS_OK);
    scene_make_limited(&scene, "examples/satellites/lander.toml", 4096);
    int times = refine(&scene, &pose, &options, 1, &result, &build);
    assert_true(times == 1 || times == 2);
    assert_true(result.flags & LRCS_FLAG_TOLERANCE_NOT_MET);
    assert_true(halvings_sum(&scene, &build) > 0);
    lrcs_host_scene_free(&scene);
}

/* At this resolution the proof of a raster takes more than the tolerance, its estimate does not:
   only where that is accepted is there something left for finer facets. */
static void an_accepted_estimate_leaves_room_for_finer_facets(void **state)
{
    (void)state;
    lrcs_pose pose;
    lrcs_result result;
    lrcs_run_options options = lrcs_run_options_default();
    options.method = LRCS_METHOD_ZBUFFER;
    options.resolution = 1024;
    options.tolerance = 4e-3;
    assert_int_equal(lrcs_pose_from_azel(0, 20, &pose), LRCS_OK);
    for (int accept = LRCS_ACCEPT_BOUND; accept <= LRCS_ACCEPT_ESTIMATE; accept++) {
        lrcs_host_scene scene;
        lrcs_build_options build = lrcs_build_options_default();
        options.accept = accept;
        scene_make(&scene, "test/host/refine_parts.toml", 0.1, NULL);
        int times = refine(&scene, &pose, &options, 1, &result, &build);
        int estimated = accept == LRCS_ACCEPT_ESTIMATE;
        assert_int_equal(times > 0, estimated);
        assert_int_equal(!(result.flags & LRCS_FLAG_TOLERANCE_NOT_MET), estimated);
        assert_int_equal((result.flags & LRCS_FLAG_ACCEPTED_BY_ESTIMATE) != 0, estimated);
        check_most(options.tolerance * result.sigma_m2, result.bound_m2);
        lrcs_host_scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_pose_meets_its_tolerance_and_all_of_them_agree),
        cmocka_unit_test(order_and_threads_change_nothing),
        cmocka_unit_test(a_pose_does_not_depend_on_poses_before_it),
        cmocka_unit_test(levels_come_and_go_without_a_trace),
        cmocka_unit_test(a_scene_becomes_the_one_that_meets_the_tolerance),
        cmocka_unit_test(parts_that_touch_meet_a_small_tolerance),
        cmocka_unit_test(only_the_parts_that_the_error_is_due_to_are_divided),
        cmocka_unit_test(one_refinement_meets_the_tolerance_without_excess),
        cmocka_unit_test(a_round_body_is_divided_up_to_the_limit_of_facets),
        cmocka_unit_test(an_accepted_estimate_leaves_room_for_finer_facets),
        cmocka_unit_test(a_limit_of_steps_or_no_division_leaves_the_scene_as_it_is),
        cmocka_unit_test(a_tolerance_below_rounding_still_divides),
        cmocka_unit_test(a_tolerance_out_of_reach_is_given_up_soon),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
