/* SPDX-License-Identifier: MIT */
/* The paper's method as graphics hardware runs it: the result of a z-buffer of a given resolution,
   arithmetic and depth format, without a bound. Compared with lrcs_sigma_run, it shows the author
   of such a code how much error each of the three causes. */
#ifndef LRCS_EMULATE_H
#define LRCS_EMULATE_H

#include <lrcs/run.h>

enum lrcs_precision { LRCS_PRECISION_FLOAT64 = 0, LRCS_PRECISION_FLOAT32 };

/* The precision's name ("float64", "float32"), or NULL. lrcs_precision_find is the inverse:
   LRCS_E_NAME for an unknown name. */
const char *lrcs_precision_text(int precision);
int lrcs_precision_find(const char *name);

typedef struct lrcs_emulation_options {
    uint32_t resolution; /* raster N x N, 1 .. 16384 */
    int precision;       /* lrcs_precision */
    uint32_t depth_bits; /* 16, 24: fixed point; 32: float; 64: double (holds single-precision
                            values where precision is float32) */
} lrcs_emulation_options;

/* 1024, float64, 64: with these, sampling is the only significant error. */
lrcs_emulation_options lrcs_emulation_options_default(void);

typedef struct lrcs_emulation {
    double sigma_m2, sigma_glint_m2, sigma_diffuse_m2; /* each term by a pairwise sum of its own */
    double running_m2;                                 /* sigma by sequential summation, pixel after
                                                          pixel: in floats, much less accurate */
    double projected_area_m2;                          /* of the pixels that show a facet */
} lrcs_emulation;

/* Bytes of work area that lrcs_emulate_run takes, for any pose. */
size_t lrcs_emulate_need(const lrcs_prepared *prepared, const lrcs_emulation_options *options);

/* sigma for a pose, as graphics hardware computes it.
   Given: prepared, all facets flat; pose; options; work.
   Returned: emulation; records[facet_count] unless NULL: the visible area of a facet is that of
   its pixels; image unless NULL: the item buffer, of the size options->resolution. All values are
   finite and have no bound: compare with lrcs_sigma_run.
   Status: LRCS_OK; LRCS_E_ARGUMENT (options or the pose); LRCS_E_MEMORY; LRCS_E_UNSUPPORTED (curved
   normals; this thread's arithmetic, as lrcs_prepare_run); LRCS_E_NUMBER (the pose, sigma beyond
   double range, or the contribution of a pixel beyond float32 range). Work: O(vertices + facets +
   fragments + N^2); nothing stays in the work area.
   Notes: 1. Each operation on vertices, depths, shades and sums is one IEEE operation at the
   precision, none of them fused. What a host program computes is in double and rounded once on
   upload: vertices relative to the scene's centre in units of a power of two near the scene's
   radius, one matrix to the clip cube, unit normals, materials. exp and pow are libm's for doubles,
   rounded to the precision: float results depend on libm in about one of 2^28 values, double
   results in the last place.
   2. Clip and window coordinates follow OpenGL, depth from 0 (near) to 1; the scene occupies the
   middle of the depth range, with 1/128 of the window's side left free at both ends. Corners are
   snapped to 1/256 pixel; coordinates beyond 2^15 pixels are clamped to that. A pixel belongs to a
   facet if its centre is in the snapped triangle, by the top-left rule. Depth is interpolated with
   exact edge functions rounded once.
   3. The depth test is LESS: of equal depths the facet first in order wins, whereas in
   lrcs_sigma_run a front side wins against a back side. Front and back facing facets are drawn;
   none is culled.
   4. A pixel holds f_r cos(theta). Sums over the N x N pixels are pairwise: neighbours in raster
   order from the bottom, then neighbouring sums, and so on; pixels without a facet add 0. */
int lrcs_emulate_run(const lrcs_prepared *prepared, const lrcs_pose *pose,
                     const lrcs_emulation_options *options, lrcs_work *work,
                     lrcs_emulation *emulation, lrcs_facet_record *records, lrcs_image *image);

#endif
