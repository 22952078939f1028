/* SPDX-License-Identifier: MIT */
/* Proofs about fans of facets: never given where brute force finds that two of them meet in more
   than they share, and given where surfaces are plain. */
#include "mesh/contact/fan.h"

#include <math.h>
#include <string.h>

#include "base/exact.h"
#include "base/work.h"
#include "check.h"
#include "mesh/contact/tree_bounds.h"
#include "mesh/contact/tree_walk.h"
#include "mesh/contacts.h"

enum { ROOM = 8 << 20, MOST = 3000 };

static unsigned char room[ROOM];
static lrcs_point vertex[MOST];
static lrcs_facet facet[MOST];
static unsigned char skip[MOST];
static unsigned char proved[MOST];
static uint32_t apex[MOST];

static uint32_t seed = 1;

static double next_number(void)
{
    seed = seed * 1664525u + 1013904223u;
    return (double)(seed >> 8) * 0x1p-24;
}

static void prove_rings(uint32_t vertices, uint32_t facets)
{
    lrcs_work work = lrcs_work_make(room, ROOM);
    lrcsi_topology topology;
    assert_int_equal(lrcsi_topology_make(vertex, vertices, facet, facets, &work, &topology),
                     LRCS_OK);
    size_t before = work.used;
    work.peak = before;
    assert_int_equal(
        lrcsi_fans_prove(vertex, vertices, facet, facets, &topology, skip, &work, proved, apex),
        LRCS_OK);
    assert_int_equal(work.used, before);
    assert_true(work.peak - before <= lrcsi_fans_need(vertices));
}

static int has_corner(const lrcs_facet *f, uint32_t v)
{
    return f->corner[0] == v || f->corner[1] == v || f->corner[2] == v;
}

/* Do facets about v meet in more than they share? By brute force. */
static int ring_meets_itself(uint32_t v, uint32_t facets)
{
    for (uint32_t f = 0; f < facets; f++) {
        for (uint32_t g = 0; g < facets && !skip[f] && has_corner(&facet[f], v); g++) {
            if (f == g || skip[g] || !has_corner(&facet[g], v)) {
                continue;
            }
            contacts_facet a = contacts_facet_make(vertex, &facet[f]);
            contacts_facet b = contacts_facet_make(vertex, &facet[g]);
            if (contacts_kind(&a, &b) != LRCSI_INTERSECTION_NONE || contacts_rim(&a, &b)) {
                return 1;
            }
        }
    }
    return 0;
}

/* Facets about vertex 0, going round by so much altogether, open or closed; now and then one is
   turned over, left out, or stands twice. */
static uint32_t make_ring(uint32_t spokes, double round, int closed, int fault)
{
    uint32_t facets = closed ? spokes : spokes - 1;
    double steep = 3.0 * next_number() * next_number();
    for (uint32_t i = 0; i < spokes; i++) {
        double at = round * (i + 0.4 * (next_number() - 0.5)) / facets;
        double size = 0.1 + next_number();
        double x = size * cos(at);
        double y = size * sin(at);
        double z = size * steep * (0.2 + 0.3 * next_number());
        vertex[i + 1] = (lrcs_point){{0.8 * x - 0.6 * z, y, 0.6 * x + 0.8 * z}};
    }
    vertex[0] = (lrcs_point){{0, 0, 0}};
    for (uint32_t f = 0; f < facets; f++) {
        uint32_t next = f + 2 > spokes ? 1 : f + 2;
        facet[f] = (lrcs_facet){{0, f + 1, next}};
        skip[f] =
            (unsigned char)lrcsi_exact_collinear(vertex[0].x, vertex[f + 1].x, vertex[next].x);
    }
    uint32_t bad = (uint32_t)(next_number() * facets);
    if (fault == 1) {
        facet[bad] = (lrcs_facet){{0, facet[bad].corner[2], facet[bad].corner[1]}};
    } else if (fault == 2) {
        skip[bad] = 1;
    } else if (fault == 3) {
        skip[facets] = skip[bad];
        facet[facets++] = (lrcs_facet){{0, facet[bad].corner[2], facet[bad].corner[1]}};
    }
    return facets;
}

static void no_ring_that_meets_itself_is_proved(void **state)
{
    (void)state;
    static const double whole = 6.283185307179586;
    uint32_t count[2][2] = {{0, 0}, {0, 0}};
    for (uint32_t round = 0; round < 6000; round++) {
        int closed = round % 2 == 0;
        uint32_t spokes = 4 + (uint32_t)(12 * next_number());
        double turns = closed ? 1.0 + (round % 7 == 0) : 1.6 * next_number();
        uint32_t facets =
            make_ring(spokes, whole * turns, closed, round % 5 == 0 ? round / 5 % 4 : 0);
        prove_rings(spokes + 1, facets);
        int meets = ring_meets_itself(0, facets);
        assert_false(meets && proved[0]);
        count[meets][proved[0]]++;
    }
    assert_true(count[1][0] > 1000); /* those that do are many, and most of the others are proved */
    assert_true(count[0][1] > 3 * count[0][0] && count[0][0] > 0);
}

static void no_point_among_random_facets_is_proved_wrongly(void **state)
{
    (void)state;
    uint32_t count = 0;
    for (uint32_t round = 0; round < 60; round++) {
        enum { V = 14, F = 30 };
        for (uint32_t v = 0; v < V; v++) {
            for (int k = 0; k < 3; k++) {
                double x = next_number() - 0.5;
                vertex[v].x[k] = round % 3 == 2 && k == 2 ? 0.25 : round % 2 ? floor(5 * x) : x;
            }
        }
        for (uint32_t f = 0; f < F; f++) {
            for (int k = 0; k < 3; k++) {
                facet[f].corner[k] = (uint32_t)(V * next_number());
            }
            const uint32_t *c = facet[f].corner;
            skip[f] = (unsigned char)lrcsi_exact_collinear(vertex[c[0]].x, vertex[c[1]].x,
                                                           vertex[c[2]].x);
        }
        prove_rings(V, F);
        for (uint32_t v = 0; v < V; v++) {
            assert_false(proved[v] && ring_meets_itself(v, F));
            count += proved[v];
        }
    }
    assert_true(count > 0);
}

/* A cone, tilted, over its base, with thousands of slivers about its tip and the middle of its
   base: all fans are proved, each facet knows its apex, and the tree leaves their pairs out. */
static void fans_are_proved_and_their_pairs_left_out(void **state)
{
    (void)state;
    enum { N = 1400 };
    for (uint32_t i = 0; i < N + 2; i++) {
        double turn = 2.0 * 3.14159265358979 * i / N;
        double x = i < N ? cos(turn) : 0.0;
        double y = i < N ? sin(turn) : 0.0;
        double z = i == N ? 1.5 : 0.0;
        vertex[i] = (lrcs_point){{0.8 * x - 0.6 * z, y, 0.6 * x + 0.8 * z}};
    }
    for (uint32_t i = 0; i < N; i++) {
        facet[i] = (lrcs_facet){{N, i, (i + 1) % N}};
        facet[N + i] = (lrcs_facet){{N + 1, (i + 1) % N, i}};
    }
    memset(skip, 0, sizeof skip);
    prove_rings(N + 2, 2 * N);
    for (uint32_t v = 0; v < N + 2; v++) {
        assert_true(proved[v]);
    }
    for (uint32_t f = 0; f < 2 * N; f++) {
        assert_int_equal(apex[f], f < N ? N : N + 1);
    }
    lrcs_work work = lrcs_work_make(room, ROOM);
    lrcsi_tree tree;
    assert_int_equal(lrcsi_tree_make(vertex, facet, 2 * N, NULL, apex, 1, &work, &tree), LRCS_OK);
    uint32_t mixed = 0;
    for (uint32_t leaf = 0; leaf < tree.nodes[0]; leaf++) {
        mixed += tree.label[0][leaf] == LRCS_NONE;
        lrcsi_tree_walk walk = lrcsi_tree_after(&tree, leaf);
        for (uint32_t other; (other = lrcsi_tree_next(&walk)) != LRCS_NONE;) {
            assert_true(tree.label[0][leaf] == LRCS_NONE ||
                        tree.label[0][leaf] != tree.label[0][other]);
        }
    }
    assert_true(mixed <= 1); /* where one apex's facets end and the other's start */
}

/* Needles about vertex 0 at random, within `width` of each other; a few of them are broad. */
static void make_needles(uint32_t facets, double width, double broad)
{
    vertex[0] = (lrcs_point){{0.25, -0.5, 0.125}};
    for (uint32_t f = 0; f < facets; f++) {
        double size = next_number() < 0.02 ? broad : width;
        double length = 0.5 + next_number();
        double x[3];
        for (int k = 0; k < 3; k++) {
            x[k] = length * (2 * next_number() - 1);
        }
        for (int k = 0; k < 3; k++) {
            vertex[2 * f + 1].x[k] = vertex[0].x[k] + x[k];
            vertex[2 * f + 2].x[k] = vertex[0].x[k] + x[k] + size * (next_number() - 0.5);
        }
        facet[f] = (lrcs_facet){{0, 2 * f + 1, 2 * f + 2}};
    }
}

/* Pairs of leaves of one fan that cones leave out: by brute force their facets meet in the apex
   alone. Returned: how many are left; *met: pairs of facets that meet otherwise. */
static uint32_t check_cones(uint32_t facets, uint32_t *met)
{
    static unsigned char kept[MOST];
    static const unsigned char none[1] = {0};
    lrcs_work work = lrcs_work_make(room, ROOM);
    lrcsi_tree tree;
    uint32_t left = 0;
    memset(apex, 0, sizeof apex);
    assert_int_equal(lrcsi_tree_make(vertex, facet, facets, NULL, apex, 1, &work, &tree), LRCS_OK);
    lrcsi_tree_fill_cones(vertex, facet, none, &tree);
    for (uint32_t leaf = 0; leaf < tree.nodes[0]; leaf++) {
        memset(kept, 0, sizeof kept);
        lrcsi_tree_walk walk = lrcsi_tree_after(&tree, leaf);
        walk.without = LRCS_NONE;
        lrcsi_tree_narrow_by_cones(&walk, leaf);
        for (uint32_t other; (other = lrcsi_tree_next(&walk)) != LRCS_NONE; left++) {
            kept[other] = 1;
        }
        for (uint32_t i = leaf * LRCSI_TREE_LANES; i < (leaf + 1) * LRCSI_TREE_LANES; i++) {
            for (uint32_t j = (leaf + 1) * LRCSI_TREE_LANES; j < facets && i < facets; j++) {
                contacts_facet a = contacts_facet_make(vertex, &facet[tree.order[i]]);
                contacts_facet b = contacts_facet_make(vertex, &facet[tree.order[j]]);
                if (contacts_kind(&a, &b) != LRCSI_INTERSECTION_NONE || contacts_rim(&a, &b)) {
                    assert_true(kept[j / LRCSI_TREE_LANES]);
                    ++*met;
                }
            }
        }
    }
    return left;
}

/* A fan without a proof, at random: cones leave out most pairs of leaves where facets are narrow,
   and never one that meets in more than the apex. */
static void cones_leave_out_only_facets_that_meet_in_the_apex(void **state)
{
    (void)state;
    enum { N = 800, LEAVES = N / LRCSI_TREE_LANES };
    static const double width[] = {1e-14, 1e-9, 1e-3, 0.03, 0.3, 2};
    uint32_t met = 0;
    for (int i = 0; i < 6; i++) {
        for (int broad = 0; broad < 2; broad++) {
            make_needles(N, width[i], broad ? 3 : width[i]);
            uint32_t left = check_cones(N, &met);
            assert_true(width[i] > 1e-3 || broad || left < LEAVES * LEAVES / 5);
        }
    }
    assert_true(met > 1000);
}

/* Two cones tip to tip: the fan is not proved, its facets know their apex all the same. */
static void fans_without_a_proof_have_an_apex(void **state)
{
    (void)state;
    enum { N = 700 };
    uint32_t met = 0;
    vertex[0] = (lrcs_point){{0, 0, 0}};
    for (uint32_t i = 0; i < N; i++) {
        double turn = 2.0 * 3.14159265358979 * i / N;
        vertex[1 + i] = (lrcs_point){{cos(turn), sin(turn), 1}};
        vertex[1 + N + i] = (lrcs_point){{cos(turn), sin(turn), -1}};
        facet[i] = (lrcs_facet){{0, 1 + i, 1 + (i + 1) % N}};
        facet[N + i] = (lrcs_facet){{0, 1 + N + (i + 1) % N, 1 + N + i}};
    }
    memset(skip, 0, sizeof skip);
    prove_rings(2 * N + 1, 2 * N);
    assert_false(proved[0]);
    for (uint32_t f = 0; f < 2 * N; f++) {
        assert_int_equal(apex[f], 0);
    }
    assert_true(check_cones(2 * N, &met) < 8 * 2 * N / LRCSI_TREE_LANES);
    assert_int_equal(met, 0);
}

/* The proof succeeds in whichever direction the fan is turned. */
static void surfaces_are_proved_whichever_way_they_face(void **state)
{
    (void)state;
    enum { AROUND = 20 };
    for (uint32_t round = 0; round < 500; round++) {
        uint32_t facets = make_ring(4 + round % AROUND, 6.283185307179586, 1, 0);
        double q[4];
        double square = 0.0;
        for (int i = 0; i < 4; i++) {
            q[i] = next_number() - 0.5;
            square += q[i] * q[i];
        }
        for (uint32_t v = 0; v <= facets; v++) { /* turned by the quaternion */
            const double *x = vertex[v].x;
            double dot = q[1] * x[0] + q[2] * x[1] + q[3] * x[2];
            double own = q[0] * q[0] - (square - q[0] * q[0]);
            lrcs_point y;
            for (int k = 0; k < 3; k++) {
                double cross =
                    q[1 + (k + 1) % 3] * x[(k + 2) % 3] - q[1 + (k + 2) % 3] * x[(k + 1) % 3];
                y.x[k] = (own * x[k] + 2 * dot * q[1 + k] + 2 * q[0] * cross) / square;
            }
            vertex[v] = y;
        }
        prove_rings(facets + 1, facets);
        if (!proved[0]) { /* steep fans of few facets may lean over */
            assert_true(facets < 8);
        }
    }
}

/* A fan of 40 facets about vertex 0, and one of 50 about vertex 1 with two facets in common, which
   is not proved: 48 of its facets have a side in common. With `spoiled` the first is not either. */
static uint32_t make_two_fans(int spoiled)
{
    enum { FIRST = 40, SECOND = 50 };
    vertex[0] = (lrcs_point){{0, 0, 0}};
    for (uint32_t k = 0; k < FIRST; k++) {
        double t = 2.0 * 3.14159265358979 * k / FIRST;
        vertex[1 + k] = (lrcs_point){{cos(t), sin(t), 0}};
        facet[k] = (lrcs_facet){{0, 1 + k, 1 + (k + 1) % FIRST}};
    }
    uint32_t facets = FIRST;
    uint32_t tip = FIRST + 1;
    vertex[tip] = (lrcs_point){{3, 0, 1}};
    for (uint32_t k = 0; k < SECOND - 2; k++) {
        vertex[tip + 1 + k] = (lrcs_point){{2, 0.1 * k + 0.1, 2}};
        facet[facets++] = (lrcs_facet){{1, tip, tip + 1 + k}};
    }
    uint32_t vertices = tip + SECOND - 1;
    for (uint32_t k = 0; k < 2 && spoiled; k++) { /* two more facets on one side of the first fan */
        vertex[vertices] = (lrcs_point){{0.5, 0.5, 1.0 + k}};
        facet[facets++] = (lrcs_facet){{0, 11, vertices++}};
    }
    memset(skip, 0, sizeof skip);
    prove_rings(vertices, facets);
    return facets;
}

static void the_apex_is_proved_if_any_is_and_else_the_one_with_more_facets(void **state)
{
    (void)state;
    make_two_fans(0);
    assert_true(proved[0] && !proved[1]);
    assert_int_equal(apex[0], 0);
    assert_int_equal(apex[20], 0);
    assert_int_equal(apex[45], 1);
    make_two_fans(1);
    assert_true(!proved[0] && !proved[1]);
    assert_int_equal(apex[0], 1);
    assert_int_equal(apex[20], 0);
}

/* Facets without area that are not skipped prevent proofs at their corners; apexes are optional. */
static void facets_without_area_are_no_proof(void **state)
{
    (void)state;
    static const double corner[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};
    for (uint32_t v = 0; v < 4; v++) {
        memcpy(vertex[v].x, corner[v], sizeof corner[v]);
    }
    facet[0] = (lrcs_facet){{0, 1, 2}};
    facet[1] = (lrcs_facet){{0, 1, 3}};
    lrcs_work work = lrcs_work_make(room, ROOM);
    lrcsi_topology topology;
    assert_int_equal(lrcsi_topology_make(vertex, 4, facet, 2, &work, &topology), LRCS_OK);
    assert_int_equal(lrcsi_fans_prove(vertex, 4, facet, 2, &topology, NULL, &work, proved, NULL),
                     LRCS_OK);
    assert_true(!proved[0] && !proved[1] && proved[2] && !proved[3]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_ring_that_meets_itself_is_proved),
        cmocka_unit_test(no_point_among_random_facets_is_proved_wrongly),
        cmocka_unit_test(fans_are_proved_and_their_pairs_left_out),
        cmocka_unit_test(cones_leave_out_only_facets_that_meet_in_the_apex),
        cmocka_unit_test(fans_without_a_proof_have_an_apex),
        cmocka_unit_test(the_apex_is_proved_if_any_is_and_else_the_one_with_more_facets),
        cmocka_unit_test(facets_without_area_are_no_proof),
        cmocka_unit_test(surfaces_are_proved_whichever_way_they_face),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
