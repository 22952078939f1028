/* SPDX-License-Identifier: MIT */
/* The rows of a sweep, read back. */
#ifndef LRCSI_SWEEP_READ_H
#define LRCSI_SWEEP_READ_H

#include <lrcs/rows.h>

/* The most columns that a row has, with index and flags. */
#define LRCSI_ROW_NAMES (LRCS_HOST_PLAN_COLUMNS + LRCS_HOST_ROW_FIELDS + 2)

/* Reads the first lines of opened rows, and completes `rows`. Keys and names of columns are texts
   in `words`, a copy that the caller frees in any case. Status: as lrcs_host_rows_open. */
int lrcsi_rows_head_read(lrcs_host_rows *rows, char **words, lrcs_host_rows_head *head,
                         const char *column[LRCS_HOST_PLAN_COLUMNS]);

/* Reads all rows of a file, which must be consecutive, up to the checksum. The plan may be NULL,
   and so may `take`, which is called for each row. Returned: the number of the first row; how many.
   Status: LRCS_OK; LRCS_E_SYNTAX; LRCS_E_TRUNCATED (no checksum): the sentence begins with the
   path. */
typedef void lrcsi_rows_take(void *context, const lrcs_host_row *row);
int lrcsi_rows_read(const char *path, const lrcs_host_rows *rows, const lrcs_host_plan *plan,
                    lrcsi_rows_take *take, void *context, uint64_t *first, uint64_t *count,
                    lrcs_host_error *error);

#endif
