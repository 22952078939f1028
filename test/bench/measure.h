/* SPDX-License-Identifier: MIT */
/* What the benchmarks share: the clock, medians, directions, the limits that memory alone sets, and
   which machine this is. */
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

/* The processor's time so far. */
double bench_now_ms(void);
void bench_add(bench_times *times, double ms);

/* Ends the program unless the status is LRCS_OK. */
void bench_check(int status, const char *what);

/* Memory, or the end of the program. */
void *bench_memory(size_t size);

/* Directions all around, none of them special. */
lrcs_pose bench_pose(int direction);

/* The limits: each byte of the mesh (corners' coordinates and indices) read once, in order; a frame
   of size x size pixels (a double and a facet's number each) written once. */
double bench_read_mesh(const lrcs_scene *scene);
double bench_write_frame(uint32_t size, void *frame);
size_t bench_frame_bytes(uint32_t size);

/* Processor, compiler, flags, date and load, a line each. */
void bench_machine(FILE *out, const char *prefix);

#endif
