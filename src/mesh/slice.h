/* SPDX-License-Identifier: MIT */
/* A triangle in space and what half-spaces leave of it. Coordinates are below 1 in magnitude. */
#ifndef LRCSI_SLICE_H
#define LRCSI_SLICE_H

/* The most cuts a triangle may take. */
#define LRCSI_SLICE_CUTS 8

/* A convex polygon; each cut adds a corner at most. */
typedef struct lrcsi_slice {
    double x[3 + LRCSI_SLICE_CUTS][3];
    int count;
} lrcsi_slice;

/* The triangle a b c. */
lrcsi_slice lrcsi_slice_start(const double a[3], const double b[3], const double c[3]);

/* Keeps where n . (x - origin) <= most, but for rounding: the caller widens `most` by what it
   cannot afford to lose. */
void lrcsi_slice_cut(lrcsi_slice *slice, const double n[3], const double origin[3], double most);

/* The polygon's share of the triangle whose longest side is `longest` and whose area is `whole`,
   0 .. 1: rounded up, and 1 where the triangle is too thin to tell. */
double lrcsi_slice_share(const lrcsi_slice *slice, double whole, double longest);

/* The interval of heights over the side p q that the polygon, part of the triangle o p q, covers:
   as a share of the height of o, 0 .. 1, rounded up. */
double lrcsi_slice_extent(const lrcsi_slice *slice, const double o[3], const double p[3],
                          const double q[3]);

#endif
