/* SPDX-License-Identifier: MIT */
/* The facet nearest at a sample in a cell, whether its surface component covers the cell, and what
   is behind that (visibility/cells/cells.c). */
#ifndef LRCSI_CELLS_COVER_H
#define LRCSI_CELLS_COVER_H

#include <string.h>

#include "visibility/cells/cells_block.h"

/* The number of samples that are tried in a cell, and their positions. */
#define LRCSI_SAMPLES 3
void lrcsi_cells_sample_point(const lrcsi_cell *cell, int number, double at[2]);

enum lrcsi_sample_outcome {
    LRCSI_SAMPLE_UNSURE, /* neither is certain */
    LRCSI_SAMPLE_EMPTY,  /* no facet covers it */
    LRCSI_SAMPLE_FOUND   /* a facet covers it, and all others are certainly behind that one */
};

/* A sample in a cell. */
typedef struct lrcsi_cells_sample {
    int outcome; /* a lrcsi_sample_outcome */
    double at[2];
    double border_distance; /* a lower bound of its distance from the border of the cell */
    uint32_t nearest;       /* if FOUND: the facet nearest to the laser */
    /* The facets of the cell that may cover the sample: */
    uint32_t *hit, hit_count;
    uint32_t *covers;   /* facet: 2 n + 1 if it certainly covers the sample, 2 n if it may, n being
                           listed.number */
    lrcsi_marks listed; /* the facets of the cell */
} lrcsi_cells_sample;

/* Unmarks all of the scene's facets, listed and covering ones: the numbers of both are the same. */
static inline void lrcsi_cells_sample_clear(lrcsi_cells_sample *sample, uint32_t facet_count)
{
    if (sample->listed.number == LRCSI_MARKS_LAST) {
        memset(sample->covers, 0, (size_t)facet_count * sizeof *sample->covers);
    }
    lrcsi_marks_clear(&sample->listed, facet_count);
}

/* Takes samples well inside a cell until one is decided, and returns the last one. */
void lrcsi_cells_sample_take(const lrcsi_division *d, const lrcsi_cell *cell,
                             const lrcsi_clip_sides *s, lrcsi_cells_sample *sample);

/* Is the last sample, which is in the cell, far enough from the border of the cell to serve for it
   as well? */
int lrcsi_cells_sample_keep(const lrcsi_division *d, const lrcsi_cell *cell,
                            const lrcsi_clip_sides *s, lrcsi_cells_sample *sample);

/* The most edges of a surface at the border of a cell. */
#define LRCSI_SURFACE_BORDERS 128u

/* Facets that may cover a cell together: a surface component, or one facet alone. */
typedef struct lrcsi_cells_surface {
    uint32_t *facet, facet_count;
    int nearest;               /* 1: no other facet is nearer at the sample */
    lrcsi_cell_border *border; /* its edges at the border of the cell */
    uint32_t border_count;
    /* The foreground: the facets of the component around the facet nearest at the sample and, if
       the surface is another facet alone, that facet too. lrcsi_cells_cull removes none of them. */
    lrcsi_marks foreground;
    lrcsi_marks adjoining; /* the facets of the segments in the cell that belong to the foreground:
                              those that it meets at a contact */
} lrcsi_cells_surface;

/* Which facets belong to the surface component around the facet nearest at a sample. */
enum lrcsi_surface_extent {
    LRCSI_SURFACE_LISTED, /* all of the cell's list that are connected with it */
    LRCSI_SURFACE_IN_CELL /* only those connected across edges that may cross the cell */
};

/* Finds the component around the facet nearest at a sample. Returns 1 if it covers the cell once
   and no event edge of it is left in the list; its edges at the border of the cell and the facets
   that it meets at a contact in the cell are then found too. extent: a lrcsi_surface_extent. */
int lrcsi_cells_surface_find(const lrcsi_division *d, const lrcsi_cell *cell,
                             const lrcsi_clip_sides *s, const lrcsi_cells_sample *sample,
                             int extent, lrcsi_cells_surface *surface);

/* The component around the facet nearest at a sample, found in a cell that it covers, for a part of
   that cell: only what it meets there is found again. */
void lrcsi_cells_surface_keep(const lrcsi_division *d, const lrcsi_cell *cell,
                              lrcsi_cells_surface *surface);

/* Given: a component that does not cover the cell. Of the facets that each cover the cell alone,
   takes the one nearest at the sample as the surface. Returns 0 if there is none. The facets of the
   component stay in the foreground, even those behind that facet. */
int lrcsi_cells_surface_occluder(const lrcsi_division *d, const lrcsi_cell *cell,
                                 const lrcsi_clip_sides *s, const lrcsi_cells_sample *sample,
                                 lrcsi_cells_surface *surface);

/* Removes the facets and segments behind a surface that covers the cell from the cell's lists;
   facets that are removed are no longer marked in sample->listed. They are hidden in the cell,
   except for an area of at most `uncertainty` more than that of the cell. */
void lrcsi_cells_cull(lrcsi_blocks *b, lrcsi_cell *cell, const lrcsi_clip_sides *s,
                      const lrcsi_cells_surface *surface, double uncertainty,
                      lrcsi_cells_sample *sample);

#endif
