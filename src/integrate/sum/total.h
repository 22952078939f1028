/* SPDX-License-Identifier: MIT */
/* The sum of Eq. 2: from visible areas to sigma and its parts, with the contribution of each source
   of error to the bound. */
#ifndef LRCSI_TOTAL_H
#define LRCSI_TOTAL_H

#include "integrate/sum/total_run.h"

/* Given: the view and its plan; the visible areas (answer NULL if there are curved shapes); the
   results of facets with curved normals, curve_terms[facet_count] (NULL: all are flat); the
   proximity band (NULL: none was made); the shapes that are evaluated by their closed forms instead
   of their facets. Returned: the total, and the details asked for. The order of the sum is:
   materials in their order, the facets of each in theirs; then clear shapes in theirs. */
lrcsi_total lrcsi_total_make(const lrcsi_view *view, const lrcsi_plan *plan,
                             const lrcsi_areas *areas, const lrcsi_curve_terms *curve_terms,
                             const lrcsi_masked_band *band, const lrcsi_clear_shapes *clear,
                             lrcsi_total_details *details);

#endif
