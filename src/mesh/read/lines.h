/* SPDX-License-Identifier: MIT */
/* Walking the statements of a text format of the Wavefront family: lines that end with LF, CRLF or
   CR, continued by a backslash at the end; words are separated by blanks, and a word that begins
   with '#' starts a comment. Comments are not continued, because paths in them may end with
   backslashes. */
#ifndef LRCSI_LINES_H
#define LRCSI_LINES_H

#include <lrcs/status.h>

typedef struct lrcsi_lines {
    const char *start, *at, *end;
    uint32_t line; /* of `at`, from 1 */
} lrcsi_lines;

/* Begins at the first statement; a UTF-8 byte order mark is skipped. */
lrcsi_lines lrcsi_lines_make(const void *bytes, size_t size);

/* Skips blanks and continuations. Returns 1 if the statement ends there. */
int lrcsi_lines_done(lrcsi_lines *lines);

/* Skips the rest of the statement. Returns 0 if the bytes end. */
int lrcsi_lines_next(lrcsi_lines *lines);

/* Reads the next word of the statement. Returns its length, 0 at the end of the statement. */
size_t lrcsi_lines_word(lrcsi_lines *lines, const char **word);

/* 1 if a word is `text`. */
int lrcsi_lines_is(const char *word, size_t size, const char *text);

/* Reads the rest of the line as a name: trimmed, with inner blanks and '#' kept. Returns its
   length. A continuation ends the name. */
size_t lrcsi_lines_name(lrcsi_lines *lines, const char **name);

/* Reads a word that is a finite number. Status: LRCS_OK; LRCS_E_SYNTAX, _TRUNCATED (nothing there),
   _NUMBER (nan, inf, too large). */
int lrcsi_lines_number(lrcsi_lines *lines, const char *item, double *value, lrcs_where *where);

/* Fills `where` for the word at the current position, or for the end of the line or file. Returns
   `status`, or LRCS_E_TRUNCATED if it is LRCS_E_SYNTAX and the bytes end. */
int lrcsi_lines_fail(lrcsi_lines *lines, int status, const char *item, const char *expected,
                     lrcs_where *where);

#endif
