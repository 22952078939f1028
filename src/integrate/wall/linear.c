/* SPDX-License-Identifier: MIT */
/* The linear approximation l of F = f_r cos^2 over a patch of a curved wall, and bounds of second
   order in the patch's width on its error. Where it is used: integrate/wall/tessellation.c.

   Let n be the normal of the patch's facets, t the turn vector from n to the normal N at a point of
   the patch, of length gamma, and grad F the gradient at n on the sphere of normals. Then
       F(N) = F(n) + grad F . t + R,  |R| <= gamma^2/2 second       (optics/deviation.c)
   and, since t sin(gamma)/gamma is the part of N perpendicular to n,
       |grad F . t - grad F . N| <= |grad F| (gamma - sin gamma) <= |grad F| gamma^3/6.
   With e_x, e_y and the numbers of lrcsi_revolution_normals, let
       l = m + G . (y - c),   G = across (grad F . e_x) e_x + along (grad F . e_y) e_y,
   y the image of the point on the facets, c their centroid, and m the mean of F over the patch. The
   map of points to images stretches area evenly, so that G . (y - c) has mean 0 over the patch. Let
       H = F - F(n) - G . (y - c) - constant.
   With the constant that belongs to along_err,
       |H| <= gamma^2/2 second + |grad F| gamma^3/6 + |grad F . e_x| across_err
              + |grad F . e_y| along_err,
   where the mean of gamma^2 per area of the facets is at most rms_turn^2, and across_mean replaces
   across_err in the mean. Let h = F - l; its mean is 0, and h = H - (mean of H). The integral of
   |h| is at most that of |H| plus |that of H|, and an integral of h over a region at most half of
   that: at most the integral of |H|. This is `region`. At points |h| <= |H| + |mean of H|; the
   second is at most (1 + a) region, which the caller adds to `point`.

   Rows. On a straight wall l may be made for rows between two heights: over whole rows H has no
   part that is odd in x but the same as before, so that its integral over these is 0 for any
   `across`; then all of this holds for regions in the given rows, and their area.

   Areas. The facets' area differs from the patch's by at most the fraction a = area_err. Per unit
   of area of the facets the sum uses (patch area / facet area) m, but G as it is: so on the patch G
   is multiplied by a factor within a/(1 - a) of 1. That is an error of `variation` times a/(1 - a).

   A term of F whose linear part would exceed its mean, which lies on a steep flank, keeps the mean
   alone. |grad F| gamma of that term is then an error, of which the mean is at most
   |grad F| rms_turn sqrt(1 + a) (Cauchy-Schwarz).

   In the view plane. A vector q in the plane of the facets has grad . q_xy = G . q if, with n in
   the axes of the view, grad = G_xy - G_z n_xy / n_z.

   Rounding. The unit vectors and the direction have errors of LRCSI_PATCH_NORMAL_ERR together, and
   so have c = |cos theta| and both components of grad F, divided by dF/dc. With u = tan^2, dF/dc is
       glint (2 / (s^2 c^3) - 4 / c) + diffuse (m + 2) / c.
   u has the error du of integrate/wall/patch.c, which changes the terms as there; `error` of
   lrcsi_reflect is added. An error of grad F is multiplied by gamma, since the part of N
   perpendicular to n is no longer than that. Rounding of the corners (patch->area_err is twice the
   angle by which it may turn the facets) moves a point by at most half of area_err times any
   altitude of the facets: by e_x and e_y at most area_err times `width` and `length`, and along n
   at most as far; there l changes by |G| tan theta times that, at most |G| / c. All of this, for x
   and c, is at most 4 area_err variation / c. The products with a centroid, a moment and the
   rotation to the view are accurate to 128 u |G| / c times the facets' diameter. */
#include "integrate/wall/linear.h"

#include <math.h>

#include "base/elementary.h"
#include "base/length.h"
#include "base/outward.h"
#include "base/range.h"
#include "mesh/shape/revolution_normals.h"

/* One term of F: dF/dc, a bound on its error, and its derivative in s or m. */
typedef struct linear_term {
    double slope, err, derivative;
} linear_term;

/* Returns 0 if the rounding error of F is too large. Given: c, and p = sin theta. */
static int linear_terms(const lrcs_brdf *brdf, double c, double p, linear_term *glint,
                        linear_term *diffuse)
{
    const double s = brdf->s;
    double u = p * p / (c * c);
    lrcsi_reflection at = lrcsi_reflect(brdf, u, 0);
    const lrcsi_term_errors err = lrcsi_patch_term_errors(brdf, LRCSI_PATCH_NORMAL_ERR, u, c, p);
    double factor_err = 8 * LRCSI_PATCH_NORMAL_ERR / c; /* of 1/c and 1/c^3, relative */
    if (!(err.glint <= 1 && err.diffuse <= 1 && factor_err <= 1)) {
        return 0;
    }
    double steep = brdf->A > 0 ? 2 / (s * s * c * c * c) : 0;
    double flat = (brdf->m + 2) / c;
    *glint = (linear_term){
        .slope = at.glint * (steep - 4 / c),
        .err = (steep + 4 / c) *
               (at.glint * (2 * err.glint + 2 * factor_err) + 2 * (brdf->A > 0 ? at.error : 0)),
        .derivative = brdf->A > 0 ? 2 * at.glint * (u / s / s * (steep - 4 / c) - steep) / s : 0};
    *diffuse =
        (linear_term){.slope = at.diffuse * flat,
                      .err = flat * (at.diffuse * (2 * err.diffuse + 2 * factor_err) +
                                     2 * (brdf->B > 0 ? at.error : 0)),
                      .derivative = at.diffuse * (1 - 0.5 * lrcsi_log1p(u).hi * (brdf->m + 2)) / c};
    return 1;
}

/* A vector of the shape's frame in the axes of the view. */
static void to_view(const lrcsi_view *view, const lrcs_part *part, const double v[3], double out[3])
{
    double body[3];
    for (int k = 0; k < 3; k++) {
        body[k] = v[0] * part->axis[0][k] + v[1] * part->axis[1][k] + v[2] * part->axis[2][k];
    }
    for (int k = 0; k < 3; k++) {
        const double *row = view->R[k];
        out[k] = row[0] * body[0] + row[1] * body[1] + row[2] * body[2];
    }
}

/* Makes e_x, e_y and n in the axes of the view. */
static void axes_make(const lrcsi_view *view, const lrcsi_patch *patch, double half,
                      const lrcsi_revolution_normals *normals, double e[3][3])
{
    const lrcs_part *part = &view->prepared->scene->part[patch->part];
    double phi = (2.0 * patch->at.sector + 1.0) * half;
    double x = cos(phi);
    double y = sin(phi);
    double z = patch->at.mirrored ? -1 : 1;
    const double axis[3][3] = {{-y, x, 0},
                               {normals->cosine * x, normals->cosine * y, -z * normals->sine},
                               {normals->sine * x, normals->sine * y, z * normals->cosine}};
    for (int k = 0; k < 3; k++) {
        to_view(view, part, axis[k], e[k]);
    }
}

/* What is known of a patch: scaled, axes of the view. */
typedef struct linear_patch {
    double e[3][3];         /* e_x, e_y, n */
    double toward[2], c, p; /* direction to the laser: along e_x, e_y and n; sin theta */
    double scale[2];        /* across, along */
    double reach[2];        /* the largest |across x| and |along y| */
} linear_patch;

/* Fills the gradients of l and returns the sum of both terms' dF/dc as far as they vary; the bounds
   of what depends on F alone, and the error of the gradients. */
static double gradients_make(const linear_patch *at, const linear_term term[2],
                             const lrcsi_patch *patch, const lrcs_patch_bounds *bounds,
                             double second, lrcsi_linear *linear)
{
    const double mean[2] = {patch->glint, patch->diffuse};
    double *gradient[2] = {linear->glint, linear->diffuse};
    double *derivative[2] = {linear->glint_s, linear->diffuse_m};
    double across[2]; /* the gradient for dF/dc = 1 */
    double lifted =
        (at->toward[0] * at->scale[0] * at->e[0][2] + at->toward[1] * at->scale[1] * at->e[1][2]) /
        at->e[2][2];
    double steepest = 0; /* |grad F| */
    double kept = 0;
    for (int j = 0; j < 2; j++) {
        across[j] = at->toward[0] * at->scale[0] * at->e[0][j] +
                    at->toward[1] * at->scale[1] * at->e[1][j] - lifted * at->e[2][j];
    }
    linear->region = linear->point = linear->rounding = 0;
    for (int k = 0; k < 2; k++) {
        double slope = fabs(term[k].slope) + term[k].err;
        double varies =
            slope * (fabs(at->toward[0]) * at->reach[0] + fabs(at->toward[1]) * at->reach[1]);
        double turned = slope * (at->p + 2 * LRCSI_PATCH_NORMAL_ERR);
        int flank = !(varies <= mean[k]);
        steepest += turned;
        if (flank) {
            linear->region += turned * bounds->rms_turn * sqrt(1 + bounds->area_err);
            linear->point += turned * bounds->turn;
        } else {
            kept += term[k].slope;
            linear->rounding += (term[k].err * at->p + slope * (2 * LRCSI_PATCH_NORMAL_ERR)) *
                                bounds->turn * (1 + bounds->area_err);
        }
        for (int j = 0; j < 2; j++) {
            gradient[k][j] = flank ? 0 : term[k].slope * across[j];
            derivative[k][j] = flank ? 0 : term[k].derivative * across[j];
        }
    }
    double curved = 0.5 * second + steepest * bounds->turn / 6;
    linear->region += bounds->rms_turn * bounds->rms_turn * curved;
    linear->point += bounds->turn * bounds->turn * curved;
    return kept;
}

/* 1. The axes of the facets; 2. both terms' gradients; 3. what the linear part adds to the bounds.
 */
int lrcsi_linear_make(const lrcsi_view *view, const lrcs_brdf *brdf, const lrcsi_patch *patch,
                      const lrcs_patch_bounds *bounds, double second, const lrcsi_row_range *rows,
                      lrcsi_linear *linear)
{
    const lrcs_part *part = &view->prepared->scene->part[patch->part];
    const double a = bounds->area_err;
    lrcsi_revolution body = lrcsi_revolution_make(&part->shape, &part->divisions);
    lrcsi_revolution_normals normals = lrcsi_revolution_normals_make(&body, patch->at.row);
    linear->scale = 1;
    if (rows) {
        const double across = normals.across;
        normals = lrcsi_revolution_normals_between(&body, rows->low, rows->high);
        linear->scale = normals.across / across;
    }
    double unit = ldexp(part->unit, -view->prepared->exponent);
    linear_patch at = {
        .scale = {normals.across / unit, normals.along / unit},
        .reach = {normals.across * normals.width, fabs(normals.along) * normals.length}};
    linear_term term[2];
    axes_make(view, patch, body.half, &normals, at.e); /* 1 */
    at.toward[0] = patch->side * at.e[0][2];
    at.toward[1] = patch->side * at.e[1][2];
    at.c = patch->side * at.e[2][2];
    at.p = lrcsi_length_flat(at.toward[0], at.toward[1]);
    if (!part->rigid || !(a < 0.5) || !(at.c > 0) ||
        !linear_terms(brdf, at.c, at.p, &term[0], &term[1])) {
        return 0;
    }
    double kept = gradients_make(&at, term, patch, bounds, second, linear); /* 2 */

    double x = fabs(kept * at.toward[0]); /* 3 */
    double y = fabs(kept * at.toward[1]);
    double length = lrcsi_length_flat(x * at.scale[0], y * at.scale[1]); /* |G| */
    double diameter = (2 * normals.width + normals.length) * unit;
    double gradient = lrcsi_length_flat(linear->glint[0] + linear->diffuse[0],
                                        linear->glint[1] + linear->diffuse[1]);
    linear->variation = (x * at.reach[0] + y * at.reach[1]) * LRCSI_OUTWARD(16);
    linear->slope = gradient * LRCSI_OUTWARD(16) + 64 * LRCSI_U * length / at.c;
    linear->rounding +=
        4 * patch->area_err * linear->variation / at.c + 128 * LRCSI_U * length * diameter / at.c;
    double area = linear->variation * (a / (1 - a));
    linear->region +=
        linear->rounding + (1 + a) * (x * normals.across_mean + y * normals.along_err + area);
    linear->point += linear->rounding + x * normals.across_err + y * normals.along_err + area;
    return isfinite(linear->region + linear->point + linear->slope);
}

/* The centroids of two facets are the means of their corners, whose differences are accurate; that
   of the sector is their mean, weighted by area. Errors of positions are a fraction of the height
   of any facet whose moment is known: at points that they move beyond the facet, l - F_i is less
   than 2 `variation`. The area by which the distance of the centroids is multiplied has an error as
   well; the product of that distance and the gradient is at most `variation`. */
lrcsi_linear_moment lrcsi_linear_moment_make(const lrcsi_view *view, uint32_t facet,
                                             const lrcsi_patch *patch,
                                             const lrcsi_visible_area *visible,
                                             const lrcsi_moment *moment)
{
    const lrcs_prepared *p = view->prepared;
    uint32_t other = lrcsi_patch_partner(p, facet);
    lrcsi_linear_moment m = {
        {moment->first[0], moment->first[1]}, 1.5 * moment->error, 2 * moment->area_err, 1};
    if (patch->at.facets != 2 || p->skip[other]) {
        return m;
    }
    double sum = p->normal[facet].length + p->normal[other].length;
    double weight = p->normal[other].length / sum;
    double apart[3] = {0, 0, 0}; /* of the centroids */
    for (int i = 0; i < 3; i++) {
        const double *from = lrcsi_prepared_corner(p, facet, i);
        const double *to = lrcsi_prepared_corner(p, other, i);
        for (int k = 0; k < 3; k++) {
            apart[k] += (to[k] - from[k]) / 3;
        }
    }
    m.area_err += lrcsi_max(visible->high - visible->area, visible->area - visible->low);
    for (int k = 0; k < 2; k++) {
        const double *row = view->R[k];
        double centre = weight * (row[0] * apart[0] + row[1] * apart[1] + row[2] * apart[2]);
        m.first[k] -= visible->area * centre;
    }
    m.ratio = sum / p->normal[facet].length * LRCSI_OUTWARD(4);
    return m;
}
