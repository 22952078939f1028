/* SPDX-License-Identifier: MIT */
/* An axis of a chart: its range, its ticks, and where a value lies on it. */
#ifndef LRCSI_HOST_AXIS_H
#define LRCSI_HOST_AXIS_H

#include <stdint.h>

#define LRCSI_AXIS_TICKS 256u

/* The values that an axis can show: a logarithmic one from MIN, a linear one from -MAX. */
#define LRCSI_AXIS_MIN 1e-290
#define LRCSI_AXIS_MAX 1e290

typedef struct lrcsi_tick {
    double value;
    int major;      /* has a text */
    char text[48];  /* "0.5"; "10" if `raised` is its exponent */
    char raised[8]; /* "-6", or "" */
} lrcsi_tick;

typedef struct lrcsi_axis {
    int log; /* decades instead of equal steps */
    double low, high;
    uint32_t count;
    lrcsi_tick tick[LRCSI_AXIS_TICKS]; /* ascending, low and high among them */
} lrcsi_axis;

enum lrcsi_axis_kind { LRCSI_AXIS_LINEAR, LRCSI_AXIS_LOG, LRCSI_AXIS_DEG };

/* The axis that covers low .. high in round numbers, with at most about `labels` labels. If low
   exceeds high it covers 0 .. 1, or 0.1 .. 1. */
lrcsi_axis lrcsi_axis_make(int kind, double low, double high, double labels);

/* The position of a value: 0 at `low`, 1 at `high`, outside 0 .. 1 beyond them; -HUGE_VAL if it
   has no logarithm. */
double lrcsi_axis_at(const lrcsi_axis *axis, double value);

#endif
