/* SPDX-License-Identifier: MIT */
/* From parts to a placed scene. A recipe lists parts (a model file or a shape), where each
   stands, how its joint is turned and which material it wears; building it makes one facet
   list in metres in the body frame. */
#ifndef LRCS_SCENE_H
#define LRCS_SCENE_H

#include <lrcs/shape.h>

/* A material of the scene: what facets refer to. */
typedef struct lrcs_material {
    const char *name; /* the file's or the recipe's name; "" for the default */
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
    const char *file; /* model file, or NULL for a shape */
    lrcs_shape shape; /* used where file is NULL */
    lrcs_place place;
    int unit_given; /* of a model file: its unit was stated; else metres are assumed */
    lrcs_joint joint;
    const char *material;   /* name of a material for the whole part, or NULL: the model's own */
    int wears;              /* the same, as an index into the recipe's materials; -1 for none,
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
} lrcs_recipe_material;

/* Which material a model's facets get. The first of these that answers:
     1. NAME, then COLOUR, of the facet's material as the model gives it (the command line);
     2. the part's own material, on every facet of the part;
     3. MAP_NAME, then MAP_COLOUR (the scene file);
     4. a material of the library that has the name of the model's material;
     5. DEFAULT;
     6. lrcs_brdf_default, unbound.
   A shape's facets have only 2, 5 and 6. A NAME also replaces the material of that name wherever
   2, 3 or 5 put it, so that the command line can change a scene file's materials. */
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
    int two_sided;        /* -1: keeps what the model says */
    const char *material; /* the recipe's or library's name for brdf; NULL for plain numbers */
    uint32_t line;        /* where the scene file names the material; 0 elsewhere */
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
   Unknown keys, wrong types, missing or doubled names are errors with a line. Model files are
   named, not opened.
   Given: text, size bytes, not terminated.
   Returned: recipe, in the work area, with its strings: it does not refer to the text.
   Status: LRCS_OK; _SYNTAX; _UNSUPPORTED (TOML outside the subset, another schema); _NAME
   (unknown, missing, doubled); _ARGUMENT (wrong type or form); _NUMBER (out of range); _MEMORY;
   _LIMIT; _EMPTY (no part).
   Work: lrcs_recipe_need(size), an upper bound that grows linearly with size; O(size). */
size_t lrcs_recipe_need(size_t size);
int lrcs_recipe_read(const char *text, size_t size, lrcs_work *work, lrcs_recipe *recipe,
                     lrcs_where *where);

/* A placed part. */
typedef struct lrcs_part {
    const char *name;
    int kind; /* lrcs_shape_kind, or -1 for a model file */
    uint32_t first_facet, facet_count;
    lrcs_curvature curvature; /* of an engine-made shape; zero for a model */
    int curvature_known; /* 0 where rounding in placing left a facet without area, or a matrix given
                            as a rotation is none; 1 for models (nothing to know) */
    double uneven;       /* 1 + this bounds how much more or less than on average over a facet a
                            scale that differs between axes stretches areas within its patch */
    int convex_patch;    /* a piece of a convex surface by construction, up to rounding */
    int solid;           /* a closed outward solid by construction, up to rounding */
    double thinnest;     /* m, smallest extent of such a shape; 0 for plate and disc */
    double misplaced;    /* m, bound on the rounding of its placed vertices */
    double tilted;    /* rad, bound on how placing tilts facets where reach > 0; in curvature too */
    double reach;     /* m, no point of the true surface is farther from its place on the
                         facets; 0 where the facets are the truth */
    int articulated;  /* stands on a joint */
    int smoothed;     /* its model has smoothing groups or vertex normals */
    int rigid;        /* an engine-made shape placed by turns, mirrors and one scale for all axes:
                         what follows holds, and its closed form may serve */
    lrcs_shape shape; /* in its own units */
    double unit;      /* metres for each of them */
    double origin[3]; /* m, where its origin stands, to within `misplaced` */
    double axis[3][3];     /* unit vectors, body frame: where its x, y and z axes point; rounded, */
    double axis_low[3][3]; /* and together with these to 2^-97. Truth is the shape turned by the */
    int axis_exact;        /* rotations nearest to the matrices given; 1: nothing was rounded */
} lrcs_part;

/* The scene: what the engine sees. Facets keep the order of the recipe's parts and of each
   file, degenerate and omitted ones included. */
typedef struct lrcs_scene {
    uint32_t vertex_count, facet_count, material_count, part_count;
    lrcs_point *vertex; /* m, body frame */
    lrcs_facet *facet;
    uint32_t *facet_material; /* index into material; always valid */
    uint32_t *facet_part;     /* index into part */
    uint32_t *facet_smooth;   /* smoothing groups, as in lrcs_mesh */
    lrcs_material *material;
    lrcs_part *part;
    int normals;               /* lrcs_normals asked for */
    lrcs_point *corner_normal; /* unit normals at corner k of facet f: [3 f + k]; three zeros for a
                                 flat facet; NULL where all are flat */
    uint32_t unmatched; /* the first NAME or COLOUR binding that matched nothing, or LRCS_NONE */
} lrcs_scene;

/* Which facets of models get curved normals, interpolated from those at their corners. */
enum lrcs_normals {
    LRCS_NORMALS_FLAT = 0, /* none: Eq. 2 over facets */
    LRCS_NORMALS_AUTO,     /* where the glint of the material calls for them: where the estimated
                              error of flat facets exceeds the tolerance */
    LRCS_NORMALS_SMOOTH    /* wherever a file gives vertex normals or smoothing groups */
};

/* The name ("flat", ...), or NULL. And back: LRCS_E_NAME for none. */
const char *lrcs_normals_text(int normals);
int lrcs_normals_find(const char *name);

/* How shapes are tessellated; the material comes from the recipe. */
typedef struct lrcs_build_options {
    double tolerance;    /* relative, > 0, of a shape alone; among other parts small ones may be
                            coarser, and a sphere, dome or paraboloid is divided for ten times
                            this, at least 1e-4 */
    uint32_t max_facets; /* a shape's most */
    int normals;         /* lrcs_normals */
    int facets_only;     /* 1: of a shape alone, too, facets are to be good for the tolerance, for
                            runs by a method that was asked for. 0: where its closed form serves
                            method auto from every direction, it gets a few hundred facets, for
                            pictures and records */
} lrcs_build_options;

lrcs_build_options lrcs_build_options_default(void); /* 1e-4, 2^21, flat, 0 */

/* Builds the scene: vertex = translate + rotate (scale (joint (vertex))), where steps that do
   nothing are exact, and so is a scale by powers of two; mirroring flips the winding.
   Given: recipe; models[i] the mesh of part i (ignored for shapes; models may be NULL where all
   are shapes); options.
   Returned: scene, in the work area. Its names point into the recipe, the models and the library.
   Materials: for each model part one for each of the model's, in the model's order and whether
   used or not; one for each recipe material that parts wear; one named "" for facets without.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_NAME (a material that nothing defines);
   LRCS_E_ARGUMENT (a scale of zero, a joint without axis, options outside their range);
   LRCS_E_NUMBER (a place that is not finite, coordinates above 1e100 m after placing);
   LRCS_E_INDEX (a mesh with an index out of range); LRCS_E_LIMIT; as lrcs_shape_check.
   `where` has the part's line, and what is at fault in `found`.
   Curved normals: a corner's vertex normal, placed by the inverse transpose; else, in a smoothing
   group, the mean of the normals of the facets that share the vertex (by index) and a group, by
   their angles there; else the facet's own. Vertex normals that all point behind their facet are
   turned round, others that do not point in front give way to the facet's own: the winding decides.
   Shapes stay flat: they are tessellated to the tolerance.
   Work: at most lrcs_scene_need bytes; O(vertices + facets + bindings). */
size_t lrcs_scene_need(const lrcs_recipe *recipe, const lrcs_mesh *models,
                       const lrcs_build_options *options);
int lrcs_scene_build(const lrcs_recipe *recipe, const lrcs_mesh *models,
                     const lrcs_build_options *options, lrcs_work *work, lrcs_scene *scene,
                     lrcs_where *where);

/* A hash over everything that sigma depends on: placed vertices, facets, materials, sidedness,
   curved normals (FNV-1a, 64 bit; the same on every machine). */
uint64_t lrcs_scene_hash(const lrcs_scene *scene);

#endif
