/* SPDX-License-Identifier: MIT */
/* Preparing a scene: the stages that fill a lrcs_prepared (scene/prepared.h). */
#ifndef LRCSI_PREPARE_H
#define LRCSI_PREPARE_H

#include "scene/prepared.h"

/* The stages of lrcs_prepare_run, in their order. A host may run them one by one to time them (the
   core has no clock). */
enum lrcsi_prepare_stage {
    LRCSI_PREPARE_EDGES,      /* scaled and welded vertices; edges */
    LRCSI_PREPARE_NEIGHBOURS, /* live facets, coincident facets, neighbours */
    LRCSI_PREPARE_CONTACTS,   /* contacts between facets; whether the scene is solid */
    LRCSI_PREPARE_NORMALS,    /* normals by facet, and batches by material for the sum */
    LRCSI_PREPARE_PROOFS,     /* convexity, proximity of curved shapes, extents; runs of facets */
    LRCSI_PREPARE_STAGES
};

/* Checks the scene and starts its preparation. Status: as lrcs_prepare_run. After a failure, here
   or in a stage, the caller releases the work area. */
int lrcsi_prepare_start(const lrcs_scene *scene, lrcs_work *work, lrcs_prepared **prepared);
int lrcsi_prepare_stage(lrcs_prepared *prepared, int stage, lrcs_work *work);

#endif
