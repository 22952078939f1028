/* SPDX-License-Identifier: MIT */
/* Adds up, for each facet, the fractions of its area near event edges and near facets of other
   parts. Nothing is decided exactly: every distance is increased by the errors of the positions
   between which it is measured. integrate/wall/tessellation.c decides what the uncertain areas add to
   the bound of sigma. */
#include "visibility/proximity/proximity_band.h"

#include <math.h>

#include "base/disjoint.h"
#include "base/range.h"
#include "base/work.h"
#include "scene/proximity.h"
#include "visibility/proximity/depth_order.h"
#include "visibility/proximity/edge_rectangle.h"
#include "visibility/proximity/edge_search.h"
#include "visibility/proximity/outline.h"
#include "visibility/proximity/proximity_events.h"

/* More than the rounding error of a facet's cosine, of the unit normals and the direction: some 30
   u (facets that rounding may have turned further count as grazing: lrcsi_proximity.grazing_cos).
 */
#define COS_ERR 1e-9
/* The projected areas of facets with a larger cosine than this are accurate to COS_ERR, relative:
   30 u / 1e-4 is below 1e-10. */
#define COS_MIN 1e-4
/* A proof about a part (visibility/proximity/depth_order.h) is used for a facet only if it holds for all but
   this fraction of it. */
#define PROOF_FRACTION_MAX 0x1p-20
/* Pairs of parts of which it is remembered whether one is behind the other. Facets are searched
   part by part, so that few pairs are needed at a time. */
#define DEPTH_PAIRS 64u

/* A pair of parts, `back` perhaps behind `front`; front == back: none yet. */
typedef struct band_pair {
    uint32_t front, back;
    lrcsi_depth_order order;
} band_pair;

/* Bounds in view coordinates. */
typedef struct band_box {
    double low[3], high[3];
} band_box;

typedef struct band_job {
    /* Given: */
    const lrcsi_view *view;
    lrcsi_meter *meter;

    /* Made first: */
    lrcsi_proximity_events events;
    band_box *box;          /* part: that of its facets in the view */
    band_box curved;        /* of all facets of curved parts */
    lrcsi_outline *outline; /* part */
    const lrcsi_body *body; /* part; NULL: no shape has a closed form, and pairs are not tried */

    /* Returned (lrcsi_proximity_band): */
    double *mismatch, *gain, *loss, *rows;
    double *gain_aligned, *loss_aligned;
    unsigned char *free_sides;
    lrcsi_part_set *parts;

    /* Kept, so that nothing is computed again: */
    lrcsi_outline_areas *areas; /* event: the areas along it between the outlines of the true shape
                                   and of its facets; gain < 0: not computed yet */
    uint32_t *seen[2]; /* event: 1 + the last facet for which it was considered, without and with
                          facet_search.aligned */
    band_pair *pair;   /* DEPTH_PAIRS of them: what was found last */
} band_job;

static uint32_t band_part(const band_job *job, uint32_t facet)
{
    return job->view->prepared->scene->facet_part[facet];
}

/* Lists the events, and takes memory for what is found of each. */
static int band_events(band_job *job, lrcs_work *work)
{
    int status = lrcsi_proximity_events_make(job->view, work, &job->events);
    const uint32_t count = status == LRCS_OK ? job->events.count : 0;
    job->areas = lrcsi_work_take(work, count, sizeof *job->areas);
    for (int i = 0; i < 2; i++) {
        job->seen[i] = lrcsi_work_take_zero(work, count, sizeof *job->seen[i]);
    }
    if (status == LRCS_OK && (!job->areas || !job->seen[0] || !job->seen[1])) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t i = 0; i < count; i++) {
        job->areas[i].gain = -1;
    }
    return status;
}

/* --- one facet and one event ------------------------------------------------------------------ */

/* 1 if an edge of the part is a rim whose wall faces the laser, or may face it; also 1 if the limit
   of steps is reached. */
static int own_rim(const band_job *job, const lrcsi_edge *edge, uint32_t part)
{
    const lrcs_prepared *p = job->view->prepared;
    const lrcsi_edge_use *use = p->topology.use + edge->first_use;
    uint32_t count = 0;
    int facing = 0;
    if (!lrcsi_meter_take(job->meter, edge->uses)) {
        return 1;
    }
    for (uint32_t i = 0; i < edge->uses; i++) {
        if (band_part(job, use[i].facet) != part || p->skip[use[i].facet]) {
            continue;
        }
        const lrcsi_normal *n = &p->normal[use[i].facet];
        const double *d = job->view->direction;
        double cosine = (n->high[0] * d[0] + n->high[1] * d[1] + n->high[2] * d[2]) /
                        (n->length * job->view->length);
        count++;
        facing |= cosine > -(p->scene->part[part].bounds.patch.turn + COS_ERR);
    }
    return count == 1 && facing;
}

/* The distance in projection within which an event edge may change what is visible of a facet,
   unless it is behind the facet; 0 if it cannot. In the facet's own part only the rims of openings
   can. */
static double event_slack(const band_job *job, uint32_t facet, uint32_t event, double lateral,
                          int aligned)
{
    const lrcs_prepared *p = job->view->prepared;
    uint32_t part = band_part(job, facet);
    if (aligned) {
        return job->events.part[event] == part
                   ? 0
                   : lrcsi_proximity_slack_aligned(p, job->events.part[event]);
    }
    if (job->events.part[event] == part) {
        const lrcsi_edge *edge = &p->topology.edge[job->events.edge[event]];
        return own_rim(job, edge, part) ? 2 * p->proximity.reach[part] : 0;
    }
    return lrcsi_proximity_slack_across(p, part, job->events.part[event], lateral);
}

/* --- one facet -------------------------------------------------------------------------------- */

/* The search for event edges near a facet. */
typedef struct facet_search {
    lrcsi_edge_search where;
    int inside; /* the laser may see the facet through an opening of its own part */
    lrcsi_displacement displacement;
    double lateral; /* lrcsi_displacement_across the line of sight; negative: not computed yet */
    int aligned; /* 1: points of facet and true surface correspond if their projections are equal */
} facet_search;

static facet_search search_begin(const band_job *job, uint32_t facet)
{
    const lrcs_prepared *p = job->view->prepared;
    const uint32_t part = band_part(job, facet);
    double near = 2 * (p->proximity.reach[part] + p->proximity.max_hausdorff) + LRCSI_PROXIMITY_ERR;
    return (facet_search){
        .where = lrcsi_edge_search_make(job->view, &job->events.grid, facet, near),
        .inside = job->view->facing[facet] < 0 && !lrcsi_proximity_closed(p, part),
        .lateral = -1};
}

/* Adds a fraction of a facet's area, near one of these parts, where the facets may hide what the
   true shapes do not, or the reverse. */
static void add_both(band_job *job, uint32_t facet, double fraction, lrcsi_part_set parts)
{
    job->parts[facet] |= parts;
    job->mismatch[facet] += fraction;
    job->gain[facet] += fraction;
    job->loss[facet] += fraction;
}

/* What a plane between two parts proves; it is kept in job->pair. */
static const lrcsi_depth_order *depth_order(band_job *job, uint32_t front, uint32_t back)
{
    band_pair *pair = &job->pair[(front + 7 * back) % DEPTH_PAIRS]; /* any spread serves */
    if (pair->front != front || pair->back != back) {
        *pair = (band_pair){
            front, back,
            lrcsi_depth_order_make(&job->body[front], &job->body[back], job->view->unit)};
    }
    return &pair->order;
}

/* Does a proof about a facet's part hold for the facet, except for the fraction *unproved? It does
   not if that is not small: then the facet lies in the plane. */
static int proof_holds(const band_job *job, uint32_t facet, const lrcsi_order_proof *proof,
                       double *unproved)
{
    double fraction = proof->known ? lrcsi_order_unproved(proof, job->view->prepared, facet) : 1;
    *unproved = fraction > PROOF_FRACTION_MAX ? 0 : fraction;
    return fraction <= PROOF_FRACTION_MAX;
}

/* Is a part behind the facet's own part (visibility/proximity/depth_order.h), except for a fraction of the
   facet? */
static int part_is_behind(band_job *job, uint32_t facet, uint32_t other, double *unproved)
{
    *unproved = 0;
    return job->body &&
           proof_holds(job, facet, &depth_order(job, band_part(job, facet), other)->front_is_free,
                       unproved);
}

/* Adds the fraction of a facet for which a proof about another part does not hold. */
static void add_unproved(band_job *job, uint32_t facet, uint32_t other, double fraction)
{
    if (fraction > 0) {
        add_both(job, facet, fraction, lrcsi_part_set_of(other));
        job->rows[facet] += fraction;
    }
}

/* Is gain possible only on the inner side of a part's event edges? It is for parts without openings
   or without reach, and for parts with one opening if their boxes do not contain points of the
   facet's patch. */
static int gain_is_inside(const band_job *job, const facet_search *search, uint32_t part)
{
    const lrcs_prepared *p = job->view->prepared;
    const band_box *box = &job->box[part];
    int openings = p->proximity.reach[part] > 0 ? lrcsi_proximity_openings(p, part) : 0;
    int apart = 0;
    for (int k = 0; k < 3; k++) {
        apart |= search->where.low[k] > box->high[k] || search->where.high[k] < box->low[k];
    }
    return openings == 0 || (openings == 1 && apart);
}

/* --- facets behind a shape -------------------------------------------------------------------- */

/* Is the outline of a part known, and the part in front of a facet: because the facet is flat, and
   the part in front of its plane (*err: as for lrcsi_outline_in_front); or because a plane
   separates it from the facet's own part, except for a fraction of the facet? */
static int part_in_front(band_job *job, uint32_t facet, uint32_t part, double *err,
                         double *unproved)
{
    const lrcs_prepared *p = job->view->prepared;
    uint32_t own = band_part(job, facet);
    int is_flat = p->scene->facet_smooth[facet] == 0 || p->proximity.reach[own] == 0;
    *err = *unproved = 0;
    if (!job->outline[part].known) {
        return 0;
    }
    if (is_flat && job->view->facing[facet] > 0 &&
        lrcsi_outline_in_front(&job->outline[part], job->view, facet, err)) {
        return 1;
    }
    *err = 0;
    return job->body &&
           proof_holds(job, facet, &depth_order(job, part, own)->back_by_outline, unproved);
}

/* Is an event edge a rim inside the outline of its part? */
static int rim_is_inside(const band_job *job, uint32_t event)
{
    const lrcsi_view *view = job->view;
    const lrcsi_edge *edge = &view->prepared->topology.edge[job->events.edge[event]];
    const lrcsi_edge_use *use = view->prepared->topology.use + edge->first_use;
    uint32_t facets = 0;
    int facing = 0;
    for (uint32_t i = 0; i < edge->uses; i++) {
        if (band_part(job, use[i].facet) == job->events.part[event]) {
            facing = view->facing[use[i].facet];
            facets++;
        }
    }
    return facets == 1 &&
           lrcsi_outline_inside(&job->outline[job->events.part[event]], view, facing);
}

/* The largest fractions of a facet, behind the event's part, that can be gained and lost along an
   event edge; infinite if nothing is known. delta: as in visibility/proximity/outline.h. */
static void outline_fractions(band_job *job, uint32_t facet, uint32_t event, double delta,
                              double *gain, double *loss)
{
    const lrcsi_view *view = job->view;
    const lrcsi_edge *edge = &view->prepared->topology.edge[job->events.edge[event]];
    const lrcsi_outline *outline = &job->outline[job->events.part[event]];
    double projected = lrcsi_view_projected(view, facet);
    double whole = 0.5 * view->prepared->normal[facet].length;
    lrcsi_outline_areas *areas = &job->areas[event];
    *gain = *loss = HUGE_VAL;
    if (!(projected > COS_MIN * whole) || !(delta <= outline->k)) {
        return;
    }
    if (areas->gain < 0) {
        const double *a = view->point[edge->low].x;
        const double *b = view->point[edge->high].x;
        *areas = rim_is_inside(job, event)
                     ? (lrcsi_outline_areas){0, 0, 0}
                     : lrcsi_outline_areas_make(outline, a, b, job->events.side[event]);
    }
    *gain = (areas->gain + areas->width * delta) / projected * (1 + COS_ERR);
    *loss = (areas->loss + areas->width * delta) / projected * (1 + COS_ERR);
}

/* The rectangle about an event edge near a facet. slack: event_slack of the displacement across the
   line of sight, `wider` included, which counts at the ends of the edge. To its sides only the
   component perpendicular to the edge counts. */
static lrcsi_edge_rectangle event_rectangle(const band_job *job, uint32_t facet, uint32_t event,
                                            const facet_search *search, double slack, double wider)
{
    const lrcsi_topology *topology = &job->view->prepared->topology;
    lrcsi_edge_rectangle box = lrcsi_edge_rectangle_make(
        job->view, facet, &topology->edge[job->events.edge[event]], slack);
    if (box.has_sides && !search->aligned) {
        double across = lrcsi_displacement_along(&search->displacement, box.across) +
                        box.rotation_err * search->lateral;
        across = event_slack(job, facet, event, lrcsi_min(across, search->lateral), 0) + wider;
        box.half_width = lrcsi_min(across, slack) + box.err;
    }
    return box;
}

/* The fractions of a facet near an event edge. */
typedef struct event_fractions {
    double area, rows; /* of its area, of its rows, where the edge matters */
    double gain, loss;
    double unproved; /* where a proof about the edge's part does not hold */
} event_fractions;

/* Finds the fractions near an event edge:
   1. none if it is too far away, or an edge of the facet's own part of which it sees no inside;
   2. none but what a proof leaves open if its part is behind the facet's;
   3. what of the facet lies in the rectangle about the edge, unless the edge is behind it;
   4. all of that as gain and loss where the part lies on both sides of the edge; else what is on
      the inner side as gain, on the outer side as loss;
   5. but no more than the area between outlines, where the part is in front of the facet.
   Returns 0 if there are none. */
static int event_fractions_make(band_job *job, uint32_t facet, uint32_t event, facet_search *search,
                                event_fractions *f)
{
    const lrcs_prepared *p = job->view->prepared;
    const lrcsi_edge *edge = &p->topology.edge[job->events.edge[event]];
    int is_own = job->events.part[event] == band_part(job, facet);
    int side = is_own ? 0 : job->events.side[event];
    *f = (event_fractions){.unproved = 0};
    if ((is_own && !search->inside) ||
        lrcsi_edge_search_excludes(&search->where, job->view->point[edge->low].x,
                                   job->view->point[edge->high].x)) {
        return 0; /* 1 */
    }
    if (search->lateral < 0) {
        search->displacement = lrcsi_proximity_displacement(p, facet);
        search->lateral = lrcsi_displacement_across(&search->displacement, job->view->unit);
    }
    double slack = event_slack(job, facet, event, search->lateral, search->aligned);
    double err = 0;
    if (!(slack > 0)) {
        return 0;
    }
    if (!is_own && part_is_behind(job, facet, job->events.part[event], &f->unproved)) { /* 2 */
        return f->unproved > 0;
    }
    int in_front =
        !is_own && part_in_front(job, facet, job->events.part[event], &err, &f->unproved);
    slack += err;
    lrcsi_edge_rectangle box = event_rectangle(job, facet, event, search, slack, err); /* 3 */
    lrcsi_slice slice = lrcsi_edge_rectangle_slice(job->view, facet, &box);
    if (slice.count == 0 || (!is_own && lrcsi_edge_rectangle_behind(
                                            job->view, facet, edge,
                                            (search->aligned ? LRCSI_PROXIMITY_NEAR : 1) *
                                                lrcsi_proximity_slack(p, band_part(job, facet),
                                                                      job->events.part[event])))) {
        return 0;
    }
    const uint32_t *vertex = p->scene->facet[facet].corner;
    const double *const corner[3] = {job->view->point[vertex[0]].x, job->view->point[vertex[1]].x,
                                     job->view->point[vertex[2]].x};
    double whole = 0.5 * p->normal[facet].length; /* 4 */
    double longest = lrcsi_proximity_longest(p, facet);
    f->rows = lrcsi_proximity_rows(p, facet, corner, &slice);
    f->area = f->gain = f->loss = lrcsi_slice_fraction(&slice, whole, longest);
    if (side == 0) {
        f->unproved = 0;
        return 1;
    }
    lrcsi_slice outer = lrcsi_edge_rectangle_half(slice, &box, -side);
    lrcsi_slice inner = lrcsi_edge_rectangle_half(slice, &box, side);
    if (gain_is_inside(job, search, job->events.part[event])) {
        f->gain = lrcsi_slice_fraction(&inner, whole, longest);
    }
    f->loss = lrcsi_slice_fraction(&outer, whole, longest);
    if (in_front) { /* 5 */
        double delta = (search->aligned ? 0 : search->lateral) + err;
        double gain;
        double loss;
        outline_fractions(job, facet, event, delta, &gain, &loss);
        f->area = lrcsi_min(f->area, gain + loss);
        f->gain = lrcsi_min(f->gain, gain);
        f->loss = lrcsi_min(f->loss, loss);
    } else {
        f->unproved = 0;
    }
    return 1;
}

/* Marks the sides of a facet near which an event edge of another part passes. The edges of a part
   behind the facet's own do not matter. */
static void mark_sides(band_job *job, uint32_t facet, uint32_t event, facet_search *search)
{
    const lrcsi_view *view = job->view;
    const lrcs_prepared *p = view->prepared;
    const lrcsi_edge *edge = &p->topology.edge[job->events.edge[event]];
    const uint32_t *corner = p->scene->facet[facet].corner;
    const uint32_t own = band_part(job, facet);
    const double slack = lrcsi_proximity_slack(p, own, job->events.part[event]);
    double unproved;
    if (job->events.part[event] == own || job->free_sides[facet] == 0 ||
        lrcsi_edge_search_excludes(&search->where, view->point[edge->low].x,
                                   view->point[edge->high].x) ||
        part_is_behind(job, facet, job->events.part[event], &unproved) ||
        lrcsi_edge_rectangle_behind(view, facet, edge, LRCSI_PROXIMITY_NEAR * slack)) {
        return;
    }
    const lrcsi_edge_rectangle box = lrcsi_edge_rectangle_make(
        view, facet, edge,
        lrcsi_proximity_slack_aligned(p, job->events.part[event]) + 2 * p->proximity.reach[own]);
    for (int k = 0; k < 3; k++) {
        if (lrcsi_edge_rectangle_meets(&box, view->point[corner[k]].x,
                                       view->point[corner[(k + 1) % 3]].x)) {
            job->free_sides[facet] &= (unsigned char)~(1 << k);
        }
    }
}

/* Adds the fractions near an event edge, which belong to the visibility of one of the two
   correspondences between facet and true surface. */
static void add_event(band_job *job, uint32_t facet, uint32_t event, facet_search *search)
{
    event_fractions f;
    if (search->aligned) {
        mark_sides(job, facet, event, search);
    }
    if (!event_fractions_make(job, facet, event, search, &f)) {
        return;
    }
    if (search->aligned) {
        job->gain_aligned[facet] += f.gain + f.unproved;
        job->loss_aligned[facet] += f.loss + f.unproved;
        return;
    }
    add_unproved(job, facet, job->events.part[event], f.unproved);
    if (f.area > 0) {
        job->parts[facet] |= lrcsi_part_set_of(job->events.part[event]);
        job->mismatch[facet] += f.area;
        job->gain[facet] += f.gain;
        job->loss[facet] += f.loss;
        job->rows[facet] += f.rows;
    }
}

/* Adds the fractions near all event edges. Returns 0 if the limit of steps is reached. */
static int add_events(band_job *job, uint32_t facet, facet_search *search)
{
    const lrcsi_grid *grid = &job->events.grid;
    lrcsi_view_box box = lrcsi_view_box_round(job->view, search->where.low, search->where.high);
    lrcsi_grid_rect cells = lrcsi_grid_buckets(grid, &box);
    int several = cells.y1 - cells.y0 > 1 && cells.x1 - cells.x0 > 1; /* rows and columns */
    uint32_t *seen = job->seen[search->aligned];
    for (uint32_t y = cells.y0; y < cells.y1; y++) {
        lrcsi_grid_rect row = several ? lrcsi_grid_row(grid, search->where.side, 3, y) : cells;
        lrcsi_grid_items items = lrcsi_grid_row_items(grid, y, row.x0, row.x1);
        if (!lrcsi_meter_take(job->meter, (uint64_t)1 + items.to - items.from)) {
            return 0;
        }
        for (uint32_t i = items.from; i < items.to; i++) {
            uint32_t event = grid->item[i];
            if (!search->aligned && job->gain[facet] >= 1 && job->loss[facet] >= 1) {
                job->parts[facet] = LRCSI_PART_SET_ALL; /* others are not searched for */
                return 1;
            }
            if (seen[event] != facet + 1) {
                seen[event] = facet + 1;
                add_event(job, facet, event, search);
            }
        }
    }
    return 1;
}

/* Begins the fractions for the correspondence of points with the same projection, unless they
   cannot be known. The facet must lie on a round wall and face the laser, and every other part
   that is near it must be in front of its own part or behind it; what these proofs leave open is
   counted. */
static int begin_aligned(band_job *job, uint32_t facet)
{
    const lrcs_prepared *p = job->view->prepared;
    const uint32_t own = band_part(job, facet);
    const lrcsi_part_set near = p->proximity.near[facet];
    double open = 0;
    if (!lrcsi_proximity_on_round_wall(p, facet) || !p->scene->part[own].rigid ||
        job->view->facing[facet] <= 0) {
        return 0;
    }
    for (uint32_t i = 0; i < p->scene->part_count && near != 0; i++) {
        double unproved;
        if ((near & lrcsi_part_set_of(i)) == 0 || i == own) {
            continue;
        }
        if (!job->body ||
            (!proof_holds(job, facet, &depth_order(job, own, i)->front_is_free, &unproved) &&
             !proof_holds(job, facet, &depth_order(job, i, own)->back_by_outline, &unproved))) {
            return 0;
        }
        open += unproved;
    }
    job->gain_aligned[facet] = job->loss_aligned[facet] = open;
    job->free_sides[facet] = 7;
    return 1;
}

static int facet_matters(const lrcsi_view *view, uint32_t facet)
{
    const lrcs_prepared *p = view->prepared;
    return !p->skip[facet] && (lrcsi_view_reflects(view, facet) ||
                               p->proximity.reach[p->scene->facet_part[facet]] > 0);
}

static void facet_fractions(band_job *job, uint32_t facet)
{
    const lrcsi_view *view = job->view;
    const lrcs_prepared *p = view->prepared;
    double reach = p->proximity.reach[band_part(job, facet)];
    facet_search search = search_begin(job, facet);
    if (reach == 0 &&
        (search.where.low[0] > job->curved.high[0] || search.where.low[1] > job->curved.high[1] ||
         search.where.high[0] < job->curved.low[0] || search.where.high[1] < job->curved.low[1])) {
        return;
    }
    if (!add_events(job, facet, &search)) {
        add_both(job, facet, 1, LRCSI_PART_SET_ALL);
    }
    if (begin_aligned(job, facet)) {
        search.aligned = 1;
        if (!add_events(job, facet, &search)) {
            job->gain_aligned[facet] = -1;
        }
    }
    if (reach > 0 && fabs(lrcsi_view_incidence(view, facet).cos_theta) <=
                         p->proximity.grazing_cos[band_part(job, facet)] + COS_ERR) {
        add_both(job, facet, 1, LRCSI_PART_SET_ALL);
    }
}

/* --- all facets ------------------------------------------------------------------------------- */

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
        int shut = p->solid || lrcsi_proximity_closed(p, band_part(job, pair->other));
        uint32_t other = band_part(job, pair->other);
        double err;
        double unproved;
        if (facing == 0 || (facing < 0 && shut)) {
            continue;
        }
        if (part_in_front(job, pair->facet, other, &err, &unproved) ||
            part_is_behind(job, pair->facet, other, &unproved)) {
            add_unproved(job, pair->facet, other, unproved);
        } else {
            add_both(job, pair->facet, (double)pair->area_fraction, lrcsi_part_set_of(other));
            job->rows[pair->facet] += (double)pair->row_fraction;
        }
    }
}

static void box_add(band_box *box, const double low[3], const double high[3])
{
    for (int k = 0; k < 3; k++) {
        box->low[k] = lrcsi_min(box->low[k], low[k]);
        box->high[k] = lrcsi_max(box->high[k], high[k]);
    }
}

/* The boxes of the facets of curved parts. They are not enlarged by the parts' reach: the boxes
   that they are compared with are enlarged (lrcsi_edge_search_make). */
static void band_boxes(band_job *job)
{
    static const band_box none = {{HUGE_VAL, HUGE_VAL, HUGE_VAL},
                                  {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    const lrcs_prepared *p = job->view->prepared;
    job->curved = none;
    for (uint32_t i = 0; i < p->scene->part_count; i++) {
        job->box[i] = none;
    }
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        if (!p->skip[f] && p->proximity.reach[band_part(job, f)] > 0) {
            double low[3];
            double high[3];
            lrcsi_view_bounds(job->view, p->scene->facet[f].corner, 3, low, high);
            box_add(&job->box[band_part(job, f)], low, high);
            box_add(&job->curved, low, high);
        }
    }
}

size_t lrcsi_proximity_band_need(const lrcs_prepared *p)
{
    if (!p->proximity.reach) {
        return 0;
    }
    size_t edges = lrcsi_proximity_events_most(p);
    size_t need = lrcsi_work_blocks(6, p->scene->facet_count, sizeof(double));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->scene->facet_count, sizeof(lrcsi_part_set)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->scene->facet_count, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_blocks(2, p->scene->facet_count, 1));
    need = lrcsi_work_add(need, lrcsi_work_blocks(2, edges, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(edges, sizeof(lrcsi_outline_areas)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->scene->part_count, sizeof(band_box)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->scene->part_count, sizeof(lrcsi_outline)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->scene->part_count, sizeof(lrcsi_body)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(DEPTH_PAIRS, sizeof(band_pair)));
    return lrcsi_work_add(need, lrcsi_proximity_events_need(edges));
}

/* Computes all fractions; scratch memory is released:
   1. the events and their grid (band_events);
   2. outlines of parts (lrcsi_outline_make) and parts as convex bodies (lrcsi_body_make);
   3. facets near those of other parts (add_pairs);
   4. for each facet that matters: event edges near it, and grazing incidence (facet_fractions);
   5. mismatch, gain, loss and rows are limited to 1. gain_aligned and loss_aligned may exceed it: who
      uses them compares the areas that they stand for with the facet's. */
static int all_fractions(band_job *job, lrcs_work *work)
{
    const lrcs_prepared *p = job->view->prepared;
    const uint32_t parts = p->scene->part_count;
    size_t mark = work->used;
    job->box = lrcsi_work_take(work, parts, sizeof *job->box);
    job->outline = lrcsi_work_take(work, parts, sizeof *job->outline);
    job->pair = lrcsi_work_take_zero(work, DEPTH_PAIRS, sizeof *job->pair);
    lrcsi_body *body = p->extent ? lrcsi_work_take(work, parts, sizeof *body) : NULL;
    job->body = body;
    int status = job->box && job->outline && job->pair && (body || !p->extent)
                     ? band_events(job, work) /* 1 */
                     : LRCS_E_MEMORY;
    if (status == LRCS_OK) {
        for (uint32_t i = 0; i < parts; i++) { /* 2 */
            job->outline[i] = lrcsi_outline_make(job->view, i);
            if (body) {
                body[i] = lrcsi_body_make(p, i);
            }
        }
        add_pairs(job); /* 3 */
        band_boxes(job);
        for (uint32_t f = 0; f < p->scene->facet_count; f++) {
            job->gain_aligned[f] = -1;
            if (facet_matters(job->view, f)) {
                facet_fractions(job, f); /* 4 */
            }
            job->mismatch[f] = lrcsi_min(1, job->mismatch[f]); /* 5 */
            job->gain[f] = lrcsi_min(1, job->gain[f]);
            job->loss[f] = lrcsi_min(1, job->loss[f]);
            job->rows[f] = job->mismatch[f] < 1 ? lrcsi_min(1, job->rows[f]) : 1;
        }
    }
    work->used = mark;
    return status;
}

void lrcsi_proximity_band_join(const lrcsi_proximity_band *band, const unsigned char *candidate,
                               uint32_t *group)
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
            int joined = candidate
                             ? candidate[a] && candidate[b] && band->parts[a] == band->parts[b]
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
    m.mismatch = lrcsi_work_take_zero(work, facets, sizeof *m.mismatch);
    m.gain = lrcsi_work_take_zero(work, facets, sizeof *m.gain);
    m.loss = lrcsi_work_take_zero(work, facets, sizeof *m.loss);
    m.rows = lrcsi_work_take_zero(work, facets, sizeof *m.rows);
    m.gain_aligned = lrcsi_work_take(work, facets, sizeof *m.gain_aligned);
    m.loss_aligned = lrcsi_work_take_zero(work, facets, sizeof *m.loss_aligned);
    m.free_sides = lrcsi_work_take_zero(work, facets, 1);
    m.parts = lrcsi_work_take_zero(work, facets, sizeof *m.parts);
    m.region = lrcsi_work_take(work, facets, sizeof *m.region);
    m.hidden = lrcsi_work_take_zero(work, facets, 1);
    band_job job = {.view = view,
                    .meter = meter,
                    .mismatch = m.mismatch,
                    .gain = m.gain,
                    .loss = m.loss,
                    .rows = m.rows,
                    .gain_aligned = m.gain_aligned,
                    .loss_aligned = m.loss_aligned,
                    .free_sides = m.free_sides,
                    .parts = m.parts};
    int status = m.mismatch && m.gain && m.loss && m.rows && m.gain_aligned && m.loss_aligned &&
                         m.free_sides && m.parts && m.region && m.hidden
                     ? all_fractions(&job, work)
                     : LRCS_E_MEMORY;
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    lrcsi_proximity_band_join(&m, NULL, m.region);
    *band = m;
    return LRCS_OK;
}
