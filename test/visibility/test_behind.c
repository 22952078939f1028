/* SPDX-License-Identifier: MIT */
/* Which parts hide nothing of another: pairs placed so that the answer is plain, whichever way the
   pair is turned, in both roles; and what rounding leaves open of the facets where they touch. */
#include "visibility/behind.h"

#include <string.h>

#include <lrcs/lrcs.h>

#include "base/rotate.h"
#include "check.h"

#define ROWS(a) (sizeof(a) / sizeof(a)[0])

static unsigned char scene_area[1u << 22];
static unsigned char run_area[1u << 24];

static const lrcs_shape ball = {.kind = LRCS_SHAPE_SPHERE, .radius = 0.5};
static const lrcs_shape post = {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.25, .length = 1};
static const lrcs_shape drum = {.kind = LRCS_SHAPE_CYLINDER, .radius = 1, .length = 1};
static const lrcs_shape dome = {.kind = LRCS_SHAPE_DOME, .radius = 0.5};
static const lrcs_shape horn = {
    .kind = LRCS_SHAPE_FRUSTUM, .radius = 0.5, .radius2 = 0.25, .length = 1};
static const lrcs_shape dish = {.kind = LRCS_SHAPE_PARABOLOID, .radius = 0.5, .length = 0.25};
static const lrcs_shape box = {.kind = LRCS_SHAPE_BOX, .size = {1, 1, 1}};

typedef struct behind_case {
    const lrcs_shape *first, *other;
    double at[3];        /* of the other */
    double direction[3]; /* in the frame in which the first stands upright at the origin */
    int first_free;      /* the other hides nothing of the first */
    int other_free;      /* the first hides nothing of the other */
} behind_case;

static const behind_case behind_cases[] = {
    {&post, &drum, {0, 0, -1}, {0.1, 0.2, 1}, 1, 0}, /* it stands there */
    {&post, &drum, {0, 0, -1}, {0.1, 0.2, -1}, 0, 1},
    {&post, &drum, {0, 0, -0.999}, {0.1, 0.2, 1}, 0, 0}, /* it is sunk in */
    {&post, &drum, {0.75, 0, -1}, {1, 0.2, 0.1}, 1, 0},  /* their walls meet */
    {&post, &drum, {0, 0, -2}, {0.1, 0.2, 1}, 1, 0},
    {&dome, &drum, {0, 0, -1}, {1, 0.2, 0.1}, 1, 0},
    {&horn, &box, {0, 0, -0.5}, {1, 0, 0.001}, 1, 0},
    {&horn, &box, {0, 0, -0.5}, {1, 0, -0.001}, 0, 1},
    {&dish, &box, {0, 0, -0.5}, {0, 0, 1}, 1, 0},
    {&dish, &box, {0, 0, 0.75}, {0, 0, 1}, 0, 1},
    {&dish, &box, {0, 0, 0.7}, {0, 0, 1}, 0, 0},
    {&box, &post, {0.75, 0, -0.5}, {-1, 0.3, 0.2}, 0, 0}, /* the facets of the post may pierce it */
    {&box, &post, {0.8, 0, -0.5}, {-1, 0.3, 0.2}, 1, 0},
    {&ball, &box, {0, 0, -2}, {0.3, 0.3, 1}, 1, 0},
    {&ball, &box, {0, 0, 0}, {0.3, 0.3, 1}, 0, 0},
};

/* Is what rounding leaves open a small fraction of every facet that is not in the plane? */
static void check_fractions(const lrcsi_behind_proof *proof, const lrcs_prepared *p, uint32_t part)
{
    const lrcs_part *at = &p->scene->part[part];
    for (uint32_t f = at->first_facet; f < at->first_facet + at->facet_count; f++) {
        double fraction = lrcsi_behind_fraction(proof, p, f);
        double across = fabs(lrcsi_prepared_corner(p, f, 0)[0] * proof->n[0] +
                             lrcsi_prepared_corner(p, f, 0)[1] * proof->n[1] +
                             lrcsi_prepared_corner(p, f, 0)[2] * proof->n[2] - proof->level);
        int flat = across < 1e-9;
        for (int k = 1; k < 3 && flat; k++) {
            const double *x = lrcsi_prepared_corner(p, f, k);
            flat = fabs(x[0] * proof->n[0] + x[1] * proof->n[1] + x[2] * proof->n[2] -
                        proof->level) < 1e-9;
        }
        check_most(fraction, flat ? 1 : 1e-8);
    }
}

static void behind_run(const behind_case *c, const double R[3][3], double shift)
{
    lrcs_recipe_part part[2] = {
        {.name = "a", .shape = *c->first, .place = lrcs_place_default(), .material_index = -1},
        {.name = "b", .shape = *c->other, .place = lrcs_place_default(), .material_index = -1}};
    lrcs_recipe recipe = {.part = part, .part_count = 2};
    const lrcs_build_options build = {1e-1, 1u << 11, LRCS_NORMALS_FLAT, 0, 0, NULL};
    lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
    const lrcs_prepared *prepared;
    lrcs_scene scene;
    double d[3];
    double length = sqrt(c->direction[0] * c->direction[0] + c->direction[1] * c->direction[1] +
                         c->direction[2] * c->direction[2]);
    for (int k = 0; k < 3; k++) {
        d[k] = (R[k][0] * c->direction[0] + R[k][1] * c->direction[1] + R[k][2] * c->direction[2]) /
               length;
        part[0].place.translate[k] = shift;
        part[1].place.translate[k] =
            shift + R[k][0] * c->at[0] + R[k][1] * c->at[1] + R[k][2] * c->at[2];
    }
    memcpy(part[0].place.rotate, R, sizeof part[0].place.rotate);
    memcpy(part[1].place.rotate, R, sizeof part[1].place.rotate);
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &build, &work, &scene, NULL), LRCS_OK);
    work = lrcs_work_make(run_area, sizeof run_area);
    assert_int_equal(lrcs_prepare_run(&scene, &work, &prepared), LRCS_OK);
    lrcsi_body body[2] = {lrcsi_body_make(prepared, 0), lrcsi_body_make(prepared, 1)};
    for (int i = 0; i < 2; i++) {
        int known = i == 0 ? c->first_free : c->other_free;
        lrcsi_behind behind = lrcsi_behind_make(&body[i], &body[1 - i], d);
        if (behind.front.known != known || (behind.back.known && !known)) {
            fail_msg("case %ld, part %d", (long)(c - behind_cases), i);
        }
        if (behind.front.known) {
            check_fractions(&behind.front, prepared, (uint32_t)i);
        }
        if (behind.back.known) {
            check_fractions(&behind.back, prepared, (uint32_t)(1 - i));
        }
    }
}

static void what_is_behind_hides_nothing(void **state)
{
    (void)state;
    static const double upright[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (size_t i = 0; i < ROWS(behind_cases); i++) {
        behind_run(&behind_cases[i], upright, 0);
    }
}

static void a_turned_and_moved_pair_is_told_the_same(void **state)
{
    (void)state;
    for (int turn = 0; turn < 5; turn++) {
        double R[3][3];
        assert_int_equal(lrcsi_rotate_axis((const double[3]){0.3, -0.5, 0.8}, 10.0 + 70 * turn, R),
                         LRCS_OK);
        for (size_t i = 0; i < ROWS(behind_cases); i++) {
            behind_run(&behind_cases[i], (const double(*)[3])R, 0.1 * turn);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_behind_hides_nothing),
        cmocka_unit_test(a_turned_and_moved_pair_is_told_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
