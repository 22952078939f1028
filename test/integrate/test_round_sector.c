/* SPDX-License-Identifier: MIT */
/* The margins of a sector are what its patch has and its facets lack: the integral of G over the
   projected facets and over all margins is that over the projected patch, which is integrated here
   over the shape's own parameters. */
#include "integrate/wall/round_sector.h"

#include <lrcs/lrcs.h>

#include "base/rotate.h"
#include "check.h"
#include "integrate/wall/mean_rule.h"
#include "integrate/wall/patch.h"
#include "patch_scene.h"
#include "random.h"

enum { POINTS = LRCSI_MEAN_RULE_POINTS, PANELS = 3 };

static uint64_t seed = 11;

static double between(double low, double high)
{
    return low + (high - low) * random_unit(&seed);
}

/* Points in 0 .. 1 and weights of the sum 1: the largest rule on each of a few panels. */
static void rule_make(double x[POINTS * PANELS], double weight[POINTS * PANELS])
{
    double t[POINTS];
    double w[POINTS];
    assert_int_equal(lrcsi_mean_rule_points(&lrcsi_mean_rules[LRCSI_MEAN_RULES - 1], t, w), POINTS);
    for (int i = 0; i < POINTS * PANELS; i++) {
        x[i] = (i / POINTS + 0.5 + 0.5 * t[i % POINTS]) / PANELS;
        weight[i] = w[i % POINTS] / PANELS;
    }
}

/* f_r cos(theta). */
static double reflect_at(const lrcs_brdf *brdf, double c)
{
    double u = 1 / (c * c) - 1;
    return brdf->A / pow(c, 5) * exp(-u / (brdf->s * brdf->s)) + brdf->B * pow(c, brdf->m + 1);
}

/* The integral over the projected patch, over its azimuths and over its polar angles or radii. */
static double patch_integral(const lrcsi_round_wall *wall, const lrcsi_wall_patch *at)
{
    const lrcsi_round_surface *s = &wall->surface;
    const double *d = s->axis[2];
    double x[POINTS * PANELS];
    double weight[POINTS * PANELS];
    double sum = 0;
    int bowl = s->part->kind == LRCS_SHAPE_PARABOLOID;
    double radius = sqrt(-s->gamma);
    double first = bowl ? lrcsi_revolution_radius(&wall->body, at->row) * wall->unit
                        : lrcsi_revolution_polar(&wall->body, at->row);
    double last = bowl ? lrcsi_revolution_radius(&wall->body, at->row + 1) * wall->unit
                       : lrcsi_revolution_polar(&wall->body, at->row + 1);
    rule_make(x, weight);
    for (int i = 0; i < POINTS * PANELS; i++) {
        for (int k = 0; k < POINTS * PANELS; k++) {
            double along = first + (last - first) * x[i];
            double phi = 2 * wall->body.half * (at->sector + x[k]);
            double across = bowl ? along / s->beta : sin(along); /* of the normal */
            double up = bowl ? 1 : (at->mirrored ? -1 : 1) * cos(along);
            double element = bowl ? along : radius * radius * sin(along);
            double toward = across * (cos(phi) * d[0] + sin(phi) * d[1]) + up * d[2];
            double c = toward / sqrt(across * across + up * up);
            sum += weight[i] * weight[k] * element * toward * reflect_at(&wall->brdf, c);
        }
    }
    return sum * fabs(last - first) * 2 * wall->body.half;
}

/* The integral over a projected facet. */
static double facet_integral(const lrcsi_round_wall *wall, uint32_t facet)
{
    const lrcsi_view *view = wall->view;
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    const double *a = view->point[corner[0]].x;
    const double *b = view->point[corner[1]].x;
    const double *c = view->point[corner[2]].x;
    const double none[2] = {0, 0};
    double x[POINTS * PANELS];
    double weight[POINTS * PANELS];
    double sum = 0;
    rule_make(x, weight);
    for (int i = 0; i < POINTS * PANELS; i++) {
        for (int k = 0; k < POINTS * PANELS; k++) {
            double at[2];
            lrcsi_round_point point;
            for (int j = 0; j < 2; j++) {
                at[j] = a[j] + x[i] * ((b[j] - a[j]) + x[k] * (c[j] - b[j]));
            }
            assert_int_equal(lrcsi_round_point_make(&wall->surface, at, &point), 1);
            lrcsi_round_value value =
                lrcsi_round_value_make(&wall->surface, &wall->brdf, &point, none);
            sum += weight[i] * weight[k] * x[i] * (value.glint + value.diffuse);
        }
    }
    return sum * fabs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

static void scene_at_random(int kind, const lrcs_brdf *brdf, patch_scene *s)
{
    lrcs_shape shape = {.kind = kind, .radius = between(0.3, 1)};
    shape.parts = kind == LRCS_SHAPE_SPHERE ? LRCS_SHAPE_ALL : LRCS_SHAPE_WALL;
    double d[3];
    double euler[3];
    shape.length = kind == LRCS_SHAPE_PARABOLOID ? between(0.1, 1) : 0;
    s->place = lrcs_place_default();
    for (int k = 0; k < 3; k++) {
        s->place.translate[k] = between(-1, 1);
        euler[k] = between(0, 360);
        d[k] = between(-1, 1);
    }
    assert_int_equal(lrcsi_rotate_euler("XYZ", euler, s->place.rotate), LRCS_OK);
    patch_scene_make(&shape, 5e-2, brdf, 1, d, s);
}

/* Three parts of a side's margin are together the margin. */
static void check_margin_parts(const lrcsi_round_wall *wall, const lrcsi_round_side *side,
                               const lrcsi_round_margin *whole)
{
    const double limit[4] = {-1, between(-1, 0), between(0, 1), 1};
    double sum = 0;
    double error = whole->sum.remainder + whole->sum.rounding;
    for (int i = 0; i < 3; i++) {
        lrcsi_round_margin part;
        const lrcsi_round_range range = {limit[i], limit[i + 1]};
        assert_int_equal(lrcsi_round_margin_make(wall, side, range, &part), 1);
        check_most(fabs(part.sum.glint + part.sum.diffuse), part.largest);
        check_most(part.width, whole->width * (1 + 1e-9));
        sum += part.sum.glint + part.sum.diffuse;
        error += part.sum.remainder + part.sum.rounding;
    }
    check_abs(sum, whole->sum.glint + whole->sum.diffuse, error);
}

/* One sector. Returns 0 if its margins are not all known. */
static int sector_check(const lrcsi_round_wall *wall, uint32_t facet, double *largest)
{
    const lrcs_part *part = wall->surface.part;
    lrcsi_round_sector sector;
    lrcsi_wall_patch at;
    double margins = 0;
    double error = 0;
    double most = 0; /* of a remainder: a fraction of the margin where that is the best one */
    double facets = 0;
    assert_int_equal(lrcsi_tessellate_patch(&part->shape, &part->divisions, facet, &at), 1);
    assert_int_equal(lrcsi_round_sector_make(wall, facet, &sector), 1);
    assert_true(sector.sides == 2 + sector.facets);
    for (int i = 0; i < sector.sides; i++) {
        lrcsi_round_margin margin;
        if (!lrcsi_round_margin_make(wall, &sector.side[i], lrcsi_round_whole_side, &margin)) {
            return 0;
        }
        check_most(fabs(margin.sum.glint + margin.sum.diffuse), margin.largest);
        margins += margin.sum.glint + margin.sum.diffuse;
        error += margin.sum.remainder + margin.sum.rounding;
        most += margin.pieces == 32 ? 0x1p-6 * margin.largest : 0;
        check_margin_parts(wall, &sector.side[i], &margin);
    }
    for (int i = 0; i < sector.facets; i++) {
        facets += facet_integral(wall, sector.facet[i]);
    }
    double patch = patch_integral(wall, &at);
    check_abs(facets + margins, patch, error + 1e-11 * patch);
    check_most(error, 1e-5 * patch + most);
    *largest = fmax(*largest, fabs(facets - patch) / patch);
    return 1;
}

static void facets_and_margins_are_together_the_patch(void **state)
{
    (void)state;
    static const int kinds[3] = {LRCS_SHAPE_SPHERE, LRCS_SHAPE_DOME, LRCS_SHAPE_PARABOLOID};
    static patch_scene s;
    double largest = 0;
    int known[2] = {0, 0}; /* of the inside, of the outside */
    for (int i = 0; i < 12; i++) {
        const lrcs_brdf brdf = {i % 4 ? between(0, 1) : 0, between(0, 1), between(0.2, 1),
                                between(0, 3)};
        scene_at_random(kinds[i % 3], &brdf, &s);
        for (int side = 1; side >= (s.scene.part[0].solid ? 1 : -1); side -= 2) {
            lrcsi_round_wall wall = lrcsi_round_wall_make(&s.view, &s.plan, 0, side);
            uint32_t count = s.scene.part[0].facet_count;
            for (uint32_t f = 0; f < count; f += 1 + random_below(&seed, 40)) {
                if (lrcsi_patch_exists(s.view.prepared, f) && s.view.facing[f] == side &&
                    fabs(lrcsi_view_incidence(&s.view, f).cos_theta) > 0.3) {
                    known[side > 0] += sector_check(&wall, f, &largest);
                }
            }
        }
    }
    assert_true(known[0] > 40 && known[1] > 100);
    assert_true(largest > 1e-4); /* without the margins the test would fail */
}

/* Near the outline, a part of a side may be too steep for bounds of its own, although the whole side,
   of which only the middle is examined, has some: its bound is infinite then, not 0. */
static void parts_that_are_too_steep_have_no_bound(void **state)
{
    (void)state;
    static patch_scene s;
    const lrcs_brdf brdf = {0, 1, 1, 0};
    int known = 0;
    int steep = 0;
    for (int i = 0; i < 400 && (steep == 0 || known <= 1000); i++) {
        scene_at_random(LRCS_SHAPE_SPHERE, &brdf, &s);
        lrcsi_round_wall wall = lrcsi_round_wall_make(&s.view, &s.plan, 0, 1);
        for (uint32_t f = 0; f < s.scene.part[0].facet_count; f++) {
            lrcsi_round_sector sector;
            if (s.view.facing[f] != 1 || lrcsi_view_incidence(&s.view, f).cos_theta > 0.2 ||
                !lrcsi_round_sector_make(&wall, f, &sector)) {
                continue;
            }
            for (int k = 0; k < 2 * sector.sides; k++) {
                const lrcsi_round_side *side = &sector.side[k / 2];
                const lrcsi_round_range end = {k % 2 ? 0.999 : -1, k % 2 ? 1 : -0.999};
                lrcsi_round_margin margin;
                if (!lrcsi_round_margin_bounds(&wall, side, lrcsi_round_whole_side, &margin)) {
                    assert_false(margin.largest < HUGE_VAL);
                    continue;
                }
                if (lrcsi_round_margin_bounds(&wall, side, end, &margin)) {
                    assert_true(margin.largest > 0 && margin.largest < HUGE_VAL);
                    known++;
                } else {
                    assert_false(margin.largest < HUGE_VAL);
                    steep++;
                }
            }
        }
    }
    assert_true(known > 1000);
    assert_true(steep > 0);
}

/* A side moved beyond the outline has no surface above it; a facet of the base is in no sector. */
static void what_is_not_on_the_wall_is_refused(void **state)
{
    (void)state;
    static patch_scene s;
    const lrcs_brdf brdf = {0, 1, 1, 0};
    const lrcs_shape dome = {.kind = LRCS_SHAPE_DOME, .radius = 1};
    s.place = lrcs_place_default();
    patch_scene_make(&dome, 5e-2, &brdf, 0, (const double[3]){0.1, 0.2, 1}, &s);
    lrcsi_round_wall wall = lrcsi_round_wall_make(&s.view, &s.plan, 0, 1);
    int walls = 0;
    for (uint32_t f = 0; f < s.scene.part[0].facet_count; f++) {
        lrcsi_round_sector sector;
        lrcsi_round_margin margin;
        int known = lrcsi_round_sector_make(&wall, f, &sector);
        assert_int_equal(known, lrcsi_patch_exists(s.view.prepared, f));
        if (known && lrcsi_view_incidence(&s.view, f).cos_theta > 0.5) {
            assert_int_equal(
                lrcsi_round_margin_make(&wall, &sector.side[0], lrcsi_round_whole_side, &margin),
                1);
            sector.side[0].chord[0] += 10;
            assert_int_equal(
                lrcsi_round_margin_make(&wall, &sector.side[0], lrcsi_round_whole_side, &margin),
                0);
            walls++;
        }
    }
    assert_true(walls > 50);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(facets_and_margins_are_together_the_patch),
        cmocka_unit_test(parts_that_are_too_steep_have_no_bound),
        cmocka_unit_test(what_is_not_on_the_wall_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
