/* SPDX-License-Identifier: MIT */
/* Names as people type them: patterns against a plain recursive matcher, folding, likeness. */
#include "host/scene/names.h"

#include "check.h"

#include <string.h>

/* The definition of a pattern, over bytes. */
static int plain_match(const char *pattern, const char *name)
{
    if (*pattern == '\0') {
        return *name == '\0';
    }
    if (*pattern == '*') {
        return plain_match(pattern + 1, name) || (*name && plain_match(pattern, name + 1));
    }
    return *name && (*pattern == '?' || *pattern == *name) && plain_match(pattern + 1, name + 1);
}

/* All texts of up to `size` letters of an alphabet, one after the other. 0 after the last. */
static int next_text(char *text, const char *alphabet, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        if (text[i] == '\0') {
            text[i] = alphabet[0];
            return 1;
        }
        const char *at = strchr(alphabet, text[i]);
        if (at[1]) {
            text[i] = at[1];
            return 1;
        }
        text[i] = alphabet[0];
    }
    return 0;
}

static void patterns_match_as_their_definition_says(void **state)
{
    (void)state;
    char pattern[6] = "";
    int matched = 0;
    do {
        char name[6] = "";
        do {
            int want = plain_match(pattern, name);
            matched += want;
            if (lrcsi_name_matches(pattern, name, 0) != want) {
                fail_msg("'%s' against '%s': want %d", pattern, name, want);
            }
        } while (next_text(name, "ab", 5));
    } while (next_text(pattern, "ab*?", 5));
    assert_true(matched > 1000);
}

static void a_question_mark_is_one_character_of_utf_8(void **state)
{
    (void)state;
    assert_true(lrcsi_name_matches("caf?", "caf\xc3\xa9", 0));
    assert_false(lrcsi_name_matches("caf??", "caf\xc3\xa9", 0));
    assert_true(lrcsi_name_matches("*?x", "\xc3\xa9x", 0));
}

static void letters_of_either_case_match_where_asked(void **state)
{
    (void)state;
    assert_true(lrcsi_name_matches("sol*", "SOLAR", 1));
    assert_false(lrcsi_name_matches("sol*", "SOLAR", 0));
    assert_true(lrcsi_name_same_folded("Solar_1", "sOLAR_1"));
    assert_false(lrcsi_name_same_folded("solar", "solar1"));
    assert_false(lrcsi_name_same_folded("solar1", "solar"));
    assert_false(lrcsi_name_same_folded("a[", "a{")); /* these differ by the same bit as letters */
}

static void a_distance_counts_edits(void **state)
{
    (void)state;
    assert_int_equal(lrcs_host_name_distance("foil", "foil-gold"), 0);
    assert_int_equal(lrcs_host_name_distance("fool", "foil"), 1);
    assert_int_equal(lrcs_host_name_distance("fiol", "foil"), 1);
    assert_int_equal(lrcs_host_name_distance("Foil", "foil"), 1);
    assert_int_equal(lrcs_host_name_distance("", "foil"), 4);
}

static void the_most_alike_come_first_and_once(void **state)
{
    (void)state;
    static const char *const name[] = {"HULL",        "SOLARCELL 1", "",       "gold",
                                       "SOLARCELL 1", "wires",       "SOLDER", "solar"};
    const char *near[3];
    assert_int_equal(lrcs_host_names_near("solr", name, 8, near, 3), 3);
    assert_string_equal(near[0], "solar");
    assert_string_equal(near[1], "gold"); /* 3 edits, as SOLDER, and before it */
    assert_string_equal(near[2], "SOLDER");
    assert_int_equal(lrcs_host_names_near("cell", name, 8, near, 3), 3);
    assert_string_equal(near[0], "SOLARCELL 1");
    assert_int_equal(lrcs_host_names_near("x", name, 0, near, 3), 0);
    assert_int_equal(lrcs_host_names_near("cell", name, 8, near, 1), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(patterns_match_as_their_definition_says),
        cmocka_unit_test(a_question_mark_is_one_character_of_utf_8),
        cmocka_unit_test(letters_of_either_case_match_where_asked),
        cmocka_unit_test(a_distance_counts_edits),
        cmocka_unit_test(the_most_alike_come_first_and_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
