/* SPDX-License-Identifier: MIT */
/* Shows the stage of a command at a terminal: a line on stderr after two seconds, renewed each
   second by a signal, and a message about what remains after a Ctrl-C. This file decides what is
   shown; commands that compute many poses have a progress bar of their own. */
#include "cli/cli.h"

#include <math.h>
#include <signal.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

#define WATCH_AFTER     2   /* s */
#define PROGRESS_PERIOD 0.2 /* s */
#define PROGRESS_BAR    30

/* Read by signal handlers. */
static const char *volatile watch_stage;
static const lrcs_host_scene *volatile watch_scene;
static volatile sig_atomic_t watch_shown;
static volatile sig_atomic_t watch_seconds;
static volatile sig_atomic_t watch_running; /* 1 while a pose runs, which reports its progress */
static volatile unsigned watch_done, watch_total;
static lrcs_progress watch_progress;

static const char watch_blank[] =
    "\r                                                                      \r";

/* Appends text to a line, with operations that a signal handler may use. */
static size_t line_add(char *line, size_t used, size_t room, const char *text)
{
    while (*text && used < room) {
        line[used++] = *text++;
    }
    return used;
}

static size_t line_number(char *line, size_t used, size_t room, unsigned number)
{
    char digits[12];
    size_t at = sizeof digits - 1;
    digits[at] = '\0';
    do {
        digits[--at] = (char)('0' + number % 10);
        number /= 10;
    } while (number > 0);
    return line_add(line, used, room, digits + at);
}

static size_t line_of(char *line, size_t used, size_t room, unsigned done, unsigned total)
{
    used = line_add(line, used, room, ", ");
    used = line_number(line, used, room, done);
    used = line_add(line, used, room, " of ");
    return line_number(line, used, room, total);
}

/* "preparing, 3 of 5 stages done, 12 s"; "pose: visibility, 41 %, 12 s". */
static void tick(int number)
{
    char line[160];
    size_t used = 0;
    const lrcs_host_scene *scene = watch_scene;
    const char *stage = watch_stage;
    const char *part = lrcs_progress_text((int)watch_progress.stage);
    unsigned total = watch_progress.total;
    (void)number;
    watch_seconds = watch_seconds == 0 ? WATCH_AFTER : watch_seconds + 1;
    if (!stage) {
        return;
    }
    used = line_add(line, used, sizeof line, watch_blank);
    used = line_add(line, used, sizeof line, stage);
    if (watch_total > 0) {
        used = line_of(line, used, sizeof line, watch_done, watch_total);
    }
    if (scene && !scene->prepared) {
        unsigned done = 0;
        while (done < LRCS_HOST_PREPARE_STAGES && scene->seconds_stage[done] > 0.0) {
            done++;
        }
        used = line_of(line, used, sizeof line, done, LRCS_HOST_PREPARE_STAGES);
        used = line_add(line, used, sizeof line, " stages done");
    } else if (watch_running && part) {
        used = line_add(line, used, sizeof line, ": ");
        used = line_add(line, used, sizeof line, part);
        if (total > 0) {
            used = line_add(line, used, sizeof line, ", ");
            used = line_number(line, used, sizeof line,
                               (unsigned)(100.0 * watch_progress.done / total));
            used = line_add(line, used, sizeof line, " %");
        }
    }
    used = line_add(line, used, sizeof line, ", ");
    used = line_number(line, used, sizeof line, (unsigned)watch_seconds);
    used = line_add(line, used, sizeof line, " s");
    watch_shown = write(STDERR_FILENO, line, used) >= 0;
}

/* A file appears only when it is complete: nothing has to be saved. */
static void stopped(int number)
{
    static const char text[] = "\nlrcs: stopped: outputs that were complete are kept, none is half "
                               "written\n";
    if (write(STDERR_FILENO, text, sizeof text - 1) < 0) {
        watch_shown = 0;
    }
    signal(number, SIG_DFL);
    raise(number);
}

static void timer_set(int first, int period)
{
    struct itimerval timer = {.it_interval.tv_sec = period, .it_value.tv_sec = first};
    setitimer(ITIMER_REAL, &timer, NULL);
}

void cli_watch_begin(const char *stage)
{
    struct sigaction action;
    struct sigaction before;
    memset(&action, 0, sizeof action);
    action.sa_flags = SA_RESTART;
    action.sa_handler = stopped;
    if (sigaction(SIGINT, NULL, &before) == 0 && before.sa_handler != SIG_IGN) {
        sigaction(SIGINT, &action, NULL);
    }
    if (!isatty(STDERR_FILENO)) {
        return;
    }
    watch_stage = stage;
    action.sa_handler = tick;
    sigaction(SIGALRM, &action, NULL);
    timer_set(WATCH_AFTER, 1);
}

/* Clears the line, because something else is printed on the terminal. */
void cli_watch_clear(void)
{
    if (watch_shown) {
        fputs(watch_blank, stderr);
        fflush(stderr);
    }
    watch_shown = 0;
}

void cli_watch_stage(const char *stage, const lrcs_host_scene *scene)
{
    watch_stage = NULL; /* a handler shows nothing until all are set */
    watch_done = watch_total = 0;
    watch_running = 0;
    watch_scene = scene;
    watch_stage = stage;
    if (!stage) {
        cli_watch_clear();
    }
}

void cli_watch_count(uint64_t done, uint64_t total)
{
    watch_done = (unsigned)done;
    watch_total = (unsigned)total;
}

lrcs_progress *cli_watch_run(void)
{
    watch_progress.stage = LRCS_PROGRESS_VIEW;
    watch_progress.total = 0;
    watch_running = 1;
    return &watch_progress;
}

void cli_watch_end(void)
{
    if (watch_stage) {
        timer_set(0, 0);
    }
    cli_watch_stage(NULL, NULL);
}

/* ---- the progress bar ---- */

cli_progress cli_progress_make(uint64_t first, uint64_t total)
{
    double now = cli_seconds();
    cli_watch_stage(NULL, NULL); /* the progress bar replaces it */
    int on = isatty(STDERR_FILENO) && first < total;
    if (on) { /* the first pose may take long */
        fprintf(stderr, "\r[%*s] %3.0f %%  %llu of %llu ", PROGRESS_BAR, "",
                100.0 * (double)first / (double)total, (unsigned long long)first,
                (unsigned long long)total);
        fflush(stderr);
    }
    return (cli_progress){on, first, total, now, now};
}

void cli_progress_show(cli_progress *progress, uint64_t done)
{
    double now = progress->on ? cli_seconds() : 0.0;
    if (!progress->on || now - progress->shown < PROGRESS_PERIOD || done <= progress->first) {
        return;
    }
    progress->shown = now;
    double share = (double)done / (double)progress->total;
    double left = (now - progress->begun) * (double)(progress->total - done) /
                  (double)(done - progress->first);
    int filled = (int)(share * PROGRESS_BAR);
    fprintf(stderr, "\r[%.*s%*s] %3.0f %%  %llu of %llu, %.0f:%02d:%02d left ", filled,
            "##############################", PROGRESS_BAR - filled, "", 100.0 * share,
            (unsigned long long)done, (unsigned long long)progress->total, floor(left / 3600.0),
            (int)(fmod(left, 3600.0) / 60.0), (int)fmod(left, 60.0));
    fflush(stderr);
}

void cli_progress_clear(const cli_progress *progress)
{
    if (progress->on) {
        fprintf(stderr, "\r%79s\r", "");
    }
}
