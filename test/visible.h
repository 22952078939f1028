/* SPDX-License-Identifier: MIT */
/* 210 small scenes full of degenerate contacts with what is visible of every facet, in exact
   rational arithmetic (test/vectors/visible.py). Coordinates are integers within -8 .. 8. */
#ifndef TEST_VISIBLE_H
#define TEST_VISIBLE_H

#include "scenes.h"

#define VISIBLE_MOST 24

typedef struct visible_case {
    const char *kind;
    uint32_t vertices, facets;
    double direction[3];
    lrcs_point vertex[VISIBLE_MOST];
    lrcs_facet facet[VISIBLE_MOST];
    double share[VISIBLE_MOST]; /* of the projected area that is visible; -1: edge-on */
} visible_case;

static const visible_case cases[] = {
#include "vectors/visible.inc"
};
#define CASES (sizeof cases / sizeof *cases)

static inline void visible_scene(test_scene *s, const visible_case *c, int two_sided)
{
    scene_start(s);
    s->material[0].brdf.s = 0.5;
    s->material[0].two_sided = (unsigned char)two_sided;
    for (uint32_t v = 0; v < c->vertices; v++) {
        scene_vertex(s, c->vertex[v].x[0], c->vertex[v].x[1], c->vertex[v].x[2]);
    }
    for (uint32_t f = 0; f < c->facets; f++) {
        scene_facet(s, c->facet[f].corner[0], c->facet[f].corner[1], c->facet[f].corner[2]);
    }
}

#endif
