/* SPDX-License-Identifier: MIT */
/* lrcs verify --hard: each hard case by the plain formula, by the engine and by its reference, as a
   table. This file decides what counts as right: the reference, itself rounded once, lies within
   the bound; or the engine refuses a case that has no answer. */
#include "cli/verify/verify.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* The results of a case: of the plain formula and of the engine. */
typedef struct hard_row {
    const hard_case *one;
    double naive, engine, bound, error;
    int status; /* status of the engine, negative if it refused */
    int good;
} hard_row;

static int run_closed(const hard_case *one, hard_row *row)
{
    lrcs_aspect aspect = {.deg = one->aspect_deg};
    lrcs_closed closed = {0.0, 0.0, 0.0, 0.0};
    int status = lrcs_closed_eval(&one->shape, &one->brdf, &aspect, &closed);
    row->engine = closed.sigma_m2;
    row->bound = closed.bound_m2;
    return status;
}

static int run_facets(const hard_case *one, hard_mesh *mesh, hard_row *row)
{
    lrcs_material material[2] = {{.name = "", .brdf = one->brdf, .bound = 1},
                                 {.name = "black", .bound = 1}};
    lrcs_part part = {.name = "", .kind = -1, .facet_count = mesh->facets, .curvature_known = 1};
    lrcs_host_scene host = {.scene = {.vertex_count = mesh->vertices,
                                      .facet_count = mesh->facets,
                                      .material_count = 2,
                                      .part_count = 1,
                                      .vertex = mesh->vertex,
                                      .facet = mesh->facet,
                                      .facet_material = mesh->material,
                                      .facet_part = mesh->none,
                                      .facet_smooth = mesh->none,
                                      .material = material,
                                      .part = &part,
                                      .unmatched = LRCS_NONE}};
    lrcs_run_options options = lrcs_run_options_default();
    lrcs_result result = {0};
    lrcs_pose pose;
    options.method = LRCS_METHOD_EXACT;
    int status = lrcs_pose_from_direction(one->direction, &pose);
    if (status == LRCS_OK) {
        status = lrcs_host_scene_prepare(&host, NULL);
    }
    if (status == LRCS_OK) {
        status = lrcs_host_scene_run(&host, &pose, &options, &result, NULL, NULL, NULL, NULL);
    }
    lrcs_host_scene_free(&host);
    row->engine = result.sigma_m2;
    row->bound = result.bound_m2;
    return status;
}

static hard_row hard_run(const hard_case *one)
{
    hard_row row = {.one = one};
    hard_mesh mesh;
    memset(&mesh, 0, sizeof mesh);
    if (one->build) {
        one->build(&mesh);
    }
    row.naive = one->naive(one, &mesh);
    row.status = one->build ? run_facets(one, &mesh, &row) : run_closed(one, &row);
    row.error = fabs(row.engine - one->reference_m2);
    double rounded = 0.5 * DBL_EPSILON * fabs(one->reference_m2);
    row.good = isnan(one->reference_m2) ? row.status == LRCS_E_NUMBER
                                        : row.status == LRCS_OK && row.error <= row.bound + rounded;
    return row;
}

static void row_print(const hard_row *row)
{
    printf("%-33s%14.8g ", row->one->name, isnan(row->naive) ? (double)NAN : row->naive);
    if (row->status != LRCS_OK) {
        printf("%14s %14s %9s %8s", "refused", isnan(row->one->reference_m2) ? "refused" : "", "-",
               "-");
    } else {
        printf("%14.8g %14.8g %9.1e %8.1e", row->engine, row->one->reference_m2, row->error,
               row->bound);
    }
    printf("  %s\n", row->good ? "ok" : "FAIL");
}

static void row_json(const hard_row *row, lrcs_host_json *json)
{
    char naive[LRCS_HOST_NUMBER_SIZE];
    int answered = row->status == LRCS_OK;
    lrcs_host_number_text(row->naive, naive);
    lrcs_host_json_begin(json, NULL, LRCS_HOST_ROW_OBJECT);
    lrcs_host_json_text(json, "case", row->one->name);
    /* as text: nan and inf are possible answers here */
    lrcs_host_json_text(json, "naive", naive);
    lrcs_host_json_text(json, "status", lrcs_status_text(row->status));
    lrcs_host_json_number(json, "engine_m2", answered ? row->engine : (double)NAN);
    lrcs_host_json_number(json, "reference_m2", row->one->reference_m2);
    lrcs_host_json_number(json, "error_m2", answered ? row->error : (double)NAN);
    lrcs_host_json_number(json, "bound_m2", answered ? row->bound : (double)NAN);
    lrcs_host_json_bool(json, "ok", row->good);
    lrcs_host_json_end(json);
}

static void table_begin(lrcs_host_json *json)
{
    if (json) {
        lrcs_host_json_begin(json, NULL, LRCS_HOST_OBJECT);
        cli_version_json(json);
        lrcs_host_json_begin(json, "cases", LRCS_HOST_ARRAY);
        return;
    }
    printf("%-33s%14s %14s %14s %9s %8s\n", "case, sigma in m2", "plain formula", "engine",
           "reference", "error", "bound");
}

int cli_hard_verify(int as_json)
{
    lrcs_host_json writer = lrcs_host_json_make(stdout);
    lrcs_host_json *json = as_json ? &writer : NULL;
    unsigned count = 0;
    unsigned failed = 0;
    table_begin(json);
    for (; cli_hard_case(count); count++) {
        hard_row row = hard_run(cli_hard_case(count));
        failed += !row.good;
        if (json) {
            row_json(&row, json);
        } else {
            row_print(&row);
        }
    }
    if (json) {
        lrcs_host_json_end(json);
        lrcs_host_json_count(json, "count", count);
        lrcs_host_json_count(json, "failed", failed);
        lrcs_host_json_end(json);
    } else {
        printf("%u of %u cases right within their bound\n", count - failed, count);
    }
    return failed == 0 ? CLI_DONE : CLI_FAILED;
}
