/* SPDX-License-Identifier: MIT */
/* Along which event edges the margins on a flat face are known with their sign: those of a ball
   above a disc, beside scenes in which one of the conditions (a) to (f) of face_margin.c does not
   hold, so that they must not be. Also that the work is counted, and grows like the number of
   faces. */
#include "visibility/proximity/face_margin.h"

#include "recipe.h"

static lrcs_scene scene;
static lrcs_work work;
static lrcsi_view view;
static lrcsi_classification classification;
static lrcsi_event_bands bands;
static lrcsi_face_margin face[256];
static lrcsi_edge_faces faces[1u << 16];

enum { FACE, CASTER };

static lrcs_recipe_material paint = {.name = "paint", .brdf = {0, 1, 1, 0}};

static lrcs_recipe_part part_at(lrcs_shape shape, double x, double y, double z)
{
    lrcs_recipe_part part = {.name = "", .material = "paint", .shape = shape};
    part.place = lrcs_place_default();
    part.place.translate[0] = x;
    part.place.translate[1] = y;
    part.place.translate[2] = z;
    return part;
}

static lrcs_shape ball_of(double radius)
{
    return (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = radius};
}

/* The margins in a view, found in so many bytes. */
static void find_margins_within(size_t bytes)
{
    static unsigned char memory[1u << 24];
    assert_true(bytes <= sizeof memory);
    lrcs_work room = lrcs_work_make(memory, bytes);
    lrcsi_face_margins_make(&bands, &classification, &room, face, faces);
    assert_int_equal(room.used, 0);
}

/* The margins of a scene of parts, divided for this tolerance. */
static void find_margins(lrcs_recipe_part *part, uint32_t count, double tolerance,
                         const double d[3], lrcsi_meter *meter)
{
    const lrcs_recipe recipe = {
        .part = part, .part_count = count, .material = &paint, .material_count = 1};
    const lrcs_build_options build = {tolerance, 1u << 16, LRCS_NORMALS_FLAT, 0, 0, NULL};
    const lrcs_prepared *prepared = recipe_prepare(&recipe, NULL, &build, &scene, &work);
    lrcs_pose pose;
    assert_true(count <= 256);
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    assert_int_equal(lrcsi_classify_make(&view, NULL, &work, &classification), LRCS_OK);
    assert_int_equal(lrcsi_event_bands_make(&view, meter, &work, &bands), LRCS_OK);
    assert_true(bands.events.count <= 1u << 16);
    find_margins_within(lrcsi_face_margins_need(prepared));
}

/* Half the sum of gain and loss along the edges of a part that are added to the first face: the
   error of their area if no sign is known. */
static double error_without_signs(uint32_t part)
{
    double sum = 0;
    for (uint32_t i = 0; i < bands.events.count; i++) {
        if (bands.events.part[i] == part && lrcsi_edge_faces_hold(&faces[i], FACE)) {
            sum += 0.5 * (bands.areas[i].gain + bands.areas[i].loss);
        }
    }
    return sum;
}

static uint32_t edges_on_face(uint32_t part)
{
    uint32_t edges = 0;
    for (uint32_t i = 0; i < bands.events.count; i++) {
        edges += bands.events.part[i] == part && lrcsi_edge_faces_hold(&faces[i], FACE);
    }
    return edges;
}

static const double oblique[3] = {0.2, 0.1, 1};
static const lrcs_shape disc = {.kind = LRCS_SHAPE_DISC, .radius = 1};

/* The area between the polygon that a ball's event edges form and the circle of the true ball. */
static double polygon_beyond_circle(double radius)
{
    double twice = 0;
    const double zero[3] = {0, 0, 0};
    double centre[3];
    lrcsi_view_coordinates(&view, zero, centre);
    for (uint32_t i = 0; i < bands.events.count; i++) {
        if (bands.events.part[i] == CASTER) {
            const lrcsi_edge *edge = &view.prepared->topology.edge[bands.events.edge[i]];
            const double *a = view.point[edge->low].x;
            const double *b = view.point[edge->high].x;
            twice += bands.events.side[i] * ((a[0] - centre[0]) * (b[1] - centre[1]) -
                                             (a[1] - centre[1]) * (b[0] - centre[0]));
        }
    }
    const double scaled = ldexp(radius, -view.prepared->exponent);
    return 0.5 * twice - LRCS_PI * scaled * scaled;
}

static void margins_of_a_ball_above_a_disc_have_their_sign(void **state)
{
    (void)state;
    static const double from[3][3] = {{0, 0, 1}, {0.2, 0.1, 1}, {-0.5, 0.3, 1}};
    for (int i = 0; i < 3; i++) {
        lrcs_recipe_part part[2] = {part_at(disc, 0, 0, 0), part_at(ball_of(0.3), 0, 0, 0.4)};
        find_margins(part, 2, 1e-3, from[i], NULL);
        assert_true(face[FACE].known && edges_on_face(CASTER) > 20);
        assert_int_equal(face[FACE].causes, 1u << CASTER);
        check_abs(face[FACE].area, polygon_beyond_circle(0.3), face[FACE].error);
        check_most(face[FACE].error, 0.1 * error_without_signs(CASTER));
        assert_false(face[CASTER].known);
    }
}

/* (d): one of the ball's edges is so short that the edges which follow it come near those before it.
   They have margins all the same. */
static void margins_of_short_edges(void **state)
{
    (void)state;
    const double from[3] = {0.1, 0, 1};
    lrcs_recipe_part part[2] = {part_at(disc, 0, 0, 0), part_at(ball_of(0.3), 0, 0, 0.4)};
    find_margins(part, 2, 1e-4, from, NULL);
    const double k = bands.orders.outline[CASTER].k;
    double shortest = HUGE_VAL;
    double length = 0;
    uint32_t edges = 0;
    for (uint32_t i = 0; i < bands.events.count; i++) {
        if (bands.events.part[i] == CASTER) {
            const lrcsi_edge *edge = &view.prepared->topology.edge[bands.events.edge[i]];
            const double *a = view.point[edge->low].x;
            const double *b = view.point[edge->high].x;
            const double across = hypot(b[0] - a[0], b[1] - a[1]);
            shortest = fmin(shortest, across);
            length += across;
            edges++;
        }
    }
    check_most(shortest, 2 * k);
    assert_int_equal(edges_on_face(CASTER), edges);
    check_abs(face[FACE].area, polygon_beyond_circle(0.3), face[FACE].error);
    check_most(face[FACE].error, 0.01 * length * k);
}

static void check_without_signs(lrcs_recipe_part *part, uint32_t count, const double d[3])
{
    double least = 0;
    find_margins(part, count, 1e-3, d, NULL);
    assert_true(face[FACE].known && edges_on_face(CASTER) > 20);
    for (uint32_t i = CASTER; i < count; i++) {
        least += error_without_signs(i);
    }
    check_most(least, face[FACE].error);
}

/* (a): the largest ball whose edges are all over the face: they are nearer than w to its side. */
static void not_beside_the_side_of_the_face(void **state)
{
    (void)state;
    const double up[3] = {0, 0, 1};
    double radius = 1;
    do {
        radius -= 3e-4;
        lrcs_recipe_part part[2] = {part_at(disc, 0, 0, 0), part_at(ball_of(radius), 0, 0, 1.2)};
        find_margins(part, 2, 0.1, up, NULL);
    } while (edges_on_face(CASTER) == 0 && radius > 0.9);
    check_most(error_without_signs(CASTER), face[FACE].error);
    lrcs_recipe_part part[2] = {part_at(disc, 0, 0, 0), part_at(ball_of(0.9), 0, 0, 1.2)};
    find_margins(part, 2, 0.1, up, NULL);
    check_most(face[FACE].error, 0.6 * error_without_signs(CASTER));
}

/* (b): the ball lies in the plane of the face in part. */
static void not_of_a_part_that_pierces_the_plane(void **state)
{
    (void)state;
    lrcs_recipe_part part[2] = {part_at(disc, 0, 0, 0), part_at(ball_of(0.3), 0, 0, 0.1)};
    find_margins(part, 2, 1e-3, oblique, NULL);
    assert_true(bands.events.count > 20);
    assert_false(face[FACE].known);
    assert_int_equal(edges_on_face(CASTER), 0);
}

/* (c): another ball on the same line of sight has the same outline. */
static void not_beside_an_edge_of_another_part(void **state)
{
    (void)state;
    lrcs_recipe_part part[3] = {part_at(disc, 0, 0, 0), part_at(ball_of(0.3), 0.08, 0.04, 0.4),
                                part_at(ball_of(0.3), 0.24, 0.12, 1.2)};
    check_without_signs(part, 3, oblique);
}

/* Is an event edge next to another of its part, in a direction that differs by more than 0.5 rad? */
static int is_at_corner(uint32_t event)
{
    const lrcsi_edge *all = view.prepared->topology.edge;
    const lrcsi_edge *edge = &all[bands.events.edge[event]];
    int corner = 0;
    for (uint32_t i = 0; i < bands.events.count; i++) {
        const lrcsi_edge *next = &all[bands.events.edge[i]];
        const int joined = next->low == edge->low || next->low == edge->high ||
                           next->high == edge->low || next->high == edge->high;
        if (i != event && bands.events.part[i] == bands.events.part[event] && joined) {
            const double *a = view.point[edge->low].x;
            const double *b = view.point[edge->high].x;
            const double *c = view.point[next->low].x;
            const double *d = view.point[next->high].x;
            const double across = (b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0]);
            corner |= fabs(across) >
                      sin(0.5) * hypot(b[0] - a[0], b[1] - a[1]) * hypot(d[0] - c[0], d[1] - c[1]);
        }
    }
    return corner;
}

/* (d): a lying cylinder, seen so that the ellipses at its ends are narrow: where its sides end, the
   outline of the facets turns by more than half a radian. From farther aside it does not. */
static void not_beside_a_corner_of_the_outline(void **state)
{
    (void)state;
    static const double lying[3][3] = {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
    const lrcs_shape rod = {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.2, .length = 0.6};
    for (int aside = 0; aside < 2; aside++) {
        const double d[3] = {0, aside ? 0.1 : 0.02, 1};
        lrcs_recipe_part part[2] = {part_at(disc, 0, 0, 0), part_at(rod, 0, -0.3, 0.5)};
        memcpy(part[1].place.rotate, lying, sizeof lying);
        find_margins(part, 2, 1e-3, d, NULL);
        double corners = 0; /* the errors of edges at corners, without signs */
        uint32_t count = 0;
        for (uint32_t i = 0; i < bands.events.count; i++) {
            if (bands.events.part[i] == CASTER && lrcsi_edge_faces_hold(&faces[i], FACE) &&
                is_at_corner(i)) {
                corners += 0.5 * (bands.areas[i].gain + bands.areas[i].loss);
                count++;
            }
        }
        assert_true(face[FACE].known && edges_on_face(CASTER) > count);
        assert_true(aside ? count == 0 : count >= 4);
        check_most(corners, face[FACE].error);
        check_most(aside ? face[FACE].error : 0, 0.01 * error_without_signs(CASTER));
    }
}

/* (e): a plate so close behind the face that rounding and the reach of shapes decide which is in
   front. */
static void not_beside_a_facet_in_the_plane(void **state)
{
    (void)state;
    const lrcs_shape plate = {.kind = LRCS_SHAPE_BOX, .size = {1.2, 1.2, 0.1}};
    lrcs_recipe_part part[3] = {part_at(disc, 0, 0, 0), part_at(ball_of(0.3), 0, 0, 0.4),
                                part_at(plate, 0, 0, -0.05 - 1e-9)};
    check_without_signs(part, 3, oblique);
}

/* (f): a plate in front of the ball hides all of the face, so that the ball changes nothing. */
static void nothing_changes_on_a_hidden_face(void **state)
{
    (void)state;
    const lrcs_shape plate = {.kind = LRCS_SHAPE_BOX, .size = {4, 4, 0.1}};
    lrcs_recipe_part part[3] = {part_at(disc, 0, 0, 0), part_at(ball_of(0.3), 0, 0, 0.4),
                                part_at(plate, 0, 0, 2)};
    find_margins(part, 3, 1e-3, oblique, NULL);
    assert_true(face[FACE].known && edges_on_face(CASTER) > 20);
    check_abs(face[FACE].area, 0, 0);
    check_abs(face[FACE].error, 0, 0);
}

/* Of two discs under the ball, the upper one hides the lower one where the margins are. A third face
   under them has no margins. */
static void margins_on_faces_one_behind_the_other(void **state)
{
    (void)state;
    lrcs_shape upper = disc;
    upper.radius = 0.8;
    lrcs_recipe_part part[4] = {part_at(disc, 0, 0, -0.5), part_at(ball_of(0.3), 0, 0, 0.4),
                                part_at(upper, 0, 0, 0), part_at(disc, 0, 0, -1)};
    find_margins(part, 4, 1e-3, oblique, NULL);
    const uint32_t edges = edges_on_face(CASTER);
    uint32_t all = 0;
    uint32_t both = 0;
    for (uint32_t i = 0; i < bands.events.count; i++) {
        all += bands.events.part[i] == CASTER;
        both += bands.events.part[i] == CASTER && lrcsi_edge_faces_hold(&faces[i], FACE) &&
                lrcsi_edge_faces_hold(&faces[i], 2);
    }
    assert_true(edges > 20 && both == edges && all == edges);
    check_abs(face[2].area, polygon_beyond_circle(0.3), face[2].error);
    check_most(face[2].error, 0.1 * error_without_signs(CASTER));
    assert_true(face[FACE].known);
    assert_false(face[3].known);
    check_most(face[FACE].error, 1e-12);
}

/* Discs with a ball above each, far apart: four times as many take four times the steps. With fewer
   steps, fewer margins are known; with none, none. */
static void steps_grow_like_the_number_of_faces(void **state)
{
    (void)state;
    uint64_t taken[2];
    for (int many = 0; many < 2; many++) {
        lrcs_recipe_part part[128];
        const uint32_t pairs = many ? 64 : 16;
        for (uint32_t i = 0; i < pairs; i++) {
            const double x = 4.0 * (i % 8);
            const double y = 4.0 * (i / 8);
            part[2 * i] = part_at(disc, x, y, 0);
            part[2 * i + 1] = part_at(ball_of(0.3), x, y, 0.4);
        }
        lrcsi_meter meter = {.limit = UINT64_MAX};
        find_margins(part, 2 * pairs, 0.1, oblique, &meter);
        taken[many] = meter.taken;
        for (uint32_t i = 0; i < pairs; i++) {
            assert_true(face[2 * i].known);
        }
        const uint64_t limits[2] = {0, meter.taken / 2};
        for (int half = 0; half < 2; half++) {
            uint32_t known = 0;
            lrcsi_meter limited = {.limit = limits[half]};
            find_margins(part, 2 * pairs, 0.1, oblique, &limited);
            assert_true(limited.spent && limited.taken <= limits[half]);
            for (uint32_t i = 0; i < pairs; i++) {
                known += face[2 * i].known ? 1 : 0;
            }
            assert_true(half ? known > 0 && known < pairs : known == 0);
        }
    }
    assert_true(taken[0] > 0);
    assert_true(taken[1] >= 3 * taken[0] && taken[1] <= 6 * taken[0]);
}

/* With less memory or fewer steps less is known, and what is known is right. */
static void little_memory_and_few_steps_leave_more_open(void **state)
{
    (void)state;
    lrcs_recipe_part part[2] = {part_at(disc, 0, 0, 0), part_at(ball_of(0.3), 0, 0, 0.4)};
    find_margins(part, 2, 1e-2, oblique, NULL);
    const size_t need = lrcsi_face_margins_need(view.prepared);
    const double area = polygon_beyond_circle(0.3);
    const double least = face[FACE].error;
    unsigned unknown[2] = {0, 0};
    unsigned wider[2] = {0, 0};
    for (int by_steps = 0; by_steps < 2; by_steps++) {
        for (uint64_t limit = 0; limit < need; limit += 1 + limit / 4) {
            lrcsi_meter meter = {.limit = by_steps ? limit : UINT64_MAX};
            bands.meter = &meter;
            find_margins_within(by_steps ? need : (size_t)limit);
            assert_true(meter.taken <= meter.limit);
            unknown[by_steps] += !face[FACE].known;
            if (face[FACE].known && edges_on_face(CASTER) > 50) { /* all of the outline */
                assert_true(face[FACE].error >= least);
                check_abs(face[FACE].area, area, face[FACE].error);
                wider[by_steps] += face[FACE].error > least;
            }
        }
        assert_true(unknown[by_steps] > 0 && wider[by_steps] > 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(margins_of_a_ball_above_a_disc_have_their_sign),
        cmocka_unit_test(margins_of_short_edges),
        cmocka_unit_test(not_beside_the_side_of_the_face),
        cmocka_unit_test(not_of_a_part_that_pierces_the_plane),
        cmocka_unit_test(not_beside_an_edge_of_another_part),
        cmocka_unit_test(not_beside_a_corner_of_the_outline),
        cmocka_unit_test(not_beside_a_facet_in_the_plane),
        cmocka_unit_test(nothing_changes_on_a_hidden_face),
        cmocka_unit_test(margins_on_faces_one_behind_the_other),
        cmocka_unit_test(little_memory_and_few_steps_leave_more_open),
        cmocka_unit_test(steps_grow_like_the_number_of_faces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
