/* SPDX-License-Identifier: MIT */
/* One model file: its reader, the search for its material file, and the notices about it. It
   decides no geometry and no reflection. */
#include "host/scene/model.h"

#include <dirent.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

#include "host/files/input.h"

char *lrcsi_host_beside(lrcs_host_scene *scene, const char *beside, const char *name)
{
    size_t folder = name[0] == '/' ? 0 : (size_t)(lrcsi_host_basename(beside) - beside);
    size_t size = strlen(name);
    char *path = lrcsi_host_take(scene, folder + size + 1, 1);
    if (path) {
        memcpy(path, beside, folder);
        memcpy(path + folder, name, size);
    }
    return path;
}

/* Replaces the last part of `path` by the name of a folder entry that differs from it only in case,
   if there is one. */
static int match_case(char *path)
{
    char *name = path + (lrcsi_host_basename(path) - path);
    char kept = *name;
    *name = '\0';
    DIR *folder = opendir(path[0] ? path : ".");
    *name = kept;
    int found = 0;
    const struct dirent *entry;
    while (folder && !found && (entry = readdir(folder)) != NULL) {
        if (strcasecmp(entry->d_name, name) == 0) {
            strcpy(name, entry->d_name); /* of the same length */
            found = 1;
        }
    }
    if (folder) {
        closedir(folder);
    }
    return found;
}

/* The material file's path: the name that the OBJ gives, beside the OBJ whatever folder it was
   exported from; then STEM.mtl. NULL if neither exists. */
static char *material_path(lrcs_host_scene *scene, const char *path, const char *named)
{
    if (named) {
        const char *slash = strrchr(named, '\\');
        char *beside =
            lrcsi_host_beside(scene, path, lrcsi_host_basename(slash ? slash + 1 : named));
        if (beside && (access(beside, F_OK) == 0 || match_case(beside))) {
            return beside;
        }
    }
    const char *dot = strrchr(lrcsi_host_basename(path), '.');
    size_t stem = dot ? (size_t)(dot - path) : strlen(path);
    char *other = lrcsi_host_take(scene, stem + sizeof ".mtl", 1);
    if (!other) {
        return NULL;
    }
    memcpy(other, path, stem);
    memcpy(other + stem, ".mtl", sizeof ".mtl");
    return access(other, F_OK) == 0 || match_case(other) ? other : NULL;
}

static int materials_read(lrcs_host_scene *scene, const char *path, lrcs_mesh *mesh,
                          lrcs_host_error *error)
{
    const char *label = lrcsi_host_basename(path);
    const char *named = mesh->material_file;
    const char *beside = material_path(scene, path, named);
    if (!beside) {
        if (named) {
            lrcsi_host_note(&scene->notices,
                            "%s: material file '%s' not found: materials have names but no colours",
                            label, named);
        }
        return LRCS_OK;
    }
    if (named && strcasecmp(lrcsi_host_basename(beside), lrcsi_host_basename(named)) != 0) {
        lrcsi_host_note(&scene->notices, "%s: material file '%s' not found: '%s' is used instead",
                        label, named, lrcsi_host_basename(beside));
    }
    lrcs_host_file file;
    lrcs_where where = {0};
    int status = lrcsi_host_input_read(scene, beside, &file, error);
    if (status != LRCS_OK) {
        return status;
    }
    status = lrcs_mtl_read(file.bytes, file.size, mesh, &where);
    lrcs_host_file_free(&file);
    return status == LRCS_OK ? LRCS_OK : lrcsi_host_fail_where(error, status, beside, &where);
}

static void notices_add(lrcs_host_scene *scene, const char *path, int format, const lrcs_mesh *mesh)
{
    static const struct {
        uint32_t bit;
        const char *text;
    } notice[] = {
        {LRCS_MESH_KEYFRAMER, "animation (keyframer) is present and ignored: vertices as stored"},
        {LRCS_MESH_LOCAL_MATRIX, "mesh matrices are present and ignored: vertices as stored"},
        {LRCS_MESH_UNDEFINED_MATERIAL, "facets name a material that the file does not define"},
        {LRCS_MESH_TRAILING_BYTES, "bytes after the end, or a length that disagrees, were ignored"},
        {LRCS_MESH_OVERLAPPING_GROUPS, "facets in several material groups: the last one counts"},
        {LRCS_MESH_LATIN1_NAMES, "names that are not UTF-8 were read as Latin-1"},
        {LRCS_MESH_NORMALS_DISAGREE, "stored normals disagree with the winding, which counts"},
    };
    for (size_t i = 0; i < sizeof notice / sizeof notice[0]; i++) {
        if (mesh->notices & notice[i].bit) {
            lrcsi_host_note(&scene->notices, "%s: %s", lrcsi_host_basename(path), notice[i].text);
        }
    }
    if (mesh->facet_count == 0) {
        lrcsi_host_note(
            &scene->notices, "%s: holds no facets%s", lrcsi_host_basename(path),
            format == LRCS_FORMAT_OBJ ? ": none of its lines is a face (f) as OBJ writes it" : "");
    }
}

static int model_count(int format, const lrcs_host_file *file, lrcs_mesh_counts *counts,
                       lrcs_where *where)
{
    switch (format) {
    case LRCS_FORMAT_3DS:
        return lrcs_3ds_count(file->bytes, file->size, counts, where);
    case LRCS_FORMAT_OBJ:
        return lrcs_obj_count(file->bytes, file->size, counts, where);
    default:
        return lrcs_stl_count(file->bytes, file->size, counts, where);
    }
}

static int model_read(int format, const lrcs_host_file *file, lrcs_work *work, lrcs_mesh *mesh,
                      lrcs_where *where)
{
    switch (format) {
    case LRCS_FORMAT_3DS:
        return lrcs_3ds_read(file->bytes, file->size, work, mesh, where);
    case LRCS_FORMAT_OBJ:
        return lrcs_obj_read(file->bytes, file->size, work, mesh, where);
    default:
        return lrcs_stl_read(file->bytes, file->size, work, mesh, where);
    }
}

int lrcsi_host_model_read(lrcs_host_scene *scene, const char *path, const lrcs_host_file *file,
                          lrcs_mesh *mesh, lrcs_host_error *error)
{
    lrcs_where where = {0};
    lrcs_mesh_counts counts = {0};
    int format = lrcs_format_check(file->bytes, file->size, lrcsi_host_basename(path));
    if (format == LRCS_FORMAT_UNKNOWN) {
        return lrcsi_host_fail(error, LRCS_E_SYNTAX, "%s: not a model: expected 3DS, OBJ or STL",
                               path);
    }
    int status = model_count(format, file, &counts, &where);
    if (status != LRCS_OK) {
        return lrcsi_host_fail_where(error, status, path, &where);
    }
    lrcsi_host_area area = {NULL, 0};
    lrcsi_host_attempt attempt = lrcsi_host_attempt_make(&area, lrcs_mesh_need(&counts));
    while (lrcsi_host_attempt_next(&attempt, error)) {
        attempt.status = model_read(format, file, &attempt.work, mesh, &where);
    }
    status = lrcsi_host_attempt_keep(&attempt, &scene->blocks);
    if (status == LRCS_E_SYSTEM) {
        return status;
    }
    if (status != LRCS_OK) {
        return lrcsi_host_fail_where(error, status, path, &where);
    }
    if (format == LRCS_FORMAT_OBJ) {
        status = materials_read(scene, path, mesh, error);
    }
    notices_add(scene, path, format, mesh);
    return status;
}
