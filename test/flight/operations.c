/* SPDX-License-Identifier: MIT */
/* One pose of one scene by method exact, and how many questions it may ask at most: the formula of
   examples/flight/README.md. test/flight/operations.sh counts how many it did.
   usage: operations KIND COUNT    KIND boxes (apart), sheets (over each other), random (pierced) */
#include <stdlib.h>

#include "scene/prepare.h"
#include "scenes.h"

static test_scene scene;

static void make_scene(const char *kind, uint32_t count)
{
    uint64_t seed = 8;
    scene_start(&scene);
    for (uint32_t i = 0; i < count; i++) {
        if (strcmp(kind, "boxes") == 0) {
            double at = 1.5 * i;
            scene_box(&scene, (const double[3]){at, 0.3 * at, 0.2 * at},
                      (const double[3]){at + 1, 0.3 * at + 1, 0.2 * at + 1});
        } else if (strcmp(kind, "sheets") == 0) {
            double z = 0x1p-6 * i;
            scene_plate(&scene, (const double[3]){z, 0.5 * z, z}, (const double[3]){1, 0, 0},
                        (const double[3]){0, 1, 0});
        } else {
            double corner[3][3];
            for (int k = 0; k < 9; k++) {
                corner[k / 3][k % 3] = scene_random(&seed, 4096) / 4096.0;
            }
            scene_triangle(&scene, corner[0], corner[1], corner[2]);
        }
    }
}

static double most_questions(const lrcs_prepared *p)
{
    double n = p->scene->facet_count;
    double k = p->touches.first[p->scene->facet_count];
    double most = 48 * n * n * n + 208 * n * n + 32 * n * k + 1100 * n + 160000;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        double own = p->touches.first[f + 1] - p->touches.first[f];
        double cuts = p->topology.edge_count + 3 * own;
        most += n * (cuts + own) + (8193 + 512 * cuts) * (4 * cuts + 2 * n * (1 + cuts));
    }
    return most;
}

static void one_pose(void **state)
{
    (void)state;
    lrcs_work work;
    const lrcs_prepared *prepared = scene_prepare(&scene, &work);
    scene_pose(&scene, prepared, &work, (const double[3]){0.25, -0.5, 1}, LRCS_METHOD_EXACT, 0);
    printf("%u %u %.0f\n", (unsigned)scene.scene.facet_count,
           (unsigned)prepared->touches.first[scene.scene.facet_count], most_questions(prepared));
}

int main(int words, char **word)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(one_pose)};
    make_scene(words > 1 ? word[1] : "boxes", words > 2 ? (uint32_t)strtoul(word[2], NULL, 10) : 4);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
