/* SPDX-License-Identifier: MIT */
/* The quantities that a sweep varies. Ranges A:B:STEP are exact: decimal numbers as integer
   multiples of one power of ten. This file decides what a range is and how many numbers it has. */
#include "host/sweep/axis.h"

#include <stdlib.h>
#include <string.h>

#include "host/fail.h"

/* Integers and powers of ten that doubles represent exactly: one division then rounds only once. */
#define RANGE_MOST     ((int64_t)1 << 53)
#define RANGE_DECIMALS 22

static const char range_form[] = "expected A:B:STEP or one number";
static const char range_long[] = "a number has too many digits: at most 15 are exact";

typedef struct range_number {
    int64_t digits; /* digits * 10^exponent */
    int exponent;
} range_number;

/* Reads a number exactly. Returns what is wrong, or NULL. */
static const char *range_number_read(const char *text, size_t size, range_number *number)
{
    double value;
    const char *end = text + size;
    *number = (range_number){0, 0};
    if (lrcs_host_number_read(text, size, &value) != LRCS_OK) {
        return range_form;
    }
    const char *at = text + strspn(text, " +-");
    for (int point = 0; at < end && *at != 'e' && *at != 'E'; at++) {
        if (*at == '.') {
            point = 1;
        } else if (number->digits > RANGE_MOST / 10 - 1) {
            return range_long;
        } else if (*at >= '0' && *at <= '9') {
            number->digits = 10 * number->digits + (*at - '0');
            number->exponent -= point;
        }
    }
    if (at < end) {
        number->exponent += (int)strtol(at + 1, NULL, 10);
    }
    if (memchr(text, '-', (size_t)(at - text))) {
        number->digits = -number->digits;
    }
    while (number->digits % 10 == 0 && number->digits != 0) {
        number->digits /= 10;
        number->exponent++;
    }
    number->exponent = number->digits == 0 ? 0 : number->exponent;
    return NULL;
}

/* digits * 10^(exponent + decimals); on overflow 0, and *good becomes 0. */
static int64_t range_scaled(const range_number *number, int decimals, int *good)
{
    int64_t digits = number->digits;
    for (int i = number->exponent + decimals; i > 0 && *good; i--) {
        *good = llabs(digits) <= RANGE_MOST / 10;
        digits *= *good ? 10 : 1;
    }
    return digits;
}

/* Makes a range from first, last and step; returns what is wrong, or NULL. */
static const char *range_make(const range_number number[3], lrcs_host_range *range)
{
    int decimals = 0;
    int good = 1;
    for (int i = 0; i < 3; i++) {
        decimals = -number[i].exponent > decimals ? -number[i].exponent : decimals;
    }
    if (decimals > RANGE_DECIMALS) {
        return range_long;
    }
    int64_t first = range_scaled(&number[0], decimals, &good);
    int64_t span = range_scaled(&number[1], decimals, &good) - first;
    int64_t step = range_scaled(&number[2], decimals, &good);
    if (!good) {
        return range_long;
    }
    if (span != 0 && (step == 0 || (step > 0) != (span > 0))) {
        return "expected A:B:STEP with a STEP that leads from A to B";
    }
    *range = (lrcs_host_range){first, step, span != 0 ? (uint64_t)(span / step) + 1 : 1, decimals};
    return NULL;
}

const char *lrcsi_range_read(const char *text, size_t size, lrcs_host_range *range)
{
    range_number number[3] = {{0, 0}, {0, 0}, {1, 0}};
    const char *end = text + size;
    for (int i = 0; i < 3; i++) {
        const char *colon = memchr(text, ':', (size_t)(end - text));
        const char *stop = colon ? colon : end;
        const char *fault = range_number_read(text, (size_t)(stop - text), &number[i]);
        if (fault) {
            return fault;
        }
        if (!colon && i == 0) {
            number[1] = number[0];
            return range_make(number, range);
        }
        if (!colon) {
            return i == 2 ? range_make(number, range) : range_form;
        }
        text = colon + 1;
    }
    return range_form;
}

double lrcs_host_range_at(const lrcs_host_range *range, uint64_t i)
{
    double power = 1.0;
    for (int k = 0; k < range->decimals; k++) {
        power *= 10.0; /* exact up to 10^22 */
    }
    return (double)(range->first + (int64_t)i * range->step) / power;
}

int lrcsi_axis_add(lrcs_host_plan *plan, const char *key, const char *name, const char *text,
                   size_t size, lrcs_host_error *error)
{
    if (plan->axes == LRCS_HOST_PLAN_AXES) {
        return lrcsi_host_fail(error, LRCS_E_LIMIT, "at most %d axes", LRCS_HOST_PLAN_AXES);
    }
    lrcs_host_plan_axis *axis = &plan->axis[plan->axes];
    const char *fault = lrcsi_range_read(text, size, &axis->range);
    if (fault) {
        return lrcsi_host_fail(error, LRCS_E_ARGUMENT, "%s: %s, found '%.*s'", key, fault,
                               (int)size, text);
    }
    axis->key = key;
    snprintf(axis->name, sizeof axis->name, "%s", name);
    plan->axes++;
    return LRCS_OK;
}

int lrcsi_text_refuse(lrcs_host_error *error, const char *key, const char *expected,
                      const char *found)
{
    return lrcsi_host_fail(error, LRCS_E_ARGUMENT, "%s: expected %s, found '%s'", key, expected,
                           found);
}
