/* SPDX-License-Identifier: MIT */
/* Two shapes, of which a test says what hides what, in any attitude. */
#ifndef TEST_PAIR_H
#define TEST_PAIR_H

#include <string.h>

#include <lrcs/lrcs.h>

#include "check.h"

static unsigned char scene_area[1u << 22];
static unsigned char run_area[1u << 24];

static const lrcs_shape ball = {.kind = LRCS_SHAPE_SPHERE, .radius = 0.5};
static const lrcs_shape post = {.kind = LRCS_SHAPE_CYLINDER, .radius = 0.25, .length = 1};
static const lrcs_shape drum = {.kind = LRCS_SHAPE_CYLINDER, .radius = 1, .length = 1};
static const lrcs_shape cone = {.kind = LRCS_SHAPE_CONE, .radius = 0.5, .half_angle_deg = 30};
static const lrcs_shape dome = {.kind = LRCS_SHAPE_DOME, .radius = 0.5};
static const lrcs_shape horn = {
    .kind = LRCS_SHAPE_FRUSTUM, .radius = 0.5, .radius2 = 0.25, .length = 1};
static const lrcs_shape dish = {.kind = LRCS_SHAPE_PARABOLOID, .radius = 0.5, .length = 0.25};
static const lrcs_shape plate = {.kind = LRCS_SHAPE_PLATE, .size = {4, 4}};
static const lrcs_shape box = {.kind = LRCS_SHAPE_BOX, .size = {1, 1, 1}};

/* Prepares two shapes as parts 0 and 1, the first upright at the origin and the other at `at`, both
   then turned by R and moved by `shift` along every axis. *work: the memory that is left. */
static inline const lrcs_prepared *pair_prepare(const lrcs_shape *first, const lrcs_shape *other,
                                                const double at[3], const double R[3][3],
                                                double shift, lrcs_scene *scene, lrcs_work *work)
{
    lrcs_recipe_part part[2] = {
        {.name = "a", .shape = *first, .place = lrcs_place_default(), .material_index = -1},
        {.name = "b", .shape = *other, .place = lrcs_place_default(), .material_index = -1}};
    lrcs_recipe recipe = {.part = part, .part_count = 2};
    const lrcs_build_options build = {1e-1, 1u << 11, LRCS_NORMALS_FLAT, 0, 0, NULL};
    const lrcs_prepared *prepared;
    for (int k = 0; k < 3; k++) {
        part[0].place.translate[k] = shift;
        part[1].place.translate[k] = shift + R[k][0] * at[0] + R[k][1] * at[1] + R[k][2] * at[2];
    }
    memcpy(part[0].place.rotate, R, sizeof part[0].place.rotate);
    memcpy(part[1].place.rotate, R, sizeof part[1].place.rotate);
    *work = lrcs_work_make(scene_area, sizeof scene_area);
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &build, work, scene, NULL), LRCS_OK);
    *work = lrcs_work_make(run_area, sizeof run_area);
    assert_int_equal(lrcs_prepare_run(scene, work, &prepared), LRCS_OK);
    return prepared;
}

#endif
