/* SPDX-License-Identifier: MIT */
/* Marks of facets: found in order, or made so that they need no clearing. */
#ifndef LRCSI_MARKS_H
#define LRCSI_MARKS_H

#include <stdint.h>
#include <string.h>

/* The first facet from `facet` on that is marked with a value, or `count` if there is none. */
static inline uint32_t lrcsi_marks_next(const unsigned char *mark, uint32_t facet, uint32_t count,
                                        int value)
{
    const unsigned char *at = facet < count ? memchr(mark + facet, value, count - facet) : NULL;
    return at ? (uint32_t)(at - mark) : count;
}

/* Marks that need no clearing: a facet is marked if its entry is the current number. */
typedef struct lrcsi_marks {
    uint32_t *entry; /* facet */
    uint32_t number;
} lrcsi_marks;

static inline int lrcsi_marked(const lrcsi_marks *marks, uint32_t facet)
{
    return marks->entry[facet] == marks->number;
}

#endif
