/* SPDX-License-Identifier: MIT */
/* Integrates the displacements of two surfaces along their contact. How a facet and a solid are
   found to be near is decided in scene/proximity_search.c, and where these fractions hold in
   visibility/proximity/proximity_band.c, whose letters P, Q, x, y and d and conditions (1) and (2)
   are used here; the symbols of sectors are those of mesh/shape/revolution_reach.c.

   1. Q is a closed part, placed without distortion, with a straight wall; g is a facet of it, in a
   sector with the half-angle h, the middle direction r, the direction a around and the axis k. With
   u, w and z along r, a and k from the axis, the wall's radius R(z) and kappa, let
       G(p) = u - kappa R(z),  T(p) = sqrt(R(z)^2 - w^2) - kappa R(z).
   G is linear, and 0 on the plane of g. Let Z be the set of the points p in the sector, |w| <=
   u tan h, not within e_P of the heights at which the wall ends. Let n_g . d be positive, and so
   large that the true normals of the sector and its neighbours face the laser as well. Then, for y
   in Z, the facets of Q hide y if and only if G(y) <= 0, and Q hides x if and only if
   G(x) <= T(x). Proof:
   - The solid of the facets has in the sector, at the height of y, the section u <= kappa R. If
     G(y) <= 0, y lies in that solid, whose facets hide it. Otherwise the ray of y leads away from
     the plane of g, behind which the solid lies.
   - x is at a height of the wall. In B the distance from the axis is at most R(z), so that x lies
     in B if and only if u <= sqrt(R^2 - w^2). If x is outside, it is in front of the plane that
     touches B along the straight line at the azimuth of x; B lies behind that plane, and the ray of
     x leads away from it. []
   So for y in Z whatever else of Q is near y does not matter, and (1) and (2) need to be considered
   only for points that are in no Z. The points of the band about g (proximity_band.c, 1.f) that are
   not in the Z of g are therefore counted as there, those in it as in 2. Each of the two facets of
   a sector has its half of Z, beside the plane through their common side and r.
   If g is on a flat face, of a box or at an end of a wall, G is the height above its plane and T is
   0; Z is the set of the points above or below g that are farther from the border of the face,
   along it, than e_P, k_Q and what the wall beside it advances or recedes by within the depth of
   the contact. The proof is the same.

   2. With the displacement D = x - y, and m the gradient of G, let E(y) = D . m - T(x). Then y is
   gained if G(y) <= 0 < G(y) + E(y), and lost if G(y) + E(y) <= 0 < G(y). Both need |G| <= |E|. In
   the plane of the facet f of y let the straight line L be where G = 0, t the position along it,
   and s the length of the component of m in the plane of f: the points with |G| <= E_max are within
   E_max / s of L. Let E change by at most q times the distance of two points. For the points of the
   convex polygon S = {y in f and Z: |G| <= E_max} with the foot y0 on L, if that is in S,
       gained: |G| <= E(y0) + eta,  lost: |G| <= -E(y0) + eta,  eta = q E_max / s.
   So the area gained is at most 1/s times the integral of max(0, E + eta) over the part of L in S,
   and E_max / s times the length along t for which S contains no point of L.

   3. On a straight wall P the map takes y = rho kappa (1, v tan h) to x = rho (cos vh, sin vh), at
   the same height (mesh/shape/revolution_reach.c, visibility/proximity/wall_displacement.c). With
   b = rho kappa v tan h and c = rho kappa, both linear along L,
       D . r = rho (cos vh - kappa) = c (1 - kappa) / kappa - (h / tan h)^2 b^2 / (2 kappa c)
   up to rho h^4 / 24. In place of c the quotient has its mean c_m, which changes it by at most the
   fraction |c - c_m| / c_m of itself, that is of rho h^2 / 2. Around, |D . a| is at most
   rho |sin vh - v kappa tan h| <= rho (h^3 / 6 + h^3 / 2) for h <= 1/2, since kappa tan h is
   mu sin h, between h - h^3 / 6 and h + h^3 / 2. Likewise
       T = R (1 - kappa) - w^2 / (2 R)
   up to R z^4 / 2, for z = |w| / R <= 1/2, with the mean of R in the quotient. What is left of E is
   a quadratic function along L.
   By the derivatives in wall_displacement.c, D changes by at most
       h^2 (1 + h) (1 + (1 + tan h) / tan h) / kappa
   times the distance in the plane of f. T changes with w by at most |w| / sqrt(R^2 - w^2), and with
   z by |R'| (1 / sqrt(1 - (w / R)^2) - kappa); w and z refer to x, which moves as y and D do. */
#include "scene/proximity_contact.h"

#include <math.h>

#include "base/constant.h"
#include "base/degrees.h"
#include "base/outward.h"
#include "base/parabola.h"
#include "base/range.h"
#include "base/vec3.h"
#include "mesh/shape/revolution.h"
#include "scene/neighbours.h"

/* Larger angles h are not used. */
#define HALF_MAX 0.5
/* Nor contacts where the radius of the wall is not larger than this many slacks: near an apex. */
#define RADIUS_OVER_SLACK 64.0
/* Nor contacts with a flat face deeper than this fraction of the smallest extent of its part. */
#define DEPTH_MAX 0.25
/* The points of a flat face must be so many slacks from its border, more beside an oblique wall. */
#define BORDER_OVER_SLACK 3.0
/* Points are considered up to so many times the distance from the plane of g within which they are
   expected to matter; contacts where they matter farther away are not used. */
#define WIDER 1.25
/* Covers the factors that the series in 3 leave out, for h <= 1/2. */
#define LARGER 1.001

enum { ZONE_PLANES = 5 };

/* Q about g. */
typedef struct contact_solid {
    int curved;            /* 0: g is on a flat face */
    double zero[3];        /* a point where G = 0 */
    double m[3], m_length; /* the gradient of G */
    double origin[3], radial[3], around[3], axis[3];
    double half, tangent, kappa;
    double radius, slope; /* R(0), R' */
    double plane[ZONE_PLANES][3], at[ZONE_PLANES][3],
        limit[ZONE_PLANES]; /* Z: where plane . (x - at) <= limit */
    int planes;
} contact_solid;

static double position_err(const lrcs_prepared *p, uint32_t part)
{
    return ldexp(p->scene->part[part].bounds.position_err, -p->exponent) + LRCSI_PROXIMITY_ERR;
}

lrcsi_contact_wall lrcsi_contact_wall_make(const lrcs_prepared *p, uint32_t facet)
{
    const lrcs_part *part = &p->scene->part[p->scene->facet_part[facet]];
    lrcsi_contact_wall wall = {.displacement = lrcsi_proximity_displacement(p, facet)};
    wall.curved = wall.displacement.reach > 0;
    wall.known = !wall.curved;
    if (wall.displacement.known && lrcsi_proximity_has_rows(p, facet)) {
        const lrcsi_revolution body = lrcsi_revolution_make(&part->shape, &part->divisions);
        wall.known = body.half <= HALF_MAX;
        double sine;
        double cosine;
        lrcsi_degrees_sincos_plain(180.0 / body.around, &sine, &cosine);
        wall.half = body.half;
        wall.tangent = sine / cosine;
        wall.kappa = body.vertex_ratio * cosine;
        const double unit = ldexp(part->unit, -p->exponent);
        wall.base = unit * body.base;
        wall.top = unit * body.top;
        wall.height = unit * body.height;
        for (int k = 0; k < 3; k++) {
            wall.origin[k] = ldexp(part->origin[k], -p->exponent);
        }
    }
    return wall;
}

static void zone_add(contact_solid *q, const double plane[3], double sign, const double at[3],
                     double limit)
{
    for (int k = 0; k < 3; k++) {
        q->plane[q->planes][k] = sign * plane[k];
        q->at[q->planes][k] = at[k];
    }
    q->limit[q->planes++] = limit;
}

/* Adds the plane through a side of g and a direction; g is behind it. */
static void zone_add_side(contact_solid *q, const double *const corner[3], int side,
                          const double along[3], double limit)
{
    const double *a = corner[side];
    double ab[3];
    double out[3];
    double inward[3];
    lrcsi_vec3_between(a, corner[(side + 1) % 3], ab);
    lrcsi_vec3_between(a, corner[(side + 2) % 3], inward);
    lrcsi_vec3_cross(ab, along, out);
    const double sign = lrcsi_vec3_dot(out, inward) > 0 ? -1 : 1;
    zone_add(q, out, sign, a, limit * sqrt(lrcsi_vec3_dot(out, out)));
}

/* Does a flat facet's face continue across a side? */
static int face_continues(const lrcs_prepared *p, uint32_t facet, int side)
{
    const uint32_t next = lrcsi_neighbour_in_part(p, facet, side);
    const lrcsi_normal *n = p->normal;
    return next != LRCS_NONE && p->scene->facet_smooth[next] == 0 &&
           lrcsi_vec3_dot(n[facet].high, n[next].high) > 0.5 * n[facet].length * n[next].length;
}

/* Makes Q about a facet of a flat face, and its zone: inside the facet, and not near the border of
   the face. Rounding turns the narrow facets at the end of a wall far more than the end: its normal
   is along the axis. */
static int face_make(const lrcs_prepared *p, uint32_t other, const double *const corner[3],
                     double slack, double err, contact_solid *q)
{
    const lrcs_part *part = &p->scene->part[p->scene->facet_part[other]];
    double oblique = 0;
    lrcsi_prepared_unit_normal(p, other, q->m);
    if (part->kind != LRCS_SHAPE_BOX) {
        const lrcsi_revolution body = lrcsi_revolution_make(&part->shape, &part->divisions);
        const double side = lrcsi_vec3_dot(part->axis[2], q->m) < 0 ? -1 : 1;
        for (int k = 0; k < 3; k++) {
            q->m[k] = side * part->axis[2][k];
        }
        oblique = fabs(body.top - body.base) / body.height;
    }
    q->m_length = 1;
    q->kappa = 1;
    for (int k = 0; k < 3; k++) {
        q->zero[k] = corner[0][k];
        zone_add_side(q, corner, k, q->m,
                      face_continues(p, other, k) ? err
                                                  : -BORDER_OVER_SLACK * slack * (1 + oblique));
    }
    return slack <= DEPTH_MAX * ldexp(part->min_extent, -p->exponent);
}

/* The zone of a sector: between its sides, below and above the ends of the wall and where this is
   narrow, and on one side of the diagonal between its two facets. The corners of the diagonal are
   at different heights and on different sides of the sector. */
static void sector_zone(contact_solid *q, const double *const corner[3], int is_cone, double height,
                        double reach, double radius_min, double err)
{
    double low = reach + err;
    double high = height - reach - err;
    double w[3];
    double z[3];
    for (int sign = -1; sign <= 1; sign += 2) {
        double side[3];
        for (int k = 0; k < 3; k++) {
            side[k] = sign * q->around[k] - q->tangent * q->radial[k];
        }
        zone_add(q, side, 1, q->origin, 2 * err);
    }
    if (q->slope < 0) {
        high = lrcsi_min(high, (q->radius - radius_min) / -q->slope);
    } else if (q->slope > 0) {
        low = lrcsi_max(low, (radius_min - q->radius) / q->slope);
    }
    zone_add(q, q->axis, 1, q->origin, high);
    zone_add(q, q->axis, -1, q->origin, -low);
    for (int k = 0; k < 3; k++) {
        double from[3];
        lrcsi_vec3_between(q->origin, corner[k], from);
        w[k] = lrcsi_vec3_dot(from, q->around);
        z[k] = lrcsi_vec3_dot(from, q->axis);
    }
    for (int k = 0; k < 3 && !is_cone && q->planes < ZONE_PLANES; k++) {
        const int next = (k + 1) % 3;
        if (w[k] * w[next] < 0 && fabs(z[k] - z[next]) > 0.5 * height) {
            zone_add_side(q, corner, k, q->radial, err);
        }
    }
}

/* Makes Q about g, given e_P. Returns 0 if it is of no kind that is known. */
static int solid_make(const lrcs_prepared *p, uint32_t other, double reach, double slack,
                      double err, contact_solid *q)
{
    const lrcs_part *part = &p->scene->part[p->scene->facet_part[other]];
    const double *const corner[3] = {lrcsi_prepared_corner(p, other, 0),
                                     lrcsi_prepared_corner(p, other, 1),
                                     lrcsi_prepared_corner(p, other, 2)};
    *q = (contact_solid){.curved = lrcsi_proximity_has_rows(p, other)};
    if (!part->rigid || !part->solid ||
        !(part->kind == LRCS_SHAPE_BOX || part->kind == LRCS_SHAPE_CYLINDER ||
          part->kind == LRCS_SHAPE_CONE || part->kind == LRCS_SHAPE_FRUSTUM)) {
        return 0;
    }
    if (!q->curved) {
        return face_make(p, other, corner, slack, err, q);
    }
    const lrcsi_contact_wall wall = lrcsi_contact_wall_make(p, other);
    q->half = wall.half;
    q->tangent = wall.tangent;
    q->kappa = wall.kappa;
    q->radius = wall.base;
    q->slope = (wall.top - wall.base) / wall.height;
    for (int k = 0; k < 3; k++) {
        q->origin[k] = wall.origin[k];
        q->radial[k] = wall.displacement.direction[0][k];
        q->axis[k] = wall.displacement.direction[1][k];
        q->around[k] = wall.displacement.direction[2][k];
        q->m[k] = q->radial[k] - q->kappa * q->slope * q->axis[k];
        q->zero[k] = q->origin[k] + q->kappa * q->radius * q->radial[k];
    }
    q->m_length = sqrt(lrcsi_vec3_dot(q->m, q->m));
    sector_zone(q, corner, part->kind == LRCS_SHAPE_CONE, wall.height, reach,
                RADIUS_OVER_SLACK * slack, err);
    return wall.known && isfinite(q->m_length);
}

/* A bound on what of a slice lies outside of Z, as a fraction of the facet. */
static double outside_fraction(const contact_solid *q, const lrcsi_slice *slice, double whole,
                               double longest)
{
    double sum = 0;
    for (int i = 0; i < q->planes && slice->count > 0; i++) {
        const double opposite[3] = {-q->plane[i][0], -q->plane[i][1], -q->plane[i][2]};
        lrcsi_slice outside = *slice;
        lrcsi_slice_cut(&outside, opposite, q->at[i], LRCSI_PROXIMITY_ERR - q->limit[i]);
        sum += lrcsi_slice_fraction(&outside, whole, longest);
    }
    return sum;
}

static double height_of(const contact_solid *q, const double x[3])
{
    double from[3];
    lrcsi_vec3_between(q->zero, x, from);
    return lrcsi_vec3_dot(q->m, from);
}

/* R at the height of a point. */
static double radius_at(const contact_solid *q, const double x[3])
{
    double from[3];
    lrcsi_vec3_between(q->origin, x, from);
    return q->radius + q->slope * lrcsi_vec3_dot(q->axis, from);
}

/* Bounds on E over the points near g: E_max, q, and how much T changes between y and x. */
typedef struct contact_range {
    double most, slope, moved;
} contact_range;

/* Makes them for the points of a slice, or nothing if its radii vary too much. */
static int contact_range_make(const contact_solid *q, const lrcsi_contact_wall *wall,
                              const lrcsi_slice *slice, double slack, double err,
                              contact_range *range)
{
    const double unit[3] = {q->m[0] / q->m_length, q->m[1] / q->m_length, q->m[2] / q->m_length};
    const double h = wall->half;
    const double t = wall->tangent;
    const double displaced =
        wall->curved ? LARGER * h * h * (1 + h) * (1 + (1 + t) / t) / wall->kappa : 0;
    double radius[2] = {HUGE_VAL, -HUGE_VAL};
    double depth[2] = {0, 0}; /* of T, above and below 0 */
    double changes = 0;       /* of T */
    for (int i = 0; i < slice->count && q->curved; i++) {
        lrcsi_range_extend(radius_at(q, slice->x[i]), &radius[0], &radius[1]);
    }
    if (q->curved) {
        const double w = q->kappa * radius[1] * q->tangent + 2 * slack;
        const double z = w / radius[0];
        const double cosine = sqrt(lrcsi_max(0, 1 - z * z));
        if (!(2 * slack <= 0.5 * q->half * radius[0]) || !(z <= 0.5)) {
            return 0;
        }
        depth[0] = lrcsi_max(0, radius[1] * (1 - q->kappa));
        depth[1] = lrcsi_max(0, radius[0] * (q->kappa - cosine));
        changes = z / cosine + fabs(q->slope) * (1 / cosine - q->kappa);
    }
    range->most = (q->m_length * lrcsi_displacement_along(&wall->displacement, unit) +
                   lrcsi_max(depth[0], depth[1]) + err) *
                  LRCSI_OUTWARD_NANO;
    range->slope = (q->m_length * displaced + changes * (1 + displaced)) * LRCSI_OUTWARD_NANO;
    range->moved = changes * wall->displacement.reach;
    return 1;
}

/* The quadratic function along L that E is without its errors, at the beginning, the middle and the
   end; a bound on these errors. */
typedef struct contact_values {
    double value[3], err;
} contact_values;

/* A linear function along L, given its ends, at such a point. */
static double linear_at(const double end[2], int i)
{
    return end[0] + 0.5 * i * (end[1] - end[0]);
}

/* Adds D . m. */
static void add_displacement(const contact_solid *q, const lrcsi_contact_wall *wall,
                             const double end[2][3], contact_values *e)
{
    const double *radial = wall->displacement.direction[0];
    const double *around = wall->displacement.direction[2];
    const double h = wall->half;
    const double kappa = wall->kappa;
    const double ratio = h / wall->tangent;
    const double out = lrcsi_vec3_dot(radial, q->m);
    const double side = lrcsi_vec3_dot(around, q->m);
    double c[2];
    double b[2];
    for (int i = 0; i < 2; i++) {
        double x[3];
        lrcsi_vec3_between(wall->origin, end[i], x);
        c[i] = lrcsi_vec3_dot(x, radial);
        b[i] = lrcsi_vec3_dot(x, around);
    }
    const double c_mean = linear_at(c, 1);
    const double rho = lrcsi_max(c[0], c[1]) / kappa;
    const double uneven = 0.5 * fabs(c[1] - c[0]) / c_mean;
    for (int i = 0; i < 3; i++) {
        const double bend = ratio * linear_at(b, i);
        e->value[i] +=
            out * (linear_at(c, i) * (1 - kappa) / kappa - bend * bend / (2 * kappa * c_mean));
    }
    e->err += LARGER * rho *
              (fabs(out) * (h * h * h * h / 24 + 0.5 * h * h * uneven) +
               fabs(side) * (h * h * h * (2.0 / 3)));
}

/* Subtracts T. */
static void subtract_outline(const contact_solid *q, const double end[2][3], contact_values *e)
{
    double radius[2];
    double w[2];
    for (int i = 0; i < 2; i++) {
        double x[3];
        lrcsi_vec3_between(q->origin, end[i], x);
        w[i] = lrcsi_vec3_dot(x, q->around);
        radius[i] = radius_at(q, end[i]);
    }
    const double mean = linear_at(radius, 1);
    const double least = lrcsi_min(radius[0], radius[1]);
    const double z = lrcsi_max(fabs(w[0]), fabs(w[1])) / least;
    const double uneven = 0.5 * fabs(radius[1] - radius[0]) / least;
    for (int i = 0; i < 3; i++) {
        const double across = linear_at(w, i);
        e->value[i] -= linear_at(radius, i) * (1 - q->kappa) - across * across / (2 * mean);
    }
    e->err +=
        LARGER * lrcsi_max(radius[0], radius[1]) * (0.5 * z * z * z * z + 0.5 * z * z * uneven);
}

/* The part of L in the polygon S: its ends, and its length; and the extent of S along it. */
typedef struct contact_line {
    double end[2][3];
    double length, extent;
} contact_line;

static contact_line contact_line_make(const contact_solid *q, const lrcsi_slice *slice,
                                      const double along[3])
{
    contact_line line = {.length = 0};
    double extent[2] = {HUGE_VAL, -HUGE_VAL};
    int found = 0;
    for (int i = 0; i < slice->count; i++) {
        const double *a = slice->x[i];
        const double *b = slice->x[(i + 1) % slice->count];
        const double ga = height_of(q, a);
        const double gb = height_of(q, b);
        lrcsi_range_extend(lrcsi_vec3_dot(a, along), &extent[0], &extent[1]);
        if ((ga <= 0) != (gb <= 0) && found < 2) {
            const double part = ga / (ga - gb);
            for (int k = 0; k < 3; k++) {
                line.end[found][k] = a[k] + part * (b[k] - a[k]);
            }
            found++;
        }
    }
    line.extent = extent[1] - extent[0];
    if (found == 2) {
        line.length = fabs(lrcsi_vec3_dot(line.end[1], along) - lrcsi_vec3_dot(line.end[0], along));
    }
    return line;
}

/* What of a facet is in Z, and has |G| <= most. */
static lrcsi_slice slice_near(const lrcs_prepared *p, uint32_t facet, const contact_solid *q,
                              double most)
{
    lrcsi_slice near =
        lrcsi_slice_start(lrcsi_prepared_corner(p, facet, 0), lrcsi_prepared_corner(p, facet, 1),
                          lrcsi_prepared_corner(p, facet, 2));
    lrcsi_slice_cut_between(&near, q->m, q->zero, q->zero, most);
    for (int i = 0; i < q->planes && near.count > 0; i++) {
        lrcsi_slice_cut(&near, q->plane[i], q->at[i], q->limit[i] + LRCSI_PROXIMITY_ERR);
    }
    return near;
}
_Static_assert(2 + ZONE_PLANES <= LRCSI_SLICE_CUTS, "room for the corners of slices");

/* The areas gained and lost in a polygon S: 2. Infinite if L has no direction in the plane of f. */
static lrcsi_contact_fractions areas_in(const lrcs_prepared *p, const contact_solid *q,
                                        const lrcsi_contact_wall *wall, uint32_t facet,
                                        const lrcsi_slice *polygon, const contact_range *range,
                                        double err)
{
    double n[3];
    double t[3];
    lrcsi_prepared_unit_normal(p, facet, n);
    lrcsi_vec3_cross(n, q->m, t);
    const double s = sqrt(lrcsi_vec3_dot(t, t));
    const double unit[3] = {t[0] / s, t[1] / s, t[2] / s};
    if (!(s > 0)) {
        return (lrcsi_contact_fractions){HUGE_VAL, HUGE_VAL};
    }
    const contact_line line = contact_line_make(q, polygon, unit);
    contact_values e = {.err = 0};
    if (line.length > 0 && wall->curved) {
        add_displacement(q, wall, line.end, &e);
    }
    if (line.length > 0 && q->curved) {
        subtract_outline(q, line.end, &e);
    }
    const double eta = range->slope * range->most / s + range->moved + e.err + 2 * err;
    const double rest =
        range->most * (lrcsi_max(0, line.extent - line.length) + 4 * LRCSI_PROXIMITY_ERR);
    return (lrcsi_contact_fractions){
        (line.length * lrcsi_parabola_positive(e.value, 1, eta) + rest) / s * LRCSI_OUTWARD_MICRO,
        (line.length * lrcsi_parabola_positive(e.value, -1, eta) + rest) / s * LRCSI_OUTWARD_MICRO};
}

/* 1. What is outside of Z; 2. the bounds on E near g; 3. the areas in Z. */
int lrcsi_contact_fractions_make(const lrcs_prepared *p, const lrcsi_contact_wall *wall,
                                 uint32_t facet, uint32_t other, double slack, double along,
                                 const lrcsi_slice *slice, lrcsi_contact_fractions *f)
{
    const uint32_t *part = p->scene->facet_part;
    const double whole = 0.5 * p->normal[facet].length;
    const double longest = lrcsi_proximity_longest(p, facet);
    const double reach = wall->displacement.reach;
    const double err = 16 * (position_err(p, part[facet]) + position_err(p, part[other]));
    contact_solid q;
    contact_range range;
    if (!wall->known || !solid_make(p, other, reach, slack, err, &q)) {
        return 0;
    }
    f->gain = f->loss = outside_fraction(&q, slice, whole, longest); /* 1 */
    const double most = WIDER * along * q.m_length;
    lrcsi_slice near = slice_near(p, facet, &q, most);
    if (near.count == 0) {
        return 1;
    }
    if (!contact_range_make(&q, wall, &near, slack, err * q.m_length, &range) || /* 2 */
        !(range.most <= most) || !(range.most * q.tangent <= slack)) {
        return 0;
    }
    near = slice_near(p, facet, &q, range.most); /* 3 */
    const double strip = lrcsi_slice_fraction(&near, whole, longest);
    const lrcsi_contact_fractions area =
        areas_in(p, &q, wall, facet, &near, &range, err * q.m_length);
    f->gain += lrcsi_min(area.gain / whole, strip); /* a NaN gives the strip */
    f->loss += lrcsi_min(area.loss / whole, strip);
    return strip < 1;
}
