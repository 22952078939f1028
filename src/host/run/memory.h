/* SPDX-License-Identifier: MIT */
/* Memory from the heap: blocks that a scene owns, and work areas that grow until a step fits. */
#ifndef LRCSI_HOST_MEMORY_H
#define LRCSI_HOST_MEMORY_H

#include "host/fail.h"

/* A zeroed block that lives as long as the scene; NULL if there is no memory. */
void *lrcsi_host_take(lrcs_host_scene *scene, size_t count, size_t size);

/* A copy of a text, owned by the scene; NULL if there is no memory. */
char *lrcsi_host_copy(lrcs_host_scene *scene, const char *text, size_t size);

/* A step that needs a work area: runs in `work`, returns a status. */
typedef int lrcsi_host_step(void *context, lrcs_work *work);

/* Runs a step in a work area of `need` bytes, and again in larger ones while it returns
   LRCS_E_MEMORY and work->peak requires more. After LRCS_OK the area joins the list of blocks.
   Status: the step's; LRCS_E_SYSTEM if the heap has no more. */
int lrcsi_host_step_run(void **blocks, size_t need, lrcsi_host_step *step, void *context,
                        lrcs_host_error *error);

/* Memory kept from one step to the next, for steps that leave no results in it. Must be zero at
   first. */
typedef struct lrcsi_host_area {
    void *bytes;
    size_t size;
} lrcsi_host_area;

/* The same in an area that only grows. Each call nevertheless begins with a work area of `need`
   bytes, so that the result of a step does not depend on earlier steps. */
int lrcsi_host_area_run(lrcsi_host_area *area, size_t need, lrcsi_host_step *step, void *context,
                        lrcs_host_error *error);
void lrcsi_host_area_free(lrcsi_host_area *area);

/* Frees a list of blocks. */
void lrcsi_host_free(void *blocks);

/* Seconds on a clock that only goes forward. */
double lrcsi_host_seconds(void);

#endif
