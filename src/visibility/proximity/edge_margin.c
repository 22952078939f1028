/* SPDX-License-Identifier: MIT */
/* Decides which other event edges come near an event edge. What else has to hold, and what follows
   for the areas beside it, is decided in visibility/proximity/face_margin.c and wall_margin.c,
   whose letters are used here. */
#include "visibility/proximity/edge_margin.h"

#include <math.h>

#include "base/range.h"

/* The sine of the largest turn between neighbouring event edges: below that of 0.5. An angle below
   0.5 is at most 1.05 times its sine. */
#define TURN_SINE_MAX   0.47
#define ANGLE_OVER_SINE 1.05

/* The errors of both ends of an edge, for points anywhere near it. */
static double ends_err(const lrcsi_view *view, const lrcsi_edge *edge)
{
    return LRCSI_EDGE_RECTANGLE_ERR * (lrcsi_view_point_err(view->point[edge->low].x) +
                                       lrcsi_view_point_err(view->point[edge->high].x));
}

int lrcsi_edge_margin_make(const lrcsi_event_bands *bands, uint32_t event, uint32_t receiver,
                           double order_err, lrcsi_edge_margin *m)
{
    const lrcsi_view *view = bands->view;
    const uint32_t part = bands->events.part[event];
    const double side = bands->events.side[event];
    const lrcsi_edge *edge = &view->prepared->topology.edge[bands->events.edge[event]];
    *m = (lrcsi_edge_margin){.event = event,
                             .part = part,
                             .edge = edge,
                             .outline = &bands->orders.outline[part],
                             .a = view->point[edge->low].x,
                             .b = view->point[edge->high].x,
                             .order_err = order_err};
    if (part == receiver || side == 0 || !m->outline->known ||
        lrcsi_event_rim_is_inside(bands, event)) {
        return 0;
    }
    const double ab[2] = {m->b[0] - m->a[0], m->b[1] - m->a[1]};
    m->length = sqrt(ab[0] * ab[0] + ab[1] * ab[1]);
    m->err = order_err + m->outline->err + ends_err(view, edge) + LRCSI_PROXIMITY_ERR;
    m->width = 4 * (m->outline->k + m->err);
    for (int i = 0; i < 2; i++) {
        m->along[i] = ab[i] / m->length;
    }
    m->outward[0] = side * m->along[1];
    m->outward[1] = -side * m->along[0];
    return 1;
}

/* Does an event edge of Q lead away from the end a (0) or b (1) of an edge? Returns its turn; a
   negative number if it does not. */
static double edge_turn(const lrcsi_edge_margin *m, const lrcsi_view *view, const lrcsi_edge *other,
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

/* Is an event edge of a part other than Q so far behind the receiver that it does not matter? */
static int event_is_behind_receiver(lrcsi_event_bands *bands, const lrcsi_margin_receiver *receiver,
                                    uint32_t part, const lrcsi_edge *edge, double slack)
{
    double unproved = 0;
    if (part == receiver->part) {
        return 0;
    }
    if (!receiver->face) {
        return lrcsi_part_is_behind(&bands->orders, receiver->facet, part, &unproved) &&
               unproved == 0;
    }
    return lrcsi_edge_rectangle_behind(bands->view, receiver->facet, edge, slack) ||
           lrcsi_face_part_is_behind(bands, receiver->face, part);
}

/* (c): may an event edge of another part, or (d) one of Q that is not next to the edge, come within
   its slack of N? For another part the slack of both parts is tested, which is larger than needed
   (its own Hausdorff distance, or twice that, for aligned points), with the errors of both ends
   wherever N lies, and with what (b) leaves open of a part in front. For P the slack is two
   reaches. */
static int event_meets(lrcsi_event_bands *bands, const lrcsi_edge_margin *m,
                       const lrcsi_margin_receiver *receiver, uint32_t other)
{
    const lrcs_prepared *p = bands->view->prepared;
    const uint32_t part = bands->events.part[other];
    const lrcsi_edge *edge = &p->topology.edge[bands->events.edge[other]];
    double slack = m->err + m->width + ends_err(bands->view, edge);
    if (part == receiver->part) {
        slack += 2 * p->proximity.reach[part] + LRCSI_PROXIMITY_ERR;
    } else if (part != m->part) {
        slack += lrcsi_proximity_slack(p, receiver->part, part) + receiver->order_err;
    }
    const lrcsi_edge_rectangle box =
        lrcsi_edge_rectangle_make(bands->view, receiver->facet, edge, slack);
    if (lrcsi_segment_part_is_empty(lrcsi_edge_rectangle_part(&box, m->a, m->b))) {
        return 0;
    }
    if (part == m->part) {
        return !lrcsi_event_rim_is_inside(bands, other);
    }
    return !event_is_behind_receiver(bands, receiver, part, edge, slack);
}

/* At which end of the edge another event edge of Q begins: 0 a, 1 b, 2 neither. */
static int end_at(const lrcsi_edge_margin *m, const lrcsi_edge *other)
{
    const uint32_t a = m->edge->low;
    const uint32_t b = m->edge->high;
    return other->low == a || other->high == a ? 0 : other->low == b || other->high == b ? 1 : 2;
}

/* Searched is a box larger than every distance that event_meets tests: a slack is at most e_P + 2 k
   or 2 e_P, an order_err k / 2, and the errors of the ends of another edge are smaller still. */
int lrcsi_edge_margin_is_isolated(lrcsi_event_bands *bands, const lrcsi_edge_margin *m,
                                  const lrcsi_margin_receiver *receiver, double turn[2])
{
    const lrcs_prepared *p = bands->view->prepared;
    const lrcsi_proximity_events *events = &bands->events;
    const double near = 2 * p->proximity.reach[receiver->part] + 3 * p->proximity.max_hausdorff +
                        2 * (m->err + m->width) + 64 * LRCSI_PROXIMITY_ERR;
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
            if (other == m->event || other == next[0] || other == next[1] ||
                (receiver->face && events->part[other] == receiver->part)) {
                continue;
            }
            const int end = events->part[other] == m->part ? end_at(m, edge) : 2;
            if (end < 2 && !lrcsi_event_rim_is_inside(bands, other)) {
                turn[end] = edge_turn(m, bands->view, edge, end);
                if (next[end] != LRCS_NONE || turn[end] < 0) {
                    return 0;
                }
                next[end] = other;
            } else if (event_meets(bands, m, receiver, other)) {
                return 0;
            }
        }
    }
    return next[0] != LRCS_NONE && next[1] != LRCS_NONE;
}
