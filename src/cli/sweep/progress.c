/* SPDX-License-Identifier: MIT */
/* The progress bar of a sweep and its remaining time, for people at a terminal. */
#include "cli/sweep/sweep.h"

#include <math.h>
#include <unistd.h>

#define PROGRESS_PERIOD 0.2 /* s */
#define PROGRESS_BAR    30

sweep_progress cli_progress_make(uint64_t first, uint64_t total)
{
    double now = cli_seconds();
    cli_watch_stage(NULL, NULL); /* the progress bar replaces it */
    int on = isatty(STDERR_FILENO) && first < total;
    if (on) { /* the first pose may take long */
        fprintf(stderr, "\r[%*s] %3.0f %%  %llu of %llu ", PROGRESS_BAR, "",
                100.0 * (double)first / (double)total, (unsigned long long)first,
                (unsigned long long)total);
        fflush(stderr);
    }
    return (sweep_progress){on, first, total, now, now};
}

void cli_progress_show(sweep_progress *progress, uint64_t done)
{
    double now = progress->on ? cli_seconds() : 0.0;
    if (!progress->on || now - progress->shown < PROGRESS_PERIOD || done <= progress->first) {
        return;
    }
    progress->shown = now;
    double share = (double)done / (double)progress->total;
    double left = (now - progress->begun) * (double)(progress->total - done) /
                  (double)(done - progress->first);
    int filled = (int)(share * PROGRESS_BAR);
    fprintf(stderr, "\r[%.*s%*s] %3.0f %%  %llu of %llu, %.0f:%02d:%02d left ", filled,
            "##############################", PROGRESS_BAR - filled, "", 100.0 * share,
            (unsigned long long)done, (unsigned long long)progress->total, floor(left / 3600.0),
            (int)(fmod(left, 3600.0) / 60.0), (int)fmod(left, 60.0));
    fflush(stderr);
}

void cli_progress_clear(const sweep_progress *progress)
{
    if (progress->on) {
        fprintf(stderr, "\r%79s\r", "");
    }
}
