/* SPDX-License-Identifier: MIT */
/* Event edges of tangled facets, of two parts, seen along vectors of small integers: against their
   definition, decided in integers. */
#include "visibility/index/event.h"

#include "integer_view.h"

/* What the definition says of an edge. */
typedef struct edge_count {
    uint32_t count, left, right, forward;
} edge_count;

/* The facets with both vertices: those that can hide something or, of a part, all. */
static edge_count count_facets(uint32_t low, uint32_t high, uint32_t part)
{
    edge_count n = {0, 0, 0, 0};
    int64_t a[3];
    int64_t b[3];
    vertex_at(low, a);
    vertex_at(high, b);
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        const uint32_t *corner = scene.facet[f].corner;
        if (part == LRCS_NONE ? !casts_exactly(f) : scene.part_of[f] != part) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            uint32_t from = corner[k];
            uint32_t to = corner[(k + 1) % 3];
            if ((from == low && to == high) || (from == high && to == low)) {
                int64_t apex[3];
                vertex_at(corner[(k + 2) % 3], apex);
                int side = sign_of(determinant(a, b, apex, laser));
                n.count++;
                n.left += side > 0;
                n.right += side < 0;
                n.forward += from == low;
            }
        }
    }
    return n;
}

static int is_event(const edge_count *n, uint32_t part)
{
    int opposite = n->count == 2 && n->left == 1 && n->right == 1;
    return n->count > 0 && !(opposite && (part == LRCS_NONE || n->forward == 1));
}

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
        part[0] = part[1] = scene.part;
        part[0].facet_count = 7;
        part[1].first_facet = part[1].facet_count = 7;
        scene.scene.part = part;
        scene.scene.part_count = 2;
        for (uint32_t f = 7; f < 14; f++) {
            scene.part_of[f] = 1;
        }
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
