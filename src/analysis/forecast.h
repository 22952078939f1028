/* SPDX-License-Identifier: MIT */
/* The expected time of runs, by the cost model of the planner (integrate/plan/cost.h). */
#ifndef LRCSI_FORECAST_H
#define LRCSI_FORECAST_H

#include <lrcs/run.h>

/* Bytes of work area. */
size_t lrcsi_forecast_need(const lrcs_prepared *prepared);

/* Expected seconds of a pose with each of the options: lrcs_host_scene_forecast. Nothing stays in
   the work area. Status: LRCS_OK; LRCS_E_ARGUMENT; LRCS_E_MEMORY; LRCS_E_NUMBER;
   LRCS_E_UNSUPPORTED. */
int lrcsi_forecast_run(const lrcs_prepared *prepared, const lrcs_pose *pose,
                       const lrcs_run_options *options, uint32_t count, lrcs_work *work,
                       double *seconds);

#endif
