/* SPDX-License-Identifier: MIT */
/* Disjoint sets (union-find): initially parent[i] = i. A set is identified by its root, which is
   its first item. */
#ifndef LRCSI_JOIN_H
#define LRCSI_JOIN_H

#include <stdint.h>

static inline uint32_t lrcsi_join_root(uint32_t *parent, uint32_t i)
{
    while (parent[i] != i) { /* path halving: every step shortens the path */
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

/* Sets every parent to the root. Parents precede their children, so that one pass suffices. */
static inline void lrcsi_join_settle(uint32_t *parent, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        parent[i] = parent[parent[i]];
    }
}

#endif
