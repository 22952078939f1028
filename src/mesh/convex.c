/* SPDX-License-Identifier: MIT */
/* Decides convexity by exact signs alone. The conditions:
     1. every edge is used by two facets, in opposite directions;
     2. the facets are connected across edges, and those around each point form one cycle;
     3. at each edge the two facets form a convex crease or continue each other in one plane: the
        third corner of one lies below the plane of the other, or in it and beyond the edge;
     4. around each point the facets bound a convex cone (below).
   Then the surface is closed, connected and locally convex, hence the boundary of a convex body
   (van Heijenoort 1952, "On locally convex manifolds"; the extreme point that the theorem requires
   exists, since the surface is bounded). A flat pair of opposite facets fails 3.

   4. Conditions 1 to 3 alone admit a star: ten facets around the axis of a {5/2} bipyramid are
   convex at every edge and wind twice. A small sphere about point v cuts the cone in a closed
   polygon of great-circle arcs shorter than pi, one for each facet. Seen from v, it turns left or
   goes straight at each corner, and never back. Let r_0 .. r_{m-1} be the corners at creases, and a
   chain the facets between two consecutive ones.
     m = 0: all is flat; the polygon is a great circle, traversed k times. The condition is that
       r_0 (any corner) lies in one facet only: k = 1.
     m = 1: impossible.
     m = 2: two great circles meet at opposite points only, so both chains must span pi: a wedge.
     m > 2: each chain must span less than pi. Let s(i, j, k) be the sign of -det(r_i - v, r_j - v,
       r_k - v): positive if the corners turn left as seen from v. Require s(0, 1, i) > 0 for all
       i > 1 and s(0, i, i+1) > 0 for all 0 < i < m-1. By the first, the longitudes of r_2 .. about
       the axis r_0, counted from r_1, lie in (0, pi); by the second they increase. So the triangles
       (r_0, r_i, r_{i+1}) lie side by side and fill a simple polygon in a lune narrower than pi
       that does not contain -r_0. The polygon lies in an open hemisphere. Seen from v it is a
       simple plane polygon that turns left at each corner, so it is convex.
   Every convex cone passes. */
#include "mesh/convex.h"

#include "base/exact.h"
#include "base/work.h"

typedef struct convex_mesh {
    const lrcs_point *vertex;
    const lrcs_facet *facet;
    const lrcsi_topology *topology;
    const unsigned char *crease; /* edge -> 1 if it is not flat */
    uint32_t facet_count;
} convex_mesh;

/* A facet seen from one of its points: `corner` is the index of that point among its corners. */
typedef struct fan_place {
    uint32_t facet;
    uint32_t corner;
} fan_place;

static const double *corner_position(const convex_mesh *m, uint32_t facet, uint32_t corner)
{
    return m->vertex[m->facet[facet].corner[corner % 3]].x;
}

/* The other of the two facets on an edge. */
static uint32_t facet_across(const lrcsi_topology *t, uint32_t edge, uint32_t facet)
{
    const lrcsi_edge_use *use = t->use + t->edge[edge].first_use;
    return use[0].facet == facet ? use[1].facet : use[0].facet;
}

/* 1 if the ray to q comes less than pi after the ray to p, turning about v in the sense of facet a
   b c; 0 if the two rays coincide or are opposite; else -1. All in the plane of a, b, c: seen along
   a coordinate axis to which the facet is not parallel. */
static int orientation_in_plane(const double *a, const double *b, const double *c, const double *v,
                                const double *p, const double *q)
{
    static const double axes[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    int orientation = 0;
    for (int k = 0, sign = 0; k < 3 && sign == 0; k++) {
        sign = lrcsi_exact_orient(a, b, c, axes[k]);
        orientation = sign != 0 ? sign * lrcsi_exact_orient(v, p, q, axes[k]) : 0;
    }
    return orientation;
}

/* Conditions 1 and 3. Marks the edges that are creases; the others are flat. */
static int edges_are_convex(const convex_mesh *m, unsigned char *crease)
{
    const lrcsi_topology *t = m->topology;
    for (uint32_t e = 0; e < t->edge_count; e++) {
        const lrcsi_edge_use *use = t->use + t->edge[e].first_use;
        if (t->edge[e].uses != 2 || use[0].forward == use[1].forward) {
            return 0;
        }
        uint32_t f = use[0].facet;
        uint32_t g = use[1].facet;
        uint32_t k = lrcsi_topology_corner_opposite(t, f, e);
        const double *apex = corner_position(m, f, k);
        const double *from = corner_position(m, f, k + 1);
        const double *to = corner_position(m, f, k + 2);
        const double *beyond = corner_position(m, g, lrcsi_topology_corner_opposite(t, g, e));
        int side = lrcsi_exact_side(apex, from, to, beyond);
        if (side > 0 ||
            (side == 0 && orientation_in_plane(apex, from, to, from, to, beyond) >= 0)) {
            return 0;
        }
        crease[e] = side < 0;
    }
    return t->edge_count > 0;
}

/* Condition 2, first half: all facets can be reached from the first one across edges. */
static int facets_are_connected(const convex_mesh *m, uint32_t *queue, unsigned char *visited)
{
    const lrcsi_topology *t = m->topology;
    uint32_t proper = 0;
    uint32_t tail = 0;
    for (uint32_t f = 0; f < m->facet_count; f++) {
        visited[f] = t->degenerate[f];
        if (!t->degenerate[f] && proper++ == 0) {
            queue[tail++] = f;
            visited[f] = 1;
        }
    }
    for (uint32_t head = 0; head < tail; head++) {
        for (int k = 0; k < 3; k++) {
            uint32_t g = facet_across(t, t->facet_edge[queue[head]].corner[k], queue[head]);
            if (!visited[g]) {
                visited[g] = 1;
                queue[tail++] = g;
            }
        }
    }
    return tail == proper;
}

/* The edge from the point to the next corner of the facet. */
static uint32_t fan_edge(const convex_mesh *m, fan_place p)
{
    return m->topology->facet_edge[p.facet].corner[p.corner];
}

/* The ends of the facet's arc, counter-clockwise. */
static const double *fan_ray(const convex_mesh *m, fan_place p)
{
    return corner_position(m, p.facet, p.corner + 1);
}

static const double *fan_ray_after(const convex_mesh *m, fan_place p)
{
    return corner_position(m, p.facet, p.corner + 2);
}

/* The next facet counter-clockwise around the point, seen from outside. */
static fan_place fan_next(const convex_mesh *m, fan_place p)
{
    const lrcsi_topology *t = m->topology;
    uint32_t edge = t->facet_edge[p.facet].corner[(p.corner + 2) % 3];
    uint32_t g = facet_across(t, edge, p.facet);
    return (fan_place){g, lrcsi_topology_side(t, g, edge)};
}

/* Case m = 0: only one facet, its second ray excluded, contains the first ray. */
static int flat_fan_winds_once(const convex_mesh *m, fan_place start, uint32_t size)
{
    const double *v = corner_position(m, start.facet, start.corner);
    const double *a = fan_ray(m, start);
    const double *b = fan_ray_after(m, start);
    uint32_t containing = 0;
    fan_place p = start;
    for (uint32_t i = 0; i < size; i++) {
        containing += orientation_in_plane(v, a, b, v, fan_ray(m, p), a) >= 0 &&
                      orientation_in_plane(v, a, b, v, a, fan_ray_after(m, p)) > 0;
        p = fan_next(m, p);
    }
    return containing == 1;
}

/* Walks along the chain that starts at the crease *p, and sets *p to the next crease. Returns 1 if
   the chain spans less than pi, 0 if it spans pi, -1 if it spans more. */
static int chain_span(const convex_mesh *m, fan_place *p, uint32_t size)
{
    const double *v = corner_position(m, p->facet, p->corner);
    const double *first = fan_ray(m, *p);
    const double *second = fan_ray_after(m, *p);
    int span = 1;
    for (uint32_t i = 0; i < size; i++) {
        span = i == 0 ? 1 : orientation_in_plane(v, first, second, v, first, fan_ray_after(m, *p));
        *p = fan_next(m, *p);
        if (span < 0 || m->crease[fan_edge(m, *p)]) {
            break;
        }
    }
    return span;
}

/* Cases m > 2, from a crease: chains shorter than pi, then the two families of signs. */
static int creased_fan_is_convex(const convex_mesh *m, fan_place start, uint32_t size,
                                 uint32_t creases)
{
    const double *v = corner_position(m, start.facet, start.corner);
    const double *r0 = fan_ray(m, start);
    const double *r1 = r0;
    const double *before = r0;
    fan_place p = start;
    for (uint32_t i = 1; i <= creases; i++) {
        if (chain_span(m, &p, size) <= 0) {
            return 0;
        }
        const double *r = fan_ray(m, p);
        if (i == 1) {
            r1 = r;
        } else if (i < creases && (lrcsi_exact_side(v, r0, r1, r) >= 0 ||
                                   lrcsi_exact_side(v, r0, before, r) >= 0)) {
            return 0;
        }
        before = r;
    }
    return 1;
}

/* Condition 4, and the second half of 2, at the point of `start`, which `size` facets share. */
static int fan_is_convex(const convex_mesh *m, fan_place start, uint32_t size)
{
    uint32_t creases = 0;
    fan_place crease = start;
    fan_place p = start;
    for (uint32_t i = 0; i < size; i++) {
        if (m->crease[fan_edge(m, p)]) {
            crease = p;
            creases++;
        }
        p = fan_next(m, p);
        if (p.facet == start.facet && i + 1 < size) {
            return 0;
        }
    }
    if (creases == 0) {
        return flat_fan_winds_once(m, start, size);
    }
    if (creases == 2) {
        p = crease;
        return chain_span(m, &p, size) == 0 && chain_span(m, &p, size) == 0;
    }
    return creased_fan_is_convex(m, crease, size, creases);
}

/* Condition 4 at all points; size[] and start[] are scratch, one entry per vertex. */
static int points_are_convex(const convex_mesh *m, uint32_t *size, fan_place *start)
{
    for (uint32_t f = 0; f < m->facet_count; f++) {
        for (uint32_t k = 0; k < 3 && !m->topology->degenerate[f]; k++) {
            uint32_t v = m->topology->weld[m->facet[f].corner[k]];
            start[v] = (fan_place){f, k};
            size[v]++;
        }
    }
    for (uint32_t f = 0; f < m->facet_count; f++) {
        for (uint32_t k = 0; k < 3 && !m->topology->degenerate[f]; k++) {
            uint32_t v = m->topology->weld[m->facet[f].corner[k]];
            if (start[v].facet == f && !fan_is_convex(m, start[v], size[v])) {
                return 0;
            }
        }
    }
    return 1;
}

size_t lrcsi_convex_need(uint32_t vertex_count, uint32_t facet_count)
{
    size_t need = lrcsi_work_bytes((size_t)3 * facet_count, 1);
    need = lrcsi_work_add(need, lrcsi_work_bytes(facet_count, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facet_count, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(vertex_count, sizeof(uint32_t)));
    return lrcsi_work_add(need, lrcsi_work_bytes(vertex_count, sizeof(fan_place)));
}

int lrcsi_convex_prove(const lrcs_point *vertex, uint32_t vertex_count, const lrcs_facet *facet,
                       uint32_t facet_count, const lrcsi_topology *topology, lrcs_work *work,
                       int *convex)
{
    size_t mark = work->used;
    unsigned char *crease = lrcsi_work_take(work, topology->edge_count, sizeof *crease);
    uint32_t *queue = lrcsi_work_take(work, facet_count, sizeof *queue);
    unsigned char *visited = lrcsi_work_take(work, facet_count, sizeof *visited);
    uint32_t *size = lrcsi_work_take_zero(work, vertex_count, sizeof *size);
    fan_place *start = lrcsi_work_take(work, vertex_count, sizeof *start);
    if (!crease || !queue || !visited || !size || !start) {
        work->used = mark;
        return LRCS_E_MEMORY;
    }
    convex_mesh m = {vertex, facet, topology, crease, facet_count};
    *convex = edges_are_convex(&m, crease) && facets_are_connected(&m, queue, visited) &&
              points_are_convex(&m, size, start);
    work->used = mark;
    return LRCS_OK;
}
