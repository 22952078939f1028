/* SPDX-License-Identifier: MIT */
/* For curved shapes among other parts: on which fraction of each facet the visibility of the true
   shapes may differ from that of their facets.

   Definitions. A part Q may hide points of another part P.
     d        direction to the laser; heights are measured along d, and "in projection" means in
              the projection along d
     ray      of a point: the half-line from it towards the laser; what it meets hides the point
     B, W     of a curved part that the library makes: a closed convex body, which may be flat, and
              the true surface, which is the boundary of B; if the part is open, without one or
              more flat openings
     S        the part's facets; a map takes W onto S
     e        the part's reach (lrcs_part.reach): the map moves no point by more than e. For plates,
              boxes and models e = 0, and W is S
     k        the part's Hausdorff distance (lrcs_part.hausdorff). If it is closed or flat, every
              point of B is within k of the solid that S encloses (of S, if flat), and every
              point of that within k of B. If it is open, every point of W is within k of S, every
              point of S within k of W, and every rim of W within k of an event edge of S. For
              plates, boxes and models k = 0. It is smaller than e, because nearest points need
              not preserve areas
     x, y     a point of the true surface of P, and its image on a facet of P
     r        the slack of P and Q (lrcsi_proximity_slack), at least e_P + k_Q, and if Q is open at
              least k_Q + max(e_P, k_Q)
     V        all points of B and behind B; V is convex
     upper, lower side of B: the points where lines along d leave B, and where they enter it; in
              projection their heights are a concave and a convex function
     event edge of Q: an edge, unless exactly two facets of Q meet in it, continue each other and
              face the same way; contours and the rims of openings are event edges
   In 1 to 3, B, W, S and V are those of Q. Two conditions on y:
     (1) A facet of Q is within r of y in space; if Q is closed, a facet that faces the laser.
     (2) An event edge of Q is within r of y in projection, and not 2 r behind y.

   1. Visibility. Unless (1) or (2) holds, Q hides x if and only if its facets hide y. Proof:
   a. The facets of Q hide all points z of the ball of radius r about y, or none of them: as z
      moves, the number of facets of Q on its ray changes only where z crosses a facet, (1), or the
      ray crosses an event edge, (2). In (1), facets of a closed Q that face away from the laser
      need not be counted: where z crosses one, it enters or leaves the inside of Q, and on either
      side of it the ray of z meets a facet that faces the laser.
   b. If they hide no z, Q does not hide x: if a point of W hid x, a point s within k_Q of it would
      hide a point z within k_Q of x, and z is in the ball. If Q is open or flat, s is a point of S.
      If Q is closed, s is a point of the solid that S encloses: a ray that reaches s from below
      leaves that solid at s or above, through S, so that S hides z.
   c. If they hide all z and k_Q = 0, Q hides x: W is S, and x is in the ball.
   d. If they hide all z and k_Q > 0, every z lies within k_Q of V. Since V is convex, the ball of
      radius r - k_Q about y lies in V, and x is in that ball. So the ray of x meets B, and leaves
      it at a point u. Q hides x, unless all points of the boundary of B on the ray lie in openings.
   e. In that remaining case (1) or (2) holds. Let m = max(e_P, k_Q), s a point of S that hides the
      highest z, and w a point of W within k_Q of s: in projection w is within k_Q of y, and it is
      higher than y by at least r - k_Q. Follow the boundary of B from the line through x along d
      to w, straight in projection. In projection this path stays within m of y.
      - If w is on the upper side, follow that side from u. The path crosses a rim, because u is in
        an opening and w is not. Both ends are higher than y - e_P, and the upper side is concave:
        so the rim point is higher than y - e_P as well.
      - Otherwise follow the lower side, and at its end a wall parallel to d if w is on one. From
        some point on, the path stays on W. If that point is lower than y, the path passes the
        height of y after it, on W and within m of y. Next to a point of W within m of y is a point
        of S within m + k_Q <= r of y, so (1) holds. If that point is not lower than y, it is a rim
        point, or it is the start of the path, on W. Such a start is below x, because no point of
        W is on the ray of x; so it is within e_P of y, and (1) holds again.
      The event edge within k_Q of the rim point is within m + k_Q <= r of y in projection and not
      2 r behind y: (2) holds. []

   2. Distance in projection. In the distance of (2) from y, a bound on the component of x - y
   perpendicular to d may replace e_P, unless Q is open and k_Q > 0. On the curved wall of a shape
   that is placed without distortion, the map moves points by known distances from or towards the
   axis, along it, and tangentially (lrcs_part.displacement). The bound is the sum of the three, of
   which the first two are multiplied by the sines of the angles between these directions and d. To
   the sides of an event edge only the component of x - y perpendicular to the edge counts, since
   the paths below cross the line of the edge only if that component and k_Q together reach it; at
   the ends of the edge the whole bound counts.
   Proof: it suffices to take for z the points x + v, |v| <= k_Q, and the straight paths from y to
   them. In b, the point s hides one of these z. In c, x is one of them. In d, if S hides all of
   them, the ball of radius k_Q about x lies within k_Q of V; so x lies in V, and Q, without
   openings, hides x. []

   3. Gain and loss. An event edge is near if (2) holds for it. It is one-sided if all facets of Q
   on it lie on the same side of it in projection, its inner side; the other side is its outer side.
   Let a point move from y straight to one of the z, and let n be the number of facets of Q on its
   ray. Unless (1) holds or a near edge is not one-sided, n rises from 0 only where the ray crosses
   a near edge from its outer to its inner side, and falls to 0 only where it crosses one from its
   inner to its outer side. It crosses the line of an edge at most once.
   - Loss: Q hides x, but its facets do not hide y. Then (1) holds, or a near edge is not one-sided,
     or y is on the outer side of a near edge. Proof: n rises from 0 on the path to the z of b.
   - Gain: the facets of Q hide y, but Q does not hide x. If Q is not open or k_Q = 0, (1) holds, or
     a near edge is not one-sided, or y is on the inner side of a near edge. Proof: otherwise n
     never falls to 0, so S hides all z, and Q hides x. The same is true if Q has one opening and x
     is not in B: the ray of x enters B and leaves it, and passes the opening only once. For any
     other Q, gain is possible on both sides.

   4. Own part. A part never hides those of its own points that face the laser: they are the upper
   side of its B. The inside of an open part, where it reflects (two-sided), is the lower side of B,
   seen through an opening: the part does not hide x if and only if the projection of x lies in the
   projected opening of W, and likewise y for S. Projected openings of W and S are convex and within
   e of each other. So x and y agree, unless y is in projection within 2 e of a rim beyond which the
   wall faces the laser, or may face it.

   5. Grazing facets. Facets that are edge-on to within rounding (lrcsi_proximity.grazing_cos) count
   as uncertain over their whole area: rounding may have folded the mesh there.

   6. Bands. A proximity band contains all points of a facet where (1), (2) or the condition of 4
   may hold: prisms about facets, rectangles about edges. The fractions of a facet in its bands add
   up to an upper bound of the fraction where the visibility of true shapes and facets may differ.
   A fraction of the facet's area is the same fraction of its patch, because the map stretches
   areas evenly (mesh/shape/revolution.c), up to what lrcs_part.stretch_err bounds.

   7. Regions. Facets of a curved part that are nowhere uncertain, joined across edges, form
   regions. Other parts hide a region entirely or not at all; one hidden facet that faces the laser
   tells which. A facet that meets no band of Q, and of which a facet of Q hides a point, is hidden
   by Q entirely, whatever bands of other parts it meets.

   8. Rows. A row of a facet on a straight wall (scene/proximity.h) that meets no band is visible
   over its whole length or nowhere, for the facets and for the true shapes. For the facets: along
   the row, what other parts hide changes only where (1) or (2) holds, and what its own part hides,
   seen from inside, only at a rim as in 4. For the true shapes: by 1, at each of its points.

   9. Flat facets behind a Q with at most one opening. If Q is in front of the plane of a facet, x
   and y lie in that plane, and whether Q and its facets hide them depends only on their outlines
   (visibility/proximity/outline.h): (1) need not be considered. y is gained or lost along the event edge of
   (2) that is nearest to it, and there only within the region of outline.h, 2, where delta is the
   distance in projection of x from y and the error of outline.h, 1. So along each edge the smaller
   of two areas counts: that of the rectangle and that of the region.

   10. A part behind another. If a plane that does not face away from the laser has P in front of it
   and Q behind it, true surfaces and facets of both, then Q hides neither x nor y
   (visibility/proximity/depth_order.h), and its facets and event edges need not be considered. If it has Q in
   front of it and P behind it, and Q has at most one opening, Q hides x if and only if the
   projection of x lies in that of B, and likewise for y and the facets: so (1) need not be
   considered, and what 9 says of event edges holds, delta being the distance in projection of x
   from y. Where both parts touch the plane to within rounding, the fraction of the facet and of its
   patch that lies within rounding of it counts as gained and lost.

   11. Aligned points. Let x now be the point of the true surface whose projection is that of
   y, so that both lie on a line along d, at a distance of at most 30 e_P. Let every other part Q be
   in front of P or behind it as in 10, or have no facet within 32 slacks of the facet of y
   (scene/proximity.h). Then (1) need not be considered, and Q hides x if and only if its facets
   hide y, unless an event edge of Q is, in projection, within r' of both and not 64 slacks behind
   y, where r' is k_Q or, if Q is open, 2 k_Q: the slack for e_P = 0. Proof:
   - If Q is behind P, it hides neither.
   - If Q is in front of P, all of Q is nearer than x and y. The number of facets of Q on the ray of
     a point z changes only where the projection of z crosses an event edge. So the steps b to e of
     1 hold for x in place of y with e_P = 0; in e a path that stays on W ends in front of x, so
     that it reaches a rim.
   - Otherwise no facet of Q is within r' of x, or between x and y, since both are within 30 e_P +
     r' <= 32 slacks of y. So the facets of Q hide y if and only if they hide x, and 1 holds for x
     in place of y with e_P = 0. What 3 and 9 say of gain and loss holds as well, with delta = 0. []
   A side of a facet is free if every event edge of other parts that may matter is farther than r' +
   2 e_P from it in projection. Then all points of the true surface whose projections are within
   2 e_P of the side, and that are within 30 e_P of the facet, are visible, and so are the points of
   the facet there; or all of them are hidden. The proof is the same.
   These fractions are of the facet's projected area. They are used for facets that face the laser
   (integrate/wall/round_pieces.h). */
#ifndef LRCSI_PROXIMITY_BAND_H
#define LRCSI_PROXIMITY_BAND_H

#include "visibility/uniform/classify.h"
#include "visibility/uniform/query.h"

typedef struct lrcsi_proximity_band {
    lrcsi_classification *classification;
    double *mismatch; /* facet: fraction of its area where visibility may differ, 0 .. 1 */
    double *gain;     /* facet: fraction that the facets hide and the true shapes may not */
    double *loss;     /* facet: fraction that the true shapes may hide and the facets do not */
    double *rows;     /* facet: fraction of its rows (scene/proximity.h) that meet such a band */
    double *gain_aligned;      /* facet: the gain of 11; negative: it is not known */
    double *loss_aligned;      /* facet: the loss of 11, if that is known */
    unsigned char *free_sides; /* facet: bit k is 1 if no event edge of another part is near its
                                  side from corner k to k + 1 (11) */
    lrcsi_part_set *parts;     /* facet: the parts whose bands it meets */
    uint32_t *region;          /* facet of a curved part: its region, named by one of its facets */
    unsigned char *hidden;     /* region: not 0 if other parts hide all of it, in truth too
                                  (visibility/proximity/proximity_hidden.h) */
} lrcsi_proximity_band;

/* Upper bound of bytes; 0 if prepared->proximity.reach is NULL. */
size_t lrcsi_proximity_band_need(const lrcs_prepared *prepared);

/* For a scene with prepared->proximity.reach. No region is marked hidden yet. Facets that neither
   reflect nor belong to a curved part are left out: mismatch 0. Status: LRCS_OK; LRCS_E_MEMORY;
   LRCS_E_LIMIT. The fractions stay in the work area; scratch memory is released. */
int lrcsi_proximity_band_make(lrcsi_classification *classification, lrcsi_meter *meter,
                              lrcs_work *work, lrcsi_proximity_band *band);

/* Joins facets of one part across edges into groups, each named by its first facet: facets of
   curved parts without bands or, if `candidate` is given, facets that it marks and that meet bands
   of the same parts. */
void lrcsi_proximity_band_join(const lrcsi_proximity_band *band, const unsigned char *candidate,
                               uint32_t *group);

#endif
