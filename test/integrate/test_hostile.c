/* SPDX-License-Identifier: MIT */
/* Scenes that once violated a bound, with their exact answers (test/hostile/bounds.py, which
   generates any number of others). The comment of each test states its symptom. */
#include <lrcs/lrcs.h>

#include <string.h>

#include "check.h"

#define MOST 64

typedef struct hostile_case {
    const char *name;
    uint32_t vertices, facets;
    double direction[3];
    lrcs_brdf brdf[2];
    lrcs_point vertex[MOST];
    lrcs_facet facet[MOST];
    uint32_t material[MOST];
    double share[MOST]; /* of the projected area that is visible */
    double truth[3];    /* sigma one-sided and two-sided, the silhouette; m^2 */
} hostile_case;

static const hostile_case cases[] = {
#include "../vectors/hostile.inc"
};
#define CASES (sizeof cases / sizeof *cases)

/* The largest difference of a coordinate between corners of facets that are no longer than `most`;
   facet: whether it is one. */
static double extent_of(const hostile_case *c, double most, int *is_short)
{
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    double extent = 0;
    for (uint32_t f = 0; f < c->facets; f++) {
        is_short[f] = 1;
        for (int i = 0; i < 9; i++) {
            const double *p = c->vertex[c->facet[f].corner[i / 3]].x;
            const double *q = c->vertex[c->facet[f].corner[(i / 3 + 1) % 3]].x;
            is_short[f] &= fabs(p[i % 3] - q[i % 3]) <= most;
        }
        for (int i = 0; i < 9 && is_short[f]; i++) {
            double x = c->vertex[c->facet[f].corner[i / 3]].x[i % 3];
            low[i % 3] = fmin(low[i % 3], x);
            high[i % 3] = fmax(high[i % 3], x);
            extent = fmax(extent, high[i % 3] - low[i % 3]);
        }
    }
    return extent;
}

/* Visible areas: to 1e-12 of the facet's projected area and 1e-15 of the extent squared. Where a
   body has facets that reach 1e6 times as far as it does, its own are known to 1e-15 of its own
   extent squared, and to 2^-100 of what both extents make. */
static void check_areas(const hostile_case *c, const lrcs_facet_record *records)
{
    int is_short[MOST];
    double whole_extent = extent_of(c, HUGE_VAL, is_short);
    double extent = extent_of(c, 1e-6 * whole_extent, is_short);
    for (uint32_t f = 0; f < c->facets; f++) {
        double whole = records[f].area_m2 * fabs(records[f].cos_theta);
        double reach = is_short[f] ? extent : whole_extent;
        check_abs(records[f].visible_area_m2, c->share[f] * whole,
                  1e-12 * whole + 1e-15 * reach * reach + 0x1p-100 * whole_extent * reach);
    }
}

/* Runs one case and checks its bound; with the exact method also the visible areas. */
static void check_run(const hostile_case *c, int sided, int method, uint32_t size)
{
    static unsigned char memory[32u << 20];
    static const uint32_t zero[MOST];
    hostile_case copy = *c;
    uint32_t part_of[MOST];
    uint32_t smooth[MOST];
    memcpy(part_of, zero, sizeof zero);
    memcpy(smooth, zero, sizeof zero);
    lrcs_material material[2] = {{.name = "", .brdf = c->brdf[0], .brdf_given = 1},
                                 {.name = "", .brdf = c->brdf[1], .brdf_given = 1}};
    material[0].two_sided = material[1].two_sided = (unsigned char)sided;
    lrcs_part part = {.name = "", .kind = -1, .bounds.known = 1, .facet_count = c->facets};
    lrcs_scene scene = {.vertex_count = c->vertices,
                        .facet_count = c->facets,
                        .material_count = 2,
                        .part_count = 1,
                        .vertex = copy.vertex,
                        .facet = copy.facet,
                        .facet_material = copy.material,
                        .facet_part = part_of,
                        .facet_smooth = smooth,
                        .material = material,
                        .part = &part,
                        .unmatched = LRCS_NONE};
    lrcs_work work = lrcs_work_make(memory, sizeof memory);
    const lrcs_prepared *prepared = NULL;
    lrcs_pose pose;
    lrcs_result r;
    lrcs_facet_record records[MOST];
    assert_int_equal(lrcs_prepare_run(&scene, &work, &prepared), LRCS_OK);
    assert_int_equal(lrcs_pose_from_direction(c->direction, &pose), LRCS_OK);
    lrcs_run_options options = {.tolerance = 1e-4, .method = method, .resolution = size};
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &r, records, NULL), LRCS_OK);
    assert_true(r.bound_m2 >= 0);
    check_abs(r.sigma_m2, c->truth[sided], r.bound_m2 + 2e-16 * c->truth[sided]);
    if (method == LRCS_METHOD_EXACT) {
        check_areas(c, records);
    }
}

static void check_case(const char *name)
{
    static const uint32_t sizes[] = {1, 2, 7, 64, 255};
    size_t i = 0;
    while (i < CASES && strcmp(cases[i].name, name) != 0) {
        i++;
    }
    assert_true(i < CASES);
    for (int sided = 0; sided < 2; sided++) {
        check_run(&cases[i], sided, LRCS_METHOD_FACET, 0);
        check_run(&cases[i], sided, LRCS_METHOD_EXACT, 0);
        check_run(&cases[i], sided, LRCS_METHOD_AUTO, 0);
        for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
            check_run(&cases[i], sided, LRCS_METHOD_ZBUFFER, sizes[k]);
        }
    }
}

/* Closed, of positive volume, no facet inside another: a sphere whose pole went through the other
   crosses itself along overlapping sides only, and has winding number -1 within. */
static void sheets_that_cross_along_their_sides_are_no_solid(void **state)
{
    (void)state;
    check_case("turned 21:0");
}

/* A sample 1e-33 beside a fold: the slopes there tell the wrong side of it. */
static void fold_beside_a_sample_is_decided_by_its_corners(void **state)
{
    (void)state;
    check_case("roof 21:257");
    check_case("roof 21:846");
}

/* The cut of an occluder narrower than its rounding ran backwards, and its region without end. */
static void cut_of_a_sliver_keeps_its_sense(void **state)
{
    (void)state;
    check_case("tiny 21:2257");
    check_case("tiny 7:144");
}

/* The area of a facet nearly edge-on came out below zero, and with it the bound. */
static void visible_area_is_never_negative(void **state)
{
    (void)state;
    check_case("soup 21:9");
}

/* No point with coordinates in doubles projects inside it. */
static void facet_thinner_than_its_rounding_is_asked_at_a_corner(void **state)
{
    (void)state;
    check_case("soup 7:1171");
}

/* A needle of 1e-23 m^2, sampled at a corner that it shares with what hides it, or does not, showed
   half its area: there their heights agree, and each had corners on both sides of the other. */
static void needle_sampled_at_a_common_corner_is_decided(void **state)
{
    (void)state;
    check_case("turned 7:6693");
    check_case("turned 99:6546");
}

/* Copies an ulp apart, seen edge-on: facets as long as the scene and no wider than some ulps of
   that, whose visible areas were off by up to four fifths of all. */
static void needles_of_some_ulps_show_their_exact_shares(void **state)
{
    (void)state;
    check_case("skins 1:1482");
    check_case("skins 1:2349");
    check_case("skins 1:3844");
    check_case("skins 1:4174");
    check_case("skins 1:4284");
}

/* Facets that intersect at angles of 1e-19 and less. Symptom: double-double arithmetic could not
   locate the line of intersection, and all of both facets was undecided. */
static void planes_all_but_parallel_meet_where_they_do(void **state)
{
    (void)state;
    check_case("lattice 1:298");
}

/* A millionth as wide as long, and as long as the scene: what was left of some u of the length is
   more than areas may be off by. */
static void long_slivers_show_their_exact_shares(void **state)
{
    (void)state;
    check_case("lattice 1:820");
    check_case("lattice 1:2227");
    check_case("lattice 1:2416");
    check_case("lattice 2:4035");
    check_case("lattice 4:606");
}

/* Sides of three facets lie in one line to within some ulps. Symptom: the strips between them used
   up all the cells that a facet may be divided into, and the rest of it stayed undecided. */
static void undecided_strips_leave_cells_for_the_rest(void **state)
{
    (void)state;
    check_case("lattice 5:3187");
}

/* Vertices 1e21 m away, with facets that shadow the body, pierce it, or stand behind it along the
   line of sight: what reflects is the body alone, and its facets are as sharp as without. Rounding
   errors of all were those of the farthest. */
static void far_vertices_blur_no_facet_but_their_own(void **state)
{
    (void)state;
    check_case("far_comb 1:34");
    check_case("far_spacecraft 1:258");
    check_case("far_spacecraft 1:260");
    check_case("far_spacecraft 2:65");
    check_case("far_slivers 2:103");
    check_case("far_spacecraft 2:157");
}

/* A facet seen edge-on, part of a fan that a large facet pierces: what it has in front of that is
   no wider than rounding, but ends the fan. The fan hid more than there is of it. */
static void a_facet_seen_edge_on_ends_its_fan(void **state)
{
    (void)state;
    check_case("fan 3006:802");
    check_case("fan 3010:109");
}

/* Fins through a plate, all within 1e-9 of edge-on: as the fins' frames have it, where they meet
   the plate was unknown, and up to half of each stayed undecided. */
static void fins_of_a_plate_seen_edge_on_show_their_exact_shares(void **state)
{
    (void)state;
    check_case("comb 3002:440");
    check_case("comb 3006:589");
}

/* Sides meet above corners and sides, and none cross: half of a needle stayed undecided. */
static void needles_under_facets_that_meet_their_corners_are_decided(void **state)
{
    (void)state;
    check_case("lattice 3005:192");
    check_case("lattice 3007:401");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sheets_that_cross_along_their_sides_are_no_solid),
        cmocka_unit_test(fold_beside_a_sample_is_decided_by_its_corners),
        cmocka_unit_test(cut_of_a_sliver_keeps_its_sense),
        cmocka_unit_test(visible_area_is_never_negative),
        cmocka_unit_test(facet_thinner_than_its_rounding_is_asked_at_a_corner),
        cmocka_unit_test(needle_sampled_at_a_common_corner_is_decided),
        cmocka_unit_test(needles_of_some_ulps_show_their_exact_shares),
        cmocka_unit_test(planes_all_but_parallel_meet_where_they_do),
        cmocka_unit_test(long_slivers_show_their_exact_shares),
        cmocka_unit_test(undecided_strips_leave_cells_for_the_rest),
        cmocka_unit_test(far_vertices_blur_no_facet_but_their_own),
        cmocka_unit_test(a_facet_seen_edge_on_ends_its_fan),
        cmocka_unit_test(fins_of_a_plate_seen_edge_on_show_their_exact_shares),
        cmocka_unit_test(needles_under_facets_that_meet_their_corners_are_decided),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
