/* SPDX-License-Identifier: MIT */
/* Tables with named columns, of kits and of answers to them. A column is given by the index of its
   name among those asked for. */
#ifndef LRCSI_KIT_TABLE_H
#define LRCSI_KIT_TABLE_H

#include <lrcs/conformance.h>
#include <lrcs/table.h>

#define LRCSI_KIT_COLUMNS 24 /* more than any table of a kit has */

typedef struct lrcsi_kit_table {
    lrcs_host_file file;
    lrcs_host_table text;
    lrcs_host_error *error;             /* of all faults */
    size_t lines;                       /* an upper bound of the number of rows */
    uint32_t column[LRCSI_KIT_COLUMNS]; /* of each name asked for; LRCS_NONE if there is none */
} lrcsi_kit_table;

/* Opens a table and looks for the named columns, of which the first `needed` ones must exist.
   Status: as lrcs_host_judge. The caller closes it in any case. */
int lrcsi_kit_table_open(const char *path, const char *const *name, int count, int needed,
                         lrcsi_kit_table *table, lrcs_host_error *error);
void lrcsi_kit_table_close(lrcsi_kit_table *table);

/* 1 if the table has the column. lrcsi_kit_table_missing is the fault that it is missing. */
int lrcsi_kit_table_has(const lrcsi_kit_table *table, int name);
int lrcsi_kit_table_missing(const lrcsi_kit_table *table, const char *name);

/* Reads the next line that is not empty: 1, or 0 at the end and if *status is not LRCS_OK, which a
   faulty line makes it. */
int lrcsi_kit_table_next(lrcsi_kit_table *table, int *status);

/* A field of the line: its text; a name, a number, or a number that may be nan or inf. Status:
   LRCS_OK; others with a sentence that states the line, the column, what was found and what was
   expected. */
const lrcs_host_field *lrcsi_kit_table_field(const lrcsi_kit_table *table, int name);
int lrcsi_kit_table_name(const lrcsi_kit_table *table, int name, char text[LRCS_HOST_KIT_NAME]);
int lrcsi_kit_table_number(const lrcsi_kit_table *table, int name, double *value);
int lrcsi_kit_table_answer(const lrcsi_kit_table *table, int name, double *value);

/* LRCS_E_SYNTAX for any other fault of a field in the same form. */
__attribute__((format(printf, 3, 4))) int lrcsi_kit_table_refuse(const lrcsi_kit_table *table,
                                                                 int name, const char *format, ...);

#endif
