/* SPDX-License-Identifier: MIT */
/* What may hide one facet, f: the candidates, their depth order against f, and the segments along
   which they begin or cease to hide it. Which of them hide it at a point is decided in
   visibility/cells/facet_cells_sample.c. */
#include "visibility/cells/facet_cells_candidate.h"

#include <math.h>

#include "base/constant.h"
#include "base/length.h"
#include "view/side.h"
#include "visibility/base/sample.h"
#include "visibility/cells/contact.h"

/* --- candidates ------------------------------------------------------------------------------- */

/* From their planes; if they are coplanar, from the rules of precedence; otherwise from where they
   overlap. */
int lrcsi_facet_cells_order(const lrcsi_facet_cells *cells, uint32_t other)
{
    const lrcsi_view *view = cells->division.view;
    int order = lrcsi_sample_side(view, other, cells->facet);
    if (order == 0) {
        const lrcsi_intersection *contact =
            lrcsi_intersection_find(&view->prepared->intersections, cells->facet, other);
        order = contact && !lrcsi_sample_contact_hides(view, cells->facet, contact)
                    ? -1
                    : lrcsi_sample_overlap_order(view, other, cells->facet);
    }
    return order > 0 ? LRCSI_ORDER_FRONT : order < 0 ? LRCSI_ORDER_BEHIND : LRCSI_ORDER_UNDECIDED;
}

/* Does another facet lie entirely beyond one side of f? Corners that both share are on the line of
   that side. */
static int facet_apart(const lrcsi_facet_cells *cells, const lrcsi_view_side own[3], uint32_t other)
{
    const lrcsi_view *view = cells->division.view;
    const uint32_t *ends = view->prepared->scene->facet[cells->facet].corner;
    const uint32_t *corner = view->prepared->scene->facet[other].corner;
    int apart = 0;
    for (int k = 0; k < 3 && !apart; k++) {
        const uint32_t from = ends[k];
        const uint32_t to = ends[k == 2 ? 0 : k + 1];
        apart = 1;
        for (int i = 0; i < 3 && apart; i++) {
            const lrcsi_view_vertex *at = &view->point[corner[i]];
            apart =
                corner[i] == from || corner[i] == to ||
                view->facing[cells->facet] * lrcsi_view_side_orient(&own[k], at->x, at->err) == -1;
        }
    }
    return apart;
}

int lrcsi_facet_cells_candidates(lrcsi_facet_cells *cells)
{
    const lrcsi_grid *grid = &cells->grid;
    lrcsi_division *d = &cells->division;
    lrcsi_view_box box = *lrcsi_boxes_facet(&grid->boxes, cells->facet);
    lrcsi_grid_walk walk;
    lrcsi_grid_row row;
    const uint32_t *corner = d->view->prepared->scene->facet[cells->facet].corner;
    lrcsi_view_side side[3];
    for (int k = 0; k < 3; k++) {
        side[k] = lrcsi_view_side_of(d->view, corner[k], corner[k == 2 ? 0 : k + 1]);
    }
    cells->candidate_count = 0;
    lrcsi_marks_clear(&cells->listed, d->view->prepared->scene->facet_count);
    cells->listed.entry[cells->facet] = cells->listed.number;
    cells->order[cells->facet] = LRCSI_ORDER_DISJOINT;
    lrcsi_grid_walk_facet(grid, &box, cells->facet, &walk);
    while (lrcsi_grid_walk_next(&walk, &row)) {
        const lrcsi_grid_items items = lrcsi_grid_row_items(grid, row.y, row.x0, row.x1);
        if (!lrcsi_meter_take(d->meter, items.to - items.from)) {
            return 0;
        }
        for (uint32_t i = items.from; i < items.to; i++) {
            uint32_t other = grid->item[i];
            const lrcsi_view_box *other_box = lrcsi_boxes_facet(&grid->boxes, other);
            if (lrcsi_marked(&cells->listed, other) || lrcsi_view_box_beside(other_box, &box) ||
                lrcsi_view_box_behind(other_box, &box)) {
                continue;
            }
            cells->listed.entry[other] = cells->listed.number;
            cells->order[other] = LRCSI_ORDER_DISJOINT;
            if (!facet_apart(cells, side, other)) {
                int front = lrcsi_view_box_behind(&box, other_box);
                cells->order[other] =
                    front ? (uint32_t)LRCSI_ORDER_FRONT : (uint32_t)LRCSI_ORDER_NOT_COMPUTED;
                if (cells->candidate_count < cells->side_room) {
                    cells->side[cells->candidate_count][0].err = -1; /* not made yet */
                }
                cells->candidate[cells->candidate_count++] = other;
            }
        }
    }
    return 1;
}

/* --- segments --------------------------------------------------------------------------------- */

/* The error of a segment in a needle's frame, given the error of its ends. Coordinates in the box
   -1 .. 2 are at most 2, and the distance of two points of it is at most 4.3: 24 u of 4.5, 108 u,
   bounds the rounding of the ends, of the line, and of the distance of a point of the needle from
   the line; 192 u is more. If the error is large compared with the margin of the box around the
   needle, nothing is known: the segment may be anywhere. */
static double needle_segment_err(double end_err)
{
    return end_err < 0.25 ? 192 * LRCSI_U + 2 * end_err : 4;
}

static void segment_ends(lrcsi_cells_segment *e, const double (*end)[2])
{
    for (int n = 0; n < 2; n++) {
        e->end[n][0] = end[n][0];
        e->end[n][1] = end[n][1];
    }
    lrcsi_line_through(end[0], end[1], e->line);
    e->length = lrcsi_length_flat(end[1][0] - end[0][0], end[1][1] - end[0][1]);
    e->line_err = e->err;
}

/* Is neither of an edge's facets in front of f anywhere? */
static int edge_is_behind(lrcsi_facet_cells *cells, const uint32_t owner[2])
{
    int behind = 1;
    for (int i = 0; i < 2 && behind; i++) {
        if (owner[i] != LRCS_NONE && lrcsi_facet_cells_is_candidate(cells, owner[i])) {
            unsigned char *order = &cells->order[owner[i]];
            if (*order == LRCSI_ORDER_NOT_COMPUTED) {
                *order = (unsigned char)lrcsi_facet_cells_order(cells, owner[i]);
            }
            behind = *order == LRCSI_ORDER_BEHIND;
        }
    }
    return behind;
}

/* Adds an edge, unless its facets are behind f. 0 if there is no room. */
static int add_facet_edge(lrcsi_facet_cells *cells, uint32_t edge)
{
    lrcsi_division *d = &cells->division;
    const lrcs_prepared *p = d->view->prepared;
    const lrcsi_edge *of = &p->topology.edge[edge];
    lrcsi_cells_segment *e = lrcsi_division_edge(d, edge);
    if (!e) {
        return 0;
    }
    if (e->edge == LRCS_NONE && edge_is_behind(cells, e->owner)) {
        d->segment_count--;
        return 1;
    }
    double end[2][2];
    const double *from = p->vertex[of->low].x;
    const double *to = p->vertex[of->high].x;
    if (cells->frame.needle) {
        e->err = needle_segment_err(lrcsi_needle_segment(cells->frame.needle, from, to, end));
    } else {
        const double away[2] = {lrcsi_target_coordinates(&cells->frame, from, end[0]),
                                lrcsi_target_coordinates(&cells->frame, to, end[1])};
        e->err = 32 * LRCSI_U * lrcsi_target_segment(&cells->frame, end, away);
    }
    segment_ends(e, (const double(*)[2])end);
    return 1;
}

/* Finds the depth order of a facet that meets the interior of f, and adds the segments due to it. 0
   if there is no room. */
static int add_facet_contact(lrcsi_facet_cells *cells, uint32_t other)
{
    lrcsi_division *d = &cells->division;
    lrcsi_contact contact;
    int side = lrcsi_sample_side(d->view, other, cells->facet);
    if (side < 0) {
        cells->order[other] = LRCSI_ORDER_BEHIND;
        return 1;
    }
    int kind = lrcsi_contact_find(&cells->frame, other, &contact);
    int is_line = kind != LRCSI_CONTACT_POINT && kind != LRCSI_CONTACT_UNKNOWN;
    cells->order[other] = side > 0 || kind == LRCSI_CONTACT_FLAT ? LRCSI_ORDER_FRONT
                          : is_line                              ? LRCSI_ORDER_CONTACT
                                                                 : LRCSI_ORDER_UNDECIDED;
    cells->contact[other] = d->segment_count; /* read of CONTACT only */
    if (kind == LRCSI_CONTACT_POINT) {
        return 1;
    }
    if (kind == LRCSI_CONTACT_FLAT || kind == LRCSI_CONTACT_UNKNOWN) {
        int done = 1;
        for (int k = 0; k < 3 && done; k++) {
            done = add_facet_edge(cells, d->view->prepared->topology.facet_edge[other].corner[k]);
        }
        return done;
    }
    lrcsi_cells_segment *e = lrcsi_division_segment(d);
    if (!e) {
        return 0;
    }
    e->err = cells->frame.needle ? needle_segment_err(contact.corner_err + contact.position_err)
                                 : 32 * LRCSI_U * contact.reach + contact.position_err;
    e->owner[0] = cells->facet;
    e->owner[1] = other;
    e->contact = kind;
    segment_ends(e, (const double(*)[2])contact.end);
    return 1;
}

int lrcsi_facet_cells_segments(lrcsi_facet_cells *cells)
{
    lrcsi_division *d = &cells->division;
    const lrcsi_intersections *intersections = &d->view->prepared->intersections;
    for (uint32_t i = intersections->first[cells->facet];
         i < intersections->first[cells->facet + 1]; i++) {
        const lrcsi_intersection *contact = &intersections->entry[i];
        if (lrcsi_facet_cells_is_candidate(cells, contact->other) &&
            lrcsi_sample_contact_hides(d->view, cells->facet, contact) &&
            !add_facet_contact(cells, contact->other)) {
            return 0;
        }
    }
    lrcsi_crossings_find(&cells->classification->search, cells->facet, d->meter, &cells->crossings);
    for (uint32_t i = 0; i < cells->crossings.count; i++) {
        if (!add_facet_edge(cells, cells->crossings.edge[i])) {
            return 0;
        }
    }
    return lrcsi_meter_take(d->meter, (uint64_t)cells->candidate_count + d->segment_count);
}
