/* SPDX-License-Identifier: MIT */
/* Scenes for tests: facets put together by hand in fixed arrays, bypassing files and recipes, and
   run from a direction; and Eq. 2 for one plate in long double, the reference of most of them. */
#ifndef TEST_SCENES_H
#define TEST_SCENES_H

#include <lrcs/lrcs.h>

#include <string.h>

#include "check.h"
#include "random.h"

#define SCENE_VERTICES  8192u
#define SCENE_FACETS    8192u
#define SCENE_MATERIALS 8u
#define SCENE_PI        3.14159265358979323846264338327950288L

typedef struct test_scene {
    lrcs_point vertex[SCENE_VERTICES];
    lrcs_facet facet[SCENE_FACETS];
    uint32_t material_of[SCENE_FACETS];
    uint32_t part_of[SCENE_FACETS];
    uint32_t smooth_of[SCENE_FACETS];
    lrcs_material material[SCENE_MATERIALS];
    lrcs_part part;
    lrcs_scene scene;
    uint32_t assigned;                      /* the material of facets to come */
    lrcs_facet_record record[SCENE_FACETS]; /* of the last run */
} test_scene;

/* The work area of every run: enough for a raster of 1024 x 1024. */
static unsigned char scene_memory[40u << 20];

/* An empty scene; material 0 is the default one. */
static inline void scene_start(test_scene *s)
{
    s->assigned = 0;
    s->material[0] = (lrcs_material){.name = "", .brdf = {1, 0.25, 0.2, 0.5}, .brdf_given = 1};
    s->part = (lrcs_part){.name = "part", .kind = -1, .bounds.known = 1};
    s->scene = (lrcs_scene){.material_count = 1,
                            .part_count = 1,
                            .vertex = s->vertex,
                            .facet = s->facet,
                            .facet_material = s->material_of,
                            .facet_part = s->part_of,
                            .facet_smooth = s->smooth_of,
                            .material = s->material,
                            .part = &s->part,
                            .unmatched = LRCS_NONE};
}

/* Facets from now on have a new material. Returns it, to be changed. */
static inline lrcs_material *scene_material(test_scene *s, double A, double B, double slope,
                                            double m)
{
    assert_true(s->scene.material_count < SCENE_MATERIALS);
    s->assigned = s->scene.material_count++;
    s->material[s->assigned] = s->material[0];
    s->material[s->assigned].brdf = (lrcs_brdf){A, B, slope, m};
    return &s->material[s->assigned];
}

static inline uint32_t scene_vertex(test_scene *s, double x, double y, double z)
{
    assert_true(s->scene.vertex_count < SCENE_VERTICES);
    s->vertex[s->scene.vertex_count] = (lrcs_point){{x, y, z}};
    return s->scene.vertex_count++;
}

static inline uint32_t scene_facet(test_scene *s, uint32_t a, uint32_t b, uint32_t c)
{
    assert_true(s->scene.facet_count < SCENE_FACETS);
    s->facet[s->scene.facet_count] = (lrcs_facet){{a, b, c}};
    s->material_of[s->scene.facet_count] = s->assigned;
    s->part_of[s->scene.facet_count] = 0;
    s->smooth_of[s->scene.facet_count] = 0;
    s->part.facet_count = s->scene.facet_count + 1;
    return s->scene.facet_count++;
}

/* A triangle on vertices of its own, counter-clockwise from its front. */
static inline uint32_t scene_triangle(test_scene *s, const double a[3], const double b[3],
                                      const double c[3])
{
    uint32_t v = scene_vertex(s, a[0], a[1], a[2]);
    scene_vertex(s, b[0], b[1], b[2]);
    scene_vertex(s, c[0], c[1], c[2]);
    return scene_facet(s, v, v + 1, v + 2);
}

/* The parallelogram corner, corner + u, corner + u + v, corner + v; front along u x v. Two facets:
   the index of the first. */
static inline uint32_t scene_plate(test_scene *s, const double corner[3], const double u[3],
                                   const double v[3])
{
    uint32_t i = scene_vertex(s, corner[0], corner[1], corner[2]);
    scene_vertex(s, corner[0] + u[0], corner[1] + u[1], corner[2] + u[2]);
    scene_vertex(s, corner[0] + u[0] + v[0], corner[1] + u[1] + v[1], corner[2] + u[2] + v[2]);
    scene_vertex(s, corner[0] + v[0], corner[1] + v[1], corner[2] + v[2]);
    scene_facet(s, i, i + 1, i + 2);
    return scene_facet(s, i, i + 2, i + 3) - 1;
}

/* A closed box, outward. Twelve facets, two each for -x +x -y +y -z +z: the index of the first. */
static inline uint32_t scene_box(test_scene *s, const double low[3], const double high[3])
{
    static const uint32_t quad[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    uint32_t v = s->scene.vertex_count;
    uint32_t first = s->scene.facet_count;
    for (int i = 0; i < 8; i++) {
        scene_vertex(s, i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1],
                     i & 4 ? high[2] : low[2]);
    }
    for (int i = 0; i < 6; i++) {
        scene_facet(s, v + quad[i][0], v + quad[i][1], v + quad[i][2]);
        scene_facet(s, v + quad[i][0], v + quad[i][2], v + quad[i][3]);
    }
    return first;
}

/* A closed polyhedron inscribed in a sphere: n meridians, n / 2 belts, outward. */
static inline uint32_t scene_sphere(test_scene *s, const double centre[3], double radius,
                                    uint32_t n)
{
    uint32_t first = s->scene.facet_count;
    uint32_t belts = n / 2;
    uint32_t south = scene_vertex(s, centre[0], centre[1], centre[2] - radius);
    for (uint32_t b = 1; b < belts; b++) {
        double t = (double)SCENE_PI * b / belts;
        for (uint32_t k = 0; k < n; k++) {
            double p = 2 * (double)SCENE_PI * k / n;
            scene_vertex(s, centre[0] + radius * sin(t) * cos(p),
                         centre[1] + radius * sin(t) * sin(p), centre[2] - radius * cos(t));
        }
    }
    uint32_t north = scene_vertex(s, centre[0], centre[1], centre[2] + radius);
    for (uint32_t k = 0; k < n; k++) {
        uint32_t next = (k + 1) % n;
        scene_facet(s, south, south + 1 + next, south + 1 + k);
        for (uint32_t b = 0; b + 2 < belts; b++) {
            uint32_t low = south + 1 + b * n;
            scene_facet(s, low + k, low + next, low + n + next);
            scene_facet(s, low + k, low + n + next, low + n + k);
        }
        scene_facet(s, north - n + k, north - n + next, north);
    }
    return first;
}

/* Turns facets from `first` on inside out. */
static inline void scene_invert(test_scene *s, uint32_t first)
{
    for (uint32_t f = first; f < s->scene.facet_count; f++) {
        uint32_t other = s->facet[f].corner[1];
        s->facet[f].corner[1] = s->facet[f].corner[2];
        s->facet[f].corner[2] = other;
    }
}

/* Facets in another order. */
static inline void scene_shuffle(test_scene *s, uint64_t seed)
{
    for (uint32_t f = s->scene.facet_count; f > 1; f--) {
        uint32_t other = random_below(&seed, f);
        lrcs_facet facet = s->facet[f - 1];
        uint32_t material = s->material_of[f - 1];
        s->facet[f - 1] = s->facet[other];
        s->material_of[f - 1] = s->material_of[other];
        s->facet[other] = facet;
        s->material_of[other] = material;
    }
}

/* vertex = move + factor * vertex. */
static inline void scene_move(test_scene *s, double factor, const double move[3])
{
    for (uint32_t v = 0; v < s->scene.vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            s->vertex[v].x[k] = move[k] + factor * s->vertex[v].x[k];
        }
    }
}

/* Turns scene and direction by the quaternion w, x, y, z of small integers and scales the scene by
   w^2 + x^2 + y^2 + z^2, which is returned: exact where coordinates have bits to spare. */
static inline double scene_turn(test_scene *s, const int q[4], double direction[3])
{
    double w = q[0];
    double x = q[1];
    double y = q[2];
    double z = q[3];
    const double m[3][3] = {
        {w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)},
        {2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)},
        {2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z}};
    for (uint32_t v = 0; v <= s->scene.vertex_count; v++) {
        double *to = v < s->scene.vertex_count ? s->vertex[v].x : direction;
        const double from[3] = {to[0], to[1], to[2]};
        for (int k = 0; k < 3; k++) {
            to[k] = m[k][0] * from[0] + m[k][1] * from[1] + m[k][2] * from[2];
        }
    }
    return w * w + x * x + y * y + z * z;
}

/* Prepares the scene at the bottom of the work area. */
static inline const lrcs_prepared *scene_prepare(test_scene *s, lrcs_work *work)
{
    const lrcs_prepared *prepared = NULL;
    *work = lrcs_work_make(scene_memory, sizeof scene_memory);
    assert_int_equal(lrcs_prepare_run(&s->scene, work, &prepared), LRCS_OK);
    return prepared;
}

/* A run on a prepared scene; records go to s->record. */
static inline lrcs_result scene_pose(test_scene *s, const lrcs_prepared *prepared, lrcs_work *work,
                                     const double direction[3], int method, uint32_t size)
{
    lrcs_pose pose;
    lrcs_result result;
    lrcs_run_options options = {.tolerance = 1e-4, .method = method, .resolution = size};
    assert_int_equal(lrcs_pose_from_direction(direction, &pose), LRCS_OK);
    assert_int_equal(lrcs_sigma_run(prepared, &pose, &options, work, &result, s->record, NULL),
                     LRCS_OK);
    return result;
}

/* Prepare and run. */
static inline lrcs_result scene_run(test_scene *s, const double direction[3], int method,
                                    uint32_t size)
{
    lrcs_work work;
    const lrcs_prepared *prepared = scene_prepare(s, &work);
    return scene_pose(s, prepared, &work, direction, method, size);
}

/* Visible projected area of `count` facets from `first` on, as recorded. */
static inline double scene_seen(const test_scene *s, uint32_t first, uint32_t count)
{
    double seen = 0;
    for (uint32_t f = first; f < first + count; f++) {
        seen += s->record[f].visible_area_m2;
    }
    return seen;
}

/* Eq. 2 for a plate: 4 pi S f_r(theta) cos^2(theta), from cos^2. */
static inline long double scene_eq2(const lrcs_brdf *b, long double area, long double cos2)
{
    long double glint =
        b->A > 0 ? b->A * expl(-(1 - cos2) / cos2 / b->s / b->s) / (cos2 * cos2) : 0;
    return 4 * SCENE_PI * area * (glint + b->B * powl(cos2, 0.5L * b->m + 1));
}

/* A result's interval holds the truth, itself known to a few roundings. */
#define check_bound(result, truth)                                                                 \
    check_abs_at((result).sigma_m2, (truth), (result).bound_m2 + 4e-16 * fabs(truth), #result,     \
                 __FILE__, __LINE__)

/* --- scenes of several tests ------------------------------------------------------------------ */

/* Bodies before, behind and through one another; sectors around each of the spheres. */
static inline void scene_bodies(test_scene *s, uint32_t first, uint32_t second)
{
    scene_start(s);
    scene_sphere(s, (const double[3]){0, 0, 0}, 1, first);
    scene_box(s, (const double[3]){-2, -0.5, -0.5}, (const double[3]){2, 0.25, 0.75});
    scene_sphere(s, (const double[3]){0.5, 2.25, 3}, 0.75, second);
}

/* The same, a plate stored twice, and two plates 2^-40 apart that are seen all but edge-on along
   (0, 0, 1). */
static inline void scene_many_bodies(test_scene *s, uint32_t first, uint32_t second)
{
    scene_bodies(s, first, second);
    for (int i = 0; i < 2; i++) {
        scene_plate(s, (const double[3]){-3, 1 + 0.25 * i, -1 + 0.125 * i},
                    (const double[3]){3, 0.125, 0.5}, (const double[3]){0.25, 0.5, 3});
        scene_plate(s, (const double[3]){2.5 + i * 0x1p-40, -1, -4},
                    (const double[3]){0x1p-26, 0, 8}, (const double[3]){0, 1, 0});
        scene_triangle(s, (const double[3]){-3, -3, 2}, (const double[3]){-1, -3, 2},
                       (const double[3]){-3, -1, 2.5});
    }
}

/* Large triangles of all slopes, each through all others. */
static inline void scene_crossing_triangles(test_scene *s, uint64_t seed)
{
    scene_start(s);
    for (int i = 0; i < 12; i++) {
        double corner[3][3];
        for (int k = 0; k < 3; k++) {
            double angle = 2 * (double)SCENE_PI * (k + random_below(&seed, 64) / 192.0) / 3;
            corner[k][0] = 2 * cos(angle);
            corner[k][1] = 2 * sin(angle);
            corner[k][2] = random_below(&seed, 256) / 64.0 - 2;
        }
        scene_triangle(s, corner[0], corner[1], corner[2]);
    }
}

#endif
