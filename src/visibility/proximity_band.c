/* SPDX-License-Identifier: MIT */
/* Adds up, for each facet, the fractions of its area near event edges and near facets of other
   parts. Nothing is decided exactly: every distance is increased by the errors of the positions
   between which it is measured. integrate/tessellation.c decides what the uncertain areas add to
   the bound of sigma. */
#include "visibility/proximity_band.h"

#include <math.h>

#include "base/disjoint.h"
#include "base/range.h"
#include "base/work.h"
#include "scene/proximity.h"
#include "visibility/depth_order.h"
#include "visibility/edge_rectangle.h"
#include "visibility/outline.h"

/* More than the rounding error of a facet's cosine, of the unit normals and the direction: some 30
   u (facets that rounding may have turned further count as grazing: lrcsi_proximity.grazing_cos).
 */
#define COS_ERR 1e-9
/* The projected areas of facets with a larger cosine than this are accurate to COS_ERR, relative:
   30 u / 1e-4 is below 1e-10. */
#define COS_MIN 1e-4
/* The number of cells of the grid for each event edge: the many short edges of a rim lie in few
   cells. */
#define EVENT_CELLS 4u
/* A proof about a part (visibility/depth_order.h) is used for a facet only if it holds for all but
   this fraction of it. */
#define PROOF_FRACTION_MAX 0x1p-20
/* Pairs of parts of which it is remembered whether one is behind the other. Facets are searched
   part by part, so that few pairs are needed at a time. */
#define BEHIND_PAIRS 64u

/* A pair of parts, `back` perhaps behind `front`; front == back: none yet. */
typedef struct band_pair {
    uint32_t front, back;
    lrcsi_depth_order order;
} band_pair;

/* Bounds in view coordinates. */
typedef struct band_box {
    double low[3], high[3];
} band_box;

/* What one run needs. The items of the grid are indices of events; an event is a pair of an event
   edge and the part for which it is one. */
typedef struct band_job {
    const lrcsi_view *view;
    lrcsi_meter *meter;
    double *mismatch, *gain, *loss, *rows;
    lrcsi_part_set *parts;
    uint32_t *edge, *part; /* event: its topology edge, its part */
    signed char *side;     /* event: on which side of it, from low to high, the part's facets lie: 1
                              left, -1 right, 0 both or not known */
    lrcsi_outline_areas *areas; /* event: the areas along it between the outlines of the true shape
                         and of its facets; gain < 0: not computed yet */
    uint32_t *seen;             /* event: 1 + the last facet for which it was considered */
    uint32_t count;
    lrcsi_grid grid;
    band_box *box;          /* part: that of its facets in the view */
    lrcsi_outline *outline; /* part */
    const lrcsi_body *body; /* part; NULL: no shape has a closed form, and pairs are not tried */
    band_pair *pair;        /* BEHIND_PAIRS of them */
    band_box curved;        /* of all facets of curved parts */
} band_job;

static uint32_t band_part(const band_job *job, uint32_t facet)
{
    return job->view->prepared->scene->facet_part[facet];
}

/* --- events of one part ----------------------------------------------------------------------- */

/* On which side of an edge all facets of a part lie in projection: 1 left, -1 right; 0: on both, or
   one is seen edge-on. */
static int event_side(const lrcsi_view *view, const lrcsi_edge *edge, uint32_t part)
{
    const lrcs_prepared *p = view->prepared;
    const lrcsi_edge_use *use = p->topology.use + edge->first_use;
    int left = 0;
    int right = 0;
    for (uint32_t i = 0; i < edge->uses; i++) {
        uint32_t f = use[i].facet;
        if (p->scene->facet_part[f] == part && !p->skip[f]) {
            int side = use[i].forward ? view->facing[f] : -view->facing[f];
            left |= side >= 0;
            right |= side <= 0;
        }
    }
    return left - right;
}

/* Lists all events, each pair once; only counts them if job->edge is NULL. */
static void list_events(band_job *job)
{
    const lrcsi_topology *topology = &job->view->prepared->topology;
    job->count = 0;
    for (uint32_t e = 0; e < topology->edge_count; e++) {
        const lrcsi_edge *edge = &topology->edge[e];
        const lrcsi_edge_use *use = topology->use + edge->first_use;
        for (uint32_t i = 0; i < edge->uses; i++) {
            uint32_t part = band_part(job, use[i].facet);
            uint32_t pair[2];
            int met = 0;
            for (uint32_t k = 0; k < i && !met; k++) {
                met = band_part(job, use[k].facet) == part;
            }
            if (met || lrcsi_edge_kind_of(job->view, e, part, pair) != LRCSI_EDGE_EVENT) {
                continue;
            }
            if (job->edge) {
                job->edge[job->count] = e;
                job->part[job->count] = part;
                job->side[job->count] = (signed char)event_side(job->view, edge, part);
            }
            job->count++;
        }
    }
}

static int band_events(band_job *job, lrcs_work *work)
{
    list_events(job);
    uint32_t *edge = lrcsi_work_take(work, job->count, sizeof *edge);
    job->part = lrcsi_work_take(work, job->count, sizeof *job->part);
    job->side = lrcsi_work_take(work, job->count, sizeof *job->side);
    job->areas = lrcsi_work_take(work, job->count, sizeof *job->areas);
    job->seen = lrcsi_work_take_zero(work, job->count, sizeof *job->seen);
    if (!edge || !job->part || !job->side || !job->areas || !job->seen) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t i = 0; i < job->count; i++) {
        job->areas[i].gain = -1;
    }
    job->edge = edge;
    list_events(job);
    job->grid = lrcsi_grid_empty(job->view, EVENT_CELLS * job->count);
    return lrcsi_grid_edges(job->edge, job->count, 8 * (uint64_t)job->count, work, &job->grid);
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
static double event_slack(const band_job *job, uint32_t facet, uint32_t event, double lateral)
{
    const lrcs_prepared *p = job->view->prepared;
    uint32_t part = band_part(job, facet);
    if (job->part[event] == part) {
        const lrcsi_edge *edge = &p->topology.edge[job->edge[event]];
        return own_rim(job, edge, part) ? 2 * p->proximity.reach[part] : 0;
    }
    return lrcsi_proximity_slack_across(p, part, job->part[event], lateral);
}

/* --- one facet -------------------------------------------------------------------------------- */

/* Where to look for event edges near a facet: in a box, and in rows of the grid between the facet's
   sides, whose errors include the largest relevant distance. Beyond a line parallel to one of the
   sides event edges are too far away: there outward . x > limit, errors included. */
typedef struct edge_search {
    double low[3], high[3];
    lrcsi_view_segment side[3];
    double outward[3][2], limit[3];
    int first;  /* the side to try first: the one that excluded the last edge */
    int inside; /* the laser may see the facet through an opening of its own part */
    lrcsi_displacement displacement;
    double lateral; /* lrcsi_displacement_across the line of sight; negative: not computed yet */
} edge_search;

/* outward . x of a point, with `err` times its position's error added. */
static double search_height(const edge_search *search, int side, const double x[3], double err)
{
    return search->outward[side][0] * x[0] + search->outward[side][1] * x[1] +
           err * lrcsi_view_point_err(x);
}

/* The line parallel to a side at the distance `near` from the facet; nothing is beyond it if the
   side has no length. */
static void search_line(edge_search *search, int side, const double *const corner[3], double near)
{
    const double *from = corner[side];
    const double *to = corner[(side + 1) % 3];
    const double *apex = corner[(side + 2) % 3];
    double x = to[1] - from[1];
    double y = from[0] - to[0];
    double length = sqrt(x * x + y * y);
    double sign = x * (apex[0] - from[0]) + y * (apex[1] - from[1]) > 0 ? -1 : 1;
    search->outward[side][0] = length > 0 ? sign * x / length : 0;
    search->outward[side][1] = length > 0 ? sign * y / length : 0;
    double highest = -HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        highest =
            lrcsi_max(highest, search_height(search, side, corner[k], LRCSI_EDGE_RECTANGLE_ERR));
    }
    search->limit[side] = length > 0 ? highest + near * (1 + 0x1p-40) : HUGE_VAL;
}

/* Is the whole edge a b beyond one of these lines? */
static int search_excludes(edge_search *search, const double a[3], const double b[3])
{
    int side = search->first;
    for (int i = 0; i < 3; i++) {
        if (search_height(search, side, a, -LRCSI_EDGE_RECTANGLE_ERR) > search->limit[side] &&
            search_height(search, side, b, -LRCSI_EDGE_RECTANGLE_ERR) > search->limit[side]) {
            search->first = side;
            return 1;
        }
        side = side < 2 ? side + 1 : 0;
    }
    return 0;
}

static edge_search search_make(const band_job *job, uint32_t facet)
{
    const lrcsi_view *view = job->view;
    const lrcs_prepared *p = view->prepared;
    const uint32_t *corner = p->scene->facet[facet].corner;
    double near = 2 * (p->proximity.reach[band_part(job, facet)] + p->proximity.max_hausdorff) +
                  LRCSI_PROXIMITY_ERR;
    double wide = near + lrcsi_edge_rectangle_facet_err(job->view, facet);
    const double *const point[3] = {view->point[corner[0]].x, view->point[corner[1]].x,
                                    view->point[corner[2]].x};
    edge_search search = {.first = 0, .lateral = -1};
    search.inside = view->facing[facet] < 0 && !lrcsi_proximity_closed(p, band_part(job, facet));
    lrcsi_grid_sides(&job->grid, corner, 3, near, search.side);
    lrcsi_view_bounds(view, corner, 3, search.low, search.high);
    for (int k = 0; k < 3; k++) {
        search.low[k] -= wide;
        search.high[k] += wide;
        search_line(&search, k, point, near);
    }
    return search;
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

/* What a plane between two parts proves; computed once for each pair in turn. */
static const lrcsi_depth_order *depth_order(const band_job *job, uint32_t front, uint32_t back)
{
    band_pair *pair = &job->pair[(front + 7 * back) % BEHIND_PAIRS]; /* any spread serves */
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

/* Is a part behind the facet's own part (visibility/depth_order.h), except for a fraction of the
   facet? */
static int part_is_behind(const band_job *job, uint32_t facet, uint32_t other, double *unproved)
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
static int gain_is_inside(const band_job *job, const edge_search *search, uint32_t part)
{
    const lrcs_prepared *p = job->view->prepared;
    const band_box *box = &job->box[part];
    int openings = p->proximity.reach[part] > 0 ? lrcsi_proximity_openings(p, part) : 0;
    int apart = 0;
    for (int k = 0; k < 3; k++) {
        apart |= search->low[k] > box->high[k] || search->high[k] < box->low[k];
    }
    return openings == 0 || (openings == 1 && apart);
}

/* --- facets behind a shape -------------------------------------------------------------------- */

/* Is the outline of a part known, and the part in front of a facet: because the facet is flat, and
   the part in front of its plane (*err: as for lrcsi_outline_in_front); or because a plane
   separates it from the facet's own part, except for a fraction of the facet? */
static int part_in_front(const band_job *job, uint32_t facet, uint32_t part, double *err,
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
    const lrcsi_edge *edge = &view->prepared->topology.edge[job->edge[event]];
    const lrcsi_edge_use *use = view->prepared->topology.use + edge->first_use;
    uint32_t facets = 0;
    int facing = 0;
    for (uint32_t i = 0; i < edge->uses; i++) {
        if (band_part(job, use[i].facet) == job->part[event]) {
            facing = view->facing[use[i].facet];
            facets++;
        }
    }
    return facets == 1 && lrcsi_outline_inside(&job->outline[job->part[event]], view, facing);
}

/* The largest fractions of a facet, behind the event's part, that can be gained and lost along an
   event edge; infinite if nothing is known. delta: as in visibility/outline.h. */
static void outline_fractions(const band_job *job, uint32_t facet, uint32_t event, double delta,
                              double *gain, double *loss)
{
    const lrcsi_view *view = job->view;
    const lrcsi_edge *edge = &view->prepared->topology.edge[job->edge[event]];
    const lrcsi_outline *outline = &job->outline[job->part[event]];
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
                     : lrcsi_outline_areas_make(outline, a, b, job->side[event]);
    }
    *gain = (areas->gain + areas->width * delta) / projected * (1 + COS_ERR);
    *loss = (areas->loss + areas->width * delta) / projected * (1 + COS_ERR);
}

/* The rectangle about an event edge near a facet. slack: event_slack of the displacement across the
   line of sight, `wider` included, which counts at the ends of the edge. To its sides only the
   component perpendicular to the edge counts. */
static lrcsi_edge_rectangle event_rectangle(const band_job *job, uint32_t facet, uint32_t event,
                                            const edge_search *search, double slack, double wider)
{
    const lrcsi_topology *topology = &job->view->prepared->topology;
    lrcsi_edge_rectangle box =
        lrcsi_edge_rectangle_make(job->view, facet, &topology->edge[job->edge[event]], slack);
    if (box.has_sides) {
        double across = lrcsi_displacement_along(&search->displacement, box.across) +
                        box.rotation_err * search->lateral;
        across = event_slack(job, facet, event, lrcsi_min(across, search->lateral)) + wider;
        box.half_width = lrcsi_min(across, slack) + box.err;
    }
    return box;
}

/* Adds the fractions of area and of rows near an event edge:
   1. nothing if it is too far away, or an edge of the facet's own part of which it sees no inside;
   2. nothing but what a proof leaves open if its part is behind the facet's;
   3. what of the facet lies in the rectangle about the edge, unless the edge is behind it;
   4. all of that as gain and loss where the part lies on both sides of the edge; else what is on
      the inner side as gain, on the outer side as loss;
   5. but no more than the area between outlines, where the part is in front of the facet. */
static void add_event(band_job *job, uint32_t facet, uint32_t event, edge_search *search)
{
    const lrcs_prepared *p = job->view->prepared;
    const lrcsi_edge *edge = &p->topology.edge[job->edge[event]];
    int is_own = job->part[event] == band_part(job, facet);
    int side = is_own ? 0 : job->side[event];
    if ((is_own && !search->inside) ||
        search_excludes(search, job->view->point[edge->low].x, job->view->point[edge->high].x)) {
        return; /* 1 */
    }
    if (search->lateral < 0) {
        search->displacement = lrcsi_proximity_displacement(p, facet);
        search->lateral = lrcsi_displacement_across(&search->displacement, job->view->unit);
    }
    double slack = event_slack(job, facet, event, search->lateral);
    double err = 0;
    double unproved = 0;
    if (!(slack > 0)) {
        return;
    }
    if (!is_own && part_is_behind(job, facet, job->part[event], &unproved)) { /* 2 */
        add_unproved(job, facet, job->part[event], unproved);
        return;
    }
    int in_front = !is_own && part_in_front(job, facet, job->part[event], &err, &unproved);
    slack += err;
    lrcsi_edge_rectangle box = event_rectangle(job, facet, event, search, slack, err); /* 3 */
    lrcsi_slice slice = lrcsi_edge_rectangle_slice(job->view, facet, &box);
    if (slice.count == 0 ||
        (!is_own && lrcsi_edge_rectangle_behind(
                        job->view, facet, edge,
                        lrcsi_proximity_slack(p, band_part(job, facet), job->part[event])))) {
        return;
    }
    const uint32_t *vertex = p->scene->facet[facet].corner;
    const double *const corner[3] = {job->view->point[vertex[0]].x, job->view->point[vertex[1]].x,
                                     job->view->point[vertex[2]].x};
    lrcsi_part_set part = lrcsi_part_set_of(job->part[event]); /* 4 */
    double whole = 0.5 * p->normal[facet].length;
    double longest = lrcsi_proximity_longest(p, facet);
    job->rows[facet] += lrcsi_proximity_rows(p, facet, corner, &slice);
    if (side == 0) {
        add_both(job, facet, lrcsi_slice_fraction(&slice, whole, longest), part);
        return;
    }
    lrcsi_slice outer = lrcsi_edge_rectangle_half(slice, &box, -side);
    lrcsi_slice inner = lrcsi_edge_rectangle_half(slice, &box, side);
    double fraction = lrcsi_slice_fraction(&slice, whole, longest);
    double gain = gain_is_inside(job, search, job->part[event])
                      ? lrcsi_slice_fraction(&inner, whole, longest)
                      : fraction;
    double loss = lrcsi_slice_fraction(&outer, whole, longest);
    double gain_max = HUGE_VAL;
    double loss_max = HUGE_VAL;
    if (in_front) { /* 5 */
        outline_fractions(job, facet, event, search->lateral + err, &gain_max, &loss_max);
        add_unproved(job, facet, job->part[event], unproved);
    }
    job->parts[facet] |= part;
    job->mismatch[facet] += lrcsi_min(fraction, gain_max + loss_max);
    job->loss[facet] += lrcsi_min(loss, loss_max);
    job->gain[facet] += lrcsi_min(gain, gain_max);
}

/* Adds the fractions near all event edges, or the whole facet if the limit of steps is reached. */
static void add_events(band_job *job, uint32_t facet, edge_search *search)
{
    const lrcsi_grid *grid = &job->grid;
    lrcsi_view_box box = lrcsi_view_box_round(job->view, search->low, search->high);
    lrcsi_grid_rect cells = lrcsi_grid_buckets(grid, &box);
    int several = cells.y1 - cells.y0 > 1 && cells.x1 - cells.x0 > 1; /* rows and columns */
    for (uint32_t y = cells.y0; y < cells.y1; y++) {
        lrcsi_grid_rect row = several ? lrcsi_grid_row(grid, search->side, 3, y) : cells;
        lrcsi_grid_items items = lrcsi_grid_row_items(grid, y, row.x0, row.x1);
        if (!lrcsi_meter_take(job->meter, (uint64_t)1 + items.to - items.from)) {
            add_both(job, facet, 1, LRCSI_PART_SET_ALL);
            return;
        }
        for (uint32_t i = items.from; i < items.to; i++) {
            uint32_t event = grid->item[i];
            if (job->gain[facet] >= 1 && job->loss[facet] >= 1) {
                job->parts[facet] = LRCSI_PART_SET_ALL; /* others are not searched for */
                return;
            }
            if (job->seen[event] != facet + 1) {
                job->seen[event] = facet + 1;
                add_event(job, facet, event, search);
            }
        }
    }
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
    edge_search search = search_make(job, facet);
    if (reach == 0 &&
        (search.low[0] > job->curved.high[0] || search.low[1] > job->curved.high[1] ||
         search.high[0] < job->curved.low[0] || search.high[1] < job->curved.low[1])) {
        return;
    }
    add_events(job, facet, &search);
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
   that they are compared with are enlarged (search_make). */
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

/* Upper bound of the number of events: pairs of an edge and a part that has a facet on it. */
static size_t band_edges(const lrcs_prepared *p)
{
    const lrcsi_topology *topology = &p->topology;
    const uint32_t *part = p->scene->facet_part;
    size_t count = topology->edge_count;
    for (uint32_t e = 0; e < topology->edge_count; e++) {
        const lrcsi_edge_use *use = topology->use + topology->edge[e].first_use;
        for (uint32_t i = 1; i < topology->edge[e].uses; i++) {
            count += part[use[i].facet] != part[use[i - 1].facet];
        }
    }
    return count;
}

size_t lrcsi_proximity_band_need(const lrcs_prepared *p)
{
    if (!p->proximity.reach) {
        return 0;
    }
    size_t edges = band_edges(p);
    size_t need = lrcsi_work_blocks(4, p->scene->facet_count, sizeof(double));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->scene->facet_count, sizeof(lrcsi_part_set)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->scene->facet_count, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->scene->facet_count, 1));
    need = lrcsi_work_add(need, lrcsi_work_blocks(3, edges, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(edges, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(edges, sizeof(lrcsi_outline_areas)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->scene->part_count, sizeof(band_box)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->scene->part_count, sizeof(lrcsi_outline)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->scene->part_count, sizeof(lrcsi_body)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(BEHIND_PAIRS, sizeof(band_pair)));
    return lrcsi_work_add(need, lrcsi_grid_need(EVENT_CELLS * edges, 8 * edges));
}

/* Computes all fractions; scratch memory is released:
   1. the events and their grid (band_events);
   2. outlines of parts (lrcsi_outline_make) and parts as convex bodies (lrcsi_body_make);
   3. facets near those of other parts (add_pairs);
   4. for each facet that matters: event edges near it, and grazing incidence (facet_fractions);
   5. no fraction exceeds 1. */
static int all_fractions(band_job *job, lrcs_work *work)
{
    const lrcs_prepared *p = job->view->prepared;
    const uint32_t parts = p->scene->part_count;
    size_t mark = work->used;
    job->box = lrcsi_work_take(work, parts, sizeof *job->box);
    job->outline = lrcsi_work_take(work, parts, sizeof *job->outline);
    job->pair = lrcsi_work_take_zero(work, BEHIND_PAIRS, sizeof *job->pair);
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
    m.parts = lrcsi_work_take_zero(work, facets, sizeof *m.parts);
    m.region = lrcsi_work_take(work, facets, sizeof *m.region);
    m.hidden = lrcsi_work_take_zero(work, facets, 1);
    band_job job = {.view = view,
                    .meter = meter,
                    .mismatch = m.mismatch,
                    .gain = m.gain,
                    .loss = m.loss,
                    .rows = m.rows,
                    .parts = m.parts};
    int status = m.mismatch && m.gain && m.loss && m.rows && m.parts && m.region && m.hidden
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
