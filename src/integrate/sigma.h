/* SPDX-License-Identifier: MIT */
/* The stages of one pose. They are called by lrcs_sigma_run, by computations that need intermediate
   results (integrate/uncertainty.c), and by hosts that time them, because the core has no clock. */
#ifndef LRCSI_SIGMA_H
#define LRCSI_SIGMA_H

#include "integrate/total.h"

enum lrcsi_sigma_stage {
    LRCSI_SIGMA_VIEW,       /* which facets face the laser; their view coordinates, if needed */
    LRCSI_SIGMA_CLASSIFY,   /* event edges; which facets are undecided */
    LRCSI_SIGMA_VISIBILITY, /* visible areas */
    LRCSI_SIGMA_SUM,        /* Eq. 2; the integrals over facets with curved normals */
    LRCSI_SIGMA_STAGES
};

/* The answer of a run, and how it was found. */
typedef struct lrcsi_outcome {
    int method; /* lrcs_method; as planned, unless another one had to follow */
    const char *reason;
    uint32_t size; /* of the raster that gave the areas; 0: none did */
    uint32_t flags;
    lrcsi_total total;
} lrcsi_outcome;

/* The state of a run. The caller sets the first six fields, and all others to 0. */
typedef struct lrcsi_sigma {
    const lrcs_run_options *options;
    lrcs_work *work;
    lrcs_image *image;  /* NULL: no picture is requested */
    double *part_error; /* returned, [part_count]: as in lrcs_run_options; NULL: not asked for */
    int last;           /* lrcsi_sigma_stage: the run ends after it */
    int derivatives;    /* 1: integrals over curved normals include what derivatives need */

    lrcsi_view view;
    lrcsi_meter meter; /* limit on the steps of the visibility computation */
    lrcsi_clear_shapes
        clear;       /* shapes that are evaluated by their closed forms: method auto only */
    lrcsi_plan plan; /* is not changed once it is made */
    int classified;  /* the classification is made, and the band if the plan needs it */
    lrcsi_classification classification;
    lrcsi_proximity_band band;
    lrcsi_visible_area *visible;     /* [facet_count]; NULL: the plan implies all areas */
    const unsigned char *answer;     /* as in lrcsi_areas */
    lrcsi_moment *moment_memory;     /* [facet_count]; NULL: moments are not wanted */
    const lrcsi_moment *moment;      /* as in lrcsi_areas */
    unsigned char *corrected;        /* as in lrcsi_total_details */
    lrcsi_round_piece *piece_memory; /* [facet_count]; NULL: pieces are not wanted */
    const lrcsi_round_piece *piece;  /* as in lrcsi_areas */
    lrcsi_curved *curved;            /* [facet_count]; NULL: all normals are flat */
    lrcsi_cubature_cell *stack;      /* NULL: all normals are flat */
    lrcsi_outcome outcome;
} lrcsi_sigma;

/* Checks options and the size of a picture (NULL: none). Status: LRCS_OK; LRCS_E_ARGUMENT. */
int lrcsi_sigma_check(const lrcs_run_options *options, const lrcs_image *image);

/* Runs all stages up to run->last, with checked options. Status: as lrcs_sigma_run. The results of
   the stages stay in the work area. */
int lrcsi_sigma_stages(lrcsi_sigma *run, const lrcs_prepared *prepared, const lrcs_pose *pose);

/* Memory for part_error, or NULL if the options do not ask for it. *status: LRCS_E_MEMORY if there
   is none; else unchanged. */
double *lrcsi_sigma_part_error(const lrcs_prepared *prepared, const lrcs_run_options *options,
                               lrcs_work *work, int *status);

/* Writes run->part_error where the options ask for it: for runs that succeed. */
void lrcsi_sigma_part_error_give(const lrcsi_sigma *run);

/* The result after the last stage. Status: LRCS_OK; LRCS_E_NUMBER if sigma or its bound is not
   finite. */
int lrcsi_sigma_result(const lrcsi_sigma *run, lrcs_result *result);

/* Runs a pose up to a stage and discards the results. Status: as lrcs_sigma_run; LRCS_E_ARGUMENT
   for method AUTO, which may run stages more than once. */
int lrcsi_sigma_until(const lrcs_prepared *prepared, const lrcs_pose *pose,
                      const lrcs_run_options *options, int last, lrcs_work *work);

#endif
