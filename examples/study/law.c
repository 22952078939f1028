/* SPDX-License-Identifier: MIT */
/* How a law is judged: each comparison with its limits and its bound; the closest one is kept.
   Other files state the laws. */
#include "study.h"

#include <math.h>

#define LAW_WIDTH 24
#define LAW_TIGHT 1e-9

study_law *study_law_add(study_job *job, const char *name, const char *quantity)
{
    study_law *law = &job->law[job->laws++];
    law->name = name;
    law->quantity = quantity;
    return law;
}

/* The bound, slightly enlarged: then the sign of a rounded difference minus this bound is that of
   the exact one. */
static double law_bound(study_number number)
{
    return number.bound * (1.0 + 0x1p-48);
}

/* A NaN stays: no later comparison replaces it. */
static void law_take(study_law *law, double slack, study_number number, double least, double most)
{
    if (law->checks == 0 || isnan(slack) || slack < law->slack) {
        law->slack = slack;
        law->worst = number;
        law->least = least;
        law->most = most;
    }
    law->checks++;
}

void study_within(study_law *law, study_number number, double least, double most)
{
    double bound = law_bound(number);
    double slack = fmin((number.value - least) - bound, (most - number.value) - bound);
    law_take(law, slack, number, least, most);
}

/* What is hardly known does not count as equal. */
void study_equal(study_law *law, study_number number, double expected)
{
    int known = number.bound <= LAW_TIGHT * fabs(expected);
    double slack = known ? number.bound - fabs(number.value - expected) : -HUGE_VAL;
    law_take(law, slack, number, expected, expected);
}

void study_order(study_law *law, study_number large, study_number small)
{
    study_within(law, study_ratio(small, large), -HUGE_VAL, 1.0);
}

int study_holds(const study_law *law)
{
    return law->checks > 0 && law->slack >= 0.0;
}

uint32_t study_held(const study_job *job)
{
    uint32_t held = 0;
    for (uint32_t i = 0; i < job->laws; i++) {
        held += study_holds(&job->law[i]) != 0;
    }
    return held;
}

void study_limits(const study_law *law, char text[64])
{
    if (law->least == law->most) {
        snprintf(text, 64, "= %.8g", law->least);
    } else if (isinf(law->most)) {
        snprintf(text, 64, "> %.6g", law->least);
    } else if (isinf(law->least)) {
        snprintf(text, 64, "< %.6g", law->most);
    } else {
        snprintf(text, 64, "%.8g .. %.8g", law->least, law->most);
    }
}

void study_print(const study_job *job)
{
    printf("%-*s %-13s %11s  %-16s %8s %12s\n", LAW_WIDTH, "law", "verdict", "comparisons",
           "closest: value", "bound", "limits");
    for (uint32_t i = 0; i < job->laws; i++) {
        const study_law *law = &job->law[i];
        char limits[64];
        study_limits(law, limits);
        printf("%-*s %-13s %11d  %-16.9g %7.1e%c %12s\n", LAW_WIDTH, law->name,
               study_holds(law) ? "holds" : "not supported", law->checks, law->worst.value,
               law->worst.bound, law->estimate ? '*' : ' ', limits);
    }
    printf("%lu of %lu laws hold (* the bound holds a quadrature's error, which is an estimate)\n",
           (unsigned long)study_held(job), (unsigned long)job->laws);
}
