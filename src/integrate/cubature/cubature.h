/* SPDX-License-Identifier: MIT */
/* The integral of f_r cos(theta) over flat triangles whose normals are interpolated linearly
   between their corners, by adaptive cubature. Its own error is an ESTIMATE. */
#ifndef LRCSI_CUBATURE_H
#define LRCSI_CUBATURE_H

#include <lrcs/work.h>

#include "base/meter.h"
#include "base/sum.h"
#include "integrate/cubature/cubature_cell.h"
#include "optics/reflect.h"

/* A surface whose normals lie between three given ones, and how accurately f_r cos is integrated
   over it. Areas may be in any unit. */
typedef struct lrcsi_cubature_surface {
    const lrcs_brdf *brdf;
    double tolerance;             /* the relative error aimed at */
    lrcsi_reflection upper_bound; /* of the two terms of f_r cos on the surface */
    double diffuse_min;           /* a lower bound of the diffuse term of f_r cos on the surface */
    double negligible;            /* errors of f_r cos below this are accepted */
    lrcsi_cubature_cell *stack;   /* memory for cells; it holds nothing between triangles */
    /* 0 unless the caller sets them: */
    double area;         /* of all triangles that will be added, approximately */
    double position_err; /* bound on the error of normals where they are evaluated, rad */
    double reference;    /* f_r cos of the surfaces with which this one is summed: errors below the
                            tolerance times this are accepted too */
    int derivatives;     /* 1: compute glint_u and diffuse_log, too */
    lrcsi_meter *meter;  /* once spent, no cell is divided further; NULL: no limit */
} lrcsi_cubature_surface;

/* A sum over triangles of one surface. */
typedef struct lrcsi_cubature {
    lrcsi_cubature_surface surface; /* given; not changed after the first triangle */
    double tolerance; /* the surface's, or increased where the work would exceed the limits */
    lrcsi_sum glint, diffuse;
    lrcsi_sum glint_u, diffuse_log; /* the integral of the glint times tan^2, and that of the
                                       diffuse term times log(1 + tan^2), if asked for */
    lrcsi_sum weighted;             /* f_r cos times the caller's linear function */
    double estimate;                /* of the cubature's error */
    double unresolved;              /* bound on the error where no steps were left */
    double rounding;                /* bound on the rounding error of the sum */
    uint32_t splits;                /* number of cells made so far by dividing others */
} lrcsi_cubature;

/* Bytes of the stack; and takes the stack from a work area (NULL if that is too small). Several
   sums may share one. */
size_t lrcsi_cubature_need(void);
lrcsi_cubature_cell *lrcsi_cubature_stack(lrcs_work *work);

/* A surface whose normals lie between the three given ones (as below). The caller sets area,
   position_err and meter and, if there are other surfaces, increases negligible and sets
   reference. */
lrcsi_cubature_surface lrcsi_cubature_surface_make(const lrcs_brdf *brdf, const double normal[3][3],
                                                   double tolerance, lrcsi_cubature_cell *stack);

/* An empty sum. */
lrcsi_cubature lrcsi_cubature_start(const lrcsi_cubature_surface *surface);

/* Adds a triangle. Given: the normals at its corners, in view axes (z to the laser), of about unit
   length; a linear function of position, as its values at the corners, whose product with f_r cos
   is added to `weighted` (NULL: none); its area. Where the interpolated normal has z <= 0 it does
   not face the laser, and adds nothing. */
void lrcsi_cubature_add(lrcsi_cubature *sum, const double normal[3][3], const double weight[3],
                        double area);

#endif
