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

/* Maps facets to rows. */
typedef struct shares_plan {
    const lrcs_host_scene *base;
    const lrcs_scene *scene;
    uint32_t *first_part;  /* by part of the scene: the row of the part's first object */
    uint32_t *material_of; /* by material of the scene: the row */
    uint32_t parts, materials;
} shares_plan;

/* ---- rows ---- */

/* The mesh of a part that has several objects, or NULL. */
static const lrcs_mesh *part_objects(const shares_plan *plan, uint32_t part)
{
    const lrcs_mesh *mesh = &plan->base->model[part];
    return plan->base->recipe.part[part].file && mesh->part_count > 1 ? mesh : NULL;
}

static uint32_t part_of_facet(const shares_plan *plan, uint32_t facet)
{
    uint32_t part = plan->scene->facet_part[facet];
    const lrcs_mesh *mesh = part_objects(plan, part);
    return plan->first_part[part] +
           (mesh ? mesh->facet_part[facet - plan->scene->part[part].first_facet] : 0);
}

/* Materials with the same name and the same numbers are treated as one. */
static void materials_number(shares_plan *plan)
{
    for (uint32_t i = 0; i < plan->scene->material_count; i++) {
        const lrcs_material *own = &plan->scene->material[i];
        uint32_t k = 0;
        while (k < i &&
               (strcmp(plan->scene->material[k].name, own->name) != 0 ||
                memcmp(&plan->scene->material[k].brdf, &own->brdf, sizeof own->brdf) != 0)) {
            k++;
        }
        plan->material_of[i] = k < i ? plan->material_of[k] : plan->materials++;
    }
}

/* ---- names ---- */

/* "part", or "part/object" if a scene of several parts has a model of several objects. */
static char *part_name(const shares_plan *plan, uint32_t part, uint32_t object)
{
    const lrcs_mesh *mesh = part_objects(plan, part);
    const char *whole = plan->scene->part[part].name;
    const char *name = mesh ? mesh->part[object] : whole;
    int both = mesh && plan->scene->part_count > 1;
    size_t room = strlen(whole) + strlen(name) + 2;
    char *text = malloc(room);
    if (text) {
        snprintf(text, room, "%s%s%s", both ? whole : "", both ? "/" : "", name);
    }
    return text;
}

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
static int parts_number(const shares_plan *plan, lrcs_host_shares *shares)
{
    shares_alike *list = calloc((size_t)plan->parts + 1, sizeof *list);
    int status = list ? 0 : -1;
    for (uint32_t i = 0, part = 0; list && i < plan->parts; i++) {
        while (part + 1 < plan->scene->part_count && plan->first_part[part + 1] <= i) {
            part++;
        }
        list[i] = (shares_alike){&shares->part[i].name, i - plan->first_part[part] + 1};
    }
    if (list) {
        qsort(list, plan->parts, sizeof *list, alike_compare);
    }
    for (uint32_t i = 0; status == 0 && i < plan->parts;) {
        uint32_t end = i + 1;
        while (end < plan->parts && strcmp(*list[i].name, *list[end].name) == 0) {
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

static int rows_name(const shares_plan *plan, lrcs_host_shares *shares)
{
    for (uint32_t i = 0; i < plan->scene->part_count; i++) {
        const lrcs_mesh *mesh = part_objects(plan, i);
        for (uint32_t k = 0; k < (mesh ? mesh->part_count : 1); k++) {
            shares->part[plan->first_part[i] + k].name = part_name(plan, i, k);
        }
    }
    for (uint32_t i = 0; i < plan->scene->material_count; i++) {
        lrcs_host_share *row = &shares->material[plan->material_of[i]];
        row->name = row->name ? row->name : strdup(plan->scene->material[i].name);
    }
    shares->parts = plan->parts;
    shares->materials = plan->materials;
    int named = 1;
    for (uint32_t i = 0; i < plan->parts; i++) {
        named &= shares->part[i].name != NULL;
    }
    for (uint32_t i = 0; i < plan->materials; i++) {
        named &= shares->material[i].name != NULL;
    }
    return named ? parts_number(plan, shares) : -1;
}

/* ---- sums ---- */

static void row_fill(lrcs_host_share *row, const shares_tally *tally)
{
    row->facets = tally->facets;
    row->sigma_m2 = lrcsi_sum_value(&tally->sigma);
    row->glint_m2 = lrcsi_sum_value(&tally->glint);
    row->diffuse_m2 = lrcsi_sum_value(&tally->diffuse);
}

/* Inserts a facet if it is among the brightest. */
static void brightest_insert(const shares_plan *plan, uint32_t facet,
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
        .scene_part = plan->scene->facet_part[facet],
        .scene_material = plan->scene->facet_material[facet],
        .part = shares->part[part_of_facet(plan, facet)].name,
        .material = shares->material[plan->material_of[plan->scene->facet_material[facet]]].name,
        .theta_deg = acos(fmin(fabs(record->cos_theta), 1.0)) * (180.0 / LRCS_PI),
        .visible_area_m2 = record->visible_area_m2,
        .sigma_m2 = record->sigma_m2,
        .glint_m2 = record->sigma_glint_m2};
}

/* Adds every facet to the row of its part and to that of its material. */
static void records_add(const shares_plan *plan, const lrcs_facet_record *records,
                        shares_tally *tally, lrcs_host_shares *shares)
{
    for (uint32_t i = 0; i < plan->scene->facet_count; i++) {
        const lrcs_facet_record *one = &records[i];
        const uint32_t row[2] = {part_of_facet(plan, i),
                                 plan->parts + plan->material_of[plan->scene->facet_material[i]]};
        for (int k = 0; k < 2; k++) {
            lrcsi_sum_add(&tally[row[k]].sigma, one->sigma_m2);
            lrcsi_sum_add(&tally[row[k]].glint, one->sigma_glint_m2);
            lrcsi_sum_add(&tally[row[k]].diffuse, one->sigma_m2 - one->sigma_glint_m2);
            tally[row[k]].facets++;
        }
        brightest_insert(plan, i, one, shares);
    }
    for (uint32_t i = 0; i < plan->parts + plan->materials; i++) {
        row_fill(i < plan->parts ? &shares->part[i] : &shares->material[i - plan->parts],
                 &tally[i]);
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
    shares_plan plan = {.base = base, .scene = scene};
    shares_tally *tally = NULL;
    int made = 0;
    *shares = (lrcs_host_shares){.sigma_m2 = sigma_m2};
    plan.first_part = calloc((size_t)scene->part_count + 1, sizeof *plan.first_part);
    plan.material_of = calloc((size_t)scene->material_count + 1, sizeof *plan.material_of);
    if (plan.first_part && plan.material_of) {
        for (uint32_t i = 0; i < scene->part_count; i++) {
            const lrcs_mesh *mesh = part_objects(&plan, i);
            plan.first_part[i] = plan.parts;
            plan.parts += mesh ? mesh->part_count : 1;
        }
        materials_number(&plan);
        shares->part = calloc((size_t)plan.parts + 1, sizeof *shares->part);
        shares->material = calloc((size_t)plan.materials + 1, sizeof *shares->material);
        tally = calloc((size_t)plan.parts + plan.materials + 1, sizeof *tally);
        made = tally && shares->part && shares->material && rows_name(&plan, shares) == 0;
    }
    if (made) {
        records_add(&plan, records, tally, shares);
        rows_sort(shares->part, &shares->parts);
        rows_sort(shares->material, &shares->materials);
    }
    free(tally);
    free(plan.first_part);
    free(plan.material_of);
    if (!made) {
        lrcs_host_shares_free(shares);
        return lrcsi_host_fail(error, LRCS_E_SYSTEM, "out of memory");
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
