/* SPDX-License-Identifier: MIT */
/* Runs with a limit of steps. Below the number that suffices they stop at the limit and say so,
   and their bounds contain the answer without a limit; from there on they give that answer, to
   the bit. */
#include "scenes.h"

#include "scene/prepare.h"

static test_scene scene;
static unsigned char scene_area[4u << 20];
static lrcs_work work;
static const lrcs_prepared *prepared;
static lrcs_pose pose;
static lrcs_run_options options;
static lrcs_result truth; /* by clipping */
static lrcs_facet_record record[SCENE_FACETS];

static lrcs_result run(int method, uint64_t steps)
{
    lrcs_result r;
    options.method = method;
    options.steps = steps;
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &r, record, NULL), LRCS_OK);
    return r;
}

/* An answer with a limit is less accurate than one without, but not wrong. Returns what true curves
   may cost: the more steps, the less. */
static double check_part(const lrcs_result *all, int method, uint64_t steps)
{
    lrcs_result r = run(method, steps);
    assert_true(r.steps <= steps);
    assert_true(r.flags & LRCS_FLAG_STEPS_SPENT);
    assert_int_equal(r.method, all->method);
    double cubature =
        prepared->has_curved_normals ? r.curvature_estimate_m2 + truth.curvature_estimate_m2 : 0;
    check_abs(r.sigma_m2, truth.sigma_m2, r.bound_m2 + truth.bound_m2 + cubature);
    check_most(cubature, 2 * options.tolerance * truth.sigma_m2); /* what is left is in the bound */
    double least = 1 - 1e-9;
    assert_true(r.budget.tessellation_m2 >= least * all->budget.tessellation_m2);
    if (method == LRCS_METHOD_ZBUFFER) {
        assert_true(r.bound_m2 >= least * all->bound_m2);
        assert_true(r.resolution <= all->resolution); /* a finer one would not find them */
    }
    for (uint32_t f = 0; f < prepared->scene->facet_count; f++) {
        double whole = record[f].area_m2 * fabs(record[f].cos_theta);
        assert_true(record[f].visible_area_m2 >= 0);
        assert_true(record[f].visible_area_m2 <= whole * (1 + 1e-12));
    }
    return r.budget.tessellation_m2;
}

/* Every number of steps, in strides that grow by one part in `fine`. */
static void check_method(int method, uint32_t fine)
{
    lrcs_result all = run(method, 0);
    assert_true(all.steps > 0);
    assert_false(all.flags & LRCS_FLAG_STEPS_SPENT);
    double curves = HUGE_VAL;
    for (uint64_t steps = 1; steps < all.steps; steps += 1 + steps / fine) {
        double less = check_part(&all, method, steps);
        assert_true(less <= curves * (1 + 1e-9));
        curves = less;
    }
    check_part(&all, method, all.steps - 1);
    /* saying how far it is changes nothing, and ends in the last stage */
    lrcs_progress progress = {.total = 1};
    options.progress = &progress;
    lrcs_result shown = run(method, 0);
    options.progress = NULL;
    assert_memory_equal(&shown.sigma_m2, &all.sigma_m2, sizeof shown.sigma_m2);
    assert_memory_equal(&shown.bound_m2, &all.bound_m2, sizeof shown.bound_m2);
    assert_int_equal(progress.stage, LRCS_PROGRESS_INTEGRATE);
    assert_true(progress.done <= progress.total);
    for (uint64_t more = 0; more < 2; more++) {
        lrcs_result same = run(method, all.steps + more);
        assert_memory_equal(&same.sigma_m2, &all.sigma_m2, sizeof same.sigma_m2);
        assert_memory_equal(&same.bound_m2, &all.bound_m2, sizeof same.bound_m2);
        assert_int_equal(same.steps, all.steps);
        assert_int_equal(same.flags, all.flags);
    }
}

#define ALL_STEPS 1000000u

static void run_exact(double x, double y, double z, double tolerance)
{
    assert_int_equal(lrcs_pose_from_direction((const double[3]){x, y, z}, &pose), LRCS_OK);
    options = lrcs_run_options_default();
    options.tolerance = tolerance;
    truth = run(LRCS_METHOD_EXACT, 0);
}

static void sheets(uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        double z = 0x1p-4 * i;
        scene_plate(&scene, (const double[3]){z, 0.5 * z, z}, (const double[3]){1, 0, 0},
                    (const double[3]){0, 1, 0});
    }
}

/* Contours cross facets: cells, candidates, sheets that screen. */
static void sheets_over_each_other(void **state)
{
    (void)state;
    for (uint32_t count = 2; count <= 12; count += 5) {
        scene_start(&scene);
        scene_material(&scene, 1, 0.5, 0.1, 2)->two_sided = 1;
        sheets(count);
        prepared = scene_prepare(&scene, &work);
        run_exact(0.25, -0.5, 1, 1e-4);
        check_method(LRCS_METHOD_EXACT, count < 5 ? ALL_STEPS : 10);
        check_method(LRCS_METHOD_AUTO, 10);
    }
}

/* Facets pierce each other and lie in each other's planes: contacts order them. */
static void triangles_through_each_other(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 24; seed++) {
        uint64_t random = seed;
        scene_start(&scene);
        scene_material(&scene, 1, 0.5, 0.1, 2)->two_sided = (unsigned char)(seed % 2);
        for (int i = 0; i < (seed < 24 ? 5 : 14); i++) {
            double corner[3][3];
            for (int k = 0; k < 9; k++) {
                corner[k / 3][k % 3] = random_below(&random, seed % 4 < 2 ? 5 : 4096);
            }
            scene_triangle(&scene, corner[0], corner[1], corner[2]);
        }
        prepared = scene_prepare(&scene, &work);
        run_exact(1, -2, 5, 1e-4);
        check_method(LRCS_METHOD_EXACT, seed < 24 ? ALL_STEPS : 10);
    }
}

/* Facets that nothing divides, asked for region by region, and some behind a larger sheet that
   contours cross. */
static void bodies_behind_each_other(void **state)
{
    (void)state;
    for (int aside = 0; aside < 2; aside++) {
        scene_start(&scene);
        scene_box(&scene, (const double[3]){-1, -1, -1}, (const double[3]){1, 1, 0});
        scene_box(&scene, (const double[3]){2, 2, -1}, (const double[3]){3, 3, 0});
        scene_plate(&scene, (const double[3]){-2 + 2 * aside, -2, 1}, (const double[3]){4, 0, 0},
                    (const double[3]){0, 3, 0});
        scene_plate(&scene, (const double[3]){-0.5, -0.5, 0.5}, (const double[3]){0.75, 0, 0},
                    (const double[3]){0, 0.25, 0});
        prepared = scene_prepare(&scene, &work);
        run_exact(0.01, 0.02, 1, 1e-4);
        check_method(LRCS_METHOD_EXACT, ALL_STEPS);
    }
}

/* A body before more edges than a run of its facets is compared with: it is seen as if they were
   not there, whatever steps it takes to know. */
static void a_body_before_much(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, 16);
    uint32_t body = scene.scene.facet_count;
    for (int i = 0; i < 2025; i++) {
        double x = -1 + 2.0 * (i % 45) / 45;
        double y = -1 + 2.0 * (i / 45) / 45;
        scene_triangle(&scene, (const double[3]){x, y, -3}, (const double[3]){x + 0.03, y, -3},
                       (const double[3]){x, y + 0.03, -3});
    }
    prepared = scene_prepare(&scene, &work);
    run_exact(0.01, 0.02, 1, 1e-4);
    for (uint32_t f = 0; f < body; f++) {
        double whole = record[f].area_m2 * fmax(0, record[f].cos_theta);
        check_abs(record[f].visible_area_m2, whole, 1e-12);
    }
    check_method(LRCS_METHOD_EXACT, 2);
}

/* Normals that sway by `sway` over the plane. */
static void bend_normals(double sway)
{
    static lrcs_point normal[3 * 64];
    for (uint32_t i = 0; i < 3 * scene.scene.facet_count; i++) {
        const double *x = scene.vertex[scene.facet[i / 3].corner[i % 3]].x;
        double n[3] = {sway * sin(3 * x[0]), sway * sin(3 * x[1]), 1};
        double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        normal[i] = (lrcs_point){{n[0] / length, n[1] / length, n[2] / length}};
    }
    scene.scene.corner_normal = normal;
}

/* Normals to integrate over, of facets that are seen whole, in part, and not at all. */
static void curved_normals(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_material(&scene, 1, 0.5, 0.02, 2);
    sheets(6);
    bend_normals(0.4);
    prepared = scene_prepare(&scene, &work);
    run_exact(0.25, -0.5, 1, 1e-3);
    options.resolution = 256;
    check_method(LRCS_METHOD_EXACT, 10);
    check_method(LRCS_METHOD_FACET, 10);
    check_method(LRCS_METHOD_ZBUFFER, 10);
    options.resolution = 0;
    check_method(LRCS_METHOD_ZBUFFER, 10);
}

/* One triangle and its peak, narrow to wide, seen whole and behind another: what the bound holds is
   what the integral leaves. */
static void a_curved_peak(void **state)
{
    (void)state;
    static const struct {
        double s, m, sway, tolerance;
    } at[] = {{1e-3, 40, 5, 1e-3}, {0.02, 40, 5, 1e-3}, {0.2, 40, 5, 1e-3}, {1, 2, 5, 1e-8}};
    for (int i = 0; i < 8; i++) {
        scene_start(&scene);
        scene_material(&scene, 1, 0.5, at[i / 2].s, at[i / 2].m);
        if (i % 2 == 1) {
            scene_triangle(&scene, (const double[3]){0.25, 0.25, 0.0625},
                           (const double[3]){0.5, 0.25, 0.0625},
                           (const double[3]){0.25, 0.5, 0.0625});
        }
        scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                       (const double[3]){0, 1, 0});
        bend_normals(at[i / 2].sway);
        prepared = scene_prepare(&scene, &work);
        run_exact(0.5, 0.05, 1, at[i / 2].tolerance);
        check_method(LRCS_METHOD_EXACT, 20);
    }
}

/* Curved shapes, of which true curves may show more or less than their facets. */
static void curved_shapes(void **state)
{
    (void)state;
    static const char text[] = "[[part]]\nname='ball'\nshape='sphere'\nradius=1\n"
                               "[[part]]\nname='can'\nshape='cylinder'\nradius=0.4\nlength=1\n"
                               "translate=[0.5,0,1.2]\n";
    lrcs_recipe recipe;
    lrcs_scene shapes;
    lrcs_build_options build = {1e-2, 200, LRCS_NORMALS_FLAT, 1, 0, NULL};
    lrcs_work room = lrcs_work_make(scene_area, sizeof scene_area);
    assert_int_equal(lrcs_recipe_read(text, sizeof text - 1, &room, &recipe, NULL), LRCS_OK);
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &build, &room, &shapes, NULL), LRCS_OK);
    work = lrcs_work_make(scene_memory, sizeof scene_memory);
    assert_int_equal(lrcs_prepare_run(&shapes, &work, &prepared), LRCS_OK);
    run_exact(0.3, 0.2, 1, 1e-4);
    assert_true(truth.budget.tessellation_m2 > 0);
    options.accept = LRCS_ACCEPT_ESTIMATE; /* their bound needs more than samples */
    options.tolerance = 0.01;
    lrcs_result guess = run(LRCS_METHOD_AUTO, 0);
    assert_int_equal(guess.method, LRCS_METHOD_EXACT);
    check_abs(guess.sigma_m2, truth.sigma_m2, guess.bound_m2 + truth.bound_m2);
    options.accept = LRCS_ACCEPT_BOUND;
    options.tolerance = 1e-4;
    check_method(LRCS_METHOD_EXACT, 20);
}

/* A raster is not counted, and cannot do with fewer crossings than there are. */
static void a_raster_looks_at_every_crossing(void **state)
{
    (void)state;
    scene_start(&scene);
    sheets(12);
    prepared = scene_prepare(&scene, &work);
    run_exact(0.25, -0.5, 1, 1e-4);
    options.resolution = 64;
    check_method(LRCS_METHOD_ZBUFFER, ALL_STEPS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sheets_over_each_other),
        cmocka_unit_test(triangles_through_each_other),
        cmocka_unit_test(bodies_behind_each_other),
        cmocka_unit_test(a_body_before_much),
        cmocka_unit_test(curved_normals),
        cmocka_unit_test(a_curved_peak),
        cmocka_unit_test(curved_shapes),
        cmocka_unit_test(a_raster_looks_at_every_crossing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
