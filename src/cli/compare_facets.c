/* SPDX-License-Identifier: MIT */
/* stub */
#include "cli/compare.h"

int cli_compare_facets(compare_job *job)
{
    (void)job;
    return 0;
}

int cli_compare_items(compare_job *job)
{
    (void)job;
    return 0;
}
