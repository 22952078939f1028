/* SPDX-License-Identifier: MIT */
/* The box around most vertices: that around all of them in ordinary scenes, and in others without
   what is far away. */
#include "scene/bulk.h"

#include "scenes.h"

static test_scene scene;
static lrcs_work work;

static const lrcs_prepared *prepare(void)
{
    return scene_prepare(&scene, &work);
}

static void check_all(void)
{
    const lrcs_prepared *p = prepare();
    double most = 0;
    for (int k = 0; k < 3; k++) {
        check_same(p->origin[k], p->centre[k]);
        most = fmax(most, p->bulk[k]);
    }
    check_same(most, p->radius);
}

static void ordinary_scenes_have_the_box_of_all(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){2, 0, 0},
                   (const double[3]){0, 3, 0});
    check_all();
    scene_start(&scene);
    scene_box(&scene, (const double[3]){-1, -1, -1}, (const double[3]){1, 1, 30});
    check_all();
    scene_start(&scene);
    scene_sphere(&scene, (const double[3]){5, 6, 7}, 3, 40);
    check_all();
    scene_plate(&scene, (const double[3]){5, 8, 7}, (const double[3]){1, 0, 0},
                (const double[3]){0, 4, 0});
    check_all();
}

/* Neither of two bodies is the bulk, however far they are from each other. */
static void of_two_bodies_both_count(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, 20);
    scene_sphere(&scene, (const double[3]){1e6, 0, 0}, 1, 20);
    check_all();
}

/* The ball of radius 1 at (5, 6, 7), whatever stands far off; in few vertices and in many. */
static void what_is_far_is_left_out(void **state)
{
    (void)state;
    for (uint32_t n = 6; n <= 80; n += 37) {
        for (double far = 1e3; far < 1e60; far *= 1e9) {
            scene_start(&scene);
            scene_sphere(&scene, (const double[3]){5, 6, 7}, 1, n);
            scene_triangle(&scene, (const double[3]){5, 6, 8}, (const double[3]){5, 6.5, 8},
                           (const double[3]){far, -far, far});
            const lrcs_prepared *p = prepare();
            double metre = ldexp(1, -p->exponent);
            for (int k = 0; k < 3; k++) {
                check_abs(p->origin[k], (5 + k) * metre, 0.5 * metre);
                check_most(p->bulk[k], 1.5 * metre);
                check_most(0.5 * metre, p->bulk[k]);
            }
        }
    }
}

/* A mast of some facets, fifty times as long as the body. */
static void a_mast_is_left_out(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, 20);
    for (int i = 1; i < 4; i++) {
        scene_box(&scene, (const double[3]){0, 0, 25 * (i - 1)},
                  (const double[3]){0.1, 0.1, 25 * i});
    }
    const lrcs_prepared *p = prepare();
    check_most(p->bulk[2], ldexp(2.5, -p->exponent));
    check_most(ldexp(20, -p->exponent), p->radius);
}

static void scenes_without_facets_have_none(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_vertex(&scene, 1e9, 0, 0);
    const lrcs_prepared *p = prepare();
    for (int k = 0; k < 3; k++) {
        check_same(p->bulk[k], 0);
        check_same(p->origin[k], 0);
    }
}

/* One triangle stored many times, each with a first corner of its own: most vertices are in one
   place, and the box is that of the triangle. */
static void copies_of_one_vertex_are_no_bulk(void **state)
{
    (void)state;
    scene_start(&scene);
    uint32_t a = scene_vertex(&scene, 2, 0, 0);
    uint32_t b = scene_vertex(&scene, 0, 3, 0);
    for (int i = 0; i < 40; i++) {
        scene_facet(&scene, scene_vertex(&scene, 0, 0, 0), a, b);
    }
    check_all();
    lrcs_result r = scene_run(&scene, (const double[3]){0, 0, 1}, LRCS_METHOD_AUTO, 0);
    check_abs(r.sigma_m2, (double)scene_eq2(&scene.material[0].brdf, 3, 1), r.bound_m2 + 1e-14);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(copies_of_one_vertex_are_no_bulk),
                                       cmocka_unit_test(ordinary_scenes_have_the_box_of_all),
                                       cmocka_unit_test(of_two_bodies_both_count),
                                       cmocka_unit_test(what_is_far_is_left_out),
                                       cmocka_unit_test(a_mast_is_left_out),
                                       cmocka_unit_test(scenes_without_facets_have_none)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
