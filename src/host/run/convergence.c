/* SPDX-License-Identifier: MIT */
/* Runs one scene from one pose with the settings of every kind, and finds the truth. This file
   decides which settings there are, how often each is run, and with which truth they are
   compared. */
#include <lrcs/convergence.h>

#include <math.h>
#include <string.h>
#include <time.h>

#include "host/fail.h"
#include "host/run/median.h"

#define RASTER_LEAST 16u
#define RASTER_MOST  4096u
#define BUSY_SHARE   0.8
#define FACETS_MOST  250000u /* meshes of shapes with more facets are not kept */
#define PREVIEWS     3       /* tolerances 1e-1 .. 1e-3 met by an estimate */

const lrcs_host_convergence_mesh *lrcs_host_convergence_finest(const lrcs_host_convergence *job)
{
    return &job->mesh[job->meshes - 1];
}

double lrcs_host_convergence_relative(const lrcs_host_convergence *job, double value_m2)
{
    double truth = job->truth.sigma_m2;
    return truth > 0.0 ? value_m2 / truth : value_m2;
}

static void stage_show(const lrcs_host_convergence *job, const char *name, uint32_t done,
                       uint32_t count)
{
    if (job->stage) {
        job->stage(name, done, count);
    }
}

/* ---- meshes ---- */

/* Reads the scene with its shapes built for a tolerance; keeps and prepares it if the mesh differs
   from the last one and is not too large. */
static int mesh_read(lrcs_host_convergence *job, int digits, lrcs_host_error *error)
{
    lrcs_host_convergence_mesh *mesh = &job->mesh[job->meshes];
    mesh->digits = digits;
    job->load.build.tolerance = pow(10.0, -digits);
    job->load.build.facets_only = LRCS_FACETS_TOTAL; /* the cost of facets is measured */
    int status = lrcs_host_scene_read(job->path, &job->load, &mesh->scene, error);
    if (status != LRCS_OK) {
        lrcs_host_scene_free(&mesh->scene);
        return status;
    }
    const lrcs_scene *scene = &mesh->scene.scene;
    if (job->meshes > 0 && scene->facet_count > FACETS_MOST) {
        snprintf(job->left_out, sizeof job->left_out, "left out: mesh 1e-%d, of %lu facets", digits,
                 (unsigned long)scene->facet_count);
        lrcs_host_scene_free(&mesh->scene);
        return LRCS_OK;
    }
    if (job->meshes > 0 && lrcs_scene_hash(scene) ==
                               lrcs_scene_hash(&lrcs_host_convergence_finest(job)->scene.scene)) {
        lrcs_host_scene_free(&mesh->scene);
        return LRCS_OK;
    }
    job->meshes++;
    return lrcs_host_scene_prepare(&mesh->scene, error);
}

int lrcs_host_convergence_read(lrcs_host_convergence *job, lrcs_host_error *error)
{
    int status = mesh_read(job, 1, error);
    int most = job->digits > 0 ? job->digits : LRCS_HOST_CONVERGENCE_MESHES;
    int finest =
        status == LRCS_OK && lrcs_host_scene_tessellated(&job->mesh[0].scene.scene) ? most : 1;
    for (int digits = 2; digits <= finest && status == LRCS_OK && !job->left_out[0]; digits++) {
        stage_show(job, "meshes", (uint32_t)digits, (uint32_t)finest);
        status = mesh_read(job, digits, error);
    }
    job->mesh[0].digits = job->meshes > 1 ? 1 : 0;
    return status;
}

void lrcs_host_convergence_free(lrcs_host_convergence *job)
{
    for (uint32_t i = 0; i < job->meshes; i++) {
        lrcs_host_scene_free(&job->mesh[i].scene);
    }
}

/* ---- settings ---- */

static int setting_run(lrcs_host_convergence *job, lrcs_host_convergence_setting *setting,
                       lrcs_host_error *error)
{
    lrcs_result result = {0};
    lrcs_run_options options = lrcs_run_options_default();
    double *seconds = &setting->seconds[setting->runs];
    options.method =
        setting->kind == LRCS_HOST_CONVERGENCE_KIND_CLOSED ? LRCS_METHOD_AUTO : setting->method;
    options.resolution = setting->resolution;
    if (setting->digits > 0) {
        options.method = LRCS_METHOD_AUTO;
        options.resolution = 0;
        options.tolerance = pow(10.0, -setting->digits);
        options.accept = LRCS_ACCEPT_ESTIMATE;
    }
    stage_show(job, setting->name, 0, 0);
    options.progress = job->progress;
    clock_t begun = clock();
    int status = lrcs_host_scene_run(&job->mesh[setting->mesh].scene, &job->pose, &options, &result,
                                     NULL, NULL, seconds, error);
    job->processor += (double)(clock() - begun) / CLOCKS_PER_SEC;
    if (status != LRCS_OK) {
        return status;
    }
    setting->runs++;
    setting->sigma_m2 = result.sigma_m2;
    setting->bound_m2 = result.bound_m2;
    setting->estimate_m2 = result.estimate_m2;
    setting->true_shapes = result.budget.tessellation_m2 >= 0.0;
    setting->flags = result.flags;
    if (setting->digits > 0) {
        setting->method = result.method;
        setting->resolution = result.resolution;
    }
    setting->spent_s += *seconds;
    job->spent += *seconds;
    return LRCS_OK;
}

/* Adds a setting and runs it for the first time. */
static int setting_add(lrcs_host_convergence *job, int kind, int method, uint32_t resolution,
                       uint32_t mesh, lrcs_host_error *error)
{
    lrcs_host_convergence_setting *setting = &job->setting[job->settings++];
    snprintf(setting->name, sizeof setting->name, "%s", lrcs_method_text(method));
    setting->kind = kind;
    setting->method = method;
    setting->resolution = resolution;
    setting->mesh = mesh;
    if (kind == LRCS_HOST_CONVERGENCE_KIND_ZBUFFER) {
        lrcs_host_append(setting->name, sizeof setting->name, " %lu", (unsigned long)resolution);
    } else if (kind == LRCS_HOST_CONVERGENCE_KIND_MESH) {
        lrcs_host_append(setting->name, sizeof setting->name, " on mesh 1e-%d",
                         job->mesh[mesh].digits);
    }
    return setting_run(job, setting, error);
}

/* Adds what lrcs run --accept estimate does, on the mesh that it makes; nothing if nothing is
   hidden, because that is proved. */
static int previews_add(lrcs_host_convergence *job, lrcs_host_error *error)
{
    uint32_t mesh = 0;
    int status = LRCS_OK;
    for (int digits = 1; digits <= PREVIEWS && status == LRCS_OK; digits++) {
        lrcs_host_convergence_setting *setting = &job->setting[job->settings++];
        snprintf(setting->name, sizeof setting->name, LRCS_HOST_PREVIEW_NAME_TEXT " 1e-%d", digits);
        setting->kind = LRCS_HOST_CONVERGENCE_KIND_PREVIEW;
        while (mesh + 1 < job->meshes && job->mesh[mesh].digits < digits) {
            mesh++;
        }
        setting->digits = digits;
        setting->mesh = mesh;
        status = setting_run(job, setting, error);
        if (setting->method == LRCS_METHOD_FACET || setting->method == LRCS_METHOD_CLOSED) {
            job->setting[--job->settings] = (lrcs_host_convergence_setting){.kind = 0};
            break;
        }
    }
    return status;
}

/* Adds finer and finer rasters until half of the time is used. */
static int rasters_add(lrcs_host_convergence *job, uint32_t mesh, lrcs_host_error *error)
{
    int status = LRCS_OK;
    double last = 0.0;
    for (uint32_t n = RASTER_LEAST; n <= RASTER_MOST && status == LRCS_OK; n *= 2) {
        if (job->spent + last > 0.5 * job->seconds) { /* this one would not be faster */
            lrcs_host_append(job->left_out, sizeof job->left_out,
                             "%szbuffer %lu and finer, for time",
                             job->left_out[0] ? "; " : "left out: ", (unsigned long)n);
            break;
        }
        status = setting_add(job, LRCS_HOST_CONVERGENCE_KIND_ZBUFFER, LRCS_METHOD_ZBUFFER, n, mesh,
                             error);
        last = job->setting[job->settings - 1].spent_s;
    }
    return status;
}

/* Adds every mesh with the method that suffices for it; the other methods on the finest mesh. */
static int settings_add(lrcs_host_convergence *job, lrcs_host_error *error)
{
    uint32_t finest = job->meshes - 1;
    int method = LRCS_METHOD_EXACT;
    int closed = 0;
    int status = LRCS_OK;
    for (uint32_t i = 0; i <= finest && job->mesh[0].digits > 0 && status == LRCS_OK; i++) {
        /* facet suffices if the planner proves it, else exact; closed forms need no mesh at all */
        const lrcs_run_options options = lrcs_run_options_default();
        lrcs_result result = {0};
        double seconds = 0.0;
        status = lrcs_host_scene_run(&job->mesh[i].scene, &job->pose, &options, &result, NULL, NULL,
                                     &seconds, error);
        job->spent += seconds;
        closed = result.method == LRCS_METHOD_CLOSED;
        method =
            closed || result.method == LRCS_METHOD_FACET ? LRCS_METHOD_FACET : LRCS_METHOD_EXACT;
        status = status != LRCS_OK
                     ? status
                     : setting_add(job, LRCS_HOST_CONVERGENCE_KIND_MESH, method, 0, i, error);
    }
    if (status == LRCS_OK &&
        method != LRCS_METHOD_FACET) { /* otherwise it has already been added */
        status =
            setting_add(job, LRCS_HOST_CONVERGENCE_KIND_FACET, LRCS_METHOD_FACET, 0, finest, error);
    }
    status = status != LRCS_OK ? status : rasters_add(job, finest, error);
    status = status != LRCS_OK ? status : previews_add(job, error);
    if (status == LRCS_OK && closed) { /* on the coarsest mesh, which is not used */
        status =
            setting_add(job, LRCS_HOST_CONVERGENCE_KIND_CLOSED, LRCS_METHOD_CLOSED, 0, 0, error);
    }
    return status != LRCS_OK ? status
                             : setting_add(job, LRCS_HOST_CONVERGENCE_KIND_EXACT, LRCS_METHOD_EXACT,
                                           0, finest, error);
}

/* Runs settings again in turn, so that other load of the machine affects them all alike, until each
   has had its share of the time, or a hundredth of the total. */
static int settings_repeat(lrcs_host_convergence *job, lrcs_host_error *error)
{
    double share = fmax((job->seconds - job->spent) / job->settings, 0.01 * job->seconds);
    int ran = 1;
    while (ran) {
        ran = 0;
        for (uint32_t i = 0; i < job->settings; i++) {
            lrcs_host_convergence_setting *setting = &job->setting[i];
            double mean = setting->spent_s / setting->runs;
            if (setting->runs == LRCS_HOST_CONVERGENCE_REPEATS || setting->spent_s + mean > share) {
                continue;
            }
            int status = setting_run(job, setting, error);
            if (status != LRCS_OK) {
                return status;
            }
            ran = 1;
        }
    }
    return LRCS_OK;
}

/* ---- the truth ---- */

/* 1 if a shape is not rotated or scaled; it may be translated. */
static int is_only_translated(const lrcs_recipe_part *part)
{
    const lrcs_place plain = lrcs_place_default();
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            if (part->place.rotate[i][k] != plain.rotate[i][k]) {
                return 0;
            }
        }
        if (part->place.scale[i] != plain.scale[i]) {
            return 0;
        }
    }
    return !part->joint.used;
}

/* The truth by the closed form of a single shape whose material reflects only outside. */
static int truth_closed(lrcs_host_convergence *job)
{
    const lrcs_recipe *recipe = &job->mesh[0].scene.recipe;
    const lrcs_scene *scene = &job->mesh[0].scene.scene;
    if (recipe->part_count != 1 || recipe->part[0].file || !is_only_translated(&recipe->part[0]) ||
        scene->facet_count == 0) {
        return 0;
    }
    const lrcs_material *material = &scene->material[scene->facet_material[0]];
    lrcs_aspect aspect = {.by_direction = 1};
    lrcs_closed_form closed;
    memcpy(aspect.direction, job->pose.direction, sizeof aspect.direction);
    if (material->two_sided || material->omitted ||
        lrcs_closed_eval(&recipe->part[0].shape, &material->brdf, &aspect, &closed) != LRCS_OK) {
        return 0;
    }
    job->truth.sigma_m2 = closed.sigma_m2;
    job->truth.bound_m2 = closed.bound_m2;
    job->truth.true_shapes = 1;
    snprintf(job->truth.text, sizeof job->truth.text, "the closed form of the %s",
             lrcs_shape_text(recipe->part[0].shape.kind));
    return 1;
}

/* Compares each setting with the truth. A bound counts if both are against the true shapes, or if
   the truth is exact on the same mesh; such a truth cannot judge its own mesh, which is therefore
   not listed. */
static void settings_judge(lrcs_host_convergence *job, int closed)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < job->settings; i++) {
        lrcs_host_convergence_setting setting = job->setting[i];
        int finest = setting.mesh == job->meshes - 1;
        setting.error_m2 = fabs(setting.sigma_m2 - job->truth.sigma_m2);
        int shapes = setting.true_shapes && job->truth.true_shapes;
        int facets = finest && !closed;
        setting.bound_m2 = shapes || facets ? setting.bound_m2 : -1.0;
        if (closed || setting.kind != LRCS_HOST_CONVERGENCE_KIND_MESH || !finest) {
            setting.pose_s = lrcsi_host_median(setting.seconds, setting.runs);
            job->setting[kept++] = setting;
        }
    }
    job->settings = kept;
}

int lrcs_host_convergence_measure(lrcs_host_convergence *job, lrcs_host_error *error)
{
    double waited = 0.0;
    int status = settings_add(job, error);
    status = status == LRCS_OK ? settings_repeat(job, error) : status;
    if (status != LRCS_OK) {
        return status;
    }
    stage_show(job, "converge", 0, 0);
    int closed = truth_closed(job);
    for (uint32_t i = 0; i < job->settings; i++) {
        const lrcs_host_convergence_setting *setting = &job->setting[i];
        waited += setting->spent_s;
        if (!closed && setting->kind == LRCS_HOST_CONVERGENCE_KIND_EXACT) {
            job->truth.sigma_m2 = setting->sigma_m2;
            job->truth.bound_m2 = setting->bound_m2;
            job->truth.true_shapes = setting->true_shapes;
        }
    }
    if (!closed) {
        snprintf(job->truth.text, sizeof job->truth.text, "exact on the %s, %lu facets",
                 job->meshes > 1 ? "finest mesh" : "mesh",
                 (unsigned long)lrcs_host_convergence_finest(job)->scene.scene.facet_count);
    }
    if (job->processor < BUSY_SHARE * waited) { /* then their times are too long */
        snprintf(job->busy, sizeof job->busy,
                 "the machine is busy: the runs had %.0f %% of a processor; times are too long",
                 100.0 * job->processor / waited);
    }
    settings_judge(job, closed);
    return LRCS_OK;
}
