/* SPDX-License-Identifier: MIT */
/* The linear approximation over a patch against F at points of the true surface, and its integral
   over parts of the patch, by sums over the map onto the facets (mesh/shape/revolution.c), written
   down here once more. usage: test_linear [SHAPES SEED]    (many more) */
#include "integrate/wall/linear.h"

#include <lrcs/lrcs.h>

#include <stdlib.h>

#include "base/rotate.h"
#include "check.h"
#include "patch_scene.h"
#include "random.h"

static uint64_t seed = 1;

static double between(double low, double high)
{
    return low * pow(high / low, random_unit(&seed));
}

static lrcs_shape any_shape(void)
{
    static const int kind[] = {LRCS_SHAPE_SPHERE, LRCS_SHAPE_DOME,    LRCS_SHAPE_PARABOLOID,
                               LRCS_SHAPE_CONE,   LRCS_SHAPE_FRUSTUM, LRCS_SHAPE_CYLINDER};
    lrcs_shape shape = {.kind = kind[(int)(6 * random_unit(&seed))], .parts = LRCS_SHAPE_WALL};
    shape.radius = between(0.1, 2);
    if (shape.kind == LRCS_SHAPE_SPHERE) {
        shape.parts = LRCS_SHAPE_ALL;
    } else if (shape.kind != LRCS_SHAPE_DOME) {
        shape.length = between(0.1, 2);
    }
    shape.radius2 = shape.kind == LRCS_SHAPE_FRUSTUM ? between(0.1, 2) : 0;
    return shape;
}

/* --- the patch and its map -------------------------------------------------------------------- */

/* The strip of a patch, in the shape's units: true radii and heights of the facets' rows. */
typedef struct strip {
    const lrcs_shape *shape;
    double lower, upper; /* radii */
    double low, high;    /* heights of the facets' rows */
    double h, swell;     /* half a sector; vertex radius / true radius */
} strip;

/* The true radius at a fraction of the area, counted from the upper row, and the normal there. */
static double true_radius(const strip *s, double fraction, double *out, double *up)
{
    const lrcs_shape *shape = s->shape;
    double square = s->upper * s->upper + fraction * (s->lower * s->lower - s->upper * s->upper);
    double r = sqrt(square);
    if (shape->kind == LRCS_SHAPE_SPHERE || shape->kind == LRCS_SHAPE_DOME) {
        double a = sqrt(shape->radius * shape->radius - s->upper * s->upper);
        double b = sqrt(fmax(0, shape->radius * shape->radius - s->lower * s->lower));
        double z = a + fraction * (b - a);
        r = sqrt(shape->radius * shape->radius - z * z);
        *out = r;
        *up = z;
    } else if (shape->kind == LRCS_SHAPE_PARABOLOID) {
        double k = 2 * shape->length / (shape->radius * shape->radius);
        double a = pow(1 + k * k * s->upper * s->upper, 1.5);
        double b = pow(1 + k * k * s->lower * s->lower, 1.5);
        double w = cbrt(a + fraction * (b - a));
        r = sqrt((w - 1) * (w + 1)) / k;
        *out = k * r;
        *up = 1;
    } else {
        *out = shape->length;
        *up = s->lower - s->upper;
    }
    double length = hypot(*out, *up);
    *out /= length;
    *up /= length;
    return r;
}

/* The area of the patch divided by that of its facets. */
static double area_ratio(const strip *s)
{
    const lrcs_shape *shape = s->shape;
    double fall = s->lower - s->upper;
    double facets = s->swell * sin(s->h) * (s->lower + s->upper) *
                    hypot(s->swell * cos(s->h) * fall, s->high - s->low);
    if (shape->kind == LRCS_SHAPE_SPHERE || shape->kind == LRCS_SHAPE_DOME) {
        double a = sqrt(shape->radius * shape->radius - s->upper * s->upper);
        double b = sqrt(fmax(0, shape->radius * shape->radius - s->lower * s->lower));
        return 2 * s->h * shape->radius * (a - b) / facets;
    }
    if (shape->kind == LRCS_SHAPE_PARABOLOID) {
        double k = 2 * shape->length / (shape->radius * shape->radius);
        double a = pow(1 + k * k * s->upper * s->upper, 1.5);
        double b = pow(1 + k * k * s->lower * s->lower, 1.5);
        return 2 * s->h * (b - a) / (3 * k * k) / facets;
    }
    return s->h * (s->lower + s->upper) * hypot(fall, shape->length) / facets;
}

/* A vector of the shape's frame, or a point relative to another one, in the view. */
static void to_view(const patch_scene *s, const double v[3], double scale, double out[3])
{
    double body[3];
    for (int k = 0; k < 3; k++) {
        const double *row = s->place.rotate[k];
        body[k] = scale * (row[0] * v[0] + row[1] * v[1] + row[2] * v[2]);
    }
    for (int k = 0; k < 3; k++) {
        const double *row = s->view.R[k];
        out[k] = row[0] * body[0] + row[1] * body[1] + row[2] * body[2];
    }
}

static unsigned patches;
static unsigned beyond;
static double closest_point;
static double closest_region;

static void compare(double is, double most, double *closest, const char *what, uint64_t began,
                    const strip *at)
{
    *closest = fmax(*closest, is / most);
    if (!(is <= most)) {
        beyond++;
        fprintf(stderr, "seed %llu, kind %d, %s: %.17g, at most %.17g\n", (unsigned long long)began,
                at->shape->kind, what, is, most);
    }
}

/* Points at equal fractions of area, in the given rows; regions: on one side of lines in the view.
   Their integrals are sums over these points. */
static void patch_check(const patch_scene *s, const lrcs_brdf *brdf, const lrcsi_patch *patch,
                        const lrcsi_linear *linear, const lrcs_patch_bounds *c, const strip *at,
                        lrcsi_row_range rows, uint64_t began)
{
    enum { STEPS = 48, LINES = 12 };
    static double image[STEPS * STEPS][2];
    static double off[STEPS * STEPS];
    const double phi = (2.0 * patch->at.sector + 1) * at->h;
    const double side = patch->at.mirrored ? -1 : 1;
    const double scale = ldexp(s->place.scale[0], -s->view.prepared->exponent);
    const double mean = patch->glint + patch->diffuse;
    double error = patch->remainder + patch->rounding + 1e-10 * mean;
    double ratio = area_ratio(at);
    double top = at->swell * sin(at->h) * at->upper;
    double base = at->swell * sin(at->h) * at->lower;
    double centroid = (top + 2 * base) / (top + base) / 3; /* fraction from the top */
    double centre[3] = {at->swell * cos(at->h) * (at->upper + centroid * (at->lower - at->upper)),
                        0, at->high + centroid * (at->low - at->high)};
    double point = linear->point + (1 + c->area_err) * linear->region + error;
    double largest = 0;
    int count = 0;
    for (int i = 0; i < STEPS * STEPS; i++) {
        double fraction = (i / STEPS + 0.5) / STEPS;
        double v = 2.0 * (i % STEPS + 0.5) / STEPS - 1;
        double out;
        double up;
        double view[3];
        true_radius(at, fraction, &out, &up);
        double azimuth = phi + v * at->h;
        const double n[3] = {out * cos(azimuth), out * sin(azimuth), side * up};
        to_view(s, n, s->place.scale[0] < 0 ? -1 : 1, view);
        double f = patch_reflect_at(brdf, patch->side * view[2]);
        double ours = sqrt(at->upper * at->upper +
                           fraction * (at->lower * at->lower - at->upper * at->upper));
        double down =
            at->lower == at->upper ? fraction : (ours - at->upper) / (at->lower - at->upper);
        double x = at->swell * cos(at->h) * ours - centre[0]; /* in the frame of the sector */
        double y = at->swell * sin(at->h) * v * ours;
        const double p[3] = {x * cos(phi) - y * sin(phi), x * sin(phi) + y * cos(phi),
                             side * (at->high + down * (at->low - at->high) - centre[2])};
        to_view(s, p, scale, view);
        if (!(1 - down >= rows.low && 1 - down <= rows.high)) {
            continue;
        }
        image[count][0] = view[0];
        image[count][1] = view[1];
        double l = mean;
        for (int k = 0; k < 2; k++) {
            l += (linear->glint[k] + linear->diffuse[k]) * view[k];
        }
        off[count] = f - l / ratio;
        largest = fmax(largest, fabs(off[count]));
        count++;
    }
    compare(largest, point, &closest_point, "point", began, at);
    double reach = hypot(image[0][0], image[0][1]);
    for (int i = 0; i < LINES && count > 0; i++) {
        double angle = 2 * acos(-1.0) * random_unit(&seed);
        double shift = (2 * random_unit(&seed) - 1) * reach;
        double whole = 0;
        for (int j = 0; j < count; j++) {
            int inside =
                i == 0 ? off[j] > 0 : image[j][0] * cos(angle) + image[j][1] * sin(angle) < shift;
            whole += inside ? off[j] : 0;
        }
        compare(fabs(whole) / count * ratio, linear->region + error, &closest_region, "region",
                began, at);
    }
}

/* A few facets of one shape. */
static void shape_check(void)
{
    static patch_scene s;
    uint64_t began = seed;
    lrcs_shape shape = any_shape();
    const lrcs_brdf brdf = {random_unit(&seed) < 0.7 ? random_unit(&seed) : 0, random_unit(&seed),
                            between(0.05, 2), 4 * random_unit(&seed) * random_unit(&seed)};
    double scale = random_unit(&seed) < 0.5 ? -between(0.1, 10) : between(0.1, 10);
    double d[3];
    double euler[3];
    s.place = lrcs_place_default();
    for (int k = 0; k < 3; k++) {
        s.place.scale[k] = scale;
        s.place.translate[k] = random_unit(&seed);
        euler[k] = 360 * random_unit(&seed);
        d[k] = random_unit(&seed) - 0.5;
    }
    assert_int_equal(lrcsi_rotate_euler("XYZ", euler, s.place.rotate), LRCS_OK);
    patch_scene_make(&shape, between(2e-3, 2e-1), &brdf, 1, d, &s);
    const lrcs_part *part = &s.scene.part[0];
    const lrcs_patch_bounds *c = &part->bounds.patch;
    lrcsi_revolution body = lrcsi_revolution_make(&shape, &part->divisions);
    uint32_t step = 29 + part->facet_count / 40;
    for (uint32_t f = (uint32_t)(step * random_unit(&seed)); f < part->facet_count; f += step) {
        lrcsi_patches evaluated = {.derivatives = 0};
        lrcsi_linear linear;
        const lrcsi_patch *patch = s.view.prepared->skip[f]
                                       ? NULL
                                       : lrcsi_patch_make(&s.view, &s.plan, &brdf, f, &evaluated);
        if (!patch) {
            continue;
        }
        lrcsi_incidence incidence = lrcsi_view_incidence(&s.view, f);
        double second =
            lrcsi_deviation_make(&brdf, fabs(incidence.cos_theta), incidence.tan2, c).second;
        assert_int_equal(lrcsi_linear_make(&s.view, &brdf, patch, c, second, NULL, &linear), 1);
        strip at = {.shape = &shape, .h = body.half, .swell = body.vertex_ratio};
        at.lower = lrcsi_revolution_radius(&body, patch->at.row);
        at.upper = lrcsi_revolution_radius(&body, patch->at.row + 1);
        at.high = lrcsi_revolution_rise(&body, patch->at.row);
        patches++;
        patch_check(&s, &brdf, patch, &linear, c, &at, (lrcsi_row_range){0, 1}, began);
        if (lrcsi_revolution_is_straight(&body)) {
            const double low = 0.9 * random_unit(&seed);
            const lrcsi_row_range rows = {low, low + 0.1 * random_unit(&seed)};
            assert_true(lrcsi_linear_make(&s.view, &brdf, patch, c, second, &rows, &linear));
            patch_check(&s, &brdf, patch, &linear, c, &at, rows, began);
        }
    }
}

static void f_is_within_the_bounds_of_the_linear_function(void **state)
{
    (void)state;
    for (int i = 0; i < 60; i++) {
        shape_check();
    }
    assert_true(patches > 500);
    assert_int_equal(beyond, 0);
}

/* The first facet of the first part that has a patch which is neither seen from the front nor nearly
   edge-on. */
static lrcsi_patch tilted_patch(const patch_scene *s, const lrcs_brdf *brdf)
{
    for (uint32_t f = 0; f < s->scene.part[0].facet_count; f++) {
        lrcsi_patches evaluated = {.derivatives = 0};
        double c = lrcsi_view_incidence(&s->view, f).cos_theta;
        const lrcsi_patch *patch =
            c > 0.3 && c < 0.8 ? lrcsi_patch_make(&s->view, &s->plan, brdf, f, &evaluated) : NULL;
        if (patch) {
            return *patch;
        }
    }
    fail_msg("no patch");
    return (lrcsi_patch){.side = 0};
}

/* Rounding errors exceed the terms themselves if the glint is too narrow, the exponent too large,
   or the patch too nearly edge-on; and what faces away or has no bounds has no approximation. */
static void what_rounding_leaves_open_has_no_linear_function(void **state)
{
    (void)state;
    static patch_scene s;
    const lrcs_shape ball = {.kind = LRCS_SHAPE_SPHERE, .radius = 1};
    const lrcs_brdf brdf = {1, 1, 0.3, 1};
    const lrcs_brdf narrow = {1, 1, 1e-9, 1};
    const lrcs_brdf steep = {0, 1, 1, 1e17};
    lrcsi_linear linear;
    s.place = lrcs_place_default();
    patch_scene_make(&ball, 1e-2, &brdf, 1, (const double[3]){0.3, 0.5, 0.7}, &s);
    lrcsi_patch patch = tilted_patch(&s, &brdf);
    lrcs_patch_bounds bounds = s.scene.part[0].bounds.patch;
    assert_int_equal(lrcsi_linear_make(&s.view, &brdf, &patch, &bounds, 1, NULL, &linear), 1);
    assert_int_equal(lrcsi_linear_make(&s.view, &narrow, &patch, &bounds, 1, NULL, &linear), 0);
    assert_int_equal(lrcsi_linear_make(&s.view, &steep, &patch, &bounds, 1, NULL, &linear), 0);
    bounds.area_err = 0.5;
    assert_int_equal(lrcsi_linear_make(&s.view, &brdf, &patch, &bounds, 1, NULL, &linear), 0);
    bounds = s.scene.part[0].bounds.patch;
    patch.side = -patch.side;
    assert_int_equal(lrcsi_linear_make(&s.view, &brdf, &patch, &bounds, 1, NULL, &linear), 0);
}

/* The walls of a cylinder whose normals are perpendicular to the direction to within rounding, or
   nearly so. */
static void a_patch_seen_edge_on_has_no_linear_function(void **state)
{
    (void)state;
    static patch_scene s;
    const lrcs_shape tube = {
        .kind = LRCS_SHAPE_CYLINDER, .radius = 1, .length = 1, .parts = LRCS_SHAPE_WALL};
    const lrcs_brdf matt = {0, 1, 1, 0};
    s.place = lrcs_place_default();
    patch_scene_make(&tube, 1e-2, &matt, 1, (const double[3]){1, 0, 0}, &s);
    const uint32_t around = s.scene.part[0].divisions.around;
    for (uint32_t sector = 0; sector < around; sector += 1 + around / 12) {
        double phi = (2.0 * sector + 1) * acos(-1.0) / around;
        lrcsi_linear linear;
        lrcsi_patch patch = {.at = {.sector = sector, .facets = 2}};
        double c = sector % 2 ? 4 * LRCSI_PATCH_NORMAL_ERR : 0;
        const double d[3] = {c * cos(phi) - sin(phi), c * sin(phi) + cos(phi), 0};
        patch_scene_make(&tube, 1e-2, &matt, 1, d, &s);
        for (patch.side = -1; patch.side < 2; patch.side += 2) {
            assert_int_equal(lrcsi_linear_make(&s.view, &matt, &patch,
                                               &s.scene.part[0].bounds.patch, 1, NULL, &linear),
                             0);
        }
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(f_is_within_the_bounds_of_the_linear_function),
        cmocka_unit_test(what_rounding_leaves_open_has_no_linear_function),
        cmocka_unit_test(a_patch_seen_edge_on_has_no_linear_function),
    };
    if (argc > 2) {
        seed = strtoull(argv[2], NULL, 10);
        for (unsigned long i = strtoul(argv[1], NULL, 10); i > 0; i--) {
            shape_check();
        }
        printf("%u patches, %u beyond, worst fraction of the bound: point %.3f, region %.3f\n",
               patches, beyond, closest_point, closest_region);
        return beyond != 0;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
