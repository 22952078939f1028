/* SPDX-License-Identifier: MIT */
/* lrcs run --time-budget: the most accurate answer that can be computed in a given time. Settings
   are tried one after the other:
     1. no self-shadowing;
     2. in the order of their expected time (lrcs/sequence.h): rasters of 256, 512 and 1024 pixels,
        with their bound or accepted by their estimate; and clipping, or method auto with the
        tolerance 1e-1 if tolerances change the answer. Rasters are not tried any more after this
        last setting, nor before it if it is expected to take at most a quarter of the time left, or
        half of it once a raster with a bound has been timed: clipping leaves only rounding errors,
        less than any raster;
     3. if tolerances change the answer: method auto with finer ones down to 1e-12, up to the first
        that is missed; one that the answer before it meets is left out.
   The sequence ends when the time is up, when an answer meets the tolerance asked for, or after its
   last setting.

   Claim: every setting of this list that is expected to take less time than the answer's has been
   completed, except for rasters where the answer is that of clipping or of method auto; and the
   error (lrcs_sequence_error) of the answer is the least of all completed ones.

   The first setting runs in this process, because there must be an answer whatever the time. The
   others run in one child process: the library cannot be interrupted, but a process can end itself.

   This file decides which settings are tried; each is an ordinary run, which the same options
   reproduce. */
#include "cli/run/run.h"

#include <lrcs/sequence.h>

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* The tolerances that are tried. */
static const double tolerances[] = {1e-1, 3e-2,  1e-2,  3e-3,  1e-3,  3e-4,  1e-4, 3e-5,
                                    1e-5, 3e-6,  1e-6,  3e-7,  1e-7,  3e-8,  1e-8, 3e-9,
                                    1e-9, 3e-10, 1e-10, 3e-11, 1e-11, 3e-12, 1e-12};

#define TOLERANCES (sizeof tolerances / sizeof tolerances[0])

/* How often the child process looks at the clock, us. */
#define CHILD_TICK 5000

/* An answer on its way to the parent process. Of its pointers the parent uses only those to
   constant texts (the reasons in `result`), which are at the same address in both processes; all
   others refer to memory of the child. */
typedef struct budget_answer {
    lrcs_result result;
    lrcs_run_options options;
    lrcs_build_options build;
    int divided; /* 1: the build has halvings, of which build.halvings is the child's pointer */
    unsigned char halvings[RUN_BUDGET_PARTS]; /* these, unless the scene has more parts */
    double seconds_load, seconds_prepare, seconds_pose;
} budget_answer;

/* When the child has to end, and whose child it is. Only its signal handler (child_tick) reads
   these, which cannot be given anything; child_start writes them once, before the first signal. */
static double child_deadline;
static pid_t child_parent;

/* ---- answers in a pipe ---- */

/* Writes an answer to the pipe or reads one from it, in parts if the pipe takes no more at once.
   Returns 0 if nobody reads, or at the end of the answers; one that the child could not finish does
   not count. */
static int answer_transfer(int answers, int writes, budget_answer *answer)
{
    unsigned char *bytes = (unsigned char *)answer;
    for (size_t done = 0; done < sizeof *answer;) {
        size_t left = sizeof *answer - done;
        ssize_t count =
            writes ? write(answers, bytes + done, left) : read(answers, bytes + done, left);
        if (count > 0) {
            done += (size_t)count;
        } else if (count == 0 || errno != EINTR) {
            return 0;
        }
    }
    return 1;
}

/* ---- settings ---- */

/* Does the tolerance change the answer? */
static int tolerance_matters(const run_job *job)
{
    return lrcs_host_scene_tessellated(&job->scene.scene) ||
           job->scene.scene.normals != LRCS_NORMALS_FLAT;
}

/* Runs one setting, job->options, as lrcs run does: 0, CLI_FAILED or CLI_USAGE. A scene with curved
   shapes is read again, because it depends on the setting. */
static int budget_setting_run(run_job *job, budget_answer *answer)
{
    int code = 0;
    memset(answer, 0, sizeof *answer);
    if (lrcs_host_scene_tessellated(&job->scene.scene)) {
        lrcs_host_scene_free(&job->scene);
        cli_division_set(&job->options, &job->load);
        job->load.build.halvings = NULL;
        code = cli_scene_read(job->args, &job->load, &job->scene);
        code = code ? code : cli_run_divide(job);
    }
    code = code == 0 && !job->scene.prepared ? cli_scene_prepare(&job->scene) : code;
    if (code == 0 && !job->divided) {
        code = cli_scene_run(&job->scene, &job->pose, &job->options, &job->result, NULL, NULL,
                             &job->seconds);
    }
    answer->result = job->result;
    answer->seconds_pose = job->seconds;
    answer->options = job->options;
    answer->build = job->load.build;
    answer->divided = answer->build.halvings != NULL;
    if (answer->divided && job->scene.scene.part_count <= RUN_BUDGET_PARTS) {
        memcpy(answer->halvings, answer->build.halvings, job->scene.scene.part_count);
    }
    answer->seconds_load = job->scene.seconds_load;
    answer->seconds_prepare = job->scene.seconds_prepare;
    return code;
}

/* The same in the child process, which sends the answer. Returns 1 if the sequence goes on: not if
   the run failed, if nobody reads, or if the answer meets the tolerance asked for. */
static int setting_send(run_job *job, int answers, budget_answer *answer)
{
    return budget_setting_run(job, answer) == 0 && answer_transfer(answers, 1, answer) &&
           !cli_run_meets(&answer->result, job->asked);
}

/* The options of a setting of the sequence. */
static lrcs_run_options setting_options(const run_job *job, const lrcs_setting *setting)
{
    lrcs_run_options options = job->options;
    options.method = setting->kind != LRCS_SETTING_LAST ? LRCS_METHOD_ZBUFFER
                     : tolerance_matters(job)           ? LRCS_METHOD_AUTO
                                                        : LRCS_METHOD_EXACT;
    options.resolution = setting->resolution;
    options.accept =
        setting->kind == LRCS_SETTING_SAMPLES ? LRCS_ACCEPT_ESTIMATE : LRCS_ACCEPT_BOUND;
    return options;
}

/* The settings with their forecasts. Without these (no memory) they keep the order of the list. */
static lrcs_sequence sequence_forecast(const run_job *job)
{
    lrcs_sequence sequence = lrcs_sequence_make();
    lrcs_run_options options[LRCS_SEQUENCE_MOST];
    double seconds[LRCS_SEQUENCE_MOST];
    lrcs_host_error error;
    for (int i = 0; i < sequence.count; i++) {
        options[i] = setting_options(job, &sequence.setting[i]);
    }
    if (lrcs_host_scene_forecast(&job->scene, &job->pose, options, (uint32_t)sequence.count,
                                 seconds, &error) == LRCS_OK) {
        for (int i = 0; i < sequence.count; i++) {
            sequence.setting[i].forecast = seconds[i];
        }
    }
    return sequence;
}

/* All settings after the first, as long as each can be completed before the deadline (s, of
   cli_seconds). */
static void settings_run(run_job *job, double deadline, int answers)
{
    const lrcs_run_options plain = job->options;
    lrcs_sequence sequence = sequence_forecast(job);
    budget_answer answer;
    int on = 1, finer = 0;
    double again = 0.0; /* time of reading and preparing the scene again */
    for (int i; on && (i = lrcs_sequence_next(&sequence, deadline - cli_seconds() - again)) >= 0;) {
        job->options = plain;
        job->options = setting_options(job, &sequence.setting[i]);
        on = setting_send(job, answers, &answer);
        lrcs_sequence_done(&sequence, i, answer.seconds_pose,
                           answer.result.method != LRCS_METHOD_ZBUFFER);
        again = lrcs_host_scene_tessellated(&job->scene.scene)
                    ? answer.seconds_load + answer.seconds_prepare
                    : 0.0;
        finer = job->options.method == LRCS_METHOD_AUTO &&
                !(answer.result.flags & LRCS_FLAG_TOLERANCE_NOT_MET);
    }
    for (size_t i = 1; i < TOLERANCES && on && finer; i++) {
        job->options.tolerance = tolerances[i];
        if (!cli_run_meets(&answer.result, tolerances[i])) {
            on = setting_send(job, answers, &answer);
            finer = !(answer.result.flags & LRCS_FLAG_TOLERANCE_NOT_MET);
        }
    }
}

/* ---- the child process ---- */

/* Ends the child when the time is up, or when its parent has ended. */
static void child_tick(int number)
{
    (void)number;
    if (getppid() != child_parent || cli_seconds() >= child_deadline) {
        _exit(0);
    }
}

/* Starts the child process. Returns the read end of the pipe of its answers, or -1. */
static int child_start(run_job *job, pid_t *child)
{
    int end[2];
    if (pipe(end) != 0) {
        return -1;
    }
    const double deadline = job->budget.start + 1e-3 * job->budget.asked_ms;
    const pid_t parent = getpid();
    fflush(NULL); /* otherwise both processes would write the buffered output */
    *child = fork();
    if (*child == 0) {
        const struct itimerval timer = {.it_interval.tv_usec = CHILD_TICK,
                                        .it_value.tv_usec = CHILD_TICK};
        struct sigaction action;
        child_deadline = deadline;
        child_parent = parent;
        memset(&action, 0, sizeof action);
        action.sa_flags = SA_RESTART;
        action.sa_handler = child_tick;
        signal(SIGINT, SIG_DFL); /* the parent reports what remains after a Ctrl-C */
        close(end[0]);
        sigaction(SIGALRM, &action, NULL);
        setitimer(ITIMER_REAL, &timer, NULL);
        settings_run(job, deadline, end[1]);
        _exit(0);
    }
    close(end[1]);
    if (*child < 0) {
        close(end[0]);
        return -1;
    }
    return end[0];
}

/* Is an answer better than the best so far? Of equal answers the first is kept, which costs less;
   but one with a bound is preferred to one that was accepted by its estimate. */
static int answer_is_better(const budget_answer *answer, const budget_answer *best)
{
    double error = lrcs_sequence_error(&answer->result);
    double least = lrcs_sequence_error(&best->result);
    int proved =
        answer->options.accept == LRCS_ACCEPT_BOUND && best->options.accept != LRCS_ACCEPT_BOUND;
    return error < least || (error == least && proved);
}

/* Reads the child's answers until it ends. */
static void budget_answers_read(int answers, pid_t child, budget_answer *best)
{
    budget_answer answer;
    while (answer_transfer(answers, 0, &answer)) {
        if (answer_is_better(&answer, best)) {
            *best = answer;
        }
    }
    close(answers);
    while (waitpid(child, NULL, 0) < 0 && errno == EINTR) {
    }
}

/* ---- the command's part ---- */

int cli_run_meets(const lrcs_result *result, double tolerance)
{
    double most = tolerance * result->sigma_m2;
    return tolerance > 0.0 && result->bound_m2 <= most && result->curvature_estimate_m2 <= most;
}

int cli_run_budget_read(run_job *job)
{
    static const char *const clash[] = {"method", "resolution", "explain", "steps", "accept"};
    const int clashes = sizeof clash / sizeof clash[0];
    const cli_args *args = job->args;
    run_budget *budget = &job->budget;
    budget->start = cli_seconds();
    int code = cli_number(args, "time-budget", &budget->asked_ms);
    if (code != 0 || !cli_value(args, "time-budget")) {
        return code;
    }
    if (!(budget->asked_ms > 0.0)) {
        return cli_expected(args, "time-budget", "milliseconds > 0");
    }
    for (int i = 0; i < clashes; i++) {
        if (cli_value(args, clash[i])) {
            return cli_usage(args->command,
                             "--time-budget chooses the settings itself: leave out --%s", clash[i]);
        }
    }
    return 0;
}

/* Sets the run's options to those of the answer, and its scene to the one that they lead to. */
static int budget_settle(run_job *job, const budget_answer *best)
{
    const lrcs_result *result = &best->result;
    const int named = best->options.method != LRCS_METHOD_AUTO;
    char text[sizeof job->budget.same] = "";
    if (tolerance_matters(job)) {
        lrcs_host_append(text, sizeof text, " --tolerance %g", best->options.tolerance);
    }
    if (named) {
        lrcs_host_append(text, sizeof text, " --method %s%s", lrcs_method_text(result->method),
                         best->options.accept == LRCS_ACCEPT_ESTIMATE ? " --accept estimate" : "");
    }
    if (result->resolution != 0) {
        lrcs_host_append(text, sizeof text, " --resolution %lu", (unsigned long)result->resolution);
    }
    snprintf(job->budget.same, sizeof job->budget.same, "%s", text + 1);
    job->options = best->options;
    job->result = *result;
    free(job->records); /* of the setting that was run last here */
    job->records = NULL;
    if (named) {
        job->result.method_reason = "the best that the time budget reached";
    }
    int code = 0;
    if (lrcs_host_scene_tessellated(&job->scene.scene)) {
        uint32_t parts = job->scene.scene.part_count;
        lrcs_host_scene_free(&job->scene);
        job->divided = 0;
        job->load.build = best->build;
        job->load.build.halvings = NULL;
        if (best->divided && parts <= RUN_BUDGET_PARTS) {
            memcpy(job->halvings, best->halvings, parts);
            job->load.build.halvings = job->halvings;
        }
        code = cli_scene_read(job->args, &job->load, &job->scene);
        code = code == 0 && best->divided && parts > RUN_BUDGET_PARTS ? cli_run_divide(job) : code;
    }
    job->scene.seconds_load = best->seconds_load;
    job->scene.seconds_prepare = best->seconds_prepare;
    job->seconds = best->seconds_pose;
    return code;
}

int cli_run_budget(run_job *job)
{
    budget_answer best;
    pid_t child;
    cli_watch_stage("trying settings", NULL);
    job->options.tolerance =
        tolerance_matters(job) ? tolerances[0] : lrcs_run_options_default().tolerance;
    job->options.method = LRCS_METHOD_FACET;
    int code = budget_setting_run(job, &best);
    if (code != 0) {
        return code;
    }
    int answers = cli_run_meets(&best.result, job->asked) ? -1 : child_start(job, &child);
    if (answers >= 0) {
        budget_answers_read(answers, child, &best);
    }
    job->budget.spent_ms = 1e3 * (cli_seconds() - job->budget.start);
    return budget_settle(job, &best);
}
