/* SPDX-License-Identifier: MIT */
/* The intersection of a facet with the plane of another facet, the target, whose interior it meets:
   a segment in the target's frame (for a needle, in barycentric coordinates) with its position
   error, or the whole facet. */
#ifndef LRCSI_CONTACT_H
#define LRCSI_CONTACT_H

#include "visibility/cells/target.h"

enum lrcsi_contact_kind {
    LRCSI_CONTACT_POINT,  /* at most a point */
    LRCSI_CONTACT_LINE,   /* a segment; the part of the facet to its left is in front */
    LRCSI_CONTACT_FRONT,  /* a segment; the facet is in front, except near the segment's line */
    LRCSI_CONTACT_BEHIND, /* a segment; the facet is behind, except near the segment's line */
    LRCSI_CONTACT_FLAT,   /* both facets lie exactly in one plane */
    LRCSI_CONTACT_UNKNOWN /* a segment somewhere in the facet: no more is known */
};

/* A facet in the target's frame, and its intersection with the target's plane. */
typedef struct lrcsi_contact {
    double corner[3][2]; /* counter-clockwise; in a needle, rounded */
    double distance[3];  /* of the corners from the target's origin, in space; 0 in a needle */
    double end[2][2];    /* of the segment; in a needle, of its part near the target */
    double reach;        /* upper bound of the ends' distances from that origin */
    double position_err; /* error of the ends, in addition to 16 u reach */
    double corner_err; /* in a needle: error of the corners; it and rounding add to position_err */
} lrcsi_contact;

/* Returns a lrcsi_contact_kind; ends and position error are set only if there is a segment. */
int lrcsi_contact_find(const lrcsi_target *target, uint32_t other, lrcsi_contact *contact);

#endif
