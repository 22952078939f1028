/* SPDX-License-Identifier: MIT */
/* The study's scenes for the engine itself: the bodies by facets, against their closed forms, and
   one of parts that shade each other, which has none. */
#include "study.h"

#include <math.h>

#define ENGINE_TOLERANCE 1e-4
#define ENGINE_PANELS    4

static int engine_scene(lrcs_recipe_part *part, uint32_t parts, const lrcs_brdf *brdf,
                        lrcs_host_scene *scene, lrcs_host_error *error)
{
    lrcs_binding binding = {.kind = LRCS_BIND_DEFAULT, .brdf = *brdf, .two_sided = -1};
    lrcs_recipe recipe = {
        .part = part, .binding = &binding, .part_count = parts, .binding_count = 1};
    lrcs_build_options build = lrcs_build_options_default();
    build.tolerance = ENGINE_TOLERANCE;
    build.facets_only = LRCS_FACETS_TOTAL;
    int status = lrcs_host_scene_make(&recipe, &build, scene, error);
    return status == LRCS_OK ? lrcs_host_scene_prepare(scene, error) : status;
}

static int engine_run(const lrcs_host_scene *scene, const lrcs_pose *pose, int method,
                      study_number *sigma, lrcs_host_error *error)
{
    lrcs_run_options options = lrcs_run_options_default();
    lrcs_result result;
    options.tolerance = ENGINE_TOLERANCE;
    options.method = method;
    int status = lrcs_host_scene_run(scene, pose, &options, &result, NULL, NULL, NULL, error);
    if (status == LRCS_OK) {
        *sigma = (study_number){result.sigma_m2, result.bound_m2};
    }
    return status;
}

/* The aspect is an angle from the axis: s_hat = (sin, 0, cos), as elevation 90 - angle. */
void study_engine(study_job *job, const lrcs_shape *shape, const lrcs_brdf *brdf,
                  const double *aspect_deg, uint32_t count, study_number *sigma)
{
    lrcs_recipe_part part = {.name = lrcs_shape_text(shape->kind),
                             .shape = *shape,
                             .place = lrcs_place_default(),
                             .material_index = -1};
    lrcs_host_scene scene = {.prepared = NULL};
    lrcs_pose pose;
    if (job->status == LRCS_OK) {
        job->status = engine_scene(&part, 1, brdf, &scene, &job->error);
    }
    for (uint32_t i = 0; i < count && job->status == LRCS_OK; i++) {
        job->status = lrcs_pose_from_azel(0.0, 90.0 - aspect_deg[i], &pose);
        if (job->status == LRCS_OK) {
            job->status = engine_run(&scene, &pose, LRCS_METHOD_FACET, &sigma[i], &job->error);
        }
    }
    lrcs_host_scene_free(&scene);
}

/* ---- parts that shade each other ---- */

/* A cube of 1 m and two panels of 2 x 1 m, 0.02 m thick, centred 1.6 m beside it. */
static const lrcs_shape shaded_shape[] = {{.kind = LRCS_SHAPE_BOX, .size = {1.0, 1.0, 1.0}},
                                          {.kind = LRCS_SHAPE_BOX, .size = {2.0, 0.02, 1.0}},
                                          {.kind = LRCS_SHAPE_BOX, .size = {2.0, 0.02, 1.0}}};
static const double shaded_at[] = {0.0, 1.6, -1.6};

static double shaded_surface(void)
{
    double surface = 0.0;
    for (int i = 0; i < 3; i++) {
        const double *size = shaded_shape[i].size;
        surface += 2.0 * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]);
    }
    return surface;
}

static study_number shaded_look(study_job *job, const void *what, const double direction[3])
{
    lrcs_pose pose;
    study_number sigma = {(double)NAN, HUGE_VAL};
    if (job->status == LRCS_OK) {
        job->status = lrcs_pose_from_direction(direction, &pose);
    }
    if (job->status == LRCS_OK) {
        job->status = engine_run(what, &pose, LRCS_METHOD_EXACT, &sigma, &job->error);
    }
    return sigma;
}

study_number study_shaded(study_job *job, const lrcs_brdf *brdf, double *surface_m2)
{
    lrcs_recipe_part part[3];
    lrcs_host_scene scene = {.prepared = NULL};
    study_number mean = {(double)NAN, HUGE_VAL};
    for (int i = 0; i < 3; i++) {
        part[i] = (lrcs_recipe_part){.name = "box",
                                     .shape = shaded_shape[i],
                                     .place = lrcs_place_default(),
                                     .material_index = -1};
        part[i].place.translate[0] = shaded_at[i];
    }
    *surface_m2 = shaded_surface();
    if (job->status == LRCS_OK) {
        job->status = engine_scene(part, 3, brdf, &scene, &job->error);
    }
    if (job->status == LRCS_OK) {
        mean = study_octant(job, shaded_look, &scene, ENGINE_PANELS);
    }
    lrcs_host_scene_free(&scene);
    return mean;
}
