/* SPDX-License-Identifier: MIT */
/* The median of numbers. */
#include "host/run/median.h"

#include "base/sort.h"

double lrcsi_host_median(double *value, uint32_t count)
{
    lrcsi_sort_ascending(value, count);
    return count > 0 ? 0.5 * (value[(count - 1) / 2] + value[count / 2]) : 0.0;
}
