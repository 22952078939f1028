/* SPDX-License-Identifier: MIT */
/* What the rooms that look for reasons share: the cases that fail still, and factors. */
#ifndef LRCS_CLI_COMPARE_SEARCH_H
#define LRCS_CLI_COMPARE_SEARCH_H

#include "cli/compare/compare.h"

typedef struct compare_search {
    compare_job *job;
    compare_case **failing; /* not explained yet */
    compare_case **passing; /* some of them */
    uint32_t failings, passings;
    int telling;          /* is an answer of those that fail not 0? */
    double weight;        /* of how many passing cases each of them tells */
    double *answer;       /* of a mistake: the failing cases, then the passing ones */
    double *room;         /* to sort in */
    unsigned char *holds; /* of each failing case: does the reason at hand explain it? */
} compare_search;

/* How well a mistake explains. */
typedef struct search_score {
    const compare_mistake *first, *second; /* second: NULL, or made as well */
    double factor;
    double score; /* share of the differences that it removes, where it is right */
    double price; /* of what it assumes, taken off the score */
    uint32_t explained;
} search_score;

/* Parts the cases asked for into those that fail, unexplained so far, and some that pass. */
void cli_search_part(compare_search *search);

/* Does an expected answer explain what was handed in? */
int cli_search_explained(const compare_search *search, const compare_case *one, double expected);

/* How well a mistake's answers explain, times a factor. */
search_score cli_search_score(const compare_search *search, double factor);

/* The median ratio of what was handed in to what the mistake answers, over the first failing cases;
   a known number where it is near one. */
double cli_search_factor(const compare_search *search, uint32_t failings, int *known);

/* A mistake with another one's shade; the second may be NULL. */
compare_mistake cli_mistake_both(const compare_mistake *first, const compare_mistake *second);

/* Makes a finding of the best explanation and marks its cases. 0, or -1 with the message printed.
 */
int cli_search_say(compare_search *search, const search_score *best);

/* The median, 0 of nothing; sorts the values. */
double cli_search_median(double *value, uint32_t count);

/* The next finding, empty; NULL where there is no room for one. */
compare_finding *cli_search_finding(compare_job *job, const char *name);

/* How many failing cases the reason at hand explains (search->holds). */
uint32_t cli_search_holds(const compare_search *search);

/* Makes that reason a finding, with its sentence: its cases are marked, and fail unexplained no
   more. NULL where there is no room for one. */
__attribute__((format(printf, 3, 4))) compare_finding *
cli_search_find(compare_search *search, const char *name, const char *format, ...);

/* What shows in the table before any physics: nothing but zeros, another unit, rows moved, few
   digits. */
void cli_compare_format(compare_search *search);

/* What needs no mistake of the catalogue to be told: coarse depths, single precision, a raster, a
   factor that all answers share. 0, or -1 with the message printed. */
int cli_compare_symptoms(compare_search *search);

/* A factor near one that is known by name, or itself; what it may mean, and its name. */
double cli_factor_known(double factor, int *known);
const char *cli_factor_text(const compare_job *job, double factor);
const char *cli_factor_name(double factor);

#endif
