/* SPDX-License-Identifier: MIT */
/* Memory from the heap: blocks that a scene owns, and work areas that grow until a step fits. */
#ifndef LRCSI_HOST_MEMORY_H
#define LRCSI_HOST_MEMORY_H

#include "host/fail.h"

/* A block that lives as long as the scene, every byte zero; NULL where there is none. */
void *lrcsi_host_take(lrcs_host_scene *scene, size_t count, size_t size);

/* A copy of a text, owned by the scene; NULL where there is no memory. */
char *lrcsi_host_copy(lrcs_host_scene *scene, const char *text, size_t size);

/* A step that needs a work area: runs in `work`, returns a status. */
typedef int lrcsi_host_step(void *context, lrcs_work *work);

/* Runs a step in a work area of `need` bytes, and again in larger ones while it says
   LRCS_E_MEMORY and work->peak asks for more. Where the area outlives the step it joins the list
   of blocks; else (blocks NULL) it is freed.
   Status: the step's; LRCS_E_SYSTEM where the heap has no more. */
int lrcsi_host_step_run(void **blocks, size_t need, lrcsi_host_step *step, void *context,
                        lrcs_host_error *error);

/* Frees a list of blocks. */
void lrcsi_host_free(void *blocks);

/* Seconds on a clock that only goes forward. */
double lrcsi_host_seconds(void);

#endif
