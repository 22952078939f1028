/* SPDX-License-Identifier: MIT */
/* Scenes from recipes: geometry, order, materials, what holds by construction, refusals. */
#include <lrcs/lrcs.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"

#define ROWS(table) (sizeof table / sizeof table[0])

/* A tetrahedron on odd coordinates, outward, one facet of each material state. */
static lrcs_point tetra_vertex[4] = {
    {{0.1, 0.2, 0.3}}, {{1.1, 0.2, 0.3}}, {{0.1, 2.2, 0.3}}, {{0.1, 0.2, 3.3}}};
static lrcs_facet tetra_facet[4] = {{{0, 2, 1}}, {{0, 1, 3}}, {{0, 3, 2}}, {{1, 2, 3}}};
static uint32_t tetra_material[4] = {0, 1, LRCS_NONE, 0};
static uint32_t tetra_part[4] = {0, 0, 0, 0};
static uint32_t tetra_smooth[4] = {1, 0, 0x80000000u, 7};
static lrcs_surface tetra_surface[3] = {{.name = "skin", .rgb = {1, 2, 3}, .has_colour = 1},
                                        {.name = "glass", .transparency = 1.0},
                                        {.name = "unused"}};
static const char *tetra_names[1] = {"tetra"};

static lrcs_mesh tetra(void)
{
    lrcs_mesh mesh = {.vertex_count = 4,
                      .facet_count = 4,
                      .material_count = 3,
                      .part_count = 1,
                      .vertex = tetra_vertex,
                      .facet = tetra_facet,
                      .facet_material = tetra_material,
                      .facet_part = tetra_part,
                      .facet_smooth = tetra_smooth,
                      .material = tetra_surface,
                      .part = tetra_names};
    return mesh;
}

static lrcs_recipe_part model_part(const char *name)
{
    lrcs_recipe_part part = {
        .name = name, .file = "x", .place = lrcs_place_default(), .material_index = -1, .line = 42};
    return part;
}

static lrcs_recipe_part shape_part(int kind, double a, double b, double c)
{
    lrcs_recipe_part part = {
        .name = "shape", .place = lrcs_place_default(), .material_index = -1, .line = 43};
    part.shape.kind = kind;
    if (kind == LRCS_SHAPE_PLATE || kind == LRCS_SHAPE_BOX) {
        part.shape.size[0] = a;
        part.shape.size[1] = b;
        part.shape.size[2] = c;
    } else {
        part.shape.radius = a;
        part.shape.length = b;
        part.shape.radius2 = c;
    }
    return part;
}

/* Builds in a work area of exactly lrcs_scene_need bytes; the caller frees *area. */
static int build_scene(const lrcs_recipe *recipe, const lrcs_mesh *models, void **area,
                       lrcs_scene *scene, lrcs_where *where)
{
    const lrcs_build_options options = {1e-2, 4096, LRCS_NORMALS_FLAT, 1, 0, NULL};
    size_t need = lrcs_scene_need(recipe, models, &options);
    *area = malloc(need);
    assert_non_null(*area);
    lrcs_work work = lrcs_work_make(*area, need);
    int status = lrcs_scene_build(recipe, models, &options, &work, scene, where);
    assert_true(status != LRCS_E_MEMORY);
    assert_true(status == LRCS_OK || work.used == 0);
    return status;
}

static lrcs_mesh_report report_of(const lrcs_scene *scene)
{
    size_t need = lrcs_mesh_check_need(scene->vertex_count, scene->facet_count);
    void *area = malloc(need);
    lrcs_work work = lrcs_work_make(area, need);
    lrcs_mesh_report report;
    assert_non_null(area);
    assert_int_equal(lrcs_mesh_check(scene->vertex, scene->vertex_count, scene->facet,
                                     scene->facet_count, &work, &report),
                     LRCS_OK);
    free(area);
    return report;
}

static void a_model_in_the_default_place_keeps_every_bit(void **state)
{
    (void)state;
    lrcs_mesh mesh = tetra();
    lrcs_recipe_part part = model_part("a");
    lrcs_recipe recipe = {.part = &part, .part_count = 1};
    lrcs_scene scene;
    void *area;
    assert_int_equal(build_scene(&recipe, &mesh, &area, &scene, NULL), LRCS_OK);
    assert_int_equal(scene.vertex_count, 4);
    assert_int_equal(scene.facet_count, 4);
    assert_memory_equal(scene.vertex, tetra_vertex, sizeof tetra_vertex);
    assert_memory_equal(scene.facet, tetra_facet, sizeof tetra_facet);
    assert_memory_equal(scene.facet_smooth, tetra_smooth, sizeof tetra_smooth);
    assert_int_equal(scene.part_count, 1);
    assert_int_equal(scene.part[0].kind, -1);
    assert_int_equal(scene.part[0].bounds.known, 1);
    assert_int_equal(scene.part[0].solid, 0);
    assert_int_equal(scene.part[0].articulated, 0);
    assert_string_equal(scene.part[0].name, "a");
    free(area);
}

static void facets_keep_the_order_of_parts_and_files(void **state)
{
    (void)state;
    lrcs_mesh meshes[3] = {tetra(), {0}, tetra()};
    lrcs_recipe_part parts[3] = {model_part("a"), shape_part(LRCS_SHAPE_PLATE, 2.0, 1.0, 0.0),
                                 model_part("c")};
    lrcs_recipe recipe = {.part = parts, .part_count = 3};
    lrcs_scene scene;
    void *area;
    parts[2].place.translate[0] = 8.0;
    parts[2].joint = (lrcs_joint){1, {1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 0.0};
    assert_int_equal(build_scene(&recipe, meshes, &area, &scene, NULL), LRCS_OK);
    assert_int_equal(scene.facet_count, 10);
    assert_int_equal(scene.part[1].first_facet, 4);
    assert_int_equal(scene.part[1].facet_count, 2);
    assert_int_equal(scene.part[2].first_facet, 6);
    assert_int_equal(scene.part[2].articulated, 1);
    assert_int_equal(scene.facet_part[5], 1);
    assert_int_equal(scene.facet[6].corner[0], scene.vertex_count - 4);
    check_same(scene.vertex[scene.vertex_count - 3].x[0], 1.1 + 8.0);
    free(area);
}

static void mirrored_parts_stay_outward(void **state)
{
    (void)state;
    for (int signs = 0; signs < 8; signs++) {
        lrcs_mesh mesh = tetra();
        lrcs_recipe_part parts[2] = {model_part("a"), shape_part(LRCS_SHAPE_BOX, 1.0, 2.0, 3.0)};
        lrcs_scene scene;
        void *area;
        for (int i = 0; i < 3; i++) {
            parts[0].place.scale[i] = parts[1].place.scale[i] = signs >> i & 1 ? -2.0 : 2.0;
        }
        lrcs_recipe recipe = {.part = parts, .part_count = 1};
        assert_int_equal(build_scene(&recipe, &mesh, &area, &scene, NULL), LRCS_OK);
        check_rel(report_of(&scene).volume, 8.0, 1e-14); /* 1 * 2 * 3 / 6, scaled by 8 */
        free(area);
        recipe.part = &parts[1];
        assert_int_equal(build_scene(&recipe, &mesh, &area, &scene, NULL), LRCS_OK);
        check_same(report_of(&scene).volume, 48.0);
        assert_int_equal(scene.part[0].solid, 1);
        assert_int_equal(scene.part[0].convex_patch, 1);
        check_same(scene.part[0].min_extent, 2.0);
        free(area);
    }
}

static void materials_stand_once_for_each_surface_and_each_worn_one(void **state)
{
    (void)state;
    lrcs_mesh meshes[4] = {tetra(), {0}, {0}, tetra()};
    lrcs_recipe_part parts[4] = {model_part("a"), shape_part(LRCS_SHAPE_PLATE, 1.0, 1.0, 0.0),
                                 shape_part(LRCS_SHAPE_PLATE, 1.0, 1.0, 0.0), model_part("b")};
    lrcs_recipe_material white = {
        .name = "white", .brdf = {0.0, 0.2, 0.0, 0.0}, .two_sided = 1, .line = 5};
    lrcs_recipe recipe = {.part = parts, .part_count = 4, .material = &white, .material_count = 1};
    lrcs_scene scene;
    void *area;
    parts[1].material = parts[2].material = "white";
    parts[1].material_index = 0; /* the other one is found by its name */
    assert_int_equal(build_scene(&recipe, meshes, &area, &scene, NULL), LRCS_OK);
    static const char *const want[] = {"skin",  "glass", "unused", "",
                                       "white", "skin",  "glass",  "unused"};
    assert_int_equal(scene.material_count, ROWS(want));
    for (size_t i = 0; i < ROWS(want); i++) {
        assert_string_equal(scene.material[i].name, want[i]);
        assert_int_equal(scene.material[i].omitted, i == 1 || i == 6);
        assert_int_equal(scene.material[i].brdf_given, i == 4);
        assert_int_equal(scene.material[i].two_sided, i == 4);
    }
    static const uint32_t by_facet[12] = {0, 1, 3, 0, 4, 4, 4, 4, 5, 6, 3, 5};
    assert_memory_equal(scene.facet_material, by_facet, sizeof by_facet);
    assert_int_equal(scene.unmatched, LRCS_NONE);
    free(area);
}

static void a_binding_that_matches_nothing_is_reported(void **state)
{
    (void)state;
    lrcs_mesh mesh = tetra();
    lrcs_recipe_part part = model_part("a");
    lrcs_binding binding[2] = {
        {.kind = LRCS_BIND_NAME, .name = "skin", .brdf = {0.0, 0.1, 0.0, 0.0}, .two_sided = -1},
        {.kind = LRCS_BIND_NAME, .name = "sking", .brdf = {0.0, 0.1, 0.0, 0.0}, .two_sided = -1}};
    lrcs_recipe recipe = {.part = &part, .part_count = 1, .binding = binding, .binding_count = 2};
    lrcs_scene scene;
    void *area;
    assert_int_equal(build_scene(&recipe, &mesh, &area, &scene, NULL), LRCS_OK);
    assert_int_equal(scene.unmatched, 1);
    check_same(scene.material[0].brdf.B, 0.1);
    free(area);
}

/* What is closed, and the least extent of each shape of radius 2, length 3, radius2 1. */
static void shapes_say_what_they_are(void **state)
{
    (void)state;
    static const struct {
        int kind;
        double a, b, c;
        int solid, curved;
        double min_extent;
    } want[] = {
        {LRCS_SHAPE_PLATE, 2, 1, 0, 0, 0, 0},      {LRCS_SHAPE_DISC, 2, 0, 0, 0, 0, 0},
        {LRCS_SHAPE_BOX, 2, 3, 1, 1, 0, 1},        {LRCS_SHAPE_SPHERE, 2, 0, 0, 1, 1, 4},
        {LRCS_SHAPE_DOME, 2, 0, 0, 1, 1, 2},       {LRCS_SHAPE_CYLINDER, 2, 3, 0, 1, 1, 3},
        {LRCS_SHAPE_CONE, 2, 3, 0, 1, 1, 3},       {LRCS_SHAPE_FRUSTUM, 2, 3, 1, 1, 1, 3},
        {LRCS_SHAPE_PARABOLOID, 2, 3, 0, 1, 1, 3}, {LRCS_SHAPE_CYLINDER, 1, 3, 0, 1, 1, 2},
        {LRCS_SHAPE_BOX, 2, 0, 1, 0, 0, 0},
    };
    for (size_t i = 0; i < ROWS(want); i++) {
        lrcs_recipe_part part = shape_part(want[i].kind, want[i].a, want[i].b, want[i].c);
        lrcs_recipe recipe = {.part = &part, .part_count = 1};
        lrcs_scene scene;
        void *area;
        part.place.scale[0] = part.place.scale[1] = part.place.scale[2] = 0.5;
        assert_int_equal(build_scene(&recipe, NULL, &area, &scene, NULL), LRCS_OK);
        assert_int_equal(scene.part[0].kind, want[i].kind);
        assert_int_equal(scene.part[0].solid, want[i].solid);
        assert_int_equal(scene.part[0].convex_patch, 1);
        assert_int_equal(scene.part[0].bounds.known, 1);
        assert_int_equal(scene.part[0].bounds.patch.turn > 0.0, want[i].curved);
        check_same(scene.part[0].min_extent, 0.5 * want[i].min_extent);
        check_most(scene.part[0].bounds.position_err, 1e-12);
        free(area);
        part.place.scale[1] = 0.25; /* not uniform: patches are stretched unevenly */
        part.shape.parts =
            part.shape.kind == LRCS_SHAPE_CYLINDER ? LRCS_SHAPE_WALL : LRCS_SHAPE_ALL;
        assert_int_equal(build_scene(&recipe, NULL, &area, &scene, NULL), LRCS_OK);
        assert_int_equal(scene.part[0].bounds.known, 1);
        assert_int_equal(scene.part[0].bounds.stretch_err > 0.0, want[i].curved);
        assert_int_equal(scene.part[0].convex_patch, 1);
        check_same(scene.part[0].min_extent, 0.25 * want[i].min_extent);
        assert_int_equal(scene.part[0].solid,
                         want[i].kind == LRCS_SHAPE_CYLINDER ? 0 : want[i].solid);
        free(area);
    }
}

/* A matrix that is far from every rotation may stretch patches by anything. */
static void nothing_is_known_of_a_ball_placed_by_no_rotation(void **state)
{
    (void)state;
    lrcs_recipe_part part = shape_part(LRCS_SHAPE_SPHERE, 1, 0, 0);
    lrcs_recipe recipe = {.part = &part, .part_count = 1};
    lrcs_scene scene;
    void *area;
    part.place.rotate[0][1] = 2.0;
    assert_int_equal(build_scene(&recipe, NULL, &area, &scene, NULL), LRCS_OK);
    assert_int_equal(scene.part[0].bounds.known, 0);
    assert_int_equal(scene.part[0].rigid, 0);
    static unsigned char bytes[1u << 26];
    lrcs_work work = lrcs_work_make(bytes, sizeof bytes);
    const lrcs_prepared *prepared;
    lrcs_pose pose;
    lrcs_result result;
    lrcs_run_options run = lrcs_run_options_default();
    assert_int_equal(lrcs_prepare_run(&scene, &work, &prepared), LRCS_OK);
    assert_int_equal(lrcs_pose_from_azel(20, 30, &pose), LRCS_OK);
    for (run.method = LRCS_METHOD_FACET; run.method <= LRCS_METHOD_EXACT; run.method++) {
        assert_int_equal(lrcs_sigma_run(prepared, &pose, &run, &work, &result, NULL, NULL),
                         LRCS_OK);
        assert_true((result.notices & LRCS_NOTICE_TESSELLATION_UNKNOWN) != 0);
        assert_true(result.sigma_m2 > 0 && result.budget.tessellation_m2 < 0);
    }
    free(area);
}

/* The divisions that serve a closed form are more than may be. */
static void a_lone_ball_keeps_to_the_most_facets(void **state)
{
    (void)state;
    lrcs_recipe_part part = shape_part(LRCS_SHAPE_SPHERE, 1, 0, 0);
    lrcs_recipe recipe = {.part = &part, .part_count = 1};
    const lrcs_build_options options = {1e-4, 64, LRCS_NORMALS_FLAT, 0, 0, NULL};
    static unsigned char bytes[1u << 16];
    lrcs_work work = lrcs_work_make(bytes, sizeof bytes);
    lrcs_scene scene;
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &options, &work, &scene, NULL), LRCS_OK);
    assert_true(scene.facet_count > 16 && scene.facet_count <= 64);
}

static void a_cones_length_follows_its_half_angle(void **state)
{
    (void)state;
    lrcs_recipe_part part = shape_part(LRCS_SHAPE_CONE, 1.0, 0.0, 0.0);
    lrcs_recipe recipe = {.part = &part, .part_count = 1};
    lrcs_scene scene;
    void *area;
    part.shape.half_angle_deg = 45.0;
    assert_int_equal(build_scene(&recipe, NULL, &area, &scene, NULL), LRCS_OK);
    check_rel(scene.part[0].min_extent, 1.0, 1e-15);
    free(area);
}

/* A box that is turned and moved: its corners against the same numbers in long double. */
static void misplacement_bounds_what_rounding_does(void **state)
{
    (void)state;
    lrcs_recipe_part part = shape_part(LRCS_SHAPE_BOX, 0.3, 0.7, 1.1);
    lrcs_recipe recipe = {.part = &part, .part_count = 1};
    static const double R[3][3] = {{0.6, -0.8, 0.0}, {0.64, 0.48, -0.6}, {0.48, 0.36, 0.8}};
    lrcs_scene scene;
    void *area;
    memcpy(part.place.rotate, R, sizeof R);
    part.place.translate[0] = 1e6;
    assert_int_equal(build_scene(&recipe, NULL, &area, &scene, NULL), LRCS_OK);
    for (uint32_t i = 0; i < scene.vertex_count; i++) {
        double least = 1.0;
        for (int corner = 0; corner < 8; corner++) {
            const long double v[3] = {(corner & 1 ? 0.5L : -0.5L) * (long double)0.3,
                                      (corner & 2 ? 0.5L : -0.5L) * (long double)0.7,
                                      (corner & 4 ? 0.5L : -0.5L) * (long double)1.1};
            long double off = 0.0L;
            for (int k = 0; k < 3; k++) {
                long double x =
                    (long double)part.place.translate[k] - (long double)scene.vertex[i].x[k];
                for (int j = 0; j < 3; j++) {
                    x += (long double)R[k][j] * v[j];
                }
                off += x * x;
            }
            least = fmin(least, sqrt((double)off));
        }
        check_most(least, scene.part[0].bounds.position_err);
    }
    check_most(scene.part[0].bounds.position_err, 1e-9);
    free(area);
}

static int refused(lrcs_recipe *recipe, lrcs_mesh *mesh, lrcs_where *where)
{
    lrcs_scene scene;
    lrcs_scene before;
    void *area;
    memset(&scene, 0x5a, sizeof scene);
    memcpy(&before, &scene, sizeof scene);
    memset(where, 0, sizeof *where);
    int status = build_scene(recipe, mesh, &area, &scene, where);
    assert_memory_equal(&scene, &before, sizeof scene);
    assert_non_null(where->item);
    assert_non_null(where->expected);
    free(area);
    return status;
}

static void unfit_scenes_are_refused_with_the_parts_name(void **state)
{
    (void)state;
    lrcs_mesh mesh = tetra();
    lrcs_recipe_part part = model_part("culprit");
    lrcs_recipe recipe = {.part = &part, .part_count = 1};
    lrcs_where where;
    lrcs_facet wrong_facet[4];
    part.place.scale[2] = 1e100;
    assert_int_equal(refused(&recipe, &mesh, &where), LRCS_E_NUMBER);
    assert_string_equal(where.found, "culprit");
    assert_int_equal(where.line, 42);
    part.place.scale[2] = 1e308;
    part.place.scale[0] = -1e308;
    assert_int_equal(refused(&recipe, &mesh, &where), LRCS_E_NUMBER);
    part = model_part("culprit");
    part.place.translate[0] = (double)NAN;
    assert_int_equal(refused(&recipe, &mesh, &where), LRCS_E_NUMBER);
    part = model_part("culprit");
    part.place.scale[1] = 0.0;
    assert_int_equal(refused(&recipe, &mesh, &where), LRCS_E_ARGUMENT);
    part = model_part("culprit");
    part.material = "none such";
    part.material_line = 44;
    assert_int_equal(refused(&recipe, &mesh, &where), LRCS_E_NAME);
    assert_string_equal(where.found, "none such");
    assert_int_equal(where.line, 44);
    part = model_part("culprit");
    uint32_t wrong_material[4] = {0, 3, 0, 0};
    mesh.facet_material = wrong_material;
    assert_int_equal(refused(&recipe, &mesh, &where), LRCS_E_INDEX);
    for (int k = 0; k < 3; k++) {
        mesh = tetra();
        memcpy(wrong_facet, mesh.facet, sizeof wrong_facet);
        wrong_facet[1].corner[k] = 4;
        mesh.facet = wrong_facet;
        assert_int_equal(refused(&recipe, &mesh, &where), LRCS_E_INDEX);
        assert_string_equal(where.found, "culprit");
    }
    part.name = NULL;
    part.place.scale[1] = 0.0;
    assert_int_equal(refused(&recipe, &mesh, &where), LRCS_E_ARGUMENT);
    assert_string_equal(where.found, "");
}

static void unfit_shapes_materials_and_options_are_refused(void **state)
{
    (void)state;
    lrcs_recipe_part part = shape_part(LRCS_SHAPE_SPHERE, -1.0, 0.0, 0.0);
    lrcs_recipe recipe = {.part = &part, .part_count = 1};
    lrcs_where where;
    assert_int_equal(refused(&recipe, NULL, &where), LRCS_E_NUMBER);
    assert_string_equal(where.item, "radius");
    assert_int_equal(where.line, 43);
    part.shape.radius = 1.0;
    lrcs_binding bad = {
        .kind = LRCS_BIND_DEFAULT, .brdf = {1.0, 0.0, (double)NAN, 0.0}, .two_sided = -1};
    recipe.binding = &bad;
    recipe.binding_count = 1;
    assert_true(refused(&recipe, NULL, &where) < 0);
    lrcs_mesh mesh = tetra();
    part = model_part("m");
    assert_int_equal(refused(&recipe, &mesh, &where), LRCS_E_NUMBER);
    assert_string_equal(where.item, "material");
    uint32_t none[4] = {LRCS_NONE, LRCS_NONE, LRCS_NONE, LRCS_NONE};
    mesh.facet_material = none;
    mesh.material_count = 0; /* the bad default is worn by the facets themselves */
    assert_int_equal(refused(&recipe, &mesh, &where), LRCS_E_NUMBER);
    assert_string_equal(where.item, "material");
    part = shape_part(LRCS_SHAPE_SPHERE, 1.0, 0.0, 0.0);
    part.material = "none such";
    assert_int_equal(refused(&recipe, NULL, &where), LRCS_E_NAME);
    assert_string_equal(where.found, "none such");
    recipe.binding_count = 0;
    part = shape_part(LRCS_SHAPE_SPHERE, 1.0, 0.0, 0.0);
    part.place.scale[1] = 0;
    for (int only = LRCS_FACETS_BASE; only <= LRCS_FACETS_LOCAL; only++) {
        static unsigned char area[1u << 20];
        const lrcs_build_options coarse = {0.1, 4096, LRCS_NORMALS_FLAT, only, 0, NULL};
        lrcs_work work = lrcs_work_make(area, sizeof area);
        lrcs_scene scene;
        assert_int_equal(lrcs_scene_build(&recipe, NULL, &coarse, &work, &scene, &where),
                         LRCS_E_ARGUMENT);
        assert_int_equal(work.used, 0);
    }
    part = model_part("m");
    static const lrcs_build_options options[] = {{0.0, 64, 0, 0, 0, NULL},
                                                 {(double)NAN, 64, 0, 0, 0, NULL},
                                                 {HUGE_VAL, 64, 0, 0, 0, NULL},
                                                 {1e-3, 63, 0, 0, 0, NULL},
                                                 {1e-3, 64, LRCS_NORMALS_SMOOTH + 1, 0, 0, NULL},
                                                 {1e-3, 64, 0, 0, -1, NULL},
                                                 {1e-3, 64, 0, 0, HUGE_VAL, NULL}};
    recipe.binding_count = 0;
    for (size_t i = 0; i < ROWS(options); i++) {
        lrcs_work work = lrcs_work_make(NULL, 0);
        lrcs_scene scene;
        assert_int_equal(lrcs_scene_build(&recipe, &mesh, &options[i], &work, &scene, &where),
                         LRCS_E_ARGUMENT);
    }
}

static void too_small_an_area_is_refused_until_it_suffices(void **state)
{
    (void)state;
    lrcs_mesh meshes[2] = {tetra(), {0}};
    lrcs_recipe_part parts[2] = {model_part("a"), shape_part(LRCS_SHAPE_CYLINDER, 1.0, 2.0, 0.0)};
    lrcs_recipe recipe = {.part = parts, .part_count = 2};
    const lrcs_build_options options = {1e-1, 64, LRCS_NORMALS_FLAT, 1, 0, NULL};
    size_t need = lrcs_scene_need(&recipe, meshes, &options);
    int status = LRCS_E_MEMORY;
    for (size_t size = 0; status == LRCS_E_MEMORY && size <= need; size += 13) {
        unsigned char *area = malloc(size + 1);
        lrcs_work work = lrcs_work_make(area, size);
        lrcs_where where = {0};
        lrcs_scene scene;
        assert_non_null(area);
        status = lrcs_scene_build(&recipe, meshes, &options, &work, &scene, &where);
        if (status != LRCS_OK) {
            assert_int_equal(status, LRCS_E_MEMORY);
            assert_int_equal(work.used, 0);
            assert_true(work.peak > size);
        }
        free(area);
    }
    assert_int_equal(status, LRCS_OK);
}

/* test/vectors/scene_hash.py */
static void the_hash_is_fnv_1a_of_what_it_says(void **state)
{
    (void)state;
    lrcs_point vertex[3] = {{{0.0, -0.0, 0.0}}, {{1.0, 0.0, 0.25}}, {{0.0, 2.0, -0.5}}};
    lrcs_facet facet = {{0, 1, 2}};
    uint32_t material = 0;
    uint32_t smooth = 5;
    lrcs_material assigned = {.name = "a", .brdf = {0.5, 0.25, 0.125, 0.0}, .two_sided = 1};
    lrcs_scene scene = {.vertex_count = 3,
                        .facet_count = 1,
                        .material_count = 1,
                        .vertex = vertex,
                        .facet = &facet,
                        .facet_material = &material,
                        .facet_smooth = &smooth,
                        .material = &assigned};
    const uint64_t want = UINT64_C(0xd8844c0ee612acd5);
    assert_true(lrcs_scene_hash(&scene) == want);
    assigned.name = "b"; /* names and colours say nothing of sigma */
    assigned.rgb[0] = 7;
    assert_true(lrcs_scene_hash(&scene) == want);
    assigned.two_sided = 0;
    assert_true(lrcs_scene_hash(&scene) != want);
    assigned.two_sided = 1;
    vertex[2].x[1] = 2.0000000000000004;
    assert_true(lrcs_scene_hash(&scene) != want);
}

/* The example: ten parts, closed forms of their areas, one reader after the other. */
static void the_demonstration_satellite_builds(void **state)
{
    (void)state;
    static char text[8192];
    static unsigned char bytes[1 << 19];
    FILE *file = fopen("examples/satellite.toml", "rb");
    if (!file) {
        print_message("examples/satellite.toml is not here: run from the root\n");
        skip();
    }
    size_t size = fread(text, 1, sizeof text, file);
    fclose(file);
    lrcs_work work = lrcs_work_make(bytes, sizeof bytes);
    lrcs_recipe recipe;
    lrcs_scene scene;
    void *area;
    assert_int_equal(lrcs_recipe_read(text, size, &work, &recipe, NULL), LRCS_OK);
    assert_int_equal(build_scene(&recipe, NULL, &area, &scene, NULL), LRCS_OK);
    assert_int_equal(scene.part_count, 10);
    for (uint32_t i = 0; i < scene.facet_count; i++) {
        assert_int_equal(scene.material[scene.facet_material[i]].brdf_given, 1);
    }
    lrcs_mesh_report report = report_of(&scene);
    /* bus 11.52, radiator 1.5, yokes 2 x 0.1272, wings 2 x 5.42, cells 2 x 2.5016; dish: cone
       wall pi R sqrt(R^2 + H^2) = 0.845900; nozzle: wall pi 0.28
       sqrt(0.0144 + 0.09) + discs pi (0.04 + 0.0064) = 0.429992. Curved parts are inscribed or
       circumscribed to 1e-3 of their sigma (ten times the tolerance, among other parts), here to
       less of the whole area, of which they are a twentieth. */
    double flat = 11.52 + 1.5 + 2 * 0.1272 + 2 * 5.42 + 2 * 2.5016;
    check_rel(report.area, flat + 0.845900 + 0.429992, 5e-4);
    check_rel(report.box_max[0], 3.5, 1e-12);
    check_rel(report.box_min[2], -1.2, 1e-12);
    check_rel(report.box_max[2], 1.2, 1e-12);
    free(area);
}

/* Nothing of that size is looked at: counts are summed first. Seventy cylinders as fine as can be
   pass 2^32 facets together. */
static void more_than_indices_reach_is_refused(void **state)
{
    (void)state;
    enum { N = 70 };
    static lrcs_recipe_part parts[N];
    static const char *const found[] = {"b", "a", "shape"};
    const lrcs_build_options options = {1e-300, UINT32_MAX, LRCS_NORMALS_FLAT, 1, 0, NULL};
    for (int i = 0; i < 3; i++) {
        lrcs_mesh meshes[2] = {tetra(), tetra()};
        lrcs_recipe recipe = {.part = parts, .part_count = i < 2 ? 2 : N};
        for (uint32_t k = 0; k < recipe.part_count; k++) {
            parts[k] = i < 2 ? model_part(found[1 - k]) : shape_part(LRCS_SHAPE_CYLINDER, 1, 1, 0);
        }
        meshes[0].vertex_count = i == 0 ? LRCS_NONE - 4 : 4;
        meshes[0].material_count = i == 1 ? LRCS_NONE - 4 : 3;
        unsigned char area[16 * N];
        lrcs_work work = lrcs_work_make(area, sizeof area);
        lrcs_where where = {0};
        lrcs_scene scene;
        assert_int_equal(lrcs_scene_build(&recipe, meshes, &options, &work, &scene, &where),
                         LRCS_E_LIMIT);
        assert_string_equal(where.found, found[i]);
        assert_int_equal(work.used, 0);
    }
}

/* A rim is divided for its shadows up to a million corners; beyond, for itself alone. */
static void a_rim_no_count_can_refine_stays_as_its_disc_has_it(void **state)
{
    (void)state;
    lrcs_recipe_part parts[2] = {shape_part(LRCS_SHAPE_DISC, 1, 0, 0),
                                 shape_part(LRCS_SHAPE_DISC, 1, 0, 0)};
    lrcs_recipe recipe = {.part = parts, .part_count = 2};
    const lrcs_build_options options = {1e-12, 256, LRCS_NORMALS_FLAT, 1, 0, NULL};
    static unsigned char area[1 << 17];
    lrcs_work work = lrcs_work_make(area, sizeof area);
    lrcs_scene scene;
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &options, &work, &scene, NULL), LRCS_OK);
    lrcs_divisions divisions;
    lrcs_mesh_counts counts;
    const lrcs_fineness fineness = {1e-12, lrcs_brdf_default(), 256};
    assert_int_equal(lrcs_shape_count(&parts[0].shape, &fineness, &divisions, &counts), LRCS_OK);
    assert_int_equal(scene.facet_count, 2 * counts.facets);
}

static uint32_t facets_of(const lrcs_recipe *recipe, const lrcs_build_options *options)
{
    static unsigned char area[1u << 23];
    lrcs_work work = lrcs_work_make(area, sizeof area);
    lrcs_scene scene;
    assert_int_equal(lrcs_scene_build(recipe, NULL, options, &work, &scene, NULL), LRCS_OK);
    return scene.facet_count;
}

/* A ball alone has fewer facets where they represent patches of it; not if each of them is to be
   good by itself, nor where a glint is too narrow or a lobe too steep for the rules of patches, nor
   if it is not placed as it is. */
static void a_lone_ball_is_divided_for_what_its_facets_are_for(void **state)
{
    (void)state;
    static const lrcs_brdf odd[] = {{1, 0.25, 1e-7, 0.5}, {0, 0.25, 0.2, 60}, {1, 0.25, 0.2, 0.5}};
    lrcs_recipe_part part = shape_part(LRCS_SHAPE_SPHERE, 1, 0, 0);
    lrcs_binding binding = {.kind = LRCS_BIND_DEFAULT, .brdf = odd[2], .two_sided = -1};
    lrcs_recipe recipe = {.part = &part, .part_count = 1, .binding = &binding, .binding_count = 1};
    lrcs_build_options options = {1e-4, 60000, LRCS_NORMALS_FLAT, LRCS_FACETS_TOTAL, 0, NULL};
    uint32_t total = facets_of(&recipe, &options);
    options.facets_only = LRCS_FACETS_BASE;
    uint32_t base = facets_of(&recipe, &options);
    options.facets_only = LRCS_FACETS_LOCAL;
    uint32_t local = facets_of(&recipe, &options);
    assert_true(base < 2000 && base < total && total < local);
    options.facets_only = LRCS_FACETS_TOTAL;
    for (int i = 0; i < 2; i++) {
        binding.brdf = odd[i];
        options.max_facets = 8000;
        uint32_t most = facets_of(&recipe, &options);
        options.facets_only = LRCS_FACETS_LOCAL;
        assert_int_equal(most, facets_of(&recipe, &options));
        options.facets_only = LRCS_FACETS_TOTAL;
    }
    binding.brdf = odd[2];
    options.tolerance = 1e-12; /* more than a million corners */
    assert_true(facets_of(&recipe, &options) <= options.max_facets);
    options.tolerance = 1e-3;
    uint32_t round = facets_of(&recipe, &options);
    options.max_facets = 60000;
    part.place.scale[0] = 2;
    uint32_t stretched = facets_of(&recipe, &options);
    part.place.scale[0] = 1e5; /* no number would do */
    uint32_t needle = facets_of(&recipe, &options);
    assert_true(stretched > round && needle <= stretched);
    options.facets_only = LRCS_FACETS_BASE; /* it has no closed form */
    assert_int_equal(facets_of(&recipe, &options), needle);
}

/* A division that is asked for replaces the tolerance of shapes among others. */
static void a_division_is_what_shapes_are_divided_for(void **state)
{
    (void)state;
    lrcs_recipe_part part[2] = {shape_part(LRCS_SHAPE_SPHERE, 1, 0, 0),
                                shape_part(LRCS_SHAPE_CYLINDER, 1, 1, 0)};
    lrcs_recipe recipe = {.part = part, .part_count = 2};
    lrcs_build_options options = {0.5, 60000, LRCS_NORMALS_FLAT, LRCS_FACETS_TOTAL, 0, NULL};
    uint32_t least = facets_of(&recipe, &options);
    options.division = 1e-2;
    uint32_t some = facets_of(&recipe, &options);
    options.division = 1e-3;
    uint32_t more = facets_of(&recipe, &options);
    assert_true(least < some && some < more);
    options.tolerance = 1e-2; /* which no longer counts */
    assert_int_equal(facets_of(&recipe, &options), more);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_model_in_the_default_place_keeps_every_bit),
        cmocka_unit_test(facets_keep_the_order_of_parts_and_files),
        cmocka_unit_test(mirrored_parts_stay_outward),
        cmocka_unit_test(materials_stand_once_for_each_surface_and_each_worn_one),
        cmocka_unit_test(a_binding_that_matches_nothing_is_reported),
        cmocka_unit_test(shapes_say_what_they_are),
        cmocka_unit_test(nothing_is_known_of_a_ball_placed_by_no_rotation),
        cmocka_unit_test(a_lone_ball_keeps_to_the_most_facets),
        cmocka_unit_test(a_lone_ball_is_divided_for_what_its_facets_are_for),
        cmocka_unit_test(a_division_is_what_shapes_are_divided_for),
        cmocka_unit_test(a_cones_length_follows_its_half_angle),
        cmocka_unit_test(misplacement_bounds_what_rounding_does),
        cmocka_unit_test(unfit_scenes_are_refused_with_the_parts_name),
        cmocka_unit_test(unfit_shapes_materials_and_options_are_refused),
        cmocka_unit_test(too_small_an_area_is_refused_until_it_suffices),
        cmocka_unit_test(the_hash_is_fnv_1a_of_what_it_says),
        cmocka_unit_test(the_demonstration_satellite_builds),
        cmocka_unit_test(more_than_indices_reach_is_refused),
        cmocka_unit_test(a_rim_no_count_can_refine_stays_as_its_disc_has_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
