/* SPDX-License-Identifier: MIT */
/* What a scene holds: counts, areas, defects, whether facets are fine enough for the glint, and the
   surfaces that facets of models lie on. This file decides which properties of the mesh cause a
   notice. */
#include <lrcs/inventory.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/sum.h"
#include "host/fail.h"

double lrcs_host_facet_area(const lrcs_scene *scene, uint32_t facet)
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

int lrcs_host_inventory_make(const lrcs_host_scene *base, const lrcs_scene *scene,
                             lrcs_host_inventory *inventory, lrcs_host_error *error)
{
    memset(inventory, 0, sizeof *inventory);
    size_t need = lrcs_mesh_check_need(scene->vertex_count, scene->facet_count);
    void *bytes = malloc(need);
    lrcs_work work = lrcs_work_make(bytes, need);
    int status = bytes ? lrcs_mesh_check(scene->vertex, scene->vertex_count, scene->facet,
                                         scene->facet_count, &work, &inventory->report)
                       : LRCS_E_SYSTEM;
    free(bytes);
    lrcsi_sum *area = calloc((size_t)scene->material_count + 1, sizeof *area);
    inventory->material = calloc((size_t)scene->material_count + 1, sizeof *inventory->material);
    status = status == LRCS_OK && !(area && inventory->material) ? LRCS_E_SYSTEM : status;
    if (status != LRCS_OK) {
        free(area);
        return lrcsi_host_fail(error, status, "%s",
                               status == LRCS_E_SYSTEM ? "out of memory"
                                                       : lrcs_status_text(status));
    }
    for (uint32_t i = 0; i < scene->facet_count; i++) {
        uint32_t material = scene->facet_material[i];
        inventory->material[material].facets++;
        lrcsi_sum_add(&area[material], lrcs_host_facet_area(scene, i));
    }
    for (uint32_t i = 0; i < scene->material_count; i++) {
        inventory->material[i].area_m2 = lrcsi_sum_value(&area[i]);
    }
    free(area);
    for (uint32_t i = 0; i < base->recipe.part_count; i++) {
        inventory->parts += base->recipe.part[i].file ? base->model[i].part_count : 1;
    }
    return lrcs_host_glint_check(scene, &inventory->glint, &inventory->glint_count, error);
}

void lrcs_host_inventory_free(lrcs_host_inventory *inventory)
{
    free(inventory->material);
    free(inventory->glint);
    memset(inventory, 0, sizeof *inventory);
}

/* ---- what the mesh itself gives notice of ---- */

const char *lrcs_host_inventory_notice(const lrcs_host_inventory *inventory,
                                       const lrcs_scene *scene, int i,
                                       char text[LRCS_HOST_INVENTORY_NOTICE])
{
    const lrcs_mesh_report *report = &inventory->report;
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
        for (uint32_t k = 0; k < inventory->glint_count; k++) {
            poor += inventory->glint[k].error > LRCS_HOST_GLINT_COARSE;
        }
        snprintf(text, LRCS_HOST_INVENTORY_NOTICE,
                 "glint: %lu of %lu curved parts are too coarse for their material's slope "
                 "(estimated error above 1 %%); lrcs run --normals auto curves them",
                 (unsigned long)poor, (unsigned long)inventory->glint_count);
        return poor > 0 ? text : NULL;
    }
}

/* ---- surfaces ---- */

int lrcs_host_surfaces_find(const lrcs_scene *scene, lrcs_host_surfaces *surfaces,
                            lrcs_host_error *error)
{
    size_t need = lrcs_quadric_need(scene);
    lrcs_quadric_region *list = NULL;
    void *bytes = malloc(need);
    lrcs_work work = lrcs_work_make(bytes, need);
    lrcsi_sum area[LRCS_HOST_SURFACE_KINDS] = {{0.0, 0.0}};
    memset(surfaces, 0, sizeof *surfaces);
    int status =
        bytes ? lrcs_quadric_find(scene, &work, &list, &surfaces->count, NULL) : LRCS_E_SYSTEM;
    surfaces->region =
        status == LRCS_OK ? malloc((surfaces->count + (size_t)1) * sizeof *surfaces->region) : NULL;
    if (surfaces->region) {
        memcpy(surfaces->region, list, surfaces->count * sizeof *surfaces->region);
    }
    free(bytes);
    if (!surfaces->region) {
        surfaces->count = 0;
        return status == LRCS_OK || status == LRCS_E_SYSTEM
                   ? lrcsi_host_out_of_memory(error)
                   : lrcsi_host_fail(error, status, "%s", lrcs_status_text(status));
    }
    for (uint32_t i = 0; i < surfaces->count; i++) {
        const lrcs_quadric_region *region = &surfaces->region[i];
        lrcs_host_surface_kind *kind = &surfaces->kind[region->surface.kind];
        lrcsi_sum_add(&area[region->surface.kind], region->area);
        kind->regions++;
        kind->facets += region->facet_count;
        kind->displacement = fmax(kind->displacement, region->bound.displacement);
    }
    for (int i = 0; i < LRCS_HOST_SURFACE_KINDS; i++) {
        surfaces->kind[i].area_m2 = lrcsi_sum_value(&area[i]);
    }
    return LRCS_OK;
}

void lrcs_host_surfaces_free(lrcs_host_surfaces *surfaces)
{
    free(surfaces->region);
    memset(surfaces, 0, sizeof *surfaces);
}
