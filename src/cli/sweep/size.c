/* SPDX-License-Identifier: MIT */
/* How large a sweep is: what it needs of memory and disk, how long it takes, and which file it
   replaces. A sweep that cannot fit is refused before the work; one that takes long says so after
   its first seconds. */
#include "cli/sweep/sweep.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#define SIZE_READ  ((double)(UINT64_C(1) << 34)) /* bytes; larger files are not read back */
#define SIZE_HEAD  65536u                        /* bytes; the first lines are shorter */
#define PACE_AFTER 2.0                           /* s */
#define PACE_LONG  600.0                         /* s */
#define PACE_TEXT  32
#define FIELDS_ALL 5u /* of every row: sigma, dBsm, bound, glint and diffuse part */

/* A size in GB or TB. */
static const char *size_text(double bytes, char text[PACE_TEXT])
{
    snprintf(text, PACE_TEXT, "%.3g %s", bytes * (bytes < 1e12 ? 1e-9 : 1e-12),
             bytes < 1e12 ? "GB" : "TB");
    return text;
}

/* A time in minutes, hours, days or years. */
static const char *time_text(double seconds, char text[PACE_TEXT])
{
    static const struct {
        double unit;
        const char *name;
    } in[] = {{60.0, "minutes"}, {3600.0, "hours"}, {86400.0, "days"}, {31557600.0, "years"}};
    int i = 0;
    while (i < 3 && seconds >= 2.0 * in[i + 1].unit) {
        i++;
    }
    snprintf(text, PACE_TEXT, "%.0f %s", seconds / in[i].unit, in[i].name);
    return text;
}

int cli_size_check(const cli_args *args, const lrcs_host_plan *plan,
                   const lrcs_host_sweep_output *file, int kept)
{
    char need[PACE_TEXT];
    char there[PACE_TEXT];
    struct statvfs disk;
    struct stat partial;
    const double rows = (double)(file->end - file->first);
    const double memory = 2.0 * sizeof(double) * (double)plan->rows;
    const double machine = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    if (kept && machine > 0.0 && memory > machine) {
        return cli_fail("%llu rows: --plot, --stats and --brightest keep 16 bytes of each, %s in "
                        "all; this machine has %s of memory",
                        (unsigned long long)plan->rows, size_text(memory, need),
                        size_text(machine, there));
    }
    /* each number and the comma after it take at least two bytes, dBsm may be empty */
    const double least = rows * (2.0 * (1.0 + plan->columns + FIELDS_ALL) - 1.0);
    char folder[4096] = ".";
    const char *slash = file->path ? strrchr(file->path, '/') : NULL;
    if (slash && (size_t)(slash - file->path) + 2 < sizeof folder) {
        snprintf(folder, sizeof folder, "%.*s/", (int)(slash - file->path), file->path);
    }
    int there_already = cli_value(args, "resume") && file->path && access(file->path, F_OK) == 0;
    if (file->path && !there_already && statvfs(folder, &disk) == 0) {
        double left = (double)disk.f_bavail * (double)disk.f_frsize;
        left += stat(file->partial, &partial) == 0 ? (double)partial.st_size : 0.0;
        if (least > left) {
            return cli_fail("%s: %.0f rows take at least %s, and its disk has %s left: sweep fewer "
                            "rows, or divide them by --shard",
                            cli_value(args, "o"), rows, size_text(least, need),
                            size_text(left, there));
        }
    }
    return 0;
}

void cli_replaced_print(const cli_args *args, const lrcs_host_sweep_output *file)
{
    lrcs_host_rows rows;
    char path[4096];
    snprintf(path, sizeof path, "%s%s", file->path, file->npy ? ".head" : "");
    if (access(file->path, F_OK) != 0) {
        return;
    }
    FILE *in = fopen(path, "rb");
    char *head = malloc(SIZE_HEAD);
    size_t size = in && head ? fread(head, 1, SIZE_HEAD, in) : 0;
    cli_watch_clear();
    fprintf(stderr, "notice: %s exists", cli_value(args, "o"));
    if (size > 0 && lrcs_host_rows_open(head, size, &rows) == LRCS_OK) {
        fprintf(stderr, ", of a sweep of %llu rows", (unsigned long long)rows.rows);
    }
    fputs(", and is replaced when this sweep is complete (--resume never replaces it)\n", stderr);
    free(head);
    if (in) {
        fclose(in);
    }
}

int cli_pace_take(cli_pace *pace, const lrcs_host_sweep_output *file, const cli_progress *progress,
                  lrcs_host_error *error)
{
    char size[PACE_TEXT];
    const double seconds = pace->said ? 0.0 : cli_seconds() - pace->begun;
    if (seconds < PACE_AFTER || file->next == pace->first || (file->path && file->size == 0)) {
        return LRCS_OK;
    }
    pace->said = 1;
    const double rows = (double)(file->end - file->first);
    const double to_go = (double)(file->end - file->next);
    const double time = seconds * to_go / (double)(file->next - pace->first);
    /* the rows of the last moments are not yet in file->size */
    const double bytes =
        file->path ? (double)file->size * rows / (double)(file->next - file->first) : 0.0;
    size_text(bytes, size);
    if (file->npy && bytes > SIZE_READ) {
        pace->too_large = 1;
        snprintf(error->text, sizeof error->text,
                 "%s: %.0f rows will take some %s on their way to the map, and at most 17.1 GB are "
                 "read back: divide the sweep by --shard",
                 file->path, rows, size);
        return LRCS_E_LIMIT;
    }
    if (time > PACE_LONG || bytes > SIZE_READ) {
        char left[PACE_TEXT];
        cli_progress_clear(progress);
        fprintf(stderr, "notice: %.0f rows to go take some %s at the rate of the first seconds",
                to_go, time_text(time, left));
        if (file->path) {
            fprintf(stderr, ", and the file becomes some %s", size);
        }
        fputs(bytes > SIZE_READ ? "; a file above 17.1 GB is not read back: --shard divides it\n"
                                : "\n",
              stderr);
    }
    return LRCS_OK;
}
