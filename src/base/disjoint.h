/* SPDX-License-Identifier: MIT */
/* Disjoint sets of 0 .. count-1 (union-find). Initially parent[i] = i. A set is identified by its
   root, which is its smallest item. */
#ifndef LRCSI_DISJOINT_H
#define LRCSI_DISJOINT_H

#include <stdint.h>

static inline uint32_t lrcsi_disjoint_root(uint32_t *parent, uint32_t i)
{
    while (parent[i] != i) { /* path halving: every step shortens the path */
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static inline void lrcsi_disjoint_union(uint32_t *parent, uint32_t i, uint32_t j)
{
    i = lrcsi_disjoint_root(parent, i);
    j = lrcsi_disjoint_root(parent, j);
    parent[i > j ? i : j] = i > j ? j : i;
}

/* Makes the root the parent of every item. Parents precede their children, so that one pass
   suffices. */
static inline void lrcsi_disjoint_flatten(uint32_t *parent, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        parent[i] = parent[parent[i]];
    }
}

#endif
