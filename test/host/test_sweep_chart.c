/* SPDX-License-Identifier: MIT */
/* Charts of sweeps: what runs along which axis, what cannot be drawn, and the texts. test_chart.c
   and test_chart.sh look at the drawings. */
#include <lrcs/sweep_chart.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "file_text.h"

static lrcs_host_error error;
static lrcs_host_plan plan;

static lrcs_host_sweep_chart chart_of(const char *az, const char *el)
{
    const lrcs_host_plan_text given[] = {{"az", az}, {"el", el}};
    lrcs_host_plan_free(&plan);
    assert_int_equal(lrcs_host_plan_make(given, el ? 2 : 1, NULL, &plan, &error), LRCS_OK);
    return (lrcs_host_sweep_chart){.plan = &plan, .title = "body"};
}

static void the_longer_axis_runs_along_x(void **state)
{
    (void)state;
    lrcs_host_sweep_chart chart = chart_of("0:330:30", "-30:30:30");
    assert_int_equal(lrcs_host_sweep_chart_choose(&chart), 2);
    assert_string_equal(chart.x.name, "az_deg");
    assert_int_equal(chart.y.count, 3);
    assert_false(chart.map || chart.swapped);
    chart = chart_of("0:60:30", "-60:60:10");
    assert_int_equal(lrcs_host_sweep_chart_choose(&chart), 2);
    assert_string_equal(chart.x.name, "el_deg");
    assert_true(chart.swapped);
    chart = chart_of("0:330:30", "0");
    assert_int_equal(lrcs_host_sweep_chart_choose(&chart), 1);
    assert_int_equal(chart.y.count, 1);
}

static void many_values_along_both_axes_make_a_map(void **state)
{
    (void)state;
    lrcs_host_sweep_chart chart = chart_of("0:330:30", "-80:80:20");
    assert_int_equal(lrcs_host_sweep_chart_check(&chart, &error), LRCS_OK);
    assert_true(chart.map);
    chart.polar = 1;
    assert_int_equal(lrcs_host_sweep_chart_check(&chart, &error), LRCS_E_ARGUMENT);
    assert_string_equal(error.text, "polar: expected at most 7 curves, found 9");
    chart = chart_of("0:720:30", "-80:80:20");
    chart.mollweide = 1;
    assert_int_equal(lrcs_host_sweep_chart_check(&chart, &error), LRCS_E_ARGUMENT);
    chart = chart_of("0:360:30", "-90:90:20");
    chart.mollweide = 1;
    assert_int_equal(lrcs_host_sweep_chart_check(&chart, &error), LRCS_OK);
}

static void a_sphere_is_a_map_whose_step_suits_its_directions(void **state)
{
    (void)state;
    const lrcs_host_plan_text given[] = {{"sphere", "40"}};
    lrcs_host_plan_free(&plan);
    assert_int_equal(lrcs_host_plan_make(given, 1, NULL, &plan, &error), LRCS_OK);
    lrcs_host_sweep_chart chart = {.plan = &plan};
    assert_int_equal(lrcs_host_sweep_chart_check(&chart, &error), LRCS_OK);
    assert_true(chart.map);
    assert_int_equal(chart.x.count, 73); /* 40 directions are some 32 deg apart: steps of 5 deg */
    assert_int_equal(chart.y.count, 37);
    chart.polar = 1;
    assert_int_equal(lrcs_host_sweep_chart_check(&chart, &error), LRCS_E_ARGUMENT);
}

/* Three rows, of a range that descends. */
static void the_drawing_says_what_it_shows(void **state)
{
    (void)state;
    double row[3][2] = {{4.0, 0.01}, {0.0, 0.0015}, {2.0, 0.0}};
    double band[3][2] = {{3.0, 5.0}, {0.0, 0.0}, {1.0, 3.0}};
    double part[2];
    lrcs_host_sweep_chart chart = chart_of("90:0:-45", NULL);
    assert_int_equal(lrcs_host_sweep_chart_check(&chart, &error), LRCS_OK);
    chart.row = row;
    chart.band = band;
    chart.dbsm = 1;
    /* half widths of 1/4 and 1/2 of sigma; sigma of the other row is 0 */
    assert_int_equal(lrcs_host_sweep_chart_band(&chart, part, &error), LRCS_OK);
    assert_true(part[0] == 0.375 && part[1] == 0.5);
    FILE *file = tmpfile();
    assert_int_equal(lrcs_host_sweep_chart_write(file, &chart, 1, 0, &error), LRCS_OK);
    char *got = file_text(file);
    assert_non_null(strstr(got, "Laser radar cross-section of body"));
    assert_non_null(strstr(got,
                           "each sigma is proved to within 0.01 m2 or better; shaded: 68 % by the "
                           "errors of materials; gaps: sigma is 0"));
    assert_non_null(strstr(got, "azimuth (deg)"));
    assert_non_null(strstr(got, "sigma (dBsm)"));
    free(got);
    file = tmpfile();
    assert_int_equal(lrcs_host_sweep_chart_write(file, &chart, 1, 1, &error), LRCS_OK);
    got = file_text(file);
    assert_memory_equal(got, "\x89PNG", 4);
    free(got);
    lrcs_host_plan_free(&plan);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_longer_axis_runs_along_x),
        cmocka_unit_test(many_values_along_both_axes_make_a_map),
        cmocka_unit_test(a_sphere_is_a_map_whose_step_suits_its_directions),
        cmocka_unit_test(the_drawing_says_what_it_shows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
