/* SPDX-License-Identifier: MIT */
/* Open round shapes that reflect on both sides, seen so that the near rim hides a part of the
   inside. Truth: the inside is an integral over the disc of the opening, from each point of which a
   line leads to the wall; the outside is an integral over the wall. Nothing else hides anything.
   With two arguments, so many random bowls with other parts in and around them, from a seed:
   coarse and fine meshes must agree within their bounds. */
#include "integrate/wall/round_rim.h"

#include <lrcs/lrcs.h>

#include <stdlib.h>

#include "check.h"
#include "patch_scene.h"
#include "random.h"
#include "recipe.h"

#define PI     3.14159265358979323846
#define RADIUS 0.75

static double reflect(const lrcs_brdf *b, double cosine)
{
    double tan2 = (1 - cosine) * (1 + cosine) / (cosine * cosine);
    double glint = b->A / (cosine * cosine * cosine * cosine) * exp(-tan2 / (b->s * b->s));
    return glint + b->B * pow(cosine, b->m + 2); /* f_r cos^2 */
}

/* Half the gradient at a point of the wall: of the sphere, or of the paraboloid z = H (1 - rho^2 /
   R^2). */
static void gradient(double height, const double x[3], double g[3])
{
    g[0] = x[0];
    g[1] = x[1];
    g[2] = height > 0 ? RADIUS * RADIUS / (2 * height) : x[2];
}

/* The distance from a point of the opening to the wall, against the direction d. */
static double depth(double height, const double x[3], const double d[3])
{
    double b = x[0] * d[0] + x[1] * d[1];
    double c = x[0] * x[0] + x[1] * x[1] - RADIUS * RADIUS;
    double a = 1;
    if (height > 0) { /* rho^2 + (R^2 / H) z - R^2 = 0 */
        a = d[0] * d[0] + d[1] * d[1];
        b += RADIUS * RADIUS / (2 * height) * d[2];
    }
    return (b + sqrt(b * b - a * c)) / a; /* of a t^2 - 2 b t + c = 0, the positive one */
}

/* The integral of f_r cos over the projected opening: Gauss's rule of two points in the radius,
   the midpoint rule around. */
static double inside(const lrcs_brdf *brdf, double height, const double d[3])
{
    const int n = 250;
    double sum = 0;
    for (int i = 0; i < n; i++) {
        for (int half = -1; half <= 1; half += 2) {
            double t = (i + 0.5 + half * 0.5 * 0.57735026918962576451) / n;
            double rho = RADIUS * t * (2 - t); /* closer at the rim, where G may have a root */
            double ring = 0;
            for (int k = 0; k < n / 2; k++) { /* the other half is the same */
                double phi = 2 * PI * (k + 0.5) / n;
                double x[3] = {rho * cos(phi), rho * sin(phi), 0};
                double g[3];
                double t_wall = depth(height, x, d);
                for (int j = 0; j < 3; j++) {
                    x[j] -= t_wall * d[j];
                }
                gradient(height, x, g);
                double cosine = -(g[0] * d[0] + g[1] * d[1] + g[2] * d[2]) /
                                sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
                ring += reflect(brdf, cosine) / cosine;
            }
            sum += 2 * ring * (2 * PI / n) * rho * (RADIUS * (2 - 2 * t)) * 0.5 / n;
        }
    }
    return -d[2] * sum;
}

/* The integral of f_r cos^2 over the points of the outside that face the laser, with d_x > 0: the
   same rules in the radius or the height, and around up to the azimuth where the surface is edge-on.
   There, and at the top, the integrand ends like a power above 1, which the substitutions
   phi = end (3 x^2 - 2 x^3) and, of a dome's height, 1 - (1 - t)^2 make smooth enough. */
static double outside(const lrcs_brdf *brdf, double height, const double d[3])
{
    const int n = 800;
    double sum = 0;
    for (int i = 0; i < 2 * n; i++) {
        double t = (i / 2 + 0.5 + (i % 2 ? 0.5 : -0.5) * 0.57735026918962576451) / n;
        double z = t * (2 - t); /* of a dome, divided by its radius */
        double rho = height > 0 ? RADIUS * t : RADIUS * sqrt((1 - z) * (1 + z));
        double area = height > 0 ? RADIUS * rho * hypot(1, 2 * height * rho / (RADIUS * RADIUS))
                                 : RADIUS * RADIUS * 2 * (1 - t);
        double g[3];
        gradient(height, (const double[3]){rho, 0, RADIUS * z}, g);
        double edge_on = -g[2] * d[2] / (g[0] * d[0]);
        double end = edge_on >= 1 ? 0 : edge_on <= -1 ? PI : acos(edge_on);
        for (int k = 0; k < 2 * n; k++) {
            double x = (k / 2 + 0.5 + (k % 2 ? 0.5 : -0.5) * 0.57735026918962576451) / n;
            double phi = end * x * x * (3 - 2 * x);
            double cosine = (g[0] * d[0] * cos(phi) + g[2] * d[2]) / hypot(g[0], g[2]);
            sum += cosine > 0 ? reflect(brdf, cosine) * area * end * 6 * x * (1 - x) : 0;
        }
    }
    return 2 * sum * 0.25 / n / n;
}

/* The shape, and a box so far to the side that it hides nothing. */
static lrcs_result bowl(double height, const double d[3], const lrcs_brdf *brdf, uint32_t facets)
{
    lrcs_recipe_part part[2];
    lrcs_recipe_material material[2] = {{.name = "skin", .brdf = *brdf, .two_sided = 1},
                                        {.name = "black", .brdf = {0, 0, 1, 0}}};
    for (int i = 0; i < 2; i++) {
        part[i] = (lrcs_recipe_part){.name = "", .place = lrcs_place_default()};
        part[i].material = material[i].name;
        part[i].material_index = i;
    }
    part[0].shape = (lrcs_shape){.kind = height > 0 ? LRCS_SHAPE_PARABOLOID : LRCS_SHAPE_DOME,
                                 .radius = RADIUS,
                                 .length = height,
                                 .parts = LRCS_SHAPE_WALL};
    part[1].shape = (lrcs_shape){.kind = LRCS_SHAPE_BOX, .size = {1, 1, 1}};
    part[1].place.translate[1] = 8;
    const lrcs_recipe recipe = {
        .part = part, .part_count = 2, .material = material, .material_count = 2};
    const lrcs_build_options build = {1e-9, facets, LRCS_NORMALS_FLAT, 1, 0, NULL};
    lrcs_run_options run = lrcs_run_options_default();
    run.method = LRCS_METHOD_EXACT;
    run.tolerance = 1e-9;
    return recipe_run(&recipe, &build, &run, d);
}

/* The glint of the last one is dark where the wall is seen at grazing incidence: at both ends of the
   near rim, that is. */
static const lrcs_brdf brdfs[3] = {{1, 0.25, 0.3, 0.5}, {0, 1, 1, 0}, {1, 0, 0.3, 0}};

/* height: 0 for a dome. bright, dark: the largest bounds relative to sigma, of the last BRDF and of
   the others, with 2,000 and with 8,000 facets. */
typedef struct bowl_case {
    double height, tilt, bright[2], dark[2];
} bowl_case;

static void check_bowls(const bowl_case *cases, int count)
{
    for (int i = 0; i < 3 * count; i++) {
        const bowl_case *at = &cases[i / 3];
        const lrcs_brdf *brdf = &brdfs[i % 3];
        const double d[3] = {sin(at->tilt * PI / 180), 0, -cos(at->tilt * PI / 180)};
        double truth = 4 * PI * (inside(brdf, at->height, d) + outside(brdf, at->height, d));
        for (int fine = 0; fine < 2; fine++) {
            lrcs_result r = bowl(at->height, d, brdf, fine ? 8000 : 2000);
            assert_int_equal(r.method, LRCS_METHOD_EXACT);
            check_abs(r.sigma_m2, truth, r.bound_m2 + 1e-9 * truth);
            if (i % 3 == 2 && fine) { /* more than that: the margins have the right sign */
                check_abs(r.sigma_m2, truth, 3e-9 * truth);
            }
            check_most(r.bound_m2, (i % 3 == 2 ? at->dark : at->bright)[fine] * truth);
        }
    }
}

/* Up to 51 degrees nothing is hidden. */
static void a_paraboloid_seen_into(void **state)
{
    (void)state;
    static const bowl_case cases[3] = {{0.3, 30, {2e-8, 2e-8}, {2e-8, 2e-8}},
                                       {0.3, 60, {4e-3, 1e-3}, {4e-8, 2e-8}},
                                       {0.3, 75, {1e-2, 2e-3}, {1e-6, 4e-8}}};
    check_bowls(cases, 3);
}

static void a_dome_seen_into(void **state)
{
    (void)state;
    static const bowl_case cases[3] = {{0, 25, {1e-2, 1e-3}, {4e-8, 2e-8}},
                                       {0, 50, {1e-2, 1e-3}, {2e-4, 4e-8}},
                                       {0, 75, {4e-2, 4e-3}, {2e-2, 2e-5}}};
    check_bowls(cases, 3);
}

/* A facet is longer than the projected opening is wide: from the grazing facets at both ends of the
   rim it does not follow that what is under the rest of it is unknown. */
static void a_rim_seen_edge_on(void **state)
{
    (void)state;
    static const bowl_case cases[3] = {{0.3, 89.9, {2e-2, 1e-3}, {2, 1e-7}},
                                       {0.3, 89.999, {2e-2, 3e-3}, {2, 1e-2}},
                                       {0, 89.999, {1e-2, 3e-3}, {1e-2, 5e-3}}};
    check_bowls(cases, 3);
}

static void place_at(lrcs_recipe_part *part, double x, double y, double z)
{
    part->place.translate[0] = x;
    part->place.translate[1] = y;
    part->place.translate[2] = z;
}

/* A bowl, and up to three other parts: a feed before the opening, a mast through the wall, a box
   about the rim, a plate beside. */
static lrcs_result crowded(uint64_t seed, uint32_t facets)
{
    lrcs_recipe_part part[4];
    lrcs_recipe_material material[2] = {
        {.name = "skin", .two_sided = 1},
        {.name = "other", .brdf = {0.2, 0.1, 0.5, 1}, .two_sided = 0}};
    uint64_t state = seed;
    const uint32_t count = 2 + (uint32_t)(3 * random_unit(&state));
    const double height = random_unit(&state) < 0.3 ? 0 : 0.1 + 0.5 * random_unit(&state);
    const double t = random_unit(&state); /* up to 85 degrees, or up to 0.005 degrees from 90 */
    const double tilt = (t < 0.8 ? 5 + 100 * t : 90 - 5 * pow(10, -15 * (t - 0.8))) * PI / 180;
    const double turn = 2 * PI * random_unit(&state);
    const double d[3] = {sin(tilt) * cos(turn), sin(tilt) * sin(turn), -cos(tilt)};
    material[0].brdf = brdfs[(int)(3 * random_unit(&state))];
    for (uint32_t i = 0; i < count; i++) {
        const double where = 2 * PI * random_unit(&state);
        const double out = RADIUS * random_unit(&state);
        const double x = out * cos(where);
        const double y = out * sin(where);
        part[i] = (lrcs_recipe_part){.name = "", .place = lrcs_place_default()};
        part[i].material = material[i > 0].name;
        part[i].material_index = i > 0;
        switch (i == 0 ? 0 : 1 + (int)(4 * random_unit(&state))) {
        case 0:
            part[i].shape =
                (lrcs_shape){.kind = height > 0 ? LRCS_SHAPE_PARABOLOID : LRCS_SHAPE_DOME,
                             .radius = RADIUS,
                             .length = height,
                             .parts = LRCS_SHAPE_WALL};
            break;
        case 1: /* feed */
            part[i].shape =
                (lrcs_shape){.kind = LRCS_SHAPE_SPHERE, .radius = 0.05 + 0.2 * random_unit(&state)};
            place_at(&part[i], 0.3 * x, 0.3 * y, -0.1 - 0.6 * random_unit(&state));
            break;
        case 2: /* mast */
            part[i].shape = (lrcs_shape){.kind = LRCS_SHAPE_CYLINDER,
                                         .radius = 0.02 + 0.1 * random_unit(&state),
                                         .length = 2};
            place_at(&part[i], x, y, -1.5 * random_unit(&state));
            break;
        case 3: /* box */
            part[i].shape = (lrcs_shape){.kind = LRCS_SHAPE_BOX, .size = {0.3, 0.2, 0.4}};
            place_at(&part[i], x * 1.2, y * 1.2, -random_unit(&state));
            break;
        default:
            part[i].shape = (lrcs_shape){.kind = LRCS_SHAPE_CONE, .radius = 0.2, .length = 0.5};
            place_at(&part[i], 2 * x, 2 * y, -0.2 - random_unit(&state));
        }
    }
    const lrcs_recipe recipe = {
        .part = part, .part_count = count, .material = material, .material_count = 2};
    const lrcs_build_options build = {1e-9, facets, LRCS_NORMALS_FLAT, 1, 0, NULL};
    lrcs_run_options run = lrcs_run_options_default();
    run.method = LRCS_METHOD_EXACT;
    run.tolerance = 1e-9;
    return recipe_run(&recipe, &build, &run, d);
}

/* Returns how many are beyond the sum of their bounds. */
static int crowded_check(int count, uint64_t seed, double *ratio)
{
    int beyond = 0;
    double sum = 0;
    for (int i = 0; i < count; i++) {
        const uint64_t scene = seed + (uint64_t)i;
        const lrcs_result coarse = crowded(scene, 1500);
        const lrcs_result fine = crowded(scene, 16000);
        const double apart = fabs(coarse.sigma_m2 - fine.sigma_m2);
        sum += coarse.bound_m2 > 0 ? fine.bound_m2 / coarse.bound_m2 : 0;
        if (!(apart <= coarse.bound_m2 + fine.bound_m2)) {
            printf("scene %llu: %.17g +- %g, %.17g +- %g\n", (unsigned long long)scene,
                   coarse.sigma_m2, coarse.bound_m2, fine.sigma_m2, fine.bound_m2);
            beyond++;
        }
    }
    *ratio = sum / count;
    return beyond;
}

static void bowls_with_other_parts(void **state)
{
    (void)state;
    double ratio;
    assert_int_equal(crowded_check(3, 1, &ratio), 0);
    check_most(ratio, 0.2); /* of the bounds of fine and coarse meshes */
}

/* The shadow of a box crosses the near rim: only the parts of the rim's margins beside the crossings
   are uncertain. */
static void shadows_across_the_rim_leave_the_rest_of_it_known(void **state)
{
    (void)state;
    static const double directions[2][3] = {{0.766, 0, -0.643}, {0.6, 0.1, -0.643}};
    lrcs_recipe_part part[2];
    lrcs_recipe_material material[2] = {{.name = "skin", .brdf = brdfs[1], .two_sided = 1},
                                        {.name = "dark", .brdf = {0, 0.01, 1, 0}}};
    for (int i = 0; i < 2; i++) {
        part[i] = (lrcs_recipe_part){.name = "", .place = lrcs_place_default()};
        part[i].material = material[i].name;
        part[i].material_index = i;
    }
    part[0].shape =
        (lrcs_shape){.kind = LRCS_SHAPE_DOME, .radius = RADIUS, .parts = LRCS_SHAPE_WALL};
    part[1].shape = (lrcs_shape){.kind = LRCS_SHAPE_BOX, .size = {0.2, 0.2, 0.2}};
    place_at(&part[1], 1.516, 0, -0.743);
    const lrcs_recipe recipe = {
        .part = part, .part_count = 2, .material = material, .material_count = 2};
    lrcs_run_options run = lrcs_run_options_default();
    run.method = LRCS_METHOD_EXACT;
    run.tolerance = 1e-9;
    for (int i = 0; i < 2; i++) {
        lrcs_result at[2];
        for (int fine = 0; fine < 2; fine++) {
            const lrcs_build_options build = {1e-9, fine ? 64000 : 8000, LRCS_NORMALS_FLAT, 1, 0,
                                              NULL};
            at[fine] = recipe_run(&recipe, &build, &run, directions[i]);
        }
        check_abs(at[0].sigma_m2, at[1].sigma_m2, at[0].bound_m2 + at[1].bound_m2);
        check_most(at[1].bound_m2, 5e-7 * at[1].sigma_m2);
    }
}

enum { FACETS = 20000 };

/* What is known of the inside of a dome seen into. */
typedef struct rim_case {
    lrcsi_visible_area area;
    lrcsi_segment_part near; /* of every side of the rim */
    int unknown;             /* of seven successive facets so many are in no set */
    int has_samples;
} rim_case;

/* What the rim adds to all facets of a dome seen into. */
static void rim_sum(const patch_scene *s, const rim_case *at, double *terms_sum, double *own)
{
    static unsigned char memory[1u << 25];
    static lrcsi_wall_terms terms[FACETS];
    static lrcsi_visible_area visible[FACETS];
    static lrcsi_part_set parts[FACETS];
    static lrcsi_segment_part rim[FACETS];
    static lrcsi_classification classification;
    const uint32_t count = s->scene.part[0].facet_count;
    const lrcsi_round_wall inside = lrcsi_round_wall_make(&s->view, &s->plan, 0, -1);
    lrcs_work work = lrcs_work_make(memory, sizeof memory);
    lrcsi_occlusion *o = NULL;
    assert_int_equal(lrcsi_classify_make(&s->view, NULL, &work, &classification), LRCS_OK);
    if (at->has_samples) {
        assert_int_equal(lrcsi_occlude_make(&classification, NULL, &work, &o), LRCS_OK);
    }
    lrcsi_proximity_band band = {.classification = &classification, .parts = parts, .rim = rim};
    assert_true(count <= FACETS);
    for (uint32_t f = 0; f < count; f++) {
        const int is_inside = s->view.facing[f] < 0;
        terms[f] = (lrcsi_wall_terms){.bound = 2};
        terms[f].way =
            is_inside && (int)(f % 7) >= at->unknown ? LRCSI_WALL_PIECES : LRCSI_WALL_FACET;
        visible[f] = is_inside ? at->area : (lrcsi_visible_area){.area = 0};
        parts[f] = lrcsi_part_set_of(0);
        rim[f] = at->near;
    }
    assert_int_equal(lrcsi_round_rim_add(&inside, &band, visible, o, NULL, &work, terms), 1);
    *terms_sum = *own = 0;
    for (uint32_t f = 0; f < count; f++) {
        assert_true(terms[f].way == LRCSI_WALL_PIECES ||
                    (terms[f].sum.diffuse == 0 && terms[f].sum.remainder == 0));
        *terms_sum += fabs(terms[f].sum.diffuse) + fabs(terms[f].sum.glint);
        *own += terms[f].sum.remainder;
    }
}

/* Margins are integrated only where samples tell that the inside is visible, all facets under them
   are in the set, and no other part's event edge is near. Otherwise they are errors. */
static void margins_count_once_it_is_known_what_is_under_them(void **state)
{
    (void)state;
    static patch_scene s;
    const lrcs_shape dome = {.kind = LRCS_SHAPE_DOME, .radius = 1, .parts = LRCS_SHAPE_WALL};
    const lrcs_brdf brdf = {0, 1, 1, 0};
    const rim_case seen = {{.area = 1, .low = 1, .high = 1}, {1, 0}, 0, 1};
    double sum;
    double own;
    double other;
    double error;
    double all;
    s.place = lrcs_place_default();
    patch_scene_make(&dome, 5e-2, &brdf, 1, (const double[3]){0.8, 0, -0.6}, &s);
    rim_sum(&s, &seen, &sum, &own);
    assert_true(sum > 0);

    rim_case at = seen;
    at.has_samples = 0;
    rim_sum(&s, &at, &other, &all);
    assert_true(other == 0);
    check_most(own, 0.2 * all); /* both ends of the near rim, where the wall is nearly edge-on */

    at = seen;
    at.area = (lrcsi_visible_area){.area = 0, .low = 0, .high = 0}; /* left out by the sum */
    rim_sum(&s, &at, &other, &error);
    assert_true(other == 0);
    check_abs(error, all, 1e-12 * all);

    at = seen;
    at.near = (lrcsi_segment_part){0, 1};
    rim_sum(&s, &at, &other, &error);
    assert_true(other == 0);
    check_abs(error, all, 1e-12 * all);
    at.near = (lrcsi_segment_part){0.4, 0.5}; /* the rest of each margin remains */
    rim_sum(&s, &at, &other, &error);
    assert_true(other > 0 && error > own);
    check_most(error, own + 0.2 * all);

    at = seen;
    at.unknown = 1;
    rim_sum(&s, &at, &other, &error);
    assert_true(other > 0 && error > own && error < all);
}

int main(int argc, char **argv)
{
    if (argc == 3) {
        double ratio;
        int beyond = crowded_check(atoi(argv[1]), strtoull(argv[2], NULL, 10), &ratio);
        printf("%s scenes: %d beyond their bounds; bounds of fine to coarse meshes: %.3g\n",
               argv[1], beyond, ratio);
        return beyond != 0;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_paraboloid_seen_into),
        cmocka_unit_test(a_dome_seen_into),
        cmocka_unit_test(a_rim_seen_edge_on),
        cmocka_unit_test(bowls_with_other_parts),
        cmocka_unit_test(shadows_across_the_rim_leave_the_rest_of_it_known),
        cmocka_unit_test(margins_count_once_it_is_known_what_is_under_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
