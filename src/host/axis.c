/* SPDX-License-Identifier: MIT */
/* Which round numbers an axis begins and ends with, which of them it names and how. It knows
   nothing of pixels but how many texts there is room for. */
#include "host/axis.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define DECADE_LEAST (-300)
#define DECADE_MOST  300

/* The multiples of a power of ten that a range may end at. */
static const double axis_round[] = {1.0, 2.0, 5.0, 10.0};

static int axis_decade(double value)
{
    double decade = floor(log10(value) + 1e-9); /* 999.9999999 counts as a thousand */
    return decade < DECADE_LEAST ? DECADE_LEAST : decade > DECADE_MOST ? DECADE_MOST : (int)decade;
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

/* mantissa x 10^decade as digits, without the printf that asks the locale for its point. */
static void decimal_text(char text[24], unsigned mantissa, int decade)
{
    if (decade >= 0) {
        snprintf(text, 24, "%u%.*s", mantissa, decade, "0000000000");
    } else {
        snprintf(text, 24, "0.%.*s%u", -decade - 1, "0000000000", mantissa);
    }
}

static void log_tick_name(lrcsi_tick *tick, unsigned mantissa, int decade, int plain)
{
    if (plain) {
        decimal_text(tick->text, mantissa, decade);
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
    int between = 3.0 * span <= texts; /* room to name 2 and 5 as well */
    int plain = first >= -3 && last <= 5;
    step = step > 1 ? step : 1;
    for (int decade = first; decade <= last; decade++) {
        for (unsigned k = 1; k < 10; k++) {
            double value = k * pow(10.0, decade);
            int major = k == 1 ? decade % step == 0 : between && plain && (k == 2 || k == 5);
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
    double mantissa = step / pow(10.0, decade);
    int parts = mantissa > 1.5 && mantissa < 3.0 ? 4 : 5;
    long first = lround(axis->least / step) * parts;
    long last = lround(axis->most / step) * parts;
    for (long i = first; i <= last; i++) {
        double value = (double)i * step / parts;
        lrcsi_tick *tick = tick_add(axis, value, i % parts == 0);
        if (tick->major) {
            snprintf(tick->text, sizeof tick->text, "%.*f", decade < 0 ? -decade : 0, value);
        }
    }
}

lrcsi_axis lrcsi_axis_make(int log, double least, double most, double texts)
{
    lrcsi_axis axis = {.log = log};
    if (log) {
        int some = most > 0.0 && most < HUGE_VAL && least > 0.0 && least <= most;
        axis.least = axis_snap(some ? least : 0.1, 0);
        axis.most = axis_snap(some ? most : 1.0, 1);
        if (!(axis.most > axis.least)) {
            axis.least /= 2.0;
            axis.most *= 2.0;
            axis.least = axis_snap(axis.least, 0);
            axis.most = axis_snap(axis.most, 1);
        }
        log_ticks(&axis, texts);
        return axis;
    }
    int some = least > -HUGE_VAL && most < HUGE_VAL && least <= most;
    double low = some ? least : 0.0;
    double high = some ? most : 1.0;
    double step = axis_snap(high > low ? (high - low) / fmax(texts, 2.0) : fmax(fabs(low), 1.0), 1);
    axis.least = step * floor(low / step + 1e-9);
    axis.most = step * ceil(high / step - 1e-9);
    axis.most += axis.most > axis.least ? 0.0 : step;
    linear_ticks(&axis, step);
    return axis;
}

double lrcsi_axis_at(const lrcsi_axis *axis, double value)
{
    if (!axis->log) {
        return (value - axis->least) / (axis->most - axis->least);
    }
    return value > 0.0 ? log(value / axis->least) / log(axis->most / axis->least) : -HUGE_VAL;
}
