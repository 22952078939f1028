/* SPDX-License-Identifier: MIT */
/* The mean of F = f_r cos^2 over the patch of a facet, by Gauss-Legendre rules with a proved
   remainder. Whether the patch is visible is decided elsewhere (integrate/wall/tessellation.c).

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

   Pieces. The patch is halved in both variables, and its halves again, where the remainder of the
   rules would be too large, or where it is nearly edge-on to the laser.

   Remainder. That of a rule in one variable: integrate/wall/mean_rule.h.
   The error of a product of rules in alpha and phi, I - QQ' = (I - Q) I' + Q (I' - Q'), is at most
   the sum of the errors of both, where M is taken over one complex and one real variable.

   M. Turning by a complex angle of size a moves a unit vector by at most e^a - 1, and N is a turn
   about z by phi of a turn by alpha of the axis; the turn about z moves only the part of N across
   z, at most (|sin alpha| + a) e^a. So where |d alpha| <= a, |d phi| <= b, N moves by at most
       kappa = (e^b - 1) (|sin alpha| + a) e^a + e^a - 1        (alpha constant: a = 0),
   and so do c and the vector g x N; (g x N) . (g x N) = 1 - c^2 holds for complex angles too. With
   c, p, u of the patch's middle and kappa <= c / 2,
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

   Edge-on. With kappa for real angles up to the ends of a piece, and c of its middle, all of it
   faces away if c + kappa <= 0. Otherwise no cosine of incidence in it exceeds
   x = (c + kappa) / (nu - kappa), and F is at most its value at u = 1 / x^2 - 1, if that is 2 s^2
   or more: the diffuse term decreases with u, and the glint does where w > 2 s^2. The weights are
   at most |sin alpha| + a, nu + kappa and (|cos alpha| - a)^-4.

   Rounding. N and g together have an error of at most e = LRCSI_PATCH_NORMAL_ERR: azimuths and
   angles below 7 are accurate to 4 u of that, a sine or cosine to 2 u, axes and direction to a few
   u. So c and p have the same error, and u has one of at most du = (2 p e + e^2 + 2 u c e) / c^2,
   up to 1 %. Since |d log glint / du| <= 2 + 1/s^2 and |d log diffuse / du| <= m/2 + 1, each term
   changes by at most the factor exp of that times du. Areas, weights and sums are accurate to
   PATCH_AREA_ERR, relative, nu to e / nu, and a paraboloid's to that divided by cos alpha.
   Called: lrcsi_tessellate_patch, lrcsi_revolution_make, lrcsi_reflect. */
#include "integrate/wall/patch.h"

#include <math.h>

#include "base/elementary.h"
#include "base/outward.h"
#include "base/range.h"
#include "integrate/wall/mean_rule.h"
#include "mesh/shape/revolution.h"
#include "optics/reflect.h"

#define PATCH_AREA_ERR (512 * LRCSI_U)
/* Heuristics, which affect the time and the size of remainders, which are part of the bound
   whatever they are:
   - the remainder that a rule should have, relative to F in the middle of the patch, unless it is
     negligible (lrcsi_patches); the remainder, relative to the mean, above which the mean is not
     used, unless it is negligible; how often a patch is halved in each variable;
   - of pieces that are nearly edge-on, where normals move by more than a fraction of the cosine:
     how often they are halved, and how often at most while F of what is left is not negligible.
     The area of these is so small that far more is negligible there than elsewhere;
   - of patches that may be edge-on in part: the remainder that is enough, relative to the largest
     F; that above which the mean is not used, relative to the mean: without it, about all of F
     would be an error. */
#define REMAINDER_TARGET   0x1p-26
#define REMAINDER_MAX      0x1p-10
#define LEVELS_MAX         2
#define NEARLY_EDGE_ON     0.1
#define EDGE_ON_LEVELS     3
#define EDGE_ON_NEGLIGIBLE 0x1p16
#define EDGE_ON_LEVELS_MAX 7
#define EDGE_ON_TARGET     0x1p-14
#define EDGE_ON_MAX        0x1p-3

/* The radii r for which M is computed: any would do, and the smallest remainder is used. */
static const double radii[] = {1.5, 2.5, 4.0, 7.0, 12.0};
#define RADII ((int)(sizeof radii / sizeof *radii))

/* A patch and the direction to the laser: in the shape's frame or, where its scale differs between
   axes, in the body frame. */
typedef struct patch_frame {
    double g[3];             /* the direction to the laser, from the side that is lit */
    const double (*axis)[3]; /* the images of the shape's axes under H; NULL: without distortion */
    double alpha, step;      /* of the middle, and half the width; step 0: straight wall */
    double phi, half;        /* the same of the azimuth */
    double sine, cosine;     /* of alpha */
    double along_image; /* |H e_alpha|, |H e_r|, |H e_phi| in the middle, if `axis` is not NULL */
    double radial_image, around_image;
    double c, p, u, nu; /* in the middle of the patch */
    int fourth;         /* the weight has cos^-4 alpha */
    double area;        /* of the patch, for a weight of 1, divided by that of its facets */
    double negligible;  /* remainder, without that factor */
    int derivatives;    /* lrcsi_patches */
} patch_frame;

const lrcs_part *lrcsi_patch_part(const lrcs_prepared *p, uint32_t facet)
{
    return &p->scene->part[p->scene->facet_part[facet]];
}

uint32_t lrcsi_patch_sector(const lrcs_prepared *p, uint32_t facet)
{
    uint32_t begin = lrcsi_patch_part(p, facet)->first_facet;
    return begin + ((facet - begin) & ~UINT32_C(1));
}

uint32_t lrcsi_patch_partner(const lrcs_prepared *p, uint32_t facet)
{
    uint32_t begin = lrcsi_patch_part(p, facet)->first_facet;
    return begin + ((facet - begin) ^ 1);
}

int lrcsi_patch_exists(const lrcs_prepared *p, uint32_t facet)
{
    const lrcs_part *part = lrcsi_patch_part(p, facet);
    return p->scene->facet_smooth[facet] != 0 && part->bounds.patch.turn > 0 &&
           part->normals_known && part->bounds.known;
}

/* u = tan^2 theta of a normal, given sine and cosine of its angle from the axis, and those of its
   azimuth; c, p and nu. */
static double patch_tan2(const patch_frame *f, double sine, double cosine, const double azimuth[2],
                         double *c, double *p, double *nu)
{
    const double given[3] = {sine * azimuth[1], sine * azimuth[0], cosine};
    double n[3] = {given[0], given[1], given[2]};
    const double *g = f->g;
    *nu = 1;
    if (f->axis) {
        for (int k = 0; k < 3; k++) {
            n[k] = given[0] * f->axis[0][k] + given[1] * f->axis[1][k] + given[2] * f->axis[2][k];
        }
        *nu = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    }
    double x = g[1] * n[2] - g[2] * n[1];
    double y = g[2] * n[0] - g[0] * n[2];
    double z = g[0] * n[1] - g[1] * n[0];
    double square = x * x + y * y + z * z;
    *c = g[0] * n[0] + g[1] * n[1] + g[2] * n[2];
    *p = sqrt(square);
    return square / (*c * *c);
}

/* The length of the image of a vector under H. */
static double image_length(const patch_frame *f, double x, double y, double z)
{
    double square = 0;
    for (int k = 0; k < 3; k++) {
        double image = x * f->axis[0][k] + y * f->axis[1][k] + z * f->axis[2][k];
        square += image * image;
    }
    return sqrt(square);
}

static void frame_middle(patch_frame *f)
{
    const double azimuth[2] = {sin(f->phi), cos(f->phi)};
    if (f->axis) {
        f->along_image = image_length(f, f->cosine * azimuth[1], f->cosine * azimuth[0], -f->sine);
        f->radial_image = image_length(f, azimuth[1], azimuth[0], 0);
        f->around_image = image_length(f, -azimuth[0], azimuth[1], 0);
    }
    f->u = patch_tan2(f, f->sine, f->cosine, azimuth, &f->c, &f->p, &f->nu);
}

/* The frame of patch->at. Returns 0 if rounding left its facets without area. */
static int frame_make(const lrcsi_view *view, uint32_t facet, const lrcsi_patches *patches,
                      patch_frame *f, lrcsi_patch *patch)
{
    const lrcs_prepared *prepared = view->prepared;
    const lrcs_part *part = &prepared->scene->part[patch->part];
    const lrcsi_wall_patch *at = &patch->at;
    lrcsi_revolution body = lrcsi_revolution_make(&part->shape, &part->divisions);
    double unit = ldexp(part->unit, -prepared->exponent);
    double facets = 0.5 * prepared->normal[facet].length;
    if (at->facets == 2) {
        uint32_t other = lrcsi_patch_partner(prepared, facet);
        facets += prepared->skip[other] ? 0 : 0.5 * prepared->normal[other].length;
    }
    f->axis = part->rigid ? NULL : (const double(*)[3])part->normal_axis;
    for (int k = 0; k < 3; k++) {
        const double *axis = part->axis[k];
        double along = axis[0] * view->unit[0] + axis[1] * view->unit[1] + axis[2] * view->unit[2];
        f->g[k] = patch->side * (part->rigid ? along : view->unit[k]);
    }
    f->half = body.half;
    f->phi = (2.0 * at->sector + 1.0) * body.half;
    f->fourth = part->kind == LRCS_SHAPE_PARABOLOID;
    f->step = 0.5 * body.step;
    f->alpha = (2.0 * (double)(body.zones - at->row) - 1.0) * f->step;
    if (body.step > 0) {
        double radius = (f->fourth ? body.base / body.slope : body.base) * unit;
        f->sine = sin(f->alpha);
        f->cosine = cos(f->alpha);
        f->area = 4 * f->step * f->half * radius * radius;
    } else {
        double fall = body.base - body.top;
        double slant = hypot(fall, body.height);
        f->sine = body.height / slant;
        f->cosine = fall / slant;
        f->area = f->half * ((body.base + body.top) * unit) * (slant * unit);
    }
    f->cosine = at->mirrored ? -f->cosine : f->cosine;
    f->area *= (part->rigid ? 1 : part->normal_area) / facets;
    frame_middle(f);
    f->negligible = patches->negligible / f->area;
    f->derivatives = patches->derivatives;
    patch->area_err = 2 * (lrcsi_revolution_rounding(&body, at->row) + part->bounds.normal_err);
    return isfinite(f->area) && (!f->fourth || body.step > 0);
}

/* --- the remainder ---------------------------------------------------------------------------- */

/* kappa, from a and the exponentials of a and b; the error of the normal is added. */
static double normal_shift(const patch_frame *f, double a, double exp_a, double exp_b)
{
    if (f->axis) {
        double sinh_a = 0.5 * (exp_a - 1 / exp_a);
        double sinh_b = 0.5 * (exp_b - 1 / exp_b);
        double s_max = f->sine * (exp_a - sinh_a) + fabs(f->cosine) * sinh_a;
        return (exp_a - sinh_a - 1) * f->nu + sinh_a * f->along_image +
               s_max * ((exp_b - sinh_b - 1) * f->radial_image + sinh_b * f->around_image) +
               LRCSI_PATCH_NORMAL_ERR;
    }
    return (exp_b - 1) * (f->sine + a) * exp_a + (exp_a - 1) + LRCSI_PATCH_NORMAL_ERR;
}

/* M, with the weights; infinite if the surface may be edge-on to the laser somewhere in the
   neighbourhood. With x = (c + kappa) / nu_min, x^(m+2) <= x^2 exp(m (x - 1)), or x^2 if x <= 1. */
static double integrand_bound(const patch_frame *f, const lrcs_brdf *brdf, double a, double exp_a,
                              double exp_b)
{
    double kappa = normal_shift(f, a, exp_a, exp_b);
    double c_min = f->c - kappa;
    double square = f->nu * f->nu - kappa * (2 * f->nu + kappa);
    double nu_max = f->axis ? f->nu + kappa : 1; /* bounds of |n . n|^(1/2) */
    double nu_min = f->axis ? sqrt(lrcsi_max(0, square)) : 1;
    double x = (f->c + kappa) / nu_min;
    double bound = 0;
    if (!(kappa <= 0.5 * f->c) || !(nu_min > 0)) {
        return HUGE_VAL;
    }
    if (brdf->A > 0) {
        double decrease = (2 * f->p * kappa + kappa * kappa + f->u * kappa * (2 * f->c + kappa)) /
                          (c_min * c_min);
        double exponent =
            (decrease - f->u + 16 * LRCSI_U * (decrease + f->u)) / (brdf->s * brdf->s);
        double w = nu_max / c_min * (nu_max / c_min);
        bound += brdf->A * lrcsi_exp(exponent) * (w * w);
    }
    if (brdf->B > 0) {
        bound += brdf->B * x * x * (x > 1 ? lrcsi_exp(brdf->m * (x - 1)) : 1);
    }
    if (f->step > 0) {
        double low = f->fourth ? fabs(f->cosine) - (exp_a - 1) : 1;
        bound *= low > 0 ? (f->sine + a) * exp_a / (low * low * low * low) : HUGE_VAL;
    }
    return LRCSI_OUTWARD_MICRO * nu_max * bound;
}

/* Chooses the rule in one variable: that with the fewest points whose remainder is at most
   `target`, or else the one with the most points. *error is its remainder. along: 1 for alpha, 0
   for phi. */
static const lrcsi_mean_rule *rule_choose(const patch_frame *f, const lrcs_brdf *brdf, int along,
                                          double target, double *error)
{
    double best[LRCSI_MEAN_RULES];
    double exp_other = lrcsi_exp(along ? f->half : f->step);
    for (int n = 0; n < LRCSI_MEAN_RULES; n++) {
        best[n] = HUGE_VAL;
    }
    for (int i = RADII - 1; i >= 0 && !(best[0] <= target); i--) {
        double r = radii[i];
        double exp_own = lrcsi_exp(r * (along ? f->step : f->half));
        double bound = along ? integrand_bound(f, brdf, r * f->step, exp_own, exp_other)
                             : integrand_bound(f, brdf, f->step, exp_other, exp_own);
        double q = 1 / (r * r);
        for (int n = 0, k = 0; n < LRCSI_MEAN_RULES && bound < HUGE_VAL; n++) {
            for (; k < lrcsi_mean_rules[n].points; k++) {
                bound *= q;
            }
            best[n] = lrcsi_min(best[n], bound / ((2 * k + 1) * (1 - q)));
        }
    }
    const int n = lrcsi_mean_rule_choose(best, target);
    *error = LRCSI_OUTWARD_MICRO * best[n];
    return &lrcsi_mean_rules[n];
}

lrcsi_term_errors lrcsi_patch_term_errors(const lrcs_brdf *brdf, double e, double u, double c,
                                          double p)
{
    double du = 1.01 * (2 * p * e + e * e + 2 * u * c * e) / (c * c);
    return (lrcsi_term_errors){brdf->A > 0 ? du * (2 + 1 / (brdf->s * brdf->s)) : 0,
                               du * (0.5 * brdf->m + 1)};
}

/* --- the mean --------------------------------------------------------------------------------- */

/* Adds F at one normal, given sines and cosines as patch_tan2. Returns 0 if its rounding error is
   too large. */
static int patch_add_point(const patch_frame *f, const lrcs_brdf *brdf, double sine, double cosine,
                           const double azimuth[2], double weight, lrcsi_patch *patch)
{
    double c;
    double p;
    double nu;
    double u = patch_tan2(f, sine, cosine, azimuth, &c, &p, &nu);
    const lrcsi_term_errors err = lrcsi_patch_term_errors(brdf, LRCSI_PATCH_NORMAL_ERR, u, c, p);
    double nu_err = f->axis ? LRCSI_PATCH_NORMAL_ERR / nu : 0;
    if (!(err.glint <= 1 && err.diffuse <= 1 && nu_err <= 1)) {
        return 0;
    }
    lrcsi_reflection at = lrcsi_reflect(brdf, u, 0);
    weight *= nu;
    patch->glint += weight * at.glint;
    patch->diffuse += weight * at.diffuse;
    if (f->derivatives) {
        patch->glint_u += weight * at.glint * u;
        patch->diffuse_log += weight * at.diffuse * lrcsi_log1p(u).hi;
    }
    patch->rounding += weight * (1 + nu_err) *
                           (at.error + at.glint * (err.glint + err.glint * err.glint + nu_err) +
                            at.diffuse * (err.diffuse + err.diffuse * err.diffuse + nu_err)) +
                       LRCSI_U * (patch->glint + patch->diffuse); /* of the additions */
    return 1;
}

/* Adds the sum over the points of both rules, times `fraction`. Sines and cosines are computed once
   for each row and column. Returns 0 if the rounding error of a point is too large. */
static int patch_add_points(const patch_frame *f, const lrcs_brdf *brdf,
                            const lrcsi_mean_rule *along, const lrcsi_mean_rule *around,
                            double fraction, lrcsi_patch *patch)
{
    double x[LRCSI_MEAN_RULE_POINTS] = {0};
    double weight[LRCSI_MEAN_RULE_POINTS] = {0};
    double azimuth[LRCSI_MEAN_RULE_POINTS][2] = {{0}};
    double column_weight[LRCSI_MEAN_RULE_POINTS] = {0};
    int columns = lrcsi_mean_rule_points(around, x, column_weight);
    for (int k = 0; k < columns; k++) {
        double phi = f->phi + x[k] * f->half;
        azimuth[k][0] = sin(phi);
        azimuth[k][1] = cos(phi);
    }
    int known = 1;
    int rows = f->step > 0 ? lrcsi_mean_rule_points(along, x, weight) : 1;
    for (int i = 0; i < rows && known; i++) {
        double sine = f->sine;
        double cosine = f->cosine;
        double row = fraction;
        double density = 1;
        if (f->step > 0) {
            double alpha = f->alpha + x[i] * f->step;
            sine = sin(alpha);
            cosine = copysign(fabs(cos(alpha)), f->cosine);
            row = fraction * weight[i];
            density = f->fourth ? sine / (cosine * cosine * cosine * cosine) : sine;
        }
        for (int k = 0; k < columns && known; k++) {
            known = patch_add_point(f, brdf, sine, cosine, azimuth[k],
                                    row * column_weight[k] * density, patch);
        }
    }
    return known;
}

/* Piece `index` of those that `level` halvings in phi and, unless the wall is straight, in alpha
   make of the patch. The four pieces of one have successive indices: the last two bits are its
   half in alpha and in phi. */
static patch_frame frame_piece(const patch_frame *whole, int level, uint32_t index)
{
    const int n = 1 << level;
    const int bits = whole->step > 0 ? 2 : 1;
    int i = 0;
    int k = 0;
    for (int at = level - 1; at >= 0; at--) {
        const uint32_t part = index >> (bits * at);
        i = 2 * i + (int)(part >> 1 & (uint32_t)(bits - 1));
        k = 2 * k + (int)(part & 1);
    }
    patch_frame f = *whole;
    f.half = whole->half / n;
    f.phi = whole->phi + (2 * k + 1 - n) * f.half;
    if (f.step > 0) {
        f.step = whole->step / n;
        f.alpha = whole->alpha + (2 * i + 1 - n) * f.step;
        f.sine = sin(f.alpha);
        f.cosine = copysign(cos(f.alpha), whole->cosine);
    }
    frame_middle(&f);
    return f;
}

/* Is a piece, whose normals differ by at most `shift`, far enough from edge-on for the rules? */
static int piece_is_slanting(const patch_frame *f, double shift)
{
    return shift < 0.25 * f->c;
}

/* F at tan^2 = u, with the weights in the middle of a piece. */
static double frame_integrand(const patch_frame *f, const lrcs_brdf *brdf, double u)
{
    const lrcsi_reflection at = lrcsi_reflect(brdf, u, 0);
    const double cosine2 = f->cosine * f->cosine;
    const double weight = f->step > 0 ? f->sine / (f->fourth ? cosine2 * cosine2 : 1) : 1;
    return weight * f->nu * (at.glint + at.diffuse);
}

/* What counts as a small remainder on a patch that may be edge-on in part: relative to F at the
   largest cosine. */
static double edge_on_target(const patch_frame *f, const lrcs_brdf *brdf, double shift)
{
    const double most = lrcsi_min(f->c + shift, f->nu) / f->nu; /* cosine */
    return EDGE_ON_TARGET * frame_integrand(f, brdf, 1 / (most * most) - 1);
}

/* An upper bound of F, with the weights, on a piece whose normals differ by at most `shift` from
   that in its middle; infinite if none is known. */
static double edge_on_bound(const patch_frame *f, const lrcs_brdf *brdf, double shift)
{
    const double nu_min = f->nu - shift;
    const double x = (f->c + shift) / nu_min; /* the largest cosine */
    const double sine = f->sine + f->step;
    const double cosine = fabs(f->cosine) - f->step;
    double weight = f->step > 0 ? sine : 1;
    if (!(nu_min > 0) || !(x < 0.5) || (f->fourth && !(cosine > 0))) {
        return HUGE_VAL;
    }
    double u = 1 / (x * x) - 1;
    if (brdf->A > 0 && !(u >= 2 * brdf->s * brdf->s)) {
        return HUGE_VAL;
    }
    weight /= f->fourth ? cosine * cosine * (cosine * cosine) : 1;
    const lrcsi_reflection at = lrcsi_reflect(brdf, u * (1 - 1e-10), 0);
    return LRCSI_OUTWARD_MICRO * weight * (f->nu + shift) * (at.glint + at.diffuse + at.error);
}

/* Chooses the rules for one piece. Returns the remainder of their product. */
static double piece_rules(const patch_frame *f, const lrcs_brdf *brdf, double target,
                          const lrcsi_mean_rule *rule[2])
{
    double along_error = 0;
    double around_error;
    rule[1] = rule_choose(f, brdf, 0, target, &around_error);
    rule[0] = f->step > 0 ? rule_choose(f, brdf, 1, target, &along_error) : &lrcsi_mean_rules[0];
    return along_error + around_error;
}

/* Adds the mean over a piece, times `fraction`, which may have been halved `level` times, and whose
   normals differ by at most `shift`. Returns 0, and adds nothing, if it is to be halved again:
   1. where all of it faces away, F is 0;
   2. where F is negligible because it is nearly edge-on, F is an error;
   3. elsewhere by rules, if their remainder is small, or the piece is not halved any further;
   4. otherwise F is an error. */
static int patch_piece_add(const patch_frame *f, const lrcs_brdf *brdf, double shift, double target,
                           double fraction, int level, lrcsi_patch *patch)
{
    if (f->c + shift <= 0) { /* 1 */
        return 1;
    }
    const int is_nearly_edge_on = !(shift < NEARLY_EDGE_ON * f->c);
    const double bound = is_nearly_edge_on ? edge_on_bound(f, brdf, shift) : HUGE_VAL;
    if (bound <= lrcsi_max(f->negligible, target)) { /* 2 */
        patch->remainder += fraction * bound;
        return 1;
    }
    const int is_smallest = level >= (is_nearly_edge_on ? EDGE_ON_LEVELS_MAX : LEVELS_MAX) ||
                            (level >= EDGE_ON_LEVELS &&
                             (f->negligible == 0 || bound <= EDGE_ON_NEGLIGIBLE * f->negligible));
    if (piece_is_slanting(f, shift)) { /* 3 */
        const lrcsi_mean_rule *rule[2];
        const lrcsi_patch before = *patch;
        const double middle = REMAINDER_TARGET * frame_integrand(f, brdf, f->u);
        const double small = lrcsi_max(lrcsi_max(middle, target), 0.5 * f->negligible);
        const double remainder = piece_rules(f, brdf, small, rule);
        if ((remainder <= 4 * small || (is_smallest && remainder < bound)) &&
            patch_add_points(f, brdf, rule[0], rule[1], fraction, patch)) {
            patch->remainder += fraction * remainder;
            return 1;
        }
        *patch = before;
    }
    if (is_smallest) { /* 4 */
        patch->remainder += fraction * bound;
    }
    return is_smallest;
}

/* Computes the mean over a patch, without the factor of area, piece by piece. Returns 0 if some of
   the patch may be edge-on. */
static int patch_add_pieces(const patch_frame *whole, const lrcs_brdf *brdf, lrcsi_patch *patch)
{
    const int bits = whole->step > 0 ? 2 : 1;
    const uint32_t last = (UINT32_C(1) << bits) - 1;
    int all_slants = 1;
    double target = 0;
    int level = 0;
    uint32_t index = 0;
    patch->glint = patch->diffuse = patch->glint_u = patch->diffuse_log = 0;
    patch->remainder = patch->rounding = 0;
    do {
        const patch_frame piece = frame_piece(whole, level, index);
        const double shift =
            normal_shift(&piece, piece.step, lrcsi_exp(piece.step), lrcsi_exp(piece.half));
        if (level == 0 && !piece_is_slanting(&piece, shift)) { /* the whole patch */
            all_slants = 0;
            target = edge_on_target(&piece, brdf, shift);
        }
        if (!patch_piece_add(&piece, brdf, shift, target, ldexp(1, -bits * level), level, patch)) {
            level++;
            index <<= bits;
            continue;
        }
        while (level > 0 && (index & last) == last) {
            level--;
            index >>= bits;
        }
        index++;
    } while (level > 0);
    return all_slants;
}

/* The mean over the patch that patch->at identifies. Returns 0 if its remainder is too large. */
static int patch_integrate(const lrcsi_view *view, const lrcs_brdf *brdf, uint32_t facet,
                           const lrcsi_patches *patches, lrcsi_patch *patch)
{
    patch_frame f;
    if (!frame_make(view, facet, patches, &f, patch)) {
        return 0;
    }
    const int all_slants = patch_add_pieces(&f, brdf, patch);
    double area_err = f.fourth ? PATCH_AREA_ERR / (fabs(f.cosine) - f.step) : PATCH_AREA_ERR;
    patch->rounding += area_err * (patch->glint + patch->diffuse);
    patch->glint *= f.area;
    patch->diffuse *= f.area;
    patch->glint_u *= f.area;
    patch->diffuse_log *= f.area;
    patch->rounding *= 1.0001 * f.area;
    patch->remainder *= 1.0001 * f.area;
    const double most = all_slants ? REMAINDER_MAX : EDGE_ON_MAX;
    return patch->remainder <=
           lrcsi_max(most * (patch->glint + patch->diffuse), patches->negligible);
}

static int same_brdf(const lrcs_brdf *a, const lrcs_brdf *b)
{
    return a->A == b->A && a->B == b->B && a->s == b->s && a->m == b->m;
}

const lrcsi_patch *lrcsi_patch_make(const lrcsi_view *view, const lrcsi_plan *plan,
                                    const lrcs_brdf *brdf, uint32_t facet, lrcsi_patches *patches)
{
    const lrcs_scene *scene = view->prepared->scene;
    const uint32_t index = scene->facet_part[facet];
    const lrcs_part *part = &scene->part[index];
    lrcsi_patch *last = &patches->last;
    lrcsi_patch made = {.part = index, .brdf = *brdf, .side = view->facing[facet]};
    if (!plan->patches || made.side == 0 || !lrcsi_patch_exists(view->prepared, facet) ||
        (brdf->A > 0 && !(brdf->s >= LRCSI_PATCH_SLOPE_MIN)) ||
        !lrcsi_tessellate_patch(&part->shape, &part->divisions, facet - part->first_facet,
                                &made.at)) {
        return NULL;
    }
    if (last->side != made.side || last->part != index || last->at.row != made.at.row ||
        last->at.sector != made.at.sector || last->at.mirrored != made.at.mirrored ||
        !same_brdf(&last->brdf, brdf)) {
        made.known = patch_integrate(view, brdf, facet, patches, &made);
        *last = made;
    }
    return last->known ? last : NULL;
}
