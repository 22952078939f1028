/* SPDX-License-Identifier: MIT */
/* Marks that are cleared all at once, also where their numbers begin again. */
#include "visibility/index/marks.h"

#include "check.h"
#include "visibility/cells/cells_cover.h"

enum { FACETS = 4 };

static void a_facet_is_marked_until_all_are_cleared(void **state)
{
    (void)state;
    uint32_t entry[FACETS] = {0};
    lrcsi_marks marks = {entry, 0};
    lrcsi_marks_clear(&marks, FACETS);
    assert_false(lrcsi_marked(&marks, 2));
    entry[2] = marks.number;
    assert_true(lrcsi_marked(&marks, 2));
    assert_false(lrcsi_marked(&marks, 1));
    lrcsi_marks_clear(&marks, FACETS);
    assert_false(lrcsi_marked(&marks, 2));
}

/* Entries of every age, among them the numbers that follow the last one. */
static void no_facet_is_marked_where_numbers_begin_again(void **state)
{
    (void)state;
    uint32_t entry[FACETS] = {1, 2, LRCSI_MARKS_LAST - 1, LRCSI_MARKS_LAST};
    lrcsi_marks marks = {entry, LRCSI_MARKS_LAST - 1};
    lrcsi_marks_clear(&marks, FACETS);
    assert_int_equal(marks.number, LRCSI_MARKS_LAST);
    assert_true(lrcsi_marked(&marks, 3));
    for (int n = 0; n < 3; n++) {
        lrcsi_marks_clear(&marks, FACETS);
        for (uint32_t f = 0; f < FACETS; f++) {
            assert_false(lrcsi_marked(&marks, f));
        }
    }
    assert_int_equal(marks.number, 3);
}

/* Facets that cover a sample certainly, or perhaps, have 2 n + 1, or 2 n, for the number n. */
static void no_facet_covers_a_sample_where_numbers_begin_again(void **state)
{
    (void)state;
    uint32_t entry[FACETS] = {0};
    uint32_t covers[FACETS] = {2, 3, 2 * LRCSI_MARKS_LAST, 2 * LRCSI_MARKS_LAST + 1};
    lrcsi_cells_sample sample = {.covers = covers, .listed = {entry, LRCSI_MARKS_LAST}};
    lrcsi_cells_sample_clear(&sample, FACETS);
    assert_int_equal(sample.listed.number, 1);
    for (uint32_t f = 0; f < FACETS; f++) {
        assert_int_equal(covers[f], 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_facet_is_marked_until_all_are_cleared),
        cmocka_unit_test(no_facet_is_marked_where_numbers_begin_again),
        cmocka_unit_test(no_facet_covers_a_sample_where_numbers_begin_again),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
