/* SPDX-License-Identifier: MIT */
/* The measurements, one in each row, and their three forms: tables, CSV and a chart. */
#ifndef BENCH_ROWS_H
#define BENCH_ROWS_H

#include "bench/cell.h"

enum { BENCH_ROWS = 1024, BENCH_NAME = 48 };

/* One thing measured of one scene. Times in ms; 0 for those that were not measured. */
typedef struct bench_row {
    char scene[BENCH_NAME], what[BENCH_NAME];
    uint32_t facets, vertices;
    int end;                /* bench_cell_end */
    int samples;            /* that the median is of */
    double ms, low, high;   /* of the processor: median and quartiles; of a peer: on the wall */
    double wall, first;     /* medians: on the wall; of the processor, in fresh memory */
    double bytes;           /* of work area, at most */
    double bound, estimate; /* over sigma, medians */
} bench_row;

typedef struct bench_table {
    bench_row row[BENCH_ROWS];
    uint32_t count;
} bench_table;

/* Adds a row. The first `warm` samples are not of steady use: they count only if there are no
   others. */
const bench_row *bench_row_add(bench_table *table, const char *scene, const lrcs_scene *of,
                               const char *what, const bench_cell *cell, int warm);

/* Markdown: a line for each scene, and if there are peers another one with the ratios to them. */
void bench_table_print(const bench_table *table, double limit_s);

void bench_table_csv(const bench_table *table, FILE *out);

/* Time against facets, every scene a point. SVG. */
void bench_table_chart(const bench_table *table, FILE *out);

#endif
