/* SPDX-License-Identifier: MIT */
/* Which shapes are proved clear: pairs placed so that the answer is plain, whichever way the pair
   is turned. A proof may be missed, but not where these tests ask for it. */
#include "view/clear.h"

#include <string.h>

#include <lrcs/lrcs.h>

#include "base/rotate.h"
#include "check.h"

#define ROWS(a) (sizeof(a) / sizeof(a)[0])

static unsigned char scene_area[1u << 22];
static unsigned char run_area[1u << 24];

static const lrcs_shape ball = {.kind = LRCS_SHAPE_SPHERE, .radius = 0.5};
static const lrcs_shape post = {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.25, .length = 1};
static const lrcs_shape cone = {.kind = LRCS_SHAPE_CONE, .radius = 0.5, .half_angle_deg = 30};
static const lrcs_shape dome = {.kind = LRCS_SHAPE_DOME, .radius = 0.5};
static const lrcs_shape horn = {
    .kind = LRCS_SHAPE_FRUSTUM, .radius = 0.5, .radius2 = 0.25, .length = 1};
static const lrcs_shape dish = {.kind = LRCS_SHAPE_PARABOLOID, .radius = 0.5, .length = 0.25};
static const lrcs_shape plate = {.kind = LRCS_SHAPE_PLATE, .size = {4, 4}};
static const lrcs_shape box = {.kind = LRCS_SHAPE_BOX, .size = {1, 1, 1}};

typedef struct clear_case {
    const lrcs_shape *first, *other;
    double at[3];        /* of the other */
    double direction[3]; /* in the frame in which the first stands upright at the origin */
    int clear;           /* the first */
} clear_case;

static const clear_case clear_cases[] = {
    {&ball, &plate, {0, 0, -1}, {0.1, 0.2, 1}, 1},
    {&ball, &plate, {0, 0, -1}, {0.1, 0.2, -1}, 0},
    {&ball, &plate, {0, 0, 1}, {0.1, 0.2, 1}, 0},
    {&ball, &plate, {0, 0, -0.5}, {0.1, 0.2, 1}, 1}, /* it rests there */
    {&ball, &plate, {0, 0, -0.5}, {1, 0.2, 0x1p-40}, 1},
    {&ball, &plate, {0, 0, -0.5}, {1, 0.2, -0.01}, 0},
    {&ball, &plate, {0, 0, -0.499}, {0.1, 0.2, 1}, 0}, /* it is sunk in */
    {&post, &plate, {0, 0, 0}, {0.1, 0.2, 1}, 1},
    {&post, &plate, {0, 0, 0}, {1, 0.2, 0}, 1},
    {&post, &plate, {0, 0, 0}, {0.1, 0.2, -1}, 0},
    {&post, &plate, {0, 0, 0.5}, {0.1, 0.2, 1}, 0},
    {&post, &plate, {0, 0, 1}, {0.1, 0.2, -1}, 1},
    {&cone, &box, {0, 0, -0.5}, {1, 1, 1}, 1},
    {&cone, &box, {0, 0, -0.5}, {1, 1, -1}, 0},
    {&dome, &box, {0, 0, -0.5}, {1, 0, 0}, 1},
    {&horn, &box, {0, 0, -0.5}, {1, 0, 0.001}, 1},
    {&dish, &box, {0, 0, -0.5}, {0, 0, 1}, 1},
    {&dish, &box, {0, 0, 0.7}, {0, 0, 1}, 0},
    {&dish, &ball, {0, 0, 0.7}, {1, 0, 0.1}, 0}, /* sunk in */
    {&post, &post, {3, 0, 0}, {0, 0, 1}, 1},
    {&post, &post, {3, 0, 0}, {0.3, 1, 0.3}, 1},
    {&post, &post, {3, 0, 0}, {1, 0, 0}, 0},
    {&post, &post, {3, 0, 0}, {-1, 0, 0}, 1},
    {&post, &post, {3, 0, 0}, {1, 0, 3}, 1}, /* the shadow is shorter */
    {&post, &post, {3, 0, 0}, {1, 0, 0.25}, 0},
    {&post, &post, {0, 0, 1}, {1, 1, 1}, 0},
    {&post, &post, {0, 0, 1}, {1, 1, -1}, 1},
    {&post, &post, {0.5, 0, 0}, {0, 1, 0}, 0}, /* side by side they touch along a line */
    {&ball, &ball, {1, 0, 0}, {0, 1, 0}, 1},
    {&ball, &ball, {1, 0, 0}, {1, 1, 0}, 0},
    {&ball, &ball, {0.25, 0, 0}, {0, 1, 0}, 0},
    {&ball, &ball, {0, 0, 0}, {0, 1, 0}, 0},
};

/* Is part 0 of two, both turned by R, clear, seen along R d? */
static int clear_run(const clear_case *c, const double R[3][3], double shift)
{
    lrcs_recipe_part part[2] = {
        {.name = "a", .shape = *c->first, .place = lrcs_place_default(), .material_index = -1},
        {.name = "b", .shape = *c->other, .place = lrcs_place_default(), .material_index = -1}};
    lrcs_recipe recipe = {.part = part, .part_count = 2};
    const lrcs_build_options build = {1e-1, 1u << 11, LRCS_NORMALS_FLAT, 0, 0};
    lrcs_work work = lrcs_work_make(scene_area, sizeof scene_area);
    const lrcs_prepared *prepared;
    lrcs_scene scene;
    lrcs_pose pose;
    lrcsi_view view;
    lrcsi_clear clear;
    double d[3];
    for (int k = 0; k < 3; k++) {
        d[k] = R[k][0] * c->direction[0] + R[k][1] * c->direction[1] + R[k][2] * c->direction[2];
        part[0].place.translate[k] = shift;
        part[1].place.translate[k] =
            shift + R[k][0] * c->at[0] + R[k][1] * c->at[1] + R[k][2] * c->at[2];
    }
    memcpy(part[0].place.rotate, R, sizeof part[0].place.rotate);
    memcpy(part[1].place.rotate, R, sizeof part[1].place.rotate);
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &build, &work, &scene, NULL), LRCS_OK);
    work = lrcs_work_make(run_area, sizeof run_area);
    assert_int_equal(lrcs_prepare_run(&scene, &work, &prepared), LRCS_OK);
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_face(prepared, &pose,
                                     (lrcsi_view_backs){!prepared->solid, !prepared->solid}, &work,
                                     &view),
                     LRCS_OK);
    size_t before = work.used;
    work.peak = work.used;
    assert_int_equal(lrcsi_clear_make(&view, &work, &clear), LRCS_OK);
    assert_true(work.peak - before <= lrcsi_clear_need(prepared));
    assert_int_equal(clear.count, clear.part[0] + clear.part[1]);
    if (clear.part[0]) { /* at most a rim of rounding may be hidden */
        check_most(clear.slab[0], 1e-12);
    }
    return clear.part[0];
}

static void pairs_are_clear_or_not_as_they_stand(void **state)
{
    (void)state;
    static const double upright[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (size_t i = 0; i < ROWS(clear_cases); i++) {
        if (clear_run(&clear_cases[i], upright, 0) != clear_cases[i].clear) {
            fail_msg("case %lu", (unsigned long)i);
        }
    }
}

/* Whatever rounding does to where they stand, what touches is told from what does not. */
static void turning_a_pair_with_the_laser_changes_nothing(void **state)
{
    (void)state;
    for (size_t i = 0; i < ROWS(clear_cases); i++) {
        for (int turn = 0; turn < 8; turn++) {
            const double deg[3] = {37 * turn + 5, 11 * turn + 20, 50 * turn + 1};
            double R[3][3];
            assert_int_equal(lrcsi_rotate_euler("XYZ", deg, R), LRCS_OK);
            if (clear_run(&clear_cases[i], (const double(*)[3])R, turn % 3) !=
                clear_cases[i].clear) {
                fail_msg("case %lu, turn %d", (unsigned long)i, turn);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_are_clear_or_not_as_they_stand),
        cmocka_unit_test(turning_a_pair_with_the_laser_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
