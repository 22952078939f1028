/* SPDX-License-Identifier: MIT */
/* Convex pieces and how a region is cut out of them: along each line of the region a piece is split
   in two; the part outside is kept, the part inside goes on to the next line, and what is inside
   all of them is dropped. */
#include "visibility/clip.h"

#include <lrcs/status.h>

#include <math.h>
#include <string.h>

#include "base/work.h"

size_t lrcsi_clip_need(void)
{
    size_t one = lrcsi_work_add(lrcsi_work_bytes(LRCSI_CLIP_CORNERS, 2 * sizeof(double)),
                                lrcsi_work_bytes(LRCSI_CLIP_PIECES, sizeof(uint32_t)));
    return lrcsi_work_add(one, one);
}

static int clip_list_make(lrcs_work *work, lrcsi_clip_list *list)
{
    list->corner = lrcsi_work_take(work, LRCSI_CLIP_CORNERS, sizeof *list->corner);
    list->end = lrcsi_work_take(work, LRCSI_CLIP_PIECES, sizeof *list->end);
    list->pieces = 0;
    return list->corner && list->end;
}

int lrcsi_clip_make(lrcs_work *work, lrcsi_clip *clip)
{
    clip->splits = 0;
    return clip_list_make(work, &clip->list) && clip_list_make(work, &clip->spare) ? LRCS_OK
                                                                                   : LRCS_E_MEMORY;
}

static int clip_append(lrcsi_clip_list *list, const double (*corner)[2], uint32_t count)
{
    uint32_t at = lrcsi_clip_first(list, list->pieces);
    if (list->pieces == LRCSI_CLIP_PIECES || count > LRCSI_CLIP_CORNERS - at) {
        return 0;
    }
    memcpy(list->corner + at, corner, count * sizeof *corner);
    list->end[list->pieces++] = at + count;
    return 1;
}

void lrcsi_clip_start(lrcsi_clip *clip, const lrcsi_clip_polygon *polygon)
{
    clip->list.pieces = 0;
    clip->splits = 0;
    clip_append(&clip->list, (const double(*)[2])polygon->corner, polygon->count);
}

/* Positive where the point lies left of the line. */
static double line_side(const lrcsi_clip_line *line, const double *p)
{
    return line->to[0] * (p[1] - line->at[1]) - line->to[1] * (p[0] - line->at[0]);
}

static void polygon_add(lrcsi_clip_polygon *polygon, double x, double y)
{
    if (polygon->count < LRCSI_CLIP_SIDES) {
        polygon->corner[polygon->count][0] = x;
        polygon->corner[polygon->count][1] = y;
    }
    polygon->count++;
}

/* Splits a polygon into what lies left of the line and what lies right of it. */
static void polygon_split(const lrcsi_clip_polygon *from, const lrcsi_clip_line *line,
                          lrcsi_clip_polygon *left, lrcsi_clip_polygon *right)
{
    left->count = right->count = 0;
    const double *p = from->corner[from->count - 1];
    double side = line_side(line, p);
    for (uint32_t i = 0; i < from->count; i++) {
        const double *q = from->corner[i];
        double next = line_side(line, q);
        if ((side < 0 && next > 0) || (side > 0 && next < 0)) {
            double t = side / (side - next);
            double x = p[0] + t * (q[0] - p[0]);
            double y = p[1] + t * (q[1] - p[1]);
            polygon_add(left, x, y);
            polygon_add(right, x, y);
        }
        if (next >= 0) {
            polygon_add(left, q[0], q[1]);
        }
        if (next <= 0) {
            polygon_add(right, q[0], q[1]);
        }
        p = q;
        side = next;
    }
}

void lrcsi_clip_triangle(const double corner[3][2], lrcsi_clip_polygon *polygon)
{
    memcpy(polygon->corner, corner, 3 * sizeof *corner);
    polygon->count = 3;
}

static void corners_box(const double (*corner)[2], uint32_t count, double low[2], double high[2])
{
    for (int k = 0; k < 2; k++) {
        low[k] = high[k] = corner[0][k];
        for (uint32_t i = 1; i < count; i++) {
            low[k] = corner[i][k] < low[k] ? corner[i][k] : low[k];
            high[k] = corner[i][k] > high[k] ? corner[i][k] : high[k];
        }
    }
}

static int box_apart(const double (*corner)[2], uint32_t count, const lrcsi_clip_region *region,
                     double width)
{
    double low[2];
    double high[2];
    corners_box(corner, count, low, high);
    for (int k = 0; k < 2; k++) {
        if (high[k] + width <= region->low[k] || low[k] >= region->high[k] + width) {
            return 1;
        }
    }
    return 0;
}

void lrcsi_clip_halve(const lrcsi_clip_polygon *polygon, lrcsi_clip_polygon *left,
                      lrcsi_clip_polygon *right)
{
    double low[2];
    double high[2];
    corners_box((const double(*)[2])polygon->corner, polygon->count, low, high);
    int wide = high[0] - low[0] > high[1] - low[1];
    lrcsi_clip_line line = {
        {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])}, {wide ? 0 : 1, wide ? 1 : 0}, 0};
    polygon_split(polygon, &line, left, right);
}

/* Do all corners lie farther than `width` to one side of a line? */
static int sides_clear(const lrcsi_clip_polygon *polygon, const lrcsi_clip_line *line, double width)
{
    double clear = width * hypot(line->to[0], line->to[1]);
    int left = 1;
    int right = 1;
    for (uint32_t i = 0; i < polygon->count; i++) {
        double side = line_side(line, polygon->corner[i]);
        left &= side > clear;
        right &= side < -clear;
    }
    return left || right;
}

int lrcsi_clip_meets(const lrcsi_clip_polygon *polygon, const lrcsi_clip_line *line,
                     const double low[2], const double high[2], double width)
{
    const lrcsi_clip_region box = {.low = {low[0], low[1]}, .high = {high[0], high[1]}};
    return !box_apart((const double(*)[2])polygon->corner, polygon->count, &box, width) &&
           !((line->to[0] != 0 || line->to[1] != 0) && sides_clear(polygon, line, width));
}

int lrcsi_clip_middle(const lrcsi_clip_polygon *polygon, double margin, double middle[2])
{
    middle[0] = middle[1] = 0;
    for (uint32_t i = 0; i < polygon->count; i++) {
        middle[0] += polygon->corner[i][0] / polygon->count;
        middle[1] += polygon->corner[i][1] / polygon->count;
    }
    for (uint32_t i = 0; i < polygon->count; i++) {
        const double *p = polygon->corner[i];
        const double *q = polygon->corner[i + 1 < polygon->count ? i + 1 : 0];
        lrcsi_clip_line side = {{p[0], p[1]}, {q[0] - p[0], q[1] - p[1]}, 0};
        double clear = 1.01 * margin * hypot(side.to[0], side.to[1]);
        if (clear > 0 && !(line_side(&side, middle) > clear)) {
            return 0;
        }
    }
    return 1;
}

int lrcsi_clip_overlap(const lrcsi_clip_polygon *polygon, const lrcsi_clip_region *region)
{
    if (box_apart((const double(*)[2])polygon->corner, polygon->count, region, region->width)) {
        return LRCSI_CLIP_NONE;
    }
    int covered = 1;
    int buried = 1;
    for (int k = 0; k < region->lines; k++) {
        const lrcsi_clip_line *line = &region->line[k];
        double slack = line->width * (fabs(line->to[0]) + fabs(line->to[1]));
        int near = 0;
        for (uint32_t i = 0; i < polygon->count; i++) {
            double side = line_side(line, polygon->corner[i]);
            near |= !(side < -slack);
            covered &= side >= 0;
            buried &= side > slack;
        }
        if (!near) {
            return LRCSI_CLIP_NONE;
        }
    }
    return buried ? LRCSI_CLIP_BURIED : covered ? LRCSI_CLIP_COVERED : LRCSI_CLIP_SOME;
}

/* Cuts the region out of one piece and files what is left in the spare list. A piece that turns out
   to lie outside is filed whole, not in the parts into which it fell on the way. */
static int piece_subtract(lrcsi_clip *clip, const double (*corner)[2], uint32_t count,
                          const lrcsi_clip_region *region)
{
    if (count > LRCSI_CLIP_SIDES - 4 || box_apart(corner, count, region, 0)) {
        return count <= LRCSI_CLIP_SIDES - 4 && clip_append(&clip->spare, corner, count);
    }
    lrcsi_clip_polygon inside = {.count = count};
    lrcsi_clip_polygon left;
    lrcsi_clip_polygon right;
    memcpy(inside.corner, corner, count * sizeof *corner);
    uint32_t filed = clip->spare.pieces;
    for (int k = 0; k < region->lines; k++) {
        polygon_split(&inside, &region->line[k], &left, &right);
        if (left.count > LRCSI_CLIP_SIDES || right.count > LRCSI_CLIP_SIDES) {
            return 0; /* rounding has dented the piece: a line may cross it more than twice */
        }
        if (left.count < 3) {
            clip->spare.pieces = filed;
            return clip_append(&clip->spare, corner, count);
        }
        if (right.count >= 3) {
            clip->splits++;
            if (!clip_append(&clip->spare, (const double(*)[2])right.corner, right.count)) {
                return 0;
            }
            inside = left;
        }
    }
    return 1;
}

int lrcsi_clip_subtract(lrcsi_clip *clip, const lrcsi_clip_region *region)
{
    clip->spare.pieces = 0;
    for (uint32_t i = 0; i < clip->list.pieces; i++) {
        uint32_t first = lrcsi_clip_first(&clip->list, i);
        if (!piece_subtract(clip, (const double(*)[2])(clip->list.corner + first),
                            clip->list.end[i] - first, region)) {
            return 0;
        }
    }
    lrcsi_clip_list list = clip->list;
    clip->list = clip->spare;
    clip->spare = list;
    return 1;
}

double lrcsi_clip_corners_area(const double (*c)[2], uint32_t count)
{
    double area = 0;
    for (uint32_t j = 2; j < count; j++) {
        area += 0.5 * ((c[j - 1][0] - c[0][0]) * (c[j][1] - c[0][1]) -
                       (c[j - 1][1] - c[0][1]) * (c[j][0] - c[0][0]));
    }
    return area;
}

double lrcsi_clip_polygon_area(const lrcsi_clip_polygon *polygon)
{
    return lrcsi_clip_corners_area((const double(*)[2])polygon->corner, polygon->count);
}

double lrcsi_clip_polygon_perimeter(const lrcsi_clip_polygon *polygon)
{
    double low[2];
    double high[2];
    corners_box((const double(*)[2])polygon->corner, polygon->count, low, high);
    return 2 * ((high[0] - low[0]) + (high[1] - low[1]));
}

double lrcsi_clip_box_area(const double corner[3][2], const double low[2])
{
    const lrcsi_clip_line side[4] = {{{low[0], low[1]}, {1, 0}, 0},
                                     {{low[0] + 1, low[1]}, {0, 1}, 0},
                                     {{low[0] + 1, low[1] + 1}, {-1, 0}, 0},
                                     {{low[0], low[1] + 1}, {0, -1}, 0}};
    lrcsi_clip_polygon inside;
    lrcsi_clip_polygon left;
    lrcsi_clip_polygon right;
    lrcsi_clip_triangle(corner, &inside);
    for (int k = 0; k < 4; k++) {
        polygon_split(&inside, &side[k], &left, &right);
        if (left.count < 3) {
            return 0;
        }
        inside = left;
    }
    return lrcsi_clip_polygon_area(&inside);
}

double lrcsi_clip_area(const lrcsi_clip *clip)
{
    double area = 0;
    for (uint32_t i = 0; i < clip->list.pieces; i++) {
        uint32_t first = lrcsi_clip_first(&clip->list, i);
        area += lrcsi_clip_corners_area((const double(*)[2])(clip->list.corner + first),
                                        clip->list.end[i] - first);
    }
    return area;
}
