/* SPDX-License-Identifier: MIT */
/* Adds up the contributions of single facets to sigma, by part, by material and for the brightest
   facets. */
#include <lrcs/shares.h>

#include "host/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constant.h"
#include "base/sum.h"

/* Sums of one row, before sorting. */
typedef struct shares_tally {
    lrcsi_sum sigma, glint, diffuse;
    uint32_t facets;
} shares_tally;

/* Which row a facet belongs to: by its part, or an object of it, and by its material. */
typedef struct shares_index {
    const lrcs_host_scene *base;
    const lrcs_scene *scene;
    uint32_t *first_part;  /* by part of the scene: the row of the part's first object */
    uint32_t *material_of; /* by material of the scene: the row */
    uint32_t parts, materials;
} shares_index;

/* ---- rows ---- */

/* The mesh of a part that has several objects, or NULL. */
static const lrcs_mesh *part_objects(const shares_index *index, uint32_t part)
{
    const lrcs_mesh *mesh = &index->base->model[part];
    return index->base->recipe.part[part].file && mesh->part_count > 1 ? mesh : NULL;
}

static uint32_t part_of_facet(const shares_index *index, uint32_t facet)
{
    uint32_t part = index->scene->facet_part[facet];
    const lrcs_mesh *mesh = part_objects(index, part);
    return index->first_part[part] +
           (mesh ? mesh->facet_part[facet - index->scene->part[part].first_facet] : 0);
}

/* Materials with the same name and the same numbers are treated as one. */
static void materials_number(shares_index *index)
{
    for (uint32_t i = 0; i < index->scene->material_count; i++) {
        const lrcs_material *own = &index->scene->material[i];
        uint32_t k = 0;
        while (k < i &&
               (strcmp(index->scene->material[k].name, own->name) != 0 ||
                memcmp(&index->scene->material[k].brdf, &own->brdf, sizeof own->brdf) != 0)) {
            k++;
        }
        index->material_of[i] = k < i ? index->material_of[k] : index->materials++;
    }
}

/* ---- names ---- */

typedef struct shares_alike {
    char **name;
    uint32_t object; /* from 1, in its model's order */
} shares_alike;

static int alike_compare(const void *a, const void *b)
{
    return strcmp(*((const shares_alike *)a)->name, *((const shares_alike *)b)->name);
}

/* Numbers objects that share a name as "name #3"; they are frequent in 3DS files, whose names have
   at most 10 letters. */
static int parts_number(const shares_index *index, lrcs_host_shares *shares)
{
    shares_alike *list = calloc((size_t)index->parts + 1, sizeof *list);
    int status = list ? 0 : -1;
    for (uint32_t i = 0, part = 0; list && i < index->parts; i++) {
        while (part + 1 < index->scene->part_count && index->first_part[part + 1] <= i) {
            part++;
        }
        list[i] = (shares_alike){&shares->part[i].name, i - index->first_part[part] + 1};
    }
    if (list) {
        qsort(list, index->parts, sizeof *list, alike_compare);
    }
    for (uint32_t i = 0; status == 0 && i < index->parts;) {
        uint32_t end = i + 1;
        while (end < index->parts && strcmp(*list[i].name, *list[end].name) == 0) {
            end++;
        }
        for (uint32_t last = end - i > 1 ? end : i; last-- > i;) {
            size_t room = strlen(*list[last].name) + 14;
            char *text = malloc(room);
            if (!text) {
                status = -1;
                break;
            }
            snprintf(text, room, "%s #%lu", *list[last].name, (unsigned long)list[last].object);
            free(*list[last].name);
            *list[last].name = text;
        }
        i = end;
    }
    free(list);
    return status;
}

/* Names the rows. A part is "part", or "part/object" if a scene of several parts has a model of
   several objects. 0, or -1 without memory. */
static int rows_name(const shares_index *index, lrcs_host_shares *shares)
{
    for (uint32_t i = 0; i < index->scene->part_count; i++) {
        const lrcs_mesh *mesh = part_objects(index, i);
        const char *part = index->scene->part[i].name;
        int both = mesh && index->scene->part_count > 1;
        for (uint32_t k = 0; k < (mesh ? mesh->part_count : 1); k++) {
            const char *name = mesh ? mesh->part[k] : part;
            size_t room = strlen(part) + strlen(name) + 2;
            char *text = malloc(room);
            if (text) {
                snprintf(text, room, "%s%s%s", both ? part : "", both ? "/" : "", name);
            }
            shares->part[index->first_part[i] + k].name = text;
        }
    }
    for (uint32_t i = 0; i < index->scene->material_count; i++) {
        lrcs_host_share *row = &shares->material[index->material_of[i]];
        row->name = row->name ? row->name : strdup(index->scene->material[i].name);
    }
    shares->parts = index->parts;
    shares->materials = index->materials;
    int named = 1;
    for (uint32_t i = 0; i < index->parts; i++) {
        named &= shares->part[i].name != NULL;
    }
    for (uint32_t i = 0; i < index->materials; i++) {
        named &= shares->material[i].name != NULL;
    }
    return named ? parts_number(index, shares) : -1;
}

/* ---- sums ---- */

/* Inserts a facet if it is among the brightest. */
static void brightest_insert(const shares_index *index, uint32_t facet,
                             const lrcs_facet_record *record, lrcs_host_shares *shares)
{
    uint32_t at = shares->facets;
    while (at > 0 && shares->facet[at - 1].sigma_m2 < record->sigma_m2) {
        at--;
    }
    if (at == LRCS_HOST_SHARES_FACETS || !(record->sigma_m2 > 0.0)) {
        return;
    }
    uint32_t last =
        shares->facets < LRCS_HOST_SHARES_FACETS ? shares->facets++ : LRCS_HOST_SHARES_FACETS - 1;
    memmove(&shares->facet[at + 1], &shares->facet[at], (last - at) * sizeof shares->facet[0]);
    shares->facet[at] = (lrcs_host_share_facet){
        .facet = facet,
        .scene_part = index->scene->facet_part[facet],
        .scene_material = index->scene->facet_material[facet],
        .part = shares->part[part_of_facet(index, facet)].name,
        .material = shares->material[index->material_of[index->scene->facet_material[facet]]].name,
        .theta_deg = acos(fmin(fabs(record->cos_theta), 1.0)) * LRCS_DEGREES_PER_RADIAN,
        .visible_area_m2 = record->visible_area_m2,
        .sigma_m2 = record->sigma_m2,
        .glint_m2 = record->sigma_glint_m2};
}

/* Adds every facet to the row of its part and to that of its material. */
static void records_add(const shares_index *index, const lrcs_facet_record *records,
                        shares_tally *tally, lrcs_host_shares *shares)
{
    for (uint32_t i = 0; i < index->scene->facet_count; i++) {
        const lrcs_facet_record *one = &records[i];
        const uint32_t row[2] = {part_of_facet(index, i),
                                 index->parts +
                                     index->material_of[index->scene->facet_material[i]]};
        for (int k = 0; k < 2; k++) {
            lrcsi_sum_add(&tally[row[k]].sigma, one->sigma_m2);
            lrcsi_sum_add(&tally[row[k]].glint, one->sigma_glint_m2);
            lrcsi_sum_add(&tally[row[k]].diffuse, one->sigma_m2 - one->sigma_glint_m2);
            tally[row[k]].facets++;
        }
        brightest_insert(index, i, one, shares);
    }
    for (uint32_t i = 0; i < index->parts + index->materials; i++) {
        lrcs_host_share *row =
            i < index->parts ? &shares->part[i] : &shares->material[i - index->parts];
        row->facets = tally[i].facets;
        row->sigma_m2 = lrcsi_sum_value(&tally[i].sigma);
        row->glint_m2 = lrcsi_sum_value(&tally[i].glint);
        row->diffuse_m2 = lrcsi_sum_value(&tally[i].diffuse);
    }
}

/* ---- order ---- */

/* The brightest first; of equals the one with more facets, then by name. */
static int row_compare(const void *a, const void *b)
{
    const lrcs_host_share *x = a;
    const lrcs_host_share *y = b;
    int order = (x->sigma_m2 < y->sigma_m2) - (x->sigma_m2 > y->sigma_m2);
    order = order ? order : (x->facets < y->facets) - (x->facets > y->facets);
    return order ? order : strcmp(x->name, y->name);
}

/* Sorts, and drops rows without facets, which come last. */
static void rows_sort(lrcs_host_share *row, uint32_t *count)
{
    qsort(row, *count, sizeof *row, row_compare);
    while (*count > 0 && row[*count - 1].facets == 0) {
        free(row[--*count].name);
    }
}

void lrcs_host_shares_free(lrcs_host_shares *shares)
{
    for (uint32_t i = 0; shares->part && i < shares->parts; i++) {
        free(shares->part[i].name);
    }
    for (uint32_t i = 0; shares->material && i < shares->materials; i++) {
        free(shares->material[i].name);
    }
    free(shares->part);
    free(shares->material);
    memset(shares, 0, sizeof *shares);
}

int lrcs_host_shares_make(const lrcs_host_scene *base, const lrcs_scene *scene,
                          const lrcs_facet_record *records, double sigma_m2,
                          lrcs_host_shares *shares, lrcs_host_error *error)
{
    shares_index index = {.base = base, .scene = scene};
    shares_tally *tally = NULL;
    int made = 0;
    *shares = (lrcs_host_shares){.sigma_m2 = sigma_m2};
    index.first_part = calloc((size_t)scene->part_count + 1, sizeof *index.first_part);
    index.material_of = calloc((size_t)scene->material_count + 1, sizeof *index.material_of);
    if (index.first_part && index.material_of) {
        for (uint32_t i = 0; i < scene->part_count; i++) {
            const lrcs_mesh *mesh = part_objects(&index, i);
            index.first_part[i] = index.parts;
            index.parts += mesh ? mesh->part_count : 1;
        }
        materials_number(&index);
        shares->part = calloc((size_t)index.parts + 1, sizeof *shares->part);
        shares->material = calloc((size_t)index.materials + 1, sizeof *shares->material);
        tally = calloc((size_t)index.parts + index.materials + 1, sizeof *tally);
        made = tally && shares->part && shares->material && rows_name(&index, shares) == 0;
    }
    if (made) {
        records_add(&index, records, tally, shares);
        rows_sort(shares->part, &shares->parts);
        rows_sort(shares->material, &shares->materials);
    }
    free(tally);
    free(index.first_part);
    free(index.material_of);
    if (!made) {
        lrcs_host_shares_free(shares);
        return lrcsi_host_out_of_memory(error);
    }
    return LRCS_OK;
}

lrcs_host_share lrcs_host_shares_sum(const lrcs_host_share *row, uint32_t from, uint32_t count)
{
    lrcsi_sum sum[3] = {{0.0, 0.0}};
    lrcs_host_share others = {.name = NULL};
    for (uint32_t i = from; i < count; i++) {
        lrcsi_sum_add(&sum[0], row[i].sigma_m2);
        lrcsi_sum_add(&sum[1], row[i].glint_m2);
        lrcsi_sum_add(&sum[2], row[i].diffuse_m2);
        others.facets += row[i].facets;
    }
    others.sigma_m2 = lrcsi_sum_value(&sum[0]);
    others.glint_m2 = lrcsi_sum_value(&sum[1]);
    others.diffuse_m2 = lrcsi_sum_value(&sum[2]);
    return others;
}
