/* SPDX-License-Identifier: MIT */
/* The planner: each effect is off where nothing depends on it and on where something does; what it
   leaves out changes sigma by no more than rounding; and scenes that are nearly convex or nearly
   closed do not deceive it. */
#include "scenes.h"

#include "scene/prepare.h"

static test_scene scene;
static const double oblique[3] = {0.5, 0.75, 1};

static void box(double x, double y, double z, double size)
{
    scene_box(&scene, (const double[3]){x, y, z}, (const double[3]){x + size, y + size, z + size});
}

static lrcs_result automatic(const double direction[3])
{
    return scene_run(&scene, direction, LRCS_METHOD_AUTO, 0);
}

static int on(const lrcs_result *r, int effect)
{
    assert_non_null(r->effect[effect].reason);
    assert_true(strlen(r->effect[effect].reason) > 5);
    return r->effect[effect].on;
}

static void self_shadowing_is_off_for_a_convex_body_alone(void **state)
{
    (void)state;
    scene_start(&scene);
    box(0, 0, 0, 1);
    lrcs_result r = automatic(oblique);
    assert_false(on(&r, LRCS_EFFECT_SELF_SHADOWING));
    assert_int_equal(r.method, LRCS_METHOD_FACET);
    assert_string_equal(r.method_reason, "proved a single convex body: nothing is hidden");
    box(3, 0, 0, 1);
    r = automatic(oblique);
    assert_true(on(&r, LRCS_EFFECT_SELF_SHADOWING));
    assert_int_equal(r.method, LRCS_METHOD_EXACT);
    r = scene_run(&scene, oblique, LRCS_METHOD_FACET, 0);
    assert_false(on(&r, LRCS_EFFECT_SELF_SHADOWING)); /* on request, and its bound says so */
    assert_string_equal(r.method_reason, "as requested");
    check_most(0.5 * r.sigma_m2, r.bound_m2);
}

static void back_faces_cast_unless_closed_and_outward(void **state)
{
    (void)state;
    scene_start(&scene);
    box(0, 0, 0, 1);
    box(0.5, 0, 2, 1);
    lrcs_result r = automatic(oblique);
    assert_false(on(&r, LRCS_EFFECT_BACK_FACE_CASTERS));
    scene.scene.facet_count--;
    r = automatic(oblique);
    assert_true(on(&r, LRCS_EFFECT_BACK_FACE_CASTERS));
}

static void terms_follow_the_materials_that_are_seen(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        scene_start(&scene);
        scene_material(&scene, i & 1, (i & 2) / 2, 0.2, 1);
        box(0, 0, 0, 1);
        scene_material(&scene, 5, 5, 0.2, 1)->omitted = 1; /* counts for nothing */
        box(5, 5, 5, 1);
        lrcs_result r = automatic(oblique);
        assert_int_equal(on(&r, LRCS_EFFECT_GLINT), i & 1);
        assert_int_equal(on(&r, LRCS_EFFECT_DIFFUSE), (i & 2) / 2);
        assert_true((r.sigma_glint_m2 > 0) == (i & 1));
        assert_true((r.sigma_diffuse_m2 > 0) == ((i & 2) != 0));
    }
}

/* A term that is off takes nothing from the other. */
static void terms_are_independent(void **state)
{
    (void)state;
    double part[3][2];
    static const double amplitude[3][2] = {{1, 0.25}, {1, 0}, {0, 0.25}};
    for (int i = 0; i < 3; i++) {
        scene_start(&scene);
        scene_material(&scene, amplitude[i][0], amplitude[i][1], 0.4, 1);
        box(0, 0, 0, 1);
        box(1.5, 0.5, 0.5, 1);
        lrcs_result r = automatic(oblique);
        part[i][0] = r.sigma_glint_m2;
        part[i][1] = r.sigma_diffuse_m2;
    }
    check_same(part[1][0], part[0][0]);
    check_same(part[1][1], 0);
    check_same(part[2][1], part[0][1]);
    check_same(part[2][0], 0);
}

static void two_sidedness_matters_only_where_backs_can_be_seen(void **state)
{
    (void)state;
    scene_start(&scene);
    scene.material[0].two_sided = 1;
    box(0, 0, 0, 1);
    lrcs_result closed = automatic(oblique);
    assert_false(on(&closed, LRCS_EFFECT_TWO_SIDED));
    scene.material[0].two_sided = 0;
    lrcs_result r = automatic(oblique);
    check_same(r.sigma_m2, closed.sigma_m2);
    assert_false(on(&r, LRCS_EFFECT_TWO_SIDED));

    scene_start(&scene); /* a plate from behind */
    scene_plate(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                (const double[3]){0, 1, 0});
    static const double behind[3] = {0.5, 0.75, -1};
    r = automatic(behind);
    check_same(r.sigma_m2, 0);
    assert_true(r.notices & LRCS_NOTICE_BACK_SIDES_VISIBLE);
    scene.material[0].two_sided = 1;
    r = automatic(behind);
    assert_true(on(&r, LRCS_EFFECT_TWO_SIDED));
    check_bound(r, (double)scene_eq2(&scene.material[0].brdf, 1, 16 / 29.0L));
    assert_int_equal(r.notices, 0);
}

static void articulation_follows_from_the_parts(void **state)
{
    (void)state;
    scene_start(&scene);
    box(0, 0, 0, 1);
    lrcs_result r = automatic(oblique);
    assert_false(on(&r, LRCS_EFFECT_ARTICULATION));
    assert_false(on(&r, LRCS_EFFECT_CURVED_NORMALS));
    scene.part.articulated = 1;
    lrcs_result turned = automatic(oblique);
    assert_true(on(&turned, LRCS_EFFECT_ARTICULATION));
    check_same(turned.sigma_m2, r.sigma_m2);
}

/* The planner's choice against the methods that leave nothing out. */
static void what_is_left_out_changes_nothing(void **state)
{
    (void)state;
    static const double direction[][3] = {{0, 0, 1}, {1, 1, 1}, {0.5, 0.75, 1}, {-3, 1, 0.01}};
    for (int bodies = 1; bodies <= 2; bodies++) {
        scene_start(&scene);
        scene.material[0].two_sided = 1;
        box(0, 0, 0, 1);
        if (bodies == 2) {
            box(0.5, 0.5, 2, 1);
        }
        for (int i = 0; i < 4; i++) {
            lrcs_result plain = automatic(direction[i]);
            lrcs_work work;
            lrcs_prepared prepared = *scene_prepare(&scene, &work);
            assert_true(prepared.solid);
            prepared.solid = prepared.convex = 0; /* nothing proved: all effects on */
            lrcs_result full =
                scene_pose(&scene, &prepared, &work, direction[i], LRCS_METHOD_EXACT, 0);
            assert_true(on(&full, LRCS_EFFECT_SELF_SHADOWING));
            assert_true(on(&full, LRCS_EFFECT_BACK_FACE_CASTERS));
            assert_true(on(&full, LRCS_EFFECT_TWO_SIDED));
            check_rel(plain.sigma_m2, full.sigma_m2, 1e-14);
            check_rel(plain.projected_area_m2, full.projected_area_m2, 1e-14);
            full = scene_pose(&scene, &prepared, &work, direction[i], LRCS_METHOD_ZBUFFER, 64);
            check_abs(plain.sigma_m2, full.sigma_m2, full.bound_m2 + plain.bound_m2);
        }
    }
}

/* A sphere with one corner pushed in by a little: seen along the dent's flank, facets hide others.
   The certificate may not leave that out, however little it is. */
static void nearly_convex_bodies_keep_their_shadows(void **state)
{
    (void)state;
    for (int power = 4; power <= 48; power += 4) {
        scene_start(&scene);
        scene_sphere(&scene, (const double[3]){0, 0, 0}, 1, 16);
        scene.vertex[57].x[0] *= 1 - ldexp(1, -power); /* an inner vertex of the upper half */
        scene.vertex[57].x[1] *= 1 - ldexp(1, -power);
        lrcs_work work;
        const lrcs_prepared *prepared = scene_prepare(&scene, &work);
        lrcs_prepared bare = *prepared;
        bare.solid = bare.convex = 0;
        for (int i = 0; i < 40; i++) { /* grazing the dent from around */
            double t = 0.157 * i;
            const double d[3] = {cos(t), sin(t), 0.4};
            lrcs_result r = scene_pose(&scene, prepared, &work, d, LRCS_METHOD_AUTO, 0);
            lrcs_result full = scene_pose(&scene, &bare, &work, d, LRCS_METHOD_EXACT, 0);
            check_abs(r.sigma_m2, full.sigma_m2, r.bound_m2 + full.bound_m2);
        }
        assert_false(prepared->convex);
    }
}

/* A box whose lid stands open by a hair. From (4, 0, 1) the gap shows the inside of the far wall,
   a quarter of its depth lower, and the sky above that. */
static void nearly_closed_bodies_keep_their_back_faces(void **state)
{
    (void)state;
    for (int two_sided = 0; two_sided < 2; two_sided++) {
        for (int power = 1; power <= 50; power += 7) {
            double gap = ldexp(1, -power);
            scene_start(&scene);
            scene.material[0].two_sided = (unsigned char)two_sided;
            box(0, 0, 0, 1);
            scene.scene.facet_count = 10;
            scene_plate(&scene, (const double[3]){0, 0, 1 + gap}, (const double[3]){1, 0, 0},
                        (const double[3]){0, 1, 0});
            lrcs_result r = automatic((const double[3]){4, 0, 1});
            assert_true(on(&r, LRCS_EFFECT_BACK_FACE_CASTERS));
            assert_true(on(&r, LRCS_EFFECT_SELF_SHADOWING));
            double inside = fmin(gap, 0.25);
            const lrcs_brdf *b = &scene.material[0].brdf;
            double want = (double)(scene_eq2(b, 1, 1 / 17.0L) +
                                   scene_eq2(b, 1 + two_sided * inside, 16 / 17.0L));
            check_bound(r, want);
            check_most(r.bound_m2, 1e-11 * want);
            check_abs(r.back_side_area_m2, two_sided ? 0 : inside * 4 / sqrt(17), 1e-12);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(self_shadowing_is_off_for_a_convex_body_alone),
        cmocka_unit_test(back_faces_cast_unless_closed_and_outward),
        cmocka_unit_test(terms_follow_the_materials_that_are_seen),
        cmocka_unit_test(terms_are_independent),
        cmocka_unit_test(two_sidedness_matters_only_where_backs_can_be_seen),
        cmocka_unit_test(articulation_follows_from_the_parts),
        cmocka_unit_test(what_is_left_out_changes_nothing),
        cmocka_unit_test(nearly_convex_bodies_keep_their_shadows),
        cmocka_unit_test(nearly_closed_bodies_keep_their_back_faces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
