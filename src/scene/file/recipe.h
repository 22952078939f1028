/* SPDX-License-Identifier: MIT */
/* Functions that recipe.c and recipe_part.c share. */
#ifndef LRCSI_RECIPE_H
#define LRCSI_RECIPE_H

#include <lrcs/scene.h>

#include "scene/file/draft.h"

/* The draft's `unit` in metres, or `fallback` if it has none. Status: LRCS_OK; LRCS_E_NAME;
   LRCS_E_NUMBER (not above 0). */
int lrcsi_recipe_unit(const lrcsi_draft *draft, double fallback, double *metres);

/* Makes a part from its finished draft. `unit` is the unit at the top of the file, for models. The
   name of the material is not resolved here. */
int lrcsi_recipe_part(const lrcsi_draft *draft, double unit, lrcs_recipe_part *part);

#endif
