/* SPDX-License-Identifier: MIT */
/* Effects switched against the planner's choice. What it leaves out, simulated all the same,
   changes neither sigma nor its parts nor what is seen of any facet, on random scenes and on shapes
   with closed forms; what is left out on request is what a scene without it gives. */
#include "scenes.h"

#define SCENES      300
#define BIT(effect) (1u << (effect))

static test_scene scene;
static lrcs_facet_record before[SCENE_FACETS];

/* ---- random scenes ---- */

/* A number in -2 .. 2: a multiple of 1/4, where bodies meet exactly, or any. */
static double coordinate(uint64_t *seed, int exact)
{
    return exact ? (double)random_below(seed, 17) / 4 - 2
                 : (double)random_below(seed, 1u << 30) / 0x1p28 - 2;
}

static void coordinates(uint64_t *seed, int exact, double x[3])
{
    for (int k = 0; k < 3; k++) {
        x[k] = coordinate(seed, exact);
    }
}

static void random_body(uint64_t *seed, int exact)
{
    double a[3];
    double b[3];
    double c[3];
    uint32_t first = scene.scene.facet_count;
    uint32_t kind = random_below(seed, 8);
    coordinates(seed, exact, a);
    coordinates(seed, exact, b);
    coordinates(seed, exact, c);
    if (kind < 4) {
        for (int k = 0; k < 3; k++) {
            b[k] = a[k] + 0.25 + fabs(b[k]) / 2;
        }
        scene_box(&scene, a, b);
    } else if (kind < 6) {
        scene_sphere(&scene, a, 0.25 + fabs(b[0]) / 2, 4 + 2 * random_below(seed, 4));
    } else if (kind == 6) {
        scene_plate(&scene, a, b, c);
    } else {
        scene_triangle(&scene, a, b, c);
    }
    if (random_below(seed, 6) == 0) {
        scene_invert(&scene, first);
    }
}

/* One to four bodies with two materials: each term may be absent, and each material two-sided. */
static void random_scene(uint64_t *seed)
{
    uint32_t bodies = 1 + random_below(seed, 4);
    int exact = random_below(seed, 2) == 0;
    scene_start(&scene);
    scene_material(&scene, 1, 1, 1, 1);
    for (uint32_t i = 0; i < 2; i++) {
        scene.material[i].brdf = (lrcs_brdf){random_below(seed, 3) != 0, random_below(seed, 3) != 0,
                                             0.25 + random_below(seed, 2), random_below(seed, 3)};
        scene.material[i].two_sided = random_below(seed, 2) != 0;
    }
    for (uint32_t i = 0; i < bodies; i++) {
        scene.assigned = random_below(seed, 2);
        random_body(seed, exact);
    }
}

static void random_direction(uint64_t *seed, double d[3])
{
    d[0] = d[1] = d[2] = 0;
    while (d[0] == 0 && d[1] == 0 && d[2] == 0) {
        coordinates(seed, random_below(seed, 2) == 0, d);
        if (random_below(seed, 4) == 0) {
            d[random_below(seed, 3)] = 0;
        }
    }
}

static lrcs_result run_with(const lrcs_prepared *prepared, lrcs_work *work, const double d[3],
                            lrcs_run_options options)
{
    lrcs_pose pose;
    lrcs_result result;
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, work, &result, scene.record, NULL),
                     LRCS_OK);
    return result;
}

/* ---- what is off ---- */

static void check_close(const lrcs_result *r, const lrcs_result *plain)
{
    double most = r->bound_m2 + plain->bound_m2;
    check_abs(r->sigma_m2, plain->sigma_m2, most);
    check_abs(r->sigma_glint_m2, plain->sigma_glint_m2, most);
    check_abs(r->sigma_diffuse_m2, plain->sigma_diffuse_m2, most);
}

/* Visible areas of the last run and of the one before, each good to 1e-12 of the facet and 1e-15 of
   the extent squared. */
static void check_areas(double extent)
{
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        double whole = before[f].area_m2 * fabs(before[f].cos_theta);
        check_abs(scene.record[f].visible_area_m2, before[f].visible_area_m2,
                  2e-12 * whole + 2e-15 * extent * extent);
    }
}

static void what_is_off_changes_nothing_when_simulated(void **state)
{
    (void)state;
    uint64_t seed = 20261121;
    uint32_t off[LRCS_EFFECTS] = {0};
    for (int i = 0; i < SCENES; i++) {
        lrcs_work work;
        random_scene(&seed);
        const lrcs_prepared *prepared = scene_prepare(&scene, &work);
        for (int k = 0; k < 3; k++) {
            double d[3];
            random_direction(&seed, d);
            lrcs_run_options options = lrcs_run_options_default();
            const lrcs_result plain = run_with(prepared, &work, d, options);
            memcpy(before, scene.record, sizeof before);
            for (int e = 0; e < LRCS_EFFECTS; e++) {
                options.with = BIT(e) & LRCS_EFFECTS_SWITCHED;
                if (plain.effect[e].on || options.with == 0) {
                    continue;
                }
                lrcs_result r = run_with(prepared, &work, d, options);
                check_close(&r, &plain);
                check_areas(8);
                off[e]++;
            }
            options.with = LRCS_EFFECTS_SWITCHED;
            options.method = LRCS_METHOD_EXACT;
            lrcs_result r = run_with(prepared, &work, d, options);
            check_close(&r, &plain);
            check_areas(8);
            for (int e = 0; e < LRCS_EFFECTS; e++) { /* but two sides where no material has them */
                assert_true(r.effect[e].on || e == LRCS_EFFECT_TWO_SIDED ||
                            !(BIT(e) & LRCS_EFFECTS_SWITCHED));
            }
        }
    }
    for (int e = 0; e < LRCS_EFFECTS; e++) {
        assert_true(off[e] > SCENES / 10 || !(BIT(e) & LRCS_EFFECTS_SWITCHED));
    }
}

/* ---- what is left out on request ---- */

/* The scene whose truth a run without the effect refers to. */
static void scene_without(int effect)
{
    uint32_t absent = scene.scene.material_count++;
    scene.material[absent] = scene.material[0];
    scene.material[absent].omitted = 1;
    for (uint32_t i = 0; i < absent; i++) {
        lrcs_material *material = &scene.material[i];
        material->brdf.A = effect == LRCS_EFFECT_GLINT ? 0 : material->brdf.A;
        material->brdf.B = effect == LRCS_EFFECT_DIFFUSE ? 0 : material->brdf.B;
        material->two_sided &= effect != LRCS_EFFECT_TWO_SIDED;
    }
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        if (effect == LRCS_EFFECT_BACK_FACE_CASTERS && before[f].cos_theta < 0) {
            scene.material_of[f] = absent;
        }
    }
}

static void what_is_left_out_is_a_scene_without_it(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < SCENES; i++) {
        for (int e = 0; e < LRCS_EFFECTS; e++) {
            if (!(BIT(e) & LRCS_EFFECTS_SWITCHED) || e == LRCS_EFFECT_SELF_SHADOWING) {
                continue;
            }
            lrcs_work work;
            double d[3];
            lrcs_run_options options = {.tolerance = 1e-4, .without = BIT(e)};
            random_scene(&seed);
            random_direction(&seed, d);
            lrcs_result r = run_with(scene_prepare(&scene, &work), &work, d, options);
            assert_false(r.effect[e].on);
            memcpy(before, scene.record, sizeof before);
            scene_without(e);
            lrcs_result want = scene_run(&scene, d, LRCS_METHOD_EXACT, 0);
            check_close(&r, &want);
            if (e != LRCS_EFFECT_TWO_SIDED) { /* of two coincident backs another may then show */
                check_areas(8);
            }
        }
    }
}

static void without_self_shadowing_is_method_facet(void **state)
{
    (void)state;
    uint64_t seed = 7;
    for (int i = 0; i < SCENES; i++) {
        lrcs_work work;
        double d[3];
        random_scene(&seed);
        random_direction(&seed, d);
        const lrcs_prepared *prepared = scene_prepare(&scene, &work);
        lrcs_result facet = scene_pose(&scene, prepared, &work, d, LRCS_METHOD_FACET, 0);
        lrcs_result exact = scene_pose(&scene, prepared, &work, d, LRCS_METHOD_EXACT, 0);
        for (int method = LRCS_METHOD_AUTO; method <= LRCS_METHOD_EXACT; method++) {
            lrcs_run_options options = {.tolerance = 1e-4, .method = method, .resolution = 32};
            options.without = BIT(LRCS_EFFECT_SELF_SHADOWING);
            lrcs_result r = run_with(prepared, &work, d, options);
            assert_int_equal(r.method, LRCS_METHOD_FACET);
            check_same(r.sigma_m2, facet.sigma_m2);
            check_same(r.bound_m2, facet.bound_m2);
            check_close(&r, &exact);
        }
        /* back sides are not looked for where nothing could hide them */
        lrcs_run_options options = {.tolerance = 1e-4, .method = LRCS_METHOD_FACET};
        options.with = LRCS_EFFECTS_SWITCHED & ~BIT(LRCS_EFFECT_SELF_SHADOWING);
        lrcs_result r = run_with(prepared, &work, d, options);
        check_close(&r, &exact);
        check_same(r.sigma_m2, facet.sigma_m2);
    }
}

/* ---- shapes ---- */

static const lrcs_shape shapes[] = {
    {.kind = LRCS_SHAPE_PLATE, .size = {1, 2}},
    {.kind = LRCS_SHAPE_BOX, .size = {1, 2, 3}},
    {.kind = LRCS_SHAPE_SPHERE, .radius = 1},
    {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.5, .length = 2},
    {.kind = LRCS_SHAPE_CYLINDER, .parts = LRCS_SHAPE_WALL, .radius = 0.5, .length = 2},
    {.kind = LRCS_SHAPE_CONE, .radius = 1, .half_angle_deg = 15},
    {.kind = LRCS_SHAPE_FRUSTUM, .radius = 0.25, .radius2 = 1, .length = 1},
    {.kind = LRCS_SHAPE_PARABOLOID, .radius = 1, .length = 0.5},
    {.kind = LRCS_SHAPE_DOME, .radius = 1}};

/* A run as planned, then each effect and all of them simulated. */
static void check_aspect(const lrcs_prepared *prepared, lrcs_work *work, double deg,
                         const lrcs_closed_form *closed)
{
    lrcs_pose pose;
    lrcs_result plain;
    lrcs_run_options options = lrcs_run_options_default();
    assert_int_equal(lrcs_pose_from_azel(0, 90 - deg, &pose), LRCS_OK);
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, work, &plain, NULL, NULL), LRCS_OK);
    for (int e = 0; e <= LRCS_EFFECTS; e++) {
        lrcs_result r;
        options.with = (e < LRCS_EFFECTS ? BIT(e) : ~0u) & LRCS_EFFECTS_SWITCHED;
        assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, work, &r, NULL, NULL), LRCS_OK);
        check_close(&r, &plain);
        if (closed) {
            check_abs(r.sigma_m2, closed->sigma_m2, r.bound_m2 + closed->bound_m2);
        }
    }
}

/* Closed forms are of one-sided shapes: two sides are the same only where no back is ever seen. */
static void check_shape(const lrcs_shape *shape, int two_sided)
{
    static unsigned char memory[16u << 20];
    static const double aspect[] = {0, 20, 60, 89.9, 90, 120, 180};
    const lrcs_brdf brdf = {1, 0.25, 0.3, 0.5};
    const lrcs_build_options build = {1e-2, 1u << 13, LRCS_NORMALS_FLAT, 1, 0, NULL};
    lrcs_recipe_part part = {
        .name = "part", .shape = *shape, .place = lrcs_place_default(), .material_index = -1};
    lrcs_binding binding = {.kind = LRCS_BIND_DEFAULT, .brdf = brdf, .two_sided = two_sided};
    lrcs_recipe recipe = {.part = &part, .binding = &binding, .part_count = 1, .binding_count = 1};
    lrcs_work work = lrcs_work_make(memory, sizeof memory);
    lrcs_where where = {0};
    lrcs_scene made;
    const lrcs_prepared *prepared = NULL;
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &build, &work, &made, &where), LRCS_OK);
    work = lrcs_work_make(scene_memory, sizeof scene_memory);
    assert_int_equal(lrcs_prepare_run(&made, &work, &prepared), LRCS_OK);
    int open = shape->kind == LRCS_SHAPE_PLATE || shape->parts == LRCS_SHAPE_WALL;
    for (size_t i = 0; i < sizeof aspect / sizeof *aspect; i++) {
        lrcs_aspect at = {.deg = aspect[i]};
        lrcs_closed_form closed;
        assert_int_equal(lrcs_closed_eval(shape, &brdf, &at, &closed), LRCS_OK);
        check_aspect(prepared, &work, aspect[i], two_sided && open ? NULL : &closed);
    }
}

static void shapes_hold_their_closed_forms_with_every_effect(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        check_shape(&shapes[i], 0);
        check_shape(&shapes[i], 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_off_changes_nothing_when_simulated),
        cmocka_unit_test(what_is_left_out_is_a_scene_without_it),
        cmocka_unit_test(without_self_shadowing_is_method_facet),
        cmocka_unit_test(shapes_hold_their_closed_forms_with_every_effect),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
