/* SPDX-License-Identifier: MIT */
/* Tables of text: what a row and a field are, and what is refused, with its place. */
#include <lrcs/table.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"

/* The rows of a text as "a|b/c|d", every field as it was read; the status at the end. */
static int rows(const char *text, size_t size, char *said, lrcs_host_error *error)
{
    unsigned char *bytes = malloc(size + 1); /* to the byte: what reads beyond is seen */
    memcpy(bytes, text, size);
    lrcs_host_file file = {bytes, size};
    lrcs_host_table table = lrcs_host_table_make("t.csv", &file);
    int status;
    char *at = said;
    while ((status = lrcs_host_table_read(&table, error)) == 1) {
        for (uint32_t i = 0; i < table.columns; i++) {
            at += sprintf(at, "%s%.*s",
                          i            ? "|"
                          : at == said ? ""
                                       : "/",
                          (int)table.field[i].size, table.field[i].text);
        }
    }
    *at = '\0';
    free(bytes);
    return status;
}

static void check_rows(const char *text, const char *want)
{
    char said[4096];
    assert_int_equal(rows(text, strlen(text), said, NULL), 0);
    assert_string_equal(said, want);
}

static void check_refused(const char *text, int status, const char *want)
{
    char said[4096];
    lrcs_host_error error;
    assert_int_equal(rows(text, strlen(text), said, &error), status);
    assert_string_equal(error.text, want);
}

static void the_first_line_decides_what_separates(void **state)
{
    (void)state;
    check_rows("a,b\n1,2\n", "a|b/1|2");
    check_rows("a;b\n1,5;2,5\n", "a|b/1,5|2,5");
    check_rows("a\tb\n1\t\n", "a|b/1|");
    check_rows("a  b\n  1 \t 2\n", "a|b/1|2");
    check_rows("one\n1\n", "one/1");
}

static void lines_end_as_any_system_ends_them(void **state)
{
    (void)state;
    check_rows("1,2\r\n3,4\r5,6\n7,8", "1|2/3|4/5|6/7|8");
    check_rows("\n\n# a remark, with a comma\n  \n1,2\n#\n", "1|2");
    check_rows("\xef\xbb\xbf"
               "1,2\n",
               "1|2");
    check_rows("", "");
    check_rows("\xef\xbb\xbf", "");
    check_rows("# nothing", "");
}

static void quotes_hold_separators_and_blanks_around_are_dropped(void **state)
{
    (void)state;
    check_rows("\"a,b\" , c \n\" d \",\n", "a,b|c/ d |");
    check_rows("\"open,b\n", "\"open|b");
    check_rows("\"a\"b,c\n", "\"a\"b|c");
}

static void rows_of_another_length_are_refused_with_their_line(void **state)
{
    (void)state;
    check_refused("a,b\n\n1,2,3\n", LRCS_E_SYNTAX,
                  "t.csv: line 3: found 3 fields, expected 2 as in the first line");
    char wide[200] = {0};
    memset(wide, ',', LRCS_HOST_FIELDS - 1);
    char said[4096];
    assert_int_equal(rows(wide, strlen(wide), said, NULL), 0);
    wide[LRCS_HOST_FIELDS - 1] = ',';
    check_refused(wide, LRCS_E_LIMIT, "t.csv: line 1: more than 64 columns");
}

static void numbers_are_refused_with_their_column(void **state)
{
    (void)state;
    unsigned char text[] = "1e3; x ;1,5;1e999;\n";
    lrcs_host_file file = {text, sizeof text - 1};
    lrcs_host_table table = lrcs_host_table_make("t.csv", &file);
    lrcs_host_error error;
    double value = 7.0;
    assert_int_equal(lrcs_host_table_read(&table, &error), 1);
    assert_int_equal(lrcs_host_field_read(&table, 0, "a length", &value, &error), LRCS_OK);
    check_same(value, 1000.0);
    assert_int_equal(lrcs_host_field_read(&table, 1, "a length", &value, &error), LRCS_E_SYNTAX);
    assert_string_equal(error.text, "t.csv: line 1, column 2: found 'x', expected a length");
    assert_int_equal(lrcs_host_field_read(&table, 2, "a length", &value, &error), LRCS_E_SYNTAX);
    assert_string_equal(
        error.text, "t.csv: line 1, column 3: found '1,5', expected a number with a decimal point");
    assert_int_equal(lrcs_host_field_read(&table, 3, "a length", &value, &error), LRCS_E_NUMBER);
    assert_int_equal(lrcs_host_field_read(&table, 4, "a length", &value, &error), LRCS_E_SYNTAX);
    check_same(value, 1000.0);
}

static void columns_are_called_by_their_names(void **state)
{
    (void)state;
    unsigned char text[] = "Angle, brdf\x01\n1,x\n";
    lrcs_host_file file = {text, sizeof text - 1};
    lrcs_host_table table = lrcs_host_table_make("t.csv", &file);
    lrcs_host_error error;
    double value;
    assert_int_equal(lrcs_host_table_read(&table, &error), 1);
    assert_true(lrcs_host_table_column(&table, "angle") == LRCS_NONE);
    lrcs_host_table_names(&table);
    assert_int_equal(lrcs_host_table_read(&table, &error), 1);
    assert_true(lrcs_host_table_column(&table, "angle") == 0);
    assert_true(lrcs_host_table_column(&table, "brdf") == LRCS_NONE);
    assert_int_equal(lrcs_host_field_read(&table, 1, "a reading", &value, &error), LRCS_E_SYNTAX);
    assert_string_equal(error.text,
                        "t.csv: line 2, column brdf\\x01: found 'x', expected a reading");
}

static void names_match_in_either_case(void **state)
{
    (void)state;
    lrcs_host_field field = {"Sigma_m2", 8};
    assert_true(lrcs_host_field_is(&field, "sigma_m2"));
    assert_false(lrcs_host_field_is(&field, "sigma"));
    assert_true(lrcs_host_field_begins(&field, "sigma"));
    assert_false(lrcs_host_field_begins(&field, "sigma_m2_and_more"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_first_line_decides_what_separates),
        cmocka_unit_test(lines_end_as_any_system_ends_them),
        cmocka_unit_test(quotes_hold_separators_and_blanks_around_are_dropped),
        cmocka_unit_test(rows_of_another_length_are_refused_with_their_line),
        cmocka_unit_test(numbers_are_refused_with_their_column),
        cmocka_unit_test(columns_are_called_by_their_names),
        cmocka_unit_test(names_match_in_either_case),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
