/* SPDX-License-Identifier: MIT */
/* Which stage a command is in, for people at a terminal: a line on stderr from two seconds on,
   renewed each second by a signal, and what a Ctrl-C leaves. It decides what is shown; sweeps have
   a bar of their own. */
#include "cli/cli.h"

#include <signal.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

#define WATCH_AFTER 2 /* s */

/* Read by handlers. */
static const char *volatile watch_stage;
static const lrcs_host_scene *volatile watch_scene;
static volatile sig_atomic_t watch_shown;
static volatile sig_atomic_t watch_seconds;

/* Adds text to a line, as a handler may. */
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

/* "preparing, 3 of 5 stages done, 12 s". */
static void tick(int number)
{
    static const char blank[] = "\r                                                  \r";
    char line[100];
    size_t used = 0;
    const lrcs_host_scene *scene = watch_scene;
    (void)number;
    watch_seconds = watch_seconds == 0 ? WATCH_AFTER : watch_seconds + 1;
    used = line_add(line, used, sizeof line, blank);
    used = line_add(line, used, sizeof line, watch_stage);
    if (scene && !scene->prepared) {
        unsigned done = 0;
        while (done < LRCS_HOST_PREPARE_STAGES && scene->seconds_stage[done] > 0.0) {
            done++;
        }
        used = line_add(line, used, sizeof line, ", ");
        used = line_number(line, used, sizeof line, done);
        used = line_add(line, used, sizeof line, " of 5 stages done");
    }
    used = line_add(line, used, sizeof line, ", ");
    used = line_number(line, used, sizeof line, (unsigned)watch_seconds);
    used = line_add(line, used, sizeof line, " s");
    watch_shown = 1;
    if (write(STDERR_FILENO, line, used) < 0) {
        watch_shown = 0;
    }
}

/* A file appears when it is whole: there is nothing to save. */
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

void cli_watch_begin(void)
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
    _Static_assert(LRCS_HOST_PREPARE_STAGES == 5, "what the line says");
    watch_stage = "loading";
    action.sa_handler = tick;
    sigaction(SIGALRM, &action, NULL);
    timer_set(WATCH_AFTER, 1);
}

void cli_watch_stage(const char *stage, const lrcs_host_scene *scene)
{
    watch_scene = scene;
    watch_stage = stage;
}

void cli_watch_end(void)
{
    timer_set(0, 0);
    watch_scene = NULL;
    if (watch_shown) {
        fprintf(stderr, "\r%50s\r", "");
    }
    watch_shown = 0;
}
