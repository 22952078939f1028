/* SPDX-License-Identifier: MIT */
/* Values of the TOML subset: strings, numbers, booleans, arrays. Decides what a literal's value is.
 */
#include "scene/toml_scan.h"

#include <math.h>
#include <string.h>

#include "base/decimal.h"
#include "base/text.h"
#include "base/where.h"
#include "base/work.h"

/* Integers up to here are doubles exactly, and no others round to them: 2^53 - 1. */
#define INTEGER_MOST 9007199254740991.0

/* --- strings ------------------------------------------------------------------------------- */

static int hex_digit(char c)
{
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    if (c >= 'A' && c <= 'F') {
        return c - 'A' + 10;
    }
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/* A code point as UTF-8; bytes written. */
static size_t encode_utf8(uint32_t code, char out[4])
{
    if (code < 0x80) {
        out[0] = (char)code;
        return 1;
    }
    size_t count = code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    for (size_t i = count - 1; i > 0; i--) {
        out[i] = (char)(unsigned char)(0x80u | (code & 0x3fu));
        code >>= 6;
    }
    out[0] = (char)(unsigned char)((0xf00u >> count & 0xffu) | code);
    return count;
}

/* \uXXXX or \UXXXXXXXX with toml->at behind the letter. */
static int read_code_point(lrcsi_toml *toml, int digits, char out[4], size_t *count)
{
    static const char expected[] = "4 or 8 hexadecimal digits of a Unicode scalar value";
    const char *at = toml->at;
    uint32_t code = 0;
    for (int i = 0; i < digits; i++, toml->at++) {
        int digit = toml->at < toml->end ? hex_digit(*toml->at) : -1;
        if (digit < 0) {
            return lrcsi_toml_stop(toml, LRCS_E_SYNTAX, at, "escape in a string", expected);
        }
        code = code << 4 | (uint32_t)digit;
    }
    if (code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) {
        return lrcsi_toml_stop(toml, LRCS_E_SYNTAX, at, "escape in a string", expected);
    }
    if (code == 0) {
        return lrcsi_toml_stop(toml, LRCS_E_UNSUPPORTED, at, "escape in a string",
                               "a character other than U+0000, which is not in the subset");
    }
    *count = encode_utf8(code, out);
    return LRCS_OK;
}

/* An escape, with toml->at behind the backslash. */
static int read_escape(lrcsi_toml *toml, char out[4], size_t *count)
{
    static const char letter[] = "btnfr\"\\";
    static const char meaning[] = "\b\t\n\f\r\"\\";
    char c = '\0';
    if (toml->at < toml->end) {
        c = *toml->at++;
    }
    if (c == 'u' || c == 'U') {
        return read_code_point(toml, c == 'u' ? 4 : 8, out, count);
    }
    const char *known = c ? strchr(letter, c) : NULL;
    if (!known) {
        toml->at -= c != '\0';
        return lrcsi_toml_stop(toml, LRCS_E_SYNTAX, toml->at, "escape in a string",
                               "one of b t n f r \" \\ u U after the backslash");
    }
    out[0] = meaning[known - letter];
    *count = 1;
    return LRCS_OK;
}

int lrcsi_toml_quoted(lrcsi_toml *toml, char *out, size_t room, size_t *size)
{
    const char *begin = toml->at;
    char quote = *begin;
    if (toml->end - begin >= 3 && begin[1] == quote && begin[2] == quote) {
        return lrcsi_toml_stop(toml, LRCS_E_UNSUPPORTED, begin, "string",
                               "a single-line string (multi-line strings are not in the subset)");
    }
    *size = 0;
    toml->at++;
    while (!lrcsi_toml_peek(toml, quote)) {
        char unit[4];
        size_t count = 1;
        if (toml->at == toml->end || lrcsi_toml_is_end(*toml->at)) {
            return lrcsi_toml_stop(toml, LRCS_E_SYNTAX, begin, "string",
                                   "a closing quote on this line");
        }
        unit[0] = *toml->at++;
        if (quote == '"' && unit[0] == '\\') {
            int status = read_escape(toml, unit, &count);
            if (status != LRCS_OK) {
                return status;
            }
        }
        for (size_t i = 0; i < count; i++, (*size)++) {
            if (*size < room) {
                out[*size] = unit[i];
            }
        }
    }
    toml->at++;
    return LRCS_OK;
}

static int read_string(lrcsi_toml *toml, lrcsi_toml_event *event)
{
    const char *begin = toml->at;
    size_t size = 0;
    int status = lrcsi_toml_quoted(toml, NULL, 0, &size);
    event->type = LRCSI_TOML_STRING;
    if (status != LRCS_OK || !toml->work) {
        return status;
    }
    char *text = lrcsi_work_take(toml->work, size + 1, 1);
    if (!text) {
        return lrcsi_toml_stop(toml, LRCS_E_MEMORY, begin, "string", "more work area");
    }
    toml->at = begin;
    status = lrcsi_toml_quoted(toml, text, size, &size);
    text[size] = '\0';
    event->text = text;
    return status;
}

/* --- numbers ------------------------------------------------------------------------------- */

/* A digit, then digits that single underscores may part; behind them, or NULL for none. */
static const char *pass_digits(const char *at, const char *end)
{
    if (at == end || *at < '0' || *at > '9') {
        return NULL;
    }
    do {
        at++;
        if (end - at >= 2 && *at == '_') {
            at++;
        }
    } while (at < end && *at >= '0' && *at <= '9');
    return at[-1] == '_' ? at - 1 : at;
}

/* 1 where [at, end) is a decimal TOML number; *integer tells which kind. */
static int is_number(const char *at, const char *end, int *integer)
{
    if (at < end && (*at == '+' || *at == '-')) {
        at++;
    }
    const char *first = at;
    at = pass_digits(at, end);
    if (!at || (*first == '0' && at != first + 1)) {
        return 0;
    }
    *integer = at == end;
    if (at < end && *at == '.') {
        at = pass_digits(at + 1, end);
    }
    if (at && at < end && (*at == 'e' || *at == 'E')) {
        at++;
        at = pass_digits(at < end && (*at == '+' || *at == '-') ? at + 1 : at, end);
    }
    return at == end;
}

/* The value of a number, its underscores left out in the work area. Without a work area those with
   underscores count as 0: then only their form matters. */
static int number_value(lrcs_work *work, const char *at, const char *end, double *value)
{
    if (!memchr(at, '_', (size_t)(end - at))) {
        lrcsi_decimal_read(at, end, value);
        return LRCS_OK;
    }
    if (!work) {
        *value = 0.0;
        return LRCS_OK;
    }
    size_t mark = work->used;
    char *plain = lrcsi_work_take(work, (size_t)(end - at), 1);
    if (!plain) {
        return LRCS_E_MEMORY;
    }
    size_t size = 0;
    for (; at < end; at++) {
        if (*at != '_') {
            plain[size++] = *at;
        }
    }
    lrcsi_decimal_read(plain, plain + size, value);
    work->used = mark;
    return LRCS_OK;
}

static int literal_is(const char *at, size_t size, const char *word)
{
    return size == strlen(word) && memcmp(at, word, size) == 0;
}

/* What a literal that is no number may have been meant as. */
static int refuse_literal(const lrcsi_toml *toml, size_t size)
{
    const char *at = toml->at;
    size_t sign = size > 0 && (*at == '+' || *at == '-');
    if (literal_is(at + sign, size - sign, "inf") || literal_is(at + sign, size - sign, "nan")) {
        return lrcsi_toml_stop(toml, LRCS_E_NUMBER, at, "value", "a finite number");
    }
    if (size > 2 && at[0] == '0' && (at[1] == 'x' || at[1] == 'o' || at[1] == 'b')) {
        return lrcsi_toml_stop(toml, LRCS_E_UNSUPPORTED, at, "value",
                               "a decimal number (0x, 0o and 0b are not in the subset)");
    }
    if ((size > 4 && at[4] == '-') || (size > 2 && at[2] == ':')) {
        return lrcsi_toml_stop(toml, LRCS_E_UNSUPPORTED, at, "value",
                               "a number or a string (dates and times are not in the subset)");
    }
    return lrcsi_toml_stop(toml, LRCS_E_SYNTAX, at, "value",
                           "a number, \"string\", true, false or [numbers]");
}

/* A number or a boolean. */
static int read_literal(lrcsi_toml *toml, int *type, int *truth, double *number)
{
    const char *begin = toml->at;
    const char *end = begin;
    while (end < toml->end && lrcsi_toml_is_literal(*end)) {
        end++;
    }
    size_t size = (size_t)(end - begin);
    int integer;
    if (literal_is(begin, size, "true") || literal_is(begin, size, "false")) {
        *type = LRCSI_TOML_BOOLEAN;
        *truth = *begin == 't';
    } else if (is_number(begin, end, &integer)) {
        *type = LRCSI_TOML_NUMBER;
        if (number_value(toml->work, begin, end, number) != LRCS_OK) {
            return lrcsi_toml_stop(toml, LRCS_E_MEMORY, begin, "number", "more work area");
        }
        if (integer && fabs(*number) > INTEGER_MOST) {
            return lrcsi_toml_stop(toml, LRCS_E_NUMBER, begin, "integer",
                                   "below 2^53 in magnitude, or a float (1e20)");
        }
        if (!isfinite(*number)) {
            return lrcsi_toml_stop(toml, LRCS_E_NUMBER, begin, "number",
                                   "within the range of a double");
        }
    } else {
        return refuse_literal(toml, size);
    }
    toml->at = end;
    return LRCS_OK;
}

/* --- arrays and values --------------------------------------------------------------------- */

static int read_array(lrcsi_toml *toml, lrcsi_toml_event *event)
{
    event->type = LRCSI_TOML_ARRAY;
    toml->at++;
    for (lrcsi_toml_lines(toml); !lrcsi_toml_peek(toml, ']'); lrcsi_toml_lines(toml)) {
        int type = LRCSI_TOML_ARRAY;
        double number = 0.0;
        if (toml->at < toml->end && !strchr("\"'[{", *toml->at)) {
            const char *begin = toml->at;
            int status = read_literal(toml, &type, &event->truth, &number);
            if (status != LRCS_OK) {
                return status;
            }
            toml->at = type == LRCSI_TOML_NUMBER ? toml->at : begin;
        }
        if (type != LRCSI_TOML_NUMBER) {
            return lrcsi_toml_stop(toml, toml->at < toml->end ? LRCS_E_UNSUPPORTED : LRCS_E_SYNTAX,
                                   toml->at, "array",
                                   "a number (only they stand in the subset's arrays)");
        }
        if (event->count < LRCSI_TOML_NUMBERS) {
            event->number[event->count] = number;
        }
        event->count++;
        lrcsi_toml_lines(toml);
        if (lrcsi_toml_peek(toml, ',')) {
            toml->at++;
        } else if (!lrcsi_toml_peek(toml, ']')) {
            return lrcsi_toml_stop(toml, LRCS_E_SYNTAX, toml->at, "array", "a comma or ]");
        }
    }
    toml->at++;
    return LRCS_OK;
}

int lrcsi_toml_value(lrcsi_toml *toml, lrcsi_toml_event *event)
{
    char c = '\0';
    if (toml->at < toml->end) {
        c = *toml->at;
    }
    switch (c) {
    case '"':
    case '\'':
        return read_string(toml, event);
    case '[':
        return read_array(toml, event);
    case '{':
        return lrcsi_toml_stop(toml, LRCS_E_UNSUPPORTED, toml->at, "value",
                               "a plain value (inline tables are not in the subset)");
    default:
        event->count = 1;
        return read_literal(toml, &event->type, &event->truth, &event->number[0]);
    }
}
