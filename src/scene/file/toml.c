/* SPDX-License-Identifier: MIT */
/* Reads the TOML subset. Decides what is well formed, and the values of literals; does not depend
   on scenes. In this order: moving through the text, strings, numbers, arrays, keys and headers,
   the bytes as a whole. */
#include "scene/file/toml.h"

#include <math.h>
#include <string.h>

#include "base/decimal.h"
#include "base/text.h"
#include "base/where.h"
#include "base/work.h"

/* A message quotes at most this many bytes of the file. */
#define TOML_EXCERPT 40

/* 2^53 - 1: integers up to this magnitude are exact as doubles, and no others round to them. */
#define INTEGER_MAX 9007199254740991.0

/* --- moving through the text --------------------------------------------------------------- */

static int toml_is_end(char c)
{
    return c == '\n' || c == '\r';
}

/* A byte that may occur in a number, a date or a boolean. */
static int toml_is_literal(char c)
{
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' ||
           c == '+' || c == '-' || c == '.' || c == ':';
}

/* Is c the next byte? */
static int toml_peek(const lrcsi_toml *toml, char c)
{
    return toml->at < toml->end && *toml->at == c;
}

/* Reports that reading stopped at `at`, and quotes the rest of the line from there. Returns
   `status`. */
static int toml_stop(const lrcsi_toml *toml, int status, const char *at, const char *item,
                     const char *expected)
{
    static const char end_of_file[] = "end of file";
    static const char end_of_line[] = "end of line";
    uint64_t offset = (uint64_t)(at - toml->start);
    if (at == toml->end) {
        return lrcsi_where_text(toml->where, status, offset, toml->line, item, expected,
                                end_of_file, sizeof end_of_file - 1);
    }
    if (toml_is_end(*at)) {
        return lrcsi_where_text(toml->where, status, offset, toml->line, item, expected,
                                end_of_line, sizeof end_of_line - 1);
    }
    size_t size = 1;
    while (size < TOML_EXCERPT && at + size < toml->end && !toml_is_end(at[size])) {
        size++;
    }
    return lrcsi_where_text(toml->where, status, offset, toml->line, item, expected, at, size);
}

/* Skips spaces and tabs. */
static void skip_blanks(lrcsi_toml *toml)
{
    while (toml_peek(toml, ' ') || toml_peek(toml, '\t')) {
        toml->at++;
    }
}

/* Skips a comment, up to its line end. */
static void skip_comment(lrcsi_toml *toml)
{
    if (toml_peek(toml, '#')) {
        while (toml->at < toml->end && !toml_is_end(*toml->at)) {
            toml->at++;
        }
    }
}

/* Skips one line end, if there is one here: lrcsi_toml_start has checked that every CR is followed
   by LF. */
static int skip_line_end(lrcsi_toml *toml)
{
    if (toml->at == toml->end || !toml_is_end(*toml->at)) {
        return 0;
    }
    toml->at += *toml->at == '\r' ? 2 : 1;
    toml->line++;
    return 1;
}

/* Skips blanks, comments and line ends. */
static void skip_lines(lrcsi_toml *toml)
{
    do {
        skip_blanks(toml);
        skip_comment(toml);
    } while (skip_line_end(toml));
}

/* Skips the rest of the line, which must be blank or a comment. */
static int expect_line_end(lrcsi_toml *toml, const char *item)
{
    skip_blanks(toml);
    skip_comment(toml);
    if (toml->at < toml->end && !skip_line_end(toml)) {
        return toml_stop(toml, LRCS_E_SYNTAX, toml->at, item, "the end of the line");
    }
    return LRCS_OK;
}

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

/* Writes a code point as UTF-8. Returns the number of bytes written. */
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

/* Reads the digits of \uXXXX or \UXXXXXXXX; toml->at is after the letter. */
static int read_code_point(lrcsi_toml *toml, int digits, char out[4], size_t *count)
{
    static const char expected[] = "4 or 8 hexadecimal digits of a Unicode scalar value";
    const char *at = toml->at;
    uint32_t code = 0;
    for (int i = 0; i < digits; i++, toml->at++) {
        int digit = toml->at < toml->end ? hex_digit(*toml->at) : -1;
        if (digit < 0) {
            return toml_stop(toml, LRCS_E_SYNTAX, at, "escape in a string", expected);
        }
        code = code << 4 | (uint32_t)digit;
    }
    if (code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) {
        return toml_stop(toml, LRCS_E_SYNTAX, at, "escape in a string", expected);
    }
    if (code == 0) {
        return toml_stop(toml, LRCS_E_UNSUPPORTED, at, "escape in a string",
                         "a character other than U+0000, which is not in the subset");
    }
    *count = encode_utf8(code, out);
    return LRCS_OK;
}

/* Reads an escape sequence; toml->at is after the backslash. */
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
        return toml_stop(toml, LRCS_E_SYNTAX, toml->at, "escape in a string",
                         "one of b t n f r \" \\ u U after the backslash");
    }
    out[0] = meaning[known - letter];
    *count = 1;
    return LRCS_OK;
}

/* Reads a string in quotes at toml->at. Returned: its number of unescaped bytes, and the first
   `capacity` of these. */
static int read_quoted(lrcsi_toml *toml, char *out, size_t capacity, size_t *size)
{
    const char *begin = toml->at;
    char quote = *begin;
    if (toml->end - begin >= 3 && begin[1] == quote && begin[2] == quote) {
        return toml_stop(toml, LRCS_E_UNSUPPORTED, begin, "string",
                         "a single-line string (multi-line strings are not in the subset)");
    }
    *size = 0;
    toml->at++;
    while (!toml_peek(toml, quote)) {
        char unit[4];
        size_t count = 1;
        if (toml->at == toml->end || toml_is_end(*toml->at)) {
            return toml_stop(toml, LRCS_E_SYNTAX, begin, "string", "a closing quote on this line");
        }
        unit[0] = *toml->at++;
        if (quote == '"' && unit[0] == '\\') {
            int status = read_escape(toml, unit, &count);
            if (status != LRCS_OK) {
                return status;
            }
        }
        for (size_t i = 0; i < count; i++, (*size)++) {
            if (*size < capacity) {
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
    int status = read_quoted(toml, NULL, 0, &size);
    event->type = LRCSI_TOML_STRING;
    if (status != LRCS_OK || !toml->work) {
        return status;
    }
    char *text = lrcsi_work_take(toml->work, size + 1, 1);
    if (!text) {
        return toml_stop(toml, LRCS_E_MEMORY, begin, "string", "more work area");
    }
    toml->at = begin;
    status = read_quoted(toml, text, size, &size);
    text[size] = '\0';
    event->text = text;
    return status;
}

/* --- numbers ------------------------------------------------------------------------------- */

/* Skips digits, between which there may be single underscores. Returns their end, or NULL if there
   is no digit. */
static const char *skip_digits(const char *at, const char *end)
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

/* 1 if [at, end) is a decimal TOML number; *integer: 1 if it is an integer, 0 if it is a float. */
static int is_number(const char *at, const char *end, int *integer)
{
    if (at < end && (*at == '+' || *at == '-')) {
        at++;
    }
    const char *first = at;
    at = skip_digits(at, end);
    if (!at || (*first == '0' && at != first + 1)) {
        return 0;
    }
    *integer = at == end;
    if (at < end && *at == '.') {
        at = skip_digits(at + 1, end);
    }
    if (at && at < end && (*at == 'e' || *at == 'E')) {
        at++;
        at = skip_digits(at < end && (*at == '+' || *at == '-') ? at + 1 : at, end);
    }
    return at == end;
}

/* The value of a number. Underscores are removed in a copy in the work area. Without a work area
   the value of a number with underscores is not needed, and is set to 0. */
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

/* Reports a literal that is not a number, with a message for what was probably meant. */
static int refuse_literal(const lrcsi_toml *toml, size_t size)
{
    const char *at = toml->at;
    size_t sign = size > 0 && (*at == '+' || *at == '-');
    if (literal_is(at + sign, size - sign, "inf") || literal_is(at + sign, size - sign, "nan")) {
        return toml_stop(toml, LRCS_E_NUMBER, at, "value", "a finite number");
    }
    if (size > 2 && at[0] == '0' && (at[1] == 'x' || at[1] == 'o' || at[1] == 'b')) {
        return toml_stop(toml, LRCS_E_UNSUPPORTED, at, "value",
                         "a decimal number (0x, 0o and 0b are not in the subset)");
    }
    if ((size > 4 && at[4] == '-') || (size > 2 && at[2] == ':')) {
        return toml_stop(toml, LRCS_E_UNSUPPORTED, at, "value",
                         "a number or a string (dates and times are not in the subset)");
    }
    return toml_stop(toml, LRCS_E_SYNTAX, at, "value",
                     "a number, \"string\", true, false or [numbers]");
}

/* A number or a boolean. */
static int read_literal(lrcsi_toml *toml, int *type, int *boolean, double *number)
{
    const char *begin = toml->at;
    const char *end = begin;
    while (end < toml->end && toml_is_literal(*end)) {
        end++;
    }
    size_t size = (size_t)(end - begin);
    int integer;
    if (literal_is(begin, size, "true") || literal_is(begin, size, "false")) {
        *type = LRCSI_TOML_BOOLEAN;
        *boolean = *begin == 't';
    } else if (is_number(begin, end, &integer)) {
        *type = LRCSI_TOML_NUMBER;
        if (number_value(toml->work, begin, end, number) != LRCS_OK) {
            return toml_stop(toml, LRCS_E_MEMORY, begin, "number", "more work area");
        }
        if (integer && fabs(*number) > INTEGER_MAX) {
            return toml_stop(toml, LRCS_E_NUMBER, begin, "integer",
                             "below 2^53 in magnitude, or a float (1e20)");
        }
        if (!isfinite(*number)) {
            return toml_stop(toml, LRCS_E_NUMBER, begin, "number", "within the range of a double");
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
    for (skip_lines(toml); !toml_peek(toml, ']'); skip_lines(toml)) {
        int type = LRCSI_TOML_ARRAY;
        double number = 0.0;
        if (toml->at < toml->end && !strchr("\"'[{", *toml->at)) {
            const char *begin = toml->at;
            int status = read_literal(toml, &type, &event->boolean, &number);
            if (status != LRCS_OK) {
                return status;
            }
            toml->at = type == LRCSI_TOML_NUMBER ? toml->at : begin;
        }
        if (type != LRCSI_TOML_NUMBER) {
            return toml_stop(toml, toml->at < toml->end ? LRCS_E_UNSUPPORTED : LRCS_E_SYNTAX,
                             toml->at, "array",
                             "a number (only they stand in the subset's arrays)");
        }
        if (event->count < LRCSI_TOML_NUMBERS) {
            event->number[event->count] = number;
        }
        event->count++;
        skip_lines(toml);
        if (toml_peek(toml, ',')) {
            toml->at++;
        } else if (!toml_peek(toml, ']')) {
            return toml_stop(toml, LRCS_E_SYNTAX, toml->at, "array", "a comma or ]");
        }
    }
    toml->at++;
    return LRCS_OK;
}

static int read_value(lrcsi_toml *toml, lrcsi_toml_event *event)
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
        return toml_stop(toml, LRCS_E_UNSUPPORTED, toml->at, "value",
                         "a plain value (inline tables are not in the subset)");
    default:
        event->count = 1;
        return read_literal(toml, &event->type, &event->boolean, &event->number[0]);
    }
}

/* --- keys and headers ------------------------------------------------------------------------- */

static int is_bare_byte(char c)
{
    return toml_is_literal(c) && c != '+' && c != '.' && c != ':';
}

static int read_name(lrcsi_toml *toml, const char *item, lrcsi_toml_name *name)
{
    if (toml_peek(toml, '"') || toml_peek(toml, '\'')) {
        return read_quoted(toml, name->text, sizeof name->text, &name->size);
    }
    const char *begin = toml->at;
    while (toml->at < toml->end && is_bare_byte(*toml->at)) {
        toml->at++;
    }
    name->size = (size_t)(toml->at - begin);
    if (name->size == 0) {
        return toml_stop(toml, LRCS_E_SYNTAX, begin, item,
                         "a name of letters, digits, - and _, or a quoted one");
    }
    memcpy(name->text, begin, name->size < sizeof name->text ? name->size : sizeof name->text);
    return LRCS_OK;
}

/* [a], [a.b], [[a]] or [[a.b]]. */
static int read_header(lrcsi_toml *toml, lrcsi_toml_event *event)
{
    toml->at++;
    event->kind = toml_peek(toml, '[') ? LRCSI_TOML_ELEMENT : LRCSI_TOML_TABLE;
    toml->at += event->kind == LRCSI_TOML_ELEMENT;
    int more = 1;
    while (more) {
        if (event->name_count == 2) {
            return toml_stop(toml, LRCS_E_UNSUPPORTED, event->raw, "table header",
                             "at most two names (deeper tables are not in the subset)");
        }
        skip_blanks(toml);
        int status = read_name(toml, "table header", &event->name[event->name_count]);
        if (status != LRCS_OK) {
            return status;
        }
        event->name_count++;
        skip_blanks(toml);
        more = toml_peek(toml, '.');
        toml->at += more;
    }
    for (int i = event->kind == LRCSI_TOML_ELEMENT ? 2 : 1; i > 0; i--, toml->at++) {
        if (!toml_peek(toml, ']')) {
            return toml_stop(toml, LRCS_E_SYNTAX, toml->at, "table header", "]");
        }
    }
    event->raw_size = (size_t)(toml->at - event->raw);
    return expect_line_end(toml, "table header");
}

/* A key and its value. */
static int read_pair(lrcsi_toml *toml, lrcsi_toml_event *event)
{
    event->kind = LRCSI_TOML_KEY;
    event->name_count = 1;
    int status = read_name(toml, "key", &event->name[0]);
    if (status != LRCS_OK) {
        return status;
    }
    event->raw_size = (size_t)(toml->at - event->raw);
    skip_blanks(toml);
    if (toml_peek(toml, '.')) {
        return toml_stop(toml, LRCS_E_UNSUPPORTED, event->raw, "key",
                         "a single name (dotted keys are not in the subset)");
    }
    if (!toml_peek(toml, '=')) {
        return toml_stop(toml, LRCS_E_SYNTAX, toml->at, "key", "= and a value");
    }
    toml->at++;
    skip_blanks(toml);
    event->value_raw = toml->at;
    status = read_value(toml, event);
    if (status != LRCS_OK) {
        return status;
    }
    event->value_size = (size_t)(toml->at - event->value_raw);
    return expect_line_end(toml, "value");
}

int lrcsi_toml_next(lrcsi_toml *toml, lrcsi_toml_event *event)
{
    skip_lines(toml);
    memset(event, 0, sizeof *event);
    event->line = toml->line;
    event->raw = toml->at;
    if (toml->at == toml->end) {
        event->kind = LRCSI_TOML_END;
        return LRCS_OK;
    }
    return *toml->at == '[' ? read_header(toml, event) : read_pair(toml, event);
}

/* --- the bytes as a whole ------------------------------------------------------------------- */

/* The number of bytes of the character at `at`; 0 if it is not allowed. */
static size_t character_size(const char *at, const char *end)
{
    unsigned char lead = (unsigned char)*at;
    if (lead < 0x80) {
        int line_end = lead == '\n' || (lead == '\r' && end - at > 1 && at[1] == '\n');
        return (lead >= 0x20 && lead != 0x7f) || lead == '\t' || line_end;
    }
    size_t size = lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    return (size_t)(end - at) >= size && lrcsi_text_is_utf8(at, size) ? size : 0;
}

int lrcsi_toml_start(lrcsi_toml *toml, const char *text, size_t size, lrcs_work *work,
                     lrcs_where *where)
{
    const char *end = size > 0 ? text + size : text;
    *toml = (lrcsi_toml){text, text, end, 1, work, where};
    toml->at += lrcsi_text_mark(text, size);
    const char *begin = toml->at;
    while (toml->at < end) {
        size_t step = character_size(toml->at, end);
        if (step == 0) {
            return lrcsi_where_text(where, LRCS_E_SYNTAX, (uint64_t)(toml->at - text), toml->line,
                                    "text", "UTF-8 without control characters", toml->at, 1);
        }
        toml->line += *toml->at == '\n';
        toml->at += step;
    }
    toml->at = begin;
    toml->line = 1;
    return LRCS_OK;
}

int lrcsi_toml_name_is(const lrcsi_toml_name *name, const char *text)
{
    return name->size == strlen(text) && memcmp(name->text, text, name->size) == 0;
}

int lrcsi_toml_refuse(const lrcsi_toml *toml, int status, uint32_t line, const char *raw,
                      size_t size, const char *item, const char *expected)
{
    return lrcsi_where_text(toml->where, status, (uint64_t)(raw - toml->start), line, item,
                            expected, raw, size < TOML_EXCERPT ? size : TOML_EXCERPT);
}

size_t lrcsi_toml_offset(const char *text, size_t size, uint32_t line)
{
    size_t at = 0;
    for (uint32_t i = 1; i < line && at < size; i++) {
        const char *end = memchr(text + at, '\n', size - at);
        at = end ? (size_t)(end - text) + 1 : size;
    }
    return at;
}
