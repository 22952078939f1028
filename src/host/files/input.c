/* SPDX-License-Identifier: MIT */
/* Which files a scene was read from, so that no output replaces one of them. A file is known by
   device and node, whatever path leads to it. Models and scene files are regular files: devices and
   pipes are refused. It does not interpret the files. */
#include "host/files/input.h"

#include <stdlib.h>
#include <string.h>

#include "host/files/file.h"

const char *lrcsi_host_basename(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

int lrcsi_host_input_read(lrcs_host_scene *scene, const char *path, lrcs_host_file *file,
                          lrcs_host_error *error)
{
    struct stat about;
    /* before it is opened: a pipe without a writer would block forever, and a device may have no
       end */
    if (stat(path, &about) == 0 && !S_ISREG(about.st_mode) && !S_ISDIR(about.st_mode)) {
        return lrcsi_host_fail(error, LRCS_E_SYSTEM,
                               "%s: expected a regular file, found a device, pipe or socket", path);
    }
    int status = lrcsi_host_file_read(path, file, &about, error);
    if (status != LRCS_OK) {
        return status;
    }
    lrcs_host_input *input = lrcsi_host_take(scene, 1, sizeof *input);
    char *name = lrcsi_host_copy(scene, path, strlen(path));
    if (!input || !name) {
        lrcs_host_file_free(file);
        return lrcsi_host_fail_memory(error, sizeof *input);
    }
    uint64_t hash = lrcs_host_hash(LRCS_HOST_HASH_START, file->bytes, file->size);
    *input = (lrcs_host_input){name, hash, about.st_dev, about.st_ino, 0.0, scene->input};
    scene->input = input;
    return LRCS_OK;
}

int lrcs_host_output_check(const char *path, const lrcs_host_scene *scene, lrcs_host_error *error)
{
    struct stat about;
    if (strcmp(path, "-") == 0 || stat(path, &about) != 0) {
        return LRCS_OK;
    }
    for (const lrcs_host_input *input = scene->input; input; input = input->next) {
        if (input->device == about.st_dev && input->node == about.st_ino) {
            return lrcsi_host_fail(error, LRCS_E_ARGUMENT,
                                   "%s: would overwrite %s, which the scene is read from", path,
                                   input->path);
        }
    }
    return LRCS_OK;
}

/* The system's record of the folder that contains a path; returns 0, or -1 if there is none. */
static int folder_stat(const char *path, struct stat *about)
{
    size_t size = (size_t)(lrcsi_host_basename(path) - path);
    char *folder = malloc(size + 2);
    if (!folder) {
        return -1;
    }
    memcpy(folder, path, size);
    memcpy(folder + size, ".", 2);
    int found = stat(folder, about);
    free(folder);
    return found;
}

int lrcs_host_output_same(const char *path, const char *other)
{
    struct stat a;
    struct stat b;
    int there = stat(path, &a);
    if (strcmp(path, other) == 0) {
        return 1;
    }
    if (there != stat(other, &b)) {
        return 0;
    }
    if (there != 0) { /* neither exists: they are the same if folder and name are equal */
        if (strcmp(lrcsi_host_basename(path), lrcsi_host_basename(other)) != 0 ||
            folder_stat(path, &a) != 0 || folder_stat(other, &b) != 0) {
            return 0;
        }
    }
    return a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}
