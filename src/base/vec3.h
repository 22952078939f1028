/* SPDX-License-Identifier: MIT */
/* Products and differences of vectors in plain doubles. The order of operations is fixed, so that
   results have the same bits everywhere; base/length.h has lengths. */
#ifndef LRCSI_VEC3_H
#define LRCSI_VEC3_H

static inline double lrcsi_vec3_dot(const double a[3], const double b[3])
{
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

/* out = a x b. `out` must be neither a nor b. */
static inline void lrcsi_vec3_cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* a x b in the plane. */
static inline double lrcsi_vec2_cross(const double a[2], const double b[2])
{
    return a[0] * b[1] - a[1] * b[0];
}

/* out = b - a, the vector from a to b. */
static inline void lrcsi_vec3_between(const double a[3], const double b[3], double out[3])
{
    out[0] = b[0] - a[0];
    out[1] = b[1] - a[1];
    out[2] = b[2] - a[2];
}

/* out = (b - a) x (c - a): the normal of the triangle a b c, twice its area long. */
static inline void lrcsi_vec3_normal(const double a[3], const double b[3], const double c[3],
                                     double out[3])
{
    double p[3];
    double q[3];
    lrcsi_vec3_between(a, b, p);
    lrcsi_vec3_between(a, c, q);
    lrcsi_vec3_cross(p, q, out);
}

#endif
