/* SPDX-License-Identifier: MIT */
/* What every stage costs on this machine: the generated satellite at four sizes and the models
   named on the command line, medians over several directions; per facet, per pixel and in bytes,
   beside what memory alone would cost (reading the mesh once, writing a frame once). usage: bench
   [--quick] [--csv FILE] [MODEL ..] */
#include <stdio.h>
#include <string.h>
#include <time.h>

#include <lrcs/host.h>

#include "base/work.h"
#include "integrate/plan.h"
#include "integrate/total.h"
#include "satellite.h"
#include "visibility/occlude.h"

enum { REPEATS = 9, STAGES_MOST = 32 };

/* One measured stage: its median, and what it is shared among. */
typedef struct bench_stage {
    const char *name;
    double ms;
    double pixels; /* 0: per facet only */
    size_t bytes;  /* of work area that it takes; 0: not said */
} bench_stage;

/* One scene under measurement. */
typedef struct bench_case {
    const char *name;
    const lrcs_scene *scene;
    const lrcs_prepared *prepared;
    lrcs_work work;
    bench_stage stage[STAGES_MOST];
    int stages;
    uint32_t contested;
} bench_case;

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double median(double *x, int count)
{
    for (int i = 1; i < count; i++) {
        for (int k = i; k > 0 && x[k - 1] > x[k]; k--) {
            double swap = x[k];
            x[k] = x[k - 1];
            x[k - 1] = swap;
        }
    }
    return 0.5 * (x[(count - 1) / 2] + x[count / 2]);
}

static void stage_add(bench_case *b, const char *name, double ms, double pixels, size_t bytes)
{
    b->stage[b->stages++] = (bench_stage){name, ms, pixels, bytes};
}

/* Directions all around, none of them special. */
static lrcs_pose pose_of(int repeat)
{
    lrcs_pose pose;
    lrcs_pose_from_azel(137.508 * repeat + 10, 70.0 * sin(2.4 * repeat + 0.5), &pose);
    return pose;
}

static void check(int status, const char *what)
{
    if (status != LRCS_OK) {
        fprintf(stderr, "bench: %s: %s\n", what, lrcs_status_text(status));
        exit(1);
    }
}

/* --- memory alone ----------------------------------------------------------------------------- */

static volatile double bench_sink;
static void *(*volatile bench_write)(void *, int, size_t) = memset; /* not to be left out */

static void measure_memory(bench_case *b)
{
    double read[REPEATS];
    double write[REPEATS];
    const double *vertex = &b->scene->vertex[0].x[0];
    size_t frame = (size_t)1024 * 1024 * 12;
    unsigned char *bytes = malloc(frame);
    for (int i = 0; i < REPEATS && bytes; i++) {
        double start = seconds();
        double sum = 0;
        for (size_t k = 0; k < 3 * (size_t)b->scene->vertex_count; k++) {
            sum += vertex[k];
        }
        for (size_t f = 0; f < b->scene->facet_count; f++) {
            sum += b->scene->facet[f].corner[f % 3];
        }
        bench_sink = sum;
        read[i] = seconds() - start;
        start = seconds();
        bench_write(bytes, i, frame);
        bench_sink = bytes[frame / 2];
        write[i] = seconds() - start;
    }
    free(bytes);
    stage_add(b, "(read the mesh once)", 1e3 * median(read, REPEATS), 0, 0);
    stage_add(b, "(write a 1024 frame)", 1e3 * median(write, REPEATS), 1024.0 * 1024, frame);
}

/* --- stages of a pose ------------------------------------------------------------------------- */

/* A view and its contested facets, with room for the areas. */
typedef struct bench_view {
    lrcsi_view view;
    lrcsi_contest contest;
    lrcsi_visible *visible;
} bench_view;

static void view_start(bench_case *b, int repeat, bench_view *v)
{
    lrcs_pose pose = pose_of(repeat);
    v->visible = lrcsi_work_take(&b->work, b->scene->facet_count, sizeof *v->visible);
    check(lrcsi_view_make(b->prepared, &pose, &b->work, &v->view), "view");
    check(lrcsi_contest_make(&v->view, &b->work, &v->contest), "contest");
}

static void measure_view(bench_case *b, int repeats)
{
    double view[REPEATS];
    double contest[REPEATS];
    uint64_t contested = 0;
    for (int i = 0; i < repeats; i++) {
        size_t mark = b->work.used;
        lrcs_pose pose = pose_of(i);
        bench_view v;
        double start = seconds();
        check(lrcsi_view_make(b->prepared, &pose, &b->work, &v.view), "view");
        view[i] = seconds() - start;
        start = seconds();
        check(lrcsi_contest_make(&v.view, &b->work, &v.contest), "contest");
        contest[i] = seconds() - start;
        contested += v.contest.contested_count;
        b->work.used = mark;
    }
    b->contested = (uint32_t)(contested / (uint64_t)repeats);
    stage_add(b, "cull and project", 1e3 * median(view, repeats), 0, lrcsi_view_need(b->prepared));
    stage_add(b, "find contested", 1e3 * median(contest, repeats), 0,
              lrcsi_contest_need(b->prepared));
}

static void measure_raster(bench_case *b, int repeats, uint32_t size)
{
    static char name[8][2][32];
    static int names;
    double raster[REPEATS];
    double areas[REPEATS];
    size_t bytes = 0;
    for (int i = 0; i < repeats; i++) {
        size_t mark = b->work.used;
        lrcsi_raster r;
        bench_view v;
        view_start(b, i, &v);
        size_t before = b->work.used;
        double start = seconds();
        check(lrcsi_raster_make(&v.view, size, &b->work, &r), "raster");
        raster[i] = seconds() - start;
        bytes = b->work.used - before;
        start = seconds();
        check(lrcsi_visible_sampled(&v.contest, &r, &b->work, v.visible), "areas");
        areas[i] = seconds() - start;
        b->work.used = mark;
    }
    int at = names++ % 8;
    snprintf(name[at][0], sizeof name[at][0], "raster %u", size);
    snprintf(name[at][1], sizeof name[at][1], "areas of raster %u", size);
    double pixels = (double)size * size;
    stage_add(b, name[at][0], 1e3 * median(raster, repeats), pixels, bytes);
    stage_add(b, name[at][1], 1e3 * median(areas, repeats), pixels, 0);
}

static void measure_exact(bench_case *b, int repeats)
{
    double exact[REPEATS];
    double sum[REPEATS];
    for (int i = 0; i < repeats; i++) {
        size_t mark = b->work.used;
        bench_view v;
        view_start(b, i, &v);
        uint32_t starved;
        lrcs_run_options options = lrcs_run_options_default();
        lrcsi_plan plan = lrcsi_plan_make(&v.view, &options);
        double start = seconds();
        check(lrcsi_occlude_all(&v.contest, &b->work, v.visible, &starved), "exact");
        exact[i] = seconds() - start;
        start = seconds();
        bench_sink = lrcsi_total_make(&v.view, &plan, v.visible, NULL, NULL, NULL).diffuse;
        sum[i] = seconds() - start;
        b->work.used = mark;
    }
    stage_add(b, "exact areas", 1e3 * median(exact, repeats), 0, lrcsi_occlude_need(b->prepared));
    stage_add(b, "sum", 1e3 * median(sum, repeats), 0, 0);
}

static void measure_pose(bench_case *b, int repeats, const char *name, int method, uint32_t size)
{
    double time[REPEATS];
    lrcs_run_options options = lrcs_run_options_default();
    options.method = method;
    options.resolution = size;
    for (int i = 0; i < repeats; i++) {
        lrcs_pose pose = pose_of(i);
        lrcs_result result;
        double start = seconds();
        check(lrcs_sigma_run(b->prepared, &pose, &options, &b->work, &result, NULL, NULL), name);
        time[i] = seconds() - start;
    }
    stage_add(b, name, 1e3 * median(time, repeats), (double)size * size,
              lrcs_sigma_need(b->prepared, &options));
}

/* --- one scene -------------------------------------------------------------------------------- */

static size_t work_size(const lrcs_scene *scene, int quick)
{
    size_t pixels = quick ? (size_t)1024 * 1024 : (size_t)4096 * 4096;
    return lrcs_prepare_need(scene) + 900 * (size_t)scene->facet_count + 16 * pixels +
           ((size_t)64 << 20);
}

static void case_print(const bench_case *b, FILE *csv)
{
    double facets = b->scene->facet_count;
    printf("\n%s: %.0f facets, %u contested\n", b->name, facets, b->contested);
    printf("  %-22s %10s %10s %10s %12s\n", "stage", "ms", "ns/facet", "ns/pixel", "work bytes");
    for (int i = 0; i < b->stages; i++) {
        const bench_stage *s = &b->stage[i];
        char pixel[32] = "-";
        char bytes[32] = "-";
        if (s->pixels > 0) {
            snprintf(pixel, sizeof pixel, "%.2f", 1e6 * s->ms / s->pixels);
        }
        if (s->bytes > 0) {
            snprintf(bytes, sizeof bytes, "%zu", s->bytes);
        }
        printf("  %-22s %10.3f %10.1f %10s %12s\n", s->name, s->ms, 1e6 * s->ms / facets, pixel,
               bytes);
        if (csv) {
            fprintf(csv, "%s,%.0f,%u,%s,%.6g,%.6g,%s,%s\n", b->name, facets, b->contested, s->name,
                    s->ms, 1e6 * s->ms / facets, s->pixels > 0 ? pixel : "",
                    s->bytes > 0 ? bytes : "");
        }
    }
    fflush(stdout);
}

/* Everything about a scene that is loaded; `load` is in milliseconds, negative if not measured. */
static void scene_measure(const char *name, const lrcs_scene *scene, double load, int quick,
                          FILE *csv)
{
    int repeats = scene->facet_count > 100000 ? 3 : REPEATS;
    size_t size = work_size(scene, quick);
    void *bytes = malloc(size);
    check(bytes ? LRCS_OK : LRCS_E_MEMORY, name);
    bench_case b = {.name = name, .scene = scene, .work = lrcs_work_make(bytes, size)};
    measure_memory(&b);
    if (load >= 0) {
        stage_add(&b, "load", load, 0, 0);
    }
    double start = seconds();
    check(lrcs_prepare_run(scene, &b.work, &b.prepared), "prepare");
    stage_add(&b, "prepare", 1e3 * (seconds() - start), 0, b.work.peak);
    measure_view(&b, repeats);
    for (uint32_t n = 512; n <= (quick ? 1024u : 4096u); n *= 2) {
        measure_raster(&b, repeats, n);
    }
    measure_exact(&b, repeats);
    measure_pose(&b, repeats, "pose, facet", LRCS_METHOD_FACET, 0);
    measure_pose(&b, repeats, "pose, zbuffer 1024", LRCS_METHOD_ZBUFFER, 1024);
    measure_pose(&b, repeats, "pose, exact", LRCS_METHOD_EXACT, 0);
    case_print(&b, csv);
    free(bytes);
}

static void satellite_measure(uint32_t n, int quick, FILE *csv)
{
    char name[32];
    satellite s;
    satellite_make(&s, n);
    snprintf(name, sizeof name, "satellite %u", s.scene.facet_count);
    scene_measure(name, &s.scene, -1, quick, csv);
    satellite_free(&s);
}

static void model_measure(const char *path, int quick, FILE *csv)
{
    lrcs_host_options options = lrcs_host_options_default();
    lrcs_host_scene scene = {0};
    lrcs_host_error error;
    if (lrcs_host_scene_read(path, &options, &scene, &error) != LRCS_OK) {
        fprintf(stderr, "bench: %s\n", error.text);
        exit(1);
    }
    const char *name = strrchr(path, '/');
    scene_measure(name ? name + 1 : path, &scene.scene, 1e3 * scene.seconds_load, quick, csv);
    lrcs_host_scene_free(&scene);
}

int main(int count, char **argument)
{
    static const uint32_t sizes[] = {5, 19, 64, 192};
    int quick = 0;
    FILE *csv = NULL;
    int first = 1;
    for (; first < count && strncmp(argument[first], "--", 2) == 0; first++) {
        if (strcmp(argument[first], "--csv") == 0 && first + 1 < count) {
            csv = fopen(argument[++first], "w");
        } else {
            quick = 1;
        }
    }
    if (csv) {
        fprintf(csv, "scene,facets,contested,stage,ms,ns_per_facet,ns_per_pixel,bytes\n");
    }
    for (int i = 0; i < (quick ? 2 : 4); i++) {
        satellite_measure(sizes[i], quick, csv);
    }
    for (; first < count; first++) {
        model_measure(argument[first], quick, csv);
    }
    return csv && fclose(csv) != 0;
}
