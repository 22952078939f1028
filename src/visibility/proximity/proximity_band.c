/* SPDX-License-Identifier: MIT */
/* Adds up, for each facet, the fractions of its area near event edges and near facets of other
   parts. How far from an event edge they extend is decided in visibility/proximity/event_band.c,
   and which facets of other parts are near in scene/proximity.c. integrate/wall/tessellation.c
   decides what the uncertain areas add to the bound of sigma.

   Definitions. A part Q may hide points of another part P. `bounds` is lrcs_part.bounds.
     d        direction to the laser; heights are measured along d, and "in projection" means in
              the projection along d
     ray      of a point: the half-line from it towards the laser; what it meets hides the point
     B, W     of a curved part that the library makes: a closed convex body, which may be flat, and
              the true surface, which is the boundary of B; if the part is open, without one or
              more flat openings
     S        the part's facets; a map takes W onto S
     e        the part's reach (bounds.reach): the map moves no point by more than e. For plates,
              boxes and models e = 0, and W is S
     k        the part's Hausdorff distance (bounds.hausdorff). If it is closed or flat, every
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
              face the same way; contours and the rims of openings are event edges. Edges without a
              facet that counts (1.a) are event edges only if they are rims
   In 1, B, W, S and V are those of Q. Two conditions on y:
     (1) A facet of Q is within r of y in space; if Q is closed, a facet that faces the laser.
     (2) An event edge of Q is within r of y in projection, and not 2 r behind y.

   1. Visibility. Unless (1) or (2) holds, Q hides x if and only if its facets hide y. Proof:
   a. The facets of Q hide all points z of the ball of radius r about y, or none of them: as z
      moves, the number of facets of Q on its ray changes only where z crosses a facet, (1), or the
      ray crosses an event edge, (2). Facets seen edge-on do not count: almost no ray meets one.
      Nor do those of a closed Q that face away from the laser: a ray that meets one leaves Q later,
      through a facet that faces the laser; where rounding has folded the mesh at a contour, so that
      it does not, the contour is within rounding of it, and (2) holds. In (1) they do not count
      either: where z crosses one, it enters or leaves the inside of Q, and on either side of it the
      ray of z meets a facet that faces the laser.
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
   f. A facet of Q in (1) matters only if y is within a distance a of its plane, unless Q is open
      and k_Q > 0: a = k_Q plus a bound on the component of x - y perpendicular to that plane. On
      the side of the plane towards the laser y can only be lost, on the other side only gained; if
      Q is open and k_Q > 0, gain is possible on both sides. Proof: as in event_band.c, 1, straight
      paths from y to the points z = x + v, |v| <= k_Q, suffice for b to d. Such a path moves by at
      most a perpendicular to the plane, and crosses it at most once; so it crosses the facet only
      if y is within a of the plane. The number of facets on the ray of z rises from 0 at a facet
      only where z passes from its side towards the laser to the other, and falls to 0 at a facet
      only where z passes it the other way. By b, y is lost only if that number rises from 0 on a
      path; by c and d, it is gained only if the number falls to 0. []

   2. Grazing facets. Facets that are edge-on to within rounding (lrcsi_proximity.grazing_cos) count
   as uncertain over their whole area: rounding may have folded the mesh there.

   3. Bands. A proximity band contains all points of a facet where (1), (2) or the condition of
   event_band.c, 3, may hold: prisms about facets, rectangles about edges. The fractions of a facet
   in its bands add up to an upper bound of the fraction where the visibility of true shapes and
   facets may differ. A fraction of the facet's area is the same fraction of its patch, because the
   map stretches areas evenly (mesh/shape/revolution.c), up to what bounds.stretch_err states.

   4. Regions. Facets of a curved part that are nowhere uncertain, joined across edges, form
   regions. Other parts hide a region entirely or not at all; one hidden facet that faces the laser
   tells which. A facet that meets no band of Q, and of which a facet of Q hides a point, is hidden
   by Q entirely, whatever bands of other parts it meets.

   5. Rows. A row of a facet on a straight wall (scene/proximity.h) that meets no band is visible
   over its whole length or nowhere, for the facets and for the true shapes. For the facets: along
   the row, what other parts hide changes only where (1) or (2) holds, and what its own part hides,
   seen from inside, only at a rim as in event_band.c, 3. For the true shapes: by 1, at each of its
   points. */
#include "visibility/proximity/proximity_band.h"

#include <math.h>

#include "base/disjoint.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/work.h"
#include "scene/proximity.h"
#include "scene/proximity_pair.h"
#include "visibility/proximity/event_band.h"
#include "visibility/proximity/near_events.h"

typedef struct band_job {
    const lrcsi_view *view;
    lrcsi_meter *meter;
    lrcsi_event_bands bands;
    lrcsi_edge_faces *faces; /* event: the faces that include its margin */
    lrcsi_wall_margins walls;
    lrcsi_box curved; /* of all facets of curved parts, in the view */
    lrcsi_near_events near;
    lrcsi_part_set *unproved; /* facet: the parts of which add_unproved has added the fraction */
    lrcsi_part_set unproved_aligned; /* likewise, where points are aligned, of the facet at hand */
    lrcsi_proximity_band *band;      /* to be filled */
} band_job;

/* Of the sides of a facet: no event edge is near; one may be near everywhere. */
static const lrcsi_near_sides sides_free = {{{1, 0}, {1, 0}, {1, 0}}};
static const lrcsi_near_sides sides_near = {{{0, 1}, {0, 1}, {0, 1}}};

/* --- one facet -------------------------------------------------------------------------------- */

/* Adds fractions of a facet's area, near one of these parts: of `area`, what the facets may hide
   and the true shapes may not, and the reverse. */
static void add_fractions(lrcsi_proximity_band *band, uint32_t facet, double area, double gain,
                          double loss, lrcsi_part_set parts)
{
    band->parts[facet] |= parts;
    band->mismatch[facet] += area;
    band->gain[facet] += gain;
    band->loss[facet] += loss;
    band->margin[facet].gain += gain;
    band->margin[facet].loss += loss;
}

/* Adds a fraction of a facet's area, near one of these parts, where both may be. */
static void add_both(lrcsi_proximity_band *band, uint32_t facet, double fraction,
                     lrcsi_part_set parts)
{
    add_fractions(band, facet, fraction, fraction, fraction, parts);
}

/* Adds the fraction of a facet for which the proof of its order with another part does not hold,
   unless that was done before. Returns what it adds. */
static double add_unproved(band_job *job, uint32_t facet, uint32_t other, double fraction)
{
    if (!(fraction > 0) || !lrcsi_part_set_add(&job->unproved[facet], other)) {
        return 0;
    }
    add_both(job->band, facet, fraction, lrcsi_part_set_of(other));
    job->band->rows[facet] += fraction;
    job->band->rows_open[facet] += fraction;
    return fraction;
}

/* Adds rows of a facet where a band may be. */
static void add_rows(lrcsi_proximity_band *band, uint32_t facet, lrcsi_row_range rows)
{
    lrcsi_row_range *range = &band->row_range[facet];
    band->rows[facet] += lrcsi_max(0, rows.high - rows.low);
    range->low = lrcsi_min(range->low, rows.low);
    range->high = lrcsi_max(range->high, rows.high);
}

/* Does a part pierce the flat face of a facet, so that the margins of the face contain all of its
   effect? */
static int pierces_face(const band_job *job, uint32_t facet, uint32_t other)
{
    const lrcsi_part_set cut = job->band->face[job->view->prepared->scene->facet_part[facet]].cut;
    return other < LRCSI_PART_SET_SINGLE && (cut & lrcsi_part_set_of(other)) != 0 &&
           lrcsi_face_has_facet(job->view, facet);
}

/* Adds the fractions near the listed event edges, where points correspond by the map. */
static void add_mapped(band_job *job, const lrcsi_band_facet *at)
{
    lrcsi_proximity_band *band = job->band;
    const uint32_t facet = at->facet;
    lrcsi_wall_margin *margin = &band->margin[facet];
    const uint32_t own = job->view->prepared->scene->facet_part[facet];
    const uint32_t count = job->near.count;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t part = job->bands.events.part[job->near.listed[i]];
        lrcsi_event_band fractions;
        if (band->gain[facet] >= 1 && band->loss[facet] >= 1 &&
            lrcsi_part_set_without(band->parts[facet], own) != 0) {
            /* the other edges add nothing to the fractions, only their parts to the set; those of
               its own part alone tell that no other part's matter (clear_sectors.h of
               integrate/wall) */
            for (uint32_t k = i; k < count; k++) {
                band->parts[facet] |=
                    lrcsi_part_set_of(job->bands.events.part[job->near.listed[k]]);
            }
            margin->gain = margin->loss = 1;
            return;
        }
        if (!lrcsi_event_band_make(&job->bands, at, job->near.listed[i], LRCSI_MAPPED,
                                   &fractions)) {
            continue;
        }
        (void)add_unproved(job, facet, part, fractions.unproved);
        if (fractions.area > 0) {
            band->parts[facet] |= lrcsi_part_set_of(part);
            band->mismatch[facet] += fractions.area;
            band->gain[facet] += fractions.gain;
            band->loss[facet] += fractions.loss;
            add_rows(band, facet, fractions.rows);
            if (!lrcsi_wall_margins_add(&job->walls, facet, job->near.listed[i])) {
                margin->gain += fractions.gain;
                margin->loss += fractions.loss;
            }
        }
    }
}

/* What an order proof leaves open of a facet, as a fraction of its projected area, where points are
   aligned. Above the facet there are patches of its own sector and of the two next to it
   (integrate/wall/round_pieces.c); the fraction holds for each of them, of their areas, which are
   no smaller than their projections. */
static double aligned_open(const lrcsi_view *view, uint32_t facet, double unproved)
{
    return 3 * unproved / fabs(lrcsi_view_incidence(view, facet).cos_theta) * LRCSI_OUTWARD_NANO;
}

/* Adds the fractions near the listed event edges, where points are aligned, and finds the free
   sides. */
static void add_aligned(band_job *job, const lrcsi_band_facet *at)
{
    lrcsi_proximity_band *band = job->band;
    const uint32_t facet = at->facet;
    const uint32_t face = lrcsi_face_of(job->view, facet);
    for (uint32_t i = 0; i < job->near.count; i++) {
        lrcsi_event_band fractions;
        lrcsi_event_sides(&job->bands, at, job->near.listed[i], &band->sides[facet]);
        if (face != LRCS_NONE &&
            (lrcsi_edge_faces_hold(&job->faces[job->near.listed[i]], face) ||
             pierces_face(job, facet, job->bands.events.part[job->near.listed[i]]))) {
            continue; /* its area is that of a margin */
        }
        if (!lrcsi_event_band_make(&job->bands, at, job->near.listed[i], LRCSI_ALIGNED,
                                   &fractions)) {
            continue;
        }
        const uint32_t part = job->bands.events.part[job->near.listed[i]];
        const int adds = fractions.unproved > 0 && lrcsi_part_set_add(&job->unproved_aligned, part);
        const double open = adds ? aligned_open(job->view, facet, fractions.unproved) : 0;
        band->gain_aligned[facet] += fractions.gain + open;
        band->loss_aligned[facet] += fractions.loss + open;
    }
    lrcsi_event_rims(&job->bands, at, job->near.listed, job->near.count, band->rim);
}

/* Begins the fractions for aligned points, unless they cannot be known. The facet must lie on a
   round wall and show the laser a side that may be visible, and every other part that is near it
   must be in front of its own part or behind it; what these proofs leave open is counted. */
static int begin_aligned(band_job *job, uint32_t facet)
{
    const lrcs_prepared *p = job->view->prepared;
    const uint32_t own = p->scene->facet_part[facet];
    const lrcsi_part_set near = p->proximity.near[facet];
    double open = 0;
    if (!lrcsi_proximity_on_round_wall(p, facet) || !p->scene->part[own].rigid ||
        !(job->view->facing[facet] > 0 ||
          (lrcsi_band_sees_inside(&job->bands, facet) && lrcsi_view_reflects(job->view, facet)))) {
        return 0;
    }
    for (uint32_t i = 0; i < p->scene->part_count && near != 0; i++) {
        double unproved;
        if ((near & lrcsi_part_set_of(i)) == 0 || i == own) {
            continue;
        }
        if (!lrcsi_part_is_separated(&job->bands.orders, facet, i, &unproved)) {
            return 0;
        }
        if (unproved > 0) {
            open += aligned_open(job->view, facet, unproved);
            lrcsi_part_set_add(&job->unproved_aligned, i);
        }
    }
    job->band->gain_aligned[facet] = job->band->loss_aligned[facet] = open;
    job->band->sides[facet] = sides_free;
    return 1;
}

/* Adds the rim of a known flat face to the fractions of aligned points of one of its facets
   (event_band.c, 6). */
static void add_face_rim(band_job *job, uint32_t facet)
{
    lrcsi_proximity_band *band = job->band;
    const lrcs_prepared *p = job->view->prepared;
    const double reach = p->proximity.reach[p->scene->facet_part[facet]];
    const unsigned sides = lrcsi_face_border_sides(job->view, facet);
    for (int k = 0; k < 3; k++) {
        if (((sides >> k) & 1) != 0 && !lrcsi_band_side_is_free(band, facet, k)) {
            double rim = 4 * reach * lrcsi_proximity_longest(p, facet) / p->normal[facet].length;
            band->gain_aligned[facet] += rim * LRCSI_OUTWARD_NANO;
            band->loss_aligned[facet] += rim * LRCSI_OUTWARD_NANO;
        }
    }
}

/* Is a facet on a flat face whose margins are known? */
static int is_on_known_face(const band_job *job, uint32_t facet)
{
    const uint32_t face = lrcsi_face_of(job->view, facet);
    return face != LRCS_NONE && job->band->face[face].known;
}

static int facet_matters(const lrcsi_view *view, uint32_t facet)
{
    const lrcs_prepared *p = view->prepared;
    return !p->skip[facet] && (lrcsi_view_reflects(view, facet) ||
                               p->proximity.reach[p->scene->facet_part[facet]] > 0);
}

/* Is a facet flat, and beside all curved parts in projection? Then nothing is near it. */
static int is_beside_curved(const band_job *job, uint32_t facet)
{
    const lrcs_prepared *p = job->view->prepared;
    if (p->proximity.reach[p->scene->facet_part[facet]] > 0) {
        return 0;
    }
    const lrcsi_band_search search = lrcsi_band_search_make(&job->bands, facet);
    const lrcsi_edge_search *where = &search.edges;
    return where->low[0] > job->curved.high[0] || where->low[1] > job->curved.high[1] ||
           where->high[0] < job->curved.low[0] || where->high[1] < job->curved.low[1];
}

/* 1. Event edges near the facet, listed once for both correspondences of points; 2. grazing
   incidence. Given: those near its meshlet; on a known flat face, what of it is near other parts
   that do not pierce the face. */
static void facet_fractions(band_job *job, uint32_t facet)
{
    const lrcsi_view *view = job->view;
    const lrcs_prepared *p = view->prepared;
    double reach = p->proximity.reach[p->scene->facet_part[facet]];
    const int on_face = is_on_known_face(job, facet);
    const lrcsi_band_search where = lrcsi_band_search_make(&job->bands, facet);
    const int found = lrcsi_near_events_of_facet(&job->near, facet, &where); /* 1 */
    job->unproved_aligned = 0;
    const int aligned = on_face || begin_aligned(job, facet);
    if (!found) {
        add_both(job->band, facet, 1, LRCSI_PART_SET_ALL);
        job->band->gain_aligned[facet] = -1;
    } else if (job->near.count > 0) {
        const lrcsi_band_facet at = lrcsi_band_facet_make(&job->bands, facet, &where.edges);
        add_mapped(job, &at);
        if (aligned) {
            add_aligned(job, &at);
        }
    }
    if (found && on_face) {
        add_face_rim(job, facet);
    }
    if (reach > 0 && /* 2 */
        fabs(lrcsi_view_incidence(view, facet).cos_theta) <=
            p->proximity.grazing_cos[p->scene->facet_part[facet]] + LRCSI_VIEW_COS_ERR) {
        add_both(job->band, facet, 1, LRCSI_PART_SET_ALL);
        job->band->gain_aligned[facet] = on_face ? -1 : job->band->gain_aligned[facet];
    }
}

/* Those of the facets of a meshlet that matter and that something may be near. */
static void meshlet_fractions(band_job *job, uint32_t start, uint32_t end)
{
    uint32_t facet[LRCSI_MESHLET_FACETS];
    uint32_t count = 0;
    for (uint32_t f = start; f < end; f++) {
        if (facet_matters(job->view, f) && !is_beside_curved(job, f)) {
            facet[count++] = f;
        }
    }
    lrcsi_near_events_of_meshlet(&job->near, facet, count);
    for (uint32_t i = 0; i < count; i++) {
        facet_fractions(job, facet[i]);
    }
}

/* --- all facets ------------------------------------------------------------------------------- */

/* Does a facet face the laser, and the true surface around it (scene/proximity_contact.c, 1)? */
static int faces_around(const lrcsi_view *view, uint32_t facet)
{
    const lrcs_prepared *p = view->prepared;
    const uint32_t part = p->scene->facet_part[facet];
    const int is_flat = p->scene->facet_smooth[facet] == 0;
    const double turn = is_flat ? 0 : 3 * p->scene->part[part].bounds.patch.turn;
    return view->facing[facet] > 0 &&
           !lrcsi_view_may_show_both(view, facet, turn + p->proximity.grazing_cos[part]);
}

/* What is gained and lost near a facet of another part (1.f). Given: the fractions in front of its
   plane and behind it. */
static void pair_sides(const band_job *job, const lrcsi_proximity_pair *pair,
                       lrcsi_sides_fraction of, double *gain, double *loss)
{
    const lrcs_prepared *p = job->view->prepared;
    const uint32_t other = p->scene->facet_part[pair->other];
    const int both = p->proximity.hausdorff[other] > 0 && lrcsi_proximity_openings(p, other) > 0;
    const int up = job->view->facing[pair->other] > 0; /* its front is towards the laser */
    *gain = both ? of.front + of.back : (up ? of.back : of.front);
    *loss = up ? of.front : of.back;
}

/* Adds what of a facet on a known flat face is near a facet of another part that does not pierce
   the face, to gain_aligned and loss_aligned, for now, and to its sides (event_band.c, 6). */
static void add_face_pair(band_job *job, const lrcsi_proximity_pair *pair)
{
    const lrcs_prepared *p = job->view->prepared;
    const uint32_t part = p->scene->facet_part[pair->facet];
    const uint32_t other = p->scene->facet_part[pair->other];
    const unsigned border = lrcsi_face_border_sides(job->view, pair->facet);
    const double position_err = ldexp(p->scene->part[part].bounds.position_err, -p->exponent);
    const double slack =
        lrcsi_proximity_slack_aligned(p, other) + LRCSI_PROXIMITY_ERR + position_err;
    const double rim = lrcsi_proximity_slack(p, part, other) + 4 * p->proximity.reach[part];
    double gain = 1;
    double loss = 1;
    if (lrcsi_meter_take(job->meter, 1)) {
        pair_sides(job, pair, lrcsi_proximity_fractions(p, pair->facet, pair->other, slack), &gain,
                   &loss);
    }
    job->band->gain_aligned[pair->facet] += gain;
    job->band->loss_aligned[pair->facet] += loss;
    for (int k = 0; k < 3; k++) {
        if (((border >> k) & 1) != 0 &&
            !lrcsi_proximity_side_is_far(p, pair->facet, k, pair->other, rim)) {
            job->band->sides[pair->facet].side[k] = sides_near.side[k];
        }
    }
}

/* Adds the fraction of a facet for which it is not proved that a part is in front or behind; on a
   known flat face also to those of aligned points, and to its sides. */
static void add_unproved_pair(band_job *job, uint32_t facet, uint32_t other, double unproved,
                              int on_face)
{
    const double open = add_unproved(job, facet, other, unproved);
    if (open > 0 && on_face) {
        job->band->gain_aligned[facet] += open;
        job->band->loss_aligned[facet] += open;
        job->band->sides[facet] = sides_near;
    }
}

/* Adds the fractions near facets of other parts. Facets seen edge-on hide nothing, and the back
   sides of a closed part hide nothing that its front sides do not hide. The depth order of a flat
   facet and a part in front of its plane is certain. */
static void add_pairs(band_job *job)
{
    const lrcsi_view *view = job->view;
    const lrcs_prepared *p = view->prepared;
    for (size_t i = 0; i < p->proximity.count; i++) {
        const lrcsi_proximity_pair *pair = &p->proximity.pair[i];
        int facing = view->facing[pair->other];
        int closed = p->solid || p->scene->part[p->scene->facet_part[pair->other]].solid;
        uint32_t other = p->scene->facet_part[pair->other];
        double err;
        double unproved;
        if (facing == 0 || (facing < 0 && closed)) {
            continue;
        }
        const int on_face =
            is_on_known_face(job, pair->facet) && !pierces_face(job, pair->facet, other);
        if (lrcsi_part_is_behind(&job->bands.orders, pair->facet, other, &unproved) ||
            lrcsi_part_is_in_front(&job->bands.orders, pair->facet, other, &err, &unproved)) {
            add_unproved_pair(job, pair->facet, other, unproved, on_face);
            continue;
        }
        const lrcsi_sides_fraction of = {(double)pair->front_fraction, (double)pair->back_fraction};
        double gain;
        double loss;
        pair_sides(job, pair, of, &gain, &loss);
        if (p->scene->part[other].solid && faces_around(view, pair->other)) {
            gain = (double)pair->gain_fraction;
            loss = (double)pair->loss_fraction;
        }
        add_fractions(job->band, pair->facet, lrcsi_min(of.front + of.back, gain + loss), gain,
                      loss, lrcsi_part_set_of(other));
        add_rows(job->band, pair->facet,
                 (lrcsi_row_range){(double)pair->row_low, (double)pair->row_high});
        if (on_face) {
            add_face_pair(job, pair);
        }
    }
}

size_t lrcsi_proximity_band_need(const lrcs_prepared *p)
{
    if (!p->proximity.reach) {
        return 0;
    }
    size_t facets = p->scene->facet_count;
    size_t need = lrcsi_work_blocks(7, facets, sizeof(double));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_row_range)));
    need = lrcsi_work_add(need, lrcsi_work_blocks(2, facets, sizeof(lrcsi_part_set)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_near_sides)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_segment_part)));
    need = lrcsi_work_add(need, lrcsi_work_blocks(LRCSI_FACES_OF_PART, p->scene->part_count,
                                                  sizeof(lrcsi_face_margin)));
    need = lrcsi_work_add(need, lrcsi_event_bands_need(p));
    const size_t faces = lrcsi_face_margins_need(p); /* released before walls take memory */
    const size_t walls = lrcsi_wall_margins_need(p);
    need = lrcsi_work_add(need, faces > walls ? faces : walls);
    need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_wall_margin)));
    need = lrcsi_work_add(need, lrcsi_classify_facets_need(p));
    const size_t events = lrcsi_proximity_events_most(p);
    need = lrcsi_work_add(need, lrcsi_work_bytes(events, sizeof(lrcsi_edge_faces)));
    return lrcsi_work_add(need, lrcsi_near_events_need(p));
}

/* Completes the fractions of a facet beside the margins on its wall. Each is a sum of at most two
   terms for each event edge and one for each part. */
static void margin_finish(const lrcsi_proximity_band *band, uint32_t facet)
{
    lrcsi_wall_margin *margin = &band->margin[facet];
    margin->gain *= LRCSI_OUTWARD_MICRO;
    margin->loss *= LRCSI_OUTWARD_MICRO;
    if (band->parts[facet] == LRCSI_PART_SET_ALL) { /* not all edges were considered */
        margin->gain = margin->loss = 1;
    }
}

/* Computes all fractions:
   1. the events in a grid, and the depth order of parts (lrcsi_event_bands_make);
   2. margins on flat faces (lrcsi_face_margins_make); facets near those of other parts (add_pairs);
   3. for each facet that matters: event edges near it, with their margins on straight walls, and
      grazing incidence (meshlet_fractions);
   4. the fractions beside those margins; mismatch, gain, loss and rows are limited to 1.
      gain_aligned and loss_aligned may exceed it: their users compare the areas that they stand for
      with the facet's. */
static int all_fractions(band_job *job, lrcs_work *work)
{
    const lrcs_prepared *p = job->view->prepared;
    lrcsi_proximity_band *band = job->band;
    int status = lrcsi_event_bands_make(job->view, job->meter, work, &job->bands); /* 1 */
    if (status != LRCS_OK) {
        return status;
    }
    status = lrcsi_near_events_make(&job->bands, work, &job->near);
    job->faces = lrcsi_work_take(work, job->bands.events.count, sizeof *job->faces);
    job->unproved = lrcsi_work_take_zero(work, p->scene->facet_count, sizeof *job->unproved);
    if (status != LRCS_OK || !job->faces || !job->unproved) {
        return LRCS_E_MEMORY;
    }
    lrcsi_face_margins_make(&job->bands, band->classification, work, band->face, job->faces);
    job->curved = lrcsi_box_empty();
    for (uint32_t i = 0; i < p->scene->part_count; i++) {
        const lrcsi_box *box = &job->bands.box[i];
        if (p->proximity.reach[i] > 0 && box->low[0] <= box->high[0]) {
            lrcsi_box_add(&job->curved, box->low);
            lrcsi_box_add(&job->curved, box->high);
        }
    }
    status =
        lrcsi_wall_margins_make(&job->bands, band->classification, work, band->margin, &job->walls);
    if (status != LRCS_OK) {
        return status;
    }
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        band->row_range[f] = (lrcsi_row_range){1, 0};
        band->rim[f] = sides_free.side[0];
        band->sides[f] = is_on_known_face(job, f) ? sides_free : sides_near;
    }
    add_pairs(job); /* 2 */
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        band->gain_aligned[f] = is_on_known_face(job, f) ? band->gain_aligned[f] : -1;
    }
    for (uint32_t m = 0; m < p->meshlets.count; m++) { /* 3 */
        const uint32_t start = m * LRCSI_MESHLET_FACETS;
        meshlet_fractions(job, start, lrcsi_meshlet_end(start, p->scene->facet_count));
    }
    for (uint32_t f = 0; f < p->scene->facet_count; f++) { /* 4 */
        margin_finish(band, f);
        band->mismatch[f] = lrcsi_min(1, band->mismatch[f]);
        band->gain[f] = lrcsi_min(1, band->gain[f]);
        band->loss[f] = lrcsi_min(1, band->loss[f]);
        if (!(band->mismatch[f] < 1)) {
            band->rows[f] = 1;
            band->row_range[f] = (lrcsi_row_range){0, 1};
        }
        band->rows[f] = lrcsi_min(1, band->rows[f]);
    }
    lrcsi_wall_margins_finish(&job->walls);
    return LRCS_OK;
}

void lrcsi_proximity_band_join(const lrcsi_proximity_band *band, const unsigned char *candidate,
                               int alike, uint32_t *group)
{
    const lrcs_prepared *p = band->classification->view->prepared;
    const uint32_t *part = p->scene->facet_part;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        group[f] = f;
    }
    for (uint32_t e = 0; e < p->topology.edge_count; e++) {
        const lrcsi_edge_use *use = p->topology.use + p->topology.edge[e].first_use;
        for (uint32_t i = 1; i < p->topology.edge[e].uses; i++) {
            uint32_t a = use[i - 1].facet;
            uint32_t b = use[i].facet;
            int joined = candidate ? candidate[a] && candidate[b] &&
                                         (!alike || band->parts[a] == band->parts[b])
                                   : p->proximity.reach[part[a]] > 0 && band->mismatch[a] == 0 &&
                                         band->mismatch[b] == 0;
            if (part[a] == part[b] && joined) {
                lrcsi_disjoint_union(group, a, b);
            }
        }
    }
    lrcsi_disjoint_flatten(group, p->scene->facet_count);
}

int lrcsi_proximity_band_make(lrcsi_classification *classification, lrcsi_meter *meter,
                              lrcs_work *work, lrcsi_proximity_band *band)
{
    const lrcsi_view *view = classification->view;
    uint32_t facets = view->prepared->scene->facet_count;
    size_t mark = work->used;
    lrcsi_proximity_band m = {.classification = classification};
    lrcsi_classify_facets(classification, work);
    m.mismatch = lrcsi_work_take_zero(work, facets, sizeof *m.mismatch);
    m.gain = lrcsi_work_take_zero(work, facets, sizeof *m.gain);
    m.loss = lrcsi_work_take_zero(work, facets, sizeof *m.loss);
    m.rows = lrcsi_work_take_zero(work, facets, sizeof *m.rows);
    m.row_range = lrcsi_work_take(work, facets, sizeof *m.row_range);
    m.rows_open = lrcsi_work_take_zero(work, facets, sizeof *m.rows_open);
    m.gain_aligned = lrcsi_work_take_zero(work, facets, sizeof *m.gain_aligned);
    m.loss_aligned = lrcsi_work_take_zero(work, facets, sizeof *m.loss_aligned);
    m.sides = lrcsi_work_take(work, facets, sizeof *m.sides);
    m.rim = lrcsi_work_take(work, facets, sizeof *m.rim);
    m.face = lrcsi_work_take_zero(
        work, LRCSI_FACES_OF_PART * (size_t)view->prepared->scene->part_count, sizeof *m.face);
    m.margin = lrcsi_work_take(work, facets, sizeof *m.margin);
    m.parts = lrcsi_work_take_zero(work, facets, sizeof *m.parts);
    m.region = lrcsi_work_take(work, facets, sizeof *m.region);
    size_t kept = work->used;
    band_job job = {.view = view, .meter = meter, .band = &m};
    int status = m.mismatch && m.gain && m.loss && m.rows && m.row_range && m.rows_open &&
                         m.gain_aligned && m.loss_aligned && m.sides && m.rim && m.face &&
                         m.margin && m.parts && m.region
                     ? all_fractions(&job, work)
                     : LRCS_E_MEMORY;
    if (status != LRCS_OK) {
        work->used = mark;
        classification->facets = NULL; /* it was in this memory */
        return status;
    }
    work->used = kept;
    lrcsi_proximity_band_join(&m, NULL, 0, m.region);
    *band = m;
    return LRCS_OK;
}
