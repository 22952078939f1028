/* SPDX-License-Identifier: MIT */
/* Marks of facets or edges: found in order, or made so that all are cleared at once. Below, a facet
   stands for either. */
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

/* Marks that are all cleared without touching their entries, except once in 2^31 times: a facet is
   marked if its entry is the current number. Entries and number are 0 at first. */
typedef struct lrcsi_marks {
    uint32_t *entry; /* facet */
    uint32_t number;
} lrcsi_marks;

/* The last number. Twice any number, and one more, are integers of 32 bits too. */
#define LRCSI_MARKS_LAST 0x7fffffffu

/* Unmarks all of `count` facets: the next number marks none. After the last one all entries become
   0, which marks no facet, and numbers begin again at 1. */
static inline void lrcsi_marks_clear(lrcsi_marks *marks, uint32_t count)
{
    if (marks->number == LRCSI_MARKS_LAST) {
        memset(marks->entry, 0, (size_t)count * sizeof *marks->entry);
        marks->number = 0;
    }
    marks->number++;
}

static inline int lrcsi_marked(const lrcsi_marks *marks, uint32_t facet)
{
    return marks->entry[facet] == marks->number;
}

#endif
