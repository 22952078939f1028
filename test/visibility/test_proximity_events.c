/* SPDX-License-Identifier: MIT */
/* The event edges of each part of tangled facets, seen along vectors of small integers: against
   their definition, decided in integers. */
#include "visibility/proximity/proximity_events.h"

#include "integer_view.h"

static unsigned char memory[1u << 16];

/* Pairs of an edge and a part are listed once if they are events that matter, others never. Edges
   of facets that are all edge-on matter only as rims; those of a closed part, if a facet on them
   faces the laser. */
static void check_pair(const lrcsi_proximity_events *events, uint32_t e, uint32_t part,
                       unsigned sides[3], unsigned ignored[2])
{
    const lrcsi_edge *edge = &view.prepared->topology.edge[e];
    const edge_count n = count_facets(edge->low, edge->high, part);
    const int closed = view.prepared->scene->part[part].solid;
    const int matters = n.count == 1 || (closed ? n.fronts : n.left + n.right) > 0;
    uint32_t times = 0;
    for (uint32_t i = 0; i < events->count; i++) {
        if (events->edge[i] == e && events->part[i] == part) {
            assert_int_equal(events->side[i], (n.left > 0) - (n.right > 0));
            sides[events->side[i] + 1]++;
            times++;
        }
    }
    assert_int_equal(times, is_event(&n, part) && matters);
    ignored[closed] += is_event(&n, part) && !matters;
}

/* Every event is in the list of each bucket in which it has a point, as boxes are rounded. */
static void check_grid(const lrcsi_proximity_events *events)
{
    const lrcsi_grid *grid = &events->grid;
    for (uint32_t i = 0; i < events->count; i++) {
        const lrcsi_edge *e = &view.prepared->topology.edge[events->edge[i]];
        for (int k = 0; k <= 8; k++) {
            double x[2];
            for (int axis = 0; axis < 2; axis++) {
                double low = view.point[e->low].x[axis];
                double high = view.point[e->high].x[axis];
                x[axis] = (double)lrcsi_view_box_float((low + k / 8.0 * (high - low)) * view.scale);
            }
            uint32_t bx = lrcsi_grid_bucket(grid, x[0], 0);
            lrcsi_grid_items items =
                lrcsi_grid_row_items(grid, lrcsi_grid_bucket(grid, x[1], 1), bx, bx + 1);
            uint32_t times = 0;
            for (uint32_t n = items.from; n < items.to; n++) {
                times += grid->item[n] == i;
            }
            assert_int_equal(times, 1);
        }
    }
}

static void every_part_has_its_own_event_edges(void **state)
{
    (void)state;
    uint64_t random = 20261129;
    unsigned sides[3] = {0, 0, 0};
    unsigned ignored[2] = {0, 0};
    for (int i = 0; i < 200; i++) {
        lrcs_part part[2];
        lrcsi_proximity_events events;
        scene_tangle(&random, 8, 14);
        scene_divide(7, part);
        part[1].solid = i % 2;
        look_along_any(&random);
        size_t most = lrcsi_proximity_events_most(view.prepared);
        lrcs_work room = lrcs_work_make(memory, lrcsi_proximity_events_need(most));
        assert_true(lrcsi_proximity_events_need(most) <= sizeof memory);
        assert_int_equal(lrcsi_proximity_events_make(&view, &room, &events), LRCS_OK);
        assert_true(events.count <= most);
        for (uint32_t e = 0; e < view.prepared->topology.edge_count; e++) {
            check_pair(&events, e, 0, sides, ignored);
            check_pair(&events, e, 1, sides, ignored);
        }
        check_grid(&events);
    }
    assert_true(sides[0] > 100 && sides[1] > 100 && sides[2] > 100);
    assert_true(ignored[0] > 2 && ignored[1] > 50);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_part_has_its_own_event_edges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
