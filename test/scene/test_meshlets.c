/* SPDX-License-Identifier: MIT */
/* Meshlets of facets: their boxes, what is connected within one, and the sides that leave it. */
#include "scene/prepare.h"

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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(runs_connect_what_edges_connect),
        cmocka_unit_test(single_facets_are_runs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
