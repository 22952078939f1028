/* SPDX-License-Identifier: MIT */
/* The tessellation error of one facet under shadowing. It combines the deviation of F = f_r cos^2
   over the facet's patch (optics/deviation.c) with the fraction of the facet on which the true
   shapes and the facets may differ in what is visible (visibility/proximity_band.h).

   Let f be the facet, of area S, and U its patch, whose area differs from S by at most a S. Let v
   be 1 where a point of U is visible and 0 where it is not, and w the same for points of f. They
   agree except on a fraction g of both where v is 1 and w is 0 (gain), and on a fraction l where v
   is 0 and w is 1 (loss). The true value is T = Int_U F v, and that of the facet M = F_i Int_f w,
   where F_i is F at the facet's normal or, if that is known, its mean over the patch
   (patch_deviation). Upper and lower bounds of T - M follow; the sums of each over all facets bound
   the error of sigma.
   - The facet is visible everywhere, and g = l = 0: |T - M| is at most the deviation of the whole
     patch. This deviation holds for the two facets of a sector together, so both must be visible.
   - It is hidden except for a fraction h: 0 <= M <= S h F_i and 0 <= T <= (1 + a) S (g + h) sup F.
   - Otherwise, T - M = Int_U (F - F_i) v + F_i (Int_U v - Int_f w), where the first term is at most
     (1 + a) S sup |F - F_i| in size and the second between -F_i S (a + (1 + a) l) and F_i S (a + (1
     + a) g); and |T - M| <= (1 + a) S sup F. Where neither facet of the sector is hidden or unlit,
     the first term of both together is at most the integral of F - F_i over some region of both
     patches. And v is 1 on at most a fraction q of the patch: g, plus the fraction of the facet
     that may be visible. The first term is at most (1 + a) S q sup |F - F_i|, and the part of the
     second that is due to a is at most F_i S a q.
   - All but a fraction h of it is visible: T - M = Int_U (F - F_i) - Int_U F (1 - v) + F_i Int_f (1
     - w), where 0 <= Int_f (1 - w) <= S h, and 0 <= Int_U F (1 - v) <= (1 + a) S (h + l) sup F.
   - The facet faces away from the laser: M is 0. Its patch may be lit in part, and T is at most the
     deviation.
   - The laser may see parts of a patch from its other side. On a two-sided part that is not closed
     these reflect as well, even if the facet is hidden: T exceeds the bounds above by at most
     (1 + a) S sup F of that side.
   If a scale that differs between axes stretches areas within a patch unevenly, the areas of
   regions differ by more than that of the whole patch: a is then patch_area_error, except in the
   deviation of the whole patch. On flat facets a = 0 and F = F_i.

   More is known of a sector of a straight wall (cylinder, cone, frustum). Its map onto the facets
   takes rows to rows and stretches area evenly (mesh/profile.c), also after an affine map; F, and
   the additional stretch of an affine map, depend on azimuth alone. So over any set of whole rows,
   a fraction q of the sector, the integral of F - F_i is q times its integral over the sector, and
   every bound on the deviation of the whole patch, or of a region, holds q times. Rows that meet no
   proximity band are visible over their whole length or nowhere (visibility/proximity_band.h):
   these are a fraction q <= 1. The other rows are a fraction m of the area, at most twice their
   fraction of the height, since no row of a trapezoid is longer than twice the mean. Together, for
   a sector of which no facet is hidden or unlit: T - M <= S (whole + m region + F_i (m a + (1 + a)
   g)), and M - T likewise with l.

   A facet that is partly visible, or whose sector is, may be summed with a linear function l of
   position on the facets in place of F_i (integrate/linear.h): M' = Int_f l w. It exceeds M by the
   correction Int_f (l - F_i) w, which follows from the area and the first moment of what is
   visible. Then everything above holds with M' for M, l for F_i, and the bounds of linear.h for
   those of F - F_i: F_i in a bound becomes an upper bound of l, which is nowhere negative. Two more
   things:
   - Over a whole row of a straight wall l - F_i is antisymmetric, so that its integral is 0, and
     what was said of rows holds.
   - If the other facet of the sector is hidden or unlit, the integral of F - l over a region of
     this facet's patch alone still has the bound of the whole sector: per unit of this facet's
     area, it is the sector's area divided by this facet's times as large.
   The correction is made where neither bound, above or below, becomes larger by it: then no sum of
   bounds does. Both facets of a sector must do the same if none of them is hidden or unlit, since
   the bound of a region is that of both together; there the sums of their bounds are compared.

   Without a proximity band the facets count as visible: the bounds of the visible areas then
   include what may be hidden, both of the true surface and of the facets. */
#include "integrate/tessellation.h"

#include <math.h>

#include "base/constant.h"
#include "integrate/linear.h"
#include "mesh/profile.h"
#include "optics/reflect.h"
#include "scene/proximity.h"

/* The turn that flat facets count as having: it is larger than the error of their angles. */
#define FLAT_TILT 1e-12
/* A facet of which at most this fraction can be visible counts as hidden; what may be visible of it
   is then part of its error. */
#define HIDDEN_FRACTION 0x1p-20

/* What is known about the visibility of a facet and its patch. */
enum patch_state {
    PATCH_UNLIT,   /* no side of the facet that reflects faces the laser */
    PATCH_VISIBLE, /* facet and patch are entirely visible */
    PATCH_HIDDEN,  /* the facet is hidden, except for at most HIDDEN_FRACTION of it */
    PATCH_PARTIAL  /* none of these */
};

static const lrcs_part *patch_part(const lrcs_prepared *p, uint32_t facet)
{
    return &p->scene->part[p->scene->facet_part[facet]];
}

/* The curvature of a facet's patch: that of the curved wall, or of a disc that rounding in placing
   may have tilted. */
static lrcs_curvature patch_curvature(const lrcs_prepared *p, uint32_t facet)
{
    const lrcs_part *part = patch_part(p, facet);
    const lrcs_curvature flat = {FLAT_TILT, 0, 0, 0};
    if (p->scene->facet_smooth[facet] != 0 && part->curvature.turn > 0) {
        return part->curvature;
    }
    return part->normal_err > 0 ? lrcsi_profile_rounded(&flat, part->normal_err) : flat;
}

/* Does the back of a facet face the laser and reflect? The inside of a closed curved part is always
   hidden, even if rounding has turned a facet of it towards the laser. */
static int back_is_lit(const lrcsi_view *view, uint32_t facet)
{
    const lrcs_part *part = patch_part(view->prepared, facet);
    return view->facing[facet] < 0 && lrcsi_view_reflects(view, facet) &&
           !(part->reach > 0 && part->solid);
}

static int patch_state_of(const lrcsi_view *view, uint32_t facet, const lrcsi_visible *visible,
                          const lrcsi_proximity_band *band)
{
    if (band && band->hidden[band->region[facet]]) {
        return PATCH_HIDDEN;
    }
    if (view->facing[facet] <= 0 && !back_is_lit(view, facet)) {
        return PATCH_UNLIT;
    }
    if (!band || (band->mismatch[facet] == 0 && !band->classification->undecided[facet] &&
                  visible[facet].low > 0)) {
        return PATCH_VISIBLE;
    }
    return visible[facet].high > HIDDEN_FRACTION * lrcsi_view_projected(view, facet) ? PATCH_PARTIAL
                                                                                     : PATCH_HIDDEN;
}

/* An upper bound of the visible fraction of a facet that counts as hidden. */
static double hidden_facet_fraction(const lrcsi_incidence *incidence, uint32_t facet,
                                    const lrcsi_visible *visible, const lrcsi_proximity_band *band)
{
    return !band || band->hidden[band->region[facet]] || !(visible[facet].high > 0)
               ? 0
               : fmin(1, visible[facet].high / incidence->projected * (1 + 2 * incidence->error));
}

/* The state of the other facet of the sector. The two are neighbours in the part's list of facets,
   in which every strip of a wall begins at an even index (mesh/tessellate.c). In a strip that ends
   in an apex each facet has a sector of its own, and its neighbour in the list is used instead. */
static int partner_state(const lrcsi_view *view, uint32_t facet, const lrcsi_visible *visible,
                         const lrcsi_proximity_band *band)
{
    const lrcs_prepared *p = view->prepared;
    uint32_t first = patch_part(p, facet)->first_facet;
    uint32_t other = first + ((facet - first) ^ 1);
    return p->skip[other] ? PATCH_HIDDEN : patch_state_of(view, other, visible, band);
}

static int is_lit(int state)
{
    return state == PATCH_VISIBLE || state == PATCH_PARTIAL;
}

/* Upper bounds of fractions of a facet: */
typedef struct patch_fractions {
    double hidden; /* hidden, or not known to be visible, by facets */
    double gain, loss;
    double lit; /* visible on the true surface */
} patch_fractions;

/* The fractions of a facet. Only hidden parts may be gained, and only visible parts lost. */
static patch_fractions patch_fractions_of(const lrcsi_incidence *incidence, uint32_t facet,
                                          const lrcsi_visible *visible,
                                          const lrcsi_proximity_band *band)
{
    double error = incidence->error + 8 * LRCSI_U;
    patch_fractions f = {0, 0, 0, 1};
    if (!band) {
        return f;
    }
    if (band->classification->undecided[facet] || !(visible[facet].low > 0)) {
        f.hidden = 1 + error - visible[facet].low / incidence->projected;
    }
    f.hidden = f.hidden >= 0 ? fmin(1, f.hidden) : 1;
    double visible_most = visible[facet].high / incidence->projected * (1 + 2 * error);
    f.gain = fmin(band->gain[facet], f.hidden);
    f.loss = fmin(band->loss[facet], visible_most);
    f.lit = visible_most + f.gain <= 1 ? visible_most + f.gain : 1;
    return f;
}

/* A bound on the relative difference between the area of a region of a patch and that of its image
   on the facet. It combines the difference of the whole patch with the variation of the stretch
   over the patch. */
static double patch_area_error(const lrcs_prepared *p, uint32_t facet, const lrcs_curvature *c)
{
    double uneven = patch_part(p, facet)->stretch_err;
    return c->area_error + uneven + c->area_error * uneven;
}

/* The deviation of F over a patch from F_i, the value that the sum uses for the facet. *stretch: a
   bound on the relative difference of areas, as patch_area_error, to be multiplied by F_i.

   Where the sum uses the mean over the patch (integrate/patch.h), F_i = (1 + a') F^, where F^ is
   the mean per unit of the patch's own area, which is 1 + a' times the facet's. The map stretches
   area evenly, except for rounding (patch->area_err): so over a region E, T - M = Int_E (F - F^),
   and the stretch drops out. With h = F - F(facet normal), max(Int h+, Int h-) <= S region, so that
       Int_U |h| = 2 max - |Int_U h| <= S (2 region) - (1 + a') S |F^ - F(facet normal)|,
       Int_U |F - F^| <= Int_U |h| + (1 + a') S |F^ - F(facet normal)| <= S (2 region),
       |Int_E (F - F^)| <= (Int_U |F - F^| + |Int_U (F - F^)|) / 2 <= S (region + remainder / 2).
   At a single point F^ differs from F(facet normal) by at most |F_i - F(facet normal)| + a F_i.
   Where a scale that differs between axes stretches areas unevenly, the stretch over E and its mean
   over the patch are both within a factor of 1 + uneven of that of the facet: T - M has also F^
   times their difference, at most ((1 + uneven)^2 - 1) F_i per unit of E. */
static void deviation_about_mean(const lrcs_prepared *p, uint32_t facet, const lrcsi_patch *patch,
                                 lrcsi_deviation *deviation, double *stretch)
{
    double mean = patch->glint + patch->diffuse;
    double error = patch->remainder + patch->rounding;
    double difference = fabs(mean - deviation->value) + error + 2e-10 * deviation->value;
    deviation->whole = fmin(patch->remainder, deviation->whole + difference);
    deviation->region += error;
    deviation->point += difference + *stretch * (mean + error);
    deviation->value = mean + error;
    double uneven = patch_part(p, facet)->stretch_err;
    *stretch = patch->area_err + uneven * (2 + uneven);
}

/* The same for a facet, whose patch is made; *has_mean: whether the sum uses its mean. */
static lrcsi_deviation patch_deviation(const lrcsi_view *view, const lrcsi_plan *plan,
                                       uint32_t facet, const lrcsi_incidence *incidence,
                                       const lrcs_curvature *c, lrcsi_patch *patch, double *stretch,
                                       int *has_mean)
{
    lrcs_brdf brdf = lrcsi_plan_brdf(plan, lrcsi_prepared_material(view->prepared, facet));
    double cosine = fabs(incidence->cos_theta);
    lrcsi_deviation deviation = lrcsi_deviation_make(&brdf, cosine, incidence->tan2, c);
    *stretch = patch_area_error(view->prepared, facet, c);
    *has_mean = c->turn > FLAT_TILT && lrcsi_patch_make(view, plan, &brdf, facet, patch);
    if (*has_mean) {
        deviation_about_mean(view->prepared, facet, patch, &deviation, stretch);
    }
    return deviation;
}

/* The alternative bounds for a sector of which no facet is hidden or unlit, by what they use. */
enum sector_method {
    BY_REGION, /* the deviation over any region of both patches */
    BY_POINT,  /* the deviation at any point, times what is visible of the facet */
    BY_HIDDEN, /* what is hidden of the facet, subtracted from the whole patch */
    BY_ROWS    /* the deviation of the whole patch, and of the rows that meet a proximity band */
};
typedef struct sector_bound {
    int method;   /* sector_method */
    double rows;  /* BY_ROWS: the fraction of the sector in rows that meet a proximity band */
    double error; /* the larger error of both facets, per unit of area */
} sector_bound;

/* An upper bound of the fraction of a facet's sector in rows that meet a proximity band; 1 if it
   has no rows. Each facet of a cone has a sector of its own. */
static double sector_rows(const lrcsi_view *view, uint32_t facet, const lrcsi_proximity_band *band)
{
    const lrcs_part *part = patch_part(view->prepared, facet);
    uint32_t other = part->first_facet + ((facet - part->first_facet) ^ 1);
    if (!lrcsi_proximity_has_rows(view->prepared, facet)) {
        return 1;
    }
    double rows = band->rows[facet] + (part->kind == LRCS_SHAPE_CONE ? 0 : band->rows[other]);
    return fmin(1, 2 * rows);
}

/* The first facet of a sector. */
static uint32_t sector_first(const lrcs_prepared *p, uint32_t facet)
{
    uint32_t begin = patch_part(p, facet)->first_facet;
    return begin + ((facet - begin) & ~UINT32_C(1));
}

/* Chooses the smallest of these bounds, for both facets of the sector: from the deviation of the
   first facet (on a cone, of the facet itself), and the larger fractions of both. */
static sector_bound sector_choose(const lrcsi_view *view, uint32_t facet,
                                  const lrcsi_incidence pair[2], const lrcs_curvature *c,
                                  const lrcsi_visible *visible, const lrcsi_proximity_band *band,
                                  const lrcsi_deviation *deviation, double stretch)
{
    const lrcs_part *part = patch_part(view->prepared, facet);
    uint32_t first = sector_first(view->prepared, facet);
    const patch_fractions one = patch_fractions_of(&pair[0], first, visible, band);
    const patch_fractions two = patch_fractions_of(&pair[1], first + 1, visible, band);
    double hidden = fmax(one.hidden + one.loss, two.hidden + two.loss);
    double a = patch_area_error(view->prepared, facet, c);
    double rows = sector_rows(view, part->kind == LRCS_SHAPE_CONE ? facet : first, band);
    double b = fmax(fmax(one.gain, one.loss), fmax(two.gain, two.loss));
    double by_hidden = deviation->whole + (1 + a) * hidden * deviation->value_max;
    double by_rows = deviation->whole + rows * (deviation->region + stretch * deviation->value) +
                     (1 + a) * b * deviation->value;
    double lit = fmax(one.lit, two.lit);
    double by_region = deviation->region + stretch * deviation->value;
    double by_point = lit * ((1 + a) * deviation->point + stretch * deviation->value);
    double either = fmin(by_region, by_point);
    double by_either =
        fmin(either + (1 + a) * b * deviation->value, (1 + a) * deviation->value_max);
    sector_bound bound = {by_point < by_region ? BY_POINT : BY_REGION, rows, by_either};
    if (by_rows < fmin(by_hidden, by_either)) {
        bound.method = BY_ROWS;
        bound.error = by_rows;
    } else if (by_hidden < either) {
        bound.method = BY_HIDDEN;
        bound.error = by_hidden;
    }
    return bound;
}

/* The error of a facet on a curved wall, per unit of its area. Given: a; the fractions of the
   facet; the states of the facet and of the other facet of its sector. If the facet is hidden, gain
   and loss include what may be visible of it. */
static lrcsi_tessellation wall_error(const lrcsi_deviation *deviation, double a, double stretch,
                                     const patch_fractions *f, int state, int partner,
                                     const sector_bound *bound)
{
    double sup = (1 + a) * deviation->value_max;
    double lit = f->lit * ((1 + a) * deviation->point + stretch * deviation->value);
    if (state == PATCH_HIDDEN) {
        return (lrcsi_tessellation){f->gain * sup, f->loss * sup, 0, 0, 0};
    }
    if (state == PATCH_UNLIT) {
        return (lrcsi_tessellation){partner == PATCH_UNLIT ? deviation->whole : sup, 0, 0, 0, 0};
    }
    if (state == PATCH_VISIBLE && partner == PATCH_VISIBLE) {
        return (lrcsi_tessellation){deviation->whole, deviation->whole, 0, 0, 0};
    }
    if (bound->method == BY_HIDDEN) {
        return (lrcsi_tessellation){deviation->whole + f->hidden * sup,
                                    deviation->whole + fmin(1, f->hidden + f->loss) * sup, 0, 0, 0};
    }
    if (bound->method == BY_ROWS) {
        lit = deviation->whole + bound->rows * (deviation->region + stretch * deviation->value);
        sup = HUGE_VAL;
    } else if (bound->method == BY_REGION) {
        lit = deviation->region + stretch * deviation->value;
    }
    return (lrcsi_tessellation){fmin(lit + deviation->value * (1 + a) * f->gain, sup),
                                fmin(lit + deviation->value * (1 + a) * f->loss, sup), 0, 0, 0};
}

/* --- linear functions ------------------------------------------------------------------------- */

/* What is known about a facet on a curved wall. */
typedef struct patch_case {
    const lrcsi_view *view;
    const lrcsi_plan *plan;
    uint32_t facet;
    const lrcs_curvature *c;
    const lrcsi_visible *visible;
    const lrcsi_moment *moment;
    const lrcsi_proximity_band *band;
    int state, partner;          /* of the facet, and of the other one of its sector */
    const lrcsi_incidence *pair; /* of both, in their order; the other's only if both are lit */
    const patch_fractions *f;
    const lrcsi_deviation *deviation;
    double stretch;
    const lrcsi_patch *patch;
    int has_mean; /* the sum uses the patch's mean */
} patch_case;

/* The correction of a facet and the error of that, per unit of area. */
typedef struct patch_correction {
    double glint, diffuse, error;
    double ratio; /* the area of the sector divided by the facet's */
} patch_correction;

/* The integral of l - F_i over what is visible of a facet, in the view plane, divided by its
   projected area. An error of the moment counts with the slope; rounding is part of
   linear->rounding, except for the projected area. Returns 0 if the moment is not known. */
static int correction_make(const patch_case *at, uint32_t facet, const lrcsi_linear *linear,
                           patch_correction *correction)
{
    const lrcsi_incidence incidence = at->pair[facet - sector_first(at->view->prepared, facet)];
    lrcsi_linear_moment m = lrcsi_linear_moment_make(at->view, facet, at->patch,
                                                     &at->visible[facet], &at->moment[facet]);
    const double x = m.first[0] / incidence.projected;
    const double y = m.first[1] / incidence.projected;
    correction->ratio = m.ratio;
    correction->glint = linear->glint[0] * x + linear->glint[1] * y;
    correction->diffuse = linear->diffuse[0] * x + linear->diffuse[1] * y;
    correction->error = linear->slope * m.error / (incidence.projected * (1 - incidence.error)) +
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

/* The error, per unit of area, of a facet of a closed part whose inside seems to be visible because
   of rounding. */
static double inside_error(const lrcsi_view *view, uint32_t facet, const lrcs_brdf *brdf,
                           const lrcsi_incidence *incidence, const lrcsi_visible *visible,
                           const lrcsi_proximity_band *band)
{
    const lrcs_curvature flat = {FLAT_TILT, 0, 0, 0};
    if (!band || view->facing[facet] >= 0 || !lrcsi_view_reflects(view, facet) ||
        !(visible[facet].high > 0)) {
        return 0;
    }
    double sup =
        lrcsi_deviation_make(brdf, -incidence->cos_theta, incidence->tan2, &flat).value_max;
    return sup * fmin(1, visible[facet].high / incidence->projected);
}

/* An upper bound of what a patch may reflect from its other side, the one that the facet turns away
   from the laser, per unit of the facet's area. */
static double other_side(const lrcsi_view *view, uint32_t facet, const lrcs_brdf *brdf,
                         const lrcsi_incidence *incidence, const lrcs_curvature *c,
                         const lrcsi_proximity_band *band)
{
    const lrcs_prepared *p = view->prepared;
    if (!(c->turn > FLAT_TILT) || patch_part(p, facet)->solid ||
        !lrcsi_prepared_material(p, facet)->two_sided ||
        (band && band->hidden[band->region[facet]])) {
        return 0;
    }
    double cosine = -fabs(incidence->cos_theta);
    return (1 + patch_area_error(p, facet, c)) *
           lrcsi_deviation_make(brdf, cosine, incidence->tan2, c).value_max;
}

/* The sum of the errors of both facets of a sector: with the deviation of the first one and the
   choice for the sector. */
static lrcsi_tessellation sector_error(const patch_case *at, const lrcsi_deviation *deviation,
                                       const sector_bound *bound, double own_err, double other_err)
{
    const lrcs_prepared *p = at->view->prepared;
    const double a = patch_area_error(p, at->facet, at->c);
    uint32_t first = sector_first(p, at->facet);
    lrcsi_tessellation sum = {0, 0, 0, 0, 0};
    for (uint32_t facet = first; facet < first + 2; facet++) {
        int own = facet == at->facet;
        patch_fractions f =
            patch_fractions_of(&at->pair[facet - first], facet, at->visible, at->band);
        lrcsi_tessellation error =
            wall_error(deviation, a, at->stretch, &f, own ? at->state : at->partner,
                       own ? at->partner : at->state, bound);
        double err = own ? own_err : other_err;
        sum.above += p->normal[facet].length * (error.above + err);
        sum.below += p->normal[facet].length * (error.below + err);
    }
    return sum;
}

/* Makes the error with a correction. Returns 1 if neither of its bounds is larger than that of
   `constant`, the error without one: then no sum of errors is. Given: `sector`, the deviation of
   the sector's first facet, and `bound`, its choice without a correction, if both facets are lit
   and one of them is partly visible (joint). Then the bounds of both facets together are compared,
   if they share a patch. */
static int corrected_error(const patch_case *at, int joint, const lrcsi_deviation *sector,
                           const sector_bound *bound, const lrcsi_tessellation *constant,
                           lrcsi_tessellation *error)
{
    const lrcs_prepared *p = at->view->prepared;
    const lrcs_brdf brdf = lrcsi_plan_brdf(at->plan, lrcsi_prepared_material(p, at->facet));
    const double a = patch_area_error(p, at->facet, at->c);
    const int shared = at->patch->at.facets == 2;
    const uint32_t first = sector_first(p, at->facet);
    lrcsi_linear linear;
    patch_correction own;
    patch_correction other = {0, 0, 0, 1};
    if (!lrcsi_linear_make(at->view, &brdf, at->patch, at->c, sector->second, &linear) ||
        !correction_make(at, at->facet, &linear, &own) ||
        (joint && shared && !correction_make(at, first + (at->facet == first), &linear, &other))) {
        return 0;
    }
    lrcsi_deviation deviation = linear_deviation(at->deviation, a, &linear, at->patch);
    lrcsi_deviation both = linear_deviation(sector, a, &linear, at->patch);
    sector_bound choice = {BY_POINT, 1, 0};
    if (joint) {
        choice = sector_choose(at->view, at->facet, at->pair, at->c, at->visible, at->band, &both,
                               at->stretch);
    } else {
        deviation.region *= own.ratio;
        double by_region = deviation.region + at->stretch * deviation.value;
        double by_point = at->f->lit * ((1 + a) * deviation.point + at->stretch * deviation.value);
        choice.method = by_region < by_point ? BY_REGION : BY_POINT;
    }
    *error = wall_error(&deviation, a, at->stretch, at->f, at->state, at->partner, &choice);
    error->above += own.error;
    error->below += own.error;
    error->glint = own.glint;
    error->diffuse = own.diffuse;
    error->corrected = 1;
    if (!joint || !shared) {
        return error->above <= constant->above && error->below <= constant->below;
    }
    lrcsi_tessellation with = sector_error(at, &both, &choice, own.error, other.error);
    lrcsi_tessellation without = sector_error(at, sector, bound, 0, 0);
    return with.above <= without.above && with.below <= without.below;
}

/* Computes the error of a facet on a curved wall, per unit of area, and its correction. If both
   facets of the sector are lit and one of them is partly visible, they choose together. */
static lrcsi_tessellation curved_error(const patch_case *at)
{
    const lrcs_prepared *p = at->view->prepared;
    const double a = patch_area_error(p, at->facet, at->c);
    const int alone = patch_part(p, at->facet)->kind == LRCS_SHAPE_CONE ||
                      (at->has_mean && at->patch->at.facets == 1); /* in its sector */
    const uint32_t first = alone ? at->facet : sector_first(p, at->facet);
    const int whole = at->state == PATCH_VISIBLE && at->partner == PATCH_VISIBLE;
    const int joint = is_lit(at->state) && is_lit(at->partner) && !whole;
    lrcsi_deviation sector = *at->deviation; /* of the first facet */
    sector_bound bound = {BY_POINT, 1, 0};
    double stretch = at->stretch;
    if (joint && first != at->facet) {
        lrcs_brdf brdf = lrcsi_plan_brdf(at->plan, lrcsi_prepared_material(p, first));
        const lrcsi_incidence incidence = at->pair[0];
        sector = lrcsi_deviation_make(&brdf, fabs(incidence.cos_theta), incidence.tan2, at->c);
        stretch = a;
        if (at->has_mean) {
            deviation_about_mean(p, first, at->patch, &sector, &stretch);
        }
    }
    if (joint) {
        bound = sector_choose(at->view, at->facet, at->pair, at->c, at->visible, at->band, &sector,
                              stretch);
    }
    lrcsi_tessellation error =
        wall_error(at->deviation, a, at->stretch, at->f, at->state, at->partner, &bound);
    lrcsi_tessellation corrected;
    return at->moment && at->band && at->has_mean && is_lit(at->state) && !whole &&
                   corrected_error(at, joint, &sector, &bound, &error, &corrected)
               ? corrected
               : error;
}

int lrcsi_tessellation_known(const lrcs_prepared *p, const lrcsi_plan *plan)
{
    for (uint32_t i = 0; i < p->scene->part_count && plan->unshadowed; i++) {
        if (p->scene->part[i].facet_count != 0 && !p->scene->part[i].curvature_known) {
            return 0;
        }
    }
    return plan->unshadowed || plan->proximity_band ||
           (p->proximity.reach && plan->method == LRCS_METHOD_FACET);
}

lrcsi_tessellation lrcsi_tessellation_error(const lrcsi_view *view, const lrcsi_plan *plan,
                                            uint32_t facet, const lrcsi_incidence *incidence,
                                            const lrcsi_visible *visible,
                                            const lrcsi_moment *moment,
                                            const lrcsi_proximity_band *band, lrcsi_patch *patch)
{
    const lrcs_prepared *p = view->prepared;
    const lrcs_brdf assigned = lrcsi_plan_brdf(plan, lrcsi_prepared_material(p, facet));
    const lrcs_brdf *brdf = &assigned;
    const lrcs_curvature c = patch_curvature(p, facet);
    int is_curved = c.turn > FLAT_TILT;
    int state = patch_state_of(view, facet, visible, band);
    int is_certain = !band || band->mismatch[facet] == 0;
    double area = 0.5 * p->normal[facet].length;
    double seen = is_curved && state == PATCH_HIDDEN
                      ? hidden_facet_fraction(incidence, facet, visible, band)
                      : 0;
    lrcsi_tessellation error = {0, 0, 0, 0, 0};
    error.above = area * other_side(view, facet, brdf, incidence, &c, band);
    if (state == PATCH_UNLIT) {
        error.below = area * inside_error(view, facet, brdf, incidence, visible, band);
    }
    if (is_certain && seen == 0 && (!is_curved || state == PATCH_HIDDEN)) {
        return error;
    }
    int partner = is_curved && band ? partner_state(view, facet, visible, band) : state;
    if (is_curved && state == PATCH_VISIBLE && partner == PATCH_VISIBLE && is_certain &&
        lrcsi_patch_make(view, plan, brdf, facet, patch)) {
        return (lrcsi_tessellation){area * patch->remainder, area * patch->remainder, 0, 0, 0};
    }
    double stretch = 0;
    int has_mean = 0;
    lrcsi_deviation deviation =
        state == PATCH_UNLIT
            ? lrcsi_deviation_make(brdf, incidence->cos_theta, incidence->tan2, &c)
            : patch_deviation(view, plan, facet, incidence, &c, patch, &stretch, &has_mean);
    patch_fractions f = {0, 0, 0, 1};
    if (state != PATCH_UNLIT) {
        f = patch_fractions_of(incidence, facet, visible, band);
    }
    lrcsi_tessellation unit = {f.gain * deviation.value_max, f.loss * deviation.value_max, 0, 0, 0};
    if (is_curved) {
        f.gain += seen;
        f.loss += seen;
        uint32_t first = sector_first(p, facet);
        lrcsi_incidence pair[2] = {*incidence, *incidence};
        if (is_lit(state) && is_lit(partner)) {
            uint32_t other = facet == first;
            pair[other] = lrcsi_view_incidence(view, first + other);
        }
        const patch_case at = {view,    plan, facet, &c,         visible, moment, band,    state,
                               partner, pair, &f,    &deviation, stretch, patch,  has_mean};
        unit = curved_error(&at);
    }
    error.above += area * unit.above;
    error.below += area * unit.below;
    error.glint = area * unit.glint;
    error.diffuse = area * unit.diffuse;
    error.corrected = unit.corrected;
    return error;
}

/* Let c be 1 at the points of the patch in the interval and k at those of the facet, and 0
   elsewhere. Mapped to the facet, c v and k w differ on at most a fraction d: that on which v and w
   differ, and that within the reach of an end of the interval. Let m be the fraction of the facet
   on which c may be 1. Since every region of the patch has at most 1 + a times the area of its
   image, |Int_U F c v - F_i Int_f k w| <= Int_U |F - F_i| c v + F_i |Int_U c v - Int_f k w|
                                     <= S [(1 + a) sup |F - F_i| m + F_i (a m + (1 + a) d)],
   and both integrals are at most (1 + a) S sup F m. On a flat facet F = F_i and a = 0. A facet that
   is not lit adds nothing beyond `whole`, and the truth in an interval is at most the whole truth.
   The bound of the whole patch may hold only for the two facets of a sector together. */
lrcsi_patch_parts lrcsi_tessellation_parts(const lrcsi_view *view, const lrcsi_plan *plan,
                                           uint32_t facet, const lrcsi_incidence *incidence,
                                           const lrcsi_visible *visible,
                                           const lrcsi_proximity_band *band, lrcsi_patch *patch)
{
    const lrcs_prepared *p = view->prepared;
    const lrcs_curvature c = patch_curvature(p, facet);
    int is_curved = c.turn > FLAT_TILT;
    int state = patch_state_of(view, facet, visible, band);
    lrcsi_tessellation error =
        lrcsi_tessellation_error(view, plan, facet, incidence, visible, NULL, band, patch);
    lrcsi_patch_parts parts = {.whole = fmax(error.above, error.below),
                               .lit = is_lit(state),
                               .mismatch = band ? band->mismatch[facet] : 0,
                               .partner = facet};
    uint32_t first = patch_part(p, facet)->first_facet;
    uint32_t partner = first + ((facet - first) ^ 1);
    if (is_curved && partner < first + patch_part(p, facet)->facet_count && !p->skip[partner]) {
        parts.partner = partner;
    }
    if (parts.lit) {
        double stretch;
        int has_mean;
        lrcsi_deviation deviation =
            patch_deviation(view, plan, facet, incidence, &c, patch, &stretch, &has_mean);
        double area = 0.5 * p->normal[facet].length;
        double a = is_curved ? patch_area_error(p, facet, &c) : 0;
        lrcs_brdf brdf = lrcsi_plan_brdf(plan, lrcsi_prepared_material(p, facet));
        double other = other_side(view, facet, &brdf, incidence, &c, band);
        parts.deviation =
            is_curved ? area * ((1 + a) * deviation.point + stretch * deviation.value + other) : 0;
        parts.shift = area * (1 + a) * deviation.value;
        parts.upper_bound = area * ((1 + a) * deviation.value_max + other);
    }
    return parts;
}
