/* SPDX-License-Identifier: MIT */
/* A plate seen from above, and a triangle that may divide it: for tests of what divides facets. */
#ifndef TEST_PLATE_AND_H
#define TEST_PLATE_AND_H

#include "scenes.h"
#include "view/view.h"

/* Facet 0: (0,0,0) (4,0,0) (0,4,0), front up, seen from above; facet 1: a, b, c. */
static inline void plate_and(test_scene *scene, const double a[3], const double b[3],
                             const double c[3], lrcs_work *work, lrcsi_view *view)
{
    lrcs_pose pose;
    scene_start(scene);
    scene_triangle(scene, (const double[3]){0, 0, 0}, (const double[3]){4, 0, 0},
                   (const double[3]){0, 4, 0});
    scene_triangle(scene, a, b, c);
    const lrcs_prepared *prepared = scene_prepare(scene, work);
    assert_int_equal(lrcs_pose_from_direction((const double[3]){0, 0, 1}, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, work, view), LRCS_OK);
}

#endif
