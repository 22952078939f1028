/* SPDX-License-Identifier: MIT */
/* A run is a few facets with consecutive indices. Most files list neighbouring facets one after
   another, so that the facets of a run are usually close together and connected. A view can then
   process a whole run at once. */
#ifndef LRCSI_RUNS_H
#define LRCSI_RUNS_H

#include <string.h>

#include "scene/prepared.h"

size_t lrcsi_runs_need(uint32_t facet_count);

/* Given a scene whose edges, neighbours and contacts are prepared. Status: LRCS_OK; LRCS_E_MEMORY.
   The result stays in the work area. Linear time. */
int lrcsi_runs_make(const lrcs_prepared *prepared, lrcs_work *work, lrcsi_runs *runs);

/* Are all LRCSI_RUN values of a run equal? */
static inline int lrcsi_run_alike(const signed char *value, uint32_t run)
{
    uint64_t word[LRCSI_RUN / sizeof(uint64_t)];
    memcpy(word, value + (size_t)run * LRCSI_RUN, sizeof word);
    return word[0] == word[1] && word[0] == (word[0] & 0xff) * 0x0101010101010101u;
}

#endif
