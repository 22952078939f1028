/* SPDX-License-Identifier: MIT */
/* Shared by the files that search for causes: the remaining failing cases, and factors. */
#ifndef LRCS_CLI_COMPARE_SEARCH_H
#define LRCS_CLI_COMPARE_SEARCH_H

#include "cli/compare/compare.h"

typedef struct compare_search {
    compare_job *job;
    compare_case **failing; /* not explained yet */
    compare_case **passing; /* a sample of them */
    uint32_t failings, passings;
    int telling;          /* 1 if some failing case has an answer other than 0 */
    double weight;        /* number of passing cases that each of the sample stands for */
    double *answer;       /* answers of a mistake: to the failing cases, then to the passing ones */
    double *room;         /* for sorting */
    unsigned char *holds; /* by failing case: 1 if the current cause explains it */
} compare_search;

/* How well a mistake explains. */
typedef struct search_score {
    const compare_mistake *first, *second; /* second: NULL, or a second mistake made in addition */
    double factor;
    double score; /* share of the differences that it removes in the cases that it explains */
    double price; /* for what it assumes; subtracted from the score */
    uint32_t explained;
} search_score;

/* Divides the cases asked for into those that fail without explanation so far, and a sample of
   those that pass. */
void cli_search_part(compare_search *search);

/* 1 if an expected answer explains the submitted one. */
int cli_search_explained(const compare_search *search, const compare_case *one, double expected);

/* How well a mistake's answers, times a factor, explain the submitted ones. */
search_score cli_search_score(const compare_search *search, double factor);

/* The median ratio of submitted answers to those of the mistake, over the first failing cases; if
   it is near a known number, that number. */
double cli_search_factor(const compare_search *search, uint32_t failings, int *known);

/* A mistake combined with the shading of another one; the second may be NULL. */
compare_mistake cli_mistake_both(const compare_mistake *first, const compare_mistake *second);

/* Makes the best explanation a finding and marks its cases. 0, or -1 with the message printed. */
int cli_search_say(compare_search *search, const search_score *best);

/* The median, 0 of an empty list; sorts the values. */
double cli_search_median(double *value, uint32_t count);

/* The next finding, empty; NULL if there is no room for one. */
compare_finding *cli_search_finding(compare_job *job, const char *name);

/* The number of failing cases that the current cause explains (search->holds). */
uint32_t cli_search_holds(const compare_search *search);

/* Makes that cause a finding with its sentence: its cases are marked and no longer unexplained.
   NULL if there is no room for one. */
__attribute__((format(printf, 3, 4))) compare_finding *
cli_search_find(compare_search *search, const char *name, const char *format, ...);

/* Finds causes visible in the table without physics: only zeros, another unit, shifted rows, few
   digits. */
void cli_compare_format(compare_search *search);

/* Finds causes that need no mistake of the catalogue: coarse depths, single precision, a raster, a
   factor that all answers share. 0, or -1 with the message printed. */
int cli_compare_symptoms(compare_search *search);

/* The known factor near a factor, or the factor itself if there is none; its possible cause, and
   its name. */
double cli_factor_known(double factor, int *known);
const char *cli_factor_text(const compare_job *job, double factor);
const char *cli_factor_name(double factor);

#endif
