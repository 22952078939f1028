/* SPDX-License-Identifier: MIT */
/* Facets in the same place: one is seen, as the tie is decided, and the others cost nothing. */
#include "scene/copy.h"

#include "scenes.h"
#include "visibility/grid.h"

static test_scene scene;

/* The triangle 0 0 0, 1 0 0, 0 1 0, its corners turned round, on vertices of its own. */
static uint32_t add_copy(uint32_t turn, int back)
{
    static const double corner[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    uint32_t f =
        scene_triangle(&scene, corner[turn % 3], corner[(turn + 1) % 3], corner[(turn + 2) % 3]);
    if (back) {
        scene_invert(&scene, f);
    }
    return f;
}

/* Two materials that differ, the second of two sides; copies of either, either way round. */
static void random_copies(uint64_t *seed, uint32_t count)
{
    scene_start(&scene);
    scene_material(&scene, 1, 0.5, 0.3, 1);
    scene_material(&scene, 0, 0.7, 0.2, 2)->two_sided = 1;
    scene_material(&scene, 3, 1, 0.2, 2)->omitted = 1;
    for (uint32_t i = 0; i < count; i++) {
        scene.wears = scene_random(seed, 4);
        add_copy(scene_random(seed, 3), (int)scene_random(seed, 2));
    }
}

/* Which of them is seen from z > 0 (side 1) or z < 0 (-1): a front, else a back that reflects, else
   any; of equals the first. LRCS_NONE: all are omitted. */
static uint32_t who_is_seen(int side)
{
    uint32_t best = LRCS_NONE;
    int rank = 0;
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        const lrcs_material *material = &scene.material[scene.material_of[f]];
        const lrcs_point *v = scene.vertex;
        const uint32_t *c = scene.facet[f].corner;
        double up = (v[c[1]].x[0] - v[c[0]].x[0]) * (v[c[2]].x[1] - v[c[0]].x[1]) -
                    (v[c[1]].x[1] - v[c[0]].x[1]) * (v[c[2]].x[0] - v[c[0]].x[0]);
        int of_f = up * side > 0 ? 3 : material->two_sided ? 2 : 1;
        if (!material->omitted && of_f > rank) {
            rank = of_f;
            best = f;
        }
    }
    return best;
}

static void one_is_seen_as_the_tie_is_decided_by_every_method(void **state)
{
    (void)state;
    static const int methods[] = {LRCS_METHOD_AUTO, LRCS_METHOD_ZBUFFER, LRCS_METHOD_EXACT};
    uint64_t seed = 5;
    for (uint32_t i = 0; i < 600; i++) {
        random_copies(&seed, 1 + i % 9);
        int side = i % 2 ? 1 : -1;
        uint32_t seen = who_is_seen(side);
        lrcs_result r = scene_run(&scene, (const double[3]){0, 0, side}, methods[i % 3], 16);
        for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
            check_abs(scene.record[f].visible_area_m2, f == seen ? 0.5 : 0, 1e-14);
            check_abs(scene.record[f].sigma_m2, f == seen ? r.sigma_m2 : 0, 1e-14);
        }
        check_abs(r.projected_area_m2, seen == LRCS_NONE ? 0 : 0.5, 1e-14);
        if (r.method == LRCS_METHOD_EXACT) { /* pixels are left unsure of what is hidden */
            check_most(r.bound_m2, 1e-9 * (r.sigma_m2 + 1e-6));
        }
    }
}

static void copies_are_recorded_as_hidden_facets(void **state)
{
    (void)state;
    scene_start(&scene);
    for (uint32_t i = 0; i < 100; i++) {
        add_copy(i, 0);
    }
    lrcs_result r = scene_run(&scene, (const double[3]){0, 0, 1}, LRCS_METHOD_EXACT, 0);
    assert_int_equal(r.facets_front, 100);
    assert_int_equal(r.facets_hidden, 99);
    for (uint32_t f = 0; f < 100; f++) {
        check_same(scene.record[f].area_m2, 0.5);
        check_same(scene.record[f].cos_theta, 1);
    }
}

/* Symptom: a thousand facets in one place took seconds, ten thousand hours: each met all others.
   What meets, hides and is asked for is now four of them at most. */
static void any_number_of_copies_is_the_work_of_four(void **state)
{
    (void)state;
    uint64_t seed = 7;
    random_copies(&seed, 2000);
    lrcs_work work;
    lrcs_pose pose;
    lrcsi_view view;
    const lrcs_prepared *p = scene_prepare(&scene, &work);
    uint32_t most = p->touches.first[scene.scene.facet_count];
    assert_true(most > 0 && most <= 12); /* four, each with three others */
    assert_int_equal(lrcs_pose_from_direction((const double[3]){0.1, 0.2, 1}, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(p, &pose, &work, &view), LRCS_OK);
    view.backs_cast = 1;
    uint32_t cast = 0;
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        cast += lrcsi_grid_casts(&view, f) != 0;
    }
    assert_true(cast >= 2 && cast <= 4);
}

/* A sphere's facets and a mesh's in one place: the true sphere bulges, and may hide the mesh. */
static void facets_of_curved_shapes_are_no_copies(void **state)
{
    (void)state;
    for (int reach = 0; reach < 2; reach++) {
        lrcs_work work;
        scene_start(&scene);
        scene.part.reach = 0.01 * reach;
        add_copy(0, 0);
        add_copy(1, 0);
        const lrcs_prepared *p = scene_prepare(&scene, &work);
        assert_int_equal(p->idle[0], 0);
        assert_int_equal(p->idle[1], !reach);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_is_seen_as_the_tie_is_decided_by_every_method),
        cmocka_unit_test(copies_are_recorded_as_hidden_facets),
        cmocka_unit_test(any_number_of_copies_is_the_work_of_four),
        cmocka_unit_test(facets_of_curved_shapes_are_no_copies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
