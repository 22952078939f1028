/* SPDX-License-Identifier: MIT */
/* Tables of text, as spreadsheets, instruments and other programs write them: a line for each row,
   fields apart by semicolons, tabs, commas or blanks (the first of these in the first line), in
   double quotes or not. Empty lines and lines from '#' on count for nothing; lines end in LF, CR LF
   or CR. */
#ifndef LRCS_TABLE_H
#define LRCS_TABLE_H

#include <lrcs/host.h>

#define LRCS_HOST_FIELDS 64u /* the most in a line */

typedef struct lrcs_host_field {
    const char *text; /* not ended by 0; blanks and quotes around it are left out */
    size_t size;
} lrcs_host_field;

typedef struct lrcs_host_table {
    const char *path;
    const char *at, *end;                    /* what is still to be read */
    uint64_t line;                           /* of the row, from 1 */
    char separator;                          /* ' ': any blanks; 0 before the first row */
    uint32_t columns;                        /* fields of the first row, and of every other */
    lrcs_host_field field[LRCS_HOST_FIELDS]; /* of the row */
    int named;                               /* do the columns have names? */
    lrcs_host_field name[LRCS_HOST_FIELDS];
} lrcs_host_table;

/* A table before its first row. File and path must outlive it; path is for error messages. */
lrcs_host_table lrcs_host_table_make(const char *path, const lrcs_host_file *file);

/* Reads the next row. Returned: 1, or 0 where there is none.
   Status: LRCS_E_LIMIT (more than LRCS_HOST_FIELDS fields); LRCS_E_SYNTAX (not as many as the first
   row has). */
int lrcs_host_table_read(lrcs_host_table *table, lrcs_host_error *error);

/* Takes the row for the names of the columns. Then the column of a name, whatever the case of its
   letters, or LRCS_NONE. */
void lrcs_host_table_names(lrcs_host_table *table);
uint32_t lrcs_host_table_column(const lrcs_host_table *table, const char *name);

/* Is the row's field `name`, whatever the case of letters? And does it begin so? 1 or 0. */
int lrcs_host_field_is(const lrcs_host_field *field, const char *name);
int lrcs_host_field_begins(const lrcs_host_field *field, const char *name);

/* A field of the row as a finite number. Status: LRCS_OK; LRCS_E_SYNTAX; LRCS_E_NUMBER: the
   sentence has file, line, column (its name where it has one), what was found and what was
   `expected`. */
int lrcs_host_field_read(const lrcs_host_table *table, uint32_t column, const char *expected,
                         double *value, lrcs_host_error *error);

/* Such a sentence for what a caller refuses itself. Returns the status it is given. */
int lrcs_host_field_refuse(const lrcs_host_table *table, int status, uint32_t column,
                           const char *expected, lrcs_host_error *error);

#endif
