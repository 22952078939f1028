/* SPDX-License-Identifier: MIT */
/* Event edges of tangled facets, of two parts, seen along vectors of small integers: against their
   definition, decided in integers. */
#include "visibility/index/event.h"

#include "integer_view.h"

static void check_edge(uint32_t e, uint32_t part, unsigned kinds[3])
{
    const lrcsi_edge *edge = &view.prepared->topology.edge[e];
    const edge_count want = count_facets(edge->low, edge->high, part);
    lrcsi_edge_facets on;
    int kind = lrcsi_edge_kind_of(&view, e, part, &on);
    assert_int_equal(on.count, want.count);
    assert_int_equal(on.left, want.left);
    assert_int_equal(on.right, want.right);
    assert_int_equal(on.forward, want.forward);
    assert_int_equal(on.facet[0] == LRCS_NONE, want.count < 1);
    assert_int_equal(on.facet[1] == LRCS_NONE, want.count < 2);
    assert_int_equal(kind == LRCSI_EDGE_UNUSED, want.count == 0);
    assert_int_equal(kind == LRCSI_EDGE_EVENT, is_event(&want, part));
    kinds[kind]++;
}

static void edges_are_events_by_their_definition(void **state)
{
    (void)state;
    uint64_t random = 20261126;
    unsigned kinds[2][3] = {{0, 0, 0}, {0, 0, 0}};
    for (int i = 0; i < 300; i++) {
        lrcs_part part[2];
        scene_tangle(&random, 8, 14);
        scene_divide(7, part);
        look_along_any(&random);
        uint32_t listed = 0;
        for (uint32_t e = 0; e < view.prepared->topology.edge_count; e++) {
            const lrcsi_edge *edge = &view.prepared->topology.edge[e];
            const edge_count all = count_facets(edge->low, edge->high, LRCS_NONE);
            uint32_t times = 0;
            for (uint32_t k = 0; k < classification.events.count; k++) {
                times += classification.events.edge[k] == e;
            }
            assert_int_equal(times, is_event(&all, LRCS_NONE));
            listed += times;
            check_edge(e, LRCS_NONE, kinds[0]);
            check_edge(e, 0, kinds[1]);
            check_edge(e, 1, kinds[1]);
        }
        assert_int_equal(listed, classification.events.count);
    }
    for (int i = 0; i < 2; i++) { /* every kind is common */
        for (int kind = 0; kind < 3; kind++) {
            assert_true(kinds[i][kind] > 50);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edges_are_events_by_their_definition),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
