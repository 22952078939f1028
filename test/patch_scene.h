/* SPDX-License-Identifier: MIT */
/* One shape whose facets represent patches, in a view. */
#ifndef TEST_PATCH_SCENE_H
#define TEST_PATCH_SCENE_H

#include <lrcs/lrcs.h>

#include "check.h"
#include "integrate/plan/plan.h"
#include "view/view.h"

typedef struct patch_scene {
    lrcs_place place; /* given */
    lrcs_scene scene;
    lrcsi_view view;
    lrcsi_plan plan;
} patch_scene;

/* The shape, divided for a tolerance, and a plate far away, so that it is one among others. The
   next call invalidates the view. */
static inline void patch_scene_make(const lrcs_shape *shape, double division, const lrcs_brdf *brdf,
                                    int two_sided, const double d[3], patch_scene *s)
{
    static unsigned char memory[1u << 28];
    lrcs_recipe_part part[2] = {
        {.name = "a", .material_index = -1, .place = s->place, .shape = *shape},
        {.name = "b", .material_index = -1, .place = lrcs_place_default()}};
    part[1].shape = (lrcs_shape){.kind = LRCS_SHAPE_PLATE, .size = {1, 1}};
    part[1].place.translate[2] = -30;
    lrcs_binding binding = {.kind = LRCS_BIND_DEFAULT, .brdf = *brdf, .two_sided = two_sided};
    const lrcs_recipe recipe = {
        .part = part, .part_count = 2, .binding = &binding, .binding_count = 1};
    lrcs_build_options options = lrcs_build_options_default();
    lrcs_run_options run = lrcs_run_options_default();
    const lrcs_prepared *prepared;
    lrcsi_clear_shapes clear;
    lrcs_pose pose;
    options.tolerance = division;
    lrcs_work work = lrcs_work_make(memory, sizeof memory);
    assert_int_equal(lrcs_scene_build(&recipe, NULL, &options, &work, &s->scene, NULL), LRCS_OK);
    assert_int_equal(lrcs_prepare_run(&s->scene, &work, &prepared), LRCS_OK);
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    assert_int_equal(
        lrcsi_view_face(prepared, &pose, lrcsi_plan_backs(prepared, &run), &work, &s->view),
        LRCS_OK);
    assert_int_equal(lrcsi_view_project(&work, &s->view), LRCS_OK);
    assert_int_equal(lrcsi_clear_make(&s->view, &work, &clear), LRCS_OK);
    s->plan = lrcsi_plan_make(&s->view, &clear, &run);
}

/* F at a cosine of the incidence angle, written down independently; it is 0 where the surface faces away. */
static inline double patch_reflect_at(const lrcs_brdf *brdf, double c)
{
    double u = 1 / (c * c) - 1;
    if (!(c > 0)) {
        return 0;
    }
    return brdf->A / (c * c * c * c) * exp(-u / (brdf->s * brdf->s)) +
           brdf->B * pow(c, brdf->m + 2);
}

#endif
