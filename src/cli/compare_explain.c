/* SPDX-License-Identifier: MIT */
/* Why answers differ: for each mistake of the catalogue, what it would have answered, with and
   without a constant factor, against what was handed in. The one that removes most of the
   differences is a finding; what it leaves is looked at again. An explanation is no proof: it says
   how many cases it explains, and what none explains is said to be unexplained. */
#include "cli/compare_search.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#define REMOVED        0.1  /* what may be left of a difference that is explained */
#define REMOVED_RASTER 0.5  /* the same, where their class allows that much in any case */
#define STRIKING       0.02 /* the same, where few cases speak for a mistake */
#define PRECISE        0.6  /* of the cases that a mistake touches, those that it must explain */
#define PROBE          16u  /* failing cases after which a hopeless mistake is given up */
#define HOPELESS       0.1  /* share of them */
#define WITNESSES      64u  /* passing cases that a mistake must not touch */
#define LATER          0.1  /* of all failing cases, what a second finding must explain */
#define PRICE          0.05 /* what a factor or a second mistake must gain to be believed */
#define SURE           0.94 /* a score after which none is sought that is better */
#define PAIRS_BELOW    0.9  /* where one mistake explains less, two at once are tried */
#define ENOUGH         3u   /* cases that make a finding by themselves */
#define TIED           2e-3 /* scores this near are equally good */
#define TIES_MOST      3u   /* mistakes that explain equally well, and are named */

/* How well a mistake explains. */
typedef struct explain_score {
    const compare_mistake *first, *second; /* second: NULL, or made as well */
    double factor;
    double score; /* share of the differences that it removes, where it is right */
    double price; /* of what it assumes, taken off the score */
    uint32_t explained;
} explain_score;

/* ---- one mistake ---- */

static int ascending(const void *a, const void *b)
{
    const double *x = a;
    const double *y = b;
    return (*x > *y) - (*x < *y);
}

double cli_search_median(double *value, uint32_t count)
{
    qsort(value, count, sizeof *value, ascending);
    return count > 0 ? value[count / 2] : 0.0;
}

static double case_room(const compare_search *search, const compare_case *one, double expected)
{
    double allowed = cli_compare_allowed(one, search->job->grade, search->job->pixels);
    return allowed * (one->sigma_m2 > 0.0 ? fmax(1.0, expected / one->sigma_m2) : 1.0);
}

int cli_search_explained(const compare_search *search, const compare_case *one, double expected)
{
    double left = fabs(one->theirs_m2 - expected);
    double off = fabs(one->theirs_m2 - one->sigma_m2);
    return left <= REMOVED * off ||
           (left <= REMOVED_RASTER * off && left <= case_room(search, one, expected));
}

/* Would the mistake change the case at all? */
static int case_touched(const compare_search *search, const compare_case *one, double expected)
{
    return fabs(expected - one->sigma_m2) > case_room(search, one, expected);
}

/* An answer of 0 that is expected is no evidence where others tell more: many mistakes let facets
   vanish. */
static int case_mute(const compare_search *search, const compare_case *one)
{
    return search->telling && one->theirs_m2 == 0.0;
}

/* How well a mistake's answers explain, times a factor. */
static explain_score score_make(const compare_search *search, double factor)
{
    explain_score score = {.factor = factor};
    double touched = 0.0;
    double removed = 0.0;
    uint32_t mute = 0;
    for (uint32_t i = 0; i < search->failings; i++) {
        const compare_case *one = search->failing[i];
        double expected = factor * search->answer[i];
        double left = fabs(one->theirs_m2 - expected) / fabs(one->theirs_m2 - one->sigma_m2);
        int right = cli_search_explained(search, one, expected);
        score.explained += (uint32_t)right;
        if (right && case_mute(search, one)) {
            mute++;
            continue;
        }
        touched += right || case_touched(search, one, expected);
        removed += right ? 1.0 - 0.5 * fmin(left, 1.0) : 0.0;
    }
    for (uint32_t i = 0; i < search->passings; i++) {
        double expected = factor * search->answer[search->failings + i];
        touched += case_touched(search, search->passing[i], expected) ? search->weight : 0.0;
    }
    uint32_t told = score.explained - mute;
    double precise = touched > 0.0 ? told / touched : 0.0;
    int striking = removed >= (1.0 - 0.5 * STRIKING) * told;
    if (told > 0 && (told >= ENOUGH || striking) && precise >= PRECISE) {
        score.score = precise * removed / (search->failings - mute);
    }
    return score;
}

/* ---- factors ---- */

/* The median ratio of what was handed in to what the mistake answers, over the first failing cases;
   a known number where it is near one. */
static double factor_median(const compare_search *search, uint32_t failings, int *known)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < failings; i++) {
        if (search->answer[i] > 0.0 && search->failing[i]->theirs_m2 > 0.0) {
            search->room[count++] = search->failing[i]->theirs_m2 / search->answer[i];
        }
    }
    return cli_factor_known(cli_search_median(search->room, count), known);
}

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

/* Is a mistake worth going on with, after so many failing cases? */
static int answers_hopeful(const compare_search *search, uint32_t failings)
{
    int known;
    double least = fmax(1.0, HOPELESS * failings);
    return explained_count(search, failings, 1.0) >= least ||
           explained_count(search, failings, factor_median(search, failings, &known)) >= least;
}

/* The answers of a mistake; 1 where it is worth scoring, 0 where not, -1 with the message. */
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

/* Two mistakes at once; the second may be NULL. */
static compare_mistake mistakes_both(const compare_mistake *first, const compare_mistake *second)
{
    compare_mistake both = *first;
    if (second) {
        both.shade = second->shade;
        both.at = second->at;
    }
    return both;
}

/* Keeps the mistake where it explains more than the best so far. 0, or -1 on failure. */
static int mistake_try(const compare_search *search, const compare_mistake *first,
                       const compare_mistake *second, explain_score *best)
{
    compare_mistake both = mistakes_both(first, second);
    int worth = answers_make(search, &both);
    int known;
    if (worth <= 0) {
        return worth;
    }
    double factor = factor_median(search, search->failings, &known);
    explain_score try[2] = {score_make(search, 1.0), {.score = 0.0}};
    if (factor > 0.0) {
        try[1] = score_make(search, factor);
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

static int singles_try(const compare_search *search, explain_score *best)
{
    int code = 0;
    for (const compare_mistake *a = cli_compare_mistakes;
         a->name && best->score < SURE && code == 0; a++) {
        code = mistake_try(search, a, NULL, best);
    }
    return code;
}

/* Every pair of a mistake in which areas are summed and one in how they are shaded; none that takes
   a run of its own for each case. */
static int pairs_try(const compare_search *search, explain_score *best)
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

/* What is left of the differences that it explains, in the median; marks their cases. */
static double finding_rest(const compare_search *search, const explain_score *best, int mark)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < search->failings; i++) {
        compare_case *one = search->failing[i];
        double expected = best->factor * search->answer[i];
        if (cli_search_explained(search, one, expected)) {
            search->room[count++] =
                fabs(one->theirs_m2 - expected) / fabs(one->theirs_m2 - one->sigma_m2);
            one->explained = mark;
        }
    }
    return cli_search_median(search->room, count);
}

/* Adds to a text what there is room for. */
__attribute__((format(printf, 2, 3))) static void text_add(char text[COMPARE_TEXT],
                                                           const char *format, ...)
{
    size_t used = strlen(text);
    va_list list;
    va_start(list, format);
    vsnprintf(text + used, COMPARE_TEXT - used, format, list);
    va_end(list);
}

static void finding_say(const compare_job *job, const explain_score *best, compare_finding *finding)
{
    char *text = finding->text;
    finding->factor = best->factor;
    if (best->first == cli_compare_mistakes) {
        finding->name = cli_factor_name(best->factor);
        text_add(text, "%.6g times the truth everywhere: %s", best->factor,
                 cli_factor_text(job, best->factor));
        return;
    }
    text_add(text, "%s", best->first->text);
    if (best->second) {
        text_add(text, "; and %s", best->second->text);
    }
    if (best->factor != 1.0) {
        text_add(text, "; and %.6g times that: %s", best->factor,
                 cli_factor_text(job, best->factor));
    }
}

/* The answers of a mistake to the cases that fail and to those that pass. 0 or -1. */
static int answers_all(const compare_search *search, const compare_mistake *mistake)
{
    int code = 0;
    for (uint32_t i = 0; i < search->failings + search->passings && code == 0; i++) {
        compare_case *one =
            i < search->failings ? search->failing[i] : search->passing[i - search->failings];
        code = cli_compare_answer(&search->job->kit, one, mistake, &search->answer[i]);
    }
    return code;
}

/* Does a mistake explain the cases of a finding, and no others? 1, 0, or -1 on failure. */
static int mistake_fits(const compare_search *search, const compare_mistake *mistake, double factor,
                        int mark)
{
    for (uint32_t i = 0; i < search->failings; i++) {
        compare_case *one = search->failing[i];
        double answer = 0.0;
        if (cli_compare_answer(&search->job->kit, one, mistake, &answer) != 0) {
            return -1;
        }
        if (cli_search_explained(search, one, factor * answer) != (one->explained == mark)) {
            return 0;
        }
    }
    return 1;
}

/* Says which other mistakes explain the same cases equally well. 0 or -1. */
static int ties_say(const compare_search *search, const explain_score *best,
                    compare_finding *finding)
{
    uint32_t ties = 0;
    for (const compare_mistake *a = cli_compare_mistakes + 1; a->name && ties < TIES_MOST; a++) {
        compare_mistake both = mistakes_both(a, best->second);
        int alone = a != best->first && best->first != cli_compare_mistakes && a != best->second;
        int fits =
            alone ? mistake_fits(search, &both, best->factor, (int)search->job->findings) : 0;
        if (fits < 0 || (fits > 0 && answers_all(search, &both) != 0)) {
            return -1;
        }
        double score = fits ? score_make(search, best->factor).score - best->price : 0.0;
        if (fits && fabs(score - best->score) <= TIED) {
            text_add(finding->text, "%s%s", ties++ > 0 ? "; " : "; or, equally well: ", a->text);
        }
    }
    return 0;
}

/* The best explanation of what fails still; 1 where there is one, 0 where not, -1 on failure. */
static int finding_next(compare_search *search)
{
    compare_job *job = search->job;
    explain_score best = {.first = cli_compare_mistakes};
    int code = singles_try(search, &best);
    if (code == 0 && best.score < PAIRS_BELOW) {
        code = pairs_try(search, &best);
    }
    if (job->findings > 0 && best.explained < LATER * job->failed) {
        best.score = 0.0; /* of a few cases that are left, chance explains some */
    }
    if (code == 0 && best.score > 0.0) {
        compare_mistake both = mistakes_both(best.first, best.second);
        code = answers_all(search, &both);
    }
    if (code != 0) {
        return -1;
    }
    compare_finding *finding = best.score > 0.0 ? cli_search_finding(job, best.first->name) : NULL;
    if (!finding) {
        return 0;
    }
    finding->explained = best.explained;
    finding_say(job, &best, finding);
    finding->rest = finding_rest(search, &best, (int)job->findings);
    return ties_say(search, &best, finding) == 0 ? 1 : -1;
}

compare_finding *cli_search_finding(compare_job *job, const char *name)
{
    if (job->findings == COMPARE_FINDINGS) {
        return NULL;
    }
    compare_finding *finding = &job->finding[job->findings++];
    *finding = (compare_finding){.name = name, .factor = 1.0, .rest = 1.0};
    return finding;
}

/* Shuffles a list, the same way every time, so that its beginning stands for all of it. */
static void list_shuffle(compare_case **list, uint32_t count)
{
    uint32_t state = 1;
    for (uint32_t i = count; i > 1; i--) {
        state = state * 1664525u + 1013904223u; /* Numerical Recipes */
        uint32_t k = (state >> 8) % i;
        compare_case *kept = list[i - 1];
        list[i - 1] = list[k];
        list[k] = kept;
    }
}

/* Parts the cases asked for into those that fail, unexplained so far, and some that pass. */
void cli_search_part(compare_search *search)
{
    compare_job *job = search->job;
    search->failings = search->passings = 0;
    search->telling = 0;
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        compare_case *one = &job->kit.list[i];
        if (!one->given || !isfinite(one->theirs_m2) || !cli_compare_asked(job, one)) {
            continue;
        }
        if (!cli_compare_failed(job, one)) {
            search->passing[search->passings++] = one;
        } else if (one->explained == 0) {
            search->failing[search->failings++] = one;
            search->telling |= one->theirs_m2 != 0.0;
        }
    }
    list_shuffle(search->failing, search->failings);
    list_shuffle(search->passing, search->passings);
    uint32_t witnesses = search->passings < WITNESSES ? search->passings : WITNESSES;
    search->weight = witnesses > 0 ? (double)search->passings / witnesses : 0.0;
    search->passings = witnesses;
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
    cli_compare_misread(search);
    while (more > 0 && search->failings > 0) {
        more = finding_next(search);
        cli_search_part(search);
    }
    if (more < 0 || cli_compare_signs(search) != 0) {
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
    int code = search.failing && search.passing && search.answer && search.room
                   ? findings_make(&search)
                   : cli_out_of_memory();
    free(search.failing);
    free(search.passing);
    free(search.answer);
    free(search.room);
    return code;
}
