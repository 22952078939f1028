/* SPDX-License-Identifier: MIT */
/* Finds which facets of the inside lie under which parts of the rim's sides, and adds the margins.
   */
#include "integrate/wall/round_rim.h"

#include <math.h>

#include "base/constant.h"
#include "base/length.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/work.h"
#include "mesh/shape/tessellate.h"
#include "scene/proximity.h"

/* More than the rounding error of angles. */
#define ANGLE_ERR 1e-9

/* The margin of a side is divided into so many cells, at equal steps of the side's parameter; a bit
   stands for each. */
#define CELLS     64u
#define CELL_STEP (2.0 / CELLS)
typedef uint64_t cell_set;

/* A side of the rim, and the facets of the inside under it. */
typedef struct rim_side {
    lrcsi_round_side at;
    uint32_t facet;  /* one that is in C, if possible one that the sum includes; LRCS_NONE: there is
                       none */
    int is_summed;   /* the sum includes that facet: something of it may be visible */
    double bound;    /* on G above those in C */
    cell_set inside; /* above which there may be facets of C */
    cell_set uncertain; /* above which there may be others, or near which event edges pass */
    cell_set known;     /* of those above C alone: their margin is added, or hidden */
} rim_side;

typedef struct rim_job {
    const lrcsi_round_wall *wall;
    const lrcsi_proximity_band *band;
    const lrcsi_visible_area *visible;
    const lrcsi_occlusion *o;
    lrcsi_meter *meter;
    const lrcs_part *part;
    rim_side *side; /* of each sector */
} rim_job;

/* Does a facet belong to the inside, near enough to the rim in projection? */
static int is_under_rim(const rim_job *job, uint32_t facet)
{
    const lrcsi_view *view = job->wall->view;
    return view->facing[facet] < 0 && lrcsi_view_reflects(view, facet) &&
           (job->band->parts[facet] & lrcsi_part_set_of(job->wall->part)) != 0;
}

/* A part of the rim, by azimuth. */
typedef struct rim_arc {
    double from, to;
} rim_arc;

/* The arcs of the rim with the sides that may lie above a facet, they or their margins. Returns how
   many there are. The projection takes the plane of the rim onto the view plane. It keeps lengths
   along e, the direction in that plane that is perpendicular to d, and multiplies those
   perpendicular to e by |d . axis|; the two remain perpendicular. So a point of the rim within r of
   the facet's middle in projection
   1. is within r / |d . axis| of the middle's preimage. With the preimage at the distance rho from
      the axis, that leaves an angle D of 2 sqrt(R rho) sin(D / 2) <= that on either side, and
      asin x <= pi x / 2;
   2. is within r of the middle along e, where it is at R cos(its azimuth - that of e). That leaves
      an arc on either side of e.
   The shorter of the two answers is returned; it is the second one where the rim is nearly edge-on.
   */
static int arcs_above(const rim_job *job, uint32_t facet, rim_arc arc[2])
{
    const lrcsi_view *view = job->wall->view;
    const lrcsi_round_surface *s = &job->wall->surface;
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    const double radius = sqrt(-s->gamma);
    double x[2] = {-s->view[0], -s->view[1]};
    double r = 0;
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < 3; i++) {
            x[k] += view->point[corner[i]].x[k] / 3;
        }
    }
    for (int i = 0; i < 3; i++) {
        const lrcsi_view_vertex *at = &view->point[corner[i]];
        const double from[2] = {at->x[0] - (x[0] + s->view[0]), at->x[1] - (x[1] + s->view[1])};
        r = lrcsi_max(r, lrcsi_length_flat(from[0], from[1]) + 2 * at->err);
    }
    r += 2 * view->prepared->proximity.reach[job->wall->part] + s->position_err;
    r = r * (1 + ANGLE_ERR) + ANGLE_ERR * radius;

    const double det = s->axis[0][0] * s->axis[1][1] - s->axis[0][1] * s->axis[1][0];
    const double a = (x[0] * s->axis[1][1] - x[1] * s->axis[0][1]) / det; /* the preimage */
    const double b = (x[1] * s->axis[0][0] - x[0] * s->axis[1][0]) / det;
    const double rho = lrcsi_length_flat(a, b);
    if (fabs(rho - radius) > r / fabs(det)) {
        return 0;
    }
    const double angle = 0.5 * LRCS_PI * r / (fabs(det) * sqrt(radius * rho)) + ANGLE_ERR;
    const double half = angle < LRCS_PI ? angle : LRCS_PI;

    const double in_plane = lrcsi_length_flat(s->axis[2][0], s->axis[2][1]);
    const double e[2] = {-s->axis[2][1] / in_plane, s->axis[2][0] / in_plane};
    const double along = x[0] * (s->axis[0][0] * e[0] + s->axis[0][1] * e[1]) +
                         x[1] * (s->axis[1][0] * e[0] + s->axis[1][1] * e[1]);
    const double high = asin(lrcsi_min(1, lrcsi_max(-1, (along + r) / radius)));
    const double low = asin(lrcsi_min(1, lrcsi_max(-1, (along - r) / radius)));
    if (half <= high - low || !(in_plane > 0)) {
        const double middle = atan2(b, a);
        arc[0] = (rim_arc){middle - half, middle + half};
        return 1;
    }
    const double middle = atan2(e[1], e[0]);
    const double from = 0.5 * LRCS_PI - high - ANGLE_ERR;
    const double to = 0.5 * LRCS_PI - low + ANGLE_ERR;
    arc[0] = (rim_arc){middle - to, middle - from};
    arc[1] = (rim_arc){middle + from, middle + to};
    return 2;
}

/* The sector at the rim of which a facet is the first: its number, and its sides, of which the
   first lies on the rim. Returns 0 if there is none. */
static int rim_sector(const rim_job *job, uint32_t facet, lrcsi_round_sector *sector,
                      uint32_t *number)
{
    lrcsi_wall_patch at;
    int found = lrcsi_tessellate_patch(&job->part->shape, &job->part->divisions,
                                       facet - job->part->first_facet, &at) &&
                at.row == 0 && lrcsi_round_sector_make(job->wall, facet, sector) &&
                sector->facet[0] == facet;
    if (found) {
        *number = at.sector;
    }
    return found;
}

/* --- cells ------------------------------------------------------------------------------------ */

/* The cells with a parameter between these limits. */
static cell_set cells_between(double from, double to)
{
    const double low = lrcsi_max(0, floor((from + 1) / CELL_STEP));
    const double high = lrcsi_min(CELLS - 1.0, floor((to + 1) / CELL_STEP));
    if (!(low <= high)) {
        return 0;
    }
    const unsigned count = (unsigned)(high - low) + 1;
    return (~(cell_set)0 >> (CELLS - count)) << (unsigned)low;
}

/* The first run of cells in a set, which it is removed from. Returns 0 if the set is empty. */
static cell_set cells_next(cell_set *set, lrcsi_round_range *range)
{
    cell_set run = 0;
    unsigned at = 0;
    while (at < CELLS && ((*set >> at) & 1) == 0) {
        at++;
    }
    range->from = at * CELL_STEP - 1;
    for (; at < CELLS && ((*set >> at) & 1) != 0; at++) {
        run |= (cell_set)1 << at;
    }
    range->to = at * CELL_STEP - 1;
    *set &= ~run;
    return run;
}

/* The cells under which a facet may lie. No point of a margin is farther from the point of the side
   with the same parameter than two reaches. */
static cell_set facet_cells(const rim_job *job, const lrcsi_round_side *side, uint32_t facet)
{
    const lrcsi_view *view = job->wall->view;
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    const double half = lrcsi_length_flat(side->step[0], side->step[1]);
    double width = 2 * view->prepared->proximity.reach[job->wall->part] +
                   job->wall->surface.position_err + view->point[side->vertex[0]].err +
                   view->point[side->vertex[1]].err;
    double along[3];
    double across[3];
    double from = HUGE_VAL;
    double to = -HUGE_VAL;
    for (int i = 0; i < 3; i++) {
        const lrcsi_view_vertex *at = &view->point[corner[i]];
        const double x[2] = {at->x[0] - side->chord[0], at->x[1] - side->chord[1]};
        along[i] = (x[0] * side->step[0] + x[1] * side->step[1]) / half;
        across[i] = (x[1] * side->step[0] - x[0] * side->step[1]) / half;
        width += 2 * at->err;
    }
    width *= 1 + ANGLE_ERR;
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        lrcsi_segment_part part = {0, 1};
        lrcsi_segment_part_limit(&part, across[i], across[next], width);
        lrcsi_segment_part_limit(&part, -across[i], -across[next], width);
        if (!lrcsi_segment_part_is_empty(part)) {
            lrcsi_range_extend(along[i] + part.from * (along[next] - along[i]), &from, &to);
            lrcsi_range_extend(along[i] + part.to * (along[next] - along[i]), &from, &to);
        }
    }
    return half > 0 ? cells_between((from - width) / half, (to + width) / half) : ~(cell_set)0;
}

/* The cells of a side near which event edges of other parts pass. */
static cell_set near_cells(const rim_job *job, const lrcsi_round_side *side)
{
    const lrcsi_segment_part near = job->band->rim[side->facet];
    const uint32_t *corner = job->wall->view->prepared->scene->facet[side->facet].corner;
    const double from = 2 * near.from - 1;
    const double to = 2 * near.to - 1;
    if (lrcsi_segment_part_is_empty(near)) {
        return 0;
    }
    return side->vertex[0] == corner[side->corner]
               ? cells_between(from - ANGLE_ERR, to + ANGLE_ERR)
               : cells_between(-to - ANGLE_ERR, -from + ANGLE_ERR);
}

/* --- facets under sides ----------------------------------------------------------------------- */

/* The sides that may lie above a facet, as numbers from first to last of each arc, modulo the
   number of sides. Returns how many arcs there are. */
typedef struct rim_sides {
    uint32_t first, last;
} rim_sides;

static int sides_above(const rim_job *job, uint32_t facet, rim_sides sides[2])
{
    const uint32_t around = job->part->divisions.around;
    const double width = 2 * job->wall->body.half;
    rim_arc arc[2];
    const int arcs = arcs_above(job, facet, arc);
    for (int k = 0; k < arcs; k++) {
        sides[k].first = (uint32_t)floor((arc[k].from + 4 * LRCS_PI) / width);
        sides[k].last = (uint32_t)floor((arc[k].to + 4 * LRCS_PI) / width);
        if (sides[k].last - sides[k].first >= around) {
            sides[k].last = sides[k].first + around - 1;
        }
    }
    return arcs;
}

/* Enters a facet under the sides that may lie above it. */
static void rim_enter(const rim_job *job, const lrcsi_wall_terms *terms, uint32_t facet)
{
    rim_sides sides[2];
    const int arcs = sides_above(job, facet, sides);
    for (int k = 0; k < arcs; k++) {
        for (uint32_t i = sides[k].first; i <= sides[k].last; i++) {
            rim_side *side = &job->side[i % job->part->divisions.around];
            const cell_set cells = facet_cells(job, &side->at, facet);
            if (terms[facet].way != LRCSI_WALL_PIECES) {
                side->uncertain |= cells;
            } else if (cells != 0) {
                side->inside |= cells;
                side->facet = side->is_summed ? side->facet : facet;
                side->is_summed |= job->visible[facet].high > 0;
                side->bound = lrcsi_max(side->bound, terms[facet].bound);
            }
        }
    }
}

/* Positive if a point is to the left of a side, where its sector is: its distance from the side's
   line times half the side's length. */
static double side_left(const lrcsi_round_side *side, const double x[2])
{
    return side->step[0] * (x[1] - side->chord[1]) - side->step[1] * (x[0] - side->chord[0]);
}

/* The cells of a side of which the margin is added if something is visible next to it. Its sector
   faces the laser; then the opening is on the other side of it, unless rounding has turned a sector
   that is edge-on. */
static cell_set certain_cells(const rim_job *job, const rim_side *side)
{
    const int certain = job->wall->view->facing[side->at.facet] > 0 &&
                        side_left(&side->at, job->wall->surface.view) < 0;
    return certain ? side->inside & ~side->uncertain : 0;
}

/* Is a point of the view plane surely in the projected opening of the facets? It is on the same
   side of each of the opening's sides as the rim's middle. */
static int is_in_opening(const rim_job *job, const double x[2])
{
    const double *middle = job->wall->surface.view;
    int in = 1;
    for (uint32_t i = 0; i < job->part->divisions.around && in; i++) {
        const lrcsi_round_side *side = &job->side[i].at;
        const double err =
            8 *
            (job->wall->surface.position_err + job->wall->view->point[side->vertex[0]].err +
             job->wall->view->point[side->vertex[1]].err) *
            lrcsi_length_flat(side->step[0], side->step[1]);
        const double here = side_left(side, x);
        const double there = side_left(side, middle);
        in = there > 0 ? here > err : here < -err;
    }
    return in;
}

/* Is a facet of the inside, in projection above a point of the opening, visible there? An answer of
   visibility/uniform/query.h. */
static int facet_answer(const rim_job *job, uint32_t facet, const double x[2])
{
    double point[3];
    if (!job->o || !lrcsi_view_point_above(job->wall->view, facet, x, point) ||
        !is_in_opening(job, x)) {
        return LRCSI_QUERY_NO_ANSWER;
    }
    return job->band->classification->undecided[facet]
               ? lrcsi_query_point(&job->o->facets, facet, point, job->meter)
               : job->o->answer[facet];
}

/* Subtracts the integral over the margin along a run of cells. If it is not known, because the wall
   is nearly edge-on somewhere, that of each cell of which it is. */
static void rim_subtract(const rim_job *job, rim_side *side, cell_set run, lrcsi_round_range range,
                         lrcsi_wall_terms *to)
{
    lrcsi_round_margin margin;
    if (lrcsi_round_margin_make(job->wall, &side->at, range, &margin)) {
        lrcsi_round_sum_append(&margin.sum, -1, &to->sum);
        side->known |= run;
        return;
    }
    for (unsigned i = 0; i < CELLS; i++) {
        const cell_set cell = run & ((cell_set)1 << i);
        range = (lrcsi_round_range){i * CELL_STEP - 1, (i + 1) * CELL_STEP - 1};
        if (cell != 0 && lrcsi_round_margin_make(job->wall, &side->at, range, &margin)) {
            lrcsi_round_sum_append(&margin.sum, -1, &to->sum);
            side->known |= cell;
        }
    }
}

/* Adds the margin along a run of cells above facets of C alone to one of these, if that lies under
   a point next to the run, half a reach inside the opening: it is visible there if and only if what
   is under the margin is. */
static void rim_add_run(const rim_job *job, rim_side *side, cell_set run, lrcsi_round_range range,
                        uint32_t facet, lrcsi_wall_terms *to)
{
    const lrcsi_round_side *at = &side->at;
    const double t = 0.5 * (range.from + range.to);
    const double right = 0.5 * job->wall->view->prepared->proximity.reach[job->wall->part] /
                         lrcsi_length_flat(at->step[0], at->step[1]);
    const double x[2] = {at->chord[0] + t * at->step[0] + right * at->step[1],
                         at->chord[1] + t * at->step[1] - right * at->step[0]};
    const int answer = facet_answer(job, facet, x);
    if (answer == LRCSI_QUERY_HIDDEN) {
        side->known |= run;
    } else if (answer == LRCSI_QUERY_VISIBLE && job->visible[facet].high > 0) {
        rim_subtract(job, side, run, range, to);
    }
}

/* Adds the margins of the sides that may lie above a facet of C, where the facet tells whether they
   are visible. */
static void rim_add_known(const rim_job *job, uint32_t facet, lrcsi_wall_terms *terms)
{
    rim_sides sides[2];
    const int arcs = sides_above(job, facet, sides);
    for (int k = 0; k < arcs; k++) {
        for (uint32_t i = sides[k].first; i <= sides[k].last; i++) {
            rim_side *side = &job->side[i % job->part->divisions.around];
            cell_set left = certain_cells(job, side);
            lrcsi_round_range range;
            for (cell_set run; (run = cells_next(&left, &range)) != 0;) {
                if ((side->known & run) == 0) {
                    rim_add_run(job, side, run, range, facet, &terms[facet]);
                }
            }
        }
    }
}

/* Adds bounds on the other margins of a side to the error of a facet of C under it. */
static void rim_add_unknown(const rim_job *job, const rim_side *side, lrcsi_wall_terms *terms)
{
    cell_set left = side->inside & ~side->known;
    lrcsi_round_range range;
    if (!lrcsi_view_may_face(job->wall->view, side->at.facet, job->part->bounds.patch.turn)) {
        return;
    }
    while (cells_next(&left, &range) != 0) {
        lrcsi_round_margin margin;
        lrcsi_round_margin_extent(job->wall, &side->at, range, &margin);
        terms[side->facet].sum.remainder += side->bound * margin.area * LRCSI_OUTWARD_NANO;
    }
}

size_t lrcsi_round_rim_need(const lrcs_prepared *prepared)
{
    size_t most = 0;
    for (uint32_t i = 0; i < prepared->scene->part_count; i++) {
        const uint32_t around = prepared->scene->part[i].divisions.around;
        most = around > most ? around : most;
    }
    return lrcsi_work_bytes(most, sizeof(rim_side));
}

/* 1. The sides are known, and no margin is wider than two reaches of the part. Then all facets
   under it meet a band of their own part (visibility/proximity/event_band.c, 3).
   2. Which facets are under which sides.
   3. The margins of which it is known whether they are visible.
   4. Bounds on the others. */
int lrcsi_round_rim_add(const lrcsi_round_wall *inside, const lrcsi_proximity_band *band,
                        const lrcsi_visible_area *visible, const lrcsi_occlusion *o,
                        lrcsi_meter *meter, lrcs_work *work, lrcsi_wall_terms *terms)
{
    const lrcs_prepared *p = inside->view->prepared;
    const lrcs_part *part = &p->scene->part[inside->part];
    const size_t mark = work->used;
    const uint32_t from = part->first_facet;
    const uint32_t to = from + part->facet_count;
    const uint32_t around = part->divisions.around;
    const rim_job job = {
        inside, band, visible, o, meter, part, lrcsi_work_take(work, around, sizeof(rim_side))};
    uint32_t sides = 0;
    int known = job.side != NULL;
    for (uint32_t f = from; f < to && known; f++) { /* 1 */
        lrcsi_round_sector sector;
        uint32_t number;
        if (rim_sector(&job, f, &sector, &number)) {
            lrcsi_round_margin margin;
            lrcsi_round_margin_extent(inside, &sector.side[0], lrcsi_round_whole_side, &margin);
            known = margin.width <= 2 * p->proximity.reach[inside->part];
            job.side[number] = (rim_side){.at = sector.side[0],
                                          .facet = LRCS_NONE,
                                          .uncertain = near_cells(&job, &sector.side[0])};
            sides++;
        }
    }
    known = known && sides == around;
    for (uint32_t f = from; f < to && known; f++) { /* 2 */
        if (is_under_rim(&job, f)) {
            rim_enter(&job, terms, f);
        }
    }
    for (uint32_t f = from; f < to && known; f++) { /* 3 */
        if (terms[f].way == LRCSI_WALL_PIECES && is_under_rim(&job, f)) {
            rim_add_known(&job, f, terms);
        }
    }
    for (uint32_t i = 0; i < around && known; i++) { /* 4 */
        rim_add_unknown(&job, &job.side[i], terms);
    }
    work->used = mark;
    return known;
}
