/* SPDX-License-Identifier: MIT */
/* Runs one scene from one pose with every setting of every dial, and finds the truth. This file
   decides which settings there are, how often each is run, and with which truth they are
   compared. */
#include "cli/converge/converge.h"

#include <math.h>
#include <string.h>
#include <time.h>

#define RASTER_LEAST 16u
#define RASTER_MOST  4096u
#define BUSY_SHARE   0.8
#define FACETS_MOST  250000u /* meshes of shapes with more facets are not kept */
#define PREVIEWS     3       /* tolerances 1e-1 .. 1e-3 met by an estimate */

const converge_mesh *cli_converge_finest(const converge_job *job)
{
    return &job->mesh[job->meshes - 1];
}

/* ---- meshes ---- */

/* Reads the scene with its shapes built for a tolerance; keeps and prepares it if the mesh differs
   from the last one and is not too large. */
static int mesh_read(converge_job *job, int digits)
{
    converge_mesh *mesh = &job->mesh[job->meshes];
    mesh->digits = digits;
    job->load.build.tolerance = pow(10.0, -digits);
    job->load.build.facets_only = LRCS_FACETS_TOTAL; /* the cost of facets is measured */
    int code = cli_scene_read(job->args, &job->load, &mesh->scene);
    if (code != 0) {
        lrcs_host_scene_free(&mesh->scene);
        return code;
    }
    const lrcs_scene *scene = &mesh->scene.scene;
    if (job->meshes > 0 && scene->facet_count > FACETS_MOST) {
        snprintf(job->left_out, sizeof job->left_out, "left out: mesh 1e-%d, of %lu facets", digits,
                 (unsigned long)scene->facet_count);
        lrcs_host_scene_free(&mesh->scene);
        return 0;
    }
    if (job->meshes > 0 &&
        lrcs_scene_hash(scene) == lrcs_scene_hash(&cli_converge_finest(job)->scene.scene)) {
        lrcs_host_scene_free(&mesh->scene);
        return 0;
    }
    job->meshes++;
    return cli_scene_prepare(&mesh->scene);
}

/* Keeps every mesh that differs; if there is only one, it does not depend on the tolerance. */
int cli_converge_meshes(converge_job *job)
{
    int code = mesh_read(job, 1);
    int most = job->digits > 0 ? job->digits : CONVERGE_MESHES;
    int finest = code == 0 && cli_has_curved_shapes(&job->mesh[0].scene.scene) ? most : 1;
    for (int digits = 2; digits <= finest && code == 0 && !job->left_out[0]; digits++) {
        cli_watch_stage("meshes", NULL);
        cli_watch_count((uint64_t)digits, (uint64_t)finest);
        code = mesh_read(job, digits);
    }
    job->mesh[0].digits = job->meshes > 1 ? 1 : 0;
    return code;
}

/* ---- settings ---- */

static int setting_run(converge_job *job, converge_setting *setting)
{
    lrcs_result result = {0};
    lrcs_run_options options = lrcs_run_options_default();
    double *seconds = &setting->seconds[setting->runs];
    options.method = setting->dial == CONVERGE_CLOSED ? LRCS_METHOD_AUTO : setting->method;
    options.resolution = setting->resolution;
    if (setting->digits > 0) {
        options.method = LRCS_METHOD_AUTO;
        options.resolution = 0;
        options.tolerance = pow(10.0, -setting->digits);
        options.accept = LRCS_ACCEPT_ESTIMATE;
    }
    cli_watch_stage(setting->name, NULL);
    options.progress = cli_watch_run();
    clock_t begun = clock();
    int code = cli_scene_run(&job->mesh[setting->mesh].scene, &job->pose, &options, &result, NULL,
                             NULL, seconds);
    job->processor += (double)(clock() - begun) / CLOCKS_PER_SEC;
    if (code != 0) {
        return code;
    }
    setting->runs++;
    setting->sigma_m2 = result.sigma_m2;
    setting->bound_m2 = result.bound_m2;
    setting->estimate_m2 = result.estimate_m2;
    setting->whole = result.budget.tessellation_m2 >= 0.0;
    setting->short_of_memory = (result.flags & LRCS_FLAG_MEMORY_FALLBACK) != 0;
    if (setting->digits > 0) {
        setting->method = result.method;
        setting->resolution = result.resolution;
        setting->accepted_by = cli_accepted_by(result.flags);
    }
    setting->spent_s += *seconds;
    job->spent += *seconds;
    return 0;
}

/* Adds a setting and runs it for the first time. */
static int setting_add(converge_job *job, int dial, int method, uint32_t resolution, uint32_t mesh)
{
    converge_setting *setting = &job->setting[job->settings++];
    snprintf(setting->name, sizeof setting->name, "%s", lrcs_method_text(method));
    setting->dial = dial;
    setting->method = method;
    setting->resolution = resolution;
    setting->mesh = mesh;
    if (dial == CONVERGE_ZBUFFER) {
        lrcs_host_append(setting->name, sizeof setting->name, " %lu", (unsigned long)resolution);
    } else if (dial == CONVERGE_MESH) {
        lrcs_host_append(setting->name, sizeof setting->name, " on mesh 1e-%d",
                         job->mesh[mesh].digits);
    }
    return setting_run(job, setting);
}

/* Adds what lrcs run --accept estimate does, on the mesh that it makes; nothing if nothing is
   hidden, because that is proved. */
static int previews_add(converge_job *job)
{
    uint32_t mesh = 0;
    int code = 0;
    for (int digits = 1; digits <= PREVIEWS && code == 0; digits++) {
        converge_setting *setting = &job->setting[job->settings++];
        snprintf(setting->name, sizeof setting->name, CONVERGE_PREVIEW_NAME " 1e-%d", digits);
        setting->dial = CONVERGE_PREVIEW;
        while (mesh + 1 < job->meshes && job->mesh[mesh].digits < digits) {
            mesh++;
        }
        setting->digits = digits;
        setting->mesh = mesh;
        code = setting_run(job, setting);
        if (setting->method == LRCS_METHOD_FACET || setting->method == LRCS_METHOD_CLOSED) {
            job->setting[--job->settings] = (converge_setting){.dial = 0};
            break;
        }
    }
    return code;
}

/* Adds finer and finer rasters until half of the time is used. */
static int rasters_add(converge_job *job, uint32_t mesh)
{
    int code = 0;
    double last = 0.0;
    for (uint32_t n = RASTER_LEAST; n <= RASTER_MOST && code == 0; n *= 2) {
        if (job->spent + last > 0.5 * job->seconds) { /* this one would not be faster */
            lrcs_host_append(job->left_out, sizeof job->left_out,
                             "%szbuffer %lu and finer, for time",
                             job->left_out[0] ? "; " : "left out: ", (unsigned long)n);
            break;
        }
        code = setting_add(job, CONVERGE_ZBUFFER, LRCS_METHOD_ZBUFFER, n, mesh);
        last = job->setting[job->settings - 1].spent_s;
    }
    return code;
}

/* Adds every mesh with the method that suffices for it; the other methods on the finest mesh. */
static int settings_add(converge_job *job)
{
    uint32_t finest = job->meshes - 1;
    int method = LRCS_METHOD_EXACT;
    int closed = 0;
    int code = 0;
    for (uint32_t i = 0; i <= finest && job->mesh[0].digits > 0 && code == 0; i++) {
        /* facet suffices if the planner proves it, else exact; closed forms need no mesh at all */
        const lrcs_run_options options = lrcs_run_options_default();
        lrcs_result result = {0};
        double seconds = 0.0;
        code =
            cli_scene_run(&job->mesh[i].scene, &job->pose, &options, &result, NULL, NULL, &seconds);
        job->spent += seconds;
        closed = result.method == LRCS_METHOD_CLOSED;
        method =
            closed || result.method == LRCS_METHOD_FACET ? LRCS_METHOD_FACET : LRCS_METHOD_EXACT;
        code = code ? code : setting_add(job, CONVERGE_MESH, method, 0, i);
    }
    if (code == 0 && method != LRCS_METHOD_FACET) { /* otherwise it has already been added */
        code = setting_add(job, CONVERGE_FACET, LRCS_METHOD_FACET, 0, finest);
    }
    code = code ? code : rasters_add(job, finest);
    code = code ? code : previews_add(job);
    if (code == 0 && closed) { /* on the coarsest mesh, which is not used */
        code = setting_add(job, CONVERGE_CLOSED, LRCS_METHOD_CLOSED, 0, 0);
    }
    return code ? code : setting_add(job, CONVERGE_EXACT, LRCS_METHOD_EXACT, 0, finest);
}

/* Runs settings again in turn, so that other load of the machine affects them all alike, until each
   has had its share of the time, or a hundredth of the total. */
static int settings_repeat(converge_job *job)
{
    double share = fmax((job->seconds - job->spent) / job->settings, 0.01 * job->seconds);
    int ran = 1;
    while (ran) {
        ran = 0;
        for (uint32_t i = 0; i < job->settings; i++) {
            converge_setting *setting = &job->setting[i];
            double mean = setting->spent_s / setting->runs;
            if (setting->runs == CONVERGE_REPEATS || setting->spent_s + mean > share) {
                continue;
            }
            int code = setting_run(job, setting);
            if (code != 0) {
                return code;
            }
            ran = 1;
        }
    }
    return 0;
}

/* ---- the truth ---- */

/* 1 if a shape is not rotated or scaled; it may be translated. */
static int stands_plain(const lrcs_recipe_part *part)
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
static int truth_closed(converge_job *job)
{
    const lrcs_recipe *recipe = &job->mesh[0].scene.recipe;
    const lrcs_scene *scene = &job->mesh[0].scene.scene;
    if (recipe->part_count != 1 || recipe->part[0].file || !stands_plain(&recipe->part[0]) ||
        scene->facet_count == 0) {
        return 0;
    }
    const lrcs_material *material = &scene->material[scene->facet_material[0]];
    lrcs_aspect aspect = {.by_direction = 1};
    lrcs_closed closed;
    memcpy(aspect.direction, job->pose.direction, sizeof aspect.direction);
    if (material->two_sided || material->omitted ||
        lrcs_closed_eval(&recipe->part[0].shape, &material->brdf, &aspect, &closed) != LRCS_OK) {
        return 0;
    }
    job->truth.sigma_m2 = closed.sigma_m2;
    job->truth.bound_m2 = closed.bound_m2;
    job->truth.whole = 1;
    snprintf(job->truth.text, sizeof job->truth.text, "the closed form of the %s",
             lrcs_shape_text(recipe->part[0].shape.kind));
    return 1;
}

/* Compares each setting with the truth. A bound counts if both are against the true shapes, or if
   the truth is exact on the same mesh; such a truth cannot judge its own mesh, which is therefore
   not listed. */
static void settings_judge(converge_job *job, int closed)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < job->settings; i++) {
        converge_setting setting = job->setting[i];
        int finest = setting.mesh == job->meshes - 1;
        setting.error_m2 = fabs(setting.sigma_m2 - job->truth.sigma_m2);
        int shapes = setting.whole && job->truth.whole;
        int facets = finest && !closed;
        setting.bound_m2 = shapes || facets ? setting.bound_m2 : -1.0;
        if (closed || setting.dial != CONVERGE_MESH || !finest) {
            setting.pose_s = cli_median(setting.seconds, setting.runs);
            job->setting[kept++] = setting;
        }
    }
    job->settings = kept;
}

int cli_converge_measure(converge_job *job)
{
    double waited = 0.0;
    int code = settings_add(job);
    code = code ? code : settings_repeat(job);
    cli_watch_stage("converge", NULL);
    if (code != 0) {
        return code;
    }
    int closed = truth_closed(job);
    for (uint32_t i = 0; i < job->settings; i++) {
        const converge_setting *setting = &job->setting[i];
        waited += setting->spent_s;
        if (!closed && setting->dial == CONVERGE_EXACT) {
            job->truth.sigma_m2 = setting->sigma_m2;
            job->truth.bound_m2 = setting->bound_m2;
            job->truth.whole = setting->whole;
        }
    }
    if (!closed) {
        snprintf(job->truth.text, sizeof job->truth.text, "exact on the %s, %lu facets",
                 job->meshes > 1 ? "finest mesh" : "mesh",
                 (unsigned long)cli_converge_finest(job)->scene.scene.facet_count);
    }
    if (job->processor < BUSY_SHARE * waited) { /* then their times are too long */
        snprintf(job->busy, sizeof job->busy,
                 "the machine is busy: the runs had %.0f %% of a processor; times are too long",
                 100.0 * job->processor / waited);
    }
    settings_judge(job, closed);
    return 0;
}
