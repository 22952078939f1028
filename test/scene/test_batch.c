/* SPDX-License-Identifier: MIT */
/* Facets by material: their order, their unit normals and areas within the errors declared, and
   what stands beyond the last. */
#include "scene/batch.h"

#include "scene/prepare.h"
#include "scenes.h"
#include "view/product.h"
#include "view/view.h"

static test_scene scene;
static lrcs_work work;

/* Triangles at random, slivers and tiny ones among them, of materials in no order. */
static const lrcs_prepared *random_scene(uint32_t facets)
{
    uint64_t seed = 77;
    scene_start(&scene);
    for (int i = 0; i < 4; i++) {
        scene_material(&scene, 1, 0.25, 0.2, i);
    }
    for (uint32_t i = 0; i < facets; i++) {
        double size = i % 5 == 0 ? 0x1p-240 : i % 5 == 1 ? 1e-9 : 1;
        double p[3][3];
        for (int k = 0; k < 9; k++) {
            p[k / 3][k % 3] = size * ((double)random_below(&seed, 1u << 30) - 0x1p29);
        }
        for (int k = 0; i % 7 == 0 && k < 3; k++) {
            p[2][k] = p[1][k] + 1e-10 * p[2][k];
        }
        for (int k = 0; i % 11 == 3 && k < 3; k++) {
            p[2][k] = p[1][k]; /* degenerate */
        }
        scene.assigned = random_below(&seed, scene.scene.material_count);
        scene_triangle(&scene, p[0], p[1], p[2]);
    }
    return scene_prepare(&scene, &work);
}

static void facets_stand_by_material_in_their_order(void **state)
{
    (void)state;
    const lrcs_prepared *p = random_scene(500);
    const lrcsi_batches *b = &p->batches;
    uint32_t met = 0;
    assert_int_equal(b->first[0], 0);
    assert_int_equal(b->first[p->scene->material_count], b->count);
    for (uint32_t m = 0; m < p->scene->material_count; m++) {
        for (uint32_t i = b->first[m]; i < b->first[m + 1]; i++) {
            assert_int_equal(p->scene->facet_material[b->facet[i]], m);
            assert_false(p->skip[b->facet[i]]);
            assert_true(i == b->first[m] || b->facet[i] > b->facet[i - 1]);
            met++;
        }
    }
    assert_int_equal(met, p->live);
    assert_true(p->live < 500 && p->live > 400);
}

static void normals_and_areas_are_within_their_errors(void **state)
{
    (void)state;
    need_wide_long_double();
    const lrcs_prepared *p = random_scene(2000);
    const lrcsi_batches *b = &p->batches;
    for (uint32_t i = 0; i < b->count; i++) {
        const lrcsi_normal *n = &p->normal[b->facet[i]];
        long double N[3];
        long double square = 0;
        for (int k = 0; k < 3; k++) {
            N[k] = (long double)n->high[k] + n->low[k];
            square += N[k] * N[k];
        }
        long double length = sqrtl(square);
        for (int k = 0; k < 3; k++) {
            double want = (double)(N[k] / length);
            check_abs(b->normal[k][i] - want, 0, (1.01 * 0x1p-53 + 0x1p-53) * fabs(want));
        }
        check_rel(b->area[i], (double)(length / 2), 3 * 0x1p-53 + 0x1p-53);
    }
}

/* The products of a ball's normals with any direction are in its range, and those of neighbouring
   facets that face alike are known to. */
static void balls_hold_their_normals(void **state)
{
    (void)state;
    uint64_t seed = 5;
    uint32_t decided = 0;
    uint32_t tried = 0;
    for (int sphere = 0; sphere < 2; sphere++) {
        const lrcs_prepared *p = random_scene(500);
        if (sphere) {
            scene_start(&scene);
            scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, 88);
            p = scene_prepare(&scene, &work);
        }
        const lrcsi_batches *b = &p->batches;
        for (int i = 0; i < 200; i++) {
            lrcs_pose pose;
            lrcsi_view view;
            lrcs_work after = work;
            const double d[3] = {(double)random_below(&seed, 2001) - 999.5,
                                 (double)random_below(&seed, 2001) - 1000,
                                 i % 2 ? 0 : (double)random_below(&seed, 2001) - 1000.5};
            assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
            assert_int_equal(lrcsi_view_make(p, &pose, &after, &view), LRCS_OK);
            uint32_t front = 0;
            for (uint32_t at = 0; at < b->count; at++) {
                double low;
                double high;
                double dot =
                    lrcsi_view_dot(b->normal[0][at], b->normal[1][at], b->normal[2][at], view.unit);
                lrcsi_view_dot_range(&b->ball[at / LRCSI_LANES], view.unit, &low, &high);
                assert_true(low <= dot && dot <= high);
                decided += low > 0 || high < 0;
                tried++;
                const lrcsi_normal *n = &p->normal[b->facet[at]];
                double product = lrcsi_product_dot(n->high, n->low, view.direction);
                if (fabs(product) > 1e-12 * n->length * view.length) {
                    assert_int_equal(view.facing[b->facet[at]], product > 0 ? 1 : -1);
                }
                front += view.facing[b->facet[at]] > 0;
            }
            assert_int_equal(front, view.front);
        }
        assert_true(!sphere || decided > tried / 5);
    }
}

static void beyond_the_last_there_are_zeros(void **state)
{
    (void)state;
    const lrcs_prepared *p = random_scene(70);
    const lrcsi_batches *b = &p->batches;
    for (uint32_t i = b->count; i < b->count + LRCSI_LANES; i++) {
        check_same(b->normal[0][i], 0);
        check_same(b->normal[1][i], 0);
        check_same(b->normal[2][i], 0);
        check_same(b->area[i], 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(facets_stand_by_material_in_their_order),
        cmocka_unit_test(normals_and_areas_are_within_their_errors),
        cmocka_unit_test(balls_hold_their_normals),
        cmocka_unit_test(beyond_the_last_there_are_zeros),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
