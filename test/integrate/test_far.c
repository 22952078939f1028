/* SPDX-License-Identifier: MIT */
/* Bodies of which a vertex is far away, or that carry a mast many times as long as they are. What
   stands on it reflects nothing here, so that sigma and its bound are those of the rest: they, and
   the steps that a run takes, are what they are without it. (With exact answers: test_hostile.c and
   make bounds.) */
#include "scenes.h"
#include "visibility/index/grid.h"

static test_scene scene;
static lrcs_facet_record before[SCENE_FACETS];

static const double views[][3] = {
    {0, 0, 1}, {0.1, 0.2, 1}, {0.7, 0.5, 0.6}, {-0.3, 0.8, -0.2}, {1, 1e-3, 0.05}};
#define VIEWS (sizeof views / sizeof *views)

/* A ball between two wings, and a bus below it: much of it is shadowed in part. */
static void body(void)
{
    scene_start(&scene);
    scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, 32);
    scene_box(&scene, (const double[3]){-0.8, -0.7, -2.5}, (const double[3]){0.9, 0.75, -1.25});
    scene_plate(&scene, (const double[3]){-0.5, 0.6, 1.25}, (const double[3]){1.1, 0, 0.1},
                (const double[3]){0, 2.5, 0.2});
    scene_plate(&scene, (const double[3]){-0.5, -3, 0.75}, (const double[3]){1, 0, 0},
                (const double[3]){0, 2.3, 0.3});
}

static void dull_from_here(void)
{
    scene_material(&scene, 0, 0, 0.2, 0)->two_sided = 1;
}

/* A sail from the outer edge of the first wing to a point out there, which covers nothing. */
static void sail(double far)
{
    dull_from_here();
    scene_triangle(&scene, (const double[3]){-0.5, 3.1, 1.45}, (const double[3]){0.6, 3.1, 1.55},
                   (const double[3]){0.125 * far, far, -0.0625 * far});
}

static lrcs_result exact(const double direction[3])
{
    return scene_run(&scene, direction, LRCS_METHOD_EXACT, 0);
}

static void keep(void)
{
    memcpy(before, scene.record, sizeof before);
}

/* The facets that reflect show what they showed. */
static void check_kept(uint32_t count)
{
    for (uint32_t f = 0; f < count; f++) {
        double whole = before[f].area_m2 * fabs(before[f].cos_theta);
        if (scene.material_of[f] == 0) {
            check_abs(scene.record[f].visible_area_m2, before[f].visible_area_m2,
                      1e-12 * whole + 4e-15);
        }
    }
}

static void a_far_vertex_neither_slows_nor_blurs_the_rest(void **state)
{
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        body();
        uint32_t count = scene.scene.facet_count;
        sail(8);
        lrcs_result near = exact(views[i]);
        assert_true(near.facets_partial > 10);
        keep();
        for (double far = 64; far < 1e60; far *= 1e3) {
            body();
            sail(far);
            lrcs_result r = exact(views[i]);
            check_kept(count);
            check_abs(r.sigma_m2, near.sigma_m2, r.bound_m2 + near.bound_m2);
            check_most(r.bound_m2, 1.25 * near.bound_m2);
            check_most((double)r.steps, 1.6 * (double)near.steps);
        }
    }
}

/* In directions all around: some shadow much of the body. Facets that a far spike crosses in the
   view are clipped one by one, at most 160 steps for each facet of the scene. Bounds are compared
   with those of spikes that end just outside of the body, where the cells of blocks serve. */
static void several_far_vertices_take_few_steps(void **state)
{
    (void)state;
    for (size_t i = 0; i < VIEWS; i++) {
        lrcs_result r[2];
        for (int far = 0; far < 2; far++) {
            body();
            dull_from_here();
            for (int n = 0; n < 6; n++) {
                double to[3] = {0.3 * n - 1, 1 - 0.25 * n, n % 2 ? 0.8 : -0.9};
                for (int k = 0; k < 3; k++) {
                    to[k] *= far ? pow(10, 3 + 4 * n) : 16;
                }
                scene_triangle(&scene, (const double[3]){0.2 * n, -1, 2},
                               (const double[3]){0.2 * n + 0.1, -1, 2.1}, to);
            }
            r[far] = exact(views[i]);
        }
        check_most((double)r[1].steps, 160.0 * scene.scene.facet_count);
        check_most(r[1].bound_m2, 8 * r[0].bound_m2);
    }
}

/* Far facets behind all of the body are as good as absent. */
static void what_is_far_and_behind_leaves_the_rest_as_it_is(void **state)
{
    (void)state;
    for (size_t i = 0; i < 2; i++) {
        lrcs_result near = {0};
        body();
        uint32_t count = scene.scene.facet_count;
        lrcs_result without = exact(views[i]);
        keep();
        for (double far = 64; far < 1e40; far *= 1e6) {
            body();
            dull_from_here();
            scene_triangle(&scene, (const double[3]){-3, -1, -9}, (const double[3]){3, -1, -9},
                           (const double[3]){0.01 * far, far, -0.1 * far});
            scene_triangle(&scene, (const double[3]){-far, -1, -far},
                           (const double[3]){far, -1, -far}, (const double[3]){0, 1, -9});
            lrcs_result r = exact(views[i]);
            near = far == 64 ? r : near;
            check_kept(count);
            check_abs(r.sigma_m2, without.sigma_m2, r.bound_m2 + without.bound_m2);
            check_most(r.bound_m2, 1.25 * without.bound_m2);
            check_most((double)r.steps, 4 * (double)near.steps); /* of the far facets themselves */
        }
    }
}

/* A mast of 4000 m from the bus through a wing: what it crosses in the view is parted as sharply as
   by one of 40 m, but for thin cells, which its diagonals make a hundred times as thin. */
static void a_mast_neither_slows_nor_blurs_the_rest(void **state)
{
    (void)state;
    for (size_t i = 0; i < VIEWS; i++) {
        lrcs_result r[2];
        for (int n = 0; n < 2; n++) {
            body();
            dull_from_here();
            scene_box(&scene, (const double[3]){0.2, 1.5, -1.5},
                      (const double[3]){0.23, 1.53, n == 0 ? 40 : 4000});
            r[n] = exact(views[i]);
        }
        check_most(r[1].bound_m2, 8 * r[0].bound_m2);
        /* the box of each side of it that is seen may hold all that the grid lists */
        double lists = 4.0 * LRCSI_GRID_FACET_BUCKETS * scene.scene.facet_count;
        check_most((double)r[1].steps, 1.5 * (double)r[0].steps + lists);
    }
}

/* By powers of two exactly, and moved to within what the bounds say. */
static void far_scenes_scale_and_move(void **state)
{
    (void)state;
    body();
    sail(3e17);
    lrcs_result r = exact(views[2]);
    for (int power = -40; power <= 60; power += 20) {
        scene_move(&scene, ldexp(1, power), (const double[3]){0, 0, 0});
        lrcs_result scaled = exact(views[2]);
        scene_move(&scene, ldexp(1, -power), (const double[3]){0, 0, 0});
        check_same(scaled.sigma_m2, ldexp(r.sigma_m2, 2 * power));
        check_same(scaled.bound_m2, ldexp(r.bound_m2, 2 * power));
        assert_int_equal(scaled.steps, r.steps);
    }
    scene_move(&scene, 1, (const double[3]){1e6, -1e6, 2e6});
    lrcs_result moved = exact(views[2]);
    scene_move(&scene, 1, (const double[3]){-1e6, 1e6, -2e6});
    check_abs(moved.sigma_m2, r.sigma_m2, 1e-8 * r.sigma_m2); /* coordinates are rounded to 2e-10 */
    check_most(moved.bound_m2, 100 * r.bound_m2 + 1e-9);
    check_most((double)moved.steps, 1.5 * (double)r.steps);
}

/* A raster of a window that reaches so far is coarse; its bound says so. */
static void rasters_of_far_scenes_keep_their_bounds(void **state)
{
    (void)state;
    for (size_t i = 0; i < VIEWS; i++) {
        for (double far = 10; far < 1e24; far *= 1e4) {
            body();
            sail(far);
            lrcs_result r = exact(views[i]);
            for (uint32_t size = 16; size <= 256; size *= 4) {
                lrcs_result z = scene_run(&scene, views[i], LRCS_METHOD_ZBUFFER, size);
                check_abs(z.sigma_m2, r.sigma_m2, z.bound_m2 + r.bound_m2);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_far_vertex_neither_slows_nor_blurs_the_rest),
        cmocka_unit_test(several_far_vertices_take_few_steps),
        cmocka_unit_test(what_is_far_and_behind_leaves_the_rest_as_it_is),
        cmocka_unit_test(a_mast_neither_slows_nor_blurs_the_rest),
        cmocka_unit_test(far_scenes_scale_and_move),
        cmocka_unit_test(rasters_of_far_scenes_keep_their_bounds)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
