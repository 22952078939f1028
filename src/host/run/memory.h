/* SPDX-License-Identifier: MIT */
/* Memory from the heap: blocks that a scene owns, and work areas that grow until a step fits. */
#ifndef LRCSI_HOST_MEMORY_H
#define LRCSI_HOST_MEMORY_H

#include "host/fail.h"

/* A zeroed block that lives as long as the scene; NULL if there is no memory. */
void *lrcsi_host_take(lrcs_host_scene *scene, size_t count, size_t size);

/* A copy of a text, owned by the scene; NULL if there is no memory. */
char *lrcsi_host_copy(lrcs_host_scene *scene, const char *text, size_t size);

/* Memory of one step, or kept from one step to the next. Must be zero at first. */
typedef struct lrcsi_host_area {
    struct host_block *block;
    size_t size;
} lrcsi_host_area;

/* A step that needs a work area, and is tried in larger ones until it fits:

       lrcsi_host_attempt attempt = lrcsi_host_attempt_make(&area, need);
       while (lrcsi_host_attempt_next(&attempt, error)) {
           attempt.status = lrcs_sigma_run(..., &attempt.work, ...);
       }

   Afterwards `status` is that of the last attempt, or LRCS_E_SYSTEM if the heap has no more. */
typedef struct lrcsi_host_attempt {
    lrcsi_host_area *area;
    size_t need;    /* bytes of the work area */
    int left;       /* attempts */
    int status;     /* of the step; LRCS_E_MEMORY asks for a larger work area */
    lrcs_work work; /* of `need` bytes */
} lrcsi_host_attempt;

/* The first work area has `need` bytes even if the area has more, so that the result of a step does
   not depend on earlier steps. Each further one has at least twice as many, and what work.peak
   requires. */
lrcsi_host_attempt lrcsi_host_attempt_make(lrcsi_host_area *area, size_t need);

/* Is there another attempt to make? Then its work area is ready. */
int lrcsi_host_attempt_next(lrcsi_host_attempt *attempt, lrcs_host_error *error);

/* At the end of a step that leaves its result in its work area: after LRCS_OK the area joins a list
   of blocks; else it is freed. Returns the step's status. */
int lrcsi_host_attempt_keep(lrcsi_host_attempt *attempt, void **blocks);

void lrcsi_host_area_free(lrcsi_host_area *area);

/* Frees a list of blocks. */
void lrcsi_host_free(void *blocks);

/* Seconds on a clock that only goes forward. */
double lrcsi_host_seconds(void);

#endif
