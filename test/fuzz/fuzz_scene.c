/* SPDX-License-Identifier: MIT */
/* Scene files from arbitrary bytes to sigma: a recipe of few parts, built of few facets and run.
   Parts that name a model file get one triangle of material "gold". */
#include "fuzz_recipe.h"
#include "fuzz_sigma.h"

#define MOST_PARTS 8u

static lrcs_mesh triangle(void)
{
    static lrcs_point vertex[3] = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0.5}}};
    static lrcs_facet facet = {{0, 1, 2}};
    static uint32_t zero;
    static lrcs_surface material = {.name = "gold", .rgb = {255, 215, 0}, .has_colour = 1};
    static const char *part = "";
    return (lrcs_mesh){3,     1,     1,     1,         vertex, &facet,
                       &zero, &zero, &zero, &material, &part,  .material_file = NULL};
}

static void build_and_run(const lrcs_recipe *recipe)
{
    const lrcs_build_options options = {0.5, 64, LRCS_NORMALS_AUTO};
    lrcs_mesh models[MOST_PARTS];
    lrcs_scene scene;
    lrcs_where where;
    for (uint32_t i = 0; i < recipe->part_count; i++) {
        models[i] = triangle();
    }
    size_t need = lrcs_scene_need(recipe, models, &options);
    require(need < FUZZ_ROOM);
    lrcs_work work = fuzz_area(need);
    int status = lrcs_scene_build(recipe, models, &options, &work, &scene, &where);
    require(status != LRCS_E_MEMORY && (status != LRCS_OK || work.peak <= need));
    if (status != LRCS_OK) {
        require(where.item != NULL && where.expected != NULL && work.used == 0);
    } else if (scene.facet_count <= 64) {
        fuzz_run run = {.options = lrcs_run_options_default(), .share = 64};
        run.options.resolution = 16;
        require(lrcs_pose_from_azel(30, 40, &run.pose) == LRCS_OK);
        lrcs_scene_hash(&scene);
        fuzz_scene(&scene, &run);
    }
    free(work.bytes);
}

int LLVMFuzzerTestOneInput(const unsigned char *data, size_t size)
{
    lrcs_work work;
    lrcs_recipe recipe;
    if (fuzz_recipe(data, size, &work, &recipe) && recipe.part_count <= MOST_PARTS) {
        build_and_run(&recipe);
    }
    free(work.bytes);
    return 0;
}
