/* SPDX-License-Identifier: MIT */
/* The neighbours of facets: counted by hand on small scenes, and against a search through all other
   facets on random ones. */
#include "scene/prepare.h"

#include "random.h"
#include "scenes.h"

static test_scene scene;
static lrcs_work work;

static void box_faces_have_one_neighbour_on_every_side(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
    const lrcsi_neighbours *neighbours = &scene_prepare(&scene, &work)->neighbours;
    assert_int_equal(neighbours->irregular_count, 0);
    for (uint32_t f = 0; f < 12; f++) {
        for (int k = 0; k < 3; k++) {
            assert_true(neighbours->facet[f].corner[k] < 12 && neighbours->facet[f].corner[k] != f);
        }
    }
}

static void rims_have_none_and_omitted_facets_are_none(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                (const double[3]){0, 1, 0});
    const lrcsi_neighbours *neighbours = &scene_prepare(&scene, &work)->neighbours;
    for (uint32_t f = 0; f < 2; f++) {
        int met = 0;
        for (int k = 0; k < 3; k++) {
            uint32_t other = neighbours->facet[f].corner[k];
            assert_true(other == 1 - f || other == 2);
            met += other == 1 - f;
        }
        assert_int_equal(met, 1); /* the diagonal */
    }
    scene_material(&scene, 1, 1, 0.2, 0)->omitted = 1;
    scene.material_of[1] = scene.assigned;
    neighbours = &scene_prepare(&scene, &work)->neighbours;
    for (int k = 0; k < 3; k++) {
        assert_int_equal(neighbours->facet[0].corner[k], 2);
        assert_int_equal(neighbours->facet[1].corner[k], 1); /* itself */
    }
}

static int same_vertex(uint32_t a, uint32_t b)
{
    return memcmp(&scene.vertex[a], &scene.vertex[b], sizeof(lrcs_point)) == 0;
}

/* Facets other than f with the side a b, either way round, that are not redundant; how many run it
   from a to b; the only one, or the last that runs it from b to a and is not the opposite of f. */
static uint32_t others_on(const lrcs_prepared *prepared, uint32_t f, uint32_t a, uint32_t b,
                          uint32_t *other, uint32_t *along)
{
    uint32_t count = 0;
    *along = 0;
    for (uint32_t g = 0; g < scene.scene.facet_count; g++) {
        for (int k = 0; k < 3 && g != f && prepared->redundant[g] != LRCSI_REDUNDANT; k++) {
            uint32_t p = scene.facet[g].corner[k];
            uint32_t q = scene.facet[g].corner[(k + 1) % 3];
            int same = same_vertex(a, p) && same_vertex(b, q);
            int opposite = prepared->opposite && prepared->opposite[f] == g;
            if (same || (same_vertex(a, q) && same_vertex(b, p))) {
                *other = *other == LRCS_NONE || !(same || opposite) ? g : *other;
                *along += (uint32_t)same;
                count++;
            }
        }
    }
    return count;
}

/* Facets among 9 points, no three on a line, many of them on one edge. */
static void random_facets(uint32_t seed)
{
    uint64_t state = 88172645463325252u + seed;
    scene_start(&scene);
    for (int v = 0; v < 9; v++) {
        scene_vertex(&scene, v, v * v, v * v * v);
    }
    for (int f = 0; f < 20; f++) {
        uint32_t corner[3];
        for (int k = 0; k < 3; k++) {
            corner[k] = (uint32_t)(random_xorshift(&state) >> 32) % 3 + 3 * (uint32_t)k;
        }
        int turn = f % 2;
        scene_facet(&scene, corner[0], corner[1 + turn], corner[2 - turn]);
    }
}

static void random_soups_agree_with_a_search(void **state)
{
    (void)state;
    int plain = 0;
    int irregular = 0;
    int two_pairs = 0;
    for (uint32_t seed = 1; seed <= 400; seed++) {
        random_facets(seed);
        scene.scene.facet_count = 3 + seed % 18;
        const lrcs_prepared *p = scene_prepare(&scene, &work);
        uint32_t count = scene.scene.facet_count;
        for (uint32_t i = 0; i < 3 * count; i++) {
            uint32_t f = i / 3;
            uint32_t k = i % 3;
            if (p->redundant[f] == LRCSI_REDUNDANT) {
                assert_int_equal(p->neighbours.facet[f].corner[k], f);
                continue;
            }
            uint32_t other = LRCS_NONE;
            uint32_t along;
            uint32_t others = others_on(p, f, scene.facet[f].corner[k],
                                        scene.facet[f].corner[(k + 1) % 3], &other, &along);
            int pairs = others == 3 && p->opposite && p->opposite[f] != LRCS_NONE &&
                        p->opposite[other] != LRCS_NONE && other != p->opposite[f];
            uint32_t want = others == 0 ? count : (others == 1 && along == 0) || pairs ? other : f;
            assert_int_equal(p->neighbours.facet[f].corner[k], want);
            int listed = 0;
            for (uint32_t n = 0; n < p->neighbours.irregular_count; n++) {
                listed += p->neighbours.irregular[n] == p->topology.facet_edge[f].corner[k];
            }
            assert_int_equal(listed, want == f);
            plain += others == 1 && along == 0;
            two_pairs += pairs;
            irregular += want == f;
        }
    }
    assert_true(plain > 100 && irregular > 100 && two_pairs > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(box_faces_have_one_neighbour_on_every_side),
        cmocka_unit_test(rims_have_none_and_omitted_facets_are_none),
        cmocka_unit_test(random_soups_agree_with_a_search),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
