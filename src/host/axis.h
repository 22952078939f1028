/* SPDX-License-Identifier: MIT */
/* An axis of a chart: its range, its ticks, and where a value lies on it. */
#ifndef LRCSI_HOST_AXIS_H
#define LRCSI_HOST_AXIS_H

#include <stdint.h>

#define LRCSI_AXIS_TICKS 256u

/* The values that an axis can show: a logarithmic one from LEAST, a linear one from -MOST. */
#define LRCSI_AXIS_LEAST 1e-290
#define LRCSI_AXIS_MOST  1e290

typedef struct lrcsi_tick {
    double value;
    int major;      /* has a text */
    char text[48];  /* "0.5"; "10" if `raised` is its exponent */
    char raised[8]; /* "-6", or "" */
} lrcsi_tick;

typedef struct lrcsi_axis {
    int log; /* decades instead of equal steps */
    double least, most;
    uint32_t count;
    lrcsi_tick tick[LRCSI_AXIS_TICKS]; /* ascending, least and most among them */
} lrcsi_axis;

enum lrcsi_axis_kind { LRCSI_AXIS_LINEAR, LRCSI_AXIS_LOG, LRCSI_AXIS_DEG };

/* The axis that covers least .. most in round numbers, with at most about `texts` labels. If there
   is no such range it covers 0 .. 1, or 0.1 .. 1. */
lrcsi_axis lrcsi_axis_make(int kind, double least, double most, double texts);

/* The position of a value: 0 at `least`, 1 at `most`, outside 0 .. 1 beyond them; -HUGE_VAL if it
   has no logarithm. */
double lrcsi_axis_at(const lrcsi_axis *axis, double value);

#endif
