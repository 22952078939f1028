/* SPDX-License-Identifier: MIT */
/* What other parts hide of curved shapes in truth, where they hide their facets. */
#ifndef LRCSI_PROXIMITY_HIDDEN_H
#define LRCSI_PROXIMITY_HIDDEN_H

#include "visibility/proximity/proximity_band.h"
#include "visibility/raster/visible.h"

/* Bytes for lrcsi_proximity_find_hidden. */
size_t lrcsi_proximity_hidden_need(const lrcs_prepared *prepared);

/* Given visible areas, finds what is hidden in truth too: regions, which it marks; and facets that
   meet bands, of which mismatch, gain, loss and rows become 0. Without memory, or when the meter is
   spent, it finds less. It may be called again with other areas of the same view. */
void lrcsi_proximity_find_hidden(lrcsi_proximity_band *band, const lrcsi_visible_area *visible,
                                 lrcsi_meter *meter, lrcs_work *work);

#endif
