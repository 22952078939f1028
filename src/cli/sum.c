/* SPDX-License-Identifier: MIT */
/* Sums that do not lose what is small beside what is large. */
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
