/* SPDX-License-Identifier: MIT */
/* Walking the statements of a text format of the Wavefront family: lines that end with LF, CRLF
   or CR, continued by a backslash at the end, words apart by blanks, a word that begins with '#'
   the start of a comment. Comments are not continued: paths in them end with backslashes. */
#ifndef LRCSI_LINES_H
#define LRCSI_LINES_H

#include <lrcs/status.h>

typedef struct lrcsi_lines {
    const char *start, *at, *end;
    uint32_t line; /* of `at`, from 1 */
} lrcsi_lines;

/* At the first statement; a UTF-8 byte order mark is passed over. */
lrcsi_lines lrcsi_lines_make(const void *bytes, size_t size);

/* Passes over blanks and continuations. Returns 1 where the statement ends there. */
int lrcsi_lines_done(lrcsi_lines *lines);

/* Passes over the rest of the statement. Returns 0 where the bytes end. */
int lrcsi_lines_next(lrcsi_lines *lines);

/* Reads the next word of the statement; its length, 0 where the statement ends. */
size_t lrcsi_lines_word(lrcsi_lines *lines, const char **word);

/* 1 where a word is `text`. */
int lrcsi_lines_is(const char *word, size_t size, const char *text);

/* Reads the rest of the line, trimmed, blanks and '#' inside kept: a name. Its length. A
   continuation ends it. */
size_t lrcsi_lines_name(lrcsi_lines *lines, const char **name);

/* Reads a number that is a word of its own and finite.
   Status: LRCS_OK; LRCS_E_SYNTAX, _TRUNCATED (nothing there), _NUMBER (nan, inf, too large). */
int lrcsi_lines_number(lrcsi_lines *lines, const char *item, double *value, lrcs_where *where);

/* Fills `where` for the word at the present place, or for the end of the line or file. Returns
   `status`, or LRCS_E_TRUNCATED where it is LRCS_E_SYNTAX and the bytes end. */
int lrcsi_lines_fail(lrcsi_lines *lines, int status, const char *item, const char *expected,
                     lrcs_where *where);

#endif
