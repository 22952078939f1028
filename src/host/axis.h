/* SPDX-License-Identifier: MIT */
/* An axis of a chart: its range, its ticks, and where a value lies on it. */
#ifndef LRCSI_HOST_AXIS_H
#define LRCSI_HOST_AXIS_H

#include <stdint.h>

#define LRCSI_AXIS_TICKS 256u

/* What an axis can show: a logarithmic one from LEAST on, a linear one from -MOST on. */
#define LRCSI_AXIS_LEAST 1e-290
#define LRCSI_AXIS_MOST  1e290

typedef struct lrcsi_tick {
    double value;
    int major;      /* has a text */
    char text[48];  /* "0.5"; "10" where `raised` is its exponent */
    char raised[8]; /* "-6", or "" */
} lrcsi_tick;

typedef struct lrcsi_axis {
    int log; /* decades instead of equal steps */
    double least, most;
    uint32_t count;
    lrcsi_tick tick[LRCSI_AXIS_TICKS]; /* ascending, least and most among them */
} lrcsi_axis;

enum lrcsi_axis_kind { LRCSI_AXIS_LINEAR, LRCSI_AXIS_LOG, LRCSI_AXIS_DEG };

/* The axis that covers least .. most in round numbers, with about `texts` of them named at most.
   Where there is no such range it covers 0 .. 1, or 0.1 .. 1. */
lrcsi_axis lrcsi_axis_make(int kind, double least, double most, double texts);

/* Where a value lies: 0 at least, 1 at most, outside beyond; -HUGE_VAL for what a logarithm
   does not have. */
double lrcsi_axis_at(const lrcsi_axis *axis, double value);

#endif
