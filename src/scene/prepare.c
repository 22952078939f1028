/* SPDX-License-Identifier: MIT */
/* Prepares a scene: scales it by a power of two, and computes its edges, contacts and normals, and
   what can be proved for all directions at once. It decides nothing that depends on the direction
   to the laser. */
#include "scene/prepare.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/ieee.h"
#include "base/range.h"
#include "base/work.h"
#include "mesh/box.h"
#include "mesh/contact/tree.h"
#include "scene/batch.h"
#include "scene/bulk.h"
#include "scene/coincident.h"
#include "scene/extent.h"
#include "scene/meshlets.h"
#include "scene/neighbours.h"
#include "scene/proximity.h"
#include "scene/proximity_search.h"
#include "scene/solid.h"

/* Checks what lrcs_scene_build guarantees, so that no later stage needs to. Returned: the exponent
   (frexp) of the largest coordinate of the facets' corners. */
static int scene_check(const lrcs_scene *scene, int *exponent)
{
    double all = 0;     /* the largest coordinate of all vertices */
    double largest = 0; /* of those that are corners */
    for (uint32_t v = 0; v < scene->vertex_count; v++) {
        const double *x = scene->vertex[v].x;
        if (!(fabs(x[0]) <= LRCSI_COORDINATE_MAX && fabs(x[1]) <= LRCSI_COORDINATE_MAX &&
              fabs(x[2]) <= LRCSI_COORDINATE_MAX)) {
            return LRCS_E_NUMBER;
        }
        double size = lrcsi_max(fabs(x[0]), lrcsi_max(fabs(x[1]), fabs(x[2])));
        all = lrcsi_max(all, size);
    }
    (void)frexp(all, exponent);
    double enough = ldexp(0.5, *exponent); /* all larger coordinates have the same exponent */
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        const uint32_t *corner = scene->facet[f].corner;
        if (corner[0] >= scene->vertex_count || corner[1] >= scene->vertex_count ||
            corner[2] >= scene->vertex_count) {
            return LRCS_E_INDEX;
        }
        for (int k = 0; k < 9 && largest < enough; k++) {
            largest = lrcsi_max(largest, fabs(scene->vertex[corner[k / 3]].x[k % 3]));
        }
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
    (void)frexp(largest, exponent);
    return LRCS_OK;
}

/* Marks live facets and their corners, and finds out what their materials and parts require. A
   facet that is degenerate, for instance by rounding, still makes the scene curved if its part
   is. */
static void find_live(lrcs_prepared *p)
{
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        const lrcs_material *material = lrcsi_prepared_material(p, f);
        const lrcs_part *part = &p->scene->part[p->scene->facet_part[f]];
        p->has_curved_shapes |=
            !material->omitted && (part->bounds.reach > 0 || !part->bounds.known);
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
        p->has_curved_normals |= lrcsi_prepared_normals(p, f) != NULL;
    }
}

/* The box around the live facets, and that around the bulk of the vertices. */
static void find_box(lrcs_prepared *p)
{
    lrcsi_box box = lrcsi_box_empty();
    double half[3] = {0, 0, 0};
    for (uint32_t v = 0; v < p->scene->vertex_count; v++) {
        if (p->referenced[v]) {
            lrcsi_box_add(&box, p->vertex[v].x);
        }
    }
    for (int k = 0; k < 3 && p->live > 0; k++) {
        p->centre[k] = 0.5 * (box.low[k] + box.high[k]);
        half[k] = fmax(box.high[k] - p->centre[k], p->centre[k] - box.low[k]);
        p->radius = fmax(p->radius, half[k]);
    }
    lrcsi_bulk_find(p, half);
}

/* ---- stages ---- */

/* Vertices are scaled by two powers of two, neither of which overflows. The result is exact, except
   that very small coordinates become 0. */
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
            p->vertex[v].x[k] = fabs(x) < LRCSI_COORDINATE_MIN ? 0 : x;
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
    return status == LRCS_OK ? lrcsi_neighbours_make(&p->topology, scene->facet_count, p->redundant,
                                                     p->opposite, work, &p->neighbours)
                             : status;
}

/* The contacts of a solid that is convex by construction: none. Its facets meet only in their
   boundaries, up to the rounding that grazing_cos allows for, so no search is needed. Whether they
   meet there otherwise than in shared vertices and edges is not decided: all facets are marked in
   `met`. */
static int contacts_of_convex_solid(lrcs_prepared *p, lrcs_work *work)
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

/* Finds the closed shells, then the contacts (it matters whether two facets in contact belong to
   the same shell), then which shells are solid. Redundant facets are not searched, nor is the
   second facet of an opposite pair, which gets a copy of the list of the first. This stage comes
   before the normals, which reuse the memory of its scratch. */
static int prepare_contacts(lrcs_prepared *p, lrcs_work *work)
{
    uint32_t facets = p->scene->facet_count;
    p->convex = lrcsi_convex_by_construction(p, &p->solid);
    if (p->convex && p->solid) {
        return contacts_of_convex_solid(p, work);
    }
    unsigned char *excluded = lrcsi_work_take(work, facets, sizeof *excluded);
    lrcsi_shells shells = {.of = lrcsi_work_take(work, facets, sizeof *shells.of),
                           .self = lrcsi_work_take(work, facets, sizeof *shells.self)};
    if (!excluded || !shells.of || !shells.self) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t f = 0; f < facets; f++) {
        excluded[f] = p->redundant[f] == LRCSI_REDUNDANT || (p->opposite && p->opposite[f] < f);
    }
    lrcsi_solid_shells(p, &shells);
    int status = lrcsi_intersection_make(p->vertex, p->scene->vertex_count, p->scene->facet, facets,
                                         &p->topology, excluded, &shells, work, &p->intersections);
    if (status == LRCS_OK) {
        status = lrcsi_coincident_contacts(p, work);
    }
    return status == LRCS_OK ? lrcsi_solid_find(p, &shells, work) : status;
}

static int prepare_normals(lrcs_prepared *p, lrcs_work *work)
{
    p->normal = lrcsi_work_take(work, p->scene->facet_count, sizeof *p->normal);
    if (!p->normal) {
        return LRCS_E_MEMORY;
    }
    return lrcsi_batches_make(p, work);
}

/* Tries to prove that a solid scene of one shell is convex; finds which facets are close
   to curved shapes, and the extents of parts; last, makes the meshlets. */
static int prepare_proofs(lrcs_prepared *p, lrcs_work *work)
{
    int status = LRCS_OK;
    if (p->convex) {
        p->grazing_cos = lrcsi_convex_grazing(p);
    }
    if (p->solid && p->solid_shells == 1) {
        status = lrcsi_convex_exact(p, work, &p->convex);
    }
    p->convex |= p->live == 0;
    if (status == LRCS_OK && p->has_curved_shapes && !p->convex) {
        status = lrcsi_proximity_make(p, work);
        if (status == LRCS_OK && p->proximity.reach) {
            status = lrcsi_proximity_search(p, work);
        }
    }
    if (status == LRCS_OK && p->has_curved_shapes) {
        status = lrcsi_extents_make(p, work);
    }
    return status == LRCS_OK ? lrcsi_meshlets_make(p, work, &p->meshlets) : status;
}

/* ---- public ---- */

static size_t larger(size_t a, size_t b)
{
    return a > b ? a : b;
}

/* Each stage keeps its results and releases its scratch, so that only the largest scratch counts.
   lrcsi_topology_need, _coincident_need and _intersection_need include the scratch. */
size_t lrcs_prepare_need(const lrcs_scene *scene)
{
    uint32_t vertices = scene->vertex_count;
    size_t facets = scene->facet_count;
    size_t contacts = 4 * facets + 64;
    /* 1. Edges and neighbours. */
    size_t need = lrcsi_work_bytes(1, sizeof(lrcs_prepared));
    need = lrcsi_work_add(need, lrcsi_work_bytes(vertices, sizeof(lrcs_point)));
    size_t edges = lrcsi_work_add(need, lrcsi_topology_need(vertices, scene->facet_count));
    need = lrcsi_work_add(need, lrcsi_topology_kept(vertices, scene->facet_count));
    need = lrcsi_work_add(need, lrcsi_work_blocks(2, facets, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(vertices, 1));
    size_t coincident = lrcsi_work_add(need, lrcsi_coincident_need(vertices, scene->facet_count));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(uint32_t))); /* opposite */
    need = lrcsi_work_add(need, lrcsi_neighbours_need(scene->facet_count));
    /* 2. Contacts: excluded facets, shells, and the search with its result. */
    need = lrcsi_work_add(need, lrcsi_work_blocks(2, facets, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(uint32_t)));
    size_t search = lrcsi_intersection_need(vertices, scene->facet_count, contacts);
    /* 3. The result of the search; normals. The volumes of shells, released before, need less than
       the normals. */
    size_t proof = lrcsi_work_bytes(facets + 1, sizeof(uint32_t));
    proof = lrcsi_work_add(proof, lrcsi_work_bytes(facets, 1));
    proof = lrcsi_work_add(proof, lrcsi_work_bytes(contacts, sizeof(lrcsi_intersection)));
    proof = lrcsi_work_add(proof, lrcsi_work_bytes(facets, sizeof(lrcsi_normal)));
    proof = lrcsi_work_add(proof, lrcsi_batches_need(scene));
    /* 4. The proof of convexity; proximity of curved shapes, found with a tree; extents; meshlets.
     */
    size_t pairs = lrcsi_proximity_need(scene);
    size_t scratch =
        larger(lrcsi_convex_exact_need(scene), pairs > 0 ? lrcsi_tree_need(scene->facet_count) : 0);
    proof = lrcsi_work_add(proof, lrcsi_work_add(pairs, lrcsi_extents_need(scene)));
    proof = lrcsi_work_add(proof, larger(scratch, lrcsi_meshlets_need(scene->facet_count)));
    return larger(lrcsi_work_add(need, larger(search, proof)), larger(edges, coincident));
}

int lrcsi_prepare_start(const lrcs_scene *scene, lrcs_work *work, lrcs_prepared **prepared)
{
    int exponent = 0;
    int status = lrcsi_ieee_conforms() ? scene_check(scene, &exponent) : LRCS_E_UNSUPPORTED;
    lrcs_prepared *p = status == LRCS_OK ? lrcsi_work_take_zero(work, 1, sizeof *p) : NULL;
    if (!p) {
        return status == LRCS_OK ? LRCS_E_MEMORY : status;
    }
    p->scene = scene;
    p->exponent = exponent; /* the largest scaled coordinate is in [0.5, 1) */
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
