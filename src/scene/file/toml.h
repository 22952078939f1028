/* SPDX-License-Identifier: MIT */
/* A pull reader for a strict subset of TOML 1.0: every text that it accepts is TOML with the same
   values. In the subset: comments; [a], [a.b], [[a]] and [[a.b]] headers; bare and quoted keys;
   single-line strings, "basic" and 'literal'; decimal integers below 2^53, finite floats, booleans;
   arrays of numbers, also over several lines. Refused as unsupported: dotted keys, multi-line
   strings, inline and nested structures, dates, hexadecimal, U+0000, inf, nan. A byte order mark at
   the start is skipped. The schema decides which tables and keys are known, and refuses
   duplicates. */
#ifndef LRCSI_TOML_H
#define LRCSI_TOML_H

#include <lrcs/status.h>
#include <lrcs/work.h>

enum lrcsi_toml_kind {
    LRCSI_TOML_NONE = 0,
    LRCSI_TOML_END,
    LRCSI_TOML_TABLE,   /* [a] or [a.b] */
    LRCSI_TOML_ELEMENT, /* [[a]] or [[a.b]] */
    LRCSI_TOML_KEY
};

/* Types of values, as bits, so that a schema can allow several. */
enum lrcsi_toml_type {
    LRCSI_TOML_STRING = 1,
    LRCSI_TOML_NUMBER = 2,
    LRCSI_TOML_BOOLEAN = 4,
    LRCSI_TOML_ARRAY = 8
};

#define LRCSI_TOML_NAME    32u /* of longer names only so many bytes are kept */
#define LRCSI_TOML_NUMBERS 6u  /* of longer arrays only so many numbers are kept */

typedef struct lrcsi_toml_name {
    size_t size; /* of the whole unescaped name, bytes */
    char text[LRCSI_TOML_NAME];
} lrcsi_toml_name;

/* A header, or a key with its value. */
typedef struct lrcsi_toml_event {
    int kind; /* lrcsi_toml_kind */
    uint32_t line;
    uint32_t name_count;
    lrcsi_toml_name name[2];
    const char *raw; /* the key or header as written in the file */
    size_t raw_size;
    const char *value_raw; /* the value as written in the file */
    size_t value_size;
    /* The value: */
    int type;         /* lrcsi_toml_type */
    const char *text; /* of a string: its UTF-8 bytes, terminated; in the work area */
    int boolean;
    uint32_t count; /* of the numbers of an array; 1 for a single number */
    double number[LRCSI_TOML_NUMBERS];
} lrcsi_toml_event;

typedef struct lrcsi_toml {
    const char *start, *at, *end;
    uint32_t line;
    lrcs_work *work; /* NULL: strings are checked but not kept */
    lrcs_where *where;
} lrcsi_toml;

/* Starts reading, and checks all bytes: they must be UTF-8 without control characters except tabs
   and line ends. Status: LRCS_OK; LRCS_E_SYNTAX. */
int lrcsi_toml_start(lrcsi_toml *toml, const char *text, size_t size, lrcs_work *work,
                     lrcs_where *where);

/* The next header or key; LRCSI_TOML_END at the end, and in every later call. Status: LRCS_OK;
   LRCS_E_SYNTAX, _UNSUPPORTED, _NUMBER, _MEMORY. */
int lrcsi_toml_next(lrcsi_toml *toml, lrcsi_toml_event *event);

/* 1 if a name is `text`, which has fewer than LRCSI_TOML_NAME bytes. */
int lrcsi_toml_name_is(const lrcsi_toml_name *name, const char *text);

/* Reports an error in something that was read, quoting its bytes. Returns `status`. */
int lrcsi_toml_refuse(const lrcsi_toml *toml, int status, uint32_t line, const char *raw,
                      size_t size, const char *item, const char *expected);

/* The offset in the text at which line `line` begins. */
size_t lrcsi_toml_offset(const char *text, size_t size, uint32_t line);

#endif
