/* SPDX-License-Identifier: MIT */
/* Lines, words, names and numbers of OBJ and MTL text. It decides where a statement and its words
   end and how a failure is reported. The keywords are known to its callers only. */
#include "mesh/read/lines.h"

#include "base/decimal.h"
#include "base/text.h"
#include "base/where.h"

#include <math.h>
#include <string.h>

static int is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

static int is_newline(char c)
{
    return c == '\n' || c == '\r';
}

/* Skips the line break at `at`, unless the bytes end there. */
static void skip_newline(lrcsi_lines *lines)
{
    if (lines->at < lines->end) {
        int cr_lf = lines->end - lines->at > 1 && lines->at[0] == '\r' && lines->at[1] == '\n';
        lines->at += cr_lf ? 2 : 1;
        lines->line++;
    }
}

static int at_continuation(const lrcsi_lines *lines)
{
    return lines->end - lines->at > 1 && lines->at[0] == '\\' && is_newline(lines->at[1]);
}

static int at_word_end(const lrcsi_lines *lines)
{
    return lines->at == lines->end || is_blank(*lines->at) || is_newline(*lines->at) ||
           at_continuation(lines);
}

lrcsi_lines lrcsi_lines_make(const void *bytes, size_t size)
{
    const char *start = bytes;
    return (lrcsi_lines){start, start + lrcsi_text_mark(start, size), start + size, 1};
}

int lrcsi_lines_done(lrcsi_lines *lines)
{
    for (;;) {
        if (at_continuation(lines)) {
            lines->at++;
            skip_newline(lines);
        } else if (lines->at < lines->end && is_blank(*lines->at)) {
            lines->at++;
        } else {
            return lines->at == lines->end || is_newline(*lines->at) || *lines->at == '#';
        }
    }
}

int lrcsi_lines_next(lrcsi_lines *lines)
{
    const char *word = NULL;
    while (lrcsi_lines_word(lines, &word) > 0) {
    }
    while (lines->at < lines->end && !is_newline(*lines->at)) {
        lines->at++; /* a comment */
    }
    skip_newline(lines);
    return lines->at < lines->end;
}

size_t lrcsi_lines_word(lrcsi_lines *lines, const char **word)
{
    if (lrcsi_lines_done(lines)) {
        return 0;
    }
    *word = lines->at;
    while (!at_word_end(lines)) {
        lines->at++;
    }
    return (size_t)(lines->at - *word);
}

int lrcsi_lines_is(const char *word, size_t size, const char *text)
{
    return strlen(text) == size && memcmp(word, text, size) == 0;
}

size_t lrcsi_lines_name(lrcsi_lines *lines, const char **name)
{
    lrcsi_lines_done(lines);
    *name = lines->at;
    const char *last = lines->at;
    while (lines->at < lines->end && !is_newline(*lines->at) && !at_continuation(lines)) {
        lines->at++;
        last = is_blank(lines->at[-1]) ? last : lines->at;
    }
    return (size_t)(last - *name);
}

int lrcsi_lines_fail(lrcsi_lines *lines, int status, const char *item, const char *expected,
                     lrcs_where *where)
{
    int none = lrcsi_lines_done(lines);
    int ended = lines->at == lines->end;
    const char *found = ended ? "end of file" : "end of line";
    size_t size = strlen(found);
    uint64_t offset = (uint64_t)(lines->at - lines->start);
    uint32_t line = lines->line;
    if (!none) {
        size = lrcsi_lines_word(lines, &found);
    }
    status = ended && status == LRCS_E_SYNTAX ? LRCS_E_TRUNCATED : status;
    return lrcsi_where_text(where, status, offset, line, item, expected, found, size);
}

/* 1 if a word is "nan", "-inf" or similar, as printf and others write them. */
static int is_non_finite_word(const lrcsi_lines *lines)
{
    const char *at = lines->at;
    at += *at == '-' || *at == '+';
    return lines->end - at >= 3 && ((at[0] | 0x20) == 'n' || (at[0] | 0x20) == 'i') &&
           (at[1] | 0x20) != 'o' && ((at[2] | 0x20) == 'n' || (at[2] | 0x20) == 'f');
}

int lrcsi_lines_number(lrcsi_lines *lines, const char *item, double *value, lrcs_where *where)
{
    if (lrcsi_lines_done(lines)) {
        return lrcsi_lines_fail(lines, LRCS_E_SYNTAX, item, "a number", where);
    }
    lrcsi_lines from = *lines;
    double number = 0.0;
    const char *after = lrcsi_decimal_read(lines->at, lines->end, &number);
    lines->at = after ? after : lines->at;
    if (!after || !at_word_end(lines)) {
        int status = is_non_finite_word(&from) ? LRCS_E_NUMBER : LRCS_E_SYNTAX;
        return lrcsi_lines_fail(&from, status, item, "a finite number", where);
    }
    if (!isfinite(number)) {
        return lrcsi_lines_fail(&from, LRCS_E_NUMBER, item, "a finite number", where);
    }
    *value = number;
    return LRCS_OK;
}
