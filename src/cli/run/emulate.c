/* SPDX-License-Identifier: MIT */
/* lrcs run --precision, --depth-bits: the result of graphics hardware, and why it differs from the
   reference. The answer is emulated; its bound is proved by the reference: the bound is the
   reference's own plus the difference between the two. */
#include "cli/run/run.h"

#include <math.h>
#include <string.h>

/* Rejects methods that draw nothing and outputs that would show another answer. */
static int emulation_alone(const run_job *job)
{
    static const char *const clash[] = {"image",  "polygons", "explain", "time-budget",
                                        "shares", "steps",    "accept"};
    const int clashes = sizeof clash / sizeof clash[0];
    const cli_args *args = job->args;
    const char *given = cli_value(args, "precision") ? "precision" : "depth-bits";
    const char *method = cli_value(args, "method");
    const char *normals = cli_value(args, "normals");
    for (int i = 0; i < clashes; i++) {
        if (cli_value(args, clash[i])) {
            return cli_usage(args->command,
                             "--%s does not go with --%s, which is for the reference", given,
                             clash[i]);
        }
    }
    if (method && strcmp(method, "zbuffer") != 0) {
        return cli_usage(args->command, "--%s needs --method zbuffer, found '%s'", given, method);
    }
    if (normals && strcmp(normals, "flat") != 0) {
        return cli_usage(args->command, "--%s needs --normals flat, found '%s'", given, normals);
    }
    return 0;
}

int cli_run_emulation_read(run_job *job)
{
    const cli_args *args = job->args;
    const char *precision = cli_value(args, "precision");
    lrcs_emulation_options *options = &job->emulation.options;
    *options = lrcs_emulation_options_default();
    job->emulation.asked = precision || cli_value(args, "depth-bits");
    if (!job->emulation.asked) {
        return 0;
    }
    if (precision) {
        options->precision = lrcs_precision_find(precision);
    }
    if (options->precision < 0) {
        return cli_expected(args, "precision", "float32 or float64");
    }
    options->depth_bits = options->precision == LRCS_PRECISION_FLOAT32 ? 32 : 64;
    options->resolution = job->options.resolution ? job->options.resolution : options->resolution;
    job->options.resolution = options->resolution;
    job->options.method = LRCS_METHOD_ZBUFFER;
    int place = -1;
    int code = cli_choice(args, "depth-bits", "16, 24 or 32", &place);
    options->depth_bits = place >= 0 ? 16 + 8 * (uint32_t)place : options->depth_bits;
    return code ? code : emulation_alone(job);
}

/* Replaces those members of a reference's result in which the emulation differs. */
static void result_replace(run_job *job)
{
    const run_emulation *e = &job->emulation;
    lrcs_result *r = &job->result;
    /* |emulated - truth| <= |emulated - reference| + |reference - truth|, rounded outward: the
       difference and the sum have relative errors of u each, 2^-53 */
    double bound = (fabs(e->answer.sigma_m2 - r->sigma_m2) + r->bound_m2) * (1.0 + 0x1p-50);
    r->budget.visibility_m2 += bound - r->bound_m2;
    r->bound_m2 = bound;
    r->sigma_m2 = e->answer.sigma_m2;
    r->sigma_glint_m2 = e->answer.sigma_glint_m2;
    r->sigma_diffuse_m2 = e->answer.sigma_diffuse_m2;
    r->projected_area_m2 = e->answer.projected_area_m2;
    r->estimate_m2 = -1.0;
    r->method = LRCS_METHOD_ZBUFFER;
    r->method_reason = "graphics hardware, emulated";
    r->resolution = e->options.resolution;
    for (int i = 0; i < LRCS_EFFECTS; i++) {
        if (1u << i & LRCS_EFFECTS_SWITCHED) {
            r->effect[i] = (lrcs_effect){1, "emulated hardware leaves nothing out"};
        }
    }
    int met = r->bound_m2 <= job->options.tolerance * r->sigma_m2;
    r->flags &= ~(uint32_t)LRCS_FLAG_TOLERANCE_NOT_MET;
    r->flags |= met ? 0u : LRCS_FLAG_TOLERANCE_NOT_MET;
}

/* 1. The reference, by method exact.
   2. The emulation with double arithmetic and full depth, then with the precision asked for, then
      with the depth asked for: what each adds to the error. */
int cli_run_emulate(run_job *job)
{
    lrcs_host_error error;
    run_emulation *e = &job->emulation;
    lrcs_emulation_options sampled = e->options;
    lrcs_emulation_options deep = e->options;
    sampled.precision = LRCS_PRECISION_FLOAT64;
    sampled.depth_bits = deep.depth_bits = 64;
    lrcs_run_options options = job->options;
    options.method = LRCS_METHOD_EXACT;
    options.resolution = 0;
    int status = lrcs_host_scene_run(&job->scene, &job->pose, &options, &job->result, NULL, NULL,
                                     NULL, &error);
    e->reference_m2 = job->result.sigma_m2;
    e->reference_bound_m2 = job->result.bound_m2;
    e->reference_method = job->result.method;
    if (status == LRCS_OK) {
        status = lrcs_host_scene_emulate(&job->scene, &job->pose, &sampled, &e->sampled, NULL, NULL,
                                         &error);
    }
    if (status == LRCS_OK) {
        status =
            lrcs_host_scene_emulate(&job->scene, &job->pose, &deep, &e->deep, NULL, NULL, &error);
    }
    if (status == LRCS_OK) {
        status = lrcs_host_scene_emulate(&job->scene, &job->pose, &e->options, &e->answer,
                                         job->records, &job->seconds, &error);
    }
    if (status != LRCS_OK) {
        return cli_failed(&error);
    }
    result_replace(job);
    return 0;
}

/* ---- the report ---- */

void cli_run_emulation_json(const run_job *job, lrcs_host_json *json)
{
    const run_emulation *e = &job->emulation;
    double sampled = e->sampled.sigma_m2;
    double deep = e->deep.sigma_m2;
    double sigma = e->answer.sigma_m2;
    lrcs_host_json_put(
        json,
        "emulation={precision=%s depth_bits=%u reference_m2=%g reference_bound_m2=%g "
        "sigma_double_m2=%g off_m2=%g sampling_m2=%g precision_m2=%g depth_m2=%g "
        "running_sum_m2=%g}",
        lrcs_precision_text(e->options.precision), e->options.depth_bits, e->reference_m2,
        e->reference_bound_m2, sampled, sigma - e->reference_m2, sampled - e->reference_m2,
        deep - sampled, sigma - deep, e->answer.running_m2 - sigma);
}

/* Prints a difference, in square metres and as a share of the reference. */
static void table_off(const run_emulation *e, const char *name, double off, const char *why)
{
    printf("  %-10s %+.3g m2", name, off);
    if (e->reference_m2 > 0.0) {
        printf("   %+.2g of the reference", off / e->reference_m2);
    }
    printf("%s\n", why);
}

void cli_run_emulation_table(const run_job *job)
{
    const run_emulation *e = &job->emulation;
    double sampled = e->sampled.sigma_m2;
    double deep = e->deep.sigma_m2;
    double sigma = e->answer.sigma_m2;
    printf("reference    %.10g m2, bound %.3g m2, by method %s\n", e->reference_m2,
           e->reference_bound_m2, lrcs_method_text(e->reference_method));
    printf("emulated     %s, %lu-bit depth; from the reference it is off by\n",
           lrcs_precision_text(e->options.precision), (unsigned long)e->options.depth_bits);
    table_off(e, "all", sigma - e->reference_m2, "");
    table_off(e, "sampling", sampled - e->reference_m2, ", with doubles and 64-bit depth");
    table_off(e, "precision", deep - sampled, ", with all the depth that it has");
    table_off(e, "depth", sigma - deep, "");
    printf("a running sum in place of one in pairs adds\n");
    table_off(e, "running", e->answer.running_m2 - sigma, "");
}
