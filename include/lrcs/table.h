/* SPDX-License-Identifier: MIT */
/* Text tables, as written by spreadsheets, instruments and other programs: one line per row; fields
   separated by semicolons, tabs, commas or blanks (the first of these that the first line
   contains), optionally in double quotes. Empty lines and lines that begin with '#' are ignored;
   lines end in LF, CR LF or CR. */
#ifndef LRCS_TABLE_H
#define LRCS_TABLE_H

#include <lrcs/host.h>

#define LRCS_HOST_FIELDS 64u /* maximum per line */

typedef struct lrcs_host_field {
    const char *text; /* not terminated; without the blanks and quotes around it */
    size_t size;
} lrcs_host_field;

typedef struct lrcs_host_table {
    const char *path;
    const char *at, *end;                    /* the part still to be read */
    uint64_t line;                           /* of the row, from 1 */
    char separator;                          /* ' ': any blanks; 0 before the first row */
    uint32_t columns;                        /* number of fields, the same in every row */
    lrcs_host_field field[LRCS_HOST_FIELDS]; /* of the row */
    int named;                               /* 1: the columns have names */
    lrcs_host_field name[LRCS_HOST_FIELDS];
} lrcs_host_table;

/* A table, positioned before its first row. File and path must outlive it; path is for error
   messages. */
lrcs_host_table lrcs_host_table_make(const char *path, const lrcs_host_file *file);

/* Reads the next row. Returned: 1, or 0 if there is none.
   Status: LRCS_E_LIMIT (more than LRCS_HOST_FIELDS fields); LRCS_E_SYNTAX (the number of fields
   differs from the first row's). */
int lrcs_host_table_read(lrcs_host_table *table, lrcs_host_error *error);

/* lrcs_host_table_names takes the current row as the names of the columns. Afterwards,
   lrcs_host_table_column is the column of a name, ignoring case, or LRCS_NONE. */
void lrcs_host_table_names(lrcs_host_table *table);
uint32_t lrcs_host_table_column(const lrcs_host_table *table, const char *name);

/* 1 if the field equals `name`, or begins with it, ignoring case; else 0. */
int lrcs_host_field_is(const lrcs_host_field *field, const char *name);
int lrcs_host_field_begins(const lrcs_host_field *field, const char *name);

/* Reads a field of the row as a finite number. Status: LRCS_OK; LRCS_E_SYNTAX; LRCS_E_NUMBER: the
   sentence states file, line, column (its name if it has one), what was found and what was
   `expected`. */
int lrcs_host_field_read(const lrcs_host_table *table, uint32_t column, const char *expected,
                         double *value, lrcs_host_error *error);

/* Makes the same sentence for a field that the caller rejects. Returns `status`. */
int lrcs_host_field_refuse(const lrcs_host_table *table, int status, uint32_t column,
                           const char *expected, lrcs_host_error *error);

/* ---- lines of keys ---- */

/* A line "WORDS; key=text; key=text", whose texts may contain "; " too: each ends where the next
   "; key=" begins. */

/* The place of the next "; key=", or NULL. */
char *lrcs_host_key_next(const char *line);

/* Copies the text of a key, cut at the size. Returns 0 if the key is missing. */
int lrcs_host_key_text(const char *line, const char *key, char *text, size_t size);

/* The number of a key, or NAN. */
double lrcs_host_key_number(const char *line, const char *key);

/* Ends a JSON text, which begins at `at` after its quote, at its closing quote, each escaped
   character (a quote or a backslash) by itself. Returns what follows. */
char *lrcs_host_json_unquote(char *at);

#endif
