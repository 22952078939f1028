/* SPDX-License-Identifier: MIT */
/* A triangle in space, cut by half-spaces. Coordinates are below 1 in magnitude. */
#ifndef LRCSI_SLICE_H
#define LRCSI_SLICE_H

/* The largest number of cuts of a triangle. */
#define LRCSI_SLICE_CUTS 8

/* A convex polygon; each cut adds at most one corner. */
typedef struct lrcsi_slice {
    double x[3 + LRCSI_SLICE_CUTS][3];
    int count;
} lrcsi_slice;

/* The triangle a b c. */
lrcsi_slice lrcsi_slice_start(const double a[3], const double b[3], const double c[3]);

/* Keeps the part with n . (x - origin) <= limit, up to rounding: the caller increases `limit` by
   the error that must not remove anything. */
void lrcsi_slice_cut(lrcsi_slice *slice, const double n[3], const double origin[3], double limit);

/* Keeps the part between two planes perpendicular to n, and beyond them to a distance in units of
   n's length: n . (x - low) >= -limit and n . (x - high) <= limit. Rounding as above. */
void lrcsi_slice_cut_between(lrcsi_slice *slice, const double n[3], const double low[3],
                             const double high[3], double limit);

/* The area of the polygon as a fraction, 0 .. 1, of that of the triangle, whose longest side is
   `longest` and whose area is `whole`: rounded up, and 1 if the triangle is too thin to decide. */
double lrcsi_slice_fraction(const lrcsi_slice *slice, double whole, double longest);

/* The interval of heights over the side p q that the polygon, part of the triangle o p q, covers:
   as fractions of the height of o, 0 .. 1, rounded outward. Returns 0 if the polygon is empty. */
int lrcsi_slice_heights(const lrcsi_slice *slice, const double o[3], const double p[3],
                        const double q[3], double *low, double *high);

#endif
