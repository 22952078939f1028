/* SPDX-License-Identifier: MIT */
/* lrcs run --explain: the time and the change of sigma that each effect causes, measured by leaving
   it out, or by simulating it if the planner does not. The planner decides which effects are on,
   and why; timings are those of this machine, and those smaller than their scatter are marked. The
   stages of the pose are timed by runs that end after each of them. */
#include "cli/run/run.h"

#include <math.h>
#include <string.h>
#include <time.h>

/* Rounds of measurements: at least one, and more as long as this time allows. */
#define ROUNDS_MOST  101u
#define ROUNDS_SPENT 2.0 /* seconds */

/* Columns of the table. */
#define WHY_FROM 67
#define WHY_TO   100

static const char *const prepare_stage[LRCS_HOST_PREPARE_STAGES] = {
    "edges", "neighbours", "contacts", "normals", "proofs"};
static const char *const pose_stage[LRCS_HOST_POSE_STAGES] = {"view", "classify", "visibility",
                                                              "sum"};

/* Seconds of every round: as planned, with each effect flipped, as planned again, and up to each
   stage. */
typedef struct explain_times {
    double first[ROUNDS_MOST], last[ROUNDS_MOST];
    double flipped[LRCS_EFFECTS][ROUNDS_MOST];
    double until[LRCS_HOST_POSE_STAGES][ROUNDS_MOST];
} explain_times;

static int is_switched(int effect)
{
    return (1u << effect & LRCS_EFFECTS_SWITCHED) != 0;
}

static double processor_seconds(void)
{
    struct timespec now = {0, 0};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Runs the pose once more; 0 or CLI_FAILED. Measures the processor's time, which does not include
   waiting for other processes. */
static int explain_pose(const run_job *job, const lrcs_run_options *options, lrcs_result *result,
                        double *seconds)
{
    double start = processor_seconds();
    int code = cli_scene_run(&job->scene, &job->pose, options, result, NULL, NULL, NULL);
    *seconds = processor_seconds() - start;
    return code;
}

/* Runs the pose up to a stage, by the method and raster that gave the answer; likewise. */
static int explain_stage(const run_job *job, int stage, double *seconds)
{
    lrcs_host_error error;
    lrcs_run_options options = job->options;
    options.method = job->result.method;
    options.resolution = job->result.resolution;
    double start = processor_seconds();
    int status = lrcs_host_scene_run_until(&job->scene, &job->pose, &options, stage, &error);
    *seconds = processor_seconds() - start;
    return status == LRCS_OK ? 0 : cli_failed(&error);
}

/* One round: its runs follow each other closely, so that a slower machine affects them all. Adds
   its time to *spent. */
static int explain_round(run_job *job, explain_times *times, uint32_t round, double *spent)
{
    lrcs_result result = {0};
    int code = explain_pose(job, &job->options, &result, &times->first[round]);
    cli_watch_stage("effects", NULL);
    for (int i = 0; i < LRCS_EFFECTS && code == 0; i++) {
        cli_watch_count((uint64_t)i, LRCS_EFFECTS);
        lrcs_run_options options = job->options;
        if (!is_switched(i)) {
            continue;
        }
        *(job->result.effect[i].on ? &options.without : &options.with) = 1u << i;
        code = explain_pose(job, &options, &result, &times->flipped[i][round]);
        *spent += times->flipped[i][round];
        job->explained.effect[i].sigma_m2 = result.sigma_m2;
    }
    if (code == 0) {
        code = explain_pose(job, &job->options, &result, &times->last[round]);
        *spent += times->first[round] + times->last[round];
    }
    for (int i = 0; i < LRCS_HOST_POSE_STAGES && code == 0; i++) {
        code = explain_stage(job, i, &times->until[i][round]);
        *spent += times->until[i][round];
    }
    return code;
}

/* The time of an effect: the median over rounds of the difference between runs with and without it.
   The scatter is its standard error, as for normal errors of n rounds: 1.86 times the median
   deviation over sqrt(n); with few rounds, 1.09 times the difference between equal runs of a
   round. */
static void explain_effect(const run_job *job, const explain_times *times, uint32_t rounds,
                           int effect, run_explained_effect *out)
{
    double difference[ROUNDS_MOST];
    double away[ROUNDS_MOST];
    double equal[ROUNDS_MOST];
    double sign = job->result.effect[effect].on ? 1.0 : -1.0;
    for (uint32_t r = 0; r < rounds; r++) {
        double planned = 0.5 * (times->first[r] + times->last[r]);
        difference[r] = away[r] = sign * (planned - times->flipped[effect][r]);
        equal[r] = fabs(times->first[r] - times->last[r]);
    }
    out->seconds = cli_median(difference, rounds);
    for (uint32_t r = 0; r < rounds; r++) {
        away[r] = fabs(away[r] - out->seconds);
    }
    out->scatter =
        fmax(1.86 * cli_median(away, rounds), 1.09 * cli_median(equal, rounds)) / sqrt(rounds);
}

/* The time of each stage: the median over rounds of the difference between runs up to it and up to
   the one before, at least 0. The scatter is that of an effect, reduced in proportion for runs that
   are shorter than the pose. */
static void explain_stages(const explain_times *times, uint32_t rounds, run_explained *out)
{
    double difference[ROUNDS_MOST];
    double run[ROUNDS_MOST];
    double equal[ROUNDS_MOST];
    for (int i = 0; i < LRCS_HOST_POSE_STAGES; i++) {
        for (uint32_t r = 0; r < rounds; r++) {
            difference[r] = times->until[i][r] - (i > 0 ? times->until[i - 1][r] : 0.0);
            run[r] = times->until[i][r];
            equal[r] = fabs(times->first[r] - times->last[r]) / times->first[r];
        }
        out->stage[i] = fmax(0.0, cli_median(difference, rounds));
        for (uint32_t r = 0; r < rounds; r++) {
            difference[r] = fabs(difference[r] - out->stage[i]);
        }
        double single = 1.09 * cli_median(equal, rounds) * cli_median(run, rounds);
        out->stage_scatter[i] = fmax(1.86 * cli_median(difference, rounds), single) / sqrt(rounds);
    }
}

int cli_run_explain(run_job *job)
{
    explain_times times;
    double spent = 0.0;
    uint32_t rounds = 0;
    int code = 0;
    while (code == 0 && rounds < ROUNDS_MOST &&
           (rounds == 0 || spent * (rounds + 1) / rounds < ROUNDS_SPENT)) {
        code = explain_round(job, &times, rounds++, &spent);
    }
    for (int i = 0; i < LRCS_EFFECTS && code == 0; i++) {
        if (is_switched(i)) {
            explain_effect(job, &times, rounds, i, &job->explained.effect[i]);
        }
        if (i == LRCS_EFFECT_TWO_SIDED && job->open.back_area_m2 > 0.0) {
            job->explained.effect[i].sigma_m2 = job->open.back_sigma_m2;
        }
    }
    if (code == 0) {
        explain_stages(&times, rounds, &job->explained);
    }
    job->explained.rounds = rounds;
    job->explained.pose = code == 0 ? cli_median(times.first, rounds) : 0.0;
    return code;
}

/* A value of an effect, or none if a run cannot switch the effect. */
static double where_switched(int effect, double value)
{
    return is_switched(effect) ? value : (double)NAN;
}

void cli_run_explain_json(const run_job *job, int effect, lrcs_host_json *json)
{
    const run_explained_effect *e = &job->explained.effect[effect];
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

/* The change of sigma if the effect is flipped. */
static void sigma_column(const run_job *job, double flipped)
{
    char text[32] = "same";
    double sigma = job->result.sigma_m2;
    if (flipped != sigma && sigma > 0.0) {
        snprintf(text, sizeof text, "%+.3g %%", 100.0 * (flipped - sigma) / sigma);
    } else if (flipped != sigma) {
        snprintf(text, sizeof text, "%+.3g m2", flipped);
    }
    cli_column(text, 14);
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

static void time_columns(const run_job *job, int on, const run_explained_effect *e)
{
    int lost = !(e->seconds > 2.0 * e->scatter);
    double seconds = lost ? fmax(fabs(e->seconds), 2.0 * e->scatter) : e->seconds;
    measure_column(1e3 * seconds, lost, on, "ms", 15);
    measure_column(100.0 * seconds / job->explained.pose, lost, on, "%", 13);
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
    stages_list("pose", pose_stage, job->explained.stage, job->explained.stage_scatter,
                LRCS_HOST_POSE_STAGES);
}

void cli_run_explain_table(const run_job *job)
{
    double pose = 1e3 * job->explained.pose;
    printf(
        "explained    each effect left out in turn, or simulated where it is off: what it takes,\n"
        "             or would take, in brackets; effects overlap; pose %.*f ms, medians of %lu\n",
        decimals(pose), pose, (unsigned long)job->explained.rounds);
    printf("  %-18s %-4s%-15s%-13s%-14s%s\n", "effect", "now", "time", "of the pose",
           "sigma flipped", "why");
    for (int i = 0; i < LRCS_EFFECTS; i++) {
        const lrcs_effect *effect = &job->result.effect[i];
        printf("  %-18s %-4s", lrcs_effect_text(i), effect->on ? "on" : "off");
        if (is_switched(i)) {
            time_columns(job, effect->on, &job->explained.effect[i]);
            sigma_column(job, job->explained.effect[i].sigma_m2);
        } else {
            printf("%-15s%-13s%-14s", "-", "-", "-");
        }
        print_wrapped(effect->reason, WHY_FROM, WHY_TO);
    }
    stages_print(job);
}
