/* SPDX-License-Identifier: MIT */
/* Describes a finding in a sentence and decides which cases it explains: the mistake, a second one,
   a factor; what the window cuts off; other mistakes that explain equally well. */
#include "cli/compare/search.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

#define TIED      2e-3 /* scores that differ by less are equally good */
#define TIES_MOST 3u   /* number of named mistakes that explain equally well */
#define CLIPPED   0.9  /* share of the remaining cases that lose something at the window */

compare_finding *cli_search_finding(compare_job *job, const char *name)
{
    if (job->findings == COMPARE_FINDINGS) {
        return NULL;
    }
    compare_finding *finding = &job->finding[job->findings++];
    *finding = (compare_finding){.name = name, .factor = 1.0, .rest = 1.0};
    return finding;
}

uint32_t cli_search_holds(const compare_search *search)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < search->failings; i++) {
        count += search->holds[i];
    }
    return count;
}

compare_finding *cli_search_find(compare_search *search, const char *name, const char *format, ...)
{
    va_list list;
    compare_finding *finding = cli_search_finding(search->job, name);
    if (!finding) {
        return NULL;
    }
    va_start(list, format);
    vsnprintf(finding->text, sizeof finding->text, format, list);
    va_end(list);
    for (uint32_t i = 0; i < search->failings; i++) {
        if (search->holds[i]) {
            search->failing[i]->explained = (int)search->job->findings;
        }
    }
    finding->explained = cli_search_holds(search);
    cli_search_part(search);
    return finding;
}

compare_mistake cli_mistake_both(const compare_mistake *first, const compare_mistake *second)
{
    compare_mistake both = *first;
    if (second) {
        both.shade = second->shade;
        both.at = second->at;
    }
    return both;
}

/* The median share of the differences that remains in the cases that it explains; also marks these
   cases. */
static double finding_rest(const compare_search *search, const search_score *best, int mark)
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

/* Appends to a text, truncated to its size. */
__attribute__((format(printf, 2, 3))) static void text_add(char text[COMPARE_TEXT],
                                                           const char *format, ...)
{
    size_t used = strlen(text);
    va_list list;
    va_start(list, format);
    vsnprintf(text + used, COMPARE_TEXT - used, format, list);
    va_end(list);
}

static void finding_say(const compare_job *job, const search_score *best, compare_finding *finding)
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

/* Computes the answers of a mistake to the failing and to the passing cases. 0 or -1. */
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

/* Decides whether a mistake explains the cases of a finding and no others: 1, 0, or -1 on
   failure. */
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

/* Names the other mistakes that explain the same cases equally well. 0 or -1. */
static int ties_say(const compare_search *search, const search_score *best,
                    compare_finding *finding)
{
    uint32_t ties = 0;
    for (const compare_mistake *a = cli_compare_mistakes + 1; a->name && ties < TIES_MOST; a++) {
        compare_mistake both = cli_mistake_both(a, best->second);
        int alone = a != best->first && best->first != cli_compare_mistakes && a != best->second;
        int fits =
            alone ? mistake_fits(search, &both, best->factor, (int)search->job->findings) : 0;
        if (fits < 0 || (fits > 0 && answers_all(search, &both) != 0)) {
            return -1;
        }
        double score = fits ? cli_search_score(search, best->factor).score - best->price : 0.0;
        if (fits && fabs(score - best->score) <= TIED) {
            text_add(finding->text, "%s%s", ties++ > 0 ? "; " : "; or, equally well: ", a->text);
        }
    }
    return 0;
}

/* If the frame is wrong, the kit's square no longer contains the scene: most of the remaining cases
   show less than they should, because part of the scene is outside. */
static void clipped_say(const compare_search *search, const search_score *best,
                        compare_finding *finding)
{
    int mark = (int)search->job->findings;
    uint32_t left = 0;
    uint32_t less = 0;
    for (uint32_t i = 0; i < search->failings; i++) {
        const compare_case *one = search->failing[i];
        left += one->explained != mark;
        less += one->explained != mark && one->theirs_m2 < best->factor * search->answer[i];
    }
    if (less == 0 || left > finding->explained || less < CLIPPED * left) {
        return;
    }
    for (uint32_t i = 0; i < search->failings; i++) {
        compare_case *one = search->failing[i];
        int cut = one->explained == 0 && one->theirs_m2 < best->factor * search->answer[i];
        one->explained = cut ? mark : one->explained;
    }
    finding->explained += less;
    text_add(finding->text,
             "; in %lu cases less than that: part of the scene is outside the window",
             (unsigned long)less);
}

int cli_search_say(compare_search *search, const search_score *best)
{
    compare_mistake both = cli_mistake_both(best->first, best->second);
    if (answers_all(search, &both) != 0) {
        return -1;
    }
    compare_finding *finding = cli_search_finding(search->job, best->first->name);
    if (!finding) {
        return 0;
    }
    finding->explained = best->explained;
    finding_say(search->job, best, finding);
    finding->rest = finding_rest(search, best, (int)search->job->findings);
    int code = ties_say(search, best, finding);
    if (code == 0 && best->first->turn) {
        code = answers_all(search, &both);
        if (code == 0) {
            clipped_say(search, best, finding);
        }
    }
    return code;
}
