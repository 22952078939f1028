/* SPDX-License-Identifier: MIT */
/* What every stage and every whole pose costs on this machine: a generated satellite and a convex
   body at the sizes of the published comparison, and the models named on the command line. Medians
   over directions all around; beside each the time that memory alone would take, measured in the
   same run, and the targets of the project. It decides what is measured; usage: bench [--quick |
   --tiny] [--csv FILE] [--plot FILE.svg] [--scratch FILE.stl] [MODEL ..] */
#include <lrcs/host.h>

#include <stdlib.h>
#include <string.h>

#include "bench/rows.h"
#include "bench/scenes.h"
#include "bench/stages.h"

/* How much is measured. */
enum bench_extent { EXTENT_TINY, EXTENT_QUICK, EXTENT_FULL };

typedef struct bench_job {
    int extent;
    const char *csv, *plot;
    const char *scratch; /* a model file that may be written, for load */
    bench_table table;
} bench_job;

/* The published comparison's sizes; one smaller for the tool's own test. */
enum { SIZES = 5 };
static const uint32_t satellite_sizes[SIZES] = {2, 5, 19, 64, 192};
static const uint32_t cushion_sizes[SIZES] = {4, 12, 49, 165, 499};

/* Targets in ms for whole poses of the satellite at those sizes: 0, none was set. */
static const double zbuffer_targets[SIZES] = {0, 0.4, 1.5, 6, 45};
static const double exact_targets[SIZES] = {0, 1, 8, 100, 0};

/* A scene under measurement. */
typedef struct bench_case {
    bench_job *job;
    const char *name;
    const lrcs_scene *scene;
    const lrcs_prepared *prepared;
    lrcs_work work;     /* of poses */
    lrcs_result result; /* of the last one */
    double read;        /* the mesh once, ms */
    int size;           /* of SIZES, where generated; -1 */
} bench_case;

/* ---- how often ---- */

/* Larger scenes are measured less often. */
static int directions_of(const bench_case *c)
{
    int few = c->job->extent == EXTENT_TINY ? 1 : 3;
    return c->job->extent < EXTENT_FULL || c->scene->facet_count > 1000000 ? few : BENCH_DIRECTIONS;
}

static int rounds_of(const bench_case *c)
{
    return c->job->extent == EXTENT_FULL && c->scene->facet_count <= 50000 ? 3 : 1;
}

static int rasters_of(const bench_case *c)
{
    return c->job->extent == EXTENT_FULL ? BENCH_RASTERS : 2;
}

/* ---- one scene ---- */

static bench_row *case_row(const bench_case *c, const char *stage, bench_times *times)
{
    return bench_row_add(&c->job->table, c->name, c->scene, stage, times);
}

static double frame_ms(const bench_case *c, uint32_t size)
{
    char stage[BENCH_NAME];
    snprintf(stage, sizeof stage, "write frame %lu", (unsigned long)size);
    for (uint32_t i = c->job->table.count; i-- > 0;) {
        if (strcmp(c->job->table.row[i].stage, stage) == 0) {
            return c->job->table.row[i].ms;
        }
    }
    return 0;
}

/* The limits first: reading as warm as a pose finds the mesh, that is from memory where it is too
   large for the caches. */
static void measure_limits(bench_case *c)
{
    bench_times read = {.count = 0};
    for (int i = 0; i < BENCH_DIRECTIONS; i++) {
        bench_add(&read, bench_read_mesh(c->scene));
    }
    c->read = case_row(c, "read mesh", &read)->ms;
    for (int raster = 0; raster < rasters_of(c); raster++) {
        char stage[BENCH_NAME];
        uint32_t size = bench_raster_size(raster);
        bench_times write = {.count = 0};
        void *frame = bench_memory(bench_frame_bytes(size));
        bench_write_frame(size, frame); /* the system hands out its pages */
        for (int i = 0; i < BENCH_DIRECTIONS; i++) {
            bench_add(&write, bench_write_frame(size, frame));
        }
        free(frame);
        snprintf(stage, sizeof stage, "write frame %lu", (unsigned long)size);
        bench_row *row = case_row(c, stage, &write);
        row->pixels = (uint64_t)size * size;
        row->bytes = bench_frame_bytes(size);
    }
}

/* The prepared scene stays in the area given back. */
static void *measure_prepare(bench_case *c)
{
    bench_times times = {.count = 0};
    size_t need = lrcs_prepare_need(c->scene);
    void *bytes = bench_memory(need);
    lrcs_work work;
    for (int i = 0; i < rounds_of(c); i++) {
        work = lrcs_work_make(bytes, need);
        double start = bench_now_ms();
        bench_check(lrcs_prepare_run(c->scene, &work, &c->prepared), "prepare");
        bench_add(&times, bench_now_ms() - start);
    }
    bench_row *row = case_row(c, "prepare", &times);
    row->bytes = work.peak;
    row->limit = c->read;
    return bytes;
}

static void stage_row_add(bench_case *c, bench_stages *stages, int stage, const char *name,
                          uint32_t size)
{
    char text[BENCH_NAME];
    snprintf(text, sizeof text, size ? "%s %lu" : "%s", name, (unsigned long)size);
    bench_row *row = case_row(c, text, &stages->times[stage]);
    row->bytes = stages->bytes[stage];
    row->pixels = (uint64_t)size * size;
    row->limit = c->read + (size ? frame_ms(c, size) : 0);
}

static void measure_stages(bench_case *c)
{
    bench_stages warm = {.poses = 0};
    bench_stages stages = {.poses = 0};
    lrcs_pose pose = bench_pose(0);
    bench_stages_run(c->prepared, &pose, rasters_of(c), &c->work, &warm);
    for (int i = 0; i < directions_of(c) * rounds_of(c); i++) {
        pose = bench_pose(i % directions_of(c));
        bench_stages_run(c->prepared, &pose, rasters_of(c), &c->work, &stages);
    }
    stage_row_add(c, &stages, BENCH_CULL, "cull", 0);
    stage_row_add(c, &stages, BENCH_CONTEST, "contest", 0);
    for (int raster = 0; raster < rasters_of(c); raster++) {
        stage_row_add(c, &stages, BENCH_RASTER + raster, "raster", bench_raster_size(raster));
        stage_row_add(c, &stages, BENCH_AREAS + raster, "areas of", bench_raster_size(raster));
    }
    stage_row_add(c, &stages, BENCH_EXACT, "exact", 0);
    stage_row_add(c, &stages, BENCH_SUM, "sum", 0);
    printf("%s: %.0f facets contested in the mean\n", c->name,
           (double)stages.contested / stages.poses);
}

static bench_row *measure_pose(bench_case *c, const char *name, int method, uint32_t size)
{
    bench_times times = {.count = 0};
    lrcs_run_options options = lrcs_run_options_default();
    options.method = method;
    options.resolution = size;
    c->work.peak = 0;
    for (int i = -1; i < directions_of(c) * rounds_of(c); i++) {
        lrcs_pose pose = bench_pose(i < 0 ? 0 : i % directions_of(c));
        double start = bench_now_ms();
        bench_check(lrcs_sigma_run(c->prepared, &pose, &options, &c->work, &c->result, NULL, NULL),
                    name);
        if (i >= 0) {
            bench_add(&times, bench_now_ms() - start);
        }
    }
    bench_row *row = case_row(c, name, &times);
    row->bytes = c->work.peak;
    row->pixels = (uint64_t)size * size;
    row->limit = c->read + (size ? frame_ms(c, size) : 0);
    return row;
}

/* The facet pose; its target is for convex bodies, which must be known for what they are. */
static void measure_facet(bench_case *c, int convex)
{
    bench_row *row = measure_pose(c, "pose facet", LRCS_METHOD_FACET, 0);
    if (convex) {
        row->target = 2 * c->read;
        bench_check(c->result.effect[LRCS_EFFECT_SELF_SHADOWING].on ? LRCS_E_ARGUMENT : LRCS_OK,
                    "a convex body");
    }
    if (c->size >= 0 || convex) {
        bench_check(c->result.effect[LRCS_EFFECT_BACK_FACE_CASTERS].on ? LRCS_E_ARGUMENT : LRCS_OK,
                    "a closed body");
    }
}

static void measure_methods(bench_case *c)
{
    bench_row *row = measure_pose(c, "pose zbuffer 1024", LRCS_METHOD_ZBUFFER, 1024);
    row->target = c->size >= 0 ? zbuffer_targets[c->size] : 0;
    row = measure_pose(c, "pose exact", LRCS_METHOD_EXACT, 0);
    row->target = c->size >= 0 ? exact_targets[c->size] : 0;
}

/* Room for the stages of a pose, which stand beside one another. */
static size_t pose_need(const bench_case *c)
{
    lrcs_run_options options = lrcs_run_options_default();
    options.method = LRCS_METHOD_EXACT;
    size_t need = lrcs_sigma_need(c->prepared, &options);
    options.method = LRCS_METHOD_ZBUFFER;
    options.resolution = bench_raster_size(rasters_of(c) - 1);
    return need + lrcs_sigma_need(c->prepared, &options);
}

static void case_measure(bench_case *c, int convex, bench_times *load)
{
    uint32_t first = c->job->table.count;
    measure_limits(c);
    if (load->count > 0) {
        case_row(c, "load", load)->limit = c->read;
    }
    void *prepared = measure_prepare(c);
    size_t size = pose_need(c);
    void *bytes = bench_memory(size);
    c->work = lrcs_work_make(bytes, size);
    if (!convex && (c->size >= 0 || c->job->extent == EXTENT_FULL)) {
        measure_stages(c);
    }
    if (!convex) {
        measure_methods(c);
    }
    measure_facet(c, convex);
    bench_table_scene(&c->job->table, first);
    free(bytes);
    free(prepared);
}

/* ---- which scenes ---- */

/* Binary STL, 32 bits little-endian a number whatever the machine. */
static void put_word(FILE *out, uint32_t word)
{
    for (int k = 0; k < 4; k++) {
        fputc((int)(word >> 8 * k & 0xff), out);
    }
}

static void stl_write(const lrcs_scene *scene, FILE *out)
{
    static const char head[80] = "a generated satellite";
    fwrite(head, 1, sizeof head, out);
    put_word(out, scene->facet_count);
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        for (int k = 0; k < 12; k++) {
            const double *x = scene->vertex[scene->facet[f].corner[k < 3 ? 0 : k / 3 - 1]].x;
            float coordinate = k < 3 ? 0.0f : (float)x[k % 3];
            uint32_t word;
            memcpy(&word, &coordinate, sizeof word);
            put_word(out, word);
        }
        fputc(0, out);
        fputc(0, out);
    }
}

/* Reads a model file `count` times. The scene read last stays. */
static void model_load(const char *path, int count, lrcs_host_scene *scene, bench_times *load)
{
    lrcs_host_options options = lrcs_host_options_default();
    lrcs_host_error error;
    for (int i = 0; i < count; i++) {
        lrcs_host_scene_free(scene);
        *scene = (lrcs_host_scene){.blocks = NULL};
        double start = bench_now_ms();
        if (lrcs_host_scene_read(path, &options, scene, &error) != LRCS_OK) {
            fprintf(stderr, "bench: %s\n", error.text);
            exit(1);
        }
        bench_add(load, bench_now_ms() - start);
    }
}

/* What loading the scene from an STL file takes. */
static void scratch_load(const bench_case *c, bench_times *load)
{
    lrcs_host_scene scene = {.blocks = NULL};
    FILE *out = c->job->scratch ? fopen(c->job->scratch, "wb") : NULL;
    if (!out) {
        return;
    }
    stl_write(c->scene, out);
    if (fclose(out) == 0) {
        model_load(c->job->scratch, rounds_of(c), &scene, load);
    }
    lrcs_host_scene_free(&scene);
    remove(c->job->scratch);
}

static void measure_made(bench_job *job, int size, int convex)
{
    char name[BENCH_NAME];
    bench_scene made;
    bench_times load = {.count = 0};
    if (convex) {
        bench_cushion(&made, cushion_sizes[size]);
    } else {
        bench_satellite(&made, satellite_sizes[size]);
    }
    snprintf(name, sizeof name, "%s %lu", convex ? "convex" : "satellite",
             (unsigned long)made.scene.facet_count);
    bench_case c = {.job = job, .name = name, .scene = &made.scene, .size = convex ? -1 : size};
    if (!convex) {
        scratch_load(&c, &load);
    }
    case_measure(&c, convex, &load);
    bench_scene_free(&made);
}

static void measure_model(bench_job *job, const char *path)
{
    const char *name = strrchr(path, '/');
    lrcs_host_scene scene = {.blocks = NULL};
    bench_times load = {.count = 0};
    model_load(path, job->extent == EXTENT_FULL ? 3 : 1, &scene, &load);
    bench_case c = {.job = job, .name = name ? name + 1 : path, .scene = &scene.scene, .size = -1};
    case_measure(&c, 0, &load);
    lrcs_host_scene_free(&scene);
}

/* ---- the whole ---- */

/* Options stand before models. Returned: the first model's place. */
static int arguments_read(bench_job *job, int count, char **argument)
{
    int i = 1;
    for (; i < count && strncmp(argument[i], "--", 2) == 0; i++) {
        const char **value = strcmp(argument[i], "--csv") == 0       ? &job->csv
                             : strcmp(argument[i], "--plot") == 0    ? &job->plot
                             : strcmp(argument[i], "--scratch") == 0 ? &job->scratch
                                                                     : NULL;
        if (strcmp(argument[i], "--quick") == 0 || strcmp(argument[i], "--tiny") == 0) {
            job->extent = argument[i][2] == 'q' ? EXTENT_QUICK : EXTENT_TINY;
        } else if (value && i + 1 < count) {
            *value = argument[++i];
        } else {
            fprintf(stderr, "usage: bench [--quick | --tiny] [--csv FILE] [--plot FILE.svg] "
                            "[--scratch FILE.stl] [MODEL ..]\n");
            exit(2);
        }
    }
    return i;
}

static void output_write(const bench_table *table, const char *path, int chart)
{
    lrcs_host_output output;
    lrcs_host_error error;
    if (!path) {
        return;
    }
    int status = lrcs_host_output_open(path, &output, &error);
    if (status == LRCS_OK) {
        if (chart) {
            bench_table_chart(table, "satellite ", "convex ", output.stream);
        } else {
            bench_table_csv(table, output.stream);
        }
        status = lrcs_host_output_close(&output, 1, &error);
    }
    if (status != LRCS_OK) {
        fprintf(stderr, "bench: %s\n", error.text);
        exit(1);
    }
    printf("%s: written\n", path);
}

int main(int count, char **argument)
{
    static bench_job job = {.extent = EXTENT_FULL};
    int model = arguments_read(&job, count, argument);
    int first = job.extent == EXTENT_TINY ? 0 : 1;
    int end = job.extent == EXTENT_TINY ? 2 : job.extent == EXTENT_QUICK ? 3 : SIZES;
    bench_machine(stdout, "");
    for (int size = first; size < end; size++) {
        measure_made(&job, size, 0);
        measure_made(&job, size, 1);
    }
    if (model == count) {
        printf("\nmodels: none given, skipped\n");
    }
    for (; model < count; model++) {
        measure_model(&job, argument[model]);
    }
    bench_table_poses(&job.table);
    output_write(&job.table, job.csv, 0);
    output_write(&job.table, job.plot, 1);
    return 0;
}
