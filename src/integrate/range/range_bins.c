/* SPDX-License-Identifier: MIT */
/* Divides the projected area of triangles among bins of range, exactly except for rounding: the
   area per unit of range increases linearly from the nearest corner to the middle one, and
   decreases linearly from there to the farthest. Bounds the errors (1), (3) and (4) of
   integrate/range/range_profile.c. */
#include "integrate/range/range_bins.h"

#include <math.h>

#include "base/constant.h"
#include "base/range.h"
#include "integrate/sum/facet_terms.h"

double lrcsi_range_edge(const lrcsi_range_bins *bins, uint32_t i)
{
    return ldexp((double)(bins->first + i) * bins->bin_m, -bins->exponent);
}

static double centre_of(const lrcsi_range_bins *bins, uint32_t i)
{
    return ldexp(((double)(bins->first + i) + 0.5) * bins->bin_m, -bins->exponent);
}

/* The quotient has an error of a few ulps, which changes the bin by at most one; the loops correct
   that. */
uint32_t lrcsi_range_bin(const lrcsi_range_bins *bins, double range)
{
    double k = floor(range / bins->width) - (double)bins->first;
    uint32_t i = k <= 0 ? 0 : k >= bins->count ? bins->count - 1 : (uint32_t)k;
    while (i > 0 && lrcsi_range_edge(bins, i) > range) {
        i--;
    }
    while (i + 1 < bins->count && lrcsi_range_edge(bins, i + 1) <= range) {
        i++;
    }
    return i;
}

/* The same, among the bins that a facet extends into. */
static uint32_t bin_within(const lrcsi_range_bins *bins, const lrcsi_range_facet *f, double range)
{
    uint32_t i = lrcsi_range_bin(bins, range);
    return i < f->first ? f->first : i > f->last ? f->last : i;
}

/* Adds a part of sigma, with its first moment about the bin's centre and its error. */
static void bin_add(lrcsi_range_bins *bins, uint32_t i, double glint, double diffuse, double moment,
                    double rounding)
{
    lrcsi_range_sums *bin = &bins->bin[i];
    lrcsi_sum_add(&bin->glint, glint);
    lrcsi_sum_add(&bin->diffuse, diffuse);
    lrcsi_sum_add(&bin->moment, moment);
    lrcsi_sum_add(&bins->glint, glint);
    lrcsi_sum_add(&bins->diffuse, diffuse);
    bin->bound += rounding + LRCSI_FACET_UNDERFLOW;
    bins->bound += rounding + LRCSI_FACET_UNDERFLOW;
    bins->additions++;
}

/* Adds a projected area of a flat facet, with its first moment about the bin's centre. */
static void bin_add_flat(lrcsi_range_bins *bins, const lrcsi_range_facet *f, uint32_t i,
                         double area, double moment)
{
    bin_add(bins, i, f->glint * area, f->diffuse * area, (f->glint + f->diffuse) * moment,
            f->rounding * area + f->upper_bound * LRCSI_RANGE_AREA_ERR * area);
}

/* Adds a triangle with curved normals that lies in one bin.
   Given: its projected area, and the ranges and normals at its corners. */
static void bin_add_curved(lrcsi_range_bins *bins, const lrcsi_range_facet *f, uint32_t i,
                           double area, const double range[3], const double normal[3][3])
{
    double centre = centre_of(bins, i);
    const double weight[3] = {range[0] - centre, range[1] - centre, range[2] - centre};
    lrcsi_cubature sum = lrcsi_cubature_start(&f->curve->surface);
    sum.surface.area = area;
    sum.surface.position_err = f->position_err;
    lrcsi_cubature_add(&sum, normal, weight, area);
    double glint = LRCS_FOUR_PI * lrcsi_sum_value(&sum.glint);
    double diffuse = LRCS_FOUR_PI * lrcsi_sum_value(&sum.diffuse);
    double relative = f->curve->incidence.error + 16 * LRCSI_U + LRCSI_RANGE_AREA_ERR;
    bin_add(bins, i, glint, diffuse, LRCS_FOUR_PI * lrcsi_sum_value(&sum.weighted),
            LRCS_FOUR_PI * (sum.rounding + sum.unresolved) + relative * (glint + diffuse));
    bins->bin[i].estimate += LRCS_FOUR_PI * sum.estimate;
    bins->estimate += LRCS_FOUR_PI * sum.estimate;
}

void lrcsi_range_order(const double range[3], int order[3])
{
    static const int pair[3][2] = {{0, 1}, {1, 2}, {0, 1}};
    order[0] = 0;
    order[1] = 1;
    order[2] = 2;
    for (int i = 0; i < 3; i++) {
        int a = order[pair[i][0]];
        int b = order[pair[i][1]];
        int swapped = range[b] < range[a];
        order[pair[i][0]] = swapped ? b : a;
        order[pair[i][1]] = swapped ? a : b;
    }
}

/* A triangle of a piece: its area, and the ranges of its corners in ascending order; on a facet
   with curved normals, also the normals at them. */
typedef struct profile_triangle {
    double area, z[3];
    double normal[3][3];
} profile_triangle;

/* The normal at the point of the side from corner a to corner b that has the range z. Given: the
   normals at all corners, and their ranges in ascending order. */
static void normal_at(const double corner[3][3], const double range[3], int a, int b, double z,
                      double normal[3])
{
    double fraction = range[a] < range[b] ? (z - range[a]) / (range[b] - range[a]) : 0;
    for (int k = 0; k < 3; k++) {
        normal[k] = (1 - fraction) * corner[a][k] + fraction * corner[b][k];
    }
}

/* Adds the part of a triangle between two ranges, which lie on one side of its middle corner, to a
   bin. The part is a trapezium: its parallel sides, at `from` and at `to`, lead from the long side
   of the triangle to a short one, from corner a to corner b. A diagonal divides it into two
   triangles, whose areas are the fractions `first` and `last` of the largest area per unit of
   range, which is at the middle corner, times half the width. On a flat facet the area and its
   first moment are added to *part and *moment; curved normals are integrated. */
static void trapezium_add(lrcsi_range_bins *bins, const lrcsi_range_facet *f, uint32_t bin,
                          const profile_triangle *t, double from, double to, double *part,
                          double *moment)
{
    if (!(from < to)) {
        return;
    }
    const double *z = t->z;
    int rising = to <= z[1];
    int a = rising ? 0 : 1;
    int b = rising ? 1 : 2;
    double first = (rising ? from - z[0] : z[2] - from) / (z[b] - z[a]);
    double last = (rising ? to - z[0] : z[2] - to) / (z[b] - z[a]);
    double scale = t->area / (z[2] - z[0]) * (to - from);
    if (f->curve) {
        const double range[2][3] = {{from, from, to}, {from, to, to}};
        const double(*normal)[3] = (const double(*)[3])t->normal;
        double side[4][3]; /* at `from` on the long side, on the short one; at `to` likewise */
        normal_at(normal, z, 0, 2, from, side[0]);
        normal_at(normal, z, a, b, from, side[1]);
        normal_at(normal, z, 0, 2, to, side[2]);
        normal_at(normal, z, a, b, to, side[3]);
        bin_add_curved(bins, f, bin, scale * first, range[0], (const double(*)[3])side);
        bin_add_curved(bins, f, bin, scale * last, range[1], (const double(*)[3])(side + 1));
        return;
    }
    double centre = centre_of(bins, bin);
    double trapezium = scale * (first + last);
    *part += trapezium;
    *moment += trapezium * (0.5 * (from - centre) + 0.5 * (to - centre)) +
               scale * (last - first) * (0.5 * (to - from)) / 3;
}

/* 1. The corners are ordered by range.
   2. A triangle in one bin is added to it.
   3. Otherwise each bin receives the part between its edges, divided at the middle corner.
   4. Part (3) of the error: at each edge of a bin within range_err of the triangle, the fraction of
      its area that may lie on the other side. */
void lrcsi_range_add_triangle(lrcsi_range_bins *bins, const lrcsi_range_facet *f, double area,
                              const double range[3], const double normal[3][3], double range_err)
{
    int order[3]; /* 1 */
    profile_triangle t = {.area = area};
    const double *z = t.z;
    lrcsi_range_order(range, order);
    for (int k = 0; k < 3; k++) {
        t.z[k] = range[order[k]];
        for (int c = 0; c < 3 && f->curve; c++) {
            t.normal[k][c] = normal[order[k]][c];
        }
    }
    uint32_t begin = bin_within(bins, f, z[0]);
    uint32_t end = bin_within(bins, f, z[2]);
    if (begin == end && f->curve) { /* 2 */
        bin_add_curved(bins, f, begin, area, z, (const double(*)[3])t.normal);
    } else if (begin == end) {
        double centre = centre_of(bins, begin);
        double mean = ((z[0] - centre) + (z[1] - centre) + (z[2] - centre)) / 3;
        bin_add_flat(bins, f, begin, area, area * mean);
    }
    for (uint32_t i = begin; begin < end && i <= end; i++) { /* 3 */
        double from = i == begin ? z[0] : lrcsi_range_edge(bins, i);
        double to = i == end ? z[2] : lrcsi_range_edge(bins, i + 1);
        double middle = lrcsi_min(to, lrcsi_max(from, z[1]));
        double part = 0;
        double moment = 0;
        trapezium_add(bins, f, i, &t, from, middle, &part, &moment);
        trapezium_add(bins, f, i, &t, middle, to, &part, &moment);
        if (!f->curve) {
            bin_add_flat(bins, f, i, part, moment);
        }
    }
    double extent = z[2] - z[0]; /* 4 */
    double fraction = 4 * range_err < extent ? lrcsi_min(1, 4 * range_err / extent) : 1;
    double error = f->upper_bound * area * fraction;
    begin = bin_within(bins, f, z[0] - range_err);
    end = bin_within(bins, f, z[2] + range_err);
    for (uint32_t i = begin + 1; i <= end; i++) {
        bins->bin[i - 1].bound += error;
        bins->bin[i].bound += error;
        bins->additions++;
    }
    bins->range_err = lrcsi_max(bins->range_err, lrcsi_min(range_err, f->extent));
}
