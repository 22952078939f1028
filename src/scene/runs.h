/* SPDX-License-Identifier: MIT */
/* Runs of a few facets that follow one another in the scene: files mostly list neighbours so. What
   holds of a run in all directions lets a view treat its facets together. */
#ifndef LRCSI_RUNS_H
#define LRCSI_RUNS_H

#include <lrcs/run.h>

#include <stdint.h>

/* Run r has the facets LRCSI_RUN r .. LRCSI_RUN (r + 1) - 1, the last perhaps fewer. */
#define LRCSI_RUN 16u

typedef struct lrcsi_run {
    double low[3], high[3]; /* the box around its facets, but for those always redundant */
    uint32_t first_side;
    int touched; /* some facet has contacts, or is a rim (mesh/intersection.h) */
} lrcsi_run;

/* A side of a facet of a run across which (scene/across.h) there is a facet of another run, which
   comes earlier; or none; or one across which there is not this facet. */
typedef struct lrcsi_run_side {
    uint32_t facet, other;
    uint32_t edge; /* of the topology */
} lrcsi_run_side;

typedef struct lrcsi_runs {
    lrcsi_run *run; /* one more than there are, for its first_side */
    uint32_t count;
    unsigned char *first; /* facet: the first facet, counted from that of the run, of those joined
                             with it across sides within the run */
    lrcsi_run_side *side; /* those of run r: side[run[r].first_side .. run[r + 1].first_side) */
} lrcsi_runs;

static inline uint32_t lrcsi_runs_count(uint32_t facet_count)
{
    return facet_count / LRCSI_RUN + (facet_count % LRCSI_RUN != 0);
}

/* The end of a run that starts at a facet. */
static inline uint32_t lrcsi_run_end(uint32_t start, uint32_t facet_count)
{
    return facet_count - start < LRCSI_RUN ? facet_count : start + LRCSI_RUN;
}

size_t lrcsi_runs_need(uint32_t facet_count);

/* Given a scene whose edges, neighbours and contacts are prepared. Status: LRCS_OK; LRCS_E_MEMORY.
   The result stays in the work area. Linear time. */
int lrcsi_runs_make(const lrcs_prepared *prepared, lrcs_work *work, lrcsi_runs *runs);

#endif
