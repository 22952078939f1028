/* SPDX-License-Identifier: MIT */
/* Every function of the host layer, with its allocations refused: each one alone, and each one with
   all that follow, or every fourth where that takes long. It succeeds, or returns LRCS_E_SYSTEM and
   says why; nothing leaks; an answer is the one that memory gives, or contains it. The linker passes
   the library's allocations through this file (see the Makefile). */
#include <lrcs/picture.h>
#include <lrcs/shares.h>
#include <lrcs/sweep.h>

#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "check.h"

/* --- the allocations -------------------------------------------------------------------------- */

static atomic_long asked, held;        /* allocations so far; blocks not yet freed */
static long refuse_first, refuse_last; /* allocations that are refused, from 1; 0: none */
static int paused;                     /* allocations are neither counted nor refused */

/* NOLINTBEGIN(bugprone-reserved-identifier): the linker's names */
void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
void __real_free(void *block);
char *__real_strdup(const char *text);
char *__real_realpath(const char *path, char *resolved);
FILE *__real_fdopen(int descriptor, const char *mode);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);
void __wrap_free(void *block);
char *__wrap_strdup(const char *text);
char *__wrap_realpath(const char *path, char *resolved);
FILE *__wrap_fdopen(int descriptor, const char *mode);

static int refused(void)
{
    if (paused) {
        return 0;
    }
    long number = atomic_fetch_add(&asked, 1) + 1;
    int refuse = number >= refuse_first && number <= refuse_last;
    errno = refuse ? ENOMEM : errno;
    return refuse;
}

static void *counted(void *block)
{
    atomic_fetch_add(&held, block != NULL);
    return block;
}

void *__wrap_malloc(size_t size)
{
    return refused() ? NULL : counted(__real_malloc(size));
}

void *__wrap_calloc(size_t count, size_t size)
{
    return refused() ? NULL : counted(__real_calloc(count, size));
}

void *__wrap_realloc(void *block, size_t size)
{
    if (refused()) {
        return NULL;
    }
    return block ? __real_realloc(block, size) : counted(__real_malloc(size));
}

void __wrap_free(void *block)
{
    atomic_fetch_sub(&held, block != NULL);
    __real_free(block);
}

char *__wrap_strdup(const char *text)
{
    return refused() ? NULL : counted(__real_strdup(text));
}

char *__wrap_realpath(const char *path, char *resolved)
{
    return refused() ? NULL : counted(__real_realpath(path, resolved));
}

FILE *__wrap_fdopen(int descriptor, const char *mode)
{
    return refused() ? NULL : __real_fdopen(descriptor, mode); /* fclose frees it */
}
/* NOLINTEND(bugprone-reserved-identifier) */

/* --- operations ------------------------------------------------------------------------------- */

/* What an operation gave: a hash of all of it, and sigma of its poses, each with its bound. */
typedef struct outcome {
    uint64_t hash;
    double sigma[4], bound[4];
    int poses;
} outcome;

/* Frees what it makes. Status: that of the first function that fails, with its sentence. */
typedef int operation(outcome *got);

static lrcs_host_error error;
static lrcs_host_scene demo;  /* prepared */
static lrcs_host_scene parts; /* its recipe makes others */
static lrcs_pose pose;
static lrcs_result result;
static lrcs_facet_record *records;
static lrcs_host_glint *glint;
static uint32_t glints;
static uint32_t seen[256 * 256];
static int finer; /* runs at finer divisions in the last sweep or refinement */
static char folder[] = "/tmp/lrcs-test-XXXXXX";
static char text_file[64], obj_file[64], mtl_file[64], csv_file[64], out_file[64];

static void hash_bytes(outcome *got, const void *bytes, size_t size)
{
    const unsigned char *at = bytes;
    for (size_t i = 0; i < size; i++) {
        got->hash = (got->hash ^ at[i]) * UINT64_C(0x100000001b3);
    }
}

static void pose_take(outcome *got, const lrcs_result *one)
{
    got->sigma[got->poses] = one->sigma_m2;
    got->bound[got->poses++] = one->bound_m2;
}

/* A scene from a file, up to a pose. */
static int read_prepare_run(const char *path, const lrcs_host_options *options, outcome *got)
{
    lrcs_host_scene scene;
    lrcs_run_options run = lrcs_run_options_default();
    int status = lrcs_host_scene_read(path, options, &scene, &error);
    if (status != LRCS_OK) {
        assert_null(scene.blocks); /* nothing to free */
        return status;
    }
    status = lrcs_host_scene_prepare(&scene, &error);
    uint64_t hash = lrcs_scene_hash(&scene.scene);
    hash_bytes(got, &hash, sizeof hash);
    if (status == LRCS_OK) {
        status = lrcs_host_scene_run(&scene, &pose, &run, &result, NULL, NULL, NULL, &error);
        pose_take(got, &result);
    }
    lrcs_host_scene_free(&scene);
    return status;
}

static int demo_is_read(outcome *got)
{
    lrcs_host_options options = lrcs_host_options_default();
    options.build.division = LRCS_HOST_DIVISION;
    return read_prepare_run("demo", &options, got);
}

/* A scene file with a model that has a material file, and bindings by patterns. */
static int model_is_read(outcome *got)
{
    lrcs_host_options options = lrcs_host_options_default();
    lrcs_binding binding[2] = {{.kind = LRCS_BIND_NAME, .name = "p*", .two_sided = -1},
                               {.kind = LRCS_BIND_DEFAULT, .two_sided = -1}};
    binding[0].brdf = binding[1].brdf = lrcs_brdf_default();
    options.binding = binding;
    options.binding_count = 2;
    options.two_sided = "open";
    return read_prepare_run(text_file, &options, got);
}

static int scene_is_made_and_varied(outcome *got)
{
    lrcs_host_scene made;
    lrcs_host_scene varied;
    lrcs_build_options build = lrcs_build_options_default();
    build.division = LRCS_HOST_DIVISION;
    int status = lrcs_host_scene_make(&parts.recipe, &build, &made, &error);
    if (status != LRCS_OK) {
        assert_null(made.blocks);
        return status;
    }
    status = lrcs_host_scene_vary(&made, &parts.recipe, &build, &varied, &error);
    if (status == LRCS_OK) {
        uint64_t hash = lrcs_scene_hash(&varied.scene);
        hash_bytes(got, &hash, sizeof hash);
        lrcs_host_scene_free(&varied);
    }
    lrcs_host_scene_free(&made);
    return status;
}

static int pose_is_run(outcome *got)
{
    lrcs_run_options run = lrcs_run_options_default();
    lrcs_image image = {.size = 64, .facet = seen};
    int status = lrcs_host_scene_run(&demo, &pose, &run, &result, records, &image, NULL, &error);
    if (status == LRCS_OK) {
        pose_take(got, &result);
    }
    return status;
}

static int uncertainty_is_run(outcome *got)
{
    lrcs_run_options run = lrcs_run_options_default();
    lrcs_uncertainty_options how = lrcs_uncertainty_options_default();
    lrcs_sensitivity sensitivity[64];
    lrcs_uncertainty uncertainty;
    how.draws = 16;
    assert_true(demo.scene.material_count <= 64);
    int status = lrcs_host_scene_uncertainty(&demo, &pose, &run, &how, &result, sensitivity,
                                             &uncertainty, &error);
    if (status == LRCS_OK) {
        pose_take(got, &result);
    }
    return status;
}

static int slope_is_run(outcome *got)
{
    lrcs_run_options run = lrcs_run_options_default();
    lrcs_attitude_slope slope;
    int status = lrcs_host_scene_attitude_slope(&demo, &pose, &run, &slope, &error);
    for (int i = 0; status == LRCS_OK && i < 2; i++) {
        got->sigma[got->poses] = slope.per_deg_m2[i];
        got->bound[got->poses++] = slope.bound_m2[i];
    }
    return status;
}

static int stages_are_run(outcome *got)
{
    lrcs_run_options run = lrcs_run_options_default();
    double seconds;
    run.method = LRCS_METHOD_EXACT;
    int status = lrcs_host_scene_forecast(&demo, &pose, &run, 1, &seconds, &error);
    if (status == LRCS_OK) {
        hash_bytes(got, &seconds, sizeof seconds);
        status = lrcs_host_scene_run_until(&demo, &pose, &run, LRCS_HOST_POSE_SUM, &error);
    }
    return status;
}

static int hardware_is_emulated(outcome *got)
{
    lrcs_emulation_options options = lrcs_emulation_options_default();
    lrcs_emulation emulation;
    options.resolution = 64;
    int status = lrcs_host_scene_emulate(&demo, &pose, &options, &emulation, NULL, NULL, &error);
    if (status == LRCS_OK) {
        hash_bytes(got, &emulation.sigma_m2, sizeof emulation.sigma_m2);
    }
    return status;
}

static int polygons_are_made(outcome *got)
{
    lrcs_host_polygons polygons;
    int status = lrcs_host_polygons_make(&demo, &pose, &polygons, &error);
    if (status == LRCS_OK) {
        hash_bytes(got, polygons.list.point, polygons.list.points * sizeof *polygons.list.point);
        lrcs_host_polygons_free(&polygons);
    }
    return status;
}

static int profile_is_made(outcome *got)
{
    lrcs_host_profile profile;
    int status = lrcs_host_profile_make(&demo, &pose, 0.1, &profile, &error);
    if (status == LRCS_OK) {
        hash_bytes(got, profile.list.bin, profile.list.count * sizeof *profile.list.bin);
        lrcs_host_profile_free(&profile);
    }
    return status;
}

static int shares_are_made(outcome *got)
{
    lrcs_host_shares shares;
    int status =
        lrcs_host_shares_make(&demo, &demo.scene, records, result.sigma_m2, &shares, &error);
    for (uint32_t i = 0; status == LRCS_OK && i < shares.parts; i++) {
        hash_bytes(got, shares.part[i].name, strlen(shares.part[i].name));
        hash_bytes(got, &shares.part[i].sigma_m2, sizeof(double));
    }
    assert_true(status == LRCS_OK || (!shares.part && !shares.material));
    lrcs_host_shares_free(&shares);
    return status;
}

static int glint_is_checked(outcome *got)
{
    lrcs_host_glint *list = NULL;
    uint32_t count = 0;
    int status = lrcs_host_glint_check(&demo.scene, &list, &count, &error);
    if (status == LRCS_OK) {
        hash_bytes(got, list, count * sizeof *list);
        free(list);
    }
    return status;
}

/* --- pictures, charts, files ------------------------------------------------------------------ */

/* A stream in memory, from libc's own allocations. */
static char *page;
static size_t page_size;

static FILE *page_open(void)
{
    FILE *out = open_memstream(&page, &page_size);
    assert_non_null(out);
    return out;
}

static void page_close(FILE *out, outcome *got)
{
    fclose(out);
    hash_bytes(got, page, page_size);
    __real_free(page);
}

static lrcs_host_picture picture_make(void)
{
    return (lrcs_host_picture){.scene = &demo.scene,
                               .pose = &pose,
                               .records = records,
                               .title = "t",
                               .colouring = LRCS_HOST_BY_MATERIAL,
                               .annotated = 1};
}

static int picture_is_written(outcome *got)
{
    lrcs_host_picture picture = picture_make();
    lrcs_image image = {.size = lrcs_host_picture_need(&picture, 64), .facet = seen, .side_m = 1.0};
    assert_true(image.size <= 256);
    FILE *out = page_open();
    int status = lrcs_host_picture_png(out, &picture, &image, 64, &error);
    page_close(out, got);
    return status;
}

static int chart_is_written(outcome *got)
{
    static const double x[] = {0, 30, 60, 90}, y[] = {1, 4, 2, 8};
    const lrcs_host_series series = {.name = "s", .count = 4, .x = x, .y = y};
    const lrcs_host_chart chart = {.title = "t",
                                   .x_name = "x",
                                   .y_name = "y",
                                   .series = &series,
                                   .series_count = 1,
                                   .about = "a"};
    FILE *out = page_open();
    int status = lrcs_host_chart_png(out, &chart, &error);
    page_close(out, got);
    return status;
}

static int map_is_written(outcome *got)
{
    static const double at[] = {-90, 0, 90}, z[] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    const lrcs_host_map map = {.title = "t",
                               .x_name = "x",
                               .y_name = "y",
                               .z_name = "z",
                               .columns = 3,
                               .rows = 3,
                               .x = at,
                               .y = at,
                               .z = z};
    FILE *out = page_open();
    int status = lrcs_host_map_png(out, &map, &error);
    page_close(out, got);
    return status;
}

/* Drawings as text have no status: without memory they are complete but for what it was for. */
static int drawings_are_written(outcome *got)
{
    lrcs_host_picture picture = picture_make();
    lrcs_ring_point corner[3] = {{.view = {0, 0}}, {.view = {1, 0}}, {.view = {0, 1}}};
    lrcs_ring ring = {.count = 3};
    lrcs_polygons polygons = {.ring = &ring, .point = corner, .rings = 1, .points = 3};
    FILE *out = page_open();
    lrcs_host_picture_svg(out, &picture, &polygons);
    lrcs_host_vtk_write(out, &picture, 1);
    fflush(out);
    assert_non_null(strstr(page, "</svg>"));
    assert_non_null(strstr(page, "</VTKFile>"));
    page_close(out, got);
    return LRCS_OK;
}

static int readings_are_read(outcome *got)
{
    lrcs_host_readings readings;
    int status = lrcs_host_readings_read(csv_file, &readings, &error);
    if (status == LRCS_OK) {
        hash_bytes(got, &readings.count, sizeof readings.count);
        hash_bytes(got, readings.name[1], strlen(readings.name[1]) + 1);
        lrcs_host_readings_free(&readings);
    }
    return status;
}

/* A file appears whole, or keeps what it held; nothing else is left in its folder. */
static int file_is_written(outcome *got)
{
    lrcs_host_output output;
    lrcs_host_file file = {NULL, 0};
    int status = lrcs_host_output_open(out_file, &output, &error);
    if (status == LRCS_OK) {
        fputs("whole", output.stream);
        status = lrcs_host_output_close(&output, 1, &error);
    }
    if (status == LRCS_OK) {
        status = lrcs_host_file_read(out_file, &file, &error);
    }
    if (status == LRCS_OK) {
        hash_bytes(got, file.bytes, file.size);
    }
    lrcs_host_file_free(&file);
    return status;
}

/* --- finer divisions and sweeps --------------------------------------------------------------- */

static int pose_at(void *context, uint64_t index, lrcs_pose *at)
{
    (void)context;
    return lrcs_pose_from_azel(5.0 + 2.0 * (double)index, 20.0, at);
}

static int result_take(void *context, uint64_t index, const lrcs_pose *at, const lrcs_result *one,
                       const lrcs_uncertainty *uncertainty, const lrcs_host_glint_sum *sum,
                       lrcs_host_error *failed)
{
    (void)index;
    (void)at;
    (void)uncertainty;
    (void)sum;
    (void)failed;
    finer += one->facets_total > parts.scene.facet_count;
    pose_take(context, one);
    return LRCS_OK;
}

/* The scene whose poses need finer divisions, read and prepared with memory enough. */
static void parts_read(lrcs_host_scene *scene)
{
    lrcs_host_options options = lrcs_host_options_default();
    options.build.division = 0.1;
    paused++;
    assert_int_equal(lrcs_host_scene_read("test/host/refine_parts.toml", &options, scene, &error),
                     LRCS_OK);
    assert_int_equal(lrcs_host_scene_prepare(scene, &error), LRCS_OK);
    paused--;
}

/* Two poses, one for each thread; if a thread cannot be made, both by one. */
static int sweep_is_run(outcome *got)
{
    static const lrcs_uncertainty_options how = {.draws = 0, .seed = 1};
    lrcs_run_options run = lrcs_run_options_default();
    lrcs_host_scene scene;
    lrcs_host_sweep poses = {.count = 2,
                             .threads = 2,
                             .pose = pose_at,
                             .take = result_take,
                             .refine = 1,
                             .uncertainty = &how,
                             .glint = glint,
                             .glint_count = glints,
                             .context = got};
    uint64_t done = 0;
    run.tolerance = 2e-4;
    finer = 0;
    parts_read(&scene);
    int status = lrcs_host_sweep_run(&scene, &run, &poses, &done, &error);
    assert_int_equal(done, got->poses);
    assert_true(done == poses.count || status != LRCS_OK);
    lrcs_host_scene_free(&scene);
    return status;
}

static int scene_is_refined(outcome *got)
{
    lrcs_run_options run = lrcs_run_options_default();
    lrcs_build_options build = lrcs_build_options_default();
    lrcs_host_scene scene;
    lrcs_pose at;
    run.tolerance = 2e-4;
    finer = 0;
    parts_read(&scene);
    assert_int_equal(pose_at(NULL, 0, &at), LRCS_OK);
    int status = lrcs_host_scene_run(&scene, &at, &run, &result, NULL, NULL, NULL, &error);
    while (status == LRCS_OK && lrcs_host_scene_refine(&scene, &run, &result, NULL, &build)) {
        finer++;
        status = lrcs_host_scene_run(&scene, &at, &run, &result, NULL, NULL, NULL, &error);
    }
    if (status == LRCS_OK) {
        pose_take(got, &result);
    }
    lrcs_host_scene_free(&scene);
    return status;
}

/* --- every allocation ------------------------------------------------------------------------- */

static int entries(void)
{
    DIR *dir = opendir(folder);
    int count = 0;
    while (readdir(dir)) {
        count++;
    }
    closedir(dir);
    return count - 2;
}

/* The lowest descriptor that is free. */
static int descriptor_next(void)
{
    int next = dup(STDIN_FILENO);
    close(next);
    return next;
}

/* Runs it with these allocations refused. Returns the number of allocations. */
static long run_refused(operation *run, long first, long last, outcome *got, int *status)
{
    long before = atomic_load(&held);
    int files = entries();
    int descriptor = descriptor_next();
    *got = (outcome){.hash = UINT64_C(0xcbf29ce484222325)};
    error.text[0] = '\0';
    refuse_first = first;
    refuse_last = last;
    atomic_store(&asked, 0);
    *status = run(got);
    refuse_first = refuse_last = 0;
    assert_int_equal(atomic_load(&held), before);
    assert_int_equal(entries(), files);
    assert_int_equal(descriptor_next(), descriptor);
    return atomic_load(&asked);
}

/* Sigma without refusals lies within both bounds, sigma's own and the refused run's. */
static void check_agree(const outcome *got, const outcome *whole)
{
    assert_int_equal(got->poses, whole->poses);
    for (int i = 0; i < got->poses; i++) {
        check_abs(got->sigma[i], whole->sigma[i], got->bound[i] + whole->bound[i]);
    }
}

/* Refuses every allocation alone, and of every `step` the first and all that follow. `same`: an
   answer has the same bytes; else it contains the other. */
static void check_every(operation *run, int same, long step)
{
    outcome whole;
    outcome got;
    int status = LRCS_OK;
    long all = run_refused(run, 0, 0, &whole, &status);
    int failed = 0;
    assert_int_equal(status, LRCS_OK);
    assert_true(all > 0);
    for (int alone = 0; alone < 2; alone++) {
        for (long i = 1; i <= all; i += alone ? 1 : step) {
            run_refused(run, i, alone ? i : LONG_MAX, &got, &status);
            if (status == LRCS_OK) {
                check_agree(&got, &whole);
                assert_true(!same || got.hash == whole.hash);
            } else {
                assert_int_equal(status, LRCS_E_SYSTEM);
                assert_non_null(strstr(error.text, "memory"));
                failed++;
            }
        }
    }
    assert_true(failed > 0 || !same);
    run_refused(run, 0, 0, &got, &status); /* nothing is left of the refusals */
    assert_int_equal(status, LRCS_OK);
    assert_true(got.hash == whole.hash);
    for (int i = 0; i < got.poses; i++) {
        check_same(got.sigma[i], whole.sigma[i]);
    }
}

static void check_refusals(operation *run, int same)
{
    check_every(run, same, 1);
}

static void reading_a_scene_fails_or_gives_the_same_scene(void **state)
{
    (void)state;
    check_refusals(demo_is_read, 1);
    check_refusals(model_is_read, 1);
    check_refusals(scene_is_made_and_varied, 1);
}

static void sigma_without_memory_fails_or_contains_the_truth(void **state)
{
    (void)state;
    check_refusals(pose_is_run, 0);
    check_refusals(uncertainty_is_run, 0);
    check_refusals(slope_is_run, 0);
    check_refusals(stages_are_run, 1);
    check_refusals(hardware_is_emulated, 1);
}

static void lists_fail_or_are_the_same(void **state)
{
    (void)state;
    check_refusals(polygons_are_made, 1);
    check_refusals(profile_is_made, 1);
    check_refusals(shares_are_made, 1);
    check_refusals(glint_is_checked, 1);
}

static void pictures_and_charts_fail_or_are_the_same(void **state)
{
    (void)state;
    check_refusals(picture_is_written, 0);
    check_refusals(chart_is_written, 1);
    check_refusals(map_is_written, 1);
    check_refusals(drawings_are_written, 0);
}

static void files_fail_or_are_whole(void **state)
{
    (void)state;
    check_refusals(readings_are_read, 1);
    check_refusals(file_is_written, 1);
}

static void finer_divisions_fail_or_contain_the_truth(void **state)
{
    (void)state;
    check_every(scene_is_refined, 0, 4);
    assert_true(finer > 0);
    check_every(sweep_is_run, 0, 4);
    assert_true(finer > 0);
}

static int pose_around(void *context, uint64_t index, lrcs_pose *at)
{
    (void)context;
    return lrcs_pose_from_azel(31.0 * (double)index, 14.0 * (double)index - 80.0, at);
}

/* Of levels that no pose uses any more, 32 are kept: 26 tolerances need more. */
static void levels_that_are_kept_are_limited(void **state)
{
    (void)state;
    lrcs_host_options options = lrcs_host_options_default();
    lrcs_run_options run = lrcs_run_options_default();
    lrcs_host_scene scene;
    long one = 0; /* the blocks of a level */
    long most = 0;
    options.build.division = LRCS_HOST_DIVISION;
    run.resolution = 64; /* so that a work area is small */
    assert_int_equal(lrcs_host_scene_read("demo", &options, &scene, &error), LRCS_OK);
    assert_int_equal(lrcs_host_scene_prepare(&scene, &error), LRCS_OK);
    long start = atomic_load(&held);
    for (int t = 0; t < 26; t++) {
        for (int i = 0; i < 8; i++) {
            outcome got = {0};
            lrcs_host_sweep poses = {.first = (uint64_t)i,
                                     .count = 1,
                                     .threads = 1,
                                     .pose = pose_around,
                                     .take = result_take,
                                     .refine = 1,
                                     .context = &got};
            run.tolerance = 1e-2 * pow(0.58, t);
            assert_int_equal(lrcs_host_sweep_run(&scene, &run, &poses, NULL, &error), LRCS_OK);
            long more = atomic_load(&held) - start;
            one = one > 0 ? one : more;
            most = more > most ? more : most;
        }
    }
    assert_int_equal(most, 32 * one);
    lrcs_host_scene_free(&scene);
    assert_true(atomic_load(&held) < start);
}

/* --- what the operations use ------------------------------------------------------------------ */

static void put(char path[64], const char *name, const char *text)
{
    snprintf(path, 64, "%s/%s", folder, name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

/* An open square pyramid of two objects of one name, with two materials; and a plate. */
static void files_put(void)
{
    put(mtl_file, "m.mtl", "newmtl paint\nKd 1 0 0\nnewmtl Plain\nKd 0 1 0\n");
    put(obj_file, "m.obj",
        "mtllib m.mtl\nv 0 0 1\nv 1 1 0\nv -1 1 0\nv -1 -1 0\nv 1 -1 0\ns 1\n"
        "o side\nusemtl paint\nf 1 2 3\nf 1 3 4\no side\nusemtl Plain\nf 1 4 5\nf 1 5 2\n");
    put(text_file, "s.toml",
        "[[part]]\nname = \"model\"\nfile = \"m.obj\"\nunit = \"mm\"\n"
        "[[part]]\nname = \"plate\"\nshape = \"plate\"\nsize = [1, 1]\n");
    put(csv_file, "r.csv", "angle,brdf,material,spare\n0,1,a,0\n10,0.5,b,0\n20,,b,0\n");
    put(out_file, "out", "before");
}

static int all_begin(void **state)
{
    (void)state;
    lrcs_host_options options = lrcs_host_options_default();
    lrcs_run_options run = lrcs_run_options_default();
    if (!mkdtemp(folder) || lrcs_pose_from_azel(30, 20, &pose) != LRCS_OK) {
        return -1;
    }
    files_put();
    parts_read(&parts);
    int status = lrcs_host_scene_read("demo", &options, &demo, &error);
    records = status == LRCS_OK ? calloc(demo.scene.facet_count, sizeof *records) : NULL;
    if (!records || lrcs_host_scene_prepare(&demo, &error) != LRCS_OK ||
        lrcs_host_scene_run(&demo, &pose, &run, &result, records, NULL, NULL, &error) != LRCS_OK) {
        return -1;
    }
    return lrcs_host_glint_check(&demo.scene, &glint, &glints, &error);
}

static int all_end(void **state)
{
    (void)state;
    const char *path[] = {text_file, obj_file, mtl_file, csv_file, out_file};
    for (int i = 0; i < 5; i++) {
        unlink(path[i]);
    }
    lrcs_host_scene_free(&demo);
    lrcs_host_scene_free(&parts);
    free(records);
    free(glint);
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reading_a_scene_fails_or_gives_the_same_scene),
        cmocka_unit_test(sigma_without_memory_fails_or_contains_the_truth),
        cmocka_unit_test(lists_fail_or_are_the_same),
        cmocka_unit_test(pictures_and_charts_fail_or_are_the_same),
        cmocka_unit_test(files_fail_or_are_whole),
        cmocka_unit_test(finer_divisions_fail_or_contain_the_truth),
        cmocka_unit_test(levels_that_are_kept_are_limited),
    };
    return cmocka_run_group_tests(tests, all_begin, all_end);
}
