/* SPDX-License-Identifier: MIT */
/* Range profiles: sigma in bins of range. visibility/occlude.c decides what is visible of a facet,
   and integrate/sum/total.c what it reflects; this file divides the visible projected area of a
   facet among the bins, and bounds the error of that. The stages of profile_sum:
   1. the view (lrcsi_view_face, lrcsi_view_project) and the bins (bins_number);
   2. the classification (lrcsi_classify_make), and the proximity band where curved shapes need one;
   3. each facet that reflects (profile_add_facet): its sigma per area (lrcsi_facet_terms_make, or
      lrcsi_curve_integral_make for curved normals), the bins of its corners (facet_ranges), and its
      visible pieces (lrcsi_occlude_open, _next, _close), triangle by triangle
      (lrcsi_range_add_triangle);
   4. the error of facets in place of curved shapes (profile_add_tessellation).

   Let s be a facet's sigma per visible projected area, which is constant on a flat facet, and P one
   of the triangles of a fan over its visible pieces. The computed range z~ is interpolated linearly
   over P between the computed ranges of its corners. The area of P per unit of z~ increases
   linearly from the nearest corner to the middle one, and decreases linearly from there to the
   farthest: its integral over a bin is the sum of at most two trapezia.

   The error of a bin is the sum of the following parts, each times the largest s except (1).
   - (1) The error of s: lrcsi_facet_terms.
   - (2) Let D be the area by which the pieces differ from the visible region. It may lie anywhere
     on the facet, so all of it is added to the error of every bin that the facet extends into.
   - (3) The true range z of a point differs from z~ by at most e, so that the true and the computed
     part of P in a bin differ only where z~ is within e of an edge of the bin. That strip is 2 e
     wide. Because the area per unit of range never exceeds 2 / (z2 - z0) times the area of P, where
     z0 and z2 are the smallest and the largest range of P, the strip has at most the fraction
     4 e / (z2 - z0) of the area. It is added to the error of the bins on both sides of the edge,
     for edges between bins that the facet extends into. These bins are found from the ranges of its
     corners in double-double, so that a facet normal to the line of sight is in one bin.
   - (4) Rounding of the trapezia: some ten operations on terms of one sign, 16 u.
   - (5) Where facets replace curved shapes, the difference between facets and shapes in a bin. A
     point of the shape is within its part's reach of its image on the facet:
     lrcsi_tessellation_interval. If both facets of a sector are entirely visible and lie in one
     bin, reach included, it is the error of the whole patches.

   The error of the sum of all bins has only the parts (1), (2), (4) and the error of the whole
   patches.

   On a facet with curved normals s varies over P, but ranges are still those of the flat facet. The
   part of P in a bin is divided into trapezia between lines of equal range (one of them through the
   middle corner), and each of these into two triangles, whose areas are the two terms of the
   trapezium's area in (4); s is integrated over them by integrate/cubature/cubature.h. (2) and (3)
   hold with the largest s that the facet's normals allow. (1) is replaced by the rounding error of
   the integral: the corners of the triangles have errors of 8 u of the triangle, and their normals
   twice that, which position_err includes (integrate/cubature/curve.c). The error of the cubature
   itself is an estimate, and is not part of any bound.

   The error e. The range of a corner in double-double has the error RANGE_DD_ERROR, which matters
   if z is nearly 0; it is rounded once, 1.01 u |z|. A point of a piece is a weighted sum of
   corners; the weights add up to 1 within 4 u, and the sum has three roundings: 7 u |z|. The
   projection of the point has an error of 100 u of the reach of visibility/cells/target.h, which
   becomes tan(theta) times as much in range. */
#include <lrcs/profile.h>

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/dd.h"
#include "base/outward.h"
#include "base/range.h"
#include "base/sum.h"
#include "base/work.h"
#include "integrate/cubature/curve.h"
#include "integrate/range/range_bins.h"
#include "integrate/sum/facet_terms.h"
#include "integrate/wall/tessellation.h"
#include "view/frame.h"
#include "visibility/occlude.h"

/* Relative error of a range in double-double, for each unit of |x| + |y| + |z|: the components of
   the unit vector are accurate to 2^-97, three products and two sums add 16 u^2. */
#define RANGE_DD_ERROR 0x1p-96

/* The tolerance given to the cubature over curved normals, relative to the sigma of all facets with
   curved normals; the cubature aims at a tenth of it. */
#define CURVE_TOLERANCE 1e-6

/* That of means over patches (integrate/wall/patch.c). */
#define PATCH_TOLERANCE 1e-6

/* The state of a run. */
typedef struct profile_run {
    const lrcs_prepared *prepared;
    const lrcsi_view *view;
    lrcsi_plan plan;
    lrcsi_range_bins bins;
    lrcsi_curve_options curve_options; /* its stack is NULL if all normals are flat */
    lrcsi_curve_context curves;
    lrcsi_visible_area *visible; /* of every facet; NULL if no facet replaces a curved shape */
    lrcsi_proximity_band whole_band;
    lrcsi_masked_band band_memory;
    lrcsi_masked_band *band; /* NULL: none was made */
    lrcsi_patches patches;
    double tessellation; /* (5) of all bins together, scaled */
} profile_run;

/* --- ranges ----------------------------------------------------------------------------------- */

/* The range of a scene point, and a bound of its error. Along an axis it is exact, and *err is
   0. */
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

/* Computes the ranges of a facet's corners, and finds the bins that it extends into. A corner whose
   range cannot be distinguished from the edge between two bins extends into both. If the range is
   exact, so is its bin. */
static void facet_ranges(const profile_run *run, uint32_t facet, lrcsi_range_facet *f)
{
    f->first = run->bins.count;
    f->last = 0;
    f->range_max = 0;
    f->range_dd_err = 0;
    for (int k = 0; k < 3; k++) {
        double err;
        lrcsi_dd range = range_of(run->view, lrcsi_prepared_corner(run->prepared, facet, k), &err);
        f->range[k] = lrcsi_dd_value(range);
        f->range_max = lrcsi_max(f->range_max, fabs(f->range[k]));
        f->range_dd_err = lrcsi_max(f->range_dd_err, err);
        uint32_t low = lrcsi_range_bin(&run->bins, f->range[k]);
        uint32_t high = low;
        double below =
            lrcsi_dd_value(lrcsi_dd_sub(range, (lrcsi_dd){lrcsi_range_edge(&run->bins, low), 0}));
        double above = lrcsi_dd_value(
            lrcsi_dd_sub(range, (lrcsi_dd){lrcsi_range_edge(&run->bins, low + 1), 0}));
        if (low > 0 && below < 2 * err) {
            low -= 1;
            high -= below < -2 * err ? 1 : 0;
        } else if (high + 1 < run->bins.count && err > 0 && above >= -2 * err) {
            high += 1;
        }
        f->first = low < f->first ? low : f->first;
        f->last = high > f->last ? high : f->last;
    }
    const double *z = f->range;
    f->extent = lrcsi_max(z[0], lrcsi_max(z[1], z[2])) - lrcsi_min(z[0], lrcsi_min(z[1], z[2])) +
                8 * LRCSI_U * f->range_max + 2.01 * f->range_dd_err;
}

/* --- one facet -------------------------------------------------------------------------------- */

/* The range, and on a facet with curved normals the normal, at a corner of a piece. */
static void piece_corner(const lrcsi_range_facet *f, const lrcsi_target *target,
                         const double corner[2], double *range, double normal[3])
{
    double weight[3];
    lrcsi_target_weights(target, corner, weight);
    *range = weight[0] * f->range[0] + weight[1] * f->range[1] + weight[2] * f->range[2];
    for (int k = 0; k < 3 && f->curve; k++) {
        const double(*n)[3] = (const double(*)[3])f->curve->normal;
        normal[k] = weight[0] * n[0][k] + weight[1] * n[1][k] + weight[2] * n[2][k];
    }
}

/* Adds a convex piece as a fan of triangles from its first corner. Returns a bound on the error of
   its area. */
static double profile_add_piece(profile_run *run, const lrcsi_range_facet *f,
                                const lrcsi_target *target, const lrcsi_clip_polygon *piece,
                                double range_err)
{
    double range[3]; /* of corners 0, i - 1 and i */
    double normal[3][3] = {{0}};
    double area_err = 0;
    const double *c = piece->corner[0];
    for (uint32_t i = 0; i < piece->count; i++) {
        uint32_t k = i < 2 ? i : 2;
        piece_corner(f, target, piece->corner[i], &range[k], normal[k]);
        if (i < 2) {
            continue;
        }
        double area = lrcsi_clip_fan_area(c, piece->corner[i - 1], piece->corner[i], &area_err);
        if (area > 0) {
            lrcsi_range_add_triangle(&run->bins, f, area, range, (const double(*)[3])normal,
                                     range_err);
        }
        range[1] = range[2];
        memcpy(normal[1], normal[2], sizeof normal[1]);
    }
    return area_err;
}

/* Adds the visible pieces of a facet, and returns the area D of part (2). On a convex surface
   fronts are visible without clipping, except those at grazing incidence. */
static double profile_add_pieces(profile_run *run, lrcsi_range_facet *f, uint32_t facet,
                                 const lrcsi_incidence *incidence, lrcsi_occlusion *o)
{
    double corner_err = 2 * LRCSI_U * f->range_max + 1.01 * f->range_dd_err;
    const double(*normal)[3] = f->curve ? (const double(*)[3])f->curve->normal : NULL;
    if (run->plan.fronts_visible && run->view->facing[facet] > 0) {
        lrcsi_visible_area known = lrcsi_visible_area_unshadowed(incidence, run->plan.grazing_cos);
        lrcsi_range_add_triangle(&run->bins, f, known.area, f->range, normal, corner_err);
        if (run->visible) {
            run->visible[facet] = known;
        }
        return known.high - known.low;
    }
    double area_err = 0;
    const int in_cells = lrcsi_occlude_open(o, facet);
    if (f->curve && in_cells) {
        f->position_err = lrcsi_curve_position_err(f->curve, &o->single.target);
    }
    while (lrcsi_occlude_next(o)) {
        const lrcsi_target *target = &o->single.target;
        double slope = sqrt(incidence->tan2) * (1 + incidence->tan2_err);
        double range_err = 9 * LRCSI_U * f->range_max + 1.01 * f->range_dd_err +
                           101 * LRCSI_U * target->reach * slope;
        if (in_cells) {
            area_err += profile_add_piece(run, f, target, &o->single.piece, range_err);
        } else {
            lrcsi_range_add_triangle(&run->bins, f, incidence->projected, f->range, normal,
                                     corner_err);
        }
    }
    lrcsi_visible_area visible =
        lrcsi_visible_area_proved(run->view, facet, lrcsi_occlude_close(o));
    if (in_cells) {
        area_err += lrcsi_occlude_piece_err(o);
    }
    if (run->visible) {
        run->visible[facet] = visible;
    }
    return visible.high - visible.low + area_err;
}

/* Adds a facet that reflects. */
static void profile_add_facet(profile_run *run, uint32_t facet, lrcsi_occlusion *o)
{
    lrcsi_incidence incidence = lrcsi_view_incidence(run->view, facet);
    lrcsi_visible_area whole = lrcsi_visible_area_exact(incidence.projected);
    lrcsi_curve_integral curve;
    lrcsi_range_facet f = {.curve = NULL};
    double before = lrcsi_sum_value(&run->bins.glint) + lrcsi_sum_value(&run->bins.diffuse);
    if (lrcsi_curve_applies(run->view, facet)) {
        lrcsi_curve_integral_make(&run->curves, facet, &curve);
        f.curve = &curve;
        f.position_err = curve.surface.position_err;
        f.upper_bound = LRCS_FOUR_PI * lrcsi_curve_upper_bound(&curve) * (1 + incidence.error);
    } else {
        lrcsi_facet_terms terms =
            lrcsi_facet_terms_make(run->view, &run->plan, facet, &incidence, &whole, &run->patches);
        f.glint = terms.glint / incidence.projected;
        f.diffuse = terms.diffuse / incidence.projected;
        f.rounding = terms.rounding / incidence.projected;
        f.upper_bound = f.glint + f.diffuse + f.rounding;
    }
    facet_ranges(run, facet, &f);
    double additions = run->bins.additions;
    double uncertain_area = profile_add_pieces(run, &f, facet, &incidence, o);
    for (uint32_t i = f.first; uncertain_area > 0 && i <= f.last; i++) {
        run->bins.bin[i].bound += f.upper_bound * uncertain_area;
        run->bins.additions++;
    }
    run->bins.bound += f.upper_bound * uncertain_area;
    if (f.curve) {
        lrcsi_curve_context_add(&run->curves, lrcsi_sum_value(&run->bins.glint) +
                                                  lrcsi_sum_value(&run->bins.diffuse) - before);
    }
    if (run->bins.additions > additions) {
        run->bins.begin = f.first < run->bins.begin ? f.first : run->bins.begin;
        run->bins.end = f.last + 1 > run->bins.end ? f.last + 1 : run->bins.end;
    }
}

/* --- curved shapes ---------------------------------------------------------------------------- */

/* The fraction of a triangle's area with a range below z. Given: the ranges of its corners, in
   ascending order. */
static double fraction_below(const double corner[3], double z)
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

/* An upper bound of the fraction with a range between two values, with the error (4) of each. */
static double fraction_between(const double corner[3], double from, double to)
{
    double fraction =
        fraction_below(corner, to) - fraction_below(corner, from) + 2 * LRCSI_RANGE_AREA_ERR;
    return to < corner[0] || from > corner[2] ? 0 : lrcsi_min(1, fraction);
}

/* Adds part (5) of the error for one facet:
   1. finds the bins that the facet or its partner extends into, enlarged by the reach;
   2. adds the error of the whole patches to the sum of all bins; it is also the error of a bin that
      contains both facets;
   3. adds to each bin the smaller of two bounds: one from the deviation of sigma on the patch and
      from the area that may be in the bin on only one of facet and patch; the other from the larger
      of the two values, because the difference of two numbers >= 0 is at most the larger one. With
      weights that depend on range the difference may become the sum, at most twice the larger
      one. */
static void profile_add_tessellation(profile_run *run, uint32_t facet)
{
    lrcsi_range_facet f;
    lrcsi_range_facet other;
    lrcsi_incidence incidence = lrcsi_view_incidence(run->view, facet);
    const lrcsi_tessellation_input in = {run->view, &run->plan, run->visible, NULL, run->band,
                                         NULL,      0};
    lrcsi_interval_error error = lrcsi_tessellation_interval(&in, facet, &incidence, &run->patches);
    facet_ranges(run, facet, &f);
    facet_ranges(run, error.partner, &other);
    const lrcs_part *part = &run->prepared->scene->part[run->prepared->scene->facet_part[facet]];
    double reach = ldexp(part->bounds.reach, -run->prepared->exponent) * LRCSI_OUTWARD(4) +
                   8 * LRCSI_U * f.range_max + 1.01 * f.range_dd_err; /* with the corners' errors */
    int order[3];
    lrcsi_range_order(f.range, order);
    const double z[3] = {f.range[order[0]], f.range[order[1]], f.range[order[2]]};
    double low =
        lrcsi_min(z[0], lrcsi_min(other.range[0], lrcsi_min(other.range[1], other.range[2])));
    double high =
        lrcsi_max(z[2], lrcsi_max(other.range[0], lrcsi_max(other.range[1], other.range[2])));
    uint32_t begin = lrcsi_range_bin(&run->bins, low - reach);
    uint32_t end = lrcsi_range_bin(&run->bins, high + reach);
    double whole = LRCS_FOUR_PI * error.whole;
    run->tessellation += whole;
    if (!(whole > 0) && !(error.visible && reach > 0 && error.shift > 0)) {
        return;
    }
    run->bins.range_err = lrcsi_max(run->bins.range_err, reach);
    for (uint32_t i = begin; i <= end; i++) {
        double from = lrcsi_range_edge(&run->bins, i);
        double to = lrcsi_range_edge(&run->bins, i + 1);
        double fraction = fraction_between(z, from - reach, to + reach);
        double shifted = fraction_between(z, from - reach, from + reach) +
                         fraction_between(z, to - reach, to + reach) + error.mismatch;
        double general = LRCS_FOUR_PI * (error.deviation * fraction + error.shift * shifted);
        double larger = error.visible ? LRCS_FOUR_PI * error.upper_bound * fraction : whole;
        general = error.visible ? general : HUGE_VAL;
        run->bins.bin[i].tessellation_variation += lrcsi_min(general, 2 * larger);
        run->bins.bin[i].tessellation += begin == end ? whole : lrcsi_min(general, larger);
        run->bins.additions++;
    }
    run->bins.begin = begin < run->bins.begin ? begin : run->bins.begin;
    run->bins.end = end + 1 > run->bins.end ? end + 1 : run->bins.end;
}

/* --- all facets ------------------------------------------------------------------------------- */

/* The largest reach of the parts whose bounds are known, m. That of other parts may be infinite;
   no tessellation error is added for their facets. */
static double max_reach(const lrcs_prepared *prepared)
{
    double reach = 0;
    for (uint32_t i = 0; i < prepared->scene->part_count; i++) {
        const lrcs_part *part = &prepared->scene->part[i];
        reach = part->bounds.known ? lrcsi_max(reach, part->bounds.reach) : reach;
    }
    return reach;
}

size_t lrcs_profile_need(const lrcs_prepared *prepared, double bin_m)
{
    if (!(bin_m > 0)) {
        return 0;
    }
    /* The depth of the scene in any pose: the diagonal of its box is at most 2 sqrt(3) radius. */
    double depth = ldexp(2 * 1.7320508075688774 * prepared->radius, prepared->exponent) +
                   2 * max_reach(prepared);
    double bins_max = depth / bin_m + 4;
    size_t bins =
        bins_max < LRCS_PROFILE_BINS ? (size_t)bins_max + 1 : (size_t)LRCS_PROFILE_BINS + 4;
    size_t need = lrcsi_work_bytes(bins, sizeof(lrcs_profile_bin));
    need = lrcsi_work_add(need, lrcsi_work_bytes(bins, sizeof(lrcsi_range_sums)));
    need = lrcsi_work_add(need, lrcsi_view_need(prepared));
    need = lrcsi_work_add(need, lrcsi_classify_need(prepared));
    need = lrcsi_work_add(need, prepared->has_curved_normals ? lrcsi_cubature_need() : 0);
    if (prepared->has_curved_shapes) {
        size_t facets = prepared->scene->facet_count;
        need = lrcsi_work_add(need, lrcsi_work_bytes(facets, sizeof(lrcsi_visible_area)));
        need = lrcsi_work_add(need, lrcsi_proximity_band_need(prepared));
        need = lrcsi_work_add(need, lrcsi_masked_band_need(prepared));
    }
    return lrcsi_work_add(need, lrcsi_occlude_need(prepared));
}

/* Numbers the bins from one before the nearest point to one beyond the farthest. */
static int bins_number(profile_run *run)
{
    const lrcs_prepared *p = run->prepared;
    double nearest = HUGE_VAL;
    double farthest = -HUGE_VAL;
    for (uint32_t v = 0; v < p->scene->vertex_count; v++) {
        double err;
        if (p->referenced[v]) {
            double range = lrcsi_dd_value(range_of(run->view, p->vertex[v].x, &err));
            nearest = lrcsi_min(nearest, range);
            farthest = lrcsi_max(farthest, range);
        }
    }
    if (!(nearest <= farthest)) {
        return LRCS_OK;
    }
    double reach = ldexp(max_reach(p), -p->exponent);
    double first = floor((nearest - reach) / run->bins.width) - 1;
    double last = floor((farthest + reach) / run->bins.width) + 1;
    if (!(first >= -LRCS_PROFILE_INDEX && last <= LRCS_PROFILE_INDEX &&
          last - first < LRCS_PROFILE_BINS)) {
        return LRCS_E_LIMIT;
    }
    run->bins.first = (int64_t)first;
    run->bins.count = (uint32_t)(last - first) + 1;
    return LRCS_OK;
}

/* Makes what curved shapes need besides the classification, room for the visible areas of all
   facets and the proximity band; and what curved normals need, the context of their integrals. */
static int curved_make(profile_run *run, lrcsi_classification *classification, lrcs_work *work)
{
    const lrcs_prepared *p = run->prepared;
    if (p->has_curved_shapes) {
        run->visible = lrcsi_work_take_zero(work, p->scene->facet_count, sizeof *run->visible);
        int status = run->visible ? LRCS_OK : LRCS_E_MEMORY;
        if (status == LRCS_OK && run->plan.proximity_band) {
            status = lrcsi_proximity_band_make(classification, NULL, work, &run->whole_band);
            status = status == LRCS_OK
                         ? lrcsi_masked_band_make(&run->whole_band, work, &run->band_memory)
                         : status;
            run->band = &run->band_memory;
        }
        if (status != LRCS_OK) {
            return status;
        }
    }
    if (p->has_curved_normals) {
        run->curve_options = (lrcsi_curve_options){
            &run->plan, CURVE_TOLERANCE, NULL, NULL, lrcsi_cubature_stack(work), 0};
        if (!run->curve_options.stack) {
            return LRCS_E_MEMORY;
        }
        run->curves = lrcsi_curve_context_make(run->view, &run->curve_options);
    }
    return LRCS_OK;
}

/* Runs the stages listed at the top of this file. */
static int profile_sum(profile_run *run, lrcsi_view *view, const lrcs_pose *pose, lrcs_work *work)
{
    const lrcs_prepared *p = run->prepared;
    const lrcs_run_options options = {.method = LRCS_METHOD_EXACT, .tolerance = PATCH_TOLERANCE};
    const lrcsi_clear_shapes clear = {0};
    lrcsi_classification classification;
    lrcsi_occlusion *o = NULL;
    int status = lrcsi_view_face(p, pose, lrcsi_plan_backs(p, &options), work, view);
    status = status == LRCS_OK ? lrcsi_view_project(work, view) : status;
    if (status != LRCS_OK) {
        return status;
    }
    run->view = view;
    run->plan = lrcsi_plan_make(view, &clear, &options);
    status = bins_number(run);
    if (status == LRCS_OK) {
        run->bins.bin = lrcsi_work_take_zero(work, run->bins.count, sizeof *run->bins.bin);
        run->bins.begin = run->bins.count;
        status =
            run->bins.bin ? lrcsi_classify_make(view, NULL, work, &classification) : LRCS_E_MEMORY;
    }
    status = status == LRCS_OK ? curved_make(run, &classification, work) : status;
    status = status == LRCS_OK ? lrcsi_occlude_make(&classification, NULL, work, &o) : status;
    for (uint32_t facet = 0; facet < p->scene->facet_count && status == LRCS_OK; facet++) {
        if (view->facing[facet] != 0 && lrcsi_view_reflects(view, facet) &&
            lrcsi_view_casts(view, facet)) {
            profile_add_facet(run, facet, o);
        }
    }
    if (status != LRCS_OK || !p->has_curved_shapes || !lrcsi_tessellation_known(p, &run->plan)) {
        return status;
    }
    if (run->band) {
        lrcsi_masked_band_find(run->band, run->visible, NULL, work);
    }
    for (uint32_t facet = 0; facet < p->scene->facet_count; facet++) {
        if (!p->skip[facet]) {
            profile_add_tessellation(run, facet);
        }
    }
    return status;
}

/* Converts the sums to square metres. The bounds include the rounding errors of the sums, and are
   rounded outward. */
static void profile_finish(const profile_run *run, lrcs_profile *profile)
{
    const lrcs_prepared *p = run->prepared;
    double count = run->bins.additions;
    double outward = LRCSI_OUTWARD_NANO + 2 * count * LRCSI_U;
    double adding = 4 * LRCSI_U + 3 * (count * LRCSI_U) * (count * LRCSI_U);
    for (uint32_t i = 0; i < profile->count; i++) {
        const lrcsi_range_sums *sums = &run->bins.bin[run->bins.begin + i];
        double glint = lrcsi_sum_value(&sums->glint);
        double diffuse = lrcsi_sum_value(&sums->diffuse);
        double moment = lrcsi_prepared_area(p, lrcsi_sum_value(&sums->moment));
        profile->bin[i] = (lrcs_profile_bin){
            lrcsi_prepared_area(p, glint),
            lrcsi_prepared_area(p, diffuse),
            lrcsi_prepared_bound(
                p, (sums->bound + sums->tessellation + (glint + diffuse) * adding) * outward),
            lrcsi_prepared_bound(
                p, (sums->bound + sums->tessellation_variation + (glint + diffuse) * adding) *
                       outward),
            p->has_curved_normals ? lrcsi_prepared_bound(p, sums->estimate * outward) : 0,
            ldexp(moment, p->exponent)};
        if (profile->bin[i].variation_m2 < profile->bin[i].bound_m2) {
            profile->bin[i].variation_m2 = profile->bin[i].bound_m2;
        }
    }
    double glint = lrcsi_sum_value(&run->bins.glint);
    double diffuse = lrcsi_sum_value(&run->bins.diffuse);
    profile->bin_m = run->bins.bin_m;
    profile->first = profile->count > 0 ? run->bins.first + run->bins.begin : 0;
    profile->sigma_glint_m2 = lrcsi_prepared_area(p, glint);
    profile->sigma_diffuse_m2 = lrcsi_prepared_area(p, diffuse);
    profile->bound_m2 = lrcsi_prepared_bound(
        p, (run->bins.bound + run->tessellation + (glint + diffuse) * adding) * outward);
    profile->curvature_estimate_m2 =
        p->has_curved_normals ? lrcsi_prepared_bound(p, run->bins.estimate * outward) : -1;
    profile->tessellation_known = !p->has_curved_shapes || lrcsi_tessellation_known(p, &run->plan);
    profile->range_err_m = ldexp(run->bins.range_err, p->exponent);
}

int lrcs_profile_run(const lrcs_prepared *prepared, const lrcs_pose *pose, double bin_m,
                     lrcs_work *work, lrcs_profile *profile)
{
    size_t mark = work->used;
    lrcsi_view view;
    lrcs_profile result = {0};
    profile_run run = {.prepared = prepared,
                       .bins = {.exponent = prepared->exponent,
                                .bin_m = bin_m,
                                .width = ldexp(bin_m, -prepared->exponent)}};
    if (!(bin_m > 0 && bin_m <= DBL_MAX) ||
        !(run.bins.width >= DBL_MIN && run.bins.width <= DBL_MAX)) {
        return LRCS_E_ARGUMENT;
    }
    int status = profile_sum(&run, &view, pose, work);
    if (status == LRCS_OK) {
        result.count = run.bins.begin < run.bins.end ? run.bins.end - run.bins.begin : 0;
        result.bin = lrcsi_work_take(work, result.count, sizeof *result.bin);
        status = result.bin ? LRCS_OK : LRCS_E_MEMORY;
    }
    if (status == LRCS_OK) {
        profile_finish(&run, &result);
        status = isfinite(result.sigma_glint_m2 + result.sigma_diffuse_m2 + result.bound_m2)
                     ? LRCS_OK
                     : LRCS_E_NUMBER;
    }
    work->used = mark;
    if (status == LRCS_OK) { /* the bins move to the start of the work area */
        lrcs_profile_bin *bin = lrcsi_work_take(work, result.count, sizeof *bin);
        memmove(bin, result.bin, result.count * sizeof *bin);
        result.bin = bin;
        *profile = result;
    }
    return status;
}
