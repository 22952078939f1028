/* SPDX-License-Identifier: MIT */
/* Cells are cut along lines here, and the area that rounding leaves undecided along these lines,
   and along segments at the border of a cell, is charged to facets. The caller chooses the lines.

   Shape error. A cut adds corners near the sides that it cuts. Their distance from these sides is
   measured (lrcsi_clip_divide): the two parts of a cell together miss no point of it by more than
   that. The sum over all cuts from the block to a cell is the cell's `shape_err`. Every point of
   the block belongs to a cell that is no farther from it than this, and statements about a cell
   hold for all points within this distance of it. So the area of a facet that is visible in a cell
   has an error of at most the shape error times the perimeter of its part there: each cut adds or
   removes two triangles along the sides that it cuts, as high as the shape error grows by that cut.

   Segments at the border. Let w be the sum of the segment's error (`err`, `line_err`:
   visibility/cells/cells_facet.c), 16 u times the largest coordinate of the block, and the shape
   error. If the computed distance of a segment from the cell exceeds w, the segment does not meet
   the cell. If no point of the segment is more than w inside the cell (LRCSI_CLIP_BORDER), its part
   in the cell lies within 2 w of the line along a side of the cell, or 4 w in a corner; or within 2
   w of its own line, with the cell on one side of that line. Let c be the distance of the sample P
   from these lines; it exceeds 4 w. The path from P to x then crosses the segment only if x lies
   within 4 w of that line, and no farther along it from the segment than 4 w / c times the cell's
   diameter. That is below STRIP_OVERHANG w if c exceeds MAX_THIN times the perimeter. The
   area of this strip is undecided. It is charged to the facets of the list, to each no more than
   its part of the strip, when the segment is removed from the list; the cells cut from this one
   then need not consider the segment. A segment shorter than STRIP_OVERHANG w may lie across the
   side: its strip is charged to all facets of the cell. In a thin cell the strips of all removed
   segments are taken to run along the whole cell.

   The part of a facet in a strip is no longer than the facet is within the strip. The facet's
   corners have the error `err`, the line w; so the facet is intersected with a strip that is wider
   by more than both. The points where a side of the facet enters and leaves that strip have an
   error below 4 u of the side's length, since a side that rises by less than the strip's width
   counts as a whole; the overhang at either end is far more.

   Cuts. A cell is cut along the computed line of a segment. The true line is within `line_err` + 6
   u b of it, where b is the largest coordinate of the block. The new corners are within 6 u b of
   the computed line, and a point that belongs to one of the parts is within that part's shape error
   of it, which exceeds the cell's by at most 4 u b. So P is on one side of the true line, and x can
   be on the other side only if it is within w of it, where w is `line_err` + 12 u b + the cell's
   shape error. If the cell is cut along an edge of facet F, F lies on one side of the true line. On
   that side F is certain: neither P nor any point of F is beyond the edge. What F has on the other
   side is within w of the line. */
#include "visibility/cells/cells_cut.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/range.h"

/* A cell is thin if the distance of its sample from the border is below this fraction of the cell's
   perimeter. */
#define MAX_THIN 0x1p-32
/* How far a strip may extend beyond its segment, in widths: 4 / MAX_THIN. */
#define STRIP_OVERHANG 0x1p34
/* A strip of less than this fraction of the square of the largest coordinate is charged to all
   facets of the cell, whether or not they are near it: a heuristic that saves time, and never
   charges too little. A hundred such strips are about 4e-16 of that square. */
#define NEGLIGIBLE_STRIP 0x1p-58
/* A cell that is no wider than so many strips may be charged whole: a heuristic, since it is
   charged no less than may be undecided. */
#define NARROW_STRIPS 64
/* Which of the cuts is made, in the next three, is heuristic: any is correct. A cell with more
   corners is halved, so that there is room for those that cuts add. */
#define MAX_CORNERS 20u
/* So is a cell with more segments, if few of them are then in both halves. An edge of a convex
   outline has all of the outline on one side, so that a cut along it removes only that edge. */
#define MAX_SEGMENTS 16u
/* After so many cuts a cell is not halved if nearly all segments stay together: they may meet in a
   point. */
#define MAX_HALVINGS 24u

/* The strip along a segment at which a cell is cut: its width on either side, and its ends as
   distances from the segment's first end. */
typedef struct cut_strip {
    const lrcsi_cells_segment *along; /* or NULL: then there is none */
    double width, from, to;
    double tolerance; /* of the cell that is cut */
} cut_strip;

/* --- undecided area --------------------------------------------------------------------------- */

/* The smallest and the largest signed distance of a facet's corners from a line. */
static inline void facet_range(const lrcsi_cells_facet *f, const double line[3], double range[2])
{
    double a = lrcsi_line_at(line, f->x[0], f->y[0]);
    double b = lrcsi_line_at(line, f->x[1], f->y[1]);
    double d = lrcsi_line_at(line, f->x[2], f->y[2]);
    range[0] = lrcsi_min3(a, b, d);
    range[1] = lrcsi_max3(a, b, d);
}

/* The interval that a facet covers along a line, measured from `start`. */
static inline void corners_along(const lrcsi_cells_facet *f, const double line[3],
                                 const double start[2], double along[2])
{
    double from = line[1] * start[0] - line[0] * start[1];
    double a = line[1] * f->x[0] - line[0] * f->y[0];
    double b = line[1] * f->x[1] - line[0] * f->y[1];
    double d = line[1] * f->x[2] - line[0] * f->y[2];
    along[0] = lrcsi_min3(a, b, d) - from;
    along[1] = lrcsi_max3(a, b, d) - from;
}

/* The same for the part of the facet within the distance `near` of the line; along[0] > along[1] if
   there is none. Sides almost parallel to the line count as a whole. */
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
        along[0] = lrcsi_min3(along[0], p, q);
        along[1] = lrcsi_max3(along[1], p, q);
    }
}

/* Charges the undecided area of a segment at the border to the facets near it: to each no more than
   the area of the strip along the facet's length. A negligible area is charged to all facets of the
   list later. */
void lrcsi_cells_charge_border(lrcsi_division *d, lrcsi_cell *cell, const lrcsi_clip_sides *s,
                               const lrcsi_cell_border *e)
{
    double strip = e->interval.strip_width;
    double length = (e->interval.to - e->interval.from) * e->length;
    double uncertainty = strip * (length + STRIP_OVERHANG * strip);
    if (uncertainty < NEGLIGIBLE_STRIP * d->extent * d->extent || length < STRIP_OVERHANG * strip) {
        cell->uncertainty += uncertainty;
        return;
    }
    double box[2][2];
    for (int k = 0; k < 2; k++) {
        double to = e->start[k] + (k == 0 ? e->line[1] : -e->line[0]) * e->length;
        box[0][k] = lrcsi_max(s->low[k], lrcsi_min(e->start[k], to));
        box[1][k] = lrcsi_min(s->high[k], lrcsi_max(e->start[k], to));
    }
    for (uint32_t i = 0; i < cell->facet_count; i++) {
        uint32_t facet = cell->facet[i];
        const lrcsi_cells_facet *f = &d->facet[facet];
        if (!d->wanted[facet]) {
            continue;
        }
        double far = 4 * strip + f->err + s->tolerance;
        double beyond = STRIP_OVERHANG * strip + far;
        if (f->low[0] > box[1][0] + beyond || f->high[0] < box[0][0] - beyond ||
            f->low[1] > box[1][1] + beyond || f->high[1] < box[0][1] - beyond) {
            continue;
        }
        double range[2];
        double along[2];
        facet_range(f, e->line, range);
        if (range[1] < -far || range[0] > far) {
            continue;
        }
        corners_along(f, e->line, e->start, along);
        if (lrcsi_min(uncertainty, strip * (along[1] - along[0])) > d->negligible) {
            facet_along(f, e->line, e->start, 2 * far, along);
            d->area[facet].strip_length +=
                lrcsi_min(uncertainty / strip, lrcsi_max(0, along[1] - along[0]));
        }
        if (along[1] > e->interval.from * e->length - beyond &&
            along[0] < e->interval.to * e->length + beyond) {
            d->area[facet].uncertainty +=
                lrcsi_min(uncertainty, strip * (along[1] - along[0] + 2 * far));
        }
    }
}

/* Charges a facet whose area is wanted for its part of the strip of a cut. Its corners have
   computed distances between `low` and `high` from the line. */
static void charge_cut(lrcsi_division *d, uint32_t index, double low, double high,
                       const cut_strip *strip)
{
    const lrcsi_cells_segment *e = strip->along;
    const lrcsi_cells_facet *f = &d->facet[index];
    const uint32_t owner = d->record ? index : f->facet; /* as segments name it */
    double far = f->err + strip->tolerance;
    double beyond = STRIP_OVERHANG * strip->width + far;
    double along[2];
    double wide = lrcsi_min(high + far, strip->width) - lrcsi_max(low - far, -strip->width);
    if (!e->contact && (e->owner[0] == owner || e->owner[1] == owner)) {
        wide = lrcsi_min(wide, strip->width);
    }
    corners_along(f, e->line, e->end[0], along);
    double length = lrcsi_min(along[1], strip->to) - lrcsi_max(along[0], strip->from) + 2 * beyond;
    if (wide * length > d->negligible) {
        facet_along(f, e->line, e->end[0], strip->width + 2 * far, along);
        length = lrcsi_min(along[1], strip->to) - lrcsi_max(along[0], strip->from) + 2 * beyond;
        d->area[index].strip_length += lrcsi_max(0, length);
    }
    d->area[index].uncertainty += lrcsi_max(0, wide) * lrcsi_max(0, length);
}

double lrcsi_cells_thin_uncertainty(const lrcsi_cell *cell, const lrcsi_clip_sides *s,
                                    double border_distance, uint32_t segments, double line_err)
{
    if (!(border_distance < MAX_THIN * s->perimeter)) {
        return 0;
    }
    double strips =
        4 * (double)segments * (cell->widest_strip + line_err + s->tolerance) * s->perimeter;
    return lrcsi_min(strips, lrcsi_clip_area(&cell->shape) + s->tolerance * s->perimeter);
}

int lrcsi_cells_charge_all(lrcsi_division *d, const lrcsi_cell *cell, const lrcsi_clip_sides *s)
{
    double wide = NARROW_STRIPS * (cell->widest_strip + d->facet_err + s->tolerance);
    double area = lrcsi_clip_area(&cell->shape) + 2 * s->tolerance * s->perimeter;
    if (!(area < wide * s->perimeter || area <= d->chargeable)) {
        return 0;
    }
    for (uint32_t i = 0; i < cell->facet_count; i++) {
        uint32_t facet = cell->facet[i];
        if (d->wanted[facet]) {
            d->area[facet].uncertainty += cell->uncertainty + area;
            d->area[facet].strip_length += 0.5 * s->perimeter;
        }
    }
    return 1;
}

/* --- cuts ------------------------------------------------------------------------------------- */

/* A segment met the cell that this one was cut from. Does it meet this one too? If not, its own
   line or that of the cut separates them. */
static int segment_still_meets(const lrcsi_cell *cell, const lrcsi_cells_segment *e, double w)
{
    if (!(lrcsi_line_at(cell->cut_line, e->end[0][0], e->end[0][1]) > w) &&
        !(lrcsi_line_at(cell->cut_line, e->end[1][0], e->end[1][1]) > w)) {
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

void lrcsi_cells_filter_segments(lrcsi_division *d, lrcsi_cell *cell, const lrcsi_clip_sides *s)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < cell->segment_count; i++) {
        const lrcsi_cells_segment *e = &d->segment[cell->segment[i]];
        double w = e->err + s->tolerance;
        if (cell->cuts > 0 && segment_still_meets(cell, e, w)) {
            cell->segment[kept++] = cell->segment[i];
            continue;
        }
        lrcsi_clip_interval interval;
        int place = lrcsi_clip_locate(&cell->shape, s, e->end[0], e->end[1], e->line, w,
                                      e->line_err + s->tolerance, &interval);
        if (place == LRCSI_CLIP_CROSSES) {
            cell->segment[kept++] = cell->segment[i];
        } else if (place == LRCSI_CLIP_BORDER) {
            cell->removed++;
            cell->widest_strip = lrcsi_max(cell->widest_strip, interval.strip_width);
            lrcsi_cells_charge_border(d, cell, s,
                                      &(lrcsi_cell_border){{e->line[0], e->line[1], e->line[2]},
                                                           {e->end[0][0], e->end[0][1]},
                                                           e->length,
                                                           interval});
        }
    }
    cell->segment_count = kept;
}

/* Are all corners of a cell beyond one side of a facet? Returns at the first corner after which
   that is impossible for every side. */
static int facet_beyond(const lrcsi_cells_facet *f, const lrcsi_clip_polygon *shape, double w)
{
    double max[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (uint32_t i = 0; i < shape->count; i++) {
        double x = shape->corner[i][0];
        double y = shape->corner[i][1];
        max[0] = lrcsi_max(max[0], lrcsi_line_at(f->side[0], x, y));
        max[1] = lrcsi_max(max[1], lrcsi_line_at(f->side[1], x, y));
        max[2] = lrcsi_max(max[2], lrcsi_line_at(f->side[2], x, y));
        if (!(lrcsi_min3(max[0], max[1], max[2]) < -w)) {
            return 0;
        }
    }
    return 1;
}

/* The corners that both parts of a cell have: the ends of the cut. */
static void cut_ends(const lrcsi_clip_polygon *left, const lrcsi_clip_polygon *right,
                     lrcsi_clip_polygon *ends)
{
    ends->count = 0;
    for (uint32_t i = 0; i < left->count; i++) {
        const double *p = left->corner[i];
        for (uint32_t k = 0; k < right->count; k++) {
            const double *q = right->corner[k];
            if (p[0] == q[0] && p[1] == q[1]) {
                memcpy(ends->corner[ends->count++], p, sizeof ends->corner[0]);
                break;
            }
        }
    }
}

/* Lists the facets of a cell that may be near its right part, and those that may be near its left
   part. What is near neither is not in the cell. A facet that may be near the cut is near both. */
static void cut_facets(lrcsi_division *d, const lrcsi_cell *cell, const cut_strip *strip,
                       lrcsi_cell *left, lrcsi_cell *right)
{
    double tolerance = lrcsi_division_tolerance(d, left);
    uint32_t *of_left = cell->facet + cell->facet_count;
    lrcsi_clip_polygon ends;
    cut_ends(&left->shape, &right->shape, &ends);
    left->facet_count = right->facet_count = 0;
    for (uint32_t i = 0; i < cell->facet_count; i++) {
        uint32_t index = cell->facet[i];
        const lrcsi_cells_facet *f = &d->facet[index];
        double w = f->err + tolerance + strip->width;
        double range[2];
        facet_range(f, left->cut_line, range);
        int on_left = range[1] > -w;
        int on_right = range[0] < w;
        if (on_left && on_right) {
            if (strip->along && d->wanted[index]) {
                charge_cut(d, index, range[0], range[1], strip);
            }
            int at_cut = !facet_beyond(f, &ends, f->err + tolerance);
            on_left = at_cut || !facet_beyond(f, &left->shape, f->err + tolerance);
            on_right = at_cut || !facet_beyond(f, &right->shape, f->err + tolerance);
        }
        of_left[left->facet_count] = index;
        left->facet_count += on_left != 0;
        right->facet[right->facet_count] = index;
        right->facet_count += on_right != 0;
    }
    left->facet = right->facet + right->facet_count;
    memmove(left->facet, of_left, left->facet_count * sizeof *of_left);
}

/* The same for its segments, except for the one along which it is cut. */
static void cut_segments(const lrcsi_division *d, const lrcsi_cell *cell,
                         const lrcsi_cells_segment *along, lrcsi_cell *left, lrcsi_cell *right)
{
    double g = lrcsi_division_tolerance(d, left);
    uint32_t *of_left = cell->segment + cell->segment_count;
    left->segment_count = right->segment_count = 0;
    for (uint32_t i = 0; i < cell->segment_count; i++) {
        uint32_t index = cell->segment[i];
        const lrcsi_cells_segment *e = &d->segment[index];
        double w = e->err + g;
        double from = lrcsi_line_at(left->cut_line, e->end[0][0], e->end[0][1]);
        double to = lrcsi_line_at(left->cut_line, e->end[1][0], e->end[1][1]);
        of_left[left->segment_count] = index;
        left->segment_count += e != along && lrcsi_max(from, to) > -w;
        right->segment[right->segment_count] = index;
        right->segment_count += e != along && lrcsi_min(from, to) < w;
    }
    left->segment = right->segment + right->segment_count;
    memmove(left->segment, of_left, left->segment_count * sizeof *of_left);
}

/* The line across the middle of a cell's box, at right angles to its longer side. */
static void middle_line(const lrcsi_clip_sides *s, double line[3])
{
    int wide = s->high[0] - s->low[0] > s->high[1] - s->low[1];
    line[0] = wide;
    line[1] = !wide;
    line[2] = wide ? -0.5 * (s->low[0] + s->high[0]) : -0.5 * (s->low[1] + s->high[1]);
}

/* Divides a cell along a segment, which is removed from the list, or (NULL) across its middle. The
   sample, if not NULL, is then in the left part. 0 if there is no room. */
static int cut_cell(lrcsi_division *d, const lrcsi_cell *cell, const lrcsi_clip_sides *s,
                    const lrcsi_cells_segment *along, const double *sample)
{
    double line[3];
    middle_line(s, line);
    cut_strip strip = {along, 0, 0, 0, s->tolerance};
    if (along) {
        lrcsi_clip_interval interval = {0, 1, 0};
        memcpy(line, along->line, sizeof line);
        strip.width = along->line_err + cell->shape_err + 12 * LRCSI_U * d->extent;
        lrcsi_clip_locate(&cell->shape, s, along->end[0], along->end[1], along->line,
                          along->err + s->tolerance, along->err + s->tolerance, &interval);
        strip.from = interval.from * along->length;
        strip.to = interval.to * along->length;
    }
    if (sample && lrcsi_line_at(line, sample[0], sample[1]) < 0) {
        for (int k = 0; k < 3; k++) {
            line[k] = -line[k];
        }
    }
    /* Room for two cells, and behind the lists of those that wait for the lists of both: */
    size_t facets = (size_t)(cell->facet - d->facet_lists) + 2 * (size_t)cell->facet_count;
    size_t segments = (size_t)(cell->segment - d->segment_lists) + 2 * (size_t)cell->segment_count;
    if (cell->cuts >= LRCSI_CELL_MAX_CUTS || cell->shape.count + 2 > LRCSI_CLIP_MAX_SIDES ||
        d->stack_count + 2 > LRCSI_CELL_STACK || facets > d->facet_lists_room ||
        segments > d->segment_lists_room) {
        return 0;
    }
    lrcsi_cell *right = &d->stack[d->stack_count];
    lrcsi_cell *left = right + 1;
    lrcsi_cell_copy(cell, right);
    right->cuts++;
    right->removed += along != NULL;
    right->widest_strip = lrcsi_max(cell->widest_strip, 2 * strip.width);
    right->keeps_sample = 0;
    lrcsi_cell_copy(right, left);
    left->keeps_sample = sample != NULL;
    double divide_err = lrcsi_clip_divide(&cell->shape, line, &left->shape, &right->shape);
    if (!(divide_err >= 0) || left->shape.count < 3 || right->shape.count < 3) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        left->cut_line[k] = line[k];
        right->cut_line[k] = -line[k];
    }
    left->shape_err = right->shape_err = cell->shape_err + divide_err;
    cut_facets(d, cell, &strip, left, right);
    cut_segments(d, cell, along, left, right);
    d->stack_count += 2;
    return 1;
}

int lrcsi_cells_halve(lrcsi_division *d, const lrcsi_cell *cell, const lrcsi_clip_sides *s)
{
    return cut_cell(d, cell, s, NULL, NULL);
}

/* Do the halves of a cell with many segments have few in common? At most an eighth of them if
   neither half has more than three quarters of all; otherwise at most one. */
static int halving_separates(const lrcsi_division *d, const lrcsi_cell *cell,
                             const lrcsi_clip_sides *s)
{
    double line[3];
    uint32_t side[2] = {0, 0};
    middle_line(s, line);
    for (uint32_t i = 0; cell->segment_count > MAX_SEGMENTS && i < cell->segment_count; i++) {
        const lrcsi_cells_segment *e = &d->segment[cell->segment[i]];
        double a = lrcsi_line_at(line, e->end[0][0], e->end[0][1]);
        double b = lrcsi_line_at(line, e->end[1][0], e->end[1][1]);
        side[0] += a > 0 || b > 0;
        side[1] += !(a > 0 && b > 0);
    }
    uint32_t larger = side[0] > side[1] ? side[0] : side[1];
    uint32_t both = side[0] + side[1] - cell->segment_count;
    return cell->segment_count > MAX_SEGMENTS &&
           (larger <= cell->segment_count / 4 * 3 ? both <= cell->segment_count / 8
                                                  : both <= 1 && cell->cuts < MAX_HALVINGS);
}

int lrcsi_cells_divide(lrcsi_division *d, const lrcsi_cell *cell, const lrcsi_clip_sides *s,
                       const lrcsi_cells_segment *along, const double sample[2])
{
    int halved = cell->shape.count > MAX_CORNERS || halving_separates(d, cell, s);
    return cut_cell(d, cell, s, halved ? NULL : along, sample);
}
