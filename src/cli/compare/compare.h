/* SPDX-License-Identifier: MIT */
/* Shared by the files of lrcs compare: what it was asked, and the judgement. */
#ifndef LRCS_CLI_COMPARE_H
#define LRCS_CLI_COMPARE_H

#include "cli/cli.h"

#include <lrcs/conformance.h>

typedef lrcs_host_kit_case compare_case;

typedef struct compare_job {
    const cli_args *args;
    const char *theirs, *facets, *items; /* facets, items: NULL if not asked for */
    lrcs_host_judgement judgement;
} compare_job;

/* The cases of a tier, and how many of them failed. */
void cli_compare_tier(const lrcs_host_judgement *judgement, uint32_t tier, unsigned long *cases,
                      unsigned long *failed);

/* The reports: a table on stdout, and JSON and JUnit XML, whose context is the job. */
void cli_compare_table(const compare_job *job);
cli_text_writer cli_compare_json;
cli_text_writer cli_compare_junit;

#endif
