/* SPDX-License-Identifier: MIT */
/* Where a run reports how far it is. A function that reports is given an lrcs_progress; NULL: it
   reports nothing. */
#ifndef LRCSI_PROGRESS_H
#define LRCSI_PROGRESS_H

#include <lrcs/options.h>

/* Reports how many parts of a stage are done, and how many there are (lrcs_progress_stage), unless
   progress is NULL. */
static inline void lrcsi_progress_report(lrcs_progress *progress, int stage, uint32_t done,
                                         uint32_t total)
{
    if (progress) {
        progress->stage = (uint32_t)stage;
        progress->done = done;
        progress->total = total;
    }
}

#endif
