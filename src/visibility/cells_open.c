/* SPDX-License-Identifier: MIT */
/* The cell that a block begins as. Its segments are events of the view, contacts of its facets, and
   edges that count as events though two facets continue each other across them. What a contact is:
   visibility/cells_cover.c. */
#include "visibility/cells_open.h"

#include "base/constant.h"
#include "base/range.h"
#include "visibility/contact.h"
#include "visibility/grid.h"

lrcsi_cells_segment *lrcsi_cells_segment_new(lrcsi_cells_work *c)
{
    if (c->segment_count == c->segment_room) {
        return NULL;
    }
    c->segments[c->segment_count] = c->segment_count;
    lrcsi_cells_segment *e = &c->segment[c->segment_count++];
    *e = (lrcsi_cells_segment){.owner = {LRCS_NONE, LRCS_NONE}, .edge = LRCS_NONE};
    return e;
}

lrcsi_cells_segment *lrcsi_cells_edge(lrcsi_cells_work *c, uint32_t edge)
{
    const lrcsi_topology *t = &c->view->prepared->topology;
    lrcsi_cells_segment *e = lrcsi_cells_segment_new(c);
    uint32_t owners = 0;
    for (uint32_t i = 0; e && i < t->edge[edge].uses; i++) {
        uint32_t facet = t->use[t->edge[edge].first_use + i].facet;
        if (lrcsi_grid_casts(c->view, facet)) {
            if (owners < 2) {
                e->owner[owners] = facet;
            }
            owners++;
        }
    }
    if (owners > 2) {
        e->edge = edge;
    }
    return e;
}

static int open_edge(lrcsi_cells_work *c, uint32_t edge)
{
    const lrcsi_edge *of = &c->view->prepared->topology.edge[edge];
    lrcsi_cells_segment *e = lrcsi_cells_edge(c, edge);
    if (!e) {
        return 0;
    }
    const lrcsi_cells_point *end[2] = {lrcsi_cells_vertex(&c->frame, of->low),
                                       lrcsi_cells_vertex(&c->frame, of->high)};
    for (int i = 0; i < 2; i++) {
        e->end[i][0] = end[i]->local[0].hi;
        e->end[i][1] = end[i]->local[1].hi;
        e->end[i][2] = end[i]->z;
    }
    e->off = lrcsi_most(end[0]->off, end[1]->off);
    e->line_off = lrcsi_most(end[0]->line_off, end[1]->line_off);
    e->z_err = lrcsi_most(end[0]->z_err, end[1]->z_err);
    e->length = lrcsi_cells_line(end[0], end[1], e->line);
    return 1;
}

/* Does the surface go on across all sides of a facet that are no events of the view? */
static int goes_on(const lrcsi_cells_work *c, uint32_t facet)
{
    return (c->kind[facet] & LRCSI_CELLS_APART) == 0 &&
           c->view->prepared->intersections.rim[facet] <= 1;
}

/* Edges across which two facets continue each other are events nevertheless where one of these
   meets others in its plane, or along parts of the edge. */
static int open_joins(lrcsi_cells_work *c, uint32_t facet)
{
    if (goes_on(c, facet)) {
        return 1;
    }
    for (int k = 0; k < 3; k++) {
        uint32_t other = lrcsi_cells_joined(c->view, facet, k);
        if (other != LRCS_NONE && lrcsi_cells_next(c->view, c->kind, facet, k) == LRCS_NONE &&
            !open_edge(c, c->view->prepared->topology.facet_edge[facet].corner[k])) {
            return 0;
        }
    }
    return 1;
}

static int touches_back(const lrcs_prepared *p, uint32_t facet, uint32_t other)
{
    for (uint32_t i = p->intersections.first[other]; i < p->intersections.first[other + 1]; i++) {
        if (p->intersections.entry[i].other == facet) {
            return 1;
        }
    }
    return 0;
}

/* The segments in which others of the list meet the inside of a facet. */
static int open_contacts(lrcsi_cells_work *c, uint32_t facet)
{
    const lrcsi_view *view = c->view;
    const lrcsi_intersections *intersections = &view->prepared->intersections;
    lrcsi_target target = {.view = NULL};
    for (uint32_t i = intersections->first[facet]; i < intersections->first[facet + 1]; i++) {
        uint32_t other = intersections->entry[i].other;
        if (intersections->entry[i].kind != LRCSI_INTERSECTION_CROSS ||
            c->listed[other] != c->look ||
            (other < facet && touches_back(view->prepared, facet, other))) {
            continue;
        }
        if (!target.view) {
            lrcsi_target_make(view, facet, &target);
        }
        lrcsi_contact contact;
        int kind = lrcsi_contact_find(&target, other, &contact);
        if (kind == LRCSI_CONTACT_POINT) {
            continue;
        }
        if (kind == LRCSI_CONTACT_FLAT || kind == LRCSI_CONTACT_UNKNOWN) {
            c->kind[facet] |= LRCSI_CELLS_VAGUE;
            c->kind[other] |= LRCSI_CELLS_VAGUE;
            continue;
        }
        lrcsi_cells_segment *e = lrcsi_cells_segment_new(c);
        if (!e) {
            return 0;
        }
        const lrcs_point *vertex = view->prepared->vertex;
        uint32_t corner = view->prepared->scene->facet[facet].corner[0];
        for (int k = 1; k < 3 && vertex[corner].x != target.origin; k++) {
            corner = view->prepared->scene->facet[facet].corner[k];
        }
        const lrcsi_cells_point *origin = lrcsi_cells_vertex(&c->frame, corner);
        for (int n = 0; n < 2; n++) {
            e->end[n][0] = origin->local[0].hi + contact.end[n][0];
            e->end[n][1] = origin->local[1].hi + contact.end[n][1];
        }
        e->end[0][2] = e->end[1][2] = 0;
        e->off = origin->off + 32 * LRCSI_U * contact.reach + contact.position_err;
        e->owner[0] = facet;
        e->owner[1] = other;
        e->contact = kind;
        e->line_off = e->off;
        e->length = lrcsi_line_through(e->end[0], e->end[1], e->line);
    }
    return 1;
}

/* Lists the facets near a cell. Who continues a facet is the same in all blocks. */
static void open_facets(lrcsi_cells_work *c, size_t block, lrcsi_cells_cell *cell)
{
    const lrcsi_cells_lists *b = &c->grid.facets;
    double g = 16 * LRCSI_U * c->reach;
    for (uint32_t i = b->first[block]; i < b->first[block + 1]; i++) {
        uint32_t index = b->item[i];
        lrcsi_cells_facet *f = &c->facet[index];
        lrcsi_cells_facet_make(&c->frame, index, f);
        c->found[index] |= f->thin ? LRCSI_CELLS_OPEN : 0;
        if (lrcsi_cells_facet_near(f, &cell->shape, cell->shape.corner[0], cell->shape.corner[2],
                                   g)) {
            if ((c->kind[index] & LRCSI_CELLS_LINKED) == 0) {
                for (int k = 0; k < 3; k++) {
                    f->next[k] = lrcsi_cells_next(c->view, c->kind, index,
                                                  lrcsi_cells_side_number(c->view, index, k));
                }
                c->kind[index] |= LRCSI_CELLS_LINKED;
            }
            c->facets[cell->facets++] = index;
            c->listed[index] = c->look;
            c->off = lrcsi_most(c->off, f->off);
        }
    }
}

/* Its segments likewise. 0 if they find no room. */
static int open_segments(lrcsi_cells_work *c, size_t block, lrcsi_cells_cell *cell)
{
    const lrcsi_cells_lists *b = &c->grid.events;
    for (uint32_t i = 0; i < cell->facets; i++) {
        if (!open_contacts(c, c->facets[i]) || !open_joins(c, c->facets[i])) {
            return 0;
        }
    }
    for (uint32_t i = b->first[block]; i < b->first[block + 1]; i++) {
        if (!open_edge(c, c->grid.classification->events.edge[b->item[i]])) {
            return 0;
        }
    }
    cell->segments = c->segment_count;
    return 1;
}

size_t lrcsi_cells_segments_most(const lrcsi_cells_work *c)
{
    const lrcsi_intersections *intersections = &c->view->prepared->intersections;
    const lrcsi_cells_lists *facets = &c->grid.facets;
    const lrcsi_cells_lists *events = &c->grid.events;
    size_t most = 0;
    for (size_t b = 0; b < (size_t)c->grid.side * c->grid.side; b++) {
        size_t count = events->first[b + 1] - events->first[b];
        for (uint32_t i = facets->first[b]; i < facets->first[b + 1]; i++) {
            uint32_t f = facets->item[i];
            count += intersections->first[f + 1] - intersections->first[f];
            count += goes_on(c, f) ? 0 : 3;
        }
        most = count > most ? count : most;
    }
    return most;
}

int lrcsi_cells_open(lrcsi_cells_work *c, size_t block, lrcsi_cells_cell *cell)
{
    c->segment_count = 0;
    c->off = 0;
    open_facets(c, block, cell);
    return open_segments(c, block, cell);
}
