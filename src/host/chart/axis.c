/* SPDX-License-Identifier: MIT */
/* Chooses the round numbers at which an axis begins and ends, which of them are labelled, and how.
   It depends on the layout only through the number of labels that fit. */
#include "host/chart/axis.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The multiples of a power of ten that a range may end at. */
static const double axis_mantissa[] = {1.0, 2.0, 5.0, 10.0};

static int axis_decade(double value)
{
    return (int)floor(log10(value) + 1e-9); /* 999.9999999 counts as a thousand */
}

/* The nearest round number not above a value (up = 0) or not below it (up = 1). */
static double axis_round_outward(double value, int up)
{
    double power = pow(10.0, axis_decade(value));
    int i = up ? 0 : 3;
    while (up ? i < 3 && axis_mantissa[i] * power < value * (1.0 - 1e-9)
              : i > 0 && axis_mantissa[i] * power > value * (1.0 + 1e-9)) {
        i += up ? 1 : -1;
    }
    return axis_mantissa[i] * power;
}

static lrcsi_tick *tick_add(lrcsi_axis *axis, double value, int major)
{
    lrcsi_tick *tick = &axis->tick[axis->count];
    *tick = (lrcsi_tick){.value = value, .major = major};
    axis->count += axis->count + 1 < LRCSI_AXIS_TICKS;
    return tick;
}

/* Writes mantissa x 10^decade without printf, whose decimal point depends on the locale. */
static void axis_decimal(char text[48], long mantissa, int decade)
{
    static const long power[] = {1, 10, 100, 1000, 10000, 100000, 1000000};
    if (mantissa == 0) {
        strcpy(text, "0");
    } else if (decade > 6 || decade < -6) {
        snprintf(text, 48, "%lde%d", mantissa, decade);
    } else if (decade >= 0) {
        snprintf(text, 48, "%ld%.*s", mantissa, decade, "000000");
    } else {
        long unit = power[-decade];
        snprintf(text, 48, "%s%ld.%0*ld", mantissa < 0 ? "-" : "", labs(mantissa) / unit, -decade,
                 labs(mantissa) % unit);
    }
}

/* From 1, 2 or 5 times a power of ten to another one. Decades are labelled as 10 with an exponent,
   or as plain numbers if all of them are short; 2 and 5 are labelled too where they fit. */
static void log_range(lrcsi_axis *axis, double low, double high, double labels)
{
    int some = low >= LRCSI_AXIS_MIN && high <= LRCSI_AXIS_MAX && low <= high;
    axis->low = axis_round_outward(some ? low : 0.1, 0);
    axis->high = axis_round_outward(some ? high : 1.0, 1);
    if (!(axis->high > axis->low)) {
        axis->low = axis_round_outward(0.5 * axis->low, 0);
        axis->high = axis_round_outward(2.0 * axis->high, 1);
    }
    int first = axis_decade(axis->low);
    int last = axis_decade(axis->high);
    double span = log10(axis->high / axis->low);
    int step = (int)fmax(ceil(span / fmax(labels, 1.0)), 1.0);
    int plain = first >= -3 && last <= 5;
    int between = 3.0 * span <= labels && (plain || span < 2.0);
    for (int decade = first; decade <= last; decade++) {
        for (long k = 1; k < 10; k++) {
            double value = (double)k * pow(10.0, decade);
            int major = k == 1 ? decade % step == 0 : between && (k == 2 || k == 5);
            int shown = k == 1 ? major || step < 6 : step == 1;
            if (!shown ||
                !(value > axis->low * (1.0 - 1e-9) && value < axis->high * (1.0 + 1e-9))) {
                continue;
            }
            lrcsi_tick *tick = tick_add(axis, value, major);
            if (major && (plain || k != 1)) {
                axis_decimal(tick->text, k, decade);
            } else if (major) {
                strcpy(tick->text, "10");
                snprintf(tick->raised, sizeof tick->raised, "%d", decade);
            }
        }
    }
}

/* From one multiple of a step of 1, 2 or 5 times a power of ten to another one. */
static void linear_range(lrcsi_axis *axis, double low, double high, double labels)
{
    int some = low >= -LRCSI_AXIS_MAX && high <= LRCSI_AXIS_MAX && low <= high;
    low = some ? low : 0.0;
    high = some ? high : 1.0;
    double large = fmax(fabs(low), fabs(high));
    if (!(high - low > 1e-6 * large)) { /* one value, or nearly */
        double pad = large > LRCSI_AXIS_MIN ? 0.1 * large : 1.0;
        low -= pad;
        high += pad;
    }
    double step = axis_round_outward((high - low) / fmax(labels, 2.0), 1);
    axis->low = step * floor(low / step + 1e-9);
    axis->high = step * ceil(high / step - 1e-9);
    int decade = axis_decade(step);
    long mantissa = lround(step / pow(10.0, decade)); /* 1, 2 or 5 */
    int parts = mantissa == 2 ? 4 : 5;
    long first = lround(axis->low / step) * parts;
    long last = lround(axis->high / step) * parts;
    for (long i = first; i <= last; i++) {
        lrcsi_tick *tick = tick_add(axis, (double)i * step / parts, i % parts == 0);
        if (tick->major) {
            axis_decimal(tick->text, i / parts * mantissa, decade);
        }
    }
}

/* Steps of angles in familiar fractions of a turn; -1 if that gives too few or too many. */
static int degree_range(lrcsi_axis *axis, double low, double high, double labels)
{
    static const struct {
        long step, minor;
    } known[] = {{2, 1},   {5, 1},   {10, 5},  {15, 5},  {30, 10},
                 {45, 15}, {60, 20}, {90, 30}, {180, 60}};
    const size_t count = sizeof known / sizeof known[0];
    size_t i = 0;
    if (!(high - low >= 10.0 && high - low <= 1800.0 && fabs(low) < 1e6)) {
        return -1;
    }
    while (i < count - 1 && (high - low) / (double)known[i].step > labels) {
        i++;
    }
    long step = known[i].step;
    long first = lround(floor(low / (double)step + 1e-9)) * step;
    long last = lround(ceil(high / (double)step - 1e-9)) * step;
    axis->low = (double)first;
    axis->high = (double)last;
    for (long at = first; at <= last; at += known[i].minor) {
        lrcsi_tick *tick = tick_add(axis, (double)at, at % step == 0);
        if (tick->major) {
            snprintf(tick->text, sizeof tick->text, "%ld", at);
        }
    }
    return 0;
}

lrcsi_axis lrcsi_axis_make(int kind, double low, double high, double labels)
{
    lrcsi_axis axis = {.log = kind == LRCSI_AXIS_LOG};
    if (kind == LRCSI_AXIS_LOG) {
        log_range(&axis, low, high, labels);
    } else if (kind != LRCSI_AXIS_DEG || degree_range(&axis, low, high, labels) != 0) {
        linear_range(&axis, low, high, labels);
    }
    return axis;
}

double lrcsi_axis_at(const lrcsi_axis *axis, double value)
{
    if (!axis->log) {
        return (value - axis->low) / (axis->high - axis->low);
    }
    return value > 0.0 ? log(value / axis->low) / log(axis->high / axis->low) : -HUGE_VAL;
}
