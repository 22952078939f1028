/* SPDX-License-Identifier: MIT */
/* lrcs run --explain: what each effect and each stage takes (lrcs/explain.h), as JSON and as a
   table. Timings smaller than their scatter are marked. */
#include "cli/run/run.h"

#include <math.h>
#include <string.h>

/* Columns of the table. */
#define WHY_FROM 69
#define WHY_TO   100

static const char *const prepare_stage[LRCS_HOST_PREPARE_STAGES] = {
    "edges", "neighbours", "contacts", "normals", "proofs"};
static const char *const pose_stage[LRCS_HOST_POSE_STAGES] = {"view", "classify", "visibility",
                                                              "sum"}; /* keys of the JSON */
static const char *const pose_stage_words[LRCS_HOST_POSE_STAGES] = {"view", "classify",
                                                                    "visibility", "adding up"};

static int is_switched(int effect)
{
    return (1u << effect & LRCS_EFFECTS_SWITCHED) != 0;
}

static void effect_begin(uint32_t done, uint32_t count)
{
    cli_watch_stage("effects", NULL);
    cli_watch_count(done, count);
}

int cli_run_explain(run_job *job)
{
    lrcs_host_error error;
    lrcs_host_explained *explained = &job->explained;
    if (lrcs_host_explain(&job->scene, &job->pose, &job->options, &job->result, effect_begin,
                          explained, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    if (job->caveats.back_area_m2 > 0.0) {
        explained->effect[LRCS_EFFECT_TWO_SIDED].sigma_m2 = job->caveats.back_sigma_m2;
    }
    return 0;
}

/* A value of an effect, or none if a run cannot switch the effect. */
static double where_switched(int effect, double value)
{
    return is_switched(effect) ? value : (double)NAN;
}

void cli_run_explain_json(const run_job *job, int effect, lrcs_host_json *json)
{
    const lrcs_host_explained_effect *e = &job->explained.effect[effect];
    lrcs_host_json_put(json, "seconds=%g share=%g sigma_m2_flipped=%g",
                       where_switched(effect, e->seconds),
                       where_switched(effect, e->seconds / job->explained.pose),
                       where_switched(effect, e->sigma_m2));
}

void cli_run_explain_stages_json(const run_job *job, lrcs_host_json *json)
{
    lrcs_host_json_put(json, "prepare_stages={");
    for (int i = 0; i < LRCS_HOST_PREPARE_STAGES; i++) {
        lrcs_host_json_number(json, prepare_stage[i], job->scene.seconds_stage[i]);
    }
    lrcs_host_json_put(json, "} pose_stages={");
    for (int i = 0; i < LRCS_HOST_POSE_STAGES; i++) {
        lrcs_host_json_number(json, pose_stage[i], job->explained.stage[i]);
    }
    lrcs_host_json_put(json, "}");
}

/* ---- the table ---- */

/* Prints text from column `from` on, where the cursor is, wrapped at blanks before column `to`. */
static void print_wrapped(const char *text, int from, int to)
{
    int at = from;
    while (*text) {
        size_t length = strcspn(text, " ");
        int size = (int)length;
        if (at > from && at + 1 + size > to) {
            printf("\n%*s", from, "");
            at = from;
        }
        at += printf("%s%.*s", at > from ? " " : "", size, text);
        text += length + strspn(text + length, " ");
    }
    putchar('\n');
}

/* Decimals: two significant digits, below 0.1 down to 1e-4. */
static int decimals(double value)
{
    return value >= 9.95 ? 0 : value >= 0.995 ? 1 : value >= 0.0995 ? 2 : 4;
}

/* Prints a measured value, in brackets for an effect that is off; if it is lost in the scatter,
   only the size of the scatter. */
static void measure_column(double value, int lost, int on, const char *unit, int width)
{
    char text[48];
    const char *less = lost ? "< " : "";
    snprintf(text, sizeof text, on ? "%s%.*f %s" : "(%s%.*f %s)", less, decimals(value), value,
             unit);
    cli_column(text, width);
}

/* The columns of an effect: its time, in ms and as a share of the pose, and the change of sigma
   without the effect, or with it where it is off. */
static void effect_columns(const run_job *job, int on, const lrcs_host_explained_effect *e)
{
    char change[32] = "same";
    double sigma = job->result.sigma_m2;
    int lost = !(e->seconds > 2.0 * e->scatter);
    double seconds = lost ? fmax(fabs(e->seconds), 2.0 * e->scatter) : e->seconds;
    measure_column(1e3 * seconds, lost, on, "ms", 15);
    measure_column(100.0 * seconds / job->explained.pose, lost, on, "%", 13);
    if (e->sigma_m2 != sigma && sigma > 0.0) {
        snprintf(change, sizeof change, "%+.3g %%", 100.0 * (e->sigma_m2 - sigma) / sigma);
    } else if (e->sigma_m2 != sigma) {
        snprintf(change, sizeof change, "%+.3g m2", e->sigma_m2);
    }
    cli_column(change, 16);
}

static void stage_print(const char *name, double seconds, double all)
{
    double share = 100.0 * seconds / all;
    printf("%s %.*f ms (%.*f %%)", name, decimals(1e3 * seconds), 1e3 * seconds, decimals(share),
           share);
}

/* scatter: of each stage, or NULL. Stages lost in it are shown as at most this value. */
static void stages_list(const char *label, const char *const *name, const double *seconds,
                        const double *scatter, int count)
{
    printf("  %-11s", label);
    for (int i = 0; i < count; i++) {
        double off = scatter ? 2.0 * scatter[i] : 0.0;
        double ms = 1e3 * fmax(seconds[i], off);
        printf("%s%s %s%.*f", i > 0 ? ", " : "", name[i], seconds[i] < off ? "< " : "",
               decimals(ms), ms);
    }
    printf(" ms\n");
}

static void stages_print(const run_job *job)
{
    double load = job->scene.seconds_load;
    double prepare = job->scene.seconds_prepare;
    double pose = job->explained.pose;
    double all = load + prepare + pose;
    stage_print("stages       load and joints", load, all);
    stage_print(", prepare", prepare, all);
    stage_print(", pose", pose, all);
    putchar('\n');
    stages_list("prepare", prepare_stage, job->scene.seconds_stage, NULL, LRCS_HOST_PREPARE_STAGES);
    stages_list("pose", pose_stage_words, job->explained.stage, job->explained.stage_scatter,
                LRCS_HOST_POSE_STAGES);
}

void cli_run_explain_table(const run_job *job)
{
    double pose = 1e3 * job->explained.pose;
    printf(
        "explained    each effect left out in turn, or simulated where it is off: what it takes,\n"
        "             or would take, in brackets; effects overlap; pose %.*f ms; medians of %lu "
        "runs\n",
        decimals(pose), pose, (unsigned long)job->explained.rounds);
    printf("  %-18s %-4s%-15s%-13s%s\n", "", "", "", "", "sigma without");
    printf("  %-18s %-4s%-15s%-13s%-16s%s\n", "effect", "now", "time", "of the pose",
           "it (or with it)", "why");
    for (int i = 0; i < LRCS_EFFECTS; i++) {
        const lrcs_effect *effect = &job->result.effect[i];
        printf("  %-18s %-4s", lrcs_effect_text(i), effect->on ? "on" : "off");
        if (is_switched(i)) {
            effect_columns(job, effect->on, &job->explained.effect[i]);
        } else {
            printf("%-15s%-13s%-16s", "-", "-", "-");
        }
        print_wrapped(effect->reason, WHY_FROM, WHY_TO);
    }
    stages_print(job);
}
