/* SPDX-License-Identifier: MIT */
/* How the benchmarks measure: times of the processor, which on one thread are those of the wall
   where nobody else wants it, their quantiles, and what reading a mesh or writing a frame costs
   when nothing else is done. It does not decide what is measured. */
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

double bench_now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
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
    lrcs_pose_from_azel(137.508 * direction + 10, 70.0 * sin(2.4 * direction + 0.5), &pose);
    return pose;
}

/* ---- memory alone ---- */

static volatile uint64_t bench_sink;

static uint64_t word_at(const unsigned char *bytes, size_t i)
{
    uint64_t word;
    memcpy(&word, bytes + i, sizeof word);
    return word;
}

/* Adds up words as they lie; in four sums, so that memory is waited for and not the adder. What is
   left of the last 64 bytes does not count. */
static uint64_t read_words(const void *bytes, size_t size)
{
    const unsigned char *at = bytes;
    uint64_t a = 0;
    uint64_t b = 0;
    uint64_t c = 0;
    uint64_t d = 0;
    for (size_t i = 0; i + 64 <= size; i += 64) {
        a += word_at(at, i) + word_at(at, i + 32);
        b += word_at(at, i + 8) + word_at(at, i + 40);
        c += word_at(at, i + 16) + word_at(at, i + 48);
        d += word_at(at, i + 24) + word_at(at, i + 56);
    }
    return a + b + c + d;
}

double bench_read_mesh(const lrcs_scene *scene)
{
    double start = bench_now_ms();
    bench_sink = read_words(scene->vertex, scene->vertex_count * sizeof *scene->vertex) +
                 read_words(scene->facet, scene->facet_count * sizeof *scene->facet);
    return bench_now_ms() - start;
}

size_t bench_frame_bytes(uint32_t size)
{
    return (size_t)size * size * (sizeof(double) + sizeof(uint32_t));
}

static void *(*volatile bench_fill)(void *, int, size_t) = memset; /* not to be left out */

double bench_write_frame(uint32_t size, void *frame)
{
    double start = bench_now_ms();
    bench_fill(frame, (int)(size & 0xff), bench_frame_bytes(size));
    return bench_now_ms() - start;
}

/* ---- the machine ---- */

/* What follows "key :" in a file of such lines, or nothing. */
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
