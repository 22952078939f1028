/* SPDX-License-Identifier: MIT */
/* Sentences for status codes, and what a reader tells of the place where it stopped. */
#include <limits.h>
#include <string.h>

#include "base/where.h"
#include "check.h"

static void every_status_has_a_sentence_of_its_own(void **state)
{
    (void)state;
    for (int a = LRCS_E_EMPTY; a <= LRCS_OK; a++) {
        assert_true(strlen(lrcs_status_text(a)) > 0);
        for (int b = LRCS_E_EMPTY; b < a; b++) {
            assert_string_not_equal(lrcs_status_text(a), lrcs_status_text(b));
        }
    }
}

static void any_other_number_has_a_sentence_too(void **state)
{
    (void)state;
    const int other[] = {1, LRCS_E_EMPTY - 1, INT_MAX, INT_MIN};
    for (int i = 0; i < 4; i++) {
        assert_string_equal(lrcs_status_text(other[i]), "unknown status code");
    }
}

static void what_cannot_be_printed_is_escaped(void **state)
{
    (void)state;
    lrcs_where where;
    const char found[] = {'a', '\0', '\n', (char)0xff, '~', 0x7f};
    int status =
        lrcsi_where_text(&where, LRCS_E_SYNTAX, 7, 3, "item", "expected", found, sizeof found);
    assert_int_equal(status, LRCS_E_SYNTAX);
    assert_int_equal(where.offset, 7);
    assert_int_equal(where.line, 3);
    assert_string_equal(where.found, "a\\x00\\x0a\\xff~\\x7f");
}

/* The longest that fits ends before the terminator, and never within an escape. */
static void excerpts_are_cut_to_fit(void **state)
{
    (void)state;
    lrcs_where where;
    char found[100];
    memset(found, 'x', sizeof found);
    for (size_t plain = 0; plain <= 70; plain++) {
        found[plain] = '\n';
        lrcsi_where_text(&where, LRCS_E_NAME, 0, 0, "", "", found, sizeof found);
        size_t length = strlen(where.found);
        size_t most = sizeof where.found - 1;
        assert_int_equal(length, plain + 4 <= most ? most : plain < most ? plain : most);
        found[plain] = 'x';
    }
}

static void numbers_are_printed_in_full(void **state)
{
    (void)state;
    lrcs_where where;
    lrcsi_where_number(&where, LRCS_E_LIMIT, 0, 0, "", "", UINT64_MAX);
    assert_string_equal(where.found, "18446744073709551615");
    lrcsi_where_number(&where, LRCS_E_LIMIT, 0, 0, "", "", 0);
    assert_string_equal(where.found, "0");
}

static void without_a_place_the_status_is_still_returned(void **state)
{
    (void)state;
    assert_int_equal(lrcsi_where_text(NULL, LRCS_E_NAME, 0, 0, "", "", "x", 1), LRCS_E_NAME);
    assert_int_equal(lrcsi_where_number(NULL, LRCS_E_LIMIT, 0, 0, "", "", 1), LRCS_E_LIMIT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_status_has_a_sentence_of_its_own),
        cmocka_unit_test(any_other_number_has_a_sentence_too),
        cmocka_unit_test(what_cannot_be_printed_is_escaped),
        cmocka_unit_test(excerpts_are_cut_to_fit),
        cmocka_unit_test(numbers_are_printed_in_full),
        cmocka_unit_test(without_a_place_the_status_is_still_returned),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
