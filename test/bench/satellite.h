/* SPDX-License-Identifier: MIT */
/* The benchmark's satellite, at any fineness: a box bus, two thin panels along x, and two spheres
   on booms of air above and below. Grid n gives 108 n^2 - 24 n facets or so: 5, 19, 64 and 192 are
   the sizes of the published comparison (2.7 k, 39 k, 440 k and 4 M). */
#ifndef BENCH_SATELLITE_H
#define BENCH_SATELLITE_H

#include <lrcs/lrcs.h>

#include <math.h>
#include <stdlib.h>

typedef struct satellite {
    lrcs_scene scene;
    lrcs_material material[2];
    lrcs_part part;
} satellite;

static inline uint32_t satellite_vertex(satellite *s, double x, double y, double z)
{
    s->scene.vertex[s->scene.vertex_count] = (lrcs_point){{x, y, z}};
    return s->scene.vertex_count++;
}

static inline void satellite_facet(satellite *s, uint32_t a, uint32_t b, uint32_t c,
                                   uint32_t material)
{
    s->scene.facet_material[s->scene.facet_count] = material;
    s->scene.facet[s->scene.facet_count++] = (lrcs_facet){{a, b, c}};
}

/* Vertex (i, j, k) of a box's surface lattice, each 0 .. n: made where it is first met. */
static inline uint32_t satellite_lattice(satellite *s, uint32_t *made, uint32_t n,
                                         const uint32_t at[3], const double middle[3],
                                         const double half[3])
{
    uint32_t *slot = 0;
    for (int k = 0; k < 3 && !slot; k++) { /* faces k: low and high, (n + 1)^2 each */
        if (at[k] == 0 || at[k] == n) {
            uint32_t face = 2 * (uint32_t)k + (at[k] == n);
            slot = &made[(size_t)face * (n + 1) * (n + 1) + at[(k + 1) % 3] * (n + 1) +
                         at[(k + 2) % 3]];
        }
    }
    if (*slot == LRCS_NONE) {
        double x[3];
        for (int k = 0; k < 3; k++) {
            x[k] = middle[k] + half[k] * (2.0 * at[k] / n - 1);
        }
        *slot = satellite_vertex(s, x[0], x[1], x[2]);
    }
    return *slot;
}

static inline void satellite_box(satellite *s, uint32_t n, const double middle[3],
                                 const double half[3], uint32_t material)
{
    size_t slots = 6 * (size_t)(n + 1) * (n + 1);
    uint32_t *made = malloc(slots * sizeof *made);
    for (size_t i = 0; i < slots; i++) {
        made[i] = LRCS_NONE;
    }
    for (uint32_t cell = 0; cell < 6 * n * n; cell++) {
        int axis = (int)(cell / (2 * n * n));
        uint32_t high = cell / (n * n) % 2;
        uint32_t i = cell % n;
        uint32_t j = cell / n % n;
        uint32_t corner[4];
        for (uint32_t c = 0; c < 4; c++) {
            uint32_t at[3];
            at[axis] = high ? n : 0;
            at[(axis + 1) % 3] = i + (c == 1 || c == 2);
            at[(axis + 2) % 3] = j + (c >= 2);
            corner[c] = satellite_lattice(s, made, n, at, middle, half);
        }
        uint32_t a = high ? 1 : 3;
        satellite_facet(s, corner[0], corner[a], corner[2], material);
        satellite_facet(s, corner[0], corner[2], corner[4 - a], material);
    }
    free(made);
}

static inline void satellite_sphere(satellite *s, uint32_t n, const double middle[3], double radius,
                                    uint32_t material)
{
    uint32_t around = 6 * n;
    uint32_t belts = 3 * n;
    uint32_t south = satellite_vertex(s, middle[0], middle[1], middle[2] - radius);
    uint32_t first = south + 1;
    for (uint32_t b = 1; b < belts; b++) {
        for (uint32_t k = 0; k < around; k++) {
            double t = 3.14159265358979323846 * b / belts;
            double p = 2 * 3.14159265358979323846 * k / around;
            satellite_vertex(s, middle[0] + radius * sin(t) * cos(p),
                             middle[1] + radius * sin(t) * sin(p), middle[2] - radius * cos(t));
        }
    }
    uint32_t north = satellite_vertex(s, middle[0], middle[1], middle[2] + radius);
    for (uint32_t k = 0; k < around; k++) {
        uint32_t next = (k + 1) % around;
        satellite_facet(s, south, first + next, first + k, material);
        for (uint32_t b = 0; b + 2 < belts; b++) {
            uint32_t low = first + b * around;
            satellite_facet(s, low + k, low + next, low + around + next, material);
            satellite_facet(s, low + k, low + around + next, low + around + k, material);
        }
        satellite_facet(s, north - around + k, north - around + next, north, material);
    }
}

/* Everything is allocated here and freed by satellite_free. */
static inline void satellite_make(satellite *s, uint32_t n)
{
    static const double bus[2][3] = {{0, 0, 0}, {0.6, 0.5, 0.8}};
    static const double panels[2][3] = {{2.0, 0, 0}, {1.2, 0.5, 0.01}};
    static const double other[3] = {-2.0, 0, 0};
    static const double above[3] = {0.2, 0.1, 1.4};
    static const double below[3] = {-0.1, 0.05, -1.5};
    size_t most = 120 * (size_t)n * n + 1000;
    *s = (satellite){.scene = {.material_count = 2, .part_count = 1, .unmatched = LRCS_NONE}};
    s->material[0] = (lrcs_material){.name = "foil", .brdf = {1, 0.25, 0.2, 0.5}, .bound = 1};
    s->material[1] = (lrcs_material){.name = "cells", .brdf = {2, 0.05, 0.1, 1}, .bound = 1};
    s->part = (lrcs_part){.name = "satellite", .kind = -1, .curvature_known = 1};
    s->scene.material = s->material;
    s->scene.part = &s->part;
    s->scene.vertex = malloc(most * sizeof *s->scene.vertex);
    s->scene.facet = malloc(most * sizeof *s->scene.facet);
    s->scene.facet_material = calloc(most, sizeof(uint32_t));
    s->scene.facet_part = calloc(most, sizeof(uint32_t));
    s->scene.facet_smooth = calloc(most, sizeof(uint32_t));
    satellite_box(s, n, bus[0], bus[1], 0);
    satellite_box(s, n, panels[0], panels[1], 1);
    satellite_box(s, n, other, panels[1], 1);
    satellite_sphere(s, n, above, 0.35, 0);
    satellite_sphere(s, n, below, 0.5, 0);
    s->part.facet_count = s->scene.facet_count;
}

static inline void satellite_free(satellite *s)
{
    free(s->scene.vertex);
    free(s->scene.facet);
    free(s->scene.facet_material);
    free(s->scene.facet_part);
    free(s->scene.facet_smooth);
}

#endif
