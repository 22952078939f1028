/* SPDX-License-Identifier: MIT */
/* Which material a surface gets, by the order of precedence in <lrcs/scene.h>, and which bindings
   matched at least one surface. */
#ifndef LRCSI_BIND_H
#define LRCSI_BIND_H

#include <lrcs/scene.h>

#include "base/index.h"

typedef struct lrcsi_binder {
    const lrcs_recipe *recipe;
    lrcsi_index names; /* bindings by kind and name or colour; materials of the recipe */
    int indexed;       /* 0: there is no index, and the recipe is searched */
    /* Found by the functions that return materials, for each binding: 1 if it matched; of equal
       bindings only the last is marked. NULL in a plain binder. */
    unsigned char *matched;
} lrcsi_binder;

/* Bytes that lrcsi_binder_make takes (upper bound). */
size_t lrcsi_binder_need(const lrcs_recipe *recipe);

/* A binder without an index, for a few queries: it needs no work area, and its searches are linear
   in the size of the recipe. It marks nothing as matched. */
lrcsi_binder lrcsi_binder_plain(const lrcs_recipe *recipe);

/* A binder with an index. Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_binder_make(const lrcs_recipe *recipe, lrcs_work *work, lrcsi_binder *binder);

/* The number of different materials that can be assigned to parts: the recipe's, then the
   library's. */
uint32_t lrcsi_binder_material_count(const lrcs_recipe *recipe);

/* The material assigned to a part as a whole, below lrcsi_binder_material_count, or LRCS_NONE.
   Status: LRCS_OK; LRCS_E_NAME. */
int lrcsi_binder_assigned(const lrcsi_binder *binder, const lrcs_recipe_part *part,
                          uint32_t *assigned);

/* The material of surfaces without a name of their own, on a part with the assigned material
   `assigned` (or LRCS_NONE). Marks the bindings that match. */
lrcs_material lrcsi_binder_unassigned(lrcsi_binder *binder, uint32_t assigned);

/* The material of a surface of a model, on a part with the assigned material `assigned` (or
   LRCS_NONE). Marks the bindings that match. */
lrcs_material lrcsi_binder_surface(lrcsi_binder *binder, uint32_t assigned,
                                   const lrcs_surface *surface);

/* The source of a material of the library. */
uint32_t lrcsi_binder_library_source(const lrcs_brdf_entry *entry);

/* The first NAME or COLOUR binding that matched no surface, recipe material or assigned material,
   or LRCS_NONE. Call it after all surfaces are bound. */
uint32_t lrcsi_binder_unmatched(const lrcsi_binder *binder);

#endif
