/* SPDX-License-Identifier: MIT */
/* Boxes around parts, and which placed shapes have closed forms. It does not decide what hides
   what, nor what a shape reflects. */
#include "scene/extent.h"

#include <math.h>

#include "base/range.h"
#include "base/work.h"
#include "optics/closed.h"
#include "scene/build/placed_shape.h"

/* A part thinner than this (scaled) has no closed form: its coordinates may be so small that they
   count as 0 (LRCSI_COORDINATE_MIN). */
#define EXTENT_MIN 0x1p-200

/* Does any part have a shape that may have a closed form? */
static int any_closed_form(const lrcs_scene *scene)
{
    int any = 0;
    for (uint32_t i = 0; i < scene->part_count; i++) {
        any |= scene->part[i].rigid && lrcsi_placed_shape_closed_form(&scene->part[i].shape, 0);
    }
    return any;
}

/* 1 if a part has a closed form: all its facets are live, and its dimensions and material are in
   the range where the closed forms are valid. */
static int has_closed_form(const lrcs_prepared *p, uint32_t index)
{
    const lrcs_part *part = &p->scene->part[index];
    if (part->kind < 0 || !part->rigid || !part->bounds.known ||
        !lrcsi_placed_shape_closed_form(&part->shape, 0) || part->facet_count == 0) {
        return 0;
    }
    for (uint32_t f = part->first_facet; f < part->first_facet + part->facet_count; f++) {
        if (p->skip[f]) {
            return 0;
        }
    }
    const lrcs_material *material = lrcsi_prepared_material(p, part->first_facet);
    return ldexp(part->min_extent, -p->exponent) >= EXTENT_MIN &&
           lrcsi_closed_check(&part->shape, &material->brdf) == LRCS_OK;
}

size_t lrcsi_extents_need(const lrcs_scene *scene)
{
    return any_closed_form(scene) ? lrcsi_work_bytes(scene->part_count, sizeof(lrcsi_extent)) : 0;
}

/* The boxes contain the true surface, which is within `reach` of the facets; 1e-15 covers the
   rounding of the sums. */
int lrcsi_extents_make(lrcs_prepared *p, lrcs_work *work)
{
    const lrcs_scene *scene = p->scene;
    if (!any_closed_form(scene)) {
        return LRCS_OK;
    }
    lrcsi_extent *extent = lrcsi_work_take(work, scene->part_count, sizeof *extent);
    if (!extent) {
        return LRCS_E_MEMORY;
    }
    for (uint32_t i = 0; i < scene->part_count; i++) {
        extent[i] = (lrcsi_extent){{HUGE_VAL, HUGE_VAL, HUGE_VAL},
                                   {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL},
                                   has_closed_form(p, i)};
    }
    for (uint32_t f = 0; f < scene->facet_count; f++) {
        uint32_t part = scene->facet_part[f];
        double reach = ldexp(scene->part[part].bounds.reach, -p->exponent) + 1e-15;
        for (int i = 0; i < 9 && !p->skip[f]; i++) {
            double x = lrcsi_prepared_corner(p, f, i / 3)[i % 3];
            extent[part].low[i % 3] = lrcsi_min(extent[part].low[i % 3], x - reach);
            extent[part].high[i % 3] = lrcsi_max(extent[part].high[i % 3], x + reach);
        }
    }
    p->extent = extent;
    return LRCS_OK;
}
