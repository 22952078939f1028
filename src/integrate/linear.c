/* SPDX-License-Identifier: MIT */
/* The linear approximation l of F = f_r cos^2 over a patch of a curved wall, and bounds of second
   order in the patch's width on its error. Where it is used: integrate/tessellation.c.

   Let n be the normal of the patch's facets, t the turn vector from n to the normal N at a point of
   the patch, of length gamma, and grad F the gradient at n on the sphere of normals. Then
       F(N) = F(n) + grad F . t + R,  |R| <= gamma^2/2 second       (optics/deviation.c)
   and, since t sin(gamma)/gamma is the part of N perpendicular to n,
       |grad F . t - grad F . N| <= |grad F| (gamma - sin gamma) <= |grad F| gamma^3/6.
   With e_x, e_y and the numbers of lrcsi_profile_normals, let
       l = m + G . (y - c),   G = across (grad F . e_x) e_x + along (grad F . e_y) e_y,
   y the image of the point on the facets, c their centroid, and m the mean of F over the patch. The
   map of points to images stretches area evenly, so that G . (y - c) has mean 0 over the patch. Let
       H = F - F(n) - G . (y - c) - constant.
   With the constant that belongs to along_err,
       |H| <= gamma^2/2 second + |grad F| gamma^3/6 + |grad F . e_x| across_err
              + |grad F . e_y| along_err,
   where the mean of gamma^2 per area of the facets is at most spread^2, and across_mean replaces
   across_err in the mean. Let h = F - l; its mean is 0, and h = H - (mean of H). The integral of
   |h| is at most that of |H| plus |that of H|, and an integral of h over a region at most half of
   that: at most the integral of |H|. This is `region`. At points |h| <= |H| + |mean of H|; the
   second is at most (1 + a) region, which the caller adds to `point`.

   Areas. The facets' area differs from the patch's by at most the fraction a = area_error. Per unit
   of area of the facets the sum uses (patch area / facet area) m, but G as it is: so on the patch G
   is multiplied by a factor within a/(1 - a) of 1. That is an error of `variation` times a/(1 - a).

   A term of F whose linear part would exceed its mean, which lies on a steep flank, keeps the mean
   alone. |grad F| gamma of that term is then an error, of which the mean is at most |grad F| spread
   sqrt(1 + a) (Cauchy-Schwarz).

   In the view plane. A vector q in the plane of the facets has grad . q_xy = G . q if, with n in
   the axes of the view, grad = G_xy - G_z n_xy / n_z.

   Rounding. The unit vectors and the direction have errors of NORMAL_ERR together, and so have
   c = |cos theta| and both components of grad F, divided by dF/dc. With u = tan^2, dF/dc is
       glint (2 / (s^2 c^3) - 4 / c) + diffuse (m + 2) / c.
   u has the error du of integrate/patch.c, which changes the terms as there; `error` of
   lrcsi_reflect is added. An error of grad F counts gamma times, as N's part perpendicular to n is
   no longer. Rounding of the corners (patch->area_err is twice the angle by which it may turn the
   facets) moves a point by at most half of area_err times any altitude of the facets: by e_x and
   e_y at most area_err times `width` and `length`, and along n at most as far; there l changes by
   |G| tan theta times that, at most |G| / c. All of this, for x and c, is at most 4 area_err
   variation / c. The products with a centroid, a moment and the rotation to the view are accurate
   to 128 u |G| / c times the facets' diameter. */
#include "integrate/linear.h"

#include <math.h>

#include "base/elementary.h"
#include "base/length.h"
#include "base/range.h"

#define LINEAR_NORMAL_ERR (64 * LRCSI_U)

/* One term of F: dF/dc, a bound on its error, and its derivative in s or m. */
typedef struct linear_term {
    double slope, err, derivative;
} linear_term;

/* Returns 0 if the rounding error of F is too large. Given: c, and p = sin theta. */
static int linear_terms(const lrcs_brdf *brdf, double c, double p, linear_term *glint,
                        linear_term *diffuse)
{
    const double e = LINEAR_NORMAL_ERR;
    const double s = brdf->s;
    double u = p * p / (c * c);
    double du = 1.01 * (2 * p * e + e * e + 2 * u * c * e) / (c * c);
    lrcsi_reflection at = lrcsi_reflect(brdf, u, 0);
    double glint_err = brdf->A > 0 ? du * (2 + 1 / (s * s)) : 0;
    double diffuse_err = du * (0.5 * brdf->m + 1);
    double factor_err = 8 * e / c; /* of 1/c and 1/c^3, relative */
    if (!(glint_err <= 1 && diffuse_err <= 1 && factor_err <= 1)) {
        return 0;
    }
    double steep = brdf->A > 0 ? 2 / (s * s * c * c * c) : 0;
    double flat = (brdf->m + 2) / c;
    *glint = (linear_term){
        .slope = at.glint * (steep - 4 / c),
        .err = (steep + 4 / c) *
               (at.glint * (2 * glint_err + 2 * factor_err) + 2 * (brdf->A > 0 ? at.error : 0)),
        .derivative = brdf->A > 0 ? 2 * at.glint * (u / s / s * (steep - 4 / c) - steep) / s : 0};
    *diffuse =
        (linear_term){.slope = at.diffuse * flat,
                      .err = flat * (at.diffuse * (2 * diffuse_err + 2 * factor_err) +
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

int lrcsi_linear_make(const lrcsi_view *view, const lrcs_brdf *brdf, const lrcsi_patch *patch,
                      const lrcs_curvature *curvature, double second, lrcsi_linear *linear)
{
    const lrcs_part *part = &view->prepared->scene->part[patch->part];
    const lrcsi_wall_patch *at = &patch->at;
    lrcsi_profile profile = lrcsi_profile_make(&part->shape, &part->divisions);
    lrcsi_profile_normals normals = lrcsi_profile_normals_make(&profile, at->row);
    double unit = ldexp(part->unit, -view->prepared->exponent);
    double phi = (2.0 * at->sector + 1.0) * profile.half;
    double across[2] = {-sin(phi), cos(phi)};
    double z = at->mirrored ? -1 : 1;
    const double axis[3][3] = {
        {across[0], across[1], 0},                                                    /* e_x */
        {normals.cosine * across[1], -normals.cosine * across[0], -z * normals.sine}, /* e_y */
        {normals.sine * across[1], -normals.sine * across[0], z * normals.cosine}};   /* n */
    double e[3][3]; /* the same, axes of the view */
    for (int k = 0; k < 3; k++) {
        to_view(view, part, axis[k], e[k]);
    }

    /* 1. The gradients of both terms at n. */
    double c = patch->side * e[2][2];
    double toward[2] = {patch->side * e[0][2], patch->side * e[1][2]};
    double p = lrcsi_length_flat(toward[0], toward[1]);
    linear_term term[2];
    if (!part->rigid || !(c > 0) || !linear_terms(brdf, c, p, &term[0], &term[1])) {
        return 0;
    }

    /* 2. The bounds: first what holds for any l. */
    const double a = curvature->area_error;
    double square = curvature->rms_turn * curvature->rms_turn;
    double steepest = (fabs(term[0].slope) + term[0].err + fabs(term[1].slope) + term[1].err) *
                      (p + 2 * LINEAR_NORMAL_ERR);
    double spread = curvature->rms_turn * sqrt(1 + a); /* the mean of gamma */
    double region = 0.5 * square * second + steepest * curvature->turn * square / 6;
    double point =
        curvature->turn * curvature->turn * (0.5 * second + steepest * curvature->turn / 6);
    double err = 0; /* of the gradients */
    double kept = 0;
    const double mean[2] = {patch->glint, patch->diffuse};
    double *gradient[2] = {linear->glint, linear->diffuse};
    double *derivative[2] = {linear->glint_s, linear->diffuse_m};
    const double reach[2] = {normals.across * normals.width, fabs(normals.along) * normals.length};
    const double scale[2] = {normals.across / unit, normals.along / unit};
    for (int k = 0; k < 2; k++) {
        double slope = term[k].slope;
        double varies = fabs(slope) * (fabs(toward[0]) * reach[0] + fabs(toward[1]) * reach[1]);
        int flank = !(varies <= mean[k]);
        if (flank) {
            region += (fabs(slope) + term[k].err) * (p + 2 * LINEAR_NORMAL_ERR) * spread;
            point += (fabs(slope) + term[k].err) * (p + 2 * LINEAR_NORMAL_ERR) * curvature->turn;
            slope = 0;
        } else {
            err += term[k].err * p + (fabs(slope) + term[k].err) * (2 * LINEAR_NORMAL_ERR);
        }
        kept += slope;
        for (int j = 0; j < 2; j++) {
            const double g[2] = {toward[0] * scale[0], toward[1] * scale[1]};
            double lifted = (g[0] * e[0][2] + g[1] * e[1][2]) / e[2][2];
            double along = g[0] * e[0][j] + g[1] * e[1][j] - lifted * e[2][j];
            gradient[k][j] = slope * along;
            derivative[k][j] = flank ? 0 : term[k].derivative * along;
        }
    }

    /* 3. What the linear part adds. */
    double x = fabs(kept * toward[0]);
    double y = fabs(kept * toward[1]);
    double length = lrcsi_length_flat(x * scale[0], y * scale[1]); /* |G| */
    double diameter = (2 * normals.width + normals.length) * unit;
    linear->variation = (x * reach[0] + y * reach[1]) * (1 + 16 * LRCSI_U);
    linear->slope = lrcsi_length_flat(linear->glint[0] + linear->diffuse[0],
                                      linear->glint[1] + linear->diffuse[1]) *
                        (1 + 16 * LRCSI_U) +
                    64 * LRCSI_U * length / c;
    linear->rounding = err * curvature->turn * (1 + a) +
                       4 * patch->area_err * linear->variation / c +
                       128 * LRCSI_U * length * diameter / c;
    double area = linear->variation * (a / (1 - a));
    linear->region = region + linear->rounding +
                     (1 + a) * (x * normals.across_mean + y * normals.along_err + area);
    linear->point =
        point + linear->rounding + x * normals.across_err + y * normals.along_err + area;
    return a < 0.5 && isfinite(linear->region + linear->point + linear->slope);
}

/* The centroids of two facets are the means of their corners, whose differences are accurate; that
   of the sector is their mean, weighted by area. */
/* An upper bound of the distance of a facet's points from its centroid, in the view plane. */
static double view_extent(const lrcsi_view *view, uint32_t facet)
{
    double low[3];
    double high[3];
    lrcsi_view_bounds(view, view->prepared->scene->facet[facet].corner, 3, low, high);
    return lrcsi_length_flat(high[0] - low[0], high[1] - low[1]) * (1 + 4 * LRCSI_U);
}

lrcsi_linear_moment lrcsi_linear_moment_make(const lrcsi_view *view, uint32_t facet,
                                             const lrcsi_patch *patch, const lrcsi_visible *visible,
                                             const lrcsi_moment *moment)
{
    const lrcs_prepared *p = view->prepared;
    uint32_t begin = p->scene->part[patch->part].first_facet;
    uint32_t other = begin + ((facet - begin) ^ 1);
    lrcsi_linear_moment m = {{moment->first[0], moment->first[1]}, 1.5 * moment->error, 1};
    double most = visible->high * view_extent(view, facet);
    if (!(m.error < most)) { /* no moment is larger */
        m = (lrcsi_linear_moment){{0, 0}, most, 1};
    }
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
    double area_err = lrcsi_max(visible->high - visible->area, visible->area - visible->low);
    for (int k = 0; k < 2; k++) {
        const double *row = view->R[k];
        double centre = weight * (row[0] * apart[0] + row[1] * apart[1] + row[2] * apart[2]);
        m.first[k] -= visible->area * centre;
        m.error += fabs(centre) * area_err;
    }
    m.ratio = sum / p->normal[facet].length * (1 + 4 * LRCSI_U);
    return m;
}
