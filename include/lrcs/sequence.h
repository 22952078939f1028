/* SPDX-License-Identifier: MIT */
/* The order in which settings of a run are tried within a time: by expected time. Expected times
   come from a forecast (lrcs_host_scene_forecast), scaled by what has been measured in this run. */
#ifndef LRCS_SEQUENCE_H
#define LRCS_SEQUENCE_H

#include <lrcs/run.h>

#define LRCS_SEQUENCE_MOST 8

enum lrcs_setting_kind {
    LRCS_SETTING_SAMPLES, /* a raster that is accepted by its estimate */
    LRCS_SETTING_PROVED,  /* a raster with its bound */
    LRCS_SETTING_LAST     /* clipping, or method auto: better than every raster */
};

typedef struct lrcs_setting {
    int kind;
    uint32_t resolution;
    double forecast; /* s */
    int done;        /* 1: completed, or not worth trying any more */
} lrcs_setting;

typedef struct lrcs_sequence {
    lrcs_setting setting[LRCS_SEQUENCE_MOST];
    int count;
    double samples_scale; /* measured time of a raster of samples, in times of its forecast */
    double proof_scale;   /* the same for what a raster with a bound takes besides; 0: not known */
} lrcs_sequence;

/* What is tried, without forecasts: rasters of each kind at each resolution, and the
   last setting. */
lrcs_sequence lrcs_sequence_make(void);

/* The setting that is tried next, with `left` seconds to go: the one with the least expected time
   among those not yet done (the first of equal ones), or -1 if there are none. But once the clock
   of this machine is known from a completed setting, the last kind comes before rasters whose
   result it makes needless, if it is expected to take at most a quarter of the time left; or half
   of it, once a raster with a bound has been timed. */
int lrcs_sequence_next(const lrcs_sequence *sequence, double left);

/* Records that a setting took so many seconds. Once the last kind is completed without a fallback
   to a raster (`clipped`), the others are done, too. */
void lrcs_sequence_done(lrcs_sequence *sequence, int setting, double seconds, int clipped);

/* The error by which answers are compared: bound + curvature_estimate. Above a tenth of sigma it
   says little; then the likely error of a raster counts instead, ranked after every bound below a
   tenth and before other bounds. */
double lrcs_sequence_error(const lrcs_result *result);

#endif
