/* SPDX-License-Identifier: MIT */
/* Causes visible in the table itself, without physics: only zeros, another unit than the column
   states, rows shifted by one, too few digits. */
#include "cli/compare/search.h"

#include <math.h>
#include <string.h>

#define MOST       0.9   /* share of the failing cases that a cause must explain */
#define LEAST      5u    /* number of failing cases; fewer prove nothing */
#define DIGITS     9     /* with this many digits rounding is harmless */
#define SAME_DIGIT 1e-11 /* relative: a number this near to one with few digits is taken for it */

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

static int case_near(const compare_job *job, const compare_case *one, double sigma_m2)
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
        search->holds[i] = (unsigned char)case_near(search->job, one, way(search->job, one, at));
    }
    compare_finding *finding =
        holds_most(search) ? cli_search_find(search, name, "%s", text) : NULL;
    for (uint32_t i = 0; finding && i < search->job->kit.cases; i++) {
        compare_case *one =
            &search->job->kit.list[i]; /* an invalid number may become a valid one */
        if (one->given && !isfinite(one->theirs_m2) && one->explained == 0 &&
            cli_compare_failed(search->job, one) &&
            case_near(search->job, one, way(search->job, one, at))) {
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

/* Half a unit of the last digit, in m2. */
static double digit_room(const compare_job *job, const compare_case *one, int digits,
                         int significant)
{
    double value = job->decibels ? 10.0 * log10(one->sigma_m2) : one->sigma_m2;
    double half = 0.5 * digit_step(value, digits, significant);
    return job->decibels ? one->sigma_m2 * (pow(10.0, half / 10.0) - 1.0) : half;
}

static int case_rounded(const compare_job *job, const compare_case *one, int digits,
                        int significant)
{
    double off = fabs(one->theirs_m2 - one->sigma_m2);
    return off <= digit_room(job, one, digits, significant) +
                      cli_compare_allowed(one, job->grade, job->pixels);
}

/* Makes a finding if all answers have so few digits and rounding explains most failures. */
static int digits_say(compare_search *search, int digits, int significant)
{
    for (uint32_t i = 0; i < search->failings; i++) {
        search->holds[i] =
            (unsigned char)case_rounded(search->job, search->failing[i], digits, significant);
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
    uint32_t given = 0;
    for (uint32_t i = 0; i < search->job->kit.cases; i++) {
        const compare_case *one = &search->job->kit.list[i];
        int counts = one->given && cli_compare_asked(search->job, one);
        if (counts && one->theirs_m2 != 0.0) {
            return 0;
        }
        given += (uint32_t)counts;
    }
    return given > 0 && search->failings > 0;
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
