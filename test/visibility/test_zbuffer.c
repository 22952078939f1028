/* SPDX-License-Identifier: MIT */
/* Areas from samples, against clipping: within their bounds, exact where no event is visible, near
   the truth elsewhere; whatever the resolution, and in as little memory as is promised. */
#include "visibility/zbuffer.h"

#include "scenes.h"
#include "visibility/occlude.h"

static test_scene scene;
static lrcs_work work;
static lrcsi_visible visible[SCENE_FACETS], truth[SCENE_FACETS];

static const double seen_along[][3] = {{0, 0, 1},     {1, 0, 1}, {0.3, -0.4, 0.5},
                                       {-1, -2, 0.1}, {1, 1, 1}, {-0.7, 0.2, -0.9}};
enum { DIRECTIONS = sizeof seen_along / sizeof *seen_along };

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

/* Large triangles of all slopes, each through all others. */
static void tangle(uint64_t seed)
{
    scene_start(&scene);
    for (int i = 0; i < 12; i++) {
        double corner[3][3];
        for (int k = 0; k < 3; k++) {
            double angle = 2 * (double)SCENE_PI * (k + scene_random(&seed, 64) / 192.0) / 3;
            corner[k][0] = 2 * cos(angle);
            corner[k][1] = 2 * sin(angle);
            corner[k][2] = scene_random(&seed, 256) / 64.0 - 2;
        }
        scene_triangle(&scene, corner[0], corner[1], corner[2]);
    }
}

/* Two surfaces folded along one line, in different pieces, that change places across it: no inside
   is touched, and all edges on the line join facets; only their ends tell. */
static void folded_through_one_another(void)
{
    scene_start(&scene);
    uint32_t k[4] = {scene_vertex(&scene, 0, -1, 0), scene_vertex(&scene, 0, 1, 0),
                     scene_vertex(&scene, -1, 0, 0), scene_vertex(&scene, 1, 0, -1)};
    uint32_t q[4] = {scene_vertex(&scene, 0, -2, 0), scene_vertex(&scene, 0, 2, 0),
                     scene_vertex(&scene, -1, 0.25, -1), scene_vertex(&scene, 1, 0.25, 0)};
    scene_facet(&scene, k[0], k[1], k[2]);
    scene_facet(&scene, k[0], k[3], k[1]);
    scene_facet(&scene, q[0], q[1], q[2]);
    scene_facet(&scene, q[0], q[3], q[1]);
}

/* A square stored twice with opposite diagonals. */
static void square_twice(void)
{
    scene_start(&scene);
    uint32_t v[4] = {scene_vertex(&scene, 0, 0, 0), scene_vertex(&scene, 1, 0, 0),
                     scene_vertex(&scene, 1, 1, 0), scene_vertex(&scene, 0, 1, 0)};
    scene_facet(&scene, v[0], v[1], v[2]);
    scene_facet(&scene, v[1], v[2], v[3]);
    scene_facet(&scene, v[0], v[1], v[3]);
    scene_facet(&scene, v[0], v[2], v[3]);
}

static lrcsi_view seen_from(int i)
{
    lrcs_pose pose;
    lrcsi_view view;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction(seen_along[i], &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    view.backs_cast = 1;
    return view;
}

/* The truth, from clipping: each area to 1e-9. */
static void clipped(const lrcsi_view *view)
{
    size_t mark = work.used;
    lrcsi_contest contest;
    uint32_t starved;
    assert_int_equal(lrcsi_contest_make(view, &work, &contest), LRCS_OK);
    assert_int_equal(lrcsi_occlude_all(&contest, &work, truth, &starved), LRCS_OK);
    assert_int_equal(starved, 0);
    work.used = mark;
}

/* What a raster leaves open, of all that is visible. */
static double checked(const lrcsi_view *view, uint32_t size, unsigned *exact, unsigned *open)
{
    lrcsi_zbuffer zbuffer;
    double gap = 0;
    double all = 0;
    size_t mark = work.peak = work.used;
    assert_int_equal(lrcsi_zbuffer_make(view, size, NULL, &work, visible, &zbuffer), LRCS_OK);
    assert_true(work.peak - mark <= lrcsi_zbuffer_need(view->prepared, size));
    assert_int_equal(work.used, mark);
    uint32_t partial = 0;
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        const lrcsi_visible *v = &visible[f];
        double spare = 1e-12 + truth[f].high - truth[f].low;
        assert_true(0 <= v->low && v->low <= v->area && v->area <= v->high);
        assert_true(v->high <= lrcsi_view_projected(view, f));
        check_most(v->low, truth[f].high + spare);
        check_most(truth[f].low - spare, v->high);
        partial += v->low < v->high;
        *exact += v->low == v->high && v->high > 0;
        *open += v->low < v->high;
        gap += v->high - v->low;
        all += truth[f].area;
    }
    assert_int_equal(partial, zbuffer.partial);
    return gap / all;
}

static void areas_lie_within_bounds_that_close(void **state)
{
    (void)state;
    static const uint32_t size[] = {1, 3, 16, 67, 256, 1000};
    for (int k = 0; k < 6; k++) {
        unsigned exact = 0;
        unsigned open = 0;
        double gap = 0;
        for (int s = 0; s < 8; s++) {
            for (int i = 0; i < DIRECTIONS; i++) {
                if (s == 0) {
                    crowd();
                } else if (s == 1) {
                    folded_through_one_another();
                } else if (s == 2) {
                    square_twice();
                } else {
                    tangle((uint64_t)s);
                }
                lrcsi_view view = seen_from(i);
                clipped(&view);
                double left = checked(&view, size[k], &exact, &open);
                gap = left > gap ? left : gap;
            }
        }
        assert_true(open > 100);
        assert_true(k < 3 || exact > 200);
        check_most(gap, size[k] < 256 ? 8 : 250.0 / size[k]);
    }
}

/* Symptom: where no event is visible, areas came from samples. */
static void a_body_that_hides_nothing_of_itself_has_exact_areas(void **state)
{
    (void)state;
    unsigned exact = 0;
    unsigned open = 0;
    scene_start(&scene); /* a wavy sheet, all of it facing the laser: events on its rim only */
    enum { N = 20 };
    for (uint32_t i = 0; i <= N * N + 2 * N; i++) {
        double x = i % (N + 1);
        double y = i / (N + 1);
        scene_vertex(&scene, x, y, 0.2 * sin(x) * cos(0.7 * y));
    }
    for (uint32_t i = 0; i < N * N; i++) {
        uint32_t a = i / N * (N + 1) + i % N;
        scene_facet(&scene, a, a + 1, a + N + 2);
        scene_facet(&scene, a, a + N + 2, a + N + 1);
    }
    lrcsi_view view = seen_from(0);
    clipped(&view);
    checked(&view, 200, &exact, &open);
    assert_true(open <= 8 * N && exact >= 2 * (N - 2) * (N - 2));
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) { /* and all else is whole, too */
        check_abs(visible[f].area, truth[f].area, 1e-12);
    }
}

/* Facets far smaller than a pixel: those of a smooth body's inside are known without any sample. */
static void facets_without_samples_are_told_by_their_neighbours(void **state)
{
    (void)state;
    unsigned exact = 0;
    unsigned open = 0;
    scene_start(&scene);
    scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, 40);
    lrcsi_view view = seen_from(2);
    clipped(&view);
    checked(&view, 24, &exact, &open);
    assert_true(exact > scene.scene.facet_count / 4);
}

static void memory_below_the_need_is_refused_and_nothing_is_lost(void **state)
{
    (void)state;
    lrcsi_zbuffer zbuffer = {77, 77};
    crowd();
    lrcsi_view view = seen_from(2);
    size_t mark = work.peak = work.used;
    assert_int_equal(lrcsi_zbuffer_make(&view, 50, NULL, &work, visible, &zbuffer), LRCS_OK);
    size_t peak = work.peak - mark;
    assert_true(zbuffer.partial != 77);
    for (size_t bytes = 0; bytes < peak; bytes += 1 + bytes / 7) {
        lrcs_work small = lrcs_work_make(work.bytes + work.used, bytes);
        zbuffer = (lrcsi_zbuffer){77, 77};
        assert_int_equal(lrcsi_zbuffer_make(&view, 50, NULL, &small, visible, &zbuffer),
                         LRCS_E_MEMORY);
        assert_int_equal(small.used, 0);
        assert_int_equal(zbuffer.partial, 77);
    }
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(areas_lie_within_bounds_that_close),
        cmocka_unit_test(a_body_that_hides_nothing_of_itself_has_exact_areas),
        cmocka_unit_test(facets_without_samples_are_told_by_their_neighbours),
        cmocka_unit_test(memory_below_the_need_is_refused_and_nothing_is_lost),
        cmocka_unit_test(facets_that_pierce_each_other_are_seen_as_clipping_sees_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
