/* SPDX-License-Identifier: MIT */
/* Values with bounds, for laws: sums and ratios that carry their bounds along, rounding included.
   It decides no limits. */
#include "study.h"

#include <float.h>
#include <math.h>

/* Half a unit in the last place of a result of + - * /, gradual underflow included. */
static double number_rounding(double value)
{
    return fmax(fabs(value) * 0x1p-53, DBL_TRUE_MIN);
}

/* A bound summed of a few terms in doubles, each at least its true value less a few roundings. */
static double number_outward(double bound)
{
    return bound * (1.0 + 0x1p-48);
}

study_number study_exact(double value)
{
    return (study_number){value, 0.0};
}

study_number study_sum(study_number a, study_number b)
{
    double value = a.value + b.value;
    return (study_number){value, number_outward(a.bound + b.bound + number_rounding(value))};
}

/* The factor is taken as exact. */
study_number study_scaled(study_number a, double factor)
{
    double value = a.value * factor;
    double bound = a.bound * fabs(factor);
    return (study_number){value, number_outward(bound + number_rounding(value))};
}

/* With A, B the truths: A/B - a/b = ((A - a) - (B - b) a/b) / B, and |B| >= |b| - its bound. */
study_number study_ratio(study_number a, study_number b)
{
    double value = a.value / b.value;
    double below = (fabs(b.value) - b.bound) * (1.0 - 0x1p-52);
    if (!(below > 0.0)) {
        return (study_number){value, HUGE_VAL};
    }
    double bound = (a.bound + number_outward(fabs(value)) * b.bound) / below;
    return (study_number){value, number_outward(bound + number_rounding(value))};
}

double study_dbsm(double sigma_m2)
{
    return 10.0 * log10(sigma_m2);
}
