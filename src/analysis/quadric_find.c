/* SPDX-License-Identifier: MIT */
/* Finds connected facets of models that lie on a plane, cylinder, sphere or cone. Which facets and
   which surface are decided by heuristics; what is claimed of them is proved by
   lrcs_quadric_facet_bound.

   1. Facets are neighbours if they share an edge, a part and a material and turn little across the
      edge (neighbours_find).
   2. Facets are taken in turn as seeds, the largest first. The facets nearest to the seed by steps
      between neighbours, about thirty, are its surroundings (seed_region).
   3. For each kind, the seed with one or two of its surroundings determines a surface; the one with
      which most of the surroundings agree is tried (best_guess).
   4. The region of the seed grows over neighbours that agree with the surface, and the surface is
      fitted to the region, in turn, until the region grows no more (region_fit).
   5. The bounds of all its facets are computed. If they are small enough (region_measure), the kind
      with the most facets, of several the closest, becomes the seed's region. */
#include "analysis/quadric.h"

#include <string.h>

#include "base/bits.h"
#include "base/constant.h"
#include "base/length.h"
#include "base/sort.h"
#include "base/vec3.h"
#include "base/work.h"
#include "mesh/topology.h"
#include "optics/aliasing.h"

/* The normals of neighbours differ by less than 37 deg: on a circle of facets that turn by more,
   the displacement exceeds LRCS_QUADRIC_SHARE. */
#define COS_NEIGHBOUR 0.8

/* The cosine of the angle to the surface's normal at a facet's centroid: 18 deg. */
#define COS_AGREE 0.95

/* A facet agrees with a surface if the distances of its corners from it are at most this fraction
   of its longest side or of the radius. If the region does not meet the limits, a quarter of the
   fraction is tried, up to three times. */
#define AGREE_FIRST  0.02
#define AGREE_TRIALS 4

/* Corners displaced by less than this fraction of the region's size are as accurate as the
   coordinates of files. */
#define CORNER_EXACT 1e-6

/* From the seed on, the surface's normals turn within a region by this many times the angle between
   them and the facets' normals (which is half the turn between two strips of a cylinder), or by
   the most that is possible. Less is no evidence: crumpled foil has such regions. A narrow ribbon
   of any smooth surface lies close to some cylinder or cone: a region with more than half as many
   sides as facets across which the mesh goes on smoothly must turn by CURVED_MAX. */
#define CURVED_MIN 4.0
#define CURVED_MAX (0.75 * LRCS_PI)

/* Of two kinds that explain equally many facets, the later is preferred only if it is closer by
   this factor: a plane is a sphere of large radius. */
#define CLOSER 0.9

/* Neighbours whose normals turn by less, 3e-5 rad, determine no curved surface. */
#define COS_TURNED (1.0 - 1e-9)

#define SURROUNDINGS 32u
#define COMPANIONS   7u   /* surroundings from which surfaces are guessed */
#define GROWTHS      8    /* rounds of growing and fitting */
#define FITTED_MAX   500u /* approximate number of facets that a fit uses */
#define BUDGET       100u /* comparisons per facet */

typedef struct finder {
    const lrcs_scene *scene;
    lrcs_facet *neighbour;  /* the neighbour across each side, or LRCS_NONE */
    lrcs_point *normal;     /* unit; zeros if the facet is not examined */
    double *area;           /* m2 */
    uint32_t *region;       /* in which the facet is, or LRCS_NONE */
    uint32_t *mark;         /* growth: reached by it; growth + 1: in its region */
    uint32_t *queue, *best; /* facets of the region that grows, and of the best one so far */
    unsigned char *tried;   /* 1: no seed */
    uint32_t growth;
    uint64_t comparisons_left; /* of the budget */
} finder;

static void corners_get(const finder *f, uint32_t facet, lrcs_point corner[3])
{
    for (int k = 0; k < 3; k++) {
        corner[k] = f->scene->vertex[f->scene->facet[facet].corner[k]];
    }
}

static void normals_find(finder *f, const lrcsi_topology *topology)
{
    const lrcs_scene *scene = f->scene;
    for (uint32_t i = 0; i < scene->facet_count; i++) {
        lrcs_point corner[3];
        f->normal[i] = (lrcs_point){{0}};
        f->area[i] = 0.0;
        if (topology->degenerate[i] || scene->part[scene->facet_part[i]].kind >= 0 ||
            scene->material[scene->facet_material[i]].omitted) {
            continue;
        }
        corners_get(f, i, corner);
        lrcsi_quadric_cross(corner, f->normal[i].x);
        double length = lrcsi_length(f->normal[i].x);
        f->area[i] = 0.5 * length;
        for (int k = 0; k < 3; k++) {
            double x = f->normal[i].x[k] / length;
            f->normal[i].x[k] = isfinite(x) ? x : 0.0;
        }
    }
}

/* Across an edge of several facets the one with the most similar normal counts. */
static void neighbours_find(finder *f, const lrcsi_topology *topology)
{
    const lrcs_scene *scene = f->scene;
    for (uint32_t i = 0; i < 3 * scene->facet_count; i++) {
        uint32_t facet = i / 3;
        uint32_t *neighbour = &f->neighbour[facet].corner[i % 3];
        uint32_t index = topology->facet_edge[facet].corner[i % 3];
        double cos_best = COS_NEIGHBOUR;
        *neighbour = LRCS_NONE;
        if (index == LRCS_NONE) {
            continue;
        }
        const lrcsi_edge *edge = &topology->edge[index];
        uint32_t forward = topology->weld[scene->facet[facet].corner[i % 3]] == edge->low;
        uint32_t uses = edge->uses < 8 ? edge->uses : 8; /* linear time */
        for (uint32_t k = 0; k < uses; k++) {
            const lrcsi_edge_use *use = &topology->use[edge->first_use + k];
            double cos = lrcsi_vec3_dot(f->normal[facet].x, f->normal[use->facet].x);
            if (use->forward != forward && cos > cos_best &&
                scene->facet_part[use->facet] == scene->facet_part[facet] &&
                scene->facet_material[use->facet] == scene->facet_material[facet]) {
                cos_best = cos;
                *neighbour = use->facet;
            }
        }
    }
}

/* 1 if a facet lies about on a surface: its corners to within `tolerance` of the facet's longest
   side or, if that is less, the radius. */
static int facet_agrees(finder *f, const lrcs_quadric *surface, uint32_t facet, double tolerance)
{
    lrcs_point corner[3];
    lrcs_point middle;
    double normal[3];
    double side = 0.0;
    f->comparisons_left -= f->comparisons_left > 0;
    corners_get(f, facet, corner);
    for (int k = 0; k < 3; k++) {
        double between[3];
        lrcsi_vec3_between(corner[k].x, corner[(k + 1) % 3].x, between);
        side = fmax(side, lrcsi_vec3_dot(between, between));
        middle.x[k] = (corner[0].x[k] + corner[1].x[k] + corner[2].x[k]) / 3;
    }
    lrcsi_quadric_at at = lrcsi_quadric_locate(surface, middle.x);
    int flat = surface->kind == LRCS_QUADRIC_PLANE;
    double size = sqrt(side);
    if (!flat) {
        size = fmin(size, at.rho);
    }
    lrcsi_quadric_normal(surface, &at, normal);
    double cos = fabs(lrcsi_vec3_dot(normal, f->normal[facet].x));
    if (!(cos >= (flat ? 1.0 - 0.5 * LRCS_QUADRIC_FLAT * LRCS_QUADRIC_FLAT : COS_AGREE)) ||
        (surface->kind == LRCS_QUADRIC_CONE && !(at.z > 0.0))) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        if (!(fabs(lrcsi_quadric_locate(surface, corner[k].x).distance) <= tolerance * size)) {
            return 0;
        }
    }
    return 1;
}

/* Puts the facets connected with a seed into the queue, breadth first: those in no region that
   agree with the surface (if not NULL), at most `limit`. Returns their number. */
static uint32_t region_grow(finder *f, uint32_t seed, const lrcs_quadric *surface, double tolerance,
                            uint32_t limit)
{
    uint32_t count = 0;
    f->growth += 2;
    if (surface && !facet_agrees(f, surface, seed, tolerance)) {
        return 0;
    }
    f->queue[count++] = seed;
    f->mark[seed] = f->growth + 1;
    for (uint32_t i = 0; i < count; i++) {
        for (int k = 0; k < 3 && count < limit; k++) {
            uint32_t next = f->neighbour[f->queue[i]].corner[k];
            if (next == LRCS_NONE || f->region[next] != LRCS_NONE || f->mark[next] >= f->growth) {
                continue;
            }
            f->mark[next] = f->growth;
            if (!surface || facet_agrees(f, surface, next, tolerance)) {
                f->queue[count++] = next;
                f->mark[next] = f->growth + 1;
            }
        }
    }
    return count;
}

/* Finds the surface of a kind, through a seed, around[0], and one or two of its surroundings, with
   which most of the surroundings agree. Returns 0 if with none of them enough do. */
static int best_guess(finder *f, int kind, const uint32_t *around, uint32_t around_count,
                      lrcs_quadric *best)
{
    uint32_t companion[COMPANIONS];
    uint32_t companions = 0;
    uint32_t most = LRCS_QUADRIC_FACETS / 2 - 1; /* fewer do not count */
    int found = 0;
    for (uint32_t i = 1; i < around_count && companions < COMPANIONS; i++) {
        const double *n = f->normal[around[i]].x;
        int turned = lrcsi_vec3_dot(n, f->normal[around[0]].x) < COS_TURNED;
        for (uint32_t j = 0; j < companions && turned; j++) {
            turned = lrcsi_vec3_dot(n, f->normal[companion[j]].x) < COS_TURNED;
        }
        companion[companions] = around[i];
        companions += turned != 0;
    }
    uint32_t first = kind == LRCS_QUADRIC_PLANE ? 1 : companions;
    uint32_t second = kind == LRCS_QUADRIC_SPHERE || kind == LRCS_QUADRIC_CONE ? companions : 1;
    for (uint32_t i = 0; i < first; i++) {
        for (uint32_t j = second > 1 ? i + 1 : 0; j < second; j++) {
            lrcs_point corner[9];
            lrcs_quadric guess;
            corners_get(f, around[0], corner);
            corners_get(f, companions > 0 ? companion[i] : around[0], corner + 3);
            corners_get(f, companions > 0 ? companion[j] : around[0], corner + 6);
            if (!lrcsi_quadric_guess(kind, corner, &guess)) {
                continue;
            }
            uint32_t agree = 0;
            for (uint32_t k = 0; k < around_count && agree + around_count - k > most; k++) {
                agree += (uint32_t)facet_agrees(f, &guess, around[k], AGREE_FIRST);
            }
            if (agree > most) {
                most = agree;
                *best = guess;
                found = 1;
            }
        }
    }
    return found;
}

/* Computes the bounds of the facets in the queue. 1 if they meet the limits of lrcs/quadric.h. */
static int region_measure(finder *f, uint32_t count, lrcs_quadric_region *region)
{
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    double radius = 0.0;
    double corners = 0.0; /* their greatest distance from the surface */
    double cos_min = 1.0; /* cosine between the surface's normals at the first and another facet */
    double first[3];
    uint32_t open = 0; /* sides across which the mesh goes on, but not the region */
    int flat = region->surface.kind == LRCS_QUADRIC_PLANE;
    region->bound = (lrcs_quadric_bound){0};
    region->area = 0.0;
    region->facet_count = count;
    region->first_facet = LRCS_NONE;
    for (uint32_t i = 0; i < count; i++) {
        uint32_t facet = f->queue[i];
        lrcs_point corner[3];
        lrcs_quadric_bound bound;
        corners_get(f, facet, corner);
        if (lrcs_quadric_facet_bound(&region->surface, corner, &bound) != LRCS_OK ||
            !(bound.normal_angle < LRCS_PI / 2) ||
            (i > 0 && bound.inside != region->bound.inside)) {
            return 0;
        }
        for (int k = 0; k < 9; k++) {
            low[k % 3] = fmin(low[k % 3], corner[k / 3].x[k % 3]);
            high[k % 3] = fmax(high[k % 3], corner[k / 3].x[k % 3]);
        }
        for (int k = 0; k < 3 && !flat; k++) {
            uint32_t next = f->neighbour[facet].corner[k];
            open += next != LRCS_NONE && f->mark[next] != f->growth + 1;
            double normal[3];
            lrcsi_quadric_at at = lrcsi_quadric_locate(&region->surface, corner[k].x);
            corners = fmax(corners, fabs(at.distance));
            radius = fmax(radius, at.rho);
            lrcsi_quadric_normal(&region->surface, &at, i + (uint32_t)k > 0 ? normal : first);
            cos_min = fmin(cos_min, i + (uint32_t)k > 0 ? lrcsi_vec3_dot(normal, first) : 1.0);
        }
        region->bound.displacement = fmax(region->bound.displacement, bound.displacement);
        region->bound.normal_angle = fmax(region->bound.normal_angle, bound.normal_angle);
        region->bound.inside = bound.inside;
        region->area += f->area[facet];
        region->first_facet = facet < region->first_facet ? facet : region->first_facet;
    }
    const double diagonal[3] = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
    double size = lrcsi_length(diagonal);
    if (flat) {
        return region->bound.displacement <= LRCS_QUADRIC_FLAT * size &&
               region->bound.normal_angle <= LRCS_QUADRIC_FLAT;
    }
    size = fmin(size, radius);
    return region->bound.displacement <= LRCS_QUADRIC_SHARE * size &&
           (2 * open <= count || cos_min <= cos(CURVED_MAX)) &&
           cos_min <= cos(fmin(CURVED_MIN * region->bound.normal_angle, CURVED_MAX)) &&
           (corners <= 0.5 * region->bound.displacement || corners <= CORNER_EXACT * size);
}

/* Moves the point of a plane or cylinder to the middle of the facets in the queue, and gives the
   axis of a cylinder a positive largest component. */
static void surface_place(const finder *f, uint32_t count, lrcs_quadric *surface)
{
    double middle[3] = {0};
    if (surface->kind != LRCS_QUADRIC_PLANE && surface->kind != LRCS_QUADRIC_CYLINDER) {
        return;
    }
    for (uint32_t i = 0; i < count; i++) {
        lrcs_point corner[3];
        corners_get(f, f->queue[i], corner);
        for (int k = 0; k < 9; k++) {
            middle[k % 3] += corner[k / 3].x[k % 3] / (3.0 * count);
        }
    }
    lrcsi_quadric_at at = lrcsi_quadric_locate(surface, middle);
    double *a = surface->axis;
    int largest = fabs(a[1]) > fabs(a[0]);
    largest = fabs(a[2]) > fabs(a[largest]) ? 2 : largest;
    int turned = surface->kind == LRCS_QUADRIC_CYLINDER && a[largest] < 0.0;
    for (int k = 0; k < 3; k++) {
        surface->point[k] = surface->kind == LRCS_QUADRIC_PLANE ? middle[k] - at.z * a[k]
                                                                : surface->point[k] + at.z * a[k];
    }
    for (int k = 0; k < 3 && turned; k++) {
        a[k] = -a[k];
    }
}

/* Grows the seed's region and fits its surface. The number of facets, in the queue, if the region
   meets the limits; else 0. */
static uint32_t region_fit(finder *f, uint32_t seed, lrcs_quadric_region *region)
{
    double tolerance = AGREE_FIRST;
    for (int trial = 0; trial < AGREE_TRIALS; trial++) {
        lrcs_quadric surface = region->surface;
        uint32_t count = 0;
        for (int i = 0; i < GROWTHS && f->comparisons_left > 0; i++) {
            uint32_t before = count;
            count = region_grow(f, seed, &surface, tolerance, LRCS_NONE);
            if (count < LRCS_QUADRIC_FACETS || (i > 2 && count <= before)) {
                break;
            }
            uint32_t stride = count / FITTED_MAX + 1;
            int fitted = lrcsi_quadric_step(&surface, f->scene, f->queue, count, stride) &&
                         lrcsi_quadric_step(&surface, f->scene, f->queue, count, stride);
            if (!fitted) {
                return 0;
            }
        }
        if (count >= LRCS_QUADRIC_FACETS) {
            lrcs_quadric_region found = *region;
            found.surface = surface;
            surface_place(f, count, &found.surface);
            if (region_measure(f, count, &found)) {
                *region = found;
                return count;
            }
        }
        tolerance *= 0.25;
    }
    return 0;
}

/* The region of a seed, of the kind with the most facets (of several, the closest): its facets are
   in f->best. 1 if there is one. */
static int seed_region(finder *f, uint32_t seed, lrcs_quadric_region *region)
{
    uint32_t around[SURROUNDINGS];
    uint32_t most = 0;
    uint32_t around_count = region_grow(f, seed, NULL, 0.0, SURROUNDINGS);
    memcpy(around, f->queue, around_count * sizeof *around);
    for (int kind = LRCS_QUADRIC_PLANE;
         kind <= LRCS_QUADRIC_CONE && around_count >= LRCS_QUADRIC_FACETS; kind++) {
        lrcs_quadric_region one = {.part = f->scene->facet_part[seed],
                                   .material = f->scene->facet_material[seed]};
        if (!best_guess(f, kind, around, around_count, &one.surface)) {
            continue;
        }
        uint32_t count = region_fit(f, seed, &one);
        if (count > most || (count == most && count > 0 &&
                             one.bound.displacement < CLOSER * region->bound.displacement)) {
            most = count;
            *region = one;
            memcpy(f->best, f->queue, count * sizeof *f->best);
        }
    }
    for (uint32_t i = 0; i < around_count / 2 && most == 0; i++) {
        f->tried[around[i]] = 1; /* their surroundings are much the same */
    }
    return most > 0;
}

static uint64_t descending_key(double area)
{
    return ~lrcsi_bits_of(area); /* bits of doubles that are not negative have their order */
}

/* Memory for sorting. */
typedef struct area_order {
    uint64_t *key, *key_spare;
    uint32_t *order, *order_spare;
} area_order;

/* Makes order[0 .. count) list the items by descending area. Given: their keys, descending_key. */
static void order_make(const area_order *by_area, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        by_area->order[i] = i;
    }
    lrcsi_sort_pairs(by_area->key, by_area->order, by_area->key_spare, by_area->order_spare, count);
}

/* Takes the arrays, for n facets. Returns 0 if there is too little memory. */
static int finder_take(finder *f, area_order *by_area, uint32_t n, lrcs_work *work)
{
    f->neighbour = lrcsi_work_take(work, n, sizeof *f->neighbour);
    f->normal = lrcsi_work_take(work, n, sizeof *f->normal);
    f->area = lrcsi_work_take(work, n, sizeof *f->area);
    f->region = lrcsi_work_take(work, n, sizeof *f->region);
    f->mark = lrcsi_work_take_zero(work, n, sizeof *f->mark);
    f->queue = lrcsi_work_take(work, n, sizeof *f->queue);
    f->best = lrcsi_work_take(work, n, sizeof *f->best);
    f->tried = lrcsi_work_take_zero(work, n, sizeof *f->tried);
    by_area->key = lrcsi_work_take(work, n, sizeof *by_area->key);
    by_area->key_spare = lrcsi_work_take(work, n, sizeof *by_area->key_spare);
    by_area->order = lrcsi_work_take(work, n, sizeof *by_area->order);
    by_area->order_spare = lrcsi_work_take(work, n, sizeof *by_area->order_spare);
    return f->neighbour && f->normal && f->area && f->region && f->mark && f->queue && f->best &&
           f->tried && by_area->key && by_area->key_spare && by_area->order && by_area->order_spare;
}

static size_t regions_max(const lrcs_scene *scene)
{
    return scene->facet_count / LRCS_QUADRIC_FACETS + 1;
}

size_t lrcs_quadric_need(const lrcs_scene *scene)
{
    size_t facets = scene->facet_count;
    size_t need = lrcsi_topology_need(scene->vertex_count, scene->facet_count);
    size_t each[] = {sizeof(lrcs_facet), sizeof(lrcs_point), sizeof(double),   sizeof(uint32_t),
                     sizeof(uint32_t),   sizeof(uint32_t),   sizeof(uint32_t), 1,
                     sizeof(uint64_t),   sizeof(uint64_t),   sizeof(uint32_t), sizeof(uint32_t)};
    for (size_t i = 0; i < sizeof each / sizeof *each; i++) {
        need = lrcsi_work_add(need, lrcsi_work_bytes(facets, each[i]));
    }
    return lrcsi_work_add(need,
                          lrcsi_work_blocks(2, regions_max(scene), sizeof(lrcs_quadric_region)));
}

int lrcs_quadric_find(const lrcs_scene *scene, lrcs_work *work, lrcs_quadric_region **list,
                      uint32_t *count, uint32_t *facet_region)
{
    size_t start = work->used;
    uint32_t n = scene->facet_count;
    lrcsi_topology topology;
    finder f = {.scene = scene, .comparisons_left = (uint64_t)BUDGET * n + 1};
    lrcs_quadric_region *regions = lrcsi_work_take(work, regions_max(scene), sizeof *regions);
    size_t end = work->used;
    lrcs_quadric_region *found = lrcsi_work_take(work, regions_max(scene), sizeof *found);
    area_order by_area;
    int taken = finder_take(&f, &by_area, n, work) && regions && found;
    int status = taken ? lrcsi_topology_make(scene->vertex, scene->vertex_count, scene->facet, n,
                                             work, &topology)
                       : LRCS_E_MEMORY;
    if (status != LRCS_OK) {
        work->used = start;
        return status;
    }
    normals_find(&f, &topology);
    neighbours_find(&f, &topology);
    for (uint32_t i = 0; i < n; i++) {
        f.region[i] = LRCS_NONE;
        by_area.key[i] = descending_key(f.area[i]);
    }
    order_make(&by_area, n);
    uint32_t used = 0;
    for (uint32_t i = 0; i < n && f.comparisons_left > 0; i++) {
        uint32_t seed = by_area.order[i];
        lrcs_quadric_region region;
        if (f.region[seed] != LRCS_NONE || f.tried[seed] || !(f.area[seed] > 0.0) ||
            !seed_region(&f, seed, &region)) {
            continue;
        }
        const lrcs_brdf *brdf = &scene->material[region.material].brdf;
        region.glint_error = region.surface.kind == LRCS_QUADRIC_PLANE || !(brdf->A > 0.0)
                                 ? 0.0
                                 : lrcsi_aliasing_error(2.0 * region.bound.normal_angle, brdf->s);
        for (uint32_t k = 0; k < region.facet_count; k++) {
            f.region[f.best[k]] = used;
        }
        found[used++] = region;
    }
    for (uint32_t i = 0; i < used; i++) { /* the largest region first */
        by_area.key[i] = descending_key(found[i].area);
    }
    order_make(&by_area, used);
    uint32_t *place = by_area.order_spare; /* of each region in the list */
    for (uint32_t i = 0; i < used; i++) {
        regions[i] = found[by_area.order[i]];
        place[by_area.order[i]] = i;
    }
    for (uint32_t i = 0; facet_region && i < n; i++) {
        facet_region[i] = f.region[i] == LRCS_NONE ? LRCS_NONE : place[f.region[i]];
    }
    work->used = end;
    *list = regions;
    *count = used;
    return LRCS_OK;
}
