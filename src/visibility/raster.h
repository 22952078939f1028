/* SPDX-License-Identifier: MIT */
/* The z-buffer: N x N samples at pixel centres over the view's window, each owned by the facet
   nearest the laser there. Coverage and order are exact (visibility/sample.h): floats and doubles
   decide where their error bounds allow, which is nearly always.

   Depths are kept as floats. A facet is ordinary where its heights, as floats, are within
   `near_err`, a millionth of the window's side; nearly all are. Ordinary facets are drawn first,
   samples side by side, and compared by the floats kept; the others (all but edge-on, or reaching
   far from the window) follow sample by sample, and their heights are computed anew. */
#ifndef LRCSI_RASTER_H
#define LRCSI_RASTER_H

#include "view/view.h"
#include "visibility/span.h"

typedef struct lrcsi_raster {
    const lrcsi_view *view;
    uint32_t size;
    double pixel;             /* side of a pixel, scaled units */
    double scale;             /* pixels per scaled unit */
    double off;               /* bound on the error of a pixel coordinate */
    double near_err;          /* bound on the error of an ordinary facet's depth */
    uint32_t *owner;          /* N * N, row 0 at the bottom: facet, or LRCS_NONE */
    float *depth;             /* N * N: height of the owner's plane; of a facet that is not ordinary
                                 no more than that; -HUGE_VALF where nobody is */
    uint32_t *sample;         /* facet: one of the samples that it covers, as y N + x; LRCS_NONE
                                 where it covers none, or casts nothing */
    unsigned char *undecided; /* facet: 1 where a depth could not be told */
} lrcsi_raster;

/* The plane of a facet: height = at + along x + up y, x and y in pixels. */
typedef struct lrcsi_plane {
    double at, along, up;
    double err; /* error bound of such a height at a sample; infinite where all but edge-on */
} lrcsi_plane;

size_t lrcsi_raster_need(const lrcs_prepared *prepared, uint32_t size);

/* Draws the view. Back sides are drawn where they cast (view->backs_cast).
   Status: LRCS_OK; LRCS_E_MEMORY. The raster stays in the work area. */
int lrcsi_raster_make(const lrcsi_view *view, uint32_t size, lrcs_work *work, lrcsi_raster *raster);

lrcsi_edges lrcsi_raster_edges(const lrcsi_raster *raster, uint32_t facet);
lrcsi_plane lrcsi_raster_plane(const lrcsi_raster *raster, uint32_t facet);

/* A vertex in pixel coordinates. */
void lrcsi_raster_point(const lrcsi_raster *raster, uint32_t vertex, double xy[2]);

#endif
