/* SPDX-License-Identifier: MIT */
/* Exact samples on facets in layers, which do not meet, seen along vectors of small integers:
   against the facets in front of the same points, found in integers. */
#include "visibility/uniform/query.h"

#include "integer_view.h"

#define LAYERS 24u

static lrcsi_crossings crossings;
static unsigned char answer[SCENE_FACETS];

/* Triangles, each at heights of its own. Coordinates are multiples of 12, so that centroids, and
   means of corners with weights of some twelfths, are integers. */
static void scene_layers(uint64_t *random, lrcs_part part[2])
{
    scene_start(&scene);
    for (uint32_t i = 0; i < LAYERS; i++) {
        double x[3][3];
        int half = i % 4 == 3 ? 24 : 8; /* some are large */
        for (int k = 0; k < 9; k++) {
            x[k / 3][k % 3] = (double)(12 * integer_between(random, -half, half));
        }
        for (int k = 0; k < 3; k++) {
            x[k][2] = (double)(12 * (3 * (int64_t)i + integer_between(random, 0, 1)));
        }
        uint32_t f = scene_triangle(&scene, x[0], x[1], x[2]);
        scene.part_of[f] = f % 2;
    }
    part[0] = part[1] = scene.part;
    scene.scene.part = part;
    scene.scene.part_count = 2;
}

/* The mean of a facet's corners with weights of so many twelfths. */
static void mean_of_corners(uint32_t facet, const int weight[3], int64_t x[3])
{
    for (int k = 0; k < 3; k++) {
        x[k] = 0;
    }
    for (int i = 0; i < 3; i++) {
        int64_t at[3];
        vertex_at(scene.facet[facet].corner[i], at);
        for (int k = 0; k < 3; k++) {
            x[k] += weight[i] * at[k] / 12;
        }
    }
}

/* Is a point of a facet hidden by facets of parts that are not in the set? -1: it may be at the
   border of one. */
static int hidden_exactly(uint32_t facet, const int64_t x[3], lrcsi_part_set parts)
{
    int hidden = 0;
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        int covers =
            f != facet && casts_exactly(f) && (parts & lrcsi_part_set_of(scene.part_of[f])) == 0
                ? covers_exactly(f, x)
                : -1;
        if (covers == 0) {
            return -1;
        }
        hidden |= covers > 0 && height_above(f, x) < 0;
    }
    return hidden;
}

static unsigned answers[2]; /* how often a facet was hidden, and visible */

static void check_answer(int got, int hidden)
{
    if (hidden >= 0) {
        assert_int_equal(got, hidden ? LRCSI_QUERY_HIDDEN : LRCSI_QUERY_VISIBLE);
        answers[got]++;
    }
}

static void check_queries(uint32_t facet)
{
    static const int centre[3] = {4, 4, 4};
    static const int at[4][3] = {{1, 1, 10}, {2, 9, 1}, {10, 1, 1}, {6, 3, 3}};
    int64_t x[3];
    mean_of_corners(facet, centre, x);
    check_answer(lrcsi_query_facet(&facets, facet, NULL), hidden_exactly(facet, x, 0));
    for (uint32_t part = 0; part < 2; part++) {
        int hidden = hidden_exactly(facet, x, lrcsi_part_set_of(part));
        if (hidden_exactly(facet, x, 0) >= 0) {
            assert_int_equal(
                lrcsi_query_hidden_by_others(&facets, facet, lrcsi_part_set_of(part), NULL),
                hidden);
        }
    }
    for (int i = 0; i < 4; i++) {
        double point[3];
        mean_of_corners(facet, at[i], x);
        for (int k = 0; k < 3; k++) {
            point[k] = ldexp((double)x[k], -view.prepared->exponent);
        }
        check_answer(lrcsi_query_point(&facets, facet, point, NULL), hidden_exactly(facet, x, 0));
    }
}

/* An answer about a whole facet holds at each of its points. */
static void check_all_of_it(uint32_t facet, int hidden)
{
    for (int i = 1; i < 11; i++) {
        for (int k = 1; k < 12 - i; k++) {
            int64_t x[3];
            mean_of_corners(facet, (const int[3]){i, k, 12 - i - k}, x);
            int exactly = hidden_exactly(facet, x, 0);
            assert_true(exactly < 0 || exactly == hidden);
        }
    }
}

static void samples_agree_with_integers(void **state)
{
    (void)state;
    uint64_t random = 20261128;
    unsigned screened = 0;
    unsigned uniform = 0;
    for (int i = 0; i < 100; i++) {
        lrcs_part part[2];
        lrcsi_grid grid;
        scene_layers(&random, part);
        look_along(integer_between(&random, -2, 2), integer_between(&random, -2, 2),
                   integer_between(&random, 1, 3));
        assert_int_equal(lrcsi_crossings_make(&classification.search, &work, &crossings), LRCS_OK);
        assert_int_equal(lrcsi_query_uniform(&classification, NULL, &work, &grid, answer), LRCS_OK);
        for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
            if (!casts_exactly(f)) {
                continue;
            }
            check_queries(f);
            if (!classification.undecided[f]) {
                check_all_of_it(f, answer[f] == LRCSI_QUERY_HIDDEN);
                uniform++;
            } else if (lrcsi_query_hidden_by_component(&classification, &facets, f, NULL,
                                                       &crossings)) {
                check_all_of_it(f, 1);
                screened++;
            }
        }
    }
    assert_true(answers[0] > 500 && answers[1] > 500 && screened > 30 && uniform > 50);
}

static void a_spent_meter_leaves_a_sample_undecided(void **state)
{
    (void)state;
    lrcs_part part[2];
    uint64_t random = 3;
    lrcsi_meter meter = {.limit = 0};
    scene_layers(&random, part);
    look_along(0, 0, 1);
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        if (casts_exactly(f)) {
            assert_int_equal(lrcsi_query_facet(&facets, f, &meter), LRCSI_QUERY_NO_ANSWER);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_agree_with_integers),
        cmocka_unit_test(a_spent_meter_leaves_a_sample_undecided),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
