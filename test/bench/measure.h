/* SPDX-License-Identifier: MIT */
/* What the benchmarks share: the clock, medians, directions, and which machine this is. */
#ifndef BENCH_MEASURE_H
#define BENCH_MEASURE_H

#include <lrcs/lrcs.h>

#include <stdio.h>

/* The number of directions of a measurement, and how often it is repeated at most. */
enum { BENCH_DIRECTIONS = 9, BENCH_TIMES = 27 };

/* Repeated measurements of one time, in ms. */
typedef struct bench_times {
    double ms[BENCH_TIMES];
    int count;
} bench_times;

/* The time below which this share of the measurements lies: 0.5 for the median. 0 if there are
   none. */
double bench_quantile(bench_times *times, double share);

/* The processor time of this process so far, and the wall-clock time. */
double bench_now_ms(void);
double bench_wall_ms(void);
void bench_add(bench_times *times, double ms);

/* Ends the program unless the status is LRCS_OK. */
void bench_check(int status, const char *what);

/* Allocates memory; ends the program if there is none. */
void *bench_memory(size_t size);

/* Pose number `direction` of BENCH_DIRECTIONS, spread evenly over the sphere, none along an axis;
   the programs of peers.h use the same ones. */
lrcs_pose bench_pose(int direction);

/* Processor, compiler, flags, date and load, a line each. */
void bench_machine(FILE *out, const char *prefix);

#endif
