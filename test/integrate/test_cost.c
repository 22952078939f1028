/* SPDX-License-Identifier: MIT */
/* The counts from which method auto chooses, and the limit of work that follows from them for its
   choice. */
#include "integrate/plan/cost.h"

#include "scenes.h"

static test_scene scene;
static lrcs_work work;
static lrcsi_view view;

static lrcsi_cost counted(const double direction[3])
{
    lrcs_pose pose;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    return lrcsi_cost_count(&view);
}

/* A cube of side 2 along the diagonal: 6 sides of its outline, each of length sqrt(8/3); 3 faces in
   front. Two plates of side 1 and 2 in one plane, apart: 8 borders, no contour. */
static void few_facets_are_all_counted(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_box(&scene, (const double[3]){-1, -1, -1}, (const double[3]){1, 1, 1});
    lrcsi_cost cost = counted((const double[3]){1, 1, 1});
    check_abs(cost.facets, 12, 0);
    check_abs(cost.casting, 6, 0);
    check_abs(cost.events, 6, 0);
    check_abs(cost.contacts, 0, 0);
    double side = view.side;
    check_abs(cost.borders * side, 6 * sqrt(8 / 3.0) / 2, 1e-12); /* coordinates are halved */
    check_abs(cost.overdraw * side * side, 12 / sqrt(3.0) / 4, 1e-12);

    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                (const double[3]){0, 1, 0});
    scene_plate(&scene, (const double[3]){2, 0, 0}, (const double[3]){2, 0, 0},
                (const double[3]){0, 2, 0});
    cost = counted((const double[3]){0, 0, 1});
    check_abs(cost.events, 8, 0);
    check_abs(cost.borders, 12 / 4.0, 1e-12);
    check_abs(cost.overdraw, 5 / 16.0, 1e-12);
    check_abs(lrcsi_cost_undecided(&cost), 4, 4);
}

/* A strut that stands on a plate: the plate's facet that it touches is likely to be undecided. */
static void facets_with_contacts_are_counted(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){4, 0, 0},
                (const double[3]){0, 4, 0});
    scene_plate(&scene, (const double[3]){3, 1, -0.5}, (const double[3]){0.2, 0.1, 0},
                (const double[3]){0, 0, 1});
    assert_true(counted((const double[3]){0.1, 0.2, 1}).contacts >= 3);
}

/* Of many facets a sample is counted, which represents all; the length of borders is right to
   within sampling errors. */
static void many_facets_are_counted_by_a_sample(void **state)
{
    (void)state;
    scene_start(&scene);
    scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, 88);
    lrcsi_cost cost = counted((const double[3]){0.3, 0.5, 0.7});
    assert_true(cost.facets > 4096);
    check_abs(cost.casting, 0.5 * cost.facets, 0.05 * cost.facets);
    check_abs(cost.borders, (double)SCENE_PI, 1.5);
    check_abs(cost.overdraw, (double)SCENE_PI / 4, 0.05);
}

/* Finer tolerances take finer rasters, up to the finest; without a border the coarsest serves. */
static void finer_tolerances_take_finer_rasters(void **state)
{
    (void)state;
    const lrcsi_cost cost = {.facets = 1000, .casting = 500, .borders = 20, .overdraw = 0.5};
    const lrcsi_cost plain = {.facets = 1000, .casting = 500, .overdraw = 0.5};
    uint32_t last = 0;
    for (double tolerance = 1; tolerance > 1e-7; tolerance /= 3) {
        uint32_t size = lrcsi_cost_size(&cost, tolerance, 4096);
        assert_true(size >= last && size >= 256 && size <= 4096);
        assert_true(lrcsi_cost_draw(&cost, size) >= lrcsi_cost_draw(&cost, last));
        last = size;
    }
    assert_int_equal(last, 4096);
    assert_true(lrcsi_cost_first(&cost, 4096) < 1024); /* the first is not much dearer than any */
    assert_int_equal(lrcsi_cost_first(&cost, 256), 256);
    assert_true(lrcsi_cost_size(&plain, 1e-9, 4096) < 512);
}

/* Nothing, and plates that show nothing but their edges: no length, no area, and no time beyond
   that of looking at the facets. */
static void nothing_to_see_costs_nothing_to_draw(void **state)
{
    (void)state;
    for (int plates = 0; plates < 3; plates++) {
        scene_start(&scene);
        for (int i = 0; i < plates; i++) {
            scene_plate(&scene, (const double[3]){0, i, 0}, (const double[3]){0, 0.5, 0},
                        (const double[3]){0, 0, 1});
        }
        lrcsi_cost cost = counted((const double[3]){0, 0, 1});
        check_abs(cost.facets, 2 * plates, 0);
        check_abs(cost.casting + cost.events + cost.borders + cost.overdraw, 0, 0);
        assert_true(lrcsi_cost_clip(&cost, 0) <= 15 * cost.facets);
        assert_int_equal(lrcsi_cost_first(&cost, 256), 256);
    }
}

/* Two plates far apart cover 2e-8 of the window between them: what is covered is what they have. */
static void little_in_a_large_window_is_not_rounded_away(void **state)
{
    (void)state;
    scene_start(&scene);
    for (int i = 0; i < 2; i++) {
        scene_plate(&scene, (const double[3]){10000.0 * i, 10000.0 * i, 0},
                    (const double[3]){1, 0, 0}, (const double[3]){0, 1, 0});
    }
    lrcsi_cost cost = counted((const double[3]){0, 0, 1});
    check_rel(cost.overdraw, 2 / (10001.0 * 10001.0), 1e-3);
    lrcsi_cost twice = cost; /* as many borders on twice the area: half the relative error */
    twice.overdraw *= 2;
    uint32_t size = lrcsi_cost_size(&cost, 1, 1u << 20);
    uint32_t other = lrcsi_cost_size(&twice, 1, 1u << 20);
    check_rel(pow(size, 1.5) / pow(other, 1.5), 2.0, 0.02);
}

/* More borders than a raster has pixels along a side: no model tells its error, and the coarsest,
   or one hardly dearer, is tried. One that may not be larger than the coarsest is that. */
static void borders_in_every_pixel_take_a_coarse_raster(void **state)
{
    (void)state;
    const lrcsi_cost cost = {.facets = 1e6, .casting = 5e5, .borders = 1e5, .overdraw = 0.5};
    uint32_t size = lrcsi_cost_size(&cost, 1e-2, 4096);
    assert_true(size >= 256 && size < 4096);
    assert_true(lrcsi_cost_draw(&cost, size) <= 1.15 * lrcsi_cost_draw(&cost, 256));
    assert_int_equal(lrcsi_cost_size(&cost, 1e-2, 256), 256);
    const lrcsi_cost dear = {.facets = 1e9, .casting = 1e9, .borders = 1, .overdraw = 1e-3};
    size = lrcsi_cost_size(&dear, 1e-2, 600); /* pixels cost next to nothing: as many as allowed */
    assert_true(size > 600 - 64 && size <= 600);
}

/* The pages of an open book about its spine: clipping seems cheap, for there are few facets, but
   each is cut by the rims of many. It is given up once its steps are spent, here those that the
   caller allows, and leaves nothing: the answer is that of a raster, and no limit counts as
   reached. */
static void clipping_that_takes_too_long_gives_way_to_a_raster(void **state)
{
    (void)state;
    enum { PAGES = 800 };
    static const double direction[3] = {0.3, 0.2, 0.9};
    lrcs_pose pose;
    lrcs_result r;
    lrcs_result again;
    scene_start(&scene);
    for (int i = 0; i < PAGES; i++) {
        double turn = 2 * (double)SCENE_PI * i / PAGES;
        scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){0, 0, 1},
                    (const double[3]){cos(turn), sin(turn), 0});
    }
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    lrcs_run_options options = lrcs_run_options_default();
    options.accept = LRCS_ACCEPT_ESTIMATE;
    options.tolerance = 0.004;
    options.steps = 500000;
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &r, NULL, NULL), LRCS_OK);
    assert_int_equal(r.method, LRCS_METHOD_ZBUFFER);
    assert_int_equal(r.flags, LRCS_FLAG_ACCEPTED_BY_ESTIMATE);
    assert_true(r.steps > 0 && r.steps <= options.steps);
    options.method = LRCS_METHOD_ZBUFFER;
    options.resolution = r.resolution;
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &again, NULL, NULL), LRCS_OK);
    assert_true(again.sigma_m2 == r.sigma_m2 && again.bound_m2 == r.bound_m2 &&
                again.estimate_m2 == r.estimate_m2);
    assert_string_equal(r.method_reason,
                        "clipping was begun, and took more steps than the run has");
}

/* A satellite-like body, all smooth: hardly a facet is undecided, and clipping it costs less than
   any raster. */
static void clipping_goes_first_where_few_facets_are_undecided(void **state)
{
    (void)state;
    lrcs_pose pose;
    lrcs_result r;
    scene_start(&scene);
    scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, 60);
    scene_sphere(&scene, (const double[3]){0.5, 0.2, 3}, 0.4, 20);
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction((const double[3]){0.1, 0.2, 1}, &pose), LRCS_OK);
    lrcs_run_options options = lrcs_run_options_default();
    options.accept = LRCS_ACCEPT_ESTIMATE;
    options.tolerance = 1e-3;
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &r, NULL, NULL), LRCS_OK);
    assert_int_equal(r.method, LRCS_METHOD_EXACT);
    assert_int_equal(r.flags, 0);
    assert_string_equal(r.method_reason, "clipping is estimated to cost less than a raster");
}

/* The same with less memory, until not even a raster fits: where clipping does not, a raster
   answers, and the reason is not that clipping took too long. */
static void clipping_without_memory_gives_way_to_a_raster_for_that_reason(void **state)
{
    (void)state;
    lrcs_pose pose;
    lrcs_result r;
    unsigned rasters = 0;
    scene_start(&scene);
    scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, 60);
    scene_plate(&scene, (const double[3]){-2, -2, 0.1}, (const double[3]){4, 0, 0.2},
                (const double[3]){0, 4, 0.1}); /* meets many facets: clipping takes more memory */
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction((const double[3]){0.1, 0.2, 1}, &pose), LRCS_OK);
    lrcs_run_options options = lrcs_run_options_default();
    options.accept = LRCS_ACCEPT_ESTIMATE;
    options.tolerance = 0.01; /* which a coarse raster's estimate meets */
    for (size_t size = work.size - work.used; size > 0; size -= size / 16 + 1) {
        lrcs_work less = lrcs_work_make(work.bytes + work.used, size);
        if (lrcs_sigma_run(prepared, &pose, &options, &less, &r, NULL, NULL) != LRCS_OK) {
            break;
        }
        if (r.method == LRCS_METHOD_ZBUFFER) {
            assert_string_equal(r.method_reason, "too little memory for clipping");
            rasters++;
        } else {
            assert_int_equal(r.method, LRCS_METHOD_EXACT);
            assert_int_equal(rasters, 0);
        }
    }
    assert_true(rasters > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(few_facets_are_all_counted),
        cmocka_unit_test(facets_with_contacts_are_counted),
        cmocka_unit_test(many_facets_are_counted_by_a_sample),
        cmocka_unit_test(finer_tolerances_take_finer_rasters),
        cmocka_unit_test(nothing_to_see_costs_nothing_to_draw),
        cmocka_unit_test(little_in_a_large_window_is_not_rounded_away),
        cmocka_unit_test(borders_in_every_pixel_take_a_coarse_raster),
        cmocka_unit_test(clipping_that_takes_too_long_gives_way_to_a_raster),
        cmocka_unit_test(clipping_goes_first_where_few_facets_are_undecided),
        cmocka_unit_test(clipping_without_memory_gives_way_to_a_raster_for_that_reason),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
