/* SPDX-License-Identifier: MIT */
/* An index from names to numbers: open addressing over FNV-1a, in the work area. */
#ifndef LRCSI_INDEX_H
#define LRCSI_INDEX_H

#include <lrcs/status.h>
#include <lrcs/work.h>

/* A name is a byte string and a tag, which distinguishes names of different kinds. */
typedef struct lrcsi_index_entry {
    const void *bytes;
    size_t size;
    uint32_t tag, value;
} lrcsi_index_entry;

typedef struct lrcsi_index {
    lrcsi_index_entry *name;
    uint32_t *slot; /* mask + 1 slots: 0 if empty, else a name's index + 1 */
    size_t mask;
    uint32_t count;
} lrcsi_index;

/* Bytes for an index of at most `count` names (upper bound). */
size_t lrcsi_index_need(size_t count);

/* An empty index for at most `count` names, whose bytes are not copied. Status: LRCS_OK;
   LRCS_E_MEMORY. */
int lrcsi_index_make(lrcs_work *work, uint32_t count, lrcsi_index *names);

/* The value of a name, or LRCS_NONE. */
uint32_t lrcsi_index_find(const lrcsi_index *names, uint32_t tag, const void *bytes, size_t size);

/* Sets the value of a name, new or known. */
void lrcsi_index_put(lrcsi_index *names, uint32_t tag, const void *bytes, size_t size,
                     uint32_t value);

#endif
