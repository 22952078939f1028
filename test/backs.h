/* SPDX-License-Identifier: MIT */
/* Prepared scenes in which the backs of solid shells are drawn too. */
#ifndef TEST_BACKS_H
#define TEST_BACKS_H

#include "scene/prepared.h"

/* Lets the backs of solid shells cast as others do. */
static inline void scene_draw_all_backs(lrcs_prepared *prepared)
{
    prepared->solid = 0;
    for (uint32_t f = 0; f < prepared->scene->facet_count; f++) {
        if (prepared->redundant[f] == LRCSI_REDUNDANT_IN_SOLID) {
            prepared->redundant[f] = LRCSI_NOT_REDUNDANT;
        }
    }
}

#endif
