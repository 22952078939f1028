/* SPDX-License-Identifier: MIT */
/* Contacts in space between facets, by signs of determinants of the given vertices alone: no
   intersection point is ever computed.

   F, with corners a_0 a_1 a_2, is touched inside; T, with corners p_0 p_1 p_2, touches it.
   0. Where those p_k that are not corners of F all lie strictly on one side of its plane, T meets
   that plane in corners of F or between them at most: refused. Rounded, with the bound of
   mesh/tree.c; what it leaves undecided goes on.
   1. Seen along any direction in which F is not edge-on: where the line of a side of F has all of
      T on its outer side or on it, or the line of a side of T has F on the one side and T on the
      other, T does not meet the inside of F. In one plane this decides (separating axes of convex
      polygons); else it is a cheap refusal, above all of neighbours.
   2. Signs s_k of p_k against the plane of F: all positive or all negative means no contact, all
      zero means one plane.
   3. Else T cuts the plane of F in a segment or a point, whose ends are where lines u w through
      corners of T cross that plane: u on the plane or across from w, w off the plane. The end X
      lies on the inner side of a side a b of F exactly where the sign of
          det(w - u, a - u, b - u) = (w - u) . ((a - X) x (b - X))
      is that of w against the plane. The segment misses the inside of F exactly if it is all
      outside of (or on) one side's line, or if F is on one side of the segment's own line
      (separating axes again); and that line is the cut of the two planes, so there the signs
      of a_k against the plane of T tell. */
#include "mesh/touch.h"

#include <math.h>

#include "base/exact.h"
#include "base/work.h"
#include "mesh/tree.h"

static const double unit_axis[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/* A facet's corners; for F also its plane, an axis along which it is not edge-on, and the sign of
   its turn there. */
typedef struct touch_facet {
    const double *x[3];
    double normal[3], weight[3]; /* computed, and what bounds its error (mesh/tree.c) */
    const double *axis;
    int turn;
} touch_facet;

/* 10 u, as in mesh/tree.c. */
#define TOUCH_FILTER (10.0 * 0x1p-53)

/* A contact as it is found: `other` meets the inside of `facet`. */
typedef struct touch_found {
    uint32_t facet, other, kind;
} touch_found;

/* They are taken from the work area in blocks that follow one another without gaps. */
enum { FOUND_BLOCK = 4 };
_Static_assert(FOUND_BLOCK * sizeof(touch_found) % LRCS_WORK_ALIGN == 0, "no gaps");

static touch_facet corners_of(const lrcs_point *vertex, lrcs_facet facet)
{
    touch_facet f = {.axis = unit_axis[0]};
    for (int k = 0; k < 3; k++) {
        f.x[k] = vertex[facet.corner[k]].x;
    }
    return f;
}

/* Adds the plane, and the axis along which F is seen most broadly, by exact signs where the
   rounded one sees it edge-on. */
static void make_inside(touch_facet *f)
{
    int best = 0;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3;
        int j = (k + 2) % 3;
        double plus = (f->x[1][i] - f->x[0][i]) * (f->x[2][j] - f->x[0][j]);
        double minus = (f->x[1][j] - f->x[0][j]) * (f->x[2][i] - f->x[0][i]);
        f->normal[k] = plus - minus;
        f->weight[k] = fabs(plus) + fabs(minus);
        best = fabs(f->normal[k]) > fabs(f->normal[best]) ? k : best;
    }
    for (int k = 0; k < 3 && f->turn == 0; k++) {
        f->axis = unit_axis[(best + k) % 3];
        f->turn = lrcsi_exact_turn(f->x[0], f->x[1], f->x[2], f->axis);
    }
}

static int is_corner_of(const touch_facet *f, const double *p)
{
    for (int k = 0; k < 3; k++) {
        const double *x = f->x[k];
        if (x == p || (x[0] == p[0] && x[1] == p[1] && x[2] == p[2])) {
            return 1;
        }
    }
    return 0;
}

/* The side of F's plane on which p is proved to lie, or 0. */
static int sure_side(const touch_facet *f, const double *p)
{
    double height = 0.0;
    double error = 0.0;
    for (int k = 0; k < 3; k++) {
        double d = p[k] - f->x[0][k];
        height += f->normal[k] * d;
        error += f->weight[k] * fabs(d);
    }
    error *= TOUCH_FILTER;
    return height > error ? 1 : height < -error ? -1 : 0;
}

/* Step 0. */
static int surely_on_one_side(const touch_facet *f, const touch_facet *t)
{
    int seen = 0;
    for (int k = 0; k < 3; k++) {
        if (is_corner_of(f, t->x[k])) {
            continue;
        }
        int side = sure_side(f, t->x[k]);
        if (side == 0 || side == -seen) {
            return 0;
        }
        seen = side;
    }
    return seen != 0;
}

/* The first side of f (which turns by `turn`, not 0) whose line, seen along the axis, has all of g
   outside or on it; -1 for none. */
static int separating_side(const touch_facet *f, int turn, const touch_facet *g, const double *axis)
{
    for (int k = 0; k < 3; k++) {
        const double *a = f->x[k];
        const double *b = f->x[(k + 1) % 3];
        int i = 0;
        while (i < 3 && turn * lrcsi_exact_turn(a, b, g->x[i], axis) <= 0) {
            i++;
        }
        if (i == 3) {
            return k;
        }
    }
    return -1;
}

/* The corners of g on the line a b, seen along the axis: how many. */
static int corners_on_line(const double *a, const double *b, const touch_facet *g,
                           const double *axis, const double *on[3])
{
    int count = 0;
    for (int i = 0; i < 3; i++) {
        if (lrcsi_exact_turn(a, b, g->x[i], axis) == 0) {
            on[count++] = g->x[i];
        }
    }
    return count;
}

/* Of a side a b of F, and corners of T, all on one line as seen along the axis: may T meet the
   side, its ends excluded, other than by having it as a side too? */
static int side_met(const touch_facet *t, const double *a, const double *b, const double *const *on,
                    int count, const double *axis)
{
    if (is_corner_of(t, a) && is_corner_of(t, b)) {
        return 0;
    }
    int k = 0;
    while (axis[k] != 0 || a[k] == b[k]) {
        k++;
    }
    int below = 0;
    int above = 0;
    for (int i = 0; i < count; i++) {
        below += on[i][k] <= (a[k] < b[k] ? a[k] : b[k]);
        above += on[i][k] >= (a[k] < b[k] ? b[k] : a[k]);
    }
    return below != count && above != count;
}

/* Step 1. *rim, which is 0, becomes 1 where T may still meet a side of F. Not so where it is the
   line of a side of T that separates: F has one corner on it at most, for two would be a side of F
   with T beyond it. */
static int separated_along_axis(const touch_facet *f, const touch_facet *t, int *rim)
{
    int side = separating_side(f, f->turn, t, f->axis);
    if (side >= 0) {
        const double *on[3];
        const double *a = f->x[side];
        const double *b = f->x[(side + 1) % 3];
        int count = corners_on_line(a, b, t, f->axis, on);
        *rim = side_met(t, a, b, on, count, f->axis);
        return 1;
    }
    int t_turn = lrcsi_exact_turn(t->x[0], t->x[1], t->x[2], f->axis);
    return t_turn != 0 && separating_side(t, t_turn, f, f->axis) >= 0;
}

static void plane_sides(const touch_facet *f, const touch_facet *t, int side[3])
{
    for (int k = 0; k < 3; k++) {
        side[k] = lrcsi_exact_side(f->x[0], f->x[1], f->x[2], t->x[k]);
    }
}

/* A line through u and w that crosses the plane once; `up` is the sign of w against it. */
typedef struct cut_line {
    const double *u, *w;
    int up;
} cut_line;

/* The lines whose crossings end the cut of T: one or two, for signs neither all positive, nor all
   negative, nor all zero. */
static int cut_ends(const touch_facet *t, const int side[3], cut_line end[2])
{
    int n = 0;
    for (int k = 0; k < 3 && n < 2; k++) {
        int next = (k + 1) % 3;
        int off = side[next] != 0 ? next : (k + 2) % 3;
        if (side[k] == 0) {
            end[n++] = (cut_line){t->x[k], t->x[off], side[off]};
        } else if (side[k] == -side[next]) {
            end[n++] = (cut_line){t->x[k], t->x[next], side[next]};
        }
    }
    return n;
}

/* Step 3, given the signs of T's corners against the plane of F. */
static int cut_meets_inside(const touch_facet *f, const touch_facet *t, const int side[3])
{
    cut_line end[2];
    int ends = cut_ends(t, side, end);
    for (int k = 0; k < 3; k++) {
        int inner = 0;
        for (int i = 0; i < ends && !inner; i++) {
            inner =
                end[i].up * lrcsi_exact_side(end[i].u, end[i].w, f->x[k], f->x[(k + 1) % 3]) > 0;
        }
        if (!inner) {
            return 0;
        }
    }
    if (ends == 1) {
        return 1;
    }
    int of_f[3];
    plane_sides(t, f, of_f);
    int above = of_f[0] > 0 || of_f[1] > 0 || of_f[2] > 0;
    int below = of_f[0] < 0 || of_f[1] < 0 || of_f[2] < 0;
    return above && below;
}

/* Steps 1 to 3: how t touches the inside of f, which has its plane and axis. *rim: 0 where t meets
   the rim of f in corners of f only, or along a side that both have; 1 where it may do more. */
static int touch_kind(const touch_facet *f, const touch_facet *t, int *rim)
{
    *rim = 0;
    if (separated_along_axis(f, t, rim)) {
        return LRCSI_TOUCH_NONE;
    }
    int side[3];
    plane_sides(f, t, side);
    if (side[0] == side[1] && side[1] == side[2] && side[0] != 0) {
        return LRCSI_TOUCH_NONE;
    }
    *rim = 1;
    if (side[0] == 0 && side[1] == 0 && side[2] == 0) {
        return LRCSI_TOUCH_COPLANAR;
    }
    return cut_meets_inside(f, t, side) ? LRCSI_TOUCH_CROSS : LRCSI_TOUCH_NONE;
}

int lrcsi_touch_pair(const lrcs_point *vertex, lrcs_facet facet, lrcs_facet other)
{
    touch_facet f = corners_of(vertex, facet);
    touch_facet t = corners_of(vertex, other);
    int rim;
    make_inside(&f);
    return surely_on_one_side(&f, &t) ? LRCSI_TOUCH_NONE : touch_kind(&f, &t, &rim);
}

/* Is p on the segment a b, which is longer than 0, and not at its ends? */
static int is_inside_segment(const double *a, const double *b, const double *p)
{
    int at_end = 0;
    for (int k = 0; k < 3; k++) {
        double low = a[k] < b[k] ? a[k] : b[k];
        double high = a[k] < b[k] ? b[k] : a[k];
        if (p[k] < low || p[k] > high) {
            return 0;
        }
        at_end |= low != high && (p[k] == low || p[k] == high);
    }
    return !at_end && lrcsi_exact_collinear(a, b, p);
}

/* The sides of f inside of which a corner of t lies: bit k for the side from corner k to k + 1. */
static unsigned sides_split(const touch_facet *f, const touch_facet *t)
{
    unsigned sides = 0;
    for (int i = 0; i < 3; i++) {
        if (is_corner_of(f, t->x[i])) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            if (is_inside_segment(f->x[k], f->x[(k + 1) % 3], t->x[i])) {
                sides |= 1u << k;
            }
        }
    }
    return sides;
}

/* Sinks entry `i` of a heap of n, largest on top. */
static void sink_found(touch_found *found, size_t i, size_t n)
{
    for (size_t child = 2 * i + 1; child < n; child = 2 * i + 1) {
        if (child + 1 < n && found[child + 1].other > found[child].other) {
            child++;
        }
        if (found[i].other >= found[child].other) {
            return;
        }
        touch_found t = found[i];
        found[i] = found[child];
        found[child] = t;
        i = child;
    }
}

/* Heap sort by `other`, in place. */
static void sort_found(touch_found *found, size_t n)
{
    for (size_t i = n / 2; i > 0; i--) {
        sink_found(found, i - 1, n);
    }
    for (size_t last = n; last > 1; last--) {
        touch_found t = found[0];
        found[0] = found[last - 1];
        found[last - 1] = t;
        sink_found(found, 0, last - 1);
    }
}

/* The facets among which contacts are sought, and those found. */
typedef struct touch_search {
    const lrcs_point *vertex;
    const lrcs_facet *facet;
    const uint32_t *piece; /* or NULL */
    lrcsi_tree tree;
    touch_found *found; /* above the tree */
    uint32_t count;
    lrcs_work *work;
    lrcsi_touches *touches;
} touch_search;

static int append_found(touch_search *search, touch_found found)
{
    if (search->count == LRCS_NONE - 1) {
        return LRCS_E_LIMIT;
    }
    if (search->count % FOUND_BLOCK == 0) {
        touch_found *block = lrcsi_work_take(search->work, FOUND_BLOCK, sizeof *block);
        search->found = search->count == 0 ? block : search->found;
        if (!block) {
            return LRCS_E_MEMORY;
        }
    }
    search->found[search->count++] = found;
    return LRCS_OK;
}

/* What `other` does to `facet`, one of a pair that may have more in common than corners. */
static int meet_one(touch_search *search, uint32_t facet, const touch_facet *f, uint32_t other,
                    const touch_facet *t)
{
    lrcsi_touches *touches = search->touches;
    int rim;
    int kind = touch_kind(f, t, &rim);
    unsigned sides = rim ? sides_split(f, t) : 0;
    touches->rim[facet] |= (unsigned char)(rim ? LRCSI_TOUCH_RIM | sides : 0);
    if (search->piece && !touches->self && search->piece[facet] == search->piece[other]) {
        touches->self = kind != LRCSI_TOUCH_NONE || sides != 0;
    }
    return kind == LRCSI_TOUCH_NONE
               ? LRCS_OK
               : append_found(search, (touch_found){facet, other, (uint32_t)kind});
}

/* A pair is left alone where all that it has in common are corners of both or what lies between
   them: neither then meets the other's inside or rim. */
static int meet_pairs(touch_search *search, uint32_t place)
{
    uint32_t facet = search->tree.order[place];
    lrcsi_tree_walk walk = lrcsi_tree_after(&search->tree, place);
    touch_facet f = corners_of(search->vertex, search->facet[facet]);
    int status = LRCS_OK;
    uint32_t other;
    make_inside(&f);
    while (status == LRCS_OK && (other = lrcsi_tree_next(&walk)) != LRCS_NONE) {
        touch_facet t = corners_of(search->vertex, search->facet[other]);
        if (surely_on_one_side(&f, &t) || lrcsi_tree_corner(&walk, other)) {
            continue;
        }
        make_inside(&t);
        if (surely_on_one_side(&t, &f)) {
            continue;
        }
        status = meet_one(search, facet, &f, other, &t);
        if (status == LRCS_OK) {
            status = meet_one(search, other, &t, facet, &f);
        }
    }
    return status;
}

/* Orders what was found by facet, in place, each entry going where its facet's next one belongs;
   then by other. */
static int order_found(const touch_search *search, uint32_t facet_count)
{
    uint32_t *first = search->touches->first;
    uint32_t *next = lrcsi_work_take(search->work, facet_count, sizeof *next);
    if (!next) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t i = 0; i < search->count; i++) {
        first[search->found[i].facet + 1]++;
    }
    for (uint32_t f = 0; f < facet_count; f++) {
        next[f] = first[f];
        first[f + 1] += first[f];
    }
    for (uint32_t f = 0; f < facet_count; f++) {
        while (next[f] < first[f + 1]) {
            touch_found *here = &search->found[next[f]];
            touch_found moved = *here;
            *here = search->found[next[moved.facet]];
            search->found[next[moved.facet]++] = moved;
        }
        if (first[f + 1] > first[f]) { /* where none was found at all there is no list either */
            sort_found(search->found + first[f], first[f + 1] - first[f]);
        }
    }
    return LRCS_OK;
}

size_t lrcsi_touches_need(uint32_t facet_count, size_t count)
{
    size_t need = 2 * lrcsi_work_bytes((size_t)facet_count + 1, sizeof(uint32_t));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facet_count, 1));
    need = lrcsi_work_add(need, lrcsi_tree_need(facet_count));
    return lrcsi_work_add(
        need, lrcsi_work_bytes(lrcsi_work_add(count, FOUND_BLOCK), sizeof(touch_found)));
}

/* Everything but the release on failure. What is found grows above the tree, and moves down, less
   the facets' numbers, at the end. */
static int touches_build(touch_search *search, uint32_t facet_count, const unsigned char *skip)
{
    lrcs_work *work = search->work;
    lrcsi_touches *t = search->touches;
    t->first = lrcsi_work_take_zero(work, (size_t)facet_count + 1, sizeof *t->first);
    t->rim = lrcsi_work_take_zero(work, facet_count, 1);
    size_t mark = work->used;
    if (!t->first || !t->rim) {
        return LRCS_E_MEMORY;
    }
    int status = lrcsi_tree_make(search->vertex, search->facet, facet_count, skip, NULL, work,
                                 &search->tree);
    for (uint32_t i = 0; status == LRCS_OK && i < search->tree.count; i++) {
        status = meet_pairs(search, i);
    }
    if (status == LRCS_OK) {
        status = order_found(search, facet_count);
    }
    if (status != LRCS_OK) {
        return status;
    }
    work->used = mark;
    t->touch = lrcsi_work_take(work, search->count, sizeof *t->touch);
    for (t->count = 0; t->touch && t->count < search->count; t->count++) {
        touch_found found = search->found[t->count];
        t->touch[t->count] = (lrcsi_touch){found.other, found.kind};
    }
    return t->touch ? LRCS_OK : LRCS_E_MEMORY;
}

int lrcsi_touches_make(const lrcs_point *vertex, const lrcs_facet *facet, uint32_t facet_count,
                       const unsigned char *skip, const uint32_t *piece, lrcs_work *work,
                       lrcsi_touches *touches)
{
    size_t mark = work->used;
    lrcsi_touches made = {0};
    touch_search search = {
        .vertex = vertex, .facet = facet, .piece = piece, .work = work, .touches = &made};
    int status = touches_build(&search, facet_count, skip);
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    *touches = made;
    return LRCS_OK;
}
