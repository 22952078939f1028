/* SPDX-License-Identifier: MIT */
/* Facets that reflect from both sides because the user says so: all of them, those of parts that
   are not closed, or those of a named part or material. It decides which facets are selected; a
   material that becomes two-sided on only some of its facets is copied. */
#include "host/scene/sides.h"

#include <stdlib.h>
#include <string.h>

#include "host/run/memory.h"

#define NAMES_LISTED 8u /* the most names that an error lists */

typedef struct sides_job {
    lrcs_host_scene *host;
    const char *what;
    unsigned char *selected; /* of each facet */
    int matched;
} sides_job;

/* One object of a part: its facets, gathered; marks those that are selected. */
static int object_mark(sides_job *job, const char *name, const uint32_t *list, uint32_t count)
{
    const lrcs_scene *scene = &job->host->scene;
    int open = strcmp(job->what, "open") == 0;
    int selected = strcmp(job->what, name) == 0;
    int status = LRCS_OK;
    job->matched |= selected || open;
    if (open && count > 0) { /* is the surface of these facets closed? */
        lrcs_mesh_report report;
        size_t need = lrcs_mesh_check_need(scene->vertex_count, count);
        lrcs_facet *facet = malloc(count * sizeof *facet);
        void *bytes = malloc(need);
        lrcs_work work = lrcs_work_make(bytes, need);
        for (uint32_t i = 0; facet && i < count; i++) {
            facet[i] = scene->facet[list[i]];
        }
        status = facet && bytes ? lrcs_mesh_check(scene->vertex, scene->vertex_count, facet, count,
                                                  &work, &report)
                                : LRCS_E_MEMORY;
        selected = status == LRCS_OK && !report.closed;
        free(bytes);
        free(facet);
    }
    for (uint32_t i = 0; i < count && selected; i++) {
        job->selected[list[i]] = 1;
    }
    return status;
}

/* The objects of a part, one by one: its facets in the order of their objects. */
static int part_mark(sides_job *job, uint32_t index)
{
    const lrcs_part *part = &job->host->scene.part[index];
    const lrcs_mesh *model = part->kind < 0 ? &job->host->model[index] : NULL;
    uint32_t objects = model && model->part_count > 0 ? model->part_count : 1;
    uint32_t *list = calloc((size_t)part->facet_count + 1, sizeof *list);
    uint32_t *end = calloc((size_t)objects + 1, sizeof *end);
    int status = list && end ? LRCS_OK : LRCS_E_MEMORY;
    for (uint32_t i = 0; status == LRCS_OK && i < part->facet_count; i++) {
        end[(model ? model->facet_part[i] : 0) + 1]++;
    }
    for (uint32_t k = 1; status == LRCS_OK && k <= objects; k++) {
        end[k] += end[k - 1];
    }
    for (uint32_t i = 0; status == LRCS_OK && i < part->facet_count; i++) {
        list[end[model ? model->facet_part[i] : 0]++] = part->first_facet + i;
    }
    /* now end[k] is where the list of object k ends */
    for (uint32_t k = 0; status == LRCS_OK && k < objects; k++) {
        uint32_t first = k > 0 ? end[k - 1] : 0;
        const char *name = model && model->part_count > 0 ? model->part[k] : part->name;
        status = object_mark(job, name, list + first, end[k] - first);
    }
    if (status == LRCS_OK && strcmp(job->what, part->name) == 0) {
        memset(job->selected + part->first_facet, 1, part->facet_count);
        job->matched = 1;
    }
    free(list);
    free(end);
    return status;
}

/* Assigns to the selected facets a two-sided copy of their material. */
static int materials_split(const sides_job *job)
{
    lrcs_scene *scene = &job->host->scene;
    uint32_t count = scene->material_count;
    uint32_t used = count;
    lrcs_material *all = lrcsi_host_take(job->host, 2 * (size_t)count + 1, sizeof *all);
    uint32_t *copy = calloc((size_t)count + 1, sizeof *copy);
    if (!all || !copy) {
        free(copy);
        return LRCS_E_MEMORY;
    }
    memcpy(all, scene->material, count * sizeof *all);
    for (uint32_t i = 0; i < scene->facet_count; i++) {
        uint32_t material = scene->facet_material[i];
        if (!job->selected[i] || all[material].two_sided) {
            continue;
        }
        if (copy[material] == 0) {
            copy[material] = used;
            all[used] = all[material];
            all[used++].two_sided = 1;
        }
        scene->facet_material[i] = copy[material];
    }
    scene->material = all;
    scene->material_count = used;
    free(copy);
    return LRCS_OK;
}

/* Reports that nothing has that name: what has a similar one, or else what there is. */
static int refuse_what(lrcs_host_scene *host, const char *what, lrcs_host_error *error)
{
    const lrcs_scene *scene = &host->scene;
    uint32_t most = scene->part_count + scene->material_count;
    const char **name = lrcsi_host_take(host, (size_t)most + 1, sizeof *name);
    const char *near[NAMES_LISTED];
    char list[NAMES_LISTED * 70] = "";
    uint32_t count = 0;
    for (uint32_t i = 0; name && i < scene->part_count; i++) {
        name[count++] = scene->part[i].name;
    }
    for (uint32_t i = 0; name && i < scene->material_count; i++) {
        name[count++] = scene->material[i].name;
    }
    uint32_t found = name ? lrcs_host_names_near(what, name, count, near, NAMES_LISTED) : 0;
    int is_near = found > 0 && lrcs_host_name_is_near(what, near[0]);
    for (uint32_t i = 0; i < (is_near ? 1 : found); i++) {
        lrcs_host_append(list, sizeof list, "%s'%.60s'", i > 0 ? ", " : "", near[i]);
    }
    return lrcsi_host_fail(
        error, LRCS_E_NAME,
        "two-sided: expected all, open, or a part or material of the scene, found '%.200s'%s%s",
        what,
        is_near                ? "; the nearest is "
        : found == 0           ? ""
        : found < NAMES_LISTED ? "; it has "
                               : "; it has, among others, ",
        list);
}

int lrcsi_host_sides(lrcs_host_scene *host, const char *what, lrcs_host_error *error)
{
    lrcs_scene *scene = &host->scene;
    sides_job job = {.host = host, .what = what};
    if (strcmp(what, "all") == 0) {
        for (uint32_t i = 0; i < scene->material_count; i++) {
            scene->material[i].two_sided = 1;
        }
        return LRCS_OK;
    }
    for (uint32_t i = 0; i < scene->material_count; i++) {
        if (scene->material[i].name[0] && strcmp(scene->material[i].name, what) == 0) {
            scene->material[i].two_sided = 1;
            job.matched = 1;
        }
    }
    job.selected = calloc((size_t)scene->facet_count + 1, 1);
    int status = job.selected ? LRCS_OK : LRCS_E_MEMORY;
    for (uint32_t i = 0; i < scene->part_count && status == LRCS_OK; i++) {
        status = part_mark(&job, i);
    }
    status = status == LRCS_OK ? materials_split(&job) : status;
    free(job.selected);
    if (status == LRCS_E_MEMORY) {
        return lrcsi_host_fail_memory(error, scene->facet_count * sizeof(lrcs_facet));
    }
    if (status != LRCS_OK) {
        return lrcsi_host_fail(error, status, "two-sided: %s", lrcs_status_text(status));
    }
    return job.matched ? LRCS_OK : refuse_what(host, what, error);
}
