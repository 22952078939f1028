/* SPDX-License-Identifier: MIT */
/* Compensated sums, which do not lose small terms beside large ones. */
#include "cli/cli.h"

#include <math.h>

/* A. Neumaier, Z. Angew. Math. Mech. 54 (1974) 39. */
void cli_sum_add(cli_sum *sum, double value)
{
    double total = sum->value + value;
    sum->low += fabs(sum->value) >= fabs(value) ? (sum->value - total) + value
                                                : (value - total) + sum->value;
    sum->value = total;
}

double cli_sum_value(const cli_sum *sum)
{
    return sum->value + sum->low;
}
