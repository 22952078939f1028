/* SPDX-License-Identifier: MIT */
/* For curved shapes among other parts: on which fraction of each facet the visibility of the true
   shapes may differ from that of their facets.

   Truth: each engine-made curved part is a piece W of the boundary of a closed convex body B (all
   of it; or less flat openings; or a flat body), and a map moves W onto the part's facets S, no
   point by more than e (lrcs_part.reach; 0 for plate, box and models, whose facets are the truth).
   Let x be a true point of part P, y its place on a facet of P, and d the direction to the laser.

   Claim. Another part Q hides x from the laser if and only if its facets hide y, unless within the
   slack r of lrcsi_proximity_slack there is (1) a facet of Q near y in space (of closed Q: one that
   faces the laser), or (2) an event edge of Q near y in projection and not 2 r behind it: one on
   which not exactly two facets of Q stand that continue each other and face the same way (contours
   and rims). Proof. Moving a point z within the ball of radius r about y, its ray meets more or
   fewer facets of Q only across (1) or (2); across a back-facing facet of a closed Q it leaves or
   enters the inside, from which the ray meets a front. So Q's facets hide all z of the ball, or
   none. None: were x hidden by b in W, the place of b on S, at most e_Q from it, would hide a point
   of the ball. All: where e_Q = 0 the truth is S itself and x lies in the ball. Else let V(B) be
   all points of and behind B, convex. Every z lies within e_Q of V(B), so the ball of radius r -
   e_Q lies in V(B), and x in it: the ray of x meets B, and leaves it at a point u. It hides x but
   where all that it meets are openings. Then let s in S hide the topmost z, w in W be what s is the
   place of, and walk on B's surface from the ray of x to w, at most max(e_P, e_Q) away in
   projection: on its upper side from u, which lies in an opening, if w is there; else on its lower
   side. The walk leaves the opening over its rim, whose place is an event edge within max(e_P, e_Q)
   + e_Q of y in projection; and not behind it, for the upper side is concave and both ends of the
   walk lie above y - e, the lower convex and w above y + r - e_Q, so that where its rim lies lower
   the walk climbs past y on W itself, and (1) holds. []

   Distance in projection. Only the component of x - y across the line of sight matters there. On
   the curved wall of a shape that is placed without distortion, points move by known distances
   along the axis, away from it, and across both (lrcs_part.displaced); the first two are multiplied
   by the sines of their angles with the line of sight. The sum replaces e_P in the distance of (2)
   from y, unless Q is open and e_Q > 0. For in the proof it suffices to take for z the points x +
   v, |v|
   <= e_Q, and the straight paths from y to them: the place of b hides one of them; and if S hides
   them all, the ball of radius e_Q about x lies within e_Q of V(B), so that x lies in V(B).

   Gain and loss. Call an event edge one-sided if all facets of Q on it lie on the same side of it
   in projection, its inner side. Along a straight path from y to such a z, the number of facets of
   Q in front of the moving point rises from 0 only where the path crosses an edge from its outer to
   its inner side, and falls to 0 only where it crosses one the other way; or at edges that are not
   one-sided, or at (1).
   - Loss: Q hides x but not y. The number rises from 0 on the path to the z that the place of b
     hides. So y is on the outer side of a one-sided edge near it, or near an edge of another kind.
   - Gain: Q hides y but not x, and Q is closed or e_Q = 0. If y were on the outer side of all edges
     near it, the number would never fall to 0, S would hide all z, and Q would hide x. So y is on
     the inner side of some edge near it. The same holds if Q has one opening and x is not in B: the
     ray of x enters B and leaves it, and passes the opening only once.
   For other Q a gain is possible on both sides.

   A part's own fronts are never hidden by it: they are the upper side of B. The inside of an open
   part, where it reflects (two-sided), is the lower side, seen through an opening: x is visible
   if and only if the projected opening holds its projection, y likewise. Projected openings, true
   and of facets, are convex and within e of each other: both agree unless y lies within 2 e in
   projection of a rim beyond which the wall faces the laser, or may.

   Facets that are edge-on to within rounding (lrcsi_proximity.grazing_cos) count as uncertain over
   their whole area: rounding may have folded the facet mesh there.

   Facets of a curved part without any uncertain area, joined across edges, form regions. Other
   parts hide a region entirely or not at all; one hidden front facet tells which.

   A facet that meets no band of some other part, one of whose facets hides a point of it, is hidden
   by that part entirely, whatever bands of further parts it meets.

   A row of a facet on a straight wall that meets no band is visible over its whole length or
   nowhere, for the facets and for the true shapes. By facets: whether another part hides a point of
   it can change only across (1) or (2), and whether its own part does, seen from inside, only
   across a rim as above. In truth: by the claim, point by point.

   So the fractions of a facet within such bands (rectangles about edges, prisms about facets) add
   up to an upper bound of the fraction where true shapes and facets may differ. The fraction of the
   facet's area is that of its patch, because the map stretches areas evenly (mesh/profile.c), up to
   what lrcs_part.uneven bounds. */
#ifndef LRCSI_PROXIMITY_BAND_H
#define LRCSI_PROXIMITY_BAND_H

#include "visibility/classify.h"
#include "visibility/query.h"
#include "visibility/visible.h"

typedef struct lrcsi_proximity_band {
    const lrcsi_classification *classification;
    double *share; /* facet: fraction of its area where visibility may differ, 0 .. 1 */
    double *gain;  /* facet: fraction that the facets hide and the true shapes may not */
    double *loss;  /* facet: fraction that the true shapes may hide and the facets do not */
    double *rows;  /* facet: fraction of its rows (scene/proximity.h) that meet such a band */
    lrcsi_part_set *parts; /* facet: the parts whose bands it meets */
    uint32_t *region;      /* facet of a curved part: its region, named by one of its facets */
    unsigned char *hidden; /* region: not 0 if other parts hide all of it, in truth too */
} lrcsi_proximity_band;

/* Upper bound of bytes; 0 if prepared->proximity was not requested. */
size_t lrcsi_proximity_band_need(const lrcs_prepared *prepared);

/* For a scene with prepared->proximity.reach. No region is marked hidden yet. Facets that neither
   reflect nor belong to a curved part are left out: share 0. Status: LRCS_OK;
   LRCS_E_MEMORY; LRCS_E_LIMIT. The shares stay in the work area, scratch does not. */
int lrcsi_proximity_band_make(const lrcsi_classification *classification, lrcsi_meter *meter,
                              lrcs_work *work, lrcsi_proximity_band *band);

/* Bytes for lrcsi_proximity_band_settle. */
size_t lrcsi_proximity_band_settle_need(const lrcs_prepared *prepared);

/* Finds what is hidden in truth too, once visible areas are known: regions, and facets with bands,
   which then have none. Without memory, or when the meter is spent, it finds less. */
void lrcsi_proximity_band_settle(const lrcsi_proximity_band *band, const lrcsi_visible *visible,
                                 lrcsi_meter *meter, lrcs_work *work);

#endif
