/* SPDX-License-Identifier: MIT */
/* sigma of a prepared scene for a pose: Eq. 2 of Han et al. (2014) over the visible surface. */
#ifndef LRCS_RUN_H
#define LRCS_RUN_H

#include <lrcs/pose.h>
#include <lrcs/scene.h>

enum lrcs_method {
    LRCS_METHOD_AUTO = 0,
    LRCS_METHOD_FACET,
    LRCS_METHOD_ZBUFFER,
    LRCS_METHOD_EXACT,
    LRCS_METHOD_CLOSED /* in results only, chosen by auto: every part is a shape that nothing hides
                        */
};

/* The method's name ("auto", ...), or NULL. lrcs_method_find is the inverse for the methods that
   may be requested: LRCS_E_NAME for any other name. */
const char *lrcs_method_text(int method);
int lrcs_method_find(const char *name);

/* What must meet the tolerance for an answer to be accepted. */
enum lrcs_accept {
    LRCS_ACCEPT_BOUND = 0, /* the proved bound */
    LRCS_ACCEPT_ESTIMATE,  /* the bound, or the estimated error of a raster (heuristic):
                              LRCS_FLAG_ACCEPTED_BY_ESTIMATE */
    LRCS_ACCEPT_ANY        /* nothing: the first answer is accepted: LRCS_FLAG_ACCEPTED_UNJUDGED */
};

/* The name ("bound", ...), or NULL. lrcs_accept_find is the inverse: LRCS_E_NAME for an unknown
   name. */
const char *lrcs_accept_text(int accept);
int lrcs_accept_find(const char *name);

/* Everything about a scene that does not depend on direction: normals, edges, contacts between
   facets, and proved properties for the planner. Opaque; lives in the caller's work area. */
typedef struct lrcs_prepared lrcs_prepared;

/* Bytes of work area that preparing a scene takes: an upper bound for ordinary scenes. If very many
   facets intersect each other, lrcs_prepare_run may return LRCS_E_MEMORY; work->peak is then what
   it needed up to that point, and a larger area is required. */
size_t lrcs_prepare_need(const lrcs_scene *scene);

/* Prepares a scene, which must outlive the result. Coordinates below 2^-300 of the largest one
   count as zero. Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT (more than 2^32 - 2 neighbours in a
   list); LRCS_E_INDEX, LRCS_E_NUMBER (a scene not made by lrcs_scene_build); LRCS_E_UNSUPPORTED
   (this thread or build does not round doubles to nearest as IEEE 754 defines, fuses products and
   sums, or flushes subnormal numbers to zero: the proofs would not hold). */
int lrcs_prepare_run(const lrcs_scene *scene, lrcs_work *work, const lrcs_prepared **prepared);

/* What the engine can leave out. */
enum lrcs_effect_name {
    LRCS_EFFECT_SELF_SHADOWING,
    LRCS_EFFECT_BACK_FACE_CASTERS,
    LRCS_EFFECT_GLINT,
    LRCS_EFFECT_DIFFUSE,
    LRCS_EFFECT_CURVED_NORMALS,
    LRCS_EFFECT_TWO_SIDED,
    LRCS_EFFECT_ARTICULATION,
    LRCS_EFFECT_CLOSED_FORMS, /* method auto evaluates shapes that nothing hides without facets */
    LRCS_EFFECTS
};

/* Effects that a run may switch on or off. Curved normals, articulation and closed forms are not
   among them: the scene and the method determine those. */
#define LRCS_EFFECTS_SWITCHED                                                                      \
    (1u << LRCS_EFFECT_SELF_SHADOWING | 1u << LRCS_EFFECT_BACK_FACE_CASTERS |                      \
     1u << LRCS_EFFECT_GLINT | 1u << LRCS_EFFECT_DIFFUSE | 1u << LRCS_EFFECT_TWO_SIDED)

/* What a run is doing. */
enum lrcs_progress_stage {
    LRCS_PROGRESS_VIEW,       /* which facets face the laser, and where they are in the view */
    LRCS_PROGRESS_CLASSIFY,   /* which facets are entirely visible or entirely hidden */
    LRCS_PROGRESS_VISIBILITY, /* what is visible of the others */
    LRCS_PROGRESS_INTEGRATE   /* curved normals; the sum */
};

/* The stage in words, or NULL. */
const char *lrcs_progress_text(int stage);

/* How far a run is: written by the run, for a signal handler or another thread of the caller's that
   shows it. Nothing else depends on it. */
typedef struct lrcs_progress {
    volatile uint32_t stage;       /* lrcs_progress_stage */
    volatile uint32_t done, total; /* of the facets or blocks of the stage; total 0: not known */
} lrcs_progress;

typedef struct lrcs_run_options {
    double tolerance; /* relative, > 0: the goal is bound <= tolerance * sigma, and for a cubature
                         over curved normals also curvature estimate <= tolerance * sigma */
    int method;       /* lrcs_method */
    uint32_t resolution;     /* raster N x N, at most 16384; 0: chosen from the tolerance */
    uint32_t without;        /* effects to leave out, bits 1u << LRCS_EFFECT_...: note 1 */
    uint32_t with;           /* effects to simulate even if redundant, not in `without`: note 2 */
    uint64_t steps;          /* limit on the steps of the visibility computation, 0: none: note 3 */
    int accept;              /* lrcs_accept: note 4 */
    lrcs_progress *progress; /* where the run says how far it is, or NULL */
} lrcs_run_options;

/* 1e-4, auto, 0, 0, 0, 0, bound, NULL.

   Notes: 1. `without` shows the influence and the cost of an effect; leaving out an effect that is
   off changes nothing. Without self-shadowing every run uses method facet, whatever the method
   requested: the bound still refers to the shadowed truth, and includes all that could be hidden.
   For the other effects the bound refers to a truth without the effect. Back-face casters: facets
   that face away are removed from the scene (back-face culling), including two-sided ones. Glint,
   diffuse: A or B is 0 everywhere. Two-sided: every material reflects from its front only.
   2. `with` shows that what the planner leaves out does not matter: sigma and the truth do not
   change, to within the bounds. Self-shadowing is computed although proved absent (if the method is
   facet, as auto would compute it); visible back sides are searched for, and back sides cast
   shadows, although proved never visible; a term of amplitude 0 is evaluated. If self-shadowing is
   left out, visible back sides are not searched for: nothing could hide them.
   3. When `steps` is used up, a run stops refining. Facets, or parts of them, whose visibility is
   then unknown count by half (with curved normals possibly not at all) and widen the bound; so do
   visible parts over which curved normals would have been integrated more closely.
   LRCS_FLAG_STEPS_SPENT is set. The steps count work that grows faster than the scene, and are the
   same on every machine (over curved normals except for libm's last bits). Passes over facets,
   edges and contacts are not counted, nor are the pixels and searches of a raster, by method
   zbuffer, for an estimate or for lack of memory (examples/flight/README.md). lrcs_result.steps is
   the number that a run took.
   4. For previews. With LRCS_ACCEPT_ESTIMATE auto clips if that is likely to cost little more than
   a raster, and gives up after as many steps as fit in the time of the raster. Otherwise it draws a
   raster; a finer one if the estimated error, estimate_m2, exceeds what the proved parts of the
   bound (tessellation, rounding) leave of the tolerance; and it clips if no raster suffices. An
   estimate counts only if all depths were decided, no limit of steps was reached and sigma is not
   0. Such rasters, also with method zbuffer, cost no more than drawing them: their samples prove
   nothing about areas, so that the bound, still proved, includes all of each facet that could be
   visible or hidden (for fewer than 1,024 facets, with curved normals, or if there are curved
   shapes among other parts, it is tighter, and costs more: there auto clips). An answer whose bound
   meets the tolerance does not count as accepted by estimate. With LRCS_ACCEPT_ANY auto draws the
   coarsest of those rasters and accepts the result: no tolerance is missed. */
lrcs_run_options lrcs_run_options_default(void);

typedef struct lrcs_effect {
    int on;
    const char *reason; /* constant text */
} lrcs_effect;

const char *lrcs_effect_text(int effect); /* "self_shadowing", ... or NULL */

/* Flags: the answer is degraded, and the bound widened accordingly; or it was accepted without
   proof. */
enum lrcs_flag {
    LRCS_FLAG_TOLERANCE_NOT_MET = 1 << 0,
    /* lack of memory: a raster instead of clipping, or a coarser raster than requested, or facets
       that were not clipped */
    LRCS_FLAG_MEMORY_FALLBACK = 1 << 1,
    LRCS_FLAG_DEPTH_UNDECIDED = 1 << 2, /* two facets too close at a sample to order by depth */
    LRCS_FLAG_STEPS_SPENT = 1 << 3,     /* lrcs_run_options.steps did not suffice */
    /* the bound exceeds the tolerance; estimate_m2, a heuristic, does not, and the options accept
     * it
     */
    LRCS_FLAG_ACCEPTED_BY_ESTIMATE = 1 << 4,
    /* bound and estimate exceed the tolerance, or there is no estimate; the options accept any
       answer */
    LRCS_FLAG_ACCEPTED_UNJUDGED = 1 << 5
};
const char *lrcs_flag_text(int bit); /* "tolerance_not_met", ... Never NULL. */

/* Notices: facts worth knowing that do not degrade the answer. */
enum lrcs_notice {
    LRCS_NOTICE_BACK_SIDES_VISIBLE = 1 << 0,  /* open or inverted mesh */
    LRCS_NOTICE_TESSELLATION_UNKNOWN = 1 << 1 /* a curved shape no larger than rounding errors */
};
const char *lrcs_notice_text(int bit);

typedef struct lrcs_budget {
    double visibility_m2;   /* raster or clipping, and what a limit of steps left unknown */
    double tessellation_m2; /* negative: not known */
    double rounding_m2;
} lrcs_budget;

/* The result for one facet. The sigma of a shape evaluated by its closed form is distributed over
   its facets in proportion to what they would reflect. If only a sliver of the shape is lit and
   none of its facets faces the laser, no record contains its sigma. */
typedef struct lrcs_facet_record {
    double area_m2;         /* of the facet itself; 0 for degenerate and omitted ones */
    double cos_theta;       /* signed */
    double visible_area_m2; /* visible projected area, also of back sides */
    double sigma_m2;
    double sigma_glint_m2; /* the glint part of sigma_m2; the rest is diffuse */
} lrcs_facet_record;

typedef struct lrcs_result {
    double sigma_m2, sigma_glint_m2, sigma_diffuse_m2;
    double bound_m2; /* proved: |sigma - truth| <= bound, truth being Eq. 2 over the placed
                        facets (over the true shapes where the tessellation is known), their
                        normals curved where the scene's are: note 2 of lrcs_sigma_run */
    lrcs_budget budget;
    double estimate_m2;           /* estimated error of a raster's answer; negative: none */
    double curvature_estimate_m2; /* estimated error of the cubature over curved normals, not in the
                                     bound; negative: all facets are flat */
    double projected_area_m2;     /* the whole silhouette */
    double back_side_area_m2;     /* visible projected area of one-sided back sides */
    uint32_t back_side_facets;
    int method;                /* the one used, never AUTO */
    const char *method_reason; /* reason for the choice: constant text, "as asked" unless auto chose
                                */
    uint32_t resolution;       /* 0: no raster */
    uint32_t facets_total, facets_front, facets_hidden, facets_partial;
    lrcs_effect effect[LRCS_EFFECTS];
    uint32_t flags, notices;
    uint64_t steps; /* of the visibility computation: note 3 of lrcs_run_options_default */
} lrcs_result;

/* The item buffer: the facet that the laser sees in each pixel (row 0 on top, column 0 left;
   x right, y up), and the square of the observation frame that it covers, relative to the body's
   origin, to rounding. */
typedef struct lrcs_image {
    uint32_t size;                /* N, given, at most 16384; 0: no image requested */
    uint32_t *facet;              /* N * N, room provided by the caller: index, or LRCS_NONE */
    double left_m, top_m, side_m; /* returned */
} lrcs_image;

/* Bytes of work area that lrcs_sigma_run takes at most, for any pose, without an image; an image
   takes as much as method zbuffer at its resolution, if that is more. With less memory a run leaves
   facets unclipped, or uses a raster, or a coarser raster (LRCS_FLAG_MEMORY_FALLBACK; the result
   names the method used), or returns LRCS_E_MEMORY if even the coarsest does not fit. */
size_t lrcs_sigma_need(const lrcs_prepared *prepared, const lrcs_run_options *options);

/* sigma for a pose.
   Given: prepared; pose; options; work.
   Returned: result; records[facet_count] unless NULL; image unless NULL: then a raster is drawn for
   every method, image->size > 0 is its size, and image->facet has room for it.
   Status: LRCS_OK; LRCS_E_ARGUMENT (options, the image's size or the pose); LRCS_E_MEMORY;
   LRCS_E_NUMBER (the pose, or sigma beyond double range); LRCS_E_LIMIT (more than 2^32 - 2
   candidates in a grid); LRCS_E_UNSUPPORTED (this thread's arithmetic, as lrcs_prepare_run). Work:
   nothing stays in the work area. Every loop is bounded: examples/flight/README.md states the most
   work that a pose can require and what poses require in practice; options->steps sets a close
   limit.
   Notes: 1. With curved normals an integral replaces f_r cos^2 times an area. Its cubature has an
   error of about curvature_estimate_m2, which is not proved and not in the bound.
   2. For a partly visible facet with curved normals, samples determine how much is visible but not
   which part: method zbuffer clips such facets, as method exact does, if there is memory for it;
   otherwise the bound covers every possible part. */
int lrcs_sigma_run(const lrcs_prepared *prepared, const lrcs_pose *pose,
                   const lrcs_run_options *options, lrcs_work *work, lrcs_result *result,
                   lrcs_facet_record *records, lrcs_image *image);

#endif
