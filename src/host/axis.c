/* SPDX-License-Identifier: MIT */
/* Chooses the round numbers at which an axis begins and ends, which of them are labelled, and how.
   Of the layout it knows only the number of labels that fit. */
#include "host/axis.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The multiples of a power of ten that a range may end at. */
static const double axis_round[] = {1.0, 2.0, 5.0, 10.0};

static int axis_decade(double value)
{
    return (int)floor(log10(value) + 1e-9); /* 999.9999999 counts as a thousand */
}

/* The round number nearest to a value from below (up = 0) or from above. */
static double axis_snap(double value, int up)
{
    double power = pow(10.0, axis_decade(value));
    int i = up ? 0 : 3;
    while (up ? i < 3 && axis_round[i] * power < value * (1.0 - 1e-9)
              : i > 0 && axis_round[i] * power > value * (1.0 + 1e-9)) {
        i += up ? 1 : -1;
    }
    return axis_round[i] * power;
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

static void log_tick_name(lrcsi_tick *tick, long mantissa, int decade, int plain)
{
    if (plain || mantissa != 1) {
        axis_decimal(tick->text, mantissa, decade);
        return;
    }
    strcpy(tick->text, "10");
    snprintf(tick->raised, sizeof tick->raised, "%d", decade);
}

static void log_ticks(lrcsi_axis *axis, double texts)
{
    int first = axis_decade(axis->least);
    int last = axis_decade(axis->most);
    double span = log10(axis->most / axis->least);
    int step = (int)ceil(span / fmax(texts, 1.0));
    int plain = first >= -3 && last <= 5;
    int between = 3.0 * span <= texts && (plain || span < 2.0); /* 2 and 5 are labelled too */
    step = step > 1 ? step : 1;
    for (int decade = first; decade <= last; decade++) {
        for (long k = 1; k < 10; k++) {
            double value = (double)k * pow(10.0, decade);
            int major = k == 1 ? decade % step == 0 : between && (k == 2 || k == 5);
            int shown = k == 1 ? major || step < 6 : step == 1;
            if (shown && value > axis->least * (1.0 - 1e-9) && value < axis->most * (1.0 + 1e-9)) {
                lrcsi_tick *tick = tick_add(axis, value, major);
                if (major) {
                    log_tick_name(tick, k, decade, plain);
                }
            }
        }
    }
}

static void linear_ticks(lrcsi_axis *axis, double step)
{
    int decade = axis_decade(step);
    long mantissa = lround(step / pow(10.0, decade)); /* 1, 2 or 5 */
    int parts = mantissa == 2 ? 4 : 5;
    long first = lround(axis->least / step) * parts;
    long last = lround(axis->most / step) * parts;
    for (long i = first; i <= last; i++) {
        double value = (double)i * step / parts;
        lrcsi_tick *tick = tick_add(axis, value, i % parts == 0);
        if (tick->major) {
            axis_decimal(tick->text, i / parts * mantissa, decade);
        }
    }
}

static void log_range(lrcsi_axis *axis, double least, double most, double texts)
{
    int some = least >= LRCSI_AXIS_LEAST && most <= LRCSI_AXIS_MOST && least <= most;
    axis->least = axis_snap(some ? least : 0.1, 0);
    axis->most = axis_snap(some ? most : 1.0, 1);
    if (!(axis->most > axis->least)) {
        axis->least = axis_snap(0.5 * axis->least, 0);
        axis->most = axis_snap(2.0 * axis->most, 1);
    }
    log_ticks(axis, texts);
}

static void linear_range(lrcsi_axis *axis, double least, double most, double texts)
{
    int some = least >= -LRCSI_AXIS_MOST && most <= LRCSI_AXIS_MOST && least <= most;
    double low = some ? least : 0.0;
    double high = some ? most : 1.0;
    double large = fmax(fabs(low), fabs(high));
    if (!(high - low > 1e-6 * large)) { /* one value, or nearly */
        double pad = large > LRCSI_AXIS_LEAST ? 0.1 * large : 1.0;
        low -= pad;
        high += pad;
    }
    double step = axis_snap((high - low) / fmax(texts, 2.0), 1);
    axis->least = step * floor(low / step + 1e-9);
    axis->most = step * ceil(high / step - 1e-9);
    linear_ticks(axis, step);
}

/* Steps of angles in familiar fractions of a turn; -1 if that gives too few or too many. */
static int degree_range(lrcsi_axis *axis, double least, double most, double texts)
{
    static const struct {
        long step, minor;
    } known[] = {{2, 1},   {5, 1},   {10, 5},  {15, 5},  {30, 10},
                 {45, 15}, {60, 20}, {90, 30}, {180, 60}};
    const size_t count = sizeof known / sizeof known[0];
    size_t i = 0;
    if (!(most - least >= 10.0 && most - least <= 1800.0 && fabs(least) < 1e6)) {
        return -1;
    }
    while (i < count - 1 && (most - least) / (double)known[i].step > texts) {
        i++;
    }
    long step = known[i].step;
    long first = lround(floor(least / (double)step + 1e-9)) * step;
    long last = lround(ceil(most / (double)step - 1e-9)) * step;
    axis->least = (double)first;
    axis->most = (double)last;
    for (long at = first; at <= last; at += known[i].minor) {
        lrcsi_tick *tick = tick_add(axis, (double)at, at % step == 0);
        if (tick->major) {
            snprintf(tick->text, sizeof tick->text, "%ld", at);
        }
    }
    return 0;
}

lrcsi_axis lrcsi_axis_make(int kind, double least, double most, double texts)
{
    lrcsi_axis axis = {.log = kind == LRCSI_AXIS_LOG};
    if (kind == LRCSI_AXIS_LOG) {
        log_range(&axis, least, most, texts);
    } else if (kind != LRCSI_AXIS_DEG || degree_range(&axis, least, most, texts) != 0) {
        linear_range(&axis, least, most, texts);
    }
    return axis;
}

double lrcsi_axis_at(const lrcsi_axis *axis, double value)
{
    if (!axis->log) {
        return (value - axis->least) / (axis->most - axis->least);
    }
    return value > 0.0 ? log(value / axis->least) / log(axis->most / axis->least) : -HUGE_VAL;
}
