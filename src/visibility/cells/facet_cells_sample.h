/* SPDX-License-Identifier: MIT */
/* Samples in the cells of one facet, f: is it hidden there? (visibility/cells/facet_cells.c) */
#ifndef LRCSI_FACET_CELLS_SAMPLE_H
#define LRCSI_FACET_CELLS_SAMPLE_H

#include "visibility/cells/facet_cells_state.h"

/* How the facets at a sample are found: with error bounds, at its point of the frame; exactly, at a
   nearby point in space; or by the signs of rounded values, which is only a guess. */
enum lrcsi_sample_test { LRCSI_TEST_BOUNDED, LRCSI_TEST_EXACT, LRCSI_TEST_GUESSED };

/* A sample in a cell. */
typedef struct lrcsi_facet_cells_sample {
    double at[2];
    double border_distance; /* a lower bound of its distance from the border of the cell */
    int test;               /* a lrcsi_sample_test */
    double point[3];
    double err;         /* the distance in the view between `at` and `point` */
    double view[3];     /* its coordinates in the view, except for the depth */
    double view_err;    /* their error, each */
    lrcsi_view_box box; /* around it in the view; its depth does not count */
    int hidden;         /* is f hidden there? 1 yes, 0 no, -1 undecided */
    int guess;          /* the same if it is decided; else 1 if f is probably hidden, 0 if not */
    /* The number of segments along which the cell may be cut: if f is hidden, those at which a
       component in front of f ends or meets f, of the component with the fewest; otherwise all.
       And the one of these whose line passes nearest to the sample, so that both parts are of
       similar size; NULL: there is none. */
    uint32_t ends;
    const lrcsi_cells_segment *cut;
} lrcsi_facet_cells_sample;

/* Takes samples in the cell until one is decided, and returns the last one. */
void lrcsi_facet_cells_sample_take(lrcsi_facet_cells *cells, const lrcsi_cell *cell,
                                   const lrcsi_clip_sides *s, lrcsi_facet_cells_sample *sample);

#endif
