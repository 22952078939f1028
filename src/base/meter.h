/* SPDX-License-Identifier: MIT */
/* Work that may still be done: steps, each of bounded time, taken before they are made. Once one is
   refused all are, so that whoever asks at the end of a piece of work learns whether all of it was
   done. NULL: no limit. */
#ifndef LRCSI_METER_H
#define LRCSI_METER_H

#include <stddef.h>
#include <stdint.h>

typedef struct lrcsi_meter {
    uint64_t most, taken;
    int spent;
} lrcsi_meter;

/* 1 where so many steps may be made, which are taken; 0 where not. */
static inline int lrcsi_meter_take(lrcsi_meter *meter, uint64_t steps)
{
    if (!meter) {
        return 1;
    }
    if (meter->spent || steps > meter->most - meter->taken) {
        meter->spent = 1;
        return 0;
    }
    meter->taken += steps;
    return 1;
}

static inline int lrcsi_meter_spent(const lrcsi_meter *meter)
{
    return meter && meter->spent;
}

#endif
