/* SPDX-License-Identifier: MIT */
/* One shape in a scene by its closed form (optics/closed.h): its frame, its scale, and what these
   add to the bound. Which shapes may be taken so is view/clear.h's to prove.

   The laser in the shape's frame. The direction is taken as exact, the axes are good to 2^-97: its
   angles are off by at most eta = 2^-95, or by nothing where the axes are exact. With t = tan
   (theta), d ln F / d theta is 4 t - 2 t (1 + t^2) / s^2 for the glint: up to t = 64 s its value is
   at most 64 s (4 + 2 (1 + 4096 s^2) / s^2), which times eta is the relative error of all that is
   nearer; beyond, F is below exp(-4095) of its peak and underflows. The diffuse part's F moves by
   at most (m + 2) B eta per unit of surface. */
#include "integrate/shapes.h"

#include <math.h>

#include "optics/closed.h"

#define FOUR_PI  12.566370614359172954
#define AXES_OFF 0x1p-95

/* The largest value of (1 + u)^2 exp(-u / s^2) over u >= 0, rounded up: where the exponential is
   left out. */
static double glint_peak_most(double s)
{
    double q = 2 * s * s;
    return q <= 1 ? 1 : q * q;
}

static double shape_surface(const lrcs_shape *shape)
{
    double wide = fmax(shape->radius, shape->radius2);
    return 4 * LRCSI_PI * wide * (wide + lrcsi_closed_length(shape));
}

/* amount += what eta does to it. */
static void shape_turn(const lrcs_shape *shape, const lrcs_brdf *brdf, lrcsi_amount *amount)
{
    double s = brdf->s;
    if (amount->value[LRCSI_GLINT] > 0) {
        double flank = 64 * s * (4 + 2 * (1 + 4096 * s * s) / s / s);
        amount->error[LRCSI_GLINT] += 2 * AXES_OFF * flank * amount->value[LRCSI_GLINT];
    }
    amount->error[LRCSI_DIFFUSE] += 2 * AXES_OFF * (brdf->m + 2) * brdf->B * shape_surface(shape);
}

lrcsi_shape_terms lrcsi_shape_terms_make(const lrcsi_view *view, const lrcsi_plan *plan,
                                         uint32_t part, double slab)
{
    const lrcs_prepared *p = view->prepared;
    const lrcs_part *placed = &p->scene->part[part];
    lrcs_brdf brdf = lrcsi_plan_brdf(plan, lrcsi_prepared_material(p, placed->first_facet));
    double unit = ldexp(placed->unit, -p->exponent);
    lrcsi_dd direction[3];
    for (int i = 0; i < 3; i++) {
        direction[i] = (lrcsi_dd){0, 0};
        for (int k = 0; k < 3; k++) {
            lrcsi_dd axis = {placed->axis[i][k], placed->axis_low[i][k]};
            direction[i] = lrcsi_dd_add(direction[i], lrcsi_dd_scale(axis, view->direction[k]));
        }
    }
    lrcsi_amount sum = {{0, 0}, {0, 0}};
    double silhouette = 0;
    if (lrcsi_closed_shape(&placed->shape, &brdf, direction, &sum, &silhouette) != LRCS_OK) {
        sum.error[LRCSI_GLINT] = HUGE_VAL; /* never: pose and shape have been checked */
    }
    if (!placed->axis_exact) {
        shape_turn(&placed->shape, &brdf, &sum);
    }
    lrcsi_closed_scale(&sum, unit * unit, 1);
    lrcsi_closed_scale(&sum, FOUR_PI, 1);
    double most = (brdf.A > 0 ? brdf.A * glint_peak_most(brdf.s) : 0) + brdf.B;
    return (lrcsi_shape_terms){.glint = sum.value[LRCSI_GLINT],
                               .diffuse = sum.value[LRCSI_DIFFUSE],
                               .rounding = sum.error[LRCSI_GLINT] + sum.error[LRCSI_DIFFUSE],
                               .visibility = FOUR_PI * 1.000001 * slab * most,
                               .silhouette = silhouette * unit * unit};
}
