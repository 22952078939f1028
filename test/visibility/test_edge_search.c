/* SPDX-License-Identifier: MIT */
/* A search near a facet, or near several, finds every event edge that a loop over all of them finds,
   and leaves out most of those that are far away. */
#include "visibility/index/edge_search.h"

#include "facet_distance.h"
#include "integer_view.h"

static unsigned char found[SCENE_FACETS];

static const lrcsi_edge *event_edge(uint32_t event)
{
    return &view.prepared->topology.edge[classification.events.edge[event]];
}

static int is_found(const lrcsi_edge_search *search, uint32_t event, double near, int *line)
{
    const lrcsi_edge *e = event_edge(event);
    return !lrcsi_edge_search_excludes(search, view.point[e->low].x, view.point[e->high].x, near,
                                       line);
}

/* Counts of events: near facets, far from all of them, and of the latter, not found. */
typedef struct search_counts {
    unsigned near_ones, far_ones, left_out;
} search_counts;

/* Compares what was found near some facets with a loop over all events. */
static void check_found(const uint32_t *facet, uint32_t count, double near, search_counts *counts)
{
    for (uint32_t e = 0; e < classification.events.count; e++) {
        double distance = HUGE_VAL;
        for (uint32_t i = 0; i < count; i++) {
            distance = fmin(distance, facet_distance(&view, facet[i], event_edge(e)));
        }
        if (distance <= near) {
            assert_true(found[e]);
            counts->near_ones++;
        } else if (distance > 2 * near) {
            counts->far_ones++;
            counts->left_out += !found[e];
        }
    }
}

static void a_search_finds_what_a_loop_finds(void **state)
{
    (void)state;
    uint64_t random = 20261130;
    search_counts counts = {0, 0, 0};
    for (int i = 0; i < 200; i++) {
        const uint32_t count = 24;
        scene_tangle(&random, 40, count);
        look_along_any(&random);
        double size = hypot(view.side, view.side);
        for (uint32_t f = 0; f < count; f++) {
            double near = size * random_unit(&random) * (f % 2 == 0 ? 0.01 : 0.2);
            lrcsi_edge_search search = lrcsi_edge_search_make(&view, f, near);
            int line = 0;
            for (uint32_t e = 0; e < classification.events.count; e++) {
                found[e] = (unsigned char)is_found(&search, e, near, &line);
            }
            check_found(&f, 1, near, &counts);
        }
    }
    assert_true(counts.near_ones > 10000);
    assert_true(counts.left_out > 0.9 * counts.far_ones);
}

/* Facets of a tangle lie in all directions: a rectangle around three of them contains much else. */
static void a_search_around_facets_finds_what_a_loop_finds(void **state)
{
    (void)state;
    uint64_t random = 20261129;
    search_counts counts[2] = {{0, 0, 0}, {0, 0, 0}};
    for (int i = 0; i < 200; i++) {
        const uint32_t count = 24;
        scene_tangle(&random, 40, count);
        look_along_any(&random);
        uint32_t events = classification.events.count;
        double size = hypot(view.side, view.side);
        lrcsi_grid grid = lrcsi_grid_empty(&view, 4 * events);
        assert_int_equal(
            lrcsi_grid_edges(classification.events.edge, events, 8 * events, &work, &grid),
            LRCS_OK);
        for (uint32_t f = 0; f < count; f++) {
            const uint32_t facet[3] = {f, (f + 1) % count, (f + 2) % count};
            const uint32_t several = f % 2 == 0 ? 1 : 3;
            double near = size * random_unit(&random) * (f % 4 < 2 ? 0.01 : 0.2);
            lrcsi_grid_walk walk;
            lrcsi_grid_row row;
            lrcsi_edge_search search =
                lrcsi_edge_search_around(&view, &grid, facet, several, near, &walk);
            int line = 0;
            memset(found, 0, sizeof found);
            while (lrcsi_grid_walk_next(&walk, &row)) {
                lrcsi_grid_items items = lrcsi_grid_row_items(&grid, row.y, row.x0, row.x1);
                for (uint32_t k = items.from; k < items.to; k++) {
                    found[grid.item[k]] |=
                        (unsigned char)is_found(&search, grid.item[k], near, &line);
                }
            }
            check_found(facet, several, near, &counts[several > 1]);
        }
    }
    assert_true(counts[0].near_ones > 5000 && counts[1].near_ones > 10000);
    assert_true(counts[0].left_out > 0.6 * counts[0].far_ones);
    assert_true(counts[1].left_out > 0.3 * counts[1].far_ones);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_search_finds_what_a_loop_finds),
        cmocka_unit_test(a_search_around_facets_finds_what_a_loop_finds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
