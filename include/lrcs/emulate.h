/* SPDX-License-Identifier: MIT */
/* The paper's method as graphics hardware runs it: what a z-buffer of a given resolution,
   arithmetic and depth gives, without a bound. Beside lrcs_sigma_run it tells the author of such a
   code what each of the three costs. */
#ifndef LRCS_EMULATE_H
#define LRCS_EMULATE_H

#include <lrcs/run.h>

enum lrcs_precision { LRCS_PRECISION_FLOAT64 = 0, LRCS_PRECISION_FLOAT32 };

/* The precision's name ("float64", "float32"), or NULL. And back: LRCS_E_NAME for none. */
const char *lrcs_precision_text(int precision);
int lrcs_precision_find(const char *name);

typedef struct lrcs_emulation_options {
    uint32_t resolution; /* raster N x N, 1 .. 16384 */
    int precision;       /* lrcs_precision */
    uint32_t depth_bits; /* 16, 24: fixed point; 32: float; 64: double, of which float32 fills 32 */
} lrcs_emulation_options;

/* 1024, float64, 64: nothing but sampling. */
lrcs_emulation_options lrcs_emulation_options_default(void);

typedef struct lrcs_emulation {
    double sigma_m2, sigma_glint_m2, sigma_diffuse_m2; /* each term summed by itself, in pairs */
    double running_m2;                                 /* sigma, were each pixel added to the sum
                                                          of all before it: floats lose much */
    double projected_area_m2;                          /* of the pixels that some facet owns */
} lrcs_emulation;

/* Bytes of work area that lrcs_emulate_run takes, from any pose. */
size_t lrcs_emulate_need(const lrcs_prepared *prepared, const lrcs_emulation_options *options);

/* sigma from a pose as hardware computes it.
   Given: prepared, all facets flat; pose; options; work.
   Returned: emulation; records[facet_count] unless NULL, whose visible area is that of the pixels
   owned; image unless NULL, its size the options' resolution: the item buffer. Finite, not bounded:
   compare with lrcs_sigma_run.
   Status: LRCS_OK; LRCS_E_ARGUMENT (options or the pose); LRCS_E_MEMORY; LRCS_E_UNSUPPORTED (curved
   normals; this thread's arithmetic, as lrcs_prepare_run); LRCS_E_NUMBER (the pose, sigma beyond
   double range, or a pixel's share of it beyond that of float32). Work: nothing stays in the work
   area. O(vertices + facets + fragments + N^2).
   Notes: 1. Each operation on vertices, depths, shades and sums is one IEEE operation at the
   precision, none of them fused. The host's part is in double, rounded once as it is uploaded:
   vertices about the scene's centre in units of a power of two near its reach, one matrix to the
   clip cube, unit normals, materials. exp and pow are libm's for doubles, rounded to the precision:
   the bits of floats hang on libm in some one of 2^28 values, those of doubles in its last place.
   2. Clip and window coordinates follow OpenGL, depth from 0 (near) to 1; the scene takes the
   middle of the depth range, 1/128 of the window's side left free at both ends. Corners are snapped
   to 1/256 pixel, those flung beyond 2^15 pixels held there; a pixel belongs to a facet whose
   snapped triangle holds its centre, by the top-left rule. Depth is weighted by exact edge
   functions rounded once.
   3. The depth test is LESS: of equal depths the facet first in order wins, where lrcs_sigma_run
   lets a front beat a back. Facets of either facing are drawn, none is culled.
   4. A pixel holds f_r cos(theta). Sums over the N x N pixels are pairwise: neighbours in raster
   order from the bottom, then neighbours of those; pixels without owner add 0. */
int lrcs_emulate_run(const lrcs_prepared *prepared, const lrcs_pose *pose,
                     const lrcs_emulation_options *options, lrcs_work *work,
                     lrcs_emulation *emulation, lrcs_facet_record *records, lrcs_image *image);

#endif
