/* SPDX-License-Identifier: MIT */
/* The planner against scenes made to deceive it, whose visibility is known exactly
   (test/vectors/planner.py): no effect is off that matters there, none is on that is proved not to,
   and every answer, with what the planner leaves out or without, holds the truth. */
#include "scenes.h"

#define MOST 32

typedef struct planner_case {
    const char *name;
    int off; /* effects that must be off: 1 self-shadowing, 2 back-face casters */
    uint32_t vertices, facets;
    double direction[3];
    lrcs_point vertex[MOST];
    lrcs_facet facet[MOST];
    uint32_t body[MOST];    /* the material */
    long double seen[MOST]; /* visible projected area */
    long double cos2[MOST]; /* negative for a back side, 0 edge-on */
} planner_case;

static const planner_case cases[] = {
#include "../vectors/planner.inc"
};
#define CASES  (sizeof cases / sizeof *cases)
#define EXTENT 3.0 /* coordinates lie within -0.5 .. 2 */

/* The materials of the two bodies. */
static const struct {
    double A[2], B[2];
    unsigned char two_sided;
} surfaces[] = {{{1, 1}, {0.25, 0.25}, 0}, {{1, 1}, {0.25, 0.25}, 1}, {{0, 1}, {0.25, 0.25}, 0},
                {{1, 0}, {0.25, 0.25}, 1}, {{1, 1}, {0, 0.25}, 1},    {{1, 0}, {0, 0.25}, 0}};
#define SURFACES (sizeof surfaces / sizeof *surfaces)

static test_scene scene;

static void scene_of(const planner_case *c, size_t w)
{
    scene_start(&scene);
    scene_material(&scene, 0, 0, 0.5, 0.5);
    for (uint32_t i = 0; i < 2; i++) {
        scene.material[i].brdf = (lrcs_brdf){surfaces[w].A[i], surfaces[w].B[i], 0.5, 0.5};
        scene.material[i].two_sided = surfaces[w].two_sided;
    }
    for (uint32_t v = 0; v < c->vertices; v++) {
        scene_vertex(&scene, c->vertex[v].x[0], c->vertex[v].x[1], c->vertex[v].x[2]);
    }
    for (uint32_t f = 0; f < c->facets; f++) {
        scene.assigned = c->body[f];
        scene_facet(&scene, c->facet[f].corner[0], c->facet[f].corner[1], c->facet[f].corner[2]);
    }
}

static int reflects(const planner_case *c, size_t w, uint32_t f)
{
    return c->cos2[f] > 0 || (c->cos2[f] < 0 && surfaces[w].two_sided);
}

/* Eq. 2 over the exact areas: glint and diffuse part. */
static void truth_of(const planner_case *c, size_t w, double part[2])
{
    long double sum[2] = {0, 0};
    for (uint32_t f = 0; f < c->facets; f++) {
        long double cos2 = fabsl(c->cos2[f]);
        if (reflects(c, w, f) && c->seen[f] > 0) {
            const lrcs_brdf *b = &scene.material[c->body[f]].brdf;
            const lrcs_brdf glint = {b->A, 0, b->s, b->m};
            const lrcs_brdf diffuse = {0, b->B, b->s, b->m};
            sum[0] += scene_eq2(&glint, c->seen[f] / sqrtl(cos2), cos2);
            sum[1] += scene_eq2(&diffuse, c->seen[f] / sqrtl(cos2), cos2);
        }
    }
    part[0] = (double)sum[0];
    part[1] = (double)sum[1];
}

static lrcs_result run_of(const planner_case *c, lrcs_run_options options)
{
    lrcs_work work;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    lrcs_pose pose;
    lrcs_result result;
    assert_int_equal(lrcs_pose_from_direction(c->direction, &pose), LRCS_OK);
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, &work, &result, scene.record, NULL),
                     LRCS_OK);
    return result;
}

/* Sigma, its parts and every visible area, against the truth. */
static void check_truth(const planner_case *c, size_t w, const lrcs_result *r)
{
    double part[2];
    truth_of(c, w, part);
    if (!(fabs(r->sigma_m2 - part[0] - part[1]) <= r->bound_m2 + 4e-16 * (part[0] + part[1]))) {
        fprintf(stderr, "%s, case %zu, materials %zu\n", c->name, (size_t)(c - cases), w);
    }
    check_bound(*r, part[0] + part[1]);
    check_abs(r->sigma_glint_m2, part[0], r->bound_m2 + 4e-16 * part[0]);
    check_abs(r->sigma_diffuse_m2, part[1], r->bound_m2 + 4e-16 * part[1]);
    for (uint32_t f = 0; f < c->facets; f++) {
        double whole = scene.record[f].area_m2 * fabs(scene.record[f].cos_theta);
        check_abs(scene.record[f].visible_area_m2, (double)c->seen[f],
                  1e-12 * whole + 1e-15 * EXTENT * EXTENT);
    }
}

static void planned_answers_hold_the_truth(void **state)
{
    (void)state;
    for (size_t i = 0; i < CASES; i++) {
        for (size_t w = 0; w < SURFACES; w++) {
            scene_of(&cases[i], w);
            lrcs_result r = run_of(&cases[i], lrcs_run_options_default());
            check_truth(&cases[i], w, &r);
            check_most(r.bound_m2, 1e-10 * (1e-3 + r.sigma_m2));
        }
    }
}

/* Everything on, by the exact method and by a raster; and each effect that is off, one by one. */
static void what_the_planner_leaves_out_changes_nothing(void **state)
{
    (void)state;
    for (size_t i = 0; i < CASES; i++) {
        for (size_t w = 0; w < SURFACES; w++) {
            lrcs_run_options options = lrcs_run_options_default();
            scene_of(&cases[i], w);
            const lrcs_result plain = run_of(&cases[i], options);
            options.with = LRCS_EFFECTS_SWITCHED;
            options.method = LRCS_METHOD_EXACT;
            lrcs_result r = run_of(&cases[i], options);
            check_truth(&cases[i], w, &r);
            check_abs(r.sigma_m2, plain.sigma_m2, r.bound_m2 + plain.bound_m2);
            options.method = LRCS_METHOD_ZBUFFER;
            options.resolution = 37;
            r = run_of(&cases[i], options);
            check_abs(r.sigma_m2, plain.sigma_m2, r.bound_m2 + plain.bound_m2);
            for (int e = 0; e < LRCS_EFFECTS; e++) {
                options = lrcs_run_options_default();
                options.with = 1u << e;
                if (!plain.effect[e].on && options.with & LRCS_EFFECTS_SWITCHED) {
                    r = run_of(&cases[i], options);
                    check_truth(&cases[i], w, &r);
                }
            }
        }
    }
}

/* What the exact areas say of an effect: does leaving it out change what is seen, or sigma? */
static int matters(const planner_case *c, size_t w, int effect)
{
    for (uint32_t f = 0; f < c->facets; f++) {
        long double whole = scene.record[f].area_m2 * fabs(scene.record[f].cos_theta);
        const lrcs_brdf *b = &scene.material[c->body[f]].brdf;
        int shines = reflects(c, w, f) && c->seen[f] > 0;
        if ((effect == LRCS_EFFECT_SELF_SHADOWING && c->cos2[f] > 0 &&
             c->seen[f] < whole * (1 - 1e-14L)) ||
            (effect == LRCS_EFFECT_BACK_FACE_CASTERS && c->cos2[f] < 0 && c->seen[f] > 0) ||
            (effect == LRCS_EFFECT_GLINT && shines && b->A > 0) ||
            (effect == LRCS_EFFECT_DIFFUSE && shines && b->B > 0) ||
            (effect == LRCS_EFFECT_TWO_SIDED && shines && c->cos2[f] < 0)) {
            return 1;
        }
    }
    return 0;
}

static void no_effect_is_off_that_matters(void **state)
{
    (void)state;
    uint32_t mattered[LRCS_EFFECTS] = {0};
    uint32_t spared[LRCS_EFFECTS] = {0};
    for (size_t i = 0; i < CASES; i++) {
        for (size_t w = 0; w < SURFACES; w++) {
            scene_of(&cases[i], w);
            lrcs_result r = run_of(&cases[i], lrcs_run_options_default());
            for (int e = 0; e < LRCS_EFFECTS; e++) {
                int needed = matters(&cases[i], w, e);
                if (needed && !r.effect[e].on) {
                    fprintf(stderr, "%s, case %zu, materials %zu: %s\n", cases[i].name, i, w,
                            lrcs_effect_text(e));
                }
                assert_true(r.effect[e].on || !needed);
                mattered[e] += needed != 0;
                spared[e] += !r.effect[e].on;
            }
        }
    }
    for (int e = 0; e < LRCS_EFFECTS; e++) { /* the scenes put each to the test, both ways */
        if (1u << e & LRCS_EFFECTS_SWITCHED) {
            assert_true(mattered[e] > 50);
            assert_true(spared[e] > 50);
        }
    }
}

static void effects_proved_not_to_matter_are_off(void **state)
{
    (void)state;
    for (size_t i = 0; i < CASES; i++) {
        for (size_t w = 0; w < SURFACES; w++) {
            scene_of(&cases[i], w);
            lrcs_result r = run_of(&cases[i], lrcs_run_options_default());
            assert_false(cases[i].off & 1 && r.effect[LRCS_EFFECT_SELF_SHADOWING].on);
            assert_false(cases[i].off & 2 && r.effect[LRCS_EFFECT_BACK_FACE_CASTERS].on);
            assert_false(cases[i].off & 2 && r.effect[LRCS_EFFECT_TWO_SIDED].on);
        }
    }
}

/* A material with a glint, but only on facets that are hidden: the effect is off in that pose, and
   on where a sliver an ulp wide shows it. */
static void a_glint_is_off_where_nothing_seen_has_it(void **state)
{
    (void)state;
    int hidden = 0;
    int slivers = 0;
    for (size_t i = 0; i < CASES; i++) {
        if (cases[i].direction[2] != 1 || cases[i].direction[0] != 0) {
            continue;
        }
        scene_of(&cases[i], 2); /* A = 0 in front, A > 0 behind */
        lrcs_result r = run_of(&cases[i], lrcs_run_options_default());
        if (strstr(cases[i].name, " behind another") && !strstr(cases[i].name, "a plate 0")) {
            assert_false(r.effect[LRCS_EFFECT_GLINT].on);
            assert_string_equal(r.effect[LRCS_EFFECT_GLINT].reason, "nothing seen has A > 0");
            check_same(r.sigma_glint_m2, 0);
            hidden++;
        } else if (strstr(cases[i].name, "covers but for an ulp")) {
            assert_true(r.effect[LRCS_EFFECT_GLINT].on);
            slivers++;
        }
    }
    assert_int_equal(hidden, 2);
    assert_int_equal(slivers, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planned_answers_hold_the_truth),
        cmocka_unit_test(what_the_planner_leaves_out_changes_nothing),
        cmocka_unit_test(no_effect_is_off_that_matters),
        cmocka_unit_test(effects_proved_not_to_matter_are_off),
        cmocka_unit_test(a_glint_is_off_where_nothing_seen_has_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
