/* SPDX-License-Identifier: MIT */
/* How the benchmarks measure: processor times, which on one thread equal wall-clock times if no
   other process runs, and their quantiles. This file does not decide what is measured. */
#include "bench/measure.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#ifndef BENCH_BUILD
#define BENCH_BUILD "flags not said"
#endif

/* ---- time ---- */

static double clock_ms(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

double bench_now_ms(void)
{
    return clock_ms(CLOCK_PROCESS_CPUTIME_ID);
}

double bench_wall_ms(void)
{
    return clock_ms(CLOCK_MONOTONIC);
}

void bench_add(bench_times *times, double ms)
{
    if (times->count < BENCH_TIMES) {
        times->ms[times->count++] = ms;
    }
}

static int compare_times(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

double bench_quantile(bench_times *times, double share)
{
    if (times->count == 0) {
        return 0;
    }
    qsort(times->ms, (size_t)times->count, sizeof times->ms[0], compare_times);
    double at = share * (times->count - 1);
    int low = (int)at;
    int high = low + 1 < times->count ? low + 1 : low;
    return times->ms[low] + (at - low) * (times->ms[high] - times->ms[low]);
}

/* ---- what every benchmark needs ---- */

void bench_check(int status, const char *what)
{
    if (status != LRCS_OK) {
        fprintf(stderr, "bench: %s: %s\n", what, lrcs_status_text(status));
        exit(1);
    }
}

void *bench_memory(size_t size)
{
    void *bytes = malloc(size ? size : 1);
    if (!bytes) {
        fprintf(stderr, "bench: no %zu bytes of memory\n", size);
        exit(1);
    }
    return bytes;
}

lrcs_pose bench_pose(int direction)
{
    lrcs_pose pose;
    double height = 2 * (direction % BENCH_DIRECTIONS + 0.5) / BENCH_DIRECTIONS - 1;
    lrcs_pose_from_azel(fmod(137.50776405 * direction + 11.3, 360), asin(height) * 180 / acos(-1),
                        &pose);
    return pose;
}

/* ---- the machine ---- */

/* The text after "key :" in a file of such lines; empty if there is none. */
static void value_of(const char *path, const char *key, char *value, size_t size)
{
    char line[512];
    FILE *file = fopen(path, "r");
    value[0] = '\0';
    while (file && !value[0] && fgets(line, sizeof line, file)) {
        const char *colon = strchr(line, ':');
        if (colon && strncmp(line, key, strlen(key)) == 0) {
            snprintf(value, size, "%s", colon + 1 + strspn(colon + 1, " \t"));
            value[strcspn(value, "\n")] = '\0';
        }
    }
    if (file) {
        fclose(file);
    }
}

void bench_machine(FILE *out, const char *prefix)
{
    char processor[256];
    char date[64];
    double load = 0;
    time_t now = time(NULL);
    FILE *file = fopen("/proc/loadavg", "r");
    value_of("/proc/cpuinfo", "model name", processor, sizeof processor);
    strftime(date, sizeof date, "%Y-%m-%d %H:%M UTC", gmtime(&now));
    fprintf(out, "%sprocessor: %s, %ld in all; times are those of one\n", prefix,
            processor[0] ? processor : "not known", sysconf(_SC_NPROCESSORS_ONLN));
    fprintf(out, "%scompiler: %s (%s)\n", prefix, BENCH_BUILD, __VERSION__);
    fprintf(out, "%sdate: %s", prefix, date);
    if (file && fscanf(file, "%lf", &load) == 1) {
        fprintf(out, "; others ran beside it: load %.2f as it began", load);
    }
    fprintf(out, "\n");
    if (file) {
        fclose(file);
    }
}
