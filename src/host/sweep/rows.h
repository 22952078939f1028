/* SPDX-License-Identifier: MIT */
/* What writing the rows of a sweep and reading them back share. */
#ifndef LRCSI_SWEEP_ROWS_H
#define LRCSI_SWEEP_ROWS_H

#include <lrcs/rows.h>

/* The keys in the first lines which state that rows have the fields of a group. */
#define LRCSI_ROWS_UNCERTAINTY  "uncertainty"
#define LRCSI_ROWS_COARSE_GLINT "coarse_glint"

/* The name of a field's column, and the fields that a sweep has. */
const char *lrcsi_row_field_text(int field);
lrcs_host_row_fields lrcsi_row_fields(int materials, int glint);

/* The last line of a file. */
#define LRCSI_ROWS_SUM_SIZE 64
void lrcsi_rows_sum_text(int format, uint64_t sum, char text[LRCSI_ROWS_SUM_SIZE]);

#endif
