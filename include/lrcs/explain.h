/* SPDX-License-Identifier: MIT */
/* What each effect of a pose takes and does, and what each stage takes, by measurement. */
#ifndef LRCS_EXPLAIN_H
#define LRCS_EXPLAIN_H

#include <lrcs/load.h>

/* The result of flipping an effect: an effect that is on was left out, one that is off was
   simulated. All zero if a run cannot switch it (LRCS_EFFECTS_SWITCHED). */
typedef struct lrcs_host_explained_effect {
    double seconds;  /* time that it takes, or would take */
    double scatter;  /* standard error of that */
    double sigma_m2; /* sigma with the effect flipped */
} lrcs_host_explained_effect;

typedef struct lrcs_host_explained {
    double pose;                         /* seconds of the pose as planned */
    double stage[LRCS_HOST_POSE_STAGES]; /* of a pose by the method and raster that answered */
    double stage_scatter[LRCS_HOST_POSE_STAGES];
    uint32_t rounds; /* of measurements, each with every effect and stage */
    lrcs_host_explained_effect effect[LRCS_EFFECTS];
} lrcs_host_explained;

/* Runs a pose repeatedly, with each effect flipped in turn, and up to each stage: for some 2 s, or
   once for each. Times are those of the processor.
   Given: the prepared scene, pose and options of a run, and its result; show: called before each
   effect, for a display, or NULL. Status: as lrcs_host_scene_run and lrcs_host_scene_run_until. */
int lrcs_host_explain(const lrcs_host_scene *scene, const lrcs_pose *pose,
                      const lrcs_run_options *options, const lrcs_result *result,
                      void (*show)(uint32_t done, uint32_t count), lrcs_host_explained *explained,
                      lrcs_host_error *error);

#endif
