/* SPDX-License-Identifier: MIT */
/* How much area is in doubt along segments that are not asked about any more, and whose.

   Cutting puts new corners within 3 u b of a side, b the largest coordinate; the two parts of a
   cell then miss no point of it by more. So a point of the block belongs to one of the cells that
   come of it, or is within 3 u b n of that, n the number of cuts; what is said of a cell holds for
   points so near to it. Let w be 2 e of what is asked about (e: visibility/cells_facet.c) and (16 +
   4 n) u b. A segment that is computed to be farther than w from the cell does not come near it.
   One that is nowhere deeper than w within the cell (LRCSI_CELLS_BORDER) has its part in the cell
   within 2 w of the line along a side of the cell, or of its own line with the cell on one side.
   The sample P is clear of these by c. So the way from P to x crosses the segment only if x lies
   within 2 w of that line, and no farther along it from the segment than 2 w / c of the cell's
   diameter, which is below CELLS_FAR w where c is above LRCSI_CELLS_THIN of the perimeter. That
   area is in doubt; it is charged to the facets of the list that come near, when the segment is
   struck from the list; all cells that come of the cell are then rid of it. In a thin cell the
   strips of all that were struck run along the whole of it. */
#include "visibility/cells_charge.h"

#include <math.h>

#include "base/range.h"

/* 4 / LRCSI_CELLS_THIN (visibility/cells_cover.h). */
#define CELLS_FAR 0x1p34
/* A cell that is no wider than so many strips may be charged whole. */
#define SLIVER 8

void lrcsi_cells_charge_border(lrcsi_cells_work *c, lrcsi_cells_cell *cell,
                               const lrcsi_cells_sides *s, const lrcsi_cells_border *e)
{
    double strip = e->w + lrcsi_most(0, e->part.deep);
    double doubt = strip * ((e->part.to - e->part.from) * e->length + CELLS_FAR * e->w);
    if (doubt < 0x1p-58 * c->reach * c->reach) {
        cell->doubt += doubt;
        return;
    }
    double box[2][2];
    for (int k = 0; k < 2; k++) {
        double to = e->start[k] + (k == 0 ? e->line[1] : -e->line[0]) * e->length;
        box[0][k] = lrcsi_most(s->low[k], lrcsi_least(e->start[k], to));
        box[1][k] = lrcsi_least(s->high[k], lrcsi_most(e->start[k], to));
    }
    double cut = 0.7 * e->length; /* length is the sum of both components, below 1.42 of it */
    for (uint32_t i = 0; i < cell->facets; i++) {
        uint32_t facet = c->facets[i];
        const lrcsi_cells_facet *f = &c->facet[facet];
        if (!c->open[facet]) {
            continue;
        }
        double far = 4 * strip + f->off + s->g;
        double reject = far + CELLS_FAR * e->w;
        if (f->low[0] > box[1][0] + reject || f->high[0] < box[0][0] - reject ||
            f->low[1] > box[1][1] + reject || f->high[1] < box[0][1] - reject) {
            continue;
        }
        double across[2] = {HUGE_VAL, -HUGE_VAL};
        double along[2] = {HUGE_VAL, -HUGE_VAL};
        for (int k = 0; k < 3; k++) {
            double d = lrcsi_line_at(e->line, f->x[k], f->y[k]);
            double t = e->line[1] * (f->x[k] - e->start[0]) - e->line[0] * (f->y[k] - e->start[1]);
            across[0] = lrcsi_least(across[0], d);
            across[1] = lrcsi_most(across[1], d);
            along[0] = lrcsi_least(along[0], t);
            along[1] = lrcsi_most(along[1], t);
        }
        double beyond = CELLS_FAR * e->w + far;
        if (across[1] > -far && across[0] < far && along[1] > e->part.from * cut - beyond &&
            along[0] < e->part.to * e->length + beyond) {
            double length = along[1] - along[0] + 2 * far;
            c->area[facet].doubt += lrcsi_least(doubt, strip * length);
            c->area[facet].cut += lrcsi_least(doubt / strip, length);
        }
    }
}

void lrcsi_cells_charge_cut(lrcsi_cells_work *c, uint32_t index, const double line[3],
                            const lrcsi_cells_strip *strip)
{
    const lrcsi_cells_facet *f = &c->facet[index];
    const lrcsi_cells_segment *along = strip->along;
    double near[2] = {HUGE_VAL, -HUGE_VAL};
    for (int k = 0; k < 3; k++) {
        double t = line[1] * (f->x[k] - along->end[0][0]) - line[0] * (f->y[k] - along->end[0][1]);
        near[0] = lrcsi_least(near[0], t);
        near[1] = lrcsi_most(near[1], t);
    }
    double beyond = CELLS_FAR * strip->width + f->off;
    double length = lrcsi_least(near[1] + beyond, strip->to + beyond) -
                    lrcsi_most(near[0] - beyond, strip->from - beyond);
    c->area[index].doubt += 2 * strip->width * lrcsi_most(0, length);
    c->area[index].cut += lrcsi_most(0, length);
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
            c->area[facet].doubt += cell->doubt + area;
            c->area[facet].cut += 0.5 * s->perimeter;
        }
    }
    return 1;
}
