/* SPDX-License-Identifier: MIT */
/* Contacts in space between facets, by signs of determinants of the given vertices alone: no
   intersection point is ever computed. A pair of facets comes to the exact predicates only where

   - their boxes meet (mesh/tree.h: the tree is joined with itself, leaf by leaf);
   - they have no corner in common whose ring is proved (mesh/ring.h);
   - no plane is proved to separate them, but for the corners that they have in common: the plane of
     either of them, or one through a side of either along the axis on which the first of them is
     seen most broadly. Rounded, with a bound on the error.

   What is left out so meets in corners of both or along a side of both, if at all.

   The exact predicates, for F with corners a_0 a_1 a_2 and T with corners p_0 p_1 p_2:
   1. Signs of the corners of each against the plane of the other. Where those that are not corners
      of both are all positive or all negative, again the two meet in what both have.
   2. All zero: one plane. Seen along an axis on which they are not edge-on, neither meets the
   inside of the other exactly where the line of a side has the one facet on its one side, the other
   on its other side or on it (separating axes of convex polygons). If it is a side of F, T meets F
      on that side at most; if only one of T, F has but one corner on it.
   3. Else T cuts the plane of F in a segment or a point, whose ends are where lines u w through
      corners of T cross that plane: u on the plane or across from w, w off the plane. The end X
      lies on the inner side of a side a b of F exactly where the sign of
          det(w - u, a - u, b - u) = (w - u) . ((a - X) x (b - X))
      is that of w against the plane. The segment misses the inside of F exactly if it is all
      outside of (or on) one side's line, or if F is on one side of the segment's own line
      (separating axes again); and that line is the cut of the two planes, so there the signs
      of a_k against the plane of T tell. The other way round the determinants are the same.
   4. A side of F crosses the plane of T in one point. It is in T where these determinants, of that
      side and the three of T, are nowhere of opposite signs. */
#include "mesh/touch.h"

#include <math.h>

#include "base/exact.h"
#include "base/work.h"
#include "mesh/ring.h"
#include "mesh/tree.h"

static const double unit_axis[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/* A facet's corners: two facets have a corner in common where the pointers are the same. Then what
   add_plane adds. */
typedef struct touch_facet {
    const double *x[3];
    double normal[3], weight[3]; /* of its plane, computed, and what bounds its error */
    int axis;                    /* along which it is seen most broadly; -1: not yet added */
    int turn;                    /* how it turns there, exactly; 0 where it is degenerate */
} touch_facet;

/* 10 u. Of a plane's height: with n the computed normal at corner a and w_k = |p_i q_j| + |p_j
   q_i|, each component of n errs by at most 5 u w_k (base/exact.c), a difference x - a by u of
   itself, and the sum of three products by 3 u of its terms; |n_k| <= (1 + 4 u) w_k. Of a turn: 4 u
   of its two products. */
#define TOUCH_FILTER (10.0 * 0x1p-53)

/* A contact as it is found: `other` meets the inside of `facet`. */
typedef struct touch_found {
    uint32_t facet, other, kind;
} touch_found;

/* They are taken from the work area in blocks that follow one another without gaps. */
enum { FOUND_BLOCK = 4 };
_Static_assert(FOUND_BLOCK * sizeof(touch_found) % LRCS_WORK_ALIGN == 0, "no gaps");

/* The axis is another one only where the facet may be edge-on along the first. */
static void add_plane(touch_facet *f)
{
    const double *a = f->x[0];
    const double *b = f->x[1];
    const double *c = f->x[2];
    const double p[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double q[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const double plus[3] = {p[1] * q[2], p[2] * q[0], p[0] * q[1]};
    const double minus[3] = {p[2] * q[1], p[0] * q[2], p[1] * q[0]};
    int best = 0;
    for (int k = 0; k < 3; k++) {
        f->normal[k] = plus[k] - minus[k];
        f->weight[k] = fabs(plus[k]) + fabs(minus[k]);
        best = fabs(f->normal[k]) > fabs(f->normal[best]) ? k : best;
    }
    f->axis = best;
    f->turn = 0;
    if (fabs(f->normal[best]) > TOUCH_FILTER * f->weight[best]) {
        f->turn = f->normal[best] > 0.0 ? 1 : -1;
    }
    for (int k = 0; k < 3 && f->turn == 0; k++) {
        f->axis = (best + k) % 3;
        f->turn = lrcsi_exact_turn(a, b, c, unit_axis[f->axis]);
    }
}

static int is_corner_of(const touch_facet *f, const double *p)
{
    return p == f->x[0] || p == f->x[1] || p == f->x[2];
}

/* ---- proved apart, rounded ---- */

/* The side of F's plane on which p is proved to lie, or 0. */
static int sure_side(const touch_facet *f, const double *p)
{
    const double d[3] = {p[0] - f->x[0][0], p[1] - f->x[0][1], p[2] - f->x[0][2]};
    double height = (f->normal[0] * d[0] + f->normal[1] * d[1]) + f->normal[2] * d[2];
    double error = TOUCH_FILTER * ((f->weight[0] * fabs(d[0]) + f->weight[1] * fabs(d[1])) +
                                   f->weight[2] * fabs(d[2]));
    return height > error ? 1 : height < -error ? -1 : 0;
}

/* Are the corners of T that are not corners of F all strictly on one side of F's plane, and are
   there any? Then T meets the plane in corners of F or between them at most. 1: proved; 0: there
   are some on either side; -1: not known. */
static int plane_separates(const touch_facet *f, const touch_facet *t)
{
    int above = 0;
    int below = 0;
    int unsure = 0;
    for (int k = 0; k < 3; k++) {
        if (!is_corner_of(f, t->x[k])) {
            int side = sure_side(f, t->x[k]);
            above |= side > 0;
            below |= side < 0;
            unsure |= side == 0;
        }
    }
    return above && below ? 0 : unsure || above == below ? -1 : 1;
}

/* The sign of the turn a b c seen along an axis, where it is proved, or 0. */
static inline int sure_turn(const double *a, const double *b, const double *c, int axis)
{
    int i = axis == 2 ? 0 : axis + 1;
    int j = axis == 0 ? 2 : axis - 1;
    double plus = (b[i] - a[i]) * (c[j] - a[j]);
    double minus = (b[j] - a[j]) * (c[i] - a[i]);
    double error = TOUCH_FILTER * (fabs(plus) + fabs(minus));
    return plus - minus > error ? 1 : plus - minus < -error ? -1 : 0;
}

/* Seen along an axis along which F turns by `turn`: has the line of a side of F all corners of T
   strictly outside, but those that are ends of the side? Then they meet in these or between them at
   most. */
static int line_separates(const touch_facet *f, int turn, const touch_facet *t, int axis)
{
    for (int k = 0; k < 3; k++) {
        const double *a = f->x[k];
        const double *b = f->x[k < 2 ? k + 1 : 0];
        int i = 0;
        while (i < 3 && (t->x[i] == a || t->x[i] == b || sure_turn(a, b, t->x[i], axis) == -turn)) {
            i++;
        }
        if (i == 3) {
            return 1;
        }
    }
    return 0;
}

/* Are two facets, seen along F's axis, separated by the line of a side? */
static int lines_separate(const touch_facet *f, const touch_facet *t)
{
    if (line_separates(f, f->turn, t, f->axis)) {
        return 1;
    }
    int turn = sure_turn(t->x[0], t->x[1], t->x[2], f->axis);
    return turn != 0 && line_separates(t, turn, f, f->axis);
}

/* Are two facets proved to meet in nothing but corners and sides of both? The plane of F is known;
   that of T is added where it is asked for. Where they may be in one plane, lines are more likely
   to tell than the plane of T. */
static int surely_apart(const touch_facet *f, touch_facet *t)
{
    int plane = plane_separates(f, t);
    if (plane == 1 || (plane == -1 && lines_separate(f, t))) {
        return 1;
    }
    add_plane(t);
    return plane_separates(t, f) == 1 || (plane == 0 && lines_separate(f, t));
}

/* ---- exact ---- */

/* How each of a pair meets the inside of the other, and whether it does or meets the other's rim
   other than in corners of the other or along a side that both have: first what T does to F, then
   what F does to T. */
typedef struct touch_result {
    int kind[2];
    int rim[2];
} touch_result;

/* Do points, all on the line a b, or what is between them, meet the open segment a b? Seen along
   the axis. */
static int line_covers_segment(const double *a, const double *b, const double *const *on, int count,
                               const double *axis)
{
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
    return count > 0 && below != count && above != count;
}

/* Does T meet the open segment a b, which is in its plane? */
static int segment_meets_flat(const touch_facet *t, const double *a, const double *b)
{
    const double *axis = unit_axis[t->axis];
    const double *on[3];
    int count = 0;
    int left = 0;
    int right = 0;
    for (int k = 0; k < 3; k++) {
        int turn = lrcsi_exact_turn(a, b, t->x[k], axis);
        left |= turn > 0;
        right |= turn < 0;
        if (turn == 0) {
            on[count++] = t->x[k];
        }
    }
    if (!(left && right)) {
        return line_covers_segment(a, b, on, count, axis);
    }
    /* The line meets the inside of T: so does the segment, unless a side has all of it outside. */
    for (int k = 0; k < 3; k++) {
        const double *p = t->x[k];
        const double *q = t->x[(k + 1) % 3];
        if (t->turn * lrcsi_exact_turn(p, q, a, axis) <= 0 &&
            t->turn * lrcsi_exact_turn(p, q, b, axis) <= 0) {
            return 0;
        }
    }
    return 1;
}

/* Does T meet side k of F, its ends excluded, other than by having it too? Given signs of F's
   corners against the plane of T, and the determinants of sides of T with sides of F. */
static int side_is_met(const touch_facet *f, const touch_facet *t, int k, const int of_f[3],
                       const int cross[3])
{
    const double *a = f->x[k];
    const double *b = f->x[(k + 1) % 3];
    int at_a = of_f[k];
    int at_b = of_f[(k + 1) % 3];
    if (is_corner_of(t, a) && is_corner_of(t, b)) {
        return 0;
    }
    if (at_a == 0 && at_b == 0) {
        return segment_meets_flat(t, a, b);
    }
    int left = cross[0] > 0 || cross[1] > 0 || cross[2] > 0;
    int right = cross[0] < 0 || cross[1] < 0 || cross[2] < 0;
    return at_a == -at_b && !(left && right);
}

/* Step 1: signs of t's corners against the plane of f. */
static void plane_sides(const touch_facet *f, const touch_facet *t, int side[3])
{
    for (int k = 0; k < 3; k++) {
        side[k] =
            is_corner_of(f, t->x[k]) ? 0 : lrcsi_exact_side(f->x[0], f->x[1], f->x[2], t->x[k]);
    }
}

/* Are those that are not corners of f all on one side, off the plane? */
static int sides_separate(const touch_facet *f, const touch_facet *t, const int side[3])
{
    int above = 0;
    int below = 0;
    int on = 0;
    for (int k = 0; k < 3; k++) {
        above |= side[k] > 0;
        below |= side[k] < 0;
        on |= side[k] == 0 && !is_corner_of(f, t->x[k]);
    }
    return !on && above != below;
}

/* Step 2: the first side of f (which turns by `turn`) whose line has all of g outside or on it,
   seen along the axis; -1 for none. */
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

/* Step 2. */
static void meet_flat(const touch_facet *f, const touch_facet *t, touch_result *result)
{
    static const int none[3] = {0, 0, 0};
    const double *axis = unit_axis[f->axis];
    int turn = lrcsi_exact_turn(t->x[0], t->x[1], t->x[2], axis);
    int of_f = separating_side(f, f->turn, t, axis);
    int of_t = separating_side(t, turn, f, axis);
    if (of_f < 0 && of_t < 0) {
        *result = (touch_result){{LRCSI_TOUCH_COPLANAR, LRCSI_TOUCH_COPLANAR}, {1, 1}};
        return;
    }
    result->rim[0] = of_f >= 0 && side_is_met(f, t, of_f, none, none);
    result->rim[1] = of_t >= 0 && side_is_met(t, f, of_t, none, none);
}

/* Step 3: does t meet the inside of f? side: t's corners against the plane of f; of_f the other way
   round; cross[i][k]: the determinant of side i of t and side k of f. */
static int cut_meets_inside(const int side[3], const int of_f[3], int cross[3][3])
{
    int inner[3] = {0, 0, 0};
    int ends = 0;
    for (int k = 0; k < 3; k++) {
        int next = (k + 1) % 3;
        int last = (k + 2) % 3;
        for (int j = 0; j < 3 && side[k] == 0; j++) { /* an end in a corner */
            inner[j] |=
                (side[next] != 0 ? side[next] * cross[k][j] : -side[last] * cross[last][j]) > 0;
        }
        for (int j = 0; j < 3 && side[k] * side[next] < 0; j++) { /* an end on a side */
            inner[j] |= side[next] * cross[k][j] > 0;
        }
        ends += side[k] == 0 || side[k] * side[next] < 0;
    }
    int above = of_f[0] > 0 || of_f[1] > 0 || of_f[2] > 0;
    int below = of_f[0] < 0 || of_f[1] < 0 || of_f[2] < 0;
    return inner[0] && inner[1] && inner[2] && (ends == 1 || (above && below));
}

/* Steps 3 and 4. of_t: t's corners against the plane of f; of_f: the other way round. */
static void meet_across(const touch_facet *f, const touch_facet *t, const int of_t[3],
                        const int of_f[3], touch_result *result)
{
    int of_sides[3][3]; /* of t, of f */
    int turned[3][3];   /* of f, of t */
    for (int i = 0; i < 3; i++) {
        const double *u = t->x[i];
        const double *w = t->x[(i + 1) % 3];
        for (int k = 0; k < 3; k++) {
            const double *a = f->x[k];
            const double *b = f->x[(k + 1) % 3];
            int common = u == a || u == b || w == a || w == b;
            of_sides[i][k] = turned[k][i] = common ? 0 : lrcsi_exact_side(u, w, a, b);
        }
    }
    if (cut_meets_inside(of_t, of_f, of_sides)) {
        result->kind[0] = LRCSI_TOUCH_CROSS;
    }
    if (cut_meets_inside(of_f, of_t, turned)) {
        result->kind[1] = LRCSI_TOUCH_CROSS;
    }
    result->rim[0] = result->kind[0] != LRCSI_TOUCH_NONE;
    result->rim[1] = result->kind[1] != LRCSI_TOUCH_NONE;
    for (int k = 0; k < 3; k++) {
        result->rim[0] = result->rim[0] || side_is_met(f, t, k, of_f, turned[k]);
        result->rim[1] = result->rim[1] || side_is_met(t, f, k, of_t, of_sides[k]);
    }
}

/* Steps 1 to 4, for facets that have their planes. */
static touch_result meet_exactly(const touch_facet *f, const touch_facet *t)
{
    touch_result result = {{LRCSI_TOUCH_NONE, LRCSI_TOUCH_NONE}, {0, 0}};
    int of_t[3];
    int of_f[3];
    plane_sides(f, t, of_t);
    if (sides_separate(f, t, of_t)) {
        return result;
    }
    if (of_t[0] == 0 && of_t[1] == 0 && of_t[2] == 0) {
        meet_flat(f, t, &result);
        return result;
    }
    plane_sides(t, f, of_f);
    if (!sides_separate(t, f, of_f)) {
        meet_across(f, t, of_t, of_f, &result);
    }
    return result;
}

static touch_facet facet_at(const lrcs_point *vertex, const uint32_t corner[3])
{
    return (touch_facet){.x = {vertex[corner[0]].x, vertex[corner[1]].x, vertex[corner[2]].x},
                         .axis = -1};
}

int lrcsi_touch_pair(const lrcs_point *vertex, lrcs_facet facet, lrcs_facet other)
{
    touch_facet f = facet_at(vertex, facet.corner);
    touch_facet t = facet_at(vertex, other.corner);
    for (int i = 0; i < 9; i++) { /* corners in one place are one corner */
        const double *a = f.x[i / 3];
        const double *b = t.x[i % 3];
        if (a[0] == b[0] && a[1] == b[1] && a[2] == b[2]) {
            t.x[i % 3] = a;
        }
    }
    add_plane(&f);
    return surely_apart(&f, &t) ? LRCSI_TOUCH_NONE : meet_exactly(&f, &t).kind[0];
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

/* Does a corner of t lie inside a side of f? */
static int touches_side(const touch_facet *f, const touch_facet *t)
{
    for (int i = 0; i < 3; i++) {
        if (is_corner_of(f, t->x[i])) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            if (is_inside_segment(f->x[k], f->x[(k + 1) % 3], t->x[i])) {
                return 1;
            }
        }
    }
    return 0;
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

/* ---- all pairs ---- */

enum { LEAF_LANES = LRCSI_TREE_LANES };

/* A leaf that meets more others than this by boxes is compared by slabs too; but slabs are filled
   only once there have been as many more meetings, which is what filling them costs. */
enum { MANY_LEAVES = 16, SLABS_COST = 8 };

/* The corners of a leaf's facets whose rings are proved, in structure of arrays; others are
   LRCS_NONE. */
typedef struct touch_leaf {
    uint32_t corner[3][LEAF_LANES];
} touch_leaf;

/* The facets among which contacts are sought, and those found. */
typedef struct touch_search {
    const lrcs_point *vertex;
    const lrcs_facet *facet;
    const uint32_t *weld;
    const uint32_t *piece; /* or NULL */
    lrcsi_tree tree;
    touch_leaf *leaf;
    uint64_t crowded;   /* meetings of leaves that meet many others */
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

/* The facet at a place, its corners welded: those in one place are one. */
static touch_facet facet_of_place(const touch_search *search, uint32_t place)
{
    const uint32_t *c = search->facet[search->tree.order[place]].corner;
    const uint32_t welded[3] = {search->weld[c[0]], search->weld[c[1]], search->weld[c[2]]};
    return facet_at(search->vertex, welded);
}

/* Files what `other` does to `facet`. */
static int file_contact(touch_search *search, uint32_t facet, uint32_t other, int kind, int rim)
{
    search->touches->rim[facet] |= rim != 0;
    return kind == LRCSI_TOUCH_NONE
               ? LRCS_OK
               : append_found(search, (touch_found){facet, other, (uint32_t)kind});
}

/* A pair that may have more in common than corners and sides of both. */
static int meet_pair(touch_search *search, uint32_t facet, const touch_facet *f, uint32_t other,
                     const touch_facet *t)
{
    touch_result result = meet_exactly(f, t);
    const uint32_t *piece = search->piece;
    if (piece && !search->touches->self && piece[facet] == piece[other]) {
        search->touches->self = result.kind[0] != LRCSI_TOUCH_NONE ||
                                result.kind[1] != LRCSI_TOUCH_NONE || touches_side(f, t) ||
                                touches_side(t, f);
    }
    int status = file_contact(search, facet, other, result.kind[0], result.rim[0]);
    return status == LRCS_OK ? file_contact(search, other, facet, result.kind[1], result.rim[1])
                             : status;
}

/* The lanes of a leaf whose facets have a corner with a proved ring in common with the facet in a
   lane of another. */
static unsigned lanes_in_ring(const touch_leaf *leaf, const touch_leaf *other, uint32_t lane)
{
    static const uint32_t lane_bit[LEAF_LANES] = {1, 2, 4, 8, 16, 32, 64, 128};
    uint32_t a = other->corner[0][lane];
    uint32_t b = other->corner[1][lane];
    uint32_t c = other->corner[2][lane];
    a = a != LRCS_NONE ? a : b != LRCS_NONE ? b : c; /* any of them in the stead of none */
    b = b != LRCS_NONE ? b : a;
    c = c != LRCS_NONE ? c : a;
    uint32_t lanes = 0;
    for (int k = 0; k < LEAF_LANES; k++) {
        uint32_t x = leaf->corner[0][k];
        uint32_t y = leaf->corner[1][k];
        uint32_t z = leaf->corner[2][k];
        int in = (x == a) | (x == b) | (x == c) | (y == a) | (y == b) | (y == c) | (z == a) |
                 (z == b) | (z == c);
        lanes |= in ? lane_bit[k] : 0;
    }
    return a != LRCS_NONE ? lanes : 0;
}

/* The facet at a place against those in some lanes of a leaf. */
static int meet_lanes(touch_search *search, uint32_t place, uint32_t leaf, unsigned lanes)
{
    const lrcsi_tree *tree = &search->tree;
    lrcsi_box box = lrcsi_tree_box(&tree->block[0][place / LEAF_LANES], place % LEAF_LANES);
    touch_facet f = {.axis = -1};
    int status = LRCS_OK;
    for (; lanes != 0 && status == LRCS_OK; lanes &= lanes - 1) {
        uint32_t lane = lrcsi_tree_lane(lanes);
        uint32_t at = leaf * LEAF_LANES + lane;
        if (!lrcsi_tree_meets_lane(&tree->block[0][leaf], lane, &box)) {
            continue;
        }
        if (f.axis < 0) {
            f = facet_of_place(search, place);
            add_plane(&f);
        }
        touch_facet t = facet_of_place(search, at);
        if (!surely_apart(&f, &t)) {
            status = meet_pair(search, tree->order[place], &f, tree->order[at], &t);
        }
    }
    return status;
}

/* The facets of two leaves that meet the other's box, against each other, less those of a common
   ring; or, where it is one leaf, each of its facets against those after it. */
static int meet_leaves(touch_search *search, uint32_t first, uint32_t second)
{
    const lrcsi_tree *tree = &search->tree;
    unsigned rows = 0xff;
    unsigned columns = 0xff;
    int status = LRCS_OK;
    if (first != second) {
        lrcsi_box box = lrcsi_tree_box(&tree->block[1][second / LEAF_LANES], second % LEAF_LANES);
        rows = lrcsi_tree_meets(&tree->block[0][first], &box);
        box = lrcsi_tree_box(&tree->block[1][first / LEAF_LANES], first % LEAF_LANES);
        columns = rows ? lrcsi_tree_meets(&tree->block[0][second], &box) : 0;
    } else if (tree->count - first * LEAF_LANES < LEAF_LANES) {
        rows = columns = (1u << (tree->count - first * LEAF_LANES)) - 1;
    }
    for (; rows != 0 && columns != 0 && status == LRCS_OK; rows &= rows - 1) {
        uint32_t lane = lrcsi_tree_lane(rows);
        columns &= first == second ? ~1u << lane : ~0u;
        unsigned lanes =
            columns & ~lanes_in_ring(&search->leaf[second], &search->leaf[first], lane);
        if (lanes != 0) {
            status = meet_lanes(search, first * LEAF_LANES + lane, second, lanes);
        }
    }
    return status;
}

/* All pairs of a leaf's facets with each other, unless all have one ring, and with those of leaves
   after it. */
static int meet_leaf(touch_search *search, uint32_t leaf)
{
    lrcsi_tree *tree = &search->tree;
    lrcsi_tree_walk walk = lrcsi_tree_after(tree, leaf);
    int status = tree->label[0][leaf] == LRCS_NONE ? meet_leaves(search, leaf, leaf) : LRCS_OK;
    uint32_t other;
    for (int met = 0; status == LRCS_OK && (other = lrcsi_tree_next(&walk)) != LRCS_NONE; met++) {
        search->crowded += met >= MANY_LEAVES;
        if (!tree->has_slabs && search->crowded / SLABS_COST > tree->blocks[0]) {
            lrcsi_tree_fill_slabs(search->vertex, search->facet, tree);
        }
        if (tree->has_slabs && met == MANY_LEAVES) {
            lrcsi_tree_narrow(&walk, leaf);
        }
        status = meet_leaves(search, leaf, other);
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

/* Proves rings, and makes the tree and its leaves' corners. */
static int prepare_search(touch_search *search, uint32_t vertex_count, uint32_t facet_count,
                          const lrcsi_topology *topology, const unsigned char *skip)
{
    lrcs_work *work = search->work;
    unsigned char *proved = lrcsi_work_take(work, vertex_count, sizeof *proved);
    uint32_t *hub = lrcsi_work_take(work, facet_count, sizeof *hub);
    if (!proved || !hub) {
        return LRCS_E_MEMORY;
    }
    int status = lrcsi_rings_prove(search->vertex, vertex_count, search->facet, facet_count,
                                   topology, skip, work, proved, hub);
    if (status == LRCS_OK) {
        status = lrcsi_tree_make(search->vertex, search->facet, facet_count, skip, hub, 1, work,
                                 &search->tree);
    }
    const lrcsi_tree *tree = &search->tree;
    search->leaf = lrcsi_work_take(work, tree->blocks[0], sizeof *search->leaf);
    if (status != LRCS_OK || !search->leaf) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t place = 0; place < tree->count; place++) {
        const uint32_t *c = search->facet[tree->order[place]].corner;
        touch_leaf *leaf = &search->leaf[place / LEAF_LANES];
        for (int k = 0; k < 3; k++) {
            uint32_t v = search->weld[c[k]];
            leaf->corner[k][place % LEAF_LANES] = proved[v] ? v : LRCS_NONE;
        }
    }
    return LRCS_OK;
}

size_t lrcsi_touches_need(uint32_t vertex_count, uint32_t facet_count, size_t count)
{
    size_t need = 2 * lrcsi_work_bytes((size_t)facet_count + 1, sizeof(uint32_t));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facet_count, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(vertex_count, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facet_count, sizeof(uint32_t)));
    size_t rings = lrcsi_rings_need(vertex_count);
    size_t search = lrcsi_tree_need(facet_count);
    search =
        lrcsi_work_add(search, lrcsi_work_bytes(facet_count / LEAF_LANES + 1, sizeof(touch_leaf)));
    search = lrcsi_work_add(
        search, lrcsi_work_bytes(lrcsi_work_add(count, FOUND_BLOCK), sizeof(touch_found)));
    return lrcsi_work_add(need, rings > search ? rings : search);
}

/* Everything but the release on failure. What is found grows above the tree, and moves down, less
   the facets' numbers, at the end. */
static int touches_build(touch_search *search, uint32_t vertex_count, uint32_t facet_count,
                         const lrcsi_topology *topology, const unsigned char *skip)
{
    lrcs_work *work = search->work;
    lrcsi_touches *t = search->touches;
    t->first = lrcsi_work_take_zero(work, (size_t)facet_count + 1, sizeof *t->first);
    t->rim = lrcsi_work_take_zero(work, facet_count, 1);
    size_t mark = work->used;
    if (!t->first || !t->rim) {
        return LRCS_E_MEMORY;
    }
    int status = prepare_search(search, vertex_count, facet_count, topology, skip);
    for (uint32_t leaf = 0; status == LRCS_OK && leaf < search->tree.blocks[0]; leaf++) {
        status = meet_leaf(search, leaf);
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

int lrcsi_touches_make(const lrcs_point *vertex, uint32_t vertex_count, const lrcs_facet *facet,
                       uint32_t facet_count, const lrcsi_topology *topology,
                       const unsigned char *skip, const uint32_t *piece, lrcs_work *work,
                       lrcsi_touches *touches)
{
    size_t mark = work->used;
    lrcsi_touches made = {0};
    touch_search search = {.vertex = vertex,
                           .facet = facet,
                           .weld = topology->weld,
                           .piece = piece,
                           .work = work,
                           .touches = &made};
    int status = touches_build(&search, vertex_count, facet_count, topology, skip);
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    *touches = made;
    return LRCS_OK;
}
