/* SPDX-License-Identifier: MIT */
/* A scene in which the wrong one of coplanar facets is seen: backs before fronts, then the last
   before the first. Depths of one plane that differ by rounding make this mistake in some
   pixels. */
#include "cli/compare/compare.h"

#include <stdlib.h>
#include <string.h>

/* Relative to the scene's size: more than rounding, less than any distance in it. */
#define MOVED 0x1p-30

/* Moves a facet's corners towards the laser; they become its own. */
static void facet_move(const lrcs_scene *scene, uint32_t facet, const double direction[3],
                       double by, lrcs_point corner[3])
{
    for (int k = 0; k < 3; k++) {
        corner[k] = scene->vertex[scene->facet[facet].corner[k]];
        for (int i = 0; i < 3; i++) {
            corner[k].x[i] += by * direction[i];
        }
    }
}

static double scene_size(const lrcs_scene *scene)
{
    double size = 0.0;
    for (uint32_t i = 0; i < scene->vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            double x = scene->vertex[i].x[k];
            size = x > size ? x : -x > size ? -x : size;
        }
    }
    return size;
}

/* Moves every facet by a share of the distance: backs by all of it, fronts by up to half, later
   ones by more. */
static void scene_move(const compare_case *one, const lrcs_scene *from, lrcs_scene *scene)
{
    double most = MOVED * scene_size(from);
    for (uint32_t i = 0; i < from->facet_count; i++) {
        int back = one->records[i].cos_theta < 0.0;
        double by = most * (back ? 1.0 : 0.5 * i / from->facet_count);
        facet_move(from, i, one->direction, by, &scene->vertex[(size_t)3 * i]);
        for (uint32_t k = 0; k < 3; k++) {
            scene->facet[i].corner[k] = 3 * i + k;
        }
    }
    scene->vertex_count = 3 * from->facet_count;
}

int cli_compare_skins(const compare_kit *kit, const compare_case *one,
                      const lrcs_run_options *options, lrcs_facet_record *records)
{
    const lrcs_scene *from = &kit->scene[one->scene].host.scene;
    lrcs_host_scene moved;
    lrcs_host_error error;
    lrcs_result result;
    memset(&moved, 0, sizeof moved);
    moved.scene = *from;
    moved.scene.vertex = malloc(((size_t)3 * from->facet_count + 1) * sizeof(lrcs_point));
    moved.scene.facet = malloc(((size_t)from->facet_count + 1) * sizeof(lrcs_facet));
    lrcs_point *vertex = moved.scene.vertex;
    lrcs_facet *facet = moved.scene.facet;
    if (!vertex || !facet) {
        free(vertex);
        free(facet);
        return cli_out_of_memory();
    }
    scene_move(one, from, &moved.scene);
    int status = lrcs_host_scene_prepare(&moved, &error);
    status = status == LRCS_OK ? lrcs_host_scene_run(&moved, &one->pose, options, &result, records,
                                                     NULL, NULL, &error)
                               : status;
    lrcs_host_scene_free(&moved);
    free(vertex);
    free(facet);
    return status == LRCS_OK ? 0 : cli_failed(&error);
}
