/* SPDX-License-Identifier: MIT */
/* Which facets are proved to lie on a plane, cylinder, sphere or cone: the table and the JSON of
   lrcs info. */
#include "cli/info/info.h"

#include <math.h>

/* Rows of the table; the rest is counted. */
#define SURFACE_ROWS 12u

enum { PLACE_SIZE = 64 };
static const char *const kind_text[LRCS_HOST_SURFACE_KINDS] = {"plane", "cylinder", "sphere",
                                                               "cone"};

/* A point or vector for people: what is below 1e-5 of its largest component or of `size` is 0. */
static const char *place_text(const double x[3], double size, char text[PLACE_SIZE])
{
    double most = fmax(size, fmax(fabs(x[0]), fmax(fabs(x[1]), fabs(x[2]))));
    double shown[3];
    for (int k = 0; k < 3; k++) {
        shown[k] = fabs(x[k]) < 1e-5 * most ? 0.0 : x[k];
    }
    snprintf(text, PLACE_SIZE, "%.5g,%.5g,%.5g", shown[0], shown[1], shown[2]);
    return text;
}

static void surface_row(const lrcs_scene *scene, const lrcs_quadric_region *region)
{
    const lrcs_quadric *surface = &region->surface;
    char point[PLACE_SIZE];
    char axis[PLACE_SIZE];
    place_text(surface->point, surface->radius, point);
    place_text(surface->axis, 1.0, axis);
    printf("  %-8s ", kind_text[surface->kind]);
    cli_column(cli_material_name(&scene->material[region->material]), 20);
    printf(" %7lu %10.4g %11.3g %8.3g %8.2g%s ", (unsigned long)region->facet_count, region->area,
           region->bound.displacement, region->bound.normal_angle * LRCS_DEGREES_PER_RADIAN,
           region->glint_error, region->glint_error > LRCS_HOST_GLINT_COARSE ? "!" : " ");
    switch (surface->kind) {
    case LRCS_QUADRIC_PLANE:
        printf(" normal %s through %s\n", axis, point);
        break;
    case LRCS_QUADRIC_CYLINDER:
        printf(" radius %.6g, axis %s through %s%s\n", surface->radius, axis, point,
               region->bound.inside ? ", inside" : "");
        break;
    case LRCS_QUADRIC_SPHERE:
        printf(" radius %.6g, centre %s%s\n", surface->radius, point,
               region->bound.inside ? ", inside" : "");
        break;
    default:
        printf(" half angle %.5g deg, apex %s, axis %s%s\n",
               atan(surface->slope) * LRCS_DEGREES_PER_RADIAN, point, axis,
               region->bound.inside ? ", inside" : "");
        break;
    }
}

void cli_surfaces_table(const lrcs_host_surfaces *surfaces, const lrcs_scene *scene)
{
    static const char *const plural[LRCS_HOST_SURFACE_KINDS] = {"planes", "cylinders", "spheres",
                                                                "cones"};
    const char *before = "surfaces     ";
    uint32_t models = 0;
    for (uint32_t i = 0; i < scene->part_count; i++) {
        models += scene->part[i].kind < 0;
    }
    if (surfaces->count == 0) { /* the surfaces of shapes are known */
        fputs(models > 0 ? "surfaces     none found: planes, cylinders, spheres or cones on which "
                           "facets of models lie\n"
                         : "",
              stdout);
        return;
    }
    for (int i = 0; i < LRCS_HOST_SURFACE_KINDS; i++) {
        const lrcs_host_surface_kind *kind = &surfaces->kind[i];
        if (kind->regions > 0) {
            printf("%s%lu %s: %lu facets, %.6g m2, proved to lie within %.2g m of them\n", before,
                   (unsigned long)kind->regions, kind->regions == 1 ? kind_text[i] : plural[i],
                   (unsigned long)kind->facets, kind->area_m2, kind->displacement);
            before = "             ";
        }
    }
    printf("  %-8s %-20s %7s %10s %11s %8s %9s %s\n", "surface", "material", "facets", "area m2",
           "within m", "turn deg", "error ", " m, body frame");
    for (uint32_t i = 0; i < surfaces->count && i < SURFACE_ROWS; i++) {
        surface_row(scene, &surfaces->region[i]);
    }
    if (surfaces->count > SURFACE_ROWS) {
        printf("  and %lu smaller ones (--json lists all)\n",
               (unsigned long)surfaces->count - SURFACE_ROWS);
    }
    printf("  within, turn: proved bounds of the distance of facets from the surface and of the "
           "angle\n  between their normals; error: relative, of the glint, an estimate (!: above "
           "%g); inside: the\n  facets' fronts face the axis or the centre\n",
           LRCS_HOST_GLINT_COARSE);
}

void cli_surfaces_json(const lrcs_host_surfaces *surfaces, const lrcs_scene *scene,
                       lrcs_host_json *json)
{
    lrcs_host_json_begin(json, "surfaces", LRCS_HOST_ARRAY);
    for (uint32_t i = 0; i < surfaces->count; i++) {
        const lrcs_quadric_region *region = &surfaces->region[i];
        const lrcs_quadric *surface = &region->surface;
        lrcs_host_json_put(json, "{surface=%s part=%s material=%s", kind_text[surface->kind],
                           scene->part[region->part].name, scene->material[region->material].name);
        lrcs_host_json_numbers(json, "point_m", surface->point, 3);
        if (surface->kind != LRCS_QUADRIC_SPHERE) {
            lrcs_host_json_numbers(json, "axis", surface->axis, 3);
        } else {
            lrcs_host_json_put(json, "axis=null");
        }
        if (surface->kind == LRCS_QUADRIC_CYLINDER || surface->kind == LRCS_QUADRIC_SPHERE) {
            lrcs_host_json_put(json, "radius_m=%g", surface->radius);
        } else {
            lrcs_host_json_put(json, "radius_m=null");
        }
        if (surface->kind == LRCS_QUADRIC_CONE) {
            lrcs_host_json_put(json, "half_angle_deg=%g half_angle_tangent=%g",
                               atan(surface->slope) * LRCS_DEGREES_PER_RADIAN, surface->slope);
        } else {
            lrcs_host_json_put(json, "half_angle_deg=null half_angle_tangent=null");
        }
        lrcs_host_json_put(json,
                           "inside=%d facets=%u first_facet=%u area_m2=%g displacement_bound_m=%g "
                           "normal_angle_bound_deg=%g glint_error_estimate=%g}",
                           region->bound.inside, region->facet_count, region->first_facet,
                           region->area, region->bound.displacement,
                           region->bound.normal_angle * LRCS_DEGREES_PER_RADIAN,
                           region->glint_error);
    }
    lrcs_host_json_end(json);
}
