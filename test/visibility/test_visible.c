/* SPDX-License-Identifier: MIT */
/* What the sampled areas draw, against the whole picture: the tiles that matter hold just what the
   picture holds there, and the memory of the others is never touched. */
#include "visibility/visible.h"

#include "scenes.h"
#include "visibility/query.h"

enum { N = 72, FINE = 8 };
static const unsigned char untouched = 0xa5;

static test_scene scene;
static lrcs_work work;

/* Bodies before, behind and through one another; an open plate that shows its back. */
static void crowd(void)
{
    scene_start(&scene);
    scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, 12);
    scene_box(&scene, (const double[3]){-2, -0.5, -0.5}, (const double[3]){2, 0.25, 0.75});
    scene_sphere(&scene, (const double[3]){0.5, 2.25, 3}, 0.75, 16);
    scene_plate(&scene, (const double[3]){-3, 1, -1}, (const double[3]){3, 0.125, 0.5},
                (const double[3]){0.25, 0.5, 3});
}

static lrcsi_view seen_from(int i)
{
    static const double direction[4][3] = {{0, 0, 1}, {1, 0, 1}, {0.3, -0.4, 0.5}, {-1, -2, 0.1}};
    lrcs_pose pose;
    lrcsi_view view;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction(direction[i], &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    view.backs.cast = 1;
    return view;
}

/* The sampled run of a view, in memory that was all `untouched`. */
static lrcsi_raster sampled(const lrcsi_view *view, lrcsi_classification *classification,
                            lrcsi_known *known, lrcsi_visible *visible)
{
    lrcsi_raster raster;
    assert_int_equal(lrcsi_classify_make(view, NULL, &work, classification), LRCS_OK);
    assert_int_equal(lrcsi_visible_known(classification, &work, known), LRCS_OK);
    size_t need = lrcsi_visible_need(view->prepared, N);
    assert_true(work.size - work.used >= need);
    memset(work.bytes + work.used, untouched, need);
    size_t before = work.peak = work.used;
    assert_int_equal(lrcsi_visible_sampled(known, N, &work, &raster, visible), LRCS_OK);
    assert_true(work.peak - before <= need);
    return raster;
}

static void active_tiles_hold_what_the_whole_picture_holds(void **state)
{
    (void)state;
    static lrcsi_visible visible[SCENE_FACETS];
    unsigned active = 0;
    unsigned left = 0;
    for (int i = 0; i < 4; i++) {
        crowd();
        lrcsi_view view = seen_from(i);
        lrcsi_classification classification;
        lrcsi_known known;
        lrcsi_raster whole;
        lrcsi_raster raster = sampled(&view, &classification, &known, visible);
        assert_int_equal(lrcsi_raster_make(&view, N, &work, &whole), LRCS_OK);
        for (uint32_t k = 0; k < N * N; k++) {
            uint32_t tile = k / N / LRCSI_RASTER_TILE * raster.tiles + k % N / LRCSI_RASTER_TILE;
            uint32_t owner = lrcsi_raster_owner(&raster, k % N, k / N);
            if (raster.active[tile]) {
                active++;
                assert_int_equal(owner, whole.owner[k]);
            } else {
                left++;
                assert_int_equal(owner, LRCS_NONE);
                assert_int_equal(raster.owner[k], 0xa5a5a5a5);
                assert_int_equal(raster.full[k], untouched);
            }
        }
        for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
            if (known.answer[f] == LRCSI_QUERY_UNDECIDED) {
                assert_int_equal(raster.covered[f], whole.covered[f]);
                assert_int_equal(raster.owned[f], whole.owned[f]);
            } else { /* none of its samples, or all: the picture agrees */
                assert_int_equal(whole.owned[f],
                                 known.answer[f] == LRCSI_QUERY_VISIBLE ? whole.covered[f] : 0);
            }
        }
    }
    assert_true(active > 1000 && left > 1000);
}

/* Undecided facets have samples wherever they may be touched, and two pixels farther. */
static void tiles_about_undecided_facets_are_active(void **state)
{
    (void)state;
    static lrcsi_visible visible[SCENE_FACETS];
    unsigned seen = 0;
    for (int i = 0; i < 4; i++) {
        crowd();
        lrcsi_view view = seen_from(i);
        lrcsi_classification classification;
        lrcsi_known known;
        lrcsi_raster raster = sampled(&view, &classification, &known, visible);
        for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
            lrcsi_edge_functions e = lrcsi_raster_edge_functions(&raster, f);
            for (uint32_t y = e.bottom; known.answer[f] == LRCSI_QUERY_UNDECIDED && y < e.top;
                 y++) {
                lrcsi_pixel_span row = lrcsi_span_touched(&e, y);
                for (uint32_t k = 0; k < 25 * (row.x1 - row.x0); k++) {
                    uint32_t at_x = row.x0 + k / 25 + k % 5;
                    uint32_t at_y = y + k % 25 / 5;
                    if (at_x >= 2 && at_x < N + 2 && at_y >= 2 && at_y < N + 2) {
                        seen++;
                        assert_true(raster.active[(at_y - 2) / LRCSI_RASTER_TILE * raster.tiles +
                                                  (at_x - 2) / LRCSI_RASTER_TILE]);
                    }
                }
            }
        }
    }
    assert_true(seen > 1000);
}

/* Large triangles of all slopes, each through all others. */
static void tangle(uint64_t seed)
{
    scene_start(&scene);
    for (int i = 0; i < 12; i++) {
        double corner[3][3];
        for (int k = 0; k < 3; k++) {
            double angle = 2 * (double)SCENE_PI * (k + random_below(&seed, 64) / 192.0) / 3;
            corner[k][0] = 2 * cos(angle);
            corner[k][1] = 2 * sin(angle);
            corner[k][2] = random_below(&seed, 256) / 64.0 - 2;
        }
        scene_triangle(&scene, corner[0], corner[1], corner[2]);
    }
}

/* A full pixel shows its owner in every part: so says a picture eight times as fine. Adds up the
   samples of uniform and undecided owners. */
static void check_full(int direction, unsigned full[2])
{
    static lrcsi_visible visible[SCENE_FACETS];
    lrcsi_view view = seen_from(direction);
    lrcsi_classification classification;
    lrcsi_known known;
    lrcsi_raster fine;
    lrcsi_raster raster = sampled(&view, &classification, &known, visible);
    assert_int_equal(lrcsi_raster_make(&view, N * FINE, &work, &fine), LRCS_OK);
    for (uint32_t k = 0; k < N * N * FINE * FINE; k++) {
        uint32_t x = k % (N * FINE) / FINE;
        uint32_t y = k / (N * FINE) / FINE;
        uint32_t owner = lrcsi_raster_owner(&raster, x, y);
        if (owner != LRCS_NONE && raster.full[y * N + x]) {
            assert_int_equal(fine.owner[k], owner);
            full[classification.undecided[owner]]++;
        }
    }
}

static void full_pixels_show_their_owner_in_every_part(void **state)
{
    (void)state;
    unsigned full[2] = {0, 0};
    for (int i = 0; i < 4; i++) {
        crowd();
        check_full(i, full);
    }
    assert_true(full[0] > 1000 && full[1] > 1000);
}

static void pixels_where_facets_pierce_each_other_are_not_full(void **state)
{
    (void)state;
    unsigned full[2] = {0, 0};
    for (int i = 0; i < 12; i++) {
        tangle((uint64_t)i + 1);
        check_full(i % 4, full);
    }
    assert_true(full[0] == 0 && full[1] > 50000);
}

/* Symptom: where no facet was known to be seen whole, the areas of none were computed, from
 * nowhere. */
static void facets_that_pierce_each_other_are_seen_as_clipping_sees_them(void **state)
{
    (void)state;
    const double d[3] = {0.25, 0.5, 1};
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){-2, -1, 0}, (const double[3]){2, -1, 0},
                   (const double[3]){0, 2, 0.5});
    scene_triangle(&scene, (const double[3]){-1, -0.75, -1}, (const double[3]){1, -0.75, 1},
                   (const double[3]){0, 1.5, 0.25});
    lrcs_result exact = scene_run(&scene, d, LRCS_METHOD_EXACT, 0);
    lrcs_result raster = scene_run(&scene, d, LRCS_METHOD_ZBUFFER, 256);
    assert_int_equal(raster.facets_partial, 2);
    check_abs(raster.sigma_m2, exact.sigma_m2, raster.bound_m2 + exact.bound_m2);
    check_most(raster.bound_m2, 0.1 * exact.sigma_m2);
}

/* Draws all facets that cast, asking for occluder heights; returns how many pixels have one. What
   is visible in any part of a pixel, says a picture eight times as fine, lies no lower. */
static unsigned check_occluders(int direction)
{
    static float occluder[N * N];
    lrcsi_view view = seen_from(direction);
    lrcsi_raster raster;
    lrcsi_raster fine;
    unsigned count = 0;
    assert_int_equal(lrcsi_raster_start(&view, N, &work, &raster), LRCS_OK);
    raster.occluder = occluder;
    memset(raster.active, 1, (size_t)raster.tiles * raster.tiles);
    lrcsi_raster_clear(&raster);
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        if (lrcsi_view_casts(&view, f)) {
            lrcsi_raster_draw(&raster, f);
        }
    }
    assert_int_equal(lrcsi_raster_make(&view, N * FINE, &work, &fine), LRCS_OK);
    for (uint32_t k = 0; k < N * N * FINE * FINE; k++) {
        uint32_t pixel = k / (N * FINE) / FINE * N + k % (N * FINE) / FINE;
        if (occluder[pixel] > -HUGE_VALF) {
            count += k % FINE == 0 && k / (N * FINE) % FINE == 0;
            assert_true(fine.owner[k] != LRCS_NONE);
            assert_true(fine.depth[k] + fine.height_err[fine.owner[k]] >= (double)occluder[pixel]);
        }
    }
    return count;
}

static void nothing_is_visible_below_the_occluded_height_of_a_pixel(void **state)
{
    (void)state;
    unsigned count = 0;
    for (int i = 0; i < 12; i++) {
        crowd();
        count += i < 4 ? check_occluders(i) : 0;
        tangle((uint64_t)i + 1);
        count += check_occluders(i % 4);
    }
    assert_true(count > 5000);
}

/* Two plates that overlap hide a third, which neither covers alone and which the edges of both
   cross. A fourth, far in front, makes some of the pixels mixed for all three. */
static void what_one_of_several_covers_is_hidden_in_mixed_pixels_too(void **state)
{
    (void)state;
    static lrcsi_visible visible[SCENE_FACETS];
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){-8, -4, 1}, (const double[3]){2, -4, 1},
                   (const double[3]){0.5, 8, 1});
    scene_triangle(&scene, (const double[3]){8, -4, 2}, (const double[3]){-0.5, 8, 2},
                   (const double[3]){-2, -4, 2});
    uint32_t hidden = scene_triangle(&scene, (const double[3]){-3, -2, 0},
                                     (const double[3]){3, -2, 0.25}, (const double[3]){0, -1, 0});
    scene_triangle(&scene, (const double[3]){-4, -3, 4}, (const double[3]){4, -0.5, 4},
                   (const double[3]){3.75, 0, 4});
    lrcsi_view view = seen_from(0);
    lrcsi_classification classification;
    lrcsi_known known;
    sampled(&view, &classification, &known, visible);
    assert_int_equal(known.answer[hidden], LRCSI_QUERY_UNDECIDED);
    assert_true(visible[hidden].high <= 0);
    for (uint32_t f = 0; f < 3; f++) {
        if (f != hidden) {
            assert_true(visible[f].low > 0 && visible[f].high > visible[f].low);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(active_tiles_hold_what_the_whole_picture_holds),
        cmocka_unit_test(tiles_about_undecided_facets_are_active),
        cmocka_unit_test(full_pixels_show_their_owner_in_every_part),
        cmocka_unit_test(pixels_where_facets_pierce_each_other_are_not_full),
        cmocka_unit_test(nothing_is_visible_below_the_occluded_height_of_a_pixel),
        cmocka_unit_test(what_one_of_several_covers_is_hidden_in_mixed_pixels_too),
        cmocka_unit_test(facets_that_pierce_each_other_are_seen_as_clipping_sees_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
