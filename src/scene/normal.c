/* SPDX-License-Identifier: MIT */
/* Computes normals of facets in double-double, and their errors. Decides which of them need exact
   arithmetic. */
#include "scene/normal.h"

#include <math.h>

#include "base/constant.h"
#include "base/dd.h"
#include "base/exact.h"
#include "base/length.h"

/* The number of normals that are computed at once. */
enum { CROSS_LANES = 8 };

/* If |N| is below this fraction of |p| |q|, the products cancel and N is computed exactly. */
#define NORMAL_SLIVER 0x1p-10

/* Sides p = b - a and q = c - a of facets, and N = p x q. Equal components are contiguous, so that
   compilers can vectorize over facets. */
typedef struct cross_lanes {
    double a[3][CROSS_LANES], b[3][CROSS_LANES], c[3][CROSS_LANES];
    double p[3][CROSS_LANES], p_low[3][CROSS_LANES];
    double q[3][CROSS_LANES], q_low[3][CROSS_LANES];
    double high[3][CROSS_LANES], low[3][CROSS_LANES];
} cross_lanes;

/* Computes the cross products. The differences p and q are exact. In p_i q_j - p_j q_i each product
   has a relative error of 7 u^2 and the difference one of 3 u^2: together at most
   10 u^2 (|p_i q_j| + |p_j q_i|). */
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

/* Stores a normal with its error. The norm of the error of its three components is at most
   10 u^2 2 |p| |q|, and |p| |q| is computed to within 10 u: 21 u^2 |p| |q| covers both. The exact
   normal of a sliver is rounded to within 100 u^2 |N|. */
static void store_normal(lrcs_prepared *prepared, uint32_t facet, const cross_lanes *lanes,
                         uint32_t at)
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

void lrcsi_normals_make(lrcs_prepared *p, const uint32_t *facet, uint32_t count)
{
    cross_lanes lanes;
    for (uint32_t first = 0; first < count; first += CROSS_LANES) {
        for (uint32_t at = 0; at < CROSS_LANES; at++) { /* the last facet fills the last lanes */
            uint32_t f = facet[first + at < count ? first + at : count - 1];
            for (int k = 0; k < 3; k++) {
                lanes.a[k][at] = lrcsi_prepared_corner(p, f, 0)[k];
                lanes.b[k][at] = lrcsi_prepared_corner(p, f, 1)[k];
                lanes.c[k][at] = lrcsi_prepared_corner(p, f, 2)[k];
            }
        }
        lanes_cross(&lanes);
        for (uint32_t at = 0; at < CROSS_LANES && first + at < count; at++) {
            store_normal(p, facet[first + at], &lanes, at);
        }
    }
}
