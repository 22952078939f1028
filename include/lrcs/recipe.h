/* SPDX-License-Identifier: MIT */
/* What a scene is made from: a recipe lists parts (a model file or a shape) with their placement,
   joint angle and material, and says which materials the facets of models get. */
#ifndef LRCS_RECIPE_H
#define LRCS_RECIPE_H

#include <lrcs/shape.h>

/* place = translate * rotate * scale, applied after the joint. */
typedef struct lrcs_place {
    double translate[3]; /* m, body frame */
    double rotate[3][3]; /* orthonormal, part to body frame */
    double scale[3];     /* metres per model unit along the part's axes; negative mirrors */
} lrcs_place;

/* A rotation about an axis through an origin, in the part's own frame and units, applied before its
   place. */
typedef struct lrcs_joint {
    int used;
    double axis[3];
    double origin[3];
    double angle_deg;
} lrcs_joint;

lrcs_place lrcs_place_default(void);

typedef struct lrcs_recipe_part {
    const char *name;
    const char *file; /* model file, or NULL for a shape */
    lrcs_shape shape; /* used where file is NULL */
    lrcs_place place;
    double unit_m; /* model file: metres per unit, as stated; 0: not stated, metres are assumed. The
                      place's scale contains it */
    lrcs_joint joint;
    const char *material;   /* name of a material for the whole part, or NULL: the model's own */
    int material_index;     /* the same, as an index into the recipe's materials; -1 for none,
                                   or for a material of the library */
    uint32_t line;          /* where the scene file declares it; 0 elsewhere */
    uint32_t material_line; /* where it names its material; 0 elsewhere */
} lrcs_recipe_part;

/* A named material of the recipe. */
typedef struct lrcs_recipe_material {
    const char *name;
    lrcs_brdf brdf;
    int two_sided; /* -1: keeps what the model says */
    uint32_t line;
    int assumed; /* 1: the numbers are assumed, not given; their facets count as unassigned */
    lrcs_brdf_error error; /* of brdf */
} lrcs_recipe_material;

/* Which material a model's facets get: the first of these that applies:
     1. NAME, then COLOUR, of the facet's material as the model gives it (the command line);
     2. the part's own material, on every facet of the part;
     3. MAP_NAME, then MAP_COLOUR (the scene file);
     4. a material of the library with the same name as the model's material;
     5. DEFAULT;
     6. lrcs_brdf_default, unassigned.
   For the facets of a shape only 2, 5 and 6 apply. A NAME also replaces the material of that name
   wherever 2, 3 or 5 assigned it, so that the command line can change a scene file's materials. */
enum lrcs_binding_kind {
    LRCS_BIND_NAME,
    LRCS_BIND_COLOUR,
    LRCS_BIND_MAP_NAME,
    LRCS_BIND_MAP_COLOUR,
    LRCS_BIND_DEFAULT
};

typedef struct lrcs_binding {
    int kind;             /* lrcs_binding_kind */
    const char *name;     /* for the NAME kinds */
    unsigned char rgb[3]; /* for the COLOUR kinds */
    lrcs_brdf brdf;
    int two_sided;         /* -1: keeps what the model says */
    const char *material;  /* the recipe's or library's name for brdf; NULL for plain numbers */
    uint32_t line;         /* where the scene file names the material; 0 elsewhere */
    int assumed;           /* as in lrcs_recipe_material */
    lrcs_brdf_error error; /* of brdf */
    uint32_t source; /* bindings of equal source > 0 give the same numbers from one place, 1 + i
                        being the recipe's material i; 0: its own */
} lrcs_binding;

typedef struct lrcs_recipe {
    const char *name; /* of the scene, or NULL */
    lrcs_recipe_part *part;
    lrcs_recipe_material *material;
    lrcs_binding *binding; /* within a kind, the last one given wins */
    uint32_t part_count, material_count, binding_count;
    int keep_transparent; /* do not leave out fully transparent facets */
} lrcs_recipe;

/* Reads a scene file: a strict subset of TOML 1.0 (examples/satellite.toml shows all of it).
   Unknown keys, wrong types, and missing or duplicate names are errors with a line number. Model
   files are not opened; the recipe has their names.
   Given: text, size bytes, not terminated.
   Returned: recipe, in the work area, with its strings: it does not refer to the text.
   Status: LRCS_OK; _SYNTAX; _UNSUPPORTED (TOML outside the subset, another schema); _NAME
   (unknown, missing, duplicate); _ARGUMENT (wrong type or form); _NUMBER (out of range); _MEMORY;
   _LIMIT; _EMPTY (no part).
   Work: lrcs_recipe_need(size), an upper bound that grows linearly with size; O(size). */
size_t lrcs_recipe_need(size_t size);
int lrcs_recipe_read(const char *text, size_t size, lrcs_work *work, lrcs_recipe *recipe,
                     lrcs_where *where);

#endif
