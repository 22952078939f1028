/* SPDX-License-Identifier: MIT */
/* A scene to sigma by several methods: what a result promises, that the methods' intervals meet,
   that memory is what was said, and that a failure touches nothing. Room for FUZZ_FACETS facets.
   An execution under libFuzzer runs what its bytes choose; one in the tests runs everything. */
#ifndef TEST_FUZZ_SIGMA_H
#define TEST_FUZZ_SIGMA_H

#include <fcntl.h>
#include <float.h>
#include <math.h>
#include <sys/mman.h>
#include <unistd.h>

#include "fuzz.h"

#ifdef FUZZ_CHOOSE
#define fuzz_chosen(choice) (choice)
#else
#define fuzz_chosen(choice) ((void)(choice), 1)
#endif

#define FUZZ_FACETS  512u
#define FUZZ_PICTURE 8u
#define FUZZ_ROOM    ((size_t)1 << 27)

static lrcs_facet_record fuzz_records[FUZZ_FACETS];

/* Work areas at the end of rooms of FUZZ_ROOM bytes, behind which the machine itself refuses every
   access: what is written beyond is seen there with and without AddressSanitizer. */
static unsigned char *prepare_end, *run_end;

static inline lrcs_work fuzz_area_before(unsigned char **end, size_t size)
{
    if (!*end) {
        size_t page = (size_t)sysconf(_SC_PAGESIZE);
        int zeros = open("/dev/zero", O_RDWR); /* no heap: LeakSanitizer reads all of that */
        void *room = mmap(NULL, FUZZ_ROOM + page, PROT_READ | PROT_WRITE, MAP_PRIVATE, zeros, 0);
        require(zeros >= 0 && room != MAP_FAILED);
        *end = (unsigned char *)room + FUZZ_ROOM;
        require(mprotect(*end, page, PROT_NONE) == 0);
    }
    return lrcs_work_make(*end - size, size);
}

/* How a scene is run, from the input. */
typedef struct fuzz_run {
    lrcs_pose pose;
    lrcs_run_options options;
    unsigned methods; /* which ones, bits 1u << LRCS_METHOD_... */
    int polygons;     /* wanted too */
    int short_memory; /* once more by the method of the options, in too little memory, */
    int hurried;      /* or with few steps, the square of `share` */
    unsigned share;   /* of the memory that is needed, in 256ths, for that */
} fuzz_run;

static inline double scene_extent(const lrcs_scene *scene)
{
    double extent = 0;
    for (int k = 0; k < 3; k++) {
        double low = DBL_MAX;
        double high = -DBL_MAX;
        for (uint32_t v = 0; v < scene->vertex_count; v++) {
            low = fmin(low, scene->vertex[v].x[k]);
            high = fmax(high, scene->vertex[v].x[k]);
        }
        extent = fmax(extent, high - low);
    }
    return extent;
}

/* Every facet has its record, and the parts make the whole: to one rounding of each term. */
static inline void require_records(const lrcs_scene *scene, const lrcs_result *r)
{
    double extent = scene_extent(scene);
    long double sum = 0;
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        const lrcs_facet_record *record = &fuzz_records[f];
        double whole = record->area_m2 * fabs(record->cos_theta);
        require(record->area_m2 >= 0 && isfinite(record->area_m2));
        require(fabs(record->cos_theta) <= 1 + 4 * DBL_EPSILON);
        require(record->visible_area_m2 >= 0 && record->sigma_m2 >= 0);
        require(record->visible_area_m2 <= whole * (1 + 1e-12) + 1e-15 * extent * extent);
        sum += record->sigma_m2;
    }
    long double off = fabsl(sum - (long double)r->sigma_m2);
    require(off <= (scene->facet_count + 2) * (long double)DBL_EPSILON * sum + DBL_MIN);
}

static inline void require_result(const lrcs_scene *scene, const lrcs_result *r)
{
    require(r->sigma_m2 >= 0 && isfinite(r->sigma_m2));
    require(r->bound_m2 >= 0 && isfinite(r->bound_m2));
    require(r->sigma_glint_m2 >= 0 && r->sigma_diffuse_m2 >= 0);
    require(r->budget.visibility_m2 >= 0 && r->budget.rounding_m2 >= 0);
    require(isfinite(r->budget.tessellation_m2));
    require(isfinite(r->estimate_m2) && isfinite(r->curvature_estimate_m2));
    require(r->projected_area_m2 >= 0 && isfinite(r->projected_area_m2));
    require(r->back_side_area_m2 >= 0 && isfinite(r->back_side_area_m2));
    require(r->facets_total == scene->facet_count && r->facets_front <= r->facets_total);
    require(r->facets_hidden + r->facets_partial <= r->facets_total);
    require(r->method != LRCS_METHOD_AUTO && lrcs_method_text(r->method) && r->method_reason);
    require_records(scene, r);
}

/* Exactly one verdict on the tolerance applies, and it agrees with the numbers. */
static inline void require_verdict(const lrcs_run_options *options, const lrcs_result *r)
{
    double most = options->tolerance * r->sigma_m2;
    uint32_t estimated = r->flags & LRCS_FLAG_ACCEPTED_BY_ESTIMATE;
    uint32_t unjudged = r->flags & LRCS_FLAG_ACCEPTED_UNJUDGED;
    uint32_t missed = r->flags & LRCS_FLAG_TOLERANCE_NOT_MET;
    int proved = r->bound_m2 <= most && r->curvature_estimate_m2 <= most;
    require(proved + (estimated != 0) + (unjudged != 0) + (missed != 0) == 1);
    require(!estimated || (options->accept != LRCS_ACCEPT_BOUND && r->resolution != 0 &&
                           r->sigma_m2 > 0 && r->estimate_m2 >= 0 && r->estimate_m2 <= most &&
                           !(r->flags & (LRCS_FLAG_DEPTH_UNDECIDED | LRCS_FLAG_STEPS_SPENT))));
    require(!unjudged || options->accept == LRCS_ACCEPT_ANY);
    require(!missed || options->accept != LRCS_ACCEPT_ANY);
}

/* The interval that contains the truth by all answers so far. */
typedef struct fuzz_truth {
    long double low, high;
} fuzz_truth;

static inline void require_truth(const fuzz_truth *t)
{
    require(t->low - t->high <= 4 * LDBL_EPSILON * fabsl(t->high)); /* of its own rounding */
}

/* Intersects it with the interval of another answer; not over curved normals, where the bound does
   not include the error of the cubature. */
static inline void learn(fuzz_truth *truth, const lrcs_scene *scene, const lrcs_result *r)
{
    if (!scene->corner_normal) {
        truth->low = fmaxl(truth->low, (long double)r->sigma_m2 - r->bound_m2);
        truth->high = fminl(truth->high, (long double)r->sigma_m2 + r->bound_m2);
        require_truth(truth);
    }
}

/* One run in `size` bytes, which are given back; touches nothing where it fails. */
static inline int fuzz_sigma(const lrcs_prepared *prepared, const lrcs_scene *scene,
                             const fuzz_run *run, const lrcs_run_options *options, size_t size,
                             lrcs_result *result)
{
    uint32_t picture[FUZZ_PICTURE * FUZZ_PICTURE];
    lrcs_image image = {.size = options->resolution != 0 ? 0 : FUZZ_PICTURE, .facet = picture};
    lrcs_work work = fuzz_area_before(&run_end, size);
    memset(result, FUZZ_PATTERN, sizeof *result);
    memset(fuzz_records, FUZZ_PATTERN, scene->facet_count * sizeof *fuzz_records);
    memset(picture, FUZZ_PATTERN, sizeof picture);
    int status = lrcs_sigma_run(prepared, &run->pose, options, &work, result, fuzz_records, &image);
    require(work.used == 0);
    if (status == LRCS_OK) {
        require_result(scene, result);
        require(options->steps == 0 || result->steps <= options->steps);
        require_verdict(options, result);
        for (uint32_t i = 0; image.size != 0 && i < image.size * image.size; i++) {
            require(picture[i] < scene->facet_count || picture[i] == LRCS_NONE);
        }
        return status;
    }
    require(status == LRCS_E_MEMORY || status == LRCS_E_NUMBER);
    require(fuzz_untouched(result, sizeof *result));
    require(fuzz_untouched(fuzz_records, scene->facet_count * sizeof *fuzz_records));
    require(image.size == 0 || fuzz_untouched(picture, sizeof picture));
    return status;
}

/* Bytes for a run and the picture that goes with it where no resolution was asked for. */
static inline size_t run_need(const lrcs_prepared *prepared, const lrcs_run_options *options)
{
    lrcs_run_options picture = *options;
    size_t need = lrcs_sigma_need(prepared, options);
    picture.method = LRCS_METHOD_ZBUFFER;
    picture.resolution = FUZZ_PICTURE;
    size_t more = lrcs_sigma_need(prepared, &picture);
    need = options->resolution == 0 && more > need ? more : need;
    require(need < FUZZ_ROOM);
    return need;
}

/* The area of a ring over the view plane. */
static inline double ring_area(const lrcs_polygons *list, const lrcs_ring *ring)
{
    const lrcs_ring_point *point = &list->point[ring->first];
    double twice = 0;
    for (uint32_t i = 2; i < ring->count; i++) {
        const double *a = point[0].view;
        const double *b = point[i - 1].view;
        const double *c = point[i].view;
        twice += (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }
    return 0.5 * twice;
}

/* The polygons have the area that method exact, whose records are there, has found, each to within
   its own error: notes 2 and 4 of polygon.h. */
static inline void fuzz_polygons(const lrcs_prepared *prepared, const lrcs_scene *scene,
                                 const fuzz_run *run)
{
    lrcs_polygons list;
    size_t size = lrcs_polygon_need(prepared);
    require(size < FUZZ_ROOM);
    lrcs_work work = fuzz_area_before(&run_end, size);
    int status = lrcs_polygon_run(prepared, &run->pose, &work, &list);
    require(status == LRCS_OK || (status == LRCS_E_MEMORY && work.used == 0));
    if (status != LRCS_OK) {
        return;
    }
    double farthest = 0;
    for (uint32_t v = 0; v < scene->vertex_count; v++) {
        const double *x = scene->vertex[v].x;
        farthest = fmax(farthest, hypot(hypot(x[0], x[1]), x[2]));
    }
    double extent = scene_extent(scene);
    double room = list.bound_m2 * (1 + DBL_EPSILON);
    double off = 0;
    for (uint32_t i = 0; i < list.rings; i++) {
        require(list.ring[i].facet < scene->facet_count && list.ring[i].count >= 3);
        require(i == 0 || list.ring[i - 1].facet <= list.ring[i].facet);
        require(list.ring[i].first + list.ring[i].count <= list.points);
        off += ring_area(&list, &list.ring[i]);
        room += list.ring[i].count * 128 * DBL_EPSILON * farthest * extent;
    }
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        double whole = fuzz_records[f].area_m2 * fabs(fuzz_records[f].cos_theta);
        off -= fuzz_records[f].visible_area_m2;
        room += 1e-12 * whole + 1e-15 * extent * extent;
    }
    require(fabs(off) <= room);
}

/* One method in the memory it asks for, and the one of the input in a part of it too. */
static inline void fuzz_method(const lrcs_prepared *prepared, const lrcs_scene *scene,
                               const fuzz_run *run, int method, fuzz_truth *truth)
{
    lrcs_run_options options = run->options;
    options.method = method;
    options.resolution = method == LRCS_METHOD_EXACT ? 0 : options.resolution;
    size_t need = run_need(prepared, &options);
    lrcs_result result;
    int status = fuzz_sigma(prepared, scene, run, &options, need, &result);
    require(status != LRCS_E_MEMORY);
    if (status != LRCS_OK) {
        return;
    }
    require(!(result.flags & LRCS_FLAG_MEMORY_FALLBACK));
    learn(truth, scene, &result);
    if (method == LRCS_METHOD_EXACT && options.without == 0 && fuzz_chosen(run->polygons)) {
        fuzz_polygons(prepared, scene, run);
    }
    if (method == run->options.method && fuzz_chosen(run->short_memory) &&
        fuzz_sigma(prepared, scene, run, &options, need * run->share / 256, &result) == LRCS_OK) {
        learn(truth, scene, &result);
    }
    options.steps = (uint64_t)run->share * run->share + 1;
    if (method == run->options.method && fuzz_chosen(run->hurried) &&
        fuzz_sigma(prepared, scene, run, &options, need, &result) == LRCS_OK) {
        learn(truth, scene, &result);
    }
}

/* Prepares the scene, in no more memory than lrcs_prepare_need states for ordinary scenes or, where
   very many facets pierce each other, in what it then requests. */
static inline fuzz_truth fuzz_scene(const lrcs_scene *scene, const fuzz_run *run)
{
    const lrcs_prepared *prepared = NULL;
    size_t size = lrcs_prepare_need(scene);
    lrcs_work work;
    int status = LRCS_E_MEMORY;
    while (status == LRCS_E_MEMORY) {
        require(size < FUZZ_ROOM);
        work = fuzz_area_before(&prepare_end, size);
        status = lrcs_prepare_run(scene, &work, &prepared);
        if (status == LRCS_E_MEMORY) {
            require(prepared == NULL && work.used == 0 && work.peak > size);
            size = 2 * work.peak;
        }
    }
    require(status == LRCS_OK && work.peak <= size);
    fuzz_truth truth = {0, HUGE_VALL};
    for (int method = LRCS_METHOD_AUTO; method <= LRCS_METHOD_EXACT; method++) {
        if (fuzz_chosen(run->methods >> method & 1)) {
            fuzz_method(prepared, scene, run, method, &truth);
        }
    }
    return truth;
}

#endif
