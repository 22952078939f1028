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

#define LRCSI_TOML_NAME    32u /* names of this many bytes or more are counted, not kept whole */
#define LRCSI_TOML_NUMBERS 6u  /* numbers of an array beyond this many are counted, not kept */

typedef struct lrcsi_toml_name {
    size_t size; /* bytes, once unescaped */
    char text[LRCSI_TOML_NAME];
} lrcsi_toml_name;

/* A header, or a key with its value. */
typedef struct lrcsi_toml_event {
    int kind; /* lrcsi_toml_kind */
    uint32_t line;
    uint32_t name_count;
    lrcsi_toml_name name[2];
    const char *raw; /* the key or header as it is in the file, and its value */
    size_t raw_size;
    const char *value_raw;
    size_t value_size;
    int type;         /* lrcsi_toml_type */
    const char *text; /* a string's bytes, UTF-8, terminated; in the work area */
    int truth;
    uint32_t count; /* of an array's numbers; 1 for a number alone */
    double number[LRCSI_TOML_NUMBERS];
} lrcsi_toml_event;

typedef struct lrcsi_toml {
    const char *start, *at, *end;
    uint32_t line;
    lrcs_work *work; /* NULL: strings are checked and not kept */
    lrcs_where *where;
} lrcsi_toml;

/* Begins, and checks all bytes once: UTF-8, and no control characters but tab and line ends.
   Status: LRCS_OK; LRCS_E_SYNTAX. */
int lrcsi_toml_start(lrcsi_toml *toml, const char *text, size_t size, lrcs_work *work,
                     lrcs_where *where);

/* The next header or key; LRCSI_TOML_END at the end, and in every later call. Status: LRCS_OK;
   LRCS_E_SYNTAX, _UNSUPPORTED, _NUMBER, _MEMORY. */
int lrcsi_toml_next(lrcsi_toml *toml, lrcsi_toml_event *event);

/* 1 if a name is `text`, which has fewer than LRCSI_TOML_NAME bytes. */
int lrcsi_toml_name_is(const lrcsi_toml_name *name, const char *text);

/* Reports what is wrong with something that was read: its bytes are quoted. Returns `status`. */
int lrcsi_toml_refuse(const lrcsi_toml *toml, int status, uint32_t line, const char *raw,
                      size_t size, const char *item, const char *expected);

/* The offset in the text at which line `line` begins. */
size_t lrcsi_toml_offset(const char *text, size_t size, uint32_t line);

#endif
