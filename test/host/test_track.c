/* SPDX-License-Identifier: MIT */
/* Attitudes over time from tables: which column is which, dates, and what is refused.
   test/cli/test_sweep_track.sh checks the sweeps that follow. */
#include <lrcs/track.h>

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"

static char path[] = "/tmp/lrcs-test-XXXXXX";
static lrcs_host_track track;
static lrcs_host_error error;

static int path_make(void **state)
{
    (void)state;
    int descriptor = mkstemp(path);
    return descriptor < 0 ? -1 : close(descriptor);
}

static int path_remove(void **state)
{
    (void)state;
    return remove(path);
}

static int text_read(const char *text)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    error.text[0] = '\0';
    return lrcs_host_track_read(path, &track, &error);
}

static void four_columns_are_a_direction_and_five_a_quaternion(void **state)
{
    (void)state;
    assert_int_equal(text_read("0,1,0,0\n1.5,0,1,0\n"), LRCS_OK);
    assert_int_equal(track.count, 2);
    assert_false(track.quaternions);
    check_same(track.row[1][0], 1.5);
    check_same(track.row[1][2], 1.0);
    lrcs_host_track_free(&track);
    assert_int_equal(text_read("0 1 0 0 0\n"), LRCS_OK);
    assert_true(track.quaternions);
    check_same(track.row[0][1], 1.0);
    lrcs_host_track_free(&track);
    assert_int_equal(text_read("0,1,0\n"), LRCS_E_SYNTAX);
    lrcs_host_track_free(&track);
}

static void names_decide_what_columns_are(void **state)
{
    (void)state;
    assert_int_equal(text_read("z;y;spare;joint:arm;x;t\n3;2;9;45;1;7\n"), LRCS_OK);
    const double want[4] = {7, 1, 2, 3};
    for (int k = 0; k < 4; k++) {
        check_same(track.row[0][k], want[k]);
    }
    assert_int_equal(track.joints, 1);
    assert_string_equal(track.joint_name[0], "joint:arm");
    check_same(track.joint[0][0], 45.0);
    assert_int_equal(track.notices.count, 1);
    assert_non_null(strstr(track.notices.text[0], "column 'spare' is not used"));
    lrcs_host_track_free(&track);
    /* x, y, z belong to a quaternion where there is a w */
    assert_int_equal(text_read("time,x,y,z,w\n0,1,2,3,4\n"), LRCS_OK);
    assert_true(track.quaternions);
    check_same(track.row[0][1], 4.0);
    check_same(track.row[0][4], 3.0);
    lrcs_host_track_free(&track);
}

/* Days of the Gregorian calendar, leap days included. */
static void dates_are_seconds_from_the_first(void **state)
{
    (void)state;
    assert_int_equal(text_read("2023-12-31T23:59:59.5Z,1,0,0\n2024-01-01T00:00:00Z,1,0,0\n"
                               "2024-02-29T00:00:00Z,1,0,0\n2025-02-28 00:00:00z,1,0,0\n"),
                     LRCS_OK);
    const double want[4] = {0.0, 0.5, 59 * 86400.0 + 0.5, (59 + 365) * 86400.0 + 0.5};
    for (int i = 0; i < 4; i++) {
        check_same(track.row[i][0], want[i]);
    }
    assert_string_equal(track.epoch, "2023-12-31T23:59:59.5Z");
    lrcs_host_track_free(&track);
}

static void faults_are_named_with_their_line(void **state)
{
    static const struct {
        const char *text;
        int status;
        const char *says;
    } bad[] = {{"", LRCS_E_EMPTY, "no attitude"},
               {"time,x,y,z\n", LRCS_E_EMPTY, "no attitude"},
               {"time,x,y\n0,1,0\n", LRCS_E_NAME, "line 1: expected columns"},
               {"time,x,x,y,z\n0,1,1,0,0\n", LRCS_E_NAME, "two columns are the same"},
               {"time,x,y,z,joint:\n0,1,1,0,0\n", LRCS_E_NAME, "expected joint:PART"},
               {"time,x,y,z\n0,0,0,0\n", LRCS_E_ARGUMENT, "line 2: expected a quaternion"},
               {"time,x,y,z\n0,a,0,0\n", LRCS_E_SYNTAX, "line 2"},
               {"2023-02-29T00:00:00Z,1,0,0\n", LRCS_E_NAME, "expected columns"},
               {"time,x,y,z\n2024-01-01T00:00:00Z,1,0,0\n5,1,0,0\n", LRCS_E_SYNTAX, "line 3"},
               {"time,x,y,z\n0,1,0,0\n1,1,0\n", LRCS_E_SYNTAX, "line 3"}};
    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        assert_int_equal(text_read(bad[i].text), bad[i].status);
        assert_non_null(strstr(error.text, bad[i].says));
        lrcs_host_track_free(&track);
    }
    assert_int_equal(lrcs_host_track_read("/nowhere", &track, &error), LRCS_E_SYSTEM);
    lrcs_host_track_free(&track);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(four_columns_are_a_direction_and_five_a_quaternion),
        cmocka_unit_test(names_decide_what_columns_are),
        cmocka_unit_test(dates_are_seconds_from_the_first),
        cmocka_unit_test(faults_are_named_with_their_line),
    };
    return cmocka_run_group_tests(tests, path_make, path_remove);
}
