/* SPDX-License-Identifier: MIT */
/* Along which event edges the margins on a flat face are known with their sign: those of a ball
   above a disc or a rectangle, beside scenes in which one of the conditions (a) to (f) of face_margin.c does not
   hold, so that they must not be. Also that the work is counted, and grows like the number of
   faces. */
#include "visibility/proximity/face_margin.h"

#include <stdlib.h>

#include "recipe.h"
#include "visibility/proximity/cut_polygon.h"

static lrcs_scene scene;
static lrcs_work work;
static lrcsi_view view;
static lrcsi_classification classification;
static lrcsi_event_bands bands;
static lrcsi_face_margin face[LRCSI_FACES_OF_PART * 256];
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
    lrcsi_classify_facets(&classification, &work);
    assert_non_null(classification.facets);
    assert_int_equal(lrcsi_event_bands_make(&view, meter, &work, &bands), LRCS_OK);
    assert_true(bands.events.count <= 1u << 16);
    find_margins_within(lrcsi_face_margins_need(prepared));
}

/* Half the sum of gain and loss along the edges of a part that are added to the first face, but the
   shortest, of which these are not known: the error of their area if no sign is known. */
static double error_without_signs(uint32_t part)
{
    double sum = 0;
    for (uint32_t i = 0; i < bands.events.count; i++) {
        if (bands.events.part[i] == part && lrcsi_edge_faces_hold(&faces[i], FACE) &&
            isfinite(bands.areas[i].gain)) {
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

/* The area of the polygon that the caster's event edges form, beyond a true one in metres. */
static double polygon_beyond(double area_m2)
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
    return 0.5 * twice - ldexp(area_m2, -2 * view.prepared->exponent);
}

/* The area between the polygon that a ball's event edges form and the circle of the true ball. */
static double polygon_beyond_circle(double radius)
{
    return polygon_beyond(LRCS_PI * radius * radius);
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
        assert_false(face[LRCSI_FACES_OF_PART * CASTER].known);
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

/* The vertices of a convex part's event edges, in order; returns their number. */
static uint32_t outline_of(uint32_t part, double (*x)[2], uint32_t most)
{
    const lrcsi_edge *all = view.prepared->topology.edge;
    uint32_t last = 0; /* the event edge that leads to `at` */
    while (bands.events.part[last] != part) {
        last++;
    }
    const uint32_t start = all[bands.events.edge[last]].low;
    uint32_t at = all[bands.events.edge[last]].high;
    uint32_t count = 0;
    memcpy(x[count++], view.point[at].x, sizeof *x);
    while (at != start) {
        uint32_t next = 0;
        while (
            next == last || bands.events.part[next] != part ||
            (all[bands.events.edge[next]].low != at && all[bands.events.edge[next]].high != at)) {
            next++;
        }
        const lrcsi_edge *edge = &all[bands.events.edge[next]];
        at = edge->low == at ? edge->high : edge->low;
        last = next;
        assert_true(count < most);
        memcpy(x[count++], view.point[at].x, sizeof *x);
    }
    return count;
}

static double polygon_area(double (*x)[2], uint32_t count)
{
    double twice = 0;
    for (uint32_t i = 0; i < count; i++) {
        const double *a = x[i];
        const double *b = x[(i + 1) % count];
        twice += (a[0] - x[0][0]) * (b[1] - x[0][1]) - (a[1] - x[0][1]) * (b[0] - x[0][0]);
    }
    return 0.5 * twice;
}

/* --- parts that pierce the plane --------------------------------------------------------------- */

static int is_left_of(const void *a, const void *b)
{
    const double *p = a;
    const double *q = b;
    return (p[0] > q[0]) - (p[0] < q[0]);
}

/* The area of the convex hull of points, which are sorted. */
static double hull_area(double (*x)[2], uint32_t count)
{
    static double hull[1u << 17][2];
    uint32_t n = 0;
    uint32_t least = 1;
    assert_true(count > 2 && 2 * count < 1u << 17);
    qsort(x, count, sizeof *x, is_left_of);
    for (uint32_t i = 0; i < 2 * count - 1; i++) {
        const double *next = x[i < count ? i : 2 * count - 2 - i];
        while (n > least && (hull[n - 1][0] - hull[n - 2][0]) * (next[1] - hull[n - 2][1]) <=
                                (hull[n - 1][1] - hull[n - 2][1]) * (next[0] - hull[n - 2][0])) {
            n--;
        }
        memcpy(hull[n++], next, sizeof *hull);
        least = i + 1 == count ? n : least;
    }
    return polygon_area(hull, n - 1);
}

/* A point of the scene, in metres, in projection; kept only if it is on the plane z = 0 or in front
   of it. */
static uint32_t add_projected(double x, double y, double z, double (*to)[2], uint32_t count)
{
    const double at[3] = {ldexp(x, -view.prepared->exponent), ldexp(y, -view.prepared->exponent),
                          ldexp(z, -view.prepared->exponent)};
    double projected[3];
    if (z < 0) {
        return count;
    }
    lrcsi_view_coordinates(&view, at, projected);
    memcpy(to[count], projected, sizeof *to);
    return count + 1;
}

enum { CIRCLE = 20000 };

/* The area in projection of a ball about (0, 0, z) in front of the plane: the hull of the circle at
   which lines of sight touch it, and of that on the plane. */
static double ball_in_front(double radius, double z, const double d[3])
{
    static double x[2 * CIRCLE][2];
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const double across = hypot(d[0], d[1]);
    const double e[3] = {-d[1] / across, d[0] / across, 0};
    const double f[3] = {-d[2] * e[1] / length, d[2] * e[0] / length,
                         (d[0] * e[1] - d[1] * e[0]) / length};
    uint32_t count = 0;
    for (int i = 0; i < CIRCLE; i++) {
        const double c = radius * cos(2 * LRCS_PI * i / CIRCLE);
        const double s = radius * sin(2 * LRCS_PI * i / CIRCLE);
        const double ring = sqrt(radius * radius - z * z) / radius;
        count = add_projected(c * e[0] + s * f[0], c * e[1] + s * f[1], z + c * e[2] + s * f[2], x,
                              count);
        count = add_projected(ring * c, ring * s, 0, x, count);
    }
    return hull_area(x, count);
}

/* The same of a cylinder from (x, 0, z) along (sin lean, 0, cos lean). */
static double rod_in_front(const lrcs_shape *rod, double from, double z, double lean)
{
    static double x[3 * CIRCLE][2];
    const double axis[2] = {sin(lean), cos(lean)};
    uint32_t count = 0;
    for (int i = 0; i < CIRCLE; i++) {
        const double c = rod->radius * cos(2 * LRCS_PI * i / CIRCLE);
        const double s = rod->radius * sin(2 * LRCS_PI * i / CIRCLE);
        const double at[2] = {from + c * axis[1], z - c * axis[0]}; /* x and z on the base */
        const double t = -at[1] / axis[1];                          /* on the plane */
        count = add_projected(at[0], s, at[1], x, count);
        count = add_projected(at[0] + rod->length * axis[0], s, at[1] + rod->length * axis[1], x,
                              count);
        if (t > 0 && t < rod->length) {
            count = add_projected(at[0] + t * axis[0], s, 0, x, count);
        }
    }
    return hull_area(x, count);
}

/* The polygon of the caster's facets in front of the face. Every vertex in front is in it. */
static double cut_polygon_area(void)
{
    static unsigned char memory[1u << 24];
    static double corner[1u << 12][2];
    lrcs_work room = lrcs_work_make(memory, sizeof memory);
    lrcsi_cut_polygon polygon;
    lrcsi_face_frame frame;
    assert_true(lrcsi_face_frame_make(&bands, FACE, &frame));
    assert_true(lrcsi_cut_polygon_make(&bands, CASTER, &frame, 1e-3, &room, &polygon));
    assert_true(polygon.count > 10 && polygon.count <= 1u << 12);
    const lrcs_part *part = &scene.part[CASTER];
    for (uint32_t i = 0; i < polygon.count; i++) {
        const double *a = polygon.corner[i];
        const double *b = polygon.corner[(i + 1) % polygon.count];
        memcpy(corner[i], a, sizeof corner[i]);
        for (uint32_t k = 0; k < 3 * part->facet_count; k++) {
            const uint32_t vertex = scene.facet[part->first_facet + k / 3].corner[k % 3];
            const double *x = view.point[vertex].x;
            if (view.prepared->vertex[vertex].x[2] >= 0) {
                assert_true((b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]) > -1e-14);
            }
        }
    }
    return polygon_area(corner, polygon.count);
}

/* Balls and leaning cylinders that pierce the disc: the area in front of it, of the polygon and of
   the true shape. The hull of 20,000 points of a circle misses 1.7e-8 of its area. */
static void margins_of_parts_that_pierce_the_face(void **state)
{
    (void)state;
    static const double from[4][3] = {{0.2, 0.1, 1}, {1, 0.4, 1}, {-0.6, 0.5, 0.9}, {0.1, -1, 0.6}};
    const lrcs_shape rod = {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.1, .length = 0.5};
    for (int i = 0; i < 32; i++) {
        const double *d = from[i % 4];
        const double z = -0.2 + 0.05 * (i / 4);
        const double lean = 0.1 * (i / 4);
        const int is_rod = i % 2;
        double true_area;
        lrcs_recipe_part part[2] = {part_at(disc, 0, 0, 0), is_rod
                                                                ? part_at(rod, -0.1, 0, -0.12)
                                                                : part_at(ball_of(0.3), 0, 0, z)};
        if (is_rod) {
            const double turn[3][3] = {
                {cos(lean), 0, sin(lean)}, {0, 1, 0}, {-sin(lean), 0, cos(lean)}};
            memcpy(part[1].place.rotate, turn, sizeof turn);
        }
        find_margins(part, 2, 1e-3, d, NULL);
        true_area = is_rod ? rod_in_front(&rod, -0.1, -0.12, lean) : ball_in_front(0.3, z, d);
        assert_true(face[FACE].known && face[FACE].cut == 1u << CASTER);
        assert_int_equal(face[FACE].causes, 1u << CASTER);
        const double polygon = cut_polygon_area();
        check_abs(face[FACE].area, polygon - true_area, face[FACE].error + 1e-7 * true_area);
        lrcsi_outline cut;
        double err;
        assert_true(lrcsi_outline_cut(&bands.orders.outline[CASTER], &view,
                                      scene.part[FACE].first_facet, 0, &cut, &err));
        check_most(cut.k, 16 * bands.orders.outline[CASTER].k);
        check_most(face[FACE].error, 0.05 * cut.k * sqrt(true_area));
    }
}

/* A rod and a ball pierce one disc, and a ball is above a second disc: what is found on the first does
   not change what is found on the second. */
static void margins_behind_a_pierced_face(void **state)
{
    (void)state;
    const lrcs_shape rod = {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.05, .length = 0.5};
    lrcs_recipe_part part[5] = {part_at(disc, 0, 0, 0), part_at(rod, 0.4, 0, -0.1),
                                part_at(disc, 5, 0, 0), part_at(ball_of(0.3), 5, 0, 0.4),
                                part_at(ball_of(0.3), -0.4, 0, 0.1)};
    static double x[2048][2];
    const double radius = 0.3;
    find_margins(part, 5, 1e-3, oblique, NULL);
    const lrcsi_face_margin *second = &face[LRCSI_FACES_OF_PART * 2];
    const double circle = LRCS_PI * ldexp(radius * radius, -2 * view.prepared->exponent);
    const double beyond = fabs(polygon_area(x, outline_of(3, x, 2048))) - circle;
    assert_true(face[FACE].cut == (1u << CASTER | 1u << 4));
    assert_true(second->known && second->cut == 0);
    check_abs(second->area, beyond, second->error);
    check_most(second->error, 0.1 * fabs(face[FACE].error) + 0.02 * fabs(beyond));
}

/* A ball that pierces the plane beside the face, or at its border, and one that is hardly in front
   of it. */
static void not_of_parts_that_pierce_the_border(void **state)
{
    (void)state;
    static const double at[2][3] = {{0.9, 0, -0.1}, {0, 0, -0.29}};
    for (int i = 0; i < 2; i++) {
        lrcs_recipe_part part[2] = {part_at(disc, 0, 0, 0),
                                    part_at(ball_of(0.3), at[i][0], at[i][1], at[i][2])};
        find_margins(part, 2, 1e-3, oblique, NULL);
        assert_true(bands.events.count > 20);
        assert_int_equal(face[FACE].cut, 0);
        assert_int_equal(edges_on_face(CASTER), 0);
    }
}

/* (c): another ball on the same line of sight has the same outline. */
static void not_beside_an_edge_of_another_part(void **state)
{
    (void)state;
    lrcs_recipe_part part[3] = {part_at(disc, 0, 0, 0), part_at(ball_of(0.3), 0.08, 0.04, 0.4),
                                part_at(ball_of(0.3), 0.24, 0.12, 1.2)};
    check_without_signs(part, 3, oblique);
}

/* (d): a lying cylinder, seen so that the ellipses at its ends are narrow: where its sides end, the
   outline of the facets turns by more than half a radian. From farther aside it does not. There the
   error is smaller; the true outline is an ellipse and two of its tangents. */
static void not_beside_a_corner_of_the_outline(void **state)
{
    (void)state;
    static const double lying[3][3] = {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
    const lrcs_shape rod = {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.2, .length = 0.6};
    double error[2];
    for (int aside = 0; aside < 2; aside++) {
        const double d[3] = {0, aside ? 0.1 : 0.02, 1};
        const double cosine = d[1] / hypot(d[1], d[2]);
        const double true_m2 = LRCS_PI * rod.radius * rod.radius * cosine +
                               2 * rod.radius * rod.length * sqrt(1 - cosine * cosine);
        lrcs_recipe_part part[2] = {part_at(disc, 0, 0, 0), part_at(rod, 0, -0.3, 0.5)};
        memcpy(part[1].place.rotate, lying, sizeof lying);
        find_margins(part, 2, 1e-3, d, NULL);
        assert_true(face[FACE].known && edges_on_face(CASTER) > 20);
        check_abs(face[FACE].area, polygon_beyond(true_m2), face[FACE].error);
        check_most(face[FACE].error, 0.01 * error_without_signs(CASTER));
        error[aside] = face[FACE].error;
    }
    check_most(error[1], error[0]);
}

/* The area that two convex polygons have in common: the first, cut along the sides of the second. */
static double common_area(double (*x)[2], uint32_t count, double (*side)[2], uint32_t sides)
{
    static double kept[4096][2];
    const double turn = polygon_area(side, sides) > 0 ? 1 : -1;
    for (uint32_t s = 0; s < sides; s++) {
        const double *a = side[s];
        const double *b = side[(s + 1) % sides];
        uint32_t left = 0;
        for (uint32_t i = 0; i < count; i++) {
            const double *p = x[i];
            const double *q = x[(i + 1) % count];
            const double at_p =
                turn * ((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]));
            const double at_q =
                turn * ((b[0] - a[0]) * (q[1] - a[1]) - (b[1] - a[1]) * (q[0] - a[0]));
            if (at_p >= 0) {
                memcpy(kept[left++], p, sizeof kept[0]);
            }
            if (at_p * at_q < 0) {
                for (int k = 0; k < 2; k++) {
                    kept[left][k] = p[k] + at_p / (at_p - at_q) * (q[k] - p[k]);
                }
                left++;
            }
        }
        memcpy(x, kept, left * sizeof kept[0]);
        count = left;
    }
    return fabs(polygon_area(x, count));
}

/* Two balls whose outlines cross: each hides nothing that the other one hides already, and the
   crossings alone are open. What both leave of the disc follows from the common area of two circles,
   and of two polygons. */
static void beside_crossings_of_two_outlines(void **state)
{
    (void)state;
    static double x[2][2048][2];
    for (int fine = 0; fine < 2; fine++) {
        lrcs_recipe_part part[3] = {part_at(disc, 0, 0, 0), part_at(ball_of(0.3), 0, 0, 0.5),
                                    part_at(ball_of(0.3), 0.31, 0.06, 1.2)};
        const double d[3] = {0.05, 0.1, 1};
        find_margins(part, 3, fine ? 1e-4 : 1e-3, d, NULL);
        double centre[2][3];
        double polygons = 0;
        uint32_t count[2];
        for (int i = 0; i < 2; i++) {
            const double at[3] = {ldexp(part[1 + i].place.translate[0], -view.prepared->exponent),
                                  ldexp(part[1 + i].place.translate[1], -view.prepared->exponent),
                                  ldexp(part[1 + i].place.translate[2], -view.prepared->exponent)};
            lrcsi_view_coordinates(&view, at, centre[i]);
            count[i] = outline_of(CASTER + (uint32_t)i, x[i], 2048);
            polygons += fabs(polygon_area(x[i], count[i]));
        }
        const double apart = hypot(centre[1][0] - centre[0][0], centre[1][1] - centre[0][1]);
        const double r = ldexp(0.3, -view.prepared->exponent);
        const double lens =
            2 * r * r * acos(apart / (2 * r)) - 0.5 * apart * sqrt(4 * r * r - apart * apart);
        const double circles = 2 * LRCS_PI * r * r - lens;
        const double common = common_area(x[0], count[0], x[1], count[1]);
        assert_true(face[FACE].known && common > 0.1 * lens);
        check_abs(face[FACE].area, polygons - common - circles, face[FACE].error);
        const double open = error_without_signs(CASTER) + error_without_signs(CASTER + 1);
        check_most(face[FACE].error, fine ? 0.01 * open : 0.03 * open);
        check_most(1e-6 * open, face[FACE].error);
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

/* Of discs under the ball, the uppermost hides the others where the margins are. A fifth face is
   known, but has no margins. */
static void margins_on_faces_one_behind_the_other(void **state)
{
    (void)state;
    lrcs_shape upper = disc;
    upper.radius = 0.8;
    lrcs_recipe_part part[6] = {part_at(disc, 0, 0, -0.5), part_at(ball_of(0.3), 0, 0, 0.4),
                                part_at(upper, 0, 0, 0),   part_at(disc, 0, 0, -1),
                                part_at(disc, 0, 0, -1.5), part_at(disc, 0, 0, -2)};
    find_margins(part, 6, 1e-3, oblique, NULL);
    const uint32_t edges = edges_on_face(CASTER);
    uint32_t all = 0;
    uint32_t both = 0;
    for (uint32_t i = 0; i < bands.events.count; i++) {
        all += bands.events.part[i] == CASTER;
        both += bands.events.part[i] == CASTER && lrcsi_edge_faces_hold(&faces[i], FACE) &&
                lrcsi_edge_faces_hold(&faces[i], LRCSI_FACES_OF_PART * 2);
    }
    assert_true(edges > 20 && both == edges && all == edges);
    check_abs(face[LRCSI_FACES_OF_PART * 2].area, polygon_beyond_circle(0.3),
              face[LRCSI_FACES_OF_PART * 2].error);
    check_most(face[LRCSI_FACES_OF_PART * 2].error, 0.1 * error_without_signs(CASTER));
    assert_true(face[FACE].known && face[LRCSI_FACES_OF_PART * 3].known &&
                face[LRCSI_FACES_OF_PART * 4].known);
    const lrcsi_face_margin *fifth = &face[LRCSI_FACES_OF_PART * 5];
    assert_true(fifth->known && fifth->area == 0 && fifth->error == 0 && fifth->causes == 0);
    check_most(face[FACE].error, 1e-12);
}

/* A face of a box, turned or not, or a plate: all of the margin is known. */
static void margins_on_rectangles_have_their_sign(void **state)
{
    (void)state;
    static const double d[3] = {0.1, -0.2, 1};
    const lrcs_shape shapes[2] = {{.kind = LRCS_SHAPE_BOX, .size = {3, 2.5, 1}},
                                  {.kind = LRCS_SHAPE_PLATE, .size = {3, 2.5, 0}}};
    for (int i = 0; i < 8; i++) {
        lrcs_recipe_part part[2] = {part_at(shapes[i % 2], 0, 0, 0),
                                    part_at(ball_of(0.3), 0.2 + 0.1, -0.15 - 0.2, 1.5)};
        if (i & 2) {
            part[FACE].place.rotate[0][0] = part[FACE].place.rotate[1][1] = 0.8;
            part[FACE].place.rotate[1][0] = 0.6;
            part[FACE].place.rotate[0][1] = -0.6;
        }
        find_margins(part, 2, i & 4 ? 1e-3 : 1e-4, d, NULL);
        assert_true(face[FACE].known && edges_on_face(CASTER) > 20);
        check_abs(face[FACE].area, polygon_beyond_circle(0.3), face[FACE].error);
        check_most(face[FACE].error, 0.1 * error_without_signs(CASTER));
    }
}

/* The edge between two faces of a box runs below the ball: each has a part of the margin, and what
   is near the edge is open. */
static void margins_on_two_faces_of_a_box(void **state)
{
    (void)state;
    const double d[3] = {1, 1.2, 0.1};
    const lrcs_shape box = {.kind = LRCS_SHAPE_BOX, .size = {2, 2, 2}};
    lrcs_recipe_part part[2] = {part_at(box, 0, 0, 0), part_at(ball_of(0.3), 2, 2.2, 0.1)};
    find_margins(part, 2, 1e-3, d, NULL);
    assert_true(face[1].known && face[2].known && !face[0].known);
    double length = 0;
    for (uint32_t i = 0; i < bands.events.count; i++) {
        length += bands.events.part[i] == CASTER
                      ? 0.5 * (bands.areas[i].gain + bands.areas[i].loss < HUGE_VAL
                                   ? bands.areas[i].gain + bands.areas[i].loss
                                   : 0)
                      : 0;
    }
    check_abs(face[1].area + face[2].area, polygon_beyond_circle(0.3),
              face[1].error + face[2].error);
    check_most(face[1].error + face[2].error, 0.2 * length);
    check_most(0.001 * length, face[1].error + face[2].error);
}

/* (a): N across the border of a plate; (e): a box that intersects the plate below the ball, and has
   no pair with it, because both are exact. */
static void not_at_a_border_or_a_contact_of_a_plate(void **state)
{
    (void)state;
    const double d[3] = {0.02, -0.05, 1};
    const lrcs_shape plate = {.kind = LRCS_SHAPE_PLATE, .size = {3, 2.5, 0}};
    const lrcs_shape wedge = {.kind = LRCS_SHAPE_BOX, .size = {0.4, 4, 0.2}};
    lrcs_recipe_part border[2] = {part_at(plate, 0, 0, 0), part_at(ball_of(0.3), 1.5, 0, 1.5)};
    find_margins(border, 2, 1e-3, d, NULL);
    assert_true(face[FACE].known);
    check_most(1e-3 * error_without_signs(CASTER), face[FACE].error);
    lrcs_recipe_part crossed[3] = {part_at(plate, 0, 0, 0), part_at(ball_of(0.3), 0.2, 0, 1.5),
                                   part_at(wedge, 0.3, 0, -0.1)};
    crossed[2].place.rotate[0][0] = crossed[2].place.rotate[2][2] = 0.8; /* about y */
    crossed[2].place.rotate[0][2] = 0.6;
    crossed[2].place.rotate[2][0] = -0.6;
    find_margins(crossed, 3, 1e-3, d, NULL);
    assert_true(face[FACE].known);
    check_most(0.02 * error_without_signs(CASTER), face[FACE].error);
}

/* Far from the origin, rounding of its corners turns the facets of a plate against each other: it is
   no face. */
static void not_on_a_plate_that_rounding_turns(void **state)
{
    (void)state;
    const double far = 1048576.3;
    const double turn[3][3] = {{0.6, -0.64, 0.48}, {0.8, 0.48, -0.36}, {0, 0.6, 0.8}};
    const double d[3] = {0.48, -0.36, 0.8};
    const lrcs_shape plate = {.kind = LRCS_SHAPE_PLATE, .size = {2, 2, 0}};
    lrcs_recipe_part part[2] = {
        part_at(plate, far, 2 * far, 3 * far),
        part_at(ball_of(0.3), far + 1.5 * d[0], 2 * far + 1.5 * d[1], 3 * far + 1.5 * d[2])};
    memcpy(part[FACE].place.rotate, turn, sizeof turn);
    find_margins(part, 2, 1e-3, d, NULL);
    const lrcsi_normal *n = view.prepared->normal;
    double turned = 0;
    for (int k = 0; k < 3; k++) {
        turned = fmax(turned, fabs(n[0].high[k] / n[0].length - n[1].high[k] / n[1].length));
    }
    assert_true(turned > 1e-11); /* this is such a plate */
    assert_false(face[FACE].known);
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
            assert_true(face[LRCSI_FACES_OF_PART * (2 * i)].known);
        }
        const uint64_t limits[2] = {0, meter.taken / 2};
        for (int half = 0; half < 2; half++) {
            uint32_t known = 0;
            lrcsi_meter limited = {.limit = limits[half]};
            find_margins(part, 2 * pairs, 0.1, oblique, &limited);
            assert_true(limited.spent && limited.taken <= limits[half]);
            for (uint32_t i = 0; i < pairs; i++) {
                known += face[LRCSI_FACES_OF_PART * (2 * i)].known ? 1 : 0;
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
        assert_true(unknown[by_steps] > 0 && (by_steps == 0 || wider[by_steps] > 0));
    }
    bands.meter = NULL;
    classification.facets = NULL; /* as if there had been no memory for it */
    find_margins_within(need);
    assert_true(face[FACE].known && face[FACE].error > least);
    check_abs(face[FACE].area, area, face[FACE].error);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(margins_of_a_ball_above_a_disc_have_their_sign),
        cmocka_unit_test(margins_of_short_edges),
        cmocka_unit_test(not_beside_the_side_of_the_face),
        cmocka_unit_test(margins_of_parts_that_pierce_the_face),
        cmocka_unit_test(margins_behind_a_pierced_face),
        cmocka_unit_test(not_of_parts_that_pierce_the_border),
        cmocka_unit_test(not_beside_an_edge_of_another_part),
        cmocka_unit_test(not_beside_a_corner_of_the_outline),
        cmocka_unit_test(beside_crossings_of_two_outlines),
        cmocka_unit_test(not_beside_a_facet_in_the_plane),
        cmocka_unit_test(nothing_changes_on_a_hidden_face),
        cmocka_unit_test(margins_on_rectangles_have_their_sign),
        cmocka_unit_test(margins_on_two_faces_of_a_box),
        cmocka_unit_test(not_at_a_border_or_a_contact_of_a_plate),
        cmocka_unit_test(not_on_a_plate_that_rounding_turns),
        cmocka_unit_test(margins_on_faces_one_behind_the_other),
        cmocka_unit_test(little_memory_and_few_steps_leave_more_open),
        cmocka_unit_test(steps_grow_like_the_number_of_faces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
