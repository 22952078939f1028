/* SPDX-License-Identifier: MIT */
/* A run is a few facets with consecutive indices. Most files list neighbouring facets one after
   another, so that the facets of a run are usually close together and connected. A view can then
   process a whole run at once. */
#ifndef LRCSI_RUNS_H
#define LRCSI_RUNS_H

#include "scene/prepared.h"

size_t lrcsi_runs_need(uint32_t facet_count);

/* Given a scene whose edges, neighbours and contacts are prepared. Status: LRCS_OK; LRCS_E_MEMORY.
   The result stays in the work area. Linear time. */
int lrcsi_runs_make(const lrcs_prepared *prepared, lrcs_work *work, lrcsi_runs *runs);

#endif
