/* SPDX-License-Identifier: MIT */
/* Runs one scene from one pose with every dial at every position, and finds out what is true. It
   decides which positions there are, how often each is run, and which truth they are held to. */
#include "cli/converge.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define REPEATS_MOST  25
#define RASTER_LEAST  16u
#define RASTER_MOST   4096u
#define RASTERS       9u
#define FACETS_MOST   250000u /* no finer mesh of shapes is built */
#define MESH_COARSEST 1e-1
#define MESH_LEVELS   6

/* ---- one setting ---- */

static void progress_say(const char *what)
{
    if (isatty(STDERR_FILENO)) {
        fprintf(stderr, "\r%-40.40s%s", what, *what ? "" : "\r");
        fflush(stderr);
    }
}

static int seconds_compare(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

static double seconds_median(double *seconds, uint32_t count)
{
    qsort(seconds, count, sizeof *seconds, seconds_compare);
    return 0.5 * (seconds[(count - 1) / 2] + seconds[count / 2]);
}

/* Runs a setting at least once, then again while its share of the time lasts. */
static int setting_run(converge_job *job, converge_setting *setting, double share,
                       lrcs_result *result)
{
    lrcs_host_error error;
    lrcs_run_options options = lrcs_run_options_default();
    double seconds[REPEATS_MOST];
    double used = 0.0;
    options.method = setting->method;
    options.resolution = setting->resolution;
    progress_say(setting->name);
    for (uint32_t i = 0; i < REPEATS_MOST; i++) {
        int status = lrcs_host_scene_run(&job->scene, &job->pose, &options, result, NULL, NULL,
                                         &seconds[i], &error);
        if (status != LRCS_OK) {
            progress_say("");
            return cli_failed(&error);
        }
        used += seconds[i];
        setting->repetitions = i + 1;
        if (used + seconds[i] > share) {
            break;
        }
    }
    job->spent += used;
    setting->pose_s = seconds_median(seconds, setting->repetitions);
    return 0;
}

/* Measures a setting on the mesh at hand and keeps it. */
static int setting_measure(converge_job *job, converge_setting setting, double share)
{
    lrcs_result result = {0};
    if (job->count == CONVERGE_MOST) {
        return 0;
    }
    setting.mesh = job->mesh;
    setting.facets = job->scene.scene.facet_count;
    setting.prepare_s = job->scene.seconds_prepare;
    int code = setting_run(job, &setting, share, &result);
    if (code == 0) {
        setting.sigma_m2 = result.sigma_m2;
        setting.estimate_m2 = result.estimate_m2;
        setting.bound_m2 = result.bound_m2;
        setting.whole = result.budget.tessellation_m2 >= 0.0;
        setting.short_of_memory = (result.flags & LRCS_FLAG_MEMORY_FALLBACK) != 0;
        job->setting[job->count++] = setting;
    }
    return code;
}

/* ---- meshes ---- */

/* A mesh of the scene for a tolerance, prepared; the one before it is freed only where the new
   one is another, and not too large. *better says whether it was kept. */
static int mesh_read(converge_job *job, double tolerance, int *better)
{
    lrcs_host_error error;
    lrcs_host_scene scene;
    memset(&scene, 0, sizeof scene);
    *better = 0;
    job->load.build.tolerance = tolerance;
    int code = cli_scene_read(job->args, &job->load, &scene);
    if (code != 0) {
        lrcs_host_scene_free(&scene);
        return code;
    }
    uint64_t hash = lrcs_scene_hash(&scene.scene);
    int first = !job->scene.prepared;
    int same = !first && hash == job->hash;
    int large = !first && scene.scene.facet_count > FACETS_MOST;
    job->spent += scene.seconds_load;
    if (same || large) {
        if (large) {
            snprintf(job->left_out, sizeof job->left_out,
                     "meshes of more than %lu facets: %g and finer", (unsigned long)FACETS_MOST,
                     tolerance);
        }
        lrcs_host_scene_free(&scene);
        return 0;
    }
    lrcs_host_scene_free(&job->scene);
    job->scene = scene; /* and only then prepared: that refers to where the scene is */
    if (lrcs_host_scene_prepare(&job->scene, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    job->hash = hash;
    job->spent += job->scene.seconds_prepare;
    *better = 1;
    return 0;
}

static int has_shapes(const lrcs_scene *scene)
{
    for (uint32_t i = 0; i < scene->part_count; i++) {
        if (scene->part[i].kind >= 0 && scene->part[i].curvature.turn > 0.0) {
            return 1;
        }
    }
    return 0;
}

/* What is enough for this scene and pose: facet where the planner proves it, else exact. */
static int enough_method(const converge_job *job)
{
    lrcs_run_options options = lrcs_run_options_default();
    lrcs_result result = {0};
    int status =
        lrcs_host_scene_run(&job->scene, &job->pose, &options, &result, NULL, NULL, NULL, NULL);
    return status == LRCS_OK && result.method == LRCS_METHOD_FACET ? LRCS_METHOD_FACET
                                                                   : LRCS_METHOD_EXACT;
}

/* Every fineness of mesh that makes a difference, coarse to fine; the finest one stays. */
static int meshes_measure(converge_job *job)
{
    int better = 0;
    int code = mesh_read(job, MESH_COARSEST, &better);
    if (code != 0 || !has_shapes(&job->scene.scene)) {
        return code;
    }
    double share = 0.3 * job->seconds / MESH_LEVELS;
    double tolerance = MESH_COARSEST;
    for (int i = 0; i < MESH_LEVELS && code == 0; i++) {
        if (better) {
            converge_setting setting = {.dial = CONVERGE_MESH, .method = enough_method(job)};
            job->mesh = tolerance;
            snprintf(setting.name, sizeof setting.name, "%s on mesh %.0e",
                     lrcs_method_text(setting.method), tolerance);
            code = setting_measure(job, setting, share);
        }
        tolerance /= 10.0;
        if (code == 0 && i + 1 < MESH_LEVELS && job->left_out[0] == '\0') {
            code = mesh_read(job, tolerance, &better);
        }
    }
    return code;
}

/* ---- methods ---- */

static int methods_measure(converge_job *job)
{
    static const converge_setting plain[] = {
        {.dial = CONVERGE_EXACT, .name = "exact", .method = LRCS_METHOD_EXACT},
        {.dial = CONVERGE_FACET, .name = "facet", .method = LRCS_METHOD_FACET}};
    int code = 0;
    uint32_t left = RASTERS + 2;
    for (int i = 0; i < 2 && code == 0; i++) {
        code = setting_measure(job, plain[i], (job->seconds - job->spent) / left--);
    }
    double last = 0.0;
    for (uint32_t n = RASTER_LEAST; n <= RASTER_MOST && code == 0; n *= 2) {
        double rest = job->seconds - job->spent;
        if (last > rest) { /* the next one takes longer still */
            size_t used = strlen(job->left_out);
            snprintf(job->left_out + used, sizeof job->left_out - used,
                     "%szbuffer %lu and finer: time is up", used ? "; " : "", (unsigned long)n);
            break;
        }
        converge_setting setting = {
            .dial = CONVERGE_ZBUFFER, .method = LRCS_METHOD_ZBUFFER, .resolution = n};
        snprintf(setting.name, sizeof setting.name, "zbuffer %lu", (unsigned long)n);
        code = setting_measure(job, setting, rest / left--);
        last = code == 0 ? job->setting[job->count - 1].pose_s : 0.0;
    }
    return code;
}

/* ---- the truth ---- */

/* A shape as it stands in its own frame: moved at most. */
static int stands_plain(const lrcs_recipe_part *part)
{
    const lrcs_place plain = lrcs_place_default();
    return !part->joint.used &&
           memcmp(part->place.rotate, plain.rotate, sizeof plain.rotate) == 0 &&
           memcmp(part->place.scale, plain.scale, sizeof plain.scale) == 0;
}

static int truth_closed(const converge_job *job, converge_truth *truth)
{
    const lrcs_recipe *recipe = &job->scene.recipe;
    const lrcs_scene *scene = &job->scene.scene;
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
    *truth =
        (converge_truth){.closed = 1, .sigma_m2 = closed.sigma_m2, .bound_m2 = closed.bound_m2};
    snprintf(truth->text, sizeof truth->text, "the closed form of the %s",
             lrcs_shape_text(recipe->part[0].shape.kind));
    return 1;
}

static void truth_exact(const converge_job *job, converge_truth *truth)
{
    for (uint32_t i = 0; i < job->count; i++) {
        const converge_setting *setting = &job->setting[i];
        if (setting->dial == CONVERGE_EXACT) {
            *truth = (converge_truth){.sigma_m2 = setting->sigma_m2, .bound_m2 = setting->bound_m2};
            snprintf(truth->text, sizeof truth->text, "exact on %s%lu facets",
                     job->mesh > 0.0 ? "the finest mesh, " : "the mesh, ",
                     (unsigned long)setting->facets);
        }
    }
}

/* A bound against facets holds for the truth only where the truth is of the same facets. */
static void settings_judge(converge_job *job)
{
    for (uint32_t i = 0; i < job->count; i++) {
        converge_setting *setting = &job->setting[i];
        setting->error_m2 = fabs(setting->sigma_m2 - job->truth.sigma_m2);
        if (!setting->whole && (job->truth.closed || setting->mesh != job->mesh)) {
            setting->bound_m2 = -1.0;
        }
    }
}

int cli_converge_measure(converge_job *job)
{
    int code = meshes_measure(job);
    code = code ? code : methods_measure(job);
    progress_say("");
    if (code != 0) {
        return code;
    }
    if (!truth_closed(job, &job->truth)) {
        truth_exact(job, &job->truth);
    }
    settings_judge(job);
    return 0;
}
