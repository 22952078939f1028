/* SPDX-License-Identifier: MIT */
/* Proofs that nothing hides a curved shape in a view, or no proof. It does not decide what a shape
   then reflects.

   The true surface P of a part lies on the boundary of a convex body, so P hides none of its own
   front. It is clear if for each other part some plane proves that this part hides nothing of P
   (view/separation.c). Three kinds of planes are tried: those that contain the direction to the
   laser separate two silhouettes; one perpendicular to it separates a part that lies wholly behind
   P; those in between separate parts that stand on one another.

   If both parts touch the plane, P may be hidden within a slab at its lowest end. The area of P's
   lit surface in it, `slab`, is known if n is P's own axis (zones of the wall; the end there is a
   plane with the normal -n, which faces away from the laser or is within 16 u of edge-on) or if P
   is a sphere (a zone, for every n). */
#include "view/clear.h"

#include <math.h>

#include "base/constant.h"
#include "base/length.h"
#include "base/vec3.h"
#include "base/work.h"
#include "view/separation.h"

/* Does a plane across n, a unit vector to 8 u, separate a pair? If so, *slab is the area that may
   nevertheless be hidden. has_slab: the area of slabs of P across n is known. */
static int is_separating(const lrcsi_body *P, const lrcsi_body *Q, const double d[3],
                         const double n[3], int has_slab, double *slab)
{
    lrcsi_gap gap = lrcsi_gap_make(P, Q, d, n, 0);
    *slab = gap.separates ? 0 : lrcsi_body_slab(P, gap.height);
    return gap.separates ||
           (has_slab && gap.is_zero && lrcsi_body_support(P, n) - gap.low > 4 * gap.height);
}

/* Tries planes across n and -n, unless these face away from the laser; n need not have length 1. */
static int is_separated_along(const lrcsi_body *P, const lrcsi_body *Q, const double d[3],
                              const double n[3], int has_slab, double *slab)
{
    if (!(lrcsi_length(n) > LRCSI_GAP_NORMAL_MIN)) {
        return 0;
    }
    double up[3] = {n[0], n[1], n[2]};
    (void)lrcsi_length_normalise(up);
    const double down[3] = {-up[0], -up[1], -up[2]};
    double cosine = lrcsi_vec3_dot(up, d);
    return (cosine >= -8 * LRCSI_U && is_separating(P, Q, d, up, has_slab, slab)) ||
           (cosine <= 8 * LRCSI_U && is_separating(P, Q, d, down, has_slab, slab));
}

/* Tries these directions: P's axis; that to the laser; from centre to centre, and its projection
   into the view plane; the axes of Q; and, for long bodies and boxes, the directions in the view
   plane across each of these axes. */
static int is_separated(const lrcsi_body *P, const lrcsi_body *Q, const double d[3], double *slab)
{
    static const double body_axis[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const lrcs_brdf *brdf = &lrcsi_prepared_material(P->prepared, P->part->first_facet)->brdf;
    int has_slab = brdf->A == 0 || brdf->s <= LRCSI_SLAB_GLINT_SLOPE_MAX;
    int sphere_slab = has_slab && P->part->kind == LRCS_SHAPE_SPHERE;
    double between[3];
    double flat[3];
    double across[3];
    for (int k = 0; k < 3; k++) {
        between[k] = P->centre[k] - Q->centre[k];
    }
    double along = lrcsi_vec3_dot(between, d);
    for (int k = 0; k < 3; k++) {
        flat[k] = between[k] - along * d[k];
    }
    lrcsi_vec3_cross(P->part->axis[2], d, across);
    if (is_separated_along(P, Q, d, flat, sphere_slab, slab) ||
        is_separated_along(P, Q, d, P->part->axis[2], has_slab, slab) ||
        is_separated_along(P, Q, d, d, sphere_slab, slab) ||
        is_separated_along(P, Q, d, between, sphere_slab, slab) ||
        is_separated_along(P, Q, d, across, sphere_slab, slab)) {
        return 1;
    }
    const double(*axis)[3] = Q->part->rigid ? (const double(*)[3])Q->part->axis : body_axis;
    for (int k = Q->curved ? 2 : 0; k < 3; k++) {
        lrcsi_vec3_cross(axis[k], d, across);
        if (is_separated_along(P, Q, d, axis[k], sphere_slab, slab) ||
            is_separated_along(P, Q, d, across, sphere_slab, slab)) {
            return 1;
        }
    }
    return 0;
}

/* The inside of an open shape with a two-sided material is lit through its opening, and has no
   closed form here: shapes with one opening, at z = 0, show none of it from above. */
static int shows_no_inside(const lrcsi_view *view, const lrcs_part *part)
{
    const lrcs_material *material = lrcsi_prepared_material(view->prepared, part->first_facet);
    int one = part->kind != LRCS_SHAPE_CYLINDER && part->kind != LRCS_SHAPE_FRUSTUM;
    return part->solid || !material->two_sided || !view->backs.reflect ||
           (one && lrcsi_vec3_dot(part->axis[2], view->unit) > 16 * LRCSI_U);
}

size_t lrcsi_clear_need(const lrcs_prepared *p)
{
    size_t parts = p->extent ? p->scene->part_count : 0;
    return lrcsi_work_add(lrcsi_work_bytes(parts, 1),
                          lrcsi_work_add(lrcsi_work_bytes(parts, sizeof(double)),
                                         lrcsi_work_bytes(parts, sizeof(lrcsi_body))));
}

int lrcsi_clear_make(const lrcsi_view *view, lrcs_work *work, lrcsi_clear_shapes *clear)
{
    const lrcs_prepared *p = view->prepared;
    uint32_t parts = p->scene->part_count;
    *clear = (lrcsi_clear_shapes){NULL, NULL, 0, 0};
    if (!p->extent) {
        return LRCS_OK;
    }
    clear->part = lrcsi_work_take_zero(work, parts, 1);
    clear->slab = lrcsi_work_take_zero(work, parts, sizeof *clear->slab);
    size_t mark = work->used;
    lrcsi_body *body = lrcsi_work_take(work, parts, sizeof *body);
    if (!clear->part || !clear->slab || !body) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t i = 0; i < parts; i++) {
        body[i] = lrcsi_body_make(p, i);
    }
    clear->all = 1;
    for (uint32_t i = 0; i < parts; i++) {
        int is_clear = body[i].curved && shows_no_inside(view, body[i].part);
        for (uint32_t j = 0; j < parts && is_clear; j++) {
            double slab = 0;
            int live = p->extent[j].low[0] <= p->extent[j].high[0];
            is_clear = j == i || !live || is_separated(&body[i], &body[j], view->unit, &slab);
            clear->slab[i] += slab;
        }
        clear->part[i] = (unsigned char)is_clear;
        clear->count += (uint32_t)is_clear;
        clear->all &= is_clear || !(p->extent[i].low[0] <= p->extent[i].high[0]);
    }
    work->used = mark;
    return LRCS_OK;
}
