/* SPDX-License-Identifier: MIT */
/* The z-buffer: N x N samples at pixel centres over the view's window, each owned by the facet
   nearest the laser there. Coverage and depth are exact (visibility/sample.h): doubles decide
   where their error bound allows, which is nearly always. */
#ifndef LRCSI_RASTER_H
#define LRCSI_RASTER_H

#include "view/view.h"

typedef struct lrcsi_raster {
    const lrcsi_view *view;
    uint32_t size;
    double pixel;             /* side of a pixel, scaled units */
    double scale;             /* pixels per scaled unit */
    double off;               /* bound on the error of a pixel coordinate */
    uint32_t *owner;          /* N * N, row 0 at the bottom: facet, or LRCS_NONE */
    double *depth;            /* N * N: height of the owner's plane */
    double *slack;            /* facet: error bound of such a height */
    uint32_t *covered;        /* facet: samples it would own if alone */
    uint32_t *owned;          /* facet: samples it owns */
    unsigned char *undecided; /* facet: 1 where a depth could not be told */
} lrcsi_raster;

/* A facet's edge functions in pixel coordinates, positive inside: value = at + along x + up y. */
typedef struct lrcsi_edges {
    double at[3], along[3], up[3];
    double off;              /* error bound of a value inside the box */
    uint32_t x0, x1, y0, y1; /* pixels whose centres may be covered: x0 <= x < x1 */
} lrcsi_edges;

/* The plane of a facet: height = at + along x + up y, x and y in pixels. */
typedef struct lrcsi_plane {
    double at, along, up;
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
