/* SPDX-License-Identifier: MIT */
/* Compares the submitted visible areas with the truth's, facet by facet: how facets differ, and
   which ones change sigma most. This only explains; the verdict depends on sigma alone. */
#include "host/kit/kit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constant.h"
#include "host/fail.h"

#define SEEN         0.02 /* allowed error, as a share of a facet's projected area */
#define NONE_SEEN    1e-3 /* a visible share below this is none; all but this is everything */
#define COSINE_WRONG 1e-3
#define COSINE_FLOAT 1e-9

typedef struct facets_read {
    lrcs_host_judgement *job;
    double **visible; /* by case: submitted areas by facet; NULL if none were submitted */
    lrcs_host_kit_facets *found;
} facets_read;

/* ---- reading ---- */

enum { FACET_SCENE, FACET_ATTITUDE, FACET_INDEX, FACET_AREA, FACET_COSINE, FACET_COLUMNS };

static int facet_line(facets_read *facets, const lrcsi_kit_table *table)
{
    double index;
    double area;
    double cosine;
    lrcs_host_kit_case *one;
    int status = lrcsi_kit_find(&facets->job->kit, table, &one);
    status = status == LRCS_OK ? lrcsi_kit_records(&facets->job->kit, one, table->error) : status;
    if (status != LRCS_OK) {
        return status;
    }
    uint32_t count = facets->job->kit.scene[one->scene].host.scene.facet_count;
    double **visible = &facets->visible[one - facets->job->kit.list];
    *visible = *visible ? *visible : calloc((size_t)count + 1, sizeof **visible);
    if (!*visible) {
        return lrcsi_host_out_of_memory(table->error);
    }
    status = lrcsi_kit_table_number(table, FACET_INDEX, &index);
    status = status == LRCS_OK ? lrcsi_kit_table_number(table, FACET_AREA, &area) : status;
    if (status != LRCS_OK) {
        return status;
    }
    if (!(index >= 0.0 && index < count) || index != floor(index)) {
        return lrcsi_kit_table_refuse(table, FACET_INDEX, "a facet 0 .. %lu",
                                      (unsigned long)count - 1);
    }
    if (lrcsi_kit_table_has(table, FACET_COSINE)) {
        status = lrcsi_kit_table_number(table, FACET_COSINE, &cosine);
        if (status != LRCS_OK) {
            return status;
        }
        double truth = one->records[(uint32_t)index].cos_theta;
        double off = fabs(cosine - truth);
        facets->found->cosines++;
        if (off > COSINE_WRONG && fabs(cosine + truth) < COSINE_WRONG) {
            facets->found->cosines_negated++;
        } else {
            facets->found->cosine_error_max = fmax(facets->found->cosine_error_max, off);
        }
    }
    (*visible)[(uint32_t)index] = area;
    return LRCS_OK;
}

/* ---- differing ---- */

static int difference_kind(double whole, double truth, double answer, double allowed)
{
    double none = NONE_SEEN * whole;
    return truth <= none              ? LRCS_HOST_FACET_SHOWN
           : answer <= none           ? LRCS_HOST_FACET_LOST
           : answer > whole + allowed ? LRCS_HOST_FACET_LARGER
           : truth >= whole - none    ? LRCS_HOST_FACET_PART
           : answer >= whole - none   ? LRCS_HOST_FACET_WHOLE
                                      : LRCS_HOST_FACET_ELSEWHERE;
}

static void facet_compare(facets_read *facets, const lrcs_host_kit_case *one, uint32_t facet,
                          double answer)
{
    const lrcs_host_judgement *job = facets->job;
    const lrcs_scene *scene = &job->kit.scene[one->scene].host.scene;
    const lrcs_facet_record *record = &one->records[facet];
    const lrcs_brdf *brdf = &scene->material[scene->facet_material[facet]].brdf;
    double c = fabs(record->cos_theta);
    double whole = record->area_m2 * c;
    double truth = record->visible_area_m2;
    /* Allowed is a share of the facet; or, if a raster was asked for, a pixel along its outline
       (two if outlines of other facets cross it) and a pixel. */
    double pixel = one->side_m / job->pixels;
    double outlines = truth >= (1.0 - NONE_SEEN) * whole ? 1.0 : 2.0;
    double raster = outlines * lrcsi_kit_outline(scene, facet, &one->pose) * pixel + pixel * pixel;
    double allowed =
        job->grade == LRCS_HOST_GRADE_RASTER ? fmax(SEEN * whole, raster) : SEEN * whole;
    lrcs_host_kit_facet off = {
        .kit_case = one, .facet = facet, .answer_m2 = answer, .truth_m2 = truth};
    if (fabs(answer - truth) <= allowed) {
        return;
    }
    off.sigma_m2 = LRCS_FOUR_PI * lrcs_brdf_eval(brdf, c) * c * fabs(answer - truth);
    double sigma_allowed = lrcs_host_judge_allowed(one, job->grade, job->pixels);
    off.weight = sigma_allowed > 0.0 ? off.sigma_m2 / sigma_allowed : 0.0;
    off.failed = lrcs_host_judge_failed(job, one);
    off.kind = difference_kind(whole, truth, answer, allowed);
    lrcs_host_kit_facets *found = facets->found;
    found->kind_count[off.kind]++;
    /* the worst are kept: those of failing cases first, then by the change relative to what the
       case is allowed */
    uint32_t at = found->worst_count;
    for (; at > 0; at--) {
        const lrcs_host_kit_facet *before = &found->worst[at - 1];
        if (off.failed != before->failed ? before->failed : before->weight >= off.weight) {
            break;
        }
    }
    if (at < LRCS_HOST_KIT_NAMED) {
        found->worst_count += found->worst_count < LRCS_HOST_KIT_NAMED;
        memmove(&found->worst[at + 1], &found->worst[at],
                (found->worst_count - at - 1) * sizeof *found->worst);
        found->worst[at] = off;
    }
}

int lrcs_host_judge_facets(lrcs_host_judgement *judgement, const char *path, lrcs_host_error *error)
{
    static const char *const name[FACET_COLUMNS] = {"scene", "attitude", "facet", "visible_area_m2",
                                                    "cos_theta"};
    const lrcs_host_kit *kit = &judgement->kit;
    facets_read facets = {.job = judgement, .found = &judgement->by_facet};
    lrcsi_kit_table table;
    facets.visible = calloc((size_t)kit->cases + 1, sizeof *facets.visible);
    if (!facets.visible) {
        return lrcsi_host_out_of_memory(error);
    }
    int status = lrcsi_kit_table_open(path, name, FACET_COLUMNS, FACET_COSINE, &table, error);
    while (lrcsi_kit_table_next(&table, &status)) {
        status = facet_line(&facets, &table);
    }
    lrcsi_kit_table_close(&table);
    for (uint32_t i = 0; i < kit->cases; i++) {
        const lrcs_host_kit_case *one = &kit->list[i];
        uint32_t count = kit->scene[one->scene].host.scene.facet_count;
        facets.found->cases += status == LRCS_OK && facets.visible[i] != NULL;
        for (uint32_t k = 0; status == LRCS_OK && facets.visible[i] && k < count; k++) {
            facet_compare(&facets, one, k, facets.visible[i][k]);
        }
        free(facets.visible[i]);
    }
    free(facets.visible);
    return status;
}

/* ---- in words ---- */

const char *lrcs_host_facet_kind_text(int kind)
{
    static const char *const text[LRCS_HOST_FACET_KINDS] = {
        "seen by them, hidden in truth (missing shadow)",
        "not seen by them, visible in truth (lost, culled or behind)",
        "seen whole by them, partly hidden in truth (missing shadow)",
        "seen in part by them, whole in truth (clipped, or hidden by what is behind?)",
        "seen larger by them than they are (area of a pixel, or of the window?)",
        "seen in another part than in truth"};
    return text[kind];
}

const char *lrcs_host_cosines_text(const lrcs_host_kit_facets *facets)
{
    return facets->cosines == 0 ? NULL
           : 2 * facets->cosines_negated > facets->cosines
               ? "the other sign: normals point inward, or to the wrong side"
           : facets->cosine_error_max > COSINE_WRONG ? "wrong frame or normals"
           : facets->cosine_error_max > COSINE_FLOAT ? "single precision"
                                                     : "double precision";
}
