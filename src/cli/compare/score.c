/* SPDX-License-Identifier: MIT */
/* How well the answers of a mistake explain the submitted ones: which cases count, how much of
   their differences the mistake removes, and which passing cases contradict it. */
#include "cli/compare/search.h"

#include <math.h>
#include <stdlib.h>

#define REMOVED        0.1  /* share of a difference that may remain if it is explained */
#define REMOVED_RASTER 0.5  /* the same, if the class of the case allows that much in any case */
#define STRIKING       0.02 /* the same, if few cases support a mistake */
#define PRECISE        0.6  /* share of the cases changed by a mistake that it must explain */
#define WITNESSES      64u  /* number of passing cases that a mistake must not change */
#define ENOUGH         3u   /* number of cases that suffice for a finding */

/* Shuffles a list, in the same way every time, so that its beginning is a representative sample. */
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

/* 1 if the mistake changes the case at all. */
static int case_touched(const compare_search *search, const compare_case *one, double expected)
{
    return fabs(expected - one->sigma_m2) > case_room(search, one, expected);
}

/* An answer of 0 is no evidence if other failing cases have other answers: many mistakes make
   facets vanish. */
static int case_mute(const compare_search *search, const compare_case *one)
{
    return search->telling && one->theirs_m2 == 0.0;
}

search_score cli_search_score(const compare_search *search, double factor)
{
    search_score score = {.factor = factor};
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

double cli_search_factor(const compare_search *search, uint32_t failings, int *known)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < failings; i++) {
        if (search->answer[i] > 0.0 && search->failing[i]->theirs_m2 > 0.0) {
            search->room[count++] = search->failing[i]->theirs_m2 / search->answer[i];
        }
    }
    return cli_factor_known(cli_search_median(search->room, count), known);
}
