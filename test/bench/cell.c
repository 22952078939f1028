/* SPDX-License-Identifier: MIT */
/* Measurements in child processes: one that takes too long is ended, and the benchmark goes on.
   This file does not decide what is measured. */
#include "bench/cell.h"

#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

/* A sample is smaller than PIPE_BUF: it is written whole. */
static void sample_put(void *to, const bench_sample *sample)
{
    if (write(*(int *)to, sample, sizeof *sample) != (ssize_t)sizeof *sample) {
        _exit(1);
    }
}

/* Reads samples until the child ends its side of the pipe (1), or the time is up (0). */
static int samples_read(int from, double limit_s, bench_cell *cell)
{
    double end = bench_wall_ms() + 1e3 * limit_s;
    for (;;) {
        bench_sample sample;
        double left = end - bench_wall_ms();
        struct pollfd ready = {.fd = from, .events = POLLIN};
        if (!(left > 0) || poll(&ready, 1, 1 + (int)left) <= 0) {
            return 0;
        }
        if (read(from, &sample, sizeof sample) != (ssize_t)sizeof sample) {
            return 1;
        }
        if (cell->count < 1 + BENCH_TIMES) {
            cell->sample[cell->count++] = sample;
        }
    }
}

void bench_cell_run(bench_cell_step *step, void *context, double limit_s, bench_cell *cell)
{
    int ends[2];
    int state = 0;
    *cell = (bench_cell){.end = BENCH_FAILED};
    fflush(NULL);
    if (pipe(ends) != 0) {
        return;
    }
    pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        _exit(step(context, sample_put, &ends[1]) == LRCS_OK ? 0 : 1);
    }
    close(ends[1]);
    if (child > 0) {
        int finished = samples_read(ends[0], limit_s, cell);
        if (!finished) {
            kill(child, SIGKILL);
        }
        waitpid(child, &state, 0);
        cell->end = !finished                                     ? BENCH_TOO_LONG
                    : WIFEXITED(state) && WEXITSTATUS(state) == 0 ? BENCH_DONE
                                                                  : BENCH_FAILED;
    }
    close(ends[0]);
}
