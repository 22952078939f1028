/* SPDX-License-Identifier: MIT */
/* The output of a sweep that is being computed. This file decides what is on disk at every moment:
   the rows in FILE.partial, each complete before the next, with a checksum after the last of them,
   and FILE itself only when it is complete; and what a sweep that is resumed does with the files
   that it finds. Meanwhile the process holds a lock on FILE.lock. */
#include <lrcs/sweep_file.h>

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "host/fail.h"
#include "host/run/memory.h"

#define FILE_PERIOD 0.2 /* s; at most the rows of this time are lost if the process ends */

/* ---- the lock ---- */

/* Only one sweep at a time writes a file. The lock is a POSIX lock (fcntl) on FILE.lock, which
   names its holder; it ends with its process, so that a file left by a crash locks nothing. If the
   file system does not support locks, there is none. */

/* 1 if a path names the file that was opened, whose properties are returned. */
static int file_is_named(int descriptor, const char *path, struct stat *held)
{
    struct stat named;
    return fstat(descriptor, held) == 0 && stat(path, &named) == 0 &&
           held->st_dev == named.st_dev && held->st_ino == named.st_ino;
}

static void lock_drop(lrcs_host_sweep_output *file)
{
    if (file->lock >= 0) {
        unlink(file->lock_path); /* before another process can hold it */
        close(file->lock);
    }
    file->lock = -1;
}

/* Locks FILE.lock. If another process holds it, the sentence names it by the text that it wrote. */
static int lock_take(lrcs_host_sweep_output *file, lrcs_host_error *error)
{
    struct flock whole = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    struct stat held;
    char holder[300];
    char host[256] = "";
    int locked;
    do {
        if (file->lock >= 0) {
            close(file->lock); /* its last holder has removed it: another file has its name */
        }
        file->lock = open(file->lock_path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (file->lock < 0) {
            return lrcsi_host_fail_file(error, file->lock_path, "write");
        }
        locked = fcntl(file->lock, F_SETLK, &whole) == 0;
        if (!locked && (errno == EACCES || errno == EAGAIN)) {
            ssize_t read = pread(file->lock, holder, sizeof holder - 1, 0);
            holder[read > 0 ? read : 0] = '\0';
            holder[strcspn(holder, "\n")] = '\0';
            close(file->lock);
            file->lock = -1;
            return lrcsi_host_fail(error, LRCS_E_SYSTEM,
                                   "%s: is being written by %s: wait until it ends, or stop it",
                                   file->path, holder[0] ? holder : "another process");
        }
    } while (locked && !file_is_named(file->lock, file->lock_path, &held));
    gethostname(host, sizeof host - 1);
    int size = snprintf(holder, sizeof holder, "process %ld on %s\n", (long)getpid(), host);
    if (ftruncate(file->lock, 0) != 0 || pwrite(file->lock, holder, (size_t)size, 0) != size) {
        int status = lrcsi_host_fail_file(error, file->lock_path, "write");
        lock_drop(file);
        return status;
    }
    return LRCS_OK;
}

/* ---- begin and end ---- */

int lrcs_host_sweep_output_make(const char *path, int format, int npy, lrcs_host_sweep_output *file,
                                lrcs_host_error *error)
{
    memset(file, 0, sizeof *file);
    file->descriptor = file->lock = -1;
    file->format = format;
    file->npy = npy;
    if (!path) {
        return LRCS_OK;
    }
    char *real = realpath(path, NULL); /* a symbolic link is kept */
    size_t room = strlen(real ? real : path) + sizeof ".partial";
    file->path = real ? real : strdup(path);
    file->partial = malloc(room);
    file->lock_path = malloc(room);
    if (!file->path || !file->partial || !file->lock_path) {
        return lrcsi_host_out_of_memory(error);
    }
    snprintf(file->partial, room, "%s.partial", file->path);
    snprintf(file->lock_path, room, "%s.lock", file->path);
    return LRCS_OK;
}

void lrcs_host_sweep_output_free(lrcs_host_sweep_output *file)
{
    if (file->stream) {
        fclose(file->stream);
    }
    if (file->path && file->descriptor >= 0) {
        close(file->descriptor);
    }
    if (file->path) {
        lock_drop(file);
    }
    free(file->waiting);
    free(file->path);
    free(file->partial);
    free(file->lock_path);
    memset(file, 0, sizeof *file);
    file->descriptor = file->lock = -1;
}

/* Adds a row that is in the file, now or from before, to the statistics. */
static void file_row_add(lrcs_host_sweep_output *file, const lrcs_host_row *row)
{
    lrcs_host_tally_add(&file->tally, row);
    if (file->row) {
        file->row[row->index][0] = row->field[LRCS_HOST_ROW_SIGMA];
        file->row[row->index][1] = row->field[LRCS_HOST_ROW_BOUND];
    }
    if (file->band) {
        file->band[row->index][0] = row->field[LRCS_HOST_ROW_LOW];
        file->band[row->index][1] = row->field[LRCS_HOST_ROW_HIGH];
    }
    file->next++;
}

/* ---- bytes on their way ---- */

/* Opens the buffer in which rows are collected before they are written together. */
static int buffer_begin(lrcs_host_sweep_output *file, lrcs_host_error *error)
{
    free(file->waiting);
    file->waiting = NULL;
    file->stream = open_memstream(&file->waiting, &file->waiting_size);
    return file->stream ? LRCS_OK : lrcsi_host_out_of_memory(error);
}

static int bytes_write_at(int descriptor, const char *bytes, size_t size, uint64_t at)
{
    while (size > 0) {
        ssize_t done = pwrite(descriptor, bytes, size, (off_t)at);
        if (done < 0 && errno != EINTR) {
            return -1;
        }
        bytes += done > 0 ? done : 0;
        size -= done > 0 ? (size_t)done : 0;
        at += done > 0 ? (uint64_t)done : 0;
    }
    return 0;
}

/* Writes the buffered rows: to standard output, with the checksum if `last`; or to the file,
   followed by the checksum of all rows so far, in one write, which overwrites the previous
   checksum. The checksum is never longer than what overwrites it. Status: LRCS_OK;
   LRCS_E_SYSTEM. */
static int buffer_flush(lrcs_host_sweep_output *file, int last, lrcs_host_error *error)
{
    fflush(file->stream);
    size_t rows = file->waiting_size;
    file->sum = lrcs_host_hash(file->sum, file->waiting, rows);
    if (file->path || last) {
        lrcs_host_rows_sum_write(file->stream, file->format, file->sum);
    }
    int good = !ferror(file->stream) && fclose(file->stream) == 0;
    file->stream = NULL;
    if (good && file->path) {
        good = bytes_write_at(file->descriptor, file->waiting, file->waiting_size, file->size) == 0;
        file->size += rows;
    } else if (good) {
        good = fwrite(file->waiting, 1, file->waiting_size, stdout) == file->waiting_size &&
               fflush(stdout) == 0;
    }
    return good ? buffer_begin(file, error)
                : lrcsi_host_fail_file(error, file->path ? file->partial : "standard output",
                                       "write");
}

/* ---- what is there already ---- */

/* Recovers the rows of a file that begins with the right head. Returned: same, 0 if the file is not
   of this sweep and shard, which is no failure yet; summed, whether a checksum follows the rows, or
   they end in a truncated line. file->size and file->sum are set to match.
   Status: LRCS_OK; LRCS_E_SYNTAX (a row is damaged). */
static int rows_recover(lrcs_host_sweep_output *file, const char *path,
                        const lrcs_host_file *existing, const char *head, size_t head_size,
                        int *same, int *summed, lrcs_host_error *error)
{
    lrcs_host_rows rows;
    lrcs_host_row row;
    lrcs_host_error fault;
    const char *bytes = (const char *)existing->bytes;
    *same = existing->size >= head_size && memcmp(bytes, head, head_size) == 0 &&
            lrcs_host_rows_open(bytes, existing->size, &rows) == LRCS_OK;
    if (!*same) {
        return LRCS_OK;
    }
    const char *good = rows.at;
    int more;
    while ((more = lrcs_host_rows_next(&rows, file->plan, &row, &fault)) == 1) {
        if (row.index >= file->end || (row.index != file->next && good == bytes + head_size)) {
            *same = 0; /* or of another shard */
            return LRCS_OK;
        }
        if (row.index != file->next) {
            return lrcsi_host_fail(error, LRCS_E_SYNTAX,
                                   "%s: line %llu: found row %llu, expected row %llu", path,
                                   (unsigned long long)rows.number - 1,
                                   (unsigned long long)row.index, (unsigned long long)file->next);
        }
        file_row_add(file, &row);
        good = rows.at;
    }
    int end = more == 0 ? lrcs_host_rows_end(&rows, &fault) : more;
    if (end < 0) {
        return lrcsi_host_fail(
            error, LRCS_E_SYNTAX,
            "%s: is damaged: %s; remove the file, or what is wrong in it and all "
            "that follows",
            path, fault.text);
    }
    *summed = end;
    file->size = (uint64_t)(good - bytes);
    file->sum = lrcs_host_hash(LRCS_HOST_HASH_START, bytes, (size_t)(good - bytes));
    return LRCS_OK;
}

/* Continues FILE.partial: whatever follows the last complete row is overwritten. */
static int partial_continue(lrcs_host_sweep_output *file, const char *head, size_t head_size,
                            lrcs_host_error *error)
{
    lrcs_host_file existing = {NULL, 0};
    int summed;
    int same = 1;
    int status = lrcs_host_file_read(file->partial, &existing, error);
    if (status != LRCS_OK) {
        return status;
    }
    int torn = existing.size < head_size && memcmp(existing.bytes, head, existing.size) == 0;
    if (!torn) {
        status =
            rows_recover(file, file->partial, &existing, head, head_size, &same, &summed, error);
    }
    lrcs_host_file_free(&existing);
    if (status == LRCS_OK && !same) {
        return lrcsi_host_fail(error, LRCS_E_SYNTAX,
                               "%s: belongs to another sweep (scene, options, shard or version): "
                               "remove it, or give the same ones",
                               file->partial);
    }
    if (status != LRCS_OK) {
        return status;
    }
    file->descriptor = open(file->partial, O_WRONLY | O_CLOEXEC);
    if (file->descriptor < 0 || ftruncate(file->descriptor, (off_t)file->size) != 0) {
        return lrcsi_host_fail_file(error, file->partial, "continue");
    }
    if (torn) {
        fwrite(head, 1, head_size, file->stream);
    }
    return LRCS_OK;
}

/* Adds the rows of FILE.npy if FILE.npy.head begins with one of these heads and has the map's
   checksum: 1; else nothing is added: 0. */
static int map_recover(lrcs_host_sweep_output *file, char *const head[2], const size_t size[2])
{
    lrcs_host_sweep_map map;
    int same = lrcs_host_sweep_map_open(file->path, &map) == LRCS_OK;
    /* the rows of a merged map may have had either format */
    same = same && map.rows.head_size == size[map.rows.format] &&
           memcmp(map.rows.head, head[map.rows.format], map.rows.head_size) == 0;
    for (uint64_t i = 0; same && i < file->plan->rows; i++) {
        lrcs_host_row row;
        lrcs_host_sweep_map_row(&map, i, &row);
        file_row_add(file, &row);
    }
    if (same) {
        memcpy(file->tally.count, map.tally.count, sizeof map.tally.count);
    }
    lrcs_host_sweep_map_close(&map);
    return same;
}

/* Recovers the rows of FILE, which exists and is never replaced by a sweep that is resumed. LRCS_OK
   if it is complete and belongs to this very sweep. */
static int complete_recover(lrcs_host_sweep_output *file, char *const head[2], const size_t size[2],
                            lrcs_host_error *error)
{
    lrcs_host_file existing;
    int summed = file->npy;
    int status = LRCS_OK;
    int same;
    if (file->npy) {
        same = map_recover(file, head, size);
    } else {
        status = lrcs_host_file_read(file->path, &existing, error);
        if (status != LRCS_OK) {
            return status;
        }
        status = rows_recover(file, file->path, &existing, head[file->format], size[file->format],
                              &same, &summed, error);
        lrcs_host_file_free(&existing);
    }
    if (status == LRCS_OK && !same) {
        return lrcsi_host_fail(
            error, LRCS_E_SYNTAX,
            "%s: is not a file of this sweep (scene, options, shard or version)%s; "
            "--resume does not replace a complete file: remove it, or give "
            "another name",
            file->path, file->npy ? ", or differs from its .head" : "");
    }
    if (status == LRCS_OK && (!summed || file->next != file->end)) {
        return lrcsi_host_fail(
            error, LRCS_E_TRUNCATED, "%s: is damaged: it holds %llu of %llu rows%s: remove it",
            file->path, (unsigned long long)(file->next - file->first),
            (unsigned long long)(file->end - file->first), summed ? "" : " and no checksum");
    }
    return status;
}

int lrcs_host_sweep_output_open(lrcs_host_sweep_output *file, int resume, lrcs_host_error *error)
{
    struct stat about;
    char *text[2] = {NULL, NULL};
    size_t size[2] = {0, 0};
    file->next = file->first;
    file->sum = LRCS_HOST_HASH_START;
    int status = buffer_begin(file, error);
    if (status == LRCS_OK && !file->path) {
        lrcs_host_rows_head_write(file->stream, file->format, file->head, file->plan);
        return LRCS_OK;
    }
    status = status == LRCS_OK ? lock_take(file, error) : status;
    for (int i = 0; i < 2 && status == LRCS_OK; i++) { /* by format */
        FILE *out = open_memstream(&text[i], &size[i]);
        if (out) {
            lrcs_host_rows_head_write(out, i, file->head, file->plan);
        }
        status = out && fclose(out) == 0 ? LRCS_OK : lrcsi_host_out_of_memory(error);
    }
    if (status != LRCS_OK) {
        free(text[0]);
        free(text[1]);
        return status;
    }
    if (resume && stat(file->path, &about) == 0) {
        status = complete_recover(file, text, size, error);
    } else if (resume && stat(file->partial, &about) == 0) {
        status = partial_continue(file, text[file->format], size[file->format], error);
    } else { /* an existing FILE.partial is never overwritten: it may contain hours of work */
        file->descriptor = open(file->partial, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file->descriptor >= 0) {
            fwrite(text[file->format], 1, size[file->format], file->stream);
        } else if (errno == EEXIST) {
            status = lrcsi_host_fail(error, LRCS_E_SYSTEM,
                                     "%s: exists from a sweep that was stopped: --resume continues "
                                     "it; or remove it",
                                     file->partial);
        } else {
            status = lrcsi_host_fail_file(error, file->partial, "write");
        }
    }
    free(text[0]);
    free(text[1]);
    return status;
}

/* ---- rows, and the end ---- */

int lrcs_host_sweep_output_put(lrcs_host_sweep_output *file, const lrcs_host_row *row,
                               lrcs_host_error *error)
{
    lrcs_host_row_write(file->stream, file->format, &file->head->fields, file->plan, row);
    file_row_add(file, row);
    double now = lrcsi_host_seconds();
    if (now - file->flushed < FILE_PERIOD) {
        return LRCS_OK;
    }
    file->flushed = now;
    return buffer_flush(file, 0, error);
}

/* Reads the rows of FILE.npy.partial once more. */
typedef struct map_rows {
    const lrcs_host_plan *plan;
    lrcs_host_rows rows;
} map_rows;

static int map_next(void *context, lrcs_host_row *row, lrcs_host_error *error)
{
    map_rows *from = context;
    lrcs_host_error fault = {"no checksum"};
    int more = lrcs_host_rows_next(&from->rows, from->plan, row, &fault);
    if (more < 0 || (more == 0 && lrcs_host_rows_end(&from->rows, &fault) != 1)) {
        return lrcsi_host_fail(error, LRCS_E_SYNTAX, "the rows of the map were changed: %s",
                               fault.text);
    }
    return more;
}

static int map_make(const lrcs_host_sweep_output *file, lrcs_host_error *error)
{
    lrcs_host_file bytes;
    map_rows from = {.plan = file->plan};
    int status = lrcs_host_file_read(file->partial, &bytes, error);
    if (status != LRCS_OK) {
        return status;
    }
    status = lrcs_host_rows_open((const char *)bytes.bytes, bytes.size, &from.rows);
    if (status == LRCS_OK) {
        const lrcs_host_rows head = from.rows;
        status = lrcs_host_sweep_map_write(file->path, &head, map_next, &from, error);
    } else {
        lrcsi_host_fail(error, status, "%s: %s", file->partial, lrcs_status_text(status));
    }
    lrcs_host_file_free(&bytes);
    return status != LRCS_OK || remove(file->partial) == 0
               ? status
               : lrcsi_host_fail_file(error, file->partial, "remove");
}

int lrcs_host_sweep_output_close(lrcs_host_sweep_output *file, int all, lrcs_host_error *error)
{
    struct stat held;
    int whole = file->path && file->descriptor < 0; /* FILE already existed */
    if (!file->stream || whole) {
        return LRCS_OK;
    }
    if (all && lrcs_host_plan_is_sphere(file->plan) && file->tally.rows == file->plan->rows) {
        lrcs_host_rows_mean_write(file->stream, file->format, &file->tally);
    }
    int status = buffer_flush(file, all, error);
    if (status != LRCS_OK || !file->path) {
        return status;
    }
    if (!all && file->next == file->first) {
        return remove(file->partial) == 0 ? LRCS_OK
                                          : lrcsi_host_fail_file(error, file->partial, "remove");
    }
    /* FILE.partial must still be the file that this process wrote, with a size that fits */
    int ours = file_is_named(file->descriptor, file->partial, &held) &&
               (uint64_t)held.st_size > file->size && (uint64_t)held.st_size <= file->size + 64;
    int closed = close(file->descriptor);
    file->descriptor = -1;
    if (closed != 0) {
        return lrcsi_host_fail_file(error, file->partial, "write");
    }
    if (!ours) {
        return lrcsi_host_fail(
            error, LRCS_E_SYSTEM,
            "%s: was changed or removed by another program while it was written, so that it is not "
            "renamed to %s",
            file->partial, file->path);
    }
    if (all && file->npy) {
        return map_make(file, error);
    }
    return !all || rename(file->partial, file->path) == 0
               ? LRCS_OK
               : lrcsi_host_fail_file(error, file->path, "write");
}
