/* SPDX-License-Identifier: MIT */
/* Contacts between facets: pairs against clipping in rational arithmetic
   (vectors/intersection_pairs.py), lists, rims and self-contact against brute force over all pairs,
   and cases named. */
#include "mesh/contact/intersection.h"

#include <stdlib.h>
#include <string.h>

#include "base/work.h"
#include "check.h"
#include "mesh/contacts.h"

typedef struct pair_case {
    signed char b_in_a, a_in_b;
    signed char b_on_a, a_on_b; /* rims */
    signed char x[18];          /* corners of a, then of b */
} pair_case;

static const pair_case pair_cases[] = {
#define PAIR(ab, ba, on_a, on_b, ...)                                                              \
    {                                                                                              \
        ab, ba, on_a, on_b,                                                                        \
        {                                                                                          \
            __VA_ARGS__                                                                            \
        }                                                                                          \
    }
#include "vectors/intersection_pairs.inc"
};

enum { PAIRS = sizeof pair_cases / sizeof *pair_cases, ROOM = 8 << 20, MOST = 3000 };

static unsigned char room[ROOM];
static lrcs_point vertex[3 * MOST];
static lrcs_facet facet[MOST];

static const lrcs_facet first_three = {{0, 1, 2}};
static const lrcs_facet last_three = {{3, 4, 5}};

static void check_kinds(const lrcs_point *v, const pair_case *c)
{
    for (uint32_t turn = 0; turn < 6; turn++) {
        uint32_t i = turn % 3;
        uint32_t j = turn < 3 ? (i + 1) % 3 : (i + 2) % 3; /* both windings */
        const lrcs_facet b = {{3 + i, 3 + j, 3 + (3 - i - j)}};
        assert_int_equal(lrcsi_intersection_pair(v, first_three, b), c->b_in_a);
        assert_int_equal(lrcsi_intersection_pair(v, b, first_three), c->a_in_b);
    }
}

/* Contacts with the topology that they need, in `work`. */
static int make_touches(uint32_t vertices, uint32_t facets, const unsigned char *skip,
                        const lrcsi_shells *shells, lrcs_work *work, lrcsi_intersections *t)
{
    lrcsi_topology topology;
    assert_int_equal(lrcsi_topology_make(vertex, vertices, facet, facets, work, &topology),
                     LRCS_OK);
    size_t before = work->used;
    int status =
        lrcsi_intersection_make(vertex, vertices, facet, facets, &topology, skip, shells, work, t);
    if (status == LRCS_OK) {
        assert_true(work->peak - before <= lrcsi_intersection_need(vertices, facets, t->count));
    }
    return status;
}

/* Rims, whether corners in one place are one vertex or two. */
static void check_rims(const lrcs_point *v, const pair_case *c, int welded)
{
    lrcs_work work = lrcs_work_make(room, ROOM);
    lrcsi_intersections t;
    memcpy(vertex, v, 6 * sizeof *v);
    facet[0] = first_three;
    facet[1] = last_three;
    for (uint32_t i = 0; i < 9 && welded; i++) {
        if (memcmp(&v[i / 3], &v[3 + i % 3], sizeof *v) == 0) {
            facet[1].corner[i % 3] = i / 3;
        }
    }
    assert_int_equal(make_touches(6, 2, NULL, NULL, &work, &t), LRCS_OK);
    assert_int_equal(t.met[0] != 0, c->b_on_a || c->b_in_a != LRCSI_INTERSECTION_NONE);
    assert_int_equal(t.met[1] != 0, c->a_on_b || c->a_in_b != LRCSI_INTERSECTION_NONE);
}

/* The reference that lists are compared with. */
static void check_reference(const lrcs_point *v, const pair_case *c)
{
    contacts_facet a = contacts_facet_make(v, &first_three);
    contacts_facet b = contacts_facet_make(v, &last_three);
    assert_int_equal(contacts_kind(&a, &b), c->b_in_a);
    assert_int_equal(contacts_kind(&b, &a), c->a_in_b);
    assert_int_equal(contacts_rim(&a, &b), c->b_on_a);
    assert_int_equal(contacts_rim(&b, &a), c->a_on_b);
}

static void pairs_agree_with_rational_clipping(void **state)
{
    (void)state;
    for (int n = 0; n < PAIRS; n++) {
        lrcs_point v[6];
        for (int i = 0; i < 18; i++) {
            v[i / 3].x[i % 3] = pair_cases[n].x[i];
        }
        check_kinds(v, &pair_cases[n]);
        check_reference(v, &pair_cases[n]);
        check_rims(v, &pair_cases[n], 0);
        check_rims(v, &pair_cases[n], 1);
    }
    assert_true(PAIRS >= 4000);
}

/* The same under an integer map that tilts and shears, far from the origin, times a power of
   two: exact in doubles, so that nothing may change. */
static void affine_images_keep_their_contacts(void **state)
{
    (void)state;
    static const double map[3][3] = {{1, 200, 2}, {2, 1, -2}, {-2, 2, 10001}};
    for (int n = 0; n < PAIRS; n++) {
        lrcs_point v[6];
        for (int i = 0; i < 6; i++) {
            const signed char *x = pair_cases[n].x + 3 * i;
            for (int k = 0; k < 3; k++) {
                v[i].x[k] =
                    (map[k][0] * x[0] + map[k][1] * x[1] + map[k][2] * x[2] + 0x1p33) * 0x1p-70;
            }
        }
        check_kinds(v, &pair_cases[n]);
    }
}

/* What brute force finds that pairs do to facet f: its rim, and self-contact. The contacts are
   compared as they come up. */
static void check_facet(uint32_t f, uint32_t facets, const unsigned char *skip,
                        const uint32_t *piece, const lrcsi_intersections *t, unsigned char *self)
{
    contacts_facet own = contacts_facet_make(vertex, &facet[f]);
    uint32_t at = t->first[f];
    int rim = 0;
    for (uint32_t g = 0; g < facets && !skip[f]; g++) {
        if (g == f || skip[g]) {
            continue;
        }
        contacts_facet other = contacts_facet_make(vertex, &facet[g]);
        int kind = contacts_kind(&own, &other);
        assert_int_equal(lrcsi_intersection_pair(vertex, facet[f], facet[g]), kind);
        rim |= kind != LRCSI_INTERSECTION_NONE || contacts_rim(&own, &other);
        if (piece[f] != LRCS_NONE && piece[f] == piece[g]) {
            self[piece[f]] |= kind != LRCSI_INTERSECTION_NONE || contacts_on_side(&own, &other);
        }
        if (kind != LRCSI_INTERSECTION_NONE) {
            assert_true(at < t->first[f + 1]);
            assert_int_equal(t->entry[at].other, g);
            assert_int_equal(t->entry[at].kind, kind);
            at++;
        }
    }
    assert_int_equal(t->first[f + 1], at);
    assert_int_equal(t->met[f] != 0, rim);
}

/* Contacts, rims and self-contact against brute force; returns the number of contacts. */
static uint32_t check_against_all_pairs(uint32_t vertices, uint32_t facets,
                                        const unsigned char *skip)
{
    static uint32_t piece[MOST];
    unsigned char found[10] = {0};
    unsigned char self[10] = {0};
    lrcs_work work = lrcs_work_make(room, ROOM);
    lrcsi_intersections t;
    for (uint32_t f = 0; f < facets; f++) {
        piece[f] = f % 10 < 9 ? f % 10 : LRCS_NONE; /* few pairs tell */
    }
    assert_int_equal(make_touches(vertices, facets, skip, &(lrcsi_shells){piece, found}, &work, &t),
                     LRCS_OK);
    assert_int_equal(t.first[0], 0);
    for (uint32_t f = 0; f < facets; f++) {
        check_facet(f, facets, skip, piece, &t, self);
    }
    assert_int_equal(t.count, t.first[facets]);
    assert_memory_equal(found, self, sizeof found);
    return t.count;
}

static uint32_t seed = 1;

static double next_number(void)
{
    seed = seed * 1664525u + 1013904223u;
    return (double)(seed >> 8) * 0x1p-24;
}

/* Facets of sizes over three decades, on a lattice of `cells` (0: none). */
static void make_soup(uint32_t facets, double cells, unsigned char *skip)
{
    for (uint32_t f = 0; f < facets; f++) {
        double size = f % 50 == 0 ? 1.0 : f % 7 == 0 ? 0.1 : 0.02;
        double centre[3] = {next_number(), next_number(), next_number()};
        for (uint32_t c = 0; c < 3; c++) {
            for (int k = 0; k < 3; k++) {
                double x = centre[k] + size * (next_number() - 0.5);
                vertex[3 * f + c].x[k] = cells > 0.0 ? floor(x * cells) : x;
            }
            facet[f].corner[c] = 3 * f + c;
        }
        skip[f] = (unsigned char)lrcsi_exact_collinear(vertex[3 * f].x, vertex[3 * f + 1].x,
                                                       vertex[3 * f + 2].x);
    }
}

static void the_tree_misses_no_contact(void **state)
{
    (void)state;
    static unsigned char skip[MOST];
    make_soup(600, 0.0, skip);
    check_against_all_pairs(1800, 600, skip);
    make_soup(600, 30.0, skip);
    check_against_all_pairs(1800, 600, skip);
    make_soup(600, 5.0, skip);
    check_against_all_pairs(1800, 600, skip);
    make_soup(600, 0.0, skip);
    for (uint32_t i = 0; i < 1800; i++) { /* slivers along one slanted line */
        double along = 30.0 * vertex[i].x[0] - 50.0 * vertex[i].x[1] + 40.0 * vertex[i].x[2];
        for (int k = 0; k < 3; k++) {
            vertex[i].x[k] += (1.0 + k) * along;
        }
    }
    check_against_all_pairs(1800, 600, skip);
    for (uint32_t n = 1; n < 20; n++) {
        make_soup(n, 3.0, skip);
        check_against_all_pairs(3 * n, n, skip);
    }
}

/* Long slivers along one diagonal, and some facets across: the boxes of all leaves intersect, so
   that the search fills slabs, which most of them are apart by. */
static void slabs_of_crowded_leaves_miss_no_contact(void **state)
{
    (void)state;
    enum { SLIVERS = 1200, ACROSS = 40 };
    static unsigned char skip[MOST];
    make_soup(SLIVERS + ACROSS, 0.0, skip);
    for (uint32_t f = 0; f < SLIVERS; f++) {
        const double at[3] = {10.0 * next_number(), 10.0 * next_number(), 10.0 * next_number()};
        for (uint32_t c = 0; c < 3; c++) {
            for (int k = 0; k < 3; k++) {
                double off = 0.02 * next_number();
                vertex[3 * f + c].x[k] = at[k] + (c == 0 ? -100.0 : 100.0) + off;
            }
        }
        skip[f] = (unsigned char)lrcsi_exact_collinear(vertex[3 * f].x, vertex[3 * f + 1].x,
                                                       vertex[3 * f + 2].x);
    }
    for (uint32_t i = 3 * SLIVERS; i < 3 * (SLIVERS + ACROSS); i++) {
        for (int k = 0; k < 3; k++) {
            vertex[i].x[k] = 20.0 * next_number() - 5.0;
        }
    }
    assert_true(check_against_all_pairs(3 * (SLIVERS + ACROSS), SLIVERS + ACROSS, skip) > 100);
}

/* The wall of a tilted tube of many long facets, whose boxes nearly all intersect; another one that
   runs through it, and large facets across both. Slabs of single leaves separate most pairs. */
static void long_facets_of_tilted_tubes_miss_no_contact(void **state)
{
    (void)state;
    enum { SECTORS = 150, WALL = 2 * SECTORS, ACROSS = 40 };
    static unsigned char skip[MOST];
    memset(skip, 0, sizeof skip);
    for (uint32_t i = 0; i < 2 * WALL; i++) {
        uint32_t tube = i / WALL;
        double turn = 6.283185307179586 * (i % WALL / 2 + 0.3 * tube) / SECTORS;
        double x = 0.3 * cos(turn);
        double y = 0.3 * sin(turn) + 0.1 * tube;
        double z = i % 2 ? 1.0 : -1.0;
        vertex[i] = (lrcs_point){{x + 0.6 * z, y - 0.5 * x + 0.7 * z, z - 0.4 * y}};
        uint32_t next = tube * WALL + (i % WALL + 2 - i % 2) % WALL; /* bottom of the next sector */
        facet[i] = i % 2 ? (lrcs_facet){{i, next, next + 1}} : (lrcs_facet){{i, next, i + 1}};
    }
    for (uint32_t f = 2 * WALL; f < 2 * WALL + ACROSS; f++) {
        for (uint32_t c = 0; c < 3; c++) {
            uint32_t i = 2 * WALL + 3 * (f - 2 * WALL) + c;
            vertex[i] =
                (lrcs_point){{next_number() - 0.5, next_number() - 0.5, next_number() - 0.5}};
            facet[f].corner[c] = i;
        }
    }
    assert_true(check_against_all_pairs(2 * WALL + 3 * ACROSS, 2 * WALL + ACROSS, skip) > 200);
}

/* Facets between few vertices: most share corners with many others, and many cross. */
static void facets_around_common_corners_are_classified_exactly(void **state)
{
    (void)state;
    static unsigned char skip[MOST];
    for (uint32_t round = 0; round < 24; round++) {
        uint32_t vertices = 6 + 4 * round;
        uint32_t hubs = 1 + round % 3;
        for (uint32_t v = 0; v < vertices; v++) {
            for (int k = 0; k < 3; k++) { /* some on a lattice, some in one plane */
                double x = next_number() - 0.5;
                vertex[v].x[k] = round % 4 == 3 && k == 2 ? 0.25 : round % 2 ? floor(9 * x) : x;
            }
        }
        for (uint32_t f = 0; f < 200; f++) {
            for (uint32_t c = 0; c < 3; c++) {
                facet[f].corner[c] = (uint32_t)(next_number() * (c == f % 3 ? hubs : vertices));
            }
            const uint32_t *c = facet[f].corner;
            skip[f] = (unsigned char)lrcsi_exact_collinear(vertex[c[0]].x, vertex[c[1]].x,
                                                           vertex[c[2]].x);
        }
        check_against_all_pairs(vertices, 200, skip);
    }
}

/* A closed surface without self-contact, its top gridded: neighbours share edges and corners. */
static void neighbours_on_a_closed_surface_do_not_touch(void **state)
{
    (void)state;
    enum { N = 12 };
    static unsigned char skip[MOST];
    uint32_t facets = 0;
    for (uint32_t i = 0; i <= N; i++) { /* a torus of doubles that round */
        for (uint32_t j = 0; j <= N; j++) {
            double a = 0.5236 * (i % N);
            double b = 0.5236 * (j % N);
            vertex[i * (N + 1) + j] =
                (lrcs_point){{(3 + cos(b)) * cos(a), (3 + cos(b)) * sin(a), sin(b)}};
        }
    }
    for (uint32_t i = 0; i < N; i++) {
        for (uint32_t j = 0; j < N; j++) {
            uint32_t at = i * (N + 1) + j;
            facet[facets++] = (lrcs_facet){{at, at + N + 1, at + N + 2}};
            facet[facets++] = (lrcs_facet){{at, at + N + 2, at + 1}};
        }
    }
    memset(skip, 0, sizeof skip);
    lrcs_work work = lrcs_work_make(room, ROOM);
    lrcsi_intersections t;
    assert_int_equal(make_touches((N + 1) * (N + 1), facets, skip, NULL, &work, &t), LRCS_OK);
    assert_int_equal(t.count, 0);
    for (uint32_t f = 0; f < facets; f++) {
        assert_int_equal(t.met[f], 0);
    }
}

static void a_strut_touches_the_plate_and_not_the_other_way(void **state)
{
    (void)state;
    const lrcs_point v[6] = {{{0, 0, 0}}, {{9, 0, 0}}, {{0, 9, 0}},
                             {{2, 2, 0}}, {{3, 2, 0}}, {{2, 2, 5}}};
    assert_int_equal(lrcsi_intersection_pair(v, first_three, last_three), LRCSI_INTERSECTION_CROSS);
    assert_int_equal(lrcsi_intersection_pair(v, last_three, first_three), LRCSI_INTERSECTION_NONE);
}

static void a_plate_one_ulp_above_another_does_not_touch(void **state)
{
    (void)state;
    lrcs_point v[6] = {{{0, 0, 0.1}}, {{9, 0, 0.1}}, {{0, 9, 0.1}},
                       {{1, 1, 0.1}}, {{3, 1, 0.1}}, {{1, 3, 0.1}}};
    assert_int_equal(lrcsi_intersection_pair(v, first_three, last_three),
                     LRCSI_INTERSECTION_COPLANAR);
    assert_int_equal(lrcsi_intersection_pair(v, last_three, first_three),
                     LRCSI_INTERSECTION_COPLANAR);
    v[3].x[2] = nextafter(0.1, 1.0);
    assert_int_equal(lrcsi_intersection_pair(v, first_three, last_three), LRCSI_INTERSECTION_CROSS);
    v[4].x[2] = v[5].x[2] = nextafter(0.1, 1.0);
    assert_int_equal(lrcsi_intersection_pair(v, first_three, last_three), LRCSI_INTERSECTION_NONE);
}

static void folded_neighbours_in_one_plane_touch(void **state)
{
    (void)state;
    const lrcs_point v[4] = {{{0, 0, 0}}, {{4, 0, 0}}, {{1, 3, 0}}, {{2, 2, 0}}};
    const lrcs_facet a = {{0, 1, 2}};
    const lrcs_facet b = {{1, 0, 3}};
    const lrcs_facet c = {{0, 2, 1}};
    assert_int_equal(lrcsi_intersection_pair(v, a, b), LRCSI_INTERSECTION_COPLANAR);
    assert_int_equal(lrcsi_intersection_pair(v, a, c), LRCSI_INTERSECTION_COPLANAR);
}

/* Sides that lie along part of another's, in another plane; not that which both have, nor one that
   is met in a point. */
static void sides_along_other_sides_are_found(void **state)
{
    (void)state;
    const lrcs_point v[9] = {{{0, 0, 0}}, {{4, 0, 0}}, {{0, 4, 0}}, {{1, 0, 0}}, {{3, 0, 0}},
                             {{2, 0, 5}}, {{4, 4, 1}}, {{0, 2, 0}}, {{-3, 2, 1}}};
    memcpy(vertex, v, sizeof v);
    facet[0] = first_three;             /* its first side runs along that of 1 */
    facet[1] = (lrcs_facet){{3, 4, 5}}; /* and the whole side of 1 along it */
    facet[2] = (lrcs_facet){{2, 1, 6}}; /* has the second side of 0 */
    facet[3] = (lrcs_facet){{7, 5, 8}}; /* meets the third in a point */
    lrcsi_intersections t;
    lrcs_work work = lrcs_work_make(room, ROOM);
    assert_int_equal(make_touches(9, 4, NULL, NULL, &work, &t), LRCS_OK);
    for (uint32_t f = 0; f < 4; f++) {
        for (int k = 0; k < 3; k++) {
            assert_int_equal(lrcsi_intersection_along(&t, f, k), f < 2 && k == 0);
        }
    }
    assert_true(t.met[0] != 0);
}

static void an_empty_list_and_a_skipped_one_have_no_contacts(void **state)
{
    (void)state;
    unsigned char skip[2] = {1, 0};
    const lrcs_point v[3] = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}};
    memcpy(vertex, v, sizeof v);
    facet[0] = facet[1] = first_three;
    lrcsi_intersections t;
    lrcs_work work = lrcs_work_make(room, ROOM);
    assert_int_equal(make_touches(3, 0, NULL, NULL, &work, &t), LRCS_OK);
    assert_int_equal(t.count + t.first[0], 0);
    work = lrcs_work_make(room, ROOM);
    assert_int_equal(make_touches(3, 2, skip, NULL, &work, &t), LRCS_OK);
    assert_int_equal(t.count, 0);
    work = lrcs_work_make(room, ROOM);
    assert_int_equal(make_touches(3, 2, NULL, NULL, &work, &t), LRCS_OK);
    assert_int_equal(t.count, 2);
    assert_int_equal(t.first[1], 1);
    assert_int_equal(t.entry[1].other, 0);
}

static void searches_in_too_little_memory_fail_clean(void **state)
{
    (void)state;
    static unsigned char skip[MOST];
    make_soup(20, 0.0, skip);
    for (uint32_t f = 0; f < 20; f++) { /* large ones, which cross */
        for (int k = 0; k < 9; k++) {
            vertex[3 * f + (uint32_t)k / 3].x[k % 3] = next_number() - 0.5;
        }
    }
    lrcs_work whole = lrcs_work_make(room, ROOM);
    lrcsi_topology topology;
    lrcsi_intersections t;
    assert_int_equal(lrcsi_topology_make(vertex, 60, facet, 20, &whole, &topology), LRCS_OK);
    assert_int_equal(
        lrcsi_intersection_make(vertex, 60, facet, 20, &topology, skip, NULL, &whole, &t), LRCS_OK);
    uint32_t count = t.count;
    assert_true(count > 10);
    size_t need = lrcsi_intersection_need(60, 20, count);
    int status = LRCS_E_MEMORY;
    for (size_t size = 0; size <= need; size++) {
        unsigned char *bytes = malloc(size + 1);
        assert_non_null(bytes);
        lrcs_work work = lrcs_work_make(bytes, size);
        t.count = 99;
        status = lrcsi_intersection_make(vertex, 60, facet, 20, &topology, skip, NULL, &work, &t);
        if (status != LRCS_OK) {
            assert_int_equal(work.used, 0);
        }
        assert_int_equal(t.count, status == LRCS_OK ? count : 99);
        free(bytes);
    }
    assert_int_equal(status, LRCS_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_agree_with_rational_clipping),
        cmocka_unit_test(affine_images_keep_their_contacts),
        cmocka_unit_test(the_tree_misses_no_contact),
        cmocka_unit_test(slabs_of_crowded_leaves_miss_no_contact),
        cmocka_unit_test(long_facets_of_tilted_tubes_miss_no_contact),
        cmocka_unit_test(facets_around_common_corners_are_classified_exactly),
        cmocka_unit_test(neighbours_on_a_closed_surface_do_not_touch),
        cmocka_unit_test(a_strut_touches_the_plate_and_not_the_other_way),
        cmocka_unit_test(a_plate_one_ulp_above_another_does_not_touch),
        cmocka_unit_test(folded_neighbours_in_one_plane_touch),
        cmocka_unit_test(sides_along_other_sides_are_found),
        cmocka_unit_test(an_empty_list_and_a_skipped_one_have_no_contacts),
        cmocka_unit_test(searches_in_too_little_memory_fail_clean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
