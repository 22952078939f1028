/* SPDX-License-Identifier: MIT */
/* What must not change sigma, or must change it in a known way: moving, scaling, turning the scene
   with the laser, shuffling, splitting and doubling facets; methods against each other; areas
   against silhouettes. On one satellite; test_random.c has random scenes, test_mean.c the mean over
   all attitudes. */
#include "scenes.h"

static test_scene scene;
static const int methods[] = {LRCS_METHOD_FACET, LRCS_METHOD_ZBUFFER, LRCS_METHOD_EXACT,
                              LRCS_METHOD_AUTO};
static const double directions[][3] = {{0, 0, 1},      {1, 0, 0},       {1, 1, 1},
                                       {0.3, -0.5, 1}, {-2, 0.125, -1}, {0.5, 3, 0.01}};
#define DIRECTIONS (sizeof directions / sizeof *directions)

/* A bus, two arrays, a ball through the bus and a strut that pierces an array; coordinates are
   multiples of 2^-12. */
static void satellite(void)
{
    scene_start(&scene);
    scene_box(&scene, (const double[3]){-0.5, -0.5, -0.5}, (const double[3]){0.5, 0.5, 0.75});
    scene_sphere(&scene, (const double[3]){0, 0.25, 0.625}, 0.5, 12);
    scene_material(&scene, 2, 0.125, 0.5, 1);
    scene_box(&scene, (const double[3]){-2, -0.0625, -0.25}, (const double[3]){2, 0.0625, 0.25});
    scene_material(&scene, 0.5, 0.25, 0.3, 3)->two_sided = 1;
    for (int side = -1; side <= 1; side += 2) {
        scene_plate(&scene, (const double[3]){side * 1.625 - 1, -0.5, 0.0625},
                    (const double[3]){2, 0, 0.25}, (const double[3]){0, 1, 0.125});
    }
    for (uint32_t v = 0; v < scene.scene.vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            scene.vertex[v].x[k] = nearbyint(scene.vertex[v].x[k] * 4096) / 4096;
        }
    }
}

static lrcs_result seen(size_t direction, int method)
{
    return scene_run(&scene, directions[direction], method,
                     method == LRCS_METHOD_ZBUFFER ? 128 : 0);
}

static void moving_by_a_thousand_kilometres_stays_within_bounds(void **state)
{
    (void)state;
    for (size_t i = 0; i < DIRECTIONS; i++) {
        for (int k = 1; k < 4; k++) {
            satellite();
            lrcs_result here = seen(i, methods[k]);
            scene_move(&scene, 1, (const double[3]){0x1p20, -0x1p19, 0x1.8p20});
            lrcs_result there = seen(i, methods[k]);
            check_abs(there.sigma_m2, here.sigma_m2, here.bound_m2 + there.bound_m2);
            check_rel(there.projected_area_m2, here.projected_area_m2,
                      methods[k] == LRCS_METHOD_ZBUFFER ? 1e-2 : 1e-8);
            if (methods[k] == LRCS_METHOD_EXACT) {
                check_most(there.bound_m2, 1e-6 * there.sigma_m2);
            }
        }
    }
}

static void scaling_by_a_power_of_two_is_exact(void **state)
{
    (void)state;
    static const int power[] = {1, -1, 40, -40, 300, -300};
    for (size_t i = 0; i < DIRECTIONS; i++) {
        for (int k = 0; k < 4; k++) {
            satellite();
            lrcs_result one = seen(i, methods[k]);
            for (int p = 0; p < 6; p++) {
                satellite();
                scene_move(&scene, ldexp(1, power[p]), (const double[3]){0, 0, 0});
                lrcs_result r = seen(i, methods[k]);
                double square = ldexp(1, 2 * power[p]);
                check_same(r.sigma_m2, one.sigma_m2 * square);
                check_same(r.sigma_glint_m2, one.sigma_glint_m2 * square);
                check_same(r.sigma_diffuse_m2, one.sigma_diffuse_m2 * square);
                check_same(r.bound_m2, one.bound_m2 * square);
                check_same(r.projected_area_m2, one.projected_area_m2 * square);
                assert_int_equal(r.facets_hidden, one.facets_hidden);
            }
        }
    }
}

static void scaling_by_a_million_is_good_to_rounding(void **state)
{
    (void)state;
    static const double factor[] = {1e6, 1e-6};
    for (size_t i = 0; i < DIRECTIONS; i++) {
        for (int p = 0; p < 2; p++) {
            satellite();
            lrcs_result one = seen(i, LRCS_METHOD_EXACT);
            scene_move(&scene, factor[p], (const double[3]){0, 0, 0});
            lrcs_result r = seen(i, LRCS_METHOD_EXACT);
            check_rel(r.sigma_m2 / factor[p] / factor[p], one.sigma_m2, 1e-12);
            check_most(r.bound_m2, 1e-9 * r.sigma_m2);
        }
    }
}

static void shuffled_facets_give_the_same_sum(void **state)
{
    (void)state;
    for (size_t i = 0; i < DIRECTIONS; i++) {
        for (int k = 0; k < 4; k++) {
            satellite();
            lrcs_result one = seen(i, methods[k]);
            for (uint64_t seed = 1; seed < 4; seed++) {
                scene_shuffle(&scene, seed);
                lrcs_result r = seen(i, methods[k]);
                check_rel(r.sigma_m2, one.sigma_m2, 1e-14);
                check_most(r.bound_m2, 2 * one.bound_m2);
            }
        }
    }
}

/* x = R x, rounded. */
static void turn(double R[3][3], const double from[3], double to[3])
{
    double x[3] = {from[0], from[1], from[2]};
    for (int k = 0; k < 3; k++) {
        to[k] = R[k][0] * x[0] + R[k][1] * x[1] + R[k][2] * x[2];
    }
}

static void turning_scene_and_laser_together_changes_nothing(void **state)
{
    (void)state;
    static const double angles[4][3] = {{90, 0, 0}, {180, 90, 0}, {31, -77, 12}, {1e-5, 45, 120}};
    for (size_t i = 0; i < DIRECTIONS; i++) {
        satellite();
        lrcs_result one = seen(i, LRCS_METHOD_EXACT);
        for (int a = 0; a < 4; a++) {
            lrcs_pose pose;
            double d[3];
            assert_int_equal(lrcs_pose_from_euler("XYZ", angles[a], &pose), LRCS_OK);
            satellite();
            for (uint32_t v = 0; v < scene.scene.vertex_count; v++) {
                turn(pose.R, scene.vertex[v].x, scene.vertex[v].x);
            }
            turn(pose.R, directions[i], d);
            lrcs_result r = scene_run(&scene, d, LRCS_METHOD_EXACT, 0);
            check_abs(r.sigma_m2, one.sigma_m2, r.bound_m2 + one.bound_m2 + 1e-12 * one.sigma_m2);
            r = scene_run(&scene, d, LRCS_METHOD_ZBUFFER, 64);
            check_abs(r.sigma_m2, one.sigma_m2, r.bound_m2 + one.bound_m2 + 1e-12 * one.sigma_m2);
        }
    }
}

/* Every facet split in four at the middles of its sides, which doubles hold exactly here. */
static void splitting_facets_changes_nothing(void **state)
{
    (void)state;
    for (size_t i = 0; i < DIRECTIONS; i++) {
        for (int k = 1; k < 3; k++) {
            satellite();
            lrcs_result one = seen(i, methods[k]);
            uint32_t count = scene.scene.facet_count;
            for (uint32_t f = 0; f < count; f++) {
                uint32_t middle[3];
                lrcs_facet old = scene.facet[f];
                for (int c = 0; c < 3; c++) {
                    const double *a = scene.vertex[old.corner[c]].x;
                    const double *b = scene.vertex[old.corner[(c + 1) % 3]].x;
                    middle[c] = scene_vertex(&scene, 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]),
                                             0.5 * (a[2] + b[2]));
                }
                scene.assigned = scene.material_of[f];
                scene_facet(&scene, old.corner[0], middle[0], middle[2]);
                scene_facet(&scene, old.corner[1], middle[1], middle[0]);
                scene_facet(&scene, old.corner[2], middle[2], middle[1]);
                scene.facet[f] = (lrcs_facet){{middle[0], middle[1], middle[2]}};
            }
            lrcs_result r = seen(i, methods[k]);
            check_abs(r.sigma_m2, one.sigma_m2, r.bound_m2 + one.bound_m2);
            if (methods[k] == LRCS_METHOD_EXACT) {
                check_rel(r.sigma_m2, one.sigma_m2, 1e-13);
                check_rel(r.projected_area_m2, one.projected_area_m2, 1e-13);
            }
        }
    }
}

static void doubling_a_caster_changes_nothing(void **state)
{
    (void)state;
    for (size_t i = 0; i < DIRECTIONS; i++) {
        satellite();
        lrcs_result one = seen(i, LRCS_METHOD_EXACT);
        uint32_t count = scene.scene.facet_count;
        for (uint32_t f = 0; f < count; f += 3) {
            scene.assigned = scene.material_of[f];
            scene_facet(&scene, scene.facet[f].corner[1], scene.facet[f].corner[2],
                        scene.facet[f].corner[0]);
        }
        lrcs_result r = seen(i, LRCS_METHOD_EXACT);
        check_rel(r.sigma_m2, one.sigma_m2, 1e-13);
        check_rel(r.projected_area_m2, one.projected_area_m2, 1e-13);
        r = seen(i, LRCS_METHOD_ZBUFFER);
        check_abs(r.sigma_m2, one.sigma_m2, r.bound_m2 + one.bound_m2);
    }
}

/* Two boxes from (p, 0, q): silhouettes are rectangles of y by u = q x - p z, whose union is a sum
   of rectangles. */
static void visible_areas_add_up_to_the_silhouette(void **state)
{
    (void)state;
    static const double box[2][2][3] = {{{0, 0, 0}, {2, 3, 1}}, {{1, 1, 2}, {4, 2, 3}}};
    static const double slope[][2] = {{0, 1}, {1, 0}, {1, 1}, {-1, 2}, {3, 1}, {-2, 5}};
    scene_start(&scene);
    for (int b = 0; b < 2; b++) {
        scene_box(&scene, box[b][0], box[b][1]);
    }
    for (int i = 0; i < 6; i++) {
        double p = slope[i][0];
        double q = slope[i][1];
        double u[2][2];
        double area = 0;
        for (int b = 0; b < 2; b++) {
            u[b][0] = q * box[b][p > 0 ? 0 : 0][0] - (p > 0 ? p * box[b][1][2] : p * box[b][0][2]);
            u[b][1] = q * box[b][1][0] - (p > 0 ? p * box[b][0][2] : p * box[b][1][2]);
            area += (u[b][1] - u[b][0]) * (box[b][1][1] - box[b][0][1]);
        }
        double both = fmin(u[0][1], u[1][1]) - fmax(u[0][0], u[1][0]);
        area -= fmax(0, both) * 1; /* the second's y, 1 .. 2, lies within the first's */
        const double d[3] = {p, 0, q};
        lrcs_result r = scene_run(&scene, d, LRCS_METHOD_EXACT, 0);
        check_rel(r.projected_area_m2, area / hypot(p, q), 1e-13);
        check_most(r.back_side_area_m2, 1e-14);
    }
}

static void methods_agree_at_ten_resolutions(void **state)
{
    (void)state;
    static const uint32_t size[] = {1, 2, 5, 16, 33, 64, 100, 255, 256, 600};
    satellite();
    lrcs_work work;
    const lrcs_prepared *p = scene_prepare(&scene, &work);
    for (size_t i = 0; i < DIRECTIONS; i++) {
        lrcs_result exact = scene_pose(&scene, p, &work, directions[i], LRCS_METHOD_EXACT, 0);
        lrcs_result facet = scene_pose(&scene, p, &work, directions[i], LRCS_METHOD_FACET, 0);
        check_most(exact.bound_m2, 1e-9 * exact.sigma_m2);
        check_abs(facet.sigma_m2, exact.sigma_m2, facet.bound_m2 + exact.bound_m2);
        double widest = 0;
        for (int k = 0; k < 10; k++) {
            lrcs_result r =
                scene_pose(&scene, p, &work, directions[i], LRCS_METHOD_ZBUFFER, size[k]);
            check_abs(r.sigma_m2, exact.sigma_m2, r.bound_m2 + exact.bound_m2);
            widest = k == 0 ? r.bound_m2 : widest;
            check_most(r.bound_m2, widest * (1 + 1e-12));
        }
        lrcs_result r = scene_pose(&scene, p, &work, directions[i], LRCS_METHOD_AUTO, 0);
        check_abs(r.sigma_m2, exact.sigma_m2, r.bound_m2 + exact.bound_m2);
        check_most(r.bound_m2, 1e-4 * r.sigma_m2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moving_by_a_thousand_kilometres_stays_within_bounds),
        cmocka_unit_test(scaling_by_a_power_of_two_is_exact),
        cmocka_unit_test(scaling_by_a_million_is_good_to_rounding),
        cmocka_unit_test(shuffled_facets_give_the_same_sum),
        cmocka_unit_test(turning_scene_and_laser_together_changes_nothing),
        cmocka_unit_test(splitting_facets_changes_nothing),
        cmocka_unit_test(doubling_a_caster_changes_nothing),
        cmocka_unit_test(visible_areas_add_up_to_the_silhouette),
        cmocka_unit_test(methods_agree_at_ten_resolutions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
