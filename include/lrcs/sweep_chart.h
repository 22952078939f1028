/* SPDX-License-Identifier: MIT */
/* Draws sweeps, by their rows: curves, polar diagrams, maps. */
#ifndef LRCS_SWEEP_CHART_H
#define LRCS_SWEEP_CHART_H

#include <lrcs/rows.h>

/* The most curves of a chart: more values than this along both axes make a map. */
#define LRCS_HOST_SWEEP_CURVES 7u

/* One of the quantities that vary. */
typedef struct lrcs_host_sweep_axis {
    uint32_t column; /* column of the plan; the one after its axes is the time of a track */
    uint64_t count;
    const char *name;
} lrcs_host_sweep_axis;

/* What is drawn of a sweep: curves along x, one for each value of y, or a map. */
typedef struct lrcs_host_sweep_chart {
    /* given */
    const lrcs_host_plan *plan;
    const lrcs_host_rows_head *head; /* what it was made from; NULL: not stated */
    double (*row)[2];                /* sigma and bound of every row, m2 */
    double (*band)[2];     /* the interval of its material uncertainty, m2; NULL if there is none */
    const char *title;     /* the scene's, or the name of its file */
    const char *name;      /* in the legend, of all curves, or NULL */
    const char *accept;    /* lrcs_accept_text, or NULL */
    int materials_assumed; /* 1 if some are illustrative or assumed: bounds exclude their error */
    int dbsm, polar, mollweide; /* decibels; curves about a pole; a map in that projection */
    /* chosen */
    lrcs_host_sweep_axis x, y; /* y: a single value if only one quantity varies */
    int map;
    int swapped; /* 1 if x is the faster of two axes */
} lrcs_host_sweep_chart;

/* Chooses x, y, map and swapped by plan, polar and mollweide. Returns how many quantities vary. The
   same with a check that the plan can be drawn so: LRCS_OK; LRCS_E_ARGUMENT: the sentence names an
   option of lrcs sweep, without the dashes before it. */
uint32_t lrcs_host_sweep_chart_choose(lrcs_host_sweep_chart *chart);
int lrcs_host_sweep_chart_check(lrcs_host_sweep_chart *chart, lrcs_host_error *error);

/* Draws one sweep, or the curves of up to LRCS_HOST_SWEEP_CURVES sweeps along the same axis, as SVG
   or PNG. Status: LRCS_OK; LRCS_E_SYSTEM. */
int lrcs_host_sweep_chart_write(FILE *out, const lrcs_host_sweep_chart *chart, uint32_t count,
                                int png, lrcs_host_error *error);

/* The material uncertainty of a sweep that has bands: the median and the largest half width of its
   band relative to sigma, over the rows with sigma > 0 (0 if there is none). Status: LRCS_OK;
   LRCS_E_SYSTEM. */
int lrcs_host_sweep_chart_band(const lrcs_host_sweep_chart *chart, double part[2],
                               lrcs_host_error *error);

#endif
