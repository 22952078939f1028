/* SPDX-License-Identifier: MIT */
/* The margins along the event edges of a ball, or a box, in front of the straight wall of a
   cylinder, cone or frustum: their signed area against the circle of the true ball, and the
   polygon of the box; and that no margin is known where one of the conditions of wall_margin.c does
   not hold. */
#include "visibility/proximity/proximity_band.h"

#include "mesh/shape/revolution.h"
#include "mesh/shape/tessellate.h"
#include "recipe.h"

static lrcs_scene scene;
static lrcs_work work;
static lrcsi_view view;
static lrcsi_classification classification;
static lrcsi_event_bands bands; /* for the event edges of the ball */
static lrcsi_proximity_band band;

enum { WALL, BALL };

static lrcs_recipe_material paint = {.name = "paint", .brdf = {0, 1, 1, 0}};
static const lrcs_shape cylinder = {.kind = LRCS_SHAPE_CYLINDER, .radius = 1, .length = 3};
static const lrcs_shape cone = {.kind = LRCS_SHAPE_CONE, .radius = 1.5, .length = 4};
static const lrcs_shape frustum = {
    .kind = LRCS_SHAPE_FRUSTUM, .radius = 1.2, .radius2 = 0.8, .length = 3};

static lrcs_recipe_part part_at(lrcs_shape shape, double x, double y, double z)
{
    lrcs_recipe_part part = {.name = "", .material = "paint", .shape = shape};
    part.place = lrcs_place_default();
    part.place.translate[0] = x;
    part.place.translate[1] = y;
    part.place.translate[2] = z;
    return part;
}

static lrcs_recipe_part ball_at(double radius, double x, double y, double z)
{
    return part_at((lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = radius}, x, y, z);
}

/* The band of a scene of parts, divided for this tolerance, as far as so many steps lead. */
static void find_margins_within(lrcs_recipe_part *part, uint32_t count, double tolerance,
                                const double d[3], uint64_t steps)
{
    const lrcs_recipe recipe = {
        .part = part, .part_count = count, .material = &paint, .material_count = 1};
    const lrcs_build_options build = {tolerance, 1u << 16, LRCS_NORMALS_FLAT, 0, 0, NULL};
    const lrcs_prepared *prepared = recipe_prepare(&recipe, NULL, &build, &scene, &work);
    lrcsi_meter meter = {.limit = steps};
    lrcs_pose pose;
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    assert_int_equal(lrcsi_classify_make(&view, NULL, &work, &classification), LRCS_OK);
    assert_int_equal(lrcsi_event_bands_make(&view, NULL, &work, &bands), LRCS_OK);
    assert_int_equal(lrcsi_proximity_band_make(&classification, &meter, &work, &band), LRCS_OK);
}

static void find_margins(lrcs_recipe_part *part, uint32_t count, double tolerance,
                         const double d[3])
{
    find_margins_within(part, count, tolerance, d, UINT64_MAX);
}

/* The sums over the facets of the wall; gain and loss as areas in projection. */
typedef struct wall_sums {
    double area, size, loose, gain, loss, all_gain, all_loss;
    int facets; /* with margins */
} wall_sums;

static wall_sums sum_of_wall(void)
{
    wall_sums sum = {.area = 0};
    for (uint32_t f = 0; f < scene.facet_count; f++) {
        const lrcsi_wall_margin *margin = &band.margin[f];
        const double projected = lrcsi_view_projected(&view, f);
        if (scene.facet_part[f] == WALL && view.facing[f] > 0) {
            sum.area += margin->area;
            sum.size += margin->area_max;
            sum.loose += margin->area_err;
            sum.gain += margin->gain * projected;
            sum.loss += margin->loss * projected;
            sum.all_gain += band.gain[f] * projected;
            sum.all_loss += band.loss[f] * projected;
            sum.facets += margin->area_max > 0;
        }
    }
    return sum;
}

/* The area between the polygon that the ball's event edges form and the outline of the true ball,
   which encloses this area, m^2. */
static double polygon_beyond_outline(double area)
{
    double twice = 0;
    const double zero[3] = {0, 0, 0};
    double centre[3];
    lrcsi_view_coordinates(&view, zero, centre);
    for (uint32_t i = 0; i < bands.events.count; i++) {
        if (bands.events.part[i] == BALL) {
            const lrcsi_edge *edge = &view.prepared->topology.edge[bands.events.edge[i]];
            const double *a = view.point[edge->low].x;
            const double *b = view.point[edge->high].x;
            twice += bands.events.side[i] * ((a[0] - centre[0]) * (b[1] - centre[1]) -
                                             (a[1] - centre[1]) * (b[0] - centre[0]));
        }
    }
    return 0.5 * twice - ldexp(area, -2 * view.prepared->exponent);
}

static double polygon_beyond_circle(double radius)
{
    return polygon_beyond_outline(LRCS_PI * radius * radius);
}

/* --- what a ball hides of a true wall ---------------------------------------------------------- */

/* A wall around z from z = 0, and a ball in front of it, m; d is a unit vector. */
typedef struct ball_shadow {
    double base, slope, height; /* the wall's radius is base + slope z */
    double centre[3], radius, d[3];
} ball_shadow;

/* The interval of z in which the ball hides the ruling at this azimuth: where its points are nearer
   than the radius to the line along d through the centre. Returns 0 if there is none. */
static int hidden_interval(const ball_shadow *w, double azimuth, double z[2])
{
    const double from[3] = {w->base * cos(azimuth) - w->centre[0],
                            w->base * sin(azimuth) - w->centre[1], -w->centre[2]};
    const double step[3] = {w->slope * cos(azimuth), w->slope * sin(azimuth), 1};
    const double from_d = from[0] * w->d[0] + from[1] * w->d[1] + from[2] * w->d[2];
    const double step_d = step[0] * w->d[0] + step[1] * w->d[1] + step[2] * w->d[2];
    double a = -step_d * step_d;
    double b = -from_d * step_d;
    double c = -from_d * from_d - w->radius * w->radius;
    for (int k = 0; k < 3; k++) {
        a += step[k] * step[k];
        b += from[k] * step[k];
        c += from[k] * from[k];
    }
    const double root = b * b - a * c;
    if (!(root > 0)) {
        return 0;
    }
    z[0] = (-b - sqrt(root)) / a;
    z[1] = (-b + sqrt(root)) / a;
    assert_true(z[0] > 0 && z[1] < w->height);
    return 1;
}

/* The integral over v, from an end where the interval may vanish to another one, of the integral of
   the radius over the interval; by the rule of three points in 64 steps, in the square root of the
   distance from the end. */
static double hidden_of_sector(const ball_shadow *w, double middle, double half, double end,
                               double to)
{
    static const double at[3] = {0.11270166537925831, 0.5, 0.88729833462074169};
    static const double weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    double sum = 0;
    for (int i = 0; i < 64; i++) {
        for (int k = 0; k < 3; k++) {
            const double t = (i + at[k]) / 64;
            double z[2];
            if (hidden_interval(w, middle + half * (end + t * t * (to - end)), z)) {
                sum += weight[k] / 64 * 2 * t * fabs(to - end) *
                       (w->base * (z[1] - z[0]) + w->slope * (z[1] * z[1] - z[0] * z[0]) / 2);
            }
        }
    }
    return sum;
}

/* The area, in projection, of the points of the facets of the wall whose images on the true wall the
   ball hides, m^2: rho kappa (1, v tan h) is mapped to rho (cos vh, sin vh), at the same height. */
static double hidden_area(const ball_shadow *w)
{
    const lrcs_part *part = &scene.part[WALL];
    const lrcsi_revolution body = lrcsi_revolution_make(&part->shape, &part->divisions);
    const double kappa = body.vertex_ratio * cos(body.half);
    double area = 0;
    for (uint32_t i = 0; i < body.around; i++) {
        const double middle = (2.0 * i + 1.0) * body.half;
        const double facing =
            cos(middle) * w->d[0] + sin(middle) * w->d[1] - w->slope * kappa * w->d[2];
        double z[2];
        double low = -1;
        double high = 1;
        const int in[2] = {hidden_interval(w, middle - body.half, z),
                           hidden_interval(w, middle + body.half, z)};
        if (!(facing > 0) || (!in[0] && !in[1] && !hidden_interval(w, middle, z))) {
            continue;
        }
        assert_true(in[0] || in[1]);
        for (int k = 0; k < 60 && in[0] != in[1]; k++) {
            const double v = 0.5 * (low + high);
            const int inside = hidden_interval(w, middle + v * body.half, z);
            low = inside == in[0] ? v : low;
            high = inside == in[0] ? high : v;
        }
        const double of_v = !in[0]   ? hidden_of_sector(w, middle, body.half, low, 1)
                            : !in[1] ? hidden_of_sector(w, middle, body.half, high, -1)
                                     : hidden_of_sector(w, middle, body.half, -1, 0) +
                                           hidden_of_sector(w, middle, body.half, 0, 1);
        area += of_v * kappa * tan(body.half) * facing;
    }
    return area;
}

/* What the true ball and wall leave visible more than their facets, scaled: the facets hide what is
   inside the polygon. */
static double more_visible(const lrcs_shape *wall, const double centre[3], double radius,
                           const double d[3])
{
    const int is_frustum = wall->kind == LRCS_SHAPE_FRUSTUM; /* radius2 is that at z = 0 */
    const double base = is_frustum ? wall->radius2 : wall->radius;
    const double top = wall->kind == LRCS_SHAPE_CONE ? 0 : wall->radius;
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    ball_shadow w = {.base = base,
                     .slope = (top - base) / wall->length,
                     .height = wall->length,
                     .radius = radius};
    for (int k = 0; k < 3; k++) {
        w.centre[k] = centre[k];
        w.d[k] = d[k] / length;
    }
    return polygon_beyond_circle(radius) +
           ldexp(LRCS_PI * radius * radius - hidden_area(&w), -2 * view.prepared->exponent);
}

static void margins_of_a_ball_in_front_of_a_wall_have_their_sign(void **state)
{
    (void)state;
    const lrcs_shape *const walls[3] = {&cylinder, &cone, &frustum};
    static const double from[3][3] = {{1, 0.02, 0.1}, {1, 0.2, -0.3}, {1, -0.1, 0.5}};
    for (int i = 0; i < 9; i++) {
        const double *d = from[i / 3];
        const double tolerance = i % 2 ? 1e-3 : 1e-4;
        lrcs_recipe_part part[2] = {part_at(*walls[i % 3], 0, 0, 0),
                                    ball_at(0.3, 2, 2 * d[1], 1.2 + 2 * d[2])};
        find_margins(part, 2, tolerance, d);
        const wall_sums sum = sum_of_wall();
        assert_true(sum.facets > 4);
        const double want = more_visible(walls[i % 3], part[BALL].place.translate, 0.3, d);
        const double other = sum.gain + sum.loss; /* edges of which no margin is known */
        check_abs(sum.area, want, sum.loose + other);
        check_abs(sum.area, want, 1.5e-3 * fabs(want) + other);
        check_most(fabs(sum.area), sum.size);
        check_most(sum.loose, 0.75 * (sum.all_gain + sum.all_loss));
        check_most(other, 0.1 * (sum.all_gain + sum.all_loss));
    }
}

/* A ball that pierces the wall inside its own outline, behind which a plane along its far side
   separates it from the wall. */
static void margins_of_a_ball_that_pierces_a_wall(void **state)
{
    (void)state;
    static const double from[2][3] = {{1, 0.02, 0.1}, {1, 0.1, -0.2}};
    for (int i = 0; i < 4; i++) {
        const double *d = from[i / 2];
        lrcs_recipe_part part[2] = {part_at(cylinder, 0, 0, 0), ball_at(0.3, 1.1, 0, 1.5)};
        find_margins(part, 2, i % 2 ? 1e-3 : 1e-4, d);
        const wall_sums sum = sum_of_wall();
        const double want = more_visible(&cylinder, part[BALL].place.translate, 0.3, d);
        assert_true(sum.facets > 4);
        check_abs(sum.area, want, sum.loose + sum.gain + sum.loss);
        if (i % 2 == 0) { /* finer facets: nearly all of the outline has margins */
            check_abs(sum.area, want, 0.01 * fabs(want));
            check_most(sum.gain + sum.loss, 0.001 * (sum.all_gain + sum.all_loss));
        }
    }
}

/* A tank with its flat base, which stands before the middle of a wall or on the same plane, seen
   exactly edge-on to the base: its outline is a half circle, and all of it has margins but for
   edges at its corners. */
static void margins_of_a_tank_seen_edge_on_to_its_base(void **state)
{
    (void)state;
    const double d[3] = {1, 0.1, 0};
    const lrcs_shape tank = {.kind = LRCS_SHAPE_DOME, .radius = 0.5};
    for (int i = 0; i < 4; i++) {
        lrcs_recipe_part part[2] = {part_at(cylinder, 0, 0, 0), part_at(tank, 2, 0.2, i % 2)};
        find_margins(part, 2, i < 2 ? 1e-3 : 1e-4, d);
        const wall_sums sum = sum_of_wall();
        const double want = polygon_beyond_outline(0.5 * LRCS_PI * 0.25);
        const double other = sum.gain + sum.loss;
        assert_true(sum.facets > 4);
        check_abs(sum.area, want, sum.loose + other);
        check_most(other, 0.2 * (sum.all_gain + sum.all_loss));
    }
}

/* The back of a closed wall is never seen, also where its material is two-sided and an open part
   keeps the scene from being solid: no margin counts twice. */
static void two_sided_walls_have_the_same_margins(void **state)
{
    (void)state;
    const double d[3] = {1, 0.02, 0.1};
    const lrcs_shape bowl = {.kind = LRCS_SHAPE_DOME, .radius = 0.1, .parts = LRCS_SHAPE_WALL};
    wall_sums sum[2];
    for (int two_sided = 0; two_sided < 2; two_sided++) {
        lrcs_recipe_part part[3] = {part_at(cylinder, 0, 0, 0), ball_at(0.3, 2, 0.04, 1.4),
                                    part_at(bowl, 0, 0, 9)};
        paint.two_sided = two_sided;
        find_margins(part, 3, 1e-3, d);
        sum[two_sided] = sum_of_wall();
    }
    paint.two_sided = 0;
    assert_true(sum[0].facets > 4 && sum[0].area != 0);
    check_abs(sum[1].area, sum[0].area, 1e-9 * fabs(sum[0].area));
    check_abs(sum[1].size, sum[0].size, 1e-9 * sum[0].size);
}

/* (a): where the outline of the ball crosses the limb of the wall, its edges there have bands. */
static void edges_across_the_limb_have_bands(void **state)
{
    (void)state;
    const double d[3] = {1, 0, 0};
    lrcs_recipe_part part[2] = {part_at(cylinder, 0, 0, 0), ball_at(0.3, 2, 0.9, 1.5)};
    find_margins(part, 2, 1e-3, d);
    const wall_sums sum = sum_of_wall();
    assert_true(sum.facets > 4 && sum.gain + sum.loss > 1e-3 * (sum.all_gain + sum.all_loss));
    for (uint32_t f = 0; f < scene.facet_count; f++) {
        double beside = 0; /* the largest |y| of its corners */
        for (int k = 0; k < 3; k++) {
            beside = fmax(beside, fabs(lrcsi_prepared_corner(view.prepared, f, k)[1]));
        }
        if (scene.facet_part[f] == WALL && ldexp(beside, view.prepared->exponent) > 0.9999) {
            assert_true(band.margin[f].area_max == 0);
        }
    }
}

/* (c): a second ball whose outline crosses that of the first one; (b): a ball whose outline is behind
   the wall. */
static void no_margin_is_known_without_the_conditions(void **state)
{
    (void)state;
    const double d[3] = {1, 0.1, 0.2};
    lrcs_recipe_part two[3] = {part_at(cylinder, 0, 0, 0), ball_at(0.3, 2, 0.2, 1.6),
                               ball_at(0.3, 2, 0.5, 1.6)};
    find_margins(two, 3, 1e-3, d);
    wall_sums sum = sum_of_wall();
    assert_true(sum.facets > 4 && sum.gain + sum.loss > 1e-3 * (sum.all_gain + sum.all_loss));
    lrcs_recipe_part meeting[2] = {part_at(cylinder, 0, 0, 0), ball_at(0.3, 0.8, 0, 1.5)};
    find_margins(meeting, 2, 1e-3, d);
    sum = sum_of_wall();
    assert_true(sum.facets == 0 && sum.all_gain > 0);
    check_most(sum.all_gain + sum.all_loss, (sum.gain + sum.loss) * (1 + 1e-6));
}

/* (f): behind a plate that hides all of the ball, nothing of the wall is gained or lost. */
static void hidden_margins_add_nothing(void **state)
{
    (void)state;
    const double d[3] = {1, 0, 0};
    const lrcs_shape plate = {.kind = LRCS_SHAPE_BOX, .size = {0.1, 20, 20}};
    lrcs_recipe_part part[3] = {part_at(cylinder, 0, 0, 0), ball_at(0.3, 2, 0, 1.5),
                                part_at(plate, 4, 0, -5)};
    find_margins(part, 3, 1e-3, d);
    const wall_sums sum = sum_of_wall();
    assert_true(sum.facets == 0 && sum.area == 0 && sum.loose == 0);
}

/* Whatever the number of steps: where a margin is not known, its bands are. */
static void without_steps_there_are_bands(void **state)
{
    (void)state;
    const double d[3] = {1, 0.02, 0.1};
    lrcs_recipe_part part[2] = {part_at(cylinder, 0, 0, 0), ball_at(0.3, 2, 0.04, 1.4)};
    int with = 0;
    int without = 0;
    for (uint64_t steps = 16; steps < 1u << 20; steps *= 2) {
        find_margins_within(part, 2, 1e-2, d, steps);
        const wall_sums sum = sum_of_wall();
        const double all = sum.all_gain + sum.all_loss;
        const int known = sum.facets > 0;
        assert_true(isfinite(all) && all > 0);
        assert_true(known || sum.gain + sum.loss > 0.5 * all);
        with += known;
        without += !known;
    }
    assert_true(with > 0 && without > 0);
}

/* --- what a box hides of a true wall ----------------------------------------------------------- */

/* Half-planes of the view plane, normal . x <= level, that contain the projection of a convex body
   exactly: through two of its corners, with all others on one side. */
typedef struct view_polygon {
    double normal[16][2], level[16];
    int count;
} view_polygon;

static view_polygon polygon_around(uint32_t part)
{
    const lrcs_part *box = &scene.part[part];
    view_polygon polygon = {.count = 0};
    const double *corner[36];
    int corners = 0;
    for (uint32_t f = box->first_facet; f < box->first_facet + box->facet_count; f++) {
        for (int k = 0; k < 3; k++) {
            corner[corners++] = view.point[scene.facet[f].corner[k]].x;
        }
    }
    for (int i = 0; i < corners; i++) {
        for (int j = 0; j < corners; j++) {
            const double n[2] = {corner[j][1] - corner[i][1], corner[i][0] - corner[j][0]};
            const double size = hypot(n[0], n[1]);
            int outside = !(size > 1e-9);
            for (int k = 0; k < corners && !outside; k++) {
                outside =
                    n[0] * (corner[k][0] - corner[i][0]) + n[1] * (corner[k][1] - corner[i][1]) >
                    1e-12 * size;
            }
            int known = outside;
            for (int k = 0; k < polygon.count && !known; k++) {
                known =
                    fabs(polygon.normal[k][0] * n[1] - polygon.normal[k][1] * n[0]) < 1e-9 * size &&
                    polygon.normal[k][0] * n[0] + polygon.normal[k][1] * n[1] > 0;
            }
            if (!known) {
                polygon.normal[polygon.count][0] = n[0] / size;
                polygon.normal[polygon.count][1] = n[1] / size;
                polygon.level[polygon.count++] = (n[0] * corner[i][0] + n[1] * corner[i][1]) / size;
            }
        }
    }
    return polygon;
}

/* The integral of the radius over the heights at which a line over z is in the polygons in
   projection, m^2: from `low` at z = 0 to `high` at the top. */
static double radius_in_polygon(const view_polygon *polygon, const double low[3],
                                const double high[3], const lrcs_shape *wall, double base,
                                double slope)
{
    double a[3];
    double b[3];
    double from = 0;
    double to = 1;
    lrcsi_view_coordinates(&view, low, a);
    lrcsi_view_coordinates(&view, high, b);
    for (int k = 0; k < polygon->count; k++) {
        const double *n = polygon->normal[k];
        const double over_a = n[0] * a[0] + n[1] * a[1] - polygon->level[k];
        const double over_b = n[0] * b[0] + n[1] * b[1] - polygon->level[k];
        if (over_a > 0 && over_b > 0) {
            return 0;
        }
        if (over_a > 0) {
            from = fmax(from, over_a / (over_a - over_b));
        } else if (over_b > 0) {
            to = fmin(to, over_a / (over_a - over_b));
        }
    }
    const double z[2] = {from * wall->length, to * wall->length};
    return from < to ? base * (z[1] - z[0]) + slope * (z[1] * z[1] - z[0] * z[0]) / 2 : 0;
}

/* What true wall leaves visible more than its facets behind boxes, all in front of it, scaled: y and
   x as in hidden_area, by the rule of the middle point in 4,000 steps of each sector. */
static double more_visible_behind(const lrcs_shape *wall, uint32_t box)
{
    enum { STEPS = 4000 };
    const lrcs_part *part = &scene.part[WALL];
    const lrcsi_revolution body = lrcsi_revolution_make(&part->shape, &part->divisions);
    const view_polygon polygon = polygon_around(box);
    const double kappa = body.vertex_ratio * cos(body.half);
    const double unit = ldexp(1, -view.prepared->exponent);
    const double base = wall->kind == LRCS_SHAPE_FRUSTUM ? wall->radius2 : wall->radius;
    const double top = wall->kind == LRCS_SHAPE_CONE ? 0 : wall->radius;
    const double slope = (top - base) / wall->length;
    double more = 0;
    for (uint32_t i = 0; i < body.around; i++) {
        const double middle = (2.0 * i + 1.0) * body.half;
        const double r[2] = {cos(middle), sin(middle)};
        const double facing =
            r[0] * view.unit[0] + r[1] * view.unit[1] - slope * kappa * view.unit[2];
        for (int k = 0; k < STEPS && facing > 0; k++) {
            const double v = 2 * (k + 0.5) / STEPS - 1;
            const double y[2] = {kappa, kappa * v * tan(body.half)};
            const double x[2] = {cos(v * body.half), sin(v * body.half)};
            double hidden[2];
            for (int of = 0; of < 2; of++) {
                const double *at = of == 0 ? y : x;
                const double across[2] = {at[0] * r[0] - at[1] * r[1], at[0] * r[1] + at[1] * r[0]};
                const double low[3] = {unit * base * across[0], unit * base * across[1], 0};
                const double high[3] = {unit * top * across[0], unit * top * across[1],
                                        unit * wall->length};
                hidden[of] = radius_in_polygon(&polygon, low, high, wall, base, slope);
            }
            more += (hidden[0] - hidden[1]) * (2.0 / STEPS) * kappa * tan(body.half) * facing;
        }
    }
    return more * unit * unit;
}

/* A bar across the wall, turned about x so that no edge is along the wall's facets: the displacement
   of the wall's points alone decides. What is near the bar's corners has bands. */
static const double turned[3][3] = {{1, 0, 0}, {0, 0.8, -0.6}, {0, 0.6, 0.8}};

static void margins_of_a_box_in_front_of_a_wall(void **state)
{
    (void)state;
    const lrcs_shape *const walls[3] = {&cylinder, &cone, &frustum};
    const lrcs_shape bar = {.kind = LRCS_SHAPE_BOX, .size = {0.1, 0.9, 0.3}};
    static const double from[2][3] = {{1, 0.02, 0.1}, {1, -0.2, 0.15}};
    for (int i = 0; i < 6; i++) {
        const double *d = from[i / 3];
        lrcs_recipe_part part[2] = {part_at(*walls[i % 3], 0, 0, 0),
                                    part_at(bar, 2, 2 * d[1], 1.1 + 2 * d[2])};
        memcpy(part[1].place.rotate, turned, sizeof turned);
        find_margins(part, 2, 1e-4, d);
        const wall_sums sum = sum_of_wall();
        const double want = more_visible_behind(walls[i % 3], 1);
        const double other = sum.gain + sum.loss;
        print_message("# %d: %g, want %g +- %g + %g of %g\n", i, sum.area, want, sum.loose, other,
                      sum.all_gain + sum.all_loss);
        assert_true(sum.facets > 4);
        check_abs(sum.area, want, sum.loose + other);
        check_most(sum.loose, 0.2 * (sum.all_gain + sum.all_loss));
        check_most(other, 0.2 * (sum.all_gain + sum.all_loss));
    }
}

/* A strip before the bar, across it: the bar's edges are visible on either side of the strip's
   shadow, and their margins are known there. */
static void margins_on_both_sides_of_another_shadow(void **state)
{
    (void)state;
    const double d[3] = {1, 0.02, 0.1};
    const lrcs_shape bar = {.kind = LRCS_SHAPE_BOX, .size = {0.1, 0.9, 0.2}};
    const lrcs_shape strip = {.kind = LRCS_SHAPE_BOX, .size = {0.1, 0.1, 0.9}};
    lrcs_recipe_part part[3] = {part_at(cylinder, 0, 0, 0), part_at(bar, 2, 0.04, 1.5),
                                part_at(strip, 4, 0.08, 1.7)};
    memcpy(part[1].place.rotate, turned, sizeof turned);
    memcpy(part[2].place.rotate, turned, sizeof turned);
    find_margins(part, 3, 1e-4, d);
    const wall_sums sum = sum_of_wall();
    int sides[2] = {0, 0}; /* facets with margins on either side of the strip's shadow */
    for (uint32_t f = 0; f < scene.facet_count; f++) {
        const double y =
            ldexp(lrcsi_prepared_corner(view.prepared, f, 0)[1], view.prepared->exponent);
        if (scene.facet_part[f] == WALL && band.margin[f].area_max > 0 && fabs(y) > 0.1) {
            sides[y > 0]++;
        }
    }
    assert_true(sides[0] > 4 && sides[1] > 4);
    check_most(sum.gain + sum.loss, 0.2 * (sum.all_gain + sum.all_loss));
}

/* --- the shadow of an edge that is exact ------------------------------------------------------ */

/* A point of the body frame, m, where the plane x = 6 is met along d, in the coordinates of an edge
   through (6, 0, 1.5): [0] along it, [1] into the plate. */
static void edge_coordinates(const double x[3], const double d[3], double tilt, double at[2])
{
    const double t = (6 - x[0]) / d[0];
    const double y = x[1] + t * d[1];
    const double z = x[2] + t * d[2] - 1.5;
    at[0] = -sin(tilt) * y + cos(tilt) * z;
    at[1] = cos(tilt) * y + sin(tilt) * z;
}

/* The point of the true wall that a point of a facet stands for: on a cylinder or cone around z. */
static void true_point(uint32_t facet, const double y[3], double x[3])
{
    const lrcs_part *part = &scene.part[WALL];
    const lrcsi_revolution body = lrcsi_revolution_make(&part->shape, &part->divisions);
    lrcsi_wall_patch at;
    assert_true(lrcsi_tessellate_patch(&part->shape, &part->divisions, facet, &at));
    const double middle = (2.0 * at.sector + 1.0) * body.half;
    const double radial = cos(middle) * y[0] + sin(middle) * y[1];
    const double around = cos(middle) * y[1] - sin(middle) * y[0];
    const double radius = radial / (body.vertex_ratio * cos(body.half));
    const double angle = middle + around / (radial * tan(body.half)) * body.half;
    x[0] = radius * cos(angle);
    x[1] = radius * sin(angle);
    x[2] = y[2];
}

/* Adds what of a facet is gained and lost to first order: the displacement of x from y across the
   edge, where the edge's shadow crosses the facet; and what its bands say. Areas in the plane of
   the plate. */
static void add_displaced(uint32_t facet, const double d[3], double tilt, double found[2],
                          double bands_of[2])
{
    enum { POINTS = 40 };
    double corner[3][3];
    double at[3][2];
    double end[2][3];
    double end_at[2][2];
    int ends = 0;
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++) {
            corner[k][i] =
                ldexp(lrcsi_prepared_corner(view.prepared, facet, k)[i], view.prepared->exponent);
        }
        edge_coordinates(corner[k], d, tilt, at[k]);
    }
    const double area = 0.5 * fabs((at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) -
                                   (at[1][1] - at[0][1]) * (at[2][0] - at[0][0]));
    for (int k = 0; k < 3; k++) {
        const int n = (k + 1) % 3;
        if ((at[k][1] > 0) != (at[n][1] > 0)) {
            const double t = at[k][1] / (at[k][1] - at[n][1]);
            for (int i = 0; i < 3; i++) {
                end[ends][i] = corner[k][i] + t * (corner[n][i] - corner[k][i]);
            }
            edge_coordinates(end[ends], d, tilt, end_at[ends]);
            ends++;
        }
    }
    bands_of[0] += band.gain[facet] * area;
    bands_of[1] += band.loss[facet] * area;
    double sum[2] = {0, 0};
    for (int j = 0; j < POINTS && ends == 2; j++) {
        double y[3];
        double x[3];
        double displaced[2];
        for (int i = 0; i < 3; i++) {
            y[i] = end[0][i] + (j + 0.5) / POINTS * (end[1][i] - end[0][i]);
        }
        true_point(facet, y, x);
        edge_coordinates(x, d, tilt, displaced);
        const double length = fabs(end_at[1][0] - end_at[0][0]) / POINTS;
        sum[0] += length * fmax(0, -displaced[1]); /* y is hidden, x visible */
        sum[1] += length * fmax(0, displaced[1]);
    }
    for (int i = 0; i < 2; i++) {
        const double fraction = i == 0 ? band.gain[facet] : band.loss[facet];
        check_most(0.9 * sum[i], fraction * area);
        found[i] += sum[i];
    }
}

/* Half of a sector's points are displaced outward, by at most half as much as the others inward.
   Without their signs both fractions were at least five times what is displaced. */
static void bands_below_an_exact_edge_are_where_points_are_displaced(void **state)
{
    (void)state;
    const double d[3] = {1, 0.05, 0.1};
    const lrcs_shape plate = {.kind = LRCS_SHAPE_PLATE, .size = {40, 40, 0}};
    const lrcs_shape *const walls[2] = {&cylinder, &cone};
    static const double tilts[4] = {1.5707963267948966, 1.2, 0.7, 2.6};
    for (int i = 0; i < 8; i++) {
        const double tilt = tilts[i / 2]; /* from y; the plate is on the side of higher z */
        lrcs_recipe_part part[2] = {part_at(*walls[i % 2], 0, 0, 0),
                                    part_at(plate, 6, 20 * cos(tilt), 1.5 + 20 * sin(tilt))};
        const double turn[3][3] = {
            {0, 0, 1}, {cos(tilt), -sin(tilt), 0}, {sin(tilt), cos(tilt), 0}};
        memcpy(part[1].place.rotate, turn, sizeof turn);
        find_margins(part, 2, 1e-4, d);
        double found[2] = {0, 0};
        double bands_of[2] = {0, 0};
        for (uint32_t f = 0; f < scene.facet_count; f++) {
            if (scene.facet_part[f] == WALL && scene.facet_smooth[f] && view.facing[f] > 0 &&
                lrcsi_view_incidence(&view, f).cos_theta > 0.1) {
                add_displaced(f, d, tilt, found, bands_of);
            }
        }
        print_message("# %d: gained %g of %g, lost %g of %g\n", i, found[0], bands_of[0], found[1],
                      bands_of[1]);
        assert_true(found[0] > 0 && found[1] > 0);
        check_most(bands_of[0], 3.5 * found[0]);
        check_most(bands_of[1], 3.5 * found[1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(margins_of_a_ball_in_front_of_a_wall_have_their_sign),
        cmocka_unit_test(margins_of_a_ball_that_pierces_a_wall),
        cmocka_unit_test(margins_of_a_tank_seen_edge_on_to_its_base),
        cmocka_unit_test(margins_of_a_box_in_front_of_a_wall),
        cmocka_unit_test(margins_on_both_sides_of_another_shadow),
        cmocka_unit_test(two_sided_walls_have_the_same_margins),
        cmocka_unit_test(edges_across_the_limb_have_bands),
        cmocka_unit_test(no_margin_is_known_without_the_conditions),
        cmocka_unit_test(hidden_margins_add_nothing),
        cmocka_unit_test(without_steps_there_are_bands),
        cmocka_unit_test(bands_below_an_exact_edge_are_where_points_are_displaced),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
