/* SPDX-License-Identifier: MIT */
/* A flight task: sigma of one fixed scene for a new attitude every cycle. */
#ifndef FLIGHT_TASK_H
#define FLIGHT_TASK_H

#include <stddef.h>
#include <stdint.h>

/* What goes down after every cycle. */
typedef struct flight_telemetry {
    uint32_t cycle;
    int32_t status;    /* of this cycle: 0, or an lrcs_status */
    uint32_t stale;    /* cycles since sigma and bound were good; 0: they are this cycle's */
    uint32_t failures; /* since start */
    uint32_t flags;    /* lrcs_flag: how the last good answer is degraded */
    double sigma_m2, bound_m2;
    size_t memory_peak; /* bytes of the arena that were ever in use */
} flight_telemetry;

/* Once, before the first cycle. Returns 0, or the lrcs_status that forbids to go on. */
int32_t flight_start(void);

/* One cycle. Attitude: quaternion (w, x, y, z), body to observation frame; not trusted. */
void flight_cycle(const double attitude[4], flight_telemetry *telemetry);

#endif
