/* SPDX-License-Identifier: MIT */
/* What a sample in a cell sees, whether the surface component around it covers the cell, and what
   is behind it (visibility/cells.c). */
#ifndef LRCSI_CELLS_COVER_H
#define LRCSI_CELLS_COVER_H

#include "visibility/cells_state.h"

/* Samples that may be tried in a cell, and where. */
#define LRCSI_CELLS_TRIES 3
void lrcsi_cells_sample_point(const lrcsi_cells_cell *cell, int number, double at[2]);

enum { LRCSI_CELLS_UNSURE, LRCSI_CELLS_NONE, LRCSI_CELLS_FOUND };

/* Asks a sample well inside of a cell; where it cannot be decided, another. Returns its answer, the
   facet found, nearest to the laser with all others surely behind, where the last sample lies, and
   how far inside. */
int lrcsi_cells_look(lrcsi_cells_work *c, const lrcsi_cells_cell *cell, const lrcsi_cells_sides *s,
                     uint32_t *best, double at[2], double *clear);

/* The nearest facet at the sample that covers the cell alone, and that no contact crosses there;
   LRCS_NONE if there is none. */
uint32_t lrcsi_cells_screen(const lrcsi_cells_work *c, const lrcsi_cells_cell *cell,
                            const lrcsi_cells_sides *s, const double at[2]);

/* Follows the surface around a facet through the cell. 1 if it covers the cell once, unless
   events or contacts in the list cross it; its edges at the border of the cell are noted. */
int lrcsi_cells_component(lrcsi_cells_work *c, const lrcsi_cells_cell *cell,
                          const lrcsi_cells_sides *s, uint32_t best);

/* Is any facet of an edge, or of a contact, marked with a value? */
int lrcsi_cells_segment_of(const lrcs_prepared *prepared, const lrcsi_cells_segment *e,
                           const uint32_t *mark, uint32_t value);

/* Is any facet of a segment in the component? */
int lrcsi_cells_owned(const lrcsi_cells_work *c, const lrcsi_cells_segment *e);

/* The component is one facet, that covers the cell. */
void lrcsi_cells_component_of(lrcsi_cells_work *c, uint32_t facet);

/* Drops facets behind the component, which covers the cell, and the edges behind it. Given: the
   sample, where others may be nearer than the component, which is one facet then; NULL if none
   is. */
void lrcsi_cells_drop(lrcsi_cells_work *c, lrcsi_cells_cell *cell, const lrcsi_cells_sides *s,
                      const double *at, double uncertainty);

#endif
