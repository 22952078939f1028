/* SPDX-License-Identifier: MIT */
/* The raster: shared edges leave no crack and no overlap, wherever they fall; the nearest facet
   owns its samples, as exact tests of each sample say, in whatever order facets come. */
#include "visibility/raster/raster.h"

#include "scenes.h"
#include "visibility/base/sample.h"

static test_scene scene;
static lrcs_work work;

static lrcsi_view view_from(const double d[3])
{
    lrcs_pose pose;
    lrcsi_view view;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    return view;
}

/* Draws into the work area behind the view; what was there of an earlier raster is lost. */
static lrcsi_raster drawn(const lrcsi_view *view, uint32_t size)
{
    lrcsi_raster raster;
    size_t mark = work.used;
    assert_int_equal(lrcsi_raster_make(view, size, NULL, NULL, &work, &raster), LRCS_OK);
    work.used = mark;
    return raster;
}

/* A square of n x n cells, each cut by a diagonal that turns from cell to cell; inner corners moved
   by `shift` of a cell. */
static void grid_of(uint32_t n, double shift)
{
    uint64_t seed = 9;
    scene_start(&scene);
    for (uint32_t y = 0; y <= n; y++) {
        for (uint32_t x = 0; x <= n; x++) {
            int inner = x > 0 && x < n && y > 0 && y < n;
            double dx = inner ? shift * (random_below(&seed, 3) - 1.0) : 0;
            double dy = inner ? shift * (random_below(&seed, 3) - 1.0) : 0;
            scene_vertex(&scene, x + dx, y + dy, 0);
        }
    }
    for (uint32_t y = 0; y < n; y++) {
        for (uint32_t x = 0; x < n; x++) {
            uint32_t a = y * (n + 1) + x;
            uint32_t b = a + n + 1;
            if ((x + y) % 2 == 0) {
                scene_facet(&scene, a, a + 1, b + 1);
                scene_facet(&scene, a, b + 1, b);
            } else {
                scene_facet(&scene, a, a + 1, b);
                scene_facet(&scene, a + 1, b + 1, b);
            }
        }
    }
}

static uint64_t covered_in_all(const lrcsi_raster *raster)
{
    uint64_t sum = 0;
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        sum += raster->covered[f];
    }
    return sum;
}

/* Samples whose owner is some facet. */
static uint64_t owned_in_all(const lrcsi_raster *raster)
{
    uint64_t count = 0;
    for (size_t i = 0; i < (size_t)raster->size * raster->size; i++) {
        count += raster->owner[i] != LRCS_NONE;
    }
    return count;
}

/* Seen from (0, 0, 1) the square fills the window: N^2 samples, each covered once, also where edges
   and corners run through pixel centres (8 cells on 24 pixels: corners at 3 k, centres at j + 1/2;
   shifted by 1/6 they meet). */
static void square_is_covered_once_without_cracks(void **state)
{
    (void)state;
    static const double shift[] = {0, 1 / 6.0, 0.125, 0.2};
    static const uint32_t size[] = {1, 2, 7, 8, 16, 24, 31, 100};
    for (int i = 0; i < 4; i++) {
        grid_of(8, shift[i]);
        lrcsi_view view = view_from((const double[3]){0, 0, 1});
        for (int k = 0; k < 8; k++) {
            lrcsi_raster raster = drawn(&view, size[k]);
            assert_int_equal(covered_in_all(&raster), size[k] * size[k]);
            assert_int_equal(owned_in_all(&raster), size[k] * size[k]);
        }
    }
}

static void no_sample_is_covered_twice_from_any_side(void **state)
{
    (void)state;
    static const double direction[][3] = {{1, 0, 1},  {1, 1, 1},      {1, 2, 3},     {0.6, 0, 0.8},
                                          {0, 1, 50}, {1, 1e-9, 0.1}, {-3, 2, 0.01}, {7, 7, 1}};
    for (int i = 0; i < 8; i++) {
        for (int k = 0; k < 2; k++) {
            grid_of(12, k == 0 ? 0 : 0.2);
            lrcsi_view view = view_from(direction[i]);
            for (uint32_t size = 5; size < 200; size = 2 * size + 1) {
                lrcsi_raster raster = drawn(&view, size);
                assert_int_equal(covered_in_all(&raster), owned_in_all(&raster));
                /* and no crack: every hole in a row would part its samples */
                for (uint32_t y = 0; y < size; y++) {
                    const uint32_t *row = raster.owner + (size_t)y * size;
                    unsigned runs = 0;
                    for (uint32_t x = 0; x < size; x++) {
                        runs += row[x] != LRCS_NONE && (x == 0 || row[x - 1] == LRCS_NONE);
                    }
                    assert_true(runs <= 1);
                }
            }
        }
    }
}

/* A fan about a point, its rim on a square: the apex falls on a pixel's centre for odd N. */
static void fan_covers_every_sample_once(void **state)
{
    (void)state;
    scene_start(&scene);
    uint32_t apex = scene_vertex(&scene, 0, 0, 0);
    const uint32_t side = 16;
    for (uint32_t i = 0; i < 4 * side; i++) {
        double t = 2.0 * (i % side) / side - 1;
        double x[4] = {1, -t, -1, t};
        double y[4] = {t, 1, -t, -1};
        scene_vertex(&scene, x[i / side], y[i / side], 0);
    }
    for (uint32_t i = 0; i < 4 * side; i++) {
        scene_facet(&scene, apex, 1 + i, 1 + (i + 1) % (4 * side));
    }
    lrcsi_view view = view_from((const double[3]){0, 0, 1});
    for (uint32_t size = 1; size <= 65; size += 4) {
        lrcsi_raster raster = drawn(&view, size);
        assert_int_equal(covered_in_all(&raster), size * size);
        assert_int_equal(owned_in_all(&raster), size * size);
    }
}

/* Plates at heights 0 .. 7 in mixed order, each shorter than the one below: a stair. */
static void highest_plate_owns_each_sample(void **state)
{
    (void)state;
    enum { N = 64 };
    static const int order[8] = {3, 7, 0, 5, 1, 6, 2, 4};
    scene_start(&scene);
    for (int i = 0; i < 8; i++) {
        int h = order[i];
        scene_plate(&scene, (const double[3]){0, 0, h * 0x1p-30}, (const double[3]){8.0 - h, 0, 0},
                    (const double[3]){0, 8, 0});
    }
    lrcsi_view view = view_from((const double[3]){0, 0, 1});
    lrcsi_raster raster = drawn(&view, N);
    for (uint32_t i = 0; i < N * N; i++) {
        uint32_t x = i % N / 8; /* the stair's step, counted from the top at x = 0 */
        assert_int_equal(order[raster.owner[i] / 2], 7 - x);
    }
    for (int i = 0; i < 8; i++) {
        assert_int_equal(raster.covered[2 * i] + raster.covered[2 * i + 1],
                         N * N * (8 - order[i]) / 8);
        assert_false(raster.order_undecided[2 * i]);
    }
}

/* Owners as points of the scene, whatever the order: for facets no two of which coincide. */
static void owners_do_not_depend_on_the_order_of_facets(void **state)
{
    (void)state;
    enum { N = 96 };
    static lrcs_facet before[N * N];
    scene_start(&scene);
    scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, 14);
    scene_box(&scene, (const double[3]){-2, -0.5, -0.5}, (const double[3]){2, 0.25, 0.75});
    scene_sphere(&scene, (const double[3]){0.5, 0.25, 0.5}, 0.75, 10);
    static const double direction[3][3] = {{0, 0, 1}, {1, 0, 1}, {0.3, -0.4, 0.5}};
    for (int i = 0; i < 3; i++) {
        for (uint64_t seed = 0; seed < 3; seed++) {
            if (seed > 0) {
                scene_shuffle(&scene, seed);
            }
            lrcsi_view view = view_from(direction[i]);
            lrcsi_raster raster = drawn(&view, N);
            for (uint32_t k = 0; k < N * N; k++) {
                lrcs_facet facet = {{LRCS_NONE, LRCS_NONE, LRCS_NONE}};
                if (raster.owner[k] != LRCS_NONE) {
                    facet = scene.facet[raster.owner[k]];
                }
                if (seed == 0) {
                    before[k] = facet;
                }
                assert_memory_equal(&facet, &before[k], sizeof facet);
            }
        }
    }
}

/* The facet nearest the laser at a sample, by exact tests of all facets. */
static uint32_t exact_owner(const lrcsi_raster *raster, uint32_t x, uint32_t y)
{
    const lrcsi_view *view = raster->view;
    double point[3];
    uint32_t owner = LRCS_NONE;
    lrcsi_raster_sample(raster, x, y, point);
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        if (lrcsi_view_casts(view, f) && lrcsi_sample_covers(view, f, point) &&
            (owner == LRCS_NONE || lrcsi_sample_nearer(view, f, owner, point, 1) > 0)) {
            owner = f;
        }
    }
    return owner;
}

static unsigned check_owners(const double direction[3], uint32_t size)
{
    unsigned owned = 0;
    lrcsi_view view = view_from(direction);
    view.backs.cast = 1;
    lrcsi_raster raster = drawn(&view, size);
    for (uint32_t y = 0; y < size; y++) {
        for (uint32_t x = 0; x < size; x++) {
            uint32_t owner = exact_owner(&raster, x, y);
            assert_int_equal(raster.owner[y * size + x], owner);
            owned += owner != LRCS_NONE;
        }
    }
    return owned;
}

static void owners_are_those_of_exact_samples(void **state)
{
    (void)state;
    static const double direction[][3] = {{0, 0, 1},     {1, 0, 1}, {0.3, -0.4, 0.5},
                                          {-1, -2, 0.1}, {1, 1, 1}, {-0.7, 0.2, -0.9}};
    static const uint32_t size[] = {1, 2, 7, 33, 50};
    unsigned owned = 0;
    for (int s = 0; s < 6; s++) {
        for (int i = 0; i < 6; i++) {
            for (int k = 0; k < 5; k++) {
                if (s == 0) {
                    scene_many_bodies(&scene, 8, 6);
                } else {
                    scene_crossing_triangles(&scene, (uint64_t)s);
                }
                owned += check_owners(direction[i], size[k]);
            }
        }
    }
    assert_true(owned > 50000);
}

/* Plates that intersect along a line that meets samples exactly; beside them, and behind one of
   them, plates so steep that no float holds their heights. */
static void owners_on_a_crossing_and_of_steep_facets_are_those_of_exact_samples(void **state)
{
    (void)state;
    unsigned owned = 0;
    for (int steep = 0; steep < 4; steep++) {
        for (uint32_t size = 1; size < 70; size++) {
            double rise = ldexp(1, 18 + 2 * steep);
            scene_start(&scene);
            scene_plate(&scene, (const double[3]){-1, -1, 0}, (const double[3]){2, 0, 0},
                        (const double[3]){0, 2, 0});
            scene_plate(&scene, (const double[3]){-1, -1, -1}, (const double[3]){2, 0, 2},
                        (const double[3]){0, 2, 0});
            scene_plate(&scene, (const double[3]){-1, -1, 2}, (const double[3]){1, 0, 0},
                        (const double[3]){0, 1, -2});
            if (steep > 0) {
                scene_plate(&scene, (const double[3]){1, -1, -rise}, (const double[3]){1, 0, rise},
                            (const double[3]){0, 2, 0});
                scene_plate(&scene, (const double[3]){-2, -1, rise},
                            (const double[3]){1.5, 0, -rise}, (const double[3]){0, 2, -2 * rise});
            }
            owned += check_owners((const double[3]){0, 0, 1}, size);
        }
    }
    assert_true(owned > 100000);
}

/* Two facets so close to edge-on that floats cannot hold the slopes of their planes. */
static void facets_all_but_edge_on_own_what_they_cover(void **state)
{
    (void)state;
    unsigned owned = 0;
    for (int order = 0; order < 2; order++) {
        for (uint32_t size = 1; size < 20; size += 2) {
            scene_start(&scene);
            for (int i = 0; i < 2; i++) {
                double low = (i == order) ? -4 : -3;
                scene_plate(&scene, (const double[3]){0, -1, low},
                            (const double[3]){0x1p-140, 0, 8}, (const double[3]){0, 1, 0});
            }
            owned += check_owners((const double[3]){0, 0, 1}, size);
        }
    }
    assert_true(owned > 50);
}

/* Heights of owners' planes against long double, within their error bounds, and the depths that are
   stored as floats. */
static void heights_lie_within_their_error_bounds(void **state)
{
    (void)state;
    enum { N = 40 };
    scene_start(&scene);
    scene_sphere(&scene, (const double[3]){100, 50, -30}, 2, 20);
    lrcsi_view view = view_from((const double[3]){0.5, 0.25, 1});
    lrcsi_raster raster = drawn(&view, N);
    const lrcs_prepared *p = view.prepared;
    for (uint32_t k = 0; k < N * N; k++) {
        uint32_t f = raster.owner[k];
        if (f == LRCS_NONE) {
            continue;
        }
        double point[3];
        lrcsi_view_unproject(&view, view.low[0] + (k % N + 0.5) * raster.pixel,
                             view.low[1] + (k / N + 0.5) * raster.pixel, point);
        const double *a = lrcsi_prepared_corner(p, f, 0);
        long double top = 0;
        long double bottom = 0;
        long double base = 0; /* the lifted point's own height above the centre's plane */
        for (int i = 0; i < 3; i++) {
            top += (long double)p->normal[f].high[i] * ((long double)a[i] - point[i]);
            bottom += (long double)p->normal[f].high[i] * view.direction[i];
            base += ((long double)point[i] - p->centre[i]) * view.direction[i];
        }
        double want = (double)(top / bottom * view.length + base / view.length);
        lrcsi_plane plane = lrcsi_raster_plane(&raster, f);
        double height = plane.c + plane.dx * (k % N + 0.5) + plane.dy * (k / N + 0.5);
        check_abs(height, want, plane.err);
        check_most(plane.err, 1e-10);
        check_abs((double)raster.depth[k], want, 0x1p-20 * view.side);
    }
}

/* The line in which two plates intersect, and how far it may be from where they meet. */
static void planes_intersect_in_a_line_through_the_box(void **state)
{
    (void)state;
    lrcsi_raster_segment line;
    const double *a = line.a;
    const double *b = line.b;
    unsigned lines = 0;
    uint64_t seed = 3;
    for (int i = 0; i < 200; i++) {
        double rise[2] = {random_below(&seed, 17) / 8.0 - 1, random_below(&seed, 17) / 8.0 - 1};
        double shift = random_below(&seed, 65) / 32.0 - 1;
        scene_start(&scene);
        scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){8, 0, 0},
                    (const double[3]){0, 8, 0});
        scene_plate(&scene, (const double[3]){0, 0, shift}, (const double[3]){8, 0, 8 * rise[0]},
                    (const double[3]){0, 8, 8 * rise[1]});
        lrcsi_view view = view_from((const double[3]){0, 0, 1});
        lrcsi_raster raster;
        lrcsi_raster_layout(&view, 64, &raster);
        lrcsi_edge_functions box = lrcsi_raster_edge_functions(&raster, 0);
        int crosses = lrcsi_raster_intersection(&raster, &box, 0, 2, &line);
        if (rise[0] == 0 && rise[1] == 0) {
            assert_false(line.err <= LRCSI_RASTER_LINE_ERR_MAX); /* parallel */
            continue;
        }
        check_most(line.err, 1e-6);
        unsigned met = 0; /* points of the window, an eighth of a pixel apart, at which they meet */
        for (uint32_t k = 0; k <= 512; k++) {
            double along = k / 8.0;
            int axis = fabs(rise[1]) > fabs(rise[0]); /* the coordinate that follows from `along` */
            double across = -(8 * shift + rise[!axis] * along) / rise[axis];
            if (!(across >= 0 && across <= 64)) {
                continue;
            }
            const double at[2] = {axis == 0 ? across : along, axis == 0 ? along : across};
            met++;
            assert_true(crosses);
            double dx = b[0] - a[0];
            double dy = b[1] - a[1];
            double length = sqrt(dx * dx + dy * dy);
            double t = ((at[0] - a[0]) * dx + (at[1] - a[1]) * dy) / length;
            double off = ((at[0] - a[0]) * dy - (at[1] - a[1]) * dx) / length;
            assert_true(t > 0 && t < length);
            check_most(fabs(off), line.err + 1e-13);
        }
        lines += met > 0;
    }
    assert_true(lines > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(square_is_covered_once_without_cracks),
        cmocka_unit_test(no_sample_is_covered_twice_from_any_side),
        cmocka_unit_test(fan_covers_every_sample_once),
        cmocka_unit_test(highest_plate_owns_each_sample),
        cmocka_unit_test(owners_do_not_depend_on_the_order_of_facets),
        cmocka_unit_test(owners_are_those_of_exact_samples),
        cmocka_unit_test(owners_on_a_crossing_and_of_steep_facets_are_those_of_exact_samples),
        cmocka_unit_test(facets_all_but_edge_on_own_what_they_cover),
        cmocka_unit_test(heights_lie_within_their_error_bounds),
        cmocka_unit_test(planes_intersect_in_a_line_through_the_box),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
