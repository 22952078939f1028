/* SPDX-License-Identifier: MIT */
/* lrcs run --time-budget: the most accurate answer that can be computed in a given time. How long a
   setting takes is not known in advance. So two processes run two sequences of settings, in each of
   which a setting takes at least as long as the one before it; one process at a time runs, in turns
   (turns.h). When the time is up, the best of all answers counts, whenever it came.

   Claim: no setting that takes less time than the one that is returned would have been better, but
   for the length of a turn. A raster that is returned: by turns.h all settings of both sequences
   that take less have been completed. A tolerance or clipping that is returned: those that take
   less are before it, and a raster cannot be better, because it has the error of the same mesh and
   that of its samples besides. The exception is a tolerance that was answered by a raster, or whose
   bound says little: then the claim holds for rasters that take less than half of its time.

   This file decides which settings are tried; each is an ordinary run, which the same options
   reproduce. */
#include "cli/run/run.h"
#include "cli/run/turns.h"

#include <errno.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* A bound above this share of sigma says little: beyond it a likely error decides. */
#define BOUND_TELLS 0.1

/* The tolerances that are tried, two per decade: rungs 0 .. 22 are 1e-1, 3e-2, 1e-2, ... 1e-12. */
#define RUNGS     23
#define RUNG_NONE (-1) /* for scenes that no tolerance changes */

/* The sequences: tolerances by the method that suffices (if no tolerance changes anything, clipping
   instead), whose work grows with their digits; and rasters. */
enum budget_chain { CHAIN_SOUGHT, CHAIN_RASTERS, CHAINS };

/* The rasters. One that is accepted by estimate evaluates only its samples, which is a part of the
   work of one with a bound. */
static const struct {
    uint32_t size;
    int accept;
} rasters[] = {{256, LRCS_ACCEPT_ESTIMATE},
               {1024, LRCS_ACCEPT_ESTIMATE},
               {1024, LRCS_ACCEPT_BOUND},
               {4096, LRCS_ACCEPT_BOUND}};

#define RASTERS (sizeof rasters / sizeof rasters[0])

/* The least time of a turn, s: on a busy machine it may take some milliseconds until a process that
   is continued runs. */
#define TURN_LEAST 5e-3

/* The weights: each raster delays a tolerance by at most 5/8 of its time, and a turn. */
static const double chain_weight[CHAINS] = {2.0, 1.0};

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

/* A process that runs a sequence of settings, and the pipe of its answers. */
typedef struct budget_runner {
    pid_t process;
    int end; /* read end of its pipe; negative if the process has ended */
} budget_runner;

/* All of them, and a process that ends them if this one ends before it could. At first only that of
   the tolerances is started, which often needs a single turn. */
typedef struct budget_runners {
    budget_runner one[CHAINS];
    run_sequence sequence[CHAINS];
    int running; /* the one that is not stopped, or -1 */
    int started; /* 1 if all have been started */
    pid_t guard;
    int alive; /* write end of the pipe that the guard reads until its end; negative if none */
} budget_runners;

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

/* Runs one setting; its time is that of the processor, because the process may be stopped in
   between. Status: as lrcs_host_scene_run. */
static int setting_run(run_job *job, int rung, int sought, budget_answer *answer,
                       lrcs_host_error *error)
{
    memset(answer, 0, sizeof *answer);
    clock_t begun = clock();
    int status = lrcs_host_scene_run(&job->scene, &job->pose, &job->options, &answer->result, NULL,
                                     NULL, NULL, error);
    answer->seconds_pose = (double)(clock() - begun) / CLOCKS_PER_SEC;
    answer->rung = rung;
    answer->named = job->options.method != LRCS_METHOD_AUTO;
    answer->sought = sought;
    answer->accept = job->options.accept;
    answer->seconds_load = job->scene.seconds_load;
    answer->seconds_prepare = job->scene.seconds_prepare;
    return status;
}

/* The same in a runner, which reports the answer; 0, or -1 if it failed or the pipe is closed. */
static int setting_report(run_job *job, int rung, int sought, int answers)
{
    budget_answer answer;
    return setting_run(job, rung, sought, &answer, NULL) == LRCS_OK &&
                   write(answers, &answer, sizeof answer) == (ssize_t)sizeof answer
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

static void rasters_run(run_job *job, int rung, int answers)
{
    int over = 0;
    job->options.method = LRCS_METHOD_ZBUFFER;
    for (size_t i = 0; i < RASTERS && over == 0; i++) {
        job->options.resolution = rasters[i].size;
        job->options.accept = rasters[i].accept;
        over = setting_report(job, rung, 0, answers);
    }
}

static void tolerances_run(run_job *job, int rung, int answers)
{
    const int last = rung == RUNG_NONE ? RUNG_NONE : RUNGS - 1;
    const int shapes = cli_has_curved_shapes(&job->scene.scene);
    int over = 0;
    job->options.method = rung == RUNG_NONE ? LRCS_METHOD_EXACT : LRCS_METHOD_AUTO;
    while (over == 0 && rung <= last) {
        job->options.tolerance = rung_tolerance(rung);
        over = setting_report(job, rung, 1, answers);
        rung = shapes ? rung_scene(job, rung + 1) : rung + 1;
    }
}

/* Starts a process; if that fails, its sequence is over. */
static void runner_start(run_job *job, int chain, int rung, budget_runners *all)
{
    budget_runner *runner = &all->one[chain];
    int end[2];
    all->sequence[chain].over = 1;
    if (pipe(end) != 0) {
        return;
    }
    fflush(NULL); /* otherwise both processes would write the buffered output */
    runner->process = fork();
    if (runner->process == 0) {
        signal(SIGINT, SIG_DFL); /* the parent reports what remains after a Ctrl-C */
        close(end[0]);
        if (chain == CHAIN_SOUGHT) {
            tolerances_run(job, rung, end[1]);
        } else {
            rasters_run(job, rung, end[1]);
        }
        _exit(0);
    }
    close(end[1]);
    if (runner->process < 0) {
        close(end[0]);
        return;
    }
    runner->end = end[0];
    all->sequence[chain].over = 0;
}

/* Starts the process that waits for the end of this one and then ends the runners: a stopped
   process would otherwise remain for ever. */
static void guard_start(budget_runners *all)
{
    int end[2];
    all->alive = -1;
    all->guard = pipe(end) == 0 ? fork() : -1;
    if (all->guard == 0) {
        char byte;
        signal(SIGINT, SIG_IGN);
        signal(SIGHUP, SIG_IGN);
        signal(SIGTERM, SIG_IGN);
        close(end[1]);
        while (read(end[0], &byte, 1) < 0 && errno == EINTR) {
        }
        for (int i = 0; i < CHAINS; i++) {
            if (all->one[i].end >= 0) {
                kill(all->one[i].process, SIGKILL);
            }
        }
        _exit(0);
    }
    if (all->guard > 0) {
        close(end[0]);
        all->alive = end[1];
    }
}

static void runners_start(run_job *job, int rung, budget_runners *all)
{
    memset(all, 0, sizeof *all);
    all->alive = -1;
    for (int i = 0; i < CHAINS; i++) {
        all->one[i].end = -1;
        all->sequence[i].weight = chain_weight[i];
    }
    runner_start(job, CHAIN_SOUGHT, rung, all);
    all->running = CHAIN_SOUGHT;
}

/* Starts the process of the rasters, stopped until its first turn. */
static void rasters_start(run_job *job, int rung, budget_runners *all)
{
    runner_start(job, CHAIN_RASTERS, rung, all);
    if (all->one[CHAIN_RASTERS].end >= 0) {
        kill(all->one[CHAIN_RASTERS].process, SIGSTOP);
    }
    guard_start(all);
    all->started = 1;
}

/* ---- in the parent ---- */

static void runner_stop(budget_runners *all, int i)
{
    budget_runner *runner = &all->one[i];
    if (runner->end >= 0) {
        close(runner->end);
        kill(runner->process, SIGKILL);
        waitpid(runner->process, NULL, 0);
        runner->end = -1;
    }
    all->sequence[i].over = 1;
    all->running = all->running == i ? -1 : all->running;
}

/* Ends all processes; the guard first, so that it does not end one that no longer is theirs. */
static void runners_stop(budget_runners *all)
{
    if (all->alive >= 0) {
        kill(all->guard, SIGKILL);
        waitpid(all->guard, NULL, 0);
        close(all->alive);
    }
    for (int i = 0; i < CHAINS; i++) {
        runner_stop(all, i);
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

/* Receives an answer of a runner, and ends the runner if it has none left. An answer that is not
   from a raster and whose bound says something ends the rasters, none of which can be better. 1 if
   an answer came. */
static int answer_take(budget_runners *all, int i, budget_answer *best)
{
    budget_answer answer;
    if (read(all->one[i].end, &answer, sizeof answer) != (ssize_t)sizeof answer) {
        runner_stop(all, i);
        return 0;
    }
    if (i == CHAIN_SOUGHT && answer.result.method != LRCS_METHOD_ZBUFFER &&
        answer_error(&answer) <= BOUND_TELLS * answer.result.sigma_m2) {
        runner_stop(all, CHAIN_RASTERS);
    }
    if (answer_beats(&answer, best)) {
        *best = answer;
    }
    return 1;
}

/* Gives turns until the time is up, no more answers are to come, or one meets the tolerance asked
   for. */
static void runners_watch(run_job *job, int rung, budget_runners *all, budget_answer *best)
{
    int turn;
    while (!cli_run_meets(&best->result, job->asked) && time_left(&job->budget) > 0 &&
           (turn = cli_turn_next(all->sequence, CHAINS)) >= 0) {
        if (turn != all->running) {
            if (!all->started) {
                rasters_start(job, rung, all);
                continue; /* one that could not be started is over */
            }
            if (all->running >= 0) {
                kill(all->one[all->running].process, SIGSTOP);
            }
            kill(all->one[turn].process, SIGCONT);
            all->running = turn;
        }
        struct pollfd wait = {.fd = all->one[turn].end, .events = POLLIN};
        double begun = cli_seconds();
        double length = ceil(1e3 * cli_turn_length(&all->sequence[turn], TURN_LEAST));
        int ready = poll(&wait, 1, (int)fmin(length, time_left(&job->budget)));
        if (ready < 0 && errno != EINTR) { /* EINTR: the signal of the watch */
            break;
        }
        int came = ready > 0 && answer_take(all, turn, best);
        cli_turn_took(&all->sequence[turn], cli_seconds() - begun, came);
    }
    for (int i = 0; i < CHAINS; i++) { /* those that came at the end of a turn */
        struct pollfd wait = {.fd = all->one[i].end, .events = POLLIN};
        if (all->one[i].end >= 0 && poll(&wait, 1, 0) > 0) {
            answer_take(all, i, best);
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
    budget_runners all;
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
    runners_start(job, rung, &all);
    runners_watch(job, rung, &all, &best);
    job->budget.spent_ms = 1e3 * (cli_seconds() - job->budget.start);
    runners_stop(&all);
    return budget_settle(job, &best);
}
