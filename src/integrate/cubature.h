/* SPDX-License-Identifier: MIT */
/* The integral of f_r cos(theta) over flat triangles whose normals are interpolated linearly
   between their corners, by adaptive cubature. Its own error is an ESTIMATE. */
#ifndef LRCSI_CUBATURE_H
#define LRCSI_CUBATURE_H

#include <lrcs/work.h>

#include "base/meter.h"
#include "base/sum.h"
#include "optics/reflect.h"

/* A part of a triangle that is yet to be done. */
typedef struct lrcsi_cubature_cell lrcsi_cubature_cell;

/* A sum over triangles of one surface. Areas are in any one unit. */
typedef struct lrcsi_cubature {
    const lrcs_brdf *brdf;
    double tolerance;      /* relative error aimed at; grows where the work would */
    double whole;          /* area of all triangles to come, or about that */
    double position_err;   /* by how much a normal may be off where it is evaluated, rad */
    lrcsi_reflection most; /* bounds on the parts of f_r cos over all of them */
    double least;          /* a diffuse f_r cos that is nowhere undercut */
    double negligible;     /* f_r cos below this is not looked for */
    double had;            /* f_r cos that other surfaces have to set against this one's: an error
                              of the tolerance times this, per area, is small enough */
    lrcsi_sum glint, diffuse;
    int moments;                    /* 1: sum these too, at the same nodes; set by the caller */
    lrcsi_sum glint_u, diffuse_log; /* f_r cos times tan^2, and times log(1 + tan^2) */
    const double *weight;           /* at the three corners of the triangle to be added: a linear
                                       function; set by the caller; NULL: none */
    lrcsi_sum weighted;             /* f_r cos times that function, at the same nodes */
    double estimate;                /* of the cubature's error */
    double left;     /* bound on the error where the meter left no steps to look closer */
    double rounding; /* bound on the error that rounding adds to the cubature's own sum */
    uint32_t splits;
    lrcsi_meter *meter;           /* once spent, no part is divided further; NULL: no limit */
    lrcsi_cubature_cell *waiting; /* room for parts: nothing is kept there between triangles */
} lrcsi_cubature;

/* The parts that wait at most: bytes, and room for them in a work area, NULL if it has none. */
size_t lrcsi_cubature_need(void);
lrcsi_cubature_cell *lrcsi_cubature_cells(lrcs_work *work);

/* An empty sum over surfaces whose normals lie between these three (as below), with such room,
   which sums may share: whole, position_err and the meter are the caller's to set, and negligible
   and had where there are other surfaces. */
lrcsi_cubature lrcsi_cubature_make(const lrcs_brdf *brdf, const double normal[3][3],
                                   double tolerance, lrcsi_cubature_cell *waiting);

/* Given: the normals at the corners, view axes (z to the laser), of about unit length; area.
   Normals with z <= 0 see nothing of the laser and add nothing. */
void lrcsi_cubature_add(lrcsi_cubature *sum, const double normal[3][3], double area);

#endif
