/* SPDX-License-Identifier: MIT */
/* One thing measured in a process of its own, under a time limit. */
#ifndef BENCH_CELL_H
#define BENCH_CELL_H

#include "bench/measure.h"

/* One measurement: times in ms, and the answer of a pose; 0 for each that does not apply. */
typedef struct bench_sample {
    double cpu, wall;
    double bound, estimate; /* of a pose, over its sigma */
    double bytes;           /* of work area */
    double first;           /* cpu, of the same pose in a work area that nothing has been in */
} bench_sample;

/* Measures until it is done, and hands over every sample as soon as it is taken. Returned: a
   status; samples are handed over before it is known. */
typedef void bench_cell_put(void *to, const bench_sample *sample);
typedef int bench_cell_step(void *context, bench_cell_put *put, void *to);

enum bench_cell_end { BENCH_DONE, BENCH_TOO_LONG, BENCH_FAILED };

/* What came out of a cell. */
typedef struct bench_cell {
    bench_sample sample[1 + BENCH_TIMES];
    int count;
    int end; /* bench_cell_end */
} bench_cell;

/* Runs a step in a child process, which is ended after limit_s seconds. The child begins with the
   memory of this process and none of its own, so that its first sample is a first use. */
void bench_cell_run(bench_cell_step *step, void *context, double limit_s, bench_cell *cell);

#endif
