/* SPDX-License-Identifier: MIT */
/* The slack between flat and round parts. The rows of facets on straight walls: whatever the shape,
   and mirrored, they run across the axis. Which facets are within the slack,
   and what of them is near a contact. */
#include "scene/proximity.h"

#include <string.h>

#include "base/range.h"
#include "base/vec3.h"
#include "check.h"
#include "inside.h"
#include "mesh/box.h"
#include "mesh/shape/revolution.h"
#include "scene/prepare.h"

static unsigned char scene_area[1u << 22];
static unsigned char prepare_area[1u << 24];

static const lrcs_prepared *prepare_recipe(const lrcs_recipe *recipe, double tolerance,
                                           uint32_t facets)
{
    static lrcs_scene scene;
    const lrcs_build_options options = {tolerance, facets, LRCS_NORMALS_FLAT, 1, 0, NULL};
    lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
    const lrcs_prepared *prepared = NULL;
    assert_int_equal(lrcs_scene_build(recipe, NULL, &options, &work, &scene, NULL), LRCS_OK);
    work = lrcs_work_make(prepare_area, sizeof prepare_area);
    assert_int_equal(lrcs_prepare_run(&scene, &work, &prepared), LRCS_OK);
    return prepared;
}

static const lrcs_prepared *prepare_shape(const lrcs_shape *shape, double mirror)
{
    lrcs_recipe_part part = {.name = "", .shape = *shape, .place = lrcs_place_default()};
    part.place.scale[0] = mirror;
    part.material_index = -1;
    const lrcs_recipe recipe = {.part = &part, .part_count = 1};
    return prepare_recipe(&recipe, 1e-3, 1000);
}

/* A ball, a box, a plate, and half a ball that is open. */
static void the_slack_of_two_parts_is_what_both_may_differ_by(void **state)
{
    (void)state;
    enum { BALL, BOX, PLATE, BOWL, PARTS };
    lrcs_recipe_part part[PARTS];
    for (int i = 0; i < PARTS; i++) {
        part[i] = (lrcs_recipe_part){.name = "", .place = lrcs_place_default()};
        part[i].material_index = -1;
        part[i].place.translate[0] = 3 * i;
    }
    part[BALL].shape = (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 1};
    part[BOX].shape = (lrcs_shape){.kind = LRCS_SHAPE_BOX, .size = {1, 1, 1}};
    part[PLATE].shape = (lrcs_shape){.kind = LRCS_SHAPE_PLATE, .size = {1, 1}};
    part[BOWL].shape =
        (lrcs_shape){.kind = LRCS_SHAPE_DOME, .radius = 0.5, .parts = LRCS_SHAPE_WALL};
    const lrcs_recipe recipe = {.part = part, .part_count = PARTS};
    const lrcs_prepared *p = prepare_recipe(&recipe, 1e-2, 1000);
    const double ball = ldexp(p->scene->part[BALL].bounds.hausdorff, -p->exponent);
    const double bowl = ldexp(p->scene->part[BOWL].bounds.hausdorff, -p->exponent);
    const double most = 1 + 1e-6;
    assert_true(ball > 0 && bowl > 0);
    check_same(lrcsi_proximity_slack(p, BOX, PLATE), 0);
    check_same(lrcsi_proximity_slack_across(p, BOX, PLATE, 1), 0);
    const double slack = lrcsi_proximity_slack(p, BOX, BALL);
    check_most(ball, slack);
    check_most(slack, most * ball);
    check_most(ball + p->proximity.reach[BALL], lrcsi_proximity_slack(p, BALL, BALL));
    check_most(2 * bowl, lrcsi_proximity_slack(p, BOX, BOWL)); /* open: it counts twice */
    /* across: what it moves by sideways, but never more than the slack; all of it if open */
    const double whole = lrcsi_proximity_slack(p, BALL, BALL);
    const double across = lrcsi_proximity_slack_across(p, BALL, BALL, 0.25 * ball);
    check_most(1.25 * ball, across);
    check_most(across, most * 1.25 * ball);
    check_same(lrcsi_proximity_slack_across(p, BALL, BALL, 2 * whole), whole);
    check_same(lrcsi_proximity_slack_across(p, BALL, BOWL, 0),
               lrcsi_proximity_slack(p, BALL, BOWL));
}

/* Between a quarter and half of the height are the rows of every facet there. */
static void rows_of_straight_walls_lie_across_the_axis(void **state)
{
    (void)state;
    static const lrcs_shape shape[] = {
        {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.5, .length = 2},
        {.kind = LRCS_SHAPE_CONE, .radius = 0.5, .length = 0.75},
        {.kind = LRCS_SHAPE_FRUSTUM, .radius = 0.25, .radius2 = 0.5, .length = 1},
        {.kind = LRCS_SHAPE_FRUSTUM, .radius = 0.75, .radius2 = 0.5, .length = 1}};
    static const double up[3] = {0, 0, 1};
    static const double down[3] = {0, 0, -1};
    static const double origin[3] = {0, 0, 0};
    for (int i = 0; i < 8; i++) {
        const lrcs_prepared *p = prepare_shape(&shape[i / 2], i % 2 ? -1 : 1);
        double length = ldexp(shape[i / 2].length, -p->exponent);
        uint32_t walls = 0;
        for (uint32_t f = 0; f < p->scene->facet_count; f++) {
            const double *const corner[3] = {lrcsi_prepared_corner(p, f, 0),
                                             lrcsi_prepared_corner(p, f, 1),
                                             lrcsi_prepared_corner(p, f, 2)};
            lrcsi_slice slice = lrcsi_slice_start(corner[0], corner[1], corner[2]);
            if (!lrcsi_proximity_has_rows(p, f)) { /* a facet of a cap */
                const lrcsi_row_range all = lrcsi_proximity_rows(p, f, corner, &slice);
                assert_true(all.low == 0 && all.high == 1);
                check_same(corner[0][2], corner[1][2]);
                continue;
            }
            lrcsi_slice_cut(&slice, up, origin, 0.5 * length);
            lrcsi_slice_cut(&slice, down, origin, -0.25 * length);
            const lrcsi_row_range rows = lrcsi_proximity_rows(p, f, corner, &slice);
            check_abs(rows.low, 0.25, 1e-9);
            check_abs(rows.high, 0.5, 1e-9);
            slice.count = 0;
            const lrcsi_row_range none = lrcsi_proximity_rows(p, f, corner, &slice);
            assert_true(none.low > none.high);
            walls++;
        }
        assert_true(walls >= 8);
    }
}

static void facets_of_round_shapes_have_no_rows(void **state)
{
    (void)state;
    static const int kind[] = {LRCS_SHAPE_SPHERE, LRCS_SHAPE_DOME, LRCS_SHAPE_PARABOLOID,
                               LRCS_SHAPE_DISC};
    for (int i = 0; i < 4; i++) {
        const lrcs_shape shape = {
            .kind = kind[i], .radius = 0.5, .length = kind[i] == LRCS_SHAPE_PARABOLOID ? 1 : 0};
        const lrcs_prepared *p = prepare_shape(&shape, 1);
        for (uint32_t f = 0; f < p->scene->facet_count; f++) {
            assert_false(lrcsi_proximity_has_rows(p, f));
        }
    }
}

/* The point of a triangle that is nearest to `from`. */
static void nearest_point(const double *const corner[3], const double from[3], double nearest[3])
{
    double n[3];
    double best = HUGE_VAL;
    int inside = 1;
    memcpy(nearest, corner[0], sizeof n);
    lrcsi_vec3_normal(corner[0], corner[1], corner[2], n);
    for (int i = 0; i < 3; i++) {
        const double *a = corner[i];
        double along[3];
        double to[3];
        double out[3];
        lrcsi_vec3_between(a, corner[(i + 1) % 3], along);
        lrcsi_vec3_between(a, from, to);
        lrcsi_vec3_cross(along, n, out);
        inside = inside && lrcsi_vec3_dot(out, to) <= 0;
        const double t =
            lrcsi_max(0, lrcsi_min(1, lrcsi_vec3_dot(to, along) / lrcsi_vec3_dot(along, along)));
        const double x[3] = {a[0] + t * along[0], a[1] + t * along[1], a[2] + t * along[2]};
        double gap[3];
        lrcsi_vec3_between(x, from, gap);
        if (lrcsi_vec3_dot(gap, gap) < best) {
            best = lrcsi_vec3_dot(gap, gap);
            memcpy(nearest, x, sizeof x);
        }
    }
    if (inside) {
        double to[3];
        lrcsi_vec3_between(corner[0], from, to);
        const double height = lrcsi_vec3_dot(n, to) / lrcsi_vec3_dot(n, n);
        for (int k = 0; k < 3; k++) {
            nearest[k] = from[k] - height * n[k];
        }
    }
}

/* An upper bound of the distance of two triangles: projections onto one and the other in turn. */
static double distance(const double *const a[3], const double *const b[3])
{
    double x[3];
    double y[3];
    double gap[3];
    memcpy(x, a[0], sizeof x);
    for (int i = 0; i < 30; i++) {
        nearest_point(b, x, y);
        nearest_point(a, y, x);
    }
    lrcsi_vec3_between(x, y, gap);
    return sqrt(lrcsi_vec3_dot(gap, gap));
}

/* Two drums whose ends intersect, and a ball between them: of the facets of their ends, long and
   narrow, most pass each other, but none that are within the slack may be missed; on walls, none
   that are within the Hausdorff distance, since points at the slack may be displaced sideways. */
static void all_facets_within_the_slack_are_pairs(void **state)
{
    (void)state;
    enum { PARTS = 3, FACETS = 1500 };
    static unsigned char is_pair[FACETS][FACETS];
    lrcs_recipe_part part[PARTS];
    for (int i = 0; i < PARTS; i++) {
        part[i] = (lrcs_recipe_part){.name = "", .place = lrcs_place_default()};
        part[i].material_index = -1;
    }
    part[0].shape = (lrcs_shape){.kind = LRCS_SHAPE_CYLINDER, .radius = 1, .length = 2};
    part[1].shape = (lrcs_shape){.kind = LRCS_SHAPE_CYLINDER, .radius = 0.8, .length = 1.5};
    static const double turned[3][3] = {{0.8, 0, 0.6}, {0.6, 0, -0.8}, {0, 1, 0}}; /* on its side */
    memcpy(part[1].place.rotate, turned, sizeof turned);
    part[1].place.translate[2] = 2.1;
    part[2].shape = (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 0.3};
    part[2].place.translate[2] = 2;
    const lrcs_recipe recipe = {.part = part, .part_count = PARTS};
    const lrcs_prepared *p = prepare_recipe(&recipe, 1e-3, 300);
    const lrcs_scene *scene = p->scene;
    int ends = 0;
    assert_in_range(scene->facet_count, 200, FACETS);
    memset(is_pair, 0, sizeof is_pair);
    for (size_t i = 0; i < p->proximity.count; i++) {
        is_pair[p->proximity.pair[i].facet][p->proximity.pair[i].other] = 1;
    }
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        const double *const a[3] = {lrcsi_prepared_corner(p, f, 0), lrcsi_prepared_corner(p, f, 1),
                                    lrcsi_prepared_corner(p, f, 2)};
        for (uint32_t g = 0; g < scene->facet_count; g++) {
            const double *const b[3] = {lrcsi_prepared_corner(p, g, 0),
                                        lrcsi_prepared_corner(p, g, 1),
                                        lrcsi_prepared_corner(p, g, 2)};
            const double slack =
                lrcsi_proximity_slack(p, scene->facet_part[f], scene->facet_part[g]);
            const lrcsi_box own = lrcsi_box_of(p->vertex, &scene->facet[f]);
            const lrcsi_box theirs = lrcsi_box_of(p->vertex, &scene->facet[g]);
            int apart = scene->facet_part[f] == scene->facet_part[g];
            for (int k = 0; k < 3; k++) {
                apart |= own.low[k] > theirs.high[k] + slack || theirs.low[k] > own.high[k] + slack;
            }
            const double least =
                scene->facet_smooth[f] ? p->proximity.hausdorff[scene->facet_part[g]] : slack;
            if (!apart && distance(a, b) < 0.999 * least) {
                assert_true(is_pair[f][g]);
                ends += !scene->facet_smooth[f] && !scene->facet_smooth[g];
            }
        }
    }
    assert_true(ends > 50);
}

/* The point of a cylinder about the z axis to which the map takes a point of a facet of its wall:
   y = rho kappa (1, v tan h), x = rho (cos vh, sin vh), radial and around; FORMULAS of
   mesh/shape/revolution_reach.c. */
static void map_to_wall(const lrcs_prepared *p, const lrcs_part *part, uint32_t facet,
                        const double y[3], double x[3])
{
    const lrcsi_revolution body = lrcsi_revolution_make(&part->shape, &part->divisions);
    const lrcsi_normal *n = &p->normal[facet];
    const double radial[2] = {n->high[0] / n->length, n->high[1] / n->length};
    const double radius = ldexp(part->shape.radius, -p->exponent);
    const double inner = radius * body.vertex_ratio * cos(body.half);
    const double v = (y[1] * radial[0] - y[0] * radial[1]) / (inner * tan(body.half));
    check_abs(y[0] * radial[0] + y[1] * radial[1], inner, 1e-12);
    x[0] = radius * (cos(v * body.half) * radial[0] - sin(v * body.half) * radial[1]);
    x[1] = radius * (cos(v * body.half) * radial[1] + sin(v * body.half) * radial[0]);
    x[2] = y[2];
}

/* A cylinder that another one, or a box, pierces at an angle: of each facet of its wall, the
   fraction of points in the facets of the other part that are in truth outside of it is at most
   what its pairs have behind the other's facets, and the reverse at most what they have in front.
   Sampled at 10,000 points of each facet with pairs, evenly distributed by multiples of two
   irrational numbers. */
static void contacts_change_no_more_than_the_fractions_of_pairs(void **state)
{
    (void)state;
    enum { WALL, OTHER, PARTS, SAMPLES = 10000 };
    static const double turned[3][3] = {{0.6, 0, 0.8}, {0, 1, 0}, {-0.8, 0, 0.6}};
    const lrcs_shape other[2] = {{.kind = LRCS_SHAPE_CYLINDER, .radius = 0.5, .length = 3},
                                 {.kind = LRCS_SHAPE_BOX, .size = {0.7, 0.8, 4}}};
    for (int k = 0; k < 2; k++) {
        lrcs_recipe_part part[PARTS];
        for (int i = 0; i < PARTS; i++) {
            part[i] = (lrcs_recipe_part){.name = "", .place = lrcs_place_default()};
            part[i].material_index = -1;
        }
        part[WALL].shape = (lrcs_shape){.kind = LRCS_SHAPE_CYLINDER, .radius = 1, .length = 4};
        part[OTHER].shape = other[k];
        part[OTHER].place.translate[2] = 1.7;
        part[OTHER].place.translate[1] = 0.1;
        memcpy(part[OTHER].place.rotate, turned, sizeof turned);
        const lrcs_recipe recipe = {.part = part, .part_count = PARTS};
        const lrcs_prepared *p = prepare_recipe(&recipe, 1e-2, 100);
        const lrcs_part *wall = &p->scene->part[WALL];
        double all[2][2] = {{0, 0}, {0, 0}}; /* behind, in front: sampled, and of the pairs */
        for (uint32_t f = wall->first_facet; f < wall->first_facet + wall->facet_count; f++) {
            double most[2] = {0, 0};
            int count[2] = {0, 0};
            for (size_t i = 0; i < p->proximity.count; i++) {
                const lrcsi_proximity_pair *pair = &p->proximity.pair[i];
                most[0] += pair->facet == f ? (double)pair->back_fraction : 0;
                most[1] += pair->facet == f ? (double)pair->front_fraction : 0;
            }
            const int samples = most[0] + most[1] > 0 ? SAMPLES : 500;
            for (int n = 0; n < samples && p->scene->facet_smooth[f] != 0; n++) {
                double a = fmod(0.5 + n * 0.7548776662466927, 1);
                double b = fmod(0.5 + n * 0.5698402909980532, 1);
                double y[3];
                double x[3];
                if (a + b > 1) {
                    a = 1 - a;
                    b = 1 - b;
                }
                for (int i = 0; i < 3; i++) {
                    y[i] = a * lrcsi_prepared_corner(p, f, 0)[i] +
                           b * lrcsi_prepared_corner(p, f, 1)[i] +
                           (1 - a - b) * lrcsi_prepared_corner(p, f, 2)[i];
                }
                map_to_wall(p, wall, f, y, x);
                const int in_facets = is_in_facets(p, &p->scene->part[OTHER], y);
                const int in_shape = is_in_shape(p, &p->scene->part[OTHER], x);
                count[0] += in_facets && !in_shape;
                count[1] += !in_facets && in_shape;
            }
            for (int i = 0; i < 2; i++) {
                const double sampled = (double)count[i] / samples;
                check_most(sampled, most[i] > 0 ? most[i] + 10.0 / SAMPLES : 0);
                all[i][0] += sampled;
                all[i][1] += most[i];
            }
        }
        for (int i = 0; i < 2; i++) { /* the bound is not much larger */
            check_most(all[i][1], 16 * all[i][0]);
            assert_true(all[i][0] > 0.001);
        }
    }
}

/* A ball above a plate, and another plate below that. A facet of the ball is near a plate if its
   lowest corner is within LRCSI_PROXIMITY_NEAR slacks of it. */
static void round_facets_know_which_parts_are_near(void **state)
{
    (void)state;
    enum { BALL, HIGH, LOW, PARTS };
    lrcs_recipe_part part[PARTS];
    for (int i = 0; i < PARTS; i++) {
        part[i] = (lrcs_recipe_part){.name = "", .place = lrcs_place_default()};
        part[i].material_index = -1;
        part[i].shape = (lrcs_shape){.kind = LRCS_SHAPE_PLATE, .size = {4, 4}};
    }
    part[BALL].shape = (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 0.5};
    part[BALL].place.translate[2] = 0.625;
    part[LOW].place.translate[2] = -0.25;
    const lrcs_recipe recipe = {.part = part, .part_count = PARTS};
    const lrcs_prepared *p = prepare_recipe(&recipe, 1e-3, 2000);
    int count[PARTS][2] = {{0}};
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        for (uint32_t k = HIGH; k <= LOW && p->scene->facet_part[f] == BALL; k++) {
            const double plate = lrcsi_prepared_corner(p, p->scene->part[k].first_facet, 0)[2];
            const double near = LRCSI_PROXIMITY_NEAR * lrcsi_proximity_slack(p, BALL, k);
            double lowest = HUGE_VAL;
            for (int i = 0; i < 3; i++) {
                lowest = fmin(lowest, lrcsi_prepared_corner(p, f, i)[2] - plate);
            }
            const int is_near = (p->proximity.near[f] & lrcsi_part_set_of(k)) != 0;
            assert_true(is_near ? lowest < near * (1 + 1e-6) : lowest > near * (1 - 1e-6));
            count[k][is_near]++;
        }
    }
    assert_true(count[HIGH][0] > 100 && count[HIGH][1] > 100);
    assert_true(count[LOW][0] > count[HIGH][0] && count[LOW][1] > 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_slack_of_two_parts_is_what_both_may_differ_by),
        cmocka_unit_test(rows_of_straight_walls_lie_across_the_axis),
        cmocka_unit_test(facets_of_round_shapes_have_no_rows),
        cmocka_unit_test(all_facets_within_the_slack_are_pairs),
        cmocka_unit_test(contacts_change_no_more_than_the_fractions_of_pairs),
        cmocka_unit_test(round_facets_know_which_parts_are_near),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
