/* SPDX-License-Identifier: MIT */
/* What a run of a pose is asked for, its state, and the functions by which its four files share
   the work: sigma.c runs the stages, sigma_attempt.c chooses how visible areas are searched for and
   ends each attempt, sigma_search.c finds them, sigma_sum.c sums over them. */
#ifndef LRCSI_SIGMA_RUN_H
#define LRCSI_SIGMA_RUN_H

#include <math.h>

#include "integrate/plan/cost.h"
#include "integrate/sum/total.h"
#include "visibility/uniform/decisions.h"

enum lrcsi_sigma_stage {
    LRCSI_SIGMA_VIEW,       /* which facets face the laser; their view coordinates, if needed */
    LRCSI_SIGMA_CLASSIFY,   /* event edges; which facets are undecided */
    LRCSI_SIGMA_VISIBILITY, /* visible areas */
    LRCSI_SIGMA_SUM,        /* Eq. 2; the integrals over facets with curved normals */
    LRCSI_SIGMA_STAGES
};

/* The answer of a run, or of its last attempt, and how it was found. */
typedef struct lrcsi_outcome {
    int method; /* lrcs_method; as planned, unless another one had to follow */
    const char *reason;
    uint32_t size; /* of the raster that gave the areas; 0: none did */
    uint32_t flags;
    lrcsi_total total;
} lrcsi_outcome;

/* What a run of a pose is asked for. */
typedef struct lrcsi_sigma_request {
    const lrcs_run_options *options; /* checked */
    int last;                        /* lrcsi_sigma_stage: the run ends after it */
    int derivatives;    /* 1: integrals over curved normals, and over visible pieces of round walls,
                           include what derivatives need */
    double *part_error; /* room for [part_count], as in lrcs_run_options; NULL: not asked for */
} lrcsi_sigma_request;

/* Room for what the stages find, as far as the plan's method needs it. */
typedef struct lrcsi_sigma_memory {
    lrcsi_visible_area *visible;  /* [facet_count]; NULL: the plan implies all areas */
    lrcsi_moment *moment;         /* [facet_count]; NULL: moments are not wanted */
    lrcsi_wall_terms *wall_terms; /* [facet_count]; NULL: no integrals over walls are wanted */
    lrcsi_flat_face *face;        /* [faces]; NULL: no margins on flat faces are wanted */
} lrcsi_sigma_memory;

/* The state of a run and, at its end, what the stages found. */
typedef struct lrcsi_sigma {
    lrcsi_sigma_request request;
    lrcs_work *work;
    lrcsi_view view;
    lrcsi_meter meter;        /* limit on the steps of the visibility computation */
    lrcsi_clear_shapes clear; /* those evaluated by their closed forms: method auto only */
    lrcsi_plan plan;          /* is not changed once it is made */
    int classified;           /* the classification is made, and the bands if the plan needs them */
    lrcsi_classification classification;
    lrcsi_proximity_band band; /* is not changed once it is made */
    lrcsi_masked_band masked;  /* the band, less what an attempt has found to be hidden */
    lrcsi_sigma_memory memory;
    lrcsi_areas areas;              /* what the last attempt found */
    double *corrected;              /* as in lrcsi_total_details */
    lrcsi_curve_terms *curve_terms; /* [facet_count]; NULL: all normals are flat */
    lrcsi_cubature_cell *stack;     /* NULL: all normals are flat */
    lrcsi_outcome outcome;
} lrcsi_sigma;

/* How an attempt ended. */
enum lrcsi_attempt_end {
    LRCSI_ATTEMPT_NONE,      /* there was none */
    LRCSI_ATTEMPT_FOUND,     /* visible areas were found */
    LRCSI_ATTEMPT_ABANDONED, /* it took as many steps as it was allowed, and was not done */
    LRCSI_ATTEMPT_REFUSED,   /* more facets are undecided than its limit allows for */
    LRCSI_ATTEMPT_NO_MEMORY  /* the work area is too small for clipping */
};

/* An attempt to find visible areas whose sum is accepted. */
typedef struct lrcsi_attempt {
    int method;         /* LRCS_METHOD_EXACT or LRCS_METHOD_ZBUFFER */
    const char *reason; /* why this method */
    double limit_ns;    /* the time that clipping may take, as estimated; HUGE_VAL: no limit */
    uint32_t size;      /* of a raster */
    int samples_only;   /* of a raster, as in lrcsi_plan */
    int fallback;       /* a raster in place of clipping, for which memory was short */
    lrcsi_meter meter;  /* the run's, with the limit of this attempt */
    int end;            /* lrcsi_attempt_end */
    size_t mark; /* of the work area, before what an attempt leaves in it that found nothing */
} lrcsi_attempt;

static inline int lrcsi_attempt_is_limited(const lrcsi_attempt *attempt)
{
    return attempt->limit_ns < HUGE_VAL;
}

/* Has limited clipping taken all steps that it may: those that fit in its time, or the run's last
   ones? */
static inline int lrcsi_attempt_is_over_limit(const lrcsi_attempt *attempt)
{
    return lrcsi_attempt_is_limited(attempt) && attempt->meter.spent;
}

/* The attempts of a run so far. Before the first: zeros, and the cost. */
typedef struct lrcsi_attempts {
    lrcsi_attempt current; /* between attempts: the last one */
    /* What the choice of the next one depends on: */
    lrcsi_cost cost;     /* if the plan has previews */
    uint32_t size;       /* of the next raster */
    uint32_t rasters;    /* chosen so far */
    double abandoned_ns; /* the limit of the last clipping that was abandoned; 0: none was */
    int memory_short;    /* memory was short for limited clipping, which is not tried again */
    int steps_short;     /* limited clipping was abandoned because the run had no more steps */
    /* What rasters share whose areas are proved: */
    int decided; /* decisions are made, and are the last item in the work area */
    lrcsi_decisions decisions;
    size_t mark; /* of the work area before them */
} lrcsi_attempts;

/* The size of the finest raster. A heuristic: a finer one would improve the bound too little for
   its cost. */
#define LRCSI_SIGMA_SIZE_MAX 4096u

/* --- sigma_attempt.c -------------------------------------------------------------------------- */

/* Chooses the next attempt. Given: *attempts; run->outcome, which has the sum of the last one.
   Returned: 1 with attempts->current, or 0 if the answer is accepted or no other attempt would
   improve it. */
int lrcsi_attempts_next(const lrcsi_sigma *run, lrcsi_attempts *attempts);

/* Ends attempts->current, after the sum over its areas if it found any: its steps count as the
   run's, it is abandoned if it has spent those of its limit, and the work area is released if it
   has not found areas. */
void lrcsi_attempts_end(lrcsi_sigma *run, lrcsi_attempts *attempts);

/* --- sigma_search.c --------------------------------------------------------------------------- */

/* Finds which facets are undecided, and the proximity band if the plan needs it; once per pose.
   If steps run out, what is undecided for lack of them stays undecided, unless the caller retries
   with more steps: then nothing is kept. Status: as lrcs_sigma_run. */
int lrcsi_sigma_classify(lrcsi_sigma *run, lrcsi_meter *meter, int retries);

/* Makes the attempt attempts->current: finds visible areas. Returned: how it ended and, if they
   were found, run->areas, without wall_terms and face, and run->outcome, without its total.
   Status: LRCS_OK, however it ended; others as lrcs_sigma_run. */
int lrcsi_sigma_search(lrcsi_sigma *run, lrcsi_attempts *attempts);

/* Releases the memory that rasters share: before other memory is taken that is to stay. */
void lrcsi_sigma_release_decisions(lrcsi_sigma *run, lrcsi_attempts *attempts);

/* --- sigma_sum.c ------------------------------------------------------------------------------ */

/* The proved bound of a total, m^2. */
double lrcsi_sigma_bound(const lrcsi_total *total);

/* How the answer is accepted: 0 if its bound meets the tolerance, else a flag. */
uint32_t lrcsi_sigma_acceptance(const lrcsi_sigma *run);

/* The options of integrals over curved normals; steps are taken from the given meter. */
lrcsi_curve_options lrcsi_sigma_curve_options(const lrcsi_sigma *run, lrcsi_meter *meter);

/* Is the scene one convex curved shape? Nothing hides its outside then, and integrals over its
   sectors at the limb need no moments. */
static inline int lrcsi_sigma_is_one_convex_shape(const lrcs_prepared *prepared)
{
    return prepared->convex && prepared->scene->part_count == 1 && prepared->has_curved_shapes &&
           !prepared->has_curved_normals;
}

/* Are there proofs about the visible areas of the pose that the methods do not use? */
int lrcsi_sigma_has_proofs(const lrcsi_sigma *run);

/* The sum over the visible areas. Returned also: records[facet_count] unless NULL, the errors of
   parts if they are asked for, and run->corrected. */
lrcsi_total lrcsi_sigma_sum(lrcsi_sigma *run, lrcs_facet_record *records);

/* What the sum needs beside the areas that samples or clipping found: proofs about them, integrals
   over curved normals, margins on flat faces and integrals over visible pieces, which complete
   run->areas. Steps are taken from the given meter, that of the attempt that found them. */
void lrcsi_sigma_integrate(lrcsi_sigma *run, lrcsi_meter *meter);

/* Fills run->outcome.total where no shadows are searched for. */
void lrcsi_sigma_sum_unshadowed(lrcsi_sigma *run);

#endif
