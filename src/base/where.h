/* SPDX-License-Identifier: MIT */
/* Filling lrcs_where: the position and reason at which a reader stopped. Each function returns
   `status`, so that a reader can write `return lrcsi_where_text(...)`. `where` may be NULL. */
#ifndef LRCSI_WHERE_H
#define LRCSI_WHERE_H

#include <lrcs/status.h>

/* Found: an excerpt of text; bytes that are not printable become "\xNN", cut to fit. */
int lrcsi_where_text(lrcs_where *where, int status, uint64_t offset, uint32_t line,
                     const char *item, const char *expected, const char *found, size_t size);

/* Appends text, or an unsigned number, to what was found: "6" and " bytes". Cut to fit. */
void lrcsi_where_add(lrcs_where *where, const char *text);
void lrcsi_where_add_number(lrcs_where *where, uint64_t number);

/* Found: an unsigned number. */
int lrcsi_where_number(lrcs_where *where, int status, uint64_t offset, uint32_t line,
                       const char *item, const char *expected, uint64_t found);

#endif
