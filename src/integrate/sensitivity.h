/* SPDX-License-Identifier: MIT */
/* The responses of materials: what the surfaces of each material add to sigma at amplitudes A = B =
   1, and the derivatives of that in s and m. For any A and B, a material adds A times its glint
   response plus B times its diffuse response. */
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

/* Given: a view, its plan, its visible areas and its clear shapes as for lrcsi_total_make;
   curved[]: the integrals over facets with curved normals, at amplitudes of 1 and with moments
   (NULL: there are none); brdf[material_count]: the s and m at which the responses are computed,
   and the A and B that decide for which facets the mean over their patch is used. Returned:
   response[material_count], summed over facets in their order, then over clear shapes. */
void lrcsi_response_make(const lrcsi_view *view, const lrcsi_plan *plan, const lrcsi_areas *areas,
                         const lrcsi_curved *curved, const lrcsi_clear *clear,
                         const lrcs_brdf *brdf, lrcsi_response *response);

#endif
