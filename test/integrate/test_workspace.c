/* SPDX-License-Identifier: MIT */
/* Too little memory: the work area grows until everything fits. With less, each call returns
   LRCS_E_MEMORY and touches nothing, or falls back to a coarser raster whose bound still holds. */
#include "scenes.h"

#include "scene/prepared.h"

static test_scene scene;
static unsigned char little[8u << 20];
static const double direction[3] = {0.25, -0.5, 1};
static const int methods[] = {LRCS_METHOD_AUTO, LRCS_METHOD_FACET, LRCS_METHOD_ZBUFFER,
                              LRCS_METHOD_EXACT};

/* Boxes that pierce and shade each other, and a plate over them. */
static void make_scene(void)
{
    scene_start(&scene);
    scene_box(&scene, (const double[3]){0, 0, 0}, (const double[3]){2, 2, 1});
    scene_box(&scene, (const double[3]){0.5, 0.25, 0.5}, (const double[3]){1, 3, 2});
    scene_plate(&scene, (const double[3]){1, 1, 3}, (const double[3]){1, 0.25, 0.125},
                (const double[3]){0, 1, 0});
}

static int prepare_in(size_t size, lrcs_work *work, const lrcs_prepared **prepared)
{
    *work = lrcs_work_make(little, size);
    *prepared = NULL;
    int status = lrcs_prepare_run(&scene.scene, work, prepared);
    if (status != LRCS_OK) {
        assert_int_equal(status, LRCS_E_MEMORY);
        assert_null(*prepared);
        assert_int_equal(work->used, 0);
        assert_true(work->peak > size);
    }
    return status;
}

static void preparing_grows_until_it_fits(void **state)
{
    (void)state;
    make_scene();
    size_t need = lrcs_prepare_need(&scene.scene);
    lrcs_work work;
    const lrcs_prepared *prepared;
    size_t fits = 0;
    while (prepare_in(fits, &work, &prepared) != LRCS_OK) {
        fits++;
    }
    assert_true(fits <= need);
    for (size_t size = fits; size < fits + 200; size++) {
        assert_int_equal(prepare_in(size, &work, &prepared), LRCS_OK);
    }
    assert_int_equal(prepare_in(need, &work, &prepared), LRCS_OK);
    assert_true(work.used <= work.peak && work.peak <= need);
}

/* One run with `size` bytes beyond what the prepared scene holds. On failure nothing was touched.
 */
static int run_in(const lrcs_prepared *prepared, const lrcs_work *after, size_t size,
                  const lrcs_run_options *options, lrcs_result *result)
{
    lrcs_pose pose;
    lrcs_work work = *after;
    lrcs_result untouched;
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    work.size = work.used + size;
    memset(scene.record, 0x55, sizeof *scene.record * scene.scene.facet_count);
    memset(result, 0x55, sizeof *result);
    memset(&untouched, 0x55, sizeof untouched);
    lrcs_facet_record first = scene.record[0];
    int status = lrcs_sigma_run(prepared, &pose, options, &work, result, scene.record, NULL);
    assert_int_equal(work.used, after->used);
    if (status != LRCS_OK) {
        assert_int_equal(status, LRCS_E_MEMORY);
        assert_true(work.peak > work.size);
        assert_memory_equal(result, &untouched, sizeof untouched);
        for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
            assert_memory_equal(&scene.record[f], &first, sizeof first);
        }
    }
    return status;
}

/* The least size that suffices, found by bisection; the run is checked at every size tried. */
static size_t least_size(const lrcs_prepared *prepared, const lrcs_work *after, size_t most,
                         const lrcs_run_options *options, double truth)
{
    size_t low = 0;
    size_t high = most;
    lrcs_result r;
    while (low < high) {
        size_t size = low + (high - low) / 2;
        if (run_in(prepared, after, size, options, &r) == LRCS_OK) {
            check_abs(r.sigma_m2, truth, r.bound_m2 + 1e-12 * truth);
            high = size;
        } else {
            low = size + 1;
        }
    }
    for (size_t size = low < 100 ? 0 : low - 100; size < low + 100; size++) {
        int status = run_in(prepared, after, size, options, &r);
        assert_int_equal(status, size < low ? LRCS_E_MEMORY : LRCS_OK);
    }
    return low;
}

static void running_grows_until_it_fits(void **state)
{
    (void)state;
    lrcs_work work;
    lrcs_result r;
    make_scene();
    double truth = scene_run(&scene, direction, LRCS_METHOD_EXACT, 0).sigma_m2;
    work = lrcs_work_make(little, sizeof little);
    const lrcs_prepared *prepared = NULL;
    assert_int_equal(lrcs_prepare_run(&scene.scene, &work, &prepared), LRCS_OK);
    size_t least[4];
    for (int i = 0; i < 4; i++) {
        lrcs_run_options options = {.tolerance = 1e-4, .method = methods[i], .resolution = 64};
        size_t need = lrcs_sigma_need(prepared, &options);
        assert_int_equal(run_in(prepared, &work, need, &options, &r), LRCS_OK);
        assert_false(r.flags & LRCS_FLAG_MEMORY_FALLBACK);
        least[i] = least_size(prepared, &work, need, &options, truth);
    }
    assert_int_equal(least[0], least[2]); /* auto with a resolution is the raster */
    assert_int_equal(least[3], least[2]); /* exact falls back to it */
    lrcs_run_options options = lrcs_run_options_default();
    assert_int_equal(least_size(prepared, &work, sizeof little - work.used, &options, truth),
                     least[2]); /* auto falls back to the coarsest raster before it gives up */
}

/* Symptom: auto went on to a raster when the search for undecided facets had found no memory. */
static void every_size_is_survived(void **state)
{
    (void)state;
    scene_start(&scene); /* few facets, many edges that cross many cells */
    for (int i = 0; i < 60; i++) {
        scene_triangle(&scene, (const double[3]){0, 0.01 * i, 0.1 * i},
                       (const double[3]){1, 0.3 + 0.01 * i, 0.1 * i},
                       (const double[3]){0.01 * i, 1, 0.1 * i});
    }
    lrcs_work work = lrcs_work_make(little, sizeof little);
    const lrcs_prepared *prepared = NULL;
    assert_int_equal(lrcs_prepare_run(&scene.scene, &work, &prepared), LRCS_OK);
    for (int i = 0; i < 4; i++) {
        lrcs_run_options options = {.tolerance = 1e-4, .method = methods[i], .resolution = 0};
        int before = LRCS_E_MEMORY;
        for (size_t size = 0; size < 32000; size += 16) {
            lrcs_result r;
            int status = run_in(prepared, &work, size, &options, &r);
            assert_true(status == LRCS_OK || before != LRCS_OK);
            before = status;
        }
        assert_int_equal(before, LRCS_OK);
    }
}

static void less_memory_means_a_coarser_raster_and_a_wider_bound(void **state)
{
    (void)state;
    lrcs_work work;
    lrcs_result r;
    make_scene();
    double truth = scene_run(&scene, direction, LRCS_METHOD_EXACT, 0).sigma_m2;
    work = lrcs_work_make(little, sizeof little);
    const lrcs_prepared *prepared = NULL;
    assert_int_equal(lrcs_prepare_run(&scene.scene, &work, &prepared), LRCS_OK);
    lrcs_run_options options = {
        .tolerance = 1e-4, .method = LRCS_METHOD_ZBUFFER, .resolution = 256};
    size_t need = lrcs_sigma_need(prepared, &options);
    uint32_t coarsest = 256;
    uint32_t before = 0;
    for (size_t size = 1024; size <= need; size += 1021) {
        if (run_in(prepared, &work, size, &options, &r) != LRCS_OK) {
            assert_int_equal(before, 0); /* more memory never fails where less served */
            continue;
        }
        check_abs(r.sigma_m2, truth, r.bound_m2 + 1e-12 * truth);
        assert_true(r.resolution >= before);
        assert_int_equal((r.flags & LRCS_FLAG_MEMORY_FALLBACK) != 0, r.resolution < 256);
        before = r.resolution;
        coarsest = r.resolution < coarsest ? r.resolution : coarsest;
    }
    assert_int_equal(before, 256);
    assert_true(coarsest <= 16);
}

/* Exact in every size of memory: a raster, then all. */
static void exact_with_too_little_memory_says_so_and_its_bound_holds(void **state)
{
    (void)state;
    lrcs_work work;
    lrcs_result r;
    make_scene();
    double truth = scene_run(&scene, direction, LRCS_METHOD_EXACT, 0).sigma_m2;
    work = lrcs_work_make(little, sizeof little);
    const lrcs_prepared *prepared = NULL;
    assert_int_equal(lrcs_prepare_run(&scene.scene, &work, &prepared), LRCS_OK);
    lrcs_run_options options = lrcs_run_options_default();
    options.method = LRCS_METHOD_EXACT;
    size_t need = lrcs_sigma_need(prepared, &options);
    unsigned rasters = 0;
    unsigned whole = 0;
    int before = LRCS_E_MEMORY;
    for (size_t size = 0; size <= need; size += 61) {
        int status = run_in(prepared, &work, size, &options, &r);
        assert_true(status == LRCS_OK || before != LRCS_OK);
        before = status;
        if (status != LRCS_OK) {
            continue;
        }
        int flagged = (r.flags & LRCS_FLAG_MEMORY_FALLBACK) != 0;
        check_abs(r.sigma_m2, truth, r.bound_m2 + 1e-12 * truth);
        if (r.method == LRCS_METHOD_ZBUFFER) {
            assert_true(flagged && whole == 0 && r.resolution > 0);
            rasters++;
        } else {
            assert_true(!flagged && r.resolution == 0);
            check_most(r.bound_m2, 1e-11 * truth);
            whole++;
        }
    }
    assert_true(rasters > 20 && whole > 5);
}

static void ordinary_scenes_fit_into_what_is_asked_for(void **state)
{
    (void)state;
    for (uint32_t n = 4; n <= 64; n *= 2) {
        scene_start(&scene);
        scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, n);
        scene_sphere(&scene, (const double[3]){0.5, 0, 1}, 1, n); /* they pierce each other */
        scene_box(&scene, (const double[3]){-3, -0.5, -0.5}, (const double[3]){3, 0.5, 0});
        lrcs_work work;
        const lrcs_prepared *prepared;
        assert_int_equal(prepare_in(lrcs_prepare_need(&scene.scene), &work, &prepared), LRCS_OK);
        work.size = sizeof little;
        for (int i = 0; i < 4; i++) {
            lrcs_run_options options = {.tolerance = 1e-4, .method = methods[i], .resolution = 128};
            lrcs_result r;
            size_t need = lrcs_sigma_need(prepared, &options);
            assert_int_equal(run_in(prepared, &work, need, &options, &r), LRCS_OK);
            assert_false(r.flags & LRCS_FLAG_MEMORY_FALLBACK);
        }
    }
}

/* All methods, from a direction, in the bytes that the library asks for. */
static void check_need(const double from[3])
{
    static unsigned char memory[24u << 20];
    lrcs_work work = lrcs_work_make(memory, sizeof memory);
    const lrcs_prepared *prepared = NULL;
    lrcs_pose pose;
    assert_int_equal(lrcs_prepare_run(&scene.scene, &work, &prepared), LRCS_OK);
    assert_int_equal(lrcs_pose_from_direction(from, &pose), LRCS_OK);
    for (int i = 0; i < 4; i++) {
        lrcs_run_options options = {.tolerance = 1e-4, .method = methods[i], .resolution = 16};
        lrcs_work after = work;
        lrcs_result r;
        after.size = work.used + lrcs_sigma_need(prepared, &options);
        assert_true(after.size <= sizeof memory);
        after.peak = 0;
        assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &after, &r, NULL, NULL),
                         LRCS_OK);
        assert_false(r.flags & LRCS_FLAG_MEMORY_FALLBACK);
        assert_true(after.peak <= after.size);
    }
}

/* Symptom: sheets that lie over each other, and large facets, took more bytes than were asked for,
   and the raster that exact then fell back to took more still. */
static void deep_scenes_fit_into_what_is_asked_for(void **state)
{
    (void)state;
    const double from[3] = {0.0625, 0.125, 1};
    for (uint32_t sheets = 1; sheets <= 64; sheets *= 4) {
        scene_start(&scene);
        for (uint32_t i = 0; i < 16 * sheets; i++) {
            double z = 0x1p-6 * (i / 16);
            scene_plate(&scene, (const double[3]){i % 4 + z, i / 4 % 4 + 0.5 * z, z},
                        (const double[3]){1, 0, 0}, (const double[3]){0, 1, 0});
        }
        check_need(from);
    }
    scene_start(&scene); /* each over nearly all of the one below it */
    for (uint32_t i = 0; i < 300; i++) {
        double z = 0x1p-10 * i;
        scene_plate(&scene, (const double[3]){z, 0.5 * z, z}, (const double[3]){1, 0, 0},
                    (const double[3]){0, 1, 0});
    }
    check_need(from);
    uint64_t seed = 8;
    for (uint32_t count = 8; count <= 128; count *= 2) { /* through one another */
        scene_start(&scene);
        for (uint32_t i = 0; i < count; i++) {
            double corner[3][3];
            for (int k = 0; k < 9; k++) {
                corner[k / 3][k % 3] = random_below(&seed, 4096) / 4096.0;
            }
            scene_triangle(&scene, corner[0], corner[1], corner[2]);
        }
        check_need(from);
    }
}

/* Triangles through each other have more contacts than scenes ordinarily do: preparing them fails
   in the middle of the search, and is clean. */
static void preparing_what_pierces_grows_until_it_fits(void **state)
{
    (void)state;
    uint64_t seed = 4;
    scene_start(&scene);
    for (int i = 0; i < 60; i++) {
        double corner[3][3];
        for (int k = 0; k < 9; k++) {
            corner[k / 3][k % 3] = random_below(&seed, 4096) / 4096.0;
        }
        scene_triangle(&scene, corner[0], corner[1], corner[2]);
    }
    lrcs_work work;
    const lrcs_prepared *prepared;
    size_t fits = 0;
    while (prepare_in(fits, &work, &prepared) != LRCS_OK) {
        fits += 16;
    }
    for (size_t size = fits; size < fits + 4096; size += 16) {
        assert_int_equal(prepare_in(size, &work, &prepared), LRCS_OK);
    }
    assert_true(prepared->intersections.count > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(preparing_grows_until_it_fits),
        cmocka_unit_test(preparing_what_pierces_grows_until_it_fits),
        cmocka_unit_test(running_grows_until_it_fits),
        cmocka_unit_test(every_size_is_survived),
        cmocka_unit_test(less_memory_means_a_coarser_raster_and_a_wider_bound),
        cmocka_unit_test(exact_with_too_little_memory_says_so_and_its_bound_holds),
        cmocka_unit_test(ordinary_scenes_fit_into_what_is_asked_for),
        cmocka_unit_test(deep_scenes_fit_into_what_is_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
