/* SPDX-License-Identifier: MIT */
/* Names and checks of shapes: every dimension that a kind uses is read, every other refused. */
#include <lrcs/shape.h>

#include <math.h>
#include <string.h>

#include "check.h"

static void names_lead_back_to_their_kinds(void **state)
{
    (void)state;
    for (int kind = 0; kind < LRCS_SHAPE_KINDS; kind++) {
        assert_non_null(lrcs_shape_text(kind));
        assert_int_equal(lrcs_shape_find(lrcs_shape_text(kind)), kind);
    }
    assert_null(lrcs_shape_text(-1));
    assert_null(lrcs_shape_text(LRCS_SHAPE_KINDS));
    assert_int_equal(lrcs_shape_find("torus"), LRCS_E_NAME);
    assert_int_equal(lrcs_shape_find("Disc"), LRCS_E_NAME);
    assert_int_equal(lrcs_shape_find(""), LRCS_E_NAME);
    assert_int_equal(lrcs_shape_find(NULL), LRCS_E_NAME);
}

/* The dimensions of a shape by number, 0 .. 6, and their names. */
static double *dimension(lrcs_shape *shape, int i)
{
    double *list[] = {&shape->size[0], &shape->size[1], &shape->size[2],       &shape->radius,
                      &shape->radius2, &shape->length,  &shape->half_angle_deg};
    return list[i];
}
static const char *const item[] = {"size, 1st number", "size, 2nd number", "size, 3rd number",
                                   "radius",           "radius2",          "length",
                                   "half_angle_deg"};

/* A good shape of each kind. */
static const lrcs_shape good[] = {
    {.kind = LRCS_SHAPE_PLATE, .size = {1, 2}},
    {.kind = LRCS_SHAPE_DISC, .radius = 1},
    {.kind = LRCS_SHAPE_BOX, .size = {1, 2, 3}},
    {.kind = LRCS_SHAPE_SPHERE, .radius = 1},
    {.kind = LRCS_SHAPE_DOME, .radius = 1, .parts = LRCS_SHAPE_WALL},
    {.kind = LRCS_SHAPE_CYLINDER, .radius = 1, .length = 2},
    {.kind = LRCS_SHAPE_CONE, .radius = 1, .length = 2},
    {.kind = LRCS_SHAPE_CONE, .radius = 1, .half_angle_deg = 15},
    {.kind = LRCS_SHAPE_FRUSTUM, .radius = 1, .radius2 = 2, .length = 3},
    {.kind = LRCS_SHAPE_PARABOLOID, .radius = 1, .length = 2},
};
#define GOOD (sizeof good / sizeof good[0])

static void good_shapes_pass_with_any_length_zero(void **state)
{
    (void)state;
    for (size_t g = 0; g < GOOD; g++) {
        lrcs_shape shape = good[g];
        assert_int_equal(lrcs_shape_check(&shape, NULL), LRCS_OK);
        for (int i = 0; i < 6; i++) {
            shape = good[g];
            int lost = shape.kind == LRCS_SHAPE_CONE && i == 5 && shape.half_angle_deg == 0.0;
            *dimension(&shape, i) = 0.0;
            assert_int_equal(lrcs_shape_check(&shape, NULL), lost ? LRCS_E_ARGUMENT : LRCS_OK);
        }
    }
}

static void bad_numbers_are_named(void **state)
{
    (void)state;
    const double bad[] = {(double)NAN, HUGE_VAL, -HUGE_VAL, -1.0, 1.1e100, -1e-300};
    for (size_t g = 0; g < GOOD; g++) {
        for (int i = 0; i < 7; i++) {
            for (size_t b = 0; b < sizeof bad / sizeof bad[0]; b++) {
                lrcs_shape shape = good[g];
                lrcs_where where = {0};
                int used = *dimension(&shape, i) != 0.0;
                *dimension(&shape, i) = bad[b];
                int status = lrcs_shape_check(&shape, &where);
                assert_int_equal(status == LRCS_E_NUMBER ||
                                     (status == LRCS_E_ARGUMENT && !used && isfinite(bad[b])),
                                 1);
                assert_string_equal(where.item, item[i]);
                assert_true(strlen(where.expected) > 0 && strlen(where.found) > 0);
            }
        }
    }
}

static void dimensions_of_other_kinds_are_refused(void **state)
{
    (void)state;
    for (size_t g = 0; g < GOOD; g++) {
        for (int i = 0; i < 7; i++) {
            lrcs_shape shape = good[g];
            lrcs_where where = {0};
            if (*dimension(&shape, i) != 0.0) {
                continue;
            }
            *dimension(&shape, i) = 1.0;
            assert_int_equal(lrcs_shape_check(&shape, &where), LRCS_E_ARGUMENT);
            assert_non_null(where.item);
        }
    }
}

static void a_cone_has_half_angle_or_length_but_not_both(void **state)
{
    (void)state;
    lrcs_where where = {0};
    lrcs_shape cone = {.kind = LRCS_SHAPE_CONE, .radius = 1, .length = 1, .half_angle_deg = 45};
    assert_int_equal(lrcs_shape_check(&cone, &where), LRCS_E_ARGUMENT);
    cone.half_angle_deg = cone.length = 0.0;
    assert_int_equal(lrcs_shape_check(&cone, &where), LRCS_E_ARGUMENT);
    cone.half_angle_deg = 90.0;
    assert_int_equal(lrcs_shape_check(&cone, &where), LRCS_E_NUMBER);
    cone.half_angle_deg = 89.999999999999986;
    assert_int_equal(lrcs_shape_check(&cone, &where), LRCS_OK);
    cone.half_angle_deg = 1e-110; /* longer than 1e100 m */
    assert_int_equal(lrcs_shape_check(&cone, &where), LRCS_E_NUMBER);
}

static void unknown_kinds_and_parts_are_refused(void **state)
{
    (void)state;
    lrcs_where where = {0};
    lrcs_shape shape = good[3];
    for (int kind = -1; kind <= LRCS_SHAPE_KINDS; kind += LRCS_SHAPE_KINDS + 1) {
        shape.kind = kind;
        assert_int_equal(lrcs_shape_check(&shape, &where), LRCS_E_ARGUMENT);
        assert_string_equal(where.item, "kind");
    }
    shape = good[3];
    shape.parts = 2;
    assert_int_equal(lrcs_shape_check(&shape, &where), LRCS_E_ARGUMENT);
    assert_string_equal(where.item, "parts");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_lead_back_to_their_kinds),
        cmocka_unit_test(good_shapes_pass_with_any_length_zero),
        cmocka_unit_test(bad_numbers_are_named),
        cmocka_unit_test(dimensions_of_other_kinds_are_refused),
        cmocka_unit_test(a_cone_has_half_angle_or_length_but_not_both),
        cmocka_unit_test(unknown_kinds_and_parts_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
