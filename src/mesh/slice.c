/* SPDX-License-Identifier: MIT */
/* A triangle in space, clipped by half-spaces (Sutherland and Hodgman 1974), for upper bounds of
   areas. Nothing is decided exactly. */
#include "mesh/slice.h"

#include <math.h>

#include "base/vec3.h"

/* Corners, with coordinates below 1, have errors of about 2^-48, which change areas by at most that
   times the perimeter. The fraction of a triangle whose altitude is below SLICE_ALTITUDE_MIN is
   unknown; for others its error is at most that of the margin, 6 2^-48 / SLICE_ALTITUDE_MIN. */
#define SLICE_ALTITUDE_MIN 1e-7
#define SLICE_MARGIN       (1.0 + 1e-6)
/* Rounding of the two ends of an extent. */
#define EXTENT_MARGIN 0x1p-40

/* (x - origin) . n */
static double slice_height(const double x[3], const double n[3], const double origin[3])
{
    return n[0] * (x[0] - origin[0]) + n[1] * (x[1] - origin[1]) + n[2] * (x[2] - origin[2]);
}

/* Adds the corner p + t (q - p). */
static void slice_add(lrcsi_slice *slice, const double p[3], const double q[3], double t)
{
    for (int k = 0; k < 3; k++) {
        slice->x[slice->count][k] = p[k] + t * (q[k] - p[k]);
    }
    slice->count++;
}

lrcsi_slice lrcsi_slice_start(const double a[3], const double b[3], const double c[3])
{
    lrcsi_slice slice = {.count = 0};
    slice_add(&slice, a, a, 0);
    slice_add(&slice, b, b, 0);
    slice_add(&slice, c, c, 0);
    return slice;
}

void lrcsi_slice_cut(lrcsi_slice *slice, const double n[3], const double origin[3], double limit)
{
    double height[3 + LRCSI_SLICE_CUTS];
    int beyond = 0;
    for (int i = 0; i < slice->count; i++) {
        height[i] = slice_height(slice->x[i], n, origin) - limit;
        beyond += height[i] > 0;
    }
    if (beyond == 0 || beyond == slice->count) {
        slice->count = beyond == 0 ? slice->count : 0;
        return;
    }
    lrcsi_slice kept = {.count = 0};
    for (int i = 0; i < slice->count; i++) {
        int next = i + 1 < slice->count ? i + 1 : 0;
        if (height[i] <= 0) {
            slice_add(&kept, slice->x[i], slice->x[i], 0);
        }
        if ((height[i] < 0 && height[next] > 0) || (height[i] > 0 && height[next] < 0)) {
            slice_add(&kept, slice->x[i], slice->x[next], height[i] / (height[i] - height[next]));
        }
    }
    *slice = kept;
}

void lrcsi_slice_cut_between(lrcsi_slice *slice, const double n[3], const double low[3],
                             const double high[3], double limit)
{
    const double down[3] = {-n[0], -n[1], -n[2]};
    lrcsi_slice_cut(slice, n, high, limit);
    lrcsi_slice_cut(slice, down, low, limit);
}

/* The area: the length of the vector area about the first corner. */
static double slice_area(const lrcsi_slice *slice)
{
    double sum[3] = {0, 0, 0};
    for (int i = 1; i + 1 < slice->count; i++) {
        double n[3];
        lrcsi_vec3_normal(slice->x[0], slice->x[i], slice->x[i + 1], n);
        for (int k = 0; k < 3; k++) {
            sum[k] += n[k];
        }
    }
    return 0.5 * sqrt(lrcsi_vec3_dot(sum, sum));
}

double lrcsi_slice_fraction(const lrcsi_slice *slice, double whole, double longest)
{
    if (slice->count < 3) {
        return 0;
    }
    double fraction = slice_area(slice) / whole * SLICE_MARGIN;
    int known = 2.0 * whole > SLICE_ALTITUDE_MIN * longest;
    return known && fraction < 1 ? fraction : 1;
}

/* With e = q - p and h the altitude of o, the height of x is (x - p) . h / (h . h). Coordinates are
   below 1 and accurate to 2^-48, so that e, h and x - p are accurate to 2^-46; h . e is 0 to within
   2^-46 (|e| + |o - p|), and the component of x - p along e is at most |e| + |o - p|: EXTENT_MARGIN
   covers all of it. */
int lrcsi_slice_heights(const lrcsi_slice *slice, const double o[3], const double p[3],
                        const double q[3], double *low, double *high)
{
    double e[3];
    double h[3];
    double along = 0;
    double square_e = 0;
    double square_h = 0;
    double altitude = 0;
    double least = HUGE_VAL;
    double most = -HUGE_VAL;
    if (slice->count == 0) {
        return 0;
    }
    for (int k = 0; k < 3; k++) {
        e[k] = q[k] - p[k];
        h[k] = o[k] - p[k];
        along += e[k] * h[k];
        square_e += e[k] * e[k];
        square_h += h[k] * h[k];
    }
    for (int k = 0; k < 3; k++) {
        h[k] -= along / square_e * e[k];
        altitude += h[k] * h[k];
    }
    for (int i = 0; i < slice->count; i++) {
        double height = slice_height(slice->x[i], h, p);
        least = height < least ? height : least;
        most = height > most ? height : most;
    }
    const double err = EXTENT_MARGIN * (1 + square_e + square_h);
    least = (least - err) / altitude;
    most = (most + err) / altitude;
    *low = least > 0 ? least : 0; /* a NaN gives all heights */
    *high = most < 1 ? most : 1;
    return 1;
}
