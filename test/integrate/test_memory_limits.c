/* SPDX-License-Identifier: MIT */
/* Every public function that takes memory from a work area, given it byte by byte: from nothing to
   what its _need says. With too little it returns LRCS_E_MEMORY, takes nothing, touches neither its
   output nor a byte beyond the area, and reports a peak that exceeds the area. If an area suffices,
   so does every larger one; with _need bytes the answer is not degraded. */
#include "build3ds.h"
#include "curved.h"
#include "integrate/cubature/cubature.h"
#include "memory_limit.h"
#include "scene/proximity.h"
#include "scene/proximity_search.h"
#include "scene/solid.h"
#include "scenes.h"
#include "visibility/proximity/proximity_band.h"

static const char text[] =
    "[[material]]\nname='m'\nlike='mli-gold'\n[[part]]\nname='low'\nshape='plate'\n"
    "size=[2,2]\nmaterial='m'\n[[part]]\nname='high'\nshape='plate'\nsize=[1,1]\n"
    "translate=[0.5,0.5,1]\nrotate_axis=[1,0,0]\nrotate_deg=40\n";
static const char object[] =
    "mtllib a.mtl\no a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl x\nf 1 2 3\ng b\n"
    "usemtl y\nf 3 2 1\n";
static const char solid[] = "solid s facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0\n"
                            "vertex 0 1 0 endloop endfacet endsolid";

static build3ds editor;
static unsigned char base_memory[1 << 20];
static lrcs_work base;
static lrcs_recipe recipe;
static lrcs_build_options build;
static lrcs_scene scene;
static const lrcs_prepared *prepared;
static lrcs_pose pose;
static lrcs_run_options options;
static lrcs_shape shape;
static lrcs_divisions divisions;

/* Outputs. */
static struct {
    lrcs_recipe recipe;
    lrcs_mesh mesh;
    lrcs_mesh_report report;
    lrcs_scene scene;
    const lrcs_prepared *prepared;
    lrcs_result result;
    lrcs_polygons polygons;
} out;

static int call_3ds(lrcs_work *work)
{
    return lrcs_3ds_read(editor.bytes, editor.size, work, &out.mesh, NULL);
}

static int call_obj(lrcs_work *work)
{
    return lrcs_obj_read(object, sizeof object - 1, work, &out.mesh, NULL);
}

static int call_stl(lrcs_work *work)
{
    return lrcs_stl_read(solid, sizeof solid - 1, work, &out.mesh, NULL);
}

static int call_shape(lrcs_work *work)
{
    return lrcs_shape_mesh(&shape, &divisions, work, &out.mesh, NULL);
}

static int call_check(lrcs_work *work)
{
    return lrcs_mesh_check(scene.vertex, scene.vertex_count, scene.facet, scene.facet_count, work,
                           &out.report);
}

static int call_recipe(lrcs_work *work)
{
    return lrcs_recipe_read(text, sizeof text - 1, work, &out.recipe, NULL);
}

static int call_scene(lrcs_work *work)
{
    return lrcs_scene_build(&recipe, NULL, &build, work, &out.scene, NULL);
}

static int call_prepare(lrcs_work *work)
{
    return lrcs_prepare_run(&scene, work, &out.prepared);
}

static int call_sigma(lrcs_work *work)
{
    return lrcs_sigma_run(prepared, &pose, &options, work, &out.result, NULL, NULL);
}

static int call_polygons(lrcs_work *work)
{
    return lrcs_polygon_run(prepared, &pose, work, &out.polygons);
}

/* A degraded answer reports how much memory would have sufficed in full. Under auto a raster of
   curved facets may have too little where clipping has enough. */
static int sigma_wanted(size_t wanted, size_t size)
{
    int gives_up = options.method == LRCS_METHOD_AUTO && prepared->has_curved_normals;
    return (out.result.flags & LRCS_FLAG_MEMORY_FALLBACK) ? wanted > size
                                                          : wanted <= size || gives_up;
}

static void setup(void)
{
    build3ds_begin(&editor);
    build3ds_mesh(&editor, "square");
    build3ds_square(&editor, 0);
    build3ds_faces(&editor);
    build3ds_end(&editor);
    base = lrcs_work_make(base_memory, sizeof base_memory);
    build = lrcs_build_options_default();
    options = lrcs_run_options_default();
    options.resolution = 16;
    shape = (lrcs_shape){.kind = LRCS_SHAPE_DOME, .radius = 1};
    divisions = (lrcs_divisions){8, 2, 0};
    assert_int_equal(lrcs_recipe_read(text, sizeof text - 1, &base, &recipe, NULL), LRCS_OK);
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &build, &base, &scene, NULL), LRCS_OK);
    assert_int_equal(lrcs_prepare_run(&scene, &base, &prepared), LRCS_OK);
    assert_int_equal(lrcs_pose_from_azel(20, 60, &pose), LRCS_OK);
}

static void readers_grow_until_they_fit(void **state)
{
    (void)state;
    lrcs_mesh_counts counts;
    setup();
    assert_int_equal(lrcs_3ds_count(editor.bytes, editor.size, &counts, NULL), LRCS_OK);
    check_memory_limit(MEMORY_CASE("3ds", lrcs_mesh_need(&counts), call_3ds, out.mesh, 1));
    assert_int_equal(lrcs_obj_count(object, sizeof object - 1, &counts, NULL), LRCS_OK);
    check_memory_limit(MEMORY_CASE("obj", lrcs_mesh_need(&counts), call_obj, out.mesh, 1));
    assert_int_equal(lrcs_stl_count(solid, sizeof solid - 1, &counts, NULL), LRCS_OK);
    check_memory_limit(MEMORY_CASE("stl", lrcs_mesh_need(&counts), call_stl, out.mesh, 1));
    check_memory_limit(
        MEMORY_CASE("recipe", lrcs_recipe_need(sizeof text - 1), call_recipe, out.recipe, 1));
}

static void building_grows_until_it_fits(void **state)
{
    (void)state;
    setup();
    const lrcs_mesh_counts dome = {33, 48, 0, 1, 8, 0}; /* two zones and a base, at most */
    check_memory_limit(MEMORY_CASE("shape", lrcs_mesh_need(&dome), call_shape, out.mesh, 1));
    check_memory_limit(MEMORY_CASE("check",
                                   lrcs_mesh_check_need(scene.vertex_count, scene.facet_count),
                                   call_check, out.report, 0));
    check_memory_limit(
        MEMORY_CASE("scene", lrcs_scene_need(&recipe, NULL, &build), call_scene, out.scene, 1));
    check_memory_limit(
        MEMORY_CASE("prepare", lrcs_prepare_need(&scene), call_prepare, out.prepared, 1));
}

static void limit_methods(void)
{
    for (int method = LRCS_METHOD_AUTO; method <= LRCS_METHOD_EXACT; method++) {
        options.method = method;
        memory_case sigma =
            *MEMORY_CASE(lrcs_method_text(method), lrcs_sigma_need(prepared, &options), call_sigma,
                         out.result, 0);
        sigma.wanted = sigma_wanted;
        check_memory_limit(&sigma);
        assert_false(out.result.flags & LRCS_FLAG_MEMORY_FALLBACK); /* of the last, at _need */
    }
}

static void a_pose_grows_until_it_fits(void **state)
{
    (void)state;
    setup();
    limit_methods();
    check_memory_limit(
        MEMORY_CASE("polygons", lrcs_polygon_need(prepared), call_polygons, out.polygons, 1));
}

/* The room for cells of the cubature among the rest. */
static void a_pose_over_curved_normals_grows_until_it_fits(void **state)
{
    (void)state;
    static lrcs_point normal[12];
    setup();
    size_t flat = lrcs_sigma_need(prepared, &options);
    assert_int_equal(scene.facet_count, 4);
    for (int i = 0; i < 12; i++) { /* of two plates, the second turned by 40 deg */
        double from_z = i < 6 ? 0.2 * (i % 3 - 1) : 0.7 + 0.2 * (i % 3 - 1);
        normal[i] = (lrcs_point){{0, -sin(from_z), cos(from_z)}};
    }
    scene.corner_normal = normal;
    options.tolerance = 1e-2;
    assert_int_equal(lrcs_prepare_run(&scene, &base, &prepared), LRCS_OK);
    assert_true(lrcs_sigma_need(prepared, &options) >= flat + lrcsi_cubature_need());
    limit_methods();
    assert_true(out.result.curvature_estimate_m2 > 0 && out.result.facets_partial > 0);
}

static lrcs_recipe round_recipe;
static lrcs_mesh round_mesh;
static lrcs_build_options round_options;

static int call_round(lrcs_work *work)
{
    return lrcs_scene_build(&round_recipe, &round_mesh, &round_options, work, &out.scene, NULL);
}

/* The room for the normals of a model among the rest. */
static void building_with_normals_grows_until_it_fits(void **state)
{
    (void)state;
    static char round_text[CURVED_TEXT];
    curved_cylinder(round_text, 8, 0.5, 1, 'v');
    curved_case c = curved_obj(round_text);
    lrcs_recipe_part part = {
        .name = "model", .file = "model", .place = lrcs_place_default(), .material_index = -1};
    round_recipe = (lrcs_recipe){.part = &part, .part_count = 1};
    round_mesh = c.mesh;
    round_options = (lrcs_build_options){1e-2, 64, LRCS_NORMALS_SMOOTH, 1, 0, NULL};
    check_memory_limit(MEMORY_CASE("normals",
                                   lrcs_scene_need(&round_recipe, &round_mesh, &round_options),
                                   call_round, out.scene, 1));
    assert_non_null(out.scene.corner_normal);
    curved_free(&c);
}

/* Where size_t has 32 bits, a product of counts that wrapped would ask for too little. */
static void needs_never_shrink_as_counts_grow(void **state)
{
    (void)state;
    size_t last[4] = {0};
    for (double count = 1; count < 4294967295.0; count *= 1.03) {
        uint32_t n = (uint32_t)count;
        const lrcs_mesh_counts facets = {n, n, 0, 1, 8, 0};
        const lrcs_mesh_counts names = {3, 1, n, n, 8, n};
        const size_t need[4] = {lrcs_mesh_check_need(n, n), lrcs_recipe_need(n),
                                lrcs_mesh_need(&facets), lrcs_mesh_need(&names)};
        for (int i = 0; i < 4; i++) {
            assert_true(need[i] >= last[i] && need[i] >= n);
            last[i] = need[i];
        }
    }
}

/* A step within a run never meets the end of an area of which an earlier one needed more. Given
   little of its own, each says so. */
typedef struct inner_steps {
    lrcs_prepared prepared;
    uint32_t shell[14];
    unsigned char self[14];
    lrcsi_view view;
    lrcsi_classification classification;
    lrcsi_proximity_band margin;
    int proved;
} inner_steps;

static int step_proximity(inner_steps *s, lrcs_work *work)
{
    int status = lrcsi_proximity_make(&s->prepared, work);
    if (status == LRCS_OK && s->prepared.proximity.reach) {
        status = lrcsi_proximity_search(&s->prepared, work);
    }
    work->used = 0; /* the caller's to put back */
    return status;
}

static int step_solid(inner_steps *s, lrcs_work *work)
{
    return lrcsi_solid_find(&s->prepared, &(lrcsi_shells){s->shell, s->self}, work);
}

static int step_convex(inner_steps *s, lrcs_work *work)
{
    return lrcsi_convex_exact(&s->prepared, work, &s->proved);
}

static int step_margin(inner_steps *s, lrcs_work *work)
{
    int status = lrcsi_proximity_band_make(&s->classification, NULL, work, &s->margin);
    assert_true(status == LRCS_OK || work->used == 0);
    work->used = 0;
    return status;
}

static void steps_within_grow_until_they_fit(void **state)
{
    (void)state;
    static int (*const step[])(inner_steps *, lrcs_work *) = {step_proximity, step_solid,
                                                              step_convex, step_margin};
    static test_scene boxed; /* a box that passes for curved, and a plate over it */
    static unsigned char little[1 << 16];
    static inner_steps s;
    scene_start(&boxed);
    scene_box(&boxed, (const double[3]){0, 0, 0}, (const double[3]){1, 1, 1});
    scene_plate(&boxed, (const double[3]){0, 0, 2}, (const double[3]){1, 0, 0},
                (const double[3]){0, 1, 0});
    lrcs_part part[2] = {boxed.part, boxed.part};
    part[0].facet_count = 12;
    part[0].bounds.patch = (lrcs_patch_bounds){0.1, 0.01, 0.01, 0.1};
    part[0].bounds.reach = 0.01;
    part[1].first_facet = 12;
    part[1].facet_count = 2;
    boxed.part_of[12] = boxed.part_of[13] = 1;
    boxed.scene.part = part;
    boxed.scene.part_count = 2;
    lrcs_work work;
    s.prepared = *scene_prepare(&boxed, &work);
    assert_int_equal(lrcs_pose_from_azel(20, 60, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(&s.prepared, &pose, &work, &s.view), LRCS_OK);
    assert_int_equal(lrcsi_view_project(&work, &s.view), LRCS_OK);
    assert_int_equal(lrcsi_classify_make(&s.view, NULL, &work, &s.classification), LRCS_OK);
    for (int i = 0; i < 4; i++) {
        int status = LRCS_E_MEMORY;
        size_t size = 0;
        for (; status == LRCS_E_MEMORY && size <= sizeof little; size++) {
            lrcs_work area = lrcs_work_make(little, size);
            status = step[i](&s, &area);
            assert_int_equal(area.used, 0);
            assert_true(status == LRCS_OK || area.peak > size);
        }
        assert_int_equal(status, LRCS_OK);
        assert_true(size > 100);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(readers_grow_until_they_fit),
        cmocka_unit_test(building_grows_until_it_fits),
        cmocka_unit_test(a_pose_grows_until_it_fits),
        cmocka_unit_test(a_pose_over_curved_normals_grows_until_it_fits),
        cmocka_unit_test(building_with_normals_grows_until_it_fits),
        cmocka_unit_test(needs_never_shrink_as_counts_grow),
        cmocka_unit_test(steps_within_grow_until_they_fit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
