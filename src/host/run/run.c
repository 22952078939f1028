/* SPDX-License-Identifier: MIT */
/* A scene's preparation, and everything that is run on a prepared scene: sigma, its uncertainty and
   derivatives, forecasts, emulation, visible polygons, range profiles. It decides how much memory
   from the heap to try, and measures the time. The core computes the effect of a coarser raster on
   the bound. */
#include "host/run/run.h"

#include <math.h>
#include <stdlib.h>

#include "analysis/forecast.h"
#include "host/run/levels.h"
#include "integrate/sigma.h"
#include "scene/prepare.h"

_Static_assert((int)LRCS_HOST_PREPARE_STAGES == LRCSI_PREPARE_STAGES &&
                   (int)LRCS_HOST_POSE_STAGES == LRCSI_SIGMA_STAGES,
               "the core's stages under public names");

/* lrcs_prepare_run, its stages timed; the first holds the checks. */
static int run_prepare(lrcs_host_scene *scene, lrcs_work *work)
{
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
    lrcsi_host_area area = {NULL, 0};
    lrcsi_host_attempt attempt = lrcsi_host_attempt_make(&area, lrcs_prepare_need(&scene->scene));
    while (lrcsi_host_attempt_next(&attempt, error)) {
        attempt.status = run_prepare(scene, &attempt.work);
    }
    int status = lrcsi_host_attempt_keep(&attempt, &scene->blocks);
    scene->seconds_prepare = lrcsi_host_seconds() - start;
    return run_fail(error, status, "preparing the scene");
}

/* How often an answer that lack of memory has degraded is computed again, with more. */
#define DEGRADED_TRIES 6

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
    int tries = DEGRADED_TRIES;
    lrcsi_host_attempt attempt =
        lrcsi_host_attempt_make(area, sigma_bytes(scene, options, image, area));
    while (lrcsi_host_attempt_next(&attempt, error)) {
        int status =
            lrcs_sigma_run(scene->prepared, pose, options, &attempt.work, result, records, image);
        attempt.status = more_memory(status, result, &attempt.work, &tries);
    }
    return run_fail(error, attempt.status, "sigma");
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

int lrcsi_host_uncertainty(const lrcs_host_scene *scene, const lrcs_pose *pose,
                           const lrcs_run_options *options, const lrcs_uncertainty_options *how,
                           lrcsi_host_area *area, lrcs_result *result,
                           lrcs_sensitivity *sensitivity, lrcs_uncertainty *uncertainty,
                           lrcs_host_error *error)
{
    int tries = DEGRADED_TRIES;
    size_t own = lrcs_uncertainty_need(scene->prepared, options, how) -
                 lrcs_sigma_need(scene->prepared, options);
    lrcsi_host_attempt attempt =
        lrcsi_host_attempt_make(area, sigma_bytes(scene, options, NULL, area) + own);
    while (lrcsi_host_attempt_next(&attempt, error)) {
        int status = lrcs_uncertainty_run(scene->prepared, pose, options, how, &attempt.work,
                                          result, sensitivity, uncertainty);
        attempt.status = more_memory(status, result, &attempt.work, &tries);
    }
    return run_fail(error, attempt.status, "the uncertainty of sigma");
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

int lrcs_host_scene_attitude_slope(const lrcs_host_scene *scene, const lrcs_pose *pose,
                                   const lrcs_run_options *options, lrcs_attitude_slope *slope,
                                   lrcs_host_error *error)
{
    lrcsi_host_area area = {NULL, 0};
    lrcsi_host_attempt attempt =
        lrcsi_host_attempt_make(&area, sigma_bytes(scene, options, NULL, &area));
    while (lrcsi_host_attempt_next(&attempt, error)) {
        attempt.status =
            lrcs_attitude_slope_run(scene->prepared, pose, options, &attempt.work, slope);
    }
    lrcsi_host_area_free(&area);
    return run_fail(error, attempt.status, "the derivatives in attitude");
}

int lrcs_host_scene_run_until(const lrcs_host_scene *scene, const lrcs_pose *pose,
                              const lrcs_run_options *options, int stage, lrcs_host_error *error)
{
    if (stage < 0 || stage >= LRCS_HOST_POSE_STAGES) {
        return run_fail(error, LRCS_E_ARGUMENT, "sigma");
    }
    lrcsi_host_area area = {NULL, 0};
    lrcsi_host_attempt attempt =
        lrcsi_host_attempt_make(&area, sigma_bytes(scene, options, NULL, &area));
    while (lrcsi_host_attempt_next(&attempt, error)) {
        attempt.status =
            lrcsi_sigma_run_until(scene->prepared, pose, options, stage, &attempt.work);
    }
    lrcsi_host_area_free(&area);
    return run_fail(error, attempt.status, "sigma");
}

int lrcs_host_scene_forecast(const lrcs_host_scene *scene, const lrcs_pose *pose,
                             const lrcs_run_options *options, uint32_t count, double *seconds,
                             lrcs_host_error *error)
{
    lrcsi_host_area area = {NULL, 0};
    lrcsi_host_attempt attempt =
        lrcsi_host_attempt_make(&area, lrcsi_forecast_need(scene->prepared));
    while (lrcsi_host_attempt_next(&attempt, error)) {
        attempt.status =
            lrcsi_forecast_run(scene->prepared, pose, options, count, &attempt.work, seconds);
    }
    lrcsi_host_area_free(&area);
    return run_fail(error, attempt.status, "forecast");
}

int lrcs_host_scene_emulate(const lrcs_host_scene *scene, const lrcs_pose *pose,
                            const lrcs_emulation_options *options, lrcs_emulation *emulation,
                            lrcs_facet_record *records, double *seconds, lrcs_host_error *error)
{
    lrcsi_host_area area = {NULL, 0};
    double start = lrcsi_host_seconds();
    lrcsi_host_attempt attempt =
        lrcsi_host_attempt_make(&area, lrcs_emulate_need(scene->prepared, options));
    while (lrcsi_host_attempt_next(&attempt, error)) {
        attempt.status = lrcs_emulate_run(scene->prepared, pose, options, &attempt.work, emulation,
                                          records, NULL);
    }
    if (seconds) {
        *seconds = lrcsi_host_seconds() - start;
    }
    lrcsi_host_area_free(&area);
    if (attempt.status == LRCS_E_NUMBER) {
        return lrcsi_host_fail(error, attempt.status,
                               "emulating: sigma, or the contribution of a pixel, is beyond the "
                               "range of %s",
                               lrcs_precision_text(options->precision));
    }
    return run_fail(error, attempt.status, "emulating");
}

/* ---- results in memory of their own ---- */

int lrcs_host_polygons_make(const lrcs_host_scene *scene, const lrcs_pose *pose,
                            lrcs_host_polygons *polygons, lrcs_host_error *error)
{
    lrcs_host_polygons p = {{0}, NULL};
    lrcsi_host_area area = {NULL, 0};
    lrcsi_host_attempt attempt = lrcsi_host_attempt_make(&area, lrcs_polygon_need(scene->prepared));
    while (lrcsi_host_attempt_next(&attempt, error)) {
        attempt.status = lrcs_polygon_run(scene->prepared, pose, &attempt.work, &p.list);
    }
    int status = lrcsi_host_attempt_keep(&attempt, &p.blocks);
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
    lrcsi_host_area area = {NULL, 0};
    lrcsi_host_attempt attempt =
        lrcsi_host_attempt_make(&area, lrcs_profile_need(scene->prepared, bin_m));
    while (lrcsi_host_attempt_next(&attempt, error)) {
        attempt.status = lrcs_profile_run(scene->prepared, pose, bin_m, &attempt.work, &p.list);
    }
    int status = lrcsi_host_attempt_keep(&attempt, &p.blocks);
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
