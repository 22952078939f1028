/* SPDX-License-Identifier: MIT */
/* Facets and segments in view coordinates, and their errors. It does not know of cells but their
   sides.

   Error. A vertex is off in the view by less than 1.5 e, e its error in each coordinate; a sum of
   products that tells on which side of a line a point lies is off by at most 12 u b, b the largest
   coordinate.

   Heights. In a facet of height H above each side, a place within w of it has barycentric
   coordinates off by w / H; with the facet's slope at most G, twice what it is as computed, its z
   there is off by e + G (w + 8 u l^2 / H), l its longest side, the second for the slope's own
   error, and is never beyond the z of its corners. Where H < 8 w only these count. */
#include "visibility/cells_facet.h"

#include <math.h>
#include <string.h>

#include "base/dd.h"
#include "base/range.h"
#include "visibility/contact.h"
#include "visibility/sample.h"

#define U 0x1p-53

/* The axes of the view, exactly perpendicular to the direction but for 32 u^2: R's rows are so but
   for 4 u, which is taken off in their lower parts. They may be oblique by as much. */
void lrcsi_cells_frame_make(lrcsi_cells_frame *c)
{
    const double *d = c->view->direction;
    for (int i = 0; i < 2; i++) {
        const double *row = c->view->R[i];
        lrcsi_dd dot = {0, 0};
        for (int k = 0; k < 3; k++) {
            dot = lrcsi_dd_add(dot, lrcsi_dd_two_product(row[k], d[k]));
        }
        double along = lrcsi_dd_value(dot) / (c->view->length * c->view->length);
        for (int k = 0; k < 3; k++) {
            c->axis_low[i][k] = -along * d[k];
        }
    }
    lrcsi_cells_frame_move(c, c->view->prepared->origin);
}

void lrcsi_cells_frame_move(lrcsi_cells_frame *c, const double *origin)
{
    c->origin = origin;
    c->middle[0] = c->middle[1] = 0;
    c->number++;
}

/* A vertex in the view: each coordinate rounded once, of a sum that is off by 100 u^2 of the
   distance from the origin; z as the view has it, or of three products that round off as little,
   off by 20 u of that. */
static const double *point_of(lrcsi_cells_frame *c, uint32_t vertex)
{
    lrcsi_cells_point *p = &c->point[vertex];
    if (p->frame != c->number) {
        const lrcs_prepared *prepared = c->view->prepared;
        lrcsi_dd gap[3];
        for (int k = 0; k < 3; k++) {
            gap[k] = lrcsi_dd_two_sum(prepared->vertex[vertex].x[k], -c->origin[k]);
        }
        for (int i = 0; i < 2; i++) {
            const double *row = c->view->R[i];
            lrcsi_dd sum = {0, 0};
            double rest = 0;
            for (int k = 0; k < 3; k++) {
                lrcsi_dd term = lrcsi_dd_two_product(row[k], gap[k].hi);
                rest += term.lo + (row[k] * gap[k].lo + c->axis_low[i][k] * gap[k].hi);
                lrcsi_dd next = lrcsi_dd_two_sum(sum.hi, term.hi);
                sum = (lrcsi_dd){next.hi, sum.lo + next.lo};
            }
            p->x[i] = sum.hi + (sum.lo + rest);
        }
        const double *up = c->view->R[2];
        p->x[2] = c->origin == prepared->origin
                      ? c->view->point[vertex].x[2]
                      : up[0] * gap[0].hi + up[1] * gap[1].hi + up[2] * gap[2].hi;
        p->frame = c->number;
    }
    return p->x;
}

/* The same from the middle of the block at hand; *off grows to how far that may be off, and lines
   through it (0.5 u of the sum of its coordinates from the centre of the view, and of those from
   the middle 0.5 u, and 5 u for a line); *z_err to the error of z. */
void lrcsi_cells_vertex(lrcsi_cells_frame *c, uint32_t vertex, double out[3], double *off,
                        double *z_err)
{
    const double *x = point_of(c, vertex);
    out[0] = x[0] - c->middle[0];
    out[1] = x[1] - c->middle[1];
    out[2] = x[2];
    double flat = fabs(x[0]) + fabs(x[1]);
    double far = flat + fabs(x[2]);
    double near = fabs(out[0]) + fabs(out[1]);
    *off = lrcsi_most(*off, U * (0.6 * flat + 6 * near) + 128 * U * U * far);
    *z_err = lrcsi_most(*z_err, 20 * U * far);
}

static int longest_side(const lrcsi_cells_facet *f)
{
    int k = f->length[1] > f->length[0] ? 1 : 0;
    return f->length[2] > f->length[k] ? 2 : k;
}

/* Its least height, as computed: negative where rounding has turned it over. */
static double facet_least(const lrcsi_cells_facet *f)
{
    int k = (longest_side(f) + 2) % 3;
    return lrcsi_line_at(f->side[longest_side(f)], f->x[k], f->y[k]);
}

/* A facet so narrow that it may have been turned over: its sides are replaced by those of the band
   about its longest side that has all of it. It covers nothing surely, and is not decided. */
static void facet_flatten(lrcsi_cells_facet *f)
{
    double wide = fabs(facet_least(f)) + 4 * f->off;
    double line[3];
    memcpy(line, f->side[longest_side(f)], sizeof line);
    for (int k = 0; k < 3; k++) {
        int sign = k == 1 ? -1 : 1;
        f->side[k][0] = sign * line[0];
        f->side[k][1] = sign * line[1];
        f->side[k][2] = sign * line[2] + wide;
    }
}

/* The plane and its error, as told above; HUGE_VAL where it is so narrow that only corners tell. */
static void facet_slope(lrcsi_cells_facet *f, const double z[3])
{
    const double dx[2] = {f->x[1] - f->x[0], f->x[2] - f->x[0]};
    const double dy[2] = {f->y[1] - f->y[0], f->y[2] - f->y[0]};
    double twice = dx[0] * dy[1] - dx[1] * dy[0];
    double longest = lrcsi_most(f->length[0], lrcsi_most(f->length[1], f->length[2]));
    double height = twice / longest; /* the least */
    double rise = lrcsi_most(z[0], lrcsi_most(z[1], z[2])) -
                  lrcsi_least(z[0], lrcsi_least(z[1], z[2])) + 4 * f->z_err;
    f->z_low = lrcsi_least(z[0], lrcsi_least(z[1], z[2])) - f->z_err;
    f->z_high = lrcsi_most(z[0], lrcsi_most(z[1], z[2])) + f->z_err;
    f->z[0] = f->z[1] = f->z[2] = 0;
    f->z_off[0] = f->z_off[1] = HUGE_VAL;
    if (height > 64 * f->off && height > 0x1p-40 * longest) {
        const double dz[2] = {z[1] - z[0], z[2] - z[0]};
        f->z[0] = (dz[0] * dy[1] - dz[1] * dy[0]) / twice;
        f->z[1] = (dz[1] * dx[0] - dz[0] * dx[1]) / twice;
        f->z[2] = z[0] - f->z[0] * f->x[0] - f->z[1] * f->y[0];
        double slope = lrcsi_least(4 * rise / height,
                                   2 * (fabs(f->z[0]) + fabs(f->z[1])) + 8 * f->z_err / height);
        f->z_off[1] = slope;
        f->z_off[0] = 3 * f->z_err + slope * (2 * f->off + 8 * U * longest * longest / height) +
                      8 * U * (fabs(z[0]) + fabs(f->z[0] * f->x[0]) + fabs(f->z[1] * f->y[0]));
    }
}

void lrcsi_cells_facet_make(lrcsi_cells_frame *c, uint32_t facet, lrcsi_cells_facet *f)
{
    const lrcsi_view *view = c->view;
    const uint32_t *corner = view->prepared->scene->facet[facet].corner;
    double p[3][3];
    double z[3];
    f->off = f->z_err = 0;
    for (int k = 0; k < 3; k++) {
        lrcsi_cells_vertex(c, corner[view->facing[facet] > 0 ? k : (3 - k) % 3], p[k], &f->off,
                           &f->z_err);
        f->x[k] = p[k][0];
        f->y[k] = p[k][1];
        z[k] = p[k][2];
    }
    for (int k = 0; k < 3; k++) {
        const double *q = p[(k + 1) % 3];
        lrcsi_line_through(p[k], q, f->side[k]);
        f->length[k] = fabs(q[0] - p[k][0]) + fabs(q[1] - p[k][1]) + 4 * f->off;
    }
    for (int i = 0; i < 2; i++) {
        f->low[i] = lrcsi_least(p[0][i], lrcsi_least(p[1][i], p[2][i]));
        f->high[i] = lrcsi_most(p[0][i], lrcsi_most(p[1][i], p[2][i]));
    }
    facet_slope(f, z);
    f->thin = !(facet_least(f) > 16 * f->off);
    if (f->thin) {
        facet_flatten(f);
    }
}

void lrcsi_cells_segment_line(lrcsi_cells_segment *e)
{
    lrcsi_line_through(e->end[0], e->end[1], e->line);
    e->length = fabs(e->end[1][0] - e->end[0][0]) + fabs(e->end[1][1] - e->end[0][1]);
}

int lrcsi_cells_facet_near(const lrcsi_cells_facet *f, const lrcsi_clip_polygon *shape,
                           const double low[2], const double high[2], double g)
{
    double w = f->off + g;
    if (f->low[0] > high[0] + w || f->high[0] < low[0] - w || f->low[1] > high[1] + w ||
        f->high[1] < low[1] - w) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        double range[2];
        lrcsi_box_range(low, high, f->side[k], range);
        if (range[1] > -w && range[0] + range[1] < 0) {
            lrcsi_line_range(shape, f->side[k], range);
        }
        if (range[1] < -w) {
            return 0;
        }
    }
    return 1;
}

void lrcsi_cells_facet_height(const lrcsi_cells_facet *f, const double at[2], double g,
                              double range[2])
{
    range[0] = f->z_low;
    range[1] = f->z_high;
    double off = f->z_off[0] + f->z_off[1] * g;
    if (off < HUGE_VAL) {
        double z = f->z[0] * at[0] + f->z[1] * at[1] + f->z[2];
        range[0] = lrcsi_most(range[0], z - off);
        range[1] = lrcsi_least(range[1], z + off);
    }
}

double lrcsi_cells_facet_limit(const lrcsi_cells_facet *f, const lrcsi_cells_sides *s, int sign)
{
    double corner = sign > 0 ? f->z_high : f->z_low;
    double off = f->z_off[0] + f->z_off[1] * s->g;
    if (!(off < HUGE_VAL)) {
        return corner;
    }
    double x = 0.5 * (s->low[0] + s->high[0]);
    double y = 0.5 * (s->low[1] + s->high[1]);
    double half = fabs(f->z[0]) * (s->high[0] - x) + fabs(f->z[1]) * (s->high[1] - y);
    double z = f->z[0] * x + f->z[1] * y + f->z[2];
    return sign > 0 ? lrcsi_least(corner, z + half + off) : lrcsi_most(corner, z - half - off);
}

int lrcsi_cells_facet_order(const lrcsi_view *view, uint32_t first, uint32_t second)
{
    const lrcsi_touches *touches = &view->prepared->touches;
    int side = lrcsi_contact_side(view, first, second);
    int touch = 0;
    for (int way = 0; way < 2 && side == 0; way++) {
        uint32_t facet = way == 0 ? first : second;
        uint32_t other = way == 0 ? second : first;
        for (uint32_t i = touches->first[facet]; i < touches->first[facet + 1]; i++) {
            if (touches->touch[i].other == other) {
                touch = 1;
                if (touches->touch[i].kind == LRCSI_TOUCH_COPLANAR) {
                    return lrcsi_sample_beats(view, second, first) ? 1 : -1;
                }
            }
        }
    }
    if (side == 0 && !touch) {
        side = lrcsi_contact_order(view, first, second);
        side = side == 0 ? lrcsi_contact_within(view, first, second) : side;
    }
    return side;
}
