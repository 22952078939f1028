/* SPDX-License-Identifier: MIT */
#ifndef LRCSI_HOST_MEDIAN_H
#define LRCSI_HOST_MEDIAN_H

#include <stdint.h>

/* Sorts numbers in ascending order. Returns their median: of an even number the mean of the middle
   two; 0 of none. */
double lrcsi_host_median(double *value, uint32_t count);

#endif
