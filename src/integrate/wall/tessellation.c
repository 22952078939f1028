/* SPDX-License-Identifier: MIT */
/* The tessellation error of one facet under shadowing. It combines the deviation of F = f_r cos^2
   over the facet's patch (optics/deviation.c) with the fraction of the facet on which the true
   shapes and the facets may differ in what is visible (visibility/proximity/proximity_band.c).

   Let f be the facet, of area S, and U its patch, whose area differs from S by at most a S. Let v
   be 1 where a point of U is visible and 0 where it is not, and w the same for points of f. They
   agree except on a fraction g of both where v is 1 and w is 0 (gain), and on a fraction l where v
   is 0 and w is 1 (loss). The true value is T = Int_U F v, and that of the facet M = F_i Int_f w,
   where F_i is F at the facet's normal or, if that is known, its mean over the patch
   (lrcsi_patch_deviation). F is 0 where the patch faces away from the laser. The computed mean is
   at most (1 + a) sup F whatever its remainder, since the weights of its rules are positive. Upper
   and lower bounds of T - M follow; the sums of each over all facets bound the error of sigma.
   - The facet is visible everywhere, and g = l = 0: |T - M| is at most the deviation of the whole
     patch. This deviation holds for the two facets of a sector together, so both must be visible.
   - It is hidden except for a fraction h: 0 <= M <= S h F_i and 0 <= T <= (1 + a) S (g + h) sup F.
   - Otherwise, T - M = Int_U (F - F_i) v + F_i (Int_U v - Int_f w), where the first term is at most
     (1 + a) S sup |F - F_i| in size and the second between -F_i S (a + (1 + a) l) and
     F_i S (a + (1 + a) g); and |T - M| <= (1 + a) S sup F. Where neither facet of the sector is
     hidden or faces away, the first term of both together is at most the integral of F - F_i over
     some region of both patches. And v is 1 on at most a fraction q of the patch: g, plus the
     fraction of the facet that may be visible. The first term is at most (1 + a) S q sup |F - F_i|,
     and the part of the second that is due to a is at most F_i S a q.
   - All but a fraction h of it is visible: T - M = Int_U (F - F_i) - Int_U F (1 - v) +
     F_i Int_f (1 - w), where 0 <= Int_f (1 - w) <= S h, and
     0 <= Int_U F (1 - v) <= (1 + a) S (h + l) sup F.
   - The facet faces away from the laser: M is 0. Its patch may face the laser in part, and T is at
     most the deviation.
   - The laser may see parts of a patch from its other side. On a two-sided part that is not closed
     these reflect as well, even if the facet is hidden: T exceeds the bounds above by at most
     (1 + a) S sup F of that side.
   If a scale that differs between axes stretches areas within a patch unevenly, the areas of
   regions differ by more than that of the whole patch: a is then lrcsi_patch_area_err, except in
   the deviation of the whole patch. On flat facets a = 0 and F = F_i.

   More is known of a sector of a straight wall (cylinder, cone, frustum). Its map onto the facets
   takes rows to rows and stretches area evenly (mesh/shape/revolution.c), also after an affine map;
   F, and the additional stretch of an affine map, depend on azimuth alone. So over any set of whole
   rows, a fraction q of the sector, the integral of F - F_i is q times its integral over the
   sector, and every bound on the deviation of the whole patch, or of a region, is multiplied by q.
   Rows that meet no proximity band are visible over their whole length or nowhere
   (visibility/proximity/proximity_band.c, 5): these are a fraction q <= 1. The other rows are a
   fraction m of the area, at most twice their fraction of the height, since no row of a trapezoid
   is longer than twice the mean. Together, for a sector of which no facet is hidden or faces away:
       T - M <= S (whole + m region + F_i (m a + (1 + a) g)),
   and M - T likewise with l.

   A facet that is partly visible, or whose sector is, may be summed with a linear function l of
   position on the facets in place of F_i (integrate/wall/linear.h): M' = Int_f l w. It exceeds M by
   the correction Int_f (l - F_i) w, which follows from the area and the first moment of what is
   visible. Then everything above holds with M' for M, l for F_i, and the bounds of linear.h for
   those of F - F_i: F_i in a bound becomes an upper bound of l, which is nowhere negative. Two more
   things:
   - Over a whole row of a straight wall l - F_i is antisymmetric, so that its integral is 0, and
     what was said of rows holds.
   - If the other facet of the sector is hidden or faces away, the integral of F - l over a region
     of this facet's patch alone still has the bound of the whole sector: per unit of this facet's
     area, it is the sector's area divided by this facet's times as large.
   The correction is made where neither bound, above or below, becomes larger by it: then no sum of
   bounds does. Both facets of a sector must do the same if none of them is hidden or faces away,
   since the bound of a region is that of both together; there the sums of their bounds are
   compared.

   On a flat face whose margins are used (integrate/wall/flat_face.h) v and w are compared where V
   and U overlap, instead of by the map: visibility/proximity/event_band.c, 6. F is constant on V,
   so the integrals over all facets f of the face satisfy
       T - M = sum of Int_f (F - F_i) w  +  F (Int_V v - Int_U w),
   where the last difference is the area of the margins, up to its error, and for each facet at most
   S g above and S l below, g and l of aligned points. The area of the margins is summed with F_i of
   one facet. The first term, and the change of areas by rounding, are at most (1 + a) S sup |F -
   F_i| and S a (1 + a) sup F. For a facet without bands (mismatch 0) the comparison by the map
   gives the same, since v and w are constant on it and around it.

   On a straight wall the sum may include the margins of other parts' event edges
   (visibility/proximity/wall_margin.c): the area by which the true shapes leave more visible in
   them is attributed to the facets there, A to this one, and A F_i is added to M. Then g and
   l are the fractions of the other bands, and T - M has one more term: the integral of F over the
   margins, less A F_i for each facet, where F may be that of a patch some sectors away. Let D be a
   bound on the area in the margins, and E one on the error of A, both divided by the facet's
   projected area. The term is at most (1 + a) S (D sup |F - F_i| + E sup F), and S D F_i a for the
   stretch; with l in place of F_i, also S D sup |l - F_i|. The suprema are over the facet's own
   patch, and over those patches for what of D may be on other facets. Together with M, the bound
   (1 + a) S sup F is increased by the size of A F_i. Of a facet that the sum leaves out, D sup F is
   an error instead.

   Without a proximity band the facets count as visible: the bounds of the visible areas then
   include what may be hidden, both of the true surface and of the facets. */
#include "integrate/wall/tessellation.h"

#include <math.h>

#include "base/constant.h"
#include "base/outward.h"
#include "base/range.h"
#include "mesh/shape/patch_bounds.h"

/* The turn, rad, that flat facets count as having: more than the error of their unit normals, which
   are computed in double-double and rounded. */
#define FLAT_TURN 1e-12

/* The bounds of a facet's patch: those of the curved wall, or of a disc that rounding in placing
   may have tilted. */
static lrcs_patch_bounds patch_bounds_of(const lrcs_prepared *p, uint32_t facet)
{
    const lrcs_part *part = lrcsi_patch_part(p, facet);
    const lrcs_patch_bounds flat = {FLAT_TURN, 0, 0, 0};
    if (p->scene->facet_smooth[facet] != 0 && part->bounds.patch.turn > 0) {
        return part->bounds.patch;
    }
    return part->bounds.normal_err > 0 ? lrcsi_patch_bounds_rounded(&flat, part->bounds.normal_err)
                                       : flat;
}

/* The error, per unit of area, of a facet of a closed part that faces away, whose inside seems to
   be visible because of rounding. */
static double inside_error(const lrcsi_tessellation_input *in, uint32_t facet,
                           const lrcs_brdf *brdf, const lrcsi_incidence *incidence)
{
    const lrcs_patch_bounds flat = {FLAT_TURN, 0, 0, 0};
    const lrcsi_view *view = in->view;
    if (!in->band || view->facing[facet] >= 0 || !lrcsi_view_reflects(view, facet) ||
        !(in->visible[facet].high > 0)) {
        return 0;
    }
    double sup =
        lrcsi_deviation_make(brdf, -incidence->cos_theta, incidence->tan2, &flat).value_max;
    return sup * fmin(1, in->visible[facet].high / incidence->projected);
}

/* An upper bound of what a patch may reflect from its other side, the one that the facet turns away
   from the laser, per unit of the facet's area. */
static double other_side(const lrcsi_tessellation_input *in, uint32_t facet, const lrcs_brdf *brdf,
                         const lrcsi_incidence *incidence, const lrcs_patch_bounds *bounds)
{
    const lrcs_prepared *p = in->view->prepared;
    if (!(bounds->turn > FLAT_TURN) || lrcsi_patch_part(p, facet)->solid ||
        !lrcsi_prepared_material(p, facet)->two_sided ||
        (in->band && lrcsi_masked_band_is_hidden(in->band, facet))) {
        return 0;
    }
    double cosine = -fabs(incidence->cos_theta);
    return (1 + lrcsi_patch_area_err(p, facet, bounds)) *
           lrcsi_deviation_make(brdf, cosine, incidence->tan2, bounds).value_max;
}

/* The error of a facet on a flat face whose margins are used, per unit of area. The margins belong
   to one facet of the face. At a side of the face, area may be gained beyond the facet; there its
   hidden fraction does not limit the gain. */
static lrcsi_tessellation face_error(const lrcsi_tessellation_input *in, uint32_t facet,
                                     const lrcsi_incidence *incidence,
                                     const lrcs_patch_bounds *bounds, lrcsi_patches *patches)
{
    const lrcs_prepared *p = in->view->prepared;
    const lrcsi_flat_face *face = lrcsi_flat_face_of(in->face, in->view, facet);
    const lrcsi_deviation d =
        lrcsi_patch_deviation_make(in, facet, incidence, bounds, patches).of_f;
    const double area_err = lrcsi_patch_area_err(p, facet, bounds);
    const double point = (1 + area_err) * d.point;
    const double value = (1 + area_err) * d.value_max;
    const double hidden =
        lrcsi_patch_fractions_of(incidence, facet, in->visible, in->band, 0).hidden;
    const double most = lrcsi_flat_face_exceeds(in->view, facet) ? HUGE_VAL : hidden;
    double either = point + area_err * value;
    if (facet == face->facet) {
        const double projected = incidence->projected * (1 - incidence->error);
        either += (value * face->error + point * fabs(face->area)) / projected;
    }
    return (lrcsi_tessellation){
        either + value * fmin(most, lrcsi_masked_gain_aligned(in->band, facet)),
        either + value * lrcsi_masked_loss_aligned(in->band, facet), 0, 0, 0};
}

/* The error of the margins on a facet, per unit of its area. F in them may be that of a patch some
   sectors away (visibility/proximity/wall_margin.h): the normals of facets of successive sectors
   differ by at most 2 `turn`, and those of a patch from its facet's by `turn`. Where the sum does
   not include them, all that they add is an error. */
static double margin_error(const lrcsi_tessellation_input *in, const lrcsi_wall_facet *at,
                           const lrcsi_incidence *incidence, const lrcs_brdf *brdf,
                           const lrcsi_wall_margin *margin)
{
    lrcs_patch_bounds around = at->bounds;
    around.turn *= 2.0 * margin->sectors + 1.0;
    around.rms_turn *= 2.0 * margin->sectors + 1.0;
    const lrcsi_deviation f =
        lrcsi_deviation_make(brdf, fabs(incidence->cos_theta), incidence->tan2, &around);
    const double most = fmax(f.value_max, at->deviation.of_f.value);
    const lrcsi_patch *patch = at->deviation.patch; /* F_i is its mean, `value` at most larger */
    const double mean_err = patch ? patch->remainder + patch->rounding : 0;
    const double varies_far = f.point + fabs(at->deviation.of_f.value - f.value) + mean_err;
    const double varies = lrcsi_min(at->deviation.of_f.point, varies_far);
    const int included = in->visible[at->facet].high > 0;
    const double known =
        included ? (varies + at->area_err * most) * margin->area_max +
                       (varies_far - varies) * lrcsi_min(margin->area_far, margin->area_max)
                 : most * margin->area_max;
    return (1 + at->area_err) * (known + most * margin->area_err) /
           (incidence->projected * (1 - incidence->error)) * LRCSI_OUTWARD_NANO;
}

int lrcsi_tessellation_known(const lrcs_prepared *p, const lrcsi_plan *plan)
{
    for (uint32_t i = 0; i < p->scene->part_count && plan->fronts_visible; i++) {
        if (p->scene->part[i].facet_count != 0 && !p->scene->part[i].bounds.known) {
            return 0;
        }
    }
    return plan->fronts_visible || plan->proximity_band ||
           (p->proximity.reach && plan->method == LRCS_METHOD_FACET);
}

/* 1. What the patch reflects from its other side, and what rounding shows of a closed part's
   inside;
   2. on a flat face whose margins are used: facets with bands, and the one that has the margins;
   3. facets and patches that are entirely hidden, or flat and certain: nothing more;
   4. patches that are entirely visible and have a mean: its remainder;
   5. the deviation of F over the patch, and the fractions of the facet that are gained and lost;
   6. flat facets: those fractions times F; curved walls: lrcsi_wall_error. */
lrcsi_tessellation lrcsi_tessellation_error(const lrcsi_tessellation_input *in, uint32_t facet,
                                            const lrcsi_incidence *incidence,
                                            lrcsi_patches *patches)
{
    const lrcsi_view *view = in->view;
    const lrcs_prepared *p = view->prepared;
    const lrcs_brdf brdf = lrcsi_plan_brdf(in->plan, lrcsi_prepared_material(p, facet));
    const lrcs_patch_bounds bounds = patch_bounds_of(p, facet);
    int is_curved = bounds.turn > FLAT_TURN;
    int state = lrcsi_patch_state_of(view, facet, in->visible, in->band);
    const lrcsi_wall_margin *margin =
        in->margins && in->band ? lrcsi_wall_margin_of(in->band, facet) : NULL;
    int is_certain = !margin && (!in->band || lrcsi_masked_mismatch(in->band, facet) == 0);
    double area = 0.5 * p->normal[facet].length;
    double visible_max = is_curved && state == LRCSI_PATCH_HIDDEN
                             ? lrcsi_patch_visible_max(incidence, facet, in->visible, in->band)
                             : 0;
    lrcsi_tessellation error = {0, 0, 0, 0, 0};
    error.above = area * other_side(in, facet, &brdf, incidence, &bounds); /* 1 */
    if (state == LRCSI_PATCH_AWAY) {
        error.below = area * inside_error(in, facet, &brdf, incidence);
    }
    const lrcsi_flat_face *face = lrcsi_flat_face_of(in->face, view, facet);
    if (in->band && face &&
        (in->band->whole->mismatch[facet] > 0 || face->facet == facet)) { /* 2 */
        const lrcsi_tessellation unit = face_error(in, facet, incidence, &bounds, patches);
        error.above += area * unit.above;
        error.below += area * unit.below;
        return error;
    }
    if (is_certain && visible_max == 0 && (!is_curved || state == LRCSI_PATCH_HIDDEN)) { /* 3 */
        return error;
    }
    int partner = is_curved && in->band
                      ? lrcsi_patch_partner_state(view, facet, in->visible, in->band)
                      : state;
    if (is_curved && state == LRCSI_PATCH_VISIBLE && partner == LRCSI_PATCH_VISIBLE &&
        is_certain) { /* 4 */
        const lrcsi_patch *patch = lrcsi_patch_make(view, in->plan, &brdf, facet, patches);
        if (patch) {
            error.above += area * patch->remainder;
            error.below += area * patch->remainder;
            return error;
        }
    }
    lrcsi_wall_facet at = {.facet = facet, /* 5 */
                           .bounds = bounds,
                           .area_err = lrcsi_patch_area_err(p, facet, &bounds),
                           .state = state,
                           .partner = partner,
                           .pair = {*incidence, *incidence},
                           .fractions = {0, 0, 0, 1, 0, 0}};
    if (state == LRCSI_PATCH_AWAY) {
        at.deviation.of_f =
            lrcsi_deviation_make(&brdf, incidence->cos_theta, incidence->tan2, &bounds);
    } else {
        at.deviation = lrcsi_patch_deviation_make(in, facet, incidence, &bounds, patches);
        at.fractions =
            lrcsi_patch_fractions_of(incidence, facet, in->visible, in->band, in->margins);
    }
    lrcsi_tessellation unit = {at.fractions.gain * at.deviation.of_f.value_max, /* 6 */
                               at.fractions.loss * at.deviation.of_f.value_max, 0, 0, 0};
    if (is_curved) {
        at.fractions.gain += visible_max;
        at.fractions.loss += visible_max;
        uint32_t first = lrcsi_patch_sector(p, facet);
        if (lrcsi_patch_is_visible(state) && lrcsi_patch_is_visible(partner)) {
            uint32_t other = facet == first;
            at.pair[other] = lrcsi_view_incidence(view, first + other);
        }
        unit = lrcsi_wall_error(in, &at);
    }
    if (margin && state != LRCSI_PATCH_AWAY) {
        const double err = margin_error(in, &at, incidence, &brdf, margin);
        unit.above += err;
        unit.below += err;
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
   is not visible adds nothing beyond `whole`, and the truth in an interval is at most the whole
   truth. The bound of the whole patch may hold only for the two facets of a sector together. */
lrcsi_interval_error lrcsi_tessellation_interval(const lrcsi_tessellation_input *in, uint32_t facet,
                                                 const lrcsi_incidence *incidence,
                                                 lrcsi_patches *patches)
{
    const lrcs_prepared *p = in->view->prepared;
    const lrcs_part *part = lrcsi_patch_part(p, facet);
    const lrcs_patch_bounds bounds = patch_bounds_of(p, facet);
    int is_curved = bounds.turn > FLAT_TURN;
    lrcsi_tessellation error = lrcsi_tessellation_error(in, facet, incidence, patches);
    lrcsi_interval_error e = {.whole = fmax(error.above, error.below),
                              .visible = lrcsi_patch_is_visible(
                                  lrcsi_patch_state_of(in->view, facet, in->visible, in->band)),
                              .mismatch = in->band ? lrcsi_masked_mismatch(in->band, facet) : 0,
                              .partner = facet};
    uint32_t partner = lrcsi_patch_partner(p, facet);
    if (is_curved && partner < part->first_facet + part->facet_count && !p->skip[partner]) {
        e.partner = partner;
    }
    if (e.visible) {
        lrcsi_patch_deviation d =
            lrcsi_patch_deviation_make(in, facet, incidence, &bounds, patches);
        double area = 0.5 * p->normal[facet].length;
        double a = is_curved ? lrcsi_patch_area_err(p, facet, &bounds) : 0;
        lrcs_brdf brdf = lrcsi_plan_brdf(in->plan, lrcsi_prepared_material(p, facet));
        double other = other_side(in, facet, &brdf, incidence, &bounds);
        e.deviation =
            is_curved ? area * ((1 + a) * d.of_f.point + d.stretch * d.of_f.value + other) : 0;
        e.shift = area * (1 + a) * d.of_f.value;
        e.upper_bound = area * ((1 + a) * d.of_f.value_max + other);
    }
    return e;
}
