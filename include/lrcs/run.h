/* SPDX-License-Identifier: MIT */
/* sigma of a prepared scene from a pose: Eq. 2 of Han et al. (2014) over the visible surface. */
#ifndef LRCS_RUN_H
#define LRCS_RUN_H

#include <lrcs/pose.h>
#include <lrcs/scene.h>

enum lrcs_method {
    LRCS_METHOD_AUTO = 0,
    LRCS_METHOD_FACET,
    LRCS_METHOD_ZBUFFER,
    LRCS_METHOD_EXACT,
    LRCS_METHOD_CLOSED /* an answer's alone, from auto: every part is a shape that nothing hides */
};

/* The method's name ("auto", ...), or NULL. And back, of those that may be asked for: LRCS_E_NAME
   for none. */
const char *lrcs_method_text(int method);
int lrcs_method_find(const char *name);

/* What must meet the tolerance for an answer to count as accurate enough. */
enum lrcs_accept {
    LRCS_ACCEPT_BOUND = 0, /* the proved bound */
    LRCS_ACCEPT_ESTIMATE,  /* or a raster's likely error, a guess: LRCS_FLAG_ACCEPTED_BY_ESTIMATE */
    LRCS_ACCEPT_ANY        /* or nothing: the first answer serves: LRCS_FLAG_ACCEPTED_UNJUDGED */
};

/* The name ("bound", ...), or NULL. And back: LRCS_E_NAME for none. */
const char *lrcs_accept_text(int accept);
int lrcs_accept_find(const char *name);

/* Everything about a scene that does not depend on direction: normals, edges, which facets
   touch which, what the planner can prove. Opaque; lives in the caller's work area. */
typedef struct lrcs_prepared lrcs_prepared;

/* Bytes a scene's preparation takes: an upper bound for ordinary scenes; where a scene's facets
   pierce each other without number, lrcs_prepare_run says LRCS_E_MEMORY and work->peak how far
   it got; a larger area then serves. */
size_t lrcs_prepare_need(const lrcs_scene *scene);

/* Prepares a scene, which must outlive the result. Coordinates below 2^-300 of the largest one
   count as zero. Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT (more than 2^32 - 2 neighbours in a
   list); LRCS_E_INDEX, LRCS_E_NUMBER (a scene not made by lrcs_scene_build); LRCS_E_UNSUPPORTED
   (this thread or build rounds doubles otherwise than IEEE 754 to nearest, fuses products and sums,
   or flushes what is below DBL_MIN to zero: nothing that is proved would hold). */
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
    LRCS_EFFECT_CLOSED_FORMS, /* shapes that nothing hides, by method auto: no facets stand for them
                               */
    LRCS_EFFECTS
};

/* Effects that a run may switch: not curved normals, articulation and closed forms, which its scene
   and its method decide. */
#define LRCS_EFFECTS_SWITCHED                                                                      \
    (1u << LRCS_EFFECT_SELF_SHADOWING | 1u << LRCS_EFFECT_BACK_FACE_CASTERS |                      \
     1u << LRCS_EFFECT_GLINT | 1u << LRCS_EFFECT_DIFFUSE | 1u << LRCS_EFFECT_TWO_SIDED)

typedef struct lrcs_run_options {
    double tolerance; /* relative, > 0: bound <= tolerance * sigma is asked for, and of a cubature
                         over curved normals that its estimate is no greater either */
    int method;       /* lrcs_method */
    uint32_t resolution; /* raster N x N, at most 16384; 0: chosen from the tolerance */
    uint32_t without;    /* effects to leave out, bits 1u << LRCS_EFFECT_...: note 1 */
    uint32_t with;       /* effects to simulate, none of them in `without`: note 2 */
    uint64_t steps;      /* most steps of finding what is seen, 0: no limit: note 3 */
    int accept;          /* lrcs_accept: note 4 */
} lrcs_run_options;

/* 1e-4, auto, 0, 0, 0, 0, bound.

   Notes: 1. `without` shows what an effect does and costs; leaving out one that is off changes
   nothing. Without self-shadowing a run is one by method facet, whatever the method: the bound
   still refers to the shadowed truth, and holds all that could be hidden. Otherwise the bound
   refers to a truth without the effect. Back-face casters: facets that face away are taken from
   the scene (back-face culling), two-sided ones too. Glint, diffuse: A or B is 0 everywhere.
   Two-sided: every material reflects from its front only.
   2. `with` shows that what the planner leaves out does not matter: sigma and the truth stay, to
   within the bounds. Self-shadowing is computed though proved absent (where the method is facet,
   as auto would do it), back sides are looked for and cast shadows though proved never seen, a
   term of amplitude 0 is evaluated. Where self-shadowing is left out, back sides are not looked
   for: nothing could hide them.
   3. Where `steps` are spent a run stops looking: facets, or parts of them, of which it is not
   known then whether they are seen count by half, of curved normals perhaps not at all, and widen
   the bound; so do parts that are seen over which curved normals would have been integrated closer.
   LRCS_FLAG_STEPS_SPENT is set. What grows faster than the scene is counted, alike on every machine
   (over curved normals but for libm's last bits): passes over facets, edges and contacts are not,
   nor are a raster's pixels and searches, by method zbuffer, for an estimate or for want of memory
   (examples/flight/README.md). lrcs_result.steps tells how many a run took.
   4. For previews: with LRCS_ACCEPT_ESTIMATE auto clips where that is likely to cost little more
   than a raster, and gives it up after as many steps as fit in the time of the raster; else it
   draws a raster, a finer one where its likely error, estimate_m2, exceeds what the proved parts of
   the bound (tessellation, rounding) leave of the tolerance, and clips where no raster's suffices.
   An estimate counts only where all depths were decided, no limit of steps was reached and sigma is
   not 0. Such rasters, of method zbuffer too, cost no more than to draw them: their samples prove
   nothing of areas, so that the bound, proved as ever, holds all that could show of each facet or
   be hidden (of fewer than 1,024 facets, where normals are curved, or where curved shapes stand
   among others, it is closer, and costs more: there auto clips). An answer that the bound admits is
   none by estimate. With LRCS_ACCEPT_ANY auto draws the coarsest of those rasters and takes what
   comes: no tolerance is missed. */
lrcs_run_options lrcs_run_options_default(void);

typedef struct lrcs_effect {
    int on;
    const char *reason; /* constant text */
} lrcs_effect;

const char *lrcs_effect_text(int effect); /* "self_shadowing", ... or NULL */

/* Flags: the answer is degraded, the bound widened accordingly; or it was accepted unproved. */
enum lrcs_flag {
    LRCS_FLAG_TOLERANCE_NOT_MET = 1 << 0,
    /* for want of memory: a raster in place of clipping, or a coarser one than asked, or facets
       that were not clipped */
    LRCS_FLAG_MEMORY_FALLBACK = 1 << 1,
    LRCS_FLAG_DEPTH_UNDECIDED = 1 << 2, /* two facets too close at a sample to tell apart */
    LRCS_FLAG_STEPS_SPENT = 1 << 3,     /* lrcs_run_options.steps did not suffice */
    /* the bound exceeds the tolerance: estimate_m2, a guess, does not, and was asked to count */
    LRCS_FLAG_ACCEPTED_BY_ESTIMATE = 1 << 4,
    /* bound and estimate exceed it, or there is none: any answer was asked to count */
    LRCS_FLAG_ACCEPTED_UNJUDGED = 1 << 5
};
const char *lrcs_flag_text(int bit); /* "tolerance_not_met", ... Never NULL. */

/* Notices: true and worth knowing, not a degradation. */
enum lrcs_notice {
    LRCS_NOTICE_BACK_SIDES_VISIBLE = 1 << 0,  /* open or inverted mesh */
    LRCS_NOTICE_TESSELLATION_UNKNOWN = 1 << 1 /* a curved shape as small as rounding */
};
const char *lrcs_notice_text(int bit);

typedef struct lrcs_budget {
    double visibility_m2;   /* raster or clip, and what steps that ran out left */
    double tessellation_m2; /* negative: not known */
    double rounding_m2;
} lrcs_budget;

/* What happened to one facet. A shape that counts by its closed form shares its sigma out among its
   facets in proportion to what they would reflect; of one of which a sliver is lit, but no facet
   faces the laser, no record has it. */
typedef struct lrcs_facet_record {
    double area_m2;         /* of the facet itself; 0 for degenerate and omitted ones */
    double cos_theta;       /* signed */
    double visible_area_m2; /* visible projected area, also of back sides */
    double sigma_m2;
    double sigma_glint_m2; /* of that; the rest is diffuse */
} lrcs_facet_record;

typedef struct lrcs_result {
    double sigma_m2, sigma_glint_m2, sigma_diffuse_m2;
    double bound_m2; /* proved: |sigma - truth| <= bound, truth being Eq. 2 over the placed
                        facets (over the true shapes where the tessellation is known), their
                        normals curved where the scene's are: note 2 of lrcs_sigma_run */
    lrcs_budget budget;
    double estimate_m2;           /* likely error of a raster's answer; negative: none */
    double curvature_estimate_m2; /* of the cubature over curved normals, not in the bound;
                                     negative: all facets are flat */
    double projected_area_m2;     /* the whole silhouette */
    double back_side_area_m2;     /* visible projected area of one-sided back sides */
    uint32_t back_side_facets;
    int method;                /* the one used, never AUTO */
    const char *method_reason; /* why that one: constant text, "as asked" unless auto chose */
    uint32_t resolution;       /* 0: no raster */
    uint32_t facets_total, facets_front, facets_hidden, facets_partial;
    lrcs_effect effect[LRCS_EFFECTS];
    uint32_t flags, notices;
    uint64_t steps; /* of finding what is seen: note 3 of lrcs_run_options_default */
} lrcs_result;

/* What the laser sees, pixel by pixel (row 0 on top, column 0 left; x right, y up), and which
   square of the observation frame that is, about the body's origin, to rounding. */
typedef struct lrcs_image {
    uint32_t size;                /* N, given, at most 16384; 0: none wanted */
    uint32_t *facet;              /* N * N, room given: facet index, or LRCS_NONE */
    double left_m, top_m, side_m; /* returned */
} lrcs_image;

/* Bytes of work area that lrcs_sigma_run takes at most, from any pose, an image left aside: that
   takes as much as method zbuffer at its resolution, if that is more. With less a run leaves facets
   unclipped, or uses a raster, or a coarser one (LRCS_FLAG_MEMORY_FALLBACK; the result names the
   method used), or says LRCS_E_MEMORY when even the coarsest does not fit. */
size_t lrcs_sigma_need(const lrcs_prepared *prepared, const lrcs_run_options *options);

/* sigma from a pose.
   Given: prepared; pose; options; work.
   Returned: result; records[facet_count] unless NULL; image unless NULL: then a raster is drawn
   whatever the method, image->size > 0 asks for its size and image->facet has room for it.
   Status: LRCS_OK; LRCS_E_ARGUMENT (options, the image's size or the pose); LRCS_E_MEMORY;
   LRCS_E_NUMBER (the pose, or sigma beyond double range); LRCS_E_LIMIT (more than 2^32 - 2
   candidates in a grid); LRCS_E_UNSUPPORTED (this thread's arithmetic, as lrcs_prepare_run). Work:
   nothing stays in the work area. Every loop is bounded: at most how much a pose asks, and how much
   it does, stands in examples/flight/README.md; options->steps bounds it closely.
   Notes: 1. Over curved normals an integral takes the place of f_r cos^2 times an area. Its
   cubature errs by about curvature_estimate_m2, which is not proved and not in the bound.
   2. Of a facet with curved normals that is seen in part, samples tell how much is seen but not
   where on it: method zbuffer clips those, as method exact does, where there is memory for it;
   elsewhere the bound holds whatever part that may be. */
int lrcs_sigma_run(const lrcs_prepared *prepared, const lrcs_pose *pose,
                   const lrcs_run_options *options, lrcs_work *work, lrcs_result *result,
                   lrcs_facet_record *records, lrcs_image *image);

#endif
