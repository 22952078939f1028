/* SPDX-License-Identifier: MIT */
/* What holds of a placed shape by construction. */
#include "scene/build/placed_shape.h"

#include "check.h"

/* Scaled unlike along its axes only a plane keeps what is known of it: all four numbers are 0. */
static void curvature_outlives_uniform_scaling_only(void **state)
{
    (void)state;
    const lrcs_shape shape = {.kind = LRCS_SHAPE_CYLINDER, .radius = 1, .length = 1};
    const lrcs_divisions divisions = {8, 1, 0};
    for (int i = 0; i < 10; i++) {
        lrcs_patch_bounds bounds = {0, 0, 0, 0};
        double *const number[] = {&bounds.turn, &bounds.area_err, &bounds.bias, &bounds.rms_turn};
        lrcs_place place = lrcs_place_default();
        lrcs_joint joint = {0};
        lrcsi_placer placer;
        lrcs_part part;
        for (int k = 0; k < 3; k++) {
            place.scale[k] = k == 2 && i >= 5 ? 2 : -1;
        }
        if (i % 5 < 4) {
            *number[i % 5] = 1e-3;
        }
        assert_int_equal(lrcsi_placer_make(&place, &joint, &placer), LRCS_OK);
        lrcsi_placed_shape_describe(&shape, &divisions, &bounds, &placer, 1, &part);
        assert_int_equal(part.bounds.known, 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(curvature_outlives_uniform_scaling_only),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
