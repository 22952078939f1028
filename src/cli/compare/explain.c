/* SPDX-License-Identifier: MIT */
/* Finds why answers differ: compares the submitted answers with those that each mistake of the
   catalogue would produce, with and without a constant factor. The mistake that removes most of the
   differences is a finding; the remaining differences are examined again. An explanation is not a
   proof: the report states how many cases it explains, and which cases remain unexplained. */
#include "cli/compare/search.h"

#include <math.h>
#include <stdlib.h>

#define PROBE       16u  /* failing cases after which a hopeless mistake is abandoned */
#define HOPELESS    0.1  /* the share of them that must be explained */
#define LATER       0.1  /* the share of all failing cases that a later finding must explain */
#define PRICE       0.05 /* the gain by which a factor or a second mistake is justified */
#define SURE        0.94 /* a score above which the search for a better one stops */
#define PAIRS_BELOW 0.9  /* if one mistake explains less than this, pairs are tried */

/* ---- the catalogue ---- */

static uint32_t explained_count(const compare_search *search, uint32_t failings, double factor)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < failings; i++) {
        count +=
            (uint32_t)cli_search_explained(search, search->failing[i], factor * search->answer[i]);
    }
    return count;
}

/* 1 if a mistake is still promising after so many failing cases. */
static int answers_hopeful(const compare_search *search, uint32_t failings)
{
    int known;
    double least = fmax(1.0, HOPELESS * failings);
    return explained_count(search, failings, 1.0) >= least ||
           explained_count(search, failings, cli_search_factor(search, failings, &known)) >= least;
}

/* Computes the answers of a mistake; 1 if it is worth scoring, 0 if not, -1 with the message
   printed. */
static int answers_make(const compare_search *search, const compare_mistake *mistake)
{
    uint32_t failings = search->failings;
    uint32_t probe = failings < PROBE ? failings : PROBE;
    for (uint32_t i = 0; i < failings + search->passings; i++) {
        compare_case *one = i < failings ? search->failing[i] : search->passing[i - failings];
        if (cli_compare_answer(&search->job->kit, one, mistake, &search->answer[i]) != 0) {
            return -1;
        }
        if (i + 1 == probe && !answers_hopeful(search, probe)) {
            return 0;
        }
    }
    return 1;
}

/* Keeps the mistake if it explains more than the best one so far. 0, or -1 on failure. */
static int mistake_try(const compare_search *search, const compare_mistake *first,
                       const compare_mistake *second, search_score *best)
{
    compare_mistake both = cli_mistake_both(first, second);
    int worth = answers_make(search, &both);
    int known;
    if (worth <= 0) {
        return worth;
    }
    double factor = cli_search_factor(search, search->failings, &known);
    search_score try[2] = {cli_search_score(search, 1.0), {.score = 0.0}};
    if (factor > 0.0) {
        try[1] = cli_search_score(search, factor);
        try[1].price = known ? PRICE : 2.0 * PRICE;
    }
    for (int i = 0; i < 2; i++) {
        try[i].price += second ? PRICE : 0.0;
        try[i].score -= try[i].price;
        if (try[i].score > best->score) {
            *best = try[i];
            best->first = first;
            best->second = second;
        }
    }
    return 0;
}

static int singles_try(const compare_search *search, search_score *best)
{
    int code = 0;
    for (const compare_mistake *a = cli_compare_mistakes;
         a->name && best->score < SURE && code == 0; a++) {
        code = mistake_try(search, a, NULL, best);
    }
    return code;
}

/* Tries every pair of a mistake in the areas and one in the shading; mistakes that need a run of
   their own for each case are left out. */
static int pairs_try(const compare_search *search, search_score *best)
{
    int code = 0;
    for (const compare_mistake *a = cli_compare_mistakes + 1; a->name && code == 0; a++) {
        for (const compare_mistake *b = cli_compare_mistakes + 1; b->name && code == 0; b++) {
            if (a->area && !a->turn && b->shade) {
                code = mistake_try(search, a, b, best);
            }
        }
    }
    return code;
}

/* ---- findings ---- */

/* Finds the best explanation of the remaining failures; 1 if there is one, 0 if not, -1 on
   failure. */
static int finding_next(compare_search *search)
{
    compare_job *job = search->job;
    search_score best = {.first = cli_compare_mistakes};
    int code = singles_try(search, &best);
    if (code == 0 && best.score < PAIRS_BELOW) {
        code = pairs_try(search, &best);
    }
    if (job->findings > 0 && best.explained < LATER * job->failed) {
        best.score = 0.0; /* if only a few cases remain, some are explained by chance */
    }
    if (code != 0) {
        return -1;
    }
    if (best.score <= 0.0 || job->findings == COMPARE_FINDINGS) {
        return 0;
    }
    return cli_search_say(search, &best) == 0 ? 1 : -1;
}

/* ---- the search ---- */

static void lacks_count(compare_job *job)
{
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        int lack = cli_compare_lack(job, &job->kit.list[i]);
        job->not_numbers += lack == LACK_NUMBER;
        job->negatives += lack == LACK_SIGN;
        job->unexplained += lack == LACK_REASON;
    }
}

static int findings_make(compare_search *search)
{
    int more = 1;
    cli_search_part(search);
    cli_compare_format(search);
    while (more > 0 && search->failings > 0) {
        more = finding_next(search);
        cli_search_part(search);
    }
    if (more < 0 || cli_compare_symptoms(search) != 0) {
        return CLI_FAILED;
    }
    lacks_count(search->job);
    return 0;
}

int cli_compare_explain(compare_job *job)
{
    size_t count = (size_t)job->kit.cases + 1;
    compare_search search = {.job = job};
    search.failing = malloc(count * sizeof(compare_case *));
    search.passing = malloc(count * sizeof(compare_case *));
    search.answer = calloc(count, sizeof(double));
    search.room = calloc(count, sizeof(double));
    search.holds = calloc(count, 1);
    int code = search.failing && search.passing && search.answer && search.room && search.holds
                   ? findings_make(&search)
                   : cli_out_of_memory();
    free(search.failing);
    free(search.passing);
    free(search.answer);
    free(search.room);
    free(search.holds);
    return code;
}
