/* SPDX-License-Identifier: MIT */
/* The responses of materials: what the surfaces of each material add to sigma at amplitudes A = B =
   1, and the derivatives of that in s and m. For any A and B, a material adds A times its glint
   response plus B times its diffuse response. */
#ifndef LRCSI_SENSITIVITY_H
#define LRCSI_SENSITIVITY_H

#include <lrcs/uncertainty.h>

#include "base/sum.h"
#include "integrate/sigma.h"

/* The sums of one material, scaled. */
typedef struct lrcsi_response {
    lrcsi_sum glint, diffuse;     /* at A = 1, at B = 1 */
    lrcsi_sum glint_s, diffuse_m; /* their derivatives in s, in m */
} lrcsi_response;

/* Given: a run that has reached LRCSI_SIGMA_SUM, whose integrals over curved normals, if any, are
   at amplitudes of 1 and for derivatives; brdf[material_count]: the s and m at which the responses
   are computed, and the A and B that decide for which facets the mean over their patch is used;
   as_sigma: 1 if brdf are the run's materials. Facets are then computed as they are in its sigma,
   so that A and B times the responses are sigma to rounding. Otherwise means over patches replace
   the integrals over pieces of round walls, which are known at the run's parameters only. Returned:
   response[material_count], summed over facets in their order, then over clear shapes. */
void lrcsi_response_make(const lrcsi_sigma *run, const lrcs_brdf *brdf, int as_sigma,
                         lrcsi_response *response);

#endif
