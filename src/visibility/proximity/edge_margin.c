/* SPDX-License-Identifier: MIT */
/* Decides which other event edges come near an event edge. What else has to hold, and what follows
   for the areas beside it, is decided in visibility/proximity/face_margin.c and wall_margin.c,
   whose letters are used here. */
#include "visibility/proximity/edge_margin.h"

#include <math.h>

#include "base/outward.h"
#include "base/range.h"

/* The sine of the largest angle between an edge and those that follow it: below that of 0.5. An
   angle below 0.5 is at most 1.05 times its sine. */
#define TURN_SINE_MAX   0.47
#define ANGLE_OVER_SINE 1.05
/* The tangent of an angle below 0.5 is at most 1.1 times the angle. */
#define TANGENT_OVER_ANGLE 1.1
/* An edge is used only if it is longer than this many errors of positions: its direction is then
   accurate enough. */
#define LENGTH_OVER_ERR 64.0
/* No more event edges than this may follow an edge: heuristic. */
#define CHAIN_MAX 16
/* A part of an edge is used only if it is longer than this many times w: heuristic. */
#define PART_LENGTH_MIN 2.0

/* The errors of both ends of an edge, for points anywhere near it. */
static double ends_err(const lrcsi_view *view, const lrcsi_edge *edge)
{
    return LRCSI_EDGE_RECTANGLE_ERR * (lrcsi_view_point_err(view->point[edge->low].x) +
                                       lrcsi_view_point_err(view->point[edge->high].x));
}

/* Completes the data of an edge, given an error of the positions of its ends. Returns 0 if it is
   too short. */
static int margin_place(lrcsi_edge_margin *m, double position_err)
{
    const double ab[2] = {m->b[0] - m->a[0], m->b[1] - m->a[1]};
    m->length = sqrt(ab[0] * ab[0] + ab[1] * ab[1]);
    m->err = m->order_err + m->outline->err + position_err + LRCSI_PROXIMITY_ERR;
    m->width = 4 * (m->outline->k + m->err);
    if (!(m->length > LENGTH_OVER_ERR * m->err)) {
        return 0;
    }
    m->direction_err = 2 * m->err / m->length;
    for (int i = 0; i < 2; i++) {
        m->along[i] = ab[i] / m->length;
    }
    m->outward[0] = m->side * m->along[1];
    m->outward[1] = -m->side * m->along[0];
    return 1;
}

int lrcsi_edge_margin_make(const lrcsi_event_bands *bands, const lrcsi_outline *outline,
                           uint32_t event, uint32_t receiver, double order_err,
                           lrcsi_edge_margin *m)
{
    const lrcsi_view *view = bands->view;
    const uint32_t part = bands->events.part[event];
    const lrcsi_edge *edge = &view->prepared->topology.edge[bands->events.edge[event]];
    *m = (lrcsi_edge_margin){.event = event,
                             .part = part,
                             .edge = edge,
                             .side = bands->events.side[event],
                             .end = {edge->low, edge->high},
                             .outline = outline,
                             .order_err = order_err};
    if (part == receiver || m->side == 0 || !m->outline->known ||
        lrcsi_event_rim_is_inside(bands, event)) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        m->a[k] = view->point[edge->low].x[k];
        m->b[k] = view->point[edge->high].x[k];
    }
    return margin_place(m, ends_err(view, edge));
}

int lrcsi_edge_margin_make_side(const lrcsi_outline *outline, uint32_t part, const double a[3],
                                const double b[3], double order_err, lrcsi_edge_margin *m)
{
    *m = (lrcsi_edge_margin){
        .event = LRCS_NONE, .part = part, .side = 1, .outline = outline, .order_err = order_err};
    for (int k = 0; k < 3; k++) {
        m->a[k] = a[k];
        m->b[k] = b[k];
    }
    return margin_place(m, LRCSI_EDGE_RECTANGLE_ERR *
                               (lrcsi_view_point_err(a) + lrcsi_view_point_err(b)));
}

double lrcsi_edge_margin_turn(const lrcsi_edge_margin *m, const double away[2])
{
    const double length = sqrt(away[0] * away[0] + away[1] * away[1]);
    const double across = fabs(away[0] * m->along[1] - away[1] * m->along[0]) + m->err;
    return across < TURN_SINE_MAX * length ? ANGLE_OVER_SINE * across / length + m->direction_err
                                           : -1;
}

/* The fraction of an edge that is w long, errors included. */
static double width_fraction(const lrcsi_edge_margin *m)
{
    return (m->width + m->err) / m->length * LRCSI_OUTWARD_NANO;
}

void lrcsi_edge_margin_add_end_gap(const lrcsi_edge_margin *m, int end, lrcsi_edge_gaps *gaps)
{
    const double wide = width_fraction(m);
    lrcsi_edge_gaps_add(gaps, end == 0 ? (lrcsi_segment_part){0, wide}
                                       : (lrcsi_segment_part){1 - wide, 1});
}

int lrcsi_edge_margin_part(const lrcsi_edge_margin *edge, const lrcsi_edge_gaps *gaps, int i,
                           const double turn[2], lrcsi_edge_part *part)
{
    const double wide = width_fraction(edge);
    lrcsi_segment_part of = lrcsi_edge_gaps_before(gaps, i);
    *part = (lrcsi_edge_part){of, *edge, {turn[0], turn[1]}};
    if (of.from <= 0 && of.to >= 1) {
        return 1;
    }
    if (of.from > 0) {
        of.from = lrcsi_max(of.from, wide);
        part->turn[0] = 0;
    }
    if (of.to < 1) {
        of.to = lrcsi_min(of.to, 1 - wide);
        part->turn[1] = 0;
    }
    lrcsi_edge_margin *m = &part->margin;
    part->of = of;
    m->length = (of.to - of.from) * edge->length;
    m->direction_err = 2 * m->err / m->length;
    for (int k = 0; k < 3; k++) {
        const double ab = edge->b[k] - edge->a[k];
        m->a[k] = edge->a[k] + of.from * ab;
        m->b[k] = edge->b[k] - (1 - of.to) * ab;
    }
    return m->length > lrcsi_max(PART_LENGTH_MIN * m->width, LENGTH_OVER_ERR * m->err);
}

double lrcsi_edge_margin_end(const lrcsi_edge_margin *m, double depth, double turn)
{
    const double k = m->outline->k + m->err;
    const double turned = 2 * k * m->direction_err; /* at a distance of 2 k from the end */
    const double deepest = lrcsi_min(2 * k, depth + 2 * m->err + turned);
    return deepest * deepest * TANGENT_OVER_ANGLE * turn * LRCSI_OUTWARD_NANO;
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
    return lrcsi_edge_rectangle_behind_plane(bands->view, receiver->facet, edge, slack) ||
           lrcsi_face_part_is_behind(bands, receiver->face, part);
}

static const lrcsi_segment_part nowhere = {1, 0};

/* Is another edge farther than `slack` away along an axis of the view? */
static int edge_is_beside(const lrcsi_view *view, const lrcsi_edge_margin *m,
                          const lrcsi_edge *other, double slack)
{
    const double *p = view->point[other->low].x;
    const double *q = view->point[other->high].x;
    int beside = 0;
    for (int k = 0; k < 2; k++) {
        beside |= lrcsi_min(p[k], q[k]) - slack > lrcsi_max(m->a[k], m->b[k]) ||
                  lrcsi_max(p[k], q[k]) + slack < lrcsi_min(m->a[k], m->b[k]);
    }
    return beside;
}

/* The part of an edge near which (c) an event edge of another part, or (d) another one of Q, may
   come within its slack of N. For another part the slack of both parts is tested, which is larger
   than needed (its own Hausdorff distance, or twice that, for aligned points), with the errors of
   both ends wherever N lies, and with what (b) leaves open of a part in front. For P the slack is
   two reaches. */
static lrcsi_segment_part event_near(lrcsi_event_bands *bands, const lrcsi_edge_margin *m,
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
    if (edge_is_beside(bands->view, m, edge, slack)) {
        return nowhere;
    }
    const lrcsi_edge_rectangle box =
        lrcsi_edge_rectangle_make(bands->view, receiver->facet, edge, slack);
    const lrcsi_segment_part near = lrcsi_edge_rectangle_part(&box, m->a, m->b);
    if (lrcsi_segment_part_is_empty(near)) {
        return nowhere;
    }
    const int matters = part == m->part
                            ? !lrcsi_event_rim_is_inside(bands, other)
                            : !event_is_behind_receiver(bands, receiver, part, edge, slack);
    return matters ? near : nowhere;
}

/* An event edge of Q near an edge, and the part of that edge which it is near. */
typedef struct chain_event {
    uint32_t event;
    lrcsi_segment_part near;
} chain_event;

/* Those that were found to follow one of its ends come first. */
typedef struct edge_chain {
    chain_event event[CHAIN_MAX];
    int count, followed;
} edge_chain;

/* Notes an event edge of Q, which may be found more than once. Returns 0 if there are too many. */
static int chain_add(edge_chain *chain, uint32_t event, lrcsi_segment_part near)
{
    int i = 0;
    while (i < chain->count && chain->event[i].event != event) {
        i++;
    }
    if (i < chain->count) {
        return 1;
    }
    if (chain->count == CHAIN_MAX) {
        return 0;
    }
    chain->event[chain->count++] = (chain_event){event, near};
    return 1;
}

/* The vertex at which an edge that begins at another vertex ends; LRCS_NONE if it does not begin
   there. */
static uint32_t far_end(const lrcsi_edge *edge, uint32_t at)
{
    return edge->low == at ? edge->high : edge->high == at ? edge->low : LRCS_NONE;
}

/* Follows the event edges of Q that lead away from the end a (0) or b (1) of an edge, until one
   ends farther than w from there. Returns the largest angle between them and the edge; a negative
   number if they do not lead away so far, or another one begins where one of them does. */
static double chain_turn(const lrcsi_edge_margin *m, const lrcsi_event_bands *bands, int end,
                         edge_chain *chain)
{
    const lrcsi_view *view = bands->view;
    const lrcsi_edge *edge = view->prepared->topology.edge;
    uint32_t at = end == 0 ? m->edge->low : m->edge->high;
    const double *start = view->point[at].x;
    double distance = 0;
    double turn = 0;
    while (!(distance > m->width)) {
        uint32_t next = LRCS_NONE;
        for (int i = chain->followed; i < chain->count; i++) {
            const uint32_t other = far_end(&edge[bands->events.edge[chain->event[i].event]], at);
            if (other == LRCS_NONE) {
                continue;
            }
            if (next != LRCS_NONE) {
                return -1;
            }
            next = other;
            const chain_event event = chain->event[i];
            chain->event[i] = chain->event[chain->followed];
            chain->event[chain->followed] = event;
        }
        if (next == LRCS_NONE) {
            return -1;
        }
        chain->followed++;
        const double *from = view->point[at].x;
        const double *to = view->point[next].x;
        const double away[2] = {to[0] - from[0], to[1] - from[1]};
        const double along = away[0] * m->along[0] + away[1] * m->along[1];
        const double angle = lrcsi_edge_margin_turn(m, away);
        if (!((end == 0 ? -along : along) > 0) || angle < 0) {
            return -1;
        }
        turn = lrcsi_max(turn, angle);
        distance = fabs((to[0] - start[0]) * m->along[0] + (to[1] - start[1]) * m->along[1]);
        at = next;
    }
    return turn;
}

/* Follows the event edges at both ends. Where that fails, the end is too near, and so are all that
   follow neither. */
static void chain_finish(const lrcsi_edge_margin *m, const lrcsi_event_bands *bands,
                         edge_chain *chain, lrcsi_edge_gaps *gaps, double turn[2])
{
    for (int end = 0; end < 2; end++) {
        const int followed = chain->followed;
        turn[end] = chain_turn(m, bands, end, chain);
        if (turn[end] < 0) {
            chain->followed = followed;
            lrcsi_edge_margin_add_end_gap(m, end, gaps);
        }
    }
    for (int i = chain->followed; i < chain->count; i++) {
        lrcsi_edge_gaps_add(gaps, chain->event[i].near);
    }
}

/* Searched is a box larger than every distance that event_near tests: a slack is at most e_P + 2 k
   or 2 e_P, an order_err k / 2, and the errors of the ends of another edge are smaller still. */
void lrcsi_edge_margin_find_gaps(lrcsi_event_bands *bands, const lrcsi_edge_margin *m,
                                 const lrcsi_margin_receiver *receiver, lrcsi_edge_gaps *gaps,
                                 double turn[2])
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
    edge_chain chain = {.count = 0};
    while (lrcsi_grid_next_row(&events->grid, &buckets, &items) && !lrcsi_edge_gaps_are_all(gaps)) {
        if (!lrcsi_meter_take(bands->meter, (uint64_t)1 + items.to - items.from)) {
            lrcsi_edge_gaps_add(gaps, (lrcsi_segment_part){0, 1});
        }
        for (uint32_t i = items.from; i < items.to && !lrcsi_edge_gaps_are_all(gaps); i++) {
            const uint32_t other = events->grid.item[i];
            const uint32_t other_part = events->part[other];
            if (other == m->event || (m->event == LRCS_NONE && other_part == m->part) ||
                (receiver->face && other_part == receiver->part)) {
                continue;
            }
            const lrcsi_segment_part part = event_near(bands, m, receiver, other);
            if (!lrcsi_segment_part_is_empty(part) &&
                (other_part != m->part || !chain_add(&chain, other, part))) {
                lrcsi_edge_gaps_add(gaps, part);
            }
        }
    }
    if (m->event != LRCS_NONE) {
        chain_finish(m, bands, &chain, gaps, turn);
    }
}
