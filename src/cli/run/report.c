/* SPDX-License-Identifier: MIT */
/* The output of lrcs run. The keys and their order are the contract of DESIGN.md, section 4. */
#include "cli/run/run.h"

#include <math.h>

/* Writes every notice of a run: those of the scene, of the result, and of options that had no
   effect. They go to the open JSON array, or to stderr. */
static void notice_say(lrcs_host_json *json, const char *text)
{
    if (json) {
        lrcs_host_json_text(json, NULL, text);
    } else {
        fprintf(stderr, "notice: %s\n", text);
    }
}

static void notices_say(const run_job *job, lrcs_host_json *json)
{
    const lrcs_host_notices *notices = &job->scene.notices;
    for (uint32_t i = 0; i < notices->count; i++) {
        notice_say(json, notices->text[i]);
    }
    for (uint32_t bits = job->result.notices, bit = 1; bits != 0; bits >>= 1, bit *= 2) {
        if (bits & 1u) {
            notice_say(json, lrcs_notice_text((int)bit));
        }
    }
    if (job->options.resolution != 0 && job->result.resolution == 0) {
        notice_say(json, "--resolution has no effect: no raster was needed");
    }
}

/* A negative number means not known. */
static void known_number(lrcs_host_json *json, const char *key, double value)
{
    lrcs_host_json_number(json, key, value >= 0.0 ? value : (double)NAN);
}

static void json_head(const run_job *job, lrcs_host_json *json)
{
    const lrcs_result *result = &job->result;
    cli_version_json(json);
    cli_hash_json(lrcs_scene_hash(&job->scene.scene), json);
    cli_files_json(&job->scene, json);
    lrcs_host_json_text(json, "unit", cli_value(job->args, "unit"));
    lrcs_host_json_number(json, "sigma_m2", result->sigma_m2);
    lrcs_host_json_number(json, "sigma_dbsm",
                          result->sigma_m2 > 0.0 ? cli_dbsm(result->sigma_m2) : (double)NAN);
    lrcs_host_json_begin(json, "tolerance", LRCS_HOST_ROW_OBJECT);
    if (job->asked > 0.0) {
        lrcs_host_json_number(json, "asked", job->asked);
        if (result->flags & LRCS_FLAG_ACCEPTED_UNJUDGED) {
            lrcs_host_json_text(json, "met", NULL);
        } else {
            lrcs_host_json_bool(json, "met", job->met);
        }
        lrcs_host_json_text(json, "accepted_by", cli_accepted_by(result->flags));
    } else {
        lrcs_host_json_text(json, "asked", NULL);
        lrcs_host_json_text(json, "met", NULL);
        lrcs_host_json_text(json, "accepted_by", NULL);
    }
    lrcs_host_json_end(json);
    if (job->budget.asked_ms > 0.0) {
        lrcs_host_json_begin(json, "time_budget", LRCS_HOST_ROW_OBJECT);
        lrcs_host_json_number(json, "asked_ms", job->budget.asked_ms);
        lrcs_host_json_number(json, "spent_ms", job->budget.spent_ms);
        lrcs_host_json_text(json, "same_as", job->budget.same);
        lrcs_host_json_end(json);
    }
    if (job->options.steps != 0) {
        lrcs_host_json_begin(json, "steps", LRCS_HOST_ROW_OBJECT);
        lrcs_host_json_count(json, "asked", job->options.steps);
        lrcs_host_json_count(json, "taken", result->steps);
        lrcs_host_json_end(json);
    }
    if (job->emulation.asked) {
        cli_run_emulation_json(job, json);
    }
    if (result->resolution != 0) {
        lrcs_host_json_count(json, "resolution", result->resolution);
    } else {
        lrcs_host_json_text(json, "resolution", NULL);
    }
    lrcs_host_json_text(json, "normals", lrcs_normals_text(job->scene.scene.normals));
    known_number(json, "estimate_m2", result->estimate_m2);
    known_number(json, "curvature_estimate_m2", result->curvature_estimate_m2);
    lrcs_host_json_begin(json, "notices", LRCS_HOST_ARRAY);
    notices_say(job, json);
    lrcs_host_json_end(json);
}

static void json_effects(const run_job *job, lrcs_host_json *json)
{
    const lrcs_result *result = &job->result;
    lrcs_host_json_begin(json, "effects", LRCS_HOST_ARRAY);
    for (int i = 0; i < LRCS_EFFECTS; i++) {
        lrcs_host_json_begin(json, NULL, LRCS_HOST_ROW_OBJECT);
        lrcs_host_json_text(json, "name", lrcs_effect_text(i));
        lrcs_host_json_bool(json, "on", result->effect[i].on);
        lrcs_host_json_text(json, "reason", result->effect[i].reason);
        if (job->explain) {
            cli_run_explain_json(job, i, json);
        }
        lrcs_host_json_end(json);
    }
    lrcs_host_json_end(json);
    lrcs_host_json_begin(json, "flags", LRCS_HOST_ROW_ARRAY);
    for (uint32_t bits = result->flags, bit = 1; bits != 0; bits >>= 1, bit *= 2) {
        if (bits & 1u) {
            lrcs_host_json_text(json, NULL, lrcs_flag_text((int)bit));
        }
    }
    lrcs_host_json_end(json);
}

static void json_tail(const run_job *job, lrcs_host_json *json)
{
    const lrcs_result *result = &job->result;
    lrcs_host_json_begin(json, "facets", LRCS_HOST_ROW_OBJECT);
    lrcs_host_json_count(json, "total", result->facets_total);
    lrcs_host_json_count(json, "front", result->facets_front);
    lrcs_host_json_count(json, "hidden", result->facets_hidden);
    lrcs_host_json_count(json, "partial", result->facets_partial);
    lrcs_host_json_end(json);
    cli_direction_json(&job->pose, json);
    lrcs_host_json_begin(json, "seconds", LRCS_HOST_ROW_OBJECT);
    lrcs_host_json_number(json, "load", job->scene.seconds_load);
    lrcs_host_json_number(json, "prepare", job->scene.seconds_prepare);
    lrcs_host_json_number(json, "pose", job->seconds);
    if (job->explain) {
        cli_run_explain_stages_json(job, json);
    }
    lrcs_host_json_end(json);
}

static void json_box(const run_job *job, lrcs_host_json *json)
{
    double box[2][3];
    lrcs_host_scene_box(&job->scene.scene, box[0], box[1]);
    for (int i = 0; i < 2; i++) {
        cli_numbers_json(json, i == 0 ? "box_min_m" : "box_max_m", box[i], 3);
    }
}

static void table_bound(const char *label, double bound)
{
    char text[CLI_BOUND_SIZE];
    cli_bound_text(bound, 3, text);
    printf("%s%s m2", label, text);
}

static void table_budget(const lrcs_budget *budget)
{
    table_bound("  visibility ", budget->visibility_m2);
    if (budget->tessellation_m2 >= 0.0) {
        table_bound("\n  tessellation ", budget->tessellation_m2);
    } else {
        printf("\n  tessellation not known");
    }
    table_bound("\n  rounding   ", budget->rounding_m2);
    putchar('\n');
}

static void table_sigma(const run_job *job)
{
    const lrcs_result *r = &job->result;
    printf("sigma        %.10g m2", r->sigma_m2);
    if (r->sigma_m2 > 0.0) {
        printf("   %.6f dBsm", cli_dbsm(r->sigma_m2));
    }
    printf("\n  glint      %.10g m2\n  diffuse    %.10g m2\n", r->sigma_glint_m2,
           r->sigma_diffuse_m2);
    table_bound("bound        ", r->bound_m2);
    if (r->sigma_m2 > 0.0) {
        char share[CLI_BOUND_SIZE];
        cli_bound_text(r->bound_m2 / r->sigma_m2, 2, share);
        printf("   %s of sigma", share);
    }
    if (job->asked > 0.0) {
        printf("; tolerance %g %s", job->asked,
               r->flags & LRCS_FLAG_ACCEPTED_BY_ESTIMATE ? "met by the ESTIMATE alone"
               : r->flags & LRCS_FLAG_ACCEPTED_UNJUDGED  ? "not judged: any answer was accepted"
               : job->met                                ? "met"
                                                         : "NOT met");
    }
    putchar('\n');
    table_budget(&r->budget);
    if (r->estimate_m2 >= 0.0) {
        printf("estimate     %.3g m2   likely error, not a bound\n", r->estimate_m2);
    }
    if (r->curvature_estimate_m2 >= 0.0) {
        printf("curvature    %.3g m2   cubature, an estimate, not in the bound\n",
               r->curvature_estimate_m2);
    }
    cli_run_materials_table(job);
    printf("silhouette   %.10g m2\n", r->projected_area_m2);
    if (job->emulation.asked) {
        cli_run_emulation_table(job);
    }
}

void cli_run_json(const run_job *job)
{
    const lrcs_result *result = &job->result;
    lrcs_host_json json = lrcs_host_json_make(stdout);
    lrcs_host_json_begin(&json, NULL, LRCS_HOST_OBJECT);
    json_head(job, &json);
    lrcs_host_json_number(&json, "sigma_glint_m2", result->sigma_glint_m2);
    lrcs_host_json_number(&json, "sigma_diffuse_m2", result->sigma_diffuse_m2);
    lrcs_host_json_number(&json, "bound_m2", result->bound_m2);
    lrcs_host_json_begin(&json, "budget_m2", LRCS_HOST_ROW_OBJECT);
    lrcs_host_json_number(&json, "visibility", result->budget.visibility_m2);
    known_number(&json, "tessellation", result->budget.tessellation_m2);
    lrcs_host_json_number(&json, "rounding", result->budget.rounding_m2);
    lrcs_host_json_end(&json);
    cli_run_materials_json(job, &json);
    lrcs_host_json_number(&json, "projected_area_m2", result->projected_area_m2);
    lrcs_host_json_text(&json, "method", lrcs_method_text(result->method));
    lrcs_host_json_text(&json, "method_reason", result->method_reason);
    json_effects(job, &json);
    json_tail(job, &json);
    json_box(job, &json);
    cli_run_open_json(job, &json);
    cli_provenance_json(job->args, &job->scene, &json);
    if (job->shares_asked) {
        cli_shares_json(&job->shares, &json);
    }
    lrcs_host_json_end(&json);
}

void cli_run_table(const run_job *job)
{
    const lrcs_result *r = &job->result;
    double s_hat[3];
    cli_pose_unit(&job->pose, s_hat);
    double box[2][3];
    lrcs_host_scene_box(&job->scene.scene, box[0], box[1]);
    printf("scene        ");
    cli_column(cli_scene_title(job->args, &job->scene), 0);
    printf(", hash %016llx\nbox          %.5g, %.5g, %.5g .. %.5g, %.5g, %.5g m\n",
           (unsigned long long)lrcs_scene_hash(&job->scene.scene), box[0][0], box[0][1], box[0][2],
           box[1][0], box[1][1], box[1][2]);
    printf("direction    %.10g, %.10g, %.10g   to the laser, body frame\n", s_hat[0], s_hat[1],
           s_hat[2]);
    table_sigma(job);
    printf("method       %s", lrcs_method_text(r->method));
    if (r->resolution != 0) {
        printf(", %lu x %lu", (unsigned long)r->resolution, (unsigned long)r->resolution);
    }
    printf(" (%s%s)\n", job->options.method == LRCS_METHOD_AUTO ? "chosen by auto: " : "",
           r->method_reason);
    printf("simulated    normals %s\n", lrcs_normals_text(job->scene.scene.normals));
    for (int i = 0; i < LRCS_EFFECTS; i++) {
        printf("  %-18s %-4s %s\n", lrcs_effect_text(i), r->effect[i].on ? "on" : "off",
               r->effect[i].reason);
    }
    printf("facets       %lu: %lu face the laser, %lu hidden, %lu partly hidden\n",
           (unsigned long)r->facets_total, (unsigned long)r->facets_front,
           (unsigned long)r->facets_hidden, (unsigned long)r->facets_partial);
    for (uint32_t bits = r->flags, bit = 1; bits != 0; bits >>= 1, bit *= 2) {
        if (bits & 1u) {
            printf("flag         %s\n", lrcs_flag_text((int)bit));
        }
    }
    if (job->budget.asked_ms > 0.0) {
        printf("time budget  %g ms, of which %.3g were spent; the same again: %s\n",
               job->budget.asked_ms, job->budget.spent_ms, job->budget.same);
    }
    if (job->options.steps != 0) {
        printf("steps        %llu of at most %llu\n", (unsigned long long)r->steps,
               (unsigned long long)job->options.steps);
    }
    printf("time         load %.3g ms, prepare %.3g ms, pose %.3g ms\n",
           1e3 * job->scene.seconds_load, 1e3 * job->scene.seconds_prepare, 1e3 * job->seconds);
    if (job->image_path) {
        printf("picture      %s\n", job->image_path);
    }
    if (job->shares_asked) {
        cli_shares_table(&job->shares);
    }
    if (job->explain) {
        cli_run_explain_table(job);
    }
    cli_run_verdict(job, stdout);
}

void cli_run_notices(const run_job *job)
{
    notices_say(job, NULL);
}
