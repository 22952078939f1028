/* SPDX-License-Identifier: MIT */
/* Derives from a shape and its placement the errors of its facets and vertices, and whether it is
   closed and convex. */
#include "scene/build/placed_shape.h"

#include <math.h>
#include <string.h>

#include "base/constant.h"
#include "base/degrees.h"
#include "base/length.h"
#include "base/outward.h"
#include "base/vec3.h"
#include "mesh/shape/patch_bounds.h"
#include "mesh/shape/tessellate.h"

/* The smallest extent of a shape, in its own units; 0 for a flat shape. */
static double smallest_extent(const lrcs_shape *shape)
{
    double sine;
    double cosine;
    double length = shape->length;
    double across = 2.0 * fmax(shape->radius, shape->radius2);
    switch (shape->kind) {
    case LRCS_SHAPE_PLATE:
    case LRCS_SHAPE_DISC:
        return 0.0;
    case LRCS_SHAPE_BOX:
        return fmin(shape->size[0], fmin(shape->size[1], shape->size[2]));
    case LRCS_SHAPE_SPHERE:
        return across;
    case LRCS_SHAPE_DOME:
        return shape->radius;
    default:
        if (shape->half_angle_deg > 0.0) {
            lrcsi_degrees_sincos(shape->half_angle_deg, &sine, &cosine);
            length = shape->radius * cosine / sine;
        }
        return fmin(across, length);
    }
}

/* 1 if a shape's surface is closed: it has caps or needs none. */
static int is_closed(const lrcs_shape *shape)
{
    return shape->kind == LRCS_SHAPE_BOX || shape->kind == LRCS_SHAPE_SPHERE ||
           (shape->kind != LRCS_SHAPE_PLATE && shape->kind != LRCS_SHAPE_DISC &&
            shape->parts == LRCS_SHAPE_ALL);
}

int lrcsi_placed_shape_closed_form(const lrcs_shape *shape, int two_sided)
{
    int flat = lrcsi_shape_is_plane_faced(shape->kind) || shape->kind == LRCS_SHAPE_DISC;
    return !flat && (!two_sided || is_closed(shape));
}

double lrcsi_placed_shape_extent(const lrcs_mesh *mesh)
{
    double largest = 0.0;
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        const double *x = mesh->vertex[i].x;
        largest = fmax(largest, fmax(fabs(x[0]), fmax(fabs(x[1]), fabs(x[2]))));
    }
    return largest;
}

/* The smallest altitude of the facets of a part, m: the length of a facet's normal over its longest
   side; 0 if a facet is a single point. */
static double smallest_altitude(const lrcs_scene *scene, const lrcs_part *part)
{
    double smallest = HUGE_VAL;
    for (uint32_t i = 0; i < part->facet_count; i++) {
        const uint32_t *corner = scene->facet[part->first_facet + i].corner;
        const double *x = scene->vertex[corner[0]].x;
        const double *y = scene->vertex[corner[1]].x;
        const double *z = scene->vertex[corner[2]].x;
        double longest = lrcsi_length_longest_side(x, y, z);
        double p[3];
        double q[3];
        double n[3];
        lrcsi_vec3_between(x, y, p);
        lrcsi_vec3_between(y, z, q);
        lrcsi_vec3_cross(p, q, n);
        smallest = longest > 0.0 ? fmin(smallest, sqrt(lrcsi_vec3_dot(n, n)) / longest) : 0.0;
    }
    return smallest;
}

/* Rounding in placing moves each of a facet's three corners by at most e. That rotates the facet by
   at most e divided by its altitude at that corner, and changes its area by at most that fraction.
   The bounds of patches are relative to the area of the facet; that of its patch is larger by at
   most area_err. Nothing can be proved about a facet without area. */
void lrcsi_placed_shape_normal_err(const lrcsi_placer *placer, const lrcs_scene *scene,
                                   double extent, lrcs_part *part)
{
    double e = lrcsi_placer_error(placer, extent, 0.0);
    if (part->bounds.reach > 0.0 && e > 0.0) {
        double factor = 3.0 * (1.0 + part->bounds.patch.area_err);
        double altitude = smallest_altitude(scene, part);
        part->bounds.normal_err = LRCSI_OUTWARD_MICRO * factor * e / altitude;
        part->bounds.known = part->bounds.known && altitude > 0.0;
        part->bounds.patch =
            part->bounds.patch.turn > 0.0
                ? lrcsi_patch_bounds_rounded(&part->bounds.patch, part->bounds.normal_err)
                : part->bounds.patch;
    }
}

/* A uniform scale does not change the bounds of patches; other scales change them as in
   mesh/shape/patch_bounds.h. Every affine map preserves convexity, and the outside stays outside,
   because a reflection reverses the windings. The coordinates of the mesh have a relative error of
   (16 + zones) u before placing (mesh/shape/revolution.c), except for underflow. */
void lrcsi_placed_shape_describe(const lrcs_shape *shape, const lrcs_divisions *divisions,
                                 const lrcs_patch_bounds *bounds, const lrcsi_placer *placer,
                                 double extent, lrcs_part *part)
{
    const double *scale = placer->place.scale;
    lrcsi_reach reach = lrcsi_tessellate_reach(shape, divisions);
    double smallest = fmin(fabs(scale[0]), fmin(fabs(scale[1]), fabs(scale[2])));
    double largest = fmax(fabs(scale[0]), fmax(fabs(scale[1]), fabs(scale[2])));
    int plane = bounds->turn == 0.0 && bounds->area_err == 0.0 && bounds->bias == 0.0 &&
                bounds->rms_turn == 0.0;
    const double zero[3] = {0.0, 0.0, 0.0};
    double norm; /* largest singular value */
    double condition;
    lrcsi_axes axes;
    lrcsi_placer_singular_values(placer, &norm, &condition);
    double error = (17.0 + (double)divisions->along) * LRCSI_U * extent + 0x1p-1022;
    part->bounds.position_err = lrcsi_placer_error(placer, extent + error, error);
    part->kind = shape->kind;
    part->rigid = lrcsi_placer_axes(placer, &axes);
    if (part->rigid) {
        memcpy(part->axis, axes.high, sizeof part->axis);
        memcpy(part->axis_low, axes.low, sizeof part->axis_low);
        part->axis_exact = axes.exact;
    }
    part->normals_known = lrcsi_placer_normals(placer, part->normal_axis, &part->normal_area);
    part->shape = *shape;
    part->divisions = *divisions;
    part->unit = largest;
    lrcsi_placer_run(placer, zero, part->origin);
    part->bounds.patch = *bounds;
    part->bounds.known = plane || condition < HUGE_VAL;
    if (!plane && !part->rigid && part->bounds.known) {
        part->bounds.patch =
            lrcsi_patch_bounds_mapped(bounds, condition, &part->bounds.stretch_err);
    }
    part->convex_patch = 1;
    part->min_extent = smallest * smallest_extent(shape);
    part->solid = is_closed(shape) && part->min_extent > 0.0;
    if (reach.all > 0.0) {
        double scaled = LRCSI_OUTWARD_MICRO * norm;
        double placed = 2.0 * part->bounds.position_err;
        part->bounds.reach = scaled * reach.all + placed;
        part->bounds.hausdorff =
            scaled * (part->solid || shape->kind == LRCS_SHAPE_DISC ? reach.solid : reach.surface) +
            placed;
        part->bounds.displacement[0] = scaled * reach.radial + placed;
        part->bounds.displacement[1] = scaled * reach.axial + placed;
        part->bounds.displacement[2] = scaled * reach.tangential + placed;
    }
}
