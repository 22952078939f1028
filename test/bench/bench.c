/* SPDX-License-Identifier: MIT */
/* What loading, preparing and whole poses cost on this machine: models named on the command line,
   generated satellites, a space station stored with single and with doubled faces, a mesh with one
   very distant vertex, scenes that are hard for exact visibility (measure_cases); beside other
   engines (peers.h).
   Medians over directions all around, every cell of the table in a process of its own under a time
   limit. It decides what is measured. */
#include <lrcs/host.h>

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "bench/peers.h"
#include "bench/rows.h"
#include "bench/scenes.h"

static const char usage[] =
    "usage: bench [--quick | --tiny] [--only TEXT] [--limit S] [--csv FILE] [--plot FILE.svg]\n"
    "             [--peers FOLDER] [--cases FOLDER] [--scratch FOLDER] [MODEL ..]\n"
    "  --quick    about a minute: fewer directions, no scene above 100,000 facets\n"
    "  --tiny     small scenes and one direction, for the tool's own test\n"
    "  --only     scenes whose name contains TEXT\n"
    "  --limit    seconds that a cell may take (20; quick: 3)\n"
    "  --peers    where gl_lrcs and embree_lrcs are built\n"
    "  --cases    where hatch.py, stack.py, book.py and star.py are\n"
    "  --scratch  where models may be written (/tmp)\n";

/* How much is measured. */
enum bench_extent { EXTENT_TINY, EXTENT_QUICK, EXTENT_FULL, EXTENTS };

typedef struct bench_job {
    int extent;
    const char *only, *csv, *plot, *peers, *cases, *scratch;
    double limit; /* s a cell */
    bench_table table;
} bench_job;

/* A scene under measurement. */
typedef struct bench_case {
    bench_job *job;
    const char *name;
    const double *view; /* the one direction it is seen from; NULL: all around */
    lrcs_host_scene scene;
    lrcs_run_options options; /* of the column under measurement */
} bench_case;

/* The parts of a pose that are measured. */
typedef struct bench_column {
    const char *name;
    int method;
    uint32_t resolution;
    double tolerance;
    int accept;
} bench_column;

static const bench_column columns[] = {
    {"facet", LRCS_METHOD_FACET, 0, 1e-4, LRCS_ACCEPT_BOUND},
    {"zbuffer 512", LRCS_METHOD_ZBUFFER, 512, 1e-4, LRCS_ACCEPT_BOUND},
    {"zbuffer 1024", LRCS_METHOD_ZBUFFER, 1024, 1e-4, LRCS_ACCEPT_BOUND},
    {"exact", LRCS_METHOD_EXACT, 0, 1e-4, LRCS_ACCEPT_BOUND},
    {"auto 1e-1", LRCS_METHOD_AUTO, 0, 1e-1, LRCS_ACCEPT_BOUND},
    {"auto 1e-2", LRCS_METHOD_AUTO, 0, 1e-2, LRCS_ACCEPT_BOUND},
    {"auto 1e-3", LRCS_METHOD_AUTO, 0, 1e-3, LRCS_ACCEPT_BOUND},
    {"auto 1e-4", LRCS_METHOD_AUTO, 0, 1e-4, LRCS_ACCEPT_BOUND},
    {"estimate 1e-2", LRCS_METHOD_AUTO, 0, 1e-2, LRCS_ACCEPT_ESTIMATE},
    {"estimate 1e-3", LRCS_METHOD_AUTO, 0, 1e-3, LRCS_ACCEPT_ESTIMATE},
};
enum { COLUMNS = sizeof columns / sizeof columns[0] };

/* ---- cells ---- */

/* After this long, in ms, a cell that has a steady sample is done. */
static const double enough_ms[EXTENTS] = {0, 250, 2500};

static void scene_read(const char *path, lrcs_host_scene *scene)
{
    lrcs_host_options options = lrcs_host_options_default();
    lrcs_host_error error;
    *scene = (lrcs_host_scene){.blocks = NULL};
    if (lrcs_host_scene_read(path, &options, scene, &error) != LRCS_OK) {
        fprintf(stderr, "bench: %s\n", error.text);
        exit(1);
    }
}

static void sample_stop(bench_sample *sample)
{
    sample->cpu = bench_now_ms() - sample->cpu;
    sample->wall = bench_wall_ms() - sample->wall;
}

/* Loading reads the file anew each time. */
typedef struct load_step {
    const bench_case *c;
    const char *path;
} load_step;

static int load_measure(void *context, bench_cell_put *put, void *to)
{
    const load_step *step = context;
    double spent = 0;
    for (int i = 0; i < 3 && (i < 1 || spent < enough_ms[step->c->job->extent]); i++) {
        lrcs_host_scene scene;
        bench_sample sample = {.cpu = bench_now_ms(), .wall = bench_wall_ms()};
        scene_read(step->path, &scene);
        sample_stop(&sample);
        put(to, &sample);
        spent += sample.wall;
        lrcs_host_scene_free(&scene);
    }
    return LRCS_OK;
}

/* Preparing uses memory that nothing has used before, as a program does that prepares once. */
static int prepare_measure(void *context, bench_cell_put *put, void *to)
{
    bench_case *c = context;
    double spent = 0;
    int status = LRCS_OK;
    for (int i = 0; i < 3 && (i < 1 || spent < enough_ms[c->job->extent]) && status == LRCS_OK;
         i++) {
        bench_sample sample = {.cpu = bench_now_ms(), .wall = bench_wall_ms()};
        status = lrcs_host_scene_prepare(&c->scene, NULL);
        sample_stop(&sample);
        put(to, &sample);
        spent += sample.wall;
    }
    return status;
}

static lrcs_pose case_pose(const bench_case *c, int direction)
{
    lrcs_pose pose = bench_pose(direction);
    if (c->view) {
        lrcs_pose_from_direction(c->view, &pose);
    }
    return pose;
}

/* A pose in a work area that grows until it suffices. */
static int pose_run(const bench_case *c, int direction, lrcs_work *work, lrcs_result *result)
{
    const lrcs_prepared *prepared = c->scene.prepared;
    lrcs_pose pose = case_pose(c, direction);
    for (;;) {
        int status = lrcs_sigma_run(prepared, &pose, &c->options, work, result, NULL, NULL);
        int degraded = status == LRCS_OK && (result->flags & LRCS_FLAG_MEMORY_FALLBACK);
        if (status != LRCS_E_MEMORY && !degraded) {
            return status;
        }
        size_t size = 2 * work->size;
        free(work->bytes);
        *work = lrcs_work_make(bench_memory(size), size);
    }
}

/* The time of a pose in a work area that has never been used: fresh pages from the system, since
   malloc may return used ones. 0 if the pose failed. */
static double first_measure(const bench_case *c, int direction, size_t size)
{
    int zero = open("/dev/zero", O_RDWR);
    void *bytes = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE, zero, 0);
    close(zero);
    if (bytes == MAP_FAILED) {
        return 0;
    }
    lrcs_work work = lrcs_work_make(bytes, size);
    lrcs_pose pose = case_pose(c, direction);
    lrcs_result result;
    double start = bench_now_ms();
    int status = lrcs_sigma_run(c->scene.prepared, &pose, &c->options, &work, &result, NULL, NULL);
    double end = bench_now_ms();
    munmap(bytes, size);
    return status == LRCS_OK ? end - start : 0;
}

/* The first pose warms up; of each later one, how long it takes in a work area that has been used,
   and how long in a fresh one. */
static int poses_measure(void *context, bench_cell_put *put, void *to)
{
    bench_case *c = context;
    size_t size = lrcs_sigma_need(c->scene.prepared, &c->options);
    lrcs_work work = lrcs_work_make(bench_memory(size), size);
    double spent = 0;
    int status = LRCS_OK;
    for (int i = -1; i < BENCH_TIMES && status == LRCS_OK; i++) {
        lrcs_result result;
        if (i > 0 && (spent >= enough_ms[c->job->extent] || (c->view && i >= 3) ||
                      (i >= BENCH_DIRECTIONS && c->job->extent != EXTENT_FULL))) {
            break;
        }
        if (i >= 0) { /* first_measure leaves its own memory in the caches */
            (void)pose_run(c, (i + 1) % BENCH_DIRECTIONS, &work, &result);
        }
        bench_sample sample = {.cpu = bench_now_ms(), .wall = bench_wall_ms()};
        status = pose_run(c, i < 0 ? 0 : i % BENCH_DIRECTIONS, &work, &result);
        sample_stop(&sample);
        if (status == LRCS_OK) {
            sample.bytes = (double)work.peak;
            sample.bound = result.sigma_m2 > 0 ? result.bound_m2 / result.sigma_m2 : 0;
            sample.estimate = result.sigma_m2 > 0 ? result.estimate_m2 / result.sigma_m2 : 0;
            sample.first = i < 0 ? sample.cpu : first_measure(c, i % BENCH_DIRECTIONS, work.size);
            put(to, &sample);
            spent += sample.wall + sample.first;
        }
    }
    return status;
}

/* ---- one scene ---- */

static const bench_row *case_row(const bench_case *c, const char *what, const bench_cell *cell,
                                 int warm)
{
    const bench_row *row =
        bench_row_add(&c->job->table, c->name, &c->scene.scene, what, cell, warm);
    fprintf(stderr, "  %-14s %10.4g ms%s\n", what, row->ms,
            row->end == BENCH_DONE       ? ""
            : row->end == BENCH_TOO_LONG ? ", ended at the limit"
                                         : ", failed");
    return row;
}

/* Binary STL, 32 bits little-endian a number whatever the machine. */
static void put_word(FILE *out, uint32_t word)
{
    for (int k = 0; k < 4; k++) {
        fputc((int)(word >> 8 * k & 0xff), out);
    }
}

static void stl_write(const lrcs_scene *scene, const char *path)
{
    static const char head[80] = "a scene of lrcs";
    FILE *out = fopen(path, "wb");
    if (!out) {
        fprintf(stderr, "bench: %s cannot be written\n", path);
        exit(1);
    }
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
    fclose(out);
}

static const char *scratch_path(const bench_job *job, const char *end, char path[1024])
{
    snprintf(path, 1024, "%s/lrcs_bench_%ld.%s", job->scratch, (long)getpid(), end);
    return path;
}

static void measure_peers(const bench_case *c)
{
    char path[1024];
    scratch_path(c->job, "peer.stl", path);
    stl_write(&c->scene.scene, path);
    bench_cell cell;
    bench_cell tree = {.count = 0};
    double build;
    bench_peer_run(c->job->peers, BENCH_LLVMPIPE, path, 1024, c->job->limit, &cell, &build);
    case_row(c, "llvmpipe 1024", &cell, 0);
    for (int i = 0; i < 3; i++) { /* a tree is built once a run */
        bench_peer_run(c->job->peers, BENCH_EMBREE, path, 1024, c->job->limit, &cell, &build);
        tree.sample[tree.count].wall = build;
        tree.count += build > 0;
    }
    tree.end = cell.end;
    case_row(c, "Embree 1024", &cell, 0);
    case_row(c, "Embree tree", &tree, 0);
    remove(path);
}

/* A scene from a file, measured in the order of the table's columns. */
static void measure_file(bench_job *job, const char *name, const char *path, const double *view)
{
    bench_case c = {.job = job, .name = name, .view = view};
    load_step load = {&c, path};
    bench_cell cell;
    scene_read(path, &c.scene);
    if (job->extent == EXTENT_QUICK && c.scene.scene.facet_count > 100000) {
        lrcs_host_scene_free(&c.scene);
        return;
    }
    fprintf(stderr, "%s: %lu facets\n", name, (unsigned long)c.scene.scene.facet_count);
    bench_cell_run(load_measure, &load, job->limit, &cell);
    case_row(&c, "load", &cell, 0);
    bench_cell_run(prepare_measure, &c, job->limit, &cell);
    int prepared = case_row(&c, "prepare", &cell, 0)->end == BENCH_DONE &&
                   lrcs_host_scene_prepare(&c.scene, NULL) == LRCS_OK;
    for (int k = 0; k < COLUMNS && prepared; k++) {
        c.options = lrcs_run_options_default();
        c.options.method = columns[k].method;
        c.options.resolution = columns[k].resolution;
        c.options.tolerance = columns[k].tolerance;
        c.options.accept = columns[k].accept;
        bench_cell_run(poses_measure, &c, job->limit, &cell);
        case_row(&c, columns[k].name, &cell, 1);
    }
    if (job->peers && !view) { /* they look from all around */
        measure_peers(&c);
    }
    lrcs_host_scene_free(&c.scene);
}

/* ---- which scenes ---- */

static int wanted(const bench_job *job, const char *name)
{
    return !job->only || strstr(name, job->only);
}

/* A generated scene: written to a file first, and then read as any model. */
static void measure_made(bench_job *job, const char *name, bench_scene *made)
{
    char path[1024];
    scratch_path(job, "stl", path);
    stl_write(&made->scene, path);
    bench_scene_free(made);
    measure_file(job, name, path, NULL);
    remove(path);
}

static void measure_satellites(bench_job *job)
{
    static const char *const name[] = {"satellite 2.6 k", "satellite 39 k", "satellite 440 k"};
    static const uint32_t size[] = {5, 19, 64};
    bench_scene made;
    int first = job->extent == EXTENT_TINY ? 0 : 1;
    int end = job->extent == EXTENT_TINY ? 1 : job->extent == EXTENT_QUICK ? 2 : 3;
    for (int k = first; k < end; k++) {
        if (wanted(job, name[k])) {
            bench_satellite(&made, size[k]);
            measure_made(job, name[k], &made);
        }
    }
}

/* Cases that the satellites do not cover: a body proved convex, modules that intersect, the same
   with every face stored twice, one vertex so far away that it sets the scale. */
static void measure_special(bench_job *job)
{
    int tiny = job->extent == EXTENT_TINY;
    bench_scene made;
    if (wanted(job, "convex body")) {
        bench_cushion(&made, tiny ? 4 : 49);
        measure_made(job, "convex body", &made);
    }
    for (int doubled = 0; doubled < 2; doubled++) {
        const char *name = doubled ? "station with doubled faces" : "station";
        if (wanted(job, name)) {
            bench_station(&made, tiny ? 1 : 8, doubled);
            measure_made(job, name, &made);
        }
    }
    if (wanted(job, "one vertex 1e22 m away")) {
        bench_far(&made, tiny ? 2 : 10);
        measure_made(job, "one vertex 1e22 m away", &made);
    }
}

/* Scenes in which very many surfaces overlap, each from one direction: n horizontal strips in front
   of n vertical ones (hatch), n equal triangles 1e-6 m apart (stack), n pages around one spine
   (book), the wall of a zigzag cylinder with 2 n points (star). NAME.py in the folder of --cases
   writes each as OBJ for a given n; scenes whose program is not there are left out. */
static void measure_cases(bench_job *job)
{
    static const struct {
        const char *program;
        int count[EXTENTS];
        double view[3];
    } generator[] = {{"hatch", {10, 100, 300}, {0, 0, 1}},
                     {"stack", {10, 300, 1000}, {0.3, 0.2, 0.9}},
                     {"book", {10, 300, 1000}, {0.3, 0.2, 0.9}},
                     {"star", {10, 300, 1000}, {0.3, 0.2, 0.9}}};
    for (int k = 0; k < 4 && job->cases; k++) {
        char path[1024];
        char command[4096];
        char name[BENCH_NAME];
        snprintf(name, sizeof name, "%s %d", generator[k].program, generator[k].count[job->extent]);
        snprintf(command, sizeof command, "python3 '%s/%s.py' %d >'%s' 2>/dev/null", job->cases,
                 generator[k].program, generator[k].count[job->extent],
                 scratch_path(job, "obj", path));
        if (wanted(job, name) && system(command) == 0) {
            measure_file(job, name, path, generator[k].view);
        }
        remove(path);
    }
}

static void measure_models(bench_job *job, char **model, int count)
{
    for (int i = 0; i < count; i++) {
        const char *slash = strrchr(model[i], '/');
        const char *name = slash ? slash + 1 : model[i];
        if (wanted(job, name)) {
            measure_file(job, name, model[i], NULL);
        }
    }
}

/* ---- the whole ---- */

/* Options stand before models. Returned: the first model's place. */
static int arguments_read(bench_job *job, int count, char **argument)
{
    const char *limit = NULL;
    const struct {
        const char *name, **value;
    } option[] = {{"--only", &job->only},   {"--csv", &job->csv},     {"--plot", &job->plot},
                  {"--peers", &job->peers}, {"--cases", &job->cases}, {"--scratch", &job->scratch},
                  {"--limit", &limit}};
    int i = 1;
    for (; i < count && strncmp(argument[i], "--", 2) == 0; i++) {
        const char **value = NULL;
        for (size_t k = 0; k < sizeof option / sizeof option[0]; k++) {
            value = strcmp(argument[i], option[k].name) == 0 ? option[k].value : value;
        }
        if (strcmp(argument[i], "--quick") == 0 || strcmp(argument[i], "--tiny") == 0) {
            job->extent = argument[i][2] == 'q' ? EXTENT_QUICK : EXTENT_TINY;
        } else if (value && i + 1 < count) {
            *value = argument[++i];
        } else {
            fputs(usage, stderr);
            exit(2);
        }
    }
    job->limit = limit ? strtod(limit, NULL) : job->extent == EXTENT_FULL ? 20 : 3;
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
            bench_table_chart(table, output.stream);
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
    static bench_job job = {.extent = EXTENT_FULL, .scratch = "/tmp"};
    int model = arguments_read(&job, count, argument);
    bench_machine(stdout, "");
    measure_models(&job, argument + model, count - model);
    measure_satellites(&job);
    measure_special(&job);
    measure_cases(&job);
    bench_table_print(&job.table, job.limit);
    output_write(&job.table, job.csv, 0);
    output_write(&job.table, job.plot, 1);
    return 0;
}
