/* SPDX-License-Identifier: MIT */
/* Scenes of small integer coordinates seen along a vector of small integers. Questions about them
   are decided here in 64-bit integers: exactly, and independently of the library. */
#ifndef TEST_INTEGER_VIEW_H
#define TEST_INTEGER_VIEW_H

#include "scenes.h"
#include "visibility/uniform/classify.h"

static test_scene scene;
static lrcs_work work;
static lrcsi_view view;
static lrcsi_classification classification;
static lrcsi_grid facets; /* of all facets that can hide others */
static int64_t laser[3];  /* the direction to it */

/* An integer, low <= i <= high. */
static inline int64_t integer_between(uint64_t *state, int low, int high)
{
    return low + (int64_t)random_below(state, (uint32_t)(high - low + 1));
}

/* 1, 0 or -1. */
static inline int sign_of(int64_t x)
{
    return (x > 0) - (x < 0);
}

static inline void vertex_at(uint32_t vertex, int64_t x[3])
{
    for (int k = 0; k < 3; k++) {
        x[k] = (int64_t)scene.vertex[vertex].x[k];
    }
}

/* (b - a) x (c - a) . n */
static inline int64_t determinant(const int64_t a[3], const int64_t b[3], const int64_t c[3],
                                  const int64_t n[3])
{
    const int64_t p[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const int64_t q[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    return (p[1] * q[2] - p[2] * q[1]) * n[0] + (p[2] * q[0] - p[0] * q[2]) * n[1] +
           (p[0] * q[1] - p[1] * q[0]) * n[2];
}

/* Twice the area of the triangle of side k of a facet and a point, in projection, times a positive
   factor: positive if the point is to the left of the side, seen from the laser. */
static inline int64_t left_of_side(uint32_t facet, int k, const int64_t x[3])
{
    int64_t a[3];
    int64_t b[3];
    vertex_at(scene.facet[facet].corner[k], a);
    vertex_at(scene.facet[facet].corner[(k + 1) % 3], b);
    return determinant(a, b, x, laser);
}

/* 1 if the laser sees the front of a facet, -1 if it sees the back, 0 if neither. */
static inline int facing_exactly(uint32_t facet)
{
    int64_t c[3];
    vertex_at(scene.facet[facet].corner[2], c);
    return sign_of(left_of_side(facet, 0, c));
}

/* No facets of these scenes coincide. */
static inline int casts_exactly(uint32_t facet)
{
    int facing = facing_exactly(facet);
    return facing > 0 || (facing < 0 && view.backs.cast);
}

/* How much nearer to the laser than the plane of a facet a point is, times a positive factor that
   is the same for all points. */
static inline int64_t height_above(uint32_t facet, const int64_t x[3])
{
    int64_t at[3][3];
    for (int k = 0; k < 3; k++) {
        vertex_at(scene.facet[facet].corner[k], at[k]);
    }
    const int64_t up[3] = {x[0] - at[0][0], x[1] - at[0][1], x[2] - at[0][2]};
    return facing_exactly(facet) * determinant(at[0], at[1], at[2], up);
}

/* Does a facet cover a point in projection: 1 in its interior, 0 on its border, -1 not. */
static inline int covers_exactly(uint32_t facet, const int64_t x[3])
{
    int least = 1;
    for (int k = 0; k < 3; k++) {
        int side = facing_exactly(facet) * sign_of(left_of_side(facet, k, x));
        least = side < least ? side : least;
    }
    return least;
}

static inline void look_along(int64_t x, int64_t y, int64_t z)
{
    lrcs_pose pose;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    const double d[3] = {(double)x, (double)y, (double)z};
    laser[0] = x;
    laser[1] = y;
    laser[2] = z;
    assert_int_equal(lrcs_pose_from_direction(d, &pose), LRCS_OK);
    assert_int_equal(lrcsi_view_make(prepared, &pose, &work, &view), LRCS_OK);
    assert_int_equal(lrcsi_classify_make(&view, NULL, &work, &classification), LRCS_OK);
    assert_int_equal(lrcsi_grid_facets(&classification.search.grid, &classification.search.boxes,
                                       NULL, &work, &facets),
                     LRCS_OK);
}

/* The direction of a view: never 0. */
static inline void look_along_any(uint64_t *state)
{
    int64_t z = integer_between(state, -3, 3);
    int64_t y = integer_between(state, -3, 3);
    look_along(integer_between(state, z == 0 && y == 0, 3), y, z);
}

/* Facets on random vertices, most of which belong to several facets, and which pierce each other.
   No two have the same vertices, and none is degenerate. */
static inline void scene_tangle(uint64_t *state, uint32_t vertices, uint32_t count)
{
    const int64_t axis[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    scene_start(&scene);
    while (scene.scene.vertex_count < vertices) {
        double x[3];
        int is_new = 1;
        for (int k = 0; k < 3; k++) {
            x[k] = (double)integer_between(state, -6, 6);
        }
        for (uint32_t v = 0; v < scene.scene.vertex_count; v++) {
            is_new &= memcmp(scene.vertex[v].x, x, sizeof x) != 0;
        }
        if (is_new) {
            scene_vertex(&scene, x[0], x[1], x[2]);
        }
    }
    while (scene.scene.facet_count < count) {
        uint32_t corner[3];
        int64_t at[3][3];
        int is_new = 1;
        int has_area = 0;
        for (int k = 0; k < 3; k++) {
            corner[k] = random_below(state, vertices);
            vertex_at(corner[k], at[k]);
        }
        for (int k = 0; k < 3; k++) {
            has_area |= determinant(at[0], at[1], at[2], axis[k]) != 0;
        }
        for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
            int shared = 0;
            for (int k = 0; k < 9; k++) {
                shared += scene.facet[f].corner[k / 3] == corner[k % 3];
            }
            is_new &= shared < 3;
        }
        if (is_new && has_area) {
            scene_facet(&scene, corner[0], corner[1], corner[2]);
        }
    }
}

/* A surface of small facets over a square of n x n, at random heights, and above it separate
   triangles of all sizes, each at a height of its own. */
static inline void scene_terrain(uint64_t *state, uint32_t n, uint32_t triangles)
{
    scene_start(&scene);
    for (uint32_t i = 0; i <= n; i++) {
        for (uint32_t k = 0; k <= n; k++) {
            scene_vertex(&scene, (double)i, (double)k, (double)integer_between(state, 0, 2));
        }
    }
    for (uint32_t v = 0; v < n * (n + 1); v++) {
        if (v % (n + 1) < n) {
            scene_facet(&scene, v, v + n + 1, v + n + 2);
            scene_facet(&scene, v, v + n + 2, v + 1);
        }
    }
    for (uint32_t i = 0; i < triangles; i++) {
        double x[3][3];
        int size = (int)random_below(state, n) + 1;
        int64_t low[2];
        for (int k = 0; k < 2; k++) {
            low[k] = integer_between(state, 0, (int)n - size);
        }
        for (int k = 0; k < 9; k++) {
            x[k / 3][k % 3] =
                k % 3 == 2 ? 3.0 + i : (double)(low[k % 3] + integer_between(state, 0, size));
        }
        scene_triangle(&scene, x[0], x[1], x[2]);
    }
}

/* --- event edges ------------------------------------------------------------------------------ */

/* What the definition says of an edge. */
typedef struct edge_count {
    uint32_t count, left, right, forward;
    uint32_t fronts; /* how many face the laser: one to the left of its side, as it traverses it */
} edge_count;

/* The facets with both vertices: those that can hide something or, of a part, all. */
static inline edge_count count_facets(uint32_t low, uint32_t high, uint32_t part)
{
    edge_count n = {0, 0, 0, 0, 0};
    int64_t a[3];
    int64_t b[3];
    vertex_at(low, a);
    vertex_at(high, b);
    for (uint32_t f = 0; f < scene.scene.facet_count; f++) {
        const uint32_t *corner = scene.facet[f].corner;
        if (part == LRCS_NONE ? !casts_exactly(f) : scene.part_of[f] != part) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            uint32_t from = corner[k];
            uint32_t to = corner[(k + 1) % 3];
            if ((from == low && to == high) || (from == high && to == low)) {
                int64_t apex[3];
                vertex_at(corner[(k + 2) % 3], apex);
                int side = sign_of(determinant(a, b, apex, laser));
                n.count++;
                n.left += side > 0;
                n.right += side < 0;
                n.forward += from == low;
                n.fronts += (from == low ? side : -side) > 0;
            }
        }
    }
    return n;
}

static inline int is_event(const edge_count *n, uint32_t part)
{
    int opposite = n->count == 2 && n->left == 1 && n->right == 1;
    return n->count > 0 && !(opposite && (part == LRCS_NONE || n->forward == 1));
}

/* Divides a scene into two parts, of the first so many facets and of the others. */
static inline void scene_divide(uint32_t first, lrcs_part part[2])
{
    part[0] = part[1] = scene.part;
    part[0].facet_count = first;
    part[1].first_facet = first;
    part[1].facet_count = scene.scene.facet_count - first;
    for (uint32_t f = first; f < scene.scene.facet_count; f++) {
        scene.part_of[f] = 1;
    }
    scene.scene.part = part;
    scene.scene.part_count = 2;
}

#endif
