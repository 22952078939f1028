/* SPDX-License-Identifier: MIT */
/* A recipe built, prepared and run from one direction, in memory of its own. */
#ifndef TEST_RECIPE_H
#define TEST_RECIPE_H

#include <lrcs/lrcs.h>

#include <string.h>

#include "check.h"

/* A recipe of two parts that have no shapes yet: the first bright, the other black. */
static inline lrcs_recipe recipe_bright_and_black(const lrcs_brdf *bright, lrcs_recipe_part part[2],
                                                  lrcs_recipe_material material[2])
{
    material[0] = (lrcs_recipe_material){.name = "bright", .brdf = *bright};
    material[1] = (lrcs_recipe_material){.name = "black", .brdf = {0, 0, 1, 0}};
    for (int i = 0; i < 2; i++) {
        part[i] = (lrcs_recipe_part){.name = "", .place = lrcs_place_default()};
        part[i].material = material[i].name;
        part[i].material_index = i;
    }
    return (lrcs_recipe){.part = part, .part_count = 2, .material = material, .material_count = 2};
}

/* Given: models of parts that are files, or NULL. Returned: the prepared scene; *work: the memory that is left, behind it. */
static inline const lrcs_prepared *recipe_prepare(const lrcs_recipe *recipe,
                                                  const lrcs_mesh *models,
                                                  const lrcs_build_options *build,
                                                  lrcs_scene *scene, lrcs_work *work)
{
    static unsigned char scene_area[1u << 25];
    static unsigned char run_area[1u << 27];
    const lrcs_prepared *prepared;
    *work = lrcs_work_make(scene_area, sizeof scene_area);
    assert_int_equal(lrcs_scene_build(recipe, models, build, work, scene, NULL), LRCS_OK);
    memset(run_area, 0xa5, sizeof run_area / 8); /* nothing reads what it has not written */
    *work = lrcs_work_make(run_area, sizeof run_area);
    assert_int_equal(lrcs_prepare_run(scene, work, &prepared), LRCS_OK);
    return prepared;
}

static inline lrcs_result recipe_run(const lrcs_recipe *recipe, const lrcs_build_options *build,
                                     const lrcs_run_options *options, const double d[3])
{
    lrcs_scene scene;
    lrcs_work work;
    lrcs_pose pose;
    lrcs_result result;
    const lrcs_prepared *prepared = recipe_prepare(recipe, NULL, build, &scene, &work);
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    assert_int_equal(lrcs_sigma_run(prepared, &pose, options, &work, &result, NULL, NULL), LRCS_OK);
    return result;
}

#endif
