/* SPDX-License-Identifier: MIT */
/* A range profile in memory from the heap. */
#include "host/memory.h"

typedef struct ranges_step {
    const lrcs_prepared *prepared;
    const lrcs_pose *pose;
    double bin_m;
    lrcs_profile *list;
} ranges_step;

static int run_ranges(void *context, lrcs_work *work)
{
    ranges_step *step = context;
    return lrcs_profile_run(step->prepared, step->pose, step->bin_m, work, step->list);
}

int lrcs_host_profile_make(const lrcs_host_scene *scene, const lrcs_pose *pose, double bin_m,
                           lrcs_host_profile *profile, lrcs_host_error *error)
{
    lrcs_host_profile p = {{0}, NULL};
    ranges_step step = {scene->prepared, pose, bin_m, &p.list};
    size_t need = lrcs_profile_need(scene->prepared, bin_m);
    int status = lrcsi_host_step_run(&p.blocks, need, run_ranges, &step, error);
    if (status == LRCS_OK) {
        *profile = p;
    } else if (status == LRCS_E_LIMIT) {
        lrcsi_host_fail(error, status,
                        "range profile: bins of %g m are more than the %lu that a profile may "
                        "have, or too fine for the scene's distance from the origin",
                        bin_m, (unsigned long)LRCS_PROFILE_BINS);
    } else if (status != LRCS_E_SYSTEM) {
        lrcsi_host_fail(error, status, "range profile: %s", lrcs_status_text(status));
    }
    return status;
}

void lrcs_host_profile_free(lrcs_host_profile *profile)
{
    lrcsi_host_free(profile->blocks);
    *profile = (lrcs_host_profile){{0}, NULL};
}
