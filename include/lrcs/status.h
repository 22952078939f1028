/* SPDX-License-Identifier: MIT */
/* Status codes, their texts, and where in the input a reader stopped. */
#ifndef LRCS_STATUS_H
#define LRCS_STATUS_H

#include <stddef.h>
#include <stdint.h>

#define LRCS_VERSION_MAJOR 0
#define LRCS_VERSION_MINOR 2
#define LRCS_VERSION_PATCH 1
#define LRCS_VERSION_TEXT  "0.2.1"

/* "No such index": a facet without a material, a missing neighbour. */
#define LRCS_NONE UINT32_MAX

/* Pointers are not NULL unless a comment says so.
   Every function that can fail returns one of these; on failure its outputs are unchanged
   (except `where`, which then states the place). */
enum lrcs_status {
    LRCS_OK = 0,
    LRCS_E_ARGUMENT = -1,    /* an argument outside the documented domain */
    LRCS_E_MEMORY = -2,      /* the work area is too small */
    LRCS_E_SYNTAX = -3,      /* the bytes do not follow the format */
    LRCS_E_TRUNCATED = -4,   /* the bytes end inside an item */
    LRCS_E_INDEX = -5,       /* an index outside its list */
    LRCS_E_NUMBER = -6,      /* a number that is not finite, or outside its range */
    LRCS_E_NAME = -7,        /* an unknown name, or a name given twice */
    LRCS_E_LIMIT = -8,       /* more items than the library holds (2^32 - 2) */
    LRCS_E_UNSUPPORTED = -9, /* well formed, but not supported by this version */
    LRCS_E_EMPTY = -10       /* nothing to read: no bytes, no facets */
};

/* One sentence for a status, also for unknown codes. Never NULL. */
const char *lrcs_status_text(int status);

/* The version as text, "MAJOR.MINOR.PATCH". */
const char *lrcs_version(void);

/* Where a reader stopped. `item` and `expected` point to constant text, never NULL after a
   failure; `found` holds a printable UTF-8 excerpt or a number, truncated to fit. */
typedef struct lrcs_where {
    uint64_t offset;      /* byte offset in the input */
    uint32_t line;        /* line, counted from 1; 0 if the format has no lines */
    const char *item;     /* what was being read: "face index", "chunk 0x4110" */
    const char *expected; /* what the format requires there */
    char found[64];       /* what was found instead */
} lrcs_where;

#endif
