/* SPDX-License-Identifier: MIT */
/* The z-buffer: N x N samples at pixel centres over the view's window, each owned by the facet
   nearest the laser there. Coverage and depth are exact (visibility/sample.h): doubles decide
   where their error bound allows, which is nearly always.

   Samples are kept in tiles; where only some facets matter, only the tiles about them are wanted:
   nothing else is cleared, drawn or read, and the memory of the rest is never touched. */
#ifndef LRCSI_RASTER_H
#define LRCSI_RASTER_H

#include "view/view.h"
#include "visibility/span.h"

/* Pixels along a tile. */
#define LRCSI_RASTER_TILE 8u

typedef struct lrcsi_raster {
    const lrcsi_view *view;
    uint32_t size;
    double pixel;          /* side of a pixel, scaled units */
    double scale;          /* pixels per scaled unit */
    double off;            /* bound on the error of a sample's pixel coordinates */
    double reach;          /* no sample is farther from the view's origin, |x| + |y| */
    uint32_t tiles;        /* along each side */
    unsigned char *wanted; /* tiles * tiles: 1 if samples are drawn */
    uint32_t *owner;       /* N * N, row 0 at the bottom: facet, or LRCS_NONE */
    double *depth;         /* N * N: height of the owner's plane, where its facet was drawn */
    unsigned char *pure;   /* N * N: 1 if the owner covers the whole pixel and is visible all
                              over it; set by claims alone */
    float *occluded;       /* N * N: a height; all that lies lower is hidden in the whole pixel by
                              one drawn facet. -HUGE_VALF: none known. NULL: not asked for */
    double *slack;         /* facet drawn: error bound of such a height; claimed: -1 */
    uint32_t *covered;     /* facet drawn: samples it would own if alone; else 0 */
    uint32_t *owned;       /* facet drawn: samples it owns; else 0 */
    unsigned char *undecided; /* facet: 1 if a depth could not be decided */
} lrcsi_raster;

/* The plane of a facet: height = at + along x + up y, x and y in pixels. */
typedef struct lrcsi_plane {
    double at, along, up;
} lrcsi_plane;

size_t lrcsi_raster_need(const lrcs_prepared *prepared, uint32_t size);

/* Draws the view, all of it. Back sides are drawn where they cast (view->backs.cast).
   Status: LRCS_OK; LRCS_E_MEMORY. The raster stays in the work area. */
int lrcsi_raster_make(const lrcsi_view *view, uint32_t size, lrcs_work *work, lrcsi_raster *raster);

/* The same by hand: start, say which facets are wanted, clear, claim, draw.
   Status: LRCS_OK; LRCS_E_MEMORY. The raster stays in the work area, no tile of it wanted. */
int lrcsi_raster_start(const lrcsi_view *view, uint32_t size, lrcs_work *work,
                       lrcsi_raster *raster);

/* Wants the tiles of all pixels that the facet may touch, and of two pixels about them. */
void lrcsi_raster_want(lrcsi_raster *raster, uint32_t facet);

/* Leaves the samples of wanted tiles without owners. */
void lrcsi_raster_clear(lrcsi_raster *raster);

/* Gives a facet that is proved visible, all of it, the wanted samples that it covers. */
void lrcsi_raster_claim(lrcsi_raster *raster, uint32_t facet);

/* Draws a facet, all tiles of which are wanted, where it is nearer than what was drawn; raises the
   occluded heights of pixels that it covers. */
void lrcsi_raster_draw(lrcsi_raster *raster, uint32_t facet);

/* The geometry of a raster, without samples. */
void lrcsi_raster_over(const lrcsi_view *view, uint32_t size, lrcsi_raster *raster);

lrcsi_edges lrcsi_raster_edges(const lrcsi_raster *raster, uint32_t facet);
lrcsi_plane lrcsi_raster_plane(const lrcsi_raster *raster, uint32_t facet);

/* Error bound of the heights of a facet's plane. */
double lrcsi_raster_slack(const lrcsi_raster *raster, uint32_t facet);

/* A vertex in pixel coordinates; returns how far each may be off, that of samples included. */
double lrcsi_raster_point(const lrcsi_raster *raster, uint32_t vertex, double xy[2]);

/* The owner of a sample: LRCS_NONE if nobody is, also outside wanted tiles. */
static inline uint32_t lrcsi_raster_owner(const lrcsi_raster *raster, uint32_t x, uint32_t y)
{
    size_t tile = (size_t)(y / LRCSI_RASTER_TILE) * raster->tiles + x / LRCSI_RASTER_TILE;
    return raster->wanted[tile] ? raster->owner[(size_t)y * raster->size + x] : LRCS_NONE;
}

#endif
