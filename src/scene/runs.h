/* SPDX-License-Identifier: MIT */
/* Runs of a few facets that are consecutive in the scene; most files list neighbours consecutively.
   Facts about a run that hold for all directions let a view treat its facets together. */
#ifndef LRCSI_RUNS_H
#define LRCSI_RUNS_H

#include "scene/prepared.h"

size_t lrcsi_runs_need(uint32_t facet_count);

/* Given a scene whose edges, neighbours and contacts are prepared. Status: LRCS_OK; LRCS_E_MEMORY.
   The result stays in the work area. Linear time. */
int lrcsi_runs_make(const lrcs_prepared *prepared, lrcs_work *work, lrcsi_runs *runs);

#endif
