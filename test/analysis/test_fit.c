/* SPDX-License-Identifier: MIT */
/* Fits of the BRDF: against least squares in 40 digits, against the truth that readings were made
   from, and on readings that do not determine it. */
#include <lrcs/fit.h>

#include <float.h>
#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "memory_limit.h"
#include "random.h"

#include "../vectors/fit.inc"

#define READINGS_MOST 200u

static const double pi = 3.14159265358979323846;

/* ---- readings ---- */

static double random_part(uint64_t *state) /* 0 < x < 1 */
{
    return random_unit(state) + 0x1p-54;
}

static double random_normal(uint64_t *state) /* Box and Muller 1958 */
{
    double r = sqrt(-2.0 * log(random_part(state)));
    return r * cos(2.0 * pi * random_part(state));
}

/* f_r from its definition. */
static double f_of(const lrcs_brdf *brdf, double deg)
{
    long double theta = (long double)deg * 3.14159265358979323846264338L / 180.0L;
    long double c = cosl(theta);
    long double slope = tanl(theta) / (long double)brdf->s;
    long double glint =
        brdf->A > 0.0 ? (long double)brdf->A / powl(c, 6) * expl(-slope * slope) : 0;
    return (double)(glint + (long double)brdf->B * powl(c, (long double)brdf->m));
}

typedef struct series {
    lrcs_brdf brdf;
    double first, last, noise, outliers;
    uint32_t count;
    int kind;
} series;

/* An outlier at the smallest angle could not be told from a narrow glint. */
static void series_make(const series *one, uint64_t seed, lrcs_fit_reading *reading)
{
    uint64_t state = seed;
    for (uint32_t i = 0; i < one->count; i++) {
        double deg = one->first + (one->last - one->first) * i / (one->count - 1);
        double f = f_of(&one->brdf, deg);
        double sigma = one->kind == LRCS_FIT_ABSOLUTE ? one->noise : one->noise * f;
        int out = random_part(&state) < one->outliers && fabs(deg) > 3.0;
        double wrong = out ? 1.5 + 4.0 * random_part(&state) : 1.0;
        reading[i] = (lrcs_fit_reading){deg, wrong * (f + sigma * random_normal(&state)), sigma};
    }
}

static lrcs_fit fit_of(const lrcs_fit_reading *reading, uint32_t count,
                       const lrcs_fit_options *options, lrcs_fit_point *point)
{
    lrcs_fit fit;
    size_t size = lrcs_fit_need(count);
    void *bytes = malloc(size);
    lrcs_work work = lrcs_work_make(bytes, size);
    assert_int_equal(lrcs_fit_run(reading, count, options, &work, &fit, point), LRCS_OK);
    free(bytes);
    return fit;
}

static lrcs_fit series_fit(const series *one, uint64_t seed)
{
    lrcs_fit_reading reading[READINGS_MOST];
    lrcs_fit_options options = lrcs_fit_options_default();
    options.noise = one->kind;
    series_make(one, seed, reading);
    return fit_of(reading, one->count, &options, NULL);
}

static int holds(const lrcs_fit *fit, int p, double truth)
{
    return fit->parameter[p].low <= truth && truth <= fit->parameter[p].high;
}

/* ---- against other programs and the truth ---- */

static void values_errors_and_limits_are_those_of_least_squares(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof fit_cases / sizeof fit_cases[0]; i++) {
        lrcs_fit_options options = {fit_cases[i].unit, fit_cases[i].cosine, fit_cases[i].noise};
        lrcs_fit fit = fit_of(fit_cases[i].reading, fit_cases[i].count, &options, NULL);
        assert_int_equal(fit.kept, fit_cases[i].count);
        check_rel(fit.noise, fit_cases[i].spread, 1e-9);
        for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
            const lrcs_fit_parameter *one = &fit.parameter[p];
            const double *limit = &fit_cases[i].limit[2 * p];
            double value = fit_cases[i].value[p];
            assert_int_equal(one->verdict, LRCS_FIT_DETERMINED);
            check_abs(one->value, value, 1e-5 * fit_cases[i].error[p]);
            check_rel(one->error, fit_cases[i].error[p], 1e-5);
            check_abs(one->low, limit[0], 2e-4 * (value - limit[0]));
            check_abs(one->high, limit[1], 2e-4 * (limit[1] - value));
        }
    }
}

static void readings_without_noise_give_back_their_material(void **state)
{
    (void)state;
    static const lrcs_brdf brdf[] = {{1, 0.25, 0.2, 0.5},    {0.6, 0.016, 0.1, 0.5},
                                     {0.02, 0.25, 0.4, 0.2}, {7.95, 0.1, 0.05, 3},
                                     {1e-3, 0.3, 0.3, 0},    {30, 1e-3, 0.08, 1.5}};
    for (size_t i = 0; i < sizeof brdf / sizeof brdf[0]; i++) {
        for (int kind = LRCS_FIT_ABSOLUTE; kind <= LRCS_FIT_RELATIVE; kind++) {
            series one = {brdf[i], -70, 80, 0.0, 0.1, 76, kind};
            lrcs_fit fit = series_fit(&one, 11 + i);
            check_rel(fit.brdf.A, brdf[i].A, 1e-9);
            check_rel(fit.brdf.B, brdf[i].B, 1e-9);
            check_rel(fit.brdf.s, brdf[i].s, 1e-9);
            check_abs(fit.brdf.m, brdf[i].m, 1e-9);
            assert_true(fit.kept < 76 && fit.kept > 60);
        }
    }
}

/* How many of `seeds` series have limits that enclose the truth: 19 in 20 are expected, to within
   five standard deviations of the binomial distribution. */
static void coverage_check(const series *one, uint32_t seeds)
{
    const double truth[] = {one->brdf.A, one->brdf.B, one->brdf.s, one->brdf.m};
    uint32_t inside[LRCS_FIT_PARAMETERS] = {0};
    for (uint32_t seed = 1; seed <= seeds; seed++) {
        lrcs_fit fit = series_fit(one, seed);
        for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
            inside[p] += (uint32_t)holds(&fit, p, truth[p]);
        }
    }
    double slack = 5.0 * sqrt(0.95 * 0.05 * seeds);
    for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
        check_abs(inside[p], 0.95 * seeds, slack);
    }
}

static void limits_hold_the_truth_in_19_of_20_series(void **state)
{
    (void)state;
    coverage_check(&(series){{1, 0.25, 0.2, 0.5}, 0, 75, 0.01, 0.0, 26, LRCS_FIT_ABSOLUTE}, 150);
}

static void limits_hold_the_truth_among_outliers(void **state)
{
    (void)state;
    coverage_check(&(series){{1, 0.25, 0.2, 0.5}, -75, 75, 0.02, 0.1, 41, LRCS_FIT_RELATIVE}, 100);
}

static void limits_hold_the_truth_where_errors_are_given(void **state)
{
    (void)state;
    coverage_check(&(series){{0.6, 0.05, 0.15, 1.0}, 0, 70, 0.04, 0.0, 31, LRCS_FIT_GIVEN}, 100);
}

/* A plain t test would find a glint in a fifth of them. */
static void noise_is_seldom_taken_for_a_glint(void **state)
{
    (void)state;
    const uint32_t seeds = 200;
    series one = {{0, 0.3, 0.1, 0.3}, 0, 75, 0.01, 0.0, 26, LRCS_FIT_ABSOLUTE};
    uint32_t glints = 0;
    uint32_t inside = 0;
    for (uint32_t seed = 1; seed <= seeds; seed++) {
        lrcs_fit fit = series_fit(&one, seed);
        glints += fit.brdf.A > 0.0;
        inside += (uint32_t)(holds(&fit, LRCS_FIT_B, 0.3) && holds(&fit, LRCS_FIT_M, 0.3));
        assert_true(fit.brdf.A > 0.0 || fit.brdf.s == 0.0);
        assert_true(fit.parameter[LRCS_FIT_A].high < 0.1);
    }
    check_most(glints, 0.05 * seeds + 4.0 * sqrt(0.05 * 0.95 * seeds));
    assert_true(glints > 0); /* nor is it never */
    assert_true(inside > 0.85 * seeds);
}

/* ---- what readings cannot tell ---- */

static void verdicts_name_what_is_not_determined(void **state)
{
    (void)state;
    static const struct {
        series one;
        int verdict[LRCS_FIT_PARAMETERS];
    } cases[] = {
        /* all */
        {{{1, 0.25, 0.2, 0.5}, 0, 75, 0.01, 0, 31, 0},
         {LRCS_FIT_DETERMINED, LRCS_FIT_DETERMINED, LRCS_FIT_DETERMINED, LRCS_FIT_DETERMINED}},
        /* no glint */
        {{{0, 0.3, 0.1, 0.3}, 0, 75, 0.003, 0, 31, 0},
         {LRCS_FIT_ABSENT, LRCS_FIT_DETERMINED, LRCS_FIT_UNDEFINED, LRCS_FIT_DETERMINED}},
        /* a glint that the readings do not reach */
        {{{1, 0.25, 0.1, 0.5}, 30, 75, 0.003, 0, 31, 0},
         {LRCS_FIT_FREE, LRCS_FIT_DETERMINED, LRCS_FIT_UNDEFINED, LRCS_FIT_DETERMINED}},
        /* a glint that one reading shows */
        {{{1, 0.25, 0.005, 0.5}, 0, 75, 0.003, 0, 31, 0},
         {LRCS_FIT_DETERMINED, LRCS_FIT_DETERMINED, LRCS_FIT_AT_MOST, LRCS_FIT_DETERMINED}},
        /* no diffuse term */
        {{{1, 0, 0.2, 0}, 0, 60, 0.003, 0, 31, 0},
         {LRCS_FIT_DETERMINED, LRCS_FIT_ABSENT, LRCS_FIT_DETERMINED, LRCS_FIT_UNDEFINED}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        lrcs_fit fit = series_fit(&cases[i].one, 7);
        for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
            if (fit.parameter[p].verdict != cases[i].verdict[p]) {
                fprintf(stderr, "case %zu, parameter %d: %g in %g .. %g\n", i, p,
                        fit.parameter[p].value, fit.parameter[p].low, fit.parameter[p].high);
            }
            assert_int_equal(fit.parameter[p].verdict, cases[i].verdict[p]);
        }
    }
}

/* Close to the normal A and B sum up, and which is which cannot be told. */
static void parts_that_look_alike_may_each_be_absent(void **state)
{
    (void)state;
    series one = {{1, 0.25, 0.2, 0.5}, 0, 8, 0.01, 0.0, 41, LRCS_FIT_ABSOLUTE};
    lrcs_fit fit = series_fit(&one, 3);
    assert_int_equal(fit.parameter[LRCS_FIT_A].verdict, LRCS_FIT_ABSENT);
    assert_int_equal(fit.parameter[LRCS_FIT_B].verdict, LRCS_FIT_ABSENT);
    assert_true(holds(&fit, LRCS_FIT_A, 1.0) && holds(&fit, LRCS_FIT_B, 0.25));
    check_abs(fit.brdf.A + fit.brdf.B, 1.25, 0.01);
}

static void three_angles_are_counted_and_do_not_determine_four(void **state)
{
    (void)state;
    lrcs_fit_reading reading[12];
    lrcs_brdf brdf = lrcs_brdf_default();
    lrcs_fit_options options = lrcs_fit_options_default();
    uint64_t random = 5;
    for (int i = 0; i < 12; i++) {
        double deg = 20.0 * (i % 3);
        reading[i] = (lrcs_fit_reading){i % 2 ? deg : -deg,
                                        f_of(&brdf, deg) + 0.01 * random_normal(&random), 0};
    }
    lrcs_fit fit = fit_of(reading, 12, &options, NULL);
    int open = 0;
    for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
        open += fit.parameter[p].verdict != LRCS_FIT_DETERMINED;
    }
    assert_int_equal(fit.angles, 3);
    assert_true(open > 0);
}

/* ---- units and order ---- */

static void a_panel_a_scale_or_a_sign_changes_nothing_else(void **state)
{
    (void)state;
    lrcs_fit_reading reading[READINGS_MOST];
    series one = {{1, 0.25, 0.2, 0.5}, 0, 75, 0.01, 0.05, 41, LRCS_FIT_ABSOLUTE};
    lrcs_fit plain = series_fit(&one, 2);
    static const double scale[] = {0.98 / 3.14159265358979323846, 0x1p-900, 0x1p900, 1e-9};
    for (size_t k = 0; k < sizeof scale / sizeof scale[0]; k++) {
        lrcs_fit_options options = lrcs_fit_options_default();
        options.unit = scale[k];
        series_make(&one, 2, reading);
        for (uint32_t i = 0; i < one.count; i++) {
            reading[i].value /= scale[k];
            reading[i].angle_deg *= i % 2 ? -1.0 : 1.0;
        }
        lrcs_fit fit = fit_of(reading, one.count, &options, NULL);
        assert_int_equal(fit.kept, plain.kept);
        for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
            double error = plain.parameter[p].error;
            check_abs(fit.parameter[p].value, plain.parameter[p].value, 1e-5 * error);
            check_abs(fit.parameter[p].low, plain.parameter[p].low, 1e-3 * error);
            check_abs(fit.parameter[p].high, plain.parameter[p].high, 1e-3 * error);
        }
        check_rel(fit.rms, plain.rms, 1e-6);
        check_rel(fit.noise, plain.noise, 1e-6);
    }
}

/* Given errors have a size, weights only proportions. */
static void weights_are_known_but_for_a_factor(void **state)
{
    (void)state;
    lrcs_fit_reading reading[READINGS_MOST];
    lrcs_fit_options options = {1.0, 0, LRCS_FIT_WEIGHTED};
    series one = {{1, 0.25, 0.2, 0.5}, 0, 75, 0.05, 0.0, 41, LRCS_FIT_GIVEN};
    series_make(&one, 2, reading);
    lrcs_fit plain = fit_of(reading, one.count, &options, NULL);
    for (uint32_t i = 0; i < one.count; i++) {
        reading[i].sigma *= 100.0;
    }
    lrcs_fit fit = fit_of(reading, one.count, &options, NULL);
    options.noise = LRCS_FIT_GIVEN;
    lrcs_fit given = fit_of(reading, one.count, &options, NULL);
    check_rel(fit.noise, plain.noise / 100.0, 1e-9);
    for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
        double error = plain.parameter[p].error;
        check_abs(fit.parameter[p].low, plain.parameter[p].low, 1e-3 * error);
        check_abs(fit.parameter[p].high, plain.parameter[p].high, 1e-3 * error);
    }
    assert_true(given.parameter[LRCS_FIT_B].high > plain.parameter[LRCS_FIT_B].high + 0.1);
}

static void order_of_readings_does_not_matter(void **state)
{
    (void)state;
    lrcs_fit_reading reading[READINGS_MOST];
    lrcs_fit_options options = lrcs_fit_options_default();
    series one = {{1, 0.25, 0.2, 0.5}, 0, 75, 0.01, 0.05, 41, LRCS_FIT_ABSOLUTE};
    lrcs_fit plain = series_fit(&one, 2);
    series_make(&one, 2, reading);
    for (uint32_t i = 0; i < one.count / 2; i++) {
        lrcs_fit_reading swap = reading[i];
        reading[i] = reading[one.count - 1 - i];
        reading[one.count - 1 - i] = swap;
    }
    lrcs_fit fit = fit_of(reading, one.count, &options, NULL);
    for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
        check_abs(fit.parameter[p].value, plain.parameter[p].value,
                  1e-5 * plain.parameter[p].error);
    }
}

static void points_add_up_and_name_the_outliers(void **state)
{
    (void)state;
    lrcs_fit_reading reading[READINGS_MOST];
    lrcs_fit_point point[READINGS_MOST];
    lrcs_fit_options options = lrcs_fit_options_default();
    series one = {{1, 0.25, 0.2, 0.5}, 0, 75, 0.005, 0.0, 41, LRCS_FIT_ABSOLUTE};
    series_make(&one, 4, reading);
    reading[7].value += 0.3;
    reading[30].value = -1.0;
    options.unit = 0.5;
    lrcs_fit fit = fit_of(reading, one.count, &options, point);
    double square = 0.0;
    for (uint32_t i = 0; i < one.count; i++) {
        assert_int_equal(point[i].outlier, i == 7 || i == 30);
        check_abs(point[i].fitted + point[i].residual, reading[i].value, 1e-15);
        check_rel(0.5 * point[i].fitted, f_of(&fit.brdf, reading[i].angle_deg), 1e-12);
        square += point[i].outlier ? 0.0 : 0.25 * point[i].residual * point[i].residual;
        check_abs(point[i].standard * fit.noise, 0.5 * point[i].residual, 1e-12);
    }
    assert_int_equal(fit.kept, 39);
    check_rel(fit.rms, sqrt(square / 39), 1e-12);
    check_rel(fit.noise, sqrt(square / 35), 1e-12);
}

/* ---- refusals and garbage ---- */

static void what_cannot_be_fitted_is_refused_and_leaves_no_trace(void **state)
{
    (void)state;
    static const struct {
        double angle, value, sigma, unit;
        uint32_t count;
        int noise, status;
    } bad[] = {
        {10, 1, 1, 1, 4, LRCS_FIT_ABSOLUTE, LRCS_E_EMPTY},
        {10, 1, 1, 1, 0, LRCS_FIT_ABSOLUTE, LRCS_E_EMPTY},
        {10, 0, 1, 1, 9, LRCS_FIT_ABSOLUTE, LRCS_E_EMPTY},
        {10, -1, 1, 1, 9, LRCS_FIT_ABSOLUTE, LRCS_E_EMPTY},
        {90, 1, 1, 1, 9, LRCS_FIT_ABSOLUTE, LRCS_E_NUMBER},
        {-90, 1, 1, 1, 9, LRCS_FIT_ABSOLUTE, LRCS_E_NUMBER},
        {(double)NAN, 1, 1, 1, 9, LRCS_FIT_ABSOLUTE, LRCS_E_NUMBER},
        {10, (double)NAN, 1, 1, 9, LRCS_FIT_ABSOLUTE, LRCS_E_NUMBER},
        {10, HUGE_VAL, 1, 1, 9, LRCS_FIT_ABSOLUTE, LRCS_E_NUMBER},
        {10, DBL_MAX, 1, 2, 9, LRCS_FIT_ABSOLUTE, LRCS_E_NUMBER},
        {10, 1, 0, 1, 9, LRCS_FIT_GIVEN, LRCS_E_NUMBER},
        {10, 1, -1, 1, 9, LRCS_FIT_GIVEN, LRCS_E_NUMBER},
        {10, 1, (double)NAN, 1, 9, LRCS_FIT_GIVEN, LRCS_E_NUMBER},
        {10, 1, 0, 1, 9, LRCS_FIT_WEIGHTED, LRCS_E_NUMBER},
        {10, 1, 1e-310, 1, 9, LRCS_FIT_WEIGHTED, LRCS_E_NUMBER},
        {10, 1, 1e300, 1, 9, LRCS_FIT_GIVEN, LRCS_E_NUMBER},
        {10, 1, 1e-72, 1, 9, LRCS_FIT_GIVEN, LRCS_E_NUMBER},
        {10, 1, 1e72, 1, 9, LRCS_FIT_WEIGHTED, LRCS_E_NUMBER},
        {10, 1, 1, 1e300, 9, LRCS_FIT_ABSOLUTE, LRCS_E_NUMBER},
        {10, 1e-300, 1, 1, 9, LRCS_FIT_ABSOLUTE, LRCS_E_NUMBER},
        {10, 1, 1, 0, 9, LRCS_FIT_ABSOLUTE, LRCS_E_ARGUMENT},
        {10, 1, 1, (double)NAN, 9, LRCS_FIT_ABSOLUTE, LRCS_E_ARGUMENT},
        {10, 1, 1, (double)INFINITY, 9, LRCS_FIT_ABSOLUTE, LRCS_E_ARGUMENT},
        {10, 1, 1, 1, 9, 4, LRCS_E_ARGUMENT},
        {10, 1, 1, 1, 9, -1, LRCS_E_ARGUMENT},
    };
    static unsigned char bytes[4096];
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        lrcs_fit_reading reading[9];
        lrcs_fit_options options = {bad[i].unit, 0, bad[i].noise};
        lrcs_work work = lrcs_work_make(bytes, sizeof bytes);
        lrcs_fit fit;
        lrcs_fit before;
        memset(&fit, 0x5a, sizeof fit);
        before = fit;
        for (int k = 0; k < 9; k++) {
            reading[k] = (lrcs_fit_reading){bad[i].angle, bad[i].value, bad[i].sigma};
        }
        assert_int_equal(lrcs_fit_run(reading, bad[i].count, &options, &work, &fit, NULL),
                         bad[i].status);
        assert_memory_equal(&fit, &before, sizeof fit);
    }
}

static void the_work_area_is_what_need_says(void **state)
{
    (void)state;
    lrcs_fit_reading reading[READINGS_MOST];
    lrcs_fit_options options = lrcs_fit_options_default();
    series one = {{1, 0.25, 0.2, 0.5}, 0, 75, 0.01, 0.0, 17, LRCS_FIT_ABSOLUTE};
    size_t need = lrcs_fit_need(one.count);
    size_t least = 12 * one.count * sizeof(double);
    unsigned char *bytes = malloc(need + 16);
    lrcs_fit fit;
    series_make(&one, 1, reading);
    for (size_t size = 0; size <= need; size += size + 64 < need ? 64 : 1) {
        memset(bytes + size, 0xa5, 16);
        lrcs_work work = lrcs_work_make(bytes, size);
        int status = lrcs_fit_run(reading, one.count, &options, &work, &fit, NULL);
        assert_true(status == LRCS_E_MEMORY || (status == LRCS_OK && size >= least));
        assert_int_equal(work.used, 0);
        for (int i = 0; i < 16; i++) {
            assert_int_equal(bytes[size + (size_t)i], 0xa5);
        }
    }
    lrcs_work work = lrcs_work_make(bytes, need);
    assert_int_equal(lrcs_fit_run(reading, one.count, &options, &work, &fit, NULL), LRCS_OK);
    free(bytes);
}

static void any_readings_give_finite_values_between_their_limits(void **state)
{
    (void)state;
    uint64_t random = 17;
    for (int k = 0; k < 100; k++) {
        lrcs_fit_reading reading[24];
        lrcs_fit_options options = {1.0, k % 2, k % 4};
        uint32_t count = 5 + (uint32_t)(20.0 * random_part(&random)) % 20;
        double decades = 90.0 * random_part(&random) * random_part(&random);
        for (uint32_t i = 0; i < count; i++) {
            double deg = k % 5 ? 179.9 * (random_part(&random) - 0.5) : (double)(i % 2);
            double sign = random_part(&random) < 0.2 ? -1.0 : 1.0;
            reading[i] =
                (lrcs_fit_reading){deg, sign * pow(10.0, decades * (random_part(&random) - 0.5)),
                                   1e-3 + random_part(&random)};
        }
        reading[0].value = fabs(reading[0].value);
        lrcs_fit fit = fit_of(reading, count, &options, NULL);
        assert_true(isfinite(fit.rms) && isfinite(fit.noise));
        assert_true(lrcs_brdf_check(&fit.brdf) >= 0);
        for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
            const lrcs_fit_parameter *one = &fit.parameter[p];
            check_most(one->low, one->value * (1.0 + 1e-9));
            check_most(one->value, one->high * (1.0 + 1e-9));
            assert_true(one->error >= 0.0);
            for (int q = 0; q < LRCS_FIT_PARAMETERS; q++) {
                check_most(fabs(fit.correlation[p][q]), 1.0 + 1e-6);
            }
        }
    }
}

static void every_verdict_has_its_sentence(void **state)
{
    (void)state;
    const char *unknown = lrcs_fit_verdict_text(0, -1);
    for (int p = 0; p < LRCS_FIT_PARAMETERS; p++) {
        int shape = p >= LRCS_FIT_S;
        for (int v = LRCS_FIT_DETERMINED; v <= LRCS_FIT_FREE; v++) {
            int never = (v == LRCS_FIT_ABSENT && shape) || (v == LRCS_FIT_UNDEFINED && !shape) ||
                        (v == LRCS_FIT_AT_MOST && p != LRCS_FIT_S);
            assert_int_equal(strcmp(lrcs_fit_verdict_text(p, v), unknown) == 0, never);
        }
    }
    assert_string_equal(lrcs_fit_verdict_text(-1, 0), unknown);
    assert_string_equal(lrcs_fit_verdict_text(4, 0), unknown);
    assert_string_equal(lrcs_fit_verdict_text(0, 6), unknown);
}

/* Steeper than the search goes: cos^3125 beside a glint of slope 0.03, 1 in 1000 of error. */
static void a_fall_beyond_the_search_is_limited_below_only(void **state)
{
    (void)state;
    lrcs_fit_reading reading[20];
    lrcs_fit_options options = lrcs_fit_options_default();
    options.noise = LRCS_FIT_ABSOLUTE;
    lrcs_brdf brdf = {0.5, 1, 0.03, 3125};
    for (int i = 0; i < 20; i++) {
        reading[i] = (lrcs_fit_reading){0.3 * i, f_of(&brdf, 0.3 * i) + 1e-3 * (i * 7 % 5 - 2), 0};
    }
    lrcs_fit fit = fit_of(reading, 20, &options, NULL);
    assert_int_equal(fit.parameter[LRCS_FIT_M].verdict, LRCS_FIT_AT_LEAST);
    assert_true(holds(&fit, LRCS_FIT_M, brdf.m) && fit.parameter[LRCS_FIT_M].low > 100);
}

/* Equal readings at the normal alone: either part explains them, to the bit. */
static void readings_of_one_value_at_the_normal_leave_both_parts_open(void **state)
{
    (void)state;
    for (int noise = LRCS_FIT_ABSOLUTE; noise <= LRCS_FIT_GIVEN; noise++) {
        lrcs_fit_reading reading[20];
        lrcs_fit_options options = lrcs_fit_options_default();
        options.noise = noise;
        for (int i = 0; i < 20; i++) {
            reading[i] = (lrcs_fit_reading){0, 0.5, 0.01};
        }
        lrcs_fit fit = fit_of(reading, 20, &options, NULL);
        check_rel(fit.brdf.A + fit.brdf.B, 0.5, 1e-12);
        assert_int_equal(fit.parameter[LRCS_FIT_A].verdict, LRCS_FIT_ABSENT);
        assert_int_equal(fit.parameter[LRCS_FIT_B].verdict, LRCS_FIT_ABSENT);
        check_most(fit.rms, 1e-12);
    }
}

/* So far from the normal, the narrowest lobes of the search range are 0 at every reading. */
static void readings_of_nothing_beside_outliers_have_finite_errors(void **state)
{
    (void)state;
    static const double nothing[] = {0, 1e-200, 1e-160, 1e-30};
    for (int n = 0; n < 4; n++) {
        for (int noise = LRCS_FIT_ABSOLUTE; noise <= LRCS_FIT_WEIGHTED; noise++) {
            lrcs_fit_reading reading[10];
            lrcs_fit_point point[10];
            lrcs_fit_options options = lrcs_fit_options_default();
            options.noise = noise;
            for (int i = 0; i < 10; i++) {
                double value = i < 2 ? 12 - 4 * i : nothing[n] * (i % 3);
                reading[i] = (lrcs_fit_reading){4 + 5 * i, value, 1};
            }
            lrcs_fit fit = fit_of(reading, 10, &options, point);
            assert_true(isfinite(fit.noise) && isfinite(fit.rms));
            for (int i = 0; i < 10; i++) {
                assert_true(isfinite(point[i].fitted) && isfinite(point[i].standard));
            }
        }
    }
}

static void grazing_readings_alone_give_back_a_matt_surface(void **state)
{
    (void)state;
    lrcs_fit_reading reading[16];
    lrcs_fit_options options = lrcs_fit_options_default();
    lrcs_brdf brdf = {0, 0.25, 0, 0.5};
    uint64_t random = 23;
    for (int i = 0; i < 16; i++) {
        double f = f_of(&brdf, 72 + i) + 1e-3 * random_normal(&random);
        reading[i] = (lrcs_fit_reading){72 + i, f, 0};
    }
    lrcs_fit fit = fit_of(reading, 16, &options, NULL);
    assert_true(holds(&fit, LRCS_FIT_B, brdf.B) && holds(&fit, LRCS_FIT_M, brdf.m));
    assert_true(fit.parameter[LRCS_FIT_A].low == 0 && isfinite(fit.brdf.A + fit.brdf.B));
}

static lrcs_fit_reading limited_reading[9];
static lrcs_fit limited_fit;

static int call_fit(lrcs_work *work)
{
    lrcs_fit_options options = lrcs_fit_options_default();
    return lrcs_fit_run(limited_reading, 9, &options, work, &limited_fit, NULL);
}

static void a_fit_grows_until_it_fits(void **state)
{
    (void)state;
    for (int i = 0; i < 9; i++) {
        limited_reading[i].angle_deg = 8.0 * i;
        limited_reading[i].value = 0.3 + exp(-0.02 * i * i);
    }
    check_memory_limit(MEMORY_CASE("fit", lrcs_fit_need(9), call_fit, limited_fit, 0));
}

/* Where size_t has 32 bits, a product of counts that wrapped would ask for too little. */
static void need_never_shrinks_as_readings_grow(void **state)
{
    (void)state;
    size_t last = 0;
    for (double count = 1; count < 4294967295.0; count *= 1.03) {
        size_t need = lrcs_fit_need((uint32_t)count);
        assert_true(need >= last && need >= (uint32_t)count);
        last = need;
    }
}

/* Readings made with errors of one kind, over values that differ by a factor of more than 100. */
static void the_likelier_errors_are_those_that_readings_were_made_with(void **state)
{
    (void)state;
    int right = 0;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        const series made = {.brdf = {2.0, 0.01, 0.2, 1.0},
                             .first = 0.0,
                             .last = 60.0,
                             .noise = seed % 2 ? 0.05 : 0.02,
                             .count = 40,
                             .kind = seed % 2 ? LRCS_FIT_RELATIVE : LRCS_FIT_ABSOLUTE};
        lrcs_fit_reading reading[40];
        lrcs_fit_point point[40], plain_point[40];
        lrcs_fit fit, plain;
        lrcs_fit_options options = lrcs_fit_options_default();
        int noise = -1;
        series_make(&made, seed, reading);
        size_t size = lrcs_fit_need(made.count);
        void *bytes = malloc(size);
        lrcs_work work = lrcs_work_make(bytes, size);
        assert_int_equal(
            lrcs_fit_run_likelier(reading, made.count, &options, &work, &noise, &fit, point),
            LRCS_OK);
        right += noise == made.kind;
        options.noise = noise; /* the fit is that of these errors */
        assert_int_equal(lrcs_fit_run(reading, made.count, &options, &work, &plain, plain_point),
                         LRCS_OK);
        assert_memory_equal(&fit.brdf, &plain.brdf, sizeof fit.brdf);
        for (uint32_t i = 0; i < made.count; i++) {
            assert_true(point[i].fitted == plain_point[i].fitted &&
                        point[i].outlier == plain_point[i].outlier);
        }
        free(bytes);
    }
    assert_int_equal(right, 20);
    lrcs_fit fit;
    lrcs_fit_point point[1];
    lrcs_fit_options options = lrcs_fit_options_default();
    const lrcs_fit_reading one = {0.0, 1.0, 0.0};
    lrcs_work work = lrcs_work_make(NULL, 0);
    int noise;
    assert_int_equal(lrcs_fit_run_likelier(&one, 1, &options, &work, &noise, &fit, point),
                     LRCS_E_EMPTY);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_errors_and_limits_are_those_of_least_squares),
        cmocka_unit_test(readings_without_noise_give_back_their_material),
        cmocka_unit_test(limits_hold_the_truth_in_19_of_20_series),
        cmocka_unit_test(limits_hold_the_truth_among_outliers),
        cmocka_unit_test(limits_hold_the_truth_where_errors_are_given),
        cmocka_unit_test(noise_is_seldom_taken_for_a_glint),
        cmocka_unit_test(verdicts_name_what_is_not_determined),
        cmocka_unit_test(parts_that_look_alike_may_each_be_absent),
        cmocka_unit_test(three_angles_are_counted_and_do_not_determine_four),
        cmocka_unit_test(a_panel_a_scale_or_a_sign_changes_nothing_else),
        cmocka_unit_test(weights_are_known_but_for_a_factor),
        cmocka_unit_test(order_of_readings_does_not_matter),
        cmocka_unit_test(points_add_up_and_name_the_outliers),
        cmocka_unit_test(what_cannot_be_fitted_is_refused_and_leaves_no_trace),
        cmocka_unit_test(the_work_area_is_what_need_says),
        cmocka_unit_test(any_readings_give_finite_values_between_their_limits),
        cmocka_unit_test(every_verdict_has_its_sentence),
        cmocka_unit_test(a_fall_beyond_the_search_is_limited_below_only),
        cmocka_unit_test(readings_of_one_value_at_the_normal_leave_both_parts_open),
        cmocka_unit_test(readings_of_nothing_beside_outliers_have_finite_errors),
        cmocka_unit_test(grazing_readings_alone_give_back_a_matt_surface),
        cmocka_unit_test(a_fit_grows_until_it_fits),
        cmocka_unit_test(need_never_shrinks_as_readings_grow),
        cmocka_unit_test(the_likelier_errors_are_those_that_readings_were_made_with),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
