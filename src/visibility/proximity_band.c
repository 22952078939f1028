/* SPDX-License-Identifier: MIT */
/* Adds up, for each facet, the fractions of its area near event edges and near facets of other
   parts. Nothing is decided exactly: every distance is enlarged by the errors of the positions that
   it separates. What the uncertain areas add to the bound of sigma is decided in
   integrate/tessellation.c. */
#include "visibility/proximity_band.h"

#include <math.h>

#include "base/disjoint.h"
#include "base/range.h"
#include "base/work.h"
#include "mesh/slice.h"
#include "scene/proximity.h"

/* Errors of positions computed here, as a multiple of the error of view coordinates. */
#define ERR_MARGIN 8.0
/* Rounding of a facet's cosine, generously. */
#define COS_MARGIN 1e-9
/* The grid has so many cells for each event: rims are many short edges in few of its cells. */
#define EVENT_CELLS 4u

/* Bounds in view coordinates. */
typedef struct band_box {
    double low[3], high[3];
} band_box;

/* What one run needs; the edges' grid lists events by index. */
typedef struct band_job {
    const lrcsi_view *view;
    lrcsi_meter *meter;
    double *share, *gain, *loss, *rows;
    lrcsi_part_set *parts;
    uint32_t *edge, *part; /* event: its topology edge, the part for which it is one */
    signed char *side;     /* event: on which side of it, from low to high, the part's facets lie: 1
                              left, -1 right, 0 both or not known */
    uint32_t *seen;        /* event: the facet + 1 that last met it */
    uint32_t count;
    lrcsi_grid grid;
    band_box *box;   /* part: that of its facets in the view */
    band_box curved; /* of all facets of curved parts */
} band_job;

static uint32_t band_part(const band_job *job, uint32_t facet)
{
    return job->view->prepared->scene->facet_part[facet];
}

/* --- events of one part ------------------------------------------------------------------------
 */

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

/* Lists each pair of edge and part once, or only counts them if job->edge is NULL. */
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
    job->seen = lrcsi_work_take_zero(work, job->count, sizeof *job->seen);
    if (!edge || !job->part || !job->side || !job->seen) {
        return LRCS_E_MEMORY;
    }
    job->edge = edge;
    list_events(job);
    job->grid = lrcsi_grid_empty(job->view, EVENT_CELLS * job->count);
    return lrcsi_grid_edges(job->edge, job->count, 8 * (uint64_t)job->count, work, &job->grid);
}

/* --- one facet and one edge --------------------------------------------------------------------
 */

/* Bound on the position errors of a facet's corners and of positions computed from them. */
static double facet_err(const band_job *job, uint32_t facet)
{
    const uint32_t *corner = job->view->prepared->scene->facet[facet].corner;
    double err = 0;
    for (int k = 0; k < 3; k++) {
        err = lrcsi_max(err, lrcsi_view_point_err(job->view->point[corner[k]].x));
    }
    return ERR_MARGIN * err;
}

/* The rectangle about an edge in projection that holds all points of a facet within a distance of
   it: from a by `wide` against and across `along`, from b by `end` along it. */
typedef struct edge_box {
    const double *a, *b;
    double along[3];
    double wide, end;
    double err;  /* a bound on the error of distances from the edge's line, within the rectangle */
    int reverse; /* a is the edge's end `high` */
} edge_box;

/* The position error of the edge's point at parameter t (0 .. 1) is linear in t. A point of the
   edge near the facet is no farther from end a than the facet's farthest corner plus the width, t
   length
   <= far + wide; therefore the error of end b counts only t times. */
static edge_box edge_box_make(const band_job *job, uint32_t facet, const lrcsi_edge *edge,
                              double slack)
{
    const lrcsi_view *view = job->view;
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    edge_box box = {.a = view->point[edge->low].x, .b = view->point[edge->high].x};
    if (lrcsi_view_point_err(box.a) > lrcsi_view_point_err(box.b)) {
        box.a = view->point[edge->high].x;
        box.b = view->point[edge->low].x;
        box.reverse = 1;
    }
    box.along[0] = box.b[0] - box.a[0];
    box.along[1] = box.b[1] - box.a[1];
    double length = sqrt(box.along[0] * box.along[0] + box.along[1] * box.along[1]);
    double first = ERR_MARGIN * lrcsi_view_point_err(box.a);
    double last = ERR_MARGIN * lrcsi_view_point_err(box.b);
    double far = 0;
    for (int k = 0; k < 3; k++) {
        const double *x = view->point[corner[k]].x;
        far = lrcsi_max(far, fabs(x[0] - box.a[0]) + fabs(x[1] - box.a[1]));
    }
    box.err = facet_err(job, facet) + first;
    box.wide = slack + box.err;
    box.end = box.wide + last;
    if (length > 2 * (first + last)) {
        box.along[0] /= length;
        box.along[1] /= length;
        last *= lrcsi_min(1, 2 * (far + box.wide) / length);
        box.wide += last;
        box.err += last;
    } else { /* of no length: a square about it, without sides */
        box.along[0] = 1;
        box.along[1] = 0;
        box.end += length;
        box.wide = box.end;
        box.err = box.end;
    }
    return box;
}

/* Are all corners of a facet beyond one side of the rectangle about an edge? */
static int edge_box_apart(const band_job *job, uint32_t facet, const edge_box *box)
{
    const uint32_t *corner = job->view->prepared->scene->facet[facet].corner;
    int left = 0;
    int right = 0;
    int before = 0;
    int beyond = 0;
    for (int k = 0; k < 3; k++) {
        const double *x = job->view->point[corner[k]].x;
        const double from_a[2] = {x[0] - box->a[0], x[1] - box->a[1]};
        const double from_b[2] = {x[0] - box->b[0], x[1] - box->b[1]};
        double across = box->along[0] * from_a[1] - box->along[1] * from_a[0];
        left += across > box->wide;
        right += across < -box->wide;
        before += box->along[0] * from_a[0] + box->along[1] * from_a[1] < -box->wide;
        beyond += box->along[0] * from_b[0] + box->along[1] * from_b[1] > box->end;
    }
    return left == 3 || right == 3 || before == 3 || beyond == 3;
}

/* The part of a facet in the rectangle about an edge. */
static lrcsi_slice edge_slice(const band_job *job, uint32_t facet, const edge_box *box)
{
    const lrcsi_view *view = job->view;
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    lrcsi_slice slice = {.count = 0};
    if (edge_box_apart(job, facet, box)) {
        return slice;
    }
    const double *along = box->along;
    const double aside[3] = {-along[1], along[0], 0};
    const double back[3] = {-along[0], -along[1], 0};
    const double other[3] = {along[1], -along[0], 0};
    slice = lrcsi_slice_start(view->point[corner[0]].x, view->point[corner[1]].x,
                              view->point[corner[2]].x);
    lrcsi_slice_cut(&slice, aside, box->a, box->wide);
    lrcsi_slice_cut(&slice, other, box->a, box->wide);
    lrcsi_slice_cut(&slice, along, box->b, box->end);
    lrcsi_slice_cut(&slice, back, box->a, box->wide);
    return slice;
}

/* What lies to the left of the edge, from low to high (side 1), or to the right (-1), of a slice of
   the rectangle about it; the errors of positions included. */
static lrcsi_slice edge_half(lrcsi_slice slice, const edge_box *box, int side)
{
    double outward = box->reverse ? -side : side;
    const double away[3] = {outward * box->along[1], -outward * box->along[0], 0};
    lrcsi_slice_cut(&slice, away, box->a, box->err);
    return slice;
}

/* 1 if the whole edge lies so far behind a facet's plane that every point of it within `slack`, in
   projection, of a point of the facet is at least 2 slack behind that point. */
static int edge_behind(const band_job *job, uint32_t facet, const lrcsi_edge *edge, double slack)
{
    const lrcs_prepared *p = job->view->prepared;
    const lrcsi_normal *n = &p->normal[facet];
    const double *a = lrcsi_prepared_corner(p, facet, 0);
    const uint32_t end[2] = {edge->low, edge->high};
    double err = facet_err(job, facet);
    int behind = job->view->facing[facet] != 0;
    for (int i = 0; i < 2 && behind; i++) {
        double height = 0;
        for (int k = 0; k < 3; k++) {
            height += job->view->facing[facet] * n->high[k] * (p->vertex[end[i]].x[k] - a[k]);
        }
        double end_err = ERR_MARGIN * lrcsi_view_point_err(job->view->point[end[i]].x);
        behind = height < -(3 * slack + err + end_err) * n->length;
    }
    return behind;
}

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
        facing |= cosine > -(p->scene->part[part].curvature.turn + COS_MARGIN);
    }
    return count == 1 && facing;
}

/* The distance in projection within which an event edge affects a facet, unless it is behind; 0 if
   it cannot. Of the facet's own part only the rims of openings do. */
static double event_slack(const band_job *job, uint32_t facet, uint32_t event, double aside)
{
    const lrcs_prepared *p = job->view->prepared;
    uint32_t part = band_part(job, facet);
    if (job->part[event] == part) {
        const lrcsi_edge *edge = &p->topology.edge[job->edge[event]];
        return own_rim(job, edge, part) ? 2 * p->proximity.reach[part] : 0;
    }
    return lrcsi_proximity_slack_across(p, part, job->part[event], aside);
}

/* --- one facet -------------------------------------------------------------------------------- */

/* Where to look for event edges near a facet: in a box, and in rows of the grid between the facet's
   sides, whose errors include the largest relevant distance. Event edges on the outer side of a
   line along one of the sides are too far away: outward . x > limit there, errors included. */
typedef struct band_walk {
    double low[3], high[3];
    lrcsi_strip_segment side[3];
    double outward[3][2], limit[3];
    int tried;    /* the side to try first: the one that the last edge was beyond */
    int inside;   /* the laser may see the facet through an opening of its own part */
    double aside; /* lrcsi_proximity_lateral; negative: not computed yet */
} band_walk;

/* outward . x of a point, with `err` times its position's error added. */
static double walk_height(const band_walk *walk, int side, const double x[3], double err)
{
    return walk->outward[side][0] * x[0] + walk->outward[side][1] * x[1] +
           err * lrcsi_view_point_err(x);
}

/* The line along a side, `near` away from the facet. Where the side has no length nothing is beyond
   it. */
static void walk_line(band_walk *walk, int side, const double *const corner[3], double near)
{
    const double *from = corner[side];
    const double *to = corner[(side + 1) % 3];
    const double *apex = corner[(side + 2) % 3];
    double x = to[1] - from[1];
    double y = from[0] - to[0];
    double length = sqrt(x * x + y * y);
    double turn = x * (apex[0] - from[0]) + y * (apex[1] - from[1]) > 0 ? -1 : 1;
    walk->outward[side][0] = length > 0 ? turn * x / length : 0;
    walk->outward[side][1] = length > 0 ? turn * y / length : 0;
    double most = -HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        most = lrcsi_max(most, walk_height(walk, side, corner[k], ERR_MARGIN));
    }
    walk->limit[side] = length > 0 ? most + near * (1 + 0x1p-40) : HUGE_VAL;
}

/* Is a whole edge beyond one of these lines? */
static int walk_apart(band_walk *walk, const double a[3], const double b[3])
{
    int side = walk->tried;
    for (int i = 0; i < 3; i++) {
        if (walk_height(walk, side, a, -ERR_MARGIN) > walk->limit[side] &&
            walk_height(walk, side, b, -ERR_MARGIN) > walk->limit[side]) {
            walk->tried = side;
            return 1;
        }
        side = side < 2 ? side + 1 : 0;
    }
    return 0;
}

static band_walk walk_make(const band_job *job, uint32_t facet)
{
    const lrcsi_view *view = job->view;
    const lrcs_prepared *p = view->prepared;
    const uint32_t *corner = p->scene->facet[facet].corner;
    double near = 2 * (p->proximity.reach[band_part(job, facet)] + p->proximity.max_reach) +
                  LRCSI_PROXIMITY_ERR;
    double wide = near + facet_err(job, facet);
    const double *const point[3] = {view->point[corner[0]].x, view->point[corner[1]].x,
                                    view->point[corner[2]].x};
    band_walk walk = {.tried = 0, .aside = -1};
    walk.inside = view->facing[facet] < 0 && !lrcsi_proximity_closed(p, band_part(job, facet));
    lrcsi_grid_sides(&job->grid, corner, 3, near, walk.side);
    lrcsi_view_bounds(view, corner, 3, walk.low, walk.high);
    for (int k = 0; k < 3; k++) {
        walk.low[k] -= wide;
        walk.high[k] += wide;
        walk_line(&walk, k, point, near);
    }
    return walk;
}

/* Adds a fraction of a facet's area where facets and true shapes may differ either way, near one of
   these parts. */
static void add_both(band_job *job, uint32_t facet, double share, lrcsi_part_set parts)
{
    job->parts[facet] |= parts;
    job->share[facet] += share;
    job->gain[facet] += share;
    job->loss[facet] += share;
}

/* Does the truth gain area only on the side of event edges on which the part's facets lie? It does
   where an open part has one opening, and the facet is not inside its box. */
static int gain_is_inside(const band_job *job, const band_walk *walk, uint32_t part)
{
    const lrcs_prepared *p = job->view->prepared;
    const band_box *box = &job->box[part];
    int openings = p->proximity.reach[part] > 0 ? lrcsi_proximity_openings(p, part) : 0;
    int apart = 0;
    for (int k = 0; k < 3; k++) {
        apart |= walk->low[k] > box->high[k] || walk->high[k] < box->low[k];
    }
    return openings == 0 || (openings == 1 && apart);
}

/* Adds the fractions of area and of rows near an event edge. */
static void add_event(band_job *job, uint32_t facet, uint32_t event, band_walk *walk)
{
    const lrcs_prepared *p = job->view->prepared;
    const lrcsi_edge *edge = &p->topology.edge[job->edge[event]];
    int is_own = job->part[event] == band_part(job, facet);
    int side = is_own ? 0 : job->side[event];
    if ((is_own && !walk->inside) ||
        walk_apart(walk, job->view->point[edge->low].x, job->view->point[edge->high].x)) {
        return;
    }
    if (walk->aside < 0) {
        walk->aside = lrcsi_proximity_lateral(p, facet, job->view->unit);
    }
    double slack = event_slack(job, facet, event, walk->aside);
    if (!(slack > 0)) {
        return;
    }
    edge_box box = edge_box_make(job, facet, edge, slack);
    lrcsi_slice slice = edge_slice(job, facet, &box);
    if (slice.count == 0 || (!is_own && edge_behind(job, facet, edge,
                                                    lrcsi_proximity_slack(p, band_part(job, facet),
                                                                          job->part[event])))) {
        return;
    }
    const uint32_t *vertex = p->scene->facet[facet].corner;
    const double *const corner[3] = {job->view->point[vertex[0]].x, job->view->point[vertex[1]].x,
                                     job->view->point[vertex[2]].x};
    lrcsi_part_set part = lrcsi_part_set_of(job->part[event]);
    double whole = 0.5 * p->normal[facet].length;
    double longest = lrcsi_proximity_longest(p, facet);
    job->rows[facet] += lrcsi_proximity_rows(p, facet, corner, &slice);
    if (side == 0) {
        add_both(job, facet, lrcsi_slice_fraction(&slice, whole, longest), part);
        return;
    }
    lrcsi_slice outer = edge_half(slice, &box, -side);
    lrcsi_slice inner = edge_half(slice, &box, side);
    double share = lrcsi_slice_fraction(&slice, whole, longest);
    job->parts[facet] |= part;
    job->share[facet] += share;
    job->loss[facet] += lrcsi_slice_fraction(&outer, whole, longest);
    job->gain[facet] += gain_is_inside(job, walk, job->part[event])
                            ? lrcsi_slice_fraction(&inner, whole, longest)
                            : share;
}

/* Adds the fractions near all event edges; the whole facet if the limit of steps is reached. */
static void add_events(band_job *job, uint32_t facet, band_walk *walk)
{
    const lrcsi_grid *grid = &job->grid;
    lrcsi_view_box box = lrcsi_view_box_round(job->view, walk->low, walk->high);
    lrcsi_cells cells = lrcsi_grid_cells(grid, &box);
    int several = cells.y1 - cells.y0 > 1 && cells.x1 - cells.x0 > 1; /* rows and columns */
    for (uint32_t y = cells.y0; y < cells.y1; y++) {
        lrcsi_cells row = several ? lrcsi_grid_row(grid, walk->side, 3, y) : cells;
        lrcsi_grid_items items = lrcsi_grid_row_items(grid, y, row.x0, row.x1);
        if (!lrcsi_meter_take(job->meter, (uint64_t)1 + items.to - items.from)) {
            add_both(job, facet, 1, LRCSI_PART_SET_ALL);
            return;
        }
        for (uint32_t i = items.from; i < items.to; i++) {
            uint32_t event = grid->item[i];
            if (job->gain[facet] >= 1 && job->loss[facet] >= 1) {
                job->parts[facet] = LRCSI_PART_SET_ALL; /* the others are not looked for */
                return;
            }
            if (job->seen[event] != facet + 1) {
                job->seen[event] = facet + 1;
                add_event(job, facet, event, walk);
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

static void facet_share(band_job *job, uint32_t facet)
{
    const lrcsi_view *view = job->view;
    const lrcs_prepared *p = view->prepared;
    double reach = p->proximity.reach[band_part(job, facet)];
    band_walk walk = walk_make(job, facet);
    if (reach == 0 && (walk.low[0] > job->curved.high[0] || walk.low[1] > job->curved.high[1] ||
                       walk.high[0] < job->curved.low[0] || walk.high[1] < job->curved.low[1])) {
        return;
    }
    add_events(job, facet, &walk);
    if (reach > 0 &&
        fabs(lrcsi_view_incidence(view, facet).cos_theta) <=
            p->proximity.grazing_cos[band_part(job, facet)] + COS_MARGIN * COS_MARGIN) {
        add_both(job, facet, 1, LRCSI_PART_SET_ALL);
    }
}

/* --- all facets ------------------------------------------------------------------------------- */

/* Adds the fractions near facets of other parts. Facets seen edge-on hide nothing, and neither do
   back sides of closed parts: fronts of the same part do. */
static void band_contacts(band_job *job)
{
    const lrcsi_view *view = job->view;
    const lrcs_prepared *p = view->prepared;
    for (size_t i = 0; i < p->proximity.count; i++) {
        const lrcsi_proximity_pair *pair = &p->proximity.pair[i];
        int facing = view->facing[pair->other];
        int shut = p->solid || lrcsi_proximity_closed(p, band_part(job, pair->other));
        if (facing > 0 || (facing < 0 && !shut)) {
            add_both(job, pair->facet, (double)pair->area_fraction,
                     lrcsi_part_set_of(band_part(job, pair->other)));
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

/* The boxes of curved parts: their facets', not enlarged by their reach, as the boxes that are
   compared with them are (walk_make). */
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

/* --- regions ---------------------------------------------------------------------------------- */

/* Joins facets of one part across edges into groups, each named by its first facet: facets of
   curved parts without bands or, if `ask` is given, facets that it marks and that meet bands of the
   same parts. */
static void join_facets(const lrcsi_proximity_band *band, const unsigned char *ask, uint32_t *group)
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
            int alike =
                ask ? ask[a] && ask[b] && band->parts[a] == band->parts[b]
                    : p->proximity.reach[part[a]] > 0 && band->share[a] == 0 && band->share[b] == 0;
            if (part[a] == part[b] && alike) {
                lrcsi_disjoint_union(group, a, b);
            }
        }
    }
    lrcsi_disjoint_flatten(group, p->scene->facet_count);
}

/* --- what is hidden --------------------------------------------------------------------------- */

/* Values of band->hidden: by the visible area of a facet of the region; by a query, for good. */
enum { HIDDEN_REGION = 1, HIDDEN_FACET = 2 };
/* A facet of which no larger fraction may be visible is asked about. */
#define ASKED_FRACTION 0x1p-20

/* A region is entirely hidden or entirely visible. So it is hidden if at most half of one of its
   front facets is visible. */
static void settle_regions(const lrcsi_proximity_band *band, const lrcsi_visible *visible)
{
    const lrcsi_view *view = band->classification->view;
    const lrcs_prepared *p = view->prepared;
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        band->hidden[f] = band->hidden[f] == HIDDEN_FACET ? HIDDEN_FACET : 0;
    }
    for (uint32_t f = 0; f < p->scene->facet_count; f++) {
        if (view->facing[f] > 0 && p->proximity.reach[p->scene->facet_part[f]] > 0 &&
            band->share[f] == 0 && visible[f].high <= 0.5 * lrcsi_view_projected(view, f) &&
            band->hidden[f] == 0) {
            band->hidden[band->region[f]] = HIDDEN_REGION;
        }
    }
}

/* Marks hidden facets that meet bands, but not of all parts. Returns their number. */
static uint32_t facets_to_ask(const lrcsi_proximity_band *band, const lrcsi_visible *visible,
                              unsigned char *ask)
{
    const lrcsi_view *view = band->classification->view;
    uint32_t count = 0;
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        ask[f] = band->share[f] > 0 && band->parts[f] != LRCSI_PART_SET_ALL &&
                 lrcsi_view_casts(view, f) &&
                 visible[f].high <= ASKED_FRACTION * lrcsi_view_projected(view, f);
        count += ask[f];
    }
    return count;
}

/* Other parts than those whose bands it meets hide all of a group or nothing of it. Of its own
   part, fronts are never hidden, and the inside is left to the rims. */
static void settle_groups(const lrcsi_proximity_band *band, const unsigned char *ask,
                          const uint32_t *group, const lrcsi_grid *facets, lrcsi_meter *meter)
{
    const lrcs_scene *scene = band->classification->view->prepared->scene;
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        lrcsi_part_set others = band->parts[f] | lrcsi_part_set_of(scene->facet_part[f]);
        if (ask[f] && group[f] == f && lrcsi_query_hidden_by_others(facets, f, others, meter)) {
            band->hidden[f] = HIDDEN_FACET;
        }
    }
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        if (ask[f] && band->hidden[group[f]] == HIDDEN_FACET) {
            band->hidden[f] = HIDDEN_FACET;
            band->share[f] = band->gain[f] = band->loss[f] = band->rows[f] = 0;
        }
    }
}

size_t lrcsi_proximity_band_settle_need(const lrcs_prepared *p)
{
    size_t facets = p->scene->facet_count;
    size_t need =
        lrcsi_work_add(lrcsi_work_bytes(facets, 1), lrcsi_work_bytes(facets, sizeof(uint32_t)));
    return p->proximity.reach ? lrcsi_work_add(need, lrcsi_grid_facets_need(p)) : 0;
}

void lrcsi_proximity_band_settle(const lrcsi_proximity_band *band, const lrcsi_visible *visible,
                                 lrcsi_meter *meter, lrcs_work *work)
{
    const lrcsi_classification *c = band->classification;
    size_t mark = work->used;
    uint32_t count = c->view->prepared->scene->facet_count;
    unsigned char *ask = lrcsi_work_take(work, count, 1);
    uint32_t *group = lrcsi_work_take(work, count, sizeof *group);
    lrcsi_grid facets;
    if (ask && group && facets_to_ask(band, visible, ask) > 0) {
        const lrcsi_grid_readers readers = {.undecided = ask};
        join_facets(band, ask, group);
        if (lrcsi_grid_facets(&c->grid, &c->boxes, &readers, work, &facets) == LRCS_OK) {
            settle_groups(band, ask, group, &facets, meter);
        }
    }
    work->used = mark;
    settle_regions(band, visible);
}

/* Upper bound of the number of pairs of an edge and a part with a facet at it. */
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
    size_t need = 4 * lrcsi_work_bytes(p->scene->facet_count, sizeof(double));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->scene->facet_count, sizeof(lrcsi_part_set)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->scene->facet_count, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->scene->facet_count, 1));
    need = lrcsi_work_add(need, 3 * lrcsi_work_bytes(edges, sizeof(uint32_t)));
    need = lrcsi_work_add(need, lrcsi_work_bytes(edges, 1));
    need = lrcsi_work_add(need, lrcsi_work_bytes(p->scene->part_count, sizeof(band_box)));
    return lrcsi_work_add(need, lrcsi_grid_need(EVENT_CELLS * edges, 8 * edges));
}

/* Computes all fractions; scratch memory is released. */
static int band_shares(band_job *job, lrcs_work *work)
{
    size_t mark = work->used;
    job->box = lrcsi_work_take(work, job->view->prepared->scene->part_count, sizeof *job->box);
    int status = job->box ? band_events(job, work) : LRCS_E_MEMORY;
    if (status == LRCS_OK) {
        band_contacts(job);
        band_boxes(job);
        for (uint32_t f = 0; f < job->view->prepared->scene->facet_count; f++) {
            if (facet_matters(job->view, f)) {
                facet_share(job, f);
            }
            job->share[f] = lrcsi_min(1, job->share[f]);
            job->gain[f] = lrcsi_min(1, job->gain[f]);
            job->loss[f] = lrcsi_min(1, job->loss[f]);
            job->rows[f] = job->share[f] < 1 ? lrcsi_min(1, job->rows[f]) : 1;
        }
    }
    work->used = mark;
    return status;
}

int lrcsi_proximity_band_make(const lrcsi_classification *classification, lrcsi_meter *meter,
                              lrcs_work *work, lrcsi_proximity_band *band)
{
    const lrcsi_view *view = classification->view;
    uint32_t facets = view->prepared->scene->facet_count;
    size_t mark = work->used;
    lrcsi_proximity_band m = {.classification = classification};
    m.share = lrcsi_work_take_zero(work, facets, sizeof *m.share);
    m.gain = lrcsi_work_take_zero(work, facets, sizeof *m.gain);
    m.loss = lrcsi_work_take_zero(work, facets, sizeof *m.loss);
    m.rows = lrcsi_work_take_zero(work, facets, sizeof *m.rows);
    m.parts = lrcsi_work_take_zero(work, facets, sizeof *m.parts);
    m.region = lrcsi_work_take(work, facets, sizeof *m.region);
    m.hidden = lrcsi_work_take_zero(work, facets, 1);
    band_job job = {.view = view,
                    .meter = meter,
                    .share = m.share,
                    .gain = m.gain,
                    .loss = m.loss,
                    .rows = m.rows,
                    .parts = m.parts};
    int status = m.share && m.gain && m.loss && m.rows && m.parts && m.region && m.hidden
                     ? band_shares(&job, work)
                     : LRCS_E_MEMORY;
    if (status != LRCS_OK) {
        work->used = mark;
        return status;
    }
    join_facets(&m, NULL, m.region);
    *band = m;
    return LRCS_OK;
}
