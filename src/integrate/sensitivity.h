/* SPDX-License-Identifier: MIT */
/* What each material's surfaces reflect at amplitudes of 1, and its slopes in s and m: sigma is A
   times the first plus B times the second, for any A and B. */
#ifndef LRCSI_SENSITIVITY_H
#define LRCSI_SENSITIVITY_H

#include <lrcs/uncertainty.h>

#include "base/sum.h"
#include "integrate/total.h"

/* The sums of one material, scaled. */
typedef struct lrcsi_response {
    lrcsi_sum glint, diffuse;     /* at A = 1, at B = 1 */
    lrcsi_sum glint_s, diffuse_m; /* their derivatives in s, in m */
} lrcsi_response;

/* Given: a view, its plan and its visible areas as for lrcsi_total_make; curved: facets with curved
   normals, integrated at amplitudes of 1 with their moments (NULL: none); brdf[material_count]: the
   s and m to use, A and B being ignored.
   Returned: response[material_count], facets first, in their order, then clear shapes. */
void lrcsi_response_make(const lrcsi_view *view, const lrcsi_plan *plan, const lrcsi_areas *areas,
                         const lrcsi_curved *curved, const lrcsi_clear *clear,
                         const lrcs_brdf *brdf, lrcsi_response *response);

#endif
