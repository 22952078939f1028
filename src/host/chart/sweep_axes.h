/* SPDX-License-Identifier: MIT */
/* The quantities along the axes of a chart of a sweep, in words. */
#ifndef LRCSI_SWEEP_AXES_H
#define LRCSI_SWEEP_AXES_H

#include <lrcs/sweep_chart.h>

/* The name of an axis in words, and its unit or NULL. */
typedef struct lrcsi_axis_words {
    char text[160];
    const char *unit;
} lrcsi_axis_words;

/* Converts "az_deg" to words and its unit; other names are unchanged. */
lrcsi_axis_words lrcsi_axis_words_of(const char *name);

/* "azimuth 30 deg". */
void lrcsi_axis_value_text(const char *name, double value, char text[192]);

/* 1 if the values are degrees. */
int lrcsi_axis_is_angle(const lrcs_host_sweep_axis *axis);

#endif
