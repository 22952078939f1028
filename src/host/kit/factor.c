/* SPDX-License-Identifier: MIT */
/* Constant factors between answers and the truth: which ones are known, and what usually causes
   them. explain.c decides whether a factor explains the answers. */
#include "host/kit/search.h"

#include <math.h>

#include "base/constant.h"

#define FACTOR_NEAR 0.02 /* a ratio this near to a known factor is taken for that factor */

static const lrcsi_factor factors[] = {
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

const lrcsi_factor *lrcsi_factor_find(double ratio)
{
    for (size_t i = 0; i < sizeof factors / sizeof factors[0]; i++) {
        if (fabs(ratio / factors[i].value - 1.0) <= FACTOR_NEAR) {
            return &factors[i];
        }
    }
    return NULL;
}

const char *lrcsi_factor_name(double factor)
{
    const lrcsi_factor *known = lrcsi_factor_find(factor);
    return known ? known->name : "pixel-area";
}

const char *lrcsi_factor_text(double factor, uint32_t pixels)
{
    const lrcsi_factor *known = lrcsi_factor_find(factor);
    double n = pixels;
    double off_by_one = (n / (n - 1.0)) * (n / (n - 1.0));
    int fences =
        fabs(factor / off_by_one - 1.0) < 0.2 / n || fabs(factor * off_by_one - 1.0) < 0.2 / n;
    return known    ? known->text
           : fences ? "pixel area: N - 1 in place of N pixels a side, or the reverse"
                    : "pixel area, the side of the window, or a unit?";
}
