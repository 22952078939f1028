/* SPDX-License-Identifier: MIT */
/* The derivatives of sigma in the parameters of materials, over the visible areas of a pose. With
   u = tan^2(theta) the two terms of f_r cos^2 at amplitude 1 are
       g = (1 + u)^2 exp(-u / s^2)      and      d = (1 + u)^(-m/2 - 1),
   so that dg/ds = g 2 u / s^3 and dd/dm = -d log(1 + u) / 2. Limits: as s -> 0, g and dg/ds vanish
   except at u = 0, and count as 0 at s = 0; as u -> infinity all four vanish.
   Visible areas do not depend on materials. Each facet is computed as the sum of Eq. 2 computes it
   (integrate/sum/total_facet.c): from the integrals over its curved normals, over the visible
   pieces of its round wall, as the mean over its patch, or from its normal. The margins of a flat
   face, which one of its facets has, and those on a wall (lrcsi_areas_margin) are added to visible
   areas. A facet that faces away may have the integral over a patch at the limb.
   Called: lrcsi_view_incidence, lrcsi_reflect, lrcsi_patch_make, lrcsi_linear_make;
   lrcsi_shape_response_make. */
#include "integrate/derivative/sensitivity.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "integrate/wall/linear.h"
#include "integrate/wall/patch.h"
#include "optics/reflect.h"

/* The visible fraction of a facet that the sum of Eq. 2 includes, as that sum has it. */
static double visible_fraction(const lrcsi_areas *areas, const lrcsi_sigma *run, uint32_t facet,
                               const lrcsi_incidence *incidence)
{
    lrcsi_visible_area visible = lrcsi_areas_of(areas, &run->view, &run->plan, facet, incidence);
    return lrcsi_areas_fraction(visible.area, incidence->projected);
}

/* The derivative dg/ds = g 2 u / s^3, from g u: 0 at s = 0, where g is 0. */
static double glint_slope_s(double glint_u, double s)
{
    return glint_u != 0 ? 2 * (glint_u / s / s) / s : 0;
}

/* Adds a facet or a shape: `at`, times a weight. */
static void response_sum(lrcsi_response *response, double weight, const lrcsi_unit_response *at)
{
    lrcsi_sum_add(&response->glint, weight * at->glint);
    lrcsi_sum_add(&response->glint_s, weight * at->glint_s);
    lrcsi_sum_add(&response->diffuse, weight * at->diffuse);
    lrcsi_sum_add(&response->diffuse_m, weight * at->diffuse_m);
}

/* The response of a unit of area of a flat facet. Given: the BRDF with amplitudes of 1, and u,
   which is finite for every facet that is not edge-on. */
static lrcsi_unit_response flat_response(const lrcs_brdf *unit, double u)
{
    const double s = unit->s;
    lrcsi_reflection at = lrcsi_reflect(unit, u, 0);
    return (lrcsi_unit_response){.glint = at.glint,
                                 .diffuse = at.diffuse,
                                 .glint_s = at.glint > 0 ? at.glint * (2 * (u / s / s) / s) : 0,
                                 .diffuse_m = at.diffuse * (-0.5 * lrcsi_log1p(u).hi)};
}

/* The patches that a facet's terms are computed from; NULL: from the flat facet. */
typedef struct response_patches {
    const lrcsi_patch *own; /* of the material's amplitudes, because whether there is a mean depends
                               on them: for terms whose amplitude is not 0 */
    const lrcsi_patch *unit; /* of amplitudes of 1: for terms of amplitude 0 */
} response_patches;

/* The patches of a facet. Given: the BRDF with the material's amplitudes, and with amplitudes of 1;
   what evaluates patches for either. The sum of Eq. 2 uses a mean only if `own` has one. */
static response_patches patches_find(const lrcsi_view *view, const lrcsi_plan *plan,
                                     const lrcs_brdf *own, const lrcs_brdf *unit, uint32_t facet,
                                     lrcsi_patches patches[2])
{
    response_patches found = {lrcsi_patch_make(view, plan, own, facet, &patches[0]), NULL};
    if (found.own && !(own->A > 0 && own->B > 0)) {
        found.unit = lrcsi_patch_make(view, plan, unit, facet, &patches[1]);
    }
    return found;
}

/* The response of a unit of area of a facet that is no piece of a round wall, computed as the sum
   of Eq. 2 computes it: from the means over its patches, divided by the amplitudes, or from the
   flat facet. */
static lrcsi_unit_response facet_response(const lrcs_brdf *own, const lrcs_brdf *unit, double u,
                                          const response_patches *patches)
{
    const double s = unit->s;
    const lrcsi_patch *p = patches->unit;
    if (!patches->own) {
        return flat_response(unit, u);
    }
    lrcsi_unit_response at = {0, 0, 0, 0};
    if (!(own->A > 0 && own->B > 0)) {
        at = p ? (lrcsi_unit_response){p->glint, p->diffuse, glint_slope_s(p->glint_u, s),
                                       -0.5 * p->diffuse_log}
               : flat_response(unit, u);
    }
    p = patches->own;
    if (own->A > 0) {
        at.glint = p->glint / own->A;
        at.glint_s = glint_slope_s(p->glint_u / own->A, s);
    }
    if (own->B > 0) {
        at.diffuse = p->diffuse / own->B;
        at.diffuse_m = -0.5 * (p->diffuse_log / own->B);
    }
    return at;
}

/* The response of the correction of a facet (integrate/wall/linear.h), per unit of its area: from
   the same patches as in facet_response. */
static lrcsi_unit_response correction_response(const lrcsi_sigma *run, const lrcs_brdf *own,
                                               const lrcs_brdf *unit, uint32_t facet,
                                               const response_patches *patches)
{
    const lrcsi_view *view = &run->view;
    const lrcs_scene *scene = view->prepared->scene;
    const lrcs_patch_bounds *bounds = &scene->part[scene->facet_part[facet]].bounds.patch;
    double projected = lrcsi_view_projected(view, facet);
    lrcsi_unit_response at = {0, 0, 0, 0};
    for (int i = 0; i < 2; i++) {
        const lrcs_brdf *brdf = i == 0 ? own : unit;
        const lrcsi_patch *patch = i == 0 ? patches->own : patches->unit;
        int glint = i == 0 ? own->A > 0 : own->A == 0;
        int diffuse = i == 0 ? own->B > 0 : own->B == 0;
        lrcsi_linear linear;
        if ((glint || diffuse) && patch &&
            lrcsi_linear_make(view, brdf, patch, bounds, 0, NULL, &linear)) {
            lrcsi_linear_moment m = lrcsi_linear_moment_make(
                view, facet, patch, &run->areas.visible[facet], &run->areas.moment[facet]);
            const double x = m.first[0] * (run->corrected[facet] / projected);
            const double y = m.first[1] * (run->corrected[facet] / projected);
            if (glint && brdf->A > 0) {
                at.glint = (linear.glint[0] * x + linear.glint[1] * y) / brdf->A;
                at.glint_s = (linear.glint_s[0] * x + linear.glint_s[1] * y) / brdf->A;
            }
            if (diffuse) {
                at.diffuse = (linear.diffuse[0] * x + linear.diffuse[1] * y) / brdf->B;
                at.diffuse_m = (linear.diffuse_m[0] * x + linear.diffuse_m[1] * y) / brdf->B;
            }
        }
    }
    return at;
}

/* The response of a facet of a round wall whose visible pieces are known: from the integrals over
   these, divided by the amplitudes. Terms of amplitude 0, which these integrals do not include, are
   those of the facet: `at` per unit of area, times a weight. */
static lrcsi_unit_response pieces_response(const lrcs_brdf *own, const lrcsi_wall_terms *wall,
                                           double weight, const lrcsi_unit_response *at)
{
    lrcsi_unit_response sum = {weight * at->glint, weight * at->diffuse, weight * at->glint_s,
                               weight * at->diffuse_m};
    if (own->A > 0) {
        sum.glint = LRCS_FOUR_PI * wall->sum.glint / own->A;
        sum.glint_s = LRCS_FOUR_PI * glint_slope_s(wall->sum.glint_u / own->A, own->s);
    }
    if (own->B > 0) {
        sum.diffuse = LRCS_FOUR_PI * wall->sum.diffuse / own->B;
        sum.diffuse_m = LRCS_FOUR_PI * -0.5 * (wall->sum.diffuse_log / own->B);
    }
    return sum;
}

void lrcsi_response_make(const lrcsi_sigma *run, const lrcs_brdf *brdf, int as_sigma,
                         lrcsi_response *response)
{
    lrcsi_areas areas = run->areas;
    areas.wall_terms = as_sigma ? areas.wall_terms : NULL; /* at the run's parameters only */
    const lrcsi_view *view = &run->view;
    const lrcsi_plan *plan = &run->plan;
    const lrcsi_clear_shapes *clear = &run->clear;
    const lrcs_prepared *p = view->prepared;
    const lrcs_scene *scene = p->scene;
    lrcsi_patches patches[2] = {{.derivatives = 1}, {.derivatives = 1}}; /* response_patches */
    memset(response, 0, scene->material_count * sizeof *response);
    for (uint32_t f = 0; f < scene->facet_count; f++) { /* 1. facets */
        int in_clear_shape = lrcsi_is_clear_shape(clear, scene->facet_part[f]);
        const int reflects = view->facing[f] != 0 && lrcsi_view_reflects(view, f);
        const lrcsi_wall_terms *wall = lrcsi_areas_wall_terms(&areas, f);
        if (in_clear_shape || !(reflects ? lrcsi_areas_is_summed(&areas, view, f) : wall != NULL)) {
            continue;
        }
        uint32_t material = scene->facet_material[f];
        lrcsi_response *to = &response[material];
        const double s = brdf[material].s;
        const lrcs_brdf unit = {s > 0 ? 1 : 0, 1, s, brdf[material].m};
        const lrcs_brdf own = {plan->glint == LRCSI_TERM_OMITTED ? 0 : brdf[material].A,
                               plan->diffuse == LRCSI_TERM_OMITTED ? 0 : brdf[material].B, s,
                               brdf[material].m};
        if (!reflects) { /* a patch at the limb */
            const lrcsi_unit_response none = {0, 0, 0, 0};
            const lrcsi_unit_response at = pieces_response(&own, wall, 0, &none);
            response_sum(to, 1, &at);
            continue;
        }
        lrcsi_incidence incidence = lrcsi_view_incidence(view, f);
        double fraction = visible_fraction(&areas, run, f, &incidence);
        const double margin = lrcsi_areas_margin(&areas, view, f);
        fraction += margin != 0 ? margin / incidence.projected : 0;
        const double u = incidence.tan2;
        double whole = LRCS_FOUR_PI * 0.5 * p->normal[f].length;
        double weight = whole * fraction;
        int corrected = areas.moment && run->corrected[f] > 0;
        if (run->curve_terms && lrcsi_curve_applies(view, f)) { /* curved normals */
            const lrcsi_curve_terms *curved = &run->curve_terms[f];
            const lrcsi_unit_response at = {curved->glint, curved->diffuse,
                                            glint_slope_s(curved->glint_u, s),
                                            -0.5 * curved->diffuse_log};
            response_sum(to, 1, &at);
        } else {
            response_patches found = patches_find(view, plan, &own, &unit, f, patches);
            lrcsi_unit_response at = facet_response(&own, &unit, u, &found);
            if (wall) {
                at = pieces_response(&own, wall, weight, &at);
                response_sum(to, 1, &at);
            } else {
                response_sum(to, weight, &at);
            }
            if (corrected) { /* even if its area is 0: its moment has an error */
                at = correction_response(run, &own, &unit, f, &found);
                response_sum(to, whole, &at);
            }
        }
    }
    for (uint32_t i = 0; i < scene->part_count; i++) { /* 2. clear shapes */
        if (lrcsi_is_clear_shape(clear, i)) {
            uint32_t material = scene->facet_material[scene->part[i].first_facet];
            lrcsi_unit_response at = lrcsi_shape_response_make(view, i, &brdf[material]);
            response_sum(&response[material], 1, &at);
        }
    }
    for (uint32_t i = 0; i < scene->material_count; i++) { /* 3. terms that the plan leaves out */
        if (plan->glint == LRCSI_TERM_OMITTED) {
            response[i].glint = response[i].glint_s = (lrcsi_sum){0, 0};
        }
        if (plan->diffuse == LRCSI_TERM_OMITTED) {
            response[i].diffuse = response[i].diffuse_m = (lrcsi_sum){0, 0};
        }
    }
}
