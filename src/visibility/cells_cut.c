/* SPDX-License-Identifier: MIT */
/* Cells are cut: their lists go with the parts that they may come near, the left part in place, the
   right one behind it. Which line to cut along is decided elsewhere. */
#include "visibility/cells_cut.h"

#include <math.h>
#include <string.h>

#include "base/range.h"
#include "visibility/cells_charge.h"

#define U 0x1p-53

/* Does a segment that met the cell which this one was cut from meet it too? If not, its own line or
   that of the cut parts them. */
static int segment_stays(const lrcsi_cells_cell *cell, const lrcsi_cells_segment *e, double w)
{
    if (!(cell->sign * lrcsi_line_at(cell->cut, e->end[0][0], e->end[0][1]) > w) &&
        !(cell->sign * lrcsi_line_at(cell->cut, e->end[1][0], e->end[1][1]) > w)) {
        return 0;
    }
    double range[2];
    lrcsi_line_range(&cell->shape, e->line, range);
    return range[0] < -w && range[1] > w;
}

void lrcsi_cells_strike(lrcsi_cells_work *c, lrcsi_cells_cell *cell, const lrcsi_cells_sides *s)
{
    uint32_t *list = lrcsi_cells_segments(c, cell);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < cell->segments; i++) {
        const lrcsi_cells_segment *e = &c->segment[list[i]];
        double w = e->off + s->g;
        if (cell->cuts > 0 && segment_stays(cell, e, w)) {
            list[kept++] = list[i];
            continue;
        }
        lrcsi_cells_part part;
        int place = lrcsi_cells_place_of(&cell->shape, s, e->end[0], e->end[1], e->line, w, &part);
        if (place == LRCSI_CELLS_MEETS) {
            list[kept++] = list[i];
        } else if (place == LRCSI_CELLS_BORDER) {
            cell->struck++;
            cell->inset = lrcsi_most(cell->inset, w + lrcsi_most(0, part.deep));
            lrcsi_cells_charge_border(c, cell, s,
                                      &(lrcsi_cells_border){{e->line[0], e->line[1], e->line[2]},
                                                            {e->end[0][0], e->end[0][1]},
                                                            e->length,
                                                            w,
                                                            part});
        }
    }
    cell->segments = kept;
}

/* Whether a facet on both sides of a cut comes near the parts: one side of it may have all of a
   part beyond it, which then has the corners that both parts share. */
static void part_near(const lrcsi_cells_facet *f, const lrcsi_clip_polygon *left,
                      const lrcsi_clip_polygon *right, const double *const common[2], int commons,
                      double g, int *on_left, int *on_right)
{
    double w = f->off + g;
    for (int k = 0; k < 3; k++) {
        int beyond = 1;
        for (int i = 0; i < commons && beyond; i++) {
            beyond = lrcsi_line_at(f->side[k], common[i][0], common[i][1]) < -w;
        }
        if (beyond) {
            double range[2];
            lrcsi_line_range(left, f->side[k], range);
            *on_left &= !(range[1] < -w);
            lrcsi_line_range(right, f->side[k], range);
            *on_right &= !(range[1] < -w);
        }
    }
}

/* Lists the facets of a cell with the parts that they may come near. */
static void cut_facets(lrcsi_cells_work *c, const lrcsi_cells_cell *cell, const double line[3],
                       const lrcsi_cells_shape_cut *cut, const lrcsi_cells_strip *strip, double g,
                       lrcsi_cells_cell *left, lrcsi_cells_cell *right)
{
    uint32_t *in = c->list + cell->first;
    uint32_t *to_right = c->list + right->first;
    for (uint32_t i = 0; i < cell->facets; i++) {
        uint32_t index = in[i];
        const lrcsi_cells_facet *f = &c->facet[index];
        double w = f->off + g + strip->width;
        double a = lrcsi_line_at(line, f->x[0], f->y[0]);
        double b = lrcsi_line_at(line, f->x[1], f->y[1]);
        double d = lrcsi_line_at(line, f->x[2], f->y[2]);
        double low = lrcsi_least(a, lrcsi_least(b, d));
        double high = lrcsi_most(a, lrcsi_most(b, d));
        int on_left = high > -w;
        int on_right = low < w;
        if (on_left && on_right) {
            if (strip->along && c->open[index]) {
                lrcsi_cells_charge_cut(c, index, low, high, strip);
            }
            part_near(f, &left->shape, &right->shape, cut->common, cut->commons, g, &on_left,
                      &on_right);
        }
        if (on_left) {
            in[left->facets++] = index;
        }
        if (on_right) {
            to_right[right->facets++] = index;
        }
    }
}

/* Lists its segments likewise, after the facets, but the one at which it is cut. */
static void cut_segments(lrcsi_cells_work *c, const lrcsi_cells_cell *cell, const double line[3],
                         uint32_t struck, double g, lrcsi_cells_cell *left, lrcsi_cells_cell *right)
{
    const uint32_t *in = lrcsi_cells_segments(c, cell);
    uint32_t *to_left = c->list + left->first + left->facets;
    uint32_t *to_right = c->list + right->first + right->facets;
    for (uint32_t i = 0; i < cell->segments; i++) {
        uint32_t index = in[i];
        const lrcsi_cells_segment *e = &c->segment[index];
        if (index == struck) {
            continue;
        }
        double w = e->off + g;
        double a = lrcsi_line_at(line, e->end[0][0], e->end[0][1]);
        double b = lrcsi_line_at(line, e->end[1][0], e->end[1][1]);
        if (a > -w || b > -w) {
            to_left[left->segments++] = index;
        }
        if (a < w || b < w) {
            to_right[right->segments++] = index;
        }
    }
}

int lrcsi_cells_cut(lrcsi_cells_work *c, const lrcsi_cells_cell *cell, const lrcsi_cells_sides *s,
                    const double line[3], const lrcsi_cells_segment *along)
{
    uint32_t struck = along ? (uint32_t)(along - c->segment) : LRCS_NONE;
    lrcsi_cells_strip strip = {along, 0, 0, 0, s->g};
    if (along) {
        lrcsi_cells_part part = {0, 1, 0};
        strip.width = along->line_off + s->g + 4 * U * c->reach + U * s->perimeter;
        lrcsi_cells_place_of(&cell->shape, s, along->end[0], along->end[1], along->line,
                             lrcsi_most(strip.width, along->off + s->g), &part);
        strip.from = part.from * along->length;
        strip.to = part.to * along->length;
    }
    uint32_t total = cell->facets + cell->segments;
    size_t end = cell->first + total;
    if (cell->shape.count + 2 > LRCSI_CLIP_SIDES || c->top + 2 > LRCSI_CELLS_WAITING ||
        end + total > c->room) {
        return 0;
    }
    lrcsi_cells_cell left = *cell;
    lrcsi_cells_cell right = *cell;
    lrcsi_cells_shape_cut cut =
        lrcsi_cells_shape_divide(&cell->shape, line, &left.shape, &right.shape);
    if (left.shape.count < 3 || right.shape.count < 3) {
        return 0;
    }
    double drift = cell->drift + cut.drift;
    double g = 16 * U * c->reach + drift;
    memcpy(left.cut, line, sizeof left.cut);
    memcpy(right.cut, line, sizeof right.cut);
    left.sign = 1;
    right.sign = -1;
    left.cuts = right.cuts = cell->cuts + 1;
    left.struck = right.struck = cell->struck + (along != NULL);
    left.inset = right.inset = lrcsi_most(cell->inset, 2 * strip.width);
    left.drift = right.drift = drift;
    left.facets = right.facets = left.segments = right.segments = 0;
    right.first = end;
    cut_facets(c, cell, line, &cut, &strip, g, &left, &right);
    cut_segments(c, cell, line, struck, g, &left, &right);
    c->stack[c->top++] = left;
    c->stack[c->top++] = right;
    return 1;
}

int lrcsi_cells_halve(lrcsi_cells_work *c, const lrcsi_cells_cell *cell, const lrcsi_cells_sides *s)
{
    int wide = s->high[0] - s->low[0] > s->high[1] - s->low[1];
    const double line[3] = {
        wide, !wide, wide ? -0.5 * (s->low[0] + s->high[0]) : -0.5 * (s->low[1] + s->high[1])};
    return lrcsi_cells_cut(c, cell, s, line, NULL);
}
