/* SPDX-License-Identifier: MIT */
/* The output of lrcs run. The keys and their order are a contract: scripts rely on them. */
#include "cli/run/run.h"

#include <math.h>

static void notice_put(lrcs_host_json *json, const char *text)
{
    if (json) {
        lrcs_host_json_text(json, NULL, text);
    } else {
        fprintf(stderr, "notice: %s\n", text);
    }
}

void cli_run_notices(const run_job *job, lrcs_host_json *json)
{
    const lrcs_host_notices *notices = &job->scene.notices;
    for (uint32_t i = 0; i < notices->count; i++) {
        notice_put(json, notices->text[i]);
    }
    for (uint32_t bits = job->result.notices; bits != 0; bits &= bits - 1) {
        notice_put(json, lrcs_notice_text(CLI_LOWEST(bits)));
    }
    if (job->options.resolution != 0 && job->result.resolution == 0) {
        notice_put(json, "--resolution has no effect: no raster was needed");
    }
}

static void json_head(const run_job *job, lrcs_host_json *json)
{
    const lrcs_result *result = &job->result;
    cli_version_json(json);
    cli_hash_json(lrcs_scene_hash(&job->scene.scene), json);
    cli_files_json(&job->scene, json);
    lrcs_host_json_put(json, "unit=%s sigma_m2=%g sigma_dbsm=%g tolerance={",
                       cli_scene_unit(job->args, &job->scene), result->sigma_m2,
                       result->sigma_m2 > 0.0 ? cli_dbsm(result->sigma_m2) : (double)NAN);
    if (!(job->asked > 0.0)) {
        lrcs_host_json_put(json, "asked=null met=null accepted_by=null}");
    } else if (result->flags & LRCS_FLAG_ACCEPTED_UNJUDGED) {
        lrcs_host_json_put(json, "asked=%g met=null accepted_by=%s}", job->asked,
                           cli_accepted_by(result->flags));
    } else {
        lrcs_host_json_put(json, "asked=%g met=%d accepted_by=%s}", job->asked, job->met,
                           cli_accepted_by(result->flags));
    }
    if (job->budget.asked_ms > 0.0) {
        lrcs_host_json_put(json, "time_budget={asked_ms=%g spent_ms=%g same_as=%s}",
                           job->budget.asked_ms, job->budget.spent_ms, job->budget.same);
    }
    if (job->options.steps != 0) {
        lrcs_host_json_put(json, "steps={asked=%llu taken=%llu}",
                           (unsigned long long)job->options.steps,
                           (unsigned long long)result->steps);
    }
    if (job->emulation.asked) {
        cli_run_emulation_json(job, json);
    }
    lrcs_host_json_put(json, result->resolution != 0 ? "resolution=%u" : "resolution=null",
                       result->resolution);
    lrcs_host_json_put(json, "normals=%s estimate_m2=%g curvature_estimate_m2=%g notices=[\n",
                       lrcs_normals_text(job->scene.scene.normals), cli_known(result->estimate_m2),
                       cli_known(result->curvature_estimate_m2));
    cli_run_notices(job, json);
    lrcs_host_json_put(json, "]");
}

static void table_bound(const char *label, double bound)
{
    char text[LRCS_HOST_BOUND_SIZE];
    lrcs_host_bound_text(bound, 3, text);
    printf("%s%s m2", label, text);
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
        char share[LRCS_HOST_BOUND_SIZE];
        lrcs_host_bound_text(r->bound_m2 / r->sigma_m2, 2, share);
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
    table_bound("  visibility ", r->budget.visibility_m2);
    if (r->budget.tessellation_m2 >= 0.0) {
        table_bound("\n  tessellation ", r->budget.tessellation_m2);
    } else {
        printf("\n  tessellation not known");
    }
    table_bound("\n  rounding   ", r->budget.rounding_m2);
    putchar('\n');
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
    double box[2][3];
    lrcs_host_json_put(&json, "{\n");
    json_head(job, &json);
    lrcs_host_json_put(&json, "sigma_glint_m2=%g sigma_diffuse_m2=%g bound_m2=%g",
                       result->sigma_glint_m2, result->sigma_diffuse_m2, result->bound_m2);
    lrcs_host_json_put(&json, "budget_m2={visibility=%g tessellation=%g rounding=%g}",
                       result->budget.visibility_m2, cli_known(result->budget.tessellation_m2),
                       result->budget.rounding_m2);
    cli_run_materials_json(job, &json);
    lrcs_host_json_put(&json, "projected_area_m2=%g method=%s method_reason=%s",
                       result->projected_area_m2, lrcs_method_text(result->method),
                       result->method_reason);
    lrcs_host_json_put(&json, "effects=[\n");
    for (int i = 0; i < LRCS_EFFECTS; i++) {
        lrcs_host_json_put(&json, "{name=%s on=%d reason=%s", lrcs_effect_text(i),
                           result->effect[i].on, result->effect[i].reason);
        if (job->explain) {
            cli_run_explain_json(job, i, &json);
        }
        lrcs_host_json_put(&json, "}");
    }
    lrcs_host_json_put(&json, "]");
    cli_flags_json(&json, result->flags);
    lrcs_host_json_put(&json, "facets={total=%u front=%u hidden=%u partial=%u}",
                       result->facets_total, result->facets_front, result->facets_hidden,
                       result->facets_partial);
    cli_direction_json(&job->pose, &json);
    lrcs_host_json_put(&json, "seconds={load=%g prepare=%g pose=%g", job->scene.seconds_load,
                       job->scene.seconds_prepare, job->seconds);
    if (job->explain) {
        cli_run_explain_stages_json(job, &json);
    }
    lrcs_host_json_put(&json, "}");
    lrcs_host_scene_box(&job->scene.scene, box[0], box[1]);
    lrcs_host_json_numbers(&json, "box_min_m", box[0], 3);
    lrcs_host_json_numbers(&json, "box_max_m", box[1], 3);
    cli_run_caveats_json(job, &json);
    cli_provenance_json(job->args, &job->scene, &json);
    if (job->shares_asked) {
        cli_shares_json(&job->shares, &json);
    }
    lrcs_host_json_put(&json, "}");
}

void cli_run_table(const run_job *job)
{
    const lrcs_result *r = &job->result;
    double s_hat[3];
    cli_pose_unit(&job->pose, s_hat);
    double box[2][3];
    lrcs_host_scene_box(&job->scene.scene, box[0], box[1]);
    printf("scene        ");
    cli_scene_print(job->args, &job->scene);
    printf(", hash %016llx\nbox          %.5g, %.5g, %.5g .. %.5g, %.5g, %.5g m%s\n",
           (unsigned long long)lrcs_scene_hash(&job->scene.scene), box[0][0], box[0][1], box[0][2],
           box[1][0], box[1][1], box[1][2],
           lrcs_host_scene_tessellated(&job->scene.scene) ? "   of the facets" : "");
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
    printf("facets       %lu, %lu facing the laser; of those that can reflect %lu are hidden, %lu "
           "partly hidden\n",
           (unsigned long)r->facets_total, (unsigned long)r->facets_front,
           (unsigned long)r->facets_hidden, (unsigned long)r->facets_partial);
    for (uint32_t bits = r->flags; bits != 0; bits &= bits - 1) {
        printf("flag         %s\n", lrcs_flag_text(CLI_LOWEST(bits)));
    }
    if (job->budget.asked_ms > 0.0) {
        printf("time budget  %g ms, of which %.3g were spent; the same again: %s\n",
               job->budget.asked_ms, job->budget.spent_ms, job->budget.same);
    }
    if (job->options.steps != 0) {
        printf("steps        %llu of at most %llu\n", (unsigned long long)r->steps,
               (unsigned long long)job->options.steps);
    }
    printf("time         load %.3g ms, prepare %.3g ms, pose %.3g ms%s\n",
           1e3 * job->scene.seconds_load, 1e3 * job->scene.seconds_prepare, 1e3 * job->seconds,
           job->explain ? " (the first run; medians below)" : "");
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
