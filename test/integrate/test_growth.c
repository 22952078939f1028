/* SPDX-License-Identifier: MIT */
/* How many steps exact visibility takes where many facets overlap. Clipping facet by facet took the
   third power of n: each test says how many for 1,000, or 300. Limits are 1.5 times what cells of
   the view plane take, and how much more that is for twice the facets. (A vertex far away:
   test_far.c.) */
#include "scenes.h"

static test_scene scene;

static void triangle(double ax, double ay, double az, double bx, double by, double bz, double cx,
                     double cy, double cz)
{
    scene_triangle(&scene, (const double[3]){ax, ay, az}, (const double[3]){bx, by, bz},
                   (const double[3]){cx, cy, cz});
}

/* n level strips over n level strips across. */
static void make_hatch(int n)
{
    double wide = 0.5 / n;
    for (int i = 0; i < n; i++) {
        double at = (double)i / n;
        scene_plate(&scene, (const double[3]){0, at, 0}, (const double[3]){1, 0, 0},
                    (const double[3]){0, wide, 0});
        scene_plate(&scene, (const double[3]){at, 0, -1}, (const double[3]){wide, 0, 0},
                    (const double[3]){0, 1, 0});
    }
}

/* n triangles in a stack, so close that each shows a strip of the last bits of its width. */
static void make_stack(int n)
{
    double z = 0;
    for (int i = 0; i < n; i++) {
        triangle(0, 0, z, 1, 0, z, 0, 1, z);
        z += 1e-6;
    }
}

/* n pages about one spine. */
static void make_book(int n)
{
    uint32_t spine = scene_vertex(&scene, 0, 0, 0);
    scene_vertex(&scene, 0, 0, 1);
    for (int i = 0; i < n; i++) {
        double angle = 2 * (double)SCENE_PI * i / n;
        uint32_t v = scene_vertex(&scene, cos(angle), sin(angle), 1);
        scene_vertex(&scene, cos(angle), sin(angle), 0);
        scene_facet(&scene, spine, spine + 1, v);
        scene_facet(&scene, spine, v, v + 1);
    }
}

/* The wall of a cylinder over a star of n points. */
static void make_star(int n)
{
    uint32_t first = scene.scene.vertex_count;
    uint32_t count = 2 * (uint32_t)n;
    for (int z = 0; z < 2; z++) {
        for (uint32_t i = 0; i < count; i++) {
            double r = i % 2 == 1 ? 1 : 0.9;
            double angle = (double)SCENE_PI * i / n;
            scene_vertex(&scene, r * cos(angle), r * sin(angle), z);
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        uint32_t j = (i + 1) % count;
        scene_facet(&scene, first + i, first + j, first + j + count);
        scene_facet(&scene, first + i, first + j + count, first + i + count);
    }
}

/* A wall in n folds. */
static void make_zigzag(int n)
{
    uint32_t first = scene.scene.vertex_count;
    for (int i = 0; i <= n; i++) {
        for (int z = 0; z < 2; z++) {
            scene_vertex(&scene, (double)i / n, 0.5 * (i % 2), z);
        }
    }
    for (int i = 0; i < n; i++) {
        uint32_t v = first + 2 * (uint32_t)i;
        scene_facet(&scene, v, v + 2, v + 3);
        scene_facet(&scene, v, v + 3, v + 1);
    }
}

/* Triangles turned against each other, one above the other. */
static void make_turned(int n)
{
    for (int i = 0; i < n; i++) {
        double corner[3][3];
        for (int k = 0; k < 3; k++) {
            double angle = 2 * (double)SCENE_PI * (0.381966 * i + k / 3.0);
            corner[k][0] = cos(angle);
            corner[k][1] = sin(angle);
            corner[k][2] = 1e-3 * i;
        }
        scene_triangle(&scene, corner[0], corner[1], corner[2]);
    }
}

/* A plate behind a sphere with n facets around. */
static void make_sphere(int n)
{
    scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, (uint32_t)n);
    scene_plate(&scene, (const double[3]){-3, -3, -4}, (const double[3]){6, 0, 0},
                (const double[3]){0, 6, 0});
}

/* A plate behind a flat ring of 2 n facets. */
static void make_ring(int n)
{
    uint32_t first = scene.scene.vertex_count;
    uint32_t count = 2 * (uint32_t)n;
    for (int i = 0; i < n; i++) {
        double angle = 2 * (double)SCENE_PI * i / n;
        for (int k = 0; k < 2; k++) {
            scene_vertex(&scene, (1 - 0.1 * k) * cos(angle), (1 - 0.1 * k) * sin(angle), 0);
        }
    }
    for (uint32_t i = 0; i < count; i += 2) {
        uint32_t j = (i + 2) % count;
        scene_facet(&scene, first + i, first + j, first + j + 1);
        scene_facet(&scene, first + i, first + j + 1, first + i + 1);
    }
    scene_plate(&scene, (const double[3]){-3, -3, -4}, (const double[3]){6, 0, 0},
                (const double[3]){0, 6, 0});
}

enum { HATCH, STACK, BOOK, STAR, ZIGZAG, TURNED, SPHERE, RING };

static uint64_t steps_of(int kind, int n, const double direction[3])
{
    scene_start(&scene);
    scene.material[0].two_sided = 1;
    switch (kind) {
    case HATCH:
        make_hatch(n);
        break;
    case STACK:
        make_stack(n);
        break;
    case BOOK:
        make_book(n);
        break;
    case STAR:
        make_star(n);
        break;
    case ZIGZAG:
        make_zigzag(n);
        break;
    case TURNED:
        make_turned(n);
        break;
    case RING:
        make_ring(n);
        break;
    default:
        make_sphere(n);
        break;
    }
    lrcs_result r = scene_run(&scene, direction, LRCS_METHOD_EXACT, 0);
    assert_int_equal(r.flags, 0);
    check_most(r.bound_m2, 1e-8 * r.sigma_m2);
    return r.steps;
}

/* A scene of size n takes at most so many steps, and at most so many times those of size n / 2. */
static void check_growth(int kind, int n, const double direction[3], uint64_t most, double times)
{
    double half = (double)steps_of(kind, n / 2, direction);
    uint64_t all = steps_of(kind, n, direction);
    assert_true(all <= most);
    check_most((double)all, times * half);
}

static const double oblique[3] = {0.3, 0.2, 0.9};

/* Where strips cross, there are n^2 pieces to be seen. Clipping took 1.2e9 steps for 300. */
static void hatch_takes_steps_like_its_pieces(void **state)
{
    (void)state;
    check_growth(HATCH, 200, (const double[3]){0, 0, 1}, 3800000, 4.6);
    check_growth(HATCH, 400, oblique, 8300000, 4.6);
}

/* 1.7e9 for 1,000. */
static void stack_hides_all_but_slivers_once(void **state)
{
    (void)state;
    check_growth(STACK, 1000, oblique, 3600000, 3.4);
}

/* 2.5e8; pages share the spine, so that all stand in each cell along it. */
static void book_hides_its_pages_once(void **state)
{
    (void)state;
    check_growth(BOOK, 1000, oblique, 5800000, 4.6);
}

static void star_hides_its_folds_once(void **state)
{
    (void)state;
    check_growth(STAR, 1000, oblique, 1600000, 3.2);
}

/* 3.4e9. */
static void zigzag_hides_its_folds_once(void **state)
{
    (void)state;
    check_growth(ZIGZAG, 1000, oblique, 1900000, 3.8);
    check_growth(ZIGZAG, 1000, (const double[3]){0.9, 0.3, 0.2}, 2000000, 4.2);
}

static void turned_stack_takes_linear_steps(void **state)
{
    (void)state;
    check_growth(TURNED, 1000, oblique, 610000, 2.6);
    check_growth(TURNED, 1000, (const double[3]){0, 0, 1}, 670000, 2.6);
}

/* 1.3e6, and 6.8 times those of a quarter of the facets: every cell along the edge of the shadow was
   compared with all facets of the sphere. */
static void cells_of_a_large_facet_are_compared_with_the_facets_before_them(void **state)
{
    (void)state;
    check_growth(SPHERE, 88, oblique, 245000, 4.6);
}

/* Two facets are undecided, each crossed by half of the ring's edges: one by one they took 1.8e6
   steps, and 2.8 times those with half the edges. */
static void few_facets_crossed_by_many_edges_are_divided_together(void **state)
{
    (void)state;
    check_growth(RING, 4000, oblique, 1300000, 2.6);
}

/* The steps of an open wall alone, scaled unevenly, into which the laser looks. */
static uint64_t wall_steps(int kind)
{
    static unsigned char built_area[1u << 22], prepared_area[1u << 24];
    lrcs_recipe_part part = {.name = "", .place = lrcs_place_default(), .material_index = -1};
    part.shape = (lrcs_shape){.kind = kind, .parts = LRCS_SHAPE_WALL, .radius = 1, .length = 2};
    part.shape.radius2 = kind == LRCS_SHAPE_FRUSTUM ? 0.5 : 0;
    part.place.scale[1] = 0.5;
    part.place.scale[2] = 2;
    lrcs_binding binding = {.kind = LRCS_BIND_DEFAULT, .brdf = lrcs_brdf_default()};
    const lrcs_recipe recipe = {
        .part = &part, .part_count = 1, .binding = &binding, .binding_count = 1};
    lrcs_build_options build = lrcs_build_options_default();
    lrcs_run_options options = lrcs_run_options_default();
    const lrcs_prepared *prepared;
    lrcs_scene built;
    lrcs_pose pose;
    lrcs_result r;
    build.tolerance = 4e-6;
    lrcs_work work = lrcs_work_make(built_area, sizeof built_area);
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &build, &work, &built, NULL), LRCS_OK);
    work = lrcs_work_make(prepared_area, sizeof prepared_area);
    assert_int_equal(lrcs_prepare_run(&built, &work, &prepared), LRCS_OK);
    work = lrcs_work_make(scene_memory, sizeof scene_memory);
    assert_int_equal(lrcs_pose_from_direction((const double[3]){0.4, 0.9, -0.3}, &pose), LRCS_OK);
    options.method = LRCS_METHOD_EXACT;
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &r, NULL, NULL), LRCS_OK);
    assert_int_equal(r.flags, 0);
    assert_true(r.facets_total > 2000);
    assert_true(r.back_side_area_m2 > 0);
    return r.steps;
}

/* The facets of a wall are long and narrow, and those near its silhouette overlap. One by one they
   took 3e7 to 1.3e8 steps. */
static void open_wall_hides_its_inside_once(void **state)
{
    (void)state;
    check_most((double)wall_steps(LRCS_SHAPE_CONE), 1.5e6);
    check_most((double)wall_steps(LRCS_SHAPE_CYLINDER), 1.2e7);
    check_most((double)wall_steps(LRCS_SHAPE_FRUSTUM), 1.4e7);
}

/* The steps of a cylinder that a cone pierces. */
static uint64_t pierced_steps(double tolerance, uint32_t *facets)
{
    static unsigned char built_area[1u << 23], prepared_area[1u << 26];
    static const double along[2][3][3] = {{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}},
                                          {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}};
    lrcs_recipe_part part[2] = {{.name = "cylinder", .material_index = -1},
                                {.name = "cone", .material_index = -1}};
    for (int i = 0; i < 2; i++) {
        part[i].place = lrcs_place_default();
        memcpy(part[i].place.rotate, along[i], sizeof along[i]);
        part[i].place.translate[0] = i == 0 ? 0.5 : 0;
        part[i].place.translate[1] = i == 0 ? 0 : 1.5;
        part[i].shape = (lrcs_shape){.kind = i == 0 ? LRCS_SHAPE_CYLINDER : LRCS_SHAPE_CONE,
                                     .radius = i == 0 ? 2.1 : 1.4,
                                     .length = i == 0 ? 8.5 : 2.6};
    }
    lrcs_binding binding = {.kind = LRCS_BIND_DEFAULT, .brdf = lrcs_brdf_default()};
    const lrcs_recipe recipe = {
        .part = part, .part_count = 2, .binding = &binding, .binding_count = 1};
    lrcs_build_options build = lrcs_build_options_default();
    lrcs_run_options options = lrcs_run_options_default();
    const lrcs_prepared *prepared;
    lrcs_scene built;
    lrcs_pose pose;
    lrcs_result r;
    build.tolerance = tolerance;
    lrcs_work work = lrcs_work_make(built_area, sizeof built_area);
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &build, &work, &built, NULL), LRCS_OK);
    work = lrcs_work_make(prepared_area, sizeof prepared_area);
    assert_int_equal(lrcs_prepare_run(&built, &work, &prepared), LRCS_OK);
    work = lrcs_work_make(scene_memory, sizeof scene_memory);
    assert_int_equal(lrcs_pose_from_direction((const double[3]){0.72, 0.604, 0.342}, &pose),
                     LRCS_OK);
    options.method = LRCS_METHOD_EXACT;
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &r, NULL, NULL), LRCS_OK);
    *facets = r.facets_total;
    return r.steps;
}

/* 7.4e6: some large facets that both shapes have in front of them were processed alone, for an
   accuracy far beyond that of the shapes. */
static void intersecting_shapes_are_divided_together(void **state)
{
    (void)state;
    uint32_t facets;
    const uint64_t steps = pierced_steps(3.125e-6, &facets);
    assert_true(facets > 25000);
    check_most((double)steps, 6.1e6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hatch_takes_steps_like_its_pieces),
        cmocka_unit_test(stack_hides_all_but_slivers_once),
        cmocka_unit_test(book_hides_its_pages_once),
        cmocka_unit_test(star_hides_its_folds_once),
        cmocka_unit_test(zigzag_hides_its_folds_once),
        cmocka_unit_test(cells_of_a_large_facet_are_compared_with_the_facets_before_them),
        cmocka_unit_test(few_facets_crossed_by_many_edges_are_divided_together),
        cmocka_unit_test(turned_stack_takes_linear_steps),
        cmocka_unit_test(open_wall_hides_its_inside_once),
        cmocka_unit_test(intersecting_shapes_are_divided_together),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
