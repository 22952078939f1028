/* SPDX-License-Identifier: MIT */
/* Reasons that show in the table itself, before any physics: nothing but zeros, another unit than
   its column says, rows that moved by one, too few digits. */
#include "cli/compare/search.h"

#include <math.h>
#include <string.h>

#define MOST       0.9   /* of the failing cases, the share that a reason explains */
#define LEAST      5u    /* failing cases, fewer prove nothing */
#define DIGITS     9     /* as many do no harm */
#define SAME_DIGIT 1e-11 /* of a number: so near to one of few digits it is that one */

/* What they answered to a case, read in another way; NaN: cannot tell. */
typedef double format_way(const compare_job *job, const compare_case *one, double at);

/* ---- ways ---- */

/* `at` log10 of m2, in whichever column. */
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

/* The answer `at` lines further. */
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

/* Does the reason at hand explain most of what fails? */
static int holds_most(const compare_search *search)
{
    uint32_t right = cli_search_holds(search);
    return right >= LEAST && right >= MOST * search->failings;
}

/* Where most answers are right once they are read in another way, that is the finding. */
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
        compare_case *one = &search->job->kit.list[i]; /* what was no number may be one */
        if (one->given && !isfinite(one->theirs_m2) && one->explained == 0 &&
            cli_compare_failed(search->job, one) &&
            case_near(search->job, one, way(search->job, one, at))) {
            one->explained = (int)search->job->findings;
            finding->explained++;
        }
    }
}

/* ---- digits ---- */

/* The step of numbers with so many digits, significant or behind the point, at a number. */
static double digit_step(double value, int digits, int significant)
{
    double whole = significant && value != 0.0 ? floor(log10(fabs(value))) + 1.0 : 0.0;
    return pow(10.0, whole - digits);
}

/* Has every answer no more digits than these? */
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

/* What half of the last digit is worth in m2. */
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

/* Where all answers are that short, and what is cut off makes most failures. */
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

/* The fewest that all answers have. */
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

/* Is every answer 0, though something is seen? */
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
