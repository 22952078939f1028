/* SPDX-License-Identifier: MIT */
/* Which event edges cross a facet, of tangled facets seen along vectors of small integers: against
   rational arithmetic. */
#include "visibility/uniform/crossing.h"

#include "integer_view.h"

static lrcsi_crossings crossings;

/* A fraction with a positive denominator. */
typedef struct fraction {
    int64_t top, bottom;
} fraction;

static int is_less(fraction a, fraction b)
{
    return a.top * b.bottom < b.top * a.bottom;
}

/* What is known of an edge and a facet. */
enum { NO_CROSSING, MAY_CROSS, MUST_CROSS };

/* An event edge crosses a facet if it runs through its interior in projection, and is nearer there;
   it may count as crossing if it is nearer than the facet's plane elsewhere. The points p + t (q -
   p) that are inside all sides have t in an open interval, in which heights are linear. */
static int crosses_exactly(uint32_t facet, uint32_t edge)
{
    const lrcsi_edge *e = &view.prepared->topology.edge[edge];
    fraction low = {0, 1};
    fraction high = {1, 1};
    int64_t p[3];
    int64_t q[3];
    vertex_at(e->low, p);
    vertex_at(e->high, q);
    for (int k = 0; k < 3; k++) {
        int64_t start = facing_exactly(facet) * left_of_side(facet, k, p);
        int64_t slope = facing_exactly(facet) * left_of_side(facet, k, q) - start;
        if (slope == 0 && start <= 0) {
            return NO_CROSSING;
        }
        fraction at = {slope > 0 ? -start : start, slope > 0 ? slope : -slope};
        if (slope > 0 && is_less(low, at)) {
            low = at;
        }
        if (slope < 0 && is_less(at, high)) {
            high = at;
        }
    }
    int64_t start = height_above(facet, p);
    int64_t rise = height_above(facet, q) - start;
    return !is_less(low, high) ? NO_CROSSING
           : start * low.bottom + rise * low.top > 0 || start * high.bottom + rise * high.top > 0
               ? MUST_CROSS
           : start > 0 || start + rise > 0 ? MAY_CROSS
                                           : NO_CROSSING;
}

static int has_facet_of(uint32_t edge, uint32_t component)
{
    return lrcsi_topology_edge_has(&view.prepared->topology, edge, classification.component,
                                   component);
}

/* Compares all that is found of a facet. Returns the number of edges that must cross it. */
static uint32_t check_facet(uint32_t facet)
{
    lrcsi_event_search *search = &classification.search;
    const lrcsi_crossings none = {.facet = LRCS_NONE};
    uint32_t must = 0;
    uint32_t known = 0;
    lrcsi_crossing_candidates candidates;
    int along[2];
    lrcsi_crossings_find(search, facet, NULL, &crossings);
    assert_int_equal(crossings.facet, facet);
    for (uint32_t i = 0; i < classification.events.count; i++) {
        uint32_t edge = classification.events.edge[i];
        uint32_t found = 0;
        int crosses = crosses_exactly(facet, edge);
        for (uint32_t k = 0; k < crossings.count; k++) {
            found += crossings.edge[k] == edge;
        }
        assert_true(crosses == MAY_CROSS ? found <= 1 : found == (crosses == MUST_CROSS));
        must += crosses == MUST_CROSS;
        known += found;
    }
    assert_int_equal(crossings.count, known); /* nothing but events */
    candidates.state = LRCSI_CANDIDATES_NOT_SOUGHT;
    for (int i = 0; i < 2; i++) { /* from the grid, and from candidates */
        candidates.examined = i == 0 ? 0 : UINT32_MAX;
        assert_int_equal(lrcsi_crossings_possible(search, facet, NULL, &candidates, &along[i]),
                         known > 0);
        assert_int_equal(candidates.state,
                         i == 0 ? LRCSI_CANDIDATES_NOT_SOUGHT : LRCSI_CANDIDATES_KNOWN);
    }
    assert_true(known > 0 || along[0] == along[1]);
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        uint32_t component = classification.component[f];
        int of_it = 0;
        for (uint32_t i = 0; i < crossings.count; i++) {
            of_it |= has_facet_of(crossings.edge[i], component);
        }
        assert_int_equal(lrcsi_crossings_of_component(search, facet, component, NULL, &crossings),
                         of_it);
        assert_int_equal(lrcsi_crossings_of_component(search, facet, component, NULL, &none),
                         of_it);
    }
    return must;
}

static void crossings_are_those_of_rational_arithmetic(void **state)
{
    (void)state;
    uint64_t random = 20261127;
    unsigned crossed = 0;
    unsigned free = 0;
    for (int i = 0; i < 300; i++) {
        scene_tangle(&random, 10, 14);
        look_along_any(&random);
        assert_int_equal(lrcsi_crossings_make(&classification.search, &work, &crossings), LRCS_OK);
        for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
            if (casts_exactly(f)) {
                uint32_t count = check_facet(f);
                crossed += count > 0;
                free += count == 0;
            }
        }
    }
    assert_true(crossed > 500 && free > 100);
}

/* A comb of slats over a plate, on the diagonal of the view: the plate meets many rows and columns
   of the grid. Every slat has two long sides, each of which crosses the two facets of the plate. */
static void all_of_many_crossings_are_found(void **state)
{
    (void)state;
    const int slats = 40;
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){400, 400, 0},
                (const double[3]){-100, 100, 0});
    for (int i = 0; i < slats; i++) {
        scene_plate(&scene, (const double[3]){10 * i - 150, 10 * i + 150, 9},
                    (const double[3]){300, -300, 0}, (const double[3]){4, 4, 0});
    }
    look_along(0, 0, 1);
    assert_int_equal(lrcsi_crossings_make(&classification.search, &work, &crossings), LRCS_OK);
    for (uint32_t m = 0; m < view.prepared->meshlets.count; m++) {
        lrcsi_boxes_open(&classification.search.boxes, m);
    }
    assert_true(check_facet(0) > 60);
    assert_true(check_facet(1) > 60);
}

static void a_spent_meter_leaves_crossings_open(void **state)
{
    (void)state;
    uint64_t random = 7;
    int along;
    lrcsi_crossing_candidates candidates;
    scene_tangle(&random, 10, 14);
    look_along(0, 0, 1);
    assert_int_equal(lrcsi_crossings_make(&classification.search, &work, &crossings), LRCS_OK);
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        lrcsi_meter meter = {.limit = 0};
        if (casts_exactly(f)) {
            candidates.state = LRCSI_CANDIDATES_NOT_SOUGHT;
            candidates.examined = f % 2 == 0 ? 0 : UINT32_MAX;
            assert_true(
                lrcsi_crossings_possible(&classification.search, f, &meter, &candidates, &along));
            lrcsi_crossings_find(&classification.search, f, &meter, &crossings);
            assert_int_equal(crossings.facet, LRCS_NONE);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crossings_are_those_of_rational_arithmetic),
        cmocka_unit_test(all_of_many_crossings_are_found),
        cmocka_unit_test(a_spent_meter_leaves_crossings_open),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
