/* SPDX-License-Identifier: MIT */
/* The bins of a range profile: sigma of triangles divided among them. The errors (1) to (5):
   integrate/range/range_profile.c. */
#ifndef LRCSI_RANGE_BINS_H
#define LRCSI_RANGE_BINS_H

#include "base/sum.h"
#include "integrate/cubature/curve.h"

/* The sums of a bin, scaled. `bound` contains the parts (1) to (4) of the error, both of the bin's
   sigma and of sums that weight sigma by range; part (5) differs between the two. */
typedef struct lrcsi_range_sums {
    lrcsi_sum glint, diffuse, moment;
    double bound;
    double tessellation, tessellation_variation; /* (5): of sigma; of weighted sigma */
    double estimate;                             /* of the cubature's error */
} lrcsi_range_sums;

/* All is scaled except bin_m. */
typedef struct lrcsi_range_bins {
    int exponent;        /* lengths in metres = scaled lengths * 2^exponent */
    double bin_m, width; /* width: bin_m scaled */
    int64_t first;       /* the number of bin[0] */
    uint32_t count;
    lrcsi_range_sums *bin;
    uint32_t begin, end;      /* only bins begin <= i < end may have any sigma */
    lrcsi_sum glint, diffuse; /* of all bins */
    double bound, estimate;   /* of all bins */
    double additions;         /* the number of additions to the sums */
    double range_err;
} lrcsi_range_bins;

/* A facet: the ranges of its corners, the bins that it extends into, and its sigma per unit of
   visible projected area. */
typedef struct lrcsi_range_facet {
    double range[3], range_max; /* at its corners; the largest |range| */
    double range_dd_err;        /* the error of the ranges of corners before they were rounded */
    double extent;              /* upper bound of the distance in range of any two of its points */
    uint32_t first, last;       /* bins */
    double glint, diffuse, rounding;   /* of a flat facet */
    double upper_bound;                /* of its true sigma per unit area, at any point */
    const lrcsi_curve_integral *curve; /* NULL: its normals are not curved */
    double position_err;               /* of curved normals, at the corners of triangles */
} lrcsi_range_facet;

/* Relative error of the area of a triangle within a bin. */
#define LRCSI_RANGE_AREA_ERR (16 * LRCSI_U)

/* The lower edge of bin i. */
double lrcsi_range_edge(const lrcsi_range_bins *bins, uint32_t i);

/* The bin that contains a range, or the nearest one if none does. */
uint32_t lrcsi_range_bin(const lrcsi_range_bins *bins, double range);

/* The corners of a triangle in ascending order of their ranges. */
void lrcsi_range_order(const double range[3], int order[3]);

/* Adds a triangle of a facet to the bins. Given: its projected area; the ranges of its corners,
   with errors of at most range_err; the normals at its corners, used if those of the facet are
   curved. */
void lrcsi_range_add_triangle(lrcsi_range_bins *bins, const lrcsi_range_facet *f, double area,
                              const double range[3], const double normal[3][3], double range_err);

#endif
