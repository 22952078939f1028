/* SPDX-License-Identifier: MIT */
/* The run of a report, which is that of lrcs run, and the pictures of what the laser sees. */
#include "cli/report/report.h"

#include <stdlib.h>

/* Draws what the laser sees on a dark and on a white background, which share one image: of the size
   that the legend leaves. */
static int pictures_make(report_job *job, int kind)
{
    static const int look[REPORT_PICTURES] = {LRCS_HOST_BY_SIGMA, LRCS_HOST_BY_MATERIAL};
    lrcs_host_error error;
    lrcs_result result;
    lrcs_host_picture picture = {.scene = &job->run.scene.scene,
                                 .pose = &job->run.pose,
                                 .records = job->run.records,
                                 .title = cli_scene_name(job->args, &job->run.scene),
                                 .colouring = look[kind],
                                 .annotated = 1};
    uint32_t side = lrcs_host_picture_need(&picture, CLI_PICTURE_DEFAULT);
    free(job->run.image.facet);
    job->run.image.size = side;
    job->run.image.facet = calloc((size_t)side * side, sizeof(uint32_t));
    if (!job->run.image.facet) {
        return cli_out_of_memory();
    }
    lrcs_run_options coarse = job->run.options;
    coarse.method = LRCS_METHOD_FACET; /* only its image is used */
    int code = cli_scene_run(&job->run.scene, &job->run.pose, &coarse, &result, NULL,
                             &job->run.image, NULL);
    for (int white = 0; white < 2 && code == 0; white++) {
        FILE *out = cli_report_bytes_begin(&job->picture[kind][white]);
        if (!out) {
            return CLI_FAILED;
        }
        picture.white = white;
        int status =
            lrcs_host_picture_png(out, &picture, &job->run.image, CLI_PICTURE_DEFAULT, &error);
        code = cli_report_bytes_end(out);
        code = status == LRCS_OK ? code : cli_failed(&error);
    }
    return code;
}

int cli_report_run(report_job *job)
{
    int code = cli_run_scene(&job->run);
    job->run.options.progress = NULL; /* sweeps run in threads */
    cli_watch_stage("pictures", NULL);
    for (int kind = 0; kind < REPORT_PICTURES && code == 0; kind++) {
        code = pictures_make(job, kind);
    }
    return code;
}
