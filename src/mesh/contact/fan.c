/* SPDX-License-Identifier: MIT */
/* The fan of a point v: the facets v b c that contain it, each with its corners listed from v. Its
   spokes are the rays from v through b (where the facet starts) and c (where it ends). Let m be any
   vector.

   Theorem. Suppose that
   1. (b - v) x (c - v) . m > 0 for every facet: seen against m it fills a sector of less than 180
      degrees, which runs counter-clockwise from its start to its end;
   2. no spoke is the start of two facets, nor the end of two;
   3. at most one spoke is a start only; then one spoke is an end only, for there are as many starts
      as ends;
   4. if there is such a spoke, some direction is in no sector; if not, some direction is in exactly
      one.
   Then any two facets of the fan meet only in v and in the side that they have in common.
   Proof. Let n be the number of sectors that contain a direction. Going round counter-clockwise, n
   rises by one at a start and falls by one at an end (2). If every spoke is both, n is the same
   everywhere: 1 by condition 4. Otherwise n is k + 1 from the spoke that is a start only to the
   spoke that is an end only, and k elsewhere; k = 0 by condition 4. So the interiors of sectors do
   not overlap. Nor do two spokes coincide, seen against m. If both are ends, n would be 2 just
   before them; if both are starts, just after them; and if one is the only start and the other the
   only end, no direction would be in no sector. So if points of two facets coincide, seen against
   m, they are v or lie on one spoke that bounds both sectors. As m is parallel to neither facet
   (1), the points are equal only there, and along this spoke both facets have the same side. []

   Condition 4 is decided with a line through v along w and -w, for some w: g = m x w. Seen against
   m, a sector contains w if it starts with g . (b - v) < 0 and ends with g . (c - v) > 0, and -w if
   the signs are reversed. If all signs are certain, no spoke lies on the line, and `up` and `down`,
   the numbers of sectors that contain w and -w, are exact. If one spoke is a start only, up = 0 or
   down = 0 shows a direction in no sector. If both are 1, then k is 0 or 1, and the spokes that are
   a start only and an end only do not separate w from -w, so that they lie on one side of the line.
   Then k = 0 if the turn from the end to the start is counter-clockwise (less than 180 degrees, in
   no sector), and k = 1 if it is clockwise.

   m, roughly the mean normal, is rounded to whole numbers up to M = 2^20 and w is (5, 3, 7), so
   that g is exact and |g_k| <= 12 M. Errors, u = 2^-53: in g . d a difference is rounded once, a
   product once, their sum twice: in all less than 10 u 12 M (|d_x| + |d_y| + |d_z|). In the
   determinant of condition 1, a component of the normal q x p has an error of at most
   5 u (|q_i p_j| + |q_j p_i|) (base/exact.c), and the sum of three products one of 3 u of its
   terms: less than 10 u M times the sum of the components' |q_i p_j| + |q_j p_i|. */
#include "mesh/contact/fan.h"

#include <math.h>

#include "base/constant.h"
#include "base/exact.h"
#include "base/range.h"
#include "base/vec3.h"
#include "base/work.h"

/* 10 u */
#define FAN_FILTER (10.0 * LRCSI_U)

/* The smallest number of facets around an apex. */
enum { FAN_FACETS = 32 };

/* m's largest component, M; the largest of g. */
#define FAN_SCALE  0x1p20
#define LINE_SCALE (12.0 * FAN_SCALE)

/* A point's fan, as far as it has been examined. */
typedef struct vertex_fan {
    float m[3];             /* sum of the facets' normals, then m */
    uint32_t count;         /* facets */
    uint32_t start, end;    /* the last spokes found that are a start only, and an end only */
    unsigned char open;     /* spokes that are starts only; 2 for more */
    unsigned char up, down; /* sectors above the directions w and -w; 2 for more */
    unsigned char refused;  /* a condition is not met, or not proved */
} vertex_fan;

/* count + increment, 0 or 1, saturating at 2; without a branch. */
static unsigned char count_to_2(unsigned char count, int increment)
{
    return (unsigned char)(count + (increment & (count < 2)));
}

/* Adds each facet's normal, scaled so that its largest component is 1, to m at its corners. */
static void sum_normals(const lrcs_point *vertex, const lrcs_facet *facet, uint32_t facet_count,
                        const uint32_t *weld, const unsigned char *skip, vertex_fan *fans)
{
    for (uint32_t f = 0; f < facet_count; f++) {
        if (skip && skip[f]) {
            continue;
        }
        const uint32_t *c = facet[f].corner;
        double cross[3];
        lrcsi_vec3_normal(vertex[c[0]].x, vertex[c[1]].x, vertex[c[2]].x, cross);
        double largest = lrcsi_max(fabs(cross[0]), lrcsi_max(fabs(cross[1]), fabs(cross[2])));
        double scale = largest > 0.0 ? 1.0 / largest : 0.0;
        const float n[3] = {(float)(cross[0] * scale), (float)(cross[1] * scale),
                            (float)(cross[2] * scale)};
        for (int corner = 0; corner < 3; corner++) {
            vertex_fan *r = &fans[weld[c[corner]]];
            r->count++;
            r->m[0] += n[0];
            r->m[1] += n[1];
            r->m[2] += n[2];
        }
    }
}

/* Rounds m to integers: the number that is added and subtracted has an ulp of 1. */
static void round_means(vertex_fan *fans, uint32_t vertex_count)
{
    const double to_integer = 0x1.8p52;
    for (uint32_t v = 0; v < vertex_count; v++) {
        vertex_fan *r = &fans[v];
        double x = fabs((double)r->m[0]);
        double y = fabs((double)r->m[1]);
        double z = fabs((double)r->m[2]);
        double largest = lrcsi_max(x, lrcsi_max(y, z));
        r->refused = !(largest > 0.0);
        double scale = largest > 0.0 ? FAN_SCALE / largest : 0.0;
        for (int k = 0; k < 3; k++) {
            r->m[k] = (float)(((double)r->m[k] * scale + to_integer) - to_integer);
        }
    }
}

/* Conditions 2 and 3. */
static void match_spokes(const lrcsi_topology *topology, const unsigned char *skip,
                         vertex_fan *fans)
{
    for (uint32_t e = 0; e < topology->edge_count; e++) {
        const lrcsi_edge *edge = &topology->edge[e];
        const lrcsi_edge_use *use = topology->use + edge->first_use;
        if (edge->uses == 2 && use[0].forward != use[1].forward &&
            !(skip && (skip[use[0].facet] || skip[use[1].facet]))) {
            continue; /* most edges */
        }
        uint32_t uses[2] = {0, 0}; /* from high to low, from low to high */
        for (uint32_t i = 0; i < edge->uses; i++) {
            uses[use[i].forward] += !skip || !skip[use[i].facet];
        }
        if (uses[0] > 1 || uses[1] > 1) {
            fans[edge->low].refused = 1;
            fans[edge->high].refused = 1;
        } else if (uses[0] != uses[1]) {
            uint32_t from = uses[1] ? edge->low : edge->high;
            uint32_t to = uses[1] ? edge->high : edge->low;
            fans[from].start = to;
            fans[to].end = from;
            fans[from].open = count_to_2(fans[from].open, 1);
        }
    }
}

static void mean_of(const vertex_fan *r, double m[3])
{
    for (int k = 0; k < 3; k++) {
        m[k] = (double)r->m[k];
    }
}

/* Condition 1, and the sectors above the two directions. */
static void cross_sectors(const lrcs_point *vertex, const lrcs_facet *facet, uint32_t facet_count,
                          const uint32_t *weld, const unsigned char *skip, vertex_fan *fans)
{
    for (uint32_t f = 0; f < facet_count; f++) {
        if (skip && skip[f]) {
            continue;
        }
        const uint32_t *c = facet[f].corner;
        double side[3][3]; /* from each corner to the next */
        lrcsi_vec3_between(vertex[c[0]].x, vertex[c[1]].x, side[0]);
        lrcsi_vec3_between(vertex[c[1]].x, vertex[c[2]].x, side[1]);
        lrcsi_vec3_between(vertex[c[2]].x, vertex[c[0]].x, side[2]);
        const double *p = side[0];
        const double *q = side[2]; /* points back to c[0]: the normal is q x p */
        const double plus[3] = {q[1] * p[2], q[2] * p[0], q[0] * p[1]};
        const double minus[3] = {q[2] * p[1], q[0] * p[2], q[1] * p[0]};
        const double normal[3] = {plus[0] - minus[0], plus[1] - minus[1], plus[2] - minus[2]};
        double det_err = 0.0;
        double line_err[3]; /* of g . side */
        for (int k = 0; k < 3; k++) {
            det_err += fabs(plus[k]) + fabs(minus[k]);
            line_err[k] = FAN_FILTER * LINE_SCALE *
                          ((fabs(side[k][0]) + fabs(side[k][1])) + fabs(side[k][2]));
        }
        det_err *= FAN_FILTER * FAN_SCALE;
        for (int corner = 0; corner < 3; corner++) {
            vertex_fan *r = &fans[weld[c[corner]]];
            int last = corner > 0 ? corner - 1 : 2; /* the side that leads to the corner */
            double m[3];
            mean_of(r, m);
            const double g[3] = {7.0 * m[1] - 3.0 * m[2], 5.0 * m[2] - 7.0 * m[0],
                                 3.0 * m[0] - 5.0 * m[1]};
            double det = (normal[0] * m[0] + normal[1] * m[1]) + normal[2] * m[2];
            double start =
                (g[0] * side[corner][0] + g[1] * side[corner][1]) + g[2] * side[corner][2];
            double end = -((g[0] * side[last][0] + g[1] * side[last][1]) + g[2] * side[last][2]);
            int decided =
                (det > det_err) & (fabs(start) > line_err[corner]) & (fabs(end) > line_err[last]);
            r->refused |= (unsigned char)!decided;
            r->up = count_to_2(r->up, (start < 0.0) & (end > 0.0));
            r->down = count_to_2(r->down, (start > 0.0) & (end < 0.0));
        }
    }
}

/* All conditions together, of the fan of v. */
static int fan_is_proved(const lrcs_point *vertex, uint32_t v, const vertex_fan *r)
{
    if (r->refused || r->open > 1) {
        return 0;
    }
    if (r->open == 0) {
        return r->up == 1;
    }
    if (r->up == 0 || r->down == 0) {
        return 1;
    }
    double m[3];
    mean_of(r, m);
    return r->up == 1 && r->down == 1 &&
           lrcsi_exact_orient(vertex[v].x, vertex[r->end].x, vertex[r->start].x, m) > 0;
}

/* Among a facet's points that many facets share, the one with the most facets, preferring proved
   ones; or LRCS_NONE. */
static uint32_t apex_of(const lrcs_facet *facet, const uint32_t *weld, const vertex_fan *fans,
                        const unsigned char *proved)
{
    uint32_t apex = LRCS_NONE;
    for (int k = 0; k < 3; k++) {
        uint32_t v = weld[facet->corner[k]];
        if (fans[v].count >= FAN_FACETS &&
            (apex == LRCS_NONE || proved[v] > proved[apex] ||
             (proved[v] == proved[apex] && fans[v].count > fans[apex].count))) {
            apex = v;
        }
    }
    return apex;
}

size_t lrcsi_fans_need(uint32_t vertex_count)
{
    return lrcsi_work_bytes(vertex_count, sizeof(vertex_fan));
}

int lrcsi_fans_prove(const lrcs_point *vertex, uint32_t vertex_count, const lrcs_facet *facet,
                     uint32_t facet_count, const lrcsi_topology *topology,
                     const unsigned char *skip, lrcs_work *work, unsigned char *proved,
                     uint32_t *apex)
{
    size_t mark = work->used;
    const uint32_t *weld = topology->weld;
    vertex_fan *fans = lrcsi_work_take_zero(work, vertex_count, sizeof *fans);
    if (!fans) {
        return LRCS_E_MEMORY;
    }
    sum_normals(vertex, facet, facet_count, weld, skip, fans);
    round_means(fans, vertex_count);
    match_spokes(topology, skip, fans);
    cross_sectors(vertex, facet, facet_count, weld, skip, fans);
    for (uint32_t v = 0; v < vertex_count; v++) {
        proved[v] = (unsigned char)fan_is_proved(vertex, v, &fans[v]);
    }
    for (uint32_t f = 0; f < facet_count && apex; f++) {
        apex[f] = apex_of(&facet[f], weld, fans, proved);
    }
    work->used = mark;
    return LRCS_OK;
}
