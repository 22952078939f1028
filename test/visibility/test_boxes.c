/* SPDX-License-Identifier: MIT */
/* Boxes of meshlets in the view. */
#include "visibility/index/boxes.h"

#include "visibility/stacked.h"

/* The box of a meshlet holds the corners of its facets, from every direction. */
static void boxes_of_meshlets_hold_their_facets(void **state)
{
    (void)state;
    lrcs_work work;
    stacked_triangles(100);
    for (int i = 0; i < 50; i++) {
        lrcs_pose pose;
        lrcsi_view view;
        const lrcs_prepared *prepared = scene_prepare(&scene, &work);
        const double direction[3] = {random_to(2) - 1, i % 5 == 0 ? 0 : random_to(2) - 1, 0.5};
        assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
        assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
        lrcsi_boxes boxes;
        assert_int_equal(lrcsi_boxes_make(&view, &work, &boxes), LRCS_OK);
        for (uint32_t f = 0; f < 100; f++) {
            uint32_t meshlet = f / LRCSI_MESHLET_FACETS;
            assert_true(boxes.state[meshlet] != LRCSI_BOXES_NONE);
            lrcsi_boxes_open(&boxes, meshlet);
            assert_int_equal(boxes.state[meshlet], LRCSI_BOXES_FACETS);
            for (int k = 0; k < 9; k++) {
                double at = view.scale * view.point[scene.scene.facet[f].corner[k / 3]].x[k % 3];
                assert_true(boxes.meshlet[meshlet].low[k % 3] <= (float)at);
                assert_true(boxes.meshlet[meshlet].high[k % 3] >= (float)at);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_of_meshlets_hold_their_facets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
