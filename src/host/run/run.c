/* SPDX-License-Identifier: MIT */
/* A scene's preparation, and everything that is run on a prepared scene: sigma, its uncertainty and
   derivatives, forecasts, emulation, visible polygons, range profiles. It decides how much memory
   from the heap to try, and measures the time. The core computes the effect of a coarser raster on
   the bound. */
#include "host/run/run.h"

#include <math.h>
#include <stdlib.h>

#include "analysis/forecast.h"
#include "host/run/refine.h"
#include "integrate/sigma.h"
#include "scene/prepare.h"

_Static_assert((int)LRCS_HOST_PREPARE_STAGES == LRCSI_PREPARE_STAGES &&
                   (int)LRCS_HOST_POSE_STAGES == LRCSI_SIGMA_STAGES,
               "the core's stages under public names");

/* lrcs_prepare_run, its stages timed; the first holds the checks. */
static int run_prepare(void *context, lrcs_work *work)
{
    lrcs_host_scene *scene = context;
    lrcs_prepared *p = NULL;
    double start = lrcsi_host_seconds();
    int status = lrcsi_prepare_start(&scene->scene, work, &p);
    for (int stage = 0; stage < LRCSI_PREPARE_STAGES && status == LRCS_OK; stage++) {
        status = lrcsi_prepare_stage(p, stage, work);
        double end = lrcsi_host_seconds();
        scene->seconds_stage[stage] = end - start;
        start = end;
    }
    scene->prepared = status == LRCS_OK ? p : scene->prepared;
    return status;
}

static int run_fail(lrcs_host_error *error, int status, const char *what)
{
    return status == LRCS_OK || status == LRCS_E_SYSTEM
               ? status
               : lrcsi_host_fail(error, status, "%s: %s", what, lrcs_status_text(status));
}

int lrcs_host_scene_prepare(lrcs_host_scene *scene, lrcs_host_error *error)
{
    double start = lrcsi_host_seconds();
    size_t need = lrcs_prepare_need(&scene->scene);
    int status = lrcsi_host_step_run(&scene->blocks, need, run_prepare, scene, error);
    scene->seconds_prepare = lrcsi_host_seconds() - start;
    return run_fail(error, status, "preparing the scene");
}

typedef struct sigma_step {
    const lrcs_prepared *prepared;
    const lrcs_pose *pose;
    const lrcs_run_options *options;
    lrcs_result *result;
    lrcs_facet_record *records;
    lrcs_image *image;
    int tries; /* left, with more memory, if the answer is degraded for lack of memory */
} sigma_step;

/* LRCS_E_MEMORY, which asks for a larger work area, if the answer was degraded because of lack of
   memory, tries are left, and the heap has what the next one needs; else the status. */
static int more_memory(int status, const lrcs_result *result, const lrcs_work *work, int *tries)
{
    int degraded =
        status == LRCS_OK && (result->flags & LRCS_FLAG_MEMORY_FALLBACK) && work->peak > work->size;
    if (!degraded || (*tries)-- <= 0) {
        return status;
    }
    size_t twice = work->size <= SIZE_MAX / 4 ? 2 * work->size : SIZE_MAX / 2;
    void *probe = malloc((work->peak > twice ? work->peak : twice) + 64);
    free(probe);
    return probe ? LRCS_E_MEMORY : status;
}

static int run_sigma(void *context, lrcs_work *work)
{
    sigma_step *step = context;
    int status = lrcs_sigma_run(step->prepared, step->pose, step->options, work, step->result,
                                step->records, step->image);
    return more_memory(status, step->result, work, &step->tries);
}

/* The size of the first work area. If the heap has less than needed, the raster is coarser, and a
   flag is set. */
static size_t sigma_bytes(const lrcs_host_scene *scene, const lrcs_run_options *options,
                          const lrcs_image *image, const lrcsi_host_area *area)
{
    size_t need = lrcs_sigma_need(scene->prepared, options);
    if (image) { /* its raster comes after the run's own */
        lrcs_run_options draw = {.tolerance = options->tolerance,
                                 .method = LRCS_METHOD_ZBUFFER,
                                 .resolution = image->size};
        size_t more = lrcs_sigma_need(scene->prepared, &draw);
        need = more > need ? more : need;
    }
    if (need <= area->size) {
        return need;
    }
    void *probe = malloc(need);
    while (!probe && need > ((size_t)1 << 20)) {
        need /= 2;
        probe = malloc(need);
    }
    free(probe);
    return need;
}

int lrcsi_host_sigma(const lrcs_host_scene *scene, const lrcs_pose *pose,
                     const lrcs_run_options *options, lrcsi_host_area *area, lrcs_result *result,
                     lrcs_facet_record *records, lrcs_image *image, lrcs_host_error *error)
{
    sigma_step step = {scene->prepared, pose, options, result, records, image, 6};
    size_t need = sigma_bytes(scene, options, image, area);
    int status = lrcsi_host_area_run(area, need, run_sigma, &step, error);
    return run_fail(error, status, "sigma");
}

int lrcs_host_scene_run(const lrcs_host_scene *scene, const lrcs_pose *pose,
                        const lrcs_run_options *options, lrcs_result *result,
                        lrcs_facet_record *records, lrcs_image *image, double *seconds,
                        lrcs_host_error *error)
{
    lrcsi_host_area area = {NULL, 0};
    double start = lrcsi_host_seconds();
    int status = lrcsi_host_sigma(scene, pose, options, &area, result, records, image, error);
    if (seconds) {
        *seconds = lrcsi_host_seconds() - start;
    }
    lrcsi_host_area_free(&area);
    return status;
}

typedef struct uncertainty_step {
    const lrcs_prepared *prepared;
    const lrcs_pose *pose;
    const lrcs_run_options *options;
    const lrcs_uncertainty_options *how;
    lrcs_result *result;
    lrcs_sensitivity *sensitivity;
    lrcs_uncertainty *uncertainty;
    int tries; /* as sigma_step */
} uncertainty_step;

static int run_uncertainty(void *context, lrcs_work *work)
{
    uncertainty_step *step = context;
    int status = lrcs_uncertainty_run(step->prepared, step->pose, step->options, step->how, work,
                                      step->result, step->sensitivity, step->uncertainty);
    return more_memory(status, step->result, work, &step->tries);
}

int lrcsi_host_uncertainty(const lrcs_host_scene *scene, const lrcs_pose *pose,
                           const lrcs_run_options *options, const lrcs_uncertainty_options *how,
                           lrcsi_host_area *area, lrcs_result *result,
                           lrcs_sensitivity *sensitivity, lrcs_uncertainty *uncertainty,
                           lrcs_host_error *error)
{
    uncertainty_step step = {scene->prepared, pose,        options,     how,
                             result,          sensitivity, uncertainty, 6};
    size_t own = lrcs_uncertainty_need(scene->prepared, options, how) -
                 lrcs_sigma_need(scene->prepared, options);
    size_t need = sigma_bytes(scene, options, NULL, area) + own;
    int status = lrcsi_host_area_run(area, need, run_uncertainty, &step, error);
    return run_fail(error, status, "the uncertainty of sigma");
}

int lrcs_host_scene_uncertainty(const lrcs_host_scene *scene, const lrcs_pose *pose,
                                const lrcs_run_options *options,
                                const lrcs_uncertainty_options *how, lrcs_result *result,
                                lrcs_sensitivity *sensitivity, lrcs_uncertainty *uncertainty,
                                lrcs_host_error *error)
{
    lrcsi_host_area area = {NULL, 0};
    int status = lrcsi_host_uncertainty(scene, pose, options, how, &area, result, sensitivity,
                                        uncertainty, error);
    lrcsi_host_area_free(&area);
    return status;
}

typedef struct slope_step {
    const lrcs_prepared *prepared;
    const lrcs_pose *pose;
    const lrcs_run_options *options;
    lrcs_attitude_slope *slope;
} slope_step;

static int run_slope(void *context, lrcs_work *work)
{
    slope_step *step = context;
    return lrcs_attitude_slope_run(step->prepared, step->pose, step->options, work, step->slope);
}

int lrcs_host_scene_attitude_slope(const lrcs_host_scene *scene, const lrcs_pose *pose,
                                   const lrcs_run_options *options, lrcs_attitude_slope *slope,
                                   lrcs_host_error *error)
{
    slope_step step = {scene->prepared, pose, options, slope};
    lrcsi_host_area area = {NULL, 0};
    size_t need = sigma_bytes(scene, options, NULL, &area);
    int status = lrcsi_host_area_run(&area, need, run_slope, &step, error);
    lrcsi_host_area_free(&area);
    return run_fail(error, status, "the derivatives in attitude");
}

typedef struct until_step {
    const lrcs_prepared *prepared;
    const lrcs_pose *pose;
    const lrcs_run_options *options;
    int stage;
} until_step;

static int run_until(void *context, lrcs_work *work)
{
    until_step *step = context;
    return lrcsi_sigma_until(step->prepared, step->pose, step->options, step->stage, work);
}

int lrcs_host_scene_run_until(const lrcs_host_scene *scene, const lrcs_pose *pose,
                              const lrcs_run_options *options, int stage, lrcs_host_error *error)
{
    until_step step = {scene->prepared, pose, options, stage};
    lrcsi_host_area area = {NULL, 0};
    int status = stage >= 0 && stage < LRCS_HOST_POSE_STAGES ? LRCS_OK : LRCS_E_ARGUMENT;
    if (status == LRCS_OK) {
        size_t need = sigma_bytes(scene, options, NULL, &area);
        status = lrcsi_host_area_run(&area, need, run_until, &step, error);
    }
    lrcsi_host_area_free(&area);
    return run_fail(error, status, "sigma");
}

typedef struct forecast_step {
    const lrcs_prepared *prepared;
    const lrcs_pose *pose;
    const lrcs_run_options *options;
    uint32_t count;
    double *seconds;
} forecast_step;

static int run_forecast(void *context, lrcs_work *work)
{
    forecast_step *step = context;
    return lrcsi_forecast_run(step->prepared, step->pose, step->options, step->count, work,
                              step->seconds);
}

int lrcs_host_scene_forecast(const lrcs_host_scene *scene, const lrcs_pose *pose,
                             const lrcs_run_options *options, uint32_t count, double *seconds,
                             lrcs_host_error *error)
{
    forecast_step step = {scene->prepared, pose, options, count, seconds};
    lrcsi_host_area area = {NULL, 0};
    int status = lrcsi_host_area_run(&area, lrcsi_forecast_need(scene->prepared), run_forecast,
                                     &step, error);
    lrcsi_host_area_free(&area);
    return run_fail(error, status, "forecast");
}

typedef struct emulate_step {
    const lrcs_prepared *prepared;
    const lrcs_pose *pose;
    const lrcs_emulation_options *options;
    lrcs_emulation *emulation;
    lrcs_facet_record *records;
} emulate_step;

static int run_emulate(void *context, lrcs_work *work)
{
    emulate_step *step = context;
    return lrcs_emulate_run(step->prepared, step->pose, step->options, work, step->emulation,
                            step->records, NULL);
}

int lrcs_host_scene_emulate(const lrcs_host_scene *scene, const lrcs_pose *pose,
                            const lrcs_emulation_options *options, lrcs_emulation *emulation,
                            lrcs_facet_record *records, double *seconds, lrcs_host_error *error)
{
    emulate_step step = {scene->prepared, pose, options, emulation, records};
    lrcsi_host_area area = {NULL, 0};
    double start = lrcsi_host_seconds();
    int status = lrcsi_host_area_run(&area, lrcs_emulate_need(scene->prepared, options),
                                     run_emulate, &step, error);
    if (seconds) {
        *seconds = lrcsi_host_seconds() - start;
    }
    lrcsi_host_area_free(&area);
    if (status == LRCS_E_NUMBER) {
        return lrcsi_host_fail(error, status,
                               "emulating: sigma, or the contribution of a pixel, is beyond the "
                               "range of %s",
                               lrcs_precision_text(options->precision));
    }
    return run_fail(error, status, "emulating");
}

/* ---- results in memory of their own ---- */

typedef struct polygon_step {
    const lrcs_prepared *prepared;
    const lrcs_pose *pose;
    lrcs_polygons *list;
} polygon_step;

static int run_polygons(void *context, lrcs_work *work)
{
    polygon_step *step = context;
    return lrcs_polygon_run(step->prepared, step->pose, work, step->list);
}

int lrcs_host_polygons_make(const lrcs_host_scene *scene, const lrcs_pose *pose,
                            lrcs_host_polygons *polygons, lrcs_host_error *error)
{
    lrcs_host_polygons p = {{0}, NULL};
    polygon_step step = {scene->prepared, pose, &p.list};
    size_t need = lrcs_polygon_need(scene->prepared);
    int status = lrcsi_host_step_run(&p.blocks, need, run_polygons, &step, error);
    if (status == LRCS_OK) {
        *polygons = p;
    }
    return run_fail(error, status, "visible polygons");
}

void lrcs_host_polygons_free(lrcs_host_polygons *polygons)
{
    lrcsi_host_free(polygons->blocks);
    *polygons = (lrcs_host_polygons){{0}, NULL};
}

typedef struct profile_step {
    const lrcs_prepared *prepared;
    const lrcs_pose *pose;
    double bin_m;
    lrcs_profile *list;
} profile_step;

static int run_profile(void *context, lrcs_work *work)
{
    profile_step *step = context;
    return lrcs_profile_run(step->prepared, step->pose, step->bin_m, work, step->list);
}

/* The largest coordinate of a vertex in absolute value, m. A range is less than 4 times that. */
static double largest_coordinate(const lrcs_scene *scene)
{
    double most = 0.0;
    for (uint32_t i = 0; i < scene->vertex_count; i++) {
        for (int k = 0; k < 3; k++) {
            most = fmax(most, fabs(scene->vertex[i].x[k]));
        }
    }
    return most;
}

int lrcs_host_profile_make(const lrcs_host_scene *scene, const lrcs_pose *pose, double bin_m,
                           lrcs_host_profile *profile, lrcs_host_error *error)
{
    lrcs_host_profile p = {{0}, NULL};
    profile_step step = {scene->prepared, pose, bin_m, &p.list};
    size_t need = lrcs_profile_need(scene->prepared, bin_m);
    int status = lrcsi_host_step_run(&p.blocks, need, run_profile, &step, error);
    if (status == LRCS_OK) {
        *profile = p;
    }
    if (status == LRCS_E_LIMIT) {
        if (largest_coordinate(&scene->scene) / bin_m < LRCS_PROFILE_INDEX / 4.0) {
            return lrcsi_host_fail(error, status,
                                   "range profile: bins of %g m: there would be more than %lu",
                                   bin_m, (unsigned long)LRCS_PROFILE_BINS);
        }
        return lrcsi_host_fail(error, status,
                               "range profile: bins of %g m: too fine for the scene's size or "
                               "distance from the origin",
                               bin_m);
    }
    return run_fail(error, status, "range profile");
}

void lrcs_host_profile_free(lrcs_host_profile *profile)
{
    lrcsi_host_free(profile->blocks);
    *profile = (lrcs_host_profile){{0}, NULL};
}
