/* SPDX-License-Identifier: MIT */
/* Walking statements: what the readers of text formats cannot show in a file of ordinary size. */
#include "mesh/read/lines.h"

#include <string.h>

#include "check.h"

/* A file that ends too early is cut short only where something was missing. */
static void a_limit_met_at_the_last_word_is_no_file_cut_short(void **state)
{
    (void)state;
    static const int given[] = {LRCS_E_SYNTAX, LRCS_E_LIMIT, LRCS_E_SYNTAX};
    static const int want[] = {LRCS_E_TRUNCATED, LRCS_E_LIMIT, LRCS_E_SYNTAX};
    for (int i = 0; i < 3; i++) {
        const char *text = i < 2 ? "f 1 2 3" : "f 1 2 3 4";
        lrcs_where where;
        lrcsi_lines lines = lrcsi_lines_make(text, strlen(text));
        lines.at += 7;
        assert_int_equal(lrcsi_lines_fail(&lines, given[i], "facets", "fewer", &where), want[i]);
        assert_string_equal(where.item, "facets");
        assert_string_equal(where.found, i < 2 ? "end of file" : "4");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_limit_met_at_the_last_word_is_no_file_cut_short),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
