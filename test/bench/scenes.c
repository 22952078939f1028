/* SPDX-License-Identifier: MIT */
/* The benchmarks' scenes, facet by facet. Nothing here is measured. */
#include "bench/scenes.h"

#include <math.h>
#include <stdlib.h>

#include "bench/measure.h"
#include "random.h"

#define PI 3.14159265358979323846

static void scene_start(bench_scene *s, size_t room)
{
    *s = (bench_scene){.scene = {.material_count = 2, .part_count = 1, .unmatched = LRCS_NONE}};
    s->material[0] = (lrcs_material){.name = "foil", .brdf = {1, 0.25, 0.2, 0.5}, .brdf_given = 1};
    s->material[1] = (lrcs_material){.name = "cells", .brdf = {2, 0.05, 0.1, 1}, .brdf_given = 1};
    s->part = (lrcs_part){.name = "made", .kind = -1, .bounds.known = 1};
    s->room = (uint32_t)room;
    s->scene.material = s->material;
    s->scene.part = &s->part;
    s->scene.vertex = bench_memory(room * sizeof *s->scene.vertex);
    s->scene.facet = bench_memory(room * sizeof *s->scene.facet);
    s->scene.facet_material = bench_memory(room * sizeof(uint32_t));
    s->scene.facet_part = bench_memory(room * sizeof(uint32_t));
    s->scene.facet_smooth = bench_memory(room * sizeof(uint32_t));
}

void bench_scene_free(bench_scene *s)
{
    free(s->scene.vertex);
    free(s->scene.facet);
    free(s->scene.facet_material);
    free(s->scene.facet_part);
    free(s->scene.facet_smooth);
}

static uint32_t vertex_add(bench_scene *s, double x, double y, double z)
{
    bench_check(s->scene.vertex_count < s->room ? LRCS_OK : LRCS_E_LIMIT, "a scene's vertices");
    s->scene.vertex[s->scene.vertex_count] = (lrcs_point){{x, y, z}};
    return s->scene.vertex_count++;
}

static void facet_add(bench_scene *s, uint32_t a, uint32_t b, uint32_t c, uint32_t material)
{
    uint32_t f = s->scene.facet_count++;
    bench_check(f < s->room ? LRCS_OK : LRCS_E_LIMIT, "a scene's facets");
    s->scene.facet[f] = (lrcs_facet){{a, b, c}};
    s->scene.facet_material[f] = material;
    s->scene.facet_part[f] = 0;
    s->scene.facet_smooth[f] = 0;
    s->part.facet_count = s->scene.facet_count;
}

/* ---- boxes and spheres ---- */

/* A box on a lattice of n cells a side, while it is being made. */
typedef struct bench_box {
    bench_scene *scene;
    uint32_t n, material;
    const double *middle, *half;
    uint32_t *made; /* for each of six faces its (n + 1)^2 lattice points: the vertex, or none */
} bench_box;

/* Lattice point `at` of the surface, made when it is first needed. */
static uint32_t box_vertex(const bench_box *box, const uint32_t at[3])
{
    uint32_t n = box->n;
    int axis = at[0] == 0 || at[0] == n ? 0 : at[1] == 0 || at[1] == n ? 1 : 2;
    uint32_t face = 2 * (uint32_t)axis + (at[axis] == n);
    size_t in_face = (size_t)at[(axis + 1) % 3] * (n + 1) + at[(axis + 2) % 3];
    uint32_t *slot = &box->made[(size_t)face * (n + 1) * (n + 1) + in_face];
    if (*slot == LRCS_NONE) {
        double x[3];
        for (int k = 0; k < 3; k++) {
            x[k] = box->middle[k] + box->half[k] * (2.0 * at[k] / n - 1);
        }
        *slot = vertex_add(box->scene, x[0], x[1], x[2]);
    }
    return *slot;
}

/* The two facets of a lattice cell of a face. */
static void box_cell(const bench_box *box, int axis, uint32_t high, uint32_t i, uint32_t j)
{
    uint32_t corner[4];
    for (uint32_t c = 0; c < 4; c++) {
        uint32_t at[3];
        at[axis] = high ? box->n : 0;
        at[(axis + 1) % 3] = i + (c == 1 || c == 2);
        at[(axis + 2) % 3] = j + (c >= 2);
        corner[c] = box_vertex(box, at);
    }
    uint32_t a = high ? 1 : 3;
    facet_add(box->scene, corner[0], corner[a], corner[2], box->material);
    facet_add(box->scene, corner[0], corner[2], corner[4 - a], box->material);
}

static void box_add(bench_scene *s, uint32_t n, const double middle[3], const double half[3],
                    uint32_t material)
{
    size_t slots = 6 * (size_t)(n + 1) * (n + 1);
    bench_box box = {s, n, material, middle, half, bench_memory(slots * sizeof *box.made)};
    for (size_t i = 0; i < slots; i++) {
        box.made[i] = LRCS_NONE;
    }
    for (uint32_t cell = 0; cell < 6 * n * n; cell++) {
        box_cell(&box, (int)(cell / (2 * n * n)), cell / (n * n) % 2, cell % n, cell / n % n);
    }
    free(box.made);
}

static void sphere_add(bench_scene *s, uint32_t n, const double middle[3], double radius)
{
    uint32_t around = 6 * n;
    uint32_t belts = 3 * n;
    uint32_t south = vertex_add(s, middle[0], middle[1], middle[2] - radius);
    uint32_t first = south + 1;
    for (uint32_t b = 1; b < belts; b++) {
        for (uint32_t k = 0; k < around; k++) {
            double t = PI * b / belts;
            double p = 2 * PI * k / around;
            vertex_add(s, middle[0] + radius * sin(t) * cos(p),
                       middle[1] + radius * sin(t) * sin(p), middle[2] - radius * cos(t));
        }
    }
    uint32_t north = vertex_add(s, middle[0], middle[1], middle[2] + radius);
    for (uint32_t k = 0; k < around; k++) {
        uint32_t next = (k + 1) % around;
        facet_add(s, south, first + next, first + k, 0);
        for (uint32_t b = 0; b + 2 < belts; b++) {
            uint32_t low = first + b * around;
            facet_add(s, low + k, low + next, low + around + next, 0);
            facet_add(s, low + k, low + around + next, low + around + k, 0);
        }
        facet_add(s, north - around + k, north - around + next, north, 0);
    }
}

void bench_satellite(bench_scene *s, uint32_t n)
{
    static const double bus[2][3] = {{0, 0, 0}, {0.6, 0.5, 0.8}};
    static const double panels[2][3] = {{2.0, 0, 0}, {1.2, 0.5, 0.01}};
    static const double other[3] = {-2.0, 0, 0};
    static const double above[3] = {0.2, 0.1, 1.4};
    static const double below[3] = {-0.1, 0.05, -1.5};
    scene_start(s, 108 * (size_t)n * n);
    box_add(s, n, bus[0], bus[1], 0);
    box_add(s, n, panels[0], panels[1], 1);
    box_add(s, n, other, panels[1], 1);
    sphere_add(s, n, above, 0.35);
    sphere_add(s, n, below, 0.5);
}

void bench_far(bench_scene *s, uint32_t n)
{
    bench_satellite(s, n);
    s->scene.facet[0].corner[0] = vertex_add(s, 1e22, 0, 0);
}

void bench_station(bench_scene *s, uint32_t n, int doubled)
{
    static const double module[4][2][3] = {{{0, 0, 0}, {2.1, 0.7, 0.7}},
                                           {{-3.2, 0.05, 0}, {1.5, 0.6, 0.6}},
                                           {{0.4, 2.3, -0.1}, {0.65, 2.0, 0.65}},
                                           {{0.3, -2.2, 0.1}, {0.6, 1.9, 0.6}}};
    static const double truss[2][3] = {{0.1, 0.2, 0.9}, {0.25, 9.0, 0.25}};
    static const double node[2][3] = {{2.4, 0, 0}, {-4.9, 0.05, 0}};
    scene_start(s, (doubled ? 456 : 228) * (size_t)n * n);
    for (int k = 0; k < 4; k++) {
        box_add(s, n, module[k][0], module[k][1], 0);
    }
    box_add(s, n, truss[0], truss[1], 0);
    for (int k = 0; k < 8; k++) {
        const double panel[2][3] = {{0.1 + (k % 2 ? 3.2 : -3.2), 3.7 + 1.6 * (k / 4), 0.9},
                                    {3.1, 0.55, 0.012}};
        double y = k / 2 % 2 ? panel[0][1] : -panel[0][1];
        box_add(s, n, (const double[]){panel[0][0], y, panel[0][2]}, panel[1], 1);
    }
    for (int k = 0; k < 2; k++) {
        sphere_add(s, n, node[k], 0.8);
    }
    uint32_t facets = doubled ? s->scene.facet_count : 0;
    for (uint32_t f = 0; f < facets; f++) {
        const uint32_t *corner = s->scene.facet[f].corner;
        facet_add(s, corner[0], corner[2], corner[1], s->scene.facet_material[f]);
    }
}

/* ---- the cushion ---- */

/* The vertex above (i, j) on the lower sheet, or on the upper one, which share their corners. */
static uint32_t cushion_vertex(uint32_t n, uint32_t i, uint32_t j, int upper)
{
    uint32_t row = 2 * n + 1;
    int corner = (i == 0 || i == 2 * n) && (j == 0 || j == 2 * n);
    return (upper && !corner ? row * row : 0) + j * row + i;
}

/* Two facets of a quadrangle a b c d, or one where b and c, or d and a, are one. */
static void cushion_quad(bench_scene *s, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    if (b != c) {
        facet_add(s, a, b, c, 0);
    }
    if (d != a) {
        facet_add(s, a, c, d, 0);
    }
}

/* From a to b along a wall, seen from outside, counter-clockwise. */
static void cushion_wall(bench_scene *s, uint32_t n, const uint32_t a[2], const uint32_t b[2])
{
    cushion_quad(s, cushion_vertex(n, a[0], a[1], 0), cushion_vertex(n, b[0], b[1], 0),
                 cushion_vertex(n, b[0], b[1], 1), cushion_vertex(n, a[0], a[1], 1));
}

static void cushion_walls(bench_scene *s, uint32_t n)
{
    uint32_t end = 2 * n;
    for (uint32_t i = 0; i < end; i++) {
        cushion_wall(s, n, (uint32_t[]){i, 0}, (uint32_t[]){i + 1, 0});
        cushion_wall(s, n, (uint32_t[]){end, i}, (uint32_t[]){end, i + 1});
        cushion_wall(s, n, (uint32_t[]){end - i, end}, (uint32_t[]){end - i - 1, end});
        cushion_wall(s, n, (uint32_t[]){0, end - i}, (uint32_t[]){0, end - i - 1});
    }
}

void bench_cushion(bench_scene *s, uint32_t n)
{
    uint32_t row = 2 * n + 1;
    scene_start(s, 16 * (size_t)n * n + 16 * n + 8);
    for (uint32_t v = 0; v < 2 * row * row; v++) {
        double x = (double)(v % row) - n;
        double y = (double)(v / row % row) - n;
        double z = x * x + y * y;
        vertex_add(s, x * n, y * n, v < row * row ? z : 4.0 * n * n - z);
    }
    for (uint32_t cell = 0; cell < 4 * n * n; cell++) {
        uint32_t i = cell % (2 * n);
        uint32_t j = cell / (2 * n);
        cushion_quad(s, cushion_vertex(n, i, j, 0), cushion_vertex(n, i, j + 1, 0),
                     cushion_vertex(n, i + 1, j + 1, 0), cushion_vertex(n, i + 1, j, 0));
        cushion_quad(s, cushion_vertex(n, i, j, 1), cushion_vertex(n, i + 1, j, 1),
                     cushion_vertex(n, i + 1, j + 1, 1), cushion_vertex(n, i, j + 1, 1));
    }
    cushion_walls(s, n);
}

/* ---- sheets and shards ---- */

void bench_layers(bench_scene *s, uint32_t layers, uint32_t n)
{
    uint32_t row = n + 1;
    scene_start(s, 2 * (size_t)layers * row * row);
    for (uint32_t layer = 0; layer < layers; layer++) {
        uint32_t first = s->scene.vertex_count;
        for (uint32_t v = 0; v < row * row; v++) {
            vertex_add(s, (double)(v % row) / n, (double)(v / row) / n, 0.01 * layer);
        }
        for (uint32_t cell = 0; cell < n * n; cell++) {
            uint32_t a = first + cell / n * row + cell % n;
            facet_add(s, a, a + 1, a + row + 1, 0);
            facet_add(s, a, a + row + 1, a + row, 0);
        }
    }
}

/* In -1 .. 1. */
static double random_place(uint64_t *state)
{
    return ldexp((double)(random_mmix(state) >> 12), -51) - 1;
}

void bench_shards(bench_scene *s, uint32_t count, int kind)
{
    uint64_t state = 1;
    scene_start(s, 3 * (size_t)count);
    for (uint32_t f = 0; f < count; f++) {
        double turn = PI * random_place(&state);
        for (int c = 0; c < 3; c++) {
            double angle = turn + 2 * PI * c / 3 + 0.5 * random_place(&state);
            double z = kind == BENCH_STACKED ? (double)f / count : random_place(&state);
            vertex_add(s, cos(angle), sin(angle), z);
        }
        facet_add(s, 3 * f, 3 * f + 1, 3 * f + 2, f % 2);
    }
}

void bench_star(bench_scene *s, uint32_t needles)
{
    uint64_t state = 1;
    scene_start(s, 3 * (size_t)needles + 4);
    for (uint32_t k = 0; k < 4; k++) {
        vertex_add(s, k % 3 ? 2 : -2, k < 2 ? -2 : 2, 0);
    }
    facet_add(s, 0, 1, 2, 0);
    facet_add(s, 0, 2, 3, 0);
    for (uint32_t f = 0; f < needles; f++) {
        double miss = 0.5 * exp2(-24.0 * f / needles);
        double turn = PI * random_place(&state);
        double x = cos(turn);
        double y = sin(turn);
        double z = 0.1 + (double)f / needles;
        double wide = 0.125 * miss;
        uint32_t a = vertex_add(s, x - miss * y, y + miss * x, z);
        uint32_t b = vertex_add(s, -x - miss * y, -y + miss * x, z);
        uint32_t c = vertex_add(s, -x - (miss + wide) * y, -y + (miss + wide) * x, z);
        facet_add(s, a, c, b, 1);
    }
}

/* ---- strips, pages, folds ---- */

static void strip_add(bench_scene *s, double x, double y, double z, double wide, double high)
{
    uint32_t v = vertex_add(s, x, y, z);
    vertex_add(s, x + wide, y, z);
    vertex_add(s, x + wide, y + high, z);
    vertex_add(s, x, y + high, z);
    facet_add(s, v, v + 1, v + 2, 0);
    facet_add(s, v, v + 2, v + 3, 0);
}

void bench_hatch(bench_scene *s, uint32_t n)
{
    scene_start(s, 8 * (size_t)n);
    for (uint32_t i = 0; i < n; i++) {
        strip_add(s, 0, (double)i / n, 0, 1, 0.5 / n);
        strip_add(s, (double)i / n, 0, -1, 0.5 / n, 1);
    }
}

void bench_book(bench_scene *s, uint32_t n)
{
    scene_start(s, 2 * (size_t)n + 2);
    uint32_t spine = vertex_add(s, 0, 0, 0);
    vertex_add(s, 0, 0, 1);
    for (uint32_t i = 0; i < n; i++) {
        double angle = 2 * PI * i / n;
        uint32_t v = vertex_add(s, cos(angle), sin(angle), 1);
        vertex_add(s, cos(angle), sin(angle), 0);
        facet_add(s, spine, spine + 1, v, 0);
        facet_add(s, spine, v, v + 1, 0);
    }
}

void bench_zigzag(bench_scene *s, uint32_t n)
{
    scene_start(s, 2 * (size_t)n + 2);
    for (uint32_t i = 0; i <= n; i++) {
        vertex_add(s, (double)i / n, 0.5 * (i % 2), 0);
        vertex_add(s, (double)i / n, 0.5 * (i % 2), 1);
    }
    for (uint32_t v = 0; v < 2 * n; v += 2) {
        facet_add(s, v, v + 2, v + 3, 0);
        facet_add(s, v, v + 3, v + 1, 0);
    }
}
