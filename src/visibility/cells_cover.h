/* SPDX-License-Identifier: MIT */
/* The facet nearest at a sample in a cell, whether its surface component covers the cell, and what
   is behind that (visibility/cells.c). */
#ifndef LRCSI_CELLS_COVER_H
#define LRCSI_CELLS_COVER_H

#include "visibility/cells_state.h"

/* How many samples are tried in a cell, and where they are. */
#define LRCSI_CELLS_TRIES 3
void lrcsi_cells_sample_point(const lrcsi_cells_cell *cell, int number, double at[2]);

enum { LRCSI_CELLS_UNSURE, LRCSI_CELLS_NONE, LRCSI_CELLS_FOUND };

/* Takes samples well inside a cell until one is decided. Returns UNSURE if none is; NONE if no
   facet covers it; FOUND and the facet nearest to the laser, all others being surely behind it.
   Also returned: the position of the last sample, and its distance from the border. */
int lrcsi_cells_look(lrcsi_cells_work *c, const lrcsi_cells_cell *cell, const lrcsi_cells_sides *s,
                     uint32_t *best, double at[2], double *clear);

/* Of the single facets that cover the cell and are crossed by no contact there, the one nearest at
   the sample; LRCS_NONE if there is none. */
uint32_t lrcsi_cells_screen(const lrcsi_cells_work *c, const lrcsi_cells_cell *cell,
                            const lrcsi_cells_sides *s, const double at[2]);

/* Finds the component around a facet within the cell. 1 if it covers the cell once, provided that
   no event edge or contact of the list crosses it; its edges at the border of the cell are
   recorded.
 */
int lrcsi_cells_component(lrcsi_cells_work *c, const lrcsi_cells_cell *cell,
                          const lrcsi_cells_sides *s, uint32_t best);

/* Is any facet of an edge, or of a contact, marked with a value? */
int lrcsi_cells_segment_of(const lrcs_prepared *prepared, const lrcsi_cells_segment *e,
                           const uint32_t *mark, uint32_t value);

/* Is any facet of a segment in the component? */
int lrcsi_cells_owned(const lrcsi_cells_work *c, const lrcsi_cells_segment *e);

/* Makes the component a single facet, which covers the cell. */
void lrcsi_cells_component_of(lrcsi_cells_work *c, uint32_t facet);

/* Removes the facets and edges behind the component, which covers the cell, from the cell's lists.
   Given: the sample if other facets may be nearer there than the component, which is then a single
   facet; else NULL. */
void lrcsi_cells_drop(lrcsi_cells_work *c, lrcsi_cells_cell *cell, const lrcsi_cells_sides *s,
                      const double *at, double uncertainty);

#endif
