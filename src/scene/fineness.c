/* SPDX-License-Identifier: MIT */
/* How finely a shape among other parts is divided: coarser if it is small compared with them, and
   as finely as the edges of shadows require. It chooses, and proves nothing: the error of the
   facets is computed from the mesh for each pose. */
#include "scene/fineness.h"

#include <math.h>

#include "base/constant.h"
#include "base/vec3.h"
#include "mesh/tessellate.h"
#include "scene/placed_shape.h"

/* The tolerance of a scene is divided among its parts, and among at least this many. The largest
   factor by which a small part may be coarser than requested. */
#define PARTS_LEAST     16.0
#define COARSENING_MOST 100.0

/* The largest distance of a round body's surface from its facets, in units of its radius times the
   tolerance. Measured: with 0.3, 14 of 20 directions to examples/satellites/spinner.toml and 11 of
   20 to lander.toml meet 1e-4; with 1.0, 25 and 17 of 60 in half the time. The number of its facets
   grows as 1/tolerance. */
#define REACH_ROUND 0.3

/* The distance of a sector's chord from the unit circle is about this times (pi/N)^2
   (mesh/profile.c). */
#define SECTOR_REACH 0.36
/* How often a reach is enlarged by a quarter to keep within the limit of facets. */
#define REACHES_MOST 100

/* Divisions of a shape whose facets only pictures and records show: neighbours differ by 7.5 and 9
   degrees, which looks smooth. */
#define BASE_AROUND 48
#define BASE_ALONG  10

/* Divisions of a shape alone whose facets represent patches of its true surface. Only patches that
   are nearly edge-on to the laser, or partly face away from it, have a large error. Measured with
   nine materials at 37 aspects, the bounds relative to the mean of sigma over the aspects are at
   most 20/N^2 for straight walls and 300/N^3 for round shapes of N sectors, if the rules of
   integrate/patch.h hold: for that a facet's turn in azimuth must not exceed 4 s or 0.1 rad, nor m
   a limit. */
#define ALONE_STRAIGHT      20.0
#define ALONE_ROUND         300.0
#define ALONE_LEAST         64.0
#define ALONE_MOST          1e6
#define ALONE_PER_SLOPE     1.6
#define ALONE_EXPONENT_MOST 50.0

/* Beyond this ratio of a scale's components no number of facets suffices. */
#define RATIO_MOST 1e3

/* The area of a facet, in units of the mesh; 0 if a corner is out of range. */
static double mesh_facet_area(const lrcs_mesh *mesh, uint32_t f)
{
    const uint32_t *corner = mesh->facet[f].corner;
    double p[3];
    double q[3];
    if (corner[0] >= mesh->vertex_count || corner[1] >= mesh->vertex_count ||
        corner[2] >= mesh->vertex_count) {
        return 0.0;
    }
    double n[3];
    lrcsi_vec3_between(mesh->vertex[corner[0]].x, mesh->vertex[corner[1]].x, p);
    lrcsi_vec3_between(mesh->vertex[corner[0]].x, mesh->vertex[corner[2]].x, q);
    lrcsi_vec3_cross(p, q, n);
    return 0.5 * sqrt(lrcsi_vec3_dot(n, n));
}

double lrcsi_fineness_area(const lrcs_recipe_part *part, const lrcs_mesh *mesh)
{
    const lrcs_shape *shape = &part->shape;
    const double *s = shape->size;
    double r = fmax(shape->radius, shape->radius2);
    double area = 2.0 * (s[0] * s[1] + s[1] * s[2] + s[2] * s[0]) + 6.0 * r * (r + shape->length);
    if (mesh) {
        area = 0.0;
        for (uint32_t f = 0; f < mesh->facet_count; f++) {
            area += mesh_facet_area(mesh, f);
        }
    }
    const double *scale = part->place.scale;
    double most = fmax(fabs(scale[0]), fmax(fabs(scale[1]), fabs(scale[2])));
    return area * most * most;
}

/* The factor by which a part that is small among the others may be coarser than requested. If the
   brightness of each part were proportional to its surface, all parts together would add at most
   the error that the scene is allowed. */
static double part_coarsening(const lrcsi_fineness *fineness, const lrcs_recipe_part *part)
{
    double parts = fmax(PARTS_LEAST, fineness->parts);
    double factor = fineness->area / (lrcsi_fineness_area(part, NULL) * parts);
    return factor > 1.0 ? fmin(factor, COARSENING_MOST) : 1.0;
}

static int shape_is_round(const lrcs_shape *shape)
{
    return shape->kind == LRCS_SHAPE_SPHERE || shape->kind == LRCS_SHAPE_DOME ||
           shape->kind == LRCS_SHAPE_PARABOLOID;
}

/* The tolerance for which a shape is divided: as requested if it is alone. Among other parts it is
   multiplied by the factor above; for round bodies, whose number of facets grows as 1/tolerance
   (for straight walls as its square root), it is ten times as large, at least 1e-4. */
static double shape_tolerance(const lrcsi_fineness *fineness, const lrcs_recipe_part *part)
{
    double tolerance = fineness->tolerance;
    if (fineness->parts == 1) {
        return tolerance;
    }
    tolerance = fmin(tolerance * part_coarsening(fineness, part), fmax(1.0, tolerance));
    return shape_is_round(&part->shape) ? fmax(fmin(10.0 * tolerance, 1.0), fineness->round_least)
                                        : tolerance;
}

/* Among other parts a rim casts shadows that are uncertain over twice its reach, about 0.4 R
   (pi/N)^2, along 2 pi R: less than half the tolerance of the disc that it bounds if N is this. */
static void refine_rim(const lrcsi_fineness *fineness, const lrcs_recipe_part *part,
                       lrcs_divisions *divisions, lrcs_mesh_counts *counts)
{
    const lrcs_shape *shape = &part->shape;
    double corners =
        3.1416 * sqrt(ldexp(5.0 / shape_tolerance(fineness, part), fineness->halvings));
    if (fineness->parts == 1 || divisions->along > 1 || shape->kind == LRCS_SHAPE_PLATE ||
        shape->kind == LRCS_SHAPE_BOX || !(corners < 1e6)) {
        return;
    }
    lrcs_divisions finer = {4 * (uint32_t)(corners / 4.0 + 1.0), 1, 0};
    if (finer.around > divisions->around &&
        lrcsi_tessellate_counts(shape, &finer).facets <= fineness->max_facets) {
        *divisions = finer;
        *counts = lrcsi_tessellate_counts(shape, &finer);
    }
}

/* Divisions of a round body with level rings whose facets are within `reach` of its true surface:
   sectors for a share of that, and as many rings as the rest requires, but for too many facets. */
static lrcs_divisions divide_round_share(const lrcsi_fineness *fineness, const lrcs_shape *shape,
                                         double reach, double share)
{
    double corners = LRCS_PI * sqrt(SECTOR_REACH * shape->radius / (share * reach));
    lrcs_divisions d = {4 * (uint32_t)(fmin(fmax(corners, BASE_AROUND), 1e6) / 4.0 + 1.0),
                        BASE_ALONG, 1};
    while (lrcsi_tessellate_counts(shape, &d).facets <= fineness->max_facets &&
           lrcsi_tessellate_reach(shape, &d).all > reach) {
        d.along += 1 + d.along / 16;
    }
    return d;
}

/* The share for which there are the fewest facets; where these are too many, for a larger reach. */
static lrcs_divisions divide_round(const lrcsi_fineness *fineness, const lrcs_shape *shape,
                                   double reach)
{
    lrcs_divisions best = {0, 0, 0};
    uint32_t fewest = UINT32_MAX;
    for (int i = 0; i < REACHES_MOST && fewest > fineness->max_facets; i++) {
        for (double share = 0.3; share < 0.85; share += 0.1) {
            lrcs_divisions d = divide_round_share(fineness, shape, reach, share);
            uint32_t facets = lrcsi_tessellate_counts(shape, &d).facets;
            if (facets < fewest) {
                best = d;
                fewest = facets;
            }
        }
        reach *= 1.25;
    }
    return best;
}

/* Divisions of a shape whose facets represent patches of its true surface (integrate/patch.h):
   these have no error of their own, so that only the uncertainty of shadows counts, in proportion
   to the distance of the true surface from the facets. Straight walls are divided as above, round
   bodies for that distance. Each halving divides the distance by two. */
static int divide_for_shadows(const lrcsi_fineness *fineness, const lrcs_recipe_part *part,
                              lrcs_divisions *divisions, lrcs_mesh_counts *counts)
{
    const lrcs_shape *shape = &part->shape;
    double tolerance = fmin(fineness->tolerance * part_coarsening(fineness, part), 1.0);
    double reach = REACH_ROUND * fmax(tolerance, fineness->round_least) * shape->radius;
    double corners = fmax(3.1416 * sqrt(5.0 / tolerance), BASE_AROUND);
    corners *= sqrt(ldexp(1.0, fineness->halvings));
    if (!(corners < 1e6)) {
        return 0;
    }
    *divisions = (lrcs_divisions){4 * (uint32_t)(corners / 4.0 + 1.0), 1, 0};
    if (shape_is_round(shape)) {
        *divisions = divide_round(fineness, shape, reach);
    }
    if (shape_is_round(shape) && fineness->halvings > 0) {
        reach = ldexp(lrcsi_tessellate_reach(shape, divisions).all, -fineness->halvings);
        *divisions = divide_round(fineness, shape, reach);
    }
    *counts = lrcsi_tessellate_counts(shape, divisions);
    return counts->facets <= fineness->max_facets;
}

/* Divisions of a shape alone whose facets represent patches: as coarse as the tolerance allows.
   Returns 0 if that does not suffice, or if these facets would need to be finer than those without
   patches. ratio: of the scales along two axes. It multiplies the turns of normals; measured with
   scales of 1, 2 and 4, it multiplies the bounds of round shapes by its cube. */
static int divide_alone(const lrcsi_fineness *fineness, const lrcs_recipe_part *part, double ratio,
                        const lrcs_brdf *brdf, lrcs_divisions *divisions, lrcs_mesh_counts *counts)
{
    int is_round = shape_is_round(&part->shape);
    const double round = ALONE_ROUND * (ratio * ratio * ratio);
    double tolerance = fmin(ldexp(fineness->tolerance, -fineness->halvings), 1.0);
    double corners = fmax(ALONE_LEAST, brdf->A > 0.0 ? ALONE_PER_SLOPE * ratio / brdf->s : 0.0);
    corners = is_round ? corners : fmax(corners, sqrt(ALONE_STRAIGHT / tolerance));
    while (is_round && corners < ALONE_MOST && corners * corners * corners * tolerance < round) {
        corners += 4.0;
    }
    if (fineness->facets_only == LRCS_FACETS_LOCAL || !(corners < ALONE_MOST) ||
        (brdf->B > 0.0 && brdf->m > ALONE_EXPONENT_MOST)) {
        return 0;
    }
    divisions->around = 4 * (uint32_t)(corners / 4.0 + 1.0);
    divisions->along = is_round ? divisions->around / 4 : 1;
    divisions->level_rings = 0;
    *counts = lrcsi_tessellate_counts(&part->shape, divisions);
    return counts->facets <= fineness->max_facets;
}

/* Do the facets of a shape represent patches of it? */
static int has_patches(const lrcs_recipe_part *part)
{
    lrcsi_placer placer;
    double image[3][3];
    double area;
    int flat = part->shape.kind == LRCS_SHAPE_PLATE || part->shape.kind == LRCS_SHAPE_BOX ||
               part->shape.kind == LRCS_SHAPE_DISC;
    return !flat && lrcsi_placer_make(&part->place, &part->joint, &placer) == LRCS_OK &&
           lrcsi_placer_normals(&placer, image, &area);
}

/* Does the closed form hold for a shape from every direction? It does if nothing hides it and its
   placement does not change its shape. */
static int is_closed_form(const lrcsi_fineness *fineness, const lrcs_recipe_part *part,
                          const lrcs_material *material)
{
    lrcsi_placer placer;
    lrcsi_axes axes;
    return fineness->parts == 1 && !fineness->facets_only &&
           lrcsi_placed_shape_closed_form(&part->shape, material->two_sided) &&
           lrcsi_placer_make(&part->place, &part->joint, &placer) == LRCS_OK &&
           lrcsi_placer_axes(&placer, &axes);
}

/* The first of these that applies:
   1. facets for pictures only, if the closed form holds for the shape;
   2. facets that represent patches of the true surface;
   3. flat facets. The ratio of the scales along two axes multiplies the turns of normals, and the
      error of a facet by slightly more than its square (mesh/profile.c). */
int lrcsi_fineness_divide(const lrcsi_fineness *fineness, const lrcs_recipe_part *part,
                          const lrcs_material *material, lrcs_divisions *divisions,
                          lrcs_mesh_counts *counts)
{
    const double *scale = part->place.scale;
    double large = fmax(fabs(scale[0]), fmax(fabs(scale[1]), fabs(scale[2])));
    double small = fmin(fabs(scale[0]), fmin(fabs(scale[1]), fabs(scale[2])));
    double ratio = large / small < RATIO_MOST ? large / small : 1.0; /* not if small is 0 */
    double spread = ratio > 1.0 ? 1.5 * ratio * ratio : 1.0;
    const double tolerance = ldexp(shape_tolerance(fineness, part) / spread, -fineness->halvings);
    const lrcs_fineness wanted = {tolerance, material->brdf, fineness->max_facets};
    if (is_closed_form(fineness, part, material)) {
        *divisions =
            (lrcs_divisions){BASE_AROUND, shape_is_round(&part->shape) ? BASE_ALONG : 1, 0};
        *counts = lrcsi_tessellate_counts(&part->shape, divisions);
        if (counts->facets <= fineness->max_facets) {
            return LRCS_OK;
        }
    }
    if (has_patches(part) &&
        (fineness->parts > 1
             ? divide_for_shadows(fineness, part, divisions, counts)
             : divide_alone(fineness, part, ratio, &material->brdf, divisions, counts))) {
        return LRCS_OK;
    }
    int status = lrcs_shape_count(&part->shape, &wanted, divisions, counts);
    if (status == LRCS_OK) {
        refine_rim(fineness, part, divisions, counts);
    }
    return status;
}
