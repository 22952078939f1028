/* SPDX-License-Identifier: MIT */
/* Contacts by brute force: every pair of facets, by exact signs alone, without a box, a fan or a
   filter. The reference for mesh/contact/intersection.c; itself compared with clipping in rational
   arithmetic. */
#ifndef TEST_MESH_CONTACTS_H
#define TEST_MESH_CONTACTS_H

#include "base/exact.h"
#include "mesh/contact/intersection.h"

typedef struct contacts_facet {
    const double *x[3];
    const double *axis; /* along which it is not edge-on */
    int turn;
} contacts_facet;

static inline contacts_facet contacts_facet_make(const lrcs_point *v, const lrcs_facet *facet)
{
    static const double axis[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    contacts_facet f = {.axis = axis[0]};
    for (int k = 0; k < 3; k++) {
        f.x[k] = v[facet->corner[k]].x;
    }
    for (int k = 0; k < 3 && f.turn == 0; k++) {
        f.axis = axis[k];
        f.turn = lrcsi_exact_orient(f.x[0], f.x[1], f.x[2], f.axis);
    }
    return f;
}

static inline int contacts_same(const double *a, const double *b)
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Signs of g's corners against the plane of f. */
static inline void contacts_sides(const contacts_facet *f, const contacts_facet *g, int side[3])
{
    for (int k = 0; k < 3; k++) {
        side[k] = lrcsi_exact_side(f->x[0], f->x[1], f->x[2], g->x[k]);
    }
}

/* Has the line of some side of f all of g outside or on it, seen along the axis? */
static inline int contacts_separated(const contacts_facet *f, int turn, const contacts_facet *g,
                                     const double *axis)
{
    for (int k = 0; k < 3; k++) {
        int outside = 0;
        for (int i = 0; i < 3; i++) {
            outside += turn * lrcsi_exact_orient(f->x[k], f->x[(k + 1) % 3], g->x[i], axis) <= 0;
        }
        if (outside == 3) {
            return 1;
        }
    }
    return 0;
}

/* How t meets the inside of f. */
static inline int contacts_kind(const contacts_facet *f, const contacts_facet *t)
{
    int side[3];
    contacts_sides(f, t, side);
    if (side[0] == 0 && side[1] == 0 && side[2] == 0) {
        int turn = lrcsi_exact_orient(t->x[0], t->x[1], t->x[2], f->axis);
        return contacts_separated(f, f->turn, t, f->axis) || contacts_separated(t, turn, f, f->axis)
                   ? LRCSI_INTERSECTION_NONE
                   : LRCSI_INTERSECTION_COPLANAR;
    }
    /* Where the plane cuts t: lines from u to w that cross it. */
    const double *u[3];
    const double *w[3];
    int up[3];
    int ends = 0;
    for (int k = 0; k < 3; k++) {
        int next = (k + 1) % 3;
        int off = side[next] != 0 ? next : (k + 2) % 3;
        if (side[k] == 0 || side[k] == -side[next]) {
            int to = side[k] == 0 ? off : next;
            u[ends] = t->x[k];
            w[ends] = t->x[to];
            up[ends++] = side[to];
        }
    }
    for (int k = 0; k < 3; k++) {
        int inner = 0;
        for (int i = 0; i < ends; i++) {
            inner |= up[i] * lrcsi_exact_side(u[i], w[i], f->x[k], f->x[(k + 1) % 3]) > 0;
        }
        if (!inner) {
            return LRCSI_INTERSECTION_NONE;
        }
    }
    int of_f[3];
    contacts_sides(t, f, of_f);
    int above = of_f[0] > 0 || of_f[1] > 0 || of_f[2] > 0;
    int below = of_f[0] < 0 || of_f[1] < 0 || of_f[2] < 0;
    return ends == 1 || (above && below) ? LRCSI_INTERSECTION_CROSS : LRCSI_INTERSECTION_NONE;
}

/* Is x, on the line a b, strictly between a and b? */
static inline int contacts_between(const double *a, const double *b, const double *x)
{
    for (int k = 0; k < 3; k++) {
        if (a[k] != b[k]) {
            return (a[k] < x[k] && x[k] < b[k]) || (b[k] < x[k] && x[k] < a[k]);
        }
    }
    return 0;
}

/* Does the open segment a b meet the closed facet t? */
static inline int contacts_pierces(const contacts_facet *t, const double *a, const double *b)
{
    int at_a = lrcsi_exact_side(t->x[0], t->x[1], t->x[2], a);
    int at_b = lrcsi_exact_side(t->x[0], t->x[1], t->x[2], b);
    if (at_a * at_b < 0) {
        int signs[3] = {0, 0, 0};
        for (int k = 0; k < 3; k++) {
            signs[lrcsi_exact_side(a, b, t->x[k], t->x[(k + 1) % 3]) + 1]++;
        }
        return signs[0] == 0 || signs[2] == 0;
    }
    if (at_a != 0 || at_b != 0) {
        return 0;
    }
    /* In one plane: a corner of t lies on it, it crosses a side, or t has both ends. */
    int has_a = 1;
    int has_b = 1;
    for (int k = 0; k < 3; k++) {
        const double *p = t->x[k];
        const double *q = t->x[(k + 1) % 3];
        int turn_p = lrcsi_exact_orient(a, b, p, t->axis);
        int turn_q = lrcsi_exact_orient(a, b, q, t->axis);
        int turn_a = lrcsi_exact_orient(p, q, a, t->axis);
        int turn_b = lrcsi_exact_orient(p, q, b, t->axis);
        if ((turn_p == 0 && contacts_between(a, b, p)) ||
            (turn_p * turn_q < 0 && turn_a * turn_b < 0)) {
            return 1;
        }
        has_a &= t->turn * turn_a >= 0;
        has_b &= t->turn * turn_b >= 0;
    }
    return has_a && has_b;
}

/* Does t meet the rim of f other than in corners of f or along a side that both have? */
static inline int contacts_rim(const contacts_facet *f, const contacts_facet *t)
{
    for (int k = 0; k < 3; k++) {
        const double *a = f->x[k];
        const double *b = f->x[(k + 1) % 3];
        int has_a = 0;
        int has_b = 0;
        for (int i = 0; i < 3; i++) {
            has_a |= contacts_same(a, t->x[i]);
            has_b |= contacts_same(b, t->x[i]);
        }
        if (!(has_a && has_b) && contacts_pierces(t, a, b)) {
            return 1;
        }
    }
    return 0;
}

/* Does a corner of t lie inside a side of f? */
static inline int contacts_on_side(const contacts_facet *f, const contacts_facet *t)
{
    for (int i = 0; i < 9; i++) {
        const double *a = f->x[i / 3];
        const double *b = f->x[(i / 3 + 1) % 3];
        if (lrcsi_exact_collinear(a, b, t->x[i % 3]) && contacts_between(a, b, t->x[i % 3])) {
            return 1;
        }
    }
    return 0;
}

#endif
