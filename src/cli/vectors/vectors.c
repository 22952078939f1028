/* SPDX-License-Identifier: MIT */
/* lrcs vectors: writes a conformance kit for other implementations. This file decides the order of
   work and which cases there are; the output has the same bytes every time. */
#include "cli/vectors/vectors.h"

#include <dirent.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define RESOLUTION      128u
#define RESOLUTION_MOST 4096.0

static const char vectors_help[] =
    "usage: lrcs vectors DIR [options]\n"
    "\n"
    "Writes a conformance kit for other implementations into DIR: small scenes (OBJ, STL, JSON),\n"
    "attitudes, materials, and the truth of each: sigma with its bound, glint and diffuse parts,\n"
    "visible area and cos theta of every facet, item and depth images; in five tiers, from a "
    "plate\n"
    "to hard cases. DIR/README.md says all that one needs to take part; lrcs compare judges.\n"
    "DIR is made where it is not there; an older kit in it is overwritten, but files of scenes "
    "that\n"
    "are not asked for stay (cases.csv says which count). The same bytes every time.\n"
    "\n"
    "options\n"
    "  --resolution N        side of the images in pixels (128; 0: none)\n"
    "  --tier K              tiers 1 .. K alone (5)\n"
    "\n"
    "examples\n"
    "  lrcs vectors kit\n"
    "  lrcs vectors kit --resolution 512\n";

static const cli_option vectors_options[] = {
    {"resolution", 1, 0}, {"tier", 1, 0}, {"help", 0, 0}, {NULL, 0, 0}};

/* ---- the folder ---- */

/* Makes the folders of a kit. A folder that contains files but no kit is not written to. */
static int folders_make(const char *path)
{
    static const char *const name[] = {"", "/scenes", "/truth"};
    char inside[KIT_PATH];
    struct stat about;
    int entries = 0;
    int code = 0;
    DIR *folder = opendir(path);
    while (folder && readdir(folder)) {
        entries++;
    }
    if (folder) {
        closedir(folder);
    }
    int kit = cli_kit_path(inside, "%s/scenes", path) == 0 && stat(inside, &about) == 0;
    if (entries > 2 && !kit) { /* "." and ".." */
        return cli_fail("%s: holds other files, and no kit: give an empty folder", path);
    }
    for (int i = 0; i < 3 && code == 0; i++) {
        code = cli_kit_path(inside, "%s%s", path, name[i]);
        if (code == 0 && mkdir(inside, 0777) != 0 && errno != EEXIST) {
            code = cli_fail("%s: cannot make this folder: %s", inside, strerror(errno));
        }
    }
    return code;
}

/* ---- cases ---- */

/* The numbers of an attitude as they are printed, and the pose made from the printed numbers. */
static int case_make(const vectors_scene *scene, const vectors_attitude *attitude,
                     vectors_case *one)
{
    lrcs_pose pose;
    const double *q = attitude->quaternion;
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    *one = (vectors_case){.scene = scene, .attitude = attitude};
    if (lrcs_pose_from_quaternion(q, &pose) != LRCS_OK) {
        return CLI_FAILED;
    }
    for (int k = 0; k < 4; k++) {
        one->quaternion[k] = q[k] / length;
    }
    cli_pose_unit(&pose, one->direction);
    const double *s = one->direction;
    one->azel_deg[0] = CLI_DEGREES * atan2(s[1], s[0]);
    one->azel_deg[1] = CLI_DEGREES * atan2(s[2], hypot(s[0], s[1]));
    return lrcs_host_kit_pose(one->quaternion, one->direction, &one->pose) == LRCS_OK ? 0
                                                                                      : CLI_FAILED;
}

/* Adds every attitude of the scene's sets; the first one, if possible off all axes, has
   pictures. */
static int cases_add(vectors_job *job, const vectors_scene *scene)
{
    int code = 0;
    int pictures = job->resolution > 0;
    unsigned shown = scene->attitudes & VECTORS_TURNS ? VECTORS_TURNS : ~VECTORS_EDGES;
    for (const vectors_attitude *a = cli_vectors_attitudes; a->name && code == 0; a++) {
        if (a->set & scene->attitudes) {
            vectors_case *one = &job->list[job->cases++];
            code = case_make(scene, a, one);
            one->image = pictures && (a->set & ~shown) == 0;
            pictures = pictures && !one->image;
        }
    }
    return code;
}

/* Allocates memory for all cases, and makes the bindings of all materials. */
static int job_room(vectors_job *job)
{
    const vectors_material *material = cli_vectors_materials;
    size_t scenes = 0;
    size_t attitudes = 0;
    size_t materials = 0;
    while (cli_vectors_scenes[scenes].name) {
        scenes++;
    }
    while (cli_vectors_attitudes[attitudes].name) {
        attitudes++;
    }
    while (material[materials].name) {
        materials++;
    }
    job->list = calloc(scenes * attitudes + 1, sizeof *job->list);
    job->binding = calloc(materials + 1, sizeof *job->binding);
    if (!job->list || !job->binding) {
        return cli_out_of_memory();
    }
    for (; job->bindings < materials; job->bindings++, material++) {
        job->binding[job->bindings] = (lrcs_binding){.kind = LRCS_BIND_NAME,
                                                     .name = material->name,
                                                     .brdf = material->brdf,
                                                     .two_sided = material->two_sided};
    }
    return 0;
}

static int vectors_make(vectors_job *job, uint32_t tier)
{
    uint32_t scenes = 0;
    int code = job_room(job);
    code = code ? code : folders_make(job->folder);
    for (const vectors_scene *scene = cli_vectors_scenes; scene->name && code == 0; scene++) {
        if ((uint32_t)scene->tier <= tier) {
            cli_watch_stage(scene->name, NULL);
            vectors_mesh mesh;
            code = cli_vectors_mesh(scene, &mesh);
            code = code ? code : cli_vectors_files(job, scene, &mesh);
            cli_vectors_mesh_free(&mesh);
            code = code ? code : cases_add(job, scene);
            code = code ? code : cli_vectors_truth(job, scene);
            scenes++;
        }
    }
    code = code ? code : cli_vectors_index(job);
    cli_watch_end();
    if (code == 0) {
        printf("%s: kit %d, %lu scenes, %lu cases; begin with %s/README.md\n", job->folder,
               LRCS_HOST_KIT_VERSION, (unsigned long)scenes, (unsigned long)job->cases,
               job->folder);
    }
    return code;
}

static int vectors_command(const cli_args *args)
{
    vectors_job job = {.folder = args->operand, .resolution = RESOLUTION};
    uint32_t tier = LRCS_HOST_KIT_TIERS;
    int code = cli_whole(args, "resolution", 0.0, RESOLUTION_MOST, &job.resolution);
    code = code ? code : cli_whole(args, "tier", 1.0, LRCS_HOST_KIT_TIERS, &tier);
    code = code ? code : vectors_make(&job, tier);
    free(job.list);
    free(job.binding);
    return code;
}

const cli_command cli_vectors_command = {
    "vectors",       "DIR", "give the folder that the kit goes to", vectors_help, vectors_options,
    vectors_command, NULL};
