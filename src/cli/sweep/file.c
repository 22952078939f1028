/* SPDX-License-Identifier: MIT */
/* The output file of a sweep. This file decides what is on disk at every moment: the rows in
   FILE.partial, each complete before the next, with a checksum after the last of them, and FILE
   itself only when it is complete; and what --resume does with the files that it finds. Meanwhile
   the process holds a lock on FILE.lock. */
#include "cli/sweep/sweep.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define FILE_PERIOD 0.2 /* s; at most the rows of this time are lost if the process ends */

static int path_refuse(const char *path, const char *what)
{
    return cli_fail("%s: cannot %s: %s", path, what, strerror(errno));
}

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

static void lock_drop(sweep_file *file)
{
    if (file->lock >= 0) {
        unlink(file->lock_path); /* before another process can hold it */
        close(file->lock);
    }
    file->lock = -1;
}

/* Locks FILE.lock: 0, or CLI_FAILED with a message that names the holder if another process holds
   it, by the text that it wrote. */
static int lock_take(sweep_file *file)
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
            return path_refuse(file->lock_path, "write");
        }
        locked = fcntl(file->lock, F_SETLK, &whole) == 0;
        if (!locked && (errno == EACCES || errno == EAGAIN)) {
            ssize_t read = pread(file->lock, holder, sizeof holder - 1, 0);
            holder[read > 0 ? read : 0] = '\0';
            holder[strcspn(holder, "\n")] = '\0';
            close(file->lock);
            file->lock = -1;
            return cli_fail("%s: is being written by %s: wait for its end, or stop it", file->path,
                            holder[0] ? holder : "another process");
        }
    } while (locked && !file_is_named(file->lock, file->lock_path, &held));
    gethostname(host, sizeof host - 1);
    int size = snprintf(holder, sizeof holder, "process %ld on %s\n", (long)getpid(), host);
    if (ftruncate(file->lock, 0) != 0 || pwrite(file->lock, holder, (size_t)size, 0) != size) {
        int code = path_refuse(file->lock_path, "write");
        lock_drop(file);
        return code;
    }
    return 0;
}

/* ---- options ---- */

int cli_file_read(const cli_args *args, sweep_file *file)
{
    static const char *const extension[] = {".csv", ".jsonl", ".npy"};
    const char *path = cli_value(args, "o");
    int lines = cli_value(args, "json") != NULL;
    memset(file, 0, sizeof *file);
    file->descriptor = file->lock = -1;
    file->format = lines ? LRCS_HOST_ROWS_JSONL : LRCS_HOST_ROWS_CSV;
    if (!path || strcmp(path, "-") == 0) {
        return cli_value(args, "resume")
                   ? cli_usage(args->command, "--resume needs -o FILE: it goes on with that file")
                   : 0;
    }
    if (lines) {
        return cli_usage(args->command, "--json is for standard output; -o FILE.jsonl writes it");
    }
    int found = -1;
    for (int i = 0; i < 3; i++) {
        found = cli_extension(path, extension[i]) ? i : found;
    }
    if (found < 0) {
        return cli_expected(args, "o", "FILE.csv, FILE.jsonl or FILE.npy");
    }
    file->npy = found == 2;
    file->format = found == LRCS_HOST_ROWS_JSONL ? LRCS_HOST_ROWS_JSONL : LRCS_HOST_ROWS_CSV;
    char *real = realpath(path, NULL); /* a symbolic link is kept */
    size_t room = strlen(real ? real : path) + sizeof ".partial";
    file->path = real ? real : strdup(path);
    file->partial = malloc(room);
    file->lock_path = malloc(room);
    if (!file->path || !file->partial || !file->lock_path) {
        return cli_out_of_memory();
    }
    snprintf(file->partial, room, "%s.partial", file->path);
    snprintf(file->lock_path, room, "%s.lock", file->path);
    return 0;
}

void cli_file_free(sweep_file *file)
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
static void file_take(sweep_file *file, const lrcs_host_row *row)
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

/* Opens the buffer in which rows are collected before they are written together. 0, or CLI_FAILED
   if out of memory. */
static int waiting_begin(sweep_file *file)
{
    free(file->waiting);
    file->waiting = NULL;
    file->stream = open_memstream(&file->waiting, &file->waiting_size);
    return file->stream ? 0 : cli_out_of_memory();
}

static int bytes_write(int descriptor, const char *bytes, size_t size, uint64_t at)
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
static int waiting_flush(sweep_file *file, int last, lrcs_host_error *error)
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
        good = bytes_write(file->descriptor, file->waiting, file->waiting_size, file->size) == 0;
        file->size += rows;
    } else if (good) {
        good = fwrite(file->waiting, 1, file->waiting_size, stdout) == file->waiting_size &&
               fflush(stdout) == 0;
    }
    if (!good) {
        snprintf(error->text, sizeof error->text, "%.900s: cannot write: %s",
                 file->path ? file->partial : "standard output", strerror(errno));
        return LRCS_E_SYSTEM;
    }
    if (waiting_begin(file) != 0) {
        snprintf(error->text, sizeof error->text, "out of memory");
        return LRCS_E_SYSTEM;
    }
    return LRCS_OK;
}

/* ---- what is there already ---- */

enum { OTHER_SWEEP = -1 }; /* differs from every exit code: no message has been printed yet */

/* Recovers the rows of a file that begins with the right head. Returns 0 if they end properly, in a
   checksum or in a truncated line; file->size and file->sum are then set to match; OTHER_SWEEP,
   without a message, if the file is not of this sweep and shard; CLI_FAILED, with a message, if a
   row is damaged. */
static int rows_recover(sweep_file *file, const char *path, const lrcs_host_file *there,
                        const char *head, size_t head_size, int *summed)
{
    lrcs_host_rows rows;
    lrcs_host_row row;
    lrcs_host_error error;
    const char *bytes = (const char *)there->bytes;
    if (there->size < head_size || memcmp(bytes, head, head_size) != 0 ||
        lrcs_host_rows_open(bytes, there->size, &rows) != LRCS_OK) {
        return OTHER_SWEEP;
    }
    const char *good = rows.at;
    int more;
    while ((more = lrcs_host_rows_next(&rows, file->plan, &row, &error)) == 1) {
        if (row.index >= file->end || (row.index != file->next && good == bytes + head_size)) {
            return OTHER_SWEEP; /* or of another shard */
        }
        if (row.index != file->next) {
            return cli_fail("%s: line %llu: found row %llu, expected row %llu", path,
                            (unsigned long long)rows.number - 1, (unsigned long long)row.index,
                            (unsigned long long)file->next);
        }
        file_take(file, &row);
        good = rows.at;
    }
    int end = more == 0 ? lrcs_host_rows_end(&rows, &error) : more;
    if (end < 0) {
        fprintf(stderr,
                "lrcs: %s: is damaged: %s; remove the file, or what is wrong in it and all that "
                "follows\n",
                path, error.text);
        return CLI_FAILED;
    }
    *summed = end;
    file->size = (uint64_t)(good - bytes);
    file->sum = lrcs_host_hash(LRCS_HOST_HASH_START, bytes, (size_t)(good - bytes));
    return 0;
}

/* Continues FILE.partial: whatever follows the last complete row is overwritten. */
static int partial_continue(sweep_file *file, const char *head, size_t head_size)
{
    lrcs_host_error error;
    lrcs_host_file there = {NULL, 0};
    int summed;
    if (lrcs_host_file_read(file->partial, &there, &error) != LRCS_OK) {
        return cli_failed(&error);
    }
    int torn = there.size < head_size && memcmp(there.bytes, head, there.size) == 0;
    int code = torn ? 0 : rows_recover(file, file->partial, &there, head, head_size, &summed);
    lrcs_host_file_free(&there);
    if (code == OTHER_SWEEP) {
        return cli_fail("%s: is of another sweep (scene, options, shard or version): remove it, or "
                        "give the same",
                        file->partial);
    }
    if (code != 0) {
        return code;
    }
    file->descriptor = open(file->partial, O_WRONLY | O_CLOEXEC);
    if (file->descriptor < 0 || ftruncate(file->descriptor, (off_t)file->size) != 0) {
        return path_refuse(file->partial, "continue");
    }
    if (torn) {
        fwrite(head, 1, head_size, file->stream);
    }
    return 0;
}

/* Adds the rows of FILE.npy if FILE.npy.head begins with one of these heads and has the map's
   checksum. 0, or OTHER_SWEEP with nothing added. */
static int map_recover(sweep_file *file, const char *const head[2], const size_t size[2])
{
    lrcs_host_sweep_map map;
    int same = lrcs_host_sweep_map_open(file->path, &map) == LRCS_OK;
    /* the rows of a merged map may have had either format */
    same = same && map.rows.head_size == size[map.rows.format] &&
           memcmp(map.rows.head, head[map.rows.format], map.rows.head_size) == 0;
    for (uint64_t i = 0; same && i < file->plan->rows; i++) {
        lrcs_host_row row;
        lrcs_host_sweep_map_row(&map, i, &row);
        file_take(file, &row);
    }
    if (same) {
        memcpy(file->tally.count, map.tally.count, sizeof map.tally.count);
    }
    lrcs_host_sweep_map_close(&map);
    return same ? 0 : OTHER_SWEEP;
}

/* FILE exists, and --resume never replaces it: 0 if it is complete and belongs to this very sweep,
   with its rows recovered; else CLI_FAILED. */
static int whole_recover(sweep_file *file, const char *const head[2], const size_t size[2])
{
    lrcs_host_error error;
    lrcs_host_file there;
    int summed = file->npy;
    int code;
    if (file->npy) {
        code = map_recover(file, head, size);
    } else if (lrcs_host_file_read(file->path, &there, &error) != LRCS_OK) {
        return cli_failed(&error);
    } else {
        code =
            rows_recover(file, file->path, &there, head[file->format], size[file->format], &summed);
        lrcs_host_file_free(&there);
    }
    if (code == OTHER_SWEEP) {
        return cli_fail("%s: is not of this sweep (scene, options, shard or version)%s: --resume "
                        "replaces no whole file: remove it, or give another name",
                        file->path, file->npy ? ", or is not what its .head says" : "");
    }
    if (code == 0 && (!summed || file->next != file->end)) {
        return cli_fail("%s: is damaged: it holds %llu of %llu rows%s: remove it", file->path,
                        (unsigned long long)(file->next - file->first),
                        (unsigned long long)(file->end - file->first),
                        summed ? "" : " and no checksum");
    }
    return code;
}

int cli_file_open(const cli_args *args, sweep_file *file)
{
    struct stat about;
    char *text[2] = {NULL, NULL};
    size_t size[2] = {0, 0};
    int resume = cli_value(args, "resume") != NULL;
    file->next = file->first;
    file->sum = LRCS_HOST_HASH_START;
    int code = waiting_begin(file);
    if (code == 0 && !file->path) {
        lrcs_host_rows_head_write(file->stream, file->format, file->head, file->plan);
        return 0;
    }
    code = code ? code : lock_take(file);
    for (int i = 0; i < 2 && code == 0; i++) { /* by format */
        FILE *out = open_memstream(&text[i], &size[i]);
        if (out) {
            lrcs_host_rows_head_write(out, i, file->head, file->plan);
        }
        code = out && fclose(out) == 0 ? 0 : cli_out_of_memory();
    }
    if (code != 0 || !text[0] || !text[1]) {
        code = CLI_FAILED; /* already reported */
    } else if (resume && stat(file->path, &about) == 0) {
        code = whole_recover(file, (const char *const *)text, size);
    } else if (resume && stat(file->partial, &about) == 0) {
        code = partial_continue(file, text[file->format], size[file->format]);
    } else { /* an existing FILE.partial is never overwritten: it may contain hours of work */
        file->descriptor = open(file->partial, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file->descriptor >= 0) {
            fwrite(text[file->format], 1, size[file->format], file->stream);
        } else if (errno == EEXIST) {
            code = cli_fail("%s: is there from a sweep that was stopped: --resume goes on with "
                            "it; or remove it",
                            file->partial);
        } else {
            code = path_refuse(file->partial, "write");
        }
    }
    free(text[0]);
    free(text[1]);
    return code;
}

/* ---- rows, and the end ---- */

int cli_file_put(sweep_file *file, const lrcs_host_row *row, lrcs_host_error *error)
{
    lrcs_host_row_write(file->stream, file->format, &file->head->fields, file->plan, row);
    file_take(file, row);
    double now = cli_seconds();
    if (now - file->flushed < FILE_PERIOD) {
        return LRCS_OK;
    }
    file->flushed = now;
    return waiting_flush(file, 0, error);
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
        snprintf(error->text, sizeof error->text, "the rows of the map were changed: %.900s",
                 fault.text);
        return LRCS_E_SYNTAX;
    }
    return more;
}

static int map_make(const sweep_file *file)
{
    lrcs_host_error error;
    lrcs_host_file bytes;
    map_rows from = {.plan = file->plan};
    int status = lrcs_host_file_read(file->partial, &bytes, &error);
    if (status != LRCS_OK) {
        return cli_failed(&error);
    }
    status = lrcs_host_rows_open((const char *)bytes.bytes, bytes.size, &from.rows);
    if (status == LRCS_OK) {
        const lrcs_host_rows head = from.rows;
        status = lrcs_host_sweep_map_write(file->path, &head, map_next, &from, &error);
    } else {
        snprintf(error.text, sizeof error.text, "%.900s: %s", file->partial,
                 lrcs_status_text(status));
    }
    lrcs_host_file_free(&bytes);
    return status != LRCS_OK            ? cli_failed(&error)
           : remove(file->partial) == 0 ? 0
                                        : path_refuse(file->partial, "remove");
}

int cli_file_close(sweep_file *file, int all)
{
    lrcs_host_error error;
    struct stat held;
    int whole = file->path && file->descriptor < 0; /* FILE already existed */
    if (!file->stream || whole) {
        return 0;
    }
    if (all && lrcs_host_plan_is_sphere(file->plan) && file->tally.rows == file->plan->rows) {
        lrcs_host_rows_mean_write(file->stream, file->format, &file->tally);
    }
    if (waiting_flush(file, all, &error) != LRCS_OK) {
        return file->path ? cli_failed(&error) : 0; /* cli_finish checks standard output */
    }
    if (!file->path) {
        return 0;
    }
    if (!all && file->next == file->first) {
        return remove(file->partial) == 0 ? 0 : path_refuse(file->partial, "remove");
    }
    /* FILE.partial must still be the file that this process wrote, with a size that fits */
    int ours = file_is_named(file->descriptor, file->partial, &held) &&
               (uint64_t)held.st_size > file->size && (uint64_t)held.st_size <= file->size + 64;
    int closed = close(file->descriptor);
    file->descriptor = -1;
    if (closed != 0) {
        return path_refuse(file->partial, "write");
    }
    if (!ours) {
        return cli_fail("%s: was changed or removed by another program while it was written: it "
                        "does not become %s",
                        file->partial, file->path);
    }
    if (all && file->npy) {
        return map_make(file);
    }
    return !all || rename(file->partial, file->path) == 0 ? 0 : path_refuse(file->path, "write");
}
