/* SPDX-License-Identifier: MIT */
/* What the sampled areas draw, against the whole picture: the tiles that matter hold just what the
   picture holds there, and the memory of the others is never touched. */
#include "visibility/raster/visible.h"

#include "scenes.h"
#include "visibility/occlude.h"
#include "visibility/uniform/query.h"

enum { N = 72, FINE = 8 };
static const unsigned char untouched = 0xa5;

static test_scene scene;
static lrcs_work work;

/* Bodies before, behind and through one another; an open plate that shows its back. */
static void bodies_and_a_plate(void)
{
    scene_bodies(&scene, 12, 16);
    scene_plate(&scene, (const double[3]){-3, 1, -1}, (const double[3]){3, 0.125, 0.5},
                (const double[3]){0.25, 0.5, 3});
}

static lrcsi_view view_from(int i)
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
static int undecided_order; /* as the last raster found */

static lrcsi_raster sampled(const lrcsi_view *view, lrcsi_classification *classification,
                            lrcsi_decisions *known, lrcsi_visible_area *visible)
{
    lrcsi_raster raster;
    assert_int_equal(lrcsi_classify_make(view, NULL, &work, classification), LRCS_OK);
    assert_int_equal(lrcsi_decisions_make(classification, &work, known), LRCS_OK);
    size_t need = lrcsi_visible_areas_need(view->prepared, N);
    assert_true(work.size - work.used >= need);
    memset(work.bytes + work.used, untouched, need);
    size_t before = work.peak = work.used;
    assert_int_equal(
        lrcsi_visible_areas_from_samples(known, N, NULL, &work, visible, &undecided_order),
        LRCS_OK);
    assert_true(work.used == before && work.peak - before <= need);
    assert_int_equal(lrcsi_raster_make(view, N, known->answer, NULL, &work, &raster), LRCS_OK);
    return raster;
}

static void active_tiles_hold_what_the_whole_picture_holds(void **state)
{
    (void)state;
    static lrcsi_visible_area visible[SCENE_FACETS];
    unsigned active = 0;
    unsigned left = 0;
    for (int i = 0; i < 4; i++) {
        bodies_and_a_plate();
        lrcsi_view view = view_from(i);
        lrcsi_classification classification;
        lrcsi_decisions known;
        lrcsi_raster whole;
        lrcsi_raster raster = sampled(&view, &classification, &known, visible);
        assert_int_equal(lrcsi_raster_make(&view, N, NULL, NULL, &work, &whole), LRCS_OK);
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
                assert_memory_equal(&raster.depth[k], &raster.owner[k], sizeof raster.depth[k]);
                assert_memory_equal(&raster.occluder[k], &raster.owner[k], sizeof raster.depth[k]);
            }
        }
        for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
            if (known.answer[f] == LRCSI_QUERY_NO_ANSWER) {
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
    static lrcsi_visible_area visible[SCENE_FACETS];
    unsigned seen = 0;
    for (int i = 0; i < 4; i++) {
        bodies_and_a_plate();
        lrcsi_view view = view_from(i);
        lrcsi_classification classification;
        lrcsi_decisions known;
        lrcsi_raster raster = sampled(&view, &classification, &known, visible);
        for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
            lrcsi_edge_functions e = lrcsi_raster_edge_functions(&raster, f);
            for (uint32_t y = e.bottom; known.answer[f] == LRCSI_QUERY_NO_ANSWER && y < e.top;
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

/* A pixel that a facet known to be visible covers shows that facet in every part: so says a picture
   eight times as fine. */
static void pixels_covered_by_visible_facets_show_these_in_every_part(void **state)
{
    (void)state;
    static lrcsi_visible_area visible[SCENE_FACETS];
    unsigned full = 0;
    for (int i = 0; i < 4; i++) {
        bodies_and_a_plate();
        lrcsi_view view = view_from(i);
        lrcsi_classification classification;
        lrcsi_decisions known;
        lrcsi_raster fine;
        lrcsi_raster raster = sampled(&view, &classification, &known, visible);
        assert_int_equal(lrcsi_raster_make(&view, N * FINE, NULL, NULL, &work, &fine), LRCS_OK);
        for (uint32_t k = 0; k < N * N * FINE * FINE; k++) {
            uint32_t x = k % (N * FINE) / FINE;
            uint32_t y = k / (N * FINE) / FINE;
            uint32_t owner = lrcsi_raster_owner(&raster, x, y);
            if (owner != LRCS_NONE && raster.occluder[y * N + x] >= HUGE_VALF) {
                assert_int_equal(known.answer[owner], LRCSI_QUERY_VISIBLE);
                assert_int_equal(fine.owner[k], owner);
                full++;
            }
        }
    }
    assert_true(full > 1000);
}

/* The exact area of each facet, from clipping, is within the bounds from samples. Returns the sum
   of the widths of the bounds, in relation to all that is visible. */
static double check_bounds(const lrcsi_view *view, uint32_t size, unsigned *parted)
{
    static lrcsi_visible_area visible[SCENE_FACETS];
    static lrcsi_visible_area exact[SCENE_FACETS];
    lrcsi_classification classification;
    lrcsi_decisions known;
    double width = 0;
    double all = 0;
    assert_int_equal(lrcsi_classify_make(view, NULL, &work, &classification), LRCS_OK);
    size_t mark = work.used;
    assert_int_equal(lrcsi_occlude_all(&classification, NULL, NULL, &work, NULL, exact, NULL),
                     LRCS_OK);
    work.used = mark;
    assert_int_equal(lrcsi_decisions_make(&classification, &work, &known), LRCS_OK);
    assert_int_equal(
        lrcsi_visible_areas_from_samples(&known, size, NULL, &work, visible, &undecided_order),
        LRCS_OK);
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        const lrcsi_visible_area *v = &visible[f];
        double rounding = 1e-14 * view->side * view->side;
        check_most(v->low, exact[f].high + rounding);
        check_most(exact[f].low, v->high + rounding);
        check_most(v->low, v->area + rounding);
        check_most(v->area, v->high + rounding);
        *parted += v->low > 0 && v->low < v->high && v->high < lrcsi_view_projected(view, f);
        width += v->high - v->low;
        all += exact[f].area;
    }
    return width / all;
}

static void bounds_hold_the_exact_area_of_each_facet(void **state)
{
    (void)state;
    static const uint32_t size[] = {1, 3, 16, 50, 128, 333};
    unsigned parted = 0;
    for (int i = 0; i < 24; i++) {
        double before = HUGE_VAL;
        for (int k = 0; k < 6; k++) {
            if (i < 4) {
                bodies_and_a_plate();
            } else {
                scene_crossing_triangles(&scene, (uint64_t)i);
            }
            lrcsi_view view = view_from(i % 4);
            double width = check_bounds(&view, size[k], &parted);
            if (size[k] >= 50) { /* they shrink with the size of pixels */
                check_most(width, 0.5 * before);
                before = width;
            }
        }
        check_most(before, 0.25);
    }
    assert_true(parted > 500);
}

/* Symptom: where no facet was known to be seen whole, the areas of none were computed, from
   nowhere. */
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

/* Draws all facets that cast, as if undecided; returns how many pixels have an occluder height.
   What is visible in any part of a pixel, says a picture eight times as fine, lies no lower. */
static unsigned check_occluders(int direction)
{
    static unsigned char answer[SCENE_FACETS];
    lrcsi_view view = view_from(direction);
    lrcsi_raster raster;
    lrcsi_raster fine;
    unsigned count = 0;
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        answer[f] = lrcsi_view_casts(&view, f) ? LRCSI_QUERY_NO_ANSWER : LRCSI_QUERY_HIDDEN;
    }
    assert_int_equal(lrcsi_raster_make(&view, N, answer, NULL, &work, &raster), LRCS_OK);
    assert_int_equal(lrcsi_raster_make(&view, N * FINE, NULL, NULL, &work, &fine), LRCS_OK);
    for (uint32_t y = 0; y < N * FINE; y++) {
        for (uint32_t x = 0; x < N * FINE; x++) {
            uint32_t pixel = y / FINE * N + x / FINE;
            if (!(lrcsi_raster_owner(&raster, x / FINE, y / FINE) != LRCS_NONE &&
                  raster.occluder[pixel] > -HUGE_VALF)) {
                continue;
            }
            uint32_t owner = fine.owner[y * N * FINE + x];
            count += x % FINE == 0 && y % FINE == 0;
            assert_true(owner != LRCS_NONE);
            lrcsi_plane plane = lrcsi_raster_plane(&fine, owner);
            double height = plane.c + plane.dx * (x + 0.5) + plane.dy * (y + 0.5);
            assert_true(height + plane.err >= (double)raster.occluder[pixel]);
        }
    }
    return count;
}

static void nothing_is_visible_below_the_occluded_height_of_a_pixel(void **state)
{
    (void)state;
    unsigned count = 0;
    for (int i = 0; i < 12; i++) {
        bodies_and_a_plate();
        count += i < 4 ? check_occluders(i) : 0;
        scene_crossing_triangles(&scene, (uint64_t)i + 1);
        count += check_occluders(i % 4);
    }
    assert_true(count > 5000);
}

/* Two plates that overlap hide a third, which neither covers alone and which the edges of both
   cross. A fourth, far in front, makes some of the pixels mixed for all three. */
static void what_one_of_several_covers_is_hidden_in_mixed_pixels_too(void **state)
{
    (void)state;
    static lrcsi_visible_area visible[SCENE_FACETS];
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){-8, -4, 1}, (const double[3]){2, -4, 1},
                   (const double[3]){0.5, 8, 1});
    scene_triangle(&scene, (const double[3]){8, -4, 2}, (const double[3]){-0.5, 8, 2},
                   (const double[3]){-2, -4, 2});
    uint32_t hidden = scene_triangle(&scene, (const double[3]){-3, -2, 0},
                                     (const double[3]){3, -2, 0.25}, (const double[3]){0, -1, 0});
    scene_triangle(&scene, (const double[3]){-4, -3, 4}, (const double[3]){4, -0.5, 4},
                   (const double[3]){3.75, 0, 4});
    lrcsi_view view = view_from(0);
    lrcsi_classification classification;
    lrcsi_decisions known;
    sampled(&view, &classification, &known, visible);
    assert_int_equal(known.answer[hidden], LRCSI_QUERY_NO_ANSWER);
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
        cmocka_unit_test(pixels_covered_by_visible_facets_show_these_in_every_part),
        cmocka_unit_test(bounds_hold_the_exact_area_of_each_facet),
        cmocka_unit_test(nothing_is_visible_below_the_occluded_height_of_a_pixel),
        cmocka_unit_test(what_one_of_several_covers_is_hidden_in_mixed_pixels_too),
        cmocka_unit_test(facets_that_pierce_each_other_are_seen_as_clipping_sees_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
