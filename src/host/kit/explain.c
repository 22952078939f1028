/* SPDX-License-Identifier: MIT */
/* Finds why answers differ: compares the submitted answers with those that each mistake of the
   catalogue would produce, with and without a constant factor. The mistake that removes most of the
   differences is a finding, described in a sentence; the remaining differences are examined again.
   An explanation is not a proof: the report states how many cases it explains, and which cases
   remain unexplained. */
#include "host/kit/search.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "base/constant.h"
#include "base/sort.h"
#include "host/fail.h"

#define REMOVED        0.1  /* fraction of a difference that may remain if it is explained */
#define REMOVED_RASTER 0.5  /* that fraction where the class of the case allows so much anyway */
#define CLOSE_FIT      0.02 /* that fraction where few cases support a mistake */
#define PRECISE        0.6  /* fraction of the cases changed by a mistake that it must explain */
#define PASSING_SAMPLE 64u  /* number of passing cases that a mistake must not change */
#define ENOUGH         3u   /* number of cases that suffice for a finding */
#define FACTOR_NEAR    0.02 /* a ratio this near to a known number is taken for that number */
#define TIED           2e-3 /* scores that differ by less are equally good */
#define TIES_MOST      3u   /* number of named mistakes that explain equally well */
#define CLIPPED        0.9  /* fraction of the remaining cases that lose something at the window */
#define TRIAL_CASES    16u  /* failing cases after which a mistake that explains few is abandoned */
#define MIN_EXPLAINED  0.1  /* fraction of them that it must explain */
#define LATER          0.1  /* fraction of all failing cases that a later finding must explain */
#define PENALTY        0.05 /* the gain by which a factor or a second mistake is justified */
#define CERTAIN        0.94 /* a score above which the search for a better one stops */
#define PAIRS_BELOW    0.9  /* if one mistake explains less than this, pairs are tried */

/* ---- constant factors ---- */

typedef struct factor_entry {
    double value;
    const char *name, *text;
} factor_entry;

static const factor_entry factors[] = {
    {0.25 / LRCS_PI, "missing-4-pi", "4 pi is missing"},
    {LRCS_FOUR_PI, "twice-4-pi", "4 pi counts twice"},
    {0.25, "missing-4", "4 is missing of 4 pi"},
    {1.0 / LRCS_PI, "missing-pi", "pi is missing of 4 pi, or f_r is divided by pi once more"},
    {LRCS_PI, "twice-pi", "pi counts twice, or a reflectance in place of f_r"},
    {0.5, "half", "2 pi in place of 4 pi, or half the area"},
    {2.0, "twice", "something counts twice: both triangles, both sides?"},
    {4.0, "four-times", "the side of a pixel or of the window is taken twice as long"},
    {1e4, "centimetres", "cm2 in place of m2"},
    {1e6, "millimetres", "mm2 in place of m2"},
    {1e-4, "from-centimetres", "metres taken for centimetres"},
    {1e-6, "from-millimetres", "metres taken for millimetres"}};

static const factor_entry *factor_find(double factor)
{
    for (size_t i = 0; i < sizeof factors / sizeof factors[0]; i++) {
        if (fabs(factor / factors[i].value - 1.0) <= FACTOR_NEAR) {
            return &factors[i];
        }
    }
    return NULL;
}

const char *lrcsi_factor_name(double factor)
{
    const factor_entry *entry = factor_find(factor);
    return entry ? entry->name : "pixel-area";
}

const char *lrcsi_factor_text(const lrcs_host_judgement *job, double factor)
{
    const factor_entry *entry = factor_find(factor);
    double n = job->pixels;
    double off_by_one = (n / (n - 1.0)) * (n / (n - 1.0));
    int fences =
        fabs(factor / off_by_one - 1.0) < 0.2 / n || fabs(factor * off_by_one - 1.0) < 0.2 / n;
    return entry    ? entry->text
           : fences ? "pixel area: N - 1 in place of N pixels a side, or the reverse"
                    : "pixel area, the side of the window, or a unit?";
}

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
static void search_part(lrcsi_search *search)
{
    lrcs_host_judgement *job = search->job;
    search->failing_count = search->passing_count = 0;
    search->any_nonzero = 0;
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        lrcs_host_kit_case *one = &job->kit.list[i];
        if (!one->given || !isfinite(one->theirs_m2) || !lrcs_host_judge_asked(job, one)) {
            continue;
        }
        if (!lrcs_host_judge_failed(job, one)) {
            search->passing[search->passing_count++] = one;
        } else if (one->explained == 0) {
            search->failing[search->failing_count++] = one;
            search->any_nonzero |= one->theirs_m2 != 0.0;
        }
    }
    list_shuffle(search->failing, search->failing_count);
    list_shuffle(search->passing, search->passing_count);
    uint32_t witnesses =
        search->passing_count < PASSING_SAMPLE ? search->passing_count : PASSING_SAMPLE;
    search->weight = witnesses > 0 ? (double)search->passing_count / witnesses : 0.0;
    search->passing_count = witnesses;
}

double lrcsi_search_median(double *value, uint32_t count)
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
    double left = fabs(one->theirs_m2 - expected);
    double off = fabs(one->theirs_m2 - one->sigma_m2);
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

/* How well a mistake's answers, times a factor, explain the submitted ones. */
static search_score mistake_score(const lrcsi_search *search, double factor)
{
    search_score score = {.factor = factor};
    double changed = 0.0;
    double removed = 0.0;
    uint32_t uninformative = 0;
    for (uint32_t i = 0; i < search->failing_count; i++) {
        const lrcs_host_kit_case *one = search->failing[i];
        double expected = factor * search->answer[i];
        double left = fabs(one->theirs_m2 - expected) / fabs(one->theirs_m2 - one->sigma_m2);
        int right = lrcsi_search_explained(search, one, expected);
        score.explained += (uint32_t)right;
        if (right && search->any_nonzero && one->theirs_m2 == 0.0) {
            uninformative++; /* no evidence if others are not 0: many mistakes make facets vanish */
            continue;
        }
        changed += right || case_touched(search, one, expected);
        removed += right ? 1.0 - 0.5 * fmin(left, 1.0) : 0.0;
    }
    for (uint32_t i = 0; i < search->passing_count; i++) {
        double expected = factor * search->answer[search->failing_count + i];
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

/* The median ratio of submitted answers to those of the mistake, over the first failing cases; if
   it is near a known number, that number. */
static double factor_median(const lrcsi_search *search, uint32_t failing_count, int *known)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < failing_count; i++) {
        if (search->answer[i] > 0.0 && search->failing[i]->theirs_m2 > 0.0) {
            search->room[count++] = search->failing[i]->theirs_m2 / search->answer[i];
        }
    }
    double median = lrcsi_search_median(search->room, count);
    const factor_entry *entry = factor_find(median);
    *known = entry != NULL;
    return entry ? entry->value : median;
}

/* ---- the answers of a mistake ---- */

static uint32_t explained_count(const lrcsi_search *search, uint32_t failing_count, double factor)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < failing_count; i++) {
        count += (uint32_t)lrcsi_search_explained(search, search->failing[i],
                                                  factor * search->answer[i]);
    }
    return count;
}

/* Computes the answer of a mistake to one of the failing cases or, counted after them, of the
   passing ones. */
static int answer_make(const lrcsi_search *search, const lrcsi_mistake *mistake, uint32_t i)
{
    uint32_t failing_count = search->failing_count;
    lrcs_host_kit_case *one =
        i < failing_count ? search->failing[i] : search->passing[i - failing_count];
    return lrcsi_mistake_answer(&search->job->kit, one, mistake, &search->answer[i], search->error);
}

/* Computes all answers of a mistake, or gives up after a few if they explain hardly anything: 1, or
   0 if it gave up. */
static int answers_make(const lrcsi_search *search, const lrcsi_mistake *mistake, int give_up)
{
    uint32_t probe = search->failing_count < TRIAL_CASES ? search->failing_count : TRIAL_CASES;
    for (uint32_t i = 0; i < search->failing_count + search->passing_count; i++) {
        int status = answer_make(search, mistake, i);
        if (status != LRCS_OK) {
            return status;
        }
        int known;
        double least = fmax(1.0, MIN_EXPLAINED * probe);
        if (give_up && i + 1 == probe && explained_count(search, probe, 1.0) < least &&
            explained_count(search, probe, factor_median(search, probe, &known)) < least) {
            return 0;
        }
    }
    return 1;
}

/* ---- a finding in words ---- */

/* Adds to the sentence of a finding, cut at its size. */
__attribute__((format(printf, 2, 3))) static void finding_append(lrcs_host_finding *finding,
                                                                 const char *format, ...)
{
    size_t used = strlen(finding->text);
    va_list list;
    va_start(list, format);
    vsnprintf(finding->text + used, sizeof finding->text - used, format, list);
    va_end(list);
}

/* The next finding, empty; NULL if there is no room for one. */
static lrcs_host_finding *finding_add(lrcs_host_judgement *job, const char *name)
{
    if (job->findings == LRCS_HOST_FINDINGS) {
        return NULL;
    }
    lrcs_host_finding *finding = &job->finding[job->findings++];
    *finding = (lrcs_host_finding){.name = name, .factor = 1.0, .rest = 1.0};
    return finding;
}

uint32_t lrcsi_search_holds(const lrcsi_search *search)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < search->failing_count; i++) {
        count += search->explains[i];
    }
    return count;
}

lrcs_host_finding *lrcsi_search_find(lrcsi_search *search, const char *name, const char *format,
                                     ...)
{
    va_list list;
    lrcs_host_finding *finding = finding_add(search->job, name);
    if (!finding) {
        return NULL;
    }
    va_start(list, format);
    vsnprintf(finding->text, sizeof finding->text, format, list);
    va_end(list);
    for (uint32_t i = 0; i < search->failing_count; i++) {
        if (search->explains[i]) {
            search->failing[i]->explained = (int)search->job->findings;
        }
    }
    finding->explained = lrcsi_search_holds(search);
    search_part(search);
    return finding;
}

/* A mistake combined with the shading of another one; the second may be NULL. */
static lrcsi_mistake mistake_both(const lrcsi_mistake *first, const lrcsi_mistake *second)
{
    lrcsi_mistake both = *first;
    if (second) {
        both.shade = second->shade;
        both.at = second->at;
    }
    return both;
}

/* The median share of the differences that remains in the cases that it explains; also marks these
   cases. */
static double finding_rest(const lrcsi_search *search, const search_score *best, int mark)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < search->failing_count; i++) {
        lrcs_host_kit_case *one = search->failing[i];
        double expected = best->factor * search->answer[i];
        if (lrcsi_search_explained(search, one, expected)) {
            search->room[count++] =
                fabs(one->theirs_m2 - expected) / fabs(one->theirs_m2 - one->sigma_m2);
            one->explained = mark;
        }
    }
    return lrcsi_search_median(search->room, count);
}

static void finding_say(const lrcs_host_judgement *job, const search_score *best,
                        lrcs_host_finding *finding)
{
    finding->factor = best->factor;
    if (best->first == lrcsi_mistakes) {
        finding->name = lrcsi_factor_name(best->factor);
        finding_append(finding, "%.6g times the truth everywhere: %s", best->factor,
                       lrcsi_factor_text(job, best->factor));
        return;
    }
    finding_append(finding, "%s", best->first->text);
    if (best->second) {
        finding_append(finding, "; and %s", best->second->text);
    }
    if (best->factor != 1.0) {
        finding_append(finding, "; and %.6g times that: %s", best->factor,
                       lrcsi_factor_text(job, best->factor));
    }
}

/* Computes the answers of a mistake as long as it explains exactly the failing cases of a finding:
   1 if it explains these and no others, 0 if not. */
static int mistake_fits(const lrcsi_search *search, const lrcsi_mistake *mistake, double factor,
                        int mark)
{
    for (uint32_t i = 0; i < search->failing_count + search->passing_count; i++) {
        int status = answer_make(search, mistake, i);
        if (status != LRCS_OK) {
            return status;
        }
        if (i < search->failing_count &&
            lrcsi_search_explained(search, search->failing[i], factor * search->answer[i]) !=
                (search->failing[i]->explained == mark)) {
            return 0;
        }
    }
    return 1;
}

/* Names the other mistakes that explain the same cases equally well. */
static int ties_say(const lrcsi_search *search, const search_score *best,
                    lrcs_host_finding *finding)
{
    uint32_t ties = 0;
    if (best->first == lrcsi_mistakes) {
        return 0;
    }
    for (const lrcsi_mistake *a = lrcsi_mistakes + 1; a->name && ties < TIES_MOST; a++) {
        lrcsi_mistake both = mistake_both(a, best->second);
        int fits = 0;
        if (a != best->first && a != best->second) {
            fits = mistake_fits(search, &both, best->factor, (int)search->job->findings);
        }
        if (fits < 0) {
            return fits;
        }
        double score = fits ? mistake_score(search, best->factor).score - best->penalty : 0.0;
        if (fits && fabs(score - best->score) <= TIED) {
            finding_append(finding, "%s%s", ties++ > 0 ? "; " : "; or, equally well: ", a->text);
        }
    }
    return 0;
}

/* If the frame is wrong, the kit's square no longer contains the scene: most of the remaining cases
   show less than they should, because part of the scene is outside. */
static void clipped_say(const lrcsi_search *search, const search_score *best,
                        lrcs_host_finding *finding)
{
    int mark = (int)search->job->findings;
    uint32_t left = 0;
    uint32_t less = 0;
    for (uint32_t i = 0; i < search->failing_count; i++) {
        const lrcs_host_kit_case *one = search->failing[i];
        left += one->explained != mark;
        less += one->explained != mark && one->theirs_m2 < best->factor * search->answer[i];
    }
    if (less == 0 || left > finding->explained || less < CLIPPED * left) {
        return;
    }
    for (uint32_t i = 0; i < search->failing_count; i++) {
        lrcs_host_kit_case *one = search->failing[i];
        int cut = one->explained == 0 && one->theirs_m2 < best->factor * search->answer[i];
        one->explained = cut ? mark : one->explained;
    }
    finding->explained += less;
    finding_append(finding,
                   "; in %lu cases less than that: part of the scene is outside the window",
                   (unsigned long)less);
}

/* Makes the best explanation a finding and marks its cases. */
static int finding_make(lrcsi_search *search, const search_score *best)
{
    lrcsi_mistake both = mistake_both(best->first, best->second);
    int made = answers_make(search, &both, 0);
    if (made < 0) {
        return made;
    }
    lrcs_host_finding *finding = finding_add(search->job, best->first->name);
    if (!finding) {
        return 0;
    }
    finding->explained = best->explained;
    finding_say(search->job, best, finding);
    finding->rest = finding_rest(search, best, (int)search->job->findings);
    int status = ties_say(search, best, finding);
    if (status == LRCS_OK && best->first->turn) {
        made = answers_make(search, &both, 0);
        if (made < 0) {
            return made;
        }
        clipped_say(search, best, finding);
    }
    return status;
}

/* ---- the best explanation ---- */

/* Keeps the mistake if it explains more than the best one so far. */
static int mistake_try(const lrcsi_search *search, const lrcsi_mistake *first,
                       const lrcsi_mistake *second, search_score *best)
{
    lrcsi_mistake both = mistake_both(first, second);
    int worth = answers_make(search, &both, 1);
    int known;
    if (worth <= 0) {
        return worth;
    }
    double factor = factor_median(search, search->failing_count, &known);
    search_score try[2] = {mistake_score(search, 1.0), {.score = 0.0}};
    if (factor > 0.0) {
        try[1] = mistake_score(search, factor);
        try[1].penalty = known ? PENALTY : 2.0 * PENALTY;
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
    return 0;
}

/* Finds the best explanation of the remaining failures and makes it a finding; 1 if there is one, 0
   if not.
   1. Single mistakes, until one is certain.
   2. If the best of them explains too little: pairs of a mistake in the areas and one in the
      shading. Mistakes that need a run of their own for each case are left out. */
static int finding_next(lrcsi_search *search)
{
    lrcs_host_judgement *job = search->job;
    const lrcsi_mistake *list = lrcsi_mistakes;
    search_score best = {.first = list};
    int status = LRCS_OK;
    for (const lrcsi_mistake *a = list; a->name && best.score < CERTAIN && status == LRCS_OK; a++) {
        status = mistake_try(search, a, NULL, &best);
    }
    int pairs = status == LRCS_OK && best.score < PAIRS_BELOW;
    for (const lrcsi_mistake *a = list + 1; pairs && a->name && status == LRCS_OK; a++) {
        for (const lrcsi_mistake *b = list + 1; b->name && status == LRCS_OK; b++) {
            status = a->area && !a->turn && b->shade ? mistake_try(search, a, b, &best) : LRCS_OK;
        }
    }
    if (status != LRCS_OK) {
        return status;
    }
    /* if only a few cases remain, some are explained by chance */
    int chance = job->findings > 0 && best.explained < LATER * job->failed;
    if (chance || best.score <= 0.0 || job->findings == LRCS_HOST_FINDINGS) {
        return 0;
    }
    status = finding_make(search, &best);
    return status == LRCS_OK ? 1 : status;
}

/* ---- the search ---- */

/* 1. Causes visible in the table. 2. Mistakes of the catalogue, one after the other, as long as one
   explains something. 3. Other causes. 4. Counts of what is left. */
static int findings_make(lrcsi_search *search)
{
    lrcs_host_judgement *job = search->job;
    int more = 1;
    search_part(search);
    lrcsi_symptoms_format(search);
    while (more > 0 && search->failing_count > 0) {
        more = finding_next(search);
        search_part(search);
    }
    int status = more < 0 ? more : lrcsi_symptoms_rest(search);
    if (status != LRCS_OK) {
        return status;
    }
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        int lack = lrcs_host_judge_lack(job, &job->kit.list[i]);
        job->not_numbers += lack == LRCS_HOST_LACK_NUMBER;
        job->negatives += lack == LRCS_HOST_LACK_SIGN;
        job->unexplained += lack == LRCS_HOST_LACK_REASON;
    }
    return LRCS_OK;
}

int lrcs_host_judge_explain(lrcs_host_judgement *judgement, lrcs_host_error *error)
{
    size_t count = (size_t)judgement->kit.cases + 1;
    lrcsi_search search = {.job = judgement, .error = error};
    search.failing = malloc(count * sizeof(lrcs_host_kit_case *));
    search.passing = malloc(count * sizeof(lrcs_host_kit_case *));
    search.answer = calloc(count, sizeof(double));
    search.room = calloc(count, sizeof(double));
    search.explains = calloc(count, 1);
    int status = search.failing && search.passing && search.answer && search.room && search.explains
                     ? findings_make(&search)
                     : lrcsi_host_fail(error, LRCS_E_SYSTEM, "out of memory");
    free(search.failing);
    free(search.passing);
    free(search.answer);
    free(search.room);
    free(search.explains);
    return status;
}
