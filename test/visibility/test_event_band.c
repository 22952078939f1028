/* SPDX-License-Identifier: MIT */
/* The bands of a plate under a ball: what the true ball hides of it and the facets do not, or the
   reverse, in closed form and by summation over azimuth. */
#include "visibility/proximity/event_band.h"

#include "pair.h"

static lrcs_scene scene;
static lrcs_work work;
static lrcsi_view view;
static lrcsi_event_bands bands;

enum { BALL, PLATE };

/* The ball is at the origin, the plate `below` at a point 2 below the plane z = 0. */
static void look_at_ball_above(const lrcs_shape *below, const double at[2], double x, double y,
                               double z)
{
    static const double upright[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const lrcs_prepared *prepared =
        pair_prepare(&ball, below, (const double[3]){at[0], at[1], -2}, upright, 0, &scene, &work);
    lrcs_pose pose;
    assert_int_equal(lrcs_pose_from_direction((const double[3]){x, y, z}, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    static unsigned char memory[1u << 20];
    size_t need = lrcsi_event_bands_need(prepared);
    assert_true(need > 0 && need <= sizeof memory);
    lrcs_work room = lrcs_work_make(memory, need);
    assert_int_equal(lrcsi_event_bands_make(&view, NULL, &room, &bands), LRCS_OK);
    assert_true(bands.events.count > 8);
}

static void look_at_ball(double x, double y, double z)
{
    look_at_ball_above(&plate, (const double[2]){0, 0}, x, y, z);
}

/* The areas between the outline of the true ball, a circle, and that of its facets: outside the
   circle and inside it. */
static void outline_areas(double *outside, double *inside)
{
    const double zero[3] = {0, 0, 0};
    const double radius = ldexp(0.5, -view.prepared->exponent);
    double centre[3];
    double around = 0;
    lrcsi_view_coordinates(&view, zero, centre);
    *outside = *inside = 0;
    for (uint32_t e = 0; e < bands.events.count; e++) {
        if (bands.events.part[e] != BALL) {
            continue;
        }
        const lrcsi_edge *edge = &view.prepared->topology.edge[bands.events.edge[e]];
        const double *a = view.point[edge->low].x;
        const double *b = view.point[edge->high].x;
        double start = atan2(a[1] - centre[1], a[0] - centre[0]);
        double turn = remainder(atan2(b[1] - centre[1], b[0] - centre[0]) - start, 2 * LRCS_PI);
        double twice =
            fabs((a[0] - centre[0]) * (b[1] - centre[1]) - (a[1] - centre[1]) * (b[0] - centre[0]));
        for (int i = 0; i < 1000; i++) {
            double angle = start + (i + 0.5) / 1000 * turn;
            double across = fabs((b[0] - a[0]) * sin(angle) - (b[1] - a[1]) * cos(angle));
            double ring =
                0.5 * (twice / across * (twice / across) - radius * radius) * fabs(turn) / 1000;
            *outside += fmax(0, ring);
            *inside += fmax(0, -ring);
        }
        around += fabs(turn);
    }
    check_abs(around, 2 * LRCS_PI, 1e-9); /* the facets' outline goes round once */
}

/* Is it an event edge that the search for a facet does not exclude? */
static int is_near(const lrcsi_band_search *where, uint32_t event)
{
    int line = 0;
    return !lrcsi_band_excludes(&bands, where, event, &line);
}

/* Adds up the bands of both facets of the plate, as areas in projection. */
static void band_areas(int correspondence, double *gain, double *loss)
{
    *gain = *loss = 0;
    for (uint32_t f = 0; f < scene.facet_count; f++) {
        if (scene.facet_part[f] != PLATE) {
            continue;
        }
        const lrcsi_band_search where = lrcsi_band_search_make(&bands, f);
        const lrcsi_band_facet at = lrcsi_band_facet_make(&bands, f, &where.edges);
        for (uint32_t e = 0; e < bands.events.count; e++) {
            lrcsi_event_band band;
            int found =
                is_near(&where, e) && lrcsi_event_band_make(&bands, &at, e, correspondence, &band);
            assert_true(!found || bands.events.part[e] == BALL); /* it has no inside to be seen */
            if (found) {
                assert_true(band.gain >= 0 && band.loss >= 0 && band.area <= 1);
                assert_true(band.gain <= band.area && band.loss <= band.area);
                *gain += band.gain * lrcsi_view_projected(&view, f);
                *loss += band.loss * lrcsi_view_projected(&view, f);
            }
        }
    }
}

/* The bands contain it, and are not many times larger: the ball is in front of the plate, so that
   they follow from the outlines. */
static void bands_contain_what_lies_between_outlines(void **state)
{
    (void)state;
    static const double from[4][3] = {{0, 0, 1}, {0.2, 0.1, 1}, {-0.3, 0.25, 1}, {0.05, -0.4, 1}};
    for (int i = 0; i < 4; i++) {
        double outside;
        double inside;
        look_at_ball(from[i][0], from[i][1], from[i][2]);
        outline_areas(&outside, &inside);
        assert_true(outside > 0 && inside > 0);
        for (int aligned = 0; aligned < 2; aligned++) {
            double gain;
            double loss;
            band_areas(aligned ? LRCSI_ALIGNED : LRCSI_MAPPED, &gain, &loss);
            check_most(outside, gain);
            check_most(inside, loss);
            check_most(gain, 1.25 * outside);
            check_most(loss, 1.25 * inside);
        }
    }
}

/* From above, the outline of the true ball is a circle, and that of its facets a polygon of the same
   area. Plates so small that they lie between the two: beside a corner of the polygon, outside the
   circle, and beside the middle of its side, inside the circle. All of the first is gained, all of
   the second is lost. */
static void all_of_a_plate_between_the_outlines_is_gained_or_lost(void **state)
{
    (void)state;
    const double radius = 0.5;
    look_at_ball(0, 0, 1);
    uint32_t e = 0;
    while (bands.events.part[e] != BALL) {
        e++;
    }
    const lrcsi_edge *edge = &view.prepared->topology.edge[bands.events.edge[e]];
    double unit = ldexp(1, view.prepared->exponent);
    const double *a = view.prepared->vertex[edge->low].x;
    const double *b = view.prepared->vertex[edge->high].x;
    for (int i = 0; i < 4; i++) {
        const int lost = i % 2;
        const double share = i < 2 ? 0.5 : 0.95; /* of the way to the circle */
        double at[2] = {unit * a[0], unit * a[1]};
        if (lost) {
            at[0] = 0.5 * unit * (a[0] + b[0]);
            at[1] = 0.5 * unit * (a[1] + b[1]);
        }
        double from = hypot(at[0], at[1]); /* the axis */
        double between = fabs(from - radius);
        assert_int_equal(from < radius, lost);
        for (int k = 0; k < 2; k++) {
            at[k] *= ((1 - share) * from + share * radius) / from;
        }
        lrcs_shape small = {.kind = LRCS_SHAPE_PLATE, .size = {0.04 * between, 0.04 * between}};
        look_at_ball_above(&small, at, 0, 0, 1);
        for (int aligned = 0; aligned < 2; aligned++) {
            double gain;
            double loss;
            band_areas(aligned ? LRCSI_ALIGNED : LRCSI_MAPPED, &gain, &loss);
            double found = lrcsi_prepared_area(view.prepared, lost ? loss : gain);
            check_most(small.size[0] * small.size[1], found * (1 + 1e-9));
        }
    }
}

/* A strip across the ball, much narrower than an event edge: along each edge that it crosses, at most
   what is no farther from it than the two outlines are there counts. */
static void of_a_narrow_strip_only_what_lies_between_the_outlines_counts(void **state)
{
    (void)state;
    const lrcs_shape strip = {.kind = LRCS_SHAPE_PLATE, .size = {4, 1e-3}};
    look_at_ball_above(&strip, (const double[2]){0, 0.013}, 0, 0, 1);
    double deepest = 0;
    for (uint32_t e = 0; e < bands.events.count; e++) {
        if (bands.events.part[e] == BALL) {
            deepest = fmax(deepest, bands.areas[e].gain_depth + bands.areas[e].loss_depth);
        }
    }
    double gain;
    double loss;
    band_areas(LRCSI_ALIGNED, &gain, &loss);
    const double width = ldexp(strip.size[1], -view.prepared->exponent);
    assert_true(gain + loss > 0 && isfinite(deepest));
    check_most(deepest, 0.6 * view.prepared->proximity.hausdorff[BALL]);
    check_most(gain + loss, 2.1 * width * deepest); /* it crosses two edges */
}

/* The sides of all facets of the plate that are near an event edge. */
static void check_sides(int near_diagonal)
{
    for (uint32_t f = 0; f < scene.facet_count; f++) {
        if (scene.facet_part[f] != PLATE) {
            continue;
        }
        const lrcsi_band_search where = lrcsi_band_search_make(&bands, f);
        const lrcsi_band_facet at = lrcsi_band_facet_make(&bands, f, &where.edges);
        lrcsi_near_sides near = {{{1, 0}, {1, 0}, {1, 0}}};
        unsigned sides = 0;
        for (uint32_t e = 0; e < bands.events.count; e++) {
            if (is_near(&where, e)) {
                lrcsi_event_sides(&bands, &at, e, &near);
            }
        }
        for (unsigned k = 0; k < 3; k++) {
            sides |= lrcsi_segment_part_is_empty(near.side[k]) ? 0u : 1u << k;
        }
        for (int k = 0; k < 3; k++) {
            const double *a = lrcsi_prepared_corner(view.prepared, f, k);
            const double *b = lrcsi_prepared_corner(view.prepared, f, (k + 1) % 3);
            if (a[0] != b[0] && a[1] != b[1]) {
                assert_int_equal(sides >> k & 1, near_diagonal);
            }
        }
        assert_true(near_diagonal || sides == 0);
    }
}

/* From above, the shadow of the ball falls on the diagonal of the plate; from the side, beside the
   plate. */
static void an_event_edge_is_near_the_sides_that_its_shadow_meets(void **state)
{
    (void)state;
    look_at_ball(0, 0, 1);
    check_sides(1);
    look_at_ball(3, 0, 1);
    check_sides(0);
}

/* From below, the ball is behind the plate. */
static void what_is_behind_has_no_band(void **state)
{
    (void)state;
    double gain;
    double loss;
    look_at_ball(0.1, 0.2, -1);
    band_areas(LRCSI_MAPPED, &gain, &loss);
    check_abs(gain, 0, 0);
    check_abs(loss, 0, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bands_contain_what_lies_between_outlines),
        cmocka_unit_test(all_of_a_plate_between_the_outlines_is_gained_or_lost),
        cmocka_unit_test(of_a_narrow_strip_only_what_lies_between_the_outlines_counts),
        cmocka_unit_test(an_event_edge_is_near_the_sides_that_its_shadow_meets),
        cmocka_unit_test(what_is_behind_has_no_band),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
