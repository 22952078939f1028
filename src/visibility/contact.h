/* SPDX-License-Identifier: MIT */
/* Where a facet that touches the inside of another meets its plane: a line in the other's frame (a
   needle's own, where it is one), with how far that may be off, or all of the facet. */
#ifndef LRCSI_CONTACT_H
#define LRCSI_CONTACT_H

#include "visibility/target.h"

enum lrcsi_contact_kind {
    LRCSI_CONTACT_POINT,  /* in a point at most */
    LRCSI_CONTACT_LINE,   /* in the segment told; what is left of it is in front */
    LRCSI_CONTACT_FRONT,  /* in the segment told; all is in front but near its line, however far */
    LRCSI_CONTACT_BEHIND, /* in the segment told; all is behind but near its line */
    LRCSI_CONTACT_FLAT,   /* the two lie in one plane, exactly */
    LRCSI_CONTACT_UNKNOWN /* in a segment, somewhere in the facet: it cannot be decided better */
};

/* A facet in the target's frame, and where it meets the target's plane. */
typedef struct lrcsi_contact {
    double corner[3][2]; /* counter-clockwise; in a needle, rounded */
    double away[3];      /* their distances, in space, from the target's first; in a needle 0 */
    double end[2][2];    /* of the segment; in a needle, of what lies near it */
    double reach;        /* how far away they are at most, likewise */
    double position_err; /* how far they may be off, but for 16 u of that, */
    double off;          /* or, in a needle, for this and rounding */
} lrcsi_contact;

/* A lrcsi_contact_kind; the ends and the position error are told of a segment only. */
int lrcsi_contact_find(const lrcsi_target *target, uint32_t other, lrcsi_contact *contact);

/* 1 if `other` is nearer wherever a line meets both, because one lies on one side of the other's
   plane; -1 if it is farther; 0 if that does not tell. Exact. */
int lrcsi_contact_side(const lrcsi_view *view, uint32_t facet, uint32_t other);

/* The same of two facets whose insides do not meet: then their order is the same wherever a line
   meets both, so also where two of their sides cross. */
int lrcsi_contact_order(const lrcsi_view *view, uint32_t facet, uint32_t other);

/* The same by a corner of one within the other, or on its sides. What both cover of the view is a
   convex polygon; each of its corners is a place where two sides cross, or such a corner. Unless
   the two lie in one plane they differ in height at one of these at least: so if they overlap,
   lrcsi_contact_order or this one tells. */
int lrcsi_contact_within(const lrcsi_view *view, uint32_t facet, uint32_t other);

#endif
