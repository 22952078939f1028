/* SPDX-License-Identifier: MIT */
/* One pose of one scene, and how many steps it may take at most by the formulas of
   examples/flight/README.md: questions of visibility, parts of curved facets.
   test/flight/operations.sh counts how many it did take.
   usage: operations KIND COUNT [STEPS]     STEPS: lrcs_run_options.steps
   KIND: boxes (apart), sheets (over each other), random (pierced), book (on one edge), half
   (curved, half hidden) by method exact; patches, razors (curved, of a wide and of an all but
   singular BRDF) by method facet */
#include <stdlib.h>

#include "scene/prepare.h"
#include "scenes.h"

static test_scene scene;
static lrcs_point normal[3 * SCENE_FACETS];
static int method = LRCS_METHOD_EXACT;
static double tolerance = 1e-4;
static uint64_t steps;

static void make_boxes(uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        double at = 1.5 * i;
        scene_box(&scene, (const double[3]){at, 0.3 * at, 0.2 * at},
                  (const double[3]){at + 1, 0.3 * at + 1, 0.2 * at + 1});
    }
}

static void make_sheets(uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        double z = 0x1p-6 * i;
        scene_plate(&scene, (const double[3]){z, 0.5 * z, z}, (const double[3]){1, 0, 0},
                    (const double[3]){0, 1, 0});
    }
}

static void make_random(uint32_t count)
{
    uint64_t seed = 8;
    for (uint32_t i = 0; i < count; i++) {
        double corner[3][3];
        for (int k = 0; k < 9; k++) {
            corner[k / 3][k % 3] = random_below(&seed, 4096) / 4096.0;
        }
        scene_triangle(&scene, corner[0], corner[1], corner[2]);
    }
}

/* Leaves, all on one edge. */
static void make_book(uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        double angle = 3.14159265358979 * (i + 0.5) / count;
        scene_triangle(&scene, (const double[3]){0, 0, 0}, (const double[3]){1, 0, 0},
                       (const double[3]){0.5, cos(angle), sin(angle)});
    }
}

/* Normals at corners as on a sphere about a point below each facet. */
static void curve_facets(void)
{
    for (uint32_t i = 0; i < 3 * scene.scene.facet_count; i++) {
        const uint32_t *corner = scene.facet[i / 3].corner;
        double n[3] = {0, 0, 0.3};
        for (int k = 0; k < 3; k++) {
            n[k] += scene.vertex[corner[i % 3]].x[k];
            for (int j = 0; j < 3; j++) {
                n[k] -= scene.vertex[corner[j]].x[k] / 3;
            }
        }
        for (int k = 0; k < 3; k++) {
            normal[i].x[k] = n[k] / sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        }
    }
    scene.scene.corner_normal = normal;
}

static void make_scene(const char *kind, uint32_t count)
{
    scene_start(&scene);
    if (strcmp(kind, "boxes") == 0) {
        make_boxes(count);
    } else if (strcmp(kind, "random") == 0) {
        make_random(count);
    } else if (strcmp(kind, "book") == 0) {
        make_book(count);
    } else {
        make_sheets(count);
    }
    if (strcmp(kind, "half") == 0 || strcmp(kind, "patches") == 0) {
        curve_facets();
    }
    if (strcmp(kind, "razors") == 0) { /* what the cubature can do least about */
        curve_facets();
        scene.material[0].brdf = (lrcs_brdf){1, 0.25, 1e-8, 1e13};
        tolerance = 1e-8;
    }
    if (strcmp(kind, "patches") == 0 || strcmp(kind, "razors") == 0) {
        method = LRCS_METHOD_FACET;
    }
}

/* Cuts of one facet: edges, and three for each contact. */
static double most_cuts(const lrcs_prepared *p, uint32_t facet)
{
    return p->topology.edge_count + 3.0 * lrcsi_intersection_of(&p->intersections, facet);
}

/* What is left when steps have been spent. */
static double most_passes(const lrcs_prepared *p)
{
    double k = p->intersections.first[p->scene->facet_count];
    return 1100.0 * p->scene->facet_count + 32 * k + 160000;
}

static double most_questions(const lrcs_prepared *p)
{
    double n = p->scene->facet_count;
    double k = p->intersections.first[p->scene->facet_count];
    if (steps != 0) {
        return 4.0 * (double)steps + most_passes(p);
    }
    double most = 48 * n * n * n + 224 * n * n + 32 * n * k + 1100 * n + 160000;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        double own = lrcsi_intersection_of(&p->intersections, f);
        double cuts = most_cuts(p, f);
        most += n * (cuts + own) + (8193 + 512 * cuts) * (2 * cuts + n + 7 * n * (2 + cuts));
    }
    if (n >= 192) { /* cells of all facets together */
        double lines = p->topology.edge_count + k;
        most += 32 * (2 * n + 64) * (1 + lines + lines * lines) * (n + lines);
    }
    return most;
}

static double most_parts(const lrcs_prepared *p)
{
    double most = 0;
    if (steps != 0) {
        return p->has_curved_normals ? 2 * ((double)steps / 256) + 8.0 * p->scene->facet_count + 300
                                     : 0;
    }
    for (uint32_t f = 0; f < p->scene->facet_count && p->has_curved_normals; f++) {
        double triangles = method == LRCS_METHOD_FACET ? 1 : 30 * (8193 + 512 * most_cuts(p, f));
        most += 5 * 32768 + 37 + 6 * triangles;
    }
    return most;
}

static void run(const lrcs_prepared *prepared, lrcs_work *work, const lrcs_pose *pose)
{
    lrcs_result result;
    lrcs_run_options options = lrcs_run_options_default();
    options.method = method;
    options.tolerance = tolerance;
    options.steps = steps;
    assert_int_equal(lrcs_sigma_run(prepared, pose, &options, work, &result, NULL, NULL), LRCS_OK);
}

static void one_pose(void **state)
{
    (void)state;
    lrcs_work work;
    lrcs_pose pose;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    assert_int_equal(lrcs_pose_from_direction((const double[3]){0.25, -0.5, 1}, &pose), LRCS_OK);
    run(prepared, &work, &pose);
    printf("%u %u %.0f %.0f\n", (unsigned)scene.scene.facet_count,
           (unsigned)prepared->intersections.first[scene.scene.facet_count],
           method == LRCS_METHOD_EXACT ? most_questions(prepared) : 0, most_parts(prepared));
}

int main(int words, char **word)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(one_pose)};
    steps = words > 3 ? strtoull(word[3], NULL, 10) : 0;
    make_scene(words > 1 ? word[1] : "boxes", words > 2 ? (uint32_t)strtoul(word[2], NULL, 10) : 4);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
