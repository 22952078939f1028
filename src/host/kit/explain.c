/* SPDX-License-Identifier: MIT */
/* Finds why answers differ: compares the submitted answers with those that each mistake of the
   catalogue would produce, with and without a constant factor. The mistake that removes most of the
   differences is a finding, described in a sentence; the remaining differences are examined again.
   An explanation is not a proof: the report states how many cases it explains, and which cases
   remain unexplained. */
#include "host/kit/search.h"

#include <lrcs/file.h>

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "base/sort.h"
#include "host/fail.h"

/* All of these are heuristic: they decide which explanations are offered, and not the verdict. */
#define REMOVED        0.1  /* fraction of a difference that may remain if it is explained */
#define REMOVED_RASTER 0.5  /* that fraction where the class of the case allows so much anyway */
#define CLOSE_FIT      0.02 /* that fraction where few cases support a mistake */
#define PRECISE        0.6  /* fraction of the cases changed by a mistake that it must explain */
#define PASSING_SAMPLE 64u  /* number of passing cases that a mistake must not change */
#define ENOUGH         3u   /* number of cases that suffice for a finding */
#define TIED           2e-3 /* scores that differ by less are equally good */
#define TIES_MOST      3u   /* number of named mistakes that explain equally well */
#define CLIPPED        0.9  /* fraction of the remaining cases that lose something at the window */
#define TRIAL_CASES    16u  /* failing cases after which a mistake that explains few is abandoned */
#define MIN_EXPLAINED  0.1  /* fraction of them that it must explain */
#define LATER          0.1  /* fraction of all failing cases that a later finding must explain */
#define PENALTY        0.05 /* the gain by which a factor or a second mistake is justified */
#define CERTAIN        0.94 /* a score above which the search for a better one stops */
#define PAIRS_BELOW    0.9  /* if one mistake explains less than this, pairs are tried */

/* ---- how well a mistake explains ---- */

/* Shuffles a list, in the same way every time, so that its beginning is a representative sample. */
static void list_shuffle(lrcs_host_kit_case **list, uint32_t count)
{
    uint32_t state = 1;
    for (uint32_t i = count; i > 1; i--) {
        state = state * 1664525u + 1013904223u; /* Numerical Recipes */
        uint32_t k = (state >> 8) % i;
        lrcs_host_kit_case *kept = list[i - 1];
        list[i - 1] = list[k];
        list[k] = kept;
    }
}

/* Divides the cases asked for into those that fail without explanation so far, and a sample of
   those that pass. */
static void cases_divide(lrcsi_search *search)
{
    lrcs_host_judgement *job = search->job;
    search->failing_count = search->passing_count = 0;
    search->any_nonzero = 0;
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        lrcs_host_kit_case *one = &job->kit.list[i];
        if (!one->given || !isfinite(one->answer_m2) || !lrcs_host_judge_asked(job, one)) {
            continue;
        }
        if (!lrcs_host_judge_failed(job, one)) {
            search->passing[search->passing_count++] = one;
        } else if (one->explained == 0) {
            search->failing[search->failing_count++] = one;
            search->any_nonzero |= one->answer_m2 != 0.0;
        }
    }
    list_shuffle(search->failing, search->failing_count);
    list_shuffle(search->passing, search->passing_count);
    uint32_t sampled =
        search->passing_count < PASSING_SAMPLE ? search->passing_count : PASSING_SAMPLE;
    search->weight = sampled > 0 ? (double)search->passing_count / sampled : 0.0;
    search->passing_count = sampled;
}

double lrcsi_search_upper_median(double *value, uint32_t count)
{
    lrcsi_sort_ascending(value, count);
    return count > 0 ? value[count / 2] : 0.0;
}

/* The allowed error of a case, larger in proportion if the expected answer is. */
static double case_room(const lrcsi_search *search, const lrcs_host_kit_case *one, double expected)
{
    double allowed = lrcs_host_judge_allowed(one, search->job->grade, search->job->pixels);
    return allowed * (one->sigma_m2 > 0.0 ? fmax(1.0, expected / one->sigma_m2) : 1.0);
}

int lrcsi_search_explained(const lrcsi_search *search, const lrcs_host_kit_case *one,
                           double expected)
{
    double left = fabs(one->answer_m2 - expected);
    double off = fabs(one->answer_m2 - one->sigma_m2);
    return left <= REMOVED * off ||
           (left <= REMOVED_RASTER * off && left <= case_room(search, one, expected));
}

/* 1 if the mistake changes the case at all. */
static int case_touched(const lrcsi_search *search, const lrcs_host_kit_case *one, double expected)
{
    return fabs(expected - one->sigma_m2) > case_room(search, one, expected);
}

/* How well a mistake explains the submitted answers. */
typedef struct search_score {
    const lrcsi_mistake *first, *second; /* second: NULL, or a second mistake made in addition */
    double factor;
    double score;   /* share of the differences that it removes in the cases that it explains */
    double penalty; /* for what it assumes; subtracted from the score */
    uint32_t explained;
} search_score;

/* How well the answers of a mistake, times a factor, explain the submitted ones. */
static search_score mistake_score(const lrcsi_search *search, const double *answer, double factor)
{
    search_score score = {.factor = factor};
    double changed = 0.0;
    double removed = 0.0;
    uint32_t uninformative = 0;
    for (uint32_t i = 0; i < search->failing_count; i++) {
        const lrcs_host_kit_case *one = search->failing[i];
        double expected = factor * answer[i];
        double left = fabs(one->answer_m2 - expected) / fabs(one->answer_m2 - one->sigma_m2);
        int right = lrcsi_search_explained(search, one, expected);
        score.explained += (uint32_t)right;
        if (right && search->any_nonzero && one->answer_m2 == 0.0) {
            uninformative++; /* no evidence if others are not 0: many mistakes make facets vanish */
            continue;
        }
        changed += right || case_touched(search, one, expected);
        removed += right ? 1.0 - 0.5 * fmin(left, 1.0) : 0.0;
    }
    for (uint32_t i = 0; i < search->passing_count; i++) {
        double expected = factor * answer[search->failing_count + i];
        changed += case_touched(search, search->passing[i], expected) ? search->weight : 0.0;
    }
    uint32_t conclusive = score.explained - uninformative;
    double precise = changed > 0.0 ? conclusive / changed : 0.0;
    int striking = removed >= (1.0 - 0.5 * CLOSE_FIT) * conclusive;
    if (conclusive > 0 && (conclusive >= ENOUGH || striking) && precise >= PRECISE) {
        score.score = precise * removed / (search->failing_count - uninformative);
    }
    return score;
}

/* The median ratio of submitted answers to those of a mistake, over the first failing cases; if it
   is near a known factor, that factor. */
static double factor_median(const lrcsi_search *search, const double *answer,
                            uint32_t failing_count)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < failing_count; i++) {
        if (answer[i] > 0.0 && search->failing[i]->answer_m2 > 0.0) {
            search->room[count++] = search->failing[i]->answer_m2 / answer[i];
        }
    }
    double median = lrcsi_search_upper_median(search->room, count);
    const lrcsi_factor *known = lrcsi_factor_find(median);
    return known ? known->value : median;
}

/* ---- the answers of a mistake ---- */

static uint32_t explained_count(const lrcsi_search *search, const double *answer,
                                uint32_t failing_count, double factor)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < failing_count; i++) {
        count += (uint32_t)lrcsi_search_explained(search, search->failing[i], factor * answer[i]);
    }
    return count;
}

/* Computes the answers of a mistake to the cases from `first` up to `end`: the failing ones are
   counted first, then the passing ones. Status: as lrcs_host_judge. */
static int answers_make(const lrcsi_search *search, const lrcsi_mistake *mistake, uint32_t first,
                        uint32_t end, double *answer)
{
    int status = LRCS_OK;
    for (uint32_t i = first; i < end && status == LRCS_OK; i++) {
        lrcs_host_kit_case *one = i < search->failing_count
                                      ? search->failing[i]
                                      : search->passing[i - search->failing_count];
        status = lrcsi_mistake_answer(&search->job->kit, one, mistake, &answer[i], search->error);
    }
    return status;
}

/* ---- a finding in words ---- */

/* The next finding, empty; NULL if there is no room for one. */
static lrcs_host_finding *finding_new(lrcs_host_judgement *job, const char *name)
{
    if (job->findings == LRCS_HOST_FINDINGS) {
        return NULL;
    }
    lrcs_host_finding *finding = &job->finding[job->findings++];
    *finding = (lrcs_host_finding){.name = name, .factor = 1.0, .residual_share = 1.0};
    return finding;
}

uint32_t lrcsi_search_explained_cases(const lrcsi_search *search, const unsigned char *explains)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < search->failing_count; i++) {
        count += explains[i];
    }
    return count;
}

lrcs_host_finding *lrcsi_search_finding_add(lrcsi_search *search, const unsigned char *explains,
                                            const char *name, const char *format, ...)
{
    va_list list;
    lrcs_host_finding *finding = finding_new(search->job, name);
    if (!finding) {
        return NULL;
    }
    va_start(list, format);
    vsnprintf(finding->text, sizeof finding->text, format, list);
    va_end(list);
    for (uint32_t i = 0; i < search->failing_count; i++) {
        if (explains[i]) {
            search->failing[i]->explained = (int)search->job->findings;
        }
    }
    finding->explained = lrcsi_search_explained_cases(search, explains);
    cases_divide(search);
    return finding;
}

/* A mistake combined with the shading of another one; the second may be NULL. */
static lrcsi_mistake mistake_both(const lrcsi_mistake *first, const lrcsi_mistake *second)
{
    lrcsi_mistake both = *first;
    if (second) {
        both.shade = second->shade;
        both.parameter = second->parameter;
    }
    return both;
}

/* Decides whether a mistake explains exactly those failing cases that a finding does (`mark`).
   Computes its answers only as long as it does. Status: as lrcs_host_judge. */
static int mistake_fits(const lrcsi_search *search, const lrcsi_mistake *mistake, double factor,
                        int mark, double *answer, int *fits)
{
    int status = LRCS_OK;
    *fits = 1;
    for (uint32_t i = 0; *fits && i < search->failing_count && status == LRCS_OK; i++) {
        status = answers_make(search, mistake, i, i + 1, answer);
        *fits = status == LRCS_OK &&
                lrcsi_search_explained(search, search->failing[i], factor * answer[i]) ==
                    (search->failing[i]->explained == mark);
    }
    return *fits ? answers_make(search, mistake, search->failing_count,
                                search->failing_count + search->passing_count, answer)
                 : status;
}

/* Names the other mistakes that explain the same cases equally well. */
static int ties_append(const lrcsi_search *search, const search_score *best,
                       lrcs_host_finding *finding)
{
    uint32_t ties = 0;
    if (best->first == lrcsi_mistakes) {
        return LRCS_OK;
    }
    for (const lrcsi_mistake *a = lrcsi_mistakes + 1; a->name && ties < TIES_MOST; a++) {
        lrcsi_mistake both = mistake_both(a, best->second);
        int fits = 0;
        if (a != best->first && a != best->second) {
            int status = mistake_fits(search, &both, best->factor, (int)search->job->findings,
                                      search->other_answer, &fits);
            if (status != LRCS_OK) {
                return status;
            }
        }
        double score =
            fits ? mistake_score(search, search->other_answer, best->factor).score - best->penalty
                 : 0.0;
        if (fits && fabs(score - best->score) <= TIED) {
            lrcs_host_append(finding->text, sizeof finding->text, "%s%s",
                             ties++ > 0 ? "; " : "; or, equally well: ", a->text);
        }
    }
    return LRCS_OK;
}

/* If the frame is wrong, the kit's square no longer contains the scene: most of the remaining cases
   show less than they should, because part of the scene is outside. */
static void clipped_append(const lrcsi_search *search, const search_score *best,
                           lrcs_host_finding *finding)
{
    int mark = (int)search->job->findings;
    uint32_t left = 0;
    uint32_t less = 0;
    for (uint32_t i = 0; i < search->failing_count; i++) {
        const lrcs_host_kit_case *one = search->failing[i];
        left += one->explained != mark;
        less += one->explained != mark && one->answer_m2 < best->factor * search->answer[i];
    }
    if (less == 0 || left > finding->explained || less < CLIPPED * left) {
        return;
    }
    for (uint32_t i = 0; i < search->failing_count; i++) {
        lrcs_host_kit_case *one = search->failing[i];
        int cut = one->explained == 0 && one->answer_m2 < best->factor * search->answer[i];
        one->explained = cut ? mark : one->explained;
    }
    finding->explained += less;
    lrcs_host_append(finding->text, sizeof finding->text,
                     "; in %lu cases less than that: part of the scene is outside the window",
                     (unsigned long)less);
}

/* Makes the best explanation a finding and marks its cases. Status: as lrcs_host_judge. */
static int finding_make(lrcsi_search *search, const search_score *best)
{
    const lrcs_host_judgement *job = search->job;
    const lrcsi_mistake both = mistake_both(best->first, best->second);
    /* 1. What the mistake answers. */
    int status = answers_make(search, &both, 0, search->failing_count + search->passing_count,
                              search->answer);
    lrcs_host_finding *finding =
        status == LRCS_OK ? finding_new(search->job, best->first->name) : NULL;
    if (!finding) {
        return status;
    }
    finding->explained = best->explained;
    finding->factor = best->factor;
    /* 2. The sentence: the mistakes and the factor, or the factor alone. */
    const char *factor_text = lrcsi_factor_text(best->factor, job->pixels);
    if (best->first == lrcsi_mistakes) {
        finding->name = lrcsi_factor_name(best->factor);
        lrcs_host_append(finding->text, sizeof finding->text, "%.6g times the truth everywhere: %s",
                         best->factor, factor_text);
    } else {
        lrcs_host_append(finding->text, sizeof finding->text, "%s", best->first->text);
        if (best->second) {
            lrcs_host_append(finding->text, sizeof finding->text, "; and %s", best->second->text);
        }
        if (best->factor != 1.0) {
            lrcs_host_append(finding->text, sizeof finding->text, "; and %.6g times that: %s",
                             best->factor, factor_text);
        }
    }
    /* 3. The cases that it explains, and the median share of their differences that remains. */
    uint32_t count = 0;
    for (uint32_t i = 0; i < search->failing_count; i++) {
        lrcs_host_kit_case *one = search->failing[i];
        double expected = best->factor * search->answer[i];
        if (lrcsi_search_explained(search, one, expected)) {
            search->room[count++] =
                fabs(one->answer_m2 - expected) / fabs(one->answer_m2 - one->sigma_m2);
            one->explained = (int)job->findings;
        }
    }
    finding->residual_share = lrcsi_search_upper_median(search->room, count);
    /* 4. Mistakes that explain them equally well; what a wrong pose moves out of the window. */
    status = ties_append(search, best, finding);
    if (status == LRCS_OK && best->first->pose) {
        clipped_append(search, best, finding);
    }
    return status;
}

/* ---- the best explanation ---- */

/* Keeps the mistake if it explains more than the best one so far. Gives up after a few cases if it
   explains hardly any of them. Status: as lrcs_host_judge. */
static int mistake_try(const lrcsi_search *search, const lrcsi_mistake *first,
                       const lrcsi_mistake *second, search_score *best)
{
    const lrcsi_mistake both = mistake_both(first, second);
    double *answer = search->answer;
    uint32_t trial = search->failing_count < TRIAL_CASES ? search->failing_count : TRIAL_CASES;
    double least = fmax(1.0, MIN_EXPLAINED * trial);
    int status = answers_make(search, &both, 0, trial, answer);
    if (status != LRCS_OK ||
        (explained_count(search, answer, trial, 1.0) < least &&
         explained_count(search, answer, trial, factor_median(search, answer, trial)) < least)) {
        return status;
    }
    status =
        answers_make(search, &both, trial, search->failing_count + search->passing_count, answer);
    if (status != LRCS_OK) {
        return status;
    }
    double factor = factor_median(search, answer, search->failing_count);
    search_score try[2] = {mistake_score(search, answer, 1.0), {.score = 0.0}};
    if (factor > 0.0) {
        try[1] = mistake_score(search, answer, factor);
        try[1].penalty = lrcsi_factor_find(factor) ? PENALTY : 2.0 * PENALTY;
    }
    for (int i = 0; i < 2; i++) {
        try[i].penalty += second ? PENALTY : 0.0;
        try[i].score -= try[i].penalty;
        if (try[i].score > best->score) {
            *best = try[i];
            best->first = first;
            best->second = second;
        }
    }
    return LRCS_OK;
}

/* Finds the best explanation of the remaining failures and makes it a finding; *found is 0 if there
   is none.
   1. Single mistakes, until one is certain.
   2. If the best of them explains too little: pairs of a mistake in the areas and one in the
      shading. Mistakes that need a run of their own for each case are left out.
   Status: as lrcs_host_judge. */
static int finding_next(lrcsi_search *search, int *found)
{
    lrcs_host_judgement *job = search->job;
    const lrcsi_mistake *list = lrcsi_mistakes;
    search_score best = {.first = list};
    int status = LRCS_OK;
    *found = 0;
    for (const lrcsi_mistake *a = list; a->name && best.score < CERTAIN && status == LRCS_OK; a++) {
        status = mistake_try(search, a, NULL, &best);
    }
    int pairs = status == LRCS_OK && best.score < PAIRS_BELOW;
    for (const lrcsi_mistake *a = list + 1; pairs && a->name && status == LRCS_OK; a++) {
        for (const lrcsi_mistake *b = list + 1; b->name && status == LRCS_OK; b++) {
            status = a->area && !a->pose && b->shade ? mistake_try(search, a, b, &best) : LRCS_OK;
        }
    }
    if (status != LRCS_OK) {
        return status;
    }
    /* if only a few cases remain, some are explained by chance */
    int chance = job->findings > 0 && best.explained < LATER * job->failed;
    if (chance || best.score <= 0.0 || job->findings == LRCS_HOST_FINDINGS) {
        return LRCS_OK;
    }
    *found = 1;
    return finding_make(search, &best);
}

/* ---- the search ---- */

/* 1. Causes visible in the table. 2. Mistakes of the catalogue, one after the other, as long as one
   explains something. 3. Other causes. 4. Counts of what is left. */
int lrcs_host_judge_explain(lrcs_host_judgement *judgement, lrcs_host_error *error)
{
    size_t count = (size_t)judgement->kit.cases + 1;
    lrcsi_search search = {.job = judgement, .error = error};
    search.failing = malloc(count * sizeof(lrcs_host_kit_case *));
    search.passing = malloc(count * sizeof(lrcs_host_kit_case *));
    search.answer = calloc(count, sizeof(double));
    search.other_answer = calloc(count, sizeof(double));
    search.room = calloc(count, sizeof(double));
    search.explains = calloc(count, 1);
    int room = search.failing && search.passing && search.answer && search.other_answer &&
               search.room && search.explains;
    int status = LRCS_OK;
    if (!room) {
        status = lrcsi_host_out_of_memory(error);
    } else {
        cases_divide(&search);
        lrcsi_symptoms_format(&search);                                                /* 1 */
        for (int found = 1; found && status == LRCS_OK && search.failing_count > 0;) { /* 2 */
            status = finding_next(&search, &found);
            cases_divide(&search);
        }
        status = status == LRCS_OK ? lrcsi_symptoms_rest(&search) : status; /* 3 */
    }
    for (uint32_t i = 0; status == LRCS_OK && i < judgement->kit.cases; i++) { /* 4 */
        int reason = lrcs_host_judge_unexplained(judgement, &judgement->kit.list[i]);
        judgement->not_numbers += reason == LRCS_HOST_UNEXPLAINED_NOT_A_NUMBER;
        judgement->negatives += reason == LRCS_HOST_UNEXPLAINED_NEGATIVE;
        judgement->unexplained += reason == LRCS_HOST_UNEXPLAINED_UNKNOWN;
    }
    free(search.failing);
    free(search.passing);
    free(search.answer);
    free(search.other_answer);
    free(search.room);
    free(search.explains);
    return status;
}
