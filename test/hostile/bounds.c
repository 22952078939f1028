/* SPDX-License-Identifier: MIT */
/* Every bound that the engine proves, against exact answers (bounds.py): each method, rasters of
   several sizes, clipping that may take few steps, range profiles, one-sided and two-sided. Prints
   what is violated; how loose the bounds are, as quantiles of bound / error, the least coming
   nearest to a violation, and of bound / sigma; and what the estimate is worth. An error that
   rounding alone could make (a tie) says nothing of looseness or of the estimate and is left out of
   their quantiles. */
#include <lrcs/lrcs.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "visibility/cells/cells.h"
#include "visibility/occlude.h"

#define MOST 256

typedef struct hostile_case {
    char kind[32], name[32];
    lrcs_point vertex[3 * MOST];
    lrcs_facet facet[MOST];
    uint32_t material_of[MOST], zero[MOST];
    long double share[MOST];
    long double sigma[2], silhouette;
    double direction[3];
    lrcs_material material[2];
    lrcs_part part;
    lrcs_scene scene;
} hostile_case;

/* Numbers of which quantiles are printed. */
typedef struct quantiles {
    double *x;
    unsigned count, room;
} quantiles;

/* One way to run the engine, in every so many scenes, and what came of it. */
typedef struct hostile_way {
    const char *name;
    int method;
    uint32_t size, every, with;
    uint64_t steps;
    unsigned runs, violations, refused, ties, low_guesses;
    quantiles loose, relative, guess;
} hostile_way;

static hostile_way ways[] = {
    {"facet", .method = LRCS_METHOD_FACET, .every = 1},
    {"zbuffer 1", .method = LRCS_METHOD_ZBUFFER, .size = 1, .every = 1},
    {"zbuffer 7", .method = LRCS_METHOD_ZBUFFER, .size = 7, .every = 1},
    {"zbuffer 16", .method = LRCS_METHOD_ZBUFFER, .size = 16, .every = 1},
    {"zbuffer 64", .method = LRCS_METHOD_ZBUFFER, .size = 64, .every = 1},
    {"zbuffer 255", .method = LRCS_METHOD_ZBUFFER, .size = 255, .every = 2},
    {"zbuffer 1024", .method = LRCS_METHOD_ZBUFFER, .size = 1024, .every = 16},
    {"zbuffer 4096", .method = LRCS_METHOD_ZBUFFER, .size = 4096, .every = 128},
    {"exact", .method = LRCS_METHOD_EXACT, .every = 1},
    {"auto", .method = LRCS_METHOD_AUTO, .every = 1},
    {"all effects", .every = 1, .with = LRCS_EFFECTS_SWITCHED},
    {"10 steps", .method = LRCS_METHOD_EXACT, .every = 1, .steps = 10},
    {"100 steps", .method = LRCS_METHOD_EXACT, .every = 1, .steps = 100},
    {"1000 steps", .method = LRCS_METHOD_EXACT, .every = 1, .steps = 1000}};
#define WAYS (sizeof ways / sizeof *ways)

/* The range profile: its sum, and the sum of its bins with theirs. */
static hostile_way profile_ways[] = {{"profile", .every = 1}, {"its bins", .every = 1}};

static void quantiles_add(quantiles *q, double x)
{
    if (q->count == q->room) {
        q->room = 2 * q->room + 1024;
        q->x = realloc(q->x, q->room * sizeof *q->x);
        if (!q->x) {
            exit(2);
        }
    }
    q->x[q->count++] = x;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The value below which this share of the numbers lies. */
static double quantile(quantiles *q, double share)
{
    if (q->count == 0) {
        return (double)NAN;
    }
    qsort(q->x, q->count, sizeof *q->x, ascending);
    return q->x[(unsigned)(share * (q->count - 1))];
}

static double worst_area;
static char worst_area_name[64];
static unsigned areas_beyond, near_areas, blurred_areas;
static unsigned bounded[2], out_of_bounds; /* areas of facets divided alone, and together */

static int read_numbers(FILE *in, double *x, int count)
{
    for (int k = 0; k < count; k++) {
        if (fscanf(in, "%lf", &x[k]) != 1) {
            return 0;
        }
    }
    return 1;
}

static int read_facets(FILE *in, hostile_case *c)
{
    for (uint32_t f = 0; f < c->scene.facet_count; f++) {
        uint32_t *corner = c->facet[f].corner;
        if (fscanf(in, "%u %u %u %u %Lf", &corner[0], &corner[1], &corner[2], &c->material_of[f],
                   &c->share[f]) != 5) {
            return 0;
        }
    }
    return fscanf(in, "%Lf %Lf %Lf", &c->sigma[0], &c->sigma[1], &c->silhouette) == 3;
}

static int read_case(FILE *in, hostile_case *c)
{
    memset(c, 0, sizeof *c);
    uint32_t vertices = 0;
    uint32_t facets = 0;
    if (fscanf(in, " case %31s %31s %u %u", c->kind, c->name, &vertices, &facets) != 4 ||
        vertices > 3 * MOST || facets > MOST || !read_numbers(in, c->direction, 3)) {
        return 0;
    }
    for (int i = 0; i < 2; i++) {
        double x[4];
        if (!read_numbers(in, x, 4)) {
            return 0;
        }
        c->material[i] =
            (lrcs_material){.name = "", .brdf = {x[0], x[1], x[2], x[3]}, .brdf_given = 1};
    }
    c->part = (lrcs_part){.name = "part", .kind = -1, .bounds.known = 1, .facet_count = facets};
    c->scene = (lrcs_scene){.vertex_count = vertices,
                            .facet_count = facets,
                            .material_count = 2,
                            .part_count = 1,
                            .vertex = c->vertex,
                            .facet = c->facet,
                            .facet_material = c->material_of,
                            .facet_part = c->zero,
                            .facet_smooth = c->zero,
                            .material = c->material,
                            .part = &c->part,
                            .unmatched = LRCS_NONE};
    return read_numbers(in, c->vertex[0].x, (int)(3 * vertices)) && read_facets(in, c);
}

/* How far the bulk of a scene's vertices reaches, about: 16 times as far as half of them are from
   the median in each coordinate. */
static double bulk_of(const hostile_case *c)
{
    double far[3 * MOST] = {0};
    uint32_t count = c->scene.vertex_count;
    for (int k = 0; k < 3; k++) {
        double x[3 * MOST];
        for (uint32_t v = 0; v < count; v++) {
            x[v] = c->vertex[v].x[k];
        }
        qsort(x, count, sizeof *x, ascending);
        for (uint32_t v = 0; v < count; v++) {
            far[v] = fmax(far[v], fabs(c->vertex[v].x[k] - x[count / 2]));
        }
    }
    qsort(far, count, sizeof *far, ascending);
    return 16 * far[count / 2];
}

/* Does the facet have a vertex that is so far from another one of its own? */
static int facet_reaches(const hostile_case *c, uint32_t facet, double far)
{
    const uint32_t *corner = c->facet[facet].corner;
    int reaches = 0;
    for (int i = 0; i < 9; i++) {
        reaches |= fabs(c->vertex[corner[i / 3]].x[i % 3] -
                        c->vertex[corner[(i / 3 + 1) % 3]].x[i % 3]) > far;
    }
    return reaches;
}

/* Areas of the exact method: 1e-12 of the facet's projection and 1e-15 of the extent squared. Of a
   body's facets, where others reach far, those are counted that miss 1e-15 of the body's own extent
   squared, and what double-double leaves of the distance in a strip across the body. */
static void check_areas(const hostile_case *c, const lrcs_facet_record *records)
{
    double low[3];
    double high[3];
    memcpy(low, c->vertex[0].x, sizeof low);
    memcpy(high, low, sizeof high);
    for (uint32_t v = 0; v < c->scene.vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], c->vertex[v].x[k]);
            high[k] = fmax(high[k], c->vertex[v].x[k]);
        }
    }
    double extent = fmax(high[0] - low[0], fmax(high[1] - low[1], high[2] - low[2]));
    double bulk = bulk_of(c);
    for (uint32_t f = 0; f < c->scene.facet_count; f++) {
        double whole = records[f].area_m2 * fabs(records[f].cos_theta);
        double off = (double)fabsl(records[f].visible_area_m2 - c->share[f] * whole);
        double part = off / (1e-12 * whole + 1e-15 * extent * extent);
        if (strncmp(c->kind, "far_", 4) == 0 && !facet_reaches(c, f, bulk)) {
            double reach = fmin(extent, bulk);
            near_areas++;
            blurred_areas +=
                off > 1e-12 * whole + 1e-15 * reach * reach + 0x1p-100 * extent * reach;
        }
        if (part > worst_area) {
            worst_area = part;
            snprintf(worst_area_name, sizeof worst_area_name, "%s %s", c->kind, c->name);
        }
        if (!(part <= 1)) {
            areas_beyond++;
            printf("AREA %s %s facet %u: off by %.3g of %.3g (extent %.3g)\n", c->kind, c->name, f,
                   off, whole, extent);
        }
    }
}

static void note(hostile_way *way, const hostile_case *c, int sided, const lrcs_result *r)
{
    long double truth = c->sigma[sided];
    double off = (double)fabsl(r->sigma_m2 - truth);
    way->runs++;
    if (!(off <= r->bound_m2)) {
        way->violations++;
        printf("VIOLATION %s %s, %s, two-sided %d: sigma %.17g, truth %.17Lg, off by %.3g, bound "
               "%.3g\n",
               c->kind, c->name, way->name, sided, r->sigma_m2, truth, off, r->bound_m2);
    }
    if (truth > 0) {
        quantiles_add(&way->relative, r->bound_m2 / (double)truth);
    }
    if (off <= r->budget.rounding_m2) {
        way->ties++;
        return;
    }
    quantiles_add(&way->loose, r->bound_m2 / off);
    if (r->estimate_m2 >= 0) {
        quantiles_add(&way->guess, r->estimate_m2 / off);
        way->low_guesses += r->estimate_m2 < off;
    }
}

/* Some dozen bins over the scene, which meet its facets anywhere, or one that holds nearly all. */
static void run_profile(const hostile_case *c, unsigned number, int sided,
                        const lrcs_prepared *prepared, const lrcs_pose *pose, lrcs_work work)
{
    double far = 0;
    lrcs_profile profile;
    lrcs_result sums[2] = {{.estimate_m2 = -1}, {.estimate_m2 = -1}};
    for (uint32_t v = 0; v < c->scene.vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            far = fmax(far, fabs(c->vertex[v].x[k]));
        }
    }
    int status =
        lrcs_profile_run(prepared, pose, far / (number % 5 == 0 ? 0.25 : 7), &work, &profile);
    if (status != LRCS_OK) {
        printf("REFUSED %s %s, profile: %d\n", c->kind, c->name, status);
        profile_ways[0].refused++;
        return;
    }
    sums[0].sigma_m2 = profile.sigma_glint_m2 + profile.sigma_diffuse_m2;
    sums[0].bound_m2 = profile.bound_m2;
    for (uint32_t i = 0; i < profile.count; i++) {
        sums[1].sigma_m2 += profile.bin[i].sigma_glint_m2 + profile.bin[i].sigma_diffuse_m2;
        sums[1].bound_m2 += profile.bin[i].bound_m2;
    }
    sums[1].bound_m2 += 1e-13 * sums[1].sigma_m2; /* of adding up here */
    note(&profile_ways[0], c, sided, &sums[0]);
    note(&profile_ways[1], c, sided, &sums[1]);
}

/* Does the truth lie between the bounds of a facet's area, but for the error of its projected area?
 */
static void check_bounds(const hostile_case *c, const lrcsi_view *view, uint32_t facet,
                         const lrcsi_visible_area *area, int together)
{
    lrcsi_incidence incidence = lrcsi_view_incidence(view, facet);
    double truth = (double)(c->share[facet] * incidence.projected);
    double off = (incidence.error + 2e-16) * incidence.projected;
    bounded[together]++;
    if (!(truth >= area->low - off && truth <= area->high + off)) {
        out_of_bounds++;
        printf("OUT OF BOUNDS %s %s facet %u, %s: %.17g .. %.17g, truth %.17g of %.3g\n", c->kind,
               c->name, facet, together ? "together" : "alone", area->low, area->high, truth,
               incidence.projected);
    }
}

/* Each facet divided alone, and all together, however few they are. */
static void run_areas(const hostile_case *c, const lrcs_prepared *prepared, const lrcs_pose *pose,
                      lrcs_work work)
{
    static unsigned char wanted[MOST];
    static unsigned char decided[MOST];
    static lrcsi_visible_area together[MOST];
    lrcsi_view view;
    lrcsi_classification classification;
    lrcsi_occlusion *o;
    if (lrcsi_view_make(prepared, pose, &work, &view) != LRCS_OK ||
        lrcsi_classify_make(&view, NULL, &work, &classification) != LRCS_OK ||
        lrcsi_occlude_make(&classification, NULL, &work, &o) != LRCS_OK) {
        printf("REFUSED %s %s, areas\n", c->kind, c->name);
        out_of_bounds++;
        return;
    }
    for (uint32_t f = 0; f < c->scene.facet_count; f++) {
        wanted[f] = lrcsi_view_casts(&view, f) != 0;
        if (wanted[f]) {
            lrcsi_occlude_open(o, f);
            lrcsi_visible_area alone = lrcsi_occlude_area(o);
            check_bounds(c, &view, f, &alone, 0);
        }
    }
    lrcsi_cells_areas(&classification, NULL, NULL, &work, o->answer, wanted, decided, together,
                      NULL);
    for (uint32_t f = 0; f < c->scene.facet_count; f++) {
        if (decided[f]) {
            check_bounds(c, &view, f, &together[f], 1);
        }
    }
}

static void run_case(hostile_case *c, unsigned number, void *memory, size_t bytes)
{
    static lrcs_facet_record records[MOST];
    for (int sided = 0; sided < 2; sided++) {
        c->material[0].two_sided = c->material[1].two_sided = (unsigned char)sided;
        lrcs_work work = lrcs_work_make(memory, bytes);
        const lrcs_prepared *prepared = NULL;
        lrcs_pose pose;
        if (lrcs_prepare_run(&c->scene, &work, &prepared) != LRCS_OK ||
            lrcs_pose_from_direction(c->direction, &pose) != LRCS_OK) {
            printf("REFUSED %s %s\n", c->kind, c->name);
            ways[0].refused++;
            return;
        }
        run_profile(c, number, sided, prepared, &pose, work);
        run_areas(c, prepared, &pose, work);
        for (size_t w = 0; w < WAYS; w++) {
            if (number % ways[w].every != 0) {
                continue;
            }
            lrcs_run_options options = {.tolerance = 1e-4,
                                        .method = ways[w].method,
                                        .resolution = ways[w].size,
                                        .with = ways[w].with,
                                        .steps = ways[w].steps};
            lrcs_result r;
            lrcs_work room = work; /* no more bytes than the library asks for, and they serve */
            room.size = work.used + lrcs_sigma_need(prepared, &options);
            int status = room.size > bytes
                             ? LRCS_E_MEMORY
                             : lrcs_sigma_run(prepared, &pose, &options, &room, &r, records, NULL);
            if (status != LRCS_OK || (r.flags & LRCS_FLAG_MEMORY_FALLBACK)) {
                printf("REFUSED %s %s, %s: %d\n", c->kind, c->name, ways[w].name, status);
                ways[w].refused++;
                continue;
            }
            note(&ways[w], c, sided, &r);
            if (ways[w].method == LRCS_METHOD_EXACT && ways[w].steps == 0 && sided == 1) {
                check_areas(c, records);
            }
        }
    }
}

static void report(hostile_way *w)
{
    printf("%-12s %7u %10u %8u %6u %9.3g %8.3g %8.3g %11.3g %8.3g", w->name, w->runs, w->violations,
           w->refused, w->ties, quantile(&w->loose, 0), quantile(&w->loose, 0.5),
           quantile(&w->loose, 0.95), quantile(&w->relative, 0.5), quantile(&w->relative, 0.95));
    if (w->guess.count > 0) {
        printf(" %10.3g %8.2f%%", quantile(&w->guess, 0.5),
               100.0 * w->low_guesses / w->guess.count);
    }
    printf("\n");
}

int main(int argc, char **argv)
{
    FILE *in = argc > 1 ? fopen(argv[1], "r") : stdin;
    size_t bytes = 512u << 20;
    void *memory = malloc(bytes);
    static hostile_case c;
    unsigned cases = 0;
    unsigned bad = 0;
    if (!in || !memory) {
        return 2;
    }
    for (; read_case(in, &c); cases++) {
        run_case(&c, cases, memory, bytes);
    }
    printf("%u scenes\n%-12s %7s %10s %8s %6s %27s %20s %20s\n", cases, "method", "runs",
           "violations", "refused", "ties", "bound/error: least, half, 95%",
           "bound/sigma: half, 95%", "estimate/error, below 1");
    for (size_t w = 0; w < WAYS; w++) {
        report(&ways[w]);
        bad += ways[w].violations + ways[w].refused;
    }
    for (int w = 0; w < 2; w++) {
        report(&profile_ways[w]);
        bad += profile_ways[w].violations + profile_ways[w].refused;
    }
    printf("exact areas: worst %.3g of what is allowed (%s), %u beyond it\n", worst_area,
           worst_area_name, areas_beyond);
    printf("bounds of areas: %u of facets alone, %u of facets together, %u do not hold\n",
           bounded[0], bounded[1], out_of_bounds);
    if (near_areas > 0) {
        printf("areas of bodies beside what is far: %u of %u blurred\n", blurred_areas, near_areas);
    }
    return bad + areas_beyond + out_of_bounds != 0 || cases == 0;
}
