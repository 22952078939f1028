/* SPDX-License-Identifier: MIT */
/* Jobs in threads, whose results are handed over in order. */
#ifndef LRCSI_WORKERS_H
#define LRCSI_WORKERS_H

#include <signal.h>

#include "host/fail.h"

typedef struct lrcsi_workers {
    uint64_t first, count; /* jobs */
    uint32_t threads;      /* the calling one among them; >= 1 */
    size_t slot_size;      /* bytes of the result of a job */
    void *context;
    /* does a job; several at a time, each with a worker number and a slot of its own */
    void (*work)(void *context, uint32_t worker, uint64_t index, void *slot);
    /* takes its result, on the calling thread, in order; a status other than LRCS_OK ends the work
     */
    int (*take)(void *context, uint64_t index, const void *slot);
    const volatile sig_atomic_t *cancel; /* or NULL; read by the calling thread only */
} lrcsi_workers;

/* Returned: done, the number of jobs taken.
   Status: LRCS_OK; LRCS_E_CANCELLED; LRCS_E_SYSTEM (memory); as take. */
int lrcsi_workers_run(const lrcsi_workers *workers, uint64_t *done, lrcs_host_error *error);

#endif
