/* SPDX-License-Identifier: MIT */
/* The truth of a scene's cases: the exact method for the OBJ file as written, so that the judged
   scene is the one that others read. This file also decides what errors are allowed for single
   precision and for a raster; these are not bounds but the typical size of the errors of such
   codes. */
#include "host/kit/vectors.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "host/files/file.h"

#define SINGLE 0x1p-24 /* unit roundoff of single precision */
/* relative to this, the least normal number, 2^-126, is a few roundings */
#define SINGLE_LEAST 0x1p-96
#define EDGE_ON      (4.0 * SINGLE)
/* a visible fraction below this counts as an outline inside the facet */
#define PARTLY_SEEN 0.999

typedef struct truth_run {
    const lrcsi_vectors_job *job;
    lrcs_host_scene host;
    lrcs_facet_record *records; /* records of one case */
    lrcs_image image;
    FILE *out; /* NAME.facets.csv */
} truth_run;

/* ---- what is allowed ---- */

/* A few roundings in single precision: 16 in the sum, 4 in the cosine, whose error the BRDF
   amplifies; near grazing incidence and in narrow glints the effect is large. Values that underflow
   may be lost, and edge-on facets may contribute a little. */
static double facet_float(const lrcs_facet_record *record, const lrcs_brdf *brdf)
{
    lrcs_brdf glint = *brdf;
    lrcs_brdf diffuse = *brdf;
    double c = fabs(record->cos_theta);
    double unit = LRCS_FOUR_PI * c * record->visible_area_m2 * SINGLE;
    if (c < EDGE_ON) {
        return LRCS_FOUR_PI * lrcs_brdf_eval(brdf, EDGE_ON) * EDGE_ON * EDGE_ON * record->area_m2;
    }
    if (record->sigma_m2 <= 0.0) {
        return unit * SINGLE_LEAST;
    }
    glint.B = diffuse.A = 0.0;
    double steep = 7.0 + (brdf->A > 0.0 ? 2.0 / (c * c * brdf->s * brdf->s) : 0.0);
    return unit * (SINGLE_LEAST + lrcs_brdf_eval(&glint, c) * (16.0 + 4.0 * steep / c) +
                   lrcs_brdf_eval(&diffuse, c) * (16.0 + 4.0 * (1.0 + brdf->m) / c));
}

/* Half a pixel along the outline of each facet, with the errors of different facets independent:
   the usual error of a raster is a tenth of that; it is largest if an outline lies along rows or
   columns. */
static double facet_edge(const lrcs_scene *scene, const lrcs_facet_record *record, uint32_t facet,
                         const lrcs_pose *pose)
{
    double whole = record->area_m2 * fabs(record->cos_theta);
    if (!(record->visible_area_m2 > 0.0)) {
        return 0.0;
    }
    double pixels = record->visible_area_m2 < PARTLY_SEEN * whole ? 1.0 : 0.5;
    return pixels * lrcsi_kit_outline(scene, facet, pose) * record->sigma_m2 /
           record->visible_area_m2;
}

/* ---- a case ---- */

static int case_run(truth_run *run, lrcsi_vectors_case *one, lrcs_host_error *error)
{
    lrcs_run_options options = lrcs_run_options_default();
    options.method = LRCS_METHOD_EXACT;
    int status = lrcs_host_scene_run(&run->host, &one->pose, &options, &one->result, run->records,
                                     &run->image, NULL, error);
    if (status != LRCS_OK) {
        return status;
    }
    if (one->result.method != LRCS_METHOD_EXACT ||
        (one->result.flags & LRCS_FLAG_MEMORY_FALLBACK)) {
        return lrcsi_host_fail(error, LRCS_E_UNSUPPORTED, "%s, %s: no exact truth is known",
                               one->scene->name, one->attitude->name);
    }
    one->window[0] = run->image.left_m;
    one->window[1] = run->image.top_m;
    one->window[2] = run->image.side_m;
    const lrcs_scene *scene = &run->host.scene;
    double square = 0.0;
    for (uint32_t i = 0; i < scene->facet_count; i++) {
        const lrcs_facet_record *record = &run->records[i];
        double edge = facet_edge(scene, record, i, &one->pose);
        one->float_m2 += facet_float(record, &scene->material[scene->facet_material[i]].brdf);
        square += edge * edge;
        fprintf(run->out, "%s,%s,%lu", one->scene->name, one->attitude->name, (unsigned long)i);
        lrcs_host_number_put(run->out, ",", record->cos_theta);
        lrcs_host_number_put(run->out, ",", record->visible_area_m2);
        lrcs_host_number_put(run->out, ",", record->sigma_m2);
        putc('\n', run->out);
    }
    one->edge_m2 = sqrt(square) * one->window[2];
    return one->image ? lrcsi_vectors_images_write(run->job, one, scene, &run->image, error)
                      : LRCS_OK;
}

/* 1. The scene as others read it, and memory. 2. NAME.facets.csv with the facets of all cases,
   which are run for it. */
int lrcsi_vectors_truth_write(lrcsi_vectors_job *job, const lrcsi_vectors_scene *scene,
                              lrcs_host_error *error)
{
    truth_run run = {.job = job}; /* 1 */
    lrcs_host_output out;
    char path[LRCSI_KIT_PATH];
    uint32_t side = job->resolution > 0 ? job->resolution : 1;
    int status = lrcsi_kit_scene_read(job->folder, scene->name, job->binding, job->bindings,
                                      &run.host, error);
    if (status == LRCS_OK) {
        run.image.size = side;
        run.image.facet = malloc((size_t)side * side * sizeof *run.image.facet);
        run.records = malloc(((size_t)run.host.scene.facet_count + 1) * sizeof *run.records);
        status =
            run.image.facet && run.records
                ? lrcsi_kit_path(path, error, "%s/truth/%s.facets.csv", job->folder, scene->name)
                : lrcsi_host_out_of_memory(error);
    }
    status = status == LRCS_OK ? lrcs_host_output_open(path, &out, error) : status;
    if (status == LRCS_OK) { /* 2 */
        run.out = out.stream;
        fputs("scene,attitude,facet,cos_theta,visible_area_m2,sigma_m2\n", run.out);
        for (uint32_t i = 0; i < job->cases && status == LRCS_OK; i++) {
            status = job->list[i].scene == scene ? case_run(&run, &job->list[i], error) : LRCS_OK;
        }
        status = lrcsi_host_output_end(&out, status, error);
    }
    free(run.image.facet);
    free(run.records);
    lrcs_host_scene_free(&run.host);
    return status;
}
