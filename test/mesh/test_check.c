/* SPDX-License-Identifier: MIT */
/* The mesh report: counts, box, area and volume. Convexity has test_convex.c. */
#include <lrcs/mesh.h>

#include <stdlib.h>
#include <string.h>

#include "check.h"
#include "mesh/cube.h"

enum { ROOM = 1 << 20 };

static unsigned char room[ROOM];

static lrcs_mesh_report report_of(const lrcs_point *vertex, uint32_t vertices,
                                  const lrcs_facet *facet, uint32_t facets)
{
    lrcs_work work = lrcs_work_make(room, ROOM);
    lrcs_mesh_report report;
    assert_int_equal(lrcs_mesh_check(vertex, vertices, facet, facets, &work, &report), LRCS_OK);
    assert_int_equal(work.used, 0);
    assert_true(work.peak <= lrcs_mesh_check_need(vertices, facets));
    return report;
}

static void a_cube_is_whole(void **state)
{
    (void)state;
    lrcs_mesh_report r = report_of(cube_vertex, 8, cube_facet, 12);
    assert_int_equal(r.vertices, 8);
    assert_int_equal(r.edges, 18);
    assert_int_equal(r.degenerate + r.duplicate + r.opposite_pairs, 0);
    assert_int_equal(r.boundary_edges + r.nonmanifold_edges + r.misoriented_edges, 0);
    assert_true(r.closed && r.convex);
    check_same(r.area, 6.0);
    check_same(r.volume, 1.0);
    for (int k = 0; k < 3; k++) {
        check_same(r.box_min[k], 0.0);
        check_same(r.box_max[k], 1.0);
    }
}

static void an_inverted_cube_is_closed_with_negative_volume(void **state)
{
    (void)state;
    lrcs_facet facet[12];
    for (int f = 0; f < 12; f++) {
        const uint32_t *c = cube_facet[f].corner;
        facet[f] = (lrcs_facet){{c[0], c[2], c[1]}};
    }
    lrcs_mesh_report r = report_of(cube_vertex, 8, facet, 12);
    assert_true(r.closed && !r.convex);
    check_same(r.volume, -1.0);
    check_same(r.area, 6.0);
}

static void a_missing_facet_opens_three_edges(void **state)
{
    (void)state;
    lrcs_mesh_report r = report_of(cube_vertex, 8, cube_facet, 11);
    assert_int_equal(r.boundary_edges, 3);
    assert_true(!r.closed && !r.convex);
    check_same(r.area, 5.5);
}

static void a_flipped_facet_disagrees_along_three_edges(void **state)
{
    (void)state;
    lrcs_facet facet[12];
    memcpy(facet, cube_facet, sizeof facet);
    facet[3] = (lrcs_facet){{4, 7, 6}};
    lrcs_mesh_report r = report_of(cube_vertex, 8, facet, 12);
    assert_int_equal(r.misoriented_edges, 3);
    assert_true(!r.closed && !r.convex);
}

static void degenerate_facets_count_once_and_nowhere_else(void **state)
{
    (void)state;
    lrcs_point vertex[10];
    lrcs_facet facet[16];
    memcpy(vertex, cube_vertex, sizeof cube_vertex);
    memcpy(facet, cube_facet, sizeof cube_facet);
    vertex[8] = (lrcs_point){{0.5, 0.0, 0.0}};
    vertex[9] = (lrcs_point){{-7.0, 0.0, 0.0}};
    facet[12] = (lrcs_facet){{0, 8, 1}};
    facet[13] = (lrcs_facet){{0, 8, 1}};
    facet[14] = (lrcs_facet){{4, 4, 6}};
    facet[15] = (lrcs_facet){{9, 9, 9}};
    lrcs_mesh_report r = report_of(vertex, 10, facet, 16);
    assert_int_equal(r.degenerate, 4);
    assert_int_equal(r.vertices, 8);
    assert_int_equal(r.edges, 18);
    assert_int_equal(r.duplicate, 0);
    assert_true(r.closed && r.convex);
    check_same(r.area, 6.0);
    check_same(r.box_min[0], -7.0);
    check_same(r.volume, 1.0);
}

static void repeats_count_against_the_earliest_facet(void **state)
{
    (void)state;
    const lrcs_facet facet[7] = {{{0, 1, 2}}, {{1, 2, 0}}, {{0, 2, 1}}, {{2, 1, 0}},
                                 {{0, 1, 3}}, {{3, 1, 0}}, {{1, 2, 3}}};
    lrcs_mesh_report r = report_of(cube_vertex, 8, facet, 7);
    assert_int_equal(r.duplicate, 4);
    assert_int_equal(r.opposite_pairs, 3);
}

static void repeats_are_found_by_position_not_by_index(void **state)
{
    (void)state;
    const lrcs_point vertex[6] = {{{0, 0, 0}},    {{1, 0, 0}}, {{0, 1, 0}},
                                  {{1, 0, -0.0}}, {{0, 1, 0}}, {{-0.0, 0, 0}}};
    const lrcs_facet facet[2] = {{{0, 1, 2}}, {{4, 3, 5}}};
    lrcs_mesh_report r = report_of(vertex, 6, facet, 2);
    assert_int_equal(r.vertices, 3);
    assert_int_equal(r.edges, 3);
    assert_int_equal(r.duplicate, 1);
    assert_int_equal(r.opposite_pairs, 1);
    assert_true(r.closed && !r.convex);
}

static void three_skins_on_an_edge_are_nonmanifold(void **state)
{
    (void)state;
    const lrcs_facet facet[4] = {{{0, 1, 2}}, {{1, 0, 4}}, {{0, 1, 5}}, {{1, 0, 6}}};
    lrcs_mesh_report r = report_of(cube_vertex, 8, facet, 3);
    assert_int_equal(r.nonmanifold_edges, 1);
    assert_int_equal(r.boundary_edges, 6);
    assert_int_equal(r.misoriented_edges, 0);
    r = report_of(cube_vertex, 8, facet, 4);
    assert_int_equal(r.nonmanifold_edges, 1);
}

/* (1, 1, 1) x (2 + d, 2, 2) = (0, d, -d), and so the area is d / sqrt 2. */
static void a_sliver_far_from_the_origin_has_its_area(void **state)
{
    (void)state;
    const double d = 0x1p-30;
    const lrcs_point vertex[3] = {
        {{1e6, 1e6, 1e6}}, {{1e6 + 1, 1e6 + 1, 1e6 + 1}}, {{1e6 + 2 + d, 1e6 + 2, 1e6 + 2}}};
    const lrcs_facet facet[1] = {{{0, 1, 2}}};
    lrcs_mesh_report r = report_of(vertex, 3, facet, 1);
    check_rel(r.area, d / sqrt(2.0), 1e-15);
    assert_int_equal(r.boundary_edges, 3);
}

/* A box of sides 1, 2 and t, moved and scaled: area 2 (2 + t + 2 t), volume 2 t. */
static void check_box(double at, double thick, double scale)
{
    lrcs_point vertex[8];
    for (int i = 0; i < 8; i++) {
        const double *x = cube_vertex[i].x;
        vertex[i] =
            (lrcs_point){{(at + x[0]) * scale, (at + 2.0 * x[1]) * scale, thick * x[2] * scale}};
    }
    lrcs_mesh_report r = report_of(vertex, 8, cube_facet, 12);
    assert_true(r.closed && r.convex);
    check_rel(r.area, (4.0 + 6.0 * thick) * scale * scale, 4e-16);
    check_rel(r.volume, 2.0 * thick * scale * scale * scale, 4e-16);
}

static void thin_plates_far_away_keep_area_and_volume(void **state)
{
    (void)state;
    check_box(0.0, 1.0, 1.0);
    check_box(1048576.0, 0x1p-40, 1.0);
    check_box(-1e6, 0x1p-60, 0x1p-90);
    check_box(3.0, 0x1p-20, 0x1p328);
}

static void the_largest_coordinates_are_served(void **state)
{
    (void)state;
    const lrcs_point vertex[4] = {{{1e100, 1e100, 1e100}},
                                  {{-1e100, -1e100, 1e100}},
                                  {{-1e100, 1e100, -1e100}},
                                  {{1e100, -1e100, -1e100}}};
    const lrcs_facet facet[4] = {{{0, 2, 1}}, {{0, 1, 3}}, {{0, 3, 2}}, {{1, 2, 3}}};
    lrcs_mesh_report r = report_of(vertex, 4, facet, 4);
    assert_true(r.closed && r.convex);
    check_rel(r.volume, 8e300 / 3.0, 1e-15);
    check_rel(r.area, 8e200 * sqrt(3.0), 1e-15);
}

static void tiny_coordinates_give_finite_numbers(void **state)
{
    (void)state;
    const lrcs_point vertex[3] = {{{0, 0, 0}}, {{5e-324, 0, 0}}, {{0, 1e-310, 0}}};
    const lrcs_facet facet[1] = {{{0, 1, 2}}};
    lrcs_mesh_report r = report_of(vertex, 3, facet, 1);
    check_same(r.area, 0.0);
    check_same(r.volume, 0.0);
}

static void an_empty_mesh_gives_zeros(void **state)
{
    (void)state;
    lrcs_mesh_report r = report_of(cube_vertex, 8, NULL, 0);
    assert_int_equal(r.vertices + r.edges, 0);
    assert_true(!r.closed && !r.convex);
    check_same(r.area, 0.0);
    check_same(r.volume, 0.0);
    check_same(r.box_max[0], 0.0);
    r = report_of(NULL, 0, NULL, 0);
    check_same(r.box_min[2], 0.0);
}

static void checks_in_too_little_memory_fail_clean(void **state)
{
    (void)state;
    size_t need = lrcs_mesh_check_need(8, 12);
    int status = LRCS_E_MEMORY;
    for (size_t size = 0; size <= need; size++) {
        unsigned char *bytes = malloc(size + 1);
        assert_non_null(bytes);
        lrcs_work work = lrcs_work_make(bytes, size);
        lrcs_mesh_report report = {.edges = 77};
        status = lrcs_mesh_check(cube_vertex, 8, cube_facet, 12, &work, &report);
        assert_int_equal(report.edges, status == LRCS_OK ? 18 : 77);
        assert_int_equal(work.used, 0);
        free(bytes);
    }
    assert_int_equal(status, LRCS_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cube_is_whole),
        cmocka_unit_test(an_inverted_cube_is_closed_with_negative_volume),
        cmocka_unit_test(a_missing_facet_opens_three_edges),
        cmocka_unit_test(a_flipped_facet_disagrees_along_three_edges),
        cmocka_unit_test(degenerate_facets_count_once_and_nowhere_else),
        cmocka_unit_test(repeats_count_against_the_earliest_facet),
        cmocka_unit_test(repeats_are_found_by_position_not_by_index),
        cmocka_unit_test(three_skins_on_an_edge_are_nonmanifold),
        cmocka_unit_test(a_sliver_far_from_the_origin_has_its_area),
        cmocka_unit_test(thin_plates_far_away_keep_area_and_volume),
        cmocka_unit_test(the_largest_coordinates_are_served),
        cmocka_unit_test(tiny_coordinates_give_finite_numbers),
        cmocka_unit_test(an_empty_mesh_gives_zeros),
        cmocka_unit_test(checks_in_too_little_memory_fail_clean),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
