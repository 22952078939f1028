/* SPDX-License-Identifier: MIT */
/* Preparing a scene: scaling by a power of two, normals, edges, contacts, and what can be proved
   for every direction at once. It decides nothing that depends on the direction to the laser. */
#include "scene/prepare.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/dd.h"
#include "base/exact.h"
#include "base/ieee.h"
#include "base/length.h"
#include "base/range.h"
#include "base/work.h"
#include "mesh/tree.h"
#include "scene/across.h"
#include "scene/batch.h"
#include "scene/bulk.h"
#include "scene/coincident.h"
#include "scene/extent.h"
#include "scene/proximity.h"
#include "scene/runs.h"
#include "scene/solid.h"

/* Checks what lrcs_scene_build guarantees, so that no later stage needs to. *most: the largest
   magnitude of any coordinate of the facets' corners. */
static int scene_check(const lrcs_scene *scene, double *most)
{
    for (uint32_t v = 0; v < scene->vertex_count; v++) {
        const double *x = scene->vertex[v].x;
        if (!(fabs(x[0]) <= 1e100 && fabs(x[1]) <= 1e100 && fabs(x[2]) <= 1e100)) {
            return LRCS_E_NUMBER;
        }
    }
    double largest = 0;
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        const uint32_t *corner = scene->facet[f].corner;
        double of_facet = 0;
        for (int k = 0; k < 3; k++) {
            if (corner[k] >= scene->vertex_count) {
                return LRCS_E_INDEX;
            }
            const double *x = scene->vertex[corner[k]].x;
            double of_corner = lrcsi_max(fabs(x[0]), lrcsi_max(fabs(x[1]), fabs(x[2])));
            of_facet = lrcsi_max(of_facet, of_corner);
        }
        largest = lrcsi_max(largest, of_facet);
        for (int k = 0; scene->corner_normal && k < 9; k++) {
            if (!(fabs(scene->corner_normal[3 * (size_t)f + (size_t)k / 3].x[k % 3]) <= 1.0)) {
                return LRCS_E_NUMBER;
            }
        }
        if (scene->facet_material[f] >= scene->material_count ||
            scene->facet_part[f] >= scene->part_count) {
            return LRCS_E_INDEX;
        }
    }
    for (uint32_t i = 0; i < scene->material_count; i++) {
        if (lrcs_brdf_check(&scene->material[i].brdf) < 0) {
            return LRCS_E_NUMBER;
        }
    }
    *most = largest;
    return LRCS_OK;
}

/* Normals computed side by side. */
enum { CROSS_LANES = 8 };

/* If |N| is below this fraction of |p| |q|, the products cancel and N is computed exactly. */
#define NORMAL_SLIVER 0x1p-10

/* Sides p = b - a and q = c - a of facets, and N = p x q: component by component, so that compilers
   compute two facets or more at once. */
typedef struct cross_lanes {
    double a[3][CROSS_LANES], b[3][CROSS_LANES], c[3][CROSS_LANES];
    double p[3][CROSS_LANES], p_low[3][CROSS_LANES];
    double q[3][CROSS_LANES], q_low[3][CROSS_LANES];
    double high[3][CROSS_LANES], low[3][CROSS_LANES];
} cross_lanes;

/* The differences are exact. p_i q_j - p_j q_i: each product has relative error 7 u^2, the
   difference 3 u^2: together at most 10 u^2 (|p_i q_j| + |p_j q_i|). */
static void lanes_cross(cross_lanes *n)
{
    for (int k = 0; k < 3; k++) {
        for (int at = 0; at < CROSS_LANES; at++) {
            lrcsi_dd p = lrcsi_dd_two_sum(n->b[k][at], -n->a[k][at]);
            lrcsi_dd q = lrcsi_dd_two_sum(n->c[k][at], -n->a[k][at]);
            n->p[k][at] = p.hi;
            n->p_low[k][at] = p.lo;
            n->q[k][at] = q.hi;
            n->q_low[k][at] = q.lo;
        }
    }
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3;
        int j = (k + 2) % 3;
        for (int at = 0; at < CROSS_LANES; at++) {
            lrcsi_dd pi = {n->p[i][at], n->p_low[i][at]};
            lrcsi_dd pj = {n->p[j][at], n->p_low[j][at]};
            lrcsi_dd qi = {n->q[i][at], n->q_low[i][at]};
            lrcsi_dd qj = {n->q[j][at], n->q_low[j][at]};
            lrcsi_dd component = lrcsi_dd_sub(lrcsi_dd_mul(pi, qj), lrcsi_dd_mul(pj, qi));
            n->high[k][at] = component.hi;
            n->low[k][at] = component.lo;
        }
    }
}

/* The error of the three components together is at most 10 u^2 2 |p| |q| in norm; |p| |q| is
   computed within 10 u: 21 u^2 |p| |q| covers both. Of a sliver: 100 u^2 |N|. */
static void store_normal(lrcs_prepared *prepared, uint32_t facet, const cross_lanes *lanes, int at)
{
    lrcsi_normal *n = &prepared->normal[facet];
    const double p[3] = {lanes->p[0][at], lanes->p[1][at], lanes->p[2][at]};
    const double q[3] = {lanes->q[0][at], lanes->q[1][at], lanes->q[2][at]};
    for (int k = 0; k < 3; k++) {
        n->high[k] = lanes->high[k][at];
        n->low[k] = lanes->low[k][at];
    }
    double size = lrcsi_length(p) * lrcsi_length(q);
    n->length = lrcsi_length(n->high);
    n->error = 21 * LRCSI_U * LRCSI_U * size;
    if (n->length < NORMAL_SLIVER * size) {
        lrcsi_exact_normal(lrcsi_prepared_corner(prepared, facet, 0),
                           lrcsi_prepared_corner(prepared, facet, 1),
                           lrcsi_prepared_corner(prepared, facet, 2), n->high, n->low);
        n->length = lrcsi_length(n->high);
        n->error = 100 * LRCSI_U * LRCSI_U * n->length;
    }
}

/* The normals of all facets. */
static void compute_normals(lrcs_prepared *p)
{
    uint32_t count = p->scene->facet_count;
    cross_lanes lanes;
    for (uint32_t first = 0; first < count; first += CROSS_LANES) {
        for (uint32_t at = 0; at < CROSS_LANES; at++) { /* the last facet fills the last lanes */
            uint32_t f = first + at < count ? first + at : count - 1;
            for (int k = 0; k < 3; k++) {
                lanes.a[k][at] = lrcsi_prepared_corner(p, f, 0)[k];
                lanes.b[k][at] = lrcsi_prepared_corner(p, f, 1)[k];
                lanes.c[k][at] = lrcsi_prepared_corner(p, f, 2)[k];
            }
        }
        lanes_cross(&lanes);
        for (uint32_t at = 0; at < CROSS_LANES && first + at < count; at++) {
            store_normal(p, first + at, &lanes, (int)at);
        }
    }
}

/* Which facets are live, their corners, and what their materials and parts require. A facet that
   rounding left without area still makes its part count as curved. */
static void find_live(lrcs_prepared *p)
{
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        const lrcs_material *material = lrcsi_prepared_material(p, f);
        const lrcs_part *part = &p->scene->part[p->scene->facet_part[f]];
        p->curved |= !material->omitted && (part->reach > 0 || !part->curvature_known);
        p->skip[f] = p->topology.degenerate[f] || material->omitted;
        p->redundant[f] = p->skip[f] ? LRCSI_REDUNDANT : LRCSI_NOT_REDUNDANT;
        if (p->skip[f]) {
            continue;
        }
        const uint32_t *corner = p->scene->facet[f].corner;
        p->referenced[corner[0]] = p->referenced[corner[1]] = p->referenced[corner[2]] = 1;
        p->live++;
        p->two_sided |= material->two_sided != 0;
        p->glint |= material->brdf.A > 0;
        p->diffuse |= material->brdf.B > 0;
        p->articulated |= part->articulated != 0;
        p->smooth |= lrcsi_prepared_normals(p, f) != NULL;
    }
}

/* The box around the live facets, and that around most vertices. */
static void find_box(lrcs_prepared *p)
{
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL};
    double high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    double half[3] = {0, 0, 0};
    for (uint32_t v = 0; v < p->scene->vertex_count; v++) {
        for (int k = 0; k < 3 && p->referenced[v]; k++) {
            low[k] = lrcsi_min(low[k], p->vertex[v].x[k]);
            high[k] = lrcsi_max(high[k], p->vertex[v].x[k]);
        }
    }
    for (int k = 0; k < 3 && p->live > 0; k++) {
        p->centre[k] = 0.5 * (low[k] + high[k]);
        half[k] = fmax(high[k] - p->centre[k], p->centre[k] - low[k]);
        p->radius = fmax(p->radius, half[k]);
    }
    lrcsi_bulk_find(p, half);
}

/* ---- stages ---- */

/* Vertices are scaled in two steps, so that neither power overflows: exactly, unless they become 0.
 */
static int prepare_edges(lrcs_prepared *p, lrcs_work *work)
{
    const lrcs_scene *scene = p->scene;
    p->vertex = lrcsi_work_take(work, scene->vertex_count, sizeof *p->vertex);
    if (!p->vertex) {
        return LRCS_E_MEMORY;
    }
    double first = ldexp(1, -p->exponent / 2);
    double second = ldexp(1, -p->exponent - -p->exponent / 2);
    for (uint32_t v = 0; v < scene->vertex_count; v++) {
        for (int k = 0; k < 3; k++) {
            double x = scene->vertex[v].x[k] * first * second;
            p->vertex[v].x[k] = fabs(x) < LRCSI_COORDINATE_LEAST ? 0 : x;
        }
    }
    return lrcsi_topology_make(p->vertex, scene->vertex_count, scene->facet, scene->facet_count,
                               work, &p->topology);
}

/* Coincident facets come before neighbours: a redundant facet is not a neighbour of any other. */
static int prepare_neighbours(lrcs_prepared *p, lrcs_work *work)
{
    const lrcs_scene *scene = p->scene;
    p->skip = lrcsi_work_take(work, scene->facet_count, sizeof *p->skip);
    p->redundant = lrcsi_work_take(work, scene->facet_count, sizeof *p->redundant);
    p->referenced = lrcsi_work_take_zero(work, scene->vertex_count, sizeof *p->referenced);
    if (!p->skip || !p->redundant || !p->referenced) {
        return LRCS_E_MEMORY;
    }
    find_live(p);
    find_box(p);
    int status = lrcsi_coincident_mark(p, work);
    return status == LRCS_OK ? lrcsi_across_make(&p->topology, scene->facet_count, p->redundant,
                                                 p->opposite, work, &p->across)
                             : status;
}

/* The facets of a body that is convex by construction meet each other only in their boundaries, up
   to the rounding that grazing_cos allows for, so no search is needed. How they meet there is not
   decided: all facets are marked in `met`. */
static int contacts_of_convex(lrcs_prepared *p, lrcs_work *work)
{
    lrcsi_intersections *t = &p->intersections;
    size_t facets = p->scene->facet_count;
    t->first = lrcsi_work_take_zero(work, facets + 1, sizeof *t->first);
    t->met = lrcsi_work_take(work, facets, 1);
    if (!t->first || !t->met) {
        return LRCS_E_MEMORY;
    }
    memset(t->met, 1, facets);
    return LRCS_OK;
}

/* Pieces of surface are distinguished first, for contacts within one piece. Redundant facets are
   not searched, nor the second facet of an opposite pair, which gets a copy of the first one's
   list. Then the proof that the scene is solid. This stage comes before the normals, which use the
   memory of its scratch. */
static int prepare_contacts(lrcs_prepared *p, lrcs_work *work)
{
    uint32_t facets = p->scene->facet_count;
    p->convex = lrcsi_convex_by_construction(p, &p->solid);
    if (p->convex) {
        return contacts_of_convex(p, work);
    }
    unsigned char *without = lrcsi_work_take(work, facets, sizeof *without);
    size_t mark = work->used;
    uint32_t *piece = lrcsi_work_take(work, facets, sizeof *piece);
    if (!without || !piece) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t f = 0; f < facets; f++) {
        without[f] = p->redundant[f] == LRCSI_REDUNDANT || (p->opposite && p->opposite[f] < f);
    }
    if (lrcsi_solid_pieces(p, piece)) {
        p->piece = piece;
    } else {
        work->used = mark;
    }
    int status = lrcsi_intersection_make(p->vertex, p->scene->vertex_count, p->scene->facet, facets,
                                         &p->topology, without, p->piece, work, &p->intersections);
    if (status == LRCS_OK) {
        status = lrcsi_coincident_contacts(p, work);
    }
    if (status == LRCS_OK && p->piece && !p->intersections.self) {
        status = lrcsi_solid_outward(p, p->piece, work, &p->solid);
    }
    return status;
}

static int prepare_normals(lrcs_prepared *p, lrcs_work *work)
{
    p->normal = lrcsi_work_take(work, p->scene->facet_count, sizeof *p->normal);
    if (!p->normal) {
        return LRCS_E_MEMORY;
    }
    compute_normals(p);
    return lrcsi_batches_make(p, work);
}

/* Proves that a solid scene is convex, if it is one piece of surface; finds which facets are close
   to curved shapes, and the extents of parts; last, makes the runs of facets. */
static int prepare_proofs(lrcs_prepared *p, lrcs_work *work)
{
    int status = LRCS_OK;
    if (p->convex) {
        p->grazing_cos = lrcsi_convex_grazing(p);
    }
    if (p->piece && p->solid) {
        uint32_t pieces = 0;
        for (uint32_t f = 0; f < p->scene->facet_count; f++) {
            pieces += !p->skip[f] && p->piece[f] == f;
        }
        if (pieces == 1) {
            status = lrcsi_convex_exact(p, work, &p->convex);
        }
    }
    p->convex |= p->live == 0;
    if (status == LRCS_OK && p->curved && !p->convex) {
        status = lrcsi_proximity_make(p, work);
    }
    if (status == LRCS_OK && p->curved) {
        status = lrcsi_extents_make(p, work);
    }
    return status == LRCS_OK ? lrcsi_runs_make(p, work, &p->runs) : status;
}

/* ---- public ---- */

static size_t larger(size_t a, size_t b)
{
    return a > b ? a : b;
}

/* Each stage leaves its results and releases its scratch; of the scratch only the largest counts.
   lrcsi_topology_need, _coincident_need and _intersection_need include the scratch of these
   stages. */
size_t lrcs_prepare_need(const lrcs_scene *scene)
{
    uint32_t vertices = scene->vertex_count;
    size_t facets = scene->facet_count;
    size_t contacts = 4 * facets + 64;
    /* 1. Edges and neighbours. */
    size_t need = lrcsi_work_bytes(1, sizeof(lrcs_prepared));
    need = lrcsi_work_add(need, lrcsi_work_bytes(vertices, sizeof(lrcs_point)));
    need = lrcsi_work_add(need, lrcsi_topology_need(vertices, scene->facet_count));
    need = lrcsi_work_add(need, 2 * lrcsi_work_bytes(facets, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(vertices, 1));
    size_t coincident = lrcsi_work_add(need, lrcsi_coincident_need(vertices, scene->facet_count));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(uint32_t))); /* opposite */
    need = lrcsi_work_add(need, lrcsi_across_need(scene->facet_count));
    /* 2. Contacts: what is not searched, pieces of surface, and the search with its result. */
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(uint32_t)));
    size_t search = lrcsi_intersection_need(vertices, scene->facet_count, contacts);
    /* 3. What the search leaves; normals; the proof of convexity, or what is near curved shapes;
       runs. The volumes of pieces take less than the normals, which come later. */
    size_t proof = lrcsi_convex_exact_need(vertices, scene->facet_count);
    size_t proximity =
        lrcsi_work_add(lrcsi_proximity_need(scene), lrcsi_tree_need(scene->facet_count));
    proof = larger(proof, lrcsi_work_add(proximity, lrcsi_extents_need(scene)));
    proof = lrcsi_work_add(proof, lrcsi_work_bytes(facets + 1, sizeof(uint32_t)));
    proof = lrcsi_work_add(proof, lrcsi_work_bytes(facets, 1));
    proof = lrcsi_work_add(proof, lrcsi_work_bytes(contacts, sizeof(lrcsi_intersection)));
    proof = lrcsi_work_add(proof, lrcsi_work_bytes(facets, sizeof(lrcsi_normal)));
    proof = lrcsi_work_add(proof, lrcsi_batches_need(scene));
    proof = lrcsi_work_add(proof, lrcsi_runs_need(scene->facet_count));
    return larger(lrcsi_work_add(need, larger(search, proof)), coincident);
}

int lrcsi_prepare_start(const lrcs_scene *scene, lrcs_work *work, lrcs_prepared **prepared)
{
    double most = 0;
    int status = lrcsi_ieee_kept() ? scene_check(scene, &most) : LRCS_E_UNSUPPORTED;
    lrcs_prepared *p = status == LRCS_OK ? lrcsi_work_take_zero(work, 1, sizeof *p) : NULL;
    if (!p) {
        return status == LRCS_OK ? LRCS_E_MEMORY : status;
    }
    p->scene = scene;
    (void)frexp(most, &p->exponent); /* the largest coordinate is in [0.5, 1) once scaled */
    *prepared = p;
    return LRCS_OK;
}

int lrcsi_prepare_stage(lrcs_prepared *p, int stage, lrcs_work *work)
{
    switch (stage) {
    case LRCSI_PREPARE_EDGES:
        return prepare_edges(p, work);
    case LRCSI_PREPARE_NEIGHBOURS:
        return prepare_neighbours(p, work);
    case LRCSI_PREPARE_CONTACTS:
        return prepare_contacts(p, work);
    case LRCSI_PREPARE_NORMALS:
        return prepare_normals(p, work);
    default:
        return prepare_proofs(p, work);
    }
}

int lrcs_prepare_run(const lrcs_scene *scene, lrcs_work *work, const lrcs_prepared **prepared)
{
    size_t mark = work->used;
    lrcs_prepared *p = NULL;
    int status = lrcsi_prepare_start(scene, work, &p);
    for (int stage = 0; stage < LRCSI_PREPARE_STAGES && status == LRCS_OK; stage++) {
        status = lrcsi_prepare_stage(p, stage, work);
    }
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    *prepared = p;
    return LRCS_OK;
}
