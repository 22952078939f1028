/* SPDX-License-Identifier: MIT */
/* The order of the settings of a time budget, with times that are made up: a run of the sequence on
   a clock of its own, and which answer it gives. */
#include <lrcs/sequence.h>

#include "check.h"

#define SETTINGS 7

/* What each setting truly takes on this machine, s, and the error of its answer. */
typedef struct machine {
    double seconds[SETTINGS], error[SETTINGS];
    int raster_instead; /* the last setting falls back to a raster */
} machine;

typedef struct outcome {
    int order[SETTINGS], count; /* completed, in order */
    int unfinished;             /* what the deadline ended; -1: nothing */
    int best;
} outcome;

/* In the order of lrcs_sequence_make: with a bound and by estimate at 256, 512 and 1024; the last.
 */
static const double forecast[SETTINGS] = {30, 4, 33, 6, 39, 12, 50};
static const double error_of[SETTINGS] = {0.05, 0.2, 0.03, 0.15, 0.01, 0.12, 1e-12};

static machine machine_make(double scale)
{
    machine m = {.raster_instead = 0};
    for (int i = 0; i < SETTINGS; i++) {
        m.seconds[i] = scale * forecast[i];
        m.error[i] = error_of[i];
    }
    return m;
}

static outcome tried(const machine *m, const double *expected, double budget)
{
    lrcs_sequence s = lrcs_sequence_make();
    outcome out = {.unfinished = -1, .best = -1};
    assert_int_equal(s.count, SETTINGS);
    for (int i = 0; i < SETTINGS; i++) {
        s.setting[i].forecast = expected[i];
    }
    double clock = 0;
    for (int i; (i = lrcs_sequence_next(&s, budget - clock)) >= 0;) {
        if (clock + m->seconds[i] > budget) {
            out.unfinished = i;
            break;
        }
        clock += m->seconds[i];
        out.order[out.count++] = i;
        out.best = out.best < 0 || m->error[i] < m->error[out.best] ? i : out.best;
        lrcs_sequence_done(&s, i, m->seconds[i], !(m->raster_instead && i == SETTINGS - 1));
    }
    return out;
}

static void settings_run_from_the_quickest_to_the_slowest(void **state)
{
    (void)state;
    static const int order[SETTINGS] = {1, 3, 5, 0, 2, 4, 6};
    const machine m = machine_make(1);
    /* with less than 104 s clipping is never expected to take half of the time left */
    for (int k = 1; k < SETTINGS; k++) {
        double until = 0;
        for (int i = 0; i < k; i++) {
            until += forecast[order[i]];
        }
        outcome out = tried(&m, forecast, until + 0.5 < 103 ? until + 0.5 : 103);
        for (int i = 0; i < out.count; i++) {
            assert_int_equal(out.order[i], order[i]);
        }
        assert_true(out.count >= (k < 6 ? k : 5) - 1 && out.count > 0);
    }
}

static void a_raster_answers_where_clipping_is_not_completed(void **state)
{
    (void)state;
    machine m = machine_make(1);
    m.seconds[SETTINGS - 1] = 1e6; /* against every forecast */
    outcome out = tried(&m, forecast, 90);
    assert_int_equal(out.best, 2); /* 512, with its bound: 4 + 6 + 12 + 30 + 33 = 85 */
    assert_int_equal(out.unfinished, 4);
    for (int i = 0; i < SETTINGS; i++) { /* what is expected to be quicker is completed */
        int completed = 0;
        for (int k = 0; k < out.count; k++) {
            completed |= out.order[k] == i;
        }
        assert_int_equal(completed, forecast[i] <= forecast[out.best]);
    }
}

static void of_completed_settings_the_best_answers_not_the_last(void **state)
{
    (void)state;
    machine m = machine_make(1);
    m.error[0] = 0.02;
    outcome out = tried(&m, forecast, 90);
    assert_int_equal(out.order[out.count - 1], 2);
    assert_int_equal(out.best, 0);
}

static void clipping_comes_first_if_a_quarter_of_the_time_suffices(void **state)
{
    (void)state;
    const machine m = machine_make(1);
    outcome out = tried(&m, forecast, 204.5); /* 4 for the first, then 4 x 50 */
    assert_int_equal(out.count, 2);
    assert_int_equal(out.best, SETTINGS - 1);
    assert_int_equal(out.unfinished, -1);
}

static void or_half_of_it_once_a_proof_has_been_timed(void **state)
{
    (void)state;
    const machine m = machine_make(1);
    outcome out = tried(&m, forecast, 153); /* 4 + 6 + 12 + 30, then 2 x 50 */
    assert_int_equal(out.count, 5);
    assert_int_equal(out.order[3], 0);
    assert_int_equal(out.best, SETTINGS - 1);
    assert_int_equal(out.unfinished, -1);
}

static void a_slower_machine_is_noticed_by_its_first_setting(void **state)
{
    (void)state;
    const machine m = machine_make(10);
    outcome out = tried(&m, forecast, 600); /* by the forecast alone clipping would fit */
    assert_true(out.count >= 4);
    assert_int_equal(out.order[1], 3);
    assert_int_equal(out.best, 0);
}

static void measured_proofs_move_clipping_before_rasters(void **state)
{
    (void)state;
    /* The first raster with a bound takes much less than was forecast, and drawing more: then
       clipping is expected before the others. */
    machine m = machine_make(1);
    m.seconds[0] = 5;
    m.seconds[6] = 8;
    outcome out = tried(&m, forecast, 60);
    assert_int_equal(out.order[3], 0);
    assert_int_equal(out.order[4], SETTINGS - 1);
    assert_int_equal(out.unfinished, -1);
}

static void after_clipping_no_raster_is_tried_unless_it_fell_back(void **state)
{
    (void)state;
    static const double quick[SETTINGS] = {30, 4, 33, 6, 39, 12, 1};
    machine m = machine_make(1);
    m.seconds[6] = 1;
    assert_int_equal(tried(&m, quick, 1e9).count, 1);
    m.raster_instead = 1;
    assert_int_equal(tried(&m, quick, 1e9).count, SETTINGS);
}

static void a_raster_that_cannot_be_samples_alone_is_drawn_once(void **state)
{
    (void)state;
    static const double few[SETTINGS] = {4, 4, 6, 6, 12, 12, 50};
    const machine m = machine_make(1);
    outcome out = tried(&m, few, 1e2);
    assert_int_equal(out.order[0], 0);
    for (int i = 0; i < out.count; i++) {
        assert_true(out.order[i] % 2 == 0);
    }
}

static void without_forecasts_the_order_is_that_of_the_list(void **state)
{
    (void)state;
    static const double none[SETTINGS] = {0};
    const machine m = machine_make(1);
    outcome out = tried(&m, none, 60);
    assert_int_equal(out.order[0], 0);
}

static void a_bound_ranks_before_an_estimate_before_a_bound_that_says_nothing(void **state)
{
    (void)state;
    const lrcs_result bound = {.sigma_m2 = 1, .bound_m2 = 0.09, .estimate_m2 = 1e-9};
    const lrcs_result likely = {.sigma_m2 = 1, .bound_m2 = 2, .estimate_m2 = 1e-3};
    const lrcs_result loose = {.sigma_m2 = 1, .bound_m2 = 0.2, .estimate_m2 = -1};
    const lrcs_result curved = {
        .sigma_m2 = 1, .bound_m2 = 0.05, .estimate_m2 = -1, .curvature_estimate_m2 = 0.03};
    check_same(lrcs_sequence_error(&bound), 0.09);
    check_abs(lrcs_sequence_error(&likely), 0.101, 1e-15);
    check_same(lrcs_sequence_error(&loose), 0.2);
    check_abs(lrcs_sequence_error(&curved), 0.08, 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(settings_run_from_the_quickest_to_the_slowest),
        cmocka_unit_test(a_raster_answers_where_clipping_is_not_completed),
        cmocka_unit_test(of_completed_settings_the_best_answers_not_the_last),
        cmocka_unit_test(clipping_comes_first_if_a_quarter_of_the_time_suffices),
        cmocka_unit_test(or_half_of_it_once_a_proof_has_been_timed),
        cmocka_unit_test(a_slower_machine_is_noticed_by_its_first_setting),
        cmocka_unit_test(measured_proofs_move_clipping_before_rasters),
        cmocka_unit_test(after_clipping_no_raster_is_tried_unless_it_fell_back),
        cmocka_unit_test(a_raster_that_cannot_be_samples_alone_is_drawn_once),
        cmocka_unit_test(without_forecasts_the_order_is_that_of_the_list),
        cmocka_unit_test(a_bound_ranks_before_an_estimate_before_a_bound_that_says_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
