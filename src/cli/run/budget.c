/* SPDX-License-Identifier: MIT */
/* lrcs run --time-budget: the most accurate answer that can be computed in a given time. Settings
   are run one after another, in the order of the time that they are expected to take. How long a
   setting takes is not known in advance, so a separate process runs them and reports every answer;
   when the time is up, the best of all answers counts, whenever it came, and the running setting is
   stopped. So no setting that comes before it would have been better. This file decides which
   settings are tried; each is an ordinary run, which the same options reproduce. */
#include "cli/run/run.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* A bound above this share of sigma says little: beyond it a likely error decides. */
#define BOUND_TELLS 0.1

/* The tolerances that are tried, two per decade: rungs 0 .. 22 are 1e-1, 3e-2, 1e-2, ... 1e-12. */
#define RUNGS     23
#define RUNG_NONE (-1) /* for scenes that no tolerance changes */

/* The rasters that are tried, in order of cost; those accepted by estimate evaluate only
   samples. */
static const struct {
    uint32_t size;
    int accept;
} rasters[] = {
    {256, LRCS_ACCEPT_ESTIMATE}, {1024, LRCS_ACCEPT_ESTIMATE}, {64, LRCS_ACCEPT_BOUND},
    {128, LRCS_ACCEPT_BOUND},    {256, LRCS_ACCEPT_BOUND},     {512, LRCS_ACCEPT_BOUND},
    {1024, LRCS_ACCEPT_BOUND},   {2048, LRCS_ACCEPT_BOUND},    {4096, LRCS_ACCEPT_BOUND}};

#define RASTERS (sizeof rasters / sizeof rasters[0])

/* An answer on its way to the parent process. Its reasons are constant texts, at the same address
   in both processes. */
typedef struct budget_answer {
    lrcs_result result;
    int rung;
    int named;  /* 1 if the method was specified, not chosen by auto */
    int sought; /* 1 if found by a tolerance or by clipping; of equal answers these are preferred */
    int accept; /* LRCS_ACCEPT_ESTIMATE for a raster that costs no more than drawing it */
    double seconds_load, seconds_prepare, seconds_pose;
} budget_answer;

/* The process that runs settings, and the pipe of its answers. */
typedef struct budget_runner {
    pid_t process;
    int end; /* read end of its pipe; negative if the process has ended */
} budget_runner;

static const char *rung_text(int rung, char text[16])
{
    snprintf(text, 16, "%de-%d", rung % 2 ? 3 : 1, 1 + (rung + 1) / 2);
    return text;
}

static double rung_tolerance(int rung)
{
    char text[16];
    double value = lrcs_run_options_default().tolerance;
    if (rung == RUNG_NONE) {
        return value;
    }
    rung_text(rung, text);
    lrcs_host_number_read(text, strlen(text), &value);
    return value;
}

/* ---- settings ---- */

/* Runs one setting. Status: as lrcs_host_scene_run. */
static int setting_run(run_job *job, int rung, int sought, budget_answer *answer,
                       lrcs_host_error *error)
{
    memset(answer, 0, sizeof *answer);
    int status = lrcs_host_scene_run(&job->scene, &job->pose, &job->options, &answer->result, NULL,
                                     NULL, &answer->seconds_pose, error);
    answer->rung = rung;
    answer->named = job->options.method != LRCS_METHOD_AUTO;
    answer->sought = sought;
    answer->accept = job->options.accept;
    answer->seconds_load = job->scene.seconds_load;
    answer->seconds_prepare = job->scene.seconds_prepare;
    return status;
}

/* The same in the runner, which reports the answer; 0, or -1 if it failed or the pipe is closed. */
static int setting_report(run_job *job, int rung, int sought, int answers, double *seconds)
{
    budget_answer answer;
    int status = setting_run(job, rung, sought, &answer, NULL);
    *seconds = answer.seconds_pose;
    return status == LRCS_OK && write(answers, &answer, sizeof answer) == (ssize_t)sizeof answer
               ? 0
               : -1;
}

/* Reads the scene with its shapes built for finer and finer rungs, starting with this one, until
   the mesh differs from the last one, and prepares it. Returns its rung; RUNGS if there is none. */
static int rung_scene(run_job *job, int rung)
{
    lrcs_host_error error;
    uint64_t last = lrcs_scene_hash(&job->scene.scene);
    for (; rung < RUNGS; rung++) {
        lrcs_host_scene_free(&job->scene);
        job->load.build.tolerance = rung_tolerance(rung);
        if (lrcs_host_scene_read(job->args->operand, &job->load, &job->scene, &error) != LRCS_OK) {
            return RUNGS;
        }
        if (lrcs_scene_hash(&job->scene.scene) != last) {
            break;
        }
    }
    return rung < RUNGS && lrcs_host_scene_prepare(&job->scene, &error) == LRCS_OK ? rung : RUNGS;
}

/* Runs settings in the order of their expected times: rasters, and tolerances by the method that
   suffices; if no tolerance changes anything, clipping instead. The first tolerance is expected to
   take as long as the scene took to prepare, and rasters come before it as long as they take less.
   The time of the next raster is expected to grow in proportion to its pixels per row, because part
   of the time depends on the facets. Once a tolerance has an answer, rasters of the same mesh
   cannot improve it. */
static void settings_run(run_job *job, int rung, int answers)
{
    const int last = rung == RUNG_NONE ? RUNG_NONE : RUNGS - 1;
    const int shapes = cli_has_curved_shapes(&job->scene.scene);
    const double prepare = job->scene.seconds_prepare;
    double expected = 0.0; /* time of the next raster */
    double seconds;
    int over = 0;
    job->options.method = LRCS_METHOD_ZBUFFER;
    for (size_t i = 0; i < RASTERS && over == 0 && expected <= prepare; i++) {
        job->options.resolution = rasters[i].size;
        job->options.accept = rasters[i].accept;
        over = setting_report(job, rung, 0, answers, &seconds);
        double times = i + 1 < RASTERS ? (double)rasters[i + 1].size / rasters[i].size : 1.0;
        expected = seconds * fmax(times, 1.0);
    }
    job->options.method = rung == RUNG_NONE ? LRCS_METHOD_EXACT : LRCS_METHOD_AUTO;
    job->options.resolution = 0;
    job->options.accept = LRCS_ACCEPT_BOUND;
    while (over == 0 && rung <= last) {
        job->options.tolerance = rung_tolerance(rung);
        over = setting_report(job, rung, 1, answers, &seconds);
        rung = shapes ? rung_scene(job, rung + 1) : rung + 1;
    }
}

/* Starts the process; if that fails, it counts as ended. */
static void runner_start(run_job *job, int rung, budget_runner *runner)
{
    int end[2];
    *runner = (budget_runner){.end = -1};
    if (pipe(end) != 0) {
        return;
    }
    runner->process = fork();
    if (runner->process == 0) {
        signal(SIGINT, SIG_DFL); /* the parent reports what remains after a Ctrl-C */
        close(end[0]);
        settings_run(job, rung, end[1]);
        _exit(0);
    }
    close(end[1]);
    if (runner->process < 0) {
        close(end[0]);
        return;
    }
    runner->end = end[0];
}

/* ---- in the parent ---- */

static void runner_stop(budget_runner *runner)
{
    if (runner->end >= 0) {
        close(runner->end);
        kill(runner->process, SIGKILL);
        waitpid(runner->process, NULL, 0);
        runner->end = -1;
    }
}

/* The error that an answer may have: its bound, and the contribution of curved normals. If that
   says little, the likely error of a raster instead, ranked after every informative bound and
   before the others. */
static double answer_error(const budget_answer *answer)
{
    const lrcs_result *r = &answer->result;
    double bound = r->bound_m2 + fmax(0.0, r->curvature_estimate_m2);
    double tells = BOUND_TELLS * r->sigma_m2;
    return bound > tells && r->estimate_m2 >= 0.0 ? fmin(bound, tells + r->estimate_m2) : bound;
}

/* Is an answer better than the best so far? Errors within a thousandth of each other count as
   equal: of these an answer found by a tolerance or by clipping is preferred. Therefore the best of
   any sequence has at most 1.001 times its least error: an answer that is not sought is best only
   if its error is the least so far, and what replaces it as equal is replaced only by less. */
static int answer_beats(const budget_answer *answer, const budget_answer *best)
{
    const double alike = 1.001;
    double error = answer_error(answer);
    double least = answer_error(best);
    if (answer->sought != best->sought) {
        return answer->sought ? error <= alike * least : alike * error < least;
    }
    return error < least;
}

/* Milliseconds left, as a time-out for poll. */
static int time_left(const run_budget *budget)
{
    double left = budget->asked_ms - 1e3 * (cli_seconds() - budget->start);
    return left > 1e9 ? 1000000000 : left > 0.0 ? (int)ceil(left) : 0;
}

/* Receives answers until the time is up, no more are to come, or one meets the tolerance asked
   for. */
static void runner_watch(run_job *job, const budget_runner *runner, budget_answer *best)
{
    while (!cli_run_meets(&best->result, job->asked)) {
        struct pollfd wait = {.fd = runner->end, .events = POLLIN};
        int ready = poll(&wait, 1, time_left(&job->budget));
        if (ready < 0 && errno == EINTR) {
            continue; /* interrupted by the signal of the watch */
        }
        budget_answer answer;
        if (ready <= 0 || read(runner->end, &answer, sizeof answer) != (ssize_t)sizeof answer) {
            break;
        }
        if (answer_beats(&answer, best)) {
            *best = answer;
        }
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
        return cli_usage(args->command, "--time-budget: expected milliseconds > 0, found '%s'",
                         cli_value(args, "time-budget"));
    }
    for (int i = 0; i < clashes; i++) {
        if (cli_value(args, clash[i])) {
            return cli_usage(args->command, "--time-budget chooses for itself: leave out --%s",
                             clash[i]);
        }
    }
    job->asked = cli_value(args, "tolerance") ? job->asked : 0.0;
    job->load.build.tolerance = rung_tolerance(0);
    return 0;
}

/* Sets the run's options to those of the answer, and its scene to the one that they lead to. */
static int budget_settle(run_job *job, const budget_answer *best)
{
    char *same = job->budget.same;
    size_t room = sizeof job->budget.same;
    int used = 0;
    int code = 0;
    if (best->rung != RUNG_NONE) {
        char tolerance[16];
        used = snprintf(same, room, "--tolerance %s", rung_text(best->rung, tolerance));
    }
    if (best->named) {
        used += snprintf(same + used, room - (size_t)used, "%s--method %s", used ? " " : "",
                         lrcs_method_text(best->result.method));
        if (best->accept == LRCS_ACCEPT_ESTIMATE) {
            used += snprintf(same + used, room - (size_t)used, " --accept estimate");
        }
        job->options.accept = best->accept;
        job->options.method = best->result.method;
        job->options.resolution = best->result.resolution;
    }
    if (best->result.resolution != 0) {
        snprintf(same + used, room - (size_t)used, " --resolution %lu",
                 (unsigned long)best->result.resolution);
    }
    job->options.tolerance = rung_tolerance(best->rung);
    if (best->rung > 0 && cli_has_curved_shapes(&job->scene.scene)) {
        lrcs_host_scene_free(&job->scene);
        job->load.build.tolerance = job->options.tolerance;
        code = cli_scene_read(job->args, &job->load, &job->scene);
    }
    job->result = best->result;
    if (best->named) {
        job->result.method_reason = "the best that the time budget reached";
    }
    job->scene.seconds_load = best->seconds_load;
    job->scene.seconds_prepare = best->seconds_prepare;
    job->seconds = best->seconds_pose;
    return code;
}

int cli_run_budget(run_job *job)
{
    lrcs_host_error error;
    budget_answer best;
    budget_runner runner;
    int scales =
        cli_has_curved_shapes(&job->scene.scene) || job->scene.scene.normals != LRCS_NORMALS_FLAT;
    int rung = scales ? 0 : RUNG_NONE;
    if (lrcs_host_scene_prepare(&job->scene, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    cli_watch_stage("trying settings", NULL);
    job->options.method = LRCS_METHOD_FACET; /* whatever the budget, there is this answer */
    if (setting_run(job, rung, 0, &best, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    job->options.method = LRCS_METHOD_AUTO;
    fflush(NULL); /* otherwise both processes would write the buffered output */
    runner_start(job, rung, &runner);
    if (runner.end >= 0) {
        runner_watch(job, &runner, &best);
    }
    job->budget.spent_ms = 1e3 * (cli_seconds() - job->budget.start);
    runner_stop(&runner);
    return budget_settle(job, &best);
}
