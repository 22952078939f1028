/* SPDX-License-Identifier: MIT */
/* Gathers the properties of a scene: counts, areas, defects, whether facets are fine enough for the
   glint. This file decides which properties of the mesh cause a notice. */
#include "cli/info/info.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

double cli_facet_area(const lrcs_scene *scene, uint32_t facet)
{
    const uint32_t *corner = scene->facet[facet].corner;
    const double *a = scene->vertex[corner[0]].x;
    const double *b = scene->vertex[corner[1]].x;
    const double *c = scene->vertex[corner[2]].x;
    double n[3];
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3;
        int j = (k + 2) % 3;
        n[k] = (b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]);
    }
    return 0.5 * hypot(hypot(n[0], n[1]), n[2]);
}

/* Gathers the properties of a scene that was built from what `base` was read from. */
static int info_look(const char *operand, const lrcs_host_scene *base, cli_info *info)
{
    lrcs_host_error error;
    const lrcs_scene *scene = &info->scene.scene;
    size_t need = lrcs_mesh_check_need(scene->vertex_count, scene->facet_count);
    void *bytes = malloc(need);
    lrcs_work work = lrcs_work_make(bytes, need);
    int status = bytes ? lrcs_mesh_check(scene->vertex, scene->vertex_count, scene->facet,
                                         scene->facet_count, &work, &info->report)
                       : LRCS_E_MEMORY;
    free(bytes);
    info->material = calloc((size_t)scene->material_count + 1, sizeof *info->material);
    if (status != LRCS_OK || !info->material) {
        return cli_fail("%s: %s", operand,
                        status == LRCS_OK || status == LRCS_E_MEMORY ? "out of memory"
                                                                     : lrcs_status_text(status));
    }
    for (uint32_t i = 0; i < scene->facet_count; i++) {
        info_material *material = &info->material[scene->facet_material[i]];
        material->facets++;
        cli_sum_add(&material->area, cli_facet_area(scene, i));
    }
    for (uint32_t i = 0; i < base->recipe.part_count; i++) {
        info->parts += base->recipe.part[i].file ? base->model[i].part_count : 1;
    }
    return lrcs_host_glint_check(scene, &info->glint, &info->glint_count, &error) == LRCS_OK
               ? 0
               : cli_failed(&error);
}

int cli_info_read(const cli_args *args, const lrcs_host_options *options, cli_info *info)
{
    lrcs_host_options load = *options;
    load.build.normals = LRCS_NORMALS_SMOOTH;
    int code = cli_scene_read(args, &load, &info->scene);
    return code ? code : info_look(args->operand, &info->scene, info);
}

int cli_info_make(const cli_args *args, const lrcs_host_scene *base,
                  const lrcs_build_options *build, cli_info *info)
{
    lrcs_host_error error;
    lrcs_build_options smooth = *build;
    smooth.normals = LRCS_NORMALS_SMOOTH;
    return lrcs_host_scene_vary(base, &base->recipe, &smooth, &info->scene, &error) == LRCS_OK
               ? info_look(args->operand, base, info)
               : cli_failed(&error);
}

void cli_info_free(cli_info *info)
{
    free(info->material);
    free(info->glint);
    lrcs_host_scene_free(&info->scene);
}

int cli_info_shows(const cli_info *info, uint32_t material)
{
    return info->material[material].facets > 0 || info->scene.scene.material[material].name[0];
}

/* ---- what the mesh itself gives notice of ---- */

const char *cli_info_notice(const cli_info *info, int i, char text[INFO_NOTICE_SIZE])
{
    const lrcs_mesh_report *report = &info->report;
    const lrcs_scene *scene = &info->scene.scene;
    uint32_t poor = 0;
    switch (i) {
    case 0:
        return report->closed || scene->facet_count == 0
                   ? NULL
                   : "the mesh is not closed: its back sides may show, and its volume has no "
                     "meaning";
    case 1:
        return report->closed && report->volume < 0.0
                   ? "the mesh is closed but inverted (negative volume): its fronts face inwards"
                   : NULL;
    case 2:
        for (uint32_t k = 0; k < scene->part_count; k++) {
            const lrcs_part *part = &scene->part[k];
            if (part->kind < 0 && !part->smoothed && part->facet_count > 0) {
                return "a model has no smoothing groups or vertex normals: whether its facets "
                       "stand for curves is not known";
            }
        }
        return NULL;
    default:
        for (uint32_t k = 0; k < info->glint_count; k++) {
            poor += info->glint[k].error > LRCS_HOST_GLINT_COARSE;
        }
        snprintf(text, INFO_NOTICE_SIZE,
                 "glint: %lu of %lu curved parts are too coarse for their material's slope "
                 "(estimated error above 1 %%); lrcs run --normals auto curves them",
                 (unsigned long)poor, (unsigned long)info->glint_count);
        return poor > 0 ? text : NULL;
    }
}
