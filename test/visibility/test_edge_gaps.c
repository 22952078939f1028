/* SPDX-License-Identifier: MIT */
/* Gaps of an edge against a list of points: a point is in a gap if it is in one of the parts that
   were added; if there are many parts, other points may be as well. */
#include "visibility/proximity/edge_gaps.h"

#include <string.h>

#include "check.h"
#include "random.h"

static uint64_t seed = 5;

enum { POINTS = 1001 };

static int holds(const lrcsi_edge_gaps *gaps, double t)
{
    int found = 0;
    for (int i = 0; i < gaps->count; i++) {
        found |= gaps->gap[i].from <= t && t <= gaps->gap[i].to;
    }
    return found;
}

static void check_order(const lrcsi_edge_gaps *gaps)
{
    assert_true(gaps->count >= 0 && gaps->count <= LRCSI_EDGE_GAPS);
    for (int i = 0; i < gaps->count; i++) {
        assert_true(gaps->gap[i].from >= 0 && gaps->gap[i].to <= 1);
        assert_true(gaps->gap[i].from <= gaps->gap[i].to);
        assert_true(i == 0 || gaps->gap[i - 1].to < gaps->gap[i].from);
    }
}

/* Adds parts of about the given length, at random; a part may lie beyond the edge, or be empty. */
static void check_parts(int parts, double length)
{
    static unsigned char in[POINTS];
    lrcsi_edge_gaps gaps = {.count = 0};
    memset(in, 0, sizeof in);
    for (int i = 0; i < parts; i++) {
        const double from = random_unit(&seed) * 1.4 - 0.2;
        const lrcsi_segment_part part = {from, from + length * (random_unit(&seed) - 0.1)};
        lrcsi_edge_gaps_add(&gaps, part);
        for (int k = 0; k < POINTS; k++) {
            const double t = (double)k / (POINTS - 1);
            in[k] |= part.from <= t && t <= part.to;
        }
        check_order(&gaps);
    }
    for (int k = 0; k < POINTS; k++) {
        const double t = (double)k / (POINTS - 1);
        assert_true(parts <= LRCSI_EDGE_GAPS ? holds(&gaps, t) == in[k] : holds(&gaps, t) >= in[k]);
    }
}

static void gaps_are_what_was_added(void **state)
{
    (void)state;
    for (int i = 0; i < 2000; i++) {
        check_parts(1 + i % 20, i % 3 == 0 ? 0.01 : 0.2);
    }
}

static void what_is_left_is_between_gaps(void **state)
{
    (void)state;
    lrcsi_edge_gaps gaps = {.count = 0};
    assert_false(lrcsi_edge_gaps_are_all(&gaps));
    lrcsi_edge_gaps_add_outside(&gaps, (lrcsi_segment_part){0.25, 0.75});
    assert_int_equal(gaps.count, 2);
    const lrcsi_segment_part free = lrcsi_edge_gaps_before(&gaps, 1);
    assert_true(free.from == 0.25 && free.to == 0.75);
    assert_true(lrcsi_edge_gaps_before(&gaps, 0).to == 0);
    assert_true(lrcsi_edge_gaps_before(&gaps, 2).from == 1);
    lrcsi_edge_gaps_add_outside(&gaps, (lrcsi_segment_part){1, 0});
    assert_true(lrcsi_edge_gaps_are_all(&gaps));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gaps_are_what_was_added),
        cmocka_unit_test(what_is_left_is_between_gaps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
