/* SPDX-License-Identifier: MIT */
/* The TOML subset: keys, headers, and the bytes as a whole. Decides what is well formed; knows
   nothing of scenes. */
#include "scene/toml_scan.h"

#include <string.h>

#include "base/text.h"
#include "base/where.h"

/* --- keys and headers ------------------------------------------------------------------------- */

static int is_bare_byte(char c)
{
    return lrcsi_toml_is_literal(c) && c != '+' && c != '.' && c != ':';
}

static int read_name(lrcsi_toml *toml, const char *item, lrcsi_toml_name *name)
{
    if (lrcsi_toml_peek(toml, '"') || lrcsi_toml_peek(toml, '\'')) {
        return lrcsi_toml_quoted(toml, name->text, sizeof name->text, &name->size);
    }
    const char *begin = toml->at;
    while (toml->at < toml->end && is_bare_byte(*toml->at)) {
        toml->at++;
    }
    name->size = (size_t)(toml->at - begin);
    if (name->size == 0) {
        return lrcsi_toml_stop(toml, LRCS_E_SYNTAX, begin, item,
                               "a name of letters, digits, - and _, or a quoted one");
    }
    memcpy(name->text, begin, name->size < sizeof name->text ? name->size : sizeof name->text);
    return LRCS_OK;
}

/* [a], [a.b], [[a]] or [[a.b]]. */
static int read_header(lrcsi_toml *toml, lrcsi_toml_event *event)
{
    toml->at++;
    event->kind = lrcsi_toml_peek(toml, '[') ? LRCSI_TOML_ELEMENT : LRCSI_TOML_TABLE;
    toml->at += event->kind == LRCSI_TOML_ELEMENT;
    int more = 1;
    while (more) {
        if (event->name_count == 2) {
            return lrcsi_toml_stop(toml, LRCS_E_UNSUPPORTED, event->raw, "table header",
                                   "at most two names (deeper tables are not in the subset)");
        }
        lrcsi_toml_blanks(toml);
        int status = read_name(toml, "table header", &event->name[event->name_count]);
        if (status != LRCS_OK) {
            return status;
        }
        event->name_count++;
        lrcsi_toml_blanks(toml);
        more = lrcsi_toml_peek(toml, '.');
        toml->at += more;
    }
    for (int i = event->kind == LRCSI_TOML_ELEMENT ? 2 : 1; i > 0; i--, toml->at++) {
        if (!lrcsi_toml_peek(toml, ']')) {
            return lrcsi_toml_stop(toml, LRCS_E_SYNTAX, toml->at, "table header", "]");
        }
    }
    event->raw_size = (size_t)(toml->at - event->raw);
    return lrcsi_toml_line_end(toml, "table header");
}

static int read_pair(lrcsi_toml *toml, lrcsi_toml_event *event)
{
    event->kind = LRCSI_TOML_KEY;
    event->name_count = 1;
    int status = read_name(toml, "key", &event->name[0]);
    if (status != LRCS_OK) {
        return status;
    }
    event->raw_size = (size_t)(toml->at - event->raw);
    lrcsi_toml_blanks(toml);
    if (lrcsi_toml_peek(toml, '.')) {
        return lrcsi_toml_stop(toml, LRCS_E_UNSUPPORTED, event->raw, "key",
                               "a single name (dotted keys are not in the subset)");
    }
    if (!lrcsi_toml_peek(toml, '=')) {
        return lrcsi_toml_stop(toml, LRCS_E_SYNTAX, toml->at, "key", "= and a value");
    }
    toml->at++;
    lrcsi_toml_blanks(toml);
    event->value_raw = toml->at;
    status = lrcsi_toml_value(toml, event);
    if (status != LRCS_OK) {
        return status;
    }
    event->value_size = (size_t)(toml->at - event->value_raw);
    return lrcsi_toml_line_end(toml, "value");
}

int lrcsi_toml_next(lrcsi_toml *toml, lrcsi_toml_event *event)
{
    lrcsi_toml_lines(toml);
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

/* Bytes of the character at `at`, 0 where none may stand there. */
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
    static const char mark[] = "\xef\xbb\xbf";
    const char *end = size > 0 ? text + size : text;
    *toml = (lrcsi_toml){text, text, end, 1, work, where};
    if (size >= 3 && memcmp(text, mark, 3) == 0) {
        toml->at += 3;
    }
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
                            expected, raw, size < LRCSI_TOML_EXCERPT ? size : LRCSI_TOML_EXCERPT);
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
