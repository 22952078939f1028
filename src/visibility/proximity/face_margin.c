/* SPDX-License-Identifier: MIT */
/* Decides which event edges have margins over one flat face alone, and adds the areas of these up.
   What the rest of the face may differ by is decided in visibility/proximity/event_band.c (6), and
   what the areas add to sigma in integrate/wall/flat_face.c. Terms and conditions are those of
   visibility/proximity/proximity_band.c; K, K' and k those of visibility/proximity/outline.h.

   The face of a part P: V is the true face, a disc, and U that of the facets, a regular polygon in
   the same plane. A point x of both is its own image: aligned with itself. So what that file proves
   in 1 holds for e_P = 0: another part R hides x if and only if its facets do, unless a facet of R
   is within the slack of x, or an event edge of R is in projection, and not far behind x.

   Let an event edge of Q, with ends a and b, L apart in projection, belong to a contour. Let w = 4
   (k + e), where e contains all errors of positions, and let N be the points within w of the edge
   in projection. Its margin is on the face alone if
   (a) N, projected onto the plane of the face, lies in U and V;
   (b) Q has an outline, and is in front of that plane (outline.c, 1): so it hides the points of the
       face in K, and its facets those in K', up to e in projection;
   (c) no event edge of a part other than P and Q comes within its slack of N in projection, unless
       it is behind the plane;
   (d) of Q, only two other event edges meet N, apart from rims inside K'. They begin at a and b,
       are longer than w, and lead away from the edge: they turn by A and B, less than 0.5 rad;
   (e) within the slack of the plane, no facet of a part that is not in front of it as in (b) is in
       N in projection;
   (f) at one point of N beyond the edge, seen from the facets of Q, the face is visible.
   Then the points of N beyond the edge are visible, and those on its other side hidden by Q alone,
   as far as the facets decide it: by (c) and (e) no other part begins or ceases to hide anything
   there, and by (d) the facets of Q do so only at the edge and, beyond the perpendiculars at its
   ends, at those two. In truth no other part hides anything either, and Q hides the points of K.

   So over the edge, 0 <= t <= L in the coordinates of outline.c, 2, K' begins at depth 0, and K at
   a depth d(t) of at most w: K lies within k of K', and points of K' farther than k from its
   boundary lie in K, since otherwise a straight line separates such a point from K, and a point of
   K' is farther than k from that line. Above d(t) all points up to depth k lie in K: N contains the
   point of K' at depth w above such a point, K a point within k of that, at depth 3 k or more; the
   line from there through a point y of depth at most k leads to the polygon of outline.c within 2 k
   of y along the edge. So the true shapes leave visible the integral of d(t) more.

   Each point at which K and K' differ counts to the event edge of Q nearest to it. Near the end a
   that is not decided by the perpendicular but, inside K', by the bisector of the two edges, and
   outside by where both are equally near: the regions between these and the perpendicular, up to a
   distance of 2 k, have areas of at most 2 k^2 tan(A / 2) and 2 k^2 A. 4 k^2 A exceeds both
   together; likewise for b. */
#include "visibility/proximity/face_margin.h"

#include <math.h>

#include "base/outward.h"
#include "base/range.h"
#include "base/vec3.h"
#include "base/work.h"
#include "mesh/shape/revolution.h"
#include "visibility/uniform/query.h"

/* The least cosine of the face's incidence. A heuristic, so that distances in the plane follow from
   those in projection. */
#define FACE_COS_MIN 0.02
/* An edge is used only if it is longer than this many widths w. */
#define LENGTH_MIN_WIDTHS 2.0
/* The sine of the largest turn between neighbouring event edges: below that of 0.5. An angle below
   0.5 is at most 1.05 times its sine. */
#define TURN_SINE_MAX   0.47
#define ANGLE_OVER_SINE 1.05

/* A part's face in the view. */
typedef struct flat_face {
    uint32_t part, facet;       /* one of its facets */
    double centre[3], radius;   /* of a circle in U and V; scaled */
    double view[2], axis[2][2]; /* the centre and the part's x and y axes in projection */
    double det;                 /* of these axes */
} flat_face;

/* The box in projection around the facets of a part that are near the plane of a face. */
typedef struct near_box {
    double low[2], high[2];
} near_box;

typedef struct face_job {
    lrcsi_event_bands *bands;
    lrcsi_classification *classification;
    lrcs_work *work;
    lrcsi_grid facets; /* for queries about the faces' facets; made when first needed */
    int facets_tried, facets_made;
    flat_face face;
    near_box *near; /* of each part */
    int near_known;
} face_job;

/* An event edge: its ends, the distance w; the part with its outline. */
typedef struct edge_margin {
    uint32_t event;
    const lrcsi_edge *edge;
    const lrcsi_outline *outline;
    const double *a, *b;
    double length, along[2], outward[2]; /* outward: away from the facets of Q */
    double contact;                      /* (b): what it leaves open in projection */
    double err, width;                   /* e; w */
} edge_margin;

int lrcsi_face_margin_holds(const lrcsi_view *view, uint32_t facet)
{
    const lrcs_prepared *p = view->prepared;
    const lrcs_part *part = &p->scene->part[p->scene->facet_part[facet]];
    return view->facing[facet] > 0 && p->scene->facet_smooth[facet] == 0 && part->rigid &&
           part->kind >= 0 && !lrcsi_shape_is_plane_faced(part->kind) && part->bounds.reach > 0 &&
           (part->solid || part->kind == LRCS_SHAPE_DISC);
}

unsigned lrcsi_face_margin_sides(const lrcsi_view *view, uint32_t facet)
{
    const lrcs_prepared *p = view->prepared;
    unsigned sides = 0;
    for (unsigned k = 0; k < 3; k++) {
        const uint32_t other = p->neighbours.facet[facet].corner[k];
        if (other >= p->scene->facet_count || other == facet ||
            p->scene->facet_part[other] != p->scene->facet_part[facet] ||
            !lrcsi_face_margin_holds(view, other)) {
            sides |= 1u << k;
        }
    }
    return sides;
}

/* Is every open curved part in front of a facet's part or of its plane, or behind it, for all of
   the facet? */
static int open_parts_are_ordered(lrcsi_part_orders *orders, uint32_t facet)
{
    const lrcs_prepared *p = orders->view->prepared;
    int ordered = 1;
    for (uint32_t i = 0; i < p->scene->part_count && ordered; i++) {
        double err;
        double unproved = 0;
        ordered = i == p->scene->facet_part[facet] || !(p->proximity.hausdorff[i] > 0) ||
                  lrcsi_proximity_openings(p, i) == 0 ||
                  ((lrcsi_part_is_in_front(orders, facet, i, &err, &unproved) ||
                    lrcsi_part_is_behind(orders, facet, i, &unproved)) &&
                   unproved == 0);
    }
    return ordered;
}

/* The face of a part. Returns 0 if there is none, or it is seen too obliquely, or one of its facets
   hides nothing (another takes its place). */
static int flat_face_make(lrcsi_part_orders *orders, uint32_t index, flat_face *face)
{
    const lrcsi_view *view = orders->view;
    const lrcs_prepared *p = view->prepared;
    const lrcs_part *part = &p->scene->part[index];
    double from[3];
    double x[3];
    *face = (flat_face){.part = index, .facet = LRCS_NONE};
    for (uint32_t f = part->first_facet; f < part->first_facet + part->facet_count; f++) {
        if (lrcsi_face_margin_holds(view, f)) {
            face->facet = f;
            if (p->skip[f] || p->redundant[f] != LRCSI_NOT_REDUNDANT ||
                !open_parts_are_ordered(orders, f)) {
                return 0;
            }
        }
    }
    if (face->facet == LRCS_NONE) {
        return 0;
    }
    const lrcsi_revolution body = lrcsi_revolution_make(&part->shape, &part->divisions);
    const double unit = ldexp(part->unit, -p->exponent);
    for (int k = 0; k < 3; k++) {
        face->centre[k] = ldexp(part->origin[k], -p->exponent);
    }
    lrcsi_vec3_between(face->centre, lrcsi_prepared_corner(p, face->facet, 0), from);
    double height = lrcsi_vec3_dot(from, part->axis[2]);
    for (int k = 0; k < 3; k++) {
        face->centre[k] += height * part->axis[2][k];
    }
    lrcsi_view_coordinates(view, face->centre, x);
    for (int i = 0; i < 2; i++) {
        face->view[i] = x[i];
        for (int k = 0; k < 2; k++) {
            face->axis[k][i] = lrcsi_vec3_dot(view->R[i], part->axis[k]);
        }
    }
    /* the sides of U are at least this far from its centre, since cos h >= 1 - h^2 / 2 */
    int is_top = body.zones > 0 && fabs(height) > 0.5 * body.height * unit;
    face->radius = (is_top ? body.top : body.base) * unit *
                   lrcsi_min(1, body.vertex_ratio * (1 - 0.5 * body.half * body.half));
    face->det = face->axis[0][0] * face->axis[1][1] - face->axis[0][1] * face->axis[1][0];
    return fabs(face->det) > FACE_COS_MIN;
}

/* The coordinates in the plane of the face, along the part's x and y axes, of a point of the view
   plane. */
static void face_coordinates(const flat_face *face, const double x[2], double at[2])
{
    const double from[2] = {x[0] - face->view[0], x[1] - face->view[1]};
    at[0] = (from[0] * face->axis[1][1] - from[1] * face->axis[1][0]) / face->det;
    at[1] = (from[1] * face->axis[0][0] - from[0] * face->axis[0][1]) / face->det;
}

/* Is a point of the view plane in the face, and all within a distance of it? The projection makes
   no distance in the plane smaller than |det| times itself. */
static int face_contains(const flat_face *face, const double x[2], double distance)
{
    double at[2];
    face_coordinates(face, x, at);
    double wide = (distance + LRCSI_PROXIMITY_ERR) / fabs(face->det) * LRCSI_OUTWARD_NANO;
    return sqrt(at[0] * at[0] + at[1] * at[1]) + wide < face->radius;
}

/* Is a part in front of the plane of the face? *err: what that leaves open in projection, 0 if it
   is not in front. */
static int part_is_before_face(const face_job *job, uint32_t part, double *err)
{
    const lrcsi_event_bands *bands = job->bands;
    const lrcsi_outline *outline = &bands->orders.outline[part];
    if (outline->known && lrcsi_outline_in_front(outline, bands->view, job->face.facet, err)) {
        return 1;
    }
    *err = 0;
    return 0;
}

/* The errors of both ends of an edge, for points anywhere on the face. */
static double ends_err(const lrcsi_view *view, const lrcsi_edge *edge)
{
    return LRCSI_EDGE_RECTANGLE_ERR * (lrcsi_view_point_err(view->point[edge->low].x) +
                                       lrcsi_view_point_err(view->point[edge->high].x));
}

/* Returns 0 if the edge is not over the face, or (b) does not hold. */
static int edge_margin_make(face_job *job, uint32_t event, edge_margin *m)
{
    lrcsi_event_bands *bands = job->bands;
    const lrcsi_view *view = bands->view;
    const uint32_t part = bands->events.part[event];
    const lrcsi_edge *edge = &view->prepared->topology.edge[bands->events.edge[event]];
    const double side = bands->events.side[event];
    *m = (edge_margin){.event = event,
                       .edge = edge,
                       .outline = &bands->orders.outline[part],
                       .a = view->point[edge->low].x,
                       .b = view->point[edge->high].x};
    if (part == job->face.part || side == 0 || !face_contains(&job->face, m->a, 0) ||
        !face_contains(&job->face, m->b, 0)) {
        return 0;
    }
    const double ab[2] = {m->b[0] - m->a[0], m->b[1] - m->a[1]};
    m->length = sqrt(ab[0] * ab[0] + ab[1] * ab[1]);
    if (!part_is_before_face(job, part, &m->contact) || lrcsi_event_rim_is_inside(bands, event)) {
        return 0;
    }
    m->err = m->contact + m->outline->err + ends_err(view, edge) + LRCSI_PROXIMITY_ERR;
    m->width = 4 * (m->outline->k + m->err);
    for (int i = 0; i < 2; i++) {
        m->along[i] = ab[i] / m->length;
    }
    m->outward[0] = side * m->along[1];
    m->outward[1] = -side * m->along[0];
    return 1;
}

/* (a), and the length of the edge. */
static int edge_is_inside(const face_job *job, const edge_margin *m)
{
    return m->length > LENGTH_MIN_WIDTHS * m->width && face_contains(&job->face, m->a, m->width) &&
           face_contains(&job->face, m->b, m->width);
}

/* --- what else is near ------------------------------------------------------------------------ */

/* Does an event edge of Q lead away from the end a (0) or b (1) of an edge? Returns its turn; a
   negative number if it does not. */
static double edge_turn(const edge_margin *m, const lrcsi_view *view, const lrcsi_edge *other,
                        int end)
{
    const uint32_t at = end == 0 ? m->edge->low : m->edge->high;
    const double *from = view->point[at].x;
    const double *to = view->point[other->low == at ? other->high : other->low].x;
    const double away[2] = {to[0] - from[0], to[1] - from[1]};
    double length = sqrt(away[0] * away[0] + away[1] * away[1]);
    double along = away[0] * m->along[0] + away[1] * m->along[1];
    double across = fabs(away[0] * m->along[1] - away[1] * m->along[0]);
    if (!(length > m->width) || !((end == 0 ? -along : along) > 0) ||
        !(across + m->err < TURN_SINE_MAX * length)) {
        return -1;
    }
    return ANGLE_OVER_SINE * (across + m->err) / length;
}

/* (c): may an event edge of another part, or (d) one of Q that is not next to the edge, come within
   its slack of N? The slack includes the errors of both ends, wherever N lies on the face, and what
   (e) leaves open of a part in front of the plane. */
static int event_meets(face_job *job, const edge_margin *m, uint32_t other)
{
    lrcsi_event_bands *bands = job->bands;
    const lrcs_prepared *p = bands->view->prepared;
    const uint32_t part = bands->events.part[other];
    const lrcsi_edge *edge = &p->topology.edge[bands->events.edge[other]];
    const int is_own = part == bands->events.part[m->event];
    double slack = m->err + m->width + ends_err(bands->view, edge);
    if (!is_own) {
        double contact;
        (void)part_is_before_face(job, part, &contact);
        slack += lrcsi_proximity_slack(p, job->face.part, part) + contact;
    }
    const lrcsi_edge_rectangle box =
        lrcsi_edge_rectangle_make(bands->view, job->face.facet, edge, slack);
    double unproved;
    if (!lrcsi_edge_rectangle_meets(&box, m->a, m->b)) {
        return 0;
    }
    if (is_own) {
        return !lrcsi_event_rim_is_inside(bands, other);
    }
    return !lrcsi_edge_rectangle_behind(bands->view, job->face.facet, edge, slack) &&
           !(lrcsi_part_is_behind(&bands->orders, job->face.facet, part, &unproved) &&
             unproved == 0);
}

/* (c) and (d). Returned: the turns at both ends. */
static int edge_is_alone(face_job *job, const edge_margin *m, double turn[2])
{
    lrcsi_event_bands *bands = job->bands;
    const lrcs_prepared *p = bands->view->prepared;
    const lrcsi_proximity_events *events = &bands->events;
    const double near = 2 * (p->proximity.reach[job->face.part] + p->proximity.max_hausdorff) +
                        2 * (m->err + m->width);
    const double low[3] = {lrcsi_min(m->a[0], m->b[0]) - near, lrcsi_min(m->a[1], m->b[1]) - near,
                           0};
    const double high[3] = {lrcsi_max(m->a[0], m->b[0]) + near, lrcsi_max(m->a[1], m->b[1]) + near,
                            0};
    const lrcsi_view_box box = lrcsi_view_box_round(bands->view, low, high);
    lrcsi_grid_rect buckets = lrcsi_grid_buckets(&events->grid, &box);
    lrcsi_grid_items items;
    uint32_t next[2] = {LRCS_NONE, LRCS_NONE}; /* the events at both ends */
    while (lrcsi_grid_next_row(&events->grid, &buckets, &items)) {
        if (!lrcsi_meter_take(bands->meter, (uint64_t)1 + items.to - items.from)) {
            return 0;
        }
        for (uint32_t i = items.from; i < items.to; i++) {
            const uint32_t other = events->grid.item[i];
            const lrcsi_edge *edge = &p->topology.edge[events->edge[other]];
            int end = 2;
            if (other == m->event || events->part[other] == job->face.part || other == next[0] ||
                other == next[1]) {
                continue;
            }
            if (events->part[other] == events->part[m->event]) {
                const uint32_t a = m->edge->low;
                const uint32_t b = m->edge->high;
                end = edge->low == a || edge->high == a   ? 0
                      : edge->low == b || edge->high == b ? 1
                                                          : 2;
            }
            if (end < 2 && !lrcsi_event_rim_is_inside(bands, other)) {
                turn[end] = edge_turn(m, bands->view, edge, end);
                if (next[end] != LRCS_NONE || turn[end] < 0) {
                    return 0;
                }
                next[end] = other;
            } else if (event_meets(job, m, other)) {
                return 0;
            }
        }
    }
    return next[0] != LRCS_NONE && next[1] != LRCS_NONE;
}

/* Grows a box by what of a facet is within `slack` of the plane of the face. */
static void near_box_add(const face_job *job, uint32_t facet, const double up[3], double slack,
                         near_box *box)
{
    const lrcsi_view *view = job->bands->view;
    const lrcs_prepared *p = view->prepared;
    const double *const corner[3] = {lrcsi_prepared_corner(p, facet, 0),
                                     lrcsi_prepared_corner(p, facet, 1),
                                     lrcsi_prepared_corner(p, facet, 2)};
    const double down[3] = {-up[0], -up[1], -up[2]};
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
    lrcsi_slice_cut(&slice, up, job->face.centre, slack);
    lrcsi_slice_cut(&slice, down, job->face.centre, slack);
    for (int i = 0; i < slice.count; i++) {
        double x[3];
        lrcsi_view_coordinates(view, slice.x[i], x);
        for (int k = 0; k < 2; k++) {
            box->low[k] = lrcsi_min(box->low[k], x[k] - slack);
            box->high[k] = lrcsi_max(box->high[k], x[k] + slack);
        }
    }
}

/* For (e): the boxes around the facets of parts near the plane of the face. Their slack is doubled,
   which contains all errors. */
static void near_boxes_make(face_job *job)
{
    lrcsi_event_bands *bands = job->bands;
    const lrcs_prepared *p = bands->view->prepared;
    const lrcs_scene *scene = p->scene;
    const double *up = scene->part[job->face.part].axis[2];
    for (uint32_t i = 0; i < scene->part_count; i++) {
        const lrcs_part *part = &scene->part[i];
        const double slack =
            2 * lrcsi_proximity_slack(p, job->face.part, i) + 64 * LRCSI_PROXIMITY_ERR;
        double err;
        job->near[i] = (near_box){{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
        if (i == job->face.part || part_is_before_face(job, i, &err)) {
            continue;
        }
        for (uint32_t f = part->first_facet; f < part->first_facet + part->facet_count; f++) {
            if (!p->skip[f]) {
                near_box_add(job, f, up, slack, &job->near[i]);
            }
        }
    }
    job->near_known = 1;
}

/* (e) */
static int edge_is_clear(face_job *job, const edge_margin *m)
{
    const uint32_t parts = job->bands->view->prepared->scene->part_count;
    const double wide = m->width + m->err;
    if (!job->near_known) {
        near_boxes_make(job);
    }
    int clear = 1;
    for (uint32_t i = 0; i < parts && clear; i++) {
        const near_box *box = &job->near[i];
        int apart = 0;
        for (int k = 0; k < 2; k++) {
            apart |= lrcsi_max(m->a[k], m->b[k]) + wide < box->low[k] ||
                     lrcsi_min(m->a[k], m->b[k]) - wide > box->high[k];
        }
        clear = apart;
    }
    return clear;
}

/* Does a facet cover a point of the view plane, or is it so close that an exact test has to decide?
 */
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

/* Makes the grid for queries, if there is memory for it. */
static void facets_make(face_job *job)
{
    const lrcsi_view *view = job->bands->view;
    const uint32_t count = view->prepared->scene->facet_count;
    lrcsi_classification *c = job->classification;
    unsigned char *reader = lrcsi_work_take(job->work, count, 1);
    job->facets_tried = 1;
    for (uint32_t f = 0; f < count && reader; f++) {
        reader[f] = lrcsi_face_margin_holds(view, f) ? 1 : 0;
    }
    const lrcsi_grid_readers readers = {.undecided = reader};
    job->facets_made = reader && lrcsi_grid_facets(&c->search.grid, &c->search.boxes, &readers,
                                                   job->work, &job->facets) == LRCS_OK;
}

/* (f): the point half of w beyond the middle of the edge. */
static int edge_is_seen(face_job *job, const edge_margin *m)
{
    const lrcsi_view *view = job->bands->view;
    const lrcs_part *part = &view->prepared->scene->part[job->face.part];
    double x[2];
    double at[2];
    double point[3];
    if (!job->facets_tried) {
        facets_make(job);
    }
    if (!job->facets_made) {
        return 0;
    }
    for (int i = 0; i < 2; i++) {
        x[i] = 0.5 * (m->a[i] + m->b[i]) + 0.5 * m->width * m->outward[i];
    }
    face_coordinates(&job->face, x, at);
    for (int k = 0; k < 3; k++) {
        point[k] = job->face.centre[k] + at[0] * part->axis[0][k] + at[1] * part->axis[1][k];
    }
    for (uint32_t f = part->first_facet; f < part->first_facet + part->facet_count; f++) {
        if (lrcsi_face_margin_holds(view, f) && facet_may_cover(view, f, x)) {
            int answer = lrcsi_query_point(&job->facets, f, point, job->bands->meter);
            if (answer != LRCSI_QUERY_UNDECIDED) {
                return answer == LRCSI_QUERY_VISIBLE;
            }
        }
    }
    return 0;
}

/* --- all faces -------------------------------------------------------------------------------- */

/* What the true shapes leave visible of the face along an edge, less what their facets leave:
   returns the area, and a bound on its error. If the margin is on the face alone, this is the
   signed area between the outlines; otherwise it lies between the loss and the gain of outline.c.
   The error is infinite if nothing is known. */
static double edge_area(face_job *job, const edge_margin *m, double *error)
{
    lrcsi_event_bands *bands = job->bands;
    const lrcsi_outline_areas *areas = &bands->areas[m->event];
    double turn[2];
    *error = 0.5 * (areas->gain + areas->loss) + areas->width * m->contact;
    double area = isfinite(*error) ? 0.5 * (areas->gain - areas->loss) : 0;
    if (edge_is_inside(job, m) && edge_is_clear(job, m) && edge_is_alone(job, m, turn) &&
        edge_is_seen(job, m)) {
        const lrcsi_outline_margin margin =
            lrcsi_outline_margin_make(m->outline, m->a, m->b, bands->events.side[m->event]);
        const double k = m->outline->k + m->err;
        const double err =
            margin.error + 2 * m->err * margin.width + 4 * k * k * (turn[0] + turn[1]);
        if (err < *error) {
            *error = err;
            area = margin.area;
        }
    }
    return area;
}

/* Adds the areas along all event edges over the face. */
static void face_add(face_job *job, lrcsi_face_margin *face, uint32_t *on)
{
    const lrcsi_event_bands *bands = job->bands;
    for (uint32_t i = 0; i < bands->events.count; i++) {
        edge_margin m;
        double error;
        if (on[i] != LRCS_NONE || !edge_margin_make(job, i, &m)) {
            continue;
        }
        double area = edge_area(job, &m, &error);
        if (isfinite(area + error)) {
            on[i] = job->face.part;
            face->known = 1;
            face->area += area;
            face->error += (error + 8 * LRCSI_U * fabs(face->area)) * LRCSI_OUTWARD_NANO;
        }
    }
}

size_t lrcsi_face_margins_need(const lrcs_prepared *p)
{
    size_t need = lrcsi_work_add(lrcsi_work_bytes(p->scene->facet_count, 1),
                                 lrcsi_work_bytes(p->scene->part_count, sizeof(near_box)));
    return lrcsi_work_add(need, lrcsi_grid_facets_need(p));
}

void lrcsi_face_margins_make(lrcsi_event_bands *bands, lrcsi_classification *classification,
                             lrcs_work *work, lrcsi_face_margin *face, uint32_t *on)
{
    const lrcs_scene *scene = bands->view->prepared->scene;
    const size_t mark = work->used;
    face_job job = {.bands = bands, .classification = classification, .work = work};
    job.near = lrcsi_work_take(work, scene->part_count, sizeof *job.near);
    for (uint32_t i = 0; i < bands->events.count; i++) {
        on[i] = LRCS_NONE;
    }
    for (uint32_t i = 0; i < scene->part_count; i++) {
        face[i] = (lrcsi_face_margin){.known = 0};
        job.near_known = 0;
        if (job.near && flat_face_make(&bands->orders, i, &job.face)) {
            face_add(&job, &face[i], on);
        }
    }
    work->used = mark;
}
