/* SPDX-License-Identifier: MIT */
/* F = f_r cos^2 over a patch, or a part of one, as a function of two variables: values, bounds, and
   rules for means with a proved remainder.

   The patch in the shape's frame. The normal at azimuth phi, at an angle alpha from the axis, is
       N = (sin alpha cos phi, sin alpha sin phi, cos alpha).
   The patch extends over the azimuths of one sector. Its elements of area (mesh/shape/revolution.c)
   are
   - on a straight wall, where alpha is constant: (rho0 + rho1) / 2 times the slant height, d phi;
   - on a sphere or dome: R^2 sin alpha, d alpha d phi;
   - on a paraboloid: (R / y_rim)^2 sin alpha / cos^4 alpha, d alpha d phi. At slope y = tan alpha,
     rho = R y / y_rim, and the element of the meridian is d rho sqrt(1 + y^2).

   Rows are at equal steps of alpha. With g the direction to the laser in that frame, c = g . N and
   p = |g x N|, F is a function of u = p^2 / c^2 = tan^2 theta and w = 1 + u = 1 / c^2:
   F = A w^2 exp(-u / s^2) + B w^(-m/2 - 1). Where the surface faces away, c <= 0, F is 0.

   Remainder. That of a rule in one variable: integrate/wall/mean_rule.h.
   The error of a product of rules in alpha and phi, I - QQ' = (I - Q) I' + Q (I' - Q'), is at most
   the sum of the errors of both, where M is taken over one complex and one real variable.

   M. Turning by a complex angle of size a moves a unit vector by at most e^a - 1, and N is a turn
   about z by phi of a turn by alpha of the axis; the turn about z moves only the part of N across
   z, at most (|sin alpha| + a) e^a. So where |d alpha| <= a, |d phi| <= b, N moves by at most
       kappa = (e^b - 1) (|sin alpha| + a) e^a + e^a - 1        (alpha constant: a = 0),
   and so do c and the vector g x N; (g x N) . (g x N) = 1 - c^2 holds for complex angles too. With
   c, p, u of the patch's middle and kappa < c,
       |w| = |c'|^-2 <= (c - kappa)^-2,
       |w|^-1 <= (c + kappa)^2,
       Re u' >= u - [2 p kappa + kappa^2 + u (2 c kappa + kappa^2)] / (c - kappa)^2,
   which bounds both terms of F. The weights are bounded by
       |sin alpha'| <= (|sin alpha| + a) e^a,
       |cos alpha'| >= |cos alpha| - (e^a - 1).

   Where the scale of the placement differs between axes, H takes normals to directions of normals
   (lrcs_part.normal_axis), |H| = 1, and n = H N takes the place of N. Let e_alpha, e_r and e_phi be
   the unit vectors along the meridian, away from the axis and around it in the middle of the patch.
   Turned by alpha', N moves by (cos alpha' - 1) N + sin alpha' e_alpha, and then by phi', its part
   across the axis, s e_r, by s ((cos phi' - 1) e_r + sin phi' e_phi). So n moves by at most
       kappa = (cosh a - 1) nu + sinh a |H e_alpha|
               + s_max ((cosh b - 1) |H e_r| + sinh b |H e_phi|),
       s_max = |sin alpha| cosh a + |cos alpha| sinh a.
   With nu = |n| in the middle, c = g . n, p = |g x n|, u = p^2 / c^2 and, since the equation
   c^2 + (g x n) . (g x n) = n . n holds for complex n as well, w = (n . n) / c^2; areas have the
   weight (n . n)^(1/2). In the bounds above 1 becomes n . n, which lies between two bounds:
       nu^2 - 2 nu kappa - kappa^2 <= |n . n| <= (nu + kappa)^2.

   Rounding. N and g together have an error of at most e = LRCSI_PATCH_NORMAL_ERR: azimuths and
   angles below 7 are accurate to 4 u of that, a sine or cosine to 2 u, axes and direction to a few
   u. So c and p have the same error, and u has one of at most du = (2 p e + e^2 + 2 u c e) / c^2,
   up to 1 %. Since |d log glint / du| <= 2 + 1/s^2 and |d log diffuse / du| <= m/2 + 1, each term
   changes by at most the factor exp of that times du. Areas, weights and sums are accurate to
   LRCSI_PATCH_AREA_ERR, relative, nu to e / nu, and a paraboloid's to that divided by cos alpha. */
#ifndef LRCSI_PATCH_FRAME_H
#define LRCSI_PATCH_FRAME_H

#include "base/constant.h"
#include "integrate/wall/mean_rule.h"
#include "integrate/wall/rim_shadow.h"
#include "mesh/shape/tessellate.h"
#include "view/view.h"

/* The mean of f_r cos^2 over a patch, per unit of area of the patch's facets. Where the patch faces
   away from the laser, f_r cos^2 counts as 0. */
typedef struct lrcsi_patch {
    double glint, diffuse;
    double glint_u;      /* the mean of u times the glint, u = tan^2(theta), if asked for; else 0 */
    double diffuse_log;  /* the mean of log(1 + u) times the diffuse term, likewise */
    double remainder;    /* bound on the error of glint + diffuse due to the quadrature rule */
    double rounding;     /* bound on their rounding error */
    double facet_area;   /* of the facets that share it, scaled */
    double area_err;     /* bound on the relative change that rounding of the corners makes in the
                            area of a region of the facets */
    lrcsi_wall_patch at; /* its position on the shape */
    uint32_t part;       /* the part that is the shape */
    lrcs_brdf brdf;
    int side;  /* 1: seen from outside, -1: from inside; 0: there is no patch yet */
    int known; /* 0: there is a patch, but its mean is not known */
} lrcsi_patch;

/* The part of a facet. */
const lrcs_part *lrcsi_patch_part(const lrcs_prepared *prepared, uint32_t facet);

/* The first facet of a sector, of which the given one is the first or the second: the two are
   neighbours in the part's list of facets, in which every strip of a wall begins at an even index
   (mesh/shape/tessellate.c). In a strip that ends in an apex each facet has a sector of its own;
   the two are neighbours in the list all the same. */
uint32_t lrcsi_patch_sector(const lrcs_prepared *prepared, uint32_t facet);

/* The other facet of the sector. */
uint32_t lrcsi_patch_partner(const lrcs_prepared *prepared, uint32_t facet);

/* 1 if a facet may represent a patch: it is on the curved wall of a shape. */
int lrcsi_patch_exists(const lrcs_prepared *prepared, uint32_t facet);

/* What an error e of a unit normal, at most 2^-10 c, changes in both terms of f_r cos^2, relative,
   up to the factor exp of it (see above). Given: u = tan^2, the cosine c and the sine p of the
   incidence angle. */
typedef struct lrcsi_term_errors {
    double glint, diffuse;
} lrcsi_term_errors;
lrcsi_term_errors lrcsi_patch_term_errors(const lrcs_brdf *brdf, double e, double u, double c,
                                          double p);

#define LRCSI_PATCH_AREA_ERR (512 * LRCSI_U)

/* A patch, or a part of it, and the direction to the laser: in the shape's frame or, where its
   scale differs between axes, in the body frame. */
typedef struct lrcsi_patch_frame {
    double g[3];             /* the direction to the laser, from the side that is lit */
    const double (*axis)[3]; /* the images of the shape's axes under H; NULL: without distortion */
    double alpha, step;      /* of the middle, and half the width; step 0: straight wall */
    double phi, half;        /* the same of the azimuth */
    double sine, cosine;     /* of alpha */
    double along_image; /* |H e_alpha|, |H e_r|, |H e_phi| in the middle, if `axis` is not NULL */
    double radial_image, around_image;
    double c, p, u, nu; /* in the middle */
    double most;        /* about the largest cosine of incidence of the whole wall */
    int fourth;         /* the weight has cos^-4 alpha */
    double area;        /* of the patch, for a weight of 1, divided by that of its facets */
    double tolerance;   /* of the plan */
    double target;      /* the remainder that rules should have, relative to F */
    int derivatives;    /* 1: means include what derivatives need */
    const lrcsi_rim_shadow *shadow; /* on a straight wall F includes the visible fraction; NULL:
                                       none */
} lrcsi_patch_frame;

/* The frame of patch->at, except for tolerance, target, derivatives and shadow, which are 0.
   Returns 0 if rounding left its facets without area. */
int lrcsi_patch_frame_make(const lrcsi_view *view, uint32_t facet, lrcsi_patch_frame *f,
                           lrcsi_patch *patch);

/* The part of a patch with the given middle and half widths. */
lrcsi_patch_frame lrcsi_patch_frame_part(const lrcsi_patch_frame *whole, double alpha, double step,
                                         double phi, double half);

/* The vector whose product with N is g . n: g or, with distortion, its image under the transpose of
   H. */
void lrcsi_patch_direction(const lrcsi_patch_frame *f, double g[3]);

/* kappa, from a and the exponentials of a and b; the error of the normal is added. */
double lrcsi_patch_normal_shift(const lrcsi_patch_frame *f, double a, double exp_a, double exp_b);

/* M of both terms, with the weights; infinite if the surface may be edge-on to the laser somewhere
   in the neighbourhood. */
typedef struct lrcsi_patch_bound {
    double glint, diffuse;
} lrcsi_patch_bound;
lrcsi_patch_bound lrcsi_patch_bound_make(const lrcsi_patch_frame *f, const lrcs_brdf *brdf,
                                         double a, double exp_a, double exp_b);

/* An upper bound of F, with the weights, over the frame itself; infinite if that may be edge-on. */
double lrcsi_patch_largest(const lrcsi_patch_frame *f, const lrcs_brdf *brdf);

/* F at tan^2 = u, with the weights in the middle. */
double lrcsi_patch_integrand(const lrcsi_patch_frame *f, const lrcs_brdf *brdf, double u);

/* The radii r for which M is computed (integrate/wall/mean_rule.h): any would do, and the smallest
   remainder is used. */
#define LRCSI_PATCH_RADII 6
extern const double lrcsi_patch_radii[LRCSI_PATCH_RADII];

/* Chooses the rule in one variable: that with the fewest points whose remainder is at most
   `target`, or else the one with the most points. *error is its remainder. along: 1 for alpha, 0
   for phi. bend: NULL, or for each radius a bound on how far the other variable is from its
   interval (integrate/wall/patch_cut.c). */
const lrcsi_mean_rule *lrcsi_patch_rule_choose(const lrcsi_patch_frame *f, const lrcs_brdf *brdf,
                                               int along, const double bend[LRCSI_PATCH_RADII],
                                               double target, double *error);

/* Chooses the rules in alpha (0) and phi (1). Returns the remainder of their product. */
double lrcsi_patch_rules(const lrcsi_patch_frame *f, const lrcs_brdf *brdf, double target,
                         const lrcsi_mean_rule *rule[2]);

/* Adds F at one point to a mean, times a weight; and the sum over the points of the rules in alpha
   and phi, times `fraction`. Returns 0 if the rounding error of a point is too large. */
int lrcsi_patch_add_point(const lrcsi_patch_frame *f, const lrcs_brdf *brdf, double alpha,
                          double phi, double weight, lrcsi_patch *patch);
int lrcsi_patch_add_points(const lrcsi_patch_frame *f, const lrcs_brdf *brdf,
                           const lrcsi_mean_rule *const rule[2], double fraction,
                           lrcsi_patch *patch);

#endif
