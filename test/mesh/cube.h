/* SPDX-License-Identifier: MIT */
/* The unit cube: its vertices, and two facets a side, which face outward. */
#ifndef TEST_CUBE_H
#define TEST_CUBE_H

#include <lrcs/mesh.h>

static const lrcs_point cube_vertex[8] = {{{0, 0, 0}}, {{1, 0, 0}}, {{1, 1, 0}}, {{0, 1, 0}},
                                          {{0, 0, 1}}, {{1, 0, 1}}, {{1, 1, 1}}, {{0, 1, 1}}};
static const lrcs_facet cube_facet[12] = {{{0, 2, 1}}, {{0, 3, 2}}, {{4, 5, 6}}, {{4, 6, 7}},
                                          {{0, 1, 5}}, {{0, 5, 4}}, {{1, 2, 6}}, {{1, 6, 5}},
                                          {{2, 3, 7}}, {{2, 7, 6}}, {{3, 0, 4}}, {{3, 4, 7}}};

#endif
