/* SPDX-License-Identifier: MIT */
/* Plans of sweeps: how many rows there are, their values and poses, the solid angles that they
   stand for, the scenes that they change, and their peaks. */
#include <lrcs/plan.h>
#include <lrcs/sweep.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "random.h"

static lrcs_host_plan plan;
static lrcs_host_error error;

#define MAKE(...)                                                                                  \
    plan_of(                                                                                       \
        (const lrcs_host_plan_text[]){__VA_ARGS__},                                                \
        (int)(sizeof((const lrcs_host_plan_text[]){__VA_ARGS__}) / sizeof(lrcs_host_plan_text)))

static int plan_of(const lrcs_host_plan_text *given, int count)
{
    error.text[0] = '\0';
    return lrcs_host_plan_make(given, count, NULL, &plan, &error);
}

/* ---- rows ---- */

static void the_last_quantity_varies_fastest(void **state)
{
    (void)state;
    assert_int_equal(MAKE({"el", "-10:10:10"}, {"vary", "foil.A:1:2:0.5"}, {"az", "0:3:1"}),
                     LRCS_OK);
    assert_int_equal(plan.rows, 3 * 3 * 4);
    assert_int_equal(plan.poses, 3 * 4);
    assert_int_equal(plan.columns, 3);
    assert_string_equal(plan.column[0], "foil.A");
    assert_string_equal(plan.column[1], "el_deg");
    for (uint64_t row = 0; row < plan.rows; row++) {
        double value[LRCS_HOST_PLAN_COLUMNS];
        lrcs_pose pose, want;
        lrcs_host_plan_values(&plan, row, value);
        check_same(value[0], 1.0 + 0.5 * (double)(row / 12));
        check_same(value[1], -10.0 + 10.0 * (double)(row / 4 % 3));
        check_same(value[2], (double)(row % 4));
        assert_int_equal(lrcs_host_plan_pose(&plan, row, &pose), LRCS_OK);
        assert_int_equal(lrcs_pose_from_azel(value[2], value[1], &want), LRCS_OK);
        assert_memory_equal(&pose, &want, sizeof pose);
    }
    lrcs_host_plan_free(&plan);
}

/* Each value is the double that its decimal text is, however many steps precede it. */
static void ranges_are_exact_decimals(void **state)
{
    (void)state;
    assert_int_equal(MAKE({"az", "-1.7:1000:0.1"}), LRCS_OK);
    assert_int_equal(plan.rows, 10018);
    for (uint64_t row = 0; row < plan.rows; row++) {
        char text[32];
        double value[LRCS_HOST_PLAN_COLUMNS];
        long tenths = (long)row - 17;
        lrcs_host_plan_values(&plan, row, value);
        snprintf(text, sizeof text, "%s%ld.%ld", tenths < 0 ? "-" : "", labs(tenths) / 10,
                 labs(tenths) % 10);
        check_same(value[0], strtod(text, NULL));
    }
    lrcs_host_plan_free(&plan);
    assert_int_equal(MAKE({"az", "2e1:-2e1:-20"}), LRCS_OK);
    assert_int_equal(plan.rows, 3);
    check_same(lrcs_host_range_at(&plan.axis[0].range, 2), -20.0);
}

static void faults_begin_with_their_key(void **state)
{
    static const struct {
        const char *key, *text;
        int status;
        const char *says;
    } bad[] = {{"az", "0:10:-1", LRCS_E_ARGUMENT,
                "az: expected A:B:STEP with a STEP that leads from A to B"},
               {"el", "0:10:0", LRCS_E_ARGUMENT, "el: expected A:B:STEP with a STEP"},
               {"az", "0:10:1:2", LRCS_E_ARGUMENT, "az: expected A:B:STEP or one number"},
               {"az", "0.12345678901234567:1:1", LRCS_E_ARGUMENT, "az: a number has too many"},
               {"euler", "XXZ:0,0,0", LRCS_E_ARGUMENT, "euler: expected"},
               {"euler", "XYZ:0:1:1,0", LRCS_E_ARGUMENT, "euler: expected three angles"},
               {"rotate", "0,0,0:0:1:1", LRCS_E_ARGUMENT, "rotate: expected"},
               {"sphere", "1.5", LRCS_E_ARGUMENT, "sphere: expected a whole number"},
               {"vary", "foil.Q:0:1:1", LRCS_E_ARGUMENT, "vary: expected MATERIAL.A"},
               {"joint", "wing", LRCS_E_ARGUMENT, "joint: expected PART:A:B:STEP"},
               {"azel", "1,2", LRCS_E_EMPTY, "nothing varies"},
               {"quaternion", "0,0,0,0", LRCS_E_ARGUMENT, "quaternion: expected"}};
    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(MAKE({bad[i].key, bad[i].text}), bad[i].status);
        assert_ptr_equal(strstr(error.text, bad[i].says), error.text);
        lrcs_host_plan_free(&plan);
    }
    assert_int_equal(MAKE({"az", "0:100000000:1"}, {"el", "0:100000000:1"}), LRCS_E_LIMIT);
    assert_true(lrcs_host_plan_takes("az"));
    assert_false(lrcs_host_plan_takes("poses"));
}

/* ---- solid angles ---- */

/* The cells of a map of the whole sphere add up to it; of a part, to that part and half a step of
   elevation around it: 2 (sin of its ends), times the azimuths. */
static void weights_are_solid_angles(void **state)
{
    static const struct {
        const char *az, *el;
        double turns, low, high;
    } map[] = {{"0:360:10", "-90:90:10", 36, -90, 90},
               {"0:350:10", "-90:90:5", 36, -90, 90},
               {"-180:180:20", "-30:60:15", 18, -37.5, 67.5},
               {"0:90:10", "80:90:2", 10, 79, 90}};
    (void)state;
    for (size_t i = 0; i < sizeof map / sizeof *map; i++) {
        double sum = 0.0;
        assert_int_equal(MAKE({"az", map[i].az}, {"el", map[i].el}), LRCS_OK);
        assert_true(lrcs_host_plan_is_map(&plan));
        for (uint64_t row = 0; row < plan.rows; row++) {
            sum += lrcs_host_plan_weight(&plan, row);
        }
        double degree = acos(-1.0) / 180.0;
        check_rel(sum, map[i].turns * (sin(map[i].high * degree) - sin(map[i].low * degree)),
                  1e-12);
    }
    assert_int_equal(MAKE({"az", "0:360:10"}), LRCS_OK);
    assert_false(lrcs_host_plan_is_map(&plan));
    assert_int_equal(MAKE({"az", "0:360:10"}, {"el", "0:100:10"}), LRCS_OK);
    assert_false(lrcs_host_plan_is_map(&plan));
    assert_int_equal(MAKE({"sphere", "100"}), LRCS_OK);
    assert_true(lrcs_host_plan_is_sphere(&plan));
}

/* ---- what changes the scene ---- */

static void rows_change_what_they_name(void **state)
{
    (void)state;
    lrcs_host_options options = lrcs_host_options_default();
    lrcs_host_scene base, own;
    memset(&base, 0, sizeof base);
    memset(&own, 0, sizeof own);
    assert_int_equal(lrcs_host_scene_read("demo", &options, &base, &error), LRCS_OK);
    assert_int_equal(MAKE({"vary", "foil.B:0.1:0.3:0.1"}, {"joint", "wing +x:0:90:90"}), LRCS_OK);
    assert_true(lrcs_host_plan_varies_scene(&plan));
    assert_int_equal(lrcs_host_plan_check(&plan, &base, &error), LRCS_OK);
    assert_int_equal(lrcs_host_plan_scene(&plan, 3, &base, &options.build, &own, &error), LRCS_OK);
    assert_non_null(own.prepared);
    int found = 0;
    for (uint32_t i = 0; i < own.scene.material_count; i++) {
        if (strcmp(own.scene.material[i].name, "foil") == 0) {
            check_same(own.scene.material[i].brdf.B, 0.2);
            found++;
        }
    }
    assert_true(found > 0);
    assert_true(lrcs_scene_hash(&own.scene) != lrcs_scene_hash(&base.scene));
    lrcs_host_scene_free(&own);
    static const lrcs_host_plan_text bad[][1] = {{{"vary", "fool.B:0:1:1"}},
                                                 {{"vary", "foil.s:0:1:1"}},
                                                 {{"vary", "bus.radius:0:1:1"}},
                                                 {{"joint", "bus:0:1:1"}}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(plan_of(bad[i], 1), LRCS_OK);
        assert_int_equal(lrcs_host_plan_check(&plan, &base, &error), LRCS_E_ARGUMENT);
        assert_ptr_equal(strstr(error.text, bad[i][0].key), error.text);
    }
    lrcs_host_scene_free(&base);
}

/* ---- poses ---- */

static void texts_give_the_poses_that_numbers_give(void **state)
{
    const double d[3] = {1, 2, 3}, angles[3] = {10, 20, 30}, q[4] = {1, 0, 0, 1};
    lrcs_pose pose, want;
    (void)state;
    assert_int_equal(lrcs_host_pose_read("direction", "1,2,3", &pose, &error), LRCS_OK);
    assert_int_equal(lrcs_pose_from_direction(d, &want), LRCS_OK);
    assert_memory_equal(&pose, &want, sizeof pose);
    assert_int_equal(lrcs_host_pose_read("azel", "10, 20", &pose, &error), LRCS_OK);
    assert_int_equal(lrcs_pose_from_azel(10, 20, &want), LRCS_OK);
    assert_memory_equal(&pose, &want, sizeof pose);
    assert_int_equal(lrcs_host_pose_read("euler", "zyx:10,20,30", &pose, &error), LRCS_OK);
    assert_int_equal(lrcs_pose_from_euler("zyx", angles, &want), LRCS_OK);
    assert_memory_equal(&pose, &want, sizeof pose);
    assert_int_equal(lrcs_host_pose_read("quaternion", "1,0,0,1", &pose, &error), LRCS_OK);
    assert_int_equal(lrcs_pose_from_quaternion(q, &want), LRCS_OK);
    assert_memory_equal(&pose, &want, sizeof pose);
    static const char *const bad[][2] = {{"direction", "0,0,0"},   {"direction", "1,2"},
                                         {"azel", "1,2,3"},        {"euler", "XYX1,2,3"},
                                         {"euler", "XXY:1,2,3"},   {"quaternion", "0,0,0,0"},
                                         {"quaternion", "1,0,0,"}, {"direction", "1,2,inf"}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(lrcs_host_pose_read(bad[i][0], bad[i][1], &pose, &error), LRCS_E_ARGUMENT);
        assert_ptr_equal(strstr(error.text, bad[i][0]), error.text);
        assert_memory_equal(&pose, &want, sizeof pose);
    }
    assert_int_equal(lrcs_host_pose_read("aim", "1", &pose, &error), LRCS_E_NAME);
}

/* ---- peaks ---- */

#define PEAK_ROWS 4096u
static double sigma[PEAK_ROWS][2];

/* By definition, for a map whose azimuths close and which has both poles. */
static int is_peak(uint64_t row, uint64_t azs, uint64_t els)
{
    uint64_t az = row / els;
    uint64_t el = row % els;
    int pole = el == 0 || el == els - 1;
    for (uint64_t other = 0; other < azs * els; other++) {
        uint64_t a = other / els;
        uint64_t e = other % els;
        uint64_t apart = a > az ? a - az : az - a;
        int near_az = pole || apart <= 1 || apart == azs - 1;
        int near_el = e <= el + 1 && el <= e + 1;
        int above =
            sigma[other][0] > sigma[row][0] || (sigma[other][0] == sigma[row][0] && other < row);
        if (other != row && near_az && near_el && above) {
            return 0;
        }
    }
    return sigma[row][0] > 0.0 && (!pole || az == 0);
}

static void peaks_of_a_map_are_those_of_the_definition(void **state)
{
    (void)state;
    uint64_t peak[PEAK_ROWS];
    uint64_t seed = 3;
    const uint64_t azs = 24;
    const uint64_t els = 13;
    assert_int_equal(MAKE({"az", "0:345:15"}, {"el", "-90:90:15"}), LRCS_OK);
    assert_int_equal(plan.rows, azs * els);
    for (int trial = 0; trial < 20; trial++) {
        for (uint64_t i = 0; i < plan.rows; i++) { /* few values, so that many are equal */
            int pole = i % els == 0 || i % els == els - 1;
            double value = floor(8.0 * random_unit(&seed));
            sigma[i][0] = pole && i >= els ? sigma[i % els][0] : value;
        }
        uint32_t want = 0;
        for (uint64_t i = 0; i < plan.rows; i++) {
            want += (uint32_t)is_peak(i, azs, els);
        }
        uint32_t count = lrcs_host_plan_peaks(&plan, (const double(*)[2])sigma, PEAK_ROWS, peak);
        assert_int_equal(count, want);
        for (uint32_t i = 0; i < count; i++) {
            assert_true(is_peak(peak[i], azs, els));
            assert_true(i == 0 || sigma[peak[i - 1]][0] >= sigma[peak[i]][0]);
        }
        uint64_t few[3];
        assert_int_equal(lrcs_host_plan_peaks(&plan, (const double(*)[2])sigma, 3, few), 3);
        assert_true(sigma[few[2]][0] == sigma[peak[2]][0]);
    }
}

/* sigma falls with the angle from a direction: of a sphere of points, the nearest one is the only
   peak. */
static void a_sphere_has_the_peak_that_is_there(void **state)
{
    (void)state;
    uint64_t peak[8];
    assert_int_equal(MAKE({"sphere", "1000"}), LRCS_OK);
    uint64_t best = 0;
    for (uint64_t i = 0; i < plan.rows; i++) {
        lrcs_pose pose;
        assert_int_equal(lrcs_host_plan_pose(&plan, i, &pose), LRCS_OK);
        sigma[i][0] = 2.0 + pose.R[2][0] * 0.6 + pose.R[2][1] * 0.64 + pose.R[2][2] * 0.48;
        best = sigma[i][0] > sigma[best][0] ? i : best;
    }
    assert_int_equal(lrcs_host_plan_peaks(&plan, (const double(*)[2])sigma, 8, peak), 1);
    assert_int_equal(peak[0], best);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_last_quantity_varies_fastest),
        cmocka_unit_test(ranges_are_exact_decimals),
        cmocka_unit_test(faults_begin_with_their_key),
        cmocka_unit_test(weights_are_solid_angles),
        cmocka_unit_test(rows_change_what_they_name),
        cmocka_unit_test(texts_give_the_poses_that_numbers_give),
        cmocka_unit_test(peaks_of_a_map_are_those_of_the_definition),
        cmocka_unit_test(a_sphere_has_the_peak_that_is_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
