/* SPDX-License-Identifier: MIT */
/* What was measured, a row each, and its three forms: tables, CSV and a chart. */
#ifndef BENCH_ROWS_H
#define BENCH_ROWS_H

#include "bench/measure.h"

enum { BENCH_ROWS = 1024, BENCH_NAME = 48 };

/* A stage or a whole pose of one scene. Times in ms; 0 for what there is none of. */
typedef struct bench_row {
    char scene[BENCH_NAME], stage[BENCH_NAME];
    uint32_t facets, vertices;
    uint64_t pixels;      /* of the raster */
    double ms, low, high; /* median and quartiles */
    size_t bytes;         /* of work area */
    double limit;         /* what memory alone would take: the mesh read, the frame written */
    double target;        /* what DESIGN.md asks for */
} bench_row;

typedef struct bench_table {
    bench_row row[BENCH_ROWS];
    uint32_t count;
} bench_table;

/* Adds a row of the scene of the last one. Returned: the row, for what else it has. */
bench_row *bench_row_add(bench_table *table, const char *scene, const lrcs_scene *of,
                         const char *stage, bench_times *times);

/* Markdown: all stages of the scene whose rows start at `first`; and one line a scene of whole
   poses, with targets. */
void bench_table_scene(const bench_table *table, uint32_t first);
void bench_table_poses(const bench_table *table);

void bench_table_csv(const bench_table *table, FILE *out);

/* Time against facets: poses and stages of the scenes whose name is `made` and a number, the facet
   pose of those named `convex`. SVG. */
void bench_table_chart(const bench_table *table, const char *made, const char *convex, FILE *out);

#endif
