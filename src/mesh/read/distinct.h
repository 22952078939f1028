/* SPDX-License-Identifier: MIT */
/* The distinct names in a file, numbered in order of appearance. */
#ifndef LRCSI_DISTINCT_H
#define LRCSI_DISTINCT_H

#include "base/index.h"

typedef struct lrcsi_distinct {
    const char **name; /* the caller's list, by number */
    lrcsi_index index;
} lrcsi_distinct;

/* An empty table for up to `capacity` names, lrcsi_index_need(capacity) bytes of the work area.
   Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_distinct_make(const char **name, uint32_t capacity, lrcs_work *work,
                        lrcsi_distinct *distinct);

/* The number of a name. One whose UTF-8 text (lrcsi_text_utf8) is new is written to *text, which is
   advanced past it, and gets the next number. */
uint32_t lrcsi_distinct_add(lrcsi_distinct *distinct, const char *bytes, size_t size, char **text);

#endif
