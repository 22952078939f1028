/* SPDX-License-Identifier: MIT */
/* Blocks of facets in plain doubles against mpmath: single facets, the error declared with each,
   its size, and what the other lanes hold. */
#include "optics/shade.h"

#include "check.h"
#include "scenes.h"
#include "view/view.h"

static const struct vector {
    double A, B, s, m, b[3], c[3], d[3], glint[2], diffuse[2];
} vectors[] = {
#include "vectors/shade.inc"
};

#define COUNT (sizeof vectors / sizeof vectors[0])
#define U     0x1p-53

static test_scene scene;
static unsigned char memory[1 << 20];

/* One triangle of the material's, prepared and seen. */
static lrcsi_view view_of(const struct vector *v)
{
    lrcs_work work = lrcs_work_make(memory, sizeof memory);
    const lrcs_prepared *prepared = NULL;
    lrcs_pose pose;
    lrcsi_view view;
    scene_start(&scene);
    scene_material(&scene, v->A, v->B, v->s, v->m);
    scene_triangle(&scene, (const double[3]){0, 0, 0}, v->b, v->c);
    assert_int_equal(lrcs_prepare_run(&scene.scene, &work, &prepared), LRCS_OK);
    assert_int_equal(lrcs_pose_from_direction(v->d, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_face(prepared, &pose, (lrcsi_view_backs){1, 1}, &work, &view),
                     LRCS_OK);
    return view;
}

/* n . d of the facet at a place of the batches. */
static double dot_at(const lrcsi_view *view, uint32_t place)
{
    double *const *n = view->prepared->batches.normal;
    return lrcsi_view_dot(n[0][place], n[1][place], n[2][place], view->unit);
}

/* The facet alone in one lane, others turned elsewhere. */
static void shade_lane(const lrcsi_view *view, const lrcsi_lobes *lobes, uint32_t lane,
                       lrcsi_shades *shades)
{
    static lrcsi_shade_normals normals;
    for (uint32_t i = 0; i < LRCSI_LANES; i++) {
        double tilted = 1 - 0.01 * i;
        for (int k = 0; k < 3; k++) {
            normals.x[k][i] =
                i == lane ? view->prepared->batches.normal[k][0] : tilted * view->unit[k];
        }
    }
    lrcsi_shade(lobes, view->unit, view->unit_low, &normals, shades);
}

static double off_from(double value, const double reference[2])
{
    return fabs((value - reference[0]) - reference[1]);
}

/* Both parts of S cos(theta) times what the packet gives, each alone and together, and how many
   facets packets serve. */
static void facets_stay_within_the_error_of_their_packet(void **state)
{
    (void)state;
    static lrcsi_shades shades;
    uint32_t served = 0;
    double worst = 0.0;
    for (size_t n = 0; n < COUNT; n++) {
        const struct vector *v = &vectors[n];
        lrcsi_view view = view_of(v);
        const lrcsi_batches *b = &view.prepared->batches;
        double dot = dot_at(&view, b->first[1]);
        for (int parts = 1; parts <= 3; parts++) {
            const lrcs_brdf brdf = {parts & 1 ? v->A : 0, parts & 2 ? v->B : 0, v->s, v->m};
            lrcsi_lobes lobes = lrcsi_lobes_make(&brdf, brdf.A > 0, brdf.B > 0);
            if (!(dot > lobes.low && dot < lobes.high)) {
                continue;
            }
            uint32_t lane = (uint32_t)n % LRCSI_LANES;
            shade_lane(&view, &lobes, lane, &shades);
            double area = lrcsi_prepared_area(view.prepared, b->area[0]) * shades.cosine[lane];
            double glint = shades.glint[lane] * area;
            double diffuse = shades.diffuse[lane] * area;
            double error = parts & 1 ? off_from(glint, v->glint) : glint;
            error += parts & 2 ? off_from(diffuse, v->diffuse) : diffuse;
            double bound = shades.error[lane] * LRCSI_SHADE_UNIT * area;
            check_most(error, bound + 0x1p-1070);
            worst = fmax(worst, bound > 0x1p-900 ? error / bound : 0.0);
            served += parts == 3;
        }
    }
    print_message("%u of %u served, worst error %.2f of its bound\n", (unsigned)served,
                  (unsigned)COUNT, worst);
    assert_true(served > COUNT / 2 && worst > 0.05);
}

/* Whether a packet serves the facet or not. */
static void sigma_stays_within_its_bound_at_every_incidence(void **state)
{
    (void)state;
    for (size_t n = 0; n < COUNT; n++) {
        const struct vector *v = &vectors[n];
        scene_start(&scene);
        scene_material(&scene, v->A, v->B, v->s, v->m);
        scene_triangle(&scene, (const double[3]){0, 0, 0}, v->b, v->c);
        lrcs_result r = scene_run(&scene, v->d, LRCS_METHOD_EXACT, 0);
        check_most(off_from(r.sigma_glint_m2, v->glint) + off_from(r.sigma_diffuse_m2, v->diffuse),
                   r.budget.rounding_m2 + 0x1p-1070);
    }
}

/* Ordinary slopes, bright: what double-double incidence came to is 50 to 100 units. */
static void bounds_of_ordinary_materials_are_small(void **state)
{
    (void)state;
    static lrcsi_shades shades;
    for (size_t n = 0; n < COUNT; n++) {
        const struct vector *v = &vectors[n];
        lrcsi_view view = view_of(v);
        const lrcs_brdf brdf = {v->A, v->B, v->s, v->m};
        lrcsi_lobes lobes = lrcsi_lobes_make(&brdf, brdf.A > 0, brdf.B > 0);
        double dot = dot_at(&view, view.prepared->batches.first[1]);
        double x = (1 / dot / dot - 1) / v->s / v->s;
        if (v->s >= 0.05 && v->s <= 0.3 && v->m <= 2 && dot > 0.5 && x < 12) {
            shade_lane(&view, &lobes, 0, &shades);
            double both = shades.glint[0] + shades.diffuse[0];
            check_most(shades.error[0], (60 + 55 * x) * both);
        }
    }
}

static void a_lane_holds_the_same_wherever_it_stands(void **state)
{
    (void)state;
    static lrcsi_shades shades;
    for (size_t n = 0; n < COUNT; n += 37) {
        const struct vector *v = &vectors[n];
        lrcsi_view view = view_of(v);
        const lrcs_brdf brdf = {v->A, v->B, v->s, v->m};
        lrcsi_lobes lobes = lrcsi_lobes_make(&brdf, brdf.A > 0, brdf.B > 0);
        double first[3] = {0, 0, 0};
        for (uint32_t lane = 0; lane < LRCSI_LANES; lane++) {
            shade_lane(&view, &lobes, lane, &shades);
            const double now[3] = {shades.glint[lane], shades.diffuse[lane], shades.error[lane]};
            for (int k = 0; k < 3; k++) {
                first[k] = lane == 0 ? now[k] : first[k];
                check_same(now[k], first[k]);
            }
        }
    }
}

/* Materials outside what the proof covers are left to the precise path. */
static void materials_at_the_ends_of_the_range_are_not_served(void **state)
{
    (void)state;
    static const lrcs_brdf out[] = {{1, 0, 1e-7, 0},    {1, 0, 1e7, 0},   {1e40, 0, 0.2, 0},
                                    {1e-40, 0, 0.2, 0}, {0, 1, 0.2, 1e7}, {0, 1e-40, 0.2, 0}};
    for (size_t i = 0; i < sizeof out / sizeof *out; i++) {
        lrcsi_lobes lobes = lrcsi_lobes_make(&out[i], out[i].A > 0, out[i].B > 0);
        assert_true(lobes.low >= lobes.high);
    }
    const lrcs_brdf plain = {1, 0.25, 0.2, 0.5};
    lrcsi_lobes lobes = lrcsi_lobes_make(&plain, 1, 1);
    assert_true(lobes.low < 0.02 && lobes.high > 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(facets_stay_within_the_error_of_their_packet),
        cmocka_unit_test(sigma_stays_within_its_bound_at_every_incidence),
        cmocka_unit_test(bounds_of_ordinary_materials_are_small),
        cmocka_unit_test(a_lane_holds_the_same_wherever_it_stands),
        cmocka_unit_test(materials_at_the_ends_of_the_range_are_not_served),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
