/* SPDX-License-Identifier: MIT */
/* F over pieces of a patch that are nearly edge-on to the laser, or face it in part only: there it
   is not analytic, because it counts as 0 where the surface faces away. */
#ifndef LRCSI_PATCH_EDGE_ON_H
#define LRCSI_PATCH_EDGE_ON_H

#include "integrate/wall/patch_frame.h"

/* An upper bound of F, with the weights, on a piece whose normals differ by at most `shift` from
   that in its middle; infinite if none is known. */
double lrcsi_patch_edge_on_bound(const lrcsi_patch_frame *f, const lrcs_brdf *brdf, double shift);

/* F at the largest cosine of such a piece. */
double lrcsi_patch_edge_on_most(const lrcsi_patch_frame *f, const lrcs_brdf *brdf, double shift);

/* The mean of F over a piece, of the diffuse term alone, and a bound on its error, which includes
   the glint; infinite if none is known. */
typedef struct lrcsi_edge_on_mean {
    double diffuse, error;
    double diffuse_log; /* an estimate of the mean of log(1 + u) times the diffuse term */
} lrcsi_edge_on_mean;
lrcsi_edge_on_mean lrcsi_patch_edge_on_mean(const lrcsi_patch_frame *f, const lrcs_brdf *brdf,
                                            double shift);

#endif
