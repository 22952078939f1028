/* SPDX-License-Identifier: MIT */
/* Finds which facets of the inside lie under which sides of the rim, and adds the margins. */
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

/* A side of the rim, and the facets of the inside under it. */
typedef struct rim_side {
    lrcsi_round_side at;
    uint32_t facet; /* one that is in C, if possible one that the sum includes; LRCS_NONE: there is
                       none */
    int is_summed;  /* the sum includes that facet: something of it may be visible */
    int is_visible; /* something of one of the facets in C is visible */
    int is_certain; /* all facets are in C, and no other part's shadow ends on them */
    double bound;   /* on G above those in C */
} rim_side;

typedef struct rim_job {
    const lrcsi_round_wall *wall;
    const lrcsi_proximity_band *band;
    const lrcsi_visible_area *visible;
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

/* Enters a facet under the sides that may lie above it. */
static void rim_enter(const rim_job *job, const lrcsi_wall_terms *terms, uint32_t facet)
{
    const lrcsi_part_set others = lrcsi_part_set_without(job->band->parts[facet], job->wall->part);
    const uint32_t around = job->part->divisions.around;
    const double width = 2 * job->wall->body.half;
    rim_arc arc[2];
    const int arcs = arcs_above(job, facet, arc);
    for (int k = 0; k < arcs; k++) {
        const uint32_t first = (uint32_t)floor((arc[k].from + 4 * LRCS_PI) / width);
        const uint32_t last = (uint32_t)floor((arc[k].to + 4 * LRCS_PI) / width);
        for (uint32_t i = first; i <= last && i - first < around; i++) {
            rim_side *side = &job->side[i % around];
            side->is_certain &= terms[facet].way == LRCSI_WALL_PIECES && others == 0;
            if (terms[facet].way == LRCSI_WALL_PIECES) {
                side->facet = side->is_summed ? side->facet : facet;
                side->is_summed |= job->visible[facet].high > 0;
                side->is_visible |= job->visible[facet].low > 0;
                side->bound = lrcsi_max(side->bound, terms[facet].bound);
            }
        }
    }
}

/* Adds the margin of a side of the rim to a facet under it or, if that is uncertain, a bound on it
   to the facet's error. */
static void rim_add_margin(const rim_job *job, const rim_side *side, lrcsi_wall_terms *terms)
{
    const lrcsi_view *view = job->wall->view;
    const lrcsi_round_side *at = &side->at;
    const int away = view->facing[at->facet] <= 0;
    lrcsi_round_margin margin;
    if (side->facet == LRCS_NONE ||
        !lrcsi_view_may_face(view, at->facet, job->part->bounds.patch.turn)) {
        return;
    }
    lrcsi_wall_terms *to = &terms[side->facet];
    if (lrcsi_round_margin_make(job->wall, at, lrcsi_round_whole_side, &margin) && !away &&
        side->is_certain && side->is_summed && side->is_visible) {
        lrcsi_round_sum_append(&margin.sum, -1, &to->sum);
    } else {
        to->sum.remainder += side->bound * margin.area * LRCSI_OUTWARD_NANO;
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
   3. The margins of the sides. */
int lrcsi_round_rim_add(const lrcsi_round_wall *inside, const lrcsi_proximity_band *band,
                        const lrcsi_visible_area *visible, lrcs_work *work, lrcsi_wall_terms *terms)
{
    const lrcs_prepared *p = inside->view->prepared;
    const lrcs_part *part = &p->scene->part[inside->part];
    const size_t mark = work->used;
    const uint32_t from = part->first_facet;
    const uint32_t to = from + part->facet_count;
    const uint32_t around = part->divisions.around;
    const rim_job job = {inside, band, visible, part,
                         lrcsi_work_take(work, around, sizeof(rim_side))};
    uint32_t sides = 0;
    int known = job.side != NULL;
    for (uint32_t f = from; f < to && known; f++) { /* 1 */
        lrcsi_round_sector sector;
        uint32_t number;
        if (rim_sector(&job, f, &sector, &number)) {
            lrcsi_round_margin margin;
            lrcsi_round_margin_extent(inside, &sector.side[0], lrcsi_round_whole_side, &margin);
            known = margin.width <= 2 * p->proximity.reach[inside->part];
            job.side[number] =
                (rim_side){.at = sector.side[0], .facet = LRCS_NONE, .is_certain = 1};
            sides++;
        }
    }
    known = known && sides == around;
    for (uint32_t f = from; f < to && known; f++) { /* 2 */
        if (is_under_rim(&job, f)) {
            rim_enter(&job, terms, f);
        }
    }
    for (uint32_t i = 0; i < around && known; i++) { /* 3 */
        rim_add_margin(&job, &job.side[i], terms);
    }
    work->used = mark;
    return known;
}
