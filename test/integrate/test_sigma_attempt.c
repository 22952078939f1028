/* SPDX-License-Identifier: MIT */
/* Which attempts follow one another: the outcomes of attempts are made up here, so that nothing is
   searched for and nothing summed. */
#include "integrate/sigma_run.h"

#include <string.h>

#include "check.h"

static lrcs_run_options options;
static lrcsi_sigma run;
static lrcsi_attempts attempts;

/* A run before its first attempt. */
static void begin(int method, int planned)
{
    options = lrcs_run_options_default();
    options.method = method;
    memset(&run, 0, sizeof run);
    run.request = (lrcsi_sigma_request){.options = &options, .last = LRCSI_SIGMA_SUM};
    run.meter.limit = UINT64_MAX;
    run.plan = (lrcsi_plan){.method = planned, .size = 512, .reason = "planned"};
    run.classification.undecided_count = 1;
    attempts = (lrcsi_attempts){.current = {.method = LRCS_METHOD_AUTO}};
}

/* The last attempt ends with sigma = 1 and this bound, which is all visibility. */
static void end_with(double visibility)
{
    attempts.current.end = LRCSI_ATTEMPT_FOUND;
    run.outcome = (lrcsi_outcome){.method = attempts.current.method,
                                  .size = attempts.current.size,
                                  .total = {.glint = 1, .visibility = visibility}};
    run.outcome.total.error_estimate = visibility;
}

static void check_clipping(double limit_ns)
{
    assert_int_equal(lrcsi_attempts_next(&run, &attempts), 1);
    assert_int_equal(attempts.current.method, LRCS_METHOD_EXACT);
    check_same(attempts.current.limit_ns, limit_ns);
}

static void check_raster(uint32_t size)
{
    assert_int_equal(lrcsi_attempts_next(&run, &attempts), 1);
    assert_int_equal(attempts.current.method, LRCS_METHOD_ZBUFFER);
    assert_int_equal(attempts.current.size, size);
}

static void check_ended(void)
{
    assert_int_equal(lrcsi_attempts_next(&run, &attempts), 0);
}

/* --- tests ------------------------------------------------------------------------------------ */

static void nothing_follows_clipping(void **state)
{
    (void)state;
    begin(LRCS_METHOD_EXACT, LRCS_METHOD_EXACT);
    check_clipping(HUGE_VAL);
    assert_string_equal(attempts.current.reason, "planned");
    end_with(1); /* far from accepted */
    check_ended();
}

static void where_memory_is_short_one_raster_takes_the_place_of_clipping(void **state)
{
    (void)state;
    static const int method[] = {LRCS_METHOD_EXACT, LRCS_METHOD_AUTO};
    for (int i = 0; i < 2; i++) {
        begin(method[i], LRCS_METHOD_EXACT);
        run.plan.samples_only = i; /* in vain: there is a classification */
        check_clipping(HUGE_VAL);
        attempts.current.end = LRCSI_ATTEMPT_NO_MEMORY;
        check_raster(512);
        assert_true(attempts.current.fallback && !attempts.current.samples_only);
        end_with(1);
        run.outcome.flags = LRCS_FLAG_MEMORY_FALLBACK;
        check_ended();
    }
}

/* The next size is what the bound, which falls as 1/N, needs with a margin of 1.2; at least 1.5
   times the last one, a multiple of 64, and no more than the finest. */
static void rasters_become_finer_until_one_is_accepted(void **state)
{
    (void)state;
    begin(LRCS_METHOD_ZBUFFER, LRCS_METHOD_ZBUFFER);
    options.tolerance = 0.01;
    check_raster(512);
    end_with(0.02);
    check_raster(64 * (1228 / 64 + 1)); /* 512 * 2.4 = 1228.8 */
    end_with(0.0101);
    check_raster(64 * (1920 / 64 + 1)); /* 1280 * 1.5 */
    end_with(0.1);
    check_raster(LRCSI_SIGMA_SIZE_MAX);
    end_with(0.1);
    check_ended();

    begin(LRCS_METHOD_ZBUFFER, LRCS_METHOD_ZBUFFER);
    options.tolerance = 0.01;
    check_raster(512);
    end_with(0.0099);
    check_ended();
}

static void a_raster_is_not_refined_in_vain(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        begin(LRCS_METHOD_ZBUFFER, LRCS_METHOD_ZBUFFER);
        options.resolution = i == 0 ? 512 : 0; /* requested */
        check_raster(512);
        end_with(1);
        run.meter.spent = i == 1;
        run.outcome.flags = i == 2 ? LRCS_FLAG_MEMORY_FALLBACK : 0u;
        run.classification.undecided_count = i == 3 ? 0 : 1;
        check_ended();
    }
}

static void auto_clips_where_no_raster_is_accepted(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        begin(LRCS_METHOD_AUTO, LRCS_METHOD_ZBUFFER);
        options.resolution = 512;
        check_raster(512);
        end_with(i == 1 ? 1e-5 : 1);
        run.meter.spent = i == 2;
        if (i == 0) {
            check_clipping(HUGE_VAL);
            assert_string_equal(attempts.current.reason,
                                "the requested raster misses the tolerance");
            end_with(1);
        }
        check_ended();
    }
}

/* --- previews --------------------------------------------------------------------------------- */

/* A view of 10,000 facets, of which clipping takes so many times as long as the first raster. */
static void begin_preview(int accept, double times)
{
    begin(LRCS_METHOD_AUTO, LRCS_METHOD_ZBUFFER);
    options.tolerance = 0.01;
    options.accept = accept;
    run.plan.previews = run.plan.samples_only = 1;
    attempts.cost = (lrcsi_cost){.facets = 1e4, .casting = 1e4, .borders = 1, .overdraw = 2};
    uint32_t size = lrcsi_cost_size(&attempts.cost, 0.01, LRCSI_SIGMA_SIZE_MAX);
    double without = lrcsi_cost_clip(&attempts.cost, 0);
    double each = lrcsi_cost_clip(&attempts.cost, 1) - without;
    double undecided = (times * lrcsi_cost_draw(&attempts.cost, size) - without) / each;
    assert_true(undecided >= 1);
    run.classified = 1;
    run.classification.undecided_count = (uint32_t)undecided;
}

static void clipping_comes_first_if_it_costs_little_more_than_a_raster(void **state)
{
    (void)state;
    begin_preview(LRCS_ACCEPT_ESTIMATE, 1.4);
    uint32_t size = lrcsi_cost_size(&attempts.cost, 0.01, LRCSI_SIGMA_SIZE_MAX);
    double limit = 1.5 * lrcsi_cost_draw(&attempts.cost, size);
    check_clipping(limit);
    assert_true(attempts.current.meter.limit == lrcsi_cost_steps(limit));
    end_with(1);
    check_ended();

    begin_preview(LRCS_ACCEPT_ESTIMATE, 1.6);
    check_raster(lrcsi_cost_first(&attempts.cost, size));
    assert_true(attempts.current.samples_only);
    assert_string_equal(attempts.current.reason,
                        "a raster is estimated to cost less than clipping");
    end_with(0.005);
    check_ended();
}

static void limited_clipping_takes_no_more_steps_than_the_run_has_left(void **state)
{
    (void)state;
    begin_preview(LRCS_ACCEPT_ESTIMATE, 1.4);
    run.meter = (lrcsi_meter){.limit = 1000, .taken = 900};
    assert_int_equal(lrcsi_attempts_next(&run, &attempts), 1);
    assert_true(attempts.current.meter.limit == 1000 && attempts.current.meter.taken == 900);
}

/* After an abandoned attempt a raster is drawn, and then more of them: clipping is tried again only
   for four times the time. Refused clipping is no obstacle to the next one. */
static void abandoned_clipping_is_tried_again_only_for_four_times_as_long(void **state)
{
    (void)state;
    for (int end = LRCSI_ATTEMPT_ABANDONED; end <= LRCSI_ATTEMPT_REFUSED; end++) {
        int abandoned = end == LRCSI_ATTEMPT_ABANDONED;
        begin_preview(LRCS_ACCEPT_ESTIMATE, 1.4);
        uint32_t size = lrcsi_cost_size(&attempts.cost, 0.01, LRCSI_SIGMA_SIZE_MAX);
        double limit = 1.5 * lrcsi_cost_draw(&attempts.cost, size);
        check_clipping(limit);
        attempts.current.end = end;
        check_raster(lrcsi_cost_first(&attempts.cost, size));
        assert_string_equal(attempts.current.reason,
                            abandoned ? "clipping was begun, and took longer than a raster"
                                      : "a raster is estimated to cost less than clipping");
        for (int rasters = 1;; rasters++) {
            uint32_t drawn = attempts.current.size;
            end_with(0.011);
            assert_int_equal(lrcsi_attempts_next(&run, &attempts), 1);
            double next_limit =
                2.5 * lrcsi_cost_draw(&attempts.cost, 64 * (drawn * 3 / 2 / 64 + 1));
            int again = !abandoned || next_limit >= 4 * limit;
            assert_int_equal(attempts.current.method,
                             again ? LRCS_METHOD_EXACT : LRCS_METHOD_ZBUFFER);
            if (again) {
                check_same(attempts.current.limit_ns, next_limit);
                assert_int_equal(rasters > 1, abandoned);
                break;
            }
        }
    }
}

/* A raster of samples alone, of the size that was planned; clipping within a limit is not tried
   again, however large that is. */
static void where_memory_is_short_limited_clipping_gives_way_to_rasters(void **state)
{
    (void)state;
    begin_preview(LRCS_ACCEPT_ESTIMATE, 1.4);
    uint32_t size = lrcsi_cost_size(&attempts.cost, 0.01, LRCSI_SIGMA_SIZE_MAX);
    check_clipping(1.5 * lrcsi_cost_draw(&attempts.cost, size));
    attempts.current.end = LRCSI_ATTEMPT_NO_MEMORY;
    check_raster(lrcsi_cost_first(&attempts.cost, size));
    for (int rasters = 1; attempts.current.size < LRCSI_SIGMA_SIZE_MAX; rasters++) {
        assert_true(rasters < 100 && attempts.current.samples_only && !attempts.current.fallback);
        assert_string_equal(attempts.current.reason, "too little memory for clipping");
        end_with(0.011);
        assert_int_equal(lrcsi_attempts_next(&run, &attempts), 1);
        assert_int_equal(attempts.current.method, LRCS_METHOD_ZBUFFER);
    }
}

static void any_answer_is_the_coarsest_raster(void **state)
{
    (void)state;
    begin_preview(LRCS_ACCEPT_ANY, 1);
    check_raster(
        lrcsi_cost_first(&attempts.cost, lrcsi_cost_size(&attempts.cost, 1, LRCSI_SIGMA_SIZE_MAX)));
    assert_string_equal(attempts.current.reason, "planned");
    end_with(1);
    check_ended();
}

/* Then the owner of a sample is a guess, and there is no estimate. */
static void a_preview_whose_depths_are_undecided_leads_to_clipping(void **state)
{
    (void)state;
    begin_preview(LRCS_ACCEPT_ESTIMATE, 1.6);
    assert_int_equal(lrcsi_attempts_next(&run, &attempts), 1);
    end_with(0.005);
    run.outcome.total.visibility = 1;
    run.outcome.flags = LRCS_FLAG_DEPTH_UNDECIDED;
    check_clipping(HUGE_VAL);
    assert_string_equal(attempts.current.reason, "no raster's estimate meets the tolerance");
}

/* Symptom: areas that were found in time were accepted although their integration was not. */
static void clipping_that_exceeds_its_limit_while_it_integrates_is_abandoned(void **state)
{
    (void)state;
    for (int limited = 0; limited < 2; limited++) {
        lrcs_work work = {.used = 7};
        begin(LRCS_METHOD_AUTO, LRCS_METHOD_EXACT);
        run.work = &work;
        attempts.current = (lrcsi_attempt){.method = LRCS_METHOD_EXACT,
                                           .limit_ns = limited ? 1 : HUGE_VAL,
                                           .mark = 3,
                                           .end = LRCSI_ATTEMPT_FOUND};
        attempts.current.meter.spent = 1;
        lrcsi_attempts_end(&run, &attempts);
        assert_int_equal(attempts.current.end,
                         limited ? LRCSI_ATTEMPT_ABANDONED : LRCSI_ATTEMPT_FOUND);
        assert_int_equal(work.used, limited ? 3 : 7);
        assert_int_equal(run.meter.spent, !limited);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_follows_clipping),
        cmocka_unit_test(where_memory_is_short_one_raster_takes_the_place_of_clipping),
        cmocka_unit_test(rasters_become_finer_until_one_is_accepted),
        cmocka_unit_test(a_raster_is_not_refined_in_vain),
        cmocka_unit_test(auto_clips_where_no_raster_is_accepted),
        cmocka_unit_test(clipping_comes_first_if_it_costs_little_more_than_a_raster),
        cmocka_unit_test(limited_clipping_takes_no_more_steps_than_the_run_has_left),
        cmocka_unit_test(abandoned_clipping_is_tried_again_only_for_four_times_as_long),
        cmocka_unit_test(where_memory_is_short_limited_clipping_gives_way_to_rasters),
        cmocka_unit_test(any_answer_is_the_coarsest_raster),
        cmocka_unit_test(clipping_that_exceeds_its_limit_while_it_integrates_is_abandoned),
        cmocka_unit_test(a_preview_whose_depths_are_undecided_leads_to_clipping),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
