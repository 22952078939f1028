/* SPDX-License-Identifier: MIT */
/* The function is replaced by chords, and increased by the largest distance between it and them:
   an eighth of the square of a chord's width times the second derivative, where that is negative.
   Rounding is left to the caller. */
#include "base/parabola.h"

#include "base/range.h"

/* Heuristic: more chords give a closer bound. */
#define CHORDS 16

double lrcsi_parabola_positive(const double value[3], double sign, double shift)
{
    const double square = sign * 2 * (value[0] - 2 * value[1] + value[2]);
    const double first = sign * (4 * value[1] - 3 * value[0] - value[2]);
    const double bulge = 0.25 * lrcsi_max(0, -square) / (CHORDS * CHORDS);
    double before = sign * value[0] + shift + bulge;
    double sum = 0;
    for (int i = 1; i <= CHORDS; i++) {
        const double t = (double)i / CHORDS;
        const double after = sign * value[0] + t * (first + t * square) + shift + bulge;
        const double high = lrcsi_max(before, after);
        const double low = lrcsi_min(before, after);
        sum += high <= 0 ? 0 : low >= 0 ? high + low : high * (high / (high - low));
        before = after;
    }
    return 0.5 * sum / CHORDS;
}
