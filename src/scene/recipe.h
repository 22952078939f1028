/* SPDX-License-Identifier: MIT */
/* What recipe.c and recipe_part.c share. */
#ifndef LRCSI_RECIPE_H
#define LRCSI_RECIPE_H

#include <lrcs/scene.h>

#include "scene/draft.h"

/* The draft's `unit` in metres, or `other` if it has none. Status: LRCS_OK; LRCS_E_NAME;
   LRCS_E_NUMBER (not above 0). */
int lrcsi_recipe_unit(const lrcsi_draft *draft, double other, double *metres);

/* A part from its finished draft. `unit` is the file's, for models. The material stays a name. */
int lrcsi_recipe_part(const lrcsi_draft *draft, double unit, lrcs_recipe_part *part);

#endif
