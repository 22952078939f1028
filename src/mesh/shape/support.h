/* SPDX-License-Identifier: MIT */
/* Support points of the solids that curved shapes bound, with their caps or bases. */
#ifndef LRCSI_SUPPORT_H
#define LRCSI_SUPPORT_H

/* The dimensions of a shape, in any unit: the base's radius, for a frustum radius2; a cone's length
   also where the shape gives its half-angle. */
typedef struct lrcsi_support {
    int kind;
    double radius, radius2, length;
} lrcsi_support;

/* The point of the solid, in the shape's own frame, that is farthest in the direction n, which need
   not have length 1; one of them, if there are several. Each coordinate is accurate to 16 u of the
   dimensions, or it is that of another point whose x . n is as large to that accuracy. */
void lrcsi_support_point(const lrcsi_support *solid, const double n[3], double point[3]);

/* The support points p and q for the directions n and m. If those for all directions n + t (m - n),
   0 <= t <= 1, lie to that accuracy on an arc of one circle, an upper bound of the angle (rad) that
   the arc subtends; 0 if they lie on a parabola or on a straight line; HUGE_VAL if neither is
   known. */
double lrcsi_support_arc(const lrcsi_support *solid, const double n[3], const double p[3],
                         const double m[3], const double q[3]);

#endif
