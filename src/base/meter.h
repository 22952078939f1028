/* SPDX-License-Identifier: MIT */
/* A limit on the number of steps, each of bounded time, which are reserved before they are
   executed. Once a request is refused, all later ones are refused too: a caller who checks at the
   end of a piece of work knows whether all of it was done. NULL: no limit. */
#ifndef LRCSI_METER_H
#define LRCSI_METER_H

#include <stddef.h>
#include <stdint.h>

typedef struct lrcsi_meter {
    uint64_t limit, taken; /* steps */
    int spent;
} lrcsi_meter;

/* Reserves `steps` steps. Returns 1, or 0 if the limit does not allow them. */
static inline int lrcsi_meter_take(lrcsi_meter *meter, uint64_t steps)
{
    if (!meter) {
        return 1;
    }
    if (meter->spent || steps > meter->limit - meter->taken) {
        meter->spent = 1;
        return 0;
    }
    meter->taken += steps;
    return 1;
}

/* The steps that may still be taken; UINT64_MAX without a limit. */
static inline uint64_t lrcsi_meter_left(const lrcsi_meter *meter)
{
    return !meter ? UINT64_MAX : meter->spent ? 0 : meter->limit - meter->taken;
}

static inline int lrcsi_meter_spent(const lrcsi_meter *meter)
{
    return meter && meter->spent;
}

#endif
