/* SPDX-License-Identifier: MIT */
/* The derivatives of sigma in the parameters of materials, over the visible areas of a pose. With
   u = tan^2(theta) the two terms of f_r cos^2 at amplitude 1 are
       g = (1 + u)^2 exp(-u / s^2)      and      d = (1 + u)^(-m/2 - 1),
   so that dg/ds = g 2 u / s^3 and dd/dm = -d log(1 + u) / 2. Limits: as s -> 0, g and dg/ds vanish
   except at u = 0, and count as 0 at s = 0; as u -> infinity all four vanish.
   Visible areas do not depend on materials.
   Called: lrcsi_view_incidence, lrcsi_reflect, lrcsi_patch_make; lrcsi_shape_response_make. */
#include "integrate/sensitivity.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "integrate/patch.h"
#include "optics/reflect.h"
#include "visibility/query.h"

/* The visible fraction of a facet that reflects. */
static double visible_fraction(const lrcsi_view *view, const lrcsi_areas *areas, uint32_t facet,
                               double projected)
{
    if (areas->answer && areas->answer[facet] != LRCSI_QUERY_UNDECIDED) {
        return areas->answer[facet] == LRCSI_QUERY_VISIBLE ? 1 : 0;
    }
    if (!areas->visible) {
        return lrcsi_grid_casts(view, facet) ? 1 : 0;
    }
    double area = areas->visible[facet].area;
    return area == projected ? 1 : area / projected; /* 1 even if both are 0 */
}

/* Adds a flat facet. Given: the fraction of it that is visible, and u. */
static void response_add_facet(const lrcsi_view *view, const lrcs_brdf *brdf, uint32_t facet,
                               double fraction, double u, lrcsi_response *response)
{
    double weight = LRCS_FOUR_PI * 0.5 * view->prepared->normal[facet].length * fraction;
    if (!isfinite(u)) {
        return;
    }
    const lrcs_brdf unit = {brdf->s > 0 ? 1 : 0, 1, brdf->s, brdf->m};
    lrcsi_reflection at = lrcsi_reflect(&unit, u, 0);
    double slope = at.glint > 0 ? at.glint * (2 * (u / brdf->s / brdf->s) / brdf->s) : 0;
    lrcsi_sum_add(&response->glint, weight * at.glint);
    lrcsi_sum_add(&response->glint_s, weight * slope);
    lrcsi_sum_add(&response->diffuse, weight * at.diffuse);
    lrcsi_sum_add(&response->diffuse_m, weight * (at.diffuse * (-0.5 * lrcsi_log1p(u).hi)));
}

/* Adds a facet that represents a patch of a curved wall. */
static void response_add_patch(const lrcsi_view *view, double s, uint32_t facet, double fraction,
                               const lrcsi_patch *patch, lrcsi_response *response)
{
    double weight = LRCS_FOUR_PI * 0.5 * view->prepared->normal[facet].length * fraction;
    double slope = patch->glint_u > 0 ? 2 * (patch->glint_u / s / s) / s : 0;
    lrcsi_sum_add(&response->glint, weight * patch->glint);
    lrcsi_sum_add(&response->glint_s, weight * slope);
    lrcsi_sum_add(&response->diffuse, weight * patch->diffuse);
    lrcsi_sum_add(&response->diffuse_m, weight * (-0.5 * patch->diffuse_log));
}

/* Adds a facet with curved normals. */
static void response_add_curved(const lrcs_brdf *brdf, const lrcsi_curved *curved,
                                lrcsi_response *response)
{
    double s = brdf->s;
    lrcsi_sum_add(&response->glint, curved->glint);
    lrcsi_sum_add(&response->diffuse, curved->diffuse);
    lrcsi_sum_add(&response->glint_s,
                  curved->glint_u > 0 ? 2 * (curved->glint_u / s / s) / s : 0.0);
    lrcsi_sum_add(&response->diffuse_m, -0.5 * curved->diffuse_log);
}

void lrcsi_response_make(const lrcsi_view *view, const lrcsi_plan *plan, const lrcsi_areas *areas,
                         const lrcsi_curved *curved, const lrcsi_clear *clear,
                         const lrcs_brdf *brdf, lrcsi_response *response)
{
    const lrcs_prepared *p = view->prepared;
    const lrcs_scene *scene = p->scene;
    lrcsi_patch patch = {.side = 0};
    memset(response, 0, scene->material_count * sizeof *response);
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        int in_clear_shape = clear->count > 0 && clear->part[scene->facet_part[f]];
        if (view->facing[f] == 0 || !lrcsi_view_reflects(view, f) || in_clear_shape) {
            continue;
        }
        uint32_t material = scene->facet_material[f];
        lrcsi_incidence incidence = lrcsi_view_incidence(view, f);
        double fraction = visible_fraction(view, areas, f, incidence.projected);
        const lrcs_brdf unit = {brdf[material].s > 0 ? 1 : 0, 1, brdf[material].s,
                                brdf[material].m};
        if (curved && lrcsi_curve_applies(view, f)) {
            response_add_curved(&brdf[material], &curved[f], &response[material]);
        } else if (fraction > 0 && lrcsi_patch_make(view, plan, &unit, f, &patch)) {
            response_add_patch(view, unit.s, f, fraction, &patch, &response[material]);
        } else if (fraction > 0) {
            response_add_facet(view, &brdf[material], f, fraction, incidence.tan2,
                               &response[material]);
        }
    }
    for (uint32_t i = 0; clear->count > 0 && i < scene->part_count; i++) {
        if (clear->part[i]) {
            uint32_t material = scene->facet_material[scene->part[i].first_facet];
            lrcsi_shape_response at = lrcsi_shape_response_make(view, i, &brdf[material]);
            lrcsi_sum_add(&response[material].glint, at.glint);
            lrcsi_sum_add(&response[material].diffuse, at.diffuse);
            lrcsi_sum_add(&response[material].glint_s, at.glint_s);
            lrcsi_sum_add(&response[material].diffuse_m, at.diffuse_m);
        }
    }
    for (uint32_t i = 0; i < scene->material_count; i++) {
        if (plan->glint == LRCSI_TERM_OUT) {
            response[i].glint = response[i].glint_s = (lrcsi_sum){0, 0};
        }
        if (plan->diffuse == LRCSI_TERM_OUT) {
            response[i].diffuse = response[i].diffuse_m = (lrcsi_sum){0, 0};
        }
    }
}
