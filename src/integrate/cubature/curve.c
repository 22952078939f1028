/* SPDX-License-Identifier: MIT */
/* Facets with curved normals. This file decides over which region of a facet f_r cos(theta) is
   integrated, and bounds the error if that region is not known exactly; cubature.c integrates.

   Let F be an upper bound of f_r cos over the facet's normals, P its projected area and I the
   integral over all of it. The visible part V has an area in [low, high], so that
       I - F (P - low) <= integral over V <= F high,  and the integral is in [0, I].
   If only an area is known, the error of any value in that interval is at most its distance from
   the farther end. Clipped pieces differ from V by an area of at most high - low, counting both
   what they have in excess and what they lack, and by the rounding of their corners
   (visibility/occlude.h): the error is at most F times these areas. If spent steps leave an error
   in I, all of these errors increase by at most that.

   Rounding: normals in view axes have errors of 12 u (the rows of a rotation, three products, two
   sums), 4 u more for each of at most 64 halvings, and 8 u at the points of a quadrature rule:
   2^-44 covers their sum. */
#include "integrate/cubature/curve.h"

#include <math.h>

#include "base/constant.h"
#include "base/range.h"

/* Bound on the error of a normal at a point of the whole facet. */
#define NORMAL_ERR 0x1p-44

/* The cubature aims at this fraction of the tolerance, but at no less and no more than its rule is
   suited for. Heuristics: its error is estimated, whatever it aims at. */
#define CUBATURE_FRACTION 0.1
#define CUBATURE_MIN      1e-9
#define CUBATURE_MAX      1e-2

int lrcsi_curve_applies(const lrcsi_view *view, uint32_t facet)
{
    const lrcs_prepared *p = view->prepared;
    return lrcsi_prepared_normals(p, facet) && view->facing[facet] != 0 &&
           lrcsi_view_reflects(view, facet);
}

void lrcsi_curve_integral_make(const lrcsi_curve_context *context, uint32_t facet,
                               lrcsi_curve_integral *integral)
{
    const lrcsi_view *view = context->view;
    const lrcs_point *n = lrcsi_prepared_normals(view->prepared, facet);
    integral->view = view;
    integral->facet = facet;
    integral->incidence = lrcsi_view_incidence(view, facet);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            const double *row = view->R[k];
            integral->normal[i][k] = view->facing[facet] *
                                     (row[0] * n[i].x[0] + row[1] * n[i].x[1] + row[2] * n[i].x[2]);
        }
    }
    double cubature_tolerance = lrcsi_min(
        CUBATURE_MAX, lrcsi_max(CUBATURE_MIN, CUBATURE_FRACTION * context->options->tolerance));
    integral->brdf =
        lrcsi_plan_brdf(context->options->plan, lrcsi_prepared_material(view->prepared, facet));
    lrcsi_cubature_surface *surface = &integral->surface;
    *surface = lrcsi_cubature_surface_make(&integral->brdf, (const double(*)[3])integral->normal,
                                           cubature_tolerance, context->options->stack);
    surface->area = integral->incidence.projected;
    surface->position_err = NORMAL_ERR;
    surface->meter = context->options->meter;
    surface->derivatives = context->options->derivatives;
    surface->negligible = lrcsi_max(surface->negligible, context->negligible);
    surface->reference = context->sum > 0
                             ? context->sum / context->projected +
                                   context->sum / context->count / integral->incidence.projected
                             : 0;
}

lrcsi_curve_context lrcsi_curve_context_make(const lrcsi_view *view,
                                             const lrcsi_curve_options *options)
{
    lrcsi_curve_context context = {view, options, 0, 0, 0, 0};
    lrcsi_curve_integral integral;
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        if (lrcsi_curve_applies(view, f)) {
            lrcsi_curve_integral_make(&context, f, &integral);
            context.negligible = integral.surface.negligible;
            context.projected += integral.incidence.projected;
            context.count++;
        }
    }
    return context;
}

void lrcsi_curve_context_add(lrcsi_curve_context *context, double sigma)
{
    context->sum += sigma / LRCS_FOUR_PI;
}

double lrcsi_curve_upper_bound(const lrcsi_curve_integral *integral)
{
    return integral->surface.upper_bound.glint + integral->surface.upper_bound.diffuse;
}

/* The contribution of a facet: its integral times the visible fraction. */
static lrcsi_curve_terms integral_part(const lrcsi_curve_integral *integral,
                                       const lrcsi_cubature *sum, double fraction)
{
    double factor = LRCS_FOUR_PI * fraction;
    lrcsi_curve_terms part = {0, 0, 0, 0, 0, 0, 0, 0, 0};
    part.glint = factor * lrcsi_sum_value(&sum->glint);
    part.diffuse = factor * lrcsi_sum_value(&sum->diffuse);
    part.glint_u = factor * lrcsi_sum_value(&sum->glint_u);
    part.diffuse_log = factor * lrcsi_sum_value(&sum->diffuse_log);
    part.rounding = factor * sum->rounding +
                    (integral->incidence.error + 16 * LRCSI_U) * (part.glint + part.diffuse);
    part.estimate = factor * sum->estimate;
    part.upper_bound = LRCS_FOUR_PI * lrcsi_curve_upper_bound(integral) *
                       integral->incidence.projected * (1 + integral->incidence.error);
    return part;
}

/* --- from areas ------------------------------------------------------------------------------- */

/* The contribution of a facet of which only the visible area is known. */
static lrcsi_curve_terms curve_from_area(const lrcsi_curve_integral *integral,
                                         const lrcsi_visible_area *visible)
{
    lrcsi_cubature sum = lrcsi_cubature_start(&integral->surface);
    if (!(visible->high > 0)) {
        return integral_part(integral, &sum, 0);
    }
    double projected = integral->incidence.projected;
    lrcsi_cubature_add(&sum, (const double(*)[3])integral->normal, NULL, projected);
    double whole = lrcsi_sum_value(&sum.glint) + lrcsi_sum_value(&sum.diffuse);
    double bound = lrcsi_curve_upper_bound(integral);
    double high = visible->high < projected ? lrcsi_min(whole, bound * visible->high) : whole;
    double low =
        visible->low < projected ? lrcsi_max(0, whole - bound * (projected - visible->low)) : whole;
    if (!(low <= high)) { /* by rounding, or the cubature's error */
        low = high;
    }
    double value = lrcsi_min(high, lrcsi_max(low, visible->area / projected * whole));
    lrcsi_curve_terms part = integral_part(integral, &sum, whole > 0 ? value / whole : 0);
    part.visibility = LRCS_FOUR_PI * (lrcsi_max(high - value, value - low) + sum.unresolved);
    part.rounding = integral_part(integral, &sum, 1).rounding;
    part.error_estimate =
        part.visibility > 0 ? (LRCS_FOUR_PI * whole / projected) * visible->error_estimate : 0;
    part.estimate = LRCS_FOUR_PI * sum.estimate;
    return part;
}

void lrcsi_curve_from_areas(const lrcsi_view *view, const lrcsi_curve_options *options,
                            const lrcsi_visible_area *visible, lrcsi_curve_terms *curve_terms)
{
    lrcsi_curve_integral integral;
    lrcsi_curve_context context = lrcsi_curve_context_make(view, options);
    for (uint32_t f = 0; f < view->prepared->scene->facet_count; f++) {
        curve_terms[f] = (lrcsi_curve_terms){.glint = 0};
        lrcsi_progress_report(options->progress, LRCS_PROGRESS_INTEGRATE, f,
                              view->prepared->scene->facet_count);
        if (lrcsi_curve_applies(view, f)) {
            lrcsi_curve_integral_make(&context, f, &integral);
            curve_terms[f] = curve_from_area(&integral, &visible[f]);
            lrcsi_curve_context_add(&context, curve_terms[f].glint + curve_terms[f].diffuse);
        }
    }
}

/* --- from pieces ------------------------------------------------------------------------------ */

/* Adds a convex piece as a fan of triangles from its first corner. Returns a bound on the error of
   its area. */
static double piece_add(const lrcsi_curve_integral *integral, const lrcsi_target *target,
                        const double (*corner)[2], uint32_t count, lrcsi_cubature *sum)
{
    double normal[3][3]; /* at corners 0, i - 1 and i */
    double area_err = 0;
    for (uint32_t i = 0; i < count; i++) {
        double weight[3];
        double *n = normal[i < 2 ? i : 2];
        lrcsi_target_weights(target, corner[i], weight);
        for (int k = 0; k < 3; k++) {
            n[k] = weight[0] * integral->normal[0][k] + weight[1] * integral->normal[1][k] +
                   weight[2] * integral->normal[2][k];
        }
        if (i < 2) {
            continue;
        }
        double area = lrcsi_clip_fan_area(corner[0], corner[i - 1], corner[i], &area_err);
        lrcsi_cubature_add(sum, (const double(*)[3])normal, NULL, area); /* if positive */
        for (int k = 0; k < 3; k++) {
            normal[1][k] = normal[2][k];
        }
    }
    return area_err;
}

/* In projection, points of pieces have errors of 100 u of the target's reach. Divided by the
   smallest height of the facet, and multiplied by the largest distance of two of its unit normals,
   2, this is the error of the normal. */
double lrcsi_curve_position_err(const lrcsi_curve_integral *integral, const lrcsi_target *target)
{
    double height = 2 * integral->incidence.projected / target->diameter;
    return NORMAL_ERR + 200 * LRCSI_U * target->reach / height;
}

/* The contribution of a facet with curved normals, from its visible pieces. Given: o, which has
   opened the facet, and is closed here. */
static lrcsi_curve_terms curve_from_pieces(const lrcsi_curve_integral *integral, lrcsi_occlusion *o,
                                           lrcsi_visible_area *visible)
{
    const lrcsi_target *target = &o->single.target;
    double area_err = 0;
    lrcsi_cubature sum = lrcsi_cubature_start(&integral->surface);
    sum.surface.position_err = lrcsi_curve_position_err(integral, target);
    while (lrcsi_occlude_next(o)) {
        area_err += piece_add(integral, target, (const double(*)[2])o->single.piece.corner,
                              o->single.piece.count, &sum);
    }
    area_err += lrcsi_occlude_piece_err(o);
    *visible = lrcsi_visible_area_proved(integral->view, integral->facet, lrcsi_occlude_close(o));
    lrcsi_curve_terms part = integral_part(integral, &sum, 1);
    part.visibility = LRCS_FOUR_PI * (lrcsi_curve_upper_bound(integral) *
                                          (visible->high - visible->low + area_err) +
                                      sum.unresolved);
    return part;
}

/* Clips facets and integrates: all, or, with areas from samples, those with curved normals that are
   partly visible. */
static int curve_clip(lrcsi_classification *classification, const lrcsi_curve_options *options,
                      int sampled, lrcs_work *work, lrcsi_visible_area *visible,
                      lrcsi_curve_terms *curve_terms)
{
    const lrcsi_view *view = classification->view;
    uint32_t count = view->prepared->scene->facet_count;
    size_t mark = work->used;
    lrcsi_occlusion *o = NULL;
    lrcsi_curve_integral integral;
    lrcsi_curve_context context = lrcsi_curve_context_make(view, options);
    int status = lrcsi_occlude_make(classification, options->meter, work, &o);
    for (uint32_t f = 0; f < count && status == LRCS_OK; f++) {
        int applies = lrcsi_curve_applies(view, f);
        int partly = sampled && classification->undecided[f] && visible[f].low < visible[f].high;
        curve_terms[f] = (lrcsi_curve_terms){.glint = 0};
        lrcsi_progress_report(options->progress,
                              sampled ? LRCS_PROGRESS_INTEGRATE : LRCS_PROGRESS_VISIBILITY, f,
                              count);
        if (applies) {
            lrcsi_curve_integral_make(&context, f, &integral);
        }
        if (!sampled || (partly && applies)) {
            const int in_cells = lrcsi_occlude_open(o, f);
            if (applies && in_cells) {
                curve_terms[f] = curve_from_pieces(&integral, o, &visible[f]);
                lrcsi_curve_context_add(&context, curve_terms[f].glint + curve_terms[f].diffuse);
                continue;
            }
            visible[f] = lrcsi_visible_area_proved(view, f, lrcsi_occlude_area(o));
        }
        if (applies) {
            curve_terms[f] = curve_from_area(&integral, &visible[f]);
            lrcsi_curve_context_add(&context, curve_terms[f].glint + curve_terms[f].diffuse);
        }
    }
    work->used = mark;
    return status;
}

int lrcsi_curve_from_pieces(lrcsi_classification *classification,
                            const lrcsi_curve_options *options, lrcs_work *work,
                            lrcsi_visible_area *visible, lrcsi_curve_terms *curve_terms)
{
    return curve_clip(classification, options, 0, work, visible, curve_terms);
}

int lrcsi_curve_from_samples(lrcsi_classification *classification,
                             const lrcsi_curve_options *options, lrcs_work *work,
                             lrcsi_visible_area *visible, lrcsi_curve_terms *curve_terms)
{
    return curve_clip(classification, options, 1, work, visible, curve_terms);
}
