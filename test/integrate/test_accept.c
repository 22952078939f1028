/* SPDX-License-Identifier: MIT */
/* What counts as meeting a tolerance: the bound, the likely error of a raster, or anything. Answers
   that are accepted without a proof say so, and are those of the raster that they name. */
#include "scenes.h"

static test_scene scene;

/* A bus, a panel beside it, a ball in front of both and a louvre around them: shadows with straight
   and with curved borders, many of them. */
static void shadows_about(uint32_t meridians)
{
    scene_start(&scene);
    scene_box(&scene, (const double[3]){-1, -1, -1}, (const double[3]){1, 1, 1});
    scene_plate(&scene, (const double[3]){1.3, -0.7, 0.1}, (const double[3]){2, 0.1, 0},
                (const double[3]){0.1, 1.5, 0.2});
    scene_sphere(&scene, (const double[3]){0.9, 0.3, 2.2}, 0.7, meridians);
    for (int i = 0; i < 40; i++) {
        scene_plate(&scene, (const double[3]){-2 + 0.13 * i, -2 + 0.01 * i, 3 - 0.02 * i},
                    (const double[3]){0.06, 0.01, 0.02}, (const double[3]){0.1, 4, -0.1});
    }
}

static void shadows(void)
{
    shadows_about(24);
}

static lrcs_result answer(const lrcs_prepared *prepared, lrcs_work *work, const double d[3],
                          const lrcs_run_options *options)
{
    lrcs_pose pose;
    lrcs_result r;
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    assert_int_equal(lrcs_sigma_run(prepared, &pose, options, work, &r, NULL, NULL), LRCS_OK);
    return r;
}

static int same_numbers(const lrcs_result *a, const lrcs_result *b)
{
    return a->sigma_m2 == b->sigma_m2 && a->bound_m2 == b->bound_m2 &&
           a->estimate_m2 == b->estimate_m2 && a->resolution == b->resolution;
}

#define VERDICTS                                                                                   \
    (LRCS_FLAG_TOLERANCE_NOT_MET | LRCS_FLAG_ACCEPTED_BY_ESTIMATE | LRCS_FLAG_ACCEPTED_UNJUDGED)

/* --- auto ------------------------------------------------------------------------------------- */

/* Over many directions and tolerances every outcome occurs, and the flags state it each time. */
static void estimates_are_flagged_and_are_those_of_the_raster_they_name(void **state)
{
    (void)state;
    static const double tolerance[] = {0.9, 0.1, 1e-2, 3e-3, 1e-4, 1e-6};
    int flagged = 0;
    int clipped = 0;
    lrcs_work work;
    shadows_about(44);
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    for (int i = 0; i < 60; i++) {
        const double d[3] = {cos(i), sin(i), 0.9 * sin(0.7 * i)};
        lrcs_run_options options = lrcs_run_options_default();
        lrcs_run_options plain = options;
        options.tolerance = tolerance[i % 6];
        options.accept = LRCS_ACCEPT_ESTIMATE;
        lrcs_result r = answer(prepared, &work, d, &options);
        double most = options.tolerance * r.sigma_m2;
        plain.method = r.method;
        plain.resolution = r.resolution;
        plain.accept = LRCS_ACCEPT_ESTIMATE;
        lrcs_result again = answer(prepared, &work, d, &plain);
        assert_true(same_numbers(&r, &again));
        plain.accept = LRCS_ACCEPT_BOUND;
        plain.method = LRCS_METHOD_EXACT;
        plain.resolution = 0;
        lrcs_result truth = answer(prepared, &work, d, &plain);
        check_abs(r.sigma_m2, truth.sigma_m2, r.bound_m2 + truth.bound_m2);
        if (r.bound_m2 <= most) {
            assert_int_equal(r.flags & VERDICTS, 0);
        } else if (r.method == LRCS_METHOD_ZBUFFER) {
            assert_int_equal(r.flags & VERDICTS, LRCS_FLAG_ACCEPTED_BY_ESTIMATE);
            assert_true(r.estimate_m2 >= 0 && r.estimate_m2 + r.budget.rounding_m2 <= most);
            flagged++;
        }
        clipped += r.method == LRCS_METHOD_EXACT;
    }
    assert_true(flagged >= 15 && clipped >= 10);
}

/* What needs no raster is proved, and not called an estimate. */
static void a_proof_that_costs_nothing_is_none_by_estimate(void **state)
{
    (void)state;
    static const double d[3] = {0.3, 0.2, 0.9};
    lrcs_work work;
    scene_start(&scene);
    scene_box(&scene, (const double[3]){-1, -1, -1}, (const double[3]){1, 1, 1});
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    for (int accept = LRCS_ACCEPT_BOUND; accept <= LRCS_ACCEPT_ANY; accept++) {
        lrcs_run_options options = lrcs_run_options_default();
        options.accept = accept;
        lrcs_result r = answer(prepared, &work, d, &options);
        assert_int_equal(r.method, LRCS_METHOD_FACET);
        assert_int_equal(r.flags, 0);
    }
}

static void coarser_tolerances_are_met_by_coarser_rasters(void **state)
{
    (void)state;
    static const double d[3] = {0.5, 0.3, 0.8};
    uint32_t last = 0;
    lrcs_work work;
    shadows_about(44);
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    for (double tolerance = 0.1; tolerance > 0.5e-3; tolerance /= 2) {
        lrcs_run_options options = lrcs_run_options_default();
        options.tolerance = tolerance;
        options.accept = LRCS_ACCEPT_ESTIMATE;
        lrcs_result r = answer(prepared, &work, d, &options);
        uint32_t size = r.resolution == 0 ? UINT32_MAX : r.resolution;
        assert_true(size >= last);
        last = size;
    }
    assert_true(last > 256);
}

/* --- rasters that were asked for -------------------------------------------------------------- */

static void every_method_is_judged_alike(void **state)
{
    (void)state;
    static const double d[3] = {0.5, 0.3, 0.8};
    static const uint32_t want[] = {LRCS_FLAG_TOLERANCE_NOT_MET, LRCS_FLAG_ACCEPTED_BY_ESTIMATE,
                                    LRCS_FLAG_ACCEPTED_BY_ESTIMATE};
    lrcs_work work;
    shadows();
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    for (int accept = LRCS_ACCEPT_BOUND; accept <= LRCS_ACCEPT_ANY; accept++) {
        lrcs_run_options options = {
            .tolerance = 0.02, .method = LRCS_METHOD_ZBUFFER, .resolution = 256, .accept = accept};
        assert_int_equal(answer(prepared, &work, d, &options).flags & VERDICTS, want[accept]);
        options.method = LRCS_METHOD_FACET; /* no estimate */
        options.resolution = 0;
        assert_int_equal(answer(prepared, &work, d, &options).flags & VERDICTS,
                         accept == LRCS_ACCEPT_ANY ? LRCS_FLAG_ACCEPTED_UNJUDGED
                                                   : LRCS_FLAG_TOLERANCE_NOT_MET);
        options.method = LRCS_METHOD_EXACT;
        assert_int_equal(answer(prepared, &work, d, &options).flags & VERDICTS, 0);
    }
}

/* Samples alone prove little of many facets, and guess as well. Of few, the raster is the same. */
static void samples_alone_prove_less_and_guess_as_well(void **state)
{
    (void)state;
    static const double d[3] = {0.5, 0.3, 0.8};
    lrcs_work work;
    for (int many = 0; many < 2; many++) {
        shadows();
        if (many) {
            scene_sphere(&scene, (const double[3]){-1, 0.5, 1.5}, 0.8, 40);
        }
        const lrcs_prepared *prepared = scene_prepare(&scene, &work);
        lrcs_run_options options = {
            .tolerance = 0.02, .method = LRCS_METHOD_ZBUFFER, .resolution = 256};
        lrcs_result proved = answer(prepared, &work, d, &options);
        options.accept = LRCS_ACCEPT_ESTIMATE;
        lrcs_result guessed = answer(prepared, &work, d, &options);
        options.method = LRCS_METHOD_EXACT;
        lrcs_result truth = answer(prepared, &work, d, &options);
        int alone = truth.facets_total > 2000;
        assert_int_equal(alone, many);
        assert_int_equal(same_numbers(&proved, &guessed), !alone);
        assert_true(guessed.bound_m2 >= (alone ? 2 : 1) * proved.bound_m2);
        check_abs(guessed.sigma_m2, truth.sigma_m2, guessed.bound_m2);
        check_abs(guessed.sigma_m2, truth.sigma_m2, 0.01 * truth.sigma_m2);
        assert_true(guessed.estimate_m2 > 0 && guessed.estimate_m2 < 0.02 * truth.sigma_m2);
    }
}

/* A coarse raster that misses gives way to clipping, but not where anything is accepted. */
static void any_takes_the_first_raster(void **state)
{
    (void)state;
    static const double d[3] = {0.5, 0.3, 0.8};
    lrcs_work work;
    shadows();
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    lrcs_run_options options = {
        .tolerance = 1e-6, .resolution = 16, .accept = LRCS_ACCEPT_ESTIMATE};
    assert_int_equal(answer(prepared, &work, d, &options).method, LRCS_METHOD_EXACT);
    options.accept = LRCS_ACCEPT_ANY;
    lrcs_result r = answer(prepared, &work, d, &options);
    assert_int_equal(r.method, LRCS_METHOD_ZBUFFER);
    assert_int_equal(r.resolution, 16);
    assert_int_equal(r.flags & VERDICTS, LRCS_FLAG_ACCEPTED_UNJUDGED);
    options.tolerance = 1e-2;
    options.resolution = 0;
    r = answer(prepared, &work, d, &options);
    options.method = LRCS_METHOD_ZBUFFER;
    options.resolution = r.resolution;
    lrcs_result again = answer(prepared, &work, d, &options);
    assert_true(r.resolution > 16 && same_numbers(&r, &again));
}

/* Facet with self-shadowing is auto without rasters that guess; and of few facets no samples are
   taken alone, so that any answer is that of a raster with a proof. */
static void guesses_are_made_of_many_facets_only(void **state)
{
    (void)state;
    static const double d[3] = {0.5, 0.3, 0.8};
    lrcs_work work;
    scene_start(&scene);
    scene_box(&scene, (const double[3]){-1, -1, -1}, (const double[3]){1, 1, 1});
    scene_plate(&scene, (const double[3]){-0.5, -0.5, 2}, (const double[3]){0.7, 0, 0},
                (const double[3]){0, 0.6, 0});
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    lrcs_run_options options = lrcs_run_options_default();
    lrcs_result truth = answer(prepared, &work, d, &options);
    options.accept = LRCS_ACCEPT_ESTIMATE;
    options.tolerance = 0.01;
    lrcs_result r = answer(prepared, &work, d, &options);
    assert_true(same_numbers(&r, &truth));
    assert_string_equal(r.method_reason,
                        "few facets, or curved ones: a raster would save little time");
    options.accept = LRCS_ACCEPT_ANY;
    for (options.tolerance = 1; options.tolerance > 1e-9; options.tolerance *= 1e-5) {
        r = answer(prepared, &work, d, &options);
        lrcs_run_options plain = {
            .tolerance = 1, .method = LRCS_METHOD_ZBUFFER, .resolution = r.resolution};
        lrcs_result again = answer(prepared, &work, d, &plain);
        assert_int_equal(r.method, LRCS_METHOD_ZBUFFER);
        assert_true(same_numbers(&r, &again));
        check_abs(r.sigma_m2, truth.sigma_m2, r.bound_m2 + truth.bound_m2);
    }
    options = lrcs_run_options_default();
    options.method = LRCS_METHOD_FACET;
    options.accept = LRCS_ACCEPT_ESTIMATE;
    options.tolerance = 0.01;
    options.with = 1u << LRCS_EFFECT_SELF_SHADOWING;
    r = answer(prepared, &work, d, &options);
    assert_true(same_numbers(&r, &truth));
    assert_int_equal(r.method, LRCS_METHOD_EXACT);
}

/* With any amount of memory and steps, an answer's bound holds, and its flags say what did not
   suffice; no run fails with more memory if one succeeds with less. */
static void estimates_with_little_memory_and_few_steps_hold_the_truth(void **state)
{
    (void)state;
    static unsigned char little[24u << 20];
    static const double d[3] = {0.5, 0.3, 0.8};
    static const uint64_t steps[] = {0, 30000, 300000};
    lrcs_work work;
    lrcs_pose pose;
    shadows_about(40);
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    lrcs_run_options plain = lrcs_run_options_default();
    lrcs_result truth = answer(prepared, &work, d, &plain);
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    unsigned fallbacks = 0;
    unsigned clipped = 0;
    unsigned drawn = 0;
    for (int i = 0; i < 12; i++) {
        lrcs_run_options options = lrcs_run_options_default();
        options.accept = i / 6 ? LRCS_ACCEPT_ANY : LRCS_ACCEPT_ESTIMATE;
        options.tolerance = i / 3 % 2 ? 2e-4 : 0.02;
        options.steps = steps[i % 3];
        int before = LRCS_E_MEMORY;
        for (size_t size = 4096; size <= sizeof little; size += size / 12) {
            lrcs_result r;
            work = lrcs_work_make(little, size);
            int status = lrcs_sigma_run(prepared, &pose, &options, &work, &r, NULL, NULL);
            assert_true(status == LRCS_OK || (status == LRCS_E_MEMORY && before != LRCS_OK));
            assert_true(status == LRCS_OK || work.peak > size);
            before = status;
            if (status != LRCS_OK) {
                continue;
            }
            check_abs(r.sigma_m2, truth.sigma_m2, r.bound_m2 + truth.bound_m2);
            fallbacks += (r.flags & LRCS_FLAG_MEMORY_FALLBACK) != 0;
            clipped += r.method == LRCS_METHOD_EXACT;
            drawn += r.method == LRCS_METHOD_ZBUFFER;
            assert_true((r.flags & LRCS_FLAG_STEPS_SPENT) == 0 || options.steps != 0);
        }
        assert_int_equal(before, LRCS_OK);
    }
    assert_true(fallbacks > 10 && clipped > 10 && drawn > 10);
}

/* A limit of steps that was reached is reported as spent, unless clipping was only tried before a
   raster that is accepted: then the reason says it. Otherwise the limit has changed nothing. */
static void a_limit_of_steps_that_was_reached_is_named(void **state)
{
    (void)state;
    static const double d[3] = {0.5, 0.3, 0.8};
    lrcs_work work;
    lrcs_pose pose;
    shadows_about(40);
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    unsigned spent = 0;
    unsigned unspent = 0;
    unsigned drawn = 0;
    for (int i = 0; i < 4; i++) {
        lrcs_run_options options = lrcs_run_options_default();
        options.accept = LRCS_ACCEPT_ESTIMATE;
        options.tolerance = (const double[]){0.02, 1e-3, 2e-4, 1e-6}[i];
        lrcs_result whole = answer(prepared, &work, d, &options);
        for (options.steps = 100; options.steps < 4 * whole.steps;
             options.steps += 1 + options.steps / 16) {
            lrcs_result r = answer(prepared, &work, d, &options);
            check_abs(r.sigma_m2, whole.sigma_m2, r.bound_m2 + whole.bound_m2);
            assert_true(r.steps <= options.steps);
            if (r.flags & LRCS_FLAG_STEPS_SPENT) {
                assert_true((r.flags & LRCS_FLAG_ACCEPTED_BY_ESTIMATE) == 0);
                spent++;
                continue;
            }
            if (strcmp(r.method_reason,
                       "clipping was begun, and took more steps than the run has") == 0) {
                assert_int_equal(r.method, LRCS_METHOD_ZBUFFER);
                assert_true(r.flags == LRCS_FLAG_ACCEPTED_BY_ESTIMATE);
                drawn++;
                continue;
            }
            unspent++;
            assert_true(r.sigma_m2 == whole.sigma_m2 && r.bound_m2 == whole.bound_m2);
            assert_true(r.flags == whole.flags && r.steps == whole.steps);
            assert_string_equal(r.method_reason, whole.method_reason);
        }
    }
    assert_true(spent > 20 && unspent > 20 && drawn > 20);
}

/* --- estimates that know nothing -------------------------------------------------------------- */

/* Two black plates over a bright one, with a slit between them that is narrower than a pixel: no
   sample meets what is bright. */
static void where_no_sample_reflects_the_estimate_does_not_count(void **state)
{
    (void)state;
    static const double d[3] = {0, 0, 1};
    lrcs_work work;
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){-1, -1, 0}, (const double[3]){2, 0, 0},
                (const double[3]){0, 2, 0});
    scene_material(&scene, 0, 0, 0.2, 0);
    scene_plate(&scene, (const double[3]){-2, -2, 1}, (const double[3]){2.01, 0, 0},
                (const double[3]){0, 4, 0});
    scene_plate(&scene, (const double[3]){0.0101, -2, 1}, (const double[3]){2, 0, 0},
                (const double[3]){0, 4, 0});
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    lrcs_run_options options = {.tolerance = 0.5,
                                .method = LRCS_METHOD_ZBUFFER,
                                .resolution = 16,
                                .accept = LRCS_ACCEPT_ESTIMATE};
    lrcs_result r = answer(prepared, &work, d, &options);
    check_same(r.sigma_m2, 0.0);
    assert_true(r.bound_m2 > 0);
    assert_int_equal(r.flags & VERDICTS, LRCS_FLAG_TOLERANCE_NOT_MET);
    options.method = LRCS_METHOD_AUTO;
    options.resolution = 0;
    r = answer(prepared, &work, d, &options);
    double want = (double)scene_eq2(&scene.material[0].brdf, 2e-4L, 1);
    assert_int_equal(r.method, LRCS_METHOD_EXACT);
    check_rel(r.sigma_m2, want, 1e-10);
}

/* --- names ------------------------------------------------------------------------------------ */

static void names_and_numbers_go_both_ways(void **state)
{
    (void)state;
    assert_int_equal(lrcs_run_options_default().accept, LRCS_ACCEPT_BOUND);
    for (int accept = LRCS_ACCEPT_BOUND; accept <= LRCS_ACCEPT_ANY; accept++) {
        assert_int_equal(lrcs_accept_find(lrcs_accept_text(accept)), accept);
    }
    assert_string_equal(lrcs_accept_text(LRCS_ACCEPT_ESTIMATE), "estimate");
    assert_null(lrcs_accept_text(3));
    assert_string_equal(lrcs_progress_text(LRCS_PROGRESS_INTEGRATE), "integration");
    assert_null(lrcs_progress_text(LRCS_PROGRESS_INTEGRATE + 1));
    assert_null(lrcs_progress_text(-1));
    assert_null(lrcs_accept_text(-1));
    assert_int_equal(lrcs_accept_find("guess"), LRCS_E_NAME);
    assert_string_equal(lrcs_flag_text(LRCS_FLAG_ACCEPTED_BY_ESTIMATE), "accepted_by_estimate");
    assert_string_equal(lrcs_flag_text(LRCS_FLAG_ACCEPTED_UNJUDGED), "accepted_unjudged");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(estimates_are_flagged_and_are_those_of_the_raster_they_name),
        cmocka_unit_test(a_proof_that_costs_nothing_is_none_by_estimate),
        cmocka_unit_test(coarser_tolerances_are_met_by_coarser_rasters),
        cmocka_unit_test(every_method_is_judged_alike),
        cmocka_unit_test(samples_alone_prove_less_and_guess_as_well),
        cmocka_unit_test(any_takes_the_first_raster),
        cmocka_unit_test(guesses_are_made_of_many_facets_only),
        cmocka_unit_test(estimates_with_little_memory_and_few_steps_hold_the_truth),
        cmocka_unit_test(a_limit_of_steps_that_was_reached_is_named),
        cmocka_unit_test(where_no_sample_reflects_the_estimate_does_not_count),
        cmocka_unit_test(names_and_numbers_go_both_ways),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
