/* SPDX-License-Identifier: MIT */
/* A flight task: sigma of one fixed scene for a new attitude every cycle. */
#ifndef FLIGHT_TASK_H
#define FLIGHT_TASK_H

#include <stdint.h>

/* Steps that a cycle may take; where they do not suffice, the answer comes all the same, its bound
 * holds what they left open, and its flags say so. */
#ifndef FLIGHT_STEPS
#define FLIGHT_STEPS 150000u
#endif
_Static_assert(FLIGHT_STEPS > 0 && FLIGHT_STEPS <= UINT32_MAX, "0 would be no limit at all");

/* What goes down after every cycle. */
typedef struct flight_telemetry {
    uint32_t cycle;
    int32_t status;    /* of this cycle: 0, or an lrcs_status */
    uint32_t stale;    /* cycles since sigma and bound were good; 0: they are this cycle's */
    uint32_t failures; /* since start */
    uint32_t flags;    /* lrcs_flag: how the last good answer is degraded */
    uint32_t notices;  /* lrcs_notice: what it refers to */
    double sigma_m2;   /* the last good answer; before the first, 0 and a bound that is infinite */
    double bound_m2;
    uint32_t steps;       /* of the last good answer, of at most FLIGHT_STEPS */
    uint32_t memory_used; /* bytes of the arena that stay in use between cycles */
    uint32_t memory_peak; /* that were ever in use */
} flight_telemetry;

/* Once, before the first cycle. Returns 0, or the lrcs_status that forbids to go on. */
int32_t flight_start(void);

/* One cycle; without a flight_start that returned 0 its status is LRCS_E_EMPTY. Attitude:
 * quaternion (w, x, y, z), body to observation frame; not trusted. */
void flight_cycle(const double attitude[4], flight_telemetry *telemetry);

#endif
