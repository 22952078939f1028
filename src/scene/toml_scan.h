/* SPDX-License-Identifier: MIT */
/* The pieces of the TOML reader: moving through the bytes, refusing what stands there, and values.
   Only scene/toml*.c use it. */
#ifndef LRCSI_TOML_SCAN_H
#define LRCSI_TOML_SCAN_H

#include "scene/toml.h"

/* Bytes of the file that a message quotes at most. */
#define LRCSI_TOML_EXCERPT 40

static inline int lrcsi_toml_is_end(char c)
{
    return c == '\n' || c == '\r';
}

/* A byte that may stand in a number, a date, a boolean. */
static inline int lrcsi_toml_is_literal(char c)
{
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' ||
           c == '+' || c == '-' || c == '.' || c == ':';
}

/* Does this byte stand next? */
static inline int lrcsi_toml_peek(const lrcsi_toml *toml, char c)
{
    return toml->at < toml->end && *toml->at == c;
}

/* Reports what stands at `at`, to the end of its line. Returns `status`. */
int lrcsi_toml_stop(const lrcsi_toml *toml, int status, const char *at, const char *item,
                    const char *expected);

/* Passes blanks; blanks, comments and line ends; or the rest of a line, in which nothing else may
   stand (LRCS_E_SYNTAX). */
void lrcsi_toml_blanks(lrcsi_toml *toml);
void lrcsi_toml_lines(lrcsi_toml *toml);
int lrcsi_toml_line_end(lrcsi_toml *toml, const char *item);

/* A string, its quote standing at toml->at. Bytes beyond `room` are counted in *size, not kept. */
int lrcsi_toml_quoted(lrcsi_toml *toml, char *out, size_t room, size_t *size);

/* A value of any type: fills event's type, text, truth, count and number. */
int lrcsi_toml_value(lrcsi_toml *toml, lrcsi_toml_event *event);

#endif
