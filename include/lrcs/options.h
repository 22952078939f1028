/* SPDX-License-Identifier: MIT */
/* How a run computes sigma: its method, what it must prove, which effects it includes, and when it
   stops. */
#ifndef LRCS_OPTIONS_H
#define LRCS_OPTIONS_H

#include <stdint.h>

enum lrcs_method {
    LRCS_METHOD_AUTO = 0, /* the cheapest of the others that meets the tolerance */
    LRCS_METHOD_FACET,    /* no search for shadows: exact only for a convex body */
    LRCS_METHOD_ZBUFFER,  /* visible areas from the samples of a raster */
    LRCS_METHOD_EXACT,    /* visible areas by clipping */
    LRCS_METHOD_CLOSED    /* in results only, chosen by auto: every part is a shape that nothing
                             hides */
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

/* What a scene may call for; what it does not call for is left out. */
enum lrcs_effect_name {
    LRCS_EFFECT_SELF_SHADOWING,    /* facets hide others */
    LRCS_EFFECT_BACK_FACE_CASTERS, /* so do facets whose backs face the laser */
    LRCS_EFFECT_GLINT,             /* the term A of the BRDF */
    LRCS_EFFECT_DIFFUSE,           /* the term B of the BRDF */
    LRCS_EFFECT_CURVED_NORMALS,    /* normals vary over a facet */
    LRCS_EFFECT_TWO_SIDED,         /* backs of facets reflect, too */
    LRCS_EFFECT_ARTICULATION,      /* a part has a joint */
    LRCS_EFFECT_CLOSED_FORMS,      /* method auto evaluates shapes that nothing hides without
                                      facets */
    LRCS_EFFECTS
};

const char *lrcs_effect_text(int effect); /* "self_shadowing", ... or NULL */

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

/* How far a run is: written by the run, for a signal handler of the same thread that shows it.
   Nothing else depends on it. The fields are written one after the other, so that a handler may see
   those of two stages mixed; each is seen whole where a uint32_t is read and written at once, as on
   all machines on which this library is tested, although C11 promises it of sig_atomic_t alone.
   Nothing is promised to another thread: nothing is synchronised, and to C11 its access would be a
   data race. */
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
    double *part_error_m2; /* where a run that succeeds writes, for each of the scene's parts, about
                              how much of budget.tessellation_m2 is due to it: what dividing the
                              part more finely reduces. NULL: nowhere. Threads must not share it.
                              Like progress it stands here, and not among the outputs of each
                              function that runs a pose, because it costs memory and time, and few
                              callers want it */
} lrcs_run_options;

/* 1e-4, auto, 0, 0, 0, 0, bound, NULL, NULL.

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
   then unknown count half (with curved normals possibly not at all) and widen the bound; so do
   visible parts over which curved normals would have been integrated more closely.
   LRCS_FLAG_STEPS_SPENT is set. The steps count work that grows faster than the scene, and are the
   same on every machine (over curved normals except for libm's last bits). Passes over facets,
   edges and contacts are not counted, nor are the pixels and searches of a raster, by method
   zbuffer, for an estimate or for lack of memory (examples/flight/README.md). lrcs_result.steps is
   the number that a run took.
   4. For previews. With LRCS_ACCEPT_ESTIMATE method auto
   - clips, if that is likely to cost little more than a raster, and gives up after as many steps as
     fit in the time of the raster, or after the last of `steps`: then nothing of it is left in the
     answer, and LRCS_FLAG_STEPS_SPENT is not set for it;
   - otherwise draws a raster, and finer ones while the estimated error (estimate_m2) exceeds what
     the proved parts of the bound (tessellation, rounding) leave of the tolerance;
   - clips if no raster suffices.
   An estimate is used only if all depths were decided, sigma is not 0, and no limit of steps left
   anything open that it includes. An answer whose bound meets the tolerance does not count as
   accepted by estimate. These rasters, also with method zbuffer, cost no more than drawing them:
   their samples prove nothing about areas, so that the bound, still proved, includes all of each
   facet that could be visible or hidden. For fewer than 1,024 facets, with curved normals, or if
   there are curved shapes among other parts, the bound is tighter and costs more: there auto clips.
   With LRCS_ACCEPT_ANY auto draws the coarsest of those rasters and accepts the result: no
   tolerance is missed. */
lrcs_run_options lrcs_run_options_default(void);

#endif
