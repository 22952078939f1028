/* SPDX-License-Identifier: MIT */
/* How time and memory grow: with facets on the generated satellite, with pixels, with layers one
   above the other, in the worst cases, where every facet overlaps every other, and in scenes of
   which most is hidden. An exponent is the slope of a least-squares line through the logarithms.
   "Pairs" is that of the number of pairs of facets whose projections overlap: where it is 2, a
   constant fraction of all pairs do. This file decides which series are measured; usage:
   scaling [--quick | --tiny] */
#include <lrcs/host.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bench/measure.h"
#include "bench/scenes.h"

enum { POINTS = 8, POSES = 3 };
/* Pairs are counted in scenes with at most this many facets. */
#define COUNTED_FACETS 50000u

/* What is measured of each scene. */
enum scaling_kind { KIND_PREPARE, KIND_FACET, KIND_ZBUFFER, KIND_EXACT, KINDS };
static const char *const kind_names[KINDS] = {"prepare", "facet", "zbuffer", "exact"};

/* One scene of a series, and the answer of its last pose. */
typedef struct scaling_point {
    double size, ms, bytes;
    double pairs; /* of facets that overlap in the last pose; 0: none, or not counted */
    lrcs_result result;
} scaling_point;

typedef struct scaling_series {
    scaling_point point[KINDS][POINTS];
    int count[KINDS];
    int steep;      /* seen from near +z */
    int exact_only; /* but for prepare */
    uint32_t resolution;
    double most_ms; /* a method that took longer is left out of what is larger */
} scaling_series;

/* A line through (log size, log value). */
typedef struct scaling_fit {
    double exponent;
    double off;  /* the factor by which a point is off the line at most */
    double last; /* exponent of the last step alone */
} scaling_fit;

static scaling_fit fit_make(const double *size, const double *value, int count)
{
    double mean[2] = {0, 0};
    double xx = 0;
    double xy = 0;
    scaling_fit fit = {0, 0, 0};
    for (int i = 0; i < count; i++) {
        mean[0] += log(size[i]) / count;
        mean[1] += log(value[i]) / count;
    }
    for (int i = 0; i < count; i++) {
        double x = log(size[i]) - mean[0];
        xx += x * x;
        xy += x * (log(value[i]) - mean[1]);
    }
    fit.exponent = xy / xx;
    for (int i = 0; i < count; i++) {
        double line = mean[1] + fit.exponent * (log(size[i]) - mean[0]);
        fit.off = fmax(fit.off, exp(fabs(log(value[i]) - line)));
    }
    fit.last = log(value[count - 1] / value[count - 2]) / log(size[count - 1] / size[count - 2]);
    return fit;
}

/* ---- pairs of facets ---- */

/* A facet in the view plane, with its range of x. */
typedef struct projected_facet {
    double low, high;
    double corner[3][2];
} projected_facet;

static int facet_compare(const void *a, const void *b)
{
    const projected_facet *f = a;
    const projected_facet *g = b;
    return (f->low > g->low) - (f->low < g->low);
}

/* Does the line of a side of one triangle separate it from the other? Triangles that share a side
   or only touch are separated too. */
static int side_separates(const projected_facet *f, const projected_facet *g)
{
    for (int k = 0; k < 3; k++) {
        const double *from = f->corner[k];
        const double *to = f->corner[(k + 1) % 3];
        const double *apex = f->corner[(k + 2) % 3];
        double side[2] = {to[0] - from[0], to[1] - from[1]};
        double height = side[0] * (apex[1] - from[1]) - side[1] * (apex[0] - from[0]);
        double nearest = -INFINITY; /* of g to f, on f's side of the line */
        for (int i = 0; i < 3; i++) {
            const double *x = g->corner[i];
            double left = side[0] * (x[1] - from[1]) - side[1] * (x[0] - from[0]);
            nearest = fmax(nearest, left * copysign(1, height));
        }
        if (nearest <= 1e-9 * fabs(height)) {
            return 1;
        }
    }
    return 0;
}

/* The number of pairs of facets whose projections overlap. */
static double pairs_count(const lrcs_scene *scene, const lrcs_pose *pose)
{
    uint32_t count = scene->facet_count;
    projected_facet *facet = bench_memory(count * sizeof *facet);
    double pairs = 0;
    for (uint32_t f = 0; f < count; f++) {
        facet[f].low = INFINITY;
        facet[f].high = -INFINITY;
        for (int k = 0; k < 3; k++) {
            const double *v = scene->vertex[scene->facet[f].corner[k]].x;
            for (int r = 0; r < 2; r++) {
                const double *row = pose->R[r];
                facet[f].corner[k][r] = row[0] * v[0] + row[1] * v[1] + row[2] * v[2];
            }
            facet[f].low = fmin(facet[f].low, facet[f].corner[k][0]);
            facet[f].high = fmax(facet[f].high, facet[f].corner[k][0]);
        }
    }
    qsort(facet, count, sizeof *facet, facet_compare);
    for (uint32_t f = 0; f < count; f++) {
        for (uint32_t g = f + 1; g < count && facet[g].low < facet[f].high; g++) {
            pairs += !side_separates(&facet[f], &facet[g]) && !side_separates(&facet[g], &facet[f]);
        }
    }
    free(facet);
    return pairs;
}

/* ---- measuring ---- */

/* Prepares in a work area that grows until it suffices; the caller frees it. */
static void *prepare_measure(const lrcs_scene *scene, const lrcs_prepared **prepared,
                             scaling_point *point)
{
    size_t size = lrcs_prepare_need(scene);
    int status = LRCS_E_MEMORY;
    void *bytes = NULL;
    while (status == LRCS_E_MEMORY) {
        free(bytes);
        bytes = bench_memory(size);
        lrcs_work work = lrcs_work_make(bytes, size);
        double start = bench_now_ms();
        status = lrcs_prepare_run(scene, &work, prepared);
        point->ms = bench_now_ms() - start;
        point->bytes = (double)work.peak;
        size *= 2;
    }
    bench_check(status, "prepare");
    return bytes;
}

static lrcs_pose pose_of(const scaling_series *series, int i)
{
    lrcs_pose pose = bench_pose(i + 1);
    if (series->steep) {
        lrcs_pose_from_azel(137.508 * i + 10, 78.0 + 3 * i, &pose);
    }
    return pose;
}

/* All poses in an area of `size` bytes; the first failure, or LRCS_OK. */
static int poses_measure(const scaling_series *series, const lrcs_prepared *prepared,
                         const lrcs_run_options *options, size_t size, scaling_point *point)
{
    bench_times times = {.count = 0};
    void *bytes = bench_memory(size);
    lrcs_work work = lrcs_work_make(bytes, size);
    int status = LRCS_OK;
    for (int i = 0; i < POSES && status == LRCS_OK; i++) {
        lrcs_pose pose = pose_of(series, i);
        double start = bench_now_ms();
        status = lrcs_sigma_run(prepared, &pose, options, &work, &point->result, NULL, NULL);
        bench_add(&times, bench_now_ms() - start);
    }
    point->ms = bench_quantile(&times, 0.5);
    point->bytes = (double)work.peak;
    free(bytes);
    return status;
}

/* In a work area that grows until it suffices; prints a message if the size that the library states
   does not. */
static void method_measure(const scaling_series *series, const lrcs_prepared *prepared, int method,
                           scaling_point *point)
{
    lrcs_run_options options = lrcs_run_options_default();
    options.method = method;
    options.resolution = method == LRCS_METHOD_ZBUFFER ? series->resolution : 0;
    size_t need = lrcs_sigma_need(prepared, &options);
    size_t size = need;
    int status = poses_measure(series, prepared, &options, size, point);
    while (status == LRCS_E_MEMORY || (point->result.flags & LRCS_FLAG_MEMORY_FALLBACK)) {
        size *= 2;
        status = poses_measure(series, prepared, &options, size, point);
    }
    bench_check(status, lrcs_method_text(method));
    if (size > need) {
        printf("(%s of %.0f: %.2f of the bytes that lrcs_sigma_need says)\n",
               lrcs_method_text(method), point->size, point->bytes / (double)need);
    }
}

/* One more scene of a series, `size` being what grows. */
static void series_add(scaling_series *series, const lrcs_scene *scene, double size)
{
    static const int method[KINDS] = {LRCS_METHOD_AUTO, LRCS_METHOD_FACET, LRCS_METHOD_ZBUFFER,
                                      LRCS_METHOD_EXACT};
    const lrcs_prepared *prepared;
    scaling_point point = {.size = size};
    void *bytes = prepare_measure(scene, &prepared, &point);
    for (int kind = 0; kind < KINDS; kind++) {
        int count = series->count[kind];
        if ((count > 0 && series->point[kind][count - 1].ms > series->most_ms) ||
            (series->exact_only && (kind == KIND_FACET || kind == KIND_ZBUFFER))) {
            continue;
        }
        if (kind != KIND_PREPARE) {
            method_measure(series, prepared, method[kind], &point);
        }
        point.pairs = 0;
        if (kind == KIND_EXACT && scene->facet_count <= COUNTED_FACETS) {
            lrcs_pose pose = pose_of(series, POSES - 1);
            point.pairs = pairs_count(scene, &pose);
        }
        series->point[kind][series->count[kind]++] = point;
    }
    free(bytes);
}

/* ---- showing ---- */

static void fit_print(const char *what, const char *grows, const char *kind,
                      const scaling_point *point, int count)
{
    double size[POINTS] = {0};
    double ms[POINTS] = {0};
    double bytes[POINTS] = {0};
    double counted[POINTS]; /* the sizes of which pairs were counted */
    double pairs[POINTS];
    int counts = 0;
    if (count < 2) {
        return;
    }
    for (int i = 0; i < count; i++) {
        size[i] = point[i].size;
        ms[i] = point[i].ms;
        bytes[i] = point[i].bytes;
        if (point[i].pairs > 0) {
            counted[counts] = point[i].size;
            pairs[counts++] = point[i].pairs;
        }
    }
    scaling_fit time = fit_make(size, ms, count);
    scaling_fit memory = fit_make(size, bytes, count);
    printf("| %-18s | %-9s | %-8s | %8.0f .. %-8.0f | %9.4g .. %-9.4g | %8.2f | %6.2f | %9.2f | "
           "%6.2f |",
           what, grows, kind, size[0], size[count - 1], ms[0], ms[count - 1], time.exponent,
           time.off, time.last, memory.exponent);
    if (counts > 1) {
        printf(" %5.2f |\n", fit_make(counted, pairs, counts).exponent);
    } else {
        printf(" %5s |\n", "");
    }
    fflush(stdout);
}

static void series_print(const scaling_series *series, const char *what, const char *grows)
{
    for (int kind = 0; kind < KINDS; kind++) {
        fit_print(what, grows, kind_names[kind], series->point[kind], series->count[kind]);
    }
}

/* What the exact method answered in the worst cases, size by size. */
static void answers_print(const scaling_series *series, const char *what)
{
    printf("\n%s, exact: sizes, times and answers (tolerance 1e-4)\n\n", what);
    printf("| %8s | %10s | %12s | %10s | %8s | %-40s |\n", "facets", "ms", "sigma m2",
           "bound/sigma", "partial", "flags");
    printf("|---------:|-----------:|-------------:|------------:|---------:|:----|\n");
    for (int i = 0; i < series->count[KIND_EXACT]; i++) {
        const scaling_point *point = &series->point[KIND_EXACT][i];
        const lrcs_result *r = &point->result;
        printf("| %8lu | %10.4g | %12.6g | %11.2g | %8lu |", (unsigned long)r->facets_total,
               point->ms, r->sigma_m2, r->bound_m2 / r->sigma_m2, (unsigned long)r->facets_partial);
        for (int bit = 0; bit < 3; bit++) {
            if (r->flags & 1u << bit) {
                printf(" %s", lrcs_flag_text(1 << bit));
            }
        }
        printf("%s |\n", r->flags ? "" : " none");
    }
    fflush(stdout);
}

/* ---- the series ---- */

/* The extent of a series: tiny, quick, full. */
enum { EXTENTS = 3 };
static const uint32_t resolutions[EXTENTS] = {64, 1024, 1024};

static void head_print(void)
{
    printf("\n| %-18s | %-9s | %-8s | %-20s | %-22s | %8s | %6s | %9s | %6s | %5s |\n", "scene",
           "grows", "what", "sizes", "ms", "exponent", "off by", "last step", "memory", "pairs");
    printf("|:---|:---|:---|:---|:---|---:|---:|---:|---:|---:|\n");
}

static void satellite_series(int extent)
{
    static const uint32_t n[] = {5, 9, 19, 38, 76, 152};
    static const int count[EXTENTS] = {2, 4, 6};
    scaling_series series = {.resolution = resolutions[extent], .most_ms = 60e3};
    for (int i = 0; i < count[extent]; i++) {
        bench_scene made;
        bench_satellite(&made, n[i]);
        series_add(&series, &made.scene, made.scene.facet_count);
        bench_scene_free(&made);
    }
    series_print(&series, "satellite", "facets");
}

static void pixel_series(int extent)
{
    static const uint32_t n[EXTENTS] = {2, 9, 19};
    static const uint32_t most[EXTENTS] = {256, 1024, 4096};
    const lrcs_prepared *prepared;
    scaling_series series = {.steep = 0};
    scaling_point point[POINTS];
    bench_scene made;
    char name[32];
    int count = 0;
    bench_satellite(&made, n[extent]);
    void *bytes = prepare_measure(&made.scene, &prepared, &point[0]);
    for (uint32_t size = 128; size <= most[extent]; size *= 2) {
        point[count].size = (double)size * size;
        series.resolution = size;
        method_measure(&series, prepared, LRCS_METHOD_ZBUFFER, &point[count++]);
    }
    snprintf(name, sizeof name, "satellite %lu", (unsigned long)made.scene.facet_count);
    fit_print(name, "pixels", "zbuffer", point, count);
    free(bytes);
    bench_scene_free(&made);
}

static void layer_series(int extent)
{
    static const uint32_t most[EXTENTS] = {2, 16, 64};
    scaling_series series = {.steep = 1, .resolution = resolutions[extent], .most_ms = 10e3};
    for (uint32_t layers = 1; layers <= most[extent]; layers *= 2) {
        bench_scene made;
        bench_layers(&made, layers, 16);
        series_add(&series, &made.scene, layers);
        bench_scene_free(&made);
    }
    series_print(&series, "sheets of 512", "sheets");
}

/* The scenes in which everything overlaps everything. */
enum worst_case { WORST_STACKED, WORST_PIERCING, WORST_STAR, WORST_CASES };

static void worst_make(int which, uint32_t count, bench_scene *made)
{
    if (which == WORST_STAR) {
        bench_star(made, count);
    } else {
        bench_shards(made, count, which == WORST_STACKED ? BENCH_STACKED : BENCH_PIERCING);
    }
}

static void worst_series(int which, int extent, scaling_series *series)
{
    static const uint32_t most[EXTENTS] = {16, 64, 512};
    static const char *const name[] = {"stacked triangles", "piercing triangles",
                                       "star of needles"};
    *series = (scaling_series){.steep = 1, .resolution = resolutions[extent], .most_ms = 4e3};
    for (uint32_t count = 8; count <= most[extent]; count *= 2) {
        bench_scene made;
        worst_make(which, count, &made);
        series_add(series, &made.scene, count);
        bench_scene_free(&made);
    }
    series_print(series, name[which], "facets");
}

/* Scenes in which much is hidden by what is near in depth. Of hatched strips, seen from near +z,
   n^2 pieces are visible for n strips; of the other scenes a few pieces for each facet. */
static void hidden_series(int extent)
{
    static void (*const make[])(bench_scene *, uint32_t) = {bench_hatch, bench_book, bench_zigzag};
    static const char *const name[] = {"hatched strips", "pages of a book", "zigzag wall"};
    static const uint32_t least[EXTENTS] = {8, 128, 128};
    static const uint32_t most[EXTENTS] = {16, 512, 1024};
    for (int i = 0; i < 3; i++) {
        scaling_series series = {.steep = i < 2, .exact_only = 1, .most_ms = 10e3};
        for (uint32_t n = least[extent]; n <= most[extent]; n *= 2) {
            bench_scene made;
            make[i](&made, n);
            series_add(&series, &made.scene, made.scene.facet_count);
            bench_scene_free(&made);
        }
        series_print(&series, name[i], "facets");
    }
}

int main(int count, char **argument)
{
    static scaling_series worst[WORST_CASES];
    int extent = count < 2 ? 2 : strcmp(argument[1], "--quick") == 0 ? 1 : 0;
    if (count > 2 || (count == 2 && extent == 0 && strcmp(argument[1], "--tiny") != 0)) {
        fprintf(stderr, "usage: scaling [--quick | --tiny]\n");
        return 2;
    }
    bench_machine(stdout, "");
    head_print();
    satellite_series(extent);
    pixel_series(extent);
    layer_series(extent);
    for (int i = 0; i < WORST_CASES; i++) {
        worst_series(i, extent, &worst[i]);
    }
    hidden_series(extent);
    answers_print(&worst[WORST_STACKED], "Stacked triangles");
    answers_print(&worst[WORST_PIERCING], "Piercing triangles");
    answers_print(&worst[WORST_STAR], "Star of needles");
    return 0;
}
