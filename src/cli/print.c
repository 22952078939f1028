/* SPDX-License-Identifier: MIT */
/* What several commands print alike. */
#include "cli/cli.h"

#include <math.h>

double cli_dbsm(double sigma_m2)
{
    return 10.0 * log10(sigma_m2);
}

void cli_notices_print(FILE *out, const lrcs_host_notices *notices)
{
    for (uint32_t i = 0; i < notices->count; i++) {
        fprintf(out, "notice: %s\n", notices->text[i]);
    }
}
