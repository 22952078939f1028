/* SPDX-License-Identifier: MIT */
/* The answers that a code with a given mistake would produce for a case: the sum of Eq. 2 over the
   truth's facets, with the mistake applied. */
#include "cli/compare/compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The largest f_r cos of the case. */
static double view_peak(const mistake_view *view)
{
    double peak = 0.0;
    for (uint32_t i = 0; i < view->scene->host.scene.facet_count; i++) {
        mistake_point spot;
        if (cli_mistake_seen(view, i, 0, &spot) > 0.0) {
            peak = fmax(peak, cli_mistake_right(&spot, 0.0));
        }
    }
    return peak;
}

/* The records of a run of its own, for mistakes that change the run. 0 or CLI_FAILED. */
static int records_own(const compare_kit *kit, const compare_case *one,
                       const compare_mistake *mistake, lrcs_facet_record *own)
{
    lrcs_host_error error;
    lrcs_run_options options = lrcs_run_options_default();
    lrcs_result result;
    lrcs_pose pose = one->pose;
    options.method = LRCS_METHOD_EXACT;
    options.without = mistake->without;
    if (mistake->skins) {
        return cli_compare_skins(kit, one, &options, own);
    }
    if (mistake->turn && mistake->turn(one, mistake, &pose) != LRCS_OK) {
        pose = one->pose;
    }
    return lrcs_host_scene_run(&kit->scene[one->scene].host, &pose, &options, &result, own, NULL,
                               NULL, &error) == LRCS_OK
               ? 0
               : cli_failed(&error);
}

/* The records of a case with a mistake: the truth's, or those of another run. 0 or CLI_FAILED. */
static int view_make(const compare_kit *kit, compare_case *one, const compare_mistake *mistake,
                     mistake_view *view, lrcs_facet_record **own)
{
    int code = cli_compare_records(kit, one);
    view->scene = &kit->scene[one->scene];
    view->records = one->records;
    if (code == 0 && one->peak == 0.0) {
        one->peak = view_peak(view);
    }
    if (code != 0 || (!mistake->turn && !mistake->without && !mistake->skins)) {
        return code;
    }
    *own = calloc((size_t)view->scene->host.scene.facet_count + 1, sizeof **own);
    if (!*own) {
        return cli_out_of_memory();
    }
    view->records = *own;
    return records_own(kit, one, mistake, *own);
}

/* sigma / 4 pi with the mistake. */
static double view_sum(const mistake_view *view, const compare_mistake *mistake, double peak)
{
    mistake_area *area = mistake->area ? mistake->area : cli_mistake_seen;
    mistake_shade *shade = mistake->shade ? mistake->shade : cli_mistake_right;
    int corners = mistake->corners > 0 ? mistake->corners : 1;
    double sum = 0.0;
    for (uint32_t i = 0; i < view->scene->host.scene.facet_count; i++) {
        for (int corner = 0; corner < corners; corner++) {
            mistake_point spot = {.peak = peak};
            double part = area(view, i, corner, &spot);
            sum += part > 0.0 ? part * shade(&spot, mistake->at) / corners : 0.0;
        }
    }
    return sum;
}

int cli_compare_answer(const compare_kit *kit, compare_case *one, const compare_mistake *mistake,
                       double *sigma_m2)
{
    mistake_view view;
    lrcs_facet_record *own = NULL;
    int code = view_make(kit, one, mistake, &view, &own);
    if (code == 0) {
        memcpy(view.direction, one->direction, sizeof view.direction);
        *sigma_m2 = 4.0 * CLI_PI * view_sum(&view, mistake, one->peak);
    }
    free(own);
    return code;
}
