/* SPDX-License-Identifier: MIT */
/* The z-buffer: N x N samples at pixel centres over the view's window. The owner of a sample is the
   facet that covers it nearest the laser. Coverage and depth order are exact
   (visibility/base/sample.h); nearly always floats or doubles decide them, because their error
   bounds suffice.

   Samples are divided into tiles. If only some facets matter, only the tiles around these are
   active: nothing else is cleared, drawn or read, and its memory is never touched. */
#ifndef LRCSI_RASTER_H
#define LRCSI_RASTER_H

#include "base/progress.h"
#include "view/view.h"
#include "visibility/raster/span.h"

/* The side of a tile in pixels. */
#define LRCSI_RASTER_TILE 8u

typedef struct lrcsi_raster {
    const lrcsi_view *view;
    uint32_t size;          /* N */
    double pixel;           /* side of a pixel, scaled units */
    double pixels_per_unit; /* scaled units */
    double sample_err;      /* error bound of the pixel coordinates of samples */
    double radius;          /* |x| + |y| of a sample in the view is at most this */
    uint32_t tiles;         /* along each side */
    unsigned char *active;  /* tiles * tiles: 1 if the samples of the tile are drawn */
    uint32_t *owner;        /* N * N, row 0 at the bottom: facet, or LRCS_NONE */
    float *depth; /* N * N: height of an ordinary owner's plane (visibility/raster/raster_draw.c),
                          0 for other owners; -HUGE_VALF: no owner; HUGE_VALF: the owner is
                          known to be visible */
    float *occluder;   /* N * N: a height; what is lower is hidden in the whole pixel by one facet.
                          -HUGE_VALF: none known; HUGE_VALF: a facet known to be visible covers
                          the pixel, and all others are hidden. NULL: not needed */
    uint32_t *covered; /* facet: if drawn with a depth test, the samples that it covers; else 0 */
    uint32_t *owned;   /* facet: the samples of active tiles that it owns */
    unsigned char *order_undecided; /* facet: 1 if the depth order of it and another could not be
                                       decided */
} lrcsi_raster;

/* The plane of a facet: height = c + dx x + dy y, with x and y in pixels. */
typedef struct lrcsi_plane {
    double c, dx, dy;
    double err; /* error bound of its heights at samples and within the facet; HUGE_VAL: it is too
                   close to edge-on */
} lrcsi_plane;

/* Its height at the centre of a pixel. */
static inline double lrcsi_plane_height(const lrcsi_plane *plane, uint32_t x, uint32_t y)
{
    return plane->c + plane->dx * (x + 0.5) + plane->dy * (y + 0.5);
}

/* Draws all of the view, if answer is NULL: back sides too, if they cast shadows
   (view->backs.cast). Otherwise draws only the tiles around undecided facets: all pixels that these
   may touch, and two pixels around them. Given: answer[facet], a lrcsi_query_answer. Facets known
   to be visible own all active samples that they cover, without a depth test; facets known to be
   hidden own none and are not drawn. Finds occluder heights. In both cases counts the samples that
   facets own.
   Status: LRCS_OK; LRCS_E_MEMORY. The raster stays in the work area, at most `need` bytes, given
   whether there are answers. */
size_t lrcsi_raster_need(const lrcs_prepared *prepared, uint32_t size, int answers);
int lrcsi_raster_make(const lrcsi_view *view, uint32_t size, const unsigned char *answer,
                      lrcs_progress *progress, lrcs_work *work, lrcsi_raster *raster);

/* Sets size, pixel, pixels_per_unit, sample_err and radius only: a raster without samples. */
void lrcsi_raster_layout(const lrcsi_view *view, uint32_t size, lrcsi_raster *raster);

/* The pixels along one axis whose centres lie within low .. high, coordinates with errors up to
   `err`: pixels *from <= pixel < *to; none if *from >= *to. */
static inline void lrcsi_raster_centres(const lrcsi_raster *r, double low, double high, double err,
                                        uint32_t *from, uint32_t *to)
{
    double first = lrcsi_min(lrcsi_max(low - 0.5 - err, 0), r->size);
    *from = (uint32_t)first;
    *from += *from < first;
    *to = (uint32_t)lrcsi_min(lrcsi_max(high + 0.5 + err, 0), r->size);
}

/* The centre of a pixel as a point of the scene. */
void lrcsi_raster_sample(const lrcsi_raster *raster, uint32_t x, uint32_t y, double point[3]);

/* The edge functions of a facet, complete. */
lrcsi_edge_functions lrcsi_raster_edge_functions(const lrcsi_raster *raster, uint32_t facet);

/* The plane of a facet. */
lrcsi_plane lrcsi_raster_plane(const lrcsi_raster *raster, uint32_t facet);

/* A vertex in pixel coordinates. Returns the error bound of each, including that of samples. */
double lrcsi_raster_point(const lrcsi_raster *raster, uint32_t vertex, double xy[2]);

/* A segment in pixels, from a to b; its points have errors of at most `err` along both axes. */
typedef struct lrcsi_raster_segment {
    double a[2], b[2], err;
} lrcsi_raster_segment;

/* The line in which the planes of two facets intersect, as far as it may pass through pixels that
   `facet` touches. Given: box, its edge functions. A point at which the facets meet in such a pixel
   is at most line->err from the segment, if that is at most LRCSI_RASTER_LINE_ERR_MAX; otherwise
   nothing is known about where they meet. line->err includes the errors of the ends, and exceeds
   32 u of their coordinates. Returns 0 if the line passes through none of these pixels, under the
   same condition. */
#define LRCSI_RASTER_LINE_ERR_MAX 0.125
int lrcsi_raster_intersection(const lrcsi_raster *raster, const lrcsi_edge_functions *box,
                              uint32_t facet, uint32_t other, lrcsi_raster_segment *line);

/* An edge of the topology. */
lrcsi_raster_segment lrcsi_raster_edge(const lrcsi_raster *raster, uint32_t edge);

/* The segments on which a contact of a facet may begin or cease to hide it: of a facet that passes
   through it, the line in which their planes intersect (see lrcsi_raster_intersection; `err` is set
   in any case); of one that lies in its plane or ends on it, the sides. Given: box, as above.
   Returns how many there are. */
int lrcsi_raster_contact(const lrcsi_raster *raster, const lrcsi_edge_functions *box,
                         uint32_t facet, const lrcsi_intersection *contact,
                         lrcsi_raster_segment segment[3]);

/* The owner of a sample: LRCS_NONE if there is none, also outside active tiles. */
static inline uint32_t lrcsi_raster_owner(const lrcsi_raster *raster, uint32_t x, uint32_t y)
{
    size_t tile = (size_t)(y / LRCSI_RASTER_TILE) * raster->tiles + x / LRCSI_RASTER_TILE;
    return raster->active[tile] ? raster->owner[(size_t)y * raster->size + x] : LRCS_NONE;
}

#endif
