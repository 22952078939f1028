/* SPDX-License-Identifier: MIT */
/* The pairs of facets of different parts that are within their slack of each other, and the parts
   that facets on round walls are near. */
#ifndef LRCSI_PROXIMITY_SEARCH_H
#define LRCSI_PROXIMITY_SEARCH_H

#include "scene/prepared.h"

/* Finds all of them, given what prepared->proximity holds of each part. The pairs stay in the work
   area. Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_proximity_search(lrcs_prepared *prepared, lrcs_work *work);

#endif
