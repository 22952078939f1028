/* SPDX-License-Identifier: MIT */
/* Which part of a facet lies in the rectangle about an edge: fractions of a triangle that are known
   by elementary geometry, seen from above. */
#include "visibility/proximity/edge_rectangle.h"

#include "scenes.h"

static test_scene scene;
static lrcs_work work;
static lrcsi_view view;
static double unit; /* 1 in the scaled coordinates of the view */

/* The scene begins with facet 0: the triangle (0, 0, 0), (4, 0, 0), (4, 4, 0), of area 8, where y
   is at most x. */
static void triangle_begin(void)
{
    scene_start(&scene);
    scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){4, 0, 0},
                   (const double[3]){4, 4, 0});
}

/* Adds a triangle with a side between two points, and a third corner far to the right. Returns the
   first vertex of it; the side is between this one and the next. */
static uint32_t side_add(double x0, double y0, double z0, double x1, double y1, double z1)
{
    uint32_t first = scene.scene.vertex_count;
    scene_triangle(&scene, (const double[3]){x0, y0, z0}, (const double[3]){x1, y1, z1},
                   (const double[3]){9, 1, z0});
    return first;
}

static void look_from_above(void)
{
    lrcs_pose pose;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction((const double[3]){0, 0, 1}, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    const double *a = view.point[0].x;
    const double *b = view.point[1].x;
    unit = hypot(b[0] - a[0], b[1] - a[1]) / 4;
}

static const lrcsi_edge *edge_between(uint32_t a, uint32_t b)
{
    const lrcsi_topology *t = &view.prepared->topology;
    uint32_t e = 0;
    while (e < t->edge_count && !((t->edge[e].low == a && t->edge[e].high == b) ||
                                  (t->edge[e].low == b && t->edge[e].high == a))) {
        e++;
    }
    assert_true(e < t->edge_count);
    return &t->edge[e];
}

/* A fraction of facet 0 is rounded up: by a millionth of itself (mesh/slice.c), and by rounding. */
static void check_fraction(const lrcsi_slice *slice, double want)
{
    double fraction = lrcsi_slice_fraction(slice, 8 * unit * unit, 4 * sqrt(2) * unit);
    check_most(want, fraction);
    check_most(fraction, want * (1 + 1.01e-6));
}

/* The strip 1.5 <= x <= 2.5 has the area 2, of which 7/8 is left of x = 2 and 9/8 to the right. */
static void a_strip_about_a_long_edge_is_divided_by_it(void **state)
{
    (void)state;
    for (int up = 0; up < 2; up++) {
        triangle_begin();
        uint32_t v = up ? side_add(2, -1, 1, 2, 6, 1) : side_add(2, 6, 1, 2, -1, 1);
        look_from_above();
        const lrcsi_edge *edge = edge_between(v, v + 1);
        lrcsi_edge_rectangle box = lrcsi_edge_rectangle_make(&view, 0, edge, 0.5 * unit);
        lrcsi_slice slice = lrcsi_edge_rectangle_slice(&view, 0, &box);
        assert_true(box.has_sides);
        check_fraction(&slice, 2.0 / 8);
        int upward = (edge->low == v) == up; /* from low to high: the left is where x < 2 */
        lrcsi_slice left = lrcsi_edge_rectangle_limit(slice, &box, -1, 0);
        lrcsi_slice right = lrcsi_edge_rectangle_limit(slice, &box, 1, 0);
        check_fraction(&left, (upward ? 7 : 9) / 64.0);
        check_fraction(&right, (upward ? 9 : 7) / 64.0);
    }
}

/* The rectangle 1.5 <= x <= 2.5, 0.5 <= y <= 2.5 has the area 2, of which 1/2 is above y = x. */
static void a_rectangle_ends_beyond_the_ends_of_its_edge(void **state)
{
    (void)state;
    triangle_begin();
    uint32_t v = side_add(2, 1, 1, 2, 2, 1);
    look_from_above();
    lrcsi_edge_rectangle box =
        lrcsi_edge_rectangle_make(&view, 0, edge_between(v, v + 1), 0.5 * unit);
    lrcsi_slice slice = lrcsi_edge_rectangle_slice(&view, 0, &box);
    check_fraction(&slice, 1.5 / 8);
}

/* The square 1.5 <= x <= 2.5, 0.5 <= y <= 1.5, all of which is in the facet. */
static void the_rectangle_of_an_edge_seen_end_on_is_a_square(void **state)
{
    (void)state;
    triangle_begin();
    uint32_t v = side_add(2, 1, 1, 2, 1, 2);
    look_from_above();
    lrcsi_edge_rectangle box =
        lrcsi_edge_rectangle_make(&view, 0, edge_between(v, v + 1), 0.5 * unit);
    lrcsi_slice slice = lrcsi_edge_rectangle_slice(&view, 0, &box);
    assert_false(box.has_sides);
    check_fraction(&slice, 1.0 / 8);
}

/* The part of the facet's side from corner a to b that is in the rectangle. from > to: none is. */
static void check_part(const lrcsi_edge_rectangle *box, int a, int b, double from, double to)
{
    const lrcsi_segment_part part =
        lrcsi_edge_rectangle_part(box, view.point[a].x, view.point[b].x);
    assert_int_equal(lrcsi_segment_part_is_empty(part), from > to);
    if (from <= to) {
        check_abs(part.from, from, 1e-9);
        check_abs(part.to, to, 1e-9);
        check_most(part.from, from);
        check_most(to, part.to);
    }
}

/* The rectangle 0.5 <= x <= 1.5, -0.25 <= y <= 1.25 contains a part of the side from the origin to
   (4, 0), and of the diagonal. */
static void a_segment_is_in_a_rectangle_in_part(void **state)
{
    (void)state;
    triangle_begin();
    uint32_t v = side_add(1, 0.25, 1, 1, 0.75, 1);
    look_from_above();
    lrcsi_edge_rectangle box =
        lrcsi_edge_rectangle_make(&view, 0, edge_between(v, v + 1), 0.5 * unit);
    check_part(&box, 0, 1, 0.125, 0.375);
    check_part(&box, 1, 0, 0.625, 0.875);
    check_part(&box, 0, 2, 0.125, 1.25 / 4);
}

static void nothing_of_a_facet_is_near_a_distant_edge(void **state)
{
    (void)state;
    triangle_begin();
    uint32_t v = side_add(6, -1, 1, 6, 6, 1);
    look_from_above();
    const lrcsi_edge *edge = edge_between(v, v + 1);
    lrcsi_edge_rectangle box = lrcsi_edge_rectangle_make(&view, 0, edge, 1.9 * unit);
    lrcsi_slice slice = lrcsi_edge_rectangle_slice(&view, 0, &box);
    assert_int_equal(slice.count, 0);
    check_part(&box, 0, 1, 1, 0);
    box = lrcsi_edge_rectangle_make(&view, 0, edge, 3 * unit); /* 3 <= x <= 4 */
    slice = lrcsi_edge_rectangle_slice(&view, 0, &box);
    check_fraction(&slice, 3.5 / 8);
    check_part(&box, 0, 1, 0.75, 1);
    check_part(&box, 1, 0, 0, 0.25);
}

/* The edge is 1 below the facet's plane, which is more than 3 slack, or less. */
static void an_edge_is_behind_a_facet_if_it_is_three_slacks_below_its_plane(void **state)
{
    (void)state;
    triangle_begin();
    uint32_t below = side_add(2, 1, -1, 2, 2, -1);
    uint32_t above = side_add(2, 1, 1, 2, 2, 1);
    look_from_above();
    const lrcsi_edge *edge = edge_between(below, below + 1);
    assert_true(lrcsi_edge_rectangle_behind(&view, 0, edge, 0.33 * unit));
    assert_false(lrcsi_edge_rectangle_behind(&view, 0, edge, 0.34 * unit));
    edge = edge_between(above, above + 1);
    assert_false(lrcsi_edge_rectangle_behind(&view, 0, edge, 0.01 * unit));
}

/* The edge is at z = 0.9 x - 7.2, in front of the facet's plane from x = 8 on; beside the facet,
   which ends at x = 4, and in 2 slack beyond that it is behind. */
static void only_the_part_beside_a_facet_has_to_be_behind_it(void **state)
{
    (void)state;
    triangle_begin();
    uint32_t v = side_add(-2, 1, -9, 18, 1, 9);
    look_from_above();
    const lrcsi_edge *edge = edge_between(v, v + 1);
    assert_true(lrcsi_edge_rectangle_behind(&view, 0, edge, 0.7 * unit));  /* -2.34 at 5.4 */
    assert_false(lrcsi_edge_rectangle_behind(&view, 0, edge, 0.8 * unit)); /* -2.16 at 5.6 */
    assert_false(lrcsi_edge_rectangle_behind_plane(&view, 0, edge, 1e-3 * unit));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_strip_about_a_long_edge_is_divided_by_it),
        cmocka_unit_test(a_rectangle_ends_beyond_the_ends_of_its_edge),
        cmocka_unit_test(the_rectangle_of_an_edge_seen_end_on_is_a_square),
        cmocka_unit_test(a_segment_is_in_a_rectangle_in_part),
        cmocka_unit_test(nothing_of_a_facet_is_near_a_distant_edge),
        cmocka_unit_test(an_edge_is_behind_a_facet_if_it_is_three_slacks_below_its_plane),
        cmocka_unit_test(only_the_part_beside_a_facet_has_to_be_behind_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
