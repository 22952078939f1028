/* SPDX-License-Identifier: MIT */
/* Whole files in, whole files out. A file is read once, up to a limit. An output gets its name only
   when it is complete; nothing is synced to disk. */
#include "host/files/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/fnv.h"

/* Far above the size of any sensible mesh of 2^32 facets; a guard against /dev/zero. */
#define FILE_SIZE_MAX ((size_t)1 << 34)

/* Reads to the end into a growing buffer, whose first size is that of the file if it is known. */
static int file_fill(FILE *stream, size_t guess, const char *path, lrcs_host_file *file,
                     lrcs_host_error *error)
{
    size_t room = guess + 1;
    unsigned char *bytes = malloc(room);
    size_t used = 0;
    while (bytes) {
        used += fread(bytes + used, 1, room - used, stream);
        if (used < room) {
            break;
        }
        if (room > FILE_SIZE_MAX) {
            free(bytes);
            return lrcsi_host_fail(error, LRCS_E_LIMIT, "%s: larger than %zu bytes", path,
                                   FILE_SIZE_MAX);
        }
        room *= 2;
        unsigned char *grown = realloc(bytes, room);
        if (!grown) {
            free(bytes);
        }
        bytes = grown;
    }
    if (!bytes) {
        return lrcsi_host_fail(error, LRCS_E_SYSTEM, "%s: out of memory: no room for %zu bytes",
                               path, room);
    }
    if (ferror(stream)) {
        free(bytes);
        return lrcsi_host_fail_file(error, path, "read");
    }
    *file = (lrcs_host_file){bytes, used};
    return LRCS_OK;
}

int lrcsi_host_file_read(const char *path, lrcs_host_file *file, struct stat *about,
                         lrcs_host_error *error)
{
    FILE *stream = fopen(path, "rb");
    if (!stream) {
        return lrcsi_host_fail_file(error, path, "open");
    }
    int status = LRCS_OK;
    if (fstat(fileno(stream), about) != 0) {
        status = lrcsi_host_fail_file(error, path, "read");
    } else if (S_ISDIR(about->st_mode)) {
        errno = EISDIR;
        status = lrcsi_host_fail_file(error, path, "read");
    } else if (S_ISREG(about->st_mode) && (uint64_t)about->st_size > FILE_SIZE_MAX) {
        status =
            lrcsi_host_fail(error, LRCS_E_LIMIT, "%s: larger than %zu bytes", path, FILE_SIZE_MAX);
    } else {
        size_t guess = S_ISREG(about->st_mode) ? (size_t)about->st_size : 4096;
        status = file_fill(stream, guess, path, file, error);
    }
    fclose(stream);
    return status;
}

int lrcs_host_file_read(const char *path, lrcs_host_file *file, lrcs_host_error *error)
{
    struct stat about;
    return lrcsi_host_file_read(path, file, &about, error);
}

void lrcs_host_file_free(lrcs_host_file *file)
{
    free(file->bytes);
    *file = (lrcs_host_file){NULL, 0};
}

/* "FOLDER/.lrcs-PID-TRY.tmp" beside the path, created here exclusively. */
static int temporary_open(lrcs_host_output *output)
{
    const char *slash = strrchr(output->path, '/');
    size_t folder = slash ? (size_t)(slash - output->path) + 1 : 0;
    size_t room = folder + 64;
    output->temporary = malloc(room);
    if (!output->temporary) {
        return -1;
    }
    for (int i = 0; i < 1000; i++) {
        snprintf(output->temporary, room, "%.*s.lrcs-%ld-%d.tmp", (int)folder, output->path,
                 (long)getpid(), i);
        int descriptor = open(output->temporary, O_WRONLY | O_CREAT | O_EXCL, 0666);
        if (descriptor >= 0 || errno != EEXIST) {
            return descriptor;
        }
    }
    return -1;
}

static int output_refuse(lrcs_host_output *output, const char *path, lrcs_host_error *error)
{
    int status = lrcsi_host_fail_file(error, path, "write");
    free(output->path);
    free(output->temporary);
    *output = (lrcs_host_output){NULL, NULL, NULL};
    return status;
}

int lrcs_host_output_open(const char *path, lrcs_host_output *output, lrcs_host_error *error)
{
    *output = (lrcs_host_output){NULL, NULL, NULL};
    if (strcmp(path, "-") == 0) {
        output->stream = stdout;
        return LRCS_OK;
    }
    struct stat about;
    int there = stat(path, &about) == 0;
    if (there && S_ISDIR(about.st_mode)) {
        errno = EISDIR;
        return output_refuse(output, path, error);
    }
    output->path = there ? realpath(path, NULL) : strdup(path);
    if (!output->path) {
        return output_refuse(output, path, error);
    }
    int descriptor =
        there && !S_ISREG(about.st_mode) ? open(output->path, O_WRONLY) : temporary_open(output);
    output->stream = descriptor >= 0 ? fdopen(descriptor, "wb") : NULL;
    if (!output->stream) {
        int cause = errno;
        if (descriptor >= 0) { /* nothing was written */
            close(descriptor);
            if (output->temporary) {
                remove(output->temporary);
            }
        }
        errno = cause;
        return output_refuse(output, path, error);
    }
    return LRCS_OK;
}

int lrcs_host_output_close(lrcs_host_output *output, int keep, lrcs_host_error *error)
{
    FILE *stream = output->stream;
    const char *name = output->path ? output->path : "standard output";
    int status = LRCS_OK;
    errno = 0;
    if (!stream) {
        return LRCS_OK;
    }
    if (keep && (fflush(stream) != 0 || ferror(stream))) {
        status = lrcsi_host_fail_file(error, name, "write");
    }
    if (stream != stdout && fclose(stream) != 0 && keep && status == LRCS_OK) {
        status = lrcsi_host_fail_file(error, name, "write");
    }
    if (output->temporary && keep && status == LRCS_OK &&
        rename(output->temporary, output->path) != 0) {
        status = lrcsi_host_fail_file(error, name, "write");
    }
    if (output->temporary && (!keep || status != LRCS_OK)) {
        remove(output->temporary);
    }
    free(output->path);
    free(output->temporary);
    *output = (lrcs_host_output){NULL, NULL, NULL};
    return status;
}

int lrcsi_host_output_end(lrcs_host_output *output, int status, lrcs_host_error *error)
{
    if (status == LRCS_OK) {
        return lrcs_host_output_close(output, 1, error);
    }
    lrcs_host_output_close(output, 0, NULL);
    return status;
}

uint64_t lrcs_host_hash(uint64_t hash, const void *bytes, size_t size)
{
    const unsigned char *at = bytes;
    for (size_t i = 0; i < size; i++) {
        hash = lrcsi_fnv_byte(hash, at[i]);
    }
    return hash;
}
