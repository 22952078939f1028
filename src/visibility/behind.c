/* SPDX-License-Identifier: MIT */
/* Tries a few planes for each pair of parts; view/separation.c proves what they decide. It does not
   look for parts that are far from one another in projection.

   A plane that both touch proves less: points of the part in front that are within rounding of it
   may be hidden. On flat facets of a flat-faced part the true surface is the facet. On a curved
   part this is used only across its own axis, and if its rings are level: then a facet and its
   patch extend over the same heights, and the area of the true surface in a slab is known
   (lrcsi_body_slab). */
#include "visibility/behind.h"

#include <math.h>

#include "base/constant.h"
#include "base/range.h"
#include "base/vec3.h"

/* The axes of a part across which a plane may be tangent to it: one of a body of revolution, three
   of a box or a plate. */
static int axes_of(const lrcsi_body *body, const double axis[3][3], const double *list[3])
{
    static const double none[1][3] = {{0, 0, 0}};
    int count = !body->part->rigid ? 0 : body->curved ? 1 : 3;
    for (int k = 0; k < 3; k++) {
        list[k] = k < count ? axis[2 - k] : none[0];
    }
    return count;
}

/* The plane across n or -n, whichever does not face away from the laser. */
static int behind_across(const lrcsi_body *front, const lrcsi_body *back, const double d[3],
                         const double axis[3], int own, lrcsi_behind *behind)
{
    double sign = lrcsi_vec3_dot(axis, d) < 0 ? -1 : 1;
    const double n[3] = {sign * axis[0], sign * axis[1], sign * axis[2]};
    lrcsi_gap gap = lrcsi_gap_make(front, back, d, n, 1);
    int is_flat = front->part->reach == 0;
    int has_slab = is_flat || (front->curved && own && front->beyond == 0);
    if (!gap.is_open && !(gap.is_shut && has_slab)) {
        return 0;
    }
    *behind = (lrcsi_behind){1, {n[0], n[1], n[2]}, -HUGE_VAL, 0};
    if (gap.is_shut) {
        behind->level = gap.low + gap.height;
        behind->slab = is_flat ? 0 : lrcsi_body_slab(front, gap.height);
    }
    return 1;
}

lrcsi_behind lrcsi_behind_make(const lrcsi_body *front, const lrcsi_body *back, const double d[3])
{
    lrcsi_behind behind = {0, {0, 0, 0}, 0, 0};
    const double *axis[3];
    int own = axes_of(front, (const double(*)[3])front->part->axis, axis);
    for (int k = 0; k < own; k++) {
        if (behind_across(front, back, d, axis[k], 1, &behind)) {
            return behind;
        }
    }
    int others = axes_of(back, (const double(*)[3])back->part->axis, axis);
    for (int k = 0; k < others; k++) {
        if (behind_across(front, back, d, axis[k], 0, &behind)) {
            return behind;
        }
    }
    return behind;
}

/* The heights n . x of a facet's points are linear: at most the fraction 2 (level - low) / (high -
   low) of its area is below the level. */
double lrcsi_behind_fraction(const lrcsi_behind *behind, const lrcs_prepared *p, uint32_t facet)
{
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        double height = lrcsi_vec3_dot(behind->n, lrcsi_prepared_corner(p, facet, k));
        low = lrcsi_min(low, height);
        high = lrcsi_max(high, height);
    }
    double below = behind->level + 16 * LRCSI_U - low;
    if (!(below > 0)) {
        return 0;
    }
    double area = 0.5 * p->normal[facet].length;
    double fraction = 2 * (below + 16 * LRCSI_U) / (high - low) + behind->slab / area;
    return fraction < 1 ? fraction * (1 + 16 * LRCSI_U) : 1;
}
