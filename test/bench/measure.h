/* SPDX-License-Identifier: MIT */
/* What the benchmarks share: the clock, medians, directions, and which machine this is. */
#ifndef BENCH_MEASURE_H
#define BENCH_MEASURE_H

#include <lrcs/lrcs.h>

#include <stdio.h>

/* Directions a measurement is spread over, and times it may be taken at most. */
enum { BENCH_DIRECTIONS = 9, BENCH_TIMES = 27 };

/* Times taken of one thing, in ms. */
typedef struct bench_times {
    double ms[BENCH_TIMES];
    int count;
} bench_times;

/* A share of sorted times lies below: 0.5 for the median. 0 where nothing was measured. */
double bench_quantile(bench_times *times, double share);

/* The processor's time of this process so far, and the time of the clock on the wall. */
double bench_now_ms(void);
double bench_wall_ms(void);
void bench_add(bench_times *times, double ms);

/* Ends the program unless the status is LRCS_OK. */
void bench_check(int status, const char *what);

/* Memory, or the end of the program. */
void *bench_memory(size_t size);

/* Pose number `direction` of BENCH_DIRECTIONS, spread evenly over the sphere, none along an axis;
   the programs of peers.h use the same ones. */
lrcs_pose bench_pose(int direction);

/* Processor, compiler, flags, date and load, a line each. */
void bench_machine(FILE *out, const char *prefix);

#endif
