/* SPDX-License-Identifier: MIT */
/* Outlines of true shapes beside those of their facets: the areas along all edges together, against
   those between both outlines, measured along rays through points of every edge. And which planes a
   shape is in front of. */
#include "visibility/proximity/outline_area.h"

#include <string.h>

#include <lrcs/lrcs.h>

#include "check.h"
#include "random.h"
#include "visibility/index/event.h"

#define SHAPES 6
#define RAYS   6 /* through each edge */

static unsigned char scene_area[1u << 24];
static unsigned char run_area[1u << 26];
static lrcs_scene scene;
static lrcsi_view view;
static uint64_t seed = 3;

static const lrcs_shape shapes[SHAPES] = {
    {.kind = LRCS_SHAPE_SPHERE, .radius = 0.5},
    {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.25, .length = 1},
    {.kind = LRCS_SHAPE_CONE, .radius = 0.5, .half_angle_deg = 30},
    {.kind = LRCS_SHAPE_DOME, .radius = 0.5},
    {.kind = LRCS_SHAPE_FRUSTUM, .radius = 0.5, .radius2 = 0.25, .length = 1},
    {.kind = LRCS_SHAPE_PARABOLOID, .radius = 0.5, .length = 0.25}};

static double chance(void)
{
    return 2 * random_unit(&seed) - 1;
}

/* The shape as part 0, at a place with a random turn, and a plate as part 1. */
static void view_make(const lrcs_shape *shape, double tolerance, const double plate_at[3],
                      const double direction[3], double a, double b, double c)
{
    lrcs_recipe_part part[2] = {
        {.name = "a", .shape = *shape, .place = lrcs_place_default(), .material_index = -1},
        {.name = "b",
         .shape = {.kind = LRCS_SHAPE_PLATE, .size = {9, 9}},
         .place = lrcs_place_default(),
         .material_index = -1}};
    lrcs_recipe recipe = {.part = part, .part_count = 2};
    const lrcs_build_options build = {tolerance, 1u << 14, LRCS_NORMALS_FLAT, 0, 0, NULL};
    lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
    const lrcs_prepared *prepared;
    lrcs_pose pose;
    assert_int_equal(lrcs_pose_from_euler("XYZ", (const double[3]){a, b, c}, &pose), LRCS_OK);
    memcpy(part[0].place.rotate, pose.R, sizeof part[0].place.rotate);
    memcpy(part[1].place.rotate, part[0].place.rotate, sizeof part[1].place.rotate);
    double d[3] = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        part[0].place.translate[k] = 0.1 * (k + 1);
        part[1].place.translate[k] = part[0].place.translate[k];
        for (int i = 0; i < 3; i++) {
            part[1].place.translate[k] += part[0].place.rotate[k][i] * plate_at[i];
            d[k] += part[0].place.rotate[k][i] * direction[i];
        }
    }
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &build, &work, &scene, NULL), LRCS_OK);
    work = lrcs_work_make(run_area, sizeof run_area);
    assert_int_equal(lrcs_prepare_run(&scene, &work, &prepared), LRCS_OK);
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
}

/* A point of the meridian, t = -1 (sphere) or 0 .. 1, times its components along w. */
static double meridian_along(const lrcs_shape *shape, double t, double across, double along)
{
    double rise = fmax(0, t);
    double angle = 0.5 * LRCS_PI * t;
    switch (shape->kind) {
    case LRCS_SHAPE_SPHERE:
        return shape->radius * (cos(angle) * across + sin(angle) * along);
    case LRCS_SHAPE_DOME:
        return shape->radius * (cos(fmax(0, angle)) * across + sin(fmax(0, angle)) * along);
    case LRCS_SHAPE_CONE:
        return shape->radius * ((1 - rise) * across + rise / tan(LRCS_PI / 6) * along);
    case LRCS_SHAPE_FRUSTUM:
        return (shape->radius2 + rise * (shape->radius - shape->radius2)) * across +
               rise * shape->length * along;
    case LRCS_SHAPE_PARABOLOID:
        return shape->radius * (1 - rise) * across + shape->length * rise * (2 - rise) * along;
    default:
        return shape->radius * across + rise * shape->length * along;
    }
}

/* The largest w . x over the true shape in projection, from its origin, by a search along the
   meridian. */
static double true_support(const lrcsi_outline *o, const lrcs_shape *shape, double angle)
{
    double n[3];
    double low = shape->kind == LRCS_SHAPE_SPHERE ? -1 : 0;
    double high = 1;
    for (int k = 0; k < 3; k++) {
        n[k] = o->axis[k][0] * cos(angle) + o->axis[k][1] * sin(angle);
    }
    double across = hypot(n[0], n[1]);
    for (int i = 0; i < 30; i++) {
        double a = low + (high - low) / 3;
        double b = high - (high - low) / 3;
        if (meridian_along(shape, a, across, n[2]) < meridian_along(shape, b, across, n[2])) {
            low = a;
        } else {
            high = b;
        }
    }
    double ends =
        fmax(meridian_along(shape, -1, across, n[2]), meridian_along(shape, 1, across, n[2]));
    return ldexp(fmax(ends, meridian_along(shape, 0.5 * (low + high), across, n[2])),
                 -view.prepared->exponent);
}

/* How far a ray at an angle from the origin of coordinates goes within the true outline about a
   point: the least over its tangents, sampled and then refined. */
static double true_exit(const lrcsi_outline *o, const lrcs_shape *shape, const double from[2],
                        double angle)
{
    double best = HUGE_VAL;
    double at = angle;
    double step = 0.14;
    for (int round = 0; round < 7; round++, step *= 0.12) {
        double middle = at;
        for (int i = -10; i <= 10; i++) {
            double turned = middle + i * step;
            double c = cos(turned - angle);
            if (c > 0.05) {
                double support = true_support(o, shape, turned) +
                                 (o->centre[0] - from[0]) * cos(turned) +
                                 (o->centre[1] - from[1]) * sin(turned);
                if (support / c < best) {
                    best = support / c;
                    at = turned;
                }
            }
        }
    }
    return best;
}

/* The side of an edge on the outline of part 0 on which its facets lie; 0: it is none, or one of
   its facets is edge-on. */
static int contour_side(const lrcsi_outline *o, uint32_t e)
{
    const lrcsi_topology *topology = &view.prepared->topology;
    const lrcsi_edge *edge = &topology->edge[e];
    const lrcsi_edge_use *use = topology->use + edge->first_use;
    if (scene.facet_part[use[0].facet] != 0) {
        return 0;
    }
    if (edge->uses == 1) {
        int facing = view.facing[use[0].facet];
        return lrcsi_outline_inside(o, &view, facing) ? 0 : use[0].forward ? facing : -facing;
    }
    if (edge->uses != 2 || view.facing[use[0].facet] * view.facing[use[1].facet] >= 0) {
        return 0;
    }
    int front = view.facing[use[0].facet] > 0 ? 0 : 1;
    return use[front].forward ? 1 : -1;
}

/* Two parts of an edge have together the area along all of it, and a part has no larger error, but
   for where it divides an arc. */
static void check_margin_parts(const lrcsi_outline *o, const double a[3], const double b[3],
                               int side)
{
    const double at = 0.5 + 0.5 * chance();
    const lrcsi_outline_margin whole = lrcsi_outline_margin_make(o, a, b, side, 0, 1);
    const lrcsi_outline_margin first = lrcsi_outline_margin_make(o, a, b, side, 0, at);
    const lrcsi_outline_margin second = lrcsi_outline_margin_make(o, a, b, side, at, 1);
    assert_int_equal(isfinite(first.error), isfinite(whole.error));
    if (isfinite(whole.error)) {
        check_abs(first.area + second.area, whole.area, whole.error + first.error + second.error);
        const lrcsi_outline_areas areas = lrcsi_outline_areas_make(o, a, b, side);
        check_most(first.error, 4 * whole.error + 0x1p-9 * (areas.gain + areas.loss));
        check_most(first.width, whole.width);
    }
}

static void check_areas(const lrcs_shape *shape, double tolerance, const double direction[3],
                        int *known, int *all)
{
    view_make(shape, tolerance, (const double[3]){0, 0, -3}, direction, 40 * chance(),
              40 * chance(), 170 * chance());
    lrcsi_outline o = lrcsi_outline_make(&view, 0);
    assert_true(o.known);
    const lrcsi_topology *topology = &view.prepared->topology;
    lrcsi_outline_areas sum = {.gain = 0};
    lrcsi_outline_margin margins = {.area = 0};
    double from[2] = {0, 0};
    int count = 0;
    for (uint32_t e = 0; e < topology->edge_count; e++) {
        int side = contour_side(&o, e);
        const double *a = view.point[topology->edge[e].low].x;
        const double *b = view.point[topology->edge[e].high].x;
        if (side != 0) {
            lrcsi_outline_areas areas = lrcsi_outline_areas_make(&o, a, b, side);
            lrcsi_outline_margin margin = lrcsi_outline_margin_make(&o, a, b, side, 0, 1);
            sum.gain += areas.gain;
            sum.loss += areas.loss;
            margins.area += margin.area;
            margins.error += margin.error;
            assert_true(isfinite(margin.error) || isinf(areas.gain));
            check_most(margin.area, areas.gain);
            check_most(-margin.area, areas.loss);
            check_margin_parts(&o, a, b, side);
            from[0] += 0.5 * (a[0] + b[0]);
            from[1] += 0.5 * (a[1] + b[1]);
            count++;
            *known += isfinite(areas.gain);
        }
    }
    *all += count;
    from[0] /= count;
    from[1] /= count;
    double gain = 0;
    double loss = 0;
    double deepest[2] = {0, 0};    /* of all edges: the bounds, and the truth */
    const double err = 1e-5 * o.k; /* of the measured exits */
    for (uint32_t e = 0; e < topology->edge_count; e++) {
        const double *a = view.point[topology->edge[e].low].x;
        const double *b = view.point[topology->edge[e].high].x;
        const int side = contour_side(&o, e);
        const lrcsi_outline_areas areas = lrcsi_outline_areas_make(&o, a, b, side);
        const double length = hypot(b[0] - a[0], b[1] - a[1]);
        const double height =
            fabs((a[0] - from[0]) * (b[1] - a[1]) - (a[1] - from[1]) * (b[0] - a[0])) / length;
        for (int i = 0; i < RAYS && side != 0; i++) {
            const double piece[2] = {(b[0] - a[0]) / RAYS, (b[1] - a[1]) / RAYS};
            const double p[2] = {a[0] + (i + 0.5) * piece[0] - from[0],
                                 a[1] + (i + 0.5) * piece[1] - from[1]};
            double truth = true_exit(&o, shape, from, atan2(p[1], p[0]));
            double area = 0.5 * fabs(p[0] * piece[1] - p[1] * piece[0]) *
                          (1 - truth * truth / (p[0] * p[0] + p[1] * p[1]));
            gain += fmax(0, area);
            loss += fmax(0, -area);
            const double depth = height * (1 - truth / hypot(p[0], p[1]));
            check_most(depth, areas.gain_depth * 1.01 + err);
            check_most(-depth, areas.loss_depth * 1.01 + err);
            deepest[1] = fmax(deepest[1], fabs(depth));
        }
        const lrcsi_outline_margin margin = lrcsi_outline_margin_make(&o, a, b, side, 0, 1);
        for (int i = 0; i < 2 && isfinite(margin.error); i++) {
            const double *end = i == 0 ? a : b;
            const double p[2] = {end[0] - from[0], end[1] - from[1]};
            const double truth = true_exit(&o, shape, from, atan2(p[1], p[0]));
            const double depth = height * (1 - truth / hypot(p[0], p[1]));
            check_most(fabs(depth), margin.end_depth[i] * 1.01 + err);
            check_most(margin.end_depth[i], 2 * o.k);
        }
        if (side != 0) {
            deepest[0] = fmax(deepest[0], fmax(areas.gain_depth, areas.loss_depth));
        }
    }
    if (isfinite(deepest[0])) {
        check_most(deepest[0], 4 * deepest[1] + err);
    }
    check_most(gain, sum.gain * 1.01 + err);
    check_most(loss, sum.loss * 1.01 + err);
    if (isfinite(sum.gain)) { /* the bounds are not far too wide */
        /* of RAYS; and near the ends of edges, which turn by 2 pi (face_margin.c) */
        const double rays = 0.02 * (gain + loss) + err + 4 * o.k * o.k * 4 * LRCS_PI;
        check_abs(margins.area, gain - loss, margins.error + rays);
        check_most(margins.error, 0.02 * (gain + loss) + err);
        check_most(fmax(sum.gain, sum.loss), 4 * fmax(gain, loss) + err);
    }
}

static void areas_bound_what_lies_between_both_outlines(void **state)
{
    (void)state;
    for (int i = 0; i < SHAPES; i++) {
        int known = 0;
        int all = 0;
        for (int k = 0; k < 4; k++) {
            lrcs_shape shape = shapes[i];
            int has_base = shape.kind != LRCS_SHAPE_SPHERE && shape.kind != LRCS_SHAPE_CYLINDER &&
                           shape.kind != LRCS_SHAPE_FRUSTUM;
            shape.parts = k >= 2 && has_base ? LRCS_SHAPE_WALL : LRCS_SHAPE_ALL;
            const double direction[3] = {chance(), chance(), 0.2 + chance()};
            check_areas(&shape, k % 2 ? 1e-2 : 1e-1, direction, &known, &all);
        }
        check_most(0.7 * all, known);
    }
}

/* The integral of h - sqrt(r^2 - (t - at)^2) over 0 <= t <= length. */
static double circle_area(double h, double r, double at, double length)
{
    long double sum = (long double)h * length;
    for (int i = 0; i < 2; i++) {
        const long double x = (i == 0 ? 0 : (long double)length) - at;
        const long double y = sqrtl((long double)r * r - x * x);
        const long double half = 0.5L * (x * y + (long double)r * r * asinl(x / r));
        sum += i == 0 ? half : -half;
    }
    return (double)sum;
}

static void areas_beside_circles_are_those_of_their_segments(void **state)
{
    (void)state;
    int count = 0;
    for (int i = 0; i < 8; i++) {
        const int is_cone = i % 2;
        const double along[3] = {0, 0, 1};
        const double direction[3] = {chance(), chance(), 0.2 + chance()};
        view_make(&shapes[is_cone ? 2 : 0], i < 4 ? 1e-1 : 1e-3, (const double[3]){0, 0, -3},
                  is_cone ? along : direction, 40 * chance(), 40 * chance(), 170 * chance());
        const lrcsi_outline o = lrcsi_outline_make(&view, 0);
        const lrcsi_topology *topology = &view.prepared->topology;
        const double radius = ldexp(0.5, -view.prepared->exponent);
        for (uint32_t e = 0; e < topology->edge_count; e++) {
            const double *a = view.point[topology->edge[e].low].x;
            const double *b = view.point[topology->edge[e].high].x;
            const int side = contour_side(&o, e);
            const lrcsi_outline_margin margin = lrcsi_outline_margin_make(&o, a, b, side, 0, 1);
            if (side == 0 || isinf(margin.error)) {
                continue;
            }
            const double length = hypot(b[0] - a[0], b[1] - a[1]);
            const double u[2] = {(b[0] - a[0]) / length, (b[1] - a[1]) / length};
            const double c[2] = {o.centre[0] - a[0], o.centre[1] - a[1]};
            const double truth = circle_area(side * (u[0] * c[1] - u[1] * c[0]), radius,
                                             u[0] * c[0] + u[1] * c[1], length);
            const lrcsi_outline_areas areas = lrcsi_outline_areas_make(&o, a, b, side);
            check_abs(margin.area, truth, margin.error);
            check_most(margin.error, 1e-3 * (areas.gain + areas.loss) + 1e-16);
            count++;
        }
    }
    check_most(100, count);
}

static void a_shape_is_in_front_of_the_plane_that_it_stands_on(void **state)
{
    (void)state;
    static const struct {
        double z, direction;
        int expected;
    } cases[] = {{0, 1, 1}, {-0.5, 1, 1}, {0.001, 1, 0}, {0, -1, 0}, {2, 1, 0}};
    for (int i = 1; i < SHAPES; i++) {
        for (int k = 0; k < 5; k++) {
            double err = 0;
            view_make(&shapes[i], 1e-1, (const double[3]){0, 0, cases[k].z},
                      (const double[3]){0.3, 0.2, cases[k].direction}, 20, 30, 40);
            lrcsi_outline o = lrcsi_outline_make(&view, 0);
            uint32_t plate = scene.part[1].first_facet;
            assert_int_equal(lrcsi_outline_in_front(&o, &view, plate, 0, &err), cases[k].expected);
            if (cases[k].expected) {
                check_most(err, 1e-12);
            }
        }
    }
}

static void tubes_and_flat_parts_have_no_outline(void **state)
{
    (void)state;
    lrcs_shape open = shapes[1];
    open.parts = LRCS_SHAPE_WALL;
    view_make(&open, 1e-1, (const double[3]){0, 0, -1}, (const double[3]){0.3, 0.2, 1}, 0, 0, 0);
    assert_false(lrcsi_outline_make(&view, 0).known);
    assert_false(lrcsi_outline_make(&view, 1).known);
}

/* Boxes and plates are what their facets are: between both outlines there is nothing. */
static void boxes_and_plates_have_exact_outlines(void **state)
{
    (void)state;
    const lrcs_shape box = {.kind = LRCS_SHAPE_BOX, .size = {1, 2, 3}};
    const double direction[3] = {0.3, 0.2, 1};
    for (int plate = 0; plate < 2; plate++) {
        view_make(&box, 1e-1, (const double[3]){0, 0, -3}, direction, 0, 0, 0);
        const lrcsi_outline o = lrcsi_outline_make_exact(&view, (uint32_t)plate, 0x1p-20);
        const double *a = view.point[scene.facet[scene.part[plate].first_facet].corner[0]].x;
        const double *b = view.point[scene.facet[scene.part[plate].first_facet].corner[1]].x;
        const double length = hypot(b[0] - a[0], b[1] - a[1]);
        assert_true(o.known && o.is_exact);
        check_same(o.k, 0x1p-20);
        const lrcsi_outline_margin margin = lrcsi_outline_margin_make(&o, a, b, 1, 0.25, 0.5);
        check_same(margin.area, 0);
        check_same(margin.error, 0);
        check_same(margin.depth, 0);
        check_most(sqrt(2) * (0.25 * length), margin.width);
        assert_true(isinf(lrcsi_outline_margin_make(&o, a, b, 0, 0, 1).error));
    }
    view_make(&shapes[1], 1e-1, (const double[3]){0, 0, -1}, direction, 0, 0, 0);
    assert_false(lrcsi_outline_make_exact(&view, 0, 0x1p-20).known);
}

static void nothing_is_known_along_edges_without_length_side_or_outline(void **state)
{
    (void)state;
    const double above[3] = {0, 0, -1};
    const double direction[3] = {0.3, 0.2, 1};
    view_make(&shapes[1], 1e-1, above, direction, 0, 0, 0);
    lrcsi_outline o = lrcsi_outline_make(&view, 0);
    const double a[3] = {o.centre[0], o.centre[1], 0};
    const double b[3] = {o.centre[0] + 0.5 * o.size, o.centre[1], 0};
    assert_true(o.known);
    assert_true(isinf(lrcsi_outline_areas_make(&o, a, b, 0).gain));
    assert_true(isinf(lrcsi_outline_areas_make(&o, a, a, 1).gain));
    assert_true(isinf(lrcsi_outline_margin_make(&o, a, b, 0, 0, 1).error));
    assert_true(isinf(lrcsi_outline_margin_make(&o, a, a, 1, 0, 1).error));
    o.known = 0;
    assert_true(isinf(lrcsi_outline_areas_make(&o, a, b, 1).loss));
    assert_true(isinf(lrcsi_outline_margin_make(&o, a, b, 1, 0, 1).error));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(areas_bound_what_lies_between_both_outlines),
        cmocka_unit_test(areas_beside_circles_are_those_of_their_segments),
        cmocka_unit_test(a_shape_is_in_front_of_the_plane_that_it_stands_on),
        cmocka_unit_test(tubes_and_flat_parts_have_no_outline),
        cmocka_unit_test(boxes_and_plates_have_exact_outlines),
        cmocka_unit_test(nothing_is_known_along_edges_without_length_side_or_outline),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
