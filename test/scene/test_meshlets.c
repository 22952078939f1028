/* SPDX-License-Identifier: MIT */
/* Meshlets of facets: their boxes, what is connected within one, and the sides that leave it. */
#include "scene/prepare.h"

#include "scene/meshlets.h"

#include "base/disjoint.h"
#include "scenes.h"

static test_scene scene;
static uint64_t seed = 1;

/* A meshlet is whole if its facets are all connected with its first. Its links are the meshlets
   that its sides lead to, each once, and LRCS_NONE if some side leads to no facet. */
static void check_links(const lrcs_prepared *p, uint32_t m)
{
    const lrcsi_meshlets *meshlets = &p->meshlets;
    uint32_t count = p->scene->facet_count;
    uint32_t met = 0; /* links that some side leads to */
    int whole = 1;
    for (uint32_t f = m * LRCSI_MESHLET_FACETS;
         f < lrcsi_meshlet_end(m * LRCSI_MESHLET_FACETS, count); f++) {
        whole &= meshlets->first[f] == 0;
    }
    assert_int_equal(meshlets->whole[m], whole);
    for (uint32_t i = meshlets->first_link[m]; i < meshlets->first_link[m + 1]; i++) {
        uint32_t sides = 0;
        for (uint32_t k = meshlets->meshlet[m].first_side; k < meshlets->meshlet[m + 1].first_side;
             k++) {
            uint32_t other = meshlets->side[k].other;
            sides +=
                (other == count ? LRCS_NONE : other / LRCSI_MESHLET_FACETS) == meshlets->link[i];
        }
        assert_true(sides > 0);
        met += sides;
    }
    assert_int_equal(met, meshlets->meshlet[m + 1].first_side - meshlets->meshlet[m].first_side);
}

/* Every side that has a facet across leads within the meshlet, or is listed from one facet or the
   other; what is connected so is connected in the scene. */
static void check_meshlets(void)
{
    static uint32_t all[SCENE_FACETS];
    static uint32_t by_meshlets[SCENE_FACETS];
    lrcs_work work;
    const lrcs_prepared *p = scene_prepare(&scene, &work);
    const lrcsi_meshlets *meshlets = &p->meshlets;
    uint32_t count = p->scene->facet_count;
    assert_int_equal(meshlets->count, (count + LRCSI_MESHLET_FACETS - 1) / LRCSI_MESHLET_FACETS);
    for (uint32_t f = 0; f < count; f++) {
        all[f] = f;
    }
    for (uint32_t f = 0; f < count; f++) {
        const lrcsi_meshlet *meshlet = &meshlets->meshlet[f / LRCSI_MESHLET_FACETS];
        by_meshlets[f] = f / LRCSI_MESHLET_FACETS * LRCSI_MESHLET_FACETS + meshlets->first[f];
        assert_true(by_meshlets[f] <= f);
        for (int k = 0; k < 3; k++) {
            uint32_t other = p->neighbours.facet[f].corner[k];
            if (other < count) {
                lrcsi_disjoint_union(all, f, other);
            }
            for (int i = 0; i < 3; i++) {
                double x = lrcsi_prepared_corner(p, f, k)[i];
                assert_true(meshlet->low[i] <= x && x <= meshlet->high[i]);
            }
        }
    }
    for (uint32_t i = 0; i < meshlets->meshlet[meshlets->count].first_side; i++) {
        const lrcsi_meshlet_side *side = &meshlets->side[i];
        const uint32_t *edge = p->topology.facet_edge[side->facet].corner;
        const uint32_t *across = p->neighbours.facet[side->facet].corner;
        int found = 0;
        for (int k = 0; k < 3; k++) {
            found |= edge[k] == side->edge && across[k] == side->other;
        }
        assert_true(found);
        assert_true(side->other == count ||
                    side->other / LRCSI_MESHLET_FACETS != side->facet / LRCSI_MESHLET_FACETS);
        if (side->other < count) {
            lrcsi_disjoint_union(by_meshlets, side->facet, side->other);
        }
    }
    for (uint32_t f = 0; f < count; f++) {
        assert_int_equal(lrcsi_disjoint_root(all, f), lrcsi_disjoint_root(by_meshlets, f));
    }
    for (uint32_t m = 0; m < meshlets->count; m++) {
        check_links(p, m);
    }
}

static void runs_connect_what_edges_connect(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, 12);
    check_meshlets();
    scene_box(&scene, (const double[3]){3, -1, -1}, (const double[3]){4, 1, 1});
    check_meshlets();
    for (uint32_t f = scene.scene.facet_count; f > 1; f--) { /* shuffled */
        uint32_t other = (uint32_t)random_below(&seed, f);
        lrcs_facet swap = scene.facet[f - 1];
        scene.facet[f - 1] = scene.facet[other];
        scene.facet[other] = swap;
    }
    check_meshlets();
}

static void single_facets_are_runs(void **state)
{
    (void)state;
    for (uint32_t n = 1; n < 40; n++) {
        scene_start(&scene);
        for (uint32_t i = 0; i < n; i++) {
            scene_triangle(&scene, (const double[3]){3.0 * i, 0, 0},
                           (const double[3]){3.0 * i + 1, 0, 0},
                           (const double[3]){3.0 * i, 1, 0.5 * i});
        }
        check_meshlets();
    }
}

/* The sign of a meshlet is that of all its facets, or LRCSI_MESHLET_MIXED. */
static void signs_of_meshlets_are_those_of_their_facets(void **state)
{
    (void)state;
    static unsigned char memory[4096];
    for (uint32_t count = 1; count < 70; count++) {
        lrcs_work some = lrcs_work_make(memory, sizeof memory);
        lrcsi_facet_signs signs;
        lrcsi_facet_signs copy;
        memset(memory, 1, sizeof memory);
        assert_true(lrcsi_facet_signs_take(count, &some, &signs));
        assert_true(lrcsi_facet_signs_take(count, &some, &copy));
        for (uint32_t f = 0; f < count; f++) {
            int alike = f / LRCSI_MESHLET_FACETS != 1;
            signs.facet[f] =
                (signed char)(alike ? (int)(count % 3) - 1 : (int)random_below(&seed, 3) - 1);
        }
        lrcsi_facet_signs_finish(count, &signs);
        lrcsi_facet_signs_copy(count, &signs, &copy);
        size_t room = lrcsi_meshlets_room(count);
        assert_memory_equal(copy.facet, signs.facet, room + 1);
        for (uint32_t f = count; f <= room; f++) {
            assert_int_equal(signs.facet[f], 0);
        }
        for (uint32_t m = 0; m < lrcsi_meshlets_count(count); m++) {
            const signed char *own = signs.facet + (size_t)m * LRCSI_MESHLET_FACETS;
            int alike = 1;
            for (uint32_t i = 1; i < LRCSI_MESHLET_FACETS; i++) {
                alike &= own[i] == own[0];
            }
            assert_int_equal(signs.meshlet[m], alike ? own[0] : LRCSI_MESHLET_MIXED);
            assert_int_equal(copy.meshlet[m], signs.meshlet[m]);
        }
        lrcsi_facet_signs_clear(&copy, count - 1);
        assert_int_equal(copy.facet[count - 1], 0);
        assert_int_equal(copy.meshlet[(count - 1) / LRCSI_MESHLET_FACETS], LRCSI_MESHLET_MIXED);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(runs_connect_what_edges_connect),
        cmocka_unit_test(single_facets_are_runs),
        cmocka_unit_test(signs_of_meshlets_are_those_of_their_facets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
