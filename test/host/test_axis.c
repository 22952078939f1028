/* SPDX-License-Identifier: MIT */
/* The axes of charts: round ends, ticks in order, names that say what they mean. */
#include "host/chart/axis.h"

#include <stdlib.h>
#include <string.h>

#include "check.h"

/* The named ticks as one line of text. */
static const char *names(const lrcsi_axis *axis)
{
    static char line[2048];
    line[0] = '\0';
    for (uint32_t i = 0; i < axis->count; i++) {
        const lrcsi_tick *tick = &axis->tick[i];
        if (tick->major) {
            strcat(line, line[0] ? " " : "");
            strcat(line, tick->text);
            strcat(line, tick->raised[0] ? "^" : "");
            strcat(line, tick->raised);
        }
    }
    return line;
}

static double named_value(const lrcsi_tick *tick)
{
    return tick->raised[0] ? pow(strtod(tick->text, NULL), strtod(tick->raised, NULL))
                           : strtod(tick->text, NULL);
}

static void check_axis(int log, double least, double most, double texts)
{
    lrcsi_axis axis = lrcsi_axis_make(log, least, most, texts);
    unsigned named = 0;
    double hair = 1e-8 * (log ? least : most - least); /* what no eye sees */
    check_most(axis.low, least + hair);
    check_most(most - (log ? 1e-8 * most : hair), axis.high);
    assert_true(axis.count > 1 && axis.count < LRCSI_AXIS_TICKS);
    for (uint32_t i = 0; i < axis.count; i++) {
        const lrcsi_tick *tick = &axis.tick[i];
        double place = lrcsi_axis_at(&axis, tick->value);
        assert_true(place > -1e-6 && place < 1.0 + 1e-6);
        assert_true(i == 0 || tick->value > tick[-1].value);
        named += (unsigned)tick->major;
        if (tick->major) {
            check_abs(tick->value, named_value(tick),
                      1e-9 * (fabs(tick->value) + axis.high - axis.low));
        }
    }
    assert_true(named >= 1);
    check_most(named, 1.5 * texts + 2.0);
}

static void many_decades_are_named_as_powers_of_ten(void **state)
{
    (void)state;
    lrcsi_axis axis = lrcsi_axis_make(1, 3e-13, 2.0, 20.0);
    assert_string_equal(names(&axis), "10^-12 10^-11 10^-10 10^-9 10^-8 10^-7 10^-6 10^-5 10^-4 "
                                      "10^-3 10^-2 10^-1 10^0");
    check_rel(axis.low, 2e-13, 1e-12);
    check_rel(axis.high, 2.0, 1e-12);
}

static void more_decades_than_room_are_named_in_steps(void **state)
{
    (void)state;
    lrcsi_axis axis = lrcsi_axis_make(1, 1e-15, 1.0, 6.0);
    assert_string_equal(names(&axis), "10^-15 10^-12 10^-9 10^-6 10^-3 10^0");
}

static void few_decades_are_named_at_1_2_and_5(void **state)
{
    (void)state;
    lrcsi_axis axis = lrcsi_axis_make(1, 0.06, 13.0, 10.0);
    assert_string_equal(names(&axis), "0.05 0.1 0.2 0.5 1 2 5 10 20");
}

static void decades_between_have_eight_minor_ticks(void **state)
{
    (void)state;
    lrcsi_axis axis = lrcsi_axis_make(1, 1.0, 1000.0, 3.0);
    assert_string_equal(names(&axis), "1 10 100 1000");
    assert_int_equal(axis.count, 1 + 3 * 9);
}

static void equal_steps_are_1_2_or_5(void **state)
{
    (void)state;
    lrcsi_axis axis = lrcsi_axis_make(0, -0.31, 0.92, 8.0);
    assert_string_equal(names(&axis), "-0.4 -0.2 0 0.2 0.4 0.6 0.8 1.0");
    axis = lrcsi_axis_make(0, 0.0, 180.0, 7.0);
    assert_string_equal(names(&axis), "0 50 100 150 200");
    axis = lrcsi_axis_make(0, 1e9, 3e9, 5.0);
    assert_string_equal(names(&axis), "10e8 15e8 20e8 25e8 30e8");
}

static void angles_are_parts_of_a_turn(void **state)
{
    (void)state;
    lrcsi_axis axis = lrcsi_axis_make(LRCSI_AXIS_DEG, 0.0, 360.0, 8.0);
    assert_string_equal(names(&axis), "0 45 90 135 180 225 270 315 360");
    axis = lrcsi_axis_make(LRCSI_AXIS_DEG, -90.0, 90.0, 7.0);
    assert_string_equal(names(&axis), "-90 -60 -30 0 30 60 90");
    axis = lrcsi_axis_make(LRCSI_AXIS_DEG, 0.0, 350.0, 5.0);
    assert_string_equal(names(&axis), "0 90 180 270 360");
    check_same(axis.high, 360.0);
    axis = lrcsi_axis_make(LRCSI_AXIS_DEG, 1.0, 2.0, 5.0); /* few: as any number */
    assert_string_equal(names(&axis), "1.0 1.2 1.4 1.6 1.8 2.0");
    axis = lrcsi_axis_make(LRCSI_AXIS_DEG, -1e15, 1e15, 4.0);
    check_most(axis.low, -1e15);
    axis = lrcsi_axis_make(LRCSI_AXIS_DEG, HUGE_VAL, -HUGE_VAL, 5.0);
    assert_true(axis.count > 1);
}

static void ends_cover_the_data_and_ticks_ascend(void **state)
{
    (void)state;
    static const double spans[] = {1.0, 1.3, 7.0, 99.0, 1001.0, 3e7, 1e16, 1e100};
    for (double low = 1e-200; low < 1e150; low *= 937.0) {
        for (size_t i = 0; i < sizeof spans / sizeof spans[0]; i++) {
            check_axis(1, low, low * spans[i], 16.0);
            check_axis(1, low, low * spans[i], 4.0);
            check_axis(0, low, low * spans[i], 8.0);
            check_axis(0, -low * spans[i], low, 8.0);
        }
    }
}

static void nothing_to_show_still_makes_an_axis(void **state)
{
    (void)state;
    lrcsi_axis axis = lrcsi_axis_make(1, HUGE_VAL, -HUGE_VAL, 10.0);
    check_same(axis.low, 0.1);
    check_same(axis.high, 1.0);
    axis = lrcsi_axis_make(0, HUGE_VAL, -HUGE_VAL, 10.0);
    check_same(axis.low, 0.0);
    check_same(axis.high, 1.0);
    axis = lrcsi_axis_make(0, 0.0, 0.0, 10.0);
    assert_true(axis.low < 0.0 && axis.high > 0.0);
    axis = lrcsi_axis_make(0, -1e300, 1e300, 10.0);
    assert_true(axis.count > 1 && axis.count < LRCSI_AXIS_TICKS);
}

static void places_are_proportional(void **state)
{
    (void)state;
    lrcsi_axis axis = lrcsi_axis_make(1, 1.0, 10000.0, 5.0);
    check_abs(lrcsi_axis_at(&axis, 100.0), 0.5, 1e-15);
    assert_true(lrcsi_axis_at(&axis, 0.0) == -HUGE_VAL);
    axis = lrcsi_axis_make(0, 0.0, 10.0, 5.0);
    check_abs(lrcsi_axis_at(&axis, 2.5), 0.25, 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(many_decades_are_named_as_powers_of_ten),
        cmocka_unit_test(more_decades_than_room_are_named_in_steps),
        cmocka_unit_test(few_decades_are_named_at_1_2_and_5),
        cmocka_unit_test(decades_between_have_eight_minor_ticks),
        cmocka_unit_test(equal_steps_are_1_2_or_5),
        cmocka_unit_test(angles_are_parts_of_a_turn),
        cmocka_unit_test(ends_cover_the_data_and_ticks_ascend),
        cmocka_unit_test(nothing_to_show_still_makes_an_axis),
        cmocka_unit_test(places_are_proportional),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
