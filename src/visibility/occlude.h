/* SPDX-License-Identifier: MIT */
/* The visible area of a contested facet, analytically: its projection less the union of what
   nearer facets cover, each cut by the half-space in front of the facet's plane. */
#ifndef LRCSI_OCCLUDE_H
#define LRCSI_OCCLUDE_H

#include "visibility/clip.h"
#include "visibility/visible.h"

size_t lrcsi_occlude_need(const lrcs_prepared *prepared);

/* Every facet: uniform ones by one exact sample, contested ones by clipping unless one sheet hides
   all of them.
   Status: LRCS_OK; LRCS_E_MEMORY; LRCS_E_LIMIT. Nothing stays in the work area. A facet that falls
   into more pieces than the lists hold keeps the area reached as an upper bound. */
int lrcsi_occlude_all(lrcsi_contest *contest, lrcs_work *work, lrcsi_visible *visible);

#endif
