/* SPDX-License-Identifier: MIT */
/* The area that stays undecided along segments removed from the lists, and the facets that it is
   charged to.

   Cells. A cut adds corners near the sides that it cuts; their distance from these sides is
   measured (lrcsi_cells_shape_divide). The two parts of a cell together miss no point of it by more
   than that. The sum over all cuts from the block to a cell is the cell's `drift`: every point of
   the block belongs to a cell that is no farther from it than its drift, and what is stated about a
   cell holds for all points within its drift. So the area of a facet that is visible in a cell has
   an error of at most the drift times the perimeter of its part there: each cut adds or removes two
   triangles along the sides that it cuts, as high as the drift grows by that cut.

   Strips. Let w be the sum of the segment's error (`off`, `line_off`: visibility/cells_facet.c), 16
   u times the largest coordinate of the block, and the drift. If the computed distance of a segment
   from the cell exceeds w, the segment does not meet the cell. If the segment is nowhere deeper
   than w within the cell (LRCSI_CELLS_BORDER), its part in the cell lies within 2 w of the line
   along a side of the cell, or 4 w in a corner; or within 2 w of its own line, with the cell on one
   side of that. Let c be the distance of the sample P from these lines; it is more than 4 w. The
   path from P to x then crosses the segment only if x lies within 4 w of that line, and no farther
   along it from the segment than 4 w / c times the cell's diameter. That is below CELLS_FAR w if c
   exceeds LRCSI_CELLS_THIN times the perimeter. The area of this strip is undecided. It is charged
   to the facets of the list, to each as much as it has of the strip, when the segment is removed
   from the list; the cells cut from this one then need not consider the segment. A segment shorter
   than CELLS_FAR w may lie across the side: its strip is charged to all facets of the cell. In a
   thin cell the strips of all segments removed are taken to run along the whole cell.

   The part of a facet in a strip is no longer than the facet is within the strip. The facet's
   corners have the error `off`, the line w; so the facet is intersected with a strip that is wider
   by more than both. The points where a side of the facet enters and leaves that strip have an
   error below 4 u of the side's length, since a side that rises by less than the strip's width
   counts as a whole; CELLS_FAR w at either end is far more.

   Cuts. A cell is cut along the computed line of a segment. The true line is within `line_off` + 6
   u b of it, where b is the largest coordinate of the block. The new corners are within 6 u b of
   the computed line, and a point that belongs to one of the parts is within that part's drift of
   it, which exceeds the cell's by at most 4 u b. So P is on one side of the true line, and x can be
   on the other side only if it is within w of it, w being `line_off` + 12 u b + the cell's drift
   here. If the cell is cut along an edge of facet F, F lies on one side of the true line. On that
   side F is certain: neither P nor any point of F is beyond the edge. What F has on the other side
   is within w of the line. */
#include "visibility/cells_charge.h"

#include <math.h>

#include "base/range.h"

/* 4 / LRCSI_CELLS_THIN. */
#define CELLS_FAR 0x1p34
/* A cell that is no wider than so many strips may be charged whole. */
#define SLIVER 64

/* The interval that a facet covers along a line, measured from `start`. */
static inline void corners_along(const lrcsi_cells_facet *f, const double line[3],
                                 const double start[2], double along[2])
{
    double from = line[1] * start[0] - line[0] * start[1];
    double a = line[1] * f->x[0] - line[0] * f->y[0];
    double b = line[1] * f->x[1] - line[0] * f->y[1];
    double d = line[1] * f->x[2] - line[0] * f->y[2];
    along[0] = lrcsi_min(a, lrcsi_min(b, d)) - from;
    along[1] = lrcsi_max(a, lrcsi_max(b, d)) - from;
}

/* The same for the part of the facet within `near` of the line; along[0] > along[1] if there is
   none. Sides almost parallel to the line count as a whole. */
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
        if (lrcsi_min(d[k], d[n]) > near || lrcsi_max(d[k], d[n]) < -near) {
            continue;
        }
        if (fabs(rise) > near) {
            double enters = (-near - d[k]) / rise;
            double leaves = (near - d[k]) / rise;
            from = lrcsi_max(from, lrcsi_min(enters, leaves));
            to = lrcsi_min(to, lrcsi_max(enters, leaves));
        }
        double p = t[k] + from * (t[n] - t[k]);
        double q = t[k] + to * (t[n] - t[k]);
        along[0] = lrcsi_min(along[0], lrcsi_min(p, q));
        along[1] = lrcsi_max(along[1], lrcsi_max(p, q));
    }
}

void lrcsi_cells_charge_border(lrcsi_cells_work *c, lrcsi_cells_cell *cell,
                               const lrcsi_cells_sides *s, const lrcsi_cells_border *e)
{
    double strip = e->part.strip;
    double length = (e->part.to - e->part.from) * e->length;
    double uncertainty = strip * (length + CELLS_FAR * strip);
    if (uncertainty < 0x1p-58 * c->reach * c->reach || length < CELLS_FAR * strip) {
        cell->uncertainty += uncertainty;
        return;
    }
    double box[2][2];
    for (int k = 0; k < 2; k++) {
        double to = e->start[k] + (k == 0 ? e->line[1] : -e->line[0]) * e->length;
        box[0][k] = lrcsi_max(s->low[k], lrcsi_min(e->start[k], to));
        box[1][k] = lrcsi_min(s->high[k], lrcsi_max(e->start[k], to));
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
        if (lrcsi_max(d[0], lrcsi_max(d[1], d[2])) < -far ||
            lrcsi_min(d[0], lrcsi_min(d[1], d[2])) > far) {
            continue;
        }
        corners_along(f, e->line, e->start, along);
        if (lrcsi_min(uncertainty, strip * (along[1] - along[0])) > c->trifle) {
            facet_along(f, e->line, e->start, 2 * far, along);
            c->area[facet].cut += lrcsi_min(uncertainty / strip, lrcsi_max(0, along[1] - along[0]));
        }
        if (along[1] > e->part.from * e->length - beyond &&
            along[0] < e->part.to * e->length + beyond) {
            c->area[facet].uncertainty +=
                lrcsi_min(uncertainty, strip * (along[1] - along[0] + 2 * far));
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
    double wide = lrcsi_min(high + far, strip->width) - lrcsi_max(low - far, -strip->width);
    if (!e->contact && (e->owner[0] == f->number || e->owner[1] == f->number)) {
        wide = lrcsi_min(wide, strip->width);
    }
    corners_along(f, e->line, e->end[0], along);
    double length = lrcsi_min(along[1], strip->to) - lrcsi_max(along[0], strip->from) + 2 * beyond;
    if (wide * length > c->trifle) {
        facet_along(f, e->line, e->end[0], strip->width + 2 * far, along);
        length = lrcsi_min(along[1], strip->to) - lrcsi_max(along[0], strip->from) + 2 * beyond;
        c->area[index].cut += lrcsi_max(0, length);
    }
    c->area[index].uncertainty += lrcsi_max(0, wide) * lrcsi_max(0, length);
}

double lrcsi_cells_thin(const lrcsi_cells_cell *cell, const lrcsi_cells_sides *s, double clear,
                        uint32_t segments, double off)
{
    if (!(clear < LRCSI_CELLS_THIN * s->perimeter)) {
        return 0;
    }
    double strips = 4 * (double)segments * (cell->inset + off + s->g) * s->perimeter;
    return lrcsi_min(strips, lrcsi_clip_area(&cell->shape) + s->g * s->perimeter);
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
