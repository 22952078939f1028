/* SPDX-License-Identifier: MIT */
/* The stages of lrcs_sigma_run, so that a host can time them: the core has no clock. */
#ifndef LRCSI_SIGMA_H
#define LRCSI_SIGMA_H

#include <lrcs/run.h>

enum lrcsi_sigma_stage {
    LRCSI_SIGMA_VIEW,       /* which way facets face; view coordinates, if they are wanted */
    LRCSI_SIGMA_CLASSIFY,   /* event edges; facets seen whole or not at all, and undecided ones */
    LRCSI_SIGMA_VISIBILITY, /* visible areas */
    LRCSI_SIGMA_SUM,        /* Eq. 2; curved facets of which samples tell */
    LRCSI_SIGMA_STAGES
};

/* Runs a pose up to a stage and drops what it found. The method is not AUTO, which may go through
   stages more than once: LRCS_E_ARGUMENT. Else as lrcs_sigma_run. */
int lrcsi_sigma_until(const lrcs_prepared *prepared, const lrcs_pose *pose,
                      const lrcs_run_options *options, int last, lrcs_work *work);

#endif
