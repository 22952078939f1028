/* SPDX-License-Identifier: MIT */
/* sigma over range. What is visible is decided in visibility/occlude.c, what a facet reflects in
   integrate/total.c; here, how a facet's visible projected area divides among bins of range, and
   what that may be off by.

   Let s be a facet's sigma per visible projected area, constant on a flat facet, and P one of the
   triangles that its visible pieces are fanned into. The computed range z~ is linear over P, from
   the computed ranges at its corners. The area of P with z~ below z has a density over z that rises
   linearly from the nearest corner to the middle one and falls to the farthest: its integral over a
   bin is a sum of at most two trapezia.

   Error of a bin, each part times the largest s:
     (1) what s may be off by: lrcsi_facet_terms;
     (2) the area D by which the pieces differ from what is visible, which may lie anywhere on the
   facet: all of it is charged to every bin that the facet reaches into;
     (3) the true range z of a point is within e of z~, so the true and the computed part of P in a
   bin differ only where z~ is within e of one of the bin's edges. There P has at most e 4 / (z2 -
   z0) of its area, z0 and z2 being its least and its largest range: the density is nowhere above
   2 / (z2 - z0). This area is charged to the bins on both sides of the edge;
     (4) rounding of the trapezia: some ten operations on terms of one sign, 16 u.
   (3) applies only to edges between bins that the facet reaches into. Those bins are found from its
   corners' ranges in double-double, so that a facet normal to the line of sight is in one bin.
     (5) Where facets stand for curved shapes, what those differ by in a bin, a point of the shape
   being within its part's reach of its place on the facet: lrcsi_tessellation_parts. Where both
   facets of a sector are seen whole and lie in one bin, reach included, what the whole patches err.
   The sum of all bins has only (1), (2), (4) and the whole patches' error.

   On a facet with curved normals s varies over P. Its range is still that of the flat facet. The
   part of P in a bin is divided, at the middle corner too, into trapezia between two lines of equal
   range, and each of these into two triangles, whose areas are the two terms of (4); s is
   integrated over them by integrate/cubature.h. (2) and (3) hold with the largest s that the
   facet's normals allow. In place of (1) stands the rounding of that sum; its corners are off by 8
   u of the triangle, their normals by twice that, which position_err has room for
   (integrate/curve.c). The cubature's own error is an estimate, and is not part of any bound.

   e: a corner's range is rounded once, 1.01 u |z|; a point of a piece is a sum of corners with
   weights that add up to 1 within 4 u and three roundings, 7 u |z|; it projects to within 100 u of
   the reach, which is tan(theta) times as much in range (visibility/target.h).
   Called: lrcsi_view_make, lrcsi_classify_make, lrcsi_occlude_make; for each facet
   lrcsi_facet_terms_make or lrcsi_curve_start, lrcsi_occlude_open, _next, _close. */
#include <lrcs/profile.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/dd.h"
#include "base/range.h"
#include "base/sum.h"
#include "base/work.h"
#include "integrate/curve.h"
#include "integrate/tessellation.h"
#include "integrate/total.h"
#include "view/frame.h"
#include "visibility/occlude.h"

#define FOUR_PI 12.566370614359172954

/* Relative error of the part of a triangle in a bin. */
#define PART_ERROR (16 * LRCSI_U)

/* Relative error of a range in double-double, for each unit of |x| + |y| + |z|: the components of
   the unit vector are accurate to 2^-97, three products and two sums add 16 u^2. */
#define RANGE_DD_ERROR 0x1p-96

/* The cubature over curved normals aims at a tenth of this, relative to what all facets with curved
   normals reflect. */
#define CURVE_TOLERANCE 1e-6

/* bound and variation hold (1) to (4) in `bound`; `bent` and `varied` are (5). */
typedef struct bin_sums {
    lrcsi_sum glint, diffuse, moment;
    double bound, bent, varied;
    double estimate; /* of the cubature's error */
} bin_sums;

/* What the bins are and hold, scaled but for bin_m. */
typedef struct profile_job {
    const lrcs_prepared *prepared;
    const lrcsi_view *view;
    lrcsi_plan plan;
    double bin_m, width; /* width: bin_m scaled */
    int64_t first;
    uint32_t count;
    bin_sums *bin;
    uint32_t low, high; /* bins low <= i < high may hold something */
    lrcsi_sum glint, diffuse;
    double bound, additions, range_err, estimate;
    lrcsi_curving how; /* of curved normals; waiting is NULL if all are flat */
    lrcsi_curve_all curves;
    lrcsi_visible *visible; /* of every facet; NULL if no facet stands for a curved shape */
    lrcsi_proximity_band margin;
    const lrcsi_proximity_band *doubt; /* margin, or NULL if none was made */
    lrcsi_patch patch;                 /* of the last facet that has one */
    int tessellation_known;
    double tessellation;
} profile_job;

/* A facet: where its corners are, which bins it reaches into, and what it reflects for each unit
   of visible projected area. */
typedef struct profile_facet {
    double range[3], range_most; /* at its corners; the largest |range| */
    double extent;               /* no two of its points are farther apart in range */
    uint32_t first, last;
    double glint, diffuse, rounding; /* of a flat facet */
    double most;                     /* no less than its true sigma anywhere */
    lrcsi_curve_facet *curve;        /* NULL: its normals are not curved */
} profile_facet;

/* --- bins ------------------------------------------------------------------------------------- */

static double edge_of(const profile_job *job, uint32_t i)
{
    return ldexp((double)(job->first + i) * job->bin_m, -job->prepared->exponent);
}

static double centre_of(const profile_job *job, uint32_t i)
{
    return ldexp(((double)(job->first + i) + 0.5) * job->bin_m, -job->prepared->exponent);
}

/* The bin of a range, the nearest one for a range beyond all. The quotient is off by a few units in
   its last place, at most one bin. */
static uint32_t bin_of(const profile_job *job, double range)
{
    double k = floor(range / job->width) - (double)job->first;
    uint32_t i = k <= 0 ? 0 : k >= job->count ? job->count - 1 : (uint32_t)k;
    while (i > 0 && edge_of(job, i) > range) {
        i--;
    }
    while (i + 1 < job->count && edge_of(job, i + 1) <= range) {
        i++;
    }
    return i;
}

static uint32_t bin_within(const profile_job *job, const profile_facet *f, double range)
{
    uint32_t i = bin_of(job, range);
    return i < f->first ? f->first : i > f->last ? f->last : i;
}

/* Adds a part of sigma, with its first moment about the bin's centre and its error. */
static void bin_add(profile_job *job, uint32_t i, double glint, double diffuse, double moment,
                    double rounding)
{
    bin_sums *bin = &job->bin[i];
    lrcsi_sum_add(&bin->glint, glint);
    lrcsi_sum_add(&bin->diffuse, diffuse);
    lrcsi_sum_add(&bin->moment, moment);
    lrcsi_sum_add(&job->glint, glint);
    lrcsi_sum_add(&job->diffuse, diffuse);
    bin->bound += rounding + LRCSI_FACET_UNDERFLOW;
    job->bound += rounding + LRCSI_FACET_UNDERFLOW;
    job->additions++;
}

/* Adds a projected area of a flat facet, with its first moment about the bin's centre. */
static void bin_add_flat(profile_job *job, const profile_facet *f, uint32_t i, double area,
                         double moment)
{
    bin_add(job, i, f->glint * area, f->diffuse * area, (f->glint + f->diffuse) * moment,
            f->rounding * area + f->most * PART_ERROR * area);
}

/* Adds a triangle with curved normals that lies in one bin: its projected area, and the ranges and
   normals at its corners. */
static void bin_add_curved(profile_job *job, const profile_facet *f, uint32_t i, double area,
                           const double range[3], const double normal[3][3])
{
    double centre = centre_of(job, i);
    const double weight[3] = {range[0] - centre, range[1] - centre, range[2] - centre};
    lrcsi_cubature sum = f->curve->sum;
    sum.whole = area;
    sum.weight = weight;
    lrcsi_cubature_add(&sum, normal, area);
    double glint = FOUR_PI * lrcsi_sum_value(&sum.glint);
    double diffuse = FOUR_PI * lrcsi_sum_value(&sum.diffuse);
    double relative = f->curve->incidence.error + 16 * LRCSI_U + PART_ERROR;
    bin_add(job, i, glint, diffuse, FOUR_PI * lrcsi_sum_value(&sum.weighted),
            FOUR_PI * (sum.rounding + sum.left) + relative * (glint + diffuse));
    job->bin[i].estimate += FOUR_PI * sum.estimate;
    job->estimate += FOUR_PI * sum.estimate;
}

/* --- ranges ----------------------------------------------------------------------------------- */

/* The range of a scene point. Along an axis it is exact, and *err is 0. */
static lrcsi_dd range_of(const lrcsi_view *view, const double x[3], double *err)
{
    const double *d = view->direction;
    lrcsi_dd sum = {0, 0};
    double size = 0;
    for (int k = 0; k < 3; k++) {
        if (d[(k + 1) % 3] == 0 && d[(k + 2) % 3] == 0) {
            *err = 0;
            return (lrcsi_dd){d[k] > 0 ? -x[k] : x[k], 0};
        }
        lrcsi_dd unit = {-view->unit[k], -view->unit_low[k]};
        sum = lrcsi_dd_add(sum, lrcsi_dd_scale(unit, x[k]));
        size += fabs(x[k]);
    }
    *err = RANGE_DD_ERROR * size;
    return sum;
}

/* The bins that the range of a corner may be in: two where it cannot be distinguished from their
 * edge. */
static void corner_bins(const profile_job *job, lrcsi_dd range, double err, uint32_t *low,
                        uint32_t *high)
{
    *low = *high = bin_of(job, lrcsi_dd_value(range));
    double below = lrcsi_dd_value(lrcsi_dd_sub(range, (lrcsi_dd){edge_of(job, *low), 0}));
    double above = lrcsi_dd_value(lrcsi_dd_sub(range, (lrcsi_dd){edge_of(job, *high + 1), 0}));
    if (*low > 0 && below < 2 * err) {
        *low -= 1;
        *high -= err == 0 || below < -2 * err ? 1 : 0;
    } else if (*high + 1 < job->count && above >= -2 * err) {
        *high += 1;
        *low += err == 0 || above > 2 * err ? 1 : 0;
    }
}

static void facet_ranges(const profile_job *job, uint32_t facet, profile_facet *f)
{
    f->first = job->count;
    f->last = 0;
    f->range_most = 0;
    for (int k = 0; k < 3; k++) {
        double err;
        uint32_t low;
        uint32_t high;
        lrcsi_dd range = range_of(job->view, lrcsi_prepared_corner(job->prepared, facet, k), &err);
        corner_bins(job, range, err, &low, &high);
        f->range[k] = lrcsi_dd_value(range);
        f->range_most = lrcsi_most(f->range_most, fabs(f->range[k]));
        f->first = low < f->first ? low : f->first;
        f->last = high > f->last ? high : f->last;
    }
    const double *z = f->range;
    f->extent = lrcsi_most(z[0], lrcsi_most(z[1], z[2])) -
                lrcsi_least(z[0], lrcsi_least(z[1], z[2])) + 8 * LRCSI_U * f->range_most;
}

/* --- one triangle ----------------------------------------------------------------------------- */

/* A triangle of a piece: its area, the ranges of its corners in ascending order, and the normals
   there, which a flat facet does not need. */
typedef struct profile_triangle {
    double area, z[3];
    const double *normal[3];
} profile_triangle;

static void swap_up(profile_triangle *t, int a, int b)
{
    if (t->z[b] < t->z[a]) {
        double z = t->z[a];
        const double *normal = t->normal[a];
        t->z[a] = t->z[b];
        t->normal[a] = t->normal[b];
        t->z[b] = z;
        t->normal[b] = normal;
    }
}

static profile_triangle triangle_of(double area, const double range[3], const double (*normal)[3])
{
    profile_triangle t = {area, {range[0], range[1], range[2]}, {NULL, NULL, NULL}};
    for (int k = 0; k < 3 && normal; k++) {
        t.normal[k] = normal[k];
    }
    swap_up(&t, 0, 1);
    swap_up(&t, 1, 2);
    swap_up(&t, 0, 1);
    return t;
}

/* The area and moment about `centre` of what lies between two ranges on one side of the middle
   corner. The density is that at the middle corner times a share that is linear between the ends.
 */
static void part_add(const profile_triangle *t, double from, double to, double centre, double *area,
                     double *moment)
{
    if (!(from < to)) {
        return;
    }
    int rising = to <= t->z[1];
    double length = rising ? t->z[1] - t->z[0] : t->z[2] - t->z[1];
    double first = (rising ? from - t->z[0] : t->z[2] - from) / length;
    double last = (rising ? to - t->z[0] : t->z[2] - to) / length;
    double scale = t->area / (t->z[2] - t->z[0]) * (to - from);
    double half = 0.5 * (to - from);
    double part = scale * (first + last);
    *area += part;
    *moment +=
        part * (0.5 * (from - centre) + 0.5 * (to - centre)) + scale * (last - first) * half / 3;
}

/* The normal where the side between two corners has a range. */
static void normal_at(const profile_triangle *t, int a, int b, double range, double normal[3])
{
    double share = t->z[a] < t->z[b] ? (range - t->z[a]) / (t->z[b] - t->z[a]) : 0;
    for (int k = 0; k < 3; k++) {
        normal[k] = (1 - share) * t->normal[a][k] + share * t->normal[b][k];
    }
}

/* What lies between two ranges on one side of the middle corner, with curved normals: a trapezium
   between a point of the long side and one of a short side at either range. A diagonal divides it
   into triangles over its two parallel sides, whose areas are the terms of part_add. */
static void part_add_curved(profile_job *job, const profile_facet *f, const profile_triangle *t,
                            uint32_t bin, double from, double to)
{
    if (!(from < to)) {
        return;
    }
    int rising = to <= t->z[1];
    int a = rising ? 0 : 1; /* the ends of the short side */
    int b = rising ? 1 : 2;
    double length = t->z[b] - t->z[a];
    double scale = t->area / (t->z[2] - t->z[0]) * (to - from);
    double first = (rising ? from - t->z[0] : t->z[2] - from) / length;
    double last = (rising ? to - t->z[0] : t->z[2] - to) / length;
    const double range[2][3] = {{from, from, to}, {from, to, to}};
    double normal[4][3]; /* at `from` on the long side, on the short one; at `to` likewise */
    normal_at(t, 0, 2, from, normal[0]);
    normal_at(t, a, b, from, normal[1]);
    normal_at(t, 0, 2, to, normal[2]);
    normal_at(t, a, b, to, normal[3]);
    bin_add_curved(job, f, bin, scale * first, range[0], (const double(*)[3])normal);
    bin_add_curved(job, f, bin, scale * last, range[1], (const double(*)[3])(normal + 1));
}

/* (3): edges that some of the triangle may lie on the other side of. */
static void edges_charge(profile_job *job, const profile_facet *f, const profile_triangle *t,
                         double range_err)
{
    double extent = t->z[2] - t->z[0];
    double charge =
        f->most * t->area * (4 * range_err < extent ? lrcsi_least(1, 4 * range_err / extent) : 1);
    uint32_t begin = bin_within(job, f, t->z[0] - range_err);
    uint32_t end = bin_within(job, f, t->z[2] + range_err);
    for (uint32_t i = begin + 1; i <= end; i++) {
        job->bin[i - 1].bound += charge;
        job->bin[i].bound += charge;
        job->additions++;
    }
    job->range_err = lrcsi_most(job->range_err, lrcsi_least(range_err, f->extent));
}

/* A triangle in one bin. */
static void whole_add(profile_job *job, const profile_facet *f, const profile_triangle *t,
                      uint32_t bin)
{
    double centre = centre_of(job, bin);
    double mean = ((t->z[0] - centre) + (t->z[1] - centre) + (t->z[2] - centre)) / 3;
    double normal[3][3];
    if (!f->curve) {
        bin_add_flat(job, f, bin, t->area, t->area * mean);
        return;
    }
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            normal[i][k] = t->normal[i][k];
        }
    }
    bin_add_curved(job, f, bin, t->area, t->z, (const double(*)[3])normal);
}

/* Adds a triangle whose corners' ranges are known to within range_err; with its normals there if
   they are curved, else NULL. */
static void triangle_add(profile_job *job, const profile_facet *f, double area,
                         const double range[3], const double (*normal)[3], double range_err)
{
    profile_triangle t = triangle_of(area, range, normal);
    uint32_t begin = bin_within(job, f, t.z[0]);
    uint32_t end = bin_within(job, f, t.z[2]);
    if (begin == end) {
        whole_add(job, f, &t, begin);
    }
    for (uint32_t i = begin; begin < end && i <= end; i++) {
        double from = i == begin ? t.z[0] : edge_of(job, i);
        double to = i == end ? t.z[2] : edge_of(job, i + 1);
        double middle = lrcsi_least(to, lrcsi_most(from, t.z[1]));
        double part = 0;
        double moment = 0;
        if (f->curve) {
            part_add_curved(job, f, &t, i, from, middle);
            part_add_curved(job, f, &t, i, middle, to);
            continue;
        }
        part_add(&t, from, middle, centre_of(job, i), &part, &moment);
        part_add(&t, middle, to, centre_of(job, i), &part, &moment);
        bin_add_flat(job, f, i, part, moment);
    }
    edges_charge(job, f, &t, range_err);
}

/* --- one facet -------------------------------------------------------------------------------- */

/* A piece, fanned from its first corner. Returns what its area may be off by. */
static double fan_add(profile_job *job, const profile_facet *f, const lrcsi_target *target,
                      const lrcsi_clip_polygon *piece, double range_err)
{
    double range[3] = {0, 0, 0}; /* of corners 0, i - 1, i */
    double normal[3][3];         /* likewise */
    double off = 0;
    for (uint32_t i = 0; i < piece->count; i++) {
        double weight[3];
        lrcsi_target_weights(target, piece->corner[i], weight);
        range[i < 2 ? i : 2] =
            weight[0] * f->range[0] + weight[1] * f->range[1] + weight[2] * f->range[2];
        for (int k = 0; k < 3 && f->curve; k++) {
            const double(*n)[3] = (const double(*)[3])f->curve->normal;
            normal[i < 2 ? i : 2][k] =
                weight[0] * n[0][k] + weight[1] * n[1][k] + weight[2] * n[2][k];
        }
        if (i < 2) {
            continue;
        }
        const double *c = piece->corner[0];
        const double u[2] = {piece->corner[i - 1][0] - c[0], piece->corner[i - 1][1] - c[1]};
        const double v[2] = {piece->corner[i][0] - c[0], piece->corner[i][1] - c[1]};
        double area = 0.5 * (u[0] * v[1] - u[1] * v[0]);
        if (area > 0) {
            triangle_add(job, f, area, range, f->curve ? (const double(*)[3])normal : NULL,
                         range_err);
        }
        off += lrcsi_most(0, -area) + 4 * LRCSI_U * (fabs(u[0] * v[1]) + fabs(u[1] * v[0]));
        range[1] = range[2];
        for (int k = 0; k < 3 && f->curve; k++) {
            normal[1][k] = normal[2][k];
        }
    }
    return off;
}

/* Returns the area D of the comment above, and adds what is known to be visible. On a surface that
   is convex by construction fronts are visible without clipping, but for the grazing ones. */
static double pieces_add(profile_job *job, const profile_facet *f, uint32_t facet,
                         const lrcsi_incidence *incidence, lrcsi_occluding *o)
{
    double rounded = 2 * LRCSI_U * f->range_most;
    const double(*normal)[3] = f->curve ? (const double(*)[3])f->curve->normal : NULL;
    if (job->plan.unshadowed && job->view->facing[facet] > 0) {
        lrcsi_visible known = lrcsi_visible_unshadowed(incidence, job->plan.grazing_cos);
        triangle_add(job, f, known.area, f->range, normal, rounded);
        if (job->visible) {
            job->visible[facet] = known;
        }
        return known.high - known.low;
    }
    double off = 0;
    lrcsi_occlude_open(o, facet);
    if (f->curve && o->undecided) {
        f->curve->sum.position_err = lrcsi_curve_position_err(f->curve, &o->alone.target);
    }
    while (lrcsi_occlude_next(o)) {
        const lrcsi_target *target = &o->alone.target;
        double slope = sqrt(incidence->tan2) * (1 + incidence->tan2_err);
        double range_err = 9 * LRCSI_U * f->range_most + 101 * LRCSI_U * target->reach * slope;
        if (o->undecided) {
            off += fan_add(job, f, target, &o->alone.piece, range_err);
        } else {
            triangle_add(job, f, incidence->projected, f->range, normal, rounded);
        }
    }
    lrcsi_visible visible = lrcsi_occlude_close(o);
    if (o->undecided) {
        const lrcsi_target *target = &o->alone.target;
        off += 20 * LRCSI_U * target->reach * target->perimeter + o->alone.bent;
    }
    if (job->prepared->solid && job->view->facing[facet] < 0) {
        visible.low = 0;
    }
    if (job->visible) {
        job->visible[facet] = visible;
    }
    return visible.high - visible.low + off;
}

static void facet_profile(profile_job *job, uint32_t facet, lrcsi_occluding *o)
{
    lrcsi_incidence incidence = lrcsi_view_incidence(job->view, facet);
    lrcsi_visible whole = {incidence.projected, incidence.projected, incidence.projected, 0, 0};
    lrcsi_curve_facet curve;
    profile_facet f = {.curve = NULL};
    double before = lrcsi_sum_value(&job->glint) + lrcsi_sum_value(&job->diffuse);
    if (lrcsi_curve_wanted(job->view, facet)) {
        lrcsi_curve_start(&job->curves, facet, &curve);
        f.curve = &curve;
        f.most = FOUR_PI * lrcsi_curve_most(&curve) * (1 + incidence.error);
    } else {
        lrcsi_facet_terms terms =
            lrcsi_facet_terms_make(job->view, &job->plan, facet, &incidence, &whole, &job->patch);
        f.glint = terms.glint / incidence.projected;
        f.diffuse = terms.diffuse / incidence.projected;
        f.rounding = terms.rounding / incidence.projected;
        f.most = f.glint + f.diffuse + f.rounding;
    }
    facet_ranges(job, facet, &f);
    double additions = job->additions;
    double doubt = pieces_add(job, &f, facet, &incidence, o);
    for (uint32_t i = f.first; doubt > 0 && i <= f.last; i++) {
        job->bin[i].bound += f.most * doubt;
        job->additions++;
    }
    job->bound += f.most * doubt;
    if (f.curve) {
        lrcsi_curve_have(&job->curves,
                         lrcsi_sum_value(&job->glint) + lrcsi_sum_value(&job->diffuse) - before);
    }
    if (job->additions > additions) {
        job->low = f.first < job->low ? f.first : job->low;
        job->high = f.last + 1 > job->high ? f.last + 1 : job->high;
    }
}

/* --- curved shapes ---------------------------------------------------------------------------- */

/* The share of a triangle's area with a range below z, from its corners' in ascending order. */
static double share_below(const double corner[3], double z)
{
    double extent = corner[2] - corner[0];
    if (z <= corner[0]) {
        return 0;
    }
    if (z >= corner[2]) {
        return 1;
    }
    return z < corner[1]
               ? (z - corner[0]) / (corner[1] - corner[0]) * ((z - corner[0]) / extent)
               : 1 - (corner[2] - z) / (corner[2] - corner[1]) * ((corner[2] - z) / extent);
}

/* An upper bound of the share with a range between two: (4) of each end. */
static double share_between(const double corner[3], double from, double to)
{
    double share = share_below(corner, to) - share_below(corner, from) + 2 * PART_ERROR;
    return to < corner[0] || from > corner[2] ? 0 : lrcsi_least(1, share);
}

/* The reach of a facet's part, with what its corners' ranges are off by. */
static double reach_of(const profile_job *job, uint32_t facet, const profile_facet *f)
{
    const lrcs_scene *scene = job->prepared->scene;
    double reach = scene->part[scene->facet_part[facet]].reach;
    return ldexp(reach, -job->prepared->exponent) * (1 + 4 * LRCSI_U) + 8 * LRCSI_U * f->range_most;
}

/* (5) of one facet, in the bins that it or its partner reaches into. Of two numbers >= 0 the
   difference is at most the larger one; what weighs them by range may make it their sum. */
static void bent_charge(profile_job *job, uint32_t facet)
{
    profile_facet f;
    profile_facet other;
    lrcsi_incidence incidence = lrcsi_view_incidence(job->view, facet);
    lrcsi_patch_parts parts = lrcsi_tessellation_parts(job->view, &job->plan, facet, &incidence,
                                                       job->visible, job->doubt, &job->patch);
    facet_ranges(job, facet, &f);
    facet_ranges(job, parts.partner, &other);
    double reach = reach_of(job, facet, &f);
    profile_triangle t = triangle_of(1, f.range, NULL);
    double low = lrcsi_least(
        t.z[0], lrcsi_least(other.range[0], lrcsi_least(other.range[1], other.range[2])));
    double high =
        lrcsi_most(t.z[2], lrcsi_most(other.range[0], lrcsi_most(other.range[1], other.range[2])));
    uint32_t begin = bin_of(job, low - reach);
    uint32_t end = bin_of(job, high + reach);
    double whole = FOUR_PI * parts.whole;
    job->tessellation += whole;
    if (!(whole > 0) && !(parts.lit && reach > 0 && parts.shift > 0)) {
        return;
    }
    job->range_err = lrcsi_most(job->range_err, reach);
    for (uint32_t i = begin; i <= end; i++) {
        double from = edge_of(job, i);
        double to = edge_of(job, i + 1);
        double share = share_between(t.z, from - reach, to + reach);
        double shifted = share_between(t.z, from - reach, from + reach) +
                         share_between(t.z, to - reach, to + reach) + parts.share;
        double general = FOUR_PI * (parts.bend * share + parts.shift * shifted);
        double most = parts.lit ? FOUR_PI * parts.most * share : whole;
        general = parts.lit ? general : HUGE_VAL;
        job->bin[i].varied += lrcsi_least(general, 2 * most);
        job->bin[i].bent += begin == end ? whole : lrcsi_least(general, most);
        job->additions++;
    }
    job->low = begin < job->low ? begin : job->low;
    job->high = end + 1 > job->high ? end + 1 : job->high;
}

/* --- all facets ------------------------------------------------------------------------------- */

/* The largest reach of a part, m. */
static double reach_most(const lrcs_prepared *prepared)
{
    double most = 0;
    for (uint32_t i = 0; i < prepared->scene->part_count; i++) {
        most = lrcsi_most(most, prepared->scene->part[i].reach);
    }
    return most;
}

/* Bins that a scene may take in any pose. */
static size_t bins_room(const lrcs_prepared *prepared, double bin_m)
{
    double depth = ldexp(2 * 1.7320508075688774 * prepared->radius, prepared->exponent) +
                   2 * reach_most(prepared);
    double bins = depth / bin_m + 4;
    return bins < LRCS_PROFILE_BINS ? (size_t)bins + 1 : (size_t)LRCS_PROFILE_BINS + 4;
}

size_t lrcs_profile_need(const lrcs_prepared *prepared, double bin_m)
{
    size_t bins = bins_room(prepared, bin_m);
    size_t need = lrcsi_work_bytes(bins, sizeof(lrcs_profile_bin));
    need = lrcsi_work_add(need, lrcsi_work_bytes(bins, sizeof(bin_sums)));
    need = lrcsi_work_add(need, lrcsi_view_need(prepared));
    need = lrcsi_work_add(need, lrcsi_classify_need(prepared));
    need = lrcsi_work_add(need, prepared->smooth ? lrcsi_cubature_need() : 0);
    if (prepared->curved) {
        size_t facets = prepared->scene->facet_count;
        need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_visible)));
        need = lrcsi_work_add(need, lrcsi_proximity_band_need(prepared));
    }
    return lrcsi_work_add(need, lrcsi_occlude_need(prepared));
}

/* Numbers the bins from one before the nearest point to one beyond the farthest. */
static int bins_number(profile_job *job)
{
    const lrcs_prepared *p = job->prepared;
    double least = HUGE_VAL;
    double most = -HUGE_VAL;
    for (uint32_t v = 0; v < p->scene->vertex_count; v++) {
        double err;
        if (p->referenced[v]) {
            double range = lrcsi_dd_value(range_of(job->view, p->vertex[v].x, &err));
            least = lrcsi_least(least, range);
            most = lrcsi_most(most, range);
        }
    }
    if (!(least <= most)) {
        return LRCS_OK;
    }
    double reach = ldexp(reach_most(p), -p->exponent);
    double first = floor((least - reach) / job->width) - 1;
    double last = floor((most + reach) / job->width) + 1;
    if (!(first >= -LRCS_PROFILE_INDEX && last <= LRCS_PROFILE_INDEX &&
          last - first < LRCS_PROFILE_BINS)) {
        return LRCS_E_LIMIT;
    }
    job->first = (int64_t)first;
    job->count = (uint32_t)(last - first) + 1;
    return LRCS_OK;
}

/* What is needed to know how far curved shapes are from their facets, as in integrate/sigma.c. */
static int curved_make(profile_job *job, const lrcsi_classification *classification,
                       lrcs_work *work)
{
    const lrcs_prepared *p = job->prepared;
    job->tessellation_known = 1;
    if (!p->curved) {
        return LRCS_OK;
    }
    job->visible = lrcsi_work_take_zero(work, p->scene->facet_count, sizeof *job->visible);
    int status = job->visible ? LRCS_OK : LRCS_E_MEMORY;
    if (status == LRCS_OK && p->proximity.reach && (job->view->backs_cast || p->solid)) {
        status = lrcsi_proximity_band_make(classification, work, &job->margin);
        job->doubt = &job->margin;
    }
    job->tessellation_known =
        lrcsi_tessellation_known(p, job->plan.unshadowed) && (job->plan.unshadowed || job->doubt);
    return status;
}

/* Prepares the integrals over curved normals. */
static int smooth_make(profile_job *job, lrcs_work *work)
{
    if (!job->prepared->smooth) {
        return LRCS_OK;
    }
    job->how = (lrcsi_curving){&job->plan, CURVE_TOLERANCE, lrcsi_cubature_cells(work), 0};
    if (!job->how.waiting) {
        return LRCS_E_MEMORY;
    }
    job->curves = lrcsi_curve_all_make(job->view, &job->how);
    return LRCS_OK;
}

/* 1. The view, and which facets are undecided. 2. The bins. 3. Every facet that reflects. 4. What
   curved shapes may differ by. */
static int profile_sum(profile_job *job, lrcsi_view *view, const lrcs_pose *pose, lrcs_work *work)
{
    const lrcs_prepared *p = job->prepared;
    const lrcs_run_options options = {.method = LRCS_METHOD_EXACT};
    const lrcsi_clear clear = {0};
    lrcsi_classification classification;
    lrcsi_occluding o;
    int status = lrcsi_view_make(p, pose, work, view);
    if (status != LRCS_OK) {
        return status;
    }
    const lrcsi_plan_sides backs = lrcsi_plan_backs(p, &options);
    view->backs_cast = backs.cast;
    view->backs_reflect = backs.reflect;
    job->view = view;
    job->plan = lrcsi_plan_make(view, &clear, &options);
    status = bins_number(job);
    if (status == LRCS_OK) {
        job->bin = lrcsi_work_take_zero(work, job->count, sizeof *job->bin);
        job->low = job->count;
        status = job->bin ? lrcsi_classify_make(view, work, &classification) : LRCS_E_MEMORY;
    }
    status = status == LRCS_OK ? curved_make(job, &classification, work) : status;
    status = status == LRCS_OK ? smooth_make(job, work) : status;
    status = status == LRCS_OK ? lrcsi_occlude_make(&classification, work, &o) : status;
    for (uint32_t facet = 0; facet < p->scene->facet_count && status == LRCS_OK; facet++) {
        if (view->facing[facet] != 0 && lrcsi_view_reflects(view, facet) &&
            lrcsi_grid_casts(view, facet)) {
            facet_profile(job, facet, &o);
        }
    }
    if (status != LRCS_OK || !p->curved || !job->tessellation_known) {
        return status;
    }
    if (job->doubt) {
        lrcsi_proximity_band_settle(job->doubt, job->visible);
    }
    for (uint32_t facet = 0; facet < p->scene->facet_count; facet++) {
        if (!p->skip[facet]) {
            bent_charge(job, facet);
        }
    }
    return status;
}

/* To square metres, rounded outward: the sums' own errors join the bounds. */
static void profile_finish(const profile_job *job, lrcs_profile *profile)
{
    const lrcs_prepared *p = job->prepared;
    double count = job->additions;
    double outward = 1 + 1e-9 + 2 * count * LRCSI_U;
    double adding = 4 * LRCSI_U + 3 * (count * LRCSI_U) * (count * LRCSI_U);
    for (uint32_t i = 0; i < profile->count; i++) {
        const bin_sums *sums = &job->bin[job->low + i];
        double glint = lrcsi_sum_value(&sums->glint);
        double diffuse = lrcsi_sum_value(&sums->diffuse);
        double moment = lrcsi_prepared_area(p, lrcsi_sum_value(&sums->moment));
        profile->bin[i] = (lrcs_profile_bin){
            lrcsi_prepared_area(p, glint),
            lrcsi_prepared_area(p, diffuse),
            lrcsi_bound_area(p, (sums->bound + sums->bent + (glint + diffuse) * adding) * outward),
            lrcsi_bound_area(p,
                             (sums->bound + sums->varied + (glint + diffuse) * adding) * outward),
            p->smooth ? lrcsi_bound_area(p, sums->estimate * outward) : 0,
            ldexp(moment, p->exponent)};
        if (profile->bin[i].variation_m2 < profile->bin[i].bound_m2) {
            profile->bin[i].variation_m2 = profile->bin[i].bound_m2;
        }
    }
    double glint = lrcsi_sum_value(&job->glint);
    double diffuse = lrcsi_sum_value(&job->diffuse);
    profile->bin_m = job->bin_m;
    profile->first = profile->count > 0 ? job->first + job->low : 0;
    profile->sigma_glint_m2 = lrcsi_prepared_area(p, glint);
    profile->sigma_diffuse_m2 = lrcsi_prepared_area(p, diffuse);
    profile->bound_m2 = lrcsi_bound_area(
        p, (job->bound + job->tessellation + (glint + diffuse) * adding) * outward);
    profile->curvature_estimate_m2 = p->smooth ? lrcsi_bound_area(p, job->estimate * outward) : -1;
    profile->tessellation_known = job->tessellation_known;
    profile->range_err_m = ldexp(job->range_err, p->exponent);
}

int lrcs_profile_run(const lrcs_prepared *prepared, const lrcs_pose *pose, double bin_m,
                     lrcs_work *work, lrcs_profile *profile)
{
    size_t mark = work->used;
    lrcsi_view view;
    lrcs_profile result = {0};
    profile_job job = {.prepared = prepared, .bin_m = bin_m};
    job.width = ldexp(bin_m, -prepared->exponent);
    if (!(bin_m > 0 && bin_m <= DBL_MAX) || !(job.width >= DBL_MIN && job.width <= DBL_MAX)) {
        return LRCS_E_ARGUMENT;
    }
    int status = profile_sum(&job, &view, pose, work);
    if (status == LRCS_OK) {
        result.count = job.low < job.high ? job.high - job.low : 0;
        result.bin = lrcsi_work_take(work, result.count, sizeof *result.bin);
        status = result.bin ? LRCS_OK : LRCS_E_MEMORY;
    }
    if (status == LRCS_OK) {
        profile_finish(&job, &result);
        status = isfinite(result.sigma_glint_m2 + result.sigma_diffuse_m2 + result.bound_m2)
                     ? LRCS_OK
                     : LRCS_E_NUMBER;
    }
    work->used = mark;
    if (status == LRCS_OK) { /* the bins sink to the bottom */
        lrcs_profile_bin *bin = lrcsi_work_take(work, result.count, sizeof *bin);
        memmove(bin, result.bin, result.count * sizeof *bin);
        result.bin = bin;
        *profile = result;
    }
    return status;
}

/* --- a pulse ---------------------------------------------------------------------------------- */

/* So many standard deviations from its peak the pulse counts as 0, and e^-72 of it as the error. */
#define PULSE_FAR      12.0
#define PULSE_FAR_LEFT 5.4e-32 /* above e^-72 */

/* The full width at half maximum is 2 sqrt(2 ln 2) standard deviations. */
#define FWHM_DEVIATIONS 2.3548200450309493

/* With g the pulse, z the range asked for and c the centre of a bin that holds the points x,
       g(z - x) = g(z - c) - (x - c) g'(z - c) + R,  |R| <= (x - c)^2 / 2 sup |g''|,
   |x - c| being at most half the bin. With t in standard deviations d, g' = -t g / d and
   g'' = (t^2 - 1) g / d^2, and over a bin g is at most that at its point nearest to z, and |t^2 -
   1| at most the larger of 1 and t^2 - 1 at its farthest. What the bin's sigma is off by counts at
   most g there; points whose range is off by e count e |g'| more. Rounding: t is off by 4 u of
   (|z| + |c|) / d, as if z were off by 4 u (|z| + |c|), which joins e; the rest is below 64 u. */
int lrcs_profile_pulse(const lrcs_profile *profile, double fwhm_m, double range_m,
                       double *density_m, double *bound_m, double *estimate_m)
{
    double d = fwhm_m / FWHM_DEVIATIONS;
    double peak = 1 / (d * sqrt(2 * LRCSI_PI));
    lrcsi_sum density = {0, 0};
    double bound = 0;
    double estimate = 0;
    if (!(fwhm_m > 0) || !(d >= DBL_MIN && peak <= DBL_MAX)) {
        return LRCS_E_ARGUMENT;
    }
    for (uint32_t i = 0; i < profile->count; i++) {
        const lrcs_profile_bin *bin = &profile->bin[i];
        double centre = ((double)(profile->first + i) + 0.5) * profile->bin_m;
        double sigma = bin->sigma_glint_m2 + bin->sigma_diffuse_m2;
        double err = profile->range_err_m + 4 * LRCSI_U * (fabs(range_m) + fabs(centre));
        double t = (range_m - centre) / d;
        double half = (0.5 * profile->bin_m + err) / d * (1 + 8 * LRCSI_U);
        double nearest = lrcsi_most(0, fabs(t) - half);
        double farthest = fabs(t) + half;
        if (nearest > PULSE_FAR) {
            bound += peak * PULSE_FAR_LEFT * (bin->variation_m2 + sigma);
            continue;
        }
        double g = peak * lrcsi_exp(-0.5 * t * t);
        double most = peak * lrcsi_exp(-0.5 * nearest * nearest);
        double bend = lrcsi_most(1, farthest * farthest - 1);
        double remainder = 0.5 * half * half * bend + err / d * farthest;
        lrcsi_sum_add(&density, g * sigma);
        lrcsi_sum_add(&density, g * (t / d) * bin->moment_m3);
        bound += most * (bin->variation_m2 + remainder * sigma);
        estimate += most * bin->curvature_estimate_m2;
        bound += 64 * LRCSI_U * most * (1 + farthest * farthest) * sigma;
    }
    bound *= 1 + 1e-9 + 4 * LRCSI_U * profile->count;
    if (!isfinite(lrcsi_sum_value(&density) + bound)) {
        return LRCS_E_NUMBER;
    }
    *density_m = lrcsi_sum_value(&density);
    *estimate_m = estimate;
    *bound_m = bound + (bound > 0 && bound < DBL_MIN ? 0x1p-1073 : 0);
    return LRCS_OK;
}
