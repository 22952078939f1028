/* SPDX-License-Identifier: MIT */
/* Joining items into groups (union-find): parent[i] = i at first; the root, the
   first item of its group, names it. */
#ifndef LRCSI_JOIN_H
#define LRCSI_JOIN_H

#include <stdint.h>

static inline uint32_t lrcsi_join_root(uint32_t *parent, uint32_t i)
{
    while (parent[i] != i) { /* halving the path: every step shortens it */
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static inline void lrcsi_join(uint32_t *parent, uint32_t i, uint32_t j)
{
    i = lrcsi_join_root(parent, i);
    j = lrcsi_join_root(parent, j);
    parent[i > j ? i : j] = i > j ? j : i;
}

/* Names every item by its root: parents come before their children, so one pass does. */
static inline void lrcsi_join_settle(uint32_t *parent, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        parent[i] = parent[parent[i]];
    }
}

#endif
