/* SPDX-License-Identifier: MIT */
/* The tessellation error of one facet under shadowing. It combines how F strays over the facet's
   patch (optics/deviation.c) with where truth and facets may differ about what is seen
   (visibility/proximity_band.h), and decides neither.

   Let U be the facet's patch and f the facet, of area S, |U| within a S of it; v and w say what is
   seen of them, off a share b of both alike. Truth T = Int_U F v, the facets' M = F_i Int_f w; F_i
   is F at the facet's normal or, where that is known, its mean over the patch (patch_deviation).
     seen all over, b = 0: T - M is the whole patch's deviation; its numbers hold for the two facets
   of a sector together, so both must be seen; hidden but for a share h: M <= S h F_i and T <= (1 +
   a) S (b + h) sup F, neither below 0; else |T - M| <= |Int_U (F - F_i) v| + F_i |Int_U v - Int_f
   w|
                  <= (1 + a) S sup |F - F_i| + F_i S (a + (1 + a) b), and <= (1 + a) S sup F;
         where neither facet of the sector is hidden or dark, the first term together is at most
   what (F - F_i) integrates to over any part of both. Patches of facets that face away from the
   laser may see it in part: T is at most their deviation. Where a scale that differs between axes
   stretches areas within a patch unevenly, parts of it err by more than the whole: then a is
   patch_area_error, and the whole's deviation has the whole's. On flat facets a = 0 and F = F_i.
   A sector of a straight wall (cylinder, cone, frustum) is better known. Its map onto the facets
   takes rows to rows and stretches area evenly (mesh/profile.c), also after an affine map; F and
   what such a map adds to the stretch depend on azimuth alone. So over any set of whole rows, a
   share q of the sector, F - F_i integrates to q times what it does over all of it, and every bound
   of the whole's deviation and of a part's holds q times over. Rows that meet no band are seen all
   along or not at all (visibility/proximity_band.h): at most q = 1 of them. Others are a share m of
   the area, at most twice their share of the height, since a trapezoid's rows are no longer than
   twice their mean. Together, of a sector none of which is hidden or dark:
                  <= S (whole + m part + F_i (m a + (1 + a) b)).
   Without a margin the facets count as seen: what of it may be hidden is then in the visible area's
   bounds, for truth and facets alike. */
#include "integrate/tessellation.h"

#include <math.h>

#include "base/constant.h"
#include "mesh/profile.h"
#include "optics/reflect.h"
#include "scene/proximity.h"

/* Of a flat facet: wider than the error of its angle. */
#define FLAT_TILT 1e-12
/* A facet of which no larger share can be seen counts as hidden, and this share is charged. */
#define HIDDEN_SHARE 0x1p-20

/* What is known of a facet and its patch. */
enum patch_state {
    PATCH_DARK,   /* no side of it that reflects faces the laser */
    PATCH_SEEN,   /* all of it is seen, in truth too */
    PATCH_HIDDEN, /* no more of the facet is seen than its visible area's bounds leave open */
    PATCH_MIXED
};

static const lrcs_part *patch_part(const lrcs_prepared *p, uint32_t facet)
{
    return &p->scene->part[p->scene->facet_part[facet]];
}

/* The numbers of a facet's patch: a curved wall's, or those of a disc that placing may have tilted.
 */
static lrcs_curvature patch_curvature(const lrcs_prepared *p, uint32_t facet)
{
    const lrcs_part *part = patch_part(p, facet);
    const lrcs_curvature flat = {FLAT_TILT, 0, 0, 0};
    if (p->scene->facet_smooth[facet] != 0 && part->curvature.turn > 0) {
        return part->curvature;
    }
    return part->tilted > 0 ? lrcsi_profile_blurred(&flat, part->tilted) : flat;
}

/* A curved closed part's inside never faces the laser unhidden, whatever rounding made of it. */
static int back_reflects(const lrcsi_view *view, uint32_t facet)
{
    const lrcs_part *part = patch_part(view->prepared, facet);
    return view->facing[facet] < 0 && lrcsi_view_reflects(view, facet) &&
           !(part->reach > 0 && part->solid);
}

static int patch_state(const lrcsi_view *view, uint32_t facet, const lrcsi_visible *visible,
                       const lrcsi_proximity_band *margin)
{
    if (margin && margin->hidden[margin->region[facet]]) {
        return PATCH_HIDDEN;
    }
    if (view->facing[facet] <= 0 && !back_reflects(view, facet)) {
        return PATCH_DARK;
    }
    if (!margin || (margin->share[facet] == 0 && !margin->classification->undecided[facet] &&
                    visible[facet].low > 0)) {
        return PATCH_SEEN;
    }
    return visible[facet].high > HIDDEN_SHARE * lrcsi_view_projected(view, facet) ? PATCH_MIXED
                                                                                  : PATCH_HIDDEN;
}

/* The share of a hidden facet that may be seen. */
static double share_seen(const lrcsi_incidence *incidence, uint32_t facet,
                         const lrcsi_visible *visible, const lrcsi_proximity_band *margin)
{
    return !margin || margin->hidden[margin->region[facet]] || !(visible[facet].high > 0)
               ? 0
               : fmin(1, visible[facet].high / incidence->projected * (1 + 2 * incidence->error));
}

/* The state of the other facet of the sector. The two lie side by side in a part's list, which
   every strip of a wall begins at an even place (mesh/tessellate.c); where a strip ends in an apex,
   its facets have sectors of their own and a neighbour stands in. */
static int partner_state(const lrcsi_view *view, uint32_t facet, const lrcsi_visible *visible,
                         const lrcsi_proximity_band *margin)
{
    const lrcs_prepared *p = view->prepared;
    uint32_t first = patch_part(p, facet)->first_facet;
    uint32_t other = first + ((facet - first) ^ 1);
    return p->skip[other] ? PATCH_HIDDEN : patch_state(view, other, visible, margin);
}

static int is_lit(int state)
{
    return state == PATCH_SEEN || state == PATCH_MIXED;
}

/* The share of a facet that is hidden or undecided, at most. */
static double share_lost(const lrcsi_view *view, uint32_t facet, const lrcsi_visible *visible,
                         const lrcsi_proximity_band *margin)
{
    lrcsi_incidence incidence = lrcsi_view_incidence(view, facet);
    double hidden = 0;
    if (margin->classification->undecided[facet] || !(visible[facet].low > 0)) {
        hidden = 1 + incidence.error + 8 * LRCSI_U - visible[facet].low / incidence.projected;
    }
    return hidden >= 0 ? fmin(1, margin->share[facet] + hidden) : 1;
}

/* The share by which a part of a patch may be larger or smaller than the facet's own part: on top
   of the whole patch's, that of a stretch that differs from place to place. */
static double patch_area_error(const lrcs_prepared *p, uint32_t facet, const lrcs_curvature *c)
{
    double uneven = patch_part(p, facet)->uneven;
    return c->area_error + uneven + c->area_error * uneven;
}

/* How F strays over a patch from the value F_i that the sum takes for its facet; *stretch: the
   share by which a part of a patch may be larger or smaller than the facet's own part, in a term
   that F_i multiplies. Where the sum takes the mean over the patch (integrate/patch.h), F_i = (1 +
   a') F^ with F^ the mean per unit of the patch's own area, which is 1 + a' times the facet's. The
   map stretches area evenly, but for rounding (patch->blur): so over a part E, T - M = Int_E (F -
   F^), and no stretch is left. With h = F - F(facet normal), max(Int h+, Int h-) <= S part, so that
       Int_U |h| = 2 max - |Int_U h| <= S (2 part) - (1 + a') S |F^ - F(facet normal)|,
       Int_U |F - F^| <= Int_U |h| + (1 + a') S |F^ - F(facet normal)| <= S (2 part),
       |Int_E (F - F^)| <= (Int_U |F - F^| + |Int_U (F - F^)|) / 2 <= S (part + remainder / 2).
   At single points F^ differs from F(facet normal) by at most |F_i - F(facet normal)| + a F_i. */
static lrcsi_deviation patch_deviation(const lrcsi_view *view, const lrcsi_plan *plan,
                                       uint32_t facet, const lrcsi_incidence *incidence,
                                       const lrcs_curvature *c, lrcsi_patch *patch, double *stretch)
{
    lrcs_brdf brdf = lrcsi_plan_brdf(plan, lrcsi_prepared_material(view->prepared, facet));
    double cosine = fabs(incidence->cos_theta);
    lrcsi_deviation deviation = lrcsi_deviation_make(&brdf, cosine, incidence->tan2, c);
    *stretch = patch_area_error(view->prepared, facet, c);
    if (c->turn > FLAT_TILT && lrcsi_patch_make(view, plan, &brdf, facet, patch)) {
        double mean = patch->glint + patch->diffuse;
        double error = patch->remainder + patch->rounding;
        double apart = fabs(mean - deviation.here) + error + 2e-10 * deviation.here;
        deviation.whole = fmin(patch->remainder, deviation.whole + apart);
        deviation.part += error;
        deviation.apart += apart + *stretch * (mean + error);
        deviation.here = mean + error;
        *stretch = patch->blur;
    }
    return deviation;
}

/* How a sector none of which is hidden or dark is bounded. */
typedef struct sector_way {
    double lost; /* by what the facet loses of its whole patch; 2: not this way */
    double rows; /* by the share of the sector in rows that are not seen all along; 2: not so */
} sector_way;

/* The share of a facet's sector in rows that meet a band, at most; 1 if it has no rows. A cone's
   facets have sectors of their own. */
static double sector_rows(const lrcsi_view *view, uint32_t facet,
                          const lrcsi_proximity_band *margin)
{
    const lrcs_part *part = patch_part(view->prepared, facet);
    uint32_t other = part->first_facet + ((facet - part->first_facet) ^ 1);
    if (!lrcsi_proximity_has_rows(view->prepared, facet)) {
        return 1;
    }
    double rows = margin->rows[facet] + (part->kind == LRCS_SHAPE_CONE ? 0 : margin->rows[other]);
    return fmin(1, 2 * rows);
}

/* The way with the least bound; the third is that of parts, facet by facet. Numbers of the sector's
   first facet decide for both. */
static sector_way sector_choose(const lrcsi_view *view, const lrcsi_plan *plan, uint32_t facet,
                                const lrcs_curvature *c, const lrcsi_visible *visible,
                                const lrcsi_proximity_band *margin, lrcsi_patch *patch)
{
    const lrcs_part *part = patch_part(view->prepared, facet);
    uint32_t begin = part->first_facet;
    uint32_t first = begin + ((facet - begin) & ~UINT32_C(1));
    lrcsi_incidence incidence = lrcsi_view_incidence(view, first);
    double stretch;
    lrcsi_deviation deviation = patch_deviation(view, plan, first, &incidence, c, patch, &stretch);
    double lost = fmax(share_lost(view, first, visible, margin),
                       share_lost(view, first + 1, visible, margin));
    double a = patch_area_error(view->prepared, facet, c);
    double rows = sector_rows(view, part->kind == LRCS_SHAPE_CONE ? facet : first, margin);
    double share = fmax(margin->share[first], margin->share[first + 1]);
    double by_lost = deviation.whole + (1 + a) * lost * deviation.most;
    double by_rows = deviation.whole + rows * (deviation.part + stretch * deviation.here) +
                     (1 + a) * share * deviation.here;
    double by_parts = fmin(deviation.part + (stretch + (1 + a) * share) * deviation.here,
                           (1 + a) * deviation.most);
    sector_way way = {2, 2};
    if (by_rows < fmin(by_lost, by_parts)) {
        way.rows = rows;
    } else if (by_lost < deviation.part) {
        way.lost = share_lost(view, facet, visible, margin);
    }
    return way;
}

/* The error of a facet on a curved wall, per unit of its area. */
static double wall_error(const lrcsi_deviation *deviation, double a, double stretch, double share,
                         int state, int partner, const sector_way *way)
{
    double lit = is_lit(partner) ? deviation->part : (1 + a) * deviation->apart;
    if (state == PATCH_HIDDEN) {
        return (1 + a) * share * deviation->most;
    }
    if (state == partner && state != PATCH_MIXED) {
        return deviation->whole;
    }
    if (state == PATCH_DARK) {
        return (1 + a) * deviation->most;
    }
    if (way->lost <= 1) {
        return deviation->whole + (1 + a) * way->lost * deviation->most;
    }
    if (way->rows <= 1) {
        return deviation->whole + way->rows * deviation->part +
               deviation->here * (stretch * way->rows + (1 + a) * share);
    }
    return fmin(lit + deviation->here * (stretch + (1 + a) * share), (1 + a) * deviation->most);
}

/* What the facets may show of a closed part's inside, by rounding. */
static double inside_shown(const lrcsi_view *view, uint32_t facet, const lrcs_brdf *brdf,
                           const lrcsi_incidence *incidence, const lrcsi_visible *visible,
                           const lrcsi_proximity_band *margin)
{
    const lrcs_curvature flat = {FLAT_TILT, 0, 0, 0};
    if (!margin || view->facing[facet] >= 0 || !lrcsi_view_reflects(view, facet) ||
        !(visible[facet].high > 0)) {
        return 0;
    }
    double most = lrcsi_deviation_make(brdf, -incidence->cos_theta, incidence->tan2, &flat).most;
    return most * fmin(1, visible[facet].high / incidence->projected);
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

double lrcsi_tessellation_error(const lrcsi_view *view, const lrcsi_plan *plan, uint32_t facet,
                                const lrcsi_incidence *incidence, const lrcsi_visible *visible,
                                const lrcsi_proximity_band *margin, lrcsi_patch *patch)
{
    const lrcs_prepared *p = view->prepared;
    const lrcs_brdf assigned = lrcsi_plan_brdf(plan, lrcsi_prepared_material(p, facet));
    const lrcs_brdf *brdf = &assigned;
    const lrcs_curvature c = patch_curvature(p, facet);
    int curve = c.turn > FLAT_TILT;
    int state = patch_state(view, facet, visible, margin);
    double share = margin ? margin->share[facet] : 0;
    double area = 0.5 * p->normal[facet].length;
    if (curve && state == PATCH_HIDDEN) {
        share += share_seen(incidence, facet, visible, margin);
    }
    if (share == 0 && (!curve || state == PATCH_HIDDEN)) {
        return state == PATCH_DARK
                   ? area * inside_shown(view, facet, brdf, incidence, visible, margin)
                   : 0;
    }
    int partner = curve && margin ? partner_state(view, facet, visible, margin) : state;
    if (curve && state == PATCH_SEEN && partner == PATCH_SEEN && share == 0 &&
        lrcsi_patch_make(view, plan, brdf, facet, patch)) {
        return area * patch->remainder;
    }
    double stretch = 0;
    lrcsi_deviation deviation =
        state == PATCH_DARK ? lrcsi_deviation_make(brdf, incidence->cos_theta, incidence->tan2, &c)
                            : patch_deviation(view, plan, facet, incidence, &c, patch, &stretch);
    double error = state == PATCH_DARK ? 0 : share * deviation.most;
    if (curve) {
        int mixed =
            is_lit(state) && is_lit(partner) && (state == PATCH_MIXED || partner == PATCH_MIXED);
        sector_way way = {2, 2};
        if (mixed) {
            way = sector_choose(view, plan, facet, &c, visible, margin, patch);
        }
        double a = patch_area_error(p, facet, &c);
        error = wall_error(&deviation, a, stretch, share, state, partner, &way);
    }
    if (state == PATCH_DARK) {
        error += inside_shown(view, facet, brdf, incidence, visible, margin);
    }
    return area * error;
}

/* Let c say which points x of the patch lie in the interval, and k which points of the facet do.
   Pulled back to the facet, c v and k w differ on a share d at most: that which v and w differ on,
   and that within the reach of an end of the interval. With m the share of the facet on which c may
   be 1, and the patch's area that of the facet times 1 + a at most, place by place,
       |Int_U F c v - F_i Int_f k w| <= Int_U |F - F_i| c v + F_i |Int_U c v - Int_f k w|
                                     <= S [(1 + a) sup |F - F_i| m + F_i (a m + (1 + a) d)],
   and both integrals are at most (1 + a) S sup F m. On a flat facet F = F_i and a = 0. Where the
   facet is not lit it counts nothing, but for what `whole` has, and the truth in an interval is at
   most the truth. The bound of the whole patch may hold for two facets of a sector together only.
 */
lrcsi_patch_parts lrcsi_tessellation_parts(const lrcsi_view *view, const lrcsi_plan *plan,
                                           uint32_t facet, const lrcsi_incidence *incidence,
                                           const lrcsi_visible *visible,
                                           const lrcsi_proximity_band *margin, lrcsi_patch *patch)
{
    const lrcs_prepared *p = view->prepared;
    const lrcs_curvature c = patch_curvature(p, facet);
    int curve = c.turn > FLAT_TILT;
    int state = patch_state(view, facet, visible, margin);
    lrcsi_patch_parts parts = {
        .whole = lrcsi_tessellation_error(view, plan, facet, incidence, visible, margin, patch),
        .lit = is_lit(state),
        .share = margin ? margin->share[facet] : 0,
        .partner = facet};
    uint32_t first = patch_part(p, facet)->first_facet;
    uint32_t other = first + ((facet - first) ^ 1);
    if (curve && other < first + patch_part(p, facet)->facet_count && !p->skip[other]) {
        parts.partner = other;
    }
    if (parts.lit) {
        double stretch;
        lrcsi_deviation deviation =
            patch_deviation(view, plan, facet, incidence, &c, patch, &stretch);
        double area = 0.5 * p->normal[facet].length;
        double a = curve ? patch_area_error(p, facet, &c) : 0;
        parts.bend = curve ? area * ((1 + a) * deviation.apart + stretch * deviation.here) : 0;
        parts.shift = area * (1 + a) * deviation.here;
        parts.most = area * (1 + a) * deviation.most;
    }
    return parts;
}
