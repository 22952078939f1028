/* SPDX-License-Identifier: MIT */
/* Cutting a cell along a line. Its lists are divided in place: first the entries that may be near
   the left part, last those that can be near the right part only. The line is chosen by the
   caller. */
#include "visibility/cells_cut.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/range.h"
#include "visibility/cells_charge.h"

/* Corners above which a cell is halved. */
#define MANY_CORNERS 20u
/* So is one with more segments than this, if few of them are then in both halves: the line of an
   edge of a rim has all of the rim on one side, so that a cut along it removes just one segment. */
#define MANY_SEGMENTS 16u
/* So many cuts after its block a cell is not halved any more if nearly all segments stay together:
   they may meet in a point. */
#define HALVINGS 24u

/* A segment met the cell that this one was cut from. Does it meet this one too? If not, either its
   own line or that of the cut separates them. */
static int segment_stays(const lrcsi_cells_cell *cell, const lrcsi_cells_segment *e, double w)
{
    if (!(cell->sign * lrcsi_line_at(cell->cut, e->end[0][0], e->end[0][1]) > w) &&
        !(cell->sign * lrcsi_line_at(cell->cut, e->end[1][0], e->end[1][1]) > w)) {
        return 0;
    }
    int left = 0;
    int right = 0;
    for (uint32_t i = 0; i < cell->shape.count && !(left && right); i++) {
        const double *corner = cell->shape.corner[i];
        double distance = lrcsi_line_at(e->line, corner[0], corner[1]);
        left |= distance > w;
        right |= distance < -w;
    }
    return left && right;
}

void lrcsi_cells_strike(lrcsi_cells_work *c, lrcsi_cells_cell *cell, const lrcsi_cells_sides *s)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < cell->segments; i++) {
        const lrcsi_cells_segment *e = &c->segment[c->segments[i]];
        double w = e->off + s->g;
        if (cell->cuts > 0 && segment_stays(cell, e, w)) {
            lrcsi_cells_keep(c->segments, i, kept++);
            continue;
        }
        lrcsi_cells_part part;
        int place = lrcsi_cells_place_of(&cell->shape, s, e->end[0], e->end[1], e->line, w,
                                         e->line_off + s->g, &part);
        if (place == LRCSI_CELLS_MEETS) {
            lrcsi_cells_keep(c->segments, i, kept++);
        } else if (place == LRCSI_CELLS_BORDER) {
            cell->struck++;
            cell->inset = lrcsi_max(cell->inset, part.strip);
            lrcsi_cells_charge_border(c, cell, s,
                                      &(lrcsi_cells_border){{e->line[0], e->line[1], e->line[2]},
                                                            {e->end[0][0], e->end[0][1]},
                                                            e->length,
                                                            part});
        }
    }
    cell->segments = kept;
}

/* The least and the greatest signed distance of a facet's corners from a line. */
static inline void facet_range(const lrcsi_cells_facet *f, const double line[3], double range[2])
{
    double a = lrcsi_line_at(line, f->x[0], f->y[0]);
    double b = lrcsi_line_at(line, f->x[1], f->y[1]);
    double d = lrcsi_line_at(line, f->x[2], f->y[2]);
    range[0] = lrcsi_min(a, lrcsi_min(b, d));
    range[1] = lrcsi_max(a, lrcsi_max(b, d));
}

/* Is all of a cell beyond one side of a facet? Ends at the first corner after which no side can
   have all of them beyond it. */
static int facet_beyond(const lrcsi_cells_facet *f, const lrcsi_clip_polygon *shape, double w)
{
    double most[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (uint32_t i = 0; i < shape->count; i++) {
        double x = shape->corner[i][0];
        double y = shape->corner[i][1];
        most[0] = lrcsi_max(most[0], lrcsi_line_at(f->side[0], x, y));
        most[1] = lrcsi_max(most[1], lrcsi_line_at(f->side[1], x, y));
        most[2] = lrcsi_max(most[2], lrcsi_line_at(f->side[2], x, y));
        if (!(lrcsi_min(most[0], lrcsi_min(most[1], most[2])) < -w)) {
            return 0;
        }
    }
    return 1;
}

/* Divides the facets of a cell: first those that may be near the left part, last those that are
   near the right part only. */
static void cut_facets(lrcsi_cells_work *c, const lrcsi_cells_cell *cell,
                       const lrcsi_cells_strip *strip, lrcsi_cells_cell *left,
                       lrcsi_cells_cell *right)
{
    double g = lrcsi_cells_reach(c, left);
    uint32_t i = 0;
    uint32_t end = cell->facets;
    while (i < end) {
        uint32_t index = c->facets[i];
        const lrcsi_cells_facet *f = &c->facet[index];
        double w = f->off + g + strip->width;
        double range[2];
        facet_range(f, left->cut, range);
        int on_left = range[1] > -w;
        int on_right = range[0] < w;
        if (on_left && on_right) {
            if (strip->along && c->open[index]) {
                lrcsi_cells_charge_cut(c, index, range[0], range[1], strip);
            }
            on_left = !facet_beyond(f, &left->shape, f->off + g);
        }
        if (on_left) {
            lrcsi_cells_keep(c->facets, i++, left->facets++);
        } else if (on_right) {
            lrcsi_cells_keep(c->facets, i, --end);
        } else {
            i++;
        }
    }
    right->both[0] = end;
}

/* Divides its segments in the same way, except for the one along which it is cut. */
static void cut_segments(lrcsi_cells_work *c, const lrcsi_cells_cell *cell, uint32_t struck,
                         lrcsi_cells_cell *left, lrcsi_cells_cell *right)
{
    double g = lrcsi_cells_reach(c, left);
    uint32_t i = 0;
    uint32_t end = cell->segments;
    while (i < end) {
        uint32_t index = c->segments[i];
        const lrcsi_cells_segment *e = &c->segment[index];
        double w = e->off + g;
        if (index == struck) { /* it goes to the very end */
            end--;
            right->segments--;
            lrcsi_cells_keep(c->segments, i, end);
            lrcsi_cells_keep(c->segments, end, right->segments);
        } else if (lrcsi_line_at(left->cut, e->end[0][0], e->end[0][1]) > -w ||
                   lrcsi_line_at(left->cut, e->end[1][0], e->end[1][1]) > -w) {
            lrcsi_cells_keep(c->segments, i++, left->segments++);
        } else {
            lrcsi_cells_keep(c->segments, i, --end);
        }
    }
    right->both[1] = end;
}

/* Selects the entries of a cell that has waited. */
static void cell_settle(lrcsi_cells_work *c, lrcsi_cells_cell *cell)
{
    double g = lrcsi_cells_reach(c, cell);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < cell->facets; i++) {
        const lrcsi_cells_facet *f = &c->facet[c->facets[i]];
        double range[2];
        facet_range(f, cell->cut, range);
        if (i >= cell->both[0] ||
            (range[0] < f->off + g + cell->strip && !facet_beyond(f, &cell->shape, f->off + g))) {
            lrcsi_cells_keep(c->facets, i, kept++);
        }
    }
    cell->facets = kept;
    kept = 0;
    for (uint32_t i = 0; i < cell->segments; i++) {
        const lrcsi_cells_segment *e = &c->segment[c->segments[i]];
        double w = e->off + g;
        if (i >= cell->both[1] || lrcsi_line_at(cell->cut, e->end[0][0], e->end[0][1]) < w ||
            lrcsi_line_at(cell->cut, e->end[1][0], e->end[1][1]) < w) {
            lrcsi_cells_keep(c->segments, i, kept++);
        }
    }
    cell->segments = kept;
    cell->both[0] = cell->both[1] = 0;
}

lrcsi_cells_cell lrcsi_cells_take(lrcsi_cells_work *c)
{
    lrcsi_cells_cell cell = c->stack[--c->top];
    if (cell.both[0] > 0 || cell.both[1] > 0) {
        cell_settle(c, &cell);
    }
    return cell;
}

/* Divides a cell along a line: that of segment number struck, or any if struck is LRCS_NONE. */
static int cell_cut(lrcsi_cells_work *c, const lrcsi_cells_cell *cell, const lrcsi_cells_sides *s,
                    const double line[3], uint32_t struck)
{
    lrcsi_cells_strip strip = {NULL, 0, 0, 0, s->g};
    if (struck != LRCS_NONE) {
        const lrcsi_cells_segment *along = &c->segment[struck];
        lrcsi_cells_part part = {0, 1, 0};
        strip.along = along;
        strip.width = along->line_off + cell->drift + 12 * LRCSI_U * c->reach;
        lrcsi_cells_place_of(&cell->shape, s, along->end[0], along->end[1], along->line,
                             along->off + s->g, along->off + s->g, &part);
        strip.from = part.from * along->length;
        strip.to = part.to * along->length;
    }
    if (cell->cuts >= LRCSI_CELLS_CUTS || cell->shape.count + 2 > LRCSI_CLIP_SIDES ||
        c->top + 2 > LRCSI_CELLS_WAITING) {
        return 0;
    }
    lrcsi_cells_cell left = *cell;
    lrcsi_cells_cell right = *cell;
    double drift = lrcsi_cells_shape_divide(&cell->shape, line, &left.shape, &right.shape);
    if (left.shape.count < 3 || right.shape.count < 3) {
        return 0;
    }
    memcpy(left.cut, line, sizeof left.cut);
    memcpy(right.cut, line, sizeof right.cut);
    left.sign = 1;
    right.sign = -1;
    left.cuts = right.cuts = cell->cuts + 1;
    left.struck = right.struck = cell->struck + (struck != LRCS_NONE);
    left.inset = right.inset = lrcsi_max(cell->inset, 2 * strip.width);
    left.drift = right.drift = cell->drift + drift;
    left.strip = right.strip = strip.width;
    left.facets = left.segments = 0;
    cut_facets(c, cell, &strip, &left, &right);
    cut_segments(c, cell, struck, &left, &right);
    c->stack[c->top++] = right;
    c->stack[c->top++] = left;
    return 1;
}

/* The line across the middle of a cell's box, at right angles to its longer side. */
static void middle_line(const lrcsi_cells_sides *s, double line[3])
{
    int wide = s->high[0] - s->low[0] > s->high[1] - s->low[1];
    line[0] = wide;
    line[1] = !wide;
    line[2] = wide ? -0.5 * (s->low[0] + s->high[0]) : -0.5 * (s->low[1] + s->high[1]);
}

int lrcsi_cells_halve(lrcsi_cells_work *c, const lrcsi_cells_cell *cell, const lrcsi_cells_sides *s)
{
    double line[3];
    middle_line(s, line);
    return cell_cut(c, cell, s, line, LRCS_NONE);
}

/* Would the halves of a cell with many segments have few in common? If each has three quarters of
   them at most, these may be an eighth; else at most one. */
static int halves_well(const lrcsi_cells_work *c, const lrcsi_cells_cell *cell,
                       const lrcsi_cells_sides *s)
{
    double line[3];
    uint32_t side[2] = {0, 0};
    middle_line(s, line);
    for (uint32_t i = 0; cell->segments > MANY_SEGMENTS && i < cell->segments; i++) {
        const lrcsi_cells_segment *e = &c->segment[c->segments[i]];
        double a = lrcsi_line_at(line, e->end[0][0], e->end[0][1]);
        double b = lrcsi_line_at(line, e->end[1][0], e->end[1][1]);
        side[0] += a > 0 || b > 0;
        side[1] += !(a > 0 && b > 0);
    }
    uint32_t most = side[0] > side[1] ? side[0] : side[1];
    uint32_t both = side[0] + side[1] - cell->segments;
    return cell->segments > MANY_SEGMENTS &&
           (most <= cell->segments / 4 * 3 ? both <= cell->segments / 8
                                           : both <= 1 && cell->cuts < HALVINGS);
}

int lrcsi_cells_divide(lrcsi_cells_work *c, const lrcsi_cells_cell *cell,
                       const lrcsi_cells_sides *s, const lrcsi_cells_segment *along)
{
    return cell->shape.count > MANY_CORNERS || halves_well(c, cell, s)
               ? lrcsi_cells_halve(c, cell, s)
               : cell_cut(c, cell, s, along->line, (uint32_t)(along - c->segment));
}
