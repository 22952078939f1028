/* SPDX-License-Identifier: MIT */
/* The cuts of a facet, and which of them come near a part of it. That no other edge or contact can
   divide the facet is exact (visibility/uniform/classify.h); only positions are computed in doubles.

   Errors. In the facet's frame, let d be the facet's diameter, and r the largest distance, in
   space, of a segment's ends from the facet's first corner; the part of a long segment that is far
   from the facet is removed first. The ends have a position error of 10 u r (visibility/cells/target.h),
   those of a contact 16 u r and in addition its position_err (visibility/cells/contact.h); the line
   through them has 2 u r more. The computed side of a line may be wrong only within 4 u (r + d) of
   the line. A computed point where a line meets a side of a cell lies within that plus 8 u d of the
   line. So if the computed distance of a segment from a shape exceeds WIDTH (r + d) plus
   position_err, the segment does not meet the shape. If a cell was cut along a segment, or its
   computed shape lies on one side of the segment's line, then the segment lies within that width of
   the line, and the cell lies on one side of the line, except for a strip of that width. (24 u (r +
   d) would be enough, and 30 u (r + d) for a contact.)

   In a needle's frame (visibility/cells/target.h) the errors of the ends are smaller. Segments are
   clipped to a box around the needle that extends beyond it by 1. So the part in the box of a
   segment that meets the needle is at least 1 long, unless an end of the segment itself is in the
   box.

   A contact with a coplanar facet divides the target along the outline of that facet: on either
   side of the outline the facet hides all or nothing. The outline is also used if the line of a
   contact is unknown; inside it, samples then do not decide (test/visibility/reference/cover.c). A
   contact in a point divides nothing: paths can avoid the point. */
#include "visibility/reference/cut.h"

#include <string.h>

#include "base/range.h"
#include "base/work.h"
#include "visibility/base/sample.h"

#define U     0x1p-53
#define WIDTH (32 * U)

/* Larger than the box to which segments are clipped in a needle's frame. */
#define BEYOND 4

/* --- lists ------------------------------------------------------------------------------------ */

static ref_cut *cut_new(ref_cuts *cuts, const double from[2], const double to[2], double width)
{
    ref_cut *e = &cuts->cut[cuts->count++];
    for (int k = 0; k < 2; k++) {
        e->line.at[k] = from[k];
        e->line.to[k] = to[k] - from[k];
        e->low[k] = lrcsi_min(from[k], to[k]) - width;
        e->high[k] = lrcsi_max(from[k], to[k]) + width;
    }
    if (e->line.to[0] == 0 && e->line.to[1] == 0) {
        e->line.to[0] = 1; /* any line through the point is valid */
    }
    e->width = width;
    e->components = 0;
    e->other = LRCS_NONE;
    return e;
}

static double width_of(const ref_cuts *cuts, double reach)
{
    return WIDTH * (lrcsi_max(reach, cuts->target->reach) + cuts->target->diameter);
}

/* In a needle's frame segments are clipped to points within 3 of the first corner, so r + d is
   below 4.5. The error of the ends is that of rounding, 3 u, and position_err. If position_err is
   large in comparison with 1, by which the box extends beyond the needle, the segment may be
   anywhere. */
static double width_in_needle(double position_err)
{
    return position_err < 0.25 ? WIDTH * 6 + 2 * position_err : BEYOND;
}

static void cut_component(ref_cut *e, uint32_t component)
{
    for (uint32_t i = 0; i < e->components && i < REF_CUT_COMPONENTS; i++) {
        if (e->component[i] == component) {
            return;
        }
    }
    if (e->components < REF_CUT_COMPONENTS) {
        e->component[e->components] = component;
    }
    e->components++;
}

static void cuts_edge(ref_cuts *cuts, const lrcsi_classification *classification, uint32_t edge)
{
    const lrcs_prepared *p = classification->view->prepared;
    const lrcsi_edge *e = &p->topology.edge[edge];
    const double *from = p->vertex[e->low].x;
    const double *to = p->vertex[e->high].x;
    double end[2][2];
    double width = 0;
    if (cuts->target->needle) {
        width = width_in_needle(lrcsi_needle_segment(cuts->target->needle, from, to, end));
    } else {
        const double away[2] = {lrcsi_target_coordinates(cuts->target, from, end[0]),
                                lrcsi_target_coordinates(cuts->target, to, end[1])};
        width = width_of(cuts, lrcsi_target_segment(cuts->target, end, away));
    }
    ref_cut *cut = cut_new(cuts, end[0], end[1], width);
    for (uint32_t i = 0; i < e->uses; i++) {
        uint32_t facet = p->topology.use[e->first_use + i].facet;
        if (lrcsi_view_casts(classification->view, facet)) {
            cut_component(cut, classification->component[facet]);
        }
    }
}

/* The event edges that cross the facet; not all of them if the view's meter is spent. */
static void cuts_crossing(ref_cuts *cuts, const lrcsi_classification *classification,
                          const lrcsi_crossings *crossings)
{
    const lrcsi_edge *edge = classification->view->prepared->topology.edge;
    for (uint32_t i = 0; i < crossings->count; i++) {
        if (!lrcsi_meter_take(NULL, edge[crossings->edge[i]].uses)) {
            return;
        }
        cuts_edge(cuts, classification, crossings->edge[i]);
    }
}

/* The sides of a facet that is in contact with the target. */
static void cuts_outline(ref_cuts *cuts, uint32_t other, const lrcsi_contact *c)
{
    const lrcsi_target *t = cuts->target;
    for (int k = 0; k < 3; k++) {
        int next = (k + 1) % 3;
        const double away[2] = {c->distance[k], c->distance[next]};
        double end[2][2];
        double width = 0;
        memcpy(end[0], c->corner[k], sizeof end[0]);
        memcpy(end[1], c->corner[next], sizeof end[1]);
        if (t->needle) {
            width = width_in_needle(
                lrcsi_needle_segment(t->needle, lrcsi_target_frame_corner(t->view, other, k),
                                     lrcsi_target_frame_corner(t->view, other, next), end));
        } else {
            width = width_of(cuts, lrcsi_target_segment(t, end, away));
        }
        cut_new(cuts, end[0], end[1], width);
    }
}

static void cuts_contact(ref_cuts *cuts, const lrcsi_classification *classification, uint32_t other)
{
    lrcsi_contact c;
    int kind = lrcsi_contact_find(cuts->target, other, &c);
    uint32_t first = cuts->count;
    if (kind == LRCSI_CONTACT_FLAT || kind == LRCSI_CONTACT_UNKNOWN) {
        cuts_outline(cuts, other, &c);
    } else if (kind != LRCSI_CONTACT_POINT) {
        double width = cuts->target->needle ? width_in_needle(c.corner_err + c.position_err)
                                            : width_of(cuts, c.reach) + c.position_err;
        cut_new(cuts, c.end[0], c.end[1], width);
    }
    for (uint32_t i = first; i < cuts->count; i++) {
        cuts->cut[i].other = other;
        cuts->cut[i].kind = kind;
        cut_component(&cuts->cut[i], classification->component[other]);
    }
}

/* Each edge can cross a facet, and each contact of a facet can divide it along three sides. */
size_t ref_cuts_need(const lrcs_prepared *prepared)
{
    const lrcsi_intersections *intersections = &prepared->intersections;
    size_t most = 0;
    for (uint32_t f = 0; f < prepared->scene->facet_count; f++) {
        size_t count = lrcsi_intersection_of(intersections, f);
        most = count > most ? count : most;
    }
    size_t room = prepared->topology.edge_count + 3 * most;
    return lrcsi_work_add(lrcsi_work_bytes(room, sizeof(ref_cut)),
                          lrcsi_work_bytes(room, sizeof(uint32_t)));
}

int ref_cuts_make(lrcsi_classification *classification, const lrcsi_target *target, lrcs_work *work,
                  lrcsi_crossings *crossings, ref_cuts *cuts)
{
    const lrcsi_intersections *intersections = &target->view->prepared->intersections;
    uint32_t first = intersections->first[target->facet];
    uint32_t end = intersections->first[target->facet + 1];
    lrcsi_crossings_find(&classification->search, target->facet, NULL, crossings);
    size_t room = crossings->count + 3 * (size_t)(end - first);
    *cuts = (ref_cuts){.target = target};
    cuts->cut = lrcsi_work_take(work, room, sizeof *cuts->cut);
    cuts->list = lrcsi_work_take(work, room, sizeof *cuts->list);
    if (!cuts->cut || !cuts->list) {
        return LRCS_E_MEMORY;
    }
    cuts_crossing(cuts, classification, crossings);
    for (uint32_t i = first; i < end; i++) {
        if (lrcsi_sample_contact_hides(target->view, target->facet, &intersections->entry[i])) {
            cuts_contact(cuts, classification, intersections->entry[i].other);
        }
    }
    for (uint32_t i = 0; i < cuts->count; i++) {
        cuts->list[i] = i;
    }
    return LRCS_OK;
}

/* --- cells ------------------------------------------------------------------------------------ */

int ref_cut_ends(const ref_cut *e, uint32_t component)
{
    return e->components > REF_CUT_COMPONENTS ||
           (e->components > 0 && e->component[0] == component) ||
           (e->components > 1 && e->component[1] == component);
}

uint32_t ref_cuts_keep(ref_cuts *cuts, const lrcsi_clip_polygon *shape, uint32_t count)
{
    double low[2];
    double high[2];
    uint32_t kept = 0;
    lrcsi_clip_box(shape, low, high);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t index = cuts->list[i];
        const ref_cut *e = &cuts->cut[index];
        if (e->low[0] <= high[0] && e->high[0] >= low[0] && e->low[1] <= high[1] &&
            e->high[1] >= low[1] && ref_clip_meets(shape, &e->line, e->width)) {
            cuts->list[i] = cuts->list[kept];
            cuts->list[kept++] = index;
        }
    }
    return kept;
}

uint32_t ref_cuts_of(const ref_cuts *cuts, uint32_t count, uint32_t component)
{
    uint32_t of = 0;
    for (uint32_t i = 0; i < count; i++) {
        of += (uint32_t)ref_cut_ends(&cuts->cut[cuts->list[i]], component);
    }
    return of;
}
