/* SPDX-License-Identifier: MIT */
/* Causes recognized without a mistake of the catalogue. Some are visible in the table itself: only
   zeros, another unit than the column states, rows shifted by one, too few digits. Others follow
   from which cases fail, and by how much: depths that are too coarse, single precision, a raster,
   or a factor that all answers share. */
#include "cli/compare/compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define MOST         0.9   /* share of the failing cases that a cause must explain */
#define LEAST        5u    /* number of failing cases; fewer prove nothing */
#define DIGITS       9     /* with this many digits rounding is harmless */
#define SAME_DIGIT   1e-11 /* relative: a number this near to one with few digits is taken for it */
#define FIGHTS_MOST  256u  /* scenes with more facets are not searched for coplanar facets */
#define SKINS_TOUCH  60    /* a distance of 2^-60 m counts as none */
#define COARSEST     16.0  /* pixels per side of the coarsest raster considered, */
#define COARSE_SHARE 0.012 /* and the median share of the allowed difference: 0.02 is usual */
#define BIAS_CASES   20u   /* a factor that all share: at least this many cases */
#define BIAS_SHARE   0.75  /* of which this share lies nearer to the factor than to the truth, */
#define BIAS_SPREADS 4.0   /* more than half by so many deviations of a fair coin, */
#define BIAS_LEAST   1e-4  /* and the factor differs from 1 by this much */

/* The answer to a case, interpreted in another way; NaN if not possible. */
typedef double format_way(const compare_job *job, const compare_case *one, double at);

/* ---- ways ---- */

/* The number taken as `at` times log10 of m2, whichever its column. */
static double way_decibels(const compare_job *job, const compare_case *one, double at)
{
    (void)job;
    return pow(10.0, one->printed / at);
}

static double way_plain(const compare_job *job, const compare_case *one, double at)
{
    (void)job;
    (void)at;
    return one->printed;
}

/* The answer `at` lines below. */
static double way_moved(const compare_job *job, const compare_case *one, double at)
{
    double line = (double)(one - job->kit.list) + at;
    int inside = line >= 0.0 && line < job->kit.cases;
    const compare_case *other = inside ? &job->kit.list[(uint32_t)line] : NULL;
    return other && other->given ? other->theirs_m2 : (double)NAN;
}

/* ---- findings ---- */

/* Is sigma_m2 within the allowed deviation of the case's true value? */
static int answer_matches(const compare_job *job, const compare_case *one, double sigma_m2)
{
    return fabs(sigma_m2 - one->sigma_m2) <= cli_compare_allowed(one, job->grade, job->pixels);
}

/* 1 if the current cause explains most of the failures. */
static int holds_most(const compare_search *search)
{
    uint32_t right = cli_search_holds(search);
    return right >= LEAST && right >= MOST * search->failings;
}

/* Makes a finding if most answers are right when interpreted in another way. */
static void format_say(compare_search *search, const char *name, const char *text, format_way *way,
                       double at)
{
    for (uint32_t i = 0; i < search->failings; i++) {
        const compare_case *one = search->failing[i];
        search->holds[i] =
            (unsigned char)answer_matches(search->job, one, way(search->job, one, at));
    }
    compare_finding *finding =
        holds_most(search) ? cli_search_find(search, name, "%s", text) : NULL;
    for (uint32_t i = 0; finding && i < search->job->kit.cases; i++) {
        compare_case *one =
            &search->job->kit.list[i]; /* an invalid number may become a valid one */
        if (one->given && !isfinite(one->theirs_m2) && one->explained == 0 &&
            cli_compare_failed(search->job, one) &&
            answer_matches(search->job, one, way(search->job, one, at))) {
            one->explained = (int)search->job->findings;
            finding->explained++;
        }
    }
}

/* ---- digits ---- */

/* The step at a number of the numbers with so many digits, significant or after the decimal
   point. */
static double digit_step(double value, int digits, int significant)
{
    double whole = significant && value != 0.0 ? floor(log10(fabs(value))) + 1.0 : 0.0;
    return pow(10.0, whole - digits);
}

/* 1 if no answer has more digits than these. */
static int digits_all(const compare_job *job, int digits, int significant)
{
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        const compare_case *one = &job->kit.list[i];
        double value = one->given ? one->printed : 0.0;
        double step = digit_step(value, digits, significant);
        double steps = floor(value / step + 0.5);
        if (isfinite(value) && fabs(value - steps * step) > SAME_DIGIT * fabs(value)) {
            return 0;
        }
    }
    return 1;
}

/* Makes a finding if all answers have so few digits and rounding, by half a unit of the last digit,
   explains most failures. */
static int digits_say(compare_search *search, int digits, int significant)
{
    const compare_job *job = search->job;
    for (uint32_t i = 0; i < search->failings; i++) {
        const compare_case *one = search->failing[i];
        double value = job->decibels ? 10.0 * log10(one->sigma_m2) : one->sigma_m2;
        double half = 0.5 * digit_step(value, digits, significant);
        double room = job->decibels ? one->sigma_m2 * (pow(10.0, half / 10.0) - 1.0) : half;
        search->holds[i] = fabs(one->theirs_m2 - one->sigma_m2) <=
                           room + cli_compare_allowed(one, job->grade, job->pixels);
    }
    return holds_most(search) &&
           cli_search_find(search, "few-digits",
                           "few digits: every answer is rounded to %d %s%s: print %%.9g or more",
                           digits, significant ? "digit" : "decimal", digits == 1 ? "" : "s");
}

/* Finds the smallest number of digits that suffices for all answers. */
static void digits_try(compare_search *search)
{
    for (int significant = 0; significant < 2; significant++) {
        int digits = significant;
        while (digits < DIGITS && !digits_all(search->job, digits, significant)) {
            digits++;
        }
        if (digits < DIGITS && digits_say(search, digits, significant)) {
            return;
        }
    }
}

/* ---- nothing ---- */

/* 1 if every answer is 0 although something is visible. */
static int answers_blank(const compare_search *search)
{
    const compare_job *job = search->job;
    uint32_t given = 0;
    int blank = search->failings > 0;
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        const compare_case *one = &job->kit.list[i];
        int counts = one->given && cli_compare_asked(job, one);
        given += (uint32_t)counts;
        blank &= !counts || one->theirs_m2 == 0.0;
    }
    return given > 0 && blank;
}

void cli_compare_format(compare_search *search)
{
    if (answers_blank(search)) {
        memset(search->holds, 1, search->failings);
        cli_search_find(search, "blank",
                        "every answer is 0: nothing drawn, everything culled or outside the "
                        "window, or the buffer never read back");
        return;
    }
    if (search->job->decibels) {
        format_say(search, "m2-as-dbsm", "the column sigma_dbsm holds m2, not dBsm", way_plain,
                   0.0);
    } else {
        format_say(search, "dbsm-as-m2", "the column sigma_m2 holds dBsm, not m2", way_decibels,
                   10.0);
    }
    format_say(search, "20-log10", "decibels: 20 log10 in place of 10 log10", way_decibels, 20.0);
    format_say(search, "row-before", "rows: every answer stands one line too early", way_moved,
               -1.0);
    format_say(search, "row-after", "rows: every answer stands one line too late", way_moved, 1.0);
    digits_try(search);
}

/* ---- classes ---- */

/* Makes a finding of the failing cases of a class. */
static void class_say(compare_search *search, int grade, const char *name, const char *text)
{
    for (uint32_t i = 0; i < search->failings; i++) {
        search->holds[i] = search->failing[i]->grade == grade;
    }
    if (cli_search_holds(search) > 0) {
        cli_search_find(search, name, "%s", text);
    }
}

/* ---- a coarser raster ---- */

/* The pixels per side at which a case is within what a raster is allowed; 0 if it never is. */
static double case_pixels(const compare_case *one)
{
    double off = fabs(one->theirs_m2 - one->sigma_m2);
    double rest = off - cli_compare_allowed(one, COMPARE_FLOAT, 1);
    return rest > 0.0 ? one->edge_m2 / rest : HUGE_VAL;
}

/* The share of the allowed difference that the answers use: the median over those that are no
   better than a raster's and have no other cause; 0 if there are few. */
static double raster_share(const compare_search *search, double pixels)
{
    const compare_job *job = search->job;
    uint32_t count = 0;
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        const compare_case *one = &job->kit.list[i];
        if (one->given && cli_compare_asked(job, one) && one->grade >= COMPARE_RASTER &&
            one->explained == 0 && isfinite(one->theirs_m2)) {
            search->room[count++] = pixels / case_pixels(one);
        }
    }
    return 2 * count > job->given ? cli_search_median(search->room, count) : 0.0;
}

/* Makes a finding if all failing cases would pass with fewer pixels and the other cases are
   consistent with that. */
static void coarse_say(compare_search *search)
{
    const compare_job *job = search->job;
    double pixels = job->grade == COMPARE_RASTER && search->failings > 0 ? job->pixels : 0.0;
    for (uint32_t i = 0; i < search->failings; i++) {
        pixels = fmin(pixels, floor(case_pixels(search->failing[i])));
    }
    if (pixels >= COARSEST && raster_share(search, pixels) >= COARSE_SHARE) {
        memset(search->holds, 1, search->failings);
        cli_search_find(search, "coarse-raster",
                        "a raster of fewer than %lu x %lu pixels: all these pass as one of %.0f x "
                        "%.0f or fewer: give --pixels N, or render finer",
                        (unsigned long)job->pixels, (unsigned long)job->pixels, pixels, pixels);
    }
}

/* ---- depths ---- */

/* Skins 2^-K m apart in a scene 8 m deep are named skins-K, coincident ones have other names; 0 for
   scenes without skins. */
static int skins_of(const compare_job *job, const compare_case *one)
{
    const char *name = job->kit.scene[one->scene].name;
    int coincident = strcmp(name, "twins") == 0 || strcmp(name, "two-faced") == 0;
    int skins = strncmp(name, "skins-", 6) == 0 ? (int)strtol(name + 6, NULL, 10) : 0;
    return coincident || skins > SKINS_TOUCH ? SKINS_TOUCH : skins;
}

/* If most of the failing cases are skins close to each other, the depths are too coarse. */
static void depth_say(compare_search *search)
{
    int coarsest = SKINS_TOUCH;
    for (uint32_t i = 0; i < search->failings; i++) {
        int skins = skins_of(search->job, search->failing[i]);
        coarsest = skins > 0 && skins < coarsest ? skins : coarsest;
        search->holds[i] = skins > 0;
    }
    if (coarsest < SKINS_TOUCH && 2 * cli_search_holds(search) > search->failings) {
        cli_search_find(search, "depth-precision",
                        "depth precision: skins 2^-%d m apart in a scene 8 m deep are not told "
                        "apart: a depth of some %d bits or fewer",
                        coarsest, coarsest + 3);
    }
}

/* ---- facets in one plane ---- */

/* Decides whether an answer lies between the truth and the answer in which the wrong one of
   coplanar facets is seen: 1, 0, or -1 on failure. */
static int case_fights(const compare_search *search, compare_case *one)
{
    static const compare_mistake wrong = {.name = "skins", .text = "", .wrong_coplanar = 1};
    const compare_job *job = search->job;
    double allowed = cli_compare_allowed(one, job->grade, job->pixels);
    double other = 0.0;
    if (cli_compare_records(&job->kit, one) != 0) {
        return -1;
    }
    if (job->kit.scene[one->scene].host.scene.facet_count > FIGHTS_MOST) {
        return 0;
    }
    if (cli_compare_answer(&job->kit, one, &wrong, &other) != 0) {
        return -1;
    }
    double theirs = one->theirs_m2 - one->sigma_m2;
    double most = other - one->sigma_m2;
    return fabs(most) > allowed && theirs / most > 0.0 && fabs(theirs) <= fabs(most) + allowed;
}

/* Makes a finding of such cases. 0, or -1 on failure. */
static int fights_say(compare_search *search)
{
    for (uint32_t i = 0; i < search->failings && search->job->findings < (uint32_t)COMPARE_FINDINGS;
         i++) {
        int fights = case_fights(search, search->failing[i]);
        if (fights < 0) {
            return -1;
        }
        search->holds[i] = (unsigned char)fights;
    }
    if (cli_search_holds(search) > 0) {
        cli_search_find(search, "coincident-skins",
                        "coincident skins, decided by rounding or by order (z-fighting): of facets "
                        "in one plane a front beats a back, then the lower index wins; push backs "
                        "away by some roundings of the scene's size");
    }
    return 0;
}

/* ---- a factor ---- */

/* Finds a factor that all answers share although each of them is within its class: the median ratio
   of the answers that are not exact. Most ratios must lie nearer to it than to 1, more of them than
   could be due to chance. */
static void bias_say(compare_search *search)
{
    compare_job *job = search->job;
    double *ratio = search->room;
    uint32_t count = 0;
    uint32_t nearer = 0;
    for (uint32_t i = 0; i < job->kit.cases; i++) {
        const compare_case *one = &job->kit.list[i];
        if (one->given && cli_compare_asked(job, one) && one->sigma_m2 > 0.0 &&
            one->grade > COMPARE_EXACT && isfinite(one->theirs_m2)) {
            ratio[count++] = one->theirs_m2 / one->sigma_m2;
        }
    }
    double median = cli_search_median(ratio, count);
    for (uint32_t i = 0; i < count; i++) {
        nearer += fabs(ratio[i] - median) < fabs(ratio[i] - 1.0);
    }
    double least = fmax(BIAS_SHARE, 0.5 + 0.5 * BIAS_SPREADS / sqrt(fmax(count, 1.0)));
    if (count < BIAS_CASES || nearer < least * count || fabs(median - 1.0) < BIAS_LEAST) {
        return;
    }
    for (uint32_t i = 0; i < search->failings; i++) {
        const compare_case *one = search->failing[i];
        search->holds[i] = (unsigned char)cli_search_explained(search, one, median * one->sigma_m2);
    }
    compare_finding *finding = cli_search_find(
        search, cli_factor_name(median),
        "all answers are %.6g times the truth: most are within their allowance, but %.0f %% lean "
        "the same way, which errors of a raster do not: %s",
        median, 100.0 * nearer / count, cli_factor_text(job, median));
    if (finding) {
        job->biased = 1;
        finding->factor = median;
    }
}

int cli_compare_symptoms(compare_search *search)
{
    if (search->job->findings == 0) {
        bias_say(search);
    }
    coarse_say(search);
    depth_say(search);
    if (fights_say(search) != 0) {
        return -1;
    }
    coarse_say(search);
    class_say(search, COMPARE_FLOAT, "single-precision",
              "single precision: off by no more than some of its roundings");
    class_say(search, COMPARE_RASTER, "raster",
              "a raster's pixels: off by no more than half a pixel along the outlines");
    return 0;
}
