/* SPDX-License-Identifier: MIT */
/* Whether a mesh of curved bodies is fine enough for the glint of its assigned material: an
   estimate, from the angles between neighbours that share a smoothing group, or between vertex
   normals. */
#include "host/fail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constant.h"
#include "base/vec3.h"
#include "optics/aliasing.h"

/* Neighbours that turn by less are treated as halves of one flat polygon; those that turn by 60 deg
   or more, as faces of a box with a smoothing group. The turn of a hexagonal prism, whose
   coordinates are rounded to floats, is 60 deg. */
#define COPLANAR_TURN 1e-3
#define SHARP_TURN    (LRCS_PI / 3.0 - 1e-4)

/* An edge of a facet, lower vertex first. */
typedef struct glint_edge {
    uint32_t low, high, facet;
} glint_edge;

/* A turn between two neighbours of one part and material. */
typedef struct glint_turn {
    uint32_t part, material;
    double turn;
} glint_turn;

static int glint_order(uint32_t a, uint32_t b)
{
    return (a > b) - (a < b);
}

static int edge_order(const void *a, const void *b)
{
    const glint_edge *x = a;
    const glint_edge *y = b;
    int order = glint_order(x->low, y->low);
    order = order ? order : glint_order(x->high, y->high);
    return order ? order : glint_order(x->facet, y->facet);
}

static int turn_order(const void *a, const void *b)
{
    const glint_turn *x = a;
    const glint_turn *y = b;
    int order = glint_order(x->part, y->part);
    order = order ? order : glint_order(x->material, y->material);
    return order ? order : (x->turn > y->turn) - (x->turn < y->turn);
}

/* A facet's normal, scaled so that nothing overflows; not of unit length. */
static void glint_normal(const lrcs_scene *scene, uint32_t facet, double n[3])
{
    const uint32_t *corner = scene->facet[facet].corner;
    double u[3];
    double v[3];
    double largest = 0.0;
    lrcsi_vec3_between(scene->vertex[corner[0]].x, scene->vertex[corner[1]].x, u);
    lrcsi_vec3_between(scene->vertex[corner[0]].x, scene->vertex[corner[2]].x, v);
    for (int k = 0; k < 3; k++) {
        largest = fmax(largest, fmax(fabs(u[k]), fabs(v[k])));
    }
    for (int k = 0; k < 3 && largest > 0.0; k++) {
        u[k] /= largest;
        v[k] /= largest;
    }
    lrcsi_vec3_cross(u, v, n);
}

/* The angle between two facets' normals; 0 if one has none. */
static double facets_turn(const lrcs_scene *scene, uint32_t a, uint32_t b)
{
    double n[3];
    double p[3];
    double cross[3];
    glint_normal(scene, a, n);
    glint_normal(scene, b, p);
    lrcsi_vec3_cross(n, p, cross);
    return atan2(sqrt(lrcsi_vec3_dot(cross, cross)), lrcsi_vec3_dot(n, p) + 0.0); /* no -0 */
}

/* The turns over edges that two facets of one part, material and smoothing group of a model share.
   Given: memory for three edges of each facet. Returns their number. */
static size_t edge_turns(const lrcs_scene *scene, glint_edge *edges, glint_turn *turns)
{
    size_t edge_count = 0;
    size_t count = 0;
    for (uint32_t i = 0; i < scene->facet_count; i++) {
        const lrcs_material *material = &scene->material[scene->facet_material[i]];
        int wanted = scene->part[scene->facet_part[i]].kind < 0 && scene->facet_smooth[i] != 0 &&
                     material->brdf.A > 0.0 && !material->omitted;
        for (int k = 0; wanted && k < 3; k++) {
            uint32_t a = scene->facet[i].corner[k];
            uint32_t b = scene->facet[i].corner[(k + 1) % 3];
            edges[edge_count++] = (glint_edge){a < b ? a : b, a < b ? b : a, i};
        }
    }
    qsort(edges, edge_count, sizeof *edges, edge_order);
    for (size_t i = 1; i < edge_count; i++) {
        uint32_t a = edges[i - 1].facet;
        uint32_t b = edges[i].facet;
        if (edges[i].low != edges[i - 1].low || edges[i].high != edges[i - 1].high ||
            scene->facet_part[a] != scene->facet_part[b] ||
            scene->facet_material[a] != scene->facet_material[b] ||
            !(scene->facet_smooth[a] & scene->facet_smooth[b])) {
            continue;
        }
        double turn = facets_turn(scene, a, b);
        if (turn > COPLANAR_TURN && turn < SHARP_TURN) {
            turns[count++] = (glint_turn){scene->facet_part[a], scene->facet_material[a], turn};
        }
    }
    return count;
}

/* The turns of facets in no smoothing group: the largest angle between the normals at their
   corners. Returns their number. */
static size_t corner_turns(const lrcs_scene *scene, glint_turn *turns)
{
    size_t count = 0;
    for (uint32_t i = 0; scene->corner_normal && i < scene->facet_count; i++) {
        const lrcs_material *material = &scene->material[scene->facet_material[i]];
        const lrcs_point *n = &scene->corner_normal[3 * (size_t)i];
        double turn = 0.0;
        for (int k = 0; k < 3; k++) {
            const double *a = n[k].x;
            const double *b = n[(k + 1) % 3].x;
            double chord = hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
            turn = fmax(turn, 2.0 * asin(fmin(1.0, 0.5 * chord)));
        }
        if (scene->facet_smooth[i] == 0 && material->brdf.A > 0.0 && !material->omitted &&
            turn > COPLANAR_TURN) {
            turns[count++] = (glint_turn){scene->facet_part[i], scene->facet_material[i], turn};
        }
    }
    return count;
}

static lrcs_host_glint glint_entry(const lrcs_scene *scene, uint32_t part, uint32_t material,
                                   double turn)
{
    double s = scene->material[material].brdf.s;
    return (lrcs_host_glint){part,
                             material,
                             s,
                             turn,
                             lrcsi_aliasing_error(turn, s),
                             lrcsi_aliasing_around(s, 1e-2),
                             lrcsi_aliasing_around(s, 1e-3)};
}

static int entry_order(const void *a, const void *b)
{
    const lrcs_host_glint *x = a;
    const lrcs_host_glint *y = b;
    int order = glint_order(x->part, y->part);
    return order ? order : glint_order(x->material, y->material);
}

/* 1. The turns between neighbours of models, and those within facets with curved normals.
   2. One entry for each part and material of models: the median of its turns.
   3. One entry for each curved shape, which has one material. */
int lrcs_host_glint_check(const lrcs_scene *scene, lrcs_host_glint **list, uint32_t *count,
                          lrcs_host_error *error)
{
    size_t capacity = 3 * (size_t)scene->facet_count + 1;
    glint_edge *edges = malloc(capacity * sizeof *edges);
    glint_turn *turns = malloc(capacity * sizeof *turns);
    size_t turn_count = 0;
    size_t entries = scene->part_count + (size_t)1;
    if (edges && turns) { /* 1 */
        turn_count = edge_turns(scene, edges, turns);
        turn_count += corner_turns(scene, turns + turn_count);
        qsort(turns, turn_count, sizeof *turns, turn_order);
    }
    for (size_t i = 0; i < turn_count; i++) {
        entries += i == 0 || turns[i].part != turns[i - 1].part ||
                   turns[i].material != turns[i - 1].material;
    }
    lrcs_host_glint *all = edges && turns ? malloc(entries * sizeof *all) : NULL;
    if (all) {
        uint32_t used = 0;
        size_t from = 0;
        for (size_t i = 1; i <= turn_count; i++) { /* 2 */
            if (i == turn_count || turns[i].part != turns[from].part ||
                turns[i].material != turns[from].material) {
                const glint_turn *middle = &turns[from + (i - from) / 2];
                all[used++] = glint_entry(scene, middle->part, middle->material, middle->turn);
                from = i;
            }
        }
        for (uint32_t i = 0; i < scene->part_count; i++) { /* 3 */
            const lrcs_part *part = &scene->part[i];
            uint32_t material =
                part->facet_count > 0 ? scene->facet_material[part->first_facet] : 0;
            if (part->kind >= 0 && part->facet_count > 0 && part->bounds.patch.turn > 0.0 &&
                scene->material[material].brdf.A > 0.0) {
                all[used++] = glint_entry(scene, i, material, 2.0 * part->bounds.patch.turn);
            }
        }
        qsort(all, used, sizeof *all, entry_order);
        *list = all;
        *count = used;
    }
    free(edges);
    free(turns);
    return all ? LRCS_OK : lrcsi_host_fail_memory(error, capacity * sizeof *edges);
}

/* The glint of all facets of the same part and material in the plane of this facet, or nearly. */
static double face_glint(const lrcs_scene *scene, const lrcs_facet_record *records, uint32_t facet)
{
    double glint = 0.0;
    for (uint32_t i = 0; i < scene->facet_count; i++) {
        /* cosines of incidence differ by at most the angle between the normals */
        if (records[i].sigma_glint_m2 > 0.0 && scene->facet_part[i] == scene->facet_part[facet] &&
            scene->facet_material[i] == scene->facet_material[facet] &&
            fabs(records[i].cos_theta - records[facet].cos_theta) <= COPLANAR_TURN &&
            facets_turn(scene, i, facet) <= COPLANAR_TURN) {
            glint += records[i].sigma_glint_m2;
        }
    }
    return glint;
}

void lrcs_host_glint_sum_make(const lrcs_scene *scene, const lrcs_facet_record *records,
                              const lrcs_host_glint *list, uint32_t count, lrcs_host_glint_sum *sum)
{
    *sum = (lrcs_host_glint_sum){.facet = LRCS_NONE};
    const lrcs_host_glint *entry = NULL;
    double error = 0.0;
    for (uint32_t i = 0; i < scene->facet_count; i++) {
        /* facets of one part and material mostly follow one another */
        if (i == 0 || scene->facet_part[i] != scene->facet_part[i - 1] ||
            scene->facet_material[i] != scene->facet_material[i - 1]) {
            double s = scene->material[scene->facet_material[i]].brdf.s;
            const lrcs_host_glint key = {.part = scene->facet_part[i],
                                         .material = scene->facet_material[i]};
            entry = count > 0 ? bsearch(&key, list, count, sizeof *list, entry_order) : NULL;
            error = !entry          ? 0.0
                    : s == entry->s ? entry->error
                                    : lrcsi_aliasing_error(entry->turn, s);
        }
        double glint = records[i].sigma_glint_m2;
        if (!entry || !(error > LRCS_HOST_GLINT_COARSE) || !(glint > 0.0)) {
            continue;
        }
        sum->glint_m2 += glint;
        sum->error_m2 += glint * fmin(error, 1.0);
        if (sum->facet == LRCS_NONE || glint > records[sum->facet].sigma_glint_m2) {
            sum->facet = i;
        }
    }
    sum->most_m2 = sum->facet == LRCS_NONE ? 0.0 : face_glint(scene, records, sum->facet);
}

int lrcs_host_glint_dominates(const lrcs_host_glint_sum *sum, double sigma_m2)
{
    return sum->most_m2 > 0.5 * sigma_m2;
}

int lrcs_host_glint_coarse(const lrcs_host_scene *base, const lrcs_build_options *build, int all,
                           lrcs_host_glint **list, uint32_t *count, lrcs_host_error *error)
{
    lrcs_host_scene smooth;
    lrcs_host_glint *entry = NULL;
    lrcs_build_options options = *build;
    uint32_t found = 0;
    uint32_t used = 0;
    *list = NULL;
    *count = 0;
    if (base->scene.normals != LRCS_NORMALS_FLAT) {
        return LRCS_OK;
    }
    memset(&smooth, 0, sizeof smooth);
    options.normals = LRCS_NORMALS_SMOOTH;
    int status = lrcs_host_scene_vary(base, &base->recipe, &options, &smooth, error);
    if (status == LRCS_OK) {
        status = lrcs_host_glint_check(&smooth.scene, &entry, &found, error);
    }
    for (uint32_t i = 0; status == LRCS_OK && i < found; i++) {
        int model = base->scene.part[entry[i].part].kind < 0; /* shapes meet the tolerance */
        if (model && (all || entry[i].error > LRCS_HOST_GLINT_COARSE)) {
            entry[used++] = entry[i];
        }
    }
    lrcs_host_scene_free(&smooth);
    if (status != LRCS_OK) {
        free(entry);
        return status;
    }
    *list = entry;
    *count = used;
    return LRCS_OK;
}
