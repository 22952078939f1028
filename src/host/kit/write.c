/* SPDX-License-Identifier: MIT */
/* Writes a conformance kit. This file decides the order of work and which cases there are; the
   output has the same bytes every time. */
#include <lrcs/kit.h>

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/constant.h"
#include "host/files/file.h"
#include "host/kit/vectors.h"

int lrcsi_vectors_write(const char *prefix, const lrcsi_vectors_file *file, int count,
                        const void *context, lrcs_host_error *error)
{
    int status = LRCS_OK;
    for (int i = 0; i < count && status == LRCS_OK; i++) {
        char path[LRCSI_KIT_PATH];
        lrcs_host_output out;
        status = lrcsi_kit_path(path, error, "%s%s", prefix, file[i].name);
        status = status == LRCS_OK ? lrcs_host_output_open(path, &out, error) : status;
        if (status == LRCS_OK) {
            status = file[i].write(out.stream, context, error);
            status = lrcsi_host_output_end(&out, status, error);
        }
    }
    return status;
}

/* Makes the folders of a kit. A folder that contains files but no kit is not written to. */
static int folders_make(const char *path, lrcs_host_error *error)
{
    static const char *const name[] = {"", "/scenes", "/truth"};
    char inside[LRCSI_KIT_PATH];
    struct stat about;
    int entries = 0;
    DIR *folder = opendir(path);
    while (folder && readdir(folder)) {
        entries++;
    }
    if (folder) {
        closedir(folder);
    }
    int status = lrcsi_kit_path(inside, error, "%s/scenes", path);
    if (status == LRCS_OK && entries > 2 && stat(inside, &about) != 0) { /* "." and ".." */
        return lrcsi_host_fail(error, LRCS_E_SYSTEM,
                               "%s: contains other files but no kit: choose an empty folder", path);
    }
    for (int i = 0; i < 3 && status == LRCS_OK; i++) {
        status = lrcsi_kit_path(inside, error, "%s%s", path, name[i]);
        if (status == LRCS_OK && mkdir(inside, 0777) != 0 && errno != EEXIST) {
            status = lrcsi_host_fail_file(error, inside, "make this folder");
        }
    }
    return status;
}

/* ---- cases ---- */

/* The numbers of an attitude as they are printed, and the pose made from the printed numbers. */
static int case_make(const lrcsi_vectors_scene *scene, const lrcsi_vectors_attitude *attitude,
                     lrcsi_vectors_case *one)
{
    lrcs_pose pose;
    const double *q = attitude->quaternion;
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    *one = (lrcsi_vectors_case){.scene = scene, .attitude = attitude};
    int status = lrcs_pose_from_quaternion(q, &pose);
    if (status != LRCS_OK) {
        return status;
    }
    for (int k = 0; k < 4; k++) {
        one->quaternion[k] = q[k] / length;
    }
    const double *d = pose.direction;
    length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    double *s = one->direction;
    for (int k = 0; k < 3; k++) {
        s[k] = d[k] / length;
    }
    one->azel_deg[0] = LRCS_DEGREES_PER_RADIAN * atan2(s[1], s[0]);
    one->azel_deg[1] = LRCS_DEGREES_PER_RADIAN * atan2(s[2], hypot(s[0], s[1]));
    return lrcsi_kit_pose(one->quaternion, s, &one->pose);
}

/* Adds every attitude of the scene's sets; the first one, if possible off all axes, has
   pictures. */
static int cases_add(lrcsi_vectors_job *job, const lrcsi_vectors_scene *scene)
{
    int status = LRCS_OK;
    int pictures = job->resolution > 0;
    unsigned shown =
        scene->attitudes & LRCSI_VECTORS_OBLIQUE ? LRCSI_VECTORS_OBLIQUE : ~LRCSI_VECTORS_EDGES;
    for (const lrcsi_vectors_attitude *a = lrcsi_vectors_attitudes; a->name && status == LRCS_OK;
         a++) {
        if (a->set & scene->attitudes) {
            lrcsi_vectors_case *one = &job->list[job->cases++];
            status = case_make(scene, a, one);
            one->image = pictures && (a->set & ~shown) == 0;
            pictures = pictures && !one->image;
        }
    }
    return status;
}

/* Allocates memory for all cases, and makes the bindings of all materials. */
static int job_room(lrcsi_vectors_job *job, lrcs_host_error *error)
{
    const lrcsi_vectors_material *material = lrcsi_vectors_materials;
    size_t scenes = 0;
    size_t attitudes = 0;
    size_t materials = 0;
    while (lrcsi_vectors_scenes[scenes].name) {
        scenes++;
    }
    while (lrcsi_vectors_attitudes[attitudes].name) {
        attitudes++;
    }
    while (material[materials].name) {
        materials++;
    }
    job->list = calloc(scenes * attitudes + 1, sizeof *job->list);
    job->binding = calloc(materials + 1, sizeof *job->binding);
    if (!job->list || !job->binding) {
        return lrcsi_host_out_of_memory(error);
    }
    for (; job->bindings < materials; job->bindings++, material++) {
        job->binding[job->bindings] = (lrcs_binding){.kind = LRCS_BIND_NAME,
                                                     .name = material->name,
                                                     .brdf = material->brdf,
                                                     .two_sided = material->two_sided};
    }
    return LRCS_OK;
}

int lrcs_host_kit_write(const char *folder, const lrcs_host_kit_options *options,
                        lrcs_host_kit_size *size, lrcs_host_error *error)
{
    lrcsi_vectors_job job = {.folder = folder, .resolution = options->resolution};
    uint32_t scenes = 0;
    if (options->tier < 1 || options->tier > LRCS_HOST_KIT_TIERS ||
        options->resolution > LRCS_HOST_KIT_RESOLUTION_MOST) {
        return lrcsi_host_fail(error, LRCS_E_ARGUMENT, "%s: no such tier or resolution", folder);
    }
    int status = job_room(&job, error);
    status = status == LRCS_OK ? folders_make(folder, error) : status;
    for (const lrcsi_vectors_scene *scene = lrcsi_vectors_scenes; scene->name && status == LRCS_OK;
         scene++) {
        if ((uint32_t)scene->tier > options->tier) {
            continue;
        }
        if (options->begin) {
            options->begin(scene->name);
        }
        lrcsi_vectors_mesh mesh;
        status = lrcsi_vectors_mesh_make(scene, &mesh, error);
        status = status == LRCS_OK ? lrcsi_vectors_scene_write(&job, scene, &mesh, error) : status;
        lrcsi_vectors_mesh_free(&mesh);
        status = status == LRCS_OK ? cases_add(&job, scene) : status;
        status = status == LRCS_OK ? lrcsi_vectors_truth_write(&job, scene, error) : status;
        scenes++;
    }
    status = status == LRCS_OK ? lrcsi_vectors_index_write(&job, error) : status;
    if (status == LRCS_OK && size) {
        *size = (lrcs_host_kit_size){.scenes = scenes, .cases = job.cases};
    }
    free(job.list);
    free(job.binding);
    return status;
}
