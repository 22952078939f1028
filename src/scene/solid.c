/* SPDX-License-Identifier: MIT */
/* Proofs about a scene's shape: closed and outward (back sides are never seen), convex (front sides
   are never hidden). They refuse if they cannot prove it; nothing depends on direction. */
#include "scene/solid.h"

#include <math.h>

#include "base/constant.h"
#include "base/disjoint.h"
#include "base/exact.h"
#include "base/work.h"
#include "mesh/convex.h"

/* --- pieces: facets joined by edges ----------------------------------------------------------- */

/* Across each side of a live facet there is one other, unless the edge is irregular or a boundary
   edge. */
int lrcsi_solid_pieces(const lrcs_prepared *p, uint32_t *piece)
{
    uint32_t count = p->scene->facet_count;
    for (uint32_t f = 0; f < count; f++) {
        piece[f] = f;
        for (int k = 0; k < 3 && !p->skip[f]; k++) {
            uint32_t other = p->neighbours.facet[f].corner[k];
            if (p->opposite || other == f || other == count) {
                return 0;
            }
            if (other < f) {
                lrcsi_disjoint_union(piece, other, f);
            }
        }
    }
    lrcsi_disjoint_flatten(piece, count);
    return 1;
}

/* Six times the signed volume of a facet's tetrahedron about `o`, and a bound on its rounding: each
   difference, product and sum has a relative error of u, all below |a| |b| |c|, which the sums of
   their components' magnitudes bound without square roots. */
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

/* Every piece has positive volume, beyond the rounding of its sum. */
static int pieces_outward(const lrcs_prepared *p, const uint32_t *piece, double *volume,
                          double *error)
{
    uint32_t count = p->scene->facet_count;
    for (uint32_t f = 0; f < count; f++) {
        if (!p->skip[f]) {
            double off = 0;
            double six = tetrahedron(p, f, lrcsi_prepared_corner(p, piece[f], 0), &off);
            volume[piece[f]] += six;
            error[piece[f]] += off + 2 * LRCSI_U * fabs(volume[piece[f]]);
        }
    }
    for (uint32_t f = 0; f < count; f++) {
        if (!p->skip[f] && piece[f] == f && !(volume[f] > 2 * error[f])) {
            return 0;
        }
    }
    return 1;
}

int lrcsi_solid_outward(const lrcs_prepared *p, const uint32_t *piece, lrcs_work *work, int *proved)
{
    size_t mark = work->used;
    uint32_t count = p->scene->facet_count;
    double *volume = lrcsi_work_take_zero(work, count, sizeof *volume);
    double *error = lrcsi_work_take_zero(work, count, sizeof *error);
    int status = volume && error ? LRCS_OK : LRCS_E_MEMORY;
    if (status == LRCS_OK) {
        *proved = pieces_outward(p, piece, volume, error);
    }
    work->used = mark;
    return status;
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

/* The height (scaled) above the plane of `facet` of the corner of `other` that is not on their
   common edge; negative below. */
static double corner_above(const lrcs_prepared *p, uint32_t facet, uint32_t other)
{
    const lrcsi_normal *n = &p->normal[facet];
    const double *a = lrcsi_prepared_corner(p, facet, 0);
    double most = -HUGE_VAL;
    for (int corner = 0; corner < 3; corner++) {
        const double *x = lrcsi_prepared_corner(p, other, corner);
        double above = 0;
        for (int k = 0; k < 3; k++) {
            above += n->high[k] * (x[k] - a[k]);
        }
        most = fmax(most, above / n->length);
    }
    return most;
}

/* The largest such height over all edges, and the smallest altitude of a facet. */
static void measure_dents(const lrcs_prepared *p, double *dent, double *altitude)
{
    const lrcsi_topology *t = &p->topology;
    *dent = 0;
    *altitude = HUGE_VAL;
    for (uint32_t e = 0; e < t->edge_count; e++) {
        const double *a = p->vertex[t->edge[e].low].x;
        const double *b = p->vertex[t->edge[e].high].x;
        double length = sqrt((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]) +
                             (b[2] - a[2]) * (b[2] - a[2]));
        const lrcsi_edge_use *use = t->use + t->edge[e].first_use;
        for (uint32_t i = 0; i < t->edge[e].uses; i++) {
            *altitude = fmin(*altitude, p->normal[use[i].facet].length / length);
            uint32_t other = use[t->edge[e].uses - 1 - i].facet;
            *dent = fmax(*dent, corner_above(p, use[i].facet, other));
        }
    }
}

/* How far a part's vertices are from its convex surface, scaled. */
static double misplaced_by(const lrcs_prepared *p, const lrcs_part *part)
{
    return ldexp(part->misplaced, -p->exponent) + 4 * LRCSI_U;
}

int lrcsi_convex_by_construction(const lrcs_prepared *p, int *solid)
{
    uint32_t index = only_part(p);
    if (index == LRCS_NONE) {
        return 0;
    }
    const lrcs_part *part = &p->scene->part[index];
    int flat = part->kind == LRCS_SHAPE_PLATE || part->kind == LRCS_SHAPE_DISC;
    int thick = ldexp(part->thinnest, -p->exponent) > 1e6 * misplaced_by(p, part);
    int made = part->convex_patch && (flat || thick) && (part->solid || !p->two_sided);
    *solid = made && part->solid;
    return made;
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

/* The part's exact vertices lie on a convex surface, and the placed ones are within `off` of them.
   Facets in one plane hide none of each other, unless they are edge-on: then the threshold is 0.
   Otherwise:
   Suppose that a point x of a front facet is hidden by y = x + t d. The body lies below the tangent
   plane of the true surface, so y is within sagitta / cos(theta) of x. Where cos(theta) exceeds
   three turns, that distance is less than a facet, and every normal in that neighbourhood has a
   positive component along d: the surface there is a graph over the view plane, which a line of
   sight meets once, so x is not hidden. Without dents larger than rounding (bodies with plane
   faces, singly curved bodies, Delaunay diagonals) the exact mesh is itself convex, and only the
   tilt by rounding matters, at most 2 off / altitude for either facet; 16 covers both, with a
   margin. */
double lrcsi_convex_grazing(const lrcs_prepared *p)
{
    const lrcs_part *part = &p->scene->part[only_part(p)];
    double off = misplaced_by(p, part);
    double dent = 0;
    double altitude = 0;
    if (is_plane(p)) {
        return 0;
    }
    measure_dents(p, &dent, &altitude);
    return 16 * off / altitude + (dent > 16 * off ? 3 * part->curvature.turn : 0);
}

/* Considers the live facets alone if the topology's edges include others. */
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
