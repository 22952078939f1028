/* SPDX-License-Identifier: MIT */
/* The distinct names in a file, numbered in order of appearance. */
#ifndef LRCSI_NAME_LIST_H
#define LRCSI_NAME_LIST_H

#include "base/index.h"

typedef struct lrcsi_name_list {
    const char **name; /* the caller's list, by number */
    lrcsi_index index;
} lrcsi_name_list;

/* An empty table for up to `capacity` names, lrcsi_index_need(capacity) bytes of the work area.
   Status: LRCS_OK; LRCS_E_MEMORY. */
int lrcsi_name_list_make(const char **name, uint32_t capacity, lrcs_work *work,
                         lrcsi_name_list *list);

/* The number of a name. One whose UTF-8 text (lrcsi_text_utf8) is new is written to *text, which is
   advanced past it, and gets the next number. */
uint32_t lrcsi_name_list_add(lrcsi_name_list *list, const char *bytes, size_t size, char **text);

#endif
