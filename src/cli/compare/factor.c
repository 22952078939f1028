/* SPDX-License-Identifier: MIT */
/* Known causes of a constant factor between answers and truth. */
#include "cli/compare/search.h"

#include <math.h>
#include <stddef.h>

#define FACTOR_NEAR 0.02 /* a ratio this near to a known number is taken for that number */

typedef struct factor_entry {
    double value;
    const char *name, *text;
} factor_entry;

static const factor_entry factors[] = {
    {0.25 / CLI_PI, "missing-4-pi", "4 pi is missing"},
    {4.0 * CLI_PI, "twice-4-pi", "4 pi counts twice"},
    {0.25, "missing-4", "4 is missing of 4 pi"},
    {1.0 / CLI_PI, "missing-pi", "pi is missing of 4 pi, or f_r is divided by pi once more"},
    {CLI_PI, "twice-pi", "pi counts twice, or a reflectance in place of f_r"},
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

double cli_factor_known(double factor, int *known)
{
    const factor_entry *entry = factor_find(factor);
    *known = entry != NULL;
    return entry ? entry->value : factor;
}

const char *cli_factor_name(double factor)
{
    const factor_entry *entry = factor_find(factor);
    return entry ? entry->name : "pixel-area";
}

const char *cli_factor_text(const compare_job *job, double factor)
{
    const factor_entry *entry = factor_find(factor);
    double n = job->pixels;
    double fence = (n / (n - 1.0)) * (n / (n - 1.0));
    int fences = fabs(factor / fence - 1.0) < 0.2 / n || fabs(factor * fence - 1.0) < 0.2 / n;
    return entry    ? entry->text
           : fences ? "pixel area: N - 1 in place of N pixels a side, or the reverse"
                    : "pixel area, the side of the window, or a unit?";
}
