/* SPDX-License-Identifier: MIT */
/* Chooses, among the bounds that integrate/wall/tessellation.c proves for a facet on a curved wall,
   the smallest one: with the mean of F over the patch, or with a linear function in its place
   (integrate/wall/linear.h), which also corrects the sum. */
#include "integrate/wall/wall_error.h"

#include <math.h>

#include "integrate/wall/linear.h"
#include "scene/proximity.h"

/* --- how F varies over a patch ---------------------------------------------------------------- */

double lrcsi_patch_area_err(const lrcs_prepared *p, uint32_t facet, const lrcs_patch_bounds *bounds)
{
    double stretch_err = lrcsi_patch_part(p, facet)->bounds.stretch_err;
    return bounds->area_err + stretch_err + bounds->area_err * stretch_err;
}

/* Makes the deviation that of F from the mean over the patch, F_i, in place of F at the normal of
   the facet. The stretch is replaced as well.

   F_i = (1 + a') F^, where F^ is the mean per unit of the patch's own area, which is 1 + a' times
   the facet's. The map stretches area evenly, except for rounding (patch->area_err): so over a
   region E, T - M = Int_E (F - F^), and the stretch drops out. With h = F - F(facet normal),
   max(Int h+, Int h-) <= S region, so that
       Int_U |h| = 2 max - |Int_U h| <= S (2 region) - (1 + a') S |F^ - F(facet normal)|,
       Int_U |F - F^| <= Int_U |h| + (1 + a') S |F^ - F(facet normal)| <= S (2 region),
       |Int_E (F - F^)| <= (Int_U |F - F^| + |Int_U (F - F^)|) / 2 <= S (region + remainder / 2).
   At a single point F^ differs from F(facet normal) by at most |F_i - F(facet normal)| + a F_i.
   Where a scale that differs between axes stretches areas unevenly, the stretch over E and its mean
   over the patch are both within a factor of 1 + stretch_err of that of the facet: T - M also
   contains F^ times their difference, at most ((1 + stretch_err)^2 - 1) F_i per unit of E. */
static void deviation_about_mean(const lrcs_prepared *p, uint32_t facet,
                                 lrcsi_patch_deviation *deviation)
{
    const lrcsi_patch *patch = deviation->patch;
    lrcsi_deviation *of_f = &deviation->of_f;
    double mean = patch->glint + patch->diffuse;
    double error = patch->remainder + patch->rounding;
    /* The factor of optics/deviation.c, 1 + 1e-10, is part of `value`, twice at most. */
    double difference = fabs(mean - of_f->value) + error + 2e-10 * of_f->value;
    of_f->whole = fmin(patch->remainder, of_f->whole + difference);
    of_f->region += error;
    of_f->point += difference + deviation->stretch * (mean + error);
    of_f->value = mean + error;
    double stretch_err = lrcsi_patch_part(p, facet)->bounds.stretch_err;
    deviation->stretch = patch->area_err + stretch_err * (2 + stretch_err);
}

/* The deviation for a facet whose patch, if it has one, has been made. */
static lrcsi_patch_deviation patch_deviation(const lrcsi_tessellation_input *in, uint32_t facet,
                                             const lrcsi_incidence *incidence,
                                             const lrcs_patch_bounds *bounds,
                                             const lrcsi_patch *patch)
{
    const lrcs_prepared *p = in->view->prepared;
    lrcs_brdf brdf = lrcsi_plan_brdf(in->plan, lrcsi_prepared_material(p, facet));
    lrcsi_patch_deviation deviation = {
        .of_f = lrcsi_deviation_make(&brdf, fabs(incidence->cos_theta), incidence->tan2, bounds),
        .stretch = lrcsi_patch_area_err(p, facet, bounds),
        .patch = patch};
    if (patch) {
        deviation_about_mean(p, facet, &deviation);
    }
    return deviation;
}

lrcsi_patch_deviation lrcsi_patch_deviation_make(const lrcsi_tessellation_input *in, uint32_t facet,
                                                 const lrcsi_incidence *incidence,
                                                 const lrcs_patch_bounds *bounds,
                                                 lrcsi_patches *patches)
{
    lrcs_brdf brdf = lrcsi_plan_brdf(in->plan, lrcsi_prepared_material(in->view->prepared, facet));
    return patch_deviation(in, facet, incidence, bounds,
                           lrcsi_patch_make(in->view, in->plan, &brdf, facet, patches));
}

/* --- a sector of which no facet is hidden or faces away --------------------------------------- */

/* The alternative bounds for a sector of which no facet is hidden or faces away, by what they
   use. */
enum sector_method {
    BY_REGION, /* the deviation over any region of both patches */
    BY_POINT,  /* the deviation at any point, times what is visible of the facet */
    BY_HIDDEN, /* what is hidden of the facet, subtracted from the whole patch */
    BY_ROWS    /* the deviation of the whole patch, and of the rows that meet a proximity band */
};
typedef struct sector_bound {
    int method;        /* sector_method */
    double rows, open; /* BY_ROWS: the fraction of the sector in rows that meet a proximity band;
                          that of further ones, where F may differ by its largest value */
    double error;      /* the larger error of both facets, per unit of area */
} sector_bound;

/* The error per unit of area, except for gain and loss: by the deviation over any region; by that
   at any point, times the visible fraction. */
static double bound_by_region(const lrcsi_deviation *deviation, double stretch)
{
    return deviation->region + stretch * deviation->value;
}

static double bound_by_point(const lrcsi_deviation *deviation, double stretch, double a,
                             double visible)
{
    return visible * ((1 + a) * deviation->point + stretch * deviation->value);
}

/* The rows of a sector that meet a proximity band: an upper bound of their fraction of its area; of
   the part of that which may be anywhere; the range of the others. */
typedef struct sector_rows {
    double all, open;
    lrcsi_row_range range;
} sector_rows;

/* All rows if there are none. Each facet of a cone has a sector of its own. */
static sector_rows sector_rows_make(const lrcs_prepared *p, uint32_t facet,
                                    const lrcsi_masked_band *band)
{
    sector_rows rows = {1, 0, {0, 1}};
    if (!lrcsi_proximity_has_rows(p, facet)) {
        return rows;
    }
    rows.all = lrcsi_masked_rows(band, facet);
    rows.open = lrcsi_masked_rows_open(band, facet);
    rows.range = lrcsi_masked_row_range(band, facet);
    if (lrcsi_patch_part(p, facet)->kind != LRCS_SHAPE_CONE) {
        const uint32_t partner = lrcsi_patch_partner(p, facet);
        const lrcsi_row_range range = lrcsi_masked_row_range(band, partner);
        rows.all += lrcsi_masked_rows(band, partner);
        rows.open += lrcsi_masked_rows_open(band, partner);
        rows.range.low = fmin(rows.range.low, range.low);
        rows.range.high = fmax(rows.range.high, range.high);
    }
    rows.all = fmin(1, 2 * rows.all);
    rows.open = fmin(1, 2 * rows.open);
    return rows;
}

/* Is the linear function made for these rows alone? It is on a cone or frustum, where it depends on
   the radius, if they are few: heuristic. */
static int rows_are_few(const lrcs_part *part, const sector_rows *rows)
{
    const double extent = rows->range.high - rows->range.low;
    return (part->kind == LRCS_SHAPE_CONE || part->kind == LRCS_SHAPE_FRUSTUM) && rows->all < 0.5 &&
           extent >= 0 && extent < 0.5;
}

/* Chooses the smallest of these bounds, for both facets of the sector: from the deviation of the
   first facet (on a cone, of the facet itself), and the larger fractions of both. */
static sector_bound sector_choose(const lrcsi_tessellation_input *in, const lrcsi_wall_facet *at,
                                  const lrcsi_deviation *deviation, double stretch)
{
    const lrcs_prepared *p = in->view->prepared;
    const double a = at->area_err;
    uint32_t first = lrcsi_patch_sector(p, at->facet);
    const lrcsi_patch_fractions one =
        lrcsi_patch_fractions_of(&at->pair[0], first, in->visible, in->band, in->margins);
    const lrcsi_patch_fractions two =
        lrcsi_patch_fractions_of(&at->pair[1], first + 1, in->visible, in->band, in->margins);
    int is_cone = lrcsi_patch_part(p, at->facet)->kind == LRCS_SHAPE_CONE;
    double hidden = fmax(one.hidden + one.loss, two.hidden + two.loss);
    double rows = sector_rows_make(p, is_cone ? at->facet : first, in->band).all;
    double b = fmax(fmax(one.gain, one.loss), fmax(two.gain, two.loss));
    double by_hidden = deviation->whole + (1 + a) * hidden * deviation->value_max;
    double by_rows = deviation->whole + rows * bound_by_region(deviation, stretch) +
                     (1 + a) * b * deviation->value;
    double visible = fmax(one.visible, two.visible);
    double by_region = bound_by_region(deviation, stretch);
    double by_point = bound_by_point(deviation, stretch, a, visible);
    double either = fmin(by_region, by_point);
    double by_either =
        fmin(either + (1 + a) * b * deviation->value, (1 + a) * deviation->value_max);
    sector_bound bound = {by_point < by_region ? BY_POINT : BY_REGION, rows, 0, by_either};
    if (by_rows < fmin(by_hidden, by_either)) {
        bound.method = BY_ROWS;
        bound.error = by_rows;
    } else if (by_hidden < either) {
        bound.method = BY_HIDDEN;
        bound.error = by_hidden;
    }
    return bound;
}

/* The error of a facet, per unit of its area, by the bound that was chosen for its sector, which
   counts only if something of both facets is visible. Given: the deviation of F from F_i, or from
   l. */
static lrcsi_tessellation error_by(const lrcsi_patch_fractions *f, double a, int state, int partner,
                                   const lrcsi_deviation *deviation, double stretch,
                                   const sector_bound *bound)
{
    double sup = (1 + a) * deviation->value_max;
    double either = bound_by_point(deviation, stretch, a, f->visible);
    if (state == LRCSI_PATCH_HIDDEN) {
        return (lrcsi_tessellation){f->gain * sup, f->loss * sup, 0, 0, 0};
    }
    if (state == LRCSI_PATCH_AWAY) {
        return (lrcsi_tessellation){partner == LRCSI_PATCH_AWAY ? deviation->whole : sup, 0, 0, 0,
                                    0};
    }
    if (state == LRCSI_PATCH_VISIBLE && partner == LRCSI_PATCH_VISIBLE) {
        return (lrcsi_tessellation){deviation->whole, deviation->whole, 0, 0, 0};
    }
    if (bound->method == BY_HIDDEN) {
        return (lrcsi_tessellation){
            deviation->whole + f->hidden * sup,
            deviation->whole + fmin(1 + f->margin_added, f->hidden + f->loss) * sup, 0, 0, 0};
    }
    if (bound->method == BY_ROWS) {
        either = deviation->whole + bound->rows * bound_by_region(deviation, stretch) +
                 bound->open * (1 + a) * (deviation->value_max + deviation->value);
        sup = HUGE_VAL;
    } else if (bound->method == BY_REGION) {
        either = bound_by_region(deviation, stretch);
    }
    sup *= 1 + f->margin_added;
    return (lrcsi_tessellation){fmin(either + deviation->value * (1 + a) * f->gain, sup),
                                fmin(either + deviation->value * (1 + a) * f->loss, sup), 0, 0, 0};
}

/* --- linear functions ------------------------------------------------------------------------- */

/* The correction of a facet and the error of that, per unit of area. */
typedef struct patch_correction {
    double glint, diffuse, error;
    double ratio; /* the area of the sector divided by the facet's */
} patch_correction;

/* The integral of l - F_i over what is visible of a facet, in the view plane, divided by its
   projected area. An error of the moment is multiplied by the slope, and one of the area by the
   variation; rounding is part of linear->rounding, except for the projected area. Returns 0 if the
   moment is not known. */
static int correction_make(const lrcsi_tessellation_input *in, const lrcsi_wall_facet *at,
                           uint32_t facet, const lrcsi_linear *linear, patch_correction *correction)
{
    const lrcsi_incidence incidence =
        at->pair[facet - lrcsi_patch_sector(in->view->prepared, facet)];
    lrcsi_linear_moment m = lrcsi_linear_moment_make(in->view, facet, at->deviation.patch,
                                                     &in->visible[facet], &in->moment[facet]);
    const double x = m.first[0] / incidence.projected;
    const double y = m.first[1] / incidence.projected;
    correction->ratio = m.ratio;
    correction->glint = linear->glint[0] * x + linear->glint[1] * y;
    correction->diffuse = linear->diffuse[0] * x + linear->diffuse[1] * y;
    correction->error = (linear->slope * m.error + linear->variation * m.area_err) /
                            (incidence.projected * (1 - incidence.error)) +
                        linear->variation * incidence.error;
    return isfinite(correction->glint + correction->diffuse + correction->error);
}

/* The deviation of F from l instead of F_i. Given: the deviation from F_i, and the mean. */
static lrcsi_deviation linear_deviation(const lrcsi_deviation *constant, double a,
                                        const lrcsi_linear *linear, const lrcsi_patch *patch)
{
    double error = patch->remainder + patch->rounding;
    lrcsi_deviation deviation = *constant;
    deviation.whole += linear->rounding;
    deviation.region = linear->region + error;
    deviation.point = linear->point + (1 + a) * linear->region + error;
    deviation.value = patch->glint + patch->diffuse + error + linear->variation;
    deviation.value_max = fmax(deviation.value_max, deviation.value);
    return deviation;
}

/* The sum of the errors of both facets of a sector: with the deviation of the first one and the
   choice for the sector. */
static lrcsi_tessellation sector_error(const lrcsi_tessellation_input *in,
                                       const lrcsi_wall_facet *at, const lrcsi_deviation *deviation,
                                       const sector_bound *bound, double own_err, double other_err)
{
    const lrcs_prepared *p = in->view->prepared;
    uint32_t first = lrcsi_patch_sector(p, at->facet);
    lrcsi_tessellation sum = {0, 0, 0, 0, 0};
    for (uint32_t facet = first; facet < first + 2; facet++) {
        int own = facet == at->facet;
        lrcsi_patch_fractions f = lrcsi_patch_fractions_of(&at->pair[facet - first], facet,
                                                           in->visible, in->band, in->margins);
        lrcsi_tessellation error =
            error_by(&f, at->area_err, own ? at->state : at->partner, own ? at->partner : at->state,
                     deviation, at->deviation.stretch, bound);
        double err = own ? own_err : other_err;
        sum.above += p->normal[facet].length * (error.above + err);
        sum.below += p->normal[facet].length * (error.below + err);
    }
    return sum;
}

/* What the two facets of a sector use together, if something of both is visible, but not all
   (joint); else only of the facet. */
typedef struct wall_sector {
    int joint;
    lrcsi_deviation deviation; /* of the first facet */
    sector_bound bound;        /* the choice without a correction */
} wall_sector;

/* Makes the error with a correction. Returns 1 if neither of its bounds is larger than that of
   `constant`, the error without one: then no sum of errors is. The bounds of both facets of a joint
   sector are compared together, if they share a patch. */
static int corrected_error(const lrcsi_tessellation_input *in, const lrcsi_wall_facet *at,
                           const wall_sector *sector, const lrcsi_tessellation *constant,
                           lrcsi_tessellation *error)
{
    const lrcs_prepared *p = in->view->prepared;
    const lrcs_brdf brdf = lrcsi_plan_brdf(in->plan, lrcsi_prepared_material(p, at->facet));
    const lrcsi_patch *patch = at->deviation.patch;
    const double a = at->area_err;
    const double stretch = at->deviation.stretch;
    const int together = sector->joint && patch->at.facets == 2;
    const sector_rows rows =
        sector_rows_make(p, together ? lrcsi_patch_sector(p, at->facet) : at->facet, in->band);
    const int few = sector->joint && rows_are_few(lrcsi_patch_part(p, at->facet), &rows);
    lrcsi_linear linear;
    patch_correction own;
    patch_correction other = {0, 0, 0, 1};
    if (!lrcsi_linear_make(in->view, &brdf, patch, &at->bounds, sector->deviation.second,
                           few ? &rows.range : NULL, &linear) ||
        !correction_make(in, at, at->facet, &linear, &own) ||
        (together &&
         !correction_make(in, at, lrcsi_patch_partner(p, at->facet), &linear, &other))) {
        return 0;
    }
    own.error += (1 + a) * linear.variation * at->fractions.margin_max;
    if (together) {
        const uint32_t partner = lrcsi_patch_partner(p, at->facet);
        const lrcsi_patch_fractions f =
            lrcsi_patch_fractions_of(&at->pair[partner - lrcsi_patch_sector(p, partner)], partner,
                                     in->visible, in->band, in->margins);
        other.error += (1 + a) * linear.variation * f.margin_max;
    }
    lrcsi_deviation deviation = linear_deviation(&at->deviation.of_f, a, &linear, patch);
    lrcsi_deviation both = linear_deviation(&sector->deviation, a, &linear, patch);
    sector_bound choice = {BY_POINT, 1, 0, 0};
    if (few) {
        choice = (sector_bound){BY_ROWS, rows.all - rows.open, rows.open, 0};
    } else if (sector->joint) {
        choice = sector_choose(in, at, &both, stretch);
    } else {
        deviation.region *= own.ratio;
        double by_region = bound_by_region(&deviation, stretch);
        double by_point = bound_by_point(&deviation, stretch, a, at->fractions.visible);
        choice.method = by_region < by_point ? BY_REGION : BY_POINT;
    }
    *error = error_by(&at->fractions, a, at->state, at->partner, &deviation, stretch, &choice);
    error->above += own.error;
    error->below += own.error;
    error->glint = own.glint;
    error->diffuse = own.diffuse;
    error->corrected = linear.scale;
    if (!together) {
        return error->above <= constant->above && error->below <= constant->below;
    }
    lrcsi_tessellation with = sector_error(in, at, &both, &choice, own.error, other.error);
    lrcsi_tessellation without = sector_error(in, at, &sector->deviation, &sector->bound, 0, 0);
    return with.above <= without.above && with.below <= without.below;
}

lrcsi_tessellation lrcsi_wall_error(const lrcsi_tessellation_input *in, const lrcsi_wall_facet *at)
{
    const lrcs_prepared *p = in->view->prepared;
    const lrcsi_patch *patch = at->deviation.patch;
    const int alone = lrcsi_patch_part(p, at->facet)->kind == LRCS_SHAPE_CONE ||
                      (patch && patch->at.facets == 1); /* in its sector */
    const uint32_t first = alone ? at->facet : lrcsi_patch_sector(p, at->facet);
    const int whole = at->state == LRCSI_PATCH_VISIBLE && at->partner == LRCSI_PATCH_VISIBLE;
    wall_sector sector = {.joint = lrcsi_patch_is_visible(at->state) &&
                                   lrcsi_patch_is_visible(at->partner) && !whole,
                          .deviation = at->deviation.of_f,
                          .bound = {BY_POINT, 1, 0, 0}};
    if (sector.joint) {
        double stretch = at->deviation.stretch;
        if (first != at->facet) {
            lrcsi_patch_deviation d = patch_deviation(in, first, &at->pair[0], &at->bounds, patch);
            sector.deviation = d.of_f;
            stretch = d.stretch;
        }
        sector.bound = sector_choose(in, at, &sector.deviation, stretch);
    }
    lrcsi_tessellation error = error_by(&at->fractions, at->area_err, at->state, at->partner,
                                        &at->deviation.of_f, at->deviation.stretch, &sector.bound);
    lrcsi_tessellation corrected;
    return in->moment && in->band && patch && lrcsi_patch_is_visible(at->state) && !whole &&
                   corrected_error(in, at, &sector, &error, &corrected)
               ? corrected
               : error;
}
