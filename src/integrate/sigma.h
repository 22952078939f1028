/* SPDX-License-Identifier: MIT */
/* The stages of one pose. They are called by lrcs_sigma_run, by computations that need intermediate
   results (integrate/derivative/uncertainty.c), and by hosts that time them, because the core has
   no clock. */
#ifndef LRCSI_SIGMA_H
#define LRCSI_SIGMA_H

#include "integrate/sigma_run.h"

/* Checks options and the size of a picture (NULL: none). Status: LRCS_OK; LRCS_E_ARGUMENT. */
int lrcsi_sigma_check(const lrcs_run_options *options, const lrcs_image *image);

/* Runs all stages up to request->last. Returned: run, whose results stay in the work area, also
   request->part_error. Status: as lrcs_sigma_run. */
int lrcsi_sigma_stages(const lrcsi_sigma_request *request, const lrcs_prepared *prepared,
                       const lrcs_pose *pose, lrcs_work *work, lrcsi_sigma *run);

/* A request for all stages, with memory for part_error if the options ask for it. Status: LRCS_OK;
   LRCS_E_MEMORY. */
int lrcsi_sigma_request_make(const lrcs_prepared *prepared, const lrcs_run_options *options,
                             lrcs_work *work, lrcsi_sigma_request *request);

/* Copies the errors of parts to where the options ask for them: once nothing can fail any more. */
void lrcsi_sigma_part_error_copy(const lrcsi_sigma *run);

/* The result after the last stage. Status: LRCS_OK; LRCS_E_NUMBER if sigma or its bound is not
   finite. */
int lrcsi_sigma_result(const lrcsi_sigma *run, lrcs_result *result);

/* Runs a pose up to a stage and discards the results. Status: as lrcs_sigma_run; LRCS_E_ARGUMENT
   for method AUTO, which may run stages more than once. */
int lrcsi_sigma_run_until(const lrcs_prepared *prepared, const lrcs_pose *pose,
                          const lrcs_run_options *options, int last, lrcs_work *work);

#endif
