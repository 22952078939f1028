/* SPDX-License-Identifier: MIT */
/* How much area is undecided along segments that are not asked about any more, and whose.

   Cells. A cut puts new corners beside the sides that it cuts, by no more than is measured where it
   is made (lrcsi_cells_shape_divide); the two parts of a cell then miss no point of it by more. The
   sum of that over all cuts on the way to a cell is its `drift`. So a point of the block belongs to
   a cell that is no farther from it than its drift; what is said of a cell holds for points so near
   to it. A facet that is seen in a cell has its area there off by no more than the drift times the
   perimeter of what it has there: at each cut it is two triangles upon the cut sides, as high as
   the drift grows by then.

   Strips. Let w be the error of what is asked about (`off`, `line_off`: visibility/cells_facet.c),
   16 u times the largest coordinate of the block, and the drift. A segment that is computed to be
   farther than w from the cell does not come near it. One that is nowhere deeper than w within the
   cell (LRCSI_CELLS_BORDER) has its part in the cell within 2 w of the line along a side of the
   cell, or of its own line with the cell on one side. The sample P is clear of these by c. So the
   way from P to x crosses the segment only if x lies within 2 w of that line, and no farther along
   it from the segment than 2 w / c of the cell's diameter, which is below CELLS_FAR w where c is
   above LRCSI_CELLS_THIN of the perimeter. That area is undecided; it is charged to the facets of
   the list, as much of it as they have, when the segment is struck from the list; all cells that
   come of the cell are then rid of it. In a thin cell the strips of all that were struck run along
   the whole of it.

   What a facet has of a strip is no longer than the facet is within the strip. Its corners are off
   by `off`, lines by w: it is looked for in a strip wider by more than both. Where a side enters
   and leaves that is off by less than 4 u of its length, for it counts as a whole where it rises by
   less than the strip's width; CELLS_FAR w on either end is far more.

   A cell is cut along the line of a segment as computed. The true line is within `line_off` and 6 u
   b of it, b the largest coordinate of the block. The new corners are within 6 u b of it, and what
   belongs to one of the parts is as near to that as its drift is, which is the cell's and at most 4
   u b. So P is on one side of the true line, and x is on the other only within `line_off`, 12 u b
   and the cell's drift of it: w, here. A facet F lies on one side of its own edge. So where the
   cell is cut along that, F is in no doubt on its own side: neither P nor any point of F is beyond
   the edge. What F has on the other side is nearer to the line than w. */
#include "visibility/cells_charge.h"

#include <math.h>

#include "base/range.h"

/* 4 / LRCSI_CELLS_THIN. */
#define CELLS_FAR 0x1p34
/* A cell that is no wider than so many strips may be charged whole. */
#define SLIVER 8

/* How far a facet goes along a line, from `start`. */
static inline void corners_along(const lrcsi_cells_facet *f, const double line[3],
                                 const double start[2], double along[2])
{
    double from = line[1] * start[0] - line[0] * start[1];
    double a = line[1] * f->x[0] - line[0] * f->y[0];
    double b = line[1] * f->x[1] - line[0] * f->y[1];
    double d = line[1] * f->x[2] - line[0] * f->y[2];
    along[0] = lrcsi_least(a, lrcsi_least(b, d)) - from;
    along[1] = lrcsi_most(a, lrcsi_most(b, d)) - from;
}

/* The same where it is within `near` of it; along[0] >
   along[1] where it is nowhere. Sides that are almost parallel count as a whole. */
static void facet_along(const lrcsi_cells_facet *f, const double line[3], const double start[2],
                        double near, double along[2])
{
    double d[3];
    double t[3];
    for (int k = 0; k < 3; k++) {
        d[k] = lrcsi_line_at(line, f->x[k], f->y[k]);
        t[k] = line[1] * (f->x[k] - start[0]) - line[0] * (f->y[k] - start[1]);
    }
    along[0] = HUGE_VAL;
    along[1] = -HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        int n = k == 2 ? 0 : k + 1;
        double rise = d[n] - d[k];
        double from = 0;
        double to = 1;
        if (lrcsi_least(d[k], d[n]) > near || lrcsi_most(d[k], d[n]) < -near) {
            continue;
        }
        if (fabs(rise) > near) {
            double enters = (-near - d[k]) / rise;
            double leaves = (near - d[k]) / rise;
            from = lrcsi_most(from, lrcsi_least(enters, leaves));
            to = lrcsi_least(to, lrcsi_most(enters, leaves));
        }
        double p = t[k] + from * (t[n] - t[k]);
        double q = t[k] + to * (t[n] - t[k]);
        along[0] = lrcsi_least(along[0], lrcsi_least(p, q));
        along[1] = lrcsi_most(along[1], lrcsi_most(p, q));
    }
}

void lrcsi_cells_charge_border(lrcsi_cells_work *c, lrcsi_cells_cell *cell,
                               const lrcsi_cells_sides *s, const lrcsi_cells_border *e)
{
    double strip = e->part.strip;
    double uncertainty = strip * ((e->part.to - e->part.from) * e->length + CELLS_FAR * strip);
    if (uncertainty < 0x1p-58 * c->reach * c->reach) {
        cell->uncertainty += uncertainty;
        return;
    }
    double box[2][2];
    for (int k = 0; k < 2; k++) {
        double to = e->start[k] + (k == 0 ? e->line[1] : -e->line[0]) * e->length;
        box[0][k] = lrcsi_most(s->low[k], lrcsi_least(e->start[k], to));
        box[1][k] = lrcsi_least(s->high[k], lrcsi_most(e->start[k], to));
    }
    for (uint32_t i = 0; i < cell->facets; i++) {
        uint32_t facet = c->facets[i];
        const lrcsi_cells_facet *f = &c->facet[facet];
        if (!c->open[facet]) {
            continue;
        }
        double far = 4 * strip + f->off + s->g;
        double beyond = CELLS_FAR * strip + far;
        if (f->low[0] > box[1][0] + beyond || f->high[0] < box[0][0] - beyond ||
            f->low[1] > box[1][1] + beyond || f->high[1] < box[0][1] - beyond) {
            continue;
        }
        double d[3];
        double along[2];
        for (int k = 0; k < 3; k++) {
            d[k] = lrcsi_line_at(e->line, f->x[k], f->y[k]);
        }
        if (lrcsi_most(d[0], lrcsi_most(d[1], d[2])) < -far ||
            lrcsi_least(d[0], lrcsi_least(d[1], d[2])) > far) {
            continue;
        }
        corners_along(f, e->line, e->start, along);
        if (lrcsi_least(uncertainty, strip * (along[1] - along[0])) > c->trifle) {
            facet_along(f, e->line, e->start, 2 * far, along);
            c->area[facet].cut +=
                lrcsi_least(uncertainty / strip, lrcsi_most(0, along[1] - along[0]));
        }
        if (along[1] > e->part.from * e->length - beyond &&
            along[0] < e->part.to * e->length + beyond) {
            c->area[facet].uncertainty +=
                lrcsi_least(uncertainty, strip * (along[1] - along[0] + 2 * far));
        }
    }
}

void lrcsi_cells_charge_cut(lrcsi_cells_work *c, uint32_t index, double low, double high,
                            const lrcsi_cells_strip *strip)
{
    const lrcsi_cells_segment *e = strip->along;
    const lrcsi_cells_facet *f = &c->facet[index];
    double far = f->off + strip->g;
    double beyond = CELLS_FAR * strip->width + far;
    double along[2];
    double wide = lrcsi_least(high + far, strip->width) - lrcsi_most(low - far, -strip->width);
    if (!e->contact && (e->owner[0] == f->number || e->owner[1] == f->number)) {
        wide = lrcsi_least(wide, strip->width);
    }
    corners_along(f, e->line, e->end[0], along);
    double length =
        lrcsi_least(along[1], strip->to) - lrcsi_most(along[0], strip->from) + 2 * beyond;
    if (wide * length > c->trifle) {
        facet_along(f, e->line, e->end[0], strip->width + 2 * far, along);
        length = lrcsi_least(along[1], strip->to) - lrcsi_most(along[0], strip->from) + 2 * beyond;
        c->area[index].cut += lrcsi_most(0, length);
    }
    c->area[index].uncertainty += lrcsi_most(0, wide) * lrcsi_most(0, length);
}

double lrcsi_cells_thin(const lrcsi_cells_cell *cell, const lrcsi_cells_sides *s, double clear,
                        uint32_t segments, double off)
{
    if (!(clear < LRCSI_CELLS_THIN * s->perimeter)) {
        return 0;
    }
    double strips = 2 * (double)segments * (cell->inset + off + s->g) * s->perimeter;
    return lrcsi_least(strips, lrcsi_clip_area(&cell->shape) + s->g * s->perimeter);
}

int lrcsi_cells_charge_all(lrcsi_cells_work *c, const lrcsi_cells_cell *cell,
                           const lrcsi_cells_sides *s)
{
    double wide = SLIVER * (cell->inset + c->off + s->g);
    double area = lrcsi_clip_area(&cell->shape) + 2 * s->g * s->perimeter;
    if (!(area < wide * s->perimeter)) {
        return 0;
    }
    for (uint32_t i = 0; i < cell->facets; i++) {
        uint32_t facet = c->facets[i];
        c->found[facet] |= LRCSI_CELLS_SPARED;
        if (c->open[facet]) {
            c->area[facet].uncertainty += cell->uncertainty + area;
            c->area[facet].cut += 0.5 * s->perimeter;
        }
    }
    return 1;
}
