/* SPDX-License-Identifier: MIT */
/* sigma over curved normals: round bodies from coarse models against their closed forms, under
   shadow, by every method; and what must not change where nothing is curved. */
#include "build3ds.h"
#include "curved.h"

static char text[CURVED_TEXT];

/* The same cylinder as 3DS bytes: floats, one mesh, wall in smoothing group 1, caps hard. */
static void cylinder_3ds(build3ds *b, unsigned n, double radius, double length)
{
    unsigned faces = 4 * n - 4;
    build3ds_begin(b);
    build3ds_mesh(b, "can");
    build3ds_open(b, 0x4110);
    build3ds_u16(b, 2 * n);
    for (unsigned i = 0; i < 2 * n; i++) {
        double a = 2 * CURVED_PI * (i % n) / n;
        build3ds_float(b, (float)(radius * cos(a)));
        build3ds_float(b, (float)(radius * sin(a)));
        build3ds_float(b, (float)((i < n ? -0.5 : 0.5) * length));
    }
    build3ds_close(b);
    build3ds_open(b, 0x4120);
    build3ds_u16(b, faces);
    for (unsigned i = 0; i < faces; i++) {
        unsigned k = i / 2;
        unsigned j = (k + 1) % n;
        unsigned cap = k - n;
        unsigned wall[2][3] = {{k, j, n + j}, {k, n + j, n + k}};
        unsigned caps[2][3] = {{n, n + 1 + cap, n + 2 + cap}, {0, 2 + cap, 1 + cap}};
        for (int c = 0; c < 3; c++) {
            build3ds_u16(b, k < n ? wall[i % 2][c] : caps[i % 2][c]);
        }
        build3ds_u16(b, 7);
    }
    build3ds_open(b, 0x4150);
    for (unsigned i = 0; i < faces; i++) {
        build3ds_u32(b, i < 2 * n);
    }
    build3ds_end(b);
}

static curved_case cylinder_case(char form)
{
    static build3ds bytes;
    curved_case c;
    if (form == '3') {
        cylinder_3ds(&bytes, 24, 0.5, 2);
        curved_read(&c, bytes.bytes, bytes.size, 1);
    } else {
        curved_cylinder(text, 24, 0.5, 2, form);
        c = curved_obj(text);
    }
    c.brdf = (lrcs_brdf){1, 0.25, 0.05, 0.5};
    return c;
}

static double closed_cylinder(const lrcs_brdf *brdf, double aspect_deg)
{
    lrcs_shape shape = {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.5, .length = 2};
    lrcs_aspect aspect = {.deg = aspect_deg};
    lrcs_closed_form closed;
    assert_int_equal(lrcs_closed_eval(&shape, brdf, &aspect, &closed), LRCS_OK);
    return closed.sigma_m2;
}

/* 91 azimuths over two sides at broadside and at 80 deg from the axis: the largest error. */
static double worst_over_azimuths(curved_case *c, double aspect_deg)
{
    double want = closed_cylinder(&c->brdf, aspect_deg);
    double worst = 0;
    double sine = sin(aspect_deg * CURVED_PI / 180);
    for (int i = 0; i <= 90; i++) {
        double a = i * CURVED_PI / 180 / 3;
        const double direction[3] = {sine * cos(a), sine * sin(a),
                                     aspect_deg == 90 ? 0 : cos(aspect_deg * CURVED_PI / 180)};
        lrcs_result r = curved_run(c, direction, LRCS_METHOD_AUTO, 0);
        worst = fmax(worst, fabs(r.sigma_m2 / want - 1));
        if (r.curvature_estimate_m2 >= 0) {
            check_most(r.curvature_estimate_m2, 1e-4 * r.sigma_m2);
        }
    }
    return worst;
}

static void a_smooth_cylinder_of_24_sides_is_within_1_percent_where_flat_ones_swing(void **state)
{
    (void)state;
    static const char form[] = {'v', 's', '3'};
    for (size_t i = 0; i < sizeof form; i++) {
        curved_case c = cylinder_case(form[i]);
        curved_build(&c, LRCS_NORMALS_FLAT);
        assert_true(worst_over_azimuths(&c, 90) > 0.3);
        curved_build(&c, LRCS_NORMALS_SMOOTH);
        check_most(worst_over_azimuths(&c, 90), 0.01);
        check_most(worst_over_azimuths(&c, 80), 0.01);
        curved_build(&c, LRCS_NORMALS_AUTO);
        check_most(worst_over_azimuths(&c, 90), 0.01);
        curved_free(&c);
    }
}

/* The glint alone: over flat sides it is either present in full or absent, by azimuth. */
static void the_glint_of_flat_sides_swings_by_100_percent(void **state)
{
    (void)state;
    curved_case c = cylinder_case('v');
    c.brdf.B = 0;
    curved_build(&c, LRCS_NORMALS_FLAT);
    assert_true(worst_over_azimuths(&c, 90) > 1);
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    check_most(worst_over_azimuths(&c, 90), 0.01);
    curved_free(&c);
}

/* A sphere of n meridians and n / 2 belts, vertex normals radial. */
static void sphere_text(int n)
{
    text[0] = '\0';
    for (int b = 0; b <= n / 2; b++) {
        for (int k = 0; k < n; k++) {
            double t = CURVED_PI * b / (n / 2);
            double p = 2 * CURVED_PI * k / n;
            curved_line(text, "v %.17g %.17g %.17g\nvn %.17g %.17g %.17g", sin(t) * cos(p),
                        sin(t) * sin(p), -cos(t), sin(t) * cos(p), sin(t) * sin(p), -cos(t));
        }
    }
    for (int b = 0; b < n / 2; b++) {
        for (int k = 0; k < n; k++) {
            int i = b * n + k + 1;
            int j = b * n + (k + 1) % n + 1;
            curved_line(text, "f %d//%d %d//%d %d//%d %d//%d", i, i, j, j, j + n, j + n, i + n,
                        i + n);
        }
    }
}

/* Where a facet lies at the distance r <= 1 from the centre, its radial normals n turn over r^2 dn
   of projected area instead of dn. Quads of 15 deg lie between cos(10.6 deg) and 1: at a glint much
   narrower than a facet 3.4 % may be lost, nothing gained; the glint's own width blurs by s^2. */
static void a_smooth_sphere_is_within_what_its_chords_lose(void **state)
{
    (void)state;
    static const double direction[4][3] = {{1, 0, 0}, {0.3, 0.2, 0.9}, {0, 0, 1}, {1, 1, 0.2}};
    sphere_text(24);
    curved_case c = curved_obj(text);
    lrcs_shape shape = {.kind = LRCS_SHAPE_SPHERE, .radius = 1};
    lrcs_aspect aspect = {.deg = 0};
    for (int i = 0; i < 4; i++) {
        lrcs_closed_form closed;
        c.brdf = (lrcs_brdf){1, 0, 0.05, 0};
        assert_int_equal(lrcs_closed_eval(&shape, &c.brdf, &aspect, &closed), LRCS_OK);
        curved_build(&c, LRCS_NORMALS_SMOOTH);
        lrcs_result r = curved_run(&c, direction[i], LRCS_METHOD_AUTO, 0);
        check_most(0.966 * closed.sigma_m2, r.sigma_m2 * 1.003);
        check_most(r.sigma_m2, closed.sigma_m2 * 1.003);
        curved_build(&c, LRCS_NORMALS_FLAT);
        r = curved_run(&c, direction[i], LRCS_METHOD_AUTO, 0);
        assert_true(fabs(r.sigma_m2 / closed.sigma_m2 - 1) > 0.2);
    }
    curved_free(&c);
}

/* The cylinder, laser on +x, behind a plate that hides z > 0: facets lie on both sides of the
   shadow's edge, and half of sigma is left. */
static curved_case half_hidden(char form)
{
    curved_cylinder(text, 24, 0.5, 2, form);
    curved_line(text, "v 2 -3 0\nv 2 3 0\nv 2 3 3\nv 2 -3 3\ns off\nf 52 51 50 49\nf 49 50 51 52");
    curved_case c = curved_obj(text);
    c.brdf = (lrcs_brdf){1, 0.25, 0.05, 0.5};
    return c;
}

/* The front skin of the plate, of 18 m^2. */
static double plate_sigma(const curved_case *c)
{
    return c->record[c->scene.facet_count - 4].sigma_m2 +
           c->record[c->scene.facet_count - 3].sigma_m2 +
           c->record[c->scene.facet_count - 2].sigma_m2 +
           c->record[c->scene.facet_count - 1].sigma_m2;
}

static void half_of_a_cylinder_behind_a_plate_is_half_of_its_sigma(void **state)
{
    (void)state;
    for (int i = 0; i < 30; i++) {
        double a = 0.01 + 0.009 * i;
        const double direction[3] = {cos(a), sin(a), 0};
        curved_case c = half_hidden('v');
        curved_build(&c, LRCS_NORMALS_SMOOTH);
        lrcs_result r = curved_run(&c, direction, LRCS_METHOD_EXACT, 0);
        double shadowed = r.sigma_m2 - plate_sigma(&c);
        curved_free(&c);
        c = cylinder_case('v');
        curved_build(&c, LRCS_NORMALS_SMOOTH);
        lrcs_result alone = curved_run(&c, direction, LRCS_METHOD_AUTO, 0);
        curved_free(&c);
        check_abs(shadowed, 0.5 * alone.sigma_m2,
                  r.bound_m2 + alone.bound_m2 + r.curvature_estimate_m2 +
                      alone.curvature_estimate_m2);
        check_most(r.bound_m2, 1e-9 * r.sigma_m2);
    }
}

static void methods_agree_within_bounds_and_estimates(void **state)
{
    (void)state;
    for (int i = 0; i < 12; i++) {
        double a = 0.4 + 0.05 * i;
        const double direction[3] = {cos(a), sin(a), 0.2 * sin(3.0 * i)};
        curved_case c = half_hidden(i % 2 ? 's' : 'v');
        c.two_sided = i % 3 == 0;
        curved_build(&c, LRCS_NORMALS_SMOOTH);
        lrcs_result exact = curved_run(&c, direction, LRCS_METHOD_EXACT, 0);
        for (uint32_t size = 32; size <= 512; size *= 4) {
            lrcs_result raster = curved_run(&c, direction, LRCS_METHOD_ZBUFFER, size);
            check_abs(raster.sigma_m2, exact.sigma_m2,
                      raster.bound_m2 + exact.bound_m2 + raster.curvature_estimate_m2 +
                          exact.curvature_estimate_m2);
            check_most(raster.bound_m2, 8.0 / size * raster.sigma_m2);
        }
        lrcs_result facet = curved_run(&c, direction, LRCS_METHOD_FACET, 0);
        check_abs(facet.sigma_m2, exact.sigma_m2,
                  facet.bound_m2 + exact.bound_m2 + facet.curvature_estimate_m2 +
                      exact.curvature_estimate_m2);
        curved_free(&c);
    }
}

/* Normals that differ from the facet's own by rounding, or not at all, leave it flat. */
static void normals_equal_to_the_facets_own_change_nothing(void **state)
{
    (void)state;
    static const double direction[3] = {0.3, 0.4, 0.9};
    curved_case c = curved_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 3\ns 1\n"
                               "f 1//1 2//1 3//1 4//1\nf 4 3 2 1\n");
    curved_build(&c, LRCS_NORMALS_FLAT);
    lrcs_result flat = curved_run(&c, direction, LRCS_METHOD_EXACT, 0);
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    lrcs_result smooth = curved_run(&c, direction, LRCS_METHOD_EXACT, 0);
    assert_int_equal(smooth.effect[LRCS_EFFECT_CURVED_NORMALS].on, 0);
    check_same(smooth.sigma_m2, flat.sigma_m2);
    check_same(smooth.curvature_estimate_m2, -1);
    curved_free(&c);
}

/* Nearly equal normals are integrated as curved ones, with the same sigma. */
static void normals_a_millionth_of_a_millionth_off_change_sigma_by_no_more(void **state)
{
    (void)state;
    static const double direction[3] = {0.3, 0.4, 0.9};
    curved_case c = curved_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 1e-11 0 1\nvn 0 0 1\n"
                               "f 1//1 2//2 3//2 4//2\n");
    curved_build(&c, LRCS_NORMALS_FLAT);
    lrcs_result flat = curved_run(&c, direction, LRCS_METHOD_AUTO, 0);
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    assert_non_null(c.scene.corner_normal);
    for (int method = LRCS_METHOD_ZBUFFER; method <= LRCS_METHOD_EXACT; method++) {
        lrcs_result smooth = curved_run(&c, direction, method, 0);
        check_rel(smooth.sigma_m2, flat.sigma_m2, 1e-9);
        check_rel(smooth.sigma_glint_m2, flat.sigma_glint_m2, 1e-9);
        check_most(smooth.bound_m2, 1e-9 * flat.sigma_m2);
    }
    curved_free(&c);
}

static void flat_is_the_same_to_the_bit_whatever_the_file_says_of_normals(void **state)
{
    (void)state;
    static const double direction[3] = {0.8, 0.55, 0.1};
    lrcs_result result[3];
    static const char form[] = {'f', 'v', 's'};
    for (int i = 0; i < 3; i++) {
        curved_case c = half_hidden(form[i]);
        curved_build(&c, LRCS_NORMALS_FLAT);
        assert_null(c.scene.corner_normal);
        result[i] = curved_run(&c, direction, LRCS_METHOD_AUTO, 0);
        check_same(result[i].sigma_m2, result[0].sigma_m2);
        check_same(result[i].bound_m2, result[0].bound_m2);
        check_same(result[i].curvature_estimate_m2, -1);
        assert_int_equal(result[i].effect[LRCS_EFFECT_CURVED_NORMALS].on, 0);
        curved_free(&c);
    }
}

/* A roof seen from behind, two-sided: as from the front. */
static void a_two_sided_back_reflects_with_its_normals_turned(void **state)
{
    (void)state;
    double sigma[2][2];
    for (int i = 0; i < 4; i++) {
        const double direction[3] = {0.1, 0.05, i % 2 ? -1 : 1};
        curved_case c = curved_obj("v 0 0 0\nv 0 1 0\nv -1 0 0\nv -1 1 0\nv 1 0 0\nv 1 1 0\n"
                                   "vn 0 0 1\nvn -0.3 0 1\nvn 0.3 0 1\n"
                                   "f 1//1 2//1 4//2 3//2\nf 2//1 1//1 5//3 6//3\n");
        c.two_sided = i / 2;
        c.brdf.s = 0.1;
        curved_build(&c, LRCS_NORMALS_SMOOTH);
        sigma[i / 2][i % 2] = curved_run(&c, direction, LRCS_METHOD_AUTO, 0).sigma_m2;
        curved_free(&c);
    }
    check_same(sigma[0][1], 0);
    assert_true(sigma[0][0] > 0);
    check_same(sigma[1][0], sigma[0][0]);
    /* seen from behind, slopes about the laser's are turned by a half turn */
    check_rel(sigma[1][1], sigma[1][0], 0.5);
    assert_true(sigma[1][1] > 0.1 * sigma[1][0]);
}

/* A tolerance that no cubature serves: the estimate, not the bound, is what misses it. */
static void an_estimate_above_the_tolerance_is_a_tolerance_not_met(void **state)
{
    (void)state;
    static const double direction[3] = {1, 0.1, 0};
    curved_case c = cylinder_case('v');
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    c.tolerance = 1e-11;
    lrcs_result r = curved_run(&c, direction, LRCS_METHOD_EXACT, 0);
    assert_true(r.curvature_estimate_m2 > 1e-11 * r.sigma_m2);
    check_most(r.bound_m2, 1e-11 * r.sigma_m2);
    assert_true(r.flags & LRCS_FLAG_TOLERANCE_NOT_MET);
    c.tolerance = 1e-4;
    r = curved_run(&c, direction, LRCS_METHOD_AUTO, 0);
    assert_false(r.flags & LRCS_FLAG_TOLERANCE_NOT_MET);
    curved_free(&c);
}

/* A shape stays flat beside a model that does not, and the reasons say what was done. */
static void effects_tell_what_was_curved_and_why(void **state)
{
    (void)state;
    static const double direction[3] = {1, 0.1, 0};
    curved_case c = cylinder_case('s');
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    lrcs_result r = curved_run(&c, direction, LRCS_METHOD_AUTO, 0);
    assert_int_equal(r.effect[LRCS_EFFECT_CURVED_NORMALS].on, 1);
    assert_string_equal(r.effect[LRCS_EFFECT_CURVED_NORMALS].reason,
                        "smoothing groups or vertex normals, as requested");
    c.brdf.A = 0;
    curved_build(&c, LRCS_NORMALS_AUTO);
    r = curved_run(&c, direction, LRCS_METHOD_AUTO, 0);
    assert_int_equal(r.effect[LRCS_EFFECT_CURVED_NORMALS].on, 0);
    assert_string_equal(r.effect[LRCS_EFFECT_CURVED_NORMALS].reason,
                        "no model's facets turn too far for their glint");
    curved_free(&c);
    c = cylinder_case('f');
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    r = curved_run(&c, direction, LRCS_METHOD_AUTO, 0);
    assert_string_equal(r.effect[LRCS_EFFECT_CURVED_NORMALS].reason,
                        "no model has smoothing groups or vertex normals");
    curved_free(&c);
}

/* In a work area that grows byte by byte (in steps) until it suffices, never beyond the need. */
static void the_work_area_is_enough_and_less_is_refused_or_falls_back(void **state)
{
    (void)state;
    static const double direction[3] = {0.8, 0.55, 0.1};
    static const int methods[] = {LRCS_METHOD_FACET, LRCS_METHOD_EXACT, LRCS_METHOD_ZBUFFER};
    lrcs_pose pose;
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    curved_case c = half_hidden('v');
    curved_build(&c, LRCS_NORMALS_SMOOTH);
    for (int i = 0; i < 3; i++) {
        lrcs_run_options options = lrcs_run_options_default();
        options.method = methods[i];
        options.resolution = 16;
        size_t need = lrcs_sigma_need(c.prepared, &options);
        for (size_t size = 0; size <= need; size += size + 4999 < need ? 4999 : need - size + 1) {
            unsigned char *area = malloc(size + 1);
            lrcs_work work = lrcs_work_make(area, size);
            lrcs_result result = {.sigma_m2 = -7};
            int status = lrcs_sigma_run(c.prepared, &pose, &options, &work, &result, NULL, NULL);
            assert_true(status == LRCS_OK || (status == LRCS_E_MEMORY && result.sigma_m2 == -7));
            assert_int_equal(work.used, 0);
            free(area);
        }
        unsigned char *area = malloc(need);
        lrcs_work work = lrcs_work_make(area, need);
        lrcs_result result;
        assert_int_equal(lrcs_sigma_run(c.prepared, &pose, &options, &work, &result, NULL, NULL),
                         LRCS_OK);
        assert_false(result.flags & LRCS_FLAG_MEMORY_FALLBACK);
        free(area);
    }
    curved_free(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_smooth_cylinder_of_24_sides_is_within_1_percent_where_flat_ones_swing),
        cmocka_unit_test(the_glint_of_flat_sides_swings_by_100_percent),
        cmocka_unit_test(a_smooth_sphere_is_within_what_its_chords_lose),
        cmocka_unit_test(half_of_a_cylinder_behind_a_plate_is_half_of_its_sigma),
        cmocka_unit_test(methods_agree_within_bounds_and_estimates),
        cmocka_unit_test(normals_equal_to_the_facets_own_change_nothing),
        cmocka_unit_test(normals_a_millionth_of_a_millionth_off_change_sigma_by_no_more),
        cmocka_unit_test(flat_is_the_same_to_the_bit_whatever_the_file_says_of_normals),
        cmocka_unit_test(a_two_sided_back_reflects_with_its_normals_turned),
        cmocka_unit_test(an_estimate_above_the_tolerance_is_a_tolerance_not_met),
        cmocka_unit_test(effects_tell_what_was_curved_and_why),
        cmocka_unit_test(the_work_area_is_enough_and_less_is_refused_or_falls_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
