/* SPDX-License-Identifier: MIT */
/* Bytes to a recipe: what a scene file says, or where it stops, in no more memory than
   lrcs_recipe_need. */
#ifndef TEST_FUZZ_RECIPE_H
#define TEST_FUZZ_RECIPE_H

#include "fuzz.h"

static inline void require_recipe(const lrcs_recipe *recipe)
{
    require(recipe->part_count > 0);
    for (uint32_t i = 0; i < recipe->part_count; i++) {
        const lrcs_recipe_part *part = &recipe->part[i];
        require(part->material_index >= -1 && part->material_index < (int)recipe->material_count);
        require(part->file || lrcs_shape_check(&part->shape, NULL) == LRCS_OK);
    }
    for (uint32_t i = 0; i < recipe->material_count; i++) {
        require(recipe->material[i].name && lrcs_brdf_check(&recipe->material[i].brdf) >= 0);
    }
    for (uint32_t i = 0; i < recipe->binding_count; i++) {
        require(lrcs_brdf_check(&recipe->binding[i].brdf) >= 0);
    }
}

/* 1 with a recipe in the work area, which is the caller's to free either way. */
static inline int fuzz_recipe(const unsigned char *data, size_t size, lrcs_work *work,
                              lrcs_recipe *recipe)
{
    lrcs_where where;
    size_t need = lrcs_recipe_need(size);
    *work = fuzz_area(need);
    memset(recipe, FUZZ_PATTERN, sizeof *recipe);
    int status = lrcs_recipe_read((const char *)data, size, work, recipe, &where);
    require(status != LRCS_E_MEMORY && work->peak <= need);
    if (status == LRCS_OK) {
        require_recipe(recipe);
        return 1;
    }
    require_where(&where, size);
    require(work->used == 0 && fuzz_untouched(recipe, sizeof *recipe));
    return 0;
}

#endif
