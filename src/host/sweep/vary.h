/* SPDX-License-Identifier: MIT */
/* What a sweep changes in a scene. */
#ifndef LRCSI_SWEEP_VARY_H
#define LRCSI_SWEEP_VARY_H

#include <lrcs/plan.h>

/* Adds the axes of the texts `joint` and `vary`; call before those of the pose are added. Status:
   as lrcs_host_plan_make. */
int lrcsi_vary_read(const lrcs_host_plan_text *given, int count, lrcs_host_plan *plan,
                    lrcs_host_error *error);

#endif
