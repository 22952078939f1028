/* SPDX-License-Identifier: MIT */
/* Welding and edges: on a cube, on a soup, and against a quadratic search on random meshes. */
#include "mesh/topology.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/exact.h"
#include "base/hash.h"
#include "base/work.h"
#include "check.h"
#include "mesh/cube.h"

enum { ROOM = 1 << 20 };

static unsigned char room[ROOM];

static void a_cube_has_eighteen_edges_used_both_ways(void **state)
{
    (void)state;
    lrcs_work work = lrcs_work_make(room, ROOM);
    lrcsi_topology t;
    assert_int_equal(lrcsi_topology_make(cube_vertex, 8, cube_facet, 12, &work, &t), LRCS_OK);
    assert_int_equal(t.edge_count, 18);
    for (uint32_t e = 0; e < t.edge_count; e++) {
        assert_int_equal(t.edge[e].uses, 2);
        const lrcsi_edge_use *use = t.use + t.edge[e].first_use;
        assert_int_equal(use[0].forward + use[1].forward, 1);
        assert_true(use[0].facet < use[1].facet);
    }
}

static void a_soup_is_welded_into_the_same_edges(void **state)
{
    (void)state;
    lrcs_point vertex[36];
    lrcs_facet facet[12];
    for (uint32_t i = 0; i < 36; i++) {
        vertex[i] = cube_vertex[cube_facet[i / 3].corner[i % 3]];
        facet[i / 3].corner[i % 3] = i;
        for (int k = 0; k < 3; k++) { /* -0 is the same place */
            vertex[i].x[k] = vertex[i].x[k] == 0.0 && i % 2 ? -0.0 : vertex[i].x[k];
        }
    }
    lrcs_work work = lrcs_work_make(room, ROOM);
    lrcsi_topology t;
    assert_int_equal(lrcsi_topology_make(vertex, 36, facet, 12, &work, &t), LRCS_OK);
    assert_int_equal(t.edge_count, 18);
    for (uint32_t i = 0; i < 36; i++) {
        for (uint32_t j = 0; j < 36; j++) {
            int same = vertex[i].x[0] == vertex[j].x[0] && vertex[i].x[1] == vertex[j].x[1] &&
                       vertex[i].x[2] == vertex[j].x[2];
            assert_int_equal(t.weld[i] == t.weld[j], same);
        }
        assert_true(t.weld[i] <= i && t.weld[t.weld[i]] == t.weld[i]);
    }
}

static void points_one_ulp_apart_stay_apart(void **state)
{
    (void)state;
    lrcs_point vertex[3] = {{{0, 0, 1}}, {{0, 0, 1}}, {{0, 0, 1}}};
    vertex[1].x[2] = nextafter(1.0, 2.0);
    lrcs_work work = lrcs_work_make(room, ROOM);
    lrcsi_topology t;
    assert_int_equal(lrcsi_topology_make(vertex, 3, NULL, 0, &work, &t), LRCS_OK);
    assert_int_equal(t.weld[0], 0);
    assert_int_equal(t.weld[1], 1);
    assert_int_equal(t.weld[2], 0);
    assert_int_equal(t.edge_count, 0);
}

static void degenerate_facets_have_no_edges(void **state)
{
    (void)state;
    const lrcs_point vertex[4] = {{{0, 0, 0}}, {{1, 2, 3}}, {{2, 4, 6}}, {{0, 1, 0}}};
    const lrcs_facet facet[4] = {{{0, 1, 2}}, {{0, 1, 3}}, {{1, 1, 3}}, {{3, 3, 3}}};
    lrcs_work work = lrcs_work_make(room, ROOM);
    lrcsi_topology t;
    assert_int_equal(lrcsi_topology_make(vertex, 4, facet, 4, &work, &t), LRCS_OK);
    assert_int_equal(t.edge_count, 3);
    assert_int_equal(t.degenerate[0], 1);
    assert_int_equal(t.degenerate[1], 0);
    assert_int_equal(t.degenerate[2], 1);
    assert_int_equal(t.degenerate[3], 1);
    assert_true(t.facet_edge[0].corner[0] == LRCS_NONE && t.facet_edge[3].corner[2] == LRCS_NONE);
    assert_true(t.facet_edge[1].corner[0] < 3);
}

/* Every promise of topology.h, by search. */
static void check_promises(const lrcs_point *vertex, const lrcs_facet *facet, uint32_t facets,
                           const lrcsi_topology *t)
{
    uint32_t uses = 0;
    for (uint32_t e = 0; e < t->edge_count; e++) {
        const lrcsi_edge *a = &t->edge[e];
        assert_true(a->low < a->high && a->first_use == uses && a->uses > 0);
        assert_true(e == 0 || a[-1].low < a->low || (a[-1].low == a->low && a[-1].high < a->high));
        uses += a->uses;
        for (uint32_t i = a->first_use + 1; i < uses; i++) {
            assert_true(t->use[i - 1].facet < t->use[i].facet);
        }
    }
    uint32_t sides = 0;
    for (uint32_t f = 0; f < facets; f++) {
        const uint32_t *c = facet[f].corner;
        assert_int_equal(t->degenerate[f],
                         lrcsi_exact_collinear(vertex[c[0]].x, vertex[c[1]].x, vertex[c[2]].x));
        for (int k = 0; k < 3 && !t->degenerate[f]; k++, sides++) {
            uint32_t from = t->weld[c[k]];
            uint32_t to = t->weld[c[(k + 1) % 3]];
            const lrcsi_edge *e = &t->edge[t->facet_edge[f].corner[k]];
            assert_true(e->low == (from < to ? from : to) && e->high == (from < to ? to : from));
            uint32_t found = 0;
            for (uint32_t i = 0; i < e->uses; i++) {
                const lrcsi_edge_use *u = &t->use[e->first_use + i];
                found += u->facet == f && u->forward == (uint32_t)(from < to);
            }
            assert_int_equal(found, 1);
        }
    }
    assert_int_equal(sides, uses);
}

static void random_meshes_keep_every_promise(void **state)
{
    (void)state;
    uint32_t seed = 7;
    for (int round = 0; round < 200; round++) {
        lrcs_point vertex[30];
        lrcs_facet facet[60];
        for (int i = 0; i < 90; i++) {
            for (int k = 0; k < 3; k++) {
                seed = seed * 1664525u + 1013904223u;
                if (i < 30) {
                    vertex[i].x[k] = (double)(seed >> 30) - 1.0;
                } else {
                    facet[i - 30].corner[k] = (seed >> 8) % 30;
                }
            }
        }
        lrcs_work work = lrcs_work_make(room, ROOM);
        lrcsi_topology t;
        assert_int_equal(lrcsi_topology_make(vertex, 30, facet, 60, &work, &t), LRCS_OK);
        check_promises(vertex, facet, 60, &t);
    }
}

/* A vertex of many edges, with facets in a random order and turned any way: more than are sorted
   one by one. */
static void a_vertex_of_many_edges_keeps_every_promise(void **state)
{
    (void)state;
    enum { RIM = 150, FANS = 3 };
    static lrcs_point vertex[RIM + 1];
    static lrcs_facet facet[FANS * RIM];
    uint32_t seed = 3;
    for (int i = 0; i < RIM; i++) {
        vertex[i + 1] = (lrcs_point){{i, i * i, 1}};
    }
    for (uint32_t f = 0; f < FANS * RIM; f++) { /* a third of the sides three times over */
        seed = seed * 1664525u + 1013904223u;
        uint32_t b = 1 + (seed >> 8) % RIM;
        uint32_t c = 1 + (b - 1 + 1 + (seed >> 20) % 2) % RIM;
        const uint32_t corner[3] = {0, f % 2 ? b : c, f % 2 ? c : b};
        for (uint32_t k = 0; k < 3; k++) {
            facet[f].corner[k] = corner[(k + f) % 3];
        }
    }
    lrcs_work work = lrcs_work_make(room, ROOM);
    lrcsi_topology t;
    assert_int_equal(lrcsi_topology_make(vertex, RIM + 1, facet, FANS * RIM, &work, &t), LRCS_OK);
    check_promises(vertex, facet, FANS * RIM, &t);
    assert_true(t.edge[100].low == 0);
}

/* The number whose lrcsi_hash_mix is `mixed`: each of its steps undone. */
static uint64_t unmix(uint64_t mixed)
{
    mixed ^= mixed >> 31 ^ mixed >> 62;
    mixed *= 0x319642b2d24d8ec3u; /* times the second factor: 1 */
    mixed ^= mixed >> 27 ^ mixed >> 54;
    mixed *= 0x96de1b173f119089u;
    return mixed ^ mixed >> 30 ^ mixed >> 60;
}

static double double_of(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* Points made to meet in one slot of the table, each twice: sorted then, with the same result. */
static void points_that_hash_alike_are_welded_all_the_same(void **state)
{
    (void)state;
    enum { ALIKE = 300 };
    static lrcs_point vertex[2 * ALIKE];
    uint32_t count = 0;
    for (uint64_t i = 1; count < ALIKE; i++) {
        double x = (double)i;
        double z = double_of(unmix(77) - lrcsi_hash_mix(lrcsi_hash_mix(bits_of(x)) + bits_of(x)));
        if (fabs(z) < 1e100) {
            assert_true(lrcsi_hash_mix(lrcsi_hash_mix(lrcsi_hash_mix(bits_of(x)) + bits_of(x)) +
                                       bits_of(z)) == 77);
            vertex[2 * ALIKE - 1 - count] = (lrcs_point){{x, x, z}};
            vertex[count++] = (lrcs_point){{x, x, z}};
        }
    }
    lrcs_work work = lrcs_work_make(room, ROOM);
    lrcsi_topology t;
    assert_int_equal(lrcsi_topology_make(vertex, 2 * ALIKE, NULL, 0, &work, &t), LRCS_OK);
    for (uint32_t i = 0; i < ALIKE; i++) {
        assert_int_equal(t.weld[i], i);
        assert_int_equal(t.weld[2 * ALIKE - 1 - i], i);
    }
}

static void the_need_is_enough_and_one_byte_at_a_time_fails_clean(void **state)
{
    (void)state;
    size_t need = lrcsi_topology_need(8, 12);
    int status = LRCS_E_MEMORY;
    for (size_t size = 0; size <= need; size++) {
        unsigned char *bytes = malloc(size + 1);
        assert_non_null(bytes);
        lrcs_work work = lrcs_work_make(bytes, size);
        lrcsi_topology t;
        memset(&t, 0, sizeof t);
        status = lrcsi_topology_make(cube_vertex, 8, cube_facet, 12, &work, &t);
        if (status != LRCS_OK) {
            assert_int_equal(status, LRCS_E_MEMORY);
            assert_int_equal(work.used, 0);
            assert_null(t.edge);
        }
        free(bytes);
    }
    assert_int_equal(status, LRCS_OK);
}

static void too_many_facets_are_refused(void **state)
{
    (void)state;
    lrcs_work work = lrcs_work_make(room, ROOM);
    lrcsi_topology t;
    assert_int_equal(lrcsi_topology_make(NULL, 0, NULL, 2000000000u, &work, &t), LRCS_E_LIMIT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cube_has_eighteen_edges_used_both_ways),
        cmocka_unit_test(a_soup_is_welded_into_the_same_edges),
        cmocka_unit_test(points_one_ulp_apart_stay_apart),
        cmocka_unit_test(degenerate_facets_have_no_edges),
        cmocka_unit_test(random_meshes_keep_every_promise),
        cmocka_unit_test(a_vertex_of_many_edges_keeps_every_promise),
        cmocka_unit_test(points_that_hash_alike_are_welded_all_the_same),
        cmocka_unit_test(the_need_is_enough_and_one_byte_at_a_time_fails_clean),
        cmocka_unit_test(too_many_facets_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
