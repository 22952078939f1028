/* SPDX-License-Identifier: MIT */
/* Numbers to text and back, the same in every locale; bounds to text, rounded up. */
#include <lrcs/host.h>

#include "base/decimal.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* snprintf takes its decimal separator from the program's locale, which may be any number of bytes;
   every other byte of "%.17g" is known. */
void lrcs_host_number_text(double value, char text[LRCS_HOST_NUMBER_SIZE])
{
    char raw[64];
    snprintf(raw, sizeof raw, "%.17g", value);
    if (!isfinite(value)) {
        strcpy(text, isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf");
        return;
    }
    size_t used = 0;
    for (const char *at = raw; *at && used < LRCS_HOST_NUMBER_SIZE - 1; at++) {
        if (strchr("0123456789+-e", *at)) {
            text[used++] = *at;
        } else if (used == 0 || text[used - 1] != '.') {
            text[used++] = '.';
        }
    }
    text[used] = '\0';
}

int lrcs_host_number_read(const char *text, size_t size, double *value)
{
    const char *end = text + size;
    while (text < end && *text == ' ') {
        text++;
    }
    while (end > text && end[-1] == ' ') {
        end--;
    }
    double number = 0.0;
    if (lrcsi_decimal_read(text, end, &number) != end || text == end) {
        return LRCS_E_SYNTAX;
    }
    if (!isfinite(number)) {
        return LRCS_E_NUMBER;
    }
    *value = number;
    return LRCS_OK;
}

int lrcs_host_numbers_read(const char *text, double *value, int count)
{
    for (int i = 0; i < count; i++) {
        size_t size = strcspn(text, ",");
        int last = text[size] == '\0';
        int status = lrcs_host_number_read(text, size, &value[i]);
        if (status != LRCS_OK || last != (i == count - 1)) {
            return status != LRCS_OK ? status : LRCS_E_SYNTAX;
        }
        text += size + 1;
    }
    return LRCS_OK;
}

void lrcs_host_number_put(FILE *out, const char *before, double value)
{
    char text[LRCS_HOST_NUMBER_SIZE];
    lrcs_host_number_text(value, text);
    fprintf(out, "%s%s", before, text);
}

/* Adds a unit to the last digit if the nearest number is less than the bound. */
void lrcs_host_bound_text(double bound, int digits, char text[LRCS_HOST_BOUND_SIZE])
{
    snprintf(text, LRCS_HOST_BOUND_SIZE, "%.*g", digits, bound);
    double shown = strtod(text, NULL);
    if (shown < bound) {
        double step = pow(10.0, floor(log10(shown > 0.0 ? shown : bound)) + 1.0 - digits);
        snprintf(text, LRCS_HOST_BOUND_SIZE, "%.*g", digits, shown + step);
    }
}

void lrcs_host_append(char *text, size_t size, const char *format, ...)
{
    size_t used = strlen(text);
    va_list list;
    va_start(list, format);
    vsnprintf(text + used, size - used, format, list);
    va_end(list);
}
