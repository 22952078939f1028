/* SPDX-License-Identifier: MIT */
/* Shapes by their closed forms inside the engine: alone from any direction and however placed,
   and among other parts where nothing hides them. References: lrcs_closed_eval, which is held to
   high-precision values of its own (test/optics/test_closed.c); the intervals of fine meshes. */
#include <lrcs/lrcs.h>

#include <stdlib.h>
#include <string.h>

#include "base/rotate.h"
#include "check.h"
#include "random.h"

#define ROWS(a) (sizeof(a) / sizeof(a)[0])

static unsigned char scene_area[1u << 25];
static unsigned char run_area[1u << 27];

/* Given more scenes on the command line (make shadows), a run takes longer. */
static uint32_t scenes = 50;
static uint64_t seed = 1;

static const lrcs_shape bodies[] = {
    {.kind = LRCS_SHAPE_SPHERE, .radius = 0.5},
    {.kind = LRCS_SHAPE_DOME, .radius = 0.75},
    {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.25, .length = 1.5},
    {.kind = LRCS_SHAPE_CONE, .radius = 0.5, .half_angle_deg = 15},
    {.kind = LRCS_SHAPE_FRUSTUM, .radius = 0.25, .radius2 = 0.5, .length = 0.75},
    {.kind = LRCS_SHAPE_FRUSTUM, .radius = 0.5, .radius2 = 0.25, .length = 0.75},
    {.kind = LRCS_SHAPE_PARABOLOID, .radius = 0.5, .length = 0.375},
};

static const lrcs_brdf glossy = {1, 0.25, 0.2, 0.5};

typedef struct shapes_scene {
    lrcs_recipe_part part[6];
    lrcs_recipe_material material;
    uint32_t parts;
} shapes_scene;

static lrcs_recipe_part *add(shapes_scene *s, lrcs_shape shape)
{
    lrcs_recipe_part *part = &s->part[s->parts++];
    *part = (lrcs_recipe_part){.name = "",
                               .shape = shape,
                               .place = lrcs_place_default(),
                               .material = "skin",
                               .material_index = 0};
    return part;
}

static shapes_scene scene_of(lrcs_brdf brdf, int two_sided)
{
    shapes_scene s = {.parts = 0};
    s.material = (lrcs_recipe_material){.name = "skin", .brdf = brdf, .two_sided = two_sided};
    return s;
}

/* Builds and prepares; the rest of the work area is for runs. */
static lrcs_scene scene;
static lrcs_work run_work;

static const lrcs_prepared *shapes_prepare(shapes_scene *s, const lrcs_build_options *build)
{
    lrcs_recipe recipe = {
        .part = s->part, .part_count = s->parts, .material = &s->material, .material_count = 1};
    lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
    const lrcs_prepared *prepared;
    assert_int_equal(lrcs_scene_build(&recipe, NULL, build, &work, &scene, NULL), LRCS_OK);
    run_work = lrcs_work_make(run_area, sizeof run_area);
    assert_int_equal(lrcs_prepare_run(&scene, &run_work, &prepared), LRCS_OK);
    return prepared;
}

/* Runs by a method; by auto closed forms may serve. Records and errors into static arrays. */
static lrcs_facet_record records[1u << 16];
static double part_error[6];

static double run_tolerance = 1e-4;

static lrcs_result recorded_run(const lrcs_prepared *prepared, const double d[3], int method,
                                lrcs_facet_record *into)
{
    lrcs_run_options run = lrcs_run_options_default();
    lrcs_pose pose;
    lrcs_result result;
    assert_true(scene.facet_count <= ROWS(records));
    run.method = method;
    run.tolerance = run_tolerance;
    run.part_error_m2 = part_error;
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    size_t need = lrcs_sigma_need(prepared, &run);
    size_t before = run_work.used;
    run_work.peak = run_work.used;
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &run, &run_work, &result, into, NULL),
                     LRCS_OK);
    assert_true(run_work.peak - before <= need);
    return result;
}

static lrcs_result prepared_run(const lrcs_prepared *prepared, const double d[3], int method)
{
    return recorded_run(prepared, d, method, records);
}

static lrcs_result shapes_run(shapes_scene *s, const lrcs_build_options *build, const double d[3],
                              int method)
{
    return prepared_run(shapes_prepare(s, build), d, method);
}

static const lrcs_build_options auto_build = {1e-4, 1u << 12, LRCS_NORMALS_FLAT, 0, 0, NULL};

static lrcs_result run_auto(shapes_scene *s, const double d[3])
{
    return shapes_run(s, &auto_build, d, LRCS_METHOD_AUTO);
}

static int closed_forms(const lrcs_result *r)
{
    return r->effect[LRCS_EFFECT_CLOSED_FORMS].on;
}

/* --- alone ------------------------------------------------------------------------------------ */

/* In the xz plane, exactly as given: along the axes and in between. */
static void a_shape_alone_is_its_closed_form_to_rounding(void **state)
{
    (void)state;
    static const double slope[] = {1e-3, 0.02, 0.2, 1.5};
    static const double d[][3] = {{0, 0, 1},  {1, 0, 0},       {0, 0, -1},       {3, 0, 4},
                                  {4, 0, -3}, {1, 0, 0x1p-40}, {0x1p-40, 0, -1}, {-1, 0, 1e-3}};
    for (size_t b = 0; b < ROWS(bodies) * ROWS(slope); b++) {
        const lrcs_shape *body = &bodies[b / ROWS(slope)];
        shapes_scene s = scene_of((lrcs_brdf){1, 0.25, slope[b % ROWS(slope)], 0.5}, 0);
        add(&s, *body);
        const lrcs_prepared *prepared = shapes_prepare(&s, &auto_build);
        for (size_t i = 0; i < ROWS(d); i++) {
            lrcs_aspect aspect = {.by_direction = 1};
            memcpy(aspect.direction, d[i], sizeof aspect.direction);
            lrcs_closed_form truth;
            assert_int_equal(lrcs_closed_eval(body, &s.material.brdf, &aspect, &truth), LRCS_OK);
            lrcs_result r = recorded_run(prepared, d[i], LRCS_METHOD_AUTO, NULL);
            assert_int_equal(r.method, LRCS_METHOD_CLOSED);
            assert_true(closed_forms(&r));
            check_same(r.budget.tessellation_m2, 0);
            check_abs(r.sigma_m2, truth.sigma_m2, r.bound_m2 + truth.bound_m2);
            check_abs(r.sigma_glint_m2, truth.sigma_glint_m2, r.bound_m2 + truth.bound_m2);
            check_most(r.bound_m2, 1e-13 * truth.sigma_m2);
            assert_true(scene.facet_count < 2000);
        }
    }
}

/* From broadside to edge-on, exactly and nearly so, at any size: a bound that rounding explains. */
static void a_shape_alone_is_bounded_by_rounding_at_hard_aspects(void **state)
{
    (void)state;
    static const lrcs_shape flat[] = {{.kind = LRCS_SHAPE_PLATE, .size = {1, 0.7}},
                                      {.kind = LRCS_SHAPE_BOX, .size = {1, 0.7, 0.4}}};
    static const double off[] = {0, 1e-17, 3e-16, 1e-11, 1e-8, 2e-5};
    static const double size[] = {1, 1e-6, 1e6};
    for (size_t i = 0; i < (ROWS(bodies) + 2) * 3 * ROWS(size); i++) {
        size_t which = i % (ROWS(bodies) + 2);
        size_t scale = i / (ROWS(bodies) + 2) / 3;
        shapes_scene s = scene_of((lrcs_brdf){1, 0.25, scale ? 1e-3 : 1, 0.5}, 0);
        lrcs_recipe_part *part =
            add(&s, which < ROWS(bodies) ? bodies[which] : flat[which - ROWS(bodies)]);
        const lrcs_build_options build = {1e-4, 1u << 12, LRCS_NORMALS_FLAT, 0, 0, NULL};
        for (int k = 0; k < 3; k++) {
            part->place.scale[k] = size[scale];
        }
        const lrcs_prepared *prepared = shapes_prepare(&s, &build);
        for (size_t k = 0; k < 2 * ROWS(off); k++) {
            double d[3] = {0, 0, 0}; /* near +z, +x or -z */
            double beside = k % 2 ? -off[k / 2] : off[k / 2];
            size_t way = i / (ROWS(bodies) + 2) % 3;
            d[way == 1 ? 0 : 2] = way == 2 ? -1 : 1;
            d[way == 1 ? 2 : 0] = beside;
            lrcs_result r = recorded_run(prepared, d, LRCS_METHOD_AUTO, NULL);
            check_most(r.bound_m2, 1e-12 * r.sigma_m2);
        }
    }
}

/* Turned, mirrored and scaled: the laser is turned with it, in long doubles. */
static void a_shape_placed_is_its_closed_form_seen_from_its_frame(void **state)
{
    (void)state;
    need_wide_long_double();
    for (uint32_t i = 0; i < 3 * scenes / 2; i++) {
        const lrcs_shape *body = &bodies[i % ROWS(bodies)];
        shapes_scene s = scene_of((lrcs_brdf){1, 0.25, i % 2 ? 0.2 : 0.01, 0.5}, 0);
        lrcs_recipe_part *part = add(&s, *body);
        const double deg[3] = {360 * random_unit(&seed), 360 * random_unit(&seed),
                               360 * random_unit(&seed)};
        double factor = i % 3 ? 1 : 1.7;
        double d[3];
        lrcs_aspect aspect = {.by_direction = 1};
        lrcs_closed_form truth;
        assert_int_equal(lrcsi_rotate_euler("XYZ", deg, part->place.rotate), LRCS_OK);
        for (int k = 0; k < 3; k++) {
            d[k] = 2 * random_unit(&seed) - 1;
            part->place.scale[k] = random_unit(&seed) < 0.5 ? -factor : factor;
            part->place.translate[k] = 3 * random_unit(&seed);
        }
        if (i % 5 == 0) {
            part->joint = (lrcs_joint){1, {1, 0, 0}, {0.5, 0.25, 1}, 90};
        }
        for (int k = 0; k < 3; k++) {
            long double sum = 0;
            for (int j = 0; j < 3; j++) {
                sum += (long double)part->place.rotate[j][k] * d[j];
            }
            aspect.direction[k] = (double)(part->place.scale[k] < 0 ? -sum : sum);
        }
        if (part->joint.used) { /* its quarter turn takes y to z: back again */
            double y = aspect.direction[1];
            aspect.direction[1] = aspect.direction[2];
            aspect.direction[2] = -y;
        }
        assert_int_equal(lrcs_closed_eval(body, &s.material.brdf, &aspect, &truth), LRCS_OK);
        double want = factor * factor * truth.sigma_m2;
        lrcs_result r = recorded_run(shapes_prepare(&s, &auto_build), d, LRCS_METHOD_AUTO, NULL);
        assert_int_equal(r.method, LRCS_METHOD_CLOSED);
        /* the direction rounded to doubles moves sigma by a few 1e-16 / s of it */
        check_abs(r.sigma_m2, want, r.bound_m2 + 1e-13 * want);
        check_most(r.bound_m2, 1e-13 * want);
    }
}

/* Neither interval knows of the other. */
static void closed_forms_lie_within_the_bounds_of_fine_meshes(void **state)
{
    (void)state;
    const lrcs_build_options fine = {1e-3, 1u << 15, LRCS_NORMALS_FLAT, 1, 0, NULL};
    for (uint32_t i = 0; i < scenes / 7; i++) {
        shapes_scene s = scene_of(glossy, i % 2 != 0);
        lrcs_recipe_part *part = add(&s, bodies[i % ROWS(bodies)]);
        const double deg[3] = {90 * random_unit(&seed), 90 * random_unit(&seed),
                               90 * random_unit(&seed)};
        const double d[3] = {2 * random_unit(&seed) - 1, 2 * random_unit(&seed) - 1,
                             2 * random_unit(&seed) - 1};
        assert_int_equal(lrcsi_rotate_euler("zyx", deg, part->place.rotate), LRCS_OK);
        const lrcs_prepared *prepared = shapes_prepare(&s, &fine);
        lrcs_result facets = prepared_run(prepared, d, LRCS_METHOD_AUTO);
        /* the mesh asked for serves auto's closed form as well as any */
        assert_int_equal(facets.method, LRCS_METHOD_CLOSED);
        facets = prepared_run(prepared, d, LRCS_METHOD_FACET);
        assert_false(closed_forms(&facets));
        assert_true(facets.budget.tessellation_m2 > 0);
        lrcs_result r = run_auto(&s, d);
        assert_int_equal(r.method, LRCS_METHOD_CLOSED);
        check_abs(r.sigma_m2, facets.sigma_m2, r.bound_m2 + facets.bound_m2);
        check_rel(r.projected_area_m2, facets.projected_area_m2, 2e-3);
    }
}

static void records_share_out_the_closed_form(void **state)
{
    (void)state;
    for (size_t b = 0; b < ROWS(bodies); b++) {
        for (int narrow = 0; narrow < 2; narrow++) { /* so that no flat facet glints */
            shapes_scene s = scene_of((lrcs_brdf){1, 0.25, narrow ? 1e-4 : 0.2, 0.5}, 0);
            const double d[3] = {0.48, 0.64, 0.6};
            double sigma = 0;
            double glint = 0;
            double area = 0;
            add(&s, bodies[b]);
            lrcs_result r = run_auto(&s, d);
            for (uint32_t f = 0; f < scene.facet_count; f++) {
                assert_true(records[f].cos_theta > 0 || records[f].sigma_m2 == 0);
                sigma += records[f].sigma_m2;
                glint += records[f].sigma_glint_m2;
                area += records[f].visible_area_m2;
            }
            check_rel(sigma, r.sigma_m2, 1e-12);
            check_abs(glint, r.sigma_glint_m2, 1e-12 * r.sigma_m2);
            check_rel(area, r.projected_area_m2, 2e-2);
        }
    }
}

/* What is seen through the opening of a shell has no closed form here; from the other side nothing
   is seen through it. */
static void a_two_sided_shell_needs_facets_where_its_inside_shows(void **state)
{
    (void)state;
    lrcs_shape bowl = {.kind = LRCS_SHAPE_DOME, .parts = LRCS_SHAPE_WALL, .radius = 0.5};
    for (int two_sided = 0; two_sided < 2; two_sided++) {
        for (int below = 0; below < 2; below++) {
            shapes_scene s = scene_of(glossy, two_sided);
            const double d[3] = {0.6, 0, below ? -0.8 : 0.8};
            const lrcs_aspect aspect = {.by_direction = 1, .direction = {0.6, 0, d[2]}};
            lrcs_closed_form outside;
            add(&s, bowl);
            assert_int_equal(lrcs_closed_eval(&bowl, &glossy, &aspect, &outside), LRCS_OK);
            lrcs_result r = run_auto(&s, d);
            assert_int_equal(closed_forms(&r), !two_sided || !below);
            if (two_sided && below) {
                assert_true(r.sigma_m2 > 1.5 * outside.sigma_m2);
            } else {
                check_abs(r.sigma_m2, outside.sigma_m2, r.bound_m2 + outside.bound_m2);
                check_most(r.bound_m2, 1e-13 * r.sigma_m2);
            }
            assert_int_equal((r.notices & LRCS_NOTICE_BACK_SIDES_VISIBLE) != 0,
                             !two_sided && below);
        }
    }
}

/* A patch on the limb is seen from both sides: where its facet faces away, and is hidden as part of
   the inside, some of the patch is lit from outside all the same. */
static void patches_on_the_limb_of_a_two_sided_shell_count_from_both_sides(void **state)
{
    (void)state;
    const lrcs_build_options mesh = {1e-9, 512, LRCS_NORMALS_FLAT, 1, 0, NULL};
    const lrcs_brdf diffuse = {0, 0.2, 0.1, 0};
    const lrcs_shape shells[] = {
        {.kind = LRCS_SHAPE_CONE, .parts = LRCS_SHAPE_WALL, .radius = 0.25, .length = 0.75},
        {.kind = LRCS_SHAPE_PARABOLOID, .parts = LRCS_SHAPE_WALL, .radius = 0.25, .length = 1},
        {.kind = LRCS_SHAPE_DOME, .parts = LRCS_SHAPE_WALL, .radius = 0.5}};
    for (int i = 0; i < 3; i++) {
        shapes_scene s = scene_of(diffuse, 1);
        add(&s, shells[i]);
        const lrcs_prepared *prepared = shapes_prepare(&s, &mesh);
        for (int k = 0; k < 24; k++) { /* over two sectors of a cone of 512 facets, and more */
            double turn = 0.001 + k * (3.14159 / 384);
            const double d[3] = {cos(turn), sin(turn), 0.01};
            lrcs_aspect aspect = {.by_direction = 1, .direction = {d[0], d[1], d[2]}};
            lrcs_closed_form truth;
            assert_int_equal(lrcs_closed_eval(&shells[i], &diffuse, &aspect, &truth), LRCS_OK);
            lrcs_result r = prepared_run(prepared, d, LRCS_METHOD_EXACT);
            check_abs(r.sigma_m2, truth.sigma_m2, r.bound_m2 + truth.bound_m2);
        }
    }
}

static void an_unevenly_scaled_shape_keeps_its_facets(void **state)
{
    (void)state;
    shapes_scene s = scene_of(glossy, 0);
    const double d[3] = {0.48, 0.64, 0.6};
    lrcs_recipe_part *part = add(&s, bodies[0]);
    part->place.scale[1] = 2;
    lrcs_result r = run_auto(&s, d);
    assert_false(closed_forms(&r));
    part->place.scale[1] = 1;
    part->place.rotate[0][1] = 1e-6; /* no rotation */
    r = run_auto(&s, d);
    assert_false(closed_forms(&r));
}

static void switched_terms_are_left_out_of_closed_forms_too(void **state)
{
    (void)state;
    shapes_scene s = scene_of(glossy, 0);
    const double d[3] = {0.48, 0.64, 0.6};
    add(&s, bodies[3]);
    lrcs_result all = run_auto(&s, d);
    lrcs_recipe recipe = {
        .part = s.part, .part_count = 1, .material = &s.material, .material_count = 1};
    const lrcs_build_options build = lrcs_build_options_default();
    for (int i = 0; i < 2; i++) {
        lrcs_run_options run = lrcs_run_options_default();
        lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
        const lrcs_prepared *prepared;
        lrcs_pose pose;
        lrcs_result r;
        run.without = 1u << (i ? LRCS_EFFECT_GLINT : LRCS_EFFECT_DIFFUSE);
        assert_int_equal(lrcs_scene_build(&recipe, NULL, &build, &work, &scene, NULL), LRCS_OK);
        assert_int_equal(lrcs_prepare_run(&scene, &work, &prepared), LRCS_OK);
        assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
        assert_int_equal(lrcs_sigma_run(prepared, &pose, &run, &work, &r, NULL, NULL), LRCS_OK);
        check_same(r.sigma_glint_m2, i ? 0 : all.sigma_glint_m2);
        check_same(r.sigma_diffuse_m2, i ? all.sigma_diffuse_m2 : 0);
    }
}

/* --- among others ----------------------------------------------------------------------------- */

static void shapes_far_apart_are_all_closed_forms(void **state)
{
    (void)state;
    shapes_scene s = scene_of(glossy, 0);
    const double d[3] = {0.1, 0.05, 1};
    double want = 0;
    for (int i = 0; i < 5; i++) {
        const lrcs_aspect aspect = {.by_direction = 1, .direction = {0.1, 0.05, 1}};
        lrcs_closed_form one;
        lrcs_recipe_part *part = add(&s, bodies[i]);
        part->place.translate[0] = 4 * i;
        assert_int_equal(lrcs_closed_eval(&bodies[i], &glossy, &aspect, &one), LRCS_OK);
        want += one.sigma_m2;
    }
    lrcs_result r = run_auto(&s, d);
    assert_int_equal(r.method, LRCS_METHOD_CLOSED);
    check_rel(r.sigma_m2, want, 1e-13);
    check_most(r.bound_m2, 1e-13 * want);
    const double line[3] = {1, 0, 0.01}; /* all behind the last */
    r = run_auto(&s, line);
    assert_int_equal(r.method, LRCS_METHOD_EXACT);
    assert_true(closed_forms(&r)); /* that one */
}

/* Random scenes of two to five parts, near one another, against the intervals of clipped meshes:
   some shapes clear, some not. */
static void random_scenes_agree_with_clipped_meshes(void **state)
{
    (void)state;
    uint32_t all = 0;
    uint32_t some = 0;
    uint32_t none = 0;
    lrcs_build_options coarse = {1e-9, 300, LRCS_NORMALS_FLAT, 1, 0, NULL};
    for (uint32_t i = 0; i < scenes / 2; i++) {
        shapes_scene s = scene_of((lrcs_brdf){1, 0.25, i % 4 ? 0.4 : 0.1, 0.5}, i % 3 == 0);
        uint32_t parts = 2 + (uint32_t)(4 * random_unit(&seed));
        for (uint32_t k = 0; k < parts; k++) {
            lrcs_shape shape = bodies[(size_t)(ROWS(bodies) * random_unit(&seed))];
            if (random_unit(&seed) < 0.3) {
                shape = (lrcs_shape){.kind = LRCS_SHAPE_BOX, .size = {1, 0.5, 0.25}};
            } else if (random_unit(&seed) < 0.3 && shape.kind != LRCS_SHAPE_SPHERE) {
                shape.parts = LRCS_SHAPE_WALL;
            }
            lrcs_recipe_part *part = add(&s, shape);
            const double deg[3] = {360 * random_unit(&seed), 360 * random_unit(&seed),
                                   360 * random_unit(&seed)};
            if (random_unit(&seed) < 0.5) {
                assert_int_equal(lrcsi_rotate_euler("XYZ", deg, part->place.rotate), LRCS_OK);
            }
            for (int j = 0; j < 3; j++) {
                part->place.translate[j] = (i % 2 ? 3 : 1.5) * (2 * random_unit(&seed) - 1);
            }
        }
        const double d[3] = {2 * random_unit(&seed) - 1, 2 * random_unit(&seed) - 1,
                             2 * random_unit(&seed) - 1};
        const lrcs_prepared *prepared = shapes_prepare(&s, &coarse);
        lrcs_result clipped = prepared_run(prepared, d, LRCS_METHOD_EXACT);
        lrcs_result r = prepared_run(prepared, d, LRCS_METHOD_AUTO);
        check_abs(r.sigma_m2, clipped.sigma_m2, r.bound_m2 + clipped.bound_m2);
        check_most(r.bound_m2, clipped.bound_m2 * (1 + 1e-9) + 1e-12 * r.sigma_m2);
        all += r.method == LRCS_METHOD_CLOSED;
        some += closed_forms(&r) && r.method != LRCS_METHOD_CLOSED;
        none += !closed_forms(&r);
        double sigma = 0;
        int lost[6] = {1, 1, 1, 1, 1, 1}; /* no facet faces the laser, though a sliver may be lit */
        for (uint32_t f = 0; f < scene.facet_count; f++) {
            sigma += records[f].sigma_m2;
            lost[scene.facet_part[f]] &= !(records[f].cos_theta > 0);
        }
        int slivers = lost[0] + lost[1] + (lost[2] && parts > 2) + (lost[3] && parts > 3) +
                      (lost[4] && parts > 4);
        check_rel(sigma, r.sigma_m2, slivers ? 1e-2 : 1e-11);
    }
    assert_true(all > 0 && some > scenes / 8 && none > 0);
}

/* --- by part ---------------------------------------------------------------------------------- */

/* The larger of what a facet's error adds and what it takes counts for a part: summed over the
   parts, this is at least the larger of both sums, and at most both together. */
static void check_part_errors(const lrcs_result *r, uint32_t parts)
{
    double sum = 0;
    for (uint32_t i = 0; i < parts; i++) {
        assert_true(part_error[i] >= 0);
        sum += part_error[i];
    }
    check_most(r->budget.tessellation_m2, sum * (1 + 1e-8));
    check_most(sum, 2 * r->budget.tessellation_m2 * (1 + 1e-8));
}

static void the_errors_of_parts_are_together_that_of_the_tessellation(void **state)
{
    (void)state;
    const lrcs_build_options coarse = {1e-9, 300, LRCS_NORMALS_FLAT, 1, 0, NULL};
    const lrcs_shape plate = {.kind = LRCS_SHAPE_BOX, .size = {2, 2, 0.25}};
    const double d[3] = {0.48, 0.64, 0.6};
    for (size_t b = 0; b < ROWS(bodies); b++) {
        for (int method = LRCS_METHOD_FACET; method <= LRCS_METHOD_EXACT; method++) {
            shapes_scene s = scene_of(glossy, 0);
            add(&s, bodies[b]);
            lrcs_result alone = shapes_run(&s, &coarse, d, method);
            assert_true(part_error[0] > 0);
            check_part_errors(&alone, 1);
            add(&s, plate)->place.translate[2] = -0.5;
            lrcs_result r = shapes_run(&s, &coarse, d, method);
            check_part_errors(&r, 2);
            check_same(part_error[1], 0); /* a plate has no curved facets */
        }
    }
}

/* What a run that fails was to return is as it was: here for lack of memory, at any point. */
static void a_run_that_fails_leaves_the_errors_of_parts_alone(void **state)
{
    (void)state;
    const lrcs_build_options coarse = {1e-9, 300, LRCS_NORMALS_FLAT, 1, 0, NULL};
    const double d[3] = {0.48, 0.64, 0.6};
    lrcs_run_options run = lrcs_run_options_default();
    lrcs_pose pose;
    lrcs_result result;
    int failed = 0;
    int status = LRCS_E_MEMORY;
    shapes_scene s = scene_of(glossy, 0);
    add(&s, bodies[0]);
    const lrcs_prepared *prepared = shapes_prepare(&s, &coarse);
    run.method = LRCS_METHOD_EXACT;
    run.part_error_m2 = part_error;
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    for (size_t size = run_work.used; status == LRCS_E_MEMORY; size += 256) {
        lrcs_work small = lrcs_work_make(run_area, size < sizeof run_area ? size : sizeof run_area);
        small.used = run_work.used;
        part_error[0] = -7;
        status = lrcs_sigma_run(prepared, &pose, &run, &small, &result, NULL, NULL);
        assert_true(status == LRCS_OK ? part_error[0] > 0 : part_error[0] == -7);
        failed += status != LRCS_OK;
    }
    assert_int_equal(status, LRCS_OK);
    assert_true(failed > 10);
}

/* A part that neither hides nor is hidden by others has the error that it has alone. */
static void a_part_that_no_other_shadows_has_its_error_alone(void **state)
{
    (void)state;
    const lrcs_build_options coarse = {1e-9, 300, LRCS_NORMALS_FLAT, 1, 0, NULL};
    const double d[3] = {0.48, 0.64, 0.6};
    double alone[6];
    shapes_scene all = scene_of(glossy, 0);
    run_tolerance = 1e-9; /* means over patches have a small remainder */
    assert_true(ROWS(bodies) >= 3);
    for (int i = 0; i < 3; i++) {
        shapes_scene s = scene_of(glossy, 0);
        add(&s, bodies[i]);
        shapes_run(&s, &coarse, d, LRCS_METHOD_EXACT);
        alone[i] = part_error[0];
        lrcs_recipe_part *part = add(&all, bodies[i]); /* in a row across the view */
        part->place.translate[0] = 16 * 0.8 * i;
        part->place.translate[1] = 16 * -0.6 * i;
    }
    shapes_run(&all, &coarse, d, LRCS_METHOD_EXACT);
    for (int i = 0; i < 3; i++) {
        check_abs(part_error[i], alone[i], 1e-6 * alone[i] + 1e-11); /* sigma is about 1 */
    }
    run_tolerance = 1e-4;
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_shape_alone_is_its_closed_form_to_rounding),
        cmocka_unit_test(a_shape_alone_is_bounded_by_rounding_at_hard_aspects),
        cmocka_unit_test(a_shape_placed_is_its_closed_form_seen_from_its_frame),
        cmocka_unit_test(closed_forms_lie_within_the_bounds_of_fine_meshes),
        cmocka_unit_test(records_share_out_the_closed_form),
        cmocka_unit_test(a_two_sided_shell_needs_facets_where_its_inside_shows),
        cmocka_unit_test(patches_on_the_limb_of_a_two_sided_shell_count_from_both_sides),
        cmocka_unit_test(an_unevenly_scaled_shape_keeps_its_facets),
        cmocka_unit_test(switched_terms_are_left_out_of_closed_forms_too),
        cmocka_unit_test(shapes_far_apart_are_all_closed_forms),
        cmocka_unit_test(random_scenes_agree_with_clipped_meshes),
        cmocka_unit_test(the_errors_of_parts_are_together_that_of_the_tessellation),
        cmocka_unit_test(a_run_that_fails_leaves_the_errors_of_parts_alone),
        cmocka_unit_test(a_part_that_no_other_shadows_has_its_error_alone),
    };
    if (argc > 2) {
        scenes = (uint32_t)strtoul(argv[1], NULL, 10);
        seed = strtoull(argv[2], NULL, 10);
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
