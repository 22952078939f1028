/* SPDX-License-Identifier: MIT */
/* The stages of a pose, measured one by one. This is the one place where the benchmarks know of the
   engine's insides. */
#ifndef BENCH_STAGES_H
#define BENCH_STAGES_H

#include "bench/measure.h"

enum bench_stage {
    BENCH_CULL,
    BENCH_CONTEST,
    BENCH_RASTER, /* at BENCH_RASTERS sizes from 512 on */
    BENCH_AREAS = BENCH_RASTER + 4,
    BENCH_EXACT = BENCH_AREAS + 4,
    BENCH_SUM,
    BENCH_STAGES
};
enum { BENCH_RASTERS = 4 };

static inline uint32_t bench_raster_size(int raster)
{
    return 512u << raster;
}

typedef struct bench_stages {
    bench_times times[BENCH_STAGES];
    size_t bytes[BENCH_STAGES]; /* of work area, the most seen */
    uint64_t contested;         /* facets, all poses together */
    int poses;
} bench_stages;

/* Takes one more time of every stage, from a pose; `rasters` sizes of rasters. */
void bench_stages_run(const lrcs_prepared *prepared, const lrcs_pose *pose, int rasters,
                      lrcs_work *work, bench_stages *stages);

#endif
