/* SPDX-License-Identifier: MIT */
/* Decides which event edges, and which sides of parts that pierce the plane of a flat face, have
   margins over this face alone, and adds the areas of these up.
   What the rest of the face may differ by is decided in visibility/proximity/event_band.c (6), and
   what the areas add to sigma in integrate/wall/flat_face.c. Terms and conditions are those of
   visibility/proximity/proximity_band.c; K, K' and k those of visibility/proximity/outline.h.

   The face of a part P: V is the true face, a disc, and U that of the facets, a regular polygon in
   the same plane; or both are the same rectangle, a plate or a face of a box. A point x of both is
   its own image: aligned with itself. So what that file proves in 1 holds for e_P = 0: another part
   R hides x if and only if its facets do, unless a facet of R is within the slack of x, or an event
   edge of R is in projection, and not far behind x.

   Let an event edge of Q, with ends a and b, L apart in projection, belong to a contour. Let w = 4
   (k + e), where e contains all errors of positions, and let N be the points within w of the edge
   in projection. Its margin is on the face alone if
   (a) N, projected onto the plane of the face, lies in U and V;
   (b) Q has an outline, and is in front of that plane (outline.c, 1), or a plane separates it, in
       front, from P (part_order.h): so it hides the points of the face in K, and its facets those
       in K', up to e in projection, and but for a small area of the face that is added to the
       error;
   (c) no event edge of a part other than P and Q comes within its slack of N in projection, unless
       it is behind the plane;
   (d) of Q, apart from rims inside K', only such other event edges meet N as follow one another
       from a or b on, until one ends farther than w from there. These lead away from the edge, at
       angles of at most A and B, less than 0.5 rad, to it;
   (e) within the slack of the plane, no facet of a part that is not in front of it as in (b) is in
       N in projection;
   (f) of one point of N beyond the edge, seen from the facets of Q, it is known whether the face is
       visible there.
   If that point is visible, so are all points of N beyond the edge, and those on its other side are
   hidden by Q alone, as far as the facets decide it: by (c) and (e) no other part begins or ceases
   to hide anything there, and by (d) the facets of Q do so only at the edge and, beyond the
   perpendiculars at its ends, at the edges that follow it. In truth no other part hides anything
   either, and Q hides the points of K. If the point is hidden, it is hidden by a part other than Q,
   whose outline ends at the edge, and P, which is convex. By (c) and (e) that part hides all of N,
   in truth and for the facets: the difference is 0.

   If the point is visible, K' begins at depth 0 over the edge, 0 <= t <= L in the coordinates of
   outline_area.c, 1, and K at a depth d(t) of at most w: K lies within k of K', and points of K'
   farther than k from its boundary lie in K, since otherwise a straight line separates such a point
   from K, and a point of K' is farther than k from that line. All points from depth d(t) to 1.2 k
   lie in K, among them those within k of the contour: N contains the point of K' at depth w above
   such a point, K a point within k of that, at depth 3 k or more; the line from there through a
   point y of depth at most 1.2 k leads to the polygon of outline_area.c within 2 k of y along the
   edge. So the true shapes leave visible the integral of d(t) more.

   Each point at which K and K' differ is attributed to the event edge of Q nearest to it. Near the
   end a that is not decided by the perpendicular. Such a point is at a depth y of at most D, the
   largest |d(t)| for |t| <= 2 k, and within k of the contour, so that y <= k / cos A. Of the points
   inside the perpendicular, at a distance x from it, some are nearer than to the edge to a point of
   the edges that follow, r away from a at an angle of at most A to the edge's direction:
   (x + r cos A)^2 + (y - r sin A)^2 < y^2. As r^2 + x^2 >= 2 r x, these have x < y tan(A / 2). Of
   the points outside it, those to which a is the nearest point of all are at most y tan A from it.
   Both regions together have an area of at most y^2 (tan(A / 2) + tan A) / 2, below 0.81 y^2 A;
   likewise for b.

   The conditions may hold for a part of an edge only. Such a part counts as an edge if it begins at
   a, or at least w from there, and ends likewise: what is left of the edge follows it, at an angle
   of 0. The other parts, the gaps, count as edges of which nothing is known: along these, what the
   true shapes leave visible more is between the loss and the gain of outline_area.c, 1, no deeper
   than the depths of the whole edge, nor than k. Parts farther than w from both U and V matter to
   no point of the face.

   A closed part Q may also pierce the plane, if it reaches far enough in front of it. K and K' are
   then those of its part in front (outline.c, 1), and so is k. K' is a convex polygon, the sides of
   which take the place of the event edges of Q in (d), and all that was said of these: one side
   follows another. Points at which K and K' differ are attributed to the nearest side. (e) is not
   required of Q itself. The sides contain all that Q hides of the face, so that neither its event
   edges nor the distances of its facets from the face count any more (event_band.c, 6). Along the
   border of the face Q hides all or nothing, in truth and for its facets, where no event edge of it
   is near, because sides of K' that lie in the plane have to be farther than 8 k + 4 e_P from the
   border; a rectangle has no such border. */
#include "visibility/proximity/face_margin.h"

#include <math.h>

#include "base/constant.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/vec3.h"
#include "base/work.h"
#include "visibility/proximity/cut_polygon.h"
#include "visibility/proximity/edge_margin.h"
#include "visibility/uniform/query.h"

/* Directions in the view plane, at most 12 degrees apart, along which parts are measured. */
#define DIRECTIONS 16
static const double face_direction[DIRECTIONS][2] = {
    {1, 0}, {5, 1},  {5, 2},  {3, 2},  {1, 1},  {2, 3},  {2, 5},  {1, 5},
    {0, 1}, {-1, 5}, {-2, 5}, {-2, 3}, {-1, 1}, {-3, 2}, {-5, 2}, {-5, 1}};

/* Another part, beside the plane of a face. */
typedef struct face_part {
    int in_front;     /* 1: it is in front as in (b) */
    double order_err; /* within this, in projection, that is not known; 0 if it is not in front */
    double unproved;  /* an area of the face, in projection, for which it is not known either */
    double low[DIRECTIONS], high[DIRECTIONS]; /* along these: around its facets near the plane, for
                                                 (e); empty if it is in front */
} face_part;

/* The coordinate of a point of the view plane along a direction. */
static double along_direction(int k, const double x[2])
{
    return face_direction[k][0] * x[0] + face_direction[k][1] * x[1];
}

/* At least what a distance in the view plane is along a direction. */
static double distance_along(int k, double distance)
{
    return distance * (fabs(face_direction[k][0]) + fabs(face_direction[k][1]));
}

/* What the laser sees of a face beyond an end of an edge. */
typedef struct end_answer {
    uint32_t face, part; /* the face, and the part with the edge; LRCS_NONE: not known */
    int answer;          /* visibility/uniform/query.h */
} end_answer;

typedef struct face_job {
    lrcsi_event_bands *bands;
    const lrcsi_classification *classification;
    lrcs_work *work;
    lrcsi_face_frame face;
    face_part *part;            /* of each part */
    uint32_t *near, near_count; /* the parts with facets near the plane, for (e) */
    end_answer *beyond;         /* of each vertex, or of the first corners of a polygon */
    double order_err;           /* the largest of any part */
    int parts_known;
} face_job;

/* --- the parts beside the plane of a face ----------------------------------------------------- */

/* Makes the extent of a part from `low` to -low in all directions. */
static void face_part_limit(face_part *part, double low)
{
    for (int k = 0; k < DIRECTIONS; k++) {
        part->low[k] = low;
        part->high[k] = -low;
    }
}

/* Grows a part's extent by what of a facet is within `slack` of the plane of the face. */
static void face_part_add(const face_job *job, uint32_t facet, double slack, face_part *part)
{
    const double *up = job->face.up;
    const lrcsi_view *view = job->bands->view;
    const lrcs_prepared *p = view->prepared;
    const double *const corner[3] = {lrcsi_prepared_corner(p, facet, 0),
                                     lrcsi_prepared_corner(p, facet, 1),
                                     lrcsi_prepared_corner(p, facet, 2)};
    double height[3];
    for (int k = 0; k < 3; k++) {
        double from[3];
        lrcsi_vec3_between(job->face.centre, corner[k], from);
        height[k] = lrcsi_vec3_dot(from, up);
    }
    if (lrcsi_min3(height[0], height[1], height[2]) > slack ||
        lrcsi_max3(height[0], height[1], height[2]) < -slack) {
        return;
    }
    lrcsi_slice slice = lrcsi_slice_start(corner[0], corner[1], corner[2]);
    lrcsi_slice_cut_between(&slice, up, job->face.centre, job->face.centre, slack);
    for (int i = 0; i < slice.count; i++) {
        double x[3];
        lrcsi_view_coordinates(view, slice.x[i], x);
        for (int k = 0; k < DIRECTIONS; k++) {
            const double at = along_direction(k, x);
            part->low[k] = lrcsi_min(part->low[k], at - distance_along(k, slack));
            part->high[k] = lrcsi_max(part->high[k], at + distance_along(k, slack));
        }
    }
}

/* The slack of a part's facets near the plane of the face, doubled, which contains all errors. */
static double plane_slack(const face_job *job, uint32_t part)
{
    return 2 * lrcsi_proximity_slack(job->bands->view->prepared, job->face.part, part) +
           64 * LRCSI_PROXIMITY_ERR;
}

/* Is all of a part farther from the plane than this slack? */
static int part_is_far(const face_job *job, uint32_t index)
{
    const double *up = job->face.up;
    const lrcsi_body *bodies = job->bands->orders.body;
    if (!bodies) {
        return 0;
    }
    const lrcsi_body *body = &bodies[index];
    const double down[3] = {-up[0], -up[1], -up[2]};
    const double level = lrcsi_vec3_dot(job->face.centre, up);
    const double wide = plane_slack(job, index) + body->err;
    return level - lrcsi_body_support_all(body, up) > wide ||
           -lrcsi_body_support_all(body, down) - level > wide;
}

/* Fills job->part. Where the limit of steps is reached, facets are near everywhere. */
static void face_parts_make(face_job *job)
{
    lrcsi_event_bands *bands = job->bands;
    const lrcs_prepared *p = bands->view->prepared;
    const lrcs_scene *scene = p->scene;
    const int counted = lrcsi_meter_take(bands->meter, scene->part_count);
    job->order_err = 0;
    job->near_count = 0;
    for (uint32_t i = 0; i < scene->part_count; i++) {
        const lrcs_part *part = &scene->part[i];
        const lrcsi_outline *outline = &bands->orders.outline[i];
        face_part *beside = &job->part[i];
        *beside = (face_part){.in_front = 0};
        face_part_limit(beside, HUGE_VAL);
        if (i == job->face.part || lrcsi_face_part_is_beside(bands, &job->face, i)) {
            continue;
        }
        beside->in_front = counted && outline->known &&
                           lrcsi_outline_in_front(outline, bands->view, job->face.facet,
                                                  job->face.plane_err, &beside->order_err);
        beside->order_err = beside->in_front ? beside->order_err : 0;
        if (counted && outline->known && !beside->in_front) {
            beside->in_front =
                lrcsi_face_part_is_separated_in_front(bands, &job->face, i, &beside->unproved);
        }
        job->order_err = lrcsi_max(job->order_err, beside->order_err);
        if (beside->in_front || part_is_far(job, i)) {
            continue;
        }
        if (!lrcsi_meter_take(bands->meter, part->facet_count)) {
            face_part_limit(beside, -HUGE_VAL);
            job->near[job->near_count++] = i;
            continue;
        }
        const double slack = plane_slack(job, i);
        for (uint32_t f = part->first_facet; f < part->first_facet + part->facet_count; f++) {
            if (!p->skip[f]) {
                face_part_add(job, f, slack, beside);
            }
        }
        if (beside->low[0] <= beside->high[0]) {
            job->near[job->near_count++] = i;
        }
    }
    job->parts_known = 1;
}

/* --- one event edge --------------------------------------------------------------------------- */

/* Returns 0 if the edge is not over the face, or (b) does not hold. */
static int face_edge_make(face_job *job, uint32_t event, lrcsi_edge_margin *m)
{
    lrcsi_event_bands *bands = job->bands;
    const lrcsi_view *view = bands->view;
    const uint32_t part = bands->events.part[event];
    const lrcsi_edge *edge = &view->prepared->topology.edge[bands->events.edge[event]];
    if (part == job->face.part || bands->events.side[event] == 0 ||
        lrcsi_segment_part_is_empty(lrcsi_face_segment_inside(&job->face, view->point[edge->low].x,
                                                              view->point[edge->high].x, 0))) {
        return 0;
    }
    if (!job->parts_known) {
        face_parts_make(job);
    }
    const face_part *beside = &job->part[part];
    return beside->in_front && lrcsi_edge_margin_make(bands, &bands->orders.outline[part], event,
                                                      job->face.part, beside->order_err, m);
}

/* --- what else is near ------------------------------------------------------------------------ */

/* Adds the parts of an edge near which (e) does not hold. */
static void parts_add_gaps(face_job *job, const lrcsi_edge_margin *m, lrcsi_edge_gaps *gaps)
{
    const double wide = m->width + m->err;
    if (!lrcsi_meter_take(job->bands->meter, job->near_count)) {
        lrcsi_edge_gaps_add(gaps, (lrcsi_segment_part){0, 1});
    }
    for (uint32_t i = 0; i < job->near_count && !lrcsi_edge_gaps_are_all(gaps); i++) {
        const face_part *part = &job->part[job->near[i]];
        lrcsi_segment_part near = {0, 1};
        if (job->near[i] == m->part) {
            continue;
        }
        for (int k = 0; k < DIRECTIONS && !lrcsi_segment_part_is_empty(near); k++) {
            const double a = along_direction(k, m->a);
            const double b = along_direction(k, m->b);
            lrcsi_segment_part_limit(&near, a, b, part->high[k] + distance_along(k, wide));
            lrcsi_segment_part_limit(&near, -a, -b, distance_along(k, wide) - part->low[k]);
        }
        if (!lrcsi_segment_part_is_empty(near)) {
            lrcsi_edge_gaps_add(gaps, near);
        }
    }
}

/* May a facet cover a point of the view plane? A cross product is compared with a small number only
   to choose facets for an exact test. */
static int facet_may_cover(const lrcsi_view *view, uint32_t facet, const double x[2])
{
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    int covers = 1;
    for (int k = 0; k < 3 && covers; k++) {
        const double *a = view->point[corner[k]].x;
        const double *b = view->point[corner[(k + 1) % 3]].x;
        covers =
            (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]) > -LRCSI_PROXIMITY_ERR;
    }
    return covers;
}

/* (f): an answer of visibility/uniform/query.h for the point half of w beyond the middle of the
   edge. */
static int margin_visibility(face_job *job, const lrcsi_edge_margin *m)
{
    const lrcsi_view *view = job->bands->view;
    const lrcsi_grid *facets = job->classification->facets;
    double x[2];
    double at[2];
    double point[3];
    if (!facets) {
        return LRCSI_QUERY_NO_ANSWER;
    }
    for (int i = 0; i < 2; i++) {
        x[i] = 0.5 * (m->a[i] + m->b[i]) + 0.5 * m->width * m->outward[i];
    }
    lrcsi_face_coordinates(&job->face, x, at);
    for (int k = 0; k < 3; k++) {
        point[k] =
            job->face.centre[k] + at[0] * job->face.plane[0][k] + at[1] * job->face.plane[1][k];
    }
    const double here[3] = {x[0], x[1], 0};
    const lrcsi_view_box box = lrcsi_view_box_round(view, here, here);
    lrcsi_grid_rect buckets = lrcsi_grid_buckets(facets, &box);
    lrcsi_grid_items items;
    int answer = LRCSI_QUERY_NO_ANSWER;
    while (lrcsi_grid_next_row(facets, &buckets, &items)) {
        const int counted = lrcsi_meter_take(job->bands->meter, (uint64_t)items.to - items.from);
        for (uint32_t i = items.from; i < items.to && counted; i++) {
            const uint32_t f = facets->item[i];
            if (lrcsi_face_of(view, f) == job->face.number && facet_may_cover(view, f, x) &&
                answer == LRCSI_QUERY_NO_ANSWER) {
                answer = lrcsi_query_point(facets, f, point, job->bands->meter);
            }
        }
    }
    return answer;
}

/* Where to note the answer beyond an end of a free part; NULL if it does not end with its edge. */
static end_answer *answer_beyond(const face_job *job, const lrcsi_edge_part *free, int end)
{
    const uint32_t at = free->margin.end[end];
    const int ends = end == 0 ? free->of.from <= 0 : free->of.to >= 1;
    return ends && at < job->bands->view->prepared->scene->vertex_count ? &job->beyond[at] : NULL;
}

/* (f) for a free part of an edge. If it ends in a point q where the free part of another edge does,
   one answer holds for both: the point half of w beyond the other edge at q is in N of both, and on
   the outer side of both and of all edges that follow, since these turn by less than 0.5 rad. */
static int part_visibility(face_job *job, const lrcsi_edge_part *free)
{
    const uint32_t part = free->margin.part;
    end_answer *at[2] = {answer_beyond(job, free, 0), answer_beyond(job, free, 1)};
    int answer = LRCSI_QUERY_NO_ANSWER;
    for (int k = 0; k < 2; k++) {
        if (at[k] && at[k]->face == job->face.number && at[k]->part == part) {
            answer = at[k]->answer;
        }
    }
    if (answer == LRCSI_QUERY_NO_ANSWER) {
        answer = margin_visibility(job, &free->margin);
    }
    for (int k = 0; k < 2; k++) {
        if (at[k]) {
            *at[k] = (end_answer){job->face.number, part, answer};
        }
    }
    return answer;
}

/* --- all faces -------------------------------------------------------------------------------- */

/* What the true shapes leave visible of the face along an edge or a part of it, less what their
   facets leave: the area, and a bound on its error. */
typedef struct face_area {
    double area, error;
} face_area;

/* Where nothing is known, that is between the loss and the gain of outline_area.c. Of a part of the
   edge its depths tell: a loss may be 2 k beyond its ends. */
static face_area unknown_area(const face_job *job, const lrcsi_edge_margin *m,
                              lrcsi_segment_part part)
{
    if (!(part.from < part.to)) {
        return (face_area){0, 0};
    }
    const lrcsi_outline_areas whole =
        m->event == LRCS_NONE ? lrcsi_outline_areas_make(m->outline, m->a, m->b, m->side)
                              : job->bands->areas[m->event];
    const double k = m->outline->k + m->err;
    const double shift = LRCSI_ROOT_2_OUTWARD * m->order_err + m->err;
    const double length = (part.to - part.from) * m->length + 2 * m->err;
    const double gain = lrcsi_min(whole.gain + whole.width * m->order_err,
                                  length * (lrcsi_min(whole.gain_depth, k) + shift));
    const double loss = lrcsi_min(whole.loss + whole.width * m->order_err,
                                  (length + 4 * k) * (lrcsi_min(whole.loss_depth, k) + shift));
    return (face_area){0.5 * (gain - loss), 0.5 * (gain + loss) * LRCSI_OUTWARD_NANO};
}

/* Is the area along an edge or a part of it, near which nothing else is, known with its sign? It is
   the signed area between the outlines, or 0 if the face is hidden there. */
static int signed_area(face_job *job, const lrcsi_edge_part *free, face_area *found)
{
    const lrcsi_edge_margin *m = &free->margin;
    const int visibility = part_visibility(job, free);
    *found = (face_area){0, 0};
    if (visibility == LRCSI_QUERY_VISIBLE) {
        const lrcsi_outline_margin margin =
            lrcsi_outline_margin_make(m->outline, m->a, m->b, m->side, 0, 1);
        found->area = margin.area;
        found->error = margin.error + 2 * m->err * margin.width +
                       lrcsi_edge_margin_end(m, margin.end_depth[0], free->turn[0]) +
                       lrcsi_edge_margin_end(m, margin.end_depth[1], free->turn[1]);
    }
    return visibility != LRCSI_QUERY_NO_ANSWER && isfinite(found->error);
}

static void area_add(face_area *sum, face_area one)
{
    sum->area += one.area;
    sum->error += (one.error + 8 * LRCSI_U * fabs(sum->area)) * LRCSI_OUTWARD_NANO;
}

/* The area along an edge over the face, near which no other one of its part is, but for these gaps.
   Where nothing else is near either, it is known with its sign; what lies farther than w from the
   face does not count. */
static face_area edge_area(face_job *job, const lrcsi_edge_margin *m, lrcsi_edge_gaps *gaps,
                           double turn[2])
{
    const lrcsi_margin_receiver receiver = {job->face.part, job->face.facet, &job->face,
                                            job->order_err};
    lrcsi_segment_part left = lrcsi_face_segment_near(&job->face, m->a, m->b, m->width);
    face_area sum = {0, 0};
    if (lrcsi_segment_part_is_empty(left)) {
        return sum;
    }
    lrcsi_edge_gaps_add_outside(gaps, lrcsi_face_segment_inside(&job->face, m->a, m->b, m->width));
    parts_add_gaps(job, m, gaps);
    if (!lrcsi_edge_gaps_are_all(gaps)) {
        lrcsi_edge_margin_find_gaps(job->bands, m, &receiver, gaps, turn);
    }
    for (int i = 0; i <= gaps->count; i++) {
        lrcsi_edge_part free;
        face_area found;
        if (lrcsi_edge_margin_part(m, gaps, i, turn, &free) && signed_area(job, &free, &found)) {
            area_add(&sum, found);
            area_add(&sum, unknown_area(job, m, (lrcsi_segment_part){left.from, free.of.from}));
            left.from = free.of.to;
        }
    }
    area_add(&sum, unknown_area(job, m, left));
    return sum;
}

/* Notes that one more face includes the margin of an event edge, unless too many do. */
static int edge_faces_add(lrcsi_edge_faces *faces, uint32_t face)
{
    int i = 0;
    while (i < LRCSI_EDGE_FACES && faces->face[i] != LRCS_NONE) {
        i++;
    }
    if (i == LRCSI_EDGE_FACES) {
        return 0;
    }
    faces->face[i] = face;
    return 1;
}

/* Adds the areas along all event edges over the face. An edge may be listed in several buckets. */
static void face_add(face_job *job, lrcsi_face_margin *face, lrcsi_edge_faces *faces)
{
    const lrcsi_event_bands *bands = job->bands;
    const lrcsi_grid *grid = &bands->events.grid;
    const lrcsi_face_frame *at = &job->face;
    double low[3] = {0, 0, 0};
    double high[3] = {0, 0, 0};
    face_area sum = {0, 0};
    for (int k = 0; k < 2; k++) {
        const double wide = lrcsi_face_extent(at, k);
        low[k] = at->view[k] - wide;
        high[k] = at->view[k] + wide;
    }
    const lrcsi_view_box box = lrcsi_view_box_round(bands->view, low, high);
    lrcsi_grid_rect buckets = lrcsi_grid_buckets(grid, &box);
    lrcsi_grid_items items;
    while (lrcsi_grid_next_row(grid, &buckets, &items)) {
        if (!lrcsi_meter_take(bands->meter, (uint64_t)1 + items.to - items.from)) {
            return;
        }
        for (uint32_t i = items.from; i < items.to; i++) {
            const uint32_t event = grid->item[i];
            lrcsi_edge_margin m;
            if (!lrcsi_edge_faces_hold(&faces[event], job->face.number) &&
                face_edge_make(job, event, &m) && edge_faces_add(&faces[event], job->face.number)) {
                lrcsi_edge_gaps gaps = {.count = 0};
                double turn[2] = {0, 0};
                area_add(&sum, edge_area(job, &m, &gaps, turn));
                *face = (lrcsi_face_margin){1, sum.area, sum.error,
                                            face->causes | lrcsi_part_set_of(m.part), 0};
            }
        }
    }
}

/* The area along all sides of the polygon of a part that pierces the face. Returns 0 if it is not
   known. */
static int cut_area(face_job *job, uint32_t part, face_area *sum)
{
    lrcsi_event_bands *bands = job->bands;
    const lrcs_prepared *p = bands->view->prepared;
    lrcsi_outline cut;
    lrcsi_cut_polygon polygon;
    double order_err;
    if (!lrcsi_outline_cut(&bands->orders.outline[part], bands->view, job->face.facet,
                           job->face.plane_err, &cut, &order_err)) {
        return 0;
    }
    const size_t mark = job->work->used;
    const double wide =
        8 * cut.k + 4 * p->proximity.reach[job->face.part] + 64 * LRCSI_PROXIMITY_ERR;
    const int known = lrcsi_cut_polygon_make(bands, part, &job->face, wide, job->work, &polygon) &&
                      lrcsi_meter_take(bands->meter, polygon.count);
    *sum = (face_area){0, 0};
    for (uint32_t i = 0; known && i < polygon.count; i++) {
        const uint32_t next = (i + 1) % polygon.count;
        lrcsi_edge_margin m;
        if (lrcsi_edge_margin_make_side(&cut, part, polygon.corner[i], polygon.corner[next],
                                        order_err, &m)) {
            m.end[0] = i;
            m.end[1] = next;
            lrcsi_edge_gaps gaps = {.count = 0};
            double turn[2];
            lrcsi_cut_polygon_find_gaps(&polygon, i, &m, &gaps, turn);
            area_add(sum, edge_area(job, &m, &gaps, turn));
        } else {
            area_add(sum, unknown_area(job, &m, (lrcsi_segment_part){0, 1}));
        }
    }
    job->work->used = mark;
    return known && isfinite(sum->area + sum->error);
}

/* May a part other than the face's have margins on it? */
static int part_has_margins(const face_job *job, uint32_t part)
{
    return part != job->face.part && job->bands->orders.outline[part].known &&
           !lrcsi_face_part_is_beside(job->bands, &job->face, part);
}

/* Adds the areas along the outlines of parts that pierce the face. */
static void face_add_cut(face_job *job, lrcsi_face_margin *face)
{
    const lrcs_prepared *p = job->bands->view->prepared;
    for (uint32_t i = 0; i < p->scene->part_count && i < LRCSI_PART_SET_SINGLE; i++) {
        face_area sum = {face->area, face->error};
        face_area one;
        if (!part_has_margins(job, i) || part_is_far(job, i)) {
            continue;
        }
        if (!job->parts_known) {
            face_parts_make(job);
        }
        if (!job->part[i].in_front && cut_area(job, i, &one)) {
            area_add(&sum, one);
            *face = (lrcsi_face_margin){1, sum.area, sum.error, face->causes | lrcsi_part_set_of(i),
                                        face->cut | lrcsi_part_set_of(i)};
        }
    }
}

/* Adds the areas for which it is not proved that parts are in front. */
static void face_add_unproved(const face_job *job, lrcsi_face_margin *face)
{
    const uint32_t parts = job->bands->view->prepared->scene->part_count;
    for (uint32_t i = 0; i < parts && job->parts_known; i++) {
        face->error += job->part[i].unproved * LRCSI_OUTWARD_NANO;
    }
}

/* May a face have margins? */
static int face_has_margins(const face_job *job)
{
    const uint32_t parts = job->bands->view->prepared->scene->part_count;
    int has = 0;
    for (uint32_t i = 0; i < parts && !has; i++) {
        has = part_has_margins(job, i);
    }
    return has;
}

size_t lrcsi_face_margins_need(const lrcs_prepared *p)
{
    size_t need = lrcsi_work_add(lrcsi_work_bytes(p->scene->part_count, sizeof(face_part)),
                                 lrcsi_work_bytes(p->scene->part_count, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->scene->vertex_count, sizeof(end_answer)));
    return lrcsi_work_add(need, lrcsi_cut_polygon_need(p));
}

void lrcsi_face_margins_make(lrcsi_event_bands *bands, const lrcsi_classification *classification,
                             lrcs_work *work, lrcsi_face_margin *face, lrcsi_edge_faces *faces)
{
    const lrcs_scene *scene = bands->view->prepared->scene;
    const lrcsi_edge_faces none = {{LRCS_NONE, LRCS_NONE, LRCS_NONE, LRCS_NONE}};
    const size_t mark = work->used;
    face_job job = {.bands = bands, .classification = classification, .work = work};
    job.part = lrcsi_work_take(work, scene->part_count, sizeof *job.part);
    job.near = lrcsi_work_take(work, scene->part_count, sizeof *job.near);
    job.beyond = lrcsi_work_take(work, scene->vertex_count, sizeof *job.beyond);
    for (uint32_t i = 0; i < scene->vertex_count && job.beyond; i++) {
        job.beyond[i].face = LRCS_NONE;
    }
    for (uint32_t i = 0; i < bands->events.count; i++) {
        faces[i] = none;
    }
    for (uint32_t i = 0; i < LRCSI_FACES_OF_PART * scene->part_count; i++) {
        const int is_box = scene->part[i / LRCSI_FACES_OF_PART].kind == LRCS_SHAPE_BOX;
        face[i] = (lrcsi_face_margin){.known = 0};
        job.parts_known = 0;
        if (!job.part || !job.near || !job.beyond || !(is_box || i % LRCSI_FACES_OF_PART == 0) ||
            !lrcsi_face_frame_make(bands, i, &job.face)) {
            continue;
        }
        face[i].known = !job.face.is_rectangle; /* aligned points serve it without margins, too */
        if (face_has_margins(&job)) {
            face_add(&job, &face[i], faces);
            face_add_cut(&job, &face[i]);
            face_add_unproved(&job, &face[i]);
        }
    }
    work->used = mark;
}
