/* SPDX-License-Identifier: MIT */
/* JSON and numbers as text. */
#include <lrcs/host.h>

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "file_text.h"

static void check_quoted(const char *text, const char *want)
{
    FILE *file = tmpfile();
    lrcs_host_json json = lrcs_host_json_make(file);
    lrcs_host_json_text(&json, NULL, text);
    char *got = file_text(file);
    assert_string_equal(got, want);
    free(got);
}

static void strings_are_escaped(void **state)
{
    (void)state;
    check_quoted("plain", "\"plain\"");
    check_quoted("a\"b\\c/", "\"a\\\"b\\\\c/\"");
    check_quoted("\n\t\x01\x7f", "\"\\u000a\\u0009\\u0001\\u007f\"");
    check_quoted("d\xc3\xa9or\xe2\x82\xac\xf0\x9f\x9b\xb0",
                 "\"d\xc3\xa9or\xe2\x82\xac\xf0\x9f\x9b\xb0\"");
    check_quoted(NULL, "null");
}

static void bytes_that_are_not_utf8_become_the_replacement_character(void **state)
{
    (void)state;
    check_quoted("\xff", "\"\\ufffd\"");
    check_quoted("a\x80z", "\"a\\ufffdz\"");
    check_quoted("\xc0\xaf", "\"\\ufffd\\ufffd\"");            /* overlong */
    check_quoted("\xed\xa0\x80", "\"\\ufffd\\ufffd\\ufffd\""); /* surrogate */
    check_quoted("\xe2\x82", "\"\\ufffd\\ufffd\"");            /* cut short */
    check_quoted("\xf5\x80\x80\x80", "\"\\ufffd\\ufffd\\ufffd\\ufffd\"");
}

static void a_sketch_writes_several_items(void **state)
{
    (void)state;
    FILE *file = tmpfile();
    const char *volatile none = NULL; /* which the compiler does not see */
    const double three[] = {0.5, -1.0, (double)INFINITY};
    lrcs_host_json json = lrcs_host_json_make(file);
    lrcs_host_json_put(&json, "{\nname=%s n=%u large=%llu x=%g on=%d none=null row={a=%d b=[%u %u]",
                       "a \"b\"", 3u, 1ull << 40, 0.25, 1, 0, 1u, 2u);
    lrcs_host_json_put(&json, "} missing=%s lost=%g", none, (double)NAN);
    lrcs_host_json_numbers(&json, "three", three, 3);
    lrcs_host_json_put(&json, "}");
    char *got = file_text(file);
    assert_string_equal(got, "{\n  \"name\": \"a \\\"b\\\"\",\n  \"n\": 3,\n"
                             "  \"large\": 1099511627776,\n  \"x\": 0.25,\n  \"on\": true,\n"
                             "  \"none\": null,\n  \"row\": {\"a\": false, \"b\": [1, 2]},\n"
                             "  \"missing\": null,\n  \"lost\": null,\n"
                             "  \"three\": [0.5, -1, null]\n}\n");
    free(got);
}

static void containers_nest_with_commas_where_they_belong(void **state)
{
    (void)state;
    FILE *file = tmpfile();
    lrcs_host_json json = lrcs_host_json_make(file);
    lrcs_host_json_begin(&json, NULL, LRCS_HOST_OBJECT);
    lrcs_host_json_count(&json, "n", UINT64_MAX);
    lrcs_host_json_begin(&json, "empty", LRCS_HOST_ARRAY);
    lrcs_host_json_end(&json);
    lrcs_host_json_begin(&json, "row", LRCS_HOST_ROW_ARRAY);
    lrcs_host_json_bool(&json, NULL, 1);
    lrcs_host_json_bool(&json, NULL, 0);
    lrcs_host_json_begin(&json, NULL, LRCS_HOST_OBJECT);
    lrcs_host_json_number(&json, "x", 0.5);
    lrcs_host_json_end(&json);
    lrcs_host_json_end(&json);
    lrcs_host_json_end(&json);
    char *got = file_text(file);
    assert_string_equal(got, "{\n  \"n\": 18446744073709551615,\n  \"empty\": [],\n"
                             "  \"row\": [true, false, {\"x\": 0.5}]\n}\n");
    free(got);
}

static void numbers_have_17_digits_and_come_back(void **state)
{
    (void)state;
    static const double value[] = {0.1,    -0.0,    1.0 / 3.0, 5e-324, 1.7976931348623157e308,
                                   -1e-17, 123456., 1e22,      1e100};
    for (size_t i = 0; i < sizeof value / sizeof value[0]; i++) {
        char text[LRCS_HOST_NUMBER_SIZE];
        char want[64];
        double back = NAN;
        lrcs_host_number_text(value[i], text);
        snprintf(want, sizeof want, "%.17g", value[i]);
        assert_string_equal(text, want);
        assert_int_equal(lrcs_host_number_read(text, strlen(text), &back), LRCS_OK);
        check_same(back, value[i]);
    }
}

static void what_is_not_finite_is_null(void **state)
{
    (void)state;
    FILE *file = tmpfile();
    lrcs_host_json json = lrcs_host_json_make(file);
    lrcs_host_json_begin(&json, NULL, LRCS_HOST_ROW_ARRAY);
    lrcs_host_json_number(&json, NULL, (double)NAN);
    lrcs_host_json_number(&json, NULL, (double)INFINITY);
    lrcs_host_json_number(&json, NULL, -(double)INFINITY);
    lrcs_host_json_end(&json);
    char *got = file_text(file);
    assert_string_equal(got, "[null, null, null]\n");
    free(got);
}

static void text_that_is_no_number_is_refused(void **state)
{
    (void)state;
    static const char *const bad[] = {"",    " ",  "x",   "1x",    "1 2",    "nan", "inf", "0x10",
                                      "1,5", "1e", "--1", "1e400", "-1e400", ".",   "+",   "1.2.3"};
    double value = 7.0;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        assert_true(lrcs_host_number_read(bad[i], strlen(bad[i]), &value) < 0);
        check_same(value, 7.0);
    }
    assert_int_equal(lrcs_host_number_read(" -1.5e-3 ", 9, &value), LRCS_OK);
    check_same(value, -1.5e-3);
}

/* Any locale of the machine whose decimal separator is a comma; the test says when it has none. */
static void a_comma_locale_changes_nothing(void **state)
{
    (void)state;
    static const char *const name[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE"};
    int found = 0;
    for (size_t i = 0; i < sizeof name / sizeof name[0] && !found; i++) {
        found = setlocale(LC_ALL, name[i]) != NULL;
    }
    if (!found) {
        print_message("no locale with a comma here: skipped\n");
        skip();
    }
    char text[LRCS_HOST_NUMBER_SIZE];
    double value = 0.0;
    lrcs_host_number_text(1.5, text);
    int status = lrcs_host_number_read("1.5", 3, &value);
    setlocale(LC_ALL, "C");
    assert_string_equal(text, "1.5");
    assert_int_equal(status, LRCS_OK);
    check_same(value, 1.5);
}

static void bounds_are_rounded_up(void **state)
{
    static const struct {
        double bound;
        int digits;
        const char *want;
    } item[] = {{0.0, 2, "0"},        {1.0, 2, "1"},        {1.01, 2, "1.1"},
                {0.0999, 2, "0.1"},   {1.2e-9, 1, "2e-09"}, {9.96e-9, 2, "1e-08"},
                {123.0, 2, "1.3e+02"}};
    (void)state;
    for (size_t i = 0; i < sizeof item / sizeof *item; i++) {
        char text[LRCS_HOST_BOUND_SIZE];
        lrcs_host_bound_text(item[i].bound, item[i].digits, text);
        assert_string_equal(text, item[i].want);
        assert_true(strtod(text, NULL) >= item[i].bound);
    }
}

static void text_is_appended_as_far_as_there_is_room(void **state)
{
    (void)state;
    char text[8] = "";
    lrcs_host_append(text, sizeof text, "%s-%d", "ab", 12);
    assert_string_equal(text, "ab-12");
    lrcs_host_append(text, sizeof text, "xyz");
    assert_string_equal(text, "ab-12xy");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(strings_are_escaped),
        cmocka_unit_test(bytes_that_are_not_utf8_become_the_replacement_character),
        cmocka_unit_test(a_sketch_writes_several_items),
        cmocka_unit_test(containers_nest_with_commas_where_they_belong),
        cmocka_unit_test(numbers_have_17_digits_and_come_back),
        cmocka_unit_test(what_is_not_finite_is_null),
        cmocka_unit_test(text_that_is_no_number_is_refused),
        cmocka_unit_test(a_comma_locale_changes_nothing),
        cmocka_unit_test(bounds_are_rounded_up),
        cmocka_unit_test(text_is_appended_as_far_as_there_is_room),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
