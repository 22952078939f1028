/* SPDX-License-Identifier: MIT */
/* From parts to a placed scene. A recipe lists parts (a model file or a shape), where each
   stands, how its joint is turned and which material it wears; building it makes one facet
   list in metres in the body frame. */
#ifndef LRCS_SCENE_H
#define LRCS_SCENE_H

#include <lrcs/shape.h>

/* A material of the scene: what facets refer to. */
typedef struct lrcs_material {
    const char *name;     /* the file's or the recipe's name; "" for the default */
    lrcs_brdf brdf;
    unsigned char rgb[3];
    unsigned char has_colour;
    unsigned char two_sided;
    unsigned char omitted; /* fully transparent: its facets are left out of the scene */
    unsigned char bound;   /* 0: wears lrcs_brdf_default for want of a binding */
} lrcs_material;

/* place = translate * rotate * scale, applied after the joint. */
typedef struct lrcs_place {
    double translate[3]; /* m, body frame */
    double rotate[3][3]; /* orthonormal, part to body frame */
    double scale[3];     /* metres per model unit along the part's axes; negative mirrors */
} lrcs_place;

/* A turn about an axis through an origin, in the part's own frame and units, before its place. */
typedef struct lrcs_joint {
    int used;
    double axis[3];
    double origin[3];
    double angle_deg;
} lrcs_joint;

lrcs_place lrcs_place_default(void);

typedef struct lrcs_recipe_part {
    const char *name;
    const char *file;  /* model file, or NULL for a shape */
    lrcs_shape shape;  /* used where file is NULL */
    lrcs_place place;
    lrcs_joint joint;
    const char *material; /* name of a material for the whole part, or NULL: the model's own */
    int wears;            /* the same, as an index into the recipe's materials; -1 for none */
    uint32_t line;        /* where the scene file declares it; 0 elsewhere */
} lrcs_recipe_part;

/* A named material of the recipe. */
typedef struct lrcs_recipe_material {
    const char *name;
    lrcs_brdf brdf;
    int two_sided; /* -1: keeps what the model says */
    uint32_t line;
} lrcs_recipe_material;

/* Which material a model's facets get. Later kinds yield to earlier ones:
   NAME, COLOUR (from the command line), MAP_NAME, MAP_COLOUR (from the scene file), DEFAULT. */
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
    int two_sided; /* -1: keeps what the model says */
    uint32_t line;
} lrcs_binding;

typedef struct lrcs_recipe {
    lrcs_recipe_part *part;
    lrcs_recipe_material *material;
    lrcs_binding *binding; /* within a kind, the last one given wins */
    uint32_t part_count, material_count, binding_count;
    int keep_transparent; /* do not leave out fully transparent facets */
} lrcs_recipe;

/* Reads a scene file (a strict subset of TOML 1.0; see the README). Unknown keys, wrong types,
   missing or doubled names are errors with a line. Model files are named, not opened.
   Bytes: lrcs_recipe_need(size), an upper bound that grows linearly with size.
   Status: LRCS_OK; _SYNTAX, _NAME, _NUMBER, _ARGUMENT, _MEMORY, _EMPTY (no part). */
size_t lrcs_recipe_need(size_t size);
int lrcs_recipe_read(const char *text, size_t size, lrcs_work *work, lrcs_recipe *recipe,
                     lrcs_where *where);

/* A placed part. */
typedef struct lrcs_part {
    const char *name;
    int kind;                  /* lrcs_shape_kind, or -1 for a model file */
    uint32_t first_facet, facet_count;
    lrcs_curvature curvature;  /* of an engine-made shape; zero for a model */
    int curvature_known;       /* 0 where a non-uniform scale spoilt it; 1 for models (nothing to know) */
    int convex_patch;          /* a piece of a convex surface by construction, up to rounding */
    double thinnest;           /* m, smallest extent of such a shape; 0 for plate and disc */
    double misplaced;          /* m, bound on the rounding of its placed vertices */
    int articulated;           /* stands on a joint */
} lrcs_part;

/* The scene: what the engine sees. Facets keep the order of the recipe's parts and of each
   file, degenerate and omitted ones included. */
typedef struct lrcs_scene {
    uint32_t vertex_count, facet_count, material_count, part_count;
    lrcs_point *vertex;       /* m, body frame */
    lrcs_facet *facet;
    uint32_t *facet_material;  /* index into material; always valid */
    uint32_t *facet_part;      /* index into part */
    uint32_t *facet_smooth;    /* smoothing groups, as in lrcs_mesh */
    lrcs_material *material;
    lrcs_part *part;
    uint32_t unmatched;        /* the first NAME or COLOUR binding that matched nothing, or LRCS_NONE */
} lrcs_scene;

/* How shapes are tessellated; the material comes from the recipe. */
typedef struct lrcs_build_options {
    double tolerance;    /* relative, > 0 */
    uint32_t max_facets; /* a shape's most */
} lrcs_build_options;

lrcs_build_options lrcs_build_options_default(void); /* 1e-4, 2^20 */

/* Builds the scene. Given: recipe; models[i] the mesh of part i (ignored for shapes).
   Returned: scene, in the work area, at most lrcs_scene_need bytes.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_NAME (a material that nothing defines);
   LRCS_E_NUMBER (coordinates above 1e100 m after placing); LRCS_E_LIMIT; as lrcs_shape_check. */
size_t lrcs_scene_need(const lrcs_recipe *recipe, const lrcs_mesh *models,
                       const lrcs_build_options *options);
int lrcs_scene_build(const lrcs_recipe *recipe, const lrcs_mesh *models,
                     const lrcs_build_options *options, lrcs_work *work, lrcs_scene *scene,
                     lrcs_where *where);

/* A hash over everything that sigma depends on: placed vertices, facets, materials, sidedness
   (FNV-1a, 64 bit; the same on every machine). */
uint64_t lrcs_scene_hash(const lrcs_scene *scene);

#endif
