/* SPDX-License-Identifier: MIT */
/* The benchmarks' scenes, generated at any fineness. */
#ifndef BENCH_SCENES_H
#define BENCH_SCENES_H

#include <lrcs/lrcs.h>

typedef struct bench_scene {
    lrcs_scene scene;
    lrcs_material material[2];
    lrcs_part part;
    uint32_t room; /* facets and vertices */
} bench_scene;

/* A box bus, two thin panels along x, and two spheres above and below, apart from one another.
   108 n^2 - 24 n facets: n = 5, 19, 64 and 192 are the sizes of the published comparison (2.7 k,
   39 k, 440 k and 4 M). */
void bench_satellite(bench_scene *s, uint32_t n);

/* A space station: modules that intersect, on a truss that runs through them, with panels that
   begin inside the truss. 228 n^2 - 24 n facets; twice as many where `doubled`, every facet then
   stored once more with the opposite winding, after all others. */
void bench_station(bench_scene *s, uint32_t n, int doubled);

/* The satellite, one corner of one facet moved 1e22 m away. */
void bench_far(bench_scene *s, uint32_t n);

/* A body that is convex exactly, whatever is rounded: z = i^2 + j^2 over a grid of whole numbers,
   its mirror image, and the flat walls between them. 16 n^2 + 16 n - 8 facets; n up to 1000. */
void bench_cushion(bench_scene *s, uint32_t n);

/* A stack of sheets of 2 n^2 facets, one above the other along z. */
void bench_layers(bench_scene *s, uint32_t layers, uint32_t n);

/* Large triangles that all overlap as seen from anywhere near +z: each at a height of its own, or
   all of them intersecting. */
enum bench_shards_kind { BENCH_STACKED, BENCH_PIERCING };
void bench_shards(bench_scene *s, uint32_t count, int kind);

/* A plate under needles that miss the axis by ever less: as many cross within any distance of it,
   whatever the scale, so that halving a part of the plate about the axis relieves it of few. */
void bench_star(bench_scene *s, uint32_t needles);

/* n level strips over n others across them: 4 n facets, of which n^2 pieces are seen from +z. */
void bench_hatch(bench_scene *s, uint32_t n);

/* n pages about one spine along z: 2 n facets. */
void bench_book(bench_scene *s, uint32_t n);

/* A wall along z in n folds: 2 n facets. */
void bench_zigzag(bench_scene *s, uint32_t n);

void bench_scene_free(bench_scene *s);

#endif
