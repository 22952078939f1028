/* SPDX-License-Identifier: MIT */
/* A scene of large facets, for tests of boxes and grids. */
#ifndef STACKED_H
#define STACKED_H

#include "scenes.h"

static test_scene scene;
static uint64_t seed;

/* Exact in binary: from 0 to `most`. */
static double random_to(double most)
{
    return most * random_below(&seed, 4096) / 4096;
}

/* Triangles one above the other that all reach over half of the view. */
static void stacked_triangles(uint32_t count)
{
    scene_start(&scene);
    seed = count;
    for (uint32_t i = 0; i < count; i++) {
        double z = 0x1p-8 * i;
        scene_triangle(&scene, (const double[3]){random_to(0.25), random_to(0.25), z},
                       (const double[3]){2 - random_to(0.25), random_to(0.25), z},
                       (const double[3]){random_to(0.25), 2 - random_to(0.25), z});
    }
}

#endif
