/* SPDX-License-Identifier: MIT */
/* Means over patches of true surfaces against quadrature of the same surfaces written down here
   with other parameters: spheres over the square root of the depth below the top, paraboloids over
   the radius. usage: test_patch [SHAPES SEED]    (many more) */
#include "integrate/wall/patch.h"

#include <lrcs/lrcs.h>

#include <stdlib.h>
#include <string.h>

#include "base/rotate.h"
#include "check.h"
#include "patch_scene.h"
#include "random.h"
#include "view/view.h"

static uint64_t seed = 1;

static double between(double low, double high)
{
    return low * pow(high / low, random_unit(&seed));
}

static double division = 2e-2; /* the tolerance that shapes are divided for */

/* --- the reference ---------------------------------------------------------------------------- */

/* F times the area element, and the cosine of the incidence angle, at azimuth phi, where the
   parameter t goes from 0 at the lower row of the patch to 1 at the upper one. The shape is scaled
   along its axes and then rotated: normals are divided by the scales, and areas multiplied by their
   product and the length of that. */
static double element_at(const patch_scene *s, const lrcs_brdf *brdf, const lrcsi_patch *patch,
                         double t, double phi, double *cosine)
{
    const double *scale = s->place.scale;
    const lrcs_part *part = &s->scene.part[0];
    const lrcs_shape *shape = &part->shape;
    double rows = part->divisions.along;
    double r = shape->radius;
    double across; /* of the normal */
    double up;
    double element;
    if (shape->kind == LRCS_SHAPE_SPHERE || shape->kind == LRCS_SHAPE_DOME) {
        double w0 = sqrt(2) * sin((rows - patch->at.row) / rows * acos(0.0) / 2);
        double w1 = sqrt(2) * sin((rows - patch->at.row - 1) / rows * acos(0.0) / 2);
        double w = w0 + t * (w1 - w0);
        up = 1 - w * w;
        across = w * sqrt(2 - w * w);
        element = r * r * 2 * w * (w0 - w1);
    } else if (shape->kind == LRCS_SHAPE_PARABOLOID) {
        double rim = 2 * shape->length / r;
        double y0 = tan(atan(rim) * (rows - patch->at.row) / rows);
        double y1 = tan(atan(rim) * (rows - patch->at.row - 1) / rows);
        double y = y0 + t * (y1 - y0);
        up = 1 / sqrt(1 + y * y);
        across = y * up;
        element = r / rim * y * sqrt(1 + y * y) * (y0 - y1) * r / rim;
    } else {
        double low = shape->kind == LRCS_SHAPE_FRUSTUM ? shape->radius2 : r;
        double high = shape->kind == LRCS_SHAPE_CONE ? 0 : r;
        double slant = hypot(low - high, shape->length);
        up = (low - high) / slant;
        across = shape->length / slant;
        element = (low + t * (high - low)) * slant;
    }
    up = patch->at.mirrored ? -up : up;
    const double n[3] = {across * cos(phi) / scale[0], across * sin(phi) / scale[1], up / scale[2]};
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    double c = 0;
    for (int i = 0; i < 3; i++) {
        const double *row = s->place.rotate[i];
        c += s->view.unit[i] * (row[0] * n[0] + row[1] * n[1] + row[2] * n[2]);
    }
    *cosine = patch->side * c / length;
    return patch_reflect_at(brdf, *cosine) * element * length *
           fabs(scale[0] * scale[1] * scale[2]);
}

/* A part of a patch: t and azimuth in its middle, and half its widths. */
typedef struct cell {
    double t, phi, half_t, half_phi;
} cell;

/* Is some of a cell edge-on, to judge by nine points of it? */
static int cell_is_edge_on(const patch_scene *s, const lrcs_brdf *brdf, const lrcsi_patch *patch,
                           const cell *at)
{
    double low = 1;
    double high = -1;
    for (int i = 0; i < 9; i++) {
        double cosine;
        (void)element_at(s, brdf, patch, at->t + (i / 3 - 1) * at->half_t,
                         at->phi + (i % 3 - 1) * at->half_phi, &cosine);
        low = fmin(low, cosine);
        high = fmax(high, cosine);
    }
    return low < 0 && high > 0;
}

/* Gauss's rule of five points in each parameter. If some of the cell is edge-on, all of it is added
   to *error. */
static double cell_integral(const patch_scene *s, const lrcs_brdf *brdf, const lrcsi_patch *patch,
                            const cell *at, double *error)
{
    static const double x[5] = {0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640,
                                -0.9061798459386640};
    static const double w[5] = {0.5688888888888889, 0.4786286704993665, 0.4786286704993665,
                                0.2369268850561891, 0.2369268850561891};
    double sum = 0;
    double cosine;
    for (int i = 0; i < 25; i++) {
        sum += w[i % 5] * w[i / 5] *
               element_at(s, brdf, patch, at->t + at->half_t * x[i / 5],
                          at->phi + at->half_phi * x[i % 5], &cosine);
    }
    sum *= at->half_t * at->half_phi;
    *error += cell_is_edge_on(s, brdf, patch, at) ? sum : 0;
    return sum;
}

/* 24 parts of each parameter; those that are edge-on in part are halved in both, five times. */
static double reference(const patch_scene *s, const lrcs_brdf *brdf, const lrcsi_patch *patch,
                        double *error)
{
    cell list[16]; /* depth first: three of each of five levels wait, and one */
    double wide = 4 * acos(0.0) / s->scene.part[0].divisions.around;
    double sum = 0;
    *error = 0;
    for (int i = 0; i < 576; i++) {
        int count = 1;
        list[0] = (cell){(i / 24 + 0.5) / 24, wide * (patch->at.sector + (i % 24 + 0.5) / 24),
                         1.0 / 48, wide / 48};
        while (count > 0) {
            const cell at = list[--count];
            if (at.half_t < 1.0 / 48 / 31 || !cell_is_edge_on(s, brdf, patch, &at)) {
                sum += cell_integral(s, brdf, patch, &at, error);
                continue;
            }
            for (int k = 0; k < 4; k++) {
                list[count++] =
                    (cell){at.t + (k / 2 - 0.5) * at.half_t, at.phi + (k % 2 - 0.5) * at.half_phi,
                           0.5 * at.half_t, 0.5 * at.half_phi};
            }
        }
    }
    return sum;
}

/* --- tests ------------------------------------------------------------------------------------ */

static lrcs_shape any_shape(void)
{
    static const int kind[] = {LRCS_SHAPE_SPHERE, LRCS_SHAPE_DOME,    LRCS_SHAPE_PARABOLOID,
                               LRCS_SHAPE_CONE,   LRCS_SHAPE_FRUSTUM, LRCS_SHAPE_CYLINDER};
    lrcs_shape shape = {.kind = kind[(int)(6 * random_unit(&seed))]};
    shape.radius = between(0.1, 2);
    if (shape.kind != LRCS_SHAPE_SPHERE && shape.kind != LRCS_SHAPE_DOME) {
        shape.length = between(0.1, 2);
    }
    shape.radius2 = shape.kind == LRCS_SHAPE_FRUSTUM ? between(0.1, 2) : 0;
    shape.parts = shape.kind != LRCS_SHAPE_SPHERE && random_unit(&seed) < 0.5 ? LRCS_SHAPE_WALL
                                                                              : LRCS_SHAPE_ALL;
    return shape;
}

static double any_sign(double x)
{
    return random_unit(&seed) < 0.5 ? -x : x;
}

static unsigned known;
static unsigned beyond;
static double closest;

/* Every 37th facet of one shape. uneven: its scale differs between axes. */
static void shape_check(int uneven)
{
    static patch_scene s;
    uint64_t began = seed;
    lrcs_shape shape = any_shape();
    lrcs_place place = lrcs_place_default();
    const lrcs_brdf brdf = {random_unit(&seed) < 0.7 ? random_unit(&seed) : 0, random_unit(&seed),
                            between(0.02, 2), 4 * random_unit(&seed) * random_unit(&seed)};
    double scale = any_sign(between(0.1, 10));
    double d[3];
    double euler[3];
    for (int k = 0; k < 3; k++) {
        place.scale[k] = uneven ? any_sign(between(0.05, 1)) * scale : scale;
        place.translate[k] = random_unit(&seed);
        euler[k] = 360 * random_unit(&seed);
        d[k] = random_unit(&seed) - 0.5;
    }
    assert_int_equal(lrcsi_rotate_euler("XYZ", euler, place.rotate), LRCS_OK);
    s.place = place;
    patch_scene_make(&shape, division, &brdf, 1, d, &s);
    const lrcs_part *part = &s.scene.part[0];
    for (uint32_t f = (uint32_t)(37 * random_unit(&seed)); f < part->facet_count; f += 37) {
        lrcsi_patches patches = {.derivatives = 0};
        const lrcsi_patch *patch = s.view.prepared->skip[f]
                                       ? NULL
                                       : lrcsi_patch_make(&s.view, &s.plan, &brdf, f, &patches);
        if (!patch) {
            continue;
        }
        double reference_err;
        double truth = reference(&s, &brdf, patch, &reference_err);
        double area = 0;
        for (uint32_t i = 0; i < patch->at.facets; i++) {
            area += lrcsi_prepared_area(s.view.prepared,
                                        0.5 * s.view.prepared->normal[i ? f ^ 1 : f].length);
        }
        double apart = fabs((patch->glint + patch->diffuse) * area - truth);
        double most = (patch->remainder + patch->rounding) * area + 1e-11 * truth + reference_err;
        known++;
        closest = fmax(closest, apart / most);
        if (!(apart <= most)) {
            beyond++;
            fprintf(stderr, "seed %llu, kind %d, facet %u: %.17g, by quadrature %.17g +- %.3g\n",
                    (unsigned long long)began, shape.kind, (unsigned)f,
                    (patch->glint + patch->diffuse) * area, truth, most);
        }
    }
}

static void means_are_those_of_the_true_surface(void **state)
{
    (void)state;
    for (int uneven = 0; uneven < 2; uneven++) {
        known = 0;
        for (int i = 0; i < 20; i++) {
            shape_check(uneven);
        }
        assert_true(known > 133);
        known = 0;
        division = 2e-3; /* small patches, for which rules of few points suffice */
        for (int i = 0; i < 8; i++) {
            shape_check(uneven);
        }
        division = 2e-2;
        assert_true(known > 66);
    }
    assert_int_equal(beyond, 0);
}

/* By how much both terms change, in logarithms, where the computed normal (p, c) is off by e in the
   direction phi of its plane with the line of sight; the true one is a unit vector. */
static void term_changes(const lrcs_brdf *brdf, double p, double c, double e, double phi,
                         long double *glint, long double *diffuse)
{
    const long double off[2] = {(long double)e * cosl(phi), (long double)e * sinl(phi)};
    const long double truth = (long double)p * p / ((long double)c * c);
    const long double across = p + off[0];
    const long double along = c + off[1];
    const long double u = across * across / (along * along);
    const long double ratio = log1pl(u) - log1pl(truth);
    *glint = fabsl(2 * ratio - (u - truth) / ((long double)brdf->s * brdf->s));
    *diffuse = fabsl((brdf->m / 2 + 1) * ratio);
}

/* From the smallest errors to the largest allowed, at any incidence; a narrow glint's is not much
   larger than it has to be. */
static void errors_of_terms_cover_errors_of_normals(void **state)
{
    (void)state;
    static const double angle[] = {0, 1e-12, 1e-6, 1e-3, 0.1, 0.5, 1, 1.4, 1.57};
    static const double size[] = {0x1p-10, 0x1p-20, 0x1p-40};
    static const lrcs_brdf brdf[] = {{1, 1, 0.01, 0}, {1, 1, 0.5, 2}, {1, 1, 3, 50}};
    for (int i = 0; i < 81; i++) {
        const lrcs_brdf *b = &brdf[i % 3];
        double p = sin(angle[i / 9]);
        double c = cos(angle[i / 9]);
        double e = size[i / 3 % 3] * c;
        lrcsi_term_errors err = lrcsi_patch_term_errors(b, e, p * p / (c * c), c, p);
        double worst = 0;
        for (int k = 0; k < 64; k++) {
            long double glint;
            long double diffuse;
            term_changes(b, p, c, e, k * LRCS_PI / 32, &glint, &diffuse);
            check_most((double)glint, err.glint);
            check_most((double)diffuse, err.diffuse);
            worst = fmax(worst, (double)glint);
        }
        assert_true(b->s > 0.1 || err.glint <= 1.5 * worst);
    }
    const lrcs_brdf matt = {0, 1, 1, 0};
    check_same(lrcsi_patch_term_errors(&matt, 1e-6, 1, sqrt(0.5), sqrt(0.5)).glint, 0);
}

/* Nose-on all of a cone's wall has one incidence: the means add up to its closed form. */
static void patches_of_a_cone_add_up_to_its_closed_form(void **state)
{
    (void)state;
    static patch_scene s;
    const lrcs_shape shape = {
        .kind = LRCS_SHAPE_CONE, .radius = 0.5, .length = 1, .parts = LRCS_SHAPE_WALL};
    const lrcs_brdf brdf = {1, 0.25, 0.5, 0.5};
    const double d[3] = {0, 0, 1};
    const lrcs_place place = lrcs_place_default();
    const lrcs_aspect aspect = {1, 0, {0, 0, 1}};
    lrcs_closed_form closed;
    double sum = 0;
    s.place = place;
    patch_scene_make(&shape, division, &brdf, 0, d, &s);
    for (uint32_t f = 0; f < s.scene.part[0].facet_count; f++) {
        lrcsi_patches patches = {.derivatives = 0};
        const lrcsi_patch *patch = lrcsi_patch_make(&s.view, &s.plan, &brdf, f, &patches);
        assert_non_null(patch);
        sum += (patch->glint + patch->diffuse) * 0.5 * s.view.prepared->normal[f].length;
    }
    assert_int_equal(lrcs_closed_eval(&shape, &brdf, &aspect, &closed), LRCS_OK);
    check_rel(lrcsi_prepared_area(s.view.prepared, 4 * LRCS_PI * sum), closed.sigma_m2, 1e-12);
}

/* Patches that are edge-on in part have a mean if its remainder is small. Flat facets have none;
   nor has any where facets were asked for. */
static void means_at_the_limb_are_known_and_flat_parts_have_none(void **state)
{
    (void)state;
    static patch_scene s;
    const lrcs_shape shape = {.kind = LRCS_SHAPE_DOME, .radius = 1};
    const lrcs_brdf brdf = {1, 0.25, 0.5, 0.5};
    const double d[3] = {1, 0.01, 0.02};
    const lrcs_place place = lrcs_place_default();
    unsigned with = 0;
    unsigned limb = 0;
    unsigned without = 0;
    s.place = place;
    patch_scene_make(&shape, division, &brdf, 0, d, &s);
    for (uint32_t f = 0; f < s.scene.facet_count; f++) {
        lrcsi_patches patches = {.derivatives = 0};
        double cosine = fabs(lrcsi_view_incidence(&s.view, f).cos_theta);
        const lrcsi_patch *patch = lrcsi_patch_make(&s.view, &s.plan, &brdf, f, &patches);
        int made = patch != NULL;
        assert_false(made && s.scene.facet_smooth[f] == 0);
        with += made != 0;
        if (made && cosine < s.scene.part[0].bounds.patch.turn) {
            limb++;
            check_most(patch->remainder, 0x1p-3 * (patch->glint + patch->diffuse));
        }
        without += !made && cosine > 0.5 && s.scene.facet_smooth[f] != 0;
        s.plan.patches = 0;
        assert_null(lrcsi_patch_make(&s.view, &s.plan, &brdf, f, &patches));
        s.plan.patches = 1;
    }
    assert_true(with > 100);
    assert_true(limb > 10);
    assert_int_equal(without, 0);
}

/* The last patch is kept, but not its mean for another material. */
static void each_material_has_its_own_mean_over_a_patch(void **state)
{
    (void)state;
    static patch_scene s;
    static const lrcs_brdf brdf[] = {{1, 0.25, 0.3, 1},  {0.5, 0.25, 0.3, 1}, {0.5, 0.5, 0.3, 1},
                                     {0.5, 0.5, 0.4, 1}, {0.5, 0.5, 0.4, 2},  {1, 0.25, 0.3, 1}};
    const lrcs_shape ball = {.kind = LRCS_SHAPE_SPHERE, .radius = 1};
    const lrcs_place place = lrcs_place_default();
    s.place = place;
    patch_scene_make(&ball, division, &brdf[0], 0, (const double[3]){0.3, 0.5, 0.7}, &s);
    uint32_t facet = 0;
    while (!(lrcsi_view_incidence(&s.view, facet).cos_theta > 0.5)) {
        facet++;
    }
    lrcsi_patches kept = {.derivatives = 0};
    double before = 0;
    for (size_t i = 0; i < sizeof brdf / sizeof *brdf; i++) {
        lrcsi_patches fresh = {.derivatives = 0};
        const lrcsi_patch *want = lrcsi_patch_make(&s.view, &s.plan, &brdf[i], facet, &fresh);
        const lrcsi_patch *got = lrcsi_patch_make(&s.view, &s.plan, &brdf[i], facet, &kept);
        assert_non_null(want);
        assert_non_null(got);
        check_same(got->glint, want->glint);
        check_same(got->diffuse, want->diffuse);
        assert_true(got->glint + got->diffuse != before);
        before = got->glint + got->diffuse;
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(means_are_those_of_the_true_surface),
        cmocka_unit_test(errors_of_terms_cover_errors_of_normals),
        cmocka_unit_test(patches_of_a_cone_add_up_to_its_closed_form),
        cmocka_unit_test(means_at_the_limb_are_known_and_flat_parts_have_none),
        cmocka_unit_test(each_material_has_its_own_mean_over_a_patch),
    };
    if (argc > 2) {
        seed = strtoull(argv[2], NULL, 10);
        for (unsigned long i = strtoul(argv[1], NULL, 10); i > 0; i--) {
            shape_check(i % 2 != 0);
        }
        printf("%u patches, %u beyond, worst share of the bound %.3f\n", known, beyond, closest);
        return beyond != 0;
    }
    return cmocka_run_group_tests(tests, NULL, NULL);
}
