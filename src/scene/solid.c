/* SPDX-License-Identifier: MIT */
/* Proofs about a scene's surface: solid shells (back sides are never seen), convex (front sides are
   never hidden). What cannot be proved counts as false. Nothing depends on direction. */
#include "scene/solid.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/disjoint.h"
#include "base/exact.h"
#include "base/vec3.h"
#include "base/work.h"
#include "mesh/convex.h"

/* --- shells ----------------------------------------------------------------------------------- */

/* A live facet has a neighbour across each side unless the edge is irregular or a boundary edge, or
   the facet is always redundant. */
void lrcsi_solid_shells(const lrcs_prepared *p, const lrcsi_shells *shells)
{
    uint32_t *shell = shells->of;
    unsigned char *closed = shells->self; /* until the last step */
    uint32_t count = p->scene->facet_count;
    for (uint32_t f = 0; f < count; f++) {
        shell[f] = f;
        closed[f] = 1;
        for (int k = 0; k < 3 && !p->skip[f]; k++) {
            uint32_t other = p->neighbours.facet[f].corner[k];
            if (other < f) {
                lrcsi_disjoint_union(shell, other, f);
            }
        }
    }
    lrcsi_disjoint_flatten(shell, count);
    for (uint32_t f = 0; f < count; f++) {
        int regular = !p->skip[f] && !(p->opposite && p->opposite[f] != LRCS_NONE);
        for (int k = 0; k < 3 && regular; k++) {
            uint32_t other = p->neighbours.facet[f].corner[k];
            regular = other != f && other != count;
        }
        closed[shell[f]] &= regular != 0;
    }
    for (uint32_t f = 0; f < count; f++) {
        shell[f] = closed[shell[f]] ? shell[f] : LRCS_NONE;
    }
    memset(shells->self, 0, count);
}

/* Six times the signed volume of the tetrahedron of a facet and the point o, and a bound on its
   rounding error: each difference, product and sum has a relative error of u, and all are at most
   |a| |b| |c|. The sums of the magnitudes of their components are upper bounds of these norms,
   without square roots. */
static double tetrahedron(const lrcs_prepared *p, uint32_t facet, const double *o, double *error)
{
    double v[3][3];
    double size = 1;
    for (int corner = 0; corner < 3; corner++) {
        const double *x = lrcsi_prepared_corner(p, facet, corner);
        for (int k = 0; k < 3; k++) {
            v[corner][k] = x[k] - o[k];
        }
        size *= fabs(v[corner][0]) + fabs(v[corner][1]) + fabs(v[corner][2]);
    }
    double det = v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) +
                 v[0][1] * (v[1][2] * v[2][0] - v[1][0] * v[2][2]) +
                 v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
    *error = 40 * LRCSI_U * size;
    return det;
}

/* What is known of a shell. */
typedef struct shell_proof {
    double volume, error; /* times 6 */
    int curved;           /* it has facets of a curved surface */
} shell_proof;

int lrcsi_solid_find(lrcs_prepared *p, const lrcsi_shells *shells, lrcs_work *work)
{
    size_t mark = work->used;
    uint32_t count = p->scene->facet_count;
    shell_proof *proof = lrcsi_work_take_zero(work, count, sizeof *proof);
    if (!proof) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t f = 0; f < count; f++) {
        uint32_t shell = shells->of[f];
        if (shell != LRCS_NONE && !shells->self[shell]) {
            double six_err = 0;
            double six = tetrahedron(p, f, lrcsi_prepared_corner(p, shell, 0), &six_err);
            proof[shell].volume += six;
            proof[shell].error += six_err + 2 * LRCSI_U * fabs(proof[shell].volume);
            proof[shell].curved |= p->scene->part[p->scene->facet_part[f]].bounds.reach > 0;
        }
    }
    p->solid = 1;
    for (uint32_t f = 0; f < count; f++) {
        uint32_t shell = shells->of[f];
        int solid = shell != LRCS_NONE && !shells->self[shell] &&
                    proof[shell].volume > 2 * proof[shell].error;
        p->solid &= solid || p->skip[f];
        p->solid_shells += solid && shell == f;
        if (solid && !proof[shell].curved) {
            p->redundant[f] = LRCSI_REDUNDANT_IN_SOLID;
        }
    }
    work->used = mark;
    return LRCS_OK;
}

/* --- convexity -------------------------------------------------------------------------------- */

/* The only part with live facets, or LRCS_NONE if there is no such part. */
static uint32_t only_part(const lrcs_prepared *p)
{
    uint32_t part = LRCS_NONE;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        if (p->skip[f]) {
            continue;
        }
        if (part != LRCS_NONE && part != p->scene->facet_part[f]) {
            return LRCS_NONE;
        }
        part = p->scene->facet_part[f];
    }
    return part;
}

/* The height of the corner of `other` that is not on the common edge above the plane of `facet`,
   scaled; negative below the plane. */
static double corner_height(const lrcs_prepared *p, uint32_t facet, uint32_t other)
{
    const lrcsi_normal *n = &p->normal[facet];
    const double *a = lrcsi_prepared_corner(p, facet, 0);
    double highest = -HUGE_VAL;
    for (int corner = 0; corner < 3; corner++) {
        const double *x = lrcsi_prepared_corner(p, other, corner);
        double from_a[3];
        lrcsi_vec3_between(a, x, from_a);
        highest = fmax(highest, lrcsi_vec3_dot(n->high, from_a) / n->length);
    }
    return highest;
}

/* The largest such height over all edges (0 if none is positive), and the smallest altitude of all
   facets. */
static void measure_concavity(const lrcs_prepared *p, double *concavity, double *altitude)
{
    const lrcsi_topology *t = &p->topology;
    *concavity = 0;
    *altitude = HUGE_VAL;
    for (uint32_t e = 0; e < t->edge_count; e++) {
        const double *a = p->vertex[t->edge[e].low].x;
        const double *b = p->vertex[t->edge[e].high].x;
        double along[3];
        lrcsi_vec3_between(a, b, along);
        double length = sqrt(lrcsi_vec3_dot(along, along));
        const lrcsi_edge_use *use = t->use + t->edge[e].first_use;
        for (uint32_t i = 0; i < t->edge[e].uses; i++) {
            *altitude = fmin(*altitude, p->normal[use[i].facet].length / length);
            uint32_t other = use[t->edge[e].uses - 1 - i].facet;
            *concavity = fmax(*concavity, corner_height(p, use[i].facet, other));
        }
    }
}

/* A bound on the distance of a part's vertices from its convex surface, scaled. */
static double vertex_error(const lrcs_prepared *p, const lrcs_part *part)
{
    return ldexp(part->bounds.position_err, -p->exponent) + 4 * LRCSI_U;
}

/* The argument at lrcsi_convex_grazing supposes that vertex errors are small compared with the
   body. A body that is not this many times as thick as its vertex errors is not proved convex: far
   more than the argument needs. */
#define THICK_MIN 1e6

int lrcsi_convex_by_construction(const lrcs_prepared *p, int *solid)
{
    uint32_t index = only_part(p);
    if (index == LRCS_NONE) {
        return 0;
    }
    const lrcs_part *part = &p->scene->part[index];
    int flat = part->kind == LRCS_SHAPE_PLATE || part->kind == LRCS_SHAPE_DISC;
    int thick = ldexp(part->min_extent, -p->exponent) > THICK_MIN * vertex_error(p, part);
    int convex = part->convex_patch && (flat || thick) && (part->solid || !p->two_sided);
    *solid = convex && part->solid;
    return convex;
}

/* Do all live facets lie exactly in one plane? */
static int is_plane(const lrcs_prepared *p)
{
    const double *plane[3] = {NULL, NULL, NULL};
    int flat = 1;
    for (uint32_t f = 0; f < p->scene->facet_count && flat; f++) {
        for (int k = 0; k < 3 && !p->skip[f] && !plane[k]; k++) {
            plane[k] = lrcsi_prepared_corner(p, f, k);
        }
        for (int k = 0; k < 3 && !p->skip[f] && flat; k++) {
            flat =
                lrcsi_exact_side(plane[0], plane[1], plane[2], lrcsi_prepared_corner(p, f, k)) == 0;
        }
    }
    return flat;
}

/* The exact vertices of the part lie on a convex surface; the placed ones are within vertex_err of
   them. Facets in one plane hide none of each other, except edge-on, so their threshold is 0. In
   all other cases suppose that a point x of a front facet is hidden by y = x + t d. The body lies
   below the tangent plane of the true surface, so y is within sagitta / cos(theta) of x. If
   cos(theta) exceeds three times the turn of a facet, that distance is less than the size of a
   facet, and every normal in that neighbourhood has a positive component along d. There the surface
   is a graph over the view plane, which a line of sight meets once, so x is not hidden: a
   contradiction. If no concavity is larger than rounding can make it (bodies with plane faces,
   singly curved bodies, Delaunay diagonals), the exact mesh is itself convex, and only the rotation
   by rounding matters: at most 2 vertex_err / altitude for each of the two facets, which a factor
   of 16 covers with a margin. */
double lrcsi_convex_grazing(const lrcs_prepared *p)
{
    const lrcs_part *part = &p->scene->part[only_part(p)];
    double vertex_err = vertex_error(p, part);
    double concavity = 0;
    double altitude = 0;
    if (is_plane(p)) {
        return 0;
    }
    measure_concavity(p, &concavity, &altitude);
    return 16 * vertex_err / altitude +
           (concavity > 16 * vertex_err ? 3 * part->bounds.patch.turn : 0);
}

/* The proof for scenes with omitted facets: the edges of p->topology include these, so a topology
   of the live facets alone is made. */
static int convex_without_omitted(const lrcs_prepared *p, lrcs_work *work, int *proved)
{
    lrcs_facet *facet = lrcsi_work_take(work, p->live, sizeof *facet);
    uint32_t count = 0;
    for (uint32_t f = 0; f < p->scene->facet_count && facet; f++) {
        if (!p->skip[f]) {
            facet[count++] = p->scene->facet[f];
        }
    }
    uint32_t vertices = p->scene->vertex_count;
    lrcsi_topology t;
    int status =
        facet ? lrcsi_topology_make(p->vertex, vertices, facet, count, work, &t) : LRCS_E_MEMORY;
    return status == LRCS_OK
               ? lrcsi_convex_prove(p->vertex, vertices, facet, count, &t, work, proved)
               : status;
}

size_t lrcsi_convex_exact_need(const lrcs_scene *scene)
{
    size_t need = lrcsi_convex_need(scene->vertex_count, scene->facet_count);
    int omits = 0;
    for (uint32_t i = 0; i < scene->material_count; i++) {
        omits |= scene->material[i].omitted;
    }
    if (omits) {
        need = lrcsi_work_add(need, lrcsi_work_bytes(scene->facet_count, sizeof(lrcs_facet)));
        need = lrcsi_work_add(need, lrcsi_topology_need(scene->vertex_count, scene->facet_count));
    }
    return need;
}

int lrcsi_convex_exact(const lrcs_prepared *p, lrcs_work *work, int *proved)
{
    size_t mark = work->used;
    uint32_t omitted = 0;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        omitted += p->skip[f] && !p->topology.degenerate[f];
    }
    int status = omitted != 0
                     ? convex_without_omitted(p, work, proved)
                     : lrcsi_convex_prove(p->vertex, p->scene->vertex_count, p->scene->facet,
                                          p->scene->facet_count, &p->topology, work, proved);
    work->used = mark;
    return status;
}
