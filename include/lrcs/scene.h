/* SPDX-License-Identifier: MIT */
/* A placed scene: building a recipe (lrcs/recipe.h) makes one facet list in metres in the body
   frame. */
#ifndef LRCS_SCENE_H
#define LRCS_SCENE_H

#include <lrcs/recipe.h>

/* The source of entry i of the library, as of lrcs_material: this plus i. */
#define LRCS_SOURCE_LIBRARY 0xff000000u

/* A material of the scene; facets refer to it by index. */
typedef struct lrcs_material {
    const char *name; /* the file's or the recipe's name; "" for the default */
    lrcs_brdf brdf;
    unsigned char rgb[3];
    unsigned char has_colour;
    unsigned char two_sided;
    unsigned char omitted;    /* fully transparent: its facets are left out of the scene */
    unsigned char brdf_given; /* 0: brdf is lrcs_brdf_default, or what a scene file calls assumed */
    lrcs_brdf_error error;    /* of brdf; all zero where none was stated */
    uint32_t source; /* materials of equal source > 0 got the same numbers from one place: their
                        errors are one and the same; 0: the default */
} lrcs_material;

/* Proved bounds on how far the facets of an engine-made shape are from the true shape. What they
   cost in sigma is lrcs_budget.tessellation_m2. Zero for a model file, whose facets are the truth,
   except for `known`. */
typedef struct lrcs_part_bounds {
    int known; /* 0: no bound holds, because rounding in placing left a facet with zero area, or a
                  matrix given as a rotation is not one; 1 for models */
    lrcs_patch_bounds patch; /* of each facet */
    double stretch_err;      /* a scale that differs between axes stretches areas unevenly: 1 + this
                                bounds the ratio, either way, of the stretch at a point of a patch
                                to its mean over the facet */
    double position_err;     /* m, bound on the rounding error of its placed vertices */
    double normal_err; /* rad, bound on the rotation of facet normals by rounding in placing, where
                          reach > 0; included in `patch` */
    double reach;      /* m, bound on the distance of a point of the true surface from its image on
                          the facets; 0 if the facets are the truth */
    double hausdorff;  /* m, where reach > 0: bound on the distance of any point of the true solid
                          (of an open shape, of the true surface) from the facets' solid (from the
                          facets), and the reverse */
    double displacement[3]; /* m, of a rigid shape's curved wall: bounds on the radial, axial and
                               tangential components of that distance */
} lrcs_part_bounds;

/* A placed part. */
typedef struct lrcs_part {
    const char *name;
    int kind; /* lrcs_shape_kind, or -1 for a model file */
    uint32_t first_facet, facet_count;
    lrcs_part_bounds bounds;
    int convex_patch;  /* a piece of a convex surface by construction, up to rounding */
    int solid;         /* a closed outward solid by construction, up to rounding */
    double min_extent; /* m, smallest extent of such a shape; 0 for plate and disc */
    int articulated;   /* has a joint */
    int smoothed;      /* its model has smoothing groups or vertex normals */
    int rigid;        /* an engine-made shape placed by rotations, reflections and one scale for all
                         axes: shape to axis_exact are valid, and its closed form may be used */
    lrcs_shape shape; /* in its own units */
    lrcs_divisions divisions; /* of its mesh */
    double unit;              /* metres per unit */
    double origin[3];         /* m, position of its origin, to within bounds.position_err */
    /* Its x, y and z axes in the body frame: unit vectors, rounded; axis + axis_low is accurate to
       2^-97. The truth is the shape rotated by the rotations nearest to the matrices given. */
    double axis[3][3];
    double axis_low[3][3];
    int axis_exact; /* 1: the axes were not rounded */
    /* Of an engine-made shape, also if its scale differs between axes. A normal n of the shape
       points to n[0] normal_axis[0] + n[1] normal_axis[1] + n[2] normal_axis[2] in the body frame,
       at most a unit vector; areas are multiplied by that vector's length, normal_area
       and unit^2. */
    int normals_known; /* 1: these two are valid */
    double normal_axis[3][3], normal_area;
} lrcs_part;

/* The scene, the engine's input. Facets keep the order of the recipe's parts and of each file,
   including degenerate and omitted facets. */
typedef struct lrcs_scene {
    uint32_t vertex_count, facet_count, material_count, part_count;
    lrcs_point *vertex; /* m, body frame */
    lrcs_facet *facet;
    uint32_t *facet_material; /* index into material; always valid */
    uint32_t *facet_part;     /* index into part */
    uint32_t *facet_smooth;   /* smoothing groups, as in lrcs_mesh */
    lrcs_material *material;
    lrcs_part *part;
    int normals;               /* lrcs_normals, as requested */
    lrcs_point *corner_normal; /* unit normal at corner k of facet f: [3 f + k]; three zeros for a
                                 flat facet; NULL if all facets are flat */
    uint32_t unmatched; /* the first NAME or COLOUR binding that matched nothing, or LRCS_NONE */
} lrcs_scene;

/* Which facets of models get curved normals, interpolated from the normals at their corners. */
enum lrcs_normals {
    LRCS_NORMALS_FLAT = 0, /* none: Eq. 2 over facets */
    LRCS_NORMALS_AUTO,     /* where the glint of the material requires them: where the estimated
                              error of flat facets exceeds the tolerance */
    LRCS_NORMALS_SMOOTH    /* wherever a file gives vertex normals or smoothing groups */
};

/* The name ("flat", ...), or NULL. lrcs_normals_find is the inverse: LRCS_E_NAME for an unknown
   name. */
const char *lrcs_normals_text(int normals);
int lrcs_normals_find(const char *name);

/* What the facets of a shape that is alone in its scene are for. */
enum lrcs_facets_only {
    LRCS_FACETS_BASE = 0, /* pictures and records, if method auto can use the shape's closed form
                             from every direction: a few hundred facets */
    LRCS_FACETS_TOTAL,    /* runs that request a method: sigma as a whole meets the tolerance */
    LRCS_FACETS_LOCAL /* range profiles: every part of the surface does, to about the tolerance */
};

/* How shapes are tessellated; the material comes from the recipe. */
typedef struct lrcs_build_options {
    double tolerance;    /* relative, > 0. A shape alone is tessellated for this tolerance. Among
                            other parts small shapes may be coarser, and each facet of a curved wall
                            stands for the mean over the true surface, so that only shadows require
                            facets: a sphere, dome or paraboloid is tessellated for 1e-4 at the
                            finest; where a scale differs between axes, for ten times the tolerance,
                            at least 1e-4 */
    uint32_t max_facets; /* limit for one shape */
    int normals;         /* lrcs_normals */
    int facets_only;     /* lrcs_facets_only */
    double division;     /* relative; if not 0, shapes that have no closed form from every direction
                            are divided for this instead of `tolerance`, round bodies too */
    const unsigned char *halvings; /* for each part of the recipe, how many times its division is
                                      halved; NULL: no part's is */
} lrcs_build_options;

lrcs_build_options lrcs_build_options_default(void); /* 1e-4, 2^21, flat, 0, 0, NULL */

/* Builds the scene: vertex = translate + rotate (scale (joint (vertex))). Identity steps are exact,
   and so is scaling by powers of two; mirroring reverses the winding.
   Given: recipe; models[i] the mesh of part i (ignored for shapes; models may be NULL if all
   are shapes); options.
   Returned: scene, in the work area. Its names point into the recipe, the models and the library.
   Materials: for each model part, one for each material of the model, used or not, in the model's
   order; one for each recipe material that is assigned to a part; one named "" for facets without
   a material.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_NAME (an undefined material);
   LRCS_E_ARGUMENT (a scale of zero, a joint without axis, options outside their range);
   LRCS_E_NUMBER (a place that is not finite, coordinates above 1e100 m after placing);
   LRCS_E_INDEX (a mesh with an index out of range); LRCS_E_LIMIT; as lrcs_shape_check.
   `where` has the part's line; `found` says what is wrong.
   Curved normals: a corner's normal is its vertex normal, transformed by the inverse transpose;
   otherwise, in a smoothing group, the mean of the normals of the facets that share the vertex (by
   index) and a group, weighted by their angles there; otherwise the facet's own normal. The winding
   determines the front: vertex normals that all point behind their facet are reversed; a single one
   that does not point to the front is replaced by the facet's own. Shapes stay flat: they are
   tessellated to the tolerance.
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
