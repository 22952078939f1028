/* SPDX-License-Identifier: MIT */
/* The sum of Eq. 2 over given visible areas, against a plain loop over facets in long double:
   facets in packets and one by one, both sides of facets, counts, bounds and records. The visible
   areas are made up here, so that nothing depends on how visibility finds them. */
#include "integrate/sum/total.h"

#include "optics/shade.h"
#include "scenes.h"

#define FACETS 300u

static test_scene scene;
static lrcsi_visible_area area[FACETS];
static unsigned char answer[FACETS];
static lrcs_facet_record record[FACETS];
static uint64_t seed = 7;

/* --- scenes ----------------------------------------------------------------------------------- */

/* A direction of integers, two vectors perpendicular to it, and what its multiples are measured
   by. */
static const double towards[3] = {1, 2, 2};
static const double across[2][3] = {{2, -1, 0}, {0, 1, -1}};

static const lrcs_brdf brdfs[] = {
    {1, 0.25, 0.2, 0.5}, {0.8, 0, 0.02, 0}, {0, 0.3, 0.2, 2}, {0.5, 0.1, 0.5, 40}};
#define MATERIALS (sizeof brdfs / sizeof *brdfs)

/* A vector of multiples of 2^-10, so that sums and differences of a few are exact. */
static void any_vector(double v[3])
{
    for (int k = 0; k < 3; k++) {
        v[k] = ldexp((double)random_below(&seed, 2049) - 1024, -10);
    }
}

static void add_triangle(const double u[3], const double v[3])
{
    double corner[3][3];
    any_vector(corner[0]);
    for (int k = 0; k < 3; k++) {
        corner[1][k] = corner[0][k] + u[k];
        corner[2][k] = corner[0][k] + v[k];
    }
    scene_triangle(&scene, corner[0], corner[1], corner[2]);
}

/* FACETS triangles of all materials, the last two of them two-sided. Of 8 triangles one is seen at
   grazing incidence, one is near the peak of a glint, one is edge-on. */
static void any_scene(void)
{
    scene_start(&scene);
    for (uint32_t m = 0; m < MATERIALS; m++) {
        const lrcs_brdf *b = &brdfs[m];
        scene_material(&scene, b->A, b->B, b->s, b->m)->two_sided = m >= MATERIALS / 2;
    }
    for (uint32_t f = 0; f < FACETS; f++) {
        double u[3];
        double v[3];
        any_vector(u);
        any_vector(v);
        scene.assigned = 1 + random_below(&seed, MATERIALS);
        for (int k = 0; k < 3 && f % 8 < 3; k++) {
            double tilt = f % 8 < 2 ? ldexp(u[k], -14) : 0;
            u[k] = f % 8 == 1 ? across[0][k] + tilt : towards[k] + tilt;
            v[k] = f % 16 < 8 ? across[1][k] : -across[1][k];
        }
        add_triangle(u, v);
    }
}

typedef struct summed {
    lrcs_work work;
    const lrcs_prepared *prepared;
    lrcsi_view view;
    lrcsi_plan plan;
    lrcsi_clear_shapes clear;
} summed;

static void prepare(int method, summed *s)
{
    lrcs_pose pose;
    lrcs_run_options options = lrcs_run_options_default();
    options.method = method;
    s->prepared = scene_prepare(&scene, &s->work);
    s->clear = (lrcsi_clear_shapes){.count = 0};
    assert_int_equal(lrcs_pose_from_direction(towards, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_face(s->prepared, &pose, lrcsi_plan_backs(s->prepared, &options),
                                     &s->work, &s->view),
                     LRCS_OK);
    s->plan = lrcsi_plan_make(&s->view, &s->clear, &options);
}

/* Visible areas: all, nothing, a part as from clipping, or a part as from samples. */
static void any_areas(const summed *s)
{
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        double whole = lrcsi_view_projected(&s->view, f);
        double a = whole * random_unit(&seed);
        double low = a * random_unit(&seed);
        double high = a + (whole - a) * random_unit(&seed);
        switch (random_below(&seed, 4)) {
        case 0:
            area[f] = lrcsi_visible_area_exact(whole);
            break;
        case 1:
            area[f] = lrcsi_visible_area_exact(0);
            break;
        case 2:
            area[f] = (lrcsi_visible_area){a, a * (1 - 1e-12), a * (1 + 1e-12), 0, 0};
            break;
        default:
            area[f] = (lrcsi_visible_area){a, low, high, 0.125 * (high - low), 0};
            area[f].bias = random_below(&seed, 2) ? 0.25 * area[f].error_estimate : 0;
            break;
        }
    }
}

static lrcsi_total sum_up(const summed *s, const lrcsi_areas *areas)
{
    lrcsi_total_details details = {record, NULL, NULL};
    return lrcsi_total_make(&s->view, &s->plan, areas, NULL, NULL, &s->clear, &details);
}

/* --- the plain loop --------------------------------------------------------------------------- */

/* A facet's area in m^2, and the cosine of its incidence, from its vertices. */
static long double plain_area(const summed *s, uint32_t f, long double *cosine)
{
    const double *d = s->view.direction;
    const lrcs_point *p[3];
    long double n[3];
    for (int k = 0; k < 3; k++) {
        p[k] = &scene.vertex[scene.facet[f].corner[k]];
    }
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3;
        int j = (k + 2) % 3;
        n[k] = ((long double)p[1]->x[i] - p[0]->x[i]) * ((long double)p[2]->x[j] - p[0]->x[j]) -
               ((long double)p[1]->x[j] - p[0]->x[j]) * ((long double)p[2]->x[i] - p[0]->x[i]);
    }
    long double length = sqrtl(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    *cosine = (n[0] * d[0] + n[1] * d[1] + n[2] * d[2]) / length /
              sqrtl((long double)d[0] * d[0] + (long double)d[1] * d[1] + (long double)d[2] * d[2]);
    return length / 2;
}

typedef struct plain_total {
    long double glint, diffuse, projected, back_side, visibility, random, bias;
    uint32_t hidden, partial, back_sides;
    uint32_t packed, single; /* facets that reflect, in packets and one by one */
} plain_total;

/* Adds a facet of which `seen` is visible, in m^2. */
static void plain_add(const summed *s, uint32_t f, const lrcsi_visible_area *seen,
                      plain_total *total)
{
    const lrcs_material *m = &scene.material[scene.material_of[f]];
    const lrcs_brdf glint = {m->brdf.A, 0, m->brdf.s, 0};
    const lrcs_brdf diffuse = {0, m->brdf.B, 1, m->brdf.m};
    const lrcsi_lobes lobes = lrcsi_lobes_make(&m->brdf, m->brdf.A > 0, m->brdf.B > 0);
    long double cosine;
    long double whole = plain_area(s, f, &cosine);
    if (s->view.facing[f] == 0) {
        return;
    }
    if (cosine < 0 && !m->two_sided) {
        total->projected += seen->area;
        total->back_side += seen->area;
        total->back_sides += seen->area > 0;
        return;
    }
    cosine = fabsl(cosine);
    int some = seen->area > 0;
    total->hidden += !some;
    total->partial += some && seen->area < whole * cosine * (1 - 0x1p-40L);
    total->packed += some && cosine > lobes.low && cosine < lobes.high;
    total->single += some && !(cosine > lobes.low && cosine < lobes.high);
    long double by_area = scene_eq2(&m->brdf, 1 / cosine, cosine * cosine);
    total->projected += seen->area;
    total->glint += scene_eq2(&glint, seen->area / cosine, cosine * cosine);
    total->diffuse += scene_eq2(&diffuse, seen->area / cosine, cosine * cosine);
    total->visibility += by_area * fmaxl(seen->area - seen->low, seen->high - seen->area);
    total->random = hypotl(total->random, by_area * seen->error_estimate);
    total->bias += by_area * seen->bias;
}

static plain_total plain_sum(const summed *s, const lrcsi_visible_area *areas)
{
    plain_total total = {0};
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        lrcsi_visible_area seen = {lrcsi_prepared_area(s->prepared, areas[f].area),
                                   lrcsi_prepared_area(s->prepared, areas[f].low),
                                   lrcsi_prepared_area(s->prepared, areas[f].high),
                                   lrcsi_prepared_area(s->prepared, areas[f].error_estimate),
                                   lrcsi_prepared_area(s->prepared, areas[f].bias)};
        plain_add(s, f, &seen, &total);
    }
    return total;
}

/* Sigma within its rounding bound, and the rounding of the plain loop, which matters where long
   double is no wider than double: that of tan^2 changes the narrowest glint 2,500 times as much. */
static void check_sigma(const lrcsi_total *got, const plain_total *want)
{
    double plain_err = 0x1p14 * (double)LDBL_EPSILON * (double)(want->glint + want->diffuse);
    check_abs(got->glint + got->diffuse, (double)(want->glint + want->diffuse),
              got->rounding + plain_err);
    check_abs(got->glint, (double)want->glint, got->rounding + plain_err);
    check_abs(got->diffuse, (double)want->diffuse, got->rounding + plain_err);
    check_most(got->rounding, 1e-11 * (got->glint + got->diffuse) + 1e-290); /* underflow */
}

/* The same sum, every facet by itself; in *total its counts. */
static lrcsi_total_sums one_by_one(const summed *s, const lrcsi_areas *areas, lrcsi_total *total)
{
    lrcsi_total_run run = {.view = &s->view, .plan = &s->plan, .areas = areas, .clear = &s->clear};
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        lrcsi_total_add_facet(&run, f);
    }
    *total = run.total;
    return run.sums;
}

/* --- tests ------------------------------------------------------------------------------------ */

static void any_facets_with_any_areas_follow_the_plain_loop(void **state)
{
    (void)state;
    plain_total all = {0};
    for (int i = 0; i < 20; i++) {
        summed s;
        any_scene();
        prepare(LRCS_METHOD_EXACT, &s);
        any_areas(&s);
        const lrcsi_areas areas = {.visible = area};
        const lrcsi_total got = sum_up(&s, &areas);
        const plain_total want = plain_sum(&s, area);
        check_sigma(&got, &want);
        check_rel(got.projected, (double)want.projected, 1e-13);
        check_rel(got.back_side, (double)want.back_side, 1e-13);
        check_rel(got.visibility, (double)want.visibility, 1e-8);
        assert_true(got.visibility >= (double)want.visibility);
        check_rel(got.error_estimate, (double)hypotl(want.random, want.bias), 1e-8);
        check_same(got.tessellation, 0);
        check_same(got.cubature_estimate, 0);
        assert_int_equal(got.hidden, want.hidden);
        assert_int_equal(got.partial, want.partial);
        assert_int_equal(got.back_sides, want.back_sides);
        all.packed += want.packed;
        all.single += want.single;
        all.hidden += want.hidden;
        all.partial += want.partial;
        all.back_sides += want.back_sides;
    }
    assert_true(all.packed > 1000 && all.single > 250 && all.hidden > 500);
    assert_true(all.partial > 1000 && all.back_sides > 500);
}

/* Two plates of different materials: one entirely visible, one half hidden. */
static void two_plates_add_what_is_visible_of_each(void **state)
{
    (void)state;
    summed s;
    scene_start(&scene);
    scene_material(&scene, 1, 0.25, 0.2, 0.5);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){2, -1, 0},
                (const double[3]){0, 1, -1});
    scene_material(&scene, 0, 0.5, 1, 0);
    scene_plate(&scene, (const double[3]){5, 0, 0}, (const double[3]){1, 0, 0},
                (const double[3]){0, 1, 0});
    prepare(LRCS_METHOD_EXACT, &s);
    for (uint32_t f = 0; f < 4; f++) {
        double a = (f < 2 ? 1 : 0.5) * lrcsi_view_projected(&s.view, f);
        area[f] = lrcsi_visible_area_exact(a);
    }
    const lrcsi_areas areas = {.visible = area};
    const lrcsi_total got = sum_up(&s, &areas);
    /* The first plate faces the laser: f_r is A + B there, its area |(2, -1, 0) x (0, 1, -1)| = 3.
       Of the second, of area 1, cos(theta) is 2/3. */
    check_rel(got.glint, 4 * (double)SCENE_PI * 1 * 3, 1e-14);
    check_rel(got.diffuse, 4 * (double)SCENE_PI * (0.25 * 3 + 0.5 * 0.5 * 4 / 9), 1e-14);
    check_rel(got.projected, 3 + 0.5 * 2 / 3, 1e-14);
    check_same(got.visibility, 0);
    assert_int_equal(got.seen, 1u << LRCS_EFFECT_GLINT | 1u << LRCS_EFFECT_DIFFUSE);
}

/* Without visible areas, a packet computes its own. Visible areas that it is given have the relative
   error of projected areas, which the bound includes. */
static void the_error_of_given_areas_is_in_the_bound(void **state)
{
    (void)state;
    summed s;
    scene_start(&scene);
    scene_material(&scene, 1, 0.25, 0.2, 0.5);
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                (const double[3]){0, 1, 0});
    prepare(LRCS_METHOD_FACET, &s);
    s.plan.grazing_cos = 0;
    const lrcsi_areas none = {.visible = NULL};
    const lrcsi_total computed = sum_up(&s, &none);
    prepare(LRCS_METHOD_EXACT, &s);
    for (uint32_t f = 0; f < 2; f++) {
        area[f] = lrcsi_visible_area_exact(lrcsi_view_projected(&s.view, f));
    }
    const lrcsi_areas areas = {.visible = area};
    const lrcsi_total given = sum_up(&s, &areas);
    double error = lrcsi_view_incidence(&s.view, 0).error;
    assert_true(error > 0);
    check_most(error * (given.glint + given.diffuse), given.rounding - computed.rounding);
}

/* For every facet alone, so that no other bound hides a difference. */
static void a_facet_in_a_packet_and_alone_adds_the_same_within_both_bounds(void **state)
{
    (void)state;
    summed s;
    uint32_t packed = 0;
    any_scene();
    prepare(LRCS_METHOD_EXACT, &s);
    any_areas(&s);
    static lrcsi_visible_area only[FACETS];
    for (uint32_t f = 0; f < FACETS; f++) {
        only[f] = lrcsi_visible_area_exact(0);
    }
    for (uint32_t f = 0; f < FACETS; f++) {
        only[f] = area[f];
        const lrcsi_areas areas = {.visible = only};
        const lrcsi_total got = sum_up(&s, &areas);
        const plain_total want = plain_sum(&s, only);
        lrcsi_total counts;
        const lrcsi_total_sums sums = one_by_one(&s, &areas, &counts);
        double glint = lrcsi_prepared_area(s.prepared, lrcsi_sum_value(&sums.glint));
        double diffuse = lrcsi_prepared_area(s.prepared, lrcsi_sum_value(&sums.diffuse));
        double rounding = lrcsi_prepared_bound(s.prepared, sums.rounding);
        check_sigma(&got, &want);
        check_abs(got.glint + got.diffuse, glint + diffuse, got.rounding + rounding);
        check_rel(got.visibility, lrcsi_prepared_area(s.prepared, sums.visibility), 1e-8);
        assert_int_equal(got.hidden, counts.hidden);
        assert_int_equal(got.partial, counts.partial);
        assert_int_equal(got.back_sides, counts.back_sides);
        assert_int_equal(got.seen, sums.seen);
        packed += want.packed;
        only[f] = lrcsi_visible_area_exact(0);
    }
    assert_true(packed > 50);
}

/* Where there is an answer no area is read. */
static void answers_stand_for_areas(void **state)
{
    (void)state;
    summed s;
    any_scene();
    prepare(LRCS_METHOD_EXACT, &s);
    any_areas(&s);
    lrcsi_areas areas = {.visible = area};
    const lrcsi_total want = sum_up(&s, &areas);
    for (uint32_t f = 0; f < FACETS; f++) {
        int whole = area[f].low == area[f].high && area[f].area > 0;
        answer[f] = whole               ? LRCSI_QUERY_VISIBLE
                    : area[f].area == 0 ? LRCSI_QUERY_HIDDEN
                                        : LRCSI_QUERY_NO_ANSWER;
        if (answer[f] != LRCSI_QUERY_NO_ANSWER) {
            area[f] = (lrcsi_visible_area){NAN, NAN, NAN, NAN, NAN};
        }
    }
    areas.answer = answer;
    const lrcsi_total got = sum_up(&s, &areas);
    check_abs(got.glint, want.glint, got.rounding + want.rounding);
    check_abs(got.diffuse, want.diffuse, got.rounding + want.rounding);
    check_rel(got.projected, want.projected, 1e-13);
    check_rel(got.back_side, want.back_side, 1e-13);
    check_rel(got.visibility, want.visibility, 1e-14);
    assert_int_equal(got.hidden, want.hidden);
    assert_int_equal(got.partial, want.partial);
    assert_int_equal(got.back_sides, want.back_sides);
}

/* Method facet: every facet that faces the laser counts entirely. What may be hidden is a bound:
   everything, or where the plan has a proof only facets seen at less than its threshold. */
static void without_areas_all_is_visible_and_what_may_be_hidden_is_a_bound(void **state)
{
    (void)state;
    static const double threshold[] = {1, 0.5, 0};
    const lrcsi_areas none = {.visible = NULL};
    for (int i = 0; i < 3; i++) {
        summed s;
        any_scene();
        prepare(LRCS_METHOD_FACET, &s);
        s.plan.grazing_cos = threshold[i];
        for (uint32_t f = 0; f < FACETS; f++) {
            lrcsi_incidence incidence = lrcsi_view_incidence(&s.view, f);
            area[f] = lrcsi_visible_area_unshadowed(&incidence, threshold[i]);
        }
        const lrcsi_total got = sum_up(&s, &none);
        const plain_total want = plain_sum(&s, area);
        check_sigma(&got, &want);
        check_rel(got.projected, (double)want.projected, 1e-13);
        check_rel(got.back_side, (double)want.back_side, 1e-13);
        check_rel(got.visibility, (double)want.visibility, 1e-8);
        assert_int_equal(got.hidden, 0);
        assert_int_equal(got.partial, 0);
        assert_int_equal(got.back_sides, want.back_sides);
    }
}

static void records_add_up_and_say_what_each_facet_adds(void **state)
{
    (void)state;
    summed s;
    any_scene();
    prepare(LRCS_METHOD_EXACT, &s);
    any_areas(&s);
    const lrcsi_areas areas = {.visible = area};
    const lrcsi_total got = sum_up(&s, &areas);
    double sigma = 0;
    double glint = 0;
    for (uint32_t f = 0; f < FACETS; f++) {
        long double cosine;
        plain_total want = {0};
        lrcsi_visible_area seen = lrcsi_visible_area_exact(record[f].visible_area_m2);
        plain_add(&s, f, &seen, &want);
        check_rel(record[f].area_m2, (double)plain_area(&s, f, &cosine), 1e-14);
        check_abs(record[f].cos_theta, (double)cosine, 1e-15);
        check_same(record[f].visible_area_m2, lrcsi_prepared_area(s.prepared, area[f].area));
        check_rel(record[f].sigma_m2, (double)(want.glint + want.diffuse), 1e-11);
        check_rel(record[f].sigma_glint_m2, (double)want.glint, 1e-11);
        sigma += record[f].sigma_m2;
        glint += record[f].sigma_glint_m2;
    }
    check_rel(sigma, got.glint + got.diffuse, 1e-13);
    check_rel(glint, got.glint, 1e-13);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_facets_with_any_areas_follow_the_plain_loop),
        cmocka_unit_test(two_plates_add_what_is_visible_of_each),
        cmocka_unit_test(the_error_of_given_areas_is_in_the_bound),
        cmocka_unit_test(a_facet_in_a_packet_and_alone_adds_the_same_within_both_bounds),
        cmocka_unit_test(answers_stand_for_areas),
        cmocka_unit_test(without_areas_all_is_visible_and_what_may_be_hidden_is_a_bound),
        cmocka_unit_test(records_add_up_and_say_what_each_facet_adds),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
