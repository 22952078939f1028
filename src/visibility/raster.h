/* SPDX-License-Identifier: MIT */
/* The z-buffer: N x N samples at pixel centres over the view's window. The owner of a sample is the
   facet that covers it nearest the laser. Coverage and depth order are exact (visibility/sample.h);
   nearly always doubles decide them, because their error bound suffices.

   Samples are divided into tiles. If only some facets matter, only the tiles around these are
   active: nothing else is cleared, drawn or read, and its memory is never touched. */
#ifndef LRCSI_RASTER_H
#define LRCSI_RASTER_H

#include "view/view.h"
#include "visibility/span.h"

/* The side of a tile in pixels. */
#define LRCSI_RASTER_TILE 8u

typedef struct lrcsi_raster {
    const lrcsi_view *view;
    uint32_t size;         /* N */
    double pixel;          /* side of a pixel, scaled units */
    double scale;          /* pixels per scaled unit */
    double sample_err;     /* error bound of the pixel coordinates of samples */
    double radius;         /* |x| + |y| of a sample in the view is at most this */
    uint32_t tiles;        /* along each side */
    unsigned char *active; /* tiles * tiles: 1 if the samples of the tile are drawn */
    uint32_t *owner;       /* N * N, row 0 at the bottom: facet, or LRCS_NONE */
    double *depth;         /* N * N: height of the owner's plane, if its facet was drawn */
    unsigned char *full;   /* N * N: 1 if the owner covers the whole pixel and is visible in all of
                              it; set only by lrcsi_raster_fill */
    float *occluder;       /* N * N: a height; everything lower is hidden in the whole pixel by one
                              drawn facet. -HUGE_VALF: none known. NULL: not needed */
    double *height_err;    /* facet: error bound of its heights if drawn; -1 if filled */
    uint32_t *covered;     /* facet: if drawn, the samples that it covers; else 0 */
    uint32_t *owned;       /* facet: if drawn, the samples that it owns; else 0 */
    unsigned char *undecided; /* facet: 1 if the order of it and another could not be decided */
} lrcsi_raster;

/* The plane of a facet: height = c + dx x + dy y, with x and y in pixels. */
typedef struct lrcsi_plane {
    double c, dx, dy;
} lrcsi_plane;

/* Bytes for lrcsi_raster_start or lrcsi_raster_make. */
size_t lrcsi_raster_need(const lrcs_prepared *prepared, uint32_t size);

/* Draws all of the view. Back sides are drawn if they cast shadows (view->backs.cast).
   Status: LRCS_OK; LRCS_E_MEMORY. The raster stays in the work area. */
int lrcsi_raster_make(const lrcsi_view *view, uint32_t size, lrcs_work *work, lrcsi_raster *raster);

/* The same in steps: start; activate the tiles of facets; clear; fill; draw.
   Status: LRCS_OK; LRCS_E_MEMORY. The raster stays in the work area; none of its tiles is active.
 */
int lrcsi_raster_start(const lrcsi_view *view, uint32_t size, lrcs_work *work,
                       lrcsi_raster *raster);

/* Activates the tiles of all pixels that the facet may touch, and of two pixels around them. */
void lrcsi_raster_activate(lrcsi_raster *raster, uint32_t facet);

/* Initializes the samples of active tiles: they have no owner. */
void lrcsi_raster_clear(lrcsi_raster *raster);

/* Makes a facet that is known to be entirely visible the owner of all active samples that it
   covers, without comparing depths. */
void lrcsi_raster_fill(lrcsi_raster *raster, uint32_t facet);

/* Draws a facet whose tiles are all active: it becomes the owner of the samples at which it is
   nearer than the owner so far. Raises `occluder` in the pixels that it covers entirely. */
void lrcsi_raster_draw(lrcsi_raster *raster, uint32_t facet);

/* Sets size, pixel, scale, sample_err and radius only: a raster without samples. */
void lrcsi_raster_layout(const lrcsi_view *view, uint32_t size, lrcsi_raster *raster);

/* The centre of a pixel as a point of the scene. */
void lrcsi_raster_sample(const lrcsi_raster *raster, uint32_t x, uint32_t y, double point[3]);

/* The edge functions of a facet, complete. */
lrcsi_edge_functions lrcsi_raster_edge_functions(const lrcsi_raster *raster, uint32_t facet);

/* The plane of a facet, and the error bound of its heights at samples and within the facet;
   HUGE_VAL if it is too close to edge-on. */
lrcsi_plane lrcsi_raster_plane(const lrcsi_raster *raster, uint32_t facet);
double lrcsi_raster_height_err(const lrcsi_raster *raster, uint32_t facet);

/* A vertex in pixel coordinates. Returns the error bound of each, including that of samples. */
double lrcsi_raster_point(const lrcsi_raster *raster, uint32_t vertex, double xy[2]);

/* The owner of a sample: LRCS_NONE if there is none, also outside active tiles. */
static inline uint32_t lrcsi_raster_owner(const lrcsi_raster *raster, uint32_t x, uint32_t y)
{
    size_t tile = (size_t)(y / LRCSI_RASTER_TILE) * raster->tiles + x / LRCSI_RASTER_TILE;
    return raster->active[tile] ? raster->owner[(size_t)y * raster->size + x] : LRCS_NONE;
}

#endif
