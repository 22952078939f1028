/* SPDX-License-Identifier: MIT */
/* A flight task: sigma of one fixed scene for a new attitude every cycle. */
#ifndef FLIGHT_TASK_H
#define FLIGHT_TASK_H

#include <stdint.h>

/* Steps that a cycle may take. If they do not suffice, there is an answer nevertheless; its bound
   includes what was left undecided, and a flag is set. */
#ifndef FLIGHT_STEPS
#define FLIGHT_STEPS 150000u
#endif
_Static_assert(FLIGHT_STEPS > 0 && FLIGHT_STEPS <= UINT32_MAX, "0 would be no limit at all");

/* What goes down after every cycle. */
typedef struct flight_telemetry {
    uint32_t cycle;
    int32_t status;    /* of this cycle: 0, or an lrcs_status */
    uint32_t stale;    /* cycles since sigma and bound were computed; 0: in this cycle */
    uint32_t failures; /* since start */
    uint32_t flags;    /* lrcs_flag: how the last good answer is degraded */
    uint32_t notices;  /* lrcs_notice: what it refers to */
    double sigma_m2;   /* the last good answer; before the first, 0 and a bound that is infinite */
    double bound_m2;
    uint32_t steps;       /* of the last good answer, of at most FLIGHT_STEPS */
    uint32_t memory_used; /* bytes of the arena that stay in use between cycles */
    uint32_t memory_peak; /* that were ever in use */
} flight_telemetry;

/* To be called once, before the first cycle. Returns 0, or the lrcs_status that prevents the task
   from running. */
int32_t flight_start(void);

/* Runs one cycle; its status is LRCS_E_EMPTY unless flight_start returned 0. Attitude: quaternion
   (w, x, y, z), body to observation frame; it is checked. */
void flight_cycle(const double attitude[4], flight_telemetry *telemetry);

#endif
