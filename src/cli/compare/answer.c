/* SPDX-License-Identifier: MIT */
/* The answers that a code with a given mistake would produce for a case: the sum of Eq. 2 over the
   truth's facets, with the mistake applied. */
#include "cli/compare/compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- a scene in which the wrong one of coplanar facets is seen ---- */

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
static void facets_move(const compare_case *one, const lrcs_scene *from, lrcs_scene *scene)
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

/* The records of a case if of coplanar facets the wrong one is seen: backs before fronts, then the
   last before the first. Depths of one plane that differ by rounding make this mistake in some
   pixels. The true records must be there already. 0 or CLI_FAILED with the message printed. */
static int run_wrong_coplanar(const compare_kit *kit, const compare_case *one,
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
    facets_move(one, from, &moved.scene);
    int status = lrcs_host_scene_prepare(&moved, &error);
    status = status == LRCS_OK ? lrcs_host_scene_run(&moved, &one->pose, options, &result, records,
                                                     NULL, NULL, &error)
                               : status;
    lrcs_host_scene_free(&moved);
    free(vertex);
    free(facet);
    return status == LRCS_OK ? 0 : cli_failed(&error);
}

/* ---- the answer ---- */

/* The largest f_r cos of the case. */
static double view_peak(const mistake_view *view)
{
    double peak = 0.0;
    for (uint32_t i = 0; i < view->scene->host.scene.facet_count; i++) {
        mistake_point point = {.peak = 0.0};
        if (cli_mistake_area(cli_compare_mistakes, view, i, 0, &point) > 0.0) {
            peak = fmax(peak, cli_mistake_shade(cli_compare_mistakes, &point));
        }
    }
    return peak;
}

/* The records of a run of its own, for mistakes that change the run. 0 or CLI_FAILED. */
static int records_own(const compare_kit *kit, const compare_case *one,
                       const compare_mistake *mistake, lrcs_facet_record *own)
{
    lrcs_host_error error;
    lrcs_run_options options = lrcs_run_options_default();
    lrcs_result result;
    lrcs_pose pose = one->pose;
    options.method = LRCS_METHOD_EXACT;
    options.without = mistake->without;
    if (mistake->wrong_coplanar) {
        return run_wrong_coplanar(kit, one, &options, own);
    }
    if (mistake->turn && cli_mistake_turn(mistake, one, &pose) != LRCS_OK) {
        pose = one->pose;
    }
    return lrcs_host_scene_run(&kit->scene[one->scene].host, &pose, &options, &result, own, NULL,
                               NULL, &error) == LRCS_OK
               ? 0
               : cli_failed(&error);
}

/* The records of a case with a mistake: the truth's, or those of another run. 0 or CLI_FAILED. */
static int view_make(const compare_kit *kit, compare_case *one, const compare_mistake *mistake,
                     mistake_view *view, lrcs_facet_record **own)
{
    int code = cli_compare_records(kit, one);
    view->scene = &kit->scene[one->scene];
    view->records = one->records;
    if (code == 0 && one->peak == 0.0) {
        one->peak = view_peak(view);
    }
    if (code != 0 || (!mistake->turn && !mistake->without && !mistake->wrong_coplanar)) {
        return code;
    }
    *own = calloc((size_t)view->scene->host.scene.facet_count + 1, sizeof **own);
    if (!*own) {
        return cli_out_of_memory();
    }
    view->records = *own;
    return records_own(kit, one, mistake, *own);
}

/* sigma / 4 pi with the mistake. */
static double view_sum(const mistake_view *view, const compare_mistake *mistake, double peak)
{
    int corners = mistake->corners > 0 ? mistake->corners : 1;
    double sum = 0.0;
    for (uint32_t i = 0; i < view->scene->host.scene.facet_count; i++) {
        for (int corner = 0; corner < corners; corner++) {
            mistake_point point = {.peak = peak};
            double area = cli_mistake_area(mistake, view, i, corner, &point);
            sum += area > 0.0 ? area * cli_mistake_shade(mistake, &point) / corners : 0.0;
        }
    }
    return sum;
}

int cli_compare_answer(const compare_kit *kit, compare_case *one, const compare_mistake *mistake,
                       double *sigma_m2)
{
    mistake_view view;
    lrcs_facet_record *own = NULL;
    int code = view_make(kit, one, mistake, &view, &own);
    if (code == 0) {
        memcpy(view.direction, one->direction, sizeof view.direction);
        *sigma_m2 = 4.0 * CLI_PI * view_sum(&view, mistake, one->peak);
    }
    free(own);
    return code;
}
