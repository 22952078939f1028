/* SPDX-License-Identifier: MIT */
/* The facet nearest at a sample in a cell, whether its surface component covers the cell, and what
   is behind that (visibility/cells.c). */
#ifndef LRCSI_CELLS_COVER_H
#define LRCSI_CELLS_COVER_H

#include "visibility/cells_state.h"

/* The number of samples that are tried in a cell, and their positions. */
#define LRCSI_SAMPLES 3
void lrcsi_cells_sample_point(const lrcsi_cell *cell, int number, double at[2]);

enum { LRCSI_SAMPLE_UNSURE, LRCSI_SAMPLE_EMPTY, LRCSI_SAMPLE_FOUND };

/* Takes samples well inside a cell until one is decided. Returns UNSURE if none is; NONE if no
   facet covers it; FOUND and the facet nearest to the laser if all others are certainly behind it.
   Also returned: the position of the last sample, and its distance from the border. */
int lrcsi_cells_nearest(lrcsi_cells_work *c, const lrcsi_cell *cell, const lrcsi_clip_sides *s,
                        uint32_t *best, double at[2], double *clear);

/* Finds the component around the facet nearest at the sample: within 0, all listed facets that are
   connected with it; within 1, to be called after that, only those that are connected across edges
   that may cross the cell. Returns 1 if it covers the cell once and no event edge of it is left in
   the list; its edges at the border of the cell are then recorded, and the facets that it meets at
   a contact of the list are marked. */
int lrcsi_cells_component(lrcsi_cells_work *c, const lrcsi_cell *cell, const lrcsi_clip_sides *s,
                          uint32_t best, int within);

/* Is any facet of an edge, or of a contact, marked with this value? */
int lrcsi_cells_segment_has(const lrcs_prepared *prepared, const lrcsi_cells_segment *e,
                            const uint32_t *mark, uint32_t value);

/* Is any facet of a segment in the component? */
int lrcsi_cells_of_component(const lrcsi_cells_work *c, const lrcsi_cells_segment *e);

/* Of the facets that each cover the cell alone, takes the one nearest at the sample as the
   component. 0 if there is none. */
int lrcsi_cells_find_occluder(lrcsi_cells_work *c, const lrcsi_cell *cell,
                              const lrcsi_clip_sides *s, const double at[2]);

/* Removes the facets and edges behind the component, which covers the cell, from the cell's lists.
   Given: the sample if other facets may be nearer there than the component, which is then a single
   facet; else NULL. */
void lrcsi_cells_cull(lrcsi_cells_work *c, lrcsi_cell *cell, const lrcsi_clip_sides *s,
                      const double *at, double uncertainty);

#endif
