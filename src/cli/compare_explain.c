/* SPDX-License-Identifier: MIT */
/* Why answers differ: for each mistake of the catalogue, what it would have answered, with and
   without a constant factor, against what was handed in. The one that removes most of the
   differences is a finding; what it leaves is looked at again. An explanation is no proof: it says
   how many cases it explains, and what none explains is said to be unexplained. */
#include "cli/compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define EXPLAIN_PI     3.14159265358979323846
#define REMOVED        0.1  /* what may be left of a difference that is explained */
#define REMOVED_RASTER 0.5  /* the same, where their class allows that much in any case */
#define STRIKING       0.02 /* the same, where few cases speak for a mistake */
#define PRECISE        0.6  /* of the cases that a mistake touches, those that it must explain */
#define PROBE          16u  /* failing cases after which a hopeless mistake is given up */
#define HOPELESS       0.1  /* share of them */
#define WITNESSES      64u  /* passing cases that a mistake must not touch */
#define FACTOR_NEAR    0.02 /* a median ratio this near a known number is that number */
#define FACTOR_PRICE   0.05 /* what a factor must gain to be believed */
#define ENOUGH         3u   /* cases that make a finding by themselves */
#define SKINS_TOUCH    60   /* a distance of 2^-60 m stands for none */
#define BIAS_CASES     20u  /* a factor that all share: of so many cases */
#define BIAS_SHARE     0.75 /* this share is nearer to it than to the truth, and */
#define BIAS_SPREADS   4.0  /* more than half by so many spreads of a fair coin */
#define BIAS_LEAST     1e-4 /* and it is this far from 1 */

typedef struct explain_search {
    compare_job *job;
    compare_case **failing; /* not explained yet */
    compare_case **passing;
    uint32_t failings, passings;
    double *answer; /* of a mistake: the failing cases, then the passing ones */
    double *room;   /* to sort in */
} explain_search;

/* How well a mistake explains. */
typedef struct explain_score {
    const compare_mistake *mistake;
    double factor;
    double score; /* share of the differences that it removes, where it is right */
    uint32_t explained;
} explain_score;

/* ---- one mistake ---- */

static int ascending(const void *a, const void *b)
{
    const double *x = a;
    const double *y = b;
    return (*x > *y) - (*x < *y);
}

static double median_of(double *value, uint32_t count)
{
    qsort(value, count, sizeof *value, ascending);
    return count > 0 ? value[count / 2] : 0.0;
}

static double case_room(const explain_search *search, const compare_case *one, double expected)
{
    double allowed = cli_compare_allowed(one, search->job->grade, search->job->pixels);
    return allowed * (one->sigma_m2 > 0.0 ? fmax(1.0, expected / one->sigma_m2) : 1.0);
}

static int case_explained(const explain_search *search, const compare_case *one, double expected)
{
    double left = fabs(one->theirs_m2 - expected);
    double off = fabs(one->theirs_m2 - one->sigma_m2);
    return left <= REMOVED * off ||
           (left <= REMOVED_RASTER * off && left <= case_room(search, one, expected));
}

/* Would the mistake change the case at all? */
static int case_touched(const explain_search *search, const compare_case *one, double expected)
{
    return fabs(expected - one->sigma_m2) > case_room(search, one, expected);
}

static explain_score score_make(const explain_search *search, const compare_mistake *mistake,
                                double factor)
{
    explain_score score = {.mistake = mistake, .factor = factor};
    uint32_t touched = 0;
    double removed = 0.0;
    for (uint32_t i = 0; i < search->failings; i++) {
        const compare_case *one = search->failing[i];
        double expected = factor * search->answer[i];
        double left = fabs(one->theirs_m2 - expected) / fabs(one->theirs_m2 - one->sigma_m2);
        int right = case_explained(search, one, expected);
        score.explained += (uint32_t)right;
        touched += right || case_touched(search, one, expected);
        removed += right ? 1.0 - 0.5 * fmin(left, 1.0) : 0.0;
    }
    for (uint32_t i = 0; i < search->passings; i++) {
        touched += (uint32_t)(case_touched(search, search->passing[i],
                                           factor * search->answer[search->failings + i]));
    }
    double precise = touched > 0 ? (double)score.explained / touched : 0.0;
    int striking = removed >= (1.0 - 0.5 * STRIKING) * score.explained;
    if (score.explained > 0 && (score.explained >= ENOUGH || striking) && precise >= PRECISE) {
        score.score = precise * removed / search->failings;
    }
    return score;
}

/* ---- factors ---- */

typedef struct explain_factor {
    double value;
    const char *text;
} explain_factor;

static const explain_factor factor_known[] = {
    {0.25 / EXPLAIN_PI, "4 pi is missing"},
    {4.0 * EXPLAIN_PI, "4 pi counts twice"},
    {0.25, "4 is missing of 4 pi"},
    {1.0 / EXPLAIN_PI, "pi is missing of 4 pi, or a reflectance is divided by pi once more"},
    {EXPLAIN_PI, "pi counts twice, or a reflectance in place of a BRDF"},
    {0.5, "half of it: 2 pi in place of 4 pi"},
    {2.0, "twice of it: both triangles or both sides counted?"},
    {4.0, "4 times: the side of the window taken for its half, or no half pixel?"},
    {1e4, "cm2 in place of m2"},
    {1e6, "mm2 in place of m2"},
    {1e-6, "millimetres taken for metres"},
    {1e-4, "centimetres taken for metres"}};

static const explain_factor *factor_find(double value)
{
    for (size_t i = 0; i < sizeof factor_known / sizeof factor_known[0]; i++) {
        if (fabs(value / factor_known[i].value - 1.0) <= FACTOR_NEAR) {
            return &factor_known[i];
        }
    }
    return NULL;
}

/* The median ratio of what was handed in to what the mistake answers, over the first failing cases;
   a known number where it is near one. */
static double factor_median(const explain_search *search, uint32_t failings)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < failings; i++) {
        if (search->answer[i] > 0.0 && search->failing[i]->theirs_m2 > 0.0) {
            search->room[count++] = search->failing[i]->theirs_m2 / search->answer[i];
        }
    }
    double median = median_of(search->room, count);
    const explain_factor *known = factor_find(median);
    return known ? known->value : median;
}

/* ---- the catalogue ---- */

static uint32_t explained_count(const explain_search *search, uint32_t failings, double factor)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < failings; i++) {
        count += (uint32_t)case_explained(search, search->failing[i], factor * search->answer[i]);
    }
    return count;
}

/* Is a mistake worth going on with, after so many failing cases? */
static int answers_hopeful(const explain_search *search, uint32_t failings)
{
    double least = fmax(1.0, HOPELESS * failings);
    return explained_count(search, failings, 1.0) >= least ||
           explained_count(search, failings, factor_median(search, failings)) >= least;
}

/* The answers of a mistake; 1 where it is worth scoring, 0 where not, -1 with the message. */
static int answers_make(const explain_search *search, const compare_mistake *mistake)
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

static int mistake_try(const explain_search *search, const compare_mistake *mistake,
                       explain_score *best)
{
    int worth = answers_make(search, mistake);
    if (worth <= 0) {
        return worth;
    }
    explain_score plain = score_make(search, mistake, 1.0);
    double factor = factor_median(search, search->failings);
    explain_score scaled = {.mistake = mistake};
    if (factor > 0.0) {
        scaled = score_make(search, mistake, factor);
        scaled.score -= factor_find(factor) ? FACTOR_PRICE : 2.0 * FACTOR_PRICE;
    }
    *best = plain.score > best->score ? plain : *best;
    *best = scaled.score > best->score ? scaled : *best;
    return 1;
}

/* ---- findings ---- */

/* What is left of the differences that it explains, in the median; marks their cases. */
static double finding_rest(const explain_search *search, const explain_score *best, int mark)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < search->failings; i++) {
        compare_case *one = search->failing[i];
        double expected = best->factor * search->answer[i];
        if (case_explained(search, one, expected)) {
            search->room[count++] =
                fabs(one->theirs_m2 - expected) / fabs(one->theirs_m2 - one->sigma_m2);
            one->explained = mark;
        }
    }
    return median_of(search->room, count);
}

static void factor_say(const compare_job *job, double factor, char *text, size_t size)
{
    const explain_factor *known = factor_find(factor);
    double n = job->pixels;
    double fence = (n / (n - 1.0)) * (n / (n - 1.0));
    if (known) {
        snprintf(text, size, "%s", known->text);
    } else if (fabs(factor / fence - 1.0) < 0.2 / n || fabs(factor * fence - 1.0) < 0.2 / n) {
        snprintf(text, size, "pixel area: N - 1 in place of N pixels a side, or the reverse");
    } else {
        snprintf(text, size, "pixel area, the side of the window, or a unit?");
    }
}

static void finding_say(const compare_job *job, const explain_score *best, compare_finding *finding)
{
    char factor[256] = "";
    finding->factor = best->factor;
    if (best->factor == 1.0) {
        snprintf(finding->text, sizeof finding->text, "%s", best->mistake->text);
        return;
    }
    factor_say(job, best->factor, factor, sizeof factor);
    if (best->mistake == &cli_compare_mistakes[0]) {
        const explain_factor *known = factor_find(best->factor);
        finding->name = known ? "constant" : "pixel-area";
        finding->name = known == &factor_known[0] ? "missing-4-pi" : finding->name;
        snprintf(finding->text, sizeof finding->text, "%.6g times the truth everywhere: %s",
                 best->factor, factor);
    } else {
        snprintf(finding->text, sizeof finding->text, "%s; and %.6g times that: %s",
                 best->mistake->text, best->factor, factor);
    }
}

/* The best explanation of what fails still; 1 where there is one, 0 where not, -1 on failure. */
static int finding_next(explain_search *search)
{
    compare_job *job = search->job;
    explain_score best = {.score = 0.0};
    for (const compare_mistake *mistake = cli_compare_mistakes; mistake->name; mistake++) {
        if (mistake_try(search, mistake, &best) < 0) {
            return -1;
        }
    }
    if (best.score <= 0.0 || job->findings == COMPARE_FINDINGS) {
        return 0;
    }
    for (uint32_t i = 0; i < search->failings; i++) {
        if (cli_compare_answer(&job->kit, search->failing[i], best.mistake, &search->answer[i])) {
            return -1;
        }
    }
    compare_finding *finding = &job->finding[job->findings++];
    finding->name = best.mistake->name;
    finding->explained = best.explained;
    finding_say(job, &best, finding);
    finding->rest = finding_rest(search, &best, (int)job->findings);
    return 1;
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
static void cases_part(explain_search *search)
{
    compare_job *job = search->job;
    search->failings = search->passings = 0;
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        compare_case *one = &job->kit.list[i];
        if (!one->given || !isfinite(one->theirs_m2) || (uint32_t)one->tier > job->tier) {
            continue;
        }
        if (!cli_compare_failed(job, one)) {
            search->passing[search->passings++] = one;
        } else if (one->explained == 0) {
            search->failing[search->failings++] = one;
        }
    }
    list_shuffle(search->failing, search->failings);
    list_shuffle(search->passing, search->passings);
    search->passings = search->passings < WITNESSES ? search->passings : WITNESSES;
}

/* ---- what needs no hypothesis ---- */

static compare_finding *finding_add(compare_job *job, const char *name)
{
    compare_finding *finding = &job->finding[job->findings];
    job->findings += job->findings < COMPARE_FINDINGS;
    *finding = (compare_finding){.name = name, .factor = 1.0};
    return finding;
}

/* Marks the unexplained failing cases of a class, and says so. */
static void class_say(explain_search *search, int grade, const char *name, const char *text)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < search->failings; i++) {
        count += search->failing[i]->grade == grade;
    }
    if (count == 0 || search->job->findings == COMPARE_FINDINGS) {
        return;
    }
    compare_finding *finding = finding_add(search->job, name);
    for (uint32_t i = 0; i < search->failings; i++) {
        if (search->failing[i]->grade == grade) {
            search->failing[i]->explained = (int)search->job->findings;
        }
    }
    finding->explained = count;
    finding->rest = 1.0;
    snprintf(finding->text, sizeof finding->text, "%s", text);
}

/* Skins 2^-K m apart in a scene 8 m deep are called skins-K, those in one place by other names; 0
   for scenes without. */
static int skins_of(const compare_job *job, const compare_case *one)
{
    const char *name = job->kit.scene[one->scene].name;
    int coincident = strcmp(name, "twins") == 0 || strcmp(name, "two-faced") == 0;
    return strncmp(name, "skins-", 6) == 0 ? atoi(name + 6) : coincident ? SKINS_TOUCH : 0;
}

/* Where most of what fails are skins close to each other, the depths are too coarse. */
static void depth_say(explain_search *search)
{
    int coarsest = SKINS_TOUCH;
    uint32_t count = 0;
    for (uint32_t i = 0; i < search->failings; i++) {
        int skins = skins_of(search->job, search->failing[i]);
        coarsest = skins > 0 && skins < coarsest ? skins : coarsest;
        count += skins > 0;
    }
    if (2 * count <= search->failings || search->job->findings == COMPARE_FINDINGS) {
        return;
    }
    int touch = coarsest == SKINS_TOUCH;
    compare_finding *finding =
        finding_add(search->job, touch ? "coincident-skins" : "depth-precision");
    for (uint32_t i = 0; i < search->failings; i++) {
        if (skins_of(search->job, search->failing[i]) > 0) {
            search->failing[i]->explained = (int)search->job->findings;
        }
    }
    finding->explained = count;
    finding->rest = 1.0;
    if (touch) {
        snprintf(finding->text, sizeof finding->text,
                 "coincident skins: of facets in one place the wrong one is seen (a front beats a "
                 "back, then the lower index wins)");
    } else {
        snprintf(finding->text, sizeof finding->text,
                 "depth precision: skins 2^-%d m apart in a scene 8 m deep are not told apart: a "
                 "depth of some %d bits or fewer",
                 coarsest, coarsest + 3);
    }
}

/* A factor that all answers share, though each by itself is within its class. */
static void bias_say(explain_search *search)
{
    compare_job *job = search->job;
    uint32_t count = 0;
    uint32_t nearer = 0;
    char text[256];
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        const compare_case *one = &job->kit.list[i];
        if (one->given && (uint32_t)one->tier <= job->tier && one->sigma_m2 > 0.0 &&
            one->grade > COMPARE_EXACT && isfinite(one->theirs_m2)) {
            search->room[count++] = one->theirs_m2 / one->sigma_m2;
        }
    }
    double median = median_of(search->room, count);
    for (uint32_t i = 0; i < count; i++) {
        nearer += fabs(search->room[i] - median) < fabs(search->room[i] - 1.0);
    }
    double least = fmax(BIAS_SHARE, 0.5 + 0.5 * BIAS_SPREADS / sqrt(fmax(count, 1.0)));
    if (count < BIAS_CASES || nearer < least * count || fabs(median - 1.0) < BIAS_LEAST ||
        job->findings == COMPARE_FINDINGS) {
        return;
    }
    factor_say(job, median, text, sizeof text);
    compare_finding *finding = finding_add(job, "pixel-area");
    finding->factor = median;
    finding->rest = 1.0;
    job->biased = 1;
    for (uint32_t i = 0; i < search->failings; i++) {
        compare_case *one = search->failing[i];
        if (case_explained(search, one, median * one->sigma_m2)) {
            one->explained = (int)job->findings;
            finding->explained++;
        }
    }
    snprintf(
        finding->text, sizeof finding->text,
        "a constant factor of %.6g, within what most cases are allowed but in %.0f %% of them: "
        "%s",
        median, 100.0 * nearer / count, text);
}

/* ---- the search ---- */

static int findings_make(explain_search *search)
{
    int more = 1;
    cases_part(search);
    while (more > 0 && search->failings > 0) {
        more = finding_next(search);
        cases_part(search);
    }
    if (more < 0) {
        return CLI_FAILED;
    }
    depth_say(search);
    cases_part(search);
    class_say(search, COMPARE_FLOAT, "single-precision",
              "single precision: off by no more than some of its roundings");
    cases_part(search);
    class_say(search, COMPARE_RASTER, "raster",
              "a raster's pixels: off by no more than a pixel along the outlines");
    cases_part(search);
    if (search->job->findings == 0) {
        bias_say(search);
        cases_part(search);
    }
    search->job->unexplained = search->failings;
    return 0;
}

int cli_compare_explain(compare_job *job)
{
    size_t count = (size_t)job->kit.cases + 1;
    explain_search search = {.job = job};
    search.failing = malloc(count * sizeof(compare_case *));
    search.passing = malloc(count * sizeof(compare_case *));
    search.answer = malloc(count * sizeof(double));
    search.room = malloc(count * sizeof(double));
    int code = search.failing && search.passing && search.answer && search.room
                   ? findings_make(&search)
                   : cli_out_of_memory();
    free(search.failing);
    free(search.passing);
    free(search.answer);
    free(search.room);
    return code;
}
