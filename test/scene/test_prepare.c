/* SPDX-License-Identifier: MIT */
/* What preparing makes of a scene: scaled coordinates, normals of slivers against exact integers,
   which facets take part, and what is refused. */
#include "scene/prepare.h"

#include "scenes.h"

static test_scene scene;
static lrcs_work work;

static void coordinates_are_scaled_by_a_power_of_two(void **state)
{
    (void)state;
    static const double factor[] = {1, 0.3, 1e100 / 3, 1e-90, 1e6};
    for (int i = 0; i < 5; i++) {
        double f = factor[i];
        scene_start(&scene);
        scene_triangle(&scene, (const double[3]){f, 0, 0}, (const double[3]){0, 3 * f, 0},
                       (const double[3]){0, -f, 2 * f});
        const lrcs_prepared *p = scene_prepare(&scene, &work);
        double most = 0;
        for (uint32_t v = 0; v < 3; v++) {
            for (int k = 0; k < 3; k++) {
                most = fmax(most, fabs(p->vertex[v].x[k]));
                check_same(ldexp(p->vertex[v].x[k], p->exponent), scene.vertex[v].x[k]);
            }
        }
        assert_true(most >= 0.5 && most < 1);
        /* (-f, 3 f, 0) x (-f, -f, 2 f) = (6, 2, 4) f^2, of length sqrt(56) f^2 */
        double area = lrcsi_prepared_area(p, 0.5 * p->normal[0].length);
        check_rel(area / f / f, 0.5 * sqrt(56), 1e-15);
    }
}

static void degenerate_and_omitted_facets_take_no_part(void **state)
{
    (void)state;
    scene_start(&scene);
    uint32_t a = scene_vertex(&scene, 0, 0, 0);
    uint32_t b = scene_vertex(&scene, 1, 2, 3);
    uint32_t c = scene_vertex(&scene, 3, 6, 9); /* on one line */
    uint32_t d = scene_vertex(&scene, 0, 1, 0);
    scene_facet(&scene, a, b, c);
    scene_facet(&scene, a, b, d);
    scene_facet(&scene, a, a, d);
    scene_material(&scene, 1, 1, 0.2, 0)->omitted = 1;
    scene_facet(&scene, a, d, c);
    const lrcs_prepared *p = scene_prepare(&scene, &work);
    assert_int_equal(p->live, 1);
    for (uint32_t f = 0; f < 4; f++) {
        assert_int_equal(p->skip[f], f != 1);
    }
    check_same(p->centre[0], ldexp(0.5, -p->exponent)); /* the omitted facet's corner is outside */
    check_same(p->centre[2], ldexp(1.5, -p->exponent));
    lrcs_result r = scene_run(&scene, (const double[3]){3, 0, -1}, LRCS_METHOD_AUTO, 0);
    assert_int_equal(r.facets_total, 4);
    for (uint32_t f = 0; f < 4; f++) {
        check_same(f == 1 ? 0 : scene.record[f].area_m2, 0);
        check_same(f == 1 ? 0 : scene.record[f].cos_theta, 0);
    }
    check_rel(scene.record[1].area_m2, 0.5 * sqrt(10), 1e-15); /* (1,2,3) x (0,1,0) = (-3,0,1) */
}

/* A facet of integers: b - a = k e, c - a = m e + w with small w, so that its normal k e x w is
   short beside its sides. */
static void sliver_of(uint64_t *seed, int64_t x[3][3])
{
    int64_t k = 1 + random_below(seed, 1 << 14);
    int64_t m = random_below(seed, 1 << 14);
    for (int i = 0; i < 3; i++) {
        int64_t e = (int64_t)random_below(seed, 1 << 12) - (1 << 11);
        x[0][i] = (int64_t)random_below(seed, 1 << 26) - (1 << 25);
        x[1][i] = x[0][i] + k * e;
        x[2][i] = x[0][i] + m * e + (int64_t)random_below(seed, 3) - 1;
    }
}

static void normals_of_slivers_agree_with_exact_integers(void **state)
{
    (void)state;
    uint64_t seed = 2;
    int slivers = 0;
    for (int n = 0; n < 2000; n++) {
        int64_t x[3][3];
        sliver_of(&seed, x);
        scene_start(&scene);
        for (int i = 0; i < 3; i++) {
            scene_vertex(&scene, (double)x[i][0], (double)x[i][1], (double)x[i][2]);
        }
        scene_facet(&scene, 0, 1, 2);
        const lrcs_prepared *p = scene_prepare(&scene, &work);
        const lrcsi_normal *normal = &p->normal[0];
        long double square = 0;
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3;
            int k = (i + 2) % 3;
            int64_t want = (x[1][j] - x[0][j]) * (x[2][k] - x[0][k]) -
                           (x[1][k] - x[0][k]) * (x[2][j] - x[0][j]);
            check_same(ldexp(normal->high[i], 2 * p->exponent) +
                           ldexp(normal->low[i], 2 * p->exponent),
                       (double)want); /* below 2^53: no rounding at all */
            square += (long double)want * (long double)want;
        }
        if (square > 0) {
            check_rel(ldexp(normal->length, 2 * p->exponent), (double)sqrtl(square), 4 * 0x1p-53);
            check_most(normal->error, 0x1p-90 * normal->length);
            slivers++;
        }
    }
    assert_true(slivers > 1500);
}

/* Symptom: the error of a sliver's normal was that of its sides, so that one of aspect 1e40 alone
   in the scene came out with the wrong incidence, outside its bound. */
static void sliver_of_aspect_1e80_keeps_its_incidence(void **state)
{
    (void)state;
    for (int power = 27; power <= 297; power += 27) {
        double e = ldexp(1, -power);
        scene_start(&scene);
        scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                       (const double[3]){0.5, e, 0});
        const double d[3] = {1, 2, 4};
        lrcs_result r = scene_run(&scene, d, LRCS_METHOD_EXACT, 0);
        check_bound(r, (double)scene_eq2(&scene.material[0].brdf, 0.5L * e, 16 / 21.0L));
        check_most(r.bound_m2, 1e-14 * r.sigma_m2);
    }
}

/* Symptom: the squares of the normal of a facet of 1e-81 of the scene underflowed. */
static void tiny_facet_in_a_large_scene_keeps_its_area(void **state)
{
    (void)state;
    for (int power = 100; power <= 290; power += 10) {
        double e = ldexp(1, -power);
        scene_start(&scene);
        scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){e, 0, 0},
                       (const double[3]){0, e, 0});
        scene_material(&scene, 0, 0, 0.2, 0);
        scene_triangle(&scene, (const double[3]){4, 0, -1}, (const double[3]){5, 0, -1},
                       (const double[3]){4, 1, -1});
        lrcs_result r = scene_run(&scene, (const double[3]){3, 4, 12}, LRCS_METHOD_EXACT, 0);
        check_bound(r, (double)scene_eq2(&scene.material[0].brdf, 0.5L * e * e, 144 / 169.0L));
        check_most(r.bound_m2, 1e-13 * r.sigma_m2);
    }
}

static int prepare_status(void)
{
    const lrcs_prepared *prepared = NULL;
    work = lrcs_work_make(scene_memory, sizeof scene_memory);
    int status = lrcs_prepare_run(&scene.scene, &work, &prepared);
    assert_true((status == LRCS_OK) == (prepared != NULL));
    assert_true(status == LRCS_OK || work.used == 0);
    return status;
}

static void prepare_refuses_scenes_that_build_never_makes(void **state)
{
    (void)state;
    static const double wrong[] = {NAN, INFINITY, -INFINITY, 1.0000001e100, -1e308};
    for (int i = 0; i < 5; i++) {
        scene_start(&scene);
        scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
        scene.vertex[7].x[i % 3] = wrong[i];
        assert_int_equal(prepare_status(), LRCS_E_NUMBER);
    }
    static const lrcs_brdf bad[] = {{-1, 0, 1, 0}, {0, -1, 1, 0},  {1, 1, -1, 0},      {1, 1, 0, 0},
                                    {1, 1, 1, -1}, {NAN, 1, 1, 1}, {1, 1, INFINITY, 1}};
    for (int i = 0; i < 7; i++) {
        scene_start(&scene);
        scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
        scene.material[0].brdf = bad[i];
        assert_int_equal(prepare_status(), LRCS_E_NUMBER);
    }
    for (int i = 0; i < 5; i++) {
        scene_start(&scene);
        scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
        if (i < 3) {
            scene.facet[11].corner[i] = 8;
        } else if (i == 3) {
            scene.material_of[4] = 1;
        } else {
            scene.part_of[11] = LRCS_NONE;
        }
        assert_int_equal(prepare_status(), LRCS_E_INDEX);
    }
    for (int i = 0; i < 3; i++) {
        lrcs_point normal[36] = {{{0, 0, 0}}};
        scene_start(&scene);
        scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
        scene.scene.corner_normal = normal;
        normal[35].x[2] = i == 0 ? 1.0 : i == 1 ? nextafter(-1, -2) : wrong[0];
        assert_int_equal(prepare_status(), i == 0 ? LRCS_OK : LRCS_E_NUMBER);
    }
    scene_start(&scene);
    scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1e100});
    assert_int_equal(prepare_status(), LRCS_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coordinates_are_scaled_by_a_power_of_two),
        cmocka_unit_test(degenerate_and_omitted_facets_take_no_part),
        cmocka_unit_test(normals_of_slivers_agree_with_exact_integers),
        cmocka_unit_test(sliver_of_aspect_1e80_keeps_its_incidence),
        cmocka_unit_test(tiny_facet_in_a_large_scene_keeps_its_area),
        cmocka_unit_test(prepare_refuses_scenes_that_build_never_makes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
